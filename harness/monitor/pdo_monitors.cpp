// SPDX-License-Identifier: Apache-2.0
// Monitors of TPDOs: in which state they come, whether they exist, their length, what they are sent for.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "base/text.hpp"
#include "monitor/factories.hpp"
#include "monitor/own_ids.hpp"

namespace conform::monitor {
namespace {

using Subject = Observation::Subject;

constexpr std::uint16_t first_tpdo = 0x1800, last_tpdo = 0x19FF;

/// The bytes that the mapping of a TPDO makes up, as far as it was seen and has come into force.
struct Mapped {
  unsigned bytes = 0;
  BusTime since{};
};
std::optional<Mapped> mapped(const Entries& entries, const Holder& tpdo) {
  const auto mapping = static_cast<std::uint16_t>(tpdo.index + 0x200);
  const auto* count = entries.known(mapping, 0);
  if (count == nullptr || count->value == 0) return std::nullopt;
  Mapped out{0, count->since};
  if (count->value == 0xFE || count->value == 0xFF) {
    out.bytes = 8;  // multiplex PDO
  } else {
    if (count->value > 64) return std::nullopt;
    unsigned bits = 0;
    for (std::uint32_t sub = 1; sub <= count->value; ++sub) {
      const auto* entry = entries.known(mapping, static_cast<std::uint8_t>(sub));
      if (entry == nullptr) return std::nullopt;
      bits += entry->value & 0xFFU;
      out.since = std::max(out.since, entry->since);
    }
    if (bits > 64) return std::nullopt;
    out.bytes = (bits + 7) / 8;
  }
  // What was written while the PDO was valid may count later, or never.
  if (entries.touched(mapping, mapping) > tpdo.entry->since) return std::nullopt;
  return out;
}

/// The one TPDO that is known to have sent the frame.
const Holder* sender(const std::vector<Holder>& found) {
  const Holder* out = nullptr;
  for (const auto& each : found) {
    if (each.held == Held::off) continue;
    if (each.held == Held::maybe || !is_tpdo(each.index) || out != nullptr) return nullptr;
    out = &each;
  }
  return out;
}

class Tpdos final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { operational, valid, length };

  [[nodiscard]] bool rests_on_time(std::size_t requirement) const override {
    return requirement == operational;
  }

  [[nodiscard]] bool wants(Subject subject) const override { return subject == Subject::data; }
  void on_frame(const Observation& seen, const Follower& follower) override {
    if (seen.subject != Subject::data || !seen.received()) return;
    const auto found = holders(follower, seen.key());
    if (std::ranges::none_of(found, [](const Holder& each) { return is_tpdo(each.index); })) return;
    // With another CAN-ID than those of its node-ID it may be somebody else's.
    const bool own = follower.may_be_own(seen.key()) &&
                     (seen.key() & 0x7FU) == follower.facts().node.value() && !seen.frame().extended;
    judge_validity(seen, follower, found, own);
    if (other_holder(found, first_tpdo, last_tpdo)) return;
    // Of eight bytes it may be an EMCY that was late, where 1014h had this CAN-ID before.
    const bool may_be_late = !own || seen.frame().dlc == 8;
    if (may_be_late && may_be_left_over(follower, found, seen.key(), first_tpdo, last_tpdo)) return;
    judge_state(seen, follower, own);
    if (const auto* tpdo = sender(found)) judge_length(seen, follower, *tpdo, own);
  }

 private:
  void judge_validity(const Observation& seen, const Follower& follower, const std::vector<Holder>& found,
                      bool own) {
    const auto on = std::ranges::find_if(found, [](const Holder& each) { return each.held != Held::off; });
    if (on != found.end()) {
      if (on->held == Held::yes) good(valid);
      return;
    }
    BusTime since{};
    for (const auto& each : found) {
      if (each.entry != nullptr) since = std::max(since, each.entry->since);
    }
    if (!follower.nmt().is_newer(seen.time(), since)) return;
    accuse(valid, own, seen, "a TPDO", "silence",
           fmt::format("bit 31 of {:X}h:01 is 1: the PDO does not exist", found.front().index));
  }

