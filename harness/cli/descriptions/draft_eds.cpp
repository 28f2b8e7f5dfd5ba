// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/draft_eds.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/data_type.hpp"
#include "device/standard_objects.hpp"

namespace conform::cli {
namespace {

using canopen::DataType;
using device::Access;
using engine::ScannedEntry;
using engine::ScannedObject;

constexpr std::size_t longest_string = 255;  ///< more is taken for a DOMAIN

bool is_text(ByteView bytes) {
  return std::ranges::all_of(bytes, [](std::uint8_t c) { return c >= 0x20 && c < 0x7F; });
}

DataType type_of(const ScannedEntry& entry) {
  if (!entry.value) return DataType::octet_string;
  const auto& value = *entry.value;
  switch (value.size()) {
    case 1: return DataType::unsigned8;
    case 2: return DataType::unsigned16;
    case 3: return DataType::unsigned24;
    case 4: return DataType::unsigned32;
    case 8: return is_text(value) ? DataType::visible_string : DataType::unsigned64;
    default: break;
  }
  if (value.size() > longest_string) return DataType::domain;
  return is_text(value) ? DataType::visible_string : DataType::octet_string;
}

std::string default_of(const ScannedEntry& entry, DataType type, NodeId node) {
  if (!entry.value || !canopen::is_integer(type)) return {};
  const auto number = load_le(*entry.value);
  const auto index = entry.mux.index.value();
  const bool standard = index < 0x2000;
  if (standard && canopen::is_integer(type)) {
    const auto known = device::standard_entry(entry.mux);
    if (known && known->default_adds_node_id && known->default_value &&
        number == load_le(*known->default_value) + node.value())
      return fmt::format("$NODEID+0x{:X}", load_le(*known->default_value));
  }
  return fmt::format("0x{:X}", number);
}

/// Whether the value read is likely to be the default of every such device, too.
bool is_constant(Multiplexer mux, bool structured) {
  const auto index = mux.index.value();
  return index == 0x1000 || (index == 0x1018 && mux.sub.value() < 4) ||
         (structured && mux.sub.value() == 0 && index != 0x1003);
}

class Draft {
 public:
  Draft(std::span<const ScannedObject> objects, const DraftInfo& info) : objects_(objects), info_(info) {
    for (const auto& object : objects) {
      const auto index = object.index.value();
      auto* const mapped = index >= 0x1600 && index <= 0x17FF   ? &received_
                           : index >= 0x1A00 && index <= 0x1BFF ? &transmitted_
                                                                : nullptr;
      if (mapped == nullptr) continue;
      for (const auto& entry : object.entries) {
        if (entry.mux.sub.value() == 0 || !entry.value || entry.value->size() != 4) continue;
        mapped->insert(static_cast<std::uint32_t>(load_le(*entry.value) >> 8U));
      }
    }
  }

  std::string text() {
    for (const auto& object : objects_) describe(object);
    header();
    list("MandatoryObjects", [](unsigned index) { return is_mandatory(index); });
    list("OptionalObjects", [](unsigned index) { return !is_mandatory(index) && !is_own(index); });
    list("ManufacturerObjects", is_own);
    modules();
    return out_ + sections_;
  }

 private:
  static bool is_mandatory(unsigned index) { return index == 0x1000 || index == 0x1001 || index == 0x1018; }
  static bool is_own(unsigned index) { return index >= 0x2000 && index <= 0x5FFF; }

  template <typename... Args>
  static void line(std::string& out, fmt::format_string<Args...> form, Args&&... args) {
    out += fmt::format(form, std::forward<Args>(args)...);
    out += "\r\n";
  }

  [[nodiscard]] std::uint64_t number(std::uint16_t index, std::uint8_t sub) const {
    for (const auto& object : objects_) {
      if (object.index.value() != index) continue;
      for (const auto& entry : object.entries) {
        if (entry.mux.sub.value() == sub && entry.value && entry.value->size() == 4)
          return load_le(*entry.value);
      }
    }
    return 0;
  }
  [[nodiscard]] std::string string(std::uint16_t index) const {
    for (const auto& object : objects_) {
      if (object.index.value() != index) continue;
      const auto& value = object.entries.front().value;
      if (value && is_text(*value)) return {value->begin(), value->end()};
    }
    return {};
  }
  [[nodiscard]] std::size_t count(unsigned first, unsigned last) const {
    return static_cast<std::size_t>(std::ranges::count_if(objects_, [&](const ScannedObject& each) {
      return each.index.value() >= first && each.index.value() <= last;
    }));
  }

