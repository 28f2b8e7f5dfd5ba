// SPDX-License-Identifier: Apache-2.0
// 1010h, 1011h and the storage file (CiA 301, 7.5.2.13 and 7.5.2.14).
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

namespace {

/// A storage that cannot be written.
class BrokenStorage final : public Storage {
  conform::Result<void> write(const Images&) override { return conform::fail("broken"); }
};

struct TemporaryFile {
  std::string name = "refnode-storage-" + std::to_string(::getpid()) + ".txt";
  ~TemporaryFile() { std::remove(name.c_str()); }
};

void change_all(Bench& bench) {
  bench.sdo("2B 17 10 00 D0 07 00 00");
  bench.sdo("2F 06 62 01 00 00 00 00");
  bench.sdo("23 07 20 00 2A 00 00 00");
}

// The values of 1017h, 6206h:01 and 2007h as SDO responses.
std::string values(Bench& bench) {
  return bench.sdo("40 17 10 00 00 00 00 00").substr(12, 5) + " / " +
         bench.sdo("40 06 62 01 00 00 00 00").substr(12, 2) + " / " +
         bench.sdo("40 07 20 00 00 00 00 00").substr(12, 2);
}

void reset_node(Bench& bench) {
  bench.send("000: 81 05");
  bench.wait(100ms);
}

}  // namespace

TEST_CASE("Capabilities are told, signatures are checked to the byte") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 10 10 00 00 00 00 00") == "4F 10 10 00 03 00 00 00");
  CHECK(bench.sdo("40 10 10 01 00 00 00 00") == "43 10 10 01 01 00 00 00");
  CHECK(bench.sdo("40 11 10 01 00 00 00 00") == "43 11 10 01 01 00 00 00");
  for (const char* wrong : {"00 00 00 00", "65 76 61 73", "53 41 56 45", "6C 6F 61 64", "01 00 00 00"}) {
    CHECK(bench.sdo("23 10 10 01 " + std::string(wrong)) == "80 10 10 01 20 00 00 08");
  }
  CHECK(bench.sdo("23 11 10 01 73 61 76 65") == "80 11 10 01 20 00 00 08");
  CHECK(bench.sdo("2B 10 10 01 73 61 00 00") == "80 10 10 01 13 00 07 06");
  CHECK(bench.sdo("40 10 10 80 00 00 00 00") == "80 10 10 80 11 00 09 06");
}

TEST_CASE("Without save nothing is kept, with save everything is") {
  Bench bench;
  bench.wait(100ms);
  change_all(bench);
  reset_node(bench);
  CHECK(values(bench) == "00 00 / FF / 00");
  change_all(bench);
  CHECK(bench.sdo("23 10 10 01 73 61 76 65") == "60 10 10 01 00 00 00 00");
  reset_node(bench);
  CHECK(values(bench) == "D0 07 / 00 / 2A");
}

TEST_CASE("Sub-indices 02h and 03h store their own parameters only") {
  Bench communication;
  communication.wait(100ms);
  change_all(communication);
  CHECK(communication.sdo("23 10 10 02 73 61 76 65") == "60 10 10 02 00 00 00 00");
  reset_node(communication);
  CHECK(values(communication) == "D0 07 / FF / 00");

  Bench application;
  application.wait(100ms);
  change_all(application);
  CHECK(application.sdo("23 10 10 03 73 61 76 65") == "60 10 10 03 00 00 00 00");
  reset_node(application);
  CHECK(values(application) == "00 00 / 00 / 00");
}

TEST_CASE("Load takes effect with the reset, each sub-index for its own parameters") {
  Bench bench;
  bench.wait(100ms);
  change_all(bench);
  bench.sdo("23 10 10 01 73 61 76 65");
  CHECK(bench.sdo("23 11 10 02 6C 6F 61 64") == "60 11 10 02 00 00 00 00");
  CHECK(values(bench) == "D0 07 / 00 / 2A");
  bench.send("000: 82 05");
  bench.wait(100ms);
  CHECK(values(bench) == "00 00 / 00 / 2A");
  CHECK(bench.sdo("23 11 10 03 6C 6F 61 64") == "60 11 10 03 00 00 00 00");
  reset_node(bench);
  CHECK(values(bench) == "00 00 / FF / 2A");
  CHECK(bench.sdo("23 11 10 01 6C 6F 61 64") == "60 11 10 01 00 00 00 00");
  reset_node(bench);
  CHECK(values(bench) == "00 00 / FF / 00");
}

