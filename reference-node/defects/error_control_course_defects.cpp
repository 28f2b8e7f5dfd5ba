// SPDX-License-Identifier: Apache-2.0
// Defects of error control that show only beside other frames, behind a reset, or in the long run.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "defects/heartbeats.hpp"
#include "defects/receivers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr std::uint8_t toggle_bit = 0x80;

/// A frame that `node_of` finds a node for counts as a heartbeat of that node, once its monitoring has begun.
Change counts_as_heartbeat(std::optional<std::uint8_t> (*node_of)(const Frame& frame)) {
  return Reading([node_of](Parts& parts, std::vector<Frame>& frames) {
    for (const Frame& frame : frames) {
      const auto node = node_of(frame);
      if (!node) continue;
      for (std::uint8_t sub = 1; sub <= consumer_entries(parts); ++sub) {
        if (node_at(parts, sub) == node && parts.consumer.due(sub)) parts.consumer.on_heartbeat(*node, 0x05);
      }
    }
  });
}

/// Only the lower seven bits of a node-ID in 1016h count.
void knows_nodes_by_seven_bits(Parts& parts) {
  parts.consumer.rules.used.replace(
      [](const auto& former, std::uint64_t entry) { return former(entry & 0xFF7FFFFFU); });
  parts.device.inbox.add_filter([&parts](std::vector<Frame>& frames) {
    for (const Frame& frame : frames) {
      if (is_heartbeat(frame) && parts.device.state != NmtState::initialising)
        parts.consumer.on_heartbeat(static_cast<std::uint8_t>(producer_of(frame) | 0x80U), frame.data[0]);
    }
  });
}

/// 32768 ms and more are taken for a negative time, and a node with such a time is not monitored.
bool below_the_sign(std::uint64_t entry) { return (entry & 0x8000U) == 0; }

/// Every EMCY begins the period of the heartbeat anew.
void begins_anew_with_emcy(Parts& parts) {
  parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>&) {
    if (context.service == Service::emergency) parts.producer.on_boot_up();
  });
}

/// A write of the time that there is ends the heartbeat.
void stops_with_the_same_time(Parts& parts) {
  const auto present = std::make_shared<std::uint64_t>(0);
  with_boot_up([present](Parts& node) { *present = node.device.dictionary.number(0x1017, 0); })(parts);
  after_writing(0x1017, 0, [present](Parts& node, const Written& former) {
    former();
    const std::uint64_t written = node.device.dictionary.number(0x1017, 0);
    if (std::exchange(*present, written) == written) node.producer.on_reset();
  })(parts);
}

constexpr std::uint64_t by_default = 1000;

/// A heartbeat time that is the default one is only a number until it, or another one, is written.
void default_waits_for_a_write(Parts& parts) {
  preset(0x1017, 0, by_default)(parts.device.dictionary, parts.device.node_id);
  const auto waits = std::make_shared<bool>(false);
  with_boot_up([waits](Parts& node) { *waits = node.device.dictionary.number(0x1017, 0) == by_default; })(
      parts);
  after_writing(0x1017, 0, [waits](Parts&, const Written& former) {
    *waits = false;
    former();
  })(parts);
  parts.device.outbox.add_filter([waits](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::heartbeat && *waits) frames.clear();
  });
}

/// Behind reset communication the timer has the period that was written before, until 1017h is written again.
void keeps_period_behind_reset_communication(Parts& parts) {
  preset(0x1017, 0, by_default)(parts.device.dictionary, parts.device.node_id);
  const auto written = std::make_shared<std::optional<std::int64_t>>();
  const auto kept = std::make_shared<std::optional<std::int64_t>>();
  after_writing(0x1017, 0, [written, kept](Parts& node, const Written& former) {
    kept->reset();
    *written = node.device.time_value(0x1017, 0);
    former();
  })(parts);
  parts.nmt.on_reset = [written, kept, former = parts.nmt.on_reset](Reset kind) {
    if (kind == Reset::node) written->reset();
    if (*written) *kept = *written;
    if (kind == Reset::node) kept->reset();
    former(kind);
  };
  parts.producer.rules.period.replace(
      [kept](const auto& former, std::int64_t value) { return former(kept->value_or(value)); });
}

/// The CAN-ID of the heartbeat is that of the first node-ID.
Change keeps_the_first_can_id() {
  return Filter(
      [first = std::uint32_t{0}](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
        if (context.service == Service::boot_up && first == 0) first = 0x700U + context.node_id;
        if (context.service != Service::heartbeat) return;
        for (Outgoing& each : frames) each.frame.id = first;
      });
}

