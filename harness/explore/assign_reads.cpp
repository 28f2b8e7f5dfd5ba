// SPDX-License-Identifier: Apache-2.0
// Answers to uploads.
#include <algorithm>
#include <array>
#include <string>

#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "explore/assign_objects.hpp"

namespace conform::explore {

using Kind = Answer::Kind;
namespace abort = canopen::abort;

namespace {

/// What came between a write and its read-back, and should have left it alone.
std::string in_between(const Evidence& evidence, std::size_t write) {
  std::string out;
  for (const auto& each : evidence.before().subspan(write + 1)) {
    const auto command = each.nmt_command(evidence.words.node);
    if (command > 0x80 || each.kind == Action::Kind::power) return "";
    if (each.kind != Action::Kind::download || each.object.sub == SubIndex(0)) continue;
    if (each.object.index == Index(0x1011)) out = "OD-1011-11";
    if (each.object.index == Index(0x1010) && evidence.last().object.index == Index(0x1020))
      out = "OD-1020-04";
  }
  return out;
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
      // The transfer itself went as it does with the model: what was not ended is seen all the same.
      const bool block = write.transfer == Transfer::block || write.transfer == Transfer::block_unsized;
      if (!block && evidence.played.due[i].kind != Kind::confirmed) return violates("SDO-SDN-18");
      return rule.empty() ? std::nullopt : violates(std::move(rule));
    }
    if (evidence.played.due[i].kind == Kind::aborted) return violates("OD-ACC-05");
    const auto size = write.data.size();
    const auto* entry = evidence.words.find(write.object);
    if (entry == nullptr || entry->command || entry->may_change) return std::nullopt;
    if (auto rule = in_between(evidence, i); !rule.empty()) return violates(std::move(rule));
    const auto held = evidence.difference().device.data.size();
    if (write.transfer == Transfer::segmented && held != size && size % 7 == 0) return violates("SDO-SDN-11");
    if (write.transfer != Transfer::automatic) return violates(by_transfer(write, ""));
    if (size > 4) return violates(held != size && size % 7 == 0 ? "SDO-SDN-11" : "SDO-SDN-03");
    if (auto rule = rule_of(About::keeping, write.object); !rule.empty()) return violates(std::move(rule));
    constexpr std::array<std::string_view, 5> expedited = {"SDO-SDN-15", "SDO-DNL-02", "SDO-DNL-01",
                                                           "SDO-DNL-04", "SDO-DNL-03"};
    return violates(std::string(expedited[size]));
  }
  return std::nullopt;
}

/// Nothing before the difference can have changed a value: time went by, entries were read, the device
/// started or changed its state.
bool is_untouched(const Evidence& evidence) {
  return std::ranges::all_of(evidence.before(), [&](const Action& each) {
    using Act = Action::Kind;
    return each.kind == Act::wait || each.kind == Act::power || each.kind == Act::upload ||
           each.nmt_command(evidence.words.node) != 0;
  });
}

std::optional<Assigned> after_a_reset(const Evidence& evidence) {
  // What nobody has changed no reset can bring back.
  if (is_untouched(evidence)) return std::nullopt;
  const auto index = evidence.last().object.index.value();
  const bool communication = index < 0x2000;
  bool reset = false, node = false, stored = false, loaded = false;
  std::string refused;
  std::uint8_t stored_sub = 0;
  for (std::size_t i = 0; i < evidence.before().size(); ++i) {
    const auto& each = evidence.before()[i];
    const auto command = each.nmt_command(evidence.words.node);
    reset = reset || command > 0x80 || each.kind == Action::Kind::power;
    node = node || command == 0x81 || each.kind == Action::Kind::power;
    if (each.kind != Action::Kind::download) continue;
    const bool commands = each.object.index == Index(0x1010) || each.object.index == Index(0x1011);
    if (commands && evidence.played.due[i].kind == Kind::aborted) {
      refused = area_of(each.object.index.value()) + "-09";
      continue;
    }
    if (each.object.index.value() == 0x1010) {
      stored = true;
      stored_sub = each.object.sub.value();
    }
    loaded = loaded || each.object.index.value() == 0x1011;
  }
  if (!reset) return std::nullopt;
  // What was refused has done nothing, and what has done nothing else is left.
  if (!refused.empty() && !stored && !loaded) return violates(std::move(refused));
  if (index == 0x1020 && loaded) return violates("STO-1020-04");
  if (index == 0x1020 && stored) return violates("OD-1020-04");
  if (loaded) return violates(communication ? "OD-1011-12" : "OD-1011-13");
  if (stored) return violates(stored_sub == 2 ? "OD-1010-11" : stored_sub == 3 ? "OD-1010-12" : "OD-1010-10");
  if (communication) return violates("NMT-FSA-24");
  return node ? violates("NMT-FSA-25") : strains("NMT-FSA-26");
}

