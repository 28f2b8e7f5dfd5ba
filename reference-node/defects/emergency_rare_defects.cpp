// SPDX-License-Identifier: Apache-2.0
// EMCY, error register, history and error behaviour: faults that show the second time, behind something else
// or beside it.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "defects/cob_ids.hpp"
#include "defects/emergencies.hpp"
#include "defects/heartbeats.hpp"
#include "defects/hooks.hpp"
#include "defects/receivers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr std::uint32_t not_valid = 0x8000'0000;

std::uint32_t can_id_of(std::uint64_t cob_id) { return static_cast<std::uint32_t>(cob_id & 0x7FFU); }
bool is_off(const Parts& parts) { return (parts.device.dictionary.number(0x1014, 0) & not_valid) != 0; }
bool is_end(const Frame& frame) { return frame.data[0] == 0 && frame.data[1] == 0; }
/// A message waits for the inhibit time.
bool waits(const Parts& parts) { return parts.emergency.next_wakeup().has_value(); }

bool is_present(const Parts& parts, const ErrorCause& cause) {
  const auto& active = parts.emergency.active();
  return std::ranges::find(active, cause) != active.end();
}
bool has_error_of(const Parts& parts, ErrorSource source) {
  return std::ranges::count(parts.emergency.active(), source, &ErrorCause::source) != 0;
}

using Causes = std::vector<ErrorCause>;
using Former = std::function<void()>;

/// `act(parts, former, cause)` in place of what an error, and its end, lead to.
template <typename Act>
void on_raise(Parts& parts, Act act) {
  parts.device.errors.raise.replace(
      [&parts, act](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
        act(parts, [&] { former(cause, detail); }, cause);
      });
}
template <typename Act>
void on_clear(Parts& parts, Act act) {
  parts.device.errors.clear.replace([&parts, act](const auto& former, const ErrorCause& cause) {
    act(parts, [&] { former(cause); }, cause);
  });
}

/// The errors that have ended since the boot-up message.
std::shared_ptr<Causes> ended_errors(Parts& parts) {
  auto ended = since_boot_up<Causes>(parts);
  on_clear(parts, [ended](Parts& node, const Former& former, const ErrorCause& cause) {
    if (is_present(node, cause)) ended->push_back(cause);
    former();
  });
  return ended;
}
bool holds(const Causes& causes, const ErrorCause& cause) {
  return std::ranges::find(causes, cause) != causes.end();
}

/// New errors for which `when` holds are recorded, and not told. `ended`: those that have been there before.
Change untold(bool (*when)(const Parts&, const ErrorCause&, const Causes& ended)) {
  return [when](Parts& parts) {
    const auto quiet = std::make_shared<bool>(false);
    parts.emergency.cob_id_rules.valid.replace(
        [quiet](const auto& former, std::uint32_t value) { return !*quiet && former(value); });
    const auto ended = ended_errors(parts);
    on_raise(parts, [quiet, when, ended](Parts& node, const Former& former, const ErrorCause& cause) {
      *quiet = !is_present(node, cause) && when(node, cause, *ended);
      former();
      *quiet = false;
    });
  };
}

/// What waits for the inhibit time is dropped where this is called.
std::function<void()> dropper(Parts& parts) {
  const auto dropping = std::make_shared<bool>(false);
  parts.emergency.rules.kept_waiting.replace(
      [dropping](const auto& former, WhileWaiting occasion) { return !*dropping && former(occasion); });
  return [&parts, dropping] {
    *dropping = true;
    parts.emergency.on_state_change();
    *dropping = false;
  };
}

/// A write of `value` (nothing: of the present one) that is granted drops what waits.
Change write_drops_what_waits(std::uint16_t index, std::optional<std::uint64_t> value) {
  return [index, value](Parts& parts) {
    checking(index, 0,
             [drop = dropper(parts), index, value](Parts& node, const Check& former, ByteView bytes) {
               const std::uint64_t such = value.value_or(node.device.dictionary.number(index, 0));
               const Accepted taken = former(bytes);
               if (taken && conform::load_le(bytes) == such) drop();
               return taken;
             })(parts);
  };
}

