// SPDX-License-Identifier: Apache-2.0
// Verbs about PDOs: configure one by the procedure of the standard, look at its mapping, read what it would
// carry, send SYNC.
#include <array>
#include <vector>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/pdo.hpp"
#include "steps/pdo_objects.hpp"
#include "steps/sdo_access.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

constexpr std::uint64_t most_entries = 0x40;

/// An entry of a mapping: index in bits 31-16, sub-index in bits 15-8, length in bits in bits 7-0.
struct MappedEntry {
  std::optional<ObjectReference> object;
  Expression value;                ///< the whole entry, when no object is named
  std::optional<Expression> bits;  ///< another length than the object's own

  static std::optional<MappedEntry> parse(const yaml::Field& field, const NameCheck& names) {
    MappedEntry out;
    if (field.node()->is_mapping()) {
      auto fields = field.fields("mapping entry");
      const auto object = fields.required("object");
      if (!object) return std::nullopt;
      out.object = parse_object_at(object, names);
      if (const auto bits = fields.optional("bits")) out.bits = parse_expression_at(bits, names);
      return out.object ? std::optional(out) : std::nullopt;
    }
    const auto text = field.text();
    if (!text) return std::nullopt;
    if (text->starts_with('$') || text->find(':') != std::string::npos) {
      out.object = parse_object_at(field, names);
      return out.object ? std::optional(out) : std::nullopt;
    }
    auto value = parse_expression_at(field, names);
    if (!value) return std::nullopt;
    out.value = *value;
    return out;
  }

  [[nodiscard]] Result<std::uint64_t> resolve(Session& session) const {
    if (!object) return value.number(session);
    // "$entry" may also stand for the whole 32-bit value.
    if (const auto text = object->text();
        !bits && text.starts_with('$') && text.find(':') == std::string::npos) {
      const auto* held = session.find(std::string_view(text).substr(1));
      if (held != nullptr && !held->object && held->number) return *held->number;
    }
    const auto mux = object->resolve(session);
    if (!mux) return std::unexpected(mux.error());
    std::uint64_t length = 0;
    if (bits) {
      const auto number = bits->number(session);
      if (!number) return number;
      length = *number & 0xFF;
    } else {
      const auto* entry = session.dictionary().find(*mux);
      if (entry == nullptr || !entry->size())
        return fail_scenario("the length of " + to_string(*mux) + " is not known", "add bits:");
      length = *entry->size() * 8;
    }
    return canopen::mapping_entry(*mux, length);
  }
};

