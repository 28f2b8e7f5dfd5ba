// SPDX-License-Identifier: Apache-2.0
// Literal traces for the tests of the monitors: node-ID 1, one frame per millisecond.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "catch.hpp"
#include "monitor/watch.hpp"

namespace conform::monitor::testing {

/// "> 40 00 10 00 00 00 00 00" client to 601h, "< 43 ..." device from 581h, "> 000: 81 01" and "< 701: 00"
/// with another CAN-ID, "> 601: remote", "> ext 00000601: 40 ...", "wait 2 s".
inline std::vector<can::CapturedFrame> trace(const std::vector<std::string>& lines) {
  std::vector<can::CapturedFrame> out;
  BusTime now{std::chrono::seconds(1)};
  for (const auto& line : lines) {
    std::string_view rest = line;
    if (rest.starts_with("wait ")) {
      const auto pause = parse_duration(rest.substr(5));
      REQUIRE(pause.has_value());
      now += *pause;
      continue;
    }
    can::CapturedFrame captured;
    captured.direction = rest.front() == '>' ? can::Direction::transmitted : can::Direction::received;
    captured.frame.id = rest.front() == '>' ? 0x601 : 0x581;
    rest = trim(rest.substr(1));
    if (const auto colon = rest.find(':'); colon != std::string_view::npos) {
      auto id = rest.substr(0, colon);
      captured.frame.extended = id.starts_with("ext ");
      if (captured.frame.extended) id.remove_prefix(4);
      captured.frame.id = static_cast<std::uint32_t>(std::stoul(std::string(id), nullptr, 16));
      rest = trim(rest.substr(colon + 1));
    }
    if (rest == "remote") {
      captured.frame.remote = true;
      captured.frame.dlc = 8;
    } else {
      const auto bytes = parse_bytes(rest);
      INFO(line);
      REQUIRE(bytes.has_value());
      captured.frame.dlc = static_cast<std::uint8_t>(bytes->size());
      std::ranges::copy(*bytes, captured.frame.data.begin());
    }
    now += std::chrono::milliseconds(1);
    captured.time = now;
    out.push_back(captured);
  }
  return out;
}

inline std::vector<result::CaseResult> judged(const std::vector<can::CapturedFrame>& frames,
                                              const std::vector<Loss>& losses = {}, const Facts& facts = {},
                                              const std::vector<Loss>& late = {}) {
  std::vector<const Rule*> all;
  std::vector<result::CaseResult> cases;
  const Cap cap = [](std::string_view) { return result::Verdict::fail; };
  for (const auto& rule : rules()) {
    all.push_back(&rule);
    cases.push_back(planned_case(rule, cap));
  }
  judge(frames, facts, all, cap, losses, {}, cases, late);
  return cases;
}

/// "fail SDO-GEN-04 in frame 3", in the order of the monitors; frames count from 1.
inline std::vector<std::string> told(const std::vector<result::CaseResult>& cases) {
  std::vector<std::string> out;
  for (const auto& each : cases) {
    for (const auto& judgement : each.judgements) {
      for (const auto& finding : judgement.findings) {
        out.push_back(std::string(to_string(finding.verdict)) + " " + finding.requirement + " in " +
                      finding.step.substr(0, finding.step.find(',')));
      }
    }
  }
  return out;
}
inline std::vector<std::string> told(const std::vector<std::string>& lines) {
  return told(judged(trace(lines)));
}

inline result::Verdict verdict_of(const std::vector<result::CaseResult>& cases, std::string_view id) {
  const auto found = std::ranges::find(cases, id, &result::CaseResult::id);
  REQUIRE(found != cases.end());
  return found->verdict;
}

using Told = std::vector<std::string>;

/// What stands before the interesting frames, so that the follower knows where it is: four frames.
inline std::vector<std::string> after_exchanges(std::vector<std::string> lines) {
  std::vector<std::string> out{"> 40 00 10 00 00 00 00 00", "< 43 00 10 00 91 01 00 00",
                               "> 40 01 10 00 00 00 00 00", "< 4F 01 10 00 00 00 00 00"};
  out.insert(out.end(), lines.begin(), lines.end());
  return out;
}

/// "<index low> <index high> <sub>"
inline std::string object_bytes(std::uint16_t index, std::uint8_t sub) {
  return fmt::format("{:02X} {:02X} {:02X}", index & 0xFFU, index >> 8U, sub);
}
inline std::string value_bytes(std::uint32_t value) {
  return fmt::format("{:02X} {:02X} {:02X} {:02X}", value & 0xFFU, value >> 8U & 0xFFU, value >> 16U & 0xFFU,
                     value >> 24U);
}

/// Lines of a trace in which a client reads and writes, with pauses, so that what they say is settled.
class Story {
 public:
  Story& read(std::uint16_t index, std::uint8_t sub, std::uint32_t value) {
    return line("wait 150 ms")
        .line("> 40 " + object_bytes(index, sub) + " 00 00 00 00")
        .line("< 43 " + object_bytes(index, sub) + " " + value_bytes(value));
  }
  Story& write(std::uint16_t index, std::uint8_t sub, std::uint32_t value) {
    return line("wait 150 ms")
        .line("> 23 " + object_bytes(index, sub) + " " + value_bytes(value))
        .line("< 60 " + object_bytes(index, sub) + " 00 00 00 00");
  }
  Story& refuse(std::uint8_t command, std::uint16_t index, std::uint8_t sub, std::uint32_t code) {
    return line("wait 150 ms")
        .line(fmt::format("> {:02X} ", command) + object_bytes(index, sub) + " 00 00 00 00")
        .line("< 80 " + object_bytes(index, sub) + " " + value_bytes(code));
  }
  Story& absent(std::uint16_t index, std::uint8_t sub) { return refuse(0x40, index, sub, 0x0602'0000); }
  Story& line(std::string text) {
    lines_.push_back(std::move(text));
    return *this;
  }
  /// A frame some time after what was said before.
  Story& later(std::string frame) { return line("wait 150 ms").line(std::move(frame)); }

  /// "fail PDO-TX-02", each kind once.
  [[nodiscard]] Told told(const Facts& facts = {}, const std::vector<Loss>& late = {}) const {
    Told out;
    for (const auto& each : testing::told(judged(trace(lines_), {}, facts, late)))
      if (auto kind = each.substr(0, each.find(" in ")); std::ranges::find(out, kind) == out.end())
        out.push_back(std::move(kind));
    return out;
  }
  [[nodiscard]] result::Verdict verdict(std::string_view monitor) const {
    return verdict_of(judged(trace(lines_)), monitor);
  }

 private:
  std::vector<std::string> lines_;
};

}  // namespace conform::monitor::testing
