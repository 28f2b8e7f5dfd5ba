// SPDX-License-Identifier: Apache-2.0
// Reading and writing one entry on the way to something else: what verbs do before and after what they are
// about, in one transfer of the usual kind.
#pragma once

#include "steps/outcome.hpp"
#include "steps/session.hpp"

namespace conform::steps {

/// What came of a transfer, without its measurements. `confirmed` and `aborted` as they are; a transfer that
/// the client gave up shows what was wrong with it, as a violation does.
[[nodiscard]] Actual outcome_of(const SdoAnswer& answer);

/// Measures `size_open`: 1 where the server left the size open (7.2.4.3.6, s = 0).
[[nodiscard]] Result<Actual> read(Session& session, Multiplexer object);
[[nodiscard]] Result<Actual> write(Session& session, Multiplexer object, const Bytes& bytes);
/// `value` in `size` bytes.
[[nodiscard]] Result<Actual> write(Session& session, Multiplexer object, std::uint64_t value,
                                   std::size_t size);

[[nodiscard]] inline bool is_confirmed(const Result<Actual>& actual) {
  return actual && actual->kind == Actual::Kind::confirmed;
}

}  // namespace conform::steps
