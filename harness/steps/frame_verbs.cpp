// SPDX-License-Identifier: Apache-2.0
// Verbs about frames as such: send one, wait for one, insist on none, count many.
#include <algorithm>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/nmt.hpp"
#include "steps/contents.hpp"
#include "steps/timing.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

std::string relative(BusTime time, const Window& window) {
  return to_string(std::chrono::round<std::chrono::microseconds>(time - window.anchor));
}

std::string frame_words(const can::CapturedFrame& captured) {
  const auto& frame = captured.frame;
  return to_string(CanId(frame.id)) + (frame.remote ? " RTR" : ": " + hex_bytes(frame.bytes()));
}

/// The frames a verb is about: a CAN-ID, or a service of the device under test.
struct Source {
  Expression id;
  std::string service;

  static std::optional<Source> parse(const yaml::Field& field, const NameCheck& names) {
    Source out;
    const auto text = field.text();
    if (!text) return std::nullopt;
    for (const std::string_view word :
         {"heartbeat", "emcy", "emcy error", "sdo", "sync", "tpdo 1", "boot-up", "anything"}) {
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

  /// Channels that a frame of the source comes through; that none comes is no ground for anything.
  [[nodiscard]] Channels rests_on() const {
    if (service == "heartbeat") return {channel::heartbeat};
    if (service == "emcy") return {channel::emcy};
    if (service == "boot-up") return {channel::boot_up};
    return {};
  }
  [[nodiscard]] std::string words() const { return service.empty() ? "CAN-ID " + id.text() : service; }

  /// The entry that configures the service.
  [[nodiscard]] std::vector<ObjectReference> concerns() const {
    const std::string_view entry = service == "heartbeat"        ? "1017h:00"
                                   : service.starts_with("emcy") ? "1014h:00"
                                   : service == "sync"           ? "1005h:00"
                                   : service == "tpdo 1"         ? "1800h:01"
                                                                 : "";
    auto object = ObjectReference::parse(entry);
    return object ? std::vector{std::move(*object)} : std::vector<ObjectReference>{};
  }

  [[nodiscard]] Result<Session::Match> match(Session& session) const {
    const auto set = canopen::connection_set(session.node());
    if (service == "anything") {
      return [](const can::CapturedFrame& c) {
        return c.direction == can::Direction::received && !c.frame.error;
      };
    }
    CanId can_id{};
    if (service == "heartbeat" || service == "boot-up") {
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
    const bool no_boot_up = service == "heartbeat", only_boot_up = service == "boot-up";
    return [can_id, no_boot_up, only_boot_up](const can::CapturedFrame& c) {
      if (c.direction != can::Direction::received || !c.frame.is_data(can_id)) return false;
      const bool boot_up = c.frame.size() > 0 && c.frame.data[0] == 0;
      return only_boot_up ? boot_up : !no_boot_up || !boot_up;
    };
  }
};

/// `within: 200 ms` or `within: 190 ms..340 ms`
struct Within {
  Duration least{};
  TimeReference most;

  static std::optional<Within> parse(const yaml::Field& field) {
    Within out;
    const auto text = field.text();
    if (!text) return std::nullopt;
    const auto dots = text->find("..");
    if (dots == std::string::npos) {
      auto time = parse_time_at(field);
      if (!time) return std::nullopt;
      out.most = *time;
      return out;
    }
    const auto low = parse_duration(trim(std::string_view(*text).substr(0, dots)));
    const auto high = parse_duration(trim(std::string_view(*text).substr(dots + 2)));
    if (!low || !high || *high < *low) {
      field.error("'" + *text + "' is not a range of times", "write 190 ms..340 ms");
      return std::nullopt;
    }
    out.least = *low;
    out.most.fixed = *high;
    return out;
  }
  [[nodiscard]] std::string text() const {
    return least.count() > 0 ? to_string(least) + ".." + most.text() : most.text();
  }
};

Result<Window> window_of(Session& session, const std::string& after) {
  return after.empty() ? Result<Window>(session.window()) : session.window_after(after);
}

/// For steps that count frames or insist on none: what the device sends before it has followed an NMT command
/// is of the old state.
Result<Window> settled_window_of(Session& session, const std::string& after) {
  if (!after.empty()) return session.window_after(after);
  if (auto reached = session.await_state(); !reached) return std::unexpected(reached.error());
  return session.window();
}

void parse_label(const yaml::Field& field, const ParseContext& context, std::string& label) {
  auto name = field.text().value_or("");
  if (name.starts_with('$')) name.erase(0, 1);
  if (std::ranges::find(context.names, name) == context.names.end()) {
    field.error("unknown label '" + name + "'", "labels come from as:");
  }
  label = name;
}

/// `for: 1 s`, or `until:` with a label that was reached, or `now`: the step itself.
struct WindowEnd {
  TimeReference time;
  std::string until;  ///< empty: `time` counts

  static constexpr std::string_view this_moment = "now";

  static std::optional<WindowEnd> parse(yaml::Fields& fields, const ParseContext& context) {
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
  [[nodiscard]] std::string words() const { return until.empty() ? "for " + time.text() : "until " + until; }
  [[nodiscard]] Result<BusTime> after(BusTime anchor, const Session& session) const {
    if (until.empty()) return anchor + time.resolve(session.profile());
    if (until == this_moment) return session.now();
    const auto end = session.window_after(until);
    if (!end) return std::unexpected(end.error());
    return end->anchor;
  }
};

void parse_after(yaml::Fields& fields, const ParseContext& context, std::string& after) {
  if (const auto field = fields.optional("after")) parse_label(field, context, after);
}

class Send final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<Send>();
    auto fields = value.fields("send");
    const auto id = fields.required("id");
    if (id) {
      if (auto expression = parse_expression_at(id, context.names)) out->id_ = *expression;
    }
    if (const auto data = fields.optional("data"); data && data.node()->text().starts_with('$')) {
      if (auto expression = parse_expression_at(data, context.names)) out->named_data_ = *expression;
    } else if (data) {
      if (auto bytes = data.bytes()) out->data_ = *bytes;
      if (out->data_.size() > 8) data.error("a CAN frame holds at most eight bytes");
    }
    out->remote_ = fields.optional("rtr").boolean().value_or(false);
    out->extended_ = fields.optional("ext").boolean().value_or(false);
    if (const auto dlc = fields.optional("dlc")) out->dlc_ = dlc.number(0, 15);
    return id && out->data_.size() <= 8 ? std::move(out) : nullptr;
  }
  Need need() const override {
    const Need unknown{Tier::config, "send anything but uploads"};
    // A node-ID that no scenario writes out: an id without N is meant for another node.
    constexpr NodeId node(99);
    struct Nothing final : Scope {
      [[nodiscard]] const Value* find(std::string_view) const override { return nullptr; }
      [[nodiscard]] NodeId node() const override { return NodeId(99); }
      [[nodiscard]] Result<Value> current() override { return fail("not known before the run"); }
      [[nodiscard]] Result<Value> read(Multiplexer) override { return fail("not known before the run"); }
    } nothing;
    const auto id = id_.number(nothing);
    if (!id || (!named_data_.empty() && (*id == 0 || *id == 0x600U + node.value()))) return unknown;
    auto frame = can::data_frame(CanId(static_cast<std::uint32_t>(*id)), data_);
    frame.remote = remote_;
    frame.extended = extended_ || *id > 0x7FF;
    if (dlc_) frame.dlc = static_cast<std::uint8_t>(*dlc_);
    // The node-ID in the data of a command is only known when it runs.
    if (frame.id == 0 && !frame.remote && !frame.extended && frame.dlc == 2) return unknown;
    return need_of(frame, node);
  }
  bool rests_on_time() const override { return false; }
  std::string words(Session& session) const override {
    const auto frame = build(session);
    return "send " + (frame ? frame_words({*frame, {}, {}, {}}) : id_.text());
  }
  Result<Actual> run(Session& session) const override {
    auto frame = build(session);
    if (!frame) return std::unexpected(frame.error());
    const auto index = session.capture().size();
    auto sent = session.send(*frame);
    if (!sent) return std::unexpected(sent.error());
    Actual out;
    out.decisive = sent_frame(session, index);
    return out;
  }

 private:
  Result<can::Frame> build(Session& session) const {
    const auto id = id_.number(session);
    if (!id) return std::unexpected(id.error());
    auto data = data_;
    if (!named_data_.empty()) {
      auto value = named_data_.evaluate(session);
      if (!value) return std::unexpected(value.error());
      // A number is one byte, as a counter is.
      if (!value->bytes && value->number && *value->number <= 0xFF)
        value->bytes = Bytes{static_cast<std::uint8_t>(*value->number)};
      if (!value->bytes || value->bytes->size() > 8)
        return fail_scenario("'" + named_data_.text() + "' is not up to eight bytes");
      data = *value->bytes;
    }
    auto frame = can::data_frame(CanId(static_cast<std::uint32_t>(*id)), data);
    frame.remote = remote_;
    frame.extended = extended_ || *id > 0x7FF;
    if (dlc_) frame.dlc = static_cast<std::uint8_t>(*dlc_);
    if (!remote_ && !extended_ && frame.id == 0 && frame.size() >= 2 &&
        frame.data[1] != session.node().value()) {
      return fail_scenario("an NMT command that is not for the device under test",
                           "use nmt:; other nodes may be on the bus");
    }
    return frame;
  }

  Expression id_, named_data_;
  Bytes data_;
  bool remote_ = false, extended_ = false;
  std::optional<std::uint64_t> dlc_;
};

class AwaitFrame final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<AwaitFrame>();
    auto fields = value.fields("frame");
    const auto id = fields.required("id");
    const auto within = fields.required("within");
    if (id) {
      if (auto source = Source::parse(id, context.names)) out->source_ = *source;
    }
    if (within) {
      if (auto parsed = Within::parse(within)) out->within_ = *parsed;
    }
    parse_after(fields, context, out->after_);
    if (const auto save = fields.optional("save")) {
      out->save_ = save.text().value_or("");
      context.know(out->save_);
    }
    return id && within ? std::move(out) : nullptr;
  }
  std::vector<ObjectReference> concerns() const override { return source_.concerns(); }
  bool acts() const override { return false; }
  Channels rests_on() const override { return source_.rests_on(); }
  std::string words(Session&) const override {
    return "a frame of " + source_.words() + " within " + within_.text();
  }
  Result<Actual> run(Session& session) const override {
    const auto window = window_of(session, after_);
    if (!window) return std::unexpected(window.error());
    auto match = source_.match(session);
    if (!match) return std::unexpected(match.error());
    auto most = within_.most.resolve(session.profile());
    if (after_.empty()) most += session.time_to_follow();
    // What an error brings on another CAN-ID is due as late as the EMCY itself.
    if (const auto* delay = session.find("trigger_delay"); delay != nullptr && delay->duration)
      most += *delay->duration;
    auto found = session.find_frame(window->first, *match, window->anchor + most);
    if (!found) return std::unexpected(found.error());
    Actual out;
    if (!*found) {
      out.kind = Actual::Kind::silence;
      out.detail = "no frame of " + source_.words() + " within " + to_string(most);
      return out;
    }
    const auto captured = session.capture().frames()[**found];
    session.consume(**found);
    out.decisive = *found;
    out.data.assign(captured.frame.bytes().begin(), captured.frame.bytes().end());
    out.has_data = true;
    if (within_.least.count() > 0 && captured.time < window->anchor + within_.least) {
      out.kind = Actual::Kind::mismatched;
      out.detail = frame_words(captured) + " too early, after " + relative(captured.time, *window);
      return out;
    }
    if (!save_.empty()) session.set(save_, Value::of_bytes(out.data));
    out.detail = frame_words(captured) + " after " + relative(captured.time, *window);
    return out;
  }

