// SPDX-License-Identifier: Apache-2.0
#include "bundle/walk.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "bundle/archive.hpp"
#include "bundle/digest.hpp"

namespace conform::bundle {
namespace {

using Kind = Problem::Kind;
using Signature = Verification::Signature;

/// Of tar, for each file: its header, one that extends it, and padding of both and of the content.
constexpr std::uint64_t around_a_file = 4 * std::uint64_t{512};
/// The end of a tar, and the block that it is filled up to.
constexpr std::uint64_t around_all = 64 * std::uint64_t{1024};
/// More are of no use to anybody.
constexpr std::size_t most_problems = 30;

class OpenFile {
 public:
  OpenFile() = default;
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (fd_ >= 0) ::close(fd_);
  }

  Result<void> open(const std::string& path) {
    if (path.empty() || path.find('\0') != std::string::npos) return fail("is not the name of a file", path);
    // A named pipe without a writer must not hang.
    fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat status{};
    if (fd_ < 0 || ::fstat(fd_, &status) != 0)
      return fail("cannot open the file: " + std::generic_category().message(errno), path);
    if (!S_ISREG(status.st_mode)) return fail("is not a regular file", path);
    size_ = static_cast<std::uint64_t>(status.st_size);
    return {};
  }
  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// RFC 8878, 3.1.1: what every frame of zstd begins with.
  [[nodiscard]] bool is_zstd() const {
    constexpr std::array<std::uint8_t, 4> magic{0x28, 0xB5, 0x2F, 0xFD};
    std::array<std::uint8_t, 4> first{};
    return ::pread(fd_, first.data(), first.size(), 0) == 4 && first == magic;
  }

 private:
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

class Walk {
 public:
  Walk(const OpenFile& file, const PublicKey* key, Sink* sink)
      : size_(file.size()), key_(key), sink_(sink), archive_(file.get()) {}

  Result<Verification> done() {
    if (auto walked = all(); !walked) return std::unexpected(walked.error());
    return std::move(out_);
  }

 private:
  void add(Kind kind, std::string name, std::string what) {
    out_.problems.push_back({kind, std::move(name), std::move(what)});
  }
  void foreign(std::string why) { out_.not_a_bundle = std::move(why); }

  /// The next entry; false where there is none, or the archive ends the walk.
  bool next() {
    auto read = archive_.next();
    if (!read) {
      unreadable(read.error());
      return false;
    }
    ended_ = !*read;
    if (ended_) return false;
    entry_ = std::move(**read);
    return true;
  }

  void unreadable(const Error& error) {
    const bool too_large = error.what.starts_with("more comes");
    add(too_large ? Kind::too_large : Kind::damaged, {}, error.what);
  }

  /// The content of the entry, which is no longer than `limit`.
  std::optional<std::string> small(std::uint64_t limit) {
    std::string text;
    for (;;) {
      const auto count = archive_.read(buffer_);
      if (!count) {
        unreadable(count.error());
        return std::nullopt;
      }
      if (*count == 0) return text;
      if (text.size() + *count > limit) return std::nullopt;
      text.append(reinterpret_cast<const char*>(buffer_.data()), *count);
    }
  }

  Result<void> all() {
    archive_.allow(largest_manifest + around_a_file + around_all);
    if (!next()) {
      if (ended_) foreign("nothing is in the archive");
      return {};
    }
    if (entry_.name != manifest_name || !entry_.regular) {
      foreign("does not begin with " + std::string(manifest_name));
      return {};
    }
    const auto text = small(largest_manifest);
    if (!text) {
      if (out_.problems.empty()) foreign("its manifest is larger than any may be");
      return {};
    }
    auto manifest = parse_manifest(*text);
    if (!manifest && manifest.error().foreign) {
      foreign("of its manifest: " + manifest.error().what);
      return {};
    }
    if (!manifest) {
      add(Kind::manifest, std::string(manifest_name), manifest.error().what);
      if (key_ != nullptr) out_.signature = Signature::wrong;
      return {};
    }
    out_.manifest = std::move(*manifest);
    if (!allow()) return {};
    seen_.resize(out_.manifest.files.size());

    bool there = next();
    Bytes signature;
    const bool has_signature =
        there && entry_.name == signature_name && entry_.regular && !out_.manifest.signer.empty();
    if (has_signature) {
      const auto read = small(signature_size);
      if (read) signature.assign(read->begin(), read->end());
    }
    if (out_.problems.empty() || has_signature) check_signature(*text, signature, has_signature);
    if (sink_ != nullptr) sink_->manifest(*text, signature);
    if (has_signature && there) there = next();
    for (; there && out_.problems.size() < most_problems; there = next()) {
      if (auto taken = take(); !taken) return taken;
      // What the archive itself cannot give, no later entry can.
      if (broken_) return {};
    }
    if (there) add(Kind::damaged, {}, "so much is wrong that the rest was not looked at");
    tell_missing();
    return {};
  }

