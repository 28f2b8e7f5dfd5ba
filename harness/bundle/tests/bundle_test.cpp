// SPDX-License-Identifier: Apache-2.0
// What was sealed is found good and comes out as it went in; what anybody did to it since is told.
#include <sys/stat.h>

#include "bundle/tests/archives.hpp"

using namespace conform;
using namespace conform::bundle;
using namespace conform::bundle::tests;

namespace {

using Told = std::vector<std::string>;

const std::vector<Raw> files{{"a.txt", "first"}, {"b/c.txt", "second"}, {"d.bin", std::string(100'000, 'x')}};

std::vector<Content> contents_of(const std::vector<Raw>& raw) {
  std::vector<Content> out;
  for (const auto& each : raw) out.push_back({each.name, "report", each.content});
  return out;
}

std::string sealed(const std::vector<Content>& contents) {
  auto bytes =
      seal({.tool = "canopen-conform 0", .run = {.verdict = "conforms", .started_utc_ns = 5'000'000'000}},
           contents, nullptr);
  REQUIRE(bytes);
  return {bytes->begin(), bytes->end()};
}

std::string content(const std::string& path) {
  auto text = read_file(path, largest_file);
  REQUIRE(text);
  return *text;
}

}  // namespace

TEST_CASE("what was sealed is good, and comes out as it went in") {
  const Folder folder;
  const auto bytes = sealed(contents_of(files));
  const auto found = verified(folder, bytes);
  CHECK(found.good());
  CHECK(told(found) == Told{});
  CHECK(found.right_files == 3);
  CHECK(found.bytes == 100'011);
  CHECK(found.manifest.run.verdict == "conforms");
  CHECK(found.signature == Verification::Signature::none);
  const auto out = folder / "out";
  REQUIRE(extract(folder / "x.tar.zst", nullptr, out));
  for (const auto& each : files) CHECK(content(out + "/" + each.name) == each.content);
  CHECK(content(out + "/MANIFEST.json") == to_json(found.manifest));
  CHECK_FALSE(fs::exists(out + "/MANIFEST.sig"));
}

TEST_CASE("the same files give the same bytes, in whatever order they are given") {
  auto contents = contents_of(files);
  const auto bytes = sealed(contents);
  std::ranges::reverse(contents);
  CHECK(sealed(contents) == bytes);
}

TEST_CASE("names that a tar cannot hold in its header are held all the same") {
  const Folder folder;
  const auto name = std::string(150, 'n') + "/" + std::string(70, 'm');
  CHECK(verified(folder, sealed({{name, "report", "text"}})).good());
}

TEST_CASE("what cannot be verified is not sealed") {
  CHECK_FALSE(seal({}, {{"../a", "report", ""}}, nullptr));
  CHECK_FALSE(seal({}, {{"a", "report", ""}, {"a", "report", ""}}, nullptr));
  CHECK_FALSE(seal({}, {{"a", "report", ""}, {"a/b", "report", ""}}, nullptr));
  CHECK_FALSE(seal({}, {{"MANIFEST.json", "report", ""}}, nullptr));
}

TEST_CASE("every kind of tampering is told by its name") {
  const Folder folder;
  auto entries = entries_of(files);
  REQUIRE(verified(folder, packed(entries)).good());

  SECTION("a byte of a file is another one") {
    entries[2].content[0] = 'S';
    CHECK(told(verified(folder, packed(entries))) == Told{"changed b/c.txt"});
  }
  SECTION("a file is longer") {
    entries[2].content += "!";
    CHECK(told(verified(folder, packed(entries))) == Told{"changed b/c.txt"});
  }
  SECTION("a file is removed") {
    entries.erase(entries.begin() + 1);
    CHECK(told(verified(folder, packed(entries))) == Told{"missing a.txt"});
  }
  SECTION("a file is added") {
    entries.push_back({"z.txt", "more"});
    CHECK(told(verified(folder, packed(entries))) == Told{"extra z.txt"});
  }
  SECTION("a file is renamed") {
    entries[1].name = "a2.txt";
    CHECK(told(verified(folder, packed(entries))) == Told{"extra a2.txt", "missing a.txt"});
  }
  SECTION("a file is there twice, and the second one would be unpacked over the first") {
    entries.push_back({"a.txt", "other"});
    CHECK(told(verified(folder, packed(entries))) == Told{"repeated a.txt"});
  }
  SECTION("the manifest is there twice") {
    entries.push_back(entries[0]);
    CHECK(told(verified(folder, packed(entries))) == Told{"repeated MANIFEST.json"});
  }
  SECTION("a signature is added that the manifest does not tell of") {
    entries.insert(entries.begin() + 1, {"MANIFEST.sig", std::string(64, 's')});
    CHECK(told(verified(folder, packed(entries))) == Told{"extra MANIFEST.sig"});
  }
  SECTION("the digest in the manifest is another one") {
    const auto digest = sha256(std::string_view("second"));
    auto& manifest = entries[0].content;
    manifest.replace(manifest.find(digest), 1, digest[0] == '0' ? "1" : "0");
    CHECK(told(verified(folder, packed(entries))) == Told{"changed b/c.txt"});
  }
  SECTION("the manifest is broken") {
    entries[0].content.resize(entries[0].content.size() - 10);
    CHECK(told(verified(folder, packed(entries))) == Told{"manifest MANIFEST.json"});
  }
  SECTION("the files change places, and nothing else") {
    std::swap(entries[1], entries[2]);
    CHECK(verified(folder, packed(entries)).good());
  }
  SECTION("something is behind the end") {
    const auto hidden = packed(entries, false) + packed({{"hidden.txt", "hidden"}}, false);
    CHECK(told(verified(folder, compressed(hidden))) == Told{"extra hidden.txt"});
    CHECK_FALSE(
        verified(folder, packed(entries) + compressed("no tar, but many bytes more " + std::string(600, 'b')))
            .good());
    CHECK_FALSE(verified(folder, packed(entries) + "no zstd").good());
  }
  const auto found = verified(folder, packed(entries));
  if (found.good()) return;
  CHECK_FALSE(extract(folder / "x.tar.zst", nullptr, folder / "out"));
  CHECK_FALSE(fs::exists(folder / "out"));
  CHECK(std::distance(fs::directory_iterator(folder / "."), fs::directory_iterator{}) == 1);
}

TEST_CASE("what is no bundle is not called tampered") {
  const Folder folder;
  for (const auto& bytes : {std::string(), std::string("text"), packed(entries_of(files), false), packed({}),
                            packed({{"a.txt", "a"}}), packed({{"MANIFEST.json", "{\"files\":[]}"}}),
                            packed({{"MANIFEST.json", "{\"canopen_conform_bundle\":99}"}}),
                            packed({{"MANIFEST.json", "", AE_IFLNK, "/etc/passwd"}})}) {
    const auto found = verified(folder, bytes);
    CHECK_FALSE(found.good());
    CHECK_FALSE(found.not_a_bundle.empty());
  }
  CHECK_FALSE(verify(folder / "none", nullptr));
  CHECK_FALSE(verify(folder / ".", nullptr));
}

TEST_CASE("a bundle that is cut anywhere is not good") {
  const Folder folder;
  const auto bytes = sealed(contents_of(files));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    INFO(size << " of " << bytes.size() << " bytes");
    CHECK_FALSE(verified(folder, bytes.substr(0, size)).good());
  }
}

TEST_CASE("a byte that is changed anywhere is found, or changes nothing of any file") {
  const Folder folder;
  const std::vector<Raw> few{{"a.txt", "first"}, {"b/c.txt", "second"}};
  const auto bytes = sealed(contents_of(few));
  std::size_t silent = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int bit : {0x01, 0x10, 0x80}) {
      auto spoilt = bytes;
      spoilt[i] = static_cast<char>(spoilt[i] ^ bit);
      if (!verified(folder, spoilt).good()) continue;
      INFO("byte " << i);
      ++silent;
      const auto out = folder / "out";
      REQUIRE(extract(folder / "x.tar.zst", nullptr, out));
      for (const auto& each : few) CHECK(content(out + "/" + each.name) == each.content);
      fs::remove_all(out);
    }
  }
  // Rights and times in the headers of the tar, which tell nothing.
  CHECK(silent < bytes.size() / 2);
}

TEST_CASE("a place that holds no sealed bundle yet is not good, and gives back what is in it") {
  const Folder folder;
  const auto bytes =
      seal({.sealed = false, .not_sealed = "the run has not ended", .tool = "t"},
           {{"inputs/profile/device.yaml", "profile", "node: 5"}, {"r", "report", "r"}}, nullptr);
  REQUIRE(bytes);
  const auto found = verified(folder, {bytes->begin(), bytes->end()});
  CHECK_FALSE(found.good());
  CHECK(found.problems.empty());
  CHECK(found.manifest.not_sealed == "the run has not ended");
  CHECK_FALSE(extract(folder / "x.tar.zst", nullptr, folder / "out"));
  const auto inputs = contents(folder / "x.tar.zst", {"profile", "suite"});
  REQUIRE(inputs);
  REQUIRE(inputs->size() == 1);
  CHECK(inputs->front().name == "inputs/profile/device.yaml");
  CHECK(inputs->front().bytes == "node: 5");
}

TEST_CASE("nothing is unpacked over what is there") {
  const Folder folder;
  static_cast<void>(verified(folder, sealed(contents_of(files))));
  const auto bundle = folder / "x.tar.zst";
  REQUIRE(fs::create_directories(folder / "out/old"));
  CHECK_FALSE(extract(bundle, nullptr, folder / "out"));
  CHECK_FALSE(extract(bundle, nullptr, bundle));
  CHECK_FALSE(extract(bundle, nullptr, ""));
  CHECK_FALSE(extract(bundle, nullptr, folder / "no/such/folder"));
  fs::create_symlink(folder / "out", folder / "link");
  CHECK_FALSE(extract(bundle, nullptr, folder / "link"));
  fs::remove(folder / "out/old");
  CHECK(extract(bundle, nullptr, folder / "out/"));
  CHECK(content(folder / "out/a.txt") == "first");
}
