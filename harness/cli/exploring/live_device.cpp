// SPDX-License-Identifier: Apache-2.0
#include "cli/exploring/live_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/lss.hpp"
#include "canopen/nmt.hpp"
#include "canopen/program_control.hpp"
#include "cli/run/shell.hpp"
#include "engine/liveness.hpp"
#include "engine/recorder.hpp"
#include "engine/restore.hpp"

namespace conform::cli {

using namespace std::chrono_literals;

/// The bus, with an eye on what our frames change.
class LiveDevice::Watched final : public can::Transport {
 public:
  Watched(can::Transport& inner, LiveDevice& device) : inner_(inner), device_(device) {}
  [[nodiscard]] BusTime now() const override { return inner_.now(); }
  [[nodiscard]] Result<void> send(const can::Frame& frame) override {
    if (const auto object = steps::download_begun(frame, device_.profile_.node)) device_.changing(*object);
    return inner_.send(frame);
  }
  [[nodiscard]] Result<std::optional<can::BusEvent>> receive(BusTime deadline) override {
    // A wait of the search may be longer than a user waits.
    for (;;) {
      if (device_.stop_ != 0) return fail("stopped by the user");
      const auto until = std::min(deadline, inner_.now() + slice);
      auto event = inner_.receive(until);
      if (!event || *event || until == deadline) return event;
    }
  }
  [[nodiscard]] Result<bool> come_back(BusTime deadline) override { return inner_.come_back(deadline); }
  [[nodiscard]] can::BusHealth health() override { return inner_.health(); }
  [[nodiscard]] can::TransportInfo info() const override { return inner_.info(); }
  [[nodiscard]] can::Transport& inner() { return inner_; }

 private:
  static constexpr Duration slice = 200ms;
  can::Transport& inner_;
  LiveDevice& device_;
};

class LiveDevice::Here final : public explore::Place {
 public:
  explicit Here(LiveDevice& device) : device_(device) {}
  [[nodiscard]] can::Transport& bus() override { return *device_.bus_; }
  [[nodiscard]] Result<void> start() override {
    // What was still on its way belongs to nobody.
    for (;;) {
      const auto old = bus().receive(bus().now());
      if (!old) return std::unexpected(old.error());
      if (!*old) break;
    }
    return bus().send(canopen::encode(canopen::NmtCommand::reset_node, device_.profile_.node));
  }
  [[nodiscard]] Result<void> switch_power() override {
    return run_shell(device_.profile_.power_cycle, std::chrono::seconds(60));
  }
  [[nodiscard]] Duration longest_boot() const override { return device_.longest_boot(); }
  [[nodiscard]] std::optional<Error> without_boot_up() const override { return device_.did_not_start(); }
  [[nodiscard]] bool is_real() const override { return true; }
  [[nodiscard]] Result<bool> comes_back() override { return device_.settle(false); }

