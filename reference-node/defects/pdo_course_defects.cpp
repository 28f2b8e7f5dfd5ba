// SPDX-License-Identifier: Apache-2.0
// Defects of PDOs that show in what follows only: what a received PDO does to the process, what a parameter
// leaves behind, what a long count of SYNCs brings.
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "defects/pdos.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr std::uint32_t sync_can_id = 0x080;

/// CAN-IDs that the pre-defined connection set gives to RPDOs: function codes 4, 6, 8 and 10.
bool is_rpdo(const Frame& frame) {
  const auto function = frame.id >> 7U;
  return function == 4 || function == 6 || function == 8 || function == 10;
}

/// Whether what is written now was brought by an RPDO, at once or with a SYNC.
std::shared_ptr<bool> brought_by_rpdo(Parts& parts) {
  auto answer = std::make_shared<bool>(false);
  misreads([answer](Parts&, Frame& frame) { *answer = is_rpdo(frame) || frame.id == sync_can_id; })(parts);
  return answer;
}

void leaves_outputs_alone(Parts& parts) {
  const auto by_rpdo = brought_by_rpdo(parts);
  for (const std::uint16_t outputs : std::to_array<std::uint16_t>({0x6200, 0x6411, 0x6412})) {
    after_writing_all(outputs, [by_rpdo](Parts&, const std::function<void()>& former, std::uint8_t) {
      if (!*by_rpdo) former();
    })(parts);
  }
}

void sees_no_change_by_rpdo(Parts& parts) {
  const auto by_rpdo = brought_by_rpdo(parts);
  parts.pdos.tpdo.rules.is_event.replace(
      [by_rpdo](const auto& former, const PdoParameters& pdo, const Bytes& sent, const Bytes& now) {
        return !*by_rpdo && former(pdo, sent, now);
      });
}

/// What was taken with a SYNC comes once more before each that follows, until another RPDO comes.
void takes_again_with_sync(Parts& parts) {
  const auto taken = std::make_shared<bool>(false);
  parts.pdos.rpdo.rules.taken_at_sync.replace(
      [taken](const auto& former, const PdoParameters& pdo, const Bytes& waiting) {
        *taken = true;
        return former(pdo, waiting);
      });
  misreads([taken, last = std::make_shared<std::optional<Frame>>()](Parts& node, Frame& frame) {
    if (is_rpdo(frame)) {
      *last = frame;
      *taken = false;
    }
    if (frame.id == sync_can_id && *taken && *last) node.pdos.on_frame(**last);
  })(parts);
}

/// Type FCh: before the first SYNC since it was written there is nothing that was sampled, and nothing is
/// sent.
void empty_before_sync(Parts& parts) {
  const auto sampled = std::make_shared<std::set<std::uint16_t>>();
  auto& rules = parts.pdos.tpdo.rules;
  rules.takes_effect.replace([sampled](const auto& former, const PdoParameters& pdo) {
    sampled->erase(pdo.number());
    return former(pdo);
  });
  rules.sent_at_sync.replace(
      [sampled](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
        sampled->insert(pdo.number());
        return former(pdo, syncs, event);
      });
  rules.carried.replace([sampled](const auto& former, const PdoParameters& pdo, const Bytes& due) -> Bytes {
    const bool early = pdo.transmission_type() == remote_synchronous_type && !sampled->contains(pdo.number());
    return early ? Bytes{} : former(pdo, due);
  });
}

Change maps_one_bit_of_anything(PdoRulesPart of) {
  return decides(of, &PdoRules::mappable, [](const auto& former, const Mapped& mapped) {
    return mapped.bits == 1 ? Accepted{} : former(mapped);
  });
}

/// What waited for its SYNC at a reset takes effect with the first SYNC behind it.
void waits_over_a_reset(Parts& parts) {
  struct Memory {
    std::optional<Frame> last, waiting;
  };
  const auto memory = std::make_shared<Memory>();
  parts.pdos.rpdo.rules.kept_for_sync.replace(
      [memory](const auto& former, const PdoParameters& pdo, const auto& before, const Bytes& received) {
        memory->waiting = memory->last;
        return former(pdo, before, received);
      });
  parts.pdos.rpdo.rules.taken_at_sync.replace(
      [memory](const auto& former, const PdoParameters& pdo, const Bytes& waiting) {
        memory->waiting.reset();
        return former(pdo, waiting);
      });
  misreads([memory](Parts& node, Frame& frame) {
    if (is_rpdo(frame)) memory->last = frame;
    if (frame.id == sync_can_id && memory->waiting) node.pdos.on_frame(Frame(*memory->waiting));
  })(parts);
  // Only a reset leaves it: there is no such change then.
  ahead_of_state_change([memory](Parts& node) {
    if (node.device.state != NmtState::operational) memory->waiting.reset();
  })(parts);
}

