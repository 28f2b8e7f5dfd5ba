// SPDX-License-Identifier: Apache-2.0
#include "base/files.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "catch.hpp"

using namespace conform;
namespace fs = std::filesystem;

namespace {

struct Folder {
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "conform-files-XXXXXX").string();
    REQUIRE(::mkdtemp(pattern.data()) != nullptr);
    path = pattern;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  [[nodiscard]] std::string operator/(const char* name) const { return path + "/" + name; }
  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator{}));
  }
  std::string path;
};

}  // namespace

TEST_CASE("a written file is read back whole and leaves no temporary behind") {
  const Folder folder;
  const std::string text("one\0two\n", 8);
  REQUIRE(write_file_atomically(folder / "report.xml", std::string_view(text)));
  CHECK(read_file(folder / "report.xml", 100).value() == text);
  REQUIRE(write_file_atomically(folder / "report.xml", std::string_view("new")));
  CHECK(read_file(folder / "report.xml", 100).value() == "new");
  CHECK(folder.entries() == 1);
}

TEST_CASE("an empty file can be written") {
  const Folder folder;
  REQUIRE(write_file_atomically(folder / "empty", ByteView{}));
  CHECK(read_file(folder / "empty", 0).value().empty());
}

TEST_CASE("a missing folder is an error with a hint") {
  const Folder folder;
  const auto result = write_file_atomically(folder / "no/such.xml", std::string_view("x"));
  REQUIRE_FALSE(result);
  CHECK(result.error().where == folder / "no/such.xml");
  CHECK(result.error().hint == "create the folder first");
}

TEST_CASE("links, folders and pipes are never overwritten") {
  const Folder folder;
  REQUIRE(write_file_atomically(folder / "target", std::string_view("precious")));
  REQUIRE(::symlink((folder / "target").c_str(), (folder / "link").c_str()) == 0);
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  REQUIRE(::mkdir((folder / "sub").c_str(), 0700) == 0);
  CHECK_FALSE(write_file_atomically(folder / "link", std::string_view("x")));
  CHECK_FALSE(write_file_atomically(folder / "pipe", std::string_view("x")));
  CHECK_FALSE(write_file_atomically(folder / "sub", std::string_view("x")));
  CHECK_FALSE(write_file_atomically(folder / "sub/", std::string_view("x")));
  CHECK_FALSE(write_file_atomically("", std::string_view("x")));
  CHECK(read_file(folder / "target", 100).value() == "precious");
}

TEST_CASE("reading refuses what is too large, not regular or not there") {
  const Folder folder;
  REQUIRE(write_file_atomically(folder / "ten", std::string_view("0123456789")));
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(read_file(folder / "ten", 10).has_value());
  CHECK(read_file(folder / "ten", 9).error().what.find("limit of 9 bytes") != std::string::npos);
  CHECK_FALSE(read_file(folder / "pipe", 10));
  CHECK_FALSE(read_file(folder.path, 10));
  CHECK_FALSE(read_file("/dev/zero", 10));
  CHECK(read_file(folder / "absent", 10).error().hint == "check the path");
}
