// SPDX-License-Identifier: Apache-2.0
// `recover`: puts back what a killed run left changed in the device.
#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "base/text.hpp"
#include "can/interface_lock.hpp"
#include "can/socketcan_transport.hpp"
#include "cli/commands.hpp"
#include "cli/known_device.hpp"
#include "cli/run_journal.hpp"
#include "cli/terminal.hpp"
#include "engine/recover.hpp"
#include "journal/reader.hpp"

namespace conform::cli {
namespace {

/// Writes into the journal what is put back, so that nobody is asked to do it again.
class Progress final : public engine::Observer {
 public:
  explicit Progress(int descriptor) : writer_(descriptor) {}
  void put_back(Multiplexer object, const Bytes& value) override {
    writer_.put_back(object, value);
    print("put back: " + to_string(object) + " is " + hex_bytes(value) + "\n");
  }

 private:
  journal::Writer writer_;
};

/// What no value tells: 1010h and 1011h act on the memory that outlives a reset.
void tell_of_commands(const journal::Journal& journal) {
  for (const auto& object : journal.commands) {
    print(fmt::format(
        "unknown: the interrupted case gave the command {}; what it stored in the device cannot be read.\n"
        "  If a test value comes back with a reset: canopen-conform recover --all {}, and store (1010h) after it\n",
        to_string(object), journal.path));
  }
}

}  // namespace

int recover_command(const RecoverCommand& options) {
  std::string path = options.journal;
  if (path.empty()) {
    if (options.interface.empty() || !options.node)
      return report_error(
          {"say what is to be recovered", {}, "recover JOURNAL, or --interface can0 --node 5"}, exit_usage);
    path = usual_journal(options.interface, *options.node);
    if (path.empty())
      return report_error({"neither XDG_STATE_HOME nor HOME is set", {}, "recover JOURNAL"}, exit_usage);
  }
  const auto journal = journal::read(path);
  if (!journal) return report_error(journal.error(), exit_usage);
  const auto& header = journal->header;
  if (header.simulated)
    return report_error({"the run was a simulation: its device is gone with it", path, {}}, exit_usage);
  const auto& values = options.all ? journal->changed : journal->outstanding;
  if (values.empty()) {
    print("nothing is left to put back\n");
    tell_of_commands(*journal);
    return 0;
  }
  DeviceWords words{options.device.empty() ? header.profile : options.device,
                    options.eds.empty() ? header.eds : options.eds,
                    options.node ? options.node : std::optional<std::uint32_t>(header.node)};
  const auto known = known_device(words, std::nullopt);
  if (!known) return report_error(known.error(), exit_usage);
  const auto& interface = options.interface.empty() ? header.interface : options.interface;
  auto transport = can::SocketCanTransport::open(interface);
  if (!transport) return report_error(transport.error(), exit_environment);
  const auto lock = can::InterfaceLock::take(interface);
  if (!lock) return report_error(lock.error(), exit_environment);
  const can::Descriptor file(::open(journal->path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  if (!file.valid())
    return report_error(
        {"cannot open the file: " + std::generic_category().message(errno), journal->path, {}},
        exit_environment);

  std::vector<engine::Change> changes;
  for (const auto& each : values) changes.push_back({each.object, each.before});
  Progress progress(file.get());
  const auto done = engine::recover(**transport, known->profile, std::move(changes), progress);
  if (!done) return report_error(done.error(), exit_environment);
  tell_of_commands(*journal);
  for (const auto& left : done->left) report_error({"could not be put back: " + left, {}, {}}, 0);
  print(fmt::format("{} of {} values are as they were before the run\n", values.size() - done->left.size(),
                    values.size()));
  return done->left.empty() ? 0 : exit_environment;
}

}  // namespace conform::cli
