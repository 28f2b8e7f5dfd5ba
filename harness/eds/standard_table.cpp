// SPDX-License-Identifier: Apache-2.0
#include "eds/standard_table.hpp"

#include <algorithm>
#include <iterator>

namespace conform::eds {
namespace {

using enum StandardFlag;

constexpr unsigned flag(StandardFlag value) { return static_cast<unsigned>(value); }
constexpr unsigned open = flag(leaves_access);
constexpr unsigned adds_node = flag(adds_node_id);
constexpr unsigned mappable = flag(pdo_mappable);
constexpr unsigned changes = flag(may_change);
constexpr unsigned command = flag(is_command);

constexpr std::int64_t none = StandardRow::none;
constexpr auto M = Category::mandatory;
constexpr auto C = Category::conditional;
constexpr auto O = Category::optional;
constexpr auto var = ObjectCode::var;
constexpr auto array = ObjectCode::array;
constexpr auto record = ObjectCode::record;
constexpr auto domain = ObjectCode::domain;
constexpr std::uint16_t u8 = 0x05, u16 = 0x06, u32 = 0x07, text = 0x09, octets = 0x0A, bulk = 0x0F;
constexpr auto ro = Access::ro;
constexpr auto wo = Access::wo;
constexpr auto rw = Access::rw;
constexpr auto constant = Access::constant;
constexpr std::string_view highest = "Highest sub-index supported";

// Conditional: required with its feature, or (sub-indices) with its object. Mandatory is only what every
// device has.
constexpr StandardRow rows[] = {
    {0x1000, 0x1000, 0x00, 0x00, "Device type", u32, ro, M, var},
    {0x1001, 0x1001, 0x00, 0x00, "Error register", u8, ro, M, var, mappable | changes},
    {0x1002, 0x1002, 0x00, 0x00, "Manufacturer status register", u32, ro, O, var, mappable | changes},
    {0x1003, 0x1003, 0x00, 0x00, "Number of errors", u8, rw, C, array, changes | command, 0},
    {0x1003, 0x1003, 0x01, 0x01, "Standard error field", u32, ro, C, array, changes},
    {0x1003, 0x1003, 0x02, 0xFE, "Standard error field", u32, ro, O, array, changes},
    {0x1005, 0x1005, 0x00, 0x00, "COB-ID SYNC message", u32, rw, C, var, open, 0x80},
    {0x1006, 0x1006, 0x00, 0x00, "Communication cycle period", u32, rw, C, var, 0, 0},
    {0x1007, 0x1007, 0x00, 0x00, "Synchronous window length", u32, rw, O, var, 0, 0},
    {0x1008, 0x1008, 0x00, 0x00, "Manufacturer device name", text, constant, O, var},
    {0x1009, 0x1009, 0x00, 0x00, "Manufacturer hardware version", text, constant, O, var},
    {0x100A, 0x100A, 0x00, 0x00, "Manufacturer software version", text, constant, O, var},
    {0x100C, 0x100C, 0x00, 0x00, "Guard time", u16, rw, C, var, open, 0},
    {0x100D, 0x100D, 0x00, 0x00, "Life time factor", u8, rw, C, var, open, 0},
    {0x1010, 0x1010, 0x00, 0x00, highest, u8, constant, C, array, 0, none, 1, 0x7F},
    {0x1010, 0x1010, 0x01, 0x01, "Save all parameters", u32, rw, C, array, open | command},
    {0x1010, 0x1010, 0x02, 0x02, "Save communication parameters", u32, rw, O, array, open | command},
    {0x1010, 0x1010, 0x03, 0x03, "Save application parameters", u32, rw, O, array, open | command},
    {0x1010, 0x1010, 0x04, 0x7F, "Save manufacturer defined parameters", u32, rw, O, array, open | command},
    {0x1011, 0x1011, 0x00, 0x00, highest, u8, constant, C, array, 0, none, 1, 0x7F},
    {0x1011, 0x1011, 0x01, 0x01, "Restore all default parameters", u32, rw, C, array, command},
    {0x1011, 0x1011, 0x02, 0x02, "Restore communication default parameters", u32, rw, O, array, command},
    {0x1011, 0x1011, 0x03, 0x03, "Restore application default parameters", u32, rw, O, array, command},
    {0x1011, 0x1011, 0x04, 0x7F, "Restore manufacturer defined default parameters", u32, rw, O, array,
     command},
    {0x1012, 0x1012, 0x00, 0x00, "COB-ID time stamp object", u32, rw, O, var, open, 0x100},
    {0x1013, 0x1013, 0x00, 0x00, "High resolution time stamp", u32, rw, O, var, mappable | changes, 0},
    {0x1014, 0x1014, 0x00, 0x00, "COB-ID emergency message", u32, rw, C, var, open | adds_node, 0x80},
    {0x1015, 0x1015, 0x00, 0x00, "Inhibit time EMCY", u16, rw, O, var, 0, 0},
    {0x1016, 0x1016, 0x00, 0x00, highest, u8, constant, C, array, 0, none, 1, 0x7F},
    {0x1016, 0x1016, 0x01, 0x01, "Consumer heartbeat time", u32, rw, C, array, 0, 0},
    {0x1016, 0x1016, 0x02, 0x7F, "Consumer heartbeat time", u32, rw, O, array, 0, 0},
    {0x1017, 0x1017, 0x00, 0x00, "Producer heartbeat time", u16, rw, C, var, open, 0},
    {0x1018, 0x1018, 0x00, 0x00, highest, u8, constant, M, record, 0, none, 1, 4},
    {0x1018, 0x1018, 0x01, 0x01, "Vendor-ID", u32, ro, M, record},
    {0x1018, 0x1018, 0x02, 0x02, "Product code", u32, ro, O, record},
    {0x1018, 0x1018, 0x03, 0x03, "Revision number", u32, ro, O, record},
    {0x1018, 0x1018, 0x04, 0x04, "Serial number", u32, ro, O, record},
    {0x1019, 0x1019, 0x00, 0x00, "Synchronous counter overflow value", u8, rw, O, var, open, 0, 0, 240},
    {0x1020, 0x1020, 0x00, 0x00, highest, u8, constant, C, array, 0, 2, 2, 2},
    {0x1020, 0x1020, 0x01, 0x01, "Configuration date", u32, rw, C, array},
    {0x1020, 0x1020, 0x02, 0x02, "Configuration time", u32, rw, C, array},
    {0x1021, 0x1021, 0x00, 0x00, "Store EDS", bulk, ro, O, domain},
    {0x1022, 0x1022, 0x00, 0x00, "Store format", u16, ro, C, var, 0, none, 0, 0xFF},
    {0x1023, 0x1023, 0x00, 0x00, highest, u8, constant, C, record, 0, 3, 3, 3},
    {0x1023, 0x1023, 0x01, 0x01, "OS command", octets, rw, C, record, command},
    {0x1023, 0x1023, 0x02, 0x02, "OS command status", u8, ro, C, record, changes},
    {0x1023, 0x1023, 0x03, 0x03, "OS command reply", octets, ro, C, record, changes},
    {0x1024, 0x1024, 0x00, 0x00, "OS command mode", u8, wo, O, var, command},
    {0x1025, 0x1025, 0x00, 0x00, highest, u8, constant, C, record, 0, 3, 3, 3},
    {0x1025, 0x1025, 0x01, 0x01, "Debugger command", octets, rw, C, record, command},
    {0x1025, 0x1025, 0x02, 0x02, "Debugger status", u8, ro, C, record, changes},
    {0x1025, 0x1025, 0x03, 0x03, "Debugger reply", octets, ro, C, record, changes},
    {0x1026, 0x1026, 0x00, 0x00, highest, u8, constant, C, array, 0, none, 2, 3},
    {0x1026, 0x1026, 0x01, 0x01, "StdIn", u8, wo, C, array, mappable | command},
    {0x1026, 0x1026, 0x02, 0x02, "StdOut", u8, ro, C, array, mappable | changes},
    {0x1026, 0x1026, 0x03, 0x03, "StdErr", u8, ro, O, array, mappable | changes},
    {0x1027, 0x1027, 0x00, 0x00, "Number of connected modules", u8, ro, C, array, changes},
    {0x1027, 0x1027, 0x01, 0x01, "Module", u16, ro, C, array, changes},
    {0x1027, 0x1027, 0x02, 0xFE, "Module", u16, ro, O, array, changes},
    {0x1028, 0x1028, 0x00, 0x00, highest, u8, constant, C, array, 0, none, 1, 0x7F},
    {0x1028, 0x1028, 0x01, 0x01, "Emergency consumer", u32, rw, C, array, open},
    {0x1028, 0x1028, 0x02, 0x7F, "Emergency consumer", u32, rw, O, array, open},
    {0x1029, 0x1029, 0x00, 0x00, highest, u8, constant, C, array, 0, none, 1, 0xFE},
    {0x1029, 0x1029, 0x01, 0x01, "Communication error", u8, rw, C, array, open, 0},
    {0x1029, 0x1029, 0x02, 0xFE, "Profile or manufacturer specific error", u8, rw, O, array, open},
    {0x1200, 0x1200, 0x00, 0x00, highest, u8, constant, C, record, 0, 2, 2, 2},
    {0x1200, 0x1200, 0x01, 0x01, "COB-ID client to server", u32, ro, C, record, mappable | adds_node, 0x600},
    {0x1200, 0x1200, 0x02, 0x02, "COB-ID server to client", u32, ro, C, record, mappable | adds_node, 0x580},
    {0x1201, 0x127F, 0x00, 0x00, highest, u8, constant, C, record, 0, none, 2, 3},
    {0x1201, 0x127F, 0x01, 0x01, "COB-ID client to server", u32, rw, C, record, mappable | open, 0x8000'0000},
    {0x1201, 0x127F, 0x02, 0x02, "COB-ID server to client", u32, rw, C, record, mappable | open, 0x8000'0000},
    {0x1201, 0x127F, 0x03, 0x03, "Node-ID of the SDO client", u8, rw, O, record, 0, none, 1, 0x7F},
    {0x1280, 0x12FF, 0x00, 0x00, highest, u8, constant, C, record, 0, 3, 3, 3},
    {0x1280, 0x12FF, 0x01, 0x01, "COB-ID client to server", u32, rw, C, record, mappable | open, 0x8000'0000},
    {0x1280, 0x12FF, 0x02, 0x02, "COB-ID server to client", u32, rw, C, record, mappable | open, 0x8000'0000},
    {0x1280, 0x12FF, 0x03, 0x03, "Node-ID of the SDO server", u8, rw, C, record, 0, none, 1, 0x7F},
    // PDO 1..4 have the COB-IDs of the pre-defined connection set; whether they are valid is the device's
    // choice. From the fifth on only bit 31 is prescribed, so that there is no default to compare.
    {0x1400, 0x15FF, 0x00, 0x00, highest, u8, constant, C, record, 0, none, 2, 6},
    {0x1400, 0x1400, 0x01, 0x01, "COB-ID used by RPDO", u32, rw, C, record, open | adds_node, 0x200},
    {0x1401, 0x1401, 0x01, 0x01, "COB-ID used by RPDO", u32, rw, C, record, open | adds_node, 0x300},
    {0x1402, 0x1402, 0x01, 0x01, "COB-ID used by RPDO", u32, rw, C, record, open | adds_node, 0x400},
    {0x1403, 0x1403, 0x01, 0x01, "COB-ID used by RPDO", u32, rw, C, record, open | adds_node, 0x500},
    {0x1404, 0x15FF, 0x01, 0x01, "COB-ID used by RPDO", u32, rw, C, record, open},
    {0x1400, 0x15FF, 0x02, 0x02, "Transmission type", u8, rw, C, record, open},
    {0x1400, 0x15FF, 0x03, 0x03, "Inhibit time", u16, rw, O, record, open},
    {0x1400, 0x15FF, 0x04, 0x04, "Compatibility entry", u8, rw, O, record, open},
    {0x1400, 0x15FF, 0x05, 0x05, "Event timer", u16, rw, O, record, open},
    {0x1600, 0x17FF, 0x00, 0x00, "Number of mapped objects in RPDO", u8, rw, C, record, open},
    {0x1600, 0x17FF, 0x01, 0x40, "Mapped object", u32, rw, O, record, open},
    {0x1800, 0x19FF, 0x00, 0x00, highest, u8, constant, C, record, 0, none, 2, 6},
    {0x1800, 0x1800, 0x01, 0x01, "COB-ID used by TPDO", u32, rw, C, record, open | adds_node, 0x180},
    {0x1801, 0x1801, 0x01, 0x01, "COB-ID used by TPDO", u32, rw, C, record, open | adds_node, 0x280},
    {0x1802, 0x1802, 0x01, 0x01, "COB-ID used by TPDO", u32, rw, C, record, open | adds_node, 0x380},
    {0x1803, 0x1803, 0x01, 0x01, "COB-ID used by TPDO", u32, rw, C, record, open | adds_node, 0x480},
    {0x1804, 0x19FF, 0x01, 0x01, "COB-ID used by TPDO", u32, rw, C, record, open},
    {0x1800, 0x19FF, 0x02, 0x02, "Transmission type", u8, rw, C, record, open},
    {0x1800, 0x19FF, 0x03, 0x03, "Inhibit time", u16, rw, O, record, open},
    {0x1800, 0x19FF, 0x04, 0x04, "Compatibility entry", u8, rw, O, record, open},
    {0x1800, 0x19FF, 0x05, 0x05, "Event timer", u16, rw, O, record, open},
    {0x1800, 0x19FF, 0x06, 0x06, "SYNC start value", u8, rw, O, record, open, none, 0, 240},
    {0x1A00, 0x1BFF, 0x00, 0x00, "Number of mapped objects in TPDO", u8, rw, C, record, open},
    {0x1A00, 0x1BFF, 0x01, 0x40, "Mapped object", u32, rw, O, record, open},
};

}  // namespace

std::span<const StandardRow> standard_rows() { return rows; }

const StandardRow* find_standard_row(Multiplexer mux) {
  const auto index = mux.index.value();
  const auto sub = mux.sub.value();
  const auto* found = std::ranges::find_if(rows, [=](const StandardRow& row) {
    return index >= row.first_index && index <= row.last_index && sub >= row.first_sub && sub <= row.last_sub;
  });
  return found == std::end(rows) ? nullptr : found;
}

std::vector<const StandardRow*> rows_of(Index index) {
  std::vector<const StandardRow*> out;
  for (const auto& row : rows) {
    if (index.value() >= row.first_index && index.value() <= row.last_index) out.push_back(&row);
  }
  return out;
}

}  // namespace conform::eds
