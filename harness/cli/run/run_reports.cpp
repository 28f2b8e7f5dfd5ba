// SPDX-License-Identifier: Apache-2.0
#include "cli/run/run_reports.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/files.hpp"
#include "can/candump_log.hpp"
#include "can/pcapng.hpp"
#include "cli/run/cause_captures.hpp"
#include "cli/run/terminal.hpp"
#include "reports/formats.hpp"
#include "result/annotate.hpp"
#include "result/cause_captures.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t largest_capture = std::uint64_t{4} << 30U;

/// Tells in the run where its captures of causes are.
void set_captures(result::RunResult& run, const fs::path& folder) {
  const std::string name(result::captures_property);
  const auto known = std::ranges::find(run.properties, name, &result::Property::name);
  auto& property = known == run.properties.end() ? run.properties.emplace_back() : *known;
  property = {name, folder.generic_string()};
}

}  // namespace

std::string absolute(const std::string& path) {
  if (path.empty()) return {};
  std::error_code ignored;
  const auto whole = std::filesystem::absolute(path, ignored);
  return ignored ? path : whole.string();
}

journal::ReportPaths absolute_paths(const std::map<std::string, std::string>& asked,
                                    const std::string& capture, const std::string& candump,
                                    const std::string& captures) {
  journal::ReportPaths out{
      .capture = absolute(capture), .candump = absolute(candump), .captures = absolute(captures)};
  for (const auto& [format, path] : asked) {
    if (!path.empty()) out.reports.emplace(format, absolute(path));
  }
  return out;
}

std::vector<std::string> RunReports::all() const {
  std::vector<std::string> out;
  for (const auto& format : reports::formats()) {
    if (const auto found = paths_.reports.find(std::string(format.name)); found != paths_.reports.end())
      out.push_back(found->second);
  }
  for (const auto& path : {paths_.capture, paths_.candump, paths_.captures}) {
    if (!path.empty()) out.push_back(path);
  }
  return out;
}

std::string RunReports::first() const { return none() ? "" : all().front(); }

Result<void> RunReports::begin(const std::string& tool, const std::vector<std::string>& inputs) {
  const auto paths = all();
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
  return say(tool, "the run has not ended: it goes on, or it was killed before its reports could be made");
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
    if (auto written = write_file_atomically(path, format->write(run, {})); !written) return written;
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
  return {};
}

Result<void> RunReports::stream(const can::CaptureInfo& info) {
  using Format = can::CaptureStream::Format;
  for (auto* const one : {&pcapng_, &candump_}) {
    const bool is_pcapng = one == &pcapng_;
    const auto& path = is_pcapng ? paths_.capture : paths_.candump;
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
  if (auto written = write_file_atomically(path, bytes); !written) {
    run.unwritten.push_back(written.error().text());
    report_error(written.error(), 0);
  }
}

void RunReports::put(result::RunResult& run, const std::string& path, const std::string& text) {
  put(run, path, ByteView(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void RunReports::write_words(result::RunResult& run, const can::Capture& capture) {
  // A journal may name formats of another version.
  for (const auto& [name, path] : paths_.reports) {
    const auto* format = reports::find_format(name);
    if (format == nullptr) continue;
    // Where both are moved together, or sent to somebody, the link still holds.
    if (has_causes_)
      set_captures(run, fs::path(paths_.captures).lexically_proximate(fs::path(path).parent_path()));
    put(run, path, format->write(run, capture));
  }
}

void RunReports::write_causes(result::RunResult& run, const can::Capture& capture,
                              const can::CaptureInfo& info) {
  if (paths_.captures.empty()) return;
  if (auto written = write_cause_captures(paths_.captures, run, capture, info); !written) {
    run.unwritten.push_back(written.error().text());
    report_error(written.error(), 0);
    return;
  }
  has_causes_ = true;
  set_captures(run, paths_.captures);
}

void RunReports::write(result::RunResult& run, const can::Capture& capture, const can::CaptureInfo& info) {
  flush();
  const bool log_is_whole = candump_ && candump_->error() == 0;
  pcapng_.reset();
  candump_.reset();
  // Anew, because now the frames that decided something are known and can say so.
  if (!paths_.capture.empty()) put(run, paths_.capture, can::write_pcapng(capture, info));
  if (!paths_.candump.empty() && !log_is_whole)
    put(run, paths_.candump, can::write_candump_log(capture, info));
  write_causes(run, capture, info);
  write_words(run, capture);
}

void RunReports::write_left(result::RunResult& run) {
  can::Capture capture;
  if (!paths_.capture.empty()) {
    const auto bytes = read_file(paths_.capture, largest_capture);
    auto loaded = bytes ? can::read_pcapng(
                              ByteView(reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()),
                              paths_.capture)
                        : Result<can::LoadedCapture>(std::unexpected(bytes.error()));
    if (loaded) {
      result::annotate(loaded->capture, run);
      loaded->info.tool = run.tool;
      loaded->info.comment = run.device + (run.aborted ? "; " + *run.aborted : "");
      put(run, paths_.capture, can::write_pcapng(loaded->capture, loaded->info));
      write_causes(run, loaded->capture, loaded->info);
      capture = std::move(loaded->capture);
    } else {
      run.unwritten.push_back(loaded.error().text());
      report_error(loaded.error(), 0);
    }
  }
  write_words(run, capture);
}

}  // namespace conform::cli
