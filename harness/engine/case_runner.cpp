// SPDX-License-Identifier: Apache-2.0
#include "engine/case_runner.hpp"

#include <algorithm>
#include <iterator>

#include "base/check.hpp"
#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/decode.hpp"
#include "canopen/sdo_initiate.hpp"
#include "result/services.hpp"
#include "scenario/query.hpp"

namespace conform::engine {
namespace {

using result::Verdict;
using steps::Actual;
using steps::Grade;
using steps::Step;

constexpr std::size_t evidence_before = 6;
constexpr std::size_t evidence_after = 2;
constexpr std::size_t offenders_named = 8;
constexpr std::uint64_t most_values = 65536;

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

/// The entry a step is about, or the first of those it looks at.
std::optional<Multiplexer> object_of(const Step& step, RunSession& session) {
  if (step.action == nullptr) return std::nullopt;
  if (const auto* own = step.action->object()) {
    const auto object = own->resolve(session);
    return object ? std::optional(*object) : std::nullopt;
  }
  for (const auto& reference : step.action->concerns()) {
    if (const auto object = reference.resolve(session)) return *object;
  }
  return std::nullopt;
}

std::optional<canopen::DataType> type_of(const Step& step, RunSession& session) {
  if (step.action == nullptr || step.action->object() == nullptr) return std::nullopt;
  const auto object = object_of(step, session);
  const auto* entry = object ? session.dictionary().find(*object) : nullptr;
  return entry == nullptr ? std::nullopt : std::optional(entry->type);
}

/// The abort by which the server decided; nullopt: it was another frame, or none.
std::optional<AbortCode> deciding_abort(const Actual& actual, const RunSession& session) {
  if (!actual.decisive) return std::nullopt;
  const auto& frame = session.capture().frames()[*actual.decisive].frame;
  if (!frame.is_data(canopen::connection_set(session.node()).sdo_response)) return std::nullopt;
  const auto abort = canopen::decode_abort(frame.bytes());
  return abort ? std::optional(abort->code) : std::nullopt;
}

/// An answer that did not come, or that says that ours came too late.
bool is_late(const Actual& actual, const RunSession& session) {
  return actual.kind == Actual::Kind::silence || actual.code == canopen::abort::timed_out ||
         deciding_abort(actual, session) == canopen::abort::timed_out;
}

/// What the answer to an initiate request, or an abort, says it is about.
std::optional<Index> object_in_answer(const RunSession& session, std::size_t frame) {
  const auto& answer = session.capture().frames()[frame].frame;
  if (!answer.is_data(canopen::connection_set(session.node()).sdo_response) || answer.size() < 4)
    return std::nullopt;
  constexpr std::uint8_t upload = 0x40, download = 0x60, abort = 0x80;
  const auto command = answer.data[0];
  const bool names_object = (command & 0xF0U) == upload || command == download || command == abort;
  const auto index = static_cast<std::uint16_t>(load_le(ByteView(answer.data).subspan(1, 2)));
  return names_object && index != 0 ? std::optional(Index(index)) : std::nullopt;
}

/// An answer of another service than the request's, by the command specifiers of both: "60h after 40h". Empty
/// where they fit, and the content is what differs.
std::string foreign_answer(std::size_t decisive, const RunSession& session) {
  constexpr std::uint8_t specifier = 0xE0;
  constexpr std::pair<std::uint8_t, std::uint8_t> fitting[] = {{0x40, 0x40}, {0x20, 0x60}, {0x60, 0x00},
                                                               {0x00, 0x20}, {0xA0, 0xC0}, {0xC0, 0xA0}};
  const auto& frames = session.capture().frames();
  const auto sdo = canopen::connection_set(session.node());
  if (!frames[decisive].frame.is_data(sdo.sdo_response) || frames[decisive].frame.size() == 0) return {};
  const auto answer = static_cast<std::uint8_t>(frames[decisive].frame.data[0] & specifier);
  for (auto i = decisive; i-- > 0;) {
    const auto& frame = frames[i].frame;
    if (!frame.is_data(sdo.sdo_request) || frame.size() == 0) continue;
    const auto request = static_cast<std::uint8_t>(frame.data[0] & specifier);
    if (std::ranges::find(fitting, std::pair(request, answer)) != std::end(fitting)) return {};
    return hex(answer, 2) + " after " + hex(request, 2);
  }
  return {};
}

/// How what came differs, as a kind: what many parts of a device have in common when one thing is wrong with
/// it.
std::string deviation_of(const Step& step, const Actual& actual, RunSession& session) {
  using Outcome = steps::Outcome;
  const auto refusal = std::ranges::find_if(step.expectation.pass, [](const Outcome& outcome) {
    return outcome.kind == Outcome::Kind::abort_code || outcome.kind == Outcome::Kind::abort_any ||
           outcome.kind == Outcome::Kind::abort_defined;
  });
  // A conversation meets aborts as frames.
  const bool frames = actual.kind == Actual::Kind::mismatched || actual.kind == Actual::Kind::matched;
  if (frames && actual.decisive) {
    if (const auto abort = deciding_abort(actual, session)) return "abort " + to_string(*abort);
    if (actual.kind == Actual::Kind::mismatched) return foreign_answer(*actual.decisive, session);
  }
  const bool waits = step.action != nullptr && !step.action->acts();
  switch (actual.kind) {
    case Actual::Kind::confirmed: {
      // What it should have been refused for tells one fault from another.
      if (refusal != step.expectation.pass.end())
        return "confirmed instead of " + refusal->words(session, std::nullopt);
      const auto object = step.verb == "upload" ? object_of(step, session) : std::nullopt;
      if (!object || !session.before_last_write(*object)) return "";
      return session.write_was_refused() ? "a refused value is stored" : "not what was written";
    }
    case Actual::Kind::aborted: return "abort " + to_string(actual.code);
    case Actual::Kind::silence: return waits ? "no " + step.verb : "no answer";
    case Actual::Kind::violation: return "protocol violation";
    default: return "";
  }
}

/// Where the description tells of an entry, or that it does not.
std::string described_at(const device::Profile& profile, Multiplexer mux) {
  const auto& [objects, entries] = profile.described_places;
  if (const auto entry = entries.find(mux); entry != entries.end()) return entry->second;
  const auto object = objects.find(mux.index);
  if (object == objects.end()) return profile.described_in + ", without " + to_string(mux.index);
  // A data type has no entries.
  const auto first = entries.lower_bound({mux.index, SubIndex(0)});
  const bool has_entries = first != entries.end() && first->first.index == mux.index;
  return object->second + (has_entries ? ", without " + to_string(mux) : "");
}

}  // namespace

Result<void> CaseRunner::run(const PlannedCase& planned, result::CaseResult& out) {
  out_ = &out;
  offenders_.clear();
  walk_value_.clear();
  walk_end_.clear();
  stopped_because_.clear();
  skipped_.clear();
  empty_walks_.clear();
  entered_steps_ = false;
  timed_ = false;
  outermost_ = nullptr;
  session_.begin_case(planned.scenario->risk);
  instance_object_.reset();
  for (const auto& [name, text] : planned.names) {
    auto value = bind(text, session_, catalogue_);
    if (value.object && !instance_object_) instance_object_ = value.object;
    session_.set(name, std::move(value));
  }
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

/// Cleanup judges nothing and always runs to its end.
Result<void> CaseRunner::run_cleanup(const Steps& list) {
  for (const auto& step : list) {
    if (step.action == nullptr) continue;
    const auto says = [this](const std::optional<steps::Condition>& condition, bool wanted) {
      if (!condition) return true;
      const auto holds = condition->evaluate(session_);
      return !holds || *holds == wanted;
    };
    if (!says(step.when, true) || !says(step.unless, false)) continue;
    session_.begin_step(step);
    auto actual = step.action->run(session_);
    session_.end_step();
    if (!actual && session_.recorder().fault()) return std::unexpected(actual.error());
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
  step_begin_ = session_.capture().size();
  session_.begin_step(step);
  auto actual = step.action->run(session_);
  session_.end_step();
  if (!actual) return cannot_go_on(step, actual.error());
  timed_ = timed_ || step.action->rests_on_time() || is_late(*actual, session_);
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
          step, {"more than " + std::to_string(most_values) + " values to walk over", "scenario", {}});
    }
    for (auto value = *low;; ++value) {
      values.push_back(steps::Value::of_number(value));
      if (value == *high) break;
    }
  }
  for (const auto& set : walk.sets) {
    if (set != "restricted CAN-IDs") {
      const auto query = scenario::Query::parse(set);
      if (!query) return cannot_go_on(step, query.error());
      for (const auto object : query->select(session_.dictionary()))
        values.push_back(steps::Value::of_object(object));
      continue;
    }
    for (const auto& range : canopen::restricted_ranges()) {
      for (auto id = range.first; id <= range.last; ++id) values.push_back(steps::Value::of_number(id));
    }
  }
  if (values.empty()) {
    std::string what = "value for $" + walk.name;
    if (!walk.sets.empty()) {
      if (const auto query = scenario::Query::parse(walk.sets.front())) what = query->words();
    }
    empty_walks_.push_back("the device has no " + what);
  }
  const bool outermost = walk_value_.empty();
  std::size_t tried = 0;
  const auto outer = walk_value_.empty() ? std::string() : walk_value_ + ", ";
  for (const auto& value : values) {
    walk_value_ = outer + (value.number ? hex(*value.number,
                                              *value.number > 0xFFFF ? 8 : (*value.number > 0xFF ? 3 : 2))
                                        : value.text());
    session_.set(walk.name, value);
    const auto before = passes();
    const auto offences_before = offences();
    auto flow = run_steps(walk.steps);
    ++tried;
    // A value that kills the device would make every further one a failure, and cost a time-out each.
    if (flow && *flow != Flow::stop && offences() > offences_before && !session_.is_stopped()) {
      const auto alive = session_.peek({Index(0x1000), SubIndex(0)});
      if (!alive) return std::unexpected(alive.error());
      if (alive->kind == steps::SdoAnswer::Kind::silence) {
        walk_end_ = "behind " + walk_value_ + " the device does not answer any more; " +
                    std::to_string(values.size() - tried) + " further values were not tried";
        stopped_because_ = walk_end_;
        flow = Flow::stop;
      }
    }
    if (flow && *flow == Flow::next_value) {
      withdraw_passes(walk.steps, before);
      continue;
    }
    if (!flow || *flow == Flow::stop) {
      if (outermost) finish_walk();
      return flow;
    }
  }
  if (outermost) {
    finish_walk();
  } else {
    walk_value_ = outer.substr(0, outer.size() - 2);
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
          record(step, requirement, grade_of(branch, requirement), actual);
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
        record(step, requirement, grade_of(branch, requirement), actual);
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
  }
  if (checks.empty()) return set_up_failed(step, seen);
  for (const auto& requirement : checks) {
    record(step, requirement, {capped(requirement), "not one of the ways the standard leaves open"}, seen);
  }
  return Flow::stop;
}

