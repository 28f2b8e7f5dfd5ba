// SPDX-License-Identifier: Apache-2.0
// Choices that few devices make, and that the standard leaves to them all the same.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "variants/rare_habits.hpp"
#include "variants/tools.hpp"

namespace refnode {

using namespace variant;
using std::chrono::milliseconds;

namespace {

/// A memory that keeps the processor busy: nothing is taken and nothing is sent meanwhile.
How deaf_while_storing(Duration time) {
  return [time](Parts& parts) {
    const auto until = std::make_shared<BusTime>();
    parts.device.inbox.add_filter([&device = parts.device, until](std::vector<Frame>& frames) {
      if (device.now >= *until) return;
      for (const Frame& frame : frames) device.inbox.put(frame, *until);
      frames.clear();
    });
    parts.device.outbox.add_filter([time, until](const FilterContext& context,
                                                 std::vector<Outgoing>& frames) {
      const bool stores = context.sdo != nullptr && !context.sdo->aborted && ends_a_download(*context.sdo) &&
                          (context.sdo->index() == 0x1010 || context.sdo->index() == 0x1011);
      if (stores) *until = context.now + time;
      if (context.now >= *until) return;
      for (Outgoing& outgoing : frames) outgoing.delay += *until - context.now;
    });
    parts.nmt.on_reset = [until, former = parts.nmt.on_reset](Reset kind) {
      *until = {};
      former(kind);
    };
  };
}

/// What this sub-index says it cannot do it refuses.
How cannot(std::uint16_t index, std::uint8_t sub, std::uint64_t capability) {
  return both(preset(index, sub, capability), [index, sub](Parts& parts) {
    if (Entry* entry = parts.device.dictionary.entry(index, sub))
      entry->check = [](ByteView) -> Accepted { return refuse(abort_code::cannot_store); };
  });
}

void stores_by_itself_only(Parts& parts) {
  for (std::uint8_t sub = 1; sub <= 3; ++sub) {
    preset(0x1010, sub, 2)(parts);
    access(0x1010, sub, Access::ro)(parts);
  }
  parts.store.choices.rest_before_storing = Duration::zero();
}

// NMT and error control

/// The outputs are tested before a start is obeyed, and what comes meanwhile waits.
How start_takes(Duration time) {
  return [time](Parts& parts) {
    const auto until = std::make_shared<BusTime>();
    parts.device.inbox.add_filter([&device = parts.device, until, time](std::vector<Frame>& frames) {
      std::erase_if(frames, [&](const Frame& frame) {
        if (frame.id != 0 || frame.extended || frame.remote || frame.size() != 2) return false;
        const bool mine = frame.data[1] == 0 || frame.data[1] == device.node_id;
        const bool resets =
            frame.data[0] == nmt_command::reset_node || frame.data[0] == nmt_command::reset_communication;
        if (!mine || resets || device.state == NmtState::initialising) return false;
        if (frame.data[0] == nmt_command::start && device.state != NmtState::operational &&
            device.now >= *until)
          *until = device.now + time;
        if (device.now >= *until) return false;
        device.inbox.put(frame, *until);
        return true;
      });
    });
    parts.nmt.on_reset = [until, former = parts.nmt.on_reset](Reset kind) {
      *until = {};
      former(kind);
    };
  };
}

void irregular_start_up(Parts& parts) {
  parts.nmt.rules.start_up_time.replace(
      [turn = std::make_shared<unsigned>(0)](const auto&, Reset) -> Duration {
        constexpr milliseconds times[] = {milliseconds(15), milliseconds(900), milliseconds(1),
                                          milliseconds(300)};
        return times[(*turn)++ % std::size(times)];
      });
}

/// A frame that is in the controller is sent, whatever happens.
How in_the_controller(Service service, Duration time) {
  return [service, time](Parts& parts) {
    parts.device.outbox.add_filter(
        [service, time](const FilterContext& context, std::vector<Outgoing>& frames) {
          if (context.service != service) return;
          for (Outgoing& outgoing : frames) outgoing.delay += time;
        });
  };
}

/// A timer with a tick of its own.
How heartbeat_in_ticks(Duration tick) {
  return [tick](Parts& parts) {
    parts.producer.rules.period.replace([tick](const auto& former, std::int64_t value) -> Duration {
      const Duration period = former(value);
      return period == Duration::zero() ? period : (period + tick - Duration(1)) / tick * tick;
    });
  };
}

How heartbeat_time_from_to(std::uint64_t least, std::uint64_t most, std::uint64_t step) {
  return also_checked(0x1017, 0, [=](const Parts&, ByteView bytes) -> Accepted {
    const std::uint64_t value = conform::load_le(bytes);
    if (value == 0) return {};
    if (value < least) return refuse(abort_code::value_too_low);
    if (value > most) return refuse(abort_code::value_too_high);
    return value % step == 0 ? Accepted{} : refuse(abort_code::invalid_value);
  });
}

/// The error behaviour is a task of its own.
How reaction_after(Duration time) {
  return [time](Parts& parts) {
    parts.error_behaviour.enter = [&device = parts.device, time](NmtState state) {
      const std::uint8_t command = state == NmtState::stopped       ? nmt_command::stop
                                   : state == NmtState::operational ? nmt_command::start
                                                                    : nmt_command::enter_pre_operational;
      if (state == device.state) return;
      device.inbox.put(conform::can::data_frame(conform::CanId(0), {command, device.node_id}),
                       device.now + time);
    };
  };
}

// EMCY

/// The history is in a memory that keeps it.
void history_survives(Parts& parts) {
  parts.nmt.on_reset = [&parts, former = parts.nmt.on_reset](Reset kind) {
    ErrorHistory& history = parts.emergency.history;
    std::vector<std::uint32_t> kept;
    for (std::uint8_t sub = history.recorded(); sub >= 1; --sub) {
      if (const Upload field = history.read(sub); field && conform::load_le(*field) != 0)
        kept.push_back(static_cast<std::uint32_t>(conform::load_le(*field)));
    }
    former(kind);
    for (const std::uint32_t field : kept) {
      history.record(static_cast<std::uint16_t>(field & 0xFFFFU),
                     static_cast<ErrorSource>((field >> 24U) & 0xFFU),
                     static_cast<std::uint8_t>((field >> 16U) & 0xFFU));
    }
  };
}

How other_code(std::uint16_t usual, std::uint16_t other) {
  return [=](Parts& parts) {
    const auto renamed = [=](ErrorCause cause) {
      if (cause.code == usual && cause.source != ErrorSource::application) cause.code = other;
      return cause;
    };
    Errors& errors = parts.device.errors;
    errors.raise.replace([renamed](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
      former(renamed(cause), detail);
    });
    errors.clear.replace([renamed](const auto& former, const ErrorCause& cause) { former(renamed(cause)); });
  };
}

/// An error that nobody on the bus can end: the voltage of the outputs is missing.
void no_load_voltage(Parts& parts) {
  static constexpr ErrorCause missing{0x3320, ErrorSource::application, 42};
  parts.device.errors.clear.replace([](const auto& former, const ErrorCause& cause) {
    if (cause != missing) former(cause);
  });
  parts.nmt.on_boot_up = [&errors = parts.device.errors, former = parts.nmt.on_boot_up] {
    former();
    errors.raise(missing, 0);
  };
}

// PDO

/// 0 is that of 1800h; nothing: no TPDO of the node.
std::optional<unsigned> tpdo_of(const Parts& parts, const Frame& frame) {
  for (std::uint16_t number = 0; number < 4; ++number) {
    const auto index = static_cast<std::uint16_t>(0x1800 + number);
    if ((parts.device.dictionary.number(index, 1) & 0x7FFU) == frame.id) return number;
  }
  return std::nullopt;
}

/// One buffer after the other, the last TPDO first.
void tpdos_in_reverse_order(Parts& parts) {
  parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::tpdo) return;
    for (Outgoing& outgoing : frames) {
      if (const auto number = tpdo_of(parts, outgoing.frame)) outgoing.delay += milliseconds(3 - *number);
      outgoing.still_wanted = [&device = parts.device] { return device.works_now(Service::tpdo); };
    }
  });
}

