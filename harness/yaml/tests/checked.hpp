// SPDX-License-Identifier: Apache-2.0
// A text loaded in one line, for the tests of this room.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "yaml/loader.hpp"

struct Checked {
  explicit Checked(std::string_view text)
      : diagnostics(conform::yaml::make_source("x.yaml", text)),
        root(conform::yaml::load(diagnostics.source(), diagnostics)) {}

  [[nodiscard]] std::string messages() const { return diagnostics.render(); }

  /// "line:column message; hint" for each, without the excerpts.
  [[nodiscard]] std::string brief() const {
    std::string out;
    for (const auto& d : diagnostics.sorted()) {
      out += to_string(d.begin) + " " + d.message + (d.hint.empty() ? "" : "; " + d.hint) + "\n";
    }
    return out;
  }

  [[nodiscard]] bool has_errors_only() const { return diagnostics.has_errors() && !root; }

  conform::yaml::Diagnostics diagnostics;
  std::optional<conform::yaml::Node> root;
};
