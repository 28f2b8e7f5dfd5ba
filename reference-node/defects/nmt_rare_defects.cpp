// SPDX-License-Identifier: Apache-2.0
// Defects of NMT, error control and LSS that need a certain way to the state in which they show: a command to
// all nodes, an error that is there still, a node-ID that waits, a second event.
#include <chrono>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "defects/heartbeats.hpp"
#include "defects/lss_frames.hpp"
#include "defects/receivers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

using namespace nmt_command;

constexpr std::uint8_t toggle_bit = 0x80;
constexpr std::uint16_t life_guarding_or_heartbeat = 0x8130;

/// How the node has come into its present state.
struct Way {
  NmtState present = NmtState::initialising;
  NmtState before = NmtState::initialising;  ///< behind a reset: the state in which that came
  bool by_reset = false;
  bool by_all = false;  ///< by a command to all nodes
  bool last_command_to_all = false;
};
std::shared_ptr<Way> way_of(Parts& parts) {
  const auto way = std::make_shared<Way>();
  deaf_to([way](Parts& node, const Frame& frame) {
    if (is_nmt_command(frame) && is_for(node, frame)) way->last_command_to_all = frame.data[1] == 0;
    return false;
  })(parts);
  parts.nmt.on_reset = [way, former = parts.nmt.on_reset](Reset kind) {
    *way = {.present = NmtState::initialising, .before = way->present, .by_reset = true};
    former(kind);
  };
  with_boot_up([way](Parts&) { way->present = NmtState::pre_operational; })(parts);
  parts.nmt.on_change = [&parts, way, former = parts.nmt.on_change](NmtState from) {
    const bool by_all = std::exchange(way->last_command_to_all, false);
    *way = {.present = parts.device.state, .before = from, .by_all = by_all};
    former(from);
  };
  return way;
}

using When = bool (*)(const Way& way);
/// In this state such services work, or do not, where `when` holds.
Change works_by_way(std::initializer_list<Service> such, NmtState where, bool works, When when) {
  return [such = std::set(such), where, works, when](Parts& parts) {
    parts.device.works.replace([=, way = way_of(parts)](const auto& former, Service service, NmtState state) {
      return such.contains(service) && state == where && when(*way) ? works : former(service, state);
    });
  };
}

/// The buffer of commands holds the node-ID of the last one, which stands for one that is missing.
void takes_the_former_node_id(Parts& parts) {
  misreads([last = std::optional<std::uint8_t>{}](Parts&, Frame& frame) mutable {
    if (is_nmt_command(frame)) last = frame.data[1];
    if (frame.id != 0x000 || frame.extended || frame.remote || frame.size() != 1 || !last) return;
    frame.data[1] = *last;
    frame.dlc = 2;
  })(parts);
}

/// `act` follows a command that is for another node.
Change with_command_for_another(void (*act)(Parts&, std::uint8_t specifier)) {
  return deaf_to([act](Parts& parts, const Frame& frame) {
    if (is_nmt_command(frame) && !is_for(parts, frame)) act(parts, frame.data[0]);
    return false;
  });
}

Frame switch_state_global(std::uint8_t mode) {
  return conform::can::data_frame(conform::CanId(lss::request_id), {0x04, mode, 0, 0, 0, 0, 0, 0});
}

/// One variable holds the time of all entries, that of the first one that is used.
void times_of_the_first_entry(Parts& parts) {
  parts.consumer.rules.time.replace([&parts](const auto& former, std::int64_t value) {
    for (std::uint8_t sub = 1; sub <= consumer_entries(parts); ++sub) {
      if (node_at(parts, sub)) return former(monitored_time(parts.device.dictionary.number(0x1016, sub)));
    }
    return former(value);
  });
}

bool is_behind_an_unused_entry(Parts& parts, const Frame& frame) {
  if (!is_heartbeat(frame)) return false;
  for (std::uint8_t sub = 1; sub <= consumer_entries(parts); ++sub) {
    const auto node = node_at(parts, sub);
    if (!node || *node == producer_of(frame)) return !node;
  }
  return false;
}

