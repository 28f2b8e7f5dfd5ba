// SPDX-License-Identifier: Apache-2.0
// SYNC and TIME that the device sends.
#include "trace.hpp"

using namespace conform;
using namespace conform::monitor::testing;
using result::Verdict;

namespace {
const std::string sync_frame = "< 080:", time_frame = "< 100: 00 00 00 00 00 00", stop = "> 000: 02 01";

Story producing(std::uint32_t period) {
  return Story()
      .write(0x1005, 0, 0x80)
      .write(0x1006, 0, period)
      .write(0x1005, 0, 0x4000'0080)
      .read(0x1019, 0, 0);
}
Story& sends(Story& story, int count, const std::string& pause) {
  for (int i = 0; i < count; ++i) story.line(pause).line(sync_frame);
  return story;
}
}  // namespace

TEST_CASE("Who does not produce SYNC sends none, as far as nobody else is there") {
  CHECK(Story().read(0x1005, 0, 0x80).later(sync_frame).told() == Told{"fail SYNC-PRO-03"});
  CHECK(Story().read(0x1005, 0, 0x80).later(sync_frame).line("< 702: 05").told().empty());
  CHECK(Story().read(0x1005, 0, 0x80).later("> 080:").told().empty());
  CHECK(Story().later(sync_frame).told().empty());
  CHECK(Story().write(0x1005, 0, 0x80).line(sync_frame).told().empty());
  // Somebody who goes on while the device starts.
  CHECK(Story()
            .read(0x1005, 0, 0x80)
            .later(sync_frame)
            .line("> 000: 81 01")
            .later(sync_frame)
            .line("< 701: 00")
            .told()
            .empty());
  monitor::Facts facts;
  facts.senders_are_known = false;
  CHECK(Story().read(0x1005, 0, 0x80).later(sync_frame).told(facts).empty());
}

TEST_CASE("SYNC comes with its period, and not in Stopped") {
  auto right = producing(20'000), quick = producing(50'000), off = producing(0), stopped = producing(20'000);
  CHECK(sends(right, 30, "wait 19 ms").told().empty());
  CHECK(sends(quick, 30, "wait 19 ms").told() == Told{"fail SYNC-PRO-01"});
  CHECK(sends(off.line("wait 200 ms"), 3, "wait 19 ms").told() == Told{"fail SYNC-PRO-03"});
  CHECK(sends(stopped.line(stop).line("wait 200 ms"), 3, "wait 19 ms").told() == Told{"fail SYNC-PRO-06"});
}

TEST_CASE("A SYNC has a counter if 1019h says so") {
  auto counting = [] { return producing(20'000).write(0x1019, 0, 3).line("wait 200 ms"); };
  CHECK(counting().line("< 080: 01").line("< 080: 02").line("< 080: 03").line("< 080: 01").told().empty());
  CHECK(counting().line("< 080: 01").line("< 080: 03").told() == Told{"fail SYNC-PRO-04"});
  CHECK(counting().line("< 080: 04").told() == Told{"fail SYNC-PRO-04"});
  CHECK(counting().line(sync_frame).told() == Told{"fail SYNC-PRO-04"});
  CHECK(producing(20'000).later("< 080: 01").told() == Told{"fail SYNC-PRO-04"});
}

TEST_CASE("Who does not produce TIME sends none") {
  CHECK(Story().read(0x1012, 0, 0x8000'0100).later(time_frame).told() == Told{"fail TIME-PRO-03"});
  CHECK(Story().read(0x1012, 0, 0x4000'0100).later(time_frame).told().empty());
  CHECK(Story().read(0x1012, 0, 0x4000'0100).line(stop).later(time_frame).told() == Told{"fail TIME-PRO-02"});
  CHECK(Story().read(0x1012, 0, 0x4000'0100).later("< 100: 00 00 00 F0 00 00").told() ==
        Told{"fail TIME-PRO-01"});
  CHECK(Story().later(time_frame).told().empty());
}

TEST_CASE("What a start brings back that nobody has seen may produce TIME") {
  // A device that stores by itself had stored C000 0100h before the trace was interrupted (its power was
  // switched), and TIME-PRO-03 was failed when the next reset brought it back:
  //   601 [8] 23 12 10 00 00 01 00 00   581 [8] 60 12 10 00 ..   000 [2] 82 01   701 [1] 00   100 [6] ..
  const std::string reset = "> 000: 82 01", boot_up = "< 701: 00";
  CHECK(Story().write(0x1012, 0, 0x100).line(reset).line(boot_up).later(time_frame).told().empty());
  CHECK(Story()
            .line(reset)
            .line(boot_up)
            .read(0x1012, 0, 0x8000'0100)
            .write(0x1012, 0, 0x100)
            .line(reset)
            .line(boot_up)
            .later(time_frame)
            .told() == Told{"fail TIME-PRO-03"});
}
