// SPDX-License-Identifier: Apache-2.0
#include "can/candump_log.hpp"

#include "catch.hpp"

using namespace conform;
using namespace conform::can;
using namespace std::chrono_literals;

namespace {

Frame extended_frame(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
  Frame frame = data_frame(CanId(id), bytes);
  frame.extended = true;
  return frame;
}

Frame error_frame(std::uint32_t error_class, std::uint8_t detail) {
  Frame frame;
  frame.error = true;
  frame.id = error_class;
  frame.dlc = 8;
  frame.data[1] = detail;
  return frame;
}

std::string problem(std::string_view log) {
  const auto loaded = read_candump_log(log, "x.log");
  REQUIRE_FALSE(loaded.has_value());
  return loaded.error().text();
}

}  // namespace

TEST_CASE("every kind of frame has its literal candump line") {
  Capture capture;
  const BusTime zero{};
  capture.add({.frame = data_frame(CanId(0x605), {0x40, 0, 0x10, 0, 0, 0, 0, 0}),
               .time = zero + 5ms,
               .direction = Direction::transmitted,
               .comment = "not shown"});
  capture.add({.frame = data_frame(CanId(0x080), {}), .time = zero + 5ms + 999ns, .comment = {}});
  capture.add({.frame = remote_frame(CanId(0x705), 1), .time = zero + 1s, .comment = {}});
  capture.add({.frame = remote_frame(CanId(0x705), 0), .time = zero + 1s, .comment = {}});
  capture.add({.frame = extended_frame(0x12345, {0xAB}), .time = zero + 61s, .comment = {}});
  capture.add({.frame = error_frame(0x04, 0x04), .time = zero + 62s, .comment = {}});
  CHECK(write_candump_log(capture, {.interface_name = "can0", .epoch_ns = 1'700'000'000'000'000'000}) ==
        "(1700000000.005000) can0 605#4000100000000000\n"
        "(1700000000.005000) can0 080#\n"
        "(1700000001.000000) can0 705#R1\n"
        "(1700000001.000000) can0 705#R\n"
        "(1700000061.000000) can0 00012345#AB\n"
        "(1700000062.000000) can0 20000004#0004000000000000\n");
}

TEST_CASE("a virtual epoch of zero keeps ten digits of seconds") {
  Capture capture;
  capture.add({.frame = data_frame(CanId(0x000), {0x01, 0x05}), .time = BusTime(48us), .comment = {}});
  CHECK(write_candump_log(capture, {.interface_name = "simulated"}) ==
        "(0000000000.000048) simulated 000#0105\n");
  CHECK(write_candump_log(capture, {.interface_name = "my can\n"}) ==
        "(0000000000.000048) my_can_ 000#0105\n");
}

TEST_CASE("what was written reads back, relative to the first frame") {
  const std::string log = "(1700000000.005000) can0 605#4000100000000000\n"
                          "(1700000000.005111) can0 080#\n"
                          "(1700000001.000000) can0 705#R1\n"
                          "(1700000061.000000) can0 00012345#AB\n"
                          "(1700000062.000000) can0 20000004#0004000000000000\n";
  const auto loaded = read_candump_log(log, "x.log");
  REQUIRE(loaded.has_value());
  const auto& frames = loaded->capture.frames();
  REQUIRE(frames.size() == 5);
  CHECK(loaded->info.epoch_ns == 1'700'000'000'005'000'000);
  CHECK(loaded->info.interface_name == "can0");
  CHECK(frames[0].time == BusTime{});
  CHECK(frames[1].time == BusTime(111us));
  CHECK(frames[2].frame == remote_frame(CanId(0x705), 1));
  CHECK(frames[3].frame == extended_frame(0x12345, {0xAB}));
  CHECK(frames[4].frame == error_frame(0x04, 0x04));
  CHECK(write_candump_log(loaded->capture, loaded->info) == log);
}

TEST_CASE("dialects of other tools are read") {
  const auto loaded = read_candump_log("# a comment\r\n\r\n"
                                       "(1700000000.000000123) vcan0 123#11.22 T\r\n"
                                       "(1699999999.000000) vcan0 123#1122334455667788_B R\n",
                                       "x.log");
  REQUIRE(loaded.has_value());
  const auto& frames = loaded->capture.frames();
  REQUIRE(frames.size() == 2);
  CHECK(frames[0].direction == Direction::transmitted);
  CHECK(frames[0].frame == data_frame(CanId(0x123), {0x11, 0x22}));
  CHECK(frames[1].direction == Direction::received);
  CHECK(frames[1].frame.dlc == 11);
  CHECK(frames[1].time == BusTime(-1s - 123ns));
}

TEST_CASE("a last line without end may lack data and is left out") {
  const auto loaded = read_candump_log("(1.000000) can0 080#\n(1.000000) can0 585#4300", "x.log");
  REQUIRE(loaded.has_value());
  CHECK(loaded->capture.size() == 1);
  CHECK(loaded->cut_off == 24);
}

TEST_CASE("frames of a second interface are refused or, with a choice, skipped") {
  const std::string log = "(1.000000) can0 080#\n(1.000000) can1 081#\n";
  CHECK(problem(log).find("x.log:2: the log holds frames of more than one interface: can0 and can1") == 0);
  const auto loaded = read_candump_log(log, "x.log", "can1");
  REQUIRE(loaded.has_value());
  REQUIRE(loaded->capture.size() == 1);
  CHECK(loaded->capture.frames()[0].frame.id == 0x081);
}

TEST_CASE("every malformed line is refused with its number") {
  for (const char* line : {"hello",
                           "(1.000000)",
                           "(1.000000) can0",
                           "(1.000000) can0 605",
                           "(1.00000) can0 605#",
                           "(1) can0 605#",
                           "(-1.000000) can0 605#",
                           "(1.-00000) can0 605#",
                           "(1.000000 can0 605#",
                           "1.000000 can0 605#",
                           "(99999999999999999999.000000) can0 605#",
                           "(9223372036.999999) can0 605#",
                           "(1.000000) can0 60#",
                           "(1.000000) can0 0605#",
                           "(1.000000) can0 60G#",
                           "(1.000000) can0 800#",
                           "(1.000000) can0 C0000001#",
                           "(1.000000) can0 605#1",
                           "(1.000000) can0 605#0G",
                           "(1.000000) can0 605#112233445566778899",
                           "(1.000000) can0 605#R9",
                           "(1.000000) can0 605#R88",
                           "(1.000000) can0 605##011",
                           "(1.000000) can0 605#11_9",
                           "(1.000000) can0 605#1122334455667788_8",
                           "(1.000000) can0 605#11 X",
                           "(1.000000) can0 605#11 T T"}) {
    INFO(line);
    CHECK(problem(std::string("(1.000000) can0 080#\n") + line + "\n").starts_with("x.log:2: "));
  }
  CHECK(problem(std::string(5000, '(')).find("longer than 4096") != std::string::npos);
  CHECK(problem(std::string("(1.0\0", 5)).starts_with("x.log:1: "));
}

TEST_CASE("an empty log is an empty capture") {
  CHECK(read_candump_log("", "x.log").value().capture.size() == 0);
  CHECK(read_candump_log("\n\n", "x.log").value().capture.size() == 0);
}
