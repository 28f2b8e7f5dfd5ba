// SPDX-License-Identifier: Apache-2.0
// The verbs `ready_pdo`, `ready_sync` and `ready_error_control`: many devices are delivered with their PDOs
// off or with nothing mapped, as the producer of SYNC, or with one of the two error control protocols only,
// and leave it to a configuration tool to give them another part to play. What they do then is judged all the
// same.
#include <chrono>
#include <optional>
#include <vector>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/pdo.hpp"
#include "steps/frame_source.hpp"
#include "steps/pdo_objects.hpp"
#include "steps/sdo_access.hpp"
#include "steps/timing.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

using namespace std::chrono_literals;

/// A device may have its reasons not to map one object; that none of so many can be mapped says enough.
constexpr std::size_t most_candidates = 4;
/// Where the device has no CAN-ID of its own for a PDO: nothing of the pre-defined connection set, and not
/// restricted (7.3.5).
constexpr std::uint32_t first_free_can_id = 0x6B0, free_can_ids = 16;

/// Values for a mapping entry that the PDO may well take: what the description or the profile offers, whole,
/// and for a TPDO the error register, which every device has.
std::vector<std::uint32_t> candidates(const device::Dictionary& dictionary, bool receive) {
  std::vector<std::uint32_t> out;
  for (const auto& entry : dictionary.entries()) {
    if (out.size() == most_candidates) return out;
    const auto size = entry.size();
    const bool fits = entry.pdo_mappable && size && *size >= 1 && *size <= 8 && !entry.untouchable;
    const bool takes = receive ? entry.safe && entry.access != device::Access::rwr
                               : entry.readable() && entry.access != device::Access::rww;
    if (!fits || !takes || entry.mux.index < Index(0x2000)) continue;
    const auto bits = entry.type == canopen::DataType::boolean ? 1U : *size * 8;
    out.push_back(canopen::mapping_entry(entry.mux, bits));
  }
  if (!receive) out.push_back(canopen::mapping_entry({Index(0x1001), SubIndex(0)}, 8));
  return out;
}

