// SPDX-License-Identifier: Apache-2.0
#include "engine/lss_survey.hpp"

#include <chrono>
#include <optional>
#include <string>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"

namespace conform::engine {
namespace {

using canopen::LssAddress;
using canopen::LssCommand;

// Several slaves answer one question, each when it comes round to it; what is late must not answer the next.
constexpr Duration settle = std::chrono::milliseconds(5);
// A scan may be led astray by a slave that joins in the middle.
constexpr int most_tries = 3;

/// The first answer to a request; nullopt: nobody answers.
Result<std::optional<canopen::LssAnswer>> ask(Recorder& recorder, const can::Frame& request,
                                              Duration timeout) {
  const auto sent = recorder.send(request);
  if (!sent) return std::unexpected(sent.error());
  const auto found = recorder.find(
      *sent + 1,
      [](const can::CapturedFrame& captured) {
        return captured.direction == can::Direction::received &&
               captured.frame.is_data(canopen::lss_response_can_id);
      },
      recorder.capture().frames()[*sent].time + timeout);
  if (!found) return std::unexpected(found.error());
  if (!*found) return std::optional<canopen::LssAnswer>();
  const auto answer = canopen::decode_lss(recorder.capture().frames()[**found].frame);
  if (auto waited = recorder.wait_until(recorder.now() + settle); !waited)
    return std::unexpected(waited.error());
  return answer;
}

Result<void> tell(Recorder& recorder, const can::Frame& frame) {
  const auto sent = recorder.send(frame);
  return sent ? Result<void>() : std::unexpected(sent.error());
}

Result<void> all_to_waiting(Recorder& recorder) {
  return tell(recorder, canopen::encode_lss(LssCommand::switch_global, 0));
}

Result<bool> answers(Recorder& recorder, const canopen::LssFastscan& question, Duration timeout) {
  const auto answer = ask(recorder, canopen::encode(question), timeout);
  if (!answer) return std::unexpected(answer.error());
  return *answer && (*answer)->specifier == static_cast<std::uint8_t>(LssCommand::identified);
}

/// One scan; nullopt: it began and led to nobody.
Result<std::optional<LssAddress>> scan_once(Recorder& recorder, Duration timeout) {
  canopen::LssScan scan;
  while (!scan.finished()) {
    const auto yes = answers(recorder, scan.question(), timeout);
    if (!yes) return std::unexpected(yes.error());
    scan.answered(*yes);
  }
  return scan.found() ? std::optional(scan.address()) : std::nullopt;
}

Result<std::vector<LssAddress>> find_all(Recorder& recorder, const LssSurveyOptions& options) {
  std::vector<LssAddress> out;
  for (int tries = 0; out.size() < options.most;) {
    const auto anybody = answers(recorder, {}, options.timeout);
    if (!anybody) return std::unexpected(anybody.error());
    if (!*anybody) break;
    const auto found = scan_once(recorder, options.timeout);
    if (!found) return std::unexpected(found.error());
    if (*found) {
      out.push_back(**found);
      tries = 0;
    } else if (++tries == most_tries) {
      return fail("an LSS slave without node-ID answers, and no scan leads to it", {},
                  "two devices with the same four numbers in 1018h, or a longer --timeout");
    }
  }
  return out;
}

}  // namespace

Result<std::vector<LssAddress>> find_unconfigured(Recorder& recorder, const LssSurveyOptions& options) {
  if (auto done = all_to_waiting(recorder); !done) return std::unexpected(done.error());
  auto found = find_all(recorder, options);
  if (auto done = all_to_waiting(recorder); !done && found) return std::unexpected(done.error());
  return found;
}

Result<void> give_node_id(Recorder& recorder, const LssAddress& address, NodeId node, Duration timeout) {
  if (auto done = all_to_waiting(recorder); !done) return done;
  auto frames = canopen::encode_lss_selection(address);
  const auto last = frames.back();
  frames.pop_back();
  for (const auto& frame : frames) {
    if (auto done = tell(recorder, frame); !done) return done;
  }
  const auto selected = ask(recorder, last, timeout);
  if (!selected) return std::unexpected(selected.error());
  if (!*selected) return fail("the slave does not answer to its address");
  const auto answer =
      ask(recorder, canopen::encode_lss(LssCommand::configure_node_id, node.value()), timeout);
  if (!answer) return std::unexpected(answer.error());
  if (!*answer) return fail("the slave does not answer to configure node-ID");
  if ((*answer)->error != 0)
    return fail("the slave refuses node-ID " + std::to_string(node.value()) + ": error code " +
                canopen::describe_lss_error((*answer)->specifier, (*answer)->error, (*answer)->detail));
  return all_to_waiting(recorder);
}

}  // namespace conform::engine
