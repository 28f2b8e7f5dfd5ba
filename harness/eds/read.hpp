// SPDX-License-Identifier: Apache-2.0
// Reading a device description of whatever kind.
#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "eds/eds.hpp"

namespace conform::eds {

/// Reads EDS, DCF, XDD or XDC; the content decides, not the name. Reading is lenient: what is not as the
/// standard says is in `EdsFile::remarks`. Refused is only what cannot be read at all (nothing in it, neither
/// sections nor XML, no well-formed XML, more than IniFile's limits); the error then has a position.
[[nodiscard]] Result<EdsFile> read(std::string_view bytes, std::string file_name);

/// The same from a file; at most IniFile::most_bytes.
[[nodiscard]] Result<EdsFile> read_file(const std::string& path);

}  // namespace conform::eds
