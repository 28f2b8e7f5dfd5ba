// SPDX-License-Identifier: Apache-2.0
// Block transfers of the client, frame by frame and against a scripted server.
#include <deque>

#include "base/random.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/sdo_block_download.hpp"
#include "canopen/sdo_block_upload.hpp"
#include "canopen/sdo_request.hpp"
#include "canopen/tests/scripted_server.hpp"
#include "catch.hpp"

using namespace conform;
using namespace conform::canopen;
using conform::testing::ScriptedServer;

namespace {

using Kind = TransferResult::Kind;
constexpr Multiplexer buffer{Index(0x2010), SubIndex(0)};
constexpr Multiplexer heartbeat_time{Index(0x1017), SubIndex(0)};

Bytes counting(std::size_t size) {
  Bytes out(size);
  std::uint64_t state = 5;
  for (auto& byte : out) byte = static_cast<std::uint8_t>(next_random(state));
  return out;
}

SdoBytes send(SdoClient& client) {
  const auto frame = client.next(0);
  REQUIRE(frame);
  return frame->bytes;
}

/// Carries frames both ways until the transfer has ended; silence where nobody has anything to say.
TransferResult play(SdoClient& client, ScriptedServer& server) {
  std::deque<ScriptedServer::Frame> back;
  for (int budget = 0; budget < 100'000 && !client.ended(); ++budget) {
    if (const auto frame = client.next(0)) {
      for (const auto& answer : server.on_request(frame->bytes.data(), frame->size)) back.push_back(answer);
    } else if (!back.empty()) {
      const auto answer = back.front();
      back.pop_front();
      client.on_frame(answer, 0);
    } else {
      client.on_silence();
    }
  }
  REQUIRE(client.ended());
  return client.take();
}

TransferResult play(const SdoRequest& request, ScriptedServer& server) {
  auto client = make_sdo_client(request);
  REQUIRE(client);
  return play(**client, server);
}

SdoRequest with(SdoRequest request, std::initializer_list<const char*> faults) {
  for (const auto* text : faults) {
    auto fault = SdoFault::parse(text);
    INFO(text);
    REQUIRE(fault);
    request.faults.push_back(*fault);
  }
  return request;
}

SdoRequest upload() { return {.upload = true, .object = buffer, .block = true}; }
SdoRequest download(std::size_t size) {
  return {.upload = false, .object = buffer, .data = counting(size), .block = true};
}

}  // namespace

TEST_CASE("The CRC is that of the standard's example") {
  CHECK(block_crc(Bytes{'1', '2', '3', '4', '5', '6', '7', '8', '9'}) == 0x31C3);
  CHECK(block_crc(Bytes{0xE8, 0x03}) == 0xA978);
  CHECK(block_crc({}) == 0);
}

TEST_CASE("The CRC of data in pieces is that of the whole") {
  const auto first = block_crc(Bytes{'1', '2', '3'});
  CHECK(block_crc(first, Bytes{'4', '5', '6', '7', '8', '9'}) == 0x31C3);
  CHECK(block_crc(0x31C3, {}) == 0x31C3);
}

TEST_CASE("A block download runs through initiate, segments, acknowledge and end") {
  SdoBlockDownload client(heartbeat_time, {0xE8, 0x03}, {});
  CHECK(send(client) == SdoBytes{0xC6, 0x17, 0x10, 0x00, 2});
  CHECK(client.on_frame(SdoBytes{0xA4, 0x17, 0x10, 0x00, 20}, 0));
  CHECK(send(client) == SdoBytes{0x81, 0xE8, 0x03});
  CHECK_FALSE(client.next(0));
  CHECK(client.on_frame(SdoBytes{0xA2, 1, 20}, 0));
  CHECK(send(client) == SdoBytes{0xD5, 0x78, 0xA9});
  CHECK(client.on_frame(SdoBytes{0xA1}, 0));
  REQUIRE(client.ended());
  const auto& result = client.result();
  CHECK(result.kind == Kind::confirmed);
  CHECK(result.counts.segments == 1);
  CHECK(result.counts.acks == 1);
  CHECK(result.counts.first_ackseq == std::uint8_t{1});
  CHECK(result.counts.blksize == std::uint8_t{20});
  CHECK(result.counts.crc_agreed == true);
  CHECK(result.remarks.empty());
}

