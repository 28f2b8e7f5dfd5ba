// SPDX-License-Identifier: Apache-2.0
// Defects of the LSS slave (CiA 305).
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "defects/hooks.hpp"
#include "defects/lss_frames.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;
using namespace defect::lss;

namespace {

/// Requests with this specifier reach nobody.
Change deaf_to_command(std::uint8_t specifier) {
  return deaf_to([specifier](Parts&, const Frame& frame) { return is_request(frame, specifier); });
}
/// A request is taken for another one where `change` makes it so.
Change misreads_requests(void (*change)(Frame&)) {
  return misreads([change](Parts&, Frame& frame) {
    if (is_request(frame)) change(frame);
  });
}
/// Changes the answers.
Filter reshapes_answers(void (*change)(const FilterContext&, Frame&)) {
  return reshape(Service::lss, change);
}

Frame answer(std::initializer_list<std::uint8_t> bytes) {
  return conform::can::data_frame(conform::CanId(answer_id), bytes);
}

/// Answers a request of its own accord.
Change answers_to(bool (*when)(const Frame&), std::uint8_t specifier) {
  return misreads([when, specifier](Parts& parts, Frame& frame) {
    if (is_request(frame) && when(frame))
      parts.device.send(Service::lss, answer({specifier, 0, 0, 0, 0, 0, 0, 0}));
  });
}

Change own_is(bool (*is_own)(std::uint32_t named, std::uint32_t own)) {
  return decides(
      of_address, &LssAddressRules::is_own,
      [is_own](const auto&, std::uint32_t named, std::uint32_t own) { return is_own(named, own); });
}

Change in_range(bool (*holds)(std::uint32_t low, std::uint32_t own, std::uint32_t high)) {
  return decides(of_address, &LssAddressRules::in_range,
                 [holds](const auto&, std::uint32_t low, std::uint32_t own, std::uint32_t high) {
                   return holds(low, own, high);
                 });
}

Change node_id_allowed(bool (*allowed)(bool right, std::uint8_t value)) {
  return decides(of_lss, &LssRules::node_id_allowed,
                 [allowed](const auto& former, std::uint8_t value) { return allowed(former(value), value); });
}

Change bit_rate_allowed(bool (*allowed)(bool right, std::uint8_t table, std::uint8_t index)) {
  return decides(of_lss, &LssRules::bit_rate_allowed,
                 [allowed](const auto& former, std::uint8_t table, std::uint8_t index) {
                   return allowed(former(table, index), table, index);
                 });
}

/// One of the four numbers that the slave tells, and only there.
Filter tells(std::uint8_t specifier, void (*change)(Frame&)) {
  return [specifier, change](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::lss) return;
    for (Outgoing& each : frames) {
      if (each.frame.data[0] == specifier) change(each.frame);
    }
  };
}

void invert_highest_bit(Frame& frame) { frame.data[4] ^= 0x80U; }
void reverse_number(Frame& frame) { std::reverse(&frame.data[1], &frame.data[5]); }

/// Also a slave with a node-ID answers requests with this specifier.
Change counts_as_unconfigured_for(std::uint8_t specifier) {
  return decides(of_lss, &LssRules::configured, [specifier](const auto& former, const Frame& frame) {
    return former(frame) && frame.data[0] != specifier;
  });
}

/// NMT commands other than resets are not heard while an LSS master is busy with the slave.
Change ignores_nmt_in_configuration() {
  return deaf_to([configuration = false](Parts&, const Frame& frame) mutable {
    if (is_request(frame, 0x04) && frame.data[1] <= 1) configuration = frame.data[1] == 1;
    if (is_request(frame, 0x43)) configuration = true;
    if (frame.id != 0x000 || frame.remote || frame.extended || frame.size() != 2) return false;
    if (frame.data[0] == 0x81 || frame.data[0] == 0x82) configuration = false;
    return configuration;
  });
}

