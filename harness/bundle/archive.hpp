// SPDX-License-Identifier: Apache-2.0
// Tar in zstd, by libarchive: only what a bundle needs of it, with a limit on what is unpacked.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/bytes.hpp"
#include "base/error.hpp"

namespace conform::bundle {

/// The same files give the same bytes: no owner, fixed rights, and one time for all.
class Packer {
 public:
  /// `time`: seconds since 1970 that every file gets.
  explicit Packer(std::int64_t time);
  [[nodiscard]] Result<void> add(std::string_view name, ByteView content);
  /// All of the archive; nothing may be added afterwards.
  [[nodiscard]] Result<Bytes> finish();

 private:
  struct Archive;
  struct Free {
    void operator()(Archive* archive) const;
  };
  std::unique_ptr<Archive, Free> archive_;
  std::int64_t time_;
};

/// Reads from an open file, in its order, and never more than it is allowed to.
class Unpacker {
 public:
  /// `descriptor` stays the caller's and stands at the first byte.
  explicit Unpacker(int descriptor);

  /// Bytes of tar that may come out of the archive from its beginning on, headers and padding included.
  void allow(std::uint64_t bytes);

  struct Entry {
    std::string name;      ///< as it stands there: not to be trusted; empty: none that can be read
    bool regular = false;  ///< an ordinary file: no link, device, folder, nor one with holes
    std::uint64_t size = 0;
  };
  /// The next entry, whatever it is, or none at the end. Error: the archive is damaged, or larger than
  /// allowed.
  [[nodiscard]] Result<std::optional<Entry>> next();
  /// More of the content of the entry; 0 at its end.
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into);

 private:
  struct Archive;
  struct Free {
    void operator()(Archive* archive) const;
  };
  std::unique_ptr<Archive, Free> archive_;
};

}  // namespace conform::bundle
