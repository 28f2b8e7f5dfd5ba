// SPDX-License-Identifier: Apache-2.0
// Defects of what has to stay as it was and does not, or the other way round: a value behind a write that was
// refused, and one that was written behind a reset.
#include <cstdint>
#include <functional>
#include <utility>

#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

/// Another value in place of the one that was to stay; the given one is what was wanted.
using Instead = std::uint64_t (*)(std::uint64_t present, std::uint64_t wanted);

void put(Parts& parts, Multiplexer mux, std::uint64_t value) {
  Entry* entry = parts.device.dictionary.entry(mux.index.value(), mux.sub.value());
  if (entry != nullptr) entry->value = conform::to_le(value, entry->value.size());
}

/// `spoil(parts, present, wanted)` follows a write to this entry that is refused.
Change behind_a_refusal(Multiplexer of,
                        std::function<void(Parts&, std::uint64_t present, std::uint64_t wanted)> spoil) {
  return [of, spoil = std::move(spoil)](Parts& parts) {
    parts.device.dictionary.download.replace(
        [&parts, of, spoil](const auto& former, Multiplexer mux, ByteView value) {
          const Accepted done = former(mux, value);
          if (!done && mux == of)
            spoil(parts, parts.device.dictionary.number(of.index.value(), of.sub.value()),
                  conform::load_le(value));
          return done;
        });
  };
}

/// A write that is refused makes something else of the value.
Change changed_by_a_refusal(std::uint16_t index, std::uint8_t sub, Instead instead) {
  return behind_a_refusal(mux(index, sub), [=](Parts& parts, std::uint64_t present, std::uint64_t wanted) {
    put(parts, mux(index, sub), instead(present, wanted));
  });
}

std::uint64_t next_to_default(std::uint64_t /*present*/, std::uint64_t /*wanted*/) { return 0x81; }
std::uint64_t nothing(std::uint64_t /*present*/, std::uint64_t /*wanted*/) { return 0; }
std::uint64_t taken(std::uint64_t /*present*/, std::uint64_t wanted) { return wanted; }
std::uint64_t one_less(std::uint64_t /*present*/, std::uint64_t wanted) { return wanted - 1; }
std::uint64_t switched_off(std::uint64_t present, std::uint64_t /*wanted*/) { return present | 0x8000'0000U; }

/// A number of mapped objects that is refused clears the first of them.
Change clears_the_mapping(std::uint16_t index) {
  return behind_a_refusal(
      mux(index, 0), [index](Parts& parts, std::uint64_t, std::uint64_t) { put(parts, mux(index, 1), 0); });
}

/// Such a reset leaves this entry as it was written.
Change kept_by(Reset kind, Multiplexer mux) {
  return [kind, mux](Parts& parts) {
    parts.nmt.on_reset = [&parts, kind, mux, former = parts.nmt.on_reset](Reset present) {
      ObjectDictionary& od = parts.device.dictionary;
      const std::uint64_t written = od.number(mux.index.value(), mux.sub.value());
      former(present);
      if (present == kind) od.set_number(mux.index.value(), mux.sub.value(), written);
    };
  };
}
Change kept_by_reset_communication(std::uint16_t index, std::uint8_t sub) {
  return kept_by(Reset::communication, mux(index, sub));
}

/// Such a reset leaves a COB-ID as it was written, but for bit 31; or that bit alone.
Change part_kept_by(Reset kind, Multiplexer mux, std::uint32_t bits) {
  return [kind, mux, bits](Parts& parts) {
    parts.nmt.on_reset = [&parts, kind, mux, bits, former = parts.nmt.on_reset](Reset present) {
      ObjectDictionary& od = parts.device.dictionary;
      const std::uint64_t written = od.number(mux.index.value(), mux.sub.value());
      former(present);
      if (present != kind) return;
      const std::uint64_t fresh = od.number(mux.index.value(), mux.sub.value());
      od.set_number(mux.index.value(), mux.sub.value(), (fresh & ~std::uint64_t{bits}) | (written & bits));
    };
  };
}

constexpr std::uint32_t bit31 = 0x8000'0000;
constexpr std::uint32_t but_bit31 = 0x7FFF'FFFF;

}  // namespace

