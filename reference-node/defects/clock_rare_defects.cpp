// SPDX-License-Identifier: Apache-2.0
// SYNC, TIME, heartbeat consumers and what runs by a clock: faults that show the second time, behind
// something else or beside it.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "defects/cob_ids.hpp"
#include "defects/heartbeats.hpp"
#include "defects/pdos.hpp"
#include "defects/receivers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

void before_reset(Parts& parts, std::function<void(Reset)> act) {
  parts.nmt.on_reset = [act = std::move(act), former = parts.nmt.on_reset](Reset reset) {
    act(reset);
    former(reset);
  };
}

/// `act` follows every SYNC, received or sent.
void behind_sync(Parts& parts, const std::function<void()>& act) {
  for (auto* hook : {&parts.sync.on_sync, &parts.sync_producer.on_sync}) {
    *hook = [act, former = *hook](std::optional<std::uint8_t> counter) {
      former(counter);
      act();
    };
  }
}

/// Frames of a service are not sent while `when` holds.
void silences(Parts& parts, Service service, std::function<bool()> when) {
  parts.device.outbox.add_filter(
      [service, when = std::move(when)](const FilterContext& context, std::vector<Outgoing>& frames) {
        if (context.service == service && when()) frames.clear();
      });
}

// SYNC that is produced

void counts_on_over_reset_communication(Parts& parts) {
  struct Count {
    std::uint8_t last = 0;
    bool reset = false;
    bool goes_on = false;
  };
  const auto count = std::make_shared<Count>();
  before_reset(parts, [count](Reset reset) {
    count->reset = reset == Reset::communication;
    count->goes_on = false;
  });
  auto& rules = parts.sync_producer.rules;
  rules.counts_anew.replace([count](const auto& former, SyncStart start) {
    count->goes_on = std::exchange(count->reset, false) && start == SyncStart::boot_up;
    return former(start);
  });
  rules.next_count.replace([count](const auto& former, std::uint8_t last, std::uint8_t overflow) {
    count->last = former(std::exchange(count->goes_on, false) ? count->last : last, overflow);
    return count->last;
  });
}

void ends_with_bit_31(Parts& parts) {
  const auto ended = since_boot_up<bool>(parts);
  checking(0x1005, 0, [ended](Parts& node, const Check& former, ByteView bytes) {
    const std::uint64_t present = node.device.dictionary.number(0x1005, 0), wanted = conform::load_le(bytes);
    const Accepted taken = former(bytes);
    if (taken && (wanted & bit_30) == 0) *ended = false;
    if (taken && (present & wanted & bit_30) != 0 && ((present ^ wanted) & bit_31) != 0) *ended = true;
    return taken;
  })(parts);
  silences(parts, Service::sync, [ended] { return *ended; });
}

void produces_with_the_written_period(Parts& parts) {
  const auto last = std::make_shared<std::int64_t>(0);
  const auto written = written_since_boot_up(parts, {0x1006});
  after_writing(0x1006, 0, [last](Parts& node, const std::function<void()>& former) {
    *last = node.device.time_value(0x1006, 0);
    former();
  })(parts);
  parts.sync_producer.rules.period.replace([=](const auto& former, std::int64_t value) {
    return former(written->empty() && value != 0 && *last != 0 ? *last : value);
  });
}

/// A change of 1019h that is refused for the present period is taken where `when` holds.
Change takes_overflow_values(bool (*when)(const Parts&)) {
  return checking(0x1019, 0, [when](Parts& parts, const Check& former, ByteView bytes) {
    const Accepted taken = former(bytes);
    return !taken && taken.error() == abort_code::device_state && when(parts) ? Accepted{} : taken;
  });
}

// SYNC that is consumed

void needs_the_counter_from_then_on(Parts& parts) {
  const auto needed = since_boot_up<bool>(parts);
  after_writing(0x1019, 0, [needed](Parts& node, const std::function<void()>& former) {
    if (node.device.dictionary.number(0x1019, 0) > 1) *needed = true;
    former();
  })(parts);
  parts.sync.rules.length.replace([needed](const auto& former, std::uint64_t overflow) -> std::size_t {
    return *needed ? 1 : former(overflow);
  });
}

void tells_of_a_length_once(Parts& parts) {
  parts.device.errors.raise.replace(
      [told = since_boot_up<bool>(parts)](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
        if (cause.code != 0x8240 || !std::exchange(*told, true)) former(cause, detail);
      });
}