TEST_CASE("A block upload runs through initiate, start, segments, acknowledge, end and confirmation") {
  SdoBlockUpload client(buffer, {.blksize = 20, .crc = false});
  CHECK(send(client) == SdoBytes{0xA0, 0x10, 0x20, 0x00, 20});
  CHECK(client.on_frame(SdoBytes{0xC2, 0x10, 0x20, 0x00, 9}, 0));
  CHECK(send(client) == SdoBytes{0xA3});
  CHECK(client.on_frame(SdoBytes{0x01, 1, 2, 3, 4, 5, 6, 7}, 0));
  CHECK_FALSE(client.next(0));
  CHECK(client.on_frame(SdoBytes{0x82, 8, 9}, 0));
  CHECK(send(client) == SdoBytes{0xA2, 2, 20});
  CHECK(client.on_frame(SdoBytes{0xD5}, 0));
  CHECK(send(client) == SdoBytes{0xA1});
  REQUIRE(client.ended());
  const auto& result = client.result();
  CHECK(result.kind == Kind::confirmed);
  CHECK(result.data == Bytes{1, 2, 3, 4, 5, 6, 7, 8, 9});
  CHECK(result.announced_size == 9U);
  CHECK(result.counts.crc_agreed == false);
  CHECK_FALSE(result.counts.crc_ok.has_value());
  CHECK(result.counts.unused == std::uint8_t{5});
}

TEST_CASE("Data of every length go down and come back unchanged, whatever the block size") {
  for (const auto blksize : Bytes{1, 2, 3, 7, 127}) {
    for (std::size_t size = 0; size < 40; ++size) {
      ScriptedServer server;
      server.blksizes = {blksize};
      INFO(size << " bytes, " << int(blksize) << " per block");
      const auto request = download(size);
      const auto down = play(request, server);
      CHECK(down.kind == Kind::confirmed);
      CHECK(server.data == request.data);
      auto back = upload();
      back.blksize = blksize;
      const auto up = play(back, server);
      CHECK(up.kind == Kind::confirmed);
      CHECK(up.data == request.data);
      CHECK(up.counts.crc_ok == true);
      CHECK(up.counts.retransmitted == 0);
    }
  }
}

TEST_CASE("The block size of each acknowledge is the length of the next sub-block") {
  ScriptedServer server;
  server.blksizes = {2, 1, 3};
  const auto request = download(7 * 8);
  const auto result = play(request, server);
  CHECK(result.kind == Kind::confirmed);
  CHECK(server.data == request.data);
  CHECK(result.counts.sub_blocks == 4);  // 2, 1, 3, 2
  CHECK(result.counts.acks == 4);
}

TEST_CASE("The block size of the last acknowledge is of no sub-block, and may be 0") {
  SdoBlockDownload client(heartbeat_time, {0xE8, 0x03}, {});
  static_cast<void>(send(client));
  client.on_frame(SdoBytes{0xA4, 0x17, 0x10, 0x00, 20}, 0);
  static_cast<void>(send(client));
  CHECK(client.on_frame(SdoBytes{0xA2, 1, 0}, 0));
  CHECK(send(client) == SdoBytes{0xD5, 0x78, 0xA9});
  client.on_frame(SdoBytes{0xA1}, 0);
  CHECK(client.result().kind == Kind::confirmed);

  SdoBlockDownload unfinished(buffer, counting(20), {});
  static_cast<void>(send(unfinished));
  unfinished.on_frame(SdoBytes{0xA4, 0x10, 0x20, 0x00, 2}, 0);
  static_cast<void>(send(unfinished));
  static_cast<void>(send(unfinished));
  unfinished.on_frame(SdoBytes{0xA2, 2, 0}, 0);
  CHECK(unfinished.result().kind == Kind::violation);
  CHECK(unfinished.result().reply == abort::block_size);
}

