// SPDX-License-Identifier: Apache-2.0
#include "explore/assign.hpp"

#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <string>

namespace conform::explore {
namespace {

using Kind = Answer::Kind;

/// The number that a phrase has at its end, or the one behind `word`.
std::optional<unsigned> number_behind(std::string_view phrase, std::string_view word) {
  const auto at = phrase.find(word);
  if (at == std::string_view::npos) return std::nullopt;
  const auto text = phrase.substr(at + word.size());
  unsigned out = 0;
  return std::from_chars(text.data(), text.data() + text.size(), out).ec == std::errc{} ? std::optional(out)
                                                                                        : std::nullopt;
}

struct FaultRule {
  std::string_view phrase;       ///< how it begins
  std::string_view rule, first;  ///< `first`: where it is about segment 1 (or 0: before the first one)
};

constexpr FaultRule of_uploads[] = {
    {"wrong toggle", "SDO-SUP-06", "SDO-SUP-05"},
    {"repeat segment", "SDO-SUP-06", ""},
    {"lose segment", "SDO-SUP-06", ""},
    {"abort", "SDO-SUP-10", ""},
    {"new initiate", "SDO-SUP-11", ""},
    {"reserved", "SDO-SUP-14", ""},
    {"short", "SDO-ERR-08", ""},
    {"silence", "SDO-SUP-18", ""},
};
constexpr FaultRule of_downloads[] = {
    {"wrong toggle", "SDO-SDN-05", "SDO-SDN-04"},
    {"repeat segment", "SDO-SDN-05", ""},
    {"lose segment", "SDO-SDN-08", "SDO-SDN-04"},
    {"abort", "SDO-SDN-19", ""},
    {"new initiate", "SDO-SDN-17", ""},
    {"unused bytes", "SDO-SDN-27", ""},
    {"reserved bits in initiate", "SDO-DNL-18", ""},
    {"no end", "SDO-SDN-10", ""},
    {"silence", "SDO-SDN-25", ""},
    {"short", "SDO-ERR-06", ""},
};
constexpr FaultRule of_block_uploads[] = {
    {"lose segment", "SDO-BUP-13", "SDO-BUP-14"},
    {"abort after segment 0", "SDO-BUP-18", ""},
    {"abort", "SDO-BUP-17", ""},
    {"new initiate", "SDO-BUP-29", ""},
    {"no end", "SDO-BUP-24", ""},
    {"silence", "SDO-BUP-25", ""},
    {"reserved", "SDO-BUP-28", ""},
};
constexpr FaultRule of_block_downloads[] = {
    {"lose segment", "SDO-BDN-07", "SDO-BDN-08"},
    {"repeat segment", "SDO-BDN-09", ""},
    {"swap segments", "SDO-BDN-07", ""},
    {"wrong crc", "SDO-BDN-03", ""},
    {"unused bytes", "SDO-BDN-17", ""},
    {"abort instead", "SDO-BDN-20", ""},
    {"abort", "SDO-BDN-19", ""},
    {"new initiate", "SDO-BDN-21", ""},
    {"no end", "SDO-BDN-25", ""},
    {"silence", "SDO-BDN-25", ""},
    {"reserved", "SDO-BDN-27", ""},
};

std::span<const FaultRule> faults_of(const Action& action) {
  const bool block = action.transfer == Transfer::block || action.transfer == Transfer::block_unsized;
  if (action.kind == Action::Kind::upload)
    return block ? std::span<const FaultRule>(of_block_uploads) : of_uploads;
  return block ? std::span<const FaultRule>(of_block_downloads) : of_downloads;
}

}  // namespace

std::string rule_of_fault(const Action& action) {
  const std::string_view fault = action.fault;
  if (fault.empty()) return "";
  if (const auto ackseq = number_behind(fault, "acknowledge "))
    return *ackseq == 0 ? "SDO-BUP-14" : *ackseq > action.blksize ? "SDO-BUP-12" : "SDO-BUP-13";
  if (const auto blksize = number_behind(fault, "blksize "))
    return *blksize == 0 || *blksize > 127 ? "SDO-BUP-11" : "SDO-BUP-08";
  if (const auto sequence = number_behind(fault, " as ")) return *sequence == 0 ? "SDO-BDN-10" : "SDO-BDN-11";
  for (const auto& row : faults_of(action)) {
    if (!fault.starts_with(row.phrase)) continue;
    const bool first = !row.first.empty() && number_behind(fault, "segment ") == 1U;
    return std::string(first ? row.first : row.rule);
  }
  return "";
}

std::string id_of(std::string_view area, int number) { return fmt::format("{}-{:02}", area, number); }

Evidence::Commands Evidence::commands() const {
  Commands out;
  for (const auto& each : conversation) {
    const auto command = each.kind == Action::Kind::power ? std::uint8_t{0x80} : each.nmt_command(words.node);
    if (command != 1 && command != 2 && command < 0x80) continue;
    if (command > 0x82) continue;
    out.before = out.last;
    // Behind a reset the device is pre-operational.
    out.last = command > 0x80 ? std::uint8_t{0x80} : command;
  }
  return out;
}

bool Evidence::settled() const {
  using namespace std::chrono_literals;
  Duration since{};
  bool in_time = true;
  std::optional<std::size_t> reset;
  for (std::size_t i = 0; i < before().size(); ++i) {
    const auto& each = before()[i];
    const auto command = each.nmt_command(words.node);
    if (each.kind == Action::Kind::power || command > 0x80) {
      reset = i;
    } else if (command != 0) {
      in_time = !reset || was_up_between(*reset, i);
    }
    if (command != 0) since = {};
    if (each.kind == Action::Kind::wait) since += each.time;
  }
  return in_time && since >= 150ms;
}

bool Evidence::was_up_between(std::size_t reset, std::size_t command) const {
  using namespace std::chrono_literals;
  if (command < played.begins.size()) {
    const auto boots = [&](const can::CapturedFrame& each) {
      return each.frame.is_data(canopen::connection_set(words.node).error_control) && each.frame.dlc == 1 &&
             each.frame.data[0] == 0 && each.time > played.begins[reset] &&
             each.time < played.begins[command];
    };
    return std::ranges::any_of(played.trace, boots);
  }
  Duration since{};
  for (auto i = reset; i < command; ++i) {
    if (conversation[i].kind == Action::Kind::wait) since += conversation[i].time;
  }
  return since >= 1s;
}

bool Evidence::may_be_late() const {
  bool stopped = false;
  for (std::size_t i = 0; i < difference().action && i < played.answers.size(); ++i) {
    const auto& each = conversation[i];
    const auto command = each.nmt_command(words.node);
    if (command != 0 || each.kind == Action::Kind::power) stopped = command == 2;
    const bool asks = each.is_transfer() || each.kind == Action::Kind::request;
    if (!stopped && asks && played.answers[i].kind == Answer::Kind::silence) return true;
  }
  return false;
}

bool Evidence::floods() const {
  constexpr std::uint64_t few_frames = 1000;  // us
  return some([&](const Action& each) {
    const auto period = load_le(each.data);
    return each.kind == Action::Kind::download && each.is_at(0x1006, 0) && period != 0 && period < few_frames;
  });
}

bool Evidence::commanded() const {
  return some([&](const Action& each) {
    return each.kind == Action::Kind::power || each.nmt_command(words.node) != 0;
  });
}

std::optional<std::uint64_t> Evidence::wrote(std::uint16_t index, std::uint8_t sub) const {
  for (auto i = conversation.size(); i-- > 0;) {
    const auto& each = conversation[i];
    if (each.kind == Action::Kind::download && each.is_at(index, sub)) return load_le(each.data);
  }
  return std::nullopt;
}

std::optional<Assigned> assign_fault(const Evidence& evidence) {
  auto rule = rule_of_fault(evidence.last());
  if (rule.empty()) return std::nullopt;
  const auto device = evidence.difference().device.kind;
  const auto model = evidence.difference().model.kind;
  // A server may be stricter than the model or word its refusal in another way; what it must not do is to go
  // on as if nothing had been wrong, or to deliver something else.
  const bool goes_on = device == Kind::confirmed && model == Kind::aborted;
  const bool other_data = device == Kind::confirmed && model == Kind::confirmed;
  // Fewer bytes than were announced.
  if (goes_on && rule == "SDO-SDN-27" && evidence.difference().model.code == canopen::abort::length_too_low)
    rule = "SDO-SDN-08";
  return goes_on || other_data ? violates(std::move(rule)) : strains(std::move(rule));
}

namespace {

std::optional<Assigned> assign_plainly(const Evidence& evidence) {
  const auto& difference = evidence.difference();
  if (auto behind = assign_behind_a_loss(evidence)) return behind;
  switch (difference.what) {
    case Difference::What::rule:
      // The monitors know the device by the node-ID that it had.
      // A CAN-ID of an additional SDO server may have been given to another service, too.
      // An answer that is late is one to an earlier request.
      return gives_node_id(evidence) || is_on_channel(evidence) ||
                     (difference.requirement == "SDO-GEN-15" && evidence.may_be_late())
                 ? strains(difference.requirement)
                 : violates(difference.requirement);
    case Difference::What::broken: return std::nullopt;
    case Difference::What::gone: return violates("NMT-BOOT-02");
    case Difference::What::late: return strains("SDO-GEN-18");
    case Difference::What::answer:
      if (talks_of_lss(evidence)) return assign_beside_lss(evidence);
      if (talks_of_channels(evidence)) return assign_beside_channel(evidence);
      break;
    default: return assign_frame(evidence);
  }
  const auto& last = evidence.last();
  if (last.kind == Action::Kind::request) return assign_request(evidence);
  if (!last.is_transfer()) return std::nullopt;
  // The model is silent only where nothing is served, whatever it is: in Stopped, into which an error may
  // have taken it, and before the boot-up message.
  if (difference.model.kind == Kind::silence) {
    // The answer to an earlier request, of a server that takes longer than the client has waited.
    if (difference.device.kind == Kind::violation) return strains("SDO-GEN-18");
    const bool reset = evidence.some([&](const Action& each) {
      return each.kind == Action::Kind::power || each.nmt_command(evidence.words.node) > 0x80;
    });
    // How long a device boots is its choice, and long behind that a model is silent only because it is slow.
    if (reset && !evidence.stopped()) return strains("SDO-GEN-16");
    // Nobody has stopped it, nor told it that an error does: the model is silent because it is slow.
    const bool may_stop = evidence.some([](const Action& each) {
      return each.kind == Action::Kind::download && each.object.index == Index(0x1029);
    });
    if (evidence.may_be_late() || (!evidence.stopped() && !may_stop)) return strains("SDO-GEN-18");
    return in_its_state(evidence, "SDO-GEN-15");
  }
  return last.fault.empty() ? assign_answer(evidence) : assign_fault(evidence);
}

}  // namespace

std::optional<Assigned> assign(const Evidence& evidence) {
  auto out = assign_plainly(evidence);
  // Where the device fills the bus, everything else on it is late.
  if (out && evidence.floods() && out->grade == Grade::violated) out->grade = Grade::tolerated;
  return out;
}

}  // namespace conform::explore
