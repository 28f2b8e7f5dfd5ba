// SPDX-License-Identifier: Apache-2.0
#include "reports/html/timeline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/html/axis.hpp"
#include "reports/html/markup.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {
namespace {

using can::Direction;
using result::CaseResult;
using result::EvidenceFrame;
using result::Finding;

// As on the terminal: what came before explains more than what came after.
constexpr std::size_t frames_before = 14;
constexpr std::size_t frames_after = 6;
constexpr std::size_t meaning_limit = 400;

constexpr double width = 960;
constexpr double left = 62;
constexpr double right = width - 18;
constexpr double host_lane = 30;
constexpr double device_lane = 78;
constexpr double axis_line = 98;
constexpr double height = 122;
constexpr double room_of_label = 13;
constexpr double room_of_silence = 90;
/// A silence that is longer than so many times the frames before it is not drawn to scale, but behind this
/// place.
constexpr int longest_tail = 4;
constexpr double split = left + (right - left) * 0.62;

double ms(Duration duration) { return static_cast<double>(duration.count()) / 1e6; }

bool is_sent(const EvidenceFrame& frame) { return frame.direction == Direction::transmitted; }

/// A triangle that points away from its sender; the frame that decided is ringed as well.
std::string mark(double x, const EvidenceFrame& frame) {
  const double y = is_sent(frame) ? host_lane : device_lane;
  const double tip = is_sent(frame) ? 6 : -6;
  std::string out;
  if (frame.decisive)
    out = fmt::format("<circle class=\"ring\" cx=\"{}\" cy=\"{}\" r=\"10\"/>", coordinate(x), coordinate(y));
  return out + fmt::format("<path class=\"{}\" d=\"M{} {}l10 0l-5 {}z\"/>", is_sent(frame) ? "host" : "dev",
                           coordinate(x - 5), coordinate(y - tip / 2), coordinate(tip));
}

class Drawing {
 public:
  Drawing(const CaseResult& one, const Finding& finding, std::span<const EvidenceFrame> shown)
      : one_(one),
        shown_(shown),
        silence_(silence_of(finding)),
        end_(silence_ ? std::max(silence_->until, shown.back().time) : shown.back().time),
        is_broken_((end_ - shown.back().time) / longest_tail > shown.back().time - shown.front().time),
        scale_(ms(shown.front().time - one.begin), ms((is_broken_ ? shown.back().time : end_) - one.begin),
               left + 8, is_broken_ ? split : right - 8) {}

  [[nodiscard]] std::string draw(const std::string& title_id) const {
    std::string out = fmt::format(
        "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Drawing of the frames in time\">"
        "<svg class=\"lanes\" viewBox=\"0 0 {} {}\" role=\"img\" aria-labelledby=\"{}\"><title id=\"{}\">{} in {} ms, "
        "drawn to scale; the table below says the same</title>\n",
        width, height, title_id, title_id, counted(shown_.size(), "frame"),
        milliseconds(end_ - shown_.front().time));
    out += fmt::format("<text x=\"4\" y=\"{}\">host</text><text x=\"4\" y=\"{}\">device</text>",
                       host_lane + 4, device_lane + 4);
    out += fmt::format("<path class=\"lane\" d=\"M{0} {1}H{2}M{0} {3}H{2}\"/>\n", left, host_lane, right,
                       device_lane);
    out += silence() + exchanges() + marks() + axis();
    return out + "</svg></div>\n";
  }

 private:
  [[nodiscard]] double x_of(const EvidenceFrame& frame) const {
    return scale_.at(ms(frame.time - one_.begin));
  }

  /// The time in which nothing came; its end is off the scale where the frames would be one stroke otherwise.
  [[nodiscard]] std::string silence() const {
    if (!silence_) return {};
    const double from = std::clamp(scale_.at(ms(silence_->from - one_.begin)), left + 8, right - 8);
    const double until = is_broken_ ? right - 8 : scale_.at(ms(silence_->until - one_.begin));
    if (until - from < 1) return {};
    std::string out = fmt::format("<rect class=\"silence\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
                                  coordinate(from), device_lane - 9, coordinate(until - from), 18);
    const double label_from = is_broken_ ? std::max(from, split + 12) : from;
    if (until - label_from >= room_of_silence)
      out += fmt::format("<text class=\"t\" x=\"{}\" y=\"{}\">nothing for {}</text>",
                         coordinate((label_from + until) / 2), device_lane - 13,
                         brief_duration(silence_->until - silence_->from));
    if (is_broken_)
      out += fmt::format(
          "<path class=\"break\" d=\"M{0} {1}l-4 8l8 4l-4 8\"/><text class=\"t\" x=\"{2}\" y=\"{3}\">{4:.3f}</text>",
          split + 14, axis_line - 10, coordinate(until - 14), axis_line + 17, ms(end_ - one_.begin));
    return out + "\n";
  }

  /// From each frame of the host to what the device said next.
  [[nodiscard]] std::string exchanges() const {
    std::string out;
    for (std::size_t i = 1; i < shown_.size(); ++i) {
      if (is_sent(shown_[i - 1]) && !is_sent(shown_[i]))
        out += fmt::format("M{} {}L{} {}", coordinate(x_of(shown_[i - 1])), host_lane + 5,
                           coordinate(x_of(shown_[i])), device_lane - 5);
    }
    return out.empty() ? out : fmt::format("<path class=\"exchange\" d=\"{}\"/>\n", out);
  }

