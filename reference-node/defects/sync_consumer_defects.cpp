// SPDX-License-Identifier: Apache-2.0
// Defects of what a SYNC does: which one is taken, the synchronous window (1007h), and one that stays away.
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "defects/cob_ids.hpp"
#include "defects/hooks.hpp"
#include "defects/receivers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

SyncConsumerRules& of_consumer(Parts& parts) { return parts.sync.rules; }
SyncWindowRules& of_window(Parts& parts) { return parts.sync_window.rules; }

Change obeys(bool (*which)(std::uint8_t counter, std::uint64_t overflow)) {
  return decides(of_consumer, &SyncConsumerRules::obeyed,
                 [which](const auto&, std::uint8_t counter, std::uint64_t overflow) {
                   return which(counter, overflow);
                 });
}

/// SYNC is obeyed depending on the counter of the one before.
Change obeys_after(bool (*which)(std::uint8_t last, std::uint8_t counter)) {
  return [which](Parts& parts) {
    const auto last = std::make_shared<std::uint8_t>(std::uint8_t{0});
    parts.sync.rules.obeyed.replace([last, which](const auto&, std::uint8_t counter, std::uint64_t) {
      return which(std::exchange(*last, counter), counter);
    });
  };
}

/// A counter that does not follow that of the one before is an error of the length, which the next one that
/// does ends.
void reports_jumps(Parts& parts) {
  const auto last = since_boot_up<std::optional<std::uint8_t>>(parts);
  after_writing(0x1019, 0, [last](Parts&, const std::function<void()>& former) {
    last->reset();
    former();
  })(parts);
  parts.sync.rules.obeyed.replace(
      [last, &parts](const auto& former, std::uint8_t counter, std::uint64_t overflow) {
        const auto before = std::exchange(*last, counter);
        const bool follows = !before || counter == (*before == overflow ? 1 : *before + 1);
        if (!follows) parts.device.errors.raise({0x8240, ErrorSource::sync, 0}, counter);
        return former(counter, overflow);
      });
}

/// A window that was used is not changed any more in the ways that `stays` names.
Change keeps_window(bool (*stays)(std::int64_t present, std::int64_t written)) {
  return [stays](Parts& parts) {
    const auto used = since_boot_up<std::int64_t>(parts);
    parts.sync_window.rules.length.replace([used, stays](const auto& former, std::int64_t value) {
      if (*used == 0 || !stays(*used, value)) *used = value;
      return former(*used);
    });
  };
}

/// After a reset no SYNC is taken before 1005h is written.
void deaf_after_reset(Parts& parts) {
  const auto deaf = std::make_shared<bool>(false);
  parts.device.outbox.add_filter(
      [deaf, boots = 0](const FilterContext& context, std::vector<Outgoing>&) mutable {
        if (context.service == Service::boot_up) *deaf = ++boots > 1;
      });
  after_writing(0x1005, 0, [deaf](Parts&, const std::function<void()>& former) {
    *deaf = false;
    former();
  })(parts);
  deaf_to([deaf](Parts& node, const Frame& frame) { return *deaf && is_sync(node, frame); })(parts);
}

/// The CAN-ID is looked up when 1005h is written, and not when a reset puts it back.
void keeps_can_id(Parts& parts) {
  const auto moved = std::make_shared<std::uint32_t>(0);
  after_writing(0x1005, 0, [moved](Parts& node, const std::function<void()>& former) {
    *moved = static_cast<std::uint32_t>(node.device.dictionary.number(0x1005, 0)) & 0x7FFU;
    former();
  })(parts);
  parts.sync.cob_id_rules.can_id.replace(
      [moved](const auto& former, std::uint32_t value, std::uint32_t at_power_on) {
        return *moved != 0 ? *moved : former(value, at_power_on);
      });
}

