// SPDX-License-Identifier: Apache-2.0
#include "engine/outage.hpp"

#include <algorithm>
#include <chrono>
#include <string>

#include "base/text.hpp"
#include "engine/liveness.hpp"

namespace conform::engine {
namespace {

/// A stop request is heard within this time.
constexpr Duration slice = std::chrono::milliseconds(40);

}  // namespace

bool Outage::is_one() const {
  const auto& fault = run_.recorder.fault();
  return fault && fault->of == Error::Of::world && fault->what != stopped && fault->what != flooded;
}

bool Outage::is_over() {
  if (!is_one()) return false;
  auto& recorder = run_.recorder;
  auto since = recorder.now();
  const auto deadline = since + run_.options.bus_patience;
  recorder.stop_producing("");
  const bool was_stopped = run_.session.is_stopped();
  bool back = false;
  // The link may go down again while the device is asked.
  while (!back && is_one() && bus_is_back(deadline)) {
    lasted_ += recorder.now() - since;
    recorder.mark_next_frame("the bus is back after " + recorder.fault()->text());
    recorder.clear_fault();
    life_.note_losses();
    // Nobody knows what it went through meanwhile.
    run_.session.device_restarted();
    run_.session.sdo_channel_dirty();
    back = device_answers(was_stopped);
    if (!back && !recorder.fault())
      recorder.set_fault({"the bus was away, and nothing was heard of the device since it is back", {}, {}});
    ++count_;
    since = recorder.now();
    if (since >= deadline) break;
  }
  return back;
}

bool Outage::bus_is_back(BusTime deadline) {
  auto& recorder = run_.recorder;
  do {
    if (recorder.stop_requested()) {
      recorder.set_fault({stopped, {}, {}});
      return false;
    }
    const auto back = recorder.transport().come_back(std::min(deadline, recorder.now() + slice));
    if (!back) return false;
    if (*back) return true;
  } while (recorder.now() < deadline);
  return false;
}

/// Or is heard at least: what else it owes is for the scenarios. In Stopped it answers nothing, and the time
/// that the questions take may be longer than the bus stays.
bool Outage::device_answers(bool was_stopped) {
  if (was_stopped && run_.may(scenario::Risk::config) &&
      !run_.session.command(canopen::NmtCommand::pre_operational))
    return false;
  auto revival = look_for_life(run_.session, life_.means());
  run_.session.clear_silence_seen();
  return revival && revival->life != Alive::gone;
}

void Outage::tell() {
  if (count_ == 0) return;
  // One that did not end has ended the run, which says so.
  run_.note("the bus was away " + (count_ == 1 ? "once" : std::to_string(count_) + " times") + ", for " +
            to_string(Duration(std::chrono::round<std::chrono::milliseconds>(lasted_))) +
            " together: the cases that met it are errors");
}

}  // namespace conform::engine
