// SPDX-License-Identifier: Apache-2.0
// The suites of the project and the profile of its reference node, loaded once, for tests that run them.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <string>
#include <utility>

#include "catch.hpp"
#include "cli/suite_folder.hpp"
#include "device/profile.hpp"

namespace conform::cli::shipped {

inline const std::string folder = std::string(CONFORM_SOURCE_DIR) + "/suites";

inline const LoadedSuites& suites() {
  static const LoadedSuites loaded = [] {
    auto out = load_suites(folder, false);
    INFO((out ? std::string() : out.error().text()));
    REQUIRE(out.has_value());
    return std::move(*out);
  }();
  return loaded;
}

inline const device::Profile& reference() {
  static const device::Profile loaded = [] {
    auto out = device::load_profile_file(folder + "/devices/reference-node.yaml");
    REQUIRE(out.has_value());
    return std::move(out->profile);
  }();
  return loaded;
}

/// How much of something a test does: what the environment says, or what is usual.
inline std::size_t how_many(const char* name, std::size_t usual) {
  const char* text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): one thread
  return text == nullptr ? usual : std::stoul(text);
}

}  // namespace conform::cli::shipped
