// SPDX-License-Identifier: Apache-2.0
// Defects of storing (1010h) and restoring (1011h) that show with certain values and transfers, or behind
// another command.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>

#include "defects/hooks.hpp"
#include "defects/power_on_values.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr std::uint32_t save_signature = 0x65766173;
constexpr std::uint32_t load_signature = 0x64616F6C;

/// A command that fails with the hardware error erases the memory all the same.
Change failure_erases(std::uint16_t index) {
  return checking_all(index, [](Parts& parts, const Check& former, std::uint8_t, ByteView bytes) -> Accepted {
    const Accepted done = former(bytes);
    if (!done && done.error() == abort_code::hardware_error) [[maybe_unused]]
      const auto erased = parts.store.memory->replace({});
    return done;
  });
}

/// From the command on the entry reads as its signature, until a reset.
Change shows_its_command(std::uint16_t index, std::uint32_t signature) {
  return [index, signature](Parts& parts) {
    const auto given = since_boot_up<std::uint8_t>(parts);
    checking_all(index, [given](Parts&, const Check& former, std::uint8_t sub, ByteView bytes) {
      const Accepted done = former(bytes);
      if (done) *given = sub;
      return done;
    })(parts);
    reading_all(index, [given, signature](Parts&, const Read& former, std::uint8_t sub) -> Upload {
      if (*given != sub) return former();
      Bytes out(4);
      conform::store_le(std::span(out), signature);
      return out;
    })(parts);
  };
}

/// What begins such a transfer is confirmed at its end, and nothing done.
Change does_nothing_by(std::uint16_t index, std::uint32_t signature, bool (*begins)(std::uint8_t command)) {
  return [=](Parts& parts) {
    const auto such = std::make_shared<bool>(false);
    misreads([such, index, begins](Parts& node, Frame& frame) {
      const bool request = frame.id == 0x600U + node.device.node_id && !frame.extended && !frame.remote;
      if (!request || frame.size() != 8) return;
      const unsigned named = frame.data[1] | unsigned{frame.data[2]} << 8U;
      const std::uint8_t command = frame.data[0];
      const bool initiates = command >> 5U == 1 || (command >> 5U == 6 && (command & 1U) == 0);
      if (initiates && named == index) *such = begins(command);
    })(parts);
    checking_all(index, [such, signature](Parts&, const Check& former, std::uint8_t, ByteView bytes) {
      return *such && conform::load_le(bytes) == signature ? Accepted{} : former(bytes);
    })(parts);
  };
}

bool begins_segments(std::uint8_t command) { return command >> 5U == 1 && (command & 2U) == 0; }
bool begins_blocks(std::uint8_t command) { return command >> 5U == 6; }

/// The dynamic bit of an SDO client is no reason not to store it.
void stores_dynamic_clients(ObjectDictionary& od, std::uint8_t) {
  for (auto& [index, object] : od.objects()) {
    if (index < 0x1280 || index > 0x12FF) continue;
    for (auto& [sub, entry] : object.entries) entry.not_stored_now = {};
  }
}

/// Once application parameters are stored, reset communication loads them, too.
void loads_stored_application(Parts& parts) {
  parts.store.rules.reset_loads.replace([&parts](const auto& former, Group group, bool whole_node) {
    const bool stored = group == Group::application && parts.store.memory->images().contains(group);
    return stored || former(group, whole_node);
  });
}

bool is_later_element_of_application(std::uint16_t index, std::uint8_t sub) {
  return index >= 0x6000 && index <= 0x9FFF && sub > 4;
}

void cuts_at_16(std::uint16_t, const Entry& entry, Bytes& value) {
  constexpr std::size_t kept = 16;
  if (fixed_size(entry.type) == 0 && value.size() > kept) value.resize(kept);
}

void takes_empty_for_nothing(std::uint16_t, const Entry& entry, Bytes& value) {
  if (value.empty()) value = entry.default_value;
}

