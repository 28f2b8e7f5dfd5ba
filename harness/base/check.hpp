// SPDX-License-Identifier: Apache-2.0
// The third kind of wrong: we are wrong. These assertions stay on in release builds.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace conform::detail {
[[noreturn]] inline void check_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: internal error: '%s' does not hold; please report this\n", file, line,
               condition);
  std::abort();
}
}  // namespace conform::detail

#define CONFORM_CHECK(condition) \
  ((condition) ? static_cast<void>(0) : ::conform::detail::check_failed(#condition, __FILE__, __LINE__))
