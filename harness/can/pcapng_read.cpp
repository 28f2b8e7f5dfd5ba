// SPDX-License-Identifier: Apache-2.0
#include <linux/can.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "base/text.hpp"
#include "can/pcapng.hpp"
#include "can/pcapng_format.hpp"

namespace conform::can {
namespace {

using namespace pcapng;

constexpr std::size_t max_block = std::size_t{16} << 20U;
constexpr std::size_t max_interfaces = 4096;
constexpr std::size_t max_frames = 50'000'000;
constexpr std::int64_t max_ns = std::numeric_limits<std::int64_t>::max();
constexpr std::uint64_t second_ns = 1'000'000'000;

struct Interface {
  std::string name;
  std::uint16_t link_type = 0;
  std::uint8_t resolution = 6;  // 10^-6 s unless said otherwise; bit 7: power of two
  std::int64_t offset_s = 0;
};

// Time stamp units to nanoseconds since 1970; nullopt when it does not fit.
std::optional<std::int64_t> to_ns(std::uint64_t units, const Interface& interface) {
  const unsigned exponent = interface.resolution & 0x7FU;
  std::uint64_t seconds = 0;
  std::uint64_t nanoseconds = 0;
  if ((interface.resolution & 0x80U) != 0) {
    if (exponent > 63) return {};
    seconds = exponent == 0 ? units : units >> exponent;
    std::uint64_t fraction = exponent == 0 ? 0 : units & ((std::uint64_t{1} << exponent) - 1U);
    // Keep the product below in 64 bits: more than 34 bits of fraction are finer than a nanosecond anyway.
    const unsigned used = std::min(exponent, 34U);
    fraction >>= exponent - used;
    nanoseconds = (fraction * second_ns) >> used;
  } else {
    if (exponent > 19) return {};
    std::uint64_t per_second = 1;
    for (unsigned i = 0; i < exponent; ++i) per_second *= 10U;
    seconds = units / per_second;
    const std::uint64_t fraction = units % per_second;
    nanoseconds = exponent <= 9 ? fraction * (second_ns / per_second) : fraction / (per_second / second_ns);
  }
  if (seconds > static_cast<std::uint64_t>(max_ns) / second_ns - 1U) return {};
  constexpr std::int64_t max_seconds = max_ns / static_cast<std::int64_t>(second_ns) - 1;
  if (interface.offset_s < -max_seconds ||
      interface.offset_s > max_seconds - static_cast<std::int64_t>(seconds))
    return {};
  const std::int64_t total = static_cast<std::int64_t>(seconds) + interface.offset_s;
  if (total < 0) return {};
  return total * static_cast<std::int64_t>(second_ns) + static_cast<std::int64_t>(nanoseconds);
}

class Reader {
 public:
  Reader(ByteView bytes, const std::string& where, std::string_view only)
      : bytes_(bytes), where_(where), only_(only) {}

  Result<LoadedCapture> run() {
    if (bytes_.size() < 12 || load_le(bytes_.first(4)) != section_header) {
      return fail("is not a pcapng file", where_,
                  "classic pcap files can be converted with: editcap -F pcapng OLD NEW");
    }
    while (position_ < bytes_.size()) {
      if (auto done = block(); !done) return std::unexpected(done.error());
    }
    if (loaded_.capture.size() == 0 && !interfaces_.empty())
      loaded_.info.interface_name = interfaces_.front().name;
    return std::move(loaded_);
  }

  std::string application() {
    if (bytes_.size() < 12 || load_le(bytes_.first(4)) != section_header || !block()) return {};
    return std::move(loaded_.info.tool);
  }

