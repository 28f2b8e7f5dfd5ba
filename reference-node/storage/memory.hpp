// SPDX-License-Identifier: Apache-2.0
// The non-volatile memory behind 1010h and 1011h: an image of values per group of parameters.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/strong.hpp"

namespace refnode {

/// Groups of CiA 301, 7.5.2.13: sub-index 01h means all three, 02h and 03h one each. What LSS stores (CiA
/// 305) has no entry in the dictionary, and 1010h and 1011h leave it alone.
enum class Group : std::uint8_t { communication, application, manufacturer, layer_setting };

/// 0000h, 1000h-1FFFh, 6000h-9FFFh, and the rest.
[[nodiscard]] Group group_of(conform::Index index);

using Image = std::map<conform::Multiplexer, conform::Bytes>;
using Images = std::map<Group, Image>;

class Storage {
 public:
  Storage() = default;
  Storage(const Storage&) = delete;
  Storage& operator=(const Storage&) = delete;
  virtual ~Storage() = default;

  [[nodiscard]] const Images& images() const { return images_; }
  /// Makes `images` the content; when this fails the old content is still there.
  [[nodiscard]] conform::Result<void> replace(Images images);

 protected:
  [[nodiscard]] virtual conform::Result<void> write(const Images& images) = 0;
  Images images_;
};

/// Lives as long as the object.
class MemoryStorage final : public Storage {
 private:
  [[nodiscard]] conform::Result<void> write(const Images&) override { return {}; }
};

/// A text file, replaced atomically at each change. A missing file is an empty memory.
class FileStorage final : public Storage {
 public:
  [[nodiscard]] static conform::Result<std::shared_ptr<FileStorage>> open(std::string path);

 private:
  explicit FileStorage(std::string path) : path_(std::move(path)) {}
  [[nodiscard]] conform::Result<void> write(const Images& images) override;

  std::string path_;
};

}  // namespace refnode
