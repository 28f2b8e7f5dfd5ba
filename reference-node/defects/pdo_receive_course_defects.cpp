// SPDX-License-Identifier: Apache-2.0
// Defects of received PDOs that show in what follows only, or beside another PDO.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "defects/pdos.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr std::uint16_t too_late = 0x8250;

/// A remote frame is taken for a data frame that has no data.
void takes_remote_frames(Parts& parts) {
  misreads([](Parts& node, Frame& frame) {
    if (!frame.remote || frame.extended || !rpdo_with(node.device.dictionary, frame.id)) return;
    frame.remote = false;
    frame.dlc = 0;
  })(parts);
}

/// The first RPDO that is long enough again ends the error, and is not processed.
void drops_the_next(Parts& parts) {
  struct Memory {
    bool was_short = false;
    std::optional<BusTime> dropped;  // the rule is asked more than once for a frame
  };
  parts.pdos.rpdo.rules.processed.replace(
      [&parts, memory = std::make_shared<std::map<std::uint16_t, Memory>>()](
          const auto& former, const PdoParameters& pdo, std::size_t received, std::size_t mapped) {
        Memory& now = (*memory)[pdo.number()];
        const bool processed = former(pdo, received, mapped);
        if (!processed) {
          now.was_short = true;
        } else if (std::exchange(now.was_short, false)) {
          now.dropped = parts.device.now;
        }
        return processed && now.dropped != parts.device.now;
      });
}

/// Event timer 0 holds from the next RPDO on only.
Change zero_leaves_the_deadline() {
  return [](Parts& parts) {
    for (std::uint16_t number = 0; number <= last_pdo; ++number) {
      after_writing(rpdo_communication(number), 5,
                    [number](Parts& node, const std::function<void()>& former) {
                      if (node.device.dictionary.number(rpdo_communication(number), 5) != 0) former();
                    })(parts);
    }
  };
}

/// One time for all of them, which any RPDO begins anew.
void held_off_by_another(Parts& parts) {
  const auto last = std::make_shared<BusTime>();
  misreads([last](Parts& node, Frame& frame) {
    if (!frame.remote && rpdo_with(node.device.dictionary, frame.id)) *last = node.device.now;
  })(parts);
  parts.device.errors.raise.replace(
      [&parts, last](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
        const auto index = rpdo_communication(static_cast<std::uint16_t>(cause.instance - 1));
        const auto limit = std::chrono::milliseconds(parts.device.dictionary.number(index, 5));
        // One that came at the same time does not hold it off.
        constexpr auto at_once = std::chrono::milliseconds(10);
        const bool others = cause.source == ErrorSource::rpdo && cause.code == too_late &&
                            parts.device.now - *last + at_once < limit;
        if (!others) former(cause, detail);
      });
}

/// 64 bits are moved as two times 32, and the upper ones by words in the wrong order.
void swaps_the_second_long(Parts& parts) {
  misreads([](Parts& node, Frame& frame) {
    const ObjectDictionary& od = node.device.dictionary;
    const auto number = frame.remote ? std::nullopt : rpdo_with(od, frame.id);
    if (!number || frame.size() != 8) return;
    const auto mapping = static_cast<std::uint16_t>(0x1600 + *number);
    const auto count = static_cast<std::uint8_t>(od.number(mapping, 0));
    if (count < 2 || count > most_mapped || bits_held(od, mapping, count) != 64) return;
    if (Mapped::unpack(od.number(mapping, count)).bits == 32)
      std::swap_ranges(frame.data.begin() + 4, frame.data.begin() + 6, frame.data.begin() + 6);
  })(parts);
}

/// The acceptance filter of the third RPDO leaves the two lowest bits out.
void compares_all_but_two_bits(Parts& parts) {
  misreads([](Parts& node, Frame& frame) {
    constexpr std::uint32_t left_out = 3;
    const ObjectDictionary& od = node.device.dictionary;
    if (frame.extended || frame.remote || rpdo_with(od, frame.id)) return;
    const auto cob_id = static_cast<std::uint32_t>(od.number(rpdo_communication(third_pdo), 1, 0x8000'0000U));
    if ((cob_id & 0x8000'0000U) == 0 && ((cob_id ^ frame.id) & 0x7FFU & ~left_out) == 0)
      frame.id = cob_id & 0x7FFU;
  })(parts);
}

/// What waits for its SYNC is forgotten in Pre-operational, and not in Stopped.
void waits_through_stopped(Parts& parts) {
  struct Memory {
    std::optional<Frame> last, waiting;
    bool stopped = false;
  };
  const auto memory = since_boot_up<Memory>(parts);
  auto& rules = parts.pdos.rpdo.rules;
  rules.kept_for_sync.replace(
      [memory](const auto& former, const PdoParameters& pdo, const auto& before, const Bytes& received) {
        memory->waiting = memory->last;
        return former(pdo, before, received);
      });
  rules.taken_at_sync.replace([memory](const auto& former, const PdoParameters& pdo, const Bytes& waiting) {
    memory->waiting.reset();
    return former(pdo, waiting);
  });
  misreads([memory](Parts& node, Frame& frame) {
    constexpr std::uint32_t sync_can_id = 0x080;
    if (rpdo_with(node.device.dictionary, frame.id)) memory->last = frame;
    if (frame.id != sync_can_id || node.device.state != NmtState::operational || !memory->stopped) return;
    memory->stopped = false;
    if (const auto waiting = std::exchange(memory->waiting, std::nullopt)) node.pdos.on_frame(*waiting);
  })(parts);
  ahead_of_state_change([memory](Parts& node) {
    if (node.device.state == NmtState::stopped) memory->stopped = true;
    if (node.device.state == NmtState::pre_operational) memory->waiting.reset();
  })(parts);
}

}  // namespace

DefectTable pdo_receive_course_defects() {
  return {
      {"rpdo-remote-frame-reported-as-too-short",
       "A remote frame with the CAN-ID of an RPDO is reported as an RPDO that is too short",
       {"PDO-RX-13"},
       Change(takes_remote_frames)},
      {"rpdo-behind-a-short-one-dropped",
       "The first RPDO behind one that was too short is not processed",
       {"PDO-RX-06"},
       Change(drops_the_next)},
      {"rpdo-deadline-runs-on-behind-zero",
       "Event timer 0 of an RPDO leaves the deadline that is running",
       {"PDO-RX-15"},
       zero_leaves_the_deadline()},
      {"rpdo-deadline-held-off-by-another",
       "An RPDO that stays away is not reported while another one comes",
       {"PDO-RX-14"},
       Change(held_off_by_another)},
      {"rpdo-deadline-from-8000h-never-elapses",
       "A deadline of an RPDO from 8000h on never elapses",
       {"PDO-RX-14"},
       decides(rpdo_parameters, &PdoRules::event_timer,
               [](const auto& former, const PdoParameters& pdo, std::int64_t value) {
                 return former(pdo, value < 0x8000 ? value : 0);
               })},
      {"rpdo-second-long-halves-swapped",
       "An object of four bytes behind four others gets its halves swapped by an RPDO",
       {"PDO-RX-01"},
       Change(swaps_the_second_long)},
      {"rpdo-third-without-the-lowest-bits",
       "The third RPDO is received whatever the two lowest bits of the CAN-ID are",
       {"OD-1400-11", "PDO-RX-13"},
       Change(compares_all_but_two_bits)},
      {"rpdo-waiting-outlives-stopped",
       "A synchronous RPDO that waits for its SYNC takes effect when the device was stopped and started meanwhile",
       {"PDO-RX-02"},
       Change(waits_through_stopped)},
  };
}

}  // namespace refnode
