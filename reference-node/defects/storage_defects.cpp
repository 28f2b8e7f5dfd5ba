// SPDX-License-Identifier: Apache-2.0
// Defects of storing (1010h) and restoring (1011h) parameters.
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

DefectTable storage_defects() {
  using B = Behaviour;
  using S = StoreFaults;
  const auto signature_at = [](std::uint16_t index) {
    return wrong_abort(abort_code::cannot_store, abort_code::general_error, {index, index});
  };
  return {
      {"1010-save-rejected",
       "The signature \"save\" is refused with 0800 0020h",
       {"OD-1010-07", "STO-1010-04"},
       respond(
           [](const SdoExchange& e) {
             return e.index() == 0x1010 && e.step == SdoStep::download_initiate && !e.aborted;
           },
           0x80, 0x08000020)},
      {"1010-save-no-response",
       "\"save\" gets no answer",
       {"OD-1010-07", "STO-1010-04"},
       silent([](const SdoExchange& e) {
         return e.index() == 0x1010 && e.step == SdoStep::download_initiate && !e.aborted;
       })},
      {"1010-signature-byte-order",
       "1010h wants the signature with its bytes reversed",
       {"OD-1010-07", "OD-1010-08", "STO-1010-03"},
       behave(&B::store, &S::byte_order_wrong)},
      {"1010-wrong-signature-accepted",
       "1010h stores with any signature",
       {"OD-1010-08", "OD-1010-09", "STO-1010-02", "STO-1010-03"},
       behave(&B::store, &S::signature_unchecked)},
      {"1010-wrong-signature-wrong-abort",
       "A wrong signature in 1010h is aborted with 0800 0000h",
       {"OD-1010-08"},
       signature_at(0x1010)},
      {"1010-signature-case-insensitive",
       "1010h accepts \"SAVE\"",
       {"OD-1010-08"},
       behave(&B::store, &S::case_ignored)},
      {"1010-wrong-signature-still-saves",
       "A wrong signature in 1010h is refused, but stores",
       {"OD-1010-09", "STO-1010-02"},
       behave(&B::store, &S::acts_on_wrong_signature)},
      {"1010-save-not-persistent",
       "\"save\" is confirmed without storing anything",
       {"OD-1010-10", "STO-1010-04", "STO-1010-05", "OD-RST-04"},
       behave(&B::store, &S::without_effect)},
      {"1010-stored-values-ignored",
       "Stored values are not used at start-up",
       {"OD-1010-10", "OD-RST-04", "STO-1010-04", "STO-1010-05", "STO-1010-13"},
       behave(&B::stored_values_ignored)},
      {"1010-sub2-saves-nothing",
       "1010h:02 confirms without storing",
       {"OD-1010-11", "STO-1010-07"},
       behave(&B::store, &S::sub2_without_effect)},
      {"1010-sub3-saves-nothing",
       "1010h:03 confirms without storing",
       {"OD-1010-12", "STO-1010-08"},
       behave(&B::store, &S::sub3_without_effect)},
      {"1010-sub3-refused",
       "1010h:03 says that it stores, and refuses \"save\" as absent",
       {"OD-1010-12", "STO-1010-08"},
       respond(
           [](const SdoExchange& e) {
             return e.index() == 0x1010 && e.sub() == 3 && e.step == SdoStep::download_initiate && !e.aborted;
           },
           0x80, 0x06090011)},
      {"1010-groups-mixed",
       "Every sub-index of 1010h stores all parameters",
       {"OD-1010-11", "OD-1010-12", "STO-1010-07", "STO-1010-08"},
       behave(&B::store, &S::groups_mixed)},
      {"1010-failed-save-confirmed",
       "A failure to store is confirmed",
       {"OD-1010-14"},
       behave(&B::store, &S::failure_confirmed)},
      {"1010-failed-save-wrong-abort",
       "A failure to store is aborted with 0800 0020h",
       {"OD-1010-14"},
       behave(&B::store, &S::failure_aborted_as_refusal)},
      {"1011-load-rejected",
       "The signature \"load\" is refused with 0800 0020h",
       {"OD-1011-07", "STO-1011-03"},
       respond(
           [](const SdoExchange& e) {
             return e.index() == 0x1011 && e.step == SdoStep::download_initiate && !e.aborted;
           },
           0x80, 0x08000020)},
      {"1011-load-no-response",
       "\"load\" gets no answer",
       {"OD-1011-07", "STO-1011-03"},
       silent([](const SdoExchange& e) {
         return e.index() == 0x1011 && e.step == SdoStep::download_initiate && !e.aborted;
       })},
      {"1011-signature-byte-order",
       "1011h wants the signature with its bytes reversed",
       {"OD-1011-07", "OD-1011-08", "STO-1011-08"},
       behave(&B::restore, &S::byte_order_wrong)},
      {"1011-wrong-signature-accepted",
       "1011h restores with any signature",
       {"OD-1011-08", "OD-1011-09", "STO-1011-02", "STO-1011-08"},
       behave(&B::restore, &S::signature_unchecked)},
      {"1011-wrong-signature-wrong-abort",
       "A wrong signature in 1011h is aborted with 0800 0000h",
       {"OD-1011-08"},
       signature_at(0x1011)},
      {"1011-signature-case-insensitive",
       "1011h accepts \"LOAD\"",
       {"OD-1011-08"},
       behave(&B::restore, &S::case_ignored)},
      {"1011-wrong-signature-still-restores",
       "A wrong signature in 1011h is refused, but restores",
       {"OD-1011-09", "STO-1011-02"},
       behave(&B::restore, &S::acts_on_wrong_signature)},
      {"1011-load-without-effect",
       "\"load\" is confirmed without restoring anything",
       {"OD-1011-10", "STO-1011-03", "OD-RST-05"},
       behave(&B::restore, &S::without_effect)},
      {"1011-defaults-before-reset",
       "\"load\" makes the defaults valid at once",
       {"OD-1011-11", "STO-1011-04"},
       behave(&B::restore, &S::effective_at_once)},
      {"1011-sub2-without-effect",
       "1011h:02 confirms without restoring",
       {"OD-1011-12", "STO-1011-05"},
       behave(&B::restore, &S::sub2_without_effect)},
      {"1011-sub3-without-effect",
       "1011h:03 confirms without restoring",
       {"OD-1011-13", "STO-1011-06"},
       behave(&B::restore, &S::sub3_without_effect)},
      {"1011-groups-mixed",
       "Every sub-index of 1011h restores all parameters",
       {"OD-1011-12", "OD-1011-13", "STO-1011-05", "STO-1011-06"},
       behave(&B::restore, &S::groups_mixed)},
      {"1011-failed-load-confirmed",
       "A failure to restore is confirmed",
       {"OD-1011-15"},
       behave(&B::restore, &S::failure_confirmed)},
      {"1011-failed-load-wrong-abort",
       "A failure to restore is aborted with 0800 0020h",
       {"OD-1011-15"},
       behave(&B::restore, &S::failure_aborted_as_refusal)},
  };
}

}  // namespace refnode
