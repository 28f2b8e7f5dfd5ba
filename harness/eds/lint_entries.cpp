// SPDX-License-Identifier: Apache-2.0
// Entries of the information sections: which are missing, too long, or of another kind of file.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "eds/lint_rules.hpp"
#include "eds/type_table.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view file_information = "CiA 306, [FileInfo]";
constexpr std::string_view device_information = "CiA 306, [DeviceInfo]";

constexpr Rule missing{"EDS470", Severity::warning, "An entry that describes the device is missing",
                       device_information};
constexpr Rule missing_detail{"EDS471", Severity::note,
                              "An entry that the standard's own example leaves out is missing",
                              device_information};
constexpr Rule missing_origin{"EDS472", Severity::note, "What the file is, who made it and when is not said",
                              file_information};
constexpr Rule too_long{"EDS473", Severity::warning, "A text is longer than its entry may be",
                        "CiA 306, lengths of texts"};
constexpr Rule of_a_dcf{"EDS474", Severity::note, "An EDS holds an entry or section of a DCF",
                        "CiA 306, DCF"};
constexpr Rule comment_numbers{"EDS475", Severity::warning,
                               "The lines of a comment are not numbered in a row from 1 on",
                               "CiA 306, [Comments]"};
constexpr Rule later_version{"EDS476", Severity::note, "EDSVersion is later than that of CiA 306, 4.0",
                             file_information};
constexpr Rule unknown_dummy{"EDS477", Severity::warning, "A dummy that is allowed is no basic data type",
                             "CiA 306, [DummyUsage]"};

constexpr Rule no_place{"EDS478", Severity::warning,
                        "[DeviceComissioning] does not say the node-ID or the bit rate", "CiA 306, DCF"};

constexpr const Rule* all[] = {&missing,         &missing_detail, &missing_origin, &too_long, &of_a_dcf,
                               &comment_numbers, &later_version,  &unknown_dummy,  &no_place};

constexpr std::array wanted = {"RevisionNumber", "OrderCode", "SimpleBootUpMaster", "SimpleBootUpSlave",
                               "LSS_Supported"};
constexpr std::array details = {"Granularity", "DynamicChannelsSupported", "GroupMessaging"};

bool among(const auto& words, std::string_view key) { return std::ranges::find(words, key) != words.end(); }

void check_missing(const EdsFile& file, Findings& findings) {
  if (file.file_info.present) {
    for (const auto& row : file_info_fields) {
      const auto& field = file.file_info.*row.field;
      // The others have rules of their own.
      const bool other = row.key == "FileName" || row.key == "FileVersion" || row.key == "FileRevision" ||
                         row.key == "EDSVersion" || row.key == "LastEDS";
      if (!other && field.empty())
        findings.add(missing_origin, place_of(field, file.file_info.at),
                     fmt::format("{} is missing", row.key));
    }
  }
  if (!file.device_info.present) return;
  for (const auto& row : device_info_fields) {
    const auto& field = file.device_info.*row.field;
    if (!field.empty()) continue;
    const auto at = place_of(field, file.device_info.at);
    if (among(wanted, row.key)) findings.add(missing, at, fmt::format("{} is missing", row.key));
    if (among(details, row.key)) findings.add(missing_detail, at, fmt::format("{} is missing", row.key));
  }
}

/// Key, '=' and text share a line of 255 characters.
void check_length(std::string_view key, const Field& field, const std::string& label, Findings& findings) {
  constexpr std::size_t line = 255;
  const auto most = line - key.size() - 1;
  if (field.text.size() > most)
    findings.add(too_long, field.at,
                 fmt::format("{}: {} characters, at most {} are allowed", label, field.text.size(), most));
}

void check_lengths(const Subject& subject, Findings& findings) {
  const auto& file = subject.file;
  for (const auto& row : file_info_fields)
    check_length(row.key, file.file_info.*row.field, std::string(row.key), findings);
  for (const auto& row : device_info_fields)
    check_length(row.key, file.device_info.*row.field, std::string(row.key), findings);
  for (const auto& line : file.comments.entries)
    check_length(fmt::format("Line{}", line.number), line.field, fmt::format("Line{}", line.number),
                 findings);
  each_described(subject, [&](const Spot& spot) {
    const auto& name = spot.entry.parameter_name;
    if (name.text.size() > 200) check_length("ParameterName", name, spot.name(), findings);
  });
}

/// Some editors write what a DCF would hold into every file. Once for each kind of entry.
void check_kind(const Subject& subject, Findings& findings) {
  const auto& file = subject.file;
  if (file.is_xml() || !lower(file.name).ends_with(".eds")) return;
  const auto say = [&](Position at, std::string_view what) {
    findings.add(of_a_dcf, at, fmt::format("{} belongs into a DCF", what));
  };
  if (!file.file_info.last_eds.empty()) say(file.file_info.last_eds.key_at, "LastEDS");
  if (file.commissioning.present) say(file.commissioning.at, "[DeviceComissioning]");
  if (file.connected_modules.present) say(file.connected_modules.at, "[ConnectedModules]");
  bool value = false, denotation = false;
  each_described(subject, [&](const Spot& spot) {
    const auto& entry = spot.entry;
    if (!value && !entry.parameter_value.empty()) {
      say(entry.parameter_value.key_at, "ParameterValue");
      value = true;
    }
    if (!denotation && !entry.denotation.empty()) {
      say(entry.denotation.key_at, "Denotation");
      denotation = true;
    }
  });
}

void check_comments(const NumberedList& comments, Findings& findings) {
  if (const auto* line = first_out_of_row(comments))
    findings.add(comment_numbers, line->field.key_at,
                 fmt::format("there is Line{}, but one before it is missing", line->number));
}

void check_place(const DeviceCommissioning& commissioning, Findings& findings) {
  if (!commissioning.present) return;
  for (const auto& row : commissioning_fields) {
    const auto& field = commissioning.*row.field;
    if ((row.key == "NodeID" || row.key == "Baudrate") && field.empty())
      findings.add(no_place, place_of(field, commissioning.at), fmt::format("{} is missing", row.key));
  }
}

void check_version(const Field& version, Findings& findings) {
  const auto& text = version.text;
  const bool has_form = text.size() == 3 && text[1] == '.' && text[0] >= '0' && text[0] <= '9';
  if (has_form && text >= "5.0")
    findings.add(later_version, version.at, fmt::format("EDSVersion {} is not known", text),
                 "write EDSVersion=4.0");
}

void check_dummies(const NumberedList& dummies, Findings& findings) {
  for (const auto& dummy : dummies.entries) {
    if (flag_of(dummy.field) != true) continue;
    const auto* type = dummy.number <= 0x1F ? find_type(static_cast<std::uint16_t>(dummy.number)) : nullptr;
    if (type == nullptr)
      findings.add(unknown_dummy, dummy.field.key_at,
                   fmt::format("{:04X}h is none of the data types 0001h to 001Bh", dummy.number));
  }
}

void check(const Subject& subject, Findings& findings) {
  const auto& file = subject.file;
  check_dummies(file.dummy_usage, findings);
  if (file.is_xml()) return;
  check_missing(file, findings);
  check_lengths(subject, findings);
  check_kind(subject, findings);
  check_comments(file.comments, findings);
  check_place(file.commissioning, findings);
  check_version(file.file_info.eds_version, findings);
}

}  // namespace

constinit const Group entry_rules{{"Entries of the information sections", all}, check};

}  // namespace conform::eds
