// SPDX-License-Identifier: Apache-2.0
// Codes and layouts of the single messages, as the tables of CiA 301 print them.
#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/emcy.hpp"
#include "canopen/nmt.hpp"
#include "canopen/sdo_initiate.hpp"
#include "canopen/sdo_segment.hpp"
#include "canopen/short_entries.hpp"

#include "catch.hpp"

using namespace conform;
using namespace conform::canopen;

namespace {
constexpr Multiplexer error_count{Index{0x1003}, SubIndex{0}};
constexpr Multiplexer heartbeat_time{Index{0x1017}, SubIndex{0}};
constexpr Multiplexer identity_sub_2{Index{0x1018}, SubIndex{2}};
}  // namespace

TEST_CASE("Abort codes have a meaning in a few words, reserved ones have none") {
  CHECK(abort_codes().size() == 31);
  CHECK(meaning(AbortCode{0x06090030}) == "invalid value");
  CHECK(meaning(AbortCode{0x05030000}) == "toggle bit not alternated");
  CHECK(meaning(AbortCode{0x08000024}) == "no data available");
  CHECK(meaning(AbortCode{0x06090033}).empty());
  CHECK(meaning(AbortCode{0}).empty());
  CHECK(meaning(AbortCode{0xFFFFFFFF}).empty());
  CHECK(describe(abort::invalid_value) == "0609 0030h (invalid value)");
  CHECK(describe(AbortCode{0x12345678}) == "1234 5678h (reserved code)");
}

TEST_CASE("NMT commands are two bytes on CAN-ID 000h") {
  const NodeId node{5};
  CHECK(encode(NmtCommand::start, node) == can::data_frame(CanId{0}, {0x01, 0x05}));
  CHECK(encode(NmtCommand::stop, node) == can::data_frame(CanId{0}, {0x02, 0x05}));
  CHECK(encode(NmtCommand::pre_operational, node) == can::data_frame(CanId{0}, {0x80, 0x05}));
  CHECK(encode(NmtCommand::reset_node, node) == can::data_frame(CanId{0}, {0x81, 0x05}));
  CHECK(encode(NmtCommand::reset_communication, NodeId{127}) == can::data_frame(CanId{0}, {0x82, 0x7F}));
  CHECK(encode_broadcast(NmtCommand::start) == can::data_frame(CanId{0}, {0x01, 0x00}));
}

TEST_CASE("NMT words are read back") {
  for (const char* word : {"start", "stop", "pre-operational", "reset node", "reset communication"}) {
    const auto command = parse_nmt_command(word);
    REQUIRE(command.has_value());
    CHECK(to_string(*command) == word);
  }
  CHECK_FALSE(parse_nmt_command("reset").has_value());
  CHECK(nmt_command_at(0x82) == NmtCommand::reset_communication);
  CHECK_FALSE(nmt_command_at(0x83).has_value());
  CHECK(parse_nmt_state("pre-operational") == NmtState::pre_operational);
  CHECK(to_string(NmtState::stopped) == "stopped");
  CHECK_FALSE(nmt_state_at(0x06).has_value());
}

TEST_CASE("Error control messages carry a state and a toggle bit") {
  const NodeId node{5};
  const auto boot = decode_error_control(can::data_frame(CanId{0x705}, {0x00}), node);
  REQUIRE(boot.has_value());
  CHECK(boot->is_boot_up());
  const auto guard = decode_error_control(can::data_frame(CanId{0x705}, {0xFF}), node);
  REQUIRE(guard.has_value());
  CHECK(guard->state == NmtState::pre_operational);
  CHECK(guard->toggle);
  CHECK_FALSE(guard->is_boot_up());
  const auto undefined = decode_error_control(can::data_frame(CanId{0x705}, {0x03}), node);
  REQUIRE(undefined.has_value());
  CHECK(undefined->code == 3);
  CHECK_FALSE(undefined->state.has_value());
  CHECK_FALSE(decode_error_control(can::data_frame(CanId{0x706}, {0x05}), node).has_value());
  CHECK_FALSE(decode_error_control(can::data_frame(CanId{0x705}, {}), node).has_value());
  CHECK_FALSE(decode_error_control(can::remote_frame(CanId{0x705}, 1), node).has_value());
  CHECK(encode_heartbeat(NodeId{0x7E}, NmtState::operational) == can::data_frame(CanId{0x77E}, {0x05}));
}

