// SPDX-License-Identifier: Apache-2.0
// PDOs as a whole: how many, communication and mapping parameters in pairs, whether mappings can change.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "base/text.hpp"
#include "eds/lint_rules.hpp"
#include "eds/type_table.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view counts = "CiA 306, [DeviceInfo]";
constexpr std::string_view pdos = "CiA 301, 7.5.2";

constexpr Rule rpdo_count{"EDS300", Severity::error, "NrOfRXPDO is not the number of RPDOs", counts};
constexpr Rule tpdo_count{"EDS301", Severity::error, "NrOfTXPDO is not the number of TPDOs", counts};
constexpr Rule no_mapping{"EDS302", Severity::error, "A PDO has no mapping parameter", pdos};
constexpr Rule no_communication{"EDS303", Severity::error, "A PDO mapping has no communication parameter",
                                pdos};
constexpr Rule count_is_const{"EDS304", Severity::warning,
                              "Mapping entries can be written, but sub-index 00h cannot", pdos};
constexpr Rule entries_are_const{"EDS305", Severity::note,
                                 "Sub-index 00h of a mapping can be written, but its entries cannot", pdos};
constexpr Rule granularity_zero{"EDS306", Severity::warning,
                                "Granularity 0 says that no mapping can change, but one can be written",
                                counts};
constexpr Rule mapping_without_cob_id{"EDS307", Severity::warning,
                                      "A mapping can be written although the COB-ID of its PDO cannot", pdos};
constexpr Rule compact_without{"EDS308", Severity::warning, "CompactPDO is given, but the device has no PDOs",
                               counts};
constexpr Rule finer_than_granularity{"EDS309", Severity::warning,
                                      "Mappable objects are shorter than the granularity", counts};
constexpr Rule no_pdo{"EDS310", Severity::note,
                      "Objects can be mapped, but there is no PDO of that direction", pdos};
constexpr Rule no_cob_id{"EDS311", Severity::error, "A PDO has no COB-ID (sub-index 01h)", pdos};
constexpr Rule same_cob_id{"EDS312", Severity::warning, "Two TPDOs are sent on one CAN-ID by default",
                           "CiA 301, 7.5.2.37"};
constexpr Rule restricted_can_id{"EDS313", Severity::error,
                                 "A PDO, SYNC, TIME or EMCY uses a restricted CAN-ID by default",
                                 "CiA 301, 7.3.3, table 40"};
constexpr Rule needless_granularity{"EDS314", Severity::warning,
                                    "No mapping can change, but Granularity is not 0", counts};
constexpr Rule number_of_pdos_object{
    "EDS315", Severity::warning, "1004h does not count the PDOs that there are", "CiA 301 version 3, 1004h"};

constexpr Rule compact_mask{"EDS316", Severity::warning,
                            "CompactPDO has unknown bits, or not those of COB-ID and transmission type",
                            counts};

constexpr const Rule* all[] = {&rpdo_count,
                               &tpdo_count,
                               &no_mapping,
                               &no_communication,
                               &count_is_const,
                               &entries_are_const,
                               &granularity_zero,
                               &mapping_without_cob_id,
                               &compact_without,
                               &finer_than_granularity,
                               &no_pdo,
                               &no_cob_id,
                               &same_cob_id,
                               &restricted_can_id,
                               &needless_granularity,
                               &number_of_pdos_object,
                               &compact_mask};

struct Direction {
  unsigned communication;  ///< first index
  unsigned mapping;
  std::string_view key;
  Field DeviceInfo::* count;
  const Rule* rule;
};
constexpr Direction directions[] = {
    {0x1400, 0x1600, "NrOfRXPDO", &DeviceInfo::nr_of_rx_pdo, &rpdo_count},
    {0x1800, 0x1A00, "NrOfTXPDO", &DeviceInfo::nr_of_tx_pdo, &tpdo_count},
};
constexpr unsigned range = 0x200;

bool writable(const Entry* entry) {
  const auto allowed = entry == nullptr ? std::nullopt : access(*entry);
  return allowed && can_be_written(*allowed);
}

std::uint64_t number_of_pdos(const Subject& subject, const Direction& direction) {
  return static_cast<std::uint64_t>(std::ranges::count_if(subject.objects, [&](const Object& object) {
    return between(object.index, direction.communication, direction.communication + range - 1);
  }));
}

