// SPDX-License-Identifier: Apache-2.0
// Verbs about frames as such: send one, wait for one, insist on none.
#include <algorithm>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/nmt.hpp"
#include "steps/frame_source.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

std::string frame_words(const can::CapturedFrame& captured) {
  const auto& frame = captured.frame;
  return to_string(CanId(frame.id)) + (frame.remote ? " RTR" : ": " + hex_bytes(frame.bytes()));
}

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
    if (const auto dlc = fields.optional("dlc"); dlc && dlc.node()->text().starts_with('$')) {
      if (auto expression = parse_expression_at(dlc, context.names)) out->named_dlc_ = *expression;
    } else if (dlc) {
      out->dlc_ = dlc.number(0, 15);
    }
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
    // What a device has in a COB-ID must not make the frame an NMT command; a scenario that means one writes
    // 000h.
    if (*id == 0 && !id_.names().empty())
      return fail_scenario("'" + id_.text() + "' is 000h, the CAN-ID of NMT");
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
    if (!named_dlc_.empty()) {
      const auto dlc = named_dlc_.number(session);
      if (!dlc) return std::unexpected(dlc.error());
      if (*dlc > 15) return fail_scenario("'" + named_dlc_.text() + "' is no DLC, which is 0 to 15");
      frame.dlc = static_cast<std::uint8_t>(*dlc);
    }
    if (!remote_ && !extended_ && frame.id == 0 && frame.size() >= 2 &&
        frame.data[1] != session.node().value()) {
      return fail_scenario("an NMT command that is not for the device under test",
                           "use nmt:; other nodes may be on the bus");
    }
    return frame;
  }

  Expression id_, named_data_, named_dlc_;
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
  std::string words(Session& session) const override {
    return "a frame of " + source_.words(session) + " within " + within_.text();
  }
  std::string success_words() const override { return "a frame"; }
  Result<Actual> run(Session& session) const override {
    const auto window = window_of(session, after_);
    if (!window) return std::unexpected(window.error());
    auto match = source_.match(session);
    if (!match) return std::unexpected(match.error());
    auto most = source_.stretched(within_.most.resolve(session.profile()), session);
    if (after_.empty()) most += session.time_to_follow();
    // What an error brings on another CAN-ID is due as late as the EMCY itself.
    if (const auto* delay = session.find("trigger_delay"); delay != nullptr && delay->duration)
      most += *delay->duration;
    if (source_.is_emcy()) most = std::max<Duration>(most, session.emcy_held_until() - window->anchor);
    auto found = session.find_frame(window->first, *match, window->anchor + most);
    if (!found) return std::unexpected(found.error());
    Actual out;
    out.listened = {window->anchor, window->anchor + most};
    if (!*found) {
      out.kind = Actual::Kind::silence;
      out.detail = "no frame of " + source_.words(session) + " within " + to_string(most);
      return out;
    }
    const auto captured = session.capture().frames()[**found];
    session.consume(**found);
    out.decisive = *found;
    out.listened->until = captured.time;
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
  std::string words(Session& session) const override {
    std::vector<std::string> parts;
    for (const auto& source : sources_) parts.push_back(source.words(session));
    return "silence of " + join(parts, ", ") + " " + end_.words();
  }
  std::string success_words() const override { return "silence"; }
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
    out.listened = {begin, *until};
    if (*found) {
      const auto& captured = session.capture().frames()[**found];
      out.kind = Actual::Kind::mismatched;
      out.decisive = *found;
      out.listened->until = captured.time;
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

constexpr Verb table[] = {
    {"send", "Send one frame, legal or not.",
     "id: CAN-ID\ndata: bytes, or $name of saved ones or of a number of one byte\nrtr: true for a remote frame\next: true for 29 bits\ndlc: if not the number of bytes; a number or $name",
     "- send: {id: 80h, data: \"\"}", &Send::parse},
    {"frame", "Wait for a frame of the device.",
     "id: CAN-ID, or heartbeat, emcy, emcy error (any but 0000h), sync, tpdo 1\nwithin: 200 ms, or 190 ms..340 ms\nafter: label to count from\nsave: name that the data get",
     "- frame: {id: 6A0h, within: 2 s}\n  checks: OD-1014-07", &AwaitFrame::parse},
    {"silence", "No frame may come.",
     "of: CAN-ID or service, or a list of them\nfor: how long; with after: longer where the steps in between took longer\n"
     "until: instead of for, a label that was reached, or now\nafter: label to count from\ndelay: what comes within this time is not held against the device",
     "- silence: {of: [emcy, 6A0h], for: 1 s}\n  checks: OD-1014-08", &Silence::parse},
};

}  // namespace

std::span<const Verb> frame_verbs() { return table; }

}  // namespace conform::steps