/// Destroy the PDO, write mapping and parameters, create it again (7.5.2.36, 7.5.2.38). The first refusal
/// ends it, but for what cannot be written and need not be: a COB-ID that is const and stays (what may be
/// changed of a valid PDO is for the device to say), and a mapping that is const and the one that is wanted.
class SetPdo final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<SetPdo>();
    auto fields = value.fields("set_pdo");
    const auto pdo = fields.required("pdo");
    if (pdo) {
      if (auto parsed = parse_object_at(pdo, context.names)) out->pdo_ = *parsed;
    }
    if (const auto mapping = fields.optional("mapping")) {
      out->maps_ = true;
      for (const auto& item : mapping.items()) {
        if (auto entry = MappedEntry::parse(item, context.names)) out->entries_.push_back(*entry);
      }
    }
    if (const auto least = fields.optional("at_least")) out->least_bits_ = least.number(1, 512).value_or(0);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const auto field = fields.optional(parameters[i].name);
      if (!field) continue;
      if (auto expression = parse_expression_at(field, context.names)) out->values_[i] = *expression;
    }
    if (const auto can_id = fields.optional("can_id")) {
      if (auto expression = parse_expression_at(can_id, context.names)) out->can_id_ = *expression;
    }
    if (const auto valid = fields.optional("valid")) out->valid_ = valid.boolean().value_or(true);
    return pdo ? std::move(out) : nullptr;
  }

  std::vector<ObjectReference> concerns() const override { return {pdo_}; }
  Channels rests_on() const override { return {channel::pdo_parameters}; }
  bool rests_on_time() const override { return false; }
  std::string words(Session& session) const override {
    std::string out = "configure " + pdo_words(pdo_, session);
    if (maps_) out += ", " + std::to_string(entries_.size()) + " mapped";
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (values_[i].empty()) continue;
      const auto value = values_[i].evaluate(session);
      out += ", " + std::string(parameters[i].words) + " " + (value ? value->text() : values_[i].text());
    }
    return out + (valid_ ? " (off, change, on)" : " (off, change)");
  }

  Result<Actual> run(Session& session) const override {
    const auto index = communication_of(pdo_, session);
    if (!index) return std::unexpected(index.error());
    const Multiplexer cob_id{*index, SubIndex(1)};
    auto actual = read(session, cob_id);
    if (!is_confirmed(actual)) return actual;
    const auto before = static_cast<std::uint32_t>(load_le(actual->data));
    const bool was_valid = (before & canopen::cob_id::bit31) == 0;
    bool switched = false;
    if (was_valid) {
      actual = write(session, cob_id, before | canopen::cob_id::bit31, 4);
      switched = is_confirmed(actual);
      const bool stays = valid_ && can_id_.empty() && actual && is_read_only(*actual);
      if (!switched && !stays) return actual;
    }
    if (maps_) {
      actual = write_mapping(session, canopen::pdo_mapping(*index));
      if (!is_confirmed(actual)) return actual;
    }
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (values_[i].empty()) continue;
      const auto wanted = values_[i].number(session);
      if (!wanted) return std::unexpected(wanted.error());
      actual = write_parameter(session, {*index, SubIndex(parameters[i].sub)}, *wanted, parameters[i].size);
      if (!is_confirmed(actual)) return actual;
    }
    if (!valid_) return actual;
    if (was_valid && !switched) return confirmed();
    auto target = before & ~canopen::cob_id::bit31;
    if (!can_id_.empty()) {
      const auto id = can_id_.number(session);
      if (!id) return std::unexpected(id.error());
      target = (before & canopen::cob_id::bit30) | static_cast<std::uint32_t>(*id);
      actual = write(session, cob_id, target | canopen::cob_id::bit31, 4);
      if (!is_confirmed(actual)) return actual;
    }
    actual = write(session, cob_id, target, 4);
    if (actual) actual->data.clear();
    return actual;
  }

 private:
  struct Parameter {
    std::string_view name, words;
    std::uint8_t sub;
    std::size_t size;
  };
  static constexpr std::array<Parameter, 4> parameters = {{{"type", "type", 2, 1},
                                                           {"inhibit_time", "inhibit time", 3, 2},
                                                           {"event_timer", "event timer", 5, 2},
                                                           {"sync_start", "SYNC start value", 6, 1}}};

  static bool is_read_only(const Actual& actual) {
    return actual.kind == Actual::Kind::aborted && actual.code == canopen::abort::read_only;
  }
  static Actual confirmed() {
    Actual out;
    out.kind = Actual::Kind::confirmed;
    out.detail = "confirmed";
    return out;
  }

  /// What already holds the value stays untouched; a parameter that is absent does what its value 0 says.
  static Result<Actual> write_parameter(Session& session, Multiplexer object, std::uint64_t wanted,
                                        std::size_t size) {
    auto actual = read(session, object);
    if (!actual) return actual;
    const bool same = actual->kind == Actual::Kind::confirmed && load_le(actual->data) == wanted;
    if (same || (wanted == 0 && object.sub != SubIndex(2) && is_absent(*actual))) {
      actual->kind = Actual::Kind::confirmed;
      actual->detail = "confirmed";
      return actual;
    }
    return write(session, object, wanted, size);
  }

  /// The values of the entries, as often as they are asked for.
  Result<std::vector<std::uint64_t>> wanted_mapping(Session& session) const {
    std::vector<std::uint64_t> out;
    std::uint64_t bits = 0;
    while (!entries_.empty() && out.size() < most_entries &&
           (out.size() < entries_.size() || bits < least_bits_)) {
      const auto entry = entries_[out.size() % entries_.size()].resolve(session);
      if (!entry) return std::unexpected(entry.error());
      out.push_back(*entry);
      bits += *entry & 0xFF;
    }
    return out;
  }

  /// True: the mapping is that already.
  static Result<bool> holds_mapping(Session& session, Index mapping,
                                    const std::vector<std::uint64_t>& wanted) {
    for (std::size_t sub = 0; sub <= wanted.size(); ++sub) {
      const auto held = read(session, {mapping, SubIndex(static_cast<std::uint8_t>(sub))});
      if (!held) return std::unexpected(held.error());
      if (!is_confirmed(held) || load_le(held->data) != (sub == 0 ? wanted.size() : wanted[sub - 1]))
        return false;
    }
    return true;
  }

  Result<Actual> write_mapping(Session& session, Index mapping) const {
    const auto wanted = wanted_mapping(session);
    if (!wanted) return std::unexpected(wanted.error());
    for (const auto entry : *wanted) {
      if (auto noted = will_receive(session, mapping, entry); !noted) return std::unexpected(noted.error());
    }
    auto actual = write(session, {mapping, SubIndex(0)}, 0, 1);
    if (actual && is_read_only(*actual)) {
      const auto same = holds_mapping(session, mapping, *wanted);
      if (!same) return std::unexpected(same.error());
      return *same ? Result<Actual>(confirmed()) : actual;
    }
    if (!is_confirmed(actual)) return actual;
    for (std::size_t i = 0; i < wanted->size(); ++i) {
      actual = write(session, {mapping, SubIndex(static_cast<std::uint8_t>(i + 1))}, (*wanted)[i], 4);
      if (!is_confirmed(actual)) return actual;
    }
    return wanted->empty() ? actual : write(session, {mapping, SubIndex(0)}, wanted->size(), 1);
  }

  ObjectReference pdo_;
  bool maps_ = false, valid_ = true;
  std::vector<MappedEntry> entries_;
  std::uint64_t least_bits_ = 0;
  std::array<Expression, parameters.size()> values_;
  Expression can_id_;
};