/// A text with characters that no text may have.
std::string wrong_text(const Evidence& evidence, const device::Entry& entry) {
  if (entry.type != canopen::DataType::visible_string) return "";
  const auto& data = evidence.difference().device.data;
  const bool visible = std::ranges::all_of(
      data, [](std::uint8_t byte) { return byte == 0 || (byte >= 0x20 && byte <= 0x7E); });
  const auto index = entry.mux.index.value();
  return visible || index < 0x1008 || index > 0x100A ? "" : id_of(area_of(index), 1);
}

/// Bits and values that no device may have.
std::string reserved_value(const Evidence& evidence) {
  const auto mux = evidence.last().object;
  const auto& data = evidence.difference().device.data;
  const auto value = load_le(data);
  if (mux.index == Index(0x1010) && mux.sub != SubIndex(0) && data.size() == 4 && (value & ~3ULL) != 0)
    return "OD-1010-04";
  if (mux.index == Index(0x1011) && mux.sub != SubIndex(0) && data.size() == 4 && (value & ~1ULL) != 0)
    return "OD-1011-04";
  if (mux.index == Index(0x1022) && data.size() == 2)
    return value > 0xFF ? "OD-1022-01" : value > 0 && value < 0x80 ? "OD-1022-02" : "";
  if (mux.sub != SubIndex(2) || data.size() != 1 || data[0] == 0xFF) return "";
  if (mux.index == Index(0x1023) && data[0] > 3) return "OD-1023-02";
  return mux.index == Index(0x1025) && data[0] > 1 ? "OD-1025-02" : "";
}

/// The last write to the number of errors was refused, and not to be taken.
bool was_kept(const Evidence& evidence) {
  for (auto i = evidence.before().size(); i-- > 0;) {
    const auto& each = evidence.before()[i];
    if (each.kind == Action::Kind::download && each.is_at(0x1003, 0))
      return load_le(each.data) != 0 && evidence.played.due[i].kind == Kind::aborted &&
             evidence.played.answers[i].kind == Kind::aborted;
  }
  return false;
}

/// 1003h holds other errors than with the model.
std::optional<Assigned> other_history(const Evidence& evidence) {
  const auto sub = evidence.last().object.sub.value();
  const auto& device = evidence.difference().device;
  const bool holds = device.kind == Kind::confirmed;
  if (was_kept(evidence)) return violates("OD-1003-07");
  // Error code 0000h is that of "error reset", where one came.
  const auto emcy = canopen::connection_set(evidence.words.node).emcy;
  const bool reset = std::ranges::any_of(evidence.played.trace, [&](const can::CapturedFrame& each) {
    return each.frame.is_data(emcy) && emcy_code(each.frame) == 0;
  });
  if (reset && holds && sub > 0 && device.data.size() == 4 && (load_le(device.data) & 0xFFFFU) == 0)
    return violates("OD-1003-15");
  // From power-on; the device may have an error then that nobody knows of.
  const bool has_some = holds && (sub > 0 || load_le(device.data) != 0);
  if (has_some && is_untouched(evidence)) return strains("OD-1003-04");
  return std::nullopt;
}

/// The errors were deleted, and none came since then.
bool was_cleared(const Evidence& evidence) {
  for (auto i = evidence.before().size(); i-- > 0;) {
    const auto& each = evidence.before()[i];
    if (each.kind != Action::Kind::download) continue;
    return each.is_at(0x1003, 0) && load_le(each.data) == 0 && evidence.played.due[i].kind == Kind::confirmed;
  }
  return false;
}

/// The high resolution time goes on from what was written.
std::optional<Assigned> other_time(const Evidence& evidence) {
  const auto wrote = evidence.wrote(0x1013, 0);
  constexpr std::uint64_t soon = 10'000'000;
  const auto since = [&](const Answer& answer) { return load_le(answer.data) - wrote.value_or(0); };
  const bool measured = wrote && !evidence.commanded() && since(evidence.difference().model) < soon;
  return measured && since(evidence.difference().device) > 2 * soon ? violates("OD-1013-03") : std::nullopt;
}

