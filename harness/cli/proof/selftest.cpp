// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/selftest.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <string>

#include "base/in_parallel.hpp"
#include "can/simulated_bus.hpp"
#include "cli/proof/blame.hpp"
#include "cli/proof/verdicts.hpp"
#include "defects/defect.hpp"
#include "node/powered_node.hpp"

namespace conform::cli {

using result::Verdict;

void give_power_switch(engine::RunOptions& options, can::SimulatedBus& bus, refnode::PoweredNode& node) {
  options.power_cycle = [&bus, &node]() -> Result<void> {
    bus.unplug(node);
    bus.attach(node, "reference node");
    return {};
  };
  options.power_away = refnode::PoweredNode::off_time;
}

Result<SimulatedRun> simulate(const NodeSwitches& switches, const device::Profile& profile,
                              const scenario::Suite& suite, const scenario::Catalogue& catalogue,
                              engine::RunOptions options, std::uint64_t seed) {
  auto node = refnode::PoweredNode::create({.node_id = profile.node.value(),
                                            .defects = switches.defects,
                                            .variants = switches.variants,
                                            .description = switches.description});
  if (!node) return std::unexpected(node.error());
  can::SimulatedBus::Options bus_options;
  bus_options.seed = seed;
  // A twin is on a bus that its device is for.
  const auto& rates = profile.device_info.bit_rates;
  const auto usual = bus_options.bit_rate / 1000;
  if (switches.description && !rates.empty() && !std::ranges::binary_search(rates, usual))
    bus_options.bit_rate = rates.back() * 1000;
  can::SimulatedBus bus(bus_options);
  bus.attach(**node, "reference node");
  options.plan.seed = seed;
  options.power_revives = false;
  options.listen_first = std::chrono::milliseconds(100);
  give_power_switch(options, bus, **node);
  device::Profile claimed = profile;
  for (const auto& id : switches.defects) {
    const refnode::Defect* defect = refnode::find_defect(id);
    if (defect == nullptr) continue;
    for (const auto feature : defect->lacks) claimed.claims.erase(std::string(feature));
  }
  SimulatedRun out;
  out.result = engine::run(bus.transport(), claimed, suite, catalogue, options, out.capture);
  out.result.host = "simulation";
  return out;
}

bool KillMatrix::ok() const {
  const auto counts = conformant.counts();
  return counts.fail + counts.warn + counts.inconclusive + counts.error == 0 && counts.pass > 0 &&
         survivors().empty();
}

std::vector<std::string> KillMatrix::survivors() const {
  std::vector<std::string> out;
  for (const auto& defect : defects) {
    if (defect.killed_by.empty()) out.push_back(defect.id);
  }
  return out;
}

bool Blame::is_recognised() const { return std::ranges::find(named, defect) != named.end(); }

std::vector<result::Pattern> patterns_of(const std::vector<Blame>& blames) {
  std::vector<result::Pattern> out;
  for (const auto& blame : blames) {
    if (!blame.pattern.footprint.lead.empty()) out.push_back(blame.pattern);
  }
  return out;
}

namespace {

/// Runs the suite, or what judges one of `requirements`, and adds what became worse.
Result<void> expose(const Bench& bench, DefectVerdict& defect, std::vector<std::string> requirements,
                    bool slow) {
  engine::RunOptions options;
  options.plan.slow = slow;
  options.plan.selection.requirements = std::move(requirements);
  const auto worse = worse_with(defect.id, bench, std::move(options));
  if (!worse) return std::unexpected(worse.error());
  const auto add = [](std::vector<std::string>& to, const std::string& text) {
    if (std::ranges::find(to, text) == to.end()) to.push_back(text);
  };
  for (const auto& [key, verdict] : *worse) {
    const auto& [requirement, name] = key;
    if (std::ranges::find(defect.violates, requirement) != defect.violates.end()) {
      add(defect.killed_by, requirement + " " + std::string(to_string(verdict)) + " in " + name);
      add(defect.proves, requirement);
    } else {
      add(defect.bystanders, requirement);
    }
  }
  return {};
}

/// What its row says of it.
DefectVerdict said_of(const refnode::Defect& row, const scenario::Catalogue& catalogue) {
  DefectVerdict defect;
  defect.id = row.id;
  defect.summary = row.summary;
  for (const auto id : row.violates) {
    if (const auto canonical = catalogue.canonical(id)) {
      if (std::ranges::find(defect.violates, *canonical) == defect.violates.end())
        defect.violates.push_back(*canonical);
    } else {
      defect.unknown.emplace_back(id);
    }
  }
  return defect;
}

/// The rules around these: SDO-ERR-04 is one of SDO-ERR-*, and with the whole service one of SDO-*.
std::vector<std::string> rules_around(const std::vector<std::string>& rules, bool of_service) {
  std::set<std::string> out;
  for (const auto& rule : rules)
    out.insert(rule.substr(0, of_service ? rule.find('-') : rule.rfind('-')) + "-*");
  return {out.begin(), out.end()};
}

Result<DefectVerdict> verdict_of(const Bench& bench, const refnode::Defect& row, bool whole) {
  auto defect = said_of(row, bench.catalogue);
  if (!whole) {
    // Scenarios of long transfers take ten times as long as all others together and are needed by few
    // defects.
    for (const bool slow : {false, true}) {
      if (!defect.killed_by.empty()) break;
      if (auto done = expose(bench, defect, defect.violates, slow); !done)
        return std::unexpected(done.error());
    }
    // What one scenario leaves behind may show in the next, and a monitor may need its traffic: mostly the
    // one is about the same as the other, and few of all scenarios are.
    for (const bool of_service : {false, true}) {
      if (!defect.killed_by.empty()) break;
      if (auto done = expose(bench, defect, rules_around(defect.violates, of_service), false); !done)
        return std::unexpected(done.error());
    }
    whole = defect.killed_by.empty();
  }
  for (const bool slow : {false, true}) {
    if (!whole || (slow && !defect.killed_by.empty())) break;
    if (auto done = expose(bench, defect, {}, slow); !done) return std::unexpected(done.error());
  }
  std::ranges::sort(defect.proves);
  return defect;
}

/// Tries again what no defect has proven. A rule may have stood behind another one of the same defect, which
/// ended its cases: it is judged alone. A monitor may need the traffic of scenarios that judge something
/// else.
Result<void> prove(const Bench& bench, const std::set<std::string>& monitored,
                   const std::vector<std::string>& unproven, DefectVerdict& defect) {
  for (const auto& rule : defect.violates) {
    if (!std::ranges::binary_search(unproven, rule)) continue;
    const auto proven = [&] { return std::ranges::find(defect.proves, rule) != defect.proves.end(); };
    for (const bool slow : {false, true}) {
      if (proven()) break;
      if (auto done = expose(bench, defect, {rule}, slow); !done) return done;
    }
    if (proven() || !monitored.contains(rule)) continue;
    if (auto done = expose(bench, defect, {}, false); !done) return done;
  }
  std::ranges::sort(defect.proves);
  return {};
}

std::set<std::string> proven_by(const std::vector<DefectVerdict>& defects) {
  std::set<std::string> out;
  for (const auto& defect : defects) out.insert(defect.proves.begin(), defect.proves.end());
  return out;
}

std::vector<std::string> without(const std::set<std::string>& all, const std::set<std::string>& some) {
  std::vector<std::string> out;
  std::ranges::set_difference(all, some, std::back_inserter(out));
  return out;
}

}  // namespace

std::vector<const refnode::Defect*> chosen_rows(const std::vector<std::string>& only) {
  std::vector<const refnode::Defect*> rows;
  for (const auto& row : refnode::defects()) {
    if (only.empty() || std::ranges::find(only, row.id) != only.end()) rows.push_back(&row);
  }
  return rows;
}

Result<KillMatrix> kill_matrix(const device::Profile& profile, const scenario::Suite& suite,
                               const scenario::Catalogue& catalogue, const KillOptions& options) {
  KillMatrix out;
  auto conformant = simulate({}, profile, suite, catalogue, {}, options.seed);
  if (!conformant) return std::unexpected(conformant.error());
  out.conformant = std::move(conformant->result);
  const auto good = verdicts_of(out.conformant);
  std::set<std::string> judged, monitored;  // by a monitor: any frame of any scenario may show a violation
  for (const auto& [key, verdict] : good) {
    if (verdict == Verdict::not_applicable) continue;
    judged.insert(key.first);
    if (key.second.starts_with("monitor/")) monitored.insert(key.first);
  }
  const Bench bench{profile, suite, catalogue, options.seed, good};
  const auto rows = chosen_rows(options.only);
  // Every run has a node, a bus and a clock of its own, and its result does not depend on the others.
  auto verdicts = all_in_parallel(rows.size(), options.jobs,
                                  [&](std::size_t i) { return verdict_of(bench, *rows[i], options.whole); });
  if (!verdicts) return std::unexpected(verdicts.error());
  out.defects = std::move(*verdicts);
  auto blames = all_in_parallel(options.blame ? rows.size() : 0, options.jobs, [&](std::size_t i) {
    return blame_of(out.defects[i], bench, options.known);
  });
  if (!blames) return std::unexpected(blames.error());
  out.blames = std::move(*blames);
  const auto pairs = pairs_of(out.blames, options.pairs, options.seed);
  auto pair_blames =
      all_in_parallel(pairs.size(), options.jobs, [&](std::size_t i) { return blame_of(pairs[i], bench); });
  if (!pair_blames) return std::unexpected(pair_blames.error());
  out.pairs = std::move(*pair_blames);
  const auto open = without(judged, proven_by(out.defects));
  std::vector<Result<void>> tried(out.defects.size());
  in_parallel(out.defects.size(), options.jobs,
              [&](std::size_t i) { tried[i] = prove(bench, monitored, open, out.defects[i]); });
  for (auto& done : tried) {
    if (!done) return std::unexpected(done.error());
  }
  const auto proven = proven_by(out.defects);
  out.unproven = without(judged, proven);
  out.proven.assign(proven.begin(), proven.end());
  return out;
}

Result<std::vector<Blame>> blames_of_defects(const device::Profile& profile, const scenario::Suite& suite,
                                             const scenario::Catalogue& catalogue,
                                             const KillOptions& options) {
  const Verdicts none;  // a blame compares with no other run
  const Bench bench{profile, suite, catalogue, options.seed, none};
  const auto rows = chosen_rows(options.only);
  return all_in_parallel(rows.size(), options.jobs, [&](std::size_t i) {
    return blame_of(said_of(*rows[i], catalogue), bench, options.known);
  });
}

}  // namespace conform::cli