TEST_CASE("An emergency message is code, register and five bytes of the manufacturer") {
  const Bytes bytes{0x30, 0x81, 0x11, 1, 2, 3, 4, 5};
  const auto emcy = decode_emcy(bytes);
  REQUIRE(emcy.has_value());
  CHECK(emcy->code == 0x8130);
  CHECK(emcy->error_register == 0x11);
  CHECK(emcy->manufacturer == std::array<std::uint8_t, 5>{1, 2, 3, 4, 5});
  const auto encoded = encode(*emcy);
  CHECK(Bytes(encoded.begin(), encoded.end()) == bytes);
  CHECK_FALSE(decode_emcy(Bytes(7)).has_value());
  CHECK_FALSE(decode_emcy({}).has_value());
}

TEST_CASE("Error codes are named by the most specific class known") {
  CHECK(describe_emcy_code(0x8130) == "8130h (heartbeat or life guarding)");
  CHECK(describe_emcy_code(0x8131) == "8131h (communication)");
  CHECK(emcy_class(0x0000) == "error reset or no error");
  CHECK(emcy_class(0x2310) == "current, output side");
  CHECK(emcy_class(0xFF01) == "device specific");
  CHECK(emcy_class(0xA000).empty());
  CHECK(describe_emcy_code(0xA000) == "A000h (reserved class)");
}

TEST_CASE("The restricted CAN-IDs are those of table 40") {
  int count = 0;
  for (std::uint32_t id = 0; id <= 0x7FF; ++id) count += is_restricted(CanId{id}) ? 1 : 0;
  CHECK(count == 1 + 127 + 128 + 127 + 127 + 32 + 127 + 128);
  for (const std::uint32_t id : {0x000U, 0x001U, 0x07FU, 0x101U, 0x180U, 0x581U, 0x5FFU, 0x601U, 0x67FU,
                                 0x6E0U, 0x6FFU, 0x701U, 0x77FU, 0x780U, 0x7FFU}) {
    INFO(id);
    CHECK(is_restricted(CanId{id}));
  }
  for (const std::uint32_t id :
       {0x080U, 0x0FFU, 0x100U, 0x181U, 0x580U, 0x600U, 0x680U, 0x6DFU, 0x700U, 0x800U, 0x1FFFFFFFU}) {
    INFO(id);
    CHECK_FALSE(is_restricted(CanId{id}));
  }
}

TEST_CASE("The pre-defined connection set adds the node-ID to the function codes") {
  const ConnectionSet set = connection_set(NodeId{5});
  CHECK(set.emcy == CanId{0x085});
  CHECK(set.sdo_request == CanId{0x605});
  CHECK(set.sdo_response == CanId{0x585});
  CHECK(set.error_control == CanId{0x705});
  CHECK(set.tpdo[0] == CanId{0x185});
  CHECK(set.tpdo[3] == CanId{0x485});
  CHECK(set.rpdo[0] == CanId{0x205});
  CHECK(set.rpdo[3] == CanId{0x505});
}

