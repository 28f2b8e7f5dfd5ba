// SPDX-License-Identifier: Apache-2.0
// Defects of the high resolution time stamp (1013h) and of the TIME producer; those of 1012h are with the
// other COB-IDs.
#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "defects/cob_ids.hpp"
#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u16 = DataType::unsigned16;

ClockRules& of_clock(Parts& parts) { return parts.clock.rules; }

/// 1013h starts there after a reset; a time that is written is kept.
Change clock_starts_at(std::uint32_t start) {
  return together(reading(0x1013, 0,
                          [start](Parts&, const Read& former) -> Upload {
                            const Upload ticks = former();
                            if (!ticks) return ticks;
                            return conform::to_le(conform::load_le(*ticks) + start, ticks->size());
                          }),
                  checking(0x1013, 0, [start](Parts&, const Check& former, ByteView bytes) {
                    return former(conform::to_le(conform::load_le(bytes) - start, bytes.size()));
                  }));
}

/// What was written last is there again after a reset.
void written_time_survives_resets(Parts& parts) {
  const auto last = std::make_shared<Bytes>();
  checking(0x1013, 0, [last](Parts&, const Check& former, ByteView bytes) {
    last->assign(bytes.begin(), bytes.end());
    return former(bytes);
  })(parts);
  parts.device.outbox.add_filter([&parts, last](const FilterContext& context, std::vector<Outgoing>&) {
    const Entry* entry = parts.device.dictionary.entry(0x1013, 0);
    if (context.service == Service::boot_up && !last->empty() && entry != nullptr) [[maybe_unused]]
      const Accepted set = entry->check(*last);
  });
}

/// A time that is written is added to the one that is there.
Change adds_written_time() {
  return checking(0x1013, 0, [](Parts& parts, const Check& former, ByteView bytes) {
    const Entry* entry = parts.device.dictionary.entry(0x1013, 0);
    const Upload present = entry != nullptr && entry->read ? entry->read() : Upload(Bytes(4, 0));
    return former(conform::to_le(conform::load_le(bytes) + conform::load_le(*present), bytes.size()));
  });
}

/// Behind a time that was written the clock stops with the last one that there is.
Change stops_at_the_end() {
  return [](Parts& parts) {
    const auto written = since_boot_up<std::uint64_t>(parts);
    checking(0x1013, 0, [written](Parts&, const Check& former, ByteView bytes) {
      *written = conform::load_le(bytes);
      return former(bytes);
    })(parts);
    reading(0x1013, 0, [written](Parts&, const Read& former) {
      Upload ticks = former();
      if (ticks && conform::load_le(*ticks) < *written) ticks->assign(ticks->size(), 0xFF);
      return ticks;
    })(parts);
  };
}

/// A TIME message that is received loses bits of one byte.
Change consumes_without(std::size_t byte, std::uint8_t bits) {
  return misreads([=](Parts& parts, Frame& frame) {
    const auto id = static_cast<std::uint32_t>(parts.device.dictionary.number(0x1012, 0) & 0x7FFU);
    if (frame.id == id && !frame.extended && !frame.remote && frame.size() == 6)
      frame.data[byte] &= static_cast<std::uint8_t>(~bits);
  });
}

/// The clock of the producer is set to the milliseconds and the four bits above them.
void sets_clock_by_reserved_bits(Parts& parts) {
  const auto reserved = std::make_shared<std::uint32_t>(0);
  parts.device.inbox.add_filter([reserved](std::vector<Frame>& frames) {
    for (const Frame& frame : frames)
      if (frame.size() == 6) *reserved = frame.data[3] & 0xF0U;
  });
  parts.time.on_time_of_day = [reserved, former = parts.time.on_time_of_day](std::uint32_t milliseconds,
                                                                             std::uint16_t days) {
    former(milliseconds | (*reserved << 24U), days);
  };
}

TimeProducerRules& of_producer(Parts& parts) { return parts.time_producer.rules; }

/// TIME tells another time than it is.
Change tells(TimeOfDay (*as)(TimeOfDay right)) {
  return decides(
      of_producer, &TimeProducerRules::time_of_day,
      [as](const auto& former, std::chrono::milliseconds since_epoch) { return as(former(since_epoch)); });
}

