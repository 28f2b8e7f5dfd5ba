// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `eds` on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "cli/commands/commands.hpp"

namespace conform::cli {

struct EdsConvertCommand {
  std::string in, out;          ///< out "-": standard output
  std::string to;               ///< eds, dcf, xdd, xdc; empty: by the extension of `out`
  std::string format = "text";  ///< of the report: text, json
  bool strict = false;          ///< exits with 1 when something is left behind
};
/// 0: converted; 1: converted, and with `strict` something was left behind; exit_usage: nothing written.
[[nodiscard]] int eds_convert_command(const EdsConvertCommand& options);

struct EdsNewCommand {
  std::string out = "-";   ///< "-": standard output
  std::string to;          ///< eds, xdd; empty: by the extension of `out`, else eds
  unsigned profile = 301;  ///< 301, 401
  std::string vendor_name, product_name;
  std::string vendor, product, revision;  ///< numbers
  unsigned rpdos = 0, tpdos = 0;
  std::string date;  ///< yyyy-mm-dd; empty: today
};
[[nodiscard]] int eds_new_command(const EdsNewCommand& options);

/// `eds convert` and `eds new`.
class EdsWriters {
 public:
  void add_to(CLI::App& app);
  /// The exit code of the one that was called; nullopt when none was.
  [[nodiscard]] std::optional<int> run() const;

 private:
  EdsConvertCommand convert_;
  EdsNewCommand new_;
  CLI::App* convert_sub_ = nullptr;
  CLI::App* new_sub_ = nullptr;
};

/// All sub-commands.
class EdsOptions {
 public:
  void add_to(CLI::App& app);
  /// The exit code of the one that was called.
  [[nodiscard]] int run() const;

 private:
  void add_lint_to(CLI::App& app);

  EdsLintCommand lint_;
  EdsShowCommand show_;
  EdsDiffCommand diff_;
  EdsWriters writers_;
  CLI::App* lint_sub_ = nullptr;
  CLI::App* show_sub_ = nullptr;
  CLI::App* diff_sub_ = nullptr;
};

}  // namespace conform::cli
