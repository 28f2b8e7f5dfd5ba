// SPDX-License-Identifier: Apache-2.0
// Defects of the error register 1001h and of the EMCY producer.
#include <utility>

#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

DefectTable emergency_defects() {
  using B = Behaviour;
  return {
      {"1001-not-set-on-error",
       "1001h stays 00h while errors are present",
       {"OD-1001-05", "EMCY-FMT-04"},
       behave(&B::error_register_never_set)},
      {"1001-specific-bit-without-generic",
       "1001h lacks the generic bit 0",
       {"OD-1001-04", "EMCY-FMT-04", "OD-1001-05"},
       behave(&B::error_register_without_generic)},
      {"1001-reserved-bit6-set",
       "1001h has the reserved bit 6 set with every error",
       {"OD-1001-03", "EMCY-FMT-04"},
       behave(&B::error_register_bit6_set)},
      {"1001-not-cleared-on-recovery",
       "1001h keeps bit 0 after all errors have gone",
       {"OD-1001-06", "EMCY-SEQ-02", "EC-HBC-07"},
       behave(&B::error_register_sticks)},
      {"1001-differs-from-emcy",
       "EMCY always shows 01h as error register",
       {"OD-1001-07", "EMCY-FMT-03"},
       behave(&B::emergency_register_always_generic)},
      {"error-register-bit-wrong",
       "Communication errors do not set bit 4 of 1001h",
       {"EMCY-FMT-05"},
       behave(&B::communication_bit_missing)},
      {"emcy-dlc-short",
       "EMCY frames have three bytes",
       {"EMCY-FMT-01"},
       reshape(Service::emergency, [](const FilterContext&, Frame& frame) { frame.dlc = 3; })},
      {"emcy-code-byte-swapped",
       "The error code of EMCY is in big-endian order",
       {"EMCY-FMT-01", "OD-1003-11", "EMCY-HIS-01"},
       reshape(Service::emergency,
               [](const FilterContext&, Frame& frame) { std::swap(frame.data[0], frame.data[1]); })},
      {"emcy-undefined-code",
       "EMCY uses codes of the undefined class A0h",
       {"EMCY-FMT-02", "EC-HBC-03", "OD-1003-11"},
       reshape(Service::emergency,
               [](const FilterContext&, Frame& frame) {
                 if (frame.data[1] != 0) frame.data[1] = 0xA0;
               })},
      {"emcy-repeated", "Every EMCY is sent twice", {"EMCY-SEQ-01", "EC-HBC-10"}, repeat(Service::emergency)},
      {"emcy-reset-missing",
       "The end of all errors is not reported",
       {"EMCY-SEQ-02", "EC-HBC-07"},
       behave(&B::error_reset_not_sent)},
      {"emcy-reset-register-cleared-too-early",
       "When one of several errors goes, EMCY 0000h claims that none is left",
       {"EMCY-SEQ-05"},
       behave(&B::error_reset_too_early)},
      {"emcy-second-error-suppressed",
       "While one error is present a second is not reported",
       {"EMCY-SEQ-04"},
       behave(&B::second_error_suppressed)},
      {"emcy-sent-in-stopped",
       "EMCY is sent in Stopped",
       {"EMCY-NMT-01", "NMT-FSA-23"},
       behave(&B::emergency_sent_in_stopped)},
      {"emcy-dead-in-preop",
       "EMCY is not sent in Pre-operational",
       {"EMCY-NMT-02"},
       mute(Service::emergency, NmtState::pre_operational)},
      {"1014-sends-emcy-when-invalid",
       "EMCY is sent although 1014h says that it does not exist",
       {"OD-1014-08", "EMCY-COB-03"},
       behave(&B::emergency_sent_when_not_valid)},
      {"1015-inhibit-ignored",
       "The inhibit time of 1015h has no effect",
       {"OD-1015-03", "EMCY-INH-01"},
       behave(&B::emergency_inhibit_unit_us, 0)},
      {"1015-unit-10us",
       "1015h counts in 10 us",
       {"OD-1015-03", "EMCY-INH-01"},
       behave(&B::emergency_inhibit_unit_us, 10)},
      {"emcy-lost-while-inhibited",
       "Errors that come during the inhibit time of 1015h are never reported",
       {"EMCY-INH-01"},
       behave(&B::emergency_lost_while_inhibited)},
      {"sync-right-length-reported",
       "A SYNC without data causes EMCY 8240h although no counter is configured",
       {"SYNC-CON-03"},
       behave(&B::sync_without_data_reported)},
      {"emcy-without-error",
       "EMCY 1000h follows the boot-up message although there is no error",
       {"EMCY-SEQ-03"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.service != Service::boot_up) return;
         frames.push_back({conform::can::data_frame(conform::CanId(0x80U + context.node_id),
                                                    {0x00, 0x10, 0, 0, 0, 0, 0, 0}),
                           {}});
       })},
      {"sync-length-not-reported",
       "A SYNC with unexpected data causes no EMCY",
       {"SYNC-CON-05", "NMT-SVC-02"},
       behave(&B::sync_length_not_reported)},
  };
}

}  // namespace refnode
