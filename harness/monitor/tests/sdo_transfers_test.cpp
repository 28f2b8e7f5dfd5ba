// SPDX-License-Identifier: Apache-2.0
// Segmented and block transfers.
#include "canopen/sdo_block.hpp"
#include "trace.hpp"

using namespace conform;
using namespace conform::monitor::testing;
using result::Verdict;

namespace {

const std::string ask_0 = "> 60 00 00 00 00 00 00 00", ask_1 = "> 70 00 00 00 00 00 00 00";

std::vector<std::string> upload(const std::vector<std::string>& rest) {
  std::vector<std::string> out{"> 40 08 10 00 00 00 00 00", "< 41 08 10 00 09 00 00 00"};
  out.insert(out.end(), rest.begin(), rest.end());
  return after_exchanges(out);
}

/// Block upload of nine bytes 1..9 with CRC, answered by `end`.
std::vector<std::string> block_upload(const std::string& initiate, const std::vector<std::string>& rest) {
  std::vector<std::string> out{"> A4 08 10 00 7F 00 00 00", initiate, "> A3 00 00 00 00 00 00 00"};
  out.insert(out.end(), rest.begin(), rest.end());
  return after_exchanges(out);
}
const std::string sized = "< C6 08 10 00 09 00 00 00", unsized = "< C0 08 10 00 00 00 00 00";
const std::string segment_1 = "< 01 01 02 03 04 05 06 07", segment_2 = "< 82 08 09 00 00 00 00 00";
const std::string acknowledge = "> A2 02 7F 00 00 00 00 00", end_seen = "> A1 00 00 00 00 00 00 00";

std::string end_frame(unsigned n, std::uint16_t crc) {
  return "< " +
         hex_bytes(Bytes{static_cast<std::uint8_t>(0xC1U | (n << 2U)), static_cast<std::uint8_t>(crc & 0xFFU),
                         static_cast<std::uint8_t>(crc >> 8U), 0, 0, 0, 0, 0});
}
const std::uint16_t crc_of_nine = canopen::block_crc(Bytes{1, 2, 3, 4, 5, 6, 7, 8, 9});

}  // namespace

TEST_CASE("A segmented upload delivers its size with mirrored toggle bits") {
  CHECK(told(upload({ask_0, "< 00 31 32 33 34 35 36 37", ask_1, "< 1B 38 39 00 00 00 00 00"})).empty());
  CHECK(told(upload({ask_0, "< 00 31 32 33 34 35 36 37", ask_1, "< 0B 38 39 00 00 00 00 00"})) ==
        Told{"fail SDO-SUP-03 in frame 10"});
  CHECK(told(upload({ask_0, "< 00 31 32 33 34 35 36 37", ask_1, "< 19 38 39 00 00 00 00 00"})) ==
        Told{"fail SDO-SUP-02 in frame 10"});
  CHECK(told(upload({ask_0, "< 00 31 32 33 34 35 36 37", ask_1, "< 10 38 39 00 00 00 00 00"})) ==
        Told{"fail SDO-SUP-02 in frame 10"});
}

TEST_CASE("A wrong toggle bit of the client makes no finding, whatever the server does with it") {
  CHECK(told(upload({ask_1, "< 80 08 10 00 00 00 03 05"})).empty());
  CHECK(told(upload(
                 {ask_1, "wait 1 s", ask_0, "< 00 31 32 33 34 35 36 37", ask_1, "< 1B 38 39 00 00 00 00 00"}))
            .empty());
  CHECK(told(upload({ask_0, "< 00 31 32 33 34 35 36 37", ask_0, "< 00 31 32 33 34 35 36 37", ask_1,
                     "< 1B 38 39 00 00 00 00 00"}))
            .empty());
}

TEST_CASE("The abort of a segment names the object of the transfer") {
  CHECK(told(upload({ask_1, "< 80 00 00 00 00 00 03 05"})) == Told{"fail SDO-ERR-04 in frame 8"});
}

TEST_CASE("The toggle bit of download segments is mirrored") {
  const std::vector<std::string> begin{"> 21 17 10 00 09 00 00 00", "< 60 17 10 00 00 00 00 00",
                                       "> 00 01 02 03 04 05 06 07", "< 20 00 00 00 00 00 00 00",
                                       "> 1B 08 09 00 00 00 00 00"};
  auto right = begin, wrong = begin;
  right.emplace_back("< 30 00 00 00 00 00 00 00");
  wrong.emplace_back("< 20 00 00 00 00 00 00 00");
  CHECK(told(after_exchanges(right)).empty());
  CHECK(told(after_exchanges(wrong)) == Told{"fail SDO-SDN-03 in frame 10"});
}

