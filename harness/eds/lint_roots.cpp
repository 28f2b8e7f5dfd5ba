// SPDX-License-Identifier: Apache-2.0
#include "eds/lint_roots.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "eds/lint_rules.hpp"

namespace conform::eds {
namespace {

/// How far a mistake reaches.
enum class Reach : std::uint8_t { entry, object, file };

struct Consequence {
  std::string_view root, code;
  Reach reach;
};

/// The first that applies counts: what lies deepest comes first.
constexpr Consequence table[] = {
    // Sections without the object itself
    {"EDS022", "EDS155", Reach::object},
    {"EDS022", "EDS231", Reach::object},
    {"EDS022", "EDS239", Reach::object},
    {"EDS022", "EDS253", Reach::object},
    // What kind of object it is
    {"EDS201", "EDS231", Reach::object},
    {"EDS201", "EDS239", Reach::object},
    {"EDS201", "EDS253", Reach::object},
    {"EDS207", "EDS231", Reach::object},
    {"EDS207", "EDS239", Reach::object},
    {"EDS208", "EDS231", Reach::object},
    {"EDS208", "EDS239", Reach::object},
    {"EDS239", "EDS231", Reach::object},
    {"EDS239", "EDS250", Reach::object},
    {"EDS239", "EDS441", Reach::object},
    {"EDS250", "EDS251", Reach::object},
    {"EDS250", "EDS252", Reach::object},
    {"EDS250", "EDS253", Reach::object},
    {"EDS250", "EDS311", Reach::object},
    {"EDS250", "EDS441", Reach::object},
    {"EDS270", "EDS271", Reach::object},
    // The data type
    {"EDS202", "EDS257", Reach::entry},
    {"EDS203", "EDS230", Reach::entry},
    {"EDS203", "EDS257", Reach::entry},
    {"EDS230", "EDS070", Reach::entry},
    {"EDS230", "EDS071", Reach::entry},
    {"EDS230", "EDS072", Reach::entry},
    {"EDS230", "EDS257", Reach::entry},
    {"EDS230", "EDS258", Reach::entry},
    {"EDS257", "EDS070", Reach::entry},
    {"EDS257", "EDS071", Reach::entry},
    // The access
    {"EDS205", "EDS210", Reach::entry},
    {"EDS205", "EDS232", Reach::entry},
    {"EDS205", "EDS237", Reach::entry},
    // Limits
    {"EDS071", "EDS072", Reach::entry},
    {"EDS071", "EDS073", Reach::entry},
    {"EDS073", "EDS072", Reach::entry},
    {"EDS073", "EDS074", Reach::entry},
    // COB-IDs
    {"EDS313", "EDS453", Reach::entry},
    {"EDS450", "EDS453", Reach::entry},
    {"EDS452", "EDS450", Reach::entry},
    {"EDS452", "EDS453", Reach::entry},
    // 1005h is missing
    {"EDS444", "EDS443", Reach::file},
};

/// Which entry a line of the file belongs to. Where entries take their values from elsewhere, as parameters
/// of XDD, the place of the value tells nothing, and findings stay apart.
class Places {
 public:
  explicit Places(const EdsFile& file) {
    for (const auto& object : file.objects) {
      if (object.described) add(object.entry.at, object.index, {});
      for (const auto& sub : object.subs) add(sub.entry.at, object.index, sub.sub);
    }
    for (const auto* list : {&file.mandatory_objects, &file.optional_objects, &file.manufacturer_objects,
                             &file.dummy_usage, &file.comments, &file.supported_modules})
      add(list->at, {}, {});
    for (const auto at :
         {file.file_info.at, file.device_info.at, file.commissioning.at, file.dynamic_channels})
      add(at, {}, {});
    for (const auto& module : file.modules) add(module.at, {}, {});
    for (const auto& other : file.unmodelled) add(other.at, {}, {});
    std::ranges::stable_sort(all_, {}, &Place::at);
  }

  struct Place {
    Position at;
    std::optional<Index> index;
    std::optional<SubIndex> sub;
  };
  [[nodiscard]] Place of(Position at) const {
    const auto behind = std::ranges::upper_bound(all_, at, {}, &Place::at);
    return behind == all_.begin() ? Place{} : *std::prev(behind);
  }

 private:
  void add(Position at, std::optional<Index> index, std::optional<SubIndex> sub) {
    if (at.known()) all_.push_back({at, index, sub});
  }

  std::vector<Place> all_;
};

class Marker {
 public:
  Marker(const EdsFile& file, LintReport& report) : file_(file), report_(report), places_(file) {
    for (const auto& finding : report.findings) {
      const auto code = finding.rule->code;
      by_code_[code].push_back(&finding);
      const auto place = places_.of(finding.at);
      if (!place.index) continue;
      of_objects_.try_emplace({code, *place.index}, finding.number);
      of_entries_.try_emplace({code, *place.index, place.sub}, finding.number);
    }
  }

