// SPDX-License-Identifier: Apache-2.0
// COB-IDs and other values of CiA 301's objects: bits that must be 0, values that are reserved, and who else
// uses the CAN-ID.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "eds/lint_rules.hpp"
#include "eds/standard_table.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view cob_ids = "CiA 301, 7.5.2, values of COB-IDs";
constexpr std::string_view values = "CiA 301, 7.5.2";

constexpr Rule upper_bits{"EDS450", Severity::error,
                          "A COB-ID with an 11-bit CAN-ID has bits between 11 and 28", cob_ids};
constexpr Rule reserved_bits{"EDS451", Severity::warning, "A reserved bit of a value is set", values};
constexpr Rule default_sdo{"EDS452", Severity::error,
                           "The default SDO (1200h) is not valid, dynamic or has an extended CAN-ID",
                           "CiA 301, 7.5.2.33"};
constexpr Rule not_predefined{"EDS453", Severity::note,
                              "A default COB-ID is not that of the pre-defined connection set",
                              "CiA 301, 7.3.5"};
constexpr Rule limit_of_bits{"EDS454", Severity::warning,
                             "HighLimit of a COB-ID that can be written forbids bit 31, not valid", cob_ids};
constexpr Rule transmission{"EDS455", Severity::error, "A transmission type is a reserved one",
                            "CiA 301, 7.5.2.35 and 7.5.2.37"};
constexpr Rule out_of_range{"EDS456", Severity::warning, "A value is outside the range that CiA 301 gives",
                            values};
constexpr Rule same_rpdos{"EDS457", Severity::note, "Two RPDOs are received on one CAN-ID by default",
                          "CiA 301, 7.5.2.35"};
constexpr Rule same_can_id{"EDS458", Severity::warning,
                           "Two services of the device use one CAN-ID by default", "CiA 301, 7.3.3"};
constexpr Rule other_default{"EDS459", Severity::note,
                             "A default is not the one of CiA 301, which only a profile may change", values};
constexpr Rule fifth_pdo{"EDS460", Severity::note,
                         "A PDO from the fifth on is valid by default, which only a profile may say",
                         "CiA 301, 7.5.2.35 and 7.5.2.37"};
constexpr Rule watched_twice{"EDS461", Severity::error, "Two heartbeat times are given for one node",
                             "CiA 301, 7.5.2.19"};
constexpr Rule no_request{"EDS462", Severity::warning,
                          "A TPDO is sent only on RTR, but bit 30 of its COB-ID forbids RTR",
                          "CiA 301, 7.5.2.37"};

constexpr const Rule* all[] = {&upper_bits,   &reserved_bits, &default_sdo, &not_predefined, &limit_of_bits,
                               &transmission, &out_of_range,  &same_rpdos,  &same_can_id,    &other_default,
                               &fifth_pdo,    &watched_twice, &no_request};

constexpr std::uint64_t not_valid = 0x8000'0000, bit_30 = 0x4000'0000, extended = 0x2000'0000;
constexpr std::uint64_t base_can_id = 0x7FF, upper = 0x1FFF'F800;

bool is_rpdo(Index index) { return between(index, 0x1400, 0x15FF); }
bool is_tpdo(Index index) { return between(index, 0x1800, 0x19FF); }
bool is_sdo_channel(Index index) { return between(index, 0x1200, 0x12FF); }

bool holds_cob_id(Index index, unsigned sub) {
  if (is_rpdo(index) || is_tpdo(index)) return sub == 1;
  if (is_sdo_channel(index)) return sub == 1 || sub == 2;
  if (index == Index(0x1028)) return sub > 0;
  return sub == 0 && (index == Index(0x1005) || index == Index(0x1012) || index == Index(0x1014));
}

/// Values of entries whose reserved ones lie in the middle of a range.
bool is_reserved_value(Index index, unsigned sub, std::uint64_t value) {
  if (index == Index(0x1019)) return value == 1;
  return index == Index(0x1029) && sub > 0 && value >= 0x03 && value <= 0x7F;
}

