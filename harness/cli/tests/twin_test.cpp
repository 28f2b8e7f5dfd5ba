// SPDX-License-Identifier: Apache-2.0
// The twin of the reference node's own description is held against the suite: what the node passes, it
// passes, as far as nothing of the node beyond its description is concerned.
#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "catch.hpp"
#include "cli/proof/selftest.hpp"
#include "device/profile.hpp"
#include "eds/read.hpp"
#include "node/eds_text.hpp"
#include "node/node.hpp"
#include "shipped.hpp"

using namespace conform;
using result::Verdict;

namespace {

using Verdicts = std::map<std::string, Verdict>;

Verdicts verdicts_of(const result::RunResult& run) {
  Verdicts out;
  for (const auto& each : run.cases) {
    // The stored description (1021h) is the node's own text and no value of the file.
    if (each.name().find("1021") != std::string::npos) continue;
    for (const auto& judgement : each.judgements)
      out[judgement.requirement + " in " + each.name()] = judgement.verdict;
  }
  return out;
}

/// What an EDS cannot tell, the profile must not claim: the error trigger, the storage fault, and what
/// becomes of a time.
device::Profile without_extras(device::Profile profile) {
  std::erase_if(profile.errors, [](const auto& error) { return error.raise.has_value(); });
  profile.store_fault.reset();
  profile.claims.erase("time consumer");
  // Nor what commands an operating system knows.
  for (auto& entry : profile.objects) {
    if (entry.mux.index >= Index(0x1023) && entry.mux.index <= Index(0x1026)) entry.default_value.reset();
  }
  return profile;
}

/// The node's description, with the contents that it leaves out: those without an agreed notation or longer
/// than a line.
std::shared_ptr<const eds::EdsFile> own_description() {
  auto file = eds::read(refnode::eds_text(), "canopen-refnode.eds");
  REQUIRE(file.has_value());
  const auto node = refnode::Node::create({});
  REQUIRE(node.has_value());
  const auto fill = [&node](Index index, SubIndex sub, eds::Entry& entry) {
    const auto* held = (*node)->dictionary().entry(index.value(), sub.value());
    if (held == nullptr || held->read || !entry.default_value.empty()) return;
    if (held->type == refnode::DataType::unicode_string) {
      for (std::size_t i = 0; i < held->default_value.size(); i += 2)
        entry.default_value.text += static_cast<char>(held->default_value[i]);
    } else {
      entry.default_value.text = hex_bytes(held->default_value);
    }
  };
  for (auto& object : file->objects) {
    fill(object.index, SubIndex(0), object.entry);
    for (auto& [sub, entry] : object.subs) fill(object.index, sub, entry);
  }
  return std::make_shared<const eds::EdsFile>(std::move(*file));
}

}  // namespace

TEST_CASE("The twin of the node's own description passes what the node passes") {
  const auto& suites = cli::shipped::suites();
  const auto profile = without_extras(cli::shipped::reference());
  const auto run = [&](const cli::NodeSwitches& switches) {
    engine::RunOptions options;
    auto done = cli::simulate(switches, profile, suites.suite, suites.catalogue, options, 1);
    REQUIRE(done.has_value());
    return verdicts_of(done->result);
  };
  const Verdicts node = run({});
  const Verdicts twin = run({.description = own_description()});
  // A twin knows no application: no output is wired to an input, so nothing makes an event.
  const auto is_of_application = [](const std::string& name) {
    const auto is_in = [&name](const char* cases) { return name.find(cases) != std::string::npos; };
    return name.starts_with("PDO-TX-07 ") || name.starts_with("PDO-TX-08 ") ||
           name.starts_with("PDO-TX-05 in cia301/sync/consumer/present-data") ||
           is_in(" in cia301/pdo/tpdo-wired/") || is_in(" in cia301/pdo/rpdo-content/wired") ||
           is_in(" in cia301/pdo/remote-frames/not-sampled-yet") ||
           is_in(" in cia301/pdo/remote-frames/two-sampled");
  };
  const auto comparable = [&](const Verdicts& verdicts) {
    return std::ranges::count_if(verdicts, [&](const auto& each) { return !is_of_application(each.first); });
  };
  CHECK(comparable(twin) >= comparable(node));
  CHECK(std::ranges::count(node, Verdict::pass, &Verdicts::value_type::second) > 1200);
  for (const auto& [name, verdict] : node) {
    CAPTURE(name);
    if (is_of_application(name)) continue;
    const auto other = twin.find(name);
    REQUIRE(other != twin.end());
    CHECK(std::string(to_string(other->second)) == std::string(to_string(verdict)));
  }
}
