// SPDX-License-Identifier: Apache-2.0
#include "cli/run/run_frames.hpp"

#include <filesystem>

#include "base/files.hpp"
#include "base/text_bytes.hpp"
#include "bundle/digest.hpp"
#include "bundle/verify.hpp"
#include "can/pcapng.hpp"
#include "cli/run/run_inputs.hpp"
#include "result/annotate.hpp"

namespace conform::cli {
namespace {

constexpr std::uint64_t largest_capture = std::uint64_t{4} << 30U;

Result<can::LoadedCapture> commented(std::string_view bytes, const std::string& path,
                                     const result::RunResult& run) {
  auto loaded = can::read_pcapng(bytes_of(bytes), path);
  if (!loaded) return loaded;
  result::annotate(loaded->capture, run);
  loaded->info.tool = run.tool;
  loaded->info.comment = run.device + (run.aborted ? "; " + *run.aborted : "");
  return loaded;
}

Result<can::LoadedCapture> frames_in(const std::string& path, const result::RunResult& run) {
  const auto packed = bundle::contents(path, {role::capture});
  if (!packed) return commented_frames(path, run);
  for (const auto& each : *packed) {
    if (each.name == bundled_frames) return commented(each.bytes, path, run);
  }
  return fail("has no capture in it", path);
}

}  // namespace

Result<can::LoadedCapture> commented_frames(const std::string& path, const result::RunResult& run) {
  const auto bytes = read_file(path, largest_capture);
  if (!bytes) return std::unexpected(bytes.error());
  return commented(*bytes, path, run);
}

std::string why_not_of(const can::Capture& capture, const result::RunResult& run) {
  const auto& frames = capture.frames();
  for (const auto& one : run.cases) {
    if (one.finished && one.end_frame > frames.size())
      return "it has " + std::to_string(frames.size()) + " frames, the run had more";
    for (const auto& judgement : one.judgements) {
      for (const auto& finding : judgement.findings) {
        for (const auto& each : finding.evidence) {
          if (each.capture_index >= frames.size() || frames[each.capture_index].frame != each.frame)
            return "its frame " + std::to_string(each.capture_index + 1) + " is not that of the run";
        }
      }
    }
  }
  return {};
}

Result<can::LoadedCapture> find_frames(const std::vector<std::string>& places, const result::RunResult& run) {
  Error why{"no capture of the run was named or found", {}, "--capture FILE"};
  for (const auto& place : places) {
    std::error_code ignored;
    if (place.empty() || !std::filesystem::exists(place, ignored)) continue;
    auto loaded = frames_in(place, run);
    if (!loaded) {
      why = loaded.error();
      continue;
    }
    auto other = why_not_of(loaded->capture, run);
    if (other.empty()) return loaded;
    why = {"is no capture of this run: " + other, place, {}};
  }
  return std::unexpected(std::move(why));
}

}  // namespace conform::cli
