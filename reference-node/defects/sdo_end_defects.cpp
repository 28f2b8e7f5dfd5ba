// SPDX-License-Identifier: Apache-2.0
// Defects of the end of a transfer: what a refusal, an abort of the client or Stopped leaves alive, timers
// among it. And of channels beside the default one: where they answer, and what ends their transfers.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "defects/sdo_block_exchanges.hpp"
#include "defects/sdo_rules.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr AbortCode time_out{0x05040000};

/// A transfer stays open when the server refuses a request for which `when` holds.
Change survives_refusal_of(std::function<bool(Parts&, const Frame&)> when) {
  return [when = std::move(when)](Parts& parts) {
    const auto spared = std::make_shared<bool>(false);
    misreads([spared, when](Parts& node, Frame& frame) { *spared = when(node, frame); })(parts);
    of_sdo(parts).abort_ends_transfer.replace([spared](const auto& former, SdoSide by, bool block) {
      return !(by == SdoSide::server && *spared) && former(by, block);
    });
  };
}
/// Requests with this command specifier, while a transfer of this kind is open.
template <typename Kind>
std::function<bool(Parts&, const Frame&)> comes_within(unsigned specifier) {
  return [specifier](Parts& node, const Frame& frame) {
    return transfer_of<Kind>(node, frame) != nullptr && frame.data[0] >> 5U == specifier;
  };
}
/// Such requests within a transfer are refused as unknown by an abort that names it, and it goes on.
template <typename Kind>
Change refused_by_its_name(std::initializer_list<unsigned> specifiers) {
  return [all = std::vector<unsigned>(specifiers)](Parts& parts) {
    const auto named = std::make_shared<std::optional<Multiplexer>>();
    survives_refusal_of([named, all](Parts& node, const Frame& frame) {
      const Kind* transfer = transfer_of<Kind>(node, frame);
      const bool refused = transfer != nullptr && std::ranges::find(all, frame.data[0] >> 5U) != all.end();
      *named = refused ? std::optional(transfer->mux()) : std::nullopt;
      return refused;
    })(parts);
    misreads([named](Parts&, Frame& frame) {
      if (*named) frame.data[0] |= 0xE0U;
    })(parts);
    parts.device.outbox.add_filter([named](const FilterContext& context, Frames& frames) {
      if (context.sdo == nullptr || !unknown_command(*context.sdo) || !*named) return;
      const Data abort = with_mux(0x80, **named);
      for (Outgoing& outgoing : frames) std::copy_n(abort.begin(), 4, outgoing.frame.data.begin());
    });
  };
}

bool end_of_block_download(Parts& node, const Frame& frame) {
  const auto* transfer = transfer_of<BlockDownload>(node, frame);
  return transfer != nullptr && !transfer->in_sub_block() && (frame.data[0] & 0xE1U) == 0xC1;
}
bool segment_on_additional_channel(Parts& node, const Frame& frame) {
  const SdoServer* server = server_asked(node, frame);
  return server != nullptr && server->channel() != 0 && server->running<SegmentedDownload>() != nullptr &&
         frame.data[0] >> 5U == 0;
}

/// What the default server sends later, unless a request comes before.
using Forgotten = std::shared_ptr<std::uint32_t>;  ///< counts the requests
Forgotten count_requests(Parts& parts) {
  const auto count = std::make_shared<std::uint32_t>(0);
  misreads([count](Parts& node, Frame& frame) {
    if (channel_of(node, frame) == 0) ++*count;
  })(parts);
  return count;
}
void send_later(Frames& frames, Outgoing outgoing, Duration delay, const Forgotten& requests) {
  outgoing.delay = delay;
  outgoing.still_wanted = [requests, now = *requests] { return *requests == now; };
  frames.push_back(std::move(outgoing));
}
Data time_out_abort(Multiplexer mux) {
  const auto index = mux.index.value();
  Data data{0x80, static_cast<std::uint8_t>(index & 0xFFU), static_cast<std::uint8_t>(index >> 8U),
            mux.sub.value()};
  store_code(data, time_out);
  return data;
}

