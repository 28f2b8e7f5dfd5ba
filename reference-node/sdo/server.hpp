// SPDX-License-Identifier: Apache-2.0
// One SDO server (CiA 301, 7.2.4): takes the requests of its channel, begins transfers and hands their frames
// on. Passive: it reacts to frames and time and owns nothing but the state of one transfer.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "device/device.hpp"
#include "sdo/block_download.hpp"
#include "sdo/block_upload.hpp"
#include "sdo/choices.hpp"
#include "sdo/frames.hpp"
#include "sdo/rules.hpp"
#include "sdo/segment_pacer.hpp"
#include "sdo/segmented.hpp"

namespace refnode {

class SdoServer {
 public:
  /// `channel`: 0 is the default server, 1 the one of 1201h and so on.
  SdoServer(Device& device, const SdoChoices& choices, const SdoRules& rules, std::uint8_t channel)
      : device_(&device), choices_(&choices), rules_(&rules), channel_(channel) {}

  /// A data frame on the request CAN-ID, in a state that serves SDO. Responses go to `response_id`.
  void on_request(const Frame& frame, std::uint32_t response_id);
  [[nodiscard]] std::uint8_t channel() const { return channel_; }
  /// Drops a running transfer without a word.
  void reset() { transfer_ = std::monostate{}; }
  /// The running transfer if it is of this kind.
  template <typename Kind>
  [[nodiscard]] const Kind* running() const {
    return std::get_if<Kind>(&transfer_);
  }

  /// Of the running transfer.
  [[nodiscard]] std::optional<Multiplexer> running_mux() const;
  /// A transfer is open.
  [[nodiscard]] bool busy() const { return !std::holds_alternative<std::monostate>(transfer_); }

  void on_time();
  void on_transmitted() { pacer_.on_transmitted(device_->now); }
  /// Sends one segment of a block upload if it is time; false when there is none to send now.
  bool send_segment() { return running<BlockUpload>() != nullptr && send_segment_now(); }
  [[nodiscard]] std::optional<BusTime> next_wakeup() const {
    return busy() ? wakeup_of_transfer() : std::nullopt;
  }

 private:
  using Transfer =
      std::variant<std::monostate, SegmentedUpload, SegmentedDownload, BlockUpload, BlockDownload>;

  [[nodiscard]] SdoReply serve(SdoExchange& exchange);
  [[nodiscard]] SdoReply initiate_upload(SdoExchange& exchange);
  [[nodiscard]] SdoReply upload_response(SdoExchange& exchange, Bytes data);
  [[nodiscard]] SdoReply initiate_download(SdoExchange& exchange);
  [[nodiscard]] SdoReply block_upload(SdoExchange& exchange);
  [[nodiscard]] SdoReply initiate_block_upload(SdoExchange& exchange);
  [[nodiscard]] SdoReply block_download(SdoExchange& exchange);
  [[nodiscard]] SdoReply initiate_block_download(SdoExchange& exchange);
  [[nodiscard]] SdoReply block_segment(SdoExchange& exchange, BlockDownload& transfer);
  /// Ends a transfer that is open, so that a new one can begin; otherwise the reply to the request for it.
  [[nodiscard]] std::optional<SdoReply> make_way();
  /// A request that belongs to no transfer, or to another kind than the one that is running.
  [[nodiscard]] SdoReply out_of_place(SdoExchange& exchange) const;

  bool send_segment_now();
  [[nodiscard]] std::optional<BusTime> wakeup_of_transfer() const;
  [[nodiscard]] bool block_transfer() const {
    return std::holds_alternative<BlockUpload>(transfer_) || std::holds_alternative<BlockDownload>(transfer_);
  }
  [[nodiscard]] bool transfer_finished() const;
  void conclude(SdoExchange& exchange, const SdoReply& reply);
  void send(const SdoExchange& exchange, const std::optional<SdoData>& data, Duration delay);

  Device* device_;
  const SdoChoices* choices_;
  const SdoRules* rules_;
  std::uint8_t channel_;
  std::uint32_t response_id_ = 0;
  Transfer transfer_;
  Multiplexer former_mux_{};  ///< of the latest request that was one
  BusTime active_at_{};       ///< last frame of the running transfer, in either direction
  SegmentPacer pacer_;
};

}  // namespace refnode