TEST_CASE("A block upload with the right numbers, n and CRC") {
  const auto cases = judged(
      trace(block_upload(sized, {segment_1, segment_2, acknowledge, end_frame(5, crc_of_nine), end_seen,
                                 "> 40 00 10 00 00 00 00 00", "< 43 00 10 00 91 01 00 00"})));
  CHECK(told(cases).empty());
  const auto found = std::ranges::find(cases, "monitor/sdo-block-upload", &result::CaseResult::id);
  for (const auto& judgement : found->judgements) {
    INFO(judgement.requirement);
    CHECK(judgement.verdict ==
          (judgement.requirement == "SDO-BUP-03" ? Verdict::not_applicable : Verdict::pass));
  }
  CHECK(verdict_of(cases, "monitor/sdo-size") == Verdict::pass);
}

TEST_CASE("Wrong CRC, wrong n, wrong size and wrong numbers of a block upload") {
  const auto end_of = [](const std::string& initiate, const std::string& end) {
    return told(block_upload(initiate, {segment_1, segment_2, acknowledge, end}));
  };
  CHECK(end_of(sized, end_frame(5, 0x1234)) == Told{"fail SDO-BUP-02 in frame 11"});
  CHECK(end_of(sized, end_frame(4, crc_of_nine)) == Told{"fail SDO-BUP-22 in frame 11"});
  CHECK(end_of(unsized, end_frame(5, 0)).empty());
  CHECK(end_of(unsized, end_frame(5, 0x1234)) == Told{"warn SDO-BUP-03 in frame 11"});
  CHECK(end_of("< C6 08 10 00 20 00 00 00", end_frame(5, crc_of_nine)) ==
        Told{"fail SDO-BUP-04 in frame 11"});
  CHECK(told(block_upload(sized, {"< 00 01 02 03 04 05 06 07"})) == Told{"fail SDO-BUP-05 in frame 8"});
  CHECK(told(block_upload(sized, {segment_1, "< 83 08 09 00 00 00 00 00"})) ==
        Told{"fail SDO-BUP-05 in frame 9"});
  CHECK(told(block_upload(sized, {segment_1, "< 02 08 09 00 00 00 00 00"})) ==
        Told{"fail SDO-BUP-04 in frame 9"});
}

TEST_CASE("A sub-block has not more segments than the client wants") {
  const std::vector<std::string> begin{"> A0 08 10 00 01 00 00 00", "< C0 08 10 00 00 00 00 00",
                                       "> A3 00 00 00 00 00 00 00", "< 01 01 02 03 04 05 06 07"};
  const auto with = [&](std::vector<std::string> rest) {
    auto lines = begin;
    lines.insert(lines.end(), rest.begin(), rest.end());
    return told(after_exchanges(lines));
  };
  CHECK(with({"< 82 08 09 00 00 00 00 00"}) == Told{"fail SDO-BUP-26 in frame 9"});
  CHECK(with({"> A2 01 02 00 00 00 00 00", "< 81 08 09 00 00 00 00 00", "> A2 01 02 00 00 00 00 00",
              end_frame(5, 0), end_seen})
            .empty());
  // The server repeats the sub-block after its own time-out.
  CHECK(with({"wait 3 s", "< 01 01 02 03 04 05 06 07"}).empty());
  CHECK(with({"wait 3 s", "< 80 08 10 00 00 00 04 05"}).empty());
}

TEST_CASE("Segments sent again are counted once") {
  CHECK(told(block_upload(sized,
                          {segment_1, segment_2, "> A2 01 7F 00 00 00 00 00", "< 81 08 09 00 00 00 00 00",
                           "> A2 01 7F 00 00 00 00 00", end_frame(5, crc_of_nine), end_seen}))
            .empty());
  CHECK(told(block_upload(sized, {segment_1, segment_2, "> A2 00 7F 00 00 00 00 00", segment_1, segment_2,
                                  acknowledge, end_frame(5, crc_of_nine), end_seen}))
            .empty());
}

TEST_CASE("Segments in the queue may follow a client abort") {
  CHECK(told(block_upload(unsized, {segment_1, "> 80 08 10 00 00 00 00 08", "< 02 01 02 03 04 05 06 07",
                                    "< 03 01 02 03 04 05 06 07", "> 40 00 10 00 00 00 00 00",
                                    "< 04 01 02 03 04 05 06 07", "< 43 00 10 00 91 01 00 00"}))
            .empty());
}

TEST_CASE("A client that acknowledges in the middle of a sub-block makes no finding") {
  CHECK(told(block_upload(unsized, {segment_1, "> A2 01 7F 00 00 00 00 00", "< 02 01 02 03 04 05 06 07",
                                    "< 01 01 02 03 04 05 06 07", "< 82 01 02 03 04 05 06 07"}))
            .empty());
}

TEST_CASE("With a protocol switch threshold a normal upload answers") {
  CHECK(told(after_exchanges({"> A0 00 10 00 7F 04 00 00", "< 43 00 10 00 91 01 00 00",
                              "> A0 08 10 00 7F FF 00 00", "< 41 08 10 00 09 00 00 00", ask_0,
                              "< 00 31 32 33 34 35 36 37", ask_1, "< 1B 38 39 00 00 00 00 00"}))
            .empty());
}

