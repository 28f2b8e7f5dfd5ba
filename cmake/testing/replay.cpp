// SPDX-License-Identifier: Apache-2.0
// Runs the seeds of a fuzz target without a fuzzer, so that every compiler proves that they still pass.
//
//   replay_TARGET PATH...                 runs files, or all files of folders
//   replay_TARGET --unpack FOLDER PATH... writes them to FOLDER as the bytes the target gets
//
// A file that ends in .hex is text: two digits make a byte, blanks do not count, # begins a comment. All
// others are taken as they are.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

std::optional<unsigned> digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a') + 10U;
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A') + 10U;
  return std::nullopt;
}

std::optional<Bytes> from_hex(const std::string& text) {
  Bytes bytes;
  std::optional<unsigned> high;
  bool comment = false;
  for (const char c : text) {
    if (c == '#') comment = true;
    if (c == '\n') comment = false;
    if (comment || std::strchr(" \t\r\n", c) != nullptr) continue;
    const auto low = digit(c);
    if (!low) return std::nullopt;
    if (high) bytes.push_back(static_cast<std::uint8_t>(*high * 16U + *low));
    high = high ? std::nullopt : low;
  }
  if (high) return std::nullopt;
  return bytes;
}

std::optional<Bytes> read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) return std::nullopt;
  return path.extension() == ".hex" ? from_hex(text) : Bytes(text.begin(), text.end());
}

std::vector<fs::path> files_of(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

bool unpack(const fs::path& folder, const fs::path& from, const Bytes& bytes) {
  std::ofstream file(folder / from.stem(), std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return file.good();
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  std::optional<fs::path> folder;
  if (arguments.size() > 1 && arguments[0] == "--unpack") {
    folder = arguments[1];
    arguments.erase(arguments.begin(), arguments.begin() + 2);
    fs::create_directories(*folder);
  }
  int count = 0;
  for (const auto& argument : arguments) {
    for (const auto& path : files_of(argument)) {
      std::fprintf(stderr, "%s\n", path.filename().c_str());  // the last one named is the one that crashed
      const auto bytes = read(path);
      if (!bytes || (folder && !unpack(*folder, path, *bytes))) {
        std::fprintf(
            stderr,
            "%s cannot be read, holds something else than hexadecimal digits, or cannot be unpacked\n",
            path.c_str());
        return 1;
      }
      if (!folder) LLVMFuzzerTestOneInput(bytes->data(), bytes->size());
      ++count;
    }
  }
  std::printf("%d passed, 0 failed, 0 skipped\n", count);
  return count > 0 ? 0 : 1;
}
