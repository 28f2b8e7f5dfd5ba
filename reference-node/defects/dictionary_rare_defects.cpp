// SPDX-License-Identifier: Apache-2.0
// Dictionary, storing, COB-IDs and LSS: faults that show the second time, behind something else or beside it.
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "defects/cob_ids.hpp"
#include "defects/defect.hpp"
#include "defects/hooks.hpp"
#include "defects/lss_frames.hpp"
#include "defects/pdos.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr std::uint32_t save = 0x65766173;
constexpr std::uint32_t load = 0x64616F6C;
constexpr Group parameter_groups[] = {Group::communication, Group::application, Group::manufacturer};

bool concerns(std::uint8_t sub, Group group) {
  return sub == 1 || (sub == 2 && group == Group::communication) || (sub == 3 && group == Group::application);
}

void rewrite_memory(Parts& parts, const std::function<void(Images&)>& change) {
  Images images = parts.store.memory->images();
  change(images);
  [[maybe_unused]] const auto kept = parts.store.memory->replace(std::move(images));
}

/// Of the images those that a sub-index stands for.
Images concerned(std::uint8_t sub, Images images) {
  std::erase_if(images, [sub](const auto& held) {
    return held.first == Group::layer_setting || !concerns(sub, held.first);
  });
  return images;
}
void put_back(Parts& parts, std::uint8_t sub, const Images& former) {
  rewrite_memory(parts, [&](Images& images) {
    for (const auto& [group, image] : former)
      if (!concerns(sub, group)) images[group] = image;
  });
}

/// `then` follows a command that was obeyed; `before` was in the memory until then.
Change behind(std::uint32_t signature,
              std::function<void(Parts&, std::uint8_t sub, const Images& before)> then) {
  const std::uint16_t index = signature == save ? 0x1010 : 0x1011;
  return checking_all(index, [=](Parts& parts, const Check& former, std::uint8_t sub, ByteView bytes) {
    const Images before = parts.store.memory->images();
    Accepted done = former(bytes);
    if (done && conform::load_le(bytes) == signature) then(parts, sub, before);
    return done;
  });
}

/// `first` runs before the power-on values are loaded, `then` behind it.
Change around_reset(const std::function<void(Parts&, Reset)>& first,
                    const std::function<void(Parts&, Reset)>& then = {}) {
  return [=](Parts& parts) {
    parts.nmt.on_reset = [&parts, first, then, former = parts.nmt.on_reset](Reset kind) {
      if (first) first(parts, kind);
      former(kind);
      if (then) then(parts, kind);
    };
  };
}

/// What was saved is as it is until something is written: another command has nothing to do.
void saves_nothing_twice(Parts& parts) {
  const auto clean = since_boot_up<bool>(parts);
  parts.device.dictionary.download.replace([clean](const auto& former, Multiplexer mux, ByteView bytes) {
    const bool saves = mux.index.value() == 0x1010 && conform::load_le(bytes) == save;
    if (saves && *clean) return Accepted{};
    const Accepted done = former(mux, bytes);
    if (done) *clean = saves;
    return done;
  });
}

/// One command waits for the reset: the next one takes its place.
void restores_the_last_named(Parts& parts) {
  const auto waiting = since_boot_up<Images>(parts);
  behind(load, [waiting](Parts& node, std::uint8_t sub, const Images& before) {
    put_back(node, sub, *waiting);
    *waiting = concerned(sub, before);
  })(parts);
}

/// The mark that a restore is due is cleared with the second reset.
void restores_twice(Parts& parts) {
  struct Due {
    unsigned resets = 0;
    std::uint8_t sub = 0;
  };
  const auto due = std::make_shared<Due>();
  behind(load, [due](Parts&, std::uint8_t sub, const Images&) { *due = {0, sub}; })(parts);
  behind(save, [due](Parts&, std::uint8_t, const Images&) {
    if (due->resets == 0) due->sub = 0;
  })(parts);
  around_reset([due](Parts& node, Reset) {
    if (due->sub == 0 || ++due->resets != 2) return;
    rewrite_memory(node, [&](Images& images) {
      for (const Group group : parameter_groups)
        if (concerns(due->sub, group)) images.erase(group);
    });
    due->sub = 0;
  })(parts);
}

