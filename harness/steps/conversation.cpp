// SPDX-License-Identifier: Apache-2.0
#include "steps/conversation.hpp"

#include <algorithm>
#include <cctype>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"

namespace conform::steps {
namespace {

using Kind = BytePattern::Kind;

class LineParser {
 public:
  LineParser(std::string_view text, int number, std::vector<Problem>& problems)
      : text_(text), number_(number), problems_(problems) {}

  std::optional<Line> parse() {
    Line line;
    line.number = number_;
    line.text = trim(text_);
    skip_blanks();
    if (accept(">")) {
      line.kind = Line::Kind::send;
    } else if (accept("<")) {
      line.kind = Line::Kind::receive;
    } else if (accept("silence")) {
      line.kind = Line::Kind::silence;
      if (!parse_id(line)) return std::nullopt;
      skip_blanks();
      if (!accept("for")) return problem("'for' and a time are missing", "silence 580+N for T_QUIET");
      return parse_time(line) ? std::optional(line) : std::nullopt;
    } else {
      return problem("a line begins with '>', '<' or 'silence'", "");
    }
    if (!parse_id(line)) return std::nullopt;
    skip_blanks();
    if (!accept(":")) return problem("':' is missing behind the CAN-ID", "> 600+N: 40 00 10 00 00 00 00 00");
    if (!parse_bytes(line)) return std::nullopt;
    std::size_t bytes = 0;
    for (const auto& pattern : line.bytes) bytes += pattern.width().value_or(0);
    if (bytes > 8) return problem("more than eight bytes in a CAN frame", "");
    return line;
  }

 private:
  std::nullopt_t problem(std::string what, std::string hint, std::size_t at = std::string_view::npos,
                         std::size_t length = 1) {
    if (at == std::string_view::npos) at = at_;
    at = std::min(at, text_.size());
    // Editors count characters, not bytes.
    problems_.push_back({number_, code_points(text_.substr(0, at)),
                         std::max(code_points(text_.substr(at, length)), 1), std::move(what),
                         std::move(hint)});
    return std::nullopt;
  }
  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  bool accept(std::string_view word) {
    if (!text_.substr(at_).starts_with(word)) return false;
    at_ += word.size();
    return true;
  }
  std::string_view word() {
    skip_blanks();
    const auto begin = at_;
    while (at_ < text_.size() && text_[at_] != ' ' && text_[at_] != '\t' && text_[at_] != ':') ++at_;
    return text_.substr(begin, at_ - begin);
  }

  bool parse_id(Line& line) {
    skip_blanks();
    const auto begin = at_;
    const auto id = word();
    for (const auto part : split(id, '+')) {
      if (part == "N") {
        line.add_node = true;
      } else if (const auto number = parse_number(
                     "0x" + std::string(part.ends_with('h') ? part.substr(0, part.size() - 1) : part));
                 number && *number <= 0x1FFF'FFFFU) {
        line.id += static_cast<std::uint32_t>(*number);
      } else {
        problem("'" + std::string(id) + "' is not a CAN-ID", "hexadecimal: 600+N, 80+N, 7E5", begin,
                std::max<std::size_t>(id.size(), 1));
        return false;
      }
    }
    if (line.id > 0x1FFF'FFFFU) {
      problem("'" + std::string(id) + "' is beyond 29 bits", "", begin, id.size());
      return false;
    }
    return true;
  }

  bool parse_time(Line& line) {
    skip_blanks();
    const auto begin = at_;
    const auto rest = trim(text_.substr(at_));
    at_ = text_.size();
    const auto time = TimeReference::parse(rest);
    if (!time) {
      problem(time.error().what, time.error().hint, begin, std::max<std::size_t>(rest.size(), 1));
      return false;
    }
    line.time = *time;
    return true;
  }

