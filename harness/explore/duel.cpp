// SPDX-License-Identifier: Apache-2.0
#include "explore/duel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "base/text.hpp"
#include "explore/own_affairs.hpp"
#include "explore/world.hpp"

namespace conform::explore {
namespace {

using namespace std::chrono_literals;
using What = Difference::What;

/// How far two equal frames may lie apart, beside what the answers before them took longer.
constexpr Duration tolerance = 4ms;
/// How long each frame is waited for. What comes where the model is silent and later than this is a frame
/// that nobody asked for; but a transfer that breaks off by a fault has answers before.
constexpr Duration model_patience = 500ms;
constexpr Duration stopped_patience = 10ms;
constexpr Duration device_patience = 3000ms;
/// A device with which something differs is heard for so long after that, so that a model that is only late
/// is not taken for one that agrees.
constexpr Duration behind_difference = 300ms;
/// An answer so much later than the model's is worth telling.
constexpr Duration late_answer = 80ms;

bool same_kind(const can::Frame& one, const can::Frame& other) {
  return one.id == other.id && one.extended == other.extended && one.remote == other.remote;
}

bool same_data(const can::Frame& one, const can::Frame& other) {
  return one.dlc == other.dlc && (one.remote || std::ranges::equal(one.bytes(), other.bytes()));
}

std::string outcome(const Answer& answer) {
  switch (answer.kind) {
    case Answer::Kind::none: return "none";
    case Answer::Kind::confirmed: return "confirmed";
    case Answer::Kind::aborted: return hex(answer.code.value(), 8);
    case Answer::Kind::violation: return "violation";
    case Answer::Kind::silence: return "silence";
    case Answer::Kind::replied: return "reply";
  }
  return "";
}

class Duel {
 public:
  Duel(Side& device, std::unique_ptr<can::Participant> model, const Bench& bench)
      : device_(device),
        model_(std::make_unique<SimulatedPlace>(std::move(model), bench.bus_seed), bench.facts, {}),
        silent_patience_(bench.answer_time),
        jitter_(bench.jitter),
        may_be_slower_(bench.model_may_be_slower),
        affairs_(bench.is_own_affair, bench.facts.node, bench.own_cob_ids) {
    // How long they take to boot is not compared, only what they say then: both clocks begin behind it.
    device_zero_ = device_.now();
    model_zero_ = model_.now();
    auto& came = device_.unasked();
    auto& due = model_.unasked();
    while (!came.empty() && !due.empty() && came.front().frame == due.front().frame) {
      came.erase(came.begin());
      due.erase(due.begin());
    }
  }

  std::optional<Difference> perform(const Action& action, std::size_t number) {
    affairs_.note(action);
    const bool acts = action.kind != Action::Kind::wait;
    if (acts) acted_.push_back(device_.now());
    // A model that only takes longer than we wait for it is no explanation of a device that says nothing.
    const auto patience = std::max(model_patience, device_.will_be_silent());
    const auto answer_of_model = model_.perform(action, model_.stopped() ? stopped_patience : patience);
    const bool silent = answer_of_model.kind == Answer::Kind::silence;
    const auto answer_of_device = device_.perform(action, !silent                ? device_patience
                                                          : action.fault.empty() ? silent_patience_
                                                                                 : model_patience);
    if (acts) acted_.push_back(device_.now());
    // Where both say nothing, it is only we who wait longer for the one.
    const bool both_silent = silent && answer_of_device.kind == Answer::Kind::silence;
    if (!both_silent) drift_ += std::chrono::abs(answer_of_device.taken - answer_of_model.taken);
    meet();
    auto out = look();
    if (!out && !answer_of_device.same_as(answer_of_model) &&
        !affairs_.excuse(action, answer_of_device, answer_of_model)) {
      out.emplace();
      out->what = What::answer;
    } else if (!out && !both_silent && answer_of_device.kind == answer_of_model.kind &&
               is_late(answer_of_device.answered - answer_of_model.answered)) {
      out.emplace();
      out->what = What::late;
    }
    if (out) out->action = number;
    answer_ = answer_of_device;
    due_ = answer_of_model;
    if (out && out->is_about_an_answer()) {
      out->device = answer_;
      out->model = due_;
    }
    return out;
  }