/// The process is given its values once in each cycle, of each RPDO the newest.
How outputs_set_once_in(Duration cycle) {
  return [cycle](Parts& parts) {
    parts.device.inbox.add_filter([&parts, cycle](std::vector<Frame>& frames) {
      Device& device = parts.device;
      std::erase_if(frames, [&](const Frame& frame) {
        if (frame.extended || frame.remote || device.state != NmtState::operational) return false;
        for (std::uint16_t index = 0x1400; index <= 0x1403; ++index) {
          const std::uint64_t cob_id = device.dictionary.number(index, 1, 0x80000000);
          if ((cob_id & 0x80000000U) != 0 || (cob_id & 0x7FFU) != frame.id) continue;
          if (!is_event_driven(device.dictionary.number(index, 2))) return false;
          device.inbox.put_newest(frame, device.now + (cycle - device.now.time_since_epoch() % cycle));
          return true;
        }
        return false;
      });
    });
  };
}

void initial_tpdo_late(Parts& parts) {
  parts.pdos.tpdo.choices.initial_event = true;
  const auto started = std::make_shared<BusTime>();
  const auto sent = std::make_shared<std::map<std::uint32_t, BusTime>>();
  parts.nmt.on_change = [&parts, started, former = parts.nmt.on_change](NmtState from) {
    if (parts.device.state == NmtState::operational) *started = parts.device.now;
    former(from);
  };
  parts.device.outbox.add_filter(
      [&parts, started, sent](const FilterContext& context, std::vector<Outgoing>& frames) {
        if (context.service != Service::tpdo) return;
        for (Outgoing& outgoing : frames) {
          const std::uint32_t id = outgoing.frame.id;
          (*sent)[id] = context.now;
          // An inhibit time would count from the moment before.
          const auto number = tpdo_of(parts, outgoing.frame);
          const auto index = static_cast<std::uint16_t>(0x1800 + number.value_or(0));
          const bool held_back = !number || parts.device.dictionary.number(index, 3) != 0;
          if (context.now != *started || held_back) continue;
          outgoing.delay += milliseconds(50);
          outgoing.still_wanted = [&device = parts.device, sent, id, at = context.now] {
            return device.works_now(Service::tpdo) && (*sent)[id] == at;
          };
        }
      });
}

