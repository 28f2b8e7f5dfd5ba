// SPDX-License-Identifier: Apache-2.0
// Defects of the pre-defined error field 1003h.
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

bool is_zero(std::uint64_t value) { return value == 0; }
bool is_not_zero(std::uint64_t value) { return value != 0; }
bool is_cleared(std::uint64_t, std::uint64_t wanted) { return wanted == 0; }

std::vector<std::uint32_t> newest_first(const ErrorHistory& history) {
  std::vector<std::uint32_t> out;
  for (std::uint8_t sub = 1; sub <= history.recorded(); ++sub)
    out.push_back(static_cast<std::uint32_t>(conform::load_le(*history.read(sub))));
  return out;
}

/// What 1003h shows in place of what it holds.
Change shows_of_history(const std::function<std::vector<std::uint32_t>(const ErrorHistory&)>& shown) {
  return together(reading(0x1003, 0,
                          [shown](Parts& parts, const Read&) -> Upload {
                            return Bytes{static_cast<std::uint8_t>(shown(parts.emergency.history).size())};
                          }),
                  reading_all(0x1003, [shown](Parts& parts, const Read&, std::uint8_t sub) -> Upload {
                    const auto errors = shown(parts.emergency.history);
                    if (sub > errors.size()) return refuse(abort_code::no_data);
                    return conform::to_le(errors[sub - 1U], 4);
                  }));
}

/// Another number in place of each field.
Change shows_in_field(std::uint32_t (*shown)(std::uint32_t field)) {
  return reading_all(0x1003, [shown](Parts&, const Read& former, std::uint8_t) {
    Upload field = former();
    if (field) *field = conform::to_le(shown(static_cast<std::uint32_t>(conform::load_le(*field))), 4);
    return field;
  });
}

Change remembers_more_than_it_shows() {
  return [](Parts& parts) { parts.emergency.history.choices.depth = 0xFE; };
}

/// The history is the list of the errors that are there.
void forgets_what_has_ended(Parts& parts) {
  parts.device.errors.clear.replace([&parts](const auto& former, const ErrorCause& cause) {
    former(cause);
    parts.emergency.history.clear();
    for (const ErrorCause& active : parts.emergency.active())
      parts.emergency.history.record(active.code, active.source, 0);
  });
}

/// Clearing shows an empty history; with the next error the former ones are back.
void hides_what_was_cleared(Parts& parts) {
  const auto hidden = since_boot_up<bool>(parts);
  checking(0x1003, 0, [hidden](Parts&, const Check& former, ByteView bytes) -> Accepted {
    if (conform::load_le(bytes) != 0) return former(bytes);
    *hidden = true;
    return {};
  })(parts);
  reading(0x1003, 0,
          [hidden](Parts&, const Read& former) -> Upload { return *hidden ? Bytes{0} : former(); })(parts);
  reading_all(0x1003, [hidden](Parts&, const Read& former, std::uint8_t) -> Upload {
    if (*hidden) return refuse(abort_code::no_data);
    return former();
  })(parts);
  parts.device.errors.raise.replace(
      [hidden](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
        *hidden = false;
        former(cause, detail);
      });
}

/// The history is the list of what is wrong: what is cleared there is not known any more.
void forgets_cleared_errors(Parts& parts) {
  const auto forgotten = since_boot_up<std::vector<ErrorCause>>(parts);
  checking(0x1003, 0, [forgotten](Parts& node, const Check& former, ByteView bytes) {
    const Accepted cleared = former(bytes);
    if (cleared) *forgotten = node.emergency.active();
    return cleared;
  })(parts);
  parts.device.errors.clear.replace([forgotten](const auto& former, const ErrorCause& cause) {
    if (std::ranges::find(*forgotten, cause) == forgotten->end()) former(cause);
  });
}

}  // namespace