  void judge_state(const Observation& seen, const Follower& follower, bool own) {
    using canopen::NmtState;
    const auto state = follower.nmt().commanded_to_sender(seen.time());
    if (state == NmtState::operational) return good(operational);
    if (!state) return;
    accuse(operational, own, seen, "a TPDO", "silence",
           fmt::format("{} was commanded more than {} before", to_string(*state),
                       to_string(follower.facts().nmt_time)));
  }

  void judge_length(const Observation& seen, const Follower& follower, const Holder& tpdo, bool own) {
    const auto should = mapped(follower.entries(), tpdo);
    if (!should || !follower.nmt().is_newer(seen.time(), should->since) ||
        !follower.nmt().is_newer(seen.time(), tpdo.entry->since))
      return;
    if (seen.frame().dlc == should->bytes) return good(length);
    accuse(length, own, seen, fmt::format("DLC {}", seen.frame().dlc), fmt::format("DLC {}", should->bytes),
           fmt::format("so many bytes are mapped in {:X}h", tpdo.index + 0x200));
  }

  void accuse(std::size_t requirement, bool own, const Observation& seen, std::string actual,
              std::string expected, std::string reason) {
    if (own) {
      if (bad(requirement))
        tell(requirement, seen, std::move(actual), std::move(expected), std::move(reason));
    } else if (bad_if_alone(requirement)) {
      tell_if_alone(requirement, seen, std::move(actual), std::move(expected), std::move(reason));
    }
  }
};

/// What a TPDO is sent for. SYNCs and remote frames are counted; who is late may use those that came
/// meanwhile.
class TpdoTriggers final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { every_sync, nth_sync, sync_and_event, request, sampled, inhibit };

  [[nodiscard]] bool rests_on_time(std::size_t requirement) const override { return requirement == inhibit; }

  [[nodiscard]] bool wants(Subject subject) const override {
    return subject == Subject::data || subject == Subject::remote;
  }
  void on_frame(const Observation& seen, const Follower& follower) override {
    if (seen.subject == Subject::remote) {
      ++requests_[seen.key()];
    } else if (seen.subject == Subject::data) {
      if (is_sync(seen, follower)) {
        ++syncs_;
        burst_ = seen.time() > sync_at_ + forgotten ? 1 : burst_ + 1;
        sync_at_ = seen.time();
      }
      if (!seen.received()) return;
      const auto found = holders(follower, seen.key());
      if (const auto* tpdo = sender(found)) sent(seen, follower, *tpdo);
    }
  }
  void on_loss() override { tpdos_.clear(); }

 private:
  struct Tpdo {
    BusTime made{};  ///< the earliest time at which the last one may have been made
    BusTime sent{};
    std::uint64_t syncs = 0, requests = 0;  ///< counted when it was sent
    std::uint64_t credit = 1;               ///< causes that may not have led to a TPDO yet
    bool known = false;
    Entries::Key can_id{};
  };

  static bool is_sync(const Observation& seen, const Follower& follower) {
    const auto& entries = follower.entries();
    if (const auto* entry = entries.known(0x1005, 0)) return can_id_in(entry->value) == seen.key();
    return seen.key() == canopen::sync_can_id.value() || entries.ever_held(0x1005, seen.key());
  }

  void sent(const Observation& seen, const Follower& follower, const Holder& tpdo) {
    auto& last = tpdos_[tpdo.index];
    // On another CAN-ID it is counted anew: the requests were for the former one.
    const auto before = last.can_id == seen.key() ? last : Tpdo{};
    const auto requested = requests_[seen.key()];
    last.made = follower.nmt().made_since(seen.time());
    last.sent = seen.time();
    last.known = true;
    last.can_id = seen.key();
    last.syncs = syncs_;
    last.requests = requested;
    const auto* type = follower.entries().known(tpdo.index, 2);
    if (type == nullptr || !follower.nmt().is_newer(seen.time(), type->since) ||
        !follower.nmt().is_newer(seen.time(), tpdo.entry->since)) {
      last.credit = 1;
      return;
    }
    if (type->value >= 254) {
      if (before.known && requested == before.requests) judge_distance(seen, follower, tpdo, before);
      return;
    }
    judge_cause(seen, follower, static_cast<std::uint8_t>(type->value), before, last);
  }

