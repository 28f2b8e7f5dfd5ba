// SPDX-License-Identifier: Apache-2.0
// An independent reader checks our capture files: tshark, where installed (exit code 77: skipped).
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "base/text.hpp"
#include "can/candump_log.hpp"
#include "can/pcapng.hpp"
#include "catch.hpp"

using namespace conform;
using namespace conform::can;
using namespace std::chrono_literals;

namespace {

std::string run(const std::string& command) {
  std::string out;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::array<char, 4096> buffer;
  while (const auto count = std::fread(buffer.data(), 1, buffer.size(), pipe))
    out.append(buffer.data(), count);
  ::pclose(pipe);
  return out;
}

void need_tshark() {
  if (!run("command -v tshark 2>/dev/null").empty()) return;
  std::puts("skipped: tshark is not installed");
  std::fflush(stdout);
  std::_Exit(77);
}

Capture sample() {
  Capture capture;
  const BusTime zero{};
  capture.add({.frame = data_frame(CanId(0x605), {0x40, 0, 0x10, 0, 0, 0, 0, 0}),
               .time = zero + 5ms,
               .direction = Direction::transmitted,
               .comment = "upload 1000h:00"});
  capture.add(
      {.frame = data_frame(CanId(0x585), {0x80, 0, 0x10, 0, 2, 0, 1, 6}), .time = zero + 6ms, .comment = {}});
  capture.add({.frame = remote_frame(CanId(0x705), 1), .time = zero + 7ms, .comment = {}});
  capture.add({.frame = data_frame(CanId(0x000), {1, 5}), .time = zero + 1s, .comment = {}});
  return capture;
}

std::string fields(const std::string& name, std::string_view content) {
  const std::string path = std::string(CONFORM_BINARY_DIR) + "/" + name + "-" + std::to_string(::getpid());
  REQUIRE(write_file_atomically(path, content));
  const std::string out =
      run("tshark -n -r '" + path +
          "' -d can.subdissector,canopen -T fields -E separator=, -e frame.time_epoch -e can.id "
          "-e can.flags.rtr -e canopen.sdo.abort_code -e frame.p2p_dir -e frame.comment 2>/dev/null");
  std::filesystem::remove(path);
  return out;
}

}  // namespace

TEST_CASE("tshark reads our pcapng with stamps, directions, comments and the abort code") {
  need_tshark();
  const Bytes bytes =
      write_pcapng(sample(), {.interface_name = "can0", .epoch_ns = 1'700'000'000'000'000'000});
  CHECK(fields("capture.pcapng", {reinterpret_cast<const char*>(bytes.data()), bytes.size()}) ==
        "1700000000.005000000,1541,0,,0,upload 1000h:00\n"
        "1700000000.006000000,1413,0,0x06010002,1,\n"
        "1700000000.007000000,1797,1,,1,\n"
        "1700000001.000000000,0,0,,1,\n");
}

TEST_CASE("tshark reads our candump log") {
  need_tshark();
  CHECK(fields("capture.log", write_candump_log(sample(), {.epoch_ns = 1'700'000'000'000'000'000})) ==
        "1700000000.005000000,1541,0,,,\n"
        "1700000000.006000000,1413,0,0x06010002,,\n"
        "1700000000.007000000,1797,1,,,\n"
        "1700000001.000000000,0,0,,,\n");
}

namespace {

/// The profile that is shipped, in a folder of its own as Wireshark expects it.
class Profile {
 public:
  Profile() : folder_(std::string(CONFORM_BINARY_DIR) + "/wireshark-" + std::to_string(::getpid())) {
    std::filesystem::create_directories(folder_ + "/profiles");
    std::filesystem::copy(shipped, folder_ + "/profiles/canopen-conform");
    const Bytes bytes =
        write_pcapng(sample(), {.interface_name = "can0", .epoch_ns = 1'700'000'000'000'000'000});
    REQUIRE(write_file_atomically(folder_ + "/run.pcapng", bytes));
  }
  Profile(const Profile&) = delete;
  Profile& operator=(const Profile&) = delete;
  ~Profile() { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string tshark(const std::string& options) const {
    return run("WIRESHARK_CONFIG_DIR='" + folder_ + "' tshark -C canopen-conform -n -r '" + folder_ +
               "/run.pcapng' " + options);
  }
  static inline const std::string shipped =
      std::string(CONFORM_SOURCE_DIR) + "/docs/wireshark/canopen-conform";

 private:
  std::string folder_;
};

}  // namespace

TEST_CASE(
    "with the shipped profile frames are CANopen without a click, and the columns tell their comments") {
  need_tshark();
  const Profile profile;
  // What it does not like of the profile it says on standard error.
  CHECK(profile.tshark("2>&1 >/dev/null").find("canopen-conform") == std::string::npos);
  CHECK(profile.tshark("-T fields -e _ws.col.Service 2>/dev/null") == "CANopen\nCANopen\nCAN\nCANopen\n");
  const auto lines = profile.tshark("2>/dev/null");
  CHECK(lines.find("Default-SDO (rx): Initiate upload request upload 1000h:00") != std::string::npos);
  CHECK(lines.find("1413 (0x585)") != std::string::npos);
  CHECK(lines.find("Abort transfer") != std::string::npos);
}

TEST_CASE("every colour and every button of the shipped profile is a filter that tshark knows") {
  need_tshark();
  const Profile profile;
  std::size_t filters = 0;
  const auto check = [&](const std::string& filter) {
    ++filters;
    INFO(filter);
    REQUIRE(filter.find('\'') == std::string::npos);
    CHECK(profile.tshark("-Y '" + filter + "' 2>&1 >/dev/null").find("tshark:") == std::string::npos);
  };
  const auto lines_of = [](const std::string& name) {
    const auto content = read_file(Profile::shipped + "/" + name, 1 << 20);
    REQUIRE(content.has_value());
    std::vector<std::string> out;
    for (const auto line : split(*content, '\n')) {
      if (!line.empty() && !line.starts_with('#')) out.emplace_back(line);
    }
    return out;
  };
  for (const auto& line : lines_of("colorfilters")) {
    const auto parts = split(line, '@');
    REQUIRE(parts.size() == 4);
    check(std::string(parts[2]));
  }
  for (const auto& line : lines_of("dfilter_buttons")) {
    const auto parts = split(line, '"');
    REQUIRE(parts.size() == 9);
    std::string filter(parts[5]);
    for (std::size_t at = 0; (at = filter.find("\\x22", at)) != std::string::npos;)
      filter.replace(at, 4, "\"");
    check(filter);
  }
  CHECK(filters > 10);
}
