// SPDX-License-Identifier: Apache-2.0
// The pre-defined error field 1003h (CiA 301, 7.5.2.4): the errors that an EMCY was due for, newest first.
#pragma once

#include <cstdint>
#include <deque>

#include "device/device.hpp"

namespace refnode {

/// Codes and freedoms of 1003h.
struct HistoryChoices {
  std::uint8_t depth = 8;                            ///< at most as many as 1003h has fields
  AbortCode nothing_recorded = abort_code::no_data;  ///< of sub-index 01h
  AbortCode unused_field = abort_code::no_data;      ///< from sub-index 02h on
};

class ErrorHistory {
 public:
  static constexpr std::uint8_t fields = 8;

  explicit ErrorHistory(Device& device) : device_(&device) {}

  HistoryChoices choices;

  /// 1003h
  void add_objects();
  /// Puts the service behind the entries of 1003h there are.
  void bind();

  /// `detail` and `source` are the upper half of a field, the manufacturer's.
  void record(std::uint16_t code, ErrorSource source, std::uint8_t detail);
  /// The upper half follows by `complete`, which finds the oldest of the code that lacks it.
  void record_incomplete(std::uint16_t code);
  void complete(std::uint16_t code, ErrorSource source, std::uint8_t detail);
  void clear() { errors_.clear(); }
  /// Sub-index 00h.
  [[nodiscard]] std::uint8_t recorded() const;
  [[nodiscard]] Upload read(std::uint8_t sub) const;
  /// Only 00h can be written to sub-index 00h: it clears the history.
  [[nodiscard]] Accepted write_count(ByteView bytes);

 private:
  Device* device_;
  std::deque<std::uint32_t> errors_;  ///< newest first
};

}  // namespace refnode