struct Mapping {
  std::uint64_t bits = 0, absent = 0, longer = 0, shorter = 0;
  std::vector<std::uint32_t> entries;
  std::vector<std::uint8_t>
      data;  ///< what the objects hold, packed without gaps, least significant bit first
};

/// Reads the mapping and the objects in it. Not confirmed: the answer that stood in the way.
Result<Actual> read_mapping(Session& session, Index mapping, Mapping& out, bool needs_data) {
  auto actual = read(session, {mapping, SubIndex(0)});
  if (!is_confirmed(actual)) return actual;
  const auto count = load_le(actual->data);
  for (std::uint64_t sub = 1; sub <= count && count <= most_entries; ++sub) {
    actual = read(session, {mapping, SubIndex(static_cast<std::uint8_t>(sub))});
    if (!is_confirmed(actual)) return actual;
    const auto entry = static_cast<std::uint32_t>(load_le(actual->data));
    const auto object = canopen::mapped_object(entry);
    const std::uint64_t length = entry & 0xFFU;
    out.entries.push_back(entry);
    const bool placeholder =
        mapping.value() < 0x1800 && object.index.value() > 0 && object.index.value() < 0x0020;
    std::optional<std::uint64_t> own;
    Bytes held;
    if (!placeholder) {
      auto value = read(session, object);
      if (!value) return value;
      if (value->kind == Actual::Kind::confirmed) {
        held = value->data;
        const auto* described = session.dictionary().find(object);
        const bool length_told =
            value->measured["size_open"] == 0 || (described != nullptr && described->size());
        if (length_told) own = held.size() * 8;
      } else if (is_absent(*value)) {
        ++out.absent;
      }
      if (needs_data && value->kind != Actual::Kind::confirmed) return value;
    }
    if (own && length > *own) ++out.longer;
    // A BOOLEAN is a byte for SDO and a bit in a PDO, and so may be what no description tells the type of.
    const auto* known = session.dictionary().find(object);
    const bool in_bits = known == nullptr || known->type == canopen::DataType::boolean;
    if (own && (in_bits ? length + 7 < *own : length < *own)) ++out.shorter;
    for (std::uint64_t bit = 0; bit < length; ++bit, ++out.bits) {
      if (out.bits % 8 == 0) out.data.push_back(0);
      const auto byte = static_cast<std::size_t>(bit / 8);
      const bool set = byte < held.size() && ((held[byte] >> (bit % 8)) & 1U) != 0;
      if (set) out.data.back() = static_cast<std::uint8_t>(out.data.back() | (1U << (out.bits % 8)));
    }
  }
  return actual;
}

