// SPDX-License-Identifier: Apache-2.0
#include "cli/run/run_bundle.hpp"

#include <set>

#include "base/files.hpp"
#include "base/text.hpp"
#include "bundle/verify.hpp"
#include "cli/commands/commands.hpp"
#include "cli/run/run_frames.hpp"
#include "reports/formats.hpp"
#include "reports/tally.hpp"

namespace conform::cli {
namespace {

using result::RunResult;

std::string verdict_of(const RunResult& run, int code) {
  switch (code) {
    case 0: return run.waived().empty() ? "conforms" : "conforms, with waivers";
    case 1: return "does not conform";
    case 2: return "nothing was judged";
    case exit_environment: return "not fully judged";
    default: return "interrupted";
  }
}

bundle::RunFacts facts_of(const RunResult& run) {
  const int code = result::exit_code(run);
  bundle::RunFacts out{.verdict = verdict_of(run, code), .exit_code = code};
  if (run.aborted) out.aborted = printable(*run.aborted);
  out.started_utc_ns = run.started_utc_ns;
  out.elapsed_ns = run.elapsed.count();
  out.host = printable(run.host);
  out.device = printable(run.device);
  for (const auto& each : run.properties) {
    if (each.name.starts_with("dut.")) out.identity.emplace_back(each.name, printable(each.value));
  }
  const auto total = reports::sum(reports::tally_by_area(run));
  const auto& counts = total.counts;
  out.requirements = {{"pass", counts.pass},
                      {"waived", counts.waived},
                      {"warn", counts.warn},
                      {"fail", counts.fail},
                      {"inconclusive", counts.inconclusive},
                      {"not_applicable", counts.not_applicable},
                      {"error", counts.error},
                      {"not_judged", total.not_judged}};
  return out;
}

/// "reports/junit.xml"; "reports/report.html", where the suffix says the same as the format.
std::string name_of(const reports::Format& format) {
  if (format.name == "json") return "result.json";
  const std::string suffix(format.suffix);
  return "reports/" + (suffix == "." + std::string(format.name) ? "report" : std::string(format.name)) +
         suffix;
}

}  // namespace

void RunBundle::take_held(const RunResult& run) {
  if (!asked() || inputs_) return;
  if (auto held = inputs_in(path_, run)) inputs_.emplace(std::move(*held));
}

Result<void> RunBundle::hold(const std::string& tool, const std::string& why) const {
  if (!asked()) return {};
  const bundle::Manifest manifest{.sealed = false, .not_sealed = printable(why), .tool = tool};
  const auto bytes =
      bundle::seal(manifest, inputs_ ? inputs_->contents : std::vector<bundle::Content>(), nullptr);
  if (!bytes) return std::unexpected(Error{bytes.error().what, path_, {}});
  return write_file_atomically(path_, *bytes);
}

Result<void> RunBundle::seal(const RunResult& run, const journal::ReportPaths& asked, Frames frames) const {
  // A run that begins says so in its place; here one would be lost that is made from the same run.
  bundle::Manifest there;
  if (!key_ && bundle::contents(path_, {}, &there) && there.sealed && !there.signer.empty())
    return fail("will not be written over: it is signed, and would not be any more", path_,
                "--sign KEY.pem, or --bundle with another file");
  std::vector<bundle::Content> contents;
  bundle::Manifest manifest{.tool = printable(run.tool), .run = facts_of(run)};
  if (inputs_) {
    contents = inputs_->contents;
    manifest.left_out = inputs_->left_out;
  } else {
    manifest.left_out.push_back({role::suite, "nothing tells what the run was made of"});
  }
  const std::set<std::string_view> always{"json", "html", "junit", "markdown"};
  std::vector<const reports::Format*> formats;
  // The reports name each other by where they lie in the bundle.
  reports::Beside beside;
  for (const auto& format : reports::formats()) {
    if (!always.contains(format.name) && !asked.reports.contains(std::string(format.name))) continue;
    formats.push_back(&format);
    beside.reports.emplace(format.name, "/" + name_of(format));
  }
  if (frames.pcapng) beside.reports.emplace("capture", "/" + std::string(bundled_frames));
  if (!frames.causes.empty()) beside.captures = "/captures";
  for (const auto* format : formats) {
    beside.path = "/" + name_of(*format);
    contents.push_back(
        {name_of(*format), format->name == "json" ? role::result : role::report, format->write(run, beside)});
  }
  if (frames.pcapng) {
    contents.push_back({std::string(bundled_frames), role::capture, std::move(*frames.pcapng)});
  } else {
    manifest.left_out.push_back({role::capture, printable(frames.why_not)});
  }
  for (const auto& each : frames.causes)
    contents.push_back(
        {"captures/" + each.name, role::capture, std::string(each.bytes.begin(), each.bytes.end())});
  if (frames.candump) contents.push_back({"captures/run.log", role::capture, std::move(*frames.candump)});
  if (asked.bundle_signed && !key_)
    manifest.left_out.push_back(
        {"signature", "who made the bundle after the run had been killed had no key"});
  const auto bytes = bundle::seal(std::move(manifest), contents, key_ ? &*key_ : nullptr);
  if (!bytes) return std::unexpected(Error{bytes.error().what, path_, {}});
  return write_file_atomically(path_, *bytes);
}

}  // namespace conform::cli
