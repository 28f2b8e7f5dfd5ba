// SPDX-License-Identifier: Apache-2.0
// By what a report says which file it is about, whatever the file was called.
#pragma once

#include <string>
#include <string_view>

namespace conform {

/// SHA-256 (FIPS 180-4) as 64 lower-case hexadecimal digits, as sha256sum prints it.
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace conform