  /// What is still on its way comes, and what should have come is late.
  std::optional<Difference> finish() {
    meet(2 * allowance());
    return look();
  }

  /// A device that was recorded is known up to the end of that: a model that agrees by then only because it
  /// is slow has not agreed.
  std::optional<Difference> finish_at(BusTime end) {
    if (auto out = finish()) return out;
    meet(std::max(Duration(0), end - device_.now()));
    return look();
  }

  /// What came behind a difference, for models with which there is none.
  void listen_on(Duration more = Duration(0)) {
    device_.run_until(device_.now() + std::max(2 * allowance(), more));
  }

  /// To the last action, of the device and of the model.
  [[nodiscard]] const Answer& answer() const { return answer_; }
  [[nodiscard]] const Answer& due() const { return due_; }

 private:
  /// Both sides to the same time behind their beginning: the later one, and `more`.
  void meet(Duration more = Duration(0)) {
    const auto since = std::max(device_.now() - device_zero_, model_.now() - model_zero_) + more;
    device_.run_until(device_zero_ + since);
    model_.run_until(model_zero_ + since);
  }

  /// A frame of the model on the clock of the device.
  [[nodiscard]] Unasked of_model(Unasked each) const {
    each.time += device_zero_ - model_zero_;
    return each;
  }

  std::optional<Difference> look() {
    if (!device_.broken().empty()) {
      Difference out;
      out.what = What::broken;
      out.text = device_.broken();
      return out;
    }
    if (auto rule = broken_rule()) return rule;
    return match();
  }

  /// By how much the device answered later than the model.
  [[nodiscard]] bool is_late(Duration by) const {
    const auto most = late_answer + jitter_;
    return by > most || (!may_be_slower_ && -by > most);
  }

  [[nodiscard]] Duration allowance() const { return tolerance + jitter_ + drift_; }

  std::optional<Difference> broken_rule() {
    if (device_.watch() == nullptr || device_.watch()->counted() == counted_) return std::nullopt;
    counted_ = device_.watch()->counted();
    const monitor::Violation* newest = nullptr;
    const monitor::Rule* rule = nullptr;
    for (const auto& each : device_.watch()->monitors()) {
      for (const auto& violation : each->violations()) {
        if (violation.verdict != result::Verdict::fail || violation.if_alone) continue;
        if (newest != nullptr && newest->index >= violation.index) continue;
        newest = &violation;
        rule = &each->rule();
      }
    }
    if (newest == nullptr) return std::nullopt;
    Difference out;
    out.what = What::rule;
    out.requirement = rule->requirements[newest->requirement];
    out.came = newest->frame;
    out.trace_index = newest->index;
    out.text = fmt::format("{}; expected: {}", newest->actual, newest->expected);
    if (!newest->reason.empty()) out.text += fmt::format(" ({})", newest->reason);
    return out;
  }

  /// Pairs the frames of both sides in their order, and tells the first that has no partner in time.
  std::optional<Difference> match() {
    for (auto& each : std::exchange(device_.unasked(), {})) {
      if (affairs_.hold(each.frame)) continue;
      if (auto other = pair(each, of_model_)) return differs(each, *other);
    }
    for (const auto& said : std::exchange(model_.unasked(), {})) {
      const auto each = of_model(said);
      if (affairs_.hold(each.frame)) continue;
      const auto partner = std::ranges::find_if(
          of_device_, [&](const Unasked& other) { return same_kind(each.frame, other.frame); });
      if (partner == of_device_.end()) {
        of_model_.push_back(each);
        continue;
      }
      const auto device = *partner;
      of_device_.erase(partner);
      if (!agree(device.frame, each.frame)) return differs(device, each);
      if (is_apart(device, each)) return off_time(device, each);
      ++paired_[each.frame.id];
    }
    return overdue();
  }

