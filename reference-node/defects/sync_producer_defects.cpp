// SPDX-License-Identifier: Apache-2.0
// Defects of the SYNC producer: when it sends, how often, and what it counts.
#include <memory>
#include <optional>
#include <utility>

#include "defects/cob_ids.hpp"
#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

SyncProducerRules& of_producer(Parts& parts) { return parts.sync_producer.rules; }

bool has_bit31(std::uint32_t cob_id) { return (cob_id & 0x80000000U) != 0; }

/// Bit 30 of 1005h, and what else it takes.
Change produces_when(bool (*when)(Parts&, bool right, std::uint32_t cob_id)) {
  return [when](Parts& parts) {
    parts.sync.cob_id_rules.produced.replace([&parts, when](const auto& former, std::uint32_t value) {
      return when(parts, former(value), value);
    });
  };
}

Change counts_as(Rule<std::uint8_t(std::uint8_t, std::uint8_t)>::Decision next) {
  return decides(
      of_producer, &SyncProducerRules::next_count,
      [next](const auto&, std::uint8_t last, std::uint8_t overflow) { return next(last, overflow); });
}

Change goes_on_counting_after(SyncStart start) {
  return decides(
      of_producer, &SyncProducerRules::counts_anew,
      [start](const auto& former, SyncStart occasion) { return occasion != start && former(occasion); });
}

Change has_period(Duration (*as)(Duration right)) {
  return decides(of_producer, &SyncProducerRules::period,
                 [as](const auto& former, std::int64_t value) { return as(former(value)); });
}

void begin_anew(SyncProducer& producer) {
  producer.on_reset();
  producer.on_boot_up();
}

/// Entering Operational begins production anew.
void begins_anew_in_operational(Parts& parts) {
  parts.nmt.on_change = [&parts, former = parts.nmt.on_change](NmtState from) {
    former(from);
    if (parts.device.state != NmtState::operational) return;
    begin_anew(parts.sync_producer);
  };
}

/// What is written to 1006h counts as long as it is not 0.
void keeps_period(Parts& parts) {
  const auto last = std::make_shared<std::int64_t>(0);
  parts.sync_producer.rules.period.replace([last](const auto& former, std::int64_t value) {
    if (value != 0) *last = value;
    return former(*last);
  });
}

/// Once it has begun it does not end.
void stays_on(Parts& parts) {
  const auto begun = std::make_shared<bool>(false);
  parts.sync.cob_id_rules.produced.replace([begun](const auto& former, std::uint32_t value) {
    *begun = *begun || former(value);
    return *begun;
  });
}

/// What was stored is not begun with, only what is written.
void idle_until_written(Parts& parts) {
  parts.sync.cob_id_rules.produced.replace(
      [written = written_since_boot_up(parts, {0x1005, 0x1006})](const auto& former, std::uint32_t value) {
        return !written->empty() && former(value);
      });
}

/// A period that was stored is enough, until one of both is written.
void begins_with_a_stored_period(Parts& parts) {
  parts.sync.cob_id_rules.produced.replace(
      [written = written_since_boot_up(parts, {0x1005, 0x1006})](const auto& former, std::uint32_t value) {
        return written->empty() || former(value);
      });
}

/// A node that was in Stopped produces no SYNC until it is reset.
void silent_after_stopped(Parts& parts) {
  const auto stopped = std::make_shared<bool>(false);
  parts.device.works.replace([stopped](const auto& former, Service service, NmtState state) {
    if (state == NmtState::initialising) *stopped = false;
    if (state == NmtState::stopped) *stopped = true;
    return former(service, state) && !(service == Service::sync && *stopped);
  });
}

void sends_before_boot_up(Parts& parts) {
  parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
    const bool on = (parts.device.dictionary.number(0x1005, 0) & 0x40000000U) != 0;
    if (context.service == Service::boot_up && on)
      frames.insert(frames.begin(), Outgoing{conform::can::data_frame(conform::CanId(0x80), {1}), {}});
  });
}

void ends_after_20(Parts& parts) {
  const auto sent = std::make_shared<int>(0);
  parts.device.outbox.add_filter([sent](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::boot_up) *sent = 0;
    if (context.service == Service::sync && ++*sent > 20) frames.clear();
  });
}