/// Looks at what a PDO maps, reads it, or finds a place in it.
class PdoMapping final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    return parse_as(value, context, What::objects, "mapping");
  }
  static std::unique_ptr<Action> parse_data(const yaml::Field& value, ParseContext& context) {
    return parse_as(value, context, What::data, "mapped_data");
  }
  static std::unique_ptr<Action> parse_entry(const yaml::Field& value, ParseContext& context) {
    return parse_as(value, context, What::entry, "mapped_entry");
  }
  Measures measures() const override {
    return what_ == What::entry ? Measures{} : Measures{"count", "bits", "absent", "longer", "shorter"};
  }
  Need need() const override { return {}; }
  std::vector<ObjectReference> concerns() const override { return {pdo_}; }
  bool rests_on_time() const override { return false; }
  std::string words(Session& session) const override {
    const auto pdo = pdo_words(pdo_, session);
    if (what_ == What::entry) return "look for an entry of " + pdo + " that tests may write";
    return (what_ == What::data ? "read the objects mapped to " : "resolve the mapping of ") + pdo;
  }
  Result<Actual> run(Session& session) const override {
    const auto index = communication_of(pdo_, session);
    if (!index) return std::unexpected(index.error());
    Mapping mapping;
    auto actual = read_mapping(session, canopen::pdo_mapping(*index), mapping, what_ == What::data);
    if (!is_confirmed(actual)) return actual;
    actual->data.clear();
    if (what_ == What::entry) {
      find_entry(session, mapping, *actual);
      return actual;
    }
    actual->kind = Actual::Kind::matched;
    if (what_ == What::data) {
      actual->data = mapping.data;
      actual->detail = hex_bytes(mapping.data);
      session.set(save_, Value::of_bytes(mapping.data));
      return actual;
    }
    if (!save_.empty()) session.set(save_, Value::of_number((mapping.bits + 7) / 8));
    measure(mapping, *actual);
    return actual;
  }

 private:
  enum class What : std::uint8_t { objects, data, entry };

  static std::unique_ptr<Action> parse_as(const yaml::Field& value, ParseContext& context, What what,
                                          const char* verb) {
    auto out = std::make_unique<PdoMapping>();
    out->what_ = what;
    auto fields = value.fields(verb);
    const auto pdo = fields.required("pdo");
    if (pdo) {
      if (auto parsed = parse_object_at(pdo, context.names)) out->pdo_ = *parsed;
    }
    if (const auto save = what == What::objects ? fields.optional("save") : fields.required("save")) {
      out->save_ = save.text().value_or("");
      context.know(out->save_);
    }
    return pdo ? std::move(out) : nullptr;
  }

  static void measure(const Mapping& mapping, Actual& actual) {
    actual.measured["count"] = mapping.entries.size();
    actual.measured["bits"] = mapping.bits;
    actual.measured["absent"] = mapping.absent;
    actual.measured["longer"] = mapping.longer;
    actual.measured["shorter"] = mapping.shorter;
    std::vector<std::string> parts;
    for (const auto entry : mapping.entries) parts.push_back(hex(entry, 8).insert(4, " "));
    actual.detail = std::to_string(mapping.entries.size()) + " entries, " + std::to_string(mapping.bits) +
                    " bits; " + std::to_string(mapping.absent) + " absent, " +
                    std::to_string(mapping.longer) + " longer and " + std::to_string(mapping.shorter) +
                    " shorter than the object: " + join(parts, ", ");
  }

  /// The first integer that tests may write and read, whole.
  void find_entry(Session& session, const Mapping& mapping, Actual& actual) const {
    for (const auto mapped : mapping.entries) {
      const auto object = canopen::mapped_object(mapped);
      const auto* entry = session.dictionary().find(object);
      if (entry == nullptr || !entry->safe || !entry->readable() || !canopen::is_integer(entry->type) ||
          entry->size() != (mapped & 0xFFU) / 8)
        continue;
      session.set(save_, Value::of_object(object));
      actual.detail = to_string(object);
      return;
    }
    actual.kind = Actual::Kind::silence;
    actual.detail = "it maps nothing that tests may write and read";
  }

  ObjectReference pdo_;
  What what_ = What::objects;
  std::string save_;
};