class ReadyPdo final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<ReadyPdo>();
    auto pdo = parse_object_at(value, context.names);
    if (pdo) out->pdo_ = *pdo;
    return pdo ? std::move(out) : nullptr;
  }
  std::vector<ObjectReference> concerns() const override { return {pdo_}; }
  bool rests_on_time() const override { return false; }
  std::string words(Session& session) const override {
    return "make sure that " + pdo_words(pdo_, session) + " is valid and maps something";
  }

  Result<Actual> run(Session& session) const override {
    const auto index = communication_of(pdo_, session);
    if (!index) return std::unexpected(index.error());
    const Multiplexer cob_id{*index, SubIndex(1)};
    const auto mapping = canopen::pdo_mapping(*index);
    auto actual = read(session, cob_id);
    if (!is_confirmed(actual)) return actual;
    const auto before = static_cast<std::uint32_t>(load_le(actual->data));
    const bool valid = (before & canopen::cob_id::bit31) == 0;
    actual = read(session, {mapping, SubIndex(0)});
    if (!is_confirmed(actual)) return actual;
    const bool maps = load_le(actual->data) != 0;
    if (valid && maps) return done(std::move(*actual));
    if (!maps) {
      if (valid) actual = write(session, cob_id, before | canopen::cob_id::bit31, 4);
      if (is_confirmed(actual)) actual = map_one(session, mapping);
      if (!is_confirmed(actual)) return actual;
    }
    actual = write(session, cob_id, with_can_id(before & ~canopen::cob_id::bit31, *index, session.node()), 4);
    return actual ? done(std::move(*actual)) : actual;
  }

 private:
  static Actual done(Actual actual) {
    actual.data.clear();
    return actual;
  }

  /// The first candidate that the device takes.
  static Result<Actual> map_one(Session& session, Index mapping) {
    Actual none;
    none.kind = Actual::Kind::silence;
    none.detail = "the device has nothing that could be mapped";
    Result<Actual> actual = std::move(none);
    for (const auto entry : candidates(session.dictionary(), is_receive_pdo(mapping))) {
      if (auto noted = will_receive(session, mapping, entry); !noted) return std::unexpected(noted.error());
      actual = write(session, {mapping, SubIndex(1)}, entry, 4);
      if (!actual) return actual;
      if (is_confirmed(actual)) return write(session, {mapping, SubIndex(0)}, 1, 1);
    }
    return actual;
  }

  /// A PDO beyond the fourth has no CAN-ID by default (7.5.2.35, 7.5.2.37).
  static std::uint32_t with_can_id(std::uint32_t cob_id, Index communication, NodeId node) {
    if ((cob_id & 0x1FFF'FFFFU) != 0) return cob_id;
    const auto number = communication.value() - (is_receive_pdo(communication) ? 0x1400U : 0x1800U);
    const auto set = canopen::connection_set(node);
    const auto& usual = is_receive_pdo(communication) ? set.rpdo : set.tpdo;
    return cob_id | (number < 4 ? usual[number].value() : first_free_can_id + number % free_can_ids);
  }

  ObjectReference pdo_;
};

/// A device that produces SYNC can be tested as a consumer when it does so no more (7.5.2.5, bit 30). What is
/// left of its period would be one in which it may miss the SYNC of others (7.5.2.6).
class ReadySync final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext&) {
    return value.one_of({"consumer"}) ? std::make_unique<ReadySync>() : nullptr;
  }
  std::vector<ObjectReference> concerns() const override { return entry_named("1005h:00"); }
  bool rests_on_time() const override { return false; }
  std::string words(Session&) const override { return "make sure that the device produces no SYNC"; }

  Result<Actual> run(Session& session) const override {
    constexpr Multiplexer cob_id{Index(0x1005), SubIndex(0)};
    auto actual = read(session, cob_id);
    if (!is_confirmed(actual)) return actual;
    const auto before = static_cast<std::uint32_t>(load_le(actual->data));
    actual->data.clear();
    if ((before & canopen::cob_id::bit30) == 0) return actual;
    actual = write(session, cob_id, before & ~canopen::cob_id::bit30, 4);
    if (!is_confirmed(actual)) return actual;
    constexpr Multiplexer period{Index(0x1006), SubIndex(0)};
    const auto held = read(session, period);
    if (!held || !is_confirmed(held) || load_le(held->data) == 0) return held ? actual : held;
    return write(session, period, 0, 4);
  }
};

