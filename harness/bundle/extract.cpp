// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "bundle/digest.hpp"
#include "bundle/walk.hpp"

namespace conform::bundle {
namespace {

namespace fs = std::filesystem;

/// Files below a folder of our own, which nobody sees by its real name yet.
class Unpacked final : public Sink {
 public:
  explicit Unpacked(fs::path folder) : folder_(std::move(folder)) {}
  ~Unpacked() override {
    if (fd_ >= 0) ::close(fd_);
  }

  void manifest(std::string_view text, ByteView signature) override {
    manifest_ = text;
    signature_.assign(signature.begin(), signature.end());
  }
  Result<void> begin(const File& file) override { return create(file.name); }
  Result<void> add(ByteView bytes) override {
    while (!bytes.empty()) {
      const auto count = ::write(fd_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return cannot("write");
      bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return {};
  }
  Result<void> end() override {
    const int fd = fd_;
    fd_ = -1;
    return ::close(fd) == 0 ? Result<void>{} : cannot("write");
  }

  /// What tells of the others, last.
  Result<void> close() {
    if (auto done = whole(manifest_name, bytes_of(manifest_)); !done) return done;
    return signature_.empty() ? Result<void>{} : whole(signature_name, signature_);
  }

 private:
  Result<void> whole(std::string_view name, ByteView bytes) {
    if (auto done = create(std::string(name)); !done) return done;
    if (auto done = add(bytes); !done) return done;
    return end();
  }

  /// The name is a safe one.
  Result<void> create(const std::string& name) {
    // A file whose content was not right is left behind, and with it the folder is thrown away.
    if (fd_ >= 0) ::close(fd_);
    const auto path = folder_ / name;
    path_ = path.string();
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) return fail("cannot make the folder: " + error.message(), path.parent_path().string());
    fd_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
    return fd_ >= 0 ? Result<void>{} : cannot("create the file");
  }

  [[nodiscard]] std::unexpected<Error> cannot(const std::string& what) const {
    return fail("cannot " + what + ": " + std::generic_category().message(errno), path_);
  }

  fs::path folder_;
  std::string path_;
  int fd_ = -1;
  std::string manifest_;
  Bytes signature_;
};

Result<void> fill(const std::string& path, const PublicKey* key, const fs::path& folder) {
  Unpacked sink(folder);
  const auto found = walk(path, key, &sink);
  if (!found) return std::unexpected(found.error());
  // It was good a moment ago.
  if (!found->good()) return fail("has changed while it was unpacked", path);
  return sink.close();
}

}  // namespace

Result<void> is_free(const std::string& folder) {
  std::error_code error;
  const auto status = fs::symlink_status(folder, error);
  if (folder.empty()) return fail("is not the name of a folder", folder);
  if (status.type() == fs::file_type::not_found) return {};
  if (status.type() != fs::file_type::directory) return fail("is there, and is no folder", folder);
  if (fs::is_empty(folder, error) && !error) return {};
  return fail("is not empty: nothing is unpacked over what is there", folder, "name a new folder");
}

Result<void> extract(const std::string& path, const PublicKey* key, const std::string& folder) {
  if (auto free = is_free(folder); !free) return free;
  std::error_code error;
  auto whole = fs::absolute(folder, error).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  // Beside it, so that it can be renamed; new, so that nobody has put a link there.
  const fs::path hidden =
      whole.parent_path() / ("." + whole.filename().string() + "." + std::to_string(::getpid()) + ".part");
  if (::mkdir(hidden.c_str(), 0755) != 0)
    return fail("cannot make a folder there: " + std::generic_category().message(errno),
                whole.parent_path().string());
  auto done = fill(path, key, hidden);
  if (done && std::rename(hidden.c_str(), whole.c_str()) != 0)
    done = fail("cannot rename the folder: " + std::generic_category().message(errno), whole.string());
  if (!done) fs::remove_all(hidden, error);
  return done;
}

}  // namespace conform::bundle
