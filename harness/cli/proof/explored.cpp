// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/explored.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "base/in_parallel.hpp"
#include "base/text.hpp"
#include "cli/proof/legal_variants.hpp"
#include "cli/proof/variant_profile.hpp"
#include "defects/defect.hpp"
#include "engine/monitor_cases.hpp"
#include "explore/scenario_text.hpp"
#include "node/powered_node.hpp"
#include "variants/variant.hpp"

namespace conform::cli {
namespace {

explore::MakeDevice maker_of(const NodeSwitches& switches, NodeId node) {
  return [switches, node]() -> Result<std::unique_ptr<can::Participant>> {
    auto made = refnode::PoweredNode::create({.node_id = node.value(),
                                              .defects = switches.defects,
                                              .variants = switches.variants,
                                              .description = switches.description});
    if (!made) return std::unexpected(made.error());
    return std::unique_ptr<can::Participant>(std::move(*made));
  };
}

using Words = std::set<std::string>;

/// In what a node with these variants is not the device that the profile tells of: its entries, their access
/// and defaults, its features. nullopt: there is no such node.
std::optional<Words> contradictions(const device::Profile& profile, const NodeSwitches& model) {
  const auto node = refnode::Node::create(
      {.node_id = profile.node.value(), .variants = model.variants, .description = model.description});
  if (!node) return std::nullopt;
  const auto& dictionary = (*node)->dictionary();
  const auto held = profile_of_variants(profile, dictionary, model.variants);
  Words out;
  for (const auto& entry : profile.objects) {
    const auto is = std::ranges::find(held.objects, entry.mux, &device::Entry::mux);
    if (is == held.objects.end()) {
      out.insert("without " + to_string(entry.mux));
    } else if (is->access != entry.access) {
      out.insert("access of " + to_string(entry.mux));
    } else if (entry.default_value && is->default_value != entry.default_value) {
      out.insert("default of " + to_string(entry.mux));
    }
  }
  for (const auto& word : profile.claims) {
    if (!held.claims.contains(word)) out.insert("lacks " + word);
  }
  for (const auto& word : held.claims) {
    if (!profile.claims.contains(word)) out.insert("gains " + word);
  }
  return out;
}

NodeSwitches with(NodeSwitches model, std::string_view variant) {
  if (std::ranges::find(model.variants, variant) == model.variants.end())
    model.variants.emplace_back(variant);
  return model;
}

/// The model that comes nearest to what the profile tells, by the variants that show in the dictionary.
NodeSwitches as_told(const device::Profile& profile, NodeSwitches model) {
  auto left = contradictions(profile, model);
  for (bool nearer = true; nearer && left && !left->empty();) {
    nearer = false;
    for (const auto& variant : refnode::variants()) {
      auto candidate = with(model, variant.id);
      auto then = contradictions(profile, candidate);
      if (!then || then->size() >= left->size() || !std::ranges::includes(*left, *then)) continue;
      model = std::move(candidate);
      left = std::move(then);
      nearer = true;
    }
  }
  return model;
}

/// Which legal variants contradict what the profile tells. A node is made to find out, so that it is only
/// asked about when a device differs, and once.
class Contradicting {
 public:
  Contradicting(device::Profile profile, NodeSwitches model)
      : profile_(std::move(profile)), model_(std::move(model)), known_(refnode::variants().size()) {}

  /// By its place in the table. From any thread.
  [[nodiscard]] bool operator()(std::size_t variant) {
    const std::scoped_lock lock(mutex_);
    if (!known_[variant]) known_[variant] = look_at(refnode::variants()[variant].id);
    return *known_[variant];
  }

 private:
  [[nodiscard]] bool look_at(std::string_view id) {
    if (!asked_) of_model_ = contradictions(profile_, model_);
    asked_ = true;
    const auto then = contradictions(profile_, with(model_, id));
    return !of_model_ || !then || !std::ranges::includes(*of_model_, *then);
  }

