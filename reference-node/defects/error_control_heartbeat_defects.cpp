// SPDX-License-Identifier: Apache-2.0
// Defects of the heartbeat producer (1017h) and consumer (1016h).
#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "defects/heartbeats.hpp"
#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

ErrorBehaviourRules& of_error_behaviour(Parts& parts) { return parts.error_behaviour.rules; }

/// A time is that many per cent of what the rule says.
template <typename Rules>
Change lasts(int percent, Rules& (*part)(Parts&), Rule<Duration(std::int64_t)> Rules::* rule) {
  return decides(part, rule,
                 [percent](const auto& former, std::int64_t value) { return former(value) * percent / 100; });
}

/// Until 1017h is written there is no heartbeat.
void starts_with_write_only(Parts& parts) {
  const auto written = std::make_shared<bool>(false);
  after_writing(0x1017, 0, [written](Parts&, const Written& former) {
    *written = true;
    former();
  })(parts);
  parts.device.outbox.add_filter([written](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::boot_up) *written = false;
    if (context.service == Service::heartbeat && !*written) frames.clear();
  });
}

/// An event timer that is written where there was none takes the place of the heartbeat's.
void ends_with_an_event_timer(Parts& parts) {
  const auto ended = since_boot_up<bool>(parts);
  after_writing(0x1017, 0, [ended](Parts&, const Written& former) {
    *ended = false;
    former();
  })(parts);
  const auto times = std::make_shared<std::map<std::uint16_t, Duration>>();
  parts.pdos.tpdo.rules.takes_effect.replace(
      [ended, times, &device = parts.device](const auto& former, const PdoParameters& pdo) {
        const Duration before = std::exchange((*times)[pdo.number()], pdo.event_timer());
        if (device.state == NmtState::operational && before == Duration::zero() && pdo.event_timer() > before)
          *ended = true;
        return former(pdo);
      });
  parts.device.outbox.add_filter([ended](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::heartbeat && *ended) frames.clear();
  });
}

Change ends_after(Duration running) {
  return [running](Parts& parts) {
    const auto end = std::make_shared<std::optional<BusTime>>();
    after_writing(0x1017, 0, [end, running](Parts& node, const Written& former) {
      if (node.device.dictionary.number(0x1017, 0) != 0) *end = node.device.now + running;
      former();
    })(parts);
    parts.device.outbox.add_filter([end](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service == Service::heartbeat && *end && context.now >= **end) frames.clear();
    });
  };
}

Duration own_period(const Parts& parts) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(parts.device.dictionary.number(0x1017, 0)));
}

/// All watches end when the timer of the producer ticks.
void watches_to_the_own_tick(Parts& parts) {
  parts.consumer.rules.time.replace([&parts](const auto& former, std::int64_t value) -> Duration {
    const Duration own = own_period(parts), time = former(value);
    return own == Duration::zero() ? time : std::min(time, own);
  });
}

/// The task that sends a TPDO by its event timer sends the heartbeat as well.
void heartbeat_behind_tpdos(Parts& parts) {
  parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::tpdo || frames.empty() || own_period(parts) == Duration::zero()) return;
    frames.push_back({conform::can::data_frame(conform::CanId(0x700U + context.node_id),
                                               {static_cast<std::uint8_t>(context.state)}),
                      {}});
  });
}

void shows_every_state_while_off(Parts& parts) {
  parts.nmt.on_change = [&parts, former = parts.nmt.on_change](NmtState from) {
    Device& device = parts.device;
    if (device.dictionary.number(0x1017, 0) == 0) {
      device.send(Service::heartbeat, conform::can::data_frame(conform::CanId(0x700U + device.node_id),
                                                               {static_cast<std::uint8_t>(device.state)}));
    }
    former(from);
  };
}

Filter toggles_bit7() {
  return [toggle = false](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
    if (context.service != Service::heartbeat) return;
    for (Outgoing& outgoing : frames) {
      if (std::exchange(toggle, !toggle)) outgoing.frame.data[0] |= 0x80U;
    }
  };
}

/// The decision on another value in place of the one that is written.
Change checks_instead(std::uint64_t (*other)(std::uint64_t entry)) {
  return checking_all(0x1016, [other](Parts&, const Check& former, std::uint8_t, ByteView bytes) {
    return former(conform::to_le(other(conform::load_le(bytes)), bytes.size()));
  });
}

bool runs(Parts& parts, const Frame& heartbeat) {
  for (std::uint8_t sub = 1; sub <= consumer_entries(parts); ++sub) {
    if (node_at(parts, sub) == producer_of(heartbeat) && parts.consumer.due(sub)) return true;
  }
  return false;
}