 private:
  Source source_;
  Within within_;
  std::string after_, save_;
};

class Silence final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<Silence>();
    auto fields = value.fields("silence");
    const auto of = fields.required("of");
    const auto end = WindowEnd::parse(fields, context);
    for (const auto& item : of.items_or_one()) {
      if (auto source = Source::parse(item, context.names)) out->sources_.push_back(*source);
    }
    if (end) out->end_ = *end;
    if (const auto delay = fields.optional("delay")) {
      if (auto parsed = parse_time_at(delay)) out->delay_ = *parsed;
    }
    parse_after(fields, context, out->after_);
    return of && end ? std::move(out) : nullptr;
  }
  std::vector<ObjectReference> concerns() const override {
    return sources_.empty() ? std::vector<ObjectReference>{} : sources_.front().concerns();
  }
  bool acts() const override { return false; }
  std::string words(Session&) const override {
    std::vector<std::string> parts;
    for (const auto& source : sources_) parts.push_back(source.words());
    return "silence of " + join(parts, ", ") + " " + end_.words();
  }
  Result<Actual> run(Session& session) const override {
    const auto window = settled_window_of(session, after_);
    if (!window) return std::unexpected(window.error());
    std::vector<Session::Match> matches;
    for (const auto& source : sources_) {
      auto match = source.match(session);
      if (!match) return std::unexpected(match.error());
      matches.push_back(*match);
    }
    const auto begin = window->anchor + delay_.resolve(session.profile());
    auto until = end_.after(window->anchor, session);
    if (!until) return std::unexpected(until.error());
    // Steps in between may have taken longer than the silence had to last: all of it was to be silent.
    if (!after_.empty() && end_.until.empty()) until = std::max(*until, session.now());
    auto found = session.find_frame(
        window->first,
        [&matches, begin](const auto& captured) {
          return captured.time >= begin &&
                 std::ranges::any_of(matches, [&](const auto& match) { return match(captured); });
        },
        *until);
    if (!found) return std::unexpected(found.error());
    Actual out;
    if (*found) {
      const auto& captured = session.capture().frames()[**found];
      out.kind = Actual::Kind::mismatched;
      out.decisive = *found;
      out.detail = frame_words(captured) + " after " + relative(captured.time, *window);
      session.consume(**found);
    } else {
      out.detail = "silence for " + to_string(*until - window->anchor);
    }
    return out;
  }

 private:
  std::vector<Source> sources_;
  WindowEnd end_;
  TimeReference delay_;
  std::string after_;
};

