// SPDX-License-Identifier: Apache-2.0
#include "error-control/node_guarding.hpp"

namespace refnode {

namespace {

constexpr std::uint8_t toggle_bit = 0x80;
constexpr ErrorCause lost{0x8130, ErrorSource::guarding, 0};

}  // namespace

void NodeGuarding::add_objects() {
  ObjectDictionary& od = device_->dictionary;
  od.add_variable(0x100C, integer_entry("Guard time", DataType::unsigned16, Access::rw, 0));
  od.add_variable(0x100D, integer_entry("Life time factor", DataType::unsigned8, Access::rw, 0));
}

void NodeGuarding::bind() {
  for (const std::uint16_t index : {std::uint16_t{0x100C}, std::uint16_t{0x100D}}) {
    Entry* entry = device_->dictionary.entry(index, 0);
    if (entry == nullptr) continue;
    // Another life time begins with the next request, and what was lost does not count any more.
    entry->written = [this] {
      watch(false);
      if (lost_) device_->errors.clear(lost);
      lost_ = false;
    };
  }
}

bool NodeGuarding::in_use() const {
  const ObjectDictionary& od = device_->dictionary;
  return od.entry(0x100C, 0) != nullptr && od.entry(0x100D, 0) != nullptr &&
         rules.is_used(od.number(0x1017, 0));
}

Duration NodeGuarding::life_time() const {
  const ObjectDictionary& od = device_->dictionary;
  return rules.life_time(od.number(0x100C, 0), od.number(0x100D, 0));
}

void NodeGuarding::watch(bool requested) {
  due_.reset();
  const Duration time = life_time();
  if (time > Duration::zero() && rules.begins_the_watch(requested)) due_ = device_->now + time;
}

bool NodeGuarding::on_remote(const Frame& frame) {
  if (frame.id != 0x700U + device_->node_id) return false;
  if (choices.answered_as_heartbeat && device_->dictionary.number(0x1017, 0) != 0 &&
      rules.is_answered_in(device_->state)) {
    device_->send(Service::guarding, conform::can::data_frame(conform::CanId(0x700U + device_->node_id),
                                                              {static_cast<std::uint8_t>(device_->state)}));
    return true;
  }
  if (!rules.is_answered_in(device_->state) || !in_use() || !rules.is_answered_with(life_time())) return true;
  const auto state = static_cast<std::uint8_t>(device_->state);
  const auto data = static_cast<std::uint8_t>(toggle_ ? state | toggle_bit : state);
  device_->send(Service::guarding,
                conform::can::data_frame(conform::CanId(0x700U + device_->node_id), {data}));
  toggle_ = !toggle_;
  watch(true);
  if (lost_) device_->errors.clear(lost);
  lost_ = false;
  return true;
}

void NodeGuarding::on_reset() {
  toggle_ = false;
  lost_ = false;
  if (rules.ends_with_reset()) due_.reset();
}

void NodeGuarding::on_time() {
  if (!due_ || device_->now < *due_) return;
  due_.reset();
  if (!in_use()) return;
  lost_ = true;
  device_->errors.raise(lost, 0);
  if (on_loss) on_loss();
}

}  // namespace refnode