/// Of the nodes that are lost in the same millisecond the first is noticed.
void notices_one_loss_in_a_millisecond(Parts& parts) {
  const auto last = std::make_shared<std::optional<BusTime>>();
  parts.device.errors.raise.replace(
      [&parts, last](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
        if (cause.source == ErrorSource::heartbeat) {
          const auto before = std::exchange(*last, parts.device.now);
          if (before && parts.device.now - *before < std::chrono::milliseconds(1)) return;
        }
        former(cause, detail);
      });
}

/// The error behaviour changes the state once behind each boot-up.
void acts_once(Parts& parts) {
  const auto acted = since_boot_up<bool>(parts);
  parts.error_behaviour.enter = [&parts, acted, former = parts.error_behaviour.enter](NmtState state) {
    if (state == parts.device.state || !std::exchange(*acted, true)) former(state);
  };
}

/// The life time of the watch that ran first goes on counting until there is none.
void keeps_the_life_time(Parts& parts) {
  const auto kept = std::make_shared<Duration>(Duration::zero());
  with_boot_up([kept](Parts&) { *kept = Duration::zero(); })(parts);
  parts.guarding.rules.life_time.replace(
      [kept](const auto& former, std::uint64_t guard_time, std::uint64_t factor) {
        const Duration right = former(guard_time, factor);
        if (right <= Duration::zero()) *kept = Duration::zero();
        return *kept > Duration::zero() ? *kept : right;
      });
  deaf_to([kept](Parts& node, const Frame& frame) {
    const ObjectDictionary& od = node.device.dictionary;
    if (is_guard_request(node, frame) && od.number(0x1017, 0) == 0)
      *kept = node.guarding.rules.life_time(od.number(0x100C, 0), od.number(0x100D, 0));
    return false;
  })(parts);
}

constexpr ErrorCause life_guarding{life_guarding_or_heartbeat, ErrorSource::guarding, 0};

/// A request in Stopped resolves nothing; the next one elsewhere does.
void not_resolved_in_stopped(Parts& parts) {
  const auto unresolved = std::make_shared<bool>(false);
  parts.device.errors.clear.replace([&parts, unresolved](const auto& former, const ErrorCause& cause) {
    *unresolved = *unresolved || (cause == life_guarding && parts.device.state == NmtState::stopped);
    if (cause != life_guarding || !*unresolved) former(cause);
  });
  deaf_to([unresolved](Parts& node, const Frame& frame) {
    if (is_guard_request(node, frame) && *unresolved && node.device.state != NmtState::stopped) {
      *unresolved = false;
      node.device.errors.clear(life_guarding);
    }
    return false;
  })(parts);
}

bool is_of_a_monitored_node(Parts& parts, const Frame& frame) {
  for (std::uint8_t sub = 1; is_heartbeat(frame) && sub <= consumer_entries(parts); ++sub) {
    if (node_at(parts, sub) == producer_of(frame)) return true;
  }
  return false;
}

/// The toggle bit is the lowest bit of a counter that goes from 0 to 254.
Change toggles_by_a_counter_to_254() {
  return Filter([count = 0](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
    if (context.service == Service::boot_up) count = 0;
    if (context.service != Service::guarding) return;
    for (Outgoing& each : frames) {
      each.frame.data[0] &= static_cast<std::uint8_t>(~toggle_bit);
      if (count % 2 == 1) each.frame.data[0] |= toggle_bit;
      count = (count + 1) % 255;
    }
  });
}

