// SPDX-License-Identifier: Apache-2.0
// What a service tells of errors it has found. The error register, the EMCY and the history are made of it
// elsewhere (emergency/); a service needs to know no more than this.
#pragma once

#include <cstdint>

#include "rules/rule.hpp"

namespace refnode {

/// Which service has found an error; first byte of what an EMCY and the history say beside the code.
enum class ErrorSource : std::uint8_t { application, heartbeat, rpdo, sync, guarding };

/// What is wrong, by whom it was found, and which one of several alike.
struct ErrorCause {
  std::uint16_t code = 0;  ///< CiA 301, table 26
  ErrorSource source = ErrorSource::application;
  std::uint16_t instance = 0;
  friend bool operator==(const ErrorCause&, const ErrorCause&) = default;
};

/// The errors of the device: whoever detects one says when it is there and when it is gone.
struct Errors {
  /// Nothing happens when the cause is there already. `detail`: one byte for the maker.
  Rule<void(const ErrorCause&, std::uint8_t detail)> raise{[](const ErrorCause&, std::uint8_t) {}};
  Rule<void(const ErrorCause&)> clear{[](const ErrorCause&) {}};
};

}  // namespace refnode
