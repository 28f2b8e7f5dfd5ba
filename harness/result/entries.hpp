// SPDX-License-Identifier: Apache-2.0
// What the cases of a run say of single entries of the object dictionary: which of them are about an entry,
// and in what it is other than it is said to be.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "result/run_result.hpp"

namespace conform::result {

/// Something about an entry that is not as it should be.
struct EntryDifference {
  /// "presence", "access", "length", "type", "limits", "default", "PDO mapping"; "rule": another one.
  std::string_view aspect;
  std::string requirement;            ///< empty: what the survey saw, whatever was judged
  const CaseResult* where = nullptr;  ///< that found it; nullptr: the survey
  Verdict verdict = Verdict::fail;
  std::string came;  ///< in words: "abort 0602 0000h (object does not exist)"
};

struct JudgedEntry {
  std::vector<EntryDifference> differing;  ///< each requirement once, with the worst that was found
  std::vector<const CaseResult*> cases;    ///< played for this entry and judged, in the order of the run
};

/// Entries that a case was played for, that a finding is about, or that the survey found otherwise than
/// described (run.dictionary). Waived findings count. Points into the run.
[[nodiscard]] std::map<Multiplexer, JudgedEntry> judged_entries(const RunResult& run);

}  // namespace conform::result