/// Where the LSS slave is, and how it has come there.
struct LssWay {
  bool configuration = false;
  bool selected = false;  ///< by switch state selective
  bool scanned = false;   ///< by fastscan
  int times = 0;          ///< that the configuration state was entered
  Frame request{};        ///< the last one
  void enter(bool by_selective, bool by_fastscan) {
    if (!std::exchange(configuration, true)) ++times;
    selected = by_selective;
    scanned = by_fastscan;
  }
};
std::shared_ptr<LssWay> lss_way_of(Parts& parts) {
  const auto way = std::make_shared<LssWay>();
  deaf_to([way](Parts&, const Frame& frame) {
    if (!lss::is_request(frame)) return false;
    way->request = frame;
    if (frame.data[0] == 0x04 && frame.data[1] == 0) way->configuration = false;
    if (frame.data[0] == 0x04 && frame.data[1] == 1 && !way->configuration) way->enter(false, false);
    return false;
  })(parts);
  parts.device.outbox.add_filter([way](const FilterContext& context, const std::vector<Outgoing>& frames) {
    if (context.service == Service::boot_up) way->configuration = false;
    if (context.service != Service::lss || frames.empty()) return;
    const auto& asked = way->request.data;
    const std::uint8_t answer = frames.front().frame.data[0];
    if (answer == 0x44) way->enter(true, false);
    if (answer == 0x4F && asked[0] == 0x51 && asked[5] == 0 && asked[7] < asked[6]) way->enter(false, true);
  });
  return way;
}

/// In the configuration state the slave does not hear frames for which `such` holds.
Change deaf_in_configuration(bool (*such)(const LssWay& way, const Frame& frame)) {
  return [such](Parts& parts) {
    deaf_to([way = lss_way_of(parts), such](Parts&, const Frame& frame) {
      return way->configuration && such(*way, frame);
    })(parts);
  };
}

bool is_lss(const Frame& frame, std::uint8_t first, std::uint8_t last) {
  return lss::is_request(frame) && frame.data[0] >= first && frame.data[0] <= last;
}

void has_no_heartbeat_in_configuration(Parts& parts) {
  parts.device.outbox.add_filter(
      [way = lss_way_of(parts)](const FilterContext& context, std::vector<Outgoing>& frames) {
        if (context.service == Service::heartbeat && way->configuration) frames.clear();
      });
}

void leaves_with_another_switch(Parts& parts) {
  misreads([way = lss_way_of(parts), before = false](Parts&, Frame& frame) mutable {
    const bool was_there = std::exchange(before, way->configuration);
    if (!lss::is_request(frame, 0x04) || frame.data[1] != 1 || !was_there) return;
    frame.data[1] = 0;
    way->configuration = before = false;
  })(parts);
}

/// A part that was compared as a whole ends the scan, though the master goes on with the same one.
void is_found_by_the_same_part(Parts& parts) {
  parts.device.outbox.add_filter(
      [&parts, way = lss_way_of(parts)](const FilterContext& context, const std::vector<Outgoing>& frames) {
        if (context.service != Service::lss || frames.empty() || frames.front().frame.data[0] != 0x4F) return;
        const auto& asked = way->request.data;
        if (asked[0] == 0x51 && asked[5] == 0 && asked[6] == asked[7])
          parts.device.inbox.put(switch_state_global(1), context.now);
      });
}

/// The node-IDs that 11h has brought since the boot-up message.
struct Brought {
  std::optional<std::uint8_t> first{};
  int times = 0;                           ///< of the configuration state, with the last one
  bool dropped = false;                    ///< by what came behind it
  std::optional<std::uint8_t> in_place{};  ///< what is taken for it
};
std::shared_ptr<Brought> brought_to(Parts& parts, const std::shared_ptr<LssWay>& way) {
  const auto brought = since_boot_up<Brought>(parts);
  parts.lss.rules.node_id_allowed.replace([brought, way](const auto& former, std::uint8_t node_id) {
    const bool allowed = former(node_id);
    if (allowed && !brought->first) brought->first = node_id;
    if (allowed) *brought = {.first = brought->first, .times = way->times};
    if (!allowed && node_id > 0x80) brought->in_place = node_id & 0x7FU;
    return allowed;
  });
  return brought;
}

