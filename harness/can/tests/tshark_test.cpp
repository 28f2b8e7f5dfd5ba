// SPDX-License-Identifier: Apache-2.0
// An independent reader checks our capture files: tshark, where installed (exit code 77: skipped).
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "base/files.hpp"
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
