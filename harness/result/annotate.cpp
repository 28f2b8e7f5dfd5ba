// SPDX-License-Identifier: Apache-2.0
#include "result/annotate.hpp"

#include "can/capture_marks.hpp"

namespace conform::result {
namespace {

void add(can::Capture& capture, std::size_t index, const std::string& text) {
  if (index >= capture.size()) return;
  if (!capture.frames()[index].comment.contains(text)) capture.comment(index, text);
}

}  // namespace

void annotate(can::Capture& capture, const RunResult& run) {
  for (const auto& one : run.cases) {
    if (!one.finished) continue;
    // A monitor watches the whole run.
    if (one.suite != "monitor" && one.first_frame < one.end_frame) {
      add(capture, one.first_frame, can::to_comment({.name = one.name(), .part = can::CasePart::begin}));
      add(capture, one.end_frame - 1, can::to_comment({.name = one.name(), .part = can::CasePart::end}));
    }
    for (const auto& judgement : one.judgements) {
      for (const auto& finding : judgement.findings) {
        for (const auto& frame : finding.evidence) {
          if (frame.decisive)
            add(capture, frame.capture_index,
                std::string(to_string(finding.verdict)) + " " + finding.requirement + ": " + finding.actual);
        }
      }
    }
  }
}

}  // namespace conform::result