/// The node-ID that is in force behind reset communication.
using Taken = std::uint8_t (*)(const Brought& brought, const LssWay& way, std::uint8_t active,
                               std::uint8_t right);
Change takes_behind_reset(Taken taken) {
  return [taken](Parts& parts) {
    const auto way = lss_way_of(parts);
    const auto brought = brought_to(parts, way);
    parts.lss.rules.bit_rate_allowed.replace(
        [brought](const auto& former, std::uint8_t table, std::uint8_t index) {
          brought->dropped = !former(table, index) && brought->first;
          return former(table, index);
        });
    parts.lss.rules.after_reset_communication.replace(
        [=](const auto& former, std::uint8_t active, std::uint8_t pending) {
          return taken(*brought, *way, active, former(active, pending));
        });
  };
}

/// Store configuration takes the node-ID that is in force where 11h was of an earlier stay in the state.
void stores_the_active_one(Parts& parts) {
  const auto way = lss_way_of(parts);
  const auto brought = brought_to(parts, way);
  parts.lss.keep = [&parts, way, brought, former = parts.lss.keep](std::uint8_t node_id,
                                                                   std::optional<std::uint8_t> bit_rate) {
    const bool earlier = brought->first && brought->times != way->times;
    return former(earlier ? parts.device.node_id : node_id, bit_rate);
  };
}

