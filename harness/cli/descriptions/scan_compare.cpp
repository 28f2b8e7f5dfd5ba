// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/scan_compare.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "cli/descriptions/drafted_entry.hpp"

namespace conform::cli {
namespace {

using device::Entry;
using engine::ScannedEntry;

constexpr std::size_t longest_shown = 16;

bool is_mapping(Index index) {
  const auto value = index.value();
  return (value >= 0x1600 && value <= 0x17FF) || (value >= 0x1A00 && value <= 0x1BFF);
}

std::string shown(ByteView value, canopen::DataType type) {
  if (canopen::is_integer(type) && value.size() <= 8) return fmt::format("0x{:X}", load_le(value));
  const auto cut = value.first(std::min(value.size(), longest_shown));
  const std::string more = cut.size() < value.size() ? " ..." : "";
  if (type == canopen::DataType::visible_string) return printable(std::string(cut.begin(), cut.end())) + more;
  return hex_bytes(cut) + more;
}

std::string bytes_word(std::size_t size) { return fmt::format("{} byte{}", size, size == 1 ? "" : "s"); }

class Comparison {
 public:
  Comparison(std::span<const engine::ScannedObject> objects, const engine::ScanOptions& scanned,
             const eds::EdsFile& file, const device::Description& description, NodeId node)
      : objects_(objects),
        scanned_(scanned),
        file_(file),
        description_(description),
        drafter_(objects, node) {
    for (const auto& object : objects) {
      for (const auto& entry : object.entries) seen_.emplace(entry.mux, &entry);
    }
    for (const auto& entry : description.entries) described_.emplace(entry.mux, device::at_node(entry, node));
  }

  std::vector<ScanDifference> run() {
    device_info();
    // Both are ascending; what only one of them has stands in its place.
    std::map<Multiplexer, bool> all;
    for (const auto& [mux, entry] : seen_) all.emplace(mux, true);
    for (const auto& [mux, entry] : described_) all.emplace(mux, true);
    for (const auto& [mux, ignored] : all) look(mux);
    return std::move(out_);
  }

 private:
  void add(std::string object, std::string property, std::string device, std::string described,
           std::string where) {
    out_.push_back(
        {std::move(object), std::move(property), std::move(device), std::move(described), std::move(where)});
  }
  [[nodiscard]] bool in_range(Index index) const {
    return std::ranges::any_of(scanned_.ranges, [index](const engine::IndexRange& range) {
      return index.value() >= range.first && index.value() <= range.last;
    });
  }
  /// The line of the entry, else of its object, else the file.
  [[nodiscard]] std::string place(Multiplexer mux) const {
    const auto& places = description_.places;
    if (const auto found = places.entries.find(mux); found != places.entries.end()) return found->second;
    if (const auto found = places.objects.find(mux.index); found != places.objects.end())
      return found->second;
    return description_.file;
  }

  void look(Multiplexer mux) {
    if (!in_range(mux.index) || scanned_.skip.contains(mux)) return;
    const auto seen = seen_.find(mux);
    const auto described = described_.find(mux);
    if (described == described_.end())
      return add(to_string(mux), "presence", "there", "not described", place(mux));
    if (seen == seen_.end()) {
      if (!is_hidden(mux)) add(to_string(mux), "presence", "absent", "described", place(mux));
      return;
    }
    compare(*seen->second, described->second);
  }

  /// Whether a device may keep it to itself for now (7.5.2.3, 7.5.2.36).
  [[nodiscard]] bool is_hidden(Multiplexer mux) const {
    if (mux.sub.value() == 0) return false;
    if (mux.index != Index(0x1003) && !is_mapping(mux.index)) return false;
    const auto count = seen_.find({mux.index, SubIndex(0)});
    if (count == seen_.end()) return false;
    const auto& value = count->second->value;
    return value && !value->empty() && mux.sub.value() > value->front();
  }

