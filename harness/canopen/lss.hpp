// SPDX-License-Identifier: Apache-2.0
// Layer setting services (CiA 305): the frames of the LSS master, and what it makes of the answers. Requests
// go out on 7E5h, answers come on 7E4h; all have eight bytes and begin with the command specifier.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "can/frame.hpp"

namespace conform::canopen {

enum class LssCommand : std::uint8_t {
  switch_global = 0x04,
  configure_node_id = 0x11,
  configure_bit_timing = 0x13,
  activate_bit_timing = 0x15,
  store = 0x17,
  select_vendor = 0x40,
  select_product = 0x41,
  select_revision = 0x42,
  select_serial = 0x43,
  selected = 0x44,  ///< answer
  identify_vendor = 0x46,
  identify_product = 0x47,
  identify_revision_low = 0x48,
  identify_revision_high = 0x49,
  identify_serial_low = 0x4A,
  identify_serial_high = 0x4B,
  identify_non_configured = 0x4C,
  identified = 0x4F,      ///< answer to 4Bh and 51h
  non_configured = 0x50,  ///< answer to 4Ch
  fastscan = 0x51,
  inquire_vendor = 0x5A,
  inquire_product = 0x5B,
  inquire_revision = 0x5C,
  inquire_serial = 0x5D,
  inquire_node_id = 0x5E,
};

/// "switch state global", "configure node-ID", ...; empty where CiA 305 has none.
[[nodiscard]] std::string_view lss_command_name(std::uint8_t specifier);

/// Vendor-ID, product code, revision number, serial number: 1018h:01 to 04.
using LssAddress = std::array<std::uint32_t, 4>;
inline constexpr std::uint8_t lss_parts = 4;

/// The answer to 11h of a device that has no node-ID, and the node-ID that takes it away.
inline constexpr std::uint8_t lss_no_node_id = 0xFF;

/// Where a bit rate in kbit/s stands in table 0 of configure bit timing (CiA 305); nullopt: nowhere.
[[nodiscard]] std::optional<std::uint8_t> lss_bit_rate_index(std::uint32_t kbit_per_second);

/// A request without parameters, or with one or two bytes of them.
[[nodiscard]] can::Frame encode_lss(LssCommand command, std::uint8_t first = 0, std::uint8_t second = 0);
/// A request with a number of four bytes.
[[nodiscard]] can::Frame encode_lss_number(LssCommand command, std::uint32_t number);
/// The four frames that select one slave.
[[nodiscard]] std::vector<can::Frame> encode_lss_selection(const LssAddress& address);

struct LssFastscan {
  static constexpr std::uint8_t begin = 0x80;  ///< `bit_check` of the frame that starts a scan
  std::uint32_t number = 0;                    ///< of the part, its upper bits
  std::uint8_t bit_check = begin;              ///< lowest bit that counts
  std::uint8_t part = 0, next = 0;
};
[[nodiscard]] can::Frame encode(const LssFastscan& fastscan);

/// The part of an LSS address, found bit by bit: ask question(), tell answered(). At the end of a part all
/// its bits are asked for again; who does not answer then is not there.
class LssScan {
 public:
  [[nodiscard]] LssFastscan question() const;
  void answered(bool yes);
  /// The scan is over: the address was confirmed, or nobody answers to it.
  [[nodiscard]] bool finished() const { return found_ || lost_; }
  [[nodiscard]] bool found() const { return found_; }
  [[nodiscard]] const LssAddress& address() const { return address_; }

 private:
  LssAddress address_{};
  std::uint8_t part_ = 0, bit_ = 31;
  bool started_ = false, confirming_ = false, found_ = false, lost_ = false;
};

/// An answer of a slave.
struct LssAnswer {
  std::uint8_t specifier = 0;
  std::uint8_t error = 0;    ///< of 11h, 13h, 17h; of 5Eh the node-ID
  std::uint8_t detail = 0;   ///< where `error` is FFh
  std::uint32_t number = 0;  ///< of 5Ah to 5Dh
  bool reserved_zero = true;
  bool eight_bytes = true;  ///< what is missing counts as 0
};
/// nullopt: no data frame on 7E4h, or an empty one.
[[nodiscard]] std::optional<LssAnswer> decode_lss(const can::Frame& frame);

/// "0", "1 (out of range)": the error code of an answer to 11h, 13h or 17h in words.
[[nodiscard]] std::string describe_lss_error(std::uint8_t specifier, std::uint8_t error, std::uint8_t detail);

}  // namespace conform::canopen
