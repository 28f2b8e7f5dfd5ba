// SPDX-License-Identifier: Apache-2.0
// Verbs of the SDO client: upload, download, and the change of a COB-ID by the procedure the standard
// prescribes.
#include <algorithm>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

Actual to_actual(const SdoAnswer& answer, const Session& session, Multiplexer object, bool upload) {
  Actual out;
  out.decisive = answer.decisive;
  if (const auto* entry = session.dictionary().find(object)) out.type = entry->type;
  switch (answer.kind) {
    case SdoAnswer::Kind::confirmed:
      out.kind = Actual::Kind::confirmed;
      out.has_data = upload;
      out.data = answer.data;
      out.size_indicated = answer.size_indicated;
      break;
    case SdoAnswer::Kind::aborted:
      out.kind = Actual::Kind::aborted;
      out.code = answer.code;
      break;
    case SdoAnswer::Kind::silence:
      out.kind = Actual::Kind::silence;
      out.detail = answer.detail;
      break;
    case SdoAnswer::Kind::violation:
      out.kind = Actual::Kind::violation;
      out.detail = answer.detail;
      out.data = answer.data;
      break;
  }
  return out;
}

class Upload final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<Upload>();
    if (!value.node()->is_mapping()) {
      auto object = parse_object_at(value, context.names);
      if (!object) return nullptr;
      out->object_ = *object;
      return out;
    }
    auto fields = value.fields("upload");
    const auto object = fields.required("object");
    if (object) {
      if (auto parsed = parse_object_at(object, context.names)) out->object_ = *parsed;
    }
    if (const auto timeout = fields.optional("timeout")) out->timeout_ = parse_time_at(timeout);
    if (const auto save = fields.optional("save")) {
      out->save_ = save.text().value_or("");
      context.know(out->save_);
    }
    return object ? std::move(out) : nullptr;
  }

  std::string words(Session& session) const override {
    const auto object = object_.resolve(session);
    return "upload " + (object ? to_string(*object) : object_.text());
  }
  bool reads_only() const override { return true; }
  const ObjectReference* object() const override { return &object_; }

  Result<Actual> run(Session& session) const override {
    const auto object = object_.resolve(session);
    if (!object) return std::unexpected(object.error());
    const auto timeout = timeout_ ? std::optional(timeout_->resolve(session.profile())) : std::nullopt;
    auto answer = session.upload(*object, timeout);
    if (!answer) return std::unexpected(answer.error());
    auto out = to_actual(*answer, session, *object, true);
    out.unchanged_from = session.before_last_write(*object);
    if (answer->kind == SdoAnswer::Kind::confirmed) {
      const auto latency = session.capture().frames()[answer->decisive].time - session.window().anchor;
      out.measured["latency"] = static_cast<std::uint64_t>(std::max<Duration::rep>(0, latency.count()));
    }
    if (!save_.empty() && out.kind == Actual::Kind::confirmed) session.set(save_, Value::of_bytes(out.data));
    return out;
  }

 private:
  ObjectReference object_;
  std::optional<TimeReference> timeout_;
  std::string save_;
};

class Download final : public Action {
 public:
  using Mode = canopen::SdoDownload::Mode;

  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<Download>();
    auto fields = value.fields("download");
    const auto object = fields.required("object");
    if (object) {
      if (auto parsed = parse_object_at(object, context.names)) out->object_ = *parsed;
    }
    const auto content = fields.exactly_one_of({"value", "bytes", "text"});
    if (content && fields.has("value")) {
      if (auto expression = parse_expression_at(content, context.names)) out->value_ = *expression;
    } else if (content && fields.has("bytes")) {
      if (auto bytes = content.bytes()) out->bytes_ = *bytes;
    } else if (content) {
      if (auto text = content.text()) out->bytes_ = Bytes(text->begin(), text->end());
    }
    if (const auto as = fields.optional("as")) {
      if (const auto name = as.text()) {
        out->as_ = canopen::parse_data_type(*name);
        if (!out->as_)
          as.error("unknown data type '" + *name + "'", "UNSIGNED8, INTEGER32, VISIBLE_STRING, ...");
      }
    }
    if (const auto transfer = fields.optional("transfer")) {
      out->mode_ = transfer
                       .one_of<Mode>({{"automatic", Mode::automatic},
                                      {"expedited", Mode::expedited},
                                      {"expedited without size", Mode::expedited_unsized},
                                      {"segmented", Mode::segmented},
                                      {"segmented without size", Mode::segmented_unsized}})
                       .value_or(Mode::automatic);
    }
    if (const auto timeout = fields.optional("timeout")) out->timeout_ = parse_time_at(timeout);
    return object && content ? std::move(out) : nullptr;
  }

  std::string words(Session& session) const override {
    const auto object = object_.resolve(session);
    std::string out = "download " + (object ? to_string(*object) : object_.text()) + " = ";
    if (bytes_) return out + (bytes_->empty() ? "(no bytes)" : hex_bytes(*bytes_));
    if (!object) return out + value_.text();
    const auto data = encode(session, *object);
    if (!data) return out + value_.text();
    if (const auto type = type_of(session, *object)) return out + canopen::print(*type, *data);
    return out + hex_bytes(*data);
  }
  const ObjectReference* object() const override { return &object_; }

  Result<Actual> run(Session& session) const override {
    const auto object = object_.resolve(session);
    if (!object) return std::unexpected(object.error());
    auto data = encode(session, *object);
    if (!data) return std::unexpected(data.error());
    const auto timeout = timeout_ ? std::optional(timeout_->resolve(session.profile())) : std::nullopt;
    auto answer = session.download(*object, std::move(*data), mode_, timeout);
    if (!answer) return std::unexpected(answer.error());
    auto out = to_actual(*answer, session, *object, false);
    if (out.kind == Actual::Kind::confirmed) out.detail = "confirmed";
    return out;
  }

 private:
  std::optional<canopen::DataType> type_of(const Session& session, Multiplexer object) const {
    if (as_) return as_;
    const auto* entry = session.dictionary().find(object);
    return entry != nullptr ? std::optional(entry->type) : std::nullopt;
  }

  Result<Bytes> encode(Session& session, Multiplexer object) const {
    if (bytes_) return *bytes_;
    auto value = value_.evaluate(session);
    if (!value) return std::unexpected(value.error());
    if (value->bytes && !as_) return *value->bytes;
    if (value->word) return Bytes(value->word->begin(), value->word->end());
    if (!value->number) return fail("'" + value_.text() + "' is not a number");
    const auto type = type_of(session, object);
    if (!type) {
      return fail("the type of " + to_string(object) + " is not known", "scenario",
                  "add as: UNSIGNED16, or write bytes:");
    }
    const auto size = canopen::size_bytes(*type);
    if (!size) return fail(to_string(object) + " has no fixed length", "scenario", "write bytes: or text:");
    // Values outside the type are the author's slip; '~' makes the only legal exception (sign extension).
    const auto mask = *size >= 8 ? ~std::uint64_t{0} : (std::uint64_t{1} << (8 * *size)) - 1;
    const auto above = *value->number & ~mask;
    if (above != 0 && above != ~mask) {
      return fail(value->text() + " does not fit " + std::string(canopen::to_string(*type)), "scenario");
    }
    return to_le(*value->number, *size);
  }

  ObjectReference object_;
  Expression value_;
  std::optional<Bytes> bytes_;
  std::optional<canopen::DataType> as_;
  Mode mode_ = Mode::automatic;
  std::optional<TimeReference> timeout_;
};

