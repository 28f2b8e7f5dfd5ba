// SPDX-License-Identifier: Apache-2.0
// Inside of Expression, shared with the condition parser and nobody else.
#pragma once

#include "steps/expression.hpp"
#include "steps/tokens.hpp"

namespace conform::steps {

struct Expression::Tree {
  enum class Kind {
    number,
    node_id,
    current,
    name,
    value_of,
    bit_of,
    declared,
    complement,
    add,
    subtract,
    bit_or,
    bit_and,
    bit_xor
  };
  Kind kind = Kind::number;
  std::uint64_t number = 0;
  std::string name;
  ObjectReference object;
  Declared declared = Declared::default_value;
  std::shared_ptr<const Tree> left, right;
};

/// Reads the longest expression at the reader's place; what follows is left to the caller.
Result<Expression> parse_expression_prefix(TokenReader& in, std::string text);

}  // namespace conform::steps
