// SPDX-License-Identifier: Apache-2.0
// Words and operators of expressions and conditions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace conform::steps {

/// One word ("1003h:00", "$before", "0609 0030h", "is") or one operator ("+", ">=", "(").
struct Token {
  std::string text;
  std::size_t offset = 0;  ///< in the text that was split, for messages
};

/// Splits a text. Groups of four hex digits that end in h are joined: "8000 06A0h" is one number.
Result<std::vector<Token>> tokenize(std::string_view text);

/// A list of tokens being read from left to right.
class TokenReader {
 public:
  explicit TokenReader(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}
  [[nodiscard]] bool done() const { return next_ >= tokens_.size(); }
  [[nodiscard]] std::string_view peek(std::size_t ahead = 0) const {
    return next_ + ahead < tokens_.size() ? std::string_view(tokens_[next_ + ahead].text)
                                          : std::string_view();
  }
  std::string_view take() {
    const auto text = peek();
    ++next_;
    return text;
  }
  bool accept(std::string_view word) {
    if (peek() != word || done()) return false;
    ++next_;
    return true;
  }
  [[nodiscard]] std::size_t position() const { return next_; }
  void rewind(std::size_t position) { next_ = position; }

 private:
  std::vector<Token> tokens_;
  std::size_t next_ = 0;
};

}  // namespace conform::steps
