// SPDX-License-Identifier: Apache-2.0
#include "eds/convert/to_ini.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/text.hpp"
#include "eds/convert/common.hpp"
#include "eds/dialect.hpp"
#include "eds/file_date.hpp"
#include "eds/ini_file.hpp"
#include "eds/same_value.hpp"
#include "eds/type_table.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view no_room = "CiA 306 has no room for it";
constexpr std::string_view not_in_eds = "only a DCF is configured";
constexpr std::uint64_t flags_of_cia_306 = 3;

class ToIni {
 public:
  ToIni(const EdsFile& source, Format target, std::string file_name)
      : source_(source), configured_(target == Format::dcf) {
    out_.name = file_name;
    out_.format = target;
    out_.file_info.file_name = said(std::move(file_name));
  }

  Converted run() {
    file_info();
    device_info();
    commissioning();
    dummies();
    for (const auto& each : source_.objects) object(each);
    if (source_.find(Index(0x1027)) != nullptr)
      unsaid_.add("[SupportedModules]", "1027h wants it, but an XDD does not name its modules");
    for (const auto& each : source_.unmodelled)
      unsaid_.add(each.what,
                  each.count == 1 ? std::string(no_room) : fmt::format("{}; {} of them", no_room, each.count),
                  each.at);
    return {std::move(out_), unsaid_.take()};
  }