CaseRunner::Flow CaseRunner::not_applicable(const Step& step, const std::string& reason) {
  out_->reason = reason;
  left_at_line_ = step.position.line;
  if (!walk_value_.empty()) return Flow::next_value;
  withdraw_passes(*list_, {});
  return Flow::stop;
}

std::vector<result::Judgement> CaseRunner::passes() const {
  std::vector<result::Judgement> out;
  // Findings are heavy, and a pass has none.
  std::ranges::copy_if(out_->judgements, std::back_inserter(out),
                       [](const auto& each) { return each.verdict == Verdict::pass; });
  return out;
}

void CaseRunner::withdraw_passes(const Steps& list, const std::vector<result::Judgement>& before) {
  std::vector<std::string> open;
  collect_open(list, left_at_line_, open);
  for (const auto& requirement : open) {
    const auto found = std::ranges::find(out_->judgements, requirement, &result::Judgement::requirement);
    if (found == out_->judgements.end() || found->verdict != Verdict::pass) continue;
    // Other values of an `over` may have decided it.
    const auto was = std::ranges::find(before, requirement, &result::Judgement::requirement);
    if (was != before.end()) {
      *found = *was;
      continue;
    }
    found->verdict = Verdict::not_applicable;
    found->decided_by.reset();
    found->reason = out_->reason;
  }
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
  auto finding = make_finding(
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
    record(step, requirement, *grade, actual);
  }
  return Flow::go_on;
}

