// SPDX-License-Identifier: Apache-2.0
// device.yaml to Profile. Everything that is wrong is reported at its place, and reading goes on.
#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "canopen/lss.hpp"
#include "device/profile.hpp"
#include "device/profile_fields.hpp"
#include "device/run_settings.hpp"
#include "device/standard_objects.hpp"
#include "yaml/fields.hpp"

namespace conform::device {
namespace {

using canopen::DataType;
using yaml::Field;
using yaml::Fields;

/// "2000h:05" or "2000h:05..09": consecutive sub-indices of one object.
struct ObjectRange {
  Multiplexer first;
  std::uint8_t last_sub = 0;
};

std::optional<ObjectRange> read_range(const Field& field) {
  if (field.node() == nullptr) return std::nullopt;
  const std::string& written = field.node()->text();
  const std::size_t dots = field.node()->is_scalar() ? written.find("..") : std::string::npos;
  if (dots == std::string::npos) {
    const auto mux = field.multiplexer();
    if (!mux) return std::nullopt;
    return ObjectRange{*mux, mux->sub.value()};
  }
  const auto first = parse_multiplexer(written.substr(0, dots));
  // Reads the last sub-index with the rules of the first one.
  const auto last = parse_multiplexer(fmt::format("0000h:{}", written.substr(dots + 2)));
  if (!first || !last) {
    field.expected("an object", "write index and sub-index as 1003h:00, several as 1003h:00..08");
    return std::nullopt;
  }
  if (last->sub < first->sub) {
    field.error("the last sub-index is below the first");
    return std::nullopt;
  }
  return ObjectRange{*first, last->sub.value()};
}

std::optional<DataType> read_type(const Field& field) {
  if (!field.present()) return std::nullopt;
  std::vector<std::string_view> names;
  for (std::uint16_t index = 1; index <= 0x1B; ++index) {
    if (const auto type = canopen::data_type_at(index)) names.push_back(canopen::to_string(*type));
  }
  const auto word = field.one_of(names);
  return word ? canopen::parse_data_type(*word) : std::nullopt;
}

/// The literal of a value as wire bytes of `type`.
std::optional<Bytes> read_value(const Field& field, DataType type) {
  if (!field.present() || field.node()->faulty()) return std::nullopt;
  if (!field.node()->is_scalar()) {
    field.expected(fmt::format("a value of {}", canopen::to_string(type)));
    return std::nullopt;
  }
  auto bytes = canopen::encode(type, field.node()->text());
  if (!bytes) {
    field.error(bytes.error().what, bytes.error().hint);
    return std::nullopt;
  }
  return *std::move(bytes);
}

/// A default may be written as "180h + N", N the node-ID.
void read_default(const Field& field, Entry& entry) {
  if (!field.present()) return;
  entry.default_adds_node_id = false;
  entry.declared_default = true;
  const std::string& written = field.node()->text();
  const std::size_t plus = written.rfind('+');
  const bool adds = canopen::is_integer(entry.type) && plus != std::string::npos &&
                    trim(std::string_view(written).substr(plus + 1)) == "N";
  if (!adds) {
    entry.default_value = read_value(field, entry.type);
    return;
  }
  auto bytes = canopen::encode(entry.type, trim(std::string_view(written).substr(0, plus)));
  if (!bytes) {
    field.error(bytes.error().what, bytes.error().hint);
    return;
  }
  entry.default_value = *std::move(bytes);
  entry.default_adds_node_id = true;
}

/// Order of two values of one type; 0 for types without an order.
int compare(DataType type, ByteView a, ByteView b) {
  if (!canopen::is_integer(type)) return 0;
  std::uint64_t left = load_le(a);
  std::uint64_t right = load_le(b);
  if (canopen::is_signed(type)) {
    const std::uint64_t sign = std::uint64_t{1} << (a.size() * 8 - 1);
    left ^= sign;
    right ^= sign;
  }
  return left < right ? -1 : left > right ? 1 : 0;
}

void check_limits(const Field& field, const Entry& entry) {
  if (entry.low && entry.high && compare(entry.type, *entry.low, *entry.high) > 0) {
    field.error(fmt::format("the limits of {} are crossed", to_string(entry.mux)),
                "'low' must not be above 'high'");
  }
  if (!entry.default_value || entry.default_adds_node_id) return;
  const bool below = entry.low && compare(entry.type, *entry.default_value, *entry.low) < 0;
  const bool above = entry.high && compare(entry.type, *entry.default_value, *entry.high) > 0;
  if (below || above)
    field.error(fmt::format("the default of {} is outside its limits", to_string(entry.mux)));
}

class Reader {
 public:
  Reader(const yaml::Node& root, yaml::Diagnostics& diagnostics)
      : fields_(root, diagnostics, "device profile") {}

