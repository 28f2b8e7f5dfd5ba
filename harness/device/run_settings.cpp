// SPDX-License-Identifier: Apache-2.0
#include "device/run_settings.hpp"

#include <string>

namespace conform::device {
namespace {

using Kind = RunKey::Kind;

constexpr RunKey keys[] = {
    {"select", Kind::words},      {"simulate", Kind::flag},
    {"variant", Kind::words},     {"defect", Kind::words},
    {"requirement", Kind::words}, {"exclude", Kind::words},
    {"allow", Kind::word},        {"waivers", Kind::paths},
    {"suites", Kind::paths},      {"junit", Kind::path},
    {"html", Kind::path},         {"json", Kind::path},
    {"markdown", Kind::path},     {"markdown-evidence", Kind::path},
    {"csv", Kind::path},          {"tap", Kind::path},
    {"code-quality", Kind::path}, {"badge", Kind::path},
    {"text", Kind::path},         {"capture", Kind::path},
    {"captures", Kind::path},     {"candump", Kind::path},
    {"bundle", Kind::path},       {"sign", Kind::path},
    {"journal", Kind::path},      {"baseline", Kind::path},
    {"rerun-failed", Kind::path}, {"dry-run", Kind::flag},
    {"strict", Kind::flag},       {"all-objects", Kind::flag},
    {"cct", Kind::flag},          {"shuffle", Kind::flag_or_number},
    {"repeat", Kind::word},       {"until-fail", Kind::flag},
    {"fail-fast", Kind::flag},    {"shard", Kind::word},
    {"annotate", Kind::flag},     {"slow", Kind::flag},
    {"wait-for-bus", Kind::word}, {"timeout-scale", Kind::word},
    {"budget", Kind::word},       {"seed", Kind::word},
    {"quiet", Kind::flag},        {"color", Kind::word},
};

std::vector<std::string> words_of(const yaml::Field& field, Kind kind) {
  std::vector<std::string> out;
  switch (kind) {
    case Kind::flag:
      if (const auto yes = field.boolean()) out.emplace_back(*yes ? "true" : "false");
      break;
    case Kind::flag_or_number:
      if (const auto* node = field.node(); node->text() == "true" || node->text() == "false") {
        out.push_back(node->text());
      } else if (const auto number = field.number()) {
        out.push_back(std::to_string(*number));
      }
      break;
    case Kind::word:
    case Kind::path:
      if (auto text = field.text()) out.push_back(std::move(*text));
      break;
    case Kind::words:
    case Kind::paths:
      for (const auto& item : field.items_or_one()) {
        if (auto text = item.text()) out.push_back(std::move(*text));
      }
      break;
  }
  return out;
}

}  // namespace

std::span<const RunKey> run_keys() { return keys; }

std::vector<RunSetting> read_run_settings(const yaml::Field& given) {
  std::vector<RunSetting> out;
  if (!given.present()) return out;
  yaml::Fields fields = given.fields("run");
  for (const auto& [key, kind] : keys) {
    const auto field = fields.optional(key);
    if (!field.present()) continue;
    auto words = words_of(field, kind);
    if (!words.empty()) out.push_back({key, std::move(words), field.node()->position().line});
  }
  fields.finish();
  return out;
}

}  // namespace conform::device
