// SPDX-License-Identifier: Apache-2.0
// Guard replies, told apart from heartbeats by 1017h.
#include "trace.hpp"

using namespace conform;
using namespace conform::monitor::testing;
using result::Verdict;

namespace {
const std::string ask = "> 701: remote", reset = "> 000: 82 01", boot_up = "< 701: 00";
}

TEST_CASE("Guard replies alternate, beginning with 0") {
  const auto off = [] {
    return Story().line(reset).line("wait 20 ms").line(boot_up).read(0x1017, 0, 0).line("wait 200 ms");
  };
  CHECK(off()
            .line(ask)
            .line("< 701: 7F")
            .line(ask)
            .line("< 701: FF")
            .line(ask)
            .line("< 701: 7F")
            .told()
            .empty());
  CHECK(off().line(ask).line("< 701: 7F").line(ask).line("< 701: FF").verdict("monitor/guarding") ==
        Verdict::pass);
  CHECK(off().line(ask).line("< 701: 7F").line(ask).line("< 701: 7F").told() == Told{"fail EC-NG-02"});
  CHECK(off().line(ask).line("< 701: FF").told() == Told{"fail EC-NG-01"});
  CHECK(off().line(ask).line("< 701: 7F 00").told() == Told{"fail EC-NG-05"});
  CHECK(off().line(ask).line("< 701: 08").told() == Told{"fail EC-NG-04"});
  // Where the heartbeat may be on they may be heartbeats.
  CHECK(Story().line(ask).line("< 701: 7F").line(ask).line("< 701: 7F").told().empty());
}

TEST_CASE("What lies behind a heartbeat time of which no size is told is none of it") {
  const auto told_without_size = [](const std::string& value) {
    return Story()
        .line("wait 150 ms")
        .line("> 40 17 10 00 00 00 00 00")
        .line("< 42 17 10 00 " + value)
        .line("wait 200 ms")
        .line(ask)
        .line("< 701: FF")
        .told();
  };
  CHECK(told_without_size("00 00 5A 5A").empty());
  CHECK(told_without_size("64 00 5A 5A") == Told{"fail EC-HBP-12"});
}

TEST_CASE("A guard reply is asked for") {
  const auto off = [] { return Story().read(0x1017, 0, 0).line("wait 200 ms"); };
  CHECK(Story()
            .read(0x1000, 0, 0x191)
            .absent(0x1017, 0)
            .line("< 701: 7F")
            .line("< 701: FF")
            .told()
            .empty());  // asked before the trace
  auto many = off();
  for (int i = 0; i < 64; ++i) many.line(i % 2 == 0 ? "< 701: 7F" : "< 701: FF");
  CHECK(many.told().empty());
  CHECK(many.line("< 701: 7F").told() == Told{"fail EC-HBP-04"});
  CHECK(many.line(ask).line("< 701: FF").line("< 701: 7F").told() == Told{"fail EC-NG-16", "fail EC-HBP-04"});
}

TEST_CASE("No guard reply comes beside the heartbeat") {
  CHECK(Story().read(0x1017, 0, 1000).line("wait 200 ms").line(ask).line("< 701: 7F").told().empty());
  CHECK(Story().read(0x1017, 0, 1000).line("wait 200 ms").line(ask).line("< 701: FF").told() ==
        Told{"fail EC-HBP-12"});
  CHECK(Story().write(0x1017, 0, 1000).line(ask).line("< 701: FF").told().empty());
}
