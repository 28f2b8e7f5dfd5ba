// SPDX-License-Identifier: Apache-2.0
#include "base/files.hpp"
#include "base/text_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

namespace conform {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  [[nodiscard]] int get() const { return fd_; }
  /// close() is where some file systems report that writing failed.
  [[nodiscard]] int close() { return ::close(std::exchange(fd_, -1)); }

 private:
  int fd_;
};

std::string reason(int error) { return std::generic_category().message(error); }

std::string hint_for(int error, bool writing) {
  switch (error) {
    case ENOENT: return writing ? "create the folder first" : "check the path";
    case ENOTDIR: return "a part of the path is a file, not a folder";
    case EACCES:
    case EPERM: return "check the permissions";
    case EROFS: return "the file system is read-only";
    case ENOSPC:
    case EDQUOT: return "free some space or choose another folder";
    case ENAMETOOLONG: return "choose a shorter name";
    default: return {};
  }
}

std::unexpected<Error> failed(const std::string& action, const std::string& path, int error, bool writing) {
  return fail("cannot " + action + ": " + reason(error), path, hint_for(error, writing));
}

Result<void> refuse_special(const std::string& path) {
  struct stat status{};
  if (::lstat(path.c_str(), &status) != 0) return {};  // absent, or open() will say what is wrong
  if (S_ISREG(status.st_mode)) return {};
  const char* kind = S_ISLNK(status.st_mode)   ? "a symbolic link"
                     : S_ISDIR(status.st_mode) ? "a folder"
                                               : "not a regular file";
  return fail(std::string("will not be overwritten: it is ") + kind, path, "name a regular file");
}

int write_all(int fd, ByteView bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

// The rename itself is durable once its folder is. Some file systems cannot do this; the file is whole either
// way.
void sync_folder(const std::string& folder) {
  const Descriptor fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (fd.get() >= 0) static_cast<void>(::fsync(fd.get()));
}

}  // namespace

Result<void> write_file_atomically(const std::string& path, ByteView bytes) {
  if (path.empty() || path.back() == '/' || path.find('\0') != std::string::npos) {
    return fail("is not the name of a file", path);
  }
  if (auto regular = refuse_special(path); !regular) return regular;

  const auto slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
  const std::string prefix = (slash == std::string::npos ? std::string() : path.substr(0, slash + 1)) + ".";
  const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);

  // A leftover of a killed process with our number is stepped over, never opened.
  std::string temporary;
  int fd = -1;
  for (int attempt = 0; attempt < 16 && fd < 0; ++attempt) {
    temporary = prefix + name + "." + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".tmp";
    fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd < 0 && errno != EEXIST) return failed("create the file", path, errno, true);
  }
  if (fd < 0) return failed("create a temporary file beside it", path, EEXIST, true);

  Descriptor file(fd);
  int error = write_all(file.get(), bytes);
  std::string action = "write";
  if (error == 0 && ::fsync(file.get()) != 0 && errno != EINVAL && errno != EROFS) {
    error = errno;
    action = "flush";
  }
  if (error == 0 && file.close() != 0) {
    error = errno;
    action = "close";
  }
  if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) {
    error = errno;
    action = "rename the finished file to this name";
  }
  if (error != 0) {
    ::unlink(temporary.c_str());
    return failed(action, path, error, true);
  }
  sync_folder(folder);
  return {};
}

Result<void> write_file_atomically(const std::string& path, std::string_view text) {
  return write_file_atomically(path, bytes_of(text));
}

Result<std::string> read_file(const std::string& path, std::uint64_t limit) {
  if (path.empty() || path.find('\0') != std::string::npos) return fail("is not the name of a file", path);
  // O_NONBLOCK: opening a named pipe without writer must not hang; it is refused below.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) return failed("open the file", path, errno, false);
  struct stat status{};
  if (::fstat(file.get(), &status) != 0) return failed("examine the file", path, errno, false);
  if (S_ISDIR(status.st_mode)) return fail("is a folder, not a file", path);
  if (!S_ISREG(status.st_mode)) return fail("is not a regular file", path);
  const auto too_large = [&] {
    return fail("is larger than the limit of " + std::to_string(limit) + " bytes", path);
  };
  if (status.st_size > 0 && static_cast<std::uint64_t>(status.st_size) > limit) return too_large();

  std::string text;
  text.reserve(static_cast<std::size_t>(std::max<off_t>(status.st_size, 0)));
  std::array<char, 65536> buffer;
  for (;;) {
    const ssize_t count = ::read(file.get(), buffer.data(), buffer.size());
    if (count < 0) {
      if (errno == EINTR) continue;
      return failed("read", path, errno, false);
    }
    if (count == 0) return text;
    if (text.size() + static_cast<std::size_t>(count) > limit) return too_large();
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace conform
