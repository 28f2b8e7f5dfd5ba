// SPDX-License-Identifier: Apache-2.0
// Verbs of NMT and error control: commands, resets, boot-up, produced heartbeats.
#include <algorithm>

#include "base/text.hpp"
#include "can/frame_time.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/nmt.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

using canopen::NmtCommand;

bool is_boot_up(const can::CapturedFrame& captured, NodeId node) {
  return captured.direction == can::Direction::received && canopen::is_boot_up(captured.frame, node);
}

/// Waits for the boot-up message that the window of the running step may show.
Result<Actual> await_boot_up(Session& session, const Window& window, Duration within) {
  const auto node = session.node();
  auto found = session.find_frame(
      window.first, [node](const auto& captured) { return is_boot_up(captured, node); },
      window.anchor + within);
  if (!found) return std::unexpected(found.error());
  Actual out;
  if (!*found) {
    out.kind = Actual::Kind::silence;
    out.detail = "no boot-up message within " + to_string(within);
    return out;
  }
  const auto& captured = session.capture().frames()[**found];
  session.consume(**found);
  out.kind = Actual::Kind::matched;
  out.decisive = *found;
  // With its power the device may have started before the switch was done.
  out.detail = "boot-up message after " + to_string(std::chrono::round<std::chrono::microseconds>(
                                              std::max(Duration(0), captured.time - window.anchor)));
  return out;
}

class Nmt final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext&) {
    auto out = std::make_unique<Nmt>();
    const auto command = value.one_of<NmtCommand>({{"start", NmtCommand::start},
                                                   {"stop", NmtCommand::stop},
                                                   {"pre-operational", NmtCommand::pre_operational},
                                                   {"reset node", NmtCommand::reset_node},
                                                   {"reset communication", NmtCommand::reset_communication}});
    if (!command) return nullptr;
    out->command_ = *command;
    return out;
  }
  bool rests_on_time() const override { return false; }
  std::string words(Session&) const override { return "NMT " + std::string(canopen::to_string(command_)); }
  Channels rests_on() const override {
    return {canopen::is_reset(command_) ? channel::boot_up : channel::nmt_commands};
  }
  Need need() const override {
    // The node-ID makes no difference: the command goes to the device under test.
    return need_of(canopen::encode(command_, NodeId(1)), NodeId(1));
  }
  Result<Actual> run(Session& session) const override {
    const auto index = session.capture().size();
    auto sent = session.nmt(command_);
    if (!sent) return std::unexpected(sent.error());
    Actual out;
    out.decisive = sent_frame(session, index);
    return out;
  }

 private:
  NmtCommand command_ = NmtCommand::start;
};

class Reset final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext&) {
    auto out = std::make_unique<Reset>();
    const auto command = value.one_of<NmtCommand>(
        {{"node", NmtCommand::reset_node}, {"communication", NmtCommand::reset_communication}});
    if (!command) return nullptr;
    out->command_ = *command;
    return out;
  }
  std::string words(Session&) const override {
    return "NMT " + std::string(canopen::to_string(command_)) + " and wait for the boot-up message";
  }
  Channels rests_on() const override { return {channel::boot_up}; }
  bool label_is_on_request() const override { return false; }
  Result<Actual> run(Session& session) const override {
    auto sent = session.nmt(command_);
    if (!sent) return std::unexpected(sent.error());
    return await_boot_up(session, session.window(), session.profile().boot_time);
  }

 private:
  NmtCommand command_ = NmtCommand::reset_node;
};

class PowerCycle final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext&) {
    if (!value.one_of({"once"})) return nullptr;
    return std::make_unique<PowerCycle>();
  }
  Need need() const override { return {Tier::config, "switch the power of the device"}; }
  std::string words(Session&) const override { return "power off and on, and wait for the boot-up message"; }
  Channels rests_on() const override { return {channel::boot_up}; }
  bool label_is_on_request() const override { return false; }
  Result<Actual> run(Session& session) const override {
    if (auto done = session.power_cycle(); !done) return std::unexpected(done.error());
    return await_boot_up(session, session.window(), session.profile().boot_time);
  }
};

