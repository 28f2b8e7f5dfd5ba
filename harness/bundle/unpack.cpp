// SPDX-License-Identifier: Apache-2.0
#include <archive.h>
#include <archive_entry.h>

#include <array>
#include <cerrno>

#include "base/check.hpp"
#include "bundle/archive.hpp"

namespace conform::bundle {
namespace {

constexpr std::size_t block = std::size_t{64} * 1024;

std::string reason(archive* reader) {
  const char* why = archive_error_string(reader);
  return why == nullptr ? "no reason is known" : why;
}

}  // namespace

/// Two readers, one behind the other: what the first unpacks the second reads as tar. So every byte is
/// counted that comes out of the compression, wherever in the tar it belongs; between two files there may be
/// terabytes of zeros.
struct Unpacker::Archive {
  archive* packed = archive_read_new();
  archive* tar = archive_read_new();
  bool begun = false;
  std::uint64_t came = 0;
  std::uint64_t allowed = 0;
  bool too_much = false;
  std::array<std::uint8_t, block> buffer{};

  [[nodiscard]] std::unexpected<Error> failed() const {
    if (too_much) return fail("more comes out of it than may");
    return fail("the archive is damaged: " + reason(tar));
  }

  static la_ssize_t give(archive* reader, void* self, const void** bytes) {
    auto& mine = *static_cast<Archive*>(self);
    const auto count = archive_read_data(mine.packed, mine.buffer.data(), mine.buffer.size());
    if (count < 0) {
      archive_set_error(reader, archive_errno(mine.packed), "%s", reason(mine.packed).c_str());
      return -1;
    }
    mine.came += static_cast<std::uint64_t>(count);
    if (mine.came > mine.allowed) {
      mine.too_much = true;
      archive_set_error(reader, EFBIG, "too much");
      return -1;
    }
    *bytes = mine.buffer.data();
    return count;
  }

  /// Not in the constructor: an archive may be damaged from its first byte on.
  [[nodiscard]] Result<void> begin() {
    if (begun) return {};
    begun = true;
    archive_entry* whole = nullptr;
    if (archive_read_next_header(packed, &whole) != ARCHIVE_OK)
      return fail("the archive is damaged: " + reason(packed));
    if (archive_read_open(tar, this, nullptr, give, nullptr) != ARCHIVE_OK) return failed();
    return {};
  }
};

void Unpacker::Free::operator()(Archive* archive) const {
  archive_read_free(archive->tar);
  archive_read_free(archive->packed);
  delete archive;
}

Unpacker::Unpacker(int descriptor) : archive_(new Archive) {
  auto* const packed = archive_->packed;
  auto* const tar = archive_->tar;
  CONFORM_CHECK(packed != nullptr && tar != nullptr);
  // This filter exactly: asked to find out itself, the library would unpack what is packed 25 times.
  CONFORM_CHECK(archive_read_append_filter(packed, ARCHIVE_FILTER_ZSTD) == ARCHIVE_OK);
  CONFORM_CHECK(archive_read_support_format_raw(packed) == ARCHIVE_OK);
  CONFORM_CHECK(archive_read_support_format_tar(tar) == ARCHIVE_OK);
  // What is hidden behind the end is found as well: `tar --ignore-zeros` would unpack it.
  CONFORM_CHECK(archive_read_set_options(tar, "tar:read_concatenated_archives") == ARCHIVE_OK);
  // Where it cannot be read at all the first header says so.
  static_cast<void>(archive_read_open_fd(packed, descriptor, block));
}

void Unpacker::allow(std::uint64_t bytes) { archive_->allowed = bytes; }

Result<std::optional<Unpacker::Entry>> Unpacker::next() {
  if (auto begun = archive_->begin(); !begun) return std::unexpected(begun.error());
  archive_entry* entry = nullptr;
  const int code = archive_read_next_header(archive_->tar, &entry);
  if (code == ARCHIVE_EOF) return std::nullopt;
  // A warning is about a name that no locale can show, or a time: what is asked for below tells.
  if (code != ARCHIVE_OK && code != ARCHIVE_WARN) return archive_->failed();
  Entry out;
  const char* name = archive_entry_pathname(entry);
  if (name != nullptr) out.name = name;
  out.regular = archive_entry_filetype(entry) == AE_IFREG && archive_entry_hardlink(entry) == nullptr &&
                archive_entry_symlink(entry) == nullptr && archive_entry_sparse_count(entry) == 0 &&
                archive_entry_size_is_set(entry) != 0;
  const auto size = archive_entry_size(entry);
  out.size = size < 0 ? 0 : static_cast<std::uint64_t>(size);
  return out;
}

Result<std::size_t> Unpacker::read(std::span<std::uint8_t> into) {
  const auto count = archive_read_data(archive_->tar, into.data(), into.size());
  if (count < 0) return archive_->failed();
  return static_cast<std::size_t>(count);
}

}  // namespace conform::bundle