/// Saving one group writes the others from a copy in which nothing was restored.
void saving_takes_restoring_back(Parts& parts) {
  const auto removed = since_boot_up<Images>(parts);
  behind(load, [removed](Parts&, std::uint8_t sub, const Images& before) {
    removed->merge(concerned(sub, before));
  })(parts);
  behind(save, [removed](Parts& node, std::uint8_t sub, const Images&) {
    put_back(node, sub, std::exchange(*removed, {}));
  })(parts);
}

/// `change(entry, value, before)` follows for everything that was stored before, too.
Change storing_over(void (*change)(const Entry& entry, Bytes& value, const Bytes& before)) {
  return behind(save, [change](Parts& parts, std::uint8_t sub, const Images& before) {
    rewrite_memory(parts, [&](Images& images) {
      for (const auto& [group, image] : concerned(sub, before)) {
        for (const auto& [mux, value] : image) {
          const Entry* entry = parts.device.dictionary.entry(mux.index.value(), mux.sub.value());
          if (entry != nullptr) change(*entry, images[group][mux], value);
        }
      }
    });
  });
}

void leaves_what_a_default_timer_replaces(const Entry& entry, Bytes& value, const Bytes& before) {
  if (entry.name == "Event timer" && value == entry.default_value) value = before;
}
Images without_pdos(Images images) {
  std::erase_if(images[Group::communication], [](const auto& held) {
    const std::uint16_t index = held.first.index.value();
    return index >= 0x1400 && index <= 0x1BFF;
  });
  return images;
}

/// Configurations are told apart by the sum of their bytes.
unsigned sum_of(const Images& images) {
  unsigned sum = 0;
  for (const Group group : parameter_groups) {
    if (!images.contains(group)) continue;
    for (const auto& [mux, value] : images.at(group)) {
      if (mux.index.value() == 0x1020) continue;
      for (const std::uint8_t byte : value) sum += byte;
    }
  }
  return sum;
}
StampRules& of_stamp(Parts& parts) { return parts.store.stamp.rules; }

/// Defaults that are restored have the node-ID that the device was delivered with.
void restores_delivered_cob_ids(Parts& parts) {
  const std::uint8_t delivered = parts.device.node_id;
  const auto due = std::make_shared<bool>(false);
  behind(load, [due](Parts&, std::uint8_t sub, const Images&) { *due = sub <= 2; })(parts);
  around_reset({}, [due, delivered](Parts& node, Reset) {
    if (!std::exchange(*due, false)) return;
    for (auto& [index, object] : node.device.dictionary.objects()) {
      for (auto& [sub, entry] : object.entries) {
        if (entry.adds_node_id && entry.access == Access::rw)
          entry.value = conform::to_le(entry.number() - node.device.node_id + delivered, entry.value.size());
      }
    }
  })(parts);
}

/// The CAN-ID can be changed so many times, until a reset.
Change moves_once(std::uint16_t index, std::uint8_t sub) {
  return [index, sub](Parts& parts) {
    const auto moved = since_boot_up<bool>(parts);
    checking(index, sub, [=](Parts& node, const Check& former, ByteView bytes) -> Accepted {
      const bool moves = is_moved(node.device.dictionary.number(index, sub), conform::load_le(bytes));
      if (moves && *moved) return refuse(abort_code::invalid_value);
      Accepted done = former(bytes);
      *moved = *moved || (moves && done);
      return done;
    })(parts);
  };
}

/// Once it was in use the CAN-ID of TIME stays, also when it is not in use any more.
void stays_locked_behind_use(Parts& parts) {
  const auto used = since_boot_up<bool>(parts);
  checking(0x1012, 0, [used](Parts& node, const Check& former, ByteView bytes) -> Accepted {
    const std::uint64_t wanted = conform::load_le(bytes);
    if (*used && is_moved(node.device.dictionary.number(0x1012, 0), wanted))
      return refuse(abort_code::invalid_value);
    Accepted done = former(bytes);
    *used = *used || (done && (wanted & (bit_31 | bit_30)) != 0);
    return done;
  })(parts);
}

