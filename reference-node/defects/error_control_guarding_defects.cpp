// SPDX-License-Identifier: Apache-2.0
// Defects of node guarding and life guarding (100Ch, 100Dh).
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "defects/hooks.hpp"
#include "defects/receivers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr std::uint8_t toggle_bit = 0x80;

GuardingRules& of_guarding(Parts& parts) { return parts.guarding.rules; }

void ends_operational_whatever(Parts& parts) {
  parts.guarding.on_loss = [&parts] {
    if (parts.device.state == NmtState::operational) parts.nmt.enter(NmtState::pre_operational);
  };
}

void tells_life_guarding_again(const FilterContext& context, std::vector<Outgoing>& frames) {
  constexpr std::uint8_t by_guarding = 4;
  if (context.service != Service::emergency || frames.empty()) return;
  const Frame frame = frames.front().frame;
  if (frame.data[0] == 0x30 && frame.data[1] == 0x81 && frame.data[4] == by_guarding)
    frames.push_back({frame, std::chrono::milliseconds(200)});
}

/// In Operational, where such a timer runs.
void ends_with_event_timers(Parts& parts) {
  parts.guarding.rules.life_time.replace(
      [&parts](const auto& former, std::uint64_t guard_time, std::uint64_t factor) -> Duration {
        Duration time = former(guard_time, factor);
        if (parts.device.state != NmtState::operational) return time;
        for (std::uint16_t index = 0x1800; index <= 0x1803; ++index) {
          const auto ticks =
              std::chrono::milliseconds(static_cast<std::int64_t>(parts.device.dictionary.number(index, 5)));
          if (ticks.count() > 0) time = std::min<Duration>(time, ticks);
        }
        return time;
      });
}

Change life_time(Duration (*wrong)(std::uint64_t guard_time, std::uint64_t factor)) {
  return decides(of_guarding, &GuardingRules::life_time,
                 [wrong](const auto&, std::uint64_t guard_time, std::uint64_t factor) {
                   return wrong(guard_time, factor);
                 });
}

/// The toggle bit of replies is counted on its own and begins with 0 again where `begins` says so.
Change toggle_restarts(bool (*begins)(NmtState before, NmtState now, bool node_was_reset)) {
  return [begins](Parts& parts) {
    struct Memory {
      bool toggle = false, node_reset = false;
      NmtState state = NmtState::initialising;
    };
    auto memory = std::make_shared<Memory>();
    parts.device.inbox.add_filter([memory](std::vector<Frame>& frames) {
      for (const Frame& frame : frames) {
        if (frame.id == 0 && frame.size() == 2 && frame.data[0] >= 0x81)
          memory->node_reset = frame.data[0] == 0x81;
      }
    });
    parts.device.outbox.add_filter(
        [memory, begins](const FilterContext& context, std::vector<Outgoing>& frames) {
          if (context.service == Service::boot_up) {
            if (begins(memory->state, NmtState::initialising, memory->node_reset)) memory->toggle = false;
            memory->state = NmtState::pre_operational;
          }
          if (context.service != Service::guarding) return;
          if (context.state != memory->state && begins(memory->state, context.state, false))
            memory->toggle = false;
          memory->state = context.state;
          for (Outgoing& outgoing : frames) {
            outgoing.frame.data[0] &= static_cast<std::uint8_t>(~toggle_bit);
            if (std::exchange(memory->toggle, !memory->toggle)) outgoing.frame.data[0] |= toggle_bit;
          }
        });
  };
}

/// A reply is as long as the request asks for.
void length_as_asked(Parts& parts) {
  auto asked = std::make_shared<std::uint8_t>(1);
  parts.device.inbox.add_filter([&parts, asked](std::vector<Frame>& frames) {
    for (const Frame& frame : frames) {
      if (is_guard_request(parts, frame)) *asked = frame.dlc;
    }
  });
  parts.device.outbox.add_filter([asked](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::guarding) return;
    for (Outgoing& outgoing : frames) outgoing.frame.dlc = *asked;
  });
}

