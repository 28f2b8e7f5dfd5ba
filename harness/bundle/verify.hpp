// SPDX-License-Identifier: Apache-2.0
// Whether a bundle is what was sealed. Whoever made it may be hostile: what it says about itself is held to
// limits before anything is unpacked, and nothing is written before all of it is right.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "bundle/keys.hpp"
#include "bundle/manifest.hpp"
#include "bundle/seal.hpp"

namespace conform::bundle {

struct Problem {
  enum class Kind : std::uint8_t {
    changed,      ///< a file has other bytes than those that were sealed
    missing,      ///< the manifest names it, and it is not there
    extra,        ///< it is there, and the manifest does not name it
    repeated,     ///< it is there again
    unsafe_name,  ///< it would be unpacked elsewhere, or where names are read in another way
    not_a_file,   ///< a link, a folder, a device
    manifest,     ///< the manifest itself is broken
    signature,    ///< there is none, or not that of the given key
    damaged,      ///< the archive cannot be read to its end
    too_large,    ///< more comes out of it than its manifest tells of, or than any bundle may hold
  };
  Kind kind = Kind::changed;
  std::string name;  ///< of the file; empty: it is about the whole
  std::string what;  ///< in words; may hold what a stranger wrote
};
/// "changed", "unsafe name": as it is shown.
[[nodiscard]] std::string_view to_string(Problem::Kind kind);

struct Verification {
  enum class Signature : std::uint8_t {
    none,       ///< it is not signed, and no key was given
    unchecked,  ///< it is signed, and no key was given
    good,       ///< by the given key
    wrong,      ///< a key was given, and this is not its signature, or there is none
  };
  std::string not_a_bundle{};  ///< why it is none at all; nothing else is said then
  Manifest manifest{};         ///< what it says of itself
  Signature signature = Signature::none;
  std::vector<Problem> problems{};  ///< in the order in which they were found
  std::size_t right_files = 0;      ///< whose digests were compared and are right
  std::uint64_t bytes = 0;          ///< of these

  /// It is what was sealed, when a run had ended.
  [[nodiscard]] bool good() const { return not_a_bundle.empty() && manifest.sealed && problems.empty(); }
};
[[nodiscard]] std::string_view to_string(Verification::Signature signature);

/// Reads all of it once; takes a few megabytes of memory, whatever is in it. `key`: nullptr where no
/// signature is asked for. Error: the file cannot be read.
[[nodiscard]] Result<Verification> verify(const std::string& path, const PublicKey* key);

/// Unpacks into `folder`, which does not exist or is empty, and only when all is as good as `verify` found it
/// (called once more): the folder appears as a whole, or it does not. Error: it is not good, or the folder
/// cannot be written.
[[nodiscard]] Result<void> extract(const std::string& path, const PublicKey* key, const std::string& folder);
/// Whether extract() would take it: it does not exist, or is an empty folder.
[[nodiscard]] Result<void> is_free(const std::string& folder);

/// Those files of a bundle, sealed or not, that have one of these roles, with `manifest` where the caller
/// wants it. Error: it is none, or a file is not as the manifest says.
[[nodiscard]] Result<std::vector<Content>> contents(const std::string& path,
                                                    const std::vector<std::string_view>& roles,
                                                    Manifest* manifest = nullptr);

}  // namespace conform::bundle
