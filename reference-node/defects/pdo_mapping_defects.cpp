// SPDX-License-Identifier: Apache-2.0
// Defects of mappings: which are taken that should be refused, and what of a mapping is used.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "defects/pdos.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

using Entries = std::vector<Mapped>;

/// What is mapped is another thing than the entries say.
Change uses(PdoRulesPart of, Entries (*other)(const PdoParameters& pdo, Entries counted)) {
  return decides(of, &PdoRules::mapping,
                 [other](const auto& former, const PdoParameters& pdo, const Entries& counted) {
                   return other(pdo, former(pdo, counted));
                 });
}

/// The mapping that a PDO had when it was first looked at stays in use.
Change uses_the_first(PdoRulesPart of) {
  using First = std::map<std::uint16_t, Entries>;
  return decides_by<First>(
      of, &PdoRules::mapping,
      [](First& first, const auto& former, const PdoParameters& pdo, const Entries& counted) {
        return first.try_emplace(pdo.number(), former(pdo, counted)).first->second;
      });
}

Entries without_last(Entries counted) {
  if (counted.size() > 1) counted.pop_back();
  return counted;
}

Entries first_seven(const PdoParameters&, Entries counted) {
  if (counted.size() > 7) counted.resize(7);
  return counted;
}

/// Sub-index 00h takes a mapping of more than 64 bits where `taken` holds for its lengths.
Change takes_too_long(std::uint16_t index, bool (*taken)(const std::vector<unsigned>& bits)) {
  return checking(index, 0, [=](Parts& parts, const Check& former, ByteView bytes) {
    const Accepted right = former(bytes);
    if (right || right.error() != abort_code::mapping_too_long) return right;
    std::vector<unsigned> lengths;
    for (std::uint8_t sub = 1; sub <= bytes[0]; ++sub) {
      if (parts.device.dictionary.entry(index, sub) == nullptr) return right;  // more than there are
      lengths.push_back(Mapped::unpack(parts.device.dictionary.number(index, sub)).bits);
    }
    return taken(lengths) ? Accepted{} : right;
  });
}

bool all_are(const std::vector<unsigned>& bits, unsigned length) {
  return std::ranges::all_of(bits, [length](unsigned one) { return one == length; });
}

/// What `taken` holds for can be mapped, whatever it is.
Change maps_also(PdoRulesPart of, bool (*taken)(const Mapped& mapped)) {
  return decides(of, &PdoRules::mappable, [taken](const auto& former, const Mapped& mapped) {
    return taken(mapped) ? Accepted{} : former(mapped);
  });
}

bool is_communication_object(const Mapped& mapped) {
  return mapped.index >= 0x1000 && mapped.index < 0x2000 && mapped.index != 0x1001;
}

/// An entry that is refused switches the mapping on again, with one object.
Change enables_when_refusing(std::uint16_t index) {
  return checking_all(index, [index](Parts& parts, const Check& former, std::uint8_t, ByteView bytes) {
    const Accepted right = former(bytes);
    Entry* count = parts.device.dictionary.entry(index, 0);
    if (!right && right.error() == abort_code::no_object && count != nullptr) count->value = Bytes{1};
    return right;
  });
}

/// Sub-index 00h takes a count although an entry of it is zero.
Change takes_zero_entries(std::uint16_t index) {
  return checking(index, 0, [index](Parts& parts, const Check& former, ByteView bytes) {
    const Accepted right = former(bytes);
    for (std::uint8_t sub = 1; sub <= bytes[0]; ++sub) {
      const Entry* entry = parts.device.dictionary.entry(index, sub);
      if (entry != nullptr && parts.device.dictionary.number(index, sub) == 0) return Accepted{};
    }
    return right;
  });
}

Change reads_zero_in_operational(std::uint16_t index) {
  return reading(index, 0, [](Parts& parts, const Read& former) -> Upload {
    if (parts.device.state == NmtState::operational) return Bytes{0};
    return former();
  });
}

/// A PDO whose mapping has been switched off goes on with the one it had.
Change keeps_mapping(PdoRulesPart of) {
  using Last = std::map<std::uint16_t, Entries>;
  return decides_by<Last>(
      of, &PdoRules::mapping,
      [](Last& last, const auto& former, const PdoParameters& pdo, const Entries& counted) {
        const Entries right = former(pdo, counted);
        if (!right.empty()) last[pdo.number()] = right;
        return last[pdo.number()];
      });
}