  Profile read() {
    if (fields_.present()) static_cast<void>(fields_.required("format").number(1, 1));
    profile_.name = fields_.required("name").text().value_or("");
    profile_.about = fields_.optional("about").text().value_or("");
    if (const auto node = fields_.required("node").number(1, 127))
      profile_.node = NodeId{static_cast<std::uint8_t>(*node)};
    profile_.interface = fields_.optional("interface").text().value_or("");
    profile_.eds = fields_.optional("eds").text().value_or("");
    read_durations();
    read_claims();
    read_objects();
    read_errors();
    read_store_fault();
    read_wires();
    read_clock();
    read_placeholders();
    profile_.safe_objects = read_entries("safe_objects");
    profile_.untouchable = read_entries("untouchable");
    profile_.power_cycle = fields_.optional("power_cycle").text().value_or("");
    profile_.factory_defaults = fields_.optional("factory_defaults").boolean();
    read_identity();
    read_device_info();
    profile_.waivers = read_waivers(fields_.optional("known_deviations"));
    // The command line reads it for itself, before there is a profile; here only its mistakes count.
    static_cast<void>(read_run_settings(fields_.optional("run")));
    fields_.finish();
    return std::move(profile_);
  }

 private:
  void read_durations() {
    for (const DurationField& field : duration_fields()) {
      const Field given = fields_.optional(field.key);
      const auto value = given.duration();
      if (!value) continue;
      if (*value <= Duration{0}) {
        given.error(fmt::format("'{}' must be longer than nothing", field.key));
        continue;
      }
      profile_.*field.member = *value;
    }
  }

  void read_claims() {
    const Field claims = fields_.optional("claims");
    std::vector<std::string_view> words;
    for (const Feature& feature : features()) words.push_back(feature.word);
    for (const Field& item : claims.items()) {
      const auto word = one_feature(item, words);
      if (word && !profile_.claims.insert(*word).second)
        item.error(fmt::format("'{}' is claimed twice", *word));
    }
    for (const Field& item : fields_.optional("not_claimed").items()) {
      const auto word = one_feature(item, words);
      if (word && profile_.claims.contains(*word))
        item.error(fmt::format("'{}' is claimed, too", *word), "'not_claimed' is for what the EDS shows");
      if (word && !profile_.not_claimed.insert(*word).second)
        item.error(fmt::format("'{}' is listed twice", *word));
    }
  }

  /// Like Field::one_of, but without printing thirty words.
  static std::optional<std::string> one_feature(const Field& item,
                                                const std::vector<std::string_view>& words) {
    auto word = item.text();
    if (!word) return std::nullopt;
    if (is_feature(*word)) return word;
    std::string hint = yaml::suggestion(*word, words);
    if (hint.empty()) hint = "the features are listed in suites/schema/device.schema.json";
    item.error(fmt::format("unknown feature '{}'", *word), std::move(hint));
    return std::nullopt;
  }