void sees_three_bits_of_a_length(Parts& parts) {
  parts.device.errors.raise.replace([](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
    if (cause.code != 0x8240 || detail != 8) former(cause, detail);
  });
}

// PDO

void begins_all_at_the_start_value_of_the_first(Parts& parts) {
  parts.pdos.tpdo.rules.counting_begins.replace(
      [&od = parts.device.dictionary](const auto& former, const PdoParameters& pdo,
                                      std::optional<std::uint8_t> counter) {
        const std::uint64_t first = od.number(0x1800, 6);
        return counter && first != 0 ? *counter == first : former(pdo, counter);
      });
}

/// The event timers of all TPDOs but this one begin anew.
void begin_timers_anew(Parts& parts, std::optional<std::uint16_t> but = std::nullopt) {
  ObjectDictionary& od = parts.device.dictionary;
  for (std::uint16_t number = 0; number <= last_pdo; ++number) {
    Entry* timer = od.entry(nth(0x1800, number), 5);
    const bool runs = timer != nullptr && timer->number() != 0 && od.number(nth(0x1800, number), 3) == 0 &&
                      is_event_driven(od.number(nth(0x1800, number), 2));
    if (runs && number != but) timer->written();
  }
}

void begins_timers_anew_with_another(Parts& parts) {
  const auto busy = std::make_shared<bool>(false);
  for (std::uint16_t number = 0; number <= last_pdo; ++number) {
    after_writing(nth(0x1800, number), 5, [=](Parts& node, const std::function<void()>& former) {
      former();
      if (std::exchange(*busy, true)) return;
      begin_timers_anew(node, number);
      *busy = false;
    })(parts);
  }
}

bool is_rpdo_of(Parts& parts, const Frame& frame) {
  return !frame.extended && !frame.remote && parts.device.state == NmtState::operational &&
         rpdo_with(parts.device.dictionary, frame.id).has_value();
}

void loses_the_timer_in_the_inhibit_time(Parts& parts) {
  const auto causes = since_state_change<std::map<std::uint16_t, TransmitCause>>(parts);
  auto& rules = parts.pdos.tpdo.rules;
  rules.held_back.replace([causes](const auto& former, const PdoParameters& pdo, TransmitCause cause) {
    const auto [present, first] = causes->emplace(pdo.number(), cause);
    if (cause == TransmitCause::change) present->second = cause;
    return former(pdo, cause);
  });
  rules.made_up_for.replace([causes](const auto& former, const PdoParameters& pdo) {
    const auto cause = causes->find(pdo.number());
    const bool by_timer = cause != causes->end() && cause->second == TransmitCause::timer;
    causes->erase(pdo.number());
    return !by_timer && former(pdo);
  });
}

void watches_from_the_next_start(Parts& parts) {
  const auto received = since_boot_up<std::set<std::uint16_t>>(parts);
  const auto changing = std::make_shared<bool>(false);
  ahead_of_state_change([changing](Parts&) { *changing = true; })(parts);
  deaf_to([changing](Parts&, const Frame&) { return *changing = false; })(parts);
  auto& rules = parts.pdos.rpdo.rules;
  rules.processed.replace(
      [received](const auto& former, const PdoParameters& pdo, std::size_t got, std::size_t mapped) {
        if (pdo.event_timer() > Duration::zero()) received->insert(pdo.number());
        return former(pdo, got, mapped);
      });
  rules.watched_from_start.replace([=](const auto& former, const PdoParameters& pdo) {
    return (*changing && received->contains(pdo.number())) || former(pdo);
  });
}

void releases_what_waits(Parts& parts) {
  const auto waiting = since_state_change<std::map<std::uint16_t, Frame>>(parts);
  const auto released = std::make_shared<bool>(false);
  behind_sync(parts, [waiting] { waiting->clear(); });
  parts.pdos.rpdo.rules.waits_for_sync.replace(
      [released](const auto& former, const PdoParameters& pdo) { return !*released && former(pdo); });
  deaf_to([=](Parts& node, const Frame& frame) {
    if (!is_rpdo_of(node, frame)) return false;
    const std::uint16_t number = rpdo_with(node.device.dictionary, frame.id).value_or(0);
    if (is_synchronous(node.device.dictionary.number(nth(0x1400, number), 2))) {
      (*waiting)[number] = frame;
      return false;
    }
    *released = true;
    for (const auto& [which, held] : std::exchange(*waiting, {})) node.pdos.on_frame(held);
    return *released = false;
  })(parts);
}

