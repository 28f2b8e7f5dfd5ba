// SPDX-License-Identifier: Apache-2.0
// One finding as a card: written for somebody who knows the device and the standard, and has never seen this
// tool.
#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/console.hpp"
#include "reports/paint.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports {
namespace {

using result::CaseResult;
using result::EvidenceFrame;
using result::Finding;
using result::RequirementInfo;
using result::Verdict;

constexpr std::size_t label_width = 13;
// A device may send a string of a megabyte. Three lines of title and ten of a value are enough to recognise
// it.
constexpr std::size_t title_lines = 3;
constexpr std::size_t value_lines = 10;
constexpr std::size_t frames_before = 10;
constexpr std::size_t frames_after = 4;

/// Draws the lines of a card behind its left edge.
class Card {
 public:
  explicit Card(const Style& style) : style_(style), width_(std::max<std::size_t>(style.width, 60)) {}

  void title(Verdict verdict, std::string_view text) {
    const std::string label = verdict == Verdict::fail ? "FAIL" : lower(verdict_words(verdict));
    bool first = true;
    const std::size_t room = width_ - label.size() - 2;
    for (const std::string& line : wrap(clip(text, title_lines * room), room)) {
      const std::string front =
          first ? paint(label + ":", ink_of(verdict), style_) : std::string(label.size() + 1, ' ');
      out_ += front + " " + paint(line, Ink::strong, style_) + "\n";
      first = false;
    }
  }
  void arrow(std::string_view text) {
    if (text.empty()) return;
    out_ += paint("  -->", Ink::hint, style_);
    out_ += ' ';
    out_ += clip_front(text, title_lines * width_);
    out_ += '\n';
  }
  void gap() { raw({}); }
  /// A line that keeps its blanks.
  void raw(std::string_view text, std::string_view edge = "  |", Ink ink = Ink::hint) {
    out_ += paint(edge, ink, style_);
    if (!text.empty()) out_ += ' ';
    out_ += text;
    out_ += '\n';
  }
  /// "label   value", the value wrapped under itself.
  void row(std::string_view label, std::string_view value, Ink ink = Ink::plain) {
    if (value.empty()) return;
    bool first = true;
    const std::size_t room = width_ - label_width - 4;
    for (const std::string& line : wrap(clip(value, value_lines * room), room)) {
      raw(paint(pad_right(first ? label : "", label_width), Ink::dim, style_) + paint(line, ink, style_));
      first = false;
    }
  }
  void rows(std::string_view label, const std::vector<std::string>& values, Ink ink) {
    for (const std::string& value : values) {
      row(label, log_safe(value), ink);
      label = "";
    }
  }
  /// Rows that must not be wrapped, such as bytes in columns.
  void fixed(std::string_view label, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      raw(paint(pad_right(label, label_width), Ink::dim, style_) + line);
      label = "";
    }
  }
  [[nodiscard]] const Style& style() const { return style_; }
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  const Style& style_;
  std::size_t width_;
  std::string out_;
};

void draw_requirement(Card& card, const result::RunResult& run, const CaseResult& one,
                      const Finding& finding) {
  if (finding.requirement.empty()) {
    card.row("rule", "none: this step only prepares the case");
  } else {
    const RequirementInfo* info = run.requirement(finding.requirement);
    std::string heading = log_safe(finding.requirement);
    if (info != nullptr && !info->clause.empty()) heading += ", " + prose(info->clause);
    if (info != nullptr && !info->level.empty()) heading += " (" + prose(info->level) + ")";
    card.row("rule", heading, Ink::strong);
    if (info != nullptr) card.row("", prose(info->statement));
  }
  card.row("case", log_safe(one.name()));
  card.row("", prose(one.title));
  card.row("during", log_safe(finding.during));
  if (!one.cct.empty()) card.row("CCT case", log_safe(join(one.cct, ", ")));
}

void draw_grades(Card& card, const result::RunResult& run, const Finding& finding, Verdict verdict) {
  card.gap();
  card.row("before", log_safe(join(finding.prepared, "; ")));
  card.row("step", log_safe(finding.step));
  if (!finding.accepts.empty() || !finding.tolerates.empty()) {
    card.rows("passes", finding.accepts, Ink::good);
    card.rows("tolerated", finding.tolerates, Ink::doubtful);
    const auto [label, words] = otherwise_of(run, finding);
    card.row(label, words);
  }
  card.row("came", log_safe(finding.actual), ink_of(verdict));
  if (!finding.actual_bytes.empty()) {
    card.fixed(finding.actual.empty() ? "came" : "",
               byte_rows(finding.actual_bytes, card.width() < 92 ? 8 : 16));
  }
  card.row("why", prose(finding.reason));
  card.row("described", log_safe(finding.declared_at));
}

