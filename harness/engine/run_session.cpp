// SPDX-License-Identifier: Apache-2.0
#include "engine/run_session.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/pdo.hpp"
#include "canopen/sdo_initiate.hpp"
#include "engine/mapping_probe.hpp"

namespace conform::engine {
namespace {
constexpr Multiplexer emcy_entry{Index(0x1014), SubIndex(0)};

/// 101x or 110x: initiate request of a block upload (its block size, no CRC) or download (its size).
std::array<std::uint8_t, 8> block_initiate(std::uint8_t command, Multiplexer object, std::uint8_t size) {
  return {command,
          static_cast<std::uint8_t>(object.index.value() & 0xFFU),
          static_cast<std::uint8_t>(object.index.value() >> 8U),
          object.sub.value(),
          size,
          0,
          0,
          0};
}

/// The aborts of a server without block transfer: 0504 0001h, and what is tolerated in its place.
bool refuses_block_transfer(const std::array<std::uint8_t, 8>& answer) {
  if (answer[0] != 0x80) return false;
  const auto code = load_le(ByteView(answer).subspan(4));
  return code == 0x0504'0001 || code == 0x0800'0000 || code == 0x0601'0000;
}

std::string refusal_words(const std::array<std::uint8_t, 8>& answer, Multiplexer object) {
  const AbortCode code(static_cast<std::uint32_t>(load_le(ByteView(answer).subspan(4))));
  return "abort " + canopen::describe(code) + " when tried with " + to_string(object);
}
}  // namespace

RunSession::RunSession(Recorder& recorder, const device::Profile& profile, device::Dictionary dictionary)
    : recorder_(recorder),
      profile_(profile),
      dictionary_(std::move(dictionary)),
      guard_(profile, dictionary_),
      channel_(recorder, profile.node, profile.sdo_timeout, profile.quiet_time),
      others_(profile.node),
      emcy_can_id_(canopen::connection_set(profile.node).emcy),
      home_emcy_can_id_(emcy_can_id_) {
  channel_.set_known_size([this](Multiplexer object) -> std::optional<std::size_t> {
    const auto* known = entry(object);
    return known != nullptr ? known->size() : std::nullopt;
  });
}

const steps::Value* RunSession::find(std::string_view name) const {
  const auto found = names_.find(name);
  if (found != names_.end()) return &found->second;
  if (!name.starts_with("profile.")) return nullptr;
  const auto time = profile_.duration(name.substr(8));
  if (!time) return nullptr;
  return &profile_names_.insert_or_assign(std::string(name), steps::Value::of_duration(*time)).first->second;
}

Result<steps::Value> RunSession::current() {
  if (object_ == nullptr) return fail("'current' needs a step about an entry", "scenario");
  const auto object = object_->resolve(*this);
  if (!object) return std::unexpected(object.error());
  return read(*object);
}

Result<steps::SdoAnswer> RunSession::peek(Multiplexer object) {
  if (auto reached = await_state(); !reached) return std::unexpected(reached.error());
  auto answer = channel_.upload(object, std::nullopt);
  adapt();
  // A transfer that was given up is no reason to end the run.
  if (!answer && answer.error().where == "scenario") {
    steps::SdoAnswer given_up;
    given_up.kind = steps::SdoAnswer::Kind::gave_up;
    given_up.detail = answer.error().what;
    return given_up;
  }
  return answer;
}

Result<steps::Value> RunSession::read(Multiplexer object) {
  auto answer = peek(object);
  if (!answer) return std::unexpected(answer.error());
  if (answer->kind == steps::SdoAnswer::Kind::confirmed) return steps::Value::of_bytes(answer->data);
  return fail("the value of " + to_string(object) + " cannot be read: " + answer->refusal(), "scenario");
}

Result<steps::Value> RunSession::declared(Multiplexer object, steps::Declared what) {
  const auto* found = entry(object);
  static const device::Entry nothing;
  const auto& known = found != nullptr ? *found : nothing;
  const auto& bytes = what == steps::Declared::low_limit    ? known.low
                      : what == steps::Declared::high_limit ? known.high
                                                            : known.default_value;
  if (!bytes && what == steps::Declared::default_value && object.index == Index(0x1018)) {
    const auto& identity = profile_.identity;
    const std::optional<std::uint32_t> wanted[] = {identity.vendor, identity.product, identity.revision,
                                                   identity.serial};
    const auto sub = object.sub.value();
    if (sub >= 1 && sub <= 4 && wanted[sub - 1]) return steps::Value::of_bytes(to_le(*wanted[sub - 1], 4));
  }
  if (!bytes) return fail("the description of " + to_string(object) + " does not say it", "scenario");
  auto value = steps::Value::of_bytes(*bytes);
  if (value.number && canopen::is_signed(known.type) && bytes->size() < 8 && (bytes->back() & 0x80U) != 0) {
    *value.number |= ~std::uint64_t{0} << (8 * bytes->size());
  }
  return value;
}

Result<bool> RunSession::is_present(Multiplexer object, bool whole_object) {
  if (whole_object) {
    for (const auto& candidate : dictionary_.object(object.index)) {
      const auto known = present_.find(candidate.mux);
      if (known != present_.end() && known->second) return true;
    }
    object.sub = SubIndex(0);
  }
  const auto known = present_.find(object);
  if (known != present_.end()) return known->second;
  auto answer = peek(object);
  if (!answer) return std::unexpected(answer.error());
  using Kind = steps::SdoAnswer::Kind;
  // Silence is neither: to take it for absence would excuse the device from every rule about the entry.
  if (answer->kind == Kind::silence)
    return fail("no answer when " + to_string(object) + " was looked for", "scenario");
  const bool present = answer->kind != Kind::aborted || (answer->code != canopen::abort::no_object &&
                                                         answer->code != canopen::abort::no_sub_index);
  note_present(object, present, present ? "" : "abort " + canopen::describe(answer->code));
  return present;
}

void RunSession::note_present(Multiplexer object, bool present, std::string why) {
  present_[object] = present;
  grounds_[{steps::Asked::presence, object}] = std::move(why);
}

std::string RunSession::grounds(steps::Asked asked, Multiplexer object) const {
  using steps::Asked;
  const auto noted = [this](Asked what, Multiplexer about) {
    const auto found = grounds_.find({what, about});
    return found == grounds_.end() ? std::string() : found->second;
  };
  const auto absent = [&] {
    const auto known = present_.find(object);
    return known != present_.end() && !known->second;
  };
  const auto access = [&] {
    const auto* found = entry(object);
    if (found == nullptr) return std::string();
    return std::string(device::to_string(found->access)) +
           (found->declared_at.empty() ? "" : ", " + found->declared_at);
  };
  switch (asked) {
    case Asked::presence: return noted(asked, object);
    case Asked::mapping: {
      const auto pdo = canopen::pdo_communication(object.index);
      return pdo ? noted(asked, {*pdo, SubIndex(0)}) : std::string();
    }
    case Asked::reading: return absent() ? noted(Asked::presence, object) : access();
    case Asked::writing: {
      if (profile_.is_untouchable(object)) return "untouchable in the profile";
      if (absent()) return noted(Asked::presence, object);
      const auto tried = noted(asked, object);
      return tried.empty() ? access() : tried;
    }
    case Asked::factory_defaults:
      return left_changed_ && profile_.factory_defaults
                 ? "the run could not put back every value, so factory defaults may not be active any more"
                 : "";
    default: return noted(asked, Multiplexer{});
  }
}

bool RunSession::is_claimed(Multiplexer object, bool whole_object) const {
  const auto claimed = [](const device::Entry& entry) {
    return entry.presence() != device::Presence::unclaimed;
  };
  if (whole_object) return std::ranges::any_of(dictionary_.object(object.index), claimed);
  const auto* found = entry(object);
  return found != nullptr && claimed(*found);
}

Result<bool> RunSession::is_readable(Multiplexer object) {
  const auto* found = entry(object);
  if (found != nullptr && !found->readable()) return false;
  return is_present(object, false);
}

Result<bool> RunSession::is_writable(Multiplexer object) {
  if (profile_.is_untouchable(object)) return false;
  auto present = is_present(object, false);
  if (!present || !*present) return present;
  const auto* found = entry(object);
  if (found != nullptr && !found->access_open) return found->writable();
  const auto probed = writable_.find(object);
  if (probed != writable_.end()) return probed->second;
  // The standard leaves rw or const open here: writing back what is there tells, and changes nothing. A
  // command is not tried.
  if (found != nullptr && found->command) return found->writable();
  if (!guard_.may_write(object)) return false;
  const auto what = "try whether " + to_string(object) + " is writable";
  if (auto allowed = guard_.needs({steps::Tier::config, what}); !allowed)
    return std::unexpected(allowed.error());
  auto value = peek(object);
  if (!value) return std::unexpected(value.error());
  const auto silent = [object] {
    return fail("no answer when " + to_string(object) + " was tried", "scenario");
  };
  if (value->kind == steps::SdoAnswer::Kind::silence) return silent();
  // An entry that cannot be read, or is answered against the protocol, was not tried.
  const auto not_tried = [object](std::string_view done, const steps::SdoAnswer& came) {
    return fail("whether " + to_string(object) + " is writable cannot be tried: its value was not " +
                    std::string(done) + ": " + came.refusal(),
                "scenario");
  };
  if (value->kind != steps::SdoAnswer::Kind::confirmed) return not_tried("read", *value);
  auto answer = channel_.download(object, value->data, canopen::SdoDownload::Mode::automatic, std::nullopt);
  if (!answer) return std::unexpected(answer.error());
  if (answer->kind == steps::SdoAnswer::Kind::silence) return silent();
  const bool aborted = answer->kind == steps::SdoAnswer::Kind::aborted;
  if (!aborted && answer->kind != steps::SdoAnswer::Kind::confirmed)
    return not_tried("written back", *answer);
  const bool refused = aborted && answer->code == canopen::abort::read_only;
  if (refused)
    grounds_[{steps::Asked::writing, object}] =
        "its own value was refused: abort " + canopen::describe(answer->code);
  writable_[object] = !refused;
  if (refused) {
    if (auto* known = dictionary_.find(object)) known->access = device::Access::constant;
  }
  return !refused;
}

Result<bool> RunSession::offers_block_transfer(bool upload) {
  auto& known = upload ? offers_block_upload_ : offers_block_download_;
  if (known) return *known;
  if (!upload) {
    auto tried = try_block_download();
    if (tried) known = *tried;
    return tried;
  }
  auto answer = channel_.try_block_initiate(block_initiate(0xA0, {Index(0x1000), SubIndex(0)}, 0x14));
  if (!answer) return std::unexpected(answer.error());
  if (!*answer) return fail("no answer when a block upload was tried", "scenario");
  known = !refuses_block_transfer(**answer);
  if (!*known)
    grounds_[{steps::Asked::block_upload, {}}] = refusal_words(**answer, {Index(0x1000), SubIndex(0)});
  return *known;
}

Result<bool> RunSession::has_variable_mapping(Multiplexer object) {
  constexpr std::string_view feature = "variable mapping";
  if (profile_.claimed(feature)) return true;
  const auto pdo = canopen::pdo_communication(object.index);
  if (!pdo) return fail(to_string(object) + " is not a PDO", "scenario");
  const Multiplexer count{canopen::pdo_mapping(*pdo), SubIndex(0)};
  auto& why = grounds_[{steps::Asked::mapping, {*pdo, SubIndex(0)}}];
  if (profile_.not_claimed.contains(feature)) {
    why = "the profile says so";
    return false;
  }
  const auto known = variable_mappings_.find(*pdo);
  if (known != variable_mappings_.end()) return known->second;
  auto writable = is_writable(count);
  if (!writable) return writable;
  if (!*writable) {
    why = grounds(steps::Asked::writing, count);
    return false;
  }
  if (auto allowed = guard_.needs({steps::Tier::config, "try whether a PDO can be mapped anew"}); !allowed)
    return std::unexpected(allowed.error());
  auto fixed = why_mapping_is_fixed(*this, *pdo);
  if (!fixed) return std::unexpected(fixed.error());
  why = fixed->value_or("");
  return variable_mappings_[*pdo] = !fixed->has_value();
}

/// An entry that may be written: an access error of another one could not be told from "no block transfer".
Result<bool> RunSession::try_block_download() {
  if (auto allowed = guard_.needs({steps::Tier::config, "try a block download"}); !allowed)
    return std::unexpected(allowed.error());
  std::vector<Multiplexer> candidates{{Index(0x1017), SubIndex(0)}, {Index(0x100C), SubIndex(0)}};
  for (const auto& candidate : dictionary_.entries()) {
    const auto size = candidate.size();
    if (candidate.safe && candidate.readable() && candidate.writable() && !candidate.command && size &&
        *size <= 4)
      candidates.push_back(candidate.mux);
  }
  for (const auto object : candidates) {
    const auto* found = entry(object);
    if (found == nullptr || profile_.is_untouchable(object)) continue;
    auto present = is_present(object, false);
    if (!present) return std::unexpected(present.error());
    if (!*present) continue;
    const auto size = static_cast<std::uint8_t>(found->size().value_or(0));
    auto answer = channel_.try_block_initiate(block_initiate(0xC2, object, size));
    if (!answer) return std::unexpected(answer.error());
    if (!*answer) return fail("no answer when a block download was tried", "scenario");
    const auto& data = **answer;
    const AbortCode code(static_cast<std::uint32_t>(load_le(ByteView(data).subspan(4))));
    if (data[0] == 0x80 && code == canopen::abort::read_only) continue;
    const bool refused = refuses_block_transfer(data);
    if (refused) grounds_[{steps::Asked::block_download, {}}] = refusal_words(data, object);
    return !refused;
  }
  grounds_[{steps::Asked::block_download, {}}] =
      "there is nothing to try it with: 1017h and 100Ch cannot be written, and no other number is in safe_objects";
  return false;
}

/// A node that is there shows within some seconds: by its heartbeat, its PDOs, or because somebody talks to
/// it.
Result<std::string> RunSession::others_heard() {
  constexpr auto listened = std::chrono::seconds(5);
  const auto& frames = capture().frames();
  if (!frames.empty() && now() - frames.front().time < listened) {
    if (auto waited = wait_until(frames.front().time + listened); !waited)
      return std::unexpected(waited.error());
  }
  return others_.heard(capture()).value_or("");
}

std::string RunSession::access_of(Multiplexer object) const {
  const auto* found = entry(object);
  return found == nullptr ? "" : std::string(device::to_string(found->access));
}

bool RunSession::may_change(Multiplexer object) const {
  // The history is the device's to write, whether its fields are described or not.
  if (object.index == Index(0x1003)) return true;
  const auto* found = entry(object);
  return found != nullptr && found->may_change;
}

bool RunSession::claims(std::string_view feature) const { return profile_.claimed(feature); }

std::size_t RunSession::error_triggers() const {
  // A heartbeat can stay away only from a device that consumes heartbeats.
  const auto consumer = present_.find({Index(0x1016), SubIndex(1)});
  const bool consumes = consumer != present_.end() && consumer->second;
  return static_cast<std::size_t>(std::ranges::count_if(
      profile_.errors,
      [this, consumes](const auto& trigger) { return trigger.raise || (consumes && may_play_nodes()); }));
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
  if (profile_.is_untouchable(object)) {
    return fail(to_string(object) + " must not be written: untouchable in the device profile", "scenario");
  }
  const auto* found = entry(object);
  if (found != nullptr && found->command) recorder_.observer().commanding(object);
  if (found != nullptr && !found->readable()) return {};
  // What no description names may still be changed by a device that has it. Program control (CiA 302-3) is
  // all commands.
  const bool program = object.index.value() >= 0x1F50 && object.index.value() <= 0x1F5F;
  if (found == nullptr && (program || channel_.is_open())) return {};
  // In the middle of a conversation a look at the entry would end the transfer that the scenario is about.
  if (channel_.is_open() && before_write_.contains(object)) return {};
  auto before = peek(object);
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
  }
  return {};
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
    if (!request.upload) write_refused_ = answer.kind == steps::SdoAnswer::Kind::aborted;
    if (answer.kind == steps::SdoAnswer::Kind::silence) silence_seen_ = true;
    if (answer.kind == steps::SdoAnswer::Kind::confirmed)
      watch_emcy(request.object, request.upload ? answer.data : request.data);
  }
  return answers;
}