  void header() {
    const auto name = info_.file_name.empty() ? std::string("draft.eds") : info_.file_name;
    const auto made = fmt::gmtime(info_.made);
    const auto product = string(0x1008);
    line(out_, "[FileInfo]\r\nFileName={}\r\nFileVersion=1\r\nFileRevision=0\r\nEDSVersion=4.0", name);
    line(out_, "Description=Draft made from a scan of node {}", info_.node.value());
    line(out_, "CreationTime={:%I:%M%p}\r\nCreationDate={:%m-%d-%Y}\r\nCreatedBy=canopen-conform scan", made,
         made);
    line(out_,
         "ModificationTime={:%I:%M%p}\r\nModificationDate={:%m-%d-%Y}\r\nModifiedBy=canopen-conform scan\r\n",
         made, made);
    line(out_, "[DeviceInfo]\r\nVendorName=unknown\r\nVendorNumber={:#x}", number(0x1018, 1));
    line(out_, "ProductName={}\r\nProductNumber={:#x}\r\nRevisionNumber={:#x}",
         product.empty() ? "unknown" : product, number(0x1018, 2), number(0x1018, 3));
    line(out_, "OrderCode=");
    for (const unsigned rate : {10U, 20U, 50U, 125U, 250U, 500U, 800U, 1000U})
      line(out_, "BaudRate_{}={}", rate, info_.bit_rate == rate * 1000U ? 1 : 0);
    const bool maps = count(0x1600, 0x17FF) + count(0x1A00, 0x1BFF) > 0;
    line(out_, "SimpleBootUpMaster=0\r\nSimpleBootUpSlave=1\r\nGranularity={}", maps ? 8 : 0);
    line(
        out_,
        "DynamicChannelsSupported=0\r\nGroupMessaging=0\r\nNrOfRXPDO={}\r\nNrOfTXPDO={}\r\nLSS_Supported=0\r\n",
        count(0x1400, 0x15FF), count(0x1800, 0x19FF));
    line(out_, "[DummyUsage]");
    for (unsigned type = 1; type <= 7; ++type) line(out_, "Dummy{:04}=0", type);
    comments();
  }

  void comments() {
    std::vector<std::string> lines = {
        "A draft: reading shows neither access rights nor limits nor defaults.",
        "Objects that CiA 301 does not define are rw here (ro, rww: mapped) and have the type that fits the length.",
        "Complete it from the manual, then check it: canopen-conform eds lint FILE",
    };
    lines.insert(lines.end(), doubts_.begin(), doubts_.end());
    line(out_, "\r\n[Comments]\r\nLines={}", lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i) line(out_, "Line{}={}", i + 1, lines[i]);
    out_ += "\r\n";
  }

  void list(std::string_view section, bool (*belongs)(unsigned)) {
    std::vector<std::uint16_t> indices;
    for (const auto& object : objects_) {
      if (belongs(object.index.value())) indices.push_back(object.index.value());
    }
    line(out_, "[{}]\r\nSupportedObjects={}", section, indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) line(out_, "{}=0x{:04X}", i + 1, indices[i]);
    out_ += "\r\n";
  }

  /// 1027h counts modules, but does not name them.
  void modules() {
    for (const auto& object : objects_) {
      if (object.index.value() != 0x1027) continue;
      const auto& count = object.entries.front().value;
      const unsigned last = count && !count->empty() ? count->front() : 0;
      line(out_, "[SupportedModules]\r\nNrOfEntries={}", last);
      for (unsigned i = 1; i <= last; ++i) line(out_, "{}=Module {}", i, i);
      for (unsigned i = 1; i <= last; ++i) {
        line(
            out_,
            "\r\n[M{}ModuleInfo]\r\nProductName=Module {}\r\nProductVersion=1\r\nProductRevision=0\r\nOrderCode=",
            i, i);
      }
      out_ += "\r\n";
    }
  }

