// SPDX-License-Identifier: Apache-2.0
// What the server decides in a block transfer (CiA 301, 7.2.4.3.8 to 7.2.4.3.17).
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>

#include "dictionary/object_dictionary.hpp"
#include "rules/rule.hpp"

namespace refnode {

/// Segments per sub-block: their numbers have seven bits and begin with 1.
[[nodiscard]] constexpr bool valid_block_size(std::uint8_t size) { return size >= 1 && size <= 127; }

/// What the initiate of a block download has settled.
struct BlockDownloadTerms {
  Multiplexer mux;
  std::optional<std::size_t> announced;  ///< length of the data, if the client told it
  std::size_t capacity = 0;              ///< longest value that the entry takes
  std::uint8_t block_size = 127;         ///< of the first sub-block
  bool crc = false;                      ///< both sides can

  [[nodiscard]] std::size_t limit() const { return announced.value_or(capacity); }
};

struct BlockDownloadRules {
  explicit BlockDownloadRules(ObjectDictionary& dictionary);

  /// Whether a download of so many bytes, if that was told, can begin.
  Rule<Accepted(Multiplexer, std::optional<std::size_t> size)> may_begin;
  /// A segment is taken behind the one taken last in its sub-block (0: none yet).
  Rule<bool(std::uint8_t number, std::uint8_t last)> follows;
  /// So many bytes can have come while segments still come. A transfer that brings more is aborted at once.
  Rule<bool(std::size_t size, const BlockDownloadTerms&)> fits;
  /// The CRC is looked at when both sides can.
  Rule<bool(bool agreed)> crc_checked;
  /// The CRC is that of the data; what the last segment holds behind them does not count.
  Rule<std::uint16_t(ByteView segments, std::size_t size)> crc;
  /// The data are as long as announced, and no longer than the entry.
  Rule<std::expected<Bytes, AbortCode>(Bytes data, const BlockDownloadTerms&)> value;
  /// The entry takes the value, or refuses it.
  Rule<Accepted(Multiplexer, ByteView value)> store;
};

struct BlockUploadRules {
  BlockUploadRules();

  /// Protocol switch threshold: data of up to so many bytes may be sent by a normal upload, with 0 none.
  Rule<bool(std::size_t size, std::uint8_t threshold)> may_switch;
};

}  // namespace refnode