TEST_CASE("A block download and the block size the server gives") {
  const auto with = [](const std::string& block_size, const std::string& next) {
    return told(after_exchanges({"> C6 17 10 00 09 00 00 00", "< A4 17 10 00 " + block_size + " 00 00 00",
                                 "> 01 01 02 03 04 05 06 07", "> 82 08 09 00 00 00 00 00",
                                 "< A2 02 " + next + " 00 00 00 00 00", "> D5 00 00 00 00 00 00 00",
                                 "< A1 00 00 00 00 00 00 00", "> 40 00 10 00 00 00 00 00",
                                 "< 43 00 10 00 91 01 00 00", "< 43 00 10 00 91 01 00 00"}));
  };
  CHECK(with("7F", "7F") == Told{"fail SDO-GEN-04 in frame 14"});
  CHECK(with("02", "01") == Told{"fail SDO-GEN-04 in frame 14"});
  CHECK(with("80", "7F") == Told{"fail SDO-BDN-05 in frame 6"});
  CHECK(with("7F", "80") == Told{"fail SDO-GEN-04 in frame 14", "fail SDO-BDN-05 in frame 9"});
}

TEST_CASE("Behind the last segment of a block download no block size is needed") {
  const auto with = [](const std::string& last, const std::string& taken) {
    return told(after_exchanges({"> C2 17 10 00 0E 00 00 00", "< A0 17 10 00 02 00 00 00",
                                 "> 01 01 02 03 04 05 06 07", "> " + last + " 08 09 0A 0B 0C 0D 0E",
                                 "< A2 " + taken + " 00 00 00 00 00 00"}));
  };
  CHECK(with("82", "02").empty());
  CHECK(with("82", "01") == Told{"fail SDO-BDN-05 in frame 9"});
  CHECK(with("02", "02") == Told{"fail SDO-BDN-05 in frame 9"});
}

TEST_CASE("A gap in a block download may be acknowledged at once, at the end, or after a time-out") {
  const std::vector<std::string> begin{"> C0 17 10 00 00 00 00 00", "< A0 17 10 00 04 00 00 00",
                                       "> 01 01 02 03 04 05 06 07"};
  const auto with = [&](std::vector<std::string> rest) {
    auto lines = begin;
    lines.insert(lines.end(), rest.begin(), rest.end());
    return told(after_exchanges(lines));
  };
  CHECK(with({"> 03 01 02 03 04 05 06 07", "< A2 01 04 00 00 00 00 00", "> 04 01 02 03 04 05 06 07",
              "> 01 01 02 03 04 05 06 07"})
            .empty());
  CHECK(with({"wait 3 s", "< A2 01 04 00 00 00 00 00"}).empty());
  CHECK(
      with({"> 80 17 10 00 00 00 00 08", "> 40 00 10 00 00 00 00 00", "< 43 00 10 00 91 01 00 00"}).empty());
  CHECK(with({"> 40 00 10 00 00 00 00 00", "< 80 17 10 00 03 00 04 05"}).empty());
}

TEST_CASE("Segments that were on their way when the server aborted a block download may be answered, too") {
  CHECK(told(after_exchanges({"> C0 00 16 00 00 00 00 00", "< A4 00 16 00 7F 00 00 00",
                              "> 01 01 02 03 04 05 06 07", "> 02 01 02 03 04 05 06 07",
                              "> 03 01 02 03 04 05 06 07", "< 80 00 16 00 12 00 07 06",
                              "< 80 00 00 00 01 00 04 05", "< 80 00 00 00 01 00 04 05"}))
            .empty());
  CHECK(told(after_exchanges({"> C0 00 16 00 00 00 00 00", "< A4 00 16 00 7F 00 00 00",
                              "> 01 01 02 03 04 05 06 07", "> 02 01 02 03 04 05 06 07",
                              "> 83 01 02 03 04 05 06 07", "< 80 00 16 00 12 00 07 06",
                              "< 80 00 00 00 01 00 04 05"}))
            .empty());
}

TEST_CASE("A client that never waits gets every answer of a slow server") {
  const std::string no_transfer = "< 80 00 00 00 01 00 04 05";
  CHECK(told(judged(trace({"< 701: 00", "> 00 00 00 00 00 00 64 00", "> 00 00 00 00 00 00 00 00",
                           "> 38 00 00 00 00 00 3F 00", no_transfer, "> 00 67 33 A1 32 01 00 00", no_transfer,
                           "> 2B 4F 26", "< 80 00 00 00 00 00 02 06", no_transfer})))
            .empty());
  // The same request again and again does not tell how far behind the server is.
  const std::string read_only = "< 80 00 10 00 02 00 01 06", write = "> 22 00 10 00 80 44 04 00";
  CHECK(told(judged(trace({"< 701: 00", "> 00 61 00 35 64 00 87 87", write, no_transfer, read_only, write,
                           write, read_only, write, read_only, write, read_only, "> 00 80 80 80 80 80 80 80",
                           read_only, "> 10 80 80 80 80 80 80 80", no_transfer, no_transfer})))
            .empty());
}