/// An error that another service has found does not wait for the inhibit time.
void inhibits_application_only(Parts& parts) {
  const auto drop = dropper(parts);
  on_raise(parts, [drop](Parts& node, const Former& former, const ErrorCause& cause) {
    const bool waited = waits(node);
    former();
    if (waited || !waits(node) || cause.source == ErrorSource::application) return;
    drop();
    const conform::CanId id(can_id_of(node.device.dictionary.number(0x1014, 0)));
    Bytes data = conform::to_le(cause.code, 8);
    data[2] = node.emergency.error_register();
    node.device.send(Service::emergency, conform::can::data_frame(id, data));
  });
}

/// Frames of the service for which `when` holds are not sent.
Change drops(Service service, std::function<bool(Parts&, const Frame&)> when) {
  return [service, when = std::move(when)](Parts& parts) {
    parts.device.outbox.add_filter(
        [&parts, service, when](const FilterContext& context, std::vector<Outgoing>& frames) {
          if (context.service != service) return;
          std::erase_if(frames, [&](const Outgoing& each) { return when(parts, each.frame); });
        });
  };
}

/// No EMCY is sent in this state, where the node has come to it from that one.
Change silent_in(NmtState state, NmtState from) {
  return [=](Parts& parts) {
    const auto before = since_boot_up<NmtState>(parts);
    parts.nmt.on_change = [before, former = parts.nmt.on_change](NmtState left) {
      *before = left;
      former(left);
    };
    drops(Service::emergency,
          [=](Parts& node, const Frame&) { return node.device.state == state && *before == from; })(parts);
  };
}

/// In the LSS configuration state that switch state global has led to no EMCY is sent.
Change silent_in_configuration() {
  return [](Parts& parts) {
    const auto inside = since_boot_up<bool>(parts);
    deaf_to([inside](Parts&, const Frame& frame) {
      if (frame.id == 0x7E5 && !frame.extended && !frame.remote && frame.data[0] == 0x04)
        *inside = frame.data[1] == 1;
      return false;
    })(parts);
    drops(Service::emergency, [inside](Parts&, const Frame&) { return *inside; })(parts);
  };
}

void told_again_when_made_valid(Parts& parts) {
  const auto last = since_boot_up<Frame>(parts);
  parts.device.outbox.add_filter([last](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::emergency && !frames.empty()) *last = frames.back().frame;
  });
  checking(0x1014, 0, [last](Parts& node, const Check& former, ByteView bytes) {
    const bool off = is_off(node);
    const Accepted taken = former(bytes);
    last->id = can_id_of(conform::load_le(bytes));
    const bool on = taken && off && (conform::load_le(bytes) & not_valid) == 0;
    if (on && !node.emergency.active().empty()) node.device.send(Service::emergency, *last);
    return taken;
  })(parts);
}

void second_move_without_effect(Parts& parts) {
  const auto moved = since_boot_up<std::optional<std::uint32_t>>(parts);
  parts.emergency.cob_id_rules.can_id.replace(
      [moved](const auto& former, std::uint32_t value, std::uint32_t at_power_on) {
        const std::uint32_t id = former(value, at_power_on);
        if (id == can_id_of(at_power_on)) return id;
        if (!*moved) *moved = id;
        return **moved;
      });
}

void can_id_outlives_reset_communication(Parts& parts) {
  const auto last = std::make_shared<std::optional<std::uint32_t>>();
  parts.nmt.on_reset = [last, former = parts.nmt.on_reset](Reset kind) {
    if (kind == Reset::node) last->reset();
    former(kind);
  };
  const auto written = written_since_boot_up(parts, {0x1014});
  parts.emergency.cob_id_rules.can_id.replace(
      [last, written](const auto& former, std::uint32_t value, std::uint32_t at_power_on) {
        if (written->empty()) return last->value_or(former(value, at_power_on));
        *last = former(value, at_power_on);
        return **last;
      });
}

/// Another value of 1001h than what EMCYs tell: `shown(parts, former)`.
Change shows(std::function<std::uint8_t(Parts&, std::uint8_t)> shown) {
  return reading(0x1001, 0, [shown = std::move(shown)](Parts& node, const Read& former) {
    Upload bits = former();
    if (bits) bits->front() = shown(node, bits->front());
    return bits;
  });
}

std::uint8_t bits_of(const Parts& parts, const ErrorCause& cause) {
  return parts.emergency.rules.register_bits(cause.code);
}

/// The number of errors that are there is counted in two bits.
std::uint8_t empty_with_four_errors(const Parts& parts, std::uint8_t bits) {
  return parts.emergency.active().size() % 4 == 0 ? std::uint8_t{0} : bits;
}

