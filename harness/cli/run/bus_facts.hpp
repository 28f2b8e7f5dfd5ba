// SPDX-License-Identifier: Apache-2.0
// What a report says of the bus, the adapter and the host: what its times and its silences rest on.
#pragma once

#include <vector>

#include "can/transport.hpp"
#include "result/run_result.hpp"

namespace conform::cli {

/// Of an interface before the run: "can.driver", "can.bit_rate", "can.stamps", "can.state" ...; what the
/// kernel does not tell is left out.
[[nodiscard]] std::vector<result::Property> bus_properties(const can::TransportInfo& info);
/// Of the same after it: "health.error_frames" and the other counters, and the state of the controller.
[[nodiscard]] std::vector<result::Property> health_properties(const can::TransportInfo& info,
                                                              const can::BusHealth& health);
/// "host.kernel"
[[nodiscard]] std::vector<result::Property> host_properties();

}  // namespace conform::cli
