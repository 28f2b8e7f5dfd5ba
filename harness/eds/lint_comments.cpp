// SPDX-License-Identifier: Apache-2.0
#include "eds/lint_comments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <pugixml.hpp>

#include "base/text.hpp"
#include "eds/ini_file.hpp"
#include "eds/text_lines.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view source = "docs/eds-lint-in-ci.md";
constexpr Rule not_understood{"EDS900", Severity::warning, "A comment for the lint is not understood",
                              source};
constexpr Rule no_such_rule{"EDS901", Severity::warning, "A comment allows a rule that does not exist",
                            source};
constexpr Rule no_reason{"EDS902", Severity::warning, "A comment allows a rule without a reason", source};
constexpr Rule allows_nothing{"EDS903", Severity::note, "A comment allows what is not found", source};

constexpr const Rule* all[] = {&not_understood, &no_such_rule, &no_reason, &allows_nothing};

constexpr std::string_view form = "write lint: allow EDS210 and the reason";

/// Takes the first word off, up to a blank, a comma or a colon.
std::string_view take_word(std::string_view& text) {
  text = trim(text);
  const auto end = std::min(text.find_first_of(" \t,:"), text.size());
  const auto word = text.substr(0, end);
  text.remove_prefix(end);
  const auto next = text.find_first_not_of(" \t,:");
  text.remove_prefix(std::min(next, text.size()));
  return word;
}

bool looks_like_code(std::string_view word) {
  constexpr std::size_t prefix = 3;
  return word.size() > prefix && same_word(word.substr(0, prefix), "EDS") &&
         std::ranges::all_of(word.substr(prefix), [](char c) { return c >= '0' && c <= '9'; });
}

std::string upper(std::string_view word) {
  std::string out(word);
  for (auto& c : out) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return out;
}

/// What stands behind "lint:" in a comment; nullopt for any other comment.
std::optional<std::string_view> addressed(std::string_view comment) {
  constexpr std::string_view word = "lint:";
  comment = trim(comment);
  if (comment.size() < word.size() || !same_word(comment.substr(0, word.size()), word)) return std::nullopt;
  return trim(comment.substr(word.size()));
}

/// The rules that are allowed, with their reason; empty, and a finding, when that is not what is said.
std::vector<const Rule*> allowed_rules(std::string_view text, Position at, std::vector<Finding>& findings) {
  const auto tell = [&](const Rule& rule, std::string message) {
    findings.push_back({&rule, at, std::move(message), std::string(form)});
    return std::vector<const Rule*>();
  };
  const auto said = shortened(text);
  if (!same_word(take_word(text), "allow"))
    return tell(not_understood, fmt::format("'{}' is not understood", said));
  std::vector<const Rule*> out;
  bool named = false;
  while (out.size() < LintComments::most && findings.size() < LintComments::most) {
    auto rest = text;
    const auto word = take_word(rest);
    if (!looks_like_code(word)) break;
    text = rest;
    named = true;
    if (const auto* rule = find_rule(upper(word)))
      out.push_back(rule);
    else
      (void)tell(no_such_rule, fmt::format("there is no rule {}", shortened(upper(word))));
  }
  if (!named) return tell(not_understood, fmt::format("'{}' names no rule", said));
  if (trim(text).find_first_not_of(" \t-:.") == std::string_view::npos)
    return tell(no_reason, fmt::format("'{}' gives no reason, and allows nothing", said));
  return out;
}

// ---- EDS and DCF

/// Where the section that begins in `line` ends; sub-objects belong to their object.
std::size_t section_end(const TextLines& lines, std::size_t line) {
  const auto name_of = [&](std::size_t number) {
    const auto text = trim(lines.line(number));
    return lower(trim(text.substr(1, text.find(']') - 1)));
  };
  const auto name = name_of(line);
  for (auto next = line + 1; next <= lines.count(); ++next) {
    if (trim(lines.line(next)).starts_with('[') && !name_of(next).starts_with(name + "sub")) return next;
  }
  return lines.count() + 1;
}