void takes_ff_for_nothing(std::uint16_t, const Entry& entry, Bytes& value) {
  const bool erased = std::ranges::all_of(value, [](std::uint8_t byte) { return byte == 0xFF; });
  if (fixed_size(entry.type) != 0 && erased) value = entry.default_value;
}

template <std::uint16_t first, std::uint16_t last>
void loses_bit31(std::uint16_t index, const Entry& entry, Bytes& value) {
  const bool cob_id = index >= first && index <= last && entry.type == DataType::unsigned32;
  if (cob_id && (entry.default_value[3] & 0x80U) == 0) value[3] &= 0x7FU;
}

/// TIME is neither consumed nor produced behind a reset.
void loses_bits_of_time(std::uint16_t index, const Entry&, Bytes& value) {
  if (index == 0x1012) value[3] &= 0x3FU;
}

/// One sub-index takes the signature of the other object for its own.
Change takes_also(std::uint16_t index, std::uint8_t sub, std::uint32_t other, std::uint32_t right) {
  return checking(index, sub, [other, right](Parts&, const Check& former, ByteView bytes) {
    return former(conform::load_le(bytes) == other ? conform::to_le(right, 4)
                                                   : Bytes(bytes.begin(), bytes.end()));
  });
}
/// One sub-index acts first and looks at the signature then.
Change acts_on_any(std::uint16_t index, std::uint8_t sub, std::uint32_t right) {
  return checking(index, sub, [right](Parts&, const Check& former, ByteView bytes) {
    const Accepted done = former(conform::to_le(right, 4));
    return done ? former(bytes) : done;
  });
}

/// Behind a wrong signature the entry reads as 0: it can nothing any more, until a reset.
Change loses_capability(std::uint16_t index) {
  return [index](Parts& parts) {
    const auto lost = since_boot_up<std::uint8_t>(parts);
    checking_all(index, [lost](Parts&, const Check& former, std::uint8_t sub, ByteView bytes) {
      const Accepted done = former(bytes);
      if (!done) *lost = sub;
      return done;
    })(parts);
    reading_all(index, [lost](Parts&, const Read& former, std::uint8_t sub) -> Upload {
      return *lost == sub ? Bytes(4) : former();
    })(parts);
  };
}

/// The last parameter of a group is none to 1010h.
DictionaryEdit leaves_out_last(Group group) {
  return [group](ObjectDictionary& od, std::uint8_t) {
    Entry* last = nullptr;
    for (auto& [index, object] : od.objects()) {
      if (group_of(conform::Index(index)) != group) continue;
      for (auto& [sub, entry] : object.entries) {
        if (entry.access == Access::rw && !entry.command && entry.storable) last = &entry;
      }
    }
    if (last != nullptr) last->storable = false;
  };
}

/// 1001h is stored as well, and from a reset on shows what it held then.
void stores_the_error_register(Parts& parts) {
  const auto stored = std::make_shared<std::uint8_t>();
  const auto loaded = std::make_shared<std::uint8_t>();
  checking_all(0x1010, [stored](Parts& node, const Check& former, std::uint8_t sub, ByteView bytes) {
    const Accepted done = former(bytes);
    if (done && sub <= 2) *stored = static_cast<std::uint8_t>(node.emergency.error_register());
    return done;
  })(parts);
  with_boot_up([stored, loaded](Parts&) { *loaded = *stored; })(parts);
  reading(0x1001, 0, [loaded](Parts&, const Read& former) -> Upload {
    Upload shown = former();
    if (shown && !shown->empty()) shown->front() |= *loaded;
    return shown;
  })(parts);
}

/// Of one entry so many bytes are stored.
template <std::uint16_t at, std::size_t kept>
void cuts(std::uint16_t index, const Entry&, Bytes& value) {
  if (index == at) std::ranges::fill(std::span(value).subspan(kept), std::uint8_t{0});
}

}  // namespace