/// The TPDOs are made ready with the first SYNC.
void first_sync_missed(Parts& parts) {
  const auto first = std::make_shared<std::optional<BusTime>>();
  parts.nmt.on_change = [first, former = parts.nmt.on_change](NmtState from) {
    first->reset();
    former(from);
  };
  parts.pdos.tpdo.rules.sent_at_sync.replace(
      [&device = parts.device, first](const auto& former, const PdoParameters& pdo, std::uint32_t syncs,
                                      bool event) {
        if (pdo.sync_start() != 0) return former(pdo, syncs, event);  // begins with that one
        if (!*first) *first = device.now;
        return **first != device.now && former(pdo, syncs, event);
      });
}

void analog_inputs_no_event(Parts& parts) {
  parts.pdos.tpdo.rules.is_event.replace(
      [](const auto& former, const PdoParameters& pdo, const Bytes& sent, const Bytes& now) {
        const auto analog = [](const Mapped& each) { return each.index == 0x6401 || each.index == 0x6402; };
        return std::ranges::none_of(pdo.mapping(), analog) && former(pdo, sent, now);
      });
}

/// The mapping of a PDO after power-on.
How mapped(std::uint16_t index, std::vector<std::uint32_t> entries) {
  return [index, entries = std::move(entries)](Parts& parts) {
    preset(index, 0, entries.size())(parts);
    for (std::uint8_t sub = 1; sub <= 8; ++sub)
      preset(index, sub, sub <= entries.size() ? entries[sub - 1U] : 0)(parts);
  };
}

