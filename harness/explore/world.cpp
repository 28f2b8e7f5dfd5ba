// SPDX-License-Identifier: Apache-2.0
#include "explore/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/sdo_fault.hpp"
#include "canopen/sdo_initiate.hpp"
#include "canopen/sdo_request.hpp"

namespace conform::explore {
namespace {

using namespace std::chrono_literals;

constexpr Duration behind_boot_up = 50ms;
/// Behind a fault that ends a transfer, and behind a frame that asks for nothing.
constexpr Duration after_fault = 5ms;
constexpr Duration after_frame = 1ms;
/// LSS answers are waited for: what comes later would be taken for the answer to the next request.
constexpr Duration after_lss = 8ms;
/// A server that never ends a transfer must not end the search.
constexpr std::size_t most_frames_of_a_transfer = 4000;
constexpr std::size_t most_in_flight = 8;

canopen::SdoDownload::Mode mode_of(Transfer transfer) {
  using Mode = canopen::SdoDownload::Mode;
  switch (transfer) {
    case Transfer::expedited_unsized: return Mode::expedited_unsized;
    case Transfer::segmented: return Mode::segmented;
    case Transfer::segmented_unsized: return Mode::segmented_unsized;
    default: return Mode::automatic;
  }
}

}  // namespace

std::string Answer::text() const {
  switch (kind) {
    case Kind::none: return "nothing asked";
    case Kind::confirmed:
      if (data.size() > 16) return fmt::format("confirmed, {} bytes", data.size());
      return data.empty() ? "confirmed" : "confirmed, " + hex_bytes(data);
    case Kind::aborted: return "abort " + canopen::describe(code);
    case Kind::violation: return detail;
    case Kind::silence: return "no answer";
    case Kind::replied: return hex_bytes(data);
  }
  return "";
}

bool Answer::same_as(const Answer& other) const {
  if (kind != other.kind || code != other.code) return false;
  // Who does not tell how many of the four bytes are data has not said that it is all of them.
  const bool open = size_told != other.size_told && data.size() != other.data.size();
  return open ? std::ranges::equal(
                    size_told ? data : other.data,
                    ByteView(size_told ? other.data : data).first(std::min(data.size(), other.data.size())))
              : data == other.data;
}

std::unique_ptr<canopen::SdoClient> client_of(const Action& action) {
  canopen::SdoRequest request;
  request.upload = action.kind == Action::Kind::upload;
  request.object = action.object;
  request.block = action.transfer == Transfer::block || action.transfer == Transfer::block_unsized;
  request.size_told = action.transfer != Transfer::block_unsized;
  request.blksize = action.blksize;
  if (!request.upload) {
    request.data = action.data;
    request.mode = mode_of(action.transfer);
  }
  if (!action.fault.empty()) {
    auto fault = canopen::SdoFault::parse(action.fault);
    if (!fault) return nullptr;
    request.faults.push_back(std::move(*fault));
  }
  auto client = canopen::make_sdo_client(request);
  return client ? std::move(*client) : nullptr;
}

World::World(std::unique_ptr<Place> place, const monitor::Facts& facts,
             std::span<const monitor::Rule* const> chosen)
    : place_(std::move(place)),
      zero_(place_->bus().now()),
      health_(place_->bus().health()),
      node_(facts.node),
      request_(canopen::connection_set(node_).sdo_request),
      response_(canopen::connection_set(node_).sdo_response),
      watch_(facts, chosen),
      watched_(!chosen.empty()) {
  if (auto started = place_->start(); !started) {
    fault_ = started.error();
  } else {
    boot();
  }
}

/// The boot-up message may take its time; what follows it closely belongs to the boot.
void World::boot() {
  const auto boot_up = canopen::connection_set(node_).error_control;
  bool is_up = false;
  while (const auto event = next(BusTime(place_->longest_boot()))) {
    keep(*event);
    is_up = event->direction == can::Direction::received && event->frame.is_data(boot_up);
    if (is_up) break;
  }
  if (!is_up && !fault_) fault_ = place_->without_boot_up();
  run_until(now() + behind_boot_up);
}

void World::fail_by(const Error& error) {
  if (place_->is_real()) {
    fault_ = error;
  } else {
    broken_ = error.text();
  }
}

bool World::distrusted() {
  if (!place_->is_real()) return false;
  const auto now = place_->bus().health();
  return now.has_gap_since(health_) || now.late_frames > health_.late_frames;
}

std::optional<can::BusEvent> World::next(BusTime deadline) {
  if (!broken_.empty() || fault_) return std::nullopt;
  auto event = place_->bus().receive(deadline + zero_.time_since_epoch());
  if (!event) {
    fail_by(event.error());
    return std::nullopt;
  }
  if (!*event) return std::nullopt;
  (*event)->time -= zero_.time_since_epoch();
  if (watched_) {
    trace_.push_back({(*event)->frame, (*event)->time, (*event)->direction, {}});
    watch_.on_frame(trace_.back(), trace_.size() - 1);
  }
  return *event;
}

void World::keep(const can::BusEvent& event) {
  if (event.direction == can::Direction::received && !event.frame.error)
    unasked_.push_back({event.frame, event.time});
}

void World::run_until(BusTime time) {
  while (const auto event = next(time)) keep(*event);
}

void World::send(const can::Frame& frame) {
  if (fault_) return;
  if (auto sent = place_->bus().send(frame); !sent) fail_by(sent.error());
}

Answer World::perform(const Action& action, Duration patience) {
  const auto begin = now();
  Answer out;
  switch (action.kind) {
    case Action::Kind::upload:
    case Action::Kind::download: out = transfer(action, patience); break;
    case Action::Kind::request: out = ask(action, patience); break;
    case Action::Kind::frame:
      if (const auto command = action.nmt_command(node_); command != 0) last_command_ = command;
      send(action.frame);
      run_until(now() + (action.frame.id == canopen::lss_request_can_id.value() ? after_lss : after_frame));
      break;
    case Action::Kind::power:
      if (auto done = place_->switch_power(); !done) fault_ = done.error();
      last_command_ = 0x80;
      if (watched_) watch_.on_loss();
      break;
    case Action::Kind::wait: run_until(now() + action.time); break;
  }
  out.taken = now() - begin;
  out.answered = replied_ < begin ? out.taken : replied_ - begin;
  return out;
}

Answer World::ask(const Action& action, Duration patience) {
  send(action.frame);
  Answer out{.kind = Answer::Kind::silence};
  const auto deadline = now() + patience;
  while (const auto event = next(deadline)) {
    if (!is_reply(*event)) {
      keep(*event);
      continue;
    }
    out.kind = Answer::Kind::replied;
    replied_ = event->time;
    const auto bytes = event->frame.bytes();
    out.data.assign(bytes.begin(), bytes.end());
    if (const auto abort = canopen::decode_abort(bytes)) {
      out.kind = Answer::Kind::aborted;
      out.code = abort->code;
    }
    break;
  }
  return out;
}

Answer World::transfer(const Action& action, Duration patience) {
  const auto client = client_of(action);
  if (!client) return {};
  std::size_t unsent = 0, frames = 0;
  bool replied = false;
  auto since = now();
  while (broken_.empty() && !fault_ && ++frames < most_frames_of_a_transfer) {
    while (!client->ended() && unsent < most_in_flight) {
      const auto frame = client->next(unsent);
      if (!frame) break;
      send(can::data_frame(request_, frame->view()));
      ++unsent;
    }
    if (client->ended() && unsent == 0) {
      // The client closes the channel as the standard has it.
      if (!client->result().reply || std::exchange(replied, true)) break;
      send(can::data_frame(request_, canopen::encode_abort(action.object, *client->result().reply)));
      ++unsent;
    }
    const auto event = next(since + (client->fell_silent() ? after_fault : patience));
    if (event && is_reply(*event)) replied_ = event->time;
    if (!event) {
      if (client->ended()) break;
      client->on_silence();
      since = now();
    } else if (event->direction == can::Direction::transmitted) {
      if (unsent > 0 && event->frame.is_data(request_)) --unsent;
      since = now();
    } else if (is_reply(*event) && !client->ended() && client->on_frame(event->frame.bytes(), unsent)) {
      since = now();
    } else {
      keep(*event);
    }
  }
  auto result = client->take();
  using From = canopen::TransferResult::Kind;
  Answer out;
  switch (result.kind) {
    case From::confirmed: out.kind = Answer::Kind::confirmed; break;
    case From::aborted: out.kind = Answer::Kind::aborted; break;
    case From::violation: out.kind = Answer::Kind::violation; break;
    case From::silence: out.kind = Answer::Kind::silence; break;
    case From::gave_up: out.kind = Answer::Kind::none; break;
  }
  out.code = result.code;
  if (action.kind == Action::Kind::upload && result.kind == From::confirmed)
    out.data = std::move(result.data);
  out.size_told = result.size_indicated || !result.expedited;
  out.detail = std::move(result.detail);
  if (replied || result.kind == From::gave_up) run_until(now() + after_fault);
  return out;
}

}  // namespace conform::explore
