// SPDX-License-Identifier: Apache-2.0
// Boot-up and the NMT state machine, where the standard leaves the when to the device.
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "variants/tools.hpp"

namespace refnode {

using namespace variant;
using namespace std::chrono_literals;

namespace {

/// 1F80h, NMT start-up: bit 2 is 0, so the device starts without an NMT master.
void start_by_itself(Parts& parts) {
  parts.device.dictionary.remove(0x1F80);  // a twin may have one
  parts.device.dictionary.add_variable(0x1F80,
                                       integer_entry("NMT start-up", DataType::unsigned32, Access::ro, 0));
  parts.nmt.choices.self_starting = true;
}

How boots_in(Duration after_reset_node, Duration after_reset_communication) {
  return [=](Parts& node) {
    node.nmt.choices.node_start_up = after_reset_node;
    node.nmt.choices.communication_start_up = after_reset_communication;
  };
}

How follows_after(Duration latency) {
  return [=](Parts& node) { node.nmt.choices.latency = latency; };
}

/// A program that looks at what has come once in each of its cycles.
How program_cycle(Duration cycle) {
  return [cycle](Parts& parts) {
    parts.device.inbox.add_filter([&device = parts.device, cycle](std::vector<Frame>& frames) {
      const BusTime next = device.now + (cycle - device.now.time_since_epoch() % cycle);
      for (const Frame& frame : frames) device.inbox.put(frame, next);
      frames.clear();
    });
  };
}

constexpr std::uint32_t lss_request = 0x7E5;

/// A program that has room for one frame of each CAN-ID between two of its cycles.
How newest_frame_in(Duration cycle) {
  return [cycle](Parts& parts) {
    parts.sdo.choices.block = false;
    parts.device.inbox.add_filter([&device = parts.device, cycle](std::vector<Frame>& frames) {
      const BusTime next = device.now + (cycle - device.now.time_since_epoch() % cycle);
      // LSS has requests of several frames without an answer between them.
      std::erase_if(frames, [&](const Frame& frame) {
        if (frame.id == lss_request) return false;
        device.inbox.put_newest(frame, next);
        return true;
      });
    });
  };
}

/// The command waits in the driver until the program looks for one.
void obeys_behind_start_up(Parts& parts) {
  const auto waiting = std::make_shared<std::optional<Frame>>();
  parts.device.inbox.add_filter([&device = parts.device, waiting](std::vector<Frame>& frames) {
    for (const Frame& frame : frames) {
      if (device.state == NmtState::initialising && frame.id == 0 && !frame.remote && frame.size() == 2)
        *waiting = frame;
    }
  });
  parts.nmt.on_boot_up = [&parts, waiting, former = parts.nmt.on_boot_up] {
    former();
    const auto command = std::exchange(*waiting, std::nullopt);
    if (command && command->data[0] != nmt_command::reset_node &&
        command->data[0] != nmt_command::reset_communication)
      parts.nmt.on_command(*command);
  };
}

}  // namespace

VariantTable nmt_variants() {
  return {
      {"boot-up-at-once", "boots in no time", "7.3.2.2.1: no time is given", boots_in(0ms, 0ms), "boot"},
      {"boot-up-200ms", "boots in 200 ms", "7.3.2.2.1: no time is given", boots_in(200ms, 200ms), "boot"},
      {"boot-up-2s", "boots in 2 s, after reset communication in 0.7 s", "7.3.2.2.1: no time is given",
       boots_in(2s, 700ms), "boot"},
      {"boot-up-4900ms", "boots in 4.9 s", "7.3.2.2.1: no time is given, NMT-BOOT-08: T_BOOT",
       boots_in(4900ms, 4900ms), "boot"},
      {"nmt-10ms", "follows start, stop and enter pre-operational after 10 ms",
       "7.3.2.2: no time is given, NMT-FSA-20: T_NMT", follows_after(10ms), "nmt-latency"},
      {"nmt-90ms", "follows start, stop and enter pre-operational after 90 ms",
       "7.3.2.2: no time is given, NMT-FSA-20: T_NMT", follows_after(90ms), "nmt-latency"},
      // With NMT commands that take longer T_NMT is over; who is that late for a sub-block acknowledges its
      // end.
      {.id = "program-cycle-20ms",
       .summary = "frames are looked at once in 20 ms",
       .legal = "CiA 301 gives no times; SDO-BUP-17, SYNC-CON-09 warn",
       .how = program_cycle(20ms),
       .group = "late",
       .excludes = {"nmt-latency", "sdo-gap-at-once", "analog-inputs-noisy", "turnaround", "lss-slow"},
       .warns = {"SDO-BUP-17", "SYNC-CON-09"}},
      {.id = "newest-frame-in-5ms",
       .summary = "frames are looked at once in 5 ms, and of one CAN-ID only the newest",
       .legal = "CiA 301 gives no times",
       .how = newest_frame_in(5ms),
       .group = "late",
       .excludes = {"nmt-latency", "analog-inputs-noisy", "turnaround", "sdo-block"},
       .lacks = {"block sdo"}},
      {"start-up-obeys-later", "a start, stop or enter pre-operational of the start-up is obeyed behind it",
       "7.3.2.2.1: nothing is said of commands in Initialisation", obeys_behind_start_up},
      {"self-starting", "goes on into Operational after boot-up, as its 1F80h says",
       "CiA 302-2, 1F80h bit 2 = 0; NMT-BOOT-07 does not apply", start_by_itself},
  };
}

}  // namespace refnode
