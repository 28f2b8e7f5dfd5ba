// SPDX-License-Identifier: Apache-2.0
// What PDOs map by default (or, in a DCF, by configuration).
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "eds/lint_rules.hpp"
#include "eds/type_table.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view mapping_parameter = "CiA 301, 7.5.2.36 and 7.5.2.38";

constexpr Rule gap{"EDS330", Severity::warning, "A mapping has a gap", mapping_parameter};
constexpr Rule no_object{"EDS331", Severity::error, "A mapped object is not described", mapping_parameter};
constexpr Rule not_mappable{"EDS332", Severity::error, "A mapped object says that it cannot be mapped",
                            mapping_parameter};
constexpr Rule wrong_length{"EDS333", Severity::error, "An object is mapped with another length than it has",
                            mapping_parameter};
constexpr Rule wrong_direction{"EDS334", Severity::error,
                               "The access of a mapped object does not fit the direction", mapping_parameter};
constexpr Rule too_long{"EDS335", Severity::error, "A mapping has more than 64 bits", mapping_parameter};
constexpr Rule dummy_in_tpdo{"EDS336", Severity::error, "A TPDO maps a dummy", "CiA 301, 7.4.7.3"};
constexpr Rule dummy_unused{"EDS337", Severity::warning,
                            "An RPDO maps a dummy that [DummyUsage] does not allow", "CiA 306, [DummyUsage]"};
constexpr Rule too_many{"EDS338", Severity::error, "More objects are mapped than are described",
                        mapping_parameter};
constexpr Rule multiplexed{"EDS339", Severity::warning, "A multiplexed PDO needs GroupMessaging",
                           "CiA 306, [DeviceInfo]"};
constexpr Rule valid_but_empty{"EDS340", Severity::note, "A valid PDO maps nothing", mapping_parameter};
constexpr Rule head_mapped{"EDS341", Severity::error, "A structure is mapped as if it were a variable",
                           mapping_parameter};

constexpr Rule finer{"EDS342", Severity::warning, "A mapped length is no multiple of the granularity",
                     "CiA 306, [DeviceInfo]"};
constexpr Rule odd_direction{"EDS343", Severity::warning,
                             "A TPDO maps a constant, or an object meant for RPDOs",
                             "CiA 306, object descriptions, AccessType"};
constexpr Rule part_of_fixed{"EDS344", Severity::note,
                             "A fixed mapping counts fewer objects than are described", mapping_parameter};

constexpr const Rule* all[] = {
    &gap,           &no_object,     &not_mappable, &wrong_length, &wrong_direction, &too_long,
    &dummy_in_tpdo, &dummy_unused,  &too_many,     &multiplexed,  &valid_but_empty, &head_mapped,
    &finer,         &odd_direction, &part_of_fixed};

constexpr std::uint64_t most_mapped = 64;
constexpr std::uint64_t cob_id_invalid = 0x8000'0000;

/// Index, sub-index and length of a mapping entry (CiA 301, 7.5.2.36).
///   31..16 index | 15..8 sub-index | 7..0 length in bit
struct Mapped {
  Index index;
  SubIndex sub;
  unsigned bits;
};

Mapped unpack(std::uint64_t value) {
  return {Index(static_cast<std::uint16_t>(value >> 16U)), SubIndex(static_cast<std::uint8_t>(value >> 8U)),
          static_cast<unsigned>(value & 0xFFU)};
}

/// One number is wrong, however many mapping entries contradict it.
struct Finer {
  std::size_t count = 0;
  Position at;
  std::string first;

  void add(Position where, std::string what) {
    if (count++ != 0) return;
    at = where;
    first = std::move(what);
  }
};

class Check {
 public:
  Check(const Subject& subject, const Object& mapping, Finer& finer_entries, Findings& findings)
      : subject_(subject),
        finer_(finer_entries),
        mapping_(mapping),
        is_tpdo_(mapping.index.value() >= 0x1A00),
        findings_(findings) {}

