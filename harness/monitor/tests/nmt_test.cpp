// SPDX-License-Identifier: Apache-2.0
// NMT states, boot-up messages and heartbeats.
#include <fmt/format.h>

#include "trace.hpp"

using namespace conform;
using namespace conform::monitor::testing;
using result::Verdict;

namespace {
const std::string request = "> 40 00 10 00 00 00 00 00", answer = "< 43 00 10 00 91 01 00 00";
const std::string reset_node = "> 000: 81 01", reset_communication = "> 000: 82 00", stop = "> 000: 02 01",
                  pre_operational = "> 000: 80 01", start = "> 000: 01 00";
const std::string boot_up = "< 701: 00";
}  // namespace

TEST_CASE("One boot-up message per reset is right, at power-on too") {
  const auto cases = judged(trace({boot_up, reset_node, "wait 2 s", boot_up, "< 701: 7F", reset_communication,
                                   boot_up, request, answer}));
  CHECK(told(cases).empty());
  CHECK(verdict_of(cases, "monitor/nmt-boot-up") == Verdict::pass);
}

TEST_CASE("Resets close together may share a boot-up message or not") {
  CHECK(told({reset_node, reset_node, reset_communication, boot_up, "< 701: 7F"}).empty());
  CHECK(told({reset_node, reset_node, reset_communication, boot_up, boot_up, boot_up, "< 701: 7F"}).empty());
}

TEST_CASE("A reset without a boot-up message is found once the device speaks again") {
  CHECK(told({reset_node, "wait 6 s", request, answer, "< 701: 7F"}) == Told{"fail NMT-BOOT-02 in frame 3"});
  CHECK(told({reset_node, "wait 6 s", request}).empty());
  CHECK(told({"> 000: 81 02", "wait 6 s", request, answer}).empty());
  CHECK(told({"> 000: 81", "wait 6 s", request, answer}).empty());
}

TEST_CASE("A device that starts with a node-ID from LSS has started") {
  // It holds the COB-ID of its EMCY as it was stored, and so is heard of on 081h.
  const std::string as_32 = "> 7E5: 11 20 00 00 00 00 00 00", boot_up_of_32 = "< 720: 00",
                    emcy = "< 081: 40 82 11 01 03 00 00 00", reset_all = "> 000: 81 00";
  CHECK(told({as_32, reset_node, boot_up_of_32, "wait 6 s", emcy}).empty());
  // What is said to the old node-ID is not said to it.
  CHECK(told({as_32, reset_node, boot_up_of_32, reset_node, "wait 6 s", emcy}).empty());
  CHECK(told({as_32, reset_node, "wait 6 s", emcy}) == Told{"fail NMT-BOOT-02 in frame 3"});
  CHECK(told({as_32, reset_node, boot_up_of_32, reset_all, "wait 6 s", emcy}) ==
        Told{"fail NMT-BOOT-02 in frame 5"});
  CHECK(told({"> 7E5: 11 21 00 00 00 00 00 00", reset_node, boot_up_of_32, "wait 6 s", emcy}) ==
        Told{"fail NMT-BOOT-02 in frame 4"});
}

TEST_CASE("A boot-up message that comes twice, or for another command than a reset") {
  CHECK(told({reset_communication, boot_up, boot_up}) == Told{"fail NMT-BOOT-03 in frame 3"});
  CHECK(told({boot_up, "wait 3 s", start, boot_up}) == Told{"fail NMT-BOOT-06 in frame 3"});
}

TEST_CASE("The boot-up message is one byte 00h") {
  CHECK(told({reset_node, "< 701: 00 00"}) == Told{"fail NMT-BOOT-04 in frame 2"});
  CHECK(told({reset_node, "< 701: 80"}) == Told{"fail NMT-BOOT-04 in frame 2"});
}

TEST_CASE("Nothing is sent before the boot-up message") {
  CHECK(told({reset_node, "wait 200 ms", "< 701: 7F", boot_up}) == Told{"fail NMT-BOOT-05 in frame 2"});
  CHECK(told({reset_node, "wait 200 ms", request, answer, boot_up}) == Told{"fail SDO-GEN-16 in frame 3"});
  // What was in the queue.
  CHECK(told({reset_node, "< 701: 05", answer, "wait 1 s", boot_up}).empty());
}

TEST_CASE("In Stopped the server is silent") {
  CHECK(told({stop, "wait 200 ms", request, answer}) == Told{"fail SDO-GEN-15 in frame 3"});
  CHECK(told({stop, request, answer}).empty());
  CHECK(told({stop, "wait 200 ms", request, pre_operational, request, answer}).empty());
  CHECK(told({"> 000: 02 02", "wait 200 ms", request, answer}).empty());
  // One answer may be that to a request from before, which has waited for it longer than its client.
  CHECK(told({request, stop, "wait 200 ms", request, answer}).empty());
  CHECK(told({request, answer, stop, "wait 200 ms", request, answer}) == Told{"fail SDO-GEN-15 in frame 5"});
  CHECK(told({request, stop, "wait 200 ms", request, answer, request, answer}) ==
        Told{"fail SDO-GEN-15 in frame 6"});
  // Perhaps still booting when the command came.
  CHECK(told({reset_node, stop, boot_up, "wait 200 ms", request, answer}).empty());
  const auto cases =
      judged(trace({stop, "wait 200 ms", request, pre_operational, "wait 200 ms", request, answer}));
  CHECK(verdict_of(cases, "monitor/sdo-states") == Verdict::pass);
}

