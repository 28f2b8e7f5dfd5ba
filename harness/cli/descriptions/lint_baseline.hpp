// SPDX-License-Identifier: Apache-2.0
// Findings that were there when the lint was introduced: known, not told again, and told when they are gone.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "cli/descriptions/eds_formats.hpp"

namespace conform::cli {

/// As it stands in the file: paths are relative to the folder of the baseline, with '/'.
class LintBaseline {
 public:
  /// A file that does not exist is empty if `may_be_new`. Wrong is what is no baseline.
  [[nodiscard]] static Result<LintBaseline> read(const std::string& path, bool may_be_new);

  /// Takes what is known out of the report, and counts it; what is gone is listed. Both are of no concern
  /// for a file that could not be read.
  void apply(EdsLinted& file) const;
  /// What files are gone altogether, for the entries of which nobody looks any more.
  [[nodiscard]] std::vector<std::string> missing_files() const;

  /// What the file has is known from now on. Entries of files that do not exist any more are dropped.
  void take(const EdsLinted& file);
  void drop_missing();
  [[nodiscard]] Result<void> write() const;
  [[nodiscard]] std::size_t count() const;

 private:
  struct Known {
    std::string code, place, message;
  };

  [[nodiscard]] std::string key_of(const std::string& file) const;
  [[nodiscard]] bool exists(const std::string& key) const;

  std::string path_;
  std::map<std::string, std::map<std::string, Known>> files_;  ///< path -> fingerprint -> finding
};

}  // namespace conform::cli
