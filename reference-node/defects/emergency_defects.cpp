// SPDX-License-Identifier: Apache-2.0
// Defects of the error register 1001h and of the EMCY producer.
#include <chrono>
#include <memory>
#include <utility>

#include "defects/emergencies.hpp"
#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

CobIdRules& of_emergency(Parts& parts) { return parts.emergency.cob_id_rules; }

/// What an error of this source has set in 1001h only its end clears, or nothing at all.
Change register_outlives_reset(ErrorSource source, bool ends = true) {
  return [=](Parts& parts) {
    const auto left = std::make_shared<std::uint8_t>(0);
    parts.device.errors.raise.replace([=, &parts](const auto& former, const ErrorCause& cause, auto detail) {
      former(cause, detail);
      if (cause.source == source) *left = parts.emergency.error_register();
    });
    parts.device.errors.clear.replace([=](const auto& former, const ErrorCause& cause) {
      if (cause.source == source && ends) *left = 0;
      former(cause);
    });
    reading(0x1001, 0, [left](Parts&, const Read& former) {
      Upload shown = former();
      if (shown) shown->front() |= *left;
      return shown;
    })(parts);
  };
}

/// Other bits of the error register for an error than those of table 54.
Change sets_bits(int (*changed)(std::uint8_t bits)) {
  return decides(of_emergency_rules, &EmergencyRules::register_bits,
                 [changed](const auto& former, std::uint16_t code) {
                   return static_cast<std::uint8_t>(changed(former(code)));
                 });
}

Change inhibit_time(Duration (*other)(std::int64_t value)) {
  return decides(of_emergency_rules, &EmergencyRules::inhibit_time,
                 [other](const auto&, std::int64_t value) { return other(value); });
}

/// Once there has been an error the generic bit stays, until reset node.
Change keeps_generic_bit() {
  return [](Parts& parts) {
    const auto raised = std::make_shared<bool>(false);
    parts.device.errors.raise.replace(
        [raised](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
          *raised = true;
          former(cause, detail);
        });
    const auto shown = [raised](std::uint8_t bits) {
      return bits == 0 && *raised ? std::uint8_t{0x01} : bits;
    };
    reading(0x1001, 0, [shown](Parts&, const Read& former) {
      Upload bits = former();
      if (bits) bits->front() = shown(bits->front());
      return bits;
    })(parts);
    parts.device.inbox.add_filter([raised, id = parts.device.node_id](std::vector<Frame>& frames) {
      for (const Frame& frame : frames) {
        const bool reset_node = frame.id == 0 && frame.size() == 2 && frame.data[0] == 0x81;
        if (reset_node && (frame.data[1] == 0 || frame.data[1] == id)) *raised = false;
      }
    });
    parts.device.outbox.add_filter([shown](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service != Service::emergency) return;
      for (Outgoing& outgoing : frames) outgoing.frame.data[2] = shown(outgoing.frame.data[2]);
    });
  };
}

/// Only who reads the entry sees what is left.
void keeps_profile_bit(Parts& parts) {
  const auto raised = std::make_shared<bool>(false);
  parts.device.errors.raise.replace(
      [raised](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
        *raised = true;
        former(cause, detail);
      });
  reading(0x1001, 0, [raised](Parts&, const Read& former) {
    Upload bits = former();
    if (bits && *raised) bits->front() |= 0x20;
    return bits;
  })(parts);
}

/// What comes while the inhibit time runs is not kept for its end.
Change lost_while_inhibited() {
  return [](Parts& parts) {
    const auto inhibited_until = std::make_shared<BusTime>();
    const auto inhibit = parts.emergency.rules.inhibit_time;
    parts.emergency.rules.inhibit_time.replace([](const auto&, std::int64_t) { return Duration::zero(); });
    parts.device.outbox.add_filter(
        [&parts, inhibited_until, inhibit](const FilterContext& context, std::vector<Outgoing>& frames) {
          if (context.service == Service::boot_up) *inhibited_until = {};
          if (context.service != Service::emergency) return;
          if (context.now < *inhibited_until) return frames.clear();
          *inhibited_until = context.now + inhibit(parts.device.time_value(0x1015, 0));
        });
  };
}