/// Once it has begun it does not end.
void stays_on(Parts& parts) {
  const auto begun = std::make_shared<bool>(false);
  parts.time.cob_id_rules.produced.replace([begun](const auto& former, std::uint32_t value) {
    *begun = *begun || former(value);
    return *begun;
  });
}

/// The first time is told again and again.
void stands_still(Parts& parts) {
  const auto first = std::make_shared<Bytes>();
  parts.device.outbox.add_filter([first](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::time) return;
    for (Outgoing& each : frames) {
      if (first->empty()) first->assign(each.frame.data.begin(), each.frame.data.begin() + 6);
      std::ranges::copy(*first, each.frame.data.begin());
    }
  });
}

/// A node that was in Stopped tells no time until it is reset, or 1012h is written.
void silent_after_stopped(Parts& parts) {
  const auto stopped = std::make_shared<bool>(false);
  parts.device.works.replace([stopped](const auto& former, Service service, NmtState state) {
    if (state == NmtState::initialising) *stopped = false;
    if (state == NmtState::stopped) *stopped = true;
    return former(service, state) && !(service == Service::time && *stopped);
  });
  after_writing(0x1012, 0, [stopped](Parts&, const std::function<void()>& former) {
    *stopped = false;
    former();
  })(parts);
}

/// Where another one tells the time this one does not any more.
Change ends_with_a_received_time() {
  return misreads([](Parts& parts, Frame& frame) {
    const std::uint64_t cob_id = parts.device.dictionary.number(0x1012, 0);
    constexpr std::uint32_t consumed = 0x80000000U;
    if ((cob_id & consumed) != 0 && frame.id == (cob_id & 0x7FFU) && !frame.extended && !frame.remote)
      parts.time_producer.on_reset();
  });
}

