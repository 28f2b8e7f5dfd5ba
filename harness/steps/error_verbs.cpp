// SPDX-License-Identifier: Apache-2.0
// Verbs about errors: raise and clear them by the triggers of the device profile, wait for EMCY, fill the
// history.
#include <chrono>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/emcy.hpp"
#include "canopen/nmt.hpp"
#include "steps/frame_source.hpp"
#include "steps/sdo_access.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

using namespace std::chrono_literals;

/// Time-out of the heartbeat trigger: long enough not to be met by accident, short enough not to bore.
constexpr Duration heartbeat_time = 100ms;

constexpr Multiplexer consumer_entry{Index(0x1016), SubIndex(1)};
constexpr Multiplexer error_behaviour{Index(0x1029), SubIndex(1)};

/// Whose heartbeat stays away: a node that is supposed not to be on the bus.
NodeId missed_node(const Session& session, const device::ErrorTrigger& trigger) {
  const NodeId usual(0x7E), other(0x7D);
  return trigger.heartbeat_node.value_or(session.node() == usual ? other : usual);
}

/// A device that stops at a communication error (1029h:01 = 2) could not be asked about it any more: it is
/// told to stay as it is, where it lets itself be told.
Result<void> keep_from_stopping(Session& session) {
  constexpr std::uint64_t stops = 2;
  constexpr std::uint8_t no_change = 1;
  auto present = session.is_present(error_behaviour, false);
  if (!present) return std::unexpected(present.error());
  if (!*present) return {};
  const auto reaction = session.read(error_behaviour);
  if (!reaction || reaction->number != stops) return {};
  if (auto told = write(session, error_behaviour, no_change, 1); !told) return std::unexpected(told.error());
  return {};
}

/// 1001h; nothing where it cannot be read.
std::optional<std::uint64_t> error_register(Session& session) {
  const auto read = session.read({Index(0x1001), SubIndex(0)});
  return read ? read->number : std::nullopt;
}

/// Raises the error of a trigger. With the heartbeat trigger the error comes when the heartbeat has stayed
/// away.
/// `delay`: how long after raising began the effect may be due, beside the caller's own time: a slow server
/// takes seconds for the writes.
Result<Actual> raise(Session& session, const device::ErrorTrigger& trigger, Duration& delay) {
  const auto start = session.now();
  session.error_changed(trigger.code, true);
  if (trigger.raise) {
    auto written = write(session, trigger.raise->object, trigger.raise->bytes);
    delay = session.now() - start;
    return written;
  }
  const auto node = missed_node(session, trigger);
  if (auto kept = keep_from_stopping(session); !kept) return std::unexpected(kept.error());
  const auto monitor = [&](Duration time) {
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(time).count();
    const auto value = (std::uint32_t{node.value()} << 16U) | static_cast<std::uint16_t>(ms);
    return write(session, consumer_entry, value, 4);
  };
  const auto begin = session.now();
  auto time = heartbeat_time;
  auto set = monitor(time);
  // While clear() is looking at the old value and writing the new one, the error must not come back: a server
  // that takes its time needs a longer one.
  const auto taken = session.now() - begin;
  if (is_confirmed(set) && taken > heartbeat_time / 4) {
    time += 2 * taken;
    set = monitor(time);
  }
  delay = session.now() - start + 2 * time;
  if (!is_confirmed(set)) return set;
  auto sent = session.play_heartbeat(node, canopen::NmtState::operational);
  if (!sent) return std::unexpected(sent.error());
  // What comes next may count on the usual time.
  if (time > heartbeat_time) {
    auto waited = session.wait_until(session.now() + time - heartbeat_time);
    if (!waited) return std::unexpected(waited.error());
  }
  return set;
}

Result<Actual> clear(Session& session, const device::ErrorTrigger& trigger) {
  session.error_changed(trigger.code, false);
  if (trigger.clear) return write(session, trigger.clear->object, trigger.clear->bytes);
  const auto node = missed_node(session, trigger);
  auto sent = session.play_heartbeat(node, canopen::NmtState::operational);
  if (!sent) return std::unexpected(sent.error());
  // The heartbeat is back; give the device its loop time to notice, then switch the consumer off again.
  auto waited = session.wait_until(session.now() + 20ms);
  if (!waited) return std::unexpected(waited.error());
  return write(session, consumer_entry, 0, 4);
}

