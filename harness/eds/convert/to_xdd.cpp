// SPDX-License-Identifier: Apache-2.0
#include "eds/convert/to_xdd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "base/text.hpp"
#include "eds/convert/common.hpp"
#include "eds/convert/write_xdd.hpp"
#include "eds/convert/xdd_types.hpp"
#include "eds/dialect.hpp"
#include "eds/expand.hpp"
#include "eds/file_date.hpp"
#include "eds/same_value.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view no_room = "CiA 311 has no room for it";
constexpr std::string_view not_in_xdd = "only an XDC is configured";

class ToXdd {
 public:
  ToXdd(const EdsFile& source, Format target, std::string file_name)
      : source_(source), configured_(target == Format::xdc) {
    out_.name = out_.file_info.file_name.text = std::move(file_name);
    out_.file_info.file_name.present = true;
    out_.format = target;
  }

  Result<Converted> run() {
    auto objects = expand(source_);
    if (!objects) return std::unexpected(objects.error());
    file_info();
    commissioning();
    dummies();
    for (auto& each : *objects) object(std::move(each));
    device_info();
    sections();
    return Converted{std::move(out_), unsaid_.take()};
  }

 private:
  /// A text for an attribute: what is no UTF-8 cannot stand in XML.
  Field text(const std::string& where, std::string_view key, const Field& field) {
    Field out = field;
    out.text = printable(field.text, true);  // a tab may stand in XML
    if (out.text != field.text)
      unsaid_.add(where, key, field, fmt::format("bytes that are no UTF-8 text are written as {}", out.text));
    return out;
  }

  static void flag(Field& field) {
    if (!field.empty()) field.text = same_flag(field.text, "1") ? "1" : same_flag(field.text, "0") ? "0" : "";
  }

  template <typename Section>
  void left_behind(const std::string& where, const Section& section, std::span<const FieldRow<Section>> rows,
                   bool all = false) {
    for (const auto& row : rows) {
      const auto& field = section.*row.field;
      if (!field.empty() && (all || only_in_ini(row.key)))
        unsaid_.add(where, row.key, field, std::string(all ? not_in_xdd : no_room));
    }
  }

  void file_info() {
    static const std::string where = "[FileInfo]";
    const auto& from = source_.file_info;
    auto& to = out_.file_info;
    left_behind<FileInfo>(where, from, file_info_fields);
    to.file_version = text(where, "FileVersion", from.file_version);
    to.description = text(where, "Description", from.description);
    to.created_by = text(where, "CreatedBy", from.created_by);
    to.modified_by = text(where, "ModifiedBy", from.modified_by);
    date(where, "CreationDate", from.creation_date, to.creation_date);
    date(where, "ModificationDate", from.modification_date, to.modification_date);
    time(where, "CreationTime", from.creation_time, to.creation_time);
    time(where, "ModificationTime", from.modification_time, to.modification_time);
    if (!to.creation_date.empty()) return;
    // The schema wants one; a date that is nobody's is better than one that changes with every run.
    to.creation_date = said("1970-01-01");
    if (from.creation_date.empty())
      unsaid_.add(where, "CreationDate", {}, "CiA 311 wants a date: 1970-01-01 stands for the missing one");
  }

  void date(const std::string& where, std::string_view key, const Field& from, Field& to) {
    if (from.empty()) return;
    const auto date = file_date(from.text);
    if (!date) return unsaid_.add(where, key, from, "it is no date mm-dd-yyyy");
    to = said(xml_date(*date), from.at);
  }

  void time(const std::string& where, std::string_view key, const Field& from, Field& to) {
    if (from.empty()) return;
    const auto time = file_time(from.text);
    if (!time) return unsaid_.add(where, key, from, "it is no time hh:mmAM or hh:mmPM");
    to = said(xml_time(*time), from.at);
  }

