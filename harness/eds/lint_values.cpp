// SPDX-License-Identifier: Apache-2.0
// Values: whether defaults, limits and configured values can be values of their data type.
#include <fmt/format.h>

#include <algorithm>
#include <compare>
#include <expected>
#include <optional>
#include <ranges>

#include "base/text.hpp"
#include "eds/lint_numbers.hpp"
#include "eds/lint_rules.hpp"
#include "eds/type_table.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view values = "CiA 306, values";
constexpr std::string_view limits = "CiA 306, LowLimit and HighLimit";

constexpr Rule value_range{"EDS070", Severity::error, "A value does not fit into its data type", values};
constexpr Rule limit_range{"EDS071", Severity::error, "A limit does not fit into the data type", limits};
constexpr Rule outside_limits{"EDS072", Severity::error, "A value is outside the limits", limits};
constexpr Rule limits_crossed{"EDS073", Severity::error, "LowLimit is above HighLimit", limits};
constexpr Rule twos_complement{"EDS074", Severity::note,
                               "A negative value is written as the bits of its two's complement", values};
constexpr Rule no_real{"EDS075", Severity::error, "The value of a REAL is no decimal number", values};
constexpr Rule real_bits{"EDS076", Severity::warning, "The value of a REAL is a hexadecimal number", values};
constexpr Rule no_octets{"EDS077", Severity::warning,
                         "The value of an OCTET_STRING is not made of hexadecimal bytes", values};
constexpr Rule quoted{"EDS078", Severity::note, "A text begins with quotes, which become part of it", values};
constexpr Rule limits_of_text{"EDS079", Severity::note, "A type without order has limits", limits};

constexpr Rule no_domain{"EDS080", Severity::warning,
                         "The value of a DOMAIN is not made of hexadecimal bytes", values};
constexpr Rule sign_extended{"EDS081", Severity::warning, "A negative value has more bits than its data type",
                             values};

constexpr const Rule* all[] = {&value_range,     &limit_range,    &outside_limits, &limits_crossed,
                               &twos_complement, &no_real,        &real_bits,      &no_octets,
                               &quoted,          &limits_of_text, &no_domain,      &sign_extended};

/// A number with its sign, so that all of INTEGER64 and UNSIGNED64 can be compared.
struct Value {
  bool negative = false;
  std::uint64_t magnitude = 0;
  friend constexpr std::strong_ordering operator<=>(const Value& a, const Value& b) {
    if (a.negative != b.negative) return b.negative <=> a.negative;
    return a.negative ? b.magnitude <=> a.magnitude : a.magnitude <=> b.magnitude;
  }
};

std::uint64_t all_ones(unsigned bits) {
  return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1U;
}

/// What a number is as a value of the type; nullopt when the type has no such value.
std::optional<Value> as_value(const Number& number, const TypeInfo& type) {
  const auto most = all_ones(type.bits);
  const auto sign = std::uint64_t{1} << (type.bits - 1U);
  if (type.kind != TypeKind::signed_integer) {
    if (number.negative || number.magnitude > most) return std::nullopt;
    return Value{false, number.magnitude};
  }
  if (number.negative) {
    if (number.magnitude > sign) return std::nullopt;
    return Value{true, number.magnitude};
  }
  if (number.magnitude < sign) return Value{false, number.magnitude};
  // 0xFFFF for an INTEGER16 is how many write -1; in decimal nobody means it.
  if (number.base != NumberBase::hexadecimal) return std::nullopt;
  if (number.magnitude <= most) return Value{true, most - number.magnitude + 1U};
  // 0xFFFFFF80 for an INTEGER8: the same value, in a longer type.
  const auto above = ~(most >> 1U);
  for (const unsigned bits : {16U, 32U, 64U}) {
    const auto ones = all_ones(bits);
    if (number.magnitude <= ones && (number.magnitude & above & ones) == (above & ones))
      return Value{true, ones - number.magnitude + 1U};
  }
  return std::nullopt;
}

class Check {
 public:
  Check(const Spot& spot, const TypeInfo& type, const Subject& subject, Findings& findings)
      : spot_(spot), type_(type), xml_(subject.file.is_xml()), node_(subject.node), findings_(findings) {}

  void run() {
    const auto& entry = spot_.entry;
    switch (type_.kind) {
      case TypeKind::boolean:
      case TypeKind::signed_integer:
      case TypeKind::unsigned_integer: integers(); break;
      case TypeKind::real: reals(); break;
      case TypeKind::text:
        for (const auto* field : {&entry.default_value, &entry.parameter_value}) quotes(*field);
        no_limits();
        break;
      case TypeKind::octets:
        octets(no_octets, "DefaultValue", entry.default_value);
        octets(no_octets, "ParameterValue", entry.parameter_value);
        no_limits();
        break;
      case TypeKind::domain:
        octets(no_domain, "DefaultValue", entry.default_value);
        octets(no_domain, "ParameterValue", entry.parameter_value);
        break;
      default: break;
    }
  }