/// Every 256th heartbeat is left out: a counter passes 0.
Change leaves_out_each_256th() {
  return Filter(
      [count = std::uint8_t{0}](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
        if (context.service == Service::heartbeat && !frames.empty() && ++count == 0) frames.clear();
      });
}

/// Remote frames for which `such` holds put off the end of the life time: the event is told later.
Change counts_as_request(bool (*such)(const Frame& frame)) {
  return [such](Parts& parts) {
    const auto last = std::make_shared<BusTime>();
    deaf_to([last, such](Parts& node, const Frame& frame) {
      if (frame.remote && !frame.extended && such(frame)) *last = node.device.now;
      return false;
    })(parts);
    parts.device.outbox.add_filter([&parts, last](const FilterContext& context,
                                                  std::vector<Outgoing>& frames) {
      constexpr std::uint8_t by_guarding = 4;
      if (context.service != Service::emergency) return;
      const ObjectDictionary& od = parts.device.dictionary;
      const Duration life_time = parts.guarding.rules.life_time(od.number(0x100C, 0), od.number(0x100D, 0));
      for (Outgoing& each : frames) {
        if (each.frame.data[1] != 0x81 || each.frame.data[4] != by_guarding) continue;
        each.delay = std::max(each.delay, Duration(*last + life_time - context.now));
      }
    });
  };
}

/// Behind reset communication guard replies show the state before it, until there is a command.
void tells_the_state_before_the_reset(Parts& parts) {
  struct Memory {
    NmtState present = NmtState::pre_operational;
    std::optional<NmtState> told;
  };
  const auto memory = std::make_shared<Memory>();
  ahead_of_state_change([memory](Parts& node) { memory->present = node.device.state; })(parts);
  parts.nmt.on_reset = [memory, former = parts.nmt.on_reset](Reset kind) {
    const NmtState before = std::exchange(memory->present, NmtState::pre_operational);
    memory->told = kind == Reset::communication ? std::optional(before) : std::nullopt;
    former(kind);
  };
  deaf_to([memory](Parts&, const Frame& frame) {
    if (is_nmt_command(frame)) memory->told.reset();
    return false;
  })(parts);
  parts.device.outbox.add_filter([memory](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::guarding || !memory->told) return;
    for (Outgoing& each : frames) {
      each.frame.data[0] = static_cast<std::uint8_t>((each.frame.data[0] & toggle_bit) |
                                                     static_cast<std::uint8_t>(*memory->told));
    }
  });
}

/// A request that is not answered, since there is a heartbeat, changes the toggle bit all the same.
void toggles_unanswered(Parts& parts) {
  const auto other = since_boot_up<bool>(parts);
  deaf_to([other](Parts& node, const Frame& frame) {
    if (is_guard_request(node, frame) && node.device.dictionary.number(0x1017, 0) != 0) *other = !*other;
    return false;
  })(parts);
  parts.device.outbox.add_filter([other](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::guarding || !*other) return;
    for (Outgoing& each : frames) each.frame.data[0] ^= toggle_bit;
  });
}

/// The toggle bit begins anew where this node goes from Operational to Stopped.
void toggle_begins_anew_in_stopped(Parts& parts) {
  struct Memory {
    NmtState state = NmtState::initialising;
    bool next = false;   ///< the toggle bit that would be right
    bool other = false;  ///< the one that is sent is another
  };
  const auto memory = since_boot_up<Memory>(parts);
  ahead_of_state_change([memory](Parts& node) {
    const NmtState before = std::exchange(memory->state, node.device.state);
    if (before == NmtState::operational && memory->state == NmtState::stopped) memory->other = memory->next;
  })(parts);
  parts.device.outbox.add_filter([memory](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::guarding) return;
    for (Outgoing& each : frames) {
      memory->next = (each.frame.data[0] & toggle_bit) == 0;
      if (memory->other) each.frame.data[0] ^= toggle_bit;
    }
  });
}

void guarded_in_stopped_beside_heartbeat(Parts& parts) {
  parts.guarding.rules.is_used.replace([&parts](const auto& former, std::uint64_t heartbeat_time) {
    return parts.device.state == NmtState::stopped || former(heartbeat_time);
  });
}

/// From 1016h:03 on a stored node is looked after once its entry has been written.
void last_entries_wait_for_a_write(Parts& parts) {
  const auto written = written_since_boot_up(parts, {0x1016});
  deaf_to([written](Parts& node, const Frame& frame) {
    if (!is_heartbeat(frame)) return false;
    for (std::uint8_t sub = 3; sub <= consumer_entries(node); ++sub) {
      if (node_at(node, sub) == producer_of(frame)) return !written->contains(mux(0x1016, sub));
    }
    return false;
  })(parts);
}

