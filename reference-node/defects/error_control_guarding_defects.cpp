// SPDX-License-Identifier: Apache-2.0
// Defects of node guarding and life guarding (100Ch, 100Dh).
#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

DefectTable error_control_guarding_defects() {
  return {
      {"100c-absent",
       "100Ch does not exist although the node is guarded",
       {"OD-100C-01", "OD-CAT-03", "OD-ERC-01", "EC-GEN-01", "OD-GEN-17"},
       absent(0x100C)},
      {"100c-is-u32",
       "100Ch has four bytes",
       {"OD-100C-01", "OD-LEN-04", "OD-GEN-17"},
       type(0x100C, 0, DataType::unsigned32)},
      {"100c-not-writable",
       "100Ch is read-only although there is life guarding",
       {"OD-100C-02", "SDO-DNL-21"},
       access(0x100C, 0, Access::ro)},
      {"100c-not-stored", "Writing 100Ch is confirmed and forgotten", {"OD-100C-02"}, not_stored(0x100C, 0)},
      {"100c-default-nonzero", "The default of 100Ch is 100 ms", {"OD-100C-04"}, preset(0x100C, 0, 100)},
      {"100d-absent",
       "100Dh does not exist although the node is guarded",
       {"OD-100D-01", "OD-CAT-03", "OD-ERC-01", "EC-GEN-01", "OD-GEN-17"},
       absent(0x100D)},
      {"100d-is-u16",
       "100Dh has two bytes",
       {"OD-100D-01", "OD-100D-03", "OD-LEN-04", "OD-GEN-17"},
       type(0x100D, 0, DataType::unsigned16)},
      {"100d-not-writable",
       "100Dh is read-only although there is life guarding",
       {"OD-100D-02", "SDO-DNL-21"},
       access(0x100D, 0, Access::ro)},
      {"100d-default-nonzero", "The default of 100Dh is 3", {"OD-100C-04"}, preset(0x100D, 0, 3)},
      {"100d-long-write-wrong-abort",
       "Two bytes for 100Dh are refused with 0609 0030h",
       {"OD-100D-03"},
       wrong_abort_at(mux(0x100D, 0), abort_code::length_too_high, abort_code::invalid_value)},
      {"1029-ignores-life-guarding",
       "Guarding that stays away is not noticed",
       {"OD-1029-10", "EC-NG-07"},
       together(unnoticed(ErrorSource::guarding), [](Parts& parts) { parts.guarding.on_loss = nullptr; })},
  };
}

}  // namespace refnode
