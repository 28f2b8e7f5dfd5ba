// SPDX-License-Identifier: Apache-2.0
// The words of the console for every kind of frame.
#include "canopen/decode.hpp"

#include "catch.hpp"

using namespace conform;
using namespace conform::canopen;

namespace {

struct Listener {
  Decoder decoder{NodeId{5}};
  std::string sent(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
    return decoder.meaning(can::data_frame(CanId{id}, bytes), can::Direction::transmitted);
  }
  std::string got(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
    return decoder.meaning(can::data_frame(CanId{id}, bytes), can::Direction::received);
  }
};

}  // namespace

TEST_CASE("Expedited SDO transfers are named with object and data") {
  Listener bus;
  CHECK(bus.sent(0x605, {0x40, 0x03, 0x10, 0, 0, 0, 0, 0}) == "SDO upload request 1003h:00");
  CHECK(bus.got(0x585, {0x80, 0x03, 0x10, 0, 0x30, 0, 0x09, 0x06}) ==
        "SDO abort 1003h:00: 0609 0030h (invalid value)");
  CHECK(bus.got(0x585, {0x43, 0x00, 0x10, 0, 0x91, 0x01, 0, 0}) ==
        "SDO upload response 1000h:00 = 91 01 00 00 (4 bytes)");
  CHECK(bus.got(0x585, {0x42, 0x00, 0x10, 0, 0x91, 0x01, 0, 0}) ==
        "SDO upload response 1000h:00 = 91 01 00 00 (size not told)");
  CHECK(bus.sent(0x605, {0x2B, 0x17, 0x10, 0, 0xE8, 0x03, 0, 0}) ==
        "SDO download request 1017h:00 = E8 03 (2 bytes)");
  CHECK(bus.got(0x585, {0x60, 0x17, 0x10, 0, 0, 0, 0, 0}) == "SDO download response 1017h:00");
  CHECK(bus.got(0x585, {0x60, 0x17}) == "SDO response of 2 bytes instead of 8");
  CHECK(bus.sent(0x605, {}) == "SDO request of 0 bytes instead of 8");
  CHECK(bus.sent(0x605, {0xE0, 0, 0, 0, 0, 0, 0, 0}) == "SDO request with unknown command E0h");
}

TEST_CASE("Segments are named with the object of their transfer") {
  Listener bus;
  CHECK(bus.sent(0x605, {0x40, 0x08, 0x10, 0, 0, 0, 0, 0}) == "SDO upload request 1008h:00");
  CHECK(bus.got(0x585, {0x41, 0x08, 0x10, 0, 9, 0, 0, 0}) ==
        "SDO upload response 1008h:00, segmented, 9 bytes");
  CHECK(bus.sent(0x605, {0x60, 0, 0, 0, 0, 0, 0, 0}) == "SDO upload segment request 1008h:00, toggle 0");
  CHECK(bus.got(0x585, {0x00, 1, 2, 3, 4, 5, 6, 7}) == "SDO upload segment 1008h:00, toggle 0, 7 bytes");
  CHECK(bus.sent(0x605, {0x70, 0, 0, 0, 0, 0, 0, 0}) == "SDO upload segment request 1008h:00, toggle 1");
  CHECK(bus.got(0x585, {0x1B, 1, 2, 0, 0, 0, 0, 0}) ==
        "SDO upload segment 1008h:00, toggle 1, 2 bytes, last");
  CHECK(bus.sent(0x605, {0x60, 0, 0, 0, 0, 0, 0, 0}) == "SDO upload segment request, toggle 0");
  CHECK(bus.sent(0x605, {0x20, 0x08, 0x10, 0, 0, 0, 0, 0}) ==
        "SDO download request 1008h:00, segmented, size not told");
  CHECK(bus.sent(0x605, {0x0D, 1, 0, 0, 0, 0, 0, 0}) ==
        "SDO download segment 1008h:00, toggle 0, 1 byte, last");
  CHECK(bus.got(0x585, {0x20, 0, 0, 0, 0, 0, 0, 0}) == "SDO download segment response 1008h:00, toggle 0");
}

