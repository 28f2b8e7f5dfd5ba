// SPDX-License-Identifier: Apache-2.0
// Information sections: file, device, dummies, comments, commissioning.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/text.hpp"
#include "eds/file_date.hpp"
#include "eds/ini_file.hpp"
#include "eds/lint_rules.hpp"
#include "eds/type_table.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view file_information = "CiA 306, [FileInfo]";
constexpr std::string_view device_information = "CiA 306, [DeviceInfo]";
constexpr std::string_view dcf = "CiA 306, DCF";

constexpr Rule no_file_info{"EDS100", Severity::error, "There is no [FileInfo]", file_information};
constexpr Rule no_device_info{"EDS101", Severity::error, "There is no [DeviceInfo]", device_information};
constexpr Rule no_dummy_usage{"EDS102", Severity::warning, "There is no [DummyUsage]",
                              "CiA 306, [DummyUsage]"};
constexpr Rule no_version{"EDS103", Severity::warning, "EDSVersion is missing, which means 3.0, or below 4.0",
                          file_information};
constexpr Rule bad_version{"EDS104", Severity::warning, "EDSVersion is not written as x.y", file_information};
constexpr Rule bad_date{"EDS105", Severity::warning, "A date is not written as mm-dd-yyyy", file_information};
constexpr Rule bad_time{"EDS106", Severity::warning, "A time is not written as hh:mmAM or hh:mmPM",
                        file_information};
constexpr Rule other_name{"EDS107", Severity::note, "FileName is not the name of the file", file_information};
constexpr Rule missing_file_entry{"EDS108", Severity::warning,
                                  "FileName, FileVersion or FileRevision is missing", file_information};
constexpr Rule missing_device_entry{"EDS109", Severity::warning,
                                    "An entry that names the device or counts its PDOs is missing",
                                    device_information};
constexpr Rule no_baud_rate{"EDS110", Severity::warning, "No bit rate is supported", device_information};
constexpr Rule odd_baud_rate{"EDS111", Severity::note, "A bit rate is none of those of CiA 301",
                             "CiA 301, 5.3"};
constexpr Rule comment_count{"EDS112", Severity::error, "There are fewer comment lines than Lines says",
                             "CiA 306, [Comments]"};
constexpr Rule no_commissioning{"EDS113", Severity::warning, "A DCF has no [DeviceComissioning]", dcf};
constexpr Rule bad_node_id{"EDS114", Severity::error, "The node-ID is not in 1 to 127", "CiA 301, 7.2.1"};
constexpr Rule unsupported_rate{"EDS115", Severity::error,
                                "The configured bit rate is not supported by the device", dcf};
constexpr Rule reserved_entry{"EDS116", Severity::note,
                              "An entry of earlier versions is used, whose name is reserved now",
                              device_information};
constexpr Rule fine_dummy{"EDS117", Severity::note, "A dummy that is allowed is shorter than the granularity",
                          "CiA 306, [DummyUsage]"};
constexpr Rule dynamic_channels{"EDS118", Severity::warning,
                                "DynamicChannelsSupported and [DynamicChannels] contradict each other",
                                device_information};
constexpr Rule open_dummy{"EDS119", Severity::warning, "A dummy that is allowed has no fixed length",
                          "CiA 306, [DummyUsage]"};

constexpr Rule more_comments{"EDS120", Severity::warning, "There are more comment lines than Lines says",
                             "CiA 306, [Comments]"};
constexpr Rule early_change{"EDS121", Severity::note, "The file was changed before it was created",
                            file_information};

constexpr const Rule* all[] = {
    &no_file_info,     &no_device_info, &no_dummy_usage, &no_version,         &bad_version,
    &bad_date,         &bad_time,       &other_name,     &missing_file_entry, &missing_device_entry,
    &no_baud_rate,     &odd_baud_rate,  &comment_count,  &no_commissioning,   &bad_node_id,
    &unsupported_rate, &reserved_entry, &fine_dummy,     &dynamic_channels,   &open_dummy,
    &more_comments,    &early_change};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Compares with a pattern in which 0 stands for a digit.
bool has_shape(std::string_view text, std::string_view pattern) {
  return std::ranges::equal(text, pattern, [](char c, char p) { return p == '0' ? is_digit(c) : c == p; });
}

unsigned two_digits(std::string_view text, std::size_t at) {
  return static_cast<unsigned>(text[at] - '0') * 10U + static_cast<unsigned>(text[at + 1] - '0');
}

