// SPDX-License-Identifier: Apache-2.0
// Emergencies that came without being due, or did not come.
#include <algorithm>
#include <string>

#include "canopen/cob_id.hpp"
#include "explore/assign.hpp"

namespace conform::explore {

using What = Difference::What;

namespace {

/// The device has said the same before, and that no error is left has not come since.
bool is_repeated(const Evidence& evidence) {
  const auto& came = evidence.difference().came;
  bool out = false;
  for (const auto& each : evidence.played.trace) {
    if (each.time >= evidence.difference().time) break;
    if (each.frame.id != came.id || each.frame.remote) continue;
    out = each.frame == came || (out && emcy_code(each.frame) != 0);
  }
  return out;
}

/// Somebody has sent an RPDO, on whatever CAN-ID of those that PDOs have by default.
bool receives_pdo(const Evidence& evidence) {
  return evidence.some([](const Action& each) {
    return each.kind == Action::Kind::frame && !each.frame.remote && each.frame.id >= 0x180 &&
           each.frame.id < 0x580;
  });
}

bool guarding_runs(const Evidence& evidence) {
  return evidence.wrote(0x100C, 0).has_value() || evidence.wrote(0x100D, 0).has_value();
}

/// Some RPDO has to come in time.
bool has_deadline(const Evidence& evidence) {
  for (std::uint16_t index = 0x1400; index < 0x1404; ++index) {
    if (evidence.wrote(index, 5).value_or(0) != 0) return true;
  }
  return false;
}

/// A node that is monitored is lost, and nothing is said of it.
std::optional<Assigned> missing_loss(const Evidence& evidence) {
  std::size_t entries = 0;
  for (std::uint8_t sub = 1; sub <= 4; ++sub) entries += evidence.wrote(0x1016, sub).has_value();
  // Not the first one, alone, is as much one of several.
  return violates(entries > 1 || !evidence.wrote(0x1016, 1) ? "EC-HBC-13" : "EC-HBC-03");
}

/// A node is said to be lost that is there, or was not heard since it is monitored.
std::optional<Assigned> surplus_loss(const Evidence& evidence) {
  const Action* beat = nullptr;
  for (const auto& each : evidence.conversation) {
    const bool begins = each.kind == Action::Kind::power || each.nmt_command(evidence.words.node) > 0x80 ||
                        (each.kind == Action::Kind::download && each.object.index == Index(0x1016));
    if (begins) beat = nullptr;
    const bool beats = each.kind == Action::Kind::frame && !each.frame.remote && !each.frame.extended &&
                       each.frame.id > 0x700 && each.frame.id <= 0x77F;
    if (beats) beat = &each;
  }
  if (beat == nullptr) return violates("EC-HBC-02");
  return beat->frame.data[0] == 0 ? strains("EC-HBC-12") : violates("EC-HBC-04");
}

/// Another node has said the same.
bool is_passed_on(const Evidence& evidence, const can::Frame& came) {
  return evidence.some([&](const Action& each) {
    return each.kind == Action::Kind::frame && !each.frame.remote && each.frame.id > 0x080 &&
           each.frame.id < 0x100 && came.dlc == 8 && each.frame.dlc == 8 && each.frame.data == came.data;
  });
}

}  // namespace

unsigned emcy_code(const can::Frame& emcy) {
  return emcy.size() < 2 ? 0U : static_cast<unsigned>(emcy.data[0] | (emcy.data[1] << 8U));
}

const can::Frame& frame_of(const Evidence& evidence) {
  const auto& difference = evidence.difference();
  return difference.what == What::missing ? difference.due : difference.came;
}

bool guards(const Action& action, const Evidence& evidence) {
  return action.kind == Action::Kind::frame && action.frame.remote && !action.frame.extended &&
         action.frame.id == 0x700U + evidence.words.node.value();
}

std::optional<Assigned> assign_emcy(const Evidence& evidence) {
  const auto& difference = evidence.difference();
  const auto& about = frame_of(evidence);
  const auto code = emcy_code(about);
  if (difference.what != What::missing && is_passed_on(evidence, difference.came))
    return violates("EMCY-CON-02");
  if (difference.what == What::other_data) {
    if (difference.came.dlc != 8) return violates("EMCY-FMT-01");
    // The bytes of the code in the other order, whatever it says.
    if (difference.came.data[0] == difference.due.data[1] &&
        difference.came.data[1] == difference.due.data[0] &&
        difference.came.data[0] != difference.came.data[1])
      return violates("EMCY-FMT-01");
    if (difference.came.data[0] != difference.due.data[0] ||
        difference.came.data[1] != difference.due.data[1]) {
      const auto due = static_cast<unsigned>(difference.due.data[0] | (difference.due.data[1] << 8U));
      if (due == 0x8250 || emcy_code(difference.came) == 0x8250) return violates("PDO-RX-14");
      return due == 0x8130   ? violates("EC-HBC-03")
             : due == 0x8210 ? violates("PDO-RX-06")
             : due == 0x8240 ? violates("SYNC-CON-05")
                             : violates("EMCY-FMT-01");
    }
    if (((difference.came.data[2] & ~difference.due.data[2]) & 0x40U) != 0) return violates("OD-1001-03");
    // Which bits of the error register a device has is its choice, but for the first.
    if (difference.came.data[2] != difference.due.data[2])
      return difference.came.data[2] != 0 && (difference.came.data[2] & 1U) == 0 ? strains("EMCY-FMT-04")
             : ((difference.came.data[2] ^ difference.due.data[2]) & 1U) != 0    ? violates("EMCY-FMT-03")
                                                                                 : strains("EMCY-FMT-03");
    return std::nullopt;
  }
  const bool missing = difference.what == What::missing;
  const bool off = (evidence.wrote(0x1014, 0).value_or(0) & canopen::cob_id::bit31) != 0;
  if (!missing && off) return violates("OD-1014-08");
  if (!missing && evidence.stopped()) return violates("EMCY-NMT-01");
  if (evidence.wrote(0x1015, 0).value_or(0) != 0) return violates("EMCY-INH-01");
  const bool asked = evidence.some([&](const Action& each) {
    return each.kind == Action::Kind::frame && each.frame.remote && each.frame.id == about.id;
  });
  if (!missing && asked) return violates("EMCY-COB-06");
  if (!missing && code != 0 && is_repeated(evidence)) return violates("EMCY-SEQ-01");
  if (!missing && code == 0 && evidence.last().is_at(0x1003, 0)) return violates("OD-1003-16");
  // SYNC that fails to come is the only error that the period of SYNC makes.
  if (code == 0x8100 && evidence.wrote(0x1006, 0).value_or(0) != 0) return violates("SYNC-CON-10");
  if (evidence.wrote(0x1014, 0)) return violates(missing ? "OD-1014-07" : "OD-1014-08");
  if (code == 0x8130) {
    if (!guarding_runs(evidence)) return missing ? missing_loss(evidence) : surplus_loss(evidence);
    if (missing) {
      // Said once, and not a second time: it has not noticed that the master was there again.
      const bool again = std::ranges::any_of(evidence.played.trace, [&](const can::CapturedFrame& each) {
        return each.frame.id == about.id && emcy_code(each.frame) == 0x8130;
      });
      return violates(again ? "EC-NG-10" : "EC-NG-07");
    }
    if (evidence.wrote(0x100C, 0).value_or(0) == 0 || evidence.wrote(0x100D, 0).value_or(0) == 0)
      return violates("EC-NG-09");
    const bool requested = evidence.some([&](const Action& each) { return guards(each, evidence); });
    return violates(requested ? "EC-NG-07" : "EC-NG-08");
  }
  if (code == 0x8210) return missing ? violates("PDO-RX-06") : strains("PDO-RX-06");
  // Behind an RPDO that is too long it may be sent or not.
  if (code == 0x8220) return receives_pdo(evidence) ? passes("PDO-RX-07") : strains("PDO-RX-07");
  if (code == 0x8240 && missing && evidence.wrote(0x1005, 0)) return violates("OD-1005-07");
  if (code == 0x8240) return violates(missing ? "SYNC-CON-05" : "SYNC-CON-03");
  if (code == 0x8250) return violates(missing || has_deadline(evidence) ? "PDO-RX-14" : "PDO-RX-15");
  if (code == 0) {
    if (evidence.wrote(0x1016, 1) || evidence.wrote(0x1016, 2)) return violates("EC-HBC-07");
    if (guarding_runs(evidence)) return violates("EC-NG-10");
    if (evidence.wrote(0x1006, 0).value_or(0) != 0) return violates("SYNC-CON-10");
    if (has_deadline(evidence)) return violates("PDO-RX-14");
    return violates("EMCY-SEQ-02");
  }
  const auto raises = std::ranges::count_if(
      evidence.conversation, [](const Action& each) { return each.kind == Action::Kind::download; });
  if (!missing) return violates(raises == 0 ? "EMCY-SEQ-03" : "EMCY-SEQ-01");
  if (raises > 1) return violates("EMCY-SEQ-04");
  return evidence.operational() ? violates("EMCY-SEQ-01") : violates("EMCY-NMT-02");
}

}  // namespace conform::explore