 private:
  [[nodiscard]] std::string label(std::string_view key) const {
    return fmt::format("{} {}", spot_.name(), key);
  }

  /// The value of a field; nothing when there is none, when it depends on the node-ID or when it has been
  /// complained of.
  std::optional<Value> integer(std::string_view key, const Field& field, const Rule& range) {
    if (field.empty()) return std::nullopt;
    // In XML the words of xsd:boolean are values, too.
    if (const auto flag = flag_of(field); xml_ && type_.kind == TypeKind::boolean && flag)
      return Value{false, *flag ? 1U : 0U};
    // A name is made only for what there is something to say of.
    const auto plain = parse_number(field.text);
    const auto number =
        plain && plain->odd == Oddities{} ? std::optional(*plain) : read_number(field, label(key), findings_);
    if (!number) return std::nullopt;
    const auto value = as_value(*number, type_);
    if (!value) {
      findings_.add(range, field.at,
                    fmt::format("{}: {} is no value of {}", label(key), shortened(field.text), type_.name));
      return std::nullopt;
    }
    if (number->node_id) return std::nullopt;
    if (value->negative && !number->negative) {
      findings_.add(
          number->magnitude > all_ones(type_.bits) ? sign_extended : twos_complement, field.at,
          fmt::format("{}: {} stands for -{}", label(key), shortened(field.text), value->magnitude));
    }
    return value;
  }

  void integers() {
    const auto& entry = spot_.entry;
    // What the limits of a BOOLEAN are is nobody's business: it has two values.
    const bool has_limits = type_.kind != TypeKind::boolean;
    const auto low = has_limits ? integer("LowLimit", entry.low_limit, limit_range) : std::nullopt;
    const auto high = has_limits ? integer("HighLimit", entry.high_limit, limit_range) : std::nullopt;
    compare(low, high, integer("DefaultValue", entry.default_value, value_range), "DefaultValue",
            entry.default_value);
    compare(low, high, integer("ParameterValue", entry.parameter_value, value_range), "ParameterValue",
            entry.parameter_value);
    if (type_.kind != TypeKind::unsigned_integer || (low && high && *low > *high)) return;
    formula(low, high, "DefaultValue", entry.default_value);
    formula(low, high, "ParameterValue", entry.parameter_value);
  }

  /// Limits that hold for some node-IDs only may be meant: nodes above them are not allowed.
  void formula(const std::optional<Value>& low, const std::optional<Value>& high, std::string_view key,
               const Field& field) {
    constexpr std::uint64_t nodes = 127;
    const auto number = low || high ? parse_number(field.text) : std::unexpected(NumberFault::empty);
    if (!number || !number->node_id || number->negative || number->magnitude > all_ones(64) - nodes) return;
    const auto first = number->magnitude + node_.value_or(1);
    const auto last = number->magnitude + node_.value_or(nodes);
    const auto tell = [&](std::string_view where, const Field& limit) {
      const auto when = node_ ? fmt::format("with node-ID {}", *node_) : std::string("with every node-ID");
      findings_.add(outside_limits, field.at,
                    fmt::format("{}: {} is {} {} {}", label(key), shortened(field.text), when, where,
                                shortened(limit.text)));
    };
    if (low && Value{false, last} < *low) tell("below LowLimit", spot_.entry.low_limit);
    if (high && Value{false, first} > *high) tell("above HighLimit", spot_.entry.high_limit);
  }

  template <typename Number>
  void compare(const std::optional<Number>& low, const std::optional<Number>& high,
               const std::optional<Number>& value, std::string_view key, const Field& field) {
    const auto& entry = spot_.entry;
    if (low && high && *low > *high) {
      findings_.add(
          limits_crossed, entry.low_limit.at,
          fmt::format("{}: LowLimit {} is above HighLimit {}", spot_.name(), shortened(entry.low_limit.text),
                      shortened(entry.high_limit.text)),
          type_.kind == TypeKind::signed_integer ? fmt::format("the data type is {}", type_.name) : "");
      return;
    }
    if (!value) return;
    if (low && *value < *low)
      findings_.add(outside_limits, field.at,
                    fmt::format("{}: {} is below LowLimit {}", label(key), shortened(field.text),
                                shortened(entry.low_limit.text)));
    if (high && *value > *high)
      findings_.add(outside_limits, field.at,
                    fmt::format("{}: {} is above HighLimit {}", label(key), shortened(field.text),
                                shortened(entry.high_limit.text)));
  }

