// SPDX-License-Identifier: Apache-2.0
#include "reports/beside.hpp"

#include <filesystem>

#include "result/cause_captures.hpp"

namespace conform::reports {

namespace fs = std::filesystem;

std::string Beside::relative(const std::string& file) const {
  const auto from_here = fs::path(file).lexically_relative(fs::path(path).parent_path()).generic_string();
  return from_here.empty() ? file : from_here;
}

std::string Beside::capture_of(const result::RunResult& run, const result::Cause& cause,
                               std::size_t number) const {
  if (captures.empty() || !result::frames_of(cause, run)) return {};
  return relative((fs::path(captures) / result::capture_name(cause, number)).generic_string());
}

}  // namespace conform::reports
