// SPDX-License-Identifier: Apache-2.0
// All SDO servers of the node: the default one, and the additional ones of 1201h and 1202h, each with a
// transfer of its own (CiA 301, 7.2.4.1). Whose request a frame is, and who may send next.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "device.hpp"
#include "sdo_parameters.hpp"
#include "sdo_server.hpp"

namespace refnode {

class SdoServers {
 public:
  /// Adds the parameter objects of the additional servers.
  explicit SdoServers(Device& device);

  /// True when the frame was a request to one of the servers; it is served in the states that allow it.
  bool on_frame(const Frame& frame);
  void on_transmitted();
  void on_time();
  /// Segments of block uploads, in turns while several servers send.
  void send_segments();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const;
  /// Drops all running transfers without a word.
  void reset();

 private:
  struct Additional {
    SdoChannel channel;
    SdoServer server;
  };

  [[nodiscard]] bool served_now() const;
  [[nodiscard]] bool is_default_request(std::uint32_t id) const;
  void serve(const Frame& frame, SdoServer& server, std::uint32_t response_id);

  static constexpr std::size_t server_count = 3;

  Device* device_;
  SdoServer default_;
  std::array<Additional, server_count - 1> additional_;
  std::array<SdoServer*, server_count> servers_;
  std::size_t turn_ = 0;       ///< who may send the next segment
  std::optional<Frame> held_;  ///< used by a defect only
};

}  // namespace refnode