  void compare(const ScannedEntry& seen, const Entry& described) {
    const auto at = to_string(seen.mux);
    access(seen, described);
    mapping(seen, described);
    if (!seen.value) return;
    const auto size = described.size();
    const auto& value = *seen.value;
    if (size && !seen.size_open && value.size() != *size) {
      return add(at, "DataType", bytes_word(value.size()),
                 fmt::format("{} ({})", canopen::to_string(described.type), bytes_word(*size)),
                 place(seen.mux));
    }
    if (size && value.size() < *size) return;
    const auto bytes = ByteView(value).first(size.value_or(value.size()));
    limits(seen, described, bytes);
    if (!described.declared_default || !described.default_value || !is_of_every_device(described)) return;
    if (!std::ranges::equal(bytes, *described.default_value))
      add(at, "DefaultValue", shown(bytes, described.type), shown(*described.default_value, described.type),
          place(seen.mux));
  }

  static bool is_of_every_device(const Entry& entry) {
    const auto index = entry.mux.index.value();
    const auto sub = entry.mux.sub.value();
    if (index == 0x1000) return true;
    if (index == 0x1018) return sub <= 3;
    if (entry.may_change || index == 0x1003 || is_mapping(entry.mux.index)) return false;
    if (entry.access == device::Access::constant) return true;
    return sub == 0 && entry.object != device::ObjectCode::var && !entry.writable();
  }

  void access(const ScannedEntry& seen, const Entry& described) {
    const auto words = std::string(device::to_string(described.access));
    const auto differs = [&](const char* device) {
      add(to_string(seen.mux), "AccessType", device, words, place(seen.mux));
    };
    if (described.access_open) return;  // the file says nothing
    if (seen.value && !described.readable()) return differs("can be read");
    if (!seen.value && seen.abort == canopen::abort::write_only && described.readable()) return differs("wo");
    if (seen.writable && *seen.writable != described.writable())
      differs(*seen.writable ? "can be written" : "read-only");
  }

  void mapping(const ScannedEntry& seen, const Entry& described) {
    const auto key = mapping_key(seen.mux);
    const bool received = drafter_.received().contains(key), sent = drafter_.transmitted().contains(key);
    if (described.pdo_mappable || (!received && !sent)) return;
    add(to_string(seen.mux), "PDOMapping", received ? "mapped into an RPDO" : "mapped into a TPDO", "0",
        place(seen.mux));
  }

  void limits(const ScannedEntry& seen, const Entry& described, ByteView value) {
    if (!canopen::is_integer(described.type)) return;
    const std::uint64_t sign =
        canopen::is_signed(described.type) ? std::uint64_t{1} << (8 * value.size() - 1) : 0;
    const auto order = [sign](ByteView bytes) { return load_le(bytes) ^ sign; };
    if (described.low && described.low->size() == value.size() && order(value) < order(*described.low))
      add(to_string(seen.mux), "LowLimit", shown(value, described.type),
          shown(*described.low, described.type), place(seen.mux));
    if (described.high && described.high->size() == value.size() && order(value) > order(*described.high))
      add(to_string(seen.mux), "HighLimit", shown(value, described.type),
          shown(*described.high, described.type), place(seen.mux));
  }

