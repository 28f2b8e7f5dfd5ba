// SPDX-License-Identifier: Apache-2.0
// Monitors of emergency messages: when they come, how they look, and whether 1001h and 1003h say the same.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "monitor/factories.hpp"
#include "monitor/own_ids.hpp"

namespace conform::monitor {
namespace {

using Subject = Observation::Subject;
using result::Verdict;

constexpr std::uint16_t emcy_index = 0x1014;

/// The object is the one that may have sent the frame. Where 1014h only may hold the CAN-ID, one that is not
/// to send on it is as likely: a SYNC of a device that is no producer is no emergency message of one byte.
bool is_emcy(const std::vector<Holder>& found, Held held) {
  if (held == Held::maybe && found.size() > 1) return false;
  return !other_holder(found, emcy_index, emcy_index) &&
         std::ranges::any_of(
             found, [held](const Holder& each) { return each.index == emcy_index && each.held == held; });
}
bool is_emcy(const std::vector<Holder>& found) {
  return is_emcy(found, Held::yes) || is_emcy(found, Held::maybe);
}
/// It cannot be told from a frame of another object of the device, whose COB-ID is not known either.
bool may_be_emcy(const std::vector<Holder>& found) {
  return std::ranges::any_of(
      found, [](const Holder& each) { return each.index == emcy_index && each.held != Held::off; });
}
/// The objects of the device that may have sent the frame; empty where it is no message of any.
std::vector<Holder> senders(const Observation& seen, const Follower& follower) {
  if (!seen.received() || (seen.subject != Subject::emcy && seen.subject != Subject::data)) return {};
  return holders(follower, seen.key());
}
unsigned code_of(const Observation& seen) {
  return static_cast<unsigned>(load_le(ByteView(seen.frame().data).first(2)));
}
bool is_of_a_class(unsigned code) {
  constexpr auto classes =
      std::to_array<unsigned>({0x00, 0x10, 0x20, 0x21, 0x22, 0x23, 0x30, 0x31, 0x32, 0x33, 0x40, 0x41, 0x42,
                               0x50, 0x60, 0x61, 0x62, 0x63, 0x70, 0x80, 0x81, 0x82, 0x90, 0xF0, 0xFF});
  return std::ranges::find(classes, code >> 8U) != classes.end();
}

class Emergencies final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { stopped, valid, form, code_class, register_bits, inhibit, entry_there };

  [[nodiscard]] bool rests_on_time(std::size_t requirement) const override {
    return requirement == stopped || requirement == inhibit;
  }

  [[nodiscard]] bool wants(Subject subject) const override {
    return subject == Subject::emcy || subject == Subject::data;
  }
  void on_frame(const Observation& seen, const Follower& follower) override {
    const auto found = senders(seen, follower);
    keep_first(seen, follower, found);
    if (found.empty()) return;
    if (is_emcy(found, Held::off)) return off(seen, follower, found);
    if (!is_emcy(found)) return;
    const bool known = is_emcy(found, Held::yes);
    // What an object had queued before its CAN-ID changed has no holder any more.
    if (!known && !is_own(seen) &&
        (seen.frame().dlc != 8 || may_be_left_over(follower, found, seen.key(), emcy_index, emcy_index)))
      return;
    if (known) good(valid);
    judge_state(seen, follower);
    judge_form(seen);
    judge_distance(seen, follower);
  }
  void on_loss() override { made_.reset(); }

 protected:
  /// Who had a COB-ID with this CAN-ID may come to light later.
  void on_end(const Follower& follower) override {
    if (!first_error_ || !follower.entries().is_absent(emcy_index, 0)) return;
    bool explained = false;
    follower.entries().for_holders(first_error_->frame.id, [&](std::uint16_t index) {
      if (!is_tpdo(index)) return;
      explained = explained || !first_error_->told.test(index - first_tpdo);
    });
    if (explained || !bad_if_alone(entry_there)) return;
    tell({entry_there, Verdict::fail, first_error_->index, first_error_->frame, "an emergency message",
          "silence, where 1014h does not exist", "nobody else was heard on the bus", true});
  }

