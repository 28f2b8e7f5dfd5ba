// SPDX-License-Identifier: Apache-2.0
#include "canopen/emcy.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"

namespace conform::canopen {
namespace {

struct Row {
  std::uint16_t code;
  std::uint16_t mask;
  std::string_view words;
};

// Tables 26 and 27; the most specific row comes first.
constexpr Row rows[] = {
    {0x8110, 0xFFFF, "CAN overrun"},
    {0x8120, 0xFFFF, "error passive"},
    {0x8130, 0xFFFF, "heartbeat or life guarding"},
    {0x8140, 0xFFFF, "recovered from bus-off"},
    {0x8150, 0xFFFF, "CAN-ID collision"},
    {0x8210, 0xFFFF, "PDO too short"},
    {0x8220, 0xFFFF, "PDO too long"},
    {0x8230, 0xFFFF, "DAM-MPDO destination missing"},
    {0x8240, 0xFFFF, "SYNC of unexpected length"},
    {0x8250, 0xFFFF, "RPDO timeout"},
    {0x0000, 0xFF00, "error reset or no error"},
    {0x1000, 0xFF00, "generic error"},
    {0x2000, 0xFF00, "current"},
    {0x2100, 0xFF00, "current, input side"},
    {0x2200, 0xFF00, "current inside the device"},
    {0x2300, 0xFF00, "current, output side"},
    {0x3000, 0xFF00, "voltage"},
    {0x3100, 0xFF00, "mains voltage"},
    {0x3200, 0xFF00, "voltage inside the device"},
    {0x3300, 0xFF00, "output voltage"},
    {0x4000, 0xFF00, "temperature"},
    {0x4100, 0xFF00, "ambient temperature"},
    {0x4200, 0xFF00, "device temperature"},
    {0x5000, 0xFF00, "device hardware"},
    {0x6000, 0xFF00, "device software"},
    {0x6100, 0xFF00, "internal software"},
    {0x6200, 0xFF00, "user software"},
    {0x6300, 0xFF00, "data set"},
    {0x7000, 0xFF00, "additional modules"},
    {0x8000, 0xFF00, "monitoring"},
    {0x8100, 0xFF00, "communication"},
    {0x8200, 0xFF00, "protocol"},
    {0x9000, 0xFF00, "external error"},
    {0xF000, 0xFF00, "additional functions"},
    {0xFF00, 0xFF00, "device specific"},
};

}  // namespace

std::optional<Emcy> decode_emcy(ByteView bytes) {
  if (bytes.size() != 8) return std::nullopt;
  Emcy emcy;
  emcy.code = static_cast<std::uint16_t>(load_le(bytes.first(2)));
  emcy.error_register = bytes[2];
  std::ranges::copy(bytes.subspan(3), emcy.manufacturer.begin());
  return emcy;
}

std::array<std::uint8_t, 8> encode(const Emcy& emcy) {
  std::array<std::uint8_t, 8> bytes{};
  store_le(std::span(bytes).first(2), emcy.code);
  bytes[2] = emcy.error_register;
  std::ranges::copy(emcy.manufacturer, bytes.begin() + 3);
  return bytes;
}

std::string_view emcy_class(std::uint16_t code) {
  for (const Row& row : rows) {
    if ((code & row.mask) == row.code) return row.words;
  }
  return {};
}

std::string describe_emcy_code(std::uint16_t code) {
  const std::string_view words = emcy_class(code);
  return fmt::format("{} ({})", hex(code, 4), words.empty() ? "reserved class" : words);
}

}  // namespace conform::canopen
