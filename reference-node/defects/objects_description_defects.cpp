// SPDX-License-Identifier: Apache-2.0
// Defects of the stored device description (1021h, 1022h).
#include <array>

#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u8 = DataType::unsigned8;

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
      {"1022-writable", "1022h can be written", {"OD-1022-03", "OD-ACC-01"}, access(0x1022, 0, Access::rw)},
  };
}

}  // namespace refnode
