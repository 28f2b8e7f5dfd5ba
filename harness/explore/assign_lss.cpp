// SPDX-License-Identifier: Apache-2.0
// What came of layer setting services: their answers, and the node-ID that they give.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "canopen/cob_id.hpp"
#include "canopen/lss.hpp"
#include "explore/assign.hpp"

namespace conform::explore {
namespace {

using What = Difference::What;
using canopen::LssCommand;

constexpr std::uint8_t start_of_scan = canopen::LssFastscan::begin;

bool is_lss(const Action& action) {
  return action.kind == Action::Kind::frame && action.frame.id == canopen::lss_request_can_id.value();
}
bool is_plain(const Action& action) {
  return is_lss(action) && !action.frame.remote && !action.frame.extended && action.frame.dlc == 8;
}
std::uint8_t command_of(const Action& action) { return action.frame.data[0]; }
bool is(const Action& action, LssCommand command) {
  return is_plain(action) && command_of(action) == static_cast<std::uint8_t>(command);
}
bool is_from(const Action& action, LssCommand first, LssCommand last) {
  return is_plain(action) && command_of(action) >= static_cast<std::uint8_t>(first) &&
         command_of(action) <= static_cast<std::uint8_t>(last);
}
std::uint32_t number_of(const can::Frame& frame) {
  return static_cast<std::uint32_t>(load_le(ByteView(frame.data).subspan(1, 4)));
}

std::uint32_t own_part(const Vocabulary& words, std::size_t part) {
  const auto* entry = words.find({Index(0x1018), SubIndex(static_cast<std::uint8_t>(part + 1))});
  return entry != nullptr && entry->default_value ? static_cast<std::uint32_t>(load_le(*entry->default_value))
                                                  : 0;
}

/// What is wrong with the parts that were named since the last frame of another service.
std::string rule_of_selection(const Vocabulary& words, std::span<const std::uint8_t> parts,
                              std::span<const std::uint32_t> numbers) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (numbers[i] != own_part(words, parts[i])) return "LSS-SS-02";
  }
  constexpr std::array<std::uint8_t, 4> all = {0, 1, 2, 3};
  for (const auto part : all) {
    if (std::ranges::find(parts, part) == parts.end()) return "LSS-SS-03";
  }
  return std::ranges::equal(parts, all) ? "LSS-SS-01" : "LSS-SS-04";
}

/// What the slave has been told, up to the difference.
struct Course {
  bool configuration = false;
  bool configured = true;         ///< it has a node-ID
  std::string in = "LSS-INQ-06";  ///< the rule by which it is in its state
  std::string selection;          ///< what the last 43h says
  const Action* last = nullptr;   ///< LSS frame
  std::size_t identifications = 0, selections = 0;
  std::optional<std::uint8_t> node_id;  ///< of the last 11h
  bool taken = false;                   ///< it was told so in the configuration state
  bool left = false, stored = false;    ///< since then
  std::uint8_t reset = 0;               ///< since then: 81h, 82h, or FFh for power
  std::uint8_t expected = 0;            ///< part of a fastscan

  Course(const Evidence& evidence) : words_(evidence.words) {
    for (const auto& each : evidence.conversation.first(
             std::min(evidence.difference().action + 1, evidence.conversation.size())))
      take(each);
  }

 private:
  void take(const Action& action) {
    const auto command = action.nmt_command(words_.node);
    const bool to_all = action.kind == Action::Kind::frame && action.frame.is_data(CanId(0)) &&
                        action.frame.dlc == 2 && action.frame.data[1] == 0;
    const auto restarts = action.kind == Action::Kind::power      ? std::uint8_t{0xFF}
                          : command > 0x80                        ? command
                          : to_all && action.frame.data[0] > 0x80 ? action.frame.data[0]
                                                                  : std::uint8_t{0};
    if (restarts != 0) return restart(restarts);
    if (!is_lss(action)) return;
    last = &action;
    if (!is_plain(action)) {
      in = "LSS-GEN-03";
      return;
    }
    obey(action);
  }

