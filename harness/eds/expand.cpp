// SPDX-License-Identifier: Apache-2.0
#include "eds/expand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "base/text.hpp"

namespace conform::eds {
namespace {

constexpr unsigned most_subs = 254;
constexpr unsigned pdos_of_a_direction = 512;

Field implied(std::string text, Position at) { return {std::move(text), at, at, true}; }

/// number -> the first entry with it
std::map<std::uint64_t, const Field*> by_number(const NumberedList& list) {
  std::map<std::uint64_t, const Field*> out;
  for (const auto& entry : list.entries) out.try_emplace(entry.number, &entry.field);
  return out;
}

const Field& field_or(const std::map<std::uint64_t, const Field*>& fields, std::uint64_t number,
                      const Field& other) {
  const auto found = fields.find(number);
  return found == fields.end() ? other : *found->second;
}

Entry sub_zero(std::string value, Position by) {
  Entry out;
  out.at = out.implied_by = by;
  out.parameter_name = implied("NrOfObjects", by);
  out.object_type = implied("0x7", by);
  out.data_type = implied("0x0005", by);
  out.access_type = implied("ro", by);
  out.default_value = implied(std::move(value), by);
  out.pdo_mapping = implied("0", by);
  return out;
}

/// Sub-index 00h of CompactSubObj is ro and counts the others (CiA 306). That of 1003h counts errors, of
/// which there are none at power-on, and writing to it clears the history (CiA 301, 7.5.2.4).
Entry compact_sub_zero(Index index, std::uint64_t count, Position by) {
  constexpr Index error_history(0x1003);
  if (index != error_history) return sub_zero(std::to_string(count), by);
  auto out = sub_zero("0", by);
  out.access_type = implied("rw", by);
  return out;
}

struct CommunicationEntry {
  const char* name;
  const char* data_type;
};
/// Sub-indices 01h to 06h of a PDO communication parameter (CiA 301, 7.5.2.35).
constexpr CommunicationEntry communication_entries[] = {
    {"COB-ID", "0x0007"},   {"Transmission type", "0x0005"}, {"Inhibit time", "0x0006"},
    {"Reserved", "0x0005"}, {"Event timer", "0x0006"},       {"SYNC start value", "0x0005"},
};

class Expander {
 public:
  explicit Expander(const EdsFile& file) : file_(file) {}

  Result<std::vector<Object>> run() {
    std::vector<Object> out = file_.objects;
    for (auto& object : out) {
      if (!expand_subs(object)) return too_many(object.compact_sub_obj.at);
    }
    const auto mask = number_of(file_.device_info.compact_pdo).value_or(0);
    if (mask != 0) {
      expand_pdos(out, file_.device_info.nr_of_rx_pdo, 0x1400, mask);
      expand_pdos(out, file_.device_info.nr_of_tx_pdo, 0x1800, mask);
      std::ranges::sort(out, {}, &Object::index);
    }
    return out;
  }

 private:
  [[nodiscard]] std::unexpected<Error> too_many(Position at) const {
    return fail(fmt::format("more than {} entries or {} bytes are implied by CompactSubObj", most_implied,
                            most_implied_bytes),
                file_.name + ":" + to_string(at));
  }