/// After a life guarding event nothing is answered until a reset.
void dumb_after_the_event(Parts& parts) {
  auto lost = std::make_shared<bool>(false);
  parts.guarding.on_loss = [lost, former = parts.guarding.on_loss] {
    *lost = true;
    if (former) former();
  };
  parts.device.outbox.add_filter([lost](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::boot_up) *lost = false;
    if (context.service == Service::guarding && *lost) frames.clear();
  });
}

/// The second life guarding event behind a reset is not noticed.
void noticed_once(Parts& parts) {
  auto noticed = std::make_shared<bool>(false);
  parts.device.errors.raise.replace([noticed](const auto& former, const ErrorCause& cause, auto detail) {
    if (cause.source == ErrorSource::guarding && std::exchange(*noticed, true)) return;
    former(cause, detail);
  });
  parts.device.outbox.add_filter([noticed](const FilterContext& context, std::vector<Outgoing>&) {
    if (context.service == Service::boot_up) *noticed = false;
  });
}

/// Writing 100Ch or 100Dh forgets that an event was reported, so that no request resolves it.
Change forgets_the_event_with(std::uint16_t index) {
  return [index](Parts& parts) {
    const auto writing = std::make_shared<bool>(false);
    parts.device.errors.clear.replace([writing](const auto& former, const ErrorCause& cause) {
      if (!*writing) former(cause);
    });
    after_writing(index, 0, [writing](Parts&, const std::function<void()>& former) {
      *writing = true;
      former();
      *writing = false;
    })(parts);
  };
}

/// The first request behind an event changes nothing, the second resolves it.
void resolved_by_the_second_request(Parts& parts) {
  auto resolve = std::make_shared<std::function<void()>>();
  parts.device.errors.clear.replace([resolve](const auto& former, const ErrorCause& cause) {
    if (cause.source != ErrorSource::guarding) return former(cause);
    *resolve = [former, cause] { former(cause); };
  });
  parts.device.inbox.add_filter([&parts, resolve](std::vector<Frame>& frames) {
    for (const Frame& frame : frames) {
      if (is_guard_request(parts, frame) && *resolve) std::exchange(*resolve, nullptr)();
    }
  });
}

/// While a life time runs any other frame is an event; the next request resolves it.
bool event_with_other_frames(Parts& parts, const Frame& frame) {
  const ErrorCause event{0x8130, ErrorSource::guarding, 0};
  if (is_guard_request(parts, frame)) {
    parts.device.errors.clear(event);
  } else if (parts.guarding.next_wakeup()) {
    parts.device.errors.raise(event, 0);
  }
  return false;
}

/// Once there was a heartbeat, guard requests are not answered any more.
void dead_after_heartbeat(Parts& parts) {
  auto dead = std::make_shared<bool>(false);
  parts.device.outbox.add_filter([dead](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::boot_up) *dead = false;
    if (context.service == Service::heartbeat) *dead = true;
    if (context.service == Service::guarding && *dead) frames.clear();
  });
}

/// A heartbeat disarms life guarding, and only a life time that is written arms it again.
void life_guarding_dead_after_heartbeat(Parts& parts) {
  const auto armed = std::make_shared<bool>(true);
  with_boot_up([armed](Parts&) { *armed = true; })(parts);
  after_writing(0x1017, 0, [armed](Parts& node, const std::function<void()>& former) {
    former();
    if (node.device.dictionary.number(0x1017, 0) != 0) *armed = false;
  })(parts);
  for (const std::uint16_t index : {std::uint16_t{0x100C}, std::uint16_t{0x100D}}) {
    after_writing(index, 0, [armed](Parts&, const std::function<void()>& former) {
      *armed = true;
      former();
    })(parts);
  }
  parts.guarding.rules.begins_the_watch.replace(
      [armed](const auto& former, bool requested) { return *armed && former(requested); });
}

/// Behind a reset the first reply repeats the toggle bit of the last one.
void toggle_stays_with_reset(Parts& parts) {
  struct Memory {
    bool last = false, first = true;
  };
  const auto memory = std::make_shared<Memory>();
  with_boot_up([memory](Parts&) { memory->first = true; })(parts);
  parts.device.outbox.add_filter([memory](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::guarding) return;
    for (Outgoing& outgoing : frames) {
      if (!std::exchange(memory->first, false)) memory->last = !memory->last;
      outgoing.frame.data[0] &= static_cast<std::uint8_t>(~toggle_bit);
      if (memory->last) outgoing.frame.data[0] |= toggle_bit;
    }
  });
}

