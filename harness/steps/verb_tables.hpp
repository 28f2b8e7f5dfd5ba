// SPDX-License-Identifier: Apache-2.0
// The tables of verbs, one per service; verbs.cpp joins them. Explicit on purpose: the linker drops self-registering
// objects out of static libraries.
#pragma once

#include <span>

#include "steps/step.hpp"

namespace conform::steps {

[[nodiscard]] std::span<const Verb> sdo_verbs();
[[nodiscard]] std::span<const Verb> nmt_verbs();
[[nodiscard]] std::span<const Verb> frame_verbs();
[[nodiscard]] std::span<const Verb> error_verbs();
[[nodiscard]] std::span<const Verb> flow_verbs();
[[nodiscard]] std::span<const Verb> conversation_verbs();
[[nodiscard]] std::span<const Verb> segment_verbs();

}  // namespace conform::steps
