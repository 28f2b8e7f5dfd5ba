// SPDX-License-Identifier: Apache-2.0
#include "defects/tools.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace refnode::defect {

void append(DefectTable& rows, DefectTable part) {
  rows.insert(rows.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
}

DictionaryEdit absent(std::uint16_t index) {
  return [index](ObjectDictionary& od, std::uint8_t) { od.remove(index); };
}

DictionaryEdit absent_sub(std::uint16_t index, std::uint8_t sub) {
  return [index, sub](ObjectDictionary& od, std::uint8_t) { od.remove_sub(index, sub); };
}

DictionaryEdit access(std::uint16_t index, std::uint8_t sub, Access access) {
  return [index, sub, access](ObjectDictionary& od, std::uint8_t) {
    if (Entry* entry = od.entry(index, sub)) entry->access = access;
  };
}

DictionaryEdit type(std::uint16_t index, std::uint8_t sub, DataType type) {
  return [index, sub, type](ObjectDictionary& od, std::uint8_t) {
    Entry* entry = od.entry(index, sub);
    if (entry == nullptr) return;
    entry->type = type;
    entry->value.resize(fixed_size(type));
    entry->default_value.resize(fixed_size(type));
    if (entry->read) {
      entry->read = [read = entry->read, type]() -> Upload {
        Upload value = read();
        if (value) value->resize(fixed_size(type));
        return value;
      };
    }
  };
}

DictionaryEdit preset(std::uint16_t index, std::uint8_t sub, std::uint64_t value) {
  return [index, sub, value](ObjectDictionary& od, std::uint8_t) {
    if (Entry* entry = od.entry(index, sub)) {
      conform::store_le(entry->value, value);
      entry->default_value = entry->value;
      entry->adds_node_id = false;
    }
  };
}

DictionaryEdit preset_with_node_id(std::uint16_t index, std::uint8_t sub, std::uint64_t value) {
  return [index, sub, value](ObjectDictionary& od, std::uint8_t node_id) {
    preset(index, sub, value + node_id)(od, node_id);
    if (Entry* entry = od.entry(index, sub)) entry->adds_node_id = true;
  };
}

DictionaryEdit bytes(std::uint16_t index, std::uint8_t sub, Bytes value) {
  return [index, sub, value = std::move(value)](ObjectDictionary& od, std::uint8_t) {
    if (Entry* entry = od.entry(index, sub)) entry->value = entry->default_value = value;
  };
}

DictionaryEdit extra(std::uint16_t index, std::uint8_t sub, Entry entry) {
  return [index, sub, entry = std::move(entry)](ObjectDictionary& od, std::uint8_t) {
    od.objects()[index].entries[sub] = entry;
  };
}

DictionaryEdit not_stored(std::uint16_t index, std::uint8_t sub) {
  return [index, sub](ObjectDictionary& od, std::uint8_t) {
    if (Entry* entry = od.entry(index, sub)) entry->command = true;
  };
}

DictionaryEdit everywhere(void (*change)(Entry&)) {
  return [change](ObjectDictionary& od, std::uint8_t) {
    for (auto& [index, object] : od.objects()) {
      for (auto& [sub, entry] : object.entries) change(entry);
    }
  };
}

DictionaryEdit both(DictionaryEdit first, DictionaryEdit second) {
  return [first = std::move(first), second = std::move(second)](ObjectDictionary& od, std::uint8_t node_id) {
    first(od, node_id);
    second(od, node_id);
  };
}

namespace {

// Runs `change` on the data of every SDO response for which `when` holds.
template <typename When, typename Change>
Filter on_response(When when, Change change) {
  return [when, change](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.sdo == nullptr || !when(*context.sdo)) return;
    for (Outgoing& outgoing : frames) change(*context.sdo, outgoing.frame.data);
  };
}

void put_code(std::array<std::uint8_t, 8>& data, AbortCode code) {
  conform::store_le(std::span(data).subspan(4), code.value());
}

}  // namespace

Filter wrong_abort(AbortCode right, AbortCode wrong, Range range) {
  return on_response(
      [right, range](const SdoExchange& exchange) {
        return exchange.aborted == right && exchange.index() >= range.first &&
               exchange.index() <= range.second;
      },
      [wrong](const SdoExchange&, std::array<std::uint8_t, 8>& data) { put_code(data, wrong); });
}

Filter wrong_abort_at(Multiplexer mux, AbortCode right, AbortCode wrong) {
  return on_response(
      [right, mux](const SdoExchange& exchange) { return exchange.aborted == right && exchange.mux == mux; },
      [wrong](const SdoExchange&, std::array<std::uint8_t, 8>& data) { put_code(data, wrong); });
}

Filter silent(Condition when) {
  return [when](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.sdo != nullptr && when(*context.sdo)) frames.clear();
  };
}

Filter respond(Condition when, std::uint8_t command, std::uint32_t data) {
  return on_response(when, [command, data](const SdoExchange&, std::array<std::uint8_t, 8>& bytes) {
    bytes[0] = command;
    conform::store_le(std::span(bytes).subspan(4), data);
  });
}

Filter patch(Condition when, void (*change)(const SdoExchange&, std::array<std::uint8_t, 8>& data)) {
  return on_response(when, change);
}

Filter reshape(Service service, void (*change)(const FilterContext&, Frame&)) {
  return [service, change](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != service) return;
    for (Outgoing& outgoing : frames) change(context, outgoing.frame);
  };
}

Filter mute(Service service, NmtState state) {
  return [service, state](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == service && context.state == state) frames.clear();
  };
}

Filter repeat(Service service) {
  return [service](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == service && !frames.empty()) frames.push_back(frames.back());
  };
}

}  // namespace refnode::defect
