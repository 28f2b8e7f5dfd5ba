// SPDX-License-Identifier: Apache-2.0
// The section `run:` of a device profile: options of the command `run` that hold for this device unless
// somebody says otherwise.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "yaml/fields.hpp"

namespace conform::device {

struct RunKey {
  enum class Kind : std::uint8_t {
    flag,  ///< true or false
    flag_or_number,
    word,   ///< one value
    words,  ///< one, or a list
    path,   ///< relative to the folder of the profile
    paths,
  };
  std::string_view key;  ///< the option without its dashes: "all-objects"
  Kind kind = Kind::word;
};
/// All that may stand there. What the profile has keys of its own for (interface, node, eds) does not.
[[nodiscard]] std::span<const RunKey> run_keys();

struct RunSetting {
  std::string_view key;            ///< of run_keys()
  std::vector<std::string> words;  ///< as written; flags "true" or "false"
  int line = 0;                    ///< in the profile
};
/// In the order of run_keys(). Mistakes go to the diagnostics of the field.
[[nodiscard]] std::vector<RunSetting> read_run_settings(const yaml::Field& given);

}  // namespace conform::device
