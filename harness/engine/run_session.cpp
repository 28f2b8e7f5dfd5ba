// SPDX-License-Identifier: Apache-2.0
// What steps do. What they ask the session about the device stands in run_session_facts.cpp.
#include "engine/run_session.hpp"

#include <algorithm>
#include <chrono>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/program_control.hpp"
#include "canopen/sdo_initiate.hpp"

namespace conform::engine {
namespace {
constexpr Multiplexer emcy_entry{Index(0x1014), SubIndex(0)};
constexpr Multiplexer emcy_inhibit_entry{Index(0x1015), SubIndex(0)};  // multiples of 100 us

}  // namespace

RunSession::RunSession(Recorder& recorder, const device::Profile& profile, device::Dictionary dictionary)
    : recorder_(recorder),
      profile_(profile),
      dictionary_(std::move(dictionary)),
      guard_(profile, dictionary_),
      channel_(recorder, profile.node, profile.sdo_timeout, profile.quiet_time),
      others_(profile.node),
      emcy_can_id_(canopen::connection_set(profile.node).emcy),
      home_emcy_can_id_(emcy_can_id_),
      emcy_can_ids_{emcy_can_id_} {
  channel_.set_known_size([this](Multiplexer object) -> std::optional<std::size_t> {
    const auto* known = entry(object);
    return known != nullptr ? known->size() : std::nullopt;
  });
  // Also what is put back behind a case tells where emergency messages are to be looked for.
  channel_.set_on_value([this](const SdoChannel::Told& told) {
    if (told.written) written_since_reset_.insert(told.object);
    if (!told.under_another_node_id) watch_emcy(told.object, told.value);
    long_values_.note(told.object, told.value);
  });
}

Result<steps::SdoAnswer> RunSession::peek(Multiplexer object) { return look_at(object, false); }

Result<steps::SdoAnswer> RunSession::glance(Multiplexer object) { return look_at(object, true); }

Result<steps::SdoAnswer> RunSession::look_at(Multiplexer object, bool beginning_is_enough) {
  if (asks_nothing_) return fail_scenario("the value of " + to_string(object) + " is not asked for");
  if (auto reached = await_state(); !reached) return std::unexpected(reached.error());
  auto answer = beginning_is_enough ? channel_.glance(object) : channel_.upload(object, std::nullopt);
  adapt();
  // A transfer that was given up is no reason to end the run.
  if (!answer && answer.error().of == Error::Of::scenario) {
    steps::SdoAnswer given_up;
    given_up.kind = steps::SdoAnswer::Kind::gave_up;
    given_up.detail = answer.error().what;
    return given_up;
  }
  return answer;
}

void RunSession::note_sent(std::size_t index) {
  const auto first = recorder_.first_effect(index);
  if (std::exchange(request_open_, false) || stimulus_open_) request_ = first;
  if (std::exchange(stimulus_open_, false)) window_.first = first;
  window_.anchor = recorder_.capture().frames()[index].time;
}

void RunSession::adapt() {
  profile_.sdo_timeout = channel_.timeout();
  profile_.quiet_time = channel_.quiet();
  // An acknowledge is an answer, too.
  profile_.block_timeout = std::max(profile_.block_timeout, channel_.timeout());
}

Result<std::optional<std::size_t>> RunSession::find_answer(const Match& match,
                                                           std::optional<Duration> within) {
  const auto limit = within.value_or(profile_.sdo_timeout);
  auto found = recorder_.find(std::max(window_.first, request_), match, window_.anchor + limit);
  if (!found || !*found) return found;
  const auto& captured = recorder_.capture().frames()[**found];
  const bool answers = captured.frame.is_data(canopen::connection_set(node()).sdo_response);
  // A server's own time-out is no answer, and what a line gives a time of its own is known to be slow.
  const auto abort = canopen::decode_abort(captured.frame.bytes());
  const bool times_out = abort && abort->code == canopen::abort::timed_out;
  if (answers && !within && !times_out) {
    channel_.note_latency(std::max(Duration(0), captured.time - window_.anchor));
    adapt();
  }
  return found;
}

Result<steps::SdoAnswer> RunSession::upload(Multiplexer object, std::optional<Duration> timeout) {
  auto answers = transfer({{.request = {.upload = true, .object = object}, .timeout = timeout}});
  if (!answers) return std::unexpected(answers.error());
  return std::move(answers->front());
}

Result<void> RunSession::will_change(Multiplexer object) {
  written_since_reset_.insert(object);
  if (profile_.is_untouchable(object)) {
    return fail_scenario(to_string(object) + " must not be written: untouchable in the device profile");
  }
  const auto* found = entry(object);
  if (found != nullptr && found->command) recorder_.observer().commanding(object);
  if (found != nullptr && !found->readable()) return {};
  // What no description names may still be changed by a device that has it. Program control (CiA 302-3) is
  // all commands.
  const bool program = canopen::is_program_control(object.index);
  if (program) long_values_.forget();
  if (object.index == Index(0x1011)) forget_long_values();
  note_open(object);
  if (found == nullptr && (program || channel_.is_open())) return {};
  // In the middle of a conversation a look at the entry would end the transfer that the scenario is about.
  if (channel_.is_open() && before_write_.contains(object)) return {};
  // In Stopped nobody answers (CiA 301, 7.3.2.2.4): a look would be waited for in vain, and forget what is
  // known.
  if (stopped_ && before_write_.contains(object)) return {};
  auto before = value_before_change(object);
  if (!before) return std::unexpected(before.error());
  if (before->kind != steps::SdoAnswer::Kind::confirmed) {
    before_write_.erase(object);
    return {};
  }
  before_write_[object] = before->data;
  // A write to a command has an effect, not a value: writing the old value back would be another command.
  if (found != nullptr && found->command) return {};
  // Nor can a value be put back that only the device itself sets, like an error field.
  if (found != nullptr && found->may_change && !found->writable()) return {};
  if (std::ranges::find(journal_, object, &Change::object) == journal_.end()) {
    recorder_.observer().changing(object, before->data);
    journal_.push_back({object, before->data});
    note_open(object);
  }
  return {};
}

void RunSession::note_open(Multiplexer object) {
  const auto change = std::ranges::find(journal_, object, &Change::object);
  if (change == journal_.end()) return;
  ++change->open;
  change->refused = false;
}

Result<steps::SdoAnswer> RunSession::value_before_change(Multiplexer object) {
  const auto* found = entry(object);
  const auto* known = found != nullptr && found->may_change ? nullptr : long_values_.find(object);
  if (known == nullptr) {
    auto out = peek(object);
    long_values_.forget(object);
    return out;
  }
  steps::SdoAnswer out;
  out.kind = steps::SdoAnswer::Kind::confirmed;
  out.data = *known;
  long_values_.forget(object);
  return out;
}

/// `size`: bytes of what the device has confirmed.
void RunSession::note_written(Multiplexer object, std::size_t size) {
  const auto change = std::ranges::find(journal_, object, &Change::object);
  if (change != journal_.end()) change->long_now = size >= LongValues::least && size != change->before.size();
}

/// A device that says so may still be wrong, but of a long value this is not looked after.
void RunSession::note_refused(Multiplexer object) {
  const auto change = std::ranges::find(journal_, object, &Change::object);
  if (change == journal_.end() || change->before.size() < LongValues::least) return;
  change->refused = --change->open == 0;
  if (change->refused) long_values_.note(object, change->before);
}

Result<steps::SdoAnswer> RunSession::download(Multiplexer object, Bytes data, canopen::SdoDownload::Mode mode,
                                              std::optional<Duration> timeout) {
  auto answers =
      transfer({{.request = {.upload = false, .object = object, .data = std::move(data), .mode = mode},
                 .timeout = timeout}});
  if (!answers) return std::unexpected(answers.error());
  return std::move(answers->front());
}

Result<steps::SdoAnswer> RunSession::prepare(Multiplexer object, Bytes data) {
  if (auto noted = will_change(object); !noted) return std::unexpected(noted.error());
  return channel_.download(object, std::move(data), canopen::SdoDownload::Mode::automatic, std::nullopt);
}

Result<std::vector<steps::SdoAnswer>> RunSession::transfer(const std::vector<steps::SdoJob>& jobs) {
  for (const auto& job : jobs) {
    if (auto allowed = guard_.judge(job); !allowed) return std::unexpected(allowed.error());
    if (job.request.upload) continue;
    if (auto noted = will_change(job.request.object); !noted) return std::unexpected(noted.error());
  }
  if (auto reached = await_state(); !reached) return std::unexpected(reached.error());
  auto answers = channel_.run(jobs);
  adapt();
  if (!answers) return answers;
  note_sent(channel_.first_request());
  window_.anchor = channel_.last_request();
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto& request = jobs[i].request;
    const auto& answer = (*answers)[i];
    const bool refused = answer.kind == steps::SdoAnswer::Kind::aborted;
    if (!request.upload) {
      write_refused_ = refused;
      if (answer.kind == steps::SdoAnswer::Kind::confirmed) note_written(request.object, request.data.size());
      if (refused) note_refused(request.object);
    }
    if (answer.kind == steps::SdoAnswer::Kind::silence) silence_seen_ = true;
    // A refused one shows in the case that tries it, and costs no look at the whole dictionary.
    if (!request.upload && !refused && request.object.index == Index(0x1011))
      restored_.insert(request.object.sub);
  }
  return answers;
}

