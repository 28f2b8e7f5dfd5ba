// SPDX-License-Identifier: Apache-2.0
// Defects of storing (1010h) and restoring (1011h) parameters.
#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "defects/hooks.hpp"
#include "defects/power_on_values.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

PowerOnRules& of_power_on(Parts& parts) { return parts.store.rules; }

Bytes bytes_of(std::string_view text) { return Bytes(text.begin(), text.end()); }

bool is_save(std::uint64_t value) { return value == conform::load_le(bytes_of("save")); }
bool is_load(std::uint64_t value) { return value == conform::load_le(bytes_of("load")); }

/// 1010h or 1011h works as if this had been written in place of what was.
Change takes_for(std::uint16_t index, std::function<Bytes(Bytes)> other) {
  return checking_all(index, [other](Parts&, const Check& former, std::uint8_t, ByteView bytes) {
    return former(other(Bytes(bytes.begin(), bytes.end())));
  });
}

Bytes backwards(Bytes signature) {
  std::ranges::reverse(signature);
  return signature;
}

Bytes lower_case(Bytes signature) {
  for (std::uint8_t& letter : signature) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<std::uint8_t>(letter - 'A' + 'a');
  }
  return signature;
}

/// One letter of the signature is not looked at.
Change ignores_letter(std::uint16_t index, std::string_view signature, std::size_t letter) {
  return takes_for(index, [signature, letter](Bytes given) {
    if (letter < given.size()) given[letter] = static_cast<std::uint8_t>(signature[letter]);
    return given;
  });
}

/// Acts first and looks at the signature then.
Change acts_on_any(std::uint16_t index, std::string_view signature) {
  return checking_all(index, [signature](Parts&, const Check& former, std::uint8_t, ByteView bytes) {
    const Accepted done = former(bytes_of(signature));
    return done ? former(bytes) : done;
  });
}

/// The signature is confirmed, and nothing done.
Change without_effect(std::uint16_t index, bool (*is_signature)(std::uint64_t)) {
  return together(confirms(index, 1, is_signature), confirms(index, 2, is_signature),
                  confirms(index, 3, is_signature));
}

/// Whatever the sub-index, it is about all parameters.
Change means_all_parameters(std::uint16_t index) {
  return checking_all(index, [index](Parts& parts, const Check& former, std::uint8_t sub, ByteView bytes) {
    const Entry* all = parts.device.dictionary.entry(index, 1);
    return sub != 1 && all != nullptr && all->check ? all->check(bytes) : former(bytes);
  });
}

Change confirms_failure(std::uint16_t index) {
  return checking_all(index, [](Parts&, const Check& former, std::uint8_t, ByteView bytes) {
    const Accepted done = former(bytes);
    return done || done.error() != abort_code::hardware_error ? done : Accepted{};
  });
}

Filter refuses_failure(std::uint16_t index) {
  return wrong_abort(abort_code::hardware_error, abort_code::cannot_store, {index, index});
}

bool is_about(std::uint8_t sub, Group group) {
  return sub == 1 || (sub == 2 && group == Group::communication) || (sub == 3 && group == Group::application);
}

/// "load" gives the parameters their defaults without waiting for a reset.
Change defaults_at_once() {
  return checking_all(0x1011, [](Parts& parts, const Check& former, std::uint8_t sub, ByteView bytes) {
    const Accepted restored = former(bytes);
    for (auto& [index, object] : parts.device.dictionary.objects()) {
      if (!restored || !is_about(sub, group_of(conform::Index(index)))) continue;
      for (auto& [which, entry] : object.entries) {
        const bool writable = entry.access == Access::rw || entry.access == Access::wo;
        if (writable && !entry.command) entry.value = entry.default_value;
      }
    }
    return restored;
  });
}

/// Half a signature is confirmed like a whole one.
Filter confirms_half_a_signature(std::uint16_t index) {
  return [index](const FilterContext& context, std::vector<Outgoing>& frames) {
    const SdoExchange* sdo = context.sdo;
    if (sdo == nullptr || sdo->index() != index || sdo->step != SdoStep::download_initiate) return;
    if (sdo->aborted != abort_code::length_too_low) return;
    for (Outgoing& outgoing : frames) {
      outgoing.frame.data[0] = 0x60;
      std::ranges::fill(std::span(outgoing.frame.data).subspan(4), std::uint8_t{0});
    }
  };
}

