// SPDX-License-Identifier: Apache-2.0
// Defects of PDO, SYNC, TIME and EMCY that need an unusual course: a service beside the one that fails, a
// value that is written once more, a state or a reset between two steps, a number that divides no other.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "defects/cob_ids.hpp"
#include "defects/emergencies.hpp"
#include "defects/pdos.hpp"
#include "defects/receivers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

struct Sync {
  std::optional<std::uint8_t> counter;
  std::optional<BusTime> at;
};

/// The last SYNC that was received.
std::shared_ptr<Sync> last_sync(Parts& parts) {
  const auto last = since_boot_up<Sync>(parts);
  parts.sync.on_sync = [&parts, last, former = parts.sync.on_sync](std::optional<std::uint8_t> counter) {
    *last = {counter, parts.device.now};
    former(counter);
  };
  return last;
}

Change with_second_start(std::function<void(Parts&)> act) {
  return deaf_to([act = std::move(act)](Parts& parts, const Frame& frame) {
    const bool again = is_nmt_command(frame) && is_for(parts, frame) && frame.data[0] == nmt_command::start &&
                       parts.device.state == NmtState::operational;
    if (again) act(parts);
    return false;
  });
}

// TPDO

void counts_by_the_counter(Parts& parts) {
  parts.pdos.tpdo.rules.sent_at_sync.replace([last = last_sync(parts)](const auto& former,
                                                                       const PdoParameters& pdo,
                                                                       std::uint32_t syncs, bool event) {
    const unsigned type = pdo.transmission_type();
    if (type == 0 || !is_synchronous(type) || !last->counter || pdo.sync_start() != 0)
      return former(pdo, syncs, event);
    return *last->counter % type == 0;
  });
}

void begins_with_every_start_value(Parts& parts) {
  parts.pdos.tpdo.rules.sent_at_sync.replace([last = last_sync(parts)](const auto& former,
                                                                       const PdoParameters& pdo,
                                                                       std::uint32_t syncs, bool event) {
    const unsigned type = pdo.transmission_type();
    const bool begins = pdo.sync_start() != 0 && last->counter == pdo.sync_start();
    return (begins && type != 0 && is_synchronous(type)) || former(pdo, syncs, event);
  });
}

/// The event timer of these TPDOs does not run until a TPDO is sent, or the state changes.
std::shared_ptr<std::set<std::uint16_t>> without_event_timer(Parts& parts) {
  const auto dead = since_state_change<std::set<std::uint16_t>>(parts);
  auto& rules = parts.pdos.tpdo.rules;
  rules.carried.replace([dead](const auto& former, const PdoParameters& pdo, const Bytes& due) {
    dead->erase(pdo.number());
    return former(pdo, due);
  });
  rules.has_event_timer.replace([dead](const auto& former, const PdoParameters& pdo) {
    return !dead->contains(pdo.number()) && former(pdo);
  });
  return dead;
}

void stops_with_the_same_time(Parts& parts) {
  const auto dead = without_event_timer(parts);
  for (std::uint16_t number = 0; number <= last_pdo; ++number) {
    checking(nth(0x1800, number), 5, [=](Parts& node, const Check& former, ByteView bytes) {
      const bool same = conform::load_le(bytes) == node.device.dictionary.number(nth(0x1800, number), 5);
      dead->erase(number);
      if (same) dead->insert(number);
      return former(bytes);
    })(parts);
  }
}

void misses_changes_by_segments(Parts& parts) {
  const auto segment = std::make_shared<bool>(false);
  deaf_to([segment](Parts& node, const Frame& frame) {
    *segment = frame.id == 0x600U + node.device.node_id && frame.size() == 8 && frame.data[0] < 0x20;
    return false;
  })(parts);
  parts.pdos.tpdo.rules.is_event.replace(
      [segment](const auto& former, const PdoParameters& pdo, const Bytes& sent, const Bytes& now) {
        return !*segment && former(pdo, sent, now);
      });
}