void keeps_what_ends_while_off(Parts& parts) {
  const auto kept = since_boot_up<std::uint8_t>(parts);
  on_clear(parts, [kept](Parts& node, const Former& former, const ErrorCause& cause) {
    if (is_present(node, cause)) *kept = is_off(node) ? *kept | bits_of(node, cause) : 0;
    former();
  });
  shows([kept](Parts&, std::uint8_t bits) { return static_cast<std::uint8_t>(bits | *kept); })(parts);
}

/// The bits for errors of this source stay over reset communication.
Change outlives_reset_communication(ErrorSource source) {
  return [source](Parts& parts) {
    const auto kept = std::make_shared<std::uint8_t>(std::uint8_t{0});
    parts.nmt.on_reset = [&parts, source, kept, former = parts.nmt.on_reset](Reset kind) {
      if (kind == Reset::node) *kept = 0;
      for (const ErrorCause& cause : parts.emergency.active()) {
        if (kind == Reset::communication && cause.source == source) *kept |= bits_of(parts, cause);
      }
      former(kind);
    };
    shows([kept](Parts&, std::uint8_t bits) { return static_cast<std::uint8_t>(bits | *kept); })(parts);
  };
}

/// An EMCY of another node that 1028h names.
bool is_consumed(const Parts& parts, const Frame& frame) {
  if (frame.extended || frame.remote || frame.size() != 8 || !parts.device.works_now(Service::emergency))
    return false;
  for (std::uint8_t sub = 1; sub <= EmergencyConsumer::producers; ++sub) {
    if (parts.device.dictionary.number(0x1028, sub, not_valid) == frame.id) return true;
  }
  return false;
}

void end_of_another_clears_register(Parts& parts) {
  const auto hidden = since_boot_up<bool>(parts);
  deaf_to([hidden](Parts& node, const Frame& frame) {
    if (is_consumed(node, frame) && is_end(frame)) *hidden = true;
    return false;
  })(parts);
  on_raise(parts, [hidden](Parts&, const Former& former, const ErrorCause&) {
    *hidden = false;
    former();
  });
  shows([hidden](Parts&, std::uint8_t bits) { return *hidden ? std::uint8_t{0} : bits; })(parts);
}

using Fields = std::vector<std::uint32_t>;

Fields fields_of(const ErrorHistory& history) {
  Fields fields;
  for (std::uint8_t sub = 1; sub <= history.recorded(); ++sub)
    fields.push_back(static_cast<std::uint32_t>(conform::load_le(*history.read(sub))));
  return fields;
}
void put(ErrorHistory& history, const Fields& newest_first) {
  history.clear();
  for (auto field = newest_first.rbegin(); field != newest_first.rend(); ++field)
    history.record(static_cast<std::uint16_t>(*field), static_cast<ErrorSource>(*field >> 24U),
                   static_cast<std::uint8_t>(*field >> 16U));
}
constexpr std::size_t depth = ErrorHistory::fields;

/// What the history holds behind an error: `kept` of what was there before and of the new field.
using Kept = std::function<Fields(const Parts&, const ErrorCause&, Fields before, std::uint32_t added)>;
Change records(Kept kept) {
  return [kept = std::move(kept)](Parts& parts) {
    on_raise(parts, [kept](Parts& node, const Former& former, const ErrorCause& cause) {
      const bool added = !is_present(node, cause);
      const Fields before = fields_of(node.emergency.history);
      former();
      const Fields now = fields_of(node.emergency.history);
      if (added && !now.empty()) put(node.emergency.history, kept(node, cause, before, now.front()));
    });
  };
}
Fields pushed(Fields before, std::uint32_t added) {
  before.insert(before.begin(), added);
  return before;
}
Fields shifted_until_full(const Parts&, const ErrorCause&, Fields before, std::uint32_t added) {
  if (before.size() < depth) return pushed(std::move(before), added);
  before.front() = added;
  return before;
}
Fields without_lost_nodes(const Parts&, const ErrorCause& cause, Fields before, std::uint32_t added) {
  return cause.source == ErrorSource::heartbeat ? before : pushed(std::move(before), added);
}
Fields without_those_that_wait(const Parts& parts, const ErrorCause&, Fields before, std::uint32_t added) {
  return waits(parts) ? before : pushed(std::move(before), added);
}

