// SPDX-License-Identifier: Apache-2.0
#include "canopen/sdo_request.hpp"

#include "canopen/sdo_block_download.hpp"
#include "canopen/sdo_block_upload.hpp"
#include "canopen/sdo_faulty_client.hpp"

namespace conform::canopen {
namespace {

SdoProtocol protocol_of(const SdoRequest& request) {
  if (request.upload) return request.block ? SdoProtocol::block_upload : SdoProtocol::upload;
  return request.block ? SdoProtocol::block_download : SdoProtocol::download;
}

bool is_expedited(const SdoRequest& request) {
  using Mode = SdoDownload::Mode;
  if (request.upload || request.block) return false;
  if (request.mode == Mode::automatic)
    return !request.announced && !request.data.empty() && request.data.size() <= 4;
  return request.mode == Mode::expedited || request.mode == Mode::expedited_unsized;
}

/// Segments of a download; the server tells those of an upload.
std::optional<std::size_t> segments_of(const SdoRequest& request) {
  if (request.upload) return std::nullopt;
  return is_expedited(request) ? 0 : SdoBlockDownload::segments_of(request.data.size());
}

}  // namespace

Result<std::unique_ptr<SdoClient>> make_sdo_client(const SdoRequest& request) {
  const auto protocol = protocol_of(request);
  for (const auto& fault : request.faults) {
    if (auto fits = check_fault(fault, protocol, segments_of(request)); !fits)
      return std::unexpected(fits.error());
  }
  if (is_expedited(request) && (request.data.empty() || request.data.size() > 4))
    return fail_scenario("an expedited download holds 1 to 4 bytes");
  if (request.announced &&
      (is_expedited(request) || !request.size_told || request.mode == SdoDownload::Mode::segmented_unsized)) {
    return fail_scenario("this transfer announces no size", "transfer: segmented or block does");
  }
  const auto plan = request.faults.empty() ? nullptr : std::make_shared<SdoFaultPlan>(request.faults);
  std::unique_ptr<SdoClient> client;
  switch (protocol) {
    case SdoProtocol::upload:
      client = std::make_unique<SdoUpload>(request.object, request.max_bytes, request.enough);
      break;
    case SdoProtocol::download: {
      auto mode = request.mode;
      if (request.announced) mode = SdoDownload::Mode::segmented;
      client = std::make_unique<SdoDownload>(request.object, request.data, mode, request.announced);
      break;
    }
    case SdoProtocol::block_upload:
      client = std::make_unique<SdoBlockUpload>(request.object,
                                                SdoBlockUpload::Options{.blksize = request.blksize,
                                                                        .pst = request.pst,
                                                                        .crc = request.crc,
                                                                        .max_bytes = request.max_bytes},
                                                plan);
      break;
    case SdoProtocol::block_download:
      client = std::make_unique<SdoBlockDownload>(
          request.object, request.data,
          SdoBlockDownload::Options{
              .crc = request.crc, .size_told = request.size_told, .announced = request.announced});
      break;
  }
  if (plan == nullptr) return client;
  return std::make_unique<SdoFaultyClient>(std::move(client), plan, request.object, protocol);
}

}  // namespace conform::canopen