/// The node-ID of every 11h is taken, whatever state the slave is in.
void configures_at_any_time(Parts& parts) {
  const auto named = std::make_shared<std::optional<std::uint8_t>>();
  parts.device.inbox.add_filter([named](std::vector<Frame>& frames) {
    for (const Frame& frame : frames) {
      if (is_request(frame, 0x11)) *named = frame.data[1];
    }
  });
  parts.lss.rules.after_reset_communication.replace(
      [named](const auto& former, std::uint8_t active, std::uint8_t pending) {
        const auto taken = std::exchange(*named, std::nullopt);
        return taken && *taken >= 1 && *taken <= 127 ? *taken : former(active, pending);
      });
}

/// Switch state selective is answered, and the slave is waiting again.
void waits_after_selection(Parts& parts) {
  parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::lss || frames.empty() || frames.front().frame.data[0] != 0x44) return;
    parts.device.inbox.put(conform::can::data_frame(conform::CanId(request_id), {0x04, 0, 0, 0, 0, 0, 0, 0}),
                           context.now);
  });
}

}  // namespace

DefectTable lss_defects() {
  return {
      {"lss-global-switch-ignored",
       "Switch state global 1 is ignored",
       {"LSS-SG-01"},
       deaf_to([](Parts&, const Frame& frame) { return is_request(frame, 0x04) && frame.data[1] == 1; })},
      {"lss-global-switch-answered",
       "Switch state global is answered",
       {"LSS-SG-01", "LSS-SG-02"},
       answers_to([](const Frame& frame) { return frame.data[0] == 0x04; }, 0x04)},
      {"lss-global-waiting-answered",
       "Switch state global 0 is answered",
       {"LSS-SG-02"},
       answers_to([](const Frame& frame) { return frame.data[0] == 0x04 && frame.data[1] == 0; }, 0x04)},
      {"lss-does-not-leave-configuration",
       "Switch state global 0 is ignored",
       {"LSS-SG-02", "LSS-INQ-06"},
       deaf_to([](Parts&, const Frame& frame) { return is_request(frame, 0x04) && frame.data[1] == 0; })},
      {"lss-global-mode-unchecked",
       "Every mode but 0 leads into the configuration state",
       {"LSS-SG-03"},
       misreads_requests([](Frame& frame) {
         if (frame.data[0] == 0x04 && frame.data[1] != 0) frame.data[1] = 1;
       })},
      {"lss-global-mode-bit-0",
       "Only bit 0 of the mode counts",
       {"LSS-SG-03"},
       misreads_requests([](Frame& frame) {
         if (frame.data[0] == 0x04) frame.data[1] &= 1U;
       })},
      {"lss-selective-no-reply",
       "Switch state selective is not answered",
       {"LSS-SS-01"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.service == Service::lss && !frames.empty() && frames.front().frame.data[0] == 0x44)
           frames.clear();
       })},
      {"lss-selective-early-reply",
       "The third part of the LSS address is answered already",
       {"LSS-SS-01"},
       answers_to([](const Frame& frame) { return frame.data[0] == 0x42; }, 0x44)},
      {"lss-selective-without-switch",
       "Switch state selective is answered and does not switch",
       {"LSS-SS-01"},
       Change(waits_after_selection)},
      {"lss-selective-ignores-serial",
       "The serial number of switch state selective is not looked at",
       {"LSS-SS-02"},
       misreads([](Parts& parts, Frame& frame) {
         if (is_request(frame, 0x43))
           conform::store_le(std::span(frame.data).subspan(1, 4), parts.lss.rules.address(3));
       })},
      {"lss-selective-ignores-product",
       "The product code of switch state selective is not looked at",
       {"LSS-SS-02"},
       misreads([](Parts& parts, Frame& frame) {
         if (is_request(frame, 0x41))
           conform::store_le(std::span(frame.data).subspan(1, 4), parts.lss.rules.address(1));
       })},
      {"lss-selective-compares-16-bit",
       "Of each part of the LSS address the lower half is compared",
       {"LSS-SS-02", "LSS-ID-02"},
       own_is([](std::uint32_t named, std::uint32_t own) { return ((named ^ own) & 0xFFFFU) == 0; })},
      {"lss-selective-compares-31-bit",
       "Bit 31 of the parts of the LSS address is not compared",
       {"LSS-SS-02", "LSS-ID-02"},
       own_is([](std::uint32_t named, std::uint32_t own) { return ((named ^ own) & 0x7FFFFFFFU) == 0; })},
      {"lss-selective-incomplete-accepted",
       "The serial number alone selects the slave",
       {"LSS-SS-03", "LSS-SS-04", "LSS-GEN-08"},
       decides(of_address, &LssAddressRules::in_order,
               [](const auto&, std::uint8_t, std::uint8_t) { return true; })},
      {"lss-selective-skips-revision",
       "The revision number may be left out",
       {"LSS-SS-03"},
       decides(of_address, &LssAddressRules::in_order,
               [](const auto& former, std::uint8_t step, std::uint8_t expected) {
                 return former(step, expected) || (step == 3 && expected == 2);
               })},
      {"lss-selective-order-unchecked",
       "The parts of the LSS address are taken in any order",
       {"LSS-SS-04"},
       Change([](Parts& parts) { parts.lss.choices.address_in_any_order = true; })},
      {"lss-inquire-vendor-wrong",
       "5Ah tells a vendor-ID with bit 31 inverted",
       {"LSS-INQ-01"},
       tells(0x5A, invert_highest_bit)},
      {"lss-inquire-product-wrong",
       "5Bh tells a product code with bit 31 inverted",
       {"LSS-INQ-02"},
       tells(0x5B, invert_highest_bit)},
      {"lss-inquire-revision-wrong",
       "5Ch tells a revision number with bit 31 inverted",
       {"LSS-INQ-03"},
       tells(0x5C, invert_highest_bit)},
      {"lss-inquire-serial-wrong",
       "5Dh tells a serial number with bit 31 inverted",
       {"LSS-INQ-04"},
       tells(0x5D, invert_highest_bit)},
      {"lss-inquire-big-endian",
       "The parts of the LSS address are told with the most significant byte first",
       {"LSS-INQ-01", "LSS-INQ-02", "LSS-INQ-03", "LSS-INQ-04"},
       reshapes_answers([](const FilterContext&, Frame& frame) {
         if (frame.data[0] >= 0x5A && frame.data[0] <= 0x5D) reverse_number(frame);
       })},
      {"lss-inquire-node-id-wrong",
       "5Eh tells one more than the node-ID",
       {"LSS-INQ-05"},
       tells(0x5E, [](Frame& frame) { ++frame.data[1]; })},
      {"lss-inquire-node-id-missing-is-0",
       "Without node-ID 5Eh tells 0",
       {"LSS-INQ-05"},
       tells(0x5E,
             [](Frame& frame) {
               if (frame.data[1] == 0xFF) frame.data[1] = 0;
             })},
      {"lss-answers-in-waiting",
       "The node-ID is told in the waiting state, too",
       {"LSS-INQ-06", "LSS-SG-02", "LSS-SG-03", "LSS-SS-02", "LSS-ID-01"},
       deaf_to([](Parts& parts, const Frame& frame) {
         if (!is_request(frame, 0x5E)) return false;
         parts.device.send(Service::lss, answer({0x5E, parts.device.node_id, 0, 0, 0, 0, 0, 0}));
         return true;
       })},
      {"lss-configures-in-waiting",
       "A waiting slave takes the node-ID of 11h, without an answer",
       {"LSS-INQ-06"},
       Change(configures_at_any_time)},
      {"lss-configure-node-id-rejected",
       "Node-ID 127 is refused",
       {"LSS-CN-01"},
       node_id_allowed([](bool right, std::uint8_t value) { return right && value != 127; })},
      {"lss-node-id-64-rejected",
       "Node-IDs from 64 on are refused",
       {"LSS-CN-01"},
       node_id_allowed([](bool right, std::uint8_t value) { return right && (value < 64 || value > 127); })},
      {"lss-node-id-0-accepted",
       "Node-ID 0 is accepted",
       {"LSS-CN-02"},
       node_id_allowed([](bool right, std::uint8_t value) { return right || value == 0; })},
      {"lss-node-id-128-accepted",
       "Node-ID 128 is accepted",
       {"LSS-CN-02"},
       node_id_allowed([](bool right, std::uint8_t value) { return right || value == 128; })},
      {"lss-node-id-range-unchecked",
       "Node-IDs from 128 to 254 are accepted",
       {"LSS-CN-02"},
       node_id_allowed([](bool right, std::uint8_t value) { return right || value > 127; })},
      {"lss-node-id-ff-rejected",
       "Node-ID FFh is refused",
       {"LSS-CN-03"},
       node_id_allowed([](bool right, std::uint8_t value) { return right && value != 0xFF; })},
      {"lss-node-id-never-active",
       "A configured node-ID does not become active",
       {"LSS-CN-04", "OD-RST-06"},
       decides(of_lss, &LssRules::after_reset_communication,
               [](const auto& former, std::uint8_t active, std::uint8_t pending) {
                 return pending == LssSlave::no_node_id || active == LssSlave::no_node_id
                            ? former(active, pending)
                            : active;
               })},
      {"lss-cob-ids-not-updated",
       "The default COB-IDs stay with the former node-ID",
       {"LSS-CN-04", "OD-RST-06"},
       everywhere([](Entry& entry) { entry.adds_node_id = false; })},
      {"lss-emcy-cob-id-not-updated",
       "1014h stays with the former node-ID",
       {"LSS-CN-04", "OD-RST-06"},
       Change([](Parts& parts) {
         if (Entry* entry = parts.device.dictionary.entry(0x1014, 0)) entry->adds_node_id = false;
       })},
      {"1200-response-cob-id-keeps-former-node-id",
       "1200h:02 keeps the CAN-ID of the former node-ID",
       {"LSS-CN-04", "OD-RST-06"},
       Change([](Parts& parts) {
         if (Entry* entry = parts.device.dictionary.entry(0x1200, 2)) entry->adds_node_id = false;
       })},
      {"lss-bit-rate-125-refused",
       "The bit rate of 125 kbit/s is refused",
       {"LSS-BT-01"},
       bit_rate_allowed([](bool right, std::uint8_t, std::uint8_t index) { return right && index != 4; })},
      {"lss-slow-bit-rates-refused",
       "Of the table of bit rates the entries behind the reserved one are refused",
       {"LSS-BT-01"},
       bit_rate_allowed([](bool right, std::uint8_t, std::uint8_t index) { return right && index < 5; })},
      {"lss-silent",
       "The device does not know LSS although its description says so",
       {"LSS-SG-01", "LSS-SS-01", "EDS-VSD-10"},
       deaf_to([](Parts&, const Frame& frame) { return frame.id == request_id; })},
      {"lss-bit-rate-index-5-accepted",
       "The reserved entry 5 of the table of bit rates is accepted",
       {"LSS-BT-02"},
       bit_rate_allowed([](bool right, std::uint8_t table, std::uint8_t index) {
         return right || (table == 0 && index == 5);
       })},
      {"lss-bit-rate-unchecked",
       "Every entry of a table of bit rates is accepted",
       {"LSS-BT-02"},
       bit_rate_allowed([](bool, std::uint8_t table, std::uint8_t) { return table == 0; })},
      {"lss-bit-rate-table-unchecked",
       "Every table of bit rates is accepted",
       {"LSS-BT-02"},
       bit_rate_allowed([](bool, std::uint8_t, std::uint8_t index) { return index <= 8 && index != 5; })},
      {"lss-store-no-reply", "Store configuration is not answered", {"LSS-ST-01"}, deaf_to_command(0x17)},
      {"lss-store-ack-without-saving",
       "Store configuration is confirmed and does nothing",
       {"LSS-ST-02"},
       Change([](Parts& parts) {
         parts.lss.keep = [](std::uint8_t, std::optional<std::uint8_t>) { return true; };
       })},
      {"lss-identify-early-reply",
       "The frame before the last of an identify remote slave is answered",
       {"LSS-ID-01", "LSS-ID-02"},
       answers_to([](const Frame& frame) { return frame.data[0] == 0x4A; }, 0x4F)},
      {"lss-identify-answered-twice",
       "An identify remote slave is answered twice",
       {"LSS-ID-01", "LSS-ID-02", "LSS-GEN-08"},
       answers_to([](const Frame& frame) { return frame.data[0] == 0x4B; }, 0x4F)},
      {"lss-identify-range-excludes-ends",
       "The bounds themselves are outside the ranges",
       {"LSS-ID-02", "LSS-ID-01"},
       in_range(
           [](std::uint32_t low, std::uint32_t own, std::uint32_t high) { return low < own && own < high; })},
      {"lss-identify-range-off-by-one",
       "The highest revision and serial number may be one less",
       {"LSS-ID-02"},
       in_range([](std::uint32_t low, std::uint32_t own, std::uint32_t high) {
         return low <= own && own <= std::uint64_t{high} + 1;
       })},
      {"lss-identify-no-lower-bound",
       "The lowest revision and serial numbers are not looked at",
       {"LSS-ID-02"},
       in_range([](std::uint32_t, std::uint32_t own, std::uint32_t high) { return own <= high; })},
      {"lss-identify-signed",
       "The bounds are taken for signed numbers",
       {"LSS-ID-02"},
       in_range([](std::uint32_t low, std::uint32_t own, std::uint32_t high) {
         const auto number = static_cast<std::int32_t>(own);
         return static_cast<std::int32_t>(low) <= number && number <= static_cast<std::int32_t>(high);
       })},
      {"lss-identify-ignores-vendor",
       "The vendor-ID of an identify remote slave is not looked at",
       {"LSS-ID-02"},
       misreads([](Parts& parts, Frame& frame) {
         if (is_request(frame, 0x46))
           conform::store_le(std::span(frame.data).subspan(1, 4), parts.lss.rules.address(0));
       })},
      {"lss-configured-slave-answers-4c",
       "A slave with a node-ID answers 4Ch",
       {"LSS-ID-03"},
       counts_as_unconfigured_for(0x4C)},
      {"lss-unconfigured-boots",
       "Without node-ID the boot-up message comes on 700h plus the former one",
       {"LSS-ID-04"},
       decides(of_lss, &LssRules::after_reset_communication,
               [](const auto& former, std::uint8_t active, std::uint8_t pending) {
                 return pending == LssSlave::no_node_id ? active : former(active, pending);
               })},
      {"lss-unconfigured-silent",
       "A slave without node-ID does not answer 4Ch",
       {"LSS-ID-04"},
       deaf_to_command(0x4C)},
      {"lss-fastscan-enters-when-configured",
       "A slave with a node-ID takes part in fastscan up to the configuration state",
       {"LSS-FS-01"},
       counts_as_unconfigured_for(0x51)},
      {"lss-fastscan-start-ignored", "A fastscan is not taken part in", {"LSS-FS-02"}, deaf_to_command(0x51)},
      {"lss-fastscan-mask-wrong",
       "Fastscan compares one bit less than it is told",
       {"LSS-FS-03"},
       decides(of_address, &LssAddressRules::upper_bits_equal,
               [](const auto&, std::uint32_t named, std::uint32_t own, std::uint8_t lowest) {
                 return (std::uint64_t{named ^ own} >> (lowest + 1U)) == 0;
               })},
      {"lss-fastscan-compares-all-bits",
       "Fastscan compares all bits at once",
       {"LSS-FS-03"},
       decides(
           of_address, &LssAddressRules::upper_bits_equal,
           [](const auto&, std::uint32_t named, std::uint32_t own, std::uint8_t) { return named == own; })},
      {"lss-fastscan-enters-too-early",
       "The third part of a fastscan leads into the configuration state",
       {"LSS-FS-03"},
       misreads_requests([](Frame& frame) {
         if (frame.data[0] == 0x51 && frame.data[5] == 0 && frame.data[6] == 2) frame.data[7] = 0;
       })},
      {"lss-fastscan-stays-waiting",
       "A fastscan that found the slave leaves it waiting",
       {"LSS-FS-03"},
       misreads_requests([](Frame& frame) {
         if (frame.data[0] == 0x51 && frame.data[6] == 3) frame.data[7] = 3;
       })},
      {"lss-fastscan-sub-unchecked",
       "Any part is answered in a fastscan at any time",
       {"LSS-FS-04"},
       decides(of_address, &LssAddressRules::is_next_part,
               [](const auto&, std::uint8_t, std::uint8_t) { return true; })},
      {"lss-fastscan-bit-masked",
       "Of the bit in a fastscan only the lower five bits count",
       {"LSS-FS-04"},
       misreads_requests([](Frame& frame) {
         if (frame.data[0] == 0x51 && frame.data[5] != 0x80) frame.data[5] &= 0x1FU;
       })},
      {"lss-dlc-wrong",
       "The answer to 5Eh has two bytes",
       {"LSS-GEN-01"},
       reshapes_answers([](const FilterContext&, Frame& frame) {
         if (frame.data[0] == 0x5E) frame.dlc = 2;
       })},
      {"lss-reserved-not-zero",
       "The last byte of answers is not 00h",
       {"LSS-GEN-01"},
       reshapes_answers([](const FilterContext&, Frame& frame) { frame.data[7] = 0x5A; })},
      {"lss-unknown-specifier-answered",
       "Unknown command specifiers are answered",
       {"LSS-GEN-02"},
       answers_to([](const Frame& frame) { return frame.data[0] == 0x12 || frame.data[0] == 0x52; }, 0x12)},
      {"lss-specifier-bit-7-masked",
       "Bit 7 of command specifiers is not looked at",
       {"LSS-GEN-02"},
       misreads_requests([](Frame& frame) {
         if (frame.data[0] == 0xDE) frame.data[0] = 0x5E;
       })},
      {"lss-short-frame-accepted",
       "Frames of two bytes are commands",
       {"LSS-GEN-03"},
       decides(of_lss, &LssRules::is_request,
               [](const auto&, const Frame& frame) { return frame.size() >= 2; })},
      {"lss-remote-frame-accepted",
       "A remote frame leads into the configuration state",
       {"LSS-GEN-03"},
       misreads([](Parts&, Frame& frame) {
         if (frame.id == request_id && frame.remote)
           frame = conform::can::data_frame(conform::CanId(request_id), {0x04, 0x01, 0, 0, 0, 0, 0, 0});
       })},
      {"lss-extended-frame-accepted",
       "Extended frames are commands",
       {"LSS-GEN-03"},
       misreads([](Parts&, Frame& frame) {
         if (frame.id == request_id) frame.extended = false;
       })},
      {"lss-blocks-nmt",
       "In the configuration state NMT commands are ignored",
       {"LSS-GEN-04"},
       ignores_nmt_in_configuration()},
      {"lss-only-in-stopped", "LSS works in Stopped only", {"LSS-GEN-04"}, Change([](Parts& parts) {
         parts.device.works.replace([](const auto& former, Service service, NmtState state) {
           return former(service, state) && (service != Service::lss || state == NmtState::stopped);
         });
       })},
      {"lss-configuration-survives-reset",
       "A reset leaves the slave in the configuration state",
       {"LSS-GEN-05"},
       Change([](Parts& parts) { parts.lss.choices.state_survives_reset = true; })},
      {"lss-slow",
       "Answers take 200 ms",
       {"LSS-GEN-07"},
       Filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
         if (context.service != Service::lss) return;
         for (Outgoing& each : frames) each.delay += std::chrono::milliseconds(200);
       })},
  };
}

}  // namespace refnode