/// What 1005h was before a reset is obeyed beside what it is now, until it is written again.
void obeys_former_can_id(Parts& parts) {
  const auto written = std::make_shared<std::uint32_t>(0);
  const auto obeyed = std::make_shared<std::uint32_t>(0);
  after_writing(0x1005, 0, [written, obeyed](Parts& node, const std::function<void()>& former) {
    *obeyed = 0;
    *written = static_cast<std::uint32_t>(node.device.dictionary.number(0x1005, 0)) & 0x7FFU;
    former();
  })(parts);
  with_boot_up([written, obeyed](Parts&) { *obeyed = std::exchange(*written, 0); })(parts);
  misreads([obeyed](Parts& node, Frame& frame) {
    if (*obeyed != 0 && frame.id == *obeyed && !frame.extended && !frame.remote)
      frame.id = static_cast<std::uint32_t>(node.device.dictionary.number(0x1005, 0)) & 0x7FFU;
  })(parts);
}

/// The frame carries a TPDO of the types 00h to F0h.
bool is_synchronous(Parts& parts, const Frame& frame) {
  const ObjectDictionary& od = parts.device.dictionary;
  for (std::uint16_t index = 0x1800; index < 0x1810; ++index) {
    if (od.entry(index, 1) != nullptr && (od.number(index, 1) & 0x7FFU) == frame.id)
      return od.number(index, 2) <= 0xF0;
  }
  return false;
}

/// Every synchronous TPDO has the data of the one before.
void sends_former_data(Parts& parts) {
  const auto former = std::make_shared<std::map<std::uint32_t, Frame>>();
  parts.device.outbox.add_filter(
      [&parts, former](const FilterContext& context, std::vector<Outgoing>& frames) {
        if (context.service != Service::tpdo) return;
        for (Outgoing& each : frames) {
          if (!is_synchronous(parts, each.frame)) continue;
          const Frame present = each.frame;
          const auto before = former->find(present.id);
          if (before != former->end() && before->second.dlc == present.dlc) each.frame = before->second;
          former->insert_or_assign(present.id, present);
        }
      });
}

/// Synchronous TPDOs take their time, whatever the window is.
Change takes_longer_than_the_window() {
  return [](Parts& parts) {
    parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service != Service::tpdo || parts.device.dictionary.number(0x1007, 0) == 0) return;
      for (Outgoing& each : frames) {
        if (is_synchronous(parts, each.frame)) each.delay = std::chrono::milliseconds(40);
      }
    });
  };
}

/// Once the window was over it does not open again.
void stays_closed(Parts& parts) {
  const auto closed = std::make_shared<bool>(false);
  parts.sync_window.rules.open.replace([closed](const auto& former, Duration since_sync, Duration window) {
    *closed = window != Duration::zero() && (*closed || !former(since_sync, window));
    return !*closed;
  });
}

/// The error has this code and no other.
Change reported_as(std::uint16_t right, std::uint16_t code) {
  return [=](Parts& parts) {
    parts.device.errors.raise.replace([=](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
      former(cause.code == right ? ErrorCause{code, cause.source, cause.instance} : cause, detail);
    });
    parts.device.errors.clear.replace([=](const auto& former, const ErrorCause& cause) {
      former(cause.code == right ? ErrorCause{code, cause.source, cause.instance} : cause);
    });
  };
}

Change never_ends(std::uint16_t code) {
  return [code](Parts& parts) {
    parts.device.errors.clear.replace([code](const auto& former, const ErrorCause& cause) {
      if (cause.source != ErrorSource::sync || cause.code != code) former(cause);
    });
  };
}

SyncSupervisionRules& of_supervision(Parts& parts) { return parts.sync_supervision.rules; }

void supervises(Parts& parts) { parts.sync_supervision.choices.loss_reported = true; }

/// One that was lost is reported again and again.
void repeats_the_loss(Parts& parts) {
  supervises(parts);
  parts.device.outbox.add_filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::emergency || frames.empty()) return;
    if (frames.front().frame.data[1] != 0x81 || frames.front().frame.data[0] != 0) return;
    for (const int delay : {100, 200}) {
      frames.push_back(frames.front());
      frames.back().delay = std::chrono::milliseconds(delay);
    }
  });
}

