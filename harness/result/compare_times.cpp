// SPDX-License-Identifier: Apache-2.0
#include "result/compare_times.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace conform::result {
namespace {

using Times = std::vector<Duration>;
using std::chrono::milliseconds;

constexpr std::size_t fewest_samples = 8;
/// Corrected for the number of series: one false word in a thousand comparisons.
constexpr double surest = 1e-3;
/// So many of all pairs must point in one direction.
constexpr double most_pairs = 0.8;

/// A difference that is worth a word. What is below comes and goes with the load of the host.
struct Worth {
  double share;  ///< of the shorter one, or of the nominal time
  Duration least;
};
constexpr Worth of_answers{0.5, milliseconds(1)};
constexpr Worth of_boot_ups{0.25, milliseconds(5)};
constexpr Worth of_periods{0.02, milliseconds(1)};
constexpr Worth of_spreads{0.1, milliseconds(5)};

bool differs(Duration one, Duration other, const Worth& worth, std::optional<Duration> nominal) {
  const auto base = nominal.value_or(std::min(one, other));
  const auto least = std::max(
      worth.least, Duration(static_cast<Duration::rep>(worth.share * static_cast<double>(base.count()))));
  return std::chrono::abs(one - other) >= least;
}

Times times_of(const Measurement& of) {
  Times out;
  for (const auto& sample : of.samples) out.push_back(sample.value);
  std::ranges::sort(out);
  return out;
}

/// How far each is from the middle.
Times distances(const Times& times) {
  const auto middle = quantile(times, 0.5);
  Times out;
  for (const auto each : times) out.push_back(std::chrono::abs(each - middle));
  return out;
}

Duration spread(const Times& times) { return quantile(times, 0.95) - quantile(times, 0.05); }

/// What two series of one kind say, as far as it is large enough; `p` is not yet corrected.
std::optional<TimesChange> change_of(const Times& before, const Times& after, const Worth& worth,
                                     std::optional<Duration> nominal) {
  TimesChange out;
  out.samples_before = before.size();
  out.samples_after = after.size();
  const auto is_large = [](double longer) { return longer >= most_pairs || longer <= 1 - most_pairs; };
  out.before = quantile(before, 0.5);
  out.after = quantile(after, 0.5);
  if (differs(out.before, out.after, worth, nominal)) {
    const auto test = rank_test(before, after);
    out.p = test.p;
    out.longer = test.longer;
    return is_large(test.longer) ? std::optional(out) : std::nullopt;
  }
  if (!nominal) return std::nullopt;
  out.is_spread = true;
  out.before = spread(before);
  out.after = spread(after);
  if (!differs(out.before, out.after, of_spreads, nominal)) return std::nullopt;
  const auto test = rank_test(distances(before), distances(after));
  out.p = test.p;
  out.longer = test.longer;
  return is_large(test.longer) ? std::optional(out) : std::nullopt;
}

class TimesComparison {
 public:
  TimesComparison(const RunResult& before, const RunResult& after) {
    std::map<std::pair<std::string, std::string>, const Measurement*> old;
    for (const auto& each : before.measurements) old[{each.kind, each.of}] = &each;
    for (const auto& each : after.measurements) {
      const auto found = old.find({each.kind, each.of});
      if (found != old.end()) add(*found->second, each);
    }
  }

  std::vector<TimesChange> take() {
    std::vector<TimesChange> out;
    std::vector<std::string> told;
    for (auto& [kind, pool] : pools_) {
      std::ranges::sort(pool.first);
      std::ranges::sort(pool.second);
      if (auto change = change_of(pool.first, pool.second, of_answers, {}); change && is_sure(*change)) {
        change->kind = kind;
        told.push_back(kind);
        out.push_back(std::move(*change));
      }
    }
    for (auto& each : changes_) {
      if (is_sure(each) && std::ranges::find(told, each.kind) == told.end()) out.push_back(std::move(each));
    }
    return out;
  }