/// One heartbeat is one of each monitored node.
void feeds_all(Parts& parts, std::vector<Frame>& frames) {
  const std::vector<Frame> received = frames;
  for (Frame frame : received) {
    if (!is_heartbeat(frame)) continue;
    const std::uint8_t producer = producer_of(frame);
    for (std::uint8_t sub = 1; sub <= consumer_entries(parts); ++sub) {
      const auto node = node_at(parts, sub);
      if (!node || *node == producer) continue;
      frame.id = 0x700U + *node;
      frames.push_back(frame);
    }
  }
}

/// Only a write of 1016h ends the error.
void never_resolves(Parts& parts) {
  const auto writing = std::make_shared<bool>(false);
  after_writing_all(0x1016, [writing](Parts&, const Written& former, std::uint8_t) {
    *writing = true;
    former();
    *writing = false;
  })(parts);
  parts.device.errors.clear.replace([writing](const auto& former, const ErrorCause& cause) {
    if (cause.source != ErrorSource::heartbeat || *writing) former(cause);
  });
}

void longer_period_waits(Parts& parts) {
  const auto waits = std::make_shared<bool>(false);
  checking(0x1017, 0, [waits](Parts& node, const Check& former, ByteView bytes) {
    const std::uint64_t present = node.device.dictionary.number(0x1017, 0);
    *waits = present != 0 && conform::load_le(bytes) > present;
    return former(bytes);
  })(parts);
  after_writing(0x1017, 0, [waits](Parts&, const Written& former) {
    if (!*waits) former();
  })(parts);
}

/// An NMT command begins the period anew, also one that changes nothing.
void restarted_by_commands(Parts& parts, std::vector<Frame>& frames) {
  for (const Frame& frame : frames) {
    const bool command = frame.id == 0 && !frame.extended && !frame.remote && frame.size() == 2;
    if (command && (frame.data[1] == 0 || frame.data[1] == parts.device.node_id)) parts.producer.on_boot_up();
  }
}

/// The boot-up of a monitored node is an error of its own, and the node's heartbeat is missed all the same.
void tells_boot_up_twice(Parts& parts, std::vector<Frame>& frames) {
  for (const Frame& frame : frames) {
    if (!is_heartbeat(frame) || frame.data[0] != 0 || !runs(parts, frame)) continue;
    const ErrorCause restart{0x8130, ErrorSource::heartbeat, producer_of(frame)};
    parts.device.errors.raise(restart, producer_of(frame));
    parts.device.errors.clear(restart);
  }
}

}  // namespace

