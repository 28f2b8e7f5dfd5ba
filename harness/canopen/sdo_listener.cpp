// SPDX-License-Identifier: Apache-2.0
#include "canopen/sdo_listener.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/data_type.hpp"
#include "canopen/sdo_initiate.hpp"
#include "canopen/sdo_segment.hpp"

namespace conform::canopen {
namespace {

std::string count_of(std::size_t bytes) { return fmt::format("{} byte{}", bytes, bytes == 1 ? "" : "s"); }

/// " = E8 03 (2 bytes)", ", segmented, 12 bytes" and the like.
std::string content(const Initiate& initiate, ByteView bytes) {
  if (initiate.expedited) {
    if (!initiate.size_indicated) return fmt::format(" = {} (size not told)", hex_bytes(bytes.subspan(4)));
    return fmt::format(" = {}", print_untyped(bytes.subspan(4, initiate.expedited_size())));
  }
  return initiate.size_indicated ? fmt::format(", segmented, {}", count_of(initiate.value))
                                 : ", segmented, size not told";
}

std::string segment_text(const Segment& segment) {
  return fmt::format(", toggle {}, {}{}", segment.toggle ? 1 : 0, count_of(segment.size()),
                     segment.last ? ", last" : "");
}

/// Size in bytes 4-7 of a block initiate.
std::string block_size_text(ByteView bytes) {
  return (bytes[0] & 0x02U) != 0 ? fmt::format(", {}", count_of(load_le(bytes.subspan(4, 4))))
                                 : ", size not told";
}

std::string unknown(std::string_view direction, ByteView bytes) {
  return fmt::format("SDO {} with unknown command {}", direction, hex(bytes[0], 2));
}

}  // namespace

std::string SdoListener::object() const {
  return open_ ? fmt::format(" {}", to_string(*open_)) : std::string();
}

std::string SdoListener::abort(ByteView bytes) {
  const auto found = decode_abort(bytes);
  open_.reset();
  phase_ = Phase::other;
  return fmt::format("SDO abort {}: {}", to_string(found->mux), describe(found->code));
}

std::string SdoListener::block_segment(ByteView bytes) {
  last_number_ = bytes[0] & 0x7FU;
  last_seen_ = (bytes[0] & 0x80U) != 0;
  return fmt::format("SDO block segment {}{}{}", last_number_, object(), last_seen_ ? ", last" : "");
}

std::string SdoListener::request(ByteView bytes) {
  if (bytes.size() < 8) return fmt::format("SDO request of {} instead of 8", count_of(bytes.size()));
  if (bytes[0] == 0x80) return abort(bytes);
  if (phase_ == Phase::block_download) return block_segment(bytes);
  switch (bytes[0] >> 5U) {
    case 0: {
      const auto segment = decode_segment(bytes);
      return fmt::format("SDO download segment{}{}", object(), segment_text(*segment));
    }
    case 1: {
      const auto initiate = decode_download_request(bytes);
      open_ = initiate->mux;
      return fmt::format("SDO download request{}{}", object(), content(*initiate, bytes));
    }
    case 2: open_ = sdo_multiplexer(bytes); return fmt::format("SDO upload request{}", object());
    case 3:
      return fmt::format("SDO upload segment request{}, toggle {}", object(),
                         (bytes[0] & 0x10U) != 0 ? 1 : 0);
    case 4: return abort(bytes);
    case 5: return block_request_of_upload(bytes);
    case 6: return block_request_of_download(bytes);
    default: return unknown("request", bytes);
  }
}

std::string SdoListener::response(ByteView bytes) {
  if (bytes.size() < 8) return fmt::format("SDO response of {} instead of 8", count_of(bytes.size()));
  if (bytes[0] == 0x80) return abort(bytes);
  if (phase_ == Phase::block_upload) return block_segment(bytes);
  switch (bytes[0] >> 5U) {
    case 0: {
      const auto segment = decode_segment(bytes);
      const std::string text = fmt::format("SDO upload segment{}{}", object(), segment_text(*segment));
      if (segment->last) open_.reset();
      return text;
    }
    case 1:
      return fmt::format("SDO download segment response{}, toggle {}", object(),
                         (bytes[0] & 0x10U) != 0 ? 1 : 0);
    case 2: {
      const auto initiate = decode_upload_response(bytes);
      open_ = initiate->mux;
      const std::string text = fmt::format("SDO upload response{}{}", object(), content(*initiate, bytes));
      if (initiate->expedited) open_.reset();
      return text;
    }
    case 3:
      // The multiplexer as the server says it; a segmented download stays open, so it is kept.
      return fmt::format("SDO download response {}", to_string(sdo_multiplexer(bytes)));
    case 4: return abort(bytes);
    case 5: return block_response_of_download(bytes);
    case 6: return block_response_of_upload(bytes);
    default: return unknown("response", bytes);
  }
}

// Client commands of a block upload: A0 initiate (bit 2: CRC), A1 end, A2 acknowledge, A3 start.
std::string SdoListener::block_request_of_upload(ByteView bytes) {
  switch (bytes[0] & 0x03U) {
    case 0:
      open_ = sdo_multiplexer(bytes);
      return fmt::format("SDO block upload request{}, {} segments per block", object(), bytes[4]);
    case 1: {
      const std::string text = fmt::format("SDO block upload end confirmed{}", object());
      open_.reset();
      return text;
    }
    case 2:
      // The last segment acknowledged ends the data; anything less makes the server go on after the
      // acknowledged one.
      phase_ = last_seen_ && bytes[1] == last_number_ ? Phase::other : Phase::block_upload;
      last_seen_ = false;
      return fmt::format("SDO block upload{}: segments up to {} received, {} in the next block", object(),
                         bytes[1], bytes[2]);
    default:
      phase_ = Phase::block_upload;
      last_seen_ = false;
      return fmt::format("SDO block upload start{}", object());
  }
}

// Server commands of a block upload: C0 initiate (bit 2: CRC, bit 1: size), C1 | n<<2 end with CRC in bytes
// 1-2.
std::string SdoListener::block_response_of_upload(ByteView bytes) {
  if ((bytes[0] & 0x01U) != 0) {
    return fmt::format("SDO block upload end{}, {} unused in the last segment", object(),
                       count_of(bytes[0] >> 2U & 0x07U));
  }
  open_ = sdo_multiplexer(bytes);
  return fmt::format("SDO block upload response{}{}", object(), block_size_text(bytes));
}

// Client commands of a block download: C0 initiate (bit 2: CRC, bit 1: size), C1 | n<<2 end with CRC in bytes
// 1-2.
std::string SdoListener::block_request_of_download(ByteView bytes) {
  if ((bytes[0] & 0x01U) != 0) {
    return fmt::format("SDO block download end{}, {} unused in the last segment", object(),
                       count_of(bytes[0] >> 2U & 0x07U));
  }
  open_ = sdo_multiplexer(bytes);
  return fmt::format("SDO block download request{}{}", object(), block_size_text(bytes));
}

// Server commands of a block download: A0 initiate (bit 2: CRC), A1 end, A2 acknowledge.
std::string SdoListener::block_response_of_download(ByteView bytes) {
  switch (bytes[0] & 0x03U) {
    case 0:
      open_ = sdo_multiplexer(bytes);
      phase_ = Phase::block_download;
      last_seen_ = false;
      return fmt::format("SDO block download response{}, {} segments per block", object(), bytes[4]);
    case 1: {
      const std::string text = fmt::format("SDO block download end confirmed{}", object());
      open_.reset();
      return text;
    }
    case 2:
      phase_ = last_seen_ && bytes[1] == last_number_ ? Phase::other : Phase::block_download;
      last_seen_ = false;
      return fmt::format("SDO block download{}: segments up to {} received, {} in the next block", object(),
                         bytes[1], bytes[2]);
    default: return unknown("response", bytes);
  }
}

}  // namespace conform::canopen