/// A value that cannot be written was another one when it was read before, without a reset in between.
std::string changed_by_itself(const Evidence& evidence, const device::Entry& entry) {
  if (entry.access != device::Access::constant || entry.may_change) return "";
  for (auto i = evidence.before().size(); i-- > 0;) {
    const auto& each = evidence.before()[i];
    if (each.kind == Action::Kind::power || each.nmt_command(evidence.words.node) > 0x80) return "";
    if (each.kind != Action::Kind::upload || each.object != entry.mux || !each.fault.empty()) continue;
    const auto& answer = evidence.played.answers[i];
    if (answer.kind != Kind::confirmed || answer.data == evidence.difference().device.data) continue;
    const auto index = entry.mux.index.value();
    return index >= 0x1008 && index <= 0x100A ? id_of(area_of(index), 3) : "OD-ACC-06";
  }
  return "";
}

std::optional<Assigned> other_value(const Evidence& evidence) {
  const auto& read = evidence.last();
  const auto mux = read.object;
  const auto* entry = evidence.words.find(mux);
  const auto& device = evidence.difference().device;
  if (entry == nullptr) return std::nullopt;
  if (entry->size().value_or(0) > 4 && !device.data.empty() && device.data.size() <= 4)
    return violates("SDO-UPL-05");
  if (entry->size() && device.data.size() != *entry->size())
    return violates(mux.sub.value() == 0 && is_array_or_record(evidence.words, mux.index) ? "OD-GEN-10"
                                                                                          : "OD-LEN-04");
  if (auto rule = changed_by_itself(evidence, *entry); !rule.empty()) return violates(std::move(rule));
  if (read.transfer == Transfer::block && device.data.size() > 4) return violates("SDO-BUP-01");
  if (auto rule = wrong_text(evidence, *entry); !rule.empty()) return violates(std::move(rule));
  if (auto rule = reserved_value(evidence); !rule.empty()) return violates(std::move(rule));
  if (mux.index == Index(0x1013)) return other_time(evidence);
  if (mux.index == Index(0x1001)) {
    if (!device.data.empty() && device.data[0] != 0 && (device.data[0] & 1U) == 0)
      return violates("OD-1001-04");
    const bool raised = !evidence.difference().model.data.empty() && evidence.difference().model.data[0] != 0;
    return violates(raised ? "OD-1001-05" : "OD-1001-06");
  }
  if (mux.index == Index(0x1003) && was_cleared(evidence)) return violates("OD-1003-05");
  if (mux.index == Index(0x1003)) {
    if (auto history = other_history(evidence)) return history;
    // How many errors the history holds is the device's choice.
    return mux.sub.value() == 0   ? strains("OD-1003-10")
           : mux.sub.value() == 1 ? violates("OD-1003-11")
                                  : strains("OD-1003-12");
  }
  if (auto reset = after_a_reset(evidence)) return reset;
  if (auto written = after_a_write(evidence)) return written;
  if (entry->access == device::Access::constant || !entry->writable()) {
    if (entry->may_change) return std::nullopt;
    if (evidence.conversation.size() > 1 &&
        !evidence.some([](const Action& each) { return each.kind == Action::Kind::download; }))
      return violates("OD-ACC-06");
  }
  // What was there from power-on is another value than described.
  // The model agrees with the description; where it does not, it is no measure.
  const bool is_measure = entry->default_value && *entry->default_value == evidence.difference().model.data;
  if (!is_untouched(evidence) || !is_measure) return std::nullopt;
  if (entry->size().value_or(8) > 4) return violates("SDO-SUP-01");
  if (auto rule = rule_of(About::value, mux); !rule.empty()) return violates(std::move(rule));
  const auto area = area_of(mux.index.value());
  if ((area == "OD-1400" || area == "OD-1800") && mux.sub.value() == 1) {
    const auto number = mux.index.value() & 0x1FFU;
    return violates(id_of(area, number < 4 ? 4 + static_cast<int>(number) : 8));
  }
  const auto beyond = [&](const std::optional<Bytes>& limit, bool above) {
    if (!limit || canopen::is_signed(entry->type)) return false;
    return above ? load_le(device.data) > load_le(*limit) : load_le(device.data) < load_le(*limit);
  };
  if (beyond(entry->low, false) || beyond(entry->high, true)) return violates("OD-DSC-04");
  return strains(evidence.before().empty() ? "OD-DSC-03" : "OD-RST-05");
}

}  // namespace

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
    if (evidence.last().transfer == Transfer::block &&
        is_one_of(model.code, {abort::no_object, abort::no_sub_index, abort::write_only}))
      return refusal(evidence, "SDO-BUP-23",
                     {abort::general, abort::no_data, abort::no_sub_index, abort::unsupported_access});
    if (model.code == abort::no_object) return absent(evidence, true);
    // Every object may have this one.
    if (mux.sub == SubIndex(0xFF) && device.kind == Kind::confirmed) {
      auto rule = wrong_structure(mux, device.data);
      return rule.empty() ? std::nullopt : violates(std::move(rule));
    }
    if (model.code == abort::no_sub_index)
      return refusal(evidence, missing_sub_index(evidence, true), {abort::general, abort::no_data});
    if (model.code == abort::write_only)
      return refusal(evidence, "OD-ACC-03", {abort::unsupported_access, abort::general});
    if (mux.index == Index(0x1003)) {
      const bool confirmed = device.kind == Kind::confirmed;
      if (confirmed && was_cleared(evidence)) return violates("OD-1003-05");
      if (auto history = other_history(evidence)) return history;
      return confirmed ? violates("OD-1003-09") : strains("OD-1003-03");
    }
    // Why the model has nothing to tell is its own matter, how long the value is it is not.
    const auto* entry = evidence.words.find(mux);
    const bool has_length = entry != nullptr && entry->size() && device.kind == Kind::confirmed;
    return has_length && device.data.size() != *entry->size() ? violates("OD-LEN-04") : std::nullopt;
  }
  if (model.kind != Kind::confirmed) return std::nullopt;
  if (device.kind == Kind::confirmed) return other_value(evidence);
  if (device.kind != Kind::aborted) return std::nullopt;
  if (evidence.last().transfer == Transfer::block) return strains("SDO-BUP-01");
  if (mux.index == Index(0x1003)) {
    if (auto history = other_history(evidence)) return history;
    return violates(mux.sub.value() > 1 ? "OD-1003-12" : "OD-1003-10");
  }
  if (auto rule = rule_of_presence(evidence); !rule.empty()) return violates(std::move(rule));
  const auto* entry = evidence.words.find(mux);
  if (entry == nullptr || entry->command || entry->type == canopen::DataType::domain) return std::nullopt;
  const auto area = area_of(mux.index.value());
  if (entry->mux.sub.value() == 2 && (area == "OD-1400" || area == "OD-1800")) return violates(area + "-01");
  if (area == "OD-1280" && device.code == abort::no_sub_index) return violates("OD-1280-01");
  if (entry->size().value_or(0) > 4 && device.code == abort::timed_out) return violates("SDO-SUP-01");
  return violates("OD-GEN-17");
}