class RaiseError final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    return parse_as(value, context, false);
  }
  static std::unique_ptr<Action> parse_clear(const yaml::Field& value, ParseContext& context) {
    return parse_as(value, context, true);
  }
  static std::unique_ptr<Action> parse_as(const yaml::Field& value, ParseContext& context, bool clear) {
    auto out = std::make_unique<RaiseError>();
    out->clear_ = clear;
    const auto read_number = [&](const yaml::Field& field) {
      const auto expression = parse_expression_at(field, context.names);
      if (!expression) return;
      if (const auto fixed = parse_number(expression->text()); fixed && (*fixed < 1 || *fixed > 16)) {
        field.error("error triggers are numbered from 1 to 16");
        return;
      }
      out->number_ = *expression;
    };
    if (!value.node()->is_mapping()) {
      read_number(value);
    } else {
      auto fields = value.fields(clear ? "clear_error" : "raise_error");
      if (const auto trigger = fields.required("trigger")) read_number(trigger);
      if (const auto save = fields.optional("save"); save && !clear) {
        out->save_ = save.text().value_or("");
        context.know(out->save_);
      }
    }
    return out->number_.empty() ? nullptr : std::move(out);
  }

  Channels rests_on() const override { return {channel::emcy}; }
  std::string words(Session& session) const override {
    const auto number = number_.number(session);
    std::string name = "error trigger " + (number ? std::to_string(*number) : number_.text());
    if (number && *number >= 1 && *number <= session.profile().errors.size())
      name += " (" + session.profile().errors[*number - 1].name + ")";
    return (clear_ ? "clear " : "raise ") + name;
  }
  Result<Actual> run(Session& session) const override {
    const auto triggers = session.error_triggers();
    if (!triggers) return std::unexpected(triggers.error());
    const auto number = number_.number(session);
    if (!number) return std::unexpected(number.error());
    if (*number < 1 || *number > triggers->size()) {
      return fail_scenario("error trigger " + std::to_string(*number) + " is not known",
                           "name one under errors: in the device profile");
    }
    const auto& trigger = (*triggers)[*number - 1];
    if (auto ready = take_note(session, *number); !ready) return std::unexpected(ready.error());
    Duration delay{};
    auto out = clear_ ? clear(session, trigger) : raise(session, trigger, delay);
    if (out && !clear_) {
      if (!save_.empty()) session.set(save_, Value::of_number(trigger.code));
      session.set("trigger_delay", Value::of_duration(delay));
    }
    return out;
  }

 private:
  /// An error that was cleared and is still there is not raised again by its trigger: what does not come then
  /// shows nothing.
  Result<void> take_note(Session& session, std::uint64_t number) const {
    const auto name = "error trigger " + std::to_string(number);
    const auto before = name + ", register before", cleared = name + ", cleared";
    if (clear_) {
      session.set(cleared, Value::of_number(1));
      return {};
    }
    const auto now = error_register(session);
    const auto* was = session.find(before);
    if (was == nullptr) {
      if (now) session.set(before, Value::of_number(*now));
      return {};
    }
    if (session.find(cleared) == nullptr || !now || !was->number || (*now & ~*was->number) == 0) return {};
    return fail_scenario("the error of trigger " + std::to_string(number) + " did not clear: 1001h is " +
                         hex(*now, 2) + ", and was " + hex(*was->number, 2) + " before it was raised");
  }

  Expression number_;
  bool clear_ = false;
  std::string save_;
};

/// Makes storing and restoring (1010h, 1011h) fail, or work again, by the writes of the profile.
class SwitchStoreFault final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext&) {
    const auto armed = value.one_of<bool>({{"arm", true}, {"disarm", false}});
    if (!armed) return nullptr;
    auto out = std::make_unique<SwitchStoreFault>();
    out->arm_ = *armed;
    return out;
  }
  std::string words(Session&) const override { return arm_ ? "make storing fail" : "let storing work again"; }
  Result<Actual> run(Session& session) const override {
    const auto& fault = session.profile().store_fault;
    if (!fault) return fail_scenario("no way to make storing fail is known", "when: store fault is known");
    const auto& change = arm_ ? fault->arm : fault->disarm;
    return write(session, change.object, change.bytes);
  }

 private:
  bool arm_ = false;
};

