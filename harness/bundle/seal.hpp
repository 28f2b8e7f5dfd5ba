// SPDX-License-Identifier: Apache-2.0
// A bundle: a tar in zstd with everything that a run was made of and led to. First MANIFEST.json with a
// digest of every other file, then its signature, if it is signed, then the files by their names.
#pragma once

#include <string>
#include <vector>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "bundle/keys.hpp"
#include "bundle/manifest.hpp"

namespace conform::bundle {

struct Content {
  std::string name;  ///< in the archive; is_safe_name() holds
  std::string role;
  std::string bytes;
};

/// The bytes of the archive, the same for the same arguments. `manifest` says all but the files and the
/// signer, which follow from `contents` (in any order, each name once) and `key` (nullptr: not signed).
/// Error: more than a bundle may hold.
[[nodiscard]] Result<Bytes> seal(Manifest manifest, const std::vector<Content>& contents,
                                 const PrivateKey* key);

}  // namespace conform::bundle
