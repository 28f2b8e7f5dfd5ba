// SPDX-License-Identifier: Apache-2.0
// A client that keeps to the protocol but for its faults: it stands between a legal client and the bus and
// changes, leaves out, repeats or cuts off what the legal one wants to send.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>

#include "canopen/sdo_client.hpp"
#include "canopen/sdo_fault.hpp"

namespace conform::canopen {

class SdoFaultyClient final : public SdoClient {
 public:
  SdoFaultyClient(std::unique_ptr<SdoClient> legal, std::shared_ptr<SdoFaultPlan> plan, Multiplexer object,
                  SdoProtocol protocol);
  [[nodiscard]] std::optional<SdoFrame> next(std::size_t unsent) override;
  bool on_frame(ByteView data, std::size_t unsent) override;
  void on_silence() override;
  [[nodiscard]] std::optional<std::size_t> settled() const override { return legal_->settled(); }
  [[nodiscard]] bool fell_silent() const override { return state_ == State::silent; }

 private:
  enum class State : std::uint8_t {
    running,
    repeating,  ///< a segment was sent again that had been answered: what comes answers the repetition
    leaving,    ///< the abort goes out
    silent,
    elsewhere,  ///< a new transfer was begun in the middle of this one
  };
  /// Does what is due before the legal client may go on. True: `out` is what to send instead.
  [[nodiscard]] bool intervene(std::optional<SdoFrame>& out);
  void stop(const SdoFault& fault);
  void change(SdoFrame& frame);
  /// Puts the frame into the queue, or not, or twice, or behind later ones.
  void hand_over(SdoFrame frame, std::size_t unsent);
  void set_reserved(SdoFrame& frame, bool bytes) const;
  void adopt(SdoClient& client);
  void on_stray(ByteView data);
  [[nodiscard]] bool by_block() const {
    return protocol_ == SdoProtocol::block_upload || protocol_ == SdoProtocol::block_download;
  }

  std::unique_ptr<SdoClient> legal_;
  std::shared_ptr<SdoFaultPlan> plan_;
  Multiplexer object_;
  SdoProtocol protocol_;
  State state_ = State::running;
  std::deque<SdoFrame> queue_;
  std::unique_ptr<SdoClient> second_;  ///< the new transfer
  Multiplexer second_object_;
  bool second_begun_ = false;                ///< its initiate request has been answered
  std::optional<AbortCode> abort_of_first_;  ///< the server aborted the old transfer meanwhile
  std::optional<SdoFrame> latest_;           ///< segment sent last, of a segmented transfer
  bool toggle_inverted_ = false;             ///< in it
  bool end_withheld_ = false;                ///< its mark as the last one was left out
  std::string misplaced_;
  std::uint64_t surplus_ = 0, answers_ = 0;
};

}  // namespace conform::canopen