DefectTable state_rows() {
  return {
      {"sdo-served-in-stopped-of-all",
       "In Stopped by a command to all nodes SDO is served",
       {"NMT-FSA-14", "SDO-GEN-15", "NMT-FSA-23"},
       works_by_way({Service::sdo}, NmtState::stopped, true, [](const Way& way) { return way.by_all; })},
      {"pdos-off-behind-start-of-all",
       "In Operational by a command to all nodes there are no PDOs",
       {"NMT-FSA-14", "NMT-FSA-22"},
       works_by_way({Service::rpdo, Service::tpdo}, NmtState::operational, false,
                    [](const Way& way) { return way.by_all; })},
      {"tpdo-sent-in-pre-operational-from-stopped",
       "In Pre-operational that was entered from Stopped TPDOs are sent",
       {"PDO-TX-02", "NMT-FSA-21"},
       works_by_way({Service::tpdo}, NmtState::pre_operational, true,
                    [](const Way& way) { return way.before == NmtState::stopped && !way.by_reset; })},
      {"tpdo-sent-in-pre-operational-by-error",
       "In Pre-operational that an error has led to TPDOs are sent",
       {"PDO-TX-02", "NMT-FSA-21"},
       works_where_led_by_error(Service::tpdo, NmtState::pre_operational)},
      {"sdo-deaf-behind-reset-in-stopped",
       "Behind a reset in Stopped the SDO server is off until the NMT state changes",
       {"SDO-GEN-17", "SDO-GEN-13"},
       works_by_way({Service::sdo}, NmtState::pre_operational, false,
                    [](const Way& way) { return way.by_reset && way.before == NmtState::stopped; })},
      {"rpdo-processed-behind-reset-in-operational",
       "Behind a reset in Operational RPDOs are processed in Pre-operational",
       {"PDO-RX-02", "NMT-FSA-21"},
       works_by_way({Service::rpdo}, NmtState::pre_operational, true,
                    [](const Way& way) { return way.by_reset && way.before == NmtState::operational; })},
      {"nmt-command-bit-6-masked",
       "Bit 6 of the command specifier is not looked at",
       {"NMT-FSA-16"},
       misreads([](Parts&, Frame& frame) {
         if (is_nmt_command(frame)) frame.data[0] &= 0xBF;
       })},
      {"nmt-command-03h-stops-in-operational",
       "In Operational the unknown command 03h stops the node",
       {"NMT-FSA-16"},
       misreads([](Parts& parts, Frame& frame) {
         const bool concerned = parts.device.state == NmtState::operational;
         if (is_nmt_command(frame) && frame.data[0] == 0x03 && concerned) frame.data[0] = 0x02;
       })},
      {"nmt-start-again-leaves-operational",
       "NMT start in Operational leads to Pre-operational",
       {"NMT-FSA-13"},
       misreads([](Parts& parts, Frame& frame) {
         const bool concerned = parts.device.state == NmtState::operational;
         if (is_nmt_command(frame) && frame.data[0] == start && concerned)
           frame.data[0] = enter_pre_operational;
       })},
      {"nmt-node-id-128-is-all",
       "Commands to node-ID 128 are for all nodes",
       {"NMT-FSA-15"},
       misreads([](Parts&, Frame& frame) {
         if (is_nmt_command(frame) && frame.data[1] == 0x80) frame.data[1] = 0;
       })},
      {"nmt-short-frame-has-former-node-id",
       "A command of one byte is for the node that the one before it was for",
       {"NMT-FSA-17"},
       Change(takes_the_former_node_id)},
      {"nmt-reset-node-in-operational-resets-communication",
       "In Operational reset node resets the communication only",
       {"NMT-FSA-25"},
       misreads([](Parts& parts, Frame& frame) {
         if (is_nmt_command(frame) && frame.data[0] == reset_node &&
             parts.device.state == NmtState::operational)
           frame.data[0] = reset_communication;
       })},
      {"reset-communication-in-stopped-keeps-values",
       "In Stopped reset communication keeps the communication parameters",
       {"NMT-FSA-24"},
       Change([](Parts& parts) {
         parts.store.rules.reset_loads.replace(
             [way = way_of(parts)](const auto& former, Group group, bool whole_node) {
               return former(group, whole_node) && (whole_node || way->before != NmtState::stopped);
             });
       })},
      {"nmt-pre-operational-again-drops-transfer",
       "NMT enter pre-operational in Pre-operational ends the SDO transfer that runs",
       {"NMT-FSA-13"},
       deaf_to([](Parts& parts, const Frame& frame) {
         if (is_nmt_command(frame) && is_for(parts, frame) && frame.data[0] == enter_pre_operational &&
             parts.device.state == NmtState::pre_operational)
           parts.sdo.drop();
         return false;
       })},
      {"nmt-reset-of-another-ends-lss-configuration",
       "A reset command for another node ends the LSS configuration state",
       {"NMT-FSA-15"},
       with_command_for_another([](Parts& parts, std::uint8_t specifier) {
         if (specifier == reset_node || specifier == reset_communication)
           parts.lss.on_frame(switch_state_global(0));
       })},
      {"nmt-of-another-begins-toggle-anew",
       "An NMT command for another node begins the toggle bit anew",
       {"NMT-FSA-15", "EC-NG-03"},
       with_command_for_another([](Parts& parts, std::uint8_t) { parts.guarding.begin_toggle_anew(); })},
  };
}

