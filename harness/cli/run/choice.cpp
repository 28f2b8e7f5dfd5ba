// SPDX-License-Identifier: Apache-2.0
#include "cli/run/choice.hpp"

#include <charconv>
#include <optional>
#include <set>
#include <string_view>

#include "cli/run/run_source.hpp"
#include "engine/engine.hpp"

namespace conform::cli {
namespace {

std::optional<std::size_t> number_of(std::string_view text) {
  std::size_t out = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return out;
}

std::optional<engine::Shard> parse_shard(std::string_view text) {
  const auto slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto number = number_of(text.substr(0, slash)), of = number_of(text.substr(slash + 1));
  if (!number || !of || *number < 1 || *number > *of) return std::nullopt;
  return engine::Shard{*number, *of};
}

/// Cases that say nothing good of the device: failed, left open, or not run.
std::set<std::string> not_passed(const result::RunResult& run) {
  std::set<std::string> out;
  for (const auto& each : run.cases) {
    if (each.verdict >= result::Verdict::inconclusive && each.suite != "monitor") out.insert(each.name());
  }
  return out;
}

}  // namespace

Result<void> choose(const Choice& choice, engine::RunOptions& options) {
  if (!choice.shard.empty()) {
    const auto shard = parse_shard(choice.shard);
    if (!shard)
      return fail("'" + choice.shard + "' is no shard", {},
                  "--shard 2/5: the second of five parts of the run");
    options.plan.shard = *shard;
  }
  if (!choice.rerun_failed.empty()) {
    const auto run = read_run_to_compare(choice.rerun_failed);
    if (!run) return std::unexpected(run.error());
    options.plan.only = not_passed(*run);
  }
  if (choice.until_fail && choice.repeat < 2)
    return fail("--until-fail needs to know how often at most", {}, "--repeat 100 --until-fail");
  options.repeat = {choice.repeat, choice.until_fail};
  options.fail_fast = choice.fail_fast;
  return {};
}

}  // namespace conform::cli
