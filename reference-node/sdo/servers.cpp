// SPDX-License-Identifier: Apache-2.0
#include "sdo/servers.hpp"

namespace refnode {

SdoServers::SdoServers(Device& device)
    : block_rules(device.dictionary),
      device_(&device),
      default_(device, choices, block_rules, 0),
      servers_{&default_} {}

void SdoServers::add_objects() {
  for (const std::uint8_t number : {std::uint8_t{1}, std::uint8_t{2}}) add_sdo_server(*device_, number);
}

void SdoServers::bind() {
  for (const auto& [index, object] : device_->dictionary.objects()) {
    if (index <= first_sdo_server || index > last_sdo_server) continue;
    const auto channel = static_cast<std::uint8_t>(index - first_sdo_server);
    additional_.push_back(
        {bind_sdo_server(*device_, cob_id_rules, index), SdoServer(*device_, choices, block_rules, channel)});
    servers_.push_back(&additional_.back().server);
  }
  bind_sdo_clients(*device_, client_cob_id_rules);
}

bool SdoServers::served_now() const {
  switch (device_->state) {
    case NmtState::initialising: return device_->behaviour.sdo_served_before_boot_up;
    case NmtState::stopped: return device_->behaviour.sdo_served_in_stopped;
    case NmtState::pre_operational:
    case NmtState::operational: return true;
  }
  return false;
}

bool SdoServers::is_default_request(std::uint32_t id) const {
  const Behaviour& behaviour = device_->behaviour;
  if (behaviour.answers_foreign_node_ids && id >= 0x601 && id <= 0x67F) return true;
  if (behaviour.answers_broadcast && id == 0x600) return true;
  if (behaviour.answers_on_response_id && id == 0x580U + device_->node_id) return true;
  return id == 0x600U + device_->node_id;
}

const SdoServer* SdoServers::server_of(const Frame& frame) const {
  if (is_default_request(frame.id)) return &default_;
  for (const Additional& additional : additional_) {
    const SdoChannel& channel = additional.channel;
    if (channel.valid() && frame.id == channel.receive.can_id()) return &additional.server;
  }
  return nullptr;
}

bool SdoServers::on_frame(const Frame& frame) {
  if (is_default_request(frame.id)) {
    serve(frame, default_, 0x580U + device_->node_id);
    return true;
  }
  for (Additional& additional : additional_) {
    const SdoChannel& channel = additional.channel;
    const bool one_is_enough = device_->behaviour.sdo_channels.second_cob_id_not_needed;
    const bool valid = channel.valid() || (one_is_enough && channel.receive.valid());
    if (!valid || frame.id != channel.receive.can_id()) continue;
    const bool shared = device_->behaviour.sdo_channels.transfer_shared;
    serve(frame, shared ? default_ : additional.server, channel.transmit.can_id());
    return true;
  }
  return false;
}

void SdoServers::serve(const Frame& frame, SdoServer& server, std::uint32_t response_id) {
  const SdoFaults& faults = device_->behaviour.sdo;
  if (!served_now()) {
    if (faults.serves_after_stopped && device_->state == NmtState::stopped) held_ = frame;
    return;
  }
  server.on_request(frame, response_id);
  // The request may have ended the life of a channel, its own included.
  for (Additional& additional : additional_) {
    if (!additional.channel.valid()) additional.server.reset();
  }
}

void SdoServers::on_transmitted() {
  for (SdoServer* server : servers_) server->on_transmitted();
}

void SdoServers::on_time() {
  if (held_ && served_now()) {
    const Frame frame = *held_;
    held_.reset();
    on_frame(frame);
  }
  for (SdoServer* server : servers_) server->on_time();
}

void SdoServers::send_segments() {
  for (std::size_t idle = 0; idle < servers_.size(); turn_ = (turn_ + 1) % servers_.size()) {
    idle = servers_[turn_]->send_segment() ? 0 : idle + 1;
  }
}

std::optional<BusTime> SdoServers::next_wakeup() const {
  std::optional<BusTime> first;
  for (const SdoServer* server : servers_) first = earliest({first, server->next_wakeup()});
  return first;
}

void SdoServers::reset() {
  for (SdoServer* server : servers_) server->reset();
}

}  // namespace refnode
