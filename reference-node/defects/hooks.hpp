// SPDX-License-Identifier: Apache-2.0
// Defects at the seams of the node: hooks of an entry, errors, frames that come in, and rules of a service.
// Each puts itself before what was there, so that several work together.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <set>
#include <utility>

#include "defects/defect.hpp"

namespace refnode::defect {

using Check = std::function<Accepted(ByteView)>;
using Read = std::function<Upload()>;

/// `check(parts, former, bytes)` decides on what is written; `former` is what the service says.
[[nodiscard]] Change checking(std::uint16_t index, std::uint8_t sub,
                              std::function<Accepted(Parts&, const Check& former, ByteView)> check);
/// The same for every sub-index of an object from 01h on; the sub-index is given.
[[nodiscard]] Change checking_all(
    std::uint16_t index,
    std::function<Accepted(Parts&, const Check& former, std::uint8_t sub, ByteView)> check);
/// `read(parts, former)` answers uploads.
[[nodiscard]] Change reading(std::uint16_t index, std::uint8_t sub,
                             std::function<Upload(Parts&, const Read& former)> read);
/// The same for every sub-index of an object from 01h on; the sub-index is given.
[[nodiscard]] Change reading_all(std::uint16_t index,
                                 std::function<Upload(Parts&, const Read& former, std::uint8_t sub)> read);
/// `written(parts, former)` follows a write.
[[nodiscard]] Change after_writing(std::uint16_t index, std::uint8_t sub,
                                   std::function<void(Parts&, const std::function<void()>& former)> written);
/// The same for every sub-index of an object from 01h on; the sub-index is given.
[[nodiscard]] Change after_writing_all(
    std::uint16_t index,
    std::function<void(Parts&, const std::function<void()>& former, std::uint8_t sub)> written);
/// In Operational nothing follows a write.
[[nodiscard]] Change without_effect_in_operational(std::uint16_t index);

/// A write that `when` holds for is confirmed without a look at it.
[[nodiscard]] Change confirms(std::uint16_t index, std::uint8_t sub, bool (*when)(std::uint64_t value));
/// A write that changes the entry in a way that `when` holds for is refused.
[[nodiscard]] Change refuses(std::uint16_t index, std::uint8_t sub, AbortCode code,
                             bool (*when)(std::uint64_t present, std::uint64_t wanted));

/// Errors of `source` with this code do not come through; 0: whatever their code.
[[nodiscard]] Change unnoticed(ErrorSource source, std::uint16_t code = 0);

/// The service works in this state, too.
[[nodiscard]] Change works_also(Service service, NmtState state);

/// Frames for which `when` holds do not reach any service.
[[nodiscard]] Change deaf_to(std::function<bool(Parts&, const Frame&)> when);
/// Every frame is changed by `change` before a service sees it.
[[nodiscard]] Change misreads(std::function<void(Parts&, Frame&)> change);

/// `act` runs with every boot-up message.
[[nodiscard]] Change with_boot_up(std::function<void(Parts&)> act);
/// A memory that begins anew with every boot-up message.
template <typename Memory>
[[nodiscard]] std::shared_ptr<Memory> since_boot_up(Parts& parts) {
  auto memory = std::make_shared<Memory>();
  with_boot_up([memory](Parts&) { *memory = Memory{}; })(parts);
  return memory;
}
/// `act` runs when the NMT state has changed, before any service hears of it.
[[nodiscard]] Change ahead_of_state_change(std::function<void(Parts&)> act);
/// A memory that begins anew with every boot-up message and every NMT state.
template <typename Memory>
[[nodiscard]] std::shared_ptr<Memory> since_state_change(Parts& parts) {
  auto memory = since_boot_up<Memory>(parts);
  ahead_of_state_change([memory](Parts&) { *memory = Memory{}; })(parts);
  return memory;
}
/// Whether an error behaviour (1029h) has led to the NMT state, and no command since to another.
[[nodiscard]] std::shared_ptr<bool> led_by_error(Parts& parts);
/// Where an error has led to this state the service works although it does not in this state.
[[nodiscard]] Change works_where_led_by_error(Service which, NmtState where);
/// What has been written of these objects since the boot-up message.
[[nodiscard]] std::shared_ptr<std::set<Multiplexer>> written_since_boot_up(
    Parts& parts, std::initializer_list<std::uint16_t> indices);

/// The default SDO server has a transfer that has not ended.
[[nodiscard]] bool has_open_transfer(const Parts& parts);

/// Another decision in place of a rule: `other(former, given...)`. `part` finds the struct of rules.
template <typename Rules, typename Signature, typename Other>
[[nodiscard]] Change decides(Rules& (*part)(Parts&), Rule<Signature> Rules::* rule, Other other) {
  return [part, rule, other](Parts& parts) { (part(parts).*rule).replace(other); };
}

// All of these, one after the other.
template <typename... More>
[[nodiscard]] Change together(Change first, More... more) {
  return [first = std::move(first), ... more = Change(std::move(more))](Parts& parts) {
    first(parts);
    (more(parts), ...);
  };
}

}  // namespace refnode::defect
