// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/legal_variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <random>
#include <set>
#include <utility>

#include "base/in_parallel.hpp"
#include "base/text.hpp"
#include "can/simulated_bus.hpp"
#include "cli/proof/neighbours.hpp"
#include "cli/proof/selftest.hpp"
#include "cli/proof/variant_profile.hpp"
#include "engine/engine.hpp"
#include "node/powered_node.hpp"
#include "variants/variant.hpp"

namespace conform::cli {
namespace {

using result::Verdict;

// std::uniform_int_distribution may differ between libraries; this does not, and the bias is of no interest.
std::uint64_t below(std::mt19937_64& random, std::uint64_t limit) { return random() % limit; }

std::string details_of(const result::Finding& finding) {
  return fmt::format("    {}:{}: {} {} -> {} ({}); passes: {}\n", finding.position.file,
                     finding.position.line, to_string(finding.verdict), finding.step, finding.actual,
                     finding.reason, join(finding.accepts, ", "));
}

}  // namespace

std::vector<Complaint> complaints_of(const result::RunResult& run, const std::set<std::string>& may_warn) {
  std::vector<Complaint> out;
  if (run.aborted) out.push_back({"aborted", "    " + *run.aborted + "\n"});
  for (const std::string& note : run.notes) out.push_back({"note", "    " + note + "\n"});
  for (const auto& each : run.cases) {
    const std::size_t before = out.size();
    for (const auto& judgement : each.judgements) {
      if (judgement.verdict == Verdict::pass || judgement.verdict == Verdict::not_applicable) continue;
      if (judgement.verdict == Verdict::warn && may_warn.contains(judgement.requirement)) continue;
      Complaint complaint;
      complaint.what =
          fmt::format("{} {} in {}", to_string(judgement.verdict), judgement.requirement, each.name());
      for (const auto& finding : judgement.findings) complaint.details += details_of(finding);
      const auto& reason = judgement.reason.empty() ? each.reason : judgement.reason;
      if (judgement.verdict == Verdict::inconclusive) complaint.details += "    " + reason + "\n";
      out.push_back(std::move(complaint));
    }
    const bool told = out.size() > before;
    const bool bad = each.verdict == Verdict::fail || each.verdict == Verdict::inconclusive ||
                     each.verdict == Verdict::error;
    if (bad && !told) {
      Complaint complaint{fmt::format("{} in {}", to_string(each.verdict), each.name()), {}};
      complaint.details = "    " + each.reason + "\n";
      out.push_back(std::move(complaint));
    }
    if (out.size() > before) {
      for (const auto& finding : each.setup_findings) out.back().details += details_of(finding);
    }
  }
  return out;
}

std::string Combination::text() const {
  std::string out = fmt::format("--node {} --bus-seed {} --bit-rate {}", node, seed, bit_rate);
  if (!described) out += " --undescribed";
  if (neighbours) out += " --neighbours";
  if (shuffled) out += " --shuffled";
  if (switched) out += " --switched";
  if (!variants.empty()) out += " --variants " + join(variants, ",");
  return out;
}

bool takes_hours(std::string_view variant) {
  return variant == "sdo-turnaround-250ms" || variant == "sdo-turnaround-400ms" ||
         variant == "sdo-turnaround-1200ms";
}

std::set<std::string> may_warn_with(const std::vector<std::string>& variants,
                                    const scenario::Catalogue& catalogue) {
  std::set<std::string> out;
  for (const std::string& id : variants) {
    for (const auto requirement : refnode::find_variant(id)->warns) {
      if (const auto canonical = catalogue.canonical(requirement)) out.insert(std::string(*canonical));
    }
  }
  return out;
}

Combination draw_combination(std::uint64_t seed, std::uint64_t number) {
  std::mt19937_64 random(seed * 0x9E3779B97F4A7C15ULL + number);
  Combination out;
  out.seed = random() % 1'000'000'000;
  do {
    out.node = static_cast<int>(1 + below(random, 127));
  } while (out.node == Neighbours::first_node || out.node == Neighbours::second_node);
  out.described = below(random, 2) == 0;
  out.neighbours = below(random, 3) == 0;
  constexpr std::uint32_t rates[] = {125'000, 250'000, 500'000, 800'000, 1'000'000};
  out.bit_rate = rates[below(random, std::size(rates))];
  // From a few variants to as many as go together.
  constexpr std::uint64_t percents[] = {2, 5, 10, 25, 60};
  const std::uint64_t percent = percents[below(random, std::size(percents))];
  const auto all = refnode::variants();
  std::vector<const refnode::Variant*> rows;
  for (const auto& row : all) rows.push_back(&row);
  for (std::size_t i = rows.size(); i > 1; --i) std::swap(rows[i - 1], rows[below(random, i)]);
  std::vector<const refnode::Variant*> chosen;
  for (const auto* row : rows) {
    if (below(random, 100) >= percent || (takes_hours(row->id) && below(random, 8) != 0)) continue;
    if (std::ranges::all_of(chosen, [row](const auto* other) { return refnode::compatible(*row, *other); }))
      chosen.push_back(row);
  }
  // In the order of the tables, so that the same set is the same node.
  std::ranges::sort(chosen, [](const auto* one, const auto* other) { return one < other; });
  for (const auto* row : chosen) {
    out.variants.emplace_back(row->id);
    if (takes_hours(row->id)) out.neighbours = false;
  }
  out.shuffled = below(random, 4) == 0;
  out.switched = below(random, 2) == 0;
  return out;
}

Result<std::vector<Complaint>> judge_combination(const Combination& combination, const LoadedSuites& suites,
                                                 const device::Profile& reference,
                                                 const std::vector<std::string>& only, can::Capture* frames) {
  auto node = refnode::PoweredNode::create({.node_id = static_cast<std::uint8_t>(combination.node),
                                            .defects = {},
                                            .storage = {},
                                            .variants = combination.variants});
  if (!node) return std::unexpected(node.error());
  const NodeId node_id(static_cast<std::uint8_t>(combination.node));
  device::Profile profile =
      combination.described
          ? profile_of_variants(reference, (*node)->node().dictionary(), combination.variants)
          : device::default_profile(node_id);
  if (combination.described && combination.neighbours) profile.claims.erase("only node on the bus");
  profile.node = node_id;

  can::SimulatedBus::Options bus_options;
  bus_options.seed = combination.seed;
  bus_options.bit_rate = combination.bit_rate;
  can::SimulatedBus bus(bus_options);
  bus.attach(**node, "reference node");
  Neighbours neighbours;
  if (combination.neighbours) bus.attach(neighbours, "neighbours");
  engine::RunOptions options;
  options.plan.seed = combination.seed;
  options.plan.selection.patterns = only;
  if (combination.shuffled) options.plan.shuffle = combination.seed;
  if (combination.switched) give_power_switch(options, bus, **node);
  can::Capture capture;
  const auto run = engine::run(bus.transport(), profile, suites.suite, suites.catalogue, options, capture);
  if (frames != nullptr) *frames = capture;

  return complaints_of(run, may_warn_with(combination.variants, suites.catalogue));
}

Result<std::vector<VariantVerdict>> variants_alone(const LoadedSuites& suites,
                                                   const device::Profile& reference, std::uint64_t seed,
                                                   unsigned jobs) {
  const auto rows = refnode::variants();
  std::vector<std::optional<Result<std::vector<Complaint>>>> judged(rows.size());
  in_parallel(rows.size(), jobs, [&](std::size_t i) {
    Combination one;
    one.variants = {std::string(rows[i].id)};
    one.node = reference.node.value();
    one.seed = seed;
    judged[i].emplace(judge_combination(one, suites, reference));
  });
  std::vector<VariantVerdict> out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!*judged[i]) return std::unexpected(judged[i]->error());
    out.push_back({std::string(rows[i].id), std::string(rows[i].summary), std::string(rows[i].legal),
                   std::move(**judged[i])});
  }
  return out;
}

