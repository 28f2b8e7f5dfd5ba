// SPDX-License-Identifier: Apache-2.0
// The proof as a page for a browser: what the suite was shown to find, and what not, by one selftest.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/proof/edit_matrix.hpp"
#include "cli/proof/legal_variants.hpp"
#include "cli/proof/mutants.hpp"
#include "cli/proof/selftest.hpp"
#include "cli/proof/throughput.hpp"
#include "result/run_result.hpp"
#include "scenario/catalogue.hpp"

namespace conform::cli {

/// What a selftest has shown. A part that was not asked for is not there, and the page says how to get it.
struct Proof {
  std::string tool;     ///< "canopen-conform 0.1.0"
  std::string command;  ///< that gave it
  std::int64_t started_utc_ns = 0;
  std::uint64_t seed = 1;
  std::vector<result::Property> suites;  ///< digests
  const scenario::Catalogue* catalogue = nullptr;
  bool is_part = false;  ///< only some defects, edits or mutants were asked for
  int exit_code = 0;

  std::optional<KillMatrix> matrix{};
  bool has_blame = false;
  std::optional<std::vector<VariantVerdict>> variants{};
  std::optional<EditMatrix> edits{};
  std::optional<std::vector<MutantFate>> mutants{};
  std::vector<std::string> stale{};  ///< lines of the mutants' explanations that explain nobody
  std::vector<std::pair<TransferKind, Throughput>> throughput{};
};

/// A document like that of a run (reports/html/html.hpp).
[[nodiscard]] std::string proof_page(const Proof& proof);

}  // namespace conform::cli