std::optional<std::string> CaseRunner::rule_below(const std::string& requirement, const Actual& actual) {
  attribution_.follow(session_.capture().frames());
  const auto depth = result::depth_of_requirement(requirement);
  for (auto& rule : attribution_.rules_below(actual)) {
    if (rule == requirement) return std::nullopt;
    if (result::depth_of_requirement(rule) < depth && catalogue_.find(rule) != nullptr)
      return std::move(rule);
  }
  return std::nullopt;
}

Result<CaseRunner::Flow> CaseRunner::cannot_go_on(const Step& step, const Error& error) {
  if (session_.recorder().fault()) return std::unexpected(error);
  Actual actual;
  actual.kind = Actual::Kind::mismatched;
  actual.detail = error.what;
  auto finding = make_finding(step, "", {Verdict::inconclusive, "the step could not be carried out"}, actual);
  stopped_because_ = finding.step + ": " + error.what;
  out_->setup_findings.push_back(std::move(finding));
  return Flow::stop;
}

result::Judgement& CaseRunner::judgement(const std::string& requirement) {
  auto& all = out_->judgements;
  const auto found = std::ranges::find(all, requirement, &result::Judgement::requirement);
  if (found != all.end()) return *found;
  result::Judgement fresh;
  fresh.requirement = requirement;
  fresh.verdict = Verdict::not_applicable;
  return all.emplace_back(std::move(fresh));
}

