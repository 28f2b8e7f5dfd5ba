// SPDX-License-Identifier: Apache-2.0
#include "canopen/frame_fields.hpp"

#include "canopen/decode.hpp"
#include "catch.hpp"

using namespace conform;
using namespace conform::canopen;

namespace {

std::vector<FrameField> fields(std::uint32_t id, std::initializer_list<std::uint8_t> bytes,
                               std::string_view meaning = {}) {
  const auto frame = can::data_frame(CanId(id), bytes);
  Decoder decoder(NodeId(5));
  return fields_of(frame, meaning.empty() ? decoder.meaning(frame, can::Direction::received) : meaning);
}

}  // namespace

TEST_CASE("two SDO answers differ by the fields that differ") {
  const auto confirmed = fields(0x585, {0x4B, 0x00, 0x10, 0x02, 0x91, 0x01, 0, 0});
  const auto other = fields(0x585, {0x4B, 0x00, 0x10, 0x02, 0x92, 0x01, 0, 0});
  CHECK(differences(confirmed, confirmed).empty());
  CHECK(differences(confirmed, other) == std::vector<FieldDifference>{{"data", "91 01", "92 01"}});
  const auto abort = fields(0x585, {0x80, 0x00, 0x10, 0x02, 0x11, 0, 0x09, 0x06});
  const auto between = differences(abort, confirmed);
  REQUIRE(between.size() >= 2);
  CHECK(between[0] == FieldDifference{"command", "80h", "4Bh"});
  CHECK(between[1].name == "abort code");
  CHECK(between[1].before.starts_with("0609 0011h"));
  CHECK(between[1].after.empty());
}

TEST_CASE("an abort, an EMCY, a heartbeat and a segment are told by their fields") {
  CHECK(fields(0x585, {0x80, 0x03, 0x10, 0, 0x30, 0, 0x09, 0x06})[2] == FrameField{"object", "1003h:00"});
  const auto emcy = fields(0x085, {0x10, 0x81, 0x11, 1, 2, 3, 4, 5});
  REQUIRE(emcy.size() == 4);
  CHECK(emcy[1].name == "error code");
  CHECK(emcy[2] == FrameField{"error register", "11h"});
  CHECK(emcy[3] == FrameField{"manufacturer's bytes", "01 02 03 04 05"});
  CHECK(fields(0x705, {0x85}) ==
        std::vector<FrameField>{{"length", "1"}, {"toggle", "1"}, {"state", "operational"}});
  CHECK(fields(0x585, {0x07, 'a', 'b', 'c', 'd', 0, 0, 0}, "SDO upload segment")[2] ==
        FrameField{"toggle", "0"});
  CHECK(fields(0x585, {0x83, 1, 2, 3, 4, 5, 6, 7}, "SDO block segment 3, last")[2] ==
        FrameField{"sequence number", "3"});
}

TEST_CASE("every byte of any frame is in some field, and two different frames never look the same") {
  const auto one = can::data_frame(CanId(0x585), {0x60, 1, 2, 3, 4, 5, 6, 7});
  for (const std::string_view meaning :
       {"SDO abort", "SDO upload response", "SDO download response", "SDO upload segment 1000h:00",
        "SDO block segment 1", "SDO response with unknown command", "SDO upload segment request",
        "EMCY 1234h", "TPDO 1", "CAN-ID 585h"}) {
    for (std::size_t i = 0; i < 8; ++i) {
      auto other = one;
      other.data.at(i) ^= 0x80U;
      INFO(meaning << ", byte " << i);
      CHECK(fields_of(one, meaning) != fields_of(other, meaning));
    }
  }
  auto shorter = one;
  shorter.dlc = 7;
  CHECK(fields_of(one, "CAN-ID 585h") != fields_of(shorter, "CAN-ID 585h"));
}