  /// What the manifest tells of may come, and no more.
  bool allow() {
    std::uint64_t total = 0;
    for (const auto& file : out_.manifest.files) total += file.size;
    if (total > suspicious_size && total / most_packed > size_) {
      add(Kind::too_large, {},
          std::to_string(total) + " bytes are to come out of an archive of " + std::to_string(size_));
      return false;
    }
    archive_.allow(largest_manifest + total + (out_.manifest.files.size() + 2) * around_a_file + around_all);
    return true;
  }

  void check_signature(std::string_view text, ByteView signature, bool there) {
    const auto& signer = out_.manifest.signer;
    if (key_ == nullptr) {
      out_.signature = signer.empty() ? Signature::none : Signature::unchecked;
    } else if (there && key_->verifies(bytes_of(text), signature)) {
      out_.signature = Signature::good;
    } else {
      out_.signature = Signature::wrong;
      const auto name = std::string(signature_name);
      if (signer.empty()) {
        add(Kind::signature, name, "it is not signed, or no longer");
      } else if (there && signer != key_->fingerprint()) {
        add(Kind::signature, name,
            "it is signed with another key: " + signer + ", the given one is " + key_->fingerprint());
      } else if (there) {
        add(Kind::signature, name, "the signature is not that of this manifest");
      }
    }
    if (!signer.empty() && !there)
      add(Kind::missing, std::string(signature_name), "the manifest says that it is signed");
  }

  /// The entry, whatever it is.
  Result<void> take() {
    if (!entry_.regular) {
      add(Kind::not_a_file, entry_.name, "a bundle holds ordinary files only, no link, folder or device");
      return {};
    }
    if (!is_safe_name(entry_.name)) {
      add(Kind::unsafe_name, entry_.name, "it could be unpacked to another place");
      return {};
    }
    const auto& files = out_.manifest.files;
    const auto found = std::ranges::lower_bound(files, entry_.name, {}, &File::name);
    if (found == files.end() || found->name != entry_.name) {
      const bool known =
          entry_.name == manifest_name || (entry_.name == signature_name && !out_.manifest.signer.empty());
      add(known ? Kind::repeated : Kind::extra, entry_.name,
          known ? "it is there again" : "the manifest does not name it");
      return {};
    }
    const auto index = static_cast<std::size_t>(found - files.begin());
    if (seen_[index]) {
      add(Kind::repeated, entry_.name, "it is there again");
      return {};
    }
    seen_[index] = true;
    if (entry_.size != found->size) {
      add(Kind::changed, entry_.name,
          "it has " + std::to_string(entry_.size) + " bytes, the manifest says " +
              std::to_string(found->size));
      return {};
    }
    return compare(*found);
  }

  /// Its digest with that of the manifest.
  Result<void> compare(const File& file) {
    if (sink_ != nullptr) {
      if (auto begun = sink_->begin(file); !begun) return begun;
    }
    Sha256 digest;
    for (;;) {
      const auto count = archive_.read(buffer_);
      if (!count) {
        seen_[static_cast<std::size_t>(&file - out_.manifest.files.data())] = false;
        unreadable(count.error());
        tell_missing();
        broken_ = true;
        return {};
      }
      if (*count == 0) break;
      const ByteView bytes(buffer_.data(), *count);
      digest.add(bytes);
      if (sink_ != nullptr) {
        if (auto taken = sink_->add(bytes); !taken) return taken;
      }
    }
    if (const auto hex = digest.hex(); hex != file.sha256) {
      add(Kind::changed, file.name, "its SHA-256 is " + hex + ", the manifest says " + file.sha256);
      return {};
    }
    ++out_.right_files;
    out_.bytes += file.size;
    return sink_ == nullptr ? Result<void>{} : sink_->end();
  }

  /// Each by its name where the archive came to its end, else how many.
  void tell_missing() {
    std::size_t count = 0;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      if (seen_[i]) continue;
      ++count;
      if (ended_ && out_.problems.size() < most_problems)
        add(Kind::missing, out_.manifest.files[i].name, "the manifest names it");
    }
    if (!ended_ && count > 0)
      add(Kind::missing, {},
          std::to_string(count) + " of " + std::to_string(seen_.size()) + " files were not reached");
  }

  std::uint64_t size_;
  const PublicKey* key_;
  Sink* sink_;
  Unpacker archive_;
  Unpacker::Entry entry_;
  bool ended_ = false;   ///< in good order
  bool broken_ = false;  ///< in the middle of a file
  std::vector<bool> seen_;
  std::array<std::uint8_t, std::size_t{64} * 1024> buffer_{};
  Verification out_;
};

}  // namespace

Result<Verification> walk(const std::string& path, const PublicKey* key, Sink* sink) {
  OpenFile file;
  if (auto opened = file.open(path); !opened) return std::unexpected(opened.error());
  if (!file.is_zstd()) {
    Verification out;
    out.not_a_bundle = "is no archive in zstd";
    return out;
  }
  return Walk(file, key, sink).done();
}

}  // namespace conform::bundle