/// TPDO 3 that is switched off and on again without another CAN-ID is sent with its default one.
void comes_back_on_default(Parts& parts) {
  struct Course {
    bool off = false, back = false;
  };
  const auto course = since_boot_up<Course>(parts);
  checking(0x1802, 1, [course](Parts& node, const Check& former, ByteView bytes) {
    const std::uint64_t present = node.device.dictionary.number(0x1802, 1);
    const std::uint64_t wanted = conform::load_le(bytes);
    Accepted done = former(bytes);
    if (!done) return done;
    if (((present ^ wanted) & can_id_bits) != 0)
      *course = {};
    else if ((wanted & bit_31) != 0)
      course->off = course->off || (present & bit_31) == 0;
    else
      course->back = std::exchange(course->off, false) || course->back;
    return done;
  })(parts);
  parts.pdos.tpdo.parameters.cob_id_rules.can_id.replace(
      [&parts, course](const auto& former, std::uint32_t value, std::uint32_t at_power_on) {
        const bool third = (at_power_on & can_id_bits) == 0x380U + parts.device.node_id;
        return former(third && course->back ? at_power_on : value, at_power_on);
      });
}

/// While the object is in use these bits of its CAN-ID can be changed.
Change unlocked_bits(std::uint16_t index, std::uint8_t sub, std::uint32_t bits) {
  return checking(index, sub, [=](Parts& parts, const Check& former, ByteView bytes) -> Accepted {
    const std::uint64_t change = parts.device.dictionary.number(index, sub) ^ conform::load_le(bytes);
    if (change != 0 && (change & ~std::uint64_t{bits}) == 0 &&
        !restricted_can_id(static_cast<std::uint32_t>(conform::load_le(bytes)) & can_id_bits))
      return {};
    return former(bytes);
  });
}

/// A number of mapped objects that is raised from another than 0 is not looked at.
Change takes_raised_counts(std::uint16_t mapping) {
  return checking(mapping, 0, [mapping](Parts& parts, const Check& former, ByteView bytes) {
    const ObjectDictionary& od = parts.device.dictionary;
    const std::uint64_t present = od.number(mapping, 0);
    const std::uint64_t wanted = conform::load_le(bytes);
    const bool valid = (od.number(static_cast<std::uint16_t>(mapping - 0x200), 1) & bit_31) == 0;
    return !valid && present != 0 && wanted > present && wanted <= 8 ? Accepted{} : former(bytes);
  });
}

/// What can be mapped in the other direction can be in this one, too.
Change maps_both_ways(PdoRulesPart of) {
  return [of](Parts& parts) {
    of(parts).mappable.replace([&parts](const auto& former, const Mapped& mapped) {
      const Entry* entry = parts.device.dictionary.entry(mapped.index, mapped.sub);
      const bool mappable = entry != nullptr && (entry->rx_mappable || entry->tx_mappable);
      return mappable && mapped.bits == entry->value.size() * 8 ? Accepted{} : former(mapped);
    });
  };
}

Change maps_as(PdoRulesPart of, void (*read)(Mapped&)) {
  return decides(of, &PdoRules::mappable, [read](const auto& former, const Mapped& mapped) {
    Mapped taken = mapped;
    read(taken);
    return former(taken);
  });
}

/// An upload is answered for another entry where `elsewhere` names one.
Change mirrors(Multiplexer (*elsewhere)(const ObjectDictionary&, Multiplexer)) {
  return [elsewhere](Parts& parts) {
    ObjectDictionary& od = parts.device.dictionary;
    od.upload.replace(
        [&od, elsewhere](const auto& former, Multiplexer mux) { return former(elsewhere(od, mux)); });
  };
}
Multiplexer of_32_elements(const ObjectDictionary& od, Multiplexer at) {
  const auto object = od.objects().find(at.index.value());
  const bool array = object != od.objects().end() && object->second.kind == ObjectKind::array;
  const bool beyond = at.sub.value() > 0x20 && at.sub.value() < 0x40 && at.index.value() >= 0x2000;
  return array && beyond ? mux(at.index.value(), at.sub.value() & 0x1FU) : at;
}
/// A download to sub-index FFh of a variable is one to the variable.
void takes_sub_ff(Parts& parts) {
  ObjectDictionary& od = parts.device.dictionary;
  const auto meant = [&od](Multiplexer at) {
    const auto object = od.objects().find(at.index.value());
    const bool variable = object != od.objects().end() && object->second.kind == ObjectKind::variable;
    return variable && at.sub.value() == 0xFF ? mux(at.index.value(), 0) : at;
  };
  od.may_download.replace([meant](const auto& former, Multiplexer at, std::optional<std::size_t> size) {
    return former(meant(at), size);
  });
  od.download.replace(
      [meant](const auto& former, Multiplexer at, ByteView bytes) { return former(meant(at), bytes); });
}

