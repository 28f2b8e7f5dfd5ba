// SPDX-License-Identifier: Apache-2.0
#include "device/description.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "device/described_value.hpp"
#include "device/feature_objects.hpp"
#include "device/standard_objects.hpp"
#include "eds/expand.hpp"

namespace conform::device {
namespace {

using canopen::DataType;

constexpr std::uint16_t first_of_device = 0x2000;  // below are the objects of CiA 301 and 302

std::optional<ObjectCode> code_of(eds::ObjectCode code) {
  switch (code) {
    case eds::ObjectCode::domain: return ObjectCode::domain;
    case eds::ObjectCode::var: return ObjectCode::var;
    case eds::ObjectCode::array: return ObjectCode::array;
    case eds::ObjectCode::record: return ObjectCode::record;
    default: return std::nullopt;  // NULL, DEFTYPE and DEFSTRUCT hold nothing a test could judge
  }
}

/// Whether a number of the type, as wire bytes of one length, is greater than another.
bool above(const Bytes& one, const Bytes& other, bool is_signed) {
  const std::uint64_t sign = is_signed ? std::uint64_t{1} << (8 * one.size() - 1) : 0;
  return (load_le(one) ^ sign) > (load_le(other) ^ sign);
}

class Describer {
 public:
  explicit Describer(const eds::EdsFile& file) : file_(file) { out_.file = file.name; }

  Result<Description> run() {
    auto objects = eds::expand(file_);
    if (!objects) return std::unexpected(objects.error());
    for (const auto& object : *objects) add_object(object);
    if (const auto node = eds::number_of(file_.commissioning.node_id); node && *node >= 1 && *node <= 127)
      out_.node = NodeId(static_cast<std::uint8_t>(*node));
    claim_features();
    return std::move(out_);
  }

 private:
  void add_object(const eds::Object& object) {
    const auto& main = object.entry;
    out_.places.objects.emplace(object.index, place(main.at.known() ? main.at : main.implied_by));
    const bool structured = eds::is_structured(object);
    auto code = structured ? ObjectCode::record : ObjectCode::var;
    if (const auto written = eds::object_code(object.entry)) {
      const auto known = code_of(*written);
      if (!known && object.subs.empty()) return;
      code = known.value_or(code);
    }
    if (!structured) add_entry(object, {object.index, SubIndex(0)}, object.entry, code);
    for (const auto& sub : object.subs) add_entry(object, {object.index, sub.sub}, sub.entry, code);
  }

  void add_entry(const eds::Object& object, Multiplexer mux, const eds::Entry& described, ObjectCode code) {
    const auto standard = standard_entry(mux);
    Entry entry = standard.value_or(Entry{});
    entry.mux = mux;
    entry.claimed = true;
    entry.object = code;
    const auto& name =
        described.parameter_name.empty() ? object.entry.parameter_name : described.parameter_name;
    if (!name.empty()) entry.name = printable(name.text);
    const auto at = described.at.known() ? described.at : described.implied_by;
    entry.described = true;
    out_.places.entries.emplace(mux, place(at));
    read_type(described, standard.has_value(), entry);
    if (const auto access = eds::access(described)) {
      entry.access = access_of(*access);
      entry.access_open = false;
    } else if (!standard) {
      // Nobody says: whether it can be written is for the device to show.
      entry.access = Access::rw;
      entry.access_open = true;
    }
    entry.low = limit(described.low_limit, "low limit", entry);
    entry.high = limit(described.high_limit, "high limit", entry);
    if (entry.low && entry.high && above(*entry.low, *entry.high, canopen::is_signed(entry.type))) {
      unused(described.low_limit.at,
             fmt::format("the low limit of {}, '{}', is above the high limit, '{}': neither is used",
                         to_string(mux), printable(eds::shortened(described.low_limit.text)),
                         printable(eds::shortened(described.high_limit.text))));
      entry.low.reset();
      entry.high.reset();
    }
    read_default(described, entry);
    // rwr and rww tell into which PDOs, PDOMapping whether at all; without it the words are enough.
    if (!described.pdo_mapping.empty()) {
      entry.pdo_mappable = eds::pdo_mapping(described) != eds::PdoMapping::no;
    } else if (entry.access == Access::rwr || entry.access == Access::rww) {
      entry.pdo_mappable = true;
    }
    // What only the device writes may have another value at any time: process inputs, counters, temperatures.
    if (mux.index.value() >= first_of_device && mux.sub.value() == 0 && code != ObjectCode::var) {
      entry.may_change = false;  // how many sub-indices there are does not change by itself
    } else if (mux.index.value() >= first_of_device &&
               (entry.access == Access::ro || entry.access == Access::rwr)) {
      entry.may_change = true;
    }
    // CiA 306 means configuration tools: what they must not write or read by the way (1003h, 1010h, 1011h)
    // has scenarios that do it on purpose.
    if (!standard) {
      entry.untouchable = eds::refuses_write(described);
      entry.not_to_be_read = eds::refuses_read(described);
    }
    out_.entries.push_back(std::move(entry));
  }

