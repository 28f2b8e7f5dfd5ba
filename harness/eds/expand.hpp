// SPDX-License-Identifier: Apache-2.0
// The dictionary in full: what CompactSubObj and CompactPDO say in short, written out.
#pragma once

#include <cstddef>
#include <vector>

#include "base/error.hpp"
#include "eds/eds.hpp"

namespace conform::eds {

/// At most so many entries are implied in one file; more is refused.
inline constexpr std::size_t most_implied = 100'000;
/// At most so many bytes of names and values are repeated by that.
inline constexpr std::size_t most_implied_bytes = 64U * 1024U * 1024U;

/// Whether expand() adds anything: CompactSubObj or CompactPDO is there.
[[nodiscard]] bool implies_entries(const EdsFile& file);

/// All objects, ascending by index, with those entries that are only implied. An implied entry has
/// `Entry::implied_by`, the place of the CompactSubObj or CompactPDO; what is described stays as it is.
///
/// CompactSubObj = n (CiA 306): sub-index 00h is UNSIGNED8, ro, n; 1 to n are as the main section says, with
/// names, values and denotations from [xxxxName], [xxxxValue] and [xxxxDenotation]. CompactPDO (CiA 306): as
/// many PDOs as NrOfRXPDO and NrOfTXPDO say, at the lowest free indices, with the sub-indices of the mask. Of
/// their mapping parameters only sub-index 00h is certain, so no more is implied.
[[nodiscard]] Result<std::vector<Object>> expand(const EdsFile& file);

}  // namespace conform::eds
