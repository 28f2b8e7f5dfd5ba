// SPDX-License-Identifier: Apache-2.0
#include "cli/run/known_device.hpp"

#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "base/files.hpp"
#include "base/text.hpp"
#include "device/description.hpp"
#include "eds/read.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_notes = 5;

/// Tells what of the description says nothing: it is not expected of the device, and the user should know.
std::vector<std::string> notes_of(const device::Description& description) {
  const auto count = description.unused.size() + description.unused_left_out;
  if (count == 0) return {};
  std::vector<std::string> out;
  for (const auto& each : description.unused) {
    if (out.size() == most_notes) break;
    out.push_back(each.where + ": " + each.what);
  }
  if (count > most_notes) {
    out.push_back(fmt::format("and {} more in {}: 'canopen-conform eds lint' tells what is wrong there",
                              count - most_notes, description.file));
  }
  return out;
}

/// What the description claims goes above: the claims of both have added up.
std::string claims_of(const device::Profile& profile, const std::string& profile_file,
                      const std::set<std::string, std::less<>>& described,
                      const std::string& description_file) {
  std::vector<std::string> by_profile, by_description;
  for (const auto& claim : profile.claims)
    (described.contains(claim) ? by_description : by_profile).push_back(claim);
  std::vector<std::string> out;
  const auto add = [&out](const std::string& file, const std::vector<std::string>& claims) {
    if (!claims.empty()) out.push_back(fs::path(file).filename().string() + ": " + join(claims, ", "));
  };
  add(profile_file, by_profile);
  add(description_file, by_description);
  return join(out, "; ");
}

Result<void> add_waivers(KnownDevice& known, const std::string& path) {
  auto document = device::load_waiver_file(path);
  if (!document) return std::unexpected(document.error());
  if (document->diagnostics.has_errors())
    return fail("the file of waivers has mistakes:\n" + document->diagnostics.render(false), path);
  for (auto& each : document->waivers) known.profile.waivers.push_back(std::move(each));
  known.files.push_back({role::waivers, path});
  return {};
}

Result<void> add_waivers(KnownDevice& known, const DeviceWords& words) {
  for (const auto& path : words.waivers) {
    if (auto done = add_waivers(known, path); !done) return done;
  }
  if (words.profile.empty() || !words.waivers.empty()) return {};
  const auto beside = fs::path(words.profile).parent_path() / "waivers.yaml";
  std::error_code ignored;
  return fs::exists(beside, ignored) ? add_waivers(known, beside.string()) : Result<void>{};
}

}  // namespace

Result<KnownDevice> known_device(const DeviceWords& words, std::optional<NodeId> fallback) {
  KnownDevice out;
  bool node_known = false;
  std::string path = words.eds;
  std::set<std::string, std::less<>> described;
  if (words.profile.empty()) {
    out.profile = device::default_profile(NodeId(1));
  } else {
    auto document = device::load_profile_file(words.profile);
    if (!document) return std::unexpected(document.error());
    if (document->diagnostics.has_errors())
      return fail("the device profile has mistakes:\n" + document->diagnostics.render(false), words.profile);
    out.profile = std::move(document->profile);
    out.files.push_back({role::profile, words.profile});
    node_known = true;
    // The profile's own word is relative to its folder.
    if (path.empty() && !out.profile.eds.empty())
      path = (fs::path(words.profile).parent_path() / out.profile.eds).string();
  }
  if (!path.empty()) {
    auto file = eds::read_file(path);
    if (!file) return std::unexpected(file.error());
    out.files.push_back({role::description, path});
    auto description = device::describe(*file);
    if (!description) return std::unexpected(description.error());
    if (!node_known && description->node) {
      out.profile.node = *description->node;
      node_known = true;
    }
    out.notes = notes_of(*description);
    if (out.profile.name.empty() && !file->device_info.product_name.empty())
      out.profile.name = printable(file->device_info.product_name.text);
    out.description = std::make_shared<const eds::EdsFile>(std::move(*file));
    out.profile.description = out.description;
    described = description->claims;
    device::add_description(out.profile, std::move(*description));
  }
  out.claims = claims_of(out.profile, words.profile, described, path);
  if (auto done = device::complete_writes(out.profile); !done) {
    auto error = done.error();
    error.where = words.profile + ":" + error.where;
    return std::unexpected(std::move(error));
  }
  if (auto done = add_waivers(out, words); !done) return std::unexpected(done.error());
  if (words.node) {
    out.profile.node = NodeId(static_cast<std::uint8_t>(*words.node));
  } else if (!node_known) {
    if (!fallback) return fail("the node-ID of the device is missing", {}, "--node 1..127, or --device FILE");
    out.profile.node = *fallback;
  }
  return out;
}

std::vector<result::Property> KnownDevice::properties() const {
  std::vector<result::Property> out;
  if (description) out.push_back({"dut.description", description->name});
  if (!claims.empty()) out.push_back({"input.claims", claims});
  return out;
}

}  // namespace conform::cli
