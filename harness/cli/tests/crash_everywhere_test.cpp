// SPDX-License-Identifier: Apache-2.0
// A run may die at any moment: of a signal, a crash, a machine without power. Here the whole suite runs
// against the reference node, and behind every CONFORM_CRASH_EVERY-th frame that it sends (1: behind each)
// the process is copied. The copy forgets the run, reads its journal, recovers the device as `recover` does,
// and compares its object dictionary with that before the run, at once and once more after a power cycle.
#include <sys/mman.h>
#include <unistd.h>

#include <functional>
#include <map>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/text.hpp"
#include "can/descriptor.hpp"
#include "can/simulated_bus.hpp"
#include "cli/proof/processes.hpp"
#include "cli/proof/selftest.hpp"
#include "cli/run/remains.hpp"
#include "cli/tests/shipped.hpp"
#include "journal/writer.hpp"

namespace {

using namespace conform;
using Values = std::map<Multiplexer, Bytes>;

/// What can be written, does not trigger anything, and is no clock that runs (1013h).
Values values_of(const refnode::ObjectDictionary& dictionary) {
  Values out;
  for (const auto& [index, object] : dictionary.objects()) {
    for (const auto& [sub, entry] : object.entries) {
      if (entry.access != refnode::Access::rw || entry.command || index == 0x1013) continue;
      const Multiplexer at{Index(index), SubIndex(sub)};
      const auto read = dictionary.upload(at);
      out[at] = read ? *read : Bytes();
    }
  }
  return out;
}

std::string content(int file) {
  std::string out(static_cast<std::size_t>(::lseek(file, 0, SEEK_END)), '\0');
  return ::pread(file, out.data(), out.size(), 0) == static_cast<ssize_t>(out.size()) ? out : std::string();
}

/// The name of a case without what came of it.
result::CaseResult named_as(const result::CaseResult& other) {
  result::CaseResult out;
  out.id = other.id;
  out.instance = other.instance;
  return out;
}

/// Keeps the journal of a run as RunWatch does, but begins it anew with each case, with what is outstanding:
/// it is read some thousand times.
class Keeper final : public engine::Observer {
 public:
  explicit Keeper(int file) : file_(file) { begin({}); }

  void case_begun(const result::RunResult& run, std::size_t index) override {
    running = run.cases[index].name();
    begin({named_as(run.cases[index])});
    writer_->case_begun(0, BusTime{});
  }
  void case_ended(const result::RunResult& run, std::size_t index) override {
    auto one = named_as(run.cases[index]);
    one.finished = true;
    writer_->case_ended(0, one);
    running.clear();
  }
  void changing(Multiplexer object, const Bytes& before) override {
    writer_->changing({object, before, running});
  }
  void commanding(Multiplexer object) override { writer_->commanding(object); }
  void put_back(Multiplexer object, const Bytes& value) override { writer_->put_back(object, value); }

  std::string running;  ///< name of the case; empty: the preparation, or the way to the end

 private:
  void begin(std::vector<result::CaseResult> cases) {
    const auto until_now = journal::parse(content(file_), "journal");
    REQUIRE(::ftruncate(file_, 0) == 0);
    REQUIRE(::lseek(file_, 0, SEEK_SET) == 0);
    writer_.emplace(file_);
    journal::Header header;
    header.interface = "vcan0";
    header.node = 5;
    writer_->begin(header, {});
    result::RunResult run;
    run.cases = std::move(cases);
    writer_->planned(run);
    if (!until_now) return;
    for (const auto& each : until_now->outstanding) writer_->changing(each);
  }

  int file_;
  std::optional<journal::Writer> writer_;
};

/// Sends frames, and does something behind every so many of them.
class Interrupted final : public can::Transport {
 public:
  Interrupted(can::Transport& bus, std::size_t every, std::function<void(std::size_t)> then)
      : bus_(bus), every_(every), then_(std::move(then)) {}

  [[nodiscard]] BusTime now() const override { return bus_.now(); }
  [[nodiscard]] Result<void> send(const can::Frame& frame) override {
    auto sent = bus_.send(frame);
    if (++sent_ % every_ == 0) then_(sent_);
    return sent;
  }
  [[nodiscard]] Result<std::optional<can::BusEvent>> receive(BusTime deadline) override {
    return bus_.receive(deadline);
  }
  [[nodiscard]] can::BusHealth health() override { return bus_.health(); }
  [[nodiscard]] can::TransportInfo info() const override { return bus_.info(); }
  [[nodiscard]] std::size_t sent() const { return sent_; }

