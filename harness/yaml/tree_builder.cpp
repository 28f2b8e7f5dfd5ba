// SPDX-License-Identifier: Apache-2.0
#include "yaml/tree_builder.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/text.hpp"
#include "yaml/loader.hpp"

namespace conform::yaml {
namespace {

constexpr std::string_view no_anchor = "anchors and aliases (& and *) are not allowed";
constexpr std::string_view why_no_anchor = "write the value out: a reader sees it where it is used";

/// Where the comment of a line begins, if what is before it holds no text with such a sign; else its end.
std::size_t begin_of_comment(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) return i;
  }
  return line.size();
}

}  // namespace

std::optional<Node> Builder::take_root() { return std::exchange(root_, std::nullopt); }

void Builder::on_document(std::size_t offset) {
  if (++documents_ < 2) return;
  if (source_.text().substr(offset).starts_with("---")) {
    diagnostics_.error(source_.position(offset), 3, "a second document begins here",
                       "a file holds one document");
  } else {
    diagnostics_.error(source_.position(offset), 1, "the document has ended before this text",
                       "check the indentation and the brackets");
  }
  throw Stop{};
}

void Builder::on_null(const Event& event) {
  Node node = begin_node(event);
  const auto word = null_word(event.offset);
  if (!word.empty()) {
    node.length_ = static_cast<int>(word.size());
    node.faulty_ = true;
    diagnostics_.error(node, fmt::format("'{}' means no value in YAML", word),
                       "leave the key out, or quote the text");
  } else {
    stand_at_parent(node, event.offset);
  }
  add(std::move(node));
}

void Builder::on_alias(const Event& event) {
  Node node = begin_node(event);
  node.faulty_ = true;
  diagnostics_.error(node, std::string(no_anchor), std::string(why_no_anchor));
  add(std::move(node));
}

void Builder::on_scalar(const Event& event, bool styled, std::string text) {
  Node node = begin_node(event);
  node.kind_ = Node::Kind::scalar;
  node.text_ = std::move(text);
  long_quote_line_ = 0;
  measure(node, event.offset, styled);
  if (!check_plain(node, diagnostics_)) node.faulty_ = true;
  add(std::move(node));
}

void Builder::on_mapping_end() {
  report_duplicates(stack_.back().node);
  close();
}

/// Source::position(), but linear over a file of one long line: the events come in order.
Position Builder::place(std::size_t offset) {
  if (offset < placed_offset_ || offset >= line_end_) {
    placed_ = source_.position(offset);
    line_end_ = std::min(source_.text().find('\n', offset), source_.text().size());
  } else {
    placed_.column += code_points(source_.text().substr(placed_offset_, offset - placed_offset_));
  }
  placed_offset_ = offset;
  return placed_;
}

Node Builder::begin_node(const Event& event) {
  last_offset_ = event.offset;
  Node node;
  node.position_ = place(event.offset);
  if (++nodes_ > max_nodes) {
    diagnostics_.error(node, fmt::format("the file has more than {} values", max_nodes), "split it");
    throw Stop{};
  }
  report_tab(node.position_);
  if (event.anchored) diagnostics_.error(node, std::string(no_anchor), std::string(why_no_anchor));
  if (event.tagged) {
    diagnostics_.error(node, "tags (!) are not allowed",
                       "quote the text if it begins with an exclamation mark");
  }
  return node;
}

/// The parser lets some tabs pass as spaces; an editor shows them anywhere.
void Builder::report_tab(Position position) {
  if (position.line == tab_checked_line_) return;
  tab_checked_line_ = position.line;
  const auto line = source_.line(position.line);
  const auto tab = line.substr(0, line.find_first_not_of(" \t")).find('\t');
  if (tab == std::string_view::npos || static_cast<int>(tab) >= position.column) return;
  diagnostics_.error({.line = position.line, .column = static_cast<int>(tab) + 1}, 1,
                     "tab in the indentation", "use spaces");
}

/// "null" or "~" written out at `offset`, else empty.
std::string_view Builder::null_word(std::size_t offset) const {
  const auto rest = source_.text().substr(std::min(offset, source_.text().size()));
  for (const std::string_view word : {"~", "null", "Null", "NULL"}) {
    if (!rest.starts_with(word)) continue;
    const auto behind = rest.substr(word.size());
    if (behind.empty() || std::string_view(" \t\n,]}:").contains(behind.front()))
      return rest.substr(0, word.size());
  }
  return {};
}

/// The parser notes a missing value where it noticed; people look at its key or its dash.
void Builder::stand_at_parent(Node& node, std::size_t offset) {
  if (!stack_.empty() && stack_.back().key) {
    node.position_ = stack_.back().key->position_;
    node.length_ = stack_.back().key->length_;
    return;
  }
  // Between the dash and where the parser noticed there are only blanks and comments.
  for (int number = node.position_.line; number > 0; --number) {
    const auto begins = source_.offset({.line = number, .column = 1});
    const auto line = source_.line(number).substr(0, offset - begins);
    const auto last = line.substr(0, comment_in(number)).find_last_not_of(' ');
    if (last == std::string_view::npos) continue;
    if (number == node.position_.line) {
      node.position_.column -= code_points(line.substr(last));
    } else {
      node.position_ = source_.position(begins + last);
    }
    return;
  }
}

