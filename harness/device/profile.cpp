// SPDX-License-Identifier: Apache-2.0
#include "device/profile.hpp"

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "canopen/program_control.hpp"
#include "device/profile_fields.hpp"
#include "device/standard_objects.hpp"

namespace conform::device {
namespace {

constexpr std::array<Feature, 39> feature_table{{
    {"emcy", "sends emergency messages (1014h)"},
    {"emcy consumer", "consumes emergency messages of other nodes (1028h)"},
    {"error behaviour", "offers the error behaviour object 1029h"},
    {"heartbeat producer", "sends heartbeats (1017h)"},
    {"heartbeat consumer", "watches heartbeats of other nodes (1016h)"},
    {"node guarding", "answers guarding requests"},
    {"life guarding", "watches guarding requests (100Ch, 100Dh)"},
    {"sync producer", "can send SYNC (1005h, 1006h)"},
    {"sync consumer", "acts on SYNC (1005h)"},
    {"sync counter", "knows SYNC messages with a counter (1019h)"},
    {"time producer", "can send TIME (1012h)"},
    {"time consumer", "acts on TIME (1012h)"},
    {"clock", "shows the time that TIME sets in the entry that `clock` names"},
    {"rpdo", "receives PDOs"},
    {"tpdo", "transmits PDOs"},
    {"variable mapping", "the PDO mapping can be changed"},
    {"mpdo", "multiplex PDOs"},
    {"remote frames", "answers remote frames for TPDOs"},
    {"store", "stores parameters on command (1010h)"},
    {"restore", "restores default parameters on command (1011h)"},
    {"autonomous storing", "stores parameters by itself"},
    {"segmented sdo", "segmented SDO transfer"},
    {"block sdo", "SDO block transfer"},
    {"additional sdo servers", "SDO servers beyond the default one (1201h and up)"},
    {"sdo client", "SDO client (1280h and up)"},
    {"base frames only", "11-bit identifiers only: bit 29 of COB-IDs cannot be set"},
    {"fixed cob-ids", "COB-IDs cannot be changed"},
    {"nmt master", "sends NMT commands"},
    {"application profile", "follows an application profile, with COB-IDs of its own"},
    {"profile device", "follows a device profile (low word of 1000h)"},
    {"logical devices", "holds more than one logical device"},
    {"modular device", "lists its modules in 1027h"},
    {"lss", "layer setting services (CiA 305)"},
    {"lss identify remote slave", "answers when its LSS address is in the ranges of a master (46h to 4Bh)"},
    {"lss identify non-configured", "tells that it has no node-ID (4Ch)"},
    {"lss fastscan", "can be found by fastscan (51h)"},
    {"program download", "takes programs (1F50h)"},
    {"tpdo on change", "an event-driven TPDO is sent when an object in it changes"},
    {"only node on the bus", "no other node is there: commands to all nodes may be sent"},
}};

/// Without a word of the profile it may be any time that the device keeps itself: of an error, of a service.
void note_clocks(Dictionary& dictionary, const std::optional<Multiplexer>& named) {
  std::vector<Multiplexer> clocks;
  for (const Entry& entry : dictionary.entries()) {
    const bool may_be =
        entry.type == canopen::DataType::time_of_day && entry.access == Access::ro && entry.may_change;
    if (named ? entry.mux == *named : may_be) clocks.push_back(entry.mux);
  }
  for (const Multiplexer mux : clocks) dictionary.find(mux)->clock = true;
}

}  // namespace

std::span<const Feature> features() { return feature_table; }

bool is_feature(std::string_view word) {
  return std::ranges::find(feature_table, word, &Feature::word) != feature_table.end();
}

bool Profile::is_safe(Multiplexer mux) const {
  return std::ranges::find(safe_objects, mux) != safe_objects.end();
}
bool Profile::is_untouchable(Multiplexer mux) const {
  return std::ranges::find(untouchable, mux) != untouchable.end();
}

std::string Profile::place_of(Multiplexer mux) const {
  const auto& places = described_places.entries;
  if (const auto entry = places.find(mux); entry != places.end()) return entry->second;
  const auto object = described_places.objects.find(mux.index);
  if (object == described_places.objects.end()) return described_in + ", without " + to_string(mux.index);
  // A data type has no entries.
  const auto first = places.lower_bound({mux.index, SubIndex(0)});
  const bool has_entries = first != places.end() && first->first.index == mux.index;
  return object->second + (has_entries ? ", without " + to_string(mux) : "");
}

std::optional<Duration> Profile::duration(std::string_view wanted) const {
  for (const DurationField& field : duration_fields()) {
    if (field.key == wanted || field.symbol == wanted) return this->*field.member;
  }
  return std::nullopt;
}

std::span<const DurationField> duration_fields() {
  static constexpr std::array<DurationField, 9> fields{{
      {"boot_time", "T_BOOT", &Profile::boot_time},
      {"sdo_timeout", "T_SDO", &Profile::sdo_timeout},
      {"store_timeout", "T_NVM", &Profile::store_timeout},
      {"nmt_time", "T_NMT", &Profile::nmt_time},
      {"process_time", "T_PROC", &Profile::process_time},
      {"quiet_time", "T_QUIET", &Profile::quiet_time},
      {"server_timeout", "T_SRVTO", &Profile::server_timeout},
      {"block_timeout", "T_BLK", &Profile::block_timeout},
      {"lss_timeout", "T_LSS", &Profile::lss_timeout},
  }};
  return fields;
}

void scale_times(Profile& profile, double factor) {
  for (const DurationField& field : duration_fields()) {
    const auto scaled = std::chrono::duration<double, Duration::period>(profile.*field.member) * factor;
    profile.*field.member = std::chrono::round<Duration>(scaled);
  }
}

Dictionary dictionary_of(const Profile& profile) {
  Dictionary dictionary = standard_dictionary(profile.node);
  for (const Entry& entry : profile.objects) dictionary.add(at_node(entry, profile.node));
  for (const Entry& entry : profile.objects) {
    const Multiplexer count{entry.mux.index, SubIndex{0}};
    if (entry.mux.sub.value() == 0 || dictionary.has(count)) continue;
    Entry added = standard_entry(count).value_or(Entry{});
    if (added.name.empty()) {
      added.mux = count;
      added.name = "Highest sub-index supported";
      added.type = canopen::DataType::unsigned8;
      added.access = Access::constant;
      added.category = Category::conditional;
      added.object = entry.object;
    }
    added.claimed = true;
    dictionary.add(at_node(added, profile.node));
  }
  for (const Entry& listed : profile.objects) {
    const auto index = listed.mux.index;
    if (index.value() >= 0x2000 || canopen::is_program_control(index))
      dictionary.find(listed.mux)->open_to_writes = false;
  }
  for (const Multiplexer mux : profile.safe_objects) {
    Entry* entry = dictionary.find(mux);
    if (entry == nullptr) continue;
    entry->open_to_writes = true;
    entry->safe = entry->writable() && !profile.is_untouchable(mux);
  }
  if (profile.writes_described) {
    for (const Entry& listed : profile.objects) {
      Entry* entry = dictionary.find(listed.mux);
      const auto index = listed.mux.index.value();
      if (!entry->described || index < 0x2000 || index > 0x9FFF) continue;
      entry->open_to_writes = !entry->command;
      entry->safe =
          entry->writable() && !entry->access_open && !entry->command && !profile.is_untouchable(listed.mux);
    }
  }
  for (const Wire& wire : profile.wired) {
    if (Entry* output = dictionary.find(wire.output)) output->wired_input = wire.input;
  }
  note_clocks(dictionary, profile.clock);
  for (const Multiplexer mux : profile.untouchable) {
    if (Entry* entry = dictionary.find(mux)) {
      entry->untouchable = true;
      entry->open_to_writes = false;
    }
  }
  return dictionary;
}

Profile default_profile(NodeId node) {
  Profile profile;
  profile.node = node;
  // Every heartbeat consumer has it: the heartbeat of another node stays away.
  profile.errors = {
      {.name = "heartbeat loss", .code = 0x8130, .raise = {}, .clear = {}, .heartbeat_node = NodeId{0x7E}}};
  return profile;
}

Result<ProfileDocument> load_profile_file(const std::string& path) {
  auto document = yaml::load_file(path);
  if (!document) return std::unexpected(document.error());
  ProfileDocument out{.profile = {}, .diagnostics = std::move(document->diagnostics)};
  if (document->root) out.profile = load_profile(*document->root, out.diagnostics);
  return out;
}

std::optional<std::uint64_t> Profile::told(std::string_view key) const {
  if (key == "rpdos") return device_info.rpdos;
  if (key == "tpdos") return device_info.tpdos;
  if (key == "lss" && device_info.lss) return *device_info.lss ? 1 : 0;
  return std::nullopt;
}

}  // namespace conform::device
