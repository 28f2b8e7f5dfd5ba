// SPDX-License-Identifier: Apache-2.0
// Defects of COB-ID parameters that show in the course of several writes, or in Operational.
#include <cstdint>
#include <vector>

#include "defects/cob_ids.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

/// A write that changes these bits alone is taken without a look at the CAN-ID.
Change looks_at_changes_only(std::uint16_t index, std::uint8_t sub, std::uint32_t bits) {
  return checking(index, sub, [index, sub, bits](Parts& parts, const Check& former, ByteView bytes) {
    const std::uint64_t present = parts.device.dictionary.number(index, sub);
    return (present ^ conform::load_le(bytes)) == bits ? Accepted{} : former(bytes);
  });
}

/// While it is not in use the entry takes any CAN-ID, and is not looked at again.
Change takes_any_while_not_in_use(std::uint16_t index, std::uint8_t sub, std::uint32_t in_use) {
  return checking(index, sub, [index, sub, in_use](Parts& parts, const Check& former, ByteView bytes) {
    const std::uint64_t present = parts.device.dictionary.number(index, sub);
    const std::uint64_t wanted = conform::load_le(bytes);
    const bool can_id_alone = present < in_use && wanted < 0x800;
    const bool comes_into_use = (present ^ wanted) == in_use;
    return can_id_alone || comes_into_use ? Accepted{} : former(bytes);
  });
}

bool is_the_same_and_valid(std::uint64_t present, std::uint64_t wanted) {
  return wanted == present && (wanted & 0x80000000U) == 0;
}

/// A restricted CAN-ID is taken together with these bits.
Change takes_restricted_with(std::uint16_t index, std::uint8_t sub, std::uint32_t bits) {
  return checking(index, sub, [bits](Parts&, const Check& former, ByteView bytes) {
    const auto wanted = static_cast<std::uint32_t>(conform::load_le(bytes));
    const bool taken = (wanted & 0xFFFFF800U) == bits && restricted_can_id(wanted & 0x7FFU);
    return taken ? Accepted{} : former(bytes);
  });
}

Change unlocked_in_operational(CobIdPart part) {
  return [part](Parts& parts) {
    part(parts).locked.replace([&parts](const auto& former, std::uint32_t value) {
      return parts.device.state != NmtState::operational && former(value);
    });
  };
}

/// The CAN-ID of one entry can be changed in Operational.
Change unlocks_one_in_operational(std::uint16_t index, std::uint8_t sub) {
  return checking(index, sub, [](Parts& parts, const Check& former, ByteView bytes) {
    const auto wanted = static_cast<std::uint32_t>(conform::load_le(bytes));
    const bool taken = parts.device.state == NmtState::operational && !restricted_can_id(wanted & 0x7FFU);
    return taken ? Accepted{} : former(bytes);
  });
}

constexpr std::uint32_t frame_bit = 0x2000'0000;
constexpr std::uint32_t extended_id = 0x1FFF'FFFF;
constexpr std::uint32_t base_id = 0x7FF;

bool is_large(std::uint64_t cob_id) { return (cob_id & extended_id) > base_id; }

/// Bit 29 of the COB-IDs of TPDOs is taken, and their frames have 29 bits where the CAN-ID needs them.
void sends_29_bits_where_needed(Parts& parts) {
  decided(of_tpdo, &CobIdRules::frame_bit_allowed, true)(parts);
  parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::tpdo) return;
    for (Outgoing& each : frames) {
      for (std::uint16_t index = 0x1800; index < 0x1804; ++index) {
        const std::uint64_t cob_id = parts.device.dictionary.number(index, 1);
        if ((cob_id & frame_bit) == 0 || (cob_id & base_id) != each.frame.id || !is_large(cob_id)) continue;
        each.frame.extended = true;
        each.frame.id = static_cast<std::uint32_t>(cob_id & extended_id);
        break;
      }
    }
  });
}

