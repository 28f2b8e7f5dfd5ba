// SPDX-License-Identifier: Apache-2.0
// What the user says about the device under test: profile, device description and node-ID put together.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "cli/run/run_inputs.hpp"
#include "device/profile.hpp"
#include "eds/eds.hpp"
#include "result/run_result.hpp"

namespace conform::cli {

struct DeviceWords {
  std::string profile;                ///< file; empty: none
  std::string eds;                    ///< file; empty: the one the profile names, if any
  std::optional<std::uint32_t> node;  ///< goes above what the files say
  /// Files of waivers beside those that the profile lists; empty: waivers.yaml beside the profile, if there.
  std::vector<std::string> waivers{};
};

struct KnownDevice {
  device::Profile profile;
  std::shared_ptr<const eds::EdsFile> description;  ///< empty: none is given
  std::vector<std::string> notes;                   ///< for the report: what of the description is not used
  std::vector<UsedFile> files{};                    ///< all that were read
  std::string claims{};  ///< the features that count as claimed, and by which file: "pump.yaml: tpdo, rpdo"

  /// For the report: what was said about the device.
  [[nodiscard]] std::vector<result::Property> properties() const;
};

/// Reads the files. The node-ID is that of the option, the profile or the DCF; `fallback` where none says so.
/// Error: a file with mistakes, or no node-ID at all.
[[nodiscard]] Result<KnownDevice> known_device(const DeviceWords& words, std::optional<NodeId> fallback);

}  // namespace conform::cli
