// SPDX-License-Identifier: Apache-2.0
// Finer defects of the heartbeat consumer (1016h) and producer (1017h): one state, one entry, the upper half
// of a value, the second time.
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "defects/heartbeats.hpp"
#include "defects/sdo_exchanges.hpp"
#include "defects/sdo_transfers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

/// Heartbeats in Operational do not count where 1016h was written since Operational was entered.
void monitors_what_was_written_before(Parts& parts) {
  const auto written = since_boot_up<bool>(parts);
  after_writing_all(0x1016, [written](Parts& node, const Written& former, std::uint8_t) {
    *written = *written || node.device.state == NmtState::operational;
    former();
  })(parts);
  ahead_of_state_change([written](Parts&) { *written = false; })(parts);
  deaf_to([written](Parts&, const Frame& frame) { return *written && is_heartbeat(frame); })(parts);
}

/// Heartbeats that show this state are not taken for one.
Change deaf_to_state(std::uint8_t state) {
  return deaf_to(
      [state](Parts&, const Frame& frame) { return is_heartbeat(frame) && frame.data[0] == state; });
}

template <typename Rules>
Change takes_time_for(Rules& (*part)(Parts&), Rule<Duration(std::int64_t)> Rules::* rule,
                      std::int64_t (*other)(std::int64_t)) {
  return decides(part, rule,
                 [other](const auto& former, std::int64_t value) { return former(other(value)); });
}
std::int64_t cut_to_15_bits(std::int64_t value) { return value & 0x7FFF; }
std::int64_t with_sign(std::int64_t value) { return value >= 0x8000 ? value - 0x10000 : value; }

/// 1016h:`sub` is written without the look at the other entries.
Change unchecked_where(bool (*where)(Parts&, std::uint8_t sub)) {
  return checking_all(0x1016, [where](Parts& parts, const Check& former, std::uint8_t sub, ByteView bytes) {
    const Accepted allowed = former(bytes);
    const bool duplicate = !allowed && allowed.error() == parts.consumer.choices.duplicate;
    return duplicate && where(parts, sub) ? Accepted{} : allowed;
  });
}

/// Only entries that are the same to the last bit count as two for one node.
Change compares_whole_entries() {
  return checking_all(0x1016, [](Parts& parts, const Check& former, std::uint8_t sub, ByteView bytes) {
    const Accepted allowed = former(bytes);
    if (allowed || allowed.error() != parts.consumer.choices.duplicate) return allowed;
    for (std::uint8_t other = 1; other <= consumer_entries(parts); ++other) {
      if (other != sub && parts.device.dictionary.number(0x1016, other) == conform::load_le(bytes))
        return allowed;
    }
    return Accepted{};
  });
}

Change on_entering(NmtState state, std::function<void(Parts&)> act) {
  return [state, act = std::move(act)](Parts& parts) {
    parts.nmt.on_change = [&parts, state, act, former = parts.nmt.on_change](NmtState from) {
      former(from);
      if (parts.device.state == state) act(parts);
    };
  };
}

/// A loss is reported once; the next one is not noticed until there is a reset.
Change reports_one_loss() {
  return [](Parts& parts) {
    const auto ended = std::make_shared<bool>(false);
    parts.device.errors.clear.replace([ended](const auto& former, const ErrorCause& cause) {
      if (cause.source == ErrorSource::heartbeat) *ended = true;
      former(cause);
    });
    parts.device.errors.raise.replace(
        [ended](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
          if (cause.source != ErrorSource::heartbeat || !*ended) former(cause, detail);
        });
    parts.device.outbox.add_filter([ended](const FilterContext& context, std::vector<Outgoing>&) {
      if (context.service == Service::boot_up) *ended = false;
    });
  };
}

/// The first node that is back ends the error of all that are lost.
Change first_return_ends_all() {
  return [](Parts& parts) {
    parts.device.errors.clear.replace([&parts](const auto& former, const ErrorCause& cause) {
      former(cause);
      if (cause.source != ErrorSource::heartbeat) return;
      for (std::uint8_t sub = 1; sub <= consumer_entries(parts); ++sub)
        former({cause.code, cause.source, sub});
    });
  };
}