// Error control

/// Where an error has led to another NMT state these frames tell the one before.
Change tells_the_state_before_the_error(Service service) {
  return [service](Parts& parts) {
    const auto led = led_by_error(parts);
    const auto before = std::make_shared<NmtState>(NmtState::pre_operational);
    parts.error_behaviour.enter = [&parts, before, former = parts.error_behaviour.enter](NmtState state) {
      if (state != parts.device.state) *before = parts.device.state;
      former(state);
    };
    parts.device.outbox.add_filter([=](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service != service || !*led) return;
      for (Outgoing& each : frames) {
        const unsigned toggle = each.frame.data[0] & 0x80U;
        each.frame.data[0] = static_cast<std::uint8_t>(toggle | static_cast<unsigned>(*before));
      }
    });
  };
}

void pauses_in_a_block_transfer(Parts& parts) {
  const auto block = std::make_shared<bool>(false);
  parts.device.outbox.add_filter([block](const FilterContext& context, std::vector<Outgoing>&) {
    if (context.sdo != nullptr)
      *block = context.sdo->step >= SdoStep::block_upload_initiate && context.sdo->step < SdoStep::time_out;
  });
  silences(parts, Service::heartbeat, [&parts, block] { return *block && has_open_transfer(parts); });
}

/// `act(node, sub, refused)` follows a download to an object.
Change behind_download(std::uint16_t index, std::function<void(Parts&, std::uint8_t, bool)> act) {
  return [=](Parts& parts) {
    parts.device.outbox.add_filter(
        [&parts, index, act](const FilterContext& context, std::vector<Outgoing>&) {
          if (context.sdo != nullptr && context.sdo->index() == index &&
              context.sdo->step == SdoStep::download_initiate)
            act(parts, context.sdo->sub(), context.sdo->aborted.has_value());
        });
  };
}

/// A write of the object that is refused ends the service, until one is confirmed.
Change ended_by_a_refused_write(std::uint16_t index, Service service) {
  return [=](Parts& parts) {
    const auto ended = since_boot_up<bool>(parts);
    behind_download(index, [ended](Parts&, std::uint8_t, bool refused) { *ended = refused; })(parts);
    silences(parts, service, [ended] { return *ended; });
  };
}

/// What follows a write of the object follows one that is refused as well.
Change taken_for_written(std::uint16_t index) {
  return behind_download(index, [index](Parts& node, std::uint8_t sub, bool refused) {
    const Entry* entry = node.device.dictionary.entry(index, sub);
    if (refused && entry != nullptr && entry->written) entry->written();
  });
}

void loses_timers_by_refused_times(Parts& parts) {
  const auto lost = since_state_change<std::set<std::uint16_t>>(parts);
  for (std::uint16_t number = 0; number <= last_pdo; ++number) {
    behind_download(nth(0x1800, number), [lost, number](Parts&, std::uint8_t sub, bool refused) {
      if (sub == 5 && refused) lost->insert(number);
      if (sub == 5 && !refused) lost->erase(number);
    })(parts);
  }
  parts.pdos.tpdo.rules.has_event_timer.replace([lost](const auto& former, const PdoParameters& pdo) {
    return !lost->contains(pdo.number()) && former(pdo);
  });
}

/// The entries of 1016h whose node is lost.
std::shared_ptr<std::set<std::uint16_t>> lost_entries(Parts& parts) {
  const auto lost = since_boot_up<std::set<std::uint16_t>>(parts);
  parts.device.errors.raise.replace([lost](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
    if (cause.source == ErrorSource::heartbeat) lost->insert(cause.instance);
    former(cause, detail);
  });
  parts.device.errors.clear.replace([lost](const auto& former, const ErrorCause& cause) {
    if (cause.source == ErrorSource::heartbeat) lost->erase(cause.instance);
    former(cause);
  });
  return lost;
}

void is_silent_while_a_node_is_lost(Parts& parts) {
  silences(parts, Service::heartbeat, [lost = lost_entries(parts)] { return !lost->empty(); });
}

