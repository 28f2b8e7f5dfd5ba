// SPDX-License-Identifier: Apache-2.0
// What the verbs about PDOs have in common: which objects a PDO has, and what is announced before they
// change.
#pragma once

#include <cstdint>
#include <string>

#include "steps/outcome.hpp"
#include "steps/session.hpp"
#include "steps/step.hpp"

namespace conform::steps {

/// 1400h and 1600h, not 1800h and 1A00h.
[[nodiscard]] inline bool is_receive_pdo(Index object) { return object < Index(0x1800); }

/// The communication object of a PDO, named by itself or by its mapping object. Error of the scenario: it is
/// no PDO.
[[nodiscard]] Result<Index> communication_of(const ObjectReference& pdo, Session& session);

/// "TPDO 1"; where nobody knows which, what the scenario says.
[[nodiscard]] std::string pdo_words(const ObjectReference& pdo, Session& session);

/// What an RPDO maps is changed by its next frame, and has to be put back as after a download. A data type
/// (index up to 001Fh) only fills its place. `entry`: a value of a mapping (7.5.2.36).
[[nodiscard]] Result<void> will_receive(Session& session, Index mapping, std::uint64_t entry);

[[nodiscard]] bool is_absent(const Actual& actual);

}  // namespace conform::steps