void full_history_comes_back(Parts& parts) {
  const auto hidden = since_boot_up<Fields>(parts);
  checking(0x1003, 0, [hidden](Parts& node, const Check& former, ByteView bytes) {
    const Fields before = fields_of(node.emergency.history);
    const Accepted cleared = former(bytes);
    if (cleared && before.size() == depth) *hidden = before;
    return cleared;
  })(parts);
  records([hidden](const Parts&, const ErrorCause&, Fields before, std::uint32_t added) {
    const Fields back = std::exchange(*hidden, {});
    before.insert(before.end(), back.begin(), back.end());
    return pushed(std::move(before), added);
  })(parts);
}

enum class By : std::uint8_t { segments, blocks };

/// Such a download to `index` is confirmed without a look at it where `when` holds.
Change confirms_by(By which, std::uint16_t index, bool (*when)(std::uint64_t wanted)) {
  return [=](Parts& parts) {
    const auto such = std::make_shared<bool>(false);
    deaf_to([such, which](Parts& node, const Frame& frame) {
      if (frame.id != 0x600U + node.device.node_id || frame.extended || frame.remote) return false;
      const unsigned command = frame.data[0] >> 5U;
      if (command == 1) *such = which == By::segments && (frame.data[0] & 2U) == 0;
      if (command == 6 && (frame.data[0] & 1U) == 0) *such = which == By::blocks;
      return false;
    })(parts);
    const auto confirmed = [such, when](Parts&, const Check& former, ByteView bytes) {
      return *such && when(conform::load_le(bytes)) ? Accepted{} : former(bytes);
    };
    checking(index, 0, confirmed)(parts);
    checking_all(index, [confirmed](Parts& node, const Check& former, std::uint8_t, ByteView bytes) {
      return confirmed(node, former, bytes);
    })(parts);
  };
}

// 1029h, and what errors do to other services.

ErrorBehaviourRules& of_behaviour(Parts& parts) { return parts.error_behaviour.rules; }

Change reacts(std::uint64_t class_value, NmtState present, NmtState wrong) {
  return decides(of_behaviour, &ErrorBehaviourRules::next_state,
                 [=](const auto& former, std::uint64_t value, NmtState state) {
                   return value == class_value && state == present ? wrong : former(value, state);
                 });
}
/// A communication error changes no state where this holds.
Change no_reaction(bool (*when)(const Parts&)) {
  return [when](Parts& parts) {
    parts.error_behaviour.rules.next_state.replace(
        [&parts, when](const auto& former, std::uint64_t value, NmtState state) {
          return when(parts) ? state : former(value, state);
        });
  };
}

bool is_of_last_node(const Parts& parts) {
  const auto& active = parts.emergency.active();
  return !active.empty() && active.back().source == ErrorSource::heartbeat &&
         active.back().instance == consumer_entries(parts);
}

/// The service pauses where this holds.
Change pauses(Service service, std::function<bool(const Parts&)> when) {
  return [service, when = std::move(when)](Parts& parts) {
    parts.device.works.replace([&parts, service, when](const auto& former, Service which, NmtState state) {
      return (which != service || !when(parts)) && former(which, state);
    });
  };
}
bool has_application_error(const Parts& parts) { return has_error_of(parts, ErrorSource::application); }
bool misses_a_node(const Parts& parts) { return has_error_of(parts, ErrorSource::heartbeat); }

/// Where an error has ended Operational the service is dead until a command to enter Pre-operational or a
/// reset.
Change dead_behind_error(Service service) {
  return [service](Parts& parts) {
    const auto dead = since_boot_up<bool>(parts);
    parts.error_behaviour.enter = [&parts, dead, former = parts.error_behaviour.enter](NmtState state) {
      *dead = *dead || state != parts.device.state;
      former(state);
    };
    deaf_to([dead](Parts& node, const Frame& frame) {
      if (is_nmt_command(frame) && is_for(node, frame) && frame.data[0] == 0x80) *dead = false;
      return false;
    })(parts);
    pauses(service, [dead](const Parts&) { return *dead; })(parts);
  };
}

/// A lost node that is back ends the errors of the application, too.
void return_of_a_node_ends_all(Parts& parts) {
  on_clear(parts, [](Parts& node, const Former& former, const ErrorCause& cause) {
    const bool back = cause.source == ErrorSource::heartbeat && is_present(node, cause);
    former();
    for (const ErrorCause& other : Causes(node.emergency.active())) {
      if (back && other.source == ErrorSource::application) node.device.errors.clear(other);
    }
  });
}

}  // namespace