TEST_CASE("A lost segment is sent again after the acknowledge of the one before") {
  for (const bool at_once : {false, true}) {
    ScriptedServer server;
    server.acks_gaps_at_once = at_once;
    const auto request = with(download(50), {"lose segment 2"});
    const auto result = play(request, server);
    INFO(result.detail);
    CHECK(result.kind == Kind::confirmed);
    CHECK(server.data == request.data);
    CHECK(result.counts.first_ackseq == std::uint8_t{1});
    CHECK(result.counts.retransmitted >= 2);
  }
}

TEST_CASE("Repeated and swapped segments are sorted out by acknowledge and retransmission") {
  for (const auto* fault : {"repeat segment 3", "swap segments 2 and 4", "number segment 3 as 9"}) {
    ScriptedServer server;
    const auto request = with(download(50), {fault});
    const auto result = play(request, server);
    INFO(fault << ": " << result.detail);
    CHECK(result.kind == Kind::confirmed);
    CHECK(server.data == request.data);
  }
}

TEST_CASE("Swapped segments change places and keep their numbers") {
  auto client = make_sdo_client(with(download(28), {"swap segments 1 and 3"}));
  REQUIRE(client);
  static_cast<void>(send(**client));
  (*client)->on_frame(SdoBytes{0xA0, 0x10, 0x20, 0x00, 4}, 0);
  std::vector<int> numbers;
  while (const auto frame = (*client)->next(0)) numbers.push_back(frame->bytes[0]);
  CHECK(numbers == std::vector<int>{3, 2, 1, 0x84});
}

TEST_CASE("Segments that are not in one sub-block cannot be swapped, which is no verdict") {
  ScriptedServer server;
  server.blksizes = {2};
  const auto result = play(with(download(50), {"swap segments 2 and 3"}), server);
  CHECK(result.misplaced == "'swap segments 2 and 3': they are not in one sub-block");
}

TEST_CASE("A server may abort in the middle of a sub-block") {
  ScriptedServer server;
  server.abort_at_segment = 3;
  SdoBlockDownload client(buffer, counting(100), {});
  const auto initiate = send(client);
  client.on_frame(server.on_request(initiate.data(), 8).front(), 0);
  for (int i = 0; i < 3; ++i) {
    const auto answers = server.on_request(send(client).data(), 8);
    if (!answers.empty()) client.on_frame(answers.front(), 0);
  }
  REQUIRE(client.ended());
  CHECK(client.result().kind == Kind::aborted);
  CHECK(client.result().code == abort::cannot_store);
  CHECK_FALSE(client.next(0));
}

TEST_CASE("A server that knows no block transfer need not name the object when it refuses it") {
  const SdoBytes unknown{0x80, 0, 0, 0, 0x01, 0x00, 0x04, 0x05};
  const SdoBytes no_object{0x80, 0, 0, 0, 0x00, 0x00, 0x02, 0x06};
  const auto refused = [](SdoClient& client, const SdoBytes& answer) {
    static_cast<void>(send(client));
    CHECK(client.on_frame(answer, 0));
    REQUIRE(client.ended());
    return client.take();
  };
  SdoBlockUpload up(buffer, {.blksize = 20, .crc = false});
  const auto upload_refused = refused(up, unknown);
  CHECK(upload_refused.kind == Kind::aborted);
  CHECK(upload_refused.code == abort::command_specifier);
  SdoBlockDownload down(heartbeat_time, {0xE8, 0x03}, {});
  const auto download_refused = refused(down, unknown);
  CHECK(download_refused.kind == Kind::aborted);
  CHECK(download_refused.code == abort::command_specifier);
  // Another code is about an object, and a transfer that has begun has one.
  SdoBlockUpload other(buffer, {.blksize = 20, .crc = false});
  CHECK(refused(other, no_object).kind == Kind::violation);
  SdoBlockDownload begun(heartbeat_time, {0xE8, 0x03}, {});
  static_cast<void>(send(begun));
  CHECK(begun.on_frame(SdoBytes{0xA4, 0x17, 0x10, 0x00, 20}, 0));
  CHECK(refused(begun, unknown).kind == Kind::violation);
}

