// SPDX-License-Identifier: Apache-2.0
// What all phases of a run share: what was asked for, the device, the bus, and the result so far.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "device/profile.hpp"
#include "engine/engine.hpp"
#include "engine/live_monitors.hpp"
#include "engine/monitor_cases.hpp"
#include "engine/recorder.hpp"
#include "engine/run_session.hpp"
#include "engine/waivers.hpp"
#include "result/run_result.hpp"
#include "scenario/catalogue.hpp"

namespace conform::engine {

struct RunContext {
  RunContext(can::Transport& transport, const device::Profile& device, const scenario::Catalogue& rules,
             const RunOptions& wanted)
      : profile(device),
        catalogue(rules),
        options(wanted),
        recorder(transport, wanted.stop),
        session(recorder, profile, device::dictionary_of(profile)),
        monitors(chosen_monitors(options.plan.selection, catalogue)),
        live(facts_of_run(profile), monitors),
        waivers(profile.waivers, catalogue, options.today) {
    session.try_all_objects(options.plan.all_objects);
    if (options.observer != nullptr) recorder.set_observer(*options.observer);
    session.allow(options.plan.allowed);
    recorder.tell_parts(options.comment_parts);
  }
  RunContext(const RunContext&) = delete;
  RunContext& operator=(const RunContext&) = delete;

  const device::Profile& profile;
  const scenario::Catalogue& catalogue;
  const RunOptions& options;
  Recorder recorder;
  RunSession session;
  Monitors monitors;  ///< those that are cases of this run
  LiveMonitors live;
  Waivers waivers;
  result::RunResult out;
  /// The latest reset of the engine itself that ended with a boot-up message.
  struct Reset {
    std::size_t seen;  ///< up to here in the capture nothing has changed the device since
    bool of_node;
  };
  std::optional<Reset> latest_reset;

  [[nodiscard]] bool may(scenario::Risk risk) const { return risk <= options.plan.allowed; }
  /// For the summary, which says a thing once.
  void note(std::string text) {
    if (std::ranges::find(out.notes, text) == out.notes.end()) out.notes.push_back(std::move(text));
  }
};

/// An upload that brought its data, or a download that was taken.
[[nodiscard]] inline bool confirmed(const steps::SdoAnswer& answer) {
  return answer.kind == steps::SdoAnswer::Kind::confirmed;
}

/// While values are put back the bus must be usable, whatever the user wants meanwhile. A second signal still
/// ends the program.
class StopHeld {
 public:
  explicit StopHeld(Recorder& recorder) : recorder_(recorder) { recorder_.ignore_stop(true); }
  ~StopHeld() { recorder_.ignore_stop(false); }
  StopHeld(const StopHeld&) = delete;
  StopHeld& operator=(const StopHeld&) = delete;

 private:
  Recorder& recorder_;
};

}  // namespace conform::engine
