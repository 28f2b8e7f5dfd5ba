// SPDX-License-Identifier: Apache-2.0
// A right SDO server in few lines, so that a fuzzed client gets far. Lost frames are repeated as CiA 301 has
// it; what is no right request is answered by an abort.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <span>

#include "base/bytes.hpp"

namespace conform::fuzz {

class RightServer {
 public:
  using Data = std::array<std::uint8_t, 8>;
  struct Choices {
    bool crc = true, size_told = true, expedited = true, switches = true;
    std::uint8_t blksize = 127;
  };
  RightServer(Bytes object, Choices choices) : object_(std::move(object)), choices_(choices) {}

  /// What it sends, in order.
  std::deque<Data> out;
  [[nodiscard]] const Bytes& object() const { return object_; }

  void on_frame(ByteView frame) {
    if (frame.size() != 8) return;
    Data data;
    std::ranges::copy(frame, data.begin());
    const unsigned command = data[0] >> 5U;
    if (state_ == State::block_down && data[0] != 0x80) return block_segment(data);
    if (command == 4) {
      state_ = State::idle;
    } else if (command == 1) {
      initiate_download(data);
    } else if (command == 0 && state_ == State::down) {
      segment(data);
    } else if (command == 2) {
      initiate_upload(data);
    } else if (command == 3 && state_ == State::up) {
      upload_segment(data);
    } else if (command == 5) {
      block_upload(data);
    } else if (command == 6) {
      block_download(data);
    } else {
      refuse(0x05040001);
    }
  }

  /// Nothing has come for a while: what has come of a sub-block is acknowledged.
  void on_timer() {
    if (state_ == State::block_down && sent_ > 0) acknowledge();
  }

  /// Bit by bit, after CiA 301, 7.2.4.3.16.
  [[nodiscard]] static std::uint16_t crc(ByteView bytes) {
    std::uint32_t value = 0;
    for (const std::uint8_t byte : bytes) {
      value ^= static_cast<std::uint32_t>(byte) << 8U;
      for (int bit = 0; bit < 8; ++bit)
        value = (value & 0x8000U) != 0 ? (value << 1U) ^ 0x1021U : value << 1U;
      value &= 0xFFFFU;
    }
    return static_cast<std::uint16_t>(value);
  }

 private:
  enum class State : std::uint8_t {
    idle,
    up,
    down,
    block_offered,
    block_up,
    block_ended,
    block_down,
    block_end
  };

  void say(unsigned command, std::uint64_t rest = 0) {
    Data data{static_cast<std::uint8_t>(command), mux_[0], mux_[1], mux_[2]};
    store_le(std::span(data).subspan(4), rest);
    out.push_back(data);
  }
  void refuse(std::uint32_t code) {
    state_ = State::idle;
    say(0x80, code);
  }
  void begin(const Data& data) {
    std::copy_n(data.begin() + 1, 3, mux_.begin());
    position_ = 0;
    toggle_ = false;
    taken_.clear();
  }

  void initiate_upload(const Data& data) {
    begin(data);
    state_ = State::idle;
    if (choices_.expedited && !object_.empty() && object_.size() <= 4)
      return say(0x43U | static_cast<unsigned>(4U - object_.size()) << 2U, load_le(object_));
    state_ = State::up;
    choices_.size_told ? say(0x41, object_.size()) : say(0x40);
  }
  void upload_segment(const Data& data) {
    if (((data[0] & 0x10U) != 0) != toggle_) return refuse(0x05030000);
    const auto count = std::min<std::size_t>(7, object_.size() - position_);
    const bool last = position_ + count == object_.size();
    Data reply{static_cast<std::uint8_t>((toggle_ ? 0x10U : 0U) | (7U - count) << 1U | (last ? 1U : 0U))};
    std::copy_n(object_.begin() + static_cast<std::ptrdiff_t>(position_), count, reply.begin() + 1);
    out.push_back(reply);
    position_ += count;
    toggle_ = !toggle_;
    if (last) state_ = State::idle;
  }

  void initiate_download(const Data& data) {
    begin(data);
    state_ = State::idle;
    if ((data[0] & 2U) != 0) {
      const std::size_t size = (data[0] & 1U) != 0 ? 4U - (data[0] >> 2U & 3U) : 4U;
      object_.assign(data.begin() + 4, data.begin() + 4 + static_cast<std::ptrdiff_t>(size));
    } else {
      state_ = State::down;
    }
    say(0x60);
  }
  void segment(const Data& data) {
    if (((data[0] & 0x10U) != 0) != toggle_) return refuse(0x05030000);
    const auto count = static_cast<std::ptrdiff_t>(7U - (data[0] >> 1U & 7U));
    taken_.insert(taken_.end(), data.begin() + 1, data.begin() + 1 + count);
    if ((data[0] & 1U) != 0) {
      object_ = taken_;
      state_ = State::idle;
    }
    out.push_back({static_cast<std::uint8_t>(toggle_ ? 0x30 : 0x20)});
    toggle_ = !toggle_;
  }

