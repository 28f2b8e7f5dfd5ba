// SPDX-License-Identifier: Apache-2.0
#include "cli/replay/replay_text.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "can/capture_marks.hpp"
#include "reports/paint.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"

namespace conform::cli {
namespace {

using reports::Ink;

constexpr std::string_view indent = "           ";
/// Of a stretch of exchanges that are the same as many are shown at its beginning.
constexpr std::size_t shown_of_stretch = 8;

std::string judged(bool differs, const reports::Style& style) {
  return differs ? paint("differs", Ink::bad, style) + "  " : paint("same", Ink::good, style) + "     ";
}

/// "step 3: upload 1003h:00"
std::string heading_of(const can::CaseMark& mark) {
  using Part = can::CasePart;
  switch (mark.part) {
    case Part::preparation: return "preparation";
    case Part::putting_back: return "putting back";
    case Part::step:
    case Part::cleanup: {
      const auto* const what = mark.part == Part::step ? "step" : "cleanup";
      return fmt::format("{} {}{}{}", what, mark.number, mark.words.empty() ? "" : ": ",
                         printable(mark.words));
    }
    default: return {};
  }
}

/// What begins with frames of the old capture: it may begin with one that was not sent.
class Headings {
 public:
  explicit Headings(const Side& then) : then_(then), at_(then.first) {}
  /// The heading that holds for this frame, if it is a new one.
  [[nodiscard]] std::string up_to(std::size_t index) {
    std::string out;
    for (; at_ <= index; ++at_) {
      for (const auto& mark : can::case_marks(then_.at(at_).comment.view())) {
        if (auto text = heading_of(mark); !text.empty()) out = std::move(text);
      }
    }
    return out;
  }

 private:
  const Side& then_;
  std::size_t at_;
};

std::string answer_line(std::string_view when, const Side& side, std::optional<std::size_t> answer,
                        std::size_t sent) {
  if (!answer) return fmt::format("{}{:<5} nothing\n", indent, when);
  const auto& captured = side.at(*answer);
  return fmt::format("{}{:<5} {}  {}, after {}\n", indent, when, reports::payload_text(captured.frame),
                     printable(side.meaning(*answer)),
                     reports::brief_duration(captured.time - side.at(sent).time));
}

std::string fields_line(const std::vector<canopen::FieldDifference>& fields) {
  std::vector<std::string> parts;
  for (const auto& field : fields) {
    parts.push_back(fmt::format("{} {} -> {}", field.name, field.before.empty() ? "none" : field.before,
                                field.after.empty() ? "none" : field.after));
  }
  return fmt::format("{}field {}\n", indent, join(parts, "; "));
}

std::string sent_words(const Side& then, const Exchange& exchange) {
  const auto& frame = then.at(exchange.then).frame;
  return fmt::format("frame {}  {}  {}  {}", exchange.then + 1, reports::can_id_text(frame),
                     reports::payload_text(frame), printable(then.meaning(exchange.then)));
}

std::string exchange_text(const Exchange& exchange, const Side& then, const Side& now,
                          const reports::Style& style) {
  std::string out = fmt::format("  {}{}\n", judged(exchange.differs(), style), sent_words(then, exchange));
  if (!exchange.now) out += fmt::format("{}not sent: the transfer was over\n", indent);
  for (const auto& answer : exchange.answers) {
    if (!answer.differs) {
      const auto why =
          answer.not_compared.empty() ? "" : fmt::format(" (not compared: {})", answer.not_compared);
      out += fmt::format("{}both  {}  {}{}\n", indent, reports::payload_text(then.at(*answer.then).frame),
                         printable(then.meaning(*answer.then)), why);
      continue;
    }
    out += answer_line("then", then, answer.then, exchange.then);
    out += answer_line("now", now, answer.now, *exchange.now);
    if (!answer.fields.empty()) out += fields_line(answer.fields);
  }
  return out;
}

std::string unasked_text(const Unasked& each, const reports::Style& style) {
  std::string out = fmt::format("  {}{}: {} then, {} now{}\n", judged(!each.differences.empty(), style),
                                printable(each.kind), each.then, each.now,
                                each.not_compared.empty() ? "" : "; not compared: " + each.not_compared);
  for (const auto& difference : each.differences) out += fmt::format("{}{}\n", indent, printable(difference));
  return out;
}

}  // namespace

std::string replay_text(const ReplayComparison& comparison, const Side& then, const Side& now,
                        const reports::Style& style, bool quiet) {
  std::string out;
  Headings headings(then);
  std::string heading;
  std::size_t stretch = 0, skipped = 0;
  const auto end_stretch = [&] {
    if (stretch > shown_of_stretch)
      out += fmt::format("{}... and {} more that are the same\n", indent, stretch - shown_of_stretch);
    stretch = 0;
  };
  for (const auto& exchange : comparison.exchanges) {
    if (auto next = headings.up_to(exchange.then); !next.empty()) {
      end_stretch();
      heading = std::move(next);
    }
    const bool differs = exchange.differs();
    if (quiet && !differs) continue;
    if (differs) end_stretch();
    // One of many segments says it all.
    if (!exchange.now && ++skipped > 1) continue;
    if (!heading.empty()) out += paint(std::exchange(heading, {}), Ink::strong, style) + "\n";
    if (!differs && ++stretch > shown_of_stretch) continue;
    out += exchange_text(exchange, then, now, style);
  }
  end_stretch();
  std::string unasked;
  for (const auto& each : comparison.unasked) {
    if (!quiet || !each.differences.empty()) unasked += unasked_text(each, style);
  }
  if (!unasked.empty()) out += paint("what came unasked", Ink::strong, style) + "\n" + unasked;
  return out;
}

std::string replay_summary(const ReplayComparison& comparison) {
  if (!comparison.compares_something())
    return "nothing was compared: the device sent nothing in these frames then, and sends nothing now";
  const auto all = comparison.exchanges.size(), differ = comparison.exchanges_that_differ();
  std::string out = differ == 0
                        ? fmt::format("{} with the same answers", reports::counted(all, "frame"))
                        : fmt::format("{} of {} answered otherwise", differ, reports::counted(all, "frame"));
  if (const auto unasked = comparison.unasked_that_differ(); unasked > 0)
    out += fmt::format("; {} of frames that come unasked {}", reports::counted(unasked, "kind"),
                       unasked == 1 ? "differs" : "differ");
  return (comparison.differs() ? "differs: " : "same: ") + out;
}

}  // namespace conform::cli