  void describe(const ScannedObject& object) {
    const auto index = object.index.value();
    const auto known = device::standard_entry({object.index, SubIndex(0)});
    const bool complex =
        known ? known->object == device::ObjectCode::array || known->object == device::ObjectCode::record
              : object.entries.size() > 1;
    if (!complex) {
      line(sections_, "[{:04X}]", index);
      return entry(object.entries.front(), fmt::format("Object {:04X}h", index), false);
    }
    // Elements of one length make an array, as far as one can see.
    const bool alike = std::ranges::all_of(object.entries, [&](const ScannedEntry& each) {
      return each.mux.sub.value() == 0 || type_of(each) == type_of(object.entries.back());
    });
    const bool array = known ? known->object == device::ObjectCode::array : alike;
    line(sections_, "[{:04X}]\r\nParameterName=Object {:04X}h\r\nObjectType={:#x}\r\nSubNumber={:#x}\r\n",
         index, index, array ? 8 : 9, object.entries.size());
    for (const auto& each : object.entries) {
      line(sections_, "[{:04X}sub{:X}]", index, each.mux.sub.value());
      entry(each,
            each.mux.sub.value() == 0 ? "Highest sub-index supported"
                                      : fmt::format("Sub-index {:02X}h", each.mux.sub.value()),
            true);
    }
  }

  void entry(const ScannedEntry& scanned, std::string name, bool structured) {
    const auto known = device::standard_entry(scanned.mux);
    const bool fits = known && (!scanned.value || !known->size() || *known->size() == scanned.value->size() ||
                                (scanned.size_open && *known->size() < 4));
    auto type = fits ? known->type : type_of(scanned);
    auto access = known                                        ? known->access
                  : structured && scanned.mux.sub.value() == 0 ? Access::constant
                                                               : Access::rw;
    if (known) name = known->name;
    // A value that goes into a TPDO is most likely made by the device, one that comes in an RPDO is not.
    const auto key = static_cast<std::uint32_t>(scanned.mux.index.value()) << 8U | scanned.mux.sub.value();
    const bool received = received_.contains(key), transmitted = transmitted_.contains(key);
    if (!known && received != transmitted) access = received ? Access::rww : Access::ro;
    const auto at = to_string(scanned.mux);
    if (known && !fits)
      doubts_.push_back(fmt::format("{} has {} bytes, not those of CiA 301", at, scanned.value->size()));
    if (!scanned.value) {
      if (scanned.abort == canopen::abort::write_only) {
        access = Access::wo;
      } else {
        doubts_.push_back(
            fmt::format("{} could not be read{}", at,
                        scanned.abort ? ": abort " + to_string(*scanned.abort) : std::string()));
      }
      if (!known) doubts_.push_back(fmt::format("the type of {} is not known", at));
    } else if (!known && scanned.size_open) {
      doubts_.push_back(fmt::format("{} may be shorter: the device does not tell the length", at));
    }
    line(sections_, "ParameterName={}\r\nObjectType={:#x}\r\nDataType=0x{:04X}\r\nAccessType={}", name,
         type == DataType::domain ? 2 : 7, static_cast<unsigned>(type), device::to_string(access));
    line(sections_, "DefaultValue={}",
         is_constant(scanned.mux, structured) ? default_of(scanned, type, info_.node) : std::string());
    line(sections_, "PDOMapping={}\r\n", received || transmitted ? 1 : 0);
  }

  std::span<const ScannedObject> objects_;
  const DraftInfo& info_;
  std::set<std::uint32_t> received_,
      transmitted_;  ///< index and sub-index of what RPDOs and TPDOs map at present
  std::vector<std::string> doubts_;
  std::string out_, sections_;
};

}  // namespace

std::string draft_eds(std::span<const ScannedObject> objects, const DraftInfo& info) {
  return Draft(objects, info).text();
}

}  // namespace conform::cli
