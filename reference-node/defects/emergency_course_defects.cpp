// SPDX-License-Identifier: Apache-2.0
// Finer defects of EMCY and of the error register: one error of several, and what happens later than the
// error.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "defects/emergencies.hpp"
#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

/// The error register for one error code only.
Change sets_bits_for(std::uint16_t code, std::uint8_t bits) {
  return decides(
      of_emergency_rules, &EmergencyRules::register_bits,
      [code, bits](const auto& former, std::uint16_t given) { return given == code ? bits : former(given); });
}

/// The EMCY of one error code only.
Filter changes_message_of(std::uint16_t code, void (*change)(Frame&)) {
  return [code, change](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::emergency) return;
    for (Outgoing& outgoing : frames) {
      if (conform::load_le(std::span(outgoing.frame.data).first(2)) == code) change(outgoing.frame);
    }
  };
}

/// An error that waits for the inhibit time when EMCY is made not valid is sent when that time is over.
void sends_what_waits(Parts& parts) {
  const auto waiting = std::make_shared<std::optional<std::uint16_t>>();
  parts.device.errors.raise.replace([waiting](const auto& former, const ErrorCause& cause, auto detail) {
    *waiting = cause.code;
    former(cause, detail);
  });
  parts.device.outbox.add_filter([waiting](const FilterContext& context, std::vector<Outgoing>&) {
    if (context.service == Service::emergency || context.service == Service::boot_up) waiting->reset();
  });
  after_writing(0x1014, 0, [waiting](Parts& node, const std::function<void()>& former) {
    former();
    const std::uint64_t cob_id = node.device.dictionary.number(0x1014, 0);
    if ((cob_id & 0x80000000U) == 0 || !*waiting) return;
    const std::uint16_t code = **waiting;
    const Frame frame = conform::can::data_frame(
        conform::CanId(static_cast<std::uint32_t>(cob_id & 0x7FFU)),
        {static_cast<std::uint8_t>(code & 0xFFU), static_cast<std::uint8_t>(code >> 8U), 1, 0, 0, 0, 0, 0});
    node.device.outbox.send(
        FilterContext{Service::emergency, node.device.node_id, node.device.state, nullptr},
        {{frame, std::chrono::milliseconds(node.device.dictionary.number(0x1015, 0) / 10)}}, node.device.now);
  })(parts);
}

/// While an error is there, entering `state` reports it once more.
Change again_on_entering(NmtState state) {
  return [state](Parts& parts) {
    const auto latest = std::make_shared<std::optional<Frame>>();
    parts.device.outbox.add_filter([latest](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service == Service::boot_up) latest->reset();
      if (context.service == Service::emergency && !frames.empty()) *latest = frames.back().frame;
    });
    parts.nmt.on_change = [&parts, latest, state, former = parts.nmt.on_change](NmtState from) {
      former(from);
      if (parts.device.state == state && *latest && parts.emergency.error_register() != 0)
        parts.device.send(Service::emergency, **latest);
    };
  };
}

/// The error that is there is reported again when the history is cleared.
Change again_when_history_is_cleared() {
  return [](Parts& parts) {
    const auto latest = std::make_shared<std::optional<Frame>>();
    parts.device.outbox.add_filter([latest](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service == Service::emergency && !frames.empty()) *latest = frames.back().frame;
    });
    checking(0x1003, 0, [latest](Parts& node, const Check& former, ByteView bytes) {
      Accepted taken = former(bytes);
      if (taken && *latest && node.emergency.error_register() != 0)
        node.device.send(Service::emergency, **latest);
      return taken;
    })(parts);
  };
}

/// The errors of one source are reported the first time only, until there is a reset.
Change reported_once(ErrorSource source) {
  return [source](Parts& parts) {
    const auto seen = std::make_shared<bool>(false);
    parts.device.errors.raise.replace(
        [seen, source](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
          if (cause.source == source && std::exchange(*seen, true)) return;
          former(cause, detail);
        });
    parts.device.outbox.add_filter([seen](const FilterContext& context, std::vector<Outgoing>&) {
      if (context.service == Service::boot_up) *seen = false;
    });
  };
}

/// When an error goes, 1001h loses its bits, also those that another error sets.
void clears_bits_of_others(Parts& parts) {
  const auto lost = std::make_shared<std::uint8_t>(std::uint8_t{0});
  parts.device.errors.clear.replace([&parts, lost](const auto& former, const ErrorCause& cause) {
    const std::size_t before = parts.emergency.active().size();
    former(cause);
    if (parts.emergency.active().size() < before)
      *lost = static_cast<std::uint8_t>(parts.emergency.rules.register_bits(cause.code) & 0xFEU);
  });
  parts.device.errors.raise.replace([lost](const auto& former, const ErrorCause& cause, auto detail) {
    *lost = 0;
    former(cause, detail);
  });
  reading(0x1001, 0, [lost](Parts&, const Read& former) {
    Upload bits = former();
    if (bits) bits->front() &= static_cast<std::uint8_t>(~*lost);
    return bits;
  })(parts);
  with_boot_up([lost](Parts&) { *lost = 0; })(parts);
}

