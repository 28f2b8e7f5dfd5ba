// SPDX-License-Identifier: Apache-2.0
// Inside of Condition, shared by its parser and its explanation and nobody else.
#pragma once

#include "steps/condition.hpp"

namespace conform::steps {

struct Condition::Tree {
  enum class Kind {
    all,
    any,
    negation,  // and, or, not
    present,
    claimed,
    readable,
    writable,
    access,
    changes,  // about an entry
    integer,
    described_by,
    remaps,
    placeholder,
    no_placeholder,
    feature,
    triggers,
    remote,
    factory,
    described,
    refused,
    sweep,
    alone,
    store_fault,
    power_switch,
    told,
    bus_rate,
    bus_rate_told,
    block_upload,
    block_download,  // about device and bench
    equal,
    at_least,
    at_most,
    above,
    below  // two expressions
  };
  Kind kind = Kind::all;
  std::vector<std::shared_ptr<const Tree>> parts;
  ObjectReference object;
  bool whole_object = false;
  std::string word;
  std::uint64_t count = 0;
  std::vector<Declared> declared;  ///< of `described_by`: the description says all of them
  Expression left, right;
};

/// Whether a part of a condition holds.
[[nodiscard]] Result<bool> evaluate_tree(const Condition::Tree& node, Facts& facts);

}  // namespace conform::steps