/// 0 in the entry is stored and changes nothing before the next request.
Change not_switched_off_by(std::uint16_t index) {
  return after_writing(index, 0, [index](Parts& parts, const std::function<void()>& former) {
    if (parts.device.dictionary.number(index, 0) != 0) former();
  });
}

Change says_in(NmtState real, NmtState told) {
  return Filter([real, told](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::guarding || context.state != real) return;
    for (Outgoing& outgoing : frames) {
      outgoing.frame.data[0] =
          static_cast<std::uint8_t>((outgoing.frame.data[0] & toggle_bit) | static_cast<std::uint8_t>(told));
    }
  });
}

/// Stored parameters guard nobody; only those that are written do.
void guards_with_written_parameters_only(Parts& parts) {
  const auto written = written_since_boot_up(parts, {0x100C, 0x100D});
  parts.guarding.rules.life_time.replace(
      [written](const auto& former, std::uint64_t guard_time, std::uint64_t factor) -> Duration {
        return written->empty() ? Duration::zero() : former(guard_time, factor);
      });
}

/// A life time that runs ends as if there were no heartbeat.
Change goes_on_beside_heartbeat() {
  return together(
      decides(of_guarding, &GuardingRules::is_used, [](const auto&, std::uint64_t) { return true; }),
      deaf_to([](Parts& parts, const Frame& frame) {
        return is_guard_request(parts, frame) && parts.device.dictionary.number(0x1017, 0) != 0;
      }));
}

/// A timer of the guard time runs from the first request on, and the life time ends with one of its ticks.
void ends_with_a_tick(Parts& parts) {
  const auto first = since_boot_up<std::optional<conform::BusTime>>(parts);
  after_writing(0x100C, 0, [first](Parts&, const std::function<void()>& former) {
    first->reset();
    former();
  })(parts);
  parts.guarding.rules.life_time.replace(
      [first, &parts](const auto& former, std::uint64_t guard_time, std::uint64_t factor) -> Duration {
        const Duration right = former(guard_time, factor);
        if (right <= Duration::zero()) return right;
        if (!*first) *first = parts.device.now;
        const Duration tick = std::chrono::milliseconds(static_cast<std::int64_t>(guard_time));
        const Duration since = (parts.device.now - **first) % tick;
        return since == Duration::zero() ? right : right + (tick - since);
      });
}