  /// The waiting frame of the model with which `each` does not agree; otherwise it is paired or kept.
  std::optional<Unasked> pair(const Unasked& each, std::vector<Unasked>& waiting) {
    const auto partner = std::ranges::find_if(
        waiting, [&](const Unasked& other) { return same_kind(each.frame, other.frame); });
    if (partner == waiting.end()) {
      of_device_.push_back(each);
      return std::nullopt;
    }
    const auto other = *partner;
    waiting.erase(partner);
    if (agree(each.frame, other.frame) && !is_apart(each, other)) {
      ++paired_[each.frame.id];
      return std::nullopt;
    }
    return other;
  }

  [[nodiscard]] bool agree(const can::Frame& device, const can::Frame& model) const {
    return same_data(device, model) || affairs_.excuse(device, model);
  }

  [[nodiscard]] bool is_apart(const Unasked& one, const Unasked& other) const {
    return std::chrono::abs(one.time - other.time) > allowance();
  }

  [[nodiscard]] std::optional<Difference> differs(const Unasked& device, const Unasked& model) const {
    if (agree(device.frame, model.frame)) return off_time(device, model);
    Difference out;
    out.what = What::other_data;
    out.came = device.frame;
    out.due = model.frame;
    out.time = device.time;
    return out;
  }

  /// The right frame at the wrong time is one too many before the time and one too few behind it.
  [[nodiscard]] static std::optional<Difference> off_time(const Unasked& device, const Unasked& model) {
    Difference out;
    out.what = device.time < model.time ? What::surplus : What::missing;
    out.came = device.frame;
    out.due = model.frame;
    out.time = std::min(device.time, model.time);
    return out;
  }

  /// Of frames that come again and again one more or less where something was done is a matter of when it was
  /// done, which nobody knows to less than the jitter. The next one is not.
  [[nodiscard]] bool is_on_the_edge(const Unasked& each) const {
    constexpr unsigned again = 2;
    const auto paired = paired_.find(each.frame.id);
    if (jitter_ == Duration(0) || paired == paired_.end() || paired->second < again) return false;
    return std::ranges::any_of(acted_, [&](BusTime time) {
      return each.time >= time - tolerance - jitter_ && each.time <= time + tolerance + jitter_;
    });
  }

  std::optional<Difference> overdue() {
    const auto too_late = [&](const Unasked& each) { return each.time + allowance() < device_.now(); };
    if (jitter_ > Duration(0)) {
      const auto passes = [&](const Unasked& each) { return too_late(each) && is_on_the_edge(each); };
      std::erase_if(of_model_, passes);
      std::erase_if(of_device_, passes);
    }
    if (const auto due = std::ranges::find_if(of_model_, too_late); due != of_model_.end()) {
      Difference out;
      out.what = What::missing;
      out.due = due->frame;
      out.time = due->time;
      return out;
    }
    if (const auto came = std::ranges::find_if(of_device_, too_late); came != of_device_.end()) {
      Difference out;
      out.what = What::surplus;
      out.came = came->frame;
      out.time = came->time;
      return out;
    }
    return std::nullopt;
  }

