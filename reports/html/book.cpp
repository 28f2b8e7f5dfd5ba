// SPDX-License-Identifier: Apache-2.0
#include "reports/html/book.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "reports/html/markup.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {

using result::CaseResult;
using result::Cause;

namespace {

/// "r-OD-1003-06": the id itself, so that a link to it can be written by hand. An id of other letters is
/// counted.
bool is_plain(const std::string& id) {
  return !id.empty() && id.size() <= 60 && std::ranges::all_of(id, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

constexpr std::size_t name_limit = 200;

}  // namespace

Book::Book(const result::RunResult& run, Beside beside, Extent extent, std::string prefix)
    : run_(run),
      beside_(std::move(beside)),
      extent_(extent),
      prefix_(std::move(prefix)),
      causes_(result::causes_of(run)),
      by_case_(causes_by_case(causes_)),
      requirements_(requirement_verdicts(run)) {
  for (const CaseResult& one : run.cases) {
    by_name_.emplace(one.name(), &one);
    std::set<std::string> ids(one.requirements.begin(), one.requirements.end());
    for (const auto& judgement : one.judgements) ids.insert(judgement.requirement);
    for (const auto& id : ids) cases_of_[id].push_back(&one);
  }
  for (const Cause& cause : causes_) {
    for (const auto& id : cause.requirements) by_requirement_.emplace(id, &cause);
  }
  for (std::size_t i = 0; i < requirements_.size() && extent_ == Extent::whole; ++i) {
    const auto& id = requirements_[i].id;
    anchors_.emplace(id, is_plain(id) ? "r-" + id : fmt::format("r.{}", i + 1));
  }
}

const std::vector<const CaseResult*>& Book::cases_of(const std::string& requirement) const {
  static const std::vector<const CaseResult*> none;
  const auto found = cases_of_.find(requirement);
  return found == cases_of_.end() ? none : found->second;
}

const Cause* Book::cause_of(const CaseResult& one) const {
  const auto found = by_case_.find(&one);
  return found == by_case_.end() ? nullptr : found->second;
}

const Cause* Book::cause_of(const std::string& requirement) const {
  const auto found = by_requirement_.find(requirement);
  return found == by_requirement_.end() ? nullptr : found->second;
}

std::size_t Book::number_of(const Cause& cause) const {
  return static_cast<std::size_t>(&cause - causes_.data()) + 1;
}

std::string Book::anchor(const CaseResult& one) const {
  return fmt::format("c{}", &one - run_.cases.data() + 1);
}

std::string Book::anchor(const std::string& requirement) const {
  const auto found = anchors_.find(requirement);
  return found == anchors_.end() ? std::string() : found->second;
}

std::string Book::anchor(const Cause& cause) const { return fmt::format("cause-{}", number_of(cause)); }

std::string Book::case_link(const CaseResult& one) const {
  const std::string shown = clipped(one.name(), name_limit);
  return extent_ == Extent::whole ? link(anchor(one), shown) : shown;
}

std::string Book::case_link(const std::string& name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? clipped(name, name_limit) : case_link(*found->second);
}

std::string Book::requirement_link(const std::string& requirement) const {
  const std::string target = anchor(requirement);
  const std::string shown = clipped(requirement, name_limit);
  return target.empty() ? shown : link(target, shown);
}

std::string Book::cause_link(const Cause& cause) const {
  return link(anchor(cause), fmt::format("cause {}", number_of(cause)));
}

std::string Book::case_list(const std::vector<const CaseResult*>& cases) const {
  std::vector<std::pair<std::string, std::vector<const CaseResult*>>> groups;
  std::map<std::string, std::size_t> known;
  for (const CaseResult* one : cases) {
    const auto [at, fresh] = known.emplace(one->id, groups.size());
    if (fresh) groups.emplace_back(one->id, std::vector<const CaseResult*>{});
    groups[at->second].second.push_back(one);
  }
  std::string out = "<ul class=\"list\">\n";
  for (const auto& [id, instances] : groups) {
    if (instances.size() == 1) {
      out += fmt::format("<li>{}</li>\n", case_link(*instances.front()));
      continue;
    }
    out += fmt::format("<li>{}", clipped(id, name_limit));
    for (const CaseResult* one : instances) {
      const auto shown = fmt::format("[{}]", clipped(one->instance, name_limit));
      out += " " + (extent_ == Extent::whole ? link(anchor(*one), shown) : shown);
    }
    out += "</li>\n";
  }
  return out + "</ul>\n";
}

std::string Book::fresh_id() const { return fmt::format("{}{}", prefix_, ++drawn_); }

}  // namespace conform::reports::html