void one_sample_for_all(Parts& parts) {
  struct Memory {
    Bytes sample;
    std::set<std::uint16_t> sampled;
  };
  const auto memory = since_state_change<Memory>(parts);
  auto& rules = parts.pdos.tpdo.rules;
  rules.sampled.replace(
      [memory](const auto& former, const PdoParameters& pdo, const Bytes& held, const Bytes& now) {
        memory->sample = former(pdo, held, now);
        memory->sampled.insert(pdo.number());
        return memory->sample;
      });
  rules.carried.replace([memory](const auto& former, const PdoParameters& pdo, const Bytes& due) {
    const bool wrong =
        pdo.transmission_type() == remote_synchronous_type && memory->sampled.contains(pdo.number());
    if (!wrong) return former(pdo, due);
    Bytes data = memory->sample;
    data.resize(due.size());
    return data;
  });
}

/// Objects of two bytes at an odd place get their bytes swapped.
void swap_odd_words(const ObjectDictionary& od, std::uint16_t mapping, Frame& frame) {
  std::size_t position = 0;  // in bits
  for (std::uint8_t sub = 1; sub <= od.number(mapping, 0) && sub <= most_mapped; ++sub) {
    const auto bits = static_cast<std::size_t>(od.number(mapping, sub) & 0xFFU);
    if (bits == 16 && position % 16 == 8 && position + bits <= frame.size() * 8)
      std::swap(frame.data[position / 8], frame.data[position / 8 + 1]);
    position += bits;
  }
}

void holds_back_behind_the_window(Parts& parts) {
  parts.pdos.tpdo.rules.sent_with_event.replace(
      [&parts, last = last_sync(parts)](const auto& former, const PdoParameters& pdo) {
        const Duration window = std::chrono::microseconds(parts.device.time_value(0x1007, 0));
        const bool late = window > Duration::zero() && last->at && parts.device.now - *last->at > window;
        return !late && former(pdo);
      });
}

/// TPDOs are sent as another type says.
void sent_as(Parts& parts, std::function<std::uint8_t(const PdoParameters&)> type) {
  auto& rules = parts.pdos.tpdo.rules;
  rules.sent_at_sync.replace(
      [type](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
        const std::uint8_t used = type(pdo);
        if (used == pdo.transmission_type()) return former(pdo, syncs, event);
        return used == 0 ? event : is_synchronous(used) && syncs >= used;
      });
  const auto event_driven = [type](const auto&, const PdoParameters& pdo) {
    return is_event_driven(type(pdo));
  };
  rules.sent_with_event.replace(event_driven);
  rules.has_event_timer.replace(event_driven);
}

void ignores_the_stored_types(Parts& parts) {
  const auto written = written_since_boot_up(parts, {0x1800, 0x1801, 0x1802, 0x1803});
  sent_as(parts, [written, &od = parts.device.dictionary](const PdoParameters& pdo) {
    const std::uint16_t index = nth(0x1800, pdo.number());
    const Entry* entry = od.entry(index, 2);
    return entry == nullptr || written->contains(mux(index, 2)) ? pdo.transmission_type()
                                                                : entry->default_value.front();
  });
}

void keeps_the_inhibit_times(Parts& parts) {
  parts.pdos.tpdo.parameters.rules.inhibit_time.replace(
      [written = written_ever(parts, 0x1800, 3)](const auto& former, const PdoParameters& pdo,
                                                 std::int64_t value) {
        const auto found = written->find(pdo.number());
        return former(pdo, found == written->end() ? value : static_cast<std::int64_t>(found->second));
      });
}

void counts_anew_with_second_start(Parts& parts) {
  struct Count {
    std::uint32_t last = 0, before = 0;
  };
  const auto counts = since_state_change<std::map<std::uint16_t, Count>>(parts);
  with_second_start([counts](Parts&) {
    for (auto& [number, count] : *counts) count.before = count.last;
  })(parts);
  parts.pdos.tpdo.rules.sent_at_sync.replace(
      [counts](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
        Count& count = (*counts)[pdo.number()];
        if (syncs <= count.last) count = {};  // it was sent, or set anew
        count.last = syncs;
        return former(pdo, syncs - count.before, event);
      });
}

