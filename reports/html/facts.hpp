// SPDX-License-Identifier: Apache-2.0
// What was tested, how and by what: the facts of a run by the names under which a reader knows them.
#pragma once

#include <string>
#include <vector>

#include "result/run_result.hpp"

namespace conform::reports::html {

struct Fact {
  std::string name;   ///< of the property, "dut.vendor_id"; of what is none: "tool", "started" ...
  std::string label;  ///< "Vendor-ID (1018h:01)"
  std::string value;  ///< may hold anything the device sent
};
/// The device first, then the bus, then what was asked for, then the tool.
[[nodiscard]] std::vector<Fact> facts_of(const result::RunResult& run);

struct FactPair {
  std::string name, label, before, after;  ///< empty: that run does not tell it
  [[nodiscard]] bool differs() const { return before != after; }
};
/// The facts of two runs side by side, in the same order.
[[nodiscard]] std::vector<FactPair> facts_of(const result::RunResult& before, const result::RunResult& after);

}  // namespace conform::reports::html
