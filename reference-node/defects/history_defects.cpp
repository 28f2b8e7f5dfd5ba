// SPDX-License-Identifier: Apache-2.0
// Defects of the pre-defined error field 1003h.
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

DefectTable history_defects() {
  using B = Behaviour;
  return {
      {"1003-nonzero-write-accepted", "1003h:00 confirms any value, but keeps the history",
       {"OD-1003-06", "EMCY-HIS-04"}, behave(&B::history_nonzero_write_accepted)},
      {"1003-nonzero-write-clears", "1003h:00 refuses a non-zero value, yet clears the history",
       {"OD-1003-07"}, behave(&B::history_nonzero_write_clears)},
      {"1003-nonzero-write-wrong-abort", "1003h:00 refuses a non-zero value with 0601 0002h instead of 0609 0030h",
       {"OD-1003-06", "EMCY-HIS-04"}, wrong_abort_at(mux(0x1003, 0), abort_code::invalid_value, abort_code::read_only)},
      {"1003-empty-read-returns-zero", "Reading an unused entry of 1003h gives 0000 0000h instead of an abort",
       {"OD-1003-03", "OD-1003-09", "EMCY-HIS-03"}, behave(&B::history_empty_reads_zero)},
      {"1003-empty-read-0609-0011", "Reading 1003h:01 with an empty history aborts with 0609 0011h",
       {"OD-1003-03", "OD-1003-02", "EMCY-HIS-03"},
       wrong_abort_at(mux(0x1003, 1), abort_code::no_data, abort_code::no_sub_index)},
      {"1003-clear-rejected", "Writing 00h to 1003h:00 is refused with 0800 0000h",
       {"OD-1003-05", "EMCY-HIS-03"}, behave(&B::history_clear_rejected)},
      {"1003-clear-ignored", "Writing 00h to 1003h:00 is confirmed without effect",
       {"OD-1003-05", "EMCY-HIS-03"}, behave(&B::history_clear_ignored)},
      {"1003-clear-resets-1001", "Clearing the history also acknowledges the errors in 1001h",
       {"OD-1003-16"}, behave(&B::history_clear_resets_errors)},
      {"1003-error-not-recorded", "Errors are reported by EMCY, but not entered into 1003h",
       {"OD-1003-10", "EMCY-HIS-01"}, behave(&B::history_not_written)},
      {"1003-count-not-updated", "1003h:00 stays 00h while errors are recorded",
       {"OD-1003-10", "OD-1003-09", "EMCY-HIS-01"}, behave(&B::history_count_not_updated)},
      {"1003-code-in-upper-half", "The error code stands in bits 31-16 of an entry of 1003h",
       {"OD-1003-11", "EMCY-HIS-01"}, behave(&B::history_code_in_upper_half)},
      {"1003-code-byte-swapped", "The error code in 1003h is in big-endian order",
       {"OD-1003-11", "EMCY-HIS-01"}, behave(&B::history_code_byte_swapped)},
      {"1003-oldest-first", "New errors are appended at the end of 1003h",
       {"OD-1003-12", "EMCY-HIS-02"}, behave(&B::history_oldest_first)},
      {"1003-no-shift-overwrites", "A new error overwrites 1003h:01, older ones are lost",
       {"OD-1003-12", "EMCY-HIS-02"}, behave(&B::history_overwrites)},
      {"1003-full-drops-newest", "A full history stops recording",
       {"OD-1003-13", "EMCY-HIS-05"}, behave(&B::history_full_drops_newest)},
      {"1003-count-exceeds-depth", "1003h:00 counts on beyond the depth of the array",
       {"OD-1003-13", "OD-1003-09", "EMCY-HIS-05"}, behave(&B::history_count_exceeds_depth)},
      {"1003-records-error-reset", "The end of all errors is entered into 1003h as error 0000h",
       {"OD-1003-15"}, behave(&B::records_error_reset)},
      {"1003-count-is-u32", "1003h:00 is an UNSIGNED32",
       {"OD-1003-01", "OD-GEN-10", "OD-1003-14"}, type(0x1003, 0, DataType::unsigned32)},
      {"1003-no-sub1", "1003h has no sub-index 01h", {"OD-1003-02", "OD-CAT-02"}, absent_sub(0x1003, 1)},
      {"1003-field-writable", "1003h:01 can be written", {"OD-1003-08"}, access(0x1003, 1, Access::rw)},
      {"1003-field-write-wrong-abort", "Writing 1003h:01 is refused with 0609 0030h instead of 0601 0002h",
       {"OD-1003-08"}, wrong_abort_at(mux(0x1003, 1), abort_code::read_only, abort_code::invalid_value)},
  };
}

}  // namespace refnode
