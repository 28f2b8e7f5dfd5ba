// SPDX-License-Identifier: Apache-2.0
#include "reports/html/plots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "reports/html/axis.hpp"
#include "reports/html/markup.hpp"
#include "reports/text_tools.hpp"
#include "result/compare_times.hpp"

namespace conform::reports::html {
namespace {

using result::Sample;

constexpr double width = 960;
constexpr double left = 62;
constexpr double top = 10;
constexpr double bottom = 150;
constexpr double height = 180;
constexpr double strip_right = 770;
constexpr double counts_left = 788;
constexpr double right = width - 8;
constexpr std::size_t bins = 24;
// More dots than these nobody tells apart, and each takes its bytes in an e-mail.
constexpr std::size_t most_dots = 1500;
// A limit so many times beyond the longest sample is said and not drawn: the samples would be one line.
constexpr double far = 4;

double ms(Duration duration) { return static_cast<double>(duration.count()) / 1e6; }
double s(Duration duration) { return static_cast<double>(duration.count()) / 1e9; }

std::string svg_begin(const Book& book, std::string_view words) {
  const auto id = book.fresh_id();
  return fmt::format(
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{2}\">"
      "<svg class=\"plot\" viewBox=\"0 0 {0:g} {1:g}\" role=\"img\" aria-labelledby=\"{3}\"><title id=\"{3}\">{2}</title>\n",
      width, height, text(words), id);
}

std::string label(double x, double y, std::string_view kind, std::string_view words) {
  return fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\">{}</text>", kind, coordinate(x), coordinate(y),
                     words);
}

/// Both axes with their marks; `unit` stands at the upper one.
std::string axes(const Axis& x, const Axis& y, double to, std::string_view unit) {
  std::string lines = fmt::format("M{} {}V{}H{}", left, top, bottom, to);
  std::string grid, words;
  for (const double tick : y.ticks(4)) {
    grid += fmt::format("M{} {}H{}", left, coordinate(y.at(tick)), to);
    words += label(left - 6, y.at(tick) + 4, "t end", fmt::format("{:g}", tick));
  }
  for (const double tick : x.ticks(8)) {
    lines += fmt::format("M{} {}v4", coordinate(x.at(tick)), bottom);
    words += label(x.at(tick), bottom + 17, "t", fmt::format("{:g}", tick));
  }
  words += label(4, top + 6, "t start", unit) + label(4, bottom + 17, "t start", "s");
  return fmt::format("<path class=\"grid\" d=\"{}\"/><path class=\"axis\" d=\"{}\"/>{}\n", grid, lines,
                     words);
}

/// What the scale has to hold: the samples, and the limits that are not far away.
Axis scale_of(const std::vector<Sample>& samples, const Limits& limits) {
  const auto [shortest, longest] = std::ranges::minmax(samples, {}, &Sample::value);
  double low = ms(shortest.value);
  double high = ms(longest.value);
  const double furthest = high * far;
  for (const auto& limit : {limits.nominal, limits.least, limits.most}) {
    if (!limit || ms(*limit) > furthest) continue;
    low = std::min(low, ms(*limit));
    high = std::max(high, ms(*limit));
  }
  const double margin = high > low ? (high - low) * 0.08 : std::max(std::abs(high) * 0.1, 0.01);
  return Axis(std::max(low - margin, 0.0), high + margin, bottom, top);
}

std::string limit_lines(const Limits& limits, const Axis& y, double highest) {
  struct Line {
    std::string_view name;
    std::optional<Duration> value;
  };
  std::string out;
  for (const auto& [name, value] :
       std::array{Line{"nominal", limits.nominal}, Line{"least", limits.least}, Line{"most", limits.most}}) {
    if (!value || ms(*value) > highest) continue;
    const double at = y.at(ms(*value));
    out += fmt::format("<path class=\"{}\" d=\"M{} {}H{}\"/>{}", name == "nominal" ? "nominal" : "limit",
                       left, coordinate(at), right, label(right, at - 4, "t end halo", name));
  }
  return out;
}

/// One path for all dots: a line of no length with round ends is a dot, and takes ten bytes.
std::string dots(const std::vector<Sample>& samples, const Limits& limits, const Axis& x, const Axis& y,
                 BusTime begin) {
  std::string inside, outside;
  for (const Sample& sample : samples) {
    const auto at =
        fmt::format("M{} {}", coordinate(x.at(s(sample.at - begin))), coordinate(y.at(ms(sample.value))));
    if (limits.hold(sample.value)) {
      inside += at + "h0";
    } else {
      outside += at + "m-4-4l8 8m0-8l-8 8";  // a cross: told apart without colours
    }
  }
  std::string out;
  if (!inside.empty()) out += fmt::format("<path class=\"dots\" d=\"{}\"/>\n", inside);
  if (!outside.empty()) out += fmt::format("<path class=\"outside\" d=\"{}\"/>\n", outside);
  return out;
}

using BinCounts = std::array<std::size_t, bins>;

BinCounts counts_of(const std::vector<Sample>& samples, const Axis& y) {
  BinCounts counts{};
  for (const Sample& sample : samples) {
    const double share = (bottom - y.at(ms(sample.value))) / (bottom - top);
    ++counts.at(std::min(static_cast<std::size_t>(share * bins), bins - 1));
  }
  return counts;
}

std::string histogram(const std::vector<Sample>& samples, const Axis& y) {
  const BinCounts counts = counts_of(samples, y);
  const std::size_t most = std::max<std::size_t>(*std::ranges::max_element(counts), 1);
  constexpr double step = (bottom - top) / bins;
  std::string path;
  for (std::size_t i = 0; i < bins; ++i) {
    if (counts.at(i) == 0) continue;
    const double length =
        std::max((right - counts_left) * static_cast<double>(counts.at(i)) / static_cast<double>(most), 1.5);
    path += fmt::format("M{} {}h{}v{}h-{}z", counts_left,
                        coordinate(bottom - step * static_cast<double>(i + 1) + 0.5), coordinate(length),
                        coordinate(step - 1), coordinate(length));
  }
  return fmt::format(
      "<path class=\"axis\" d=\"M{0} {1}V{2}H{3}\"/><path class=\"count\" d=\"{4}\"/>{5}\n", counts_left, top,
      bottom, right, path,
      label((counts_left + right) / 2, bottom + 17, "t", fmt::format("how many, up to {}", most)));
}

// Of two series: a strip each, and the counts back to back around the middle of what is left.
constexpr double pair_gap = 18;
constexpr double first_right = 404;
constexpr double second_left = first_right + pair_gap;
constexpr double second_right = 764;
constexpr double middle = 870;
constexpr double half = 78;

/// Strip of one run, with its own time, on the scale that both have.
std::string half_strip(const std::vector<Sample>& samples, const Axis& y, double from, double to,
                       std::string_view words) {
  const auto [first, last] = std::ranges::minmax(samples, {}, &Sample::at);
  const Axis x(0, s(last.at - first.at), from + 4, to - 4);
  std::string lines = fmt::format("M{} {}V{}H{}", from, top, bottom, to), grid, marks;
  for (const double tick : y.ticks(4)) grid += fmt::format("M{} {}H{}", from, coordinate(y.at(tick)), to);
  for (const double tick : x.ticks(4)) {
    lines += fmt::format("M{} {}v4", coordinate(x.at(tick)), bottom);
    marks += label(x.at(tick), bottom + 17, "t", fmt::format("{:g}", tick));
  }
  return fmt::format("<path class=\"grid\" d=\"{}\"/><path class=\"axis\" d=\"{}\"/>{}{}\n", grid, lines,
                     marks, label((from + to) / 2, height - 1, "t key", words)) +
         dots(samples, {}, x, y, first.at);
}

/// Median, or the ends of the range that holds nine of ten.
std::string middle_lines(const std::vector<Sample>& samples, const Axis& y, double from, double to,
                         bool is_spread) {
  std::vector<Duration> values;
  for (const auto& sample : samples) values.push_back(sample.value);
  std::ranges::sort(values);
  std::string path;
  for (const double share : is_spread ? std::vector{0.05, 0.95} : std::vector{0.5})
    path += fmt::format("M{} {}H{}", from, coordinate(y.at(ms(result::quantile(values, share)))), to);
  return fmt::format("<path class=\"nominal\" d=\"{}\"/>\n", path);
}

/// Shares of each series, so that another number of samples makes no other shape.
std::string back_to_back(const std::vector<Sample>& before, const std::vector<Sample>& after, const Axis& y) {
  const std::array counts{counts_of(before, y), counts_of(after, y)};
  const std::array sizes{static_cast<double>(before.size()), static_cast<double>(after.size())};
  double most = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    for (const auto count : counts.at(i)) most = std::max(most, static_cast<double>(count) / sizes.at(i));
  }
  constexpr double step = (bottom - top) / bins;
  std::array<std::string, 2> paths;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    for (std::size_t bin = 0; bin < bins; ++bin) {
      if (counts.at(i).at(bin) == 0) continue;
      const double length =
          std::max(half * static_cast<double>(counts.at(i).at(bin)) / sizes.at(i) / most, 1.5);
      paths.at(i) += fmt::format("M{} {}h{}v{}H{}z", middle,
                                 coordinate(bottom - step * static_cast<double>(bin + 1) + 0.5),
                                 coordinate(i == 0 ? -length : length), coordinate(step - 1), middle);
    }
  }
  return fmt::format(
      "<path class=\"count was\" d=\"{}\"/><path class=\"count\" d=\"{}\"/><path class=\"axis\" d=\"M{} {}V{}\"/>{}{}{}\n",
      paths[0], paths[1], middle, top, bottom, label(middle - 6, bottom + 17, "t end", "old"),
      label(middle + 6, bottom + 17, "t start", "new"),
      label(middle, height - 1, "t", fmt::format("shares, up to {:.0f} %", 100 * most)));
}

}  // namespace