DefectTable request_rows() {
  return {
      {"guard-no-reply",
       "Guard requests are not answered",
       {"EC-NG-01", "EC-NG-02", "EC-NG-12"},
       deaf_to([](Parts& parts, const Frame& frame) { return is_guard_request(parts, frame); })},
      {"guard-toggle-starts-with-1",
       "The first guard reply after a reset has toggle bit 1",
       {"EC-NG-01", "EC-NG-03"},
       reshape(Service::guarding, [](const FilterContext&, Frame& frame) { frame.data[0] ^= toggle_bit; })},
      {"guard-toggle-constant",
       "The toggle bit of guard replies is always 0",
       {"EC-NG-02", "EC-NG-03"},
       reshape(Service::guarding, [](const FilterContext&, Frame& frame) { frame.data[0] &= 0x7F; })},
      {"guard-toggle-begins-anew-in-operational",
       "The toggle bit begins with 0 when the node becomes Operational",
       {"EC-NG-03", "EC-NG-02"},
       toggle_restarts([](NmtState, NmtState now, bool) {
         return now == NmtState::operational || now == NmtState::initialising;
       })},
      {"guard-toggle-begins-anew-with-each-state",
       "The toggle bit begins with 0 at each change of the NMT state",
       {"EC-NG-03", "EC-NG-02"},
       toggle_restarts([](NmtState, NmtState, bool) { return true; })},
      {"guard-toggle-survives-reset-communication",
       "The toggle bit goes on over reset communication",
       {"EC-NG-03", "EC-NG-01"},
       toggle_restarts(
           [](NmtState, NmtState now, bool node) { return now == NmtState::initialising && node; })},
      {"guard-toggle-survives-reset-node",
       "The toggle bit goes on over reset node",
       {"EC-NG-03"},
       toggle_restarts(
           [](NmtState, NmtState now, bool node) { return now == NmtState::initialising && !node; })},
      {"guard-toggle-stays-with-reset",
       "The first guard reply behind a reset has the toggle bit of the last one before",
       {"EC-NG-03", "EC-NG-01"},
       Change(toggle_stays_with_reset)},
      {"guard-state-operational-wrong",
       "Guard replies tell Pre-operational in Operational",
       {"EC-NG-04"},
       says_in(NmtState::operational, NmtState::pre_operational)},
      {"guard-state-stopped-wrong",
       "Guard replies tell Pre-operational in Stopped",
       {"EC-NG-04"},
       says_in(NmtState::stopped, NmtState::pre_operational)},
      {"guard-reply-of-two-bytes",
       "Guard replies have two bytes",
       {"EC-NG-05", "EC-NG-14"},
       reshape(Service::guarding, [](const FilterContext&, Frame& frame) { frame.dlc = 2; })},
      {"guard-reply-as-long-as-asked",
       "A guard reply has the length that the remote frame asks for",
       {"EC-NG-14"},
       length_as_asked},
      {"guard-answers-every-node",
       "Guard requests for any node are answered",
       {"EC-NG-06"},
       misreads([](Parts& parts, Frame& frame) {
         if (frame.remote && !frame.extended && frame.id >= 0x700) frame.id = 0x700U + parts.device.node_id;
       })},
      {"guard-answers-node-id-without-bit6",
       "Guard requests for a node-ID that differs in bit 6 only are answered",
       {"EC-NG-06"},
       misreads([](Parts& parts, Frame& frame) {
         if (frame.remote && !frame.extended && frame.id == ((0x700U + parts.device.node_id) ^ 0x40U))
           frame.id = 0x700U + parts.device.node_id;
       })},
      {"guard-answered-before-boot-up",
       "Guard requests are answered while the node is initialising",
       {"EC-NG-13"},
       decides(of_guarding, &GuardingRules::is_answered_in, [](const auto&, NmtState) { return true; })},
      {"guard-answers-extended-frames",
       "Remote frames of 29 bits are taken for guard requests",
       {"EC-NG-15"},
       misreads([](Parts&, Frame& frame) {
         if (frame.remote && frame.id >= 0x700 && frame.id <= 0x77F) frame.extended = false;
       })},
      {"guard-answered-while-heartbeat-on",
       "Guarding goes on while the heartbeat is on",
       {"EC-NG-11", "EC-HBP-12"},
       decides(of_guarding, &GuardingRules::is_used, [](const auto&, std::uint64_t) { return true; })},
      {"guard-reply-sent-again",
       "Every third guard reply is sent again 20 ms later",
       {"EC-NG-16"},
       Filter([replies = 0](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
         if (context.service != Service::guarding || frames.empty() || ++replies % 3 != 0) return;
         frames.push_back({frames.front().frame, std::chrono::milliseconds(20)});
       })},
      {"life-time-ends-with-a-tick",
       "The life time ends with a tick of the guard time that began with the first request",
       {"EC-NG-07"},
       Change(ends_with_a_tick)},
      {"guarding-dead-after-heartbeat",
       "Guard requests are not answered any more when the heartbeat was on once",
       {"EC-NG-12"},
       dead_after_heartbeat},
  };
}