class AwaitEmcy final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<AwaitEmcy>();
    auto fields = value.fields("emcy");
    if (const auto code = fields.optional("code")) {
      out->errors_only_ = code.node()->is_scalar() && code.text() == "error";
      if (out->errors_only_) {
        // Whatever its code, but not the end of an error (0000h).
      } else if (auto expression = parse_expression_at(code, context.names))
        out->code_ = *expression;
    }
    if (const auto within = fields.optional("within")) {
      if (auto time = parse_time_at(within)) out->within_ = *time;
    } else {
      out->within_.fixed = 1s;
    }
    if (const auto after = fields.optional("after")) {
      out->after_ = after.text().value_or("");
      if (out->after_.starts_with('$')) out->after_.erase(0, 1);
      if (std::ranges::find(context.names, out->after_) == context.names.end()) {
        after.error("unknown label '" + out->after_ + "'", "labels come from as:");
      }
    }
    const auto save = [&](const char* key, std::string& name) {
      if (const auto field = fields.optional(key)) {
        name = field.text().value_or("");
        context.know(name);
      }
    };
    save("save_code", out->save_code_);
    save("save_register", out->save_register_);
    return out;
  }
  Measures measures() const override { return {"register"}; }
  std::vector<ObjectReference> concerns() const override { return entry_named("1014h:00"); }
  bool acts() const override { return false; }
  Channels rests_on() const override { return {channel::emcy}; }
  std::string words(Session& session) const override {
    std::string out = errors_only_ ? "EMCY of an error" : "EMCY";
    if (!code_.empty()) {
      const auto code = code_.number(session);
      out += " " + (code ? canopen::describe_emcy_code(static_cast<std::uint16_t>(*code)) : code_.text());
    }
    return out + " within " + within_.text();
  }

  Result<Actual> run(Session& session) const override {
    auto window = after_.empty() ? Result<Window>(session.window()) : session.window_after(after_);
    if (!window) return std::unexpected(window.error());
    std::optional<std::uint64_t> wanted;
    if (!code_.empty()) {
      auto code = code_.number(session);
      if (!code) return std::unexpected(code.error());
      wanted = *code;
    }
    auto within = within_.resolve(session.profile());
    if (const auto* delay = session.find("trigger_delay"); delay != nullptr && delay->duration)
      within += *delay->duration;
    if (after_.empty()) within += session.time_to_follow();
    within = std::max<Duration>(within, session.emcy_held_until() - window->anchor);
    const auto id = session.emcy_can_id();
    auto found = session.find_frame(
        window->first,
        [id, any = !errors_only_ && wanted.value_or(0) == 0](const auto& captured) {
          if (captured.direction != can::Direction::received || !captured.frame.is_data(id)) return false;
          // Where an error is waited for, the end of another one (0000h) is none.
          const auto emcy = canopen::decode_emcy(captured.frame.bytes());
          return any || !emcy || emcy->code != 0;
        },
        window->anchor + within);
    if (!found) return std::unexpected(found.error());
    Actual out;
    if (!*found) {
      out.kind = Actual::Kind::silence;
      out.detail = "no EMCY on " + to_string(id) + " within " + to_string(within);
      return out;
    }
    session.consume(**found);
    const auto& captured = session.capture().frames()[**found];
    out.decisive = *found;
    out.data.assign(captured.frame.bytes().begin(), captured.frame.bytes().end());
    const auto emcy = canopen::decode_emcy(captured.frame.bytes());
    if (!emcy) {
      out.kind = Actual::Kind::mismatched;
      out.detail =
          "an EMCY of " + std::to_string(out.data.size()) + " bytes instead of eight: " + hex_bytes(out.data);
      return out;
    }
    out.detail = "EMCY " + canopen::describe_emcy_code(emcy->code) + ", error register " +
                 hex(emcy->error_register, 2);
    out.measured["register"] = emcy->error_register;
    if (wanted && *wanted != emcy->code) {
      out.kind = Actual::Kind::mismatched;
      return out;
    }
    if (!save_code_.empty()) session.set(save_code_, Value::of_number(emcy->code));
    if (!save_register_.empty()) session.set(save_register_, Value::of_number(emcy->error_register));
    return out;
  }

 private:
  Expression code_;
  bool errors_only_ = false;
  TimeReference within_;
  std::string after_, save_code_, save_register_;
};

