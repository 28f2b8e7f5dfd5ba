// SPDX-License-Identifier: Apache-2.0
// The parser's few words about broken syntax, turned into what the author can act on.
#pragma once

#include <cstddef>
#include <string_view>

#include "yaml/diagnostic.hpp"

namespace conform::yaml {

struct SyntaxError {
  std::string_view message;     ///< as yaml-cpp words it
  std::size_t offset = 0;       ///< where it gave up
  std::size_t last_offset = 0;  ///< the last value it understood
  int long_quote_line = 0;  ///< the last quoted text began there and ended on a later line; 0 when it did not
};

void report_syntax_error(const SyntaxError& error, const Source& source, Diagnostics& diagnostics);

}  // namespace conform::yaml