/// What is refused because it cannot be mapped stands in the entry all the same.
Change keeps_refused_entries(std::uint16_t index) {
  return checking_all(index, [index](Parts& parts, const Check& former, std::uint8_t sub, ByteView bytes) {
    const Accepted taken = former(bytes);
    if (!taken && (taken.error() == abort_code::no_object || taken.error() == abort_code::no_sub_index))
      parts.device.dictionary.set_number(index, sub, conform::load_le(bytes));
    return taken;
  });
}

/// A mapping that was stored is shown; the default one is used until a number of mapped objects is written.
void uses_the_default_until_written(Parts& parts) {
  const auto written = written_since_boot_up(parts, {0x1A00, 0x1A01, 0x1A02, 0x1A03});
  parts.pdos.tpdo.parameters.rules.mapping.replace(
      [&parts, written](const auto& former, const PdoParameters& pdo, const Entries& counted) {
        const auto index = static_cast<std::uint16_t>(0x1A00 + pdo.number());
        const ObjectDictionary& od = parts.device.dictionary;
        const Entry* count = od.entry(index, 0);
        if (written->contains(mux(index, 0)) || count == nullptr) return former(pdo, counted);
        Entries defaults;
        for (std::uint8_t sub = 1; sub <= conform::load_le(count->default_value); ++sub) {
          if (const Entry* entry = od.entry(index, sub))
            defaults.push_back(Mapped::unpack(conform::load_le(entry->default_value)));
        }
        return former(pdo, defaults);
      });
}

/// A count of mapped objects is taken if `fits` says so of the bits they make up, too long or not.
Change counts_bits(std::uint16_t first, bool (*fits)(std::size_t bits)) {
  return [first, fits](Parts& parts) {
    for (std::uint16_t index = first; index <= first + last_pdo; ++index) {
      checking(index, 0, [index, fits](Parts& node, const Check& former, ByteView bytes) -> Accepted {
        const Accepted done = former(bytes);
        if (done || done.error() != abort_code::mapping_too_long) return done;
        return fits(bits_held(node.device.dictionary, index, conform::load_le(bytes))) ? Accepted() : done;
      })(parts);
    }
  };
}

/// Placeholders are no part of what is counted.
Change counts_objects_only(std::uint16_t first) {
  return [first](Parts& parts) {
    for (std::uint16_t index = first; index <= first + last_pdo; ++index) {
      checking(index, 0, [index](Parts& node, const Check& former, ByteView bytes) -> Accepted {
        const Accepted done = former(bytes);
        if (done || done.error() != abort_code::mapping_too_long) return done;
        std::size_t bits = 0;
        for (std::uint8_t sub = 1; sub <= bytes[0] && sub <= most_mapped; ++sub) {
          const Mapped mapped = Mapped::unpack(node.device.dictionary.number(index, sub));
          if (mapped.index > 0x1F) bits += mapped.bits;
        }
        return bits_held(node.device.dictionary, index, bytes[0]) > 64 && bits <= 64 ? Accepted() : done;
      })(parts);
    }
  };
}

/// What is received for a placeholder of these types is as long as `bits` says.
Change skips(std::uint16_t signed_type, std::uint16_t unsigned_type, std::uint8_t bits) {
  return decides(rpdo_parameters, &PdoRules::mapping,
                 [=](const auto& former, const PdoParameters& pdo, const std::vector<Mapped>& counted) {
                   std::vector<Mapped> all = former(pdo, counted);
                   for (Mapped& mapped : all) {
                     if (mapped.index == signed_type || mapped.index == unsigned_type) mapped.bits = bits;
                   }
                   return all;
                 });
}

bool is_placeholder(const Mapped& mapped) { return mapped.index <= 0x1F; }

Entries without_placeholders_at_the_end(const PdoParameters&, Entries counted) {
  while (!counted.empty() && is_placeholder(counted.back())) counted.pop_back();
  return counted;
}

