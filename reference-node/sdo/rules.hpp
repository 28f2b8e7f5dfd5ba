// SPDX-License-Identifier: Apache-2.0
// What CiA 301 says of the SDO server: when a transfer begins and ends, and what each kind may be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "device/states.hpp"
#include "dictionary/object_dictionary.hpp"
#include "rules/rule.hpp"
#include "sdo/block_rules.hpp"
#include "sdo/parameters.hpp"

namespace refnode {

enum class SdoSide : std::uint8_t { client, server };

/// 7.2.4.3.4 and 7.2.4.3.7.
struct SegmentedRules {
  explicit SegmentedRules(ObjectDictionary& dictionary)
      : granted([&dictionary](Multiplexer mux, std::optional<std::size_t> announced) {
          return dictionary.may_download(mux, announced);
        }),
        store([&dictionary](Multiplexer mux, ByteView data) { return dictionary.download(mux, data); }) {}

  /// The toggle bit alternates: a segment has the one that is due.
  using Toggle = Rule<bool(bool toggle, bool due)>;
  Toggle upload_toggle_right{[](bool toggle, bool due) { return toggle == due; }};
  Toggle download_toggle_right{[](bool toggle, bool due) { return toggle == due; }};

  /// Where the next segment of an upload begins; nothing: the transfer has ended with the last one.
  Rule<std::optional<std::size_t>(std::size_t sent, std::size_t size)> goes_on_at{
      [](std::size_t sent, std::size_t size) { return sent < size ? std::optional(sent) : std::nullopt; }};

  /// Whether a download may begin, and what becomes of its data when all of them have come.
  Rule<Accepted(Multiplexer, std::optional<std::size_t> announced)> granted;
  Rule<Accepted(Multiplexer, ByteView data)> store;
  /// No more bytes come than were announced; when nothing was, than the entry takes.
  Rule<bool(std::size_t received, std::size_t most)> fits{
      [](std::size_t received, std::size_t most) { return received <= most; }};
  /// With the last segment all announced bytes have come.
  Rule<bool(std::size_t received, std::size_t announced)> complete{
      [](std::size_t received, std::size_t announced) { return received >= announced; }};
};

struct SdoRules {
  explicit SdoRules(ObjectDictionary& dictionary) : segmented(dictionary), block_download(dictionary) {}

  /// An SDO exists when both of its COB-IDs are valid (7.5.2.33).
  Rule<bool(const SdoChannel&)> exists{[](const SdoChannel& channel) { return channel.valid(); }};
  /// An initiate request is served at any time: it ends a transfer that is open.
  Rule<bool(bool transfer_open)> may_begin{[](bool) { return true; }};
  /// Also where the new one is over with its answer.
  Rule<bool(bool block_transfer)> makes_way{[](bool) { return true; }};
  /// An abort ends the transfer, whichever side sends it and of whatever kind the transfer is (7.2.4.3.17).
  Rule<bool(SdoSide by, bool block_transfer)> abort_ends_transfer{[](SdoSide, bool) { return true; }};
  /// A transfer ends where SDO does not work (7.3.2.2.5), and with a reset, whatever its channel.
  Rule<bool(NmtState, std::uint8_t channel)> transfers_end_in{[](NmtState state, std::uint8_t) {
    return state == NmtState::stopped || state == NmtState::initialising;
  }};
  SegmentedRules segmented;
  BlockDownloadRules block_download;
  BlockUploadRules block_upload;
};

}  // namespace refnode
