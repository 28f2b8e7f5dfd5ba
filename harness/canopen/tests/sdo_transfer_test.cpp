// SPDX-License-Identifier: Apache-2.0
// The client against servers that keep and break the protocol, frame by frame.
#include "canopen/sdo_transfer.hpp"

#include "canopen/abort_code.hpp"
#include "catch.hpp"

using namespace conform;
using namespace conform::canopen;

namespace {

using Kind = TransferResult::Kind;
constexpr Multiplexer device_name{Index{0x1008}, SubIndex{0}};
constexpr Multiplexer error_count{Index{0x1003}, SubIndex{0}};
constexpr Multiplexer heartbeat_time{Index{0x1017}, SubIndex{0}};

/// What the client sends now; there must be something.
SdoBytes send(SdoClient& transfer) {
  const auto frame = transfer.next(0);
  REQUIRE(frame);
  return frame->bytes;
}

/// The next request, after the one that is due has gone out and been answered.
SdoBytes next(SdoClient& transfer, ByteView response) {
  static_cast<void>(transfer.next(0));
  CHECK(transfer.on_frame(response, 0));
  REQUIRE_FALSE(transfer.ended());
  return send(transfer);
}

TransferResult end(SdoClient& transfer, ByteView response) {
  static_cast<void>(transfer.next(0));
  CHECK(transfer.on_frame(response, 0));
  REQUIRE(transfer.ended());
  CHECK_FALSE(transfer.next(0).has_value());
  return transfer.take();
}

TransferResult upload_end(Multiplexer mux, ByteView response) {
  SdoUpload upload(mux);
  return end(upload, response);
}

/// An upload of 1008h whose server has announced `size` bytes.
SdoUpload segmented(std::uint8_t size) {
  SdoUpload upload(device_name);
  CHECK(next(upload, SdoBytes{0x41, 0x08, 0x10, 0x00, size}) == SdoBytes{0x60});
  return upload;
}

}  // namespace

TEST_CASE("An expedited upload takes one response") {
  SdoUpload upload(heartbeat_time);
  CHECK(send(upload) == SdoBytes{0x40, 0x17, 0x10, 0x00});
  const auto result = end(upload, SdoBytes{0x4B, 0x17, 0x10, 0x00, 0xE8, 0x03});
  CHECK(result.kind == Kind::confirmed);
  CHECK(result.data == Bytes{0xE8, 0x03});
  CHECK(result.expedited);
  CHECK(result.size_indicated);
  CHECK(result.announced_size == 2U);
  CHECK(result.remarks.empty());
  CHECK(result.detail.empty());
}

TEST_CASE("An expedited upload without size delivers four bytes") {
  const auto result = upload_end(heartbeat_time, SdoBytes{0x42, 0x17, 0x10, 0x00, 0xE8, 0x03});
  CHECK(result.kind == Kind::confirmed);
  CHECK(result.data == Bytes{0xE8, 0x03, 0, 0});
  CHECK_FALSE(result.size_indicated);
  CHECK_FALSE(result.announced_size.has_value());
}

TEST_CASE("A segmented upload alternates the toggle bit and joins the segments") {
  SdoUpload upload(device_name);
  CHECK(next(upload, SdoBytes{0x41, 0x08, 0x10, 0x00, 9}) == SdoBytes{0x60});
  CHECK(next(upload, SdoBytes{0x00, 'c', 'o', 'n', 'f', 'o', 'r', 'm'}) == SdoBytes{0x70});
  CHECK(upload.result().data.size() == 7);
  const auto result = end(upload, SdoBytes{0x1B, 'e', 'r'});
  CHECK(result.kind == Kind::confirmed);
  CHECK(result.data == Bytes{'c', 'o', 'n', 'f', 'o', 'r', 'm', 'e', 'r'});
  CHECK_FALSE(result.expedited);
  CHECK(result.announced_size == 9U);
  CHECK(result.remarks.empty());
}

TEST_CASE("A segmented upload without size ends with the last segment") {
  SdoUpload upload(device_name);
  CHECK(next(upload, SdoBytes{0x40, 0x08, 0x10, 0x00}) == SdoBytes{0x60});
  const auto result = end(upload, SdoBytes{0x0D, 'a'});
  CHECK(result.kind == Kind::confirmed);
  CHECK(result.data == Bytes{'a'});
  CHECK_FALSE(result.size_indicated);
}

TEST_CASE("An empty object is one empty last segment") {
  SdoUpload upload = segmented(0);
  const auto result = end(upload, SdoBytes{0x0F});
  CHECK(result.kind == Kind::confirmed);
  CHECK(result.data.empty());
}