  void read_objects() {
    for (const Field& item : fields_.optional("objects").items()) {
      if (item.node()->is_mapping()) {
        read_object(item);
      } else if (const auto range = read_range(item)) {
        claim_standard(item, *range);
      }
    }
  }

  /// "1003h:00..08": entries of the standard that the device has.
  void claim_standard(const Field& item, const ObjectRange& range) {
    for (unsigned sub = range.first.sub.value(); sub <= range.last_sub; ++sub) {
      const Multiplexer mux{range.first.index, SubIndex{static_cast<std::uint8_t>(sub)}};
      auto entry = standard_entry(mux);
      if (!entry) {
        item.error(fmt::format("CiA 301 defines no {}", to_string(mux)),
                   "give it a name, type and access: {object: .., name: .., type: .., access: ..}");
        return;
      }
      add_object(item, *std::move(entry));
    }
  }

  void read_object(const Field& item) {
    Fields fields = item.fields("object");
    const Field object = fields.required("object");
    const auto range = read_range(object);
    const auto standard = range ? standard_entry(range->first) : std::nullopt;
    Entry entry = standard.value_or(Entry{});
    const Field name = standard ? fields.optional("name") : fields.required("name");
    if (const auto text = name.text()) entry.name = *text;
    const Field type_field = standard ? fields.optional("type") : fields.required("type");
    const auto type = read_type(type_field);
    if (standard && type && *type != standard->type) {
      type_field.warning(
          fmt::format("CiA 301 makes {} {}", to_string(range->first), canopen::to_string(standard->type)));
      entry.default_value.reset();
      entry.low.reset();
      entry.high.reset();
    }
    if (type) entry.type = *type;
    const Field access = standard ? fields.optional("access") : fields.required("access");
    if (const auto word = access.one_of<Access>({{"ro", Access::ro},
                                                 {"wo", Access::wo},
                                                 {"rw", Access::rw},
                                                 {"rwr", Access::rwr},
                                                 {"rww", Access::rww},
                                                 {"const", Access::constant}})) {
      entry.access = *word;
      entry.access_open = false;
    }
    const Field code = fields.optional("kind");
    if (const auto word = code.one_of<ObjectCode>({{"VAR", ObjectCode::var},
                                                   {"ARRAY", ObjectCode::array},
                                                   {"RECORD", ObjectCode::record},
                                                   {"DOMAIN", ObjectCode::domain}})) {
      entry.object = *word;
    } else if (!standard && range && range->last_sub > 0) {
      entry.object = ObjectCode::record;
    }
    const bool type_known = type || standard;
    const Field low = fields.optional("low");
    const Field high = fields.optional("high");
    const Field default_value = fields.optional("default");
    if (type_known) {
      if (low.present()) entry.low = read_value(low, entry.type);
      if (high.present()) entry.high = read_value(high, entry.type);
      read_default(default_value, entry);
    }
    if (const auto value = fields.optional("mappable").boolean()) entry.pdo_mappable = *value;
    if (const auto value = fields.optional("may_change").boolean()) entry.may_change = *value;
    if (const auto value = fields.optional("command").boolean()) entry.command = *value;
    fields.finish();
    if (!range || (!standard && !type)) return;
    entry.mux = range->first;
    check_limits(item, entry);
    for (unsigned sub = range->first.sub.value(); sub <= range->last_sub; ++sub) {
      entry.mux.sub = SubIndex{static_cast<std::uint8_t>(sub)};
      add_object(object, entry);
    }
  }

  void add_object(const Field& item, Entry entry) {
    entry.claimed = true;
    if (listed(entry.mux) != nullptr) {
      item.error(fmt::format("{} is listed twice", to_string(entry.mux)));
      return;
    }
    profile_.objects.push_back(std::move(entry));
  }

  [[nodiscard]] const Entry* listed(Multiplexer mux) const {
    const auto found = std::ranges::find(profile_.objects, mux, &Entry::mux);
    return found == profile_.objects.end() ? nullptr : &*found;
  }

