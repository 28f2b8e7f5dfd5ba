// SPDX-License-Identifier: Apache-2.0
#include "journal/reader.hpp"

#include <algorithm>
#include <exception>

#include "base/files.hpp"
#include "base/text.hpp"
#include "journal/lines.hpp"
#include "result/run_json.hpp"

namespace conform::journal {

using namespace result;  // run_json.hpp

namespace {

constexpr std::uint64_t largest = std::uint64_t{4} << 30U;

std::optional<Multiplexer> object_of(const Json& line, const char* key) {
  return parse_multiplexer(line.at(key).get<std::string>());
}

class Parser {
 public:
  void line(const Json& line) {
    if (line.contains(lines::version)) {
      first(line);
    } else if (line.contains(lines::planned)) {
      from_json(line.at(lines::planned), out_.run);
    } else if (line.contains(lines::begun)) {
      running_ = line.at(lines::begun).get<std::size_t>();
      out_.commands.clear();
    } else if (line.contains(lines::ended)) {
      const auto index = line.at(lines::ended).get<std::size_t>();
      if (index < out_.run.cases.size()) {
        result::CaseResult one;
        from_json(line.at("case"), one);
        if (one.finished) out_.commands.clear();
        out_.run.cases[index] = std::move(one);
      }
      running_.reset();
    } else if (line.contains(lines::changing)) {
      changing(line);
    } else if (line.contains(lines::commanding)) {
      const auto object = object_of(line, lines::commanding);
      if (object && std::ranges::find(out_.commands, *object) == out_.commands.end())
        out_.commands.push_back(*object);
    } else if (line.contains(lines::put_back)) {
      const auto object = object_of(line, lines::put_back);
      const auto value = hex_value(line.at("value").get<std::string>());
      std::erase_if(out_.outstanding, [&](const OldValue& each) {
        return object && each.object == *object && each.before == value;
      });
    } else if (line.contains(lines::recovered)) {
      out_.commands.clear();
      out_.recovered = true;
    } else if (line.contains(lines::finished)) {
      auto cases = std::move(out_.run.cases);
      out_.run = {};
      from_json(line.at(lines::finished), out_.run);
      out_.run.cases = std::move(cases);
      out_.finished = true;
    } else if (line.contains(lines::reported)) {
      out_.reported = true;
    } else if (line.contains(lines::died)) {
      why_ = line.at("why").get<std::string>();
    }
    // Lines of a later version are skipped.
  }

  [[nodiscard]] bool begun() const { return begun_; }

  Journal finish() {
    if (!out_.finished) {
      for (const auto& each : out_.changed) {
        const bool open =
            std::ranges::find(out_.outstanding, each.object, &OldValue::object) != out_.outstanding.end();
        out_.run.changes.push_back(
            {.object = each.object, .before = each.before, .during = each.during, .put_back = !open});
      }
      for (const auto& one : out_.run.cases) {
        if (one.finished)
          out_.run.elapsed = std::max(out_.run.elapsed, one.end - out_.run.cases.front().begin);
      }
      out_.run.aborted = why_.empty() ? "the runner was killed before the run had ended" : why_;
      if (running_ && *running_ < out_.run.cases.size()) {
        auto& one = out_.run.cases[*running_];
        one.reason = "not run to its end: " + *out_.run.aborted;
      }
      for (const auto& each : out_.outstanding) {
        out_.run.notes.push_back("not put back: " + to_string(each.object) + " was " +
                                 hex_bytes(each.before));
      }
    }
    return std::move(out_);
  }

 private:
  void first(const Json& line) {
    begun_ = line.at(lines::version).get<int>() <= version;
    auto& header = out_.header;
    header.interface = text_of(line.at("interface"));
    header.node = line.at("node").get<std::uint8_t>();
    header.simulated = line.at("simulated").get<bool>();
    header.profile = text_of(line.at("profile"));
    header.eds = text_of(line.at("eds"));
    if (line.contains("suites")) header.suites = text_of(line.at("suites"));
    header.epoch_ns = line.at("epoch").get<std::int64_t>();
    header.reports.capture = text_of(line.at("capture"));
    header.reports.candump = text_of(line.at("candump"));
    if (line.contains("captures")) header.reports.captures = text_of(line.at("captures"));
    if (line.contains("bundle")) header.reports.bundle = text_of(line.at("bundle"));
    header.reports.bundle_signed = line.value("bundle_signed", false);
    const auto add = [&header](const std::string& format, const Json& path) {
      if (auto text = text_of(path); !text.empty()) header.reports.reports.emplace(format, std::move(text));
    };
    if (line.contains("reports")) {
      for (const auto& [format, path] : line.at("reports").items()) add(format, path);
    } else {  // version 1
      for (const auto* format : {"junit", "markdown"}) add(format, line.at(format));
    }
    from_json(line.at("run"), out_.run);
  }

  /// What stands there first is what was there before everything.
  void changing(const Json& line) {
    const auto object = object_of(line, lines::changing);
    if (!object) return;
    const OldValue value{*object, hex_value(line.at("before").get<std::string>()),
                         text_of(line.at("during"))};
    for (auto* const list : {&out_.outstanding, &out_.changed}) {
      if (std::ranges::find(*list, *object, &OldValue::object) == list->end()) list->push_back(value);
    }
  }

  Journal out_;
  bool begun_ = false;
  std::optional<std::size_t> running_;
  std::string why_;
};

}  // namespace

Result<Journal> parse(std::string_view text, const std::string& where) {
  Parser parser;
  std::size_t number = 0;
  // The one place where exceptions of the JSON library, and of run_json.cpp, end.
  try {
    while (!text.empty()) {
      const auto end = text.find('\n');
      if (end == std::string_view::npos) break;
      ++number;
      parser.line(Json::parse(text.substr(0, end)));
      if (number == 1 && !parser.begun())
        return fail("is not a journal that this version can read", where, "made by a newer canopen-conform?");
      text.remove_prefix(end + 1);
    }
  } catch (const std::exception& error) {
    return fail(std::string("is not a journal: ") + error.what(), where + ":" + std::to_string(number));
  }
  if (number == 0) return fail("is not a journal: it has no whole line", where);
  auto out = parser.finish();
  out.path = where;
  return out;
}

Result<Journal> read(const std::string& path) {
  const auto text = read_file(path, largest);
  if (!text) return std::unexpected(text.error());
  return read(path, *text);
}

Result<Journal> read(const std::string& path, std::string_view text) {
  if (!text.starts_with(std::string("{\"") + lines::elsewhere)) return parse(text, path);
  const auto line = Json::parse(text.substr(0, text.find('\n')), nullptr, false);
  if (line.is_discarded() || !line.is_object()) return fail("does not say where the journal is", path);
  const auto place = text_of(line.at(lines::elsewhere));
  const auto there = read_file(place, largest);
  if (!there) return std::unexpected(there.error());
  return parse(*there, place);
}

std::string pointer_to(const std::string& path) {
  return Json{{lines::elsewhere, text_json(path)}}.dump() + "\n";
}

}  // namespace conform::journal
