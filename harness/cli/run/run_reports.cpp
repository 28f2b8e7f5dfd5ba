// SPDX-License-Identifier: Apache-2.0
#include "cli/run/run_reports.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/files.hpp"
#include "base/text_bytes.hpp"
#include "can/candump_log.hpp"
#include "can/pcapng.hpp"
#include "cli/run/cause_captures.hpp"
#include "cli/run/run_frames.hpp"
#include "cli/run/terminal.hpp"
#include "reports/formats.hpp"
#include "result/cause_captures.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* not_ended =
    "the run has not ended: it goes on, or it was killed before its reports could be made";

void not_written(result::RunResult& run, const Error& why) {
  run.unwritten.push_back(why.text());
  report_error(why, 0);
}

}  // namespace

std::string absolute(const std::string& path) {
  if (path.empty()) return {};
  std::error_code ignored;
  const auto whole = std::filesystem::absolute(path, ignored);
  return ignored ? path : whole.lexically_normal().string();
}

journal::ReportPaths absolute_paths(const std::map<std::string, std::string>& asked,
                                    journal::ReportPaths places) {
  for (auto* const path : {&places.capture, &places.candump, &places.captures, &places.bundle})
    *path = absolute(*path);
  for (const auto& [format, path] : asked) {
    if (!path.empty()) places.reports.emplace(format, absolute(path));
  }
  return places;
}

std::vector<std::string> RunReports::all() const {
  std::vector<std::string> out;
  for (const auto& format : reports::formats()) {
    if (const auto found = paths_.reports.find(std::string(format.name)); found != paths_.reports.end())
      out.push_back(found->second);
  }
  for (const auto& path : {paths_.capture, paths_.candump, paths_.captures, paths_.bundle}) {
    if (!path.empty()) out.push_back(path);
  }
  return out;
}

reports::Beside RunReports::beside(const std::string& path) const {
  reports::Beside out{path, paths_.reports};
  if (!paths_.capture.empty()) out.reports.emplace("capture", paths_.capture);
  if (!paths_.candump.empty()) out.reports.emplace("candump", paths_.candump);
  if (has_causes_) out.captures = paths_.captures;
  return out;
}

std::string RunReports::first() const { return none() ? "" : all().front(); }

Result<void> RunReports::captures_apart() const {
  if (paths_.captures.empty()) return {};
  const auto folder = fs::path(paths_.captures) / "";
  for (const auto& each : all()) {
    const fs::path path(each);
    if (path.parent_path() == folder.parent_path() && result::is_capture_name(path.filename().string()))
      return fail("has the name of a capture of a cause, in their folder", each, "another name or folder");
  }
  return {};
}

Result<void> RunReports::begin(const std::string& tool, const std::vector<std::string>& inputs) {
  const auto paths = all();
  if (auto apart = captures_apart(); !apart) return apart;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (paths[k] == paths[i]) return fail("two reports would be written to one file", paths[i]);
    }
    for (const auto& input : inputs) {
      if (absolute(input) == paths[i])
        return fail("a report would be written over an input of the run", paths[i]);
    }
  }
  if (!paths_.captures.empty()) {
    if (auto emptied = empty_capture_folder(paths_.captures); !emptied) return emptied;
  }
  return say(tool, not_ended);
}

void RunReports::not_begun(const std::string& tool, const Error& why) {
  // Whoever made the paths fail has been told already.
  if (!say(tool, "the run did not begin: " + why.text())) return;
}

Result<void> RunReports::say(const std::string& tool, const std::string& what) {
  result::RunResult run;
  run.tool = tool;
  run.aborted = what;
  for (const auto& [name, path] : paths_.reports) {
    const auto* format = reports::find_format(name);
    if (format == nullptr) continue;
    if (auto written = write_file_atomically(path, format->write(run, beside(path))); !written)
      return written;
  }
  can::CaptureInfo info;
  info.tool = tool;
  info.comment = what;
  if (!paths_.capture.empty()) {
    if (auto written = write_file_atomically(paths_.capture, can::write_pcapng({}, info)); !written)
      return written;
  }
  if (!paths_.candump.empty()) {
    // Its readers know lines of frames only, so an empty log is all it can say.
    if (auto written = write_file_atomically(paths_.candump, std::string_view()); !written) return written;
  }
  return bundle_.hold(tool, what);
}

Result<void> RunReports::sign_with(const std::string& key) {
  if (key.empty()) return {};
  auto read = bundle::PrivateKey::read(key);
  if (!read) return std::unexpected(read.error());
  bundle_.sign_with(std::move(*read));
  paths_.bundle_signed = true;
  return {};
}

Result<void> RunReports::keep(const std::string& tool, RunInputs inputs) {
  bundle_.take(std::move(inputs));
  return bundle_.hold(tool, not_ended);
}

Result<void> RunReports::stream(const can::CaptureInfo& info) {
  using Format = can::CaptureStream::Format;
  for (auto* const one : {&pcapng_, &candump_}) {
    const bool is_pcapng = one == &pcapng_;
    auto path = is_pcapng ? paths_.capture : paths_.candump;
    if (is_pcapng && path.empty()) {
      path = bundle_.frames();
      frames_are_ours_ = bundle_.asked();
    }
    if (path.empty()) continue;
    auto opened = can::CaptureStream::create(path, is_pcapng ? Format::pcapng : Format::candump, info);
    if (!opened) return std::unexpected(opened.error());
    one->emplace(std::move(*opened));
  }
  return {};
}

