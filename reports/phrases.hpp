// SPDX-License-Identifier: Apache-2.0
// What several writers say in the same words: verdicts, findings in one line, frames as text.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "result/run_result.hpp"

namespace conform::reports {

/// Whether only the result and the HTML page tell it: the command line, which names files of the machine. Two
/// runs that say the same have the same console and the same JUnit file, wherever they write them.
[[nodiscard]] bool is_of_the_machine(const result::Property& property);

/// A finding with the case it belongs to and the verdict that counts: the cap of a requirement's level may
/// have made the judgement milder than the finding.
struct LocatedFinding {
  const result::CaseResult* owner = nullptr;
  const result::Finding* finding = nullptr;
  result::Verdict verdict = result::Verdict::fail;
  bool setup = false;  ///< from a step that checks nothing
};

/// Set-up findings first, then those of the judgements in their order.
[[nodiscard]] std::vector<LocatedFinding> findings_of(const result::CaseResult& one);

/// "not applicable" instead of "not_applicable"; the other spellings are the same.
[[nodiscard]] std::string_view verdict_words(result::Verdict verdict);
/// "download 1003h:00 = 02h -> confirmed, expected abort 0609 0030h": sanitised, one line.
[[nodiscard]] std::string headline(const result::Finding& finding);
/// "OD-1014-06 in cia301/x: used (2 cases); ticket FW-12, drives team, until 2027-03-31: firmware 2.1"
[[nodiscard]] std::string waiver_text(const result::WaiverUse& waiver);
/// The headline of the finding that weighs most, its requirement (or "set-up") in front; the case's
/// reason where there is none.
[[nodiscard]] std::string headline(const result::CaseResult& one);
/// A case that the run never came to.
[[nodiscard]] bool is_not_run(const result::CaseResult& one);
/// "file:line:column", as much of it as is known; may be empty.
[[nodiscard]] std::string position_text(const result::SourcePosition& position);
/// What becomes of an answer that no grade of the step names: "fails" and "everything else". A rule that is
/// optional or recommended only warns then, unless the run is strict.
struct Otherwise {
  std::string_view label, words;
};
[[nodiscard]] Otherwise otherwise_of(const result::RunResult& run, const result::Finding& finding);

/// "conditional" or "no level given".
[[nodiscard]] std::string level_text(const result::RequirementInfo* info);

/// The frame as can-utils write it: "603#2F03100002000000", "000#R8", "12345678#".
[[nodiscard]] std::string candump_frame(const can::Frame& frame);
/// A line of a log file of can-utils: "(0000000000.012345) can0 603#2F03100002000000".
[[nodiscard]] std::string candump_line(const result::EvidenceFrame& one, std::string_view interface_name);
/// The value of property can.interface as can-utils can read it, else "can0".
[[nodiscard]] std::string interface_name(const result::RunResult& run);
/// "2F 03 10 00 02 00 00 00", "remote, 8 bytes asked for", "error frame 00000004h 00 00 ..."
[[nodiscard]] std::string payload_text(const can::Frame& frame);
/// "603h"; identifiers of 29 bits are written as such whatever their value.
[[nodiscard]] std::string can_id_text(const can::Frame& frame);

/// The part of the evidence worth printing: frames around the decisive one; if none is, those before and
/// behind the moment from which the step waited, or else the last.
[[nodiscard]] std::span<const result::EvidenceFrame> evidence_window(const result::Finding& finding,
                                                                     std::size_t before, std::size_t after);
/// How long a step waited for what did not come: from the decisive frame, or else from when it began to wait.
/// None: it did not wait, or what came says it all.
[[nodiscard]] std::optional<result::Listening> silence_of(const result::Finding& finding);
/// "nothing came that was waited for (700 ms since 833.466)": times in ms since the case began.
[[nodiscard]] std::string silence_words(const result::CaseResult& one, const result::Finding& finding);
/// Rows of `row_size` bytes with offset and characters; one plain row up to eight bytes. At most 256 bytes
/// are shown.
[[nodiscard]] std::vector<std::string> byte_rows(ByteView bytes, std::size_t row_size = 16);

}  // namespace conform::reports
