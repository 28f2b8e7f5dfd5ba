// SPDX-License-Identifier: Apache-2.0
#include "cli/replay/section.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "can/capture_marks.hpp"

namespace conform::cli {
namespace {

using can::CaseMark;
using can::CasePart;

/// A mark and where it stands. Without a name: the cases are over.
struct Place {
  std::size_t frame = 0;
  CaseMark mark;
};

std::vector<Place> places_in(std::span<const can::CapturedFrame> frames) {
  std::vector<Place> out;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].comment.empty()) continue;
    for (auto& mark : can::case_marks(frames[i].comment.view())) out.push_back({i, std::move(mark)});
    if (frames[i].comment.contains(can::cases_are_over)) out.push_back({i, {}});
  }
  // Of two marks of one frame the one that was put there last may be the one that happened first.
  const auto rank = [](const Place& place) { return std::pair(place.frame, place.mark.part); };
  std::ranges::sort(out, {}, rank);
  return out;
}

/// What of a case is not among its marks. A run that was killed leaves no mark of beginnings and ends.
std::vector<std::string> missing_in(std::span<const Place> of_case) {
  const auto has = [&](CasePart part) {
    return std::ranges::find(of_case, part, [](const Place& place) { return place.mark.part; }) !=
           of_case.end();
  };
  const bool begins = has(CasePart::begin), ends = has(CasePart::end);
  std::vector<std::string> out;
  if (!begins) {
    std::string text = "the capture does not tell where the case begins: ";
    const auto step =
        std::ranges::find(of_case, CasePart::step, [](const Place& place) { return place.mark.part; });
    if (step == of_case.end()) {
      text += "none of its steps is there";
    } else if (step->mark.number > 1) {
      text += "steps before step " + std::to_string(step->mark.number) + " are not there, or sent nothing";
    } else {
      text += "what was sent before step 1 to find out whether it applies may not be there";
    }
    out.push_back(std::move(text));
  }
  if (!ends) {
    out.emplace_back(
        "the capture does not tell where the case ends: it was cut off, or the run was stopped or killed, and what is not "
        "there is not sent");
  }
  return out;
}

std::unexpected<Error> unknown_case(std::span<const can::CapturedFrame> frames, std::string_view name,
                                    const std::string& where) {
  if (name.starts_with("monitor/")) {
    return fail("a monitor watches the whole run, and nothing is sent for it", where,
                "name the case that ran meanwhile, as the report of the finding does");
  }
  const auto known = cases_in(frames);
  if (known.empty()) {
    return fail(
        "the capture does not tell which frames belong to which case", where,
        "pcapng of 'run --capture' or 'run --captures' tells it; of other files: --frames FIRST-LAST");
  }
  if (std::ranges::find(known, name) != known.end()) {
    return fail("the capture holds only the end of the case '" + std::string(name) + "'", where,
                "the capture of the whole run, or --frames FIRST-LAST");
  }
  const std::vector<std::string_view> candidates(known.begin(), known.end());
  const auto near = did_you_mean(name, candidates);
  std::string hint =
      near.empty() ? "it holds " + std::to_string(known.size()) + " cases, the first is " + known.front()
                   : "did you mean '" + std::string(near) + "'?";
  // An id without its instance is what one tends to type.
  for (const auto& each : known) {
    if (each.starts_with(std::string(name) + "[")) {
      hint = "name the instance as well: " + each;
      break;
    }
  }
  return fail("the capture holds no case '" + std::string(name) + "'", where, std::move(hint));
}

}  // namespace

std::vector<std::string> cases_in(std::span<const can::CapturedFrame> frames) {
  std::vector<std::string> out;
  for (const auto& place : places_in(frames)) {
    if (place.mark.name.empty() || place.mark.part == CasePart::preparation) continue;
    if (std::ranges::find(out, place.mark.name) == out.end()) out.push_back(place.mark.name);
  }
  return out;
}

Result<Section> section_of_case(std::span<const can::CapturedFrame> frames, std::string_view name,
                                const std::string& where) {
  const auto places = places_in(frames);
  const auto is_ours = [&](std::size_t i) { return places[i].mark.name == name; };
  // The latest beginning; of a case that was cut off no beginning is marked, but its steps are.
  std::optional<std::size_t> begin, first_of_latest;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!is_ours(i)) continue;
    const auto part = places[i].mark.part;
    if (part == CasePart::begin) begin = i;
    const bool follows = i > 0 && is_ours(i - 1) && part != CasePart::preparation &&
                         part != CasePart::begin && !(part == CasePart::step && places[i].mark.number == 1);
    if (!follows && part != CasePart::putting_back && part != CasePart::end) first_of_latest = i;
  }
  if (!begin) begin = first_of_latest;
  if (!begin) return unknown_case(frames, name, where);
  auto first = *begin;
  if (first > 0 && is_ours(first - 1) && places[first - 1].mark.part == CasePart::preparation) --first;
  auto last = *begin + 1;
  while (last < places.size() && is_ours(last) && places[last].mark.part != CasePart::preparation &&
         places[last].mark.part != CasePart::begin)
    ++last;
  return Section{places[first].frame, last < places.size() ? places[last].frame : frames.size(),
                 "case " + std::string(name), missing_in(std::span(places).subspan(first, last - first))};
}

Result<Section> section_of_numbers(std::span<const can::CapturedFrame> frames, std::string_view range,
                                   const std::string& where) {
  const auto bad = [&](const std::string& what) {
    return fail(what, {}, "--frames 120-180: numbers of frames as Wireshark shows them, from 1");
  };
  const auto dash = range.find('-');
  const auto number = [](std::string_view text) -> std::optional<std::size_t> {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
  };
  const auto first = number(range.substr(0, dash));
  const auto last = dash == std::string_view::npos ? first : number(range.substr(dash + 1));
  if (!first || !last || *first == 0 || *last < *first)
    return bad("'" + std::string(range) + "' is no range of frames");
  if (*last > frames.size()) {
    return bad("frame " + std::to_string(*last) + " is beyond the end: " + where + " holds " +
               std::to_string(frames.size()) + " frames");
  }
  return Section{*first - 1, *last, "frames " + std::to_string(*first) + " to " + std::to_string(*last)};
}

}  // namespace conform::cli
