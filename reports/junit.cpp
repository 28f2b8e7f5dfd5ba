// SPDX-License-Identifier: Apache-2.0
#include "reports/junit.hpp"

#include <algorithm>
#include <array>
#include <locale>
#include <map>
#include <set>
#include <span>
#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "base/text.hpp"
#include "reports/cause_lines.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"
#include "result/properties.hpp"

namespace conform::reports {
namespace {

using result::CaseResult;
using result::EvidenceFrame;
using result::Finding;
using result::RequirementInfo;
using result::RunResult;
using result::Verdict;

// Azure cuts names at 512 characters, lists are unreadable long before; a message is one line of an
// annotation.
constexpr std::size_t name_limit = 200;
constexpr std::size_t message_limit = 250;
// libxml2 refuses text nodes of 10 MB and Jenkins keeps 100 000 characters: nobody misses what is cut here.
constexpr std::size_t text_limit = std::size_t{64} * 1024;
constexpr std::string_view fallback_suite = "canopen-conform";

// Every string enters the document through these two: pugixml writes control characters and broken UTF-8 as
// they are.
void set(pugi::xml_node node, const char* name, std::string_view value) {
  node.append_attribute(name).set_value(printable(value).c_str());
}
void set_text(pugi::xml_node node, std::string_view text) {
  node.text().set(clip_bytes(printable(text, true), text_limit).c_str());
}

/// "cia301/dictionary/1003-error-history" as class name. Jenkins splits at the last dot and GitLab shows it
/// as the suite, so a dot only ever stands for a level of the path.
std::string dotted(std::string_view path) {
  std::string out;
  for (const char c : path) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    if (c != '/') {
      out += plain ? c : '_';
    } else if (!out.empty() && out.back() != '.') {
      out += '.';
    }
  }
  if (out.ends_with('.')) out.pop_back();
  return out.empty() ? std::string(fallback_suite) : out;
}

std::string with_prefix(const std::string& class_name, const JUnitOptions& options) {
  return options.class_prefix.empty() ? class_name : dotted(options.class_prefix) + "." + class_name;
}

/// What one <testsuite> is made of.
struct Suite {
  std::string class_name;
  std::vector<const CaseResult*> cases;
};

std::vector<Suite> suites_of(const RunResult& run, const JUnitOptions& options) {
  std::vector<Suite> suites;
  for (const CaseResult& one : run.cases) {
    std::string name = dotted(one.suite);
    name = with_prefix(name, options);
    auto suite = std::ranges::find(suites, name, &Suite::class_name);
    if (suite == suites.end()) suite = suites.insert(suites.end(), {std::move(name), {}});
    suite->cases.push_back(&one);
  }
  return suites;
}

/// "non-zero-write[02h] A value other than 00h cannot be written": stable between runs, unique in its class.
std::string case_name(const CaseResult& one, std::set<std::string>& taken) {
  std::string key = one.name();
  if (!one.suite.empty() && key.starts_with(one.suite + "/")) key.erase(0, one.suite.size() + 1);
  std::string name = printable(key);
  const std::string title = prose(one.title);
  if (!title.empty()) name += fmt::format(" {}", title);
  name = clip(name, name_limit);
  std::string unique = name;
  for (int i = 2; !taken.insert(unique).second; ++i) {
    const std::string suffix = fmt::format(" ({})", i);
    unique = clip(name, name_limit - suffix.size()) + suffix;
  }
  return unique;
}

/// Lines of "label   value", the label only on the first.
class Sheet {
 public:
  void line(std::string_view text = {}) { (text_ += text) += '\n'; }
  void row(std::string_view label, std::string_view value) {
    if (!value.empty()) line(fmt::format("{:<12}{}", label, value));
  }
  void rows(std::string_view label, const std::vector<std::string>& values) {
    for (const std::string& value : values) {
      row(label, log_safe(value));
      label = "";
    }
  }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void write_frames(Sheet& sheet, const RunResult& run, const CaseResult& one, const Finding& finding) {
  const auto evidence = evidence_window(finding, 60, 20);
  if (evidence.empty()) return;
  sheet.line();
  sheet.line("Frames (> to the device, < from the device, => decided the verdict)");
  const std::string interface = interface_name(run);
  for (const EvidenceFrame& frame : evidence) {
    const bool sent = frame.direction == can::Direction::transmitted;
    std::string text = fmt::format("{} {} {}", frame.decisive ? "=>" : "  ", candump_line(frame, interface),
                                   sent ? ">" : "<");
    if (!frame.meaning.empty()) text += fmt::format(" {}", log_safe(frame.meaning));
    sheet.line(text);
  }
  if (const auto silence = silence_of(finding))
    sheet.line(fmt::format("until {} ms of the case {}", milliseconds(silence->until - one.begin),
                           silence_words(one, finding)));
}

void write_finding(Sheet& sheet, const RunResult& run, const LocatedFinding& located) {
  const Finding& finding = *located.finding;
  sheet.row("Verdict", verdict_words(located.verdict));
  if (finding.requirement.empty()) {
    sheet.row("Requirement", located.setup ? "none: a step of the set-up" : "none");
  } else {
    const RequirementInfo* info = run.requirement(finding.requirement);
    sheet.row("Requirement", fmt::format("{} ({})", log_safe(finding.requirement), level_text(info)));
    if (info != nullptr) {
      sheet.row("Clause", prose(info->clause));
      sheet.row("Statement", prose(info->statement));
    }
  }
  sheet.row("During", log_safe(finding.during));
  sheet.row("Described", log_safe(finding.declared_at));
  sheet.row("Before", log_safe(join(finding.prepared, "; ")));
  sheet.row("Step", log_safe(finding.step));
  sheet.rows("Passes", finding.accepts);
  sheet.rows("Tolerated", finding.tolerates);
  const bool graded = !finding.requirement.empty() && !(finding.accepts.empty() && finding.tolerates.empty());
  if (const auto [label, words] = otherwise_of(run, finding); graded)
    sheet.row(label == "fails" ? "Fails" : "Warns", words);
  sheet.row("Came", log_safe(finding.actual));
  if (!finding.actual_bytes.empty()) sheet.rows("Bytes", byte_rows(finding.actual_bytes));
  sheet.row("Why", prose(finding.reason));
  write_frames(sheet, run, *located.owner, finding);
}

/// The first line is the message again (GitLab shows no attribute), the last one the position in the
/// scenario.
std::string details(const RunResult& run, const JUnitOptions& options, const CaseResult& one,
                    std::string_view message) {
  Sheet sheet;
  sheet.line(message);
  sheet.line();
  sheet.row("Case", printable(one.name()));
  if (one.verdict != Verdict::fail) sheet.row("Reason", prose(one.reason));
  sheet.row("Tried", prose(one.tried));
  if (!one.cct.empty()) sheet.row("CCT case", log_safe(join(one.cct, ", ")));
  const std::vector<LocatedFinding> all = findings_of(one);
  for (const LocatedFinding& located : all) {
    sheet.line();
    write_finding(sheet, run, located);
  }
  const auto worst = std::ranges::max_element(all, {}, &LocatedFinding::verdict);
  const bool known = worst != all.end() && !worst->finding->position.file.empty();
  const std::string position = position_text(known ? worst->finding->position : one.position);
  std::string text =
      clip_bytes(sheet.take(), text_limit - position.size() - options.source_prefix.size() - 256);
  if (!position.empty()) text += fmt::format("\n{}{}", printable(options.source_prefix), position);
  return text;
}

/// The weightiest level among the requirements that failed.
std::string failure_type(const RunResult& run, const CaseResult& one) {
  constexpr std::array<std::string_view, 4> levels{"mandatory", "conditional", "optional", "recommended"};
  std::size_t best = levels.size();
  for (const result::Judgement& judgement : one.judgements) {
    const RequirementInfo* info = run.requirement(judgement.requirement);
    if (judgement.verdict != Verdict::fail || info == nullptr) continue;
    const auto level = static_cast<std::size_t>(std::ranges::find(levels, info->level) - levels.begin());
    best = std::min(best, level);
  }
  return best < levels.size() ? std::string(levels[best]) : "unclassified";
}

std::string error_type(const CaseResult& one) {
  if (is_not_run(one)) return "not-run";
  return one.verdict == Verdict::inconclusive ? "inconclusive" : "environment";
}

/// Plain lines for canplayer, cansend and Wireshark: the frames of all findings once, in the order of the
/// bus.
std::string evidence_log(const RunResult& run, const CaseResult& one) {
  std::map<std::size_t, const EvidenceFrame*> frames;
  const std::vector<LocatedFinding> all = findings_of(one);
  for (const LocatedFinding& located : all) {
    for (const EvidenceFrame& frame : evidence_window(*located.finding, 150, 50)) {
      frames.emplace(frame.capture_index, &frame);
    }
  }
  constexpr std::size_t most = 200;
  std::string text;
  const std::string interface = interface_name(run);
  std::size_t left = frames.size();
  for (const auto& [index, frame] : frames) {
    if (left-- <= most) text += candump_line(*frame, interface) + "\n";
  }
  return text;
}

std::string message_of(const RunResult& run, const CauseOfCase& causes, const CaseResult& one) {
  const std::string cause = consequence_words(causes, one);
  std::string text = cause.empty() ? headline(one) : cause + ": " + headline(one);
  if (is_not_run(one) && run.aborted) text += ": " + prose(*run.aborted);
  return clip_bytes(text, message_limit);
}

void write_outcome(pugi::xml_node parent, const char* element, std::string_view type,
                   std::string_view message, std::string_view text) {
  pugi::xml_node node = parent.append_child(element);
  if (!type.empty()) set(node, "type", type);
  set(node, "message", message);
  set_text(node, text);
}

void write_case(pugi::xml_node parent, const RunResult& run, const JUnitOptions& options,
                const CauseOfCase& causes, const CaseResult& one, std::string_view class_name,
                std::set<std::string>& taken) {
  pugi::xml_node node = parent.append_child("testcase");
  set(node, "classname", class_name);
  set(node, "name", case_name(one, taken));
  set(node, "time", seconds(one.end - one.begin));
  const std::string message = message_of(run, causes, one);
  switch (one.verdict) {
    case Verdict::pass:
      if (!one.tried.empty())
        set_text(node.append_child("system-out"), fmt::format("tried {}\n", prose(one.tried)));
      return;
    case Verdict::waived:
    case Verdict::warn: {
      const std::string text = details(run, options, one, message);
      set_text(node.append_child("system-out"),
               fmt::format("{}: {}\n\n{}", one.verdict == Verdict::warn ? "warning" : "waived", text,
                           evidence_log(run, one)));
      return;
    }
    case Verdict::not_applicable: write_outcome(node, "skipped", "", message, message); return;
    case Verdict::fail:
      write_outcome(node, "failure", failure_type(run, one), message, details(run, options, one, message));
      break;
    case Verdict::inconclusive:
    case Verdict::error:
      write_outcome(node, "error", error_type(one), message, details(run, options, one, message));
      break;
  }
  const std::string log = evidence_log(run, one);
  if (!log.empty()) set_text(node.append_child("system-out"), log);
}

void write_properties(pugi::xml_node parent, const RunResult& run) {
  pugi::xml_node node = parent.append_child("properties");
  const auto add = [&](std::string_view name, std::string_view value) {
    pugi::xml_node property = node.append_child("property");
    set(property, "name", name);
    set(property, "value", value);
  };
  const auto add_own = [&](std::string_view name, std::string_view value) {
    if (result::value_of(run, name) == nullptr) add(name, value);
  };
  add_own("run.tool", run.tool);
  add_own("dut.name", run.device);
  for (const result::Property& property : run.properties) {
    if (!is_of_the_machine(property)) add(property.name, property.value);
  }
  for (std::size_t i = 0; i < run.notes.size(); ++i)
    add(fmt::format("run.note.{}", i + 1), prose(run.notes[i]));
  for (std::size_t i = 0; i < run.waivers.size(); ++i)
    add(fmt::format("run.waiver.{}", i + 1), waiver_text(run.waivers[i]));
  if (run.aborted) add("run.aborted", prose(*run.aborted));
}

struct Numbers {
  std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;
};

void write_numbers(pugi::xml_node node, const Numbers& numbers) {
  set(node, "tests", fmt::format("{}", numbers.tests));
  set(node, "failures", fmt::format("{}", numbers.failures));
  set(node, "errors", fmt::format("{}", numbers.errors));
}

Numbers numbers_of(std::span<const CaseResult* const> cases) {
  Numbers numbers;
  for (const CaseResult* one : cases) {
    ++numbers.tests;
    numbers.failures += one->verdict == Verdict::fail ? 1U : 0U;
    numbers.errors += one->verdict == Verdict::error || one->verdict == Verdict::inconclusive ? 1U : 0U;
    numbers.skipped += one->verdict == Verdict::not_applicable ? 1U : 0U;
  }
  return numbers;
}

pugi::xml_node begin_suite(pugi::xml_node root, const RunResult& run, std::string_view name,
                           const Numbers& numbers, Duration time, Duration since_start) {
  pugi::xml_node node = root.append_child("testsuite");
  set(node, "name", name);
  write_numbers(node, numbers);
  set(node, "skipped", fmt::format("{}", numbers.skipped));
  set(node, "time", seconds(time));
  set(node, "timestamp", utc_timestamp(run.started_utc_ns + since_start.count()));
  set(node, "hostname", run.host);
  return node;
}

void write_suite(pugi::xml_node root, const RunResult& run, const JUnitOptions& options,
                 const CauseOfCase& causes, const Suite& suite) {
  Duration time{};
  for (const CaseResult* one : suite.cases) time += std::max(one->end - one->begin, Duration{});
  // Cases that were not run have no time of their own; the suite then starts with the run.
  const auto ran = std::ranges::find_if(suite.cases, [](const CaseResult* one) { return !is_not_run(*one); });
  const Duration since_start =
      ran == suite.cases.end() ? Duration{} : std::max((*ran)->begin - run.cases.front().begin, Duration{});
  pugi::xml_node node = begin_suite(root, run, suite.class_name, numbers_of(suite.cases), time, since_start);
  const std::string& file = suite.cases.front()->position.file;
  if (!file.empty()) set(node, "file", options.source_prefix + file);
  write_properties(node, run);
  std::set<std::string> taken;
  for (const CaseResult* one : suite.cases)
    write_case(node, run, options, causes, *one, suite.class_name, taken);
}

/// Of a run without cases: it is one error.
constexpr Numbers of_empty_run{1, 0, 1, 0};

void write_empty_run(pugi::xml_node root, const RunResult& run, const JUnitOptions& options) {
  const auto name = with_prefix(std::string(fallback_suite), options);
  pugi::xml_node node = begin_suite(root, run, name, of_empty_run, run.elapsed, {});
  write_properties(node, run);
  pugi::xml_node only = node.append_child("testcase");
  set(only, "classname", name);
  set(only, "name", "run");
  set(only, "time", seconds(run.elapsed));
  const std::string message = clip_bytes(
      run.aborted ? prose(*run.aborted) : "nothing was selected: no case was planned", message_limit);
  write_outcome(only, "error", run.aborted ? "environment" : "not-run", message, message);
}

Numbers numbers_of(const RunResult& run) {
  if (run.cases.empty()) return of_empty_run;
  std::vector<const CaseResult*> all;
  for (const CaseResult& one : run.cases) all.push_back(&one);
  return numbers_of(all);
}

pugi::xml_node begin_document(pugi::xml_document& document, const std::string& name) {
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  set(declaration, "version", "1.0");
  set(declaration, "encoding", "UTF-8");
  pugi::xml_node root = document.append_child("testsuites");
  set(root, "name", name);
  return root;
}

void write_run(pugi::xml_node root, const RunResult& run, const JUnitOptions& options) {
  const auto causes = result::causes_of(run);
  const auto by_case = causes_by_case(causes);
  for (const Suite& suite : suites_of(run, options)) write_suite(root, run, options, by_case, suite);
  if (run.cases.empty()) write_empty_run(root, run, options);
}

std::string text_of(const pugi::xml_document& document) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  document.save(out, "  ", pugi::format_indent, pugi::encoding_utf8);
  return std::move(out).str();
}

}  // namespace

std::string junit(const RunResult& run, const JUnitOptions& options) {
  pugi::xml_document document;
  auto root = begin_document(document, run.device.empty() ? run.tool : run.tool + ": " + run.device);
  write_numbers(root, numbers_of(run));
  set(root, "time", seconds(run.elapsed));
  write_run(root, run, options);
  return text_of(document);
}

std::string junit_of_several(std::span<const JUnitDevice> devices) {
  pugi::xml_document document;
  auto root = begin_document(document, counted(devices.size(), "device"));
  Numbers numbers;
  Duration elapsed{};
  for (const auto& each : devices) {
    const auto of_device = numbers_of(*each.run);
    numbers.tests += of_device.tests;
    numbers.failures += of_device.failures;
    numbers.errors += of_device.errors;
    elapsed += each.run->elapsed;
  }
  write_numbers(root, numbers);
  set(root, "time", seconds(elapsed));
  for (const auto& each : devices) write_run(root, *each.run, each.options);
  return text_of(document);
}

}  // namespace conform::reports
