// SPDX-License-Identifier: Apache-2.0
// Object lists: what is listed is described, what is described is listed, each once and in its list.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "base/text.hpp"
#include "eds/lint_rules.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view lists = "CiA 306, object lists";

constexpr Rule no_mandatory_list{"EDS150", Severity::error, "There is no [MandatoryObjects]", lists};
constexpr Rule no_list{"EDS151", Severity::warning, "There is no [OptionalObjects] or [ManufacturerObjects]",
                       lists};
constexpr Rule wrong_count{"EDS152", Severity::error, "SupportedObjects is not the number of listed objects",
                           lists};
constexpr Rule numbering{"EDS153", Severity::warning,
                         "The entries of a list are not numbered in a row from 1 on", lists};
constexpr Rule not_described{"EDS154", Severity::error, "A listed object has no section", lists};
constexpr Rule not_listed{"EDS155", Severity::warning, "A described object is in no list", lists};
constexpr Rule wrong_list{"EDS156", Severity::error, "An object is in a list for other indices", lists};
constexpr Rule listed_twice{"EDS157", Severity::error, "An object is listed twice", lists};
constexpr Rule mandatory_absent{"EDS158", Severity::error,
                                "1000h or 1001h is missing, which every device has", "CiA 301, 7.5.2"};
constexpr Rule identity_absent{"EDS159", Severity::warning,
                               "1018h is missing, which every device has since CiA 301 version 4",
                               "CiA 301, 7.5.2.21"};
constexpr Rule link_count{"EDS160", Severity::error, "ObjectLinks is not the number of links",
                          "CiA 306, object links"};
constexpr Rule dead_link{"EDS161", Severity::error, "A link leads to an object that is not described",
                         "CiA 306, object links"};

constexpr Rule other_list{"EDS162", Severity::warning,
                          "An object of CiA 301 is in the list of mandatory objects, or one of those is not",
                          lists};

constexpr const Rule* all[] = {&no_mandatory_list, &no_list,         &wrong_count, &numbering,
                               &not_described,     &not_listed,      &wrong_list,  &listed_twice,
                               &mandatory_absent,  &identity_absent, &link_count,  &dead_link,
                               &other_list};

struct Listed {
  Index index;
  const NumberedList* list;
  Position at;
};

bool is_mandatory(Index index) {
  return index.value() == 0x1000 || index.value() == 0x1001 || index.value() == 0x1018;
}

class Check {
 public:
  Check(const Subject& subject, Findings& findings) : file_(subject.file), findings_(findings) {}

  void run() {
    list(file_.mandatory_objects);
    list(file_.optional_objects);
    list(file_.manufacturer_objects);
    if (!file_.mandatory_objects.present)
      findings_.add(no_mandatory_list, {}, "there is no [MandatoryObjects]");
    if (!file_.optional_objects.present) findings_.add(no_list, {}, "there is no [OptionalObjects]");
    if (!file_.manufacturer_objects.present) findings_.add(no_list, {}, "there is no [ManufacturerObjects]");
    compare();
    links();
  }

  void mandatory() {
    for (const auto index : {Index(0x1000), Index(0x1001)}) {
      if (file_.find(index) == nullptr)
        findings_.add(mandatory_absent, file_.mandatory_objects.at,
                      fmt::format("{} is missing", to_string(index)));
    }
    if (file_.find(Index(0x1018)) == nullptr)
      findings_.add(identity_absent, file_.mandatory_objects.at, "1018h is missing");
  }

 private:
  void list(const NumberedList& list) {
    if (!list.present) return;
    const auto count = number_of(list.count);
    if (list.count.empty())
      findings_.add(wrong_count, place_of(list.count, list.at),
                    fmt::format("[{}]: SupportedObjects is missing", list.name));
    else if (count && *count != list.entries.size()) {
      findings_.add(wrong_count, place_of(list.count, list.at),
                    fmt::format("[{}]: SupportedObjects says {}, but {} objects are listed", list.name,
                                count.value_or(0), list.entries.size()));
    }
    if (const auto* entry = first_out_of_row(list))
      findings_.add(
          numbering, entry->field.key_at,
          fmt::format("[{}]: there is entry {}, but one before it is missing", list.name, entry->number));
    for (const auto& entry : list.entries) {
      const auto index = number_of(entry.field);
      if (index && *index <= 0xFFFF)
        listed_.push_back({Index(static_cast<std::uint16_t>(*index)), &list, entry.field.at});
    }
  }

  /// 2000h to 5FFFh have a list of their own; of the others a profile may make any mandatory.
  void in_its_list(const Listed& each) {
    const bool is_manufacturers = between(each.index, 0x2000, 0x5FFF);
    const bool is_mandatory_list = each.list == &file_.mandatory_objects;
    const auto message = [&each] {
      return fmt::format("{} does not belong into [{}]", to_string(each.index), each.list->name);
    };
    if (is_manufacturers != (each.list == &file_.manufacturer_objects))
      findings_.add(wrong_list, each.at, message(),
                    "2000h to 5FFFh belong into [ManufacturerObjects], others into one of the other two");
    else if (is_mandatory(each.index) ? !is_mandatory_list : is_mandatory_list && each.index.value() < 0x2000)
      findings_.add(other_list, each.at, message(), "1000h, 1001h and 1018h belong into [MandatoryObjects]");
  }

  void compare() {
    std::map<Index, Position> first;
    for (const auto& each : listed_) {
      const auto [known, is_new] = first.try_emplace(each.index, each.at);
      if (!is_new) {
        findings_.add(listed_twice, each.at, fmt::format("{} is listed already", to_string(each.index)),
                      fmt::format("in line {}", known->second.line));
        continue;
      }
      if (file_.find(each.index) == nullptr)
        findings_.add(not_described, each.at,
                      fmt::format("there is no section {}", section_name(each.index)));
      in_its_list(each);
    }
    for (const auto& object : file_.objects) {
      // Below 1000h are the data types, which need no list.
      if (object.index.value() >= 0x1000 && !first.contains(object.index))
        findings_.add(not_listed, object.entry.at,
                      fmt::format("{} is in no list", section_name(object.index)));
    }
  }

  void links() {
    for (const auto& object : file_.objects) {
      const auto& list = object.lists->links;
      if (!list.present) continue;
      const auto count = number_of(list.count).value_or(0);
      if (count != list.entries.size())
        findings_.add(link_count, place_of(list.count, list.at),
                      fmt::format("[{}]: ObjectLinks says {}, but there are {} links", list.name, count,
                                  list.entries.size()));
      for (const auto& entry : list.entries) {
        const auto index = number_of(entry.field);
        if (index && *index <= 0xFFFF && file_.find(Index(static_cast<std::uint16_t>(*index))) != nullptr)
          continue;
        findings_.add(
            dead_link, entry.field.at,
            fmt::format("[{}]: '{}' is no described object", list.name, shortened(entry.field.text)));
      }
    }
  }

  const EdsFile& file_;
  Findings& findings_;
  std::vector<Listed> listed_;
};

void check(const Subject& subject, Findings& findings) {
  Check look(subject, findings);
  // In XML the objects are their own list.
  if (!subject.file.is_xml()) look.run();
  look.mandatory();
}

}  // namespace

constinit const Group list_rules{{"Object lists", all}, check};

}  // namespace conform::eds