/// The first SYNC is expected from the write of 1006h on.
Change expects_the_first() {
  return together(Change(supervises),
                  after_writing(0x1006, 0, [](Parts& parts, const std::function<void()>& former) {
                    former();
                    parts.sync_supervision.on_sync();
                  }));
}

}  // namespace

DefectTable sync_consumer_defects() {
  return {
      {"sync-known-by-function-code",
       "Frames of the function code of SYNC, EMCYs of other nodes, are taken for SYNC",
       {"SYNC-CON-02"},
       misreads([](Parts&, Frame& frame) {
         if (!frame.extended && !frame.remote && (frame.id & ~0x7FU) == 0x080U) frame.id = 0x080;
       })},
      {"sync-counter-of-two-is-an-error",
       "With an overflow value of 2 the counter of a SYNC is reported as a wrong length",
       {"SYNC-CON-04", "SYNC-CON-05"},
       decides(of_consumer, &SyncConsumerRules::length,
               [](const auto& former, std::uint64_t overflow) {
                 return overflow == 2 ? std::size_t{0} : former(overflow);
               })},
      {"sync-dead-with-period",
       "SYNC is not taken while 1006h is not 0",
       {"SYNC-CON-01"},
       deaf_to([](Parts& parts, const Frame& frame) {
         return is_sync(parts, frame) && parts.device.dictionary.number(0x1006, 0) != 0;
       })},
      {"sync-dead-after-reset",
       "After a reset no SYNC is taken until 1005h is written",
       {"SYNC-CON-01", "PDO-TX-05"},
       deaf_after_reset},
      {"sync-can-id-survives-reset",
       "After a reset SYNC is taken on the CAN-ID that 1005h had before",
       {"SYNC-CON-01", "OD-1005-07"},
       keeps_can_id},
      {"sync-former-can-id-obeyed-after-reset",
       "After a reset SYNC is taken on the CAN-ID that 1005h had before as well",
       {"OD-1005-07"},
       obeys_former_can_id},
      {"sync-long-stops-the-node",
       "A SYNC of more than one byte puts the node into Stopped",
       {"SYNC-CON-07"},
       deaf_to([](Parts& parts, const Frame& frame) {
         if (is_sync(parts, frame) && frame.size() > 1) parts.nmt.enter(NmtState::stopped);
         return false;
       })},
      {"sync-tpdo-slow",
       "Synchronous TPDOs follow their SYNC after 15 ms",
       {"SYNC-CON-09"},
       [](Parts& parts) {
         parts.device.outbox.add_filter(
             [&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
               if (context.service != Service::tpdo) return;
               for (Outgoing& each : frames) {
                 if (is_synchronous(parts, each.frame)) each.delay = std::chrono::milliseconds(15);
               }
             });
       }},
      {"sync-off-by-bit-31",
       "With bit 31 of 1005h set no SYNC is taken",
       {"OD-1005-11"},
       decides(of_sync, &CobIdRules::valid,
               [](const auto& former, std::uint32_t value) {
                 return (value & 0x80000000U) == 0 && former(value);
               })},
      {"sync-counter-taken-for-wrong-length",
       "A SYNC with the counter that 1019h asks for causes EMCY 8240h",
       {"SYNC-CON-04"},
       decides(of_consumer, &SyncConsumerRules::length,
               [](const auto&, std::uint64_t) -> std::size_t { return 0; })},
      {"sync-without-counter-not-reported",
       "A SYNC without the counter that 1019h asks for causes no EMCY",
       {"SYNC-CON-05"},
       misreads([](Parts& parts, Frame& frame) {
         if (is_sync(parts, frame) && frame.dlc == 0 && parts.device.dictionary.number(0x1019, 0) > 1)
           frame.dlc = 1;
       })},
      {"sync-length-reported-as-rpdo",
       "A SYNC of the wrong length is reported with EMCY 8210h",
       {"SYNC-CON-05"},
       reported_as(0x8240, 0x8210)},
      {"sync-length-error-stays",
       "The error of a SYNC of the wrong length stays when the next one is right",
       {"EMCY-SEQ-02"},
       never_ends(0x8240)},
      {"sync-ignored-at-overflow",
       "A SYNC whose counter is the overflow value is ignored",
       {"SYNC-CON-04", "SYNC-CON-06"},
       obeys([](std::uint8_t counter, std::uint64_t overflow) { return counter != overflow; })},
      {"sync-ignored-at-1",
       "A SYNC whose counter is 1 is ignored",
       {"SYNC-CON-04", "SYNC-CON-06"},
       obeys([](std::uint8_t counter, std::uint64_t) { return counter != 1; })},
      {"sync-ignored-above-127",
       "A SYNC whose counter is above 127 is ignored",
       {"SYNC-CON-04", "SYNC-CON-06"},
       obeys([](std::uint8_t counter, std::uint64_t) { return counter < 128; })},
      {"sync-repeated-count-ignored",
       "A SYNC with the counter of the one before is ignored",
       {"SYNC-CON-06"},
       obeys_after([](std::uint8_t last, std::uint8_t counter) { return last != counter; })},
      {"sync-out-of-order-ignored",
       "A SYNC whose counter does not follow that of the one before is ignored",
       {"SYNC-CON-06"},
       obeys_after(
           [](std::uint8_t last, std::uint8_t counter) { return counter == 1 || counter == last + 1; })},
      {"sync-out-of-order-reported",
       "A SYNC whose counter does not follow that of the one before causes EMCY 8240h",
       {"SYNC-CON-04"},
       Change(reports_jumps)},
      {"sync-count-beyond-range-ignored",
       "A SYNC whose counter is 0 or beyond the overflow value is ignored",
       {"SYNC-CON-06"},
       obeys(
           [](std::uint8_t counter, std::uint64_t overflow) { return counter != 0 && counter <= overflow; })},
      {"sync-tpdo-one-behind",
       "A synchronous TPDO has the data of the SYNC before",
       {"PDO-TX-05"},
       sends_former_data},
      {"sync-loss-repeated",
       "A SYNC that stays away is reported again and again",
       {"SYNC-CON-10"},
       repeats_the_loss},
      {"sync-loss-before-the-first",
       "A SYNC is expected before the first one has come",
       {"SYNC-CON-10"},
       expects_the_first()},
      {"sync-loss-stays",
       "The error of a SYNC that stayed away stays when SYNC is back",
       {"SYNC-CON-10"},
       together(Change(supervises),
                decides(of_supervision, &SyncSupervisionRules::ends, [](const auto&) { return false; }))},
      {"sync-tpdo-behind-the-window",
       "Synchronous TPDOs are sent behind the window of 1007h",
       {"SYNC-CON-08"},
       takes_longer_than_the_window()},
      {"1007-zero-closes",
       "With 1007h = 0 synchronous RPDOs are discarded",
       {"OD-1007-02", "PDO-RX-03"},
       decides(of_window, &SyncWindowRules::open,
               [](const auto& former, Duration since_sync, Duration window) {
                 return window != Duration::zero() && former(since_sync, window);
               })},
      {"1007-zero-ends-no-window",
       "A window of 1007h that was used stays when 0 is written",
       {"OD-1007-02"},
       keeps_window([](std::int64_t, std::int64_t written) { return written == 0; })},
      {"1007-window-not-made-longer",
       "A window of 1007h that was used stays when a longer one is written",
       {"OD-1007-03"},
       keeps_window([](std::int64_t present, std::int64_t written) { return written > present; })},
      {"1007-never-resumes",
       "When the window of 1007h was over once synchronous RPDOs are discarded for ever",
       {"OD-1007-03"},
       stays_closed},
      {"1007-in-ns",
       "1007h counts nanoseconds",
       {"OD-1007-03"},
       decides(of_window, &SyncWindowRules::length,
               [](const auto& former, std::int64_t value) { return former(value) / 1000; })},
  };
}

}  // namespace refnode
