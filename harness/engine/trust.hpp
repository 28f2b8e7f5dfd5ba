// SPDX-License-Identifier: Apache-2.0
// What a case is worth on a host that was late, lost frames or was not alone on the SDO channel, and what one
// that did not come to its end.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "can/transport.hpp"
#include "engine/recorder.hpp"
#include "result/run_result.hpp"

namespace conform::engine {

struct HostTrouble {
  std::string why;
  /// What was seen in time was seen. Only what rests on time or on silence is in doubt: the device may have
  /// waited for us in vain.
  bool late_only = false;
  bool passes_by = false;  ///< lateness: another try may be spared it
  bool machine_only =
      false;  ///< the host did nothing wrong in this case; the device may have been kept waiting
};

/// What befell the host in a case: its health at the beginning and the end, and how late it was. nullopt:
/// nothing of importance.
[[nodiscard]] std::optional<HostTrouble> trouble_of(const can::BusHealth& before, const can::BusHealth& after,
                                                    const Recorder::Lateness& lateness, bool other_client);

/// On a virtual interface the device runs on this machine, too. Where the machine kept the host waiting in
/// the case that began at `begin`, or shortly before, it may have kept the device waiting, and nobody saw it.
/// nullopt: it did not, or the device has a processor of its own.
[[nodiscard]] std::optional<HostTrouble> machine_trouble(const can::TransportInfo& info,
                                                         const std::optional<Recorder::LateWaking>& latest,
                                                         BusTime begin);

/// Makes inconclusive what the trouble puts in doubt.
void distrust(result::CaseResult& result, const HostTrouble& trouble);

/// The case did not come to its end: nothing of it has passed, and a device that is gone has not violated a
/// rule by its silence. Only what was found while the device was still heard afterwards remains;
/// `last_heard`: capture index behind its last frame.
void withdraw(result::CaseResult& result, std::size_t last_heard);

}  // namespace conform::engine
