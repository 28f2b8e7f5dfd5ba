// SPDX-License-Identifier: Apache-2.0
// EMCY, its history and its consumer.
#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

namespace {

/// After boot-up, one EMCY 0000h, unless there is an error.
void announce_no_error(Parts& parts) {
  parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::boot_up || frames.empty() || parts.emergency.error_register() != 0)
      return;
    frames.push_back({conform::can::data_frame(conform::CanId(0x80U + context.node_id),
                                               {0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00}),
                      std::chrono::milliseconds(2)});
  });
}

/// Bytes 3 to 7 are the manufacturer's.
void fill_manufacturer_bytes(Parts& parts) {
  parts.device.outbox.add_filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::emergency) return;
    for (Outgoing& outgoing : frames) {
      for (std::size_t i = 3; i < 8; ++i) outgoing.frame.data[i] = static_cast<std::uint8_t>(0xA0U + i);
    }
  });
}

/// What follows from the loss is an error of the maker's own.
void second_error_of_a_loss(Parts& parts) {
  const auto followed = [](const ErrorCause& cause) { return cause.code == 0x8130; };
  const auto second = [](const ErrorCause& cause) {
    return ErrorCause{0xFF30, cause.source, cause.instance};
  };
  parts.device.errors.raise.replace([=](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
    former(cause, detail);
    if (followed(cause)) former(second(cause), detail);
  });
  parts.device.errors.clear.replace([=](const auto& former, const ErrorCause& cause) {
    if (followed(cause)) former(second(cause));
    former(cause);
  });
}

/// Some power is missing, which is of interest in Operational only.
void error_in_operational(Parts& parts) {
  parts.nmt.on_change = [&parts, former = parts.nmt.on_change](NmtState from) {
    constexpr ErrorCause no_power{0xFF20, ErrorSource::application, 7};
    former(from);
    if (parts.device.state == NmtState::operational)
      parts.device.errors.raise(no_power, 1);
    else
      parts.device.errors.clear(no_power);
  };
}

/// The voltage is too low for a moment at each boot-up.
void low_voltage_at_boot_up(Parts& parts) {
  parts.nmt.on_boot_up = [&errors = parts.device.errors, former = parts.nmt.on_boot_up] {
    constexpr ErrorCause low_voltage{0x3110, ErrorSource::application, 1};
    former();
    errors.raise(low_voltage, 0);
    errors.clear(low_voltage);
  };
}

/// Whatever the error is, it ends Operational. There is no 1029h to say otherwise.
void error_ends_operational(Parts& parts) {
  absent({0x1029})(parts);
  parts.device.errors.raise.replace(
      [&parts](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
        former(cause, detail);
        if (parts.device.state == NmtState::operational) parts.nmt.enter(NmtState::pre_operational);
      });
}

/// And there is none while an error lasts.
void error_prevents_operational(Parts& parts) {
  error_ends_operational(parts);
  parts.nmt.on_change = [&parts, former = parts.nmt.on_change](NmtState from) {
    former(from);
    if (parts.device.state == NmtState::operational && parts.emergency.error_register() != 0)
      parts.nmt.enter(NmtState::pre_operational);
  };
}

/// One flag for all errors of a kind: the first sets it, and it goes with the last of them.
void one_flag_for_a_kind(Parts& parts) {
  const auto alike = std::make_shared<std::vector<ErrorCause>>();
  const auto flag_of = [](const ErrorCause& cause) { return ErrorCause{cause.code, cause.source, 1}; };
  Errors& errors = parts.device.errors;
  errors.raise.replace([alike, flag_of](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
    if (cause.source == ErrorSource::application) return former(cause, detail);
    if (std::ranges::find(*alike, cause) == alike->end()) alike->push_back(cause);
    former(flag_of(cause), detail);
  });
  errors.clear.replace([alike, flag_of](const auto& former, const ErrorCause& cause) {
    if (cause.source == ErrorSource::application) return former(cause);
    std::erase(*alike, cause);
    const auto same_kind = [&](const ErrorCause& other) { return flag_of(other) == flag_of(cause); };
    if (std::ranges::none_of(*alike, same_kind)) former(flag_of(cause));
  });
  parts.nmt.on_reset = [alike, former = parts.nmt.on_reset](Reset kind) {
    alike->clear();
    former(kind);
  };
}

