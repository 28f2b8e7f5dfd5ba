// SPDX-License-Identifier: Apache-2.0
#include "can/interface_lock.hpp"

#include <net/if.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <system_error>
#include <utility>

namespace conform::can {

Result<InterfaceLock> InterfaceLock::take(const std::string& interface_name) {
  const unsigned index = ::if_nametoindex(interface_name.c_str());
  if (index == 0) return fail("there is no such interface", interface_name);
  Descriptor socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket.valid())
    return fail("cannot open a socket: " + std::generic_category().message(errno), interface_name);
  // A name in the abstract space: no file that could be left behind, and a space of its own for each network
  // namespace, as interfaces have. The index, because two names may be one interface in turn.
  const std::string name = "canopen-conform/interface/" + std::to_string(index);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::copy(name.begin(), name.end(), address.sun_path + 1);
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), length) != 0) {
    if (errno != EADDRINUSE)
      return fail("cannot lock the interface: " + std::generic_category().message(errno), interface_name);
    return fail("another canopen-conform runs on this interface", interface_name,
                "wait for its end, or use another interface");
  }
  return InterfaceLock(std::move(socket));
}

}  // namespace conform::can
