// SPDX-License-Identifier: Apache-2.0
// Defects of additional SDO servers (1201h-127Fh) and of the parameters of SDO clients (1280h-12FFh).
#include <algorithm>
#include <functional>
#include <map>
#include <memory>

#include "defects/cob_ids.hpp"
#include "defects/sdo_block_exchanges.hpp"
#include "defects/sdo_rules.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

bool on_additional_channel(const SdoExchange& e) { return e.channel != 0; }

/// Any node-ID from 0 to 255.
DictionaryEdit any_node_id(std::uint16_t index) {
  return [index](ObjectDictionary& od, std::uint8_t) {
    if (Entry* entry = od.entry(index, 3)) {
      entry->low.reset();
      entry->high.reset();
    }
  };
}
DictionaryEdit not_storable(std::uint16_t index) {
  return [index](ObjectDictionary& od, std::uint8_t) {
    for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}}) {
      if (Entry* entry = od.entry(index, sub)) entry->storable = false;
    }
  };
}
/// Whatever bit 30 of the COB-IDs says.
DictionaryEdit dynamic_stored() {
  return [](ObjectDictionary& od, std::uint8_t) {
    for (auto& [index, object] : od.objects()) {
      if (index < first_sdo_server || index > last_sdo_client) continue;
      for (auto& [sub, entry] : object.entries) entry.not_stored_now = nullptr;
    }
  };
}
/// What a request leaves open stands in the buffer of the channel since the one before.
void completes_short_frames(Parts& parts) {
  misreads([buffers = std::make_shared<std::map<std::uint8_t, Frame>>()](Parts& node, Frame& frame) {
    const std::uint8_t channel = channel_of(node, frame).value_or(0);
    if (channel == 0) return;
    Frame& buffer = (*buffers)[channel];
    std::ranges::copy(frame.bytes(), buffer.data.begin());
    frame.data = buffer.data;
    frame.dlc = 8;
  })(parts);
}
/// The default server takes the requests of all channels; it answers where the latest has come from.
Change shares_the_default_server() {
  return [](Parts& parts) {
    const auto answered_on = std::make_shared<std::uint32_t>(response_id(parts, 0));
    Change(misreads([answered_on](Parts& node, Frame& frame) {
      const auto channel = channel_of(node, frame);
      if (!channel) return;
      *answered_on = response_id(node, *channel);
      frame.id = 0x600U + node.device.node_id;
    }))(parts);
    parts.device.outbox.add_filter(
        [answered_on](const FilterContext& context, std::vector<Outgoing>& frames) {
          if (context.service != Service::sdo) return;
          for (Outgoing& outgoing : frames) outgoing.frame.id = *answered_on;
        });
  };
}
/// What is written is the power-on value from then on.
DictionaryEdit kept_at_reset(std::uint16_t index) {
  return [index](ObjectDictionary& od, std::uint8_t) {
    for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}}) {
      Entry* entry = od.entry(index, sub);
      if (entry == nullptr) continue;
      // What was stored once does not bring the former value back either.
      entry->storable = false;
      entry->written = [entry, before = entry->written] {
        entry->default_value = entry->value;
        if (before) before();
      };
    }
  };
}
/// Only bit 31 can be changed, and the rest is refused with another code than the one of the standard.
DictionaryEdit only_valid_bit(std::uint16_t index) {
  return [index](ObjectDictionary& od, std::uint8_t) {
    for (const std::uint8_t sub : {std::uint8_t{1}, std::uint8_t{2}}) {
      Entry* entry = od.entry(index, sub);
      if (entry == nullptr) continue;
      entry->check = [entry](ByteView bytes) -> Accepted {
        const std::uint64_t changed = conform::load_le(bytes) ^ conform::load_le(entry->value);
        if ((changed & 0x7FFF'FFFFU) != 0) return refuse(abort_code::value_too_high);
        return {};
      };
    }
  };
}

/// One of the COB-IDs of one channel.
Change accepts_restricted_at(std::uint16_t index, std::uint8_t sub) {
  return checking(index, sub, [](Parts& parts, const Check& former, ByteView bytes) {
    const Accepted allowed = former(bytes);
    const auto wanted = static_cast<std::uint32_t>(conform::load_le(bytes));
    return allowed || !of_sdo_server(parts).restricted(wanted & 0x7FFU) ? allowed : Accepted{};
  });
}

/// What ends one transfer for want of requests ends the others, too.
void gives_up_all_at_once(Parts& parts) {
  parts.device.outbox.add_filter([&parts](const FilterContext& context, Frames&) {
    if (context.sdo == nullptr || context.sdo->step != SdoStep::time_out) return;
    const ObjectDictionary& od = parts.device.dictionary;
    const auto abort_on = [&](std::uint32_t id) {
      parts.device.inbox.put(conform::can::data_frame(conform::CanId(id), {0x80, 0, 0, 0, 0, 0, 0, 0}),
                             context.now);
    };
    if (on_additional_channel(*context.sdo)) abort_on(0x600U + context.node_id);
    for (std::uint16_t index = first_sdo_server + 1; index <= first_sdo_server + 2; ++index) {
      const std::uint64_t request = od.number(index, 1, 0x80000000U);
      if (index != first_sdo_server + context.sdo->channel && (request & 0x80000000U) == 0)
        abort_on(static_cast<std::uint32_t>(request & 0x7FFU));
    }
  });
}

/// The client of an additional channel is taken to have aborted what it has under way.
void end_transfer_of(Parts& parts, std::uint8_t channel) {
  const auto index = static_cast<std::uint16_t>(first_sdo_server + channel);
  const std::uint64_t request = parts.device.dictionary.number(index, 1, 0x80000000U);
  if ((request & 0x80000000U) != 0) return;
  parts.device.inbox.put(
      conform::can::data_frame(conform::CanId(static_cast<std::uint32_t>(request & 0x7FFU)),
                               {0x80, 0, 0, 0, 0, 0, 0, 0}),
      parts.device.now);
}

/// A request on one additional channel ends the transfer on another one.
Change request_ends_transfer(std::uint8_t on, std::uint8_t ended) {
  return misreads([on, ended](Parts& parts, Frame& frame) {
    if (channel_of(parts, frame) == on && frame.data[0] != 0x80) end_transfer_of(parts, ended);
  });
}

/// In Stopped the additional servers go on, and the default one does not.
Change serves_additional_in_stopped() {
  return together(works_also(Service::sdo, NmtState::stopped), deaf_to([](Parts& parts, const Frame& frame) {
                    return parts.device.state == NmtState::stopped && channel_of(parts, frame) == 0;
                  }));
}

/// A channel serves every CAN-ID that it has had requests on.
void serves_former_can_ids(Parts& parts) {
  const auto used = since_boot_up<std::map<std::uint32_t, std::uint8_t>>(parts);
  misreads([used](Parts& node, Frame& frame) {
    if (!is_base_data_frame(frame)) return;
    const auto channel = channel_of(node, frame);
    if (channel && *channel != 0) used->insert_or_assign(frame.id, *channel);
    const auto former = used->find(frame.id);
    if (channel || former == used->end()) return;
    const auto index = static_cast<std::uint16_t>(first_sdo_server + former->second);
    frame.id = static_cast<std::uint32_t>(node.device.dictionary.number(index, 1) & 0x7FFU);
  })(parts);
}

/// A channel that was stored serves nobody before one of its COB-IDs is written.
void serves_when_written_only(Parts& parts) {
  const auto written = written_since_boot_up(parts, {0x1201, 0x1202});
  deaf_to([written](Parts& node, const Frame& frame) {
    const auto channel = channel_of(node, frame);
    if (!channel || *channel == 0) return false;
    const auto index = static_cast<std::uint16_t>(first_sdo_server + *channel);
    return !written->contains(mux(index, 1)) && !written->contains(mux(index, 2));
  })(parts);
}

}  // namespace

DefectTable sdo_channel_defects() {
  return {
      {"1201-absent", "The parameter of a claimed SDO server is missing", {"OD-1201-01"}, absent(0x1201)},
      {"1201-sub0-out-of-range",
       "The parameter of an SDO server has four entries",
       {"OD-1201-01"},
       preset(0x1201, 0, 4)},
      {"1201-sub0-writable",
       "The number of entries of an SDO server can be written",
       {"OD-1201-02"},
       access(0x1201, 0, Access::rw)},
      {"1201-valid-by-default",
       "An additional SDO server is valid by default",
       {"OD-1201-03"},
       both(preset(0x1201, 1, 0x640), preset(0x1201, 2, 0x5C0))},
      {"1201-dynamic-by-default",
       "The COB-IDs of an SDO server are dynamic by default",
       {"OD-1201-03"},
       both(preset(0x1201, 1, 0xC000'0000), preset(0x1201, 2, 0xC000'0000))},
      {"1201-valid-bit-ignored",
       "An additional SDO server is in use whatever bit 31 of its COB-IDs says",
       {"OD-1201-04"},
       decided(of_sdo_server, &CobIdRules::valid, true)},
      {"1201-valid-bit-polarity-inverted",
       "An additional SDO server is in use while bit 31 of its COB-IDs is 1",
       {"OD-1201-04", "SDO-MUL-01", "OD-1201-05"},
       inverted(of_sdo_server, &CobIdRules::valid)},
      {"1201-restricted-id-accepted",
       "Additional SDO servers accept restricted CAN-IDs",
       {"CAN-RID-06"},
       decided(of_sdo_server, &CobIdRules::restricted, false)},
      {"1201-restricted-response-id-accepted",
       "The response COB-ID of an additional SDO server accepts restricted CAN-IDs",
       {"CAN-RID-06"},
       accepts_restricted_at(0x1201, 2)},
      {"1280-restricted-id-accepted",
       "SDO clients accept restricted CAN-IDs",
       {"CAN-RID-06"},
       decided(of_sdo_client, &CobIdRules::restricted, false)},
      {"1201-valid-with-one-cob-id",
       "An additional SDO server is in use as soon as its first COB-ID is valid",
       {"OD-1201-04"},
       decides(of_sdo, &SdoRules::exists,
               [](const auto&, const SdoChannel& channel) { return channel.receive.valid(); })},
      {"1201-lock-missing",
       "The COB-IDs of a valid SDO server can be changed",
       {"OD-1201-05"},
       decided(of_sdo_server, &CobIdRules::locked, false)},
      {"1201-frame-bit-accepted",
       "Bit 29 of the COB-IDs of an SDO server can be set",
       {"OD-1201-06"},
       decided(of_sdo_server, &CobIdRules::frame_bit_allowed, true)},
      {"1201-node-id-unchecked",
       "The node-ID of an SDO client may be anything",
       {"OD-1201-07"},
       any_node_id(0x1201)},
      {"1201-dynamic-stored",
       "Dynamic COB-IDs of an SDO server are stored",
       {"OD-1201-08"},
       dynamic_stored()},
      {"additional-sdo-silent",
       "Additional SDO servers never answer",
       {"SDO-MUL-01", "OD-1201-04"},
       silent(on_additional_channel)},
      {"additional-sdo-answers-on-default-channel",
       "Additional SDO servers answer on the CAN-ID of the default one",
       {"SDO-MUL-01", "OD-1201-04", "SDO-GEN-04"},
       Filter([](const FilterContext& context, Frames& frames) {
         if (context.sdo == nullptr || !on_additional_channel(*context.sdo)) return;
         for (Outgoing& outgoing : frames) outgoing.frame.id = 0x580U + context.node_id;
       })},
      {"additional-sdo-hears-its-neighbours",
       "Additional SDO servers do not look at the lowest three bits of the CAN-ID of a request",
       {"SDO-MUL-01"},
       misreads([](Parts& parts, Frame& frame) {
         const std::uint64_t own = parts.device.dictionary.number(0x1201, 1);
         if ((own & 0x80000000U) == 0 && (frame.id & 0x7F8U) == (own & 0x7F8U))
           frame.id = static_cast<std::uint32_t>(own & 0x7FFU);
       })},
      {"default-sdo-answers-on-all-channels",
       "Answers of the default SDO server are sent on an additional channel as well",
       {"SDO-MUL-01"},
       Filter([used = std::uint32_t{0}](const FilterContext& context, Frames& frames) mutable {
         if (context.sdo == nullptr || frames.empty()) return;
         if (on_additional_channel(*context.sdo)) {
           used = frames.front().frame.id;
         } else if (used != 0) {
           frames.push_back(Outgoing(frames.front()));
           frames.back().frame.id = used;
         }
       })},
      {"additional-sdo-shares-transfer",
       "All SDO servers share the state of one transfer",
       {"SDO-MUL-04"},
       shares_the_default_server()},
      {"additional-sdo-survives-reset",
       "The COB-IDs of SDO servers keep their values at reset communication",
       {"SDO-MUL-05"},
       kept_at_reset(0x1201)},
      {"1280-sub0-wrong",
       "The parameter of an SDO client has two entries",
       {"OD-1280-01"},
       preset(0x1280, 0, 2)},
      {"1280-sub3-missing",
       "The parameter of an SDO client has no node-ID of the server",
       {"OD-1280-01"},
       absent_sub(0x1280, 3)},
      {"1280-sub0-writable",
       "The number of entries of an SDO client can be written",
       {"OD-1280-01"},
       access(0x1280, 0, Access::rw)},
      {"1280-valid-by-default",
       "An SDO client is valid by default",
       {"OD-1280-02"},
       both(preset(0x1280, 1, 0x640), preset(0x1280, 2, 0x5C0))},
      {"1280-lock-missing",
       "The COB-IDs of a valid SDO client can be changed",
       {"OD-1280-03"},
       decided(of_sdo_client, &CobIdRules::locked, false)},
      {"1280-fixed-bits-wrong-abort",
       "Only bit 31 of an SDO client can be changed, and the rest is refused as a value that is too high",
       {"OD-1280-04"},
       only_valid_bit(0x1280)},
      {"1280-frame-bit-accepted",
       "Bit 29 of the COB-IDs of an SDO client can be set",
       {"OD-1280-05"},
       decided(of_sdo_client, &CobIdRules::frame_bit_allowed, true)},
      {"1280-node-id-unchecked",
       "The node-ID of an SDO server may be anything",
       {"OD-1280-06"},
       any_node_id(0x1280)},
      {"1280-not-stored",
       "The parameters of an SDO client are not stored",
       {"SDO-MUL-07"},
       not_storable(0x1280)},
      {"additional-sdo-aborts-on-default-channel",
       "Additional SDO servers send aborts on the CAN-ID of the default one",
       {"SDO-MUL-01", "SDO-GEN-04"},
       Filter([](const FilterContext& context, Frames& frames) {
         if (context.sdo == nullptr || !on_additional_channel(*context.sdo) || !context.sdo->aborted) return;
         for (Outgoing& outgoing : frames) outgoing.frame.id = 0x580U + context.node_id;
       })},
      {"additional-sdo-serves-former-can-id",
       "An additional SDO server that was moved serves its former CAN-ID, too",
       {"SDO-MUL-01"},
       Change(serves_former_can_ids)},
      {"additional-sdo-stored-serves-nobody",
       "An additional SDO server that was stored serves nobody until it is written",
       {"SDO-MUL-01"},
       Change(serves_when_written_only)},
      {"additional-sdo-time-out-ends-all",
       "A transfer that is given up on one channel ends those on all others",
       {"SDO-MUL-04"},
       Change(gives_up_all_at_once)},
      {"additional-sdo-ended-by-request-on-the-next",
       "A request on the second additional channel ends the transfer on the first one",
       {"SDO-MUL-04"},
       request_ends_transfer(2, 1)},
      {"additional-sdo-ended-by-request-on-the-first",
       "A request on the first additional channel ends the transfer on the second one",
       {"SDO-MUL-04"},
       request_ends_transfer(1, 2)},
      {"additional-sdo-ended-by-parameters-of-the-next",
       "A write to the parameters of the second additional channel ends the transfer on the first one",
       {"SDO-MUL-04"},
       after_writing_all(0x1202,
                         [](Parts& parts, const std::function<void()>& former, std::uint8_t) {
                           former();
                           end_transfer_of(parts, 1);
                         })},
      {"additional-sdo-ended-by-node-id-of-the-first",
       "A write to the node-ID of the first additional channel ends the transfer on the second one",
       {"SDO-MUL-04"},
       after_writing(0x1201, 3,
                     [](Parts& parts, const std::function<void()>& former) {
                       former();
                       end_transfer_of(parts, 2);
                     })},
      {"additional-sdo-served-in-stopped",
       "Additional SDO servers answer in Stopped",
       {"SDO-GEN-15"},
       serves_additional_in_stopped()},
      {"additional-sdo-completes-short-frames",
       "An additional SDO server completes a request that is too short with bytes of the one before",
       {"SDO-ERR-06"},
       Change(completes_short_frames)},
      {"additional-sdo-abort-names-no-object",
       "An additional SDO server refuses a segment of a download without the object that it was for",
       {"SDO-SDN-04"},
       patch(
           [](const SdoExchange& e) {
             return on_additional_channel(e) && e.step == SdoStep::download_segment && e.aborted.has_value();
           },
           [](const SdoExchange&, std::array<std::uint8_t, 8>& data) { data[1] = data[2] = data[3] = 0; })},
  };
}

}  // namespace refnode