void check_counts(const Subject& subject, Findings& findings) {
  const auto& info = subject.file.device_info;
  // Modules bring PDOs of their own.
  if (!info.present || is_modular(subject.file)) return;
  bool some = false;
  for (const auto& direction : directions) {
    const auto& field = info.*direction.count;
    const auto said = number_of(field);
    const auto found = number_of_pdos(subject, direction);
    some = some || found > 0 || said.value_or(0) > 0;
    if (!said && !field.empty()) continue;
    if (said.value_or(0) != found)
      findings.add(*direction.rule, place_of(field, info.at),
                   fmt::format("{} says {}, but there are {} communication parameters", direction.key,
                               field.empty() ? "nothing" : std::to_string(*said), found));
  }
  // Bit 0 is sub-index 01h, and the last one, 06h, the SYNC start value.
  const auto mask = number_of(info.compact_pdo).value_or(0);
  if (mask != 0 && ((mask & 3U) != 3U || mask > 0x3F))
    findings.add(compact_mask, info.compact_pdo.at,
                 fmt::format("CompactPDO {} is not a mask of sub-indices 01h, 02h and some of 03h to 06h",
                             shortened(info.compact_pdo.text)));
  if (!some && mask > 0)
    findings.add(compact_without, info.compact_pdo.at, "CompactPDO is given, but the device has no PDOs");
}

void check_mapping_access(const Subject& subject, const Object& mapping, const Object* communication,
                          Findings& findings) {
  const auto* zero = mapping.find(SubIndex(0));
  if (zero == nullptr) return;
  const auto* first_writable = static_cast<const SubObject*>(nullptr);
  bool any = false;
  for (const auto& sub : mapping.subs) {
    if (sub.sub == SubIndex(0)) continue;
    any = true;
    if (first_writable == nullptr && writable(&sub.entry)) first_writable = &sub;
  }
  const auto name = section_name(mapping.index, SubIndex(0));
  const bool changeable = writable(zero);
  if (first_writable != nullptr && !changeable && access(*zero))
    findings.add(count_is_const, place_of(zero->access_type, zero->at),
                 fmt::format("{}: it cannot be written, but {} can", name,
                             section_name(mapping.index, first_writable->sub)),
                 "a mapping is changed by writing 0 to sub-index 00h first");
  if (changeable && any && first_writable == nullptr)
    findings.add(entries_are_const, place_of(zero->access_type, zero->at),
                 fmt::format("{}: only the number of objects can be written", name));
  if (!changeable) return;
  if (number_of(subject.file.device_info.granularity) == 0U)
    findings.add(granularity_zero, place_of(zero->access_type, zero->at),
                 fmt::format("{}: it can be written, but Granularity is 0", name));
  const auto* cob_id = communication == nullptr ? nullptr : communication->find(SubIndex(1));
  if (cob_id != nullptr && access(*cob_id) && !writable(cob_id))
    findings.add(
        mapping_without_cob_id, place_of(zero->access_type, zero->at),
        fmt::format("{}: the PDO must be made invalid first, but {} is {}", name,
                    section_name(communication->index, SubIndex(1)), shortened(cob_id->access_type.text)));
}

void check_pairs(const Subject& subject, Findings& findings) {
  for (const auto& object : subject.objects) {
    for (const auto& direction : directions) {
      const auto other = [&](unsigned from, unsigned to) {
        return find_object(subject.objects,
                           Index(static_cast<std::uint16_t>(object.index.value() - from + to)));
      };
      if (between(object.index, direction.communication, direction.communication + range - 1)) {
        if (other(direction.communication, direction.mapping) == nullptr)
          findings.add(no_mapping, object.entry.at,
                       fmt::format("{}: its mapping parameter is missing", section_name(object.index)));
        if (!object.subs.empty() && object.find(SubIndex(1)) == nullptr)
          findings.add(no_cob_id, object.entry.at,
                       fmt::format("{}: sub-index 01h is missing", section_name(object.index)));
      }
      if (between(object.index, direction.mapping, direction.mapping + range - 1)) {
        const auto* communication = other(direction.mapping, direction.communication);
        if (communication == nullptr)
          findings.add(no_communication, object.entry.at,
                       fmt::format("{}: its communication parameter is missing", section_name(object.index)));
        check_mapping_access(subject, object, communication, findings);
      }
    }
  }
}

