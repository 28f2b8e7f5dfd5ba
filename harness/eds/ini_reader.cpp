// SPDX-License-Identifier: Apache-2.0
#include "eds/ini_reader.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

#include "base/text.hpp"
#include "eds/section_name.hpp"

namespace conform::eds {
namespace {

Field to_field(const IniEntry& entry) {
  return {std::string(entry.value), entry.value_at, entry.key_at, true};
}

/// Of versions before 4.0 (CiA 306, [DeviceInfo]): kept so that nobody gives them another meaning.
constexpr std::string_view reserved_device_info[] = {"ProductVersion",       "ProductRevision",
                                                     "LMT_ManufacturerName", "LMT_ProductName",
                                                     "ExtendedBootUpMaster", "ExtendedBootUpSlave"};

/// The decimal number behind `prefix` in a key, as in Line12.
std::optional<std::uint64_t> numbered(std::string_view key, std::string_view prefix, int base = 10) {
  if (key.size() <= prefix.size() || !same_word(key.substr(0, prefix.size()), prefix)) return std::nullopt;
  key.remove_prefix(prefix.size());
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), number, base);
  if (error != std::errc() || end != key.data() + key.size()) return std::nullopt;
  return number;
}

/// The fields of one section, taken one after the other; what nobody takes is unknown.
class Taker {
 public:
  Taker(const IniSection& section, Remarks& remarks) : section_(section), remarks_(remarks) {
    const auto count = section.entries.size();
    taken_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t first = i;
      if (count <= few) {
        first = place_of(section.entries[i].key);
      } else {
        first = first_.try_emplace(lower(section.entries[i].key), i).first->second;
      }
      if (first != i) again_.push_back({i, first});
    }
  }

  template <typename Section>
  void fields(Section& into, std::span<const FieldRow<Section>> rows) {
    for (const auto& row : rows) field(row.key, into.*row.field);
  }

  void field(std::string_view key, Field& into) {
    const auto place = place_of(key);
    if (place == section_.entries.size()) return;
    taken_[place] = true;
    if (!into.present) into = to_field(section_.entries[place]);
  }

  /// Every entry with a number behind `prefix`, repeated ones included.
  void numbers(std::string_view prefix, std::vector<NumberedField>& into, int base = 10) {
    for (std::size_t i = 0; i < section_.entries.size(); ++i) {
      if (taken_[i]) continue;
      const auto number = numbered(section_.entries[i].key, prefix, base);
      if (!number) continue;
      taken_[i] = true;
      into.push_back({*number, to_field(section_.entries[i])});
    }
  }

  /// Entries that mean nothing, and have a name that the standard keeps.
  void reserved(std::span<const std::string_view> keys) {
    for (const auto key : keys) {
      const auto place = place_of(key);
      if (place == section_.entries.size()) continue;
      taken_[place] = true;
      remarks_.add(Deviation::reserved_entry, section_.entries[place].key_at, section_.entries[place].key);
    }
  }

  void rest_is_known() { taken_.assign(taken_.size(), true); }

  /// Remarks what is left over. A repeated key is one mistake, not two.
  void finish() {
    for (const auto& [place, first] : again_) {
      const auto& entry = section_.entries[place];
      remarks_.add(Deviation::duplicate_entry, entry.key_at, entry.key, section_.entries[first].key_at);
      taken_[place] = true;
    }
    for (std::size_t i = 0; i < section_.entries.size(); ++i) {
      const auto& entry = section_.entries[i];
      if (!taken_[i]) remarks_.add(Deviation::unknown_entry, entry.key_at, entry.key);
    }
  }

 private:
  struct Again {
    std::size_t place;
    std::size_t first;
  };
  static constexpr std::size_t few = 32;  // entries that are faster to look through than to index

  /// Of the first entry with this key; the number of entries when there is none.
  [[nodiscard]] std::size_t place_of(std::string_view key) const {
    const auto& entries = section_.entries;
    if (entries.size() <= few) {
      const auto found =
          std::ranges::find_if(entries, [key](const auto& entry) { return same_word(entry.key, key); });
      return static_cast<std::size_t>(found - entries.begin());
    }
    const auto found = first_.find(lower(key));
    return found == first_.end() ? entries.size() : found->second;
  }

  const IniSection& section_;
  Remarks& remarks_;
  std::unordered_map<std::string, std::size_t> first_;  ///< empty when there are few
  std::vector<Again> again_;
  std::vector<bool> taken_;
};

/// Objects while they are collected: sections come in any order, mostly in that of the indices. An object is
/// large, so it is made where it stays.
class Pile {
 public:
  /// So many will come, at most.
  void expect(std::size_t count) { objects_.reserve(std::min<std::size_t>(count, 0x10000)); }