  void device_info() {
    static const std::string where = "[DeviceInfo]";
    const auto& from = source_.device_info;
    auto& to = out_.device_info;
    for (const auto& row : device_info_fields) {
      const auto& field = from.*row.field;
      if (field.empty()) continue;
      if (only_in_ini(row.key)) {
        const auto* revision = source_.find(Multiplexer{Index(0x1018), SubIndex(3)});
        const bool there = row.key == "RevisionNumber" && revision != nullptr &&
                           same_number(field.text, revision->default_value.text);
        const bool written_out = row.key == "CompactPDO" && number_of(field).value_or(1) != 0;
        if (row.key == "CompactPDO" && !written_out) continue;
        unsaid_.add(where, row.key, field,
                    std::string(there         ? "CiA 311 has no room for it; 1018h:03 says the same"
                                : written_out ? "the PDOs that it implies are written out"
                                              : no_room));
        continue;
      }
      auto& into = to.*row.field;
      into = text(where, row.key, field);
      const auto meaning = meaning_of(row.key);
      if (meaning == Meaning::flag && row.key != "DynamicChannelsSupported") flag(into);
      const bool counted =
          row.key == "Granularity" || row.key == "DynamicChannelsSupported" || meaning == Meaning::count;
      if (counted) decimal(where, row.key, field, into);
    }
    if (to.granularity.empty()) {
      // 0 says that no mapping can be changed.
      const bool maps = std::ranges::any_of(out_.objects, [](const Object& object) {
        const auto index = object.index.value();
        return (index >= 0x1600 && index <= 0x17FF) || (index >= 0x1A00 && index <= 0x1BFF);
      });
      to.granularity = said(maps ? "8" : "0");
      if (from.granularity.empty())
        unsaid_.add(where, "Granularity", {},
                    fmt::format("CiA 311 wants one: {} stands for the missing one", to.granularity.text));
    }
    for (const auto& rate : from.baud_rates) {
      if (!same_flag(rate.field.text, "1")) continue;
      if (is_xml_bit_rate(rate.number))
        to.baud_rates.push_back(rate);
      else
        unsaid_.add(where, fmt::format("BaudRate_{}", rate.number), rate.field, std::string(no_room));
    }
    std::ranges::sort(to.baud_rates, {}, &NumberedField::number);
  }

  /// The schema wants xsd:unsignedByte and the like: no hexadecimal.
  void decimal(const std::string& where, std::string_view key, const Field& from, Field& into) {
    const auto number = number_of(from);
    if (number) {
      into.text = std::to_string(*number);
    } else {
      unsaid_.add(where, key, from, "it is no number");
      into = {};
    }
  }

  void commissioning() {
    static const std::string where = "[DeviceComissioning]";
    const auto& from = source_.commissioning;
    if (!from.present) return;
    if (!configured_) return left_behind<DeviceCommissioning>(where, from, commissioning_fields, true);
    left_behind<DeviceCommissioning>(where, from, commissioning_fields);
    auto& to = out_.commissioning;
    to.present = true;
    to.node_name = text(where, "NodeName", from.node_name);
    to.network_name = text(where, "NetworkName", from.network_name);
    to.canopen_manager = from.canopen_manager;
    flag(to.canopen_manager);
    const auto number = [&](std::string_view key, const Field& source, Field& into) {
      into = source;
      if (!source.empty()) decimal(where, key, source, into);
    };
    number("NodeID", from.node_id, to.node_id);
    number("Baudrate", from.baudrate, to.baudrate);
    number("NetNumber", from.net_number, to.net_number);
  }

  /// The schema lists the seven types of CiA 306's example and no others.
  void dummies() {
    for (const auto& dummy : source_.dummy_usage.entries) {
      if (dummy.number >= 1 && dummy.number <= 7)
        out_.dummy_usage.entries.push_back(dummy);
      else if (same_flag(dummy.field.text, "1"))
        unsaid_.add("[DummyUsage]", fmt::format("Dummy{:04X}", dummy.number), dummy.field,
                    std::string(no_room));
    }
  }

  void object(Object object) {
    const auto where = to_string(object.index);
    if (number_of(object.compact_sub_obj).value_or(0) > 0)
      unsaid_.add(where, "CompactSubObj", object.compact_sub_obj, "its sub-objects are written out");
    if (object.lists->links.present)
      unsaid_.add("[" + object.lists->links.name + "]", std::string(no_room), object.lists->links.at);
    object.compact_sub_obj = {};
    object.lists = {};
    const bool structured = is_structured(object);
    entry(where, object.entry, !structured);
    for (auto& sub : object.subs) entry(to_string(Multiplexer{object.index, sub.sub}), sub.entry, true);
    object.sub_number = {};
    if (structured) {
      const auto count =
          std::ranges::count_if(object.subs, [](const SubObject& sub) { return sub.sub != SubIndex(0xFF); });
      object.sub_number = said(std::to_string(count));
    }
    out_.objects.push_back(std::move(object));
  }

  void entry(const std::string& where, Entry& entry, bool has_value) {
    for (const auto& row : entry_fields) {
      auto& field = entry.*row.field;
      const bool configures = row.key == "ParameterValue" || row.key == "Denotation";
      if (!field.empty() && (only_in_ini(row.key) || (configures && !configured_))) {
        unsaid_.add(where, row.key, field, std::string(configures ? not_in_xdd : no_room));
        field = {};
      }
      field = text(where, row.key, field);
      if (meaning_of(row.key) == Meaning::value && parse_number(field.text))
        field.text = std::string(without_comment(field.text));
    }
    types(where, entry);
    access_and_mapping(where, entry, has_value);
    const auto flags = number_of(entry.obj_flags);
    if (!entry.obj_flags.empty() && !flags)
      unsaid_.add(where, "ObjFlags", entry.obj_flags, "it is no number");
    entry.obj_flags = flags.value_or(0) != 0 ? said(fmt::format("0x{:04X}", *flags)) : Field{};
  }