void RunSession::set_emcy_can_id(CanId id) {
  emcy_can_id_ = id;
  if (std::ranges::find(emcy_can_ids_, id) == emcy_can_ids_.end()) emcy_can_ids_.push_back(id);
}

void RunSession::watch_emcy(Multiplexer object, const Bytes& value) {
  if (object == emcy_entry && value.size() == 4) {
    set_emcy_can_id(canopen::can_id_of(CobId(static_cast<std::uint32_t>(load_le(value)))));
  } else if (object == emcy_inhibit_entry && value.size() == 2) {
    emcy_inhibit_ = std::chrono::microseconds(100) * static_cast<std::int64_t>(load_le(value));
    // Behind a reset what was held before runs no more.
    longest_emcy_inhibit_ =
        emcy_inhibit_is_known_ ? std::max(longest_emcy_inhibit_, emcy_inhibit_) : emcy_inhibit_;
    emcy_inhibit_is_known_ = true;
  }
}

std::optional<Bytes> RunSession::before_last_write(Multiplexer object) const {
  const auto found = before_write_.find(object);
  return found == before_write_.end() ? std::nullopt : std::optional(found->second);
}

Result<void> RunSession::nmt(canopen::NmtCommand what) {
  if (auto allowed = guard_.judge(canopen::encode(what, node())); !allowed) return allowed;
  return command(what);
}

