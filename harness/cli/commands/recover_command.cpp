// SPDX-License-Identifier: Apache-2.0
// `recover`: puts back what a killed run left changed in the device.
#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <system_error>

#include "base/text.hpp"
#include "can/interface_lock.hpp"
#include "can/socketcan_transport.hpp"
#include "cli/commands/commands.hpp"
#include "cli/run/known_device.hpp"
#include "cli/run/remains.hpp"
#include "cli/run/run_journal.hpp"
#include "cli/run/terminal.hpp"
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
  void recovered() { writer_.recovered(); }

 private:
  journal::Writer writer_;
};

/// What commands do no value tells.
void tell_of_commands(const journal::Journal& journal, bool stores) {
  for (const auto& command : journal.commands) {
    const auto stored = stored_by(command);
    if (!stored) {
      print(fmt::format(
          "unknown: the interrupted case gave the command {}; what it did in the device cannot be read\n",
          to_string(command)));
    } else if (!stores) {
      print(fmt::format(
          "not stored: the interrupted case gave the command {}, and its values may come back with a reset\n",
          to_string(command)));
    }
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
  const auto remains = remains_of(*journal, options.all, !options.no_store);
  const auto& values = remains.changes;
  // A run that was killed may have left the device in Stopped as well, or a transfer open.
  const bool untouched = journal->finished || journal->recovered || header.interface.empty();
  if (values.empty() && untouched) {
    print("nothing is left to put back\n");
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

  Progress progress(file.get());
  const auto done = engine::recover(**transport, known->profile, remains, progress);
  if (!done) return report_error(done.error(), exit_environment);
  tell_of_commands(*journal, !options.no_store);
  const auto& left = done->values.left;
  for (const auto& each : left) report_error({"could not be put back: " + each, {}, {}}, 0);
  for (const auto& object : done->stored)
    print("stored again: by " + to_string(object) + ", for the interrupted case had stored or restored\n");
  for (const auto& each : done->not_stored) report_error({"could not be stored again: " + each, {}, {}}, 0);
  print(values.empty() ? "nothing is left to put back\n"
                       : fmt::format("{} of {} values are as they were before the run\n",
                                     values.size() - left.size(), values.size()));
  if (!left.empty() || !done->not_stored.empty()) return exit_environment;
  if (!options.no_store) progress.recovered();
  return 0;
}

}  // namespace conform::cli
