// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/eds_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "cli/descriptions/eds_words.hpp"
#include "eds/type_table.hpp"
#include "reports/html/document.hpp"
#include "reports/html/markup.hpp"
#include "reports/text_tools.hpp"

namespace conform::cli {
namespace {

using namespace reports::html;
using eds::Entry;
using eds::Field;
using eds::Finding;
using eds::Severity;

constexpr std::size_t widest = 120;  // of a name or a value

/// The shape that a severity borrows from a verdict.
std::string_view kind_of(Severity severity) {
  return severity == Severity::error ? "fail" : severity == Severity::warning ? "warn" : "na";
}

std::string value_of(const Field& field) {
  return field.empty() ? std::string() : fmt::format("<code>{}</code>", clipped(field.text, widest));
}

std::string item(const Finding& finding) {
  std::string out = fmt::format("<li>{} <b>{}</b> {}",
                                badge(kind_of(finding.rule->severity), to_string(finding.rule->severity)),
                                finding.rule->code, clipped(finding.message, 300));
  if (!finding.hint.empty()) out += "; " + clipped(finding.hint, 300);
  return out + fmt::format(" <span class=\"quiet\">line {}</span></li>\n", finding.at.line);
}

class Page {
 public:
  Page(const eds::EdsFile& file, const std::vector<eds::Object>& objects, const eds::LintReport& report)
      : file_(file), objects_(objects), report_(report) {
    sections();
    for (const auto& finding : report.findings) findings_[owner_of(finding.at)].push_back(&finding);
  }

  std::string html() {
    const auto name = clipped(name_of_file(), widest);
    Document page;
    page.title = fmt::format("{} - device description", name);
    page.brand = "CANopen device description";
    page.generator = "canopen-conform " CONFORM_VERSION;
    page.footer = fmt::format("Made from {} by canopen-conform {}.", name, CONFORM_VERSION);
    const auto dictionary =
        section("dictionary", "Object dictionary", dictionary_table(), {"entry", "entries"});
    page.filter = {"the object dictionary", "entries", "object, name, type, value", choices()};
    page.parts = {{"device", "Device", section("device", name, facts())},
                  {"file-findings", "Findings about the file",
                   section("file-findings", "Findings about the file", file_findings())},
                  {"pdos", "PDOs", section("pdos", "PDOs", pdos())},
                  {"dictionary", "Dictionary", dictionary}};
    return document(page);
  }

 private:
  /// An entry that a finding can stand beside; nullopt: the file.
  using Owner = std::optional<Multiplexer>;

  [[nodiscard]] std::string name_of_file() const {
    return file_.name.substr(file_.name.find_last_of('/') + 1);
  }

  void sections() {
    const auto other = [this](eds::Position at) {
      if (at.known()) owners_.emplace(at, std::nullopt);
    };
    other(file_.file_info.at);
    other(file_.device_info.at);
    other(file_.commissioning.at);
    for (const auto* list : {&file_.dummy_usage, &file_.mandatory_objects, &file_.optional_objects,
                             &file_.manufacturer_objects, &file_.comments, &file_.supported_modules})
      other(list->at);
    for (const auto& module : file_.modules) other(module.at);
    for (const auto& remark : file_.remarks.all()) {
      if (remark.what == eds::Deviation::unknown_section) other(remark.at);
    }
    for (const auto& object : file_.objects) {
      if (object.described) owners_.insert_or_assign(object.entry.at, Multiplexer{object.index, SubIndex(0)});
      for (const auto& sub : object.subs)
        owners_.insert_or_assign(sub.entry.at, Multiplexer{object.index, sub.sub});
    }
  }

  /// The section, or element, that the place stands in.
  [[nodiscard]] Owner owner_of(eds::Position at) const {
    const auto next = owners_.upper_bound(at);
    return next == owners_.begin() ? Owner() : std::prev(next)->second;
  }

  [[nodiscard]] std::vector<Choice> choices() const {
    std::array<std::size_t, 3> counts{};
    for (const auto& [severity, count] : rows_) counts[static_cast<std::size_t>(severity)] = count;
    return {{"error", "fail", "error", counts[2]},
            {"warning", "warn", "warning", counts[1]},
            {"note", "na", "note", counts[0]}};
  }

