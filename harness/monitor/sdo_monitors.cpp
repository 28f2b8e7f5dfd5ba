// SPDX-License-Identifier: Apache-2.0
// Monitors of single SDO responses: who asked, what they name, how they look.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "monitor/factories.hpp"
#include "monitor/sdo_server_frame.hpp"

namespace conform::monitor {
namespace {

using To = SdoAnswer::To;
using Cause = SdoAnswer::Cause;
using result::Verdict;

bool is_response(Observation::Subject subject) { return subject == Observation::Subject::sdo_response; }
bool is_response(const Observation& seen) { return seen.subject == Observation::Subject::sdo_response; }
/// An abort, also with reserved bits set. Segments of a block upload begin with their number.
bool is_abort(const Observation& seen) {
  if (!seen.answer.well_formed) return false;
  return seen.frame().data[0] == 0x80 || (!seen.answer.block && server::is_abort(seen.frame()));
}
std::string command(const Observation& seen) { return hex(seen.frame().data[0], 2); }

class SdoResponses final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { per_request, idle_abort, once };

  [[nodiscard]] bool wants(Observation::Subject subject) const override { return is_response(subject); }
  void on_frame(const Observation& seen, const Follower&) override {
    if (!is_response(seen)) return;
    const auto& answer = seen.answer;
    if (answer.to == To::request) {
      good(per_request);
      if (is_abort(seen)) good(once);
    }
    if (answer.to != To::nothing) return;
    switch (answer.cause) {
      case Cause::idle_abort:
        if (bad(idle_abort)) {
          tell(idle_abort, seen, "an answer to the client's abort", "silence",
               "no transfer was open, and an abort is never answered");
        }
        return;
      case Cause::client_abort:
        if (bad(per_request)) {
          tell(per_request, seen, "an answer to the client's abort", "silence",
               "an abort ends the transfer without an answer");
        }
        return;
      case Cause::repeated_abort:
        if (bad(once)) {
          tell(once, seen, "a further abort", "one abort per request",
               "the transfer was aborted already, and nothing was asked since");
        }
        return;
      case Cause::none:
        if (bad(per_request)) {
          tell(per_request, seen, "a server frame without a request", "one frame per request",
               "every request before it has its answer, and no transfer explains another frame");
        }
        return;
      case Cause::foreign:
      case Cause::broadcast:
      case Cause::extended:
      case Cause::own_id: return;  // told by the monitor of foreign requests
    }
  }
};

class SdoForeignRequests final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { other_node, node_zero, extended, own_id };

  void on_frame(const Observation& seen, const Follower& follower) override {
    if (seen.subject == Observation::Subject::foreign_request) {
      const auto& frame = seen.frame();
      const auto own = 0x580U + follower.facts().node.value();
      quiet(frame.extended      ? extended
            : frame.id == 0x600 ? node_zero
            : frame.id == own   ? own_id
                                : other_node);
      return;
    }
    if (!is_response(seen) || seen.answer.to != To::nothing) return;
    switch (seen.answer.cause) {
      case Cause::foreign: return answered(other_node, seen, "a request to another node");
      case Cause::broadcast: return answered(node_zero, seen, "a request on CAN-ID 600h");
      case Cause::extended: return answered(extended, seen, "a request with a 29-bit identifier");
      case Cause::own_id: return answered(own_id, seen, "a frame on its own response CAN-ID");
      default: return;
    }
  }

 private:
  void answered(std::size_t requirement, const Observation& seen, std::string_view what) {
    if (!bad(requirement)) return;
    tell(requirement, seen, fmt::format("an answer to {}", what), "silence",
         "no other request is open, and the answer names the object of that frame");
  }
};

class SdoMultiplexer final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { initiate, abort };

  [[nodiscard]] bool wants(Observation::Subject subject) const override { return is_response(subject); }
  void on_frame(const Observation& seen, const Follower&) override {
    if (!is_response(seen) || !seen.answer.mux) return;
    const auto& mux = *seen.answer.mux;
    const auto requirement = is_abort(seen) ? abort : initiate;
    if (mux.right) return good(requirement);
    if (!bad(requirement)) return;
    if (mux.free) {
      return tell(requirement, seen, fmt::format("{} in bytes 1 to 3", to_string(mux.got)),
                  fmt::format("{}, or zeros", to_string(mux.wanted)),
                  "the request names another object, and no transfer about this one is open", Verdict::warn);
    }
    tell(requirement, seen, fmt::format("{} in bytes 1 to 3", to_string(mux.got)), to_string(mux.wanted),
         seen.answer.to == To::several ? "none of the open requests names that object"
                                       : "the request or its transfer is about another object");
  }
};

class SdoFrameForm final : public Monitor {
 public:
  using Monitor::Monitor;