/// Those defaults that CiA 301 gives as one number; others (1005h, 1017h, 1019h...) it leaves to profiles.
bool has_one_default(Index index) {
  constexpr std::uint16_t indices[] = {0x1003, 0x1006, 0x1007, 0x1015, 0x1016, 0x1029};
  return std::ranges::find(indices, index.value()) != std::end(indices);
}

class Check {
 public:
  Check(const Subject& subject, const Object& object, Findings& findings)
      : subject_(subject), object_(object), findings_(findings) {}

  void run() {
    if (!is_structured(object_)) look({object_, {}, object_.entry}, 0);
    bool some = false;
    for (const auto& sub : object_.subs) {
      // CompactSubObj makes sub-index 00h by itself, and all others alike: the first speaks for them.
      if (sub.entry.implied_by.known() && (sub.sub == SubIndex(0) || std::exchange(some, true))) continue;
      look({object_, sub.sub, sub.entry}, sub.sub.value());
    }
  }

 private:
  void add(const Rule& rule, const Spot& spot, const Field& field, const std::string& message,
           std::string hint = {}) {
    findings_.add(rule, place_of(field, spot.entry.at), fmt::format("{}: {}", spot.name(), message),
                  std::move(hint));
  }

  void look(const Spot& spot, unsigned sub) {
    const auto& field = effective_value(spot.entry);
    const auto index = object_.index;
    if (holds_cob_id(index, sub)) cob_id(spot, field, sub);
    const auto number = number_of(field);
    if (!number) return;
    if (sub == 2 && (is_rpdo(index) || is_tpdo(index))) transmission_type(spot, field, *number);
    if (index == Index(0x1016) && sub > 0) consumer(spot, field, *number);
    range(spot, field, sub, *number);
    if (spot.entry.parameter_value.empty()) given_default(spot, field, sub, *number);
  }

  void cob_id(const Spot& spot, const Field& field, unsigned sub) {
    limit(spot, sub);
    const auto value = cob_id_of(field);
    if (!value) return;
    const auto bits = value->magnitude;
    const auto text = shortened(field.text);
    const bool is_base = (bits & extended) == 0;
    if (is_base && (bits & upper) != 0)
      add(upper_bits, spot, field, fmt::format("in '{}' bits 11 to 28 are not 0, but bit 29 is", text));
    const auto index = object_.index;
    if ((bits & bit_30) != 0 && (index == Index(0x1014) || index == Index(0x1028)))
      add(reserved_bits, spot, field, fmt::format("bit 30 of '{}' is reserved", text));
    if (index == Index(0x1200) && (bits & (not_valid | bit_30 | extended)) != 0) {
      add(default_sdo, spot, field, fmt::format("'{}' is not a valid, static 11-bit CAN-ID", text));
      return;
    }
    const bool is_pdo = is_rpdo(index) || is_tpdo(index);
    if (is_pdo && (index.value() & 0x1FFU) > 3 && (bits & not_valid) == 0 && bits != 0)
      add(fifth_pdo, spot, field, fmt::format("'{}' is valid", text), "set bit 31, or name the profile");
    if (is_base && (bits & not_valid) == 0) predefined(spot, field, *value, sub);
  }

  void predefined(const Spot& spot, const Field& field, const Number& value, unsigned sub) {
    const auto* row = find_standard_row({object_.index, SubIndex(static_cast<std::uint8_t>(sub))});
    if (row == nullptr || !row->has(StandardFlag::adds_node_id)) return;
    const auto base = static_cast<std::uint64_t>(row->default_value);
    const auto can_id = value.magnitude & base_can_id;
    if (value.node_id ? can_id == base : subject_.node && can_id == base + *subject_.node) return;
    const bool fixed = !value.node_id && can_id >= base && can_id <= base + 127;
    add(not_predefined, spot, field,
        fixed ? fmt::format("'{}' does not follow the node-ID", shortened(field.text))
              : fmt::format("'{}' is not {:X}h plus the node-ID", shortened(field.text), base),
        fixed ? fmt::format("write $NODEID+0x{:X}", base) : std::string());
  }