void serves_every_second_own_sync(Parts& parts) {
  const auto odd = std::make_shared<bool>(false);
  parts.sync_producer.on_sync = [odd, former = parts.sync_producer.on_sync](auto counter) {
    *odd = !*odd;
    if (*odd) former(counter);
  };
}

Change never_works_in(NmtState state) {
  return [state](Parts& parts) {
    parts.device.works.replace([state](const auto& former, Service service, NmtState present) {
      return former(service, present) && !(service == Service::sync && present == state);
    });
  };
}

/// Behind Stopped 1006h alone decides, until one of both is written.
void produces_behind_stopped(Parts& parts) {
  const auto stopped = since_boot_up<bool>(parts);
  for (const std::uint16_t index : {std::uint16_t{0x1005}, std::uint16_t{0x1006}}) {
    after_writing(index, 0, [stopped](Parts&, const std::function<void()>& written) {
      *stopped = false;
      written();
    })(parts);
  }
  parts.sync.cob_id_rules.produced.replace(
      [stopped](const auto& former, std::uint32_t value) { return *stopped || former(value); });
  parts.nmt.on_change = [&parts, stopped, former = parts.nmt.on_change](NmtState from) {
    former(from);
    if (from != NmtState::stopped || parts.device.state == NmtState::initialising) return;
    *stopped = true;
    if (parts.sync_producer.next_wakeup()) return;
    begin_anew(parts.sync_producer);
  };
}

/// Another period is taken for another beginning.
void counts_anew_with_the_period(Parts& parts) {
  const auto anew = std::make_shared<bool>(false);
  auto& rules = parts.sync_producer.rules;
  rules.new_period.replace([anew](const auto& former, Duration present, Duration written) {
    const Duration period = former(present, written);
    *anew = *anew || period != present;
    return period;
  });
  rules.next_count.replace([anew](const auto& former, std::uint8_t last, std::uint8_t overflow) {
    return former(std::exchange(*anew, false) ? std::uint8_t{0} : last, overflow);
  });
}

/// A write of `index` that ends production takes effect behind the SYNC that is due next.
Change ends_one_later(std::uint16_t index) {
  return [index](Parts& parts) {
    const auto ending = std::make_shared<bool>(false);
    after_writing(index, 0, [ending](Parts& node, const std::function<void()>& former) {
      const bool on = (node.device.dictionary.number(0x1005, 0) & 0x40000000U) != 0;
      *ending = node.sync_producer.next_wakeup() && (!on || node.device.dictionary.number(0x1006, 0) == 0);
      if (!*ending) former();
    })(parts);
    parts.device.outbox.add_filter(
        [&parts, ending](const FilterContext& context, const std::vector<Outgoing>&) {
          if (context.service == Service::boot_up) *ending = false;
          if (context.service == Service::sync && std::exchange(*ending, false))
            parts.sync_producer.on_reset();
        });
  };
}

/// A write of `index` begins production anew; or one of the value that is there.
Change begins_anew_with(std::uint16_t index, bool of_same_value = false) {
  return [=](Parts& parts) {
    const auto restarts = std::make_shared<bool>(false);
    checking(index, 0, [=](Parts& node, const Check& former, ByteView bytes) {
      const bool same = node.device.dictionary.number(index, 0) == conform::load_le(bytes);
      *restarts = node.sync_producer.next_wakeup().has_value() && (same || !of_same_value);
      return former(bytes);
    })(parts);
    after_writing(index, 0, [restarts](Parts& node, const std::function<void()>& former) {
      former();
      if (!*restarts || !node.sync_producer.next_wakeup()) return;
      begin_anew(node.sync_producer);
    })(parts);
  };
}

/// Entering Operational from Pre-operational begins the period anew, and the counter goes on.
void begins_the_period_anew(Parts& parts) {
  struct Count {
    std::uint8_t last = 0;
    bool goes_on = false;
  };
  const auto count = std::make_shared<Count>();
  parts.sync_producer.rules.next_count.replace(
      [count](const auto& former, std::uint8_t last, std::uint8_t overflow) {
        count->last = former(std::exchange(count->goes_on, false) ? count->last : last, overflow);
        return count->last;
      });
  parts.nmt.on_change = [&parts, count, former = parts.nmt.on_change](NmtState from) {
    former(from);
    if (from != NmtState::pre_operational || parts.device.state != NmtState::operational) return;
    if (!parts.sync_producer.next_wakeup()) return;
    begin_anew(parts.sync_producer);
    count->goes_on = true;
  };
}