/// The memory needs some time after the confirmation, and a reset before that leaves nothing of what was
/// stored.
void confirms_before_it_has_stored(Parts& parts) {
  struct Memory {
    std::optional<BusTime> begun;
    bool lost = false;
  };
  const auto memory = std::make_shared<Memory>();
  checking_all(0x1010, [memory](Parts& node, const Check& former, std::uint8_t, ByteView bytes) {
    Accepted stored = former(bytes);
    if (stored) *memory = {node.device.now, false};
    return stored;
  })(parts);
  parts.store.rules.stored_values.replace(
      [memory, &parts](const auto& former, const Images& images, Group group) {
        constexpr Duration needed = std::chrono::milliseconds(30);
        if (memory->begun) memory->lost = parts.device.now - *memory->begun < needed;
        memory->begun.reset();
        return !memory->lost && former(images, group);
      });
}

/// With the reset that makes the defaults valid 1014h loses the node-ID.
void restores_without_node_id(Parts& parts) {
  const auto restored = std::make_shared<bool>(false);
  checking(0x1011, 1, [restored](Parts&, const Check& former, ByteView bytes) {
    const Accepted done = former(bytes);
    *restored = done.has_value();
    return done;
  })(parts);
  parts.device.outbox.add_filter([restored, &parts](const FilterContext& context, std::vector<Outgoing>&) {
    if (context.service == Service::boot_up && std::exchange(*restored, false))
      parts.device.dictionary.set_number(0x1014, 0, 0x80);
  });
}

/// Behind "load" the next reset restores everything, whichever it is.
void any_reset_restores(Parts& parts) {
  const auto loading = since_boot_up<bool>(parts);
  checking_all(0x1011, [loading](Parts&, const Check& former, std::uint8_t, ByteView bytes) {
    const Accepted loaded = former(bytes);
    if (loaded) *loading = true;
    return loaded;
  })(parts);
  parts.store.rules.reset_loads.replace([loading](const auto& former, Group group, bool whole_node) {
    return former(group, whole_node) || *loading;
  });
}

bool is_later_communication(std::uint16_t index, std::uint8_t) {
  return (index > 0x1400 && index < 0x1600) || (index > 0x1800 && index < 0x1A00);
}
bool is_mapped_object(std::uint16_t index, std::uint8_t sub) {
  return sub != 0 && ((index >= 0x1600 && index < 0x1800) || (index >= 0x1A00 && index < 0x1C00));
}

/// A byte that is 0 is not stored.
void leaves_out_zeros(Entry& entry) {
  const Entry* self = &entry;  // entries live in maps: they do not move
  entry.not_stored_now = [self, former = entry.not_stored_now] {
    const bool zero = self->value.size() == 1 && self->value.front() == 0;
    return zero || (former && former());
  };
}

/// Behind "load" the next "save" is confirmed, and the defaults come all the same.
void restore_outlives_save(Parts& parts) {
  const auto restored = since_boot_up<bool>(parts);
  checking_all(0x1011, [restored](Parts&, const Check& former, std::uint8_t, ByteView bytes) {
    const Accepted done = former(bytes);
    *restored = *restored || done.has_value();
    return done;
  })(parts);
  checking_all(0x1010, [restored](Parts&, const Check& former, std::uint8_t, ByteView bytes) {
    return *restored && is_save(conform::load_le(bytes)) ? Accepted{} : former(bytes);
  })(parts);
}

/// Once a signature was wrong none is right any more.
void locked_by_a_wrong_signature(Parts& parts) {
  const auto locked = since_boot_up<bool>(parts);
  checking_all(0x1010, [locked](Parts& node, const Check& former, std::uint8_t, ByteView bytes) -> Accepted {
    if (!is_save(conform::load_le(bytes))) *locked = true;
    if (*locked) return refuse(node.store.choices.wrong_signature);
    return former(bytes);
  })(parts);
}

/// In Operational a right command is confirmed and nothing is done.
Change does_nothing_in_operational(std::uint16_t index, std::uint32_t signature) {
  return checking_all(index, [signature](Parts& parts, const Check& former, std::uint8_t, ByteView bytes) {
    const bool right = bytes.size() == 4 && conform::load_le(bytes) == signature;
    if (right && parts.device.state == NmtState::operational) return Accepted();
    return former(bytes);
  });
}