  Object& object(Index index, Position position) {
    if (!objects_.empty() && objects_.back().index == index) return objects_.back();
    if (places_.empty() && !objects_.empty() && index < objects_.back().index) {
      for (std::size_t i = 0; i < objects_.size(); ++i) places_.emplace(objects_[i].index, i);
    }
    if (!places_.empty()) {
      const auto [place, fresh] = places_.try_emplace(index, objects_.size());
      if (!fresh) return objects_[place->second];
    }
    auto& object = objects_.emplace_back();
    object.index = index;
    object.described = false;
    object.entry.at = position;  // for a sub-object without object
    return object;
  }

  /// The entry of a sub-index; it stays where it is until the next call.
  static Entry& sub_entry(Object& object, SubIndex sub) {
    const auto place = std::ranges::lower_bound(object.subs, sub, {}, &SubObject::sub);
    if (place != object.subs.end() && place->sub == sub) return place->entry;
    return object.subs.insert(place, SubObject{sub, {}})->entry;
  }

  std::vector<Object> finish(Remarks& remarks) {
    if (!std::ranges::is_sorted(objects_, {}, &Object::index)) sort();
    for (const auto& object : objects_) {
      if (!object.described)
        remarks.add(Deviation::sub_without_object, object.entry.at, to_string(object.index));
    }
    std::erase_if(objects_, [](const Object& object) { return !object.described && object.subs.empty(); });
    return std::move(objects_);
  }

 private:
  /// An object is large: each is moved once, to where another has made room.
  void sort() {
    std::vector<std::size_t> from(objects_.size());  // place -> where its object stands
    std::iota(from.begin(), from.end(), std::size_t{0});
    std::ranges::sort(from, {}, [this](std::size_t place) { return objects_[place].index; });
    for (std::size_t begin = 0; begin < from.size(); ++begin) {
      if (from[begin] == begin) continue;
      auto first = std::move(objects_[begin]);
      auto hole = begin;
      while (from[hole] != begin) {
        objects_[hole] = std::move(objects_[from[hole]]);
        hole = std::exchange(from[hole], hole);
      }
      objects_[hole] = std::move(first);
      from[hole] = hole;
    }
  }

  std::vector<Object> objects_;
  std::map<Index, std::size_t> places_;  ///< empty as long as the indices come in their order
};

class Reader {
 public:
  Reader(const IniFile& file, std::string name) : file_(file) {
    out_.name = std::move(name);
    out_.remarks = file.remarks();
  }

  EdsFile read() {
    std::vector<SectionName> names;
    names.reserve(file_.sections().size());
    for (const auto& section : file_.sections()) names.push_back(parse_section_name(section.name));
    pile_.expect(
        static_cast<std::size_t>(std::ranges::count(names, SectionKind::object, &SectionName::kind)));
    auto next_name = names.begin();
    for (const auto& section : file_.sections()) {
      const auto& name = *next_name++;
      // Of a section that is there twice the first counts; the others have been remarked.
      if (section.repeated) continue;
      if (name.odd_form) out_.remarks.add(Deviation::section_name_form, section.at, section.name);
      take(section, name);
    }
    out_.objects = pile_.finish(out_.remarks);
    for (auto& [number, module] : modules_) {
      module.fixed_objects = fixed_[number].finish(out_.remarks);
      out_.modules.push_back(std::move(module));
    }
    out_.format = is_dcf() ? Format::dcf : Format::eds;
    return std::move(out_);
  }

 private:
  void take(const IniSection& section, const SectionName& name) {
    Taker taker(section, out_.remarks);
    switch (name.kind) {
      case SectionKind::unknown:
        if (!section.name.empty()) out_.remarks.add(Deviation::unknown_section, section.at, section.name);
        return;
      case SectionKind::dynamic_channels:
        out_.dynamic_channels = section.at;
        not_modelled(taker, section);
        break;
      case SectionKind::tools:
      case SectionKind::module_comments: not_modelled(taker, section); break;
      case SectionKind::file_info: info(taker, section, out_.file_info, file_info_fields); break;
      case SectionKind::device_info:
        info(taker, section, out_.device_info, device_info_fields);
        taker.numbers("BaudRate_", out_.device_info.baud_rates);
        taker.reserved(reserved_device_info);
        break;
      case SectionKind::commissioning: commissioning(taker, section); break;
      case SectionKind::dummy_usage:
        out_.dummy_usage.at = section.at;
        out_.dummy_usage.present = true;
        taker.numbers("Dummy", out_.dummy_usage.entries, 16);
        break;
      case SectionKind::mandatory_objects:
        list(taker, section, out_.mandatory_objects, "SupportedObjects");
        break;
      case SectionKind::optional_objects:
        list(taker, section, out_.optional_objects, "SupportedObjects");
        break;
      case SectionKind::manufacturer_objects:
        list(taker, section, out_.manufacturer_objects, "SupportedObjects");
        break;
      case SectionKind::comments: list(taker, section, out_.comments, "Lines", "Line"); break;
      case SectionKind::supported_modules: list(taker, section, out_.supported_modules, "NrOfEntries"); break;
      case SectionKind::connected_modules: list(taker, section, out_.connected_modules, "NrOfEntries"); break;
      case SectionKind::names:
        list(taker, section, pile_.object(name.index, section.at).lists.edit().names, "NrOfEntries");
        break;
      case SectionKind::values:
        list(taker, section, pile_.object(name.index, section.at).lists.edit().values, "NrOfEntries");
        break;
      case SectionKind::denotations:
        list(taker, section, pile_.object(name.index, section.at).lists.edit().denotations, "NrOfEntries");
        break;
      case SectionKind::links:
        list(taker, section, pile_.object(name.index, section.at).lists.edit().links, "ObjectLinks");
        break;
      case SectionKind::object:
      case SectionKind::sub_object: object(taker, section, name, pile_); break;
      default: module(taker, section, name); break;
    }
    taker.finish();
  }

