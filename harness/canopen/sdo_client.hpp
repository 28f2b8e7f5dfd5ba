// SPDX-License-Identifier: Apache-2.0
// Client side of one SDO transfer as a passive object: it is asked for the next frame to send, handed the
// server's frames, and told when none came in time. No I/O, no clock. The caller may hand over several frames
// before they are on the bus (a sub-block), and says how many are still on their way, so that what came
// before a request is not taken for its answer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/bytes.hpp"
#include "base/strong.hpp"
#include "canopen/sdo_initiate.hpp"

namespace conform::canopen {

/// What was counted on the way; absent where it does not apply or was not reached.
struct TransferCounts {
  std::uint64_t segments = 0;       ///< of the transfer; block upload: those taken
  std::uint64_t sub_blocks = 0;     ///< begun
  std::uint64_t retransmitted = 0;  ///< segments sent or seen once more
  std::uint64_t acks = 0;           ///< acknowledges of the server (block download)
  std::uint64_t wrong_numbers = 0;  ///< segments whose number is not the next (block upload)
  std::uint64_t timeouts = 0;       ///< sub-blocks that stopped until they were acknowledged (block upload)
  std::uint64_t surplus = 0;        ///< frames of the server after the transfer was over
  std::uint64_t answers = 0;        ///< aborts among them
  std::optional<std::uint8_t> first_ackseq, blksize, unused;
  std::optional<std::uint16_t> crc;  ///< as the end frame of a block upload says it
  std::optional<bool> crc_agreed, crc_ok;
  bool block = false;     ///< a block transfer was asked for
  bool switched = false;  ///< the server switched to the normal upload
};

struct TransferResult {
  enum class Kind : std::uint8_t {
    confirmed,  ///< complete; `data` holds what was uploaded
    aborted,    ///< the server sent an abort with `code`
    violation,  ///< the server broke the protocol, see `detail`
    silence,    ///< an answer was due and none came
    gave_up,    ///< the client aborted on purpose
  };
  Kind kind = Kind::confirmed;
  Bytes data;  ///< upload: what was received, also when the transfer ended badly
  bool expedited = false;
  bool size_indicated = false;                  ///< the server told the size (upload)
  std::optional<std::uint32_t> announced_size;  ///< of the answer to the initiate request of an upload
  AbortCode code{};
  std::string detail;  ///< violation: one precise sentence without full stop
  std::optional<AbortCode>
      reply;  ///< abort that the client should send now, as CiA 301 has it; none when the channel is closed
  std::vector<std::string>
      remarks;  ///< reserved or unused bits and bytes that were not zero; they do not end a transfer
  bool abandoned = false;  ///< the client fell silent on purpose: nothing has closed the server's channel
  std::string misplaced;   ///< a fault on purpose that had no place in the transfer, in one sentence
  TransferCounts counts;
};

/// A frame of the client; shorter than eight bytes only on purpose.
struct SdoFrame {
  enum class Part : std::uint8_t { initiate, start, segment, acknowledge, end, abort };
  SdoBytes bytes{};
  Part part = Part::initiate;
  std::size_t number = 0;  ///< of the segment, or of the sub-block that is acknowledged, from 1
  std::uint8_t size = 8;
  bool last = false;  ///< the segment is the last one of the transfer
  [[nodiscard]] ByteView view() const { return ByteView(bytes).first(size); }
};

class SdoClient {
 public:
  SdoClient() = default;
  SdoClient(const SdoClient&) = default;
  SdoClient& operator=(const SdoClient&) = default;
  virtual ~SdoClient() = default;

  /// The frame to send now; nullopt when the server is to act, or at the end. `unsent`: frames handed over
  /// that are not on the bus yet.
  [[nodiscard]] virtual std::optional<SdoFrame> next(std::size_t unsent) = 0;
  /// Takes one data frame of the server's channel. False: it was no part of the transfer (it came before the
  /// request that it would answer, or after the client fell silent), and the time-out goes on.
  virtual bool on_frame(ByteView data, std::size_t unsent) = 0;
  /// Nothing that was taken came in time.
  virtual void on_silence() = 0;
  /// Segments behind us, 0 when the initiate request has been answered; nullopt before.
  [[nodiscard]] virtual std::optional<std::size_t> settled() const = 0;
  /// The client sends nothing more on purpose; what is awaited is what the server makes of it.
  [[nodiscard]] virtual bool fell_silent() const { return false; }

  [[nodiscard]] bool ended() const { return ended_; }
  /// How it stands; final when ended().
  [[nodiscard]] const TransferResult& result() const { return result_; }
  [[nodiscard]] TransferResult take() { return std::move(result_); }

 protected:
  using Kind = TransferResult::Kind;
  void finish(Kind kind) {
    result_.kind = kind;
    ended_ = true;
  }
  void violation(std::string detail, std::optional<AbortCode> reply);
  void remark(std::string text);
  /// Ends the transfer when `bytes` are an abort (1000 0000b and, with a remark, reserved bits).
  /// `maybe_unknown`: it refuses a request that the server need not know; 0504 0001h then has no multiplexer,
  /// and may name 0000h:00.
  bool take_abort(ByteView bytes, Multiplexer mux, bool maybe_unknown = false);
  /// Nothing came: the client tells the server that it gives up (CiA 301, table 22, 0504 0000h).
  void give_up_waiting();

  TransferResult result_;
  bool ended_ = false;
};

/// What is wrong with an answer, in the words of every protocol.
[[nodiscard]] bool any_set(ByteView bytes);
[[nodiscard]] std::string too_short(ByteView bytes);
[[nodiscard]] std::string wrong_command(std::uint8_t command, std::string_view due);
[[nodiscard]] std::string wrong_object(Multiplexer got, Multiplexer wanted);

/// Longest upload that is kept; a longer one is cut with 0504 0005h.
inline constexpr std::size_t most_upload_bytes = std::size_t{1} << 20U;
/// From so many bytes on a value takes so long (a second at 50 kbit/s) that it is not read without need.
inline constexpr std::size_t least_long_value = 1024;

}  // namespace conform::canopen
