// SPDX-License-Identifier: Apache-2.0
// What a selftest says on the terminal, and docs/proof.md and docs/blame.md.
#pragma once

#include <string>
#include <vector>

#include "cli/proof/edit_matrix.hpp"
#include "cli/proof/legal_variants.hpp"
#include "cli/proof/selftest.hpp"

namespace conform::cli {

/// The conformant node, then the defects: those that survive, `verbose`: all. `is_part`: only some were run.
[[nodiscard]] std::string matrix_words(const KillMatrix& matrix, bool verbose, bool is_part);
[[nodiscard]] std::string blame_words(const std::vector<Blame>& blames, bool verbose);
/// Of how many defects the name stands at a cause of their run.
[[nodiscard]] std::string recognised_words(const std::vector<Blame>& blames, bool verbose);
/// Two causes for two faults; pairs of which one fault vanished in the other's cause by name.
[[nodiscard]] std::string pair_words(const std::vector<PairBlame>& pairs);
[[nodiscard]] std::string edit_words(const EditMatrix& matrix, bool verbose);
[[nodiscard]] std::string variant_words(const std::vector<VariantVerdict>& variants, bool verbose);

/// docs/proof.md
[[nodiscard]] std::string proof_markdown(const KillMatrix& matrix);
/// docs/blame.md
[[nodiscard]] std::string blame_page(const KillMatrix& matrix);

}  // namespace conform::cli