  template <typename Info, std::size_t count>
  static void info(Taker& taker, const IniSection& section, Info& into,
                   const std::array<FieldRow<Info>, count>& rows) {
    into.at = section.at;
    into.present = true;
    taker.fields(into, std::span<const FieldRow<Info>>(rows));
  }

  static void list(Taker& taker, const IniSection& section, NumberedList& into, std::string_view count,
                   std::string_view prefix = {}) {
    into.name = shortened(section.name);
    into.at = section.at;
    into.present = true;
    taker.field(count, into.count);
    taker.numbers(prefix, into.entries);
  }

  void not_modelled(Taker& taker, const IniSection& section) {
    taker.rest_is_known();
    out_.unmodelled.push_back({"[" + shortened(section.name) + "]", section.at});
  }

  void commissioning(Taker& taker, const IniSection& section) {
    if (out_.commissioning.present)
      out_.remarks.add(Deviation::two_commissionings, section.at, section.name, out_.commissioning.at);
    // The standard writes one m, so what is right English is the deviation here.
    if (same_word(section.name, "DeviceCommissioning"))
      out_.remarks.add(Deviation::commissioning_spelling, section.at, section.name);
    const auto first = out_.commissioning.at;
    info(taker, section, out_.commissioning, commissioning_fields);
    if (first.known()) out_.commissioning.at = first;
  }

  void object(Taker& taker, const IniSection& section, const SectionName& name, Pile& pile) {
    auto& object = pile.object(name.index, section.at);
    const bool is_sub = name.kind == SectionKind::sub_object || name.kind == SectionKind::fixed_sub_object;
    // Written in two ways ([1018sub1] and [1018sub01]) they are still one; what came first counts.
    auto& entry = is_sub ? Pile::sub_entry(object, name.sub) : object.entry;
    if (is_sub ? entry.at.known() : object.described)
      out_.remarks.add(Deviation::duplicate_section, section.at, section.name, entry.at);
    else
      entry.at = section.at;
    taker.fields(entry, std::span<const FieldRow<Entry>>(entry_fields));
    if (is_sub) return;
    object.described = true;
    taker.fields(object, std::span<const FieldRow<Object>>(object_fields));
  }

  void module(Taker& taker, const IniSection& section, const SectionName& name) {
    auto& into = modules_[name.module];
    into.number = name.module;
    if (!into.at.known()) into.at = section.at;
    switch (name.kind) {
      case SectionKind::module_info:
        into.has_info = true;
        into.at = section.at;
        taker.fields(into, std::span<const FieldRow<Module>>(module_fields));
        break;
      case SectionKind::fixed_list: list(taker, section, into.fixed_list, "NrOfEntries"); break;
      case SectionKind::extension_list: list(taker, section, into.extension_list, "NrOfEntries"); break;
      case SectionKind::extension: {
        SubExtension extension;
        extension.index = name.index;
        extension.entry.at = section.at;
        taker.fields(extension.entry, std::span<const FieldRow<Entry>>(entry_fields));
        taker.field("Count", extension.count);
        taker.field("ObjExtend", extension.obj_extend);
        into.extensions.push_back(std::move(extension));
        break;
      }
      default: object(taker, section, name, fixed_[name.module]); break;
    }
  }

  /// A DCF is an EDS with more in it; the extension of the file's name says little.
  [[nodiscard]] bool is_dcf() const {
    const auto configured = [](const Entry& entry) {
      return !entry.parameter_value.empty() || !entry.upload_file.empty() || !entry.download_file.empty() ||
             !entry.denotation.empty();
    };
    return out_.commissioning.present || out_.connected_modules.present || !out_.file_info.last_eds.empty() ||
           std::ranges::any_of(out_.objects, [&](const Object& object) {
             return object.lists->values.present || object.lists->denotations.present ||
                    configured(object.entry) ||
                    std::ranges::any_of(object.subs, [&](const auto& sub) { return configured(sub.entry); });
           });
  }

  const IniFile& file_;
  EdsFile out_;
  Pile pile_;
  std::map<std::uint64_t, Module> modules_;
  std::map<std::uint64_t, Pile> fixed_;
};

}  // namespace

EdsFile read_ini(const IniFile& file, std::string file_name) {
  return Reader(file, std::move(file_name)).read();
}

}  // namespace conform::eds
