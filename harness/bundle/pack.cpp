// SPDX-License-Identifier: Apache-2.0
#include <archive.h>
#include <archive_entry.h>

#include "base/check.hpp"
#include "bundle/archive.hpp"

namespace conform::bundle {
namespace {

using Entry = std::unique_ptr<archive_entry, decltype(&archive_entry_free)>;

la_ssize_t append(archive* /*writer*/, void* out, const void* bytes, std::size_t size) {
  const auto* first = static_cast<const std::uint8_t*>(bytes);
  auto& whole = *static_cast<Bytes*>(out);
  whole.insert(whole.end(), first, first + size);
  return static_cast<la_ssize_t>(size);
}

}  // namespace

struct Packer::Archive {
  archive* writer = archive_write_new();
  Bytes out;

  [[nodiscard]] std::unexpected<Error> failed() const {
    const char* why = archive_error_string(writer);
    return fail(std::string("cannot pack: ") + (why == nullptr ? "no reason is known" : why));
  }
};

void Packer::Free::operator()(Archive* archive) const {
  archive_write_free(archive->writer);
  delete archive;
}

Packer::Packer(std::int64_t time) : archive_(new Archive), time_(time) {
  auto* const writer = archive_->writer;
  CONFORM_CHECK(writer != nullptr && archive_write_set_format_pax_restricted(writer) == ARCHIVE_OK);
  CONFORM_CHECK(archive_write_add_filter_zstd(writer) == ARCHIVE_OK);
  CONFORM_CHECK(archive_write_set_options(writer, "zstd:compression-level=9") == ARCHIVE_OK);
  // Nothing behind what is packed, where it would be covered by no digest.
  CONFORM_CHECK(archive_write_set_bytes_in_last_block(writer, 1) == ARCHIVE_OK);
  CONFORM_CHECK(archive_write_open(writer, &archive_->out, nullptr, append, nullptr) == ARCHIVE_OK);
}

Result<void> Packer::add(std::string_view name, ByteView content) {
  const Entry entry(archive_entry_new(), archive_entry_free);
  CONFORM_CHECK(entry != nullptr);
  archive_entry_set_pathname(entry.get(), std::string(name).c_str());
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_perm(entry.get(), 0644);
  archive_entry_set_size(entry.get(), static_cast<la_int64_t>(content.size()));
  archive_entry_set_mtime(entry.get(), time_, 0);
  if (archive_write_header(archive_->writer, entry.get()) != ARCHIVE_OK) return archive_->failed();
  while (!content.empty()) {
    const auto count = archive_write_data(archive_->writer, content.data(), content.size());
    if (count <= 0) return archive_->failed();
    content = content.subspan(static_cast<std::size_t>(count));
  }
  return {};
}

Result<Bytes> Packer::finish() {
  if (archive_write_close(archive_->writer) != ARCHIVE_OK) return archive_->failed();
  return std::move(archive_->out);
}

}  // namespace conform::bundle