 private:
  /// One line of a file: CiA 306 knows no value of several.
  Field line(const std::string& where, std::string_view key, const Field& field) {
    Field out = field;
    std::ranges::replace_if(out.text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    const bool joined = out.text != field.text;
    out.text = printable(trim(out.text), true);
    if (joined) unsaid_.add(where, key, field, "its line breaks become blanks");
    return out;
  }

  void file_info() {
    static const std::string where = "[FileInfo]";
    const auto& from = source_.file_info;
    auto& to = out_.file_info;
    to.present = true;
    to.file_version = line(where, "FileVersion", from.file_version);
    if (!number_of(to.file_version)) {
      if (from.file_version.empty())
        unsaid_.add(where, "FileVersion", {}, "CiA 306 wants one: 1 stands for the missing one");
      else
        unsaid_.add(where, "FileVersion", from.file_version, "CiA 306 wants a number: 1 is written");
      to.file_version = said("1");
    }
    to.file_revision = said("0");
    to.eds_version = said("4.0");
    to.description = line(where, "Description", from.description);
    to.created_by = line(where, "CreatedBy", from.created_by);
    to.modified_by = line(where, "ModifiedBy", from.modified_by);
    date(where, "CreationDate", from.creation_date, to.creation_date);
    date(where, "ModificationDate", from.modification_date, to.modification_date);
    time(where, "CreationTime", from.creation_time, to.creation_time);
    time(where, "ModificationTime", from.modification_time, to.modification_time);
  }

  void date(const std::string& where, std::string_view key, const Field& from, Field& to) {
    if (from.empty()) return;
    const auto date = file_date(from.text);
    if (!date) return unsaid_.add(where, key, from, "it is no date yyyy-mm-dd");
    to = said(ini_date(*date), from.at);
  }

  void time(const std::string& where, std::string_view key, const Field& from, Field& to) {
    if (from.empty()) return;
    const auto time = file_time(from.text);
    if (!time) return unsaid_.add(where, key, from, "it is no time hh:mm:ss");
    to = said(ini_time(*time), from.at);
  }

  void device_info() {
    static const std::string where = "[DeviceInfo]";
    const auto& from = source_.device_info;
    auto& to = out_.device_info;
    to.present = true;
    for (const auto& row : device_info_fields) {
      auto& into = to.*row.field;
      into = line(where, row.key, from.*row.field);
      const auto meaning = meaning_of(row.key);
      if (meaning == Meaning::count && into.empty()) into = said("0");
      if (meaning == Meaning::flag && !same_flag(into.text, "1") && !number_of(into))
        into = said("0", into.at);
      if (meaning == Meaning::flag && same_flag(into.text, "1")) into.text = "1";
    }
    to.compact_pdo = {};
    if (number_of(from.dynamic_channels).value_or(0) != 0) {
      unsaid_.add(where, "DynamicChannelsSupported", from.dynamic_channels,
                  "[DynamicChannels] would have to describe them: 0 is written");
      to.dynamic_channels = said("0");
    }
    if (from.revision_number.empty()) {
      const auto* revision = source_.find(Multiplexer{Index(0x1018), SubIndex(3)});
      if (revision != nullptr && number_of(revision->default_value))
        to.revision_number = said(revision->default_value.text, revision->default_value.at);
    }
    for (const auto& rate : from.baud_rates) {
      if (is_ini_bit_rate(rate.number))
        to.baud_rates.push_back(rate);
      else
        unsaid_.add(where, fmt::format("BaudRate_{}", rate.number), rate.field, std::string(no_room));
    }
  }

  void commissioning() {
    static const std::string where = "[DeviceComissioning]";
    const auto& from = source_.commissioning;
    // Editors write an empty one into every XDD.
    const bool says_something =
        std::ranges::any_of(commissioning_fields, [&](const FieldRow<DeviceCommissioning>& row) {
          const auto& field = from.*row.field;
          return !field.empty() && !same_flag(field.text, "0");
        });
    if (!from.present || !says_something) return;
    for (const auto& row : commissioning_fields) {
      const auto& field = from.*row.field;
      if (configured_)
        out_.commissioning.*row.field = line(where, row.key, field);
      else if (!field.empty())
        unsaid_.add(where, row.key, field, std::string(not_in_eds));
    }
    out_.commissioning.present = configured_;
    auto& manager = out_.commissioning.canopen_manager;
    if (!manager.empty()) manager.text = same_flag(manager.text, "1") ? "1" : "0";
  }

  void dummies() {
    out_.dummy_usage.present = true;
    for (unsigned type = 1; type <= 7; ++type) {
      const bool usable = std::ranges::any_of(source_.dummy_usage.entries, [type](const auto& dummy) {
        return dummy.number == type && same_flag(dummy.field.text, "1");
      });
      out_.dummy_usage.entries.push_back({type, said(usable ? "1" : "0")});
    }
  }

  void object(const Object& from) {
    Object to = from;
    const auto where = to_string(from.index);
    const bool structured = is_structured(from);
    entry(where, to.entry, !structured);
    for (auto& sub : to.subs) entry(to_string(Multiplexer{from.index, sub.sub}), sub.entry, true);
    to.sub_number = {};
    if (structured) {
      const auto count =
          std::ranges::count_if(to.subs, [](const SubObject& sub) { return sub.sub != SubIndex(0xFF); });
      to.sub_number = said(std::to_string(count));
    }
    out_.objects.push_back(std::move(to));
  }

  void entry(const std::string& where, Entry& entry, bool has_value) {
    const auto type = data_type(entry);
    const auto* known = type ? find_type(*type) : nullptr;
    for (const auto& row : entry_fields) {
      auto& field = entry.*row.field;
      const bool configures = row.key == "ParameterValue" || row.key == "Denotation";
      if (configures && !configured_ && !field.empty()) {
        unsaid_.add(where, row.key, field, std::string(not_in_eds));
        field = {};
      }
      field = line(where, row.key, field);
      if (meaning_of(row.key) == Meaning::value && known != nullptr) value(*known, field);
    }
    if (const auto code = number_of(entry.object_type))
      entry.object_type.text = fmt::format("0x{:X}", *code);
    else if (entry.object_type.empty())
      entry.object_type = said("0x7");
    if (type) entry.data_type.text = fmt::format("0x{:04X}", *type);
    access_and_mapping(where, entry, has_value);
    flags(where, entry);
  }

  /// The words of XML Schema for a BOOLEAN, and the blanks that some editors put between octets.
  static void value(const TypeInfo& type, Field& field) {
    if (type.kind == TypeKind::boolean && (same_word(field.text, "true") || same_word(field.text, "false")))
      field.text = same_word(field.text, "true") ? "1" : "0";
    if (type.kind == TypeKind::octets || type.kind == TypeKind::domain) std::erase(field.text, ' ');
  }

  void flags(const std::string& where, Entry& entry) {
    const auto flags = number_of(entry.obj_flags);
    if (!flags) return;
    if (*flags > flags_of_cia_306)
      unsaid_.add(where, "ObjFlags", entry.obj_flags, "CiA 306 knows only the two lowest bits");
    const auto kept = *flags & flags_of_cia_306;
    entry.obj_flags = kept != 0 ? said(fmt::format("0x{:X}", kept)) : Field{};
  }

  void access_and_mapping(const std::string& where, Entry& entry, bool has_value) {
    const auto reached = reach(entry);
    const auto word = entry.access_type;
    if (!reached.access && !word.empty()) {
      unsaid_.add(where, "AccessType", word, "CiA 306 does not know the word");
      entry.access_type = {};
    }
    if (reached.access == Access::rwr || reached.access == Access::rww)
      entry.access_type.text = reached.access == Access::rwr ? "rwr" : "rww";
    if (reached.mapped.any() && reached.mapped != directions_of(reached.access))
      unsaid_.add(where, "PDOMapping", entry.pdo_mapping,
                  "CiA 306 leaves the direction to the access type, which leaves another one");
    if (same_word(entry.pdo_mapping.text, "default"))
      unsaid_.add(where, "PDOMapping", entry.pdo_mapping,
                  "CiA 306 leaves it to the mapping parameters what is mapped by default");
    if (has_value || reached.mapped.any())
      entry.pdo_mapping = said(reached.mapped.any() ? "1" : "0", entry.pdo_mapping.at);
    else
      entry.pdo_mapping = {};
  }

  const EdsFile& source_;
  bool configured_;
  EdsFile out_;
  UnsaidList unsaid_;
};

}  // namespace

Converted to_ini(const EdsFile& source, Format target, std::string file_name) {
  return ToIni(source, target, std::move(file_name)).run();
}

}  // namespace conform::eds