void CaseRunner::record(const Step& step, const std::string& requirement, const Grade& given,
                        const Actual& actual) {
  auto grade = given;
  if (grade.verdict == Verdict::fail || grade.verdict == Verdict::warn) {
    if (const auto rule = rule_below(requirement, actual)) {
      grade = {Verdict::inconclusive, "rests on " + *rule + ", which failed"};
      out_->rests_on = *rule;
    }
  }
  auto& target = judgement(requirement);
  ++target.expectations;
  target.frames_seen = session_.capture().size();
  // The first that passed, unless something worse came.
  if (grade.verdict != Verdict::not_applicable && (!target.decided_by || grade.verdict > target.verdict)) {
    target.decided_by = result::DecidingStep{{out_->position.file, step.position.line, step.position.column},
                                             step.action->words(session_),
                                             actual.words(),
                                             actual.decisive};
  }
  target.verdict = worst(target.verdict, grade.verdict);
  const bool in_walk = !walk_value_.empty();
  if (in_walk) ++offenders(step, requirement).judged;
  if (grade.verdict == Verdict::pass || grade.verdict == Verdict::not_applicable) return;
  if (in_walk) {
    auto& all = offenders(step, requirement);
    const auto described = declared_at(step, actual);
    all.values.push_back(walk_value_ + (described.empty() ? "" : " (" + described + ")") + ": " +
                         actual.words());
    if (all.values.size() > 1) {
      // One finding for all, with the evidence of the first of the worst.
      auto& told = target.findings[all.finding];
      if (told.verdict < grade.verdict) told = make_finding(step, requirement, grade, actual);
      return;
    }
    all.finding = target.findings.size();
  }
  target.findings.push_back(make_finding(step, requirement, grade, actual));
}

CaseRunner::Offenders& CaseRunner::offenders(const Step& step, const std::string& requirement) {
  const auto found = std::ranges::find_if(offenders_, [&](const Offenders& each) {
    return each.step == &step && each.requirement == requirement;
  });
  if (found != offenders_.end()) return *found;
  Offenders fresh;
  fresh.step = &step;
  fresh.requirement = requirement;
  return offenders_.emplace_back(std::move(fresh));
}

void CaseRunner::collect_open(const Steps& list, int from_line, std::vector<std::string>& out) const {
  for (const auto& step : list) {
    if (step.position.line >= from_line) {
      const auto checks = checks_of(step);
      out.insert(out.end(), checks.begin(), checks.end());
    }
    if (step.walk) collect_open(step.walk->steps, from_line, out);
    for (const auto& branch : step.branches) collect_open(branch.steps, from_line, out);
  }
}

void CaseRunner::finish_walk() {
  for (const auto& offenders : offenders_) {
    if (offenders.values.empty()) continue;
    auto& finding = judgement(offenders.requirement).findings[offenders.finding];
    std::string text =
        std::to_string(offenders.values.size()) + " of " + std::to_string(offenders.judged) + " values: ";
    for (std::size_t i = 0; i < std::min(offenders.values.size(), offenders_named); ++i) {
      text += (i == 0 ? "" : "; ") + offenders.values[i];
    }
    if (offenders.values.size() > offenders_named) text += "; ...";
    if (!walk_end_.empty()) text += "; " + walk_end_;
    finding.actual = text;
  }
  offenders_.clear();
  walk_value_.clear();
}

