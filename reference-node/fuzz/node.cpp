// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: whatever a client sends, whenever the bus takes the node's frames, the reference node
// answers what it was asked and nothing else, keeps its values legal and never hangs.
//
// Input: choices[2] block_size delivery, then the program of client_program.hpp. `delivery` says when frames
// of the node leave: 0 at once, 1 when time passes, 2 not all of them, ...
#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include "base/check.hpp"
#include "fuzz/client_program.hpp"
#include "node/node.hpp"
#include "parts/parts.hpp"

namespace {

using namespace refnode;
using namespace refnode::fuzz;
using namespace std::chrono_literals;
using conform::BusTime;

constexpr std::uint32_t request_id = 0x600U + node_id;
constexpr std::uint32_t response_id = 0x580U + node_id;

SdoChoices choices_of(Input& input) {
  SdoChoices choices;
  const std::uint16_t bits = input.u16();
  const std::uint8_t size = input.u8();
  choices.expedited_upload = (bits & 1U) == 0;
  choices.upload_size_indicated = (bits & 2U) == 0;
  choices.toggle_errors_ignored = (bits & 4U) != 0;
  choices.crc = (bits & 8U) == 0;
  choices.protocol_switch = (bits & 0x10U) == 0;
  choices.ack_gap_at_once = (bits & 0x20U) != 0;
  choices.invalid_sequence_ignored = (bits & 0x40U) != 0;
  choices.block = (bits & 0x80U) == 0;
  if (size != 0) choices.block_size = static_cast<std::uint8_t>((size - 1U) % 127U + 1U);
  if ((bits & 0x100U) != 0) choices.next_block_size = static_cast<std::uint8_t>(128U - choices.block_size);
  if ((bits & 0x200U) != 0) choices.turnaround = 3ms;
  if ((bits & 0x400U) != 0) choices.time_out.reset();
  if ((bits & 0x800U) != 0) choices.segmented = false;
  return choices;
}

/// The node, a host that carries its frames away, and the account of what it may say.
class World {
 public:
  explicit World(Input& input) {
    Options options;
    options.node_id = node_id;
    const SdoChoices choices = choices_of(input);
    options.adjust = [choices](Parts& parts) { parts.sdo.choices = choices; };
    time_out_ = choices.time_out;
    delivery_ = input.u8() % 3U;
    node_ = std::move(*Node::create(std::move(options)));
    for (const auto& [index, object] : node_->dictionary().objects()) {
      for (const auto& [sub, entry] : object.entries) bytes_at_first_ += entry.value.size();
    }
    node_->attach([this](const Frame& frame) { on_sent(frame); }, now_);
  }

  void send(const Frame& frame) {
    if (!frame.error && !frame.remote && !frame.extended && frame.id == request_id) on_request(frame);
    frames_sent_ += 1;
    calling([&] { node_->on_frame(frame, now_); });
  }

  void pass(Duration duration) {
    const BusTime end = now_ + duration;
    if (delivery_ != 0) deliver();
    int at_once = 0;
    while (const auto next = node_->next_wakeup()) {
      if (*next > end) break;
      CONFORM_CHECK(*next <= now_ ? ++at_once < 200 : true);  // time would stand still
      if (*next > now_) at_once = 0;
      now_ = std::max(now_, *next);
      calling([&] { node_->on_time(now_); });
      if (delivery_ != 0) deliver();
    }
    now_ = end;
  }

  /// A server that was left anywhere answers again: whatever was before, an abort and an upload.
  void must_be_alive() {
    delivery_ = 0;
    deliver();
    pass(200ms);  // it has booted, and counts on no frame that was lost
    send(conform::can::data_frame(CanId(0), {0x80, node_id}));
    send(conform::can::data_frame(CanId(request_id), {0x80, 0, 0, 0, 0, 0, 0, 0x08}));
    pass(10ms);
    responses_.clear();
    send(conform::can::data_frame(CanId(request_id), {0x40, 0x00, 0x10, 0, 0, 0, 0, 0}));
    pass(10ms);
    CONFORM_CHECK(responses_.size() == 1);
    const auto& data = responses_[0].data;
    CONFORM_CHECK((data[0] & 0xF0U) == 0x40 && data[1] == 0x00 && data[2] == 0x10 && data[3] == 0);
  }

