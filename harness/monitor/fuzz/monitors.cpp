// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: no sequence of frames, in whatever direction, form and time, harms the monitors.
//
// Input: frames, each a byte with what it is, then its parameters:
//   bits 0-3  0 request of the default server, 1 its response, 2 error control, 3 EMCY, 4 NMT, 5 any: id[2],
//             6, 7 the servers of 1201h, 8, 9 a request or response of the byte that follows as 20h, 40h,
//             ..., then zeros, A the object of the last request in the other direction with another command,
//             B frames are lost, others: a data frame of node 6 on error control
//   bit 4     from the device (else from us)
//   bit 5     a time step follows: 2^(byte & 1Fh) us; else 250 us
//   bit 6     a byte with flags follows: 1 extended, 2 remote, 4 error, 8: a byte with the DLC follows; else
//   8 bytes of data
#include <algorithm>
#include <array>
#include <chrono>
#include <span>
#include <string_view>
#include <vector>

#include "base/check.hpp"
#include "base/fuzz/input.hpp"
#include "monitor/watch.hpp"

namespace {

using namespace conform;
using namespace conform::monitor;
using fuzz::Input;

constexpr std::uint32_t node = 5;

class Trace {
 public:
  explicit Trace(Input input) : input_(input) {
    while (!input_.empty() && frames.size() < 4000) add();
  }
  std::vector<can::CapturedFrame> frames;
  std::vector<Loss> losses;

 private:
  void add() {
    const std::uint8_t what = input_.u8();
    const unsigned kind = what & 0x0FU;
    now_ += (what & 0x20U) != 0 ? Duration(std::chrono::microseconds(1LL << (input_.u8() & 0x1FU)))
                                : Duration(std::chrono::microseconds(250));
    const std::uint8_t flags = (what & 0x40U) != 0 ? input_.u8() : std::uint8_t{0};
    if (kind == 11) {
      losses.push_back({frames.size() > 3 ? frames.size() - 3 : 0, frames.size()});
      return;
    }
    can::CapturedFrame out;
    out.time = now_;
    out.direction = (what & 0x10U) != 0 ? can::Direction::received : can::Direction::transmitted;
    out.frame.id = id_of(kind);
    out.frame.extended = (flags & 1U) != 0;
    out.frame.remote = (flags & 2U) != 0;
    out.frame.error = (flags & 4U) != 0;
    out.frame.dlc = (flags & 8U) != 0 ? input_.u8() & 0x0FU : std::uint8_t{8};
    if ((kind == 2 || kind == 4) && (flags & 8U) == 0) out.frame.dlc = kind == 2 ? 1 : 2;
    auto& data = out.frame.data;
    if (kind == 10) {
      data = last_;
      data[0] = input_.u8();
    } else if (kind == 8 || kind == 9) {
      data[0] = static_cast<std::uint8_t>(input_.u8() << 5U);
    } else {
      std::ranges::copy(input_.take(out.frame.size()), data.begin());
    }
    last_ = data;
    frames.push_back(out);
  }

  std::uint32_t id_of(unsigned kind) {
    switch (kind) {
      case 0:
      case 8: return 0x600 + node;
      case 1:
      case 9:
      case 10: return 0x580 + node;
      case 2: return 0x700 + node;
      case 3: return 0x080 + node;
      case 4: return 0;
      case 5: return input_.u16();
      case 6: return 0x6C0;
      case 7: return 0x5C0;
      default: return 0x706;
    }
  }

  Input input_;
  BusTime now_{};
  std::array<std::uint8_t, 8> last_{};
};

std::vector<const Rule*> all_rules() {
  std::vector<const Rule*> all;
  for (const auto& rule : rules()) all.push_back(&rule);
  return all;
}

void watch_only(const Trace& trace, const Facts& facts, std::span<const Rule* const> chosen) {
  Watch watch(facts, chosen);
  for (std::size_t i = 0; i < trace.frames.size(); ++i) {
    if (std::ranges::any_of(trace.losses, [i](const Loss& loss) { return loss.end == i; })) watch.on_loss();
    watch.on_frame(trace.frames[i], i);
  }
  watch.end();
  for (const auto& monitor : watch.monitors()) {
    CONFORM_CHECK(monitor->violations().size() <= Monitor::most_kept * monitor->rule().requirements.size());
    for (const auto& tally : monitor->tallies()) {
      CONFORM_CHECK(tally.violated <= tally.judged && tally.judged <= 4 * trace.frames.size());
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Trace trace{Input(data, size)};
  Facts facts;
  facts.node = NodeId(node);
  static const auto chosen = all_rules();
  // The words of findings and their evidence take most of the time: every eighth input has them.
  if (size % 8 != 0) {
    watch_only(trace, facts, chosen);
    return 0;
  }
  const Cap cap = [](std::string_view) { return std::optional(result::Verdict::fail); };
  std::vector<result::CaseResult> cases;
  for (const auto* rule : chosen) cases.push_back(planned_case(*rule, cap));
  judge(trace.frames, facts, chosen, cap, trace.losses, {}, cases);

  for (std::size_t i = 0; i < cases.size(); ++i) {
    CONFORM_CHECK(cases[i].finished);
    CONFORM_CHECK(cases[i].judgements.size() == chosen[i]->requirements.size());
    for (const auto& judgement : cases[i].judgements) {
      CONFORM_CHECK(judgement.findings.size() <= Monitor::most_kept);
      CONFORM_CHECK(judgement.findings.size() <= judgement.expectations);
      CONFORM_CHECK(judgement.expectations <= 4 * trace.frames.size());
      for (const auto& finding : judgement.findings) {
        CONFORM_CHECK(!finding.actual.empty() && !finding.step.empty() && !finding.evidence.empty());
        CONFORM_CHECK(finding.frames_seen <= trace.frames.size());
      }
    }
  }
  return 0;
}