Combination shrink(Combination combination, const std::string& what, const LoadedSuites& suites,
                   const device::Profile& reference) {
  const auto still_wrong = [&](const Combination& candidate) {
    const auto complaints = judge_combination(candidate, suites, reference);
    return complaints && std::ranges::find(*complaints, what, &Complaint::what) != complaints->end();
  };
  const auto attempt = [&](auto change) {
    Combination candidate = combination;
    change(candidate);
    if (still_wrong(candidate)) combination = std::move(candidate);
  };
  // Halves first: most rows have nothing to do with it.
  for (std::size_t part = (combination.variants.size() + 1) / 2; part >= 1; part /= 2) {
    for (std::size_t at = 0; at < combination.variants.size();) {
      const std::size_t size = combination.variants.size();
      attempt([at, part](Combination& candidate) {
        auto& rows = candidate.variants;
        const auto first = rows.begin() + static_cast<std::ptrdiff_t>(at);
        rows.erase(first, first + static_cast<std::ptrdiff_t>(std::min(part, rows.size() - at)));
      });
      if (combination.variants.size() == size) at += part;
    }
  }
  attempt([](Combination& candidate) { candidate.neighbours = false; });
  attempt([](Combination& candidate) { candidate.shuffled = false; });
  attempt([](Combination& candidate) { candidate.switched = false; });
  attempt([](Combination& candidate) { candidate.bit_rate = 500'000; });
  attempt([](Combination& candidate) { candidate.node = 1; });
  attempt([](Combination& candidate) { candidate.described = true; });
  attempt([](Combination& candidate) { candidate.seed = 1; });
  return combination;
}

}  // namespace conform::cli
