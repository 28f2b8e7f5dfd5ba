// SPDX-License-Identifier: Apache-2.0
// The twin of a device: the object dictionary that a device description (EDS, DCF, XDD, XDC) tells of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "base/error.hpp"
#include "dictionary/object_dictionary.hpp"
#include "eds/eds.hpp"
#include "twin/remarks.hpp"

namespace refnode {

struct Twin {
  std::map<std::uint16_t, Object> objects;
  std::array<bool, 8> placeholders{};  ///< [DummyUsage], by data type
  TwinRemarks remarks;
};

/// More entries of a file are left out, each with a remark.
inline constexpr std::size_t most_twin_entries = 100'000;
/// A longer value is cut, with a remark.
inline constexpr std::size_t most_twin_value = 65'536;
/// What a text or OCTET_STRING that can be written takes at least.
inline constexpr std::size_t twin_text_capacity = 256;
/// What all DOMAINs together take, and the most of one.
inline constexpr std::size_t twin_domain_budget = 64U * 1024U * 1024U;
inline constexpr std::size_t most_twin_domain = 4U * 1024U * 1024U;

/// What the file says, entry by entry, without any rule behind it. ParameterValue wins over DefaultValue.
/// What is missing or cannot be understood is served as well as it can be, and remarked. Fails when the file
/// implies more than memory should hold.
[[nodiscard]] conform::Result<Twin> make_twin(const conform::eds::EdsFile& file, std::uint8_t node_id);

/// The node-ID of a DCF; nullopt when there is none from 1 to 127.
[[nodiscard]] std::optional<std::uint8_t> configured_node_id(const conform::eds::EdsFile& file);

}  // namespace refnode
