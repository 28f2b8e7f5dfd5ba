// SPDX-License-Identifier: Apache-2.0
// A step of a scenario: one verb, and what is expected of it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "steps/channels.hpp"
#include "steps/condition.hpp"
#include "steps/outcome.hpp"
#include "steps/session.hpp"
#include "steps/tier.hpp"
#include "yaml/node.hpp"

namespace conform::steps {

/// What a verb does. One class per verb, private to its file.
class Action {
 public:
  Action() = default;
  Action(const Action&) = delete;
  Action& operator=(const Action&) = delete;
  virtual ~Action() = default;
  /// "download 1003h:00 = 02h": with the values of this instance.
  [[nodiscard]] virtual std::string words(Session& session) const = 0;
  /// What it is when it succeeds, where a scenario asks for no more.
  [[nodiscard]] virtual std::string success_words() const { return "success"; }
  /// Error: the environment failed, or a name has no value (an error of the scenario).
  [[nodiscard]] virtual Result<Actual> run(Session& session) const = 0;
  /// For alternatives in `either`: whether what comes next on the bus is how this action begins. Consumes
  /// nothing.
  [[nodiscard]] virtual Result<bool> begins(Session& /*session*/) const { return false; }
  /// Whether it sends something to the device (and so begins a new window for the steps that wait).
  [[nodiscard]] virtual bool acts() const { return true; }
  /// Where its label (`as`) sits: on what it sent, or on what it waited for.
  [[nodiscard]] virtual bool label_is_on_request() const { return acts(); }
  /// The lowest tier it may run at, as far as that can be told before it runs: lint compares it with the risk
  /// of the scenario. What only the run knows is judged there, frame by frame.
  [[nodiscard]] virtual Need need() const {
    return acts() ? Need{Tier::config, "change the device"} : Need{};
  }
  /// The entry it is about, for `current` and for printing values.
  [[nodiscard]] virtual const ObjectReference* object() const { return nullptr; }
  /// Where object() is none: the entries that it looks at or configures, the one that tells most first. For
  /// pointing at the device description.
  [[nodiscard]] virtual std::vector<ObjectReference> concerns() const { return {}; }
  /// What it sees the device through, beside plain SDO transfers of up to four bytes.
  [[nodiscard]] virtual Channels rests_on() const { return {}; }
  /// Whether its outcome, or what comes after it, is another one when the host is late: it waits, counts time
  /// or hears a silence. A value that was read and an answer that came are what they are.
  [[nodiscard]] virtual bool rests_on_time() const { return true; }
  /// The measurements its outcome may have. To ask for others is a mistake of the author, which would be
  /// counted against the device.
  [[nodiscard]] virtual Measures measures() const { return {}; }
};

struct Step;

/// One way a step with `either` may go on.
struct Branch {
  std::vector<Outcome> on;  ///< empty: the first step is a conversation that tells by its first line
  result::Verdict verdict = result::Verdict::pass;  ///< grade of taking this way
  std::vector<Step> steps;
  yaml::Position position;
};

/// `over`: a name and the values it takes, one after the other, inside one step.
struct Walk {
  std::string name;
  std::vector<Expression> values;
  std::vector<Range> ranges;
  std::vector<std::string>
      sets;  ///< named sets: "restricted CAN-IDs", and queries: "entries with access const"
  std::vector<Step> steps;
};

struct Step {
  std::string verb;
  std::unique_ptr<Action> action;  ///< absent for `over`
  std::optional<Walk> walk;
  Expectation expectation;
  std::optional<Condition> when, unless;
  std::vector<Branch> branches;  ///< `either`
  std::string label;             ///< `as`
  bool at_once = false;          ///< does not wait for the NMT state that was commanded
  yaml::Position position;       ///< of the verb's key
  int length = 1;
};

/// What the parser of a verb may use and report to.
struct ParseContext {
  yaml::Diagnostics& diagnostics;
  /// The canonical id of a requirement (aliases resolved), or nullopt when there is none.
  std::function<std::optional<std::string>(std::string_view)> requirement;
  std::function<std::vector<std::string_view>()> all_requirements;  ///< for "did you mean"
  NameCheck names;  ///< known at this place; verbs that save add to it
  std::vector<std::string> default_checks;
  /// What is wrong with a query; queries are the scenario room's, steps only carry them.
  std::function<Result<void>(std::string_view)> check_query;
  /// In a branch of `either`: the entry of the step it belongs to, for {m} in the branch's conversation.
  std::optional<ObjectReference> branch_object = std::nullopt;
  /// Steps that expect something and name no ids of their own, so that the scenario's are theirs.
  std::vector<std::pair<yaml::Position, int>> inheriting = {};
  void know(std::string name) { names.push_back(std::move(name)); }
};

/// One row of the verb table.
struct Verb {
  std::string_view name;
  std::string_view summary;     ///< one line
  std::string_view parameters;  ///< one per line: "object: the entry, 1003h:00 or $name"
  std::string_view example;     ///< YAML
  std::unique_ptr<Action> (*parse)(const yaml::Field& value, ParseContext& context);
};

/// All verbs in the order of the reference page.
[[nodiscard]] std::span<const Verb> verbs();
[[nodiscard]] const Verb* find_verb(std::string_view name);

/// Keys a step may have beside its verb, for messages and for the schema's test.
[[nodiscard]] std::span<const std::string_view> common_step_keys();

/// Reads a list of steps. All mistakes go to the diagnostics; unusable steps are left out.
[[nodiscard]] std::vector<Step> parse_steps(const yaml::Field& list, ParseContext& context);

/// A step that needs more than a tier allows.
struct Excess {
  const Step* step;
  Need need;
};
/// The first one (walks, branches and conditions included).
[[nodiscard]] std::optional<Excess> first_beyond(const std::vector<Step>& list, Tier allowed);

/// Ids at `checks`; "$name" stands for a word of the instance's row.
[[nodiscard]] std::vector<std::string> parse_checks(const yaml::Field& field, const ParseContext& context);

/// Names used at a field that nothing before it has given, with what was probably meant.
void report_unknown_names(const std::vector<std::string>& used, const yaml::Field& field,
                          const NameCheck& names);

/// Reads an expression, an object or a condition at a field and reports what is wrong, unknown names
/// included.
[[nodiscard]] std::optional<Expression> parse_expression_at(const yaml::Field& field, const NameCheck& names);
[[nodiscard]] std::optional<ObjectReference> parse_object_at(const yaml::Field& field,
                                                             const NameCheck& names);
[[nodiscard]] std::optional<Condition> parse_condition_at(const yaml::Field& field, const NameCheck& names);
/// "100 ms", "T_NMT", "2 T_NMT" or "$profile.store_timeout"
struct TimeReference {
  Duration fixed{};
  std::string profile_name;  ///< as Profile::duration() takes it; empty: `fixed`
  std::int64_t times = 1;    ///< what the profile says, so many times
  [[nodiscard]] static Result<TimeReference> parse(std::string_view text);
  [[nodiscard]] Duration resolve(const device::Profile& profile) const;
  [[nodiscard]] std::string text() const;
};
[[nodiscard]] std::optional<TimeReference> parse_time_at(const yaml::Field& field);

}  // namespace conform::steps