  std::optional<double> real(std::string_view key, const Field& field) {
    if (field.empty()) return std::nullopt;
    const auto text = without_comment(field.text);
    if (const auto value = parse_real(text); value && text.size() == field.text.size()) return value;
    if (const auto number = parse_number(field.text); number && !number->node_id) {
      (void)read_number(field, label(key), findings_);
      if (number->base == NumberBase::hexadecimal)
        findings_.add(real_bits, field.at,
                      fmt::format("{}: whether {} is a number or the bits of one is open", label(key),
                                  shortened(field.text)),
                      "write the value as decimal number");
      return std::nullopt;
    }
    findings_.add(no_real, field.at,
                  fmt::format("{}: '{}' is no decimal number", label(key), shortened(field.text)));
    return std::nullopt;
  }

  void reals() {
    const auto& entry = spot_.entry;
    const auto low = real("LowLimit", entry.low_limit);
    const auto high = real("HighLimit", entry.high_limit);
    compare(low, high, real("DefaultValue", entry.default_value), "DefaultValue", entry.default_value);
    compare(low, high, real("ParameterValue", entry.parameter_value), "ParameterValue",
            entry.parameter_value);
  }

  void quotes(const Field& field) {
    if (!field.text.starts_with('"')) return;
    findings_.add(
        quoted, field.at,
        fmt::format("{}: the quotes of '{}' are part of the text", spot_.name(), shortened(field.text)));
  }

  void octets(const Rule& rule, std::string_view key, const Field& field) {
    // What editors write where a DOMAIN has no default.
    if (type_.kind == TypeKind::domain && field.text == "0") return;
    const auto digits = std::ranges::count_if(field.text, [](char c) { return c != ' '; });
    const bool hex = field.text.find_first_not_of("0123456789abcdefABCDEF ") == std::string::npos;
    if (hex && digits % 2 == 0) return;
    findings_.add(rule, field.at,
                  fmt::format("{}: '{}' is not made of bytes", label(key), shortened(field.text)),
                  "two hexadecimal digits for each byte, without 0x");
  }

  void no_limits() {
    for (const auto* field : {&spot_.entry.low_limit, &spot_.entry.high_limit}) {
      if (!field->empty())
        findings_.add(limits_of_text, field->at,
                      fmt::format("{}: {} has no order", spot_.name(), type_.name));
    }
  }

  const Spot& spot_;
  const TypeInfo& type_;
  bool xml_;
  std::optional<std::uint8_t> node_;
  Findings& findings_;
};

/// [xxxxValue]: the values of the sub-objects that CompactSubObj implies.
void configured_list(const Subject& subject, const Object& object, Findings& findings) {
  const auto type = data_type(object.entry);
  const auto* info = type ? find_type(*type) : nullptr;
  if (info == nullptr) return;
  // No more than there can be sub-indices, and the limits only as long as numbers are: a hostile file has
  // both.
  constexpr std::size_t most = 254, longest = 64;
  Entry entry;
  entry.at = object.entry.at;
  if (object.entry.low_limit.text.size() <= longest) entry.low_limit = object.entry.low_limit;
  if (object.entry.high_limit.text.size() <= longest) entry.high_limit = object.entry.high_limit;
  for (const auto& value : object.lists->values.entries | std::views::take(most)) {
    entry.parameter_value = value.field;
    Check({object, {}, entry}, *info, subject, findings).run();
  }
}

void check(const Subject& subject, Findings& findings) {
  each_described(subject, [&](const Spot& spot) {
    // The head of a compact array has the values of its sub-objects.
    if (!spot.has_value() && spot.object.compact_sub_obj.empty()) return;
    constexpr std::uint16_t domain = 0x0F;
    const bool is_domain = object_code(spot.entry) == ObjectCode::domain;
    const auto type = is_domain ? domain : data_type(spot.entry);
    const auto* info = type ? find_type(*type) : nullptr;
    if (info != nullptr) Check(spot, *info, subject, findings).run();
  });
  for (const auto& object : subject.file.objects) configured_list(subject, object, findings);
  // Texts of the information sections are quoted by the same mistake.
  const auto quotes = [&findings](std::string_view key, const Field& field) {
    if (field.text.starts_with('"'))
      findings.add(quoted, field.at,
                   fmt::format("{}: the quotes of '{}' are part of the text", key, shortened(field.text)));
  };
  for (const auto& row : file_info_fields) quotes(row.key, subject.file.file_info.*row.field);
  for (const auto& row : device_info_fields) quotes(row.key, subject.file.device_info.*row.field);
  for (const auto& line : subject.file.comments.entries)
    quotes(fmt::format("Line{}", line.number), line.field);
}

}  // namespace

constinit const Group value_rules{{"Values", all}, check};

}  // namespace conform::eds
