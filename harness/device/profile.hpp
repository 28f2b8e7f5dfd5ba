// SPDX-License-Identifier: Apache-2.0
// The device profile: what the user says about the device under test beyond its EDS (device.yaml).
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/strong.hpp"
#include "base/time.hpp"
#include "device/dictionary.hpp"
#include "device/waiver.hpp"
#include "yaml/diagnostic.hpp"
#include "yaml/loader.hpp"

namespace conform::eds {
struct EdsFile;
}  // namespace conform::eds

namespace conform::device {

/// A feature that can be claimed, as the word of the profile and of `when` conditions.
struct Feature {
  std::string_view word;
  std::string_view meaning;
};
/// The closed list, in the order of the documentation.
[[nodiscard]] std::span<const Feature> features();
[[nodiscard]] bool is_feature(std::string_view word);

/// One write of an error trigger or of the store fault.
struct TriggerWrite {
  Multiplexer object;
  std::string value;  ///< literal as written in the file
  Bytes bytes;        ///< the literal as wire bytes of the object's type
  std::string open;   ///< place in the profile, as long as only the device description can tell the type
};

/// A way to raise and clear one error of the device.
struct ErrorTrigger {
  std::string name;
  std::uint16_t code = 0;             ///< EMCY error code that is raised
  std::optional<TriggerWrite> raise;  ///< by writing an object, or
  std::optional<TriggerWrite> clear;
  std::optional<NodeId> heartbeat_node;  ///< by the heartbeat of this (otherwise unused) node that stays away
};

/// What is written to the output shows at the input: the bench is wired so, or the device loops it back.
struct Wire {
  Multiplexer output;
  Multiplexer input;
};

/// How storing (1010h) and restoring (1011h) are made to fail, for devices that can simulate it.
struct StoreFault {
  TriggerWrite arm;
  TriggerWrite disarm;
};

/// Where the device description tells of what: "device.eds:120". Also of what no test judges, and of what the
/// profile says otherwise.
struct DescribedPlaces {
  std::map<Index, std::string> objects;
  std::map<Multiplexer, std::string> entries;
  /// Of [DeviceInfo], by the words of the conditions that ask for it: "profile.rpdos", "bus bit rate".
  std::map<std::string, std::string> info;
};

/// Wanted content of 1018h; what is absent is not compared.
struct Identity {
  std::optional<std::uint32_t> vendor, product, revision, serial;
};

/// What the description says of the device as a whole ([DeviceInfo] of an EDS); what it does not say is not
/// compared.
struct DeviceInfo {
  std::optional<std::uint64_t> rpdos, tpdos;  ///< how many there are
  std::optional<bool> lss;
  std::vector<std::uint32_t> bit_rates;  ///< kbit/s, ascending; empty: not said
};

struct Profile {
  std::string name;  ///< of the device, for reports
  std::string about;
  NodeId node{1};
  std::string interface;  ///< empty: given on the command line
  std::string eds;        ///< path as written, relative to the profile's folder; empty: none

  Duration boot_time = std::chrono::seconds{5};            ///< T_BOOT
  Duration sdo_timeout = std::chrono::milliseconds{1000};  ///< T_SDO
  Duration store_timeout = std::chrono::seconds{10};       ///< T_NVM
  Duration nmt_time = std::chrono::milliseconds{100};      ///< T_NMT
  Duration process_time = std::chrono::milliseconds{100};  ///< T_PROC
  Duration quiet_time = std::chrono::milliseconds{300};    ///< T_QUIET
  Duration server_timeout = std::chrono::seconds{30};      ///< T_SRVTO
  Duration block_timeout = std::chrono::seconds{3};        ///< T_BLK
  Duration lss_timeout = std::chrono::milliseconds{500};   ///< T_LSS

  std::set<std::string, std::less<>> claims;       ///< words of features()
  std::set<std::string, std::less<>> not_claimed;  ///< taken back, whatever the device description shows
  std::vector<Entry>
      objects;  ///< claimed entries in file order, all with `claimed` set; defaults without the node-ID
  std::vector<ErrorTrigger> errors;
  std::optional<StoreFault> store_fault;
  std::vector<Wire> wired;
  std::optional<Multiplexer> clock;       ///< the entry that shows the time that TIME sets
  std::map<Index, bool> placeholders;     ///< data types the description allows or forbids in an RPDO
  std::vector<Multiplexer> safe_objects;  ///< entries that tests may write
  std::vector<Multiplexer> untouchable;   ///< entries no test may write
  bool writes_described =
      false;                ///< tests may write every application entry that the description calls writable
  std::string power_cycle;  ///< shell command that takes the power of the device away and gives it back;
                            ///< empty: by hand
  /// Nothing is stored: values after a reset are the defaults. nullopt: nobody says so, and it may show.
  std::optional<bool> factory_defaults;
  std::string described_in;  ///< file of the device description, as the user wrote it; empty: none
  DescribedPlaces described_places;
  /// The file that was given; empty: none.
  std::shared_ptr<const eds::EdsFile> description;
  DeviceInfo device_info;
  Identity identity;
  std::vector<Waiver> waivers;  ///< known_deviations, and those of files of waivers

  /// What the profile says of its own and what its device description shows add up.
  [[nodiscard]] bool claimed(std::string_view feature) const { return claims.contains(feature); }
  [[nodiscard]] bool is_safe(Multiplexer mux) const;
  [[nodiscard]] bool is_untouchable(Multiplexer mux) const;
  /// Where the device description tells of the entry, "device.eds:120", or that it does not, "device.eds,
  /// without 2001h:00". There must be one.
  [[nodiscard]] std::string place_of(Multiplexer mux) const;
  /// What `device_info` says, by the key of the file: "rpdos", "tpdos", "lss" (0 or 1).
  [[nodiscard]] std::optional<std::uint64_t> told(std::string_view key) const;
  /// T_BOOT, T_SDO, T_NVM, T_NMT, T_PROC, T_QUIET, T_SRVTO, T_BLK, T_LSS by name, as conversations write
  /// them; also the keys of the file ("boot_time").
  [[nodiscard]] std::optional<Duration> duration(std::string_view name) const;
};

/// All of these times, for a device or a machine that is slower than they were written for.
void scale_times(Profile& profile, double factor);

/// What CiA 301 defines, with the claimed entries of the profile laid over it and the node-ID in the
/// defaults. Records and arrays of the profile's own get their sub-index 00h when it is not listed.
[[nodiscard]] Dictionary dictionary_of(const Profile& profile);

/// The profile used when there is none: node-ID, defaults, the heartbeat error trigger with node 7Eh.
[[nodiscard]] Profile default_profile(NodeId node);

/// Reads a profile out of a YAML document. All mistakes are in `diagnostics`; the result is usable when it
/// has no errors.
[[nodiscard]] Profile load_profile(const yaml::Node& root, yaml::Diagnostics& diagnostics);

struct ProfileDocument {
  Profile profile;
  yaml::Diagnostics diagnostics;  ///< ask has_errors() before using the profile
};
/// Reads the file; the Error is about the file as a whole (missing, too large, no YAML).
[[nodiscard]] Result<ProfileDocument> load_profile_file(const std::string& path);

}  // namespace conform::device
