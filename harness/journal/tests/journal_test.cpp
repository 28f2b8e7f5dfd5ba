// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <array>
#include <cstdio>

#include "catch.hpp"
#include "journal/reader.hpp"
#include "journal/writer.hpp"

using namespace conform;
using namespace conform::journal;
using result::Verdict;

namespace {

/// A journal in a file without a name.
class Scratch {
 public:
  Scratch() : file_(std::tmpfile()), writer(::fileno(file_)) {}
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { std::fclose(file_); }
  [[nodiscard]] std::string text() const {
    std::string out(1 << 20, '\0');
    const auto size = ::pread(::fileno(file_), out.data(), out.size(), 0);
    out.resize(static_cast<std::size_t>(size));
    return out;
  }

 private:
  std::FILE* file_;

 public:
  Writer writer;
};

constexpr Multiplexer heartbeat{Index(0x1017), SubIndex(0)};

result::RunResult planned_run() {
  result::RunResult run;
  run.tool = "tool";
  run.cases.resize(3);
  run.cases[0].id = "a";
  run.cases[1].id = "b";
  run.cases[2].id = "c";
  return run;
}

Header header() {
  return {.interface = "can0",
          .node = 5,
          .simulated = false,
          .profile = "/device.yaml",
          .eds = {},
          .suites = {},
          .epoch_ns = 12,
          .reports = {.capture = "/c.pcapng",
                      .candump = {},
                      .captures = "/causes",
                      .reports = {{"junit", "/j.xml"}},
                      .bundle = "/b.tar.zst",
                      .bundle_signed = true}};
}

/// A run that was killed in its second case.
void write_killed(Writer& writer) {
  auto run = planned_run();
  writer.begin(header(), {});
  writer.planned(run);
  writer.case_begun(0, BusTime());
  run.cases[0].verdict = Verdict::pass;
  run.cases[0].finished = true;
  writer.case_ended(0, run.cases[0]);
  writer.case_begun(1, BusTime());
  writer.changing({heartbeat, {0xE8, 3}, "b"});
  writer.commanding({Index(0x1010), SubIndex(1)});
}

}  // namespace

TEST_CASE("a killed run keeps the verdicts it reached, and says of the others why there is none") {
  Scratch scratch;
  write_killed(scratch.writer);
  const auto journal = parse(scratch.text(), "j");
  REQUIRE(journal);
  CHECK_FALSE(journal->finished);
  CHECK_FALSE(journal->reported);
  CHECK(journal->header.interface == "can0");
  CHECK(journal->header.reports.capture == "/c.pcapng");
  CHECK(journal->header.reports.captures == "/causes");
  CHECK(journal->header.reports.bundle == "/b.tar.zst");
  CHECK(journal->header.reports.bundle_signed);
  CHECK(journal->header.reports.reports == std::map<std::string, std::string>{{"junit", "/j.xml"}});
  CHECK(journal->run.cases[0].verdict == Verdict::pass);
  CHECK(journal->run.cases[1].verdict == Verdict::error);
  CHECK(journal->run.cases[1].reason == "not run to its end: the runner was killed before the run had ended");
  CHECK(journal->run.cases[2].reason == "not run");
  REQUIRE(journal->run.aborted);
  CHECK(*journal->run.aborted == "the runner was killed before the run had ended");
  CHECK(journal->run.notes == std::vector<std::string>{"not put back: 1017h:00 was E8 03"});
  REQUIRE(journal->outstanding.size() == 1);
  CHECK(journal->outstanding[0].before == Bytes{0xE8, 3});
  CHECK(journal->outstanding[0].during == "b");
  CHECK(journal->commands.size() == 1);
}

TEST_CASE("what has been recovered is not asked for again") {
  Scratch scratch;
  write_killed(scratch.writer);
  scratch.writer.put_back(heartbeat, {0xE8, 3});
  scratch.writer.recovered();
  const auto journal = parse(scratch.text(), "j");
  REQUIRE(journal);
  CHECK(journal->recovered);
  CHECK(journal->outstanding.empty());
  CHECK(journal->commands.empty());
}

TEST_CASE("a journal is read wherever its last line was torn") {
  Scratch scratch;
  write_killed(scratch.writer);
  const auto text = scratch.text();
  const auto first = text.find('\n');
  for (auto size = first + 1; size <= text.size(); ++size) REQUIRE(parse(text.substr(0, size), "j"));
  CHECK_FALSE(parse(text.substr(0, first), "j"));
  CHECK_FALSE(parse("", "j"));
  CHECK_FALSE(parse("no JSON\n", "j"));
  CHECK_FALSE(parse("{\"journal\":999}\n", "j"));
  CHECK_FALSE(parse("[1]\n", "j"));
}

TEST_CASE("a value counts as put back once it is what it was at first") {
  Scratch scratch;
  write_killed(scratch.writer);
  // A second case finds the value still changed and takes that for the old one.
  scratch.writer.changing({heartbeat, {1, 0}, "c"});
  scratch.writer.put_back(heartbeat, {1, 0});
  CHECK(parse(scratch.text(), "j")->outstanding.size() == 1);
  scratch.writer.put_back(heartbeat, {0xE8, 3});
  CHECK(parse(scratch.text(), "j")->outstanding.empty());
}

TEST_CASE("a finished run comes back whole, with cases that changed after they had ended") {
  Scratch scratch;
  auto run = planned_run();
  scratch.writer.begin(header(), {});
  scratch.writer.planned(run);
  run.cases[0].verdict = Verdict::pass;
  scratch.writer.case_ended(0, run.cases[0]);
  run.cases[0].verdict = Verdict::inconclusive;
  run.notes = {"a note"};
  scratch.writer.finished(run);
  auto journal = parse(scratch.text(), "j");
  REQUIRE(journal);
  CHECK(journal->finished);
  CHECK_FALSE(journal->run.aborted);
  CHECK(journal->run.cases.size() == 3);
  CHECK(journal->run.cases[0].verdict == Verdict::inconclusive);
  CHECK(journal->run.notes == run.notes);
  CHECK_FALSE(journal->reported);
  scratch.writer.reported();
  CHECK(parse(scratch.text(), "j")->reported);
}

TEST_CASE("what a crash wrote with its last breath is the reason") {
  Scratch scratch;
  write_killed(scratch.writer);
  auto text =
      scratch.text() + "{\"died\":11,\"why\":\"the runner crashed (SIGSEGV)\"}\n{\"later version\":1}\n";
  CHECK(*parse(text, "j")->run.aborted == "the runner crashed (SIGSEGV)");
}

TEST_CASE("a journal that cannot be written says so") {
  std::array<int, 2> ends{};
  REQUIRE(::pipe(ends.data()) == 0);
  Writer writer(ends[0]);  // the end for reading
  writer.reported();
  CHECK(writer.error() != 0);
  ::close(ends[0]);
  ::close(ends[1]);
}