TEST_CASE("A wrong CRC is refused, and a CRC that was not agreed is not looked at") {
  ScriptedServer server;
  CHECK(play(with(download(30), {"wrong crc"}), server).code == abort::crc);
  CHECK(server.written == 0);
  server.crc = false;
  const auto result = play(with(download(30), {"wrong crc"}), server);
  CHECK(result.kind == Kind::confirmed);
  CHECK(result.counts.crc_agreed == false);
}

TEST_CASE("A partial acknowledge makes the server repeat the rest of an upload") {
  for (const auto* fault : {"acknowledge 1 in sub-block 1", "acknowledge 0 in sub-block 1", "lose segment 3",
                            "lose segment 8", "blksize 2 from sub-block 2"}) {
    ScriptedServer server;
    server.data = counting(7 * 12 + 3);
    auto request = with(upload(), {fault});
    request.blksize = 8;
    const auto result = play(request, server);
    INFO(fault << ": " << result.detail << result.misplaced);
    CHECK(result.kind == Kind::confirmed);
    CHECK(result.misplaced.empty());
    CHECK(result.data == server.data);
    CHECK(result.counts.crc_ok == true);
    CHECK((result.counts.retransmitted > 0) == (std::string_view(fault).substr(0, 7) != "blksize"));
    CHECK(result.counts.wrong_numbers == 0);
  }
}

TEST_CASE("Illegal block sizes and acknowledges are refused with their codes") {
  ScriptedServer server;
  server.data = counting(100);
  for (const auto blksize : Bytes{0, 128, 255}) {
    auto request = upload();
    request.blksize = blksize;
    CHECK(play(request, server).code == abort::block_size);
  }
  auto request = with(upload(), {"blksize 128 from sub-block 2"});
  request.blksize = 4;
  CHECK(play(request, server).code == abort::block_size);
  CHECK(play(with(upload(), {"acknowledge 128 in sub-block 1"}), server).code == abort::sequence_number);
}

TEST_CASE("A server may switch to the normal upload only where the threshold allows it") {
  ScriptedServer server;
  server.data = {1, 2, 3, 4};
  server.switches = true;
  auto request = upload();
  request.pst = 4;
  const auto result = play(request, server);
  CHECK(result.kind == Kind::confirmed);
  CHECK(result.counts.switched);
  CHECK(result.data == server.data);
  CHECK_FALSE(play(upload(), server).counts.switched);
  SdoBlockUpload never(buffer, {});
  static_cast<void>(send(never));
  never.on_frame(SdoBytes{0x43, 0x10, 0x20, 0x00, 1, 2, 3, 4}, 0);
  CHECK(never.result().detail ==
        "answers with command 43h where a block upload response (C0h, C2h, C4h or C6h) is due");
  SdoBlockUpload above(buffer, {.pst = 3});
  static_cast<void>(send(above));
  above.on_frame(SdoBytes{0x43, 0x10, 0x20, 0x00, 1, 2, 3, 4}, 0);
  CHECK(above.result().detail == "switches to the normal upload for 4 bytes, above the threshold of 3");
}

TEST_CASE("A sub-block that stops is acknowledged with what has come, so often and no more") {
  ScriptedServer server;
  server.data = counting(7 * 4);
  server.most_sent_at_once = 2;
  const auto result = play(upload(), server);
  CHECK(result.kind == Kind::confirmed);
  CHECK(result.data == server.data);
  CHECK(result.counts.timeouts == 1);
  server.data = counting(7 * 20);
  const auto cut = play(upload(), server);
  CHECK(cut.kind == Kind::silence);
  CHECK(cut.counts.timeouts == 3);
  CHECK(cut.reply == abort::timed_out);
}

