// SPDX-License-Identifier: Apache-2.0
// Is the device there, and is it the only one with its node-ID?
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "can/capture.hpp"
#include "device/profile.hpp"
#include "engine/run_session.hpp"

namespace conform::engine {

/// What may be done to a device that does not answer.
struct Means {
  bool may_command = false;                     ///< NMT commands, resets among them
  std::function<Result<void>()> power_cycle{};  ///< empty: the power cannot be switched
};

enum class Alive : std::uint8_t {
  answers,  ///< its SDO server does
  there,    ///< it was heard, but answers no SDO request
  gone,     ///< nothing was heard of it
};

struct Revival {
  Alive life = Alive::gone;
  bool at_once = false;    ///< it answers, and nothing had to be done or waited for
  bool was_reset = false;  ///< it answers since it was reset
  bool power_was_switched = false;
  std::string tried{};  ///< "no SDO answer and no frame for 5 s, nor after a reset"
};

/// How the first probe ended.
struct Liveness {
  bool alive = false;    ///< an SDO answer, a boot-up message, a heartbeat or an EMCY was seen
  bool answers = false;  ///< the default SDO server answers
  std::string heard;     ///< "SDO answer", "heartbeat: stopped", "nothing"
};

/// Whether a frame can only come from the device: SDO response, error control, EMCY where the standard puts
/// it.
[[nodiscard]] bool is_from_node(const RunSession& session, const can::CapturedFrame& captured);
[[nodiscard]] steps::Session::Match is_boot_up_of(NodeId node);

/// Asks (1000h:00), for three SDO time-outs at most, then as look_for_life().
[[nodiscard]] Result<Liveness> probe(RunSession& session, const Means& means);

/// After a silence. A device may be starting: it has the whole T_BOOT to say so, whoever made it start. Then,
/// as far as the means allow: Pre-operational (it may have been left in Stopped), a reset, power.
[[nodiscard]] Result<Revival> look_for_life(RunSession& session, const Means& means);

/// Whether one request has two answers. Costs one upload and `listen`.
[[nodiscard]] Result<bool> answers_twice(RunSession& session, Duration listen);
/// Of a device that answers twice: whether there are two of it, in words. Two devices tell different
/// identities, or at least start each for itself; where neither can be told, that is said.
[[nodiscard]] Result<std::optional<std::string>> second_device(RunSession& session, const Means& means);

}  // namespace conform::engine