 private:
  static constexpr std::uint16_t first_tpdo = 0x1800;
  struct Seen {
    std::size_t index = 0;
    can::Frame frame;
    std::bitset<512> told;  ///< TPDOs whose COB-ID had been seen before
  };
  /// What can be nothing else, unless another object has that CAN-ID.
  void keep_first(const Observation& seen, const Follower& follower, const std::vector<Holder>& found) {
    if (first_error_ || !seen.received() || !is_own(seen) || seen.frame().dlc != 8) return;
    const auto code = code_of(seen);
    if (code >> 8U == 0 || !is_of_a_class(code) || other_holder(found, emcy_index, emcy_index)) return;
    first_error_ = Seen{seen.index, seen.frame(), {}};
    for (std::size_t i = 0; i < first_error_->told.size(); ++i)
      first_error_->told.set(i, follower.entries().is_told(static_cast<std::uint16_t>(first_tpdo + i), 1));
  }

  [[nodiscard]] static bool is_own(const Observation& seen) { return seen.subject == Subject::emcy; }

  void off(const Observation& seen, const Follower& follower, const std::vector<Holder>& found) {
    const auto* entry = std::ranges::find(found, emcy_index, &Holder::index)->entry;
    if (!follower.nmt().is_newer(seen.time(), entry->since)) return;
    accuse(valid, seen, "an emergency message", "silence", "bit 31 of 1014h is 1: EMCY does not exist");
  }

  void judge_state(const Observation& seen, const Follower& follower) {
    const auto state = follower.nmt().commanded_to_sender(seen.time());
    if (!state) return;
    if (state != canopen::NmtState::stopped) return good(stopped);
    accuse(stopped, seen, "an emergency message", "silence",
           fmt::format("the device was stopped more than {} before", to_string(follower.facts().nmt_time)));
  }

  void judge_form(const Observation& seen) {
    const auto& frame = seen.frame();
    if (frame.dlc == 8) {
      good(form);
    } else {
      accuse(form, seen, fmt::format("DLC {}", frame.dlc), "DLC 8", "an emergency message has eight bytes");
    }
    if (frame.size() < 3) return;
    const auto code = code_of(seen);
    const auto high = code >> 8U;
    if (is_of_a_class(code)) {
      good(code_class);
    } else {
      accuse(code_class, seen, fmt::format("error code {:04X}h", code), "a class of CiA 301, table 25",
             "the upper byte is none of those");
    }
    const unsigned bits = frame.data[2];
    if ((bits & 0x40U) != 0) {
      accuse(register_bits, seen, fmt::format("error register {}", hex(bits, 2)), "bit 6 = 0",
             "bit 6 is reserved");
    } else if (high != 0 && (bits & 0x01U) == 0) {
      accuse(register_bits, seen, fmt::format("error register {}", hex(bits, 2)), "bit 0 = 1",
             "the generic bit is set with every error", Verdict::warn);
    } else if (high != 0) {
      good(register_bits);
    }
  }

  void judge_distance(const Observation& seen, const Follower& follower) {
    const auto& nmt = follower.nmt();
    const auto before = std::exchange(made_, Made{nmt.made_since(seen.time()), is_own(seen)});
    const auto* time = follower.entries().known(0x1015, 0);
    if (!before || time == nullptr || time->value == 0 || time->value > 0xFFFF) return;
    // The time that runs already may be the old one.
    if (time->since + follower.facts().nmt_time >= before->since) return;
    if (follower.entries().touched(emcy_index, 0x1015) >= before->since) return;
    const Duration least = time->value * std::chrono::microseconds(100);
    const auto distance = seen.time() - before->since;
    if (distance >= least - least / 4 - std::chrono::milliseconds(5)) return good(inhibit);
    accuse(inhibit, is_own(seen) && before->own, seen, to_string(Duration(distance)) + " after the last one",
           "at least " + to_string(least), fmt::format("1015h holds {}", time->value));
  }

  /// On a CAN-ID that the node-ID does not give it may be somebody else's.
  void accuse(std::size_t requirement, const Observation& seen, std::string actual, std::string expected,
              std::string reason, Verdict verdict = Verdict::fail) {
    accuse(requirement, is_own(seen), seen, std::move(actual), std::move(expected), std::move(reason),
           verdict);
  }
  void accuse(std::size_t requirement, bool own, const Observation& seen, std::string actual,
              std::string expected, std::string reason, Verdict verdict = Verdict::fail) {
    if (own) {
      if (bad(requirement))
        tell(requirement, seen, std::move(actual), std::move(expected), std::move(reason), verdict);
    } else if (bad_if_alone(requirement)) {
      tell_if_alone(requirement, seen, std::move(actual), std::move(expected), std::move(reason), verdict);
    }
  }

