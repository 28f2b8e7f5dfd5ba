// SPDX-License-Identifier: Apache-2.0
// What a description says of an entry of which only a scan is known.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "canopen/data_type.hpp"
#include "device/dictionary.hpp"
#include "engine/scan.hpp"

namespace conform::cli {

struct DraftedEntry {
  std::string name;
  canopen::DataType type = canopen::DataType::octet_string;
  device::Access access = device::Access::rw;
  std::string default_value;  ///< as an EDS writes it
  bool mapped = false;
  bool length_only = false;         ///< INTEGER and REAL look like the UNSIGNED of the same length
  std::vector<std::string> doubts;  ///< sentences for a person
};

/// Drafts the entries of one scan. CiA 301 tells the types and names of its own entries; of others the length
/// is known, whether it is text, and from the mappings how many bits it has and which way it goes.
class EntryDrafter {
 public:
  /// `objects` must outlive the drafter.
  EntryDrafter(std::span<const engine::ScannedObject> objects, NodeId node);
  /// `structured`: the entry is a sub-index of an ARRAY or RECORD.
  [[nodiscard]] DraftedEntry draft(const engine::ScannedEntry& entry, bool structured) const;
  /// By what is read alone: the text or the UNSIGNED of this length, OCTET_STRING, DOMAIN.
  [[nodiscard]] static canopen::DataType type_by_length(const engine::ScannedEntry& entry);
  /// Index and sub-index of what RPDOs and of what TPDOs map at present.
  [[nodiscard]] const std::set<std::uint32_t>& received() const { return received_; }
  [[nodiscard]] const std::set<std::uint32_t>& transmitted() const { return transmitted_; }

 private:
  [[nodiscard]] std::string default_of(const engine::ScannedEntry& entry, const DraftedEntry& drafted) const;
  [[nodiscard]] static device::Access access_of(const engine::ScannedEntry& entry, device::Access guess);

  NodeId node_;
  std::set<std::uint32_t> received_, transmitted_;
  std::map<std::uint32_t, unsigned> mapped_bits_;
};

/// Index and sub-index in one number, as a mapping entry has them in its upper bits.
[[nodiscard]] std::uint32_t mapping_key(Multiplexer mux);

}  // namespace conform::cli
