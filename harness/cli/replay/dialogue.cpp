// SPDX-License-Identifier: Apache-2.0
#include "cli/replay/dialogue.hpp"

#include <chrono>
#include <map>
#include <utility>

#include "can/capture_marks.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/nmt.hpp"

namespace conform::cli {
namespace {

using can::Direction;

constexpr std::uint32_t sdo_requests = 0x600, sdo_responses = 0x580, error_control = 0x700;
/// Echo and answer that are fetched from the controller together get stamps this close, and in any order.
constexpr Duration overtaking = std::chrono::microseconds(20);

class Listener {
 public:
  Listener(std::span<const can::CapturedFrame> frames, NodeId node) : frames_(frames), node_(node) {}

  void hear(std::size_t index, std::size_t end) {
    const auto& captured = frames_[index];
    if (captured.comment.contains(can::power_was_switched)) out_.power.push_back(index);
    if (captured.frame.error) return;
    if (captured.direction == Direction::transmitted) {
      if (const auto kind = answer_of(captured.frame, node_))
        latest_[{kind->id, kind->of}] = out_.sent.size();
      out_.turns.push_back({.sent = out_.sent.size()});
      out_.sent.push_back({.index = index, .answers = {}});
      // An answer that was stamped just before the echo of its request.
      if (overtaken_ && answer_to(*overtaken_, out_.sent.size() - 1)) overtaken_.reset();
      return;
    }
    if (overtakes(index, end)) {
      overtaken_ = index;
      return;
    }
    for (auto of :
         {AnswerKind::Of::reset, AnswerKind::Of::remote, AnswerKind::Of::sdo, AnswerKind::Of::lss}) {
      const auto asked = latest_.find({captured.frame.id, of});
      if (asked != latest_.end() && answer_to(index, asked->second)) return;
    }
    out_.unasked.push_back(index);
  }

  [[nodiscard]] Dialogue take() { return std::move(out_); }

 private:
  /// Takes the frame as an answer to what was sent there, if it is one.
  bool answer_to(std::size_t index, std::size_t asked) {
    auto& sent = out_.sent[asked];
    const auto kind = answer_of(frames_[sent.index].frame, node_);
    if (!kind || !is_answer(frames_[index].frame, *kind)) return false;
    // A remote frame and a reset have one answer each; what comes then was not asked for.
    const bool once = kind->of == AnswerKind::Of::remote || kind->of == AnswerKind::Of::reset;
    if (once && !sent.answers.empty()) return false;
    out_.turns.push_back({.sent = asked, .answer = sent.answers.size()});
    sent.answers.push_back(index);
    return true;
  }

  /// Nothing is open that it could answer, and the request that it answers comes right behind it.
  [[nodiscard]] bool overtakes(std::size_t index, std::size_t end) const {
    if (index + 1 >= end || overtaken_) return false;
    const auto& next = frames_[index + 1];
    if (next.direction != Direction::transmitted || next.time - frames_[index].time > overtaking)
      return false;
    const auto kind = answer_of(next.frame, node_);
    if (!kind || !is_answer(frames_[index].frame, *kind)) return false;
    const auto asked = latest_.find({kind->id, kind->of});
    return asked == latest_.end() || !out_.sent[asked->second].answers.empty();
  }

  std::span<const can::CapturedFrame> frames_;
  NodeId node_;
  Dialogue out_;
  std::map<std::pair<std::uint32_t, AnswerKind::Of>, std::size_t> latest_;  ///< indices into out_.sent
  std::optional<std::size_t> overtaken_;
};

}  // namespace

std::optional<AnswerKind> answer_of(const can::Frame& sent, NodeId node) {
  if (sent.error || sent.extended) return std::nullopt;
  if (sent.remote) return AnswerKind{AnswerKind::Of::remote, sent.id};
  if (sent.id > sdo_requests && sent.id <= sdo_requests + 127)
    return AnswerKind{AnswerKind::Of::sdo, sent.id - sdo_requests + sdo_responses};
  if (sent.id == canopen::lss_request_can_id.value())
    return AnswerKind{AnswerKind::Of::lss, canopen::lss_response_can_id.value()};
  const bool commands = sent.id == canopen::nmt_can_id.value() && sent.size() == 2 &&
                        (sent.data[1] == 0 || sent.data[1] == node.value());
  const auto command = commands ? canopen::nmt_command_at(sent.data[0]) : std::nullopt;
  if (command && canopen::is_reset(*command))
    return AnswerKind{AnswerKind::Of::reset, error_control + node.value()};
  return std::nullopt;
}

bool is_answer(const can::Frame& received, const AnswerKind& kind) {
  if (!received.is_data(CanId(kind.id))) return false;
  return kind.of != AnswerKind::Of::reset || (received.size() > 0 && received.data[0] == 0);
}

Dialogue dialogue_of(std::span<const can::CapturedFrame> frames, std::size_t first, std::size_t end,
                     NodeId node) {
  Listener listener(frames, node);
  for (auto i = first; i < end; ++i) listener.hear(i, end);
  return listener.take();
}

}  // namespace conform::cli