  void limit(const Spot& spot, unsigned sub) {
    const auto index = object_.index;
    if (index == Index(0x1005) || index == Index(0x1012) || sub > 2) return;
    const auto allowed = access(spot.entry);
    const auto high = number_of(spot.entry.high_limit);
    if (!allowed || !can_be_written(*allowed) || !high || *high >= not_valid) return;
    add(limit_of_bits, spot, spot.entry.high_limit,
        fmt::format("with HighLimit {} nobody can set bit 31", shortened(spot.entry.high_limit.text)),
        "a COB-ID is changed while bit 31 says that it is not valid");
  }

  void transmission_type(const Spot& spot, const Field& field, std::uint64_t value) {
    const std::uint64_t last_reserved = is_rpdo(object_.index) ? 0xFD : 0xFB;
    if (value >= 0xF1 && value <= last_reserved)
      add(transmission, spot, field, fmt::format("transmission type {:02X}h is reserved", value));
    const bool on_request = is_tpdo(object_.index) && (value == 0xFC || value == 0xFD);
    const auto* cob_id = on_request ? object_.find(SubIndex(1)) : nullptr;
    const auto id = cob_id == nullptr ? std::nullopt : cob_id_of(effective_value(*cob_id));
    if (id && (id->magnitude & (not_valid | bit_30)) == bit_30)
      add(no_request, spot, field,
          fmt::format("with transmission type {:02X}h it waits for an RTR that '{}' forbids", value,
                      shortened(effective_value(*cob_id).text)));
  }

