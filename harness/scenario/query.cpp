// SPDX-License-Identifier: Apache-2.0
#include "scenario/query.hpp"

#include <algorithm>
#include <optional>

#include "base/text.hpp"
#include "canopen/integer_range.hpp"

namespace conform::scenario {
namespace {

using Clause = std::function<bool(const device::Entry&)>;
using device::Entry;
using device::ObjectCode;

/// Whether the type holds a value beyond the limit, so that the limit can be broken at all.
bool limit_leaves_room(const Entry& entry, const std::optional<Bytes>& limit, bool upper) {
  const auto end = canopen::end_of_range(entry.type, upper);
  if (!end || !limit || limit->empty() || limit->size() > 8) return false;
  return *limit != to_le(*end, limit->size());
}

/// Whether no limit leaves out a value of the type: limits may be declared that are its ends, and one of them
/// alone may leave out much. Of what is no integer, nobody knows what a limit leaves out.
bool has_full_range(const Entry& entry) {
  if (!canopen::is_integer(entry.type)) return !entry.low && !entry.high;
  return !limit_leaves_room(entry, entry.high, true) && !limit_leaves_room(entry, entry.low, false);
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> out;
  for (const auto word : split(text, ' ')) {
    if (!word.empty()) out.push_back(word);
  }
  return out;
}

Result<Clause> parse_clause(std::vector<std::string_view> words) {
  if (words.empty()) return fail("a property is missing");
  if (words.front() == "not") {
    words.erase(words.begin());
    auto inner = parse_clause(words);
    if (!inner) return inner;
    return Clause([inner = *inner](const Entry& entry) { return !inner(entry); });
  }
  std::string all;
  for (const auto word : words) all += (all.empty() ? "" : " ") + std::string(word);
  if (words.front() == "access" && words.size() >= 2) {
    std::vector<device::Access> accesses;
    for (std::size_t i = 1; i < words.size(); ++i) {
      if (words[i] == "or") continue;
      const auto access = device::parse_access(words[i]);
      if (!access)
        return fail("unknown access '" + std::string(words[i]) + "'", {}, "ro, wo, rw, rwr, rww or const");
      accesses.push_back(*access);
    }
    return Clause([accesses](const Entry& entry) {
      return std::ranges::find(accesses, entry.access) != accesses.end();
    });
  }
  if (words.front() == "type" && words.size() == 2) {
    const auto type = canopen::parse_data_type(words[1]);
    if (!type) return fail("unknown data type '" + std::string(words[1]) + "'");
    return Clause([type = *type](const Entry& entry) { return entry.type == type; });
  }
  if (words.front() == "size" && words.size() == 2) {
    const auto range = parse_number_range(words[1]);
    if (!range) return fail("'size' needs a number of bytes or a range", {}, "size 4, size 2..8");
    return Clause([range = *range](const Entry& entry) {
      const auto size = entry.size();
      return size && range.holds(*size);
    });
  }
  if (words.front() == "index" && words.size() == 2) {
    const auto range = parse_number_range(words[1]);
    if (!range) return fail("'index' needs a range", {}, "index 2000h..5FFFh");
    return Clause([range = *range](const Entry& entry) { return range.holds(entry.mux.index.value()); });
  }
  struct Word {
    std::string_view word;
    Clause clause;
  };
  static const std::vector<Word> table = {
      {"readable", [](const Entry& e) { return e.readable(); }},
      {"writable", [](const Entry& e) { return e.writable(); }},
      {"low limit", [](const Entry& e) { return e.low.has_value(); }},
      {"high limit", [](const Entry& e) { return e.high.has_value(); }},
      {"limits", [](const Entry& e) { return e.low.has_value() || e.high.has_value(); }},
      {"full range", &has_full_range},
      {"high limit below type maximum", [](const Entry& e) { return limit_leaves_room(e, e.high, true); }},
      {"low limit above type minimum", [](const Entry& e) { return limit_leaves_room(e, e.low, false); }},
      {"default", [](const Entry& e) { return e.default_value.has_value(); }},
      {"declared default", [](const Entry& e) { return e.declared_default && e.default_value.has_value(); }},
      {"mappable", [](const Entry& e) { return e.pdo_mappable; }},
      {"domain", [](const Entry& e) { return e.type == canopen::DataType::domain; }},
      {"command", [](const Entry& e) { return e.command; }},
      {"claimed", [](const Entry& e) { return e.presence() != device::Presence::unclaimed; }},
      {"complex",
       [](const Entry& e) { return e.object == ObjectCode::array || e.object == ObjectCode::record; }},
      {"array", [](const Entry& e) { return e.object == ObjectCode::array; }},
      {"element",
       [](const Entry& e) {
         return (e.object == ObjectCode::array || e.object == ObjectCode::record) && e.mux.sub != SubIndex(0);
       }},
      {"integer", [](const Entry& e) { return canopen::is_integer(e.type); }},
      {"safe", [](const Entry& e) { return e.safe; }},
      {"open to writes", [](const Entry& e) { return e.open_to_writes; }},
      {"fixed size", [](const Entry& e) { return e.size().has_value(); }},
      {"changing", [](const Entry& e) { return e.may_change; }},
      {"wired", [](const Entry& e) { return e.wired_input.has_value(); }},
      {"clock", [](const Entry& e) { return e.clock; }},
      {"open access", [](const Entry& e) { return e.access_open; }},
  };
  const auto found = std::ranges::find(table, std::string_view(all), &Word::word);
  if (found != table.end()) return found->clause;
  std::vector<std::string_view> known;
  for (const auto& word : table) known.push_back(word.word);
  auto near = did_you_mean(all, known);
  static constexpr std::string_view with_value[] = {"access", "type", "size", "index", "holding"};
  if (near.empty()) near = did_you_mean(words.front(), with_value);
  return fail("unknown property '" + all + "'", {},
              near.empty() ? "" : "did you mean '" + std::string(near) + "'?");
}

/// "holding 15.. bytes", "holding 8 bytes"
Result<Query::Holding> parse_holding(const std::vector<std::string_view>& words) {
  const auto wrong = [] {
    return fail("'holding' needs a number or range of bytes", {}, "holding 15.. bytes, holding 8 bytes");
  };
  if (words.size() != 3 || words[2] != "bytes") return wrong();
  const auto range = parse_number_range(words[1]);
  if (!range) return wrong();
  return Query::Holding{range->low, range->high};
}

}  // namespace

Result<Query> Query::parse(std::string_view text) {
  // Every 'not' recurses: a bound on the text is a bound on the stack.
  if (text.size() > 1000)
    return fail("a query of " + std::to_string(text.size()) + " characters", {}, "write at most 1000");
  auto words = words_of(text);
  Query out;
  if (words.empty()) return fail("an empty query");
  const auto kind = words.front();
  out.kind_ = kind;
  const auto in_range = [&out](std::uint16_t low, std::uint16_t high) {
    out.whole_objects_ = true;
    out.clauses_.emplace_back([low, high](const Entry& entry) {
      return entry.mux.index.value() >= low && entry.mux.index.value() <= high;
    });
  };
  if (kind == "objects") {
    out.whole_objects_ = true;
  } else if (kind == "rpdos") {
    in_range(0x1400, 0x15FF);
  } else if (kind == "tpdos") {
    in_range(0x1800, 0x19FF);
  } else if (kind != "entries") {
    return fail("a query begins with entries, objects, rpdos or tpdos, not with '" + std::string(kind) + "'");
  }
  if (words.size() == 1) return out;
  if (words[1] != "with") return fail("'with' is due instead of '" + std::string(words[1]) + "'");
  std::vector<std::string_view> clause;
  for (std::size_t i = 2; i <= words.size(); ++i) {
    if (i < words.size() && words[i] != "and") {
      clause.push_back(words[i]);
      continue;
    }
    std::string words_text;
    for (const auto word : clause) words_text += (words_text.empty() ? "" : " ") + std::string(word);
    out.texts_.push_back(std::move(words_text));
    if (!clause.empty() && clause.front() == "holding") {
      auto holding = parse_holding(clause);
      if (!holding) return std::unexpected(holding.error());
      out.holding_ = *holding;
      clause.clear();
      continue;
    }
    auto parsed = parse_clause(clause);
    if (!parsed) return std::unexpected(parsed.error());
    out.clauses_.push_back(*parsed);
    clause.clear();
  }
  return out;
}

bool Query::says(std::string_view clause) const { return std::ranges::find(texts_, clause) != texts_.end(); }

std::string Query::words() const {
  std::string noun = kind_ == "rpdos"     ? "RPDO"
                     : kind_ == "tpdos"   ? "TPDO"
                     : kind_ == "objects" ? "object"
                     : holding_           ? "string or DOMAIN"
                                          : "entry";
  std::string length;
  std::vector<std::string> others;
  const bool safe = says("safe");
  // What every scenario asks for, and a user need not be told.
  static constexpr std::string_view usual[] = {"fixed size",  "not fixed size", "not changing",
                                               "not command", "safe",           "readable",
                                               "access rw",   "claimed",        "not command"};
  for (const auto& text : texts_) {
    if (text == "domain") {
      noun = "DOMAIN";
    } else if (text == "integer") {
      noun = "integer";
    } else if (text.starts_with("type ")) {
      noun = text.substr(5);
    } else if (text.starts_with("size ")) {
      length = " of " + text.substr(5) + " bytes";
    } else if (!text.starts_with("holding ") && std::ranges::find(usual, text) == std::end(usual)) {
      others.push_back(text);
    }
  }
  if (holding_) {
    const auto& [least, most] = *holding_;
    length = most == 0                   ? " without content"
             : most == ~std::uint64_t{0} ? " of " + std::to_string(least) + " bytes or more"
             : least == most             ? " of " + std::to_string(least) + " bytes"
                             : " of " + std::to_string(least) + " to " + std::to_string(most) + " bytes";
  }
  const char* adjective = safe ? "writable " : says("readable") ? "readable " : "";
  return adjective + noun + length + (others.empty() ? "" : " with " + join(others, " and "));
}

std::vector<Multiplexer> Query::select(const device::Dictionary& dictionary) const {
  std::vector<Multiplexer> out;
  for (const auto& entry : dictionary.entries()) {
    if (entry.not_to_be_read) continue;
    if (!std::ranges::all_of(clauses_, [&entry](const Clause& clause) { return clause(entry); })) continue;
    const auto mux = whole_objects_ ? Multiplexer{entry.mux.index, SubIndex(0)} : entry.mux;
    if (out.empty() || out.back() != mux) out.push_back(mux);
  }
  return out;
}

}  // namespace conform::scenario