  void run() {
    const auto* zero = mapping_.find(SubIndex(0));
    const auto count = zero == nullptr ? std::nullopt : number_of(effective_value(*zero));
    if (!count) return;
    const auto& field = effective_value(*zero);
    if (*count == 254 || *count == 255) {
      if (flag_of(subject_.file.device_info.group_messaging) != true)
        add(multiplexed, field, SubIndex(0), "a multiplexed PDO, but GroupMessaging is not 1");
      return;
    }
    if (*count == 0) {
      empty(field);
      return;
    }
    described(field, *count);
    fixed(*zero, field, *count);
    std::uint64_t bits = 0;
    for (const auto& sub : mapping_.subs) {
      if (sub.sub == SubIndex(0) || sub.sub.value() > *count) continue;
      bits += entry(sub);
    }
    if (bits > 64) add(too_long, field, SubIndex(0), fmt::format("{} bits are mapped", bits));
  }

 private:
  void add(const Rule& rule, const Field& field, SubIndex sub, std::string_view message) {
    findings_.add(rule, place_of(field, mapping_.entry.at),
                  fmt::format("{}: {}", section_name(mapping_.index, sub), message));
  }

  /// Every mapping entry that is counted must be there.
  void described(const Field& field, std::uint64_t count) {
    // Without any sub-objects there is another finding; CompactPDO implies those that are missing.
    if (mapping_.subs.size() < 2) return;
    for (std::uint64_t sub = 1; sub <= std::min(count, most_mapped + 1); ++sub) {
      const auto index = SubIndex(static_cast<std::uint8_t>(sub));
      if (sub <= most_mapped && mapping_.find(index) != nullptr) continue;
      add(too_many, field, SubIndex(0),
          fmt::format("{} objects are mapped, but {} is not described", count,
                      section_name(mapping_.index, index)));
      return;
    }
  }

  /// What a mapping that cannot change does not count nobody will ever use.
  void fixed(const Entry& zero, const Field& field, std::uint64_t count) {
    const auto allowed = access(zero);
    if (!allowed || can_be_written(*allowed) || mapping_.subs.empty()) return;
    const auto last = mapping_.subs.back().sub.value();
    if (last != 0xFF && last > count)
      add(part_of_fixed, field, SubIndex(0), fmt::format("{} of {} objects are counted", count, last));
  }

  void empty(const Field& field) {
    const auto* communication =
        find_object(subject_.objects, Index(static_cast<std::uint16_t>(mapping_.index.value() - 0x200)));
    const auto* cob_id = communication == nullptr ? nullptr : communication->find(SubIndex(1));
    if (cob_id == nullptr) return;
    const auto value = parse_number(effective_value(*cob_id).text);
    if (value && !value->negative && (value->magnitude & cob_id_invalid) == 0 && value->magnitude != 0)
      add(valid_but_empty, field, SubIndex(0), "nothing is mapped, but the COB-ID is valid");
  }