DefectTable error_control_rows() {
  return {
      {"1017-low-byte-0-is-off",
       "There is no heartbeat where the lower byte of 1017h is 0",
       {"EC-HBP-02", "EC-HBP-03"},
       decides(of_producer, &HeartbeatProducerRules::period,
               [](const auto& former, std::int64_t value) { return former(value % 256 == 0 ? 0 : value); })},
      {"heartbeat-put-off-by-guard-request",
       "A guard request begins the period of the heartbeat anew",
       {"EC-HBP-12", "EC-HBP-01"},
       deaf_to([](Parts& parts, const Frame& frame) {
         if (is_guard_request(parts, frame)) parts.producer.on_boot_up();
         return false;
       })},
      {"heartbeat-pauses-in-lss-configuration",
       "In the LSS configuration state there is no heartbeat",
       {"EC-HBP-01", "LSS-GEN-04"},
       Change(has_no_heartbeat_in_configuration)},
      {"1016-low-byte-0-is-unused",
       "An entry of 1016h is not used where the lower byte of its time is 0",
       {"EC-HBC-03", "EC-HBC-13"},
       decides(of_consumer, &HeartbeatConsumerRules::used,
               [](const auto& former, std::uint64_t entry) { return former(entry) && entry % 256 != 0; })},
      {"hbc-times-of-the-first-entry",
       "All entries of 1016h have the time of the first one that is used",
       {"EC-HBC-13", "EC-HBC-03"},
       Change(times_of_the_first_entry)},
      {"hbc-ends-at-an-unused-entry",
       "What stands in 1016h behind an entry that is not used is not monitored",
       {"EC-HBC-13"},
       deaf_to(is_behind_an_unused_entry)},
      {"hbc-second-loss-of-a-millisecond-unnoticed",
       "Of two nodes that are lost in the same millisecond the first is noticed only",
       {"EC-HBC-13", "EC-HBC-07"},
       Change(notices_one_loss_in_a_millisecond)},
      {"1029-acts-once",
       "Of the communication errors behind a boot-up the first one alone changes the NMT state",
       {"EC-EB-01", "EC-HBC-08"},
       Change(acts_once)},
      {"1029-life-guarding-behind-heartbeat-loss",
       "While a monitored node is missing a life guarding event does not change the NMT state",
       {"EC-EB-01", "OD-1029-10"},
       Change([](Parts& parts) {
         parts.guarding.on_loss = [&parts, former = parts.guarding.on_loss] {
           if (parts.emergency.active().size() < 2) former();
         };
       })},
      {"1029-stored-without-effect",
       "1029h:01 that was stored has no effect until it is written",
       {"EC-EB-02", "OD-RST-04"},
       Change([](Parts& parts) {
         parts.error_behaviour.rules.next_state.replace(
             [written = written_since_boot_up(parts, {0x1029})](const auto& former, std::uint64_t value,
                                                                NmtState present) {
               return former(written->empty() ? 0 : value, present);
             });
       })},
      {"guard-toggle-begins-anew-behind-an-event",
       "The toggle bit begins with 0 behind a life guarding event",
       {"EC-NG-10", "EC-NG-03"},
       Change([](Parts& parts) {
         parts.guarding.on_loss = [&parts, former = parts.guarding.on_loss] {
           parts.guarding.begin_toggle_anew();
           former();
         };
       })},
      {"guard-toggle-begins-anew-by-error",
       "The toggle bit begins with 0 where an error changes the NMT state",
       {"EC-NG-03"},
       Change([](Parts& parts) {
         parts.error_behaviour.enter = [&parts, former = parts.error_behaviour.enter](NmtState state) {
           if (state != parts.device.state) parts.guarding.begin_toggle_anew();
           former(state);
         };
       })},
      {"100c-low-byte-0-is-off",
       "There is no life guarding where the lower byte of the guard time is 0",
       {"EC-NG-07"},
       Change([](Parts& parts) {
         parts.guarding.rules.life_time.replace(
             [](const auto& former, std::uint64_t guard_time, std::uint64_t factor) {
               return guard_time % 256 == 0 ? Duration::zero() : former(guard_time, factor);
             });
       })},
      {"life-time-written-without-effect",
       "Another life time has no effect while there is one already",
       {"EC-NG-07"},
       Change(keeps_the_life_time)},
      {"life-guarding-not-resolved-in-stopped",
       "A guard request in Stopped does not resolve a life guarding event",
       {"EC-NG-10"},
       Change(not_resolved_in_stopped)},
      {"life-guarding-resolved-by-heartbeat",
       "A heartbeat of a monitored node resolves a life guarding event",
       {"EC-NG-10"},
       deaf_to([](Parts& parts, const Frame& frame) {
         if (is_of_a_monitored_node(parts, frame)) parts.device.errors.clear(life_guarding);
         return false;
       })},
      {"guard-toggle-repeats-behind-255-replies",
       "The toggle bit stays as it is behind each 255th reply",
       {"EC-NG-02"},
       toggles_by_a_counter_to_254()},
  };
}

