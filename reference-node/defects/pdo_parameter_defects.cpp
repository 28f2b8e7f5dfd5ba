// SPDX-License-Identifier: Apache-2.0
// Defects of the communication parameters of the PDOs behind the first one, and of the SYNC start value.
#include <cstdint>

#include "defects/hooks.hpp"
#include "defects/pdos.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u16 = DataType::unsigned16;
constexpr std::uint64_t no_remote = 0x40000000;

bool any_value(std::uint64_t) { return true; }

/// A change that leaves these bits alone is taken at any time.
Change locked_by_bits(std::uint16_t index, std::uint8_t sub, std::uint64_t bits) {
  return checking(index, sub, [index, sub, bits](Parts& parts, const Check& former, ByteView bytes) {
    const std::uint64_t change = parts.device.dictionary.number(index, sub) ^ conform::load_le(bytes);
    return (change & bits) == 0 ? Accepted{} : former(bytes);
  });
}

/// The default CAN-ID without the node-ID is shown with it, and used as it was written.
Change shows_default_with_node_id(std::uint16_t first, std::uint32_t of_connection_set) {
  return [first, of_connection_set](Parts& parts) {
    for (std::uint16_t number = 0; number <= last_pdo; ++number) {
      const std::uint32_t base = of_connection_set + (0x100U * number);
      reading(static_cast<std::uint16_t>(first + number), 1, [base](Parts& node, const Read& former) {
        Upload shown = former();
        if (!shown) return shown;
        const auto value = static_cast<std::uint32_t>(conform::load_le(*shown));
        if ((value & 0x7FFU) == base) *shown = conform::to_le(value + node.device.node_id, 4);
        return shown;
      })(parts);
    }
  };
}

}  // namespace

DefectTable pdo_parameter_defects() {
  return {
      {"rpdo2-default-cob-id-wrong",
       "The default CAN-ID of RPDO 2 is that of RPDO 1",
       {"OD-1400-05"},
       preset_with_node_id(0x1401, 1, 0x200)},
      {"rpdo3-default-cob-id-wrong",
       "The default CAN-ID of RPDO 3 is 480h + node-ID",
       {"OD-1400-06"},
       preset_with_node_id(0x1402, 1, 0x480)},
      {"rpdo4-default-without-node-id",
       "The default CAN-ID of RPDO 4 lacks the node-ID",
       {"OD-1400-07"},
       preset(0x1403, 1, 0x500)},
      {"tpdo2-default-cob-id-wrong",
       "The default CAN-ID of TPDO 2 is 200h + node-ID",
       {"OD-1800-05"},
       preset_with_node_id(0x1801, 1, no_remote | 0x200)},
      {"tpdo3-default-without-node-id",
       "The default CAN-ID of TPDO 3 lacks the node-ID",
       {"OD-1800-06"},
       preset(0x1802, 1, no_remote | 0x380)},
      {"tpdo4-default-cob-id-wrong",
       "The default CAN-ID of TPDO 4 is 500h + node-ID",
       {"OD-1800-07"},
       preset_with_node_id(0x1803, 1, no_remote | 0x500)},
      {"tpdo4-comes-with-restricted-id",
       "TPDO 4 comes with 785h, a restricted CAN-ID",
       {"OD-CID-03", "OD-1800-07"},
       preset(0x1803, 1, no_remote | 0x785)},
      {"1403-sub2-missing", "1403h:02 does not exist", {"OD-1400-01", "OD-CAT-02"}, absent_sub(0x1403, 2)},
      {"1803-sub2-missing", "1803h:02 does not exist", {"OD-1800-01", "OD-CAT-02"}, absent_sub(0x1803, 2)},
      {"1603-absent-for-existing-pdo", "1403h exists without 1603h", {"OD-1400-03"}, absent(0x1603)},
      {"1a03-absent-for-existing-pdo", "1803h exists without 1A03h", {"OD-1800-03"}, absent(0x1A03)},
      {"1403-type-is-u16", "1403h:02 has two bytes", {"OD-1400-15", "OD-LEN-04"}, type(0x1403, 2, u16)},
      {"1403-reserved-type-accepted",
       "1403h:02 accepts reserved transmission types",
       {"OD-1400-16"},
       confirms(0x1403, 2, any_value)},
      {"1803-reserved-type-accepted",
       "1803h:02 accepts reserved transmission types",
       {"OD-1800-16"},
       confirms(0x1803, 2, any_value)},
      {"1803-inhibit-lock-missing",
       "1803h:03 can be changed while the TPDO is valid",
       {"OD-1800-18"},
       unlocked(tpdo_parameters, PdoPart::inhibit_time, last_pdo)},
      {"1800-inhibit-locked-by-low-byte",
       "The high byte of 1800h:03 can be changed while the TPDO is valid",
       {"OD-1800-18"},
       locked_by_bits(0x1800, 3, 0x00FF)},
      {"1803-inhibit-locked-by-high-byte",
       "The low byte of 1803h:03 can be changed while the TPDO is valid",
       {"OD-1800-18"},
       locked_by_bits(0x1803, 3, 0xFF00)},
      {"1400-inhibit-locked-by-low-byte",
       "The high byte of 1400h:03 can be changed while the RPDO is valid",
       {"OD-1400-18"},
       locked_by_bits(0x1400, 3, 0x00FF)},
      {"1403-inhibit-locked-by-15-bits",
       "The highest bit of 1403h:03 can be changed while the RPDO is valid",
       {"OD-1400-18"},
       locked_by_bits(0x1403, 3, 0x7FFF)},
      {"1800-sync-start-locked-by-low-half",
       "The upper half of the SYNC start value can be changed while the TPDO is valid",
       {"OD-1800-21"},
       locked_by_bits(0x1800, 6, 0x0F)},
      {"1800-sync-start-lock-missing",
       "The SYNC start value can be changed while the TPDO is valid",
       {"OD-1800-21"},
       unlocked(tpdo_parameters, PdoPart::sync_start)},
      {"1800-sync-start-above-240-accepted",
       "A SYNC start value above 240 is accepted",
       {"OD-1800-21"},
       confirms(0x1800, 6, [](std::uint64_t value) { return value > 240; })},
      {"1800-sync-start-is-u16", "1800h:06 has two bytes", {"OD-1800-21", "OD-LEN-04"}, type(0x1800, 6, u16)},
      {"1400-default-shown-with-node-id",
       "The default CAN-ID of an RPDO without the node-ID is used, and shown with it",
       {"OD-1400-11"},
       shows_default_with_node_id(0x1400, 0x200)},
      {"1800-default-shown-with-node-id",
       "The default CAN-ID of a TPDO without the node-ID is used, and shown with it",
       {"OD-1800-11"},
       shows_default_with_node_id(0x1800, 0x180)},
      {"1803-event-timer-not-stored",
       "1803h:05 is confirmed and not stored",
       {"OD-1800-20"},
       not_stored(0x1803, 5)},
  };
}

}  // namespace refnode
