// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/draft_eds.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "base/text.hpp"
#include "canopen/data_type.hpp"
#include "cli/descriptions/drafted_entry.hpp"
#include "device/standard_objects.hpp"

namespace conform::cli {
namespace {

using canopen::DataType;
using engine::ScannedEntry;
using engine::ScannedObject;

bool is_text(ByteView bytes) {
  return std::ranges::all_of(bytes, [](std::uint8_t c) { return c >= 0x20 && c < 0x7F; });
}

class Draft {
 public:
  Draft(std::span<const ScannedObject> objects, const DraftInfo& info)
      : objects_(objects), info_(info), drafter_(objects, info.node) {}

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
    line(out_, "OrderCode=unknown");
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
        "A draft: limits cannot be seen, and the defaults are the values that the device held.",
        info_.access_tried
            ? "Access rights are those that the device showed when it got its own values back, as far as that was tried."
            : "Reading shows no access rights: what CiA 301 does not define is rw here (ro, rww: mapped).",
        "Complete it from the manual, then check it: canopen-conform eds lint FILE",
    };
    lines.insert(lines.end(), doubts_.begin(), doubts_.end());
    add_lengths(lines);
    line(out_, "\r\n[Comments]\r\nLines={}", lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i) line(out_, "Line{}={}", i + 1, lines[i]);
    out_ += "\r\n";
  }

  /// Which types are no more than a length, a few objects a line.
  void add_lengths(std::vector<std::string>& lines) const {
    constexpr std::size_t a_line = 12;
    if (lengths_.empty()) return;
    lines.emplace_back("Of these numbers the length is known, but not whether they are signed or REAL:");
    for (std::size_t i = 0; i < lengths_.size(); i += a_line) {
      const auto end = std::min(i + a_line, lengths_.size());
      std::string line;
      for (auto each = i; each < end; ++each) line += (each == i ? "" : ", ") + lengths_[each];
      lines.push_back(std::move(line));
    }
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
            "\r\n[M{}ModuleInfo]\r\nProductName=Module {}\r\nProductVersion=1\r\nProductRevision=0\r\nOrderCode=unknown",
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
    lengths_from_ = lengths_to_ = std::nullopt;
    if (!complex) {
      line(sections_, "[{:04X}]", index);
      entry(object.entries.front(), false);
    } else {
      // Elements of one length make an array, as far as one can see.
      const bool alike = std::ranges::all_of(object.entries, [&](const ScannedEntry& each) {
        return each.mux.sub.value() == 0 ||
               EntryDrafter::type_by_length(each) == EntryDrafter::type_by_length(object.entries.back());
      });
      const bool array = known ? known->object == device::ObjectCode::array : alike;
      line(sections_, "[{:04X}]\r\nParameterName=Object {:04X}h\r\nObjectType={:#x}\r\nSubNumber={:#x}\r\n",
           index, index, array ? 8 : 9, object.entries.size());
      for (const auto& each : object.entries) {
        line(sections_, "[{:04X}sub{:X}]", index, each.mux.sub.value());
        entry(each, true);
      }
    }
    close_lengths();
  }

  void entry(const ScannedEntry& scanned, bool structured) {
    const auto drafted = drafter_.draft(scanned, structured);
    doubts_.insert(doubts_.end(), drafted.doubts.begin(), drafted.doubts.end());
    if (drafted.length_only) {
      if (!lengths_from_) lengths_from_ = scanned.mux;
      lengths_to_ = scanned.mux;
    } else {
      close_lengths();
    }
    line(sections_, "ParameterName={}\r\nObjectType={:#x}\r\nDataType=0x{:04X}\r\nAccessType={}",
         drafted.name, drafted.type == DataType::domain ? 2 : 7, static_cast<unsigned>(drafted.type),
         device::to_string(drafted.access));
    line(sections_, "DefaultValue={}", drafted.default_value);
    line(sections_, "PDOMapping={}\r\n", drafted.mapped ? 1 : 0);
  }

  /// Ends a run of entries of which only the length is known: "2000h:01-06".
  void close_lengths() {
    if (!lengths_from_) return;
    lengths_.push_back(*lengths_from_ == *lengths_to_
                           ? to_string(*lengths_from_)
                           : fmt::format("{}-{:02X}", to_string(*lengths_from_), lengths_to_->sub.value()));
    lengths_from_ = lengths_to_ = std::nullopt;
  }

  std::span<const ScannedObject> objects_;
  const DraftInfo& info_;
  EntryDrafter drafter_;
  std::vector<std::string> doubts_, lengths_;
  std::optional<Multiplexer> lengths_from_, lengths_to_;
  std::string out_, sections_;
};

}  // namespace

std::string draft_eds(std::span<const ScannedObject> objects, const DraftInfo& info) {
  return Draft(objects, info).text();
}

}  // namespace conform::cli