  device::Profile profile_;
  NodeSwitches model_;
  std::mutex mutex_;
  bool asked_ = false;
  std::optional<Words> of_model_;
  std::vector<std::optional<bool>> known_;
};

/// The legal variants as choices of the model, and the models that have chosen.
explore::Offer offer_of(const device::Profile& profile, const NodeSwitches& model) {
  explore::Offer out;
  for (const auto& variant : refnode::variants())
    out.choices.push_back({.name = std::string(variant.id),
                           .group = std::string(variant.group),
                           .warns = std::string(variant.warns.empty() ? "" : variant.warns.front())});
  const auto contradicts = std::make_shared<Contradicting>(profile, model);
  out.model_of = [contradicts, model, node = profile.node](const explore::Choices& chosen) {
    auto switches = model;
    for (const auto choice : chosen) {
      // A choice that contradicts what the profile tells is none.
      if ((*contradicts)(choice)) {
        return explore::MakeDevice([]() -> Result<std::unique_ptr<can::Participant>> {
          return fail("the profile tells of another device");
        });
      }
      switches = with(std::move(switches), refnode::variants()[choice].id);
    }
    return maker_of(switches, node);
  };
  return out;
}

bool is_binding(const std::string& requirement, const scenario::Catalogue& catalogue) {
  const auto* rule = catalogue.find(requirement);
  return rule != nullptr && (rule->level == "mandatory" || rule->level == "conditional");
}

std::vector<std::string> canonical(std::span<const std::string_view> ids,
                                   const scenario::Catalogue& catalogue) {
  std::vector<std::string> out;
  for (const auto id : ids) {
    if (const auto found = catalogue.canonical(id)) out.push_back(*found);
  }
  return out;
}

/// `right`: the device without a defect, whose model all of them share.
Result<DefectFound> found_of(const refnode::Defect& defect, const Explorable& right,
                             const scenario::Catalogue& catalogue, const ExploreProofOptions& options) {
  DefectFound out{.id = std::string(defect.id)};
  auto bench = right.bench;
  bench.device = maker_of({.defects = {out.id}}, right.words.node);
  const auto violates = canonical(defect.violates, catalogue);
  auto search = search_for_one_fault(right, options.seed, options.actions);
  search.on_finding = [&](const explore::Finding& finding) {
    if (!counts_as_found(finding)) return false;
    if (!out.found) {
      out.actions = finding.actions_until;
      out.shortest = finding.conversation.size();
    }
    out.found = true;
    const auto rule = finding.assigned ? catalogue.canonical(finding.assigned->requirement) : std::nullopt;
    out.said.push_back(rule ? *rule + " " + word_of(finding, catalogue)
                            : "? " + explore::describe(finding.conversation.back(), right.words.node) +
                                  " : " + explore::came_text(finding, right.words) + " / " +
                                  explore::due_text(finding, right.words));
    if (!rule || std::ranges::find(violates, *rule) == violates.end()) return false;
    out.named = true;
    out.shortest = finding.conversation.size();
    return true;
  };
  auto result = explore::search(bench, right.words, search);
  if (!result) return std::unexpected(result.error());
  if (!out.found) out.actions = result->actions;
  return out;
}

/// The device has the variants and its model has not: what differs is legal, and no rule may blame it.
Result<VariantFound> found_of(std::vector<std::string> variants, const device::Profile& profile,
                              const scenario::Catalogue& catalogue, const ExploreProofOptions& options) {
  VariantFound out{.variants = std::move(variants)};
  const NodeSwitches switches{.variants = out.variants};
  auto node = refnode::Node::create({.node_id = profile.node.value(), .variants = out.variants});
  if (!node) return std::unexpected(node.error());
  auto device =
      explorable_of(profile_of_variants(profile, (*node)->dictionary(), out.variants), switches, {});
  if (!device) return std::unexpected(device.error());
  std::vector<std::string> warns;
  for (const auto& id : out.variants)
    std::ranges::copy(canonical(refnode::find_variant(id)->warns, catalogue), std::back_inserter(warns));
  explore::SearchOptions search;
  search.seed = options.seed;
  search.most_actions = options.actions;
  search.repeats = 1;
  search.offer = device->offer;
  search.on_finding = [&](const explore::Finding& finding) {
    if (word_of(finding, catalogue) != "FAIL") return false;
    if (std::ranges::find(warns, finding.assigned->requirement) != warns.end()) return false;
    std::string talk;
    for (const auto& action : finding.conversation)
      talk += explore::describe(action, device->words.node) + "; ";
    out.blamed.push_back(fmt::format("{}: {} -> {}, due {}", finding.assigned->requirement, talk,
                                     explore::came_text(finding, device->words),
                                     explore::due_text(finding, device->words)));
    return false;
  };
  auto result = explore::search(device->bench, device->words, search);
  if (!result) return std::unexpected(result.error());
  out.episodes = result->episodes;
  out.learnt = result->chosen.size();
  return out;
}

}  // namespace

Result<Explorable> explorable_of(const device::Profile& profile, const NodeSwitches& device,
                                 const std::vector<std::string>& adapted) {
  Explorable out;
  out.words = explore::vocabulary_of(profile);
  out.bench.facts = engine::facts_of_run(profile);
  // A conversation begins right behind a reset: what was commanded there is not held against the device.
  out.bench.facts.deaf_time = out.bench.facts.nmt_time;
  out.bench.facts.alone = true;
  for (const auto& rule : monitor::rules()) out.bench.monitors.push_back(&rule);
  out.bench.device = maker_of(device, profile.node);
  const auto model = as_told(profile, {.variants = adapted, .description = device.description});
  out.bench.model = maker_of(model, profile.node);
  out.offer = offer_of(profile, model);
  // What cannot be made is said now, not in the middle of the search.
  for (const auto* make : {&out.bench.device, &out.bench.model}) {
    if (auto made = (*make)(); !made) return std::unexpected(made.error());
  }
  return out;
}

explore::SearchOptions search_for_one_fault(const Explorable& right, std::uint64_t seed,
                                            std::size_t actions) {
  explore::SearchOptions out;
  out.seed = seed;
  out.most_actions = actions;
  out.most_findings = 12;
  out.offer = right.offer;
  out.repeats = 1;
  return out;
}

bool counts_as_found(const explore::Finding& finding) {
  const bool by_monitor = finding.played.difference->what == explore::Difference::What::rule;
  return !by_monitor || finding.is_violation();
}

std::string summary_of_choice(std::string_view id) {
  const auto* variant = refnode::find_variant(id);
  return variant == nullptr ? std::string(id) : fmt::format("{} ({})", variant->summary, id);
}

std::string word_of(const explore::Finding& finding, const scenario::Catalogue& catalogue) {
  if (!finding.assigned) return "DIFF";
  const bool fails =
      finding.is_violation() && !finding.is_flaky() && is_binding(finding.assigned->requirement, catalogue);
  return fails ? "FAIL" : "WARN";
}

FoundCounts count_words(const explore::SearchResult& result, const scenario::Catalogue& catalogue) {
  FoundCounts out;
  for (const auto& finding : result.findings) {
    const auto word = word_of(finding, catalogue);
    ++(word == "FAIL" ? out.fail : word == "WARN" ? out.warn : out.open);
  }
  return out;
}

std::size_t ExploreProof::found() const {
  return static_cast<std::size_t>(std::ranges::count_if(defects, &DefectFound::found));
}
std::size_t ExploreProof::named() const {
  return static_cast<std::size_t>(std::ranges::count_if(defects, &DefectFound::named));
}
std::size_t ExploreProof::falsely_blamed() const {
  std::size_t out = 0;
  for (const auto& each : variants) out += each.blamed.size();
  return out;
}
double ExploreProof::median_length() const {
  std::vector<std::size_t> lengths;
  for (const auto& each : defects) {
    if (each.found) lengths.push_back(each.shortest);
  }
  if (lengths.empty()) return 0;
  std::ranges::sort(lengths);
  const auto middle = lengths.size() / 2;
  return lengths.size() % 2 == 1 ? static_cast<double>(lengths[middle])
                                 : static_cast<double>(lengths[middle - 1] + lengths[middle]) / 2;
}

std::string exploration_words(const ExploreProof& proof, bool verbose) {
  std::string out;
  for (const auto& each : proof.defects) {
    if (!each.found) out += fmt::format("not found   {}\n", each.id);
    if (!verbose || !each.found || each.named) continue;
    out += fmt::format("other name  {}\n", each.id);
    for (const auto& said : each.said) out += fmt::format("            {}\n", said);
  }
  for (const auto& each : proof.variants) {
    for (const auto& line : each.blamed)
      out += fmt::format("blamed      {}: {}\n", fmt::join(each.variants, ","), line);
  }
  const auto share = [&](std::size_t part) {
    return proof.defects.empty()
               ? 0.0
               : 100.0 * static_cast<double>(part) / static_cast<double>(proof.defects.size());
  };
  if (!proof.defects.empty())
    out += fmt::format(
        "exploration: {} of {} defects found ({:.1f} %), {} by a requirement they violate ({:.1f} %), median {} actions\n",
        proof.found(), proof.defects.size(), share(proof.found()), proof.named(), share(proof.named()),
        proof.median_length());
  std::size_t episodes = 0, learnt = 0;
  for (const auto& each : proof.variants) {
    episodes += each.episodes;
    learnt += each.learnt;
  }
  if (!proof.variants.empty())
    out += fmt::format(
        "exploration: {} conversations with {} legal devices, {} choices learnt, {} false findings\n",
        episodes, proof.variants.size(), learnt, proof.falsely_blamed());
  return out;
}

Result<ExploreProof> prove_exploration(const device::Profile& profile, const scenario::Catalogue& catalogue,
                                       const ExploreProofOptions& options) {
  // What is asked for: some defects, random legal devices, or all defects and every legal variant.
  const bool drawn = options.combinations > 0;
  const bool no_defects = drawn || (options.only.empty() && !options.variants.empty());
  const auto rows = no_defects ? std::vector<const refnode::Defect*>() : chosen_rows(options.only);
  const auto right = explorable_of(profile, {}, {});
  if (!right) return std::unexpected(right.error());
  auto found = all_in_parallel(rows.size(), options.jobs,
                               [&](std::size_t i) { return found_of(*rows[i], *right, catalogue, options); });
  if (!found) return std::unexpected(found.error());
  std::vector<std::vector<std::string>> devices;
  for (std::size_t i = 0; i < options.combinations; ++i)
    devices.push_back(draw_combination(options.seed, i).variants);
  for (const auto& id : options.variants) {
    if (refnode::find_variant(id) != nullptr) devices.push_back({id});
  }
  if (!drawn && options.only.empty() && options.variants.empty()) {
    for (const auto& variant : refnode::variants()) devices.push_back({std::string(variant.id)});
  }
  auto legal = all_in_parallel(devices.size(), options.jobs, [&](std::size_t i) {
    return found_of(devices[i], profile, catalogue, options);
  });
  if (!legal) return std::unexpected(legal.error());
  return ExploreProof{std::move(*found), std::move(*legal)};
}

}  // namespace conform::cli
