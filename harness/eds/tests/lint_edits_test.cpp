// SPDX-License-Identifier: Apache-2.0
// Generated edits of right files: what makes a file wrong must not go unnoticed, but for what
// lint_edit_survivors.txt lists with a reason.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "base/text.hpp"
#include "catch.hpp"
#include "eds/ini_file.hpp"
#include "eds/lint.hpp"
#include "eds/number.hpp"
#include "eds/read.hpp"
#include "eds/standard_table.hpp"

namespace {

using namespace conform;
using namespace conform::eds;

const std::string folder = std::string(CONFORM_SOURCE_DIR) + "/harness/eds/tests/";

std::string content(const std::string& path) {
  const auto text = read_file(path, 1U << 20U);
  REQUIRE(text.has_value());
  return *text;
}

struct Edit {
  std::string id;  ///< "legal-whole.eds [1017] DataType: removed"
  std::string text;
};

/// A line of a file, with the section that it stands in.
struct Line {
  std::size_t begin = 0, size = 0;  ///< without the line end
  std::string section, key, value;
};

std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> out;
  std::string section;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = text.find('\n', begin);
    Line line{begin, end - begin, {}, {}, {}};
    const auto whole = text.substr(begin, end - begin);
    if (whole.starts_with('[')) section = whole.substr(1, whole.size() - 2);
    line.section = section;
    const auto equals = whole.find('=');
    if (equals != std::string::npos && !whole.starts_with(';')) {
      line.key = whole.substr(0, equals);
      line.value = whole.substr(equals + 1);
      out.push_back(line);
    }
    begin = end + 1;
  }
  return out;
}

bool among(const auto& words, std::string_view word) {
  return std::ranges::find(words, word) != std::end(words);
}

/// What CiA 306 lets a file leave out, so that without it the file is right: its table of entries, the bit
/// rates and dummies that are 0, and what a configuration says of its place in the network.
bool may_be_absent(const Line& line) {
  constexpr std::string_view optional[] = {"LowLimit",       "HighLimit",        "PDOMapping", "ObjFlags",
                                           "ParameterValue", "Denotation",       "NodeName",   "NetNumber",
                                           "NetworkName",    "LSS_SerialNumber", "LastEDS",    "ObjExtend",
                                           "CANopenManager"};
  if (among(optional, line.key)) return true;
  if (line.key == "ObjectType") return eds::parse_number(line.value)->magnitude == 7;
  if (line.key == "DefaultValue") {
    // A count that the device itself changes needs no default.
    const std::string_view index = std::string_view(line.section).substr(0, 4);
    return !line.section.ends_with("sub0") || index == "1003" || index == "1027" || index.starts_with("16") ||
           index.starts_with("1A");
  }
  if (line.section.ends_with("Name") || line.section == "Comments")
    return line.value.find_first_not_of("0123456789") != std::string::npos;
  return line.key.starts_with("BaudRate_") || line.key.starts_with("Dummy");
}

bool is_text(const Line& line) {
  constexpr std::string_view texts[] = {
      "FileName",        "Description",   "CreatedBy",  "ModifiedBy",   "VendorName",   "ProductName",
      "OrderCode",       "ParameterName", "NodeName",   "NetworkName",  "LastEDS",      "Denotation",
      "Line1",           "Line2",         "EDSVersion", "CreationTime", "CreationDate", "ModificationTime",
      "ModificationDate"};
  return among(texts, line.key) || line.section.ends_with("Name");
}

bool is_count(const Line& line) {
  constexpr std::string_view counts[] = {"SubNumber", "SupportedObjects", "Lines",      "NrOfEntries",
                                         "NrOfRXPDO", "NrOfTXPDO",        "ObjectLinks"};
  return among(counts, line.key);
}

/// Of an object that CiA 301 defines; nullptr for any other.
const StandardRow* standard_row(const std::string& section) {
  if (!section.starts_with('1')) return nullptr;
  const auto index = static_cast<std::uint16_t>(std::stoul(section.substr(0, 4), nullptr, 16));
  const auto sub = section.size() > 7 ? std::stoul(section.substr(7), nullptr, 16) : 0;
  return find_standard_row({Index(index), SubIndex(static_cast<std::uint8_t>(sub))});
}