bool is_present(const Parts& parts, const ErrorCause& cause) {
  const auto& active = parts.emergency.active();
  return std::ranges::find(active, cause) != active.end();
}

std::uint16_t code_of(const Frame& message) {
  return static_cast<std::uint16_t>(message.data[0] | (message.data[1] << 8U));
}

/// Of the errors that wait for the inhibit time the latest is reported.
void keeps_the_latest_only(Parts& parts) {
  const auto latest = std::make_shared<std::uint16_t>(std::uint16_t{0});
  parts.device.errors.raise.replace(
      [&parts, latest](const auto& former, const ErrorCause& cause, auto detail) {
        if (!is_present(parts, cause)) *latest = cause.code;
        former(cause, detail);
      });
  parts.device.outbox.add_filter([latest](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::emergency) return;
    std::erase_if(frames, [&](const Outgoing& each) {
      return code_of(each.frame) != 0 && code_of(each.frame) != *latest;
    });
  });
}

/// Whatever waits for the inhibit time is sent at its end, one message right behind the other.
void sends_all_after_the_inhibit_time(Parts& parts) {
  const auto at_once = std::make_shared<bool>(false);
  parts.device.errors.raise.replace([at_once](const auto& former, const ErrorCause& cause, auto detail) {
    *at_once = true;
    former(cause, detail);
    *at_once = false;
  });
  parts.device.errors.clear.replace([at_once](const auto& former, const ErrorCause& cause) {
    *at_once = true;
    former(cause);
    *at_once = false;
  });
  parts.emergency.rules.inhibit_time.replace([at_once](const auto& former, std::int64_t value) -> Duration {
    return *at_once ? former(value) : Duration::zero();
  });
}

/// Another NMT state ends the inhibit time: the error that waits is reported with it.
void inhibit_time_ends_with_the_state(Parts& parts) {
  struct Memory {
    std::optional<Frame> waiting;  ///< of the latest error
    std::optional<Frame> early;    ///< sent already
  };
  const auto memory = std::make_shared<Memory>();
  parts.device.errors.raise.replace(
      [&parts, memory](const auto& former, const ErrorCause& cause, auto detail) {
        if (is_present(parts, cause)) return;
        memory->waiting = Frame{};
        former(cause, detail);
        if (!memory->waiting) return;  // it has been sent
        memory->waiting = conform::can::data_frame(
            conform::CanId(static_cast<std::uint32_t>(parts.device.dictionary.number(0x1014, 0) & 0x7FFU)),
            {static_cast<std::uint8_t>(cause.code & 0xFFU), static_cast<std::uint8_t>(cause.code >> 8U),
             parts.emergency.error_register(), detail, static_cast<std::uint8_t>(cause.source), 0, 0, 0});
      });
  parts.device.outbox.add_filter([memory](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service == Service::boot_up) *memory = {};
    if (context.service != Service::emergency) return;
    memory->waiting.reset();
    std::erase_if(frames, [&](const Outgoing& each) {
      return memory->early && code_of(each.frame) == code_of(*memory->early);
    });
    memory->early.reset();
  });
  ahead_of_state_change([memory](Parts& node) {
    if (!memory->waiting || !node.device.works_now(Service::emergency)) return;
    const Frame frame = *memory->waiting;
    node.device.send(Service::emergency, frame);
    memory->early = frame;
  })(parts);
}

/// Bit 31 of 1014h means nothing before 1014h is written.
void valid_until_written(Parts& parts) {
  const auto written = written_since_boot_up(parts, {0x1014});
  parts.emergency.cob_id_rules.valid.replace(
      [written](const auto& former, std::uint32_t value) { return written->empty() || former(value); });
}

/// Behind the message of an end there is no inhibit time.
void end_begins_no_inhibit_time(Parts& parts) {
  const auto end = std::make_shared<bool>(false);
  parts.device.outbox.add_filter([end](const FilterContext& context, const std::vector<Outgoing>& frames) {
    if (context.service != Service::emergency || frames.empty()) return;
    const Frame& frame = frames.front().frame;
    *end = frame.data[0] == 0 && frame.data[1] == 0;
  });
  parts.emergency.rules.inhibit_time.replace(
      [end](const auto& former, std::int64_t value) { return *end ? Duration::zero() : former(value); });
}

/// An EMCY shows the bits of its own error, whatever else is wrong.
void shows_own_bits(Parts& parts) {
  parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::emergency) return;
    for (Outgoing& outgoing : frames) {
      auto& data = outgoing.frame.data;
      const auto code = static_cast<std::uint16_t>(data[0] | (data[1] << 8U));
      if (code != 0) data[2] = parts.emergency.rules.register_bits(code);
    }
  });
}