namespace {

/// A block upload of which the initiate is over, with blksize segments per block.
SdoBlockUpload started(std::uint8_t blksize, std::uint8_t size) {
  SdoBlockUpload client(buffer, {.blksize = blksize});
  static_cast<void>(send(client));
  client.on_frame(SdoBytes{0xC6, 0x10, 0x20, 0x00, size}, 0);
  static_cast<void>(send(client));
  return client;
}

}  // namespace

TEST_CASE("Deviations of the server end a block upload with a sentence that says which") {
  auto gap = started(8, 100);
  gap.on_frame(SdoBytes{1}, 0);
  gap.on_frame(SdoBytes{2}, 0);
  gap.on_frame(SdoBytes{5}, 0);
  CHECK(gap.result().detail == "answers segment 3 with sequence number 5 instead of 3");
  CHECK(gap.result().reply == abort::sequence_number);
  CHECK(gap.result().counts.wrong_numbers == 1);

  auto overrun = started(1, 100);
  overrun.on_frame(SdoBytes{1}, 0);
  REQUIRE(overrun.next(0));
  overrun.on_frame(SdoBytes{2}, 1);
  CHECK(overrun.result().detail == "sends another frame (02h) before its sub-block is acknowledged");

  auto longer = started(8, 5);
  longer.on_frame(SdoBytes{1}, 0);
  longer.on_frame(SdoBytes{2}, 0);
  CHECK(longer.result().detail == "sends segment 2, 5 bytes were announced");

  auto crc = started(8, 7);
  crc.on_frame(SdoBytes{0x81, 1, 2, 3, 4, 5, 6, 7}, 0);
  REQUIRE(crc.next(0));
  crc.on_frame(SdoBytes{0xC1, 0x34, 0x12}, 0);
  CHECK(crc.result().kind == Kind::violation);
  CHECK(crc.result().reply == abort::crc);
  CHECK(crc.result().counts.crc_ok == false);

  auto size = started(8, 7);
  size.on_frame(SdoBytes{0x81, 1, 2, 3, 4, 5, 6, 7}, 0);
  REQUIRE(size.next(0));
  size.on_frame(SdoBytes{0xC5}, 0);
  CHECK(size.result().detail == "delivers 6 bytes, 7 were announced");

  SdoBlockUpload early(buffer, {});
  static_cast<void>(send(early));
  early.on_frame(SdoBytes{0xC6, 0x10, 0x20, 0x00, 50}, 0);
  early.on_frame(SdoBytes{1}, 0);
  CHECK(early.result().detail == "sends a frame (01h) before the start of the block upload");
}

TEST_CASE("Other bytes in a retransmission are a violation") {
  auto request = with(upload(), {"acknowledge 0 in sub-block 1"});
  request.blksize = 2;
  auto client = make_sdo_client(request);
  REQUIRE(client);
  static_cast<void>(send(**client));
  (*client)->on_frame(SdoBytes{0xC6, 0x10, 0x20, 0x00, 100}, 0);
  static_cast<void>(send(**client));
  (*client)->on_frame(SdoBytes{1, 1}, 0);
  (*client)->on_frame(SdoBytes{2, 2}, 0);
  CHECK(send(**client) == SdoBytes{0xA2, 0, 2});
  (*client)->on_frame(SdoBytes{1, 3}, 0);
  CHECK((*client)->result().detail == "sends other bytes when segment 1 is sent once more");
}

TEST_CASE("An upload is cut at its bound, and memory follows what has come") {
  SdoBlockUpload client(buffer, {.max_bytes = 20});
  static_cast<void>(send(client));
  client.on_frame(SdoBytes{0xC6, 0x10, 0x20, 0x00, 0xFF, 0xFF, 0xFF, 0xFF}, 0);
  static_cast<void>(send(client));
  CHECK(client.result().data.capacity() < 100);
  for (std::uint8_t i = 1; i < 20 && !client.ended(); ++i) client.on_frame(SdoBytes{i}, 0);
  CHECK(client.result().detail == "delivers more than 20 bytes");
  CHECK(client.result().reply == abort::out_of_memory);
}