/// What came in Pre-operational takes effect with the first SYNC in Operational.
void waits_for_operational(Parts& parts) {
  const auto waiting = since_boot_up<std::optional<Frame>>(parts);
  misreads([waiting](Parts& node, Frame& frame) {
    const NmtState state = node.device.state;
    if (is_rpdo(frame) && state == NmtState::pre_operational) *waiting = frame;
    if (is_rpdo(frame) && state == NmtState::operational) waiting->reset();
    if (frame.id != sync_can_id || state != NmtState::operational || !*waiting) return;
    node.pdos.on_frame(**waiting);
    waiting->reset();
  })(parts);
}

/// What was found first since the NMT state changed counts until it changes again.
template <typename Value>
std::shared_ptr<std::map<std::uint16_t, Value>> found_first(Parts& parts) {
  const auto found = std::make_shared<std::map<std::uint16_t, Value>>();
  ahead_of_state_change([found](Parts&) { found->clear(); })(parts);
  return found;
}

void needs_the_first_length(Parts& parts) {
  const auto lengths = found_first<std::size_t>(parts);
  parts.pdos.rpdo.rules.processed.replace(
      [lengths](const auto& former, const PdoParameters& pdo, std::size_t received, std::size_t mapped) {
        return former(pdo, received, lengths->try_emplace(pdo.number(), mapped).first->second);
      });
}

void keeps_the_first_way(Parts& parts) {
  const auto waits = found_first<bool>(parts);
  parts.pdos.rpdo.rules.waits_for_sync.replace([waits](const auto& former, const PdoParameters& pdo) {
    return waits->try_emplace(pdo.number(), former(pdo)).first->second;
  });
}

void sends_the_first_length(Parts& parts) {
  const auto lengths = found_first<std::size_t>(parts);
  parts.pdos.tpdo.rules.carried.replace(
      [lengths](const auto& former, const PdoParameters& pdo, const Bytes& due) {
        Bytes sent = former(pdo, due);
        sent.resize(lengths->try_emplace(pdo.number(), sent.size()).first->second);
        return sent;
      });
}

/// The number of SYNCs is compared for equality, and a type that is written leaves it as it is.
/// What came before Operational waits in the mailbox, and is taken when it is entered.
void takes_what_came_before(Parts& parts) {
  const auto waiting = since_boot_up<std::map<std::uint32_t, Frame>>(parts);
  misreads([waiting](Parts& node, Frame& frame) {
    if (is_rpdo(frame) && node.device.state != NmtState::operational) (*waiting)[frame.id] = frame;
  })(parts);
  ahead_of_state_change([waiting](Parts& node) {
    if (node.device.state != NmtState::operational) return;
    for (const auto& [id, frame] : *waiting) node.device.inbox.put(frame, node.device.now);
    waiting->clear();
  })(parts);
}

/// The count of SYNCs does not begin anew with the PDO that it has sent.
void sends_with_all_that_follow(Parts& parts) {
  const auto reached = since_boot_up<std::set<const PdoParameters*>>(parts);
  ahead_of_state_change([reached](Parts&) { reached->clear(); })(parts);
  parts.pdos.tpdo.rules.sent_at_sync.replace(
      [reached](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
        const std::uint8_t type = pdo.transmission_type();
        if (type < 1 || !is_synchronous(type)) return former(pdo, syncs, event);
        if (former(pdo, syncs, event)) reached->insert(&pdo);
        return reached->contains(&pdo);
      });
}

/// With Operational the first four TPDOs have the CAN-IDs of the pre-defined connection set again.
void back_to_default_can_ids(Parts& parts) {
  const auto moved = std::make_shared<std::map<std::uint32_t, std::uint32_t>>();
  ahead_of_state_change([moved](Parts& node) {
    moved->clear();
    if (node.device.state != NmtState::operational) return;
    for (std::uint16_t i = 0; i < 4; ++i) {
      const auto id = node.device.dictionary.number(static_cast<std::uint16_t>(0x1800 + i), 1) & 0x7FFU;
      (*moved)[static_cast<std::uint32_t>(id)] = 0x180U + 0x100U * i + node.device.node_id;
    }
  })(parts);
  for (std::uint16_t i = 0; i < 4; ++i) {
    after_writing(static_cast<std::uint16_t>(0x1800 + i), 1,
                  [moved](Parts&, const std::function<void()>& former) {
                    former();
                    moved->clear();
                  })(parts);
  }
  parts.device.outbox.add_filter([moved](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::tpdo) return;
    for (Outgoing& each : frames) {
      const auto former = moved->find(each.frame.id);
      if (former != moved->end()) each.frame.id = former->second;
    }
  });
}

