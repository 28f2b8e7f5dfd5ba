// SPDX-License-Identifier: Apache-2.0
// Numbers: how they are written, and those whose range the standard fixes.
#include <fmt/format.h>

#include "base/text.hpp"
#include "eds/lint_numbers.hpp"
#include "eds/lint_rules.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view numbers = "CiA 306, numbers";
constexpr std::string_view formulas = "CiA 306, $NODEID";

constexpr Rule no_number{"EDS050", Severity::error, "A number is expected and something else is there",
                         numbers};
constexpr Rule bad_octal{"EDS051", Severity::error,
                         "A number begins with 0, so it is octal, but has a digit 8 or 9", numbers};
constexpr Rule octal{"EDS052", Severity::warning,
                     "A number begins with 0, so it is octal and not what it seems", numbers};
constexpr Rule leading_zero{"EDS053", Severity::note,
                            "A number begins with 0; octal or decimal, the value is the same", numbers};
constexpr Rule trailing_h{"EDS054", Severity::error, "A hexadecimal number ends in h", numbers};
constexpr Rule c_suffix{"EDS055", Severity::error, "A number ends in a suffix of C (U, L, LL)", numbers};
constexpr Rule negative_hex{"EDS056", Severity::warning, "A hexadecimal number has a minus sign", numbers};
constexpr Rule too_large{"EDS057", Severity::error, "A number does not fit into 64 bits", numbers};
constexpr Rule node_id_not_first{"EDS058", Severity::warning, "$NODEID is not the first word of a formula",
                                 formulas};
constexpr Rule formula_blanks{"EDS059", Severity::note, "A formula holds blanks", formulas};
constexpr Rule node_id_case{"EDS060", Severity::note, "$NODEID is not in capitals", formulas};
constexpr Rule inline_comment{"EDS061", Severity::error, "A comment follows a value in the same line",
                              "CiA 306, syntax"};
constexpr Rule plus_sign{"EDS062", Severity::warning, "A number has a plus sign", numbers};
constexpr Rule out_of_range{"EDS063", Severity::error, "A number is outside the range of its entry", numbers};
constexpr Rule formula_here{"EDS064", Severity::error, "A formula stands where only a number may stand",
                            formulas};

constexpr const Rule* all[] = {&no_number,         &bad_octal,      &octal,        &leading_zero,
                               &trailing_h,        &c_suffix,       &negative_hex, &too_large,
                               &node_id_not_first, &formula_blanks, &node_id_case, &inline_comment,
                               &plus_sign,         &out_of_range,   &formula_here};

struct Odd {
  bool Oddities::* flag;
  const Rule* rule;
  std::string_view message;
  std::string_view hint;
};

constexpr Odd oddities[] = {
    {&Oddities::octal, &octal, "{}: by the standard '{}' is octal", "write it without leading zeros"},
    {&Oddities::leading_zero, &leading_zero, "{}: by the standard '{}' is octal", {}},
    {&Oddities::trailing_h, &trailing_h, "{}: '{}' is no number", "write 0x before it"},
    {&Oddities::c_suffix, &c_suffix, "{}: '{}' has a suffix", "write the number alone"},
    {&Oddities::negative_hex, &negative_hex, "{}: '{}' has both a sign and 0x", "write it in decimal"},
    {&Oddities::node_id_not_first, &node_id_not_first, "{}: '{}' is a formula only when $NODEID comes first",
     "write $NODEID+number"},
    {&Oddities::formula_blanks, &formula_blanks, "{}: '{}' holds blanks", {}},
    {&Oddities::node_id_case, &node_id_case, "{}: '{}' spells $NODEID differently", {}},
    {&Oddities::inline_comment, &inline_comment, "{}: '{}' holds more than a value",
     "put comments on a line of their own"},
    {&Oddities::plus_sign, &plus_sign, "{}: '{}' has a sign", {}},
};

