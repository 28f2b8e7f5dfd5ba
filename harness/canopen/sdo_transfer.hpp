// SPDX-License-Identifier: Apache-2.0
// Client side of one SDO transfer, expedited or segmented, as a passive object: it is handed the server's
// frames and says what to send next or how it ended. No I/O, no clock: a time-out is the caller's (it sends
// encode_abort(timed_out)).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/bytes.hpp"
#include "base/strong.hpp"
#include "canopen/sdo_segment.hpp"

namespace conform::canopen {

struct TransferResult {
  enum class Kind : std::uint8_t {
    confirmed,  ///< complete; `data` holds what was uploaded
    aborted,    ///< the server sent an abort with `code`
    violation,  ///< the server broke the protocol, see `detail`
  };
  Kind kind = Kind::confirmed;
  Bytes data;  ///< upload: what was received, also when the transfer ended badly
  bool expedited = false;
  bool size_indicated = false;  ///< the server told the size (upload)
  std::optional<std::uint32_t>
      announced_size;  ///< size of the initiate response of a segmented upload, or of an expedited one
  AbortCode code{};
  std::string detail;  ///< violation: one precise sentence without full stop
  std::optional<AbortCode>
      reply;  ///< abort that the client should send now, as CiA 301 has it; none when the channel is closed
  std::vector<std::string>
      remarks;  ///< reserved or unused bits and bytes that were not zero; they do not end a transfer
};

/// Next request, or the end.
using TransferStep = std::variant<SdoBytes, TransferResult>;

class SdoUpload {
 public:
  /// `max_bytes` bounds what is kept; a longer object ends as a violation with the reply 0504 0005h.
  explicit SdoUpload(Multiplexer mux, std::size_t max_bytes = std::size_t{1} << 20U);
  [[nodiscard]] SdoBytes first_request() const;
  /// Takes one data frame of the server's channel; must not be called again after a TransferResult.
  [[nodiscard]] TransferStep on_response(ByteView frame_data);
  /// Bytes received so far; after the end they are in the result.
  [[nodiscard]] const Bytes& received() const { return result_.data; }

 private:
  enum class Phase : std::uint8_t { initiate, segment, done };
  [[nodiscard]] TransferStep on_initiate(ByteView bytes);
  [[nodiscard]] TransferStep on_segment(ByteView bytes);
  [[nodiscard]] TransferResult finish(TransferResult::Kind kind);
  [[nodiscard]] TransferResult violation(std::string detail, std::optional<AbortCode> reply);

  Multiplexer mux_;
  std::size_t max_bytes_;
  Phase phase_ = Phase::initiate;
  bool toggle_ = false;
  std::size_t segments_ = 0;
  std::size_t empty_ = 0;  ///< segments without data in a row
  TransferResult result_;
};

class SdoDownload {
 public:
  enum class Mode : std::uint8_t {
    automatic,          ///< expedited with size for 1..4 bytes, else segmented with size
    expedited,          ///< 1..4 bytes with size
    expedited_unsized,  ///< 1..4 bytes without size (22h)
    segmented,          ///< any length, also 0..4 bytes, with size
    segmented_unsized,  ///< without size (20h)
  };
  SdoDownload(Multiplexer mux, Bytes data, Mode mode = Mode::automatic);
  [[nodiscard]] SdoBytes first_request() const;
  [[nodiscard]] TransferStep on_response(ByteView frame_data);

 private:
  enum class Phase : std::uint8_t { initiate, segment, done };
  [[nodiscard]] SdoBytes next_segment();
  [[nodiscard]] TransferResult finish(TransferResult::Kind kind);
  [[nodiscard]] TransferResult violation(std::string detail, std::optional<AbortCode> reply);

  Multiplexer mux_;
  Bytes data_;
  Mode mode_;
  Phase phase_ = Phase::initiate;
  bool toggle_ = false;
  std::size_t sent_ = 0;
  std::size_t segments_ = 0;
  TransferResult result_;
};

}  // namespace conform::canopen
