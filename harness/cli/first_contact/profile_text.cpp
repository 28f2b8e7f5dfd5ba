// SPDX-License-Identifier: Apache-2.0
#include "cli/first_contact/profile_text.hpp"

#include <algorithm>
#include <chrono>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "canopen/pdo.hpp"
#include "cli/descriptions/drafted_entry.hpp"
#include "cli/first_contact/claims.hpp"
#include "device/standard_objects.hpp"

namespace conform::cli {
namespace {

using engine::ScannedEntry;
using engine::ScannedObject;

constexpr std::size_t most_suggestions = 40;
constexpr std::size_t most_wires = 8;
constexpr std::uint16_t first_of_application = 0x2000;

/// As YAML takes it whatever it holds.
std::string quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

std::string groups(std::uint64_t value) {
  const auto digits = fmt::format("{:08X}", value);
  return digits.substr(0, 4) + " " + digits.substr(4) + "h";
}

/// As precise as anybody measures it here.
std::string in_ms(Duration time) {
  return fmt::format("{:.1f} ms", std::chrono::duration<double, std::milli>(time).count());
}

/// Entries that a description of the standard covers, and that are there whatever a device does: no field of
/// an error, no entry of a mapping.
bool can_be_claimed(const ScannedEntry& entry) {
  const auto known = device::standard_entry(entry.mux);
  const auto index = entry.mux.index.value();
  if (!known) return false;
  if (entry.mux.sub != SubIndex(0) &&
      (index == 0x1003 || (index >= 0x1600 && index <= 0x17FF) || (index >= 0x1A00 && index <= 0x1BFF)))
    return false;
  // What has another length than CiA 301 says is judged all the same; it is not to be expected.
  return !entry.value || !known->size() || entry.size_open || *known->size() == entry.value->size();
}

class Text {
 public:
  Text(const Acquaintance& device, const ProfileWords& words)
      : device_(device), words_(words), drafter_(device.objects, device.node) {}

  std::string all() {
    head();
    identity();
    times();
    claims();
    objects();
    application();
    wires();
    clock();
    errors();
    power();
    return std::move(out_);
  }

 private:
  template <typename... Args>
  void line(fmt::format_string<Args...> form, Args&&... args) {
    out_ += fmt::format(form, std::forward<Args>(args)...);
    out_ += '\n';
  }

  void head() {
    line("# Device profile, written by canopen-conform init {}.", words_.how);
    line("# Lines that begin with '#' and no blank are suggestions: take the '#' away where they hold.");
    line("# 'canopen-conform explain profile' lists all keys, 'canopen-conform lint' tells mistakes.");
    line("format: 1");
    line("name: {}", quoted(name()));
    line("node: {}", device_.node.value());
    if (!words_.interface.empty()) line("interface: {}", words_.interface);
    line("");
    line("# With the description of the device much more is judged.");
    line("#eds: device.eds");
  }

  [[nodiscard]] std::string name() const {
    const auto* object = device_.find(0x1008);
    if (object != nullptr && object->entries.front().value) {
      const auto& value = *object->entries.front().value;
      const auto text = printable(std::string(value.begin(), value.end()));
      if (!trim(text).empty()) return std::string(trim(text));
    }
    return fmt::format("node {}", device_.node.value());
  }

  void identity() {
    std::vector<std::string> kept, left;
    constexpr std::string_view keys[] = {"vendor", "product", "revision", "serial"};
    for (std::uint8_t i = 0; i < 4; ++i) {
      const auto value = device_.number(0x1018, static_cast<std::uint8_t>(i + 1));
      if (!value) continue;
      (i < 2 ? kept : left).push_back(fmt::format("{}: {}", keys[i], groups(*value)));
    }
    if (!kept.empty()) {
      line("");
      line("# 1018h. It holds for each device of this kind; what is of one firmware or one device was");
      line("# {}.", left.empty() ? "not there" : join(left, ", "));
      line("identity: {{{}}}", join(kept, ", "));
    }
    const auto count = [this](std::uint16_t first, std::uint16_t last) {
      return std::ranges::count_if(device_.objects, [&](const ScannedObject& each) {
        return each.index.value() >= first && each.index.value() <= last;
      });
    };
    line("");
    line("# What it has as a whole. Bit rates in kbit/s are for you to say: bit_rates: [125, 250, 500]");
    line("device_info: {{rpdos: {}, tpdos: {}{}}}", count(0x1400, 0x15FF), count(0x1800, 0x19FF),
         device_.lss.value_or(false) ? ", lss: true" : "");
    line("");
    line(
        "# true where nothing was stored in the device since it was made: values after a reset are defaults. A run "
        "finds out by itself where all values are those of a description.");
    line("#factory_defaults: true");
  }