  void read_type(const eds::Entry& described, bool standard, Entry& entry) {
    const auto number = eds::data_type(described);
    const auto type = number ? canopen::data_type_at(*number) : std::nullopt;
    if (type) {
      if (*type == entry.type && standard) return;
      entry.type = *type;
    } else if (entry.object == ObjectCode::domain) {
      entry.type = DataType::domain;
    } else if (!standard) {
      entry.type = DataType::octet_string;  // of any length
      if (number && *number != 0) {
        unused(described.data_type.at,
               fmt::format("the data type {} of {} is none of the basic ones: its length is not compared",
                           hex(*number, 4), to_string(entry.mux)));
      }
    } else {
      return;
    }
    // The standard's values are of another length.
    entry.default_value.reset();
    entry.default_adds_node_id = false;
  }

  std::optional<Bytes> limit(const eds::Field& field, std::string_view what, const Entry& entry) {
    if (field.empty() || !canopen::is_integer(entry.type)) return std::nullopt;
    auto value = read_described_value(entry.type, field.text);
    if (value && !value->adds_node_id) return std::move(value->bytes);
    const auto why = value ? std::string("is a formula") : value.error().what;
    unused(field.at, fmt::format("the {} of {}, '{}', {}: it is not used", what, to_string(entry.mux),
                                 printable(eds::shortened(field.text)), why));
    return std::nullopt;
  }

  void read_default(const eds::Entry& described, Entry& entry) {
    const bool configured = !described.parameter_value.empty();
    // A DCF says what a device was set to, and so does a draft that was made from what the device held.
    entry.configured =
        is_draft_ || (configured && described.parameter_value.text != described.default_value.text);
    const auto& field = configured ? described.parameter_value : described.default_value;
    entry.declared_default = false;
    if (field.empty() || entry.type == DataType::domain) return;
    auto value = read_described_value(entry.type, field.text);
    if (!value) {
      unused(field.at,
             fmt::format("the {} of {}, '{}', {}: it is not compared", configured ? "value" : "default",
                         to_string(entry.mux), printable(eds::shortened(field.text)), value.error().what));
      return;
    }
    entry.default_value = std::move(value->bytes);
    entry.default_adds_node_id = value->adds_node_id;
    entry.declared_default = true;
  }