/// A producer that runs is not stopped by a reset, whatever its objects say behind it.
void goes_on_behind_a_reset(Parts& parts) {
  const auto period = std::make_shared<std::int64_t>(0);
  parts.nmt.on_reset = [&parts, period, former = parts.nmt.on_reset](Reset kind) {
    *period = parts.sync_producer.next_wakeup() ? parts.device.time_value(0x1006, 0) : 0;
    former(kind);
  };
  for (const std::uint16_t index : {std::uint16_t{0x1005}, std::uint16_t{0x1006}}) {
    after_writing(index, 0, [period](Parts&, const std::function<void()>& former) {
      *period = 0;
      former();
    })(parts);
  }
  parts.sync.cob_id_rules.produced.replace(
      [period](const auto& former, std::uint32_t value) { return *period != 0 || former(value); });
  parts.sync_producer.rules.period.replace(
      [period](const auto& former, std::int64_t value) { return former(*period != 0 ? *period : value); });
}

/// Stopped is left for Operational without another state in between.
void goes_on_counting_in_operational(Parts& parts) {
  parts.sync_producer.rules.counts_anew.replace([&parts](const auto& former, SyncStart occasion) {
    const bool straight = occasion == SyncStart::left_stopped && parts.device.state == NmtState::operational;
    return !straight && former(occasion);
  });
}

/// RPDOs wait for a SYNC of others.
void own_sync_takes_nothing_over(Parts& parts) {
  const auto own = std::make_shared<bool>(false);
  parts.sync_producer.on_sync = [own, former = parts.sync_producer.on_sync](auto counter) {
    *own = true;
    former(counter);
    *own = false;
  };
  parts.pdos.rpdo.rules.due_at_sync.replace(
      [own](const auto& former, const PdoParameters& pdo, std::uint32_t syncs) {
        return !*own && former(pdo, syncs);
      });
}

/// What a SYNC of its own counts is not told to the TPDOs.
void own_sync_counts_nothing(Parts& parts) {
  parts.sync_producer.on_sync = [former = parts.sync_producer.on_sync](auto) { former(std::nullopt); };
}