Entries with_one_placeholder(const PdoParameters&, Entries counted) {
  bool seen = false;
  std::erase_if(counted,
                [&](const Mapped& mapped) { return is_placeholder(mapped) && std::exchange(seen, true); });
  return counted;
}

/// A sub-index that an object does not have is taken for one of eight bits.
Change maps_absent_sub_indices(PdoRulesPart of) {
  return [of](Parts& parts) {
    of(parts).mappable.replace([&parts](const auto& former, const Mapped& mapped) {
      const ObjectDictionary& od = parts.device.dictionary;
      const bool absent =
          od.objects().contains(mapped.index) && od.entry(mapped.index, mapped.sub) == nullptr;
      return absent && mapped.bits == 8 ? Accepted{} : former(mapped);
    });
  };
}

/// No length passes for every length.
Change maps_without_length(PdoRulesPart of) {
  return [of](Parts& parts) {
    of(parts).mappable.replace([&parts](const auto& former, Mapped mapped) {
      const Entry* entry = parts.device.dictionary.entry(mapped.index, mapped.sub);
      if (entry != nullptr && mapped.bits == 0)
        mapped.bits = static_cast<std::uint8_t>(entry->value.size() * 8);
      return former(mapped);
    });
  };
}

/// What the last entry names is looked at neither when it is written nor when the mapping is enabled.
Change leaves_the_last_entry_unchecked(PdoRulesPart of, std::uint16_t first_mapping) {
  return [of, first_mapping](Parts& parts) {
    constexpr std::uint8_t last_entry = 8;
    const auto taken = std::make_shared<std::set<std::uint64_t>>();
    for (std::uint16_t number = 0; number <= last_pdo; ++number) {
      const auto mapping = static_cast<std::uint16_t>(first_mapping + number);
      checking(mapping, last_entry, [=](Parts& node, const Check& former, ByteView bytes) {
        if (node.device.dictionary.number(mapping, 0) != 0) return former(bytes);
        taken->insert(conform::load_le(bytes));
        return Accepted{};
      })(parts);
    }
    of(parts).mappable.replace([taken](const auto& former, const Mapped& mapped) {
      const auto packed =
          (std::uint64_t{mapped.index} << 16U) | (std::uint64_t{mapped.sub} << 8U) | mapped.bits;
      return taken->contains(packed) ? Accepted{} : former(mapped);
    });
  };
}

