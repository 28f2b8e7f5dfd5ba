// SPDX-License-Identifier: Apache-2.0
#include "steps/outcome.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/nmt.hpp"
#include "steps/step.hpp"

namespace conform::steps {
namespace {

std::uint64_t width_mask(std::size_t bytes) {
  return bytes >= 8 ? ~std::uint64_t{0} : (std::uint64_t{1} << (8 * bytes)) - 1;
}

/// Of long data the beginning tells enough; reports and findings stay readable.
std::string data_words(const Bytes& data, std::optional<canopen::DataType> type) {
  constexpr std::size_t longest = 64, shown = 32;
  if (data.size() > longest)
    return hex_bytes(ByteView(data).first(shown)) + " ... (" + std::to_string(data.size()) + " bytes)";
  return type ? canopen::print(*type, data) : canopen::print_untyped(data);
}

/// A number fits the data when the data hold it, or its sign extension made by '~'.
bool equals(std::uint64_t wanted, const Bytes& data, std::uint64_t mask) {
  const auto width = width_mask(data.size());
  const auto above = wanted & ~width;
  if (above != 0 && above != ~width) return false;
  return ((load_le(data) ^ wanted) & width & mask) == 0;
}

/// A DOMAIN may be a window of fixed length: it is as long as before, whatever was written to its beginning.
bool holds(const Actual& actual, const Bytes& written) {
  if (actual.data == written) return true;
  return actual.type == canopen::DataType::domain && actual.unchanged_from &&
         actual.data.size() == actual.unchanged_from->size() && actual.data.size() > written.size() &&
         std::ranges::equal(ByteView(actual.data).first(written.size()), written);
}

Result<bool> meets(const Demand& demand, const Actual& actual, Scope& scope) {
  using Kind = Demand::Kind;
  switch (demand.kind) {
    case Kind::measured: {
      const auto found = actual.measured.find(demand.measure);
      return found != actual.measured.end() && found->second >= demand.least && found->second <= demand.most;
    }
    case Kind::bytes: return actual.data == demand.bytes;
    case Kind::visible_text:
      return std::ranges::all_of(
          actual.data, [](std::uint8_t byte) { return byte == 0 || (byte >= 0x20 && byte <= 0x7E); });
    case Kind::size: return demand.range.holds(actual.data.size(), scope);
    case Kind::declared_size: {
      // Strings and domains have no length of their own.
      const auto size = actual.type ? canopen::size_bytes(*actual.type) : std::nullopt;
      return !size || actual.data.size() == *size;
    }
    case Kind::range:
      if (actual.data.empty() || actual.data.size() > 8) return false;
      if (actual.type && canopen::is_signed(*actual.type)) {
        const auto width = width_mask(actual.data.size());
        const auto number = load_le(actual.data);
        const bool negative = (number & (width ^ (width >> 1U))) != 0;
        return demand.range.holds_signed(negative ? number | ~width : number, scope);
      }
      return demand.range.holds(load_le(actual.data), scope);
    case Kind::one_of:
      for (const auto& expression : demand.values) {
        auto wanted = expression.evaluate(scope);
        if (!wanted) return std::unexpected(wanted.error());
        if (wanted->number && actual.data.size() <= 8 &&
            equals(*wanted->number, actual.data, ~std::uint64_t{0}))
          return true;
      }
      return false;
    case Kind::value:
    case Kind::holds: break;
  }
  auto wanted = demand.value.evaluate(scope);
  if (!wanted) return std::unexpected(wanted.error());
  if (demand.kind == Kind::holds) {
    if (!wanted->bytes) return fail("'" + demand.value.text() + "' is not data");
    return holds(actual, *wanted->bytes);
  }
  std::uint64_t mask = ~std::uint64_t{0};
  if (!demand.mask.empty()) {
    auto value = demand.mask.number(scope);
    if (!value) return std::unexpected(value.error());
    mask = *value;
  } else if (wanted->bytes) {
    return *wanted->bytes == actual.data;
  } else if (wanted->word) {
    return std::ranges::equal(*wanted->word, actual.data, {}, {},
                              [](std::uint8_t byte) { return static_cast<char>(byte); });
  }
  if (!wanted->number) return fail("'" + demand.value.text() + "' is not a number");
  return !actual.data.empty() && actual.data.size() <= 8 && equals(*wanted->number, actual.data, mask);
}

std::string value_words(const Expression& expression, Scope& scope, std::optional<canopen::DataType> type) {
  auto value = expression.evaluate(scope);
  if (!value) return expression.text();
  if (type && canopen::is_integer(*type) && value->number) {
    const auto size = canopen::size_bytes(*type).value_or(8);
    return canopen::print(*type, to_le(*value->number, size));
  }
  return value->text();
}

std::string demand_words(const Demand& demand, Scope& scope, std::optional<canopen::DataType> type) {
  using Kind = Demand::Kind;
  switch (demand.kind) {
    case Kind::value: {
      auto text = "value " + value_words(demand.value, scope, type);
      if (!demand.mask.empty()) text += " in the bits " + value_words(demand.mask, scope, type);
      return text;
    }
    case Kind::holds:
      return value_words(demand.value, scope, type) + " (a DOMAIN of fixed length: at its beginning)";
    case Kind::one_of: {
      std::vector<std::string> parts;
      for (const auto& expression : demand.values) parts.push_back(value_words(expression, scope, type));
      return "one of " + join(parts, ", ");
    }
    default: return demand.text;
  }
}

std::optional<AbortCode> read_code(std::string_view text) {
  const auto number = parse_number(text);
  if (!number || *number > 0xFFFF'FFFFU) return std::nullopt;
  return AbortCode(static_cast<std::uint32_t>(*number));
}

bool parse_abort(std::string_view text, const yaml::Field& field, const NameCheck& names,
                 std::vector<Outcome>& out) {
  Outcome outcome;
  text = trim(text);
  if (text == "any") {
    outcome.kind = Outcome::Kind::abort_any;
    out.push_back(outcome);
    return true;
  }
  if (text == "defined") {
    outcome.kind = Outcome::Kind::abort_defined;
    out.push_back(outcome);
    return true;
  }
  outcome.kind = Outcome::Kind::abort_code;
  if (text.starts_with('$')) {
    auto code = Expression::parse(text);
    if (!code) {
      field.error(code.error().what, code.error().hint);
      return false;
    }
    report_unknown_names(code->names(), field, names);
    outcome.named_code = *code;
    out.push_back(outcome);
    return true;
  }
  const auto dots = text.find("..");
  const auto first = read_code(trim(text.substr(0, dots)));
  const auto last = dots == std::string_view::npos ? first : read_code(trim(text.substr(dots + 2)));
  if (!first || !last || *last < *first) {
    field.error("'" + std::string(text) + "' is not an abort code", "write 0609 0030h, or any");
    return false;
  }
  if (*first == *last && canopen::meaning(*first).empty()) {
    field.error("abort code " + to_string(*first) + " is reserved in CiA 301",
                "see the table of abort codes, 7.2.4.3.17");
    return false;
  }
  outcome.code = *first;
  outcome.last_code = *last;
  out.push_back(outcome);
  return true;
}

/// "9..11", "90 ms..110 ms", "10": bounds of a measurement, times in nanoseconds.
std::optional<std::pair<std::uint64_t, std::uint64_t>> read_bounds(const yaml::Field& field) {
  const auto text = field.text();
  if (!text) return std::nullopt;
  const auto read = [](std::string_view part) -> std::optional<std::uint64_t> {
    if (const auto number = parse_number(trim(part))) return number;
    if (const auto time = parse_duration(trim(part))) return static_cast<std::uint64_t>(time->count());
    return std::nullopt;
  };
  const auto dots = text->find("..");
  const auto low_text = trim(std::string_view(*text).substr(0, dots));
  const auto high_text =
      dots == std::string::npos ? low_text : trim(std::string_view(*text).substr(dots + 2));
  const auto low = low_text.empty() ? std::optional<std::uint64_t>(0) : read(low_text);
  const auto high = high_text.empty() ? std::optional<std::uint64_t>(~std::uint64_t{0}) : read(high_text);
  if (!low || !high || *low > *high) {
    field.error("'" + *text + "' is not a range", "write 9..11, 90 ms..110 ms or 10");
    return std::nullopt;
  }
  return std::pair(*low, *high);
}

constexpr std::string_view measures[] = {
    "count",         "period",        "shortest",   "longest",   "first",      "register",      "latency",
    "segments",      "wrong_toggles", "difference", "unmarked",  "empty_last", "bits",          "absent",
    "longer",        "shorter",       "announced",  "size_open", "sub_blocks", "retransmitted", "acks",
    "first_ackseq",  "blksize",       "crc_agreed", "crc_ok",    "crc",        "unused",        "switched",
    "wrong_numbers", "timeouts",      "surplus",    "answers",   "missed",     "skipped",       "extra",
    "closest",       "farthest"};

/// A misspelt key is a misspelt outcome: the author knows no other word for it.
void check_keys(const yaml::Field& field) {
  if (field.node()->entries().empty())
    field.error("an empty outcome", "write {value: 02h}, {range: 1..240}, {abort: 0609 0030h}, ...");
  const auto known = outcome_keys();
  for (const auto& entry : field.node()->entries()) {
    if (entry.key.faulty() || std::ranges::find(known, entry.key.text()) != known.end()) continue;
    const auto near = did_you_mean(entry.key.text(), known);
    std::string hint = "known here: " + join(std::vector<std::string>(known.begin(), known.end()), ", ");
    if (!near.empty()) {
      hint = "did you mean '" + std::string(near) + "'?";
    } else if (field.node()->flow() && entry.value.is_null()) {
      hint = "a comma ends an entry of { }: write several values as [a, b], or quote the text";
    }
    yaml::Field(&entry.key, field.diagnostics(), "outcome")
        .error("unknown outcome '" + entry.key.text() + "'", std::move(hint));
  }
}

void parse_mapping(const yaml::Field& field, const NameCheck& names, std::vector<Outcome>& out) {
  check_keys(field);
  auto fields = field.fields("outcome");
  fields.allow_others();
  if (const auto abort = fields.optional("abort")) {
    for (const auto& item : abort.items_or_one()) {
      if (const auto text = item.text()) parse_abort(*text, item, names, out);
    }
  }
  Outcome outcome;
  outcome.kind = Outcome::Kind::data;
  const auto add = [&](Demand demand, std::string text) {
    demand.text = std::move(text);
    outcome.demands.push_back(std::move(demand));
  };
  const auto mask = fields.optional("mask");
  if (const auto value = fields.optional("value")) {
    Demand demand;
    if (auto expression = parse_expression_at(value, names)) demand.value = *expression;
    if (mask) {
      if (auto expression = parse_expression_at(mask, names)) demand.mask = *expression;
    }
    if (!demand.value.empty()) add(demand, "");
  } else if (mask) {
    mask.error("'mask' needs 'value' beside it");
  }
  if (const auto held = fields.optional("holds")) {
    Demand demand;
    demand.kind = Demand::Kind::holds;
    if (auto expression = parse_expression_at(held, names)) demand.value = *expression;
    if (!demand.value.empty()) add(demand, "");
  }
  if (const auto one_of = fields.optional("one_of")) {
    Demand demand;
    demand.kind = Demand::Kind::one_of;
    for (const auto& item : one_of.items()) {
      if (auto expression = parse_expression_at(item, names)) demand.values.push_back(*expression);
    }
    add(demand, "");
  }
  if (const auto range = fields.optional("range")) {
    if (const auto text = range.text()) {
      auto parsed = Range::parse(*text);
      if (!parsed) {
        range.error(parsed.error().what, parsed.error().hint);
      } else {
        report_unknown_names(parsed->low.names(), range, names);
        report_unknown_names(parsed->high.names(), range, names);
        Demand demand;
        demand.kind = Demand::Kind::range;
        demand.range = *parsed;
        add(demand, "value " + *text);
      }
    }
  }
  if (const auto size = fields.optional("size")) {
    if (const auto text = size.text(); text == "declared") {
      Demand demand;
      demand.kind = Demand::Kind::declared_size;
      add(demand, "the declared length");
    } else if (text) {
      auto parsed = Range::parse(text->find("..") == std::string::npos ? *text + ".." + *text : *text);
      if (!parsed) {
        size.error(parsed.error().what, "write 4, 1.. or declared");
      } else {
        Demand demand;
        demand.kind = Demand::Kind::size;
        demand.range = *parsed;
        add(demand, *text == "1" ? "1 byte" : *text + " bytes");
      }
    }
  }
  if (const auto bytes = fields.optional("bytes")) {
    if (const auto data = bytes.bytes()) {
      Demand demand;
      demand.kind = Demand::Kind::bytes;
      demand.bytes = *data;
      add(demand, "bytes " + hex_bytes(*data));
    }
  }
  if (const auto text = fields.optional("text")) {
    if (text.one_of({"visible"})) {
      Demand demand;
      demand.kind = Demand::Kind::visible_text;
      add(demand, "visible characters (20h-7Eh, 00h)");
    }
  }
  for (const auto name : measures) {
    const auto measure = fields.optional(name);
    if (!measure) continue;
    if (const auto bounds = read_bounds(measure)) {
      Demand demand;
      demand.kind = Demand::Kind::measured;
      demand.measure = name;
      demand.least = bounds->first;
      demand.most = bounds->second;
      add(demand, std::string(name) + " " + measure.text().value_or(""));
    }
  }
  if (const auto state = fields.optional("state")) {
    if (const auto word = state.text()) {
      const auto code = canopen::parse_nmt_state(*word);
      if (!code) {
        state.error("unknown NMT state '" + *word + "'", "pre-operational, operational, stopped or boot-up");
      } else {
        Demand demand;
        demand.kind = Demand::Kind::measured;
        demand.measure = "state";
        demand.least = demand.most = static_cast<std::uint64_t>(*code);
        add(demand, "state " + *word);
      }
    }
  }
  if (!outcome.demands.empty()) out.push_back(std::move(outcome));
}

}  // namespace

std::string Actual::words() const {
  switch (kind) {
    case Kind::confirmed:
      if (!has_data) return detail.empty() ? "confirmed" : detail;
      return data_words(data, type) + (detail.empty() ? "" : " (" + detail + ")");
    case Kind::aborted: return "abort " + canopen::describe(code);
    case Kind::silence: return detail.empty() ? "no answer" : detail;
    case Kind::violation: return "protocol violation: " + detail;
    case Kind::matched: return detail.empty() ? "as expected" : detail;
    case Kind::mismatched: return detail;
  }
  return {};
}

Result<bool> Outcome::matches(const Actual& actual, Scope& scope) const {
  using ActualKind = Actual::Kind;
  switch (kind) {
    case Kind::ok: return actual.kind == ActualKind::confirmed || actual.kind == ActualKind::matched;
    case Kind::abort_any: return actual.kind == ActualKind::aborted;
    case Kind::abort_defined:
      return actual.kind == ActualKind::aborted && !canopen::meaning(actual.code).empty();
    case Kind::abort_code: {
      if (actual.kind != ActualKind::aborted) return false;
      if (named_code.empty()) return actual.code >= code && actual.code <= last_code;
      const auto wanted = named_code.number(scope);
      if (!wanted) return std::unexpected(wanted.error());
      return actual.code.value() == *wanted;
    }
    case Kind::silence: return actual.kind == ActualKind::silence;
    case Kind::unchanged:
      if (actual.kind != ActualKind::confirmed) return false;
      if (!actual.unchanged_from)
        return fail("'unchanged' has nothing to compare with: no value was noted before");
      return actual.data == *actual.unchanged_from;
    case Kind::data: break;
  }
  if (actual.kind != ActualKind::confirmed && actual.kind != ActualKind::matched) return false;
  for (const auto& demand : demands) {
    auto met = meets(demand, actual, scope);
    if (!met || !*met) return met;
  }
  return true;
}

std::string Outcome::words(Scope& scope, std::optional<canopen::DataType> type) const {
  switch (kind) {
    case Kind::ok: return "success";
    case Kind::abort_any: return "any abort";
    case Kind::abort_defined: return "an abort code that CiA 301 defines";
    case Kind::silence: return "no answer";
    case Kind::unchanged: return "the value it had before";
    case Kind::abort_code:
      if (!named_code.empty()) {
        const auto wanted = named_code.number(scope);
        return "abort " + (wanted ? canopen::describe(AbortCode(static_cast<std::uint32_t>(*wanted)))
                                  : named_code.text());
      }
      if (code == last_code) return "abort " + canopen::describe(code);
      return "abort " + to_string(code) + " to " + to_string(last_code);
    case Kind::data: break;
  }
  std::vector<std::string> parts;
  for (const auto& demand : demands) parts.push_back(demand_words(demand, scope, type));
  return join(parts, ", ");
}

void check_measures(const yaml::Field& field, std::string_view verb, const Measures& measured) {
  const auto is_measure = [](std::string_view key) {
    return key == "state" || std::ranges::find(measures, key) != std::end(measures);
  };
  const auto check = [&](const yaml::Node& node) {
    if (!node.is_mapping()) return;
    for (const auto& entry : node.entries()) {
      const auto& key = entry.key.text();
      if (!is_measure(key) || std::ranges::find(measured, key) != measured.end()) continue;
      field.diagnostics().error(
          entry.key, "'" + key + "' is not measured by this '" + std::string(verb) + "'",
          measured.empty()
              ? "it measures nothing"
              : "measured here: " + join(std::vector<std::string>(measured.begin(), measured.end()), ", "));
    }
  };
  check(*field.node());
  if (!field.node()->is_sequence()) return;
  for (const auto& item : field.node()->items()) check(item);
}

std::vector<std::string_view> outcome_keys() {
  std::vector<std::string_view> out = {"abort", "value", "holds", "mask", "one_of",
                                       "range", "size",  "bytes", "text", "state"};
  out.insert(out.end(), std::begin(measures), std::end(measures));
  return out;
}

std::vector<Outcome> parse_outcomes(const yaml::Field& field, const NameCheck& names) {
  std::vector<Outcome> out;
  if (field.node()->is_sequence() && field.node()->items().empty()) field.error("an empty list of outcomes");
  for (const auto& item : field.items_or_one()) {
    if (item.node()->is_mapping()) {
      parse_mapping(item, names, out);
      continue;
    }
    const auto text = item.text();
    if (!text) continue;
    Outcome outcome;
    if (*text == "ok") {
      out.push_back(outcome);
    } else if (*text == "silence") {
      outcome.kind = Outcome::Kind::silence;
      out.push_back(outcome);
    } else if (*text == "unchanged") {
      outcome.kind = Outcome::Kind::unchanged;
      out.push_back(outcome);
    } else if (*text == "abort") {
      item.error("'abort' needs a code", "write abort 0609 0030h, or abort any");
    } else if (text->starts_with("abort ")) {
      parse_abort(std::string_view(*text).substr(6), item, names, out);
    } else {
      const auto first = text->substr(0, text->find(' '));
      static constexpr std::string_view known[] = {"ok",    "abort", "silence", "unchanged",
                                                   "value", "range", "size",    "bytes"};
      const auto near = did_you_mean(first, known);
      item.error("unknown outcome '" + *text + "'",
                 near.empty() ? "write ok, abort 0609 0030h, abort any, silence, unchanged or {value: ...}"
                              : "did you mean '" + std::string(near) + "'?");
    }
  }
  return out;
}

std::vector<std::string> Expectation::pass_words(Scope& scope, std::optional<canopen::DataType> type) const {
  std::vector<std::string> out;
  for (const auto& outcome : pass) out.push_back(outcome.words(scope, type));
  return out;
}

std::vector<std::string> Expectation::warn_words(Scope& scope, std::optional<canopen::DataType> type) const {
  std::vector<std::string> out;
  for (const auto& outcome : warn) out.push_back(outcome.words(scope, type));
  return out;
}

bool is_binding(std::string_view level) { return level != "recommended" && level != "optional"; }

Grade tolerated(std::string_view level, bool strict) {
  using result::Verdict;
  if (strict && !is_binding(level))
    return {Verdict::fail,
            "not what the rule, whose level is '" + std::string(level) + "', asks for (strict)"};
  return {Verdict::warn, "tolerated, but not what the standard names"};
}

Result<Grade> grade(const Expectation& expectation, const Actual& actual, std::string_view level, bool strict,
                    Scope& scope) {
  using result::Verdict;
  const auto in = [&](const std::vector<Outcome>& set) -> Result<bool> {
    for (const auto& outcome : set) {
      auto hit = outcome.matches(actual, scope);
      if (!hit || *hit) return hit;
    }
    return false;
  };
  // "Anything but": with no pass expected, success must not take in what is ruled out.
  if (expectation.pass.empty()) {
    auto ruled_out = in(expectation.fail);
    if (!ruled_out) return std::unexpected(ruled_out.error());
    if (*ruled_out) return Grade{Verdict::fail, "an outcome that is ruled out"};
  }
  static const std::vector<Outcome> success{Outcome{}};
  const auto& pass = expectation.pass.empty() ? success : expectation.pass;
  auto hit = in(pass);
  if (!hit) return std::unexpected(hit.error());
  if (*hit) {
    if (!actual.tolerated.empty()) return Grade{Verdict::warn, join(actual.tolerated, "; ")};
    return Grade{};
  }
  hit = in(expectation.warn);
  if (!hit) return std::unexpected(hit.error());
  if (*hit) return tolerated(level, strict);
  hit = in(expectation.fail);
  if (!hit) return std::unexpected(hit.error());
  if (*hit) return Grade{Verdict::fail, "an outcome that is ruled out"};
  if (!is_binding(level) && !strict) {
    return Grade{Verdict::warn,
                 "not an expected outcome of a rule whose level is '" + std::string(level) + "'"};
  }
  return Grade{Verdict::fail, "not an outcome that the rule accepts"};
}

}  // namespace conform::steps
