// SPDX-License-Identifier: Apache-2.0
#include "sdo/server.hpp"

#include <algorithm>
#include <type_traits>

#include "sdo/block_rules.hpp"

namespace refnode {

namespace {

// Byte 0 of a request: bits 7-5 client command specifier.
constexpr unsigned download_segment_request = 0;
constexpr unsigned download_initiate_request = 1;
constexpr unsigned upload_initiate_request = 2;
constexpr unsigned upload_segment_request = 3;
constexpr unsigned abort_transfer = 4;
constexpr unsigned block_upload_request = 5;
constexpr unsigned block_download_request = 6;

// Block upload: bits 1-0 client subcommand, bit 2 CRC; block download: bit 0, bit 1 size, bit 2 CRC.
constexpr unsigned block_initiate = 0;
constexpr unsigned block_end = 1;
constexpr unsigned block_acknowledge = 2;
constexpr unsigned crc_bit = 0x04;
constexpr unsigned size_bit = 0x02;

/// Whether a bit is set that the command specifier leaves unused (7.2.4.3.3 to 7.2.4.3.16).
bool has_reserved_bits(std::uint8_t request) {
  const auto subcommand = request & 0x03U;
  switch (request >> 5U) {
    case download_initiate_request: return (request & 0x10U) != 0;
    case upload_initiate_request: return (request & 0x1FU) != 0;
    case upload_segment_request: return (request & 0x0FU) != 0;
    case block_upload_request: return (request & (subcommand == block_initiate ? 0x18U : 0x1CU)) != 0;
    case block_download_request: return (request & ((request & 0x01U) != 0 ? 0x02U : 0x18U)) != 0;
    default: return false;
  }
}

}  // namespace

void SdoServer::on_request(const Frame& frame, std::uint32_t response_id) {
  // SDO frames have eight bytes; anything else is no request.
  if (frame.size() != 8) return;
  response_id_ = response_id;
  active_at_ = device_->now;
  SdoExchange exchange;
  exchange.channel = channel_;
  exchange.request = frame.data;
  exchange.mux = mux_of(exchange.request);
  conclude(exchange, serve(exchange));
}

SdoReply SdoServer::serve(SdoExchange& exchange) {
  const unsigned command = exchange.request[0] >> 5U;
  auto* receiving = std::get_if<BlockDownload>(&transfer_);
  if (receiving != nullptr && receiving->in_sub_block()) {
    // 80h would be sequence number 0: the one frame that cannot be a segment.
    if (exchange.request[0] != 0x80) return block_segment(exchange, *receiving);
  }
  if (choices_->reserved_bits_refused && has_reserved_bits(exchange.request[0]))
    return out_of_place(exchange);
  switch (command) {
    case download_segment_request:
      exchange.step = SdoStep::download_segment;
      if (auto* transfer = std::get_if<SegmentedDownload>(&transfer_)) {
        exchange.mux = transfer->mux();
        return transfer->segment(exchange.request, device_->dictionary);
      }
      return out_of_place(exchange);
    case download_initiate_request: return initiate_download(exchange);
    case upload_initiate_request: return initiate_upload(exchange);
    case upload_segment_request:
      exchange.step = SdoStep::upload_segment;
      if (auto* transfer = std::get_if<SegmentedUpload>(&transfer_)) {
        exchange.mux = transfer->mux();
        return transfer->segment(exchange.request);
      }
      return out_of_place(exchange);
    case abort_transfer:
      if (rules_->abort_ends_transfer(SdoSide::client, block_transfer())) reset();
      return std::nullopt;
    case block_upload_request: return block_upload(exchange);
    case block_download_request: return block_download(exchange);
    default:
      return choices_->former_mux_in_aborts ? out_of_place(exchange) : refuse(abort_code::command_unknown);
  }
}

SdoReply SdoServer::out_of_place(SdoExchange& exchange) const {
  exchange.mux = running_mux().value_or(choices_->former_mux_in_aborts ? former_mux_ : Multiplexer{});
  return refuse(abort_code::command_unknown);
}

std::optional<SdoReply> SdoServer::make_way() {
  if (!rules_->may_begin(busy())) return SdoReply();
  if (busy() && choices_->initiate_while_busy) return refuse(*choices_->initiate_while_busy);
  if (rules_->makes_way(block_transfer())) reset();
  return std::nullopt;
}

SdoReply SdoServer::initiate_upload(SdoExchange& exchange) {
  exchange.step = SdoStep::upload_initiate;
  if (const auto reply = make_way()) return *reply;
  Upload data = device_->dictionary.upload(exchange.mux);
  if (!data) return refuse(data.error());
  return upload_response(exchange, std::move(*data));
}

SdoReply SdoServer::upload_response(SdoExchange& exchange, Bytes data) {
  const std::size_t size = data.size();
  const bool short_enough = size >= 1 && size <= 4;
  if (short_enough && (choices_->expedited_upload || !choices_->segmented)) {
    // 010x nnes: expedited with size, n = bytes without data.
    auto reply = with_mux(static_cast<std::uint8_t>(0x43U | ((4U - size) << 2U)), exchange.mux);
    std::copy(data.begin(), data.end(), reply.begin() + 4);
    return reply;
  }
  if (!choices_->segmented) return refuse(abort_code::unsupported_access);
  auto reply = with_mux(choices_->upload_size_indicated ? 0x41 : 0x40, exchange.mux);
  if (choices_->upload_size_indicated) put_size(reply, size);
  transfer_ = SegmentedUpload(*choices_, rules_->segmented, exchange.mux, std::move(data));
  return reply;
}

SdoReply SdoServer::initiate_download(SdoExchange& exchange) {
  exchange.step = SdoStep::download_initiate;
  if (const auto reply = make_way()) return *reply;
  const std::uint8_t command = exchange.request[0];
  const bool expedited = (command & 0x02U) != 0;
  const bool sized = (command & 0x01U) != 0;
  const auto confirmation = with_mux(0x60, exchange.mux);

  if (expedited) {
    // Without size the server takes what the object needs; more than four bytes cannot come this way.
    std::size_t size = 4U - ((command >> 2U) & 0x03U);
    if (!sized) {
      const std::size_t capacity = device_->dictionary.capacity(exchange.mux);
      size = capacity == 0 ? 4 : std::min<std::size_t>(capacity, 4);
    }
    const ByteView field = ByteView(exchange.request).subspan(4);
    const Accepted written = device_->dictionary.download(exchange.mux, field.first(size));
    if (!written) return refuse(written.error());
    return confirmation;
  }

  if (!choices_->segmented) return refuse(choices_->no_segmented);
  std::optional<std::size_t> announced;
  if (sized) announced = size_field(exchange.request);
  if (!choices_->entry_looked_at_late) {
    const Accepted granted = rules_->segmented.granted(exchange.mux, announced);
    if (!granted) return refuse(granted.error());
  }
  transfer_ = SegmentedDownload(*choices_, rules_->segmented, exchange.mux, announced);
  return confirmation;
}

SdoReply SdoServer::block_upload(SdoExchange& exchange) {
  const unsigned subcommand = exchange.request[0] & 0x03U;
  if (subcommand == block_initiate) return initiate_block_upload(exchange);
  exchange.step = subcommand == block_end ? SdoStep::block_upload_end : SdoStep::block_upload_segment;
  auto* transfer = std::get_if<BlockUpload>(&transfer_);
  if (transfer == nullptr) return out_of_place(exchange);
  exchange.mux = transfer->mux();
  if (subcommand == block_end) return transfer->confirm_end();
  const SdoReply reply =
      subcommand == block_acknowledge ? transfer->acknowledge(exchange.request) : transfer->start();
  // A frame here is the end frame already; segments follow through send_segment().
  if (reply && *reply) exchange.step = SdoStep::block_upload_end;
  pacer_.start(device_->now + choices_->turnaround);
  return reply;
}

SdoReply SdoServer::initiate_block_upload(SdoExchange& exchange) {
  exchange.step = SdoStep::block_upload_initiate;
  if (const auto reply = make_way()) return *reply;
  if (!choices_->block) return refuse(abort_code::command_unknown);
  const std::uint8_t block_size = exchange.request[4];
  const std::uint8_t threshold = exchange.request[5];
  Upload data = device_->dictionary.upload(exchange.mux);
  if (!data) return refuse(data.error());
  if (data->size() < choices_->block_upload_from) return refuse(abort_code::command_unknown);
  if (!valid_block_size(block_size)) return refuse(abort_code::block_size_invalid);
  if (choices_->protocol_switch && rules_->block_upload.may_switch(data->size(), threshold)) {
    exchange.step = SdoStep::upload_initiate;
    return upload_response(exchange, std::move(*data));
  }
  auto reply = with_mux(static_cast<std::uint8_t>(0xC0U | (choices_->crc ? crc_bit : 0U) |
                                                  (choices_->upload_size_indicated ? size_bit : 0U)),
                        exchange.mux);
  if (choices_->upload_size_indicated) put_size(reply, data->size());
  const bool crc = choices_->crc && (exchange.request[0] & crc_bit) != 0;
  transfer_ = BlockUpload(exchange.mux, std::move(*data), block_size, crc);
  return reply;
}

SdoReply SdoServer::block_download(SdoExchange& exchange) {
  if ((exchange.request[0] & 0x01U) == block_initiate) return initiate_block_download(exchange);
  exchange.step = SdoStep::block_download_end;
  auto* transfer = std::get_if<BlockDownload>(&transfer_);
  if (transfer == nullptr) return out_of_place(exchange);
  exchange.mux = transfer->mux();
  return transfer->end(exchange.request);
}

SdoReply SdoServer::initiate_block_download(SdoExchange& exchange) {
  exchange.step = SdoStep::block_download_initiate;
  if (const auto reply = make_way()) return *reply;
  if (!choices_->block) return refuse(abort_code::command_unknown);
  const std::uint8_t command = exchange.request[0];
  std::optional<std::size_t> announced;
  if ((command & size_bit) != 0) announced = size_field(exchange.request);
  if (!choices_->entry_looked_at_late) {
    const Accepted granted = rules_->block_download.may_begin(exchange.mux, announced);
    if (!granted) return refuse(granted.error());
  }
  auto reply = with_mux(static_cast<std::uint8_t>(0xA0U | (choices_->crc ? crc_bit : 0U)), exchange.mux);
  reply[4] = choices_->block_size;
  transfer_ = BlockDownload(*choices_, rules_->block_download,
                            {.mux = exchange.mux,
                             .announced = announced,
                             .capacity = device_->dictionary.capacity(exchange.mux),
                             .block_size = choices_->block_size,
                             .crc = choices_->crc && (command & crc_bit) != 0});
  return reply;
}

SdoReply SdoServer::block_segment(SdoExchange& exchange, BlockDownload& transfer) {
  exchange.mux = transfer.mux();
  exchange.sequence = exchange.request[0] & 0x7FU;
  SdoReply reply = transfer.segment(exchange.request, device_->now);
  exchange.step = reply && *reply ? SdoStep::block_download_ack : SdoStep::block_download_segment;
  return reply;
}

std::optional<Multiplexer> SdoServer::running_mux() const {
  return std::visit(
      [](const auto& transfer) -> std::optional<Multiplexer> {
        if constexpr (std::is_same_v<std::decay_t<decltype(transfer)>, std::monostate>) {
          return std::nullopt;
        } else {
          return transfer.mux();
        }
      },
      transfer_);
}

bool SdoServer::transfer_finished() const {
  return std::visit(
      [](const auto& transfer) {
        if constexpr (std::is_same_v<std::decay_t<decltype(transfer)>, std::monostate>) {
          return false;
        } else {
          return transfer.finished();
        }
      },
      transfer_);
}

void SdoServer::conclude(SdoExchange& exchange, const SdoReply& reply) {
  if (exchange.step != SdoStep::other) former_mux_ = exchange.mux;
  std::optional<SdoData> data;
  if (reply) {
    data = *reply;
    if (transfer_finished()) reset();
  } else {
    exchange.aborted = reply.error();
    if (rules_->abort_ends_transfer(SdoSide::server, block_transfer())) reset();
    data = with_mux(0x80, exchange.mux);
    conform::store_le(std::span(*data).subspan(4), reply.error().value());
  }
  send(exchange, data, choices_->turnaround);
}

void SdoServer::send(const SdoExchange& exchange, const std::optional<SdoData>& data, Duration delay) {
  std::vector<Outgoing> frames;
  if (data) frames.push_back({conform::can::data_frame(conform::CanId(response_id_), *data), delay});
  device_->outbox.send(FilterContext{Service::sdo, device_->node_id, device_->state, &exchange},
                       std::move(frames), device_->now);
}

bool SdoServer::send_segment_now() {
  auto* transfer = std::get_if<BlockUpload>(&transfer_);
  if (transfer == nullptr || !transfer->has_segment()) return false;
  if (!pacer_.may_send(device_->now, device_->outbox.waiting(device_->now), choices_->sub_block_queued))
    return false;
  SdoExchange exchange;
  exchange.channel = channel_;
  exchange.step = SdoStep::block_upload_segment;
  exchange.mux = transfer->mux();
  const SdoData frame = transfer->next_segment();
  exchange.sequence = transfer->sequence();
  pacer_.on_segment();
  active_at_ = device_->now;
  send(exchange, frame, {});
  return true;
}

void SdoServer::on_time() {
  SdoExchange exchange;
  exchange.channel = channel_;
  auto* receiving = std::get_if<BlockDownload>(&transfer_);
  if (receiving != nullptr) {
    const auto due = receiving->acknowledge_at();
    if (due && due.value() <= device_->now) {
      exchange.step = SdoStep::block_download_ack;
      exchange.mux = receiving->mux();
      exchange.sequence = receiving->sequence();
      send(exchange, receiving->acknowledge(), {});
    }
  }
  const auto limit = choices_->time_out;
  if (!busy() || !limit || device_->now < active_at_ + *limit) return;
  exchange.step = SdoStep::time_out;
  exchange.mux = running_mux().value_or(Multiplexer{});
  conclude(exchange, refuse(abort_code::time_out));
  reset();
}

std::optional<BusTime> SdoServer::wakeup_of_transfer() const {
  std::optional<BusTime> next;
  if (const auto limit = choices_->time_out) next = active_at_ + *limit;
  if (const auto* transfer = std::get_if<BlockDownload>(&transfer_)) {
    keep_earlier(next, transfer->acknowledge_at());
  }
  const auto* sending = std::get_if<BlockUpload>(&transfer_);
  if (sending != nullptr && sending->has_segment()) {
    // A full queue is announced by on_transmitted(), or forgotten after a while.
    const bool ahead = pacer_.next() > device_->now;
    next = earliest({next, ahead ? pacer_.next() : device_->outbox.waiting_ends(device_->now)});
  }
  return next;
}

}  // namespace refnode
