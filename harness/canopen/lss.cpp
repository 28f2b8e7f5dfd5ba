// SPDX-License-Identifier: Apache-2.0
#include "canopen/lss.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "canopen/cob_id.hpp"

namespace conform::canopen {
namespace {

struct Row {
  std::uint8_t specifier;
  std::string_view name;
};

constexpr Row names[] = {
    {0x04, "switch state global"},
    {0x11, "configure node-ID"},
    {0x13, "configure bit timing"},
    {0x15, "activate bit timing"},
    {0x17, "store configuration"},
    {0x40, "switch state selective, vendor-ID"},
    {0x41, "switch state selective, product code"},
    {0x42, "switch state selective, revision number"},
    {0x43, "switch state selective, serial number"},
    {0x44, "switched by switch state selective"},
    {0x46, "identify remote slave, vendor-ID"},
    {0x47, "identify remote slave, product code"},
    {0x48, "identify remote slave, lowest revision number"},
    {0x49, "identify remote slave, highest revision number"},
    {0x4A, "identify remote slave, lowest serial number"},
    {0x4B, "identify remote slave, highest serial number"},
    {0x4C, "identify non-configured remote slave"},
    {0x4F, "identify slave"},
    {0x50, "identify non-configured slave"},
    {0x51, "fastscan"},
    {0x5A, "inquire vendor-ID"},
    {0x5B, "inquire product code"},
    {0x5C, "inquire revision number"},
    {0x5D, "inquire serial number"},
    {0x5E, "inquire node-ID"},
};

using Data = std::array<std::uint8_t, 8>;

// Bytes of an answer behind which all are reserved.
std::size_t used_bytes(std::uint8_t specifier) {
  if (specifier >= 0x5A && specifier <= 0x5D) return 5;
  if (specifier == 0x5E) return 2;
  return specifier == 0x11 || specifier == 0x13 || specifier == 0x17 ? 3 : 1;
}

}  // namespace

std::string_view lss_command_name(std::uint8_t specifier) {
  const auto* found = std::ranges::find(names, specifier, &Row::specifier);
  return found == std::end(names) ? std::string_view{} : found->name;
}

can::Frame encode_lss(LssCommand command, std::uint8_t first, std::uint8_t second) {
  return can::data_frame(lss_request_can_id,
                         Data{static_cast<std::uint8_t>(command), first, second, 0, 0, 0, 0, 0});
}

can::Frame encode_lss_number(LssCommand command, std::uint32_t number) {
  Data data{static_cast<std::uint8_t>(command)};
  store_le(std::span(data).subspan(1, 4), number);
  return can::data_frame(lss_request_can_id, data);
}

std::vector<can::Frame> encode_lss_selection(const LssAddress& address) {
  constexpr LssCommand commands[] = {LssCommand::select_vendor, LssCommand::select_product,
                                     LssCommand::select_revision, LssCommand::select_serial};
  std::vector<can::Frame> out;
  for (std::size_t part = 0; part < address.size(); ++part)
    out.push_back(encode_lss_number(commands[part], address[part]));
  return out;
}

can::Frame encode(const LssFastscan& fastscan) {
  Data data{static_cast<std::uint8_t>(LssCommand::fastscan)};
  store_le(std::span(data).subspan(1, 4), fastscan.number);
  data[5] = fastscan.bit_check;
  data[6] = fastscan.part;
  data[7] = fastscan.next;
  return can::data_frame(lss_request_can_id, data);
}

LssFastscan LssScan::question() const {
  if (!started_) return {};
  const auto following = static_cast<std::uint8_t>((part_ + 1) % lss_parts);
  if (confirming_) return {address_[part_], 0, part_, following};
  return {address_[part_], bit_, part_, part_};
}

void LssScan::answered(bool yes) {
  if (!started_) {
    started_ = true;
    lost_ = !yes;
  } else if (confirming_) {
    confirming_ = false;
    lost_ = !yes;
    found_ = yes && part_ + 1 == lss_parts;
    if (lost_ || found_) return;
    ++part_;
    bit_ = 31;
  } else {
    // Nobody has a 0 there.
    if (!yes) address_[part_] |= 1U << bit_;
    confirming_ = bit_ == 0;
    if (!confirming_) --bit_;
  }
}

std::optional<LssAnswer> decode_lss(const can::Frame& frame) {
  if (!frame.is_data(lss_response_can_id) || frame.size() == 0) return std::nullopt;
  Data data{};
  std::ranges::copy(frame.bytes(), data.begin());
  const ByteView bytes(data);
  LssAnswer out;
  out.eight_bytes = frame.dlc == 8;
  out.specifier = bytes[0];
  out.error = bytes[1];
  out.detail = bytes[2];
  out.number = static_cast<std::uint32_t>(load_le(bytes.subspan(1, 4)));
  out.reserved_zero = std::ranges::all_of(bytes.subspan(used_bytes(out.specifier)),
                                          [](std::uint8_t byte) { return byte == 0; });
  return out;
}

std::string describe_lss_error(std::uint8_t specifier, std::uint8_t error, std::uint8_t detail) {
  if (error == 0) return "0";
  if (error == 0xFF) return fmt::format("FFh, of the maker: {:02X}h", detail);
  if (specifier == 0x17) {
    if (error == 1) return "1 (storing is not supported)";
    if (error == 2) return "2 (the memory failed)";
  } else if (error == 1) {
    return "1 (out of range)";
  }
  return fmt::format("{} (reserved)", error);
}

std::optional<std::uint8_t> lss_bit_rate_index(std::uint32_t kbit_per_second) {
  constexpr std::uint32_t reserved = 0;
  constexpr std::array<std::uint32_t, 9> table = {1000, 800, 500, 250, 125, reserved, 50, 20, 10};
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i] != reserved && table[i] == kbit_per_second) return static_cast<std::uint8_t>(i);
  }
  return std::nullopt;
}

}  // namespace conform::canopen
