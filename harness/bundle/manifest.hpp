// SPDX-License-Identifier: Apache-2.0
// MANIFEST.json, the first file of a bundle: what the others are, and of which run. Its shape is
// manifest.schema.json, docs/bundle.md explains it.
#pragma once

#include <cstdint>
#include <expected>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace conform::bundle {

/// Changes when a reader of the older one would be misled.
inline constexpr int manifest_version = 1;
inline constexpr std::string_view manifest_name = "MANIFEST.json";
inline constexpr std::string_view signature_name = "MANIFEST.sig";

// What a bundle may hold at most. Who packs keeps to it as well as who unpacks: an archive of others must not
// eat the memory or the disk of who looks into it.
inline constexpr std::uint64_t largest_manifest = std::uint64_t{8} << 20U;
inline constexpr std::uint64_t largest_file = std::uint64_t{4} << 30U;
inline constexpr std::uint64_t largest_bundle = std::uint64_t{8} << 30U;
inline constexpr std::size_t most_files = 20'000;
/// A bundle of more than `suspicious_size` bytes is not this many times smaller when it is packed.
inline constexpr std::uint64_t most_packed = 1000;
inline constexpr std::uint64_t suspicious_size = std::uint64_t{256} << 20U;

struct File {
  std::string name;  ///< in the archive: "reports/junit.xml"
  std::string role;  ///< "report", "suite", ...: what it was to the run
  std::uint64_t size = 0;
  std::string sha256;  ///< 64 lower-case hexadecimal digits
};

/// Something a reader would look for and does not find.
struct LeftOut {
  std::string what, why;
};

/// What the manifest says about the run. The whole is in result.json.
struct RunFacts {
  std::string verdict;  ///< in words: "does not conform"
  int exit_code = 0;
  std::string aborted{};            ///< why it did not come to its end; empty: it did
  std::int64_t started_utc_ns = 0;  ///< 0 in simulation
  std::int64_t elapsed_ns = 0;      ///< bus time
  std::string host{};
  std::string device{};  ///< what it is called in headings
  /// Name and value: what the device says about itself, and what it is said to be.
  std::vector<std::pair<std::string, std::string>> identity{};
  std::vector<std::pair<std::string, std::uint64_t>> requirements{};  ///< how many are "pass", "fail", ...
};

struct Manifest {
  /// Not: it only holds the place of a bundle, and what is needed to make it, until the run has ended.
  bool sealed = true;
  std::string not_sealed{};  ///< why not
  std::string tool;          ///< "canopen-conform 0.1.0"
  RunFacts run{};
  std::string signer{};  ///< fingerprint of the public key; empty: it is not signed
  std::vector<LeftOut> left_out{};
  std::vector<File> files{};  ///< sorted by name, each once
};

/// One line per file. Texts that are no UTF-8 must have been made printable before.
[[nodiscard]] std::string to_json(const Manifest& manifest);

struct NoManifest {
  bool foreign = false;  ///< of another program or a later version; else it is one that is broken
  std::string what;
};
/// Holds the text to everything that is said above: names are safe, sorted, each there once, sizes within the
/// limits.
[[nodiscard]] std::expected<Manifest, NoManifest> parse_manifest(std::string_view text);

/// A relative path that names the same file wherever it is unpacked: letters, digits and . _ - + @ = % , ~ in
/// parts that are neither empty nor "." or "..", none longer than 150 bytes, all of it at most 230.
[[nodiscard]] bool is_safe_name(std::string_view name);
/// `text` as one such part: other bytes as %XX, and what is too long cut.
[[nodiscard]] std::string safe_part(std::string_view text);

}  // namespace conform::bundle
