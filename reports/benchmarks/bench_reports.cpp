// SPDX-License-Identifier: Apache-2.0
// How much processor time every report of a large run takes, and how much memory all of them want.
//   bench_reports [CASES]
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "reports/formats.hpp"
#include "reports/tests/fixture.hpp"

using namespace conform;
using namespace conform::reports;

namespace {

/// Nine of ten cases pass, as with a device that is nearly right.
result::RunResult run_of(std::size_t cases) {
  auto run = testing::sample_run();
  const auto sample = run.cases;
  run.cases.reserve(cases);
  while (run.cases.size() < cases) {
    const auto i = run.cases.size();
    auto one = i % 10 == 0 ? sample[i / 10 % sample.size()] : sample[0];
    one.instance = std::to_string(i);
    if (!one.judgements.empty() && i % 10 != 0)
      one.judgements[0].decided_by = result::DecidingStep{one.position, "upload 1000h:00", "00020192h", i};
    run.cases.push_back(std::move(one));
  }
  return run;
}

}  // namespace

int main(int count, char** words) {
  const std::size_t cases = count > 1 ? std::strtoull(words[1], nullptr, 10) : 10'000;
  const auto run = run_of(cases);
  double whole = 0;
  for (const Format& format : formats()) {
    const auto begin = std::clock();
    const auto text = format.write(run, {});
    const double spent = 1000.0 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    whole += spent;
    std::printf("%-18s %8.1f ms %8.2f MB\n", std::string(format.name).c_str(), spent,
                static_cast<double>(text.size()) / 1e6);
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("all reports of %zu cases: %.0f ms, %.0f MB of memory at most\n", cases, whole,
              static_cast<double>(usage.ru_maxrss) / 1024);
}
