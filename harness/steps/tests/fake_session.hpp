// SPDX-License-Identifier: Apache-2.0
// A session without a bus: entries, names and facts are what the test puts into it.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "steps/session.hpp"

namespace conform::steps {

class FakeSession final : public Session {
 public:
  // What the test arranges.
  std::map<std::string, Value, std::less<>> names;
  std::map<Multiplexer, Bytes> entries;
  bool serves = false;  ///< SDO transfers of `entries`
  std::map<Multiplexer, AbortCode> refused;
  std::vector<Multiplexer> written;  ///< or tried to
  std::set<std::string, std::less<>> features;
  std::map<Multiplexer, Bytes> defaults, low_limits, high_limits;
  std::size_t triggers = 0;
  std::string others;  ///< what somebody else sent
  bool described = false, sweeps = false, factory = false, remote = false, power_switch = false;
  Result<Value> current_value = fail("no entry");
  device::Profile device_profile = device::default_profile(NodeId(5));
  device::Dictionary known;
  can::Capture trace;
  std::vector<can::CapturedFrame> to_come;  ///< what is on the bus when the first frame is looked for
  std::vector<can::Frame> sent;
  std::vector<Production> produced;
  BusTime time{}, emcy_held{};

  // Scope
  [[nodiscard]] const Value* find(std::string_view name) const override {
    const auto found = names.find(name);
    return found == names.end() ? nullptr : &found->second;
  }
  [[nodiscard]] NodeId node() const override { return NodeId(5); }
  [[nodiscard]] Result<Value> current() override { return current_value; }
  [[nodiscard]] Result<Value> read(Multiplexer object) override {
    const auto found = entries.find(object);
    if (found == entries.end()) return fail(to_string(object) + " cannot be read");
    return Value::of_bytes(found->second);
  }
  [[nodiscard]] Result<Value> declared(Multiplexer object, Declared what) override {
    const auto& said = what == Declared::low_limit    ? low_limits
                       : what == Declared::high_limit ? high_limits
                                                      : defaults;
    const auto found = said.find(object);
    if (found == said.end()) return fail("nothing is known of " + to_string(object));
    return Value::of_bytes(found->second);
  }

  // Facts
  [[nodiscard]] Result<bool> is_present(Multiplexer object, bool whole_object) override {
    if (!whole_object) return entries.contains(object);
    for (const auto& [mux, data] : entries) {
      if (mux.index == object.index) return true;
    }
    return false;
  }
  [[nodiscard]] bool is_claimed(Multiplexer object, bool) const override { return known.has(object.index); }
  [[nodiscard]] Result<bool> is_readable(Multiplexer object) override { return entries.contains(object); }
  [[nodiscard]] Result<bool> is_writable(Multiplexer object) override {
    const auto* entry = known.find(object);
    return entry != nullptr && entry->writable();
  }
  [[nodiscard]] std::string access_of(Multiplexer object) const override {
    const auto* entry = known.find(object);
    return entry == nullptr ? std::string() : std::string(device::to_string(entry->access));
  }
  [[nodiscard]] bool may_change(Multiplexer object) const override {
    const auto* entry = known.find(object);
    return entry != nullptr && entry->may_change;
  }
  [[nodiscard]] bool is_integer(Multiplexer object) const override {
    const auto* entry = known.find(object);
    return entry != nullptr && canopen::is_integer(entry->type);
  }
  [[nodiscard]] bool claims(std::string_view feature) const override { return features.contains(feature); }
  [[nodiscard]] Result<std::vector<device::ErrorTrigger>> error_triggers() override {
    return std::vector<device::ErrorTrigger>(triggers);
  }
  [[nodiscard]] bool store_fault_known() const override { return device_profile.store_fault.has_value(); }
  [[nodiscard]] bool is_told(std::string_view what) const override {
    return device_profile.told(what).has_value();
  }
  [[nodiscard]] bool power_switch_known() const override { return power_switch; }
  [[nodiscard]] bool factory_defaults() const override { return factory; }
  [[nodiscard]] bool can_send_remote_frames() const override { return remote; }
  [[nodiscard]] bool is_described() const override { return described; }
  [[nodiscard]] bool tries_all_objects() const override { return sweeps; }
  [[nodiscard]] Result<std::string> others_heard() override { return others; }

