// SPDX-License-Identifier: Apache-2.0
#include "engine/restore.hpp"

#include <algorithm>
#include <map>
#include <ranges>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/pdo.hpp"

namespace conform::engine {
namespace {

using Kind = steps::SdoAnswer::Kind;
using Mode = canopen::SdoDownload::Mode;

class Restorer {
 public:
  explicit Restorer(RunSession& session) : session_(session) {}

  Result<std::optional<Bytes>> read(Multiplexer object) {
    auto answer = session_.peek(object);
    if (!answer) return std::unexpected(answer.error());
    return answer->kind == Kind::confirmed ? std::optional(answer->data) : std::nullopt;
  }

  Result<bool> write(Multiplexer object, const Bytes& data) {
    auto answer = session_.channel().download(object, data, Mode::automatic, std::nullopt);
    if (!answer) return std::unexpected(answer.error());
    return answer->kind == Kind::confirmed;
  }

  /// Off, change, on: CiA 301 locks bits 0-29 while the service is active.
  Result<bool> write_cob_id(Multiplexer object, canopen::CobIdKind kind, const Bytes& now,
                            const Bytes& before) {
    const CobId current(static_cast<std::uint32_t>(load_le(now)));
    const CobId target(static_cast<std::uint32_t>(load_le(before)));
    Result<bool> last = true;
    for (const auto value : canopen::change_sequence(kind, current, target)) {
      last = write(object, to_le(value.value(), 4));
      if (!last) return last;
    }
    return last;
  }