void RunSession::watch_emcy(Multiplexer object, const Bytes& value) {
  if (object == emcy_entry && value.size() == 4) {
    emcy_can_id_ = canopen::can_id_of(CobId(static_cast<std::uint32_t>(load_le(value))));
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
    return fail("the run does not allow to play node " + std::to_string(other.value()), "scenario",
                "--allow motion, or name an error trigger in the device profile");
  return send_unguarded(canopen::encode_heartbeat(other, state));
}

Result<void> RunSession::command(canopen::NmtCommand command) {
  auto sent = recorder_.send(canopen::encode(command, node()));
  if (!sent) return std::unexpected(sent.error());
  note_sent(*sent);
  note_command(*sent);
  if (command == canopen::NmtCommand::reset_node || command == canopen::NmtCommand::reset_communication)
    device_was_reset(command == canopen::NmtCommand::reset_node);
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
  if (*command == NmtCommand::reset_node || *command == NmtCommand::reset_communication) {
    reset_ = index;
    ordered_.reset();
    stopped_ = false;
    return;
  }
  const auto state = *command == NmtCommand::start  ? NmtState::operational
                     : *command == NmtCommand::stop ? NmtState::stopped
                                                    : NmtState::pre_operational;
  stopped_ = state == NmtState::stopped;
  ordered_ = Ordered{index, time, state, !ordered_ || time >= ordered_->sent + profile_.nmt_time};
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
  if (!frame.remote && !frame.extended) channel_.note_sent(CanId(frame.id));
  if (requests && frame.size() > 0 && frame.data[0] == 0x80)
    channel_.note_abort(recorder_.capture().frames()[*sent].time);
  return {};
}

Result<steps::Window> RunSession::window_after(std::string_view label) const {
  const auto found = labels_.find(label);
  if (found == labels_.end()) return fail("label '" + std::string(label) + "' was not reached", "scenario");
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

void RunSession::device_was_reset(bool) {
  channel_.forget_silences();
  ++resets_;
  emcy_can_id_ = home_emcy_can_id_;
  before_write_.clear();
}

void RunSession::begin_case(scenario::Risk risk) {
  guard_.begin_case(risk);
  names_.clear();
  labels_.clear();
  journal_.clear();
  before_write_.clear();
  window_ = {recorder_.capture().size(), recorder_.now()};
  object_ = nullptr;
  silence_seen_ = false;
  write_refused_ = false;
}

void RunSession::begin_step(const steps::Step& step) {
  stimulus_open_ = step.action->acts();
  object_ = step.action->object();
  at_once_ = step.at_once;
}

std::vector<Change> RunSession::take_journal() { return std::exchange(journal_, {}); }

std::optional<std::size_t> RunSession::take_reset() { return std::exchange(reset_, std::nullopt); }

bool RunSession::take_state_changed() { return std::exchange(state_changed_, false); }

}  // namespace conform::engine
