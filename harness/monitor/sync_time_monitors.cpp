// SPDX-License-Identifier: Apache-2.0
// Monitors of SYNC and TIME: a device sends them only if it is their producer.
#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "monitor/factories.hpp"
#include "monitor/own_ids.hpp"

namespace conform::monitor {
namespace {

using Subject = Observation::Subject;

bool is_stopped(const Observation& seen, const Follower& follower) {
  return follower.nmt().commanded_to_sender(seen.time()) == canopen::NmtState::stopped;
}

/// Another object was moved away from this CAN-ID a moment ago: what waited to be sent then may come now.
bool may_be_late(const Observation& seen, const Follower& follower, std::uint16_t index) {
  constexpr auto moment = std::chrono::seconds(1);
  bool late = false;
  follower.entries().for_holders(seen.key(), [&](std::uint16_t other) {
    late = late || (other != index && holder(follower, other, seen.key()).held == Held::no &&
                    seen.time() - follower.entries().touched(other, other) < moment);
  });
  return late;
}

/// Received with the CAN-ID of the object, and with nothing else of the device that may send with it.
std::optional<Holder> from(const Observation& seen, const Follower& follower, std::uint16_t index) {
  if (seen.subject != Subject::data || !seen.received()) return std::nullopt;
  const auto found = holder(follower, index, seen.key());
  if (found.held == Held::no || other_holder(holders(follower, seen.key()), index, index) ||
      may_be_late(seen, follower, index))
    return std::nullopt;
  return found;
}

class SyncProducer final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { off, stopped, period, counter };

  [[nodiscard]] bool rests_on_time(std::size_t requirement) const override {
    return requirement == stopped || requirement == period;
  }

  [[nodiscard]] bool wants(Subject subject) const override {
    return subject == Subject::data || subject == Subject::nmt || subject == Subject::error_control;
  }
  void on_frame(const Observation& seen, const Follower& follower) override {
    if (seen.subject == Subject::nmt || seen.boot_up()) begin_anew();
    const auto found = from(seen, follower, 0x1005);
    if (!found) return;
    if (found->held == Held::off) {
      if (found->entry == nullptr || follower.nmt().is_newer(seen.time(), found->entry->since))
        accuse(off, seen, "a SYNC", "silence", "bit 30 of 1005h is 0: the device does not generate SYNC");
      return;
    }
    if (found->held != Held::yes) return;
    const auto* cycle = follower.entries().known(0x1006, 0);
    if (cycle != nullptr && cycle->value == 0 && follower.nmt().is_newer(seen.time(), cycle->since))
      return accuse(off, seen, "a SYNC", "silence", "1006h holds 0: no SYNC is generated");
    if (cycle != nullptr && cycle->value > 0) good(off);
    if (is_stopped(seen, follower))
      return accuse(stopped, seen, "a SYNC", "silence", "the device was stopped");
    if (cycle != nullptr) judge_period(seen, follower, *cycle, *found->entry);
    judge_counter(seen, follower, *found->entry);
  }
  void on_loss() override { begin_anew(); }

 private:
  static constexpr unsigned intervals = 10;

  void begin_anew() {
    count_ = 0;
    last_counter_.reset();
  }

  /// The mean of ten intervals; how exact the period is the scenarios judge.
  void judge_period(const Observation& seen, const Follower& follower, const Entries::Entry& cycle,
                    const Entries::Entry& cob_id) {
    const auto& nmt = follower.nmt();
    if (follower.entries().touched(0x1005, 0x1006) > begin_ || !nmt.is_newer(seen.time(), cycle.since) ||
        !nmt.is_newer(seen.time(), cob_id.since))
      count_ = 0;
    if (count_ == 0) begin_ = nmt.made_since(seen.time());
    if (count_++ < intervals) return;
    count_ = 0;
    const auto mean = Duration(seen.time() - begin_) / intervals;
    const Duration wanted = std::chrono::microseconds(cycle.value);
    if (mean >= wanted - wanted / 4 - std::chrono::milliseconds(1)) return good(period);
    accuse(period, seen, "a SYNC every " + to_string(mean), "every " + to_string(wanted),
           fmt::format("1006h holds {}", cycle.value));
  }

