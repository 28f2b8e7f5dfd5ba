// SPDX-License-Identifier: Apache-2.0
// A passive judge of every frame of a run: it never acts, and what the trace leaves open it accepts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "monitor/follower.hpp"
#include "result/verdict.hpp"

namespace conform::monitor {

class Monitor;

/// One row of the table of monitors: a case `monitor/<name>` of every run.
struct Rule {
  std::string_view name;
  std::string_view title;
  std::string_view nothing;  ///< why it is not applicable when it saw nothing to judge
  std::vector<std::string_view> requirements;
  std::unique_ptr<Monitor> (*make)(const Rule& rule);
  /// It judges what comes unasked, often in the light of much that came before: no single frame that it finds
  /// wrong makes another rule hard to judge.
  bool unasked = false;
};

/// All monitors in the order of reports.
[[nodiscard]] std::span<const Rule> rules();

/// One frame that violates a requirement.
struct Violation {
  std::size_t requirement = 0;                      ///< position in Rule::requirements
  result::Verdict verdict = result::Verdict::fail;  ///< before the level of the requirement caps it
  std::size_t index = 0;                            ///< of the frame in the trace
  can::Frame frame;
  std::string actual, expected, reason;
  bool if_alone = false;  ///< it stands only if nobody else was heard on the bus
};

class Monitor {
 public:
  /// So many violations of one requirement are kept with their frames; further ones are only counted.
  static constexpr std::size_t most_kept = 3;

  explicit Monitor(const Rule& rule) : rule_(rule), tallies_(rule.requirements.size()) {}
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;
  virtual ~Monitor() = default;

  virtual void on_frame(const Observation& seen, const Follower& follower) = 0;
  /// Whether on_frame() is called for such frames at all: most of a trace is no matter of most monitors.
  [[nodiscard]] virtual bool wants(Observation::Subject) const { return true; }
  /// Whether a violation is one of time: on a machine that was late, and that the device shares, it is open.
  [[nodiscard]] virtual bool rests_on_time(std::size_t /*requirement*/) const { return false; }
  /// Frames were lost before the next one.
  virtual void on_loss() {}
  /// The trace is over.
  void end(const Follower& follower);
  /// Some silence waits for a sign of life.
  [[nodiscard]] bool waits() const { return waits_; }
  /// The device sent a frame: it was there when it was silent before.
  void alive() {
    if (!waits_) return;
    waits_ = false;
    for (auto& tally : tallies_) {
      tally.judged += tally.quiet;
      tally.quiet = 0;
    }
  }

  struct Tally {
    std::size_t judged = 0;
    std::size_t violated = 0;
    std::size_t quiet = 0;     ///< silences that wait for a sign of life
    std::size_t if_alone = 0;  ///< of the violated ones, those that somebody else may have committed
  };
  [[nodiscard]] const Rule& rule() const { return rule_; }
  [[nodiscard]] const std::vector<Tally>& tallies() const { return tallies_; }
  [[nodiscard]] const std::vector<Violation>& violations() const { return violations_; }
  /// How many there have been, the ones that are not kept included.
  [[nodiscard]] std::size_t counted() const { return counted_; }

 protected:
  /// What can only be said when all has been seen.
  virtual void on_end(const Follower&) {}
  /// Something was judged and is right.
  void good(std::size_t requirement) { ++tallies_[requirement].judged; }
  /// Silence is due, and is right once the device is heard again: who is not there is silent, too.
  void quiet(std::size_t requirement) {
    ++tallies_[requirement].quiet;
    waits_ = true;
  }
  /// True: tell() the violation. False: it is counted only.
  [[nodiscard]] bool bad(std::size_t requirement) {
    auto& tally = tallies_[requirement];
    ++counted_;
    ++tally.judged;
    return ++tally.violated - tally.if_alone <= most_kept;
  }
  /// The same of a frame that may be another node's, if there is one. True: tell() it with `if_alone`.
  [[nodiscard]] bool bad_if_alone(std::size_t requirement) {
    auto& tally = tallies_[requirement];
    ++counted_;
    ++tally.judged;
    ++tally.violated;
    return ++tally.if_alone <= most_kept;
  }
  void tell(std::size_t requirement, const Observation& seen, std::string actual, std::string expected,
            std::string reason, result::Verdict verdict = result::Verdict::fail) {
    violations_.push_back({requirement, verdict, seen.index, seen.frame(), std::move(actual),
                           std::move(expected), std::move(reason)});
  }
  void tell_if_alone(std::size_t requirement, const Observation& seen, std::string actual,
                     std::string expected, std::string reason,
                     result::Verdict verdict = result::Verdict::fail) {
    violations_.push_back({requirement, verdict, seen.index, seen.frame(), std::move(actual),
                           std::move(expected), std::move(reason), true});
  }
  /// What was told so far has another verdict after all.
  void grade_all(result::Verdict verdict) {
    for (auto& violation : violations_) violation.verdict = verdict;
  }
  void tell(Violation violation) { violations_.push_back(std::move(violation)); }

 private:
  const Rule& rule_;
  std::vector<Tally> tallies_;
  std::vector<Violation> violations_;
  std::size_t counted_ = 0;
  bool waits_ = false;
};

}  // namespace conform::monitor
