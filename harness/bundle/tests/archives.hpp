// SPDX-License-Identifier: Apache-2.0
// Archives as a stranger would make them, and a folder to put them in.
#pragma once

#include <archive.h>
#include <archive_entry.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "bundle/digest.hpp"
#include "bundle/keys.hpp"
#include "bundle/seal.hpp"
#include "bundle/verify.hpp"
#include "catch.hpp"

namespace conform::bundle::tests {

namespace fs = std::filesystem;

/// Gone with the test.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "conform-bundle-XXXXXX").string();
    REQUIRE(::mkdtemp(pattern.data()) != nullptr);
    path_ = pattern;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

struct Raw {
  std::string name;
  std::string content{};
  unsigned type = AE_IFREG;
  std::string link{};
  bool hard = false;
};

inline la_ssize_t take(archive* /*writer*/, void* out, const void* bytes, std::size_t size) {
  static_cast<std::string*>(out)->append(static_cast<const char*>(bytes), size);
  return static_cast<la_ssize_t>(size);
}

/// A tar of these, in zstd or as it is.
inline std::string packed(const std::vector<Raw>& entries, bool zstd = true) {
  std::string out;
  auto* writer = archive_write_new();
  archive_write_set_format_gnutar(writer);
  if (zstd) archive_write_add_filter_zstd(writer);
  archive_write_set_bytes_in_last_block(writer, 1);
  REQUIRE(archive_write_open(writer, &out, nullptr, take, nullptr) == ARCHIVE_OK);
  for (const auto& each : entries) {
    auto* entry = archive_entry_new();
    archive_entry_set_pathname(entry, each.name.c_str());
    archive_entry_set_filetype(entry, each.type);
    archive_entry_set_perm(entry, 0644);
    if (each.hard) archive_entry_set_hardlink(entry, each.link.c_str());
    if (!each.hard && !each.link.empty()) archive_entry_set_symlink(entry, each.link.c_str());
    archive_entry_set_size(entry, static_cast<la_int64_t>(each.content.size()));
    REQUIRE(archive_write_header(writer, entry) == ARCHIVE_OK);
    if (!each.content.empty()) archive_write_data(writer, each.content.data(), each.content.size());
    archive_entry_free(entry);
  }
  REQUIRE(archive_write_close(writer) == ARCHIVE_OK);
  archive_write_free(writer);
  return out;
}

/// Any bytes in one frame of zstd.
inline std::string compressed(const std::string& bytes) {
  std::string out;
  auto* writer = archive_write_new();
  archive_write_set_format_raw(writer);
  archive_write_add_filter_zstd(writer);
  archive_write_set_bytes_in_last_block(writer, 1);
  REQUIRE(archive_write_open(writer, &out, nullptr, take, nullptr) == ARCHIVE_OK);
  auto* entry = archive_entry_new();
  archive_entry_set_filetype(entry, AE_IFREG);
  REQUIRE(archive_write_header(writer, entry) == ARCHIVE_OK);
  archive_write_data(writer, bytes.data(), bytes.size());
  archive_entry_free(entry);
  REQUIRE(archive_write_close(writer) == ARCHIVE_OK);
  archive_write_free(writer);
  return out;
}

inline std::string manifest_of(const std::vector<Raw>& files, const std::string& signer = {}) {
  Manifest manifest{.tool = "canopen-conform 0", .signer = signer};
  for (const auto& each : files)
    manifest.files.push_back({each.name, "report", each.content.size(), sha256(each.content)});
  return to_json(manifest);
}

/// What seal() would put into an archive, to be spoilt. `files` are sorted.
inline std::vector<Raw> entries_of(const std::vector<Raw>& files) {
  std::vector<Raw> out{{std::string(manifest_name), manifest_of(files)}};
  out.insert(out.end(), files.begin(), files.end());
  return out;
}

inline Verification verified(const Folder& folder, const std::string& bytes, const PublicKey* key = nullptr) {
  const auto path = folder / "x.tar.zst";
  // Not flushed to the medium, as our own files are: there are thousands.
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  auto found = verify(path, key);
  REQUIRE(found);
  return std::move(*found);
}

/// "changed b.txt", one after the other.
inline std::vector<std::string> told(const Verification& found) {
  std::vector<std::string> out;
  for (const auto& each : found.problems)
    out.push_back(std::string(to_string(each.kind)) + (each.name.empty() ? "" : " " + each.name));
  return out;
}

}  // namespace conform::bundle::tests
