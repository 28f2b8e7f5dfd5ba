// SPDX-License-Identifier: Apache-2.0
// canopen-refnode: the reference node on a CAN interface.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/text.hpp"
#include "can/socket_loop.hpp"
#include "defects/defect.hpp"
#include "eds/eds.hpp"
#include "eds/read.hpp"
#include "main_usage.hpp"
#include "node/eds_text.hpp"
#include "node/powered_node.hpp"
#include "parts/parts.hpp"
#include "storage/memory.hpp"
#include "twin/twin.hpp"
#include "usage/program.hpp"
#include "usage/shells.hpp"
#include "variants/variant.hpp"

namespace {

constexpr int exit_usage = 2;
constexpr int exit_environment = 3;

conform::can::StopFlag* stop_flag = nullptr;
refnode::PoweredNode* powered = nullptr;

extern "C" void on_signal(int) {
  if (stop_flag != nullptr) stop_flag->request();
}

extern "C" void on_power_signal(int) {
  if (powered == nullptr || stop_flag == nullptr) return;
  powered->switch_power();
  stop_flag->wake();
}

/// Says that the node is on the bus, at the moment the loop attaches it; everything else goes straight
/// through.
class Announced final : public conform::can::Participant {
 public:
  Announced(conform::can::Participant& inner, std::string line) : inner_(&inner), line_(std::move(line)) {}

  void attach(Sender sender, conform::BusTime now) override {
    fmt::print("{}\n", line_);
    std::fflush(stdout);
    inner_->attach(std::move(sender), now);
  }
  void on_frame(const conform::can::Frame& frame, conform::BusTime now) override {
    inner_->on_frame(frame, now);
  }
  void on_transmitted(conform::BusTime now) override { inner_->on_transmitted(now); }
  void on_time(conform::BusTime now) override { inner_->on_time(now); }
  [[nodiscard]] std::optional<conform::BusTime> next_wakeup() const override { return inner_->next_wakeup(); }

