// SPDX-License-Identifier: Apache-2.0
// A decision that the standard states, under a name that its clause would give it. The service asks the rule
// where others write the condition in line, so that the decision can be replaced from outside.
#pragma once

#include <functional>
#include <utility>

namespace refnode {

template <typename Signature>
class Rule;

template <typename Answer, typename... Given>
class Rule<Answer(Given...)> {
 public:
  using Decision = std::function<Answer(Given...)>;

  /// Any function of this signature; it is what a conformant device decides.
  template <typename F>
  Rule(F decision) : decision_(std::move(decision)) {}  // NOLINT(google-explicit-constructor)

  Answer operator()(Given... given) const { return decision_(std::forward<Given>(given)...); }

  /// Puts another decision in its place: `other(former, given...)`, which may ask the former one. So several
  /// replacements of one rule work together, the last one first.
  template <typename F>
  void replace(F other) {
    decision_ = [former = std::move(decision_), other = std::move(other)](Given... given) -> Answer {
      return other(former, std::forward<Given>(given)...);
    };
  }

 private:
  Decision decision_;
};

}  // namespace refnode
