// SPDX-License-Identifier: Apache-2.0
// Puts the services together: who sees which frame, and who is woken when.
#include "node.hpp"

#include <algorithm>
#include <utility>

#include "application_objects.hpp"
#include "base/text.hpp"
#include "device.hpp"
#include "emergency.hpp"
#include "emergency_consumer.hpp"
#include "error_behaviour.hpp"
#include "heartbeat.hpp"
#include "high_resolution_clock.hpp"
#include "manufacturer_objects.hpp"
#include "module_list.hpp"
#include "nmt_slave.hpp"
#include "node_guarding.hpp"
#include "operating_system.hpp"
#include "parameter_store.hpp"
#include "pdo.hpp"
#include "sdo_parameters.hpp"
#include "sdo_servers.hpp"
#include "standard_objects.hpp"
#include "stored_description.hpp"
#include "sync_time.hpp"
#include "variants/variant.hpp"

namespace refnode {

struct Node::Impl {
  explicit Impl(const Options& options);

  void reset(Reset reset);
  void boot_up();
  void change_state(NmtState from);
  void run_timers();
  void dispatch(const Frame& frame);

  Device device;
  Emergency emergency;
  HeartbeatProducer producer;
  HeartbeatConsumer consumer;
  SyncConsumer sync;
  TimeConsumer time;
  EmergencyConsumer emergencies;
  HighResolutionClock clock;
  NodeGuarding guarding;
  OperatingSystem operating_system;
  ReceivePdo rpdo;
  TransmitPdo tpdo;
  ParameterStore store;
  NmtSlave nmt;
  ErrorBehaviour error_behaviour;
  SdoServers sdo;
};

Node::Impl::Impl(const Options& options)
    : device(options.node_id),
      emergency(device),
      producer(device),
      consumer(device, emergency),
      sync(device, emergency),
      time(device),
      emergencies(device),
      clock(device),
      guarding(device, emergency),
      operating_system(device),
      rpdo(device, emergency),
      tpdo(device),
      store(device, options.storage),
      nmt(device),
      error_behaviour(device, nmt),
      sdo(device) {
  device.choices = options.choices;
  nmt.on_reset = [this](Reset kind) { reset(kind); };
  nmt.on_boot_up = [this] { boot_up(); };
  nmt.on_change = [this](NmtState from) { change_state(from); };
  consumer.on_loss = [this] { error_behaviour.on_communication_error(); };
  guarding.on_loss = [this] { error_behaviour.on_communication_error(); };
  sync.on_sync = [this] {
    rpdo.on_sync();
    tpdo.on_sync();
  };
  add_identity_objects(device);
  emergency.add_objects();
  add_error_control_objects(device, producer, consumer);
  add_stored_description(device);
  add_module_list(device);
  // The values of one RPDO change together and are one event of the TPDO.
  add_application_objects(device, [this] {
    if (!rpdo.applying()) tpdo.on_application_change();
  });
  rpdo.on_applied = [this] { tpdo.on_application_change(); };
  add_sdo_client(device);
  add_sample_objects(device);
  add_error_trigger(device, emergency);
}

void Node::Impl::reset(Reset kind) {
  device.outbox.clear();
  if (!device.behaviour.transfer_survives_reset) sdo.reset();
  producer.on_reset();
  consumer.on_reset();
  guarding.on_reset();
  clock.on_reset();
  operating_system.on_reset();
  emergency.on_reset(kind == Reset::node);
  store.load_power_on_values(kind == Reset::node);
  mirror_outputs(device.dictionary);
  rpdo.on_state_change();
  tpdo.on_state_change();
}

void Node::Impl::boot_up() {
  producer.on_boot_up();
  tpdo.on_state_change();
}

void Node::Impl::change_state(NmtState) {
  const Behaviour& faults = device.behaviour;
  const bool transfers_stay = faults.block.goes_on_in_stopped || faults.sdo.blocked_after_stopped;
  if (device.state == NmtState::stopped && !transfers_stay) sdo.reset();
  producer.on_state_change();
  rpdo.on_state_change();
  tpdo.on_state_change();
  emergency.on_state_change();
}

void Node::Impl::run_timers() {
  nmt.on_time();
  consumer.on_time();
  guarding.on_time();
  emergency.on_time();
  producer.on_time();
  rpdo.on_time();
  tpdo.on_time();
  sdo.on_time();
  device.outbox.on_time(device.now);
}

void Node::Impl::dispatch(const Frame& received) {
  Frame frame = received;
  if (frame.error) return;
  if (device.behaviour.accepts_extended_frames) frame.extended = false;
  if (device.behaviour.accepts_remote_frames) frame.remote = false;
  if (frame.extended) return;
  if (frame.remote) {
    if (!guarding.on_remote(frame)) tpdo.on_remote(frame);
    return;
  }

  if (device.behaviour.sdo.misread) device.behaviour.sdo.misread(frame, device.node_id);
  if (frame.id == 0x000) return nmt.on_command(frame);
  if (sdo.on_frame(frame)) return;
  if (device.state == NmtState::initialising) return;
  if (frame.id >= 0x701 && frame.id <= 0x77F && frame.size() == 1) {
    return consumer.on_heartbeat(static_cast<std::uint8_t>(frame.id - 0x700U), frame.data[0]);
  }
  if (device.state == NmtState::stopped) return;
  if (sync.on_frame(frame) || time.on_frame(frame) || emergencies.on_frame(frame)) return;
  rpdo.on_frame(frame);
}

namespace {

conform::Result<void> apply_variants(const Options& options, Device& device) {
  std::vector<const Variant*> used;
  for (const std::string& id : options.variants) {
    const Variant* variant = find_variant(id);
    if (variant == nullptr) {
      std::vector<std::string_view> known;
      for (const Variant& row : variants()) known.push_back(row.id);
      const std::string_view near = conform::did_you_mean(id, known);
      return conform::fail(
          "there is no variant '" + conform::printable(id) + "'", {},
          near.empty() ? "--list-variants prints all of them" : "did you mean '" + std::string(near) + "'?");
    }
    for (const Variant* other : used) {
      if (!compatible(*variant, *other)) {
        return conform::fail("variants '" + std::string(other->id) + "' and '" + id + "' exclude each other");
      }
    }
    used.push_back(variant);
    VariantTarget target{device.dictionary, device.choices, device.outbox, options.node_id};
    variant->how(target);
  }
  return {};
}

}  // namespace

Node::Node(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Node::~Node() = default;

conform::Result<std::unique_ptr<Node>> Node::create(Options options) {
  if (options.node_id < 1 || options.node_id > 127) {
    return conform::fail("node-ID " + std::to_string(options.node_id) + " is out of range", {},
                         "CANopen node-IDs are 1 to 127");
  }
  if (!options.storage) options.storage = std::make_shared<MemoryStorage>();
  auto impl = std::make_unique<Impl>(options);
  if (auto done = apply_variants(options, impl->device); !done) return std::unexpected(done.error());
  std::vector<std::string_view> used;
  for (const std::string& id : options.defects) {
    const Defect* defect = find_defect(id);
    if (defect == nullptr) {
      std::vector<std::string_view> known;
      for (const Defect& row : defects()) known.push_back(row.id);
      const std::string_view near = conform::did_you_mean(id, known);
      return conform::fail(
          "there is no defect '" + conform::printable(id) + "'", {},
          near.empty() ? "--list-defects prints all of them" : "did you mean '" + std::string(near) + "'?");
    }
    if (std::find(used.begin(), used.end(), defect->id) != used.end()) {
      return conform::fail("defect '" + id + "' is named twice");
    }
    used.push_back(defect->id);
    if (const auto* edit = std::get_if<DictionaryEdit>(&defect->how)) {
      (*edit)(impl->device.dictionary, options.node_id);
    } else if (const auto* filter = std::get_if<Filter>(&defect->how)) {
      impl->device.outbox.add_filter(*filter);
    } else {
      std::get<BehaviourSwitch>(defect->how)(impl->device.behaviour);
    }
  }
  return std::unique_ptr<Node>(new Node(std::move(impl)));
}

const ObjectDictionary& Node::dictionary() const { return impl_->device.dictionary; }

void Node::attach(Sender sender, conform::BusTime now) {
  impl_->device.outbox.attach(std::move(sender));
  impl_->device.now = now;
  impl_->nmt.start_reset(Reset::node);
}

void Node::on_frame(const conform::can::Frame& frame, conform::BusTime now) {
  impl_->device.now = std::max(impl_->device.now, now);
  impl_->run_timers();
  impl_->dispatch(frame);
  impl_->sdo.send_segments();
}

void Node::on_transmitted(conform::BusTime now) {
  impl_->device.now = std::max(impl_->device.now, now);
  impl_->device.outbox.on_transmitted(impl_->device.now);
  impl_->sdo.on_transmitted();
  impl_->sdo.send_segments();
}

void Node::on_time(conform::BusTime now) {
  impl_->device.now = std::max(impl_->device.now, now);
  impl_->run_timers();
  impl_->sdo.send_segments();
}

std::optional<conform::BusTime> Node::next_wakeup() const {
  const Impl& impl = *impl_;
  return earliest({impl.nmt.next_wakeup(), impl.consumer.next_wakeup(), impl.guarding.next_wakeup(),
                   impl.emergency.next_wakeup(), impl.producer.next_wakeup(), impl.rpdo.next_wakeup(),
                   impl.tpdo.next_wakeup(), impl.sdo.next_wakeup(), impl.device.outbox.next_wakeup()});
}

}  // namespace refnode
