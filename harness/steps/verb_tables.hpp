// SPDX-License-Identifier: Apache-2.0
// The tables of verbs, one per service; verbs.cpp joins them. Explicit on purpose: the linker drops
// self-registering objects out of static libraries.
#pragma once

#include <span>

#include "steps/step.hpp"

namespace conform::steps {

[[nodiscard]] std::span<const Verb> sdo_verbs();
[[nodiscard]] std::span<const Verb> interleave_verbs();
[[nodiscard]] std::span<const Verb> nmt_verbs();
[[nodiscard]] std::span<const Verb> frame_verbs();
[[nodiscard]] std::span<const Verb> collect_verbs();
[[nodiscard]] std::span<const Verb> error_verbs();
[[nodiscard]] std::span<const Verb> lss_verbs();
[[nodiscard]] std::span<const Verb> pdo_verbs();
[[nodiscard]] std::span<const Verb> ready_verbs();
[[nodiscard]] std::span<const Verb> flow_verbs();
[[nodiscard]] std::span<const Verb> conversation_verbs();
[[nodiscard]] std::span<const Verb> segment_verbs();
[[nodiscard]] std::span<const Verb> description_verbs();
[[nodiscard]] std::span<const Verb> noise_verbs();
[[nodiscard]] std::span<const Verb> guard_verbs();

/// The first frame of ours recorded at or behind `begin`, for labels of sending steps.
[[nodiscard]] inline std::optional<std::size_t> sent_frame(const Session& session, std::size_t begin) {
  const auto& frames = session.capture().frames();
  for (auto i = begin; i < frames.size(); ++i) {
    if (frames[i].direction == can::Direction::transmitted) return i;
  }
  return std::nullopt;
}

}  // namespace conform::steps
