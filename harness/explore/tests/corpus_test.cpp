// SPDX-License-Identifier: Apache-2.0
#include "explore/corpus.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include "catch.hpp"

#include "explore/tests/device.hpp"

using namespace conform;
using namespace conform::explore;

namespace {

const NodeId node(5);

Error error_of(const std::string& text) {
  const auto parsed = parse_corpus_text(text, "x.txt", node);
  REQUIRE(!parsed);
  return parsed.error();
}

}  // namespace

TEST_CASE("a kept conversation is read as it was written") {
  auto by_block = upload({Index(0x1008), SubIndex(0)}, Transfer::block);
  by_block.blksize = 3;
  by_block.fault = "lose segment 2";
  auto answered = can::data_frame(CanId(0x605), {0x40, 0, 0x10, 0, 0, 0, 0, 0});
  answered.extended = true;
  const Conversation all{upload({Index(0x1018), SubIndex(1)}),
                         by_block,
                         download({Index(0x1017), SubIndex(0)}, {0xE8, 3}, Transfer::segmented_unsized),
                         download({Index(0x1026), SubIndex(1)}, {}),
                         nmt(node, 0x81),
                         frame(can::remote_frame(CanId(0x705), 1)),
                         frame(can::data_frame(CanId(0x080), {})),
                         request(answered),
                         {.kind = Action::Kind::power},
                         wait(std::chrono::milliseconds(1100))};
  const auto read = parse_corpus_text(corpus_text(all, node), "x.txt", node);
  REQUIRE(read);
  CHECK(*read == all);
}

TEST_CASE("what is drawn can be kept") {
  const auto words = words_of_the_standard();
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto text = corpus_text(draw(words, seed, 60), node);
    const auto read = parse_corpus_text(text, "x.txt", node);
    INFO((read ? std::string() : read.error().text()));
    REQUIRE(read);
    CHECK(corpus_text(*read, node) == text);
  }
}

TEST_CASE("a mistake in a kept conversation is told with its line") {
  CHECK(error_of("upload 1018h:01\n").text() ==
        "x.txt:1: the node is not named (node 5, before the actions)");
  CHECK(error_of("# a remark\n\nnode 5\nuplod 1018h:01\n").text() ==
        "x.txt:4: 'uplod' is no action (did you mean 'upload'?)");
  CHECK(error_of("node 6\n").text() ==
        "x.txt:1: the conversation is with node 6, and the device is node 5 (a corpus is for one node-ID)");
  for (const std::string line :
       {"upload", "upload 1018h:01 = 00", "download 1017h:00", "download 1017h:00 = E", "upload 1018h:01, so",
        "download 1017h:00 = 00, no end, wrong crc", "wait 3", "wait", "send", "send 800h",
        "send 701h remote 9", "send 000h 00 00 00 00 00 00 00 00 00", "power", "node 5",
        "upload 1018h:01, blksize 256"}) {
    INFO(line);
    CHECK(error_of("node 5\nwait 1 ms\n" + line + "\n").where == "x.txt:3");
  }
  CHECK(error_of("node 5\n").where == "x.txt");
}

TEST_CASE("a corpus grows by what is new, and is read in the same order each time") {
  const auto folder =
      (std::filesystem::temp_directory_path() / ("corpus_test_" + std::to_string(::getpid()))).string();
  const auto none = read_corpus(folder, node);
  REQUIRE(none);
  CHECK(none->empty());
  const std::vector<Conversation> two{{nmt(node, 1)}, {nmt(node, 2), wait(std::chrono::milliseconds(5))}};
  CHECK(add_to_corpus(folder, two, node) == 2U);
  CHECK(add_to_corpus(folder, two, node) == 0U);
  const auto read = read_corpus(folder, node);
  REQUIRE(read);
  CHECK(read->size() == 2);
  CHECK(read_corpus(folder, node) == *read);
  // What found something comes first.
  const std::vector<Conversation> found{{wait(std::chrono::milliseconds(9))}};
  CHECK(add_to_corpus(folder, found, node, true) == 1U);
  const auto then = read_corpus(folder, node);
  REQUIRE(then);
  CHECK(then->size() == 3);
  CHECK(then->front() == found.front());
  std::ofstream(folder + "/z.txt") << "node 5\nnothing\n";
  const auto wrong = read_corpus(folder, node);
  REQUIRE(!wrong);
  CHECK(wrong.error().where == folder + "/z.txt:2");
  std::filesystem::remove_all(folder);
}
