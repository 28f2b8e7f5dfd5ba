// SPDX-License-Identifier: Apache-2.0
// Entries as long as a device description (1021h) are not read more often than there is something to learn:
// on a slow bus one of 40 kB takes ten seconds.
#include <algorithm>

#include "catch.hpp"
#include "cli/proof/selftest.hpp"
#include "shipped.hpp"

using namespace conform;
namespace shipped = cli::shipped;
using result::Verdict;

namespace {

const std::string read_only = "cia301/dictionary/1021-1022-store-eds/read-only";

cli::SimulatedRun play(const std::vector<std::string>& defects, const std::string& which = read_only) {
  engine::RunOptions options;
  options.plan.selection.patterns = {which};
  auto run = cli::simulate({.defects = defects}, shipped::reference(), shipped::suites().suite,
                           shipped::suites().catalogue, options, 1);
  REQUIRE(run.has_value());
  return std::move(*run);
}

std::size_t uploads_of_1021(const cli::SimulatedRun& run) {
  return static_cast<std::size_t>(std::ranges::count_if(run.capture.frames(), [](const auto& captured) {
    const auto& frame = captured.frame;
    return frame.id == 0x600U + shipped::reference().node.value() && frame.data[0] == 0x40 &&
           frame.data[1] == 0x21 && frame.data[2] == 0x10;
  }));
}

/// Segments asked for, of whatever entry.
std::size_t segments(const cli::SimulatedRun& run) {
  return static_cast<std::size_t>(std::ranges::count_if(run.capture.frames(), [](const auto& captured) {
    const auto& frame = captured.frame;
    return frame.id == 0x600U + shipped::reference().node.value() && (frame.data[0] & 0xEFU) == 0x60;
  }));
}

/// Bytes of the last upload of 1021h, as announced.
std::uint64_t last_size(const cli::SimulatedRun& run) {
  std::uint64_t out = 0;
  for (const auto& captured : run.capture.frames()) {
    const auto& frame = captured.frame;
    if (frame.id == 0x580U + shipped::reference().node.value() && frame.data[0] == 0x41 &&
        frame.data[1] == 0x21 && frame.data[2] == 0x10)
      out = load_le(ByteView(frame.data).subspan(4));
  }
  return out;
}

}  // namespace

TEST_CASE("of a long entry only the beginning is read when the run looks what there is") {
  const auto run = play({}, "cia301/dictionary/1021-1022-store-eds/format");
  CHECK(run.result.cases.front().verdict == Verdict::pass);
  CHECK(uploads_of_1021(run) == 1);
  CHECK(segments(run) < 1000);
  const auto& rows = run.result.dictionary;
  const auto row = std::ranges::find(rows, Index(0x1021), [](const auto& each) { return each.object.index; });
  REQUIRE(row != rows.end());
  CHECK(row->presence == result::present);
  CHECK(row->refusal.empty());
  CHECK(row->size == last_size(run));
  CHECK(row->value.ends_with(" and more"));
}

TEST_CASE("a long entry that refuses a write is read through once, before it") {
  const auto run = play({});
  CHECK(run.result.cases.front().verdict == Verdict::pass);
  CHECK(uploads_of_1021(run) == 2);
  CHECK(segments(run) < last_size(run) / 7 + 1000);
}

TEST_CASE("a device description is read once to be transferred and to be understood") {
  const auto run = play({}, "cia301/dictionary/1021-1022-store-eds/upload");
  const auto& only = run.result.cases.front();
  CHECK(only.verdict == Verdict::pass);
  CHECK(only.judgements.size() == 2);
  CHECK(uploads_of_1021(run) == 2);
  CHECK(segments(run) < last_size(run) / 7 + 1000);
}

TEST_CASE("a long entry that is written although it is read-only is put back to what it held") {
  const auto right = play({});
  const auto run = play({"1021-writable"});
  CHECK(run.result.cases.front().verdict == Verdict::fail);
  CHECK(uploads_of_1021(run) > 1);
  CHECK(last_size(run) == last_size(right));
  for (const auto& note : run.result.notes) CHECK(note.find("put back") == std::string::npos);
}