 private:
  void add(const Measurement& before, const Measurement& after) {
    const bool is_answer = before.kind.ends_with("answer");
    const bool is_boot_up = before.kind == "boot-up";
    // What comes when a scenario makes it come says more of the scenario than of the device.
    if (!is_answer && !is_boot_up && !before.nominal) return;
    if (before.nominal != after.nominal) return;
    const auto one = times_of(before);
    const auto other = times_of(after);
    if (one.size() < fewest_samples || other.size() < fewest_samples) return;
    ++series_;
    if (is_answer) {
      auto& pool = pools_[before.kind];
      pool.first.insert(pool.first.end(), one.begin(), one.end());
      pool.second.insert(pool.second.end(), other.begin(), other.end());
    }
    const auto& worth = is_answer ? of_answers : is_boot_up ? of_boot_ups : of_periods;
    if (auto change = change_of(one, other, worth, before.nominal)) {
      change->kind = before.kind;
      change->of = before.of;
      changes_.push_back(std::move(*change));
    }
  }

  bool is_sure(TimesChange& change) const {
    change.p = std::min(1.0, change.p * static_cast<double>(series_ + pools_.size()));
    return change.p <= surest;
  }

  std::size_t series_ = 0;
  std::map<std::string, std::pair<Times, Times>> pools_;  ///< all of a kind
  std::vector<TimesChange> changes_;
};

}  // namespace

RankTest rank_test(std::span<const Duration> first, std::span<const Duration> second) {
  if (first.empty() || second.empty()) return {};
  std::vector<std::pair<Duration, bool>> all;
  for (const auto each : first) all.emplace_back(each, false);
  for (const auto each : second) all.emplace_back(each, true);
  std::ranges::sort(all);
  const auto n1 = static_cast<double>(first.size());
  const auto n2 = static_cast<double>(second.size());
  const double n = n1 + n2;
  double ranks = 0, ties = 0;  // sum of the ranks of the second series; sum of t^3 - t
  for (std::size_t begin = 0; begin < all.size();) {
    std::size_t end = begin;
    while (end < all.size() && all[end].first == all[begin].first) ++end;
    const auto size = static_cast<double>(end - begin);
    const double rank = static_cast<double>(begin) + (size + 1) / 2;
    for (std::size_t i = begin; i < end; ++i) ranks += all[i].second ? rank : 0;
    ties += size * size * size - size;
    begin = end;
  }
  const double u = ranks - n2 * (n2 + 1) / 2;
  RankTest out;
  out.longer = u / (n1 * n2);
  const double variance = n1 * n2 / 12 * (n + 1 - ties / (n * (n - 1)));
  if (variance <= 0) return out;  // all the same
  // With the correction for continuity: what is one step from the middle is no evidence.
  const double distance = std::max(0.0, std::abs(u - n1 * n2 / 2) - 0.5);
  out.p = std::erfc(distance / std::sqrt(variance) / std::sqrt(2.0));
  return out;
}

Duration quantile(std::span<const Duration> sorted, double share) {
  const auto last = static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(std::lround(share * last))];
}

TimesSeries series_of(const TimesChange& change, const RunResult& before, const RunResult& after) {
  TimesSeries out;
  for (const auto& now : after.measurements) {
    if (now.kind != change.kind || (!change.of.empty() && now.of != change.of)) continue;
    for (const auto& was : before.measurements) {
      if (was.kind != now.kind || was.of != now.of) continue;
      if (was.samples.size() < fewest_samples || now.samples.size() < fewest_samples) continue;
      out.before.insert(out.before.end(), was.samples.begin(), was.samples.end());
      out.after.insert(out.after.end(), now.samples.begin(), now.samples.end());
    }
  }
  return out;
}

std::vector<TimesChange> times_changes(const RunResult& before, const RunResult& after) {
  return TimesComparison(before, after).take();
}

}  // namespace conform::result
