// SPDX-License-Identifier: Apache-2.0
#include "engine/lasting_errors.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

#include "canopen/cob_id.hpp"
#include "canopen/nmt.hpp"
#include "engine/baseline.hpp"
#include "engine/liveness.hpp"

namespace conform::engine {
namespace {

constexpr Multiplexer error_register{Index(0x1001), SubIndex(0)};
constexpr Multiplexer emcy_cob_id{Index(0x1014), SubIndex(0)};
constexpr Multiplexer emcy_inhibit_time{Index(0x1015), SubIndex(0)};

}  // namespace

Result<void> LastingErrors::look() {
  auto errors = has_errors();
  if (!errors) return std::unexpected(errors.error());
  none_at_first_ = !*errors;
  auto messages = run_.session.is_present(emcy_cob_id, false);
  if (!messages) return std::unexpected(messages.error());
  if (*messages) {
    const auto held = run_.session.peek(emcy_cob_id);
    if (!held) return std::unexpected(held.error());
    messages = !confirmed(*held) || (load_le(held->data) & canopen::cob_id::bit31) == 0;
  }
  has_messages_ = *messages;
  auto inhibit = run_.session.is_present(emcy_inhibit_time, false);
  if (!inhibit) return std::unexpected(inhibit.error());
  if (!*inhibit) return {};
  if (auto held = run_.session.peek(emcy_inhibit_time); !held) return std::unexpected(held.error());
  return {};
}

Result<void> LastingErrors::end_those_of(const result::CaseResult& result) {
  if (auto done = await_late_ones(result.first_frame); !done) return done;
  if (auto done = let_emcy_end(result.first_frame); !done) return done;
  if (auto done = clear_what_stays(result); !done) return done;
  return await_error_reset(result.first_frame);
}

Result<void> LastingErrors::let_end(std::size_t from) {
  if (auto done = let_emcy_end(from); !done) return done;
  return await_error_reset(from);
}

Result<bool> LastingErrors::has_errors() {
  const auto held = run_.session.peek(error_register);
  if (!held) return std::unexpected(held.error());
  return confirmed(*held) && load_le(held->data) != 0;
}

/// By a trigger of the profile, or in any other way that it sends an EMCY about. Without EMCY nobody knows,
/// and in Stopped it may send none (7.3.2.2.5, table 37).
bool LastingErrors::has_raised_errors(std::size_t from) const {
  if (!has_messages_ || run_.session.was_stopped() || run_.session.find("trigger_delay") != nullptr)
    return true;
  const auto& frames = run_.recorder.capture().frames();
  return std::any_of(frames.begin() + static_cast<std::ptrdiff_t>(from), frames.end(),
                     [this](const can::CapturedFrame& captured) {
                       const auto& frame = captured.frame;
                       if (run_.session.was_emcy(captured))
                         return frame.size() == 8 && (frame.data[0] != 0 || frame.data[1] != 0);
                       const auto shown = canopen::decode_error_control(frame, run_.profile.node);
                       return shown && shown->state == canopen::NmtState::stopped;
                     });
}

/// A device that takes its time with EMCYs has not sent all of those yet that the case has brought about.
Result<void> LastingErrors::await_late_ones(std::size_t from) {
  constexpr auto patience = std::chrono::milliseconds(150);
  // Some errors are told by no message, however long one waits.
  constexpr int most_in_vain = 20;
  auto& session = run_.session;
  const auto is_emcy = [&session](const can::CapturedFrame& captured) { return session.was_emcy(captured); };
  const auto& frames = run_.recorder.capture().frames();
  const auto begin = frames.begin() + static_cast<std::ptrdiff_t>(from);
  if (!has_messages_ || session.emcys_due() == 0 || late_in_vain_ >= most_in_vain ||
      std::any_of(begin, frames.end(), is_boot_up_of(run_.profile.node)))
    return {};
  auto seen = static_cast<std::size_t>(std::count_if(begin, frames.end(), is_emcy));
  for (; seen < session.emcys_due(); ++seen) {
    // It may have to keep its distance from the one before, which may be of an earlier case.
    const auto inhibit = session.longest_emcy_inhibit();
    const auto latest = inhibit > Duration::zero() ? session.latest_emcy(0) : std::nullopt;
    const auto may_leave = latest ? std::max(session.now(), *latest + inhibit) : session.now();
    auto told = run_.recorder.find(frames.size(), is_emcy, may_leave + patience);
    if (!told) return std::unexpected(told.error());
    late_in_vain_ = *told ? 0 : late_in_vain_ + 1;
    if (!*told) return {};
  }
  return {};
}

Result<void> LastingErrors::let_emcy_end(std::size_t from) {
  auto& session = run_.session;
  // A device may keep to the inhibit time that it held when the last message went out.
  const auto inhibit = session.longest_emcy_inhibit();
  constexpr auto margin = std::chrono::milliseconds(10);
  constexpr int most_held_back = 48;  // a case may raise and clear a dozen errors one after the other
  for (int held = 0; inhibit > Duration::zero() && held < most_held_back; ++held) {
    const auto latest = session.latest_emcy(from);
    if (!latest || *latest + inhibit + margin <= session.now()) return {};
    if (auto waited = session.wait_until(*latest + inhibit + margin); !waited) return waited;
  }
  return {};
}

/// An error that has gone may be told of later (EMCY 0000h): in the next case it would be an EMCY out of
/// nowhere.
Result<void> LastingErrors::await_error_reset(std::size_t from) {
  constexpr auto patience = std::chrono::milliseconds(500);
  constexpr int most_in_vain = 3;
  if (in_vain_ >= most_in_vain || !run_.may(scenario::Risk::config)) return {};
  auto& session = run_.session;
  const auto& frames = run_.recorder.capture().frames();
  const auto restarted = is_boot_up_of(run_.profile.node);
  for (auto i = frames.size();; --i) {
    // Nothing was told, or a reset has made the device forget.
    if (i == from || restarted(frames[i - 1])) return {};
    const auto& frame = frames[i - 1].frame;
    if (!session.was_emcy(frames[i - 1]) || frame.size() != 8) continue;
    // The end of one of several errors is followed by that of the others.
    if (frame.data[0] == 0 && frame.data[1] == 0 && frame.data[2] == 0) return {};
    break;
  }
  const auto next = frames.size();
  auto stays = has_errors();
  if (!stays) return std::unexpected(stays.error());
  if (*stays) return {};
  auto told = run_.recorder.find(
      next, [&session](const can::CapturedFrame& captured) { return session.was_emcy(captured); },
      session.now() + patience);
  if (!told) return std::unexpected(told.error());
  if (!*told) {
    ++in_vain_;
    return {};
  }
  // It began an inhibit time of its own, perhaps the one that was put back since.
  return let_emcy_end(from);
}

/// Where the device knew of no error at first, a reset ends those of the case that did not end by themselves.
Result<void> LastingErrors::clear_what_stays(const result::CaseResult& result) {
  if (!none_at_first_ || !run_.may(scenario::Risk::config) || !has_raised_errors(result.first_frame))
    return {};
  auto stays = has_errors();
  if (!stays) return std::unexpected(stays.error());
  if (!*stays) return {};
  // Perhaps it has not noticed yet.
  auto& session = run_.session;
  if (auto waited = session.wait_until(session.now() + std::chrono::milliseconds(200)); !waited)
    return waited;
  stays = has_errors();
  if (!stays) return std::unexpected(stays.error());
  if (!*stays) return {};
  if (auto booted = reset(run_, canopen::NmtCommand::reset_node); !booted)
    return std::unexpected(booted.error());
  if (auto ready = enter_pre_operational(run_); !ready) return ready;
  stays = has_errors();
  if (!stays) return std::unexpected(stays.error());
  if (*stays) {
    none_at_first_ = false;
    run_.note("since " + result.name() +
              " the device tells of an error (1001h) that nothing ends, not even a reset");
  }
  return {};
}

}  // namespace conform::engine
