// SPDX-License-Identifier: Apache-2.0
// Upload and download, expedited or by segments (CiA 301, 7.2.4.2.2 to 7.2.4.2.8): one request, one answer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "canopen/sdo_client.hpp"
#include "canopen/sdo_segment.hpp"

namespace conform::canopen {

class SdoUpload final : public SdoClient {
 public:
  /// `max_bytes` bounds what is kept; a longer object ends as a violation with the reply 0504 0005h.
  /// `enough`: after so many bytes of a value that is told to be long, the client gives up by an abort.
  explicit SdoUpload(Multiplexer mux, std::size_t max_bytes = most_upload_bytes,
                     std::optional<std::size_t> enough = std::nullopt);
  [[nodiscard]] std::optional<SdoFrame> next(std::size_t unsent) override;
  bool on_frame(ByteView data, std::size_t unsent) override;
  void on_silence() override { give_up_waiting(); }
  [[nodiscard]] std::optional<std::size_t> settled() const override;
  /// Begins behind a request that another client has sent (a block upload whose server switched).
  void take_over() { asked_ = true; }

 private:
  void on_initiate(ByteView bytes);
  void on_segment(ByteView bytes);

  Multiplexer mux_;
  std::size_t max_bytes_;
  std::optional<std::size_t> enough_;
  bool initiated_ = false;
  bool asked_ = false;  ///< the request is out, the server is to act
  bool toggle_ = false;
  std::size_t empty_ = 0;  ///< segments without data in a row
};

class SdoDownload final : public SdoClient {
 public:
  enum class Mode : std::uint8_t {
    automatic,          ///< expedited with size for 1..4 bytes, else segmented with size
    expedited,          ///< 1..4 bytes with size
    expedited_unsized,  ///< 1..4 bytes without size (22h)
    segmented,          ///< any length, also 0..4 bytes, with size
    segmented_unsized,  ///< without size (20h)
  };
  /// `announced`: size to tell in place of the true one (segmented with size).
  SdoDownload(Multiplexer mux, Bytes data, Mode mode = Mode::automatic,
              std::optional<std::uint32_t> announced = std::nullopt);
  [[nodiscard]] std::optional<SdoFrame> next(std::size_t unsent) override;
  bool on_frame(ByteView data, std::size_t unsent) override;
  void on_silence() override { give_up_waiting(); }
  [[nodiscard]] std::optional<std::size_t> settled() const override;

 private:
  [[nodiscard]] SdoFrame initiate() const;
  [[nodiscard]] SdoFrame segment();

  Multiplexer mux_;
  Bytes data_;
  Mode mode_;
  std::optional<std::uint32_t> announced_;
  bool initiated_ = false;
  bool asked_ = false;
  bool toggle_ = false;
  std::size_t sent_ = 0;
  std::size_t answered_ = 0;
};

}  // namespace conform::canopen