bool is_date(std::string_view text) {
  if (!has_shape(text, "00-00-0000")) return false;
  const auto month = two_digits(text, 0);
  const auto day = two_digits(text, 3);
  return month >= 1 && month <= 12 && day >= 1 && day <= 31;
}

bool is_time(std::string_view text) {
  const auto word = lower(text);
  if (!has_shape(word, "00:00am") && !has_shape(word, "00:00pm")) return false;
  // Whether midnight is 12 or 00 is not worth a finding.
  return two_digits(word, 0) <= 12 && two_digits(word, 3) <= 59;
}

void check_version(const Field& version, Position section, Findings& findings) {
  if (version.empty()) {
    findings.add(no_version, place_of(version, section), "EDSVersion is missing", "write EDSVersion=4.0");
    return;
  }
  if (!has_shape(version.text, "0.0")) {
    findings.add(bad_version, version.at,
                 fmt::format("EDSVersion '{}' is not written as x.y", shortened(version.text)),
                 "write EDSVersion=4.0");
  } else if (version.text < "4.0") {
    findings.add(no_version, version.at, fmt::format("EDSVersion {} is older than 4.0", version.text));
  }
}

void check_file_info(const EdsFile& file, Findings& findings) {
  const auto& info = file.file_info;
  if (!info.present) {
    findings.add(no_file_info, {}, "there is no [FileInfo]");
    return;
  }
  check_version(info.eds_version, info.at, findings);
  for (const auto* date : {&info.creation_date, &info.modification_date}) {
    if (!date->empty() && !is_date(date->text))
      findings.add(bad_date, date->at,
                   fmt::format("'{}' is no date of the form mm-dd-yyyy", shortened(date->text)));
  }
  const auto created = file_date(info.creation_date.text);
  const auto changed = file_date(info.modification_date.text);
  if (is_date(info.creation_date.text) && is_date(info.modification_date.text) && created && changed &&
      *changed < *created)
    findings.add(early_change, info.modification_date.at,
                 fmt::format("ModificationDate {} is before CreationDate {}", info.modification_date.text,
                             info.creation_date.text),
                 "the month comes first: mm-dd-yyyy");
  for (const auto* time : {&info.creation_time, &info.modification_time}) {
    if (!time->empty() && !is_time(time->text))
      findings.add(bad_time, time->at,
                   fmt::format("'{}' is no time of the form hh:mmAM or hh:mmPM", shortened(time->text)));
  }
  const auto after_folder = [](std::string_view path) { return path.substr(path.find_last_of("/\\") + 1); };
  const auto name = after_folder(file.name);
  if (!info.file_name.empty() && !same_word(after_folder(info.file_name.text), name))
    findings.add(other_name, info.file_name.at,
                 fmt::format("FileName says '{}', the file is '{}'", shortened(info.file_name.text), name));
  for (const auto& row : file_info_fields) {
    const bool wanted = row.key == "FileName" || row.key == "FileVersion" || row.key == "FileRevision";
    const auto& field = info.*row.field;
    if (wanted && field.empty())
      findings.add(missing_file_entry, place_of(field, info.at), fmt::format("{} is missing", row.key));
  }
}

constexpr std::uint64_t standard_rates[] = {10, 20, 50, 125, 250, 500, 800, 1000};

void check_device_info(const EdsFile& file, Findings& findings) {
  const auto& info = file.device_info;
  if (!info.present) {
    findings.add(no_device_info, {}, "there is no [DeviceInfo]");
    return;
  }
  for (const auto& row : device_info_fields) {
    const bool counts = row.key == "NrOfRXPDO" || row.key == "NrOfTXPDO";
    const bool numbers = row.key == "VendorNumber" || row.key == "ProductNumber";
    const bool wanted =
        row.key == "VendorName" || row.key == "ProductName" || ((counts || numbers) && !file.is_xml());
    const auto& field = info.*row.field;
    if (wanted && field.empty())
      findings.add(missing_device_entry, place_of(field, info.at), fmt::format("{} is missing", row.key));
  }
  const bool some = std::ranges::any_of(info.baud_rates,
                                        [](const auto& rate) { return flag_of(rate.field).value_or(true); });
  if (!some) findings.add(no_baud_rate, info.at, "no BaudRate_ entry is 1");
  for (const auto& rate : info.baud_rates) {
    if (std::ranges::find(standard_rates, rate.number) == std::end(standard_rates))
      findings.add(odd_baud_rate, rate.field.key_at,
                   fmt::format("{} kbit/s is no bit rate of CiA 301", rate.number));
  }
}

