// SPDX-License-Identifier: Apache-2.0
// Defects of the LSS slave (CiA 305) in single frames: numbers of which it looks at a part, CAN-IDs that are
// none of its own, and bytes of an answer that mean nothing.
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "defects/hooks.hpp"
#include "defects/lss_frames.hpp"
#include "defects/receivers.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;
using namespace defect::lss;

namespace {

constexpr std::uint8_t configure_node_id = 0x11;
constexpr std::uint8_t inquire_vendor = 0x5A;
constexpr std::uint8_t inquire_serial = 0x5D;

/// Where a range is wider than one number, one of its ends is outside.
Change excludes_end(bool highest) {
  return decides(of_address, &LssAddressRules::in_range,
                 [highest](const auto& former, std::uint32_t low, std::uint32_t own, std::uint32_t high) {
                   return former(low, own, high) && (low == high || own != (highest ? high : low));
                 });
}

/// Data frames for which `when` holds are requests.
Change takes_for_requests(bool (*when)(const Frame&)) {
  return misreads([when](Parts&, Frame& frame) {
    if (frame.remote || !when(frame)) return;
    frame.id = request_id;
    frame.extended = false;
  });
}

/// Answers with such a specifier begin in the buffer of the request: what is behind their content stays.
Change answers_in_the_request(std::uint8_t first, std::uint8_t last, std::uint8_t content) {
  return [first, last, content](Parts& parts) {
    const auto request = std::make_shared<Frame>();
    parts.device.inbox.add_filter([request](const std::vector<Frame>& frames) {
      if (frames.size() == 1 && is_request(frames[0])) *request = frames[0];
    });
    parts.device.outbox.add_filter(
        [request, first, last, content](const FilterContext& context, std::vector<Outgoing>& frames) {
          if (context.service != Service::lss) return;
          for (Outgoing& each : frames) {
            const std::uint8_t specifier = each.frame.data[0];
            if (specifier < first || specifier > last || request->data[0] != specifier) continue;
            for (std::size_t at = content; at < each.frame.size(); ++at)
              each.frame.data[at] = request->data[at];
          }
        });
  };
}

/// A request of LSS ends an SDO transfer, as an abort of the client would.
void ends_sdo_transfers(Parts& parts, std::vector<Frame>& frames) {
  if (frames.size() != 1 || !is_request(frames[0]) || !has_open_transfer(parts)) return;
  const auto channel = conform::CanId(0x600U + parts.device.node_id);
  frames.insert(frames.begin(), conform::can::data_frame(channel, {0x80, 0, 0, 0, 0, 0, 0, 0x08}));
}

/// What is stored takes more with it.
Change stores_more(void (*more)(Parts&)) {
  return [more](Parts& parts) {
    parts.lss.keep = [&parts, more, former = parts.lss.keep](std::uint8_t node_id,
                                                             std::optional<std::uint8_t> bit_rate) {
      more(parts);
      return former(node_id, bit_rate);
    };
  };
}

void save_all(Parts& parts) {
  constexpr std::array<std::uint8_t, 4> save{0x73, 0x61, 0x76, 0x65};
  if (Entry* entry = parts.device.dictionary.entry(0x1010, 1)) static_cast<void>(entry->check(save));
}

/// Behind one failure of the memory nothing is stored, until power is switched.
void gives_the_memory_up(Parts& parts) {
  parts.lss.keep = [failed = false, former = parts.lss.keep](std::uint8_t node_id,
                                                             std::optional<std::uint8_t> bit_rate) mutable {
    failed = failed || !former(node_id, bit_rate);
    return !failed;
  };
}

}  // namespace

DefectTable lss_frame_defects() {
  return {
      {"lss-identify-highest-excluded",
       "The highest number of a range is outside, where it is not the lowest one, too",
       {"LSS-ID-02"},
       excludes_end(true)},
      {"lss-identify-lowest-excluded",
       "The lowest number of a range is outside, where it is not the highest one, too",
       {"LSS-ID-02"},
       excludes_end(false)},
      {"lss-bit-rate-lower-half",
       "Of the entry of the table of bit rates the lower four bits count",
       {"LSS-BT-02"},
       decides(of_lss, &LssRules::bit_rate_allowed,
               [](const auto& former, std::uint8_t table, std::uint8_t index) {
                 return former(table, index & 0x0FU);
               })},
      {"lss-bit-rate-table-lower-half",
       "Of the table of bit rates the lower four bits count",
       {"LSS-BT-02"},
       decides(of_lss, &LssRules::bit_rate_allowed,
               [](const auto& former, std::uint8_t table, std::uint8_t index) {
                 return former(table & 0x0FU, index);
               })},
      {"lss-upper-eleven-bits-count",
       "Of the identifier of an extended frame the upper eleven bits count",
       {"LSS-GEN-03"},
       known_by(upper_bits, request_id, request_id)},
      {"lss-lower-eleven-bits-count",
       "Extended frames are commands when the upper bits of their identifier are set, too",
       {"LSS-GEN-03"},
       known_by(lower_bits, request_id, request_id)},
      {"lss-can-id-bit-6-not-looked-at",
       "Frames with CAN-ID 7A5h are commands",
       {"LSS-GEN-03"},
       takes_for_requests([](const Frame& frame) { return !frame.extended && frame.id == 0x7A5; })},
      {"lss-answers-of-others-taken",
       "Answers of other slaves are inquiries in the configuration state",
       {"LSS-GEN-03"},
       takes_for_requests([](const Frame& frame) {
         return !frame.extended && frame.id == answer_id && frame.data[0] >= inquire_vendor;
       })},
      {"lss-remote-frame-repeats-request",
       "A remote frame is answered like the request before it",
       {"LSS-GEN-03"},
       repeats_by_remote_frame(request_id, is_request)},
      {"lss-inquiry-echoes-reserved-bytes",
       "Behind the number that is told an answer has the bytes of the request",
       {"LSS-GEN-01"},
       answers_in_the_request(inquire_vendor, inquire_serial, 5)},
      {"lss-configure-echoes-reserved-bytes",
       "Behind its error code an answer to 11h has the bytes of the request",
       {"LSS-GEN-01"},
       answers_in_the_request(configure_node_id, configure_node_id, 3)},
      {"lss-ends-sdo-transfers",
       "An LSS request ends an SDO transfer",
       {"LSS-GEN-04"},
       Change(ends_sdo_transfers)},
      {"lss-store-fails-for-ever",
       "Behind one failure of the memory nothing is stored, until power is switched",
       {"LSS-ST-01"},
       Change(gives_the_memory_up)},
      {"lss-store-saves-parameters",
       "Store configuration stores the parameters, too",
       {"LSS-ST-02"},
       stores_more(save_all)},
  };
}

}  // namespace refnode
