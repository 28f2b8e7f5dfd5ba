// SPDX-License-Identifier: Apache-2.0
// What two runs saw of a device that is no verdict: other answers, other entries, another identity.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/strong.hpp"
#include "result/run_result.hpp"

namespace conform::result {

/// A step that came out otherwise.
struct ObservedChange {
  const CaseResult* where = nullptr;  ///< of the new run
  std::string requirement;
  std::string step;  ///< in words, of the new run
  std::string before, after;
};

/// A named value that is another one; empty: it was not there.
struct ValueChange {
  std::string name;
  std::string before, after;
};

/// Parts of the object dictionary, CiA 301 table 37.
enum class Area : unsigned char { other, communication, manufacturer, profile };
[[nodiscard]] Area area_of(Index index);
/// "manufacturer-specific (2000h-5FFFh)"
[[nodiscard]] std::string_view to_string(Area area);

/// An entry that holds another value, or is there in one of the runs only: then the other text is empty.
struct EntryChange {
  Multiplexer object;
  std::string before, after;
  /// What machines measure and do is no difference of the device. Such a value is told, but does not count.
  bool is_process = false;
};

/// A scenario that was played for other objects than before, although no sample was drawn.
struct InstancesChange {
  std::string id;
  std::vector<std::string> gone, added;  ///< instances
};

/// Deciding steps, and findings that both runs have, whose answer is of another kind or another abort code.
[[nodiscard]] std::vector<ObservedChange> observed_changes(const RunResult& before, const RunResult& after);
/// Entries of the whole dictionary, as far as both runs looked at them in the same way: by the same upload,
/// or before they were changed; absent is what the device said to be. What a device changes by itself
/// (errors, clocks) is left out. A value that was only read, outside of the communication profile, or that
/// belongs to a device profile may be one of the process; one that did not stay the same within a run is left
/// out.
[[nodiscard]] std::vector<EntryChange> entry_changes(const RunResult& before, const RunResult& after);
[[nodiscard]] std::vector<InstancesChange> instance_changes(const RunResult& before, const RunResult& after);
/// Properties that begin with one of `prefixes`.
[[nodiscard]] std::vector<ValueChange> property_changes(const RunResult& before, const RunResult& after,
                                                        const std::vector<std::string>& prefixes);

}  // namespace conform::result
