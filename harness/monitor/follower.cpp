// SPDX-License-Identifier: Apache-2.0
#include "monitor/follower.hpp"

#include <algorithm>
#include <utility>

#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/lss.hpp"
#include "monitor/own_ids.hpp"

namespace conform::monitor {
namespace {

using Subject = Observation::Subject;

constexpr std::uint32_t not_valid = canopen::cob_id::bit31;
constexpr auto configure_node_id = static_cast<std::uint8_t>(canopen::LssCommand::configure_node_id);
constexpr std::size_t most_servers = 8;
// How long a guarding request explains a set bit 7, and a foreign request an answer.
constexpr Duration explained_for = std::chrono::seconds{1};

}  // namespace

Follower::Follower(const Facts& facts) : facts_(facts), nmt_(facts) {
  const auto set = canopen::connection_set(facts.node);
  default_.request = set.sdo_request.value();
  default_.response = set.sdo_response.value();
  names_.set(facts.node.value());
}

const Observation& Follower::follow(const can::CapturedFrame& captured, std::size_t index) {
  now_.captured = &captured;
  now_.index = index;
  now_.subject = Subject::other;
  now_.heard_before = heard_;
  now_.guard_answer = false;
  now_.read.reset();
  const auto& frame = captured.frame;
  if (frame.error) return now_;
  const bool from_device = captured.direction == can::Direction::received;
  const auto key = frame.id | (frame.extended ? canopen::cob_id::extended_frame : 0U);
  const auto node = facts_.node.value();
  if (key == default_.request) {
    request(default_);
  } else if (key == default_.response) {
    if (!from_device) {
      lay_bait(SdoAnswer::Cause::own_id);
    } else if (!frame.remote) {
      response(default_, true);
    }
  } else if (!more_.empty() && of_more_channels(key, from_device)) {
    // Taken.
  } else if (frame.id == 0) {
    now_.subject = Subject::nmt;
  } else if (frame.extended) {
    if (frame.id == default_.request || frame.id == default_.request << 18U)
      lay_bait(SdoAnswer::Cause::extended);
  } else if (frame.id >= 0x600 && frame.id <= 0x67F) {
    lay_bait(frame.id == 0x600 ? SdoAnswer::Cause::broadcast : SdoAnswer::Cause::foreign);
  } else if (frame.id == 0x700U + node) {
    if (frame.remote) {
      guard_request_ = captured.time;
      guard_open_ = !nmt_.booting();
    } else if (from_device) {
      now_.subject = Subject::error_control;
      now_.guarded = guard_request_ && captured.time <= *guard_request_ + explained_for;
      now_.guard_answer = std::exchange(guard_open_, false) && now_.guarded;
    }
  } else if (frame.is_data(canopen::lss_request_can_id)) {
    now_.subject = Subject::lss_request;
    if (frame.data[0] == configure_node_id) {
      nmt_.readdressed();
      if (frame.data[1] < names_.size()) names_.set(frame.data[1]);
    }
  } else if (frame.is_data(canopen::lss_response_can_id) && from_device) {
    now_.subject = Subject::lss_answer;
  } else if (frame.id == 0x080U + node && from_device && !frame.remote) {
    now_.subject = Subject::emcy;
  }
  if (now_.subject == Subject::other) {
    now_.subject = frame.remote ? Subject::remote : Subject::data;
    // Perhaps a request on a channel that nobody saw being made.
    if (!from_device && !frame.remote) note_download(frame, captured.time);
  }
  nmt_.look_at(key);
  if (from_device && !now_.from_device()) look_at_sender();
  if (now_.from_device()) nmt_.spoke(captured.time);
  nmt_.bus_was_taken(captured.time);
  return now_;
}

/// Of an additional SDO server, in either direction.
bool Follower::of_more_channels(Key key, bool from_device) {
  for (std::size_t i = 0; i < more_.size(); ++i) {
    auto& server = more_[i];
    if (((server.request | server.response) & not_valid) != 0) continue;
    if (key == server.request) return request(server), true;
    if (key != server.response || !from_device || now_.captured->frame.remote) continue;
    // A CAN-ID with two uses: nobody knows whose frame it is.
    const auto index = static_cast<std::uint16_t>(0x1201 + i);
    if (other_holder(holders(*this, key), index, index)) {
      server.channel.lose_track();
      return false;
    }
    return response(server, false), true;
  }
  return false;
}

/// A node that is not the device shows itself by what only another one sends: also by asking the device.
void Follower::look_at_sender() {
  const auto& frame = now_.frame();
  if (frame.extended) {
    constexpr std::size_t most = 64;
    if (!frame.remote && strangers_.size() < most) strangers_.insert(now_.key());
    return;
  }
  if (frame.remote) {
    // A guard request for another node says nothing, whatever COB-ID held its CAN-ID once.
    const bool guards_another = frame.id > 0x700 && frame.id < 0x780 && !names_.test(frame.id & 0x7FU);
    others_ = others_ || (frame.id > 0x180 && !guards_another && may_be_own(frame.id));
    return;
  }
  const auto id = frame.id;
  if ((id > 0x080 && id < 0x100) || (id > 0x180 && id < 0x580) || (id > 0x580 && id < 0x680) ||
      (id > 0x700 && id < 0x780)) {
    heard_ids_.set(id);
  } else if (id == canopen::sync_can_id.value() || id == canopen::time_can_id.value()) {
    // Who goes on while the device boots is somebody else.
    others_ = others_ ||
              (nmt_.booting() && !nmt_.overdue(now_.time()) && nmt_.is_newer(now_.time(), nmt_.reset_at()));
  }
}

/// A boot-up message with a node-ID that LSS has given: what was to reset the device has done so.
bool Follower::boots_elsewhere() const {
  const auto& frame = now_.frame();
  return now_.received() && !frame.extended && frame.id > 0x700 && frame.id < 0x780 &&
         names_.test(frame.id & 0x7FU) && frame.dlc == 1 && frame.data[0] == 0;
}

bool Follower::may_be_own(Entries::Key can_id) const {
  // Whatever a COB-ID was given: a frame with that of NMT is a command or none at all.
  if (can_id == canopen::nmt_can_id.value()) return false;
  if (entries_.ever_held(can_id)) return true;
  if (can_id > 0x7FF || !names_.test(can_id & 0x7FU)) return false;
  switch (can_id & ~0x7FU) {
    case 0x080:
    case 0x180:
    case 0x280:
    case 0x380:
    case 0x480:
    case 0x580:
    case 0x700: return true;
    default: return false;
  }
}

bool Follower::has_unknown_extended() const {
  return std::ranges::any_of(strangers_, [this](Entries::Key key) { return !may_be_own(key); });
}

bool Follower::others_heard() const {
  if (!facts_.senders_are_known) return true;
  if (facts_.alone) return false;
  if (others_) return true;
  if (heard_ids_.none()) return false;
  for (std::uint32_t id = 0; id < heard_ids_.size(); ++id) {
    if (heard_ids_.test(id) && !may_be_own(id)) return true;
  }
  return false;
}

void Follower::settle() {
  if (now_.from_device() && !now_.boot_up() && nmt_.overdue(now_.time())) nmt_.reset_had_no_effect();
  switch (now_.subject) {
    case Subject::nmt: {
      const auto& frame = now_.frame();
      nmt_.command(frame, now_.time(), now_.index);
      if (frame.size() < 2 || frame.data[1] == 0 || frame.data[1] == facts_.node.value()) {
        default_.channel.transfer_unclear();
        for (auto& server : more_) server.channel.transfer_unclear();
      }
      if (nmt_.booting()) {
        guard_open_ = false;
        forget_channels();
        entries_.reset();
      }
      break;
    }
    case Subject::error_control:
      // A restart at that very moment cannot be told from a wrong answer.
      if (now_.guard_answer && now_.frame().size() > 0 && now_.frame().data[0] == 0) nmt_.lose_track();
      if (now_.boot_up()) {
        nmt_.boot_up(now_.time());
        // A fresh server knows of no transfer, but requests may wait in the receive buffer.
        default_.channel.transfer_unclear();
        forget_channels();
        entries_.reset();
      }
      heard_ = now_.time();
      break;
    case Subject::sdo_response:
    case Subject::emcy: heard_ = now_.time(); break;
    case Subject::data:
      if (boots_elsewhere()) nmt_.moved();
      break;
    default: break;
  }
}

void Follower::lose_track() {
  default_.channel.lose_frames();
  for (auto& server : more_) server.channel.lose_frames();
  nmt_.lose_track();
  entries_.lose_track();
  bait_ = {};
  asked_.reset();
}

void Follower::request(Server& server) {
  now_.subject = Subject::sdo_request;
  server.channel.request(now_.frame(), now_.time());
  if (&server == &default_ && !asked_) asked_ = now_.time();
  note_download(now_.frame(), now_.time());
  // What comes next may answer the abort, as some servers do, and then nothing else.
  if (&server == &default_ && !now_.frame().remote && now_.frame().data[0] == 0x80) bait_ = {};
}

void Follower::response(Server& server, bool default_channel) {
  now_.subject = Subject::sdo_response;
  now_.answer = server.channel.response(now_.frame(), now_.time());
  auto& answer = now_.answer;
  answer.default_channel = default_channel;
  if (default_channel) {
    const auto asked = std::exchange(asked_, std::nullopt);
    if (asked && answer.to == SdoAnswer::To::request) nmt_.answered(*asked, default_.response);
  }
  if (answer.to == SdoAnswer::To::nothing && answer.cause == SdoAnswer::Cause::none && default_channel &&
      bait_.cause != SdoAnswer::Cause::none && now_.time() <= bait_.time + explained_for &&
      std::ranges::equal(bait_.multiplexer, std::span(now_.frame().data).subspan(1, 3))) {
    answer.cause = bait_.cause;
  }
  learn(answer);
  if (const auto write = server.channel.take_written()) {
    entries_.written(write->object, write->value, now_.time());
    written(*write);
  }
  now_.read = server.channel.take_read();
  if (now_.read) entries_.read(now_.read->object, now_.read->value, now_.time());
}

/// Every frame of ours that may ask for a download: until it is answered the value is open.
void Follower::note_download(const can::Frame& frame, BusTime time) {
  const auto specifier = frame.data[0] >> 5U;
  const bool download = specifier == 1 || (specifier == 6 && (frame.data[0] & 0x01U) == 0);
  if (!download || frame.remote || frame.size() < 4) return;
  const bool expedited = specifier == 1 && (frame.data[0] & 0x02U) != 0 && frame.size() == 8;
  const auto value = static_cast<std::uint32_t>(load_le(ByteView(frame.data).subspan(4)));
  entries_.asked(multiplexer_of(frame), expedited ? std::optional(value) : std::nullopt, time);
}

/// What a refusal says of an entry.
void Follower::learn(const SdoAnswer& answer) {
  const auto& frame = now_.frame();
  if (answer.to != SdoAnswer::To::request || !answer.mux || !answer.mux->right || frame.data[0] != 0x80)
    return;
  const AbortCode code(static_cast<std::uint32_t>(load_le(ByteView(frame.data).subspan(4))));
  if (answer.asked == Asked::download) entries_.refused(answer.mux->got, now_.time());
  if (answer.asked == Asked::upload &&
      (code == canopen::abort::no_object || code == canopen::abort::no_sub_index))
    entries_.absent(answer.mux->got);
}

void Follower::lay_bait(SdoAnswer::Cause cause) {
  const auto& frame = now_.frame();
  if (frame.remote) return;
  note_download(frame, now_.time());
  now_.subject = Subject::foreign_request;
  bait_.cause = cause;
  bait_.time = now_.time();
  std::copy_n(frame.data.begin() + 1, 3, bait_.multiplexer.begin());
}

/// CAN-IDs on which other services speak: what a device makes of such an entry, its frames there are no SDO.
bool Follower::is_taken(Key key, bool default_channel) const {
  const auto set = canopen::connection_set(facts_.node);
  if (default_channel && (key == set.sdo_request.value() || key == set.sdo_response.value())) return false;
  return key == set.emcy.value() || canopen::is_restricted(CanId{key});
}

/// 1200h-127Fh:01 and :02 move the channel they are about. 1200h is the default channel.
void Follower::written(const SdoChannel::Value& write) {
  if (write.size != 0 && write.size != 4) return;
  const auto index = write.object.index.value();
  const auto sub = write.object.sub.value();
  if (index < 0x1200 || index > 0x127F || (sub != 1 && sub != 2)) return;
  const std::size_t number = index - 0x1200U;
  if (number > most_servers) return;
  auto* server = &default_;
  if (number > 0) {
    while (more_.size() < number) {
      more_.emplace_back().request = not_valid;
      more_.back().response = not_valid;
    }
    server = &more_[number - 1];
  }
  auto key = write.value & (not_valid | canopen::cob_id::extended_frame | canopen::cob_id::can_id_mask);
  if (is_taken(key, number == 0)) key = not_valid;
  auto& place = sub == 1 ? server->request : server->response;
  if (place == key) return;
  place = key;
  server->channel = {};
  server->channel.lose_track();
}

/// After a reset the COB-IDs are those of power-on; which these are the trace does not tell, except for the
/// default channel.
void Follower::forget_channels() {
  more_.clear();
  const auto set = canopen::connection_set(facts_.node);
  if (default_.request == set.sdo_request.value() && default_.response == set.sdo_response.value()) return;
  default_.request = set.sdo_request.value();
  default_.response = set.sdo_response.value();
  default_.channel = {};
  default_.channel.lose_track();
}

}  // namespace conform::monitor