class SendSync final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<SendSync>();
    if (!value.node()->is_mapping()) return value.one_of({"once"}) ? std::move(out) : nullptr;
    auto fields = value.fields("send_sync");
    out->count_ = fields.required("count").number(1, 100'000);
    const auto every = fields.required("every");
    if (every) {
      if (auto time = parse_time_at(every)) out->every_ = *time;
    }
    if (const auto counter = fields.optional("counter")) {
      if (auto overflow = parse_expression_at(counter, context.names)) out->overflow_ = *overflow;
    }
    return every ? std::move(out) : nullptr;
  }
  Need need() const override { return {Tier::motion, "send SYNC"}; }
  std::string words(Session&) const override {
    return count_ ? "send " + std::to_string(*count_) + " SYNC, one every " + every_.text() : "send SYNC";
  }
  Result<Actual> run(Session& session) const override {
    // The CAN-ID the device listens on; a device without 1005h gets the pre-defined one.
    CobId cob_id(canopen::sync_can_id.value());
    auto known = session.read({Index(0x1005), SubIndex(0)});
    if (known && known->number) cob_id = CobId(static_cast<std::uint32_t>(*known->number));
    const auto id = canopen::can_id_of(cob_id);
    // Other services have these; on 000h it would even be an NMT command.
    if (!canopen::is_extended(cob_id) && canopen::is_restricted(id))
      return fail_scenario("1005h:00 is " + known->text() +
                           ", and no SYNC can be sent on the restricted CAN-ID " + to_string(id));
    std::optional<std::uint8_t> overflow;
    if (!overflow_.empty()) {
      const auto number = overflow_.number(session);
      if (!number) return std::unexpected(number.error());
      // A value that can be read from 1019h: without a counter a SYNC has no data.
      if (*number > 0xFF) return fail_scenario("a SYNC counts in one byte");
      if (*number > 1) overflow = static_cast<std::uint8_t>(*number);
    } else if (const auto counts = session.read({Index(0x1019), SubIndex(0)}); counts && counts->number) {
      // A SYNC of another length may be an error to the device.
      if (*counts->number > 1 && *counts->number <= 240)
        overflow = static_cast<std::uint8_t>(*counts->number);
    }
    auto frame = can::data_frame(id, overflow ? Bytes{1} : Bytes());
    frame.extended = canopen::is_extended(cob_id);
    session.set("sync_can_id", Value::of_number(id.value()));
    if (count_) {
      if (auto reached = session.await_state(); !reached) return std::unexpected(reached.error());
      session.consume(session.capture().size());
      auto begun = session.produce({"sync", frame, every_.resolve(session.profile()), count_, overflow});
      if (!begun) return std::unexpected(begun.error());
      return Actual{};
    }
    const auto begin = session.capture().size();
    auto sent = session.send(frame);
    if (!sent) return std::unexpected(sent.error());
    Actual out;
    out.decisive = sent_frame(session, begin);
    return out;
  }

 private:
  TimeReference every_;
  std::optional<std::uint64_t> count_;
  Expression overflow_;  ///< empty: as 1019h says
};

constexpr Verb table[] = {
    {"set_pdo",
     "Configure a PDO by the procedure of the standard: switch off, mapping, parameters, switch on. The first refusal ends it.",
     "pdo: its communication or mapping object\nmapping: list of entries: an object, {object, bits}, or the 32-bit value\n"
     "at_least: repeat the entries until they make up this many bits\ntype, inhibit_time, event_timer, sync_start: sub-indices 02h, 03h, "
     "05h, 06h\ncan_id: another CAN-ID\nvalid: false to leave it switched off",
     "- set_pdo: {pdo: 1800h, type: 1, event_timer: 0}\n- set_pdo: {pdo: $pdo, mapping: [$word, $word], valid: false}\n  checks: OD-1A00-05",
     &SetPdo::parse},
    {"mapping", "Read the mapping of a PDO and look for the objects it names.",
     "pdo: its communication or mapping object\nsave: name that the length gets, in bytes\nmeasured: count, bits, absent, longer, shorter (entries against their objects)",
     "- mapping: {pdo: 1600h}\n  checks: OD-1600-03\n  expect: {bits: ..64}", &PdoMapping::parse},
    {"mapped_data", "Read what the objects mapped to a PDO hold, packed as the PDO carries them.",
     "pdo: its communication or mapping object\nsave: name that the data get",
     "- mapped_data: {pdo: $pdo, save: held}", &PdoMapping::parse_data},
    {"mapped_entry", "Find an integer that a PDO maps, and that tests may write and read.",
     "pdo: its communication or mapping object\nsave: name that the entry gets",
     "- mapped_entry: {pdo: $pdo, save: entry}\n  either: [{if: ok}, {if: [abort any, silence], verdict: not applicable}]",
     &PdoMapping::parse_entry},
    {"send_sync", "Send SYNC on the CAN-ID of 1005h, once or beside the following steps.",
     "(word): once\nevery: time between two\ncount: how many\ncounter: overflow value: each has one byte that counts 1 to this and 1 again; 0: "
     "no data. Without it as 1019h says",
     "- send_sync: once\n- send_sync: {every: 50 ms, count: 10}\n- send_sync: {every: 50 ms, count: 10, counter: 4}",
     &SendSync::parse},
};

}  // namespace

std::span<const Verb> pdo_verbs() { return table; }

}  // namespace conform::steps
