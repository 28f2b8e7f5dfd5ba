// SPDX-License-Identifier: Apache-2.0
// Files that are whole or not there: atomic replacement on writing, a size limit on reading.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/bytes.hpp"
#include "base/error.hpp"

namespace conform {

/// Replaces `path` by a file with exactly these bytes, or leaves what was there. The bytes go to a new file
/// in the same folder, are flushed to the medium, and the file is renamed. Anything but a regular file at
/// `path` (symbolic link, device, folder) is refused.
[[nodiscard]] Result<void> write_file_atomically(const std::string& path, ByteView bytes);
[[nodiscard]] Result<void> write_file_atomically(const std::string& path, std::string_view text);

/// The whole content of a regular file of at most `limit` bytes. The limit holds while reading, too, so a
/// file that grows or lies about its size cannot exceed it.
[[nodiscard]] Result<std::string> read_file(const std::string& path, std::uint64_t limit);

}  // namespace conform