  void times() {
    using std::chrono::duration_cast;
    using std::chrono::milliseconds;
    constexpr milliseconds step{100}, least{500};
    line("");
    line("# How long it may take. The slowest SDO answer came after {}; sdo_timeout is 1 s by default.",
         in_ms(device_.slowest_answer));
    if (device_.heartbeat_period) line("# Heartbeats came every {}.", in_ms(*device_.heartbeat_period));
    if (device_.boot_time) {
      // Twice what was seen: the next start may be a slower one.
      const auto doubled = duration_cast<milliseconds>(*device_.boot_time * 2);
      const auto rounded = std::max(least, (doubled + step - milliseconds(1)) / step * step);
      line("# From a reset to the boot-up message; the longer of two took {}.", in_ms(*device_.boot_time));
      line("boot_time: {} ms", rounded.count());
    } else {
      line("# From a reset to the boot-up message; it was not measured (init --allow config resets twice).");
      line("#boot_time: 5 s");
    }
  }

  void claims() {
    const auto found = claims_of(device_);
    std::size_t width = 0;
    for (const auto* list : {&found.shown, &found.open}) {
      for (const auto& each : *list) width = std::max(width, each.feature.size());
    }
    line("");
    line("# Features that were seen: a device that lacks one of them later is failed. Add what else it has.");
    line("{}claims:", found.shown.empty() ? "#" : "");
    for (const auto& each : found.shown) line("  - {:{}}  # {}", each.feature, width, each.why);
    for (const auto& each : found.open) line("#  - {:{}}  # {}", each.feature, width, each.why);
  }

  /// Entries of CiA 301, consecutive ones in one line.
  void objects() {
    std::vector<std::string> lines;
    for (const auto& object : device_.objects) {
      std::vector<std::uint8_t> subs;
      for (const auto& entry : object.entries) {
        if (can_be_claimed(entry)) subs.push_back(entry.mux.sub.value());
      }
      for (std::size_t first = 0; first < subs.size();) {
        auto last = first;
        while (last + 1 < subs.size() && subs[last + 1] == subs[last] + 1) ++last;
        const Multiplexer mux{object.index, SubIndex(subs[first])};
        lines.push_back(first == last ? to_string(mux)
                                      : fmt::format("{}..{:02X}", to_string(mux), subs[last]));
        first = last + 1;
      }
    }
    line("");
    line(
        "# Entries of CiA 301 that were found. With this list one that is missing later is failed; it counts as");
    line("# a description of the whole device, so take it together with all that holds under 'claims'.");
    line("#objects:");
    for (const auto& each : lines) line("#  - {}", each);
  }

  [[nodiscard]] static bool is_of_application(const ScannedObject& object) {
    return object.index.value() >= first_of_application;
  }
  [[nodiscard]] static bool structured(const ScannedObject& object) { return object.entries.size() > 1; }

  /// What tests could write: neither made by the device nor the count of a record.
  void application() {
    std::vector<std::string> entries, safe;
    std::size_t left_out = 0;
    for (const auto& object : device_.objects) {
      if (!is_of_application(object)) continue;
      for (const auto& entry : object.entries) {
        if (structured(object) && entry.mux.sub == SubIndex(0)) continue;
        const auto key = mapping_key(entry.mux);
        if (!entry.value || drafter_.transmitted().contains(key) || drafter_.received().contains(key))
          continue;
        if (safe.size() == most_suggestions) {
          ++left_out;
          continue;
        }
        const auto drafted = drafter_.draft(entry, structured(object));
        entries.push_back(fmt::format("#  - {{object: {}, name: {}, type: {}, access: rw{}}}  # {}",
                                      to_string(entry.mux), quoted(drafted.name),
                                      canopen::to_string(drafted.type),
                                      structured(object) ? ", kind: RECORD" : "", held(entry)));
        safe.push_back(to_string(entry.mux));
        if (first_number_.empty() && canopen::is_integer(drafted.type)) first_number_ = safe.back();
      }
    }
    if (!safe.empty()) {
      line(
          "# Of the application, by a guess: type by length, access not tried. Better said by an EDS; a draft");
      line("# of one: canopen-conform scan --output device.eds");
      for (const auto& each : entries) line("{}", each);
      if (left_out > 0) line("# and {} more", left_out);
    }
    line("");
    line(
        "# What tests may write from 2000h on. Nothing here is safe because it stands here: take what moves");
    line("# nothing and breaks nothing. One string or DOMAIN of 29 bytes or more lets most scenarios about");
    line("# segmented and block transfers run.");
    if (safe.empty()) {
      line("#safe_objects: []");
    } else {
      line("#safe_objects:");
      for (const auto& each : safe) line("#  - {}", each);
    }
    line("# Entries no test may write, not even those of CiA 301.");
    line("#untouchable: []");
  }