/// Each frame that is wrong is an error of its own; the next right one ends them all.
void an_error_for_each_frame(Parts& parts) {
  struct Seen {
    ErrorCause as;
    ErrorCause told;
  };
  const auto seen = std::make_shared<std::vector<Seen>>();
  const auto count = std::make_shared<std::uint16_t>(0);
  Errors& errors = parts.device.errors;
  errors.raise.replace([seen, count](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
    if (cause.source != ErrorSource::rpdo && cause.source != ErrorSource::sync) return former(cause, detail);
    *count = static_cast<std::uint16_t>(*count + 1U);
    seen->push_back({cause, {cause.code, cause.source, *count}});
    former(seen->back().told, detail);
  });
  errors.clear.replace([seen](const auto& former, const ErrorCause& cause) {
    if (cause.source != ErrorSource::rpdo && cause.source != ErrorSource::sync) return former(cause);
    for (const Seen& each : *seen) {
      if (each.as == cause) former(each.told);
    }
    std::erase_if(*seen, [&](const Seen& each) { return each.as == cause; });
  });
  parts.nmt.on_reset = [seen, former = parts.nmt.on_reset](Reset kind) {
    seen->clear();
    former(kind);
  };
}

/// A frame that was wrong, or an RPDO that was late, stays an error until a reset.
void errors_of_frames_stay(Parts& parts) {
  parts.device.errors.clear.replace([](const auto& former, const ErrorCause& cause) {
    if (cause.code >> 8U != 0x82) former(cause);
  });
}

}  // namespace