void draw_frames(Card& card, const CaseResult& one, const Finding& finding) {
  if (finding.evidence.empty()) return;
  const auto shown = evidence_window(finding, frames_before, frames_after);
  const auto silence = silence_of(finding);
  std::size_t id_width = 4;
  std::size_t data_width = 0;
  std::size_t time_width = 9;
  for (const EvidenceFrame& frame : shown) {
    id_width = std::max(id_width, columns(can_id_text(frame.frame)));
    data_width = std::max(data_width, columns(payload_text(frame.frame)));
    time_width = std::max(time_width, columns(milliseconds(frame.time - one.begin)));
  }
  if (silence) time_width = std::max(time_width, columns(milliseconds(silence->until - one.begin)));
  card.gap();
  card.row("frames", "ms since the case began, > to the device, < from the device");
  const auto left_out = [&](std::size_t count, std::string_view where) {
    if (count != 0) card.raw(fmt::format("  ... {} {}", counted(count, "frame"), where));
  };
  const auto first = static_cast<std::size_t>(shown.data() - finding.evidence.data());
  left_out(first, "before");
  for (const EvidenceFrame& frame : shown) {
    const bool sent = frame.direction == can::Direction::transmitted;
    const std::string front = fmt::format(
        "{} {} {}  {}", pad_left(milliseconds(frame.time - one.begin), time_width), sent ? '>' : '<',
        pad_right(can_id_text(frame.frame), id_width), payload_text(frame.frame));
    const std::size_t front_width = columns(front) - columns(payload_text(frame.frame)) + data_width;
    // The meaning goes beside the bytes where there is room for it, below them otherwise.
    const bool beside = front_width + 32 <= card.width() && !frame.meaning.empty();
    const std::size_t indent = beside ? front_width + 2 : time_width + 3;
    const auto meaning = wrap(clip(log_safe(frame.meaning), value_lines * 20), card.width() - indent - 6);
    const Ink ink = frame.decisive ? Ink::strong : Ink::plain;
    std::string line = front;
    if (beside) line = fmt::format("{}  {}", pad_right(front, front_width), meaning.front());
    line = paint(line, ink, card.style());
    card.raw(line, frame.decisive ? " =>" : "  |", frame.decisive ? Ink::bad : Ink::hint);
    for (std::size_t i = beside ? 1 : 0; i < meaning.size() && !frame.meaning.empty(); ++i) {
      card.raw(std::string(indent, ' ') + paint(meaning[i], ink, card.style()));
    }
  }
  left_out(finding.evidence.size() - first - shown.size(), "after");
  if (silence) {
    std::string front = pad_left(milliseconds(silence->until - one.begin), time_width) + "   ";
    for (const std::string& line : wrap(silence_words(one, finding), card.width() - time_width - 7)) {
      card.raw(front + line);
      front.assign(time_width + 3, ' ');
    }
  }
  if (std::ranges::any_of(shown, &EvidenceFrame::decisive)) {
    card.raw(paint("=> marks the frame that decided the verdict", Ink::dim, card.style()));
  }
}

}  // namespace

std::string finding_card(const result::RunResult& run, const CaseResult& one, const Finding& finding,
                         const Style& style) {
  // The cap of the level counts: what a recommendation finds is a warning, whatever the step said.
  Verdict verdict = finding.verdict;
  for (const LocatedFinding& located : findings_of(one)) {
    if (located.finding == &finding) verdict = located.verdict;
  }
  Card card(style);
  const std::string front = finding.requirement.empty() ? "set-up" : log_safe(finding.requirement);
  card.title(verdict, fmt::format("{}: {}", front, headline(finding)));
  const std::string position = position_text(finding.position);
  card.arrow(position.empty() ? position_text(one.position) : position);
  card.gap();
  draw_requirement(card, run, one, finding);
  draw_grades(card, run, finding, verdict);
  draw_frames(card, one, finding);
  return card.take();
}

}  // namespace conform::reports
