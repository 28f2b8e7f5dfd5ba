// SPDX-License-Identifier: Apache-2.0
#include "engine/sdo_runner.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/sdo_initiate.hpp"

namespace conform::engine {
namespace {

using Kind = canopen::TransferResult::Kind;

/// Frames that may wait for the bus at once: enough to keep it busy, few enough that a
/// server's abort in the middle of a sub-block is heeded soon.
constexpr std::size_t most_in_flight = 8;
/// A frame that is not on the bus by then will not be.
constexpr Duration transmit_limit = std::chrono::seconds(1);

/// One answer may take T_SDO, but a megabyte of such answers would take a day: after the first minute they
/// must be this quick on average.
constexpr Duration patience = std::chrono::minutes(1);
constexpr Duration per_answer = std::chrono::milliseconds(280);
/// ... or as quick as they are, up to this.
constexpr Duration longest_patience = std::chrono::minutes(3);

/// A server that has ended a transfer may answer each segment that was on its way, one behind the other, and
/// what is asked next would meet these answers. They are heard out until nothing comes for so long, ...
constexpr Duration settled = std::chrono::milliseconds(10);
/// ... but no longer than this.
constexpr Duration longest_backlog = std::chrono::seconds(2);

class Runner {
 public:
  Runner(Recorder& recorder, std::span<SdoRun> runs) : recorder_(recorder), runs_(runs) {}

  Result<void> run() {
    seen_ = recorder_.capture().size();
    const auto begin = recorder_.now();
    for (auto& run : runs_) run.since = run.not_sent_since = run.last_request = begin;
    for (;;) {
      // One frame each in turn; whoever was behind the last one that got room begins.
      bool handed_over = false;
      const auto begins_with = turn_;
      for (std::size_t i = 0; i < runs_.size(); ++i) {
        const auto index = begins_with + i < runs_.size() ? begins_with + i : begins_with + i - runs_.size();
        auto sent = hand_over(runs_[index]);
        if (!sent) return std::unexpected(sent.error());
        if (*sent) turn_ = index + 1 < runs_.size() ? index + 1 : 0;
        handed_over = handed_over || *sent;
      }
      const bool heard = seen_ < recorder_.capture().size();
      while (seen_ < recorder_.capture().size()) look_at(seen_++);
      if (std::ranges::all_of(runs_, &SdoRun::over)) return {};
      for (const auto& run : runs_) {
        const auto taken = run.since - begin;
        if (run.over || taken < patience) continue;
        const auto pace = std::max(per_answer, run.slowest + run.slowest / 4);
        const auto granted = patience + run.heard * per_answer;
        if (taken < std::max(granted, std::min(patience + run.heard * pace, longest_patience))) continue;
        return fail_scenario("the transfer of " + to_string(run.object) + " was given up after " +
                                 to_string(std::chrono::floor<std::chrono::seconds>(taken)) + " and " +
                                 std::to_string(run.heard) + " answers",
                             "at this pace it would take hours");
      }
      // What was heard may have given the clients something to say, or ended them.
      if (handed_over || heard) continue;
      auto until = BusTime::max();
      for (const auto& run : runs_) {
        if (!run.over) until = std::min(until, deadline(run));
      }
      auto more = recorder_.listen(until);
      if (!more) return std::unexpected(more.error());
      if (*more) continue;
      for (auto& run : runs_) {
        if (run.over || deadline(run) > until) continue;
        if (auto done = on_deadline(run, until); !done) return done;
      }
    }
  }

 private:
  static BusTime deadline(const SdoRun& run) {
    if (run.in_flight > 0) return run.not_sent_since + transmit_limit;
    if (run.quiet_until) return *run.quiet_until;
    return run.since + (run.client->fell_silent() ? run.wait : run.stretched ? run.patience : run.limit);
  }

  /// One frame, if the transfer has one and the bus has room.
  Result<bool> hand_over(SdoRun& run) {
    if (run.over || in_flight_ >= most_in_flight) return false;
    std::optional<canopen::SdoFrame> frame;
    if (!run.client->ended()) {
      frame = run.client->next(run.in_flight);
    } else if (run.in_flight == 0) {
      const auto reply = run.client->result().reply;
      if (reply && !std::exchange(run.replied, true)) {
        frame = canopen::SdoFrame{.bytes = canopen::encode_abort(run.object, *reply),
                                  .part = canopen::SdoFrame::Part::abort};
      } else {
        close(run);
      }
    }
    if (!frame) return false;
    run.posted = can::data_frame(run.request, frame->view());
    auto sent = recorder_.post(run.posted);
    if (!sent) return std::unexpected(sent.error());
    ++run.in_flight;
    ++in_flight_;
    return true;
  }

  void close(SdoRun& run) {
    const auto& result = run.client->result();
    const auto last = std::max(run.since, run.last_request);
    const bool is_refused = result.kind == Kind::aborted || result.kind == Kind::violation;
    if (run.listens_after && !result.abandoned && result.kind != Kind::silence) {
      if (!run.quiet_until) run.quiet_until = last + run.wait;
    } else if (is_refused && run.unanswered > 0) {
      if (!run.quiet_until) run.quiet_until = last + settle_time(run);
    } else {
      finish(run);
    }
    if (run.quiet_until && !run.gives_up_at) run.gives_up_at = *run.quiet_until + longest_backlog;
  }