  void types(const std::string& where, Entry& entry) {
    const auto code = entry.object_type.empty() ? 7U : number_of(entry.object_type);
    if (!code || *code > 0xFF)
      unsaid_.add(where, "ObjectType", entry.object_type, "it is no object code: VAR is written");
    const auto type = data_type(entry);
    if (!entry.data_type.empty() && !type)
      unsaid_.add(where, "DataType", entry.data_type, "it is no data type");
    entry.object_type = said(code && *code <= 0xFF ? std::to_string(*code) : "7");
    entry.data_type = type ? said(fmt::format("0x{:04X}", *type)) : Field{};
  }

  void access_and_mapping(const std::string& where, Entry& entry, bool has_value) {
    const auto reached = reach(entry);
    const auto word = entry.access_type;
    if (!reached.access) {
      if (!word.empty()) unsaid_.add(where, "AccessType", word, "CiA 311 does not know the word");
      entry.access_type = {};
    } else {
      entry.access_type = said(std::string(word_of(*reached.access)));
    }
    const bool directed = reached.access == Access::rwr || reached.access == Access::rww;
    const char* mapping = !reached.mapped.any() ? "no"
                          : !directed           ? "optional"
                          : reached.mapped.rpdo ? "RPDO"
                                                : "TPDO";
    if (has_value || reached.mapped.any())
      entry.pdo_mapping = said(mapping);
    else
      entry.pdo_mapping = {};
    if (!directed) return;
    // The direction is in the mapping; where there is none, a parameter alone has a word for it.
    if (!reached.mapped.any() && has_value && parameter_can_say(entry)) return;
    entry.access_type.text = "rw";
    if (!reached.mapped.any())
      unsaid_.add(where, "AccessType", word, "CiA 311 says it of entries that can be mapped: rw is written");
  }

  static std::string_view word_of(Access access) {
    switch (access) {
      case Access::ro: return "ro";
      case Access::wo: return "wo";
      case Access::rw: return "rw";
      case Access::rwr: return "rwr";
      case Access::rww: return "rww";
      case Access::constant: return "const";
    }
    return {};
  }

  void sections() {
    if (source_.comments.present) unsaid_.add("[Comments]", std::string(no_room), source_.comments.at);
    if (source_.dynamic_channels.known() && source_.unmodelled.empty())
      unsaid_.add("[DynamicChannels]", std::string(no_room), source_.dynamic_channels);
    if (source_.supported_modules.present)
      unsaid_.add("[SupportedModules]", "CiA 311 describes modules in files of their own",
                  source_.supported_modules.at);
    for (const auto& module : source_.modules)
      unsaid_.add(fmt::format("[M{}ModuleInfo]", module.number),
                  "CiA 311 describes modules in files of their own", module.at);
    for (const auto& each : source_.unmodelled) unsaid_.add(each.what, std::string(no_room), each.at);
    for (const auto& remark : source_.remarks.all()) {
      if (remark.what == Deviation::unknown_section)
        unsaid_.add("[" + remark.detail + "]", "the section is not known", remark.at);
      if (remark.what == Deviation::unknown_entry)
        unsaid_.add(remark.detail, "the entry is not known", remark.at);
    }
    lists();
  }

  /// CiA 311 sorts objects by their index alone.
  void lists() {
    struct Row {
      const NumberedList* list;
      ObjectList of;
    };
    const Row rows[] = {{&source_.mandatory_objects, ObjectList::mandatory},
                        {&source_.optional_objects, ObjectList::optional},
                        {&source_.manufacturer_objects, ObjectList::manufacturer}};
    for (const auto& row : rows) {
      for (const auto& entry : row.list->entries) {
        const auto index = number_of(entry.field);
        if (!index || *index > 0xFFFF) continue;
        const auto at = Index(static_cast<std::uint16_t>(*index));
        const auto where = "[" + row.list->name + "]";
        if (source_.find(at) == nullptr && find_object(out_.objects, at) == nullptr)
          unsaid_.add(where, std::to_string(entry.number), entry.field, "no section describes the object");
        else if (list_of(at) != row.of)
          unsaid_.add(where, std::to_string(entry.number), entry.field, "CiA 311 counts it to another list");
      }
    }
  }

  const EdsFile& source_;
  bool configured_;
  EdsFile out_;
  UnsaidList unsaid_;
};

}  // namespace

Result<Converted> to_xdd(const EdsFile& source, Format target, std::string file_name) {
  return ToXdd(source, target, std::move(file_name)).run();
}

}  // namespace conform::eds