class Collect final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<Collect>();
    auto fields = value.fields("collect");
    const auto from = fields.required("from");
    const auto end = WindowEnd::parse(fields, context);
    if (from) {
      if (auto source = Source::parse(from, context.names)) out->source_ = *source;
    }
    if (end) out->end_ = *end;
    if (const auto per = fields.optional("per")) {
      if (per.text() != "sync") {
        if (auto expression = parse_expression_at(per, context.names)) out->stimulus_ = *expression;
      }
      out->answers_ = true;
    }
    if (const auto overflow = fields.optional("counter")) {
      if (auto expression = parse_expression_at(overflow, context.names)) out->overflow_ = *expression;
    }
    out->times_of_day_ = fields.optional("time_of_day").boolean().value_or(false);
    parse_after(fields, context, out->after_);
    return from && end ? std::move(out) : nullptr;
  }
  Measures measures() const override {
    Measures out{"count", "first", "state", "period", "shortest", "longest", "length"};
    if (!overflow_.empty()) out.insert(out.end(), {"start", "out_of_order"});
    if (times_of_day_) out.insert(out.end(), {"malformed", "drift"});
    if (answers_) out.insert(out.end(), {"missed", "skipped", "extra", "closest", "farthest", "latency"});
    return out;
  }
  std::vector<ObjectReference> concerns() const override { return source_.concerns(); }
  bool acts() const override { return false; }
  Channels rests_on() const override { return source_.rests_on(); }
  std::string words(Session&) const override {
    if (!answers_) return "collect " + source_.words() + " " + end_.words();
    return "collect " + source_.words() + " per " +
           (stimulus_.empty() ? "SYNC" : "frame on CAN-ID " + stimulus_.text()) + ", until " +
           end_.time.text() + " after the last";
  }

  Result<Actual> run(Session& session) const override {
    const auto window = settled_window_of(session, after_);
    if (!window) return std::unexpected(window.error());
    auto match = source_.match(session);
    if (!match) return std::unexpected(match.error());
    Session::Match sent;
    if (answers_) {
      const auto id = stimulus_id(session);
      if (!id) return std::unexpected(id.error());
      // Also what the device sends there itself: a producer of SYNC answers its own.
      sent = [id = *id](const can::CapturedFrame& c) { return c.frame.is_data(id); };
    }
    std::uint64_t overflow = 0;
    if (!overflow_.empty()) {
      const auto number = overflow_.number(session);
      if (!number) return std::unexpected(number.error());
      overflow = *number;
    }
    const auto time = end_.time.resolve(session.profile());
    const auto end = end_.after(window->anchor, session);
    if (!end) return std::unexpected(end.error());
    auto until = *end;
    std::vector<std::size_t> hits;
    std::vector<BusTime> stimuli;
    const auto& frames = session.capture().frames();
    const auto wanted = [&](const can::CapturedFrame& c) { return (*match)(c) || (sent && sent(c)); };
    for (std::size_t from = window->first;;) {
      auto found = session.find_frame(from, wanted, until);
      if (!found) return std::unexpected(found.error());
      if (!*found) break;
      from = **found + 1;
      if (!sent || !sent(frames[**found])) {
        hits.push_back(**found);
        continue;
      }
      stimuli.push_back(frames[**found].time);
      if (frames[**found].direction == can::Direction::transmitted)
        until = std::max(until, stimuli.back() + time);
    }
    if (sent && stimuli.empty()) return fail_scenario("nothing was sent that could have been answered");
    auto out = measure(session, *window, hits, stimuli, until);
    if (!hits.empty()) measure_contents(out, session, hits, overflow);
    return out;
  }

 private:
  [[nodiscard]] Result<CanId> stimulus_id(Session& session) const {
    if (!stimulus_.empty()) {
      const auto number = stimulus_.number(session);
      if (!number) return std::unexpected(number.error());
      return CanId(static_cast<std::uint32_t>(*number));
    }
    // As send_sync has found it.
    const auto* known = session.find("sync_can_id");
    if (known == nullptr || !known->number) return canopen::sync_can_id;
    return CanId(static_cast<std::uint32_t>(*known->number));
  }

  [[nodiscard]] static Actual measure(Session& session, const Window& window,
                                      const std::vector<std::size_t>& hits,
                                      const std::vector<BusTime>& stimuli, BusTime end) {
    Actual out;
    const auto& frames = session.capture().frames();
    std::vector<BusTime> times;
    for (const auto hit : hits) times.push_back(frames[hit].time);
    out.measured["count"] = hits.size();
    out.detail = std::to_string(hits.size()) + " frames";
    if (!stimuli.empty()) measure_answers(out, answers_of(stimuli, times), stimuli.size());
    if (hits.empty()) return out;
    out.decisive = hits.back();
    const auto first = times.front();
    out.measured["first"] =
        static_cast<std::uint64_t>(std::max<Duration::rep>(0, (first - window.anchor).count()));
    std::optional<std::uint8_t> state;
    bool one_state = true;
    for (const auto hit : hits) {
      const auto& frame = frames[hit].frame;
      const auto byte = frame.size() > 0 ? frame.data[0] : std::uint8_t{0xFF};
      // A heartbeat is one byte with bit 7 = 0; anything else must not pass as a state.
      const auto value = frame.dlc == 1 ? byte : std::uint8_t{0xFF};
      one_state = one_state && (!state || *state == value);
      state = value;
    }
    if (one_state) out.measured["state"] = *state;
    const auto distances = distances_of(times, end);
    out.measured["longest"] = static_cast<std::uint64_t>(distances.longest.count());
    using std::chrono::microseconds;
    const auto words = [](Duration time) { return to_string(std::chrono::round<microseconds>(time)); };
    if (hits.size() > 1) {
      out.measured["period"] = static_cast<std::uint64_t>(distances.mean.count());
      out.measured["shortest"] = static_cast<std::uint64_t>(distances.shortest.count());
      out.detail += ", period " + words(distances.mean) + " (" + words(distances.shortest) + ".." +
                    words(distances.longest) + ")";
    }
    out.detail += ", first after " + relative(first, window) + ", last " + words(end - times.back()) +
                  " before the end, " +
                  (one_state ? "first byte " + hex(*state, 2) : std::string("differing first bytes"));
    session.consume(hits.back());
    return out;
  }

  void measure_contents(Actual& out, const Session& session, const std::vector<std::size_t>& hits,
                        std::uint64_t overflow) const {
    std::vector<const can::CapturedFrame*> frames;
    for (const auto hit : hits) frames.push_back(&session.capture().frames()[hit]);
    if (const auto length = common_length(frames)) out.measured["length"] = *length;
    if (!overflow_.empty()) {
      const auto& first = frames.front()->frame;
      const auto wrong = out_of_order(frames, overflow);
      if (first.size() > 0) out.measured["start"] = first.data[0];
      out.measured["out_of_order"] = wrong;
      out.detail += ", the first counts " + (first.size() > 0 ? std::to_string(first.data[0]) : "nothing") +
                    ", " + std::to_string(wrong) + " out of order";
    }
    if (times_of_day_) {
      const auto times = times_of_day(frames);
      out.measured["malformed"] = times.malformed;
      out.measured["drift"] = static_cast<std::uint64_t>(times.drift.count());
      out.detail += ", " + std::to_string(times.malformed) + " with no time of day, which drifts by " +
                    to_string(std::chrono::round<std::chrono::microseconds>(times.drift));
    }
  }

  static void measure_answers(Actual& out, const Answers& answers, std::size_t stimuli) {
    out.measured["missed"] = answers.missed;
    out.measured["skipped"] = answers.skipped;
    out.measured["extra"] = answers.extra;
    if (answers.shortest > 0) out.measured["closest"] = answers.shortest;
    out.measured["farthest"] = answers.longest;
    out.detail += " for " + std::to_string(stimuli) + " sent, " + std::to_string(answers.missed) +
                  " unanswered, " + std::to_string(answers.extra) + " extra";
    const auto& latencies = answers.latencies;
    if (latencies.empty()) return;
    out.measured["latency"] = static_cast<std::uint64_t>(latencies.back().count());
    const auto words = [](Duration time) {
      return to_string(std::chrono::round<std::chrono::microseconds>(time));
    };
    out.detail += ", latency " + words(latencies.front()) + " to " + words(latencies.back()) + ", median " +
                  words(latencies[latencies.size() / 2]);
  }

  Source source_;
  WindowEnd end_;
  std::string after_;
  bool answers_ = false;
  Expression stimulus_;  ///< CAN-ID; empty: that of SYNC
  Expression overflow_;  ///< of the counters in the frames; empty: they have none
  bool times_of_day_ = false;
};

