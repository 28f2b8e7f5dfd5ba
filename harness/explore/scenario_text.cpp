// SPDX-License-Identifier: Apache-2.0
#include "explore/scenario_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"

namespace conform::explore {
namespace {

using namespace std::chrono_literals;
using What = Difference::What;

/// A scenario waits this much longer than the frame took here: its steps take their time, too.
constexpr Duration margin = 50ms;
/// ... and where a later frame of the kind may come anyway.
constexpr Duration close_margin = 10ms;

/// What the scenarios of the suite call a quick answer.
constexpr Duration soon = 100ms;

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string can_id(std::uint32_t id) { return hex(id, id > 0x7FF ? 8 : 3); }

std::string outcome(const Answer& answer, bool upload) {
  switch (answer.kind) {
    case Answer::Kind::confirmed:
      return upload ? fmt::format("{{bytes: {}}}", quoted(hex_bytes(answer.data))) : "ok";
    case Answer::Kind::aborted: return "abort " + to_string(answer.code);
    case Answer::Kind::silence: return "silence";
    // The model itself aborts about another object.
    case Answer::Kind::violation: return "[abort any, silence]";
    default: return "ok";
  }
}

class Writer {
 public:
  Writer(const Finding& finding, const Vocabulary& words) : finding_(finding), words_(words) {}

  std::string steps() {
    const auto& difference = *finding_.played.difference;
    const auto end = last_that_acts();
    for (std::size_t i = 0; i < end; ++i) {
      const bool judges = i + 1 == finding_.conversation.size() && difference.is_about_an_answer();
      act(finding_.conversation[i], i, judges);
    }
    if (difference.is_about_a_frame()) await(difference);
    if (difference.what == What::gone) {
      add("- nmt: reset node");
      add("- boot_up: {within: $profile.boot_time}");
      check();
    }
    if (difference.what == What::rule) {
      // The monitors of every run judge the frames: this lets them see the last ones, and names the rule
      // with a step that whatever comes passes.
      add(fmt::format("- wait: {}", to_string(rest_from(end) + margin)));
      add("- upload: {object: 1000h:00}");
      check();
      add("  expect: [ok, abort any, silence]");
    }
    return out_;
  }

 private:
  void add(std::string_view line) { out_ += fmt::format("      {}\n", line); }
  void check() {
    if (finding_.assigned) add(fmt::format("  checks: {}", finding_.assigned->requirement));
  }

  /// A window of frames begins with the last action that sends; what only waits is part of the window.
  [[nodiscard]] std::size_t last_that_acts() const {
    auto end = finding_.conversation.size();
    if (finding_.played.difference->what == What::answer) return end;
    while (end > 0 && finding_.conversation[end - 1].kind == Action::Kind::wait) --end;
    return end;
  }

  [[nodiscard]] Duration rest_from(std::size_t end) const {
    Duration out{};
    for (auto i = end; i < finding_.conversation.size(); ++i) out += finding_.conversation[i].time;
    return out;
  }

  /// Frames with this CAN-ID that agreed, between the beginning of the window and the one that did not.
  [[nodiscard]] std::size_t before(const can::Frame& frame) const {
    const auto end = last_that_acts();
    const auto& played = finding_.played;
    if (end == 0 || end > played.begins.size()) return 0;
    return static_cast<std::size_t>(std::ranges::count_if(played.trace, [&](const can::CapturedFrame& each) {
      return each.direction == can::Direction::received && each.frame.id == frame.id &&
             each.frame.extended == frame.extended && each.frame.remote == frame.remote &&
             each.time > played.begins[end - 1] && each.time < played.difference->time;
    }));
  }

  /// Of a frame that is due: as long as it takes with the model, because what comes later is another one.
  [[nodiscard]] Duration due_within(Duration most) const {
    const auto end = last_that_acts();
    const auto& begins = finding_.played.begins;
    if (end == 0 || end > begins.size()) return most;
    const auto due =
        std::chrono::ceil<std::chrono::milliseconds>(finding_.played.difference->time - begins[end - 1]);
    return due.count() <= 0 ? most : std::min<Duration>(most, due + close_margin);
  }