  bool parse_bytes(Line& line) {
    while (true) {
      skip_blanks();
      if (at_ >= text_.size()) return true;
      const auto begin = at_;
      if (!line.bytes.empty() && line.bytes.back().kind == Kind::rest && text_[at_] != 'w' &&
          text_[at_] != 'R') {
        problem("'..' must be the last of the bytes", "", begin);
        return false;
      }
      if (text_[at_] == '{') {
        const auto close = text_.find('}', at_);
        if (close == std::string_view::npos) {
          problem("'}' is missing", "", begin);
          return false;
        }
        const auto inside = trim(text_.substr(at_ + 1, close - at_ - 1));
        at_ = close + 1;
        auto pattern = parse_braces(inside, begin, close - begin + 1);
        if (!pattern) return false;
        pattern->column = code_points(text_.substr(0, begin));
        pattern->length = code_points(text_.substr(begin, at_ - begin));
        line.bytes.push_back(*pattern);
        continue;
      }
      const auto token = word();
      if (token == "within") return parse_time(line);
      if (token == "RTR") {
        line.remote = true;
      } else if (token == "EXT") {
        line.extended = true;
      } else if (token.starts_with("DLC")) {
        const auto dlc = parse_number(token.substr(3));
        if (!dlc || *dlc > 15) {
          problem("DLC needs a number from 0 to 15", "DLC3", begin, token.size());
          return false;
        }
        line.dlc = static_cast<std::uint8_t>(*dlc);
      } else if (!parse_plain(token, line)) {
        problem("'" + std::string(token) + "' is not a byte", "two hex digits, xx, zz, N, {m}, {name:4}, ..",
                begin, std::max<std::size_t>(token.size(), 1));
        return false;
      }
    }
  }

  static bool parse_plain(std::string_view token, Line& line) {
    BytePattern pattern;
    if (token == "..") {
      pattern.kind = Kind::rest;
    } else if (token == "N") {
      pattern.kind = Kind::node;
    } else if (token == "xx") {
      pattern.kind = Kind::any;
    } else if (token == "zz") {
      pattern.kind = Kind::reserved;
    } else if (token.size() == 2) {
      for (const char c : token) {
        pattern.value = static_cast<std::uint8_t>(pattern.value << 4U);
        pattern.mask = static_cast<std::uint8_t>(pattern.mask << 4U);
        if (c == 'x') continue;
        const auto digit = std::string_view("0123456789ABCDEF").find(static_cast<char>(std::toupper(c)));
        if (digit == std::string_view::npos) return false;
        pattern.value = static_cast<std::uint8_t>(pattern.value | digit);
        pattern.mask = static_cast<std::uint8_t>(pattern.mask | 0x0FU);
      }
    } else {
      return false;
    }
    line.bytes.push_back(pattern);
    return true;
  }

  std::optional<BytePattern> parse_braces(std::string_view inside, std::size_t begin, std::size_t length) {
    BytePattern pattern;
    if (inside == "m") {
      pattern.kind = Kind::multiplexer;
      return pattern;
    }
    if (inside.starts_with("abort")) {
      pattern.kind = Kind::abort;
      auto rest = trim(inside.substr(5));
      if (rest.starts_with(':')) rest = trim(rest.substr(1));
      auto* codes = &pattern.passes;
      for (auto group : split(rest, ';')) {
        group = trim(group);
        if (group.starts_with("warn ")) {
          codes = &pattern.warns;
          group = trim(group.substr(5));
        } else if (group.starts_with("fail ")) {
          codes = &pattern.fails;
          group = trim(group.substr(5));
        }
        for (const auto part : split(group, ',')) {
          if (codes == &pattern.warns && trim(part) == "any") {
            pattern.warns_any = true;
            continue;
          }
          const auto code = parse_number(trim(part));
          if (!code || *code > 0xFFFF'FFFFU) {
            return problem("'" + std::string(trim(part)) + "' is not an abort code",
                           "{abort: 0503 0000h; warn 0504 0001h}, {abort: 0504 0001h; warn any}", begin,
                           length);
          }
          codes->push_back(AbortCode(static_cast<std::uint32_t>(*code)));
        }
      }
      return pattern;
    }
    pattern.kind = Kind::name;
    const auto colon = inside.find(':');
    const auto at = inside.find('@');
    pattern.name = trim(inside.substr(0, std::min(colon, at)));
    if (pattern.name.empty()) return problem("a name is missing in braces", "{size:4}", begin, length);
    if (at != std::string_view::npos) {
      const auto from =
          parse_number(trim(inside.substr(at + 1, colon == std::string_view::npos ? colon : colon - at - 1)));
      if (!from) return problem("a number is missing behind '@'", "{data@7:7}", begin, length);
      pattern.from = *from;
      pattern.slice = true;
    }
    if (colon != std::string_view::npos) {
      const auto size = parse_number(trim(inside.substr(colon + 1)));
      if (!size || *size == 0 || *size > 8)
        return problem("a number of bytes from 1 to 8 is missing behind ':'", "{size:4}", begin, length);
      pattern.size = *size;
    }
    return pattern;
  }