  void run() {
    undescribed();
    for (auto& finding : report_.findings) {
      if (finding.rule->code == "EDS155") finding.because = list_that_lacks(finding);
      if (finding.rule->code == "EDS331") finding.because = listed_only(finding);
      if (finding.because == 0) finding.because = by_table(finding);
    }
  }

 private:
  [[nodiscard]] unsigned by_table(const Finding& finding) const {
    const auto here = places_.of(finding.at);
    for (const auto& row : table) {
      if (row.code != finding.rule->code) continue;
      if (row.reach == Reach::file) {
        if (const auto roots = by_code_.find(row.root); roots != by_code_.end())
          return roots->second.front()->number;
      } else if (here.index && row.reach == Reach::object) {
        if (const auto root = of_objects_.find({row.root, *here.index}); root != of_objects_.end())
          return root->second;
      } else if (here.index) {
        if (const auto root = of_entries_.find({row.root, *here.index, here.sub}); root != of_entries_.end())
          return root->second;
      }
    }
    return 0;
  }

  /// An object cannot be in a list that is not there.
  [[nodiscard]] unsigned list_that_lacks(const Finding& finding) const {
    const auto index = places_.of(finding.at).index;
    if (!index) return 0;
    const bool mandatory = *index == Index(0x1000) || *index == Index(0x1001) || *index == Index(0x1018);
    const std::string_view code = mandatory ? "EDS150" : "EDS151";
    const std::string_view list = mandatory                         ? "[MandatoryObjects]"
                                  : between(*index, 0x2000, 0x5FFF) ? "[ManufacturerObjects]"
                                                                    : "[OptionalObjects]";
    const auto roots = by_code_.find(code);
    if (roots == by_code_.end()) return 0;
    const auto root = std::ranges::find_if(
        roots->second, [list](const auto* each) { return each->message.ends_with(list); });
    return root == roots->second.end() ? 0 : (*root)->number;
  }

  /// Objects that a list names and no section describes, with the findings that say so.
  void undescribed() {
    const auto findings = by_code_.find("EDS154");
    if (findings == by_code_.end()) return;
    std::map<Position, const Finding*> at;
    for (const auto* finding : findings->second) at.emplace(finding->at, finding);
    for (const auto* list :
         {&file_.mandatory_objects, &file_.optional_objects, &file_.manufacturer_objects}) {
      for (const auto& entry : list->entries) {
        const auto found = at.find(entry.field.at);
        const auto number = number_of(entry.field);
        if (found != at.end() && number && *number <= 0xFFFF)
          listed_only_.emplace(Index(static_cast<std::uint16_t>(*number)), found->second->number);
      }
    }
  }

  /// The finding about the list that names what is mapped here.
  [[nodiscard]] unsigned listed_only(const Finding& finding) const {
    const auto here = places_.of(finding.at);
    if (listed_only_.empty() || !here.index || !here.sub) return 0;
    const auto* entry = file_.find(Multiplexer{*here.index, *here.sub});
    if (entry == nullptr) return 0;
    const auto mapped = parse_number(effective_value(*entry).text);
    if (!mapped || mapped->magnitude > 0xFFFF'FFFF) return 0;
    const auto root = listed_only_.find(Index(static_cast<std::uint16_t>(mapped->magnitude >> 16U)));
    return root == listed_only_.end() ? 0 : root->second;
  }

  const EdsFile& file_;
  LintReport& report_;
  Places places_;
  std::map<std::string_view, std::vector<const Finding*>> by_code_;
  std::map<std::pair<std::string_view, Index>, unsigned> of_objects_;  ///< the first finding of a code
  std::map<std::tuple<std::string_view, Index, std::optional<SubIndex>>, unsigned> of_entries_;
  std::map<Index, unsigned> listed_only_;
};

}  // namespace

void mark_roots(const EdsFile& file, LintReport& report) {
  unsigned number = 0;
  for (auto& finding : report.findings) finding.number = ++number;
  if (report.findings.size() > 1) Marker(file, report).run();
}

Roots::Roots(const LintReport& report) {
  for (const auto& finding : report.findings) {
    if (finding.number != 0) findings_.emplace(finding.number, &finding);
  }
}

const Finding* Roots::of(const Finding& finding) const {
  const Finding* out = nullptr;
  for (auto next = findings_.find(finding.because); next != findings_.end();
       next = findings_.find(next->second->because))
    out = next->second;
  return out;
}

}  // namespace conform::eds