void inhibits_with_zero(Parts& parts) {
  const auto written = std::make_shared<bool>(false);
  after_writing(0x1015, 0, [written](Parts& node, const std::function<void()>& former) {
    *written = node.device.dictionary.number(0x1015, 0) == 0;
    former();
  })(parts);
  parts.device.outbox.add_filter([written](const FilterContext& context, std::vector<Outgoing>&) {
    if (context.service == Service::boot_up) *written = false;
  });
  parts.emergency.rules.inhibit_time.replace([written](const auto& former, std::int64_t value) -> Duration {
    constexpr Duration left_over = std::chrono::milliseconds(400);
    return *written && value == 0 ? left_over : former(value);
  });
}

/// A remote frame with the CAN-ID of EMCY gets the present error register in an EMCY.
void answers_remote_frames(Parts& parts, std::vector<Frame>& frames) {
  const auto cob_id = static_cast<std::uint32_t>(parts.device.dictionary.number(0x1014, 0));
  for (const Frame& frame : frames) {
    if (!frame.remote || frame.extended || frame.id != cob_id) continue;
    parts.device.send(Service::emergency,
                      conform::can::data_frame(conform::CanId(cob_id),
                                               {0, 0, parts.emergency.error_register(), 0, 0, 0, 0, 0}));
  }
}

/// The producer has its COB-ID from elsewhere; whoever asks for 1014h learns that it does not exist.
void hides_cob_id(Parts& parts) {
  static constexpr conform::Index hidden(0x1014);
  ObjectDictionary& od = parts.device.dictionary;
  od.upload.replace([](const auto& former, Multiplexer mux) -> Upload {
    return mux.index == hidden ? Upload(refuse(abort_code::no_object)) : former(mux);
  });
  od.may_download.replace([](const auto& former, Multiplexer mux, auto size) -> Accepted {
    return mux.index == hidden ? Accepted(refuse(abort_code::no_object)) : former(mux, size);
  });
  od.download.replace([](const auto& former, Multiplexer mux, ByteView bytes) -> Accepted {
    return mux.index == hidden ? Accepted(refuse(abort_code::no_object)) : former(mux, bytes);
  });
}

}  // namespace

