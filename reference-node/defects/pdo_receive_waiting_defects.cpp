// SPDX-License-Identifier: Apache-2.0
// Defects of received PDOs that wait: for their SYNC, for the next start, for the end of their time.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "defects/pdos.hpp"
#include "defects/receivers.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr std::uint16_t too_short = 0x8210;

/// The number of the valid RPDO that the frame is one of.
std::optional<std::uint16_t> number_of(const ObjectDictionary& od, const Frame& frame) {
  if (frame.remote || frame.extended) return std::nullopt;
  return rpdo_with(od, frame.id);
}

bool waits_for_sync(const ObjectDictionary& od, std::uint16_t number) {
  return is_synchronous(od.number(rpdo_communication(number), 2));
}

/// Of more than one frame before a SYNC the first two have a place to wait in.
void waits_in_two_places(Parts& parts) {
  const auto come = std::make_shared<std::map<std::uint16_t, int>>();
  parts.pdos.rpdo.rules.kept_for_sync.replace([come](const auto& former, const PdoParameters& pdo,
                                                     const std::optional<Bytes>& waiting,
                                                     const Bytes& received) {
    int& frames = (*come)[pdo.number()];
    frames = waiting ? frames + 1 : 1;
    return waiting && frames > 2 ? *waiting : former(pdo, waiting, received);
  });
}

/// What waits when Operational is left is taken over by a SYNC in Pre-operational.
void takes_over_in_pre_operational(Parts& parts) {
  struct Memory {
    std::optional<Frame> waiting;
    bool now = false;
  };
  const auto memory = since_boot_up<Memory>(parts);
  parts.device.works.replace([memory](const auto& former, Service service, NmtState state) {
    return former(service, state) || (service == Service::rpdo && memory->now);
  });
  misreads([memory](Parts& node, Frame& frame) {
    const ObjectDictionary& od = node.device.dictionary;
    memory->now = false;
    const auto number = number_of(od, frame);
    if (number && node.device.state == NmtState::operational && waits_for_sync(od, *number))
      memory->waiting = frame;
    if (!is_sync(node, frame)) return;
    const auto waiting = std::exchange(memory->waiting, std::nullopt);
    if (!waiting || node.device.state != NmtState::pre_operational) return;
    memory->now = true;
    node.pdos.on_frame(*waiting);
  })(parts);
  ahead_of_state_change([memory](Parts& node) {
    if (node.device.state != NmtState::pre_operational) memory->waiting.reset();
  })(parts);
}

/// The frame goes into the place of what waits before its length is looked at.
void short_overwrites_what_waits(Parts& parts) {
  using Heads = std::map<std::uint16_t, Bytes>;
  const auto last = std::make_shared<Bytes>();
  const auto heads = std::make_shared<Heads>();
  misreads([last](Parts&, Frame& frame) {
    last->assign(frame.data.begin(), frame.data.begin() + static_cast<std::ptrdiff_t>(frame.size()));
  })(parts);
  auto& rules = parts.pdos.rpdo.rules;
  rules.processed.replace(
      [last, heads](const auto& former, const PdoParameters& pdo, std::size_t received, std::size_t mapped) {
        if (received < mapped) (*heads)[pdo.number()] = *last;
        return former(pdo, received, mapped);
      });
  rules.kept_for_sync.replace([heads](const auto& former, const PdoParameters& pdo,
                                      const std::optional<Bytes>& waiting, const Bytes& received) {
    heads->erase(pdo.number());
    return former(pdo, waiting, received);
  });
  rules.taken_at_sync.replace([heads](const auto& former, const PdoParameters& pdo, const Bytes& waiting) {
    Bytes taken = former(pdo, waiting);
    const auto head = heads->find(pdo.number());
    if (head != heads->end()) {
      std::copy_n(head->second.begin(), std::min(head->second.size(), taken.size()), taken.begin());
      heads->erase(head);
    }
    return taken;
  });
}

/// Behind the window what waits is thrown away with what is too late.
void late_one_empties_the_place(Parts& parts) {
  const auto emptied = std::make_shared<std::set<std::uint16_t>>();
  auto& rules = parts.pdos.rpdo.rules;
  rules.processed.replace([&parts, emptied](const auto& former, const PdoParameters& pdo,
                                            std::size_t received, std::size_t mapped) {
    if (is_synchronous(pdo.transmission_type()) && !parts.pdos.rpdo.in_window())
      emptied->insert(pdo.number());
    return former(pdo, received, mapped);
  });
  rules.kept_for_sync.replace([emptied](const auto& former, const PdoParameters& pdo,
                                        const std::optional<Bytes>& waiting, const Bytes& received) {
    emptied->erase(pdo.number());
    return former(pdo, waiting, received);
  });
  rules.taken_at_sync.replace([emptied](const auto& former, const PdoParameters& pdo, const Bytes& waiting) {
    return emptied->erase(pdo.number()) != 0 ? Bytes{} : former(pdo, waiting);
  });
}

