// SPDX-License-Identifier: Apache-2.0
// Turns the input of a fuzz target into what a client, right or wrong, does to the node: frames and pauses.
//
// One byte is an operation (high nibble) with a variant (low nibble), its parameters follow; what is missing
// at the end is zero. `object` is an index into the table below, `gap` the pause behind every request.
//
//   0v  bytes[8]                        SDO request as it is; v & 1: only bytes[0..v/2], then DLC v/2
//   1v  id[2] flags dlc bytes[dlc<=8]   any frame; flags: 1 extended, 2 remote
//   2v                                  pause of 100 us * 2^v, at most 1.6384 s
//   3v  target                          NMT: command v of the table; target 0 all, 1 another, else this node
//   4v  object                          upload, then v segment requests
//   5v  object bytes[4]                 expedited download; v & 3: bytes without data, v & 4: without size
//   6v  object length fill              segmented download; v & 1: without size, 2: one byte more announced,
//                                       4: not ended, 8: one toggle wrong
//   7v  object blksize pst acks         block upload with CRC; v & 1: without, 2: acknowledges one segment
//   less,
//                                       4: aborted after the sub-blocks, 8: does not wait; acks: sub-blocks
//                                       (& 0Fh)
//   8v  object length[2] fill skipped   block download; v & 1: without CRC, 2: without size, 4: wrong CRC,
//                                       8: not ended; skipped: number of a segment left out, or 0
//   9v  object                          abort
//   Av  data                            v: SYNC, TIME, RPDO, heartbeats, remote frames, ...
//   Bv  object value[4]                 write a communication parameter; v & 1: at first with bit 31
//   Cv                                  gap of 2^v * 10 us, 0 with v = 0 (at first 2 ms)
//   others                              nothing
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "base/fuzz/input.hpp"
#include "base/time.hpp"
#include "can/frame.hpp"

namespace refnode::fuzz {

using conform::Bytes;
using conform::ByteView;
using conform::CanId;
using conform::Duration;
using conform::can::Frame;
using conform::fuzz::Input;

/// A frame to send, then a pause. Time passes between actions only.
struct Action {
  std::optional<Frame> frame;
  Duration pause{};
};

inline constexpr std::uint8_t node_id = 5;

class ClientProgram {
 public:
  explicit ClientProgram(Input input) : input_(input) {}

  /// nullopt at the end; at most `most_actions` and `longest` come before it.
  [[nodiscard]] std::optional<Action> next() {
    while (ready_.empty() && !input_.empty()) operation();
    if (ready_.empty() || ++actions_ > most_actions || elapsed_ > longest) return std::nullopt;
    Action action = ready_.front();
    ready_.pop_front();
    elapsed_ += action.pause;
    return action;
  }

 private:
  static constexpr int most_actions = 2000;
  static constexpr Duration longest = std::chrono::seconds(10);
  static constexpr std::size_t longest_download = 4000;

  using Data = std::array<std::uint8_t, 8>;
  struct Object {
    std::uint16_t index;
    std::uint8_t sub;
  };

  void operation() {
    const std::uint8_t first = input_.u8();
    const auto v = static_cast<unsigned>(first & 0x0FU);
    switch (first >> 4U) {
      case 0x0: return raw_request(v);
      case 0x1: return raw_frame();
      case 0x2: return pause(std::chrono::microseconds(100) * (1 << std::min(v, 14U)));
      case 0x3: return nmt(v);
      case 0x4: return upload(v);
      case 0x5: return expedited(v);
      case 0x6: return segmented(v);
      case 0x7: return block_upload(v);
      case 0x8: return block_download(v);
      case 0x9: return request(with_object(0x80, object(), 0x08000000));
      case 0xA: return other_frame(v);
      case 0xB: return parameter(v);
      case 0xC: gap_ = v == 0 ? Duration{} : Duration(std::chrono::microseconds(10) * (1 << v)); return;
      default: return;
    }
  }

  // ---- frames

