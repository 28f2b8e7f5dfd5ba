// SPDX-License-Identifier: Apache-2.0
#include "bundle/manifest.hpp"

#include <algorithm>
#include <exception>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace conform::bundle {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view version_key = "canopen_conform_bundle";
constexpr int deepest = 8;
constexpr std::size_t longest_part = 150;
constexpr std::size_t longest_name = 230;

bool is_safe(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("._-+@=%,~").contains(c);
}

bool is_safe_part(std::string_view part) {
  return !part.empty() && part.size() <= longest_part && part != "." && part != ".." &&
         std::ranges::all_of(part, is_safe);
}

bool is_sha256(std::string_view text) {
  return text.size() == 64 &&
         std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

Json run_json(const RunFacts& run) {
  Json out{{"verdict", run.verdict}, {"exit_code", run.exit_code}};
  out["aborted"] = run.aborted.empty() ? Json() : Json(run.aborted);
  out["started_utc_ns"] = run.started_utc_ns;
  out["elapsed_ns"] = run.elapsed_ns;
  out["host"] = run.host;
  out["device"] = run.device;
  out["identity"] = Json::object();
  for (const auto& [name, value] : run.identity) out["identity"][name] = value;
  out["requirements"] = Json::object();
  for (const auto& [verdict, count] : run.requirements) out["requirements"][verdict] = count;
  return out;
}

RunFacts run_of(const Json& json) {
  RunFacts out;
  out.verdict = json.at("verdict").get<std::string>();
  out.exit_code = json.at("exit_code").get<int>();
  if (const auto& aborted = json.at("aborted"); !aborted.is_null()) out.aborted = aborted.get<std::string>();
  out.started_utc_ns = json.at("started_utc_ns").get<std::int64_t>();
  out.elapsed_ns = json.at("elapsed_ns").get<std::int64_t>();
  out.host = json.at("host").get<std::string>();
  out.device = json.at("device").get<std::string>();
  for (const auto& [name, value] : json.at("identity").items())
    out.identity.emplace_back(name, value.get<std::string>());
  for (const auto& [verdict, count] : json.at("requirements").items())
    out.requirements.emplace_back(verdict, count.get<std::uint64_t>());
  return out;
}

Json file_json(const File& file) {
  return {{"name", file.name}, {"role", file.role}, {"size", file.size}, {"sha256", file.sha256}};
}

/// A number that must not be negative: the library would wrap it around.
std::uint64_t size_of(const Json& json) {
  if (!json.is_number_unsigned()) throw std::invalid_argument("a size is no number");
  return json.get<std::uint64_t>();
}

/// What is wrong with the list of files, or empty.
std::string wrong_in(const std::vector<File>& files) {
  if (files.size() > most_files) return "it names more than " + std::to_string(most_files) + " files";
  std::uint64_t total = 0;
  const File* before = nullptr;
  for (const auto& file : files) {
    if (!is_safe_name(file.name) || file.name == manifest_name || file.name == signature_name)
      return "it names a file as none may be named: " + file.name;
    if (before != nullptr && before->name >= file.name)
      return "its files are not sorted, or one is named twice: " + file.name;
    if (!is_sha256(file.sha256)) return "a SHA-256 is none: " + file.name;
    if (file.size > largest_file) return "a file is larger than a bundle may hold: " + file.name;
    total += file.size;
    before = &file;
  }
  if (total > largest_bundle) return "the files are larger than a bundle may hold";
  // A file cannot be a folder as well. Where "a" is a file, "a/b" need not follow it ("a-b" may).
  for (const auto& file : files) {
    for (auto end = file.name.find('/'); end != std::string::npos; end = file.name.find('/', end + 1)) {
      if (std::ranges::binary_search(files, file.name.substr(0, end), {}, &File::name))
        return "a file stands where another needs a folder: " + file.name;
    }
  }
  return {};
}

}  // namespace

bool is_safe_name(std::string_view name) {
  if (name.size() > longest_name) return false;
  for (;;) {
    const auto end = name.find('/');
    if (!is_safe_part(name.substr(0, end))) return false;
    if (end == std::string_view::npos) return true;
    name.remove_prefix(end + 1);
  }
}

