// SPDX-License-Identifier: Apache-2.0
// All SDO servers of the node: the default one, and one for each object from 1201h on, each with a transfer
// of its own (CiA 301, 7.2.4.1). Whose request a frame is, and who may send next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "device/device.hpp"
#include "sdo/choices.hpp"
#include "sdo/parameters.hpp"
#include "sdo/rules.hpp"
#include "sdo/server.hpp"

namespace refnode {

class SdoServers {
 public:
  explicit SdoServers(Device& device);
  SdoServers(const SdoServers&) = delete;
  SdoServers& operator=(const SdoServers&) = delete;

  SdoChoices choices;
  SdoRules rules;
  CobIdRules cob_id_rules{CobIdUse::sdo_server};
  CobIdRules client_cob_id_rules{CobIdUse::sdo_client};

  /// Adds the parameter objects of two additional servers.
  void add_objects();
  /// Makes a server for every parameter object from 1201h on.
  void bind();

  /// Whose request a data frame would be; nullptr: nobody's.
  [[nodiscard]] const SdoServer* server_of(const Frame& frame) const;
  /// True when the frame was a request to one of the servers; it is served in the states that allow it.
  bool on_frame(const Frame& frame);
  void on_transmitted();
  void on_time();
  /// Segments of block uploads, in turns while several servers send.
  void send_segments();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const;
  /// Where transfers end they are dropped without a word.
  void on_state_change();
  /// The transfer of the default server is forgotten without a word.
  void drop() { default_.reset(); }

 private:
  struct Additional {
    SdoChannel channel;
    SdoServer server;
  };

  void serve(const Frame& frame, SdoServer& server, std::uint32_t response_id);

  Device* device_;
  SdoServer default_;
  std::deque<Additional> additional_;
  std::vector<SdoServer*> servers_;  ///< all of them, by index of their parameters
  std::size_t turn_ = 0;             ///< who may send the next segment
};

}  // namespace refnode
