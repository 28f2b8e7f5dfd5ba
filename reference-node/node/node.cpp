// SPDX-License-Identifier: Apache-2.0
// Puts the services together: who sees which frame, and who is woken when.
#include "node/node.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "eds/eds.hpp"
#include "emergency/trigger.hpp"
#include "node/eds_text.hpp"
#include "node/switches.hpp"
#include "objects/application_objects.hpp"
#include "objects/manufacturer_objects.hpp"
#include "objects/module_list.hpp"
#include "objects/standard_objects.hpp"
#include "objects/stored_description.hpp"
#include "parts/parts.hpp"
#include "sdo/parameters.hpp"
#include "twin/twin.hpp"

namespace refnode {

struct Node::Impl : Parts {
  /// `twin`: the dictionary to serve; empty: the node's own.
  Impl(const Options& options, std::optional<Twin> twin);

  void add_own_objects();
  void take_over(Twin twin);
  void reset(Reset reset);
  void boot_up();
  void change_state(NmtState from);
  void run_timers();
  /// What is due by now is done before a frame is looked at. Nothing is, most of the time, and whoever drives
  /// the node has just asked when something will be.
  void run_due_timers() {
    if (!wakeup || device.now >= *wakeup) run_timers();
  }
  [[nodiscard]] std::optional<BusTime> earliest_wakeup() const;
  /// A SYNC has come, or the node has sent one.
  void begin_cycle(std::optional<std::uint8_t> counter);
  void dispatch(const Frame& frame);

