// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/html/document.hpp"
#include "reports/html/markup.hpp"
#include "reports/html/plots.hpp"
#include "reports/html/sections.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {
namespace {

using result::Measurement;
using result::RunResult;
using result::Sample;

// So many series of one kind get a drawing each; more are drawn together and listed, the slowest first.
constexpr std::size_t most_drawings = 12;
constexpr std::size_t listed_first = 15;
constexpr std::size_t listed_at_all = 200;

struct Span {
  BusTime begin, end;
};

/// The time that the drawings of this run have in common.
Span span_of(const RunResult& run) {
  Span span{BusTime::max(), BusTime::min()};
  const auto take = [&](BusTime from, BusTime to) {
    span.begin = std::min(span.begin, from);
    span.end = std::max(span.end, to);
  };
  for (const auto& one : run.cases) {
    if (one.finished) take(one.begin, one.end);
  }
  for (const auto& stretch : run.load) take(stretch.from, stretch.from + stretch.span);
  for (const auto& each : run.measurements) {
    for (const auto& sample : each.samples) take(sample.at, sample.at);
  }
  return span.begin <= span.end ? span : Span{};
}

std::string limits_text(const Measurement& one) {
  std::string out;
  if (one.nominal) out += fmt::format(", nominal {}", brief_duration(*one.nominal));
  if (one.least) out += fmt::format(", at least {}", brief_duration(*one.least));
  if (one.most) out += fmt::format(", at most {}", brief_duration(*one.most));
  return out;
}

std::string numbers(const Measurement& one) {
  return fmt::format("{}: {} to {} ms, mean {} ms{}", counted(one.count, "time"), milliseconds(one.shortest),
                     milliseconds(one.longest), milliseconds(one.mean), limits_text(one));
}

std::string figure(const Book& book, const Measurement& one, const Span& span) {
  const Limits limits{one.nominal, one.least, one.most};
  const auto outside = static_cast<std::size_t>(
      std::ranges::count_if(one.samples, [&](const Sample& each) { return !limits.hold(each.value); }));
  const auto words = fmt::format("{} of {}, {}", one.kind, one.of, numbers(one));
  std::string out = "<figure>\n" + strip_plot(book, clip(prose(words), 300), thinned(one.samples), limits,
                                              span.begin, span.end);
  out += fmt::format("<figcaption><b>{}</b>: {}", clipped(prose(one.of), 200), numbers(one));
  if (outside > 0) out += fmt::format(". <b>{} outside of the limits</b>, drawn as crosses", outside);
  return out + "</figcaption>\n</figure>\n";
}

/// Shortest, mean and longest of each, the slowest first.
std::string ranges(std::vector<const Measurement*> all) {
  std::ranges::stable_sort(all, std::greater{}, [](const Measurement* one) { return one->longest; });
  const Duration scale = all.front()->longest;
  const auto table = [&](std::size_t from, std::size_t to) {
    std::string out =
        "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Times, the slowest first\"><table class=\"ranges\">"
        "<thead><tr><th scope=\"col\">of</th><th scope=\"col\" class=\"num\">how many</th><th scope=\"col\" class=\"num\">shortest, ms</th>"
        "<th scope=\"col\" class=\"num\">mean, ms</th><th scope=\"col\" class=\"num\">longest, ms</th>"
        "<th scope=\"col\"><span class=\"sr\">drawn</span></th></tr></thead><tbody>\n";
    for (std::size_t i = from; i < to; ++i) {
      const auto& one = *all[i];
      out += fmt::format(
          "<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td><td class=\"num\">{}</td><td class=\"num\">{}</td>"
          "<td class=\"num\">{}</td><td>{}</td></tr>\n",
          clipped(prose(one.of), 100), one.count, milliseconds(one.shortest), milliseconds(one.mean),
          milliseconds(one.longest), range_plot(one, scale));
    }
    return out + "</tbody></table></div>\n";
  };
  const std::size_t shown = std::min(all.size(), listed_first);
  const std::size_t end = std::min(all.size(), listed_at_all);
  std::string out = table(0, shown);
  if (end > shown) out += folded(fmt::format("the {} next slowest", end - shown), table(shown, end));
  if (all.size() > end)
    out += fmt::format(
        "<p class=\"quiet\">{} more, all of them faster, are in the result.json of the run.</p>\n",
        all.size() - end);
  return out;
}

std::string together(const Book& book, const std::string& kind, const std::vector<const Measurement*>& all,
                     const Span& span) {
  std::vector<Sample> samples;
  Measurement total{kind, "all", {}, {}, {}, 0, Duration::max(), Duration::min(), {}, {}};
  double sum = 0;
  for (const auto* one : all) {
    samples.insert(samples.end(), one->samples.begin(), one->samples.end());
    total.count += one->count;
    total.shortest = std::min(total.shortest, one->shortest);
    total.longest = std::max(total.longest, one->longest);
    sum += static_cast<double>(one->mean.count()) * static_cast<double>(one->count);
  }
  if (total.count > 0)
    total.mean = Duration(static_cast<Duration::rep>(sum / static_cast<double>(total.count)));
  const auto words = fmt::format("{}, of {}, {}", kind, counted(all.size(), "object"), numbers(total));
  const std::size_t sampled = samples.size();
  auto dots = thinned(std::move(samples));
  std::string out = "<figure>\n" + strip_plot(book, clip(prose(words), 300), dots, {}, span.begin, span.end);
  out += fmt::format("<figcaption><b>all</b>: {}", numbers(total));
  if (dots.size() < sampled)
    out += fmt::format("; {} are drawn, the longest among them", counted(dots.size(), "sample"));
  return out + "</figcaption>\n</figure>\n" + ranges(all);
}

std::string measured(const Book& book, const Span& span) {
  std::vector<std::pair<std::string, std::vector<const Measurement*>>> kinds;
  for (const auto& one : book.run().measurements) {
    if (one.count == 0) continue;
    if (kinds.empty() || kinds.back().first != one.kind)
      kinds.emplace_back(one.kind, std::vector<const Measurement*>{});
    kinds.back().second.push_back(&one);
  }
  std::string out;
  for (const auto& [kind, all] : kinds) {
    out += fmt::format("<h3>{}</h3>\n", clipped(prose(kind), 200));
    // Answers of one server are one thing, whatever the object.
    if (all.size() > most_drawings || (kind == "SDO answer" && all.size() > 1)) {
      out += together(book, kind, all, span);
      continue;
    }
    for (const auto* one : all) out += figure(book, *one, span);
  }
  return out;
}

std::string load(const Book& book) {
  const auto& stretches = book.run().load;
  if (stretches.empty()) return {};
  const bool known = std::ranges::any_of(stretches, [](const auto& each) { return each.busy > Duration{}; });
  std::vector<BusTime> from;
  std::vector<double> values;
  std::size_t frames = 0;
  double whole = 0, busy = 0;
  for (const auto& each : stretches) {
    const auto span = static_cast<double>(std::max<Duration::rep>(each.span.count(), 1));
    from.push_back(each.from);
    values.push_back(known ? 100.0 * static_cast<double>(each.busy.count()) / span
                           : 1e9 * static_cast<double>(each.frames) / span);
    frames += each.frames;
    whole += span;
    busy += static_cast<double>(each.busy.count());
  }
  const double highest = *std::ranges::max_element(values);
  const double mean = known ? 100.0 * busy / whole : 1e9 * static_cast<double>(frames) / whole;
  const std::string_view unit = known ? "%" : "1/s";
  const auto words = fmt::format("{}, {:.1f} {} in the mean, {:.1f} {} in the busiest stretch of {}",
                                 counted(frames, "frame"), mean, unit, highest, unit,
                                 brief_duration(stretches.front().span));
  return fmt::format("<h3>{} over the run</h3>\n<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n",
                     known ? "Load of the bus" : "Frames on the bus",
                     step_plot(book, words, from, values, stretches.front().span, unit), words);
}

/// The first two parts of the suite's path: "cia301/sdo".
std::string area_of(const std::string& suite) {
  const auto parts = split(suite, '/');
  return parts.size() < 2 ? suite : fmt::format("{}/{}", parts[0], parts[1]);
}

std::string time_spent(const RunResult& run) {
  struct Spent {
    Duration time{};
    std::size_t cases = 0;
  };
  std::map<std::string, Spent> by_area;
  Duration longest{};
  for (const auto& one : run.cases) {
    if (!one.finished || one.suite == "monitor") continue;  // monitors watch the others
    auto& row = by_area[area_of(one.suite)];
    row.time += one.end - one.begin;
    ++row.cases;
    longest = std::max(longest, row.time);
  }
  if (longest <= Duration{}) return {};
  std::vector<std::pair<std::string, Spent>> rows(by_area.begin(), by_area.end());
  std::ranges::stable_sort(rows, std::greater{}, [](const auto& row) { return row.second.time; });
  std::string out =
      "<h3>Where the time of the run went</h3>\n"
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Time by folder of the suite\"><table class=\"ranges\"><thead><tr>"
      "<th scope=\"col\">suite</th><th scope=\"col\" class=\"num\">cases</th><th scope=\"col\" class=\"num\">bus time</th>"
      "<th scope=\"col\"><span class=\"sr\">drawn</span></th></tr></thead><tbody>\n";
  for (const auto& [area, spent] : rows)
    out += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td><td class=\"num\">{}</td><td>{}</td></tr>\n",
        clipped(area, 100), spent.cases, brief_duration(spent.time),
        length_bar(static_cast<double>(spent.time.count()) / static_cast<double>(longest.count())));
  return out + "</tbody></table></div>\n";
}

}  // namespace

std::string measurement_section(const Book& book) {
  const std::string content = measured(book, span_of(book.run())) + load(book) + time_spent(book.run());
  return section("measurements", "Measurements", content);
}

}  // namespace conform::reports::html