DefectTable switch_rows() {
  return {
      {"sync-counter-anew-with-start",
       "NMT start from Pre-operational begins the counter of SYNC anew",
       {"SYNC-PRO-04"},
       Change(begins_anew_in_operational)},
      {"sync-without-producer-bit",
       "SYNC is sent as soon as 1006h is not 0, whatever bit 30 of 1005h says",
       {"OD-1005-09", "SYNC-PRO-03"},
       decided(of_sync, &CobIdRules::produced, true)},
      {"sync-by-bit-31",
       "Bit 31 of 1005h switches the SYNC producer on",
       {"OD-1005-11", "SYNC-PRO-03"},
       produces_when([](Parts&, bool right, std::uint32_t cob_id) { return right || has_bit31(cob_id); })},
      {"sync-behind-stopped-without-producer-bit",
       "Behind Stopped SYNC is sent with the period of 1006h although bit 30 of 1005h is 0",
       {"OD-1005-09", "SYNC-PRO-03"},
       Change(produces_behind_stopped)},
      {"sync-by-odd-can-id",
       "An odd CAN-ID in 1005h switches the SYNC producer on",
       {"SYNC-PRO-03"},
       produces_when([](Parts&, bool right, std::uint32_t cob_id) { return right || (cob_id & 1U) != 0; })},
      {"sync-not-with-bit-31",
       "With bit 31 of 1005h set no SYNC is produced",
       {"OD-1005-11"},
       produces_when([](Parts&, bool right, std::uint32_t cob_id) { return right && !has_bit31(cob_id); })},
      {"sync-not-stopped-by-bit-30",
       "Clearing bit 30 of 1005h does not stop the SYNC producer",
       {"SYNC-PRO-03", "OD-1005-09"},
       stays_on},
      {"sync-not-stopped-by-period-0",
       "Writing 0 to 1006h does not stop the SYNC producer",
       {"SYNC-PRO-03"},
       keeps_period},
      {"sync-on-default-can-id",
       "SYNC is produced on 080h, whatever 1005h says",
       {"OD-1005-09"},
       reshape(Service::sync, [](const FilterContext&, Frame& frame) { frame.id = 0x80; })},
      {"sync-due-one-sent-behind-bit-30",
       "When bit 30 of 1005h is cleared the SYNC that is due next is still sent",
       {"SYNC-PRO-03"},
       ends_one_later(0x1005)},
      {"sync-due-one-sent-behind-period-0",
       "When 0 is written to 1006h the SYNC that is due next is still sent",
       {"SYNC-PRO-03"},
       ends_one_later(0x1006)},
      {"sync-anew-with-1017",
       "A write of 1017h begins the production of SYNC anew",
       {"SYNC-PRO-01"},
       begins_anew_with(0x1017)},
      {"sync-anew-with-1005",
       "A write of 1005h that changes nothing begins the production of SYNC anew",
       {"SYNC-PRO-04"},
       begins_anew_with(0x1005, true)},
      {"sync-anew-with-1006",
       "A write of the period that there is begins the production of SYNC anew",
       {"SYNC-PRO-04"},
       begins_anew_with(0x1006, true)},
      {"1005-lock-missing",
       "The CAN-ID of 1005h can be changed while SYNC is produced",
       {"OD-1005-05"},
       decided(of_sync, &CobIdRules::locked, false)},
      {"1005-bit-30-stays",
       "Clearing bit 30 of 1005h is refused",
       {"OD-1005-05", "SYNC-PRO-03"},
       refuses(0x1005, 0, abort_code::device_state,
               [](std::uint64_t present, std::uint64_t wanted) {
                 return (present & ~wanted & 0x40000000U) != 0;
               })},
      {"sync-produced-in-stopped",
       "SYNC is produced in Stopped, too",
       {"SYNC-PRO-06"},
       works_also(Service::sync, NmtState::stopped)},
      {"sync-silent-after-stopped",
       "After Stopped the SYNC producer stays silent",
       {"SYNC-PRO-06", "OD-1005-09", "SYNC-PRO-01"},
       silent_after_stopped},
      {"sync-in-operational-only",
       "SYNC is not produced in Pre-operational",
       {"SYNC-PRO-01", "SYNC-PRO-06", "NMT-SVC-01", "OD-1005-09"},
       never_works_in(NmtState::pre_operational)},
      {"sync-not-in-operational",
       "SYNC is not produced in Operational",
       {"NMT-SVC-01", "SYNC-PRO-08"},
       never_works_in(NmtState::operational)},
      {"sync-idle-until-written",
       "A SYNC producer that was stored does not run after a reset",
       {"SYNC-PRO-07"},
       idle_until_written},
      {"sync-by-a-stored-period",
       "Behind a reset SYNC is produced with a period that was stored although bit 30 of 1005h is 0",
       {"OD-1005-09", "SYNC-PRO-03"},
       begins_with_a_stored_period},
      {"sync-before-boot-up",
       "A SYNC producer that was stored begins before the boot-up message",
       {"SYNC-PRO-07"},
       sends_before_boot_up},
      {"sync-own-not-obeyed",
       "Synchronous TPDOs do not follow the SYNC that the node produces",
       {"SYNC-PRO-08"},
       [](Parts& parts) { parts.sync_producer.on_sync = nullptr; }},
      {"sync-goes-on-behind-reset",
       "SYNC is produced behind a reset as before, although 1005h and 1006h have their power-on values",
       {"NMT-FSA-24"},
       goes_on_behind_a_reset},
      {"sync-own-takes-no-rpdo-over",
       "Synchronous RPDOs do not take effect with a SYNC that the node produces",
       {"PDO-RX-03"},
       own_sync_takes_nothing_over},
      {"sync-own-without-start-value",
       "The counter of a SYNC that the node produces is not held against the SYNC start value",
       {"PDO-TX-14"},
       own_sync_counts_nothing},
      {"sync-own-obeyed-by-turns",
       "Synchronous TPDOs follow every second SYNC that the node produces",
       {"SYNC-PRO-08"},
       serves_every_second_own_sync},
      {"sync-counter-anew-with-period",
       "Another period begins the counter of SYNC anew",
       {"SYNC-PRO-04"},
       Change(counts_anew_with_the_period)},
  };
}

