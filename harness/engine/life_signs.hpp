// SPDX-License-Identifier: Apache-2.0
// Life signs that a device watches for go on until its values are back.
#pragma once

#include <cstddef>

#include "base/error.hpp"

namespace conform::engine {

class RunSession;

/// Behind the steps of a case: where the case changed whom the device watches (1016h; 100Ch, 100Dh), the
/// heartbeats and guard requests that it sent last are sent on beside whatever follows, until the recorder
/// stops producing. Without them a device that answers slowly has lost us before its watch is taken back, and
/// may stop for it (1029h), so that nothing can be put back at all.
void keep_up_life_signs(RunSession& session);

/// Behind the last of them: as long as the slowest reply to a guard request has taken since frame `from`, the
/// device has time for the reply to the last one. In the next case it would be the reply to another request.
[[nodiscard]] Result<void> await_last_guard_reply(RunSession& session, std::size_t from);

}  // namespace conform::engine
