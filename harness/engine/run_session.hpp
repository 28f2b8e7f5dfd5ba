// SPDX-License-Identifier: Apache-2.0
// The session steps act on: one device, one bus, the names of the running case, and the journal of what was
// changed.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "device/dictionary.hpp"
#include "device/profile.hpp"
#include "engine/long_values.hpp"
#include "engine/others.hpp"
#include "engine/recorder.hpp"
#include "engine/sdo_channel.hpp"
#include "engine/tier_guard.hpp"
#include "scenario/scenario.hpp"
#include "steps/session.hpp"
#include "steps/step.hpp"

namespace conform::engine {

/// What an entry held before the first change of a case.
struct Change {
  Multiplexer object;
  Bytes before;
  bool long_now = false;  ///< holds a long value of the case: to look at it costs more than to write `before`
  std::size_t open = 0;   ///< writes that were not refused, as far as anybody followed what became of them
  bool refused = false;   ///< a long value, and every write was refused: to look at it costs too much
};

class RunSession final : public steps::Session {
 public:
  RunSession(Recorder& recorder, const device::Profile& profile, device::Dictionary dictionary);

  // Facts
  [[nodiscard]] const steps::Value* find(std::string_view name) const override;
  [[nodiscard]] NodeId node() const override { return profile_.node; }
  [[nodiscard]] Result<steps::Value> current() override;
  [[nodiscard]] Result<steps::Value> read(Multiplexer object) override;
  [[nodiscard]] Result<bool> is_present(Multiplexer object, bool whole_object) override;
  [[nodiscard]] bool is_claimed(Multiplexer object, bool whole_object) const override;
  [[nodiscard]] Result<bool> is_readable(Multiplexer object) override;
  [[nodiscard]] Result<bool> is_writable(Multiplexer object) override;
  [[nodiscard]] std::string access_of(Multiplexer object) const override;
  [[nodiscard]] bool may_change(Multiplexer object) const override;
  [[nodiscard]] bool is_integer(Multiplexer object) const override;
  [[nodiscard]] std::optional<bool> is_placeholder(Index type) const override;
  [[nodiscard]] bool claims(std::string_view feature) const override;
  [[nodiscard]] Result<std::vector<device::ErrorTrigger>> error_triggers() override;
  [[nodiscard]] bool store_fault_known() const override { return profile_.store_fault.has_value(); }
  [[nodiscard]] bool power_switch_known() const override { return static_cast<bool>(power_switch_); }
  [[nodiscard]] bool is_told(std::string_view what) const override {
    return what == "bit rates" ? !profile_.device_info.bit_rates.empty() : profile_.told(what).has_value();
  }
  [[nodiscard]] std::optional<std::uint32_t> bus_bit_rate() const override;
  [[nodiscard]] bool bus_bit_rate_is_told() const override;
  /// What the run itself could not put back may come back with each reset where the device stores by itself.
  [[nodiscard]] bool factory_defaults() const override {
    return profile_.factory_defaults.value_or(holds_defaults_) && !left_changed_;
  }
  [[nodiscard]] bool can_send_remote_frames() const override { return true; }
  [[nodiscard]] Result<steps::Value> declared(Multiplexer object, steps::Declared what) override;
  [[nodiscard]] bool is_described() const override { return !profile_.objects.empty(); }
  [[nodiscard]] bool write_was_refused() const override { return write_refused_; }
  [[nodiscard]] Result<bool> offers_block_transfer(bool upload) override;
  [[nodiscard]] Result<bool> has_variable_mapping(Multiplexer object) override;
  [[nodiscard]] bool tries_all_objects() const override { return all_objects_; }
  [[nodiscard]] Result<std::string> others_heard() override;
  [[nodiscard]] std::string grounds(steps::Asked asked, Multiplexer object) const override;
  void try_all_objects(bool all) { all_objects_ = all; }

