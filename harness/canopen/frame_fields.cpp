// SPDX-License-Identifier: Apache-2.0
#include "canopen/frame_fields.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/bytes.hpp"
#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/emcy.hpp"
#include "canopen/nmt.hpp"

namespace conform::canopen {
namespace {

using Fields = std::vector<FrameField>;

std::string flag(unsigned byte, unsigned bit) { return (byte >> bit & 1U) != 0 ? "1" : "0"; }

std::string number(std::uint64_t value) { return std::to_string(value); }

void add_object(Fields& out, ByteView bytes) {
  out.push_back(
      {"object", to_string(Multiplexer{Index(static_cast<std::uint16_t>(load_le(bytes.subspan(1, 2)))),
                                       SubIndex(bytes[3])})});
}

/// Abort: command 80h, index, sub-index, code.
void add_abort(Fields& out, ByteView bytes) {
  add_object(out, bytes);
  out.push_back(
      {"abort code", describe(AbortCode(static_cast<std::uint32_t>(load_le(bytes.subspan(4, 4)))))});
}

/// Command byte of an initiate: bits 3-2 n, bit 1 e, bit 0 s; then the object, and data or their number.
void add_initiate(Fields& out, ByteView bytes) {
  const unsigned command = bytes[0];
  const bool expedited = (command & 2U) != 0;
  const bool told = (command & 1U) != 0;
  out.push_back({"expedited (e)", flag(command, 1)});
  out.push_back({"size indicated (s)", flag(command, 0)});
  out.push_back({"bytes without data (n)", number(command >> 2U & 3U)});
  add_object(out, bytes);
  const auto rest = bytes.subspan(4);
  if (!expedited) {
    out.push_back({told ? "size" : "reserved", told ? number(load_le(rest)) : hex_bytes(rest)});
    return;
  }
  const std::size_t size = told ? 4U - (command >> 2U & 3U) : 4U;
  out.push_back({"data", hex_bytes(rest.first(size))});
  if (size < 4) out.push_back({"unused bytes", hex_bytes(rest.subspan(size))});
}

/// Segment: bit 4 toggle, bits 3-1 n, bit 0 c; then seven bytes.
void add_segment(Fields& out, ByteView bytes) {
  const unsigned command = bytes[0];
  const std::size_t size = 7U - (command >> 1U & 7U);
  out.push_back({"toggle", flag(command, 4)});
  out.push_back({"last segment (c)", flag(command, 0)});
  out.push_back({"bytes without data (n)", number(7U - size)});
  out.push_back({"data", hex_bytes(bytes.subspan(1, size))});
  if (size < 7) out.push_back({"unused bytes", hex_bytes(bytes.subspan(1 + size))});
}

void add_block_segment(Fields& out, ByteView bytes) {
  out.push_back({"last segment (c)", flag(bytes[0], 7)});
  out.push_back({"sequence number", number(bytes[0] & 0x7FU)});
  out.push_back({"data", hex_bytes(bytes.subspan(1))});
}

void add_sdo(Fields& out, ByteView bytes, std::string_view meaning) {
  const auto is = [meaning](std::string_view what) { return meaning.starts_with(what); };
  if (is("SDO block segment")) return add_block_segment(out, bytes);
  out.push_back({"command", hex(bytes[0], 2)});
  if (is("SDO abort")) return add_abort(out, bytes);
  if (is("SDO upload response") || is("SDO download request")) return add_initiate(out, bytes);
  if (is("SDO upload segment request") || is("SDO download segment response")) {
    out.push_back({"toggle", flag(bytes[0], 4)});
    out.push_back({"reserved", hex_bytes(bytes.subspan(1))});
    return;
  }
  if (is("SDO upload segment") || is("SDO download segment")) return add_segment(out, bytes);
  if (is("SDO upload request") || is("SDO download response")) {
    add_object(out, bytes);
    out.push_back({"reserved", hex_bytes(bytes.subspan(4))});
    return;
  }
  for (std::size_t i = 1; i < bytes.size(); ++i) out.push_back({fmt::format("byte {}", i), hex(bytes[i], 2)});
}

void add_error_control(Fields& out, std::uint8_t byte) {
  const auto state = nmt_state_at(byte & 0x7FU);
  out.push_back({"toggle", flag(byte, 7)});
  out.push_back({"state", state ? std::string(to_string(*state)) : "undefined " + hex(byte & 0x7FU, 2)});
}

void add_emcy(Fields& out, ByteView bytes) {
  const auto emcy = decode_emcy(bytes);
  out.push_back({"error code", describe_emcy_code(emcy->code)});
  out.push_back({"error register", hex(emcy->error_register, 2)});
  out.push_back({"manufacturer's bytes", hex_bytes(emcy->manufacturer)});
}

}  // namespace

Fields fields_of(const can::Frame& frame, std::string_view meaning) {
  Fields out;
  const auto bytes = frame.bytes();
  out.push_back({"length", number(frame.dlc)});
  const auto is = [meaning](std::string_view what) { return meaning.starts_with(what); };
  if (frame.remote || frame.error || bytes.empty()) return out;
  if (is("SDO ") && bytes.size() == 8) {
    add_sdo(out, bytes, meaning);
  } else if (is("EMCY ") && bytes.size() == 8) {
    add_emcy(out, bytes);
  } else if ((is("heartbeat ") || is("boot-up ")) && bytes.size() == 1) {
    add_error_control(out, bytes[0]);
  } else {
    for (std::size_t i = 0; i < bytes.size(); ++i)
      out.push_back({fmt::format("byte {}", i), hex(bytes[i], 2)});
  }
  return out;
}

std::vector<FieldDifference> differences(const Fields& before, const Fields& after) {
  std::vector<FieldDifference> out;
  for (const auto& field : before) {
    const auto other = std::ranges::find(after, field.name, &FrameField::name);
    if (other == after.end()) {
      out.push_back({field.name, field.value, {}});
    } else if (other->value != field.value) {
      out.push_back({field.name, field.value, other->value});
    }
  }
  for (const auto& field : after) {
    if (std::ranges::find(before, field.name, &FrameField::name) == before.end())
      out.push_back({field.name, {}, field.value});
  }
  return out;
}

}  // namespace conform::canopen
