// SPDX-License-Identifier: Apache-2.0
#include "steps/contents.hpp"

#include <algorithm>
#include <chrono>

#include "base/bytes.hpp"
#include "base/check.hpp"

namespace conform::steps {

std::optional<std::size_t> common_length(CapturedFrames frames) {
  CONFORM_CHECK(!frames.empty());
  const auto length = frames.front()->frame.size();
  const bool all = std::ranges::all_of(
      frames, [length](const auto* captured) { return captured->frame.size() == length; });
  return all ? std::optional(length) : std::nullopt;
}

std::size_t out_of_order(CapturedFrames frames, std::uint64_t overflow) {
  std::size_t wrong = 0;
  std::optional<std::uint64_t> last;
  for (const auto* captured : frames) {
    const auto& frame = captured->frame;
    if (frame.size() != 1) {
      ++wrong;
      continue;
    }
    const std::uint64_t count = frame.data[0];
    const bool in_range = count >= 1 && count <= overflow;
    const bool next = !last || count == (*last >= overflow ? 1 : *last + 1);
    if (!in_range || !next) ++wrong;
    last = count;
  }
  return wrong;
}

TimesOfDay times_of_day(CapturedFrames frames) {
  using std::chrono::milliseconds;
  constexpr std::uint64_t day = 86'400'000;
  constexpr std::uint64_t reserved = 0xF000'0000;
  TimesOfDay out;
  std::optional<Duration> ahead;  // of the bus, at the first frame
  for (const auto* captured : frames) {
    const auto& frame = captured->frame;
    const auto value = frame.size() == 6 ? load_le(frame.bytes()) : reserved;
    const auto after_midnight = value & 0x0FFF'FFFFU;
    if ((value & reserved) != 0 || after_midnight >= day) {
      ++out.malformed;
      continue;
    }
    const auto told = (value >> 32U) * day + after_midnight;
    const Duration difference =
        Duration(milliseconds(static_cast<std::int64_t>(told))) - captured->time.time_since_epoch();
    if (!ahead) ahead = difference;
    out.drift = std::max(out.drift, std::chrono::abs(difference - *ahead));
  }
  return out;
}

}  // namespace conform::steps
