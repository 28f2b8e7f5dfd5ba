// SPDX-License-Identifier: Apache-2.0
#include "device/waiver.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"

namespace conform::device {
namespace {

std::optional<int> digits(std::string_view text) {
  int out = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return std::nullopt;
    out = out * 10 + (c - '0');
  }
  return out;
}

}  // namespace

std::optional<std::chrono::sys_days> parse_date(std::string_view text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return std::nullopt;
  const auto year = digits(text.substr(0, 4));
  const auto month = digits(text.substr(5, 2));
  const auto day = digits(text.substr(8, 2));
  if (!year || !month || !day) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days(date);
}

std::string to_string(std::chrono::sys_days day) {
  const std::chrono::year_month_day date(day);
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()));
}

std::optional<Waiver> read_waiver(const yaml::Field& item) {
  auto fields = item.fields("waiver");
  Waiver out;
  out.requirement = fields.required("requirement").text().value_or("");
  out.reason = fields.required("reason").text().value_or("");
  out.case_name = fields.optional("case").text().value_or("");
  out.owner = fields.optional("owner").text().value_or("");
  out.ticket = fields.optional("ticket").text().value_or("");
  if (const auto object = fields.optional("object").multiplexer()) out.object = object->index;
  const auto expires = fields.optional("expires");
  if (const auto text = expires.text()) {
    out.expires = parse_date(*text);
    if (!out.expires) expires.error("is no date", "write year, month and day as 2027-03-31");
  }
  fields.finish();
  if (item.node() != nullptr)
    out.place = fmt::format("{}:{}", item.diagnostics().source().name(), item.node()->position().line);
  if (out.requirement.empty() || out.reason.empty()) return std::nullopt;
  return out;
}

std::vector<Waiver> read_waivers(const yaml::Field& list) {
  std::vector<Waiver> out;
  for (const auto& item : list.items()) {
    auto waiver = read_waiver(item);
    if (!waiver) continue;
    const bool twice = std::ranges::any_of(out, [&](const Waiver& other) {
      return other.requirement == waiver->requirement && other.case_name == waiver->case_name &&
             other.object == waiver->object;
    });
    if (twice) item.error(fmt::format("{} is waived twice", waiver->requirement));
    out.push_back(std::move(*waiver));
  }
  return out;
}

Result<WaiverDocument> load_waiver_file(const std::string& path) {
  auto document = yaml::load_file(path);
  if (!document) return std::unexpected(document.error());
  WaiverDocument out{.waivers = {}, .diagnostics = std::move(document->diagnostics)};
  if (!document->root) return out;
  yaml::Fields fields(*document->root, out.diagnostics, "file of waivers");
  if (fields.present()) static_cast<void>(fields.required("format").number(1, 1));
  out.waivers = read_waivers(fields.required("waivers"));
  fields.finish();
  return out;
}

}  // namespace conform::device
