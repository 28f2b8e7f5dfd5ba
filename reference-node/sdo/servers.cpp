// SPDX-License-Identifier: Apache-2.0
#include "sdo/servers.hpp"

namespace refnode {

SdoServers::SdoServers(Device& device)
    : rules(device.dictionary), device_(&device), default_(device, choices, rules, 0), servers_{&default_} {}

void SdoServers::add_objects() {
  for (const std::uint8_t number : {std::uint8_t{1}, std::uint8_t{2}}) add_sdo_server(*device_, number);
}

void SdoServers::bind() {
  for (const auto& [index, object] : device_->dictionary.objects()) {
    if (index <= first_sdo_server || index > last_sdo_server) continue;
    const auto channel = static_cast<std::uint8_t>(index - first_sdo_server);
    additional_.push_back(
        {bind_sdo_server(*device_, cob_id_rules, index), SdoServer(*device_, choices, rules, channel)});
    servers_.push_back(&additional_.back().server);
  }
  bind_sdo_clients(*device_, client_cob_id_rules);
}

const SdoServer* SdoServers::server_of(const Frame& frame) const {
  // The default server has the CAN-IDs of the pre-defined connection set (7.3.3).
  if (frame.id == 0x600U + device_->node_id) return &default_;
  for (const auto& [channel, server] : additional_) {
    if (rules.exists(channel) && frame.id == channel.receive.can_id()) return &server;
  }
  return nullptr;
}

bool SdoServers::on_frame(const Frame& frame) {
  const SdoServer* asked = server_of(frame);
  if (asked == &default_) serve(frame, default_, 0x580U + device_->node_id);
  for (auto& [channel, server] : additional_) {
    if (asked == &server) serve(frame, server, channel.transmit.can_id());
  }
  return asked != nullptr;
}

void SdoServers::serve(const Frame& frame, SdoServer& server, std::uint32_t response_id) {
  if (!device_->works_now(Service::sdo)) return;
  server.on_request(frame, response_id);
  // The request may have ended the life of a channel, its own included.
  for (Additional& additional : additional_) {
    if (additional.server.busy() && !rules.exists(additional.channel)) additional.server.reset();
  }
}

void SdoServers::on_transmitted() {
  for (SdoServer* server : servers_) server->on_transmitted();
}

void SdoServers::on_time() {
  for (SdoServer* server : servers_) server->on_time();
}

void SdoServers::send_segments() {
  for (std::size_t idle = 0; idle < servers_.size();) {
    idle = servers_[turn_]->send_segment() ? 0 : idle + 1;
    if (++turn_ == servers_.size()) turn_ = 0;
  }
}

std::optional<BusTime> SdoServers::next_wakeup() const {
  std::optional<BusTime> first;
  for (const SdoServer* server : servers_) keep_earlier(first, server->next_wakeup());
  return first;
}

void SdoServers::on_state_change() {
  for (SdoServer* server : servers_) {
    if (rules.transfers_end_in(device_->state, server->channel())) server->reset();
  }
}

}  // namespace refnode