  void act(const Action& action, std::size_t number, bool judges) {
    switch (action.kind) {
      case Action::Kind::upload:
      case Action::Kind::download: transfer(action, number, judges); break;
      case Action::Kind::request: request(action, number, judges); break;
      case Action::Kind::frame: send(action.frame); break;
      case Action::Kind::power: add("- power_cycle: once"); break;
      case Action::Kind::wait: add(fmt::format("- wait: {}", to_string(action.time))); break;
    }
  }

  void transfer(const Action& action, std::size_t number, bool judges) {
    const bool up = action.kind == Action::Kind::upload;
    std::string keys = fmt::format("object: {}", to_string(action.object));
    if (!up) keys += fmt::format(", bytes: {}", quoted(hex_bytes(action.data)));
    if (action.transfer != Transfer::automatic)
      keys += fmt::format(", transfer: {}", word_of(action.transfer));
    if (up && action.transfer == Transfer::block && action.blksize != 127)
      keys += fmt::format(", blksize: {}", action.blksize);
    if (!action.fault.empty()) keys += fmt::format(", fault: {}", action.fault);
    add(fmt::format("- {}: {{{}}}", up ? "upload" : "download", keys));
    const auto& answers = finding_.played.answers;
    if (judges && finding_.played.difference->what == What::late) {
      check();
      add(fmt::format("  expect: {{latency: ..{}}}", to_string(soon)));
      add("  warn: [ok, abort any]");
    } else if (judges) {
      check();
      add(fmt::format("  expect: {}", outcome(finding_.played.difference->model, up)));
      if (finding_.played.difference->model.kind == Answer::Kind::aborted) add("  warn: [abort any]");
    } else if (number < answers.size() && answers[number].kind != Answer::Kind::confirmed) {
      // What a monitor saw may be what ends the transfer.
      const bool seen =
          finding_.played.difference->what == What::rule && number + 1 == finding_.conversation.size();
      if (seen) check();
      add("  expect: [ok, abort any, silence]");
    }
  }

  void request(const Action& action, std::size_t number, bool judges) {
    const auto& frame = action.frame;
    const bool own = frame.is_data(canopen::connection_set(words_.node).sdo_request) && frame.dlc == 8;
    const auto& answers = finding_.played.answers;
    if (!own) {
      send(frame);
      if (!judges) return;
      add(fmt::format("- silence: {{of: {}, for: 100 ms}}",
                      can_id(canopen::connection_set(words_.node).sdo_response.value())));
      return check();
    }
    add("- talk: |");
    add(fmt::format("    > 600+N: {}", hex_bytes(frame.bytes())));
    if (judges) {
      const auto& due = finding_.played.difference->model;
      const auto& came = finding_.played.difference->device;
      const bool same_code = came.kind == due.kind && came.code == due.code;
      // How late an answer to a single request is no step can ask.
      if (finding_.played.difference->what == What::late) return add("    < 580+N: ..");
      if (due.kind == Answer::Kind::aborted && same_code && due.data.size() == 8)
        add(fmt::format("    < 580+N: {} {{warn any}}", hex_bytes(due.data)));
      else if (due.kind == Answer::Kind::aborted)
        add(fmt::format("    < 580+N: 80 xx xx xx {{abort: {}; warn any}}", to_string(due.code)));
      else if (due.kind == Answer::Kind::replied)
        add(fmt::format("    < 580+N: {}", hex_bytes(due.data)));
      else
        add("    silence 580+N for 100 ms");
      check();
    } else if (number < answers.size() && answers[number].kind != Answer::Kind::silence) {
      add("    < 580+N: ..");
    }
  }

  void send(const can::Frame& frame) {
    const Action action{.kind = Action::Kind::frame, .frame = frame};
    const auto text = describe(frame, words_.node);
    const bool own = frame.dlc == 2 && frame.data[1] == words_.node.value();
    const auto command = action.nmt_command(words_.node);
    if (own && command != 0 && text.starts_with("NMT ") && !text.starts_with("NMT command"))
      return add(fmt::format("- nmt: {}", text.substr(4)));
    std::string keys = fmt::format("id: {}", can_id(frame.id));
    if (!frame.remote) keys += fmt::format(", data: {}", quoted(hex_bytes(frame.bytes())));
    if (frame.remote) keys += fmt::format(", rtr: true, dlc: {}", frame.dlc);
    if (frame.extended) keys += ", ext: true";
    add(fmt::format("- send: {{{}}}", keys));
  }