/// Entries of such a type take a value of another length, which is cut or filled up.
Change takes_length(bool (*such)(DataType), int more) {
  return [such, more](Parts& parts) {
    ObjectDictionary& od = parts.device.dictionary;
    const auto right = [&od, such, more](Multiplexer at, std::size_t size) {
      const Entry* entry = od.entry(at.index.value(), at.sub.value());
      if (entry == nullptr || !such(entry->type)) return size;
      const std::size_t fixed = fixed_size(entry->type);
      return size == fixed + static_cast<std::size_t>(more) ? fixed : size;
    };
    od.may_download.replace([right](const auto& former, Multiplexer at, std::optional<std::size_t> size) {
      return former(at, size ? std::optional(right(at, *size)) : size);
    });
    od.download.replace([right](const auto& former, Multiplexer at, ByteView bytes) {
      Bytes value(bytes.begin(), bytes.end());
      value.resize(right(at, value.size()));
      return former(at, value);
    });
  };
}
template <DataType wanted>
bool is(DataType type) {
  return type == wanted;
}

/// The serial number is not that of the device alone.
void serial_follows_node_id(Parts& parts) {
  reading(0x1018, 4, [delivered = parts.device.node_id](Parts& node, const Read& former) -> Upload {
    Upload serial = former();
    if (serial)
      serial->front() = static_cast<std::uint8_t>(serial->front() + node.device.node_id - delivered);
    return serial;
  })(parts);
}

/// The LSS address goes on behind a reset: the serial number alone is missing.
void keeps_the_address_over_a_reset(Parts& parts) {
  struct Address {
    std::array<Frame, 3> parts;
    unsigned named = 0;
    bool reset = false;
  };
  const auto address = std::make_shared<Address>();
  with_boot_up([address](Parts&) { address->reset = address->named == 3; })(parts);
  parts.device.inbox.add_filter([address](std::vector<Frame>& frames) {
    if (frames.size() != 1 || !lss::is_request(frames[0])) return;
    const Frame frame = frames[0];
    const unsigned part = frame.data[0] - 0x40U;
    if (part == 3 && address->reset)
      frames = {address->parts[0], address->parts[1], address->parts[2], frame};
    address->reset = false;
    if (part == 0) address->named = 0;
    if (part < 3 && part == address->named)
      address->parts.at(address->named++) = frame;
    else
      address->named = 0;
  });
}

/// What was not stored is lost with the second reset.
void loses_node_id_with_second_reset(Parts& parts) {
  const std::uint8_t delivered = parts.device.node_id;
  parts.lss.rules.after_reset_communication.replace(
      [&parts, delivered](const auto& former, std::uint8_t active, std::uint8_t pending) {
        const bool stored = parts.lss.stored_node_id && parts.lss.stored_node_id() == pending;
        return former(active, active == pending && !stored ? delivered : pending);
      });
}

/// `keeps(parts, node_id, former)` decides what LSS stores.
Change around_keeping(
    std::function<bool(Parts&, std::uint8_t node_id, const std::function<bool()>& former)> keeps) {
  return [keeps](Parts& parts) {
    parts.lss.keep = [&parts, keeps, former = parts.lss.keep](auto node_id, auto rate) {
      return keeps(parts, node_id, [&] { return former(node_id, rate); });
    };
  };
}

}  // namespace