LintComments in_sections(std::string_view bytes) {
  LintComments out;
  const TextLines lines(bytes);
  const auto line_begin = [](std::size_t number) { return Position{static_cast<std::uint32_t>(number), 0}; };
  bool head = true;
  std::size_t target = 0;  // the line that a comment is about; one for all comments above it
  std::size_t end = 0;
  for (std::size_t number = 1; number <= lines.count() && !out.full(); ++number) {
    const auto line = lines.line(number);
    const auto text = trim(line);
    if (text.starts_with('[')) head = false;
    if (!text.starts_with(';')) continue;
    const auto said = addressed(text.substr(1));
    if (!said) continue;
    const Position at{static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(line.find(';') + 1)};
    if (target <= number) {
      target = number + 1;
      while (target <= lines.count() &&
             (trim(lines.line(target)).empty() || trim(lines.line(target)).starts_with(';')))
        ++target;
      end = trim(lines.line(target)).starts_with('[') ? section_end(lines, target) : target + 1;
    }
    for (const auto* rule : allowed_rules(*said, at, out.findings))
      out.allowed.push_back({rule, at, line_begin(target), line_begin(end), head});
  }
  return out;
}

// ---- XDD and XDC

class XmlComments {
 public:
  explicit XmlComments(std::string_view bytes) : lines_(bytes), size_(bytes.size()) {}

  // As deep as the reader allows: it has refused what is deeper.
  void walk(const pugi::xml_node& parent, std::size_t parent_end, bool head) {
    for (auto node = parent.first_child(); !node.empty() && !out.full(); node = node.next_sibling()) {
      if (node.type() == pugi::node_comment) comment(node, parent_end, head);
      if (node.type() == pugi::node_element) walk(node, end_of(node, parent_end), false);
    }
  }

  LintComments out;

 private:
  void comment(const pugi::xml_node& node, std::size_t parent_end, bool head) {
    const auto said = addressed(node.value());
    if (!said) return;
    const auto at = lines_.position(begin_of(node));
    auto target = node.next_sibling();
    while (!target.empty() && target.type() != pugi::node_element) target = target.next_sibling();
    const auto from = target.empty() ? size_ : begin_of(target);
    const auto to = target.empty() ? size_ : end_of(target, parent_end);
    for (const auto* rule : allowed_rules(*said, at, out.findings))
      out.allowed.push_back({rule, at, lines_.position(from), lines_.position(to), head});
  }

  /// Of the '<' of an element, or the text of a comment.
  [[nodiscard]] static std::size_t begin_of(const pugi::xml_node& node) {
    const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
    return node.type() == pugi::node_element && offset > 0 ? offset - 1 : offset;
  }
  /// Up to what follows; nothing but closing tags stands between.
  [[nodiscard]] static std::size_t end_of(const pugi::xml_node& node, std::size_t parent_end) {
    auto next = node.next_sibling();
    while (!next.empty() && next.type() != pugi::node_element) next = next.next_sibling();
    return next.empty() ? parent_end : begin_of(next);
  }

  TextLines lines_;
  std::size_t size_;
};

LintComments in_elements(std::string_view bytes) {
  pugi::xml_document document;
  if (!document.load_buffer(bytes.data(), bytes.size(), pugi::parse_default | pugi::parse_comments))
    return {};
  XmlComments comments(bytes);
  comments.walk(document, bytes.size() + 1, true);
  return std::move(comments.out);
}

}  // namespace

constinit const RuleGroup comment_rules{"Comments for the lint", all};

LintComments read_lint_comments(std::string_view bytes, const EdsFile& file) {
  // Of most files this is the only look.
  const auto colon = [&] {
    for (auto at = bytes.find(':'); at != std::string_view::npos; at = bytes.find(':', at + 1)) {
      if (at >= 4 && same_word(bytes.substr(at - 4, 4), "lint")) return true;
    }
    return false;
  };
  if (!colon()) return {};
  return file.is_xml() ? in_elements(bytes) : in_sections(bytes);
}

Finding nothing_allowed(const Allowed& allowed) {
  return {&allows_nothing, allowed.at, fmt::format("{} is allowed, but not found here", allowed.rule->code),
          "remove the comment"};
}

}  // namespace conform::eds
