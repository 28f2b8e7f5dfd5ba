// SPDX-License-Identifier: Apache-2.0
#include "can/candump_log.hpp"

#include <linux/can.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

#include "base/text.hpp"

namespace conform::can {
namespace {

constexpr std::size_t max_line = 4096;
constexpr std::size_t max_frames = 50'000'000;
constexpr std::int64_t second_ns = 1'000'000'000;

void put_hex(std::string& out, std::uint32_t value, int digits) {
  for (int i = digits; i-- > 0;) out += "0123456789ABCDEF"[(value >> (static_cast<unsigned>(i) * 4U)) & 0xFU];
}

void put_decimal(std::string& out, std::int64_t value, std::size_t digits) {
  std::array<char, 20> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  const auto length = static_cast<std::size_t>(end - buffer.data());
  if (length < digits) out.append(digits - length, '0');
  out.append(buffer.data(), length);
}

void put_frame(std::string& out, const Frame& frame) {
  if (frame.error) {
    put_hex(out, (frame.id & CAN_ERR_MASK) | CAN_ERR_FLAG, 8);
  } else if (frame.extended) {
    put_hex(out, frame.id & CAN_EFF_MASK, 8);
  } else {
    put_hex(out, frame.id & CAN_SFF_MASK, 3);
  }
  out += '#';
  if (frame.remote) {
    out += 'R';
    if (const auto length = std::min<std::uint8_t>(frame.dlc, 8); length > 0) put_hex(out, length, 1);
    return;
  }
  for (const auto byte : frame.bytes()) put_hex(out, byte, 2);
}

std::optional<std::uint32_t> hex_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0');
  if (c >= 'A' && c <= 'F') return static_cast<std::uint32_t>(c - 'A') + 10U;
  if (c >= 'a' && c <= 'f') return static_cast<std::uint32_t>(c - 'a') + 10U;
  return std::nullopt;
}

std::optional<std::int64_t> digits(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || text.front() == '-' || error != std::errc{} || end != text.data() + text.size())
    return {};
  return value;
}

// "1700000000.005000" to nanoseconds.
std::optional<std::int64_t> parse_stamp(std::string_view text) {
  const auto point = text.find('.');
  if (point == std::string_view::npos) return {};
  const auto fraction_text = text.substr(point + 1);
  const auto seconds = digits(text.substr(0, point));
  const auto fraction = digits(fraction_text);
  if (!seconds || !fraction || (fraction_text.size() != 6 && fraction_text.size() != 9)) return {};
  if (*seconds >= std::numeric_limits<std::int64_t>::max() / second_ns) return {};
  return *seconds * second_ns + (fraction_text.size() == 6 ? *fraction * 1000 : *fraction);
}

// The part behind the interface name; the error text says what is wrong with it.
Result<Frame> parse_frame(std::string_view text) {
  const auto mark = text.find('#');
  if (mark == std::string_view::npos) return fail("has no '#' between identifier and data");
  if (mark != 3 && mark != 8) return fail("the identifier must have 3 or 8 hexadecimal digits");
  std::uint32_t id = 0;
  for (const char c : text.substr(0, mark)) {
    const auto digit = hex_digit(c);
    if (!digit) return fail("the identifier is not hexadecimal");
    id = (id << 4U) | *digit;
  }
  Frame frame;
  if (mark == 3) {
    if (id > CAN_SFF_MASK) return fail("an identifier of 3 digits must be at most 7FF");
    frame.id = id;
  } else if ((id & CAN_ERR_FLAG) != 0 && (id & (CAN_EFF_FLAG | CAN_RTR_FLAG)) == 0) {
    frame.error = true;
    frame.id = id & CAN_ERR_MASK;
  } else if (id > CAN_EFF_MASK) {
    return fail("an identifier of 8 digits must be at most 1FFFFFFF");
  } else {
    frame.extended = true;
    frame.id = id;
  }

  auto data = text.substr(mark + 1);
  if (data.starts_with('#')) return fail("is a CAN FD frame, which classical CANopen does not know");
  if (data.starts_with('R') || data.starts_with('r')) {
    frame.remote = true;
    data.remove_prefix(1);
    if (data.empty()) return frame;
    const auto length = hex_digit(data.front());
    if (!length || *length > 8) return fail("the length of a remote frame must be 0 to 8");
    frame.dlc = static_cast<std::uint8_t>(*length);
    data.remove_prefix(1);
  } else {
    while (data.size() >= 2 && data.front() != '_') {
      const auto high = hex_digit(data[0]);
      const auto low = hex_digit(data[1]);
      if (!high || !low) return fail("the data is not made of pairs of hexadecimal digits");
      if (frame.dlc == 8) return fail("has more than eight data bytes");
      frame.data[frame.dlc++] = static_cast<std::uint8_t>((*high << 4U) | *low);
      data.remove_prefix(2);
      if (data.starts_with('.')) data.remove_prefix(1);
    }
  }
  if (data.size() == 2 && data.front() == '_' && frame.dlc == 8) {
    const auto raw = hex_digit(data[1]);
    if (!raw || *raw < 9) return fail("a raw data length code must be 9 to F");
    frame.dlc = static_cast<std::uint8_t>(*raw);
    data = {};
  }
  if (!data.empty()) return fail("has an unexpected end");
  return frame;
}

