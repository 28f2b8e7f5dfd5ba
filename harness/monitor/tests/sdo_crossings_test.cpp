// SPDX-License-Identifier: Apache-2.0
// Frames that pass each other on the way: what a server sent before it saw the client's last frame.
#include "canopen/sdo_block.hpp"
#include "trace.hpp"

using namespace conform;
using namespace conform::monitor::testing;

namespace {

/// `rest` behind the beginning of a transfer, and plain exchanges behind it.
std::vector<std::string> crossing(std::vector<std::string> begin, const std::vector<std::string>& rest) {
  begin.insert(begin.end(), rest.begin(), rest.end());
  begin.insert(begin.end(), {"wait 200 ms", "> 40 00 10 00 00 00 00 00", "< 43 00 10 00 91 01 00 00"});
  return after_exchanges(begin);
}

const std::vector<std::string> upload{"> 40 08 10 00 00 00 00 00", "< 41 08 10 00 14 00 00 00"};
const std::vector<std::string> download{"> 21 08 20 00 14 00 00 00", "< 60 08 20 00 00 00 00 00"};
/// Both segments of the first sub-block of three.
const std::vector<std::string> block_upload{"> A0 08 10 00 02 00 00 00", "< C2 08 10 00 23 00 00 00",
                                            "> A3 00 00 00 00 00 00 00", "< 01 41 41 41 41 41 41 41",
                                            "< 02 42 42 42 42 42 42 42"};
/// The end frame is the next one.
const std::vector<std::string> block_download{"> C2 08 20 00 0E 00 00 00", "< A0 08 20 00 7F 00 00 00",
                                              "> 01 20 20 20 20 20 20 20", "> 82 20 20 20 20 20 20 20",
                                              "< A2 02 7F 00 00 00 00 00"};
const std::string give_up_1008 = "< 80 08 10 00 00 00 04 05", give_up_2008 = "< 80 08 20 00 00 00 04 05";
const std::string no_transfer_1008 = "< 80 08 10 00 01 00 04 05", no_transfer = "< 80 00 00 00 01 00 04 05";

}  // namespace

TEST_CASE("The time-out of a transfer may cross the next initiate request, and names its own object") {
  CHECK(told(crossing(upload, {"wait 500 ms", "> 40 00 10 00 00 00 00 00", give_up_1008,
                               "< 43 00 10 00 91 01 00 00"}))
            .empty());
  CHECK(told(crossing(download, {"wait 500 ms", "> 40 00 10 00 00 00 00 00", give_up_2008,
                                 "< 43 00 10 00 91 01 00 00"}))
            .empty());
  // The client gave up, too.
  CHECK(told(crossing(upload, {"wait 500 ms", "> 80 08 10 00 00 00 04 05", "> 40 00 10 00 00 00 00 00",
                               give_up_1008, "< 43 00 10 00 91 01 00 00"}))
            .empty());
}

TEST_CASE(
    "A request that was on its way when the client gave up everything may be refused by the name of the other transfer") {
  CHECK(told(crossing({"> 40 08 10 00 00 00 00 00"},
                      {"> 40 18 10 01 00 00 00 00", "< 41 08 10 00 14 00 00 00", "> 80 08 10 00 08 00 00 00",
                       "> 80 18 10 01 08 00 00 00", "< 80 08 10 00 01 00 04 05"}))
            .empty());
}

TEST_CASE("The time-out of a transfer may cross the next segment, which then has no transfer") {
  CHECK(told(crossing(upload, {"wait 500 ms", "> 60 00 00 00 00 00 00 00", give_up_1008, no_transfer_1008}))
            .empty());
  CHECK(told(crossing(download, {"wait 500 ms", "> 00 20 20 20 20 20 20 20", give_up_2008, no_transfer}))
            .empty());
  // A client that does not wait for the answer to its segment.
  CHECK(told(crossing(upload, {"wait 500 ms", "> 60 00 00 00 00 00 00 00", "> 40 00 10 00 00 00 00 00",
                               give_up_1008, no_transfer, "< 43 00 10 00 91 01 00 00"}))
            .empty());
}

