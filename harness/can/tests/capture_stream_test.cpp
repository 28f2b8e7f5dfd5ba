// SPDX-License-Identifier: Apache-2.0
#include "can/capture_stream.hpp"

#include <unistd.h>

#include <cstdlib>

#include "base/files.hpp"
#include "can/candump_log.hpp"
#include "can/pcapng.hpp"
#include "catch.hpp"

using namespace conform;
using namespace conform::can;
using namespace std::chrono_literals;

namespace {

class Folder {
 public:
  Folder() { REQUIRE(::mkdtemp(path_) != nullptr); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    ::unlink(file().c_str());
    ::rmdir(path_);
  }
  [[nodiscard]] std::string file() const { return std::string(path_) + "/run"; }
  [[nodiscard]] std::string text() const { return *read_file(file(), 1 << 20); }

 private:
  char path_[32] = "/tmp/capture-stream-XXXXXX";
};

CapturedFrame frame_at(Duration time) {
  return {
      data_frame(CanId(0x605), {0x40, 0, 0x10, 0, 0, 0, 0, 0}), BusTime(time), Direction::transmitted, {}};
}

std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

TEST_CASE("a stream ends up as the file that is written at once") {
  Capture capture;
  for (int i = 0; i < 100; ++i) capture.add(frame_at(i * 7ms));
  CaptureInfo info{
      .interface_name = "can0", .epoch_ns = 1'700'000'000'000'000'000, .tool = "tool", .comment = "c"};
  for (const auto format : {CaptureStream::Format::pcapng, CaptureStream::Format::candump}) {
    const Folder folder;
    auto stream = CaptureStream::create(folder.file(), format, info);
    REQUIRE(stream);
    for (const auto& frame : capture.frames()) stream->add(frame);
    stream->flush();
    CHECK(stream->error() == 0);
    CHECK(folder.text() == (format == CaptureStream::Format::pcapng ? text_of(write_pcapng(capture, info))
                                                                    : write_candump_log(capture, info)));
  }
}

TEST_CASE("no frame waits longer than its time, be the bus silent or not") {
  const Folder folder;
  auto stream = CaptureStream::create(folder.file(), CaptureStream::Format::candump, {});
  REQUIRE(stream);
  stream->add(frame_at(0ms));
  CHECK(folder.text().empty());
  stream->add(frame_at(longest_in_stream));
  const auto two = folder.text().size();
  CHECK(two > 0);
  stream->add(frame_at(longest_in_stream + 1ms));
  stream->waited(BusTime(longest_in_stream + 2ms));
  CHECK(folder.text().size() == two);
  stream->waited(BusTime(2 * longest_in_stream + 1ms));
  CHECK(folder.text().size() > two);
}

TEST_CASE("an old capture is gone as soon as a new one begins") {
  const Folder folder;
  REQUIRE(write_file_atomically(folder.file(), std::string_view("stale")));
  REQUIRE(CaptureStream::create(folder.file(), CaptureStream::Format::candump, {}));
  CHECK(folder.text().empty());
  CHECK_FALSE(CaptureStream::create("/no such folder/x", CaptureStream::Format::pcapng, {}));
}