void waits_for_the_very_number(Parts& parts) {
  auto& rules = parts.pdos.tpdo.rules;
  rules.takes_effect.replace([](const auto& former, const PdoParameters& pdo) {
    return !is_synchronous(pdo.transmission_type()) && former(pdo);
  });
  rules.sent_at_sync.replace(
      [](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
        const std::uint8_t type = pdo.transmission_type();
        const bool cyclic = type >= 1 && is_synchronous(type);
        return former(pdo, syncs, event) && (!cyclic || (syncs & 0xFFU) == type);
      });
}

/// An event timer that is running is not disturbed by another time that is written.
void timer_runs_to_its_end(Parts& parts) {
  const auto times = since_boot_up<std::map<std::uint16_t, Duration>>(parts);
  parts.pdos.tpdo.rules.takes_effect.replace([times](const auto& former, const PdoParameters& pdo) {
    const Duration now = pdo.event_timer();
    const Duration before = std::exchange((*times)[pdo.number()], now);
    const bool runs = before > Duration::zero() && now > Duration::zero() && before != now;
    return !runs && former(pdo);
  });
}

/// Remote frames with any CAN-ID that a TPDO has been sent with ask for it.
void answers_on_former_can_ids(Parts& parts) {
  const auto used = std::make_shared<std::map<std::uint32_t, std::uint16_t>>();
  parts.device.outbox.add_filter([&parts, used](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::boot_up) used->clear();
    if (context.service != Service::tpdo) return;
    for (const Outgoing& each : frames) {
      for (std::uint16_t index = 0x1800; index < 0x1A00; ++index) {
        const auto cob_id = parts.device.dictionary.number(index, 1, 0x80000000U);
        if ((cob_id & 0x800007FFU) == each.frame.id) used->insert_or_assign(each.frame.id, index);
      }
    }
  });
  misreads([used](Parts& node, Frame& frame) {
    const auto former = used->find(frame.id);
    if (frame.remote && !frame.extended && former != used->end())
      frame.id = static_cast<std::uint32_t>(node.device.dictionary.number(former->second, 1) & 0x7FFU);
  })(parts);
}

/// What is sent behind the inhibit time are the data of the first change within it.
void sends_the_first_change(Parts& parts) {
  struct Memory {
    std::optional<Bytes> first;
    bool made_up = false;
  };
  const auto memory = std::make_shared<std::map<std::uint16_t, Memory>>();
  auto& rules = parts.pdos.tpdo.rules;
  rules.is_event.replace(
      [memory](const auto& former, const PdoParameters& pdo, const Bytes& sent, const Bytes& now) {
        const bool event = former(pdo, sent, now);
        auto& first = (*memory)[pdo.number()].first;
        if (event && !first) first = now;
        return event;
      });
  rules.made_up_for.replace([memory](const auto& former, const PdoParameters& pdo) {
    return (*memory)[pdo.number()].made_up = former(pdo);
  });
  rules.carried.replace([memory](const auto& former, const PdoParameters& pdo, const Bytes& due) {
    const Memory before = std::exchange((*memory)[pdo.number()], {});
    return former(pdo, before.made_up && before.first ? *before.first : due);
  });
  ahead_of_state_change([memory](Parts&) { memory->clear(); })(parts);
}

/// A change that waits for the inhibit time is sent although the TPDO is switched off before.
void waiting_change_outlives_validity(Parts& parts) {
  const auto waiting = since_boot_up<std::set<std::uint16_t>>(parts);
  auto& rules = parts.pdos.tpdo.rules;
  rules.held_back.replace([waiting](const auto& former, const PdoParameters& pdo, TransmitCause cause) {
    const bool held = former(pdo, cause);
    if (held) waiting->insert(pdo.number());
    return held;
  });
  rules.takes_effect.replace([waiting](const auto& former, const PdoParameters& pdo) {
    return !waiting->contains(pdo.number()) && former(pdo);
  });
  rules.valid.replace([waiting](const auto& former, const PdoParameters& pdo) {
    return waiting->contains(pdo.number()) || former(pdo);
  });
  rules.carried.replace([waiting](const auto& former, const PdoParameters& pdo, const Bytes& due) {
    waiting->erase(pdo.number());
    return former(pdo, due);
  });
  ahead_of_state_change([waiting](Parts&) { waiting->clear(); })(parts);
}

