// SPDX-License-Identifier: Apache-2.0
#include "eds/convert/write_ini.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "eds/convert/xdd_types.hpp"
#include "eds/same_value.hpp"

namespace conform::eds {
namespace {

constexpr unsigned rates[] = {10, 20, 50, 125, 250, 500, 800, 1000};

class Writer {
 public:
  explicit Writer(const EdsFile& file) : file_(file) {}

  std::string text() {
    file_info();
    device_info();
    if (file_.commissioning.present) {
      line("[DeviceComissioning]");
      for (const auto& row : commissioning_fields) given(row.key, file_.commissioning.*row.field);
      line("");
    }
    line("[DummyUsage]");
    for (const auto& dummy : file_.dummy_usage.entries)
      line("Dummy{:04X}={}", dummy.number, same_flag(dummy.field.text, "1") ? 1 : 0);
    line("");
    comments();
    list("MandatoryObjects", ObjectList::mandatory);
    list("OptionalObjects", ObjectList::optional);
    list("ManufacturerObjects", ObjectList::manufacturer);
    for (const auto& object : file_.objects) this->object(object);
    return std::move(out_);
  }

 private:
  template <typename... Args>
  void line(fmt::format_string<Args...> form, Args&&... args) {
    out_ += fmt::format(form, std::forward<Args>(args)...);
    out_ += "\r\n";
  }
  void always(std::string_view key, const Field& field) { line("{}={}", key, field.text); }
  void given(std::string_view key, const Field& field) {
    if (!field.empty()) always(key, field);
  }

  void file_info() {
    line("[FileInfo]");
    for (const auto& row : file_info_fields) {
      const auto& field = file_.file_info.*row.field;
      row.key == "LastEDS" ? given(row.key, field) : always(row.key, field);
    }
    line("");
  }

  void device_info() {
    const auto& info = file_.device_info;
    line("[DeviceInfo]");
    for (const auto& row : device_info_fields) {
      row.key == "CompactPDO" ? given(row.key, info.*row.field) : always(row.key, info.*row.field);
      if (row.key == "OrderCode") bit_rates();
    }
    line("");
  }

  void bit_rates() {
    for (const auto rate : rates) {
      const bool supported =
          std::ranges::any_of(file_.device_info.baud_rates, [rate](const NumberedField& each) {
            return each.number == rate && same_flag(each.field.text, "1");
          });
      line("BaudRate_{}={}", rate, supported ? 1 : 0);
    }
  }

  void comments() {
    if (file_.comments.entries.empty()) return;
    line("[Comments]");
    line("Lines={}", file_.comments.entries.size());
    for (std::size_t i = 0; i < file_.comments.entries.size(); ++i)
      line("Line{}={}", i + 1, file_.comments.entries[i].field.text);
    line("");
  }

  void list(std::string_view name, ObjectList wanted) {
    std::vector<Index> indices;
    for (const auto& object : file_.objects) {
      if (list_of(object.index) == wanted) indices.push_back(object.index);
    }
    line("[{}]", name);
    line("SupportedObjects={}", indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) line("{}=0x{:04X}", i + 1, indices[i].value());
    line("");
  }

  void object(const Object& object) {
    line("[{:04X}]", object.index.value());
    entry(object.entry, object.sub_number);
    for (const auto& sub : object.subs) {
      line("[{:04X}sub{:X}]", object.index.value(), sub.sub.value());
      entry(sub.entry, {});
    }
  }

  void entry(const Entry& entry, const Field& sub_number) {
    for (const auto& row : entry_fields) {
      row.key == "ParameterName" ? always(row.key, entry.*row.field) : given(row.key, entry.*row.field);
      if (row.key == "ObjectType") given("SubNumber", sub_number);
    }
    line("");
  }

  const EdsFile& file_;
  std::string out_;
};

}  // namespace

std::string write_ini(const EdsFile& file) { return Writer(file).text(); }

}  // namespace conform::eds