TEST_CASE("The time-out of a transfer names its object, also when it crosses a segment") {
  CHECK(told(crossing(upload, {"wait 500 ms", "> 60 00 00 00 00 00 00 00", "< 80 00 10 00 00 00 04 05"})) ==
        Told{"fail SDO-ERR-04 in frame 8"});
}

TEST_CASE("A crossing explains one further abort, and not two") {
  CHECK(told(crossing(upload, {"wait 500 ms", "> 60 00 00 00 00 00 00 00", give_up_1008, no_transfer,
                               no_transfer})) == Told{"fail SDO-ERR-10 in frame 10"});
  CHECK(told(crossing(upload, {"> 70 00 00 00 00 00 00 00", "< 80 08 10 00 00 00 03 05",
                               "< 80 08 10 00 00 00 03 05"})) == Told{"fail SDO-ERR-10 in frame 9"});
}

TEST_CASE("The time-out of a block upload may cross the start, an acknowledge, or the confirmation") {
  const std::vector<std::string> initiated(block_upload.begin(), block_upload.begin() + 2);
  CHECK(
      told(crossing(initiated, {"wait 500 ms", "> A3 00 00 00 00 00 00 00", give_up_1008, no_transfer_1008}))
          .empty());
  CHECK(
      told(crossing(block_upload, {"wait 1 s", "> A2 02 02 00 00 00 00 00", give_up_1008, no_transfer_1008}))
          .empty());
  auto last = block_upload;
  last[1] = "< C2 08 10 00 0E 00 00 00";
  last.back() = "< 82 42 42 42 42 42 42 42";
  CHECK(told(crossing(last, {"wait 1 s", "> A2 02 02 00 00 00 00 00", give_up_1008, no_transfer})).empty());
  const std::vector<std::string> end{"> A2 02 02 00 00 00 00 00", "< C1 00 00 00 00 00 00 00", "wait 500 ms",
                                     "> A1 00 00 00 00 00 00 00", give_up_1008};
  CHECK(told(crossing(last, end)).empty());
  auto answered = end;
  answered.push_back(no_transfer);
  CHECK(told(crossing(last, answered)).empty());
  auto twice = answered;
  twice.push_back(no_transfer);
  CHECK(told(crossing(last, twice)) == Told{"fail SDO-ERR-10 in frame 15"});
  auto other = end;
  other.back() = "< 80 08 10 00 00 00 00 08";
  CHECK(told(crossing(last, other)) == Told{"fail SDO-GEN-04 in frame 13"});
}

TEST_CASE("A time-out that may as well be a late answer to an abort leaves nothing open for certain") {
  CHECK(told(after_exchanges({"> 40 08 10 00 00 00 00 00", "< 41 08 10 00 15 00 00 00",
                              "> 80 08 10 00 00 00 00 08",  // which some servers answer
                              "> 21 08 10 00 15 00 00 00", "< 80 08 10 00 02 00 01 06",
                              "> A0 08 10 00 7F 00 00 00", "< C2 08 10 00 15 00 00 00",
                              "> A3 00 00 00 00 00 00 00", "< 01 41 41 41 41 41 41 41",
                              "< 02 42 42 42 42 42 42 42", "< 83 43 43 43 43 43 43 43",
                              "> A2 03 7F 00 00 00 00 00", "< C1 00 00 00 00 00 00 00", "wait 1 s",
                              give_up_1008, "wait 700 ms", "> A1 00 00 00 00 00 00 00", no_transfer}))
            .empty());
}

TEST_CASE("The time-out of a block download may cross the end frame") {
  CHECK(told(crossing(block_download, {"wait 500 ms", "> C1 00 00 00 00 00 00 00", give_up_2008,
                                       "< 80 08 20 00 01 00 04 05"}))
            .empty());
}

