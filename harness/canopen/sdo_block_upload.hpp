// SPDX-License-Identifier: Apache-2.0
// Client of an SDO block upload (CiA 301, 7.2.4.2.13 to 7.2.4.2.16).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "canopen/sdo_block.hpp"
#include "canopen/sdo_client.hpp"
#include "canopen/sdo_fault.hpp"
#include "canopen/sdo_transfer.hpp"

namespace conform::canopen {

class SdoBlockUpload final : public SdoClient {
 public:
  struct Options {
    std::uint8_t blksize = most_block_segments;  ///< 0 and above 127 on purpose only
    std::uint8_t pst = 0;  ///< up to so many bytes the server may switch to the normal upload; 0: never
    bool crc = true;       ///< ask for the CRC
    std::size_t max_bytes = most_upload_bytes;
  };
  /// `plan`: what is lost, and what the acknowledges say on purpose; may be nullptr.
  SdoBlockUpload(Multiplexer mux, Options options, std::shared_ptr<SdoFaultPlan> plan = nullptr);

  [[nodiscard]] std::optional<SdoFrame> next(std::size_t unsent) override;
  bool on_frame(ByteView data, std::size_t unsent) override;
  void on_silence() override;
  [[nodiscard]] std::optional<std::size_t> settled() const override;

 private:
  enum class Phase : std::uint8_t { initiate, start, segments, acknowledge, end, confirm };
  void on_initiate(ByteView bytes);
  void on_segment(ByteView bytes);
  void on_end(ByteView bytes);
  void on_early(ByteView bytes);
  void adopt_switched();
  void begin_sub_block();
  [[nodiscard]] bool keep(ByteView data, std::size_t position, bool last);
  [[nodiscard]] SdoFrame acknowledge();

  Multiplexer mux_;
  Options options_;
  std::shared_ptr<SdoFaultPlan> plan_;
  std::unique_ptr<SdoUpload> switched_;
  Phase phase_ = Phase::initiate;
  bool asked_ = false;       ///< our frame of this phase is out
  std::size_t base_ = 0;     ///< segments acknowledged
  std::uint8_t good_ = 0;    ///< last number taken in this sub-block
  std::uint8_t number_ = 0;  ///< last number seen in it
  bool gap_ = false;         ///< a segment of it was lost on purpose: the rest of it is not taken
  bool last_ = false;        ///< the segment that ends the data was taken
  bool stopped_ = false;     ///< the server stopped within it: what still comes is late, not wrong
  std::size_t seen_ = 0;     ///< highest segment seen
  std::uint8_t next_blksize_;
};

}  // namespace conform::canopen
