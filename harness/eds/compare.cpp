// SPDX-License-Identifier: Apache-2.0
#include "eds/compare.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <span>
#include <utility>

#include "base/text.hpp"
#include "eds/expand.hpp"
#include "eds/ini_file.hpp"

namespace conform::eds {
namespace {

bool same_value(std::string_view a, std::string_view b) {
  if (a == b) return true;
  const auto x = parse_number(a);
  const auto y = parse_number(b);
  return x && y && x->magnitude == y->magnitude && x->negative == y->negative && x->node_id == y->node_id;
}

/// What a field says, with the standard's meaning of saying nothing.
std::string_view meaning(std::string_view key, const Field& field) {
  if (!field.empty()) return field.text;
  if (key == "ObjectType") return "7";
  if (key == "PDOMapping" || key == "ObjFlags" || key == "CompactPDO") return "0";
  return {};
}

class Comparer {
 public:
  Comparer(const EdsFile& before, const EdsFile& after) : before_(before), after_(after) {}

  Result<std::vector<Difference>> run() {
    fields<DeviceInfo>("[DeviceInfo]", {}, before_.device_info, after_.device_info, device_info_fields);
    numbered("[DeviceInfo]", "BaudRate_", before_.device_info.baud_rates, after_.device_info.baud_rates, 10);
    numbered("[DummyUsage]", "Dummy", before_.dummy_usage.entries, after_.dummy_usage.entries, 16);
    fields<DeviceCommissioning>("[DeviceComissioning]", {}, before_.commissioning, after_.commissioning,
                                commissioning_fields);
    auto left = expand(before_);
    if (!left) return std::unexpected(left.error());
    auto right = expand(after_);
    if (!right) return std::unexpected(right.error());
    objects(*left, *right);
    return std::move(out_);
  }

 private:
  void changed(std::string where, std::string name, std::string_view key, const Field& a, const Field& b) {
    out_.push_back({Difference::Kind::changed, std::move(where), std::move(name), std::string(key), a.text,
                    b.text, a.at, b.at});
  }

  template <typename Section>
  void fields(const std::string& where, const std::string& name, const Section& a, const Section& b,
              std::span<const FieldRow<Section>> rows) {
    for (const auto& row : rows) {
      const auto& x = a.*row.field;
      const auto& y = b.*row.field;
      const bool words = row.key == "AccessType" && same_word(x.text, y.text);
      if (!words && !same_value(meaning(row.key, x), meaning(row.key, y)))
        changed(where, name, row.key, x, y);
    }
  }

  void numbered(const std::string& where, std::string_view prefix, const std::vector<NumberedField>& a,
                const std::vector<NumberedField>& b, int base) {
    std::map<std::uint64_t, std::pair<Field, Field>> both;
    for (const auto& entry : a) both[entry.number].first = entry.field;
    for (const auto& entry : b) both[entry.number].second = entry.field;
    for (const auto& [number, pair] : both) {
      // Not to be named and to be named with 0 is the same.
      if (flag_of(pair.first).value_or(false) == flag_of(pair.second).value_or(false)) continue;
      changed(where, {},
              base == 16 ? fmt::format("{}{:04X}", prefix, number) : fmt::format("{}{}", prefix, number),
              pair.first, pair.second);
    }
  }

  void whole(Difference::Kind kind, std::string where, const Entry& entry) {
    Difference out;
    out.kind = kind;
    out.where = std::move(where);
    out.name = entry.parameter_name.text;
    (kind == Difference::Kind::added ? out.at_after : out.at_before) = entry.at;
    out_.push_back(std::move(out));
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
    fields<Entry>(to_string(a.index), b.entry.parameter_name.text, a.entry, b.entry, entry_fields);
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
        fields<Entry>(where, pair.second->parameter_name.text, *pair.first, *pair.second, entry_fields);
    }
  }

  const EdsFile& before_;
  const EdsFile& after_;
  std::vector<Difference> out_;
};

}  // namespace

Result<std::vector<Difference>> compare(const EdsFile& before, const EdsFile& after) {
  return Comparer(before, after).run();
}

}  // namespace conform::eds