class BootUp final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext&) {
    auto out = std::make_unique<BootUp>();
    auto fields = value.fields("boot_up");
    out->within_.profile_name = "boot_time";
    if (const auto within = fields.optional("within")) {
      if (auto time = parse_time_at(within)) out->within_ = *time;
    }
    if (const auto exactly = fields.optional("exactly")) {
      if (exactly.one_of({"once"})) out->once_for_ = std::chrono::seconds(1);
    }
    return out;
  }
  Channels rests_on() const override { return {channel::boot_up}; }
  bool acts() const override { return false; }
  std::string words(Session&) const override {
    return "boot-up message within " + within_.text() + (once_for_.count() > 0 ? ", exactly once" : "");
  }
  Result<Actual> run(Session& session) const override {
    const auto window = session.window();
    auto first = await_boot_up(session, window, within_.resolve(session.profile()));
    if (!first || first->kind != Actual::Kind::matched || once_for_.count() == 0) return first;
    const auto node = session.node();
    const auto& frames = session.capture().frames();
    auto second = session.find_frame(
        *first->decisive + 1, [node](const auto& captured) { return is_boot_up(captured, node); },
        frames[*first->decisive].time + once_for_);
    if (!second) return std::unexpected(second.error());
    if (*second) {
      first->kind = Actual::Kind::mismatched;
      first->decisive = *second;
      first->detail = "a second boot-up message, " +
                      to_string(std::chrono::round<std::chrono::microseconds>(
                          session.capture().frames()[**second].time - window.anchor)) +
                      " after the command";
    }
    return first;
  }

 private:
  TimeReference within_;
  Duration once_for_{};
};

Result<Actual> begin(Session& session, Production production) {
  if (auto begun = session.produce(std::move(production)); !begun) return std::unexpected(begun.error());
  return Actual{};
}

class ProduceLoad final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& percent) {
    auto out = std::make_unique<ProduceLoad>();
    out->percent_ = percent.number(1, 90).value_or(0);
    return out->percent_ == 0 ? nullptr : std::move(out);
  }
  Need need() const override { return {Tier::motion, "load the bus"}; }
  std::string words(Session&) const override {
    return "load the bus by " + std::to_string(percent_) + " % with frames that nobody uses";
  }
  Result<Actual> run(Session& session) const override {
    // Of the lowest priority that is left: what the device sends goes first.
    const auto frame = can::data_frame(CanId(0x7DF), {0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0x55});
    const auto one = can::bit_time(can::frame_bits(frame) + can::intermission_bits,
                                   session.bus_bit_rate().value_or(slow_bus));
    Production load{"load", frame, one * 100 / static_cast<Duration::rep>(percent_), {}};
    load.keeps_time = false;
    return begin(session, std::move(load));
  }

 private:
  /// Where the interface does not tell its bit rate.
  static constexpr std::uint32_t slow_bus = 125'000;

  std::uint64_t percent_ = 0;
};

class ProduceGuard final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value) {
    auto out = std::make_unique<ProduceGuard>();
    auto fields = value.fields("guard");
    const auto every = fields.required("every");
    if (!every) return nullptr;
    if (auto time = parse_time_at(every)) out->every_ = *time;
    return out;
  }
  Need need() const override { return {Tier::config, "send remote frames"}; }
  std::string words(Session&) const override { return "produce guard requests every " + every_.text(); }
  Result<Actual> run(Session& session) const override {
    const auto request = can::remote_frame(canopen::connection_set(session.node()).error_control, 1);
    Production guarding{"guard", request, every_.resolve(session.profile()), {}};
    guarding.life_sign = true;
    return begin(session, std::move(guarding));
  }

 private:
  TimeReference every_;
};

