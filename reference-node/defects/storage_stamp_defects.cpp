// SPDX-License-Identifier: Apache-2.0
// Defects of the configuration stamp (1020h).
#include <functional>
#include <memory>

#include "defects/hooks.hpp"
#include "defects/pdos.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u16 = DataType::unsigned16;

/// Each of two entries delivers what the other one holds.
DictionaryEdit swapped(std::uint16_t index, std::uint8_t one, std::uint8_t other) {
  return [=](ObjectDictionary& od, std::uint8_t) {
    Entry* first = od.entry(index, one);
    Entry* second = od.entry(index, other);
    if (first == nullptr || second == nullptr) return;
    first->read = [second]() -> Upload { return second->value; };
    second->read = [first]() -> Upload { return first->value; };
  };
}

StampRules& of_stamp(Parts& parts) { return parts.store.stamp.rules; }

/// What was stored of a group goes when its defaults are restored.
bool is_restored(const Images& former, const Images& images) { return images.size() < former.size(); }

/// Only another value in this group is another configuration.
Change sees_changes_in(Group group) {
  return decides(of_stamp, &StampRules::same_configuration,
                 [group](const auto& former, const Images& before, const Images& after) {
                   const auto part = [group](const Images& images) {
                     const auto found = images.find(group);
                     return found == images.end() ? Images{} : Images{*found};
                   };
                   return former(part(before), part(after));
                 });
}

/// "load" makes date and time of the configuration what 1020h begins with after a reset.
Change stamp_becomes_default() {
  return checking_all(0x1011, [](Parts& parts, const Check& former, std::uint8_t, ByteView bytes) {
    const Accepted restored = former(bytes);
    for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}}) {
      Entry* entry = parts.device.dictionary.entry(0x1020, sub);
      if (restored && entry != nullptr) entry->default_value = entry->value;
    }
    return restored;
  });
}

/// Whatever writes to an entry clears date and time, an RPDO as well.
Change cleared_by_an_rpdo() {
  return deaf_to([](Parts& parts, const Frame& frame) {
    ObjectDictionary& od = parts.device.dictionary;
    const bool taken = parts.device.state == NmtState::operational && !frame.remote && !frame.extended;
    if (!taken || !rpdo_with(od, frame.id)) return false;
    for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}}) od.set_number(0x1020, sub, 0);
    return false;
  });
}

/// Once date and time were written, no store command takes them out of the memory until the next reset.
Change stored_stamp_saved_by_a_write() {
  return [](Parts& parts) {
    const auto written = std::make_shared<bool>(false);
    after_writing_all(0x1020, [written](Parts&, const std::function<void()>& former, std::uint8_t) {
      *written = true;
      former();
    })(parts);
    parts.store.stamp.rules.same_configuration.replace(
        [written](const auto& former, const Images& before, const Images& after) {
          return *written || former(before, after);
        });
    parts.device.outbox.add_filter([written](const FilterContext& context, std::vector<Outgoing>&) {
      if (context.service == Service::boot_up) *written = false;
    });
  };
}

/// That date and time were written counts, although a reset has taken back what was written.
Change renewed_before_a_reset() {
  return [](Parts& parts) {
    const auto written = std::make_shared<bool>(false);
    after_writing_all(0x1020, [written](Parts&, const std::function<void()>& former, std::uint8_t) {
      *written = true;
      former();
    })(parts);
    checking_all(0x1010, [written](Parts&, const Check& former, std::uint8_t, ByteView bytes) {
      const Accepted stored = former(bytes);
      if (stored) *written = false;
      return stored;
    })(parts);
    parts.device.outbox.add_filter([&parts, written](const FilterContext& context, std::vector<Outgoing>&) {
      if (context.service != Service::boot_up || !*written) return;
      const Entry* entry = parts.device.dictionary.entry(0x1020, 1);
      if (entry != nullptr && entry->written) entry->written();
    });
  };
}

}  // namespace