/// Each PDO is for the objects of one kind: what was mapped there by default.
How own_objects_only(std::uint16_t first) {
  return [first](Parts& parts) {
    for (std::uint16_t index = first; index < first + 4; ++index) {
      const auto allowed = std::make_shared<std::set<std::uint64_t>>();
      for (std::uint8_t sub = 1; sub <= 8; ++sub) {
        if (const std::uint64_t value = parts.device.dictionary.number(index, sub); value != 0)
          allowed->insert(value >> 16U);
      }
      for (std::uint8_t sub = 1; sub <= 8; ++sub) {
        also_checked(index, sub, [allowed](const Parts& node, ByteView bytes) -> Accepted {
          const std::uint64_t value = conform::load_le(bytes);
          const Entry* entry = node.device.dictionary.entry(static_cast<std::uint16_t>(value >> 16U),
                                                            static_cast<std::uint8_t>(value >> 8U));
          const bool mappable = entry != nullptr && (entry->rx_mappable || entry->tx_mappable);
          return mappable && !allowed->contains(value >> 16U) ? refuse(abort_code::not_mappable) : Accepted{};
        })(parts);
      }
    }
  };
}

How types_of(std::uint16_t first, std::vector<std::uint8_t> types) {
  return [first, types = std::move(types)](Parts& parts) {
    for (std::size_t i = 0; i < types.size(); ++i)
      preset(static_cast<std::uint16_t>(first + i), 2, types[i])(parts);
  };
}

/// What a sensor of a few kilobytes has.
void small_sensor(Parts& parts) {
  const std::set<std::uint16_t> kept{0x1000, 0x1001, 0x1008, 0x1017, 0x1018, 0x1800,
                                     0x1A00, 0x6000, 0x6200, 0x6401, 0x6411};
  std::erase_if(parts.device.dictionary.objects(),
                [&kept](const auto& object) { return !kept.contains(object.first); });
  access_all(0x1A00, Access::rw, Access::constant)(parts);
  absent_from(0x1A00, 4)(parts);
  access(0x1800, 1, Access::constant)(parts);
  absent_from(0x1800, 6)(parts);
  preset(0x1800, 5, 250)(parts);
  absent_from(0x1018, 4)(parts);
  parts.pdos.tpdo.parameters.choices.synchronous_types = false;
  parts.pdos.tpdo.parameters.choices.remote_types = false;
  parts.sdo.choices.block = false;
  parts.lss.choices.supported = false;
}

}  // namespace

