// SPDX-License-Identifier: Apache-2.0
// Defects of the stored device description (1021h, 1022h).
#include <array>
#include <string>

#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u8 = DataType::unsigned8;

/// What 1021h holds.
Change stored_description(std::string (*other)(std::string text)) {
  return reading(0x1021, 0, [other](Parts&, const Read& former) -> Upload {
    const Upload right = former();
    if (!right) return right;
    const std::string text = other(std::string(right->begin(), right->end()));
    return Bytes(text.begin(), text.end());
  });
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

}  // namespace

DefectTable objects_description_defects() {
  return {
      {"1021-size-mismatch",
       "The upload of 1021h announces one byte more than it delivers",
       {"OD-1021-01", "SDO-SUP-02"},
       patch([](const SdoExchange& e) { return e.index() == 0x1021 && e.step == SdoStep::upload_initiate; },
             [](const SdoExchange&, std::array<std::uint8_t, 8>& data) { ++data[4]; })},
      {"1021-empty",
       "1021h has no content",
       {"OD-1021-01"},
       reading(0x1021, 0, [](Parts&, const Read&) -> Upload { return Bytes{}; })},
      {"1021-refused",
       "The upload of 1021h is aborted with 0606 0000h",
       {"OD-1021-01"},
       respond([](const SdoExchange& e) { return e.index() == 0x1021 && e.step == SdoStep::upload_initiate; },
               0x80, 0x06060000)},
      {"1021-writable",
       "1021h can be written",
       {"OD-1021-02"},
       [](ObjectDictionary& od, std::uint8_t) {
         if (Entry* entry = od.entry(0x1021, 0)) {
           entry->access = Access::rw;
           entry->max_size = 1000;
         }
       }},
      {"1022-absent",
       "1022h does not exist although 1021h does",
       {"OD-1022-01", "OD-CAT-03", "OD-GEN-17"},
       absent(0x1022)},
      {"1022-value-above-ff",
       "1022h is 0100h",
       {"OD-1022-01", "OD-1022-02", "OD-DSC-04"},
       preset(0x1022, 0, 0x100)},
      {"1022-is-u8", "1022h has one byte", {"OD-1022-01", "OD-LEN-04", "OD-GEN-17"}, type(0x1022, 0, u8)},
      {"1022-reserved-value", "1022h is 01h", {"OD-1022-02"}, preset(0x1022, 0, 1)},
      {"1021-binary",
       "1021h holds no device description, although 1022h says so",
       {"EDS-VSD-11"},
       stored_description([](std::string text) { return std::string(text.size(), '\x1F'); })},
      {"1021-cut-at-the-head",
       "Of the stored device description only the head is there",
       {"EDS-VSD-11"},
       stored_description([](std::string text) { return text.substr(0, text.find("[DeviceInfo]")); })},
      {"1021-of-another-product",
       "The stored device description is that of another product",
       {"EDS-VSD-11"},
       stored_description([](std::string text) {
         return replaced(std::move(text), "ProductNumber=0x301", "ProductNumber=0x302");
       })},
      {"1021-of-a-larger-device",
       "The stored device description names objects that the device does not have",
       {"EDS-VSD-11"},
       stored_description([](std::string text) {
         return text +
                "[6300]\nParameterName=Output\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nPDOMapping=0\n";
       })},
      {"1403-missing",
       "There is an RPDO less than the description says",
       {"EDS-VSD-10"},
       both(absent(0x1403), absent(0x1603))},
      {"1804-undescribed",
       "There is a TPDO more than the description says",
       {"EDS-VSD-10", "OD-1800-03"},
       [](ObjectDictionary& od, std::uint8_t) {
         od.remove(0x1804);  // a twin may have one
         od.add_complex(0x1804, "TPDO communication parameter", ObjectKind::record);
         od.add_sub(0x1804, 1, integer_entry("COB-ID", DataType::unsigned32, Access::rw, 0x80000000));
         od.add_sub(0x1804, 2, integer_entry("Transmission type", u8, Access::rw, 0xFF));
       }},
      {"1022-writable", "1022h can be written", {"OD-1022-03", "OD-ACC-01"}, access(0x1022, 0, Access::rw)},
  };
}

}  // namespace refnode
