// SPDX-License-Identifier: Apache-2.0
#include "sdo_parameters.hpp"

namespace refnode {

namespace {

constexpr std::uint8_t first_cob_id_sub = 1;
constexpr std::uint8_t second_cob_id_sub = 2;
constexpr std::uint8_t node_id_sub = 3;
constexpr std::uint32_t not_valid = 0x80000000;
constexpr std::uint32_t dynamic_bit = 0x40000000;

struct CobIds {
  CobIdRules client_to_server;
  CobIdRules server_to_client;
};

CobIds add_record(Device& device, std::uint16_t index, CobIdUse use, const char* name, const char* partner) {
  ObjectDictionary& od = device.dictionary;
  od.add_complex(index, name, ObjectKind::record);
  const CobIdRules to_server(device, use, index, first_cob_id_sub, not_valid);
  const CobIdRules to_client(device, use, index, second_cob_id_sub, not_valid);
  od.add_sub(index, first_cob_id_sub, to_server.entry("COB-ID client -> server"));
  od.add_sub(index, second_cob_id_sub, to_client.entry("COB-ID server -> client"));
  Entry& node_id =
      od.add_sub(index, node_id_sub, integer_entry(partner, DataType::unsigned8, Access::rw, 127));
  node_id.low = 1;
  node_id.high = 127;
  const auto dynamic = [&device, index] {
    if (device.behaviour.dynamic_sdo_stored) return false;
    const std::uint64_t both = device.dictionary.number(index, first_cob_id_sub) |
                               device.dictionary.number(index, second_cob_id_sub);
    return (both & dynamic_bit) != 0;
  };
  for (auto& [sub, entry] : od.objects()[index].entries) entry.not_stored_now = dynamic;
  return {to_server, to_client};
}

}  // namespace

SdoChannel add_sdo_server(Device& device, std::uint8_t number) {
  const CobIds ids = add_record(device, static_cast<std::uint16_t>(0x1200U + number), CobIdUse::sdo_server,
                                "SDO server parameter", "Node-ID of the SDO client");
  return {ids.client_to_server, ids.server_to_client};
}

void add_sdo_client(Device& device) {
  add_record(device, 0x1280, CobIdUse::sdo_client, "SDO client parameter", "Node-ID of the SDO server");
}

}  // namespace refnode