/// The abort of the client ends a transfer of this kind, and not the time after which it is given up.
template <typename Kind>
void abort_leaves_the_time_out(Parts& parts) {
  const auto open = std::make_shared<bool>(false);
  const Forgotten requests = count_requests(parts);
  misreads([open](Parts& node, Frame& frame) {
    *open = transfer_of<Kind>(node, frame) != nullptr && channel_of(node, frame) == 0;
  })(parts);
  parts.device.outbox.add_filter([&parts, open, requests](const FilterContext& context, Frames& frames) {
    if (context.sdo == nullptr || !is_client_abort(*context.sdo) || !std::exchange(*open, false)) return;
    send_later(frames, response(context, time_out_abort(context.sdo->mux)),
               parts.sdo.choices.time_out.value_or(std::chrono::seconds(1)), requests);
  });
}
/// Nor the time after which its sub-block is acknowledged.
void abort_leaves_the_sub_block(Parts& parts) {
  const auto taken = std::make_shared<std::uint8_t>(0);
  const Forgotten requests = count_requests(parts);
  misreads([taken](Parts& node, Frame& frame) {
    const auto* transfer = transfer_of<BlockDownload>(node, frame);
    *taken = transfer != nullptr && transfer->in_sub_block() ? transfer->sequence() : 0;
  })(parts);
  parts.device.outbox.add_filter([&parts, taken, requests](const FilterContext& context, Frames& frames) {
    if (context.sdo == nullptr || context.sdo->channel != 0 || !is_client_abort(*context.sdo)) return;
    if (*taken == 0) return;
    send_later(frames, response(context, {0xA2, std::exchange(*taken, std::uint8_t{0}), 0x7F}),
               parts.sdo.choices.sub_block_time_out, requests);
  });
}

/// The transfer of the default server that Stopped is about to end is given up after this time.
void give_up_later(Parts& node, Duration delay, std::function<bool()> still_wanted) {
  const SdoServer* server =
      node.sdo.server_of(conform::can::data_frame(conform::CanId(0x600U + node.device.node_id), {}));
  if (server == nullptr || !server->running_mux()) return;
  const FilterContext stopped{Service::sdo, node.device.node_id, node.device.state};
  Outgoing abort = response(stopped, time_out_abort(*server->running_mux()));
  abort.delay = delay;
  abort.still_wanted = std::move(still_wanted);
  node.device.outbox.send(stopped, {std::move(abort)}, node.device.now);
}

/// Stopped ends a transfer of the default server, and not the time after which it is given up.
void stopped_leaves_the_time_out(Parts& parts) {
  ahead_of_state_change([](Parts& node) {
    if (node.device.state != NmtState::stopped) return;
    give_up_later(node, node.sdo.choices.time_out.value_or(std::chrono::seconds(1)),
                  [&node] { return node.device.works_now(Service::sdo); });
  })(parts);
}

/// The time goes on in Stopped, and the abort is sent there; with another state it is forgotten.
void times_out_in_stopped(Parts& parts) {
  const auto changes = std::make_shared<std::uint32_t>(0);
  ahead_of_state_change([changes](Parts& node) {
    ++*changes;
    if (node.device.state != NmtState::stopped) return;
    give_up_later(node, std::chrono::seconds(3), [changes, now = *changes] { return *changes == now; });
  })(parts);
}

bool of_additional_channel(const FilterContext& context) {
  return context.sdo != nullptr && context.sdo->channel != 0;
}

/// The CAN-ID of the first response is that of all of them.
Filter latches_response_id() {
  return
      [ids = std::map<std::uint8_t, std::uint32_t>{}](const FilterContext& context, Frames& frames) mutable {
        if (context.service == Service::boot_up) ids.clear();
        if (!of_additional_channel(context)) return;
        for (Outgoing& outgoing : frames)
          outgoing.frame.id = ids.try_emplace(context.sdo->channel, outgoing.frame.id).first->second;
      };
}

/// What comes without a request, an abort or an acknowledge, goes out on the CAN-ID of the default server.
Filter unasked_on_default_channel(SdoStep step) {
  return [step](const FilterContext& context, Frames& frames) {
    if (!of_additional_channel(context) || context.sdo->step != step || context.sdo->request[0] != 0) return;
    for (Outgoing& outgoing : frames) outgoing.frame.id = 0x580U + context.node_id;
  };
}

/// The command to store ends the transfers of all channels.
void saving_ends_all_transfers(Parts& parts) {
  after_writing_all(0x1010, [](Parts& node, const std::function<void()>& former, std::uint8_t) {
    former();
    const auto abort_on = [&node](std::uint64_t id) {
      node.device.inbox.put(conform::can::data_frame(conform::CanId(static_cast<std::uint32_t>(id & 0x7FFU)),
                                                     {0x80, 0, 0, 0, 0, 0, 0, 0}),
                            node.device.now);
    };
    abort_on(0x600U + node.device.node_id);
    for (std::uint16_t index = first_sdo_server + 1; index <= first_sdo_server + 2; ++index) {
      const std::uint64_t request = node.device.dictionary.number(index, 1, 0x80000000U);
      if ((request & 0x80000000U) == 0) abort_on(request);
    }
  })(parts);
}

bool block_download_begun_on_second_channel(const SdoExchange& e) {
  return e.channel == 2 && block_download_initiated(e);
}