  void read_errors() {
    const Field errors = fields_.optional("errors");
    if (!errors.present()) profile_.errors = default_profile(profile_.node).errors;
    for (const Field& item : errors.items()) {
      Fields fields = item.fields("error trigger");
      ErrorTrigger trigger;
      trigger.name = fields.required("name").text().value_or("");
      const bool by_heartbeat = fields.has("heartbeat");
      const Field code = by_heartbeat ? fields.optional("code") : fields.required("code");
      trigger.code =
          static_cast<std::uint16_t>(code.number(0x0001, 0xFFFF).value_or(by_heartbeat ? 0x8130 : 0));
      const Field source = fields.exactly_one_of({"raise", "heartbeat"});
      trigger.raise = by_heartbeat ? std::nullopt : read_write(source, "raise");
      trigger.clear = read_write(fields.optional("clear"), "clear");
      if (by_heartbeat) {
        Fields heartbeat = fields.optional("heartbeat").fields("heartbeat");
        const auto producer = heartbeat.required("node").number(1, 127);
        if (producer) trigger.heartbeat_node = NodeId{static_cast<std::uint8_t>(*producer)};
        heartbeat.finish();
        if (producer && *producer == profile_.node.value()) {
          item.error("the heartbeat of an error trigger cannot be that of the device itself",
                     "name an unused node-ID such as 7Eh");
        }
      }
      const bool twice =
          std::ranges::find(profile_.errors, trigger.name, &ErrorTrigger::name) != profile_.errors.end();
      if (twice) item.error(fmt::format("the error trigger '{}' is listed twice", trigger.name));
      profile_.errors.push_back(std::move(trigger));
    }
  }

  void read_store_fault() {
    const Field given = fields_.optional("store_fault");
    if (!given.present()) return;
    Fields fields = given.fields("store fault");
    auto arm = read_write(fields.required("arm"), "arm");
    auto disarm = read_write(fields.required("disarm"), "disarm");
    fields.finish();
    if (arm && disarm) profile_.store_fault = StoreFault{*std::move(arm), *std::move(disarm)};
  }

  /// A change that reaches an input is an event of the TPDO that carries it, unless the profile denies it.
  void read_wires() {
    constexpr std::string_view on_change = "tpdo on change";
    for (const Field& item : fields_.optional("wired").items()) {
      Fields fields = item.fields("wire");
      const auto output = fields.required("output").multiplexer();
      const auto input = fields.required("input").multiplexer();
      fields.finish();
      if (!output || !input) continue;
      const auto known = [&](Multiplexer mux) {
        const Entry* own = listed(mux);
        return own != nullptr ? own->size() : std::optional<std::size_t>();
      };
      if (*output == *input) {
        item.error(fmt::format("{} is wired to itself", to_string(*output)));
      } else if (known(*output) && known(*input) && known(*output) != known(*input)) {
        item.error(fmt::format("{} and {} have different lengths", to_string(*output), to_string(*input)),
                   "an input shows byte for byte what is written to its output");
      } else if (std::ranges::find(profile_.wired, *output, &Wire::output) != profile_.wired.end()) {
        item.error(fmt::format("{} is wired twice", to_string(*output)));
      } else {
        profile_.wired.push_back({*output, *input});
      }
    }
    if (!profile_.wired.empty() && !profile_.not_claimed.contains(on_change))
      profile_.claims.insert(std::string(on_change));
  }

  void read_clock() {
    const Field given = fields_.optional("clock");
    if (!given.present()) return;
    const auto clock = given.multiplexer();
    if (!clock) return;
    const Entry* own = listed(*clock);
    if (own != nullptr && own->size() && own->size() != canopen::size_bytes(canopen::DataType::time_of_day)) {
      given.error(fmt::format("{} has not the six bytes of a TIME_OF_DAY", to_string(*clock)),
                  "name the entry that shows the time that TIME sets");
      return;
    }
    profile_.clock = clock;
    profile_.claims.insert("clock");
  }

