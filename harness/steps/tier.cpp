// SPDX-License-Identifier: Apache-2.0
#include "steps/tier.hpp"

#include <algorithm>
#include <array>

#include "canopen/cob_id.hpp"
#include "canopen/lss.hpp"
#include "canopen/program_control.hpp"

namespace conform::steps {
namespace {

constexpr std::array<std::string_view, 4> words = {"read-only", "config", "nvm", "motion"};

constexpr TierRow table[] = {
    {Tier::read_only,
     "SDO upload requests (initiate, segment, block) and aborts, whole frames of eight bytes on the device's own 600h + N"},
    {Tier::config,
     "SDO downloads to 0000h-1FFFh but 1010h:01-FF, 1011h:01-FF and 1F50h-1F5Fh, on 600h + N; old values are put back"},
    {Tier::config,
     "SDO downloads to the entries that the profile names under safe_objects, errors and store_fault"},
    {Tier::config, "SDO requests that break the protocol, on 600h + N"},
    {Tier::config, "switching the power of the device by power_cycle of the profile"},
    {Tier::config, "NMT stop, enter Pre-operational and both resets, in two bytes, the second of them N"},
    {Tier::config,
     "remote frames on the CAN-IDs of the device's own pre-defined services: 80h, 180h, 280h, 380h, 480h, 580h, 600h and 700h + N (guarding)"},
    {Tier::config,
     "LSS on 7E5h: all slaves to waiting, select one, identify, inquire, configure node-ID and bit timing"},
    {Tier::nvm, "SDO downloads to 1010h:01-FF and 1011h:01-FF: store and restore parameters"},
    {Tier::nvm, "LSS on 7E5h: store configuration"},
    {Tier::motion,
     "LSS on 7E5h: all slaves to configuration, fastscan, activate bit timing, unknown commands, frames that are not of eight bytes"},
    {Tier::motion, "NMT start: outputs may move"},
    {Tier::motion,
     "NMT commands to all nodes, to other nodes, unknown, or not of two bytes: a neighbour may obey them"},
    {Tier::motion, "SYNC, TIME, RPDOs of the device"},
    {Tier::motion, "heartbeats of 7Dh and 7Eh, also for the default error trigger"},
    {Tier::motion,
     "SDO frames on other channels: of other nodes, and additional ones of the device, on whose CAN-IDs somebody else may listen"},
    {Tier::motion,
     "downloads to 1F50h-1F5Fh (program control), and every other frame: 29-bit ones, any other CAN-ID"},
    {Tier::motion,
     "without safe_objects: downloads to the entries of 2000h-9FFFh that the device description (EDS) has"},
};

bool is_own_service(std::uint32_t id, const canopen::ConnectionSet& own) {
  const auto is = [id](CanId each) { return each.value() == id; };
  return is(own.emcy) || is(own.sdo_request) || is(own.sdo_response) || is(own.error_control) ||
         std::ranges::any_of(own.tpdo, is);
}

Need need_of_nmt(const can::Frame& frame, NodeId node) {
  constexpr std::array<std::uint8_t, 4> harmless = {0x02, 0x80, 0x81, 0x82};
  if (frame.dlc != 2) return {Tier::motion, "send NMT frames that are not of two bytes"};
  if (frame.data[1] != node.value()) return {Tier::motion, "send NMT commands to other nodes"};
  if (frame.data[0] == 0x01) return {Tier::motion, "start the device"};
  if (std::ranges::find(harmless, frame.data[0]) == harmless.end())
    return {Tier::motion, "send unknown NMT commands"};
  return {Tier::config, "send NMT commands"};
}

/// With the others waiting, who has been selected obeys, and nobody else.
Need need_of_lss(const can::Frame& frame) {
  using canopen::LssCommand;
  constexpr Need odd{Tier::motion, "send LSS frames that are no commands"};
  if (frame.dlc != 8 || canopen::lss_command_name(frame.data[0]).empty()) return odd;
  switch (static_cast<LssCommand>(frame.data[0])) {
    case LssCommand::switch_global:
      if (frame.data[1] == 0) return {Tier::config, "use LSS"};
      return {Tier::motion, "switch all LSS slaves"};
    case LssCommand::fastscan: return {Tier::motion, "use LSS fastscan, in which others may take part"};
    case LssCommand::store: return {Tier::nvm, "store by LSS"};
    case LssCommand::activate_bit_timing: return {Tier::motion, "switch the bit rate"};
    case LssCommand::selected:
    case LssCommand::identified:
    case LssCommand::non_configured: return odd;
    default: return {Tier::config, "use LSS"};
  }
}

/// Client command specifier, bits 7-5: 0 download segment, 1 initiate download, 2 initiate upload, 3 upload
/// segment, 4 abort, 5 block upload, 6 block download (bit 0 = 0: initiate).
Need need_of_sdo(const can::Frame& frame, NodeId node) {
  const auto specifier = frame.data[0] >> 5U;
  if (frame.dlc == 8 && specifier >= 2 && specifier <= 5) return {Tier::read_only, "upload"};
  if (const auto object = download_begun(frame, node)) return need_of_download(*object);
  return {Tier::config, "send anything but uploads"};
}

}  // namespace

std::string_view word_of(Tier tier) { return words[static_cast<std::size_t>(tier)]; }

std::optional<Tier> parse_tier(std::string_view word) {
  const auto found = std::ranges::find(words, word);
  if (found == words.end()) return std::nullopt;
  return static_cast<Tier>(found - words.begin());
}

std::span<const TierRow> tier_table() { return table; }

std::string_view never_sent() {
  return "downloads to any other entry from 2000h on and to what the profile calls untouchable";
}

std::optional<Multiplexer> download_begun(const can::Frame& frame, NodeId node) {
  // A server may complete a frame that is too short from what it had before; its index is what counts then.
  if (!frame.is_data(canopen::connection_set(node).sdo_request) || frame.size() < 3) return std::nullopt;
  const auto specifier = frame.data[0] >> 5U;
  if (specifier != 1 && (specifier != 6 || (frame.data[0] & 1U) != 0)) return std::nullopt;
  return Multiplexer{Index(static_cast<std::uint16_t>(frame.data[1] | (frame.data[2] << 8U))),
                     SubIndex(frame.size() > 3 ? frame.data[3] : std::uint8_t{0})};
}

Need need_of_download(Multiplexer object) {
  const auto value = object.index.value();
  // Sub-index 00h is only a count.
  if ((value == 0x1010 || value == 0x1011) && object.sub != SubIndex(0))
    return {Tier::nvm, "store or restore parameters"};
  if (canopen::is_program_control(object.index)) return {Tier::motion, "write to program control"};
  return {Tier::config, "write to the device"};
}

Need need_of(const can::Frame& frame, NodeId node) {
  const auto own = canopen::connection_set(node);
  if (frame.extended || frame.error) return {Tier::motion, "send frames with 29-bit identifiers"};
  if (frame.remote) {
    if (is_own_service(frame.id, own)) return {Tier::config, "send remote frames"};
    return {Tier::motion, "send remote frames for what other nodes send"};
  }
  if (frame.id == canopen::nmt_can_id.value()) return need_of_nmt(frame, node);
  if (frame.id == own.sdo_request.value()) return need_of_sdo(frame, node);
  if (frame.id == canopen::lss_request_can_id.value()) return need_of_lss(frame);
  if (frame.id == canopen::sync_can_id.value()) return {Tier::motion, "send SYNC"};
  if (frame.id > 0x600 && frame.id <= 0x67F) return {Tier::motion, "send on the SDO channels of other nodes"};
  if (frame.id > 0x700 && frame.id <= 0x77F) return {Tier::motion, "play other nodes"};
  return {Tier::motion, "send on CAN-IDs that are not the device's SDO channel"};
}

}  // namespace conform::steps