/// With the communication parameters stored anew the application parameters in the memory are gone.
Change stores_one_group_only() {
  return checking(0x1010, 2, [](Parts& parts, const Check& former, ByteView bytes) -> Accepted {
    const Accepted done = former(bytes);
    if (!done) return done;
    Images images = parts.store.memory->images();
    images.erase(Group::application);
    if (!parts.store.memory->replace(std::move(images))) return refuse(abort_code::hardware_error);
    return {};
  });
}

}  // namespace

DefectTable storage_defects() {
  const auto signature_at = [](std::uint16_t index) {
    return wrong_abort(abort_code::cannot_store, abort_code::general_error, {index, index});
  };
  return {
      {"1010-save-rejected",
       "The signature \"save\" is refused with 0800 0020h",
       {"OD-1010-07", "STO-1010-04"},
       respond(
           [](const SdoExchange& e) {
             return e.index() == 0x1010 && e.step == SdoStep::download_initiate && !e.aborted;
           },
           0x80, 0x08000020)},
      {"1010-save-no-response",
       "\"save\" gets no answer",
       {"OD-1010-07", "STO-1010-04"},
       silent([](const SdoExchange& e) {
         return e.index() == 0x1010 && e.step == SdoStep::download_initiate && !e.aborted;
       })},
      {"1010-signature-byte-order",
       "1010h wants the signature with its bytes reversed",
       {"OD-1010-07", "OD-1010-08", "STO-1010-03"},
       takes_for(0x1010, backwards)},
      {"1010-wrong-signature-accepted",
       "1010h stores with any signature",
       {"OD-1010-08", "OD-1010-09", "STO-1010-02", "STO-1010-03"},
       takes_for(0x1010, [](const Bytes&) { return bytes_of("save"); })},
      {"1010-wrong-signature-wrong-abort",
       "A wrong signature in 1010h is aborted with 0800 0000h",
       {"OD-1010-08"},
       signature_at(0x1010)},
      {"1010-signature-case-insensitive",
       "1010h accepts \"SAVE\"",
       {"OD-1010-08"},
       takes_for(0x1010, lower_case)},
      {"1010-first-letter-ignored",
       "1010h stores whatever the first letter of the signature is",
       {"OD-1010-08"},
       ignores_letter(0x1010, "save", 0)},
      {"1010-second-letter-ignored",
       "1010h stores whatever the second letter of the signature is",
       {"OD-1010-08"},
       ignores_letter(0x1010, "save", 1)},
      {"1010-third-letter-ignored",
       "1010h stores whatever the third letter of the signature is",
       {"OD-1010-08"},
       ignores_letter(0x1010, "save", 2)},
      {"1010-last-letter-ignored",
       "1010h stores whatever the last letter of the signature is",
       {"OD-1010-08"},
       ignores_letter(0x1010, "save", 3)},
      {"1010-wrong-signature-still-saves",
       "A wrong signature in 1010h is refused, but stores",
       {"OD-1010-09", "STO-1010-02"},
       acts_on_any(0x1010, "save")},
      {"1010-save-not-persistent",
       "\"save\" is confirmed without storing anything",
       {"OD-1010-10", "STO-1010-04", "STO-1010-05", "OD-RST-04"},
       without_effect(0x1010, is_save)},
      {"1010-stored-values-ignored",
       "Stored values are not used at start-up",
       {"OD-1010-10", "OD-RST-04", "STO-1010-04", "STO-1010-05", "STO-1010-13"},
       decides(of_power_on, &PowerOnRules::stored_values,
               [](const auto&, const Images&, Group) { return false; })},
      {"1010-confirmed-before-it-has-stored",
       "\"save\" is confirmed 30 ms before the parameters are stored, and a reset in between loses them",
       {"OD-1010-15", "OD-1010-10", "OD-RST-04", "STO-1010-13"},
       Change(confirms_before_it_has_stored)},
      {"1010-half-a-signature-confirmed",
       "1010h confirms a signature of two bytes",
       {"OD-1010-20"},
       confirms_half_a_signature(0x1010)},
      {"1010-sub2-is-u16", "1010h:02 has two bytes", {"OD-1010-05"}, type(0x1010, 2, DataType::unsigned16)},
      {"1010-no-response-in-operational",
       "\"save\" gets no answer in Operational",
       {"STO-1010-12"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         const SdoExchange* sdo = context.sdo;
         if (sdo == nullptr || sdo->index() != 0x1010 || context.state != NmtState::operational) return;
         if (sdo->step == SdoStep::download_initiate && !sdo->aborted) frames.clear();
       })},
      {"1010-sub2-saves-nothing",
       "1010h:02 confirms without storing",
       {"OD-1010-11", "STO-1010-07"},
       confirms(0x1010, 2, is_save)},
      {"1010-sub3-saves-nothing",
       "1010h:03 confirms without storing",
       {"OD-1010-12", "STO-1010-08"},
       confirms(0x1010, 3, is_save)},
      {"1010-sub3-refused",
       "1010h:03 says that it stores, and refuses \"save\" as absent",
       {"OD-1010-12", "STO-1010-08"},
       respond(
           [](const SdoExchange& e) {
             return e.index() == 0x1010 && e.sub() == 3 && e.step == SdoStep::download_initiate && !e.aborted;
           },
           0x80, 0x06090011)},
      {"1010-groups-mixed",
       "Every sub-index of 1010h stores all parameters",
       {"OD-1010-11", "OD-1010-12", "STO-1010-07", "STO-1010-08"},
       means_all_parameters(0x1010)},
      {"1010-failed-save-confirmed",
       "A failure to store is confirmed",
       {"OD-1010-14"},
       confirms_failure(0x1010)},
      {"1010-failed-save-wrong-abort",
       "A failure to store is aborted with 0800 0020h",
       {"OD-1010-14"},
       refuses_failure(0x1010)},
      {"1011-load-rejected",
       "The signature \"load\" is refused with 0800 0020h",
       {"OD-1011-07", "STO-1011-03"},
       respond(
           [](const SdoExchange& e) {
             return e.index() == 0x1011 && e.step == SdoStep::download_initiate && !e.aborted;
           },
           0x80, 0x08000020)},
      {"1011-load-no-response",
       "\"load\" gets no answer",
       {"OD-1011-07", "STO-1011-03"},
       silent([](const SdoExchange& e) {
         return e.index() == 0x1011 && e.step == SdoStep::download_initiate && !e.aborted;
       })},
      {"1011-signature-byte-order",
       "1011h wants the signature with its bytes reversed",
       {"OD-1011-07", "OD-1011-08", "STO-1011-08"},
       takes_for(0x1011, backwards)},
      {"1011-wrong-signature-accepted",
       "1011h restores with any signature",
       {"OD-1011-08", "OD-1011-09", "STO-1011-02", "STO-1011-08"},
       takes_for(0x1011, [](const Bytes&) { return bytes_of("load"); })},
      {"1011-wrong-signature-wrong-abort",
       "A wrong signature in 1011h is aborted with 0800 0000h",
       {"OD-1011-08"},
       signature_at(0x1011)},
      {"1011-signature-case-insensitive",
       "1011h accepts \"LOAD\"",
       {"OD-1011-08"},
       takes_for(0x1011, lower_case)},
      {"1011-first-letter-ignored",
       "1011h restores whatever the first letter of the signature is",
       {"OD-1011-08"},
       ignores_letter(0x1011, "load", 0)},
      {"1011-second-letter-ignored",
       "1011h restores whatever the second letter of the signature is",
       {"OD-1011-08"},
       ignores_letter(0x1011, "load", 1)},
      {"1011-third-letter-ignored",
       "1011h restores whatever the third letter of the signature is",
       {"OD-1011-08"},
       ignores_letter(0x1011, "load", 2)},
      {"1011-last-letter-ignored",
       "1011h restores whatever the last letter of the signature is",
       {"OD-1011-08"},
       ignores_letter(0x1011, "load", 3)},
      {"1011-wrong-signature-still-restores",
       "A wrong signature in 1011h is refused, but restores",
       {"OD-1011-09", "STO-1011-02"},
       acts_on_any(0x1011, "load")},
      {"1011-load-without-effect",
       "\"load\" is confirmed without restoring anything",
       {"OD-1011-10", "STO-1011-03", "OD-RST-05"},
       without_effect(0x1011, is_load)},
      {"1011-defaults-before-reset",
       "\"load\" makes the defaults valid at once",
       {"OD-1011-11", "STO-1011-04"},
       defaults_at_once()},
      {"1011-half-a-signature-confirmed",
       "1011h confirms a signature of two bytes",
       {"OD-1011-17"},
       confirms_half_a_signature(0x1011)},
      {"1011-sub2-is-u16", "1011h:02 has two bytes", {"OD-1011-05"}, type(0x1011, 2, DataType::unsigned16)},
      {"1011-cob-id-without-node-id",
       "After \"load\" and a reset 1014h is 80h, without the node-ID",
       {"STO-1011-09"},
       Change(restores_without_node_id)},
      {"1011-sub2-without-effect",
       "1011h:02 confirms without restoring",
       {"OD-1011-12", "STO-1011-05"},
       confirms(0x1011, 2, is_load)},
      {"1011-sub3-without-effect",
       "1011h:03 confirms without restoring",
       {"OD-1011-13", "STO-1011-06"},
       confirms(0x1011, 3, is_load)},
      {"1011-groups-mixed",
       "Every sub-index of 1011h restores all parameters",
       {"OD-1011-12", "OD-1011-13", "STO-1011-05", "STO-1011-06"},
       means_all_parameters(0x1011)},
      {"1011-failed-load-confirmed",
       "A failure to restore is confirmed",
       {"OD-1011-15"},
       confirms_failure(0x1011)},
      {"1011-failed-load-wrong-abort",
       "A failure to restore is aborted with 0800 0020h",
       {"OD-1011-15"},
       refuses_failure(0x1011)},
      {"1010-later-pdo-parameters-not-stored",
       "Of the communication parameters of PDOs those of the first ones are stored only",
       {"OD-RST-04"},
       leaves_out(is_later_communication)},
      {"1010-mapped-objects-not-stored",
       "Of mappings the number of objects is stored only",
       {"OD-RST-04", "OD-1010-10"},
       leaves_out(is_mapped_object)},
      {"1010-zero-byte-not-stored",
       "Values of one byte that are 0 are not stored",
       {"OD-RST-04"},
       everywhere(leaves_out_zeros)},
      {"1010-texts-cut",
       "Of texts eight characters are stored",
       {"OD-1010-10"},
       comes_back([](std::uint16_t, const Entry& entry, Bytes& value) {
         if (fixed_size(entry.type) == 0 && value.size() > 8) value.resize(8);
       })},
      {"1010-long-values-cut",
       "Of values of more than four bytes the first four are stored",
       {"OD-1010-10"},
       comes_back([](std::uint16_t, const Entry& entry, Bytes& value) {
         if (fixed_size(entry.type) > 4) std::fill(value.begin() + 4, value.end(), std::uint8_t{0});
       })},
      {"1011-restore-outlives-save",
       "What is stored behind \"load\" is confirmed, and the defaults come with the reset",
       {"OD-1010-10"},
       Change(restore_outlives_save)},
      {"1010-confirmed-without-effect-in-operational",
       "In Operational \"save\" is confirmed and nothing is stored",
       {"OD-1010-15"},
       does_nothing_in_operational(0x1010, 0x65766173)},
      {"1011-confirmed-without-effect-in-operational",
       "In Operational \"load\" is confirmed and nothing is restored",
       {"OD-1011-10"},
       does_nothing_in_operational(0x1011, 0x64616F6C)},
      {"1010-communication-erases-application",
       "Storing the communication parameters erases the application parameters that were stored",
       {"OD-1010-12"},
       stores_one_group_only()},
      {"1010-locked-by-wrong-signature",
       "Behind a wrong signature 1010h refuses the right one, until a reset",
       {"OD-1010-07"},
       Change(locked_by_a_wrong_signature)},
      {"1011-any-reset-restores",
       "Behind \"load\" reset communication restores the application parameters, too",
       {"OD-1011-10", "OD-1011-13"},
       Change(any_reset_restores)},
      {"1010-rpdo-mapping-not-stored",
       "The mapping of RPDOs is not stored",
       {"OD-1010-10"},
       leaves_out([](std::uint16_t index, std::uint8_t) { return index >= 0x1600 && index < 0x1800; })},
      {"1010-last-monitored-node-not-stored",
       "Of 1016h the first entry alone is stored",
       {"OD-1010-10", "OD-RST-04"},
       leaves_out([](std::uint16_t index, std::uint8_t sub) { return index == 0x1016 && sub > 1; })},
      {"1010-sync-start-value-not-stored",
       "The SYNC start value of TPDOs is not stored",
       {"OD-1010-10"},
       leaves_out([](std::uint16_t index, std::uint8_t sub) {
         return index >= 0x1800 && index < 0x1A00 && sub == 6;
       })},
  };
}

}  // namespace refnode
