// SPDX-License-Identifier: Apache-2.0
// What can come (Actual), what an author can expect (Outcome), and the graded set of them (Expectation).
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"
#include "base/strong.hpp"
#include "canopen/data_type.hpp"
#include "result/listening.hpp"
#include "result/verdict.hpp"
#include "steps/expression.hpp"
#include "yaml/fields.hpp"

namespace conform::steps {

/// What a step saw.
struct Actual {
  enum class Kind : std::uint8_t {
    confirmed,   ///< an SDO transfer that went through; `data` holds what was uploaded
    aborted,     ///< an SDO abort with `code`
    silence,     ///< an answer or frame was due and none came
    violation,   ///< an answer that breaks the protocol, see `detail`
    matched,     ///< the frame(s) waited for came; a condition holds
    mismatched,  ///< something else came, see `detail`
  };
  Kind kind = Kind::matched;
  Bytes data;
  bool has_data = false;
  std::optional<canopen::DataType> type;  ///< to print `data` in the entry's own notation
  AbortCode code{};
  std::string detail;                   ///< precise words for violation and mismatched
  std::vector<std::string> tolerated;   ///< remarks that turn a pass into a warning
  std::optional<Bytes> unchanged_from;  ///< value the entry had before the step or scenario changed anything
  std::map<std::string, std::uint64_t, std::less<>> measured;  ///< count; periods in ns; state
  std::optional<std::size_t> decisive;                         ///< capture index
  /// When it waited for frames; behind the decisive one none came that it waited for.
  std::optional<result::Listening> listened;

  /// "abort 0609 0030h (invalid value)", "confirmed", "0000 0191h (4 bytes)", "no answer within 1 s".
  [[nodiscard]] std::string words() const;
};

/// One demand on data or measurements; an outcome written as a mapping holds several, and all must be met.
struct Demand {
  enum class Kind : std::uint8_t {
    value,
    holds,
    range,
    bytes,
    size,
    declared_size,
    one_of,
    visible_text,
    measured
  };
  Kind kind = Kind::value;
  Expression value;                ///< value, holds
  Expression mask;                 ///< of value and range: the bits that count; empty: all
  std::vector<Expression> values;  ///< one_of
  Range range;                     ///< range, and size unless exact
  Bytes bytes;
  std::string measure;  ///< name of the measurement
  std::uint64_t least = 0, most = 0;
  std::string text;  ///< in words
};

/// One member of a graded set.
struct Outcome {
  enum class Kind : std::uint8_t { ok, abort_code, abort_any, abort_defined, silence, unchanged, data };
  Kind kind = Kind::ok;
  AbortCode code{}, last_code{};  ///< abort_code: an inclusive range, mostly of one
  Expression named_code;          ///< abort_code: a $name that holds the code, instead of the range
  std::vector<Demand> demands;    ///< data

  /// Whether `actual` is this outcome. Error when a name in it has no value.
  [[nodiscard]] Result<bool> matches(const Actual& actual, Scope& scope) const;
  /// In words for reports, values filled in.
  [[nodiscard]] std::string words(Scope& scope, std::optional<canopen::DataType> type) const;
};

/// Names of a scenario an author may use at some place; unknown ones are diagnosed.
using NameCheck = std::vector<std::string>;

/// Keys of an outcome written as a mapping, for messages and for the schema's test.
[[nodiscard]] std::vector<std::string_view> outcome_keys();

/// Names of measurements.
using Measures = std::vector<std::string_view>;
/// Reports every measurement that an outcome (or list of outcomes) asks for and that is not among these.
void check_measures(const yaml::Field& field, std::string_view verb, const Measures& measured);

/// Reads an outcome (or list of outcomes) of `expect`, `warn`, `fail` or `either: on`. Mistakes go to the
/// field's diagnostics.
[[nodiscard]] std::vector<Outcome> parse_outcomes(const yaml::Field& field, const NameCheck& names);

struct Expectation {
  std::vector<std::string> checks;  ///< requirement ids; "$name" entries are bound per instance
  std::vector<Outcome> pass, warn, fail;
  bool given = false;  ///< `expect`, `warn` or `fail` was written

  [[nodiscard]] std::vector<std::string> pass_words(Scope& scope,
                                                    std::optional<canopen::DataType> type) const;
  [[nodiscard]] std::vector<std::string> warn_words(Scope& scope,
                                                    std::optional<canopen::DataType> type) const;
};

/// The grade of what came, and why.
struct Grade {
  result::Verdict verdict = result::Verdict::pass;
  std::string reason;
};

/// Whether rules of this level bind a device; `recommended` and `optional` ones do not.
[[nodiscard]] bool is_binding(std::string_view level);
/// The grade of an outcome that `warn` lists: a rule that only recommends has tolerances only where nobody
/// asked for strictness; what a binding rule tolerates is conformant.
[[nodiscard]] Grade tolerated(std::string_view level, bool strict);

/// Grades by reconciling the set with the requirement's level: listed passes, `warn` warns, `fail` fails at
/// every level, the rest fails for mandatory and conditional requirements and warns for recommended and
/// optional ones unless `strict`.
[[nodiscard]] Result<Grade> grade(const Expectation& expectation, const Actual& actual,
                                  std::string_view level, bool strict, Scope& scope);

}  // namespace conform::steps