TEST_CASE("A transfer from before that times out in Stopped, where something was asked since, warns") {
  const std::string upload = "> 40 08 10 00 00 00 00 00", begun = "< 41 08 10 00 0C 00 00 00",
                    segment = "> 60 00 00 00 00 00 00 00", given_up = "< 80 08 10 00 00 00 04 05",
                    refused = "< 80 08 10 00 22 00 00 08";
  CHECK(told({upload, begun, stop, "wait 200 ms", segment, given_up}) == Told{"warn SDO-GEN-15 in frame 5"});
  CHECK(told({upload, begun, stop, "wait 200 ms", segment, refused}) == Told{"fail SDO-GEN-15 in frame 5"});
  // Nobody asked for it: it may have been on its way.
  CHECK(told({upload, begun, stop, "wait 200 ms", given_up}).empty());
}

TEST_CASE("The heartbeat tells the commanded state, where the device cannot leave it by itself") {
  CHECK(told({stop, "< 701: 7F", "wait 200 ms", "< 701: 7F"}) == Told{"fail EC-HBP-06 in frame 3"});
  CHECK(told({pre_operational, "wait 200 ms", "< 701: 05"}) == Told{"fail EC-HBP-06 in frame 2"});
  CHECK(told({start, "wait 200 ms", "< 701: 05", "< 701: 7F", "< 701: 04"}).empty());
  CHECK(told({"< 701: 03"}) == Told{"fail EC-HBP-06 in frame 1"});
}

TEST_CASE("What waits behind the segments of a block is as old as the first of them") {
  // 125 kbit/s: 127 segments take 140 ms, and the heartbeat of the state before comes after them.
  std::vector<std::string> lines{"> C6 00 00 00 00", stop};
  for (int segment = 1; segment < 110; ++segment) {
    lines.push_back("wait 1 ms");
    lines.push_back(fmt::format("< {:02X} 01 02 03 04 05 06 07", segment));
  }
  lines.push_back("< 701: 7F");
  CHECK(told(lines).empty());
  lines.push_back("wait 20 ms");
  lines.push_back("< 701: 7F");
  CHECK(told(lines).size() == 1);
}

TEST_CASE("A heartbeat has one byte with bit 7 clear") {
  CHECK(told({"< 701: 7F 00"}) == Told{"fail EC-HBP-08 in frame 1"});
  CHECK(told({"< 701: FF"}) == Told{"fail EC-HBP-07 in frame 1"});
  CHECK(told({"> 701: remote", "< 701: 7F", "> 701: remote", "< 701: FF"}).empty());
}

TEST_CASE("Heartbeats that the host sends for the device are not judged") {
  CHECK(told({"> 701: 03", "> 701: 00 00", "> 701: FF"}).empty());
}

TEST_CASE("A boot-up message behind a guarding request is one") {
  CHECK(told({"> 701: remote", "> 000: 81 01", "wait 20 ms", "< 701: 00", "wait 6 s", "< 701: 7F"}).empty());
}

TEST_CASE("The silence of a device that is not heard afterwards is no pass") {
  CHECK(verdict_of(judged(trace({stop, "wait 200 ms", request})), "monitor/sdo-states") ==
        Verdict::not_applicable);
  const auto nobody = judged(trace(
      {start, stop, pre_operational, "> 602: 40 00 10 00 00 00 00 00", "> 600: 40 00 10 00 00 00 00 00"}));
  for (const auto& each : nobody) CHECK(each.verdict == Verdict::not_applicable);
  const auto heard = judged(trace({start, pre_operational, "< 701: 7F"}));
  CHECK(verdict_of(heard, "monitor/nmt-boot-up") == Verdict::pass);
}

TEST_CASE("A guard answer in state 00h is wrong, but no boot-up message") {
  CHECK(
      told({boot_up, "wait 3 s", start, "> 701: remote", "< 701: 00", "> 701: remote", "< 701: 80"}).empty());
  CHECK(told({boot_up, "wait 3 s", start, "> 701: remote", "< 701: 05", "< 701: 00"}) ==
        Told{"fail NMT-BOOT-06 in frame 5"});
  CHECK(told({boot_up, "wait 3 s", "> 701: remote", reset_node, "wait 20 ms", boot_up, boot_up}) ==
        Told{"fail NMT-BOOT-02 in frame 5"});
}