std::string_view next_word(std::string_view& line) {
  const auto start = std::min(line.find_first_not_of(" \t"), line.size());
  line.remove_prefix(start);
  const auto word = line.substr(0, line.find_first_of(" \t"));
  line.remove_prefix(word.size());
  return word;
}

struct Line {
  std::int64_t stamp = 0;
  std::string_view interface_name;
  CapturedFrame frame;
};

Result<Line> parse_line(std::string_view text) {
  const auto stamp_word = next_word(text);
  if (!stamp_word.starts_with('(') || !stamp_word.ends_with(')'))
    return fail("does not begin with a time in brackets");
  const auto stamp = parse_stamp(stamp_word.substr(1, stamp_word.size() - 2));
  if (!stamp) return fail("the time must be seconds with six or nine decimals");
  Line line;
  line.stamp = *stamp;
  line.interface_name = next_word(text);
  if (line.interface_name.empty()) return fail("names no interface");
  const auto frame = parse_frame(next_word(text));
  if (!frame) return std::unexpected(frame.error());
  line.frame.frame = *frame;
  const auto suffix = next_word(text);
  if (suffix == "T") {
    line.frame.direction = Direction::transmitted;
  } else if (!suffix.empty() && suffix != "R") {
    return fail("has an unexpected word at its end");
  }
  if (!next_word(text).empty()) return fail("has an unexpected word at its end");
  return line;
}

}  // namespace

void append_candump_line(std::string& out, const CapturedFrame& captured, const CaptureInfo& info) {
  const std::int64_t stamp =
      std::max<std::int64_t>(info.epoch_ns + captured.time.time_since_epoch().count(), 0);
  out += '(';
  put_decimal(out, stamp / second_ns, 10);
  out += '.';
  put_decimal(out, stamp % second_ns / 1000, 6);
  out += ") ";
  const std::string_view name = info.interface_name.empty() ? "can0" : std::string_view(info.interface_name);
  for (const char c : name) out += c <= ' ' || c == '\x7F' ? '_' : c;
  out += ' ';
  put_frame(out, captured.frame);
  out += '\n';
}

std::string write_candump_log(const Capture& capture, const CaptureInfo& info) {
  std::string out;
  out.reserve(capture.size() * (44 + info.interface_name.size()));
  for (const auto& captured : capture.frames()) append_candump_line(out, captured, info);
  return out;
}

Result<LoadedCapture> read_candump_log(std::string_view text, const std::string& where,
                                       std::string_view only) {
  LoadedCapture loaded;
  loaded.info.interface_name = only;
  std::size_t number = 0;
  while (!text.empty()) {
    ++number;
    const auto here = [&] { return where + ":" + std::to_string(number); };
    const auto end = text.find('\n');
    auto line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.size() > max_line) return fail("the line is longer than 4096 characters", here());
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (trim(line).empty() || line.starts_with('#')) continue;
    // candump ends every line: this one may lack data bytes, which would be taken for the device's mistake.
    if (end == std::string_view::npos && loaded.capture.size() > 0) {
      loaded.cut_off = line.size();
      break;
    }

    auto parsed = parse_line(line);
    if (!parsed) {
      return fail("is not a line of a candump log: " + parsed.error().what, here(),
                  "expected like (1700000000.005000) can0 605#4000100000000000");
    }
    if (loaded.info.interface_name.empty()) loaded.info.interface_name = parsed->interface_name;
    if (parsed->interface_name != loaded.info.interface_name) {
      if (!only.empty()) continue;
      return fail("the log holds frames of more than one interface: " +
                      printable(loaded.info.interface_name) + " and " + printable(parsed->interface_name),
                  here(), "name the interface to read");
    }
    if (loaded.capture.size() == max_frames) return fail("the log holds more than 50 million frames", here());
    if (loaded.capture.size() == 0) loaded.info.epoch_ns = parsed->stamp;
    // Both stamps are non-negative, so their difference cannot overflow; time may go backwards.
    parsed->frame.time = BusTime(Duration(parsed->stamp - loaded.info.epoch_ns));
    loaded.capture.add(std::move(parsed->frame));
  }
  return loaded;
}

}  // namespace conform::can