class Edits {
 public:
  Edits(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {}

  std::vector<Edit> run() {
    for (const auto& line : lines_of(text_)) {
      const auto entry = fmt::format("{}={}", line.key, line.value);
      if (!may_be_absent(line)) {
        add(line, "removed", "");
        add(line, "emptied", line.key + "=");
      }
      add(line, "duplicated", entry + "\n" + entry);
      const auto number = eds::parse_number(line.value);
      if (!is_text(line) && line.key != "AccessType" && number) {
        add(line, "type", line.key + "=word");
        add(line, "range", line.key + "=99999999999999999");
      }
      if (line.key == "AccessType") add(line, "type", "AccessType=17");
      if (is_count(line) && number) {
        add(line, "count", fmt::format("{}={}", line.key, number->magnitude + 1));
        if (number->magnitude > 0)
          add(line, "count-1", fmt::format("{}={}", line.key, number->magnitude - 1));
      }
      if (const auto* row = standard_row(line.section)) standard(line, *row);
    }
    return std::move(out_);
  }

 private:
  void standard(const Line& line, const StandardRow& row) {
    if (line.key == "DataType") add(line, "other-type", line.value == "0x0005" ? "DataType=7" : "DataType=5");
    if (line.key == "AccessType") {
      const bool narrower = line.value == "rw";
      if (!narrower || !row.has(StandardFlag::leaves_access))
        add(line, "other-access", narrower ? "AccessType=ro" : "AccessType=rw");
      add(line, "write-only", "AccessType=wo");
    }
    if (line.key == "PDOMapping" && !row.has(StandardFlag::pdo_mappable)) add(line, "mapped", "PDOMapping=1");
    if (line.key == "ObjectType")
      add(line, "other-code", line.value == "0x7" ? "ObjectType=9" : "ObjectType=7");
  }

  void add(const Line& line, std::string_view what, const std::string& instead) {
    auto text = text_;
    text.replace(line.begin, line.size + (instead.empty() ? 1 : 0), instead);
    out_.push_back({fmt::format("{} [{}] {}: {}", name_, line.section, line.key, what), std::move(text)});
  }

  std::string name_, text_;
  std::vector<Edit> out_;
};

/// Edits nobody notices, each with its reason behind " -- ".
std::map<std::string, std::string> known_survivors() {
  std::map<std::string, std::string> out;
  const auto text = content(folder + "lint_edit_survivors.txt");
  for (const auto line : split(text, '\n')) {
    if (trim(line).empty() || line.starts_with('#')) continue;
    const auto bar = line.find(" -- ");
    out[std::string(line.substr(0, bar))] = bar == std::string_view::npos ? "" : trim(line.substr(bar + 4));
  }
  return out;
}

TEST_CASE("Generated edits of right files are noticed, but for those listed with a reason") {
  std::set<std::string> every;
  std::vector<std::string> survivors;
  for (const auto* name : {"legal-whole.dcf", "legal-modules.eds"}) {
    const auto text = content(folder + "fixtures/" + name);
    REQUIRE(lint(*read(text, name)).findings.empty());
    for (const auto& edit : Edits(name, text).run()) {
      every.insert(edit.id);
      const auto file = read(edit.text, name);
      REQUIRE(file);
      if (lint(*file).findings.empty()) survivors.push_back(edit.id);
    }
  }
  CHECK(every.size() > 2500);
  CHECK(survivors.size() * 50 <= every.size());
  const auto known = known_survivors();
  std::string unexpected, noticed, unexplained;
  for (const auto& id : survivors) {
    if (!known.contains(id)) unexpected += "\n" + id;
  }
  for (const auto& [id, reason] : known) {
    if (std::ranges::find(survivors, id) == survivors.end()) noticed += "\n" + id;
    if (reason.empty()) unexplained += "\n" + id;
  }
  INFO(every.size() << " edits, " << survivors.size() << " survive");
  INFO("not in lint_edit_survivors.txt:" << unexpected);
  CHECK(unexpected.empty());
  INFO("listed in lint_edit_survivors.txt, but noticed or gone:" << noticed);
  CHECK(noticed.empty());
  INFO("without a reason:" << unexplained);
  CHECK(unexplained.empty());
}

}  // namespace
