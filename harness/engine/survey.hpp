// SPDX-License-Identifier: Apache-2.0
// What the look at the dictionary at the start of a run saw, for reports.
#pragma once

#include <map>
#include <vector>

#include "device/profile.hpp"
#include "result/run_result.hpp"
#include "steps/session.hpp"

namespace conform::engine {

class Survey {
 public:
  /// The answer to an upload of the entry; of a long value only the beginning is kept.
  void note(Multiplexer object, const steps::SdoAnswer& answer);
  /// Its object is not there.
  void note_absent(Multiplexer object, const steps::SdoAnswer& answer);

  /// A row for each entry of `known` (what is there, or is said to be), in ascending order; as many as
  /// `most_rows`. `profile` tells where each is described.
  [[nodiscard]] std::vector<result::EntryFacts> rows(const device::Dictionary& known,
                                                     const device::Profile& profile) const;
  static constexpr std::size_t most_rows = 20'000;

 private:
  struct Seen {
    steps::SdoAnswer answer;
    std::size_t size = 0;
    bool absent = false;
  };
  void describe(const Seen& seen, const device::Entry& entry, result::EntryFacts& into) const;

  std::map<Multiplexer, Seen> seen_;
};

}  // namespace conform::engine
