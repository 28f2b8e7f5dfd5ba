// SPDX-License-Identifier: Apache-2.0
// A bus that goes away in the middle of a run: link down, adapter unplugged, bus-off, nobody who
// acknowledges. It says nothing about the device; the run waits and goes on.
#pragma once

#include "engine/life.hpp"
#include "engine/run_context.hpp"

namespace conform::engine {

class Outage {
 public:
  Outage(RunContext& run, Life& life) : run_(run), life_(life) {}

  /// Whether the latest fault of the recorder is one of the bus, which waiting may mend.
  [[nodiscard]] bool is_one() const;
  /// Waits as long as the user allows (RunOptions::bus_patience) until the bus can be used again and the
  /// device answers. True: the run can go on; what was open on the SDO channel is closed by the next
  /// transfer. False: it cannot; the recorder's fault says why.
  [[nodiscard]] bool is_over();
  /// In the summary: how often, and how long all together.
  void tell();

 private:
  [[nodiscard]] bool bus_is_back(BusTime deadline);
  [[nodiscard]] bool device_answers(bool was_stopped);

  RunContext& run_;
  Life& life_;
  std::size_t count_ = 0;
  Duration lasted_{};
};

}  // namespace conform::engine