/// Entries that hold a plain number, and the largest one that makes sense.
template <typename Section>
struct NumberRow {
  FieldRow<Section> row;
  std::uint64_t most;
};

constexpr std::uint64_t u32 = 0xFFFF'FFFF;
constexpr NumberRow<FileInfo> file_info[] = {{{"FileVersion", &FileInfo::file_version}, 0xFF},
                                             {{"FileRevision", &FileInfo::file_revision}, 0xFF}};
constexpr NumberRow<DeviceInfo> device_info[] = {
    {{"VendorNumber", &DeviceInfo::vendor_number}, u32},
    {{"ProductNumber", &DeviceInfo::product_number}, u32},
    {{"RevisionNumber", &DeviceInfo::revision_number}, u32},
    {{"Granularity", &DeviceInfo::granularity}, 64},
    {{"NrOfRXPDO", &DeviceInfo::nr_of_rx_pdo}, 512},
    {{"NrOfTXPDO", &DeviceInfo::nr_of_tx_pdo}, 512},
    {{"CompactPDO", &DeviceInfo::compact_pdo}, 0xFFFF},
    {{"DynamicChannelsSupported", &DeviceInfo::dynamic_channels}, u32},
};
constexpr FieldRow<DeviceInfo> device_flags[] = {
    {"SimpleBootUpMaster", &DeviceInfo::simple_boot_up_master},
    {"SimpleBootUpSlave", &DeviceInfo::simple_boot_up_slave},
    {"GroupMessaging", &DeviceInfo::group_messaging},
    {"LSS_Supported", &DeviceInfo::lss_supported},
};
constexpr std::uint64_t any = ~std::uint64_t{0};  // the range has a rule of its own
constexpr NumberRow<DeviceCommissioning> commissioning[] = {
    {{"NodeID", &DeviceCommissioning::node_id}, any},
    {{"Baudrate", &DeviceCommissioning::baudrate}, any},
    {{"NetNumber", &DeviceCommissioning::net_number}, u32},
    {{"LSS_SerialNumber", &DeviceCommissioning::lss_serial_number}, u32},
};
constexpr NumberRow<Module> modules[] = {{{"ProductVersion", &Module::product_version}, 0xFF},
                                         {{"ProductRevision", &Module::product_revision}, 0xFF}};
constexpr NumberRow<Entry> entries[] = {
    {{"ObjectType", &Entry::object_type}, 0xFF},
    {{"DataType", &Entry::data_type}, 0xFFFF},
    {{"ObjFlags", &Entry::obj_flags}, u32},
};
constexpr NumberRow<Object> objects[] = {
    {{"SubNumber", &Object::sub_number}, 0xFF},
    {{"CompactSubObj", &Object::compact_sub_obj}, 0xFF},
};

/// Nothing, or a number as the standard writes it and in its range.
bool is_plain(const Field& field, std::uint64_t most) {
  if (field.empty()) return true;
  const auto number = parse_number(field.text);
  return number && number->odd == Oddities{} && !number->node_id && !number->negative &&
         number->magnitude <= most;
}

class Check {
 public:
  Check(const Subject& subject, Findings& findings) : subject_(subject), findings_(findings) {}