  // Session
  [[nodiscard]] const device::Profile& profile() const override { return device_profile; }
  [[nodiscard]] const device::Dictionary& dictionary() const override { return known; }
  [[nodiscard]] const can::Capture& capture() const override { return trace; }
  [[nodiscard]] BusTime now() const override { return time; }
  [[nodiscard]] Result<SdoAnswer> upload(Multiplexer object, std::optional<Duration>) override {
    if (!serves) return fail("no bus");
    SdoAnswer out;
    const auto found = entries.find(object);
    out.kind = found == entries.end() ? SdoAnswer::Kind::aborted : SdoAnswer::Kind::confirmed;
    if (found == entries.end()) out.code = canopen::abort::no_object;
    if (found != entries.end()) out.data = found->second;
    return out;
  }
  [[nodiscard]] Result<SdoAnswer> download(Multiplexer object, Bytes data, canopen::SdoDownload::Mode,
                                           std::optional<Duration>) override {
    if (!serves) return fail("no bus");
    SdoAnswer out;
    const auto refusal = refused.find(object);
    out.kind = refusal == refused.end() ? SdoAnswer::Kind::confirmed : SdoAnswer::Kind::aborted;
    if (refusal != refused.end()) out.code = refusal->second;
    if (refusal == refused.end()) entries[object] = std::move(data);
    written.push_back(object);
    return out;
  }
  [[nodiscard]] Result<std::vector<SdoAnswer>> transfer(const std::vector<SdoJob>&) override {
    return fail("no bus");
  }
  [[nodiscard]] std::optional<Bytes> before_last_write(Multiplexer) const override { return std::nullopt; }
  [[nodiscard]] Result<void> nmt(canopen::NmtCommand) override { return fail("no bus"); }
  [[nodiscard]] Result<void> send(const can::Frame& frame) override {
    sent.push_back(frame);
    return {};
  }
  [[nodiscard]] Result<void> play_heartbeat(NodeId node, canopen::NmtState state) override {
    return send(canopen::encode_heartbeat(node, state));
  }
  [[nodiscard]] Result<void> will_change(Multiplexer) override { return {}; }
  void sdo_channel_dirty() override {}
  void sdo_answer_may_be_late() override {}
  [[nodiscard]] Result<std::optional<std::size_t>> find_frame(std::size_t from, const Match& match,
                                                              BusTime deadline) override {
    for (const auto& frame : std::exchange(to_come, {})) trace.add(frame);
    for (auto i = from; i < trace.size(); ++i) {
      if (trace.frames()[i].time <= deadline && match(trace.frames()[i])) return std::optional(i);
    }
    return std::optional<std::size_t>();
  }
  void next_request() override {}
  [[nodiscard]] Result<std::optional<std::size_t>> find_answer(const Match& match,
                                                               std::optional<Duration> within) override {
    return find_frame(used_, match, BusTime() + within.value_or(device_profile.sdo_timeout));
  }
  [[nodiscard]] Result<void> wait_until(BusTime until) override {
    time = until;
    return {};
  }
  [[nodiscard]] Window window() const override { return {used_, {}}; }
  [[nodiscard]] Result<Window> window_after(std::string_view label) const override {
    return fail("no label '" + std::string(label) + "'");
  }
  void consume(std::size_t index) override { used_ = std::min(index + 1, trace.size()); }
  [[nodiscard]] CanId emcy_can_id() const override { return CanId(0x85); }
  void label(std::string_view, std::size_t) override {}
  void set(std::string name, Value value) override {
    names.insert_or_assign(std::move(name), std::move(value));
  }
  [[nodiscard]] Result<void> await_state() override { return {}; }
  [[nodiscard]] Duration time_to_follow() const override { return {}; }
  [[nodiscard]] BusTime emcy_held_until() const override { return emcy_held; }
  void error_changed(std::uint16_t, bool) override {}
  [[nodiscard]] Result<void> produce(Production production) override {
    produced.push_back(std::move(production));
    return {};
  }
  void stop_producing(std::string_view) override {}

 private:
  std::size_t used_ = 0;
};

}  // namespace conform::steps