 private:
  LiveDevice& device_;
};

/// The engine's way to talk to it, for what is no part of a conversation.
struct LiveDevice::Talk {
  Talk(LiveDevice& device, const std::atomic<int>* stop)
      : recorder(device.bus_->inner(), stop), session(recorder, device.profile_, device.dictionary_) {
    recorder.set_observer(device.observer_);
    session.allow(device.allowed_);
  }
  engine::Recorder recorder;
  engine::RunSession session;
};

LiveDevice::LiveDevice(can::Transport& transport, const device::Profile& profile, steps::Tier allowed,
                       engine::Observer& observer, const std::atomic<int>& stop)
    : profile_(profile),
      dictionary_(device::dictionary_of(profile_)),
      guard_(profile_, dictionary_),
      allowed_(allowed),
      observer_(observer),
      stop_(stop),
      bus_(std::make_unique<Watched>(transport, *this)) {
  guard_.allow(allowed);
  guard_.begin_case(allowed);
}

LiveDevice::~LiveDevice() = default;

Duration LiveDevice::longest_boot() const { return std::max<Duration>(profile_.boot_time, 2s); }

Error LiveDevice::did_not_start() const {
  return {fmt::format("node {} sends no boot-up message when it is reset", profile_.node.value()),
          bus_->info().name, "does it hang? Switch its power off and on, or name power_cycle in the profile"};
}

Result<bool> LiveDevice::reset(engine::RunSession& session) const {
  const auto from = session.capture().size();
  if (auto sent = session.command(canopen::NmtCommand::reset_node); !sent)
    return std::unexpected(sent.error());
  auto booted =
      session.recorder().find(from, engine::is_boot_up_of(session.node()), session.now() + longest_boot());
  if (!booted) return std::unexpected(booted.error());
  if (!*booted) return false;
  session.device_restarted();
  if (auto waited = session.recorder().wait_until(session.recorder().now() + 50ms); !waited)
    return std::unexpected(waited.error());
  return true;
}

/// What others send would be taken for the device's.
Result<void> LiveDevice::is_alone(engine::RunSession& session) const {
  const auto from = session.capture().size();
  if (auto waited = session.recorder().wait_until(session.recorder().now() + 1s); !waited) return waited;
  const auto& frames = session.capture().frames();
  for (auto i = from; i < frames.size(); ++i) {
    const auto& frame = frames[i].frame;
    if (frames[i].direction != can::Direction::received || frame.error) continue;
    const bool own = !frame.extended && (frame.id & 0x7FU) == profile_.node.value();
    const bool shared = frame.id == 0x080 || frame.id == 0x100;
    if (own || shared || frame.extended) continue;
    return fail(fmt::format("somebody else sends on this bus: CAN-ID {}", hex(frame.id, 3)),
                session.recorder().transport().info().name,
                "exploration needs a device that is alone with it");
  }
  return {};
}

Result<void> LiveDevice::look() {
  Talk talk(*this, &stop_);
  const auto liveness = engine::probe(talk.session, {.may_command = true, .power_cycle = {}});
  if (!liveness) return std::unexpected(liveness.error());
  if (!liveness->answers)
    return fail(fmt::format("node {} does not answer", profile_.node.value()), bus_->info().name,
                "node-ID, bit rate, power?");
  if (auto alone = is_alone(talk.session); !alone) return alone;
  // A reset gives what the device begins each conversation with.
  const auto started = reset(talk.session);
  if (!started) return std::unexpected(started.error());
  if (!*started) return std::unexpected(did_not_start());
  engine::ScanOptions what;
  what.ranges = {{0x1000, 0x1FFF}};
  for (const auto& entry : dictionary_.entries()) {
    if (entry.not_to_be_read) what.skip.insert(entry.mux);
    if (entry.claimed) what.also.push_back(entry.mux);
  }
  auto objects = engine::scan(talk.session, what);
  if (!objects) return std::unexpected(objects.error());
  seen_ = std::move(*objects);
  for (const auto& object : seen_) {
    for (const auto& entry : object.entries) {
      if (entry.value) values_[entry.mux] = *entry.value;
    }
  }
  return {};
}

const Bytes* LiveDevice::value_of(Multiplexer object) const {
  const auto found = values_.find(object);
  return found == values_.end() ? nullptr : &found->second;
}

bool LiveDevice::may_write(Multiplexer object) const {
  // What is stored would be what the device begins the next conversation with.
  const bool keeps = object.index == Index(0x1010) || object.index == Index(0x1011);
  if (keeps || canopen::is_program_control(object.index)) return false;
  const auto* entry = dictionary_.find(object);
  if (entry != nullptr && entry->command) return false;
  const bool takes = entry == nullptr || entry->writable();
  if (takes && entry != nullptr && !values_.contains(object)) return false;
  return guard_.judge_download(object).has_value();
}

/// Of the application, and of a length that nobody knows: at which segment a fault meets it is open, too.
bool LiveDevice::is_open(Multiplexer object) const {
  const auto* entry = dictionary_.find(object);
  return steps::is_of_application(object.index) && (entry == nullptr || !entry->size());
}

/// What raises an error does that with the values of the profile only.
bool LiveDevice::is_as_told(const explore::Action& action) const {
  if (!steps::is_of_application(action.object.index) || profile_.is_safe(action.object)) return true;
  // Nothing is stored, so that there is nothing to fail.
  const auto& fault = profile_.store_fault;
  if (fault && (fault->arm.object == action.object || fault->disarm.object == action.object)) return false;
  bool triggers = false, told = false;
  for (const auto& error : profile_.errors) {
    for (const auto* write : {&error.raise, &error.clear}) {
      if (!*write || (*write)->object != action.object) continue;
      triggers = true;
      told = told || (*write)->bytes == action.data;
    }
  }
  return !triggers || (told && action.fault.empty());
}

/// Of LSS what asks and switches states: a node-ID or bit rate that was configured or stored would outlast
/// the conversation, and what an unknown command does nobody knows.
bool LiveDevice::may_ask_lss(const can::Frame& frame) {
  using canopen::LssCommand;
  if (frame.remote || frame.extended || frame.dlc != 8) return false;
  switch (static_cast<LssCommand>(frame.data[0])) {
    case LssCommand::configure_node_id:
    case LssCommand::configure_bit_timing:
    case LssCommand::activate_bit_timing:
    case LssCommand::store: return false;
    default: return !canopen::lss_command_name(frame.data[0]).empty();
  }
}

bool LiveDevice::may(const explore::Action& action) const {
  using Kind = explore::Action::Kind;
  switch (action.kind) {
    case Kind::wait: return true;
    case Kind::power: return !profile_.power_cycle.empty();
    case Kind::upload: return action.fault.empty() || !is_open(action.object);
    case Kind::download: return may_write(action.object) && is_as_told(action);
    case Kind::request:
    case Kind::frame: break;
  }
  if (action.frame.id == canopen::lss_request_can_id.value() && !may_ask_lss(action.frame)) return false;
  // What is written on other channels is not seen to be put back.
  if (explore::is_other_channel(action.frame.id) && !explore::only_reads(action.frame)) return false;
  if (const auto object = steps::download_begun(action.frame, profile_.node); object) {
    if (!may_write(*object) || !is_as_told(explore::download(*object, {}))) return false;
  }
  // ObjFlags of the description keep everybody's reading off some entries.
  const auto& bytes = action.frame.data;
  const Multiplexer asked{Index(static_cast<std::uint16_t>(bytes[1] | (bytes[2] << 8U))), SubIndex(bytes[3])};
  if (const auto* entry = dictionary_.find(asked);
      action.kind == Kind::request && entry != nullptr && entry->not_to_be_read)
    return false;
  return guard_.judge(action.frame).has_value();
}

void LiveDevice::changing(Multiplexer object) {
  if (!changed_.insert(object).second) return;
  if (const auto* before = value_of(object)) observer_.changing(object, *before);
}

/// A reset brings back what was not stored; what it did not bring back is written.
Result<bool> LiveDevice::settle(bool at_end) {
  if (gone_) return false;
  if (changed_.empty() && !at_end) return true;
  Talk talk(*this, at_end ? nullptr : &stop_);
  const auto started = reset(talk.session);
  if (!started) return std::unexpected(started.error());
  gone_ = !*started;
  if (gone_) return false;
  std::vector<engine::Change> changes;
  for (const auto object : changed_) {
    const auto* entry = dictionary_.find(object);
    const auto* before = value_of(object);
    if (before == nullptr) continue;
    // What the device sets itself cannot be put back, and what nobody can write did not change.
    if (entry != nullptr && (entry->may_change || !entry->writable())) {
      observer_.put_back(object, *before);
    } else {
      changes.push_back({object, *before});
    }
  }
  auto report = engine::restore(talk.session, changes);
  if (!report) return std::unexpected(report.error());
  for (auto& each : report->left) {
    if (std::ranges::find(left_, each) == left_.end()) left_.push_back(std::move(each));
  }
  changed_.clear();
  return true;
}

Result<void> LiveDevice::revive() {
  if (profile_.power_cycle.empty()) return std::unexpected(did_not_start());
  if (auto done = run_shell(profile_.power_cycle, std::chrono::seconds(60)); !done) return done;
  // Its boot-up message may have come already; it answers a reset, or it does not.
  gone_ = false;
  Talk talk(*this, &stop_);
  if (auto waited = talk.recorder.wait_until(talk.recorder.now() + profile_.boot_time); !waited)
    return waited;
  const auto started = settle(true);
  if (!started) return std::unexpected(started.error());
  return *started ? Result<void>() : std::unexpected(did_not_start());
}

Result<std::unique_ptr<explore::Place>> LiveDevice::enter() {
  const auto is_back = settle(false);
  if (!is_back) return std::unexpected(is_back.error());
  if (!*is_back) {
    if (auto revived = revive(); !revived) return std::unexpected(revived.error());
  }
  return std::make_unique<Here>(*this);
}

Result<std::vector<std::string>> LiveDevice::leave() {
  if (gone_) {
    if (auto revived = revive(); !revived) return std::unexpected(revived.error());
  }
  const auto is_back = settle(true);
  if (!is_back) return std::unexpected(is_back.error());
  if (!*is_back) return std::unexpected(did_not_start());
  return std::move(left_);
}

void meet(Explorable& explorable, LiveDevice& device) {
  // A machine that runs other programs, too, wakes up late and sees frames late.
  constexpr Duration jitter = 40ms;
  // The twin that is its model has no layer setting services.
  explorable.words.lss = false;
  auto& bench = explorable.bench;
  bench.place = [&device] { return device.enter(); };
  bench.jitter = jitter;
  bench.answer_time = std::max<Duration>(100ms, bench.answer_time);
  bench.is_own_affair = [&device](Multiplexer object) {
    const auto* entry = device.dictionary().find(object);
    return steps::is_of_application(object.index) || (entry != nullptr && entry->may_change);
  };
  for (const auto& entry : device.dictionary().entries()) {
    const auto index = entry.mux.index.value();
    const bool tpdo = index >= 0x1800 && index <= 0x19FF && entry.mux.sub == SubIndex(1);
    const auto* value = device.value_of(entry.mux);
    if ((tpdo || index == 0x1012) && value != nullptr && value->size() == 4)
      bench.own_cob_ids.push_back(static_cast<std::uint32_t>(load_le(*value)));
  }
  std::erase_if(explorable.words.entries, [&device](const device::Entry& entry) {
    return entry.readable() && device.value_of(entry.mux) == nullptr;
  });
}

}  // namespace conform::cli