TEST_CASE("An abort ends a transfer with its code") {
  const auto result = upload_end(error_count, SdoBytes{0x80, 0x03, 0x10, 0x00, 0x00, 0x00, 0x02, 0x06});
  CHECK(result.kind == Kind::aborted);
  CHECK(result.code == abort::no_object);
  CHECK_FALSE(result.reply.has_value());
  SdoUpload upload = segmented(20);
  const auto late = end(upload, SdoBytes{0x80, 0x08, 0x10, 0x00, 0x00, 0x00, 0x00, 0x08});
  CHECK(late.kind == Kind::aborted);
  CHECK(late.code == abort::general);
}

TEST_CASE("A response for another object is a violation that names both") {
  const auto result = upload_end(error_count, SdoBytes{0x43, 0x00, 0x10, 0x00, 0x91, 0x01});
  CHECK(result.kind == Kind::violation);
  CHECK(result.detail == "answers 1000h:00 instead of 1003h:00");
  CHECK_FALSE(result.reply.has_value());  // expedited: the server's channel is closed
  const auto open = upload_end(error_count, SdoBytes{0x41, 0x03, 0x10, 0x01, 9});
  CHECK(open.detail == "answers 1003h:01 instead of 1003h:00");
  CHECK(open.reply == abort::general);
  const auto aborted = upload_end(error_count, SdoBytes{0x80, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x06});
  CHECK(aborted.kind == Kind::violation);
  CHECK(aborted.detail == "aborts 0000h:00 instead of 1003h:00 (0602 0000h (object does not exist))");
  CHECK(aborted.code == abort::no_object);
}

TEST_CASE("Short frames and wrong commands are violations") {
  const auto too_short = upload_end(error_count, Bytes{0x4F, 0x03, 0x10, 0x00, 0x00});
  CHECK(too_short.kind == Kind::violation);
  CHECK(too_short.detail == "answers with a frame of 5 data bytes instead of 8");
  CHECK(upload_end(error_count, Bytes{0x80}).detail == "answers with a frame of 1 data byte instead of 8");
  CHECK(upload_end(error_count, {}).detail == "answers with a frame of 0 data bytes instead of 8");
  const auto wrong = upload_end(error_count, SdoBytes{0x60, 0x03, 0x10, 0x00});
  CHECK(wrong.detail == "answers with command 60h where an upload response (40h to 4Fh) is due");
  CHECK(wrong.reply == abort::command_specifier);
  SdoUpload upload = segmented(20);
  CHECK(end(upload, SdoBytes{0x41, 0x08, 0x10, 0x00, 20}).detail ==
        "answers with command 41h where an upload segment (00h to 1Fh) is due");
}

TEST_CASE("A wrong toggle bit is answered with its abort code") {
  SdoUpload upload = segmented(20);
  static_cast<void>(next(upload, SdoBytes{0x00, 1, 2, 3, 4, 5, 6, 7}));
  const auto result = end(upload, SdoBytes{0x00, 1, 2, 3, 4, 5, 6, 7});
  CHECK(result.kind == Kind::violation);
  CHECK(result.detail == "answers segment 2 with toggle bit 0 instead of 1");
  CHECK(result.reply == abort::toggle_bit);
  CHECK(result.data.size() == 7);
}

TEST_CASE("Fewer or more bytes than announced are violations") {
  SdoUpload fewer = segmented(20);
  const auto less = end(fewer, SdoBytes{0x01, 1, 2, 3, 4, 5, 6, 7});
  CHECK(less.kind == Kind::violation);
  CHECK(less.detail == "delivers 7 bytes, 20 were announced");
  CHECK_FALSE(less.reply.has_value());
  SdoUpload more = segmented(5);
  const auto surplus = end(more, SdoBytes{0x00, 1, 2, 3, 4, 5, 6, 7});
  CHECK(surplus.detail == "delivers 7 bytes or more, 5 were announced");
  CHECK(surplus.reply == abort::length_mismatch);
}

TEST_CASE("Memory is bounded and never follows the announced size") {
  SdoUpload huge(device_name);
  static_cast<void>(next(huge, SdoBytes{0x41, 0x08, 0x10, 0x00, 0xFF, 0xFF, 0xFF, 0xFF}));
  CHECK(huge.result().data.capacity() < 1024);
  SdoUpload upload(device_name, 10);
  static_cast<void>(next(upload, SdoBytes{0x40, 0x08, 0x10, 0x00}));
  static_cast<void>(next(upload, SdoBytes{0x00, 1, 2, 3, 4, 5, 6, 7}));
  const auto result = end(upload, SdoBytes{0x10, 1, 2, 3, 4, 5, 6, 7});
  CHECK(result.kind == Kind::violation);
  CHECK(result.detail == "delivers more than 10 bytes");
  CHECK(result.reply == abort::out_of_memory);
}

