// SPDX-License-Identifier: Apache-2.0
// `doctor`: why a bus is dead, or who is on it.
#include <fmt/format.h>

#include <chrono>

#include "can/interface_lock.hpp"
#include "can/simulated_bus.hpp"
#include "can/socketcan_interface.hpp"
#include "can/socketcan_transport.hpp"
#include "cli/commands/commands.hpp"
#include "cli/doctor/diagnosis.hpp"
#include "cli/run/stop_signal.hpp"
#include "cli/run/terminal.hpp"
#include "node/node.hpp"
#include "reports/paint.hpp"

namespace conform::cli {
namespace {

using reports::Ink;

struct Printer {
  reports::Style style;

  void advice(const std::vector<Advice>& all) const {
    for (const auto& each : all) {
      const auto [word, ink] = each.kind == Advice::Kind::good   ? std::pair("ok", Ink::good)
                               : each.kind == Advice::Kind::note ? std::pair("note", Ink::doubtful)
                                                                 : std::pair("bad", Ink::bad);
      print(fmt::format("  {}  {}\n", paint(fmt::format("{:4}", word), ink, style), each.text));
      if (!each.hint.empty()) print("        " + paint(each.hint, Ink::hint, style) + "\n");
    }
  }
};

Result<int> examine(can::Transport& transport, const can::InterfaceFacts& facts, const DoctorCommand& options,
                    const Printer& printer) {
  const auto about = about_interface(facts);
  printer.advice(about);
  Heard heard;
  constexpr Duration answer_time = std::chrono::milliseconds(50);
  if (auto done = listen(transport, std::chrono::milliseconds(options.listen_ms), stop_signal, heard); !done)
    return std::unexpected(done.error());
  if (options.ask) {
    if (auto done = ask_everybody(transport, answer_time, stop_signal, heard); !done)
      return std::unexpected(done.error());
  }
  const auto bus = about_bus(facts, heard, options.ask);
  printer.advice(bus);
  const auto lines = node_lines(heard);
  if (!lines.empty()) print("\nWho is there\n");
  for (const auto& line : lines) print("  " + line + "\n");
  const bool usable = is_usable(bus);
  if (usable && !lines.empty()) {
    const auto first = heard.nodes.begin()->first;
    print(fmt::format("\nA first run, which only reads\n  {}\n",
                      options.simulate ? "canopen-conform run --simulate --allow read-only"
                                       : fmt::format("canopen-conform run -i {} --node {} --allow read-only",
                                                     facts.name, first)));
  }
  return usable ? 0 : exit_environment;
}

/// The reference node on a simulated bus, which sends its boot-up message and answers.
Result<int> examine_simulated(const DoctorCommand& options, const Printer& printer) {
  can::SimulatedBus bus;
  auto node = refnode::Node::create({.node_id = 1});
  if (!node) return std::unexpected(node.error());
  bus.attach(**node, "reference node");
  can::InterfaceFacts facts;
  facts.name = facts.driver = "simulated";
  facts.is_virtual = facts.up = facts.echo = true;
  return examine(bus.transport(), facts, options, printer);
}

Result<int> examine_interface(const DoctorCommand& options, const Printer& printer) {
  auto facts = can::preflight(options.interface);
  if (!facts) return std::unexpected(facts.error());
  auto transport = can::SocketCanTransport::open(options.interface);
  if (!transport) return std::unexpected(transport.error());
  // A run in progress has the bus for itself: nothing is asked beside it.
  auto lock = can::InterfaceLock::take(options.interface);
  if (!lock && options.ask) return std::unexpected(lock.error());
  note_stop_signals();
  return examine(**transport, *facts, options, printer);
}

/// What there is, where the user has not said which.
int tell_interfaces(const Printer& printer) {
  const auto names = can::can_interfaces();
  if (names.empty())
    return report_error(
        {"the machine has no CAN interface",
         {},
         "a virtual one: sudo ip link add dev vcan0 type vcan && sudo ip link set vcan0 up; an adapter: is its "
         "driver loaded (dmesg)?"},
        exit_environment);
  bool any = false;
  for (const auto& name : names) {
    print(name + "\n");
    const auto facts = can::preflight(name);
    if (facts) {
      any = true;
      printer.advice(about_interface(*facts));
    } else {
      printer.advice({{Advice::Kind::bad, facts.error().what, facts.error().hint}});
    }
  }
  print("\nWho is on one of them: canopen-conform doctor -i " + names.front() + "\n");
  return any ? 0 : exit_environment;
}

}  // namespace

int doctor_command(const DoctorCommand& options) {
  const Printer printer{{use_colour(options.color, 1), terminal_width(), 0}};
  if (!options.simulate && options.interface.empty()) return tell_interfaces(printer);
  if (options.simulate && !options.interface.empty())
    return report_error({"say one bus", {}, "--interface can0, or --simulate for the reference node"},
                        exit_usage);
  print((options.simulate ? "simulated" : options.interface) + "\n");
  const auto code =
      options.simulate ? examine_simulated(options, printer) : examine_interface(options, printer);
  if (!code) return report_error(code.error(), exit_environment);
  return stop_signal != 0 ? 128 + stop_signal : *code;
}

}  // namespace conform::cli
