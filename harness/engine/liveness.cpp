// SPDX-License-Identifier: Apache-2.0
#include "engine/liveness.hpp"

#include <algorithm>
#include <chrono>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/nmt.hpp"

namespace conform::engine {
namespace {

using Kind = steps::SdoAnswer::Kind;

constexpr Multiplexer device_type{Index(0x1000), SubIndex(0)};

Result<bool> answers(RunSession& session) {
  auto answer = session.peek(device_type);
  if (!answer) return std::unexpected(answer.error());
  return answer->kind != Kind::silence;
}

Result<bool> answers_in_pre_operational(RunSession& session) {
  if (auto sent = session.command(canopen::NmtCommand::pre_operational); !sent)
    return std::unexpected(sent.error());
  if (auto waited = session.wait_until(session.now() + session.profile().nmt_time); !waited)
    return std::unexpected(waited.error());
  return answers(session);
}

/// Listens until the device has started, until it turns out to be running, or until T_BOOT is over.
Result<void> wait_for_start(RunSession& session, std::size_t from) {
  auto heard = session.recorder().find(
      from, [&session](const can::CapturedFrame& captured) { return is_from_node(session, captured); },
      session.now() + session.profile().boot_time);
  if (!heard) return std::unexpected(heard.error());
  if (*heard) session.channel().forget_silences();
  return {};
}

/// Of the answers to one expedited upload the data; empty where it is not answered like that.
Result<std::vector<Bytes>> answers_to(RunSession& session, Multiplexer object, Duration listen) {
  const auto from = session.capture().size();
  auto first = session.peek(object);
  if (!first) return std::unexpected(first.error());
  std::vector<Bytes> out;
  if (first->kind != Kind::confirmed || first->data.size() > 4) return out;
  if (auto waited = session.wait_until(session.now() + listen); !waited)
    return std::unexpected(waited.error());
  const auto id = canopen::connection_set(session.node()).sdo_response;
  const auto& frames = session.capture().frames();
  for (auto i = from; i < frames.size(); ++i) {
    const auto& frame = frames[i].frame;
    if (frames[i].direction != can::Direction::received || !frame.is_data(id) || frame.size() != 8) continue;
    if (frame.data[0] >> 5U == 2 && (frame.data[0] & 2U) != 0)
      out.emplace_back(frame.data.begin() + 4, frame.data.end());
  }
  return out;
}

/// It answers nothing; whether it is there all the same.
Revival heard_since(const RunSession& session, std::size_t from, Revival out) {
  const auto& frames = session.capture().frames();
  const bool heard =
      std::any_of(frames.begin() + static_cast<std::ptrdiff_t>(from), frames.end(),
                  [&session](const can::CapturedFrame& each) { return is_from_node(session, each); });
  out.life = heard ? Alive::there : Alive::gone;
  return out;
}

std::size_t boot_ups_since(const RunSession& session, std::size_t from) {
  const auto& frames = session.capture().frames();
  return static_cast<std::size_t>(std::count_if(frames.begin() + static_cast<std::ptrdiff_t>(from),
                                                frames.end(), is_boot_up_of(session.node())));
}

// So long the second answer may take; two devices of one kind answer within some milliseconds of each other.
constexpr Duration second_answer = std::chrono::milliseconds(100);

}  // namespace

bool is_from_node(const RunSession& session, const can::CapturedFrame& captured) {
  if (captured.direction != can::Direction::received || captured.frame.error || captured.frame.extended)
    return false;
  const auto set = canopen::connection_set(session.node());
  const CanId id(captured.frame.id);
  return id == set.sdo_response || id == set.error_control || id == set.emcy;
}

steps::Session::Match is_boot_up_of(NodeId node) {
  return [node](const can::CapturedFrame& captured) {
    return captured.direction == can::Direction::received && canopen::is_boot_up(captured.frame, node);
  };
}

Result<Liveness> probe(RunSession& session, const Means& means) {
  constexpr int attempts = 3;
  Liveness out;
  const auto from_node = [&session](const can::CapturedFrame& captured) {
    return is_from_node(session, captured);
  };
  for (int attempt = 0; attempt < attempts; ++attempt) {
    auto answered = answers(session);
    if (!answered) return std::unexpected(answered.error());
    if (*answered) {
      out.alive = out.answers = true;
      out.heard = "SDO answer";
      return out;
    }
    auto heard = session.recorder().find(0, from_node, session.now());
    if (!heard) return std::unexpected(heard.error());
    if (!*heard) continue;
    out.alive = true;
    out.heard = "frames of the node, but no SDO answer";
    // Stopped: no SDO there, and legally so.
    const auto& frame = session.capture().frames()[**heard].frame;
    if (frame.is_data(canopen::connection_set(session.node()).error_control) && frame.size() == 1 &&
        frame.data[0] == 0x04)
      break;
  }
  auto revived = look_for_life(session, means);
  if (!revived) return std::unexpected(revived.error());
  out.answers = revived->life == Alive::answers;
  if (revived->life == Alive::there && !out.alive) out.heard = "a boot-up message, but no SDO answer";
  if (out.answers) out.heard = revived->was_reset ? "SDO answer after a reset" : "SDO answer";
  out.alive = out.alive || revived->life != Alive::gone;
  if (out.heard.empty()) out.heard = "nothing";
  return out;
}

Result<Revival> look_for_life(RunSession& session, const Means& means) {
  session.clear_silence_seen();
  Revival out;
  const auto from = session.capture().size();
  const auto boot_time = to_string(session.profile().boot_time);
  out.tried = "no SDO answer, and no frame of it for " + boot_time;
  const auto try_again = [&](auto&& ask) -> Result<bool> {
    auto answered = ask(session);
    if (answered && *answered) out.life = Alive::answers;
    return answered;
  };
  if (auto done = try_again(answers); !done || *done) {
    out.at_once = true;
    return done ? Result<Revival>(out) : std::unexpected(done.error());
  }
  if (means.may_command) {
    // Perhaps it was left in Stopped.
    auto done = try_again(answers_in_pre_operational);
    if (!done || *done) return done ? Result<Revival>(out) : std::unexpected(done.error());
  }
  if (auto waited = wait_for_start(session, from); !waited) return std::unexpected(waited.error());
  if (auto done = try_again(answers); !done || *done)
    return done ? Result<Revival>(out) : std::unexpected(done.error());
  if (means.may_command) {
    const auto reset_from = session.capture().size();
    if (auto sent = session.command(canopen::NmtCommand::reset_node); !sent)
      return std::unexpected(sent.error());
    auto booted = session.recorder().find(reset_from, is_boot_up_of(session.node()),
                                          session.now() + session.profile().boot_time);
    if (!booted) return std::unexpected(booted.error());
    out.was_reset = true;
    out.tried += ", nor after a reset";
    auto done = try_again(answers);
    if (!done || *done) return done ? Result<Revival>(out) : std::unexpected(done.error());
    out.was_reset = false;
  }
  if (means.power_cycle) {
    const auto off = session.capture().size();
    if (auto switched = means.power_cycle(); !switched) {
      if (session.recorder().fault()) return std::unexpected(switched.error());
      out.tried += "; its power could not be switched, " + switched.error().what;
      return heard_since(session, from, std::move(out));
    }
    session.device_restarted();
    out.power_was_switched = true;
    auto booted = session.recorder().find(off, is_boot_up_of(session.node()),
                                          session.now() + session.profile().boot_time);
    if (!booted) return std::unexpected(booted.error());
    out.tried += ", nor after its power was switched";
    auto done = try_again(answers);
    if (!done || *done) return done ? Result<Revival>(out) : std::unexpected(done.error());
  }
  return heard_since(session, from, std::move(out));
}

Result<bool> answers_twice(RunSession& session, Duration listen) {
  auto answers = answers_to(session, device_type, listen);
  if (!answers) return std::unexpected(answers.error());
  return answers->size() > 1;
}

Result<std::optional<std::string>> second_device(RunSession& session, const Means& means) {
  using Found = std::optional<std::string>;
  const auto two = "two devices answer as node " + std::to_string(session.node().value());
  bool serial_number = false;
  for (const auto object :
       {device_type, Multiplexer{Index(0x1018), SubIndex(1)}, Multiplexer{Index(0x1018), SubIndex(2)},
        Multiplexer{Index(0x1018), SubIndex(3)}, Multiplexer{Index(0x1018), SubIndex(4)}}) {
    auto answers = answers_to(session, object, second_answer);
    if (!answers) return std::unexpected(answers.error());
    if (answers->size() < 2) continue;
    const auto& [first, second] = std::pair{answers->front(), answers->at(1)};
    if (first != second)
      return Found(two + ": one request for " + to_string(object) + " was answered with " + hex_bytes(first) +
                   " and with " + hex_bytes(second));
    serial_number = object == Multiplexer{Index(0x1018), SubIndex(4)} && load_le(first) != 0;
  }
  // One serial number is one device, which says everything twice.
  if (serial_number) return Found();
  const auto either =
      two + ", or one that says everything twice: it has no serial number (1018h:04) by which to tell";
  if (!means.may_command) return Found(either);
  const auto from = session.capture().size();
  if (auto sent = session.command(canopen::NmtCommand::reset_node); !sent)
    return std::unexpected(sent.error());
  auto booted = session.recorder().find(from, is_boot_up_of(session.node()),
                                        session.now() + session.profile().boot_time);
  if (!booted) return std::unexpected(booted.error());
  // Devices of one kind need about the same time.
  if (auto waited = session.wait_until(session.now() + std::chrono::milliseconds(500)); !waited)
    return std::unexpected(waited.error());
  return boot_ups_since(session, from) > 1 ? Found(either) : Found();
}

}  // namespace conform::engine
