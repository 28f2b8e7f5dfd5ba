// SPDX-License-Identifier: Apache-2.0
#include "bundle/manifest.hpp"
#include "bundle/digest.hpp"
#include "catch.hpp"

using namespace conform::bundle;

namespace {

const std::string digest(64, 'a');

Manifest with(std::vector<File> files) { return {.tool = "t", .files = std::move(files)}; }

}  // namespace

TEST_CASE("a manifest is read as it was written") {
  Manifest manifest = with({{"a", "report", 1, digest}, {"b/c", "suite", 22, digest}});
  manifest.run = {.verdict = "does not conform",
                  .exit_code = 1,
                  .aborted = "a \"reason\"",
                  .started_utc_ns = 12,
                  .elapsed_ns = 34,
                  .host = "h",
                  .device = "d",
                  .identity = {{"dut.name", "\xC3\xBC"}},
                  .requirements = {{"pass", 3}, {"fail", 1}}};
  manifest.signer = digest;
  manifest.left_out = {{"suites", "other ones"}};
  const auto text = to_json(manifest);
  const auto read = parse_manifest(text);
  REQUIRE(read);
  CHECK(to_json(*read) == text);
  CHECK(read->run.identity == manifest.run.identity);
  CHECK(read->run.requirements == manifest.run.requirements);
  CHECK(read->files[1].size == 22);
  // A line for each file, for who compares two of them.
  CHECK(text.find("\n{\"name\":\"b/c\",\"role\":\"suite\",\"size\":22,") != std::string::npos);
}

TEST_CASE("a manifest whose list of files cannot be trusted is broken") {
  const std::vector<std::vector<File>> lists{
      {{"b", "r", 1, digest}, {"a", "r", 1, digest}},
      {{"a", "r", 1, digest}, {"a", "r", 1, digest}},
      {{"a", "r", 1, digest}, {"a-b", "r", 1, digest}, {"a/b", "r", 1, digest}},
      {{"../a", "r", 1, digest}},
      {{"MANIFEST.sig", "r", 1, digest}},
      {{"a", "r", 1, "A" + digest.substr(1)}},
      {{"a", "r", 1, "aa"}},
      {{"a", "r", largest_file + 1, digest}},
      {{"a", "r", largest_file, digest}, {"b", "r", largest_file, digest}, {"c", "r", 1, digest}}};
  for (const auto& files : lists) {
    const auto read = parse_manifest(to_json(with(files)));
    REQUIRE_FALSE(read);
    CHECK_FALSE(read.error().foreign);
    CHECK_FALSE(read.error().what.empty());
  }
  CHECK(parse_manifest(to_json(with({}))));
  std::vector<File> many(most_files + 1, {"", "r", 1, digest});
  for (std::size_t i = 0; i < many.size(); ++i) many[i].name = std::to_string(100'000 + i);
  CHECK_FALSE(parse_manifest(to_json(with(many))));
  many.pop_back();
  const auto most = to_json(with(many));
  CHECK(parse_manifest(most));
  CHECK(most.size() < largest_manifest);
}

TEST_CASE("a manifest of another shape is broken, of another program or version foreign") {
  const auto text = to_json(with({{"a", "r", 7, digest}}));
  const auto changed = [&](const std::string& from, const std::string& to) {
    auto out = text;
    REQUIRE(out.find(from) != std::string::npos);
    return out.replace(out.find(from), from.size(), to);
  };
  for (const auto& broken :
       {changed("\"size\":7", "\"size\":-7"), changed("\"size\":7", "\"size\":7.5"),
        changed("\"size\":7", "\"size\":1e30"), changed("\"size\":7", "\"size\":\"7\""),
        changed("\"sealed\":true", "\"sealed\":1"), changed("\"files\"", "\"fills\""),
        changed("\n]\n}", "\n]"), changed("\"t\"", "\"\xFF\""),
        changed("\"left_out\":[]", "\"left_out\":" + std::string(1000, '[') + std::string(1000, ']'))}) {
    const auto read = parse_manifest(broken);
    REQUIRE_FALSE(read);
    CHECK_FALSE(read.error().foreign);
  }
  for (const auto& foreign :
       {std::string(), std::string("{}"), std::string("{\"a\":1}"), changed("bundle\":1", "bundle\":2"),
        changed("\"signature\":null", "\"signature\":{\"algorithm\":\"x\",\"key_sha256\":\"\"}")}) {
    const auto read = parse_manifest(foreign);
    REQUIRE_FALSE(read);
    CHECK(read.error().foreign);
  }
}

TEST_CASE("safe names are the same file everywhere") {
  for (const auto* name : {"a", "a/b.txt", "suites/cia301/a-b_c.yaml", "..a", "a..", "%2F", "a=1,2+3@4~"})
    CHECK(is_safe_name(name));
  for (const auto* name : {"", "/", "/a", "a/", "a//b", ".", "..", "a/../b", "../a", "a/..", "./a", "a\\b",
                           "c:a", "a b", "a\nb", "\x1B[1m", "\xC3\xBC", "a\x7F"})
    CHECK_FALSE(is_safe_name(name));
  CHECK_FALSE(is_safe_name(std::string_view("a\0b", 3)));
  CHECK_FALSE(is_safe_name(std::string(151, 'a')));
  CHECK_FALSE(is_safe_name(std::string(120, 'a') + "/" + std::string(120, 'a')));
}

TEST_CASE("any text becomes a safe part, and different ones stay different") {
  CHECK(safe_part("device.yaml") == "device.yaml");
  CHECK(safe_part("my device.eds") == "my%20device.eds");
  CHECK(safe_part("a%20b") == "a%2520b");
  CHECK(safe_part("..") == "_..");
  CHECK(safe_part("") == "_");
  for (int byte = 0; byte < 256; ++byte)
    CHECK(is_safe_name(safe_part(std::string(1, static_cast<char>(byte)))));
  CHECK(is_safe_name(safe_part(std::string(1000, '\xFF'))));
}

TEST_CASE("digests are those of FIPS 180-4") {
  CHECK(sha256(std::string_view()) == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256(std::string_view("abc")) ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}