std::string safe_part(std::string_view text) {
  static constexpr std::string_view digits = "0123456789ABCDEF";
  constexpr std::size_t longest = 100;
  std::string out;
  for (const char c : text) {
    if (out.size() + 3 > longest) break;
    const auto byte = static_cast<unsigned char>(c);
    if (is_safe(c) && c != '%') {
      out += c;
    } else {
      out += {'%', digits[byte >> 4U], digits[byte & 0xFU]};
    }
  }
  return is_safe_part(out) ? out : "_" + out;
}

std::string to_json(const Manifest& manifest) {
  const auto dump = [](const Json& json) { return json.dump(-1, ' ', true, Json::error_handler_t::replace); };
  std::string out = "{\n\"" + std::string(version_key) + "\":" + std::to_string(manifest_version);
  const auto add = [&out](const char* name, const std::string& json) {
    out += std::string(",\n\"") + name + "\":" + json;
  };
  add("sealed", manifest.sealed ? "true" : "false");
  if (!manifest.sealed) add("not_sealed", dump(manifest.not_sealed));
  add("tool", dump(manifest.tool));
  add("run", dump(run_json(manifest.run)));
  Json signature;
  if (!manifest.signer.empty()) signature = {{"algorithm", "Ed25519"}, {"key_sha256", manifest.signer}};
  add("signature", dump(signature));
  Json left_out = Json::array();
  for (const auto& each : manifest.left_out) left_out.push_back({{"what", each.what}, {"why", each.why}});
  add("left_out", dump(left_out));
  std::string files;
  for (const auto& file : manifest.files) files += (files.empty() ? "\n" : ",\n") + dump(file_json(file));
  add("files", "[" + files + (files.empty() ? "]" : "\n]"));
  return out + "\n}\n";
}

std::expected<Manifest, NoManifest> parse_manifest(std::string_view text) {
  const auto first = text.find('"');
  if (first == std::string_view::npos || !text.substr(first + 1).starts_with(version_key))
    return std::unexpected(NoManifest{true, "it does not begin with " + std::string(version_key)});
  // The one place where exceptions of the JSON library end.
  try {
    // Eight million brackets would take a hundred times their size.
    const auto shallow = [](int depth, Json::parse_event_t /*event*/, Json& /*parsed*/) {
      if (depth > deepest) throw std::invalid_argument("it is nested too deeply");
      return true;
    };
    const auto json = Json::parse(text.begin(), text.end(), shallow);
    if (const auto version = json.at(std::string(version_key)).get<int>(); version > manifest_version)
      return std::unexpected(NoManifest{
          true, "it is of format " + std::to_string(version) + ", made by a newer canopen-conform"});
    Manifest out;
    out.sealed = json.at("sealed").get<bool>();
    if (!out.sealed) out.not_sealed = json.at("not_sealed").get<std::string>();
    out.tool = json.at("tool").get<std::string>();
    out.run = run_of(json.at("run"));
    if (const auto& signature = json.at("signature"); !signature.is_null()) {
      out.signer = signature.at("key_sha256").get<std::string>();
      if (signature.at("algorithm") != "Ed25519" || !is_sha256(out.signer))
        return std::unexpected(NoManifest{true, "it is signed in a way that this version does not know"});
    }
    for (const auto& each : json.at("left_out"))
      out.left_out.push_back({each.at("what").get<std::string>(), each.at("why").get<std::string>()});
    for (const auto& each : json.at("files"))
      out.files.push_back({each.at("name").get<std::string>(), each.at("role").get<std::string>(),
                           size_of(each.at("size")), each.at("sha256").get<std::string>()});
    if (auto wrong = wrong_in(out.files); !wrong.empty())
      return std::unexpected(NoManifest{false, std::move(wrong)});
    return out;
  } catch (const std::exception& error) {
    return std::unexpected(NoManifest{false, error.what()});
  }
}

}  // namespace conform::bundle
