// SPDX-License-Identifier: Apache-2.0
// Device descriptions for tests, put together from entries.
#pragma once

#include <memory>
#include <string>

#include "catch.hpp"
#include "eds/eds.hpp"
#include "eds/read.hpp"
#include "twin/twin.hpp"

namespace refnode::testing {

/// A section: `name` as "2000" or "1018sub1"; `more` are further lines.
inline std::string entry(const std::string& name, const std::string& type, const std::string& access,
                         const std::string& value, const std::string& more = {}) {
  return "[" + name + "]\nParameterName=" + name + "\nObjectType=0x7\nDataType=" + type +
         "\nAccessType=" + access + "\nDefaultValue=" + value + "\n" + more + "\n";
}
inline std::string record(const std::string& name, const std::string& more = {}) {
  return "[" + name + "]\nParameterName=" + name + "\nObjectType=0x9\n" + more + "\n";
}
inline constexpr const char* mapped = "PDOMapping=1\n";
inline const std::string u8 = "0x0005";
inline const std::string u16 = "0x0006";
inline const std::string u32 = "0x0007";

/// Both parameters of a PDO with one mapped object; `number` as "00" in 1400h and 1600h.
inline std::string pdo(const std::string& number, bool transmit, const std::string& cob_id,
                       const std::string& mapping, const std::string& access = "rw") {
  const std::string communication = (transmit ? "18" : "14") + number;
  const std::string map = (transmit ? "1A" : "16") + number;
  return record(communication) + entry(communication + "sub0", u8, "const", "2") +
         entry(communication + "sub1", u32, access, cob_id) +
         entry(communication + "sub2", u8, access, "0xFF") + record(map) +
         entry(map + "sub0", u8, access, "1") + entry(map + "sub1", u32, access, mapping);
}

inline std::shared_ptr<const conform::eds::EdsFile> describe(const std::string& text) {
  auto file = conform::eds::read(text, "device.eds");
  REQUIRE(file.has_value());
  return std::make_shared<const conform::eds::EdsFile>(std::move(*file));
}

inline Twin twin_of(const std::string& text, std::uint8_t node_id = 5) {
  auto twin = make_twin(*describe(text), node_id);
  REQUIRE(twin.has_value());
  return std::move(*twin);
}

/// All remarks, "line:column text".
inline std::vector<std::string> remarks_of(const Twin& twin) {
  std::vector<std::string> out;
  for (const auto& remark : twin.remarks.all()) out.push_back(to_string(remark.at) + " " + remark.text);
  return out;
}

}  // namespace refnode::testing