/// The PDO behind one that was switched off does not work either.
Change takes_the_next_along(ReceivePdoRules& (*part)(Parts&), std::uint16_t first) {
  return [part, first](Parts& parts) {
    const auto written = written_since_boot_up(parts, {nth(first, 0), nth(first, 1), nth(first, 2)});
    part(parts).valid.replace(
        [=, &od = parts.device.dictionary](const auto& former, const PdoParameters& pdo) {
          const auto before = static_cast<std::uint16_t>(first + pdo.number() - 1);
          const bool off =
              pdo.number() != 0 && written->contains(mux(before, 1)) && (od.number(before, 1) & bit_31) != 0;
          return !off && former(pdo);
        });
  };
}

void empties_the_third(Parts& parts) {
  parts.pdos.rpdo.parameters.rules.mapping.replace(
      [&od = parts.device.dictionary](const auto& former, const PdoParameters& pdo,
                                      const std::vector<Mapped>& counted) {
        const bool empty = pdo.number() == third_pdo && od.number(0x1601, 0) == 0;
        return empty ? std::vector<Mapped>{} : former(pdo, counted);
      });
}

// RPDO

void stops_with_the_same_cob_id(Parts& parts) {
  const auto dead = since_boot_up<std::set<std::uint16_t>>(parts);
  for (std::uint16_t number = 0; number <= last_pdo; ++number) {
    checking(rpdo_communication(number), 1, [=](Parts& node, const Check& former, ByteView bytes) {
      const auto present = node.device.dictionary.number(rpdo_communication(number), 1);
      const bool same = present == conform::load_le(bytes) && (present & bit_31) == 0;
      dead->erase(number);
      if (same) dead->insert(number);
      return former(bytes);
    })(parts);
  }
  parts.pdos.rpdo.rules.valid.replace([dead](const auto& former, const PdoParameters& pdo) {
    return !dead->contains(pdo.number()) && former(pdo);
  });
}

void second_start_drops_what_waits(Parts& parts) {
  const auto dropped = since_state_change<std::map<std::uint16_t, bool>>(parts);
  with_second_start([dropped](Parts&) {
    for (auto& [number, gone] : *dropped) gone = true;
  })(parts);
  auto& rules = parts.pdos.rpdo.rules;
  rules.kept_for_sync.replace([dropped](const auto& former, const PdoParameters& pdo,
                                        const std::optional<Bytes>& waiting, const Bytes& received) {
    (*dropped)[pdo.number()] = false;
    return former(pdo, waiting, received);
  });
  rules.due_at_sync.replace([dropped](const auto& former, const PdoParameters& pdo, std::uint32_t syncs) {
    return !(*dropped)[pdo.number()] && former(pdo, syncs);
  });
}

void closed_before_the_first_sync(Parts& parts) {
  parts.pdos.rpdo.in_window = [&parts, last = last_sync(parts), former = parts.pdos.rpdo.in_window] {
    return (last->at || parts.device.dictionary.number(0x1007, 0) == 0) && former();
  };
}

// SYNC and TIME

/// A CAN-ID that comes with the order to produce is used from the next order on.
Change produces_on_former(std::uint16_t index, Service service) {
  return [=](Parts& parts) {
    const auto used = since_boot_up<std::optional<std::uint32_t>>(parts);
    checking(index, 0, [=](Parts& node, const Check& former, ByteView bytes) {
      const auto present = static_cast<std::uint32_t>(node.device.dictionary.number(index, 0));
      const auto wanted = static_cast<std::uint32_t>(conform::load_le(bytes));
      const Accepted taken = former(bytes);
      if (!taken || ((present & wanted) & bit_30) != 0) return taken;
      used->reset();
      if ((wanted & bit_30) != 0 && ((present ^ wanted) & can_id_bits) != 0) *used = present & can_id_bits;
      return taken;
    })(parts);
    parts.device.outbox.add_filter([=](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service != service || !*used) return;
      for (Outgoing& each : frames) each.frame.id = **used;
    });
  };
}