/// A change that waits for the inhibit time is sent although the device leaves Operational before.
void waiting_change_outlives_operational(Parts& parts) {
  struct Memory {
    BusTime inhibited_until{};
    std::optional<Frame> waiting;
  };
  const auto memory = std::make_shared<std::map<std::uint16_t, Memory>>();
  auto& rules = parts.pdos.tpdo.rules;
  rules.is_event.replace([memory](const auto& former, const PdoParameters& pdo, const Bytes& sent,
                                  const Bytes& now) {
    const bool event = former(pdo, sent, now);
    if (event && is_event_driven(pdo.transmission_type()))
      (*memory)[pdo.number()].waiting = conform::can::data_frame(conform::CanId(pdo.cob_id().can_id()), now);
    return event;
  });
  rules.carried.replace([&parts, memory](const auto& former, const PdoParameters& pdo, const Bytes& due) {
    (*memory)[pdo.number()] = {parts.device.now + pdo.inhibit_time(), std::nullopt};
    return former(pdo, due);
  });
  ahead_of_state_change([memory](Parts& node) {
    Device& device = node.device;
    for (const auto& [number, each] : *memory) {
      if (each.waiting && each.inhibited_until > device.now)
        device.outbox.send({Service::tpdo, device.node_id, device.state, nullptr},
                           {{*each.waiting, each.inhibited_until - device.now}}, device.now);
    }
    memory->clear();
  })(parts);
}

/// What the mapping of an RPDO holds beyond its count receives what comes beyond the mapped bytes, where that
/// is as long as the object.
void fills_beyond_the_count(Parts& parts) {
  misreads([](Parts& node, Frame& frame) {
    ObjectDictionary& od = node.device.dictionary;
    if (frame.extended || frame.remote || node.device.state != NmtState::operational) return;
    for (std::uint16_t number = 0; number <= last_pdo; ++number) {
      const auto mapping = static_cast<std::uint16_t>(0x1600 + number);
      if (frame.id != (od.number(static_cast<std::uint16_t>(0x1400 + number), 1) & 0x7FFU)) continue;
      const auto count = static_cast<std::uint8_t>(od.number(mapping, 0));
      std::size_t at = 0;
      for (std::uint8_t sub = 1; sub <= count && sub <= most_mapped; ++sub)
        at += (od.number(mapping, sub) & 0xFFU) / 8;
      const Mapped next = Mapped::unpack(od.number(mapping, static_cast<std::uint8_t>(count + 1)));
      Entry* entry = od.entry(next.index, next.sub);
      if (count == 0 || entry == nullptr || !entry->rx_mappable) continue;
      if (frame.size() < at + entry->value.size()) continue;
      const auto from = frame.data.begin() + static_cast<std::ptrdiff_t>(at);
      entry->value.assign(from, from + std::ssize(entry->value));
    }
  })(parts);
}

/// The acceptance filter of RPDOs compares ten bits; what belongs to another service has been taken out
/// before.
void compares_ten_bits(Parts& parts) {
  misreads([](Parts& node, Frame& frame) {
    constexpr std::uint32_t highest_bit = 0x400;
    constexpr std::uint32_t first_of_sdo = 0x580;
    if (frame.extended || frame.remote || frame.id <= sync_can_id || frame.id >= first_of_sdo) return;
    for (std::uint16_t index = 0x1400; index <= 0x1400 + last_pdo; ++index) {
      if (node.device.dictionary.number(index, 1) == (frame.id ^ highest_bit)) {
        frame.id ^= highest_bit;
        return;
      }
    }
  })(parts);
}

}  // namespace

