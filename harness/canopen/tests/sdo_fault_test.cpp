// SPDX-License-Identifier: Apache-2.0
// Faults on purpose: their phrases, and what goes out because of them.
#include "canopen/abort_code.hpp"
#include "canopen/sdo_request.hpp"
#include "catch.hpp"

using namespace conform;
using namespace conform::canopen;

namespace {

using Kind = TransferResult::Kind;
constexpr Multiplexer buffer{Index(0x2010), SubIndex(0)};

std::unique_ptr<SdoClient> client(SdoRequest request, std::initializer_list<const char*> faults) {
  request.object = buffer;
  for (const auto* text : faults) {
    auto fault = SdoFault::parse(text);
    INFO(text);
    REQUIRE(fault);
    request.faults.push_back(*fault);
  }
  auto made = make_sdo_client(request);
  INFO((made ? std::string() : made.error().text()));
  REQUIRE(made);
  return std::move(*made);
}

SdoFrame send(SdoClient& client) {
  const auto frame = client.next(0);
  REQUIRE(frame);
  return *frame;
}

std::string refused(SdoRequest request, const char* text) {
  request.object = buffer;
  auto fault = SdoFault::parse(text);
  REQUIRE(fault);
  request.faults.push_back(*fault);
  auto made = make_sdo_client(request);
  REQUIRE_FALSE(made);
  CHECK(made.error().of == Error::Of::scenario);
  return made.error().what;
}

const SdoRequest segmented{.upload = false, .data = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}};
const SdoRequest expedited{.upload = false, .data = {1, 2}};
const SdoRequest block_download{.upload = false, .data = Bytes(30), .block = true};
const SdoRequest upload{};
const SdoRequest block_upload{.block = true};

/// The answers of a server that confirms every segment of a segmented download.
SdoBytes ack(const SdoFrame& frame) {
  if (frame.part == SdoFrame::Part::initiate) return {0x60, 0x10, 0x20, 0x00};
  return {static_cast<std::uint8_t>(0x20U | (frame.bytes[0] & 0x10U))};
}

}  // namespace

TEST_CASE("Every phrase of the list is read") {
  for (const auto phrase : sdo_fault_phrases()) {
    std::string text(phrase);
    for (const auto& [letter, number] :
         {std::pair(" K", " 2"), {" L", " 3"}, {" S", " 4"}, {" B", " 5"}, {" N", " 6"}}) {
      for (auto at = text.find(letter); at != std::string::npos; at = text.find(letter, at + 2)) {
        if (at + 2 == text.size() || text[at + 2] == ' ') text.replace(at, 2, number);
      }
    }
    INFO(text);
    CHECK(SdoFault::parse(text));
  }
  CHECK(SdoFault::parse("lose segment 0Ah")->at == 10);
}

TEST_CASE("What is no phrase is refused with those that begin alike") {
  const auto unknown = SdoFault::parse("lose frame 2");
  REQUIRE_FALSE(unknown);
  CHECK(unknown.error().what == "unknown fault 'lose frame 2'");
  CHECK(unknown.error().hint == "known: lose segment K");
  CHECK_FALSE(SdoFault::parse("lose segment 0"));
  CHECK_FALSE(SdoFault::parse("number segment 1 as 128"));
  CHECK_FALSE(SdoFault::parse("blksize 3 from sub-block 1"));
  CHECK_FALSE(SdoFault::parse("swap segments 3 and 2"));
  CHECK_FALSE(SdoFault::parse(""));
}

TEST_CASE("A fault without a place in the transfer is a mistake of the scenario") {
  CHECK(refused(segmented, "lose segment 9") == "the transfer has 3 segments only: 'lose segment 9'");
  CHECK(refused(segmented, "abort after segment 3") ==
        "the transfer is over after segment 3: 'abort after segment 3'");
  CHECK(refused(segmented, "wrong crc") == "a download has no place for 'wrong crc'");
  CHECK(refused(expedited, "abort after segment 0") ==
        "the transfer has 0 segments only: 'abort after segment 0'");
  CHECK(refused(block_download, "wrong toggle in segment 1") ==
        "a block download has no place for 'wrong toggle in segment 1'");
  CHECK(refused(block_upload, "repeat segment 1") == "a block upload has no place for 'repeat segment 1'");
  CHECK(refused(upload, "no end") == "an upload has no place for 'no end'");
  CHECK(refused(block_download, "reserved bits in segment 1") ==
        "a block download has no place for 'reserved bits in segment 1'");
}

