// SPDX-License-Identifier: Apache-2.0
// The verb `guard`: guard requests (CiA 301, 7.2.8.3.2.1), remote frames on 700h + node-ID, and what the
// answers say: NMT state in bits 0 to 6, a toggle bit in bit 7.
#include <algorithm>
#include <chrono>
#include <vector>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "steps/timing.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

constexpr std::uint64_t most_requests = 1000;
constexpr std::uint8_t toggle_bit = 0x80, state_bits = 0x7F;

class Guard final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<Guard>();
    if (!value.node()->is_mapping()) {
      if (value.text() == "once") return out;
      value.error("write once, or {count: 10, every: 100 ms}");
      return nullptr;
    }
    auto fields = value.fields("guard");
    if (const auto count = fields.required("count")) {
      out->count_ = count.number(1, most_requests).value_or(1);
      const auto every = out->count_ > 1 ? fields.required("every") : fields.optional("every");
      if (every) out->every_ = parse_time_at(every);
    }
    if (const auto dlc = fields.optional("dlc")) out->dlc_ = dlc.number(0, 8).value_or(1);
    if (const auto save = fields.optional("save")) {
      out->save_ = save.text().value_or("");
      context.know(out->save_);
    }
    return out;
  }
  Measures measures() const override {
    return {"replies", "toggle", "wrong_toggles", "wrong_length", "state"};
  }
  Need need() const override { return {Tier::config, "send remote frames"}; }
  std::string words(Session&) const override {
    return count_ == 1 ? "guard request"
                       : std::to_string(count_) + " guard requests" +
                             (every_ ? ", one every " + every_->text() : std::string());
  }

  Result<Actual> run(Session& session) const override {
    const auto id = canopen::connection_set(session.node()).error_control;
    const Session::Match is_reply = [id](const can::CapturedFrame& each) {
      return each.direction == can::Direction::received && each.frame.is_data(id);
    };
    if (auto settled = session.await_state(); !settled) return std::unexpected(settled.error());
    // The next request waits no longer than its period.
    const auto within = guard_patience(session.profile().nmt_time);
    if (auto quiet = await_former_reply(session, is_reply, within); !quiet)
      return std::unexpected(quiet.error());
    const auto period = every_ ? every_->resolve(session.profile()) : within;
    std::vector<std::size_t> replies;
    const auto begin = session.capture().size();
    for (std::uint64_t i = 0; i < count_; ++i) {
      const auto from = session.capture().size();
      auto sent = session.send(can::remote_frame(id, static_cast<std::uint8_t>(dlc_)));
      if (!sent) return std::unexpected(sent.error());
      const auto request = sent_frame(session, from);
      const auto time = request ? session.capture().frames()[*request].time : session.now();
      const bool last = i + 1 == count_;
      auto found = session.find_frame(from, is_reply, time + (last ? within : std::min(period, within)));
      if (!found) return std::unexpected(found.error());
      if (*found) replies.push_back(**found);
      if (last) continue;
      auto waited = session.wait_until(time + period);
      if (!waited) return std::unexpected(waited.error());
    }
    if (!replies.empty()) session.consume(replies.back());
    return measured(session, replies, begin);
  }

 private:
  /// What answers a request of before is no answer to those that follow.
  static Result<void> await_former_reply(Session& session, const Session::Match& is_reply, Duration within) {
    const auto id = canopen::connection_set(session.node()).error_control;
    const auto& frames = session.capture().frames();
    auto index = frames.size();
    while (index > 0 && frames[index - 1].time + within >= session.now()) --index;
    int open = 0;
    BusTime asked{};
    for (; index < frames.size(); ++index) {
      const auto& each = frames[index];
      if (open > 0 && is_reply(each)) --open;
      if (each.direction != can::Direction::transmitted || !each.frame.remote || each.frame.extended ||
          each.frame.id != id.value())
        continue;
      ++open;
      asked = each.time;
    }
    for (; open > 0; --open) {
      const auto reply = session.find_frame(index, is_reply, asked + within);
      if (!reply) return std::unexpected(reply.error());
      if (!*reply) break;
      index = **reply + 1;
    }
    return {};
  }

  [[nodiscard]] Actual measured(Session& session, const std::vector<std::size_t>& replies,
                                std::size_t begin) const {
    Actual out;
    out.measured["replies"] = replies.size();
    out.measured["wrong_toggles"] = out.measured["wrong_length"] = 0;
    out.decisive = replies.empty() ? sent_frame(session, begin) : std::optional(replies.back());
    std::optional<std::uint8_t> former;
    bool one_state = true;
    std::string bytes;
    for (const auto index : replies) {
      const auto& frame = session.capture().frames()[index].frame;
      const auto byte = frame.size() > 0 ? frame.data[0] : std::uint8_t{0xFF};
      if (frame.dlc != 1) ++out.measured["wrong_length"];
      bytes += (bytes.empty() ? "" : " ") + hex_bytes(frame.bytes());
      if (!former) {
        out.measured["toggle"] = (byte & toggle_bit) != 0 ? 1 : 0;
      } else {
        one_state = one_state && ((*former ^ byte) & state_bits) == 0;
        if (((*former ^ byte) & toggle_bit) == 0) {
          if (out.measured["wrong_toggles"]++ == 0) out.decisive = index;
        }
      }
      former = byte;
    }
    if (former && one_state) out.measured["state"] = *former & state_bits;
    if (former && !save_.empty()) session.set(save_, Value::of_number(*former));
    out.detail = replies.empty() ? "no reply" : std::to_string(replies.size()) + " replies: " + bytes;
    return out;
  }

  std::uint64_t count_ = 1, dlc_ = 1;
  std::optional<TimeReference> every_;
  std::string save_;
};

constexpr Verb table[] = {
    {"guard", "Send guard requests (remote frames on 700h + node-ID) and look at the replies.",
     "(word): once\ncount: how many\nevery: time between two\ndlc: 0 to 8 (default 1)\nsave: name that the "
     "last reply gets\n"
     "measured: replies, state, toggle (of the first reply), wrong_toggles, wrong_length",
     "- guard: {count: 10, every: 100 ms}\n  checks: EC-NG-02\n  expect: {replies: 10, wrong_toggles: 0}",
     &Guard::parse},
};

}  // namespace

std::span<const Verb> guard_verbs() { return table; }

}  // namespace conform::steps