void takes_a_lost_node_twice(Parts& parts) {
  checking_all(0x1016, [lost = lost_entries(parts)](Parts& node, const Check& former, std::uint8_t sub,
                                                    ByteView bytes) {
    const Accepted taken = former(bytes);
    if (taken || taken.error() != abort_code::parameter_incompatible) return taken;
    const bool missing = std::ranges::any_of(*lost, [&](std::uint16_t entry) {
      return entry != sub &&
             node_at(node, static_cast<std::uint8_t>(entry)) == monitored_node(conform::load_le(bytes));
    });
    return missing ? Accepted{} : taken;
  })(parts);
}

void feeds_the_next_entry(Parts& parts, std::vector<Frame>& frames) {
  if (parts.device.state == NmtState::initialising) return;
  for (const Frame& frame : frames) {
    if (!is_heartbeat(frame)) continue;
    const std::uint8_t entries = consumer_entries(parts);
    for (std::uint8_t sub = 1; sub <= entries; ++sub) {
      if (node_at(parts, sub) != producer_of(frame)) continue;
      const auto next = static_cast<std::uint8_t>(sub % entries + 1);
      const auto node = node_at(parts, next);
      if (node && parts.consumer.due(next)) parts.consumer.on_heartbeat(*node, 0x05);
    }
  }
}

// TIME

bool is_time(const Parts& parts, const Frame& frame) {
  const std::uint64_t cob_id = parts.device.dictionary.number(0x1012, 0);
  return !frame.extended && !frame.remote && frame.size() == 6 && (cob_id & bit_31) != 0 &&
         frame.id == (cob_id & can_id_bits) && parts.device.works_now(Service::time);
}

void takes_no_time_behind_stopped(Parts& parts) {
  const auto deaf = since_boot_up<bool>(parts);
  parts.nmt.on_change = [deaf, former = parts.nmt.on_change](NmtState from) {
    if (from == NmtState::stopped) *deaf = true;
    former(from);
  };
  after_writing(0x1012, 0, [deaf](Parts&, const std::function<void()>& former) {
    *deaf = false;
    former();
  })(parts);
  deaf_to([deaf](Parts& node, const Frame& frame) { return *deaf && is_time(node, frame); })(parts);
}

void goes_on_with_bit_31(Parts& parts) {
  parts.time.cob_id_rules.produced.replace(
      [on = since_boot_up<bool>(parts)](const auto& former, std::uint32_t value) {
        return *on = former(value) || (*on && (value & bit_31) != 0);
      });
}

void consumes_on_in_operational(Parts& parts) {
  const auto on = since_state_change<bool>(parts);
  checking(0x1012, 0, [on](Parts& node, const Check& former, ByteView bytes) {
    const std::uint64_t present = node.device.dictionary.number(0x1012, 0);
    const Accepted taken = former(bytes);
    const bool cleared = (present & bit_31) != 0 && (conform::load_le(bytes) & bit_31) == 0;
    if (taken) *on = cleared && node.device.state == NmtState::operational;
    return taken;
  })(parts);
  parts.time.cob_id_rules.valid.replace(
      [on](const auto& former, std::uint32_t value) { return *on || former(value); });
}

}  // namespace