DefectTable life_rows() {
  return {
      {"life-guarding-too-early",
       "The life guarding event comes after half of the life time",
       {"EC-NG-07"},
       life_time([](std::uint64_t guard_time, std::uint64_t factor) -> Duration {
         return std::chrono::milliseconds(static_cast<std::int64_t>(guard_time * factor / 2));
       })},
      {"life-guarding-factor-ignored",
       "The life guarding event comes after one guard time",
       {"EC-NG-07"},
       life_time([](std::uint64_t guard_time, std::uint64_t factor) -> Duration {
         return std::chrono::milliseconds(factor == 0 ? 0 : static_cast<std::int64_t>(guard_time));
       })},
      {"life-time-ends-with-event-timer",
       "The life guarding event comes with the next tick of a TPDO's event timer",
       {"EC-NG-07"},
       Change(ends_with_event_timers)},
      {"life-time-of-8-bits",
       "The life time is computed in 8 bits",
       {"EC-NG-07"},
       life_time([](std::uint64_t guard_time, std::uint64_t factor) -> Duration {
         return std::chrono::milliseconds(static_cast<std::int64_t>((guard_time * factor) & 0xFFU));
       })},
      {"life-time-of-16-bits",
       "The life time is computed in 16 bits",
       {"EC-NG-07"},
       life_time([](std::uint64_t guard_time, std::uint64_t factor) -> Duration {
         return std::chrono::milliseconds(static_cast<std::int64_t>((guard_time * factor) & 0xFFFFU));
       })},
      {"life-time-of-32-bits-of-microseconds",
       "The life time is computed in 32 bits of microseconds",
       {"EC-NG-07"},
       life_time([](std::uint64_t guard_time, std::uint64_t factor) -> Duration {
         return std::chrono::microseconds(
             static_cast<std::int64_t>((guard_time * factor * 1000) & 0xFFFF'FFFFU));
       })},
      {"life-guarding-twice-as-long",
       "The life guarding event comes after twice the life time",
       {"EC-NG-07"},
       life_time([](std::uint64_t guard_time, std::uint64_t factor) -> Duration {
         return std::chrono::milliseconds(static_cast<std::int64_t>(guard_time * factor * 2));
       })},
      {"life-guarding-without-request",
       "Life guarding starts when it is configured",
       {"EC-NG-08"},
       decides(of_guarding, &GuardingRules::begins_the_watch, [](const auto&, bool) { return true; })},
      {"life-guarding-with-factor-0",
       "A life time factor of 0 is taken for 1",
       {"EC-NG-09"},
       life_time([](std::uint64_t guard_time, std::uint64_t factor) -> Duration {
         return std::chrono::milliseconds(static_cast<std::int64_t>(guard_time * (factor == 0 ? 1 : factor)));
       })},
      {"life-guarding-with-guard-time-0",
       "A guard time of 0 is taken for 100 ms",
       {"EC-NG-09"},
       life_time([](std::uint64_t guard_time, std::uint64_t factor) -> Duration {
         return std::chrono::milliseconds(
             static_cast<std::int64_t>((guard_time == 0 ? 100 : guard_time) * factor));
       })},
      {"life-guarding-not-switched-off-by-100c",
       "A watch that runs goes on when 100Ch becomes 0",
       {"EC-NG-09"},
       not_switched_off_by(0x100C)},
      {"life-guarding-not-switched-off-by-100d",
       "A watch that runs goes on when 100Dh becomes 0",
       {"EC-NG-09"},
       not_switched_off_by(0x100D)},
      {"life-guarding-never-resolved",
       "After a life guarding event guard requests are not answered any more",
       {"EC-NG-10", "OD-1029-10"},
       dumb_after_the_event},
      {"life-guarding-noticed-once",
       "A second life guarding event is not reported",
       {"EC-NG-10", "EC-NG-07"},
       noticed_once},
      {"life-guarding-event-with-other-frames",
       "While a life time runs any other frame on the bus makes a life guarding event",
       {"EC-NG-07"},
       deaf_to(event_with_other_frames)},
      {"life-guarding-event-forgotten-by-writing-100d",
       "Writing 100Dh behind a life guarding event leaves its error for ever",
       {"EC-NG-10"},
       forgets_the_event_with(0x100D)},
      {"life-guarding-resolved-by-second-request",
       "A life guarding event is resolved by the second guard request only",
       {"EC-NG-10"},
       resolved_by_the_second_request},
      {"life-guarding-goes-on-over-reset",
       "A life time that runs goes on over a reset",
       {"EC-NG-08"},
       decides(of_guarding, &GuardingRules::ends_with_reset, [](const auto&) { return false; })},
      {"life-guarding-outlives-heartbeat-write",
       "A life time that is running is not ended by a heartbeat time that is written",
       {"EC-NG-11"},
       goes_on_beside_heartbeat()},
      {"life-guarding-dead-after-heartbeat",
       "Once the heartbeat was on, life guarding does not work until 100Ch or 100Dh is written",
       {"EC-NG-07"},
       Change(life_guarding_dead_after_heartbeat)},
      {"life-guarding-stored-without-effect",
       "Life guarding does not work with stored parameters until they are written",
       {"EC-NG-07", "OD-RST-04"},
       Change(guards_with_written_parameters_only)},
      {"life-guarding-ignores-1029",
       "Guarding that stays away ends Operational, whatever 1029h:01 says",
       {"EC-EB-02", "EC-EB-03"},
       Change(ends_operational_whatever)},
      {"life-time-factor-7-bits",
       "Of the life time factor seven bits count",
       {"EC-NG-07"},
       decides(of_guarding, &GuardingRules::life_time,
               [](const auto& former, std::uint64_t time, std::uint64_t factor) {
                 return former(time, factor & 0x7FU);
               })},
      {"life-time-factor-1-is-off",
       "With the life time factor 1 there is no life guarding",
       {"EC-NG-07"},
       decides(of_guarding, &GuardingRules::life_time,
               [](const auto& former, std::uint64_t time, std::uint64_t factor) {
                 return former(time, factor == 1 ? 0 : factor);
               })},
      {"life-guarding-event-told-again",
       "While guarding stays away the event is told again after 200 ms",
       {"EMCY-SEQ-01"},
       Filter(tells_life_guarding_again)},
  };
}

DefectTable entry_rows() {
  return {
      {"100c-absent",
       "100Ch does not exist although the node is guarded",
       {"OD-100C-01", "OD-CAT-03", "OD-ERC-01", "EC-GEN-01", "OD-GEN-17"},
       absent(0x100C)},
      {"100c-is-u32",
       "100Ch has four bytes",
       {"OD-100C-01", "OD-LEN-04", "OD-GEN-17"},
       type(0x100C, 0, DataType::unsigned32)},
      {"100c-not-writable",
       "100Ch is read-only although there is life guarding",
       {"OD-100C-02", "SDO-DNL-21"},
       access(0x100C, 0, Access::ro)},
      {"100c-not-stored", "Writing 100Ch is confirmed and forgotten", {"OD-100C-02"}, not_stored(0x100C, 0)},
      {"100c-default-nonzero", "The default of 100Ch is 100 ms", {"OD-100C-04"}, preset(0x100C, 0, 100)},
      {"100d-absent",
       "100Dh does not exist although the node is guarded",
       {"OD-100D-01", "OD-CAT-03", "OD-ERC-01", "EC-GEN-01", "OD-GEN-17"},
       absent(0x100D)},
      {"100d-is-u16",
       "100Dh has two bytes",
       {"OD-100D-01", "OD-100D-03", "OD-LEN-04", "OD-GEN-17"},
       type(0x100D, 0, DataType::unsigned16)},
      {"100d-not-writable",
       "100Dh is read-only although there is life guarding",
       {"OD-100D-02", "SDO-DNL-21"},
       access(0x100D, 0, Access::ro)},
      {"100d-default-nonzero", "The default of 100Dh is 3", {"OD-100C-04"}, preset(0x100D, 0, 3)},
      {"100d-long-write-wrong-abort",
       "Two bytes for 100Dh are refused with 0609 0030h",
       {"OD-100D-03"},
       wrong_abort_at(mux(0x100D, 0), abort_code::length_too_high, abort_code::invalid_value)},
      {"1029-ignores-life-guarding",
       "Guarding that stays away is not noticed",
       {"OD-1029-10", "EC-NG-07"},
       together(unnoticed(ErrorSource::guarding), [](Parts& parts) { parts.guarding.on_loss = nullptr; })},
  };
}

}  // namespace

DefectTable error_control_guarding_defects() {
  DefectTable rows = entry_rows();
  for (DefectTable table : {request_rows(), life_rows()}) append(rows, std::move(table));
  return rows;
}

}  // namespace refnode