/// The boot-up of a node is an event as long as an entry names it, with time 0 as well.
void tells_boot_up_of_unwatched(Parts& parts, std::vector<Frame>& frames) {
  for (const Frame& frame : frames) {
    if (!is_heartbeat(frame) || frame.data[0] != 0) continue;
    for (std::uint8_t sub = 1; sub <= consumer_entries(parts); ++sub) {
      const std::uint64_t entry = parts.device.dictionary.number(0x1016, sub);
      if (monitored_node(entry) != producer_of(frame) || monitored_time(entry) != 0) continue;
      const ErrorCause restart{0x8130, ErrorSource::heartbeat, sub};
      parts.device.errors.raise(restart, producer_of(frame));
      parts.device.errors.clear(restart);
    }
  }
}

/// NMT stop ends the watch of all nodes, until their entries are written or the node is reset.
void forgets_in_stopped_for_good(Parts& parts) {
  const auto forgotten = since_boot_up<std::set<std::uint8_t>>(parts);
  after_writing_all(0x1016, [forgotten](Parts&, const Written& former, std::uint8_t sub) {
    forgotten->erase(sub);
    former();
  })(parts);
  ahead_of_state_change([forgotten](Parts& node) {
    if (node.device.state != NmtState::stopped) return;
    node.consumer.on_reset();
    for (std::uint8_t sub = 1; sub <= consumer_entries(node); ++sub) forgotten->insert(sub);
  })(parts);
  deaf_to([forgotten](Parts& node, const Frame& frame) {
    if (!is_heartbeat(frame)) return false;
    return std::ranges::any_of(*forgotten,
                               [&](std::uint8_t sub) { return node_at(node, sub) == producer_of(frame); });
  })(parts);
}

DefectTable consumer_rows() {
  return {
      {"1016-time-0-leaves-the-boot-up",
       "The boot-up of a node that 1016h names with time 0 is a heartbeat event",
       {"OD-1016-09"},
       Reading(tells_boot_up_of_unwatched)},
      {"hbc-forgets-in-stopped",
       "NMT stop ends the monitoring of other nodes until 1016h is written",
       {"EC-HBC-03"},
       Change(forgets_in_stopped_for_good)},
      {"hbc-kept-alive-by-extended-frames",
       "A frame with the lower eleven bits of a heartbeat and 18 more keeps a monitored node alive",
       {"EC-HBC-03"},
       counts_as_heartbeat([](const Frame& frame) -> std::optional<std::uint8_t> {
         const std::uint32_t id = frame.id & 0x7FFU;
         if (!frame.extended || frame.remote || frame.size() != 1 || id <= 0x700 || id > 0x77F) return {};
         return static_cast<std::uint8_t>(id - 0x700U);
       })},
      {"hbc-kept-alive-by-emcy",
       "An EMCY keeps a monitored node alive",
       {"EC-HBC-03"},
       counts_as_heartbeat([](const Frame& frame) -> std::optional<std::uint8_t> {
         if (frame.extended || frame.remote || frame.id <= 0x80 || frame.id > 0xFF) return {};
         return static_cast<std::uint8_t>(frame.id - 0x80U);
       })},
      {"hbc-kept-alive-by-requests",
       "A guard request for a monitored node counts as its heartbeat",
       {"EC-HBC-11"},
       counts_as_heartbeat([](const Frame& frame) -> std::optional<std::uint8_t> {
         if (frame.extended || !frame.remote || frame.id <= 0x700 || frame.id > 0x77F) return {};
         return static_cast<std::uint8_t>(frame.id - 0x700U);
       })},
      {"1016-node-id-cut-to-7-bits",
       "Bit 7 of a node-ID in 1016h is not looked at",
       {"OD-1016-09"},
       Change(knows_nodes_by_seven_bits)},
      {"1016-long-time-not-monitored",
       "A node with a consumer heartbeat time from 8000h on is not monitored",
       {"EC-HBC-03", "OD-1016-11"},
       decides(
           of_consumer, &HeartbeatConsumerRules::used,
           [](const auto& former, std::uint64_t entry) { return below_the_sign(entry) && former(entry); })},
      {"1016-last-entries-stored-without-effect",
       "From 1016h:03 on stored entries monitor nobody until they are written",
       {"OD-RST-04"},
       Change(last_entries_wait_for_a_write)},
      {"hbc-second-of-two-lost",
       "Of the heartbeats of two nodes right behind each other the second one is lost",
       {"EC-HBC-04"},
       has_one_buffer_for(is_heartbeat)},
  };
}