DefectTable error_control_heartbeat_defects() {
  return {
      {"1017-period-wrong",
       "The heartbeat comes at half the rate of 1017h",
       {"OD-1017-05", "EC-HBP-01"},
       lasts(200, of_producer, &HeartbeatProducerRules::period)},
      {"heartbeat-ends-with-an-event-timer",
       "An event timer that is written in Operational where there was none ends the heartbeat until 1017h is written",
       {"EC-HBP-01"},
       Change(ends_with_an_event_timer)},
      {"heartbeat-behind-tpdos",
       "Each TPDO is followed by a heartbeat while there are heartbeats",
       {"EC-HBP-01"},
       Change(heartbeat_behind_tpdos)},
      {"1017-period-a-fifth-longer",
       "The heartbeat comes after 1.2 times the time of 1017h",
       {"EC-HBP-01"},
       lasts(120, of_producer, &HeartbeatProducerRules::period)},
      {"1017-period-in-10ms-units",
       "1017h counts in units of 10 ms",
       {"EC-HBP-01", "OD-1017-05", "EC-HBP-02", "OD-1017-07"},
       lasts(1000, of_producer, &HeartbeatProducerRules::period)},
      {"1017-change-needs-reset",
       "A change of 1017h takes effect with the next reset only",
       {"OD-1017-05", "OD-1017-07", "EC-HBP-02", "EC-HBP-03"},
       after_writing(0x1017, 0, [](Parts&, const Written&) {})},
      {"1017-longer-period-needs-reset",
       "A longer period in 1017h takes effect with the next reset only",
       {"EC-HBP-03"},
       Change(longer_period_waits)},
      {"nmt-command-restarts-heartbeat",
       "Every NMT command begins the period of the heartbeat anew",
       {"EC-HBP-10"},
       Reading(restarted_by_commands)},
      {"1017-zero-does-not-stop",
       "Writing 0 to 1017h does not stop the heartbeat",
       {"OD-1017-06", "EC-HBP-04"},
       after_writing(0x1017, 0,
                     [](Parts& parts, const Written& former) {
                       if (parts.device.dictionary.number(0x1017, 0) != 0) former();
                     })},
      {"1017-stored-value-not-started",
       "A stored heartbeat time is not used after boot-up",
       {"OD-1017-08", "EC-HBP-05"},
       Change(starts_with_write_only)},
      {"heartbeat-ends-after-6s",
       "The heartbeat ends 6 s after it was switched on",
       {"EC-HBP-01", "OD-1017-05"},
       ends_after(std::chrono::seconds(6))},
      {"heartbeat-on-state-change-when-off",
       "State changes send a heartbeat although 1017h is 0",
       {"EC-HBP-04"},
       Change(shows_every_state_while_off)},
      {"heartbeat-stops-in-stopped",
       "There is no heartbeat in Stopped",
       {"NMT-SVC-04", "EC-HBP-06"},
       mute(Service::heartbeat, NmtState::stopped)},
      {"heartbeat-state-stale",
       "The heartbeat always shows Pre-operational",
       {"EC-HBP-06", "NMT-SVC-04", "NMT-FSA-01", "NMT-FSA-02"},
       reshape(Service::heartbeat, [](const FilterContext&, Frame& frame) { frame.data[0] = 0x7F; })},
      {"heartbeat-with-toggle-bit",
       "Bit 7 of the heartbeat toggles",
       {"EC-HBP-07", "OD-1017-05"},
       toggles_bit7()},
      {"heartbeat-dlc-wrong",
       "Heartbeats have two bytes",
       {"EC-HBP-08", "OD-1017-05"},
       reshape(Service::heartbeat, [](const FilterContext&, Frame& frame) { frame.dlc = 2; })},
      {"heartbeat-wrong-cobid",
       "Heartbeats are sent on 700h without the node-ID",
       {"EC-HBP-08", "EC-HBP-01", "OD-1017-05", "EC-HBP-02"},
       reshape(Service::heartbeat, [](const FilterContext&, Frame& frame) { frame.id = 0x700; })},
      {"1016-duplicate-accepted",
       "Two entries of 1016h for the same node are accepted",
       {"OD-1016-06", "EC-HBC-05"},
       checking_all(0x1016,
                    [](Parts& parts, const Check& former, std::uint8_t, ByteView bytes) {
                      const Accepted allowed = former(bytes);
                      return allowed || allowed.error() != parts.consumer.choices.duplicate ? allowed
                                                                                            : Accepted{};
                    })},
      {"1016-duplicate-wrong-abort",
       "A duplicate node in 1016h is aborted with 0609 0030h instead of 0604 0043h",
       {"OD-1016-06", "EC-HBC-05"},
       wrong_abort(abort_code::parameter_incompatible, abort_code::invalid_value, {0x1016, 0x1016})},
      {"1016-zero-time-duplicate-refused",
       "A second entry of 1016h with time 0 is refused as a duplicate",
       {"OD-1016-07"},
       checks_instead([](std::uint64_t entry) { return monitored_time(entry) == 0 ? entry | 1U : entry; })},
      {"1016-zero-time-entry-keeps-its-node",
       "A time for a node is refused while another entry of 1016h names that node with time 0",
       {"OD-1016-07"},
       checking_all(0x1016,
                    [](Parts& parts, const Check& former, std::uint8_t sub, ByteView bytes) -> Accepted {
                      const std::uint64_t wanted = conform::load_le(bytes);
                      const Accepted allowed = former(bytes);
                      if (!allowed || !parts.consumer.rules.used(wanted)) return allowed;
                      const ObjectDictionary& od = parts.device.dictionary;
                      for (std::uint8_t other = 1; other <= od.number(0x1016, 0); ++other) {
                        if (other != sub &&
                            monitored_node(od.number(0x1016, other)) == monitored_node(wanted))
                          return refuse(abort_code::parameter_incompatible);
                      }
                      return {};
                    })},
      {"1016-same-time-counts-as-duplicate",
       "Two entries of 1016h for different nodes are refused where they have the same time",
       {"OD-1016-05"},
       checking_all(0x1016,
                    [](Parts& parts, const Check& former, std::uint8_t sub, ByteView bytes) -> Accepted {
                      const auto time = monitored_time(conform::load_le(bytes));
                      const ObjectDictionary& od = parts.device.dictionary;
                      for (std::uint8_t other = 1; other <= od.number(0x1016, 0); ++other) {
                        if (other != sub && time != 0 && monitored_time(od.number(0x1016, other)) == time)
                          return refuse(abort_code::parameter_incompatible);
                      }
                      return former(bytes);
                    })},
      {"1016-own-entry-counts-as-duplicate",
       "Rewriting an entry of 1016h is refused as a duplicate of itself",
       {"OD-1016-08"},
       checking_all(0x1016,
                    [](Parts& parts, const Check& former, std::uint8_t sub, ByteView bytes) -> Accepted {
                      const std::uint64_t wanted = conform::load_le(bytes);
                      const Accepted allowed = former(bytes);
                      if (!allowed || !parts.consumer.rules.used(wanted)) return allowed;
                      if (node_at(parts, sub) == monitored_node(wanted))
                        return refuse(abort_code::parameter_incompatible);
                      return {};
                    })},
      {"1016-reserved-bits-writable",
       "Bits 31-24 of 1016h can be set",
       {"OD-1016-12"},
       checks_instead([](std::uint64_t entry) { return entry & 0x00FFFFFFU; })},
      {"1016-monitors-before-first-heartbeat",
       "Monitoring starts with the configuration",
       {"OD-1016-10", "EC-HBC-02"},
       after_writing_all(0x1016,
                         [](Parts& parts, const Written& former, std::uint8_t sub) {
                           former();
                           if (const auto node = node_at(parts, sub))
                             parts.consumer.on_heartbeat(*node, 0x7F);
                         })},
      {"1016-timeout-not-detected",
       "A missing heartbeat is not noticed",
       {"OD-1016-11", "EC-HBC-03"},
       deaf_to([](Parts&, const Frame& frame) { return is_heartbeat(frame); })},
      {"1016-ends-with-own-heartbeat",
       "A heartbeat counts as missing when the own one is due, if that is earlier than the time of 1016h",
       {"EC-HBC-03"},
       Change(watches_to_the_own_tick)},
      {"1016-unit-wrong",
       "1016h counts in units of 10 ms",
       {"OD-1016-11", "EC-HBC-03"},
       lasts(1000, of_consumer, &HeartbeatConsumerRules::time)},
      {"hbc-timeout-wrong-code",
       "A missing heartbeat is reported as generic error 1000h",
       {"EC-HBC-03"},
       Change([](Parts& parts) {
         parts.device.errors.raise.replace([](const auto& former, ErrorCause cause, std::uint8_t detail) {
           if (cause.source == ErrorSource::heartbeat) cause.code = 0x1000;
           former(cause, detail);
         });
       })},
      {"hbc-timer-not-restarted",
       "The consumer time runs from the first heartbeat, whatever follows",
       {"EC-HBC-04", "OD-1016-11"},
       deaf_to([](Parts& parts, const Frame& frame) { return is_heartbeat(frame) && runs(parts, frame); })},
      {"hbc-only-first-entry-works",
       "Only 1016h:01 is monitored",
       {"EC-HBC-13"},
       deaf_to([](Parts& parts, const Frame& frame) {
         return is_heartbeat(frame) && node_at(parts, 1) != producer_of(frame);
       })},
      {"hbc-last-entry-not-monitored",
       "The last entry of 1016h is not monitored",
       {"EC-HBC-13"},
       deaf_to([](Parts& parts, const Frame& frame) {
         const std::uint8_t last = consumer_entries(parts);
         return is_heartbeat(frame) && node_at(parts, last) == producer_of(frame);
       })},
      {"hbc-third-entry-not-monitored",
       "What the third entry of 1016h names is not monitored",
       {"EC-HBC-13"},
       deaf_to([](Parts& parts, const Frame& frame) {
         return is_heartbeat(frame) && node_at(parts, 3) == producer_of(frame);
       })},
      {"hbc-node-127-not-monitored",
       "An entry of 1016h for node 127 is taken and not monitored",
       {"EC-HBC-03"},
       decides(of_consumer, &HeartbeatConsumerRules::used,
               [](const auto& former, std::uint64_t entry) {
                 return former(entry) && monitored_node(entry) != 127;
               })},
      {"1016-unused-entry-monitors",
       "An entry of 1016h with time 0 is monitored",
       {"OD-1016-09", "EC-HBC-06", "OD-1016-07"},
       decides(of_consumer, &HeartbeatConsumerRules::used,
               [](const auto& former, std::uint64_t entry) {
                 return former(entry) || monitored_node(entry) != 0;
               })},
      {"hbc-error-never-resolved",
       "Returning heartbeats do not end the error",
       {"EC-HBC-07", "OD-1001-06", "EMCY-SEQ-02"},
       Change(never_resolves)},
      {"hbc-boot-up-told-twice",
       "The boot-up of a monitored node is reported, and the loss of its heartbeat as well",
       {"EC-HBC-12"},
       Reading(tells_boot_up_twice)},
      {"hbc-node-id-not-checked",
       "Heartbeats of any node feed the monitoring",
       {"EC-HBC-09", "EC-HBC-03"},
       Reading(feeds_all)},
      {"error-behavior-default-wrong",
       "A heartbeat loss does not end Operational",
       {"EC-HBC-08"},
       decides(of_error_behaviour, &ErrorBehaviourRules::next_state,
               [](const auto&, std::uint64_t, NmtState present) { return present; })},
  };
}

}  // namespace refnode
