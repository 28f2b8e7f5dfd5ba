// SPDX-License-Identifier: Apache-2.0
// From bytes to a checked tree. YAML's traps (duplicate keys, anchors, tags, words that readers take for
// booleans, octal and sexagesimal numbers) are refused here with the reason. Two parsers read: libyaml
// quickly what is right, yaml-cpp all else.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "yaml/diagnostic.hpp"
#include "yaml/node.hpp"
#include "yaml/source.hpp"

namespace conform::yaml {

/// yaml-cpp takes about 240 bytes for each open bracket: with this limit no text makes it take 256 MB.
inline constexpr std::size_t max_file_size = 1'000'000;
inline constexpr std::size_t max_nodes = 100'000;
inline constexpr int max_depth = 64;

/// Parses the source that `diagnostics` collects for. A tree comes back whenever the syntax allows one, even
/// with errors reported, so that the caller can report its own as well: ask diagnostics.has_errors() before
/// using the result.
[[nodiscard]] std::optional<Node> load(const Source& source, Diagnostics& diagnostics);

/// Reads a regular file of at most max_file_size; anything else (missing, directory, device, pipe) is an
/// Error. `name` is what messages call the file; empty means `path`.
[[nodiscard]] Result<SourcePtr> read_source(const std::string& path, std::string name = {});

struct Document {
  SourcePtr source;
  Diagnostics diagnostics;
  std::optional<Node> root;
};

/// read_source() and load(). The Error is about the file as a whole; what is in it is in `diagnostics`.
[[nodiscard]] Result<Document> load_file(const std::string& path, std::string name = {});

/// Such a file and what messages call it; an empty name means `path`.
struct NamedFile {
  std::string path, name;
};
/// Takes what it needs from the tree of the file with this number.
using UseTree = std::function<void(std::size_t number, const Node& root, Diagnostics& diagnostics)>;
/// The same for many, which are read on all cores. `use` is called there, for several files at once, and the
/// trees are gone then.
[[nodiscard]] std::vector<Result<Document>> load_files(const std::vector<NamedFile>& files,
                                                       const UseTree& use);

/// Reports a plain scalar on which YAML readers disagree (yes, 010, 12:30, 2.10, ...); true when it is
/// harmless. load() has applied it to every key and value.
bool check_plain(const Node& scalar, Diagnostics& diagnostics);

}  // namespace conform::yaml
