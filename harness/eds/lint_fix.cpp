// SPDX-License-Identifier: Apache-2.0
#include "eds/lint_fix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "base/text.hpp"
#include "eds/lint_fix_forms.hpp"
#include "eds/lint_rules.hpp"
#include "eds/section_name.hpp"

namespace conform::eds {

/// Numbers of things that the file describes anyway.
class CountFixes {
 public:
  CountFixes(const Fixer& fixer, const Finding& finding)
      : fixer_(fixer), file_(fixer.file_), finding_(finding) {}

  [[nodiscard]] std::optional<Fix> of_list() const {
    const auto code = finding_.rule->code;
    std::optional<Fix> out;
    each_list([&](const NumberedList& list, std::string_view key) {
      if (out || !list.present) return;
      if (code == "EDS153") {
        if (holds(list)) out = numbering(list);
      } else if (is_about(list.count, list.at)) {
        out = fixer_.write(list.count, list.at, key, number_like(list.count.text, list.entries.size()));
      }
    });
    return out;
  }

  [[nodiscard]] std::optional<Fix> of_object() const {
    const auto code = finding_.rule->code;
    for (const auto& object : file_.objects) {
      const bool here = object.entry.at == finding_.at;
      const auto& number = object.sub_number;
      if (((code == "EDS252" || code == "EDS263") && number.present && number.at == finding_.at) ||
          (code == "EDS253" && here))
        return fixer_.write(number, object.entry.at, "SubNumber",
                            number_like(number.text, count_of_subs(object)));
      if (code == "EDS207" && here && has_different_elements(object))
        return fixer_.write(object.entry.object_type, object.entry.at, "ObjectType", "0x9");
      const auto* zero = object.find(SubIndex(0));
      const auto highest = highest_sub(object);
      if (zero == nullptr || highest == 0) continue;
      if (code == "EDS256" && zero->at == finding_.at)
        return fixer_.write(zero->default_value, zero->at, "DefaultValue", std::to_string(highest));
      if (code != "EDS254") continue;
      // In a DCF a configured value may be what counts.
      for (const auto& [key, field] : {std::pair("DefaultValue", &zero->default_value),
                                       std::pair("ParameterValue", &zero->parameter_value)}) {
        if (field->present && field->at == finding_.at)
          return fixer_.write(*field, zero->at, key, number_like(field->text, highest));
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Fix> of_pdos() const {
    const auto& info = file_.device_info;
    // What is implied is not counted here.
    if (number_of(info.compact_pdo).value_or(0) > 0) return std::nullopt;
    const bool receive = finding_.rule->code == "EDS300";
    const auto first = receive ? 0x1400U : 0x1800U;
    const auto count = std::ranges::count_if(
        file_.objects, [first](const Object& object) { return between(object.index, first, first + 0x1FF); });
    return fixer_.write(receive ? info.nr_of_rx_pdo : info.nr_of_tx_pdo, info.at,
                        receive ? "NrOfRXPDO" : "NrOfTXPDO", std::to_string(count));
  }

 private:
  void each_list(const auto& look) const {
    const auto code = finding_.rule->code;
    if (code == "EDS152" || code == "EDS153") {
      for (const auto* list :
           {&file_.mandatory_objects, &file_.optional_objects, &file_.manufacturer_objects})
        look(*list, "SupportedObjects");
    }
    if (code == "EDS112" || code == "EDS120") look(file_.comments, "Lines");
    if (code == "EDS160") {
      for (const auto& object : file_.objects) look(object.lists->links, "ObjectLinks");
    }
    if (code == "EDS275") {
      for (const auto& object : file_.objects) {
        for (const auto* list : {&object.lists->names, &object.lists->values, &object.lists->denotations})
          look(*list, "NrOfEntries");
      }
    }
    if (code == "EDS425") {
      for (const auto& module : file_.modules) {
        look(module.fixed_list, "NrOfEntries");
        look(module.extension_list, "NrOfEntries");
      }
    }
  }

  [[nodiscard]] bool is_about(const Field& field, Position section) const {
    return finding_.at == place_of(field, section);
  }

  [[nodiscard]] bool holds(const NumberedList& list) const {
    return std::ranges::any_of(list.entries,
                               [this](const auto& entry) { return entry.field.key_at == finding_.at; });
  }

  [[nodiscard]] std::optional<Fix> numbering(const NumberedList& list) const {
    Fix out{fmt::format("number the entries of [{}] in a row", list.name), {}};
    std::size_t number = 0;
    for (const auto& entry : list.entries) {
      ++number;
      const auto key = fixer_.value_at(entry.field.key_at);
      const auto digits = std::min(key.find_first_not_of("0123456789"), key.size());
      const auto offset = fixer_.lines_.offset(entry.field.key_at);
      if (!offset || digits == 0) return std::nullopt;
      if (entry.number != number) out.edits.push_back({*offset, digits, std::to_string(number)});
    }
    return out;
  }

  static std::size_t count_of_subs(const Object& object) {
    return static_cast<std::size_t>(
        std::ranges::count_if(object.subs, [](const auto& sub) { return sub.sub != SubIndex(0xFF); }));
  }

  static std::size_t highest_sub(const Object& object) {
    auto highest = number_of(object.compact_sub_obj).value_or(0);
    for (const auto& sub : object.subs) {
      if (sub.sub != SubIndex(0xFF)) highest = std::max<std::uint64_t>(highest, sub.sub.value());
    }
    return static_cast<std::size_t>(highest);
  }

  /// Then it is a record; with equal ones it could be either.
  static bool has_different_elements(const Object& object) {
    std::set<std::uint16_t> types;
    for (const auto& sub : object.subs) {
      if (const auto type = data_type(sub.entry); type && sub.sub != SubIndex(0)) types.insert(*type);
    }
    return types.size() > 1;
  }

  const Fixer& fixer_;
  const EdsFile& file_;
  const Finding& finding_;
};

Fixer::Fixer(std::string_view bytes, const EdsFile& file) : bytes_(bytes), file_(file), lines_(bytes) {}

std::string_view Fixer::value_at(Position at) const {
  const auto line = lines_.line(at.line);
  if (file_.is_xml()) {
    if (at.column < 2 || at.column > line.size()) return {};
    const char quote = line[at.column - 2];
    if (quote != '"' && quote != '\'') return {};
    const auto rest = line.substr(at.column - 1);
    return rest.substr(0, rest.find(quote));
  }
  return at.column == 0 || at.column - 1 > line.size() ? std::string_view()
                                                       : trim(line.substr(at.column - 1));
}

std::optional<Fix> Fixer::replace(Position at, std::size_t length, std::string text, std::string what) const {
  const auto offset = lines_.offset(at);
  if (!offset || bytes_.substr(*offset, length) == text) return std::nullopt;
  return Fix{std::move(what), {{*offset, length, std::move(text)}}};
}

std::optional<Fix> Fixer::write(const Field& field, Position section, std::string_view key,
                                const std::string& value) const {
  auto what = fmt::format("write {}={}", key, value);
  // In XML only the values of attributes that are there are rewritten.
  if (file_.is_xml() && (!field.present || value_at(field.at) != field.text)) return std::nullopt;
  if (field.present) return replace(field.at, field.text.size(), value, std::move(what));
  if (!section.known()) return std::nullopt;
  const auto end = lines_.line_end();
  const auto next = lines_.start(section.line + 1);
  const bool last = next == bytes_.size() && !bytes_.ends_with('\n') && !bytes_.ends_with('\r');
  return Fix{
      std::move(what),
      {{next, 0, last ? fmt::format("{}{}={}", end, key, value) : fmt::format("{}={}{}", key, value, end)}}};
}

std::optional<Fix> Fixer::spelling(const Finding& finding) const {
  const auto value = value_at(finding.at);
  const auto code = finding.rule->code;
  std::optional<std::string> text;
  if (code == "EDS105")
    text = standard_date(value);
  else if (code == "EDS106")
    text = standard_time(value);
  else if (code == "EDS058" || code == "EDS059" || code == "EDS060")
    text = standard_formula(value);
  else
    text = standard_number(value);
  if (!text) return std::nullopt;
  return replace(finding.at, value.size(), *text, fmt::format("write {}", *text));
}

std::optional<Fix> Fixer::section_form(const Finding& finding) const {
  const auto text = value_at(finding.at);
  const auto close = text.find(']');
  if (!text.starts_with('[') || close == std::string_view::npos) return std::nullopt;
  const auto name = parse_section_name(text.substr(1, close - 1));
  if (name.kind != SectionKind::object && name.kind != SectionKind::sub_object) return std::nullopt;
  const auto standard = section_name(
      name.index, name.kind == SectionKind::sub_object ? std::optional<SubIndex>(name.sub) : std::nullopt);
  // Written twice, in two forms, it has to be decided which one is right.
  const auto ini = IniFile::parse(bytes_, file_.name);
  if (!ini || ini->find(standard.substr(1, standard.size() - 2)) != nullptr) return std::nullopt;
  return replace(finding.at, close + 1, standard, fmt::format("write {}", standard));
}

std::optional<Fix> Fixer::absent_list(const Finding& finding) const {
  const bool optional = !file_.optional_objects.present;
  const bool manufacturer = !file_.manufacturer_objects.present;
  const std::string_view name = optional && finding.message.ends_with("[OptionalObjects]") ? "OptionalObjects"
                                : manufacturer && finding.message.ends_with("[ManufacturerObjects]")
                                    ? "ManufacturerObjects"
                                    : "";
  if (name.empty()) return std::nullopt;
  for (const auto& object : file_.objects) {
    const bool is_manufacturer = between(object.index, 0x2000, 0x5FFF);
    const bool is_mandatory =
        object.index == Index(0x1000) || object.index == Index(0x1001) || object.index == Index(0x1018);
    // It would have to be listed, and is not.
    if (name == "ManufacturerObjects" ? is_manufacturer
                                      : !is_manufacturer && !is_mandatory && object.index.value() >= 0x1000)
      return std::nullopt;
  }
  const auto end = lines_.line_end();
  // Behind the end-of-file mark of DOS nothing is read.
  auto text = bytes_;
  if (const auto last = text.find_last_not_of("\r\n"); last != std::string_view::npos && text[last] == '\x1A')
    text = text.substr(0, last);
  const bool open = !text.ends_with('\n') && !text.ends_with('\r');
  return Fix{
      fmt::format("add an empty [{}]", name),
      {{text.size(), 0, fmt::format("{0}{1}[{2}]{1}SupportedObjects=0{1}", open ? end : "", end, name)}}};
}

std::optional<Fix> Fixer::fix(const Finding& finding) const {
  const auto code = finding.rule->code;
  const auto is_one_of = [code](std::initializer_list<std::string_view> codes) {
    return std::ranges::find(codes, code) != codes.end();
  };
  const CountFixes counts(*this, finding);
  if (is_one_of({"EDS112", "EDS120", "EDS152", "EDS153", "EDS160", "EDS275", "EDS425"}))
    return counts.of_list();
  if (is_one_of({"EDS207", "EDS252", "EDS253", "EDS254", "EDS256", "EDS263"})) return counts.of_object();
  if (is_one_of({"EDS300", "EDS301"})) return counts.of_pdos();
  if (is_one_of({"EDS054", "EDS055", "EDS058", "EDS059", "EDS060", "EDS062"})) return spelling(finding);
  if (file_.is_xml()) return std::nullopt;
  if (is_one_of({"EDS105", "EDS106"})) return spelling(finding);
  const auto before = [&] { return Position{finding.at.line, 1}; };
  if (code == "EDS009" && value_at(finding.at).starts_with('#'))
    return replace(finding.at, 1, ";", "begin the comment with ;");
  if (is_one_of({"EDS003", "EDS010"}))
    return replace(before(), finding.at.column - 1, "", "remove the blanks before it");
  if (code == "EDS017") return Fix{"remove the byte order mark", {{0, 3, ""}}};
  if (code == "EDS018") return section_form(finding);
  const auto& info = file_.file_info;
  if (code == "EDS103" && info.eds_version.empty())
    return write(info.eds_version, info.at, "EDSVersion", "4.0");
  if (code == "EDS108" && finding.message.starts_with("FileName "))
    return write(info.file_name, info.at, "FileName", file_.name.substr(file_.name.find_last_of("/\\") + 1));
  return code == "EDS151" ? absent_list(finding) : std::nullopt;
}

std::string with_fixes(std::string_view bytes, const std::vector<Fix>& fixes) {
  std::vector<const TextEdit*> edits;
  std::map<std::size_t, std::size_t> taken;  // from where to where; of two at one place the first counts
  const auto free = [&taken](const TextEdit& edit) {
    const auto next = taken.upper_bound(edit.offset + edit.length);
    return next == taken.begin() || std::prev(next)->second < edit.offset;
  };
  for (const auto& fix : fixes) {
    if (!std::ranges::all_of(fix.edits, free)) continue;
    for (const auto& edit : fix.edits) {
      edits.push_back(&edit);
      taken.emplace(edit.offset, edit.offset + edit.length);
    }
  }
  std::ranges::sort(edits, {}, &TextEdit::offset);
  std::string out;
  std::size_t at = 0;
  for (const auto* edit : edits) {
    out += bytes.substr(at, edit->offset - at);
    out += edit->text;
    at = edit->offset + edit->length;
  }
  return out.append(bytes.substr(at));
}

}  // namespace conform::eds
