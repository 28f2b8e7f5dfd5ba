// SPDX-License-Identifier: Apache-2.0
// Answers to uploads, downloads and single requests.
#include <algorithm>
#include <array>
#include <string>

#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "explore/assign.hpp"

namespace conform::explore {
namespace {

using Kind = Answer::Kind;
using canopen::CobIdKind;
namespace abort = canopen::abort;

/// The object of all of its kind whose rules are told: 1402h is 1400h, 1603h is 1600h.
std::string area_of(std::uint16_t index) {
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

struct ObjectRule {
  std::uint16_t index;
  std::uint8_t first_sub, last_sub;
  int rule;
};
template <std::size_t size>
std::string find_rule(const ObjectRule (&rules)[size], Multiplexer mux) {
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
    {0x1A00, 0, 64, 5},  {0x1201, 3, 3, 7},
};
/// A write that must be refused though the entry can be written.
constexpr ObjectRule refusals[] = {
    {0x1003, 0, 0, 6},  {0x1010, 1, 127, 8}, {0x1011, 1, 127, 8}, {0x1016, 1, 127, 6}, {0x1019, 0, 0, 5},
    {0x1029, 1, 1, 6},  {0x1400, 2, 2, 16},  {0x1400, 3, 3, 18},  {0x1600, 0, 0, 10},  {0x1800, 2, 2, 16},
    {0x1800, 3, 3, 18}, {0x1800, 6, 6, 21},  {0x1A00, 0, 0, 10},  {0x1201, 3, 3, 7},   {0x1280, 3, 3, 6},
};

bool is_one_of(AbortCode code, std::initializer_list<AbortCode> codes) {
  return std::ranges::find(codes, code) != codes.end();
}

/// Confirmed where it should be refused, or refused with a code; `tolerated` ones only strain the rule.
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
  if (!is_array_or_record(evidence.words, mux.index)) return reading ? "OD-GEN-09" : "OD-GEN-08";
  return reading ? "OD-GEN-07" : "OD-GEN-08";
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

/// A read-back that is not what was written or what was there: the write explains it.
std::optional<Assigned> after_a_write(const Evidence& evidence) {
  const auto& read = evidence.last();
  const auto before = evidence.before();
  for (auto i = before.size(); i-- > 0;) {
    const auto& write = before[i];
    if (write.kind != Action::Kind::download || write.object != read.object) continue;
    if (!write.fault.empty()) {
      auto rule = rule_of_fault(write);
      return rule.empty() ? std::nullopt : violates(std::move(rule));
    }
    if (evidence.played.due[i].kind == Kind::aborted) return violates("OD-ACC-05");
    const auto size = write.data.size();
    const auto* entry = evidence.words.find(write.object);
    if (entry == nullptr || entry->command || entry->may_change) return std::nullopt;
    if (write.transfer != Transfer::automatic) return violates(by_transfer(write, ""));
    if (size > 4) return violates("SDO-SDN-03");
    constexpr std::array<std::string_view, 5> expedited = {"SDO-SDN-15", "SDO-DNL-02", "SDO-DNL-01",
                                                           "SDO-DNL-04", "SDO-DNL-03"};
    return violates(std::string(expedited[size]));
  }
  return std::nullopt;
}

std::optional<Assigned> after_a_reset(const Evidence& evidence) {
  const auto index = evidence.last().object.index.value();
  const bool communication = index < 0x2000;
  bool reset = false, node = false, stored = false, loaded = false;
  std::uint8_t stored_sub = 0;
  for (const auto& each : evidence.before()) {
    const auto command = each.nmt_command(evidence.words.node);
    reset = reset || command > 0x80 || each.kind == Action::Kind::power;
    node = node || command == 0x81 || each.kind == Action::Kind::power;
    if (each.kind != Action::Kind::download) continue;
    if (each.object.index.value() == 0x1010) {
      stored = true;
      stored_sub = each.object.sub.value();
    }
    loaded = loaded || each.object.index.value() == 0x1011;
  }
  if (!reset) return std::nullopt;
  if (loaded) return violates(communication ? "OD-1011-12" : "OD-1011-13");
  if (stored) return violates(stored_sub == 2 ? "OD-1010-11" : stored_sub == 3 ? "OD-1010-12" : "OD-1010-10");
  if (communication) return violates("NMT-FSA-24");
  return node ? violates("NMT-FSA-25") : strains("NMT-FSA-26");
}

std::optional<Assigned> other_value(const Evidence& evidence) {
  const auto& read = evidence.last();
  const auto mux = read.object;
  const auto* entry = evidence.words.find(mux);
  const auto& device = evidence.difference().device;
  if (entry == nullptr) return std::nullopt;
  if (entry->size() && device.data.size() != *entry->size())
    return violates(mux.sub.value() == 0 && is_array_or_record(evidence.words, mux.index) ? "OD-GEN-10"
                                                                                          : "OD-LEN-04");
  if (read.transfer == Transfer::block && device.data.size() > 4) return violates("SDO-BUP-01");
  if (mux.index == Index(0x1001)) {
    const bool raised = !evidence.difference().model.data.empty() && evidence.difference().model.data[0] != 0;
    return violates(raised ? "OD-1001-05" : "OD-1001-06");
  }
  // How many errors the history holds is the device's choice.
  if (mux.index == Index(0x1003))
    return mux.sub.value() == 0   ? strains("OD-1003-10")
           : mux.sub.value() == 1 ? violates("OD-1003-11")
                                  : strains("OD-1003-12");
  if (auto reset = after_a_reset(evidence)) return reset;
  if (auto written = after_a_write(evidence)) return written;
  if (entry->access == device::Access::constant || !entry->writable()) {
    if (entry->may_change) return std::nullopt;
    if (evidence.conversation.size() > 1 &&
        !evidence.some([](const Action& each) { return each.kind == Action::Kind::download; }))
      return violates("OD-ACC-06");
  }
  // What was there from power-on is another value than described.
  const bool untouched = evidence.before().empty();
  // The model agrees with the description; where it does not, it is no measure.
  const bool is_measure = entry->default_value && *entry->default_value == evidence.difference().model.data;
  if (!untouched || !is_measure) return std::nullopt;
  if (entry->size().value_or(8) > 4) return violates("SDO-SUP-01");
  if (auto rule = find_rule(defaults, mux); !rule.empty()) return violates(std::move(rule));
  const auto area = area_of(mux.index.value());
  if ((area == "OD-1400" || area == "OD-1800") && mux.sub.value() == 1) {
    const auto number = mux.index.value() & 0x1FFU;
    return violates(id_of(area, number < 4 ? 4 + static_cast<int>(number) : 8));
  }
  return strains("OD-RST-05");
}

std::optional<Assigned> assign_upload(const Evidence& evidence) {
  const auto& device = evidence.difference().device;
  const auto& model = evidence.difference().model;
  const auto mux = evidence.last().object;
  if (evidence.last().transfer == Transfer::block &&
      (evidence.last().blksize == 0 || evidence.last().blksize > 127))
    return device.kind == Kind::aborted
               ? strains("SDO-BUP-09")
               : violates(evidence.last().blksize == 0 ? "SDO-BUP-09" : "SDO-BUP-10");
  if (model.kind == Kind::aborted) {
    if (model.code == abort::no_object) return absent(evidence, true);
    if (model.code == abort::no_sub_index)
      return refusal(evidence, missing_sub_index(evidence, true), {abort::general, abort::no_data});
    if (model.code == abort::write_only)
      return refusal(evidence, "OD-ACC-03", {abort::unsupported_access, abort::general});
    if (mux.index == Index(0x1003))
      return device.kind == Kind::confirmed ? violates("OD-1003-09") : strains("OD-1003-03");
    return std::nullopt;
  }
  if (model.kind != Kind::confirmed) return std::nullopt;
  if (device.kind == Kind::confirmed) return other_value(evidence);
  if (device.kind != Kind::aborted) return std::nullopt;
  if (evidence.last().transfer == Transfer::block) return strains("SDO-BUP-01");
  if (mux.index == Index(0x1003)) return violates("OD-1003-10");
  const auto* entry = evidence.words.find(mux);
  if (entry == nullptr || entry->command || entry->type == canopen::DataType::domain) return std::nullopt;
  const auto area = area_of(mux.index.value());
  if (entry->mux.sub.value() == 2 && (area == "OD-1400" || area == "OD-1800")) return violates(area + "-01");
  return violates("OD-GEN-17");
}

/// Why the model refused a COB-ID: what of the value is wrong.
std::optional<Assigned> wrong_cob_id(const Evidence& evidence, CobIdKind kind) {
  const auto& last = evidence.last();
  const auto value = static_cast<std::uint32_t>(load_le(last.data));
  const auto& device = evidence.difference().device;
  const auto area = area_of(last.object.index.value());
  struct Row {
    CobIdKind kind;
    int lock, frame, restricted;
  };
  constexpr Row rows[] = {{CobIdKind::sync, 5, 4, 1},  {CobIdKind::time, 5, 4, 2},
                          {CobIdKind::emcy, 6, 5, 3},  {CobIdKind::emcy_consumer, 6, 5, 0},
                          {CobIdKind::sdo, 5, 6, 6},   {CobIdKind::rpdo, 10, 13, 4},
                          {CobIdKind::tpdo, 10, 13, 5}};
  const auto& row = *std::ranges::find(rows, kind, &Row::kind);
  // Refused in other words, or taken and not kept.
  const bool kept = evidence.played.holds && evidence.played.holds->kind == Kind::confirmed &&
                    evidence.played.holds->data == last.data;
  const auto told = [&](std::string rule) {
    return device.kind == Kind::confirmed && kept ? violates(std::move(rule)) : strains(std::move(rule));
  };
  const bool client = last.object.index.value() >= 0x1280 && last.object.index.value() < 0x1300;
  if ((value & canopen::cob_id::extended_frame) != 0) return told(id_of(area, client ? 5 : row.frame));
  if ((value & canopen::cob_id::can_id_mask & ~canopen::cob_id::base_id_mask) != 0) return told("OD-CID-01");
  if (kind == CobIdKind::emcy && (value & canopen::cob_id::bit30) != 0) return strains("OD-1014-04");
  const bool becomes_active = canopen::is_active(kind, CobId(value));
  if (canopen::is_restricted(canopen::can_id_of(CobId(value)))) {
    if (row.restricted == 0) return strains("OD-CID-03");
    const auto rule = id_of("CAN-RID", row.restricted);
    return becomes_active ? told(rule) : strains(rule);
  }
  return told(id_of(area, client ? 3 : row.lock));
}

/// Why the model refused an entry of a mapping.
std::optional<Assigned> wrong_mapping(const Evidence& evidence) {
  const auto& last = evidence.last();
  const auto& model = evidence.difference().model;
  const auto area = area_of(last.object.index.value());
  const bool confirmed = evidence.difference().device.kind == Kind::confirmed;
  const auto told = [&](int rule) {
    return confirmed ? violates(id_of(area, rule)) : strains(id_of(area, rule));
  };
  if (model.code == abort::unsupported_access) {
    return strains(id_of(area, last.object.sub.value() == 0 ? 12 : 11));
  }
  if (last.object.sub.value() == 0) return model.code == abort::pdo_length ? told(9) : told(10);
  // The entry is checked here or when the mapping is enabled.
  if (confirmed)
    return strains(id_of(area, model.code == abort::no_object || model.code == abort::no_sub_index ? 6 : 7));
  return strains(id_of(area, model.code == abort::no_object ? 6 : 7));
}

std::optional<Assigned> wrong_length(const Evidence& evidence) {
  const auto& last = evidence.last();
  const auto& device = evidence.difference().device;
  const auto index = last.object.index.value();
  const auto* entry = evidence.words.find(last.object);
  const auto right = entry != nullptr ? entry->size().value_or(0) : 0;
  const bool is_short = last.data.size() < right;
  const auto told = [&](std::string rule) {
    return device.kind == Kind::aborted ? strains(std::move(rule)) : violates(std::move(rule));
  };
  switch (last.transfer) {
    case Transfer::segmented: return told(is_short ? "SDO-SDN-07" : "SDO-SDN-06");
    case Transfer::block: return told(is_short ? "SDO-BDN-13" : "SDO-BDN-12");
    case Transfer::expedited_unsized: return told("SDO-DNL-06");
    case Transfer::segmented_unsized:
    case Transfer::block_unsized: break;
    case Transfer::automatic:
      if (index == 0x1003) return told("OD-1003-14");
      if (index == 0x1010) return told("OD-1010-20");
      if (index == 0x1011) return told("OD-1011-17");
      if (index == 0x1017) return told("OD-1017-09");
      if (right > 4 && last.data.size() <= 4) return told("SDO-DNL-19");
      break;
  }
  return told(is_short ? "OD-LEN-01" : "OD-LEN-02");
}

/// A value that the model refused.
std::optional<Assigned> wrong_value(const Evidence& evidence) {
  const auto& last = evidence.last();
  const auto& device = evidence.difference().device;
  const auto* entry = evidence.words.find(last.object);
  if (const auto kind = canopen::cob_id_kind(last.object)) return wrong_cob_id(evidence, *kind);
  const auto area = area_of(last.object.index.value());
  if (area == "OD-1600" || area == "OD-1A00") return wrong_mapping(evidence);
  if (auto rule = find_rule(refusals, last.object); !rule.empty()) {
    // 1 and 241 to 255 are reserved, whatever the period is.
    const auto value = load_le(last.data);
    if (last.is_at(0x1019, 0) && (value == 1 || value > 240)) rule = "OD-1019-04";
    if (device.kind == Kind::confirmed) {
      // Confirmed and thrown away is another matter.
      const bool kept = evidence.played.holds && evidence.played.holds->data == last.data;
      const bool commands = entry != nullptr && entry->command;
      return kept || commands ? violates(std::move(rule)) : strains(std::move(rule));
    }
    if (area == "OD-1003")
      return refusal(evidence, std::move(rule),
                     {abort::value_too_high, abort::general, abort::invalid_value});
    return strains(std::move(rule));
  }
  if (entry == nullptr || (!entry->low && !entry->high)) return std::nullopt;
  const bool high = evidence.difference().model.code == abort::value_too_high;
  return device.kind == Kind::aborted ? strains(high ? "OD-RNG-01" : "OD-RNG-02")
                                      : violates(high ? "OD-RNG-01" : "OD-RNG-02");
}

std::optional<Assigned> refused_download(const Evidence& evidence) {
  const auto& last = evidence.last();
  const auto code = evidence.difference().model.code;
  const auto* entry = evidence.words.find(last.object);
  if (code == abort::no_object) return absent(evidence, false);
  if (code == abort::no_sub_index)
    return refusal(evidence, missing_sub_index(evidence, false),
                   {abort::read_only, abort::no_object, abort::general});
  if (code == abort::read_only) {
    if (entry == nullptr || entry->writable() || entry->access_open) return std::nullopt;
    auto rule = find_rule(fixed, last.object);
    if (rule.empty()) rule = entry->access == device::Access::constant ? "OD-ACC-02" : "OD-ACC-01";
    return refusal(evidence, std::move(rule), {abort::unsupported_access, abort::general});
  }
  if (is_one_of(code, {abort::length_mismatch, abort::length_too_high, abort::length_too_low}))
    return wrong_length(evidence);
  return wrong_value(evidence);
}

std::optional<Assigned> assign_download(const Evidence& evidence) {
  const auto& last = evidence.last();
  const auto& device = evidence.difference().device;
  const auto& model = evidence.difference().model;
  if (model.kind == Kind::aborted) return refused_download(evidence);
  if (model.kind != Kind::confirmed || device.kind != Kind::aborted) return std::nullopt;
  if (last.transfer != Transfer::automatic) return strains(by_transfer(last, ""));
  const auto* entry = evidence.words.find(last.object);
  if (entry == nullptr) return std::nullopt;
  const bool limit = (entry->low && *entry->low == last.data) || (entry->high && *entry->high == last.data);
  if (limit) return violates("OD-RNG-03");
  const auto rule = find_rule(changes, last.object);
  // A device may have reasons of its own to refuse a value: a COB-ID, a type, or a period that it does not
  // support.
  if (!rule.empty()) return strains(rule);
  const bool untouched = evidence.before().empty();
  if (last.data.size() > 4) return violates("SDO-SDN-01");
  return last.object.index.value() >= 0x2000 && untouched && entry->size() ? violates("OD-ACC-04")
                                                                           : strains("OD-ACC-04");
}

/// Silence or a broken protocol where the model answers.
std::optional<Assigned> no_answer(const Evidence& evidence) {
  const auto& last = evidence.last();
  const bool up = last.kind == Action::Kind::upload;
  // What went wrong before has left its mark.
  for (const auto& earlier : evidence.before()) {
    if (auto rule = rule_of_fault(earlier); !rule.empty()) return violates(std::move(rule));
  }
  const bool reset =
      evidence.some([&](const Action& each) { return each.nmt_command(evidence.words.node) > 0x80; });
  if (reset) return violates("SDO-GEN-17");
  const auto code = evidence.difference().model.code;
  if (!up &&
      (code == abort::length_mismatch || code == abort::length_too_high || code == abort::length_too_low))
    return wrong_length(evidence);
  const auto* entry = evidence.words.find(last.object);
  const bool is_long = entry != nullptr && entry->size().value_or(8) > 4;
  if (last.transfer != Transfer::automatic) return violates(by_transfer(last, ""));
  if (up && is_long) return violates("SDO-SUP-01");
  if (!up && last.data.size() > 4) return violates("SDO-SDN-01");
  if (evidence.operational()) return violates("SDO-GEN-14");
  return violates("SDO-GEN-01");
}

}  // namespace

std::optional<Assigned> assign_answer(const Evidence& evidence) {
  const auto device = evidence.difference().device.kind;
  const auto model = evidence.difference().model.kind;
  if (model != Kind::silence && (device == Kind::silence || device == Kind::violation))
    return no_answer(evidence);
  return evidence.last().kind == Action::Kind::upload ? assign_upload(evidence) : assign_download(evidence);
}

std::optional<Assigned> assign_request(const Evidence& evidence) {
  const auto& frame = evidence.last().frame;
  const auto device = evidence.difference().device.kind;
  const auto model = evidence.difference().model.kind;
  const auto own = canopen::connection_set(evidence.words.node);
  if (model == Kind::silence) {
    if (evidence.stopped()) return in_its_state(evidence, "SDO-GEN-15");
    if (frame.remote) return violates("SDO-GEN-10");
    if (frame.extended) return violates("SDO-GEN-11");
    if (frame.id == own.sdo_response.value()) return strains("SDO-GEN-12");
    if (frame.id == 0x600) return violates("SDO-GEN-09");
    if (frame.id != own.sdo_request.value()) return violates("SDO-GEN-08");
    if (frame.dlc < 8) return strains("SDO-ERR-06");
    if (frame.data[0] >> 5U == 4) return violates("SDO-ERR-03");
    return std::nullopt;
  }
  if (frame.dlc < 8) return strains("SDO-ERR-06");
  const auto command = frame.data[0];
  std::string rule;
  switch (command >> 5U) {
    case 0: rule = "SDO-SDN-16"; break;
    case 3: rule = "SDO-SUP-08"; break;
    case 5: rule = "SDO-BUP-21"; break;
    case 6: rule = "SDO-BDN-22"; break;
    case 7: rule = command == 0xE0 ? "SDO-ERR-01" : "SDO-ERR-02"; break;
    case 2: return strains(command == 0x40 ? "SDO-UPL-12" : "SDO-UPL-13");
    case 1: return (command & 0x10U) != 0 ? strains("SDO-DNL-18") : std::nullopt;
    default: return std::nullopt;
  }
  // Nothing may be served without a transfer that is running; how it is refused is told less strictly.
  const bool served = device == Kind::replied && model == Kind::aborted;
  const bool unheard = device == Kind::silence && command >> 5U == 7;
  return served || unheard ? violates(std::move(rule)) : strains(std::move(rule));
}

}  // namespace conform::explore