VariantTable rare_variants() {
  return {
      // SDO
      {"sdo-writes-take-30ms",
       "a download is confirmed 30 ms after its value has taken effect",
       "SDO-GEN-18: no limit is set",
       answers_after(written_in_30ms),
       {},
       {"analog-inputs-noisy", "turnaround", "sdo-busy", "sdo-time-out-25ms"}},
      {"sdo-operational-takes-60ms",
       "what begins a transfer is answered after 60 ms in Operational",
       "SDO-GEN-18: no limit is set",
       answers_after(operational_in_60ms),
       {},
       {"analog-inputs-noisy", "turnaround", "sdo-busy", "sdo-time-out-25ms"}},
      // Together with others they would take longer than SDO-GEN-18 recommends.
      {.id = "sdo-irregular",
       .summary = "what begins a transfer is answered at once, after 2, 35 or 95 ms",
       .legal = "SDO-GEN-18: no limit is set",
       .how = answers_after(irregular),
       .excludes = {"turnaround", "late", "sdo-busy", "sdo-time-out-25ms", "sdo-operational-takes-60ms",
                    "analog-inputs-noisy"},
       .warns = {"SDO-GEN-18", "SDO-GEN-20"}},
      {"sdo-block-size-fits", "no sub-block is larger than the announced data", "SDO-BDN-01: 1 to 127",
       chosen_for_each_block_transfer(fitting_block_size), "block-size"},
      {"sdo-block-size-restless",
       "each acknowledge asks for another number of segments",
       "7.2.4.3.11: in each acknowledge",
       restless_block_size,
       "block-size",
       {"sdo-gap-at-once"}},
      {"sdo-crc-of-uploads-only",
       "a CRC is made for block uploads, and looked at in no block download",
       "7.2.4.3.9: sc is said in each initiate",
       chosen_for_each_block_transfer(crc_of_uploads),
       {},
       {"sdo-block-without-crc"}},
      {"sdo-protocol-switch-for-expedited", "the protocol is switched for up to four bytes only",
       "7.2.4.3.12: the server may switch",
       [](Parts& parts) {
         parts.sdo.rules.block_upload.may_switch.replace(
             [](const auto& former, std::size_t size, std::uint8_t threshold) {
               return size <= 4 && former(size, threshold);
             });
       }},
      {.id = "sdo-one-transfer-at-a-time",
       .summary = "a download in parts is refused while another channel is busy: 0504 0005h",
       .legal = "7.2.4.3.17: out of memory; SDO-MUL-04 warns",
       .how = one_transfer_at_a_time,
       .excludes = {"late", "sdo-entry-looked-at-late", "sdo-segments-checked-at-the-end",
                    "sdo-blocks-checked-at-the-end"},
       .warns = {"SDO-MUL-04"}},
      {.id = "sdo-last-segment-empty",
       .summary = "an upload of a multiple of seven bytes ends with an empty segment",
       .legal = "SDO-SUP-04 tolerates it: n = 7, c = 1",
       .how = last_segment_empty,
       .excludes = {"upload-segment"},
       .warns = {"SDO-SUP-04"}},
      // A client that pauses for less than a second is told; where answers are slow it pauses for longer.
      {"sdo-time-out-silent",
       "a transfer that the client has left ends without an abort",
       "7.2.4.3.17: an abort may be sent",
       time_out_silent,
       {},
       {"sdo-time-out-25ms", "sdo-time-out-200ms", "turnaround", "sdo-writes-take-30ms",
        "sdo-operational-takes-60ms", "sdo-irregular", "storing-takes-9s", "sdo-time-out-500ms",
        "1021-from-slow-memory"}},
      {"sdo-sub-block-time-out-60ms",
       "a sub-block that stops is acknowledged after 60 ms",
       "7.2.4.3.10: no time is set",
       [](Parts& parts) { parts.sdo.choices.sub_block_time_out = milliseconds(60); },
       {},
       {"turnaround", "late", "sdo-first-segment-awaited", "sdo-time-out-25ms"}},
      {.id = "abort-write-only-0601-0000",
       .summary = "reading what can only be written: unsupported access",
       .legal = "table 22: 0601 0000h; OD-ACC-03 warns",
       .how = write_only_unsupported,
       .excludes = {"types-for-mapping-only"},
       .warns = {"OD-ACC-03", "OD-GEN-12", "OD-1013-01", "OD-1013-03", "OD-1023-01", "OD-1023-04",
                 "OD-1024-01", "OD-1025-01", "OD-1025-04", "OD-1026-02", "OD-CAT-02", "SDO-BUP-23"}},
      {.id = "abort-absent-sub-0601-0002",
       .summary = "a sub-index that is missing where nothing can be written is read-only",
       .legal = "OD-GEN-08 tolerates it: the whole object is read-only",
       .how = read_only_before_absent,
       .warns = {"OD-GEN-08", "SDO-SDN-22", "SDO-BDN-23", "OD-1010-06", "OD-1011-06", "OD-1400-19",
                 "OD-1400-21", "OD-1800-19"}},
      {"sdo-servers-third", "an SDO server at 1202h and none at 1201h", "7.5.2.33: numbers may be left out",
       absent({0x1201})},

      // Dictionary
      {"configuration-locked-in-operational",
       "communication parameters are locked in Operational: 0800 0022h",
       "7.2.4.3.17: 0800 0022h, the present device state",
       locked_in_operational(is_configuration),
       {},
       {"self-starting"}},
      {"strings-printable", "writable texts take printable characters only: 0609 0030h",
       "7.2.4.3.17: which values are valid, the application says", printable_texts, "strings"},
      {"domains-of-words", "a DOMAIN has a multiple of four bytes: 0607 0010h",
       "7.4.7: lengths are the device's own", domains_of_words, "domain"},
      {"domains-write-only", "DOMAINs can be written and not be read", "7.4.5: the access is the maker's",
       domains_write_only, "domain"},
      {"1002-runs", "the manufacturer status register never rests", "7.5.2.3: what it holds is the maker's",
       running_status},
      {.id = "abort-error-modes-0800-0021",
       .summary = "error modes and values of the outputs are set at the device: 0800 0021h",
       .legal = "7.2.4.3.17: 0800 0021h, local control; OD-GEN-17 warns",
       .how = in_local_control({0x6206, 0x6207}),
       .excludes = {"6206-known-modes-only"},
       .warns = {"OD-GEN-17", "EDS-VSD-04", "SDO-DNL-21"}},
      {"1008-empty", "a device name without characters", "OD-1008-01: any length", text(0x1008, ""), "1008"},
      {"1018-serial-ffffffff",
       "the highest serial number there is",
       "7.5.2.21: 32 bits",
       preset(0x1018, 4, 0xFFFFFFFF),
       {},
       {"1018"}},
      {"1400-sub-6",
       "a SYNC start value of the first RPDO, which means nothing",
       "OD-1400-21 warns",
       [](Parts& parts) {
         if (parts.device.dictionary.objects().contains(0x1400))
           parts.device.dictionary.add_sub(0x1400, 6,
                                           integer_entry("Reserved", DataType::unsigned8, Access::rw, 0));
       },
       {},
       {"1400-subs"},
       {},
       {},
       {"OD-1400-21", "OD-1400-01"}},

      // Storing
      {.id = "storing-stops-all-250ms",
       .summary = "while it stores the device is deaf and dumb for 250 ms",
       .legal = "OD-1010-07: no limit is set; STO-1010-12 warns",
       .how = deaf_while_storing(milliseconds(250)),
       .group = "storing",
       .excludes = {"late", "turnaround"},
       .warns = {"STO-1010-12"}},
      {"1010-sub-2-cannot", "communication parameters cannot be stored by themselves, and 1010h:02 says so",
       "OD-1010-04, OD-1010-19: bit 0 = 0", cannot(0x1010, 2, 0), "storage"},
      {.id = "1011-cannot",
       .summary = "what is stored cannot be restored, and 1011h says so",
       .legal = "OD-1011-04, OD-1011-16: bit 0 = 0",
       .how = both(cannot(0x1011, 1, 0), both(cannot(0x1011, 2, 0), cannot(0x1011, 3, 0))),
       .excludes = {"storage"},
       .lacks = {"restore"}},
      {.id = "1010-stores-by-itself-only",
       .summary = "stores with each write and takes no command: 1010h is read-only",
       .legal = "OD-1010-16: bit 1 without bit 0",
       .how = stores_by_itself_only,
       .group = "storage",
       .excludes = {"storing", "signature", "abort-outputs-0800-0022"},
       .lacks = {"store"}},

      // NMT, error control
      {"start-takes-80ms",
       "a start is obeyed after 80 ms, and commands that come meanwhile wait for it",
       "7.3.2.2: no time is given, NMT-FSA-20: T_NMT",
       start_takes(milliseconds(80)),
       "nmt-latency",
       {"late"}},
      {"boot-up-irregular", "boots in 1, 15, 300 or 900 ms by turns", "7.3.2.2.1: no time is given",
       irregular_start_up, "boot"},
      {"heartbeats-in-the-controller",
       "a heartbeat leaves 4 ms late, with the state of the moment it was made",
       "7.2.8.3.2.2: nobody says what becomes of a frame in the transmit buffer",
       in_the_controller(Service::heartbeat, milliseconds(4)),
       {},
       {"heartbeat-jitter", "1017-10ms", "heartbeat-crosses-reset"}},
      {.id = "heartbeat-in-ticks-of-10ms",
       .summary = "a heartbeat time is rounded up to the tick of 10 ms",
       .legal = "EC-HBP-11 warns below 10 ms",
       .how = heartbeat_in_ticks(milliseconds(10)),
       .warns = {"EC-HBP-11"}},
      {"1017-20-ms-to-20-s", "1017h takes 20 ms to 20 s in steps of 10 ms",
       "OD-1017-03: 0609 0030h to 0609 0032h", heartbeat_time_from_to(20, 20000, 10), "1017"},
      {"error-reaction-after-60ms",
       "a lost heartbeat leads out of Operational 60 ms after its EMCY",
       "7.5.2.32: no time is set",
       reaction_after(milliseconds(60)),
       {},
       {"nmt-latency", "start-takes-80ms", "emcy-late-90ms"}},
      {.id = "guard-replies-after-15ms",
       .summary = "a guard request is answered after 15 ms",
       .legal = "7.2.8.3.2.1: no time is set",
       .how = late(Service::guarding, milliseconds(15)),
       .excludes = {"program-cycle-20ms"},
       .warns = {"EC-NG-03"}},
      {.id = "1016-watches-node-1",
       .summary = "the first entry of 1016h watches node 1 by default",
       .legal = "OD-1016-04, tolerated: a profile-specific default",
       .how = preset(0x1016, 1, 0x000103E8),
       .warns = {"OD-1016-04"}},

      // EMCY
      {.id = "emcy-8100-for-losses",
       .summary = "a heartbeat or guarding that is lost is EMCY 8100h",
       .legal = "table 26: 81xxh; EC-HBC-03, -09, -13 and EC-NG-07 warn",
       .how = other_code(0x8130, 0x8100),
       .excludes = {"emcy-second-of-the-maker"},
       .warns = {"EC-HBC-03", "EC-HBC-07", "EC-HBC-09", "EC-HBC-13", "EC-NG-07", "EC-NG-10"}},
      {.id = "emcy-no-load-voltage",
       .summary = "the voltage of the outputs is missing: an error from boot-up on that does not go",
       .legal = "7.2.7: an error lasts as long as its cause; EMCY-SEQ-03 warns",
       .how = no_load_voltage,
       .excludes = {"consumer-pauses-in-stopped", "emcy-low-voltage-at-boot-up", "emcy-no-error-at-boot-up",
                    "error-ends-operational", "error-prevents-operational", "like-canopennode",
                    "self-starting", "1015-1s", "1015-runs-from-setting", "emcy-late"},
       .warns = {"EMCY-SEQ-03", "OD-1003-04"}},
      {.id = "1003-survives",
       .summary = "the history survives a reset",
       .legal = "OD-1003-04, tolerated: a non-volatile history",
       .how = history_survives,
       .warns = {"OD-1003-04"}},
      {.id = "1014-not-valid-const",
       .summary = "EMCY is not valid, which cannot be changed",
       .legal = "OD-1014-02, OD-1014-09: bit 31 is not judged, const",
       .how = both(preset_with_node_id(0x1014, 0, 0x80000080), access(0x1014, 0, Access::constant)),
       .group = "1014-default",
       .excludes = {"emcy", "1014-const", "emcy-no-error-at-boot-up"},
       .lacks = {"emcy"}},

      // SYNC, TIME
      {"1019-const-10",
       "SYNCs are counted to 10, which cannot be changed",
       "7.5.2.22: const, the device's default",
       both(preset(0x1019, 0, 10), access(0x1019, 0, Access::constant)),
       "1019",
       {"tpdos-start-at-sync-3", "tpdos-start-at-sync-2-const"}},
      {.id = "tpdo-first-sync-missed",
       .summary = "the first SYNC in Operational sends no TPDO",
       .legal = "SYNC-CON-01 tolerates it",
       .how = first_sync_missed,
       .excludes = {"tpdo-initial"},  // which waits for the second one then
       .warns = {"SYNC-CON-01", "SYNC-CON-04", "PDO-TX-05", "PDO-TX-07", "PDO-TX-15", "PDO-TX-27"}},

      // PDO
      {"tpdos-in-reverse-order",
       "TPDOs leave one in each millisecond, the last first",
       "7.2.2: no order is given",
       tpdos_in_reverse_order,
       {},
       {"late"}},
      {"tpdos-in-the-controller",
       "a TPDO leaves 2 ms late, whatever has come meanwhile",
       "7.2.2: nobody says what becomes of a frame in the transmit buffer",
       in_the_controller(Service::tpdo, milliseconds(2)),
       {},
       {"late"}},
      {"tpdo-initial-after-50ms",
       "a TPDO 50 ms after Operational was entered, unless one has been sent since",
       "PDO-TX-07, PDO-TX-08",
       initial_tpdo_late,
       {},
       {"late", "tpdo-initial", "tpdo-when-set"}},
      {.id = "analog-inputs-no-event",
       .summary = "a change is no event of a TPDO that carries an analog input",
       .legal = "CiA 401, 6423h; 7.5.2.37: what an event is, the device and its profile say",
       .how = analog_inputs_no_event,
       .lacks = {"tpdo on change"},
       .warns = {"PDO-TX-07", "PDO-TX-08"}},
      {"rpdos-taken-once-in-10ms",
       "outputs are set once in 10 ms, with the newest RPDO",
       "CiA 301 gives no times",
       outputs_set_once_in(milliseconds(10)),
       {},
       {"late"}},
      {"pdo-types-mixed",
       "TPDOs of the types 00h, 01h, F0h and FDh and RPDOs of 00h, 01h, F0h and FEh by default",
       "7.5.2.35, 7.5.2.37: the default is the device's",
       both(types_of(0x1800, {0x00, 0x01, 0xF0, 0xFD}), types_of(0x1400, {0x00, 0x01, 0xF0, 0xFE})),
       {},
       {"sync", "1400-type-FE", "1800-type-FE", "tpdo-types", "rpdo-event-driven-only", "rpdo-few-types",
        "rpdo-synchronous-only", "tpdo-acyclic-absent", "tpdo-remote-types-absent",
        "tpdo-without-remote-frames"}},
      {"1600-begins-with-a-dummy",
       "RPDO 1 begins with a byte for another device",
       "7.4.7.1: dummy mapping",
       mapped(0x1600, {0x00050008, 0x62000108, 0x00060010, 0x62000208}),
       {},
       {"1600"}},
      {"1601-as-1600",
       "RPDO 2 sets the outputs of RPDO 1",
       "7.2.2: no object belongs to one PDO",
       mapped(0x1601, {0x62000208, 0x62000108}),
       {},
       {"1600"}},
      {"1A00-error-register",
       "TPDO 1 carries the error register",
       "7.5.2.2: it may be mapped",
       mapped(0x1A00, {0x10010008}),
       {},
       {"1A00"}},
      {.id = "rpdos-of-a-kind",
       .summary = "an RPDO takes objects of the kinds it has by default: 0604 0041h",
       .legal = "7.2.4.3.17: cannot be mapped to the PDO; OD-1600-05 warns",
       .how = own_objects_only(0x1600),
       .excludes = {"1600"},
       .warns = {"OD-1600-05"}},
      {.id = "tpdos-of-a-kind",
       .summary = "a TPDO takes objects of the kinds it has by default: 0604 0041h",
       .legal = "7.2.4.3.17: cannot be mapped to the PDO; OD-1A00-05 warns",
       .how = own_objects_only(0x1A00),
       .excludes = {"1A00", "1A00-error-register"},
       .warns = {"OD-1A00-05"}},

      // All at once
      {.id = "like-a-small-sensor",
       .summary = "a sensor: identity, a heartbeat, one TPDO with a fixed mapping, and no more",
       .legal = "7.5.2: the rest is optional",
       .how = small_sensor,
       .group = "stack",
       .excludes = {"self-starting",
                    "1A00-error-register",
                    "logical-devices",
                    "tpdo-synchronous-only",
                    "rpdo",
                    "tpdo",
                    "1600",
                    "1A00",
                    "emcy",
                    "1003",
                    "1015",
                    "1016",
                    "1017",
                    "1028",
                    "1029",
                    "guarding",
                    "storage",
                    "sync",
                    "1019",
                    "lss",
                    "sync-producer",
                    "time",
                    "time-producer",
                    "1021",
                    "1027",
                    "os",
                    "1018",
                    "manufacturer",
                    "emcy-in-operational",
                    "like-canopennode",
                    "sdo-expedited-only",
                    "domain",
                    "strings",
                    "1800-const"},
       .lacks = {"time consumer",
                 "time producer",
                 "sync consumer",
                 "sync producer",
                 "sync counter",
                 "store",
                 "restore",
                 "emcy",
                 "emcy consumer",
                 "heartbeat consumer",
                 "node guarding",
                 "life guarding",
                 "error behaviour",
                 "rpdo",
                 "variable mapping",
                 "remote frames",
                 "additional sdo servers",
                 "sdo client",
                 "modular device",
                 "block sdo",
                 "lss",
                 "lss identify remote slave",
                 "lss identify non-configured",
                 "lss fastscan"}},
  };
}

}  // namespace refnode
