// SPDX-License-Identifier: Apache-2.0
#include "can/socketcan_interface.hpp"

#include <linux/can.h>
#include <linux/can/gw.h>
#include <linux/can/netlink.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "base/bytes.hpp"
#include "base/text.hpp"
#include "can/descriptor.hpp"

namespace conform::can {
namespace {

// From linux/if_arp.h and linux/if.h, which cannot be included beside net/if.h.
constexpr std::uint16_t arphrd_can = 280;
constexpr unsigned iff_echo = 1U << 18U;

struct Link {
  std::uint16_t hardware_type = 0;
  unsigned flags = 0;
  std::string kind;
  std::uint32_t bit_rate = 0;
  std::uint32_t sample_point = 0;
  std::uint32_t queue_length = 0;
  std::optional<std::uint32_t> state;
  std::optional<can_berr_counter> errors;
};

/// enum can_state of linux/can/netlink.h in the words of ISO 11898-1 and of the kernel.
std::string state_words(std::uint32_t state) {
  switch (state) {
    case CAN_STATE_ERROR_ACTIVE: return "error-active";
    case CAN_STATE_ERROR_WARNING: return "error-warning";
    case CAN_STATE_ERROR_PASSIVE: return "error-passive";
    case CAN_STATE_BUS_OFF: return "bus-off";
    case CAN_STATE_STOPPED: return "stopped";
    case CAN_STATE_SLEEPING: return "sleeping";
    default: return {};
  }
}

// Walks a list of netlink attributes; use(type, payload).
template <typename Use>
void attributes(ByteView view, Use&& use) {
  while (view.size() >= sizeof(rtattr)) {
    rtattr header{};
    std::memcpy(&header, view.data(), sizeof header);
    const std::size_t length = header.rta_len;
    if (length < sizeof header || length > view.size()) return;
    use(static_cast<std::uint16_t>(header.rta_type & NLA_TYPE_MASK),
        view.subspan(sizeof header, length - sizeof header));
    view = view.subspan(std::min<std::size_t>((length + 3U) & ~std::size_t{3}, view.size()));
  }
}

std::string text_of(ByteView payload) {
  std::string out(payload.begin(), payload.end());
  return out.substr(0, out.find('\0'));
}

template <typename T>
std::optional<T> value_of(ByteView payload) {
  T value{};
  if (payload.size() < sizeof value) return {};
  std::memcpy(&value, payload.data(), sizeof value);
  return value;
}

void parse_link_info(ByteView info, Link& link) {
  attributes(info, [&link](std::uint16_t type, ByteView payload) {
    if (type == IFLA_INFO_KIND) link.kind = text_of(payload);
    if (type != IFLA_INFO_DATA) return;
    attributes(payload, [&link](std::uint16_t data_type, ByteView data) {
      if (data_type == IFLA_CAN_BITTIMING) {
        if (const auto timing = value_of<can_bittiming>(data)) {
          link.bit_rate = timing->bitrate;
          link.sample_point = timing->sample_point;
        }
      }
      if (data_type == IFLA_CAN_BERR_COUNTER) link.errors = value_of<can_berr_counter>(data);
      if (data_type == IFLA_CAN_STATE) link.state = value_of<std::uint32_t>(data);
    });
  });
}

Result<Link> query(int index, const std::string& name) {
  const auto failed = [&name](const char* action) {
    return fail(std::string("cannot ") + action + ": " + std::generic_category().message(errno), name);
  };
  const Descriptor socket(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
  if (!socket.valid()) return failed("open a netlink socket");

  struct {
    nlmsghdr header;
    ifinfomsg info;
  } request{};
  request.header.nlmsg_len = sizeof request;
  request.header.nlmsg_type = RTM_GETLINK;
  request.header.nlmsg_flags = NLM_F_REQUEST;
  request.header.nlmsg_seq = 1;
  request.info.ifi_index = index;
  if (::send(socket.get(), &request, sizeof request, 0) < 0)
    return failed("ask the kernel about the interface");

  // One link with all its attributes; the kernel cuts what does not fit, which would only cost optional
  // facts.
  alignas(nlmsghdr) std::array<std::uint8_t, 32768> buffer;
  const ssize_t count = ::recv(socket.get(), buffer.data(), buffer.size(), 0);
  if (count < 0) return failed("hear from the kernel about the interface");
  ByteView answer = ByteView(buffer).first(static_cast<std::size_t>(count));
  const auto header = value_of<nlmsghdr>(answer);
  if (!header || header->nlmsg_len > answer.size()) return fail("the kernel's answer is cut off", name);
  answer = answer.first(header->nlmsg_len).subspan(sizeof(nlmsghdr));
  if (header->nlmsg_type == NLMSG_ERROR) {
    const auto error = value_of<nlmsgerr>(answer);
    errno = error ? -error->error : EIO;
    return failed("ask the kernel about the interface");
  }
  const auto info = value_of<ifinfomsg>(answer);
  if (header->nlmsg_type != RTM_NEWLINK || !info)
    return fail("the kernel's answer is not about a link", name);

  Link link;
  link.hardware_type = info->ifi_type;
  link.flags = info->ifi_flags;
  attributes(answer.subspan(sizeof(ifinfomsg)), [&link](std::uint16_t type, ByteView payload) {
    if (type == IFLA_LINKINFO) parse_link_info(payload, link);
    if (type == IFLA_TXQLEN) link.queue_length = value_of<std::uint32_t>(payload).value_or(0);
  });
  return link;
}

/// A job of the kernel's CAN gateway (cangw): frames of one interface are sent on the other.
using Route = std::pair<int, int>;

std::vector<Route> parse_routes(ByteView answer, bool& done) {
  std::vector<Route> routes;
  while (const auto header = value_of<nlmsghdr>(answer)) {
    const std::size_t length = header->nlmsg_len;
    if (length < sizeof(nlmsghdr) || length > answer.size()) break;
    if (header->nlmsg_type == NLMSG_DONE || header->nlmsg_type == NLMSG_ERROR) {
      done = true;
      break;
    }
    const auto payload = answer.subspan(sizeof(nlmsghdr), length - sizeof(nlmsghdr));
    answer = answer.subspan(std::min<std::size_t>((length + 3U) & ~std::size_t{3}, answer.size()));
    // A kernel without gateway answers with the routes of other families.
    const auto job = value_of<rtcanmsg>(payload);
    if (!job || job->can_family != AF_CAN || job->gwtype != CGW_TYPE_CAN_CAN) continue;
    Route route{};
    attributes(payload.subspan(sizeof(rtcanmsg)), [&route](std::uint16_t type, ByteView data) {
      if (type == CGW_SRC_IF) route.first = static_cast<int>(value_of<std::uint32_t>(data).value_or(0));
      if (type == CGW_DST_IF) route.second = static_cast<int>(value_of<std::uint32_t>(data).value_or(0));
    });
    if (route.first != 0 && route.second != 0) routes.push_back(route);
  }
  return routes;
}

/// None where the kernel has no gateway, or does not say.
std::vector<Route> gateway_routes() {
  std::vector<Route> routes;
  const Descriptor socket(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
  struct {
    nlmsghdr header;
    rtcanmsg job;
  } request{};
  request.header.nlmsg_len = sizeof request;
  request.header.nlmsg_type = RTM_GETROUTE;
  request.header.nlmsg_flags = NLM_F_REQUEST | NLM_F_DUMP;
  request.header.nlmsg_seq = 1;
  request.job.can_family = AF_CAN;
  request.job.gwtype = CGW_TYPE_CAN_CAN;
  if (!socket.valid() || ::send(socket.get(), &request, sizeof request, 0) < 0) return routes;
  for (bool done = false; !done;) {
    alignas(nlmsghdr) std::array<std::uint8_t, 32768> buffer;
    const ssize_t count = ::recv(socket.get(), buffer.data(), buffer.size(), 0);
    if (count <= 0) break;
    const auto some = parse_routes(ByteView(buffer).first(static_cast<std::size_t>(count)), done);
    routes.insert(routes.end(), some.begin(), some.end());
  }
  return routes;
}

/// The first interface that is no vcan and gets what is sent on `index`, directly or over other vcans. Empty:
/// none.
std::string routed_to(int index) {
  const auto routes = gateway_routes();
  std::set<int> reached{index};
  std::vector<int> next{index};
  while (!next.empty()) {
    const int source = next.back();
    next.pop_back();
    for (const auto& [from, to] : routes) {
      if (from != source || !reached.insert(to).second) continue;
      std::array<char, IFNAMSIZ> name{};
      if (::if_indextoname(static_cast<unsigned>(to), name.data()) == nullptr) continue;
      const auto link = query(to, name.data());
      if (!link || link->kind != "vcan") return name.data();
      next.push_back(to);
    }
  }
  return {};
}

std::string hardware_driver(const std::string& name) {
  std::array<char, 512> target;
  const std::string path = "/sys/class/net/" + name + "/device/driver";
  const ssize_t length = ::readlink(path.c_str(), target.data(), target.size());
  if (length <= 0) return {};
  const std::string_view text(target.data(), static_cast<std::size_t>(length));
  return std::string(text.substr(text.rfind('/') + 1));
}

std::string create_command(const std::string& name) {
  const std::string virtual_name = name.empty() || name.starts_with("can") ? "vcan0" : name;
  return "sudo ip link add dev " + virtual_name + " type vcan && sudo ip link set " + virtual_name + " up";
}

std::unexpected<Error> missing(const std::string& name) {
  const auto others = can_interfaces();
  std::string hint = others.empty() ? "the machine has no CAN interface; a virtual one: "
                                    : "there are: " + join(others, ", ") + "; a new virtual one: ";
  return fail("there is no such network interface", name, hint + create_command(name));
}

}  // namespace

std::string up_command(const std::string& name, const std::string& kind) {
  const bool has_bit_rate = kind != "vcan" && kind != "vxcan";
  return "sudo ip link set " + name + " up" + (has_bit_rate ? " type can bitrate 500000" : "");
}

std::vector<std::string> can_interfaces() {
  std::vector<std::string> names;
  struct if_nameindex* const all = ::if_nameindex();
  if (all == nullptr) return names;
  for (const auto* entry = all; entry->if_index != 0; ++entry) {
    const auto link = query(static_cast<int>(entry->if_index), entry->if_name);
    if (link && link->hardware_type == arphrd_can) names.emplace_back(entry->if_name);
  }
  ::if_freenameindex(all);
  std::ranges::sort(names);
  return names;
}

Result<InterfaceFacts> interface_facts(const std::string& name) {
  if (name.empty() || name.size() >= IFNAMSIZ ||
      name.find_first_of(std::string_view("/ \0", 3)) != std::string::npos) {
    return fail("is not a possible name of a network interface", printable(name),
                "for example can0 or vcan0");
  }
  const unsigned index = ::if_nametoindex(name.c_str());
  if (index == 0) return missing(name);
  const auto link = query(static_cast<int>(index), name);
  if (!link) return std::unexpected(link.error());
  if (link->hardware_type != arphrd_can) {
    const auto others = can_interfaces();
    return fail("is a network interface, but not a CAN interface", name,
                others.empty() ? "a virtual one: " + create_command("")
                               : "CAN interfaces are: " + join(others, ", "));
  }
  InterfaceFacts facts;
  facts.name = name;
  facts.index = static_cast<int>(index);
  facts.kind = link->kind;
  if (facts.kind == "vcan") facts.routed_to = routed_to(facts.index);
  facts.is_virtual = facts.kind == "vcan" && facts.routed_to.empty();
  facts.driver = hardware_driver(name);
  if (facts.driver.empty()) facts.driver = link->kind;
  facts.up = (link->flags & static_cast<unsigned>(IFF_UP)) != 0;
  facts.echo = (link->flags & iff_echo) != 0;
  facts.bus_off = link->state == static_cast<std::uint32_t>(CAN_STATE_BUS_OFF);
  facts.bit_rate = link->bit_rate;
  facts.sample_point = link->sample_point;
  facts.queue_length = link->queue_length;
  if (link->state) facts.state = state_words(*link->state);
  if (link->errors) facts.errors = {.transmit = link->errors->txerr, .receive = link->errors->rxerr};
  return facts;
}

Result<InterfaceFacts> preflight(const std::string& interface_name) {
  const Descriptor socket(::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW));
  if (!socket.valid()) {
    if (errno == EAFNOSUPPORT || errno == EPROTONOSUPPORT) {
      return fail(
          "the kernel has no CAN sockets", interface_name,
          "sudo modprobe can_raw; where that is impossible, use the simulated bus or scripts/with-vcan");
    }
    return fail("cannot open a CAN socket: " + std::generic_category().message(errno), interface_name);
  }
  auto facts = interface_facts(interface_name);
  if (!facts) return facts;
  if (!facts->up) {
    return fail("the interface is down", interface_name, up_command(interface_name, facts->kind));
  }
  if (facts->bus_off) {
    return fail("the controller is bus-off", interface_name,
                "check wiring, termination and bit rate, then: sudo ip link set " + interface_name +
                    " type can restart");
  }
  return facts;
}

}  // namespace conform::can