/// Writing an entry of 1016h forgets the loss that was reported, so that no heartbeat ends its error.
Change forgets_losses_with_writing() {
  return [](Parts& parts) {
    const auto writing = std::make_shared<bool>(false);
    parts.device.errors.clear.replace([writing](const auto& former, const ErrorCause& cause) {
      if (!*writing) former(cause);
    });
    after_writing_all(0x1016, [writing](Parts&, const Written& former, std::uint8_t) {
      *writing = true;
      former();
      *writing = false;
    })(parts);
  };
}

/// The heartbeat of one node counts for that with another bit 6 of its node-ID as well.
void knows_nodes_by_six_bits(Parts&, std::vector<Frame>& frames) {
  const std::vector<Frame> received = frames;
  for (Frame frame : received) {
    if (!is_heartbeat(frame)) continue;
    frame.id ^= 0x40U;
    if (frame.id != 0x700) frames.push_back(frame);
  }
}

Change pauses_in_a_transfer() {
  return [](Parts& parts) {
    const auto transfer = std::make_shared<Transfer>();
    parts.device.outbox.add_filter([transfer](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service == Service::boot_up) *transfer = {};
      if (context.sdo != nullptr) transfer->see(*context.sdo, frames);
      if (context.service == Service::heartbeat && transfer->running != Transfer::Direction::none)
        frames.clear();
    });
  };
}

Change begins_anew_with(std::uint16_t index) {
  return after_writing(index, 0, [](Parts& parts, const std::function<void()>& former) {
    former();
    parts.producer.on_boot_up();
  });
}

Change begins_anew_with_every_download() {
  return [](Parts& parts) {
    parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>&) {
      if (context.sdo != nullptr && context.sdo->step == SdoStep::download_initiate)
        parts.producer.on_boot_up();
    });
  };
}

/// Every second heartbeat is left out in this state.
Change at_half_rate_in(NmtState state) {
  return Filter([state, odd = false](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
    if (context.service != Service::heartbeat || context.state != state) return;
    if (std::exchange(odd, !odd)) frames.clear();
  });
}

/// A write of an entry leaves the deadline that was running, where `left` says so of the node before and now.
Change keeps_deadline(bool (*left)(std::uint8_t before, std::uint8_t now)) {
  return [left](Parts& parts) {
    struct Memory {
      std::optional<std::uint8_t> node;  ///< before the write
      std::optional<Duration> rest;
    };
    const auto memory = std::make_shared<Memory>();
    checking_all(0x1016, [memory](Parts& node, const Check& former, std::uint8_t sub, ByteView bytes) {
      memory->node = node_at(node, sub);
      return former(bytes);
    })(parts);
    after_writing_all(0x1016, [memory, left](Parts& node, const Written& former, std::uint8_t sub) {
      const auto due = node.consumer.due(sub);
      former();
      const auto now = node_at(node, sub);
      if (!due || !now || !memory->node || !left(*memory->node, *now)) return;
      memory->rest = *due - node.device.now;
      node.consumer.on_heartbeat(*now, 0x05);
      memory->rest.reset();
    })(parts);
    parts.consumer.rules.time.replace([memory](const auto& former, std::int64_t value) {
      return memory->rest ? *memory->rest : former(value);
    });
  };
}

/// The heartbeats of a node are looked at once its entry has been written since the boot-up.
void monitors_written_entries_only(Parts& parts) {
  const auto written = written_since_boot_up(parts, {0x1016});
  deaf_to([written](Parts& node, const Frame& frame) {
    if (!is_heartbeat(frame)) return false;
    for (std::uint8_t sub = 1; sub <= consumer_entries(node); ++sub) {
      if (node_at(node, sub) == producer_of(frame)) return !written->contains(mux(0x1016, sub));
    }
    return false;
  })(parts);
}

}  // namespace

