// SPDX-License-Identifier: Apache-2.0
// From the events of a YAML parser to the checked tree, whichever parser it is.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "yaml/diagnostic.hpp"
#include "yaml/node.hpp"
#include "yaml/source.hpp"

namespace conform::yaml {

/// Ends parsing from inside an event; what there is to say has been reported.
struct Stop {};

/// Where a value begins and what stands before it.
struct Event {
  std::size_t offset = 0;  ///< byte of the source
  bool anchored = false;   ///< &name
  bool tagged = false;     ///< !name, not the tag that a parser gives by itself
};

/// Receives a parser's events and makes the tree; what is not allowed goes to `diagnostics`. An event may
/// throw Stop: nothing behind it can be understood.
class Builder {
 public:
  Builder(const Source& source, Diagnostics& diagnostics) : source_(source), diagnostics_(diagnostics) {}

  [[nodiscard]] std::optional<Node> take_root();
  /// Where the last event stood, and the line on which the last quoted text began if it went over several.
  [[nodiscard]] std::size_t last_offset() const { return last_offset_; }
  [[nodiscard]] int long_quote_line() const { return long_quote_line_; }

  void on_document(std::size_t offset);
  /// No value, or a word for it.
  void on_null(const Event& event);
  void on_alias(const Event& event);
  /// `styled`: in quotes or as a block, not plain.
  void on_scalar(const Event& event, bool styled, std::string text);
  void on_sequence(const Event& event, bool flow) { open(Node::Kind::sequence, event, flow); }
  void on_mapping(const Event& event, bool flow) { open(Node::Kind::mapping, event, flow); }
  void on_sequence_end() { close(); }
  void on_mapping_end();

 private:
  struct Frame {
    Node node;
    std::optional<Node> key;
  };

  Position place(std::size_t offset);
  Node begin_node(const Event& event);
  void report_tab(Position position);
  [[nodiscard]] std::string_view null_word(std::size_t offset) const;
  void stand_at_parent(Node& node, std::size_t offset);
  [[nodiscard]] std::size_t comment_in(int number);
  void measure(Node& node, std::size_t offset, bool styled);
  void measure_quoted(Node& node, std::string_view rest, std::string_view first_line);
  void place_lines(Node& node) const;
  void open(Node::Kind kind, const Event& event, bool flow);
  void close();
  void add(Node node);
  Node checked_key(Node key);
  void report_duplicates(Node& mapping);

  const Source& source_;
  Diagnostics& diagnostics_;
  std::vector<Frame> stack_;
  std::optional<Node> root_;
  std::size_t nodes_ = 0;
  std::size_t last_offset_ = 0;
  Position placed_;  // of placed_offset_, on the line that ends at line_end_
  std::size_t placed_offset_ = 0;
  std::size_t line_end_ = 0;
  int documents_ = 0;
  int tab_checked_line_ = 0;
  int comment_line_ = 0;  // of which comment_ is where its comment begins
  std::size_t comment_ = 0;
  int long_quote_line_ = 0;
};

}  // namespace conform::yaml