  // Session
  [[nodiscard]] const device::Profile& profile() const override { return profile_; }
  [[nodiscard]] const device::Dictionary& dictionary() const override { return dictionary_; }
  [[nodiscard]] const can::Capture& capture() const override { return recorder_.capture(); }
  [[nodiscard]] BusTime now() const override { return recorder_.now(); }
  [[nodiscard]] Result<steps::SdoAnswer> upload(Multiplexer object, std::optional<Duration> timeout) override;
  [[nodiscard]] Result<steps::SdoAnswer> download(Multiplexer object, Bytes data,
                                                  canopen::SdoDownload::Mode mode,
                                                  std::optional<Duration> timeout) override;
  [[nodiscard]] Result<std::vector<steps::SdoAnswer>> transfer(
      const std::vector<steps::SdoJob>& jobs) override;
  [[nodiscard]] std::optional<Bytes> before_last_write(Multiplexer object) const override;
  [[nodiscard]] Result<void> nmt(canopen::NmtCommand command) override;
  [[nodiscard]] Result<void> play_heartbeat(NodeId node, canopen::NmtState state) override;
  [[nodiscard]] Result<void> send(const can::Frame& frame) override;
  [[nodiscard]] Result<void> will_change(Multiplexer object) override;
  void sdo_channel_dirty() override { channel_.dirty(false); }
  void sdo_answer_may_be_late() override { channel_.dirty(true); }
  [[nodiscard]] Result<std::optional<std::size_t>> find_frame(std::size_t from, const Match& match,
                                                              BusTime deadline) override {
    return recorder_.find(from, match, deadline);
  }
  void next_request() override { request_open_ = true; }
  [[nodiscard]] Result<std::optional<std::size_t>> find_answer(const Match& match,
                                                               std::optional<Duration> within) override;
  [[nodiscard]] Result<void> wait_until(BusTime until) override { return recorder_.wait_until(until); }
  [[nodiscard]] steps::Window window() const override { return window_; }
  [[nodiscard]] Result<void> await_state() override;
  [[nodiscard]] Duration time_to_follow() const override;
  [[nodiscard]] BusTime emcy_held_until() const override;
  void error_changed(std::uint16_t code, bool raised) override;
  /// EMCYs that are due for the triggers that the case has used; a device may send less, as it need not tell
  /// of an error that ends while there are others.
  [[nodiscard]] std::size_t emcys_due() const { return emcys_due_; }
  [[nodiscard]] Result<steps::Window> window_after(std::string_view label) const override;
  void consume(std::size_t index) override;
  [[nodiscard]] CanId emcy_can_id() const override { return emcy_can_id_; }
  void label(std::string_view name, std::size_t capture_index) override;
  /// The label of the step that has just been carried out.
  void label(const steps::Step& step, const steps::Actual& actual);
  void set(std::string name, steps::Value value) override { names_[std::move(name)] = std::move(value); }
  [[nodiscard]] Result<void> produce(steps::Production production) override;
  void stop_producing(std::string_view label) override { recorder_.stop_producing(label); }
  [[nodiscard]] Result<void> power_cycle() override;

