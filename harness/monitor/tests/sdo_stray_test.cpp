// SPDX-License-Identifier: Apache-2.0
// Devices that answer aborts, or what is no request: the blame falls on that, and not on what comes next.
#include "trace.hpp"

using namespace conform;
using namespace conform::monitor::testing;

namespace {
const std::string upload = "> 40 00 10 00 00 00 00 00", answer = "< 43 00 10 00 91 01 00 00";
const std::string other = "> 40 01 10 00 00 00 00 00", other_answer = "< 4F 01 10 00 00 00 00 00";
}  // namespace

TEST_CASE("Segments that answer the start of a block upload that is not open are no aborts") {
  CHECK(told(after_exchanges({"> A3 00 00 00 00 00 00 00", "< 81 00 00 00 00 00 00 00", upload, answer}))
            .empty());
  CHECK(told(after_exchanges({"> A3 00 00 00 00 00 00 00", "< 01 41 42 43 44 45 46 47",
                              "< 82 00 00 00 00 00 00 00", upload, answer}))
            .empty());
  CHECK(told(after_exchanges({"> A2 00 7F 00 00 00 00 00", "< 81 00 00 00 00 00 00 00", upload, answer}))
            .empty());
  CHECK(told(after_exchanges({"> A0 08 10 00 7F 00 00 00", "< 81 41 42 43 44 45 46 47", upload, answer}))
            .empty());
  // An abort with reserved bits set remains one.
  CHECK(told(after_exchanges({"> 40 FF FF 00 00 00 00 00", "< 81 FF FF 00 00 00 02 06"})) ==
        Told{"fail SDO-GEN-06 in frame 6"});
}

TEST_CASE(
    "An answer to the client's abort that comes behind the next request is not taken for the answer to that") {
  CHECK(told(after_exchanges({"> 80 17 10 00 00 00 00 08", upload, "< 80 17 10 00 00 00 00 08", answer, other,
                              other_answer})) == Told{"fail SDO-ERR-03 in frame 7"});
  CHECK(told(after_exchanges({"> 21 17 10 00 02 00 00 00", "< 60 17 10 00 00 00 00 00",
                              "> 80 17 10 00 00 00 00 08", upload, "< 80 17 10 00 00 00 00 08", answer})) ==
        Told{"fail SDO-GEN-04 in frame 9"});
}

TEST_CASE("Behind an answered request no abort of the server answers the client's abort any more") {
  // A server that is busy with 1000h says so by its name.
  CHECK(told(after_exchanges({"> 80 00 10 00 00 00 00 08", other, other_answer, "> 40 00 10 00 00 00 00 00",
                              other, "< 41 00 10 00 04 00 00 00", "< 80 00 10 00 01 00 04 05"}))
            .empty());
  // ... nor where the server, too, had given up before, and one request may still be open.
  CHECK(told(after_exchanges({"> 40 08 10 00 00 00 00 00", "< 41 08 10 00 09 00 00 00",
                              "> 70 00 00 00 00 00 00 00", "< 80 08 10 00 00 00 04 05",
                              "> 80 08 10 00 00 00 00 08", "> 40 08 10 00 00 00 00 00",
                              "< 41 08 10 00 09 00 00 00", "> 60 00 00 00 00 00 00 00",
                              "< 00 41 42 43 44 45 46 47", upload, "< 80 08 10 00 01 00 04 05"}))
            .empty());
  // ... nor where the client gives up 1000h before the server has told that it is busy.
  CHECK(told(after_exchanges({"> 40 00 10 00 00 00 00 00", other, "< 41 00 10 00 04 00 00 00",
                              "> 80 00 10 00 00 00 00 08", "< 80 00 10 00 01 00 04 05"}))
            .empty());
}

TEST_CASE("Where an abort may answer the client's abort or its next request, one answer more may come") {
  CHECK(told(after_exchanges({"> 80 00 10 00 00 00 00 08", upload, "< 80 00 10 00 01 00 04 05", answer, other,
                              other_answer}))
            .empty());
  CHECK(told(after_exchanges({"> 80 17 10 00 00 00 00 08", upload, "< 80 00 00 00 01 00 04 05", answer, other,
                              other_answer}))
            .empty());
  // The client gave up 0000h:00, which is also what an unknown command is said to be about.
  CHECK(told(after_exchanges({"> 80 00 00 00 00 00 00 08", "> B8 00 10 00 14 00 00 00",
                              "< 80 00 00 00 01 00 04 05", other, other_answer}))
            .empty());
  // ... and under the name of whatever was before, which is another matter.
  CHECK(told(after_exchanges({"> 80 18 10 01 00 00 00 08", "> B8 00 10 00 14 00 00 00",
                              "< 80 18 10 01 01 00 04 05", other, other_answer})) ==
        Told{"warn SDO-ERR-04 in frame 7"});
  // The client took the abort for the answer and gave up in its turn.
  CHECK(told(after_exchanges({"> 80 00 10 00 00 00 00 08", upload, "< 80 00 10 00 01 00 04 05",
                              "> 80 00 10 00 00 00 00 08", answer, other, other_answer}))
            .empty());
  CHECK(told(after_exchanges({upload, "wait 1 s", "> 80 00 10 00 00 00 04 05", "< 80 00 10 00 01 00 04 05",
                              answer, other, other_answer}))
            .empty());
  // ... but two are one too many.
  CHECK(told(after_exchanges({"> 80 00 10 00 00 00 00 08", upload, "< 80 00 10 00 01 00 04 05", answer,
                              answer})) == Told{"fail SDO-GEN-04 in frame 9"});
}

TEST_CASE("A segment of zero bytes in a sub-block is not the one answer more that may come") {
  std::vector<std::string> lines{"> 80 17 10 00 00 00 00 08", "> 60 00 00 00 00 00 00 00",
                                 "< 80 00 00 00 01 00 04 05", "> A0 08 10 00 7F 00 00 00",
                                 "< C0 08 10 00 00 00 00 00", "> A3 00 00 00 00 00 00 00"};
  for (int number = 1; number <= 66; ++number)
    lines.push_back("< " + hex_bytes(Bytes{static_cast<std::uint8_t>(number), 0, 0, 0, 0, 0, 0, 0}));
  CHECK(told(after_exchanges(lines)).empty());
}

TEST_CASE("What answers an abort is an abort") {
  CHECK(told(after_exchanges({"> 80 00 10 00 00 00 00 08", answer})) == Told{"fail SDO-GEN-04 in frame 6"});
}

TEST_CASE("An answer to our own abort is not taken for one to a request to another node") {
  CHECK(told(after_exchanges({"> 602: 40 00 10 00 00 00 00 00", "> 80 00 10 00 00 00 00 08",
                              "< 80 00 10 00 00 00 00 08"})) == Told{"fail SDO-ERR-03 in frame 7"});
  CHECK(told(after_exchanges({"> 602: 40 00 10 00 00 00 00 00", "> 80 00 10 00 00 00 00 08", upload,
                              "< 80 00 10 00 00 00 00 08", answer}))
            .empty());
}
