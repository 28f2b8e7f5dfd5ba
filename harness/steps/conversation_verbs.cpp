// SPDX-License-Identifier: Apache-2.0
// The verb `talk`: plays a conversation and shows the first wrong byte where it fails.
#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "steps/conversation.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

class Talk final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<Talk>();
    out->object_ = context.branch_object;
    if (value.node()->is_mapping()) {
      auto fields = value.fields("talk");
      if (const auto object = fields.optional("object")) {
        out->object_ = parse_object_at(object, context.names);
      }
      const auto frames = fields.required("frames");
      if (!frames) return nullptr;
      out->read(frames, context);
    } else {
      out->read(value, context);
    }
    return out->lines_.empty() ? nullptr : std::move(out);
  }

  bool rests_on_time() const override {
    return std::ranges::any_of(lines_, [](const Line& line) { return line.kind == Line::Kind::silence; });
  }
  std::string words(Session&) const override {
    return lines_.size() == 1 ? "conversation: " + lines_.front().text
                              : "conversation of " + std::to_string(lines_.size()) +
                                    " lines: " + lines_.front().text + " ...";
  }
  const ObjectReference* object() const override { return object_ ? &*object_ : nullptr; }
  Channels rests_on() const override {
    const auto asks_for_the_device_type = [](const Line& line) {
      constexpr std::uint8_t multiplexer[] = {0x00, 0x10, 0x00};
      if (line.kind != Line::Kind::send || line.bytes.size() < 4) return false;
      for (std::size_t i = 0; i < std::size(multiplexer); ++i) {
        const auto& byte = line.bytes[i + 1];
        if (byte.kind != BytePattern::Kind::exact || byte.mask != 0xFF || byte.value != multiplexer[i])
          return false;
      }
      return true;
    };
    if (std::ranges::any_of(lines_, asks_for_the_device_type)) return {channel::device_type};
    return {};
  }
  bool acts() const override {
    return std::ranges::any_of(lines_, [](const Line& line) { return line.kind == Line::Kind::send; });
  }

  /// What the lines to send need, as far as they are written out.
  Need need() const override {
    Need most;
    for (const auto& line : lines_) {
      if (line.kind != Line::Kind::send) continue;
      // Without a node-ID of its own the line is meant for another node, whatever its number.
      const NodeId node(line.add_node ? 1 : 127);
      if (const auto need = need_of(outline(line, node), node); !need.covered_by(most.tier)) most = need;
    }
    return most;
  }

  Result<bool> begins(Session& session) const override {
    const auto& line = lines_.front();
    const auto object = resolve(session);
    if (!object) return std::unexpected(object.error());
    auto found = next(session, line);
    if (!found) return std::unexpected(found.error());
    if (line.kind == Line::Kind::silence) return !*found;
    return *found && compare(line, session.capture().frames()[**found].frame, session, *object).equal;
  }

  Result<Actual> run(Session& session) const override {
    const auto object = resolve(session);
    if (!object) return std::unexpected(object.error());
    auto announced = announce_downloads(session, *object);
    if (!announced) return std::unexpected(announced.error());
    session.sdo_channel_dirty();
    if (auto reached = session.await_state(); !reached) return std::unexpected(reached.error());
    Actual out;
    out.detail = "as written";
    bool asks = false;
    for (const auto& line : lines_) {
      const bool asked = std::exchange(asks, line.kind == Line::Kind::send);
      if (line.kind == Line::Kind::send) {
        auto frame = build_frame(line, session, *object);
        if (!frame) return std::unexpected(frame.error());
        if (!asked) session.next_request();
        auto sent = session.send(*frame);
        if (!sent) return std::unexpected(sent.error());
        continue;
      }
      auto found = next(session, line);
      if (!found) return std::unexpected(found.error());
      if (line.kind == Line::Kind::silence) {
        if (!*found) continue;
        return mismatch(session, line, **found, "a frame where silence is due");
      }
      if (!*found) {
        if (line.can_id(session.node()) == canopen::connection_set(session.node()).sdo_response)
          session.sdo_answer_may_be_late();
        out.kind = Actual::Kind::silence;
        out.detail = "no frame on " + to_string(line.can_id(session.node())) + " within " +
                     to_string(time_of(session, line)) + ", due: " + line.text;
        return out;
      }
      const auto frame = session.capture().frames()[**found].frame;
      auto compared = compare(line, frame, session, *object);
      session.consume(**found);
      out.decisive = *found;
      if (!compared.equal) return mismatch(session, line, **found, compared.reason, compared.first_wrong);
      for (auto& remark : compared.tolerated) out.tolerated.push_back(std::move(remark));
      for (auto& [name, bytes] : compared.names) session.set(name, Value::of_bytes(std::move(bytes)));
    }
    return out;
  }

 private:
  void read(const yaml::Field& field, ParseContext& context) {
    const auto text = field.text();
    if (!text) return;
    std::vector<Problem> problems;
    lines_ = parse_conversation(*text, problems);
    for (auto& problem : problems) {
      auto position = field.node()->line_position(problem.line);
      position.column += problem.column;
      context.diagnostics.error(position, problem.length, problem.what, problem.hint);
    }
    if (lines_.empty() && problems.empty()) field.error("a conversation without lines");
    for (const auto& line : lines_) {
      for (const auto& pattern : line.bytes) {
        auto position = field.node()->line_position(line.number);
        position.column += pattern.column;
        if (pattern.kind == BytePattern::Kind::multiplexer && !object_) {
          context.diagnostics.error(position, pattern.length, "{m} needs the object of the conversation",
                                    "write talk: {object: 1008h:00, frames: ...} as a block");
        }
        if (pattern.kind != BytePattern::Kind::name) continue;
        const bool known = std::ranges::find(context.names, pattern.name) != context.names.end();
        if (line.kind == Line::Kind::send && !known) {
          context.diagnostics.error(position, pattern.length, "unknown name {" + pattern.name + "}",
                                    "a line before it must have received it");
        } else if (!known) {
          context.know(pattern.name);
        }
      }
    }
  }

  /// The frame of a line with 00 for what is not known yet; a command that is not known counts as a write.
  can::Frame outline(const Line& line, NodeId node) const {
    Bytes bytes;
    for (const auto& pattern : line.bytes) {
      if (pattern.kind == BytePattern::Kind::multiplexer) {
        const auto object = object_ ? object_->literal() : std::nullopt;
        const auto index = to_le(object ? object->index.value() : 0U, 2);
        bytes.insert(bytes.end(), index.begin(), index.end());
        bytes.push_back(object ? object->sub.value() : std::uint8_t{0});
      } else {
        const auto width = pattern.width().value_or(bytes.size() < 8 ? 8 - bytes.size() : 0);
        const bool known = pattern.kind == BytePattern::Kind::exact;
        const auto byte = pattern.kind == BytePattern::Kind::node ? node.value()
                          : known                                 ? pattern.value
                                                                  : std::uint8_t{0};
        bytes.insert(bytes.end(), width, byte);
      }
    }
    bytes.resize(std::min<std::size_t>(bytes.size(), 8));
    auto frame = can::data_frame(line.can_id(node), bytes);
    frame.remote = line.remote;
    frame.extended = line.extended;
    if (line.dlc) frame.dlc = *line.dlc;
    return frame;
  }

  Result<std::optional<Multiplexer>> resolve(Session& session) const {
    if (!object_) return std::optional<Multiplexer>();
    auto object = object_->resolve(session);
    if (!object) return std::unexpected(object.error());
    return std::optional(*object);
  }

  static Duration time_of(const Session& session, const Line& line) {
    return line.time ? line.time->resolve(session.profile()) : session.profile().sdo_timeout;
  }

  /// The next received frame on the line's CAN-ID, remote and extended frames included: they are wrong, not
  /// absent.
  static Result<std::optional<std::size_t>> next(Session& session, const Line& line) {
    const auto id = line.can_id(session.node());
    const auto matches = [id](const can::CapturedFrame& captured) {
      return captured.direction == can::Direction::received && !captured.frame.error &&
             captured.frame.id == id.value();
    };
    if (id == canopen::connection_set(session.node()).sdo_response) {
      const bool own_time = line.time.has_value();
      return session.find_answer(matches, own_time ? std::optional(time_of(session, line)) : std::nullopt);
    }
    const auto window = session.window();
    return session.find_frame(window.first, matches, window.anchor + time_of(session, line));
  }

  /// Downloads hidden in the frames change the device like any other: their old values are noted before the
  /// first frame.
  Result<void> announce_downloads(Session& session, const std::optional<Multiplexer>& object) const {
    const auto request_id = canopen::connection_set(session.node()).sdo_request;
    for (const auto& line : lines_) {
      if (line.kind != Line::Kind::send || line.can_id(session.node()) != request_id) continue;
      auto frame = build_frame(line, session, object);
      if (!frame || frame->size() < 4) continue;
      const auto command = frame->data[0];
      const bool download =
          (command & 0xE0U) == 0x20U || (command & 0xE1U) == 0xC0U;  // initiate, block initiate
      if (!download) continue;
      const Multiplexer target{Index(static_cast<std::uint16_t>(frame->data[1] | (frame->data[2] << 8U))),
                               SubIndex(frame->data[3])};
      auto noted = session.will_change(target);
      if (!noted) return noted;
    }
    return {};
  }

  static Actual mismatch(Session& session, const Line& line, std::size_t index, const std::string& reason,
                         std::optional<std::size_t> wrong = std::nullopt) {
    const auto& frame = session.capture().frames()[index].frame;
    Actual out;
    out.kind = Actual::Kind::mismatched;
    out.decisive = index;
    out.data.assign(frame.bytes().begin(), frame.bytes().end());
    std::string bytes;
    for (std::size_t i = 0; i < out.data.size(); ++i) {
      const auto text = hex_bytes(ByteView(out.data).subspan(i, 1));
      bytes += (i == 0 ? "" : " ") + (wrong == i ? "[" + text + "]" : text);
    }
    out.detail =
        "due '" + line.text + "', came " + to_string(CanId(frame.id)) + ": " + bytes + " (" + reason + ")";
    return out;
  }

  std::optional<ObjectReference> object_;
  std::vector<Line> lines_;
};

constexpr Verb table[] = {
    {"talk", "Play frames as the standard prints them.",
     "(text) or frames: the lines\nobject: the entry {m} stands for\n> 600+N: bytes  is sent, < 580+N: bytes  must come, silence 580+N for T_QUIET",
     "- talk:\n    object: 1008h:00\n    frames: |\n      > 600+N: 40 {m} 00 00 00 00\n      < 580+N: 41 {m} {size:4}",
     &Talk::parse},
};

}  // namespace

std::span<const Verb> conversation_verbs() { return table; }

}  // namespace conform::steps
