// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/new_description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace conform::cli {
namespace {

using eds::Entry;
using eds::Field;
using eds::Object;

constexpr unsigned cia401 = 401;
constexpr unsigned cia402 = 402;
constexpr unsigned predefined_pdos = 4;  ///< CiA 301, 7.3.5: for these the connection set has COB-IDs

Field said(std::string text) { return {std::move(text), {}, {}, true}; }

struct Mapped {
  unsigned first_index;  ///< of the array
  const char* name;      ///< of the array
  const char* element;
  const char* access;
  unsigned data_type, bits;
};
constexpr Mapped inputs{0x2000, "Inputs", "Input", "ro", 0x07, 32};
constexpr Mapped outputs{0x2100, "Outputs", "Output", "rww", 0x07, 32};
/// CiA 401: eight lines each.
constexpr Mapped digital_inputs{0x6000, "Read input 8-bit", "Read inputs", "ro", 0x05, 8};
constexpr Mapped digital_outputs{0x6200, "Write output 8-bit", "Write outputs", "rww", 0x05, 8};

struct DriveObject {
  unsigned index;
  const char* name;
  unsigned data_type;
  const char* access;  ///< ro, or rw: rww where an RPDO could hold it
  const char* value;
  bool mappable = true;
};
/// CiA 402-2: a servo drive with profile position and profile velocity mode (6502h, bits 0 and 2).
constexpr DriveObject drive[] = {
    {0x6040, "Controlword", 0x06, "rw", "0"},
    {0x6041, "Statusword", 0x06, "ro", ""},
    {0x6060, "Modes of operation", 0x02, "rw", "0"},
    {0x6061, "Modes of operation display", 0x02, "ro", ""},
    {0x6064, "Position actual value", 0x04, "ro", ""},
    {0x606C, "Velocity actual value", 0x04, "ro", ""},
    {0x607A, "Target position", 0x04, "rw", "0"},
    {0x6081, "Profile velocity", 0x07, "rw", "0"},
    {0x6083, "Profile acceleration", 0x07, "rw", "0"},
    {0x6086, "Motion profile type", 0x03, "rw", "0"},
    {0x60FF, "Target velocity", 0x04, "rw", "0"},
    {0x6502, "Supported drive modes", 0x07, "ro", "0x00000005", false},
};
/// CiA 402-3: the PDOs of a drive hold the control- or statusword, and from the second one on that.
constexpr unsigned beside_controlword[] = {0x60600008, 0x607A0020, 0x60FF0020};
constexpr unsigned beside_statusword[] = {0x60610008, 0x60640020, 0x606C0020};

Entry entry(std::string name, unsigned data_type, const char* access, std::string value,
            bool mappable = false) {
  Entry out;
  out.parameter_name = said(std::move(name));
  out.object_type = said("0x7");
  out.data_type = said(fmt::format("0x{:04X}", data_type));
  out.access_type = said(access);
  if (!value.empty()) out.default_value = said(std::move(value));
  out.pdo_mapping = said(mappable ? "1" : "0");
  return out;
}

class Maker {
 public:
  explicit Maker(const NewDescription& wanted) : wanted_(wanted) {}

  eds::EdsFile make() {
    information();
    communication();
    if (wanted_.profile == cia402) {
      drive_objects();
      drive_pdos(wanted_.rpdos, 0x1400, 0x60400010, beside_controlword, "RPDO", 0x200);
      drive_pdos(wanted_.tpdos, 0x1800, 0x60410010, beside_statusword, "TPDO", 0x180);
    } else {
      const bool digital = wanted_.profile == cia401;
      pdos(wanted_.rpdos, 0x1400, digital ? digital_outputs : outputs, "RPDO", 0x200);
      pdos(wanted_.tpdos, 0x1800, digital ? digital_inputs : inputs, "TPDO", 0x180);
    }
    std::ranges::sort(out_.objects, {}, &Object::index);
    comments();
    return std::move(out_);
  }

 private:
  std::string text(const std::string& given, const char* key) {
    if (!given.empty()) return given;
    placeholders_.emplace_back(key);
    return "PLACEHOLDER";
  }
  std::string number(std::uint32_t given, const char* key) {
    if (given == 0) placeholders_.emplace_back(key);
    return fmt::format("0x{:08X}", given);
  }

  void information() {
    auto& file = out_.file_info;
    file.present = true;
    file.file_name = said(wanted_.file_name);
    file.file_version = said("1");
    file.file_revision = said("0");
    file.eds_version = said("4.0");
    file.description = said(fmt::format("Device by CiA {}", wanted_.profile));
    file.creation_time = file.modification_time = said("12:00AM");
    file.creation_date = file.modification_date = said(wanted_.date);
    file.created_by = file.modified_by = said(text({}, "CreatedBy and ModifiedBy"));
    auto& device = out_.device_info;
    device.present = true;
    device.vendor_name = said(text(wanted_.vendor_name, "VendorName"));
    device.vendor_number = said(number(wanted_.vendor, "VendorNumber and 1018h:01"));
    device.product_name = said(text(wanted_.product_name, "ProductName"));
    device.product_number = said(number(wanted_.product, "ProductNumber and 1018h:02"));
    device.revision_number = said(number(wanted_.revision, "RevisionNumber and 1018h:03"));
    device.order_code = said(text({}, "OrderCode"));
    for (const unsigned rate : {125U, 250U, 500U, 1000U}) device.baud_rates.push_back({rate, said("1")});
    device.simple_boot_up_master = said("0");
    device.simple_boot_up_slave = said("1");
    device.granularity = said("0");
    device.dynamic_channels = device.group_messaging = device.lss_supported = said("0");
    device.nr_of_rx_pdo = said(std::to_string(wanted_.rpdos));
    device.nr_of_tx_pdo = said(std::to_string(wanted_.tpdos));
    out_.dummy_usage.present = true;
    for (unsigned type = 1; type <= 7; ++type) out_.dummy_usage.entries.push_back({type, said("0")});
  }

