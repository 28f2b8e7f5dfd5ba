// SPDX-License-Identifier: Apache-2.0
// Device descriptions that nobody wrote: EDS files with random communication objects, process data and PDOs,
// each of a device that there may be.
#pragma once

#include <cstdint>
#include <string>

namespace conform::cli {

/// The text of an EDS, the same for the same seed. Every twentieth (19, 39, ...) has 512 TPDOs.
[[nodiscard]] std::string draw_description(std::uint64_t seed);
/// With communication objects that many devices leave out, and entries of the manufacturer of any type.
[[nodiscard]] std::string draw_rich_description(std::uint64_t seed);

}  // namespace conform::cli