  void run() {
    const auto& file = subject_.file;
    const bool xml = file.is_xml();
    // In XML the version is any text.
    if (!xml) rows(file.file_info, file_info);
    rows(file.device_info, device_info);
    for (const auto& row : device_flags) flag(row.key, file.device_info.*row.field);
    for (const auto& rate : file.device_info.baud_rates)
      flag(fmt::format("BaudRate_{}", rate.number), rate.field);
    for (const auto& dummy : file.dummy_usage.entries)
      flag(fmt::format("Dummy{:04X}", dummy.number), dummy.field);
    // In XML the bit rate has a unit.
    if (!xml) rows(file.commissioning, commissioning);
    flag("CANopenManager", file.commissioning.canopen_manager);
    for (const auto& module : file.modules) {
      rows(module, modules);
      counted(module.fixed_list);
      counted(module.extension_list);
    }
    for (const auto* list : {&file.supported_modules, &file.connected_modules}) counted(*list);
    for (const auto& object : file.objects) {
      const auto& lists = *object.lists.operator->();
      for (const auto* list : {&lists.names, &lists.values, &lists.denotations, &lists.links}) counted(*list);
    }
    number("Lines", file.comments.count, 0xFFFF);
    for (const auto* list : {&file.mandatory_objects, &file.optional_objects, &file.manufacturer_objects}) {
      number("SupportedObjects", list->count, 0xFFFF);
      for (const auto& entry : list->entries) {
        if (!is_plain(entry.field, 0xFFFF)) number(fmt::format("{}", entry.number), entry.field, 0xFFFF);
      }
    }
    each_described(subject_, [&](const Spot& spot) {
      // A dictionary has thousands of entries, nearly all of them right: a name is made only for the others.
      const auto look = [&](std::string_view key, const Field& field, std::uint64_t most) {
        if (!is_plain(field, most)) number(key, field, most, spot.name());
      };
      for (const auto& row : entries) look(row.row.key, spot.entry.*row.row.field, row.most);
      if (!xml) look("PDOMapping", spot.entry.pdo_mapping, 1);
      if (!spot.sub) {
        for (const auto& row : objects) look(row.row.key, spot.object.*row.row.field, row.most);
      }
    });
  }

 private:
  template <typename Section, std::size_t count>
  void rows(const Section& section, const NumberRow<Section> (&table)[count]) {
    for (const auto& row : table) number(row.row.key, section.*row.row.field, row.most);
  }

  void counted(const NumberedList& list) {
    if (list.present) number("count", list.count, 0xFFFF, fmt::format("[{}]", list.name));
  }

  void flag(std::string_view key, const Field& field, std::string_view where = {}) {
    if (subject_.file.is_xml() && flag_of(field)) return;
    number(key, field, 1, where);
  }

  void number(std::string_view key, const Field& field, std::uint64_t most, std::string_view where = {}) {
    if (field.empty()) return;
    const auto label = where.empty() ? std::string(key) : fmt::format("{} {}", where, key);
    const auto read = read_number(field, label, findings_);
    if (!read) return;
    if (read->node_id)
      findings_.add(formula_here, field.at,
                    fmt::format("{}: '{}' depends on the node-ID", label, shortened(field.text)));
    else if (read->negative || read->magnitude > most)
      findings_.add(out_of_range, field.at,
                    fmt::format("{}: {} is not in 0 to {}", label, shortened(field.text), most));
  }

  const Subject& subject_;
  Findings& findings_;
};

void check(const Subject& subject, Findings& findings) { Check(subject, findings).run(); }

}  // namespace

std::optional<Number> read_number(const Field& field, const std::string& label, Findings& findings) {
  const auto number = parse_number(field.text);
  const auto text = shortened(field.text);
  if (number) {
    for (const auto& odd : oddities) {
      if (number->odd.*odd.flag)
        findings.add(*odd.rule, field.at, fmt::format(fmt::runtime(odd.message), label, text),
                     std::string(odd.hint));
    }
    return *number;
  }
  switch (number.error()) {
    case NumberFault::empty: break;
    case NumberFault::not_a_number:
      findings.add(no_number, field.at, fmt::format("{}: '{}' is no number", label, text));
      break;
    case NumberFault::bad_octal:
      findings.add(bad_octal, field.at, fmt::format("{}: '{}' is no octal number", label, text),
                   "a leading 0 means octal: write it without");
      break;
    case NumberFault::too_large:
      findings.add(too_large, field.at, fmt::format("{}: {} has more than 64 bits", label, text));
      break;
  }
  return std::nullopt;
}

constinit const Group number_rules{{"Numbers", all}, check};

}  // namespace conform::eds