std::vector<Sample> thinned(std::vector<Sample> samples) {
  if (samples.size() <= most_dots) return samples;
  constexpr std::size_t kept = 50;
  std::ranges::nth_element(samples, samples.begin() + kept, std::greater{}, &Sample::value);
  std::vector<Sample> out(samples.begin(), samples.begin() + kept);
  std::sort(samples.begin() + kept, samples.end());
  const std::size_t rest = samples.size() - kept;
  const std::size_t wanted = most_dots - kept;
  for (std::size_t i = 0; i < wanted; ++i) out.push_back(samples[kept + i * rest / wanted]);
  return out;
}

std::string pair_plot(const Book& book, std::string_view words, const std::vector<Sample>& before,
                      const std::vector<Sample>& after, bool is_spread) {
  if (before.empty() || after.empty()) return {};
  auto all = before;
  all.insert(all.end(), after.begin(), after.end());
  const Axis y = scale_of(all, {});
  std::string marks;
  for (const double tick : y.ticks(4))
    marks += label(left - 6, y.at(tick) + 4, "t end", fmt::format("{:g}", tick));
  marks += label(4, top + 6, "t start", "ms") + label(4, bottom + 17, "t start", "s");
  return svg_begin(book, words) + marks + half_strip(thinned(before), y, left, first_right, "old") +
         half_strip(thinned(after), y, second_left, second_right, "new") + back_to_back(before, after, y) +
         middle_lines(before, y, left, first_right, is_spread) +
         middle_lines(before, y, middle - half, middle, is_spread) +
         middle_lines(after, y, second_left, second_right, is_spread) +
         middle_lines(after, y, middle, middle + half, is_spread) + "</svg></div>\n";
}