TEST_CASE("Block segments are not mistaken for commands") {
  Listener bus;
  CHECK(bus.sent(0x605, {0xC6, 0x00, 0x20, 1, 10, 0, 0, 0}) ==
        "SDO block download request 2000h:01, 10 bytes");
  CHECK(bus.got(0x585, {0xA4, 0x00, 0x20, 1, 2, 0, 0, 0}) ==
        "SDO block download response 2000h:01, 2 segments per block");
  CHECK(bus.sent(0x605, {0x01, 1, 2, 3, 4, 5, 6, 7}) == "SDO block segment 1 2000h:01");
  CHECK(bus.sent(0x605, {0x82, 8, 9, 10, 0, 0, 0, 0}) == "SDO block segment 2 2000h:01, last");
  CHECK(bus.got(0x585, {0xA2, 2, 2, 0, 0, 0, 0, 0}) ==
        "SDO block download 2000h:01: segments up to 2 received, 2 in the next block");
  CHECK(bus.sent(0x605, {0xD1, 0x12, 0x34, 0, 0, 0, 0, 0}) ==
        "SDO block download end 2000h:01, 4 bytes unused in the last segment");
  CHECK(bus.got(0x585, {0xA1, 0, 0, 0, 0, 0, 0, 0}) == "SDO block download end confirmed 2000h:01");

  CHECK(bus.sent(0x605, {0xA4, 0x08, 0x10, 0, 127, 0, 0, 0}) ==
        "SDO block upload request 1008h:00, 127 segments per block");
  CHECK(bus.got(0x585, {0xC2, 0x08, 0x10, 0, 9, 0, 0, 0}) == "SDO block upload response 1008h:00, 9 bytes");
  CHECK(bus.sent(0x605, {0xA3, 0, 0, 0, 0, 0, 0, 0}) == "SDO block upload start 1008h:00");
  CHECK(bus.got(0x585, {0x01, 1, 2, 3, 4, 5, 6, 7}) == "SDO block segment 1 1008h:00");
  CHECK(bus.got(0x585, {0x82, 1, 2, 0, 0, 0, 0, 0}) == "SDO block segment 2 1008h:00, last");
  CHECK(bus.sent(0x605, {0xA2, 1, 127, 0, 0, 0, 0, 0}) ==
        "SDO block upload 1008h:00: segments up to 1 received, 127 in the next block");
  CHECK(bus.got(0x585, {0x81, 1, 2, 0, 0, 0, 0, 0}) == "SDO block segment 1 1008h:00, last");
  CHECK(bus.sent(0x605, {0xA2, 1, 127, 0, 0, 0, 0, 0}) ==
        "SDO block upload 1008h:00: segments up to 1 received, 127 in the next block");
  CHECK(bus.got(0x585, {0xD5, 0, 0, 0, 0, 0, 0, 0}) ==
        "SDO block upload end 1008h:00, 5 bytes unused in the last segment");
  CHECK(bus.sent(0x605, {0xA1, 0, 0, 0, 0, 0, 0, 0}) == "SDO block upload end confirmed 1008h:00");
  CHECK(bus.got(0x585, {0x80, 0x08, 0x10, 0, 0, 0, 0x04, 0x05}) ==
        "SDO abort 1008h:00: 0504 0000h (protocol timed out)");
}

TEST_CASE("NMT and error control frames are named with the node") {
  Listener bus;
  CHECK(bus.sent(0x000, {0x81, 5}) == "NMT reset node -> node 5");
  CHECK(bus.sent(0x000, {0x01, 0}) == "NMT start -> all nodes");
  CHECK(bus.sent(0x000, {0x55, 5}) == "NMT command 55h -> node 5");
  CHECK(bus.sent(0x000, {0x01}) == "NMT command with DLC 1 instead of 2");
  CHECK(bus.got(0x705, {0x00}) == "boot-up of node 5");
  CHECK(bus.got(0x705, {0x7F}) == "heartbeat of node 5: pre-operational");
  CHECK(bus.got(0x705, {0x85}) == "heartbeat of node 5: operational, toggle 1");
  CHECK(bus.got(0x705, {0x03}) == "heartbeat of node 5: undefined state 03h");
  CHECK(bus.got(0x705, {0x05, 0}) == "heartbeat of node 5: operational, DLC 2");
  CHECK(bus.got(0x705, {}) == "error control of node 5 without data");
  CHECK(bus.sent(0x77E, {0x05}) == "heartbeat of node 126: operational");
  CHECK(bus.decoder.meaning(can::remote_frame(CanId{0x705}, 1), can::Direction::transmitted) ==
        "guarding request to node 5");
}