  void restart(std::uint8_t by) {
    configuration = false;
    in = "LSS-GEN-05";
    parts_.clear();
    numbers_.clear();
    expected = 0;
    if (!node_id) return;
    reset = by;
    if (by == 0x82 || stored) configured = *node_id != canopen::lss_no_node_id;
    if (by != 0x82 && !stored) configured = true;
  }

  void obey(const Action& action) {
    const auto& bytes = action.frame.data;
    if (is_from(action, LssCommand::select_vendor, LssCommand::select_serial)) return select(action);
    parts_.clear();
    numbers_.clear();
    if (is(action, LssCommand::switch_global)) return switch_global(bytes[1]);
    if (is(action, LssCommand::configure_node_id)) {
      node_id = bytes[1];
      taken = configuration;
      left = stored = false;
      reset = 0;
    } else if (is(action, LssCommand::store)) {
      stored = stored || configuration;
    } else if (is(action, LssCommand::fastscan)) {
      scan(action);
    } else if (is_from(action, LssCommand::identify_vendor, LssCommand::identify_serial_high)) {
      identifications += is(action, LssCommand::identify_vendor);
    } else if (canopen::lss_command_name(bytes[0]).empty()) {
      in = "LSS-GEN-02";
    }
  }

  void switch_global(std::uint8_t mode) {
    if (mode > 1) {
      in = "LSS-SG-03";
      return;
    }
    left = left || (configuration && mode == 0);
    configuration = mode == 1;
    in = mode == 1 ? "LSS-SG-01" : "LSS-SG-02";
    expected = 0;
  }

  void select(const Action& action) {
    if (configuration) return;
    parts_.push_back(static_cast<std::uint8_t>(command_of(action) - 0x40U));
    numbers_.push_back(number_of(action.frame));
    // A sequence may have been begun before.
    if (parts_.size() > 4 && parts_[parts_.size() - 4] == 0) {
      parts_.erase(parts_.begin(), parts_.end() - 4);
      numbers_.erase(numbers_.begin(), numbers_.end() - 4);
    }
    if (!is(action, LssCommand::select_serial)) return;
    ++selections;
    in = selection = rule_of_selection(words_, parts_, numbers_);
    configuration = selection == "LSS-SS-01";
  }

  void scan(const Action& action) {
    if (configuration) return;
    const auto& bytes = action.frame.data;
    if (!configured) {
      in = "LSS-FS-03";
      if (bytes[5] == start_of_scan) {
        expected = 0;
      } else if (bytes[5] == 0 && bytes[6] == expected && expected < 4 &&
                 number_of(action.frame) == own_part(words_, expected)) {
        configuration = expected == 3 && bytes[7] < 3;
        expected = bytes[7];
      }
    } else {
      in = "LSS-FS-01";
    }
  }

  const Vocabulary& words_;
  std::vector<std::uint8_t> parts_;
  std::vector<std::uint32_t> numbers_;
};

std::string rule_of_inquiry(std::uint8_t command) {
  return id_of("LSS-INQ", command - static_cast<int>(LssCommand::inquire_vendor) + 1);
}

/// How many bytes of an answer tell something.
std::size_t meaning_of(std::uint8_t specifier) {
  switch (static_cast<LssCommand>(specifier)) {
    case LssCommand::configure_node_id:
    case LssCommand::configure_bit_timing:
    case LssCommand::store: return 3;
    case LssCommand::inquire_node_id: return 2;
    case LssCommand::inquire_vendor:
    case LssCommand::inquire_product:
    case LssCommand::inquire_revision:
    case LssCommand::inquire_serial: return 5;
    default: return 1;
  }
}

