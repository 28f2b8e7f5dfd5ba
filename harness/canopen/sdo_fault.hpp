// SPDX-License-Identifier: Apache-2.0
// What an SDO client does wrong on purpose, by name: "lose segment 2". docs/writing-scenarios.md has the
// table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "canopen/sdo_client.hpp"

namespace conform::canopen {

struct SdoFault {
  enum class Kind : std::uint8_t {
    lose,
    repeat,
    swap,
    number,
    wrong_toggle,
    acknowledge,
    blksize,
    wrong_crc,
    unused,
    shorten,
    reserved_bits,
    reserved_bytes,
    abort,
    new_initiate,
    silence,
  };
  Kind kind = Kind::lose;
  SdoFrame::Part part = SdoFrame::Part::segment;  ///< which frame; end: "instead of end"
  std::size_t at = 0;                             ///< segment or sub-block, from 1; 0: after the initiate
  std::size_t other = 0;                          ///< the second number of the phrase
  std::string text;                               ///< as it was written

  /// Reads a phrase. Error: what the author wrote is none, with the phrases that begin alike as hint.
  static Result<SdoFault> parse(std::string_view phrase);
  /// Ends or abandons the transfer at its place.
  [[nodiscard]] bool stops() const {
    return kind == Kind::abort || kind == Kind::new_initiate || kind == Kind::silence;
  }
};

/// All phrases with letters in place of numbers, for messages and documents.
[[nodiscard]] std::vector<std::string_view> sdo_fault_phrases();

/// The protocol that the client asks for.
enum class SdoProtocol : std::uint8_t { upload, download, block_upload, block_download };

/// Error (of the scenario) when a transfer of this protocol and so many segments (nullopt: not known
/// before) has no place for it.
[[nodiscard]] Result<void> check_fault(const SdoFault& fault, SdoProtocol protocol,
                                       std::optional<std::size_t> segments);

/// The faults of one transfer, each done once.
class SdoFaultPlan {
 public:
  explicit SdoFaultPlan(std::vector<SdoFault> faults) : faults_(std::move(faults)), done_(faults_.size()) {}
  /// The fault that is due at this place, and then done; nullptr when there is none.
  const SdoFault* take(SdoFault::Kind kind, SdoFrame::Part part, std::size_t at);
  /// The next one that ends the transfer and whose segment is behind us.
  const SdoFault* take_stop(std::size_t settled);
  /// The first that was not done; nullptr when all were.
  [[nodiscard]] const SdoFault* left() const;

 private:
  std::vector<SdoFault> faults_;
  std::vector<bool> done_;
};

}  // namespace conform::canopen