void check_mappable(const Subject& subject, Findings& findings) {
  const auto granularity = number_of(subject.file.device_info.granularity).value_or(0);
  const bool modular = is_modular(subject.file);
  bool no_rpdo = !modular && number_of_pdos(subject, directions[0]) == 0;
  bool no_tpdo = !modular && number_of_pdos(subject, directions[1]) == 0;
  std::size_t finer = 0;
  std::string first_finer;
  each_described(subject, [&](const Spot& spot) {
    const auto mapping = pdo_mapping(spot.entry);
    if (mapping == PdoMapping::no || !spot.has_value()) return;
    const auto type = data_type(spot.entry);
    const auto* info = type ? find_type(*type) : nullptr;
    if (info != nullptr && info->bits > 0 && info->bits < granularity && finer++ == 0)
      first_finer = fmt::format("{} has {} bits", spot.name(), info->bits);
    const auto allowed = access(spot.entry);
    if (no_rpdo && (allowed == Access::wo || allowed == Access::rww || mapping == PdoMapping::rpdo_only)) {
      no_rpdo = false;
      findings.add(no_pdo, place_of(spot.entry.pdo_mapping, spot.entry.at),
                   fmt::format("{}: there is no RPDO to map it into", spot.name()));
    }
    if (no_tpdo && (allowed == Access::ro || allowed == Access::rwr || mapping == PdoMapping::tpdo_only)) {
      no_tpdo = false;
      findings.add(no_pdo, place_of(spot.entry.pdo_mapping, spot.entry.at),
                   fmt::format("{}: there is no TPDO to map it into", spot.name()));
    }
  });
  // One number is wrong, however many objects contradict it.
  if (finer > 0 && granularity <= 64) {
    const auto& field = subject.file.device_info.granularity;
    findings.add(finer_than_granularity, field.at,
                 fmt::format("Granularity is {}, but {} mappable objects are shorter; {}",
                             shortened(field.text), finer, first_finer));
  }
}

/// Granularity is 0 where all mappings are fixed (CiA 306).
void check_fixed(const Subject& subject, Findings& findings) {
  const auto& field = subject.file.device_info.granularity;
  if (is_modular(subject.file) || number_of(field).value_or(0) == 0) return;
  bool some = false;
  for (const auto& object : subject.objects) {
    if (!is_mapping_parameter(object.index)) continue;
    const auto* zero = object.find(SubIndex(0));
    if (zero == nullptr || !access(*zero)) return;
    if (std::ranges::any_of(object.subs, [](const SubObject& sub) { return writable(&sub.entry); })) return;
    some = true;
  }
  if (some)
    findings.add(needless_granularity, field.at,
                 fmt::format("Granularity is {}, but no mapping can be written", shortened(field.text)));
}

/// 1004h of version 3: RPDOs in the upper, TPDOs in the lower word. Sub-index 00h counts all, 01h the
/// synchronous, 02h the asynchronous ones.
void check_number_object(const Subject& subject, Findings& findings) {
  const auto* object = find_object(subject.objects, Index(0x1004));
  if (object == nullptr || is_modular(subject.file)) return;
  const auto rpdos = number_of_pdos(subject, directions[0]);
  const auto tpdos = number_of_pdos(subject, directions[1]);
  const auto look = [&](const Entry& entry, bool exact, std::optional<SubIndex> sub) {
    const auto& field = effective_value(entry);
    const auto value = number_of(field);
    if (!value) return;
    const auto rx = *value >> 16U, tx = *value & 0xFFFFU;
    if (exact ? rx == rpdos && tx == tpdos : rx <= rpdos && tx <= tpdos) return;
    findings.add(number_of_pdos_object, field.at,
                 fmt::format("{} says {} RPDOs and {} TPDOs, but there are {} and {}",
                             section_name(object->index, sub), rx, tx, rpdos, tpdos));
  };
  if (!is_structured(*object)) look(object->entry, true, {});
  for (const auto& sub : object->subs) {
    if (sub.sub.value() <= 2) look(sub.entry, sub.sub == SubIndex(0), sub.sub);
  }
}