/// 11h and 13h: taken or refused where it should be the other way.
std::optional<Assigned> other_result(const Evidence& evidence, const Course& course) {
  const auto& came = evidence.difference().came;
  const auto specifier = static_cast<LssCommand>(came.data[0]);
  const bool of_the_maker = came.data[1] == 0xFF;
  if (specifier == LssCommand::store) return violates("LSS-ST-01");
  const bool refused = came.data[1] != 0;
  if (specifier == LssCommand::configure_node_id) {
    const auto node = course.node_id.value_or(1);
    if (node == canopen::lss_no_node_id) return strains("LSS-CN-03");
    const auto* rule = node >= 1 && node <= 127 ? "LSS-CN-01" : "LSS-CN-02";
    return of_the_maker ? strains(rule) : violates(rule);
  }
  const auto* rule = refused ? "LSS-BT-01" : "LSS-BT-02";
  return of_the_maker ? strains(rule) : violates(rule);
}

std::optional<Assigned> other_answer(const Evidence& evidence, const Course& course) {
  const auto& came = evidence.difference().came;
  const auto& due = evidence.difference().due;
  if (came.dlc != 8) return violates("LSS-GEN-01");
  const auto specifier = due.data[0];
  if (came.data[0] != specifier) return violates("LSS-GEN-08");
  const auto meaning = meaning_of(specifier);
  if (std::equal(came.data.begin(), came.data.begin() + static_cast<std::ptrdiff_t>(meaning),
                 due.data.begin()))
    return violates("LSS-GEN-01");
  if (meaning == 3) return other_result(evidence, course);
  return violates(rule_of_inquiry(specifier));
}

std::optional<Assigned> missing_answer(const Evidence& evidence, const Course& course) {
  const auto& due = evidence.difference().due;
  if (evidence.stopped() || evidence.operational()) return violates("LSS-GEN-04");
  switch (static_cast<LssCommand>(due.data[0])) {
    case LssCommand::selected: return violates("LSS-SS-01");
    case LssCommand::non_configured: return violates("LSS-ID-04");
    case LssCommand::identified:
      if (course.last != nullptr && is(*course.last, LssCommand::fastscan))
        return violates(course.last->frame.data[5] == start_of_scan ? "LSS-FS-02" : "LSS-FS-03");
      return violates(course.identifications > 1 ? "LSS-ID-02" : "LSS-ID-01");
    case LssCommand::inquire_node_id: return violates(course.in);
    // It may be in the other state.
    case LssCommand::configure_node_id: return strains("LSS-CN-01");
    case LssCommand::configure_bit_timing: return strains("LSS-BT-01");
    case LssCommand::store: return strains("LSS-ST-01");
    default: return strains(rule_of_inquiry(due.data[0]));
  }
}

std::optional<Assigned> surplus_scan(const Course& course) {
  if (course.configured) return violates("LSS-FS-01");
  const auto& bytes = course.last->frame.data;
  const bool known = bytes[5] == start_of_scan || bytes[5] < 32;
  return violates(known && bytes[6] == course.expected ? "LSS-FS-03" : "LSS-FS-04");
}

std::optional<Assigned> surplus_answer(const Evidence& evidence, const Course& course) {
  if (course.last == nullptr || !is_lss(evidence.last())) return violates("LSS-GEN-08");
  if (!is_plain(*course.last)) return violates("LSS-GEN-03");
  const auto& last = *course.last;
  if (evidence.operational()) return violates("LSS-GEN-08");
  if (is(last, LssCommand::switch_global)) {
    const auto mode = last.frame.data[1];
    return violates(mode == 0 ? "LSS-SG-02" : mode == 1 ? "LSS-SG-01" : "LSS-SG-03");
  }
  if (is(last, LssCommand::select_serial))
    return course.selection == "LSS-SS-04" ? strains("LSS-SS-04") : violates(course.selection);
  if (is_from(last, LssCommand::select_vendor, LssCommand::select_revision)) return violates("LSS-SS-01");
  if (is(last, LssCommand::identify_serial_high))
    return violates(course.identifications == 0 ? "LSS-GEN-08" : "LSS-ID-02");
  if (is_from(last, LssCommand::identify_vendor, LssCommand::identify_serial_low))
    return violates("LSS-ID-01");
  if (is(last, LssCommand::identify_non_configured)) return violates("LSS-ID-03");
  if (is(last, LssCommand::fastscan)) return surplus_scan(course);
  if (canopen::lss_command_name(command_of(last)).empty()) return violates("LSS-GEN-02");
  if (course.configuration) return violates("LSS-GEN-08");
  // It is in the configuration state, and should not be.
  return course.in == "LSS-SS-04" || course.in == "LSS-GEN-05" ? strains(course.in) : violates(course.in);
}

