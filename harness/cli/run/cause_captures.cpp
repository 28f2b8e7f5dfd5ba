// SPDX-License-Identifier: Apache-2.0
#include "cli/run/cause_captures.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "base/files.hpp"
#include "base/text.hpp"
#include "base/text_bytes.hpp"
#include "can/pcapng.hpp"
#include "cli/replay/section.hpp"
#include "result/cause_captures.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;

/// Before and behind what is told.
constexpr std::size_t context = 20;
/// So far away from a case its preparation and its putting back are looked for.
constexpr std::size_t neighbourhood = 2000;

/// The first bytes tell which program wrote it.
bool is_ours(const fs::path& path) {
  // A comment of a section has 64 KiB at most.
  constexpr std::size_t enough = std::size_t{128} << 10U;
  std::ifstream file(path, std::ios::binary);
  std::string head(enough, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return can::pcapng_application(bytes_of(head)).starts_with("canopen-conform ");
}

/// Nothing is there, or what this program has written.
Result<void> is_free(const fs::path& path) {
  std::error_code ignored;
  const auto status = fs::symlink_status(path, ignored);
  if (!fs::exists(status) || (fs::is_regular_file(status) && is_ours(path))) return {};
  return fail("has the name of a capture of a cause and was not written by canopen-conform", path.string(),
              "move it away, or name another folder; no capture of a cause was written or removed");
}

result::FrameRange with_neighbours(result::FrameRange range, const result::CaseResult& one,
                                   const can::Capture& capture) {
  const auto& frames = capture.frames();
  const auto from = one.first_frame - std::min(one.first_frame, neighbourhood);
  const auto until = std::min(frames.size(), one.end_frame + neighbourhood);
  const auto found = section_of_case(std::span(frames).subspan(from, until - from), one.name(), {});
  if (!found) return range;
  range.first = std::min(range.first, from + found->first);
  // The last case has no neighbour that would end it.
  if (until - from > found->end) range.end = std::max(range.end, from + found->end);
  return range;
}

can::Capture part_of(const can::Capture& capture, result::FrameRange range) {
  can::Capture out;
  for (auto i = range.first; i < range.end; ++i) out.add(capture.frames()[i]);
  return out;
}

}  // namespace

Result<void> empty_capture_folder(const std::string& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return fail("cannot make the folder: " + failed.message(), folder);
  std::vector<fs::path> left;
  for (fs::directory_iterator each(folder, failed); !failed && each != fs::directory_iterator();
       each.increment(failed)) {
    std::error_code ignored;
    if (result::is_capture_name(each->path().filename().string()) && !each->is_symlink(ignored) &&
        each->is_regular_file(ignored) && is_ours(each->path()))
      left.push_back(each->path());
  }
  for (const auto& path : left) {
    if (!fs::remove(path, failed) && failed)
      return fail("cannot remove what an earlier run left: " + failed.message(), path.string());
  }
  if (failed) return fail("cannot look into the folder: " + failed.message(), folder);
  return {};
}

Result<std::vector<CauseCapture>> cause_captures(const result::RunResult& run, const can::Capture& capture,
                                                 const can::CaptureInfo& info) {
  std::vector<CauseCapture> out;
  const auto causes = result::causes_of(run);
  for (std::size_t i = 0; i < causes.size(); ++i) {
    const auto& cause = causes[i];
    auto range = result::frames_of(cause, run);
    if (!range) continue;
    if (range->end > capture.size())
      return fail("the capture does not hold the frames of " + cause.primary.owner->name(), {},
                  "is it the capture of this run?");
    if (const auto* one = result::case_of(cause, run)) *range = with_neighbours(*range, *one, capture);
    range->first -= std::min(range->first, context);
    range->end = std::min(capture.size(), range->end + context);
    auto about = info;
    about.comment = cause.primary.finding->requirement + " in " + cause.primary.owner->name() + ", frames " +
                    std::to_string(range->first + 1) + " to " + std::to_string(range->end) +
                    " of the run: " + printable(cause.primary.finding->actual);
    out.push_back({result::capture_name(cause, i + 1), can::write_pcapng(part_of(capture, *range), about)});
  }
  return out;
}

bool has_cause_captures(const std::string& folder, const result::RunResult& run) {
  const auto causes = result::causes_of(run);
  std::error_code ignored;
  for (std::size_t i = 0; i < causes.size(); ++i) {
    const auto path = fs::path(folder) / result::capture_name(causes[i], i + 1);
    if (result::frames_of(causes[i], run) && !(fs::is_regular_file(path, ignored) && is_ours(path)))
      return false;
  }
  return true;
}

Result<void> write_cause_captures(const std::string& folder, const std::vector<CauseCapture>& captures) {
  if (folder.empty()) return {};
  for (const auto& each : captures) {
    if (auto free = is_free(fs::path(folder) / each.name); !free) return free;
  }
  if (auto emptied = empty_capture_folder(folder); !emptied) return emptied;
  for (const auto& each : captures) {
    if (auto written = write_file_atomically((fs::path(folder) / each.name).string(), each.bytes); !written)
      return written;
  }
  return {};
}

}  // namespace conform::cli