  /// Numbers stand outside the lanes, as many as there is room for; the one that decided always has its own.
  [[nodiscard]] std::string marks() const {
    std::string out;
    std::array<double, 2> taken{-100, -100};
    const auto decided = std::ranges::find_if(shown_, &EvidenceFrame::decisive);
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      const EvidenceFrame& frame = shown_[i];
      const double x = x_of(frame);
      out += mark(x, frame);
      double& last = taken.at(is_sent(frame) ? 0 : 1);
      const bool hides = !frame.decisive && decided != shown_.end() && is_sent(*decided) == is_sent(frame) &&
                         std::abs(x_of(*decided) - x) < room_of_label;
      if ((x - last < room_of_label && !frame.decisive) || hides) continue;
      last = x;
      out += fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\">{}</text>\n", frame.decisive ? "n key" : "n",
                         coordinate(x), is_sent(frame) ? host_lane - 14 : device_lane - 12, i + 1);
    }
    return out;
  }

  [[nodiscard]] std::string axis() const {
    std::string line = fmt::format("M{} {}H{}", left, axis_line, right);
    std::string labels;
    for (const double tick : scale_.ticks(8)) {
      const double x = scale_.at(tick);
      line += fmt::format("M{} {}v4", coordinate(x), axis_line);
      labels +=
          fmt::format("<text class=\"t\" x=\"{}\" y=\"{}\">{:g}</text>", coordinate(x), axis_line + 17, tick);
    }
    return fmt::format("<path class=\"axis\" d=\"{}\"/>{}<text x=\"4\" y=\"{}\">ms</text>\n", line, labels,
                       axis_line + 17);
  }

  const CaseResult& one_;
  std::span<const EvidenceFrame> shown_;
  std::optional<result::Listening> silence_;
  BusTime end_;     ///< of the last frame, or of the silence behind it
  bool is_broken_;  ///< the scale ends with the last frame
  Axis scale_;
};

/// What the bytes of an SDO frame are, where its meaning names the entry that they address: "23 | 03 10 | 01
/// | ...".
std::string bytes_of(const EvidenceFrame& frame) {
  const ByteView bytes = frame.frame.bytes();
  auto plain = fmt::format("<code class=\"bytes\">{}</code>", text(payload_text(frame.frame)));
  if (frame.frame.error || bytes.size() != 8 || !frame.meaning.starts_with("SDO ")) return plain;
  const Multiplexer mux{Index(static_cast<std::uint16_t>(bytes[1] | (bytes[2] << 8U))), SubIndex(bytes[3])};
  if (frame.meaning.find(to_string(mux)) == std::string::npos) return plain;
  const auto part = [](std::string_view what, ByteView some) {
    return fmt::format("<span title=\"{}\">{}</span>", what, hex_bytes(some));
  };
  return fmt::format("<code class=\"bytes sdo\">{} {} {} {}</code>", part("command byte", bytes.first(1)),
                     part("index, low byte first", bytes.subspan(1, 2)),
                     part("sub-index", bytes.subspan(3, 1)),
                     part("data, size or abort code, low byte first", bytes.subspan(4)));
}

std::string row(const CaseResult& one, std::size_t number, const EvidenceFrame& frame, Duration gap) {
  return fmt::format(
      "<tr{}><td>{}{}</td><td class=\"num\">{}</td><td class=\"num\">{}</td><td>{}</td><td><code>{}</code></td><td>{}</td>"
      "<td>{}</td><td class=\"num\">{}</td></tr>\n",
      frame.decisive ? " class=\"key\"" : "", number, frame.decisive ? " <b>decided</b>" : "",
      milliseconds(frame.time - one.begin), number == 1 ? "" : "+" + milliseconds(gap),
      is_sent(frame) ? "host &#x25BC;" : "device &#x25B2;", text(can_id_text(frame.frame)), bytes_of(frame),
      clipped(frame.meaning, meaning_limit), frame_number(frame.capture_index));
}

}  // namespace

std::string frames(const Book& book, const CaseResult& one, const Finding& finding) {
  const std::span<const EvidenceFrame> evidence = finding.evidence;
  if (evidence.empty()) return {};
  const auto shown = evidence_window(finding, frames_before, frames_after);
  const auto before = static_cast<std::size_t>(shown.data() - evidence.data());
  const std::size_t after = evidence.size() - before - shown.size();
  std::string out = Drawing(one, finding, shown).draw(book.fresh_id());
  out +=
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Frames\"><table class=\"frames\"><thead><tr>"
      "<th scope=\"col\">#</th><th scope=\"col\" class=\"num\">ms</th><th scope=\"col\" class=\"num\">gap</th>"
      "<th scope=\"col\">from</th><th scope=\"col\">CAN-ID</th><th scope=\"col\">bytes</th>"
      "<th scope=\"col\">meaning</th><th scope=\"col\" class=\"num\" title=\"number of the frame in the capture of the whole run\">in capture</th></tr></thead><tbody>\n";
  for (std::size_t i = 0; i < shown.size(); ++i)
    out += row(one, i + 1, shown[i], i == 0 ? Duration{} : shown[i].time - shown[i - 1].time);
  if (const auto silence = silence_of(finding))
    out += fmt::format(
        "<tr class=\"silence\"><td>until</td><td class=\"num\">{}</td><td colspan=\"6\">{}</td></tr>\n",
        milliseconds(silence->until - one.begin), text(silence_words(one, finding)));
  out += "</tbody></table></div>\n";
  if (before + after > 0)
    out += fmt::format("<p class=\"quiet\">{} before and {} after these are in the capture of the run.</p>\n",
                       counted(before, "frame"), after);
  return out;
}

}  // namespace conform::reports::html
