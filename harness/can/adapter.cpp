// SPDX-License-Identifier: Apache-2.0
#include "can/adapter.hpp"

#include <linux/ethtool.h>
#include <linux/net_tstamp.h>
#include <linux/sockios.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <array>
#include <cstring>

#include "can/descriptor.hpp"

namespace conform::can {
namespace {

template <std::size_t Size>
std::string text_of(const char (&field)[Size]) {
  return {field, ::strnlen(field, Size)};
}

/// Asks the driver; false where it has no answer.
template <typename Question>
bool ask(const Descriptor& socket, const std::string& name, Question& question) {
  ifreq request{};
  name.copy(request.ifr_name, IFNAMSIZ - 1);
  request.ifr_data = reinterpret_cast<char*>(&question);
  return ::ioctl(socket.get(), SIOCETHTOOL, &request) == 0;
}

}  // namespace

AdapterFacts adapter_facts(const std::string& interface_name) {
  AdapterFacts out;
  if (interface_name.empty() || interface_name.size() >= IFNAMSIZ) return out;
  // Any socket will do: what is asked for is the interface.
  const Descriptor socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket.valid()) return out;
  ethtool_drvinfo driver{};
  driver.cmd = ETHTOOL_GDRVINFO;
  if (ask(socket, interface_name, driver)) {
    out.driver = text_of(driver.driver);
    out.version = text_of(driver.version);
    out.firmware = text_of(driver.fw_version);
    out.bus = text_of(driver.bus_info);
  }
  ethtool_ts_info stamps{};
  stamps.cmd = ETHTOOL_GET_TS_INFO;
  if (ask(socket, interface_name, stamps))
    out.has_hardware_clock = (stamps.so_timestamping & SOF_TIMESTAMPING_RX_HARDWARE) != 0;
  return out;
}

}  // namespace conform::can
