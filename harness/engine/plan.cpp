// SPDX-License-Identifier: Apache-2.0
#include "engine/plan.hpp"

#include <algorithm>
#include <set>
#include <span>
#include <tuple>

#include "base/random.hpp"
#include "base/text.hpp"
#include "engine/given.hpp"
#include "result/case_name.hpp"
#include "scenario/query.hpp"

namespace conform::engine {
namespace {

using result::instance_of;
using result::scenario_of;

/// `count` of the items, in their old order: the first and the last one, where a device is wrong most easily,
/// and what the seed chooses between them.
std::vector<Multiplexer> sample(std::vector<Multiplexer> items, std::size_t count, std::uint64_t seed) {
  if (items.size() <= count) return items;
  std::vector<std::size_t> order(items.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  if (count > 1) std::swap(order[1], order.back());
  for (std::size_t i = count > 1 ? 2 : 0; i < count; ++i) {
    const auto j = i + static_cast<std::size_t>(next_random(seed) % (order.size() - i));
    std::swap(order[i], order[j]);
  }
  order.resize(count);
  std::ranges::sort(order);
  std::vector<Multiplexer> out;
  for (const auto index : order) out.push_back(items[index]);
  return out;
}

/// What a sample of `objects` has left out, dealt out to its cases in turn. A few each: a device of hundreds
/// of PDOs that are all off is not asked for each of them.
void add_stand_ins(std::span<PlannedCase> cases, const std::vector<Multiplexer>& objects) {
  constexpr std::size_t most = 4;
  std::set<std::string> drawn;
  for (const auto& planned : cases) drawn.insert(planned.instance);
  std::size_t turn = 0;
  for (const auto object : objects) {
    auto name = to_string(object);
    if (drawn.contains(name)) continue;
    auto& stand_ins = cases[turn++ % cases.size()].stand_ins;
    if (stand_ins.size() == most) return;
    stand_ins.push_back(std::move(name));
  }
}

std::vector<PlannedCase> expand(const scenario::Scenario& scenario, const device::Dictionary& dictionary,
                                const PlanOptions& options) {
  std::vector<PlannedCase> out;
  const auto add = [&](std::string instance) -> PlannedCase& {
    PlannedCase planned;
    planned.scenario = &scenario;
    planned.instance = std::move(instance);
    return out.emplace_back(std::move(planned));
  };
  if (!scenario.for_each) {
    add("");
  } else if (scenario.for_each->query.empty()) {
    for (const auto& row : scenario.for_each->rows) add(row.name).names = row.texts;
  } else {
    const auto query = scenario::Query::parse(scenario.for_each->query);
    auto objects = query ? query->select(dictionary) : std::vector<Multiplexer>();
    // What the profile forbids to write is left out of every walk that may write.
    if (scenario.risk > scenario::Risk::read_only) {
      std::erase_if(objects, [&dictionary](Multiplexer object) {
        const auto* entry = dictionary.find(object);
        return entry != nullptr && entry->untouchable;
      });
    }
    if (objects.empty()) {
      auto& none = add("");
      none.not_applicable = "the device has no " + (query ? query->words() : scenario.for_each->query);
      if (query) none.wants = wants_of(*query);
    }
    const bool sampled = scenario.sample > 0 && !options.all_objects;
    for (const auto object : sampled ? sample(objects, scenario.sample, options.seed) : objects)
      add(to_string(object)).names[scenario.for_each->variable] = to_string(object);
    if (out.size() < objects.size()) add_stand_ins(out, objects);
  }
  return out;
}

std::string name_of(const PlannedCase& planned) {
  return planned.instance.empty() ? planned.scenario->id
                                  : planned.scenario->id + "[" + planned.instance + "]";
}

/// Ids of the scenarios of which instances are named one by one, as patterns.
std::set<std::string, std::less<>> with_named_instances(const PlanOptions& options) {
  std::set<std::string, std::less<>> out;
  const auto add = [&out](const std::string& name) {
    if (!instance_of(name).empty()) out.emplace(scenario_of(name));
  };
  std::ranges::for_each(options.selection.patterns, add);
  if (options.only) std::ranges::for_each(*options.only, add);
  return out;
}

std::vector<PlannedCase> chosen(const scenario::Suite& suite, const scenario::Catalogue& catalogue,
                                const device::Dictionary& dictionary, const PlanOptions& options) {
  std::vector<PlannedCase> out;
  const auto named = with_named_instances(options);
  auto whole = options;
  whole.all_objects = true;
  for (const auto& file : suite.files) {
    for (const auto& scenario : file.scenarios) {
      // Before its objects are looked for: of a few rules most scenarios decide none.
      if (!options.selection.takes_any_of(scenario, catalogue)) continue;
      // An instance that is named is wanted also where the sample would be without it.
      const bool each = std::ranges::any_of(named, [&scenario](const std::string& pattern) {
        return scenario::matches_pattern(pattern, scenario.id);
      });
      for (auto& planned : expand(scenario, dictionary, each ? whole : options)) {
        if (!options.selection.takes(scenario, planned.instance, catalogue)) continue;
        std::erase_if(planned.stand_ins, [&](const std::string& object) {
          return !options.selection.takes(scenario, object, catalogue);
        });
        if (scenario.risk > options.allowed) {
          planned.held_back = "held back: risk '" + std::string(steps::word_of(scenario.risk)) +
                              "' is not allowed in this run (--allow " +
                              std::string(steps::word_of(scenario.risk)) + ")";
          planned.wants = {{"option", "--allow " + std::string(steps::word_of(scenario.risk))}};
        }
        if (scenario.slow && !options.slow && planned.held_back.empty()) {
          planned.held_back = "held back: takes long on a real bus (--slow)";
          planned.wants = {{"option", "--slow"}};
        }
        out.push_back(std::move(planned));
      }
    }
  }
  if (options.only) {
    std::erase_if(out, [&](const PlannedCase& planned) { return !options.only->contains(name_of(planned)); });
  }
  return out;
}

void put_in_order(std::vector<PlannedCase>& out, const PlanOptions& options) {
  if (!options.order.empty()) {
    const auto place = [&order = options.order](const PlannedCase& planned) {
      return std::ranges::find(order, planned.scenario->id) - order.begin();
    };
    std::erase_if(out, [&](const PlannedCase& planned) {
      return place(planned) == static_cast<std::ptrdiff_t>(options.order.size());
    });
    std::ranges::stable_sort(out, {}, place);
    return;
  }
  if (options.shuffle) {
    std::uint64_t seed = *options.shuffle;
    for (std::size_t i = out.size(); i > 1; --i) std::swap(out[i - 1], out[next_random(seed) % i]);
    return;
  }
  if (options.worths != nullptr) {
    std::vector<std::string> names;
    for (const auto& planned : out) names.push_back(name_of(planned));
    const auto places = options.worths->places(names);
    std::vector<std::pair<std::size_t, PlannedCase>> placed;
    for (std::size_t i = 0; i < out.size(); ++i) placed.emplace_back(places[i], std::move(out[i]));
    std::ranges::stable_sort(placed, {}, &std::pair<std::size_t, PlannedCase>::first);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::move(placed[i].second);
    return;
  }
  std::ranges::stable_sort(out, {}, [](const PlannedCase& planned) {
    // What others rest on is judged before them, as early as its risk allows.
    const auto& establishes = planned.scenario->establishes;
    const auto channel =
        establishes.empty() ? steps::channels().size() : steps::rank_of_channel(establishes.front());
    return std::tuple(!planned.scenario->basic, planned.scenario->risk, channel);
  });
}

}  // namespace

PlannedCase PlannedCase::of(const std::string& object) const {
  auto out = *this;
  out.instance = object;
  out.names[scenario->for_each->variable] = object;
  out.stand_ins.clear();
  return out;
}

std::vector<PlannedCase> plan(const scenario::Suite& suite, const scenario::Catalogue& catalogue,
                              const device::Dictionary& dictionary, const PlanOptions& options) {
  auto out = chosen(suite, catalogue, dictionary, options);
  put_in_order(out, options);
  std::size_t number = 0;
  std::erase_if(out,
                [&](const PlannedCase&) { return number++ % options.shard.of != options.shard.number - 1; });
  return out;
}

std::vector<PlannedCase> named_but_absent(const scenario::Suite& suite, const scenario::Catalogue& catalogue,
                                          const device::Dictionary& dictionary, const PlanOptions& options) {
  std::set<std::string> wanted;
  for (const auto& pattern : options.selection.patterns) {
    if (!instance_of(pattern).empty()) wanted.insert(pattern);
  }
  if (options.only) wanted.insert(options.only->begin(), options.only->end());
  if (wanted.empty() || options.shard.number != 1) return {};
  for (const auto& planned : chosen(suite, catalogue, dictionary, options)) {
    std::erase_if(wanted, [name = name_of(planned)](const std::string& pattern) {
      return scenario::matches_pattern(pattern, name);
    });
  }
  std::vector<PlannedCase> out;
  for (const auto& name : wanted) {
    for (const auto& file : suite.files) {
      for (const auto& scenario : file.scenarios) {
        if (!scenario::matches_pattern(scenario_of(name), scenario.id)) continue;
        auto instance = instance_of(name);
        if (!instance.empty()) instance.remove_prefix(1);
        out.push_back({.scenario = &scenario,
                       .instance = std::string(instance.substr(0, instance.find(']'))),
                       .names = {},
                       .held_back = {},
                       .not_applicable = {},
                       .wants = {},
                       .absent = "'" + name + "' is asked for, and there is no such case for this device",
                       .stand_ins = {}});
      }
    }
  }
  return out;
}

result::CaseResult planned_result(const PlannedCase& planned, const scenario::Catalogue& catalogue) {
  const auto& scenario = *planned.scenario;
  result::CaseResult out;
  out.id = scenario.id;
  out.instance = planned.instance;
  out.title = scenario.title;
  out.suite = scenario.suite;
  out.position = scenario.position;
  out.cct = scenario.cct;
  out.requirements = scenario.requirements;
  // A row of for_each that names its requirement narrows the list to what this instance decides.
  if (scenario.for_each && !planned.names.empty()) {
    std::set<std::string> others;
    for (const auto& row : scenario.for_each->rows) {
      for (const auto& [name, text] : row.texts) {
        if (const auto id = catalogue.canonical(text)) others.insert(*id);
      }
    }
    for (const auto& [name, text] : planned.names) {
      if (const auto id = catalogue.canonical(text)) others.erase(*id);
    }
    std::erase_if(out.requirements, [&others](const std::string& id) { return others.contains(id); });
  }
  return out;
}

}  // namespace conform::engine