DefectTable error_control_monitoring_defects() {
  return {
      {"hbc-counts-operational-only",
       "Heartbeats of nodes that are not Operational do not count",
       {"EC-HBC-04"},
       deaf_to([](Parts&, const Frame& frame) { return is_heartbeat(frame) && frame.data[0] != 0x05; })},
      {"hbc-deaf-to-stopped",
       "The heartbeat of a stopped node does not count",
       {"EC-HBC-04"},
       deaf_to_state(0x04)},
      {"hbc-deaf-to-operational",
       "The heartbeat of an operational node does not count",
       {"EC-HBC-04", "EC-HBC-03"},
       deaf_to_state(0x05)},
      {"hbc-deaf-to-pre-operational",
       "The heartbeat of a node in Pre-operational does not count",
       {"EC-HBC-04"},
       deaf_to_state(0x7F)},
      {"1016-time-cut-to-15-bits",
       "The highest bit of a consumer heartbeat time is lost",
       {"OD-1016-11"},
       takes_time_for(of_consumer, &HeartbeatConsumerRules::time, cut_to_15_bits)},
      {"1016-time-signed",
       "A consumer heartbeat time from 8000h on is negative",
       {"OD-1016-11"},
       takes_time_for(of_consumer, &HeartbeatConsumerRules::time, with_sign)},
      {"1016-last-entry-duplicate-accepted",
       "The last entry of 1016h may name a node that is monitored already",
       {"OD-1016-06"},
       unchecked_where([](Parts& parts, std::uint8_t sub) { return sub == consumer_entries(parts); })},
      {"1016-first-entry-duplicate-accepted",
       "The first entry of 1016h may name a node that is monitored already",
       {"OD-1016-06"},
       unchecked_where([](Parts&, std::uint8_t sub) { return sub == 1; })},
      {"1016-duplicate-with-other-time-accepted",
       "Two entries of 1016h for one node are accepted when their times differ",
       {"OD-1016-06"},
       compares_whole_entries()},
      {"hbc-begins-with-own-heartbeat",
       "Writing 1017h begins the monitoring of other nodes, whether or not they were heard",
       {"EC-HBC-02"},
       after_writing(0x1017, 0,
                     [](Parts& parts, const Written& former) {
                       former();
                       constexpr std::uint8_t operational = 5;
                       for (std::uint8_t sub = 1; sub <= 4; ++sub)
                         parts.consumer.on_heartbeat(
                             monitored_node(parts.device.dictionary.number(0x1016, sub)), operational);
                     })},
      {"hbc-other-entry-ends-monitoring",
       "Writing another entry of 1016h ends the monitoring of the first",
       {"EC-HBC-13"},
       after_writing_all(0x1016,
                         [](Parts& parts, const Written& former, std::uint8_t sub) {
                           former();
                           if (sub != 1) parts.consumer.on_written(1);
                         })},
      {"hbc-forgets-at-start",
       "NMT start ends the monitoring of other nodes",
       {"EC-HBC-03"},
       on_entering(NmtState::operational, [](Parts& parts) { parts.consumer.on_reset(); })},
      {"hbc-reports-one-loss",
       "Only the first loss of a heartbeat is noticed",
       {"EC-HBC-07", "EC-HBC-03"},
       reports_one_loss()},
      {"hbc-first-return-ends-all",
       "Of two lost nodes the first that is back ends the error",
       {"EC-HBC-07"},
       first_return_ends_all()},
      {"hbc-deaf-in-stopped",
       "Heartbeats that come in Stopped do not count",
       {"EC-HBC-04"},
       deaf_to([](Parts& parts, const Frame& frame) {
         return parts.device.state == NmtState::stopped && is_heartbeat(frame);
       })},
      {"hbc-loss-forgotten-by-writing",
       "Writing 1016h behind a loss leaves its error for ever",
       {"EC-HBC-07"},
       forgets_losses_with_writing()},
      {"hbc-goes-on-over-reset",
       "A consumer heartbeat time that runs goes on over a reset",
       {"EC-HBC-02"},
       decides(of_consumer, &HeartbeatConsumerRules::ends_with_reset, [](const auto&) { return false; })},
      {"hbc-node-id-in-6-bits",
       "Bit 6 of the node-ID of a monitored node is not looked at",
       {"EC-HBC-09"},
       Reading(knows_nodes_by_six_bits)},
      {"1017-cut-to-15-bits",
       "The highest bit of the producer heartbeat time is lost",
       {"EC-HBP-11"},
       takes_time_for(of_producer, &HeartbeatProducerRules::period, cut_to_15_bits)},
      {"heartbeat-pauses-in-a-transfer",
       "While a segmented transfer is open there is no heartbeat",
       {"EC-HBP-09"},
       pauses_in_a_transfer()},
      {"heartbeat-begins-anew-with-downloads",
       "Every SDO download starts the period of the heartbeat anew",
       {"EC-HBP-09"},
       begins_anew_with_every_download()},
      {"heartbeat-begins-anew-with-guard-time",
       "Another value of 100Ch or 100Dh starts the period of the heartbeat anew",
       {"EC-HBP-09"},
       together(begins_anew_with(0x100C), begins_anew_with(0x100D))},
      {"heartbeat-at-half-rate-in-operational",
       "In Operational the heartbeat comes at half the rate",
       {"EC-HBP-01"},
       at_half_rate_in(NmtState::operational)},
      {"heartbeat-at-half-rate-in-stopped",
       "In Stopped the heartbeat comes at half the rate",
       {"EC-HBP-01"},
       at_half_rate_in(NmtState::stopped)},
      {"1016-longer-time-waits-for-next-heartbeat",
       "Another time in 1016h leaves the deadline that is running",
       {"EC-HBC-04"},
       keeps_deadline([](std::uint8_t before, std::uint8_t now) { return before == now; })},
      {"1016-other-node-inherits-deadline",
       "An entry of 1016h that names another node goes on with the deadline of the former one",
       {"EC-HBC-02"},
       keeps_deadline([](std::uint8_t before, std::uint8_t now) { return before != now; })},
      {"1016-time-0-leaves-the-watch",
       "Time 0 in 1016h leaves the deadline that is running",
       {"OD-1016-09"},
       decides(of_consumer, &HeartbeatConsumerRules::ends_with_write,
               [](const auto&, std::uint64_t entry) { return monitored_time(entry) != 0; })},
      {"1016-node-ids-above-127-monitored",
       "An entry of 1016h with a node-ID from 80h on is monitored with CAN-IDs from 780h on",
       {"OD-1016-09"},
       together(decides(of_consumer, &HeartbeatConsumerRules::used,
                        [](const auto& former, std::uint64_t entry) {
                          return former(entry) || (monitored_time(entry) != 0 && monitored_node(entry) > 127);
                        }),
                misreads([](Parts& node, Frame& frame) {
                  if (frame.id >= 0x780 && frame.size() == 1 && !frame.extended && !frame.remote)
                    node.consumer.on_heartbeat(producer_of(frame), frame.data[0]);
                }))},
      {"1016-stored-entry-not-monitored",
       "An entry of 1016h that was stored monitors nobody until it is written",
       {"EC-HBC-03", "OD-RST-04"},
       Change(monitors_written_entries_only)},
      {"heartbeat-put-off-by-nmt-command",
       "With every change of the NMT state the time to the next heartbeat begins anew",
       {"EC-HBP-10"},
       ahead_of_state_change([](Parts& parts) { parts.producer.on_boot_up(); })},
      {"1017-without-effect-in-operational",
       "A heartbeat time that is written in Operational has no effect until the next reset",
       {"EC-HBP-02", "EC-HBP-04"},
       without_effect_in_operational(0x1017)},
      {"1016-without-effect-in-operational",
       "A node whose entry was written in Operational is not monitored until the next change of the state",
       {"EC-HBC-03"},
       Change(monitors_what_was_written_before)},
  };
}

}  // namespace refnode
