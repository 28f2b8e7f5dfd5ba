// SPDX-License-Identifier: Apache-2.0
#include "node/eds_text.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <bit>
#include <iterator>
#include <map>
#include <memory>
#include <vector>

#include "base/check.hpp"
#include "base/text.hpp"
#include "dictionary/object_dictionary.hpp"
#include "node/node.hpp"
#include "objects/module_list.hpp"

namespace refnode {

namespace {

constexpr std::string_view header = R"([FileInfo]
FileName=canopen-refnode.eds
FileVersion=1
FileRevision=0
EDSVersion=4.0
Description=Reference node of canopen-conform
CreationTime=12:00AM
CreationDate=01-01-2026
CreatedBy=canopen-refnode
ModificationTime=12:00AM
ModificationDate=01-01-2026
ModifiedBy=canopen-refnode

[DeviceInfo]
VendorName=canopen-conform
VendorNumber={:#x}
ProductName=canopen-refnode
ProductNumber={:#x}
RevisionNumber={:#x}
OrderCode=none
BaudRate_10=1
BaudRate_20=1
BaudRate_50=1
BaudRate_125=1
BaudRate_250=1
BaudRate_500=1
BaudRate_800=1
BaudRate_1000=1
SimpleBootUpMaster=0
SimpleBootUpSlave=1
Granularity=8
DynamicChannelsSupported=0
GroupMessaging=0
NrOfRXPDO={}
NrOfTXPDO={}
LSS_Supported=1

[DummyUsage]
Dummy0001=0
Dummy0002=1
Dummy0003=1
Dummy0004=1
Dummy0005=1
Dummy0006=1
Dummy0007=1

[Comments]
Lines=0

)";

std::string_view access_name(const Entry& entry) {
  switch (entry.access) {
    case Access::ro: return "ro";
    case Access::wo: return "wo";
    case Access::rw: return entry.rx_mappable ? "rww" : "rw";
    case Access::constant: return "const";
  }
  return "";
}

std::int64_t signed_value(const Entry& entry) {
  const std::size_t unused = 64 - 8 * entry.default_value.size();
  return static_cast<std::int64_t>(conform::load_le(entry.default_value) << unused) >> unused;
}

std::string default_text(const Entry& first, std::uint8_t node_id) {
  const std::uint64_t value = conform::load_le(first.default_value);
  if (is_unsigned_integer(first.type)) {
    if (first.adds_node_id) return fmt::format(FMT_COMPILE("$NODEID+{:#x}"), value - node_id);
    return fmt::format(FMT_COMPILE("{:#x}"), value);
  }
  if (is_signed_integer(first.type)) return std::to_string(signed_value(first));
  switch (first.type) {
    case DataType::real32: return fmt::format("{}", std::bit_cast<float>(static_cast<std::uint32_t>(value)));
    case DataType::real64: return fmt::format("{}", std::bit_cast<double>(value));
    case DataType::visible_string: return {first.default_value.begin(), first.default_value.end()};
    case DataType::octet_string: return conform::hex_bytes(first.default_value);
    default: return {};  // UNICODE_STRING, times and DOMAIN have no agreed notation
  }
}

// Bit 0: not to be written by a configuration tool; bit 1: not to be read in a scan.
unsigned flags(std::uint16_t index, std::uint8_t sub, const Entry& entry) {
  if (index == 0x1003 && sub != 0) return 2;
  return entry.command ? 1 : 0;
}

// The formats of what is written for every entry are read by the compiler: the text is made anew for each
// upload.
void add_entry(std::string& text, std::uint16_t index, std::uint8_t sub, const Entry& entry,
               std::uint8_t node_id) {
  constexpr unsigned variable = 0x7;
  constexpr unsigned domain = 0x2;
  const bool changes = entry.read != nullptr;  // what is read is not what was configured
  const auto out = std::back_inserter(text);
  fmt::format_to(out, FMT_COMPILE("ParameterName={}\nObjectType={:#x}\nDataType=0x{:04X}\nAccessType={}\n"),
                 entry.name, entry.type == DataType::domain ? domain : variable,
                 static_cast<unsigned>(entry.type), access_name(entry));
  // What CiA 306 says of a key that is not there is left out: 1021h is as long as this text.
  const auto value = changes ? std::string() : default_text(entry, node_id);
  if (!value.empty()) fmt::format_to(out, FMT_COMPILE("DefaultValue={}\n"), value);
  if (entry.rx_mappable || entry.tx_mappable) text += "PDOMapping=1\n";
  if (entry.type != DataType::boolean) {
    if (entry.low) fmt::format_to(out, "LowLimit={}\n", *entry.low);
    if (entry.high) fmt::format_to(out, "HighLimit={}\n", *entry.high);
  }
  if (const unsigned bits = flags(index, sub, entry); bits != 0)
    fmt::format_to(out, "ObjFlags={:#x}\n", bits);
  text += "\n";
}

void add_object(std::string& text, std::uint16_t index, const Object& object, std::uint8_t node_id) {
  const auto out = std::back_inserter(text);
  if (object.kind == ObjectKind::variable) {
    if (!object.entries.contains(0)) return;
    fmt::format_to(out, "[{:04X}]\n", index);
    return add_entry(text, index, 0, object.entries.at(0), node_id);
  }
  fmt::format_to(out, "[{:04X}]\nParameterName={}\nObjectType={:#x}\nSubNumber={:#x}\n\n", index, object.name,
                 object.kind == ObjectKind::array ? 0x8U : 0x9U, object.entries.size());
  for (const auto& [sub, entry] : object.entries) {
    fmt::format_to(out, FMT_COMPILE("[{:04X}sub{:X}]\n"), index, sub);
    add_entry(text, index, sub, entry, node_id);
  }
}

std::string list_text(std::string_view section, const std::vector<std::uint16_t>& indices) {
  std::string text = fmt::format("[{}]\nSupportedObjects={}\n", section, indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) text += fmt::format("{}=0x{:04X}\n", i + 1, indices[i]);
  return text + "\n";
}

std::string module_text() {
  std::string text = fmt::format("[SupportedModules]\nNrOfEntries={}\n", modules.size());
  for (std::size_t i = 0; i < modules.size(); ++i) text += fmt::format("{}={}\n", i + 1, modules[i].name);
  text += "\n";
  for (std::size_t i = 0; i < modules.size(); ++i) {
    text += fmt::format(
        "[M{}ModuleInfo]\nProductName={}\nProductVersion=1\nProductRevision=0\nOrderCode={:04X}\n\n", i + 1,
        modules[i].name, modules[i].identifier);
  }
  return text;
}

}  // namespace

std::string eds_text() {
  const auto one = Node::create({1, {}, {}, {}});
  CONFORM_CHECK(one.has_value());
  return eds_text((*one)->dictionary(), 1);
}

std::string eds_text(const ObjectDictionary& dictionary, std::uint8_t node_id) {
  std::vector<std::uint16_t> mandatory, optional, manufacturer;
  std::string objects;
  for (const auto& [index, object] : dictionary.objects()) {
    const bool required = index == 0x1000 || index == 0x1001 || index == 0x1018;
    const bool own = index >= 0x2000 && index <= 0x5FFF;
    (required ? mandatory : own ? manufacturer : optional).push_back(index);
    add_object(objects, index, object, node_id);
  }
  const auto pdos = [&dictionary](std::uint16_t first, std::uint16_t last) {
    const auto& all = dictionary.objects();
    return std::distance(all.lower_bound(first), all.upper_bound(last));
  };
  return fmt::format(header, dictionary.number(0x1018, 1), dictionary.number(0x1018, 2),
                     dictionary.number(0x1018, 3), pdos(0x1400, 0x15FF), pdos(0x1800, 0x19FF)) +
         list_text("MandatoryObjects", mandatory) + list_text("OptionalObjects", optional) +
         list_text("ManufacturerObjects", manufacturer) + module_text() + objects;
}

}  // namespace refnode
