// SPDX-License-Identifier: Apache-2.0
// Archives that want to do harm: names that lead out of the folder, links, devices, and sizes that lie.
#include <sys/resource.h>
#include <sys/wait.h>

#include "base/sanitizer.hpp"
#include "bundle/tests/archives.hpp"

using namespace conform;
using namespace conform::bundle;
using namespace conform::bundle::tests;

namespace {

using Told = std::vector<std::string>;

const std::vector<Raw> files{{"a.txt", "first"}};

/// In KiB, as much as this process ever had.
long most_memory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

}  // namespace

TEST_CASE("names that lead elsewhere are told, and nothing is unpacked") {
  const Folder folder;
  for (const auto* name : {"../evil", "/tmp/conform-evil", "a/../../evil", "./b.txt", "a\\b", "c:evil",
                           "x\x1B[2J", "caf\xC3\xA9", "\xFF\xFE", "a b"}) {
    INFO(name);
    auto entries = entries_of(files);
    entries.push_back({name, "evil"});
    const auto found = verified(folder, packed(entries));
    REQUIRE(found.problems.size() == 1);
    CHECK(found.problems[0].kind == Problem::Kind::unsafe_name);
    CHECK_FALSE(extract(folder / "x.tar.zst", nullptr, folder / "out"));
    CHECK_FALSE(fs::exists(folder / "out"));
  }
}

TEST_CASE("a manifest cannot make an unsafe name safe") {
  const Folder folder;
  const std::vector<Raw> evil{{"../evil", "evil"}};
  CHECK(told(verified(folder, packed(entries_of(evil)))) == Told{"manifest MANIFEST.json"});
}

TEST_CASE("links, folders and devices are no files of a bundle, even by a right name") {
  const Folder folder;
  for (const Raw& raw :
       {Raw{"a.txt", "", AE_IFLNK, "/etc/passwd"}, Raw{"a.txt", "", AE_IFREG, "MANIFEST.json", true},
        Raw{"a.txt", "", AE_IFDIR}, Raw{"a.txt", "", AE_IFCHR}, Raw{"a.txt", "", AE_IFBLK},
        Raw{"a.txt", "", AE_IFIFO}}) {
    auto entries = entries_of({{"a.txt", ""}});
    entries[1] = raw;
    INFO(raw.type);
    const auto found = told(verified(folder, packed(entries)));
    REQUIRE(found.size() == 2);
    CHECK(found[0].starts_with("not a file a.txt"));
    CHECK(found[1] == "missing a.txt");
  }
}

TEST_CASE("a link first and a file through it is not followed") {
  const Folder folder;
  auto entries = entries_of({{"dir/a.txt", "x"}});
  entries.insert(entries.begin() + 1, Raw{"dir", "", AE_IFLNK, folder / "."});
  CHECK_FALSE(verified(folder, packed(entries)).good());
  CHECK_FALSE(extract(folder / "x.tar.zst", nullptr, folder / "out"));
  CHECK_FALSE(fs::exists(folder / "a.txt"));
}

TEST_CASE("what is larger than its manifest says is not unpacked") {
  const Folder folder;
  const std::string much(std::size_t{64} << 20U, '\0');
  auto entries = entries_of(files);
  SECTION("by a file that the manifest does not name") {
    entries.push_back({"bomb", much});
    const auto found = told(verified(folder, packed(entries)));
    CHECK(found == Told{"extra bomb", "too large"});
  }
  SECTION("by a manifest that is too large itself") {
    entries[0].content += much;
    CHECK_FALSE(verified(folder, packed(entries)).good());
  }
  SECTION("by zeros behind the end, or between two files") {
    const auto tar = packed(entries, false);
    CHECK_FALSE(verified(folder, compressed(tar + much)).good());
    CHECK_FALSE(
        verified(folder, compressed(tar.substr(0, tar.size() - 1024) + much + packed({{"b", "b"}}, false)))
            .good());
  }
}

TEST_CASE("a small archive of gigabytes is an attack, and told before anything is unpacked") {
  const Folder folder;
  const std::string digest(64, 'a');
  Manifest manifest{.tool = "t",
                    .files = {{"a", "report", largest_file, digest}, {"b", "report", largest_file, digest}}};
  const auto found = verified(folder, packed({{"MANIFEST.json", to_json(manifest)}, {"a", "short"}}));
  REQUIRE(found.problems.size() == 1);
  CHECK(found.problems[0].kind == Problem::Kind::too_large);
}

TEST_CASE("what is packed twice is not unpacked twice") {
  const Folder folder;
  CHECK_FALSE(verified(folder, compressed(packed(entries_of(files)))).good());
}

TEST_CASE("memory does not depend on what is in a bundle") {
  const Folder folder;
  std::vector<Raw> large{{"large", std::string(std::size_t{200} << 20U, 'x')}};
  const auto bytes = packed(entries_of(large));
  large.clear();
  large.shrink_to_fit();
  CHECK(verified(folder, bytes).good());
  // A process of its own, for what this one has needed before counts as well.
  const auto child = ::fork();
  if (child == 0) {
    const auto before = most_memory();
    const bool good = verify(folder / "x.tar.zst", nullptr)->good();
    ::_exit(good && (address_sanitizer || most_memory() - before < 64L * 1024) ? 0 : 1);
  }
  int status = -1;
  REQUIRE(::waitpid(child, &status, 0) == child);
  CHECK(status == 0);
}

TEST_CASE("of very many wrong things the first ones are told") {
  const Folder folder;
  auto entries = entries_of(files);
  for (int i = 0; i < 1000; ++i) entries.push_back({"extra-" + std::to_string(i), ""});
  const auto found = verified(folder, packed(entries));
  CHECK_FALSE(found.good());
  CHECK(found.problems.size() < 40);
}