DefectTable pdo_course_defects() {
  return {
      {"rpdo-outputs-left-alone",
       "What an RPDO brings is written to the object, and does not reach the output",
       {"PDO-RX-01"},
       Change(leaves_outputs_alone)},
      {"tpdo-change-by-rpdo-ignored",
       "A change that an RPDO makes is no event of a TPDO",
       {"PDO-TX-08"},
       Change(sees_no_change_by_rpdo)},
      {"rpdo-taken-again-with-every-sync",
       "A synchronous RPDO takes effect with each SYNC that follows",
       {"PDO-RX-03"},
       Change(takes_again_with_sync)},
      {"rpdo-deadline-not-switched-off",
       "Event timer 0 of an RPDO leaves the former time in force",
       {"PDO-RX-15"},
       decides_by<std::map<std::uint16_t, std::int64_t>>(
           rpdo_parameters, &PdoRules::event_timer,
           [](auto& before, const auto& former, const PdoParameters& pdo, std::int64_t value) {
             if (value != 0) before[pdo.number()] = value;
             return former(pdo, before[pdo.number()]);
           })},
      {"tpdo-type-fch-empty-before-sync",
       "A TPDO of type FCh answers a remote frame before the first SYNC without data",
       {"PDO-TX-01"},
       Change(empty_before_sync)},
      {"tpdo-type-fdh-sent-after-253-syncs",
       "A TPDO of type FDh is sent with every 253rd SYNC",
       {"PDO-TX-19"},
       decides(tpdo_traffic, &TransmitPdoRules::sent_at_sync,
               [](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
                 const bool counted =
                     pdo.transmission_type() == remote_event_driven_type && syncs >= remote_event_driven_type;
                 return counted || former(pdo, syncs, event);
               })},
      {"1600-single-bit-of-anything",
       "One bit of any object, also of an absent one, can be mapped to an RPDO",
       {"OD-1600-06", "PDO-MAP-18"},
       maps_one_bit_of_anything(rpdo_parameters)},
      {"1a00-single-bit-of-anything",
       "One bit of any object, also of an absent one, can be mapped to a TPDO",
       {"OD-1A00-06", "PDO-MAP-18"},
       maps_one_bit_of_anything(tpdo_parameters)},
      {"rpdo-waiting-outlives-reset",
       "A synchronous RPDO that waits for its SYNC takes effect with the first SYNC behind a reset",
       {"NMT-FSA-25"},
       Change(waits_over_a_reset)},
      {"rpdo-of-pre-operational-waits-for-sync",
       "A synchronous RPDO that came in Pre-operational takes effect with the first SYNC in Operational",
       {"PDO-RX-02"},
       Change(waits_for_operational)},
      {"rpdo-of-other-states-taken-at-start",
       "What an RPDO brought before Operational takes effect when it is entered",
       {"PDO-RX-02"},
       Change(takes_what_came_before)},
      {"tpdo-with-every-sync-behind-the-nth",
       "A TPDO of type n is sent with the n-th SYNC and with all that follow",
       {"PDO-TX-06"},
       Change(sends_with_all_that_follow)},
      {"tpdo-can-id-back-at-start",
       "With NMT start a TPDO that was moved is sent with its default CAN-ID",
       {"OD-1800-11", "PDO-TX-04"},
       Change(back_to_default_can_ids)},
      {"rpdo-length-of-the-first",
       "An RPDO that is mapped anew in Operational needs as many bytes as before",
       {"PDO-MAP-22", "PDO-RX-01"},
       Change(needs_the_first_length)},
      {"rpdo-type-of-the-first",
       "An RPDO whose type is written in Operational takes effect as before",
       {"PDO-RX-03"},
       Change(keeps_the_first_way)},
      {"tpdo-length-of-the-first",
       "A TPDO that is mapped anew in Operational is as long as before",
       {"PDO-TX-01", "PDO-MAP-22"},
       Change(sends_the_first_length)},
      {"tpdo-smaller-type-waits-for-256-syncs",
       "A smaller transmission type that is written in Operational waits until the count of SYNCs runs over",
       {"PDO-TX-06"},
       Change(waits_for_the_very_number)},
      {"tpdo-event-timer-runs-to-its-end",
       "Another event timer of a TPDO waits for the end of the one that is running",
       {"PDO-TX-09"},
       Change(timer_runs_to_its_end)},
      {"tpdo-answers-on-former-can-id",
       "A TPDO that was moved answers remote frames with its former CAN-ID, too",
       {"PDO-TX-01"},
       Change(answers_on_former_can_ids)},
      {"tpdo-first-change-sent-after-inhibit-time",
       "Of several changes within the inhibit time the first one is sent at its end",
       {"PDO-TX-01"},
       Change(sends_the_first_change)},
      {"rpdo-fills-beyond-the-count",
       "A longer RPDO fills what its mapping holds beyond the number of mapped objects",
       {"PDO-RX-07"},
       Change(fills_beyond_the_count)},
      {"rpdo-can-id-10-bits",
       "The CAN-ID of an RPDO is compared in ten bits",
       {"OD-1400-11"},
       Change(compares_ten_bits)},
      {"tpdo-waiting-sent-when-not-valid",
       "A change that waits for the inhibit time is sent although the TPDO is not valid any more",
       {"OD-1800-06", "OD-1800-09"},
       Change(waiting_change_outlives_validity)},
      {"tpdo-waiting-sent-outside-operational",
       "A change that waits for the inhibit time is sent although the device is not Operational any more",
       {"PDO-TX-02"},
       Change(waiting_change_outlives_operational)},
  };
}

}  // namespace refnode