 private:
  conform::can::Participant* inner_;
  std::string line_;
};

void list_defects() {
  for (const refnode::Defect& row : refnode::defects()) {
    std::vector<std::string> ids(row.violates.begin(), row.violates.end());
    fmt::print("{}\n    {}\n    violates {}\n", row.id, row.summary, conform::join(ids, ", "));
  }
}

void list_variants() {
  for (const refnode::Variant& row : refnode::variants())
    fmt::print("{}\n    {}\n    legal by {}\n", row.id, row.summary, row.legal);
}

/// Where the twin is not what its description says; a file with many mistakes is not worth a flood.
void print_remarks(const refnode::TwinRemarks& remarks, const std::string& file) {
  constexpr std::size_t most_lines = 20;
  const auto& all = remarks.all();
  for (std::size_t i = 0; i < all.size() && i < most_lines; ++i) {
    const std::string place = all[i].at.known() ? ":" + to_string(all[i].at) : "";
    fmt::print(stderr, "{}{}: warning: {}\n", file, place, all[i].text);
  }
  const std::size_t total = all.size() + remarks.left_out();
  if (total > most_lines) fmt::print(stderr, "{}: {} more warnings\n", file, total - most_lines);
}

/// A device stays switched on when its cable is pulled.
void say_outage(const std::optional<conform::Error>& outage) {
  fmt::print(stderr, "canopen-refnode: {}\n",
             outage ? outage->text() + "; waiting for it" : "the bus is back");
}

int complain(const conform::Error& error, int code) {
  fmt::print(stderr, "canopen-refnode: {}\n", error.text());
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  namespace usage = conform::usage;
  CLI::App app{
      "A conformant CANopen device (CiA 301) on a CAN interface, with defects on request: the reference node, "
      "or with --eds the twin of any device. SIGUSR1 switches its power off and on: what was not stored is "
      "lost. It ends with SIGINT or SIGTERM."};
  std::string interface_name;
  std::string storage_file;
  std::string description_file;
  int node_id = 1;
  std::uint32_t serial = 1;
  refnode::Options options;
  bool list = false;
  bool list_legal = false;
  bool print_eds = false;
  std::string shell;
  app.add_option("-i,--interface", interface_name, "CAN interface, for example vcan0")->type_name("NAME");
  const auto* node_option =
      app.add_option(
             "-n,--node", node_id,
             "node-ID, 1 to 127, or 255: none, it waits for one by LSS; without it that of the DCF given by "
             "--eds")
          ->check((CLI::Range(1, 127) | CLI::IsMember({255})).description(""))
          ->type_name("NODE-ID")
          ->capture_default_str();
  auto* description_option =
      app.add_option(
             "--eds", description_file,
             "serve the device that this EDS, DCF, XDD or XDC describes; what cannot be served as it is "
             "written is warned of")
          ->type_name("FILE");
  app.add_option("-d,--defect", options.defects, "defect to switch on; may be repeated")->type_name("ID");
  app.add_option("--variant", options.variants, "legal variant to switch on; may be repeated")
      ->type_name("ID");
  auto* serial_option =
      app.add_option("--serial", serial, "serial number, 1018h:04, instead of 1")->type_name("NUMBER");
  app.add_option("--storage", storage_file, "file that keeps the parameters stored by 1010h")
      ->type_name("FILE");
  app.add_flag("--list-defects", list, "print all defects and what they violate");
  app.add_flag("--list-variants", list_legal, "print all legal variants and why they are legal");
  app.add_flag("--print-eds", print_eds, "print the device description (EDS) of the reference node")
      ->excludes(description_option);
  app.add_option("--completion", shell, "print what a shell (bash, zsh or fish) reads to complete options")
      ->check(
          CLI::IsMember(std::vector<std::string>(usage::shells.begin(), usage::shells.end())).description(""))
      ->type_name("SHELL");
  app.set_version_flag("--version", "canopen-refnode " CONFORM_VERSION, "print the version");
  const auto told = refnode::manual();
  usage::add_examples(app, told);
  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  if (const auto answer =
          usage::answer_hidden(app, arguments, told, refnode::known_values, CONFORM_VERSION)) {
    if (!*answer) return complain(answer->error(), exit_usage);
    fmt::print("{}", **answer);
    return 0;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_usage;
  }
  if (!shell.empty()) {
    fmt::print("{}", usage::completion_script(shell, "canopen-refnode"));
    return 0;
  }
  if (list) {
    list_defects();
    return 0;
  }
  if (list_legal) {
    list_variants();
    return 0;
  }
  if (print_eds) {
    fmt::print("{}", refnode::eds_text());
    return 0;
  }
  if (interface_name.empty()) {
    return complain({"no interface given", {}, "for example --interface vcan0"}, exit_usage);
  }

  if (!description_file.empty()) {
    auto file = conform::eds::read_file(description_file);
    if (!file) return complain(file.error(), exit_usage);
    if (node_option->empty()) node_id = refnode::configured_node_id(*file).value_or(1);
    options.description = std::make_shared<const conform::eds::EdsFile>(std::move(*file));
  }
  options.node_id = static_cast<std::uint8_t>(node_id);
  if (!storage_file.empty()) {
    auto storage = refnode::FileStorage::open(storage_file);
    if (!storage) return complain(storage.error(), exit_environment);
    options.storage = *storage;
  }
  if (!serial_option->empty()) {
    options.adjust = [serial](refnode::Parts& parts) {
      if (refnode::Entry* entry = parts.device.dictionary.entry(0x1018, 4))
        entry->value = entry->default_value = conform::to_le(serial, 4);
    };
  }
  std::string behaviour =
      options.defects.empty() ? "conformant" : "with " + conform::join(options.defects, ", ");
  if (!options.variants.empty()) behaviour += ", as " + conform::join(options.variants, ", ");
  const auto node = refnode::PoweredNode::create(options);
  if (!node) return complain(node.error(), exit_usage);
  if (options.description) {
    print_remarks((*node)->node().remarks(), description_file);
    behaviour.insert(0, "twin of " + description_file + ", ");
  }

  conform::can::StopFlag stop;
  stop_flag = &stop;
  powered = node->get();
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGUSR1, on_power_signal);
  Announced announced(**node,
                      fmt::format("canopen-refnode: node {} on {}, {}", node_id, interface_name, behaviour));
  const auto done = conform::can::run_on_interface(announced, interface_name, stop, say_outage);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGUSR1, SIG_IGN);
  powered = nullptr;
  stop_flag = nullptr;
  return done ? 0 : complain(done.error(), exit_environment);
}