/// The length of an RPDO is an error where its type has this property.
Change unnoticed_short_of(bool (*type)(std::uint64_t)) {
  return [type](Parts& parts) {
    parts.device.errors.raise.replace(
        [&parts, type](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
          const auto number = static_cast<std::uint16_t>(cause.instance - 1);
          const bool lost = cause.source == ErrorSource::rpdo && cause.code == too_short &&
                            type(parts.device.dictionary.number(rpdo_communication(number), 2));
          if (!lost) former(cause, detail);
        });
  };
}

/// Whether an RPDO is valid is looked at when the state changes.
void validated_with_the_next_start(Parts& parts) {
  const auto valid = std::make_shared<std::set<std::uint16_t>>();
  ahead_of_state_change([valid](Parts& node) {
    valid->clear();
    for (std::uint16_t number = 0; number <= last_pdo; ++number) {
      if ((node.device.dictionary.number(rpdo_communication(number), 1, 0x8000'0000U) & 0x8000'0000U) == 0)
        valid->insert(number);
    }
  })(parts);
  parts.pdos.rpdo.rules.valid.replace([&parts, valid](const auto& former, const PdoParameters& pdo) {
    const bool late = parts.device.state == NmtState::operational && !valid->contains(pdo.number());
    return !late && former(pdo);
  });
}

/// One that is too short takes the deadline with it.
void short_ends_the_deadline(Parts& parts) {
  const auto ended = std::make_shared<std::set<std::uint16_t>>();
  parts.pdos.rpdo.rules.processed.replace(
      [ended](const auto& former, const PdoParameters& pdo, std::size_t received, std::size_t mapped) {
        if (received < mapped) {
          ended->insert(pdo.number());
        } else {
          ended->erase(pdo.number());
        }
        return former(pdo, received, mapped);
      });
  parts.device.errors.raise.replace(
      [ended](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
        constexpr std::uint16_t too_late = 0x8250;
        const bool lost = cause.source == ErrorSource::rpdo && cause.code == too_late &&
                          ended->contains(static_cast<std::uint16_t>(cause.instance - 1));
        if (!lost) former(cause, detail);
      });
  ahead_of_state_change([ended](Parts&) { ended->clear(); })(parts);
}

/// The buffer that waits for the SYNC works once the first of them has come.
void loses_before_the_first_sync(Parts& parts) {
  const auto heard = since_boot_up<bool>(parts);
  parts.pdos.rpdo.rules.processed.replace(
      [heard](const auto& former, const PdoParameters& pdo, std::size_t received, std::size_t mapped) {
        return (*heard || !is_synchronous(pdo.transmission_type())) && former(pdo, received, mapped);
      });
  deaf_to([heard](Parts& node, const Frame& frame) {
    if (is_sync(node, frame)) *heard = true;
    return false;
  })(parts);
}

}  // namespace

DefectTable pdo_receive_waiting_defects() {
  return {
      {"rpdo-third-before-a-sync-lost",
       "Of several synchronous RPDOs before one SYNC the second one is the last that is taken",
       {"PDO-RX-04"},
       Change(waits_in_two_places)},
      {"rpdo-synchronous-before-the-first-sync-lost",
       "A synchronous RPDO that comes before the first SYNC behind a reset is lost",
       {"PDO-RX-03"},
       Change(loses_before_the_first_sync)},
      {"rpdo-waiting-applied-in-pre-operational",
       "A synchronous RPDO that waits when Operational is left takes effect with a SYNC in Pre-operational",
       {"PDO-RX-02"},
       Change(takes_over_in_pre_operational)},
      {"rpdo-short-overwrites-what-waits",
       "An RPDO that is too short overwrites the first bytes of what waits for the SYNC",
       {"PDO-RX-06"},
       Change(short_overwrites_what_waits)},
      {"rpdo-synchronous-short-processed",
       "A synchronous RPDO that is too short is taken for one that ends with zeros",
       {"PDO-RX-06"},
       decides(rpdo_traffic, &ReceivePdoRules::processed,
               [](const auto& former, const PdoParameters& pdo, std::size_t received, std::size_t mapped) {
                 return is_synchronous(pdo.transmission_type()) || former(pdo, received, mapped);
               })},
      {"rpdo-late-one-discards-what-waits",
       "A synchronous RPDO behind the window of 1007h throws away what came inside of it",
       {"OD-1007-03"},
       Change(late_one_empties_the_place)},
      {"rpdo-synchronous-short-unnoticed",
       "A synchronous RPDO that is too short causes no EMCY",
       {"PDO-RX-06"},
       unnoticed_short_of([](std::uint64_t type) { return is_synchronous(type); })},
      {"rpdo-validated-with-the-next-start",
       "An RPDO that is made valid in Operational is received behind the next start only",
       {"OD-1400-09"},
       Change(validated_with_the_next_start)},
      {"rpdo-short-ends-the-deadline",
       "An RPDO that is too short ends the watch for the next one",
       {"PDO-RX-14"},
       Change(short_ends_the_deadline)},
  };
}

}  // namespace refnode
