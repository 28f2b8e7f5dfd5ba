// SPDX-License-Identifier: Apache-2.0
// One pass over a bundle: everything is held against the manifest, and the bytes go where the caller wants
// them.
#pragma once

#include <string>

#include "bundle/verify.hpp"

namespace conform::bundle {

/// Takes the files of a bundle as they come, before it is known whether they are right.
class Sink {
 public:
  Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;
  virtual ~Sink() = default;

  /// The manifest has been read. It may be that of a stranger.
  virtual void manifest(std::string_view /*text*/, ByteView /*signature*/) {}
  /// A file that the manifest names begins; its size is the one the manifest says.
  [[nodiscard]] virtual Result<void> begin(const File& file) = 0;
  [[nodiscard]] virtual Result<void> add(ByteView bytes) = 0;
  /// All of it came, and it is right.
  [[nodiscard]] virtual Result<void> end() = 0;
};

/// Error: the file cannot be read, or what the sink says. `sink`: nullptr where the bytes are of no use.
[[nodiscard]] Result<Verification> walk(const std::string& path, const PublicKey* key, Sink* sink);

}  // namespace conform::bundle