DefectTable alive_rows() {
  constexpr unsigned download_segment = 0;
  constexpr unsigned upload_segment = 3;
  constexpr unsigned block_upload = 5;
  constexpr unsigned block_download = 6;
  constexpr unsigned unknown = 7;
  return {
      {"segmented-download-outlives-upload-segment",
       "An upload segment request within a segmented download is refused, and the download goes on",
       {"SDO-SDN-20"},
       survives_refusal_of(comes_within<SegmentedDownload>(upload_segment))},
      {"segmented-upload-outlives-download-segment",
       "A download segment within a segmented upload is refused, and the upload goes on",
       {"SDO-SUP-13"},
       survives_refusal_of(comes_within<SegmentedUpload>(download_segment))},
      {"segmented-upload-outlives-unknown-command",
       "An unknown command within a segmented upload is refused by an abort of the upload, which goes on",
       {"SDO-ERR-01"},
       refused_by_its_name<SegmentedUpload>({unknown})},
      {"segmented-download-outlives-unknown-command",
       "An unknown command within a segmented download is refused by an abort of the download, which goes on",
       {"SDO-ERR-01"},
       refused_by_its_name<SegmentedDownload>({unknown})},
      {"block-upload-outlives-unknown-command",
       "An unknown command within a block upload is refused by an abort of the upload, which goes on",
       {"SDO-ERR-01"},
       refused_by_its_name<BlockUpload>({unknown})},
      {"segmented-upload-outlives-block-request",
       "A block request within a segmented upload is refused by an abort of the upload, which goes on",
       {"SDO-SUP-11"},
       refused_by_its_name<SegmentedUpload>({block_upload, block_download})},
      {"segmented-download-outlives-block-request",
       "A block request within a segmented download is refused by an abort of the download, which goes on",
       {"SDO-SDN-17"},
       refused_by_its_name<SegmentedDownload>({block_upload, block_download})},
      {"block-download-outlives-wrong-crc",
       "A block download that was refused because of its CRC can be ended once more",
       {"SDO-BDN-03"},
       survives_refusal_of(end_of_block_download)},
      {"additional-sdo-download-outlives-toggle-abort",
       "On additional channels a segmented download goes on behind the abort of a segment",
       {"SDO-SDN-04"},
       survives_refusal_of(segment_on_additional_channel)},
      {"segmented-download-aborted-times-out",
       "A segmented download that the client has aborted is given up after the time-out",
       {"SDO-SDN-19"},
       Change(abort_leaves_the_time_out<SegmentedDownload>)},
      {"segmented-upload-aborted-times-out",
       "A segmented upload that the client has aborted is given up after the time-out",
       {"SDO-SUP-10"},
       Change(abort_leaves_the_time_out<SegmentedUpload>)},
      {"block-upload-aborted-times-out",
       "A block upload that the client has aborted is given up after the time-out",
       {"SDO-BUP-17"},
       Change(abort_leaves_the_time_out<BlockUpload>)},
      {"block-download-aborted-sub-block-acknowledged",
       "A sub-block of a download that the client has aborted is acknowledged when nothing more comes",
       {"SDO-BDN-19"},
       Change(abort_leaves_the_sub_block)},
      {"transfer-stopped-times-out",
       "A transfer that Stopped has ended is given up after the time-out",
       {"SDO-SUP-19"},
       Change(stopped_leaves_the_time_out)},
      {"transfer-times-out-in-stopped",
       "A transfer that was open when the node was stopped is given up by an abort in Stopped, three seconds later",
       {"SDO-GEN-15"},
       Change(times_out_in_stopped)},
  };
}

}  // namespace

DefectTable sdo_end_defects() {
  DefectTable rows = alive_rows();
  DefectTable channels = {
      {"additional-sdo-transfer-outlives-stopped",
       "Transfers of additional channels go on behind Stopped",
       {"SDO-SUP-19"},
       decides(of_sdo, &SdoRules::transfers_end_in,
               [](const auto& former, NmtState state, std::uint8_t channel) {
                 return !(state == NmtState::stopped && channel != 0) && former(state, channel);
               })},
      {"additional-sdo-response-can-id-latched",
       "An additional channel answers on the CAN-ID of its first response until a reset",
       {"SDO-MUL-01"},
       latches_response_id()},
      {"additional-sdo-gives-up-on-default-channel",
       "A transfer of an additional channel is given up on the CAN-ID of the default one",
       {"SDO-MUL-01"},
       unasked_on_default_channel(SdoStep::time_out)},
      {"additional-sdo-acknowledges-pause-on-default-channel",
       "A sub-block of an additional channel that does not go on is acknowledged on the CAN-ID of the default one",
       {"SDO-MUL-01", "SDO-GEN-04"},
       unasked_on_default_channel(SdoStep::block_download_ack)},
      {"save-ends-all-transfers",
       "The command to store ends the transfers of all channels",
       {"SDO-MUL-04"},
       Change(saving_ends_all_transfers)},
      {"second-additional-sdo-block-download-sub-index-00",
       "The last SDO channel answers the request for a block download with sub-index 00h",
       {"SDO-GEN-03"},
       patch(block_download_begun_on_second_channel, [](const SdoExchange&, Data& data) { data[3] = 0; })},
  };
  append(rows, std::move(channels));
  return rows;
}

}  // namespace refnode