  void judge_cause(const Observation& seen, const Follower& follower, std::uint8_t type, const Tpdo& before,
                   Tpdo& last) {
    // A reserved type means nothing; whether SYNCs are seen is open where nobody knows their CAN-ID.
    if (type > 240 && type < 252) return;
    const bool by_sync = type <= 240;
    if (by_sync && follower.entries().known(0x1005, 0) == nullptr && follower.entries().most(0x1005, 0) == 0)
      return;
    const auto& nmt = follower.nmt();
    // Some send all their PDOs once when they become Operational.
    if (!by_sync && nmt.ordered_at() && seen.time() <= *nmt.ordered_at() + initial) return;
    const auto asked = last.requests - before.requests;
    std::uint64_t credit = std::max<std::uint64_t>(1, by_sync ? burst_ : 0);
    if (before.known) {
      const bool idle = by_sync && syncs_ > 0 && nmt.made_since(seen.time()) > sync_at_ + forgotten;
      credit = (idle ? 0 : before.credit) + asked + (by_sync ? syncs_ - before.syncs : 0);
    }
    const std::size_t requirement = type == 0     ? sync_and_event
                                    : type == 1   ? every_sync
                                    : type == 252 ? sampled
                                    : type == 253 ? request
                                                  : nth_sync;
    const std::uint64_t used = by_sync && type > 0 && asked == 0 ? type : 1;
    last.credit = std::min<std::uint64_t>(credit > used ? credit - used : 0, type == 0 ? 2 : 64);
    if (credit > 0) return good(requirement);
    last.credit = 0;
    if (!bad_if_alone(requirement)) return;
    tell_if_alone(requirement, seen, "a TPDO",
                  by_sync ? "silence until the next SYNC" : "silence until it is asked",
                  fmt::format("the transmission type is {}, and no {} came since the last one", hex(type, 2),
                              by_sync ? "SYNC" : "remote frame"));
  }

  void judge_distance(const Observation& seen, const Follower& follower, const Holder& tpdo,
                      const Tpdo& before) {
    const auto* time = follower.entries().known(tpdo.index, 3);
    if (time == nullptr || time->value == 0 || time->value > 0xFFFF) return;
    const auto& nmt = follower.nmt();
    // It begins anew with a change of any parameter, and of the state.
    const auto changed = follower.entries().touched(tpdo.index, tpdo.index);
    if (changed > tpdo.entry->since || std::max(changed, tpdo.entry->since) >= before.made) return;
    if (time->since > tpdo.entry->since && time->by_write) return;
    if (nmt.ordered_at() && *nmt.ordered_at() + follower.facts().nmt_time >= before.made) return;
    const Duration least = time->value * std::chrono::microseconds(100);
    const auto distance = seen.time() - before.made;
    if (distance >= least - least / 4 - std::chrono::milliseconds(5)) return good(inhibit);
    if (!bad_if_alone(inhibit)) return;
    tell_if_alone(inhibit, seen, to_string(Duration(seen.time() - before.sent)) + " after the last one",
                  "at least " + to_string(least), fmt::format("{:X}h:03 holds {}", tpdo.index, time->value));
  }

  static constexpr Duration initial = std::chrono::seconds(1);
  static constexpr Duration forgotten = std::chrono::seconds(1);
  std::uint64_t syncs_ = 0, burst_ = 0;  ///< all, and those without a long pause
  BusTime sync_at_{};
  std::map<Entries::Key, std::uint64_t> requests_;
  std::map<std::uint16_t, Tpdo> tpdos_;
};

}  // namespace

std::unique_ptr<Monitor> make_tpdos(const Rule& rule) { return std::make_unique<Tpdos>(rule); }
std::unique_ptr<Monitor> make_tpdo_triggers(const Rule& rule) { return std::make_unique<TpdoTriggers>(rule); }

}  // namespace conform::monitor
