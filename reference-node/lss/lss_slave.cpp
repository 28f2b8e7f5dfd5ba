// SPDX-License-Identifier: Apache-2.0
#include "lss/lss_slave.hpp"

#include <algorithm>

namespace refnode {

namespace {

constexpr std::uint32_t request_id = 0x7E5;
constexpr std::uint32_t answer_id = 0x7E4;

// Command specifiers, the first byte of a frame.
constexpr std::uint8_t switch_state_global = 0x04;
constexpr std::uint8_t configure_node = 0x11;
constexpr std::uint8_t configure_rate = 0x13;
constexpr std::uint8_t activate_rate = 0x15;
constexpr std::uint8_t store_configuration = 0x17;
constexpr std::uint8_t selective_vendor = 0x40;
constexpr std::uint8_t selective_serial = 0x43;
constexpr std::uint8_t selective_answer = 0x44;
constexpr std::uint8_t identify_vendor = 0x46;
constexpr std::uint8_t identify_serial_high = 0x4B;
constexpr std::uint8_t identify_unconfigured = 0x4C;
constexpr std::uint8_t identify_answer = 0x4F;
constexpr std::uint8_t unconfigured_answer = 0x50;
constexpr std::uint8_t fastscan = 0x51;
constexpr std::uint8_t inquire_vendor = 0x5A;
constexpr std::uint8_t inquire_serial = 0x5D;
constexpr std::uint8_t inquire_node_id = 0x5E;

// Error codes of the answers to 11h, 13h and 17h; FFh: see the next byte.
constexpr std::uint8_t out_of_range = 1;
constexpr std::uint8_t not_supported = 1;
constexpr std::uint8_t memory_failed = 2;
constexpr std::uint8_t of_the_maker = 0xFF;

bool is_node_id(std::uint8_t value) { return value >= 1 && value <= 127; }

std::uint32_t number_of(const std::array<std::uint8_t, 8>& request) {
  return static_cast<std::uint32_t>(conform::load_le(ByteView(request).subspan(1, 4)));
}

}  // namespace

LssSlave::LssSlave(Device& device)
    : rules{.is_request{[](const Frame& frame) { return frame.size() == 8; }},
            .node_id_allowed{[this](std::uint8_t value) {
              return is_node_id(value) || (value == no_node_id && choices.can_be_unconfigured);
            }},
            .bit_rate_allowed{[](std::uint8_t table, std::uint8_t index) {
              return table == 0 && index <= 8 && index != 5;
            }},
            .address{[&device](std::uint8_t part) {
              return static_cast<std::uint32_t>(
                  device.dictionary.number(0x1018, static_cast<std::uint8_t>(part + 1)));
            }},
            .configured{[&device](const Frame&) { return device.node_id != no_node_id; }},
            .after_reset_communication{[](std::uint8_t, std::uint8_t pending) { return pending; }}},
      device_(&device),
      delivered_(device.node_id),
      pending_(device.node_id) {}

bool LssSlave::on_frame(const Frame& frame) {
  if (!choices.supported || frame.id != request_id) return false;
  // A slave without node-ID waits for one before its boot-up message.
  if (device_->node_id != no_node_id && !device_->works_now(Service::lss)) return true;
  if (rules.is_request(frame)) obey(frame);
  return true;
}

void LssSlave::obey(const Frame& frame) {
  Request request{};
  std::ranges::copy(frame.bytes(), request.begin());
  const std::uint8_t specifier = request[0];
  if (specifier == switch_state_global) return switch_global(request[1]);
  if (specifier >= identify_vendor && specifier <= identify_serial_high) return identify(request);
  if (specifier == identify_unconfigured) {
    if (choices.identify_non_configured && !rules.configured(frame)) answer(unconfigured_answer);
    return;
  }
  if (state_ == State::configuration) return configure(request);
  if (specifier >= selective_vendor && specifier <= selective_serial) return switch_selective(request);
  if (specifier == fastscan && choices.fastscan && !rules.configured(frame)) scan(request);
}

void LssSlave::switch_global(std::uint8_t mode) {
  if (mode == 0) enter(State::waiting);
  if (mode == 1) enter(State::configuration);
}

void LssSlave::enter(State state) {
  const bool left = state_ == State::configuration && state == State::waiting;
  state_ = state;
  selective_.forget();
  range_.forget();
  fastscan_.forget();
  if (!left || !is_node_id(pending_) || pending_ == device_->node_id) return;
  if ((device_->node_id == no_node_id || choices.node_id_at_once) && on_node_id) on_node_id();
}

void LssSlave::switch_selective(const Request& request) {
  const LssAddress own{rules.address(0), rules.address(1), rules.address(2), rules.address(3)};
  const auto part = static_cast<std::uint8_t>(request[0] - selective_vendor);
  if (!selective_.take(part, number_of(request), own, address_rules, choices.address_in_any_order)) return;
  enter(State::configuration);
  answer(selective_answer);
}

void LssSlave::identify(const Request& request) {
  if (!choices.identify_remote_slave) return;
  const LssAddress own{rules.address(0), rules.address(1), rules.address(2), rules.address(3)};
  const auto step = static_cast<std::uint8_t>(request[0] - identify_vendor);
  if (range_.take(step, number_of(request), own, address_rules)) answer(identify_answer);
}

// 51h, four bytes of the part, the lowest bit that counts, the part, the one that comes next.
void LssSlave::scan(const Request& request) {
  const LssAddress own{rules.address(0), rules.address(1), rules.address(2), rules.address(3)};
  const auto result =
      fastscan_.take(number_of(request), request[5], request[6], request[7], own, address_rules);
  if (result == Fastscan::Result::silent) return;
  if (result == Fastscan::Result::found) enter(State::configuration);
  answer(identify_answer);
}

void LssSlave::configure(const Request& request) {
  const std::uint8_t specifier = request[0];
  if (specifier >= inquire_vendor && specifier <= inquire_serial)
    return answer_number(specifier, rules.address(static_cast<std::uint8_t>(specifier - inquire_vendor)));
  switch (specifier) {
    case inquire_node_id: return answer(specifier, device_->node_id);
    case configure_node: return configure_node_id(request[1]);
    case configure_rate: return configure_bit_timing(request[1], request[2]);
    // The rate is the interface's, whose driver would be told here; there is no answer.
    case activate_rate: return;
    case store_configuration: return store();
    default: return;  // unknown, and what is for waiting slaves
  }
}

void LssSlave::configure_node_id(std::uint8_t node_id) {
  if (choices.node_id_fixed) return answer(configure_node, of_the_maker, 1);
  if (!rules.node_id_allowed(node_id)) return answer(configure_node, out_of_range);
  pending_ = node_id;
  answer(configure_node);
}

void LssSlave::configure_bit_timing(std::uint8_t table, std::uint8_t index) {
  if (!choices.bit_timing) return;
  if (choices.bit_rate_fixed) return answer(configure_rate, of_the_maker, 1);
  if (!rules.bit_rate_allowed(table, index)) return answer(configure_rate, out_of_range);
  if (choices.few_bit_rates && index > 4) return answer(configure_rate, of_the_maker, 1);
  bit_rate_ = index;
  answer(configure_rate);
}

void LssSlave::store() {
  if (!choices.store) return answer(store_configuration, not_supported);
  const bool kept = keep && keep(pending_, bit_rate_);
  answer(store_configuration, kept ? 0 : memory_failed);
}

std::uint8_t LssSlave::on_reset(bool whole_node) {
  if (!choices.state_survives_reset) state_ = State::waiting;
  selective_.forget();
  range_.forget();
  fastscan_.forget();
  if (!whole_node) return rules.after_reset_communication(device_->node_id, pending_);
  bit_rate_.reset();
  const auto stored = stored_node_id ? stored_node_id() : std::nullopt;
  pending_ = stored && choices.supported ? *stored : delivered_;
  return pending_;
}

void LssSlave::answer(std::uint8_t specifier, std::uint8_t error, std::uint8_t detail) {
  device_->send(Service::lss, conform::can::data_frame(conform::CanId(answer_id),
                                                       {specifier, error, detail, 0, 0, 0, 0, 0}));
}

void LssSlave::answer_number(std::uint8_t specifier, std::uint32_t number) {
  Request data{specifier};
  conform::store_le(std::span(data).subspan(1, 4), number);
  device_->send(Service::lss, conform::can::data_frame(conform::CanId(answer_id), data));
}

}  // namespace refnode
