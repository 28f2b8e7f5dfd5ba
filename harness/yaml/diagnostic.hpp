// SPDX-License-Identifier: Apache-2.0
// What is wrong in an input file, where, and what was probably meant; all mistakes of a file together.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "yaml/source.hpp"

namespace conform::yaml {

class Node;

struct Diagnostic {
  enum class Severity { error, warning };
  Severity severity = Severity::error;
  Position begin;
  int length = 1;  ///< code points to underline
  std::string
      message;  ///< one sentence, lower case, no full stop; may quote the input, it is escaped when printed
  std::string hint;  ///< "did you mean 'abort'?", or empty; printed behind the message
};

/// Collects the diagnostics of one source. A repeated one (same place, same message) is kept once; beyond
/// `limit` they are only counted, so that a hostile file cannot fill the memory.
class Diagnostics {
 public:
  static constexpr std::size_t limit = 200;

  explicit Diagnostics(SourcePtr source);

  [[nodiscard]] const Source& source() const { return *source_; }

  void add(Diagnostic diagnostic);
  void error(Position begin, int length, std::string message, std::string hint = {});
  void warning(Position begin, int length, std::string message, std::string hint = {});
  /// The same, pointing at a node.
  void error(const Node& node, std::string message, std::string hint = {});
  void warning(const Node& node, std::string message, std::string hint = {});

  [[nodiscard]] bool has_errors() const { return errors_ > 0; }
  [[nodiscard]] std::size_t error_count() const { return errors_; }
  [[nodiscard]] bool empty() const { return all_.empty(); }
  /// By position; what was reported first comes first at the same place.
  [[nodiscard]] const std::vector<Diagnostic>& sorted() const { return all_; }

  /// For each: "file:line:column: error: message; hint", the source line and a caret underline.
  [[nodiscard]] std::string render(bool colour = false) const;

 private:
  SourcePtr source_;
  std::vector<Diagnostic> all_;
  std::size_t errors_ = 0;
  std::size_t left_out_ = 0;
};

/// "; did you mean 'x'?" without the semicolon: the hint for `word` among `known`, or empty.
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string_view>& known);

}  // namespace conform::yaml