/// A COB-ID whose object is used from power-on; nullopt with bit 31 set, or where the field is no number.
std::optional<Number> valid_cob_id(const Field& field) {
  constexpr std::uint64_t not_valid = 0x8000'0000;
  const auto number = cob_id_of(field);
  return number && (number->magnitude & not_valid) == 0 ? number : std::nullopt;
}

/// What is on the bus with one CAN-ID cannot be told apart; only one of the two PDOs can be meant.
void check_can_ids(const Subject& subject, Findings& findings) {
  constexpr std::uint64_t can_id = 0x3FFF'FFFF;  // with bit 29: a base and an extended frame are two
  std::map<std::pair<bool, std::uint64_t>, Index> used;
  for (const auto& object : subject.objects) {
    if (!between(object.index, directions[1].communication, directions[1].communication + range - 1))
      continue;
    const auto* cob_id = object.find(SubIndex(1));
    if (cob_id == nullptr) continue;
    const auto& field = effective_value(*cob_id);
    const auto number = valid_cob_id(field);
    if (!number) continue;
    const bool formula = number->node_id && !subject.node;
    const auto id = (number->magnitude & can_id) + (number->node_id ? subject.node.value_or(0) : 0U);
    const auto [first, fresh] = used.emplace(std::pair(formula, id), object.index);
    if (!fresh)
      findings.add(same_cob_id, field.at,
                   fmt::format("{}: '{}' is the CAN-ID of {}, too", section_name(object.index, SubIndex(1)),
                               shortened(field.text), section_name(first->second, SubIndex(1))),
                   "set bit 31 of the one that is not sent by default");
  }
}

/// CiA 301, table 40: identifiers of NMT, SDO, error control and those kept for later.
bool is_restricted(std::uint64_t can_id) {
  struct Ids {
    std::uint64_t first, last;
  };
  constexpr Ids table[] = {{0x000, 0x07F}, {0x101, 0x180}, {0x581, 0x5FF}, {0x601, 0x67F},
                           {0x6E0, 0x6FF}, {0x701, 0x77F}, {0x780, 0x7FF}};
  return std::ranges::any_of(table,
                             [can_id](const Ids& ids) { return can_id >= ids.first && can_id <= ids.last; });
}

/// The COB-ID of a service that can have any but a restricted one, where the device uses it from power-on.
std::optional<Number> used_cob_id(const Spot& spot, const Field& field) {
  if (spot.sub) {
    const bool pdo = is_communication_parameter(spot.object.index) && *spot.sub == SubIndex(1);
    return pdo ? valid_cob_id(field) : std::nullopt;
  }
  switch (spot.object.index.value()) {
    case 0x1005: return cob_id_of(field);  // consumed always
    case 0x1012: {
      constexpr std::uint64_t consumed_or_produced = 0xC000'0000;
      const auto number = cob_id_of(field);
      return number && (number->magnitude & consumed_or_produced) != 0 ? number : std::nullopt;
    }
    case 0x1014: return valid_cob_id(field);
    default: return std::nullopt;
  }
}

/// With some node-ID the object would use it from power-on.
void check_restricted(const Subject& subject, Findings& findings) {
  constexpr std::uint64_t extended = 0x2000'0000;
  each_described(subject, [&](const Spot& spot) {
    const auto& field = effective_value(spot.entry);
    const auto number = used_cob_id(spot, field);
    if (!number || (number->magnitude & extended) != 0) return;
    for (const unsigned node : {1U, 127U}) {
      const auto can_id = (number->magnitude + (number->node_id ? node : 0U)) & 0x7FFU;
      if (!is_restricted(can_id)) continue;
      findings.add(restricted_can_id, field.at,
                   fmt::format("{}: '{}' is {:03X}h{}, which no such object may use", spot.name(),
                               shortened(field.text), can_id,
                               number->node_id ? fmt::format(" with node-ID {}", node) : std::string()),
                   "set bit 31 where the object is not used by default");
      return;
    }
  });
}

void check(const Subject& subject, Findings& findings) {
  check_can_ids(subject, findings);
  check_restricted(subject, findings);
  check_counts(subject, findings);
  check_fixed(subject, findings);
  check_number_object(subject, findings);
  check_pairs(subject, findings);
  check_mappable(subject, findings);
}

}  // namespace

constinit const Group pdo_rules{{"PDOs", all}, check};

}  // namespace conform::eds