  [[nodiscard]] std::string facts() const {
    const auto& info = file_.device_info;
    const auto named = [](const Field& name, const Field& number) {
      return clipped(name.text, widest) + (number.empty() ? "" : " " + value_of(number));
    };
    std::string rates;
    for (const auto& rate : info.baud_rates) {
      if (eds::flag_of(rate.field) == true)
        rates += (rates.empty() ? "" : ", ") + std::to_string(rate.number);
    }
    const auto number = [](const Field& field) { return eds::number_of(field).value_or(0); };
    std::string out = fact("Kind", to_string(file_.format));
    out += fact("Description", clipped(file_.file_info.description.text, 300));
    out += fact("Vendor", named(info.vendor_name, info.vendor_number));
    out += fact("Product", named(info.product_name, info.product_number));
    out += fact("Revision", value_of(info.revision_number));
    out += fact("Order code", clipped(info.order_code.text, widest));
    out += fact("Bit rates", rates.empty() ? "" : rates + " kbit/s");
    out += fact("PDOs",
                fmt::format("{}, {}, granularity {}", reports::counted(number(info.nr_of_rx_pdo), "RPDO"),
                            reports::counted(number(info.nr_of_tx_pdo), "TPDO"), number(info.granularity)));
    out += fact("LSS", eds::flag_of(info.lss_supported) == true ? "supported" : "");
    if (file_.commissioning.present)
      out += fact("Node", fmt::format("{} at {} kbit/s", value_of(file_.commissioning.node_id),
                                      value_of(file_.commissioning.baudrate)));
    out += fact("File", fmt::format("version {}, made {} by {}", value_of(file_.file_info.file_version),
                                    value_of(file_.file_info.creation_date),
                                    clipped(file_.file_info.created_by.text, widest)));
    std::string found;
    for (const auto severity : {Severity::error, Severity::warning, Severity::note}) {
      const auto count = report_.count(severity);
      found +=
          badge(count == 0 ? "na" : kind_of(severity), reports::counted(count, to_string(severity))) + " ";
    }
    return fmt::format("<dl class=\"facts\">\n{}{}</dl>\n", out, fact("Findings", found));
  }

  [[nodiscard]] std::string list_of(const Owner& owner) const {
    const auto found = findings_.find(owner);
    if (found == findings_.end()) return {};
    std::string out;
    for (const auto* finding : found->second) out += item(*finding);
    return "<ul class=\"list\">\n" + out + "</ul>\n";
  }

  [[nodiscard]] std::string file_findings() const {
    auto out = list_of(std::nullopt);
    if (report_.left_out > 0)
      out += fmt::format("<p class=\"quiet\">{} more not shown</p>\n", report_.left_out);
    return out;
  }

  // ---- PDOs

  [[nodiscard]] const Entry* entry(std::uint16_t index, std::uint8_t sub) const {
    const auto* object = eds::find_object(objects_, Index(index));
    if (object == nullptr) return nullptr;
    if (const auto* found = object->find(SubIndex(sub))) return found;
    return sub == 0 && !eds::is_structured(*object) ? &object->entry : nullptr;
  }
  /// What it is at power-on; an empty field when there is no such entry.
  [[nodiscard]] const Field& effective(std::uint16_t index, std::uint8_t sub) const {
    static const Field none;
    const auto* found = entry(index, sub);
    if (found == nullptr) return none;
    return found->parameter_value.empty() ? found->default_value : found->parameter_value;
  }

  /// "6000h:01 Read inputs, 8 bit"
  [[nodiscard]] std::string mapped(std::uint64_t value) const {
    const auto index = static_cast<std::uint16_t>(value >> 16U);
    const auto sub = static_cast<std::uint8_t>(value >> 8U);
    const auto bits = value & 0xFFU;
    const auto place = to_string(Multiplexer{Index(index), SubIndex(sub)});
    const auto* object = entry(index, sub);
    const auto* dummy = index < 0x20 ? eds::find_type(index) : nullptr;
    std::string name = object != nullptr  ? clipped(object->parameter_name.text, widest)
                       : dummy != nullptr ? fmt::format("dummy {}", dummy->name)
                                          : "<span class=\"quiet\">not described</span>";
    const auto shown = object != nullptr ? link(anchor({Index(index), SubIndex(sub)}), place) : place;
    return fmt::format("<li>{} {}, {} bit</li>\n", shown, name, bits);
  }

  [[nodiscard]] std::string mapping(std::uint16_t index) const {
    const auto count = eds::number_of(effective(index, 0));
    std::string out;
    for (unsigned sub = 1; sub <= std::min<std::uint64_t>(count.value_or(0), 64); ++sub) {
      const auto& field = effective(index, static_cast<std::uint8_t>(sub));
      if (const auto value = eds::number_of(field); value && *value <= 0xFFFFFFFFU) out += mapped(*value);
    }
    return out.empty() ? "<span class=\"quiet\">nothing by default</span>"
                       : "<ul class=\"list\">\n" + out + "</ul>\n";
  }

