// SPDX-License-Identifier: Apache-2.0
#include "storage/memory.hpp"

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/text.hpp"

namespace refnode {

namespace {

constexpr std::string_view header = "canopen-refnode storage 1";
constexpr std::string_view footer = "end";

std::string_view group_name(Group group) {
  switch (group) {
    case Group::communication: return "communication";
    case Group::application: return "application";
    case Group::manufacturer: return "manufacturer";
    case Group::layer_setting: return "layer setting";
  }
  return "";
}

std::optional<Group> group_named(std::string_view name) {
  for (const Group group :
       {Group::communication, Group::application, Group::manufacturer, Group::layer_setting}) {
    if (group_name(group) == name) return group;
  }
  return std::nullopt;
}

// A line per group ("[application]"; its presence means that the group has been stored) and per value
// ("6200h:01 = 2A"). The footer tells a complete file from a truncated one.
std::string to_text(const Images& images) {
  std::string text = fmt::format("{}\n", header);
  for (const auto& [group, image] : images) {
    text += fmt::format("[{}]\n", group_name(group));
    for (const auto& [mux, bytes] : image) {
      text += fmt::format("{} = {}\n", conform::to_string(mux), conform::hex_bytes(bytes));
    }
  }
  return text + fmt::format("{}\n", footer);
}

std::optional<Images> from_text(std::string_view text, int& line_number) {
  Images images;
  std::optional<Group> group;
  bool complete = false;
  line_number = 0;
  for (const std::string_view raw : conform::split(text, '\n')) {
    ++line_number;
    const std::string_view line = conform::trim(raw);
    if (line_number == 1) {
      if (line != header) return std::nullopt;
    } else if (line.empty()) {
      continue;
    } else if (complete) {
      return std::nullopt;
    } else if (line == footer) {
      complete = true;
    } else if (line.front() == '[' && line.back() == ']') {
      group = group_named(line.substr(1, line.size() - 2));
      if (!group) return std::nullopt;
      images[*group];
    } else {
      const std::size_t equals = line.find('=');
      if (!group || equals == std::string_view::npos) return std::nullopt;
      const auto mux = conform::parse_multiplexer(conform::trim(line.substr(0, equals)));
      const std::string_view value = conform::trim(line.substr(equals + 1));
      const auto bytes = value.empty() ? conform::Bytes{} : conform::parse_bytes(value);
      if (!mux || !bytes) return std::nullopt;
      images[*group][*mux] = *bytes;
    }
  }
  if (!complete) return std::nullopt;
  return images;
}

std::string reason() { return std::generic_category().message(errno); }

}  // namespace

Group group_of(conform::Index index) {
  if (index.value() == 0) return Group::layer_setting;
  if (index.value() >= 0x1000 && index.value() <= 0x1FFF) return Group::communication;
  if (index.value() >= 0x6000 && index.value() <= 0x9FFF) return Group::application;
  return Group::manufacturer;
}

conform::Result<void> Storage::replace(Images images) {
  auto written = write(images);
  if (written) images_ = std::move(images);
  return written;
}

conform::Result<std::shared_ptr<FileStorage>> FileStorage::open(std::string path) {
  std::shared_ptr<FileStorage> storage(new FileStorage(std::move(path)));
  const std::string& name = storage->path_;
  if (::access(name.c_str(), F_OK) != 0) {
    if (errno == ENOENT) return storage;
    return conform::fail("the storage file cannot be reached: " + reason(), name);
  }
  std::ifstream file(name, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  if (!file)
    return conform::fail("the storage file cannot be read", name, "give a readable file or a new name");
  int line = 0;
  auto images = from_text(text.str(), line);
  if (!images) {
    return conform::fail("this is no complete storage file", name + ":" + std::to_string(line),
                         "remove the file to start with the default values");
  }
  storage->images_ = std::move(*images);
  return storage;
}

conform::Result<void> FileStorage::write(const Images& images) {
  const std::string temporary = path_ + ".new";
  const std::string text = to_text(images);
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) return conform::fail("the storage file cannot be written: " + reason(), temporary);
  std::size_t done = 0;
  bool good = true;
  while (good && done < text.size()) {
    const ::ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    good = count > 0;
    if (good) done += static_cast<std::size_t>(count);
  }
  // On the disk before it takes the old file's place: the confirmation of 1010h means that the values are
  // stored.
  good = good && ::fsync(file) == 0;
  const std::string why = good ? std::string() : reason();
  ::close(file);
  if (good && std::rename(temporary.c_str(), path_.c_str()) == 0) return {};
  const std::string what = good ? reason() : why;
  ::unlink(temporary.c_str());
  return conform::fail("the storage file cannot be written: " + what, path_);
}

}  // namespace refnode