TEST_CASE("A server that refuses a new initiate request may name the object of the transfer it ends") {
  for (const std::string code : {"00 00 00 08", "22 00 00 08", "01 00 04 05"}) {
    INFO(code);
    CHECK(told(crossing(upload, {"> 40 18 10 01 00 00 00 00", "< 80 08 10 00 " + code})).empty());
    CHECK(told(crossing(upload, {"> 40 18 10 01 00 00 00 00", "< 80 18 10 01 " + code})).empty());
    // The transfer may be open still.
    CHECK(told(crossing(upload, {"> 000: 80 00", "> 40 18 10 01 00 00 00 00", "< 80 08 10 00 " + code}))
              .empty());
  }
  // It ended the transfer by itself.
  CHECK(told(crossing(upload, {"> 40 18 10 01 00 00 00 00", "< 80 08 10 00 22 00 00 08",
                               "< 43 18 10 01 FE 5A 00 00"}))
            .empty());
  CHECK(told(crossing(upload, {"> 40 18 10 01 00 00 00 00", "< 80 17 10 00 00 00 00 08"})) ==
        Told{"fail SDO-ERR-04 in frame 8"});
  CHECK(told(crossing({}, {"> 40 18 10 01 00 00 00 00", "< 80 01 10 00 00 00 00 08"})) ==
        Told{"fail SDO-ERR-04 in frame 6"});
  CHECK(told(crossing({}, {"> 000: 80 00", "> 40 18 10 01 00 00 00 00", "< 80 00 00 00 00 00 00 08"})) ==
        Told{"fail SDO-ERR-04 in frame 7"});
}

TEST_CASE("A sub-block that comes again may cross whatever the client sends instead of the acknowledge") {
  const auto again = [](const std::string& request, std::vector<std::string> behind) {
    auto lines = block_upload;
    lines.insert(lines.end(), {"wait 1 s", request, block_upload[3], block_upload[4]});
    lines.insert(lines.end(), behind.begin(), behind.end());
    return told(crossing(lines, {}));
  };
  CHECK(again("> 40 00 10 00 00 00 00 00", {"< 43 00 10 00 91 01 00 00"}).empty());
  CHECK(again("> A3 00 00 00 00 00 00 00", {}).empty());
  CHECK(again("> 80 08 10 00 00 00 04 05", {}).empty());
  // An acknowledge of more than was sent.
  CHECK(again("> A2 03 02 00 00 00 00 00", {"< 80 08 10 00 03 00 04 05"}).empty());
  // The acknowledge of this sub-block, and the next one.
  CHECK(
      again("> A2 02 02 00 00 00 00 00", {"< 01 43 43 43 43 43 43 43", "< 02 44 44 44 44 44 44 44"}).empty());
}

TEST_CASE("The last segment of a sub-block that comes again is no abort") {
  const std::vector<std::string> one{"> A0 08 10 00 02 00 00 00", "< C2 08 10 00 07 00 00 00",
                                     "> A3 00 00 00 00 00 00 00", "< 81 41 41 41 41 41 41 41"};
  CHECK(told(crossing(one, {"wait 1 s", "> A2 01 02 00 00 00 00 00", "< 81 41 41 41 41 41 41 41",
                            "< C1 00 00 00 00 00 00 00", "> A1 00 00 00 00 00 00 00"}))
            .empty());
  CHECK(told(crossing(one, {"wait 1 s", "> 40 00 10 00 00 00 00 00", "< 81 41 41 41 41 41 41 41",
                            "< 43 00 10 00 91 01 00 00"}))
            .empty());
  CHECK(told(crossing(one, {"wait 1 s", "> 80 08 10 00 00 00 04 05", "< 81 41 41 41 41 41 41 41"})).empty());
  // Where no block transfer can be meant, an abort has its reserved bits 0.
  CHECK(told(crossing({}, {"> 40 FF FF 00 00 00 00 00", "< 81 FF FF 00 00 00 02 06"})) ==
        Told{"fail SDO-GEN-06 in frame 6"});
}

TEST_CASE("A client that acknowledges at once gets the next sub-block, also one with the same bytes") {
  auto lines = block_upload;
  lines.insert(lines.end(), {"> A2 02 02 00 00 00 00 00", block_upload[3], block_upload[4], block_upload[3]});
  CHECK(told(crossing(lines, {})).empty());
  lines.back() = "< 01 55 55 55 55 55 55 55";
  CHECK(told(crossing(lines, {})) == Told{"fail SDO-BUP-26 in frame 13"});
}