class ProduceHeartbeat final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<ProduceHeartbeat>();
    auto inner = value.fields("heartbeat");
    out->node_ = inner.required("node").number(1, 127).value_or(0);
    out->state_ = inner.optional("state")
                      .one_of<canopen::NmtState>({{"operational", canopen::NmtState::operational},
                                                  {"pre-operational", canopen::NmtState::pre_operational},
                                                  {"stopped", canopen::NmtState::stopped}})
                      .value_or(canopen::NmtState::operational);
    if (const auto every = inner.optional("every")) {
      if (auto time = parse_time_at(every)) out->every_ = *time;
      out->cyclic_ = true;
    }
    if (const auto count = inner.optional("count")) out->count_ = count.number(1, 1'000'000);
    context.know("heartbeat");
    return out->node_ == 0 ? nullptr : std::move(out);
  }
  Need need() const override { return {Tier::motion, "play other nodes"}; }
  std::string words(Session&) const override {
    return "produce heartbeat of node " + std::to_string(node_) +
           (cyclic_ ? " every " + every_.text() : ", once");
  }
  Result<Actual> run(Session& session) const override {
    if (node_ == session.node().value()) {
      return fail_scenario("node " + std::to_string(node_) +
                           " is the device under test, its heartbeat cannot be produced");
    }
    const auto frame = canopen::encode_heartbeat(NodeId(static_cast<std::uint8_t>(node_)), state_);
    if (cyclic_) {
      Production heartbeat{"heartbeat", frame, every_.resolve(session.profile()), count_};
      heartbeat.life_sign = true;
      return begin(session, std::move(heartbeat));
    }
    const auto index = session.capture().size();
    auto sent = session.send(frame);
    if (!sent) return std::unexpected(sent.error());
    Actual out;
    auto echo = session.find_frame(
        index,
        [&frame](const auto& captured) {
          return captured.direction == can::Direction::transmitted && captured.frame == frame;
        },
        session.now() + std::chrono::milliseconds(500));
    if (!echo) return std::unexpected(echo.error());
    if (*echo) out.decisive = *echo;
    return out;
  }

 private:
  std::uint64_t node_ = 0;
  canopen::NmtState state_ = canopen::NmtState::operational;
  TimeReference every_;
  bool cyclic_ = false;
  std::optional<std::uint64_t> count_;
};

std::unique_ptr<Action> parse_produce(const yaml::Field& value, ParseContext& context) {
  auto fields = value.fields("produce");
  const auto what = fields.exactly_one_of({"heartbeat", "guard", "load"});
  if (!what) return nullptr;
  if (fields.has("load")) return ProduceLoad::parse(what);
  if (fields.has("guard")) return ProduceGuard::parse(what);
  return ProduceHeartbeat::parse(what, context);
}

class Stop final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext&) {
    auto out = std::make_unique<Stop>();
    const auto what = value.one_of({"heartbeat", "guard", "load"});
    if (!what) return nullptr;
    out->what_ = *what;
    return out;
  }
  bool acts() const override { return false; }
  std::string words(Session&) const override {
    if (what_ == "load") return "stop loading the bus";
    return what_ == "guard" ? "stop producing guard requests" : "stop producing heartbeats";
  }
  Result<Actual> run(Session& session) const override {
    session.stop_producing(what_);
    return Actual{};
  }

 private:
  std::string what_;
};

constexpr Verb table[] = {
    {"nmt", "Send an NMT command to the device under test; never to all nodes.",
     "(word): start, stop, pre-operational, reset node, reset communication", "- nmt: start", &Nmt::parse},
    {"reset", "Reset the device and wait for its boot-up message.", "(word): node, communication",
     "- reset: communication", &Reset::parse},
    {"power_cycle",
     "Switch the power of the device off and on (power_cycle of the device profile) and wait for the boot-up message.",
     "(word): once", "- power_cycle: once", &PowerCycle::parse},
    {"boot_up", "Wait for the boot-up message.",
     "within: time (default: boot time of the profile)\nexactly: once",
     "- nmt: reset node\n- boot_up: {within: $profile.boot_time, exactly: once}\n  checks: NMT-BOOT-01",
     &BootUp::parse},
    {"produce",
     "Send heartbeats of another node, guard requests, or frames that load the bus, once or beside the following steps.",
     "heartbeat: {node, state, every, count}\nguard: {every}, to the device under test\nload: percent of the bus, up to 90, by frames of eight bytes that nobody uses (7DFh)",
     "- produce: {heartbeat: {node: 7Eh, state: operational, every: 50 ms}}", &parse_produce},
    {"stop", "End what `produce` began.", "(word): heartbeat, guard, load", "- stop: heartbeat",
     &Stop::parse},
};

}  // namespace

std::span<const Verb> nmt_verbs() { return table; }

}  // namespace conform::steps