 private:
  can::Transport& bus_;
  std::size_t every_, sent_ = 0;
  std::function<void(std::size_t)> then_;
};

std::string differences(const Values& before, const Values& now) {
  std::string out;
  for (const auto& [object, value] : before) {
    const auto found = now.find(object);
    if (found != now.end() && found->second == value) continue;
    out += fmt::format(" {} is {}, was {};", to_string(object),
                       found == now.end() ? "gone" : hex_bytes(found->second), hex_bytes(value));
  }
  return out;
}

/// In the copy: what recovering leaves wrong; nothing where it leaves nothing.
std::string recovered(int journal_file, can::SimulatedBus& bus, const refnode::PoweredNode& node,
                      const std::function<Result<void>()>& power_cycle, const device::Profile& profile,
                      const Values& before) {
  const auto journal = journal::parse(content(journal_file), "journal");
  if (!journal) return journal.error().text();
  engine::Observer nobody;
  const auto done = engine::recover(bus.transport(), profile, cli::remains_of(*journal, false, true), nobody);
  if (!done) return done.error().text();
  std::string out;
  for (const auto& each : done->values.left) out += " left: " + each + ";";
  for (const auto& each : done->not_stored) out += " not stored: " + each + ";";
  out += differences(before, values_of(node.node().dictionary()));
  if (const auto cycled = power_cycle(); !cycled) return cycled.error().text();
  const auto up = bus.now() + refnode::PoweredNode::off_time + profile.boot_time;
  while (bus.now() < up) {
    const auto event = bus.transport().receive(up);
    if (!event) return event.error().text();
    if (!*event) break;
  }
  const auto lasting = differences(before, values_of(node.node().dictionary()));
  return lasting.empty() || !out.empty() ? out : " after a power cycle" + lasting;
}

TEST_CASE("Wherever a run dies, recovering gives the device its values back") {
  const auto every = cli::shipped::how_many("CONFORM_CRASH_EVERY", 397);
  const auto& suites = cli::shipped::suites();
  const auto& profile = cli::shipped::reference();
  auto node = refnode::PoweredNode::create({.node_id = profile.node.value()});
  REQUIRE(node);
  can::SimulatedBus bus{can::SimulatedBus::Options{}};
  bus.attach(**node, "reference node");
  const auto before = values_of((*node)->node().dictionary());
  REQUIRE(before.size() > 100);
  const can::Descriptor file(::memfd_create("journal", MFD_CLOEXEC));
  REQUIRE(file.valid());
  Keeper keeper(file.get());

  engine::RunOptions options;
  options.observer = &keeper;
  options.power_revives = false;
  cli::give_power_switch(options, bus, **node);

  std::map<std::string, std::size_t> wrong;  // how often
  std::map<std::string, std::string> where;
  std::size_t crashes = 0;
  Interrupted transport(bus.transport(), every, [&](std::size_t number) {
    const auto copy = cli::in_processes(1, 1, {}, [&](std::size_t) {
      return recovered(file.get(), bus, **node, options.power_cycle, profile, before);
    });
    auto text = copy.front().text;
    if (copy.front().kind != cli::Ending::Kind::returned) text += " the copy did not come to its end";
    ++crashes;
    // LSS has given the node another node-ID, and no journal says which: recover tells that nobody answers.
    if (text.empty() ||
        (keeper.running.starts_with("cia305/") && text.find("does not answer") != std::string::npos))
      return;
    ++wrong[text];
    where.try_emplace(
        text, fmt::format("frame {}, {}", number, keeper.running.empty() ? "between cases" : keeper.running));
  });

  can::Capture capture;
  const auto run = engine::run(transport, profile, suites.suite, suites.catalogue, options, capture);
  CHECK(run.counts().fail == 0);
  for (const auto& [text, times] : wrong) {
    UNSCOPED_INFO(where[text] << " (" << times << "x):" << text);
  }
  UNSCOPED_INFO(crashes << " deaths behind one of " << transport.sent() << " frames");
  CHECK(wrong.empty());
  CHECK(crashes > 100);
}

}  // namespace