DefectTable producer_rows() {
  return {
      {"1017-coarse-rounded-down",
       "1017h is rounded down to multiples of 10 ms",
       {"EC-HBP-11"},
       decides(of_producer, &HeartbeatProducerRules::period,
               [](const auto& former, std::int64_t value) {
                 return former(value > 10 ? value / 10 * 10 : value);
               })},
      {"heartbeat-each-256th-missing",
       "Every 256th heartbeat is left out",
       {"EC-HBP-01"},
       leaves_out_each_256th()},
      {"heartbeat-begins-anew-with-emcy",
       "An EMCY begins the period of the heartbeat anew",
       {"EC-HBP-01"},
       Change(begins_anew_with_emcy)},
      {"heartbeat-ends-with-the-same-time",
       "Writing the time to 1017h that it has ends the heartbeat",
       {"EC-HBP-01", "EC-HBP-02"},
       Change(stops_with_the_same_time)},
      {"heartbeat-waits-for-a-write",
       "The default of 1017h is a second, and there is no heartbeat until 1017h is written",
       {"EC-HBP-05"},
       Change(default_waits_for_a_write)},
      {"heartbeat-keeps-the-old-period-behind-a-reset",
       "Behind reset communication 1017h has its default of a second, and the heartbeat the period that was "
       "written before",
       {"EC-HBP-13"},
       Change(keeps_period_behind_reset_communication)},
      {"heartbeat-keeps-can-id-of-first-node-id",
       "With another node-ID the heartbeat keeps the CAN-ID of the first one",
       {"CAN-ID-01", "LSS-CN-04"},
       keeps_the_first_can_id()},
  };
}

/// When the heartbeat ends, the life time begins, whether or not anybody has guarded.
void life_time_begins_without_heartbeat(Parts& parts) {
  const auto begins = std::make_shared<bool>(false);
  parts.guarding.rules.begins_the_watch.replace(
      [begins](const auto& former, bool requested) { return *begins || former(requested); });
  after_writing(0x1017, 0, [begins](Parts& node, const Written& former) {
    former();
    const Entry* guard_time = node.device.dictionary.entry(0x100C, 0);
    if (guard_time == nullptr || node.device.dictionary.number(0x1017, 0) != 0) return;
    *begins = true;
    guard_time->written();
    *begins = false;
  })(parts);
}

Change toggle_begins_anew_with(std::uint16_t index) {
  return after_writing(index, 0, [](Parts& parts, const Written& former) {
    former();
    parts.guarding.begin_toggle_anew();
  });
}

DefectTable guarding_rows() {
  return {
      {"life-guarding-begins-with-the-end-of-the-heartbeat",
       "With 0 in 1017h the life time begins, without a guard request",
       {"EC-NG-08"},
       Change(life_time_begins_without_heartbeat)},
      {"guard-toggle-begins-anew-with-the-life-time",
       "The toggle bit begins with 0 when 100Ch or 100Dh is written, and where either is 0 nobody is answered",
       {"EC-NG-03", "EC-NG-02"},
       together(toggle_begins_anew_with(0x100C), toggle_begins_anew_with(0x100D),
                [](Parts& parts) {
                  parts.guarding.rules.is_answered_with = [](Duration life_time) {
                    return life_time > Duration::zero();
                  };
                })},
      {"guard-toggle-begins-anew-in-stopped",
       "The toggle bit begins with 0 when the node goes from Operational to Stopped",
       {"EC-NG-03", "EC-NG-02"},
       Change(toggle_begins_anew_in_stopped)},
      {"life-time-begins-with-requests-for-others",
       "A guard request for any node begins the life time anew",
       {"EC-NG-07"},
       counts_as_request([](const Frame& frame) { return frame.id > 0x700 && frame.id <= 0x77F; })},
      {"life-time-begins-with-requests-for-tpdos",
       "A remote frame for a PDO begins the life time anew",
       {"EC-NG-07"},
       counts_as_request([](const Frame& frame) { return frame.id >= 0x180 && frame.id < 0x580; })},
      {"guard-state-of-before-reset-communication",
       "Behind reset communication guard replies tell the state before it until there is an NMT command",
       {"EC-NG-01"},
       Change(tells_the_state_before_the_reset)},
      {"guard-answered-in-stopped-beside-heartbeat",
       "In Stopped guard requests are answered while the heartbeat is on",
       {"EC-HBP-12"},
       Change(guarded_in_stopped_beside_heartbeat)},
      {"guard-toggle-counts-unanswered-requests",
       "Guard requests that are not answered beside the heartbeat change the toggle bit",
       {"EC-NG-03"},
       Change(toggles_unanswered)},
  };
}

}  // namespace

DefectTable error_control_course_defects() {
  DefectTable rows = consumer_rows();
  for (DefectTable table : {producer_rows(), guarding_rows()}) append(rows, std::move(table));
  return rows;
}

}  // namespace refnode
