// SPDX-License-Identifier: Apache-2.0
#include "can/pcapng.hpp"

#include "catch.hpp"

using namespace conform;
using namespace conform::can;
using namespace std::chrono_literals;

namespace {

// One received frame 585h#43 at 1 s + 2 ns with the comment "hi", byte by byte as the format says.
const Bytes literal{// section header
                    0x0A, 0x0D, 0x0D, 0x0A, 0x2C,        0,    0,    0,    0x4D,     0x3C, 0x2B, 0x1A,
                    1,    0,    0,    0,    0xFF,        0xFF, 0xFF, 0xFF, 0xFF,     0xFF, 0xFF, 0xFF,
                    1,    0,    3,    0,    'r',         'u',  'n',  0,    4,        0,    1,    0,
                    't',  0,    0,    0,    /* end */ 0, 0,    0,    0,    0x2C + 4, 0,    0,    0};

Bytes expected() {
  Bytes out = literal;
  out[4] = 0x30;
  const Bytes rest{// interface: link type 227, name can0, 10^-9 s
                   1, 0, 0, 0, 0x28, 0, 0, 0, 0xE3, 0, 0, 0, 0, 0, 0, 0, 2, 0, 4, 0, 'c', 'a', 'n', '0', 9, 0,
                   1, 0, 9, 0, 0, 0, 0, 0, 0, 0, 0x28, 0, 0, 0,
                   // packet: stamp 1000000002 = 3B9ACA02h, 9 bytes
                   6, 0, 0, 0, 0x40, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x02, 0xCA, 0x9A, 0x3B, 9, 0, 0, 0, 9,
                   0, 0, 0, 0, 0, 0x05, 0x85, 1, 0, 0, 0, 0x43, 0, 0, 0, 2, 0, 4, 0, 1, 0, 0, 0, 1, 0, 2, 0,
                   'h', 'i', 0, 0, 0, 0, 0, 0, 0x40, 0, 0, 0};
  out.insert(out.end(), rest.begin(), rest.end());
  return out;
}

Capture sample() {
  Capture capture;
  const BusTime zero{};
  capture.add({.frame = data_frame(CanId(0x605), {0x40, 0, 0x10, 0, 0, 0, 0, 0}),
               .time = zero + 1ns,
               .direction = Direction::transmitted,
               .comment = "step 1"});
  Frame odd = data_frame(CanId(0x12345678), {1, 2, 3, 4, 5, 6, 7, 8});
  odd.dlc = 11;
  odd.extended = true;
  capture.add({.frame = odd, .time = zero + 2s, .comment = {}});
  capture.add({.frame = remote_frame(CanId(0x705), 8), .time = zero + 3s, .comment = "guard"});
  Frame error;
  error.error = true;
  error.id = 0x40;
  error.dlc = 8;
  capture.add({.frame = error, .time = zero + 4s, .comment = {}});
  // An 11-bit frame with an identifier that does not fit: virtual interfaces let it through.
  capture.add({.frame = {.id = 0x1234}, .time = zero + 4s, .comment = {}});
  return capture;
}

// The same file in the other byte order: the header and lengths are swapped by hand where this test needs
// them.
void put_be(Bytes& out, std::uint64_t value, std::size_t size) {
  for (std::size_t i = size; i-- > 0;) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

Bytes big_endian_file(std::uint8_t resolution, std::uint64_t units) {
  Bytes out;
  put_be(out, 0x0A0D0D0A, 4);
  put_be(out, 28, 4);
  put_be(out, 0x1A2B3C4D, 4);
  put_be(out, 0x00010000, 4);
  put_be(out, ~std::uint64_t{0}, 8);
  put_be(out, 28, 4);
  put_be(out, 0x0BAD, 4);  // an unknown block
  put_be(out, 16, 4);
  put_be(out, 0xDEADBEEF, 4);
  put_be(out, 16, 4);
  put_be(out, 1, 4);
  put_be(out, 28, 4);
  put_be(out, 227, 2);
  put_be(out, 0, 6);
  put_be(out, 9, 2);
  put_be(out, 1, 2);
  out.push_back(resolution);
  put_be(out, 0, 3);
  put_be(out, 28, 4);
  put_be(out, 6, 4);
  put_be(out, 56, 4);
  put_be(out, 0, 4);
  put_be(out, units, 8);
  put_be(out, 16, 4);
  put_be(out, 16, 4);
  put_be(out, 0x80000123, 4);
  put_be(out, 0x02000000, 4);
  put_be(out, 0xAABB000000000000, 8);  // padded to 16 bytes, as a kernel capture is
  put_be(out, 0x00020004, 4);
  put_be(out, 2, 4);
  put_be(out, 56, 4);
  return out;
}

std::string problem(ByteView bytes) {
  const auto loaded = read_pcapng(bytes, "x.pcapng");
  REQUIRE_FALSE(loaded.has_value());
  return loaded.error().text();
}

}  // namespace

TEST_CASE("a capture has its literal pcapng bytes") {
  Capture capture;
  capture.add({.frame = data_frame(CanId(0x585), {0x43}), .time = BusTime(2ns), .comment = "hi"});
  CHECK(write_pcapng(capture,
                     {.interface_name = "can0", .epoch_ns = 1'000'000'000, .tool = "t", .comment = "run"}) ==
        expected());
}

TEST_CASE("everything in a capture survives writing and reading") {
  const Capture capture = sample();
  const CaptureInfo info{
      .interface_name = "vcan7", .epoch_ns = 1'700'000'000'000'000'000, .tool = "t 1", .comment = "c"};
  const Bytes bytes = write_pcapng(capture, info);
  const auto loaded = read_pcapng(bytes, "x.pcapng");
  REQUIRE(loaded.has_value());
  CHECK(loaded->info.interface_name == "vcan7");
  CHECK(loaded->info.tool == "t 1");
  CHECK(loaded->info.comment == "c");
  CHECK(loaded->info.epoch_ns == info.epoch_ns + 1);
  REQUIRE(loaded->capture.size() == capture.size());
  for (std::size_t i = 0; i < capture.size(); ++i) {
    INFO(i);
    const auto& was = capture.frames()[i];
    const auto& is = loaded->capture.frames()[i];
    CHECK(is.frame == was.frame);
    CHECK(is.time == was.time - 1ns);
    CHECK(is.direction == was.direction);
    CHECK(is.comment == was.comment);
  }
  CHECK(write_pcapng(loaded->capture, loaded->info) == bytes);
}

TEST_CASE("a big-endian file with other time units is read") {
  for (const auto& [resolution, units] : {std::pair<std::uint8_t, std::uint64_t>{6, 1'500'000},
                                          {9, 1'500'000'000},
                                          {3, 1500},
                                          {12, 1'500'000'000'000},
                                          {0x81, 3},
                                          {0xA0, 0x180000000},
                                          {0xBC, 0x1800000000000000}}) {
    INFO(static_cast<int>(resolution));
    const auto loaded = read_pcapng(big_endian_file(resolution, units), "x.pcapng");
    REQUIRE(loaded.has_value());
    REQUIRE(loaded->capture.size() == 1);
    CHECK(loaded->info.epoch_ns == 1'500'000'000);
    const auto& captured = loaded->capture.frames()[0];
    CHECK(captured.frame.extended);
    CHECK(captured.frame.id == 0x123);
    CHECK(captured.frame.dlc == 2);
    CHECK(captured.frame.data[1] == 0xBB);
    CHECK(captured.direction == Direction::transmitted);
  }
}

TEST_CASE("a time stamp out of range is refused") {
  CHECK(problem(big_endian_file(0, ~std::uint64_t{0})).find("time stamp") != std::string::npos);
  CHECK(problem(big_endian_file(0xFF, 1)).find("time stamp") != std::string::npos);
}

TEST_CASE("a long comment is cut between characters") {
  Capture capture;
  std::string comment(64'999, 'a');
  comment += "\xC3\xA4 and more";
  capture.add({.frame = data_frame(CanId(1), {}), .time = BusTime{}, .comment = comment});
  const auto loaded = read_pcapng(write_pcapng(capture, {}), "x.pcapng");
  REQUIRE(loaded.has_value());
  CHECK(loaded->capture.frames()[0].comment == std::string(64'999, 'a'));
}

TEST_CASE("foreign and damaged files are refused") {
  CHECK(problem({}).find("is not a pcapng file") != std::string::npos);
  CHECK(problem(Bytes{0x4D, 0x3C, 0xB2, 0xA1, 0, 0, 0, 0, 0, 0, 0, 0}).find("editcap") != std::string::npos);
  Bytes wrong_link = expected();
  wrong_link[48 + 8] = 113;
  CHECK(problem(wrong_link).find("link type 113") != std::string::npos);
  Bytes fd = expected();
  fd[48 + 40 + 28 + 5] = 0x04;
  CHECK(problem(fd).find("CAN FD") != std::string::npos);
}

TEST_CASE("of a recording that was cut off the whole frames are read") {
  Capture capture;
  for (const std::uint32_t id : {1U, 2U})
    capture.add({.frame = data_frame(CanId(id), {}), .time = BusTime{}, .comment = {}});
  const Bytes good = write_pcapng(capture, {});
  Capture first;
  first.add(capture.frames()[0]);
  const std::size_t one = write_pcapng(first, {}).size();
  for (std::size_t size = one + 1; size < good.size(); ++size) {
    const auto loaded = read_pcapng(ByteView(good).first(size), "x.pcapng");
    REQUIRE(loaded.has_value());
    CHECK(loaded->capture.size() == 1);
    CHECK(loaded->cut_off == size - one);
  }
  CHECK(problem(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(one) - 4))
            .find("ends inside a block") != std::string::npos);
}

TEST_CASE("no truncation or flipped byte makes the reader do more than refuse") {
  const Bytes good = write_pcapng(sample(), {.interface_name = "can0", .comment = "c"});
  for (std::size_t size = 0; size < good.size(); ++size) {
    static_cast<void>(read_pcapng(ByteView(good).first(size), "x.pcapng"));
  }
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const std::uint8_t value : Bytes{0x00, 0x01, 0x7F, 0x80, 0xFF}) {
      Bytes bad = good;
      bad[i] = value;
      static_cast<void>(read_pcapng(bad, "x.pcapng"));
    }
  }
  SUCCEED();
}

TEST_CASE("pcapng frames of a second interface are refused or, with a choice, skipped") {
  Capture capture;
  capture.add({.frame = data_frame(CanId(1), {}), .time = BusTime{}, .comment = {}});
  Bytes two = write_pcapng(capture, {.interface_name = "can0"});
  const Bytes other = write_pcapng(capture, {.interface_name = "can1"});
  two.insert(two.end(), other.begin(), other.end());  // a second section
  CHECK(problem(two).find("can0 and can1") != std::string::npos);
  CHECK(read_pcapng(two, "x.pcapng", "can1").value().info.interface_name == "can1");
}