TEST_CASE("COB-ID entries are recognised by their object") {
  const auto kind = [](std::uint16_t index, std::uint8_t sub) {
    return cob_id_kind({Index{index}, SubIndex{sub}});
  };
  CHECK(kind(0x1005, 0) == CobIdKind::sync);
  CHECK(kind(0x1012, 0) == CobIdKind::time);
  CHECK(kind(0x1014, 0) == CobIdKind::emcy);
  CHECK(kind(0x1028, 5) == CobIdKind::emcy_consumer);
  CHECK(kind(0x1200, 2) == CobIdKind::sdo);
  CHECK(kind(0x12FF, 1) == CobIdKind::sdo);
  CHECK(kind(0x1400, 1) == CobIdKind::rpdo);
  CHECK(kind(0x19FF, 1) == CobIdKind::tpdo);
  CHECK_FALSE(kind(0x1014, 1).has_value());
  CHECK_FALSE(kind(0x1028, 0).has_value());
  CHECK_FALSE(kind(0x1200, 3).has_value());
  CHECK_FALSE(kind(0x1400, 2).has_value());
  CHECK_FALSE(kind(0x1600, 1).has_value());
  CHECK_FALSE(kind(0x1015, 0).has_value());
}

TEST_CASE("The polarity of the control bits depends on the object") {
  CHECK(is_active(CobIdKind::emcy, CobId{0x0000'0085}));
  CHECK_FALSE(is_active(CobIdKind::emcy, CobId{0x8000'0085}));
  CHECK(is_active(CobIdKind::sync, CobId{0x4000'0080}));
  CHECK_FALSE(is_active(CobIdKind::sync, CobId{0x8000'0080}));  // bit 31 of 1005h has no meaning
  CHECK(is_active(CobIdKind::time, CobId{0x8000'0100}));
  CHECK(is_active(CobIdKind::time, CobId{0x4000'0100}));
  CHECK_FALSE(is_active(CobIdKind::time, CobId{0x0000'0100}));
  CHECK(deactivated(CobIdKind::emcy, CobId{0x0000'0085}) == CobId{0x8000'0085});
  CHECK(deactivated(CobIdKind::tpdo, CobId{0x4000'0185}) == CobId{0xC000'0185});
  CHECK(deactivated(CobIdKind::sync, CobId{0x4000'0080}) == CobId{0x0000'0080});
  CHECK(deactivated(CobIdKind::time, CobId{0xC000'0100}) == CobId{0x0000'0100});
  CHECK(can_id_of(CobId{0x8000'06A0}) == CanId{0x6A0});
  CHECK(can_id_of(CobId{0x0001'06A0}) == CanId{0x6A0});
  CHECK(can_id_of(CobId{0x2001'06A0}) == CanId{0x106A0});
  CHECK(is_extended(CobId{0x2001'06A0}));
}

TEST_CASE("SDO initiate requests are encoded as the standard draws them") {
  CHECK(encode_upload_request(error_count) == SdoBytes{0x40, 0x03, 0x10, 0x00, 0, 0, 0, 0});
  CHECK(encode_download_expedited(error_count, Bytes{0}) == SdoBytes{0x2F, 0x03, 0x10, 0x00, 0, 0, 0, 0});
  CHECK(encode_download_expedited(heartbeat_time, Bytes{0xE8, 0x03}) ==
        SdoBytes{0x2B, 0x17, 0x10, 0x00, 0xE8, 0x03, 0, 0});
  CHECK(encode_download_expedited(identity_sub_2, Bytes{1, 2, 3}) ==
        SdoBytes{0x27, 0x18, 0x10, 0x02, 1, 2, 3, 0});
  CHECK(encode_download_expedited(identity_sub_2, Bytes{1, 2, 3, 4}) ==
        SdoBytes{0x23, 0x18, 0x10, 0x02, 1, 2, 3, 4});
  CHECK(encode_download_expedited(heartbeat_time, Bytes{0xE8, 0x03}, false) ==
        SdoBytes{0x22, 0x17, 0x10, 0x00, 0xE8, 0x03, 0, 0});
  CHECK(encode_download_segmented(identity_sub_2, 300) == SdoBytes{0x21, 0x18, 0x10, 0x02, 0x2C, 0x01, 0, 0});
  CHECK(encode_download_segmented(identity_sub_2, std::nullopt) ==
        SdoBytes{0x20, 0x18, 0x10, 0x02, 0, 0, 0, 0});
  CHECK(encode_abort(error_count, abort::invalid_value) ==
        SdoBytes{0x80, 0x03, 0x10, 0x00, 0x30, 0x00, 0x09, 0x06});
}

TEST_CASE("SDO segments are encoded as the standard draws them") {
  CHECK(encode_upload_segment_request(false) == SdoBytes{0x60});
  CHECK(encode_upload_segment_request(true) == SdoBytes{0x70});
  CHECK(encode_download_segment_request(false, Bytes{1, 2, 3, 4, 5, 6, 7}, false) ==
        SdoBytes{0x00, 1, 2, 3, 4, 5, 6, 7});
  CHECK(encode_download_segment_request(true, Bytes{1, 2}, true) == SdoBytes{0x1B, 1, 2});
  CHECK(encode_download_segment_request(false, {}, true) == SdoBytes{0x0F});
}

TEST_CASE("SDO responses are decoded bit by bit") {
  const auto expedited = decode_upload_response(SdoBytes{0x4B, 0x17, 0x10, 0x00, 0xE8, 0x03, 0, 0});
  REQUIRE(expedited.has_value());
  CHECK(expedited->mux == heartbeat_time);
  CHECK(expedited->expedited);
  CHECK(expedited->size_indicated);
  CHECK(expedited->expedited_size() == 2);
  CHECK(expedited->value == 1000);
  CHECK_FALSE(expedited->reserved_bit);
  CHECK(decode_upload_response(SdoBytes{0x42})->expedited_size() == 4);
  CHECK(decode_upload_response(SdoBytes{0x53})->reserved_bit);
  CHECK_FALSE(decode_upload_response(SdoBytes{0x60}).has_value());
  CHECK_FALSE(decode_upload_response(Bytes{0x43, 0, 0, 0, 0, 0, 0}).has_value());

  const auto aborted = decode_abort(SdoBytes{0x80, 0x03, 0x10, 0x00, 0x30, 0x00, 0x09, 0x06});
  REQUIRE(aborted.has_value());
  CHECK(aborted->mux == error_count);
  CHECK(aborted->code == abort::invalid_value);
  CHECK_FALSE(aborted->reserved_bits);
  CHECK(decode_abort(SdoBytes{0x81})->reserved_bits);

  const auto segment = decode_segment(SdoBytes{0x1B, 1, 2, 9, 9, 9, 9, 9});
  REQUIRE(segment.has_value());
  CHECK(segment->toggle);
  CHECK(segment->last);
  CHECK(segment->size() == 2);
  CHECK_FALSE(decode_segment(SdoBytes{0x20}).has_value());
  CHECK(decode_download_segment_response(SdoBytes{0x30})->toggle);
  CHECK(decode_download_segment_response(SdoBytes{0x21})->reserved_set);
  CHECK(decode_download_segment_response(SdoBytes{0x20, 0, 0, 0, 0, 0, 0, 1})->reserved_set);
  CHECK_FALSE(decode_download_segment_response(SdoBytes{0x60}).has_value());
}

TEST_CASE("Entries of the communication profile have the length that CiA 301 gives them") {
  const auto length = [](std::uint16_t index, std::uint8_t sub) {
    return canopen::length_of_short_entry({Index(index), SubIndex(sub)});
  };
  CHECK(length(0x1000, 0) == 4);
  CHECK(length(0x1001, 0) == 1);
  CHECK(length(0x1003, 0) == 1);
  CHECK(length(0x1003, 1) == 4);
  CHECK(length(0x1005, 0) == 4);
  CHECK(length(0x1017, 0) == 2);
  CHECK(length(0x1200, 3) == 1);
  CHECK(length(0x1201, 1) == 4);
  CHECK(length(0x1400, 1) == 4);
  CHECK(length(0x1800, 2) == 1);
  CHECK(length(0x1800, 3) == 2);
  CHECK(length(0x19FF, 6) == 1);
  CHECK(length(0x1A00, 0) == 1);
  CHECK(length(0x1A00, 1) == 4);
  CHECK(length(0x2000, 0) == 4);
}
