// SPDX-License-Identifier: Apache-2.0
#include "defects/pdos.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>

#include "pdo/bits.hpp"

namespace refnode::defect {

std::shared_ptr<std::map<std::uint16_t, std::uint64_t>> written_ever(Parts& parts, std::uint16_t first,
                                                                     std::uint8_t sub, std::uint16_t count) {
  const auto written = std::make_shared<std::map<std::uint16_t, std::uint64_t>>();
  for (std::uint16_t number = 0; number < count; ++number) {
    const std::uint16_t index = nth(first, number);
    after_writing(index, sub, [=](Parts& node, const std::function<void()>& former) {
      (*written)[number] = node.device.dictionary.number(index, sub);
      former();
    })(parts);
  }
  return written;
}

Change unlocked(PdoRulesPart of, PdoPart part) {
  return decides(of, &PdoRules::locked,
                 [part](const auto& former, const PdoParameters& pdo, PdoPart which, bool valid,
                        bool enabled) { return which != part && former(pdo, which, valid, enabled); });
}

Change unlocked(PdoRulesPart of, PdoPart part, std::uint16_t number) {
  return decides_for(number, of, &PdoRules::locked,
                     [part](const auto& former, const PdoParameters& pdo, PdoPart which, bool valid,
                            bool enabled) { return which != part && former(pdo, which, valid, enabled); });
}

Change maps_absent_objects(PdoRulesPart of) {
  return decides(of, &PdoRules::mappable, [](const auto& former, const Mapped& mapped) {
    const Accepted allowed = former(mapped);
    return !allowed && allowed.error() == abort_code::no_object ? Accepted{} : allowed;
  });
}

Change maps_any_length(PdoRulesPart of) {
  return [of](Parts& parts) {
    of(parts).mappable.replace([&parts](const auto& former, Mapped mapped) {
      const Entry* entry = parts.device.dictionary.entry(mapped.index, mapped.sub);
      if (entry != nullptr) mapped.bits = static_cast<std::uint8_t>(entry->value.size() * 8);
      return former(mapped);
    });
  };
}

Change takes_count(std::uint16_t index, CountThat too_large) {
  return checking(index, 0, [=](Parts& parts, const Check& former, ByteView bytes) {
    const Accepted taken = former(bytes);
    const bool there = parts.device.dictionary.entry(index, bytes[0]) != nullptr;
    const CountThat reason = there ? CountThat::exceeds_64_bits : CountThat::exceeds_the_entries;
    const bool too_long = !taken && taken.error() == abort_code::mapping_too_long;
    return too_long && reason == too_large ? Accepted{} : taken;
  });
}

namespace {

/// Changes what a frame carries, one mapped object after the other; `communication` is of its PDO.
void change_values(const ObjectDictionary& od, std::uint16_t communication, Frame& frame,
                   ValueChange change) {
  const auto mapping = static_cast<std::uint16_t>(communication + 0x200);
  const std::span<std::uint8_t> data = std::span(frame.data).first(frame.size());
  std::size_t position = 0;  // in bits
  for (std::uint8_t sub = 1; sub <= od.number(mapping, 0) && sub <= most_mapped; ++sub) {
    const Mapped mapped = Mapped::unpack(od.number(mapping, sub));
    if (position + mapped.bits > data.size() * 8) break;
    const Entry* entry = od.entry(mapped.index, mapped.sub);
    if (entry != nullptr) {
      Bytes value(whole_bytes(mapped.bits));
      copy_bits(data, position, value, 0, mapped.bits);
      change(*entry, value);
      value.resize(whole_bytes(mapped.bits));
      copy_bits(value, 0, data, position, mapped.bits);
    }
    position += mapped.bits;
  }
}

}  // namespace

std::optional<std::uint16_t> rpdo_with(const ObjectDictionary& od, std::uint32_t can_id) {
  for (std::uint16_t number = 0; number <= last_pdo; ++number) {
    if ((od.number(rpdo_communication(number), 1, 0x8000'0000U) & 0x8000'07FFU) == can_id) return number;
  }
  return std::nullopt;
}

std::size_t bits_held(const ObjectDictionary& od, std::uint16_t mapping, std::uint64_t count) {
  std::size_t bits = 0;
  for (std::uint8_t sub = 1; sub <= count && sub <= most_mapped; ++sub)
    bits += od.number(mapping, sub) & 0xFFU;
  return bits;
}

namespace {

/// The PDO that a frame belongs to may be any one of its direction.
void change_values_of(Parts& parts, PdoDirection direction, Frame& frame, ValueChange change) {
  const ObjectDictionary& od = parts.device.dictionary;
  const std::uint16_t first = first_communication_index(direction);
  for (auto object = od.objects().lower_bound(first);
       object != od.objects().end() && object->first < first + pdos_of_a_direction; ++object) {
    if (frame.id == (od.number(object->first, 1) & 0x7FFU)) change_values(od, object->first, frame, change);
  }
}

}  // namespace

void reversed(const Entry&, Bytes& value) { std::ranges::reverse(value); }

Change receives_values(ValueChange as) {
  return misreads(
      [as](Parts& parts, Frame& frame) { change_values_of(parts, PdoDirection::receive, frame, as); });
}

Change sends_values(ValueChange as) {
  return [as](Parts& parts) {
    parts.device.outbox.add_filter([&parts, as](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service != Service::tpdo) return;
      for (Outgoing& outgoing : frames) change_values_of(parts, PdoDirection::transmit, outgoing.frame, as);
    });
  };
}

}  // namespace refnode::defect
