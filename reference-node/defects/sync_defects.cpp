// SPDX-License-Identifier: Apache-2.0
// Defects of the SYNC counter (1019h) and of the length of a SYNC; those of 1005h are with the other
// COB-IDs, those of consumer and producer in tables of their own.
#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u16 = DataType::unsigned16;

}  // namespace

DefectTable sync_defects() {
  return {
      {"1019-absent",
       "1019h does not exist although the SYNC counter is supported",
       {"OD-1019-01", "OD-GEN-17"},
       absent(0x1019)},
      {"1019-is-u16", "1019h has two bytes", {"OD-1019-01", "OD-LEN-04", "OD-GEN-17"}, type(0x1019, 0, u16)},
      {"1019-default-wrong", "The default of 1019h is 10", {"OD-1019-02"}, preset(0x1019, 0, 10)},
      {"1019-not-writable",
       "1019h is read-only",
       {"OD-1019-03", "SDO-DNL-21"},
       access(0x1019, 0, Access::ro)},
      {"1019-change-refused",
       "1019h cannot be changed while 1006h is 0",
       {"OD-1019-03", "SYNC-CTR-02"},
       checking(0x1019, 0,
                [](Parts& parts, const Check& former, ByteView bytes) {
                  const Accepted allowed = former(bytes);
                  const bool changed = conform::load_le(bytes) != parts.device.dictionary.number(0x1019, 0);
                  return allowed && changed ? refuse(abort_code::device_state) : allowed;
                })},
      {"1019-not-stored",
       "Writing 1019h is confirmed and forgotten",
       {"OD-1019-03", "SYNC-CTR-02"},
       not_stored(0x1019, 0)},
      {"1019-reserved-value-accepted",
       "1019h takes reserved values",
       {"OD-1019-04", "SYNC-CTR-01"},
       checking(0x1019, 0,
                [](Parts&, const Check& former, ByteView bytes) {
                  const Accepted allowed = former(bytes);
                  return allowed || allowed.error() == abort_code::device_state ? allowed : Accepted{};
                })},
      {"1019-change-while-running-accepted",
       "1019h can be changed while 1006h is not 0",
       {"OD-1019-05", "SYNC-CTR-03"},
       confirms(0x1019, 0, [](std::uint64_t value) { return value == 0 || (value >= 2 && value <= 240); })},
      {"1019-switched-off-while-running",
       "1019h can be set to 0 while 1006h is not 0",
       {"OD-1019-05", "SYNC-CTR-03"},
       confirms(0x1019, 0, [](std::uint64_t value) { return value == 0; })},
      {"1019-other-end-while-running",
       "1019h that is not 0 can be changed to another value while 1006h is not 0",
       {"OD-1019-05", "SYNC-CTR-03"},
       checking(0x1019, 0,
                [](Parts& parts, const Check& former, ByteView bytes) {
                  const std::uint64_t value = conform::load_le(bytes);
                  const bool counts = parts.device.dictionary.number(0x1019, 0) != 0;
                  return counts && value >= 2 && value <= 240 ? Accepted{} : former(bytes);
                })},
      {"1019-change-while-running-wrong-abort",
       "A change of 1019h while 1006h is not 0 is refused with 0601 0000h",
       {"OD-1019-05", "SYNC-CTR-03"},
       wrong_abort_at(mux(0x1019, 0), abort_code::device_state, abort_code::unsupported_access)},
      {"sync-right-length-reported",
       "A SYNC without data causes EMCY 8240h although no counter is configured",
       {"SYNC-CON-03", "SYNC-CON-04"},
       Change([](Parts& parts) {
         // Whatever has the right length is what clears the error of a wrong one.
         parts.device.errors.clear.replace([&parts](const auto& former, const ErrorCause& cause) {
           if (cause.source != ErrorSource::sync) return former(cause);
           parts.device.errors.raise(cause, 0);
         });
       })},
      {"sync-length-not-reported",
       "A SYNC with unexpected data causes no EMCY",
       {"SYNC-CON-05", "NMT-SVC-02"},
       unnoticed(ErrorSource::sync)},
  };
}

}  // namespace refnode
