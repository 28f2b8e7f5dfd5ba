// SPDX-License-Identifier: Apache-2.0
#include "cli/exploring/live_search.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "can/interface_lock.hpp"
#include "can/socketcan_transport.hpp"
#include "cli/exploring/live_device.hpp"
#include "cli/exploring/model_description.hpp"
#include "cli/run/run_journal.hpp"
#include "cli/run/run_reports.hpp"
#include "cli/run/stop_signal.hpp"
#include "device/description.hpp"
#include "journal/writer.hpp"

namespace conform::cli {
namespace {

using namespace std::chrono_literals;

/// Each conversation costs a reset or two.
constexpr std::size_t most_tries = 60;

class Journalled final : public engine::Observer {
 public:
  explicit Journalled(journal::Writer& journal) : journal_(journal) {}
  void changing(Multiplexer object, const Bytes& before) override {
    journal_.changing({object, before, "exploration"});
  }
  void put_back(Multiplexer object, const Bytes& value) override { journal_.put_back(object, value); }

 private:
  journal::Writer& journal_;
};

/// However it ends: what it has changed and not put back stands there all the same.
class Ended {
 public:
  Ended(journal::Writer& journal, const result::RunResult& run) : journal_(journal), run_(run) {}
  Ended(const Ended&) = delete;
  Ended& operator=(const Ended&) = delete;
  ~Ended() {
    journal_.finished(run_);
    journal_.reported();
  }

 private:
  journal::Writer& journal_;
  const result::RunResult& run_;
};

/// What the device has that nobody has described: the draft says it.
void describe_by(device::Profile& profile, const eds::EdsFile& drafted) {
  if (auto description = device::describe(drafted)) device::add_description(profile, std::move(*description));
}

bool claims_objects(const device::Profile& profile) {
  return std::ranges::any_of(profile.objects, &device::Entry::claimed);
}

}  // namespace

Result<LiveResult> explore_live(const ExploreCommand& options, const std::string& root, KnownDevice known,
                                explore::SearchOptions search, const OnDevice& on_device) {
  auto& profile = known.profile;
  auto transport = can::SocketCanTransport::open(options.interface);
  if (!transport) return std::unexpected(transport.error());
  auto lock = can::InterfaceLock::take(options.interface);
  if (!lock) return std::unexpected(lock.error());
  auto allowed = (*transport)->info().is_virtual ? steps::Tier::motion : steps::Tier::config;
  if (const auto wished = steps::parse_tier(options.allow)) allowed = *wished;
  profile.writes_described = allowed == steps::Tier::motion && profile.safe_objects.empty();

  auto kept = RunJournal::open(options.journal, options.interface, profile.node.value(), false, {});
  if (!kept) return std::unexpected(kept.error());
  journal::Writer journal(kept->descriptor());
  result::RunResult run;
  run.device = profile.name;
  const auto begins = kept->begin(journal,
                                  {.interface = options.interface,
                                   .node = profile.node.value(),
                                   .simulated = false,
                                   .profile = absolute(options.device),
                                   .eds = absolute(options.eds),
                                   .suites = absolute(root),
                                   .epoch_ns = (*transport)->info().epoch_ns,
                                   .reports = {}},
                                  run);
  if (!begins) return std::unexpected(begins.error());
  const Ended ended(journal, run);
  Journalled observer(journal);

  LiveDevice device(**transport, profile, allowed, observer, stop_signal);
  if (auto looked = device.look(); !looked) return std::unexpected(looked.error());
  auto description = model_description(device, profile, known.description.get());
  if (!description) return std::unexpected(description.error());
  if (!claims_objects(profile)) describe_by(profile, **description);
  auto explorable = explorable_of(profile, {.description = *description}, options.variants);
  if (!explorable) return std::unexpected(explorable.error());
  meet(*explorable, device);
  on_device(*explorable, profile.node, allowed);

  search.offer = explorable->offer;
  search.may = [&device](const explore::Action& action) { return device.may(action); };
  search.most_tries = most_tries;
  auto found = explore::search(explorable->bench, explorable->words, search);
  LiveResult out;
  if (found) {
    out.search = std::move(*found);
  } else {
    out.search.ended_by = found.error();
  }
  if (auto left = device.leave()) {
    out.left = std::move(*left);
  } else {
    out.lost = left.error();
  }
  return out;
}

}  // namespace conform::cli
