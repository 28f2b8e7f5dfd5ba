// SPDX-License-Identifier: Apache-2.0
// `given`: the entry of the device that a scenario works with.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "engine/run_session.hpp"

namespace conform::engine {

class Givens {
 public:
  explicit Givens(RunSession& session) : session_(session) {}
  /// The first entry of the query that the device has; nullopt when there is none.
  [[nodiscard]] Result<std::optional<Multiplexer>> find(const std::string& text);

 private:
  RunSession& session_;
  std::map<Multiplexer, std::optional<std::uint64_t>>
      held_;  ///< bytes of entries without a fixed length, as asked
};

}  // namespace conform::engine
