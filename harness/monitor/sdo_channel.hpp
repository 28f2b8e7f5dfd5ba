// SPDX-License-Identifier: Apache-2.0
// Follows one SDO channel from what is on the wire, whatever the client does. Where the client leaves the
// protocol the follower does not guess: it accepts everything until plain exchanges have shown again where
// server and client stand (`lose_track`).
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/bytes.hpp"
#include "base/strong.hpp"
#include "base/time.hpp"
#include "can/frame.hpp"
#include "monitor/sdo_answer.hpp"

namespace conform::monitor {

class SdoChannel {
 public:
  using Data = std::array<std::uint8_t, 8>;
  /// Exchanges of one initiate and its answer, nothing else in between, after which the follower knows again.
  /// After silence of both sides, with hardly a request open, one is enough.
  static constexpr int exchanges_to_trust = 3;
  static constexpr Duration silence_to_trust = std::chrono::milliseconds(100);

  /// A frame on the request CAN-ID, whoever sent it.
  void request(const can::Frame& frame, BusTime time);
  /// A data frame of the server on the response CAN-ID.
  [[nodiscard]] SdoAnswer response(const can::Frame& frame, BusTime time);

  /// An expedited transfer that the server has just confirmed; size 0: not indicated.
  struct Value {
    Multiplexer object;
    std::uint32_t value = 0;
    std::uint8_t size = 0;
  };
  [[nodiscard]] std::optional<Value> take_written();  ///< a download
  [[nodiscard]] std::optional<Value> take_read();     ///< an upload

  /// Nothing is known until `exchanges` plain exchanges were seen: frames were lost, the device was reset.
  void lose_track(int exchanges = exchanges_to_trust);
  /// ... because frames were lost: how many answers are still to come is not known either.
  void lose_frames();
  /// An open transfer may have been dropped (NMT state change).
  void transfer_unclear();

 private:
  struct Pending {
    Data data{};
    Asked asked = Asked::other;
    std::uint8_t overtaken = 0;             ///< answers to later requests seen since
    std::optional<Multiplexer> given_up{};  ///< by the client, while this one was on its way
    [[nodiscard]] bool has_multiplexer() const {
      return asked == Asked::download || asked == Asked::upload || asked == Asked::block_upload ||
             asked == Asked::block_download;
    }
  };
  enum class Kind : std::uint8_t { none, unclear, upload, download, block_upload, block_download };
  enum class Stage : std::uint8_t { initiated, segments, complete, end };
  struct Transfer {
    Kind kind = Kind::unclear;
    Multiplexer object;
    std::optional<std::uint32_t> announced;
    std::uint64_t delivered = 0;
    bool toggle = false;   ///< of the next segment
    bool in_order = true;  ///< the client kept the toggle
    Stage stage = Stage::initiated;
    std::uint8_t block_size = 0;
    std::uint8_t sent = 0;  ///< segments of this sub-block
    bool last_sent = false;
    bool crc = false;
    std::uint16_t crc_value = 0;
    bool held = false;           ///< `tail` is filled
    std::uint64_t segments = 0;  ///< acknowledged, of a block upload
    std::array<std::uint8_t, 7>
        tail{};  ///< the last acknowledged segment: how much of it counts tells the end frame
  };

  // Client.
  void note_open(const Data& initiate);
  [[nodiscard]] bool answers_older_one(const can::Frame& frame);
  [[nodiscard]] bool request_without_track(const can::Frame& frame, bool plain, bool after_silence);
  void push(const can::Frame& frame, Asked asked);
  void remove(std::size_t position);
  void client_abort(const can::Frame& frame);
  void client_segment(const can::Frame& frame);
  void block_upload_request(const can::Frame& frame);
  void acknowledge(const can::Frame& frame);
  void block_download_end(const can::Frame& frame);

  // Server.
  void answer_without_track(const can::Frame& frame);
  [[nodiscard]] bool sub_block_again(const can::Frame& frame);
  void stream_segment(const can::Frame& frame, SdoAnswer& out);
  [[nodiscard]] bool answers_abort(const can::Frame& frame, SdoAnswer& out);
  [[nodiscard]] bool time_out_crosses(const can::Frame& frame, SdoAnswer& out);
  void expect_refusal();
  void answer_without_request(const can::Frame& frame, SdoAnswer& out);
  void answer_to(const Pending& pending, const can::Frame& frame, SdoAnswer& out);
  void settle_abort(const Pending& answered, const can::Frame& frame);
  void answer_to_several(const can::Frame& frame, SdoAnswer& out);
  void not_what_was_asked(const can::Frame& frame, SdoAnswer& out);
  void abort_of_server(const Pending& pending, const can::Frame& frame, SdoAnswer& out);
  void upload_answer(Multiplexer wanted, const can::Frame& frame, SdoAnswer& out);
  void upload_segment_answer(const Pending& pending, const can::Frame& frame, SdoAnswer& out);
  void download_segment_answer(const Pending& pending, const can::Frame& frame, SdoAnswer& out);
  void block_end_answer(const can::Frame& frame, SdoAnswer& out);

  static constexpr std::size_t most_pending = 16;
  std::array<Pending, most_pending> pending_{};
  std::size_t count_ = 0;
  int untrusted_ = 1;  // a trace may begin in the middle of an exchange
  static constexpr std::size_t most_unanswered = 2;
  std::optional<BusTime> last_frame_;  ///< of either side
  std::size_t unanswered_ = 0;         ///< without track: requests that may still be answered
  bool fresh_ = false;                 ///< without track: the exchange began after silence
  std::optional<Data> exchange_;       ///< without track: the initiate that waits for its answer
  bool answered_ = false;              ///< ... and has got it
  bool odd_request_ = false;           ///< without track: a request that is no initiate
  std::vector<Data> open_;             ///< without track: the latest initiates that had no answer
  Transfer transfer_;
  std::array<std::array<std::uint8_t, 7>, 127> block_{};  ///< segments of the sub-block under way
  std::uint8_t complete_ = 0;  ///< segments in `block_` that wait for the acknowledge
  std::uint8_t crossed_ = 0;   ///< ... and that may come again behind the client's last frame
  std::optional<Value> written_, read_;
  std::optional<Multiplexer> confirmed_;  ///< object of the block upload that the client's last frame ended
  bool client_abort_ = false, idle_abort_ = false;  ///< the last frame of the client; nothing was open
  std::optional<Multiplexer> aborted_;  ///< named by the client's latest abort, which nothing has answered
  bool aborted_idle_ = false;           ///< ... and nothing was open
  std::optional<Multiplexer> spare_;    ///< about this object one answer more may come
  bool server_abort_ = false;           ///< the last frame of the server, and no request since
};

/// Index and sub-index of bytes 1-3.
[[nodiscard]] Multiplexer multiplexer_of(const can::Frame& frame);

}  // namespace conform::monitor
