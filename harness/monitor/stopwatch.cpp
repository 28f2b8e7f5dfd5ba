// SPDX-License-Identifier: Apache-2.0
#include "monitor/stopwatch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/text.hpp"
#include "can/frame_time.hpp"
#include "monitor/own_ids.hpp"

namespace conform::monitor {
namespace {

using Subject = Observation::Subject;

constexpr std::uint16_t sync_index = 0x1005, heartbeat_index = 0x1017;

}  // namespace

void Stopwatch::add(const std::string& kind, const std::string& of, const Limits& limits, BusTime at,
                    Duration value) {
  if (value < Duration::zero()) return;  // what is written in two orders says nothing
  auto& [told, sum, stride] = series_[{kind, of}];
  if (told.count == 0) {
    told.kind = kind;
    told.of = of;
    told.nominal = limits.nominal;
    told.least = limits.least;
    told.most = limits.most;
    told.shortest = told.longest = value;
  }
  told.shortest = std::min(told.shortest, value);
  told.longest = std::max(told.longest, value);
  sum += value;
  if (told.count++ % stride != 0) return;
  told.samples.push_back({at, value});
  if (told.samples.size() < 2 * most_samples) return;
  stride *= 2;
  for (std::size_t i = 0; i < most_samples; ++i) told.samples[i] = told.samples[2 * i];
  told.samples.resize(most_samples);
}

void Stopwatch::on_frame(const Observation& seen, const Follower& follower) {
  switch (seen.subject) {
    case Subject::sdo_request: {
      // Of several open requests nobody knows which one is answered.
      const bool alone = seen.frame().id == 0x600U + follower.facts().node.value() && !seen.frame().remote;
      asked_ = alone && !asked_ ? std::optional(seen.time()) : std::nullopt;
      break;
    }
    case Subject::sdo_response: answer(seen); break;
    case Subject::error_control: heartbeat(seen, follower); break;
    case Subject::data: produced(seen, follower); break;
    case Subject::nmt: command(seen, follower); break;
    // Without node-ID it waits until it is given one.
    case Subject::lss_request: reset_.reset(); break;
    default: break;
  }
}

void Stopwatch::answer(const Observation& seen) {
  if (!seen.answer.default_channel) return;
  const auto asked = std::exchange(asked_, std::nullopt);
  if (seen.answer.mux) object_ = seen.answer.mux->got;
  if (asked && object_ && seen.answer.to == SdoAnswer::To::request)
    add("SDO answer", to_string(*object_), {}, seen.time(), seen.time() - *asked);
}

void Stopwatch::heartbeat(const Observation& seen, const Follower& follower) {
  // It may answer a guarding request, or be a heartbeat.
  if (seen.guarded || seen.guard_answer) return heartbeat_.reset();
  if (seen.boot_up()) {
    if (reset_) {
      add("boot-up", reset_->second, {.most = follower.facts().boot_time}, seen.time(),
          seen.time() - reset_->first);
    }
    return forget_intervals();
  }
  const auto before = std::exchange(heartbeat_, seen.time());
  const auto* period = follower.entries().known(heartbeat_index, 0);
  if (!before || period == nullptr || period->value == 0 || period->since > *before ||
      follower.entries().touched(heartbeat_index, heartbeat_index) > *before)
    return;
  const Duration nominal = std::chrono::milliseconds(period->value);
  add("heartbeat", "1017h = " + to_string(nominal),
      {.nominal = nominal, .least = nominal - nominal / 10, .most = nominal + nominal / 10}, seen.time(),
      seen.time() - *before);
}

/// SYNC and TPDOs of the device, as far as an entry that was seen says that they are.
void Stopwatch::produced(const Observation& seen, const Follower& follower) {
  if (!seen.received()) return;
  const auto found = holders(follower, seen.key());
  if (found.size() != 1 || found.front().held != Held::yes) return;
  const auto index = found.front().index;
  const auto& entries = follower.entries();
  const auto [at, first] = produced_.try_emplace(seen.key(), seen.time());
  const auto before = std::exchange(at->second, seen.time());
  if (first) return;
  if (index == sync_index) {
    const auto* cycle = entries.known(0x1006, 0);
    if (cycle == nullptr || cycle->value == 0 || cycle->since > before ||
        entries.touched(sync_index, 0x1006) > before)
      return;
    const Duration nominal = std::chrono::microseconds(cycle->value);
    add("SYNC", "1006h = " + to_string(nominal), {.nominal = nominal}, seen.time(), seen.time() - before);
  } else if (is_tpdo(index) && entries.touched(index, index) <= before) {
    add("TPDO", fmt::format("{:X}h", index), {}, seen.time(), seen.time() - before);
  }
}

void Stopwatch::command(const Observation& seen, const Follower& follower) {
  const auto& frame = seen.frame();
  if (frame.size() < 2 || (frame.data[1] != 0 && frame.data[1] != follower.facts().node.value())) return;
  forget_intervals();
  if (frame.data[0] == 0x81) reset_ = {seen.time(), "reset node"};
  if (frame.data[0] == 0x82) reset_ = {seen.time(), "reset communication"};
}

void Stopwatch::forget_intervals() {
  heartbeat_.reset();
  produced_.clear();
  asked_.reset();
  object_.reset();
  reset_.reset();
}

void Stopwatch::on_loss() { forget_intervals(); }

std::vector<result::Measurement> Stopwatch::take() const {
  std::vector<result::Measurement> out;
  for (const auto& [name, series] : series_) {
    out.push_back(series.told);
    out.back().mean = series.sum / static_cast<Duration::rep>(series.told.count);
  }
  return out;
}

std::vector<result::Measurement> measure(std::span<const can::CapturedFrame> frames, const Facts& facts,
                                         std::span<const Loss> losses) {
  Follower follower(facts);
  Stopwatch stopwatch;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (std::ranges::any_of(losses, [i](const Loss& loss) { return loss.end == i; })) {
      follower.lose_track();
      stopwatch.on_loss();
    }
    stopwatch.on_frame(follower.follow(frames[i], i), follower);
    follower.settle();
  }
  return stopwatch.take();
}

std::vector<result::BusLoad> load_of(std::span<const can::CapturedFrame> frames, std::uint32_t bit_rate,
                                     std::size_t slices) {
  if (frames.empty() || slices == 0) return {};
  const auto begin = frames.front().time;
  const auto whole = std::max<Duration>(frames.back().time - begin, Duration(1));
  const Duration span = std::max<Duration>(whole / static_cast<Duration::rep>(slices) + Duration(1),
                                           std::chrono::milliseconds(100));
  std::vector<result::BusLoad> out(static_cast<std::size_t>(whole / span) + 1);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = {.from = begin + span * static_cast<Duration::rep>(i), .span = span};
  for (const auto& each : frames) {
    if (each.frame.error) continue;
    // A clock that was set may have gone back.
    const auto at =
        std::clamp<Duration::rep>((each.time - begin) / span, 0, static_cast<Duration::rep>(out.size() - 1));
    auto& slice = out[static_cast<std::size_t>(at)];
    ++slice.frames;
    if (bit_rate > 0)
      slice.busy += can::bit_time(can::frame_bits(each.frame) + can::intermission_bits, bit_rate);
  }
  return out;
}

}  // namespace conform::monitor