/// A COB-ID that was read goes with the node-ID that the device had, and should go with the new one.
bool keeps_old_id(const Evidence& evidence, std::uint8_t node) {
  const auto& came = evidence.difference().came;
  const auto& due = evidence.difference().due;
  const auto low = [](const can::Frame& frame) { return frame.data[4] & 0x7FU; };
  return came.dlc == 8 && due.dlc == 8 && low(came) == evidence.words.node.value() && low(due) == node;
}

/// What it says, or should say, with the node-ID that it was to have from the reset on; but not its boot-up
/// message, which is what shows that it has it.
bool is_at_new_id(const Evidence& evidence, const Course& course) {
  const auto& frame = frame_of(evidence);
  const auto node = *course.node_id;
  const bool active = course.taken && (course.reset == 0x82 || (course.reset != 0 && course.stored));
  const bool boot_up = frame.id > 0x700 && frame.id < 0x780 && frame.dlc == 1 && frame.data[0] == 0;
  return active && !boot_up && node >= 1 && node <= 127 && frame.id > 0x080 && (frame.id & 0x7FU) == node;
}

/// The node-ID that the device should have, or should not.
std::optional<Assigned> other_node_id(const Evidence& evidence, const Course& course) {
  const auto what = evidence.difference().what;
  const auto node = *course.node_id;
  if (is_at_new_id(evidence, course)) {
    // It has started there: what it does is as wrong with the node-ID that it had.
    if (what == What::surplus) return std::nullopt;
    if (what == What::other_data && !keeps_old_id(evidence, node)) return std::nullopt;
    const auto* rule = course.reset == 0x82 ? "LSS-CN-04" : "LSS-ST-02";
    return what == What::missing ? strains(rule) : violates(rule);
  }
  if (!course.taken) return violates("LSS-INQ-06");
  if (node == 0 || (node > 127 && node != canopen::lss_no_node_id)) return violates("LSS-CN-02");
  if (course.reset == 0) return what == What::missing ? violates("LSS-CN-06") : strains("LSS-CN-04");
  if (course.reset != 0x82) return violates(course.stored ? "LSS-ST-02" : "LSS-CN-05");
  return violates(node == canopen::lss_no_node_id ? "LSS-ID-04" : "LSS-CN-04");
}

/// A frame that is no request is what shows it.
bool is_odd(const Evidence& evidence) {
  return evidence.some([](const Action& each) { return is_lss(each) && !is_plain(each); });
}

}  // namespace

bool talks_of_lss(const Evidence& evidence) { return evidence.some(is_lss); }

bool gives_node_id(const Evidence& evidence) {
  return evidence.some([](const Action& each) { return is(each, LssCommand::configure_node_id); });
}

std::optional<Assigned> assign_lss_answer(const Evidence& evidence) {
  if (is_odd(evidence)) return violates("LSS-GEN-03");
  const Course course(evidence);
  switch (evidence.difference().what) {
    case What::other_data: return other_answer(evidence, course);
    case What::missing: return missing_answer(evidence, course);
    default: return surplus_answer(evidence, course);
  }
}

std::optional<Assigned> assign_beside_lss(const Evidence& evidence) {
  if (is_odd(evidence)) return violates("LSS-GEN-03");
  const auto& difference = evidence.difference();
  // Another value of a COB-ID goes with the node-ID; what has another form does not.
  const bool answers =
      difference.what == What::other_data && difference.came.id >= 0x580 && difference.came.id < 0x600;
  if (answers && (difference.came.dlc != 8 || difference.came.data[0] != difference.due.data[0]))
    return assign_single_upload(evidence, difference.came.bytes(), difference.due.bytes());
  const Course course(evidence);
  return course.node_id ? other_node_id(evidence, course) : violates("LSS-GEN-04");
}

}  // namespace conform::explore
