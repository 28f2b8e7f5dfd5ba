// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/eds_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/text.hpp"
#include "cli/descriptions/eds_words.hpp"

namespace conform::cli {
namespace {

using Json = nlohmann::ordered_json;
using eds::Entry;
using eds::Field;

constexpr std::size_t columns = 7;
constexpr std::size_t widest = 44;  // of a name or a value; longer ones are cut
using Row = std::array<std::string, columns>;

std::string shown(const Field& field) { return printable(eds::shortened(field.text, widest - 3)); }

std::string limits_of(const Entry& entry) {
  if (entry.low_limit.empty() && entry.high_limit.empty()) return {};
  return shown(entry.low_limit) + ".." + shown(entry.high_limit);
}

Row row_of(std::string where, const Entry& entry) {
  const bool configured = !entry.parameter_value.empty();
  return {std::move(where),
          shown(entry.parameter_name),
          printable(eds::shortened(type_words(entry), widest - 3)),
          shown(entry.access_type),
          std::string(mapping_words(entry)),
          configured ? shown(entry.parameter_value) + " (configured)" : shown(entry.default_value),
          limits_of(entry)};
}

/// Code points, so that names in UTF-8 do not shift the columns behind them.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string aligned(const std::vector<Row>& rows) {
  std::array<std::size_t, columns> widths{};
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < columns; ++i) widths[i] = std::max(widths[i], width(row[i]));
  }
  std::string out;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < columns; ++i)
      line += row[i] + std::string(widths[i] - width(row[i]) + 2, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

std::string head(const eds::EdsFile& file) {
  const auto& info = file.device_info;
  const auto line = [](std::string_view key, const std::string& text) {
    return text.empty() ? std::string() : fmt::format("{:<14}{}\n", key, text);
  };
  const auto numbered = [](const Field& name, const Field& number) {
    return shown(name) + (number.empty() ? "" : " (" + shown(number) + ")");
  };
  std::string rates;
  for (const auto& rate : info.baud_rates) {
    if (eds::flag_of(rate.field) == true) rates += (rates.empty() ? "" : ", ") + std::to_string(rate.number);
  }
  std::string out = fmt::format("{}: {}\n", printable(file.name), to_string(file.format));
  out += line("vendor", numbered(info.vendor_name, info.vendor_number));
  out += line("product", numbered(info.product_name, info.product_number));
  out += line("revision", shown(info.revision_number));
  out += line("order code", shown(info.order_code));
  out += line("bit rates", rates.empty() ? "" : rates + " kbit/s");
  const auto pdos = [](const Field& count, std::string_view word) {
    const auto number = eds::number_of(count).value_or(0);
    return fmt::format("{} {}{}", number, word, number == 1 ? "" : "s");
  };
  out += line("PDOs",
              fmt::format("{}, {}, granularity {}", pdos(info.nr_of_rx_pdo, "RPDO"),
                          pdos(info.nr_of_tx_pdo, "TPDO"), eds::number_of(info.granularity).value_or(0)));
  if (eds::flag_of(info.lss_supported) == true) out += line("LSS", "supported");
  if (file.commissioning.present)
    out += line("node", fmt::format("{} at {}", shown(file.commissioning.node_id),
                                    shown(file.commissioning.baudrate)));
  return out;
}

Json json_of(const Entry& entry) {
  Json out;
  for (const auto& row : eds::entry_fields) {
    const auto& field = entry.*row.field;
    if (!field.empty()) out[std::string(row.key)] = printable(field.text);
  }
  out["line"] = entry.at.line;
  if (entry.implied_by.known()) out["implied"] = true;
  return out;
}

template <typename Section, std::size_t count>
Json json_of(const Section& section, const std::array<eds::FieldRow<Section>, count>& rows) {
  Json out = Json::object();
  for (const auto& row : rows) {
    const auto& field = section.*row.field;
    if (!field.empty()) out[std::string(row.key)] = printable(field.text);
  }
  return out;
}

}  // namespace

std::string eds_table(const eds::EdsFile& file, const std::vector<eds::Object>& objects) {
  std::vector<Row> rows;
  rows.push_back({"object", "name", "type", "access", "PDO", "default", "limits"});
  for (const auto& object : objects) {
    if (!eds::is_structured(object)) {
      rows.push_back(row_of(to_string(object.index), object.entry));
      continue;
    }
    rows.push_back({to_string(object.index), shown(object.entry.parameter_name),
                    std::string(structure_words(object)), "", "", "", ""});
    for (const auto& sub : object.subs)
      rows.push_back(row_of(to_string(Multiplexer{object.index, sub.sub}), sub.entry));
  }
  return head(file) + "\n" + aligned(rows);
}

std::string eds_json(const eds::EdsFile& file, const std::vector<eds::Object>& objects) {
  Json out;
  out["schema"] = "canopen-conform/eds-show/1";
  out["file"] = printable(file.name);
  out["kind"] = std::string(to_string(file.format));
  out["file_info"] = json_of(file.file_info, eds::file_info_fields);
  out["device_info"] = json_of(file.device_info, eds::device_info_fields);
  out["bit_rates"] = Json::array();
  for (const auto& rate : file.device_info.baud_rates) {
    if (eds::flag_of(rate.field) == true) out["bit_rates"].push_back(rate.number);
  }
  if (file.commissioning.present)
    out["commissioning"] = json_of(file.commissioning, eds::commissioning_fields);
  out["objects"] = Json::array();
  for (const auto& object : objects) {
    Json one = json_of(object.entry);
    one["index"] = object.index.value();
    if (eds::is_structured(object)) {
      one["sub_objects"] = Json::array();
      for (const auto& sub : object.subs) {
        Json entry = json_of(sub.entry);
        entry["sub_index"] = sub.sub.value();
        one["sub_objects"].push_back(std::move(entry));
      }
    }
    out["objects"].push_back(std::move(one));
  }
  return out.dump(2) + "\n";
}

}  // namespace conform::cli
