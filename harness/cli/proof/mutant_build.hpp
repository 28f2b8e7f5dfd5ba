// SPDX-License-Identifier: Apache-2.0
// A build of the reference node that holds all its mutants (reference-node/mutants). Only the program
// canopen-conform-mutants has one.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

namespace conform::cli {

/// One place of the reference node that can be made wrong.
struct Mutant {
  std::uint32_t number;   ///< from 1
  std::string_view file;  ///< below reference-node: "sdo/server.cpp"
  int line;
  std::string_view function;  ///< "SdoServer::serve"
  std::string_view kind;      ///< the operator: "comparison", "statement", ...
  std::string_view original;  ///< the expression or statement, on one line
  std::string_view mutated;

  [[nodiscard]] std::string_view room() const { return file.substr(0, file.find('/')); }
};

struct MutantBuild {
  std::span<const Mutant> mutants;
  std::size_t dropped;  ///< that did not compile
  /// From now on the node has this fault, and no other; 0: none.
  std::function<void(std::uint32_t)> turn_on;
  /// Whether the place of a mutant has been passed since the program began.
  std::function<bool(std::uint32_t)> reached;
  std::string_view explained;  ///< path of the file with the reasons of survivors
};

/// Null in every program but canopen-conform-mutants.
[[nodiscard]] const MutantBuild* mutant_build();

}  // namespace conform::cli
