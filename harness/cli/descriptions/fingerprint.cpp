// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/fingerprint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "base/text.hpp"
#include "bundle/digest.hpp"

namespace conform::cli {
namespace {

/// The value of an attribute in a start tag, or empty.
std::string_view attribute(std::string_view tag, std::string_view name) {
  for (auto at = tag.find(name); at != std::string_view::npos; at = tag.find(name, at + 1)) {
    if (at == 0 || std::string_view(" \t\r\n").find(tag[at - 1]) == std::string_view::npos) continue;
    const auto quote = tag.find_first_of("\"'", at);
    if (quote == std::string_view::npos) return {};
    return tag.substr(quote + 1, tag.find(tag[quote], quote + 1) - quote - 1);
  }
  return {};
}

}  // namespace

FindingPlaces::FindingPlaces(std::string_view bytes, bool xml) : bytes_(bytes), xml_(xml), lines_(bytes) {
  if (xml) {
    const auto all_of = [bytes](std::string_view word) {
      std::vector<std::size_t> out;
      for (auto at = bytes.find(word); at != std::string_view::npos; at = bytes.find(word, at + 1))
        out.push_back(at);
      return out;
    };
    objects_ = all_of("CANopenObject ");
    subs_ = all_of("CANopenSubObject ");
    return;
  }
  for (std::size_t number = 1; number <= lines_.count(); ++number) {
    if (trim(lines_.line(number)).starts_with('[')) sections_.push_back(number);
  }
}

std::string FindingPlaces::name(eds::Position at) const {
  if (xml_) return in_xml(at);
  const auto next = std::ranges::upper_bound(sections_, at.line);
  if (next == sections_.begin()) return {};
  const auto section = trim(lines_.line(*(next - 1)));
  auto out = lower(section.substr(0, section.find(']'))) + "]";
  const auto line = lines_.line(at.line);
  const auto equals = line.find('=');
  if (*(next - 1) != at.line && equals != std::string_view::npos)
    out += " " + lower(trim(line.substr(0, equals)));
  return out;
}

std::string FindingPlaces::in_xml(eds::Position at) const {
  const auto offset = lines_.offset(at);
  if (!offset) return {};
  // A finding stands at the '<' of an element or inside of its start tag.
  const auto last = [&](const std::vector<std::size_t>& places) {
    const auto next = std::ranges::upper_bound(places, *offset + 1);
    return next == places.begin() ? std::string_view::npos : *std::prev(next);
  };
  const auto object = last(objects_);
  if (object == std::string_view::npos) return {};
  const auto tag_at = [this](std::size_t begin) {
    return bytes_.substr(begin, bytes_.find('>', begin) - begin);
  };
  auto out = fmt::format("{}h", attribute(tag_at(object), "index"));
  const auto sub = last(subs_);
  if (sub != std::string_view::npos && sub > object)
    out += fmt::format(":{}", attribute(tag_at(sub), "subIndex"));
  return out;
}

std::vector<std::string> fingerprints(const eds::LintReport& report, const FindingPlaces& places) {
  std::vector<std::string> out;
  std::map<std::string, int> counts;
  for (const auto& finding : report.findings) {
    constexpr std::size_t digits = 32;
    auto print = bundle::sha256(
                     fmt::format("{}\n{}\n{}", finding.rule->code, places.name(finding.at), finding.message))
                     .substr(0, digits);
    if (const auto count = ++counts[print]; count > 1) print += fmt::format(":{}", count);
    out.push_back(std::move(print));
  }
  return out;
}

}  // namespace conform::cli