  [[nodiscard]] std::string pdos() const {
    std::string rows;
    for (const auto& object : objects_) {
      const auto index = object.index.value();
      const bool rpdo = index >= 0x1400 && index <= 0x15FF;
      if (!rpdo && !(index >= 0x1800 && index <= 0x19FF)) continue;
      rows += fmt::format("<tr><th scope=\"row\">{} {}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                          rpdo ? "RPDO" : "TPDO", index - (rpdo ? 0x1400 : 0x1800) + 1,
                          value_of(effective(index, 1)), value_of(effective(index, 2)),
                          mapping(static_cast<std::uint16_t>(index + 0x200)));
    }
    if (rows.empty()) return {};
    return table("PDOs", "pairs", {{"PDO"}, {"COB-ID"}, {"transmission type"}, {"mapped by default"}}, rows);
  }

  // ---- the dictionary

  static std::string anchor(Multiplexer mux) {
    return fmt::format("o-{:04X}-{:02X}", mux.index.value(), mux.sub.value());
  }

  void row(std::string& out, std::string_view place, const std::string& id, const Entry& entry,
           std::string_view type, const std::string& found, Severity worst, bool has_finding) {
    if (has_finding) ++rows_[worst];
    std::string limits;
    if (!entry.low_limit.empty() || !entry.high_limit.empty())
      limits = value_of(entry.low_limit) + " to " + value_of(entry.high_limit);
    auto value = value_of(entry.default_value);
    if (!entry.parameter_value.empty())
      value = value_of(entry.parameter_value) + "<br/><span class=\"quiet\">configured</span>";
    const auto mapping = mapping_words(entry);
    out += fmt::format(
        "<tr id=\"{}\" data-v=\"{}\"><th scope=\"row\"><b>{}</b><br/>{}</th><td>{}</td><td>{}{}</td><td>{}</td>"
        "<td>{}</td><td>{}</td></tr>\n",
        id, has_finding ? to_string(worst) : "none", place, clipped(entry.parameter_name.text, widest),
        text(type), text(without(entry.access_type)),
        mapping.empty() ? "" : fmt::format("<br/><span class=\"quiet\">PDO: {}</span>", mapping), value,
        limits, found);
  }
  static std::string without(const Field& field) { return eds::shortened(field.text, widest); }

  [[nodiscard]] std::pair<Severity, bool> worst(const Owner& owner) const {
    const auto found = findings_.find(owner);
    if (found == findings_.end()) return {Severity::note, false};
    auto out = Severity::note;
    for (const auto* finding : found->second) out = std::max(out, finding->rule->severity);
    return {out, true};
  }

  std::string dictionary_table() {
    std::string rows;
    for (const auto& object : objects_) {
      const bool structured = eds::is_structured(object);
      const Multiplexer first{object.index, SubIndex(0)};
      // Of a structure sub-index 00h has a row of its own; the findings of both stand there if it is
      // described.
      const bool own_zero = structured && object.find(SubIndex(0)) != nullptr;
      const auto head = own_zero ? std::pair{Severity::note, false} : worst(first);
      row(rows, to_string(object.index),
          own_zero ? fmt::format("o-{:04X}", object.index.value()) : anchor(first), object.entry,
          structured ? std::string(structure_words(object)) : type_words(object.entry),
          own_zero ? "" : list_of(first), head.first, head.second);
      for (const auto& sub : object.subs) {
        const Multiplexer mux{object.index, sub.sub};
        const auto [severity, found] = worst(mux);
        row(rows, to_string(mux), anchor(mux), sub.entry, type_words(sub.entry), list_of(mux), severity,
            found);
      }
    }
    return table("Object dictionary", "entries",
                 {{"object"}, {"type"}, {"access"}, {"default"}, {"limits"}, {"findings"}}, rows);
  }

  const eds::EdsFile& file_;
  const std::vector<eds::Object>& objects_;
  const eds::LintReport& report_;
  std::map<eds::Position, Owner> owners_;
  std::map<Owner, std::vector<const Finding*>> findings_;
  std::map<Severity, std::size_t> rows_;  ///< entries by their worst finding
};

}  // namespace

std::string eds_page(const eds::EdsFile& file, const std::vector<eds::Object>& objects,
                     const eds::LintReport& report) {
  return Page(file, objects, report).html();
}

}  // namespace conform::cli