/// A line of a hundred thousand missing values is looked through once.
std::size_t Builder::comment_in(int number) {
  if (number != comment_line_) {
    comment_line_ = number;
    comment_ = begin_of_comment(source_.line(number));
  }
  return comment_;
}

/// Style and extent come from the source: the parser does not tell them.
void Builder::measure(Node& node, std::size_t offset, bool styled) {
  const auto rest = source_.text().substr(std::min(offset, source_.text().size()));
  const auto first_line = rest.substr(0, line_end_ - std::min(offset, line_end_));
  const char first = rest.empty() ? '\0' : rest.front();
  if (styled && (first == '"' || first == '\'')) {
    node.quoted_ = true;
    measure_quoted(node, rest, first_line);
  } else if (styled && (first == '|' || first == '>')) {
    node.length_ = 1;
    node.block_scalar_ = first == '|';
    node.folded_ = first == '>';
    if (node.block_scalar_) place_lines(node);
  } else if (first == '!' || first == '&') {
    node.quoted_ = styled;  // refused already; do not also call it ambiguous
  } else {
    node.verbatim_ = first_line.starts_with(node.text_);
    node.length_ = std::max(1, code_points(node.verbatim_ ? std::string_view(node.text_) : first_line));
  }
}

void Builder::measure_quoted(Node& node, std::string_view rest, std::string_view first_line) {
  const char quote = rest.front();
  std::size_t end = 1;
  while (end < rest.size()) {
    const bool escape = quote == '"' ? rest[end] == '\\' : rest.substr(end).starts_with("''");
    if (!escape && rest[end] == quote) break;
    end += escape ? 2 : 1;
  }
  if (end >= rest.size()) {
    // The parser takes the end of the file for the missing quote.
    diagnostics_.error(node.position_, code_points(first_line), "this quote is never closed");
    node.faulty_ = true;
    node.length_ = code_points(first_line);
  } else if (end < first_line.size()) {
    node.verbatim_ = rest.substr(1, end - 1) == node.text_;
    node.length_ = code_points(rest.substr(0, end + 1));
  } else {
    node.length_ = code_points(first_line);
    long_quote_line_ = node.position_.line;
  }
}

/// Line i of a literal block stands i + 1 lines below its header, behind an indentation of its own.
void Builder::place_lines(Node& node) const {
  std::string_view rest = node.text_;
  for (int number = node.position_.line + 1;; ++number) {
    const auto newline = rest.find('\n');
    const auto content = rest.substr(0, newline);
    const auto line = source_.line(number);
    const bool matches = !content.empty() && line.ends_with(content);
    node.lines_.push_back(
        {.line = number, .column = matches ? static_cast<int>(line.size() - content.size()) + 1 : 1});
    if (newline == std::string_view::npos) return;
    rest.remove_prefix(newline + 1);
  }
}

void Builder::open(Node::Kind kind, const Event& event, bool flow) {
  Node node = begin_node(event);
  node.kind_ = kind;
  node.flow_ = flow;
  if (stack_.size() >= static_cast<std::size_t>(max_depth)) {
    diagnostics_.error(node, fmt::format("nested deeper than {} levels", max_depth));
    throw Stop{};
  }
  stack_.push_back({.node = std::move(node), .key = std::nullopt});
}

void Builder::close() {
  CONFORM_CHECK(!stack_.empty());
  Node node = std::move(stack_.back().node);
  stack_.pop_back();
  add(std::move(node));
}

void Builder::add(Node node) {
  if (stack_.empty()) {
    root_ = std::move(node);
    return;
  }
  Frame& frame = stack_.back();
  if (frame.node.is_sequence()) {
    frame.node.items_.push_back(std::move(node));
  } else if (!frame.key) {
    frame.key = checked_key(std::move(node));
    if (frame.node.entries_.empty() && !frame.node.flow_) frame.node.length_ = frame.key->length_;
  } else {
    frame.node.entries_.push_back({.key = *std::move(frame.key), .value = std::move(node)});
    frame.key.reset();
  }
}

Node Builder::checked_key(Node key) {
  if (!key.is_scalar()) {
    if (!key.faulty_) {
      diagnostics_.error(key, fmt::format("a key must be a word, not {}", describe(key)));
    }
    Node word;
    word.kind_ = Node::Kind::scalar;
    word.position_ = key.position_;
    word.faulty_ = true;
    return word;
  }
  if (key.plain() && key.text_ == "<<") {
    diagnostics_.error(key, "merge keys (<<) are not allowed",
                       "YAML readers disagree on them; write the keys out");
    key.faulty_ = true;
  }
  return key;
}

void Builder::report_duplicates(Node& mapping) {
  std::map<std::string_view, Position> seen;
  for (auto& entry : mapping.entries_) {
    if (entry.key.faulty_ && entry.key.text_.empty()) continue;
    const auto [first, is_new] = seen.emplace(entry.key.text_, entry.key.position_);
    if (is_new) continue;
    diagnostics_.error(entry.key, fmt::format("duplicate key '{}'", entry.key.text_),
                       fmt::format("it is already given at {}", to_string(first->second)));
  }
}

}  // namespace conform::yaml
