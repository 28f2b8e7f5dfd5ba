// SPDX-License-Identifier: Apache-2.0
// Which of the device's services may have sent a frame: by the COB-IDs that the trace shows, and where it
// shows none by the pre-defined connection set (CiA 301, 7.3.3).
#pragma once

#include <cstdint>
#include <vector>

#include "monitor/follower.hpp"

namespace conform::monitor {

/// What a COB-ID entry says of a CAN-ID.
enum class Held : std::uint8_t {
  no,
  off,    ///< it holds it, and does not send: not valid, or no producer
  maybe,  ///< the trace leaves open what it holds
  yes,
};

struct Holder {
  std::uint16_t index = 0;
  Held held = Held::no;
  const Entries::Entry* entry = nullptr;  ///< nullptr where it is not known, but at most guessed
};

/// The entry with the COB-ID that the object sends with.
[[nodiscard]] std::uint8_t sending_sub(std::uint16_t index);
[[nodiscard]] constexpr bool is_tpdo(std::uint16_t index) { return index >= 0x1800 && index <= 0x19FF; }
/// 11 bits, or 29 with bit 29 set.
[[nodiscard]] Entries::Key can_id_in(std::uint32_t cob_id);
/// TPDO, EMCY, SYNC, TIME, SDO: the CAN-ID of an object by the pre-defined connection set, or nothing.
[[nodiscard]] std::optional<Entries::Key> predefined(std::uint16_t index, NodeId node);

[[nodiscard]] Holder holder(const Follower& follower, std::uint16_t index, Entries::Key can_id);
/// All objects of the device that may send with this CAN-ID, or are known to be off.
[[nodiscard]] std::vector<Holder> holders(const Follower& follower, Entries::Key can_id);
/// Somebody but these objects of the device may send with it.
[[nodiscard]] bool other_holder(const std::vector<Holder>& holders, std::uint16_t first, std::uint16_t last);
/// No object is known to send with it now, and another than these has had it: the frame may be what that one
/// had still to send when its COB-ID was changed.
[[nodiscard]] bool may_be_left_over(const Follower& follower, const std::vector<Holder>& holders,
                                    Entries::Key can_id, std::uint16_t first, std::uint16_t last);

}  // namespace conform::monitor
