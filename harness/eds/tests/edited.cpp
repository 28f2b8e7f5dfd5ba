// SPDX-License-Identifier: Apache-2.0
#include "edited.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <stdexcept>
#include <vector>

#include "base/text.hpp"
#include "eds/ini_file.hpp"

namespace conform::eds {
namespace {

[[noreturn]] void nothing_to_change(std::string_view edit) {
  throw std::runtime_error(fmt::format("nothing to change by '{}'", edit));
}

/// \n \r \t \" \xNN, and {241x} for 241 letters.
std::string unescaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '{') {
      std::size_t count = 0;
      const auto* begin = text.data() + i + 1;
      const auto [end, error] = std::from_chars(begin, text.data() + text.size(), count);
      const auto after = static_cast<std::size_t>(end - text.data());
      if (error == std::errc() && text.substr(after).starts_with("x}")) {
        out.append(count, 'x');
        i = after + 1;
        continue;
      }
    }
    if (text[i] != '\\' || i + 1 == text.size()) {
      out += text[i];
      continue;
    }
    const char next = text[++i];
    if (next == 'x') {
      unsigned value = 0;
      std::from_chars(text.data() + i + 1, text.data() + i + 3, value, 16);
      out += static_cast<char>(value);
      i += 2;
    } else {
      out += next == 'n' ? '\n' : next == 'r' ? '\r' : next == 't' ? '\t' : next;
    }
  }
  return out;
}

/// From the '[' of a section to the next one.
struct Range {
  std::size_t begin, end;
};
std::optional<Range> section(std::string_view text, std::string_view name) {
  const auto head = fmt::format("\n[{}]\n", name);
  const auto at = text.find(head);
  if (at == std::string_view::npos) return std::nullopt;
  const auto next = text.find("\n[", at + head.size() - 1);
  return Range{at + 1, next == std::string_view::npos ? text.size() : next + 1};
}

/// The line of a key in a section, with its line end.
std::optional<Range> line_of(std::string_view text, Range in, std::string_view key) {
  for (auto begin = in.begin; begin < in.end;) {
    auto end = text.find('\n', begin);
    end = end == std::string_view::npos ? in.end : end + 1;
    const auto line = text.substr(begin, end - begin);
    if (same_word(line.substr(0, line.find('=')), key)) return Range{begin, end};
    begin = end;
  }
  return std::nullopt;
}

void set(std::string& text, std::string_view name, std::string_view key, std::string_view value) {
  const auto in = section(text, name);
  if (!in) nothing_to_change(name);
  const auto entry = fmt::format("{}={}\n", key, value);
  if (const auto line = line_of(text, *in, key)) {
    text.replace(line->begin, line->end - line->begin, entry);
  } else {
    text.insert(text.find('\n', in->begin) + 1, entry);
  }
}

void remove_key(std::string& text, std::string_view name, std::string_view key) {
  const auto in = section(text, name);
  const auto line = in ? line_of(text, *in, key) : std::nullopt;
  if (!line) nothing_to_change(key);
  text.erase(line->begin, line->end - line->begin);
}

bool remove_section(std::string& text, std::string_view name) {
  const auto in = section(text, name);
  if (in) text.erase(in->begin, in->end - in->begin);
  return in.has_value();
}

constexpr std::string_view lists[] = {"MandatoryObjects", "OptionalObjects", "ManufacturerObjects"};

/// The indices of a list, as they are written.
std::vector<std::string> listed(std::string_view text, std::string_view list) {
  std::vector<std::string> out;
  const auto in = section(text, list);
  if (!in) return out;
  for (const auto line : split(text.substr(in->begin, in->end - in->begin), '\n')) {
    if (const auto equals = line.find("=0x"); equals != std::string_view::npos)
      out.emplace_back(line.substr(equals + 1));
  }
  return out;
}

void write_list(std::string& text, std::string_view list, const std::vector<std::string>& indices) {
  const auto in = section(text, list);
  auto lines = fmt::format("[{}]\nSupportedObjects={}\n", list, indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) lines += fmt::format("{}={}\n", i + 1, indices[i]);
  text.replace(in->begin, in->end - in->begin, lines + "\n");
}

void remove_object(std::string& text, std::string_view index) {
  bool some = remove_section(text, index);
  for (unsigned sub = 0; sub <= 0xFF; ++sub)
    some = remove_section(text, fmt::format("{}sub{:X}", index, sub)) || some;
  if (!some) nothing_to_change(index);
  for (const auto list : lists) {
    auto indices = listed(text, list);
    if (std::erase(indices, fmt::format("0x{}", index)) > 0) write_list(text, list, indices);
  }
}

void add_object(std::string& text, std::string_view lines) {
  const auto index = lines.substr(1, 4);
  const auto list = lists[index[0] >= '2' && index[0] <= '5' ? 2 : 1];
  auto indices = listed(text, list);
  indices.push_back(fmt::format("0x{}", index));
  write_list(text, list, indices);
  text += fmt::format("\n{}\n", lines);
}

void replace(std::string& text, std::string_view edit) {
  auto arrow = edit.find("\" -> \"");
  const bool once = arrow != std::string_view::npos;
  if (!once) arrow = edit.find("\" => \"");
  const auto old = unescaped(edit.substr(1, arrow - 1));
  const auto now = unescaped(edit.substr(arrow + 6, edit.size() - arrow - 7));
  auto at = text.find(old);
  if (at == std::string::npos) nothing_to_change(edit);
  do {
    text.replace(at, old.size(), now);
    at = text.find(old, at + now.size());
  } while (!once && at != std::string::npos);
}

void apply(std::string& text, std::string_view edit) {
  if (edit == "=") return;
  const auto rest = unescaped(edit.substr(1));
  switch (edit.front()) {
    case '"': return replace(text, edit);
    case '+': text += rest + "\n"; return;
    case '*': return add_object(text, rest);
    case '/': return remove_object(text, rest);
    case '-':
      if (!remove_section(text, rest.substr(1, rest.size() - 2))) nothing_to_change(edit);
      return;
    default: break;
  }
  const auto bracket = edit.find("] ");
  const auto name = edit.substr(1, bracket - 1);
  const auto entry = edit.substr(bracket + 2);
  const auto equals = entry.find('=');
  if (equals == std::string_view::npos) return remove_key(text, name, entry.substr(1));
  set(text, name, entry.substr(0, equals), unescaped(entry.substr(equals + 1)));
}

}  // namespace

std::string edited(std::string text, std::string_view edits) {
  constexpr std::string_view joint = " && ";
  while (!edits.empty()) {
    const auto end = edits.find(joint);
    apply(text, edits.substr(0, end));
    edits = end == std::string_view::npos ? std::string_view() : edits.substr(end + joint.size());
  }
  return text;
}

}  // namespace conform::eds
