// SPDX-License-Identifier: Apache-2.0
// Reads the trace once for all monitors: which frame is whose, and what state client, server and device were
// in.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "can/capture.hpp"
#include "canopen/cob_id.hpp"
#include "monitor/entries.hpp"
#include "monitor/facts.hpp"
#include "monitor/nmt_state.hpp"
#include "monitor/sdo_answer.hpp"
#include "monitor/sdo_channel.hpp"

namespace conform::monitor {

/// One frame with what the follower knows about it. Valid until the next frame.
struct Observation {
  enum class Subject : std::uint8_t {
    other,
    nmt,              ///< identifier 0
    sdo_request,      ///< to the device under test
    sdo_response,     ///< of the device under test
    foreign_request,  ///< SDO request that is not for the device: other node-ID, node-ID 0, 29-bit identifier
    error_control,    ///< data frame on 700h + node-ID from the device
    emcy,             ///< data frame on 080h + node-ID from the device
    lss_request,      ///< data frame on 7E5h
    lss_answer,       ///< data frame on 7E4h that the host did not send
    data,             ///< any other data frame, whoever sent it
    remote,           ///< any other remote frame
  };
  static constexpr std::size_t subjects = static_cast<std::size_t>(Subject::remote) + 1;
  const can::CapturedFrame* captured = nullptr;
  std::size_t index = 0;
  Subject subject = Subject::other;
  SdoAnswer answer;  ///< of an sdo_response
  /// What an sdo_response has told of an entry.
  std::optional<SdoChannel::Value> read;
  /// The frame may answer a guarding request, so that bit 7 is a toggle bit.
  bool guarded = false;
  /// It is the answer to a guarding request, whatever it says: its state may be wrong, but it is no boot-up
  /// message.
  bool guard_answer = false;
  /// The device sent something before this frame; when that was.
  std::optional<BusTime> heard_before;

  /// State 0 on 700h + node-ID, well formed or not.
  [[nodiscard]] bool boot_up() const {
    if (subject != Subject::error_control || frame().size() == 0 || guard_answer) return false;
    // Also between guarding requests, where bit 7 may be set and no answer is state 0.
    return (frame().data[0] & (guarded ? 0xFFU : 0x7FU)) == 0;
  }
  [[nodiscard]] bool from_device() const {
    return subject == Subject::sdo_response || subject == Subject::error_control || subject == Subject::emcy;
  }
  [[nodiscard]] const can::Frame& frame() const { return captured->frame; }
  /// Nobody knows who sent it, but the host did not.
  [[nodiscard]] bool received() const { return captured->direction == can::Direction::received; }
  [[nodiscard]] Entries::Key key() const {
    return frame().id | (frame().extended ? canopen::cob_id::extended_frame : 0U);
  }
  [[nodiscard]] BusTime time() const { return captured->time; }
};

class Follower {
 public:
  explicit Follower(const Facts& facts);

  /// Where the frame belongs, judged by the state before it; the NMT state is still the one before.
  const Observation& follow(const can::CapturedFrame& captured, std::size_t index);
  /// Takes the frame into the NMT state; after the monitors have looked at it.
  void settle();
  /// Frames were lost before the next one.
  void lose_track();

  [[nodiscard]] const NmtState& nmt() const { return nmt_; }
  [[nodiscard]] NmtState& nmt() { return nmt_; }
  [[nodiscard]] const Entries& entries() const { return entries_; }
  [[nodiscard]] const Facts& facts() const { return facts_; }
  /// So far. Where the trace does not tell the senders, everybody may be there.
  [[nodiscard]] bool others_heard() const;
  /// Data frames of 29 bits came on a CAN-ID that no COB-ID known so far holds.
  [[nodiscard]] bool has_unknown_extended() const;
  /// The device may send with this CAN-ID: by the pre-defined connection set, for whatever node-ID it was
  /// given, or by a COB-ID that it ever held.
  [[nodiscard]] bool may_be_own(Entries::Key can_id) const;

 private:
  /// CAN-ID with the format in bit 29, as COB-ID entries hold it.
  using Key = std::uint32_t;
  struct Server {
    Key request = 0, response = 0;  ///< 8000 0000h and above: not valid
    SdoChannel channel;
  };
  struct Bait {
    SdoAnswer::Cause cause = SdoAnswer::Cause::none;
    BusTime time;
    std::array<std::uint8_t, 3> multiplexer{};
  };
  void request(Server& server);
  void response(Server& server, bool default_channel);
  void lay_bait(SdoAnswer::Cause cause);
  [[nodiscard]] bool of_more_channels(Key key, bool from_device);
  [[nodiscard]] bool boots_elsewhere() const;
  [[nodiscard]] bool is_taken(Key key, bool default_channel) const;
  void written(const SdoChannel::Value& write);
  void note_download(const can::Frame& frame, BusTime time);
  void learn(const SdoAnswer& answer);
  void look_at_sender();
  void forget_channels();

  Facts facts_;
  Observation now_;
  NmtState nmt_;
  Entries entries_;
  std::set<Entries::Key> strangers_;  ///< CAN-IDs of 29 bits on which data frames were received
  std::bitset<0x800> heard_ids_;      ///< received on CAN-IDs with which some node sends
  std::bitset<0x80> names_;           ///< node-IDs of the device: its own, and those that LSS gave it
  bool others_ = false;               ///< a frame that cannot be the device's
  Server default_;
  std::vector<Server> more_;  ///< configured by downloads seen on the wire, by number from 1201h on
  std::optional<BusTime> guard_request_, heard_;
  bool guard_open_ = false;  ///< the last guarding request has had no answer, and no reset came since
  Bait bait_;
  std::optional<BusTime> asked_;  ///< the first request on the default channel since the last answer
};

}  // namespace conform::monitor