  void send(const Frame& frame, Duration after) { ready_.push_back({frame, after}); }
  void pause(Duration time) { ready_.push_back({std::nullopt, time}); }
  void request(const Data& data) { send(conform::can::data_frame(CanId(0x600U + node_id), data), gap_); }
  void at_once(const Data& data) {
    send(conform::can::data_frame(CanId(0x600U + node_id), data), Duration{});
  }
  static Data with_object(unsigned command, Object object, std::uint32_t rest) {
    Data data{static_cast<std::uint8_t>(command), static_cast<std::uint8_t>(object.index & 0xFFU),
              static_cast<std::uint8_t>(object.index >> 8U), object.sub};
    conform::store_le(std::span(data).subspan(4), rest);
    return data;
  }
  Object object() {
    static constexpr Object objects[] = {
        {0x1000, 0}, {0x1001, 0},  {0x1003, 0}, {0x1003, 1},  {0x1005, 0},  {0x1008, 0}, {0x1010, 1},
        {0x1011, 1}, {0x1012, 0},  {0x1014, 0}, {0x1015, 0},  {0x1016, 1},  {0x1016, 2}, {0x1017, 0},
        {0x1018, 0}, {0x1018, 4},  {0x1200, 1}, {0x1201, 1},  {0x1201, 2},  {0x1202, 1}, {0x1202, 2},
        {0x1400, 1}, {0x1400, 2},  {0x1400, 3}, {0x1400, 5},  {0x1600, 0},  {0x1600, 1}, {0x1600, 2},
        {0x1800, 1}, {0x1800, 2},  {0x1800, 3}, {0x1800, 5},  {0x1A00, 0},  {0x1A00, 1}, {0x1A00, 2},
        {0x2000, 1}, {0x2000, 7},  {0x2000, 9}, {0x2000, 15}, {0x2000, 27}, {0x2001, 1}, {0x2001, 2},
        {0x2001, 4}, {0x2002, 1},  {0x2002, 2}, {0x2002, 3},  {0x2002, 4},  {0x2003, 3}, {0x2005, 1},
        {0x2005, 8}, {0x2005, 22}, {0x2006, 0}, {0x2007, 0},  {0x2008, 0},  {0x2F00, 1}, {0x2F00, 2},
        {0x2F00, 3}, {0x2F10, 0},  {0x2F20, 0}, {0x6000, 1},  {0x6200, 1},  {0x6401, 1}, {0x6411, 1},
        {0x5FFF, 0}};
    return objects[input_.u8() % std::size(objects)];
  }

  // ---- operations

  void raw_request(unsigned v) {
    const auto bytes = input_.take((v & 1U) != 0 ? v / 2U : 8U);
    send(conform::can::data_frame(CanId(0x600U + node_id), bytes), gap_);
  }

  void raw_frame() {
    Frame frame;
    const std::uint16_t id = input_.u16();
    const std::uint8_t flags = input_.u8();
    frame.extended = (flags & 1U) != 0;
    frame.remote = (flags & 2U) != 0;
    frame.id = frame.extended ? id : id & 0x7FFU;
    frame.dlc = input_.u8() & 0x0FU;
    const auto bytes = input_.take(frame.size());
    std::ranges::copy(bytes, frame.data.begin());
    send(frame, gap_);
  }

  void nmt(unsigned v) {
    static constexpr std::uint8_t commands[] = {0x01, 0x02, 0x80, 0x81, 0x82, 0x00, 0x7F, 0xFF};
    const std::uint8_t target = input_.u8();
    const std::uint8_t node = target == 0 ? 0 : target == 1 ? node_id + 1 : node_id;
    send(conform::can::data_frame(CanId(0), {commands[v % std::size(commands)], node}), gap_);
  }

  void upload(unsigned segments) {
    request(with_object(0x40, object(), 0));
    for (unsigned i = 0; i < segments; ++i) request({static_cast<std::uint8_t>(i % 2 == 0 ? 0x60 : 0x70)});
  }

  void expedited(unsigned v) {
    const auto to = object();
    const auto value = input_.u32();
    request(with_object((v & 4U) != 0 ? 0x22U : 0x23U | ((v & 3U) << 2U), to, value));
  }