  [[nodiscard]] static std::string held(const ScannedEntry& entry) {
    constexpr std::size_t most = 8;
    const auto& value = *entry.value;
    if (value.size() > most) return fmt::format("{} bytes", value.size());
    return value.empty() ? std::string("empty") : hex_bytes(value);
  }

  /// Where TIME is known, entries of its length may show it.
  void clock() {
    constexpr std::size_t time_of_day_size = 6;
    const auto is_time = [](const auto& object) { return object.index == Index(0x1012); };
    if (std::ranges::none_of(device_.objects, is_time)) return;
    std::string shown = "2F10h:00";
    for (const auto& object : device_.objects) {
      if (!is_of_application(object)) continue;
      const auto found = std::ranges::find_if(object.entries, [](const ScannedEntry& entry) {
        return entry.value && entry.value->size() == time_of_day_size;
      });
      if (found == object.entries.end()) continue;
      shown = to_string(found->mux);
      break;
    }
    line("");
    line("# The entry of type TIME_OF_DAY that shows the time that TIME sets (1012h).");
    line("#clock: {}", shown);
  }

  /// Outputs with inputs of the same length, in their order: what a bench might have connected.
  void wires() {
    const auto of = [this](const std::set<std::uint32_t>& keys) {
      std::vector<const ScannedEntry*> out;
      for (const auto& object : device_.objects) {
        if (!is_of_application(object)) continue;
        for (const auto& entry : object.entries) {
          if (entry.value && !entry.value->empty() && keys.contains(mapping_key(entry.mux)))
            out.push_back(&entry);
        }
      }
      return out;
    };
    const auto outputs = of(drafter_.received());
    auto inputs = of(drafter_.transmitted());
    std::vector<std::string> lines;
    for (const auto* output : outputs) {
      const auto same = std::ranges::find_if(
          inputs, [&](const auto* input) { return input->value->size() == output->value->size(); });
      if (same == inputs.end() || lines.size() == most_wires) continue;
      lines.push_back(
          fmt::format("#  - {{output: {}, input: {}}}", to_string(output->mux), to_string((*same)->mux)));
      inputs.erase(same);
    }
    line("");
    line(
        "# Outputs that are wired to inputs on your bench, byte for byte; outputs belong to safe_objects, too.");
    if (lines.empty()) {
      line("# wired: [{{output: 6200h:01, input: 6000h:01}}]");
      return;
    }
    line("# These are only of the same lengths, as they are mapped: look where your wires go.");
    line("#wired:");
    for (const auto& each : lines) line("{}", each);
  }

  void errors() {
    line("");
    line("# How an error is raised, to see emergency messages and the history (1003h). Without it: the");
    line("# heartbeat of node 7Eh stays away (1016h). Fill in code, object and values of your device.");
    const auto object = first_number_.empty() ? std::string("2100h:00") : first_number_;
    line("{}errors:", first_number_.empty() ? "# " : "#");
    line(
        "{}  - {{name: my error, code: FF00h, raise: {{object: {}, value: 1}}, clear: {{object: {}, value: 0}}}}",
        first_number_.empty() ? "# " : "#", object, object);
  }

  void power() {
    line("");
    line("# A shell command that switches the power of the device off and on.");
    line("# power_cycle: relay 3 off && sleep 2 && relay 3 on");
  }

  const Acquaintance& device_;
  const ProfileWords& words_;
  EntryDrafter drafter_;
  std::string first_number_;  ///< of the application, as an example
  std::string out_;
};

}  // namespace

std::string profile_text(const Acquaintance& device, const ProfileWords& words) {
  return Text(device, words).all();
}

}  // namespace conform::cli
