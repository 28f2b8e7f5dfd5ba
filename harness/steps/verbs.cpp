// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "steps/verb_tables.hpp"

namespace conform::steps {

std::span<const Verb> verbs() {
  static const std::vector<Verb> all = [] {
    std::vector<Verb> out;
    for (const auto table :
         {sdo_verbs(), interleave_verbs(), segment_verbs(), conversation_verbs(), nmt_verbs(), frame_verbs(),
          collect_verbs(), noise_verbs(), guard_verbs(), error_verbs(), pdo_verbs(), ready_verbs(),
          lss_verbs(), description_verbs(), flow_verbs()}) {
      out.insert(out.end(), table.begin(), table.end());
    }
    return out;
  }();
  return all;
}

const Verb* find_verb(std::string_view name) {
  const auto found = std::ranges::find(verbs(), name, &Verb::name);
  return found == verbs().end() ? nullptr : &*found;
}

}  // namespace conform::steps
