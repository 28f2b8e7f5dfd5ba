// SPDX-License-Identifier: Apache-2.0
#include "sdo/parameters.hpp"

#include <utility>

namespace refnode {

namespace {

constexpr std::uint8_t first_cob_id_sub = 1;
constexpr std::uint8_t second_cob_id_sub = 2;
constexpr std::uint8_t node_id_sub = 3;
constexpr std::uint32_t not_valid = 0x80000000;
constexpr std::uint32_t dynamic_bit = 0x40000000;

void add_record(ObjectDictionary& od, std::uint16_t index, const char* name, const char* partner) {
  od.add_complex(index, name, ObjectKind::record);
  od.add_sub(index, first_cob_id_sub,
             integer_entry("COB-ID client -> server", DataType::unsigned32, Access::rw, not_valid));
  od.add_sub(index, second_cob_id_sub,
             integer_entry("COB-ID server -> client", DataType::unsigned32, Access::rw, not_valid));
  od.add_sub(index, node_id_sub, integer_entry(partner, DataType::unsigned8, Access::rw, 127));
}

/// COB-IDs in the order of their sub-indices.
std::pair<CobId, CobId> bind_record(Device& device, const CobIdRules& rules, std::uint16_t index) {
  ObjectDictionary& od = device.dictionary;
  CobId to_server(device, rules, index, first_cob_id_sub, not_valid);
  CobId to_client(device, rules, index, second_cob_id_sub, not_valid);
  to_server.bind();
  to_client.bind();
  if (Entry* node_id = od.entry(index, node_id_sub); node_id != nullptr && !node_id->low && !node_id->high) {
    node_id->low = 1;
    node_id->high = 127;
  }
  const auto dynamic = [&device, index] {
    const std::uint64_t both = device.dictionary.number(index, first_cob_id_sub) |
                               device.dictionary.number(index, second_cob_id_sub);
    return (both & dynamic_bit) != 0;
  };
  for (auto& [sub, entry] : od.objects()[index].entries) entry.not_stored_now = dynamic;
  return {to_server, to_client};
}

}  // namespace

void add_sdo_server(Device& device, std::uint8_t number) {
  add_record(device.dictionary, static_cast<std::uint16_t>(first_sdo_server + number), "SDO server parameter",
             "Node-ID of the SDO client");
}

void add_sdo_client(Device& device) {
  add_record(device.dictionary, first_sdo_client, "SDO client parameter", "Node-ID of the SDO server");
}

SdoChannel bind_sdo_server(Device& device, const CobIdRules& rules, std::uint16_t index) {
  const auto [to_server, to_client] = bind_record(device, rules, index);
  return {to_server, to_client};
}

void bind_sdo_clients(Device& device, const CobIdRules& rules) {
  for (const auto& [index, object] : device.dictionary.objects()) {
    if (index >= first_sdo_client && index <= last_sdo_client) bind_record(device, rules, index);
  }
}

}  // namespace refnode
