// SPDX-License-Identifier: Apache-2.0
// Where a device and its description differ, as far as a scan shows it.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "device/description.hpp"
#include "eds/eds.hpp"
#include "engine/scan.hpp"

namespace conform::cli {

struct ScanDifference {
  std::string object;     ///< "1018h:01", "1018h" or "[DeviceInfo]"
  std::string property;   ///< as a description calls it: "AccessType", "DefaultValue"; "presence"
  std::string device;     ///< what was seen
  std::string described;  ///< what the file says
  std::string where;      ///< "device.eds:120"
};

/// What the file lets nobody read by the way (ObjFlags bit 1): a scan leaves it alone.
[[nodiscard]] std::set<Multiplexer> not_to_be_scanned(const device::Description& description);
/// The described entries that lie in the ranges.
[[nodiscard]] std::vector<Multiplexer> to_be_scanned(const device::Description& description,
                                                     std::span<const engine::IndexRange> ranges);

/// Compares presence, access, length, limits and mapping of every entry, the values that every such device
/// has (device type, identity, counts, const entries), and [DeviceInfo] where the ranges hold what it tells
/// of. What may be another value in each device or at any time is not compared, nor what the device keeps to
/// itself: errors that did not happen, mapping entries above the count. In the order of the dictionary.
[[nodiscard]] std::vector<ScanDifference> compare_scan(std::span<const engine::ScannedObject> objects,
                                                       const engine::ScanOptions& scanned,
                                                       const eds::EdsFile& file,
                                                       const device::Description& description, NodeId node);

/// A table for people: a line for each, and how many there are.
[[nodiscard]] std::string scan_differences_text(std::span<const ScanDifference> differences);
[[nodiscard]] std::string scan_differences_json(std::span<const ScanDifference> differences,
                                                std::string_view file);

}  // namespace conform::cli