 private:
  [[nodiscard]] std::uint32_t u32(ByteView view, std::size_t at) const {
    return static_cast<std::uint32_t>(integer(view.subspan(at, 4)));
  }
  [[nodiscard]] std::uint16_t u16(ByteView view, std::size_t at) const {
    return static_cast<std::uint16_t>(integer(view.subspan(at, 2)));
  }
  [[nodiscard]] std::uint64_t integer(ByteView view) const {
    if (!big_endian_) return load_le(view);
    std::uint64_t value = 0;
    for (const auto byte : view) value = (value << 8U) | byte;
    return value;
  }
  [[nodiscard]] std::unexpected<Error> broken(std::string what) const {
    return fail("the pcapng file is damaged: " + std::move(what),
                where_ + ": byte " + std::to_string(position_));
  }

  Result<void> block() {
    const ByteView rest = bytes_.subspan(position_);
    if (rest.size() < 12) return end_inside_block();
    // The type of a section header reads the same in both byte orders and comes before the byte order is
    // known.
    if (load_le(rest.first(4)) == section_header) {
      const auto magic = load_le(rest.subspan(8, 4));
      if (magic == byte_order_magic) {
        big_endian_ = false;
      } else if (magic == 0x4D3C2B1A) {
        big_endian_ = true;
      } else {
        return broken("the byte order mark of a section is wrong");
      }
    }
    const std::uint32_t type = u32(rest, 0);
    const std::size_t length = u32(rest, 4);
    if (length < 12 || length % 4 != 0)
      return broken("a block has the impossible length " + std::to_string(length));
    if (length > max_block) return broken("a block is larger than 16 MiB");
    if (length > rest.size()) return end_inside_block();
    if (u32(rest, length - 4) != length) return broken("the two lengths of a block differ");
    const ByteView body = rest.subspan(8, length - 12);
    auto done = dispatch(type, body);
    position_ += length;
    return done;
  }

  // What was recorded until somebody killed the recorder is worth judging; without a frame nothing is left.
  Result<void> end_inside_block() {
    if (loaded_.capture.size() == 0) return broken("it ends inside a block");
    loaded_.cut_off = bytes_.size() - position_;
    position_ = bytes_.size();
    return {};
  }

  Result<void> dispatch(std::uint32_t type, ByteView body) {
    switch (type) {
      case section_header: return section(body);
      case interface_description: return interface(body);
      case enhanced_packet: return packet(body);
      case simple_packet:
        return fail("holds packets without time stamps", where_ + ": byte " + std::to_string(position_));
      default: return {};
    }
  }

  // Calls use(code, value) for each option until the end mark or the end of the block.
  template <typename Use>
  Result<void> options(ByteView view, Use&& use) {
    while (view.size() >= 4) {
      const std::uint16_t code = u16(view, 0);
      const std::size_t size = u16(view, 2);
      if (code == option_end) return {};
      const std::size_t padded = (size + 3U) & ~std::size_t{3};
      if (padded > view.size() - 4) return broken("an option is longer than its block");
      use(code, view.subspan(4, size));
      view = view.subspan(4 + padded);
    }
    return {};
  }

  static std::string text(ByteView value) { return {value.begin(), value.end()}; }

  Result<void> section(ByteView body) {
    if (body.size() < 16) return broken("a section header is too short");
    if (u16(body, 4) != 1) return broken("its version is not 1");
    interfaces_.clear();
    const bool first = position_ == 0;
    return options(body.subspan(16), [&](std::uint16_t code, ByteView value) {
      if (!first) return;
      if (code == option_comment && loaded_.info.comment.empty()) loaded_.info.comment = text(value);
      if (code == option_application) loaded_.info.tool = text(value);
    });
  }

  Result<void> interface(ByteView body) {
    if (body.size() < 8) return broken("an interface description is too short");
    if (interfaces_.size() == max_interfaces) return broken("it describes more than 4096 interfaces");
    Interface made;
    made.link_type = u16(body, 0);
    auto done = options(body.subspan(8), [&](std::uint16_t code, ByteView value) {
      if (code == option_interface_name) made.name = text(value);
      if (code == option_time_resolution && value.size() == 1) made.resolution = value[0];
      if (code == option_time_offset && value.size() == 8)
        made.offset_s = static_cast<std::int64_t>(integer(value));
    });
    interfaces_.push_back(std::move(made));
    return done;
  }

