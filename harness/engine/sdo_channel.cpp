// SPDX-License-Identifier: Apache-2.0
#include "engine/sdo_channel.hpp"

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/sdo_initiate.hpp"

#include <chrono>
#include <utility>

namespace conform::engine {
namespace {

/// A server that wrongly answers the abort does so within this time, and its answer is then no answer to what
/// follows.
constexpr Duration after_conversation = std::chrono::milliseconds(20);

auto is_response(CanId id) {
  return [id](const can::CapturedFrame& captured) {
    return captured.direction == can::Direction::received && captured.frame.is_data(id);
  };
}

}  // namespace

Result<void> SdoChannel::make_idle() {
  if (state_ == State::idle) return {};
  const auto rest = std::exchange(state_, State::idle) == State::late_answers ? quiet_ : after_conversation;
  // An abort is never answered; after it, answers to what was before must not be taken for answers to what
  // comes.
  const auto abort = canopen::encode_abort({Index(0), SubIndex(0)}, AbortCode(0x0800'0000));
  auto sent = recorder_.send(can::data_frame(canopen::connection_set(node_).sdo_request, abort));
  if (!sent) return std::unexpected(sent.error());
  return recorder_.wait_until(recorder_.now() + rest);
}

template <typename Transfer>
Result<steps::SdoAnswer> SdoChannel::run(Transfer transfer, Multiplexer object,
                                         std::optional<Duration> timeout) {
  if (auto idle = make_idle(); !idle) return std::unexpected(idle.error());
  const auto set = canopen::connection_set(node_);
  const auto limit = timeout.value_or(timeout_);
  const auto response = is_response(set.sdo_response);
  auto request = transfer.first_request();
  bool first = true;
  steps::SdoAnswer out;
  while (true) {
    auto sent = recorder_.send(can::data_frame(set.sdo_request, request));
    if (!sent) return std::unexpected(sent.error());
    if (first) first_request_ = *sent;
    first = false;
    last_request_ = recorder_.capture().frames()[*sent].time;
    auto found = recorder_.find(*sent + 1, response, last_request_ + limit);
    if (!found) return std::unexpected(found.error());
    if (!*found) {
      out.kind = steps::SdoAnswer::Kind::silence;
      out.decisive = *sent;
      out.detail = "no answer within " + to_string(limit);
      // Tell the server that we gave up, and do not mistake its late answer for the next one.
      const auto abort = canopen::encode_abort(object, canopen::abort::timed_out);
      auto told = recorder_.send(can::data_frame(set.sdo_request, abort));
      if (!told) return std::unexpected(told.error());
      dirty(true);
      return out;
    }
    out.decisive = **found;
    auto step = transfer.on_response(recorder_.capture().frames()[**found].frame.bytes());
    if (const auto* next = std::get_if<canopen::SdoBytes>(&step)) {
      request = *next;
      continue;
    }
    auto& result = std::get<canopen::TransferResult>(step);
    using Kind = canopen::TransferResult::Kind;
    out.kind = result.kind == Kind::confirmed ? steps::SdoAnswer::Kind::confirmed
               : result.kind == Kind::aborted ? steps::SdoAnswer::Kind::aborted
                                              : steps::SdoAnswer::Kind::violation;
    out.data = std::move(result.data);
    out.size_indicated = result.size_indicated || !result.expedited;
    out.code = result.code;
    out.detail = std::move(result.detail);
    out.remarks = std::move(result.remarks);
    if (result.reply) {
      auto told =
          recorder_.send(can::data_frame(set.sdo_request, canopen::encode_abort(object, *result.reply)));
      if (!told) return std::unexpected(told.error());
    }
    if (result.kind == Kind::violation) dirty(true);
    return out;
  }
}

Result<steps::SdoAnswer> SdoChannel::upload(Multiplexer object, std::optional<Duration> timeout) {
  return run(canopen::SdoUpload(object), object, timeout);
}

Result<std::optional<std::uint64_t>> SdoChannel::held_bytes(Multiplexer object) {
  using Size = std::optional<std::uint64_t>;
  if (auto idle = make_idle(); !idle) return std::unexpected(idle.error());
  const auto set = canopen::connection_set(node_);
  auto sent = recorder_.send(can::data_frame(set.sdo_request, canopen::encode_upload_request(object)));
  if (!sent) return std::unexpected(sent.error());
  const auto response = is_response(set.sdo_response);
  auto found = recorder_.find(*sent + 1, response, recorder_.capture().frames()[*sent].time + timeout_);
  if (!found) return std::unexpected(found.error());
  dirty(!*found);
  if (!*found) return Size();
  const auto answer = canopen::decode_upload_response(recorder_.capture().frames()[**found].frame.bytes());
  if (!answer) return Size();
  if (answer->expedited) return Size(answer->expedited_size());
  if (answer->size_indicated) return Size(answer->value);
  auto whole = upload(object, std::nullopt);
  if (!whole) return std::unexpected(whole.error());
  return whole->kind == steps::SdoAnswer::Kind::confirmed ? Size(whole->data.size()) : Size();
}

Result<steps::SdoAnswer> SdoChannel::download(Multiplexer object, Bytes data, canopen::SdoDownload::Mode mode,
                                              std::optional<Duration> timeout) {
  return run(canopen::SdoDownload(object, std::move(data), mode), object, timeout);
}

}  // namespace conform::engine