  void values_must_be_legal() const {
    std::size_t bytes = 0;
    for (const auto& [index, object] : node_->dictionary().objects()) {
      for (const auto& [sub, entry] : object.entries) {
        bytes += entry.value.size();
        const std::size_t fixed = fixed_size(entry.type);
        CONFORM_CHECK(fixed != 0
                          ? entry.value.size() == fixed
                          : entry.value.size() <= std::max(entry.max_size, entry.default_value.size()));
        if (!is_signed_integer(entry.type) && !is_unsigned_integer(entry.type)) continue;
        auto value = static_cast<std::int64_t>(entry.number());
        if (is_signed_integer(entry.type)) {
          const auto unused = static_cast<int>(64 - 8 * fixed);
          value = static_cast<std::int64_t>(entry.number() << unused) >> unused;
        }
        CONFORM_CHECK(!entry.low || value >= *entry.low);
        CONFORM_CHECK(!entry.high || value <= *entry.high);
      }
    }
    CONFORM_CHECK(bytes <= bytes_at_first_ + 8 * frames_sent_);
  }

 private:
  static constexpr std::size_t most_frames_at_once =
      24;  ///< of other services; responses are counted by request

  template <typename Call>
  void calling(Call call) {
    at_once_ = 0;
    call();
    if (delivery_ == 0) deliver();
  }

  // One after the other: the node may hand over the next frame for each that has left.
  void deliver() {
    for (int count = 0; waiting_ > 0; --waiting_) {
      CONFORM_CHECK(++count < 100'000);
      if (delivery_ == 2 && ++delivered_ % 5 == 0) continue;  // this one is lost
      at_once_ = 0;
      node_->on_transmitted(now_);
    }
  }

  /// What a frame on the request CAN-ID entitles the node to say.
  void on_request(const Frame& frame) {
    if (frame.size() != 8) return;
    const unsigned command = frame.data[0] >> 5U;
    if (command != 4 || in_block_) ++replies_due_;
    acknowledges_due_ = 1;
    time_outs_due_ = 1;
    if (command == 5 && (frame.data[0] & 0x03U) >= 2) segments_due_ = 127;
    if (command == 6 && (frame.data[0] & 0x01U) == 0) in_block_ = true;
    heard_at_ = now_;
  }

  void on_sent(const Frame& frame) {
    ++waiting_;
    CONFORM_CHECK(!frame.extended && !frame.error && !frame.remote);
    CONFORM_CHECK(frame.id <= 0x7FF && frame.dlc <= 8);
    if (frame.id != response_id) {
      CONFORM_CHECK(++at_once_ <= most_frames_at_once);
      return;
    }
    CONFORM_CHECK(frame.dlc == 8);
    responses_.push_back(frame);
    if (replies_due_ > 0) {
      --replies_due_;
      return;
    }
    if (segments_due_ > 0 && (frame.data[0] & 0x7FU) != 0) {
      --segments_due_;
      return;
    }
    if (frame.data[0] == 0xA2) {
      CONFORM_CHECK(acknowledges_due_-- > 0);
      return;
    }
    // Nothing else comes by itself but the time-out.
    CONFORM_CHECK(frame.data[0] == 0x80 && conform::load_le(ByteView(frame.data).subspan(4)) == 0x05040000U);
    CONFORM_CHECK(time_out_ && now_ >= heard_at_ + *time_out_ && time_outs_due_-- > 0);
  }

  std::unique_ptr<Node> node_;
  BusTime now_{};
  std::optional<Duration> time_out_;
  unsigned delivery_ = 0;
  std::size_t waiting_ = 0, delivered_ = 0, at_once_ = 0, frames_sent_ = 0, bytes_at_first_ = 0;
  std::vector<Frame> responses_;
  int replies_due_ = 0, segments_due_ = 0, acknowledges_due_ = 0, time_outs_due_ = 0;
  bool in_block_ = false;
  BusTime heard_at_{};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  World world(input);
  world.pass(50ms);
  ClientProgram program(input);
  while (const auto action = program.next()) {
    if (action->frame) world.send(*action->frame);
    if (action->pause > Duration{}) world.pass(action->pause);
  }
  world.must_be_alive();
  world.values_must_be_legal();
  return 0;
}
