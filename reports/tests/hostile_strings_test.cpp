// SPDX-License-Identifier: Apache-2.0
// A hundred thousand strings that nobody would call a name, each in a place of its own, through every report.
// The files are read again by other programs (check_hostile.py).
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include "base/text.hpp"
#include "catch.hpp"
#include "fixture.hpp"
#include "reports/annotations.hpp"
#include "reports/console.hpp"
#include "reports/formats.hpp"
#include "reports/html/html.hpp"

using namespace conform;
using namespace conform::reports;

namespace {

/// Bytes at random between what steers terminals, pages, tables and CI systems.
class Strings {
 public:
  std::string next() {
    ++count_;
    std::string out;
    for (auto pieces = 1 + random_() % 6; pieces > 0; --pieces) {
      if (random_() % 3 == 0) {
        for (auto bytes = random_() % 12; bytes > 0; --bytes) out += static_cast<char>(random_());
      } else {
        out += steering_[random_() % steering_.size()];
      }
    }
    return out;
  }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::mt19937_64 random_{20'261'124};
  std::size_t count_ = 0;
  const std::vector<std::string> steering_{"<script>alert(1)</script>",
                                           "</style>",
                                           "]]>",
                                           "<!--",
                                           "-->",
                                           "&amp;",
                                           "&#0;",
                                           "&#x1F;",
                                           "&undefined;",
                                           "\"",
                                           "'",
                                           "`",
                                           "```",
                                           "~~~~~~",
                                           "|",
                                           "\\",
                                           "\\u0000",
                                           "\r\n",
                                           "\n",
                                           "\t",
                                           std::string(1, '\0'),
                                           "\x1B[2J",
                                           "\x1B]0;title\x07",
                                           "\x9B"
                                           "31m",
                                           "\xC2\x9B"
                                           "31m",
                                           "\b\b\b",
                                           "\x7F",
                                           "\xE2\x80\xAE",
                                           "\xE2\x80\xA8",
                                           "\xED\xA0\x80",
                                           "\xED\xBF\xBF",
                                           "\xC0\x80",
                                           "\xEF\xBF\xBE",
                                           "\xEF\xBF\xBF",
                                           "\xF4\x90\x80\x80",
                                           "\xF0\x9F\x92\xA5",
                                           "\xE2\x82",
                                           "::error::x",
                                           "##vso[task.complete]",
                                           "@everyone",
                                           "[a](http://x)",
                                           "![](//x)",
                                           "=cmd|' /C calc'!A0",
                                           ",",
                                           ";",
                                           "ok 1 - x",
                                           "Bail out!",
                                           "1..0 # SKIP",
                                           "%s%n",
                                           "{}",
                                           "${x}",
                                           "../../x",
                                           "javascript:alert(1)",
                                           " ",
                                           "x"};
};

/// The sample run's cases again and again, every text of them another one.
result::RunResult run_of(Strings& strings, std::size_t least) {
  const auto sample = testing::sample_run();
  auto run = sample;
  run.cases.clear();
  const auto fill = [&](std::vector<result::Finding>& findings) {
    for (auto& finding : findings) {
      for (auto* text : {&finding.step, &finding.actual, &finding.reason, &finding.position.file})
        *text = strings.next();
      finding.accepts.push_back(strings.next());
      finding.tolerates.push_back(strings.next());
      for (auto& frame : finding.evidence) frame.meaning = strings.next();
    }
  };
  while (strings.count() < least) {
    for (auto one : sample.cases) {
      for (auto* text : {&one.id, &one.instance, &one.title, &one.reason, &one.position.file})
        *text += strings.next();
      if (run.cases.size() < 100) one.suite += strings.next();
      one.cct = {strings.next()};
      fill(one.setup_findings);
      for (auto& judgement : one.judgements) fill(judgement.findings);
      run.cases.push_back(std::move(one));
    }
  }
  for (auto& info : run.requirements) {
    for (auto* text : {&info.clause, &info.statement, &info.area}) *text = strings.next();
  }
  run.device = strings.next();
  run.host = strings.next();
  for (int i = 0; i < 20; ++i) {
    run.properties.push_back({strings.next(), strings.next()});
    run.notes.push_back(strings.next());
  }
  return run;
}

/// Nothing that moves a cursor: of the control characters only the end of a line, which has two bytes in CSV
/// (RFC 4180). XML goes to no terminal.
bool is_harmless(std::string_view format, std::string text) {
  if (format == "junit") return true;
  const bool is_text = format != "json" && format != "html" && format != "code-quality" && format != "badge";
  for (std::size_t at = 0; format == "csv" && (at = text.find("\r\n", at)) != std::string::npos;)
    text.erase(at, 1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte < 0x20 && byte != '\n') || (is_text && byte == 0x7F)) return false;
    if (is_text && byte == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0)
      return false;
  }
  return true;
}

}  // namespace

TEST_CASE("A hundred thousand hostile strings go through every report") {
  Strings strings;
  const auto run = run_of(strings, 100'000);
  const auto folder = std::filesystem::path(CONFORM_BINARY_DIR) / "hostile";
  std::filesystem::create_directories(folder);
  const Beside beside{strings.next(), {{strings.next(), strings.next()}}};
  for (const Format& format : formats()) {
    const auto text = format.write(run, beside);
    std::ofstream(folder / (std::string(format.name) + std::string(format.suffix)), std::ios::binary) << text;
    INFO(format.name);
    if (format.name == "html") {
      pugi::xml_document document;
      CHECK(document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8));
      CHECK(document.select_nodes("//script").size() == 1);
      CHECK(document.select_nodes("//img | //iframe | //object | //base").empty());
      CHECK(document.select_nodes("//@*[starts-with(name(), 'on')]").empty());
    }
    CHECK_FALSE(text.empty());
    CHECK(is_harmless(format.name, text));
  }
  // HTML parsers of others are slow.
  Strings few;
  std::ofstream(folder / "part.html", std::ios::binary) << html_report(run_of(few, 5'000));
  CHECK(is_harmless("", summary(run, Style{})));
  for (const auto& one : run.cases) {
    const auto line = case_line(one, Style{});
    if (!is_harmless("", line)) FAIL_CHECK(one.name());
    if (line.find('\n') != std::string::npos) FAIL_CHECK("two lines for " << one.name());
  }
}

TEST_CASE("Every byte alone goes through every report") {
  for (int byte = 0; byte < 256; ++byte) {
    const auto run = testing::hostile_run(std::string(1, static_cast<char>(byte)));
    for (const Format& format : formats()) {
      INFO(format.name << " byte " << byte);
      CHECK(is_harmless(format.name, format.write(run, {})));
    }
  }
}