Result<void> RunSession::play_heartbeat(NodeId other, canopen::NmtState state) {
  if (!may_play_nodes())
    return fail_scenario("the run does not allow to play node " + std::to_string(other.value()),
                         "--allow motion, or name an error trigger in the device profile");
  return send_unguarded(canopen::encode_heartbeat(other, state));
}

Result<void> RunSession::command(canopen::NmtCommand command) {
  auto sent = recorder_.send(canopen::encode(command, node()));
  if (!sent) return std::unexpected(sent.error());
  note_sent(*sent);
  note_command(*sent);
  return {};
}

void RunSession::note_command(std::size_t index) {
  using canopen::NmtCommand;
  using canopen::NmtState;
  state_changed_ = true;
  const auto& [frame, time, direction, comment] = recorder_.capture().frames()[index];
  const bool to_device =
      frame.is_data(CanId(0)) && frame.size() == 2 && (frame.data[1] == 0 || frame.data[1] == node().value());
  const auto command = to_device ? canopen::nmt_command_at(frame.data[0]) : std::nullopt;
  if (!command) return;
  if (canopen::is_reset(*command)) {
    reset_ = index;
    ordered_.reset();
    stopped_ = false;
    // However it was sent: to all nodes, by a step that sends a frame, within a conversation.
    device_was_reset();
    reset_was_of_node_ = *command == NmtCommand::reset_node;
    return;
  }
  const auto state = *command == NmtCommand::start  ? NmtState::operational
                     : *command == NmtCommand::stop ? NmtState::stopped
                                                    : NmtState::pre_operational;
  stopped_ = state == NmtState::stopped;
  was_stopped_ = was_stopped_ || stopped_;
  ordered_ = Ordered{index, time, state, !ordered_ || time >= ordered_->sent + profile_.nmt_time};
}

