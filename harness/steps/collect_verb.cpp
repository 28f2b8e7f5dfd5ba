// SPDX-License-Identifier: Apache-2.0
// The verb `collect`: how many frames come, when, and what they count or tell.
#include <algorithm>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "steps/contents.hpp"
#include "steps/frame_source.hpp"
#include "steps/timing.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

class Collect final : public Action {
 public:
  static constexpr std::uint64_t most_awaited = 10'000;

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
    if (const auto enough = fields.optional("enough")) {
      out->enough_ = enough.number(1, most_awaited).value_or(1);
      if (out->answers_)
        enough.error("frames are answers with per: what ends the step is the last frame sent");
    }
    parse_after(fields, context, out->after_);
    return from && end ? std::move(out) : nullptr;
  }
  Measures measures() const override {
    Measures out{"count", "first", "state", "period", "shortest", "longest", "length"};
    if (!overflow_.empty()) out.insert(out.end(), {"start", "out_of_order"});
    if (times_of_day_) out.insert(out.end(), {"malformed", "drift"});
    if (source_.is_error_control()) out.insert(out.end(), {"pace", "quickest", "slowest"});
    if (answers_) out.insert(out.end(), {"missed", "skipped", "extra", "closest", "farthest", "latency"});
    return out;
  }
  std::vector<ObjectReference> concerns() const override { return source_.concerns(); }
  bool acts() const override { return false; }
  Channels rests_on() const override { return source_.rests_on(); }
  std::string words(Session& session) const override {
    if (!answers_) {
      return "collect " + source_.words(session) + " " + end_.words() +
             (enough_ > 0 ? " or until " + std::to_string(enough_) + " have come" : "");
    }
    return "collect " + source_.words(session) + " per " +
           (stimulus_.empty() ? "SYNC" : "frame on " + can_id_words(stimulus_, session)) + ", until " +
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
    const auto end = end_.after(window->anchor, session, source_);
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
        if (hits.size() != enough_) continue;
        until = frames[**found].time;
        break;
      }
      stimuli.push_back(frames[**found].time);
      if (frames[**found].direction == can::Direction::transmitted)
        until = std::max(until, stimuli.back() + time);
    }
    if (sent && stimuli.empty()) return fail_scenario("nothing was sent that could have been answered");
    auto out = measure(session, *window, hits, stimuli, until);
    out.listened = {window->anchor, until};
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

  [[nodiscard]] Actual measure(Session& session, const Window& window, const std::vector<std::size_t>& hits,
                               const std::vector<BusTime>& stimuli, BusTime end) const {
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
      // Anything but one byte must not pass as a state.
      const auto value =
          frame.dlc == 1 ? static_cast<std::uint8_t>(byte & source_.state_bits(session)) : std::uint8_t{0xFF};
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
    if (const auto nominal = source_.nominal_period(session); nominal && hits.size() > 1)
      measure_pace(out, distances, *nominal);
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

  static void measure_pace(Actual& out, const Distances& distances, Duration nominal) {
    const auto percent = [nominal](Duration time) {
      return static_cast<std::uint64_t>(100 * time / nominal);
    };
    out.measured["pace"] = percent(distances.mean + nominal / 200);
    out.measured["quickest"] = percent(distances.shortest);
    out.measured["slowest"] = percent(distances.longest);
    out.detail += ", " + std::to_string(out.measured["pace"]) + " % of " + to_string(nominal);
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
  std::uint64_t enough_ = 0;  ///< so many frames end the step; 0: its time does
};

constexpr Verb table[] = {
    {"collect", "Count and time frames.",
     "from: CAN-ID or service\nfor: how long; with per: how long after the last frame that was sent\n"
     "until: instead of for, a label that was reached, or now: whatever the steps before took\nper: sync or a CAN-ID: frames are "
     "answers to what was sent there, by the device itself as well\ncounter: overflow value: the frames count 1 to this and 1 again\n"
     "time_of_day: true: the frames tell the time\nenough: number of frames that ends the step before its time\nafter: label to count from\nmeasured: count, period, shortest, longest (the time behind "
     "the last frame included), first, state, length (bytes of every frame); with counter: start (of the first frame), out_of_order; with "
     "time_of_day: malformed, drift; from error control: pace, quickest, slowest (period, shortest and longest in percent of the period "
     "that ready_error_control made sure of); with per: missed, skipped (missed before the first answer), extra, closest and farthest (distance of "
     "two answers in frames sent), latency (the longest)",
     "- collect: {from: heartbeat, for: 1 s}\n  checks: OD-1017-05\n  expect: {count: 9..11, period: 90 ms..110 ms, state: pre-operational}\n"
     "- collect: {from: 180h + N, per: sync, for: 50 ms}\n  checks: PDO-TX-06\n  expect: {extra: 0, closest: 3.., farthest: ..3}",
     &Collect::parse},
};

}  // namespace

std::span<const Verb> collect_verbs() { return table; }

}  // namespace conform::steps
