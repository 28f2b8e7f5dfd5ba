// SPDX-License-Identifier: Apache-2.0
// Life signs that a device watches for go on until its values are back.
#pragma once

namespace conform::engine {

class RunSession;

/// Behind the steps of a case: where the case changed whom the device watches (1016h; 100Ch, 100Dh), the
/// heartbeats and guard requests that it sent last are sent on beside whatever follows, until the recorder
/// stops producing. Without them a device that answers slowly has lost us before its watch is taken back, and
/// may stop for it (1029h), so that nothing can be put back at all.
void keep_up_life_signs(RunSession& session);

}  // namespace conform::engine
