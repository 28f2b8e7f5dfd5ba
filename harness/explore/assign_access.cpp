// SPDX-License-Identifier: Apache-2.0
// Answers to downloads and single requests.
#include <algorithm>
#include <array>
#include <string>

#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "explore/assign_objects.hpp"

namespace conform::explore {
namespace {

using Kind = Answer::Kind;
using canopen::CobIdKind;
namespace abort = canopen::abort;

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
  if (last.object.sub.value() == 0) {
    const auto entries = std::ranges::count_if(evidence.words.entries, [&](const device::Entry& each) {
      return each.mux.index == last.object.index && each.mux.sub.value() > 0;
    });
    const bool counts = load_le(last.data) <= static_cast<std::uint64_t>(entries);
    return told(counts && model.code == abort::pdo_length ? 9 : 10);
  }
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
  if (auto rule = rule_of(About::refusal, last.object); !rule.empty()) {
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

/// By a transfer that is not the plainest one, which checks less.
std::string refusal_by_transfer(const Action& last, AbortCode due) {
  const bool range = is_about_value(due);
  const bool access = is_one_of(due, {abort::read_only, abort::no_object, abort::no_sub_index});
  switch (last.transfer) {
    case Transfer::segmented:
    case Transfer::segmented_unsized:
      return range ? "SDO-SDN-23" : due == abort::read_only ? "OD-ACC-08" : access ? "SDO-SDN-22" : "";
    case Transfer::block:
    case Transfer::block_unsized: return range ? "SDO-BDN-24" : access ? "SDO-BDN-23" : "";
    default: return "";
  }
}

std::optional<Assigned> refused_download(const Evidence& evidence) {
  const auto& last = evidence.last();
  const auto code = evidence.difference().model.code;
  if (auto rule = rule_of_presence(evidence); !rule.empty()) return violates(std::move(rule));
  const auto* entry = evidence.words.find(last.object);
  // What takes a transfer of any kind would have been found by the plainest one.
  const bool long_data = last.data.size() > 4;
  if (evidence.difference().device.kind == Kind::confirmed && !long_data) {
    const bool kept = evidence.played.holds && evidence.played.holds->data == last.data;
    if (auto rule = refusal_by_transfer(last, code); !rule.empty())
      return kept ? violates(std::move(rule)) : strains(std::move(rule));
  }
  if (code == abort::no_object) return absent(evidence, false);
  if (code == abort::no_sub_index)
    return refusal(evidence, missing_sub_index(evidence, false),
                   {abort::read_only, abort::no_object, abort::general});
  if (code == abort::read_only) {
    if (entry == nullptr || entry->writable() || entry->access_open) return std::nullopt;
    auto rule = rule_of(About::fixed, last.object);
    if (rule.empty()) rule = entry->access == device::Access::constant ? "OD-ACC-02" : "OD-ACC-01";
    return refusal(evidence, std::move(rule), {abort::unsupported_access, abort::general});
  }
  if (is_about_length(code)) return wrong_length(evidence);
  return wrong_value(evidence);
}

/// A length that is the right one is refused.
std::optional<Assigned> wrong_type(const Evidence& evidence) {
  const auto& last = evidence.last();
  const auto* entry = evidence.words.find(last.object);
  const bool is_right = entry != nullptr && entry->size() && *entry->size() == last.data.size();
  if (!is_right || last.transfer != Transfer::automatic ||
      !is_about_length(evidence.difference().device.code))
    return std::nullopt;
  // Three bytes are what few entries have, and a full last segment is one without unused bytes.
  if (last.data.size() == 3) return strains("SDO-DNL-04");
  if (last.data.size() > 4) return strains(last.data.size() % 7 == 0 ? "SDO-SDN-11" : "SDO-SDN-01");
  auto rule = rule_of(About::type, last.object);
  return violates(rule.empty() ? "OD-GEN-17" : std::move(rule));
}

/// An entry of 1016h for the node that it is for already.
bool is_written_again(const Evidence& evidence) {
  const auto& last = evidence.last();
  if (last.object.index != Index(0x1016) || last.data.size() != 4 || load_le(last.data) == 0) return false;
  return std::ranges::any_of(evidence.before(), [&](const Action& each) {
    return each.kind == Action::Kind::download && each.object == last.object && each.data.size() == 4 &&
           each.data[2] == last.data[2] && load_le(each.data) != 0;
  });
}

/// What the entry holds, by what was confirmed last, or its default; 0 where nobody knows.
std::uint32_t held_before(const Evidence& evidence, Multiplexer object) {
  for (auto i = std::min(evidence.difference().action, evidence.played.answers.size()); i-- > 0;) {
    const auto& each = evidence.conversation[i];
    if (each.is_transfer() && each.object == object && evidence.played.answers[i].kind == Kind::confirmed)
      return static_cast<std::uint32_t>(
          load_le(each.kind == Action::Kind::upload ? evidence.played.answers[i].data : each.data));
  }
  const auto* entry = evidence.words.find(object);
  return entry != nullptr && entry->default_value ? static_cast<std::uint32_t>(load_le(*entry->default_value))
                                                  : 0;
}

/// A COB-ID that may be refused, and for what: bit 30 where the device cannot do what it says, bit 31 where
/// it has no meaning, a CAN-ID. nullopt: for no reason of these.
std::optional<Assigned> refused_cob_id(const Evidence& evidence) {
  const auto& last = evidence.last();
  const auto kind = canopen::cob_id_kind(last.object);
  if (!kind || last.data.size() != 4) return std::nullopt;
  const auto value = static_cast<std::uint32_t>(load_le(last.data));
  const auto changed = value ^ held_before(evidence, last.object);
  if ((changed & canopen::cob_id::bit30) != 0) {
    const bool plainly = is_one_of(evidence.difference().device.code, {abort::invalid_value, abort::general});
    const auto of_the_bit = [&](std::string rule) {
      return plainly ? passes(std::move(rule)) : strains(std::move(rule));
    };
    const bool sets = (value & canopen::cob_id::bit30) != 0;
    // Without a producer of it, or without remote frames.
    if (*kind == CobIdKind::sync && sets) return of_the_bit("OD-1005-03");
    if (*kind == CobIdKind::time && sets) return of_the_bit("OD-1012-03");
    if (*kind == CobIdKind::tpdo) return sets ? strains("OD-1800-14") : of_the_bit("OD-1800-14");
    if (*kind == CobIdKind::rpdo) return strains("OD-1400-14");
  }
  if (*kind == CobIdKind::sync && (changed & canopen::cob_id::bit31) != 0) return strains("OD-1005-11");
  const auto id = value & canopen::cob_id::base_id_mask;
  const bool beside =
      canopen::is_restricted(CanId(id + 1)) || (id > 0 && canopen::is_restricted(CanId(id - 1)));
  const bool is_new = (changed & canopen::cob_id::base_id_mask) != 0;
  return is_new && beside && !canopen::is_restricted(CanId(id)) ? strains("CAN-RID-07") : std::nullopt;
}

std::optional<Assigned> assign_download(const Evidence& evidence) {
  const auto& last = evidence.last();
  const auto& device = evidence.difference().device;
  const auto& model = evidence.difference().model;
  // The client has sent the CRC of what it has sent.
  if (device.kind == Kind::aborted && device.code == abort::crc) return violates("SDO-BDN-02");
  const bool has_other_reason =
      model.kind == Kind::aborted && (is_about_length(model.code) || is_about_value(model.code));
  if (device.kind == Kind::aborted && !has_other_reason) {
    if (auto type = wrong_type(evidence)) return type;
  }
  if (model.kind == Kind::aborted) return refused_download(evidence);
  if (model.kind != Kind::confirmed || device.kind != Kind::aborted) return std::nullopt;
  if (auto rule = rule_of_presence(evidence); !rule.empty()) return violates(std::move(rule));
  if (last.transfer != Transfer::automatic) return strains(by_transfer(last, ""));
  const auto* entry = evidence.words.find(last.object);
  if (entry == nullptr) return std::nullopt;
  const bool limit = (entry->low && *entry->low == last.data) || (entry->high && *entry->high == last.data);
  if (limit) return violates("OD-RNG-03");
  const auto rule = rule_of(About::change, last.object);
  if (is_written_again(evidence)) return violates("OD-1016-08");
  if (last.object.index == Index(0x1016) && last.object.sub != SubIndex(0) && last.data.size() == 4)
    return strains((load_le(last.data) & 0xFFFFU) == 0 ? "OD-1016-07" : "OD-1016-05");
  if (auto cob_id = refused_cob_id(evidence)) return cob_id;
  // It is described as one that can be written.
  if (device.code == abort::read_only && entry->writable() && !entry->access_open)
    return violates(rule.empty() ? "OD-ACC-04" : rule);
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
  // An abort, but about another object. When the time is over it may be the transfer before.
  const auto& device = evidence.difference().device;
  const bool aborts = device.kind == Kind::violation && device.code != AbortCode{};
  if (aborts && device.code != abort::timed_out) return violates("SDO-ERR-04");
  // What went wrong before has left its mark.
  for (const auto& earlier : evidence.before()) {
    if (auto rule = rule_of_fault(earlier); !rule.empty()) return violates(std::move(rule));
  }
  for (const auto& earlier : evidence.before()) {
    // Whatever a single request was, the server has to go on.
    if (earlier.kind == Action::Kind::request) return violates("SDO-ERR-09");
    const bool block = earlier.transfer == Transfer::block && earlier.kind == Action::Kind::upload;
    if (block) return violates("SDO-BUP-24");
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
  const bool segmented = last.transfer == Transfer::segmented ||
                         last.transfer == Transfer::segmented_unsized ||
                         (last.transfer == Transfer::automatic && last.data.empty());
  if (!up && segmented && (code == abort::no_object || code == abort::no_sub_index))
    return violates("SDO-SDN-22");
  if (!up && segmented && last.data.empty())
    return violates(entry != nullptr && entry->size() ? "SDO-SDN-14" : "SDO-SDN-15");
  if (!up && last.data.size() <= 4) {
    if (auto rule = refusal_by_transfer(last, code); !rule.empty()) return violates(std::move(rule));
  }
  const bool commands = !up && last.transfer == Transfer::automatic && entry != nullptr && entry->command;
  if (commands && evidence.difference().model.kind == Kind::confirmed) {
    if (auto rule = rule_of(About::change, last.object); !rule.empty()) return violates(std::move(rule));
  }
  if (last.transfer != Transfer::automatic) return violates(by_transfer(last, ""));
  // It answers, but not where there is something to be refused.
  const bool refused = evidence.difference().model.kind == Kind::aborted && !evidence.operational();
  if (refused &&
      is_one_of(code, {abort::no_object, abort::no_sub_index, abort::read_only, abort::write_only})) {
    if (auto named = up ? assign_upload(evidence) : refused_download(evidence)) return named;
  }
  if (up && is_long) return violates("SDO-SUP-01");
  if (!up && last.data.size() > 4) return violates("SDO-SDN-01");
  if (evidence.operational()) return violates("SDO-GEN-14");
  return violates("SDO-GEN-01");
}

/// The same abort code, with another multiplexer. Which one belongs to a request that begins nothing is not
/// laid down.
bool aborts_another_object(const Difference& difference) {
  const auto& device = difference.device;
  const auto& model = difference.model;
  return device.kind == Kind::aborted && model.kind == Kind::aborted && device.code == model.code &&
         device.data.size() == 8 && model.data.size() == 8 &&
         !std::equal(device.data.begin() + 1, device.data.begin() + 4, model.data.begin() + 1);
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
    if (evidence.may_be_late()) return strains("SDO-GEN-18");
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
  if (aborts_another_object(evidence.difference())) return strains("SDO-ERR-04");
  const auto command = frame.data[0];
  const bool segment = command >> 5U == 0 || command >> 5U == 3 || command >> 5U >= 5;
  // A transfer that was begun by a request, and that the server has given up before its time.
  const bool early = device == Kind::aborted && evidence.difference().device.code == abort::timed_out;
  if (early && segment && !(model == Kind::aborted && evidence.difference().model.code == abort::timed_out)) {
    const auto begun = std::ranges::find_if(evidence.before(), [](const Action& each) {
      return each.kind == Action::Kind::request && each.frame.data[0] >> 5U == 2;
    });
    if (begun != evidence.before().end()) return strains("SDO-SUP-17");
  }
  if (command >> 5U == 1 && device == Kind::replied && model == Kind::replied &&
      differs_in_reserved(evidence.difference().device.data, evidence.difference().model.data))
    return violates("SDO-GEN-05");
  for (const auto& earlier : evidence.before()) {
    if (!segment || !earlier.is_transfer()) continue;
    // What the client did wrong has left the transfer open or closed.
    auto of_fault = rule_of_fault(earlier);
    if (of_fault.empty() && command >> 5U == 3 && earlier.kind == Action::Kind::upload &&
        device == Kind::replied)
      return violates("SDO-SUP-09");
    if (!of_fault.empty()) return strains(std::move(of_fault));
  }
  std::string rule;
  switch (command >> 5U) {
    case 0: rule = "SDO-SDN-16"; break;
    case 3: rule = "SDO-SUP-08"; break;
    case 5:
      // To begin one is no sub-command without one.
      if ((command & 3U) != 0) {
        rule = "SDO-BUP-21";
      } else if (const auto blksize = frame.data[4]; blksize == 0 || blksize > 127) {
        rule = blksize == 0 ? "SDO-BUP-09" : "SDO-BUP-10";
      } else {
        return strains("SDO-BUP-01");
      }
      break;
    case 6: rule = "SDO-BDN-22"; break;
    case 7: rule = command == 0xE0 ? "SDO-ERR-01" : "SDO-ERR-02"; break;
    case 2:
      if (device != Kind::silence) {
        // Both may be aborts, which are kept as what they say.
        const auto bytes_of = [](const Answer& answer) {
          if (answer.kind == Kind::replied) return answer.data;
          Bytes out = {0x80, 0, 0, 0, 0, 0, 0, 0};
          store_le(std::span(out).subspan(4, 4), answer.code.value());
          return out;
        };
        if (auto single = assign_single_upload(evidence, bytes_of(evidence.difference().device),
                                               bytes_of(evidence.difference().model)))
          return single;
      }
      return strains(command == 0x40 ? "SDO-UPL-12" : "SDO-UPL-13");
    case 1: return (command & 0x10U) != 0 ? strains("SDO-DNL-18") : std::nullopt;
    default: return std::nullopt;
  }
  // Nothing may be served without a transfer that is running; how it is refused is told less strictly.
  const bool served = device == Kind::replied && model == Kind::aborted;
  const bool unheard = device == Kind::silence && command >> 5U == 7;
  return served || unheard ? violates(std::move(rule)) : strains(std::move(rule));
}

}  // namespace conform::explore
