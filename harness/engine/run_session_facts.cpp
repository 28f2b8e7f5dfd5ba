// SPDX-License-Identifier: Apache-2.0
// What steps and conditions ask about the device: looked up in the profile and the description, or found out
// once by trying, and what the answer rests on.
#include <algorithm>
#include <array>
#include <chrono>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/integer_range.hpp"
#include "canopen/pdo.hpp"
#include "engine/mapping_probe.hpp"
#include "engine/run_session.hpp"

namespace conform::engine {
namespace {

/// 101x or 110x: initiate request of a block upload (its block size, no CRC) or download (its size).
std::array<std::uint8_t, 8> block_initiate(std::uint8_t command, Multiplexer object, std::uint8_t size) {
  return {command,
          static_cast<std::uint8_t>(object.index.value() & 0xFFU),
          static_cast<std::uint8_t>(object.index.value() >> 8U),
          object.sub.value(),
          size,
          0,
          0,
          0};
}

/// The aborts of a server without block transfer: 0504 0001h, and what is tolerated in its place.
bool refuses_block_transfer(const std::array<std::uint8_t, 8>& answer) {
  if (answer[0] != 0x80) return false;
  const auto code = load_le(ByteView(answer).subspan(4));
  return code == 0x0504'0001 || code == 0x0800'0000 || code == 0x0601'0000;
}

std::string refusal_words(const std::array<std::uint8_t, 8>& answer, Multiplexer object) {
  const AbortCode code(static_cast<std::uint32_t>(load_le(ByteView(answer).subspan(4))));
  return "abort " + canopen::describe(code) + " when tried with " + to_string(object);
}
}  // namespace

const steps::Value* RunSession::find(std::string_view name) const {
  const auto found = names_.find(name);
  if (found != names_.end()) return &found->second;
  if (!name.starts_with("profile.")) return nullptr;
  if (const auto told = profile_.told(name.substr(8)))
    return &profile_names_.insert_or_assign(std::string(name), steps::Value::of_number(*told)).first->second;
  const auto time = profile_.duration(name.substr(8));
  if (!time) return nullptr;
  return &profile_names_.insert_or_assign(std::string(name), steps::Value::of_duration(*time)).first->second;
}

std::optional<std::uint32_t> RunSession::bus_bit_rate() const {
  const auto rate = recorder_.transport().info().bit_rate;
  return rate > 0 ? std::optional(static_cast<std::uint32_t>(rate)) : std::nullopt;
}

bool RunSession::bus_bit_rate_is_told() const {
  const auto rate = bus_bit_rate();
  return rate && std::ranges::find(profile_.device_info.bit_rates, *rate / 1000) !=
                     profile_.device_info.bit_rates.end();
}

Result<steps::Value> RunSession::current() {
  if (object_ == nullptr) return fail_scenario("'current' needs a step about an entry");
  const auto object = object_->resolve(*this);
  if (!object) return std::unexpected(object.error());
  return read(*object);
}

Result<steps::Value> RunSession::read(Multiplexer object) {
  auto answer = peek(object);
  if (!answer) return std::unexpected(answer.error());
  if (answer->kind == steps::SdoAnswer::Kind::confirmed) return steps::Value::of_bytes(answer->data);
  return fail_scenario("the value of " + to_string(object) + " cannot be read: " + answer->refusal());
}

Result<steps::Value> RunSession::declared(Multiplexer object, steps::Declared what) {
  const auto* found = entry(object);
  static const device::Entry nothing;
  const auto& known = found != nullptr ? *found : nothing;
  if (what == steps::Declared::wired_input && known.wired_input)
    return steps::Value::of_object(*known.wired_input);
  if (what == steps::Declared::wired_input)
    return fail_scenario("the profile does not say what " + to_string(object) + " is wired to");
  const auto& bytes = what == steps::Declared::low_limit    ? known.low
                      : what == steps::Declared::high_limit ? known.high
                                                            : known.default_value;
  const bool is_limit = what == steps::Declared::low_limit || what == steps::Declared::high_limit;
  // Where a description names one limit alone, the other one is the end of the type.
  if (!bytes && is_limit && (known.low || known.high)) {
    if (const auto end = canopen::end_of_range(known.type, what == steps::Declared::high_limit)) {
      auto value = steps::Value::of_bytes(to_le(*end, *known.size()));
      value.number = end;
      return value;
    }
  }
  if (!bytes && what == steps::Declared::default_value && object.index == Index(0x1018)) {
    const auto& identity = profile_.identity;
    const std::optional<std::uint32_t> wanted[] = {identity.vendor, identity.product, identity.revision,
                                                   identity.serial};
    const auto sub = object.sub.value();
    if (sub >= 1 && sub <= 4 && wanted[sub - 1]) return steps::Value::of_bytes(to_le(*wanted[sub - 1], 4));
  }
  if (!bytes) return fail_scenario("the description of " + to_string(object) + " does not say it");
  auto value = steps::Value::of_bytes(*bytes);
  if (value.number && canopen::is_signed(known.type) && bytes->size() < 8 && (bytes->back() & 0x80U) != 0) {
    *value.number |= ~std::uint64_t{0} << (8 * bytes->size());
  }
  return value;
}

Result<bool> RunSession::is_present(Multiplexer object, bool whole_object) {
  if (whole_object) {
    for (const auto& candidate : dictionary_.object(object.index)) {
      const auto known = present_.find(candidate.mux);
      if (known != present_.end() && known->second) return true;
    }
    object.sub = SubIndex(0);
  }
  const auto known = present_.find(object);
  if (known != present_.end()) return known->second;
  auto answer = glance(object);
  if (!answer) return std::unexpected(answer.error());
  using Kind = steps::SdoAnswer::Kind;
  // Silence is neither: to take it for absence would excuse the device from every rule about the entry.
  if (answer->kind == Kind::silence)
    return fail_scenario("no answer when " + to_string(object) + " was looked for");
  const bool present = answer->kind != Kind::aborted || (answer->code != canopen::abort::no_object &&
                                                         answer->code != canopen::abort::no_sub_index);
  note_present(object, present, present ? "" : "abort " + canopen::describe(answer->code));
  return present;
}

void RunSession::note_present(Multiplexer object, bool present, std::string why) {
  present_[object] = present;
  grounds_[{steps::Asked::presence, object}] = std::move(why);
}

void RunSession::note_defaults(std::string what_does_not) {
  holds_defaults_ = what_does_not.empty();
  grounds_[{steps::Asked::factory_defaults, Multiplexer{}}] = std::move(what_does_not);
}

std::string RunSession::grounds(steps::Asked asked, Multiplexer object) const {
  using steps::Asked;
  const auto noted = [this](Asked what, Multiplexer about) {
    const auto found = grounds_.find({what, about});
    return found == grounds_.end() ? std::string() : found->second;
  };
  const auto absent = [&] {
    const auto known = present_.find(object);
    return known != present_.end() && !known->second;
  };
  const auto access = [&] {
    const auto* found = entry(object);
    if (found == nullptr) return std::string();
    return std::string(device::to_string(found->access)) +
           (found->described ? ", " + profile_.place_of(object) : "");
  };
  switch (asked) {
    case Asked::presence: return noted(asked, object);
    case Asked::mapping: {
      const auto pdo = canopen::pdo_communication(object.index);
      return pdo ? noted(asked, {*pdo, SubIndex(0)}) : std::string();
    }
    case Asked::reading: return absent() ? noted(Asked::presence, object) : access();
    case Asked::writing: {
      if (profile_.is_untouchable(object)) return "untouchable in the profile";
      if (absent()) return noted(Asked::presence, object);
      const auto tried = noted(asked, object);
      return tried.empty() ? access() : tried;
    }
    case Asked::factory_defaults: return profile_.factory_defaults ? "" : noted(asked, Multiplexer{});
    case Asked::values_put_back:
      return left_changed_ && profile_.factory_defaults.value_or(holds_defaults_)
                 ? "the run could not put back every value, so factory defaults may not be active any more"
                 : "";
    default: return noted(asked, Multiplexer{});
  }
}

bool RunSession::is_claimed(Multiplexer object, bool whole_object) const {
  const auto claimed = [](const device::Entry& entry) {
    return entry.presence() != device::Presence::unclaimed;
  };
  if (whole_object) return std::ranges::any_of(dictionary_.object(object.index), claimed);
  const auto* found = entry(object);
  return found != nullptr && claimed(*found);
}

Result<bool> RunSession::is_readable(Multiplexer object) {
  const auto* found = entry(object);
  if (found != nullptr && !found->readable()) return false;
  return is_present(object, false);
}

Result<bool> RunSession::is_writable(Multiplexer object) {
  if (profile_.is_untouchable(object)) return false;
  auto present = is_present(object, false);
  if (!present || !*present) return present;
  const auto* found = entry(object);
  if (found != nullptr && !found->access_open) return found->writable();
  const auto probed = writable_.find(object);
  if (probed != writable_.end()) return probed->second;
  // The standard leaves rw or const open here: writing back what is there tells, and changes nothing. A
  // command is not tried.
  if (found != nullptr && found->command) return found->writable();
  if (!guard_.may_write(object)) return false;
  const auto what = "try whether " + to_string(object) + " is writable";
  if (auto allowed = guard_.needs({steps::Tier::config, what}); !allowed)
    return std::unexpected(allowed.error());
  auto value = peek(object);
  if (!value) return std::unexpected(value.error());
  const auto silent = [object] {
    return fail_scenario("no answer when " + to_string(object) + " was tried");
  };
  if (value->kind == steps::SdoAnswer::Kind::silence) return silent();
  // An entry that cannot be read, or is answered against the protocol, was not tried.
  const auto not_tried = [object](std::string_view done, const steps::SdoAnswer& came) {
    return fail_scenario("whether " + to_string(object) + " is writable cannot be tried: its value was not " +
                         std::string(done) + ": " + came.refusal());
  };
  if (value->kind != steps::SdoAnswer::Kind::confirmed) return not_tried("read", *value);
  auto answer = channel_.download(object, value->data, canopen::SdoDownload::Mode::automatic, std::nullopt);
  if (!answer) return std::unexpected(answer.error());
  if (answer->kind == steps::SdoAnswer::Kind::silence) return silent();
  const bool aborted = answer->kind == steps::SdoAnswer::Kind::aborted;
  if (!aborted && answer->kind != steps::SdoAnswer::Kind::confirmed)
    return not_tried("written back", *answer);
  const bool refused = aborted && answer->code == canopen::abort::read_only;
  if (refused)
    grounds_[{steps::Asked::writing, object}] =
        "its own value was refused: abort " + canopen::describe(answer->code);
  writable_[object] = !refused;
  if (refused) {
    if (auto* known = dictionary_.find(object)) known->access = device::Access::constant;
  }
  return !refused;
}

Result<bool> RunSession::offers_block_transfer(bool upload) {
  auto& known = upload ? offers_block_upload_ : offers_block_download_;
  if (known) return *known;
  if (!upload) {
    auto tried = try_block_download();
    if (tried) known = *tried;
    return tried;
  }
  auto answer = channel_.try_block_initiate(block_initiate(0xA0, {Index(0x1000), SubIndex(0)}, 0x14));
  if (!answer) return std::unexpected(answer.error());
  if (!*answer) return fail_scenario("no answer when a block upload was tried");
  known = !refuses_block_transfer(**answer);
  if (!*known)
    grounds_[{steps::Asked::block_upload, {}}] = refusal_words(**answer, {Index(0x1000), SubIndex(0)});
  return *known;
}

Result<bool> RunSession::has_variable_mapping(Multiplexer object) {
  constexpr std::string_view feature = "variable mapping";
  const auto pdo = canopen::pdo_communication(object.index);
  if (!pdo) return fail_scenario(to_string(object) + " is not a PDO");
  const Multiplexer count{canopen::pdo_mapping(*pdo), SubIndex(0)};
  auto& why = grounds_[{steps::Asked::mapping, {*pdo, SubIndex(0)}}];
  if (profile_.claimed(feature)) {
    // What holds for the device need not hold for each of its PDOs: one is fixed where the description lets
    // nobody write an entry that its mapping takes (7.5.2.36).
    for (const auto part : {Multiplexer{*pdo, SubIndex(1)}, count, Multiplexer{count.index, SubIndex(1)}}) {
      const auto* found = entry(part);
      if (found == nullptr || !found->described || found->access_open || found->writable()) continue;
      why = to_string(part) + " is " + grounds(steps::Asked::writing, part);
      return false;
    }
    // Nor can it be mapped anew where a part is missing: entries to write, or the COB-ID to switch it off by.
    const auto* number = entry(count);
    if (number == nullptr || !number->described) return true;
    for (const auto part : {Multiplexer{*pdo, SubIndex(1)}, Multiplexer{count.index, SubIndex(1)}}) {
      const auto* found = entry(part);
      if (found != nullptr && found->described) continue;
      const auto present = is_present(part, false);
      if (!present) return std::unexpected(present.error());
      if (*present) continue;
      why = to_string(part) + " is neither described nor there";
      return false;
    }
    return true;
  }
  if (profile_.not_claimed.contains(feature)) {
    why = "the profile says so";
    return false;
  }
  const auto known = variable_mappings_.find(*pdo);
  if (known != variable_mappings_.end()) return known->second;
  auto writable = is_writable(count);
  if (!writable) return writable;
  if (!*writable) {
    why = grounds(steps::Asked::writing, count);
    return false;
  }
  if (auto allowed = guard_.needs({steps::Tier::config, "try whether a PDO can be mapped anew"}); !allowed)
    return std::unexpected(allowed.error());
  auto fixed = why_mapping_is_fixed(*this, *pdo);
  if (!fixed) return std::unexpected(fixed.error());
  why = fixed->value_or("");
  return variable_mappings_[*pdo] = !fixed->has_value();
}

/// An entry that may be written: an access error of another one could not be told from "no block transfer".
Result<bool> RunSession::try_block_download() {
  if (auto allowed = guard_.needs({steps::Tier::config, "try a block download"}); !allowed)
    return std::unexpected(allowed.error());
  std::vector<Multiplexer> candidates{{Index(0x1017), SubIndex(0)}, {Index(0x100C), SubIndex(0)}};
  for (const auto& candidate : dictionary_.entries()) {
    const auto size = candidate.size();
    if (candidate.safe && candidate.readable() && candidate.writable() && !candidate.command && size &&
        *size <= 4)
      candidates.push_back(candidate.mux);
  }
  for (const auto object : candidates) {
    const auto* found = entry(object);
    if (found == nullptr || profile_.is_untouchable(object)) continue;
    auto present = is_present(object, false);
    if (!present) return std::unexpected(present.error());
    if (!*present) continue;
    const auto size = static_cast<std::uint8_t>(found->size().value_or(0));
    auto answer = channel_.try_block_initiate(block_initiate(0xC2, object, size));
    if (!answer) return std::unexpected(answer.error());
    if (!*answer) return fail_scenario("no answer when a block download was tried");
    const auto& data = **answer;
    const AbortCode code(static_cast<std::uint32_t>(load_le(ByteView(data).subspan(4))));
    if (data[0] == 0x80 && code == canopen::abort::read_only) continue;
    const bool refused = refuses_block_transfer(data);
    if (refused) grounds_[{steps::Asked::block_download, {}}] = refusal_words(data, object);
    return !refused;
  }
  grounds_[{steps::Asked::block_download, {}}] =
      "there is nothing to try it with: 1017h and 100Ch cannot be written, and no other number is in safe_objects";
  return false;
}

/// A node that is there shows within some seconds: by its heartbeat, its PDOs, or because somebody talks to
/// it.
Result<std::string> RunSession::others_heard() {
  constexpr auto listened = std::chrono::seconds(5);
  const auto& frames = capture().frames();
  if (!frames.empty() && now() - frames.front().time < listened) {
    if (auto waited = wait_until(frames.front().time + listened); !waited)
      return std::unexpected(waited.error());
  }
  return others_.heard(capture()).value_or("");
}

std::string RunSession::access_of(Multiplexer object) const {
  const auto* found = entry(object);
  return found == nullptr ? "" : std::string(device::to_string(found->access));
}

bool RunSession::may_change(Multiplexer object) const {
  // The history is the device's to write, whether its fields are described or not.
  if (object.index == Index(0x1003)) return true;
  const auto* found = entry(object);
  return found != nullptr && found->may_change;
}

bool RunSession::is_integer(Multiplexer object) const {
  const auto* found = entry(object);
  return found != nullptr && canopen::is_integer(found->type);
}

std::optional<bool> RunSession::is_placeholder(Index type) const {
  const auto said = profile_.placeholders.find(type);
  if (said == profile_.placeholders.end()) return std::nullopt;
  return said->second;
}

bool RunSession::claims(std::string_view feature) const { return profile_.claimed(feature); }

Result<std::vector<device::ErrorTrigger>> RunSession::error_triggers() {
  const auto consumes = is_writable({Index(0x1016), SubIndex(1)});
  if (!consumes) return std::unexpected(consumes.error());
  std::vector<device::ErrorTrigger> out;
  for (const auto& trigger : profile_.errors) {
    if (trigger.raise || (*consumes && may_play_nodes())) out.push_back(trigger);
  }
  return out;
}

}  // namespace conform::engine