  // For the engine
  /// How scenarios switch the power of the device; empty: by hand only.
  void set_power_switch(std::function<Result<void>()> power_switch) {
    power_switch_ = std::move(power_switch);
  }
  /// The highest tier of this run.
  void allow(scenario::Risk risk) { guard_.allow(risk); }
  /// A download that prepares what a case needs, whatever the risk of its scenario; put back after it.
  [[nodiscard]] Result<steps::SdoAnswer> prepare(Multiplexer object, Bytes data);
  void begin_case(scenario::Risk risk);  ///< forgets names, labels, windows; the journal is empty
  void begin_step(const steps::Step& step);
  void end_step() { at_once_ = false; }
  /// What the step does, as far as it can be told without asking the device for anything.
  [[nodiscard]] std::string words_of(const steps::Step& step);
  /// NMT commands of the engine itself: baseline, restore, liveness.
  [[nodiscard]] Result<void> command(canopen::NmtCommand command);
  [[nodiscard]] std::optional<steps::Value> take_name(const std::string& name);
  [[nodiscard]] Recorder& recorder() { return recorder_; }
  [[nodiscard]] SdoChannel& channel() { return channel_; }
  [[nodiscard]] device::Dictionary& known() { return dictionary_; }
  /// How often the device has been reset in this run.
  [[nodiscard]] std::size_t resets() const { return resets_; }
  /// The latest of them was of the whole node, and not of its communication only.
  [[nodiscard]] bool reset_was_of_node() const { return reset_was_of_node_; }
  [[nodiscard]] bool was_written_since_reset(Multiplexer object) const {
    return written_since_reset_.contains(object);
  }
  /// Of which entries of 1011h default parameters were restored since the last call (CiA 301, 7.5.2.14).
  [[nodiscard]] std::set<SubIndex> take_restored() { return std::exchange(restored_, {}); }
  [[nodiscard]] std::vector<Change> take_journal();
  [[nodiscard]] const std::vector<Change>& journal() const { return journal_; }
  /// Where the case begins in the capture.
  [[nodiscard]] std::size_t first_frame() const { return first_frame_; }
  /// The longest inhibit time (1015h) that the device was seen to hold since the case began; from the first
  /// look behind a reset on, since the reset.
  [[nodiscard]] Duration longest_emcy_inhibit() const { return longest_emcy_inhibit_; }
  /// CAN-ID of EMCY as found after power-on.
  void set_home_emcy_can_id(CanId id) {
    home_emcy_can_id_ = emcy_can_id_ = id;
    emcy_can_ids_ = {id};
  }
  /// Whether the device sent it on a CAN-ID that EMCY has had (1014h) at any time since the case began.
  [[nodiscard]] bool was_emcy(const can::CapturedFrame& captured) const {
    return captured.direction == can::Direction::received &&
           std::ranges::any_of(emcy_can_ids_, [&captured](CanId id) { return captured.frame.is_data(id); });
  }
  /// The time of the last such frame from this one on.
  [[nodiscard]] std::optional<BusTime> latest_emcy(std::size_t from) const;
  /// `why`: what the device answered, where it is not there.
  void note_present(Multiplexer object, bool present, std::string why = {});
  void forget_presence() { present_.clear(); }
  /// Its last NMT command was stop: it answers no SDO request, and legally so.
  [[nodiscard]] bool is_stopped() const { return stopped_; }
  /// It was told to stop since the case began.
  [[nodiscard]] bool was_stopped() const { return was_stopped_; }
  /// The device started by itself, or with its power.
  void device_restarted() {
    device_was_reset();
    reset_was_of_node_ = true;
    state_changed_ = true;
    stopped_ = false;
  }
  /// Whether the device may have left Pre-operational since the last call.
  [[nodiscard]] bool take_state_changed();
  /// Capture index of the latest reset command to the device since the last call.
  [[nodiscard]] std::optional<std::size_t> take_reset();
  /// A guard request was sent since the device was last reset: life guarding may have begun to watch.
  [[nodiscard]] bool was_guarded();
  /// One is in the capture from this frame on.
  [[nodiscard]] bool has_guarded(std::size_t from) const;
  [[nodiscard]] bool silence_seen() const { return silence_seen_; }
  void clear_silence_seen() { silence_seen_ = false; }
  /// A value could not be put back.
  void note_left_changed() { left_changed_ = true; }
  /// Whether all that could be stored holds what the description says: what does not, empty: it all does.
  void note_defaults(std::string what_does_not);
  /// Uploads that judge nothing and open no window.
  [[nodiscard]] Result<steps::SdoAnswer> peek(Multiplexer object);
  /// The same of an entry of which it matters that it is there: of a long value only the beginning is read.
  [[nodiscard]] Result<steps::SdoAnswer> glance(Multiplexer object);