TEST_CASE("A fault that an upload did not reach is told when it has gone through") {
  auto made = client(upload, {"abort after segment 9"});
  static_cast<void>(send(*made));
  made->on_frame(SdoBytes{0x43, 0x10, 0x20, 0x00, 1, 2, 3, 4}, 0);
  REQUIRE(made->ended());
  CHECK(made->result().misplaced ==
        "the transfer has 0 segments only: 'abort after segment 9' has no place in it");
  auto refused_upload = client(upload, {"abort after segment 9"});
  static_cast<void>(send(*refused_upload));
  refused_upload->on_frame(SdoBytes{0x80, 0x10, 0x20, 0x00, 0, 0, 2, 6}, 0);
  CHECK(refused_upload->result().kind == Kind::aborted);
  CHECK(refused_upload->result().misplaced.empty());
}

TEST_CASE("A wrong toggle bit goes out once, and a server that takes it is seen to confirm") {
  auto made = client(segmented, {"wrong toggle in segment 2"});
  std::vector<int> commands;
  while (!made->ended()) {
    const auto frame = send(*made);
    commands.push_back(frame.bytes[0]);
    made->on_frame(ack(frame), 0);
  }
  CHECK(commands == std::vector<int>{0x21, 0x00, 0x00, 0x0D});
  CHECK(made->result().kind == Kind::confirmed);
}

TEST_CASE("A lost segment of a segmented download leaves a hole in the toggle bits") {
  auto made = client(segmented, {"lose segment 2"});
  made->on_frame(ack(send(*made)), 0);
  CHECK(send(*made).bytes == SdoBytes{0x00, 1, 2, 3, 4, 5, 6, 7});
  made->on_frame(SdoBytes{0x20}, 0);
  CHECK(send(*made).bytes == SdoBytes{0x0D, 15});
}

TEST_CASE("A segment that is lost with its wrong toggle bit is lost all the same") {
  auto made = client(segmented, {"wrong toggle in segment 2", "lose segment 2"});
  made->on_frame(ack(send(*made)), 0);
  CHECK(send(*made).bytes == SdoBytes{0x00, 1, 2, 3, 4, 5, 6, 7});
  made->on_frame(SdoBytes{0x20}, 0);
  CHECK(send(*made).bytes == SdoBytes{0x0D, 15});
  made->on_frame(SdoBytes{0x20}, 0);
  REQUIRE(made->ended());
  CHECK(made->result().kind == Kind::confirmed);
}

TEST_CASE("A segment sent again has the same toggle bit, and the abort is what counts") {
  auto made = client(segmented, {"repeat segment 1"});
  made->on_frame(ack(send(*made)), 0);
  const auto first = send(*made);
  made->on_frame(ack(first), 0);
  CHECK(send(*made).bytes == first.bytes);
  made->on_frame(SdoBytes{0x80, 0x10, 0x20, 0x00, 0, 0, 3, 5}, 0);
  REQUIRE(made->ended());
  CHECK(made->result().kind == Kind::aborted);
  CHECK(made->result().code == abort::toggle_bit);
}

TEST_CASE("Reserved bits, reserved bytes and short frames are made where they belong") {
  CHECK(send(*client(upload, {"reserved bits in initiate"})).bytes == SdoBytes{0x5F, 0x10, 0x20, 0x00});
  CHECK(send(*client(upload, {"reserved bytes in initiate"})).bytes ==
        SdoBytes{0x40, 0x10, 0x20, 0x00, 0xFF, 0xFF, 0xFF, 0xFF});
  CHECK(send(*client(block_upload, {"reserved bits in initiate"})).bytes ==
        SdoBytes{0xBC, 0x10, 0x20, 0x00, 127});
  CHECK(send(*client(block_download, {"reserved bits in initiate"})).bytes ==
        SdoBytes{0xDE, 0x10, 0x20, 0x00, 30});
  CHECK(send(*client(upload, {"short initiate"})).size == 7);
  auto made = client(segmented, {"short segment 2", "unused bytes 0"});
  std::vector<int> sizes;
  while (!made->ended()) {
    const auto frame = send(*made);
    sizes.push_back(frame.size);
    if (frame.last) CHECK(frame.bytes[0] == 0x01);
    made->on_frame(ack(frame), 0);
  }
  CHECK(sizes == std::vector<int>{8, 8, 7, 8});
}