void misses_midnight(Parts& parts) {
  deaf_to([](Parts& node, const Frame& frame) {
    const bool such = !frame.extended && !frame.remote && frame.size() == 6 &&
                      frame.id == (node.device.dictionary.number(0x1012, 0) & can_id_bits);
    return such && (conform::load_le(frame.bytes()) & 0x0FFF'FFFFU) == 0;
  })(parts);
}

// EMCY

void loses_the_third_that_waits(Parts& parts) {
  // Codes, and whether they are lost.
  const auto memory = since_boot_up<std::vector<std::pair<std::uint16_t, bool>>>(parts);
  parts.device.errors.raise.replace(
      [memory, &parts](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
        const auto& active = parts.emergency.active();
        if (std::ranges::find(active, cause) == active.end())
          memory->emplace_back(cause.code, memory->size() >= 2);
        former(cause, detail);
      });
  parts.device.outbox.add_filter([memory](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::emergency || frames.empty() || is_error_reset(frames.front())) return;
    const auto code =
        static_cast<std::uint16_t>(frames.front().frame.data[0] | frames.front().frame.data[1] << 8U);
    auto& raised = *memory;
    const auto found = std::ranges::find(raised, code, &std::pair<std::uint16_t, bool>::first);
    if (found == raised.end()) return;
    if (found->second) frames.clear();
    raised.erase(raised.begin(), found + 1);
  });
}

void keeps_errors_of_another_state(Parts& parts) {
  const auto begun = since_boot_up<std::vector<std::pair<ErrorCause, NmtState>>>(parts);
  Errors& errors = parts.device.errors;
  errors.raise.replace(
      [begun, &device = parts.device](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
        if (std::ranges::find(*begun, cause, &std::pair<ErrorCause, NmtState>::first) == begun->end())
          begun->emplace_back(cause, device.state);
        former(cause, detail);
      });
  errors.clear.replace([begun, &device = parts.device](const auto& former, const ErrorCause& cause) {
    const auto found = std::ranges::find(*begun, cause, &std::pair<ErrorCause, NmtState>::first);
    if (found == begun->end()) return former(cause);
    if (found->second != device.state) return;
    begun->erase(found);
    former(cause);
  });
}

void silent_behind_others(Parts& parts) {
  const auto heard = since_boot_up<bool>(parts);
  deaf_to([heard](Parts& node, const Frame& frame) {
    for (std::uint8_t sub = 1; sub <= EmergencyConsumer::producers; ++sub) {
      const auto cob_id = node.device.dictionary.number(0x1028, sub, bit_31);
      const bool such = !frame.extended && !frame.remote && frame.size() == 8 && frame.id == cob_id;
      *heard = *heard || such;
    }
    return false;
  })(parts);
  parts.device.outbox.add_filter([heard](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::emergency && std::exchange(*heard, false)) frames.clear();
  });
}

/// Only the lowest eight bits of the CAN-ID are locked.
Change locks_the_low_byte(std::uint16_t index) {
  return checking_all(
      index, [index](Parts& parts, const Check& former, std::uint8_t sub, ByteView bytes) -> Accepted {
        const auto present = parts.device.dictionary.number(index, sub);
        const auto wanted = conform::load_le(bytes);
        const auto moved = present ^ wanted;
        if (moved != 0 && (moved & ~std::uint64_t{0x700}) == 0 && !restricted_can_id(wanted & can_id_bits))
          return {};
        return former(bytes);
      });
}

SyncWindowRules& of_window(Parts& parts) { return parts.sync_window.rules; }

}  // namespace