  Object& variable(unsigned index, Entry entry) {
    auto& object = out_.objects.emplace_back();
    object.index = Index(static_cast<std::uint16_t>(index));
    object.entry = std::move(entry);
    return object;
  }

  /// `subs` from sub-index 01h on; 00h is made.
  void structure(unsigned index, std::string name, bool array, std::vector<Entry> subs) {
    auto& object = variable(index, {});
    object.entry.parameter_name = said(std::move(name));
    object.entry.object_type = said(array ? "0x8" : "0x9");
    object.sub_number = said(std::to_string(subs.size() + 1));
    object.subs.push_back({SubIndex(0), eds::Entry(entry("Highest sub-index supported", 0x05, "const",
                                                         std::to_string(subs.size())))});
    for (std::size_t i = 0; i < subs.size(); ++i)
      object.subs.push_back({SubIndex(static_cast<std::uint8_t>(i + 1)), std::move(subs[i])});
  }

  /// CiA 401: bit 16 is set where there are digital inputs, bit 17 where there are digital outputs.
  /// CiA 402: bit 17 is that of a servo drive.
  [[nodiscard]] std::uint32_t device_type() const {
    if (wanted_.profile == cia402) return cia402 | 1U << 17U;
    if (wanted_.profile != cia401) return 0;
    return cia401 | (wanted_.tpdos > 0 ? 1U << 16U : 0U) | (wanted_.rpdos > 0 ? 1U << 17U : 0U);
  }

  void communication() {
    variable(0x1000, entry("Device type", 0x07, "ro", fmt::format("0x{:08X}", device_type())));
    variable(0x1001, entry("Error register", 0x05, "ro", "0"));
    variable(0x1017, entry("Producer heartbeat time", 0x06, "rw", "0"));
    const auto& device = out_.device_info;
    structure(0x1018, "Identity object", false,
              {entry("Vendor-ID", 0x07, "ro", device.vendor_number.text),
               entry("Product code", 0x07, "ro", device.product_number.text),
               entry("Revision number", 0x07, "ro", device.revision_number.text),
               entry("Serial number", 0x07, "ro", "")});
  }

  /// The `number`-th of its direction, from 0 on.
  void pdo(unsigned number, unsigned first, const char* word, unsigned base,
           const std::vector<std::string>& mapped) {
    // Beyond the fourth PDO of a direction no COB-ID is predefined: the PDO is not valid before it has one.
    const auto cob_id =
        number < predefined_pdos ? fmt::format("$NODEID+0x{:X}", base + 0x100 * number) : "0x80000000";
    structure(first + number, fmt::format("{} {} communication parameter", word, number + 1), false,
              {entry("COB-ID", 0x07, "rw", cob_id), entry("Transmission type", 0x05, "rw", "0xFF")});
    std::vector<Entry> entries;
    for (const auto& value : mapped)
      entries.push_back(entry(fmt::format("Mapped object {}", entries.size() + 1), 0x07, "const", value));
    structure(first + 0x200 + number, fmt::format("{} {} mapping parameter", word, number + 1), false,
              std::move(entries));
  }

  void drive_objects() {
    for (const auto& each : drive) {
      const bool written = each.access == std::string_view("rw");
      const bool mapped = each.mappable && (written ? wanted_.rpdos : wanted_.tpdos) > 0;
      variable(each.index,
               entry(each.name, each.data_type, written && mapped ? "rww" : each.access, each.value, mapped));
    }
  }

  void drive_pdos(unsigned count, unsigned first, unsigned word_of_drive, std::span<const unsigned> beside,
                  const char* word, unsigned base) {
    for (unsigned i = 0; i < count; ++i) {
      std::vector<std::string> mapped{fmt::format("0x{:08X}", word_of_drive)};
      if (i > 0 && i <= beside.size()) mapped.push_back(fmt::format("0x{:08X}", beside[i - 1]));
      pdo(i, first, word, base, mapped);
    }
  }

  void pdos(unsigned count, unsigned first, const Mapped& mapped, const char* word, unsigned base) {
    if (count == 0) return;
    std::vector<Entry> elements;
    for (unsigned i = 0; i < count; ++i) {
      elements.push_back(entry(fmt::format("{} {}", mapped.element, i + 1), mapped.data_type, mapped.access,
                               mapped.access == std::string_view("rww") ? "0" : "", true));
      pdo(i, first, word, base,
          {fmt::format("0x{:04X}{:02X}{:02X}", mapped.first_index, i + 1, mapped.bits)});
    }
    structure(mapped.first_index, mapped.name, true, std::move(elements));
  }

  void comments() {
    std::vector<std::string> lines = {
        "Made by canopen-conform eds new. Placeholders to be replaced:",
    };
    for (const auto& each : placeholders_) lines.push_back("  " + each);
    lines.emplace_back("Then check it: canopen-conform eds lint FILE");
    out_.comments.present = true;
    for (std::size_t i = 0; i < lines.size(); ++i) out_.comments.entries.push_back({i + 1, said(lines[i])});
  }

  const NewDescription& wanted_;
  eds::EdsFile out_;
  std::vector<std::string> placeholders_;
};

}  // namespace

eds::EdsFile new_description(const NewDescription& wanted) { return Maker(wanted).make(); }

}  // namespace conform::cli