DefectTable emergency_rare_defects() {
  return {
      {"1014-second-move-without-effect",
       "The second CAN-ID that 1014h is given behind a boot-up is not used",
       {"OD-1014-07"},
       second_move_without_effect},
      {"1014-in-use-outlives-reset-communication",
       "Behind reset communication EMCY is sent with the CAN-ID that was written before",
       {"OD-1014-10", "NMT-FSA-29"},
       can_id_outlives_reset_communication},
      {"emcy-dropped-by-the-same-1014",
       "What waits for the inhibit time of EMCY is dropped where 1014h gets the value that it has",
       {"EMCY-INH-01"},
       write_drops_what_waits(0x1014, std::nullopt)},
      {"emcy-dropped-by-cleared-history",
       "What waits for the inhibit time of EMCY is dropped where the history is cleared",
       {"EMCY-INH-01"},
       write_drops_what_waits(0x1003, 0)},
      {"emcy-of-services-not-inhibited",
       "The inhibit time of 1015h is for the errors of the application alone",
       {"EMCY-INH-01"},
       inhibits_application_only},
      {"1015-low-byte-0-is-none",
       "There is no inhibit time of EMCY where the lower byte of 1015h is 0",
       {"EMCY-INH-01"},
       decides(
           of_emergency_rules, &EmergencyRules::inhibit_time,
           [](const auto& former, std::int64_t value) { return former((value & 0xFF) == 0 ? 0 : value); })},
      {"1015-not-in-operational",
       "In Operational there is no inhibit time of EMCY",
       {"EMCY-INH-01"},
       Change([](Parts& parts) {
         parts.emergency.rules.inhibit_time.replace([&parts](const auto& former, std::int64_t value) {
           return former(parts.device.state == NmtState::operational ? 0 : value);
         });
       })},
      {"emcy-untold-again-while-inhibited",
       "An error that is back while a message waits for the inhibit time is not told",
       {"EMCY-INH-01"},
       untold([](const Parts& parts, const ErrorCause& cause, const Causes& ended) {
         return waits(parts) && holds(ended, cause);
       })},
      {"emcy-of-sync-once",
       "The second time that a SYNC has a wrong length is not told",
       {"SYNC-CON-05"},
       untold([](const Parts&, const ErrorCause& cause, const Causes& ended) {
         return cause.source == ErrorSource::sync && holds(ended, cause);
       })},
      {"emcy-silent-in-operational-behind-stopped",
       "No EMCY is sent in Operational that was entered from Stopped",
       {"EMCY-SEQ-01", "NMT-FSA-22"},
       silent_in(NmtState::operational, NmtState::stopped)},
      {"emcy-silent-in-pre-operational-by-error",
       "In Pre-operational that an error has led to the next error is not told",
       {"EMCY-SEQ-01", "EMCY-NMT-02"},
       Change([](Parts& parts) {
         drops(Service::emergency, [led = led_by_error(parts)](Parts& node, const Frame&) {
           return *led && node.device.state == NmtState::pre_operational;
         })(parts);
       })},
      {"emcy-silent-in-lss-configuration",
       "In the LSS configuration state no EMCY is sent",
       {"EMCY-SEQ-01", "EMCY-NMT-02"},
       silent_in_configuration()},
      {"emcy-each-256th-missing", "Every 256th error is not told", {"EMCY-SEQ-01"}, Change([](Parts& parts) {
         drops(Service::emergency, [count = since_boot_up<std::uint8_t>(parts)](Parts&, const Frame& frame) {
           return !is_end(frame) && ++*count == 0;
         })(parts);
       })},
      {"emcy-again-with-valid-1014",
       "An error that is there is told once more where EMCY becomes valid",
       {"EMCY-SEQ-01"},
       told_again_when_made_valid},
      {"1001-empty-with-four-errors",
       "The errors that are there are counted in two bits: with four of them the error register is 00h",
       {"OD-1001-05", "EMCY-FMT-04"},
       shows(empty_with_four_errors)},
      {"1001-keeps-what-ends-while-1014-is-off",
       "The bits of an error that ends while 1014h is not valid stay in 1001h",
       {"OD-1001-06"},
       keeps_what_ends_while_off},
      {"1001-of-rpdos-outlives-reset",
       "The bits of 1001h for an RPDO that was too short stay over reset communication",
       {"OD-1001-06"},
       outlives_reset_communication(ErrorSource::rpdo)},
      {"1001-of-sync-outlives-reset",
       "The bits of 1001h for a SYNC of the wrong length stay over reset communication",
       {"OD-1001-06"},
       outlives_reset_communication(ErrorSource::sync)},
      {"1001-cleared-by-the-end-of-another",
       "EMCY 0000h of a node that 1028h names clears 1001h",
       {"OD-1001-05"},
       end_of_another_clears_register},
      {"1003-not-shifted-when-full",
       "A new error overwrites the newest one where the history is full",
       {"OD-1003-12"},
       records(shifted_until_full)},
      {"1003-without-lost-nodes",
       "Nodes that are lost are told and not recorded",
       {"OD-1003-10", "OD-1003-11"},
       records(without_lost_nodes)},
      {"1003-without-errors-that-wait",
       "An error whose EMCY waits for the inhibit time is not recorded",
       {"OD-1003-10"},
       records(without_those_that_wait)},
      {"1003-full-one-comes-back",
       "What was cleared of a full history is back with the next error",
       {"OD-1003-05"},
       full_history_comes_back},
      {"1003-clear-ignored-in-operational",
       "In Operational 00h in 1003h:00 is confirmed and clears nothing",
       {"OD-1003-05"},
       checking(0x1003, 0,
                [](Parts& parts, const Check& former, ByteView bytes) {
                  return parts.device.state == NmtState::operational && conform::load_le(bytes) == 0
                             ? Accepted{}
                             : former(bytes);
                })},
      {"1003-clear-by-segments-ignored",
       "00h that a segmented download brings to 1003h:00 is confirmed and clears nothing",
       {"OD-1003-05"},
       confirms_by(By::segments, 0x1003, [](std::uint64_t wanted) { return wanted == 0; })},
      {"1003-any-count-by-blocks",
       "A block download brings any value to 1003h:00",
       {"OD-1003-06"},
       confirms_by(By::blocks, 0x1003, [](std::uint64_t wanted) { return wanted != 0; })},
      {"1028-by-segments-not-looked-at",
       "A segmented download brings any value for the CAN-IDs of EMCY consumers",
       {"OD-1028-06", "CAN-RID-03"},
       confirms_by(By::segments, 0x1028, [](std::uint64_t) { return true; })},
      {"1029-1-leaves-stopped",
       "With 1029h:01 = 01h a communication error takes the node from Stopped to Pre-operational",
       {"EC-EB-02"},
       reacts(1, NmtState::stopped, NmtState::pre_operational)},
      {"1029-not-by-the-last-node",
       "The loss of the node in the last entry of 1016h does not change the NMT state",
       {"EC-EB-01", "EC-HBC-08"},
       no_reaction(is_of_last_node)},
      {"1029-not-beside-an-application-error",
       "While the application has an error a communication error does not change the NMT state",
       {"EC-EB-01"},
       no_reaction(has_application_error)},
      {"1029-not-while-emcy-is-off",
       "While 1014h is not valid a communication error does not change the NMT state",
       {"EC-EB-01"},
       no_reaction(is_off)},
      {"1029-not-while-emcy-waits",
       "A communication error whose EMCY waits for the inhibit time does not change the NMT state",
       {"EC-EB-01"},
       no_reaction(waits)},
      {"errors-end-with-a-node-that-is-back",
       "A lost node that is back ends the errors of the application, too",
       {"OD-1001-05"},
       return_of_a_node_ends_all},
      {"tpdos-pause-with-application-errors",
       "While the application has an error no TPDO is sent",
       {"PDO-TX-08", "NMT-FSA-22"},
       pauses(Service::tpdo, has_application_error)},
      {"tpdos-pause-while-a-node-is-lost",
       "While a monitored node is missing no TPDO is sent, whatever 1029h:01 says",
       {"EC-EB-02", "NMT-FSA-22"},
       pauses(Service::tpdo, misses_a_node)},
      {"sync-pauses-with-application-errors",
       "While the application has an error no SYNC is produced",
       {"SYNC-PRO-01"},
       drops(Service::sync, [](Parts& parts, const Frame&) { return has_application_error(parts); })},
      {"tpdos-dead-behind-error",
       "Where an error has ended Operational NMT start brings no TPDOs back",
       {"PDO-TX-26", "NMT-FSA-22"},
       dead_behind_error(Service::tpdo)},
      {"rpdos-dead-behind-error",
       "Where an error has ended Operational NMT start brings no RPDOs back",
       {"PDO-RX-01", "NMT-FSA-22"},
       dead_behind_error(Service::rpdo)},
  };
}

}  // namespace refnode
