// SPDX-License-Identifier: Apache-2.0
#include "eds/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "base/text.hpp"
#include "eds/dialect.hpp"
#include "eds/expand.hpp"
#include "eds/file_date.hpp"
#include "eds/ini_file.hpp"
#include "eds/same_value.hpp"

namespace conform::eds {
namespace {

std::string_view text_of(const Field& field, std::string_view otherwise = {}) {
  return field.empty() ? otherwise : std::string_view(field.text);
}

template <typename Value>
bool same_reading(std::string_view a, std::string_view b, const std::optional<Value>& x,
                  const std::optional<Value>& y) {
  return x && y ? x == y : a == b;
}

bool same_count(std::string_view a, std::string_view b) {
  return same_number(a.empty() ? "0" : a, b.empty() ? "0" : b);
}

/// Of everything that needs no more than the two texts.
bool same_text(Meaning meaning, std::string_view a, std::string_view b) {
  switch (meaning) {
    case Meaning::number: return same_number(a, b);
    case Meaning::flag: return same_flag(a, b);
    case Meaning::count: return same_count(a, b);
    case Meaning::word: return same_word(a, b);
    case Meaning::date: return same_reading(a, b, file_date(a), file_date(b));
    case Meaning::time: return same_reading(a, b, file_time(a), file_time(b));
    default: return a == b;
  }
}

class Comparer {
 public:
  Comparer(const EdsFile& before, const EdsFile& after) : before_(before), after_(after) {}

  Result<Comparison> run() {
    auto left = expand(before_);
    if (!left) return std::unexpected(left.error());
    auto right = expand(after_);
    if (!right) return std::unexpected(right.error());
    into_ = &out_.of_file;
    fields<FileInfo>("[FileInfo]", before_.file_info, after_.file_info, file_info_fields);
    comments();
    into_ = &out_.of_device;
    fields<DeviceInfo>("[DeviceInfo]", before_.device_info, after_.device_info, device_info_fields);
    flags("[DeviceInfo]", "BaudRate_", before_.device_info.baud_rates, after_.device_info.baud_rates, 10);
    flags("[DummyUsage]", "Dummy", before_.dummy_usage.entries, after_.dummy_usage.entries, 16);
    fields<DeviceCommissioning>("[DeviceComissioning]", before_.commissioning, after_.commissioning,
                                commissioning_fields);
    modules();
    objects(*left, *right);
    return std::move(out_);
  }

 private:
  /// One file is of CiA 306, the other of CiA 311.
  [[nodiscard]] bool across() const { return before_.is_xml() != after_.is_xml(); }

  void changed(std::vector<Difference>& into, std::string where, std::string name, std::string_view key,
               const Field& a, const Field& b) {
    into.push_back({Difference::Kind::changed, std::move(where), std::move(name), std::string(key), a.text,
                    b.text, a.at, b.at});
  }

  /// Where a difference of this key belongs: silence of a format that cannot say it is no change.
  [[nodiscard]] std::vector<Difference>& list_of(std::string_view key, const Field& a, const Field& b) {
    const auto& in_xml = before_.is_xml() ? a : b;
    return across() && only_in_ini(key) && in_xml.empty() ? out_.unsayable : *into_;
  }

  template <typename Section>
  void fields(const std::string& where, const Section& a, const Section& b,
              std::span<const FieldRow<Section>> rows) {
    for (const auto& row : rows) {
      // The dictionary in full has what it implies.
      if (row.key == "CompactPDO") continue;
      const auto& x = a.*row.field;
      const auto& y = b.*row.field;
      if (!same_text(meaning_of(row.key), text_of(x), text_of(y)))
        changed(list_of(row.key, x, y), where, {}, row.key, x, y);
    }
  }

  void flags(const std::string& where, std::string_view prefix, const std::vector<NumberedField>& a,
             const std::vector<NumberedField>& b, int base) {
    std::map<std::uint64_t, std::pair<Field, Field>> both;
    for (const auto& entry : a) both[entry.number].first = entry.field;
    for (const auto& entry : b) both[entry.number].second = entry.field;
    for (const auto& [number, pair] : both) {
      // Not to be named and to be named with 0 is the same.
      if (same_flag(pair.first.text, pair.second.text)) continue;
      const bool rate = base == 10;
      const bool sayable = !rate || !across() || (is_ini_bit_rate(number) && is_xml_bit_rate(number));
      changed(sayable ? *into_ : out_.unsayable, where, {},
              rate ? fmt::format("{}{}", prefix, number) : fmt::format("{}{:04X}", prefix, number),
              pair.first, pair.second);
    }
  }

  void comments() {
    std::map<std::uint64_t, std::pair<Field, Field>> both;
    for (const auto& line : before_.comments.entries) both[line.number].first = line.field;
    for (const auto& line : after_.comments.entries) both[line.number].second = line.field;
    for (const auto& [number, pair] : both) {
      if (pair.first.text != pair.second.text)
        changed(across() ? out_.unsayable : *into_, "[Comments]", {}, fmt::format("Line{}", number),
                pair.first, pair.second);
    }
  }

