// SPDX-License-Identifier: Apache-2.0
#include "explore/assign_objects.hpp"

#include <algorithm>
#include <span>

#include "canopen/abort_code.hpp"

namespace conform::explore {

using Kind = Answer::Kind;
namespace abort = canopen::abort;

std::string area_of(std::uint16_t index) {
  if (index > 0 && index < 0x260) return "OD-TYP";
  if (index >= 0x1200 && index < 0x1280) return index == 0x1200 ? "OD-1200" : "OD-1201";
  if (index >= 0x1280 && index < 0x1300) return "OD-1280";
  constexpr std::uint16_t pdos[] = {0x1400, 0x1600, 0x1800, 0x1A00};
  for (const auto first : pdos) {
    if (index < first || index >= first + 0x200) continue;
    return first == 0x1A00
               ? "OD-1A00"
               : "OD-" + std::to_string(first / 0x1000) + std::to_string(first / 0x100 % 16) + "00";
  }
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string out = "OD-";
  for (const unsigned shift : {12U, 8U, 4U, 0U}) out += digits[(index >> shift) & 15U];
  return out;
}

namespace {

struct ObjectRule {
  std::uint16_t index;
  std::uint8_t first_sub, last_sub;
  int rule;
};
std::string find_rule(std::span<const ObjectRule> rules, Multiplexer mux) {
  const auto area = area_of(mux.index.value());
  for (const auto& row : rules) {
    if (area_of(row.index) != area || mux.sub.value() < row.first_sub || mux.sub.value() > row.last_sub)
      continue;
    return row.rule == 0 ? std::string() : id_of(area, row.rule);
  }
  return "";
}

/// A sub-index 00h or an entry that is fixed by its own rule.
constexpr ObjectRule fixed[] = {
    {0x1000, 0, 0, 2}, {0x1001, 0, 0, 2}, {0x1002, 0, 0, 2}, {0x1003, 1, 254, 8}, {0x1008, 0, 0, 2},
    {0x1009, 0, 0, 2}, {0x100A, 0, 0, 2}, {0x1010, 0, 0, 2}, {0x1011, 0, 0, 2},   {0x1016, 0, 0, 2},
    {0x1018, 0, 0, 2}, {0x1018, 1, 4, 4}, {0x1020, 0, 0, 2}, {0x1021, 0, 0, 2},   {0x1022, 0, 0, 3},
    {0x1023, 2, 3, 3}, {0x1025, 2, 3, 3}, {0x1026, 2, 3, 3}, {0x1027, 0, 9, 2},   {0x1028, 0, 0, 2},
    {0x1029, 0, 0, 2}, {0x1200, 0, 2, 4}, {0x1201, 0, 0, 2}, {0x1400, 0, 0, 2},   {0x1800, 0, 0, 2},
};
/// The value a device has from power-on.
constexpr ObjectRule defaults[] = {
    {0x1000, 0, 0, 7},   {0x1003, 0, 0, 4},   {0x1005, 0, 0, 2}, {0x1006, 0, 0, 2},   {0x100C, 0, 0, 4},
    {0x1007, 0, 0, 1},   {0x1012, 0, 0, 2},   {0x1014, 0, 0, 2}, {0x1015, 0, 0, 2},   {0x1016, 0, 0, 1},
    {0x1016, 1, 127, 4}, {0x1017, 0, 0, 2},   {0x1018, 0, 0, 1}, {0x1018, 1, 4, 8},   {0x1019, 0, 0, 2},
    {0x1010, 0, 0, 1},   {0x1010, 1, 127, 4}, {0x1011, 0, 0, 1}, {0x1011, 1, 127, 4}, {0x1020, 0, 0, 1},
    {0x1022, 0, 0, 2},   {0x1023, 0, 0, 1},   {0x1025, 0, 0, 1}, {0x1026, 0, 0, 1},   {0x1027, 0, 9, 1},
    {0x1028, 0, 0, 1},   {0x1029, 0, 0, 1},   {0x1029, 1, 1, 4}, {0x1200, 0, 0, 1},   {0x1200, 1, 1, 2},
    {0x1200, 2, 2, 3},   {0x1201, 0, 0, 1},   {0x1201, 1, 2, 3}, {0x1280, 0, 0, 1},   {0x1280, 1, 2, 2},
    {0x1400, 0, 0, 1},   {0x1800, 0, 0, 1},   {0x1600, 0, 0, 1}, {0x1600, 1, 64, 2},  {0x1A00, 0, 0, 1},
    {0x1A00, 1, 64, 2},
};
/// A write that must be possible.
constexpr ObjectRule changes[] = {
    {0x1003, 0, 0, 5},   {0x1005, 0, 0, 6},  {0x1006, 0, 0, 3},  {0x100C, 0, 0, 2},   {0x100D, 0, 0, 2},
    {0x1010, 1, 1, 7},   {0x1011, 1, 1, 7},  {0x1012, 0, 0, 6},  {0x1014, 0, 0, 7},   {0x1015, 0, 0, 1},
    {0x1016, 1, 127, 3}, {0x1017, 0, 0, 3},  {0x1019, 0, 0, 3},  {0x1028, 1, 127, 7}, {0x1029, 1, 1, 5},
    {0x1400, 1, 1, 11},  {0x1400, 2, 2, 15}, {0x1400, 3, 3, 18}, {0x1400, 5, 5, 20},  {0x1600, 0, 64, 5},
    {0x1800, 1, 1, 11},  {0x1800, 2, 2, 15}, {0x1800, 3, 3, 18}, {0x1800, 5, 5, 20},  {0x1800, 6, 6, 21},
    {0x1A00, 0, 64, 5},  {0x1201, 3, 3, 7},  {0x1007, 0, 0, 1},  {0x1020, 1, 2, 3},
};
/// A write that must be refused though the entry can be written.
constexpr ObjectRule refusals[] = {
    {0x1003, 0, 0, 6},  {0x1010, 1, 127, 8}, {0x1011, 1, 127, 8}, {0x1016, 1, 127, 6}, {0x1019, 0, 0, 5},
    {0x1029, 1, 1, 6},  {0x1400, 2, 2, 16},  {0x1400, 3, 3, 18},  {0x1600, 0, 0, 10},  {0x1800, 2, 2, 16},
    {0x1800, 3, 3, 18}, {0x1800, 6, 6, 21},  {0x1A00, 0, 0, 10},  {0x1201, 3, 3, 7},   {0x1280, 3, 3, 6},
};

/// What was written and confirmed is read back.
constexpr ObjectRule keeping[] = {
    {0x1003, 0, 0, 5},   {0x1005, 0, 0, 6},  {0x1006, 0, 0, 3},  {0x1007, 0, 0, 1},  {0x100C, 0, 0, 2},
    {0x100D, 0, 0, 2},   {0x1012, 0, 0, 6},  {0x1013, 0, 0, 3},  {0x1014, 0, 0, 7},  {0x1015, 0, 0, 1},
    {0x1016, 1, 127, 5}, {0x1017, 0, 0, 3},  {0x1019, 0, 0, 3},  {0x1020, 1, 2, 3},  {0x1028, 1, 127, 7},
    {0x1029, 1, 1, 5},   {0x1400, 1, 1, 11}, {0x1400, 2, 2, 15}, {0x1400, 3, 3, 18}, {0x1400, 5, 5, 20},
    {0x1600, 0, 64, 5},  {0x1800, 1, 1, 11}, {0x1800, 2, 2, 15}, {0x1800, 3, 3, 18}, {0x1800, 5, 5, 20},
    {0x1800, 6, 6, 21},  {0x1A00, 0, 64, 5}, {0x1201, 3, 3, 7},
};
/// An entry that has to be there. 1600h and 1A00h are told by their PDO.
constexpr ObjectRule presences[] = {
    {0x1000, 0, 0, 1}, {0x1001, 0, 0, 1}, {0x1003, 1, 1, 2}, {0x1005, 0, 0, 1}, {0x100C, 0, 0, 1},
    {0x1010, 1, 1, 3}, {0x1011, 1, 1, 3}, {0x1014, 0, 0, 1}, {0x1017, 0, 0, 1}, {0x1018, 0, 0, 1},
    {0x1018, 1, 1, 3}, {0x1029, 1, 1, 3}, {0x1201, 0, 2, 1}, {0x1400, 0, 2, 1}, {0x1800, 0, 2, 1},
};
/// The data type.
constexpr ObjectRule types[] = {
    {0x0001, 0, 0, 1},  {0x1000, 0, 0, 1},   {0x1001, 0, 0, 1},  {0x1002, 0, 0, 1},  {0x1003, 0, 0, 1},
    {0x1005, 0, 0, 1},  {0x1006, 0, 0, 1},   {0x1007, 0, 0, 1},  {0x100C, 0, 0, 1},  {0x100D, 0, 0, 1},
    {0x1010, 0, 0, 1},  {0x1010, 1, 1, 3},   {0x1011, 0, 0, 1},  {0x1011, 1, 1, 3},  {0x1012, 0, 0, 1},
    {0x1013, 0, 0, 1},  {0x1014, 0, 0, 1},   {0x1015, 0, 0, 1},  {0x1016, 0, 0, 1},  {0x1016, 1, 127, 3},
    {0x1017, 0, 0, 1},  {0x1018, 0, 0, 1},   {0x1018, 1, 1, 3},  {0x1018, 2, 4, 5},  {0x1019, 0, 0, 1},
    {0x1020, 1, 2, 3},  {0x1022, 0, 0, 1},   {0x1023, 2, 2, 2},  {0x1024, 0, 0, 2},  {0x1025, 2, 2, 2},
    {0x1026, 1, 1, 2},  {0x1026, 2, 3, 3},   {0x1027, 0, 0, 1},  {0x1028, 0, 0, 1},  {0x1028, 1, 127, 3},
    {0x1029, 0, 0, 1},  {0x1029, 1, 254, 3}, {0x1400, 2, 2, 15}, {0x1400, 3, 3, 18}, {0x1400, 5, 5, 20},
    {0x1600, 0, 0, 1},  {0x1600, 1, 64, 2},  {0x1800, 2, 2, 15}, {0x1800, 3, 3, 18}, {0x1800, 5, 5, 20},
    {0x1800, 6, 6, 21}, {0x1A00, 0, 0, 1},   {0x1A00, 1, 64, 2},
};

}  // namespace

std::string rule_of(About about, Multiplexer mux) {
  switch (about) {
    case About::fixed: return find_rule(fixed, mux);
    case About::value: return find_rule(defaults, mux);
    case About::change: return find_rule(changes, mux);
    case About::refusal: return find_rule(refusals, mux);
    case About::keeping: return find_rule(keeping, mux);
    case About::presence: return find_rule(presences, mux);
    case About::type: return find_rule(types, mux);
  }
  return "";
}

bool is_about_length(AbortCode code) {
  return is_one_of(code, {abort::length_mismatch, abort::length_too_high, abort::length_too_low});
}

bool is_about_value(AbortCode code) {
  return is_one_of(code, {abort::invalid_value, abort::value_too_high, abort::value_too_low});
}

bool is_one_of(AbortCode code, std::initializer_list<AbortCode> codes) {
  return std::ranges::find(codes, code) != codes.end();
}

std::optional<Assigned> refusal(const Evidence& evidence, std::string rule,
                                std::initializer_list<AbortCode> tolerated) {
  const auto& device = evidence.difference().device;
  if (device.kind == Kind::aborted && is_one_of(device.code, tolerated)) return strains(std::move(rule));
  return violates(std::move(rule));
}

std::string by_transfer(const Action& action, std::string otherwise) {
  const bool up = action.kind == Action::Kind::upload;
  switch (action.transfer) {
    case Transfer::automatic: return otherwise;
    case Transfer::expedited_unsized: return "SDO-DNL-05";
    case Transfer::segmented: return "SDO-SDN-01";
    case Transfer::segmented_unsized: return "SDO-SDN-02";
    case Transfer::block: return up ? "SDO-BUP-01" : "SDO-BDN-01";
    case Transfer::block_unsized: return "SDO-BDN-16";
  }
  return otherwise;
}

bool is_array_or_record(const Vocabulary& words, Index index) {
  return std::ranges::any_of(words.entries, [&](const device::Entry& each) {
    return each.mux.index == index && each.mux.sub.value() > 0;
  });
}

std::string missing_sub_index(const Evidence& evidence, bool reading) {
  const auto mux = evidence.last().object;
  const auto area = area_of(mux.index.value());
  const auto sub = mux.sub.value();
  if ((area == "OD-1400" || area == "OD-1800") && sub == 4) return area + "-19";
  if (area == "OD-1400" && sub == 6) return area + "-21";
  if ((area == "OD-1600" || area == "OD-1A00") && sub > 0x40) return area + "-14";
  if ((area == "OD-1010" || area == "OD-1011") && sub >= 0x80 && sub < 0xFF) return area + "-06";
  if (!reading && sub == 0xFF) return "OD-OBJ-05";
  if (!is_array_or_record(evidence.words, mux.index)) return reading ? "OD-GEN-09" : "OD-GEN-08";
  return reading ? "OD-GEN-07" : "OD-GEN-08";
}

bool differs_in_reserved(ByteView came, ByteView due) {
  if (came.size() != 8 || due.size() != 8 || std::ranges::equal(came, due)) return false;
  // The multiplexer, of the answers that begin or end a transfer.
  if (!std::equal(came.begin() + 1, came.begin() + 4, due.begin() + 1)) return false;
  const auto command = due[0];
  if (command == 0x60) return came[0] == 0x60;
  if (command >> 5U != 2) return false;
  const bool expedited = (command & 2U) != 0;
  // A size without the bit that says there is one.
  if (!expedited) return came[0] == (command & ~1U);
  const auto size = (command & 1U) != 0 ? 4U - ((command >> 2U) & 3U) : 4U;
  return came[0] == command && std::equal(came.begin() + 4, came.begin() + 4 + size, due.begin() + 4);
}

std::string wrong_structure(Multiplexer mux, ByteView value) {
  if (value.size() != 4) return "OD-OBJ-01";
  const auto word = load_le(value);
  const auto code = word & 0xFFU, type = (word >> 8U) & 0xFFFFU;
  constexpr std::uint64_t domain = 2, type_definition = 5, record = 9;
  if (word >> 24U != 0 || (code != domain && (code < type_definition || code > record))) return "OD-OBJ-02";
  struct Row {
    std::uint16_t first, last;
    std::uint8_t code;
    std::uint16_t type;
  };
  constexpr Row rows[] = {{0x1003, 0x1003, 8, 7},    {0x1010, 0x1011, 8, 7},    {0x1016, 0x1016, 8, 7},
                          {0x1018, 0x1018, 9, 0x23}, {0x1028, 0x1028, 8, 7},    {0x1029, 0x1029, 8, 5},
                          {0x1200, 0x12FF, 9, 0x22}, {0x1400, 0x15FF, 9, 0x20}, {0x1600, 0x17FF, 9, 0x21},
                          {0x1800, 0x19FF, 9, 0x20}, {0x1A00, 0x1BFF, 9, 0x21}};
  for (const auto& row : rows) {
    if (mux.index.value() < row.first || mux.index.value() > row.last) continue;
    if (code != row.code) return "OD-OBJ-03";
    if (type != row.type) return "OD-OBJ-04";
  }
  return "";
}

std::string rule_of_presence(const Evidence& evidence) {
  const auto& last = evidence.last();
  const auto& device = evidence.difference().device;
  const auto* entry = evidence.words.find(last.object);
  if (device.kind != Kind::aborted || entry == nullptr) return "";
  if (device.code != abort::no_object && device.code != abort::no_sub_index) return "";
  const auto area = area_of(last.object.index.value());
  // The communication object, and the mapping is there.
  const Multiplexer mapping{Index(static_cast<std::uint16_t>(last.object.index.value() + 0x200)),
                            SubIndex(0)};
  const bool is_pdo = area == "OD-1400" || area == "OD-1800";
  if (device.code == abort::no_object && is_pdo && evidence.words.find(mapping) != nullptr)
    return area + "-03";
  if (device.code == abort::no_object && area == "OD-1600") return "OD-1400-03";
  if (device.code == abort::no_object && area == "OD-1A00") return "OD-1800-03";
  // That the history has no first entry is said of an empty one, too.
  if (area == "OD-1003" && last.object.sub.value() > 0 && device.code == abort::no_sub_index) return "";
  return rule_of(About::presence, last.object);
}

std::optional<Assigned> absent(const Evidence& evidence, bool reading) {
  const auto index = evidence.last().object.index.value();
  const auto told = [&](std::string rule) {
    return refusal(evidence, std::move(rule), {abort::general, abort::no_sub_index});
  };
  if (index == 0) return told("OD-GEN-01");
  if (index >= 0x260 && index < 0x1000) return told("OD-GEN-02");
  if (index >= 0xC000) return told("OD-GEN-03");
  const auto* rule = reading ? "OD-GEN-04" : "OD-GEN-05";
  // It may be an object that the description does not tell of.
  return evidence.difference().device.kind == Kind::confirmed ? strains(rule) : told(rule);
}

}  // namespace conform::explore
