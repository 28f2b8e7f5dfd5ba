// SPDX-License-Identifier: Apache-2.0
// A journal as it was left, by a run that ended or by one that was killed.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "journal/writer.hpp"
#include "result/run_result.hpp"

namespace conform::journal {

struct Journal {
  std::string path;  ///< where it was read from, whatever led there
  Header header;
  /// As far as it came. Where the run was killed, `aborted` says so, and the case that was running says so,
  /// too.
  result::RunResult run;
  bool finished = false;              ///< the run came to its end, be it by a stop request
  bool reported = false;              ///< and its reports were made
  std::vector<OldValue> outstanding;  ///< in the order in which they were changed
  std::vector<OldValue> changed;      ///< all that the run changed, put back or not: what was there at first
  bool recovered = false;             ///< it was killed, and what it left has been dealt with since
  /// Commands that the interrupted case gave (1010h "save" and the like): what they did no value tells.
  std::vector<Multiplexer> commands;
};

/// A line at the end that was not completed is left out.
[[nodiscard]] Result<Journal> parse(std::string_view text, const std::string& where);
/// Follows a file that only says where the journal is.
[[nodiscard]] Result<Journal> read(const std::string& path);
/// The same of a file whose content was read already.
[[nodiscard]] Result<Journal> read(const std::string& path, std::string_view text);

/// What stands in place of a journal that the user wants elsewhere, so that the next run finds it.
[[nodiscard]] std::string pointer_to(const std::string& path);

}  // namespace conform::journal