DefectTable pdo_rare_defects() {
  return {
      {"tpdo-type-n-by-the-counter",
       "A TPDO of type n is sent with the SYNCs whose counter is a multiple of n",
       {"PDO-TX-06"},
       counts_by_the_counter},
      {"tpdo-sync-count-anew-with-each-start-value",
       "A TPDO begins to count anew with every SYNC that has its start value",
       {"PDO-TX-14", "PDO-TX-06"},
       begins_with_every_start_value},
      {"tpdo-sync-start-at-the-overflow-value",
       "A TPDO whose SYNC start value is the overflow value is never sent",
       {"PDO-TX-14"},
       Change([](Parts& parts) {
         parts.pdos.tpdo.rules.counting_begins.replace(
             [&od = parts.device.dictionary](const auto& former, const PdoParameters& pdo,
                                             std::optional<std::uint8_t> counter) {
               return former(pdo, counter) && !(counter && *counter == od.number(0x1019, 0));
             });
       })},
      {"tpdo-same-event-time-stops-it",
       "A write of the event time that a TPDO has ends its event timer",
       {"PDO-TX-09"},
       stops_with_the_same_time},
      {"tpdo-change-by-segments-not-seen",
       "A change that a segmented download makes is no event of a TPDO",
       {"PDO-TX-08"},
       misses_changes_by_segments},
      {"tpdo-type-fch-one-sample-for-all",
       "All TPDOs of type FCh share the room for what the SYNC sampled",
       {"PDO-TX-20"},
       one_sample_for_all},
      {"rpdo-word-at-odd-place-swapped",
       "An object of two bytes that begins at an odd byte of an RPDO gets its bytes swapped",
       {"PDO-RX-01", "OD-1600-15"},
       misreads([](Parts& parts, Frame& frame) {
         if (frame.extended || frame.remote) return;
         if (const auto number = rpdo_with(parts.device.dictionary, frame.id))
           swap_odd_words(parts.device.dictionary, nth(0x1600, *number), frame);
       })},
      {"tpdo-event-driven-late-not-sent",
       "The change of an event-driven TPDO behind the window of 1007h is not sent",
       {"PDO-TX-08"},
       holds_back_behind_the_window},
      {"tpdo-inhibit-time-in-use-outlives-reset",
       "Behind reset communication the inhibit time of a TPDO is the one that was written before",
       {"NMT-FSA-24"},
       keeps_the_inhibit_times},
      {"tpdo-stored-type-not-used",
       "A TPDO whose type was stored is sent as its default type says until 18xxh:02 is written",
       {"OD-1010-10"},
       ignores_the_stored_types},
      {"1005-stored-can-id-not-used",
       "SYNC is taken on its default CAN-ID until 1005h is written, whatever was stored",
       {"OD-1010-10"},
       Change([](Parts& parts) {
         parts.sync.cob_id_rules.can_id.replace(
             [written = written_since_boot_up(parts, {0x1005})](const auto& former, std::uint32_t value,
                                                                std::uint32_t at_power_on) {
               return former(written->empty() ? at_power_on : value, at_power_on);
             });
       })},
      {"1015-stored-not-used",
       "The inhibit time of EMCY is 0 until 1015h is written, whatever was stored",
       {"EMCY-INH-01", "OD-1010-10"},
       Change([](Parts& parts) {
         parts.emergency.rules.inhibit_time.replace(
             [written = written_since_boot_up(parts, {0x1015})](const auto& former, std::int64_t value) {
               return former(written->empty() ? 0 : value);
             });
       })},
      {"tpdo-sync-count-anew-with-second-start",
       "NMT start in Operational begins the count of SYNCs of TPDOs anew",
       {"PDO-TX-06", "NMT-FSA-13"},
       counts_anew_with_second_start},
      {"rpdo-switched-off-with-the-one-before",
       "An RPDO is not received while the one before it is switched off",
       {"PDO-RX-01"},
       takes_the_next_along(rpdo_traffic, 0x1400)},
      {"rpdo-third-without-mapping-of-the-second",
       "The third RPDO is not received while the mapping of the second one is switched off",
       {"PDO-RX-01"},
       empties_the_third},
      {"rpdo-same-cob-id-stops-it",
       "A write of the COB-ID that a valid RPDO has ends its reception",
       {"PDO-RX-01"},
       stops_with_the_same_cob_id},
      {"rpdo-waiting-dropped-by-second-start",
       "NMT start in Operational drops what waits for the SYNC",
       {"PDO-RX-03", "NMT-FSA-13"},
       second_start_drops_what_waits},
      {"rpdo-before-the-first-window-lost",
       "With a window in 1007h a synchronous RPDO before the first SYNC is discarded",
       {"PDO-RX-03"},
       closed_before_the_first_sync},
      {"1007-16-bits",
       "Of the window of 1007h 16 bits count",
       {"OD-1007-03", "PDO-RX-03"},
       decides(of_window, &SyncWindowRules::length,
               [](const auto& former, std::int64_t value) { return former(value & 0xFFFF); })},
      {"1800-inhibit-time-not-locked-in-operational",
       "The inhibit time of a valid TPDO can be changed in Operational",
       {"OD-1800-18"},
       Change([](Parts& parts) {
         parts.pdos.tpdo.parameters.rules.locked.replace(
             [&device = parts.device](const auto& former, const PdoParameters& pdo, PdoPart part, bool valid,
                                      bool enabled) {
               const bool open = part == PdoPart::inhibit_time && device.state == NmtState::operational;
               return !open && former(pdo, part, valid, enabled);
             });
       })},
      {"sync-two-bytes-with-counter-unnoticed",
       "A SYNC with a byte behind its counter causes no EMCY",
       {"SYNC-CON-05"},
       misreads([](Parts& parts, Frame& frame) {
         if (!is_sync(parts, frame) || frame.size() < 2 || parts.device.dictionary.number(0x1019, 0) < 2)
           return;
         frame = conform::can::data_frame(conform::CanId(frame.id), {frame.data[0]});
       })},
      {"sync-can-id-written-with-bit-30",
       "A CAN-ID that is written to 1005h together with bit 30 is not used: SYNC is sent with the former one",
       {"OD-1005-09"},
       produces_on_former(0x1005, Service::sync)},
      {"1019-in-use-outlives-reset",
       "Behind reset communication SYNC needs the counter that 1019h asked for before",
       {"SYNC-CON-03", "NMT-FSA-24"},
       Change([](Parts& parts) {
         parts.sync.rules.length.replace(
             [written = written_ever(parts, 0x1019, 0, 1)](const auto& former, std::uint64_t overflow) {
               return former(written->empty() ? overflow : written->begin()->second);
             });
       })},
      {"sync-anew-with-second-start",
       "NMT start in Operational begins the production of SYNC anew",
       {"SYNC-PRO-04", "NMT-FSA-13"},
       with_second_start([](Parts& parts) {
         parts.sync_producer.on_reset();
         parts.sync_producer.on_boot_up();
       })},
      {"1019-lock-sees-16-bits-of-the-period",
       "1019h can be changed while the lower 16 bits of the period are 0",
       {"OD-1019-05"},
       checking(0x1019, 0,
                [](Parts& parts, const Check& former, ByteView bytes) {
                  const bool open = (parts.device.dictionary.number(0x1006, 0) & 0xFFFFU) == 0;
                  const bool good = bytes[0] != 1 && bytes[0] <= 240;
                  return open && good ? Accepted{} : former(bytes);
                })},
      {"time-of-midnight-ignored", "A TIME message of midnight is ignored", {"TIME-CON-01"}, misses_midnight},
      {"time-can-id-written-with-bit-30",
       "A CAN-ID that is written to 1012h together with bit 30 is not used: TIME is sent with the former one",
       {"TIME-PRO-01", "CAN-TRF-02"},
       produces_on_former(0x1012, Service::time)},
      {"1015-in-use-outlives-reset",
       "Behind reset communication the inhibit time of EMCY is the one that was written before",
       {"EMCY-INH-02", "NMT-FSA-24"},
       Change([](Parts& parts) {
         parts.emergency.rules.inhibit_time.replace(
             [written = written_ever(parts, 0x1015, 0, 1)](const auto& former, std::int64_t value) {
               return former(written->empty() ? value : static_cast<std::int64_t>(written->begin()->second));
             });
       })},
      {"emcy-third-waiting-lost",
       "While two errors wait for the inhibit time of EMCY a third one is not told",
       {"EMCY-INH-01"},
       loses_the_third_that_waits},
      {"1001-keeps-error-of-another-state",
       "An error that ends in another NMT state than it began in stays in 1001h",
       {"OD-1001-06", "EMCY-SEQ-02"},
       keeps_errors_of_another_state},
      {"emcy-lost-behind-that-of-another",
       "The first EMCY behind one of another node that is consumed is not sent",
       {"EMCY-SEQ-01"},
       silent_behind_others},
      {"1028-lock-without-upper-bits",
       "Bits 10 to 8 of the CAN-ID of a valid entry of 1028h can be changed",
       {"OD-1028-06"},
       locks_the_low_byte(0x1028)},
  };
}

}  // namespace refnode