std::size_t CaseRunner::offences() const {
  std::size_t out = out_->setup_findings.size();
  for (const auto& each : offenders_) out += each.values.size();
  return out;
}

std::string CaseRunner::declared_at(const Step& step, const Actual& actual) const {
  const auto& file = session_.profile().described_in;
  if (file.empty() || step.action == nullptr) return {};
  std::vector<Multiplexer> about;
  const auto add = [&](const steps::ObjectReference& reference) {
    if (const auto mux = reference.resolve(session_)) about.push_back(*mux);
  };
  if (step.action->object() != nullptr) add(*step.action->object());
  if (about.empty() && actual.decisive && *actual.decisive < session_.capture().size()) {
    // Of several transfers in one step it is the refused one that matters.
    const auto& frame = session_.capture().frames()[*actual.decisive].frame;
    const auto abort = frame.is_data(canopen::connection_set(session_.node()).sdo_response)
                           ? canopen::decode_abort(frame.bytes())
                           : std::nullopt;
    if (abort) about.push_back(abort->mux);
  }
  if (about.empty()) {
    for (const auto& reference : step.action->concerns()) add(reference);
  }
  if (about.empty() && instance_object_) about.push_back(*instance_object_);
  std::vector<std::string> places;
  for (const auto mux : about) {
    auto place = described_at(session_.profile(), mux);
    if (std::ranges::find(places, place) == places.end()) places.push_back(std::move(place));
  }
  return join(places, "; ");
}

result::Finding CaseRunner::make_finding(const Step& step, const std::string& requirement, const Grade& grade,
                                         const Actual& actual) {
  const auto type = type_of(step, session_);
  result::Finding out;
  out.verdict = grade.verdict;
  out.requirement = requirement;
  out.position = {out_->position.file, step.position.line, step.position.column};
  out.step = step.action != nullptr ? step.action->words(session_)
                                    : "over " + (step.walk ? step.walk->name : step.verb);
  if (step.branches.empty()) {
    out.accepts = step.expectation.pass.empty() ? std::vector<std::string>{"success"}
                                                : step.expectation.pass_words(session_, type);
    out.tolerates = step.expectation.warn_words(session_, type);
  } else {
    for (const auto& branch : step.branches) {
      for (const auto& outcome : branch.on) {
        auto& set = branch.verdict == Verdict::pass ? out.accepts : out.tolerates;
        if (branch.verdict != Verdict::fail) set.push_back(outcome.words(session_, type));
      }
      if (branch.on.empty()) out.accepts.push_back(branch.steps.front().action->words(session_));
    }
  }
  out.actual = actual.words();
  out.actual_bytes.assign(actual.data.begin(), actual.data.end());
  out.reason = grade.reason;
  out.declared_at = declared_at(step, actual);
  attribution_.follow(session_.capture().frames());
  out.broken_rules = attribution_.rules_broken(actual);
  if (const auto object = object_of(step, session_)) out.object = object->index;
  if (!out.object && actual.decisive) out.object = object_in_answer(session_, *actual.decisive);
  out.deviation = deviation_of(step, actual, session_);
  out.evidence = evidence(step_begin_, actual.decisive);
  out.frames_seen = session_.capture().size();
  out.rests_on_time = timed_;
  return out;
}