TEST_CASE("What is stored without a command never undoes load before the reset") {
  for (const char* variant : {"1010-autonomous", "1010-autonomous-at-once"}) {
    CAPTURE(variant);
    Bench bench(Bench::Wanted{{5, {}, {}, {}, {variant}, {}}});
    bench.wait(100ms);
    change_all(bench);
    bench.sdo("23 11 10 01 6C 6F 61 64");
    bench.sdo("2F 06 62 01 01 00 00 00");
    bench.wait(6s);
    reset_node(bench);
    CHECK(values(bench) == "00 00 / FF / 00");
    // With the reset it begins again.
    change_all(bench);
    bench.wait(6s);
    reset_node(bench);
    CHECK(values(bench) == "D0 07 / 00 / 2A");
    // A command stores, whatever was to be restored.
    bench.sdo("23 11 10 01 6C 6F 61 64");
    bench.sdo("23 10 10 01 73 61 76 65");
    reset_node(bench);
    CHECK(values(bench) == "D0 07 / 00 / 2A");
  }
}

TEST_CASE("A failure of the memory is a hardware error and changes nothing") {
  Bench bench({}, std::make_shared<BrokenStorage>());
  bench.wait(100ms);
  change_all(bench);
  CHECK(bench.sdo("23 10 10 01 73 61 76 65") == "80 10 10 01 00 00 06 06");
  CHECK(bench.sdo("23 11 10 01 6C 6F 61 64") == "80 11 10 01 00 00 06 06");
  reset_node(bench);
  CHECK(values(bench) == "00 00 / FF / 00");
}

TEST_CASE("A storage file outlives the node") {
  TemporaryFile file;
  {
    auto storage = FileStorage::open(file.name);
    REQUIRE(storage.has_value());
    Bench bench({}, *storage);
    bench.wait(100ms);
    change_all(bench);
    bench.sdo("23 10 10 01 73 61 76 65");
  }
  auto storage = FileStorage::open(file.name);
  REQUIRE(storage.has_value());
  Bench bench({}, *storage);
  bench.wait(100ms);
  CHECK(values(bench) == "D0 07 / 00 / 2A");
}

TEST_CASE("A damaged storage file is refused with its line") {
  TemporaryFile file;
  for (const char* content :
       {"", "something else\n", "canopen-refnode storage 1\n[communication]\n1017h:00 = E8 03\n",
        "canopen-refnode storage 1\n[nobody]\nend\n",
        "canopen-refnode storage 1\n[application]\n6206h:01 = 0\nend\n"}) {
    std::ofstream(file.name, std::ios::trunc) << content;
    const auto storage = FileStorage::open(file.name);
    INFO(content);
    REQUIRE_FALSE(storage.has_value());
    CHECK(storage.error().where.starts_with(file.name + ":"));
  }
}

TEST_CASE("While the storage fault is armed storing and restoring fail and change nothing") {
  Bench bench;
  bench.wait(100ms);
  change_all(bench);
  CHECK(bench.sdo("2F 20 2F 00 01 00 00 00") == "60 20 2F 00 00 00 00 00");
  for (const char* sub : {"01", "02", "03"}) {
    CHECK(bench.sdo("23 10 10 " + std::string(sub) + " 73 61 76 65") ==
          "80 10 10 " + std::string(sub) + " 00 00 06 06");
    CHECK(bench.sdo("23 11 10 " + std::string(sub) + " 6C 6F 61 64") ==
          "80 11 10 " + std::string(sub) + " 00 00 06 06");
  }
  // A wrong signature is refused as such before the memory is touched.
  CHECK(bench.sdo("23 10 10 01 00 00 00 00") == "80 10 10 01 20 00 00 08");
  CHECK(bench.sdo("2F 20 2F 00 00 00 00 00") == "60 20 2F 00 00 00 00 00");
  CHECK(bench.sdo("23 10 10 01 73 61 76 65") == "60 10 10 01 00 00 00 00");
  const std::string stored = values(bench);
  bench.sdo("2F 20 2F 00 01 00 00 00");
  CHECK(bench.sdo("23 11 10 01 6C 6F 61 64") == "80 11 10 01 00 00 06 06");
  reset_node(bench);
  CHECK(values(bench) == stored);
}

TEST_CASE("The storage fault outlives reset communication, and neither reset node nor the memory") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 20 2F 00 00 00 00 00") == "4F 20 2F 00 00 00 00 00");
  bench.sdo("2F 20 2F 00 02 00 00 00");
  bench.send("000: 82 05");
  bench.wait(100ms);
  CHECK(bench.sdo("40 20 2F 00 00 00 00 00") == "4F 20 2F 00 02 00 00 00");
  reset_node(bench);
  CHECK(bench.sdo("40 20 2F 00 00 00 00 00") == "4F 20 2F 00 00 00 00 00");
}