std::string strip_plot(const Book& book, std::string_view words, const std::vector<Sample>& samples,
                       const Limits& limits, BusTime begin, BusTime end) {
  if (samples.empty()) return {};
  const Axis x(0, s(end - begin), left + 4, strip_right - 4);
  const Axis y = scale_of(samples, limits);
  const double longest = ms(std::ranges::max(samples, {}, &Sample::value).value);
  return svg_begin(book, words) + axes(x, y, strip_right, "ms") + histogram(samples, y) +
         limit_lines(limits, y, longest * far) + dots(samples, limits, x, y, begin) + "</svg></div>\n";
}

std::string range_plot(const result::Measurement& one, Duration scale) {
  const Axis x(0, ms(scale), 3, 197);
  return fmt::format(
      "<svg class=\"range\" viewBox=\"0 0 200 12\" preserveAspectRatio=\"none\" aria-hidden=\"true\" focusable=\"false\">"
      "<path class=\"span\" d=\"M{} 6H{}\"/><path class=\"mean\" d=\"M{} 1v10\"/></svg>",
      coordinate(x.at(ms(one.shortest))), coordinate(x.at(ms(one.longest))), coordinate(x.at(ms(one.mean))));
}

std::string step_plot(const Book& book, std::string_view words, const std::vector<BusTime>& from,
                      const std::vector<double>& values, Duration span, std::string_view unit) {
  if (values.empty() || from.size() != values.size()) return {};
  const Axis x(0, s(from.back() - from.front() + span), left, right);
  const double highest = *std::ranges::max_element(values);
  const Axis y(0, highest > 0 ? highest * 1.08 : 1.0, bottom, top);
  std::string path = fmt::format("M{} {}", left, bottom);
  for (std::size_t i = 0; i < values.size(); ++i)
    path += fmt::format("V{}H{}", coordinate(y.at(values[i])),
                        coordinate(x.at(s(from[i] - from.front() + span))));
  return svg_begin(book, words) + fmt::format("<path class=\"area\" d=\"{}V{}z\"/>\n", path, bottom) +
         axes(x, y, right, unit) + "</svg></div>\n";
}

std::string length_bar(double share) {
  return fmt::format(
      "<svg class=\"bar\" aria-hidden=\"true\" focusable=\"false\"><rect class=\"length\" width=\"{}%\" "
      "height=\"100%\"/></svg>",
      coordinate(std::max(100 * std::clamp(share, 0.0, 1.0), 0.3)));
}

}  // namespace conform::reports::html
