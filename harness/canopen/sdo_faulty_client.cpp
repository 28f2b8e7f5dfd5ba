// SPDX-License-Identifier: Apache-2.0
#include "canopen/sdo_faulty_client.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/check.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/sdo_transfer.hpp"

namespace conform::canopen {
namespace {

using Fault = SdoFault::Kind;
using Part = SdoFrame::Part;

// Every device has both; which of them answers is not the point.
constexpr Multiplexer device_type{Index(0x1000), SubIndex(0)};
constexpr Multiplexer error_register{Index(0x1001), SubIndex(0)};

/// What of a client's message is reserved: bits of the command, and bytes from the first on.
struct Reserved {
  std::uint8_t bits = 0;
  std::size_t from = 8;
};

Reserved reserved_of(const SdoFrame& frame, SdoProtocol protocol) {
  const auto command = frame.bytes[0];
  switch (protocol) {
    case SdoProtocol::upload: return frame.part == Part::initiate ? Reserved{0x1F, 4} : Reserved{0x0F, 1};
    case SdoProtocol::download:
      if (frame.part != Part::initiate) return {};
      return {.bits = 0x10, .from = (command & 0x03U) == 0 ? std::size_t{4} : std::size_t{8}};
    case SdoProtocol::block_upload:
      switch (frame.part) {
        case Part::initiate: return {0x18, 6};
        case Part::acknowledge: return {0x1C, 3};
        default: return {0x1C, 1};
      }
    case SdoProtocol::block_download:
      if (frame.part == Part::initiate)
        return {.bits = 0x18, .from = (command & 0x02U) == 0 ? std::size_t{4} : std::size_t{8}};
      if (frame.part == Part::end) return {0x02, 3};
      return {};
  }
  return {};
}

bool is_abort(ByteView data) { return data.size() >= 8 && data[0] == 0x80; }

}  // namespace

SdoFaultyClient::SdoFaultyClient(std::unique_ptr<SdoClient> legal, std::shared_ptr<SdoFaultPlan> plan,
                                 Multiplexer object, SdoProtocol protocol)
    : legal_(std::move(legal)), plan_(std::move(plan)), object_(object), protocol_(protocol) {}

void SdoFaultyClient::adopt(SdoClient& client) {
  const auto counts = legal_->result().counts;
  result_ = client.take();
  if (&client != legal_.get()) result_.counts = counts;
  result_.counts.surplus += surplus_;
  result_.counts.answers += answers_;
  ended_ = true;
  // Of a transfer that went through, everything must have had its place: else nothing was tried.
  const auto* left = plan_->left();
  result_.misplaced = misplaced_;
  if (left != nullptr && result_.kind == Kind::confirmed && state_ == State::running) {
    const auto segments = result_.counts.segments;
    result_.misplaced = fmt::format("the transfer has {} segment{} only: '{}' has no place in it", segments,
                                    segments == 1 ? "" : "s", left->text);
  }
}

std::optional<SdoFrame> SdoFaultyClient::next(std::size_t unsent) {
  if (ended_) return std::nullopt;
  for (;;) {
    if (!queue_.empty()) {
      auto out = queue_.front();
      queue_.pop_front();
      // The legal client's part may be over with the frame that confirms the end.
      if (queue_.empty() && state_ == State::leaving) {
        result_ = legal_->take();
        result_.detail.clear();
        result_.reply.reset();
        finish(Kind::gave_up);
      } else if (queue_.empty() && state_ == State::running && legal_->ended()) {
        adopt(*legal_);
      }
      return out;
    }
    if (state_ == State::elsewhere) return second_->next(unsent);
    if (state_ != State::running) return std::nullopt;
    std::optional<SdoFrame> instead;
    if (intervene(instead)) {
      if (instead) queue_.push_back(*instead);
      if (queue_.empty()) return std::nullopt;
      continue;
    }
    auto frame = legal_->next(unsent);
    if (!frame) return std::nullopt;
    if (frame->part == Part::end) {
      const SdoFault* stops = nullptr;
      for (const auto kind : {Fault::abort, Fault::new_initiate, Fault::silence}) {
        if (stops == nullptr) stops = plan_->take(kind, Part::end, 0);
      }
      if (stops != nullptr) {
        stop(*stops);
        continue;
      }
    }
    hand_over(*frame, unsent);
    if (queue_.empty() && state_ != State::running) return std::nullopt;
  }
}

bool SdoFaultyClient::intervene(std::optional<SdoFrame>& out) {
  const auto settled = legal_->settled();
  if (!settled) return false;
  if (!by_block() && latest_ && latest_->number <= *settled) {
    if (plan_->take(Fault::repeat, Part::segment, latest_->number) != nullptr) {
      state_ = State::repeating;
      out = latest_;
      return true;
    }
  }
  if (const auto* fault = plan_->take_stop(*settled)) {
    stop(*fault);
    return true;
  }
  return false;
}

void SdoFaultyClient::stop(const SdoFault& fault) {
  switch (fault.kind) {
    case Fault::abort:
      state_ = State::leaving;
      queue_.push_back({.bytes = encode_abort(object_, abort::general), .part = Part::abort});
      return;
    case Fault::new_initiate:
      state_ = State::elsewhere;
      second_object_ = object_ == device_type ? error_register : device_type;
      second_ = std::make_unique<SdoUpload>(second_object_);
      if (auto first = second_->next(0)) queue_.push_back(*first);
      return;
    default: state_ = State::silent; return;
  }
}

void SdoFaultyClient::set_reserved(SdoFrame& frame, bool bytes) const {
  const auto reserved = reserved_of(frame, protocol_);
  if (!bytes) {
    frame.bytes[0] = static_cast<std::uint8_t>(frame.bytes[0] | reserved.bits);
  } else {
    std::ranges::fill(std::span(frame.bytes).subspan(reserved.from), std::uint8_t{0xFF});
  }
}

void SdoFaultyClient::change(SdoFrame& frame) {
  auto& command = frame.bytes[0];
  const auto number = frame.number;
  if (frame.part == Part::segment) {
    if (const auto* fault = plan_->take(Fault::number, Part::segment, number))
      command = static_cast<std::uint8_t>((command & 0x80U) | fault->other);
    toggle_inverted_ = plan_->take(Fault::wrong_toggle, Part::segment, number) != nullptr;
    if (toggle_inverted_) command ^= 0x10U;
    if (protocol_ == SdoProtocol::download && frame.last) {
      if (const auto* fault = plan_->take(Fault::unused, Part::end, 0))
        command = static_cast<std::uint8_t>((command & ~0x0EU) | fault->other << 1U);
      if (plan_->take(Fault::silence, Part::end, 0) != nullptr) {
        command &= 0xFEU;
        end_withheld_ = true;
      }
    }
  }
  if (frame.part == Part::end && protocol_ == SdoProtocol::block_download) {
    if (const auto* fault = plan_->take(Fault::unused, Part::end, 0))
      command = static_cast<std::uint8_t>((command & ~0x1CU) | fault->other << 2U);
    if (plan_->take(Fault::wrong_crc, Part::end, 0) != nullptr) {
      // Also where the right one happens to be 1234h, and where none was agreed.
      frame.bytes[1] ^= 0x34U;
      frame.bytes[2] ^= 0x12U;
    }
  }
  if (plan_->take(Fault::reserved_bits, frame.part, number) != nullptr) set_reserved(frame, false);
  if (plan_->take(Fault::reserved_bytes, frame.part, number) != nullptr) set_reserved(frame, true);
  if (plan_->take(Fault::shorten, frame.part, number) != nullptr) frame.size = 7;
}

void SdoFaultyClient::hand_over(SdoFrame frame, std::size_t unsent) {
  const bool segment = frame.part == Part::segment;
  const auto toggle = static_cast<std::uint8_t>(frame.bytes[0] & 0x10U);
  change(frame);
  if (segment && !by_block()) latest_ = frame;
  if (segment && protocol_ != SdoProtocol::block_upload &&
      plan_->take(Fault::lose, Part::segment, frame.number) != nullptr) {
    if (protocol_ == SdoProtocol::block_download) return;
    // The client of a segmented download does not know that it is lost: it goes on as if it had been
    // answered. After the last one it waits.
    if (frame.last) {
      state_ = State::silent;
      return;
    }
    toggle_inverted_ = false;
    legal_->on_frame(SdoBytes{static_cast<std::uint8_t>(0x20U | toggle)}, 0);
    return;
  }
  if (const auto* fault =
          segment && by_block() ? plan_->take(Fault::swap, Part::segment, frame.number) : nullptr) {
    std::deque<SdoFrame> between;
    std::optional<SdoFrame> other;
    while (!other) {
      auto later = legal_->next(unsent);
      if (!later) break;
      change(*later);
      if (later->number == fault->other) {
        other = later;
      } else {
        between.push_back(*later);
      }
    }
    if (!other) {
      // Not in this sub-block: the step cannot do what it was asked for.
      misplaced_ = fmt::format("'{}': they are not in one sub-block", fault->text);
      queue_.push_back(frame);
    } else {
      queue_.push_back(*other);
    }
    queue_.insert(queue_.end(), between.begin(), between.end());
    if (other) queue_.push_back(frame);
    return;
  }
  queue_.push_back(frame);
  if (segment && by_block() && plan_->take(Fault::repeat, Part::segment, frame.number) != nullptr)
    queue_.push_back(frame);
}

void SdoFaultyClient::on_stray(ByteView data) {
  ++surplus_;
  if (is_abort(data)) ++answers_;
}

bool SdoFaultyClient::on_frame(ByteView data, std::size_t unsent) {
  CONFORM_CHECK(!ended_);
  switch (state_) {
    case State::running: break;
    case State::leaving: on_stray(data); return false;
    case State::silent:
      if (!is_abort(data)) {
        on_stray(data);
        return false;
      }
      result_ = legal_->take();
      result_.detail.clear();
      result_.reply.reset();
      result_.counts.surplus += surplus_;
      take_abort(data, object_);
      return true;
    case State::repeating:
      if (unsent > 0) return false;
      if (is_abort(data)) {
        result_ = legal_->take();
        take_abort(data, object_);
        return true;
      }
      on_stray(data);
      state_ = State::running;
      if (legal_->ended()) adopt(*legal_);
      return true;
    case State::elsewhere: {
      const bool whole = data.size() >= 8;
      const bool for_second = whole && sdo_multiplexer(data) == second_object_;
      // Segments of the old sub-block may still be on their way, and the old transfer may be aborted.
      if (is_abort(data) && !for_second && sdo_multiplexer(data) == object_) {
        on_stray(data);
        abort_of_first_ = AbortCode(static_cast<std::uint32_t>(load_le(data.subspan(4))));
        return false;
      }
      // Behind the answer to the new request come its own segments, which name no object.
      if (protocol_ == SdoProtocol::block_upload && whole && !for_second && !second_begun_) {
        on_stray(data);
        return false;
      }
      second_begun_ = true;
      const bool taken = second_->on_frame(data, unsent);
      if (second_->ended()) adopt(*second_);
      return taken;
    }
  }
  std::array<std::uint8_t, 8> copy{};
  if (toggle_inverted_ && data.size() >= 8 && data[0] >> 5U <= 1 && latest_) {
    // Whatever toggle bit a server gives to a segment that it should have refused: go on, so that it shows.
    std::ranges::copy(data.first(8), copy.begin());
    copy[0] = static_cast<std::uint8_t>((copy[0] & ~0x10U) | (~latest_->bytes[0] & 0x10U));
    data = copy;
  }
  // What waits in the queue is not on the bus either.
  const bool taken = legal_->on_frame(data, unsent + queue_.size());
  if (!legal_->ended()) return taken;
  const bool repeat_due = !by_block() && latest_ && legal_->result().kind == Kind::confirmed &&
                          plan_->take(Fault::repeat, Part::segment, latest_->number) != nullptr;
  if (repeat_due) {
    state_ = State::repeating;
    queue_.push_back(*latest_);
  } else if (end_withheld_ && legal_->result().kind == Kind::confirmed) {
    state_ = State::silent;
  } else {
    // A server that aborts in the middle of a sub-block is told nothing more.
    queue_.clear();
    adopt(*legal_);
  }
  return taken;
}

void SdoFaultyClient::on_silence() {
  switch (state_) {
    case State::running: legal_->on_silence(); break;
    case State::silent:
      result_ = legal_->take();
      result_.detail.clear();
      result_.reply.reset();
      result_.counts.surplus += surplus_;
      result_.counts.answers += answers_;
      result_.abandoned = true;
      finish(Kind::silence);
      return;
    case State::elsewhere:
      second_->on_silence();
      adopt(*second_);
      if (abort_of_first_) {
        result_.kind = Kind::aborted;
        result_.code = *abort_of_first_;
        result_.reply.reset();
      }
      return;
    case State::repeating:
    case State::leaving: give_up_waiting(); return;
  }
  if (legal_->ended()) adopt(*legal_);
}

}  // namespace conform::canopen