/// The same of RPDOs; the service knows them by 11 bits.
void receives_29_bits_where_needed(Parts& parts) {
  decided(of_rpdo, &CobIdRules::frame_bit_allowed, true)(parts);
  misreads([](Parts& node, Frame& frame) {
    constexpr std::uint32_t nobodys = 0x7FF;
    if (frame.remote) return;
    for (std::uint16_t index = 0x1400; index < 0x1404; ++index) {
      const std::uint64_t cob_id = node.device.dictionary.number(index, 1);
      if ((cob_id & frame_bit) == 0 || !is_large(cob_id)) continue;
      if (!frame.extended && frame.id == (cob_id & base_id)) {
        frame.id = nobodys;
        return;
      }
      if (frame.extended && frame.id == (cob_id & extended_id)) {
        frame.id &= base_id;
        frame.extended = false;
        return;
      }
    }
  })(parts);
}

/// What was stored of a consumer of TIME makes a producer, until it is written.
void produces_time_for_a_stored_consumer(Parts& parts) {
  parts.time.cob_id_rules.produced.replace(
      [written = written_since_boot_up(parts, {0x1012})](const auto& former, std::uint32_t value) {
        return former(value) || (written->empty() && (value & 0x80000000U) != 0);
      });
}

}  // namespace

DefectTable cob_id_course_defects() {
  return {
      {"1014-restricted-in-two-writes",
       "1014h becomes valid with a restricted CAN-ID that was written before: changes alone are looked at",
       {"CAN-RID-03", "OD-CID-03"},
       looks_at_changes_only(0x1014, 0, bit_31)},
      {"1403-restricted-in-two-writes",
       "RPDO 4 becomes valid with a restricted CAN-ID that was written before",
       {"CAN-RID-04", "OD-CID-03"},
       looks_at_changes_only(0x1403, 1, bit_31)},
      {"1803-restricted-in-two-writes",
       "TPDO 4 becomes valid with a restricted CAN-ID that was written before",
       {"CAN-RID-05", "OD-CID-03"},
       looks_at_changes_only(0x1803, 1, bit_31)},
      {"1201-restricted-in-two-writes",
       "The response of an SDO server becomes valid with a restricted CAN-ID that was written before",
       {"CAN-RID-06", "OD-CID-03"},
       looks_at_changes_only(0x1201, 2, bit_31)},
      {"1280-restricted-in-two-writes",
       "The request of an SDO client becomes valid with a restricted CAN-ID that was written before",
       {"CAN-RID-06", "OD-CID-03"},
       looks_at_changes_only(0x1280, 1, bit_31)},
      {"1012-restricted-in-two-writes",
       "TIME is consumed on a restricted CAN-ID that was written before",
       {"CAN-RID-02", "OD-CID-03"},
       takes_any_while_not_in_use(0x1012, 0, bit_31)},
      {"1012-restricted-produced",
       "1012h takes a restricted CAN-ID together with the order to produce TIME",
       {"CAN-RID-02", "OD-CID-03"},
       takes_restricted_with(0x1012, 0, bit_30)},
      {"1005-restricted-generated",
       "1005h takes a restricted CAN-ID together with the order to generate SYNC",
       {"CAN-RID-01", "OD-CID-03"},
       takes_restricted_with(0x1005, 0, bit_30)},
      {"1012-restricted-consumed-and-produced",
       "1012h takes a restricted CAN-ID together with both the order to consume and the order to produce TIME",
       {"CAN-RID-02", "OD-CID-03"},
       takes_restricted_with(0x1012, 0, bit_31 | bit_30)},
      {"1012-stored-consumer-produces",
       "Behind a reset TIME is produced where 1012h was stored with bit 31 alone",
       {"TIME-PRO-03"},
       Change(produces_time_for_a_stored_consumer)},
      {"1400-restricted-with-bit-30",
       "An RPDO takes a restricted CAN-ID together with bit 30 of its COB-ID",
       {"CAN-RID-04", "OD-CID-03"},
       takes_restricted_with(0x1400, 1, bit_30)},
      {"1800-restricted-without-bit-30",
       "A TPDO takes a restricted CAN-ID when bit 30 of its COB-ID is cleared with it",
       {"CAN-RID-05", "OD-CID-03"},
       takes_restricted_with(0x1800, 1, 0)},
      {"1028-restricted-id-accepted",
       "1028h accepts restricted CAN-IDs",
       {"OD-CID-03"},
       decided(of_emergencies, &CobIdRules::restricted, false)},
      {"1028-last-restricted-in-two-writes",
       "The last entry of 1028h becomes valid with a restricted CAN-ID that was written before",
       {"OD-CID-03"},
       looks_at_changes_only(0x1028, 3, bit_31)},
      {"1014-not-locked-in-operational",
       "The CAN-ID of EMCY can be changed in Operational while EMCY is valid",
       {"OD-1014-06"},
       unlocked_in_operational(of_emergency)},
      {"1403-not-locked-in-operational",
       "The CAN-ID of RPDO 4 can be changed in Operational while it is valid",
       {"OD-1400-10"},
       unlocks_one_in_operational(0x1403, 1)},
      {"1800-not-locked-in-operational",
       "The CAN-ID of a valid TPDO can be changed in Operational",
       {"OD-1800-10"},
       unlocked_in_operational(of_tpdo)},
      {"1005-not-locked-in-operational",
       "The CAN-ID of SYNC can be changed in Operational while the node generates it",
       {"OD-1005-05"},
       unlocked_in_operational(of_sync)},
      {"1012-not-locked-in-operational",
       "The CAN-ID of TIME can be changed in Operational while TIME is consumed or produced",
       {"OD-1012-05"},
       unlocked_in_operational(of_time)},
      {"1201-not-locked-in-operational",
       "The CAN-IDs of a valid SDO server can be changed in Operational",
       {"OD-1201-05"},
       unlocked_in_operational(of_sdo_server)},
      {"1280-not-locked-in-operational",
       "The CAN-IDs of a valid SDO client can be changed in Operational",
       {"OD-1280-03"},
       unlocked_in_operational(of_sdo_client)},
      {"1201-valid-rewrite-refused",
       "The COB-ID of the response of an SDO server refuses the value it holds while it is valid",
       {"OD-CID-04"},
       refuses(0x1201, 2, abort_code::invalid_value, is_the_same_and_valid)},
      {"1280-valid-rewrite-refused",
       "The COB-ID of the request of an SDO client refuses the value it holds while it is valid",
       {"OD-CID-04"},
       refuses(0x1280, 1, abort_code::invalid_value, is_the_same_and_valid)},
      {"1028-valid-rewrite-refused",
       "1028h refuses the value it holds while it is valid",
       {"OD-CID-04"},
       refuses(0x1028, 3, abort_code::invalid_value, is_the_same_and_valid)},
      {"1028-not-locked-in-operational",
       "The CAN-ID of a valid entry of 1028h can be changed in Operational",
       {"OD-1028-06"},
       unlocked_in_operational(of_emergencies)},
      {.id = "tpdo-29-bit-small-sent-with-11",
       .summary = "A TPDO whose COB-ID took bit 29 is sent with 11 bits where its CAN-ID is below 800h",
       .violates = {"CAN-EXT-01", "OD-1800-13"},
       .how = Change(sends_29_bits_where_needed),
       .lacks = {"base frames only"}},
      {.id = "rpdo-29-bit-small-received-with-11",
       .summary = "An RPDO whose COB-ID took bit 29 is received with 11 bits where its CAN-ID is below 800h",
       .violates = {"CAN-EXT-01"},
       .how = Change(receives_29_bits_where_needed),
       .lacks = {"base frames only"}},
  };
}

}  // namespace refnode