TEST_CASE("EMCY, SYNC, TIME, PDOs and LSS are named") {
  Listener bus;
  CHECK(bus.got(0x085, {0x30, 0x81, 0x11, 0, 0, 0, 0, 0}) == "EMCY 8130h, error register 11h");
  CHECK(bus.got(0x085, {0x30, 0x81}) == "EMCY with DLC 2 instead of 8");
  CHECK(bus.sent(0x080, {}) == "SYNC");
  CHECK(bus.sent(0x080, {7}) == "SYNC, counter 7");
  CHECK(bus.sent(0x100, {0, 0, 0, 0, 1, 0}) == "TIME");
  CHECK(bus.sent(0x100, {0}) == "TIME with DLC 1 instead of 6");
  CHECK(bus.got(0x185, {1, 2}) == "TPDO 1");
  CHECK(bus.got(0x485, {1, 2}) == "TPDO 4");
  CHECK(bus.sent(0x305, {1}) == "RPDO 2");
  CHECK(bus.sent(0x7E5, {0x04, 1}) == "LSS request 04h");
  CHECK(bus.got(0x7E4, {0x44}) == "LSS response 44h");
  CHECK(bus.got(0x6A0, {1, 2}) == "CAN-ID 6A0h");
  CHECK(bus.decoder.meaning(can::remote_frame(CanId{0x185}, 8), can::Direction::transmitted) ==
        "remote request for TPDO 1");
  CHECK(bus.decoder.meaning(can::remote_frame(CanId{0x6A0}, 8), can::Direction::transmitted) ==
        "remote frame 6A0h");
}

TEST_CASE("Frames that are no base data frames say so") {
  Listener bus;
  can::Frame extended = can::data_frame(CanId{0x605}, {1});
  extended.extended = true;
  CHECK(bus.decoder.meaning(extended, can::Direction::received) == "29-bit CAN-ID 605h");
  can::Frame error;
  error.error = true;
  CHECK(bus.decoder.meaning(error, can::Direction::received) == "error frame");
}

TEST_CASE("What the tester sends with an identifier of the device is marked") {
  Listener bus;
  CHECK(bus.sent(0x705, {0x05}) == "heartbeat of node 5: operational (sent by the tester)");
  CHECK(bus.sent(0x185, {0x05}) == "TPDO 1 (sent by the tester)");
}

TEST_CASE("Moved COB-IDs are followed until a reset") {
  Listener bus;
  bus.decoder.set_emcy_can_id(CanId{0x6A0});
  bus.decoder.set_sync_can_id(CanId{0x6A1});
  bus.decoder.set_time_can_id(std::nullopt);
  bus.decoder.set_tpdo_can_id(1, std::nullopt);
  bus.decoder.set_rpdo_can_id(17, CanId{0x6A2});
  CHECK(bus.got(0x6A0, {0x30, 0x81, 0x11, 0, 0, 0, 0, 0}) == "EMCY 8130h, error register 11h");
  CHECK(bus.got(0x085, {0x30, 0x81, 0x11, 0, 0, 0, 0, 0}) == "CAN-ID 085h");
  CHECK(bus.sent(0x6A1, {}) == "SYNC");
  CHECK(bus.sent(0x100, {0, 0, 0, 0, 1, 0}) == "CAN-ID 100h");
  CHECK(bus.got(0x185, {1}) == "CAN-ID 185h");
  CHECK(bus.sent(0x6A2, {1}) == "RPDO 17");
  bus.decoder.reset();
  CHECK(bus.got(0x185, {1}) == "TPDO 1");
  CHECK(bus.sent(0x6A2, {1}) == "CAN-ID 6A2h");
  CHECK(bus.got(0x085, {0, 0, 0, 0, 0, 0, 0, 0}) == "EMCY 0000h, error register 00h");
}

TEST_CASE("Any sequence of frames has a meaning") {
  Listener bus;
  std::uint32_t state = 1;  // xorshift: the same frames in every run
  const auto next = [&state] {
    state ^= state << 13U;
    state ^= state >> 17U;
    state ^= state << 5U;
    return state;
  };
  for (int i = 0; i < 20000; ++i) {
    can::Frame frame;
    const std::uint32_t choice = next();
    // Mostly the SDO channel, where the decoder keeps a state.
    frame.id = choice % 4 == 0 ? next() % 0x800U : choice % 4 == 1 ? 0x605U : 0x585U;
    frame.dlc = static_cast<std::uint8_t>(choice % 8 == 7 ? next() % 16U : 8U);
    frame.remote = next() % 64 == 0;
    for (auto& byte : frame.data) byte = static_cast<std::uint8_t>(next() >> 7U);
    const auto direction = next() % 2 == 0 ? can::Direction::received : can::Direction::transmitted;
    if (bus.decoder.meaning(frame, direction).empty()) FAIL("frame " << i);
  }
}