DefectTable period_rows() {
  return {
      {"1006-24-bits", "Of the SYNC period 24 bits count", {"SYNC-PRO-01"}, Change([](Parts& parts) {
         parts.sync_producer.rules.period.replace(
             [](const auto& former, std::int64_t value) { return former(value & 0xFFFFFF); });
       })},
      {"sync-period-in-ms",
       "1006h counts milliseconds",
       {"SYNC-PRO-01", "OD-1006-05", "OD-1005-09"},
       has_period([](Duration right) { return right * 1000; })},
      {"sync-period-of-16-bits",
       "The period of 1006h is computed in 16 bits",
       {"SYNC-PRO-01", "OD-1006-05", "OD-1005-09"},
       decides(of_producer, &SyncProducerRules::period,
               [](const auto& former, std::int64_t value) { return former(value & 0xFFFF); })},
      {"sync-period-too-long",
       "SYNC comes with a period that is a tenth too long",
       {"SYNC-PRO-01"},
       has_period([](Duration right) { return right * 11 / 10; })},
      {"sync-period-begun-anew-with-start",
       "NMT start from Pre-operational begins the period of SYNC anew",
       {"SYNC-PRO-04"},
       begins_the_period_anew},
      {"sync-period-inexact",
       "SYNC comes with a period that is three percent too short",
       {"SYNC-PRO-01"},
       has_period([](Duration right) { return right * 97 / 100; })},
      {"sync-twice",
       "Every SYNC is produced twice",
       {"SYNC-PRO-01", "SYNC-PRO-04", "OD-1005-09"},
       repeat(Service::sync)},
      {"sync-ends-after-20",
       "The SYNC producer falls silent after 20 SYNCs",
       {"SYNC-PRO-01", "OD-1005-09"},
       ends_after_20},
      {"sync-first-too-late",
       "The first SYNC comes after two periods",
       {"SYNC-PRO-02", "OD-1005-09"},
       decides(of_producer, &SyncProducerRules::first_after,
               [](const auto& former, Duration period) { return 2 * former(period); })},
      {"sync-not-begun-by-period",
       "Writing 1006h does not begin production when bit 30 of 1005h has been set before",
       {"SYNC-PRO-02"},
       after_writing(0x1006, 0,
                     [](Parts& parts, const std::function<void()>& former) {
                       const bool begun = parts.sync_producer.next_wakeup().has_value();
                       if (begun || parts.device.dictionary.number(0x1006, 0) == 0) former();
                     })},
      {"sync-new-period-ignored",
       "A change of 1006h has no effect while SYNC is produced",
       {"OD-1006-05", "SYNC-PRO-01"},
       decides(of_producer, &SyncProducerRules::new_period,
               [](const auto&, Duration present, Duration) { return present; })},
      {"sync-new-period-too-late",
       "A change of 1006h has no effect before the next SYNC of the former period",
       {"OD-1006-05"},
       decides(of_producer, &SyncProducerRules::due_after_change,
               [](const auto&, BusTime due, BusTime) { return due; })},
      {"1006-cut-to-16-bits",
       "1006h keeps the lower 16 bits of what is written",
       {"OD-1006-03"},
       after_writing(0x1006, 0,
                     [](Parts& parts, const std::function<void()>& former) {
                       Entry& period = *parts.device.dictionary.entry(0x1006, 0);
                       std::fill(period.value.begin() + 2, period.value.end(), std::uint8_t{0});
                       former();
                     })},
      {"1006-above-24-bits-refused",
       "1006h refuses periods of 16.8 s and more with 0607 0010h",
       {"OD-1006-03"},
       refuses(0x1006, 0, abort_code::length_mismatch,
               [](std::uint64_t, std::uint64_t wanted) { return wanted > 0xFFFFFF; })},
  };
}

