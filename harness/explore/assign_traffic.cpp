// SPDX-License-Identifier: Apache-2.0
// Frames that came without being asked for, or did not come.
#include <algorithm>
#include <string>

#include "canopen/cob_id.hpp"
#include "explore/assign.hpp"

namespace conform::explore {
namespace {

using What = Difference::What;

constexpr std::uint8_t start = 1, stop = 2, pre_operational = 0x80;

/// An NMT frame that no device may obey, or every one must; empty: all are plain.
std::string odd_nmt(const Evidence& evidence) {
  for (const auto& each : evidence.conversation) {
    if (each.kind != Action::Kind::frame || each.frame.id != 0) continue;
    const auto& frame = each.frame;
    if (frame.remote || frame.extended) return "NMT-FSA-19";
    if (frame.dlc < 2) return "NMT-FSA-17";
    if (frame.dlc > 2) return "NMT-FSA-18";
    if (frame.data[1] != 0 && frame.data[1] != evidence.words.node.value()) return "NMT-FSA-15";
    const auto command = frame.data[0];
    if (command != start && command != stop && (command < pre_operational || command > 0x82))
      return "NMT-FSA-16";
    if (frame.data[1] == 0) return "NMT-FSA-14";
  }
  return "";
}

/// The state is not the one after the last command.
std::string transition(const Evidence& evidence) {
  if (auto odd = odd_nmt(evidence); !odd.empty()) return odd;
  const auto [last, before] = evidence.commands();
  if (last == before) return "NMT-FSA-13";
  if (last == start) return before == stop ? "NMT-FSA-05" : "NMT-FSA-01";
  if (last == stop) return before == start ? "NMT-FSA-04" : "NMT-FSA-02";
  return before == stop ? "NMT-FSA-06" : "NMT-FSA-03";
}

/// The last action of the conversation that resets or switches on; 0: power, 81h, 82h.
struct LastReset {
  bool found = false;
  std::uint8_t command = 0;
  std::uint8_t state = pre_operational;  ///< the state it was given in, as the command that led there
};
LastReset last_reset(const Evidence& evidence) {
  LastReset out;
  std::uint8_t state = pre_operational;
  for (const auto& each : evidence.conversation) {
    const auto command = each.nmt_command(evidence.words.node);
    if (each.kind == Action::Kind::power || command == 0x81 || command == 0x82) {
      out = {true, command, state};
      state = pre_operational;
    } else if (command == start || command == stop || command == pre_operational) {
      state = command;
    }
  }
  return out;
}

/// The last reset was commanded at once behind another one.
bool follows_another_reset(const Evidence& evidence) {
  bool just = false, out = false;
  for (const auto& each : evidence.conversation) {
    if (each.kind == Action::Kind::wait) just = false;
    if (each.nmt_command(evidence.words.node) <= 0x80) continue;
    out = just;
    just = true;
  }
  return out;
}

/// It came behind what was asked or sent last, and not by itself.
bool follows_last(const Evidence& evidence) {
  const auto& difference = evidence.difference();
  const auto& begins = evidence.played.begins;
  return evidence.last().kind != Action::Kind::wait && difference.action < begins.size() &&
         difference.time > begins[difference.action];
}

std::optional<Assigned> assign_boot_up(const Evidence& evidence) {
  const auto odd = odd_nmt(evidence);
  const auto what = evidence.difference().what;
  const auto reset = last_reset(evidence);
  if (what == What::other_data) return violates("NMT-BOOT-04");
  if (what == What::missing) {
    if (!odd.empty()) return violates(odd);
    if (!reset.found || reset.command == 0) return violates("NMT-BOOT-01");
    if (follows_another_reset(evidence)) return violates("NMT-BOOT-09");
    const bool node = reset.command == 0x81;
    if (reset.state == start) return violates(node ? "NMT-FSA-09" : "NMT-FSA-10");
    if (reset.state == stop) return violates(node ? "NMT-FSA-11" : "NMT-FSA-12");
    return violates(node ? "NMT-BOOT-02" : "NMT-BOOT-03");
  }
  if (!odd.empty() && odd != "NMT-FSA-14") return violates(odd);
  if (!reset.found) {
    const bool commanded = evidence.commanded();
    const auto [last, before] = evidence.commands();
    if (commanded && last == before) return violates("NMT-FSA-13");
    if (evidence.conversation.size() <= 1 && !commanded && !follows_last(evidence))
      return violates("NMT-BOOT-01");
    return violates(commanded ? "NMT-BOOT-06" : "NMT-BOOT-10");
  }
  return violates(reset.command == 0x82   ? "NMT-BOOT-03"
                  : reset.command == 0x81 ? "NMT-BOOT-02"
                                          : "NMT-BOOT-01");
}

std::optional<Assigned> assign_heartbeat(const Evidence& evidence) {
  const auto& difference = evidence.difference();
  if (difference.what == What::other_data) {
    if (difference.came.dlc != 1) return violates("EC-HBP-08");
    if (((difference.came.data[0] ^ difference.due.data[0]) & 0x80U) != 0) return violates("EC-HBP-07");
    // Without a command it may have started by itself (1F80h).
    const bool commanded = evidence.some(
        [&](const Action& each) { return each.kind == Action::Kind::frame && each.frame.id == 0; });
    return commanded ? violates(transition(evidence)) : strains("EC-HBP-06");
  }
  std::size_t writes = 0;
  for (const auto& each : evidence.conversation)
    writes += each.kind == Action::Kind::download && each.is_at(0x1017, 0);
  const auto period = evidence.wrote(0x1017, 0).value_or(0);
  if (period > 0x7FFF) return violates("EC-HBP-11");
  if (difference.what == What::surplus && period == 0)
    return writes > 0 ? violates("EC-HBP-04") : strains("EC-HBP-13");
  if (evidence.stopped()) return violates("NMT-SVC-04");
  if (writes > 1) return violates("EC-HBP-03");
  const bool commanded =
      evidence.some([&](const Action& each) { return each.nmt_command(evidence.words.node) != 0; });
  if (commanded && evidence.commands().last == evidence.commands().before) return violates("EC-HBP-10");
  // When the first one comes is not laid down: time must have passed, and the time must have been written.
  return evidence.settled() && period != 0 ? violates("EC-HBP-01") : strains("EC-HBP-01");
}

std::optional<Assigned> assign_guarding(const Evidence& evidence) {
  const auto& difference = evidence.difference();
  const bool heartbeat = evidence.wrote(0x1017, 0).has_value();
  if (difference.what == What::missing) return violates(heartbeat ? "EC-NG-12" : "EC-NG-01");
  if (difference.what == What::surplus) {
    if (evidence.wrote(0x1017, 0).value_or(0) != 0) return violates("EC-NG-11");
    for (const auto& each : evidence.conversation) {
      if (each.kind != Action::Kind::frame || !each.frame.remote || each.frame.id < 0x700) continue;
      if (each.frame.extended) return violates("EC-NG-15");
      if (!guards(each, evidence)) return violates("EC-NG-06");
    }
    return strains("EC-NG-16");  // guarding is optional, and may be there
  }
  if (difference.came.dlc != 1) return violates("EC-NG-05");
  const bool commanded = evidence.some(
      [](const Action& each) { return each.kind == Action::Kind::frame && each.frame.id == 0; });
  if (((difference.came.data[0] ^ difference.due.data[0]) & 0x80U) != 0) {
    if (commanded) return violates("EC-NG-03");
    const auto requests = std::ranges::count_if(evidence.conversation,
                                                [&](const Action& each) { return guards(each, evidence); });
    return violates(requests <= 1 ? "EC-NG-01" : "EC-NG-02");
  }
  const auto state = difference.came.data[0] & 0x7FU;
  if (state != 4 && state != 5 && state != 0x7F) return violates("EC-NG-04");
  return commanded ? violates(transition(evidence)) : strains("NMT-BOOT-07");
}

std::optional<Assigned> assign_error_control(const Evidence& evidence) {
  const auto& difference = evidence.difference();
  const auto& due = difference.what == What::surplus ? difference.came : difference.due;
  if (due.remote) return violates("NMT-SVC-05");
  // A heartbeat on its way when the reset came, on one side only: when it was sent is the device's matter.
  const auto boots = [](const can::Frame& frame) { return frame.dlc == 1 && frame.data[0] == 0; };
  if (difference.what == What::other_data && boots(difference.came) != boots(difference.due) &&
      last_reset(evidence).found)
    return std::nullopt;
  if (due.size() == 0 || (due.data[0] & 0x7FU) == 0) return assign_boot_up(evidence);
  const bool guarded = evidence.some([&](const Action& each) {
    return each.kind == Action::Kind::frame && each.frame.remote && (each.frame.id & 0x780U) == 0x700U;
  });
  return guarded ? assign_guarding(evidence) : assign_heartbeat(evidence);
}

/// What the conversation has made of a PDO.
struct PdoSetting {
  std::uint16_t index = 0;
  std::optional<std::uint64_t> cob_id, type, inhibit, timer, sync_start;
};
PdoSetting setting_of(const Evidence& evidence, std::uint16_t index) {
  const auto wrote = [&](std::uint8_t sub) { return evidence.wrote(index, sub); };
  return {index, wrote(1), wrote(2), wrote(3), wrote(5), wrote(6)};
}

bool is_rpdo(const Action& action, const Evidence& evidence) {
  if (action.kind != Action::Kind::frame || action.frame.id < 0x200) return false;
  const auto base = action.frame.id - evidence.words.node.value();
  return base == 0x200 || base == 0x300 || base == 0x400 || base == 0x500;
}

/// Some RPDO takes effect with a SYNC.
bool waits_for_sync(const Evidence& evidence) {
  for (std::uint16_t number = 0; number < 4; ++number) {
    const auto type = evidence.wrote(static_cast<std::uint16_t>(0x1400 + number), 2);
    if (type && *type <= 240) return true;
  }
  return false;
}

/// How many bytes are mapped by default, of an RPDO whose mapping nobody has changed.
std::optional<std::size_t> mapped_bytes(const Evidence& evidence, std::uint16_t index) {
  const auto value_of = [&](std::uint8_t sub) -> std::optional<std::uint64_t> {
    const auto* entry = evidence.words.find({Index(index), SubIndex(sub)});
    if (entry == nullptr || !entry->default_value || evidence.wrote(index, sub)) return std::nullopt;
    return load_le(*entry->default_value);
  };
  const auto count = value_of(0);
  if (!count || *count == 0 || *count > 64) return std::nullopt;
  std::size_t bits = 0;
  for (std::uint64_t sub = 1; sub <= *count; ++sub) {
    const auto mapped = value_of(static_cast<std::uint8_t>(sub));
    if (!mapped) return std::nullopt;
    bits += *mapped & 0xFFU;
  }
  return (bits + 7) / 8;
}

/// The content comes out of an RPDO that was not taken as it should be.
std::optional<Assigned> assign_rpdo(const Evidence& evidence) {
  const Action* rpdo = nullptr;
  std::size_t count = 0;
  for (const auto& each : evidence.conversation) {
    if (!is_rpdo(each, evidence)) continue;
    rpdo = &each;
    ++count;
  }
  if (rpdo == nullptr) return std::nullopt;
  if (rpdo->frame.remote || rpdo->frame.extended) return violates("PDO-RX-13");
  const auto number = (rpdo->frame.id - 0x200U) / 0x100U;
  const auto setting = setting_of(evidence, static_cast<std::uint16_t>(0x1400 + number));
  if (!evidence.operational()) return violates("PDO-RX-02");
  if (setting.cob_id)
    return violates((*setting.cob_id & canopen::cob_id::bit31) != 0 ? "OD-1400-09" : "OD-1400-11");
  if (setting.type.value_or(255) <= 240)
    return violates(count > 1 ? "PDO-RX-04" : setting.type == 1U ? "PDO-RX-03" : "PDO-RX-05");
  const auto mapping = static_cast<std::uint16_t>(0x1600 + number);
  if (evidence.wrote(mapping, 0)) return violates("OD-1600-15");
  if (const auto size = mapped_bytes(evidence, mapping); size && count == 1) {
    // It must be as if it had the right length, or as if it had not come.
    const auto is_empty = [](const can::Frame& frame) {
      return std::ranges::all_of(frame.bytes(), [](std::uint8_t byte) { return byte == 0; });
    };
    if (rpdo->frame.dlc > *size && is_empty(evidence.difference().came)) return violates("PDO-RX-07");
    if (rpdo->frame.dlc < *size && is_empty(evidence.difference().due)) return violates("PDO-RX-06");
  }
  return violates("PDO-RX-01");
}

/// The TPDO, by a remote frame.
bool is_asked_for(const Evidence& evidence) {
  return evidence.some([&](const Action& each) {
    return each.kind == Action::Kind::frame && each.frame.remote && each.frame.id == frame_of(evidence).id;
  });
}

/// It was told to.
bool produces_sync(const Evidence& evidence) {
  return (evidence.wrote(0x1005, 0).value_or(0) & canopen::cob_id::bit30) != 0 &&
         evidence.wrote(0x1006, 0).value_or(0) != 0;
}

/// The last SYNC had a counter with a value that 1019h does not count to.
bool counts_oddly(const Evidence& evidence) {
  const Action* sync = nullptr;
  for (const auto& each : evidence.conversation) {
    if (each.kind == Action::Kind::frame && each.frame.is_data(canopen::sync_can_id)) sync = &each;
  }
  const auto overflow = evidence.wrote(0x1019, 0).value_or(0);
  return sync != nullptr && sync->frame.dlc == 1 && overflow != 0 &&
         (sync->frame.data[0] == 0 || sync->frame.data[0] > overflow);
}

std::optional<Assigned> missing_tpdo(const Evidence& evidence, const PdoSetting& setting) {
  const auto type = setting.type.value_or(255);
  const bool synced = evidence.some([](const Action& each) {
    return each.kind == Action::Kind::frame && each.frame.is_data(canopen::sync_can_id);
  });
  const bool asked = is_asked_for(evidence);
  if (setting.sync_start.value_or(0) != 0 && type <= 240)
    return violates(evidence.wrote(0x1019, 0).value_or(0) == 0 ? "PDO-TX-15" : "PDO-TX-14");
  if (!synced && type <= 240 && produces_sync(evidence)) return violates("SYNC-PRO-08");
  if (type <= 240 && counts_oddly(evidence)) return violates("SYNC-CON-06");
  if (type == 0) return violates("PDO-TX-07");
  if (type == 1) return violates("PDO-TX-05");
  if (type <= 240) return violates("PDO-TX-06");
  if (type == 0xFC) return violates("PDO-TX-20");
  if (type == 0xFD) return violates("PDO-TX-19");
  if (setting.inhibit.value_or(0) != 0) return violates("PDO-TX-12");
  if (setting.timer.value_or(0) != 0) return violates("PDO-TX-09");
  if (asked) return violates("OD-1800-14");
  if (synced && evidence.wrote(0x1006, 0)) return violates("SYNC-PRO-08");
  // An RPDO that did not arrive, or has yet to take effect, is no change.
  if (auto rpdo = assign_rpdo(evidence); rpdo && !setting.type)
    return strains(waits_for_sync(evidence) ? std::move(rpdo->requirement) : "PDO-TX-08");
  return violates("PDO-TX-08");
}

std::optional<Assigned> surplus_tpdo(const Evidence& evidence, const PdoSetting& setting) {
  if (!evidence.operational())
    return evidence.commanded() ? in_its_state(evidence, "PDO-TX-02") : strains("PDO-TX-02");
  if (setting.cob_id && (*setting.cob_id & canopen::cob_id::bit31) != 0) return violates("OD-1800-09");
  const auto type = setting.type.value_or(255);
  // With no entry in force it has nothing to send.
  if (evidence.wrote(static_cast<std::uint16_t>(setting.index + 0x200), 0) == 0U)
    return violates("PDO-MAP-20");
  const bool asked = is_asked_for(evidence);
  if (asked && type >= 0xFE) return violates("OD-1800-14");
  if (type == 0) return violates("PDO-TX-07");
  if (type <= 240 && setting.timer.value_or(0) != 0) return violates("PDO-TX-11");
  if (setting.sync_start.value_or(0) != 0 && type <= 240) return violates("PDO-TX-14");
  if (type == 1) return violates("PDO-TX-05");
  if (type <= 240) return violates("PDO-TX-06");
  if (type == 0xFC) return violates("PDO-TX-20");
  if (type == 0xFD) return violates("PDO-TX-19");
  if (setting.inhibit.value_or(0) != 0) return violates("PDO-TX-12");
  if (setting.timer) return violates(*setting.timer == 0 ? "PDO-TX-10" : "PDO-TX-09");
  if (auto rpdo = assign_rpdo(evidence)) return strains(std::move(rpdo->requirement));
  return strains("PDO-TX-08");
}

std::optional<Assigned> assign_tpdo(const Evidence& evidence, std::uint16_t number) {
  const auto& difference = evidence.difference();
  const auto setting = setting_of(evidence, static_cast<std::uint16_t>(0x1800 + number));
  if (difference.what == What::missing) return missing_tpdo(evidence, setting);
  if (difference.what == What::surplus) return surplus_tpdo(evidence, setting);
  if (difference.came.dlc != difference.due.dlc) return violates("PDO-TX-01");
  if (auto rpdo = assign_rpdo(evidence)) return rpdo;
  if (setting.type == 0xFDU) return violates("PDO-TX-19");
  // What it holds are values of entries, which may be wrong by themselves.
  return strains("PDO-TX-01");
}

std::optional<Assigned> assign_sync(const Evidence& evidence) {
  const auto& difference = evidence.difference();
  if (difference.what == What::other_data) {
    const bool again = evidence.some(
        [](const Action& each) { return each.kind == Action::Kind::frame && each.frame.id == 0; });
    if (difference.due.dlc == 0) return violates("SYNC-PRO-01");
    return violates(again ? "SYNC-PRO-05" : "SYNC-PRO-04");
  }
  if (difference.what == What::surplus) {
    const auto moved = evidence.wrote(0x1005, 0);
    if (moved && (*moved & canopen::cob_id::base_id_mask) != difference.came.id)
      return violates("OD-1005-06");
    if (evidence.stopped()) return violates("SYNC-PRO-06");
    const bool off = (evidence.wrote(0x1005, 0).value_or(0) & canopen::cob_id::bit30) == 0;
    if (off || evidence.wrote(0x1006, 0).value_or(1) == 0) return violates("SYNC-PRO-03");
    // The period is the one that it has from power-on, with the model none.
    if (!evidence.wrote(0x1006, 0)) return violates("OD-1006-02");
  }
  const bool stored = evidence.some([](const Action& each) {
    return each.kind == Action::Kind::download && each.object.index == Index(0x1010);
  });
  if (difference.what == What::missing && stored && last_reset(evidence).found)
    return violates("SYNC-PRO-07");
  if (difference.what == What::missing && produces_sync(evidence) && !evidence.commanded()) {
    const auto periods = std::ranges::count_if(evidence.conversation, [](const Action& each) {
      return each.kind == Action::Kind::download && each.is_at(0x1006, 0) && load_le(each.data) != 0;
    });
    if (periods > 1) return violates("OD-1006-05");
    const auto& trace = evidence.played.trace;
    const bool one_came = std::ranges::any_of(
        trace, [&](const can::CapturedFrame& each) { return each.frame.id == difference.due.id; });
    if (!trace.empty() && !one_came) return violates("SYNC-PRO-02");
  }
  if (evidence.operational()) return violates("NMT-SVC-01");
  return violates("SYNC-PRO-01");
}

std::optional<Assigned> assign_time(const Evidence& evidence) {
  if (evidence.difference().what == What::surplus) {
    if (evidence.stopped()) return violates("TIME-PRO-02");
    const auto cob_id = evidence.wrote(0x1012, 0).value_or(0);
    if ((cob_id & canopen::cob_id::bit30) == 0) return violates("TIME-PRO-03");
  }
  return violates("TIME-PRO-01");
}

std::optional<Assigned> assign_sdo_frame(const Evidence& evidence) {
  const auto& difference = evidence.difference();
  if (difference.what != What::surplus) return std::nullopt;
  if (evidence.stopped()) return in_its_state(evidence, "SDO-GEN-15");
  const auto is_abort = [](const can::Frame& frame) { return frame.dlc == 8 && frame.data[0] == 0x80; };
  for (const auto& each : evidence.conversation) {
    if (each.kind == Action::Kind::request && each.frame.data[0] >> 5U == 4) return violates("SDO-ERR-03");
    if (!each.fault.starts_with("abort")) continue;
    return violates(rule_of_fault(each));
  }
  if (is_abort(difference.came) && difference.came.data[7] == 0x05 && difference.came.data[6] == 0x04)
    return strains("SDO-SUP-18");
  return violates(is_abort(difference.came) ? "SDO-ERR-10" : "SDO-GEN-04");
}

}  // namespace

std::optional<Assigned> assign_frame(const Evidence& evidence) {
  const auto& frame = frame_of(evidence);
  const auto node = evidence.words.node.value();
  const auto set = canopen::connection_set(evidence.words.node);
  const bool surplus = evidence.difference().what == What::surplus;
  if (frame.is_data(canopen::lss_response_can_id)) return assign_lss_answer(evidence);
  if (talks_of_lss(evidence) && !frame.extended) return assign_beside_lss(evidence);
  if (talks_of_channels(evidence) && !frame.extended) {
    if (auto channel = assign_channel_frame(evidence)) return channel;
  }
  if (frame.extended) return surplus ? violates("CAN-TRF-03") : std::nullopt;
  if (frame.id == set.error_control.value()) return assign_error_control(evidence);
  if (frame.remote && surplus && frame.id > 0x700 && frame.id < 0x780) return violates("NMT-SVC-05");
  if (frame.remote) return surplus ? strains("CAN-TRF-04") : std::nullopt;
  if (frame.id == set.emcy.value()) return assign_emcy(evidence);
  if (frame.id == set.sdo_response.value()) return assign_sdo_frame(evidence);
  if (frame.id == canopen::sync_can_id.value()) return assign_sync(evidence);
  if (frame.id == canopen::time_can_id.value()) return assign_time(evidence);
  for (std::uint16_t number = 0; number < 4; ++number) {
    if (frame.id == set.tpdo[number].value()) return assign_tpdo(evidence, number);
    const auto moved = evidence.wrote(static_cast<std::uint16_t>(0x1800 + number), 1);
    if (!moved || (*moved & canopen::cob_id::base_id_mask) != frame.id) continue;
    if (evidence.difference().what == What::other_data) return assign_tpdo(evidence, number);
    return violates(surplus && (*moved & canopen::cob_id::bit31) != 0 ? "OD-1800-09" : "OD-1800-11");
  }
  const auto is_moved_to = [&](std::uint16_t index) {
    const auto moved = evidence.wrote(index, 0);
    return moved && (*moved & canopen::cob_id::base_id_mask) == frame.id;
  };
  if (is_moved_to(0x1014))
    return evidence.difference().what == What::other_data ? assign_emcy(evidence) : violates("OD-1014-07");
  if (is_moved_to(0x1005))
    return evidence.difference().what == What::missing ? violates("OD-1005-06") : assign_sync(evidence);
  if (is_moved_to(0x1012))
    return evidence.difference().what == What::missing ? violates("OD-1012-06") : assign_time(evidence);
  if (!surplus) return std::nullopt;
  if (frame.id == 0) return violates("NMT-SVC-05");
  if (frame.id >= 0x701 && frame.id <= 0x77F && frame.id != 0x700U + node)
    return violates(evidence.some([](const Action& each) { return each.frame.remote; }) ? "EC-NG-06"
                                                                                        : "EC-HBP-08");
  return violates("CAN-TRF-02");
}

}  // namespace conform::explore