DefectTable storage_stamp_defects() {
  return {
      {"1020-sub0-wrong", "1020h:00 is 03h", {"OD-1020-01", "OD-GEN-11"}, preset(0x1020, 0, 3)},
      {"1020-sub0-writable",
       "1020h:00 can be written",
       {"OD-1020-02", "OD-ACC-02", "SDO-DNL-09"},
       access(0x1020, 0, Access::rw)},
      {"1020-not-writable",
       "1020h:01 is read-only",
       {"OD-1020-03", "STO-1020-01", "SDO-DNL-21"},
       access(0x1020, 1, Access::ro)},
      {"1020-is-u16",
       "1020h:02 has two bytes",
       {"OD-1020-03", "OD-GEN-19", "OD-LEN-04", "OD-GEN-17"},
       type(0x1020, 2, u16)},
      {"1020-subs-swapped",
       "Date and time of 1020h are exchanged when they are read",
       {"OD-1020-03", "OD-1020-04"},
       swapped(0x1020, 1, 2)},
      {"1020-not-stored",
       "1020h is not stored with the parameters",
       {"OD-1020-04", "STO-1020-02"},
       [](ObjectDictionary& od, std::uint8_t) {
         for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}}) {
           if (Entry* entry = od.entry(0x1020, sub)) entry->storable = false;
         }
       }},
      {"1020-cleared-although-renewed",
       "1020h is 0 after another configuration is stored, also when date and time were written with it",
       {"OD-1020-04", "STO-1020-02"},
       [](ObjectDictionary& od, std::uint8_t) {
         for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}}) {
           if (Entry* entry = od.entry(0x1020, sub)) entry->written = nullptr;
         }
       }},
      {"1020-cleared-by-storing-again",
       "1020h is 0 after the same configuration is stored a second time",
       {"OD-1020-04", "STO-1020-02"},
       decides(of_stamp, &StampRules::same_configuration,
               [](const auto&, const Images&, const Images&) { return false; })},
      {"1020-stamp-survives-change",
       "1020h stays although another configuration is stored",
       {"OD-1020-05", "STO-1020-03"},
       decides(of_stamp, &StampRules::same_configuration,
               [](const auto& former, const Images& before, const Images& after) {
                 return !is_restored(before, after) || former(before, after);
               })},
      {"1020-write-before-a-reset-counts",
       "1020h stays when it was written, lost by a reset, and another configuration is stored then",
       {"OD-1020-05"},
       renewed_before_a_reset()},
      {"1020-survives-other-application",
       "1020h stays when application parameters are stored or restored without it",
       {"OD-1020-05"},
       sees_changes_in(Group::communication)},
      {"1020-survives-first-stored-application",
       "1020h stays when application parameters are stored for the first time",
       {"OD-1020-05"},
       decides(of_stamp, &StampRules::same_configuration,
               [](const auto& former, const Images& before, const Images& after) {
                 const bool first =
                     after.contains(Group::application) && !before.contains(Group::application);
                 return (first && before.contains(Group::communication)) || former(before, after);
               })},
      {"1020-saved-by-a-write-that-is-not-stored",
       "1020h stays in the memory when it was written and application parameters alone are stored then",
       {"OD-1020-05"},
       stored_stamp_saved_by_a_write()},
      {"1020-cleared-by-saving",
       "1020h is 0 from each saving of the parameters until the next reset",
       {"OD-1020-04"},
       checking_all(0x1010,
                    [](Parts& parts, const Check& former, std::uint8_t, ByteView bytes) {
                      const Accepted stored = former(bytes);
                      for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}})
                        if (stored) parts.device.dictionary.set_number(0x1020, sub, 0);
                      return stored;
                    })},
      {"1020-cleared-by-an-rpdo",
       "1020h is 0 behind each RPDO that was received",
       {"OD-1020-03"},
       cleared_by_an_rpdo()},
      {"1020-survives-restored-application",
       "1020h stays when the defaults of the application parameters are restored",
       {"OD-1020-05"},
       decides(of_stamp, &StampRules::same_configuration,
               [](const auto& former, const Images& before, const Images& after) {
                 return is_restored(before, after) || former(before, after);
               })},
      {"1020-survives-restore",
       "Restoring the defaults leaves 1020h",
       {"STO-1020-04"},
       together(decides(of_stamp, &StampRules::same_configuration,
                        [](const auto& former, const Images& before, const Images& after) {
                          return is_restored(before, after) || former(before, after);
                        }),
                stamp_becomes_default())},
  };
}

}  // namespace refnode