 private:
  [[nodiscard]] Result<steps::SdoAnswer> look_at(Multiplexer object, bool beginning_is_enough);
  [[nodiscard]] bool may_play_nodes() const { return guard_.run() >= steps::Tier::motion; }
  /// A start, stop or enter pre-operational that the device may not have followed yet.
  struct Ordered {
    std::size_t index = 0;  ///< of the command in the capture
    BusTime sent;
    canopen::NmtState state{};
    bool alone = true;  ///< no other command was still to be followed when it was sent
  };
  void note_sent(std::size_t index);
  void note_written(Multiplexer object, std::size_t size);
  void note_refused(Multiplexer object);
  void note_open(Multiplexer object);
  /// Those that a start or a restore may have changed.
  void forget_long_values();
  /// The waits of the profile follow what was learnt about the device.
  void adapt();
  /// Forgets what a reset of the device undoes.
  void device_was_reset();
  /// A frame with the CAN-ID 0 was sent.
  void note_command(std::size_t index);
  [[nodiscard]] const device::Entry* entry(Multiplexer object) const { return dictionary_.find(object); }
  /// send() without asking the guard.
  [[nodiscard]] Result<void> send_unguarded(const can::Frame& frame);
  [[nodiscard]] Result<bool> try_block_download();
  void set_emcy_can_id(CanId id);
  void watch_emcy(Multiplexer object, const Bytes& value);
  /// What it holds, for the journal.
  [[nodiscard]] Result<steps::SdoAnswer> value_before_change(Multiplexer object);

  Recorder& recorder_;
  device::Profile profile_;  ///< T_SDO and T_QUIET grow with the slowest answer
  device::Dictionary dictionary_;
  TierGuard guard_;
  std::function<Result<void>()> power_switch_;
  SdoChannel channel_;
  Others others_;
  std::map<std::string, steps::Value, std::less<>> names_;
  mutable std::map<std::string, steps::Value, std::less<>> profile_names_;
  std::map<std::string, steps::Window, std::less<>> labels_;
  std::map<Multiplexer, bool> present_;
  std::map<Multiplexer, bool> writable_;
  std::map<std::pair<steps::Asked, Multiplexer>, std::string> grounds_;
  std::vector<Change> journal_;
  std::size_t resets_ = 0;
  bool reset_was_of_node_ = false;
  std::set<Multiplexer> written_since_reset_;
  std::set<SubIndex> restored_;
  bool left_changed_ = false, holds_defaults_ = false;
  std::map<Multiplexer, Bytes> before_write_;
  LongValues long_values_;
  steps::Window window_;
  std::optional<bool> offers_block_upload_, offers_block_download_;  ///< once tried
  std::map<Index, bool> variable_mappings_;                          ///< once tried
  bool stimulus_open_ = false;  ///< the running step acts, and its first frame begins the window
  bool request_open_ = false;   ///< the next frame of ours is a new request
  std::size_t request_ = 0;     ///< no answer to the latest request has a lower capture index
  bool all_objects_ = false;
  bool asks_nothing_ = false;  ///< words are made: nothing may be sent for them
  bool write_refused_ = false;
  bool state_changed_ = true;
  std::optional<Ordered> ordered_;
  bool at_once_ = false;              ///< the running step does not wait for the state that was commanded
  std::optional<std::size_t> reset_;  ///< capture index of a reset command that was not looked after yet
  bool silence_seen_ = false;
  bool guarded_ = false;
  std::size_t looked_for_guarding_ = 0;  ///< capture index: no guard request before it was missed
  bool stopped_ = false;
  bool was_stopped_ = false;
  const steps::ObjectReference* object_ = nullptr;
  CanId emcy_can_id_;
  CanId home_emcy_can_id_;           ///< after a reset
  std::vector<CanId> emcy_can_ids_;  ///< since the case began
  std::size_t first_frame_ = 0;      ///< of the case
  std::size_t emcys_due_ = 0;
  std::set<std::uint16_t> raised_;  ///< error codes of triggers
  Duration emcy_inhibit_{}, longest_emcy_inhibit_{};
  bool emcy_inhibit_is_known_ = true;  ///< read or written since the last reset
};

}  // namespace conform::engine