BusTime RunSession::emcy_held_until() const {
  constexpr auto margin = std::chrono::milliseconds(20);
  if (emcy_inhibit_ == Duration::zero()) return {};
  const auto latest = latest_emcy(first_frame_);
  return latest ? *latest + emcy_inhibit_ + margin : BusTime{};
}

std::optional<BusTime> RunSession::latest_emcy(std::size_t from) const {
  const auto& frames = recorder_.capture().frames();
  for (auto i = frames.size(); i > from; --i) {
    if (was_emcy(frames[i - 1])) return frames[i - 1].time;
  }
  return std::nullopt;
}

void RunSession::error_changed(std::uint16_t code, bool raised) {
  if (raised ? raised_.insert(code).second : raised_.erase(code) > 0) ++emcys_due_;
}

Duration RunSession::time_to_follow() const {
  const bool is_due = ordered_ && !at_once_ && window_.anchor < ordered_->sent + profile_.nmt_time;
  return is_due ? profile_.nmt_time : Duration(0);
}

Result<void> RunSession::await_state() {
  if (!ordered_ || at_once_) return {};
  const auto [index, sent, state, alone] = *std::exchange(ordered_, std::nullopt);
  // Of several commands in a row a heartbeat may show the state of an earlier one.
  const auto shows_it = [state, alone, node = node()](const can::CapturedFrame& captured) {
    if (!alone || captured.direction != can::Direction::received) return false;
    const auto shown = canopen::decode_error_control(captured.frame, node);
    return shown && shown->state == state;
  };
  const auto until = sent + profile_.nmt_time;
  const auto shown = recorder_.find(index + 1, shows_it, until);
  if (!shown) return std::unexpected(shown.error());
  const auto reached = *shown ? recorder_.capture().frames()[**shown].time : until;
  if (window_.anchor >= reached) return {};
  const auto& frames = recorder_.capture().frames();
  auto first = *shown ? **shown + 1 : std::max(window_.first, index + 1);
  while (first < frames.size() && frames[first].time <= reached) ++first;
  window_ = {std::max(window_.first, first), reached};
  return {};
}

Result<void> RunSession::produce(steps::Production production) {
  if (auto allowed = guard_.judge(production.frame); !allowed) return allowed;
  if (auto reached = await_state(); !reached) return reached;
  recorder_.produce(std::move(production));
  return {};
}

Result<void> RunSession::send(const can::Frame& frame) {
  if (auto allowed = guard_.judge(frame); !allowed) return allowed;
  return send_unguarded(frame);
}

Result<void> RunSession::send_unguarded(const can::Frame& frame) {
  // A conversation must not take an answer that is late for the answer to its own request.
  if (channel_.expects_late_answers() && frame.is_data(canopen::connection_set(node()).sdo_request)) {
    if (auto idle = channel_.make_idle(); !idle) return idle;
    channel_.dirty(false);
  }
  const bool commands = !frame.extended && frame.id == 0;
  if (!commands) {
    if (auto reached = await_state(); !reached) return reached;
  }
  const bool requests = frame.is_data(canopen::connection_set(node()).sdo_request);
  if (requests && !at_once_) {
    if (auto rested = channel_.rest_after_abort(); !rested) return rested;
  }
  auto sent = recorder_.send(frame);
  if (!sent) return std::unexpected(sent.error());
  note_sent(*sent);
  if (commands) note_command(*sent);
  if (!frame.remote && !frame.extended) channel_.note_sent(frame);
  if (requests && frame.size() > 0 && frame.data[0] == 0x80)
    channel_.note_abort(recorder_.capture().frames()[*sent].time);
  return {};
}