  /// What is not listed is forbidden.
  void read_placeholders() {
    constexpr std::uint16_t last = 0x0007;  // what a device can do without is listed up to UNSIGNED32
    const Field given = fields_.optional("placeholders");
    if (!given.present()) return;
    for (std::uint16_t type = 1; type <= last; ++type) profile_.placeholders[Index(type)] = false;
    for (const Field& item : given.items()) {
      if (const auto type = item.number(0x0001, 0x001B))
        profile_.placeholders[Index(static_cast<std::uint16_t>(*type))] = true;
    }
  }

  std::optional<TriggerWrite> read_write(const Field& field, const char* what) {
    if (!field.present()) return std::nullopt;
    Fields fields = field.fields(what);
    const Field object = fields.required("object");
    const auto mux = object.multiplexer();
    const Field value = fields.required("value");
    fields.finish();
    if (!mux || !value.present()) return std::nullopt;
    const Entry* own = listed(*mux);
    const auto standard = standard_entry(*mux);
    if (own == nullptr && !standard) {
      if (!profile_.eds.empty()) {
        // The description is not read yet: complete_writes() does the rest.
        const auto at = object.node()->position();
        return TriggerWrite{*mux, value.node()->text(), {}, fmt::format("{}:{}", at.line, at.column)};
      }
      object.error(fmt::format("the type of {} is not known", to_string(*mux)),
                   "list the object under 'objects', or name the device description under 'eds'");
      return std::nullopt;
    }
    auto bytes = read_value(value, own != nullptr ? own->type : standard->type);
    if (!bytes) return std::nullopt;
    return TriggerWrite{*mux, value.node()->text(), *std::move(bytes), {}};
  }

  std::vector<Multiplexer> read_entries(const char* key) {
    std::vector<Multiplexer> out;
    for (const Field& item : fields_.optional(key).items()) {
      const auto range = read_range(item);
      if (!range) continue;
      for (unsigned sub = range->first.sub.value(); sub <= range->last_sub; ++sub) {
        out.push_back({range->first.index, SubIndex{static_cast<std::uint8_t>(sub)}});
      }
    }
    return out;
  }

  void read_identity() {
    Fields fields = fields_.optional("identity").fields("identity");
    const auto number = [&](const char* key) -> std::optional<std::uint32_t> {
      const auto value = fields.optional(key).number(0, 0xFFFF'FFFF);
      if (!value) return std::nullopt;
      return static_cast<std::uint32_t>(*value);
    };
    profile_.identity = {.vendor = number("vendor"),
                         .product = number("product"),
                         .revision = number("revision"),
                         .serial = number("serial")};
    fields.finish();
  }

  void read_device_info() {
    constexpr std::uint64_t most_pdos = 512;
    Fields fields = fields_.optional("device_info").fields("device info");
    auto& info = profile_.device_info;
    info.rpdos = fields.optional("rpdos").number(0, most_pdos);
    info.tpdos = fields.optional("tpdos").number(0, most_pdos);
    info.lss = fields.optional("lss").boolean();
    for (const Field& item : fields.optional("bit_rates").items()) {
      const auto rate = item.number(1, 1000);
      if (!rate) continue;
      if (!canopen::lss_bit_rate_index(static_cast<std::uint32_t>(*rate))) {
        item.error(fmt::format("{} kbit/s is no bit rate of CiA 301", *rate),
                   "1000, 800, 500, 250, 125, 50, 20 or 10");
      } else {
        info.bit_rates.push_back(static_cast<std::uint32_t>(*rate));
      }
    }
    std::ranges::sort(info.bit_rates);
    fields.finish();
  }

  Fields fields_;
  Profile profile_;
};

}  // namespace

Profile load_profile(const yaml::Node& root, yaml::Diagnostics& diagnostics) {
  return Reader(root, diagnostics).read();
}

}  // namespace conform::device
