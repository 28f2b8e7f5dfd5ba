// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/drafted_entry.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "device/standard_objects.hpp"

namespace conform::cli {
namespace {

using canopen::DataType;
using device::Access;
using engine::ScannedEntry;

constexpr std::size_t longest_string = 255;  ///< more is taken for a DOMAIN

bool is_text(ByteView bytes) {
  return std::ranges::all_of(bytes, [](std::uint8_t c) { return c >= 0x20 && c < 0x7F; });
}

/// Whether the text stays what it is when it stands behind a '='.
bool survives_a_line(ByteView text) {
  const auto is_blank = [](std::uint8_t c) { return c == ' '; };
  return is_text(text) && (text.empty() || (!is_blank(text.front()) && !is_blank(text.back())));
}

std::string pairs_of(ByteView bytes) {
  std::string out;
  for (const auto byte : bytes) out += fmt::format("{:02X}", byte);
  return out;
}

}  // namespace

std::uint32_t mapping_key(Multiplexer mux) {
  return static_cast<std::uint32_t>(mux.index.value()) << 8U | mux.sub.value();
}

EntryDrafter::EntryDrafter(std::span<const engine::ScannedObject> objects, NodeId node) : node_(node) {
  for (const auto& object : objects) {
    const auto index = object.index.value();
    auto* const mapped = index >= 0x1600 && index <= 0x17FF   ? &received_
                         : index >= 0x1A00 && index <= 0x1BFF ? &transmitted_
                                                              : nullptr;
    if (mapped == nullptr) continue;
    for (const auto& entry : object.entries) {
      if (entry.mux.sub.value() == 0 || !entry.value || entry.value->size() != 4) continue;
      const auto mapping = static_cast<std::uint32_t>(load_le(*entry.value));
      if (mapping == 0) continue;
      mapped->insert(mapping >> 8U);
      mapped_bits_.emplace(mapping >> 8U, mapping & 0xFFU);
    }
  }
}

DataType EntryDrafter::type_by_length(const ScannedEntry& entry) {
  if (!entry.value) return DataType::octet_string;
  const auto& value = *entry.value;
  switch (value.size()) {
    case 1: return DataType::unsigned8;
    case 2: return DataType::unsigned16;
    case 3: return DataType::unsigned24;
    case 4: return DataType::unsigned32;
    case 8: return is_text(value) ? DataType::visible_string : DataType::unsigned64;
    default: break;
  }
  if (value.size() > longest_string) return DataType::domain;
  return is_text(value) ? DataType::visible_string : DataType::octet_string;
}

Access EntryDrafter::access_of(const ScannedEntry& entry, Access guess) {
  if (!entry.value && entry.abort == canopen::abort::write_only) return Access::wo;
  if (!entry.writable) return guess;
  if (*entry.writable) return device::is_writable(guess) ? guess : Access::rw;
  return guess == Access::constant ? Access::constant : Access::ro;
}

std::string EntryDrafter::default_of(const ScannedEntry& entry, const DraftedEntry& drafted) const {
  if (!entry.value) return {};
  const auto known = device::standard_entry(entry.mux);
  // Errors and times of the moment are no defaults.
  if (known && known->may_change && entry.mux.index != Index(0x1027)) {
    if (entry.mux == Multiplexer{Index(0x1003), SubIndex(0)}) return "0x0";
    return {};
  }
  const auto& value = *entry.value;
  if (drafted.type == DataType::visible_string)
    return survives_a_line(value) ? std::string(value.begin(), value.end()) : std::string();
  if (drafted.type == DataType::octet_string) return pairs_of(value);
  if (!canopen::is_integer(drafted.type)) return {};
  // Of a length that the device leaves open, what the type has.
  const auto size = std::min(value.size(), canopen::size_bytes(drafted.type).value_or(value.size()));
  const auto number = load_le(ByteView(value).first(size));
  if (known && known->default_adds_node_id && known->default_value) {
    const auto base = load_le(*known->default_value) & canopen::cob_id::base_id_mask;
    // Valid or not, remote frames or not: such bits are beside the CAN-ID.
    if ((number & canopen::cob_id::can_id_mask) == base + node_.value() &&
        (number & canopen::cob_id::extended_frame) == 0)
      return fmt::format("$NODEID+0x{:X}", number - node_.value());
  }
  return fmt::format("0x{:X}", number);
}

DraftedEntry EntryDrafter::draft(const ScannedEntry& scanned, bool structured) const {
  DraftedEntry out;
  const auto known = device::standard_entry(scanned.mux);
  const auto sub = scanned.mux.sub.value();
  const bool fits = known && (!scanned.value || !known->size() || *known->size() == scanned.value->size() ||
                              (scanned.size_open && *known->size() < 4));
  out.type = fits ? known->type : type_by_length(scanned);
  out.name = known         ? known->name
             : !structured ? fmt::format("Object {:04X}h", scanned.mux.index.value())
             : sub == 0    ? std::string("Highest sub-index supported")
                           : fmt::format("Sub-index {:02X}h", sub);
  const auto key = mapping_key(scanned.mux);
  const bool received = received_.contains(key), transmitted = transmitted_.contains(key);
  out.mapped = received || transmitted;
  auto guess = known ? known->access : structured && sub == 0 ? Access::constant : Access::rw;
  // A value that goes into a TPDO is most likely made by the device, one that comes in an RPDO is not.
  if (!known && received != transmitted) guess = received ? Access::rww : Access::ro;
  out.access = access_of(scanned, guess);
  const auto at = to_string(scanned.mux);
  const bool is_number =
      !known && scanned.value && canopen::is_integer(out.type) && !(structured && sub == 0);
  const auto bits = mapped_bits_.find(key);
  if (is_number && bits != mapped_bits_.end() && bits->second == 1 && scanned.value->size() == 1) {
    out.type = DataType::boolean;
  } else {
    out.length_only = is_number;
  }
  if (known && !fits)
    out.doubts.push_back(fmt::format("{} has {} bytes, not those of CiA 301", at, scanned.value->size()));
  if (!scanned.value) {
    // An error that did not happen has no field yet.
    const bool nothing_yet = known && known->may_change && scanned.abort == canopen::abort::no_data;
    if (scanned.abort != canopen::abort::write_only && !nothing_yet) {
      out.doubts.push_back(
          fmt::format("{} could not be read{}", at,
                      scanned.abort ? ": abort " + to_string(*scanned.abort) : std::string()));
    }
    if (!known) out.doubts.push_back(fmt::format("the type of {} is not known", at));
  } else if (!known && scanned.size_open) {
    out.doubts.push_back(fmt::format("{} may be shorter: the device does not tell the length", at));
  }
  out.default_value = default_of(scanned, out);
  if (scanned.value && !scanned.value->empty() && out.default_value.empty() && !(known && known->may_change))
    out.doubts.push_back(fmt::format("what {} holds cannot be written here", at));
  if (scanned.value && scanned.value->empty() && !known)
    out.doubts.push_back(fmt::format("{} held nothing: its type is not known", at));
  if (known && scanned.writable && *scanned.writable != device::is_writable(known->access) &&
      !known->access_open)
    out.doubts.push_back(
        fmt::format("{} is {}, not as CiA 301 says", at, *scanned.writable ? "writable" : "read-only"));
  return out;
}

}  // namespace conform::cli
