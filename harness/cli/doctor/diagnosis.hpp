// SPDX-License-Identifier: Apache-2.0
// What is wrong with a bus, and what to type.
#pragma once

#include <string>
#include <vector>

#include "can/socketcan_interface.hpp"
#include "cli/doctor/heard.hpp"

namespace conform::cli {

struct Advice {
  enum class Kind : std::uint8_t { good, note, bad };
  Kind kind;
  std::string text;  ///< a sentence, lower case, no full stop
  std::string hint;  ///< what to do, or empty
};

/// Of an interface that is up, before anybody has listened.
[[nodiscard]] std::vector<Advice> about_interface(const can::InterfaceFacts& facts);

/// Of what was heard there. `asked`: every node-ID was asked for 1000h.
[[nodiscard]] std::vector<Advice> about_bus(const can::InterfaceFacts& facts, const Heard& heard, bool asked);

/// The nodes, a line each: "node 5     heartbeat each 100 ms, operational; EMCY; 1000h = 000F 0191h".
[[nodiscard]] std::vector<std::string> node_lines(const Heard& heard);

[[nodiscard]] bool is_usable(const std::vector<Advice>& advice);

}  // namespace conform::cli