VariantTable emergency_variants() {
  return {
      {"1003-absent", "no error history", "7.5.2.4: optional", absent({0x1003}), "1003"},
      {"1003-depth-1", "a history of one error", "7.5.2.4: 1 to 254 fields",
       both(absent_from(0x1003, 2), [](Parts& node) { node.emergency.history.choices.depth = 1; }), "1003"},
      {"1003-depth-2", "a history of two errors", "7.5.2.4: 1 to 254 fields",
       both(absent_from(0x1003, 3), [](Parts& node) { node.emergency.history.choices.depth = 2; }), "1003"},
      {"1003-depth-7", "a history of seven errors", "7.5.2.4: 1 to 254 fields",
       both(absent_from(0x1003, 8), [](Parts& node) { node.emergency.history.choices.depth = 7; }), "1003"},
      {.id = "emcy-absent",
       .summary = "no EMCY: 1014h and 1015h absent",
       .legal = "7.2.7.1: optional",
       .how = absent({0x1014, 0x1015}),
       .group = "emcy",
       // What ends Operational there would be told by nothing.
       .excludes = {"like-canopennode"},
       .lacks = {"emcy"}},
      {.id = "emcy-absent-nothing-is-an-error",
       .summary = "no EMCY and no history, and 1001h stays 0 where others see a communication error",
       .legal = "7.2.7.1: optional; 7.2.8.3.2.2: the application is told, no more",
       .how = both(absent({0x1003, 0x1014, 0x1015}),
                   [](Parts& parts) {
                     parts.device.errors.raise.replace(
                         [](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
                           if (cause.source == ErrorSource::application) former(cause, detail);
                         });
                   }),
       .group = "emcy",
       .excludes = {"like-canopennode"},
       .lacks = {"emcy"}},
      {.id = "emcy-in-operational",
       .summary = "an error of the application that is there in Operational only",
       .legal = "7.2.7.1: an EMCY when the error occurs; NMT-FSA-01: 1001h shows it",
       .how = error_in_operational,
       // With those that an error leads out of Operational it would never be there.
       .excludes = {"self-starting", "error-ends-operational", "error-prevents-operational", "1029-stops",
                    "like-canopennode", "emcy-late", "emcy-late-20ms", "rpdos-deadline-200ms",
                    "heartbeat-restarts-at-state-change"}},
      {"emcy-late-90ms", "EMCYs leave 90 ms after their error", "7.2.7: no time is set",
       late(Service::emergency, std::chrono::milliseconds(90)), "emcy-late"},
      {"emcy-0000-late-300ms",
       "the end of an error is told 300 ms later",
       "7.2.7: no time is set",
       [](Parts& node) { node.emergency.choices.error_reset_delay = std::chrono::milliseconds(300); },
       "emcy-late",
       {"rpdos-deadline-200ms"}},
      {"emcy-second-of-the-maker",
       "a second error, FF30h, goes with each loss of a heartbeat or of the guarding",
       "7.2.7: table 26 leaves FFxxh to the device",
       second_error_of_a_loss,
       {},
       {"emcy-absent-nothing-is-an-error", "1003", "1015", "like-canopen-stack"}},
      {"1015-absent", "no EMCY inhibit time", "7.5.2.18: optional", absent({0x1015}), "1015"},
      {"1014-const", "the COB-ID of EMCY cannot be changed", "OD-1014-09",
       access(0x1014, 0, Access::constant)},
      {"1014-not-valid",
       "no EMCY by default",
       "OD-1014-02: bit 31 is not judged",
       preset_with_node_id(0x1014, 0, 0x80000080),
       "1014-default",
       {"1014-const"}},
      {.id = "1015-10ms",
       .summary = "an EMCY inhibit time of 10 ms by default",
       .legal = "OD-1015-02, tolerated: a profile-specific default",
       .how = preset(0x1015, 0, 100),
       .group = "1015",
       .warns = {"OD-1015-02"}},
      {.id = "1015-100ms",
       .summary = "an EMCY inhibit time of 100 ms by default",
       .legal = "OD-1015-02, tolerated: a profile-specific default",
       .how = preset(0x1015, 0, 1000),
       .group = "1015",
       .warns = {"OD-1015-02"}},
      {.id = "1015-1s",
       .summary = "an EMCY inhibit time of 1 s by default",
       .legal = "OD-1015-02, tolerated: a profile-specific default",
       .how = preset(0x1015, 0, 10000),
       .group = "1015",
       .warns = {"OD-1015-02"}},
      {"abort-empty-history-0800-0000", "an empty history is a general error", "OD-1003-03",
       [](Parts& node) {
         node.emergency.history.choices.nothing_recorded = node.emergency.history.choices.unused_field =
             abort_code::general_error;
       }},
      {"abort-unused-history-0609-0011",
       "an unused field of the history does not exist",
       "OD-1003-05, OD-1003-09",
       [](Parts& node) { node.emergency.history.choices.unused_field = abort_code::no_sub_index; },
       {},
       {"abort-empty-history-0800-0000"}},
      {.id = "register-generic-only",
       .summary = "the error register has bit 0 only",
       .legal = "7.5.2.2: all others are optional; EMCY-FMT-05 is a recommendation",
       .how = [](Parts& node) { node.emergency.choices.register_generic_only = true; },
       .warns = {"EMCY-FMT-05"}},
      {"error-reset-for-each", "EMCY 0000h for each error that goes, with what is left", "EMCY-SEQ-05",
       [](Parts& node) { node.emergency.choices.error_reset_for_each = true; }},
      {"emcy-dropped-in-stopped", "EMCYs of Stopped are not made up for", "EMCY-NMT-01",
       [](Parts& node) { node.emergency.choices.dropped_in_stopped = true; }},
      {.id = "emcy-completed-when-sent",
       .summary =
           "the error register of an EMCY, and the manufacturer's half of its field in 1003h, are those "
           "of the moment it is sent",
       .legal = "7.2.7.1: no moment is named; EMCY-FMT-04 warns where the error is over by then",
       .how = [](Parts& node) { node.emergency.choices.completed_when_sent = true; },
       .warns = {"EMCY-FMT-04"}},
      {"emcy-overflow-told",
       "where seven EMCYs wait, the next ones are lost, which is an error 1000h until all are sent",
       "7.2.7: how many may wait is not said",
       [](Parts& node) { node.emergency.choices.overflow_told_from = 7; }},
      {.id = "emcy-low-voltage-at-boot-up",
       .summary = "a voltage too low for a moment at each boot-up: EMCY 3110h, EMCY 0000h",
       .legal = "7.2.7: an error may come and go at any time; EMCY-SEQ-03 warns",
       .how = low_voltage_at_boot_up,
       // Its EMCYs would come long after a reset, in whatever case that is.
       .excludes = {"emcy-no-error-at-boot-up", "1015-1s", "1015-runs-from-setting", "emcy-late"},
       .warns = {"EMCY-SEQ-03", "OD-1003-04", "EC-NG-08", "EC-HBC-02"}},
      {.id = "error-ends-operational",
       .summary = "any error ends Operational: the device is Pre-operational then",
       .legal = "7.3.2.2: the application may change the state; 7.5.2.32: 1029h is optional",
       .how = error_ends_operational,
       .group = "1029",
       .excludes = {"self-starting", "outputs-fall", "sync-loss-reported", "rpdo-too-long-reported"},
       .lacks = {"error behaviour"},
       .warns = {"PDO-RX-14"}},
      {.id = "error-prevents-operational",
       .summary = "any error ends Operational, and while it lasts a start leads back to Pre-operational",
       .legal = "7.3.2.2: the application may change the state; 7.5.2.32: 1029h is optional",
       .how = error_prevents_operational,
       .group = "1029",
       .excludes = {"self-starting", "outputs-fall", "sync-loss-reported", "rpdo-too-long-reported"},
       .lacks = {"error behaviour"},
       .warns = {"PDO-RX-14"}},
      {.id = "1003-records-error-resets",
       .summary = "EMCY 0000h is recorded in 1003h, too",
       .legal = "OD-1003-15 tolerates it",
       .how = [](Parts& node) { node.emergency.choices.error_resets_recorded = true; },
       .warns = {"OD-1003-15"}},
      {"1015-runs-from-setting",
       "the first EMCY waits for the inhibit time, too, from its setting on",
       "7.2.7.1: the time is the least between two; nothing is said of the first",
       [](Parts& node) { node.emergency.choices.inhibited_from_setting = true; },
       {},
       {"1015"}},
      {.id = "emcy-once-for-a-kind",
       .summary = "errors of one kind are one error: the first is reported, and the end of the last",
       .legal = "7.2.7.1: once for an error; PDO-RX-14 warns",
       .how = one_flag_for_a_kind,
       .warns = {"PDO-RX-14"}},
      {.id = "emcy-for-each-frame",
       .summary = "each SYNC or RPDO of a wrong length is an error of its own",
       .legal = "EMCY-SEQ-01: once for an error event",
       .how = an_error_for_each_frame,
       .excludes = {"emcy-once-for-a-kind"}},
      {.id = "errors-of-frames-stay",
       .summary = "an error of a SYNC or an RPDO stays until a reset",
       .legal = "7.2.7: when an error is over, the device says",
       .how = errors_of_frames_stay,
       .warns = {"EMCY-SEQ-02", "PDO-RX-14"}},
      {.id = "emcy-late-20ms",
       .summary = "EMCYs are sent 20 ms late",
       .legal = "7.2.7: no time is given",
       .how = late(Service::emergency, std::chrono::milliseconds(20)),
       .excludes = {"emcy-low-voltage-at-boot-up", "emcy-late"}},
      {"emcy-manufacturer-bytes", "bytes 3 to 7 of an EMCY are in use", "EMCY-FMT-01",
       fill_manufacturer_bytes},
      {"history-of-signalled-errors",
       "an error that no EMCY can tell of is not recorded",
       "7.5.2.4: errors that have occurred and were signalled by EMCY",
       [](Parts& node) { node.emergency.choices.only_signalled_recorded = true; },
       {},
       {"1003-absent"}},
      {.id = "emcy-no-error-at-boot-up",
       .summary = "EMCY 0000h after boot-up where there is no error",
       .legal = "EMCY-SEQ-03, tolerated",
       .how = announce_no_error,
       .excludes = {"emcy", "1014-not-valid"},
       .warns = {"EMCY-SEQ-03"}},
      {.id = "1028-absent",
       .summary = "consumes no EMCY",
       .legal = "7.5.2.31: optional",
       .how = absent({0x1028, 0x2F11}),
       .group = "1028",
       .lacks = {"emcy consumer"}},
      {"1028-one", "consumes the EMCY of node 1", "7.5.2.31: 01h to 7Fh", absent_from(0x1028, 2), "1028"},
      {"1028-gap", "consumes the EMCY of the nodes 1, 3 and 4", "OD-1028-03: gaps are tolerated",
       gap(0x1028, 2), "1028"},
      {"1028-const", "which EMCY are consumed is fixed", "OD-1028-08",
       access_all(0x1028, Access::rw, Access::constant), "1028"},
      {"abort-1028-bit-30-0609-0031", "reserved bit 30 of 1028h: value too high",
       "7.5.2.31: no code is named",
       [](Parts& node) { node.emergencies.cob_id_rules.choices.fixed_bit = abort_code::value_too_high; }},
  };
}

}  // namespace refnode
