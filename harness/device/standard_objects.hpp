// SPDX-License-Identifier: Apache-2.0
// The communication objects that CiA 301 v4.2 defines (7.5.2), as entries: the dictionary of a device nobody
// described.
#pragma once

#include <optional>

#include "base/strong.hpp"
#include "device/dictionary.hpp"

namespace conform::device {

/// PDO parameter objects per direction (1400h-15FFh and so on).
inline constexpr int max_pdos = 512;

/// The standard's entry at `mux`, for every index and sub-index it defines (PDO 1..512, SDO servers 1..128,
/// EMCY and heartbeat consumers 1..127, error fields 1..254, PDO mapping entries 1..64); nullopt for
/// everything else. Node-ID dependent defaults hold the constant part and are marked default_adds_node_id.
[[nodiscard]] std::optional<Entry> standard_entry(Multiplexer mux);

/// The type of an entry: as the dictionary has it, or as the standard gives it to one that was not there when
/// the device was surveyed and may be there now, like a field for an error. nullopt: neither knows.
[[nodiscard]] std::optional<canopen::DataType> type_of(const Dictionary& dictionary, Multiplexer mux);

/// With the node-ID in the defaults: objects 1000h-1029h, 1200h, 1201h and 1280h with their sub-indices 00h
/// and those the standard names one by one, and PDO 1..4 with sub-index 00h..08h of the mapping. Arrays show
/// sub-index 00h and 01h: how far they go is for the device to say.
[[nodiscard]] Dictionary standard_dictionary(NodeId node);

}  // namespace conform::device
