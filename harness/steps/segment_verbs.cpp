// SPDX-License-Identifier: Apache-2.0
// The verb `segments`: a segmented upload that goes on where a client would give up, and counts what was
// wrong.
#include <algorithm>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/sdo_initiate.hpp"
#include "canopen/sdo_segment.hpp"
#include "device/standard_objects.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

// A server that never marks its last segment must not hold the run for ever.
constexpr std::size_t most_surplus_segments = 2;
constexpr std::size_t most_bytes = std::size_t{1} << 20U;

class Segments final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<Segments>();
    auto fields = value.fields("segments");
    const auto object = fields.required("of");
    if (object) {
      if (auto parsed = parse_object_at(object, context.names)) out->object_ = *parsed;
    }
    if (const auto pause = fields.optional("pause")) out->pause_ = parse_time_at(pause);
    if (const auto pauses = fields.optional("pauses")) out->pauses_ = pauses.number(1, 1'000'000);
    if (const auto save = fields.optional("save")) {
      out->save_ = save.text().value_or("");
      context.know(out->save_);
    }
    return object ? std::move(out) : nullptr;
  }
  std::string words(Session& session) const override {
    const auto object = object_.resolve(session);
    return "upload " + (object ? to_string(*object) : object_.text()) + " by segments" +
           (pause_
                ? " with " + (pauses_ ? std::to_string(*pauses_) + " " : "") + "pauses of " + pause_->text()
                : "");
  }
  Measures measures() const override {
    return {"segments", "wrong_toggles", "difference", "unmarked", "empty_last"};
  }
  Need need() const override { return {}; }
  Channels rests_on() const override { return {channel::segmented_upload}; }
  const ObjectReference* object() const override { return &object_; }

  Result<Actual> run(Session& session) const override {
    const auto object = object_.resolve(session);
    if (!object) return std::unexpected(object.error());
    Progress so_far;
    auto first = exchange(session, canopen::encode_upload_request(*object), so_far.out);
    if (!first || !*first) return end(session, so_far, first);
    const auto initiate = canopen::decode_upload_response(**first);
    if (!initiate) return wrong_answer(so_far, **first, "an upload response");
    if (initiate->expedited) {
      so_far.data.assign((*first)->begin() + 4,
                         (*first)->begin() + 4 + static_cast<std::ptrdiff_t>(initiate->expedited_size()));
      so_far.marked = true;
      return measured(session, so_far);
    }
    if (initiate->size_indicated) so_far.announced = initiate->value;
    for (bool toggle = false;; toggle = !toggle) {
      const auto seen = session.capture().frames().size();
      if (pause_ && (!pauses_ || so_far.segments < *pauses_)) {
        auto waited = session.wait_until(session.now() + pause_->resolve(session.profile()));
        if (!waited) return std::unexpected(waited.error());
        if (gave_up(session, seen, so_far.out)) return so_far.out;
      }
      auto answer = exchange(session, canopen::encode_upload_segment_request(toggle), so_far.out);
      // The end of the transfer and the request may cross: then it is the first abort that says why.
      if (so_far.out.kind == Actual::Kind::aborted) (void)gave_up(session, seen, so_far.out);
      // Past the announced size only the mark is missing: how the server ends then is no matter of the data.
      if (so_far.complete() && (!answer || !*answer)) break;
      if (!answer || !*answer) return end(session, so_far, answer);
      const auto segment = canopen::decode_segment(**answer);
      if (!segment) return wrong_answer(so_far, **answer, "an upload segment");
      ++so_far.segments;
      if (segment->toggle != toggle) ++so_far.wrong_toggles;
      if (so_far.complete()) ++so_far.surplus;
      if (segment->last && segment->size() == 0 && so_far.complete()) {
        so_far.empty_last = so_far.segments > 1;
        so_far.marked = true;
        break;
      }
      if (so_far.surplus > 0) {
        so_far.surplus_bytes += segment->size();
      } else {
        const auto data = ByteView(segment->data).first(segment->size());
        so_far.data.insert(so_far.data.end(), data.begin(), data.end());
      }
      if (segment->last) {
        so_far.marked = so_far.surplus == 0;
        break;
      }
      if (so_far.surplus >= most_surplus_segments || so_far.data.size() > most_bytes) break;
    }
    if (!so_far.marked) session.sdo_channel_dirty();
    return measured(session, so_far);
  }

 private:
  struct Progress {
    Actual out;
    Bytes data;
    std::optional<std::uint64_t> announced;
    std::uint64_t segments = 0, wrong_toggles = 0, surplus = 0, surplus_bytes = 0;
    bool marked = false, empty_last = false;
    [[nodiscard]] bool complete() const { return announced && data.size() >= *announced && segments > 0; }
  };
  using Answer = Result<std::optional<Bytes>>;

  /// The answer to one request; nullopt when the transfer ended (silence or abort, then noted in `out`).
  static Answer exchange(Session& session, const canopen::SdoBytes& request, Actual& out) {
    const auto set = canopen::connection_set(session.node());
    session.next_request();
    auto sent = session.send(can::data_frame(set.sdo_request, request));
    if (!sent) return std::unexpected(sent.error());
    auto found = session.find_answer(
        [id = set.sdo_response](const can::CapturedFrame& captured) {
          return captured.direction == can::Direction::received && captured.frame.is_data(id);
        },
        std::nullopt);
    if (!found) return std::unexpected(found.error());
    if (!*found) {
      out.kind = Actual::Kind::silence;
      out.detail = "no answer within " + to_string(session.profile().sdo_timeout);
      session.sdo_answer_may_be_late();
      return std::optional<Bytes>();
    }
    session.consume(**found);
    out.decisive = *found;
    const auto bytes = session.capture().frames()[**found].frame.bytes();
    if (const auto abort = canopen::decode_abort(bytes)) {
      out.kind = Actual::Kind::aborted;
      out.code = abort->code;
      return std::optional<Bytes>();
    }
    return std::optional(Bytes(bytes.begin(), bytes.end()));
  }

  /// Whether the server ended the transfer while nobody asked it for anything.
  static bool gave_up(Session& session, std::size_t from, Actual& out) {
    const auto id = canopen::connection_set(session.node()).sdo_response;
    const auto& frames = session.capture().frames();
    for (std::size_t at = from; at < frames.size(); ++at) {
      if (frames[at].direction != can::Direction::received || !frames[at].frame.is_data(id)) continue;
      const auto abort = canopen::decode_abort(frames[at].frame.bytes());
      if (!abort) continue;
      session.consume(at);
      out.decisive = at;
      out.kind = Actual::Kind::aborted;
      out.code = abort->code;
      return true;
    }
    return false;
  }

  static Result<Actual> end(Session&, Progress& so_far, const Answer& answer) {
    if (!answer) return std::unexpected(answer.error());
    return so_far.out;
  }

  static Actual wrong_answer(Progress& so_far, const Bytes& bytes, std::string_view due) {
    so_far.out.kind = Actual::Kind::violation;
    so_far.out.data = bytes;
    so_far.out.detail = "answers " + hex_bytes(bytes) + " where " + std::string(due) + " is due";
    return so_far.out;
  }

  Actual measured(Session& session, Progress& so_far) const {
    auto& out = so_far.out;
    const auto held = so_far.data.size() + so_far.surplus_bytes;
    const auto size = so_far.announced.value_or(held);
    out.kind = Actual::Kind::confirmed;
    out.has_data = true;
    out.data = so_far.data;
    const auto object = object_.resolve(session);
    if (object) out.type = device::type_of(session.dictionary(), *object);
    out.measured["segments"] = so_far.segments;
    out.measured["wrong_toggles"] = so_far.wrong_toggles;
    out.measured["difference"] = held > size ? held - size : size - held;
    out.measured["unmarked"] = so_far.marked ? 0 : 1;
    out.measured["empty_last"] = so_far.empty_last ? 1 : 0;
    if (!save_.empty()) session.set(save_, Value::of_bytes(so_far.data));
    return out;
  }

  ObjectReference object_;
  std::optional<TimeReference> pause_;
  std::optional<std::uint64_t> pauses_;  ///< none: before every request
  std::string save_;
};

constexpr Verb table[] = {
    {"segments",
     "Read an entry of more than four bytes segment by segment, to the end even where the server errs.",
     "of: the entry\npause: time before each request\npauses: only before the first of them, so many (default: all)\nsave: name that the data get\n"
     "measured: segments (0: expedited), wrong_toggles, difference (of the told size and the bytes that came), unmarked (1: no segment is "
     "marked as the last), empty_last (1: an empty segment ends the transfer)",
     "- segments: {of: 1008h:00, save: name}\n  checks: SDO-SUP-03\n  expect: {wrong_toggles: 0}",
     &Segments::parse},
};

}  // namespace

std::span<const Verb> segment_verbs() { return table; }

}  // namespace conform::steps