DefectTable producer_rows() {
  constexpr std::uint32_t day = 86'400'000;
  return {
      {"time-without-producer-bit",
       "TIME is sent whatever bit 30 of 1012h says",
       {"TIME-PRO-01"},
       decided(of_time, &CobIdRules::produced, true)},
      {"time-not-stopped-by-bit-30",
       "Clearing bit 30 of 1012h does not stop the TIME producer",
       {"TIME-PRO-01"},
       stays_on},
      {"time-on-default-can-id",
       "TIME is produced on 100h, whatever 1012h says",
       {"TIME-PRO-01"},
       reshape(Service::time, [](const FilterContext&, Frame& frame) { frame.id = 0x100; })},
      {"time-of-eight-bytes",
       "TIME has eight bytes",
       {"TIME-PRO-01"},
       reshape(Service::time, [](const FilterContext&, Frame& frame) { frame.dlc = 8; })},
      {"time-without-days",
       "TIME has four bytes",
       {"TIME-PRO-01"},
       reshape(Service::time, [](const FilterContext&, Frame& frame) { frame.dlc = 4; })},
      {"time-reserved-bits-set",
       "The reserved bits of TIME are 1",
       {"TIME-PRO-01"},
       reshape(Service::time, [](const FilterContext&, Frame& frame) { frame.data[3] |= 0xF0U; })},
      {"time-most-significant-first",
       "TIME is sent with the most significant byte first",
       {"TIME-PRO-01"},
       reshape(Service::time,
               [](const FilterContext&, Frame& frame) {
                 std::reverse(frame.data.begin(), frame.data.begin() + 4);
                 std::swap(frame.data[4], frame.data[5]);
               })},
      {"time-stands-still", "TIME always tells the same time", {"TIME-PRO-01"}, stands_still},
      {"time-in-seconds",
       "TIME counts seconds after midnight",
       {"TIME-PRO-01"},
       tells([](TimeOfDay right) -> TimeOfDay { return {right.milliseconds / 1000, right.days}; })},
      {"time-beyond-midnight",
       "The milliseconds of TIME run on over midnight",
       {"TIME-PRO-01"},
       tells([](TimeOfDay right) -> TimeOfDay {
         const bool past = right.milliseconds < day / 2;
         return {right.milliseconds + (past ? day : 0),
                 static_cast<std::uint16_t>(right.days - (past ? 1 : 0))};
       })},
      {"time-same-day-after-midnight",
       "The days of TIME do not count over midnight",
       {"TIME-PRO-01"},
       tells([](TimeOfDay right) -> TimeOfDay { return {right.milliseconds, 10'000}; })},
      {"time-days-since-1970",
       "The days of TIME are counted from 1970",
       {"TIME-PRO-01"},
       tells([](TimeOfDay right) -> TimeOfDay {
         return {right.milliseconds, static_cast<std::uint16_t>(right.days + 5113)};
       })},
      {"time-days-of-15-bits",
       "The days of TIME that is produced have 15 bits",
       {"TIME-PRO-01"},
       tells([](TimeOfDay right) -> TimeOfDay {
         return {right.milliseconds, static_cast<std::uint16_t>(right.days & 0x7FFFU)};
       })},
      {"time-not-produced-by-a-consumer",
       "With bits 31 and 30 of 1012h both set no TIME is produced",
       {"TIME-PRO-01"},
       decides(of_time, &CobIdRules::produced,
               [](const auto& former, std::uint32_t value) {
                 return former(value) && (value & 0x80000000U) == 0;
               })},
      {"time-clock-set-by-reserved-bits",
       "The clock of the producer takes the reserved bits of a TIME message for milliseconds",
       {"TIME-CON-02"},
       sets_clock_by_reserved_bits},
      {"time-consumed-days-of-15-bits",
       "Of the days of a TIME message 15 bits are taken",
       {"TIME-CON-01"},
       consumes_without(5, 0x80)},
      {"time-consumed-in-26-bits",
       "Of the milliseconds of a TIME message 26 bits are taken",
       {"TIME-CON-01"},
       consumes_without(3, 0x0C)},
      {"time-silent-after-stopped",
       "After Stopped no TIME is produced until 1012h is written",
       {"TIME-PRO-01"},
       silent_after_stopped},
      {"time-ended-by-a-received-one",
       "A TIME message that is received ends the production of TIME",
       {"TIME-PRO-01"},
       ends_with_a_received_time()},
      {"time-produced-in-stopped",
       "TIME is produced in Stopped, too",
       {"TIME-PRO-02"},
       works_also(Service::time, NmtState::stopped)},
  };
}

DefectTable clock_rows() {
  return {
      {"1013-is-u16", "1013h has two bytes", {"OD-1013-01", "OD-LEN-04", "OD-GEN-17"}, type(0x1013, 0, u16)},
      {"1013-not-writable",
       "1013h is read-only although it is declared as writable",
       {"OD-1013-03", "OD-1013-02", "SDO-DNL-21"},
       access(0x1013, 0, Access::ro)},
      {"1013-survives-reset",
       "The time that was written to 1013h is there again after a reset",
       {"OD-1013-04"},
       written_time_survives_resets},
      {"1013-adds-what-is-written",
       "What is written to 1013h is added to the time that it holds",
       {"OD-1013-03"},
       adds_written_time()},
      {"1013-write-ignored",
       "A time written to 1013h is confirmed and forgotten",
       {"OD-1013-03"},
       confirms(0x1013, 0, [](std::uint64_t) { return true; })},
      {"1013-default-nonzero",
       "1013h does not begin with 0 after a reset",
       {"OD-1013-04"},
       clock_starts_at(0x12345678)},
      {"1013-stops-at-the-end",
       "1013h stays at FFFF FFFFh instead of beginning with 0 again",
       {"OD-1013-03"},
       stops_at_the_end()},
      {"1013-unit-ms",
       "1013h counts milliseconds",
       {"OD-1013-05"},
       decides(of_clock, &ClockRules::ticks,
               [](const auto& former, Duration elapsed) { return former(elapsed) / 1000; })},
      {"1012-without-effect-in-operational",
       "Bit 30 of 1012h that is written in Operational has no effect there",
       {"TIME-PRO-01"},
       without_effect_in_operational(0x1012)},
  };
}

}  // namespace

DefectTable time_defects() {
  DefectTable rows = clock_rows();
  DefectTable more = producer_rows();
  append(rows, std::move(more));
  return rows;
}

}  // namespace refnode
