// SPDX-License-Identifier: Apache-2.0
// Monitors of what a device has no business to send: CAN-IDs that are not its own, commands, requests, and
// LSS answers that nobody asked for.
#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "monitor/factories.hpp"
#include "monitor/own_ids.hpp"

namespace conform::monitor {
namespace {

using Subject = Observation::Subject;
using result::Verdict;

constexpr std::uint32_t lss_request = 0x7E5;

/// A frame is judged when the whole trace is known: a COB-ID that comes to light later, or a node that is
/// heard later, explains it.
class CanIds final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { own, commands, base_frames, remote_frames };

  [[nodiscard]] bool wants(Subject subject) const override {
    return subject != Subject::sdo_request && subject != Subject::lss_answer;
  }
  void on_frame(const Observation& seen, const Follower& follower) override {
    if (!seen.received()) return;
    switch (seen.subject) {
      case Subject::sdo_response:
      case Subject::error_control:
      case Subject::emcy: return good(own);
      case Subject::nmt:
      case Subject::lss_request:
      case Subject::data:
      case Subject::foreign_request: break;
      case Subject::remote:
        if (may_ask(seen.key(), follower)) return;
        break;
      default: return;
    }
    if (seen.subject == Subject::data && follower.may_be_own(seen.key())) {
      if ((seen.key() & 0x7FU) == follower.facts().node.value() && !seen.frame().extended) good(own);
      return;
    }
    auto& strange = strange_[{seen.key(), seen.frame().remote}];
    if (++strange.count > 1) return;
    strange.index = seen.index;
    strange.frame = seen.frame();
  }

 protected:
  void on_end(const Follower& follower) override {
    for (const auto& [key, strange] : strange_) {
      const bool explained = key.second ? may_ask(key.first, follower) : follower.may_be_own(key.first);
      if (!explained) judge(key.first, strange, follower);
    }
  }

 private:
  struct Strange {
    std::size_t count = 0, index = 0;
    can::Frame frame;
  };

  /// As a remote frame it asks a node for its state.
  static bool is_guarding(Entries::Key key) { return key > 0x700 && key < 0x780; }

  /// For an RPDO of the device. Who asks the device itself is somebody else. What is a guard request can be
  /// for no RPDO, whatever CAN-ID one was given: a restricted one.
  static bool may_ask(Entries::Key key, const Follower& follower) {
    if (is_guarding(key)) return key == 0x700U + follower.facts().node.value();
    bool out = false;
    follower.entries().for_holders(key, [&](std::uint16_t index) {
      out = out || (index >= 0x1400 && index <= 0x15FF) || is_tpdo(index);
    });
    return out;
  }

  void judge(Entries::Key key, const Strange& strange, const Follower& follower) {
    const auto& frame = strange.frame;
    const auto id = CanId(frame.id);
    // A node that may be the NMT master commands, guards and looks for others.
    const bool master = (follower.entries().most(0x1F80, 0) & 1U) != 0;
    const bool guards = frame.remote && is_guarding(key);
    if (key == canopen::nmt_can_id.value() || key == lss_request || guards) {
      if (master) return;
      return put(commands, strange,
                 guards               ? "a guard request"
                 : key == lss_request ? "an LSS command"
                                      : "an NMT command",
                 "silence: a slave commands nobody");
    }
    if (frame.remote) return put(remote_frames, strange, "a remote frame", "only for RPDOs of the device");
    if (frame.extended)
      return put(base_frames, strange, "a 29-bit frame", "a CAN-ID that a COB-ID of the device holds");
    // SYNC and TIME have monitors of their own.
    if (frame.id == canopen::sync_can_id.value() || frame.id == canopen::time_can_id.value()) return;
    if (!canopen::is_restricted(id))
      return put(own, strange, "a CAN-ID of no known COB-ID", "one that a COB-ID of the device holds",
                 Verdict::warn);
    if (master && frame.id < 0x080) return;
    put(own, strange, "a restricted CAN-ID", "one that a COB-ID of the device may hold");
  }

  void put(std::size_t requirement, const Strange& strange, std::string actual, std::string expected,
           Verdict verdict = Verdict::fail) {
    if (!bad_if_alone(requirement)) return;
    auto reason = std::string("nobody else was heard on the bus");
    if (strange.count > 1) reason += fmt::format("; {} such frames came", strange.count);
    tell({requirement, verdict, strange.index, strange.frame, std::move(actual), std::move(expected),
          std::move(reason), true});
  }

  std::map<std::pair<Entries::Key, bool>, Strange> strange_;
};

/// As an LSS slave answers at most once what asks it.
class LssAnswers final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { asked, form };

  [[nodiscard]] bool wants(Subject subject) const override {
    return subject == Subject::lss_request || subject == Subject::lss_answer;
  }
  void on_frame(const Observation& seen, const Follower&) override {
    if (seen.subject == Subject::lss_request) return request(seen);
    if (seen.subject != Subject::lss_answer) return;
    if (seen.frame().dlc == 8) {
      good(form);
    } else if (bad_if_alone(form)) {
      tell_if_alone(form, seen, fmt::format("DLC {}", seen.frame().dlc), "DLC 8",
                    "all LSS frames have eight bytes");
    }
    const bool expected = open_ > 0 && (lost_ || seen.time() <= asked_at_ + patience);
    if (open_ > 0) --open_;
    if (expected) return good(asked);
    if (bad_if_alone(asked))
      tell_if_alone(asked, seen, "an LSS answer", "silence", "no LSS request is open that has an answer");
  }
  void on_loss() override {
    open_ = 1;
    lost_ = true;
  }

 private:
  /// Of the frames that make up one request only the last one asks.
  static bool asks(const can::Frame& frame) {
    switch (frame.data[0]) {
      case 0x04:  // switch state global
      case 0x15:  // activate bit timing
      case 0x40:
      case 0x41:
      case 0x42:  // switch state selective, but its last part
      case 0x46:
      case 0x47:
      case 0x48:
      case 0x49:
      case 0x4A: return false;  // identify remote slave, but its last part
      default: return true;
    }
  }

  void request(const Observation& seen) {
    // Short frames and remote ones are no requests, and who answers them anyhow is judged by the scenarios.
    if (!asks(seen.frame()) && seen.frame().dlc == 8) return;
    open_ = seen.time() > asked_at_ + idle ? 1 : open_ + 1;
    asked_at_ = seen.time();
    lost_ = false;
  }

  static constexpr Duration idle = std::chrono::seconds(2);
  static constexpr Duration patience = std::chrono::seconds(30);  // to store takes its time
  std::size_t open_ = 1;                                          // asked before the trace began
  bool lost_ = true;
  BusTime asked_at_{};
};

}  // namespace

std::unique_ptr<Monitor> make_can_ids(const Rule& rule) { return std::make_unique<CanIds>(rule); }
std::unique_ptr<Monitor> make_lss_answers(const Rule& rule) { return std::make_unique<LssAnswers>(rule); }

}  // namespace conform::monitor