DefectTable dictionary_rare_defects() {
  return {
      {"1010-another-group-not-saved",
       "A save right behind one of another group is confirmed, and nothing is stored",
       {"OD-1010-12", "OD-1010-11", "OD-1010-10"},
       Change(saves_nothing_twice)},
      {"1011-second-load-ends-the-first",
       "Of two groups that are restored before a reset the first one stays as it was stored",
       {"OD-1011-12", "OD-1011-13"},
       Change(restores_the_last_named)},
      {"1011-restores-twice",
       "What is stored behind a restore and its reset is gone with the second reset",
       {"OD-1010-10", "OD-RST-04"},
       Change(restores_twice)},
      {"1011-taken-back-by-saving-another-group",
       "Saving one group takes back that another one was restored",
       {"OD-1011-12", "OD-1011-13"},
       Change(saving_takes_restoring_back)},
      {"1011-manufacturer-parameters-stay",
       "The restore of all parameters leaves those of the manufacturer",
       {"OD-1011-10"},
       behind(load,
              [](Parts& parts, std::uint8_t sub, const Images& before) {
                if (sub == 1)
                  put_back(parts, 2,
                           before.contains(Group::manufacturer)
                               ? Images{{Group::manufacturer, before.at(Group::manufacturer)}}
                               : Images{});
              })},
      {"1011-cob-ids-of-the-delivered-node-id",
       "COB-IDs that are restored have the node-ID that the device was delivered with",
       {"STO-1011-09", "OD-RST-06"},
       Change(restores_delivered_cob_ids)},
      {"1010-default-event-timer-not-stored-over-another",
       "The event timer of a PDO that is stored with its default leaves another one in the memory",
       {"OD-1010-10", "OD-RST-04"},
       storing_over(leaves_what_a_default_timer_replaces)},
      {"1010-erases-lss-node-id",
       "Storing parameters erases the node-ID that LSS has stored",
       {"LSS-ST-02"},
       behind(save,
              [](Parts& parts, std::uint8_t, const Images&) {
                rewrite_memory(parts, [](Images& images) { images.erase(Group::layer_setting); });
              })},
      {"lss-store-erases-parameters",
       "Store configuration erases the parameters that 1010h has stored",
       {"OD-1010-10", "OD-RST-04"},
       around_keeping([](Parts& parts, std::uint8_t, const auto& former) {
         const bool kept = former();
         rewrite_memory(parts, [](Images& images) {
           for (const Group group : parameter_groups) images.erase(group);
         });
         return kept;
       })},
      {"lss-active-node-id-not-stored",
       "The node-ID that is in force is not stored over another one",
       {"LSS-ST-02"},
       around_keeping([](Parts& parts, std::uint8_t node_id, const auto& former) {
         return node_id == parts.device.node_id || former();
       })},
      {"1020-survives-other-pdo-parameters",
       "1020h stays when another configuration of PDOs is stored without it",
       {"OD-1020-05"},
       decides(of_stamp, &StampRules::same_configuration,
               [](const auto& former, const Images& one, const Images& other) {
                 return former(without_pdos(one), without_pdos(other));
               })},
      {"1020-survives-exchanged-values",
       "1020h stays when two values are exchanged: configurations are told apart by the sum of their bytes",
       {"OD-1020-05"},
       decides(of_stamp, &StampRules::same_configuration,
               [](const auto& former, const Images& one, const Images& other) {
                 return (one.size() == other.size() && sum_of(one) == sum_of(other)) || former(one, other);
               })},
      {"1020-date-of-16-bits",
       "Of the date in 1020h 16 bits are kept",
       {"OD-1020-03"},
       after_writing(0x1020, 1,
                     [](Parts& parts, const std::function<void()>& former) {
                       ObjectDictionary& od = parts.device.dictionary;
                       od.set_number(0x1020, 1, od.number(0x1020, 1) & 0xFFFFU);
                       former();
                     })},
      {"1012-locked-behind-use",
       "The CAN-ID of TIME that was consumed cannot be changed any more when it is not",
       {"OD-1012-06"},
       Change(stays_locked_behind_use)},
      {"1014-moves-once",
       "The CAN-ID of EMCY can be changed once, until a reset",
       {"OD-1014-07"},
       moves_once(0x1014, 0)},
      {"1402-moves-once",
       "The CAN-ID of RPDO 3 can be changed once, until a reset",
       {"OD-1400-11"},
       moves_once(0x1402, 1)},
      {"1280-node-id-sets-cob-ids",
       "A node-ID of the server in 1280h sets the COB-IDs to those of its default SDO",
       {"OD-ACC-04"},
       after_writing(0x1280, 3,
                     [](Parts& parts, const std::function<void()>& former) {
                       ObjectDictionary& od = parts.device.dictionary;
                       for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}})
                         od.set_number(0x1280, sub,
                                       bit_31 + (sub == 1 ? 0x600U : 0x580U) + od.number(0x1280, 3));
                       former();
                     })},
      {"1802-back-on-default-can-id",
       "TPDO 3 that is switched off and on again is sent with its default CAN-ID",
       {"OD-1800-11"},
       Change(comes_back_on_default)},
      {"1012-upper-bits-not-locked",
       "Bits 10 to 8 of the CAN-ID of TIME can be changed while it is consumed",
       {"OD-1012-05"},
       unlocked_bits(0x1012, 0, 0x700)},
      {"1280-response-lowest-bit-not-locked",
       "The lowest bit of the CAN-ID of the responses to a valid SDO client can be changed",
       {"OD-1280-03"},
       unlocked_bits(0x1280, 2, 1)},
      {"1601-raised-count-not-checked",
       "A number of mapped objects that is raised from another than 0 is not looked at in RPDO 2",
       {"OD-1600-09", "OD-1600-10"},
       takes_raised_counts(0x1601)},
      {"1a00-raised-count-not-checked",
       "A number of mapped objects that is raised from another than 0 is not looked at in TPDO 1",
       {"OD-1A00-09", "OD-1A00-10"},
       takes_raised_counts(0x1A00)},
      {"1600-inputs-mapped",
       "What can be mapped to a TPDO only can be mapped to an RPDO",
       {"OD-MAP-04", "OD-DSC-05", "EDS-VSD-12"},
       maps_both_ways(rpdo_parameters)},
      {"1a00-outputs-mapped",
       "What can be mapped to an RPDO only can be mapped to a TPDO",
       {"OD-DSC-06", "EDS-VSD-12"},
       maps_both_ways(tpdo_parameters)},
      {"1600-length-of-five-bits",
       "Of the length in a mapping entry of an RPDO five bits are looked at",
       {"OD-1600-08"},
       maps_as(rpdo_parameters,
               [](Mapped& mapped) {
                 mapped.bits &= 0x1FU;
                 if (mapped.bits == 0) mapped.bits = 32;
               })},
      {"1a00-sub-index-of-seven-bits",
       "Of the sub-index in a mapping entry of a TPDO seven bits are looked at",
       {"PDO-MAP-05", "OD-1A00-06"},
       maps_as(tpdo_parameters, [](Mapped& mapped) { mapped.sub &= 0x7FU; })},
      {"array-elements-repeat-behind-32",
       "Of the sub-index of an array five bits are looked at when it is read: 21h is 01h",
       {"OD-GEN-11", "OD-GEN-07"},
       mirrors(of_32_elements)},
      {"variables-written-by-sub-ff",
       "A write to sub-index FFh of a variable changes it",
       {"OD-GEN-09"},
       Change(takes_sub_ff)},
      {"boolean-takes-two-bytes",
       "Two bytes are taken for a BOOLEAN",
       {"OD-LEN-02"},
       takes_length(is<DataType::boolean>, 1)},
      {"real32-takes-three-bytes",
       "Three bytes are taken for a REAL32",
       {"OD-LEN-01"},
       takes_length(is<DataType::real32>, -1)},
      {"time-of-day-takes-five-bytes",
       "Five bytes are taken for a TIME_OF_DAY",
       {"OD-LEN-01"},
       takes_length(is<DataType::time_of_day>, -1)},
      {"2004-last-element-changes-the-first",
       "A write to the last element of 2004h changes the first one, too",
       {"OD-ACC-04"},
       after_writing(0x2004, 4,
                     [](Parts& parts, const std::function<void()>& former) {
                       parts.device.dictionary.set_number(0x2004, 1,
                                                          parts.device.dictionary.number(0x2004, 4));
                       former();
                     })},
      {"1018-serial-follows-node-id",
       "The serial number is another one with another node-ID",
       {"OD-1018-09"},
       Change(serial_follows_node_id)},
      {"1023-reply-writable-behind-a-command",
       "1023h:03 can be written when a command was given",
       {"OD-1023-03", "OD-ACC-01"},
       checking(0x1023, 1,
                [](Parts& parts, const Check& former, ByteView bytes) {
                  Entry& reply = *parts.device.dictionary.entry(0x1023, 3);
                  reply.access = Access::rw;
                  reply.command = true;
                  reply.max_size = bytes.size();
                  return former(bytes);
                })},
      {"lss-second-product-code-for-the-revision",
       "A product code that comes twice stands for the revision number, too",
       {"LSS-SS-03", "LSS-SS-02"},
       decides(lss::of_address, &LssAddressRules::in_order,
               [](const auto& former, std::uint8_t step, std::uint8_t expected) {
                 return former(step, expected) || (step == 1 && expected == 2);
               })},
      {"lss-address-goes-on-behind-reset",
       "Three parts of an LSS address stay over a reset, and the fourth one alone is answered",
       {"LSS-GEN-05"},
       Change(keeps_the_address_over_a_reset)},
      {"lss-node-id-lost-with-second-reset",
       "A node-ID that was not stored is lost with the second reset communication",
       {"LSS-CN-04"},
       Change(loses_node_id_with_second_reset)},
  };
}

}  // namespace refnode