bool RunSession::has_guarded(std::size_t from) const {
  const auto id = canopen::connection_set(node()).error_control.value();
  const auto& frames = recorder_.capture().frames();
  return std::any_of(frames.begin() + static_cast<std::ptrdiff_t>(from), frames.end(),
                     [id](const can::CapturedFrame& each) {
                       return each.frame.remote && !each.frame.extended && each.frame.id == id;
                     });
}

bool RunSession::was_guarded() {
  guarded_ = guarded_ || has_guarded(looked_for_guarding_);
  looked_for_guarding_ = recorder_.capture().size();
  return guarded_;
}

Result<steps::Window> RunSession::window_after(std::string_view label) const {
  const auto found = labels_.find(label);
  if (found == labels_.end())
    return fail_scenario("nothing came at the step labelled '" + std::string(label) + "'");
  return found->second;
}

void RunSession::consume(std::size_t index) {
  const auto recorded = recorder_.capture().size();
  if (index >= recorded) {
    window_ = {recorded, recorder_.now()};
    return;
  }
  window_.first = std::max(window_.first, index + 1);
}

void RunSession::label(std::string_view name, std::size_t capture_index) {
  labels_.insert_or_assign(
      std::string(name), steps::Window{capture_index + 1, recorder_.capture().frames()[capture_index].time});
}

void RunSession::label(const steps::Step& step, const steps::Actual& actual) {
  // The same window as a step has that follows at once: what came between request and response is in it.
  const bool sent = step.action->acts() && !stimulus_open_;
  if (sent && step.action->label_is_on_request()) {
    labels_.insert_or_assign(step.label, window_);
  } else if (actual.decisive) {
    label(step.label, *actual.decisive);
  }
}

Result<void> RunSession::power_cycle() {
  if (!power_switch_) return Session::power_cycle();
  if (auto allowed = guard_.needs({steps::Tier::config, "switch the power of the device"}); !allowed)
    return allowed;
  const auto first = recorder_.capture().size();
  if (auto done = power_switch_(); !done) {
    auto error = done.error();
    error.what = "the power of the device could not be switched: " + error.what;
    return std::unexpected(std::move(error));
  }
  // What was sent to it before, and what it was told, is gone with the power.
  stimulus_open_ = false;
  ordered_.reset();
  device_restarted();
  window_ = {first, recorder_.now()};
  return {};
}

void RunSession::device_was_reset() {
  written_since_reset_.clear();
  channel_.forget_silences();
  guarded_ = false;
  looked_for_guarding_ = recorder_.capture().size();
  ++resets_;
  set_emcy_can_id(home_emcy_can_id_);
  emcy_inhibit_is_known_ = false;
  before_write_.clear();
  forget_long_values();
}

void RunSession::forget_long_values() {
  long_values_.forget_if([this](Multiplexer object) {
    const auto* known = entry(object);
    return known == nullptr || known->writable();
  });
}

void RunSession::begin_case(scenario::Risk risk) {
  guard_.begin_case(risk);
  names_.clear();
  labels_.clear();
  journal_.clear();
  before_write_.clear();
  window_ = {recorder_.capture().size(), recorder_.now()};
  first_frame_ = window_.first;
  emcys_due_ = 0;
  was_stopped_ = false;
  raised_.clear();
  object_ = nullptr;
  silence_seen_ = false;
  write_refused_ = false;
  longest_emcy_inhibit_ = emcy_inhibit_;
  emcy_can_ids_ = {emcy_can_id_};
}

void RunSession::begin_step(const steps::Step& step) {
  stimulus_open_ = step.action->acts();
  object_ = step.action->object();
  at_once_ = step.at_once;
}

std::string RunSession::words_of(const steps::Step& step) {
  if (step.action == nullptr) return {};
  asks_nothing_ = true;
  auto words = printable(step.action->words(*this));
  asks_nothing_ = false;
  return words;
}

std::vector<Change> RunSession::take_journal() { return std::exchange(journal_, {}); }

std::optional<std::size_t> RunSession::take_reset() { return std::exchange(reset_, std::nullopt); }

bool RunSession::take_state_changed() { return std::exchange(state_changed_, false); }

}  // namespace conform::engine