DefectTable clock_rare_defects() {
  return {
      {"sync-count-survives-reset-communication",
       "The counter of a stored SYNC producer goes on where it was behind reset communication",
       {"SYNC-PRO-05", "SYNC-PRO-07"},
       counts_on_over_reset_communication},
      {"sync-pauses-in-a-transfer",
       "While an SDO transfer is open no SYNC is produced",
       {"SYNC-PRO-01"},
       Change([](Parts& parts) {
         silences(parts, Service::sync, [&parts] { return has_open_transfer(parts); });
       })},
      {"sync-ended-by-bit-31",
       "Another bit 31 in 1005h ends the production of SYNC",
       {"OD-1005-09", "OD-1005-11"},
       ends_with_bit_31},
      {"sync-period-written-before-reset",
       "Behind a reset a stored SYNC producer has the period that was written last, not the stored one",
       {"SYNC-PRO-07", "NMT-FSA-24"},
       produces_with_the_written_period},
      {"sync-period-of-whole-ms",
       "Of a period of a millisecond or more in 1006h whole milliseconds count",
       {"SYNC-PRO-01", "OD-1006-05"},
       Change([](Parts& parts) {
         parts.sync_producer.rules.period.replace([](const auto& former, std::int64_t value) {
           return former(value < 1000 ? value : value / 1000 * 1000);
         });
       })},
      {"1019-not-locked-while-produced",
       "1019h can be changed while bit 30 of 1005h is set, whatever 1006h says",
       {"OD-1019-05"},
       takes_overflow_values(
           [](const Parts& parts) { return (parts.device.dictionary.number(0x1005, 0) & bit_30) != 0; })},
      {"1019-not-locked-in-operational",
       "1019h can be changed in Operational while 1006h is not 0",
       {"OD-1019-05"},
       takes_overflow_values([](const Parts& parts) { return parts.device.state == NmtState::operational; })},
      {"sync-counter-needed-behind-1019",
       "Once 1019h has asked for a counter a SYNC without one is an error until the reset",
       {"SYNC-CON-03"},
       needs_the_counter_from_then_on},
      {"sync-length-reported-once",
       "Of several SYNCs of the wrong length the first one is reported, until the reset",
       {"SYNC-CON-05"},
       tells_of_a_length_once},
      {"sync-of-eight-bytes-not-reported",
       "A SYNC of eight bytes causes no EMCY",
       {"SYNC-CON-05"},
       sees_three_bits_of_a_length},
      {"tpdo-sync-start-of-the-first",
       "Where the first TPDO has a SYNC start value all TPDOs that have one begin with it",
       {"PDO-TX-14"},
       begins_all_at_the_start_value_of_the_first},
      {"1800-sync-start-not-locked-in-operational",
       "The SYNC start value of a valid TPDO can be changed in Operational",
       {"OD-1800-21"},
       Change([](Parts& parts) {
         parts.pdos.tpdo.parameters.rules.locked.replace(
             [&device = parts.device](const auto& former, const PdoParameters& pdo, PdoPart part, bool valid,
                                      bool enabled) {
               const bool open = part == PdoPart::sync_start && device.state == NmtState::operational;
               return !open && former(pdo, part, valid, enabled);
             });
       })},
      {"tpdo-event-timers-anew-with-rpdo",
       "Every RPDO restarts the event timers",
       {"PDO-TX-09"},
       deaf_to([](Parts& parts, const Frame& frame) {
         if (is_rpdo_of(parts, frame)) begin_timers_anew(parts);
         return false;
       })},
      {"tpdo-event-timers-anew-with-another",
       "A write of the event timer of one TPDO restarts those of the others",
       {"PDO-TX-09"},
       begins_timers_anew_with_another},
      {"tpdo-event-time-of-the-one-before",
       "A TPDO behind one with an event timer has the time of that one",
       {"PDO-TX-09"},
       Change([](Parts& parts) {
         parts.pdos.tpdo.parameters.rules.event_timer.replace(
             [&od = parts.device.dictionary](const auto& former, const PdoParameters& pdo,
                                             std::int64_t value) {
               const std::uint64_t before = pdo.number() == 0 ? 0 : od.number(nth(0x17FF, pdo.number()), 5);
               return former(pdo, value != 0 && before != 0 ? static_cast<std::int64_t>(before) : value);
             });
       })},
      {"tpdo-event-timer-ends-in-inhibit-time",
       "An event timer that elapses in the inhibit time sends no TPDO then, nor runs on",
       {"PDO-TX-12", "PDO-TX-09"},
       loses_the_timer_in_the_inhibit_time},
      {"rpdo-deadline-from-next-start",
       "Once an RPDO came its deadline is watched from the next start of Operational on",
       {"PDO-RX-14"},
       watches_from_the_next_start},
      {"rpdo-sync-released-by-another",
       "An event-driven RPDO brings what waits for the SYNC of all others",
       {"PDO-RX-03"},
       releases_what_waits},
      {"heartbeat-state-before-an-error",
       "Where an error has led to another NMT state the heartbeat tells the one before",
       {"EC-HBP-06", "EC-EB-01"},
       tells_the_state_before_the_error(Service::heartbeat)},
      {"heartbeat-pauses-in-a-block-transfer",
       "While a block transfer is open there is no heartbeat",
       {"EC-HBP-09"},
       pauses_in_a_block_transfer},
      {"heartbeat-ended-by-a-refused-time",
       "A write of 1017h that is refused ends the heartbeat",
       {"EC-HBP-09", "EC-HBP-01"},
       ended_by_a_refused_write(0x1017, Service::heartbeat)},
      {"sync-ended-by-a-refused-period",
       "A write of 1006h that is refused ends the production of SYNC",
       {"SYNC-PRO-01"},
       ended_by_a_refused_write(0x1006, Service::sync)},
      {"1016-refused-write-ends-the-watch",
       "A write of 1016h that is refused ends the monitoring of that node until its next heartbeat",
       {"EC-HBC-13"},
       taken_for_written(0x1016)},
      {"life-guarding-ended-by-a-refused-write",
       "A write of 100Dh that is refused ends the life time that runs",
       {"EC-NG-07"},
       taken_for_written(0x100D)},
      {"tpdo-event-timer-ended-by-a-refused-time",
       "A write of the event timer of a TPDO that is refused ends it",
       {"PDO-TX-09"},
       loses_timers_by_refused_times},
      {"tpdo-event-timers-pause-in-a-transfer",
       "While an SDO transfer is open no event timer sends a TPDO",
       {"PDO-TX-09"},
       Change([](Parts& parts) {
         parts.pdos.tpdo.rules.has_event_timer.replace(
             [&parts](const auto& former, const PdoParameters& pdo) {
               return !has_open_transfer(parts) && former(pdo);
             });
       })},
      {"hbc-deaf-beside-a-transfer",
       "Heartbeats of other nodes that come while an SDO transfer is open do not count",
       {"EC-HBC-04"},
       deaf_to(
           [](Parts& parts, const Frame& frame) { return is_heartbeat(frame) && has_open_transfer(parts); })},
      {"heartbeat-silent-while-a-node-is-lost",
       "While a monitored node is lost there is no heartbeat",
       {"EC-HBP-01"},
       is_silent_while_a_node_is_lost},
      {"hbc-feeds-the-next-entry",
       "The heartbeat of a node keeps alive the one in the next entry of 1016h as well",
       {"EC-HBC-09", "EC-HBC-13"},
       Reading(feeds_the_next_entry)},
      {"1016-lost-node-duplicate-accepted",
       "Two entries of 1016h for the same node are accepted while that node is lost",
       {"OD-1016-06"},
       takes_a_lost_node_twice},
      {"1016-duplicate-accepted-in-operational",
       "Two entries of 1016h for the same node are accepted in Operational",
       {"OD-1016-06"},
       checking_all(0x1016,
                    [](Parts& parts, const Check& former, std::uint8_t, ByteView bytes) {
                      const Accepted taken = former(bytes);
                      const bool twice = !taken && taken.error() == abort_code::parameter_incompatible;
                      return twice && parts.device.state == NmtState::operational ? Accepted{} : taken;
                    })},
      {"guard-reply-state-before-an-error",
       "Where an error has led to another NMT state guard replies tell the one before",
       {"EC-NG-01", "OD-1029-10"},
       tells_the_state_before_the_error(Service::guarding)},
      {"time-not-consumed-behind-stopped",
       "Behind Stopped no TIME is consumed until 1012h is written",
       {"TIME-CON-01"},
       takes_no_time_behind_stopped},
      {"time-not-consumed-by-a-producer",
       "While TIME is produced none is consumed",
       {"TIME-CON-01"},
       deaf_to([](Parts& parts, const Frame& frame) {
         return is_time(parts, frame) && (parts.device.dictionary.number(0x1012, 0) & bit_30) != 0;
       })},
      {"time-stored-not-produced",
       "Behind a reset no TIME is produced until 1012h is written, whatever was stored",
       {"TIME-PRO-01", "OD-1010-10"},
       Change([](Parts& parts) {
         silences(parts, Service::time,
                  [written = written_since_boot_up(parts, {0x1012})] { return written->empty(); });
       })},
      {"time-not-stopped-with-bit-31",
       "Clearing bit 30 of 1012h does not stop the TIME producer while bit 31 is set",
       {"TIME-PRO-03"},
       goes_on_with_bit_31},
      {"time-consumed-on-in-operational",
       "TIME is consumed until the NMT state changes where bit 31 of 1012h is cleared in Operational",
       {"TIME-CON-04"},
       consumes_on_in_operational},
  };
}

}  // namespace refnode