  void block_upload(const Data& data) {
    const unsigned sub = data[0] & 3U;
    if (sub == 0) {
      begin(data);
      if (data[4] < 1 || data[4] > 127) return refuse(0x05040002);
      if (choices_.switches && data[5] != 0 && object_.size() <= data[5]) return initiate_upload(data);
      crc_ = choices_.crc && (data[0] & 4U) != 0;
      blksize_ = data[4];
      state_ = State::block_offered;
      return say(0xC0U | (choices_.crc ? 4U : 0U) | (choices_.size_told ? 2U : 0U),
                 choices_.size_told ? object_.size() : 0);
    }
    if (sub == 3 && state_ == State::block_offered) return send_block();
    if (sub == 2 && state_ == State::block_up) {
      if (data[1] > sent_) return refuse(0x05040003);
      if (data[2] < 1 || data[2] > 127) return refuse(0x05040002);
      position_ = std::min(position_ + data[1] * std::size_t{7}, std::max<std::size_t>(object_.size(), 1));
      blksize_ = data[2];
      if (position_ < std::max<std::size_t>(object_.size(), 1)) return send_block();
      state_ = State::block_ended;
      const auto rest = object_.empty() ? std::size_t{7} : (7 - object_.size() % 7) % 7;
      const std::uint16_t sum = crc_ ? crc(object_) : std::uint16_t{0};
      out.push_back({static_cast<std::uint8_t>(0xC1U | rest << 2U), static_cast<std::uint8_t>(sum & 0xFFU),
                     static_cast<std::uint8_t>(sum >> 8U)});
      return;
    }
    if (sub == 1 && state_ == State::block_ended) {
      state_ = State::idle;
      return;
    }
    refuse(0x05040001);
  }
  void send_block() {
    state_ = State::block_up;
    auto at = position_;
    for (sent_ = 0; sent_ < blksize_;) {
      const auto count = std::min<std::size_t>(7, object_.size() - std::min(at, object_.size()));
      const bool last = at + count >= object_.size();
      Data frame{static_cast<std::uint8_t>(++sent_ | (last ? 0x80U : 0U))};
      std::copy_n(object_.begin() + static_cast<std::ptrdiff_t>(at), count, frame.begin() + 1);
      out.push_back(frame);
      at += count;
      if (last) return;
    }
  }

  void block_download(const Data& data) {
    if ((data[0] & 1U) == 0) {
      begin(data);
      crc_ = choices_.crc && (data[0] & 4U) != 0;
      sent_ = 0;
      last_ = false;
      state_ = State::block_down;
      return say(0xA0U | (choices_.crc ? 4U : 0U), choices_.blksize);
    }
    if (state_ != State::block_end) return refuse(0x05040001);
    taken_.resize(taken_.size() - std::min<std::size_t>(taken_.size(), data[0] >> 2U & 7U));
    if (crc_ && crc(taken_) != load_le(ByteView(data).subspan(1, 2))) return refuse(0x05040004);
    object_ = taken_;
    state_ = State::idle;
    out.push_back({0xA1});
  }
  void block_segment(const Data& data) {
    const auto number = static_cast<unsigned>(data[0] & 0x7FU);
    if (number == sent_ + 1U && !last_) {
      taken_.insert(taken_.end(), data.begin() + 1, data.end());
      sent_ = static_cast<std::uint8_t>(number);
      last_ = (data[0] & 0x80U) != 0;
    }
    if ((data[0] & 0x80U) != 0 || number >= choices_.blksize) acknowledge();
  }
  void acknowledge() {
    out.push_back({0xA2, sent_, choices_.blksize});
    sent_ = 0;
    if (last_) state_ = State::block_end;
  }

  Bytes object_, taken_;
  Choices choices_;
  State state_ = State::idle;
  std::array<std::uint8_t, 3> mux_{};
  std::size_t position_ = 0;
  std::uint8_t sent_ = 0, blksize_ = 0;
  bool toggle_ = false, crc_ = false, last_ = false;
};

}  // namespace conform::fuzz
