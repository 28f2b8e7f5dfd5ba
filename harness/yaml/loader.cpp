// SPDX-License-Identifier: Apache-2.0
#include "yaml/loader.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include "base/check.hpp"
#include "base/files.hpp"
#include "base/in_parallel.hpp"
#include "base/text.hpp"
#include "yaml/syntax_error.hpp"
#include "yaml/text_check.hpp"

namespace conform::yaml {
namespace {

/// Ends parsing from inside an event; what there is to say has been reported.
struct Stop {};

constexpr std::string_view no_anchor = "anchors and aliases (& and *) are not allowed";
constexpr std::string_view why_no_anchor = "write the value out: a reader sees it where it is used";

}  // namespace

/// Receives the parser's events and makes the tree.
class Builder final : public YAML::EventHandler {
 public:
  Builder(const Source& source, Diagnostics& diagnostics) : source_(source), diagnostics_(diagnostics) {}

  [[nodiscard]] std::optional<Node> take_root() { return std::exchange(root_, std::nullopt); }
  /// Where the last event stood, and the line on which the last quoted text began if it went over several.
  [[nodiscard]] std::size_t last_offset() const { return last_offset_; }
  [[nodiscard]] int long_quote_line() const { return long_quote_line_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ < 2) return;
    const auto offset = offset_of(mark);
    if (source_.text().substr(offset).starts_with("---")) {
      diagnostics_.error(source_.position(offset), 3, "a second document begins here",
                         "a file holds one document");
    } else {
      diagnostics_.error(source_.position(offset), 1, "the document has ended before this text",
                         "check the indentation and the brackets");
    }
    throw Stop{};
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Node node = begin_node(mark, "", anchor);
    const auto word = null_word(offset_of(mark));
    if (!word.empty()) {
      node.length_ = static_cast<int>(word.size());
      node.faulty_ = true;
      diagnostics_.error(node, fmt::format("'{}' means no value in YAML", word),
                         "leave the key out, or quote the text");
    } else {
      stand_at_parent(node, offset_of(mark));
    }
    add(std::move(node));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    Node node = begin_node(mark, "", 0);
    node.faulty_ = true;
    diagnostics_.error(node, std::string(no_anchor), std::string(why_no_anchor));
    add(std::move(node));
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    Node node = begin_node(mark, tag, anchor);
    node.kind_ = Node::Kind::scalar;
    node.text_ = value;
    long_quote_line_ = 0;
    measure(node, offset_of(mark), tag);
    if (!check_plain(node, diagnostics_)) node.faulty_ = true;
    add(std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override {
    open(Node::Kind::sequence, mark, tag, anchor, style);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override {
    open(Node::Kind::mapping, mark, tag, anchor, style);
  }
  void OnMapEnd() override {
    report_duplicates(stack_.back().node);
    close();
  }

 private:
  struct Frame {
    Node node;
    std::optional<Node> key;
  };

  [[nodiscard]] std::size_t offset_of(const YAML::Mark& mark) const {
    return mark.pos < 0 ? source_.text().size() : static_cast<std::size_t>(mark.pos);
  }

  /// Source::position(), but linear over a file of one long line: the events come in order.
  Position place(std::size_t offset) {
    if (offset < placed_offset_ || offset >= line_end_) {
      placed_ = source_.position(offset);
      line_end_ = std::min(source_.text().find('\n', offset), source_.text().size());
    } else {
      placed_.column += code_points(source_.text().substr(placed_offset_, offset - placed_offset_));
    }
    placed_offset_ = offset;
    return placed_;
  }

  Node begin_node(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    const auto offset = offset_of(mark);
    last_offset_ = offset;
    Node node;
    node.position_ = place(offset);
    if (++nodes_ > max_nodes) {
      diagnostics_.error(node, fmt::format("the file has more than {} values", max_nodes), "split it");
      throw Stop{};
    }
    report_tab(node.position_);
    const bool explicit_tag = source_.text().substr(offset).starts_with('!');
    if (anchor != 0) diagnostics_.error(node, std::string(no_anchor), std::string(why_no_anchor));
    if (explicit_tag || (tag != "?" && tag != "!" && !tag.empty())) {
      diagnostics_.error(node, "tags (!) are not allowed",
                         "quote the text if it begins with an exclamation mark");
    }
    return node;
  }

  /// The parser lets some tabs pass as spaces; an editor shows them anywhere.
  void report_tab(Position position) {
    if (position.line == tab_checked_line_) return;
    tab_checked_line_ = position.line;
    const auto line = source_.line(position.line);
    const auto tab = line.substr(0, line.find_first_not_of(" \t")).find('\t');
    if (tab == std::string_view::npos || static_cast<int>(tab) >= position.column) return;
    diagnostics_.error({.line = position.line, .column = static_cast<int>(tab) + 1}, 1,
                       "tab in the indentation", "use spaces");
  }

  /// "null" or "~" written out at `offset`, else empty.
  [[nodiscard]] std::string_view null_word(std::size_t offset) const {
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
  void stand_at_parent(Node& node, std::size_t offset) const {
    if (!stack_.empty() && stack_.back().key) {
      node.position_ = stack_.back().key->position_;
      node.length_ = stack_.back().key->length_;
      return;
    }
    const auto before = source_.text().substr(0, offset);
    const auto last = before.find_last_not_of(" \n");
    if (last == std::string_view::npos) return;
    const auto between = before.substr(last);
    if (between.find('\n') == std::string_view::npos) {
      node.position_.column -= code_points(between);
    } else {
      node.position_ = source_.position(last);
    }
  }

  /// Style and extent come from the source: the parser does not tell them.
  void measure(Node& node, std::size_t offset, const std::string& tag) {
    const auto rest = source_.text().substr(std::min(offset, source_.text().size()));
    const auto first_line = rest.substr(0, line_end_ - std::min(offset, line_end_));
    const char first = rest.empty() ? '\0' : rest.front();
    if (tag == "!" && (first == '"' || first == '\'')) {
      node.quoted_ = true;
      measure_quoted(node, rest, first_line);
    } else if (tag == "!" && (first == '|' || first == '>')) {
      node.length_ = 1;
      node.block_scalar_ = first == '|';
      node.folded_ = first == '>';
      if (node.block_scalar_) place_lines(node);
    } else if (first == '!' || first == '&') {
      node.quoted_ = tag == "!";  // refused already; do not also call it ambiguous
    } else {
      node.verbatim_ = first_line.starts_with(node.text_);
      node.length_ = std::max(1, code_points(node.verbatim_ ? std::string_view(node.text_) : first_line));
    }
  }

  void measure_quoted(Node& node, std::string_view rest, std::string_view first_line) {
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
  void place_lines(Node& node) const {
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

  void open(Node::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
            YAML::EmitterStyle::value style) {
    Node node = begin_node(mark, tag, anchor);
    node.kind_ = kind;
    node.flow_ = style == YAML::EmitterStyle::Flow;
    if (stack_.size() >= static_cast<std::size_t>(max_depth)) {
      diagnostics_.error(node, fmt::format("nested deeper than {} levels", max_depth));
      throw Stop{};
    }
    stack_.push_back({.node = std::move(node), .key = std::nullopt});
  }

  void close() {
    CONFORM_CHECK(!stack_.empty());
    Node node = std::move(stack_.back().node);
    stack_.pop_back();
    add(std::move(node));
  }

  void add(Node node) {
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

  Node checked_key(Node key) {
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

  void report_duplicates(Node& mapping) {
    std::map<std::string_view, Position> seen;
    for (auto& entry : mapping.entries_) {
      if (entry.key.faulty_ && entry.key.text_.empty()) continue;
      const auto [first, is_new] = seen.emplace(entry.key.text_, entry.key.position_);
      if (is_new) continue;
      diagnostics_.error(entry.key, fmt::format("duplicate key '{}'", entry.key.text_),
                         fmt::format("it is already given at {}", to_string(first->second)));
    }
  }

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
  int long_quote_line_ = 0;
};

namespace {

void refuse_directives(const Source& source, Diagnostics& diagnostics) {
  for (int number = 1; number <= source.line_count(); ++number) {
    const auto line = source.line(number);
    const auto first = line.find_first_not_of(' ');
    if (first == std::string_view::npos || line[first] == '#') continue;
    if (line[first] != '%') return;
    diagnostics.error({.line = number, .column = 1}, code_points(line), "directives (%) are not allowed",
                      "remove the line");
  }
}

}  // namespace

std::optional<Node> load(const Source& source, Diagnostics& diagnostics) {
  if (!check_text(source, diagnostics)) return std::nullopt;
  refuse_directives(source, diagnostics);
  Builder builder(source, diagnostics);
  try {
    std::istringstream stream{std::string(source.text())};
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const Stop&) {
    return std::nullopt;
  } catch (const YAML::Exception& exception) {
    report_syntax_error({.message = exception.msg,
                         .offset = exception.mark.pos < 0 ? source.text().size()
                                                          : static_cast<std::size_t>(exception.mark.pos),
                         .last_offset = builder.last_offset(),
                         .long_quote_line = builder.long_quote_line()},
                        source, diagnostics);
    return std::nullopt;
  }
  auto root = builder.take_root();
  if (!root || root->is_null()) {
    if (!root || !root->faulty()) diagnostics.error({}, 1, "the file holds nothing");
    return std::nullopt;
  }
  return root;
}

Result<SourcePtr> read_source(const std::string& path, std::string name) {
  if (name.empty()) name = path;
  auto text = read_file(path, max_file_size);
  if (!text) return fail(std::move(text.error().what), std::move(name), std::move(text.error().hint));
  return make_source(std::move(name), *text);
}

Result<Document> load_file(const std::string& path, std::string name) {
  auto source = read_source(path, std::move(name));
  if (!source) return std::unexpected(source.error());
  Document document{.source = *source, .diagnostics = Diagnostics(*source), .root = std::nullopt};
  document.root = load(*document.source, document.diagnostics);
  return document;
}

std::vector<Result<Document>> load_files(const std::vector<NamedFile>& files, const UseTree& use) {
  std::vector<std::optional<Result<Document>>> loaded(files.size());
  in_parallel(files.size(), 0, [&](std::size_t i) {
    auto& document = loaded[i].emplace(load_file(files[i].path, files[i].name));
    if (!document || !document->root) return;
    use(i, *document->root, document->diagnostics);
    document->root.reset();
  });
  std::vector<Result<Document>> out;
  for (auto& each : loaded) out.push_back(std::move(*each));
  return out;
}

}  // namespace conform::yaml
