// SPDX-License-Identifier: Apache-2.0
#include "yaml/syntax_error.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

namespace conform::yaml {
namespace {

struct Wording {
  std::string_view parser;  // how its message begins
  std::string_view message;
  std::string_view hint;
};

constexpr std::array wordings = {
    Wording{"illegal map value", "a ':' is not possible here",
            "check the indentation, or quote text that holds a colon followed by a space"},
    Wording{"illegal map key", "a key is not possible here", "check the indentation"},
    Wording{"illegal block entry", "a list item ('- ') is not possible here",
            "begin the list on a line of its own"},
    Wording{"illegal flow end", "this bracket closes nothing", ""},
    Wording{"end of map flow not found", "a '{' is not closed before this", "add '}' or ','"},
    Wording{"end of sequence flow not found", "a '[' is not closed before this", "add ']' or ','"},
    Wording{"end of map not found", "this does not fit into the mapping around it",
            "check the indentation and the quotes"},
    Wording{"end of sequence not found", "this does not fit into the list around it",
            "check the indentation and the quotes"},
    Wording{"unknown token", "a plain text cannot begin with this character", "quote it"},
    Wording{"unknown escape character", "unknown escape sequence",
            "in \"...\" write \\\\ for a backslash, or use '...'"},
    Wording{"bad character found while scanning hex number", "bad escape sequence",
            "\\x takes two, \\u four hex digits"},
    Wording{"invalid unicode", "bad escape sequence", "there is no such character"},
    Wording{"illegal document indicator in scalar", "'---' or '...' inside a quoted text",
            "is a closing quote missing?"},
    Wording{"illegal tab when looking for indentation", "tab in the indentation", "use spaces"},
    Wording{"illegal character in scalar", "this character is not possible here", "quote the text"},
    Wording{"unexpected character in block scalar", "only indentation and chomping signs may follow | or >",
            ""},
    Wording{"cannot set zero indentation", "the indentation of a block text cannot be 0", ""},
    Wording{"alias not found after *", "a plain text cannot begin with '*'", "quote it"},
    Wording{"anchor not found after &", "a plain text cannot begin with '&'", "quote it"},
    Wording{"the referenced anchor is not defined", "anchors and aliases (& and *) are not allowed",
            "quote a text that begins with '*'"},
    Wording{"illegal character found while scanning a", "a plain text cannot begin with '*' or '&'",
            "quote it"},
    Wording{"cannot assign multiple anchors", "anchors and aliases (& and *) are not allowed", ""},
    Wording{"cannot assign multiple tags", "tags (!) are not allowed", "quote the text"},
    Wording{"aliases can't have any content", "anchors and aliases (& and *) are not allowed", ""},
    Wording{"tag handle with no suffix", "tags (!) are not allowed", "quote the text"},
    Wording{"illegal character found while scanning tag", "tags (!) are not allowed", "quote the text"},
    Wording{"end of verbatim tag not found", "tags (!) are not allowed", "quote the text"},
};

/// The quote that opened the text the parser ran out in: the first one at the start of a word.
std::size_t open_quote(std::string_view text, std::size_t from) {
  for (std::size_t i = from; i < text.size(); ++i) {
    const char before = i == 0 ? '\n' : text[i - 1];
    const bool starts_word = std::string_view(" \n\t[{,:").contains(before);
    if (starts_word && text[i] == '#') {
      i = std::min(text.find('\n', i), text.size());
    } else if (starts_word && (text[i] == '"' || text[i] == '\'')) {
      return i;
    }
  }
  return std::string_view::npos;
}

}  // namespace

void report_syntax_error(const SyntaxError& error, const Source& source, Diagnostics& diagnostics) {
  const auto position = source.position(error.offset);
  // A tab can break the structure lines before the parser notices.
  for (int number = source.position(error.last_offset).line; number <= position.line; ++number) {
    const auto line = source.line(number);
    const auto tab = line.substr(0, line.find_first_not_of(" \t")).find('\t');
    if (tab == std::string_view::npos) continue;
    diagnostics.error({.line = number, .column = static_cast<int>(tab) + 1}, 1, "tab in the indentation",
                      "use spaces");
    return;
  }
  if (error.message.starts_with("illegal EOF in scalar")) {
    const auto quote = open_quote(source.text(), error.last_offset);
    const auto place = quote == std::string_view::npos ? position : source.position(quote);
    diagnostics.error(place, 1, "this quote is never closed");
    return;
  }
  const auto found = std::ranges::find_if(
      wordings, [&](const Wording& wording) { return error.message.starts_with(wording.parser); });
  std::string message =
      found == wordings.end() ? fmt::format("YAML syntax: {}", error.message) : std::string(found->message);
  std::string hint = found == wordings.end() ? std::string() : std::string(found->hint);
  if (error.long_quote_line > 0) {
    hint = fmt::format(
        "the text quoted in line {} goes on over several lines: is a closing quote missing there?",
        error.long_quote_line);
  }
  diagnostics.error(position, 1, std::move(message), std::move(hint));
}

}  // namespace conform::yaml