  /// The length of what a mapping entry maps, in bits; 0 when nothing is known.
  unsigned entry(const SubObject& sub) {
    const auto& field = effective_value(sub.entry);
    const auto value = number_of(field);
    if (!value || *value > 0xFFFF'FFFF) return 0;
    if (*value == 0) {
      if (!std::exchange(said_gap_, true))
        add(gap, field, sub.sub, "nothing is mapped here, but sub-index 00h counts it");
      return 0;
    }
    const auto mapped = unpack(*value);
    const auto granularity = number_of(subject_.file.device_info.granularity).value_or(0);
    if (granularity > 1 && granularity <= 64 && mapped.bits % granularity != 0)
      finer_.add(field.at,
                 fmt::format("{} maps {} bits", section_name(mapping_.index, sub.sub), mapped.bits));
    if (mapped.index.value() < 0x20)
      dummy(field, sub.sub, mapped);
    else
      target(field, sub.sub, mapped);
    return mapped.bits;
  }

  void dummy(const Field& field, SubIndex sub, const Mapped& mapped) {
    const auto name = fmt::format("the dummy {}", to_string(mapped.index));
    if (is_tpdo_) return add(dummy_in_tpdo, field, sub, fmt::format("a TPDO cannot map {}", name));
    const auto& usage = subject_.file.dummy_usage;
    const auto claim = std::ranges::find(usage.entries, mapped.index.value(), &NumberedField::number);
    if (usage.present && (claim == usage.entries.end() || flag_of(claim->field) == false))
      add(dummy_unused, field, sub, fmt::format("[DummyUsage] does not allow {}", name));
    const auto* type = find_type(mapped.index.value());
    if (type != nullptr && type->bits != 0 && type->bits != mapped.bits)
      add(wrong_length, field, sub, fmt::format("{} has {} bits, not {}", name, type->bits, mapped.bits));
  }

  void target(const Field& field, SubIndex sub, const Mapped& mapped) {
    const auto name = to_string(Multiplexer{mapped.index, mapped.sub});
    const auto* object = find_object(subject_.objects, mapped.index);
    if (object == nullptr) {
      if (!is_modular(subject_.file))
        add(no_object, field, sub, fmt::format("{} is not described", to_string(mapped.index)));
      return;
    }
    const bool structured = is_structured(*object);
    const auto* entry = structured ? object->find(mapped.sub) : &object->entry;
    if (entry == nullptr || (!structured && mapped.sub != SubIndex(0))) {
      if (!is_modular(subject_.file)) add(no_object, field, sub, fmt::format("{} is not described", name));
      return;
    }
    if (structured && mapped.sub == SubIndex(0) && pdo_mapping(*entry) == PdoMapping::no)
      return add(head_mapped, field, sub, fmt::format("{} is only the number of sub-objects", name));
    const auto mappable = pdo_mapping(*entry);
    if (mappable == PdoMapping::no) add(not_mappable, field, sub, fmt::format("{} has PDOMapping=0", name));
    const auto type = data_type(*entry);
    const auto* info = type ? find_type(*type) : nullptr;
    if (info != nullptr && info->bits != 0 && info->bits != mapped.bits)
      add(wrong_length, field, sub,
          fmt::format("{} is {} with {} bits, not {}", name, info->name, info->bits, mapped.bits));
    const auto allowed = access(*entry);
    if (!allowed) return;
    if (is_tpdo_ && (*allowed == Access::rww || *allowed == Access::constant))
      add(odd_direction, field, sub, fmt::format("{} is {}", name, shortened(entry->access_type.text)));
    const bool fits =
        is_tpdo_ ? can_be_read(*allowed) && mappable != PdoMapping::rpdo_only
                 : can_be_written(*allowed) && *allowed != Access::rwr && mappable != PdoMapping::tpdo_only;
    if (!fits)
      add(wrong_direction, field, sub,
          fmt::format("{} is {}{}, so it cannot be in {}", name, shortened(entry->access_type.text),
                      subject_.file.is_xml() ? " and mapped as " + shortened(entry->pdo_mapping.text) : "",
                      is_tpdo_ ? "a TPDO" : "an RPDO"));
  }

  const Subject& subject_;
  Finer& finer_;
  const Object& mapping_;
  bool is_tpdo_;
  bool said_gap_ = false;  ///< once for each mapping
  Findings& findings_;
};

void check(const Subject& subject, Findings& findings) {
  Finer entries;
  for (const auto& object : subject.objects) {
    if (is_mapping_parameter(object.index)) Check(subject, object, entries, findings).run();
  }
  if (entries.count > 0)
    findings.add(finer, entries.at,
                 fmt::format("{}, but Granularity is {}; {} entries are like this", entries.first,
                             shortened(subject.file.device_info.granularity.text), entries.count));
}

}  // namespace

constinit const Group mapping_rules{{"PDO mapping", all}, check};

}  // namespace conform::eds
