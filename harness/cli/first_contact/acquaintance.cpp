// SPDX-License-Identifier: Apache-2.0
#include "cli/first_contact/acquaintance.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "canopen/cob_id.hpp"
#include "canopen/lss.hpp"
#include "canopen/nmt.hpp"
#include "engine/liveness.hpp"

namespace conform::cli {
namespace {

using canopen::LssCommand;

// A program that is loaded at the start may take its time.
constexpr Duration longest_boot = std::chrono::seconds(15);
constexpr int resets = 2;

/// The longest time from a request to the answer that came next.
Duration slowest_answer(const can::Capture& capture, NodeId node) {
  const auto own = canopen::connection_set(node);
  Duration out{};
  std::optional<BusTime> asked;
  for (const auto& each : capture.frames()) {
    if (each.direction == can::Direction::transmitted && each.frame.is_data(own.sdo_request))
      asked = each.time;
    if (each.direction == can::Direction::received && each.frame.is_data(own.sdo_response) && asked)
      out = std::max(out, each.time - *std::exchange(asked, std::nullopt));
  }
  return out;
}

/// Between two messages of error control in the same state.
std::optional<Duration> heartbeat_period(const can::Capture& capture, NodeId node) {
  const auto id = canopen::connection_set(node).error_control;
  std::optional<Duration> longest;
  const can::CapturedFrame* last = nullptr;
  for (const auto& each : capture.frames()) {
    if (each.direction != can::Direction::received || !each.frame.is_data(id) || each.frame.size() != 1)
      continue;
    if (last != nullptr && last->frame.data[0] == each.frame.data[0] && each.frame.data[0] != 0)
      longest = std::max(longest.value_or(Duration{}), each.time - last->time);
    last = &each;
  }
  return longest;
}

Result<bool> comes(engine::RunSession& session, std::size_t from, CanId id, Duration within,
                   const std::function<bool(const can::Frame&)>& is_it) {
  auto found = session.recorder().find(
      from,
      [&](const can::CapturedFrame& captured) {
        return captured.direction == can::Direction::received && captured.frame.is_data(id) &&
               is_it(captured.frame);
      },
      session.now() + within);
  if (!found) return std::unexpected(found.error());
  return found->has_value();
}

/// One guard request. Where it would begin life guarding, or where heartbeats take its place (CiA 301,
/// 7.2.8.3.2.1), none is sent.
Result<void> try_guarding(engine::RunSession& session, Acquaintance& out) {
  const bool life = out.number(0x100C, 0).value_or(0) != 0 && out.number(0x100D, 0).value_or(0) != 0;
  if (life || out.number(0x1017, 0).value_or(0) != 0 || out.heartbeat_period) return {};
  const auto from = session.capture().size();
  const auto id = canopen::connection_set(session.node()).error_control;
  if (auto sent = session.send(can::remote_frame(id, 1)); !sent) return sent;
  auto answered = comes(session, from, id, session.profile().sdo_timeout,
                        [](const can::Frame& frame) { return frame.size() == 1; });
  if (!answered) return std::unexpected(answered.error());
  // Some adapters send no remote frames: silence says nothing of the device.
  if (*answered) out.node_guarding = true;
  return {};
}

/// Its own address as a range of one: nobody else answers, and no state is left.
Result<void> try_lss(engine::RunSession& session, Acquaintance& out) {
  canopen::LssAddress address{};
  for (std::uint8_t part = 0; part < canopen::lss_parts; ++part) {
    const auto number = out.number(0x1018, static_cast<std::uint8_t>(part + 1));
    if (!number) return {};
    address[part] = static_cast<std::uint32_t>(*number);
  }
  const auto from = session.capture().size();
  const std::pair<LssCommand, std::uint32_t> frames[] = {
      {LssCommand::identify_vendor, address[0]},       {LssCommand::identify_product, address[1]},
      {LssCommand::identify_revision_low, address[2]}, {LssCommand::identify_revision_high, address[2]},
      {LssCommand::identify_serial_low, address[3]},   {LssCommand::identify_serial_high, address[3]}};
  for (const auto& [command, number] : frames) {
    if (auto sent = session.send(canopen::encode_lss_number(command, number)); !sent) return sent;
  }
  auto answered =
      comes(session, from, canopen::lss_response_can_id, session.profile().lss_timeout,
            [](const can::Frame& frame) {
              return frame.size() == 8 && frame.data[0] == static_cast<std::uint8_t>(LssCommand::identified);
            });
  if (!answered) return std::unexpected(answered.error());
  out.lss = *answered;
  return {};
}

Result<void> measure_boot(engine::RunSession& session, Acquaintance& out) {
  for (int i = 0; i < resets; ++i) {
    const auto from = session.capture().size();
    if (auto sent = session.command(canopen::NmtCommand::reset_node); !sent) return sent;
    const auto sent_at = session.capture().frames()[from].time;
    auto booted =
        session.recorder().find(from, engine::is_boot_up_of(session.node()), session.now() + longest_boot);
    if (!booted) return std::unexpected(booted.error());
    if (!*booted) {
      out.boot_time.reset();
      break;
    }
    out.boot_time =
        std::max(out.boot_time.value_or(Duration{}), session.capture().frames()[**booted].time - sent_at);
  }
  return {};
}

}  // namespace

const engine::ScannedObject* Acquaintance::find(std::uint16_t index) const {
  const auto found = std::ranges::find(objects, Index(index), &engine::ScannedObject::index);
  return found == objects.end() ? nullptr : &*found;
}

std::optional<std::uint64_t> Acquaintance::number(std::uint16_t index, std::uint8_t sub) const {
  const auto* object = find(index);
  if (object == nullptr) return std::nullopt;
  const auto entry = std::ranges::find(object->entries, Multiplexer{Index(index), SubIndex(sub)},
                                       &engine::ScannedEntry::mux);
  if (entry == object->entries.end() || !entry->value || entry->value->empty() || entry->value->size() > 8)
    return std::nullopt;
  return load_le(*entry->value);
}

Result<Acquaintance> get_to_know(engine::RunSession& session, const FirstLook& how) {
  Acquaintance out;
  out.node = session.node();
  const auto liveness = engine::probe(session, {});
  if (!liveness) return std::unexpected(liveness.error());
  if (!liveness->answers)
    return fail("node " + std::to_string(session.node().value()) + " does not answer", {},
                "node-ID, bit rate, power? 'canopen-conform doctor' tells what is heard");
  // Nothing is written back: the look is to leave the device as it is.
  engine::ScanOptions what;
  what.ranges = how.ranges;
  what.progress = how.progress;
  auto objects = engine::scan(session, what);
  if (!objects) return std::unexpected(objects.error());
  out.objects = std::move(*objects);
  session.begin_case(how.allow);
  auto block = session.offers_block_transfer(true);
  if (!block && session.recorder().fault()) return std::unexpected(block.error());
  out.block_upload = block.value_or(false);
  // Listens as long as that takes.
  auto others = session.others_heard();
  if (!others) return std::unexpected(others.error());
  out.others = *others;
  out.heartbeat_period = heartbeat_period(session.capture(), session.node());
  if (how.allow >= steps::Tier::config) {
    auto download = session.offers_block_transfer(false);
    if (!download && session.recorder().fault()) return std::unexpected(download.error());
    out.block_download = download.value_or(false);
    if (auto done = try_guarding(session, out); !done) return std::unexpected(done.error());
    if (auto done = try_lss(session, out); !done) return std::unexpected(done.error());
    if (auto done = measure_boot(session, out); !done) return std::unexpected(done.error());
  }
  out.slowest_answer = slowest_answer(session.capture(), session.node());
  return out;
}

}  // namespace conform::cli