  std::string_view text_;
  int number_;
  std::vector<Problem>& problems_;
  std::size_t at_ = 0;
};

Bytes multiplexer_bytes(Multiplexer object) {
  return {static_cast<std::uint8_t>(object.index.value() & 0xFFU),
          static_cast<std::uint8_t>(object.index.value() >> 8U), object.sub.value()};
}

Result<Bytes> named_bytes(const BytePattern& pattern, const Scope& scope) {
  const auto* value = scope.find(pattern.name);
  if (value == nullptr) return fail_scenario("{" + pattern.name + "} has no value here");
  Bytes all;
  if (value->bytes) {
    all = *value->bytes;
  } else if (value->number) {
    all =
        to_le(*value->number, pattern.size != 0 ? std::min<std::size_t>(pattern.from + pattern.size, 8) : 4);
  } else {
    return fail_scenario("{" + pattern.name + "} is " + value->text() + ", not data");
  }
  const auto from = std::min(pattern.from, all.size());
  const auto size = pattern.size == 0 ? all.size() - from : std::min(pattern.size, all.size() - from);
  return Bytes(all.begin() + static_cast<std::ptrdiff_t>(from),
               all.begin() + static_cast<std::ptrdiff_t>(from + size));
}

}  // namespace

std::optional<std::size_t> BytePattern::width() const {
  switch (kind) {
    case Kind::multiplexer: return 3;
    case Kind::abort: return 4;
    case Kind::name: return size == 0 ? std::nullopt : std::optional(size);
    case Kind::rest: return std::nullopt;
    default: return 1;
  }
}

std::vector<Line> parse_conversation(std::string_view text, std::vector<Problem>& problems) {
  std::vector<Line> out;
  int number = 0;
  for (auto line : split(text, '\n')) {
    line = line.substr(0, line.find('#'));
    if (!trim(line).empty()) {
      if (auto parsed = LineParser(line, number, problems).parse()) out.push_back(std::move(*parsed));
    }
    ++number;
  }
  return out;
}

Result<can::Frame> build_frame(const Line& line, Scope& scope, std::optional<Multiplexer> object) {
  Bytes bytes;
  for (const auto& pattern : line.bytes) {
    switch (pattern.kind) {
      case Kind::exact: bytes.push_back(pattern.value); break;
      case Kind::node: bytes.push_back(scope.node().value()); break;
      case Kind::any:
      case Kind::reserved: bytes.push_back(0); break;
      case Kind::multiplexer: {
        if (!object)
          return fail_scenario("{m} needs the object of the conversation",
                               "write talk: {object: 1008h:00, frames: ...}");
        const auto mux = multiplexer_bytes(*object);
        bytes.insert(bytes.end(), mux.begin(), mux.end());
        break;
      }
      case Kind::name: {
        auto named = named_bytes(pattern, scope);
        if (!named) return std::unexpected(named.error());
        bytes.insert(bytes.end(), named->begin(), named->end());
        break;
      }
      case Kind::abort: {
        const auto code = to_le(pattern.passes.empty() ? 0 : pattern.passes.front().value(), 4);
        bytes.insert(bytes.end(), code.begin(), code.end());
        break;
      }
      case Kind::rest:
        while (bytes.size() < 8) bytes.push_back(0);
        break;
    }
  }
  if (bytes.size() > 8) return fail_scenario("more than eight bytes in '" + line.text + "'");
  auto frame = can::data_frame(line.can_id(scope.node()), bytes);
  frame.remote = line.remote;
  frame.extended = line.extended;
  if (line.dlc) frame.dlc = *line.dlc;
  return frame;
}

Comparison compare(const Line& line, const can::Frame& frame, Scope& scope,
                   std::optional<Multiplexer> object) {
  Comparison out;
  const auto bytes = frame.bytes();
  std::size_t at = 0;
  const auto wrong = [&](std::size_t index, std::string reason) {
    out.first_wrong = index;
    out.reason = std::move(reason);
    return out;
  };
  if (frame.remote != line.remote) {
    return wrong(0, line.remote ? "a data frame where a remote frame is due" : "a remote frame");
  }
  if (frame.extended != line.extended) {
    return wrong(0, line.extended ? "the identifier has 11 bits instead of 29"
                                  : "the identifier has 29 bits instead of 11");
  }
  for (const auto& pattern : line.bytes) {
    if (pattern.kind == Kind::rest) return out.equal = true, out;
    const auto width = pattern.width().value_or(bytes.size() - std::min(at, bytes.size()));
    if (at + width > bytes.size()) {
      return wrong(bytes.size(), "the frame ends after " + std::to_string(bytes.size()) + " bytes");
    }
    const auto part = bytes.subspan(at, width);
    switch (pattern.kind) {
      case Kind::exact:
        if ((part[0] & pattern.mask) != pattern.value) {
          return wrong(at, "byte " + std::to_string(at) + " is " + hex(part[0], 2));
        }
        break;
      case Kind::node:
        if (part[0] != scope.node().value())
          return wrong(at, "byte " + std::to_string(at) + " is not the node-ID");
        break;
      case Kind::reserved:
        if (part[0] != 0) {
          out.tolerated.push_back("reserved byte " + std::to_string(at) + " is " + hex(part[0], 2) +
                                  " instead of 00h");
        }
        break;
      case Kind::multiplexer: {
        if (!object) return wrong(at, "the conversation has no object");
        const auto mux = multiplexer_bytes(*object);
        if (!std::ranges::equal(part, mux))
          return wrong(at, "the multiplexer is not that of " + to_string(*object));
        break;
      }
      case Kind::abort: {
        const AbortCode code(static_cast<std::uint32_t>(load_le(part)));
        if (std::ranges::find(pattern.passes, code) != pattern.passes.end()) break;
        const bool tolerated =
            pattern.warns_any || std::ranges::find(pattern.warns, code) != pattern.warns.end();
        if (!tolerated || std::ranges::find(pattern.fails, code) != pattern.fails.end()) {
          return wrong(at, "the abort code is " + canopen::describe(code));
        }
        out.tolerated.push_back("abort code " + canopen::describe(code) + " is tolerated only");
        break;
      }
      case Kind::name: {
        if (scope.find(pattern.name) != nullptr) {
          const auto known = named_bytes(pattern, scope);
          // A slice that reaches beyond the data: of the last segment only so many bytes are used.
          const bool ends_early = known && pattern.slice && !known->empty() && known->size() < part.size();
          if (!known || !std::ranges::equal(ends_early ? part.first(known->size()) : part, *known))
            return wrong(at, "{" + pattern.name + "} differs from before");
          break;  // a part of known data must not become the whole of it
        }
        out.names.emplace_back(pattern.name, Bytes(part.begin(), part.end()));
        break;
      }
      default: break;
    }
    at += width;
  }
  if (at < bytes.size())
    return wrong(at,
                 "the frame has " + std::to_string(bytes.size()) + " bytes instead of " + std::to_string(at));
  out.equal = true;
  return out;
}

}  // namespace conform::steps
