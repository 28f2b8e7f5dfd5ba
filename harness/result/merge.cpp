// SPDX-License-Identifier: Apache-2.0
#include "result/merge.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

namespace conform::result {
namespace {

constexpr std::string_view shard_property = "run.shard";
/// What must be the same in all parts, beside the device and the number of parts.
constexpr std::string_view shared_properties[] = {
    "suite.digest", "run.seed",          "run.shuffle",        "run.allowed",
    "run.budget",   "run.timeout_scale", "simulation.defects", "simulation.variants"};

/// Frames and times of a part, behind those of the parts before it.
struct Shift {
  std::size_t frames = 0;
  Duration time{};
};

std::size_t frames_of(const RunResult& run) {
  std::size_t out = 0;
  for (const auto& each : run.cases) out = std::max(out, each.end_frame);
  return out;
}

void shift(Finding& finding, const Shift& by) {
  for (auto& frame : finding.evidence) {
    frame.capture_index += by.frames;
    frame.time += by.time;
  }
  if (finding.frames_seen > 0) finding.frames_seen += by.frames;
}

void shift(CaseResult& one, const Shift& by) {
  one.begin += by.time;
  one.end += by.time;
  one.first_frame += by.frames;
  one.end_frame += by.frames;
  for (auto& judgement : one.judgements) {
    if (judgement.frames_seen > 0) judgement.frames_seen += by.frames;
    if (judgement.decided_by && judgement.decided_by->frame) *judgement.decided_by->frame += by.frames;
    for (auto& finding : judgement.findings) shift(finding, by);
  }
  for (auto& finding : one.setup_findings) shift(finding, by);
}

void shift(RunResult& run, const Shift& by) {
  for (auto& each : run.cases) shift(each, by);
  for (auto& each : run.load) each.from += by.time;
  for (auto& each : run.measurements) {
    for (auto& sample : each.samples) sample.at += by.time;
  }
}

/// What a monitor saw in one more part.
void add(CaseResult& to, CaseResult&& more) {
  for (auto& judgement : more.judgements) {
    const auto same = std::ranges::find(to.judgements, judgement.requirement, &Judgement::requirement);
    if (same == to.judgements.end()) {
      to.judgements.push_back(std::move(judgement));
      continue;
    }
    same->verdict = worst(same->verdict, judgement.verdict);
    same->expectations += judgement.expectations;
    same->frames_seen = std::max(same->frames_seen, judgement.frames_seen);
    std::ranges::move(judgement.findings, std::back_inserter(same->findings));
    if (same->reason.empty()) same->reason = judgement.reason;
    if (same->waived.empty()) same->waived = judgement.waived;
  }
  // The reason belongs to the worst verdict; a monitor that had something to judge needs none for the part
  // without.
  const auto both = worst(to.verdict, more.verdict);
  if (both != to.verdict) to.reason = more.reason;
  to.verdict = both;
  to.finished = to.finished && more.finished;
  to.end = std::max(to.end, more.end);
  to.end_frame = std::max(to.end_frame, more.end_frame);
}

void add(Measurement& to, const Measurement& more) {
  const auto count = to.count + more.count;
  if (count == 0) return;
  const auto weighted = [](const Measurement& each) {
    return std::chrono::duration<double, Duration::period>(each.mean) * static_cast<double>(each.count);
  };
  to.mean = std::chrono::round<Duration>((weighted(to) + weighted(more)) / static_cast<double>(count));
  to.shortest = to.count == 0 ? more.shortest : std::min(to.shortest, more.shortest);
  to.longest = std::max(to.longest, more.longest);
  to.count = count;
  to.samples.insert(to.samples.end(), more.samples.begin(), more.samples.end());
}

/// A waiver that one part needed is needed, whatever the others say.
int rank(const WaiverUse& use) {
  if (use.verdict == Verdict::waived) return 3;
  if (use.state == "expired") return 2;
  return use.state.starts_with("not needed") ? 1 : 0;
}

void add(std::vector<WaiverUse>& to, const std::vector<WaiverUse>& more) {
  const auto key = [](const WaiverUse& use) {
    return std::tie(use.place, use.requirement, use.case_name, use.object);
  };
  for (const auto& use : more) {
    const auto same = std::ranges::find_if(to, [&](const WaiverUse& each) { return key(each) == key(use); });
    if (same == to.end()) {
      to.push_back(use);
      continue;
    }
    if (rank(use) > rank(*same)) {
      same->state = use.state;
      same->verdict = use.verdict;
    }
    for (const auto& name : use.cases) {
      if (std::ranges::find(same->cases, name) == same->cases.end()) same->cases.push_back(name);
    }
  }
}

template <typename T, typename Key>
void add_new(std::vector<T>& to, const std::vector<T>& more, const Key& key) {
  for (const auto& each : more) {
    const auto same = [&](const T& known) { return std::invoke(key, known) == std::invoke(key, each); };
    if (std::ranges::none_of(to, same)) to.push_back(each);
  }
}

/// The same with the next part behind it.
void append(RunResult& to, RunResult part) {
  shift(part, {frames_of(to), to.elapsed});
  const auto monitors =
      std::ranges::find(to.cases, std::string("monitor"), &CaseResult::suite) - to.cases.begin();
  std::vector<CaseResult> played;
  for (auto& each : part.cases) {
    if (each.suite != "monitor") {
      played.push_back(std::move(each));
      continue;
    }
    const auto same = std::ranges::find_if(
        to.cases, [&](const CaseResult& known) { return known.suite == "monitor" && known.id == each.id; });
    if (same == to.cases.end()) {
      to.cases.push_back(std::move(each));
    } else {
      add(*same, std::move(each));
    }
  }
  to.cases.insert(to.cases.begin() + monitors, std::make_move_iterator(played.begin()),
                  std::make_move_iterator(played.end()));
  to.elapsed += part.elapsed;
  to.started_utc_ns = std::min(to.started_utc_ns, part.started_utc_ns);
  if (to.signal == 0) to.signal = part.signal;
  add_new(to.properties, part.properties, [](const Property& each) { return each.name; });
  add_new(to.requirements, part.requirements, &RequirementInfo::id);
  std::ranges::sort(to.requirements, {}, &RequirementInfo::id);
  add_new(to.notes, part.notes, std::identity{});
  add_new(to.unwritten, part.unwritten, std::identity{});
  add_new(to.changes, part.changes, &Change::object);
  add_new(to.dictionary, part.dictionary, &EntryFacts::object);
  add(to.waivers, part.waivers);
  to.load.insert(to.load.end(), part.load.begin(), part.load.end());
  for (const auto& each : part.measurements) {
    const auto same = std::ranges::find_if(to.measurements, [&](const Measurement& known) {
      return known.kind == each.kind && known.of == each.of;
    });
    if (same == to.measurements.end()) {
      to.measurements.push_back(each);
    } else {
      add(*same, each);
    }
  }
}

std::string words(const PartOfRun& part) { return fmt::format("part {} of {}", part.number, part.of); }

/// Error: they are not parts of one run.
Result<void> belong_together(const NamedRun& first, const NamedRun& other) {
  const auto differ = [&](std::string_view what, const std::string& here, const std::string& there) {
    return fail(fmt::format("are no parts of one run: {} is '{}' in the one and '{}' in the other", what,
                            here, there),
                first.name + " and " + other.name);
  };
  if (first.run.tool != other.run.tool)
    return differ("the version of the tool", first.run.tool, other.run.tool);
  for (const auto name : shared_properties) {
    const auto here = property_of(first.run, name), there = property_of(other.run, name);
    if (here != there) return differ(name, here, there);
  }
  return {};
}

}  // namespace

std::optional<PartOfRun> part_of_run(const RunResult& run) {
  const auto text = property_of(run, shard_property);
  PartOfRun out;
  const auto* const end = text.data() + text.size();
  const auto [slash, error] = std::from_chars(text.data(), end, out.number);
  if (error != std::errc() || slash == end || *slash != '/') return std::nullopt;
  const auto [rest, second] = std::from_chars(slash + 1, end, out.of);
  if (second != std::errc() || rest != end || out.number < 1 || out.number > out.of) return std::nullopt;
  return out;
}

std::string identity_of(const RunResult& run) {
  std::string out;
  for (const std::string_view name :
       {"dut.node_id", "dut.device_type", "dut.vendor_id", "dut.product_code", "dut.revision", "dut.serial",
        "dut.name", "dut.hardware_version", "dut.software_version"}) {
    if (auto value = property_of(run, name); !value.empty()) out += fmt::format("{}={}\n", name, value);
  }
  return out;
}

Result<RunResult> merge_parts(std::span<const NamedRun> parts) {
  std::map<std::size_t, const NamedRun*> by_number;
  const auto of = part_of_run(parts.front().run).value_or(PartOfRun{}).of;
  for (const auto& each : parts) {
    const auto part = part_of_run(each.run);
    if (!part) return fail("is no part of a run that was cut by --shard", each.name);
    if (part->of != of)
      return fail(fmt::format("is {}, and {} is one of {}", words(*part), parts.front().name, of), each.name);
    const auto [known, is_new] = by_number.emplace(part->number, &each);
    if (!is_new)
      return fail(fmt::format("is {} as well as {}", words(*part), known->second->name), each.name);
    if (auto sound = belong_together(parts.front(), each); !sound) return std::unexpected(sound.error());
  }
  std::optional<RunResult> out;
  std::vector<std::string> why;
  for (std::size_t number = 1; number <= of; ++number) {
    const auto found = by_number.find(number);
    if (found == by_number.end()) {
      why.push_back(words({number, of}) + " is missing");
      continue;
    }
    const auto& run = found->second->run;
    if (run.aborted) why.push_back(words({number, of}) + ": " + *run.aborted);
    if (!out) {
      out = run;
    } else {
      append(*out, run);
    }
  }
  std::erase_if(out->properties, [](const Property& each) { return each.name == shard_property; });
  out->properties.push_back({"run.parts", std::to_string(of)});
  out->likenesses.clear();
  // It was made of the cases of one part each.
  if (!out->compared.empty()) out->notes.emplace_back("what CiA's tool would say is told by whole runs only");
  out->compared.clear();
  out->aborted.reset();
  for (const auto& each : why) out->aborted = out->aborted ? *out->aborted + "; " + each : each;
  std::ranges::sort(out->measurements, {},
                    [](const Measurement& each) { return std::tie(each.kind, each.of); });
  return std::move(*out);
}

}  // namespace conform::result
