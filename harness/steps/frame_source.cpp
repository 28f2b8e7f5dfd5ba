// SPDX-License-Identifier: Apache-2.0
#include "steps/frame_source.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"

namespace conform::steps {
namespace {

constexpr std::string_view this_moment = "now";

void parse_label(const yaml::Field& field, const ParseContext& context, std::string& label) {
  auto name = field.text().value_or("");
  if (name.starts_with('$')) name.erase(0, 1);
  if (std::ranges::find(context.names, name) == context.names.end()) {
    field.error("unknown label '" + name + "'", "labels come from as:");
  }
  label = name;
}

}  // namespace

std::string relative(BusTime time, const Window& window) {
  return to_string(std::chrono::round<std::chrono::microseconds>(time - window.anchor));
}

std::string can_id_words(const Expression& id, Session& session) {
  const auto number = id.number(session);
  return "CAN-ID " + (number ? to_string(CanId(static_cast<std::uint32_t>(*number))) : id.text());
}

std::vector<ObjectReference> entry_named(std::string_view text) {
  auto object = ObjectReference::parse(text);
  return object ? std::vector{std::move(*object)} : std::vector<ObjectReference>{};
}

std::optional<Source> Source::parse(const yaml::Field& field, const NameCheck& names) {
  Source out;
  const auto text = field.text();
  if (!text) return std::nullopt;
  for (const std::string_view word :
       {"heartbeat", "error control", "emcy", "emcy error", "sdo", "sync", "tpdo 1", "boot-up", "anything"}) {
    if (*text == word) {
      out.service = *text;
      return out;
    }
  }
  auto expression = parse_expression_at(field, names);
  if (!expression) return std::nullopt;
  out.id = *expression;
  return out;
}

Channels Source::rests_on() const {
  if (shows_state()) return {channel::heartbeat};
  if (service == "emcy") return {channel::emcy};
  if (service == "boot-up") return {channel::boot_up};
  return {};
}

std::vector<ObjectReference> Source::concerns() const {
  const std::string_view entry = shows_state()         ? "1017h:00"
                                 : is_emcy()           ? "1014h:00"
                                 : service == "sync"   ? "1005h:00"
                                 : service == "tpdo 1" ? "1800h:01"
                                                       : "";
  return entry_named(entry);
}

Result<Session::Match> Source::match(Session& session) const {
  const auto set = canopen::connection_set(session.node());
  if (service == "anything") {
    return
        [](const can::CapturedFrame& c) { return c.direction == can::Direction::received && !c.frame.error; };
  }
  CanId can_id{};
  if (shows_state() || service == "boot-up") {
    can_id = set.error_control;
  } else if (service == "sdo") {
    can_id = set.sdo_response;
  } else if (service == "sync") {
    can_id = canopen::sync_can_id;
  } else if (service == "tpdo 1") {
    can_id = set.tpdo[0];
  } else if (service == "emcy" || service == "emcy error") {
    can_id = session.emcy_can_id();
  } else {
    const auto number = id.number(session);
    if (!number) return std::unexpected(number.error());
    if (*number > 0x7FFU) {
      return [wanted = *number](const can::CapturedFrame& c) {
        return c.direction == can::Direction::received && c.frame.extended && !c.frame.remote &&
               !c.frame.error && c.frame.id == wanted;
      };
    }
    can_id = CanId(static_cast<std::uint32_t>(*number));
  }
  // Not the end of one: EMCY 0000h.
  if (service == "emcy error") {
    return [can_id](const can::CapturedFrame& c) {
      if (c.direction != can::Direction::received || !c.frame.is_data(can_id)) return false;
      return c.frame.size() < 2 || c.frame.data[0] != 0 || c.frame.data[1] != 0;
    };
  }
  const bool no_boot_up = shows_state(), only_boot_up = service == "boot-up";
  return [can_id, no_boot_up, only_boot_up](const can::CapturedFrame& c) {
    if (c.direction != can::Direction::received || !c.frame.is_data(can_id)) return false;
    const bool boot_up = c.frame.size() > 0 && c.frame.data[0] == 0;
    return only_boot_up ? boot_up : !no_boot_up || !boot_up;
  };
}

namespace {

std::uint64_t number_of(std::string_view name, const Session& session, std::uint64_t otherwise) {
  const auto* value = session.find(name);
  return value != nullptr && value->number ? static_cast<std::uint64_t>(*value->number) : otherwise;
}

}  // namespace

Duration Source::stretched(Duration time, const Session& session) const {
  if (!is_error_control()) return time;
  return time * static_cast<Duration::rep>(number_of(error_control_stretch, session, 1));
}

std::optional<Duration> Source::nominal_period(const Session& session) const {
  const auto known = is_error_control() ? number_of(error_control_period, session, 0) : 0;
  return known > 0 ? std::optional(Duration(static_cast<Duration::rep>(known))) : std::nullopt;
}

std::uint8_t Source::state_bits(const Session& session) const {
  // A heartbeat is one byte with bit 7 = 0; only in the reply to a guard request that is another one's bit.
  if (!is_error_control()) return 0xFF;
  return static_cast<std::uint8_t>(number_of(error_control_mask, session, 0xFF));
}

Result<Window> window_of(Session& session, const std::string& after) {
  return after.empty() ? Result<Window>(session.window()) : session.window_after(after);
}

Result<Window> settled_window_of(Session& session, const std::string& after) {
  if (!after.empty()) return session.window_after(after);
  if (auto reached = session.await_state(); !reached) return std::unexpected(reached.error());
  return session.window();
}

std::optional<WindowEnd> WindowEnd::parse(yaml::Fields& fields, const ParseContext& context) {
  const auto field = fields.exactly_one_of({"for", "until"});
  if (!field) return std::nullopt;
  WindowEnd out;
  if (!fields.has("until")) {
    if (auto parsed = parse_time_at(field)) out.time = *parsed;
  } else if (field.text() == this_moment) {
    out.until = this_moment;
  } else {
    parse_label(field, context, out.until);
  }
  return out;
}

Result<BusTime> WindowEnd::after(BusTime anchor, const Session& session) const {
  if (until.empty()) return anchor + time.resolve(session.profile());
  if (until == this_moment) return session.now();
  const auto end = session.window_after(until);
  if (!end) return std::unexpected(end.error());
  return end->anchor;
}

Result<BusTime> WindowEnd::after(BusTime anchor, const Session& session, const Source& source) const {
  if (until.empty()) return anchor + source.stretched(time.resolve(session.profile()), session);
  return after(anchor, session);
}

void parse_after(yaml::Fields& fields, const ParseContext& context, std::string& after) {
  if (const auto field = fields.optional("after")) parse_label(field, context, after);
}

}  // namespace conform::steps