/// Whoever is asked for its NMT state shows it in the one error control protocol that it has: in heartbeats,
/// as often as is wanted where 1017h can be written and as often as they come where it cannot, or in replies
/// to guard requests (7.2.8.2.2.1: one of the two is mandatory).
class ReadyErrorControl final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext&) {
    auto out = std::make_unique<ReadyErrorControl>();
    auto every = parse_time_at(value);
    if (every) out->every_ = *every;
    return every ? std::move(out) : nullptr;
  }
  std::vector<ObjectReference> concerns() const override { return entry_named("1017h:00"); }
  Measures measures() const override { return {"stretch"}; }
  bool rests_on_time() const override { return false; }
  std::string words(Session&) const override {
    return "make the device show its NMT state every " + every_.text();
  }

  Result<Actual> run(Session& session) const override {
    const auto every = every_.resolve(session.profile());
    note(session, every, 1, 0xFF);
    constexpr Multiplexer time{Index(0x1017), SubIndex(0)};
    const auto writable = session.is_writable(time);
    if (!writable) return std::unexpected(writable.error());
    if (*writable) {
      auto written = write(session, time, static_cast<std::uint64_t>(every / 1ms), 2);
      if (!written) return written;
      if (is_confirmed(written)) return shown(1);
    }
    const auto held = read(session, time);
    if (!held) return held;
    const auto period = is_confirmed(held) ? load_le(held->data) * 1ms : Duration{};
    return period > Duration{} ? heard(session, period, every) : guarded(session, every);
  }

 private:
  /// More seldom than that a scenario would be at it for minutes.
  static constexpr Duration longest_period = 2s;

  static Actual shown(std::uint64_t stretch) {
    Actual out;
    out.measured["stretch"] = stretch;
    return out;
  }
  static Actual none(std::string why) {
    Actual out;
    out.kind = Actual::Kind::silence;
    out.detail = std::move(why);
    return out;
  }

  static void note(Session& session, Duration period, std::uint64_t stretch, std::uint64_t mask) {
    session.set(std::string(error_control_period),
                Value::of_number(static_cast<std::uint64_t>(period.count())));
    session.set(std::string(error_control_stretch), Value::of_number(stretch));
    session.set(std::string(error_control_mask), Value::of_number(mask));
  }

  static Result<std::optional<std::size_t>> next_of_device(Session& session, std::size_t from,
                                                           BusTime until) {
    const auto id = canopen::connection_set(session.node()).error_control;
    return session.find_frame(
        from,
        [id](const can::CapturedFrame& each) {
          return each.direction == can::Direction::received && each.frame.is_data(id);
        },
        until);
  }

  /// A heartbeat that comes as it does: where it is slow everything takes as much longer.
  static Result<Actual> heard(Session& session, Duration period, Duration every) {
    if (period > longest_period) return none("a heartbeat comes every " + to_string(period) + " only");
    const auto found = next_of_device(session, session.capture().size(), session.now() + 2 * period);
    if (!found) return std::unexpected(found.error());
    if (!*found) return none("no heartbeat within " + to_string(2 * period));
    const auto times = (period + every - Duration(1)) / every;
    note(session, period, static_cast<std::uint64_t>(times), 0xFF);
    return shown(static_cast<std::uint64_t>(times));
  }

  /// Guard requests beside the scenario, where they start no life guarding: it would have them go on.
  static Result<Actual> guarded(Session& session, Duration every) {
    if (!session.can_send_remote_frames())
      return none("there is no heartbeat, and the interface cannot send RTR");
    const auto guard_time = read(session, {Index(0x100C), SubIndex(0)});
    if (!guard_time) return guard_time;
    const auto factor = read(session, {Index(0x100D), SubIndex(0)});
    if (!factor) return factor;
    if (is_confirmed(guard_time) && is_confirmed(factor) && load_le(guard_time->data) != 0 &&
        load_le(factor->data) != 0)
      return none("there is no heartbeat, and guard requests would start life guarding");
    if (auto settled = session.await_state(); !settled) return std::unexpected(settled.error());
    const auto request = can::remote_frame(canopen::connection_set(session.node()).error_control, 1);
    const auto from = session.capture().size();
    if (auto sent = session.send(request); !sent) return std::unexpected(sent.error());
    const auto reply =
        next_of_device(session, from, session.now() + guard_patience(session.profile().nmt_time));
    if (!reply) return std::unexpected(reply.error());
    if (!*reply) return none("there is no heartbeat, and a guard request is not answered");
    note(session, every, 1, 0x7F);
    Production guarding{"guard", request, every, {}};
    guarding.life_sign = true;
    if (auto begun = session.produce(std::move(guarding)); !begun) return std::unexpected(begun.error());
    return shown(1);
  }

  TimeReference every_;
};

constexpr Verb table[] = {
    {"ready_pdo",
     "Make a PDO valid, with one object mapped, where the device is delivered without; one that is ready stays as it is.",
     "(object): the communication or mapping object of the PDO",
     "- ready_pdo: $pdo\n  either: [{if: ok}, {if: [abort any, silence], verdict: not applicable}]",
     &ReadyPdo::parse},
    {"ready_sync",
     "Make the device a consumer of SYNC where it is delivered as the producer; one that produces none stays as it is.",
     "(word): consumer",
     "- ready_sync: consumer\n  either: [{if: ok}, {if: abort any, verdict: not applicable}]",
     &ReadySync::parse},
    {"ready_error_control",
     "Make the device show its NMT state in `error control`: by the heartbeat where 1017h can be written, by the heartbeat that comes "
     "anyway where it cannot, or by replies to guard requests where there is none. Where heartbeats come more seldom, the times of "
     "steps that wait for `error control` are as many times as long.",
     "(time): how often\nmeasured: stretch (how many times as long steps wait for `error control`)",
     "- ready_error_control: 100 ms\n  either: [{if: ok}, {if: [abort any, silence], verdict: not applicable}]",
     &ReadyErrorControl::parse},
};

}  // namespace

std::span<const Verb> ready_verbs() { return table; }

}  // namespace conform::steps
