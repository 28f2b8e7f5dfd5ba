// SPDX-License-Identifier: Apache-2.0
// Starts that nobody asked for, and what they are blamed on.
#include "monitor/restarts.hpp"

#include "trace.hpp"

using namespace conform;
using namespace conform::monitor::testing;
using result::Verdict;

namespace {

const std::string upload = "> 40 00 10 00 00 00 00 00", answer = "< 43 00 10 00 91 01 00 00";
const std::string boot_up = "< 701: 00", reset_node = "> 000: 81 01", start = "> 000: 01 00";

std::vector<std::string> told_in_run(const std::vector<std::string>& lines) {
  monitor::Facts facts;
  facts.power_is_known = true;
  return told(judged(trace(lines), {}, facts));
}

}  // namespace

TEST_CASE("A start without a reset is found; once it may have been the plug, again it is the device") {
  CHECK(told_in_run({boot_up, upload, answer, boot_up}) == Told{"inconclusive NMT-BOOT-10 in frame 4"});
  CHECK(told_in_run({boot_up, "wait 3 s", boot_up}) == Told{"inconclusive NMT-BOOT-10 in frame 2"});
  CHECK(told_in_run({boot_up, upload, answer, boot_up, upload, answer, "wait 20 s", boot_up}) ==
        Told{"fail NMT-BOOT-10 in frame 4", "fail NMT-BOOT-10 in frame 7"});
  // Who recorded the trace may have switched the power as often as he liked.
  CHECK(told({boot_up, upload, answer, boot_up, upload, answer, "wait 20 s", boot_up}) ==
        Told{"inconclusive NMT-BOOT-10 in frame 4", "inconclusive NMT-BOOT-10 in frame 7"});
}

TEST_CASE(
    "A start behind an order that was given to a device which did not answer is not blamed on the order") {
  CHECK(told_in_run({boot_up, "wait 3 s", upload, "wait 1 s", start, "wait 50 ms", boot_up}) ==
        Told{"inconclusive NMT-BOOT-10 in frame 4"});
  CHECK(told_in_run({boot_up, "wait 3 s", start, upload, answer, boot_up}) ==
        Told{"inconclusive NMT-BOOT-10 in frame 5"});
}

TEST_CASE("A second start that a request came before is another start") {
  CHECK(told_in_run({reset_node, "wait 1 s", boot_up, "> 601: 40 00", "wait 20 ms", boot_up}) ==
        Told{"inconclusive NMT-BOOT-10 in frame 4"});
}

TEST_CASE("The start of a program is no restart by itself") {
  CHECK(told_in_run({boot_up, upload, answer, "> 2F 51 1F 01 01 00 00 00", "< 60 51 1F 01 00 00 00 00",
                     "wait 2 s", boot_up})
            .empty());
}

TEST_CASE("The start with a node-ID that LSS configured is no restart by itself, the next one is") {
  const std::string configure = "> 7E5: 11 01 00 00 00 00 00 00", leave = "> 7E5: 04 00 00 00 00 00 00 00";
  CHECK(told_in_run({boot_up, upload, answer, configure, leave, "wait 2 s", boot_up}).empty());
  CHECK(told_in_run({boot_up, upload, answer, leave, "wait 2 s", boot_up}) ==
        Told{"inconclusive NMT-BOOT-10 in frame 5"});
  CHECK(told_in_run({boot_up, configure, leave, "wait 2 s", boot_up, upload, answer, "wait 2 s", boot_up}) ==
        Told{"inconclusive NMT-BOOT-10 in frame 7"});
}

TEST_CASE("A device that starts when it is told to passes") {
  const auto cases = judged(trace({reset_node, "wait 2 s", boot_up, upload, answer}));
  CHECK(verdict_of(cases, "monitor/restarts") == Verdict::pass);
  CHECK(verdict_of(judged(trace({boot_up})), "monitor/restarts") == Verdict::not_applicable);
}

TEST_CASE("What the device may have fallen over is what was sent since it was last heard") {
  const auto frames =
      trace({upload, answer, "> 601: 40 00", "wait 1 s", "> 80 00 10 00 00 00 04 05", "wait 1 s", boot_up});
  const auto found = monitor::stimulus_of(frames, 4, NodeId(1), std::chrono::seconds(5));
  REQUIRE(found.has_value());
  CHECK(found->first == 2);
  CHECK(found->last == 3);
  CHECK_FALSE(monitor::stimulus_of(frames, 4, NodeId(1), std::chrono::milliseconds(500)).has_value());
  CHECK_FALSE(monitor::stimulus_of(trace({upload, answer, boot_up}), 2, NodeId(1), std::chrono::seconds(5))
                  .has_value());
}
