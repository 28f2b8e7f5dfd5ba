// SPDX-License-Identifier: Apache-2.0
// What a device description (EDS, DCF, XDD, XDC) claims about the device under test: its entries with their
// values as wire bytes. The reference node makes its twins of the same files by code of its own, so that one
// misreading cannot cancel itself out.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "device/profile.hpp"
#include "eds/eds.hpp"

namespace conform::device {

/// Something in the file that says nothing usable about the device, and what is therefore not expected of it.
struct UnusedText {
  std::string where;  ///< "device.eds:120:14"
  std::string what;   ///< "the default of 2001h:00 is no UNSIGNED8: it is not compared"
};

struct Description {
  std::string file;  ///< as the user wrote it
  std::vector<Entry>
      entries;  ///< ascending, all with `claimed` and `described`; defaults without the node-ID
  DescribedPlaces places;
  std::set<std::string, std::less<>> claims;  ///< features that follow from what is described
  std::map<Index, bool> placeholders;         ///< [DummyUsage]
  DeviceInfo info;                            ///< [DeviceInfo]
  std::optional<NodeId> node;                 ///< of a DCF
  std::vector<UnusedText> unused;             ///< at most `most_unused`, the others counted
  std::size_t unused_left_out = 0;
  static constexpr std::size_t most_unused = 100;
};

/// Reads the claims out of a file. What CiA 301 itself says of an entry (category, effect of a write, values
/// that change) stays; type, access, limits, default and mapping are the file's. Error: more entries are
/// implied by it than fit (eds::expand).
///
/// Defaults are compared with the device where they have one meaning: numbers in every notation, formulas of
/// $NODEID, REAL as a decimal number or as the bits in hexadecimal, VISIBLE_STRING as it stands, OCTET_STRING
/// as pairs of digits. Of a type that is none of the basic ones (7.4.7.1) only the presence and the access
/// are claimed. ObjFlags keep the suite off entries that CiA 301 does not define. DCF: where there is a
/// ParameterValue, it is what the device is configured to, and counts in the place of the DefaultValue.
[[nodiscard]] Result<Description> describe(const eds::EdsFile& file);

/// Lays the description under the profile: what the profile lists itself is closer to the device. The claims
/// of both add up, without those that the profile takes back.
void add_description(Profile& profile, Description description);

/// Encodes the writes of error triggers and of the store fault whose types only the description tells. Error:
/// an object that it does not describe, or a value that is none of its type.
[[nodiscard]] Result<void> complete_writes(Profile& profile);

}  // namespace conform::device
