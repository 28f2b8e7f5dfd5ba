// SPDX-License-Identifier: Apache-2.0
// The second of the three kinds of wrong: the world or the input is wrong. What, where, and what to do about
// it.
#pragma once

#include <cstdint>
#include <expected>
#include <string>
#include <utility>

namespace conform {

/// A fault of the environment or of the input; never a verdict about the device under test.
struct Error {
  /// Whose fault it is. `scenario`: a step asked for what cannot be done here; the run goes on with the next
  /// case.
  enum class Of : std::uint8_t { world, scenario };

  std::string what;   ///< one sentence, no trailing full stop
  std::string where;  ///< file:line:column, interface name, or empty
  std::string hint;   ///< what the user can do about it, or empty
  Of of = Of::world;

  /// "where: what (hint)", for a terminal line.
  [[nodiscard]] std::string text() const {
    std::string out = where.empty() ? what : where + ": " + what;
    if (!hint.empty()) out += " (" + hint + ")";
    return out;
  }
};

template <typename T>
using Result = std::expected<T, Error>;

/// Shorthand for the failing branch: `return fail("...", "...")`.
[[nodiscard]] inline std::unexpected<Error> fail(std::string what, std::string where = {},
                                                 std::string hint = {}) {
  return std::unexpected(Error{std::move(what), std::move(where), std::move(hint)});
}

/// The same for what a scenario asked for in vain.
[[nodiscard]] inline std::unexpected<Error> fail_scenario(std::string what, std::string hint = {}) {
  return std::unexpected(Error{std::move(what), {}, std::move(hint), Error::Of::scenario});
}

}  // namespace conform