 private:
  RunSession& session_;
};

/// A PDO is put back as a whole: destroyed, its mapping and parameters written, its COB-ID last
/// (7.5.2.36, 7.5.2.38).
/// What is changed on the way only is announced like any other change: a run that is killed in the middle
/// must not leave the PDO off.
Result<void> restore_pdo(Restorer& device, Observer& observer, Index communication,
                         const std::vector<Change>& changes) {
  const Multiplexer cob_id{communication, SubIndex(1)};
  const auto kind = canopen::cob_id_kind(cob_id);
  auto now = device.read(cob_id);
  if (!now) return std::unexpected(now.error());
  if (!kind || !*now || (*now)->size() != 4) return {};
  Bytes wanted = **now;
  for (const auto& change : changes) {
    if (change.object == cob_id && change.before.size() == 4) wanted = change.before;
  }
  observer.changing(cob_id, wanted);
  const CobId off = canopen::deactivated(*kind, CobId(static_cast<std::uint32_t>(load_le(**now))));
  if (auto done = device.write(cob_id, to_le(off.value(), 4)); !done) return std::unexpected(done.error());
  const Index mapping = canopen::pdo_mapping(communication);
  const Multiplexer count{mapping, SubIndex(0)};
  const bool mapping_changed = std::ranges::any_of(
      changes, [mapping](const Change& change) { return change.object.index == mapping; });
  std::optional<Bytes> count_before;
  if (mapping_changed) {
    auto count_now = device.read(count);
    if (!count_now) return std::unexpected(count_now.error());
    count_before = *count_now;
    const auto known = std::ranges::find(changes, count, &Change::object);
    if (count_before) observer.changing(count, known == changes.end() ? *count_before : known->before);
    if (auto done = device.write(count, {0}); !done) return std::unexpected(done.error());
  }
  for (const auto& change : changes) {
    if (change.object == count) {
      count_before = change.before;
    } else if (change.object != cob_id) {
      if (auto done = device.write(change.object, change.before); !done) return std::unexpected(done.error());
    }
  }
  if (mapping_changed && count_before) {
    if (auto done = device.write(count, *count_before); !done) return std::unexpected(done.error());
  }
  auto done = device.write_cob_id(cob_id, *kind, to_le(off.value(), 4), wanted);
  if (!done) return std::unexpected(done.error());
  const auto settle = [&](Multiplexer object, const Bytes& value) -> Result<void> {
    // The others are looked at when everything is back.
    if (std::ranges::find(changes, object, &Change::object) != changes.end()) return {};
    const auto is = device.read(object);
    if (!is) return std::unexpected(is.error());
    if (*is == value) observer.put_back(object, value);
    return {};
  };
  if (auto settled = settle(cob_id, wanted); !settled) return settled;
  return mapping_changed && count_before ? settle(count, *count_before) : Result<void>();
}

/// Writes what can be written only while another entry, the gate, is 0: that one is 0 meanwhile, and has what
/// it is to have behind it. `held`: by the gate now.
Result<void> write_while_zero(Restorer& device, Observer& observer, Multiplexer gate, const Bytes& held,
                              const Change& change, const std::vector<Change>& changes) {
  const auto known = std::ranges::find(changes, gate, &Change::object);
  const Bytes wanted = known == changes.end() ? held : known->before;
  observer.changing(gate, wanted);
  if (auto done = device.write(gate, to_le(0, wanted.size())); !done) return std::unexpected(done.error());
  if (auto done = device.write(change.object, change.before); !done) return std::unexpected(done.error());
  if (auto done = device.write(gate, wanted); !done) return std::unexpected(done.error());
  const auto is = device.read(gate);
  if (!is) return std::unexpected(is.error());
  if (*is == wanted) observer.put_back(gate, wanted);
  return {};
}

constexpr Multiplexer cycle_period{Index(0x1006), SubIndex(0)}, counter_overflow{Index(0x1019), SubIndex(0)},
    heartbeat_time{Index(0x1017), SubIndex(0)};

/// 1019h can be written only while 1006h is 0 (7.5.2.22).
Result<void> restore_counter(Restorer& device, Observer& observer, const Change& counter,
                             const std::vector<Change>& changes) {
  const auto period = device.read(cycle_period);
  if (!period) return std::unexpected(period.error());
  if (*period && load_le(**period) != 0)
    return write_while_zero(device, observer, cycle_period, **period, counter, changes);
  auto done = device.write(counter.object, counter.before);
  return done ? Result<void>() : std::unexpected(done.error());
}

bool is_of_guarding(Multiplexer object) {
  return object.index == Index(0x100C) || object.index == Index(0x100D);
}

/// Beside a heartbeat a device may take no life time (7.2.8.2.2.1).
Result<void> restore_guarding(Restorer& device, Observer& observer, const Change& change,
                              const std::vector<Change>& changes) {
  const auto done = device.write(change.object, change.before);
  if (!done) return std::unexpected(done.error());
  if (*done) return {};
  const auto heartbeat = device.read(heartbeat_time);
  if (!heartbeat) return std::unexpected(heartbeat.error());
  if (!*heartbeat || load_le(**heartbeat) == 0) return {};
  return write_while_zero(device, observer, heartbeat_time, **heartbeat, change, changes);
}

}  // namespace

Result<RestoreReport> restore(RunSession& session, std::vector<Change> changes) {
  RestoreReport out;
  Restorer device(session);
  auto& observer = session.recorder().observer();
  std::ranges::reverse(changes);
  std::vector<Change> differing;
  for (auto& change : changes) {
    if (change.long_now) {
      differing.push_back(std::move(change));
      continue;
    }
    if (change.refused) {
      observer.put_back(change.object, change.before);
      continue;
    }
    auto now = device.read(change.object);
    if (!now) return std::unexpected(now.error());
    if (!*now || **now != change.before) {
      differing.push_back(std::move(change));
    } else {
      observer.put_back(change.object, change.before);
    }
  }
  out.written = differing.size();
  std::map<Index, std::vector<Change>> pdos;
  std::vector<const Change*> consumers;
  for (const auto& change : differing) {
    if (const auto pdo = canopen::pdo_communication(change.object.index)) {
      pdos[*pdo].push_back(change);
      continue;
    }
    const auto kind = canopen::cob_id_kind(change.object);
    if (kind && change.before.size() == 4) {
      auto now = device.read(change.object);
      if (!now) return std::unexpected(now.error());
      if (*now && (*now)->size() == 4) {
        auto done = device.write_cob_id(change.object, *kind, **now, change.before);
        if (!done) return std::unexpected(done.error());
      }
      continue;
    }
    if (change.object.index == Index(0x1016) && change.object.sub != SubIndex(0)) {
      // Two entries for one node are refused (7.5.2.19), so all are emptied before the old ones are written.
      auto done = device.write(change.object, to_le(0, 4));
      if (!done) return std::unexpected(done.error());
      consumers.push_back(&change);
      continue;
    }
    if (change.object == counter_overflow) {
      if (auto done = restore_counter(device, observer, change, differing); !done)
        return std::unexpected(done.error());
      continue;
    }
    if (is_of_guarding(change.object)) {
      if (auto done = restore_guarding(device, observer, change, differing); !done)
        return std::unexpected(done.error());
      continue;
    }
    auto done = device.write(change.object, change.before);
    if (!done) return std::unexpected(done.error());
  }
  for (const auto* change : consumers) {
    auto done = device.write(change->object, change->before);
    if (!done) return std::unexpected(done.error());
  }
  for (const auto& [communication, list] : pdos) {
    auto done = restore_pdo(device, observer, communication, list);
    if (!done) return std::unexpected(done.error());
  }
  for (const auto& change : differing) {
    auto now = device.read(change.object);
    if (!now) return std::unexpected(now.error());
    // A clock that runs (1013h) cannot be put back.
    if (*now == change.before || session.may_change(change.object)) {
      observer.put_back(change.object, change.before);
      continue;
    }
    out.left.push_back(to_string(change.object) + " is " +
                       (*now ? hex_bytes(**now) : std::string("not readable")) + ", was " +
                       hex_bytes(change.before));
  }
  return out;
}

}  // namespace conform::engine
