// SPDX-License-Identifier: Apache-2.0
// What the tables of block transfer defects ask of an exchange, and what they remember of a running transfer.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "defects/hooks.hpp"
#include "defects/sdo_exchanges.hpp"
#include "defects/sdo_rules.hpp"
#include "defects/tools.hpp"

namespace refnode::defect {

using Frames = std::vector<Outgoing>;

inline bool block_upload_initiated(const SdoExchange& e) {
  return e.step == SdoStep::block_upload_initiate && !e.aborted;
}
inline bool block_download_initiated(const SdoExchange& e) {
  return e.step == SdoStep::block_download_initiate && !e.aborted;
}
/// One segment on its way to the client, not the request that led to it.
inline bool is_upload_segment(const SdoExchange& e, const Frames& frames) {
  return e.step == SdoStep::block_upload_segment && !e.aborted && !frames.empty();
}
inline bool is_upload_end(const SdoExchange& e, const Frames& frames) {
  return e.step == SdoStep::block_upload_end && !e.aborted && !frames.empty();
}
inline bool is_end_confirmation(const SdoExchange& e, const Frames& frames) {
  return e.step == SdoStep::block_upload_end && !e.aborted && frames.empty();
}
/// A2h: byte 1 ackseq, byte 2 block size from here on.
inline bool is_acknowledge_of_client(const SdoExchange& e, const Frames& frames) {
  return e.request[0] == 0xA2 && !is_upload_segment(e, frames);
}
inline bool is_client_abort(const SdoExchange& e) { return e.step == SdoStep::other && e.request[0] == 0x80; }

/// A filter with a memory of its own: `change` looks at SDO exchanges and changes the frames.
template <typename Change>
[[nodiscard]] Filter on_exchange(Change change) {
  return [change](const FilterContext& context, Frames& frames) mutable {
    if (context.sdo != nullptr) change(*context.sdo, frames);
  };
}

/// The response frame with other data; for a request that has no response, on the default channel's CAN-ID.
inline Outgoing response(const FilterContext& context, const Data& data) {
  return {conform::can::data_frame(conform::CanId(0x580U + context.node_id), data), {}};
}

inline void answer_with_abort(Frames& frames, const SdoExchange& e, std::uint32_t code) {
  for (Outgoing& outgoing : frames) {
    Data& data = outgoing.frame.data;
    data = {0x80, e.request[1], e.request[2], e.request[3]};
    conform::store_le(std::span(data).subspan(4), code);
  }
}

/// Whether a block transfer is running, seen from outside.
struct BlockWatch {
  enum class Running : std::uint8_t { nothing, upload, download };
  Running running = Running::nothing;

  void see(const SdoExchange& e, const Frames& frames) {
    if (e.aborted || is_client_abort(e) || e.step == SdoStep::time_out) {
      running = Running::nothing;
    } else if (begins_transfer(e)) {
      running = e.step == SdoStep::block_upload_initiate     ? Running::upload
                : e.step == SdoStep::block_download_initiate ? Running::download
                                                             : Running::nothing;
    } else if (is_end_confirmation(e, frames) || e.step == SdoStep::block_download_end) {
      running = Running::nothing;
    }
  }
};

inline BlockUploadRules& of_block_upload(Parts& parts) { return parts.sdo.rules.block_upload; }
inline BlockDownloadRules& of_block_download(Parts& parts) { return parts.sdo.rules.block_download; }

/// The server that a frame is a request to, nullptr if to none.
[[nodiscard]] inline const SdoServer* server_asked(const Parts& parts, const Frame& frame) {
  const bool request = is_base_data_frame(frame) && frame.size() == 8;
  return request ? parts.sdo.server_of(frame) : nullptr;
}
/// The running transfer of this kind that a request is about, nullptr if there is none.
template <typename Kind>
[[nodiscard]] const Kind* transfer_of(const Parts& parts, const Frame& frame) {
  const SdoServer* server = server_asked(parts, frame);
  return server == nullptr ? nullptr : server->running<Kind>();
}
/// A block download that this frame is a segment of.
[[nodiscard]] inline const BlockDownload* receiving(const Parts& parts, const Frame& frame) {
  const auto* transfer = transfer_of<BlockDownload>(parts, frame);
  return transfer != nullptr && transfer->in_sub_block() && frame.data[0] != 0x80 ? transfer : nullptr;
}

/// 80h, which ends whatever transfer is running.
[[nodiscard]] inline bool is_abort_request(const Parts& parts, const Frame& frame) {
  return (frame.data[0] >> 5U) == 4 && receiving(parts, frame) == nullptr;
}

/// The bytes of a block upload as the client puts them together.
struct UploadWatch {
  bool crc_agreed = false;
  std::vector<std::uint8_t> data;  ///< acknowledged segments, and those sent since
  std::vector<std::uint8_t> sent;  ///< everything, repeated segments once more
  std::size_t acknowledged = 0;    ///< bytes

  void see(const SdoExchange& e, const Frames& frames) {
    if (block_upload_initiated(e) && !frames.empty()) {
      crc_agreed = (e.request[0] & frames.front().frame.data[0] & 0x04U) != 0;
      data.clear();
      sent.clear();
      acknowledged = 0;
    } else if (is_upload_segment(e, frames)) {
      const Data& segment = frames.front().frame.data;
      data.insert(data.end(), segment.begin() + 1, segment.end());
      sent.insert(sent.end(), segment.begin() + 1, segment.end());
    } else if (is_acknowledge_of_client(e, frames)) {
      acknowledged = std::min(data.size(), acknowledged + e.request[1] * std::size_t{7});
      data.resize(acknowledged);
    }
  }
};

constexpr std::uint16_t ccitt = 0x1021;  ///< the polynomial of block transfer

/// CRC-16, most significant bit first.
[[nodiscard]] inline std::uint16_t crc16(std::span<const std::uint8_t> bytes, std::uint16_t polynomial,
                                         std::uint16_t start) {
  std::uint16_t crc = start;
  for (const std::uint8_t byte : bytes) {
    crc = static_cast<std::uint16_t>(crc ^ (byte << 8U));
    for (int bit = 0; bit < 8; ++bit) {
      const bool high = (crc & 0x8000U) != 0;
      crc = static_cast<std::uint16_t>(crc << 1U);
      if (high) crc = static_cast<std::uint16_t>(crc ^ polynomial);
    }
  }
  return crc;
}

}  // namespace refnode::defect
