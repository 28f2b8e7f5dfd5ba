// SPDX-License-Identifier: Apache-2.0
// Whether this build is instrumented by AddressSanitizer, which reserves terabytes of address space for
// itself and has handlers of its own for faults.
#pragma once

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CONFORM_ADDRESS_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define CONFORM_ADDRESS_SANITIZER
#endif

namespace conform {

#if defined(CONFORM_ADDRESS_SANITIZER)
inline constexpr bool address_sanitizer = true;
#else
inline constexpr bool address_sanitizer = false;
#endif

}  // namespace conform
