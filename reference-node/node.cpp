// SPDX-License-Identifier: Apache-2.0
// Puts the services together: who sees which frame, and who is woken when.
#include "node.hpp"

#include <algorithm>
#include <utility>

#include "application_objects.hpp"
#include "base/text.hpp"
#include "device.hpp"
#include "emergency.hpp"
#include "heartbeat.hpp"
#include "manufacturer_objects.hpp"
#include "nmt_slave.hpp"
#include "parameter_store.hpp"
#include "pdo.hpp"
#include "sdo_server.hpp"
#include "standard_objects.hpp"
#include "sync_time.hpp"

namespace refnode {

struct Node::Impl {
  explicit Impl(const Options& options);

  void reset(Reset reset);
  void boot_up();
  void change_state(NmtState from);
  void run_timers();
  void dispatch(const Frame& frame);
  [[nodiscard]] bool serves_sdo() const;
  [[nodiscard]] bool is_sdo_request(std::uint32_t id) const;

  Device device;
  Emergency emergency;
  HeartbeatProducer producer;
  HeartbeatConsumer consumer;
  SyncConsumer sync;
  TimeConsumer time;
  ReceivePdo rpdo;
  TransmitPdo tpdo;
  ParameterStore store;
  NmtSlave nmt;
  SdoServer sdo;
};

Node::Impl::Impl(const Options& options)
    : device(options.node_id),
      emergency(device),
      producer(device),
      consumer(device, emergency),
      sync(device, emergency),
      time(device),
      rpdo(device, emergency),
      tpdo(device),
      store(device, options.storage),
      nmt(device),
      sdo(device, options.turnaround) {
  nmt.on_reset = [this](Reset kind) { reset(kind); };
  nmt.on_boot_up = [this] { boot_up(); };
  nmt.on_change = [this](NmtState from) { change_state(from); };
  // Without 1029h the default error behaviour applies: a lost producer ends Operational (CiA 301, 7.5.2.32).
  consumer.on_loss = [this] {
    const bool leaves =
        device.state == NmtState::operational && !device.behaviour.consumer_loss_keeps_operational;
    if (leaves) nmt.enter(NmtState::pre_operational);
  };
  sync.on_sync = [this] {
    rpdo.on_sync();
    tpdo.on_sync();
  };
  add_identity_objects(device);
  emergency.add_objects();
  add_error_control_objects(device, producer, consumer);
  // The values of one RPDO change together and are one event of the TPDO.
  add_application_objects(device, [this] {
    if (!rpdo.applying()) tpdo.on_application_change();
  });
  rpdo.on_applied = [this] { tpdo.on_application_change(); };
  add_sample_objects(device);
  add_error_trigger(device, emergency);
}

void Node::Impl::reset(Reset kind) {
  device.outbox.clear();
  if (!device.behaviour.transfer_survives_reset) sdo.reset();
  producer.on_reset();
  consumer.on_reset();
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
  if (device.state == NmtState::stopped) sdo.reset();
  producer.on_state_change();
  rpdo.on_state_change();
  tpdo.on_state_change();
  emergency.on_state_change();
}

void Node::Impl::run_timers() {
  nmt.on_time();
  consumer.on_time();
  emergency.on_time();
  producer.on_time();
  rpdo.on_time();
  tpdo.on_time();
  device.outbox.on_time(device.now);
}

bool Node::Impl::serves_sdo() const {
  switch (device.state) {
    case NmtState::initialising: return device.behaviour.sdo_served_before_boot_up;
    case NmtState::stopped: return device.behaviour.sdo_served_in_stopped;
    case NmtState::pre_operational:
    case NmtState::operational: return true;
  }
  return false;
}

bool Node::Impl::is_sdo_request(std::uint32_t id) const {
  const Behaviour& behaviour = device.behaviour;
  if (behaviour.answers_foreign_node_ids && id >= 0x601 && id <= 0x67F) return true;
  if (behaviour.answers_broadcast && id == 0x600) return true;
  if (behaviour.answers_on_response_id && id == 0x580U + device.node_id) return true;
  return id == 0x600U + device.node_id;
}

void Node::Impl::dispatch(const Frame& received) {
  Frame frame = received;
  if (frame.error) return;
  if (device.behaviour.accepts_extended_frames) frame.extended = false;
  if (device.behaviour.accepts_remote_frames) frame.remote = false;
  if (frame.extended) return;
  if (frame.remote) {
    tpdo.on_remote(frame);
    return;
  }

  if (frame.id == 0x000) return nmt.on_command(frame);
  if (is_sdo_request(frame.id)) {
    if (serves_sdo()) sdo.on_request(frame);
    return;
  }
  if (device.state == NmtState::initialising) return;
  if (frame.id >= 0x701 && frame.id <= 0x77F && frame.size() == 1) {
    return consumer.on_heartbeat(static_cast<std::uint8_t>(frame.id - 0x700U));
  }
  if (device.state == NmtState::stopped) return;
  if (sync.on_frame(frame) || time.on_frame(frame)) return;
  rpdo.on_frame(frame);
}

Node::Node(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Node::~Node() = default;

conform::Result<std::unique_ptr<Node>> Node::create(Options options) {
  if (options.node_id < 1 || options.node_id > 127) {
    return conform::fail("node-ID " + std::to_string(options.node_id) + " is out of range", {},
                         "CANopen node-IDs are 1 to 127");
  }
  if (!options.storage) options.storage = std::make_shared<MemoryStorage>();
  auto impl = std::make_unique<Impl>(options);
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
}

void Node::on_time(conform::BusTime now) {
  impl_->device.now = std::max(impl_->device.now, now);
  impl_->run_timers();
}

std::optional<conform::BusTime> Node::next_wakeup() const {
  const Impl& impl = *impl_;
  return earliest({impl.nmt.next_wakeup(), impl.consumer.next_wakeup(), impl.emergency.next_wakeup(),
                   impl.producer.next_wakeup(), impl.rpdo.next_wakeup(), impl.tpdo.next_wakeup(),
                   impl.device.outbox.next_wakeup()});
}

}  // namespace refnode
