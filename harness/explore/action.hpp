// SPDX-License-Identifier: Apache-2.0
// One thing a client or another node may do to a device. An action is made of plain values only, so that a
// conversation can be kept, played again and made shorter.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"
#include "base/strong.hpp"
#include "base/time.hpp"
#include "can/frame.hpp"

namespace conform::explore {

/// How the client moves the bytes of an SDO transfer.
enum class Transfer : std::uint8_t {
  automatic,  ///< expedited up to four bytes, else segmented; an upload: as the server likes
  expedited_unsized,
  segmented,
  segmented_unsized,
  block,
  block_unsized,
};
/// As the key `transfer` of a scenario has it.
[[nodiscard]] std::string_view word_of(Transfer transfer);

struct Action {
  enum class Kind : std::uint8_t {
    upload,
    download,
    request,  ///< one frame on the SDO request channel, right or wrong, and what comes back
    frame,    ///< any other frame of somebody else: NMT, SYNC, RPDO, remote frame, heartbeat, EMCY, TIME
    power,    ///< the power goes off and on
    wait,
  };
  Kind kind = Kind::wait;
  Multiplexer object{};                     ///< upload, download
  Transfer transfer = Transfer::automatic;  ///< upload, download
  std::uint8_t blksize = 127;               ///< upload by block
  Bytes data{};                             ///< download: the value
  std::string fault{};                      ///< what the client does wrong in the transfer, as a phrase
  can::Frame frame{};                       ///< request, frame
  Duration time{};                          ///< wait

  [[nodiscard]] bool is_transfer() const { return kind == Kind::upload || kind == Kind::download; }
  /// The specifier of an NMT command that reaches `node` (addressed or by 0); 0: it is no such command.
  [[nodiscard]] std::uint8_t nmt_command(NodeId node) const;
  [[nodiscard]] bool is_at(std::uint16_t index, std::uint8_t sub) const {
    return is_transfer() && object == Multiplexer{Index(index), SubIndex(sub)};
  }
  friend bool operator==(const Action&, const Action&) = default;
};

using Conversation = std::vector<Action>;

[[nodiscard]] Action upload(Multiplexer object, Transfer transfer = Transfer::automatic);
[[nodiscard]] Action download(Multiplexer object, Bytes data, Transfer transfer = Transfer::automatic);
[[nodiscard]] Action frame(const can::Frame& frame);
[[nodiscard]] Action request(const can::Frame& frame);
[[nodiscard]] Action nmt(NodeId node, std::uint8_t command);
[[nodiscard]] Action wait(Duration time);

/// One line for a reader: "download 1017h:00 = E8 03, segmented, wrong toggle in segment 1".
[[nodiscard]] std::string describe(const Action& action, NodeId node);

/// What one frame is to a node, in a few words: "NMT start", "SYNC", "guard request", "RPDO 201h 05".
[[nodiscard]] std::string describe(const can::Frame& frame, NodeId node);

}  // namespace conform::explore