TEST_CASE("Deviations of the server end a block download with a sentence that says which") {
  const auto begun = [](std::uint8_t blksize) {
    SdoBlockDownload client(buffer, counting(50), {});
    static_cast<void>(send(client));
    client.on_frame(SdoBytes{0xA4, 0x10, 0x20, 0x00, blksize}, 0);
    while (client.next(0)) continue;
    return client;
  };
  CHECK(begun(0).result().detail == "asks for 0 segments per block, 1 to 127 are allowed");
  CHECK(begun(128).result().reply == abort::block_size);
  auto beyond = begun(5);
  beyond.on_frame(SdoBytes{0xA2, 6, 5}, 0);
  CHECK(beyond.result().detail == "acknowledges segment 6 of a sub-block of which 5 were sent");
  auto command = begun(5);
  command.on_frame(SdoBytes{0xA1}, 0);
  CHECK(command.result().detail ==
        "answers with command A1h where an acknowledge of the sub-block (A2h) is due");
  auto never = begun(5);
  for (int i = 0; i < 10 && !never.ended(); ++i) {
    never.on_frame(SdoBytes{0xA2, 0, 5}, 0);
    while (never.next(0)) continue;
  }
  CHECK(never.result().detail == "takes no segment in 4 sub-blocks one after the other");
}

TEST_CASE("An acknowledge in the middle of a sub-block waits for what is on its way") {
  SdoBlockDownload client(buffer, counting(70), {});
  static_cast<void>(send(client));
  client.on_frame(SdoBytes{0xA4, 0x10, 0x20, 0x00, 10}, 0);
  for (int i = 0; i < 5; ++i) REQUIRE(client.next(0));
  CHECK(client.on_frame(SdoBytes{0xA2, 1, 10}, 2));
  CHECK_FALSE(client.next(2));
  CHECK(send(client)[0] == 1);
  CHECK(client.result().counts.retransmitted == 1);
  // Only one of it is out: an acknowledge that came before it cannot mean it.
  CHECK_FALSE(client.on_frame(SdoBytes{0xA2, 0, 10}, 1));
  CHECK(client.result().counts.acks == 2);
}

TEST_CASE("Whatever a server answers, a block transfer ends within its bounds") {
  std::uint64_t state = 11;
  for (int run = 0; run < 4000; ++run) {
    auto request = run % 2 == 0 ? upload() : download(60);
    request.blksize = 5;
    request.max_bytes = 200;
    if (run % 3 == 0)
      request = with(request, {run % 2 == 0 ? "acknowledge 1 in sub-block 1" : "lose segment 2"});
    auto made = make_sdo_client(request);
    REQUIRE(made);
    auto& client = **made;
    int frames = 0;
    for (; !client.ended(); ++frames) {
      REQUIRE(frames < 20'000);
      if (client.next(0)) continue;
      const auto random = next_random(state);
      if (random % 50 == 0) {
        client.on_silence();
        continue;
      }
      static constexpr std::uint8_t likely[] = {0xC6, 0xC0, 0xA4, 0xA2, 0xA1, 0xC1, 0xD5,
                                                0x01, 0x02, 0x81, 0x82, 3,    4,    5};
      SdoBytes answer{likely[random % std::size(likely)], 0x10, 0x20, 0x00,
                      static_cast<std::uint8_t>((random >> 8U) % 40U)};
      if (answer[0] == 0xA2) answer = {0xA2, static_cast<std::uint8_t>((random >> 16U) % 4U), 5};
      client.on_frame(ByteView(answer).first((random >> 24U) % 60 == 0 ? 5 : 8),
                      (random >> 32U) % 8 == 0 ? 1 : 0);
    }
    CHECK(client.result().data.size() <= 210);
    CHECK((client.result().kind == Kind::violation) == !client.result().detail.empty());
  }
}
