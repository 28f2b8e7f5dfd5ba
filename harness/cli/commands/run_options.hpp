// SPDX-License-Identifier: Apache-2.0
// The options of `run` on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/commands/commands.hpp"
#include "cli/run/settings.hpp"

namespace conform::cli {

class RunOptions {
 public:
  void add_to(CLI::App& app);
  /// The exit code.
  [[nodiscard]] int run(const MergedLine& line) const;

  RunCommand command;

 private:
  bool show_config_ = false;
};

}  // namespace conform::cli