  /// 1016h: bits 31..24 reserved | 23..16 node-ID | 15..0 heartbeat time in ms
  void consumer(const Spot& spot, const Field& field, std::uint64_t value) {
    if (value > 0xFFFF'FFFF) return;
    if ((value >> 24U) != 0)
      add(reserved_bits, spot, field, fmt::format("bits 24 to 31 of {} are reserved", shortened(field.text)));
    if (((value >> 16U) & 0xFFU) > 127)
      add(out_of_range, spot, field, fmt::format("{} is no node-ID", (value >> 16U) & 0xFFU));
  }

  void range(const Spot& spot, const Field& field, unsigned sub, std::uint64_t value) {
    const auto index = object_.index;
    const auto* row = find_standard_row({index, SubIndex(static_cast<std::uint8_t>(sub))});
    // How many sub-indices there may be is said of the sub-indices themselves.
    if (row == nullptr || (sub == 0 && is_structured(object_))) return;
    // The node-ID of an SDO channel that nobody has set up.
    if (is_sdo_channel(index) && value == 0) return;
    const bool below = row->low != StandardRow::none && value < static_cast<std::uint64_t>(row->low);
    const bool above = row->high != StandardRow::none && value > static_cast<std::uint64_t>(row->high);
    if (below || above)
      add(out_of_range, spot, field,
          fmt::format("{} is not in {} to {}", shortened(field.text), row->low, row->high));
    else if (is_reserved_value(index, sub, value))
      add(out_of_range, spot, field, fmt::format("{} is a reserved value", shortened(field.text)));
  }

  void given_default(const Spot& spot, const Field& field, unsigned sub, std::uint64_t value) {
    const auto* row = find_standard_row({object_.index, SubIndex(static_cast<std::uint8_t>(sub))});
    if (row == nullptr || row->default_value == StandardRow::none || !has_one_default(object_.index)) return;
    if (value != static_cast<std::uint64_t>(row->default_value))
      add(other_default, spot, field,
          fmt::format("the default is {}, by CiA 301 {}", shortened(field.text), row->default_value));
  }

  const Subject& subject_;
  const Object& object_;
  Findings& findings_;
};

/// Who uses a CAN-ID from power-on.
struct User {
  Index index;
  std::string name;
};

/// The CAN-ID that an object uses from power-on, bit 29 included; nothing when it is not used.
std::optional<Number> used(const Object& object) {
  const auto index = object.index;
  const bool is_pdo = is_rpdo(index) || is_tpdo(index);
  const auto* entry = is_pdo ? object.find(SubIndex(1)) : &object.entry;
  if (!is_pdo && (!holds_cob_id(index, 0) || is_structured(object))) return std::nullopt;
  auto value = entry == nullptr ? std::nullopt : cob_id_of(effective_value(*entry));
  if (!value) return std::nullopt;
  const auto bits = value->magnitude;
  if ((is_pdo || index == Index(0x1014)) && (bits & not_valid) != 0) return std::nullopt;
  if (index == Index(0x1012) && (bits & (not_valid | bit_30)) == 0) return std::nullopt;
  value->magnitude = bits & (extended | ((bits & extended) != 0 ? 0x1FFF'FFFFU : base_can_id));
  if (value->magnitude == 0 && !value->node_id) return std::nullopt;
  return value;
}

void check_shared(const Subject& subject, Findings& findings) {
  std::map<std::pair<bool, std::uint64_t>, User> users;
  for (const auto& object : subject.objects) {
    if (object.index.value() > 0x19FF) break;
    const auto id = used(object);
    if (!id) continue;
    const bool formula = id->node_id && !subject.node;
    const auto number = id->magnitude + (id->node_id ? subject.node.value_or(0) : 0U);
    const auto is_pdo = is_communication_parameter(object.index);
    auto name = section_name(object.index, is_pdo ? std::optional(SubIndex(1)) : std::nullopt);
    const auto [first, fresh] = users.try_emplace({formula, number}, User{object.index, name});
    // Two TPDOs have a rule of their own.
    if (fresh || (is_tpdo(object.index) && is_tpdo(first->second.index))) continue;
    const bool rpdos = is_rpdo(object.index) && is_rpdo(first->second.index);
    const auto& entry = is_pdo ? *object.find(SubIndex(1)) : object.entry;
    findings.add(rpdos ? same_rpdos : same_can_id, place_of(effective_value(entry), entry.at),
                 fmt::format("{}: '{}' is the CAN-ID of {}, too", name,
                             shortened(effective_value(entry).text), first->second.name),
                 "set bit 31 of what is not used by default");
  }
}

/// A second heartbeat time unequal 0 for the same node is refused with 0604 0043h.
void check_watched(const Subject& subject, Findings& findings) {
  const auto* object = find_object(subject.objects, Index(0x1016));
  if (object == nullptr) return;
  std::map<std::uint64_t, SubIndex> first;
  std::set<std::uint64_t> told;
  for (const auto& sub : object->subs) {
    const auto& field = effective_value(sub.entry);
    const auto value = number_of(field);
    if (sub.sub == SubIndex(0) || !value || *value > 0xFFFF'FFFF) continue;
    const auto node = (*value >> 16U) & 0xFFU;
    // Such an entry is not used.
    if ((*value & 0xFFFFU) == 0 || node == 0 || node > 127) continue;
    const auto [known, fresh] = first.try_emplace(node, sub.sub);
    if (fresh || !told.insert(node).second) continue;
    findings.add(watched_twice, place_of(field, sub.entry.at),
                 fmt::format("{}: node {} is watched by {} already", section_name(object->index, sub.sub),
                             node, section_name(object->index, known->second)),
                 "a device answers it with abort 0604 0043h");
  }
}

void check(const Subject& subject, Findings& findings) {
  check_shared(subject, findings);
  check_watched(subject, findings);
  for (const auto& object : subject.objects) {
    if (object.index.value() > 0x19FF) break;
    Check(subject, object, findings).run();
  }
}

}  // namespace

constinit const Group cob_id_rules{{"COB-IDs and other values of CiA 301", all}, check};

}  // namespace conform::eds