  void claim_features() {
    for (const auto& entry : out_.entries) {
      const auto index = entry.mux.index.value();
      for (const auto& row : features_of_objects()) {
        if (row.holds(index)) out_.claims.emplace(row.feature);
      }
      const bool mapping = (index >= 0x1600 && index <= 0x17FF) || (index >= 0x1A00 && index <= 0x1BFF);
      if (mapping && entry.writable()) out_.claims.emplace("variable mapping");
      // Of three objects the default tells what the device does with them.
      const auto value = entry.default_value ? load_le(*entry.default_value) : 0;
      constexpr std::uint64_t generates = std::uint64_t{1} << 30U, consumes = std::uint64_t{1} << 31U;
      if (index == 0x1000 && (value & 0xFFFFU) != 0) out_.claims.emplace("profile device");
      if (index == 0x1005) out_.claims.emplace((value & generates) != 0 ? "sync producer" : "sync consumer");
      if (index == 0x1012 && (value & consumes) != 0) out_.claims.emplace("time consumer");
      if (index == 0x1012 && (value & generates) != 0) out_.claims.emplace("time producer");
    }
    for (const auto& [type, field] : file_.dummy_usage.entries) {
      if (const auto allowed = eds::flag_of(field); allowed && type <= 0x001B)
        out_.placeholders.emplace(Index(static_cast<std::uint16_t>(type)), *allowed);
    }
    const auto& info = file_.device_info;
    if (eds::flag_of(info.lss_supported).value_or(false)) out_.claims.emplace("lss");
    out_.info.lss = eds::flag_of(info.lss_supported);
    out_.info.rpdos = eds::number_of(info.nr_of_rx_pdo);
    out_.info.tpdos = eds::number_of(info.nr_of_tx_pdo);
    for (const auto& [rate, field] : info.baud_rates) {
      if (eds::flag_of(field).value_or(false) && rate <= 1000)
        out_.info.bit_rates.push_back(static_cast<std::uint32_t>(rate));
    }
    std::ranges::sort(out_.info.bit_rates);
    const auto tells = [this](const char* words, const eds::Field& field) {
      if (field.present) out_.places.info.emplace(words, place(field.at));
    };
    tells("profile.rpdos", info.nr_of_rx_pdo);
    tells("profile.tpdos", info.nr_of_tx_pdo);
    tells("profile.lss", info.lss_supported);
    if (!info.baud_rates.empty()) tells("bus bit rate", info.baud_rates.front().field);
  }

  [[nodiscard]] std::string place(eds::Position at) const {
    return at.known() ? fmt::format("{}:{}", file_.name, at.line) : file_.name;
  }
  void unused(eds::Position at, std::string what) {
    if (out_.unused.size() == Description::most_unused) {
      ++out_.unused_left_out;
      return;
    }
    out_.unused.push_back({file_.name + (at.known() ? ":" + eds::to_string(at) : ""), std::move(what)});
  }

  const eds::EdsFile& file_;
  /// Made from a device by `scan`: its defaults are what the device held then.
  const bool is_draft_ = file_.file_info.created_by.text.starts_with("canopen-conform scan");
  Description out_;
};

}  // namespace

Result<Description> describe(const eds::EdsFile& file) { return Describer(file).run(); }

void add_description(Profile& profile, Description description) {
  std::vector<Multiplexer> listed;
  for (const auto& entry : profile.objects) listed.push_back(entry.mux);
  std::ranges::sort(listed);
  for (auto& entry : description.entries) {
    if (entry.untouchable) profile.untouchable.push_back(entry.mux);
    if (!std::ranges::binary_search(listed, entry.mux)) profile.objects.push_back(std::move(entry));
  }
  for (const auto& [type, allowed] : description.placeholders) profile.placeholders.emplace(type, allowed);
  auto& info = profile.device_info;
  if (!info.rpdos) info.rpdos = description.info.rpdos;
  if (!info.tpdos) info.tpdos = description.info.tpdos;
  if (!info.lss) info.lss = description.info.lss;
  if (info.bit_rates.empty()) info.bit_rates = std::move(description.info.bit_rates);
  profile.described_in = description.file;
  profile.described_places = std::move(description.places);
  for (const auto& feature : description.claims) {
    if (!profile.not_claimed.contains(feature)) profile.claims.insert(feature);
  }
}

Result<void> complete_writes(Profile& profile) {
  std::vector<TriggerWrite*> open;
  const auto look = [&open](TriggerWrite& write) {
    if (!write.open.empty()) open.push_back(&write);
  };
  for (auto& trigger : profile.errors) {
    if (trigger.raise) look(*trigger.raise);
    if (trigger.clear) look(*trigger.clear);
  }
  if (profile.store_fault) {
    look(profile.store_fault->arm);
    look(profile.store_fault->disarm);
  }
  for (auto* write : open) {
    const auto entry = std::ranges::find(profile.objects, write->object, &Entry::mux);
    if (entry == profile.objects.end()) {
      return fail(fmt::format("{} is neither under 'objects' nor in the device description",
                              to_string(write->object)),
                  write->open);
    }
    auto bytes = canopen::encode(entry->type, write->value);
    if (!bytes) return fail(bytes.error().what, write->open, bytes.error().hint);
    write->bytes = *std::move(bytes);
    write->open.clear();
  }
  return {};
}

}  // namespace conform::device