void RunReports::recorded(const can::CapturedFrame& frame) {
  if (pcapng_) pcapng_->add(frame);
  if (candump_) candump_->add(frame);
}

void RunReports::waited(BusTime now) {
  if (pcapng_) pcapng_->waited(now);
  if (candump_) candump_->waited(now);
}

void RunReports::flush() {
  if (pcapng_) pcapng_->flush();
  if (candump_) candump_->flush();
}

void RunReports::put(result::RunResult& run, const std::string& path, ByteView bytes) {
  if (path.empty()) return;
  if (auto written = write_file_atomically(path, bytes); !written) not_written(run, written.error());
}

void RunReports::put(result::RunResult& run, const std::string& path, const std::string& text) {
  put(run, path, bytes_of(text));
}

void RunReports::write_words(result::RunResult& run) {
  // A journal may name formats of another version.
  for (const auto& [name, path] : paths_.reports) {
    if (const auto* format = reports::find_format(name)) put(run, path, format->write(run, beside(path)));
  }
}

void RunReports::write_causes(result::RunResult& run, const can::Capture& capture,
                              const can::CaptureInfo& info, RunBundle::Frames& frames) {
  if (paths_.captures.empty() && !bundle_.asked()) return;
  auto made = cause_captures(run, capture, info);
  Result<void> written;
  if (!made) written = std::unexpected(made.error());
  // Only now: what an earlier report has put there is worth more than nothing.
  if (written) written = write_cause_captures(paths_.captures, *made);
  if (!written) not_written(run, written.error());
  if (made) frames.causes = std::move(*made);
  has_causes_ = written && !paths_.captures.empty();
}

void RunReports::write_bundle(result::RunResult& run, RunBundle::Frames frames) {
  if (auto sealed = bundle_.seal(run, paths_, std::move(frames)); !sealed) {
    not_written(run, sealed.error());
    return;
  }
  // Now they stand in the bundle.
  std::error_code ignored;
  if (frames_are_ours_) std::filesystem::remove(bundle_.frames(), ignored);
}

void RunReports::write(result::RunResult& run, const can::Capture& capture, const can::CaptureInfo& info) {
  flush();
  const bool log_is_whole = candump_ && candump_->error() == 0;
  pcapng_.reset();
  candump_.reset();
  RunBundle::Frames frames;
  // Anew, because now the frames that decided something are known and can say so.
  if (!paths_.capture.empty() || bundle_.asked()) {
    const auto bytes = can::write_pcapng(capture, info);
    put(run, paths_.capture, bytes);
    if (bundle_.asked()) frames.pcapng.emplace(bytes.begin(), bytes.end());
  }
  // What was streamed is the same log.
  if (!paths_.candump.empty() && (!log_is_whole || bundle_.asked())) {
    auto log = can::write_candump_log(capture, info);
    if (!log_is_whole) put(run, paths_.candump, log);
    frames.candump = std::move(log);
  }
  write_causes(run, capture, info, frames);
  write_words(run);
  // Last, because what could not be written is told in it.
  if (bundle_.asked()) write_bundle(run, std::move(frames));
}

void RunReports::write_left(result::RunResult& run) {
  frames_are_ours_ = bundle_.asked() && paths_.capture.empty();
  bundle_.take_held(run);
  write_others(run, {});
}

void RunReports::write_others(result::RunResult& run, const std::vector<std::string>& elsewhere) {
  std::optional<can::LoadedCapture> own;
  if (!paths_.capture.empty()) {
    auto loaded = commented_frames(paths_.capture, run);
    // Another run's is left as it is.
    const auto other = loaded ? why_not_of(loaded->capture, run) : std::string();
    if (!other.empty()) loaded = fail("is no capture of this run: " + other, paths_.capture);
    if (loaded) {
      own = std::move(*loaded);
      put(run, paths_.capture, can::write_pcapng(own->capture, own->info));
    } else {
      not_written(run, loaded.error());
    }
  }
  RunBundle::Frames frames;
  if (bundle_.asked() || !paths_.captures.empty()) {
    std::vector<std::string> places{paths_.capture};
    if (frames_are_ours_) places.insert(places.end(), {bundle_.frames(), paths_.bundle});
    places.insert(places.end(), elsewhere.begin(), elsewhere.end());
    take_frames(run, own ? Result<can::LoadedCapture>(std::move(*own)) : find_frames(places, run), frames);
  }
  write_words(run);
  if (bundle_.asked()) write_bundle(run, std::move(frames));
}

void RunReports::take_frames(result::RunResult& run, const Result<can::LoadedCapture>& found,
                             RunBundle::Frames& frames) {
  if (!found) {
    frames.why_not = found.error().text();
    if (paths_.captures.empty()) return;
    // Those of an earlier report are still right.
    has_causes_ = has_cause_captures(paths_.captures, run);
    if (!has_causes_) not_written(run, found.error());
    return;
  }
  if (bundle_.asked()) {
    const auto bytes = can::write_pcapng(found->capture, found->info);
    frames.pcapng.emplace(bytes.begin(), bytes.end());
    if (!paths_.candump.empty()) frames.candump = can::write_candump_log(found->capture, found->info);
  }
  write_causes(run, found->capture, found->info, frames);
}

}  // namespace conform::cli