std::vector<result::EvidenceFrame> CaseRunner::evidence(std::size_t begin,
                                                        std::optional<std::size_t> decisive) const {
  std::vector<result::EvidenceFrame> out;
  const auto& frames = session_.capture().frames();
  if (frames.empty()) return out;
  const auto centre = decisive.value_or(frames.size() - 1);
  auto first = std::max(out_->first_frame, centre > evidence_before ? centre - evidence_before : 0);
  if (begin >= first && begin <= centre && centre - begin < evidence_before)
    first = std::max(out_->first_frame, begin > 2 ? begin - 2 : 0);
  const auto last = std::min(frames.size() - 1, centre + evidence_after);
  // The decoder must see the case from its beginning to name segments.
  canopen::Decoder decoder(session_.node());
  decoder.set_emcy_can_id(session_.emcy_can_id());
  for (auto i = out_->first_frame; i <= last; ++i) {
    auto meaning = decoder.meaning(frames[i].frame, frames[i].direction);
    if (i < first) continue;
    result::EvidenceFrame frame;
    frame.frame = frames[i].frame;
    frame.time = frames[i].time;
    frame.direction = frames[i].direction;
    frame.capture_index = i;
    frame.meaning = std::move(meaning);
    frame.decisive = decisive == i;
    out.push_back(std::move(frame));
  }
  return out;
}

void CaseRunner::judge_restart(result::CaseResult& out, std::size_t restart,
                               const std::optional<monitor::Stimulus>& stimulus, bool again, bool doubtful) {
  const auto frame = "boot-up message in frame " + std::to_string(restart + 1);
  // It may have gone long before it said that it was back.
  const auto since = stimulus ? stimulus->first : restart;
  const auto why = std::string("the device restarted although nobody told it to (") + frame + ")";
  for (auto& judgement : out.judgements) {
    if (judgement.verdict == Verdict::not_applicable || judgement.verdict == Verdict::error) continue;
    if (judgement.frames_seen <= since) continue;
    const auto* requirement = catalogue_.find(judgement.requirement);
    const bool named = requirement != nullptr && requirement->forbids_restart();
    if (named && stimulus && judgement.verdict == Verdict::fail && (again || !doubtful)) continue;
    if (named && again) {
      result::Finding finding;
      finding.verdict = judgement.verdict = Verdict::fail;
      finding.requirement = judgement.requirement;
      finding.position = out.position;
      finding.step = "the frames from " + std::to_string(stimulus->first + 1) + " to " +
                     std::to_string(stimulus->last + 1);
      finding.accepts = {"the device goes on"};
      finding.actual = "the device restarted: " + frame;
      finding.reason = "it restarted again when it got the same frames once more";
      out_ = &out;
      finding.evidence = evidence(stimulus->first, restart);
      finding.frames_seen = session_.capture().size();
      judgement.findings.push_back(std::move(finding));
      continue;
    }
    judgement.verdict = Verdict::inconclusive;
    judgement.reason = why;
    for (auto& finding : judgement.findings) {
      if (finding.frames_seen <= since) {
        judgement.verdict = worst(judgement.verdict, finding.verdict);
      } else {
        finding.verdict = Verdict::inconclusive;
        finding.reason += "; but " + why;
      }
    }
  }
  auto verdict = Verdict::not_applicable;
  for (const auto& each : out.judgements) verdict = worst(verdict, each.verdict);
  if (!out.setup_findings.empty()) verdict = worst(verdict, Verdict::inconclusive);
  out.verdict = verdict;
  if (verdict == Verdict::inconclusive) out.reason = why;
}

void CaseRunner::conclude() {
  // What the case could have judged and did not reach, because it had to stop, is open and not passed.
  if (!stopped_because_.empty()) {
    for (const auto& requirement : out_->requirements) {
      auto& target = judgement(requirement);
      if (target.expectations == 0) target.verdict = Verdict::inconclusive;
    }
    // Nor has passed what was judged in part only.
    if (outermost_ != nullptr) {
      std::vector<std::string> open;
      collect_open(*list_, outermost_->position.line, open);
      for (const auto& requirement : open) {
        auto& target = judgement(requirement);
        target.verdict = worst(target.verdict, Verdict::inconclusive);
      }
    }
  }
  auto verdict = Verdict::not_applicable;
  for (const auto& each : out_->judgements) {
    CONFORM_CHECK(each.verdict != Verdict::pass || each.decided_by);
    verdict = worst(verdict, each.verdict);
  }
  if (!stopped_because_.empty()) verdict = worst(verdict, Verdict::inconclusive);
  out_->verdict = verdict;
  if (!stopped_because_.empty()) {
    out_->reason = stopped_because_;
  } else if (verdict == Verdict::not_applicable) {
    // Where a step went a way that does not concern the device, that way is the reason.
    if (out_->reason == "not run") explain_nothing_judged();
  } else {
    out_->reason.clear();
  }
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
