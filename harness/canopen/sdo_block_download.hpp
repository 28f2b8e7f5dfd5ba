// SPDX-License-Identifier: Apache-2.0
// Client of an SDO block download (CiA 301, 7.2.4.2.9 to 7.2.4.2.12): sub-blocks as long as the server allows
// in its latest answer, and whatever it does not acknowledge once more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "canopen/sdo_block.hpp"
#include "canopen/sdo_client.hpp"

namespace conform::canopen {

class SdoBlockDownload final : public SdoClient {
 public:
  struct Options {
    bool crc = true;                                        ///< ask for the CRC
    bool size_told = true;                                  ///< announce a size
    std::optional<std::uint32_t> announced = std::nullopt;  ///< another one than the true size
  };
  SdoBlockDownload(Multiplexer mux, Bytes data, Options options);

  [[nodiscard]] std::optional<SdoFrame> next(std::size_t unsent) override;
  bool on_frame(ByteView data, std::size_t unsent) override;
  void on_silence() override { give_up_waiting(); }
  [[nodiscard]] std::optional<std::size_t> settled() const override;
  /// Segments that the data make; at least one, also of no bytes.
  [[nodiscard]] static std::size_t segments_of(std::size_t bytes);

 private:
  enum class Phase : std::uint8_t { initiate, segments, end };
  void on_initiate(ByteView bytes);
  void on_acknowledge(ByteView bytes, std::size_t on_the_bus);
  void on_end(ByteView bytes);
  void begin_sub_block(std::uint8_t blksize);
  [[nodiscard]] SdoFrame segment();

  Multiplexer mux_;
  Bytes data_;
  Options options_;
  std::size_t total_;
  Phase phase_ = Phase::initiate;
  bool asked_ = false;        ///< initiate request or end frame is out
  bool draining_ = false;     ///< acknowledged in the middle: what is still on its way comes first
  std::size_t base_ = 0;      ///< segments acknowledged before this sub-block
  std::size_t in_block_ = 0;  ///< segments of this sub-block handed over
  std::size_t block_ = 0;     ///< its length
  std::size_t highest_ = 0;   ///< segments handed over at least once
  std::size_t stalled_ = 0;   ///< acknowledges of nothing, one after the other
};

}  // namespace conform::canopen