DefectTable storage_course_defects() {
  return {
      {"1010-failure-erases",
       "\"save\" that fails erases what was stored",
       {"OD-1010-14"},
       failure_erases(0x1010)},
      {"1011-failure-erases",
       "\"load\" that fails erases what was stored",
       {"OD-1011-15"},
       failure_erases(0x1011)},
      {"1010-shows-the-signature",
       "Behind \"save\" 1010h reads as the signature",
       {"OD-1010-04"},
       shows_its_command(0x1010, save_signature)},
      {"1011-shows-the-signature",
       "Behind \"load\" 1011h reads as the signature, until the reset",
       {"OD-1011-04"},
       shows_its_command(0x1011, load_signature)},
      {"1010-by-segments-without-effect",
       "\"save\" in a segment is confirmed, and nothing is stored",
       {"OD-1010-10"},
       does_nothing_by(0x1010, save_signature, begins_segments)},
      {"1010-by-blocks-without-effect",
       "\"save\" in a block is confirmed, and nothing is stored",
       {"OD-1010-10"},
       does_nothing_by(0x1010, save_signature, begins_blocks)},
      {"1011-by-segments-without-effect",
       "\"load\" in a segment is confirmed, and nothing is restored",
       {"OD-1011-10"},
       does_nothing_by(0x1011, load_signature, begins_segments)},
      {"1011-by-blocks-without-effect",
       "\"load\" in a block is confirmed, and nothing is restored",
       {"OD-1011-10"},
       does_nothing_by(0x1011, load_signature, begins_blocks)},
      {"1010-texts-cut-at-16", "Of texts 16 characters are stored", {"OD-1010-10"}, comes_back(cuts_at_16)},
      {"1010-empty-text-not-stored",
       "A text that is stored empty comes back as the default",
       {"OD-1010-10"},
       comes_back(takes_empty_for_nothing)},
      {"1010-ff-taken-for-erased",
       "A value that is stored with all bytes FFh comes back as the default",
       {"OD-1010-10"},
       comes_back(takes_ff_for_nothing)},
      {"1010-tpdo-switched-off-not-stored",
       "A TPDO that was stored switched off is valid after a reset",
       {"OD-1010-10"},
       comes_back(loses_bit31<0x1800, 0x19FF>)},
      {"1010-rpdo-switched-off-not-stored",
       "An RPDO that was stored switched off is valid after a reset",
       {"OD-1010-10"},
       comes_back(loses_bit31<0x1400, 0x15FF>)},
      {"1010-emcy-switched-off-not-stored",
       "EMCY that was stored switched off is valid after a reset",
       {"OD-1010-10"},
       comes_back(loses_bit31<0x1014, 0x1014>)},
      {"1010-sdo-channel-switched-off-not-stored",
       "A COB-ID of an SDO channel that was stored switched off is valid after a reset",
       {"OD-1010-10"},
       comes_back([](std::uint16_t index, const Entry& entry, Bytes& value) {
         const bool channel = index >= 0x1201 && index <= 0x12FF;
         if (channel && entry.type == DataType::unsigned32) value[3] &= 0x7FU;
       })},
      {"1010-time-switched-on-not-stored",
       "TIME that was stored consumed or produced is neither after a reset",
       {"OD-1010-10"},
       comes_back(loses_bits_of_time)},
      {"1280-dynamic-stored",
       "Dynamic COB-IDs of an SDO client are stored",
       {"OD-1201-08"},
       DictionaryEdit(stores_dynamic_clients)},
      {"1010-later-elements-not-stored",
       "Of the arrays of the application four elements are stored",
       {"OD-1010-10"},
       leaves_out(is_later_element_of_application)},
      {"reset-communication-loads-stored-application",
       "Reset communication loads the application parameters, too, once they were stored",
       {"NMT-FSA-26"},
       Change(loads_stored_application)},
      {"1010-sub2-takes-load",
       "1010h:02 takes \"load\" for \"save\"",
       {"OD-1010-08"},
       takes_also(0x1010, 2, load_signature, save_signature)},
      {"1010-sub2-wrong-signature-wrong-abort",
       "A wrong signature in 1010h:02 is aborted with 0609 0030h",
       {"OD-1010-08"},
       wrong_abort_at(mux(0x1010, 2), abort_code::cannot_store, abort_code::invalid_value)},
      {"1010-sub2-wrong-signature-still-stores",
       "A wrong signature in 1010h:02 is refused, but stores the communication parameters",
       {"OD-1010-09"},
       acts_on_any(0x1010, 2, save_signature)},
      {"1010-sub3-takes-load",
       "1010h:03 takes \"load\" for \"save\"",
       {"OD-1010-08"},
       takes_also(0x1010, 3, load_signature, save_signature)},
      {"1010-sub3-wrong-signature-wrong-abort",
       "A wrong signature in 1010h:03 is aborted with 0609 0030h",
       {"OD-1010-08"},
       wrong_abort_at(mux(0x1010, 3), abort_code::cannot_store, abort_code::invalid_value)},
      {"1010-sub3-wrong-signature-still-stores",
       "A wrong signature in 1010h:03 is refused, but stores the application parameters",
       {"OD-1010-09"},
       acts_on_any(0x1010, 3, save_signature)},
      {"1010-wrong-signature-loses-capability",
       "Behind a wrong signature 1010h reads as 0",
       {"OD-1010-04"},
       loses_capability(0x1010)},
      {"1011-sub2-takes-save",
       "1011h:02 takes \"save\" for \"load\"",
       {"OD-1011-08"},
       takes_also(0x1011, 2, save_signature, load_signature)},
      {"1011-sub2-wrong-signature-wrong-abort",
       "A wrong signature in 1011h:02 is aborted with 0609 0030h",
       {"OD-1011-08"},
       wrong_abort_at(mux(0x1011, 2), abort_code::cannot_store, abort_code::invalid_value)},
      {"1011-sub2-wrong-signature-still-restores",
       "A wrong signature in 1011h:02 is refused, but restores the communication parameters",
       {"OD-1011-09"},
       acts_on_any(0x1011, 2, load_signature)},
      {"1011-sub3-takes-save",
       "1011h:03 takes \"save\" for \"load\"",
       {"OD-1011-08"},
       takes_also(0x1011, 3, save_signature, load_signature)},
      {"1011-sub3-wrong-signature-wrong-abort",
       "A wrong signature in 1011h:03 is aborted with 0609 0030h",
       {"OD-1011-08"},
       wrong_abort_at(mux(0x1011, 3), abort_code::cannot_store, abort_code::invalid_value)},
      {"1011-sub3-wrong-signature-still-restores",
       "A wrong signature in 1011h:03 is refused, but restores the application parameters",
       {"OD-1011-09"},
       acts_on_any(0x1011, 3, load_signature)},
      {"1011-wrong-signature-loses-capability",
       "Behind a wrong signature 1011h reads as 0",
       {"OD-1011-04"},
       loses_capability(0x1011)},
      {"1010-last-communication-parameter-not-stored",
       "The last communication parameter is not stored",
       {"OD-1010-10"},
       leaves_out_last(Group::communication)},
      {"1010-last-application-parameter-not-stored",
       "The last application parameter is not stored",
       {"OD-1010-10"},
       leaves_out_last(Group::application)},
      {"1010-16-bits-of-the-period-stored",
       "Of the communication cycle period (1006h) 16 bits are stored",
       {"OD-1010-10"},
       comes_back(cuts<0x1006, 2>)},
      {"1010-16-bits-of-the-window-stored",
       "Of the synchronous window length (1007h) 16 bits are stored",
       {"OD-1010-10"},
       comes_back(cuts<0x1007, 2>)},
      {"1001-stored",
       "An error that is in 1001h when parameters are stored is in it from each reset on",
       {"OD-1001-06"},
       Change(stores_the_error_register)},
      {"1010-8-bits-of-the-inhibit-time-stored",
       "Of the inhibit time of EMCY (1015h) eight bits are stored",
       {"OD-1010-10"},
       comes_back(cuts<0x1015, 1>)},
  };
}

}  // namespace refnode
