// SPDX-License-Identifier: Apache-2.0
// `verify`: whether a bundle is still what a run sealed.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/text.hpp"
#include "bundle/verify.hpp"
#include "cli/commands/commands.hpp"
#include "cli/run/terminal.hpp"

namespace conform::cli {
namespace {

using bundle::Problem;
using bundle::Verification;
using Json = nlohmann::ordered_json;
using Signature = Verification::Signature;

constexpr int exit_tampered = 1;

/// "2027-03-31 12:00:00 UTC, on bench-3"; in simulation there is no time.
std::string when_and_where(const bundle::RunFacts& run) {
  std::string out = "in simulated time";
  if (run.started_utc_ns > 0) {
    const std::chrono::sys_time<std::chrono::seconds> time{
        std::chrono::seconds(run.started_utc_ns / 1'000'000'000)};
    out = fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", time);
  }
  return run.host.empty() ? out : out + ", on " + printable(run.host);
}

std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// "3 reports, 1 capture, 300 suite files"
std::string roles_of(const bundle::Manifest& manifest) {
  std::map<std::string, std::size_t> roles;
  for (const auto& file : manifest.files) ++roles[file.role];
  std::vector<std::string> out;
  for (const auto& [role, count] : roles) out.push_back(fmt::format("{} {}", count, printable(role)));
  return join(out, ", ");
}

std::string signature_words(const Verification& found) {
  const auto& signer = found.manifest.signer;
  switch (found.signature) {
    case Signature::good: return "good, by the given key (Ed25519, SHA-256 " + signer + ")";
    case Signature::wrong: return "WRONG: not that of the given key";
    case Signature::unchecked:
      return "by the key with SHA-256 " + signer + ", not checked: --key PUBLIC.pem does";
    case Signature::none: return "none: who could change the files could change their digests as well";
  }
  return {};
}

std::string line(std::string_view name, const std::string& value) {
  return fmt::format("  {:<10}  {}\n", name, value);
}

/// What the manifest says, every text of it as that of a stranger.
std::string facts(const Verification& found) {
  const auto& manifest = found.manifest;
  const auto& run = manifest.run;
  std::string out = line("verdict", fmt::format("{} (exit code {})", printable(run.verdict), run.exit_code));
  if (!run.aborted.empty()) out += line("stopped", printable(run.aborted));
  std::vector<std::string> counts;
  for (const auto& [verdict, count] : run.requirements) {
    if (count > 0) counts.push_back(fmt::format("{} {}", count, printable(verdict)));
  }
  out += line("rules", counts.empty() ? "none" : join(counts, ", "));
  out += line("device", run.device.empty() ? "not named" : printable(run.device));
  for (const auto& [name, value] : run.identity) out += line("", printable(name) + " = " + printable(value));
  out += line("run", when_and_where(run));
  out += line("made by", printable(manifest.tool));
  out += line("files", fmt::format("{}: {}", manifest.files.size(), roles_of(manifest)));
  for (const auto& each : manifest.left_out)
    out += line("left out", printable(each.what) + ": " + printable(each.why));
  return out;
}

std::string text(const VerifyCommand& options, const Verification& found) {
  std::string out = printable(options.bundle) + "\n";
  const bool has_manifest = !found.manifest.tool.empty() || !found.manifest.files.empty();
  if (has_manifest) out += facts(found);
  out += line("digests", fmt::format("{} of {} are right", found.right_files,
                                     counted(found.manifest.files.size(), "file")));
  out += line("signature", signature_words(found));
  for (const auto& each : found.problems) {
    out += fmt::format("{}: {}{}\n", to_string(each.kind),
                       each.name.empty() ? "" : printable(each.name) + ": ", printable(each.what));
  }
  if (found.good()) return out + "good: it is as it was sealed\n";
  return out + fmt::format("NOT GOOD: {}; nothing that it says can be relied on\n",
                           counted(found.problems.size(), "problem"));
}

/// A text of a stranger that may be no UTF-8.
Json text_json(const std::string& text) { return printable(text); }

Json json(const VerifyCommand& options, const Verification& found) {
  const auto& manifest = found.manifest;
  Json out{{"canopen_conform_verify", 1}, {"bundle", text_json(options.bundle)}, {"good", found.good()}};
  if (!found.not_a_bundle.empty()) out["not_a_bundle"] = text_json(found.not_a_bundle);
  out["sealed"] = found.not_a_bundle.empty() && manifest.sealed;
  if (!manifest.sealed) out["not_sealed"] = text_json(manifest.not_sealed);
  out["signature"] = {{"state", std::string(to_string(found.signature))},
                      {"key_sha256", manifest.signer.empty() ? Json() : Json(manifest.signer)}};
  out["problems"] = Json::array();
  for (const auto& each : found.problems) {
    out["problems"].push_back({{"kind", std::string(to_string(each.kind))},
                               {"file", text_json(each.name)},
                               {"what", text_json(each.what)}});
  }
  out["files"] = {{"named", manifest.files.size()}, {"right", found.right_files}, {"bytes", found.bytes}};
  if (manifest.tool.empty()) return out;
  const auto& run = manifest.run;
  out["tool"] = text_json(manifest.tool);
  Json told{{"verdict", text_json(run.verdict)}, {"exit_code", run.exit_code}};
  told["aborted"] = run.aborted.empty() ? Json() : text_json(run.aborted);
  told["started_utc_ns"] = run.started_utc_ns;
  told["host"] = text_json(run.host);
  told["device"] = text_json(run.device);
  told["identity"] = Json::object();
  for (const auto& [name, value] : run.identity) told["identity"][printable(name)] = text_json(value);
  told["requirements"] = Json::object();
  for (const auto& [verdict, count] : run.requirements) told["requirements"][printable(verdict)] = count;
  out["run"] = std::move(told);
  out["left_out"] = Json::array();
  for (const auto& each : manifest.left_out)
    out["left_out"].push_back({{"what", text_json(each.what)}, {"why", text_json(each.why)}});
  return out;
}

}  // namespace

int verify_command(const VerifyCommand& options) {
  std::optional<bundle::PublicKey> key;
  if (!options.key.empty()) {
    auto read = bundle::PublicKey::read(options.key);
    if (!read) return report_error(read.error(), exit_usage);
    key.emplace(std::move(*read));
  }
  if (!options.extract.empty()) {
    if (auto free = bundle::is_free(options.extract); !free) return report_error(free.error(), exit_usage);
  }
  const auto* const asked = key ? &*key : nullptr;
  const auto found = bundle::verify(options.bundle, asked);
  if (!found) return report_error(found.error(), exit_usage);
  if (options.json) print(json(options, *found).dump(1) + "\n");
  if (!found->not_a_bundle.empty())
    return report_error(
        {"is no bundle: " + found->not_a_bundle, options.bundle, "run --bundle FILE makes one"}, exit_usage);
  if (!found->manifest.sealed)
    return report_error({"is not sealed: " + found->manifest.not_sealed, options.bundle, {}}, exit_usage);
  if (!options.json) print(text(options, *found));
  if (!found->good()) return exit_tampered;
  if (options.extract.empty()) return 0;
  if (auto done = bundle::extract(options.bundle, asked, options.extract); !done)
    return report_error(done.error(), exit_environment);
  if (!options.json) print("unpacked into " + printable(options.extract) + "\n");
  return 0;
}

}  // namespace conform::cli