  [[nodiscard]] bool wants(Observation::Subject subject) const override { return is_response(subject); }
  void on_frame(const Observation& seen, const Follower&) override {
    if (!is_response(seen)) return;
    if (seen.frame().dlc == 8) return good(0);
    if (!bad(0)) return;
    tell(0, seen, fmt::format("DLC {}", seen.frame().dlc), "DLC 8", "all SDO frames have eight bytes");
  }
};

class SdoCommandByte final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { reserved_bits, unused_bytes };

  [[nodiscard]] bool wants(Observation::Subject subject) const override { return is_response(subject); }
  void on_frame(const Observation& seen, const Follower&) override {
    if (!is_response(seen) || seen.answer.block || !seen.answer.well_formed) return;
    if (seen.answer.to == To::unclear || seen.answer.to == To::nothing) return;
    const unsigned byte = seen.frame().data[0];
    const unsigned scs = byte >> 5U;
    bool right = true;
    switch (scs) {
      case 0: break;                               // t, n, c: all bits are used
      case 1: right = (byte & 0x0FU) == 0; break;  // t
      case 2: right = (byte & 0x10U) == 0; break;  // n, e, s
      case 3:
      case 4: right = (byte & 0x1FU) == 0; break;
      default: right = false;  // block answers to no block request, and 7
    }
    if (scs == 2 && (byte & 0x10U) == 0) {
      const bool size_of_data = (byte & 0x03U) == 0x03U;
      if ((byte & 0x0CU) == 0 || size_of_data) {
        good(unused_bytes);
      } else if (bad(unused_bytes)) {
        tell(unused_bytes, seen, fmt::format("command {}: n without e and s", command(seen)), "n = 0",
             "n counts unused bytes of expedited data whose size is indicated");
      }
    }
    // A block answer to another request is a wrong answer, but its bits are defined.
    if (scs == 5 || scs == 6) return;
    if (right) return good(reserved_bits);
    if (!bad(reserved_bits)) return;
    tell(reserved_bits, seen, fmt::format("command {}", command(seen)),
         scs == 7 ? "a defined server command specifier" : "reserved bits 0",
         "the command byte is not defined");
  }
};

class SdoReservedBytes final : public Monitor {
 public:
  using Monitor::Monitor;

  [[nodiscard]] bool wants(Observation::Subject subject) const override { return is_response(subject); }
  void on_frame(const Observation& seen, const Follower&) override {
    if (!is_response(seen) || seen.answer.block || seen.answer.to != To::request) return;
    const auto byte = seen.frame().data[0];
    std::size_t first = 8;
    if (byte == 0x60 || byte == 0x40) first = 4;
    if (byte == 0x20 || byte == 0x30) first = 1;
    if (first == 8) return;
    const auto reserved = ByteView(seen.frame().data).subspan(first);
    if (std::ranges::all_of(reserved, [](std::uint8_t each) { return each == 0; })) return good(0);
    if (!bad(0)) return;
    tell(0, seen, fmt::format("{} in bytes {} to 7", hex_bytes(reserved), first), "zeros",
         "reserved bytes are 0; many servers in the field echo the request here", Verdict::warn);
  }
};

class SdoAbortCodes final : public Monitor {
 public:
  using Monitor::Monitor;

  [[nodiscard]] bool wants(Observation::Subject subject) const override { return is_response(subject); }
  void on_frame(const Observation& seen, const Follower&) override {
    if (!is_response(seen) || !is_abort(seen)) return;
    const AbortCode code(static_cast<std::uint32_t>(load_le(ByteView(seen.frame().data).subspan(4))));
    if (!canopen::meaning(code).empty()) return good(0);
    if (!bad(0)) return;
    const bool class_8 = code.value() >> 16U == 0x0800;
    tell(0, seen, fmt::format("abort {}", to_string(code)), "a code of CiA 301, table 22",
         class_8 ? "a reserved code of class 0800h" : "a reserved code",
         class_8 ? Verdict::warn : Verdict::fail);
  }
};

}  // namespace

std::unique_ptr<Monitor> make_sdo_responses(const Rule& rule) { return std::make_unique<SdoResponses>(rule); }
std::unique_ptr<Monitor> make_sdo_foreign_requests(const Rule& rule) {
  return std::make_unique<SdoForeignRequests>(rule);
}
std::unique_ptr<Monitor> make_sdo_multiplexer(const Rule& rule) {
  return std::make_unique<SdoMultiplexer>(rule);
}
std::unique_ptr<Monitor> make_sdo_frame_form(const Rule& rule) {
  return std::make_unique<SdoFrameForm>(rule);
}
std::unique_ptr<Monitor> make_sdo_command_byte(const Rule& rule) {
  return std::make_unique<SdoCommandByte>(rule);
}
std::unique_ptr<Monitor> make_sdo_reserved_bytes(const Rule& rule) {
  return std::make_unique<SdoReservedBytes>(rule);
}
std::unique_ptr<Monitor> make_sdo_abort_codes(const Rule& rule) {
  return std::make_unique<SdoAbortCodes>(rule);
}

}  // namespace conform::monitor
