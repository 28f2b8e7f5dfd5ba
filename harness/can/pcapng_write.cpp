// SPDX-License-Identifier: Apache-2.0
#include <linux/can.h>

#include <algorithm>

#include "base/text_bytes.hpp"
#include "can/pcapng.hpp"
#include "can/pcapng_format.hpp"

namespace conform::can {
namespace {

using namespace pcapng;

class BlockWriter {
 public:
  BlockWriter(Bytes& out, std::uint32_t type) : out_(out), start_(out.size()) {
    u32(type);
    u32(0);  // length, known at the end
  }
  void u8(std::uint8_t value) { out_.push_back(value); }
  void u16(std::uint16_t value) { le(value, 2); }
  void u32(std::uint32_t value) { le(value, 4); }
  void bytes(ByteView view) { out_.insert(out_.end(), view.begin(), view.end()); }
  void pad() { out_.resize((out_.size() + 3U) & ~std::size_t{3}); }
  void option(std::uint16_t code, ByteView value) {
    u16(code);
    u16(static_cast<std::uint16_t>(value.size()));
    bytes(value);
    pad();
  }
  void text_option(std::uint16_t code, std::string_view text) {
    if (text.empty()) return;
    // The length has 16 bits; cut long texts between UTF-8 characters.
    std::size_t size = std::min<std::size_t>(text.size(), 65'000);
    while (size < text.size() && size > 0 && (static_cast<std::uint8_t>(text[size]) & 0xC0U) == 0x80U) --size;
    option(code, bytes_of(text).first(size));
  }
  void end_of_options() { u32(0); }
  void finish() {
    const auto length = static_cast<std::uint32_t>(out_.size() - start_ + 4);
    u32(length);
    store_le(std::span(out_).subspan(start_ + 4, 4), length);
  }

 private:
  void le(std::uint64_t value, std::size_t size) {
    out_.resize(out_.size() + size);
    store_le(std::span(out_).last(size), value);
  }

  Bytes& out_;
  std::size_t start_;
};

void put_section(Bytes& out, const CaptureInfo& info) {
  BlockWriter block(out, section_header);
  block.u32(byte_order_magic);
  block.u16(1);  // version 1.0
  block.u16(0);
  block.u32(0xFFFFFFFF);  // section length not given
  block.u32(0xFFFFFFFF);
  block.text_option(option_comment, info.comment);
  block.text_option(option_application, info.tool);
  block.end_of_options();
  block.finish();
}

void put_interface(Bytes& out, const CaptureInfo& info) {
  BlockWriter block(out, interface_description);
  block.u16(link_type_can_socketcan);
  block.u16(0);
  block.u32(0);  // no limit of packet length
  block.text_option(option_interface_name, info.interface_name);
  const std::uint8_t nanoseconds = 9;
  block.option(option_time_resolution, ByteView(&nanoseconds, 1));
  block.end_of_options();
  block.finish();
}

void put_frame(Bytes& out, const CapturedFrame& captured, std::int64_t epoch_ns) {
  const Frame& frame = captured.frame;
  BlockWriter block(out, enhanced_packet);
  const auto stamp = static_cast<std::uint64_t>(
      std::max<std::int64_t>(epoch_ns + captured.time.time_since_epoch().count(), 0));
  block.u32(0);  // interface
  block.u32(static_cast<std::uint32_t>(stamp >> 32U));
  block.u32(static_cast<std::uint32_t>(stamp));
  const auto length = static_cast<std::uint32_t>(can_header_size + frame.size());
  block.u32(length);
  block.u32(length);

  std::uint32_t id = frame.id & CAN_EFF_MASK;
  if (frame.extended) id |= CAN_EFF_FLAG;
  if (frame.remote) id |= CAN_RTR_FLAG;
  if (frame.error) id |= CAN_ERR_FLAG;
  for (std::uint32_t shift = 32; shift > 0; shift -= 8)
    block.u8(static_cast<std::uint8_t>(id >> (shift - 8U)));
  block.u8(std::min<std::uint8_t>(frame.dlc, 8));
  block.u8(0);  // no CAN FD flags
  block.u8(0);
  block.u8(frame.dlc > 8 ? frame.dlc : std::uint8_t{0});  // raw data length code, as the kernel's len8_dlc
  block.bytes(frame.bytes());
  block.pad();

  const auto direction = to_le(captured.direction == Direction::received ? flag_inbound : flag_outbound, 4);
  block.option(option_flags, direction);
  block.text_option(option_comment, captured.comment.view());
  block.end_of_options();
  block.finish();
}

}  // namespace

Bytes pcapng_head(const CaptureInfo& info) {
  Bytes out;
  put_section(out, info);
  put_interface(out, info);
  return out;
}

void append_pcapng(Bytes& out, const CapturedFrame& frame, const CaptureInfo& info) {
  put_frame(out, frame, info.epoch_ns);
}

Bytes write_pcapng(const Capture& capture, const CaptureInfo& info) {
  Bytes out = pcapng_head(info);
  out.reserve(256 + capture.size() * 60);
  for (const auto& captured : capture.frames()) put_frame(out, captured, info.epoch_ns);
  return out;
}

}  // namespace conform::can