  Result<void> packet(ByteView body) {
    if (body.size() < 20) return broken("a packet block is too short");
    const std::size_t number = u32(body, 0);
    if (number >= interfaces_.size()) return broken("a packet names an interface that is not described");
    const Interface& source = interfaces_[number];
    if (!only_.empty() && source.name != only_) return {};
    const std::string here = where_ + ": byte " + std::to_string(position_);
    if (source.link_type != link_type_can_socketcan) {
      return fail(
          "holds packets of link type " + std::to_string(source.link_type) + " instead of 227 (SocketCAN)",
          here, "capture on the CAN interface itself, not on \"any\"");
    }
    if (loaded_.capture.size() == 0) {
      loaded_.info.interface_name = source.name;
    } else if (source.name != loaded_.info.interface_name) {
      return fail("holds frames of more than one interface: " + printable(loaded_.info.interface_name) +
                      " and " + printable(source.name),
                  here, "name the interface to read");
    }
    const std::uint64_t units = (static_cast<std::uint64_t>(u32(body, 4)) << 32U) | u32(body, 8);
    const auto stamp = to_ns(units, source);
    if (!stamp) return broken("a time stamp is out of range");

    const std::size_t captured = u32(body, 12);
    const std::size_t padded = (captured + 3U) & ~std::size_t{3};
    if (captured > body.size() - 20 || padded > body.size() - 20)
      return broken("a packet is longer than its block");
    CapturedFrame made;
    if (auto done = frame(body.subspan(20, captured), made.frame); !done) return done;
    auto done = options(body.subspan(20 + padded), [&](std::uint16_t code, ByteView value) {
      if (code == option_flags && value.size() == 4 && (integer(value) & 3U) == flag_outbound) {
        made.direction = Direction::transmitted;
      }
      if (code != option_comment) return;
      if (!made.comment.empty()) made.comment.append("; ");
      made.comment.append(text(value));
    });
    if (!done) return done;
    if (loaded_.capture.size() == max_frames) return broken("it holds more than 50 million frames");
    if (loaded_.capture.size() == 0) loaded_.info.epoch_ns = *stamp;
    made.time = BusTime(Duration(*stamp - loaded_.info.epoch_ns));  // both are non-negative
    loaded_.capture.add(std::move(made));
    return {};
  }

  Result<void> frame(ByteView data, Frame& out) const {
    if (data.size() < can_header_size) return broken("a CAN packet is shorter than its header");
    std::uint32_t id = 0;
    for (const auto byte : data.first(4)) id = (id << 8U) | byte;
    out.extended = (id & CAN_EFF_FLAG) != 0;
    out.remote = (id & CAN_RTR_FLAG) != 0;
    out.error = (id & CAN_ERR_FLAG) != 0;
    out.id = id & CAN_EFF_MASK;
    const std::uint8_t length = data[4];
    if (length > 8 || (data[5] & fd_format_flag) != 0) {
      return fail("holds a CAN FD frame, which classical CANopen does not know",
                  where_ + ": byte " + std::to_string(position_));
    }
    out.dlc = length == 8 && data[7] > 8 && data[7] < 16 ? data[7] : length;
    const std::size_t size = out.size();
    if (size > data.size() - can_header_size) return broken("a CAN packet is shorter than its data length");
    std::ranges::copy(data.subspan(can_header_size, size), out.data.begin());
    return {};
  }

  ByteView bytes_;
  const std::string& where_;
  std::string_view only_;
  std::size_t position_ = 0;
  bool big_endian_ = false;
  std::vector<Interface> interfaces_;
  LoadedCapture loaded_;
};

}  // namespace

std::string pcapng_application(ByteView head) {
  const std::string nowhere;
  return Reader(head, nowhere, {}).application();
}

Result<LoadedCapture> read_pcapng(ByteView bytes, const std::string& where, std::string_view only) {
  return Reader(bytes, where, only).run();
}

}  // namespace conform::can