DefectTable emergency_history_defects() {
  return {
      {"1003-nonzero-write-accepted",
       "1003h:00 confirms any value, but keeps the history",
       {"OD-1003-06", "EMCY-HIS-04"},
       confirms(0x1003, 0, is_not_zero)},
      {"1003-nonzero-write-clears",
       "1003h:00 refuses a non-zero value, yet clears the history",
       {"OD-1003-07"},
       checking(0x1003, 0,
                [](Parts& parts, const Check& former, ByteView bytes) {
                  parts.emergency.history.clear();
                  return former(bytes);
                })},
      {"1003-nonzero-write-wrong-abort",
       "1003h:00 refuses a non-zero value with 0601 0002h instead of 0609 0030h",
       {"OD-1003-06", "EMCY-HIS-04"},
       wrong_abort_at(mux(0x1003, 0), abort_code::invalid_value, abort_code::read_only)},
      {"1003-empty-read-returns-zero",
       "Reading an unused entry of 1003h gives 0000 0000h instead of an abort",
       {"OD-1003-03", "OD-1003-09", "EMCY-HIS-03"},
       reading_all(0x1003,
                   [](Parts&, const Read& former, std::uint8_t) -> Upload {
                     return former().value_or(Bytes(4, 0));
                   })},
      {"1003-empty-read-0609-0011",
       "Reading 1003h:01 with an empty history aborts with 0609 0011h",
       {"OD-1003-03", "OD-1003-02", "EMCY-HIS-03"},
       wrong_abort_at(mux(0x1003, 1), abort_code::no_data, abort_code::no_sub_index)},
      {"1003-clear-rejected",
       "Writing 00h to 1003h:00 is refused with 0800 0000h",
       {"OD-1003-05", "EMCY-HIS-03"},
       refuses(0x1003, 0, abort_code::general_error, is_cleared)},
      {"1003-clear-ignored",
       "Writing 00h to 1003h:00 is confirmed without effect",
       {"OD-1003-05", "EMCY-HIS-03"},
       confirms(0x1003, 0, is_zero)},
      {"1003-clear-resets-1001",
       "Clearing the history also acknowledges the errors in 1001h",
       {"OD-1003-16"},
       checking(0x1003, 0,
                [](Parts& parts, const Check& former, ByteView bytes) {
                  const Accepted cleared = former(bytes);
                  const std::vector<ErrorCause> causes = parts.emergency.active();
                  for (const ErrorCause& cause : causes) {
                    if (cleared) parts.device.errors.clear(cause);
                  }
                  return cleared;
                })},
      {"1003-error-not-recorded",
       "Errors are reported by EMCY, but not entered into 1003h",
       {"OD-1003-10", "EMCY-HIS-01"},
       shows_of_history([](const ErrorHistory&) { return std::vector<std::uint32_t>{}; })},
      {"1003-count-not-updated",
       "1003h:00 stays 00h while errors are recorded",
       {"OD-1003-10", "OD-1003-09", "EMCY-HIS-01"},
       reading(0x1003, 0, [](Parts&, const Read&) -> Upload { return Bytes{0}; })},
      {"1003-code-in-upper-half",
       "The error code stands in bits 31-16 of an entry of 1003h",
       {"OD-1003-11", "EMCY-HIS-01"},
       shows_in_field([](std::uint32_t field) { return field << 16U; })},
      {"1003-code-byte-swapped",
       "The error code in 1003h is in big-endian order",
       {"OD-1003-11", "EMCY-HIS-01"},
       shows_in_field([](std::uint32_t field) { return ((field & 0xFFU) << 8U) | ((field >> 8U) & 0xFFU); })},
      {"1003-oldest-first",
       "New errors are appended at the end of 1003h",
       {"OD-1003-12", "EMCY-HIS-02"},
       shows_of_history([](const ErrorHistory& history) {
         auto errors = newest_first(history);
         std::ranges::reverse(errors);
         return errors;
       })},
      {"1003-no-shift-overwrites",
       "A new error overwrites 1003h:01, older ones are lost",
       {"OD-1003-12", "EMCY-HIS-02"},
       shows_of_history([](const ErrorHistory& history) {
         auto errors = newest_first(history);
         errors.resize(std::min<std::size_t>(errors.size(), 1));
         return errors;
       })},
      {"1003-full-drops-newest",
       "A full history stops recording",
       {"OD-1003-13", "EMCY-HIS-05"},
       together(remembers_more_than_it_shows(), shows_of_history([](const ErrorHistory& history) {
                  auto errors = newest_first(history);
                  const auto surplus = std::max<std::ptrdiff_t>(std::ssize(errors) - ErrorHistory::fields, 0);
                  errors.erase(errors.begin(), errors.begin() + surplus);
                  return errors;
                }))},
      {"1003-count-exceeds-depth",
       "1003h:00 counts on beyond the depth of the array",
       {"OD-1003-13", "OD-1003-09", "EMCY-HIS-05"},
       remembers_more_than_it_shows()},
      {"1003-forgets-an-error-with-its-end",
       "The end of an error takes it out of the history",
       {"OD-1003-15", "OD-1003-10"},
       forgets_what_has_ended},
      {"1003-records-error-reset",
       "The end of all errors is entered into 1003h as error 0000h",
       {"OD-1003-15"},
       Change([](Parts& parts) {
         parts.device.errors.clear.replace([&parts](const auto& former, const ErrorCause& cause) {
           const bool present = !parts.emergency.active().empty();
           former(cause);
           if (present && parts.emergency.active().empty())
             parts.emergency.history.record(0, cause.source, 0);
         });
       })},
      {"1003-default-count-nonzero",
       "1003h holds an entry after every reset",
       {"OD-1003-04"},
       Change([](Parts& parts) {
         parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>&) {
           if (context.service == Service::boot_up)
             parts.emergency.history.record(0x1000, ErrorSource::application, 0);
         });
       })},
      {"1003-count-is-u32",
       "1003h:00 is an UNSIGNED32",
       {"OD-1003-01", "OD-GEN-10", "OD-1003-14"},
       type(0x1003, 0, DataType::unsigned32)},
      {"1003-no-sub1", "1003h has no sub-index 01h", {"OD-1003-02", "OD-CAT-02"}, absent_sub(0x1003, 1)},
      {"1003-field-writable", "1003h:01 can be written", {"OD-1003-08"}, access(0x1003, 1, Access::rw)},
      {"1003-field-write-wrong-abort",
       "Writing 1003h:01 is refused with 0609 0030h instead of 0601 0002h",
       {"OD-1003-08"},
       wrong_abort_at(mux(0x1003, 1), abort_code::read_only, abort_code::invalid_value)},
      {"1003-cleared-entries-come-back",
       "With the next error the entries are back that were cleared from 1003h",
       {"OD-1003-05"},
       Change(hides_what_was_cleared)},
      {"1003-cleared-errors-never-end",
       "Of an error whose entry in 1003h was cleared the end goes unnoticed",
       {"OD-1001-06"},
       Change(forgets_cleared_errors)},
      {"1003-same-error-not-recorded-again",
       "An error that comes again right behind itself is not recorded again",
       {"OD-1003-10"},
       shows_of_history([](const ErrorHistory& history) {
         auto errors = newest_first(history);
         const auto repeated = std::ranges::unique(errors);
         errors.erase(repeated.begin(), repeated.end());
         return errors;
       })},
      {"1003-any-count-in-operational",
       "In Operational any value that is written to 1003h:00 is confirmed",
       {"OD-1003-06"},
       checking(0x1003, 0,
                [](Parts& parts, const Check& former, ByteView bytes) -> Accepted {
                  const Accepted taken = former(bytes);
                  return parts.device.state == NmtState::operational ? Accepted{} : taken;
                })},
  };
}

}  // namespace refnode