/// Of several errors the register, and every EMCY, shows the bits of one: `which` of those that are present.
Change shows_bits_of_one(const ErrorCause& (*which)(const std::vector<ErrorCause>& present)) {
  return [which](Parts& parts) {
    const auto shown = [&parts, which]() -> std::uint8_t {
      const auto& present = parts.emergency.active();
      return present.empty() ? 0 : parts.emergency.rules.register_bits(which(present).code);
    };
    reading(0x1001, 0, [shown](Parts&, const Read&) -> Upload { return Bytes{shown()}; })(parts);
    parts.device.outbox.add_filter([shown](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service != Service::emergency) return;
      for (Outgoing& outgoing : frames) outgoing.frame.data[2] = shown();
    });
  };
}

}  // namespace

DefectTable emergency_course_defects() {
  return {
      {"emcy-sent-when-switched-off-while-inhibited",
       "An EMCY that waits for the inhibit time is sent although 1014h is not valid any more",
       {"OD-1014-08"},
       sends_what_waits},
      {"1001-reserved-bit6-set-by-one-error",
       "A temperature error sets the reserved bit 6 of 1001h",
       {"OD-1001-03"},
       sets_bits_for(0x4210, 0x49)},
      {"1001-generic-bit-missing-in-one-error",
       "A device-specific error does not set the generic bit of 1001h",
       {"OD-1001-04", "OD-1001-05"},
       sets_bits_for(0xFF01, 0x80)},
      {"1001-not-set-by-one-error",
       "An external error does not show in 1001h",
       {"OD-1001-05"},
       sets_bits_for(0x9000, 0)},
      {"emcy-register-wrong-for-one-error",
       "The EMCY of a hardware error shows another error register than 1001h",
       {"EMCY-FMT-03"},
       changes_message_of(0x5000, [](Frame& frame) { frame.data[2] ^= 0x20U; })},
      {"emcy-code-swapped-for-one-error",
       "The EMCY of a mains voltage error has its code in big-endian order",
       {"EMCY-FMT-01"},
       changes_message_of(0x3110, [](Frame& frame) { std::swap(frame.data[0], frame.data[1]); })},
      {"emcy-short-for-one-error",
       "The EMCY of a software error has five bytes",
       {"EMCY-FMT-01"},
       changes_message_of(0x6100, [](Frame& frame) { frame.dlc = 5; })},
      {"emcy-again-at-start",
       "NMT start reports an error that is there once more",
       {"EMCY-SEQ-01"},
       again_on_entering(NmtState::operational)},
      {"emcy-again-in-pre-operational",
       "Entering Pre-operational reports an error that is there once more",
       {"EMCY-SEQ-01"},
       again_on_entering(NmtState::pre_operational)},
      {"emcy-again-with-cleared-history",
       "Clearing 1003h reports an error that is there once more",
       {"EMCY-SEQ-01"},
       again_when_history_is_cleared()},
      {"emcy-of-application-once",
       "The second error of the application is not reported, nor any later one",
       {"EMCY-SEQ-04"},
       reported_once(ErrorSource::application)},
      {"1001-shared-bit-cleared-with-one-error",
       "When one of two errors goes, 1001h loses the bit that both set",
       {"OD-1001-05"},
       Change(clears_bits_of_others)},
      {"emcy-latest-kept-while-inhibited",
       "Of the errors that come during the inhibit time only the last one is reported",
       {"EMCY-SEQ-04"},
       Change(keeps_the_latest_only)},
      {"emcy-burst-after-inhibit-time",
       "What waits for the inhibit time of 1015h is sent all at once when it is over",
       {"EMCY-INH-01"},
       Change(sends_all_after_the_inhibit_time)},
      {"emcy-inhibit-time-ends-with-nmt-state",
       "A change of the NMT state ends the inhibit time of 1015h",
       {"EMCY-INH-01"},
       Change(inhibit_time_ends_with_the_state)},
      {"1001-bits-of-first-error-only",
       "Of several errors the error register shows the bits of the first",
       {"OD-1001-05"},
       shows_bits_of_one(
           [](const std::vector<ErrorCause>& present) -> const ErrorCause& { return present.front(); })},
      {"1001-bits-of-last-error-only",
       "Of several errors the error register shows the bits of the last",
       {"OD-1001-05"},
       shows_bits_of_one(
           [](const std::vector<ErrorCause>& present) -> const ErrorCause& { return present.back(); })},
      {"1015-15-bits", "Of the inhibit time of EMCY 15 bits count", {"EMCY-INH-01"}, Change([](Parts& parts) {
         parts.emergency.rules.inhibit_time.replace(
             [](const auto& former, std::int64_t value) { return former(value & 0x7FFF); });
       })},
      {"emcy-end-begins-no-inhibit-time",
       "The message that all errors are gone begins no inhibit time",
       {"EMCY-INH-01"},
       Change(end_begins_no_inhibit_time)},
      {"emcy-register-of-own-error-only",
       "The error register in an EMCY has the bits of that error only",
       {"EMCY-FMT-03"},
       Change(shows_own_bits)},
      {"1014-stored-valid-bit-ignored",
       "An EMCY that was stored as not valid is sent until 1014h is written",
       {"OD-1014-08"},
       Change(valid_until_written)},
  };
}

}  // namespace refnode