DefectTable emergency_defects() {
  return {
      {"emcy-without-1014",
       "Emergency messages come on 080h + node-ID, and 1014h does not exist",
       {"OD-1014-01", "OD-CAT-03", "OD-GEN-17"},
       Change(hides_cob_id)},
      {"errors-never-clear",
       "An error stays until the next reset, whatever becomes of its cause",
       {"EMCY-SEQ-02", "OD-1001-06", "EC-HBC-07"},
       Change(
           [](Parts& parts) { parts.device.errors.clear.replace([](const auto&, const ErrorCause&) {}); })},
      {"1001-not-set-on-error",
       "1001h stays 00h while errors are present",
       {"OD-1001-05", "EMCY-FMT-04"},
       sets_bits([](std::uint8_t) { return 0x00; })},
      {"1001-specific-bit-without-generic",
       "1001h lacks the generic bit 0",
       {"OD-1001-04", "EMCY-FMT-04", "OD-1001-05"},
       sets_bits([](std::uint8_t bits) { return bits & 0xFE; })},
      {"1001-reserved-bit6-set",
       "1001h has the reserved bit 6 set with every error",
       {"OD-1001-03", "EMCY-FMT-04"},
       sets_bits([](std::uint8_t bits) { return bits | 0x40; })},
      {"1001-not-cleared-on-recovery",
       "1001h keeps bit 0 after all errors have gone",
       {"OD-1001-06", "EMCY-SEQ-02", "EC-HBC-07"},
       keeps_generic_bit()},
      {"1001-keeps-a-bit-that-emcy-has-cleared",
       "1001h keeps bit 5 after the first error, while EMCY 0000h tells 00h",
       {"EMCY-FMT-03", "EMCY-SEQ-02", "OD-1001-06"},
       keeps_profile_bit},
      {"1001-differs-from-emcy",
       "EMCY always shows 01h as error register",
       {"OD-1001-07", "EMCY-FMT-03"},
       reshape(Service::emergency,
               [](const FilterContext&, Frame& frame) {
                 if (frame.data[0] != 0 || frame.data[1] != 0) frame.data[2] = 0x01;
               })},
      {"emcy-register-empty-for-sync-and-rpdo",
       "EMCY 82xxh shows 00h as error register",
       {"EMCY-FMT-04", "EMCY-FMT-03"},
       reshape(Service::emergency,
               [](const FilterContext&, Frame& frame) {
                 if (frame.data[1] == 0x82) frame.data[2] = 0x00;
               })},
      {"emcy-rpdo-class-undefined",
       "An RPDO that is too short is reported with the undefined code D210h",
       {"EMCY-FMT-02", "PDO-RX-06"},
       reshape(Service::emergency,
               [](const FilterContext&, Frame& frame) {
                 if (frame.data[0] == 0x10 && frame.data[1] == 0x82) frame.data[1] = 0xD2;
               })},
      {"error-register-bit-wrong",
       "Communication errors do not set bit 4 of 1001h",
       {"EMCY-FMT-05"},
       sets_bits([](std::uint8_t bits) { return bits & ~0x10; })},
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
       {"EMCY-FMT-02", "EC-HBC-03", "OD-1003-11", "EMCY-FMT-01"},
       reshape(Service::emergency,
               [](const FilterContext&, Frame& frame) {
                 if (frame.data[1] != 0) frame.data[1] = 0xA0;
               })},
      {"emcy-repeated", "Every EMCY is sent twice", {"EMCY-SEQ-01", "EC-HBC-10"}, repeat(Service::emergency)},
      {"emcy-reset-missing",
       "The end of all errors is not reported",
       {"EMCY-SEQ-02", "EC-HBC-07"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.service == Service::emergency) std::erase_if(frames, is_error_reset);
       })},
      {"emcy-reset-register-cleared-too-early",
       "When one of several errors goes, EMCY 0000h claims that none is left",
       {"EMCY-SEQ-05"},
       together([](Parts& parts) { parts.emergency.choices.error_reset_for_each = true; },
                reshape(Service::emergency,
                        [](const FilterContext&, Frame& frame) {
                          if (is_error_reset({frame, {}})) frame.data[2] = 0x00;
                        }))},
      {"emcy-second-error-suppressed",
       "While one error is present a second is not reported",
       {"EMCY-SEQ-04"},
       Change([](Parts& parts) {
         parts.device.outbox.add_filter(
             [&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
               if (context.service != Service::emergency || parts.emergency.active().size() < 2) return;
               std::erase_if(frames, [](const Outgoing& outgoing) { return !is_error_reset(outgoing); });
             });
       })},
      {"emcy-sent-in-stopped",
       "EMCY is sent in Stopped",
       {"EMCY-NMT-01", "NMT-FSA-23"},
       works_also(Service::emergency, NmtState::stopped)},
      {"emcy-all-of-stopped-afterwards",
       "All EMCYs of Stopped are sent when it ends, in their order",
       {"EMCY-NMT-01"},
       Change([](Parts& parts) {
         parts.emergency.rules.only_latest_of_stopped.replace([](const auto&) { return false; });
       })},
      {"emcy-dead-in-preop",
       "EMCY is not sent in Pre-operational",
       {"EMCY-NMT-02"},
       mute(Service::emergency, NmtState::pre_operational)},
      {"1014-sends-emcy-when-invalid",
       "EMCY is sent although 1014h says that it does not exist",
       {"OD-1014-08", "EMCY-COB-03"},
       decides(of_emergency, &CobIdRules::valid, [](const auto&, std::uint32_t) { return true; })},
      {"1015-inhibit-ignored",
       "The inhibit time of 1015h has no effect",
       {"OD-1015-03", "EMCY-INH-01"},
       inhibit_time([](std::int64_t) -> Duration { return std::chrono::microseconds(0); })},
      {"1015-unit-10us",
       "1015h counts in 10 us",
       {"OD-1015-03", "EMCY-INH-01"},
       inhibit_time([](std::int64_t value) -> Duration { return std::chrono::microseconds(value * 10); })},
      {"1015-written-zero-inhibits",
       "When 0 is written to 1015h an EMCY inhibits the next for 400 ms, until a reset",
       {"EMCY-INH-02"},
       Change(inhibits_with_zero)},
      {"emcy-answers-remote-frame",
       "A remote frame with the CAN-ID of EMCY is answered",
       {"EMCY-COB-06"},
       Reading(answers_remote_frames)},
      {"emcy-lost-while-inhibited",
       "Errors that come during the inhibit time of 1015h are never reported",
       {"EMCY-INH-01", "EMCY-SEQ-04"},
       lost_while_inhibited()},
      {"emcy-without-error",
       "EMCY 1000h follows the boot-up message although there is no error",
       {"EMCY-SEQ-03"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.service != Service::boot_up) return;
         frames.push_back({conform::can::data_frame(conform::CanId(0x80U + context.node_id),
                                                    {0x00, 0x10, 0, 0, 0, 0, 0, 0}),
                           {}});
       })},
      {"1001-outlives-reset-communication",
       "The bits of 1001h for a lost heartbeat stay over reset communication",
       {"OD-1001-06"},
       register_outlives_reset(ErrorSource::heartbeat)},
      {"1001-of-guarding-outlives-reset",
       "The bits of 1001h for guard requests that stayed away stay over reset communication",
       {"OD-1001-06"},
       register_outlives_reset(ErrorSource::guarding)},
      {"1001-of-guarding-for-ever",
       "The bits of 1001h for guard requests that stayed away are never cleared",
       {"OD-1001-06"},
       register_outlives_reset(ErrorSource::guarding, false)},
      {"1001-empty-while-emcy-not-valid",
       "1001h shows no error while 1014h is not valid",
       {"OD-1001-05"},
       reading(0x1001, 0,
               [](Parts& parts, const Read& former) -> Upload {
                 const bool off = (parts.device.dictionary.number(0x1014, 0) & 0x8000'0000U) != 0;
                 return off ? Upload(Bytes{0}) : former();
               })},
      {"errors-unnoticed-in-operational",
       "An error of the application that begins in Operational is not noticed",
       {"EMCY-SEQ-01", "OD-1001-05"},
       Change([](Parts& parts) {
         parts.device.errors.raise.replace(
             [&parts](const auto& former, const ErrorCause& cause, auto detail) {
               const bool application = cause.source == ErrorSource::application;
               if (!application || parts.device.state != NmtState::operational) former(cause, detail);
             });
       })},
      {"errors-stay-in-operational",
       "An error of the application does not end in Operational",
       {"OD-1001-06"},
       Change([](Parts& parts) {
         parts.device.errors.clear.replace([&parts](const auto& former, const ErrorCause& cause) {
           const bool application = cause.source == ErrorSource::application;
           if (!application || parts.device.state != NmtState::operational) former(cause);
         });
       })},
      {"emcy-silent-in-operational",
       "No EMCY is sent in Operational",
       {"EMCY-SEQ-01"},
       mute(Service::emergency, NmtState::operational)},
  };
}

}  // namespace refnode