DefectTable dictionary_leftover_defects() {
  return {
      {"refused-1005-becomes-81",
       "A value of 1005h that is refused makes it 81h",
       {"OD-ACC-05", "OD-1005-05"},
       changed_by_a_refusal(0x1005, 0, next_to_default)},
      {"refused-1005-restricted-moves",
       "A restricted CAN-ID that 1005h refuses moves it by one",
       {"OD-ACC-05", "OD-CID-03"},
       changed_by_a_refusal(0x1005, 0,
                            [](std::uint64_t present, std::uint64_t wanted) {
                              return wanted <= 0x7F ? present + 1 : present;
                            })},
      {"refused-1012-consumer-off",
       "A value of 1012h that is refused ends the consumer of TIME",
       {"OD-ACC-05", "OD-1012-05"},
       changed_by_a_refusal(0x1012, 0,
                            [](std::uint64_t present, std::uint64_t) { return present ^ 0x8000'0000U; })},
      {"refused-1014-switched-off",
       "A value of 1014h that is refused switches EMCY off",
       {"OD-ACC-05", "OD-1014-06"},
       changed_by_a_refusal(0x1014, 0, switched_off)},
      {"refused-1016-cleared",
       "A value of 1016h:01 that is refused clears it",
       {"OD-ACC-05"},
       changed_by_a_refusal(0x1016, 1, nothing)},
      {"refused-1019-taken",
       "A value of 1019h that is refused is stored",
       {"OD-ACC-05", "OD-1019-05"},
       changed_by_a_refusal(0x1019, 0, taken)},
      {"refused-1029-becomes-the-nearest",
       "A value of 1029h:01 that is refused becomes one that is allowed",
       {"OD-ACC-05"},
       changed_by_a_refusal(0x1029, 1, [](std::uint64_t, std::uint64_t) { return std::uint64_t{2}; })},
      {"refused-1028-taken",
       "A value of 1028h:01 that is refused is stored",
       {"OD-ACC-05"},
       changed_by_a_refusal(0x1028, 1, taken)},
      {"refused-1401-switched-off",
       "A COB-ID that the second RPDO refuses switches it off",
       {"OD-ACC-05", "OD-1400-10"},
       changed_by_a_refusal(0x1401, 1, switched_off)},
      {"refused-1800-switched-off",
       "A COB-ID that the first TPDO refuses switches it off",
       {"OD-ACC-05", "OD-1800-10"},
       changed_by_a_refusal(0x1800, 1, switched_off)},
      {"refused-1400-type-becomes-fe",
       "A transmission type that the first RPDO refuses becomes FEh",
       {"OD-ACC-05"},
       changed_by_a_refusal(0x1400, 2, [](std::uint64_t, std::uint64_t) { return std::uint64_t{0xFE}; })},
      {"refused-1801-type-less",
       "A transmission type that the second TPDO refuses becomes the one below",
       {"OD-ACC-05", "OD-1800-16"},
       changed_by_a_refusal(0x1801, 2, one_less)},
      {"refused-1800-sync-start-less",
       "A SYNC start value that is refused becomes the one below",
       {"OD-ACC-05", "OD-1800-21"},
       changed_by_a_refusal(0x1800, 6, one_less)},
      {"refused-1600-count-0",
       "A number of mapped objects that is refused becomes 0",
       {"OD-ACC-05"},
       changed_by_a_refusal(0x1600, 0, nothing)},
      {"refused-1a01-count-taken",
       "A number of mapped objects that the second TPDO refuses is stored",
       {"OD-ACC-05", "OD-1A00-10"},
       changed_by_a_refusal(0x1A01, 0, taken)},
      {"refused-1601-entry-taken",
       "A mapping entry that the second RPDO refuses is stored",
       {"OD-ACC-05"},
       changed_by_a_refusal(0x1601, 1, taken)},
      {"refused-1600-count-clears-entry",
       "A number of mapped objects that is refused clears the first mapping entry",
       {"OD-ACC-05"},
       clears_the_mapping(0x1600)},
      {"refused-1a00-count-clears-entry",
       "A number of mapped objects that a TPDO refuses clears the first mapping entry",
       {"OD-ACC-05"},
       clears_the_mapping(0x1A00)},
      {"reset-communication-keeps-last-monitored-node",
       "Reset communication leaves 1016h:04 as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1016, 4)},
      {"reset-communication-keeps-life-time-factor",
       "Reset communication leaves 100Dh as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x100D, 0)},
      {"reset-communication-keeps-1005",
       "Reset communication leaves 1005h as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1005, 0)},
      {"reset-communication-keeps-1280-request",
       "Reset communication leaves 1280h:01 as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1280, 1)},
      {"reset-communication-keeps-1280-response",
       "Reset communication leaves 1280h:02 as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1280, 2)},
      {"reset-communication-keeps-1401-cob-id",
       "Reset communication leaves 1401h:01 as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1401, 1)},
      {"reset-communication-keeps-1403-can-id",
       "Reset communication makes RPDO 4 valid, with the CAN-ID that was written",
       {"NMT-FSA-24"},
       part_kept_by(Reset::communication, mux(0x1403, 1), but_bit31)},
      {"reset-communication-keeps-1402-switched-off",
       "Reset communication leaves bit 31 of 1402h:01 as it was written",
       {"NMT-FSA-24"},
       part_kept_by(Reset::communication, mux(0x1402, 1), bit31)},
      {"reset-communication-keeps-1803-cob-id",
       "Reset communication leaves 1803h:01 as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1803, 1)},
      {"reset-communication-keeps-1007",
       "Reset communication leaves 1007h as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1007, 0)},
      {"reset-communication-keeps-1012",
       "Reset communication leaves 1012h as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1012, 0)},
      {"reset-communication-keeps-1019",
       "Reset communication leaves 1019h as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1019, 0)},
      {"reset-communication-keeps-1028-later",
       "Reset communication leaves 1028h:03 as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1028, 3)},
      {"reset-communication-keeps-1402-type",
       "Reset communication leaves 1402h:02 as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1402, 2)},
      {"reset-communication-keeps-1403-deadline",
       "Reset communication leaves 1403h:05 as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1403, 5)},
      {"reset-communication-keeps-1603-count",
       "Reset communication leaves 1603h:00 as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1603, 0)},
      {"reset-communication-keeps-1800-inhibit-time",
       "Reset communication leaves 1800h:03 as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1800, 3)},
      {"reset-communication-keeps-1801-type",
       "Reset communication leaves 1801h:02 as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1801, 2)},
      {"reset-communication-keeps-1803-event-timer",
       "Reset communication leaves 1803h:05 as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1803, 5)},
      {"reset-communication-keeps-1803-sync-start",
       "Reset communication leaves 1803h:06 as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1803, 6)},
      {"reset-communication-keeps-1a03-count",
       "Reset communication leaves 1A03h:00 as it was written",
       {"NMT-FSA-24"},
       kept_by_reset_communication(0x1A03, 0)},
      {"reset-node-keeps-1005",
       "Reset node leaves 1005h as it was written",
       {"NMT-FSA-25"},
       kept_by(Reset::node, mux(0x1005, 0))},
      {"reset-node-keeps-1012",
       "Reset node leaves the CAN-ID of 1012h as it was written",
       {"NMT-FSA-25"},
       part_kept_by(Reset::node, mux(0x1012, 0), but_bit31)},
      {"reset-node-keeps-1014",
       "Reset node leaves 1014h as it was written",
       {"NMT-FSA-25"},
       kept_by(Reset::node, mux(0x1014, 0))},
      {"reset-node-keeps-1401-cob-id",
       "Reset node leaves 1401h:01 as it was written",
       {"NMT-FSA-25"},
       kept_by(Reset::node, mux(0x1401, 1))},
      {"reset-node-keeps-1803-switched-off",
       "Reset node leaves bit 31 of 1803h:01 as it was written",
       {"NMT-FSA-25"},
       part_kept_by(Reset::node, mux(0x1803, 1), bit31)},
      {"reset-node-keeps-1006",
       "Reset node leaves 1006h as it was written",
       {"NMT-FSA-25"},
       kept_by(Reset::node, mux(0x1006, 0))},
      {"reset-node-keeps-1803-sync-start",
       "Reset node leaves 1803h:06 as it was written",
       {"NMT-FSA-25"},
       kept_by(Reset::node, mux(0x1803, 6))},
      {"reset-node-keeps-last-polarity",
       "Reset node leaves 6206h:08 as it was written",
       {"NMT-FSA-25"},
       kept_by(Reset::node, mux(0x6206, 8))},
      {"reset-node-keeps-last-error-value",
       "Reset node leaves 6207h:08 as it was written",
       {"NMT-FSA-25"},
       kept_by(Reset::node, mux(0x6207, 8))},
      {"reset-node-keeps-last-output",
       "Reset node leaves 6200h:08 as it was written",
       {"NMT-FSA-25"},
       kept_by(Reset::node, mux(0x6200, 8))},
  };
}

}  // namespace refnode