  /// False when that would be too much.
  bool expand_subs(Object& object) {
    const auto count = std::min<std::uint64_t>(number_of(object.compact_sub_obj).value_or(0), most_subs);
    if (count == 0) return true;
    // Each implied entry repeats the texts of the main section.
    for (const auto& row : entry_fields) bytes_ += (object.entry.*row.field).text.size() * count;
    if (bytes_ > most_implied_bytes || count_ + count > most_implied) return false;
    const auto by = object.compact_sub_obj.at;
    const auto names = by_number(object.lists->names);
    const auto values = by_number(object.lists->values);
    const auto denotations = by_number(object.lists->denotations);
    std::vector<SubObject> subs;
    for (unsigned sub = 0; sub <= count; ++sub) {
      const auto index = SubIndex(static_cast<std::uint8_t>(sub));
      if (object.find(index) != nullptr) continue;
      ++count_;
      if (sub == 0) {
        subs.push_back({index, compact_sub_zero(object.index, count, by)});
        continue;
      }
      Entry entry = object.entry;
      entry.at = entry.implied_by = by;
      entry.object_type = implied("0x7", by);
      const auto& main_name = object.entry.parameter_name;
      entry.parameter_name =
          field_or(names, sub,
                   {main_name.text + std::to_string(sub), main_name.at, main_name.key_at, main_name.present});
      entry.parameter_value = field_or(values, sub, {});
      entry.denotation = field_or(denotations, sub, {});
      entry.param_refd = entry.upload_file = entry.download_file = {};
      subs.push_back({index, std::move(entry)});
    }
    std::ranges::move(subs, std::back_inserter(object.subs));
    std::ranges::sort(object.subs, {}, &SubObject::sub);
    return true;
  }

  void expand_pdos(std::vector<Object>& out, const Field& total, std::uint16_t first, std::uint64_t mask) {
    const auto range_end = static_cast<std::uint16_t>(first + pdos_of_a_direction);
    const auto described = std::ranges::count_if(file_.objects, [&](const Object& object) {
      return object.index.value() >= first && object.index.value() < range_end;
    });
    const auto wanted = std::min<std::uint64_t>(number_of(total).value_or(0), pdos_of_a_direction);
    auto missing = wanted - std::min(wanted, static_cast<std::uint64_t>(described));
    for (auto index = first; index < range_end && missing > 0; ++index) {
      if (file_.find(Index(index)) != nullptr) continue;
      --missing;
      out.push_back(communication_parameter(Index(index), mask));
      const auto mapping = Index(static_cast<std::uint16_t>(index + 0x200));
      if (file_.find(mapping) == nullptr) out.push_back(mapping_parameter(mapping));
    }
  }

  [[nodiscard]] Object record(Index index, std::string name) const {
    const auto by = file_.device_info.compact_pdo.at;
    Object out;
    out.index = index;
    out.entry.at = out.entry.implied_by = by;
    out.entry.parameter_name = implied(std::move(name), by);
    out.entry.object_type = implied("0x9", by);
    return out;
  }

  [[nodiscard]] Object communication_parameter(Index index, std::uint64_t mask) const {
    const auto by = file_.device_info.compact_pdo.at;
    auto out = record(index, "PDO communication parameter");
    unsigned highest = 0;
    for (unsigned sub = 1; sub <= std::size(communication_entries); ++sub) {
      if (((mask >> (sub - 1)) & 1U) == 0) continue;
      highest = sub;
      const auto& row = communication_entries[sub - 1];
      Entry entry;
      entry.at = entry.implied_by = by;
      entry.parameter_name = implied(row.name, by);
      entry.data_type = implied(row.data_type, by);
      entry.access_type = implied("rw", by);
      entry.pdo_mapping = implied("0", by);
      out.subs.push_back({SubIndex(static_cast<std::uint8_t>(sub)), std::move(entry)});
    }
    out.subs.insert(out.subs.begin(), {SubIndex(0), sub_zero(std::to_string(highest), by)});
    return out;
  }

  [[nodiscard]] Object mapping_parameter(Index index) const {
    const auto by = file_.device_info.compact_pdo.at;
    auto out = record(index, "PDO mapping parameter");
    auto zero = sub_zero("", by);
    zero.access_type = implied("rw", by);
    out.subs.push_back({SubIndex(0), std::move(zero)});
    return out;
  }

  const EdsFile& file_;
  std::size_t count_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace

bool implies_entries(const EdsFile& file) {
  return number_of(file.device_info.compact_pdo).value_or(0) != 0 ||
         std::ranges::any_of(file.objects,
                             [](const Object& object) { return !object.compact_sub_obj.empty(); });
}

Result<std::vector<Object>> expand(const EdsFile& file) { return Expander(file).run(); }

}  // namespace conform::eds
