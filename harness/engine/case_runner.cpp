// SPDX-License-Identifier: Apache-2.0
#include "engine/case_runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/lss.hpp"
#include "engine/life_signs.hpp"
#include "engine/restore.hpp"
#include "engine/walk_values.hpp"
#include "scenario/query.hpp"

namespace conform::engine {
namespace {

using result::Verdict;
using steps::Actual;
using steps::Grade;
using steps::Step;

constexpr std::uint64_t most_values = 65536;

/// Of a value that is told in hexadecimal.
int digits_of(std::uint64_t value) { return value > 0xFFFF ? 8 : (value > 0xFF ? 3 : 2); }

/// Binds what for_each gave: objects as such, ids and other words as words, everything else as late
/// expressions.
steps::Value bind(const std::string& text, RunSession& session, const scenario::Catalogue& catalogue) {
  if (text.find(':') != std::string::npos) {
    if (const auto object = parse_multiplexer(text)) return steps::Value::of_object(*object);
  }
  if (catalogue.find(text) != nullptr || text == "current") return steps::Value::of_word(text);
  if (auto expression = steps::Expression::parse(text)) {
    if (auto value = expression->evaluate(session)) return *value;
  }
  return steps::Value::of_word(text);
}

/// The first frame on `can_id` after the last one that was sent.
std::optional<std::size_t> next_answer(const can::Capture& capture, CanId can_id) {
  const auto& frames = capture.frames();
  std::optional<std::size_t> out;
  for (std::size_t i = frames.size(); i > 0; --i) {
    const auto& each = frames[i - 1];
    if (each.direction != can::Direction::received) break;
    if (each.frame.is_data(can_id)) out = i - 1;
  }
  return out;
}

}  // namespace

Result<void> CaseRunner::run(const PlannedCase& planned, result::CaseResult& out) {
  out_ = &out;
  book_.open(out);
  walk_end_.clear();
  stopped_because_.clear();
  skipped_.clear();
  empty_walks_.clear();
  entered_steps_ = false;
  steps_done_ = cleanups_done_ = 0;
  outermost_ = nullptr;
  session_.begin_case(planned.scenario->risk);
  std::optional<Multiplexer> about;
  for (const auto& [name, text] : planned.names) {
    auto value = bind(text, session_, catalogue_);
    if (value.object && !about) about = value.object;
    session_.set(name, std::move(value));
  }
  witness_.begin_case(out, about);
  const auto& scenario = *planned.scenario;
  for (const auto& given : scenario.given) {
    auto entry = givens_.find(given.query);
    if (!entry) {
      if (session_.recorder().fault()) return std::unexpected(entry.error());
      stopped_because_ =
          "whether the device has " + given.query + " could not be decided: " + entry.error().what;
      conclude();
      return {};
    }
    if (!entry->object) {
      out.verdict = Verdict::not_applicable;
      out.reason = std::move(entry->why_not);
      out.wants = std::move(entry->wants);
      return {};
    }
    session_.set(given.name, steps::Value::of_object(*entry->object));
  }
  if (scenario.when) {
    auto holds = scenario.when->evaluate(session_);
    if (!holds) {
      if (session_.recorder().fault()) return std::unexpected(holds.error());
      stopped_because_ =
          "the condition '" + scenario.when->text() + "' could not be decided: " + holds.error().what;
      conclude();
      return {};
    }
    if (!*holds) {
      auto why = scenario.when->why_not(session_);
      if (session_.recorder().fault()) return std::unexpected(*session_.recorder().fault());
      out.verdict = Verdict::not_applicable;
      out.reason = std::move(why.text);
      out.wants = std::move(why.wants);
      return {};
    }
  }
  entered_steps_ = true;
  list_ = &scenario.steps;
  auto flow = run_steps(scenario.steps);
  if (!flow) {
    conclude();
    return std::unexpected(flow.error());
  }
  conclude();
  return run_cleanup(scenario.cleanup);
}

Result<Actual> CaseRunner::act(const Step& step, can::CasePart part) {
  auto& recorder = session_.recorder();
  session_.begin_step(step);
  if (recorder.tells_parts()) {
    auto& number = part == can::CasePart::cleanup ? cleanups_done_ : steps_done_;
    recorder.begin_part(can::to_comment({.name = out_->name(), .part = part, .number = ++number}),
                        step.action->acts() ? Recorder::FirstFrame::ours : Recorder::FirstFrame::any);
  }
  auto actual = step.action->run(session_);
  // Behind the step, because only then all names have their values.
  if (recorder.tells_parts()) recorder.end_part(session_.words_of(step));
  session_.end_step();
  return actual;
}

/// A write to 1010h (CiA 301, 7.5.2.13).
bool CaseRunner::stores(const Step& step) const {
  const auto* object = step.action->acts() ? step.action->object() : nullptr;
  if (object == nullptr) return false;
  const auto entry = object->resolve(session_);
  return entry && entry->index == Index(0x1010);
}

/// Cleanup judges nothing and always runs to its end.
Result<void> CaseRunner::run_cleanup(const Steps& list) {
  keep_up_life_signs(session_);
  for (const auto& step : list) {
    if (step.action == nullptr) continue;
    const auto says = [this](const std::optional<steps::Condition>& condition, bool wanted) {
      if (!condition) return true;
      const auto holds = condition->evaluate(session_);
      return !holds || *holds == wanted;
    };
    if (!says(step.when, true) || !says(step.unless, false)) continue;
    if (stores(step)) {
      // What else the case has changed is not to be stored with it.
      auto report = restore(session_, session_.journal());
      if (!report) return std::unexpected(report.error());
    }
    auto actual = act(step, can::CasePart::cleanup);
    if (!actual && session_.recorder().fault()) return std::unexpected(actual.error());
    if (actual && !step.label.empty()) session_.label(step, *actual);
  }
  return {};
}

Result<CaseRunner::Flow> CaseRunner::run_steps(const Steps& list) {
  for (const auto& step : list) {
    if (&list == list_) outermost_ = &step;
    auto flow = run_step(step);
    if (!flow || *flow != Flow::go_on) return flow;
  }
  return Flow::go_on;
}

Result<CaseRunner::Flow> CaseRunner::run_step(const Step& step) {
  for (const auto* condition : {&step.when, &step.unless}) {
    if (!*condition) continue;
    auto holds = (*condition)->evaluate(session_);
    if (!holds) return cannot_go_on(step, holds.error());
    if (*holds == (condition == &step.when)) continue;
    if (step.walk || !step.expectation.checks.empty()) skipped_.emplace_back(&**condition, *holds);
    return Flow::go_on;
  }
  if (step.walk) return run_walk(step);
  witness_.begin_step();
  const auto late_sendings = session_.recorder().late_sendings();
  auto actual = act(step, can::CasePart::step);
  witness_.note_done(step);
  if (!actual) return cannot_go_on(step, actual.error());
  const bool host_was_late = session_.recorder().late_sendings() != late_sendings;
  if (step.action->rests_on_time() || is_late(*actual, session_) || host_was_late) witness_.note_time();
  if (!step.label.empty()) session_.label(step, *actual);
  if (!step.branches.empty()) return run_branches(step, *actual);
  return judge(step, *actual);
}

Result<CaseRunner::Flow> CaseRunner::run_walk(const Step& step) {
  const auto& walk = *step.walk;
  std::vector<steps::Value> values;
  for (const auto& expression : walk.values) {
    auto value = expression.evaluate(session_);
    if (!value) return cannot_go_on(step, value.error());
    values.push_back(*value);
  }
  for (const auto& range : walk.ranges) {
    const auto low = range.low.number(session_);
    const auto high = range.high.number(session_);
    if (!low || !high) return cannot_go_on(step, low ? high.error() : low.error());
    // An empty range is legal (1..$count - 1 with a count of 0); a huge one is the author's slip, and a part
    // of it no proof.
    if (static_cast<std::int64_t>(*high) < static_cast<std::int64_t>(*low)) continue;
    if (*high - *low >= most_values || values.size() + (*high - *low) >= most_values) {
      return cannot_go_on(
          step, fail_scenario("more than " + std::to_string(most_values) + " values to walk over").error());
    }
    for (auto value = *low;; ++value) {
      values.push_back(steps::Value::of_number(value));
      if (value == *high) break;
    }
  }
  for (const auto& set : walk.sets) {
    if (set == "described bit rates") {
      for (const auto rate : session_.profile().device_info.bit_rates) {
        if (const auto index = canopen::lss_bit_rate_index(rate))
          values.push_back(steps::Value::of_number(*index));
      }
      continue;
    }
    if (set != "restricted CAN-IDs") {
      const auto query = scenario::Query::parse(set);
      if (!query) return cannot_go_on(step, query.error());
      for (const auto object : query->select(session_.dictionary()))
        values.push_back(steps::Value::of_object(object));
      continue;
    }
    for (const auto id : restricted_can_ids(session_.node(), session_.tries_all_objects()))
      values.push_back(steps::Value::of_number(id));
  }
  if (values.empty()) {
    std::string what = "value for $" + walk.name;
    if (!walk.sets.empty()) {
      if (const auto query = scenario::Query::parse(walk.sets.front())) what = query->words();
    }
    empty_walks_.push_back("the device has no " + what);
  }
  const bool outermost = book_.value().empty();
  std::size_t tried = 0;
  const auto done = witness_.done();
  const auto walked = witness_.walked();
  const auto outer = outermost ? std::string() : book_.value() + ", ";
  for (const auto& value : values) {
    book_.set_value(outer + (value.number ? hex(*value.number, digits_of(*value.number)) : value.text()));
    session_.set(walk.name, value);
    if (value.object) witness_.set_walked(value.object);
    witness_.forget(done);
    const auto before = book_.passes();
    const auto offences_before = book_.offences();
    auto flow = run_steps(walk.steps);
    ++tried;
    // A value that kills the device would make every further one a failure, and cost a time-out each.
    if (flow && *flow != Flow::stop && book_.offences() > offences_before && !session_.is_stopped()) {
      const auto alive = session_.peek({Index(0x1000), SubIndex(0)});
      if (!alive) return std::unexpected(alive.error());
      if (alive->kind == steps::SdoAnswer::Kind::silence) {
        walk_end_ = "behind " + book_.value() + " the device does not answer any more; " +
                    std::to_string(values.size() - tried) + " further values were not tried";
        stopped_because_ = walk_end_;
        flow = Flow::stop;
      }
    }
    if (flow && *flow == Flow::next_value) {
      book_.withdraw_passes(open_from(walk.steps, left_at_line_), before);
      continue;
    }
    if (!flow || *flow == Flow::stop) {
      if (outermost) book_.end_walk(walk_end_);
      return flow;
    }
  }
  witness_.set_walked(walked);
  if (outermost) {
    book_.end_walk(walk_end_);
  } else {
    book_.set_value(outer.substr(0, outer.size() - 2));
  }
  return Flow::go_on;
}

Result<CaseRunner::Flow> CaseRunner::run_branches(const Step& step, const Actual& actual) {
  for (const auto& branch : step.branches) {
    if (branch.on.empty()) {
      if (actual.kind != Actual::Kind::matched && actual.kind != Actual::Kind::confirmed) break;
      auto begins = branch.steps.front().action->begins(session_);
      if (!begins) return cannot_go_on(step, begins.error());
      if (!*begins) continue;
      if (branch.verdict != Verdict::pass) {
        for (const auto& requirement : checks_of(branch.steps.front()))
          book_.record(step, requirement, grade_of(branch, requirement), actual);
        if (branch.verdict == Verdict::not_applicable)
          return not_applicable(step, "does not concern this device: it went the way '" +
                                          branch.steps.front().action->words(session_) + "'");
      }
      return run_steps(branch.steps);
    }
    for (const auto& outcome : branch.on) {
      auto hit = outcome.matches(actual, session_);
      if (!hit) return cannot_go_on(step, hit.error());
      if (!*hit) continue;
      for (const auto& requirement : checks_of(step))
        book_.record(step, requirement, grade_of(branch, requirement), actual);
      if (branch.verdict == Verdict::not_applicable)
        return not_applicable(step, "does not concern this device: " + step.action->words(session_) +
                                        " gave " + actual.words());
      return run_steps(branch.steps);
    }
  }
  // None of the ways the standard leaves open.
  auto checks = checks_of(step);
  for (const auto& branch : step.branches) {
    if (branch.on.empty()) {
      const auto more = checks_of(branch.steps.front());
      checks.insert(checks.end(), more.begin(), more.end());
    }
  }
  std::ranges::sort(checks);
  const auto repeated = std::ranges::unique(checks);
  checks.erase(repeated.begin(), repeated.end());
  Actual seen = actual;
  if (seen.kind == Actual::Kind::matched) {
    seen.kind = Actual::Kind::mismatched;
    seen.detail = "what came next is none of the ways listed";
    const auto answers = canopen::connection_set(session_.node()).sdo_response;
    if (const auto next = next_answer(session_.capture(), answers)) {
      const auto& frame = session_.capture().frames()[*next].frame;
      seen.decisive = next;
      seen.detail = fmt::format("{}: {} came, none of the ways listed", to_string(CanId(frame.id)),
                                hex_bytes(frame.bytes()));
    }
  }
  if (checks.empty()) return set_up_failed(step, seen);
  for (const auto& requirement : checks) {
    book_.record(step, requirement, {capped(requirement), "not one of the ways the standard leaves open"},
                 seen);
  }
  return Flow::stop;
}

CaseRunner::Flow CaseRunner::not_applicable(const Step& step, const std::string& reason) {
  out_->reason = reason;
  left_at_line_ = step.position.line;
  if (!book_.value().empty()) return Flow::next_value;
  book_.withdraw_passes(open_from(*list_, left_at_line_), {});
  return Flow::stop;
}

std::vector<std::string> CaseRunner::checks_of(const Step& step) const {
  std::vector<std::string> out;
  for (const auto& check : step.expectation.checks) {
    if (!check.starts_with('$')) {
      out.push_back(check);
    } else if (const auto* value = session_.find(std::string_view(check).substr(1));
               value != nullptr && value->word) {
      if (const auto canonical = catalogue_.canonical(*value->word)) out.push_back(*canonical);
    }
  }
  return out;
}

CaseRunner::Flow CaseRunner::set_up_failed(const Step& step, const Actual& actual) {
  auto finding = witness_.finding(
      step, "", {Verdict::inconclusive, "a set-up step failed, so what follows could not be judged"}, actual);
  stopped_because_ = "set-up failed: " + finding.step + ": " + finding.actual;
  out_->setup_findings.push_back(std::move(finding));
  return Flow::stop;
}

Verdict CaseRunner::capped(const std::string& requirement) const {
  return strict_ || steps::is_binding(level_of(requirement)) ? Verdict::fail : Verdict::warn;
}

std::string_view CaseRunner::level_of(const std::string& requirement) const {
  const auto* known = catalogue_.find(requirement);
  return known != nullptr ? std::string_view(known->level) : "mandatory";
}

Grade CaseRunner::grade_of(const steps::Branch& branch, const std::string& requirement) const {
  switch (branch.verdict) {
    case Verdict::warn: return steps::tolerated(level_of(requirement), strict_);
    case Verdict::fail: return {Verdict::fail, "an outcome that is ruled out"};
    case Verdict::not_applicable: return {Verdict::not_applicable, "does not concern this device"};
    default: return {branch.verdict, {}};
  }
}

Result<CaseRunner::Flow> CaseRunner::judge(const Step& step, const Actual& actual) {
  const auto checks = checks_of(step);
  if (checks.empty()) {
    auto grade = steps::grade(step.expectation, actual, "mandatory", strict_, session_);
    if (!grade) return cannot_go_on(step, grade.error());
    if (grade->verdict == Verdict::pass || grade->verdict == Verdict::warn) return Flow::go_on;
    return set_up_failed(step, actual);
  }
  for (const auto& requirement : checks) {
    auto grade = steps::grade(step.expectation, actual, level_of(requirement), strict_, session_);
    if (!grade) return cannot_go_on(step, grade.error());
    book_.record(step, requirement, *grade, actual);
  }
  return Flow::go_on;
}

Result<CaseRunner::Flow> CaseRunner::cannot_go_on(const Step& step, const Error& error) {
  if (session_.recorder().fault()) return std::unexpected(error);
  Actual actual;
  actual.kind = Actual::Kind::mismatched;
  actual.detail = error.what;
  auto finding =
      witness_.finding(step, "", {Verdict::inconclusive, "the step could not be carried out"}, actual);
  stopped_because_ = finding.step + ": " + error.what;
  out_->setup_findings.push_back(std::move(finding));
  return Flow::stop;
}

/// Ids that steps at or behind a place in the file would still have decided.
std::vector<std::string> CaseRunner::open_from(const Steps& list, int line) const {
  std::vector<std::string> out;
  const auto add = [&out](std::vector<std::string> more) {
    out.insert(out.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  for (const auto& step : list) {
    if (step.position.line >= line) add(checks_of(step));
    if (step.walk) add(open_from(step.walk->steps, line));
    for (const auto& branch : step.branches) add(open_from(branch.steps, line));
  }
  return out;
}

void CaseRunner::conclude() {
  const bool in_the_middle = !stopped_because_.empty() && outermost_ != nullptr;
  book_.conclude(stopped_because_,
                 in_the_middle ? open_from(*list_, outermost_->position.line) : std::vector<std::string>());
  // Where a step went a way that does not concern the device, that way is the reason.
  if (out_->verdict == Verdict::not_applicable && out_->reason == "not run") explain_nothing_judged();
}

/// Every step that decides something was left out: says by which conditions.
void CaseRunner::explain_nothing_judged() {
  constexpr std::size_t most = 3;
  auto texts = empty_walks_;
  for (const auto& [condition, held] : skipped_) {
    // A look at the device would disturb what a conversation has left open.
    auto why = session_.channel().is_open() ? steps::Why{(held ? "" : "not so: ") + condition->text(), {}}
                                            : condition->why(session_, held);
    if (texts.size() == most || std::ranges::find(texts, why.text) != texts.end()) continue;
    texts.push_back(std::move(why.text));
    for (auto& want : why.wants) {
      if (std::ranges::find(out_->wants, want) == out_->wants.end()) out_->wants.push_back(std::move(want));
    }
  }
  out_->reason = texts.empty() ? "nothing to judge: there is no value to try it with" : join(texts, "; ");
}

}  // namespace conform::engine
