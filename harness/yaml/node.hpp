// SPDX-License-Identifier: Apache-2.0
// The tree of a YAML document: immutable, with positions, without types (a scalar is its text) and without
// aliases.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "yaml/source.hpp"

namespace conform::yaml {

struct Entry;

class Node {
 public:
  enum class Kind { null, scalar, sequence, mapping };

  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] bool is_null() const { return kind_ == Kind::null; }
  [[nodiscard]] bool is_scalar() const { return kind_ == Kind::scalar; }
  [[nodiscard]] bool is_sequence() const { return kind_ == Kind::sequence; }
  [[nodiscard]] bool is_mapping() const { return kind_ == Kind::mapping; }

  /// Text of a scalar; empty for all other kinds.
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] bool quoted() const { return quoted_; }              ///< '..' or ".."
  [[nodiscard]] bool block_scalar() const { return block_scalar_; }  ///< literal, |
  [[nodiscard]] bool folded() const { return folded_; }              ///< folded, >
  /// A scalar that is none of the three above.
  [[nodiscard]] bool plain() const { return is_scalar() && !quoted_ && !block_scalar_ && !folded_; }
  [[nodiscard]] bool flow() const { return flow_; }  ///< written with [ ] or { }
  /// Already reported when the file was loaded: typed reads need not complain again.
  [[nodiscard]] bool faulty() const { return faulty_; }

  /// First character. A missing value stands at its key, a block mapping at its first key.
  [[nodiscard]] Position position() const { return position_; }
  /// Code points on that line; at least 1.
  [[nodiscard]] int length() const { return length_; }

  [[nodiscard]] const std::vector<Node>& items() const { return items_; }
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }  ///< in file order
  /// The value of a key in a mapping; null pointer when there is none (or this is no mapping).
  [[nodiscard]] const Node* find(std::string_view key) const;

  /// Where content line `line` (from 0) of a literal block scalar begins, behind its indentation.
  /// For other scalars line 0 is the first character inside the quotes.
  [[nodiscard]] Position line_position(int line) const;
  /// Where the byte `offset` of text() stands in the file; the start of the scalar when escapes or folding
  /// hide it.
  [[nodiscard]] Position position_at(std::size_t offset) const;

 private:
  friend class Builder;

  Kind kind_ = Kind::null;
  bool quoted_ = false;
  bool block_scalar_ = false;
  bool folded_ = false;
  bool flow_ = false;
  bool faulty_ = false;
  bool verbatim_ = false;  // text_ stands in the file as it is, on one line
  int length_ = 1;
  Position position_;
  std::string text_;
  std::vector<Node> items_;
  std::vector<Entry> entries_;
  std::vector<Position> lines_;  // block scalars only
};

struct Entry {
  Node key;  ///< always a scalar
  Node value;
};

/// "a mapping", "a list", "nothing", "'text'" (clipped): how messages name what was found.
[[nodiscard]] std::string describe(const Node& node);

}  // namespace conform::yaml