/// What an initiate response of eight bytes says; nullopt: it begins a segmented upload, or is none.
std::optional<Answer> answer_in(ByteView bytes) {
  if (bytes.size() != 8) return std::nullopt;
  Answer out;
  if (bytes[0] == 0x80) {
    out.kind = Kind::aborted;
    out.code = AbortCode(static_cast<std::uint32_t>(load_le(bytes.subspan(4))));
    return out;
  }
  if (bytes[0] >> 5U != 2 || (bytes[0] & 2U) == 0) return std::nullopt;
  out.kind = Kind::confirmed;
  out.size_told = (bytes[0] & 1U) != 0;
  const auto size = out.size_told ? 4U - ((bytes[0] >> 2U) & 3U) : 4U;
  out.data.assign(bytes.begin() + 4, bytes.begin() + 4 + size);
  return out;
}

std::optional<Assigned> assign_single_upload(const Evidence& evidence, ByteView came, ByteView due) {
  const auto& last = evidence.last();
  const auto& bytes = last.frame.data;
  if (last.is_transfer() || last.frame.dlc != 8 || bytes[0] >> 5U != 2) return std::nullopt;
  if (differs_in_reserved(came, due)) return violates("SDO-GEN-05");
  auto device = answer_in(came), model = answer_in(due);
  if (!device || !model || device->same_as(*model)) return std::nullopt;
  Conversation conversation(evidence.conversation.begin(), evidence.conversation.end());
  auto& request = conversation[evidence.difference().action];
  request = upload({Index(static_cast<std::uint16_t>(bytes[1] | (bytes[2] << 8U))), SubIndex(bytes[3])});
  Played played;
  played.answers = evidence.played.answers;
  played.due = evidence.played.due;
  played.difference = evidence.difference();
  played.difference->what = Difference::What::answer;
  played.difference->device = std::move(*device);
  played.difference->model = std::move(*model);
  return assign_answer({evidence.words, conversation, played});
}

}  // namespace conform::explore