TEST_CASE("A server cannot hold the client with empty segments") {
  SdoUpload upload(device_name);
  static_cast<void>(next(upload, SdoBytes{0x40, 0x08, 0x10, 0x00}));
  int frames = 0;
  for (;;) {
    upload.on_frame(SdoBytes{static_cast<std::uint8_t>(frames % 2 == 0 ? 0x0E : 0x1E)}, 0);
    ++frames;
    REQUIRE(frames < 100);
    if (upload.ended()) {
      CHECK(upload.result().kind == Kind::violation);
      CHECK(upload.result().detail == "delivers 16 segments without data one after the other");
      break;
    }
    REQUIRE(upload.next(0));
  }
}

TEST_CASE("Reserved and unused bits are remarks and do not end a transfer") {
  const auto expedited = upload_end(heartbeat_time, SdoBytes{0x5B, 0x17, 0x10, 0x00, 0xE8, 0x03, 0, 1});
  CHECK(expedited.kind == Kind::confirmed);
  CHECK(expedited.remarks ==
        std::vector<std::string>{"bit 4 of the command is set (5Bh)",
                                 "unused data bytes of the expedited response are not zero"});
  SdoUpload upload(device_name);
  static_cast<void>(next(upload, SdoBytes{0x44, 0x08, 0x10, 0x00, 0, 0, 0, 7}));
  const auto segmented_result = end(upload, SdoBytes{0x0D, 'a', 'b'});
  CHECK(segmented_result.kind == Kind::confirmed);
  CHECK(segmented_result.data == Bytes{'a'});
  CHECK(segmented_result.remarks.size() == 3);
  const auto aborted = upload_end(error_count, SdoBytes{0x84, 0x03, 0x10, 0x00, 0x00, 0x00, 0x02, 0x06});
  CHECK(aborted.kind == Kind::aborted);
  CHECK(aborted.remarks == std::vector<std::string>{"reserved bits of the abort command are set (84h)"});
}

TEST_CASE("Up to four bytes are downloaded expedited") {
  SdoDownload download(heartbeat_time, Bytes{0xE8, 0x03});
  CHECK(send(download) == SdoBytes{0x2B, 0x17, 0x10, 0x00, 0xE8, 0x03});
  const auto result = end(download, SdoBytes{0x60, 0x17, 0x10, 0x00});
  CHECK(result.kind == Kind::confirmed);
  CHECK(result.expedited);
  CHECK(result.remarks.empty());
}

TEST_CASE("More than four bytes are downloaded in segments") {
  SdoDownload download(device_name, Bytes{1, 2, 3, 4, 5, 6, 7, 8, 9});
  CHECK(send(download) == SdoBytes{0x21, 0x08, 0x10, 0x00, 9});
  CHECK(next(download, SdoBytes{0x60, 0x08, 0x10, 0x00}) == SdoBytes{0x00, 1, 2, 3, 4, 5, 6, 7});
  CHECK(next(download, SdoBytes{0x20}) == SdoBytes{0x1B, 8, 9});
  CHECK(end(download, SdoBytes{0x30}).kind == Kind::confirmed);
}

TEST_CASE("The form of a download can be forced") {
  SdoDownload open(heartbeat_time, {1, 2}, SdoDownload::Mode::expedited_unsized);
  CHECK(send(open) == SdoBytes{0x22, 0x17, 0x10, 0x00, 1, 2});
  SdoDownload sized(heartbeat_time, {1, 2}, SdoDownload::Mode::segmented);
  CHECK(send(sized) == SdoBytes{0x21, 0x17, 0x10, 0x00, 2});
  CHECK(next(sized, SdoBytes{0x60, 0x17, 0x10, 0x00}) == SdoBytes{0x0B, 1, 2});
  SdoDownload unsized_download(heartbeat_time, {1, 2}, SdoDownload::Mode::segmented_unsized);
  CHECK(send(unsized_download) == SdoBytes{0x20, 0x17, 0x10, 0x00});
  SdoDownload empty(device_name, {});
  CHECK(send(empty) == SdoBytes{0x21, 0x08, 0x10, 0x00});
  CHECK(next(empty, SdoBytes{0x60, 0x08, 0x10, 0x00}) == SdoBytes{0x0F});
  CHECK(end(empty, SdoBytes{0x20}).kind == Kind::confirmed);
}

