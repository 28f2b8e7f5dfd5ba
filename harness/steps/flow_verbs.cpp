// SPDX-License-Identifier: Apache-2.0
// Verbs that send nothing: conditions as expectations, names, pauses.
#include <algorithm>

#include "base/text.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

class Require final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<Require>();
    auto condition = parse_condition_at(value, context.names);
    if (!condition) return nullptr;
    out->condition_ = *condition;
    return out;
  }
  Need need() const override {
    return condition_.may_write() ? Need{Tier::config, "try what a condition asks for"} : Need{};
  }
  std::vector<ObjectReference> concerns() const override { return condition_.objects(); }
  bool rests_on_time() const override { return false; }
  std::string words(Session&) const override { return "require " + condition_.text(); }
  std::string success_words() const override { return condition_.text(); }
  Result<Actual> run(Session& session) const override {
    auto holds = condition_.evaluate(session);
    if (!holds) return std::unexpected(holds.error());
    Actual out;
    out.kind = *holds ? Actual::Kind::matched : Actual::Kind::mismatched;
    // Which values it had tells more than which names; where it holds nobody waits for another look.
    out.detail =
        *holds ? "holds: " + condition_.text() : "does not hold: " + condition_.why(session, false).text;
    return out;
  }

 private:
  Condition condition_;
};

class Let final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<Let>();
    if (!value.node()->is_mapping()) {
      value.error("'let' needs names and expressions", "write let: {next: $count + 1}");
      return nullptr;
    }
    for (const auto& entry : value.node()->entries()) {
      const yaml::Field field(&entry.value, context.diagnostics, entry.key.text());
      if (auto expression = parse_expression_at(field, context.names)) {
        out->names_.emplace_back(entry.key.text(), *expression);
      }
      context.know(entry.key.text());
    }
    return out;
  }
  bool acts() const override { return false; }
  bool rests_on_time() const override { return false; }
  std::string words(Session&) const override {
    std::vector<std::string> parts;
    for (const auto& [name, expression] : names_) parts.push_back(name + " = " + expression.text());
    return "let " + join(parts, ", ");
  }
  Result<Actual> run(Session& session) const override {
    for (const auto& [name, expression] : names_) {
      auto value = expression.evaluate(session);
      if (!value) return std::unexpected(value.error());
      session.set(name, *value);
    }
    return Actual{};
  }

 private:
  std::vector<std::pair<std::string, Expression>> names_;
};

class Wait final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext&) {
    auto out = std::make_unique<Wait>();
    const auto time = parse_time_at(value);
    if (!time) return nullptr;
    out->time_ = *time;
    return out;
  }
  bool acts() const override { return false; }
  std::string words(Session&) const override { return "wait " + time_.text(); }
  Result<Actual> run(Session& session) const override {
    auto waited = session.wait_until(session.now() + time_.resolve(session.profile()));
    if (!waited) return std::unexpected(waited.error());
    // What came during the pause is past: windows of later steps begin here and count from here.
    session.consume(session.capture().size());
    return Actual{};
  }

 private:
  TimeReference time_;
};

constexpr Verb table[] = {
    {"require", "A condition that must hold.", "(text): a condition, as in `when`",
     "- require: 1017h is present or (100Ch is present and 100Dh is present)\n  checks: OD-ERC-01",
     &Require::parse},
    {"let", "Give names to values.", "NAME: expression", "- let: {above: $count + 1}", &Let::parse},
    {"wait", "Let bus time pass. Frames that come meanwhile are not seen by later steps.",
     "(duration): 100 ms, T_NMT, 2 T_NMT", "- wait: 100 ms", &Wait::parse},
};

}  // namespace

std::span<const Verb> flow_verbs() { return table; }

}  // namespace conform::steps