constexpr Verb table[] = {
    {"send", "Send one frame, legal or not.",
     "id: CAN-ID\ndata: bytes, or $name of saved ones or of a number of one byte\nrtr: true for a remote frame\next: true for 29 bits\ndlc: if not the number of bytes",
     "- send: {id: 80h, data: \"\"}", &Send::parse},
    {"frame", "Wait for a frame of the device.",
     "id: CAN-ID, or heartbeat, emcy, emcy error (any but 0000h), sync, tpdo 1\nwithin: 200 ms, or 190 ms..340 ms\nafter: label to count from\nsave: name that the data get",
     "- frame: {id: 6A0h, within: 2 s}\n  checks: OD-1014-07", &AwaitFrame::parse},
    {"silence", "No frame may come.",
     "of: CAN-ID or service, or a list of them\nfor: how long; with after: longer where the steps in between took longer\n"
     "until: instead of for, a label that was reached, or now\nafter: label to count from\ndelay: what comes within this time is not held against the device",
     "- silence: {of: [emcy, 6A0h], for: 1 s}\n  checks: OD-1014-08", &Silence::parse},
    {"collect", "Count and time frames.",
     "from: CAN-ID or service\nfor: how long; with per: how long after the last frame that was sent\n"
     "until: instead of for, a label that was reached, or now: whatever the steps before took\nper: sync or a CAN-ID: frames are "
     "answers to what was sent there, by the device itself as well\ncounter: overflow value: the frames count 1 to this and 1 again\n"
     "time_of_day: true: the frames tell the time\nafter: label to count from\nmeasured: count, period, shortest, longest (the time behind "
     "the last frame included), first, state, length (bytes of every frame); with counter: start (of the first frame), out_of_order; with "
     "time_of_day: malformed, drift; with per: missed, skipped (missed before the first answer), extra, closest and farthest (distance of "
     "two answers in frames sent), latency (the longest)",
     "- collect: {from: heartbeat, for: 1 s}\n  checks: OD-1017-05\n  expect: {count: 9..11, period: 90 ms..110 ms, state: pre-operational}\n"
     "- collect: {from: 180h + N, per: sync, for: 50 ms}\n  checks: PDO-TX-06\n  expect: {extra: 0, closest: 3.., farthest: ..3}",
     &Collect::parse},
};

}  // namespace

std::span<const Verb> frame_verbs() { return table; }

}  // namespace conform::steps
