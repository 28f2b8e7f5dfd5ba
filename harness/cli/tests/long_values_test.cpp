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

cli::SimulatedRun play(const std::vector<std::string>& defects) {
  engine::RunOptions options;
  options.plan.selection.patterns = {read_only};
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

TEST_CASE("a long entry that refuses a write is read once, when the run looks what there is") {
  const auto run = play({});
  CHECK(run.result.cases.front().verdict == Verdict::pass);
  CHECK(uploads_of_1021(run) == 1);
}

TEST_CASE("a long entry that is written although it is read-only is put back to what it held") {
  const auto right = play({});
  const auto run = play({"1021-writable"});
  CHECK(run.result.cases.front().verdict == Verdict::fail);
  CHECK(uploads_of_1021(run) > 1);
  CHECK(last_size(run) == last_size(right));
  for (const auto& note : run.result.notes) CHECK(note.find("put back") == std::string::npos);
}
