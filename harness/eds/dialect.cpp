// SPDX-License-Identifier: Apache-2.0
#include "eds/dialect.hpp"

#include <algorithm>
#include <array>
#include <iterator>

namespace conform::eds {
namespace {

struct Row {
  std::string_view key;
  Meaning meaning;
  bool only_in_ini = false;
};

using enum Meaning;
constexpr Row rows[] = {
    {"FileName", text},
    {"FileVersion", number},
    {"FileRevision", number, true},
    {"EDSVersion", text, true},
    {"Description", text},
    {"CreationTime", Meaning::time},
    {"CreationDate", date},
    {"CreatedBy", text},
    {"ModificationTime", Meaning::time},
    {"ModificationDate", date},
    {"ModifiedBy", text},
    {"LastEDS", text, true},
    {"VendorName", text},
    {"VendorNumber", number},
    {"ProductName", text},
    {"ProductNumber", number},
    {"RevisionNumber", number, true},
    {"OrderCode", text},
    {"SimpleBootUpMaster", flag},
    {"SimpleBootUpSlave", flag},
    {"Granularity", number},
    {"DynamicChannelsSupported", flag},
    {"GroupMessaging", flag},
    {"NrOfRXPDO", count},
    {"NrOfTXPDO", count},
    {"LSS_Supported", flag},
    {"CompactPDO", count, true},
    {"NodeID", count},
    {"NodeName", text},
    {"NodeRefd", text, true},
    {"Baudrate", count},
    {"NetNumber", count},
    {"NetworkName", text},
    {"NetRefd", text, true},
    {"CANopenManager", flag},
    {"LSS_SerialNumber", number, true},
    {"ParameterName", text},
    {"ObjectType", number},
    {"DataType", number},
    {"AccessType", Meaning::access},
    {"DefaultValue", value},
    {"LowLimit", value},
    {"HighLimit", value},
    {"PDOMapping", mapping},
    {"ObjFlags", count},
    {"ParameterValue", value},
    {"Denotation", text},
    {"ParamRefd", text, true},
    {"UploadFile", text, true},
    {"DownloadFile", text, true},
};

const Row* find(std::string_view key) {
  const auto* found = std::ranges::find(rows, key, &Row::key);
  return found == std::end(rows) ? nullptr : found;
}

}  // namespace

Meaning meaning_of(std::string_view key) {
  const auto* row = find(key);
  return row == nullptr ? text : row->meaning;
}

bool only_in_ini(std::string_view key) {
  const auto* row = find(key);
  return row != nullptr && row->only_in_ini;
}

bool is_ini_bit_rate(std::uint64_t rate) {
  static constexpr std::array<std::uint64_t, 8> rates = {10, 20, 50, 125, 250, 500, 800, 1000};
  return std::ranges::find(rates, rate) != rates.end();
}

bool is_xml_bit_rate(std::uint64_t rate) { return rate == 100 || is_ini_bit_rate(rate); }

Directions directions_of(std::optional<Access> access) {
  using enum Access;
  if (access == ro || access == constant || access == rwr) return {.rpdo = false, .tpdo = true};
  if (access == wo || access == rww) return {.rpdo = true, .tpdo = false};
  return {.rpdo = true, .tpdo = true};
}

Reach reach(const Entry& entry) {
  Reach out{eds::access(entry), {}};
  const bool typed = object_code(entry) != ObjectCode::domain;
  if (!out.access && !typed && entry.access_type.empty()) out.access = Access::rw;
  switch (pdo_mapping(entry)) {
    case PdoMapping::no: return out;
    case PdoMapping::yes: out.mapped = directions_of(out.access); return out;
    case PdoMapping::rpdo_only: out.mapped.rpdo = true; break;
    case PdoMapping::tpdo_only: out.mapped.tpdo = true; break;
  }
  if (out.access == Access::rw) out.access = out.mapped.rpdo ? Access::rww : Access::rwr;
  return out;
}

std::string_view implied_meaning(std::string_view key, const Entry& entry) {
  if (key == "ObjectType") return "7";
  if (object_code(entry) != ObjectCode::domain) return {};
  return key == "DataType" ? "0x000F" : key == "AccessType" ? "rw" : "";
}

}  // namespace conform::eds