DefectTable lss_rows() {
  return {
      {"lss-global-1-again-leaves",
       "Switch state global 1 in the configuration state leaves it",
       {"LSS-SG-01"},
       Change(leaves_with_another_switch)},
      {"lss-node-id-forgotten-with-the-next-configuration",
       "A node-ID that waits for the reset is forgotten when the configuration state is entered again",
       {"LSS-CN-04"},
       takes_behind_reset(
           [](const Brought& brought, const LssWay& way, std::uint8_t active, std::uint8_t right) {
             return brought.first && brought.times != way.times ? active : right;
           })},
      {"lss-first-node-id-counts",
       "Of the node-IDs that are configured before a reset the first one counts",
       {"LSS-CN-04"},
       takes_behind_reset([](const Brought& brought, const LssWay&, std::uint8_t, std::uint8_t right) {
         return brought.first.value_or(right);
       })},
      {"lss-refused-bit-rate-forgets-node-id",
       "A bit rate that is refused takes with it the node-ID that waits for the reset",
       {"LSS-CN-04"},
       takes_behind_reset([](const Brought& brought, const LssWay&, std::uint8_t active, std::uint8_t right) {
         return brought.dropped ? active : right;
       })},
      {"lss-refused-node-id-counts",
       "Of a node-ID above 128 that is refused the lower seven bits wait for the reset",
       {"LSS-CN-02", "LSS-CN-04"},
       takes_behind_reset([](const Brought& brought, const LssWay&, std::uint8_t, std::uint8_t right) {
         return brought.in_place.value_or(right);
       })},
      {"lss-store-takes-the-active-node-id",
       "A node-ID of an earlier stay in the configuration state is not stored, but the one in force",
       {"LSS-ST-02"},
       Change(stores_the_active_one)},
      {"lss-identify-swapped-ends",
       "A range whose lowest number is above its highest is taken the other way round",
       {"LSS-ID-02"},
       decides(lss::of_address, &LssAddressRules::in_range,
               [](const auto& former, std::uint32_t low, std::uint32_t own, std::uint32_t high) {
                 return former(low, own, high) || former(high, own, low);
               })},
      {"lss-fastscan-found-by-the-same-part",
       "A fastscan that compares a whole part and goes on with the same one has found the slave",
       {"LSS-FS-03"},
       Change(is_found_by_the_same_part)},
      {"lss-store-deaf-behind-fastscan",
       "In the configuration state that a fastscan has led to nothing is stored",
       {"LSS-ST-01"},
       deaf_in_configuration([](const LssWay& way, const Frame& frame) {
         return way.scanned && lss::is_request(frame, 0x17);
       })},
      {"lss-identify-deaf-in-configuration",
       "In the configuration state identify remote slave is not answered",
       {"LSS-ID-02"},
       deaf_in_configuration([](const LssWay&, const Frame& frame) { return is_lss(frame, 0x46, 0x4B); })},
      {"lss-inquiry-deaf-behind-selective",
       "In the configuration state by switch state selective the LSS address is not told",
       {"LSS-INQ-01", "LSS-INQ-02", "LSS-INQ-03", "LSS-INQ-04"},
       deaf_in_configuration(
           [](const LssWay& way, const Frame& frame) { return way.selected && is_lss(frame, 0x5A, 0x5D); })},
      {"rpdo-deaf-in-lss-configuration",
       "In the LSS configuration state RPDOs are not processed",
       {"NMT-FSA-22"},
       deaf_in_configuration([](const LssWay&, const Frame& frame) {
         return !frame.remote && (frame.extended || (frame.id >= 0x180 && frame.id < 0x580));
       })},
  };
}

}  // namespace

DefectTable nmt_rare_defects() {
  DefectTable rows = state_rows();
  append(rows, error_control_rows());
  append(rows, lss_rows());
  return rows;
}

}  // namespace refnode