/// Whether a mapping can be changed is asked of the first PDO of the direction.
Change locked_by_the_first(PdoRulesPart of, std::uint16_t first_communication) {
  return [of, first_communication](Parts& parts) {
    of(parts).locked.replace([&parts, first_communication](const auto& former, const PdoParameters& pdo,
                                                           PdoPart part, bool, bool enabled) {
      const auto cob_id = parts.device.dictionary.number(first_communication, 1);
      return former(pdo, part, (cob_id & 0x8000'0000U) == 0, enabled);
    });
  };
}

}  // namespace

DefectTable pdo_mapping_defects() {
  return {
      {"rpdo-uses-first-mapping",
       "RPDOs go on with the mapping they had at first",
       {"PDO-RX-01"},
       uses_the_first(rpdo_parameters)},
      {"tpdo-uses-first-mapping",
       "TPDOs go on with the mapping they had at first",
       {"PDO-TX-01"},
       uses_the_first(tpdo_parameters)},
      {"rpdo-last-mapped-object-lost",
       "The last object that is mapped to an RPDO is not written",
       {"PDO-RX-01"},
       uses(rpdo_parameters, [](const PdoParameters&, Entries counted) { return without_last(counted); })},
      {"tpdo-last-mapped-object-lost",
       "The last object that is mapped to a TPDO is not sent",
       {"PDO-TX-01"},
       uses(tpdo_parameters, [](const PdoParameters&, Entries counted) { return without_last(counted); })},
      {"rpdo-eighth-mapped-object-lost",
       "Of eight objects that are mapped to an RPDO seven are written",
       {"PDO-RX-01"},
       uses(rpdo_parameters, first_seven)},
      {"tpdo-eighth-mapped-object-lost",
       "Of eight objects that are mapped to a TPDO seven are sent",
       {"PDO-TX-01"},
       uses(tpdo_parameters, first_seven)},
      {"rpdo-last-has-objects-swapped",
       "The last RPDO writes its objects in the reverse order",
       {"PDO-RX-01"},
       uses(rpdo_parameters,
            [](const PdoParameters& pdo, Entries counted) {
              if (pdo.number() == last_pdo) std::ranges::reverse(counted);
              return counted;
            })},
      {"tpdo-last-has-objects-swapped",
       "The last TPDO sends its objects in the reverse order",
       {"PDO-TX-01"},
       uses(tpdo_parameters,
            [](const PdoParameters& pdo, Entries counted) {
              if (pdo.number() == last_pdo) std::ranges::reverse(counted);
              return counted;
            })},
      {"1600-nine-bytes-accepted",
       "Nine objects of 8 bits are accepted in an RPDO",
       {"OD-1600-09"},
       Change([](Parts& parts) {
         if (!parts.device.dictionary.objects().contains(0x1600)) return;
         // As many entries as a device with a mapping of 64 single bits would have.
         for (std::uint8_t sub = 9; sub <= 16; ++sub)
           parts.device.dictionary.add_sub(
               0x1600, sub, integer_entry("Mapped object", DataType::unsigned32, Access::rw, 0));
         takes_too_long(0x1600, [](const std::vector<unsigned>& bits) { return all_are(bits, 8); })(parts);
       })},
      {"1600-five-words-accepted",
       "Five objects of 16 bits are accepted in an RPDO",
       {"OD-1600-09"},
       takes_too_long(0x1600, [](const std::vector<unsigned>& bits) { return all_are(bits, 16); })},
      {"1600-three-long-words-accepted",
       "Three objects of 32 bits are accepted in an RPDO",
       {"OD-1600-09"},
       takes_too_long(0x1600, [](const std::vector<unsigned>& bits) { return all_are(bits, 32); })},
      {"1a00-five-words-accepted",
       "Five objects of 16 bits are accepted in a TPDO",
       {"OD-1A00-09"},
       takes_too_long(0x1A00, [](const std::vector<unsigned>& bits) { return all_are(bits, 16); })},
      {"1a00-three-long-words-accepted",
       "Three objects of 32 bits are accepted in a TPDO",
       {"OD-1A00-09"},
       takes_too_long(0x1A00, [](const std::vector<unsigned>& bits) { return all_are(bits, 32); })},
      {"1603-overlong-mapping-accepted",
       "A mapping of more than 64 bits is accepted in the last RPDO",
       {"OD-1600-09"},
       takes_count(0x1603, CountThat::exceeds_64_bits)},
      {"1a03-overlong-mapping-accepted",
       "A mapping of more than 64 bits is accepted in the last TPDO",
       {"OD-1A00-09"},
       takes_count(0x1A03, CountThat::exceeds_64_bits)},
      {"1603-reserved-count-accepted",
       "1603h:00 accepts any number",
       {"OD-1600-10"},
       takes_count(0x1603, CountThat::exceeds_the_entries)},
      {"1a03-reserved-count-accepted",
       "1A03h:00 accepts any number",
       {"OD-1A00-10"},
       takes_count(0x1A03, CountThat::exceeds_the_entries)},
      {"1600-last-entry-not-stored",
       "The last entry of 1600h is confirmed and not stored",
       {"OD-1600-05"},
       not_stored(0x1600, 8)},
      {"1a03-last-entry-not-stored",
       "The last entry of 1A03h is confirmed and not stored",
       {"OD-1A00-05"},
       not_stored(0x1A03, 8)},
      {"1603-entry-writable-while-enabled",
       "Entries of 1603h can be changed while the mapping is enabled",
       {"OD-1600-11"},
       unlocked(rpdo_parameters, PdoPart::mapped_object, last_pdo)},
      {"1a03-entry-writable-while-enabled",
       "Entries of 1A03h can be changed while the mapping is enabled",
       {"OD-1A00-11"},
       unlocked(tpdo_parameters, PdoPart::mapped_object, last_pdo)},
      {"1603-mapping-writable-while-valid",
       "1603h:00 can be changed while the last RPDO is valid",
       {"OD-1600-12"},
       unlocked(rpdo_parameters, PdoPart::mapping, last_pdo)},
      {"1a03-mapping-writable-while-valid",
       "1A03h:00 can be changed while the last TPDO is valid",
       {"OD-1A00-12"},
       unlocked(tpdo_parameters, PdoPart::mapping, last_pdo)},
      {"1600-communication-object-mapped",
       "Communication objects can be mapped to an RPDO",
       {"OD-MAP-02", "OD-1600-07"},
       maps_also(rpdo_parameters, is_communication_object)},
      {"1a00-communication-object-mapped",
       "Communication objects can be mapped to a TPDO",
       {"OD-MAP-01", "OD-1A00-07"},
       maps_also(tpdo_parameters, is_communication_object)},
      {"1600-error-register-mapped",
       "The error register can be mapped to an RPDO",
       {"OD-MAP-04"},
       maps_also(rpdo_parameters, [](const Mapped& mapped) { return mapped.index == 0x1001; })},
      {"1a00-error-register-wrong-abort",
       "The error register is refused in a TPDO with a general error",
       {"OD-MAP-03"},
       decides(tpdo_parameters, &PdoRules::mappable,
               [](const auto& former, const Mapped& mapped) {
                 return mapped.index == 0x1001 ? refuse(abort_code::general_error) : former(mapped);
               })},
      {"1602-default-mapping-too-long",
       "The default mapping of the third RPDO has 72 bits",
       {"OD-1600-03"},
       both(preset(0x1602, 3, 0x64120220), preset(0x1602, 0, 3))},
      {"1a02-default-mapping-too-long",
       "The default mapping of the third TPDO has 72 bits",
       {"OD-1A00-03"},
       both(preset(0x1A02, 3, 0x64020220), preset(0x1A02, 0, 3))},
      {"1600-enabled-by-refusal",
       "An entry that is refused switches the mapping of the RPDO on again",
       {"OD-1600-13"},
       enables_when_refusing(0x1600)},
      {"1a00-enabled-by-refusal",
       "An entry that is refused switches the mapping of the TPDO on again",
       {"OD-1A00-13"},
       enables_when_refusing(0x1A00)},
      {"1600-zero-entry-accepted",
       "A mapping of an RPDO with an entry of zero is accepted",
       {"PDO-MAP-14", "OD-1600-10"},
       takes_zero_entries(0x1600)},
      {"1a00-zero-entry-accepted",
       "A mapping of a TPDO with an entry of zero is accepted",
       {"PDO-MAP-14", "OD-1A00-10"},
       takes_zero_entries(0x1A00)},
      {"tpdo-sent-without-mapping",
       "A TPDO whose mapping was switched off is sent with the data it had before",
       {"PDO-MAP-20"},
       keeps_mapping(tpdo_parameters)},
      {"1600-procedure-ignored-in-operational",
       "In Operational sub-index 00h of the mappings of RPDOs reads as 0, whatever was written",
       {"PDO-MAP-22"},
       together(reads_zero_in_operational(0x1600), reads_zero_in_operational(0x1601),
                reads_zero_in_operational(0x1602), reads_zero_in_operational(0x1603))},
      {"rpdo-boolean-placeholder-accepted",
       "The data type BOOLEAN can be mapped to an RPDO, although it is not declared as a placeholder",
       {"PDO-MAP-16"},
       Change([](Parts& parts) { parts.pdos.rpdo.parameters.placeholders[1] = true; })},
      {"rpdo-placeholder-takes-no-room",
       "A placeholder in an RPDO skips no bytes",
       {"PDO-MAP-15"},
       uses(rpdo_parameters,
            [](const PdoParameters&, Entries counted) {
              std::erase_if(counted, [](const Mapped& mapped) { return mapped.index < 0x20; });
              return counted;
            })},
      {"rpdo-declared-placeholder-refused",
       "UNSIGNED8 cannot be mapped to an RPDO, although it is declared as a placeholder",
       {"PDO-MAP-15"},
       Change([](Parts& parts) { parts.pdos.rpdo.parameters.placeholders[5] = false; })},
      {"1a00-refused-entry-kept",
       "A mapping entry that is refused because its object is absent is stored all the same",
       {"OD-ACC-05"},
       keeps_refused_entries(0x1A00)},
      {"1a00-stored-mapping-not-used",
       "TPDOs are sent with the default mapping until 1A00h:00 is written, whatever was stored",
       {"OD-RST-04"},
       Change(uses_the_default_until_written)},
      {"1a00-bits-counted-in-8-bits",
       "The bits that are mapped to a TPDO are counted in eight bits: 256 are none",
       {"OD-1A00-09"},
       counts_bits(0x1A00, [](std::size_t bits) { return bits % 256 <= 64; })},
      {"1600-bits-counted-in-8-bits",
       "The bits that are mapped to an RPDO are counted in eight bits: 256 are none",
       {"OD-1600-09"},
       counts_bits(0x1600, [](std::size_t bits) { return bits % 256 <= 64; })},
      {"1a00-72-bits-taken",
       "A mapping of nine bytes is taken for a TPDO",
       {"OD-1A00-09"},
       counts_bits(0x1A00, [](std::size_t bits) { return bits <= 72; })},
      {"1600-72-bits-taken",
       "A mapping of nine bytes is taken for an RPDO",
       {"OD-1600-09"},
       counts_bits(0x1600, [](std::size_t bits) { return bits <= 72; })},
      {"1600-placeholders-not-counted",
       "Placeholders do not count for the 64 bits of an RPDO",
       {"OD-1600-09"},
       counts_objects_only(0x1600)},
      {"rpdo-placeholder-of-16-bits-skips-8",
       "A placeholder of 16 bits skips one byte of an RPDO",
       {"PDO-MAP-15"},
       skips(0x0003, 0x0006, 8)},
      {"rpdo-placeholder-of-32-bits-skips-16",
       "A placeholder of 32 bits skips two bytes of an RPDO",
       {"PDO-MAP-15"},
       skips(0x0004, 0x0007, 16)},
      {"rpdo-placeholder-integer8-skips-nothing",
       "The placeholder INTEGER8 skips no byte of an RPDO",
       {"PDO-MAP-15"},
       skips(0x0002, 0x0002, 0)},
      {"rpdo-placeholder-at-the-end-not-counted",
       "Placeholders at the end of the mapping of an RPDO do not count for its length",
       {"PDO-RX-06"},
       uses(rpdo_parameters, without_placeholders_at_the_end)},
      {"rpdo-second-placeholder-skips-nothing",
       "Of several placeholders in the mapping of an RPDO the first one is skipped only",
       {"PDO-MAP-15"},
       uses(rpdo_parameters, with_one_placeholder)},
      {"1600-absent-sub-index-of-one-byte",
       "A sub-index that an object does not have can be mapped to an RPDO as one byte",
       {"PDO-MAP-05"},
       maps_absent_sub_indices(rpdo_parameters)},
      {"1a00-absent-sub-index-of-one-byte",
       "A sub-index that an object does not have can be mapped to a TPDO as one byte",
       {"PDO-MAP-05"},
       maps_absent_sub_indices(tpdo_parameters)},
      {"1600-entry-without-length",
       "An entry with length 0 of an object can be mapped to an RPDO",
       {"PDO-MAP-10"},
       maps_without_length(rpdo_parameters)},
      {"1a00-entry-without-length",
       "An entry with length 0 of an object can be mapped to a TPDO",
       {"PDO-MAP-10"},
       maps_without_length(tpdo_parameters)},
      {"1600-last-entry-not-checked",
       "The eighth entry of the mapping of an RPDO may name what does not exist",
       {"OD-1600-06"},
       leaves_the_last_entry_unchecked(rpdo_parameters, 0x1600)},
      {"1a00-last-entry-not-checked",
       "The eighth entry of the mapping of a TPDO may name what does not exist",
       {"OD-1A00-06"},
       leaves_the_last_entry_unchecked(tpdo_parameters, 0x1A00)},
      {"1600-mapping-locked-by-the-first",
       "The mapping of an RPDO can be changed while the first RPDO is not valid",
       {"OD-1600-12"},
       locked_by_the_first(rpdo_parameters, 0x1400)},
      {"1a00-mapping-locked-by-the-first",
       "The mapping of a TPDO can be changed while the first TPDO is not valid",
       {"OD-1A00-12"},
       locked_by_the_first(tpdo_parameters, 0x1800)},
  };
}

}  // namespace refnode