void check_commissioning(const EdsFile& file, Findings& findings) {
  const auto& info = file.commissioning;
  const auto name = lower(file.name);
  if (!info.present) {
    // Some editors save their projects as EDS with a few configured values in it: that is no DCF.
    if (!file.is_xml() && (name.ends_with(".dcf") || (file.format == Format::dcf && !name.ends_with(".eds"))))
      findings.add(no_commissioning, {},
                   "a DCF without [DeviceComissioning] says neither node-ID nor bit rate");
    return;
  }
  const auto node = number_of(info.node_id);
  const bool no_node = info.node_id.empty() || (file.is_xml() && node == 0U);
  if (!no_node && node && (*node < 1 || *node > 127))
    findings.add(bad_node_id, info.node_id.at,
                 fmt::format("NodeID {} is not in 1 to 127", shortened(info.node_id.text)));
  const auto rate = number_of(info.baudrate);
  if (!rate || *rate == 0) return;
  const auto claim = std::ranges::find(file.device_info.baud_rates, *rate, &NumberedField::number);
  // A rate that is not named is not supported; where none is named there is a finding already.
  const bool named = claim != file.device_info.baud_rates.end();
  if (named ? flag_of(claim->field) == false : !file.device_info.baud_rates.empty())
    findings.add(
        unsupported_rate, info.baudrate.at,
        fmt::format("Baudrate is {} kbit/s, but BaudRate_{} is {}", *rate, *rate, named ? "0" : "missing"));
}

void check_dummies(const EdsFile& file, Findings& findings) {
  const auto granularity = number_of(file.device_info.granularity).value_or(0);
  for (const auto& dummy : file.dummy_usage.entries) {
    const auto* type = dummy.number <= 0xFFFF ? find_type(static_cast<std::uint16_t>(dummy.number)) : nullptr;
    if (type == nullptr || flag_of(dummy.field) != true) continue;
    if (type->bits == 0) {
      findings.add(open_dummy, dummy.field.at, fmt::format("{} has no fixed length", type->name));
      continue;
    }
    if (type->bits >= granularity || granularity > 64) continue;
    findings.add(fine_dummy, dummy.field.at,
                 fmt::format("{} has {} bit, but Granularity is {}", type->name, type->bits, granularity));
  }
}

void check_dynamic_channels(const EdsFile& file, Findings& findings) {
  const auto& field = file.device_info.dynamic_channels;
  const auto supported = number_of(field);
  if (!supported) return;
  if (*supported != 0 && !file.dynamic_channels.known())
    findings.add(dynamic_channels, field.at, "there is no [DynamicChannels]");
  if (*supported == 0 && file.dynamic_channels.known())
    findings.add(dynamic_channels, field.at, "[DynamicChannels] is there, but DynamicChannelsSupported is 0");
}

void check(const Subject& subject, Findings& findings) {
  const auto& file = subject.file;
  if (file.is_xml()) {
    check_device_info(file, findings);
    check_commissioning(file, findings);
    return;
  }
  check_file_info(file, findings);
  check_device_info(file, findings);
  check_dummies(file, findings);
  check_dynamic_channels(file, findings);
  if (!file.dummy_usage.present) findings.add(no_dummy_usage, {}, "there is no [DummyUsage]");
  const auto& comments = file.comments;
  if (comments.present) {
    const auto lines = number_of(comments.count);
    if (!comments.count.empty() && !lines) return check_commissioning(file, findings);
    if (comments.count.empty() || lines.value_or(0) != comments.entries.size())
      findings.add(
          comments.count.empty() || *lines > comments.entries.size() ? comment_count : more_comments,
          place_of(comments.count, comments.at),
          fmt::format("Lines says {}, but there are {} lines", lines.value_or(0), comments.entries.size()));
  }
  for (const auto& remark : file.remarks.all()) {
    if (remark.what == Deviation::reserved_entry)
      findings.add(reserved_entry, remark.at, fmt::format("'{}' is reserved", remark.detail));
  }
  check_commissioning(file, findings);
}

}  // namespace

constinit const Group info_rules{{"Information sections", all}, check};

}  // namespace conform::eds
