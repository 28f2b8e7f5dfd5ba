// SPDX-License-Identifier: Apache-2.0
#include "variants/tools.hpp"

#include <vector>

namespace refnode::variant {

How absent(std::initializer_list<std::uint16_t> indices) {
  return [all = std::vector<std::uint16_t>(indices)](Parts& parts) {
    for (const std::uint16_t index : all) parts.device.dictionary.remove(index);
  };
}

How absent_from(std::uint16_t index, std::uint8_t first) {
  return [index, first](Parts& parts) {
    const auto found = parts.device.dictionary.objects().find(index);
    if (found == parts.device.dictionary.objects().end()) return;
    auto& entries = found->second.entries;
    std::erase_if(entries,
                  [first](const auto& entry) { return entry.first >= first && entry.first != 0xFF; });
    Entry* highest = parts.device.dictionary.entry(index, 0);
    // 1003h, 16xxh: something else is counted there.
    if (highest == nullptr || highest->access != Access::constant) return;
    std::uint8_t last = 0;
    for (const auto& [sub, entry] : entries) last = sub == 0xFF ? last : sub;
    highest->value = highest->default_value = Bytes{last};
  };
}

How gap(std::uint16_t index, std::uint8_t sub) {
  return [index, sub](Parts& parts) { parts.device.dictionary.remove_sub(index, sub); };
}

How access(std::uint16_t index, std::uint8_t sub, Access access) {
  return [index, sub, access](Parts& parts) {
    if (Entry* entry = parts.device.dictionary.entry(index, sub)) entry->access = access;
  };
}

How access_all(std::uint16_t index, Access from, Access to) {
  return [index, from, to](Parts& parts) {
    const auto found = parts.device.dictionary.objects().find(index);
    if (found == parts.device.dictionary.objects().end()) return;
    for (auto& [sub, entry] : found->second.entries) {
      if (entry.access == from) entry.access = to;
    }
  };
}

How also_checked(std::uint16_t index, std::uint8_t sub,
                 std::function<Accepted(const Parts&, ByteView)> condition) {
  return [index, sub, condition = std::move(condition)](Parts& parts) {
    Entry* entry = parts.device.dictionary.entry(index, sub);
    if (entry == nullptr) return;
    entry->check = [&parts, condition, former = std::move(entry->check)](ByteView bytes) -> Accepted {
      if (const Accepted good = condition(parts, bytes); !good) return good;
      return former ? former(bytes) : Accepted{};
    };
  };
}

How preset(std::uint16_t index, std::uint8_t sub, std::uint64_t value) {
  return [index, sub, value](Parts& parts) {
    Entry* entry = parts.device.dictionary.entry(index, sub);
    if (entry == nullptr) return;
    conform::store_le(entry->value, value);
    entry->default_value = entry->value;
    entry->adds_node_id = false;
  };
}

How preset_with_node_id(std::uint16_t index, std::uint8_t sub, std::uint64_t value) {
  return [index, sub, value](Parts& parts) {
    preset(index, sub, value + parts.device.node_id)(parts);
    if (Entry* entry = parts.device.dictionary.entry(index, sub)) entry->adds_node_id = true;
  };
}

How text(std::uint16_t index, std::string_view value) {
  return [index, value](Parts& parts) {
    if (Entry* entry = parts.device.dictionary.entry(index, 0)) {
      entry->value = entry->default_value = Bytes(value.begin(), value.end());
      entry->max_size = value.size();
    }
  };
}

How both(How first, How second) {
  return [first = std::move(first), second = std::move(second)](Parts& parts) {
    first(parts);
    second(parts);
  };
}

How late(Service service, Duration by) {
  return [service, by](Parts& parts) {
    // An error may be what ends the state: its EMCY is still told.
    const auto changed = std::make_shared<BusTime>();
    parts.nmt.on_change = [&parts, changed, former = parts.nmt.on_change](NmtState from) {
      *changed = parts.device.now;
      former(from);
    };
    parts.device.outbox.add_filter([service, by, changed, &device = parts.device](
                                       const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service != service) return;
      for (Outgoing& outgoing : frames) {
        outgoing.delay += by;
        outgoing.still_wanted = [service, changed, &device, sent = context.now] {
          return device.works_now(service) || *changed == sent;
        };
      }
    });
  };
}

How choose_of_pdos(void (*change)(PdoChoices&)) {
  return [change](Parts& parts) {
    change(parts.pdos.rpdo.parameters.choices);
    change(parts.pdos.tpdo.parameters.choices);
  };
}

}  // namespace refnode::variant