TEST_CASE("A frame that came before the request is no answer to it") {
  SdoUpload upload(heartbeat_time);
  static_cast<void>(send(upload));
  CHECK_FALSE(upload.on_frame(SdoBytes{0x4B, 0x17, 0x10, 0x00, 0xE8, 0x03}, 1));
  CHECK_FALSE(upload.ended());
  CHECK(upload.on_frame(SdoBytes{0x4B, 0x17, 0x10, 0x00, 0xE8, 0x03}, 0));
  CHECK(upload.ended());
}

TEST_CASE("Silence ends a transfer, and the server is told") {
  SdoDownload download(heartbeat_time, {1, 2});
  static_cast<void>(send(download));
  download.on_silence();
  REQUIRE(download.ended());
  CHECK(download.result().kind == Kind::silence);
  CHECK(download.result().reply == abort::timed_out);
}

TEST_CASE("Deviations of the server end a download as violations") {
  SdoDownload other(heartbeat_time, {1, 2});
  const auto wrong_object = end(other, SdoBytes{0x60, 0x18, 0x10, 0x00});
  CHECK(wrong_object.detail == "answers 1018h:00 instead of 1017h:00");
  CHECK_FALSE(wrong_object.reply.has_value());
  SdoDownload command(heartbeat_time, {1, 2});
  CHECK(end(command, SdoBytes{0x43, 0x17, 0x10, 0x00}).detail ==
        "answers with command 43h where the download response (60h) is due");
  SdoDownload toggle(device_name, Bytes(20));
  static_cast<void>(next(toggle, SdoBytes{0x60, 0x08, 0x10, 0x00}));
  const auto wrong_toggle = end(toggle, SdoBytes{0x30});
  CHECK(wrong_toggle.detail == "answers segment 1 with toggle bit 1 instead of 0");
  CHECK(wrong_toggle.reply == abort::toggle_bit);
  SdoDownload no_ack(device_name, Bytes(20));
  static_cast<void>(next(no_ack, SdoBytes{0x60, 0x08, 0x10, 0x00}));
  CHECK(end(no_ack, SdoBytes{0x60, 0x08, 0x10, 0x00}).detail ==
        "answers with command 60h where a download segment response (20h or 30h) is due");
  SdoDownload cut(heartbeat_time, {1, 2});
  CHECK(end(cut, Bytes{0x60, 0x17, 0x10, 0x00}).detail ==
        "answers with a frame of 4 data bytes instead of 8");
}

TEST_CASE("A download may be aborted at any response, and remarks survive") {
  SdoDownload download(device_name, Bytes(20));
  static_cast<void>(next(download, SdoBytes{0x61, 0x08, 0x10, 0x00, 0, 0, 0, 1}));
  const auto result = end(download, SdoBytes{0x80, 0x08, 0x10, 0x00, 0x02, 0x00, 0x01, 0x06});
  CHECK(result.kind == Kind::aborted);
  CHECK(result.code == abort::read_only);
  CHECK(result.remarks ==
        std::vector<std::string>{"reserved bits of the command are set (61h)",
                                 "reserved bytes 4 to 7 of the download response are not zero"});
}

TEST_CASE("Whatever a server answers, a transfer ends or asks for more within its bounds") {
  std::uint32_t state = 7;  // xorshift: the same answers in every run
  const auto next = [&state] {
    state ^= state << 13U;
    state ^= state >> 17U;
    state ^= state << 5U;
    return state;
  };
  for (int run = 0; run < 3000; ++run) {
    SdoUpload upload(device_name, 100);
    SdoBytes answer{static_cast<std::uint8_t>(0x40U + next() % 16U), 0x08, 0x10, 0x00,
                    static_cast<std::uint8_t>(next() % 120U)};
    int frames = 0;
    for (bool open = true; open; ++frames) {
      REQUIRE(frames < 2000);
      REQUIRE(upload.next(0));
      upload.on_frame(ByteView(answer).first(next() % 50 == 0 ? next() % 9 : 8), 0);
      open = !upload.ended();
      if (!open) {
        const auto& result = upload.result();
        CHECK(result.data.size() <= 100);
        CHECK((result.kind == Kind::violation) == !result.detail.empty());
        break;
      }
      // Mostly a segment with the right toggle bit.
      const std::uint32_t toggle = frames % 2 == 0 ? 0x00U : 0x10U;
      answer[0] = static_cast<std::uint8_t>(
          next() % 20 == 0 ? next() : (toggle | (next() % 8U) << 1U | (next() % 10 == 0 ? 1U : 0U)));
    }
  }
}
