// SPDX-License-Identifier: Apache-2.0
// `given`: the entry of the device that a scenario works with. How many bytes an entry takes is found out by
// writing them: what it holds at the moment says little, a DOMAIN may be empty or read back with a length of
// its own.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/run_session.hpp"
#include "result/run_result.hpp"
#include "scenario/query.hpp"

namespace conform::engine {

/// The entry, or why there is none.
struct Given {
  std::optional<Multiplexer> object;
  std::string why_not;
  std::vector<result::Want> wants;
};

class Givens {
 public:
  /// `may_write`: the tier of the run lets it write to entries that the profile calls safe, whatever the
  /// scenario itself does.
  Givens(RunSession& session, bool may_write) : session_(session), may_write_(may_write) {}

  /// Of several entries that fit the one that holds most (up to what is quickly read).
  [[nodiscard]] Result<Given> find(const std::string& text);

 private:
  /// How an entry behaves when it is written.
  struct Store {
    std::uint64_t takes = 0;               ///< most bytes that were read back as they had been written
    std::optional<std::uint64_t> refused;  ///< fewest bytes that were not
    std::string why;                       ///< what came then
    bool window = false;                   ///< of a fixed length: what was written stands at its beginning
  };
  using Candidates = std::vector<std::pair<Multiplexer, std::uint64_t>>;  ///< with the bytes each holds

  [[nodiscard]] Result<Candidates> candidates(const scenario::Query& query);
  [[nodiscard]] Result<bool> stores(Multiplexer object, std::uint64_t size);
  [[nodiscard]] Result<std::optional<Multiplexer>> writable(const scenario::Query& query,
                                                            const Candidates& all);
  [[nodiscard]] Result<std::optional<Multiplexer>> readable(const scenario::Query& query,
                                                            const Candidates& all);
  [[nodiscard]] bool may_fill(Multiplexer object) const;
  [[nodiscard]] std::string why_none(const scenario::Query& query, const Candidates& all) const;

  RunSession& session_;
  bool may_write_;
  std::map<Multiplexer, std::optional<std::uint64_t>>
      held_;  ///< bytes of entries without a fixed length, as asked; absent: cannot be read
  std::map<Multiplexer, Store> stores_;
};

/// What a query that found nothing lacks.
[[nodiscard]] std::vector<result::Want> wants_of(const scenario::Query& query);

}  // namespace conform::engine
