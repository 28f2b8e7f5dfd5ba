// SPDX-License-Identifier: Apache-2.0
// Numbers of the pcapng format that writer and reader share (draft-ietf-opsawg-pcapng,
// LINKTYPE_CAN_SOCKETCAN).
#pragma once

#include <cstddef>
#include <cstdint>

namespace conform::can::pcapng {

// Block types
inline constexpr std::uint32_t section_header = 0x0A0D0D0A;
inline constexpr std::uint32_t interface_description = 1;
inline constexpr std::uint32_t simple_packet = 3;
inline constexpr std::uint32_t enhanced_packet = 6;

inline constexpr std::uint32_t byte_order_magic = 0x1A2B3C4D;
inline constexpr std::uint16_t link_type_can_socketcan = 227;

// Options
inline constexpr std::uint16_t option_end = 0;
inline constexpr std::uint16_t option_comment = 1;
inline constexpr std::uint16_t option_interface_name = 2;   // of an interface
inline constexpr std::uint16_t option_flags = 2;            // of a packet
inline constexpr std::uint16_t option_application = 4;      // of a section
inline constexpr std::uint16_t option_time_resolution = 9;  // of an interface
inline constexpr std::uint16_t option_time_offset = 14;     // of an interface

// Packet flags, bits 0..1
inline constexpr std::uint32_t flag_inbound = 1;
inline constexpr std::uint32_t flag_outbound = 2;

// CAN packet: identifier and flags (big-endian, 4), payload length, FD flags, reserved, raw DLC, payload
inline constexpr std::size_t can_header_size = 8;
inline constexpr std::uint8_t fd_format_flag = 0x04;

}  // namespace conform::can::pcapng