  /// CiA 311 describes a module in a file of its own.
  void modules() {
    const auto& ini = before_.is_xml() ? after_ : before_;
    if (!across() || (ini.modules.empty() && ini.supported_modules.entries.empty())) return;
    Difference out;
    out.kind = before_.is_xml() ? Difference::Kind::added : Difference::Kind::removed;
    out.where = "[SupportedModules]";
    (before_.is_xml() ? out.at_after : out.at_before) = ini.supported_modules.at;
    out_.unsayable.push_back(std::move(out));
  }

  void whole(Difference::Kind kind, std::string where, const Entry& entry) {
    Difference out;
    out.kind = kind;
    out.where = std::move(where);
    out.name = entry.parameter_name.text;
    (kind == Difference::Kind::added ? out.at_after : out.at_before) = entry.at;
    into_->push_back(std::move(out));
  }

  void objects(const std::vector<Object>& left, const std::vector<Object>& right) {
    std::map<Index, std::pair<const Object*, const Object*>> both;
    for (const auto& object : left) both[object.index].first = &object;
    for (const auto& object : right) both[object.index].second = &object;
    for (const auto& [index, pair] : both) {
      const auto [a, b] = pair;
      if (a == nullptr)
        whole(Difference::Kind::added, to_string(index), b->entry);
      else if (b == nullptr)
        whole(Difference::Kind::removed, to_string(index), a->entry);
      else
        object(*a, *b);
    }
  }

  void object(const Object& a, const Object& b) {
    entry(to_string(a.index), a.entry, b.entry);
    std::map<SubIndex, std::pair<const Entry*, const Entry*>> both;
    for (const auto& sub : a.subs) both[sub.sub].first = &sub.entry;
    for (const auto& sub : b.subs) both[sub.sub].second = &sub.entry;
    for (const auto& [sub, pair] : both) {
      const auto where = to_string(Multiplexer{a.index, sub});
      if (pair.first == nullptr)
        whole(Difference::Kind::added, where, *pair.second);
      else if (pair.second == nullptr)
        whole(Difference::Kind::removed, where, *pair.first);
      else
        entry(where, *pair.first, *pair.second);
    }
  }

  void entry(const std::string& where, const Entry& a, const Entry& b) {
    // Of a changed data type the new one decides how the values are read.
    const auto type = data_type(b) ? data_type(b) : data_type(a);
    for (const auto& row : entry_fields) {
      const auto& x = a.*row.field;
      const auto& y = b.*row.field;
      if (same_entry_field(row.key, a, b, x, y, type)) continue;
      auto& into = is_sayable(row.key, a, b) ? list_of(row.key, x, y) : out_.unsayable;
      changed(into, where, b.parameter_name.text, row.key, x, y);
    }
  }

  [[nodiscard]] bool same_entry_field(std::string_view key, const Entry& a, const Entry& b, const Field& x,
                                      const Field& y, std::optional<std::uint16_t> type) const {
    const auto before = text_of(x, implied_meaning(key, a));
    const auto after = text_of(y, implied_meaning(key, b));
    const auto meaning = meaning_of(key);
    switch (meaning) {
      case Meaning::value: return same_value(before, after, type);
      case Meaning::access: {
        if (same_word(before, after)) return true;
        const auto left = reach(a).access;
        return left.has_value() && left == reach(b).access;
      }
      case Meaning::mapping:
        // The same word is no change of its own where the access changes what it means.
        if (!before.empty() && same_number(before, after)) return true;
        return reach(a).mapped == reach(b).mapped && (across() || is_default(a) == is_default(b));
      default: return same_text(meaning, before, after);
    }
  }

  /// `default` says more than `optional`, but only CiA 311 can say it.
  static bool is_default(const Entry& entry) { return same_word(entry.pdo_mapping.text, "default"); }

  /// CiA 306 has no word for an `ro` object that goes into an RPDO, and only two bits of ObjFlags.
  [[nodiscard]] bool is_sayable(std::string_view key, const Entry& a, const Entry& b) const {
    if (!across()) return true;
    const auto& in_ini = before_.is_xml() ? b : a;
    const auto& in_xml = before_.is_xml() ? a : b;
    if (key == "ObjFlags")
      return ((number_of(in_xml.obj_flags).value_or(0) ^ number_of(in_ini.obj_flags).value_or(0)) & 3U) != 0;
    if (key != "PDOMapping") return true;
    const auto xml = reach(in_xml);
    return !xml.mapped.any() || xml.mapped == directions_of(xml.access) || !reach(in_ini).mapped.any();
  }

  const EdsFile& before_;
  const EdsFile& after_;
  Comparison out_;
  std::vector<Difference>* into_ = nullptr;
};

}  // namespace

Result<Comparison> compare_in_full(const EdsFile& before, const EdsFile& after) {
  return Comparer(before, after).run();
}

Result<std::vector<Difference>> compare(const EdsFile& before, const EdsFile& after) {
  auto full = compare_in_full(before, after);
  if (!full) return std::unexpected(full.error());
  return std::move(full->of_device);
}

}  // namespace conform::eds