  void segmented(unsigned v) {
    const auto to = object();
    const std::size_t length = input_.u8();
    const std::uint8_t fill = input_.u8();
    const bool sized = (v & 1U) == 0;
    const auto announced = static_cast<std::uint32_t>(length + ((v & 2U) != 0 ? 1U : 0U));
    request(with_object(sized ? 0x21 : 0x20, to, sized ? announced : 0U));
    std::size_t sent = 0;
    bool toggle = false;
    for (std::size_t number = 1;; ++number) {
      const std::size_t count = std::min<std::size_t>(7, length - sent);
      const bool last = sent + count == length;
      if (last && (v & 4U) != 0) return;
      Data data;
      data.fill(0);
      const bool wrong = (v & 8U) != 0 && number == 1U + fill % 3U;
      data[0] =
          static_cast<std::uint8_t>((toggle != wrong ? 0x10U : 0U) | ((7U - count) << 1U) | (last ? 1U : 0U));
      for (std::size_t i = 0; i < count; ++i) data[i + 1] = fill;
      request(data);
      sent += count;
      toggle = !toggle;
      if (last) return;
    }
  }

  // 16-bit CRC of block transfers, bit by bit: no line is shared with the node or the harness.
  static std::uint16_t crc(ByteView bytes) {
    std::uint32_t value = 0;
    for (const std::uint8_t byte : bytes) {
      for (unsigned bit = 8; bit-- > 0;) {
        const bool one = (((value >> 15U) ^ (static_cast<std::uint32_t>(byte) >> bit)) & 1U) != 0;
        value = (value << 1U) & 0xFFFFU;
        if (one) value ^= 0x1021U;
      }
    }
    return static_cast<std::uint16_t>(value);
  }

  void block_upload(unsigned v) {
    const auto from = object();
    const std::uint8_t blksize = input_.u8();
    const std::uint8_t pst = input_.u8();
    const auto acks = static_cast<unsigned>(input_.u8() & 0x0FU);
    const Duration sub_block =
        (v & 8U) != 0 ? gap_ : Duration(std::chrono::milliseconds(1)) * (blksize % 128 + 1);
    request(
        with_object((v & 1U) != 0 ? 0xA0 : 0xA4, from, blksize | (static_cast<std::uint32_t>(pst) << 8U)));
    send(conform::can::data_frame(CanId(0x600U + node_id), Data{0xA3}), sub_block);
    for (unsigned i = 0; i < acks; ++i) {
      const auto taken = static_cast<std::uint8_t>(blksize - ((v & 2U) != 0 && blksize > 0 ? 1U : 0U));
      send(conform::can::data_frame(CanId(0x600U + node_id), Data{0xA2, taken, blksize}), sub_block);
    }
    request((v & 4U) != 0 ? with_object(0x80, from, 0x08000000) : Data{0xA1});
  }

  void block_download(unsigned v) {
    const auto to = object();
    const std::size_t length = input_.u16() % longest_download;
    Bytes data(length, input_.u8());
    const std::uint8_t skipped = input_.u8();
    for (std::size_t i = 0; i < length; i += 5) data[i] = static_cast<std::uint8_t>(i);
    const bool sized = (v & 2U) == 0;
    request(with_object(0xC0U | ((v & 1U) != 0 ? 0U : 4U) | (sized ? 2U : 0U), to,
                        sized ? static_cast<std::uint32_t>(length) : 0U));
    // The sub-blocks of the node's default: 127 segments.
    std::size_t sent = 0;
    for (unsigned number = 1; sent < length || length == 0; number = number % 127U + 1U) {
      const std::size_t count = std::min<std::size_t>(7, length - sent);
      const bool last = sent + count == length;
      if (last && (v & 8U) != 0) return;
      Data frame{static_cast<std::uint8_t>(number | (last ? 0x80U : 0U))};
      std::copy_n(data.begin() + static_cast<std::ptrdiff_t>(sent), count, frame.begin() + 1);
      sent += count;
      if (number != skipped) last || number == 127U ? request(frame) : at_once(frame);
      if (last) break;
    }
    const auto unused = static_cast<unsigned>((7U - length % 7U) % 7U);
    const auto sum = static_cast<std::uint16_t>(crc(data) ^ ((v & 4U) != 0 ? 1U : 0U));
    request({static_cast<std::uint8_t>(0xC1U | (length == 0 ? 7U << 2U : unused << 2U)),
             static_cast<std::uint8_t>(sum & 0xFFU), static_cast<std::uint8_t>(sum >> 8U)});
  }