/// CiA 301 locks bits 0-29 while the service is active, so a change takes three writes: off, change, on.
class SetCobId final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<SetCobId>();
    auto fields = value.fields("set_cob_id");
    const auto object = fields.required("object");
    const auto to = fields.required("to");
    if (object) {
      if (auto parsed = parse_object_at(object, context.names)) out->object_ = *parsed;
    }
    if (to) {
      if (auto parsed = parse_expression_at(to, context.names)) out->to_ = *parsed;
    }
    return object && to ? std::move(out) : nullptr;
  }

  std::string words(Session& session) const override {
    const auto object = object_.resolve(session);
    const auto to = to_.evaluate(session);
    return "set COB-ID " + (object ? to_string(*object) : object_.text()) + " to " +
           (to ? to->text() : to_.text()) + " (off, change, on)";
  }
  const ObjectReference* object() const override { return &object_; }

  Result<Actual> run(Session& session) const override {
    const auto object = object_.resolve(session);
    if (!object) return std::unexpected(object.error());
    const auto to = to_.number(session);
    if (!to) return std::unexpected(to.error());
    const auto kind = canopen::cob_id_kind(*object);
    if (!kind) return fail(to_string(*object) + " is no COB-ID", "scenario");
    auto before = session.upload(*object, std::nullopt);
    if (!before) return std::unexpected(before.error());
    if (before->kind != SdoAnswer::Kind::confirmed || before->data.size() != 4) {
      return to_actual(*before, session, *object, true);
    }
    const CobId old(static_cast<std::uint32_t>(load_le(before->data)));
    const CobId target(static_cast<std::uint32_t>(*to));
    for (const auto value : canopen::change_sequence(*kind, old, target)) {
      auto answer = session.download(*object, to_le(value.value(), 4), canopen::SdoDownload::Mode::automatic,
                                     std::nullopt);
      if (!answer) return std::unexpected(answer.error());
      auto actual = to_actual(*answer, session, *object, false);
      if (actual.kind != Actual::Kind::confirmed) {
        return actual;
      }
      actual.detail = "confirmed";
      if (value == target) return actual;
    }
    return fail("unreachable");
  }

 private:
  ObjectReference object_;
  Expression to_;
};

constexpr Verb table[] = {
    {"upload", "Read an entry by SDO.",
     "object: the entry, 1003h:00 or $name\nsave: name that the data get\ntimeout: how long the answer may take (default: profile)",
     "- upload: {object: 1003h:00, save: count}\n  checks: OD-1003-01\n  expect: {size: 1, range: 0..FEh}",
     &Upload::parse},
    {"download", "Write an entry by SDO. The engine puts the old value back.",
     "object: the entry\nvalue: number, $name or expression, encoded with the entry's type\nbytes: data as they are, \"E8 03\"\n"
     "text: characters\nas: data type to encode with when it is not the entry's own\n"
     "transfer: automatic, expedited, expedited without size, segmented, segmented without size\ntimeout: how long the answer may take",
     "- download: {object: 1003h:00, value: 02h}\n  checks: OD-1003-06\n  expect: abort 0609 0030h\n  warn: [abort 0609 0031h]",
     &Download::parse},
    {"set_cob_id", "Change a COB-ID by the procedure of the standard: switch off, change, switch on.",
     "object: the COB-ID entry\nto: its new value, control bits included",
     "- set_cob_id: {object: 1014h:00, to: 6A0h}\n  checks: OD-1014-07", &SetCobId::parse},
};

}  // namespace

std::span<const Verb> sdo_verbs() { return table; }

}  // namespace conform::steps