DefectTable counter_rows() {
  return {
      {"sync-counts-from-0",
       "The SYNC counter begins with 0",
       {"SYNC-PRO-04", "SYNC-PRO-05", "SYNC-PRO-07"},
       reshape(Service::sync, [](const FilterContext&, Frame& frame) { --frame.data[0]; })},
      {"sync-count-wraps-to-0",
       "Behind the overflow value the SYNC counter is 0",
       {"SYNC-PRO-04"},
       counts_as([](std::uint8_t last, std::uint8_t overflow) -> std::uint8_t {
         return last >= overflow ? 0 : static_cast<std::uint8_t>(last + 1);
       })},
      {"sync-count-one-too-far",
       "The SYNC counter runs to one more than the overflow value",
       {"SYNC-PRO-04"},
       counts_as([](std::uint8_t last, std::uint8_t overflow) -> std::uint8_t {
         return last > overflow ? 1 : static_cast<std::uint8_t>(last + 1);
       })},
      {"sync-count-one-too-short",
       "The SYNC counter runs to one less than the overflow value",
       {"SYNC-PRO-04"},
       counts_as([](std::uint8_t last, std::uint8_t overflow) -> std::uint8_t {
         return last + 1 >= overflow ? 1 : static_cast<std::uint8_t>(last + 1);
       })},
      {"sync-count-of-8-bits",
       "The SYNC counter runs to 255, whatever the overflow value is",
       {"SYNC-PRO-04"},
       counts_as([](std::uint8_t last, std::uint8_t) -> std::uint8_t {
         return static_cast<std::uint8_t>(last + 1);
       })},
      {"sync-count-of-7-bits",
       "The SYNC counter begins anew behind 127",
       {"SYNC-PRO-04"},
       counts_as([](std::uint8_t last, std::uint8_t overflow) -> std::uint8_t {
         return last >= overflow || last >= 127 ? 1 : static_cast<std::uint8_t>(last + 1);
       })},
      {"sync-count-stands",
       "The SYNC counter is always 1",
       {"SYNC-PRO-04"},
       counts_as([](std::uint8_t, std::uint8_t) -> std::uint8_t { return 1; })},
      {"sync-without-counter",
       "SYNC has no data although 1019h has an overflow value",
       {"SYNC-PRO-04"},
       reshape(Service::sync, [](const FilterContext&, Frame& frame) { frame.dlc = 0; })},
      {"sync-always-counted",
       "SYNC has a byte although 1019h is 0",
       {"SYNC-PRO-01"},
       reshape(Service::sync, [](const FilterContext&, Frame& frame) { frame.dlc = 1; })},
      {"sync-of-eight-bytes",
       "SYNC has eight bytes",
       {"SYNC-PRO-01", "SYNC-PRO-04"},
       reshape(Service::sync, [](const FilterContext&, Frame& frame) { frame.dlc = 8; })},
      {"sync-count-survives-bit-30",
       "The SYNC counter goes on where it was when bit 30 of 1005h had been 0",
       {"SYNC-PRO-05"},
       goes_on_counting_after(SyncStart::bit_set)},
      {"sync-count-survives-period-0",
       "The SYNC counter goes on where it was when 1006h had been 0",
       {"SYNC-PRO-05", "SYNC-PRO-04"},
       goes_on_counting_after(SyncStart::period_set)},
      {"sync-count-survives-stopped",
       "The SYNC counter goes on where it was when the node leaves Stopped",
       {"SYNC-PRO-05"},
       goes_on_counting_after(SyncStart::left_stopped)},
      {"sync-count-survives-stopped-to-operational",
       "The SYNC counter goes on where it was when the node leaves Stopped for Operational",
       {"SYNC-PRO-05"},
       goes_on_counting_in_operational},
      {"1005-without-effect-in-operational",
       "Bit 30 of 1005h that is written in Operational has no effect there",
       {"OD-1005-09"},
       without_effect_in_operational(0x1005)},
      {"1006-without-effect-in-operational",
       "A period that is written in Operational has no effect there",
       {"SYNC-PRO-03"},
       without_effect_in_operational(0x1006)},
  };
}

}  // namespace

DefectTable sync_producer_defects() {
  DefectTable rows = switch_rows();
  for (DefectTable table : {period_rows(), counter_rows()}) append(rows, std::move(table));
  return rows;
}

}  // namespace refnode