TEST_CASE("The client aborts when the segment is behind it") {
  auto made = client(segmented, {"abort after segment 1"});
  made->on_frame(ack(send(*made)), 0);
  made->on_frame(ack(send(*made)), 0);
  CHECK(send(*made).bytes == SdoBytes{0x80, 0x10, 0x20, 0x00, 0, 0, 0, 8});
  REQUIRE(made->ended());
  CHECK(made->result().kind == Kind::gave_up);
  auto block = client(block_download, {"abort after segment 5"});
  static_cast<void>(send(*block));
  block->on_frame(SdoBytes{0xA0, 0x10, 0x20, 0x00, 127}, 0);
  for (int i = 0; i < 5; ++i) CHECK(send(*block).part == SdoFrame::Part::segment);
  CHECK_FALSE(block->next(0));  // the last one is behind it when it is acknowledged
  block->on_frame(SdoBytes{0xA2, 5, 127}, 0);
  CHECK(send(*block).part == SdoFrame::Part::abort);
  auto begun = client(block_upload, {"abort after segment 0"});
  static_cast<void>(send(*begun));
  begun->on_frame(SdoBytes{0xC6, 0x10, 0x20, 0x00, 50}, 0);
  CHECK(send(*begun).bytes[0] == 0x80);
}

TEST_CASE("After it fell silent the client hears an abort, and nothing else") {
  auto made = client(segmented, {"silence after segment 1"});
  made->on_frame(ack(send(*made)), 0);
  made->on_frame(ack(send(*made)), 0);
  CHECK_FALSE(made->next(0));
  CHECK(made->fell_silent());
  CHECK_FALSE(made->on_frame(SdoBytes{0x30}, 0));
  made->on_frame(SdoBytes{0x80, 0x10, 0x20, 0x00, 0, 0, 4, 5}, 0);
  REQUIRE(made->ended());
  CHECK(made->result().kind == Kind::aborted);
  CHECK(made->result().code == abort::timed_out);
  CHECK(made->result().counts.surplus == 1);
  auto quiet = client(segmented, {"no end"});
  for (int i = 0; i < 4; ++i) {
    const auto frame = send(*quiet);
    if (frame.last) CHECK(frame.bytes[0] == 0x0C);
    quiet->on_frame(ack(frame), 0);
  }
  CHECK_FALSE(quiet->next(0));
  quiet->on_silence();
  REQUIRE(quiet->ended());
  CHECK(quiet->result().kind == Kind::silence);
  CHECK(quiet->result().abandoned);
  CHECK_FALSE(quiet->result().reply.has_value());
}

TEST_CASE("A new initiate in the middle tells how it went, old segments aside") {
  auto made = client(block_upload, {"new initiate after segment 1"});
  static_cast<void>(send(*made));
  made->on_frame(SdoBytes{0xC6, 0x10, 0x20, 0x00, 50}, 0);
  static_cast<void>(send(*made));
  made->on_frame(SdoBytes{1, 1, 2, 3, 4, 5, 6, 7}, 0);
  CHECK(send(*made).bytes == SdoBytes{0x40, 0x00, 0x10, 0x00});
  CHECK_FALSE(made->on_frame(SdoBytes{2, 1, 2, 3, 4, 5, 6, 7}, 0));
  made->on_frame(SdoBytes{0x43, 0x00, 0x10, 0x00, 0x91, 0x01}, 0);
  REQUIRE(made->ended());
  CHECK(made->result().kind == Kind::confirmed);
  CHECK(made->result().data == Bytes{0x91, 0x01, 0, 0});
  CHECK(made->result().counts.surplus == 1);
}

TEST_CASE("The upload behind a new initiate may come in segments") {
  auto made = client(block_upload, {"new initiate after segment 1"});
  static_cast<void>(send(*made));
  made->on_frame(SdoBytes{0xC6, 0x10, 0x20, 0x00, 50}, 0);
  static_cast<void>(send(*made));
  made->on_frame(SdoBytes{1, 1, 2, 3, 4, 5, 6, 7}, 0);
  static_cast<void>(send(*made));
  made->on_frame(SdoBytes{0x41, 0x00, 0x10, 0x00, 4}, 0);
  CHECK(send(*made).bytes == SdoBytes{0x60});
  made->on_frame(SdoBytes{0x07, 0x91, 0x01, 0x0F, 0x00}, 0);
  REQUIRE(made->ended());
  CHECK(made->result().kind == Kind::confirmed);
  CHECK(made->result().data == Bytes{0x91, 0x01, 0x0F, 0});
  CHECK(made->result().counts.surplus == 0);
}

TEST_CASE("Another size than delivered is announced on request") {
  auto request = segmented;
  request.announced = 99;
  CHECK(send(*client(request, {})).bytes == SdoBytes{0x21, 0x10, 0x20, 0x00, 99});
  auto block = block_download;
  block.announced = 99;
  CHECK(send(*client(block, {})).bytes == SdoBytes{0xC6, 0x10, 0x20, 0x00, 99});
  auto unsized_block = block_download;
  unsized_block.size_told = false;
  CHECK(send(*client(unsized_block, {})).bytes == SdoBytes{0xC4, 0x10, 0x20, 0x00});
}