/// Raises the known errors in turn until the number of errors in the history stays where it is: that is its
/// depth.
class FillHistory final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<FillHistory>();
    auto fields = value.fields("fill_history");
    const auto name = [&](const char* key, std::string& to) {
      const auto field = fields.required(key);
      to = field.text().value_or("");
      if (!to.empty()) context.know(to);
    };
    name("save_depth", out->depth_);
    name("save_newest", out->newest_);
    name("save_previous", out->previous_);
    return out;
  }
  std::string words(Session&) const override {
    return "raise errors until the history is full, and one more";
  }

  Result<Actual> run(Session& session) const override {
    const auto triggers = session.error_triggers();
    if (!triggers) return std::unexpected(triggers.error());
    if (triggers->size() < 2)
      return fail_scenario("two error triggers are needed", "when: 2 error triggers are known");
    constexpr int most = 254 + 1;  // 1003h holds at most 254 errors (7.5.2.4)
    std::uint64_t count = 0;
    std::uint16_t newest = 0;
    const auto before = error_register(session);
    for (int i = 0; i < most; ++i) {
      const auto& trigger = (*triggers)[static_cast<std::size_t>(i) % triggers->size()];
      Duration delay{};
      for (const bool raising : {true, false}) {
        auto done = raising ? raise(session, trigger, delay) : clear(session, trigger);
        if (!is_confirmed(done)) return done;
        auto waited = session.wait_until(session.now() + delay + 5ms);
        if (!waited) return std::unexpected(waited.error());
      }
      const auto answer = read(session, {Index(0x1003), SubIndex(0)});
      if (!answer) return std::unexpected(answer.error());
      Actual out;
      out.decisive = answer->decisive;
      if (!is_confirmed(answer) || answer->data.size() != 1) {
        out.kind = Actual::Kind::mismatched;
        out.detail = "1003h:00 could not be read while the history was being filled";
        return out;
      }
      if (answer->data[0] <= count) {
        const auto now = error_register(session);
        if (before && now && (*now & ~*before) != 0)
          return fail_scenario("errors do not clear: 1001h is " + hex(*now, 2) + ", and was " +
                               hex(*before, 2) + " before they were raised");
        session.set(depth_, Value::of_number(count));
        session.set(newest_, Value::of_number(trigger.code));
        session.set(previous_, Value::of_number(newest));
        out.detail = "full at " + std::to_string(count) + " errors";
        return out;
      }
      count = answer->data[0];
      newest = trigger.code;
    }
    Actual out;
    out.kind = Actual::Kind::mismatched;
    out.detail = "the number of errors still grew after " + std::to_string(most) + " errors";
    return out;
  }

 private:
  std::string depth_, newest_, previous_;
};

constexpr Verb table[] = {
    {"raise_error",
     "Raise an error by a trigger of the device profile (default: a heartbeat that stays away).",
     "trigger: number from 1, or $name\nsave: name that the EMCY error code gets",
     "- raise_error: {trigger: 1, save: code}", &RaiseError::parse},
    {"clear_error", "Remove the cause of an error.", "trigger: number from 1, or $name", "- clear_error: 1",
     &RaiseError::parse_clear},
    {"store_fault",
     "Make storing and restoring (1010h, 1011h) fail by store_fault of the device profile, or work again.",
     "(word): arm, disarm", "- store_fault: arm", &SwitchStoreFault::parse},
    {"emcy", "Wait for an EMCY.",
     "code: error code, error (any but 0000h), any when absent\nwithin: time (default 1 s, plus the delay of the trigger)\nafter: label to count from\n"
     "save_code, save_register: names that code and error register get\nmeasured: register",
     "- emcy: {code: $code, within: 1 s}\n  checks: EMCY-FMT-01", &AwaitEmcy::parse},
    {"fill_history", "Raise errors in turn until 1003h is full, and one more.",
     "save_depth: name that the depth gets\nsave_newest, save_previous: names that the last two error codes get",
     "- fill_history: {save_depth: depth, save_newest: newest, save_previous: previous}",
     &FillHistory::parse},
};

}  // namespace

std::span<const Verb> error_verbs() { return table; }

}  // namespace conform::steps