  struct Made {
    BusTime since{};   ///< the earliest time at which the last one may have been made
    bool own = false;  ///< it came on the CAN-ID of the node-ID
  };
  std::optional<Made> made_;
  std::optional<Seen> first_error_;
};

/// 1001h and 1003h as they are read behind an emergency message. What differs may be a new error, whose own
/// message is to come: only where it does not come the entry and the message contradict each other.
class ErrorObjects final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { error_register, history };

  void on_frame(const Observation& seen, const Follower& follower) override {
    for (auto& open : open_) {
      if (open && seen.time() > open->due) {
        if (bad(open->violation.requirement)) tell(std::move(open->violation));
        open.reset();
        last_.reset();
      }
    }
    const auto found = senders(seen, follower);
    if (is_emcy(found)) {
      forget();
      // On a CAN-ID that the node-ID does not give it may be somebody else's, and says nothing about this
      // device.
      if (seen.subject == Subject::emcy && seen.frame().size() >= 3) {
        last_ = Message{code_of(seen), seen.frame().data[2], seen.time()};
      }
    } else if (seen.subject == Subject::nmt || seen.boot_up() || may_be_emcy(found)) {
      forget();
    } else if (seen.subject == Subject::sdo_request) {
      asked_at_ = seen.time();
    } else if (seen.subject == Subject::sdo_response && seen.read && last_) {
      look(seen, follower);
    }
  }
  void on_loss() override { forget(); }

 private:
  struct Message {
    unsigned code = 0;
    unsigned bits = 0;
    BusTime time{};
  };
  struct Open {
    Violation violation;
    BusTime due{};
  };

  void forget() {
    last_.reset();
    open_ = {};
  }

  void look(const Observation& seen, const Follower& follower) {
    const auto index = seen.read->object.index.value();
    const auto sub = seen.read->object.sub.value();
    const auto& entries = follower.entries();
    // Without EMCY, or in its inhibit time, errors come and go and nobody tells.
    if (entries.touched(emcy_index, 0x1015) > last_->time || entries.touched(0x1003, 0x1003) > last_->time)
      return;
    const Duration inhibit =
        std::min<std::uint32_t>(entries.most(0x1015, 0), 0xFFFF) * std::chrono::microseconds(100);
    // A message may wait for as long as it likes where nobody has said how long that is.
    const auto verdict = entries.is_told(0x1015, 0) ? Verdict::fail : Verdict::warn;
    const auto after = asked_at_ - last_->time - inhibit;
    if (after < settled) return;
    const auto value = seen.read->value;
    if (index == 0x1001 && sub == 0) {
      // Less may be left of it.
      if ((value & ~last_->bits & 0xFFU) == 0) return good(error_register);
      put(error_register, seen, verdict, inhibit, fmt::format("1001h holds {}", hex(value & 0xFFU, 2)),
          fmt::format("no other bit than in {}", hex(last_->bits, 2)),
          fmt::format("EMCY {:04X}h told {} as error register, and no further one came", last_->code,
                      hex(last_->bits, 2)));
    } else if (index == 0x1003 && sub == 1 && last_->code >= 0x1000 && after >= std::chrono::seconds(1)) {
      if ((value & 0xFFFFU) == last_->code) return good(history);
      put(history, seen, verdict, inhibit, fmt::format("{:04X}h in bits 15 to 0", value & 0xFFFFU),
          fmt::format("{:04X}h", last_->code), "that was the code of the last emergency message");
    }
  }

  void put(std::size_t requirement, const Observation& seen, Verdict verdict, Duration inhibit,
           std::string actual, std::string expected, std::string reason) {
    if (open_[requirement]) return;
    open_[requirement] = Open{{requirement, verdict, seen.index, seen.frame(), std::move(actual),
                               std::move(expected), std::move(reason)},
                              seen.time() + late + inhibit};
  }

  /// So long after the message the entry may still be behind.
  static constexpr Duration settled = std::chrono::milliseconds(25);
  /// So long after the reading the message of a new error may still come.
  static constexpr Duration late = std::chrono::milliseconds(300);
  std::optional<Message> last_;
  BusTime asked_at_{};
  std::array<std::optional<Open>, 2> open_;
};

}  // namespace

std::unique_ptr<Monitor> make_emergencies(const Rule& rule) { return std::make_unique<Emergencies>(rule); }
std::unique_ptr<Monitor> make_error_objects(const Rule& rule) { return std::make_unique<ErrorObjects>(rule); }

}  // namespace conform::monitor