  void await(const Difference& difference) {
    const auto& frame = difference.what == What::surplus ? difference.came : difference.due;
    const auto window = rest_from(last_that_acts()) + margin;
    if (const auto passed = before(frame); passed > 0) {
      add(fmt::format("- over: {{number: 1..{}}}", passed));
      add("  steps:");
      add(fmt::format("    - frame: {{id: {}, within: {}}}", can_id(frame.id), to_string(window)));
    }
    if (difference.what == What::missing) {
      add(fmt::format("- frame: {{id: {}, within: {}}}", can_id(frame.id), to_string(due_within(window))));
    } else if (difference.what == What::surplus) {
      add(fmt::format("- silence: {{of: {}, for: {}}}", can_id(frame.id), to_string(window)));
    } else {
      add(fmt::format("- frame: {{id: {}, within: {}}}", can_id(frame.id), to_string(window)));
      check();
      return add(fmt::format("  expect: {{bytes: {}}}", quoted(hex_bytes(frame.bytes()))));
    }
    check();
  }

  const Finding& finding_;
  const Vocabulary& words_;
  std::string out_;
};

bool judges(std::string_view steps) { return steps.contains("\n        checks: "); }

std::string commented(std::string_view lines, std::string_view why) {
  std::string out = fmt::format("  # {}.\n", why);
  for (const auto line : split(lines, '\n')) {
    if (!line.empty()) out += fmt::format("  # {}\n", line.substr(2));
  }
  return out;
}

}  // namespace

std::string came_text(const Finding& finding, const Vocabulary& words) {
  const auto& difference = *finding.played.difference;
  switch (difference.what) {
    case What::answer: return difference.device.text();
    case What::late:
      return fmt::format(
          "{} after {}", difference.device.text(),
          to_string(std::chrono::floor<std::chrono::microseconds>(difference.device.answered)));
    case What::missing: return "nothing";
    case What::surplus:
    case What::other_data: return describe(difference.came, words.node);
    case What::rule:
    case What::broken: return difference.text;
    case What::gone: return "no boot-up message when it is reset behind this";
  }
  return "";
}

std::string due_text(const Finding& finding, const Vocabulary& words) {
  const auto& difference = *finding.played.difference;
  switch (difference.what) {
    case What::answer:
    case What::late: return difference.model.text();
    case What::missing:
    case What::other_data: return describe(difference.due, words.node);
    case What::surplus: return "nothing";
    case What::rule:
    case What::gone:
    case What::broken: return "";
  }
  return "";
}

bool becomes_scenario(const Finding& finding, const Vocabulary& words) {
  return judges(Writer(finding, words).steps());
}

std::string scenario_file(std::span<const Finding> findings, const Vocabulary& words, std::string_view how,
                          std::span<const std::string> remarks) {
  std::string out =
      fmt::format("# Found by: {}\nformat: 1\ntitle: Found by exploration\n\nscenarios:\n", how);
  std::size_t number = 0;
  for (const auto& finding : findings) {
    const auto came = came_text(finding, words), due = due_text(finding, words);
    const auto title = due.empty() ? came : fmt::format("{} instead of {}", came, due);
    const std::string remark = number < remarks.size() ? remarks[number] : std::string();
    auto scenario = fmt::format("  - id: finding-{}\n    title: {}\n    risk: motion\n    steps:\n", ++number,
                                quoted(printable(title)));
    scenario += Writer(finding, words).steps();
    // Who does not judge is no scenario.
    if (!judges(scenario))
      out += commented(scenario, fmt::format("{}: it is to be given a step with 'checks: ID'",
                                             finding.assigned ? "No step can ask for this one"
                                                              : "No rule is known for this one"));
    else if (!remark.empty())
      out += commented(scenario, remark);
    else
      out += scenario;
  }
  return out;
}

}  // namespace conform::explore