  static void finish(SdoRun& run) {
    run.over = true;
    run.result = run.client->take();
  }

  static Duration settle_time(const SdoRun& run) { return std::max(settled, 2 * run.slowest); }

  void look_at(std::size_t index) {
    const auto& captured = recorder_.capture().frames()[index];
    for (auto& run : runs_) {
      if (run.over) continue;
      if (captured.direction == can::Direction::transmitted) {
        if (run.in_flight == 0 || !captured.frame.is_data(run.request)) continue;
        --run.in_flight;
        --in_flight_;
        if (!run.first_request) run.first_request = index;
        run.last_request = run.since = run.not_sent_since = captured.time;
        if (captured.frame.size() > 0 && captured.frame.data[0] != 0x80) {
          run.asked_at = captured.time;
          ++run.unanswered;
        }
        run.looked_again = false;
        if (!run.client->ended()) run.decisive = index;
        const auto overtook = std::exchange(run.overtook, std::nullopt);
        if (overtook && *overtook >= recorder_.first_effect(index)) {
          const auto early = recorder_.capture().frames()[*overtook];
          on_response(run, early, *overtook);
        }
      } else if (captured.frame.is_data(run.response)) {
        on_response(run, captured, index);
      }
    }
  }

  void on_response(SdoRun& run, const can::CapturedFrame& captured, std::size_t index) {
    const auto bytes = captured.frame.bytes();
    if (run.client->ended()) {
      // It is over when our last frame is on the bus; what came until then says nothing.
      run.unanswered -= run.unanswered > 0 ? 1 : 0;
      if (run.in_flight > 0) return;
      if (run.listens_after) {
        ++run.surplus;
        if (bytes.size() == 8 && bytes[0] == 0x80) ++run.answers;
      }
      if (run.quiet_until && run.unanswered > 0)
        run.quiet_until =
            std::min(std::max(*run.quiet_until, captured.time + settle_time(run)), *run.gives_up_at);
      return;
    }
    if (run.stale && !run.client->settled() && bytes.size() >= 4) {
      const auto object = canopen::sdo_multiplexer(bytes);
      if (object == *run.stale && object != run.object) return;
    }
    if (!run.client->on_frame(bytes, run.in_flight)) {
      if (run.in_flight > 0) run.overtook = index;
      return;
    }
    // The server's own time-out answers nothing, and says nothing about how quick it is.
    const auto abort = canopen::decode_abort(bytes);
    if (!abort || abort->code != canopen::abort::timed_out) {
      run.latest = std::max(Duration(0), captured.time - run.since);
      run.slowest = std::max(run.slowest, run.latest);
    }
    run.stretched = false;
    run.since = std::max(run.since, captured.time);
    run.unanswered = run.client->ended() && run.unanswered > 0 ? run.unanswered - 1 : 0;
    ++run.heard;
    run.decisive = index;
  }

  Result<void> on_deadline(SdoRun& run, BusTime now) {
    if (run.in_flight > 0) {
      if (run.looked_again) {
        if (!recorder_.lost_frames()) return std::unexpected(recorder_.never_sent());
        in_flight_ -= std::exchange(run.in_flight, 0);
        const auto index = recorder_.echo_lost(run.posted);
        if (!run.first_request) run.first_request = index;
        run.last_request = run.since = now;
        seen_ = std::max(seen_, recorder_.capture().size());
        return {};
      }
      // The last look at the clock may be long ago.
      run.looked_again = true;
      run.not_sent_since = recorder_.now();
      return {};
    }
    if (run.quiet_until) {
      finish(run);
      return {};
    }
    const bool awaits_an_answer = !run.client->fell_silent() && !run.listens_after;
    if (awaits_an_answer && !run.stretched && run.patience > run.limit) {
      run.stretched = true;
      return {};
    }
    if (run.stretched) run.waited_in_vain = run.patience - run.limit;
    run.since = now;
    run.client->on_silence();
    return {};
  }

  Recorder& recorder_;
  std::span<SdoRun> runs_;
  std::size_t seen_ = 0;
  std::size_t turn_ = 0;       ///< who hands over first
  std::size_t in_flight_ = 0;  ///< of all runs
};

}  // namespace

Result<void> run_transfers(Recorder& recorder, std::span<SdoRun> runs) {
  auto done = Runner(recorder, runs).run();
  if (!done) return done;
  for (auto& run : runs) {
    run.result.counts.surplus += run.surplus;
    run.result.counts.answers += run.answers;
    auto& detail = run.result.detail;
    if (run.result.kind != Kind::silence) continue;
    detail = run.result.abandoned
                 ? "nothing from the server within " + to_string(run.wait) + " after the client fell silent"
                 : "no answer within " + to_string(run.limit + run.waited_in_vain);
  }
  return {};
}

}  // namespace conform::engine
