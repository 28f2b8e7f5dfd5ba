// SPDX-License-Identifier: Apache-2.0
#include "sdo_server.hpp"

#include <algorithm>

namespace refnode {

namespace {

// Byte 0 of a request: bits 7-5 client command specifier.
constexpr unsigned download_segment_request = 0;
constexpr unsigned download_initiate_request = 1;
constexpr unsigned upload_initiate_request = 2;
constexpr unsigned upload_segment_request = 3;
constexpr unsigned abort_transfer = 4;

Multiplexer mux_of(const std::array<std::uint8_t, 8>& request) {
  return {conform::Index(static_cast<std::uint16_t>(request[1] | (request[2] << 8))),
          conform::SubIndex(request[3])};
}

std::array<std::uint8_t, 8> with_mux(std::uint8_t command, Multiplexer mux) {
  return {command,
          static_cast<std::uint8_t>(mux.index.value() & 0xFFU),
          static_cast<std::uint8_t>(mux.index.value() >> 8U),
          mux.sub.value(),
          0,
          0,
          0,
          0};
}

}  // namespace

void SdoServer::on_request(const Frame& frame) {
  // SDO frames have eight bytes; anything else is no request.
  if (frame.size() != 8 && !device_->behaviour.short_requests_completed) return;
  std::copy_n(frame.data.begin(), frame.size(), last_request_.begin());
  SdoExchange exchange;
  exchange.request = last_request_;
  exchange.mux = mux_of(exchange.request);

  Reply reply;
  switch (exchange.request[0] >> 5U) {
    case download_segment_request: reply = download_segment(exchange); break;
    case download_initiate_request: reply = initiate_download(exchange); break;
    case upload_initiate_request: reply = initiate_upload(exchange); break;
    case upload_segment_request: reply = upload_segment(exchange); break;
    case abort_transfer:
      if (!device_->behaviour.ignores_client_abort) reset();
      if (device_->behaviour.answers_client_abort) reply = abort(exchange, abort_code::general_error);
      break;
    default: reply = abort(exchange, abort_code::command_unknown); break;
  }

  std::vector<Outgoing> frames;
  if (reply) {
    frames.push_back(
        {conform::can::data_frame(conform::CanId(0x580U + device_->node_id), *reply), turnaround_});
  }
  device_->outbox.send(FilterContext{Service::sdo, device_->node_id, device_->state, &exchange},
                       std::move(frames), device_->now);
}

SdoServer::Reply SdoServer::abort(SdoExchange& exchange, AbortCode code) {
  exchange.aborted = code;
  if (!device_->behaviour.abort_keeps_transfer) transfer_.reset();
  auto reply = with_mux(0x80, exchange.mux);
  conform::store_le(std::span(reply).subspan(4), code.value());
  return reply;
}

SdoServer::Reply SdoServer::initiate_upload(SdoExchange& exchange) {
  exchange.step = SdoStep::upload_initiate;
  const bool busy = transfer_.has_value();
  if (busy && device_->behaviour.initiate_ignored_while_busy) return std::nullopt;
  transfer_.reset();
  Upload data = device_->dictionary.upload(exchange.mux);
  if (!data) return abort(exchange, data.error());

  if (device_->behaviour.long_numbers_truncated && data->size() <= 8)
    data->resize(std::min<std::size_t>(data->size(), 4));
  const std::size_t size = data->size();
  if (size >= 1 && size <= 4) {
    // 010x nnes: expedited with size, n = bytes without data.
    auto reply = with_mux(static_cast<std::uint8_t>(0x43U | ((4U - size) << 2U)), exchange.mux);
    std::copy(data->begin(), data->end(), reply.begin() + 4);
    return reply;
  }
  auto reply = with_mux(0x41, exchange.mux);
  conform::store_le(std::span(reply).subspan(4), size);
  transfer_ = Transfer{true, exchange.mux, std::move(*data), 0, std::nullopt, false};
  return reply;
}

SdoServer::Reply SdoServer::upload_segment(SdoExchange& exchange) {
  exchange.step = SdoStep::upload_segment;
  if (!transfer_ || !transfer_->upload) {
    exchange.mux = {};
    return abort(exchange, abort_code::command_unknown);
  }
  exchange.mux = transfer_->mux;
  const bool toggle = (exchange.request[0] & 0x10U) != 0;
  if (toggle != transfer_->toggle && !device_->behaviour.upload_toggle_unchecked) {
    return abort(exchange, abort_code::toggle_not_alternated);
  }
  const std::size_t left = transfer_->data.size() - transfer_->position;
  const std::size_t count = std::min<std::size_t>(left, 7);
  const bool last = count == left;
  // 000t nnnc: toggle of the request, n = bytes without data, c = last segment.
  std::array<std::uint8_t, 8> reply{};
  reply[0] = static_cast<std::uint8_t>((toggle ? 0x10U : 0U) | ((7U - count) << 1U) | (last ? 1U : 0U));
  std::copy_n(transfer_->data.begin() + static_cast<std::ptrdiff_t>(transfer_->position), count,
              reply.begin() + 1);
  transfer_->position += count;
  transfer_->toggle = !toggle;
  if (last) {
    if (device_->behaviour.transfer_stays_open_after_last) {
      transfer_->position = 0;
    } else {
      transfer_.reset();
    }
  }
  return reply;
}

SdoServer::Reply SdoServer::initiate_download(SdoExchange& exchange) {
  exchange.step = SdoStep::download_initiate;
  if (transfer_ && device_->behaviour.initiate_ignored_while_busy) return std::nullopt;
  transfer_.reset();
  const std::uint8_t command = exchange.request[0];
  const bool expedited = (command & 0x02U) != 0;
  const bool sized = (command & 0x01U) != 0;
  const ByteView field = ByteView(exchange.request).subspan(4);
  const auto confirmation = with_mux(0x60, exchange.mux);

  if (expedited) {
    // Without size the server takes what the object needs; more than four bytes cannot come this way.
    std::size_t size = 4U - ((command >> 2U) & 0x03U);
    if (!sized) {
      const std::size_t capacity = device_->dictionary.capacity(exchange.mux);
      size = capacity == 0 ? 4 : std::min<std::size_t>(capacity, 4);
    }
    const Accepted written = device_->dictionary.download(exchange.mux, field.first(size));
    if (!written) return abort(exchange, written.error());
    return confirmation;
  }

  std::optional<std::size_t> announced;
  if (sized) announced = static_cast<std::size_t>(conform::load_le(field));
  const Accepted granted = device_->dictionary.may_download(exchange.mux, announced);
  if (!granted) {
    const bool overlooked =
        device_->behaviour.segmented_access_unchecked && granted.error() == abort_code::read_only;
    if (!overlooked) return abort(exchange, granted.error());
  }
  transfer_ = Transfer{false, exchange.mux, {}, 0, announced, false};
  return confirmation;
}

SdoServer::Reply SdoServer::download_segment(SdoExchange& exchange) {
  exchange.step = SdoStep::download_segment;
  if (!transfer_ || transfer_->upload) {
    exchange.mux = {};
    return abort(exchange, abort_code::command_unknown);
  }
  exchange.mux = transfer_->mux;
  const std::uint8_t command = exchange.request[0];
  const bool toggle = (command & 0x10U) != 0;
  if (toggle != transfer_->toggle && !device_->behaviour.download_toggle_unchecked) {
    return abort(exchange, abort_code::toggle_not_alternated);
  }
  const std::size_t count = 7U - ((command >> 1U) & 0x07U);
  const bool last = (command & 0x01U) != 0;
  const std::size_t capacity = device_->dictionary.capacity(transfer_->mux);
  const std::size_t limit = transfer_->announced.value_or(capacity);

  transfer_->data.insert(transfer_->data.end(), exchange.request.begin() + 1,
                         exchange.request.begin() + 1 + static_cast<std::ptrdiff_t>(count));
  if (transfer_->data.size() > limit && !device_->behaviour.segment_overflow_unchecked) {
    return abort(exchange, abort_code::length_too_high);
  }
  const std::array<std::uint8_t, 8> confirmation{static_cast<std::uint8_t>(toggle ? 0x30U : 0x20U)};
  if (!last) {
    transfer_->toggle = !toggle;
    return confirmation;
  }
  Bytes data = std::move(transfer_->data);
  if (data.size() < limit && transfer_->announced && !device_->behaviour.segment_shortfall_unchecked) {
    return abort(exchange, abort_code::length_too_low);
  }
  if (device_->behaviour.segment_overflow_unchecked || device_->behaviour.segment_shortfall_unchecked) {
    data.resize(limit);
  }
  const Accepted written = device_->behaviour.segmented_download_not_stored
                               ? Accepted{}
                               : device_->dictionary.download(exchange.mux, data);
  if (!written) {
    const bool overlooked =
        device_->behaviour.segmented_access_unchecked && written.error() == abort_code::read_only;
    if (!overlooked) return abort(exchange, written.error());
    if (Entry* entry = device_->dictionary.entry(exchange.index(), exchange.sub())) entry->value = data;
  }
  transfer_.reset();
  return confirmation;
}

}  // namespace refnode