  Side& device_;
  World model_;
  BusTime device_zero_{}, model_zero_{};
  Duration silent_patience_, jitter_;
  bool may_be_slower_;
  OwnAffairs affairs_;
  Answer answer_, due_;
  std::vector<Unasked> of_device_, of_model_;  ///< waiting for their partners
  std::map<std::uint32_t, unsigned> paired_;   ///< frames of each CAN-ID that both have sent
  std::vector<BusTime> acted_;  ///< when the actions began and ended, on the clock of the device
  Duration drift_{};            ///< how much more or less time the answers of the device have taken, in all
  std::size_t counted_ = 0;
};

}  // namespace

std::string Difference::signature(std::span<const Action> conversation) const {
  switch (what) {
    case What::rule: return "rule " + requirement;
    case What::broken: return "broken";
    case What::gone: return "gone";
    case What::missing: return fmt::format("missing {}", hex(due.id, 3));
    case What::surplus: return fmt::format("surplus {}", hex(came.id, 3));
    case What::other_data: return fmt::format("data {}", hex(came.id, 3));
    case What::answer:
    case What::late: break;
  }
  const auto& last = conversation[std::min(action, conversation.size() - 1)];
  const auto about = last.is_transfer() ? to_string(last.object) : std::string("request");
  return fmt::format("{} {}{} {} {}", what == What::late ? "late" : "answer",
                     last.kind == Action::Kind::upload ? "upload " : "", about, outcome(device),
                     outcome(model));
}

namespace {

Result<std::unique_ptr<Place>> place_of(const Bench& bench) {
  if (bench.place) return bench.place();
  auto device = bench.device();
  if (!device) return std::unexpected(device.error());
  return std::make_unique<SimulatedPlace>(std::move(*device), bench.bus_seed);
}

/// Where it confirmed a download that the model refused: what it holds now, whatever the model does.
void ask_what_it_holds(std::span<const Action> conversation, Side& device, Played& out) {
  if (!out.difference || out.difference->what != What::answer) return;
  const auto& last = conversation[out.difference->action];
  const bool taken = out.difference->device.kind == Answer::Kind::confirmed &&
                     out.difference->model.kind == Answer::Kind::aborted;
  if (last.kind == Action::Kind::download && taken)
    out.holds = device.perform(upload(last.object), device_patience);
}

/// `end`: of a device that was recorded.
Result<Played> play(const Bench& bench, std::span<const Action> conversation, Side& device, bool keep,
                    std::optional<BusTime> end = std::nullopt) {
  auto model = bench.model();
  if (!model) return std::unexpected(model.error());
  Duel duel(device, std::move(*model), bench);
  Played out;
  for (std::size_t i = 0; i < conversation.size() && !out.difference && !device.fault(); ++i) {
    if (keep) out.begins.push_back(device.now());
    out.difference = duel.perform(conversation[i], i);
    ++out.actions;
    out.answers.push_back(duel.answer());
    if (keep) out.due.push_back(duel.due());
  }
  if (!out.difference) {
    out.difference = end ? duel.finish_at(*end) : duel.finish();
    if (out.difference) out.difference->action = conversation.empty() ? 0 : conversation.size() - 1;
  } else if (keep) {
    duel.listen_on();
  }
  if (keep) out.trace = device.trace();
  if (keep && out.difference) duel.listen_on(behind_difference);
  if (device.fault()) return std::unexpected(*device.fault());
  if (device.distrusted()) {
    out.distrusted = true;
    out.difference.reset();
  }
  if (keep) ask_what_it_holds(conversation, device, out);
  const auto back = device.comes_back();
  if (!back) return std::unexpected(back.error());
  if (!*back) {
    out.distrusted = false;
    out.difference.emplace();
    out.difference->what = What::gone;
    out.difference->action = std::max<std::size_t>(out.actions, 1) - 1;
  }
  return out;
}

}  // namespace

Result<Played> play(const Bench& bench, std::span<const Action> conversation, bool keep) {
  auto place = place_of(bench);
  if (!place) return std::unexpected(place.error());
  auto world = std::make_unique<World>(std::move(*place), bench.facts, bench.monitors);
  if (!keep) return play(bench, conversation, *world, false);
  Recorder device(std::move(world));
  if (device.fault()) return std::unexpected(*device.fault());
  auto out = play(bench, conversation, device, true);
  if (!out) return out;
  auto recording = device.recording();
  // Not what was asked behind it.
  recording.answers.resize(out->actions);
  recording.ends.resize(out->actions);
  out->recording = std::make_shared<const Recording>(std::move(recording));
  return out;
}

Result<Played> play(const Bench& bench, std::span<const Action> conversation, const Recording& recording) {
  Recorded device(recording);
  // It was played until something differed.
  return play(bench, conversation.first(std::min(conversation.size(), recording.answers.size())), device,
              false, recording.end);
}

}  // namespace conform::explore