  void judge_counter(const Observation& seen, const Follower& follower, const Entries::Entry& cob_id) {
    const auto& entries = follower.entries();
    const auto& frame = seen.frame();
    const auto* overflow = entries.known(0x1019, 0);
    if (entries.touched(0x1005, 0x1006) > last_at_ || entries.touched(0x1019, 0x1019) > last_at_)
      last_counter_.reset();
    const auto before = std::exchange(last_counter_, std::nullopt);
    last_at_ = seen.time();
    const bool none = entries.is_absent(0x1019, 0);
    if (overflow == nullptr && !none) return;
    if (!follower.nmt().is_newer(seen.time(), cob_id.since) ||
        (overflow != nullptr && !follower.nmt().is_newer(seen.time(), overflow->since)))
      return;
    const unsigned most = none ? 0 : overflow->value;
    if (most == 1 || most > 240) return;
    if (frame.dlc != (most == 0 ? 0 : 1))
      return accuse(counter, seen, fmt::format("DLC {}", frame.dlc), most == 0 ? "DLC 0" : "DLC 1",
                    fmt::format("1019h {}", most == 0 ? "is 0" : "gives SYNC a counter"));
    if (most == 0) return good(counter);
    const unsigned value = frame.data[0];
    last_counter_ = value;
    // After a pause it may have begun anew.
    const bool follows = !before || value == *before % most + 1 || value == 1;
    if (follows && value >= 1 && value <= most) return good(counter);
    accuse(counter, seen, fmt::format("counter {}", value),
           before ? fmt::format("counter {}", *before % most + 1) : fmt::format("counter 1 to {}", most),
           fmt::format("1019h holds {}", most));
  }

  void accuse(std::size_t requirement, const Observation& seen, std::string actual, std::string expected,
              std::string reason) {
    if (bad_if_alone(requirement))
      tell_if_alone(requirement, seen, std::move(actual), std::move(expected), std::move(reason));
  }

  unsigned count_ = 0;
  BusTime begin_{}, last_at_{};
  std::optional<unsigned> last_counter_;
};

class TimeProducer final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { off, stopped, form };

  [[nodiscard]] bool rests_on_time(std::size_t requirement) const override { return requirement == stopped; }

  [[nodiscard]] bool wants(Subject subject) const override { return subject == Subject::data; }
  void on_frame(const Observation& seen, const Follower& follower) override {
    const auto found = from(seen, follower, 0x1012);
    if (!found) return;
    if (found->held == Held::off) {
      // A frame of another length is another message: an EMCY that was late, where 1014h had this CAN-ID
      // before.
      if (seen.frame().dlc != 6) return;
      if (found->entry == nullptr || follower.nmt().is_newer(seen.time(), found->entry->since))
        accuse(off, seen, "a TIME message", "silence",
               "bit 30 of 1012h is 0: the device does not produce TIME");
      return;
    }
    if (found->held != Held::yes) return;
    good(off);
    if (is_stopped(seen, follower))
      accuse(stopped, seen, "a TIME message", "silence", "the device was stopped");
    const auto& frame = seen.frame();
    constexpr std::uint32_t day = 86'400'000;
    const auto ms = static_cast<std::uint32_t>(load_le(ByteView(frame.data).first(4)));
    if (frame.dlc == 6 && ms < day) return good(form);
    accuse(form, seen, fmt::format("DLC {}, {} ms", frame.dlc, ms), "DLC 6, less than 86400000 ms",
           "the message is a TIME_OF_DAY with its reserved bits 0");
  }

 private:
  void accuse(std::size_t requirement, const Observation& seen, std::string actual, std::string expected,
              std::string reason) {
    if (bad_if_alone(requirement))
      tell_if_alone(requirement, seen, std::move(actual), std::move(expected), std::move(reason));
  }
};

}  // namespace

std::unique_ptr<Monitor> make_sync_producer(const Rule& rule) { return std::make_unique<SyncProducer>(rule); }
std::unique_ptr<Monitor> make_time_producer(const Rule& rule) { return std::make_unique<TimeProducer>(rule); }

}  // namespace conform::monitor
