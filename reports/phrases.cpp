// SPDX-License-Identifier: Apache-2.0
#include "reports/phrases.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/text_tools.hpp"
#include "result/explanations.hpp"
#include "result/properties.hpp"

namespace conform::reports {

using result::CaseResult;
using result::EvidenceFrame;
using result::Finding;
using result::Verdict;

namespace {

constexpr std::size_t least_in_silence = 6;

/// Where a request decided, because nobody answered it, there is none.
const EvidenceFrame* answer_that_decided(const Finding& finding) {
  const auto* const decided = result::decisive_frame(finding);
  return decided != nullptr && decided->direction == can::Direction::received ? decided : nullptr;
}

}  // namespace

std::vector<LocatedFinding> findings_of(const CaseResult& one) {
  std::vector<LocatedFinding> all;
  for (const Finding& finding : one.setup_findings) all.push_back({&one, &finding, finding.verdict, true});
  for (const result::Judgement& judgement : one.judgements) {
    for (const Finding& finding : judgement.findings) {
      all.push_back({&one, &finding, std::min(finding.verdict, judgement.verdict), false});
    }
  }
  return all;
}

std::string_view verdict_words(Verdict verdict) {
  return verdict == Verdict::not_applicable ? "not applicable" : result::to_string(verdict);
}

std::string headline(const Finding& finding) {
  std::string text = log_safe(finding.step);
  const std::string_view came = finding.actual.empty() ? std::string_view(finding.reason) : finding.actual;
  if (!came.empty()) text += (text.empty() ? "" : " -> ") + log_safe(came);
  // "require A -> does not hold: B" has said A, "a frame of C within 1 s -> no frame of C" a frame.
  const auto is_said = [&finding](std::string_view accepted) {
    return finding.step.starts_with(accepted) || finding.step.ends_with(accepted);
  };
  if (finding.accepts.empty() || (finding.accepts.size() == 1 && is_said(finding.accepts.front())))
    return text;
  constexpr std::size_t shown = 3;
  std::string expected;
  for (std::size_t i = 0; i < std::min(shown, finding.accepts.size()); ++i) {
    if (i != 0) expected += i + 1 == finding.accepts.size() ? " or " : ", ";
    expected += log_safe(finding.accepts[i]);
  }
  if (finding.accepts.size() > shown) expected += fmt::format(" or {} more", finding.accepts.size() - shown);
  return text + ", expected " + expected;
}

std::string headline(const CaseResult& one) {
  const std::vector<LocatedFinding> all = findings_of(one);
  const auto worst = std::ranges::max_element(all, {}, &LocatedFinding::verdict);
  if (worst == all.end()) return prose(one.reason);
  const std::string& requirement = worst->finding->requirement;
  const std::string front = !requirement.empty() ? log_safe(requirement) : worst->setup ? "set-up" : "";
  return (front.empty() ? "" : front + ": ") + headline(*worst->finding);
}

std::string waiver_text(const result::WaiverUse& waiver) {
  std::string text = log_safe(waiver.requirement);
  if (!waiver.case_name.empty()) text += " in " + log_safe(waiver.case_name);
  if (waiver.object) text += " of " + to_string(*waiver.object);
  text += ": " + waiver.state;
  if (!waiver.cases.empty()) text += fmt::format(" ({})", counted(waiver.cases.size(), "case"));
  std::vector<std::string> more;
  if (!waiver.ticket.empty()) more.push_back(log_safe(waiver.ticket));
  if (!waiver.owner.empty()) more.push_back(log_safe(waiver.owner));
  if (!waiver.expires.empty()) more.push_back("until " + waiver.expires);
  if (!more.empty()) text += "; " + join(more, ", ");
  text += ": " + prose(waiver.reason);
  return waiver.place.empty() ? text : text + " (" + log_safe(waiver.place) + ")";
}

bool is_not_run(const CaseResult& one) {
  return one.verdict == Verdict::error && !one.finished && one.reason.starts_with("not run");
}

std::string position_text(const result::SourcePosition& position) {
  std::string text = log_safe(position.file);
  if (text.empty() || position.line <= 0) return text;
  text += fmt::format(":{}", position.line);
  if (position.column > 0) text += fmt::format(":{}", position.column);
  return text;
}

Otherwise otherwise_of(const result::RunResult& run, const result::Finding& finding) {
  if (finding.requirement.empty()) return {"otherwise", "the case cannot judge what it is about"};
  const auto* info = run.requirement(finding.requirement);
  const bool is_mild = info != nullptr && (info->level == "optional" || info->level == "recommended");
  if (is_mild && finding.verdict == result::Verdict::warn)
    return {"warns", "everything else, as the rule is not mandatory"};
  return {"fails", "everything else"};
}

std::string level_text(const result::RequirementInfo* info) {
  return info == nullptr || info->level.empty() ? "no level given" : prose(info->level);
}

std::string candump_frame(const can::Frame& frame) {
  constexpr std::uint32_t error_flag = 0x20000000;  // CAN_ERR_FLAG of the kernel
  std::string text = frame.error      ? fmt::format("{:08X}#", (frame.id & 0x1FFFFFFFU) | error_flag)
                     : frame.extended ? fmt::format("{:08X}#", frame.id)
                                      : fmt::format("{:03X}#", frame.id);
  if (frame.remote) return text + (frame.dlc == 0 ? "R" : fmt::format("R{:X}", frame.dlc));
  for (const std::uint8_t byte : frame.bytes()) text += fmt::format("{:02X}", byte);
  if (frame.dlc > 8) text += fmt::format("_{:X}", frame.dlc);  // raw length code of a classical frame
  return text;
}

std::string candump_line(const EvidenceFrame& one, std::string_view interface_name) {
  const std::int64_t us = std::max<std::int64_t>(one.time.time_since_epoch().count() / 1000, 0);
  return fmt::format("({:010}.{:06}) {} {}", us / 1'000'000, us % 1'000'000, interface_name,
                     candump_frame(one.frame));
}

bool is_of_the_machine(const result::Property& property) { return property.name == "run.command"; }

std::string interface_name(const result::RunResult& run) {
  const auto* const found = result::value_of(run, "can.interface");
  if (found == nullptr || found->empty()) return "can0";
  const std::string name = printable(*found);
  return name.find(' ') == std::string::npos ? name : "can0";
}

std::string payload_text(const can::Frame& frame) {
  if (frame.error)
    return fmt::format("error frame {} {}", hex(frame.id & 0x1FFFFFFFU, 8), hex_bytes(frame.bytes()));
  if (frame.remote) return fmt::format("remote, {} byte{} asked for", frame.dlc, frame.dlc == 1 ? "" : "s");
  if (frame.dlc > 8) return fmt::format("{} (DLC {})", hex_bytes(frame.bytes()), frame.dlc);
  return frame.dlc == 0 ? "(no data)" : hex_bytes(frame.bytes());
}

std::string can_id_text(const can::Frame& frame) {
  if (frame.error) return "error";
  if (!frame.extended) return to_string(CanId{frame.id});
  return fmt::format("{:04X} {:04X}h", frame.id >> 16U, frame.id & 0xFFFFU);
}

std::span<const EvidenceFrame> evidence_window(const Finding& finding, std::size_t before,
                                               std::size_t after) {
  const std::span<const EvidenceFrame> evidence = finding.evidence;
  if (evidence.empty()) return evidence;
  const auto decisive = std::ranges::find_if(evidence, &EvidenceFrame::decisive);
  auto at = decisive == evidence.end() ? evidence.size() - 1
                                       : static_cast<std::size_t>(decisive - evidence.begin());
  if (finding.listened && decisive == evidence.end()) {
    while (at > 0 && evidence[at].time > finding.listened->from) --at;
  }
  // Who waits in vain wants to see what came instead.
  if (finding.listened && answer_that_decided(finding) == nullptr) after = std::max(after, least_in_silence);
  const std::size_t first = at > before ? at - before : 0;
  const std::size_t last = std::min(evidence.size(), at + after + 1);
  return evidence.subspan(first, last - first);
}

std::optional<result::Listening> silence_of(const Finding& finding) {
  if (!finding.listened) return std::nullopt;
  auto silence = *finding.listened;
  if (const auto* const decisive = answer_that_decided(finding); decisive != nullptr) {
    // Behind the last of many frames it is silent for a period in any case.
    const EvidenceFrame* before = nullptr;
    for (const EvidenceFrame& frame : finding.evidence) {
      if (&frame == decisive) break;
      if (frame.frame.id == decisive->frame.id && frame.direction == decisive->direction) before = &frame;
    }
    silence.from = std::max(silence.from, decisive->time);
    if (before != nullptr && (silence.until - silence.from) / 2 <= decisive->time - before->time)
      return std::nullopt;
  }
  return silence.until > silence.from ? std::optional(silence) : std::nullopt;
}

std::string silence_words(const CaseResult& one, const Finding& finding) {
  const auto silence = silence_of(finding);
  if (!silence) return {};
  return fmt::format(
      "{} ({} since {})",
      answer_that_decided(finding) != nullptr ? "no more came of it" : "nothing came that was waited for",
      brief_duration(silence->until - silence->from), milliseconds(silence->from - one.begin));
}

std::vector<std::string> byte_rows(ByteView bytes, std::size_t row_size) {
  constexpr std::size_t most = 256;
  if (bytes.size() <= 8) return {hex_bytes(bytes)};
  std::vector<std::string> rows;
  for (std::size_t at = 0; at < std::min(bytes.size(), most); at += row_size) {
    const ByteView part = bytes.subspan(at, std::min(row_size, bytes.size() - at));
    std::string characters;
    for (const std::uint8_t byte : part)
      characters += byte >= 0x20 && byte < 0x7F ? static_cast<char>(byte) : '.';
    rows.push_back(fmt::format("{:04X}h  {}  |{}|", at, pad_right(hex_bytes(part), row_size * 3 - 1),
                               log_safe(characters)));
  }
  if (bytes.size() > most) rows.push_back(fmt::format("... {} bytes more", bytes.size() - most));
  return rows;
}

}  // namespace conform::reports
