// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/explored_mutants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "cli/proof/explored.hpp"
#include "cli/proof/processes.hpp"
#include "explore/scenario_text.hpp"

namespace conform::cli {
namespace {

/// While there is one, the node that is called has the fault.
class Faulty {
 public:
  Faulty(const MutantBuild& build, const Mutant& mutant) : build_(build) { build_.turn_on(mutant.number); }
  ~Faulty() { build_.turn_on(0); }
  Faulty(const Faulty&) = delete;
  Faulty& operator=(const Faulty&) = delete;

 private:
  const MutantBuild& build_;
};

/// A node that has the fault, beside nodes in the same process that have not.
class MutantNode final : public can::Participant {
 public:
  MutantNode(const MutantBuild& build, const Mutant& mutant, std::unique_ptr<can::Participant> node)
      : build_(build), mutant_(mutant), node_(std::move(node)) {}
  ~MutantNode() override {
    const Faulty faulty(build_, mutant_);
    node_.reset();
  }
  MutantNode(const MutantNode&) = delete;
  MutantNode& operator=(const MutantNode&) = delete;

  void attach(Sender sender, BusTime now) override {
    const Faulty faulty(build_, mutant_);
    node_->attach(std::move(sender), now);
  }
  void on_frame(const can::Frame& frame, BusTime now) override {
    const Faulty faulty(build_, mutant_);
    node_->on_frame(frame, now);
  }
  void on_transmitted(BusTime now) override {
    const Faulty faulty(build_, mutant_);
    node_->on_transmitted(now);
  }
  void on_time(BusTime now) override {
    const Faulty faulty(build_, mutant_);
    node_->on_time(now);
  }
  [[nodiscard]] std::optional<BusTime> next_wakeup() const override {
    const Faulty faulty(build_, mutant_);
    return node_->next_wakeup();
  }

 private:
  const MutantBuild& build_;
  const Mutant& mutant_;
  std::unique_ptr<can::Participant> node_;
};

/// In words; empty: nothing was found.
std::string search_for(const MutantBuild& build, const Mutant& mutant, const Explorable& right,
                       const scenario::Catalogue& catalogue, const ExploreMutantsOptions& options) {
  auto bench = right.bench;
  bench.device = [&build, &mutant, make = right.bench.device]() -> Result<std::unique_ptr<can::Participant>> {
    const Faulty faulty(build, mutant);
    auto node = make();
    if (!node) return std::unexpected(node.error());
    return std::make_unique<MutantNode>(build, mutant, std::move(*node));
  };
  std::string out, weaker;
  auto search = search_for_one_fault(right, options.seed, options.actions);
  search.on_finding = [&](const explore::Finding& finding) {
    if (!counts_as_found(finding)) return false;
    const auto word = word_of(finding, catalogue);
    auto text = fmt::format("{} {}: {}", word, finding.assigned ? finding.assigned->requirement : "?",
                            explore::came_text(finding, right.words));
    if (const auto due = explore::due_text(finding, right.words); !due.empty())
      text += ", with the model: " + due;
    for (const auto& action : finding.conversation)
      text += "\n    " + explore::describe(action, right.words.node);
    if (word == "FAIL") {
      out = std::move(text);
      return true;
    }
    if (weaker.empty()) weaker = std::move(text);
    return false;
  };
  auto result = explore::search(bench, right.words, search);
  if (!result) return result.error().text();
  return out.empty() ? weaker : out;
}

/// A search takes seconds; a mutant that takes so much longer hangs.
ProcessLimits limits_of(const ExploreMutantsOptions& options) {
  constexpr std::size_t actions_a_second = 5'000;
  ProcessLimits out;
  out.seconds = 20 + static_cast<unsigned>(options.actions / actions_a_second);
  return out;
}

}  // namespace

Result<std::vector<MutantFound>> explore_mutants(const MutantBuild& build,
                                                 const std::vector<const Mutant*>& mutants,
                                                 const device::Profile& profile,
                                                 const scenario::Catalogue& catalogue,
                                                 const ExploreMutantsOptions& options) {
  build.turn_on(0);
  const auto right = explorable_of(profile, {}, {});
  if (!right) return std::unexpected(right.error());
  const auto endings = in_processes(mutants.size(), options.jobs, limits_of(options), [&](std::size_t i) {
    return search_for(build, *mutants[i], *right, catalogue, options);
  });
  std::vector<MutantFound> out;
  for (std::size_t i = 0; i < mutants.size(); ++i) {
    const auto& ending = endings[i];
    const bool ended = ending.kind == Ending::Kind::returned;
    out.push_back({.mutant = mutants[i],
                   .found = !ended || !ending.text.empty(),
                   .by = ended || !ending.text.empty() ? ending.text : "it hung"});
  }
  return out;
}

std::string explored_mutants_words(const std::vector<MutantFound>& found) {
  std::string out;
  std::size_t count = 0;
  for (const auto& each : found) {
    if (each.found) ++count;
    out += fmt::format("{:<10}  {} {}:{} {} `{}` -> `{}`\n", each.found ? "found" : "not found",
                       each.mutant->number, each.mutant->file, each.mutant->line, each.mutant->function,
                       each.mutant->original, each.mutant->mutated);
    if (each.found) out += fmt::format("  {}\n", each.by);
  }
  out += fmt::format(
      "exploration: {} of {} mutants found ({:.1f} %)\n", count, found.size(),
      found.empty() ? 0.0 : 100.0 * static_cast<double>(count) / static_cast<double>(found.size()));
  return out;
}

}  // namespace conform::cli
