// SPDX-License-Identifier: Apache-2.0
// The parts of the node: its device and the services on it. The node puts them together; legal variants set
// their choices, defects take hold of their rules and hooks.
#pragma once

#include <memory>

#include "device/device.hpp"
#include "emergency/consumer.hpp"
#include "emergency/emergency.hpp"
#include "error-control/error_behaviour.hpp"
#include "error-control/heartbeat_consumer.hpp"
#include "error-control/heartbeat_producer.hpp"
#include "error-control/node_guarding.hpp"
#include "lss/lss_slave.hpp"
#include "nmt/nmt_slave.hpp"
#include "objects/operating_system.hpp"
#include "pdo/pdos.hpp"
#include "sdo/servers.hpp"
#include "storage/memory.hpp"
#include "storage/parameter_store.hpp"
#include "sync/consumer.hpp"
#include "sync/producer.hpp"
#include "sync/supervision.hpp"
#include "sync/window.hpp"
#include "time/consumer.hpp"
#include "time/high_resolution_clock.hpp"
#include "time/producer.hpp"

namespace refnode {

struct Parts {
  Parts(std::uint8_t node_id, std::shared_ptr<Storage> storage)
      : device(node_id),
        emergency(device),
        producer(device),
        consumer(device),
        sync(device),
        sync_producer(device, sync.cob_id_rules),
        sync_window(device),
        sync_supervision(device),
        time(device),
        time_producer(device, time.cob_id_rules),
        emergencies(device),
        clock(device),
        guarding(device),
        operating_system(device),
        pdos(device),
        store(device, std::move(storage)),
        nmt(device),
        error_behaviour(device),
        sdo(device),
        lss(device) {}

  Device device;
  Emergency emergency;
  HeartbeatProducer producer;
  HeartbeatConsumer consumer;
  SyncConsumer sync;
  SyncProducer sync_producer;
  SyncWindow sync_window;
  SyncSupervision sync_supervision;
  TimeConsumer time;
  TimeProducer time_producer;
  EmergencyConsumer emergencies;
  HighResolutionClock clock;
  NodeGuarding guarding;
  OperatingSystem operating_system;
  Pdos pdos;
  ParameterStore store;
  NmtSlave nmt;
  ErrorBehaviour error_behaviour;
  SdoServers sdo;
  LssSlave lss;
};

}  // namespace refnode