  TwinRemarks remarks;
  /// When something is due, as said last (BusTime::max(): never); nothing: the node has changed since.
  mutable std::optional<BusTime> wakeup;
};

Node::Impl::Impl(const Options& options, std::optional<Twin> twin) : Parts(options.node_id, options.storage) {
  if (options.description)
    lss.choices.supported =
        conform::eds::flag_of(options.description->device_info.lss_supported).value_or(false);
  lss.stored_node_id = [this] { return store.stored_node_id(); };
  lss.keep = [this](std::uint8_t node_id, std::optional<std::uint8_t> bit_rate) {
    return store.store_layer_setting(node_id, bit_rate);
  };
  lss.on_node_id = [this] { nmt.start_reset(Reset::communication); };
  nmt.on_reset = [this](Reset kind) { reset(kind); };
  nmt.on_boot_up = [this] { boot_up(); };
  nmt.on_change = [this](NmtState from) { change_state(from); };
  error_behaviour.enter = [this](NmtState state) { nmt.enter(state); };
  consumer.on_loss = [this] { error_behaviour.on_communication_error(); };
  guarding.on_loss = [this] { error_behaviour.on_communication_error(); };
  sync.on_sync = [this](std::optional<std::uint8_t> counter) {
    sync_supervision.on_sync();
    begin_cycle(counter);
  };
  sync_producer.on_sync = [this](std::optional<std::uint8_t> counter) { begin_cycle(counter); };
  pdos.rpdo.in_window = [this] { return sync_window.takes_rpdo(); };
  time.on_time_of_day = [this](std::uint32_t milliseconds, std::uint16_t days) {
    time_producer.set_clock({milliseconds, days});
  };
  if (twin) {
    take_over(std::move(*twin));
  } else {
    add_own_objects();
  }
  // The services work on the objects there are, whoever described them.
  emergency.bind();
  producer.bind();
  consumer.bind();
  sync.bind();
  sync_producer.bind();
  time.bind();
  time_producer.bind();
  emergencies.bind();
  clock.bind();
  guarding.bind();
  pdos.bind();
  store.bind();
  sdo.bind();
  device.inbox.attach([this](const Frame& frame) { dispatch(frame); });
}

void Node::Impl::add_own_objects() {
  add_identity_objects(device);
  emergency.add_objects();
  producer.add_objects();
  consumer.add_objects();
  sync.add_objects();
  time.add_objects();
  emergencies.add_objects();
  clock.add_objects();
  guarding.add_objects();
  operating_system.add_objects();
  error_behaviour.add_objects();
  pdos.add_objects();
  store.add_objects();
  sdo.add_objects();
  add_stored_description(device, eds_text);
  add_module_list(device);
  add_sdo_client(device);
  add_application_objects(device, [this] { pdos.on_application_change(); });
  add_sample_objects(device);
  add_error_trigger(device, emergency);
}

void Node::Impl::take_over(Twin twin) {
  device.described = true;
  device.dictionary.objects() = std::move(twin.objects);
  pdos.rpdo.parameters.placeholders = twin.placeholders;
  remarks = std::move(twin.remarks);
  report_changes(device, [this] { pdos.on_application_change(); });
  // Of how many errors 1003h tells.
  const auto& objects = device.dictionary.objects();
  if (const auto history = objects.find(0x1003); history != objects.end()) {
    const auto fields = std::ranges::count_if(
        history->second.entries, [](const auto& entry) { return entry.first != 0 && entry.first != 0xFF; });
    emergency.history.choices.depth = static_cast<std::uint8_t>(fields);
  }
  // Whoever produces SYNC has a period for it; more than that a description does not say.
  sync.cob_id_rules.choices.produced = objects.contains(0x1006);
  // Without SYNC there are no transmission types that need it.
  if (!objects.contains(0x1005)) {
    for (PdoTerms* terms : {&pdos.rpdo.parameters, &pdos.tpdo.parameters})
      terms->choices.synchronous_types = terms->choices.remote_types = false;
  }
}

void Node::Impl::reset(Reset kind) {
  const std::uint8_t node_id = lss.on_reset(kind == Reset::node);
  device.dictionary.change_node_id(device.node_id, node_id);
  device.node_id = node_id;
  device.inbox.clear();
  device.outbox.clear();
  sdo.on_state_change();
  producer.on_reset();
  sync_producer.on_reset();
  sync_window.on_reset();
  sync_supervision.on_reset();
  time_producer.on_reset();
  consumer.on_reset();
  guarding.on_reset();
  clock.on_reset();
  operating_system.on_reset();
  emergency.on_reset(kind == Reset::node);
  store.load_power_on_values(kind == Reset::node);
  if (!device.described) mirror_outputs(device.dictionary);
  pdos.on_state_change();
}

void Node::Impl::boot_up() {
  producer.on_boot_up();
  sync_producer.on_boot_up();
  time_producer.update();
  pdos.on_boot_up();
  emergency.on_boot_up();
}

void Node::Impl::begin_cycle(std::optional<std::uint8_t> counter) {
  pdos.on_sync(counter);
  sync_window.on_sync();
}

void Node::Impl::change_state(NmtState from) {
  sdo.on_state_change();
  producer.on_state_change();
  sync_producer.on_state_change(from);
  sync_supervision.on_state_change();
  time_producer.update();
  pdos.on_state_change();
  emergency.on_state_change();
}

void Node::Impl::run_timers() {
  nmt.on_time();
  consumer.on_time();
  guarding.on_time();
  emergency.on_time();
  producer.on_time();
  sync_producer.on_time();
  sync_supervision.on_time();
  time_producer.on_time();
  pdos.on_time();
  store.on_time();
  sdo.on_time();
  device.inbox.on_time(device.now);
  device.outbox.on_time(device.now);
}

void Node::Impl::dispatch(const Frame& frame) {
  if (frame.extended) {  // of all services only PDOs can have 29 bits
    if (frame.remote) return pdos.on_remote(frame);
    if (device.state == NmtState::operational) pdos.on_frame(frame);
    return;
  }
  if (frame.remote) {
    if (!guarding.on_remote(frame)) pdos.on_remote(frame);
    return;
  }

  if (frame.id == 0x000) return nmt.on_command(frame);
  if (lss.on_frame(frame)) return;
  if (sdo.on_frame(frame)) return;
  if (device.state == NmtState::initialising) return;
  if (frame.id >= 0x701 && frame.id <= 0x77F && frame.size() == 1) {
    return consumer.on_heartbeat(static_cast<std::uint8_t>(frame.id - 0x700U), frame.data[0]);
  }
  if (device.state == NmtState::stopped) return;
  if (sync.on_frame(frame) || time.on_frame(frame) || emergencies.on_frame(frame)) return;
  pdos.on_frame(frame);
}

Node::Node(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Node::~Node() = default;

conform::Result<std::unique_ptr<Node>> Node::create(Options options) {
  if ((options.node_id < 1 || options.node_id > 127) && options.node_id != LssSlave::no_node_id) {
    return conform::fail("node-ID " + std::to_string(options.node_id) + " is out of range", {},
                         "CANopen node-IDs are 1 to 127; 255 is a node without one, which waits for LSS");
  }
  if (!options.storage) options.storage = std::make_shared<MemoryStorage>();
  std::optional<Twin> twin;
  if (options.description) {
    auto made = make_twin(*options.description, options.node_id);
    if (!made) return std::unexpected(made.error());
    twin = std::move(*made);
  }
  auto impl = std::make_unique<Impl>(options, std::move(twin));
  if (options.adjust) options.adjust(*impl);
  if (auto done = apply_variants(options.variants, *impl); !done) return std::unexpected(done.error());
  if (auto done = apply_defects(options.defects, *impl); !done) return std::unexpected(done.error());
  return std::unique_ptr<Node>(new Node(std::move(impl)));
}

const ObjectDictionary& Node::dictionary() const { return impl_->device.dictionary; }
const TwinRemarks& Node::remarks() const { return impl_->remarks; }

void Node::attach(Sender sender, conform::BusTime now) {
  impl_->device.outbox.attach(std::move(sender));
  impl_->device.now = now;
  impl_->wakeup.reset();
  impl_->nmt.start_reset(Reset::node);
}

void Node::on_frame(const conform::can::Frame& frame, conform::BusTime now) {
  impl_->device.now = std::max(impl_->device.now, now);
  impl_->run_due_timers();
  impl_->wakeup.reset();
  if (!frame.error) impl_->device.inbox.receive(frame);
  impl_->sdo.send_segments();
}

void Node::on_transmitted(conform::BusTime now) {
  impl_->wakeup.reset();
  impl_->device.now = std::max(impl_->device.now, now);
  impl_->device.outbox.on_transmitted(impl_->device.now);
  impl_->sdo.on_transmitted();
  impl_->sdo.send_segments();
}

void Node::on_time(conform::BusTime now) {
  impl_->wakeup.reset();
  impl_->device.now = std::max(impl_->device.now, now);
  impl_->run_timers();
  impl_->sdo.send_segments();
}

std::optional<conform::BusTime> Node::next_wakeup() const {
  const auto first = impl_->earliest_wakeup();
  impl_->wakeup = first.value_or(BusTime::max());
  return first;
}

std::optional<BusTime> Node::Impl::earliest_wakeup() const {
  std::optional<BusTime> first;
  keep_earlier(first, nmt.next_wakeup());
  keep_earlier(first, consumer.next_wakeup());
  keep_earlier(first, guarding.next_wakeup());
  keep_earlier(first, emergency.next_wakeup());
  keep_earlier(first, producer.next_wakeup());
  keep_earlier(first, sync_producer.next_wakeup());
  keep_earlier(first, sync_supervision.next_wakeup());
  keep_earlier(first, time_producer.next_wakeup());
  keep_earlier(first, pdos.next_wakeup());
  keep_earlier(first, store.next_wakeup());
  keep_earlier(first, sdo.next_wakeup());
  keep_earlier(first, device.inbox.next_wakeup());
  keep_earlier(first, device.outbox.next_wakeup());
  return first;
}

}  // namespace refnode
