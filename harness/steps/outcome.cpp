// SPDX-License-Identifier: Apache-2.0
#include "steps/outcome.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
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

/// 00h is a visible character as well, and ends or fills the text of many a device; no description can say
/// so.
Bytes without_end(Bytes text) {
  while (!text.empty() && text.back() == 0) text.pop_back();
  return text;
}

/// Whether an entry holds what its description says of it.
bool as_described(const Actual& actual, const Bytes& described) {
  if (actual.type != canopen::DataType::visible_string) return actual.data == described;
  return without_end(actual.data) == without_end(described);
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
      if (!demand.mask.empty()) {
        auto mask = demand.mask.number(scope);
        if (!mask) return std::unexpected(mask.error());
        return demand.range.holds(load_le(actual.data) & *mask, scope);
      }
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
    return demand.value.is_declared() ? as_described(actual, *wanted->bytes) : *wanted->bytes == actual.data;
  } else if (wanted->word) {
    return std::ranges::equal(*wanted->word, actual.data, {}, {},
                              [](std::uint8_t byte) { return static_cast<char>(byte); });
  }
  if (!wanted->number) return fail("'" + demand.value.text() + "' is not a number");
  return !actual.data.empty() && actual.data.size() <= 8 && equals(*wanted->number, actual.data, mask);
}

/// "longest 700.185 ms instead of at most 150 ms": of several measurements those that miss what was expected.
/// Empty where nothing was measured.
std::string missed_words(const std::vector<Outcome>& expected, const Actual& actual) {
  if (expected.size() != 1) return {};
  constexpr std::array<std::string_view, 6> times{"period", "shortest", "longest",
                                                  "first",  "latency",  "drift"};
  std::vector<std::string> parts;
  for (const auto& demand : expected.front().demands) {
    const auto found = actual.measured.find(demand.measure);
    if (demand.kind != Demand::Kind::measured || found == actual.measured.end()) continue;
    const auto value = found->second;
    if (value >= demand.least && value <= demand.most) continue;
    const auto bounds = demand.text.substr(std::min(demand.text.size(), demand.measure.size() + 1));
    const bool is_time = std::ranges::find(times, demand.measure) != times.end();
    parts.push_back(demand.measure + " " +
                    (is_time ? to_string(std::chrono::round<std::chrono::microseconds>(
                                   Duration(static_cast<Duration::rep>(value))))
                             : std::to_string(value)) +
                    " instead of " + bounds);
  }
  return join(parts, ", ");
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
    case Kind::range:
      return demand.text +
             (demand.mask.empty() ? "" : " in the bits " + value_words(demand.mask, scope, type));
    default: return demand.text;
  }
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
  const auto missed = missed_words(expectation.pass, actual);
  if (!is_binding(level) && !strict) {
    return Grade{Verdict::warn, "not an expected outcome of a rule whose level is '" + std::string(level) +
                                    "'" + (missed.empty() ? "" : ": " + missed)};
  }
  return Grade{Verdict::fail, missed.empty() ? "not an outcome that the rule accepts" : missed};
}

}  // namespace conform::steps
