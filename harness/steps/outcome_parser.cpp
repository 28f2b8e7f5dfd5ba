// SPDX-License-Identifier: Apache-2.0
// How an author writes what is expected: words ("ok", "abort 0609 0030h"), or a mapping of demands.
#include <algorithm>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/nmt.hpp"
#include "steps/outcome.hpp"
#include "steps/step.hpp"

namespace conform::steps {
namespace {

/// "4.." as "at least 4", "..150 ms" as "at most 150 ms"; a range with both ends as it is written.
std::string range_words(std::string_view text) {
  text = trim(text);
  if (text.ends_with("..")) return "at least " + std::string(trim(text.substr(0, text.size() - 2)));
  if (text.starts_with("..")) return "at most " + std::string(trim(text.substr(2)));
  return std::string(text);
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
    "count",         "period",        "shortest",   "longest",   "first",        "register",      "latency",
    "segments",      "wrong_toggles", "difference", "unmarked",  "empty_last",   "bits",          "absent",
    "longer",        "shorter",       "announced",  "size_open", "sub_blocks",   "retransmitted", "acks",
    "first_ackseq",  "blksize",       "crc_agreed", "crc_ok",    "crc",          "unused",        "switched",
    "wrong_numbers", "timeouts",      "surplus",    "answers",   "missed",       "skipped",       "extra",
    "closest",       "farthest",      "replies",    "toggle",    "wrong_length", "length",        "start",
    "out_of_order",  "malformed",     "drift",      "pace",      "quickest",     "slowest",       "stretch"};

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
  Expression bits;
  if (const auto mask = fields.optional("mask")) {
    if (auto expression = parse_expression_at(mask, names)) bits = *expression;
    if (!fields.optional("value") && !fields.optional("range"))
      mask.error("'mask' needs 'value' or 'range' beside it");
  }
  if (const auto value = fields.optional("value")) {
    Demand demand;
    if (auto expression = parse_expression_at(value, names)) demand.value = *expression;
    demand.mask = bits;
    if (!demand.value.empty()) add(demand, "");
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
        demand.mask = bits;
        add(demand, "value " + range_words(*text));
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
        add(demand, *text == "1" ? "1 byte" : range_words(*text) + " bytes");
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
      add(demand, std::string(name) + " " + range_words(measure.text().value_or("")));
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

}  // namespace conform::steps