  void device_info() {
    const auto& info = file_.device_info;
    const auto field_place = [this](const eds::Field& field) {
      return field.present && field.at.known() ? fmt::format("{}:{}", file_.name, field.at.line) : file_.name;
    };
    const auto compare_number = [&](const char* key, const eds::Field& field, std::uint64_t device) {
      const auto number = eds::number_of(field);
      if (number && *number != device)
        add("[DeviceInfo]", key, fmt::format("{:#x}", device), printable(field.text), field_place(field));
    };
    const std::array identity = {std::pair{"VendorNumber", &info.vendor_number},
                                 std::pair{"ProductNumber", &info.product_number},
                                 std::pair{"RevisionNumber", &info.revision_number}};
    for (std::size_t i = 0; i < identity.size(); ++i) {
      const auto seen = seen_.find({Index(0x1018), SubIndex(static_cast<std::uint8_t>(i + 1))});
      if (seen == seen_.end() || !seen->second->value || seen->second->value->size() != 4) continue;
      compare_number(identity[i].first, *identity[i].second, load_le(*seen->second->value));
    }
    const auto pdos = [&](const char* key, const eds::Field& field, std::uint16_t first) {
      const auto last = static_cast<std::uint16_t>(first + 0x1FF);
      const bool whole = std::ranges::any_of(scanned_.ranges, [&](const engine::IndexRange& range) {
        return range.first <= first && range.last >= last;
      });
      if (!whole) return;
      const auto count = std::ranges::count_if(objects_, [&](const engine::ScannedObject& object) {
        return object.index.value() >= first && object.index.value() <= last;
      });
      const auto number = eds::number_of(field);
      if (number && *number != static_cast<std::uint64_t>(count))
        add("[DeviceInfo]", key, std::to_string(count), printable(field.text), field_place(field));
    };
    pdos("NrOfRXPDO", info.nr_of_rx_pdo, 0x1400);
    pdos("NrOfTXPDO", info.nr_of_tx_pdo, 0x1800);
  }

  std::span<const engine::ScannedObject> objects_;
  const engine::ScanOptions& scanned_;
  const eds::EdsFile& file_;
  const device::Description& description_;
  EntryDrafter drafter_;
  std::map<Multiplexer, const ScannedEntry*> seen_;
  std::map<Multiplexer, Entry> described_;
  std::vector<ScanDifference> out_;
};

}  // namespace

std::set<Multiplexer> not_to_be_scanned(const device::Description& description) {
  std::set<Multiplexer> out;
  for (const auto& entry : description.entries) {
    if (entry.not_to_be_read) out.insert(entry.mux);
  }
  return out;
}

std::vector<Multiplexer> to_be_scanned(const device::Description& description,
                                       std::span<const engine::IndexRange> ranges) {
  std::vector<Multiplexer> out;
  for (const auto& entry : description.entries) {
    const auto index = entry.mux.index.value();
    const bool inside = std::ranges::any_of(ranges, [index](const engine::IndexRange& range) {
      return index >= range.first && index <= range.last;
    });
    if (inside) out.push_back(entry.mux);
  }
  return out;
}

std::vector<ScanDifference> compare_scan(std::span<const engine::ScannedObject> objects,
                                         const engine::ScanOptions& scanned, const eds::EdsFile& file,
                                         const device::Description& description, NodeId node) {
  return Comparison(objects, scanned, file, description, node).run();
}

std::string scan_differences_text(std::span<const ScanDifference> differences) {
  if (differences.empty()) return "no difference\n";
  const std::array<std::string, 5> head = {"object", "property", "device", "description", "where"};
  const auto columns = [](const ScanDifference& row) {
    return std::array<std::string, 5>{row.object, row.property, row.device, row.described, row.where};
  };
  std::array<std::size_t, 5> widths{};
  for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = head[i].size();
  for (const auto& row : differences) {
    const auto cells = columns(row);
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], cells[i].size());
  }
  std::string out;
  const auto line = [&](const std::array<std::string, 5>& cells) {
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) out += fmt::format("{:<{}}  ", cells[i], widths[i]);
    out += cells.back() + "\n";
  };
  line(head);
  for (const auto& row : differences) line(columns(row));
  out += fmt::format("{} difference{}\n", differences.size(), differences.size() == 1 ? "" : "s");
  return out;
}

std::string scan_differences_json(std::span<const ScanDifference> differences, std::string_view file) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& row : differences) {
    rows.push_back({{"object", row.object},
                    {"property", row.property},
                    {"device", row.device},
                    {"described", row.described},
                    {"where", row.where}});
  }
  const nlohmann::ordered_json out = {{"file", std::string(file)}, {"differences", std::move(rows)}};
  return out.dump(2) + "\n";
}

}  // namespace conform::cli