  void other_frame(unsigned v) {
    const std::uint8_t data = input_.u8();
    const auto frame = [&](unsigned id, std::initializer_list<std::uint8_t> bytes) {
      send(conform::can::data_frame(CanId(id), bytes), gap_);
    };
    switch (v) {
      case 0: return frame(0x080, {});
      case 1: return frame(0x080, {data});
      case 2: return frame(0x100, {data, 0x2E, 0x93, 0x02, 0x10, 0x27});
      case 3: return frame(0x205, {data, data, data, data});
      case 4: return frame(0x205, {data});
      case 5: return frame(0x205, {data, 1, 2, 3, 4, 5, 6, 7});
      case 6: return frame(0x706, {data});
      case 7: return frame(0x707, {data});
      case 8: return send(conform::can::remote_frame(CanId(0x185), 4), gap_);
      case 9: return send(conform::can::remote_frame(CanId(0x705), 1), gap_);
      case 10: return send(conform::can::remote_frame(CanId(0x605), 8), gap_);
      case 11: return frame(0x600, {0x40, 0x00, 0x10, 0x00, 0, 0, 0, data});
      case 12: return frame(0x606, {0x40, 0x00, 0x10, 0x00, 0, 0, 0, data});
      case 13: return frame(0x585, {0x80, 0x00, 0x10, 0x00, 0, 0, 0, data});
      case 14: return frame(0x7E5, {0x04, data});
      default: return frame(0x6C0U + data % 8U, {0x40, 0x00, 0x10, 0x00, 0, 0, 0, 0});
    }
  }

  /// A parameter with a right value is rarely guessed by chance.
  void parameter(unsigned v) {
    static constexpr Object parameters[] = {{0x1005, 0}, {0x1012, 0}, {0x1014, 0}, {0x1015, 0}, {0x1016, 1},
                                            {0x1016, 2}, {0x1017, 0}, {0x1201, 1}, {0x1201, 2}, {0x1202, 1},
                                            {0x1202, 2}, {0x1400, 1}, {0x1400, 2}, {0x1600, 0}, {0x1600, 1},
                                            {0x1800, 1}, {0x1800, 2}, {0x1800, 3}, {0x1800, 5}, {0x1A00, 0},
                                            {0x1A00, 1}, {0x2F00, 1}, {0x2F00, 2}, {0x1010, 1}, {0x1011, 1}};
    static constexpr std::uint8_t sizes[] = {4, 4, 4, 2, 4, 4, 2, 4, 4, 4, 4, 4, 1,
                                             1, 4, 4, 1, 2, 2, 1, 4, 2, 2, 4, 4};
    static_assert(std::size(parameters) == std::size(sizes));
    const std::size_t which = input_.u8() % std::size(parameters);
    std::uint32_t value = input_.u32();
    if ((v & 2U) != 0 && sizes[which] == 4) value &= 0xC000'07FFU;
    if ((v & 4U) != 0 && parameters[which].index == 0x1010) value = 0x65766173;  // save
    if ((v & 4U) != 0 && parameters[which].index == 0x1011) value = 0x64616F6C;  // load
    if ((v & 8U) != 0 && sizes[which] == 2) value &= 0x3FFU;
    const auto command = 0x23U | (static_cast<unsigned>(4U - sizes[which]) << 2U);
    if ((v & 1U) != 0) request(with_object(command, parameters[which], value | 0x8000'0000U));
    request(with_object(command, parameters[which], value));
  }

  Input input_;
  Duration gap_ = std::chrono::milliseconds(2);
  std::deque<Action> ready_;
  int actions_ = 0;
  Duration elapsed_{};
};

}  // namespace refnode::fuzz
