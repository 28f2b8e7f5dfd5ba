// SPDX-License-Identifier: Apache-2.0
#include "engine/discovery.hpp"

#include <algorithm>
#include <chrono>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "device/standard_objects.hpp"

namespace conform::engine {
namespace {

using Kind = steps::SdoAnswer::Kind;

/// An abort that says "not here"; every other answer shows that the entry exists.
bool says_absent(const steps::SdoAnswer& answer) {
  return answer.kind == Kind::aborted &&
         (answer.code == canopen::abort::no_object || answer.code == canopen::abort::no_sub_index);
}

/// Arrays of the standard go on beyond what the dictionary lists; sub-index 00h tells how far (1003h: a count
/// that changes).
void extend_array(device::Dictionary& out, Index index, std::uint8_t highest) {
  if (index == Index(0x1003) || highest > 0x7F) return;
  for (int sub = 2; sub <= highest; ++sub) {
    const Multiplexer mux{index, SubIndex(static_cast<std::uint8_t>(sub))};
    if (out.has(mux)) continue;
    if (auto entry = device::standard_entry(mux)) out.add(*entry);
  }
}

}  // namespace

/// Looks at an entry. A device that answers nothing any more would cost a time-out for each of the entries
/// that follow; one that is only starting has its time, and is asked again.
Result<steps::SdoAnswer> look(RunSession& session, Multiplexer object, const Means& means) {
  auto answer = session.glance(object);
  if (!answer || answer->kind != Kind::silence) return answer;
  auto life = look_for_life(session, means);
  if (!life) return std::unexpected(life.error());
  if (life->life != Alive::answers)
    return fail("the device fell silent when " + to_string(object) + " was looked for", {}, life->tried);
  if (life->at_once) return answer;
  answer = session.glance(object);
  if (!answer || answer->kind != Kind::silence) return answer;
  life = look_for_life(session, means);
  if (!life) return std::unexpected(life.error());
  if (life->life != Alive::answers)
    return fail("the device falls silent when " + to_string(object) + " is looked for", {}, life->tried);
  return answer;
}

Result<Discovery> discover(RunSession& session, Survey& survey, const Means& means,
                           std::optional<BusTime> until) {
  Discovery out;
  auto& known = session.known();
  session.forget_presence();
  // ObjFlags of the description keep a look off some entries: they count as there, and are left alone.
  for (const auto& entry : known.entries()) {
    if (entry.not_to_be_read) session.note_present(entry.mux, true);
  }
  const auto is_time = [&] { return !until || session.now() < *until; };
  const auto leave_out = [&](const device::Entry& entry) {
    ++out.not_looked_at;
    if (entry.presence() == device::Presence::unclaimed) known.remove(entry.mux);
  };
  // An absent object answers for all of its sub-indices.
  for (const auto index : known.objects()) {
    const auto entries = [&known, index] {
      return std::vector<device::Entry>(known.object(index).begin(), known.object(index).end());
    };
    const Multiplexer first{index, SubIndex(0)};
    if (const auto* entry = known.find(first); entry != nullptr && entry->not_to_be_read) continue;
    if (!is_time()) {
      std::ranges::for_each(entries(), leave_out);
      continue;
    }
    auto answer = look(session, first, means);
    if (!answer) return std::unexpected(answer.error());
    survey.note(first, *answer);
    if (answer->kind == Kind::silence) out.silent.push_back(first);
    const bool absent = answer->kind == Kind::aborted && answer->code == canopen::abort::no_object;
    const auto why = [](const steps::SdoAnswer& each) {
      return says_absent(each) ? "abort " + canopen::describe(each.code) : std::string();
    };
    session.note_present(first, !says_absent(*answer), why(*answer));
    if (absent) {
      for (const auto& entry : entries()) {
        session.note_present(entry.mux, false, why(*answer));
        survey.note_absent(entry.mux, *answer);
        if (entry.presence() != device::Presence::claimed) known.remove(entry.mux);
      }
      continue;
    }
    if (answer->kind == Kind::confirmed && answer->data.size() == 1) {
      extend_array(known, index, answer->data[0]);
    }
    for (const auto& entry : entries()) {
      if (entry.mux == first && known.has(first)) continue;
      if (entry.not_to_be_read) continue;
      if (!is_time()) {
        leave_out(entry);
        continue;
      }
      auto each = look(session, entry.mux, means);
      if (!each) return std::unexpected(each.error());
      survey.note(entry.mux, *each);
      if (each->kind == Kind::silence) out.silent.push_back(entry.mux);
      const bool gone = says_absent(*each);
      session.note_present(entry.mux, !gone, why(*each));
      if (gone && entry.presence() != device::Presence::claimed) known.remove(entry.mux);
    }
  }
  auto emcy = session.peek({Index(0x1014), SubIndex(0)});
  if (!emcy) return std::unexpected(emcy.error());
  if (emcy->kind == Kind::confirmed && emcy->data.size() == 4) {
    session.set_home_emcy_can_id(canopen::can_id_of(CobId(static_cast<std::uint32_t>(load_le(emcy->data)))));
  }
  return out;
}

Result<std::vector<result::Property>> device_properties(RunSession& session) {
  struct Row {
    const char* name;
    Multiplexer object;
    bool text;
  };
  static constexpr Row rows[] = {
      {"dut.device_type", {Index(0x1000), SubIndex(0)}, false},
      {"dut.vendor_id", {Index(0x1018), SubIndex(1)}, false},
      {"dut.product_code", {Index(0x1018), SubIndex(2)}, false},
      {"dut.revision", {Index(0x1018), SubIndex(3)}, false},
      {"dut.serial", {Index(0x1018), SubIndex(4)}, false},
      {"dut.name", {Index(0x1008), SubIndex(0)}, true},
      {"dut.hardware_version", {Index(0x1009), SubIndex(0)}, true},
      {"dut.software_version", {Index(0x100A), SubIndex(0)}, true},
  };
  std::vector<result::Property> out;
  out.push_back({"dut.node_id", std::to_string(session.node().value())});
  for (const auto& row : rows) {
    auto present = session.is_present(row.object, false);
    if (!present && session.recorder().fault()) return std::unexpected(present.error());
    if (!present || !*present) continue;
    auto answer = session.peek(row.object);
    if (!answer) return std::unexpected(answer.error());
    if (answer->kind != Kind::confirmed) continue;
    out.push_back({row.name, row.text
                                 ? std::string(answer->data.begin(), answer->data.end())
                                 : hex(load_le(answer->data), static_cast<int>(answer->data.size()) * 2)});
  }
  return out;
}

Result<std::map<Multiplexer, Bytes>> snapshot(RunSession& session, std::optional<BusTime> until) {
  std::map<Multiplexer, Bytes> out;
  for (const auto& entry : session.known().entries()) {
    if (until && session.now() >= *until) break;
    if (!entry.readable() || !entry.writable() || entry.command || entry.may_change) continue;
    auto present = session.is_present(entry.mux, false);
    if (!present && session.recorder().fault()) return std::unexpected(present.error());
    if (!present || !*present) continue;
    auto answer = session.peek(entry.mux);
    if (!answer) return std::unexpected(answer.error());
    if (answer->kind == Kind::confirmed) out[entry.mux] = answer->data;
  }
  return out;
}

std::string what_is_no_default(const device::Dictionary& dictionary,
                               const std::map<Multiplexer, Bytes>& held) {
  bool told = false;
  for (const auto& [mux, bytes] : held) {
    const auto* entry = dictionary.find(mux);
    if (entry == nullptr) continue;
    if (entry->configured) return to_string(mux) + " holds what the description sets it to";
    const bool is_default = entry->default_value == bytes;
    told = told || (is_default && entry->declared_default);
    const bool empty = std::ranges::all_of(bytes, [](std::uint8_t byte) { return byte == 0; });
    if (is_default || (empty && !entry->declared_default)) continue;
    const auto words = [](const Bytes& value) { return value.empty() ? "nothing" : hex_bytes(value); };
    return to_string(mux) + " holds " + words(bytes) + ", " +
           (entry->declared_default ? "and the description says " + words(*entry->default_value)
                                    : std::string("and the description does not say what it holds at first"));
  }
  return told ? "" : "no description tells a default";
}

}  // namespace conform::engine
