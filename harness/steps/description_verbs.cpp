// SPDX-License-Identifier: Apache-2.0
// Verbs that hold the device against a description: how many objects of a kind there are, and whether the
// description inside the device (1021h) is one, and its own.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "eds/compare.hpp"
#include "eds/lint.hpp"
#include "eds/read.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

constexpr std::size_t most_told = 3;

/// "a, b, c and 5 more"
std::string some_of(const std::vector<std::string>& all) {
  std::vector<std::string> told(all.begin(),
                                all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), most_told)));
  return join(told, ", ") +
         (all.size() > most_told ? fmt::format(" and {} more", all.size() - most_told) : std::string());
}

/// Objects there are in a range of indices.
class Objects final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<Objects>();
    auto fields = value.fields("objects");
    const auto first = fields.required("first").number(0, 0xFFFF);
    const auto last = fields.required("last").number(0, 0xFFFF);
    if (const auto save = fields.optional("save")) {
      out->save_ = save.text().value_or("");
      context.know(out->save_);
    }
    if (!first || !last || *last < *first) return nullptr;
    out->first_ = static_cast<std::uint16_t>(*first);
    out->last_ = static_cast<std::uint16_t>(*last);
    return out;
  }
  Need need() const override { return {}; }
  bool rests_on_time() const override { return false; }
  Measures measures() const override { return {"count"}; }
  std::string words(Session&) const override {
    return "count the objects from " + to_string(Index(first_)) + " to " + to_string(Index(last_));
  }
  Result<Actual> run(Session& session) const override {
    std::vector<std::string> there;
    for (unsigned index = first_; index <= last_; ++index) {
      const Multiplexer object{Index(static_cast<std::uint16_t>(index)), SubIndex(0)};
      // An object behind a gap of so many would be one that nobody uses.
      const bool looked_for =
          index - first_ < most_unclaimed || session.is_claimed(object, true) || session.tries_all_objects();
      if (!looked_for) continue;
      const auto present = session.is_present(object, true);
      if (!present) return std::unexpected(present.error());
      if (*present) there.push_back(to_string(object.index));
    }
    Actual out;
    out.measured["count"] = there.size();
    out.detail = fmt::format("{} objects", there.size()) + (there.empty() ? "" : ": " + some_of(there));
    if (!save_.empty()) session.set(save_, Value::of_number(there.size()));
    return out;
  }

 private:
  static constexpr unsigned most_unclaimed = 32;
  std::uint16_t first_ = 0, last_ = 0;
  std::string save_;
};

class StoredDescription final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<StoredDescription>();
    std::optional<ObjectReference> object;
    if (value.node()->is_mapping()) {
      auto fields = value.fields("stored_description");
      object = parse_object_at(fields.required("object"), context.names);
      out->content_ = parse_expression_at(fields.required("content"), context.names);
      if (!out->content_) return nullptr;
    } else {
      object = parse_object_at(value, context.names);
    }
    if (!object) return nullptr;
    out->object_ = *object;
    return out;
  }
  Need need() const override { return {}; }
  bool acts() const override { return !content_; }
  bool rests_on_time() const override { return false; }
  const ObjectReference* object() const override { return &object_; }
  Measures measures() const override { return {"malformed", "difference", "absent"}; }
  std::string words(Session&) const override {
    return content_ ? "take what " + object_.text() + " holds for a device description"
                    : "read the device description in " + object_.text();
  }

  Result<Actual> run(Session& session) const override {
    const auto object = object_.resolve(session);
    if (!object) return std::unexpected(object.error());
    if (content_) {
      auto content = content_->evaluate(session);
      if (!content) return std::unexpected(content.error());
      if (!content->bytes) return fail_scenario("'" + content_->text() + "' are no data");
      return judge(session, *object, *content->bytes, {});
    }
    auto answer = session.upload(*object, std::nullopt);
    if (!answer) return std::unexpected(answer.error());
    Actual out;
    out.decisive = answer->decisive;
    if (answer->kind == SdoAnswer::Kind::confirmed)
      return judge(session, *object, answer->data, std::move(out));
    out.kind = answer->kind == SdoAnswer::Kind::aborted   ? Actual::Kind::aborted
               : answer->kind == SdoAnswer::Kind::silence ? Actual::Kind::silence
                                                          : Actual::Kind::violation;
    out.code = answer->code;
    out.detail = answer->detail;
    return out;
  }

 private:
  static Result<Actual> judge(Session& session, Multiplexer object, const Bytes& content, Actual out) {
    if (content.empty()) {
      out.detail = "nothing";
      return out;
    }
    const std::string name = to_string(object);
    const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
    const auto file = eds::read(text, name);
    if (!file) return no_description(std::move(out), file.error().text());
    if (!file->device_info.present || file->objects.empty())
      return no_description(std::move(out), name + " names no device and no objects");
    auto compared = compare(session, *file, std::move(out));
    if (compared) compared->detail += mistakes_in(*file, name);
    return compared;
  }

  static Actual no_description(Actual out, const std::string& why) {
    out.measured["malformed"] = 1;
    out.measured["difference"] = out.measured["absent"] = 0;
    out.detail = "no device description: " + printable(why);
    return out;
  }

  /// Told, not judged: what is wrong in a description is `eds lint`'s to say.
  static std::string mistakes_in(const eds::EdsFile& file, const std::string& name) {
    const auto report = eds::lint(file);
    for (const auto& finding : report.findings) {
      if (finding.rule->severity != eds::Severity::error) continue;
      return fmt::format("; mistakes in it: {}, the first at {}:{}: {} ({})",
                         report.count(eds::Severity::error), name, eds::to_string(finding.at),
                         printable(finding.message), finding.rule->code);
    }
    return {};
  }

  static Result<Actual> compare(Session& session, const eds::EdsFile& file, Actual out) {
    auto different = other_identity(session, file);
    if (!different) return std::unexpected(different.error());
    if (const auto& given = session.profile().description) {
      auto differences = eds::compare(*given, file);
      if (!differences) {
        different->push_back(printable(differences.error().what));
      } else {
        for (const auto& each : *differences) {
          if (!of_a_configuration(each))
            different->push_back(printable(each.where + (each.key.empty() ? "" : " " + each.key)));
        }
      }
    }
    auto absent = not_in_the_device(session, file);
    if (!absent) return std::unexpected(absent.error());
    out.measured["malformed"] = 0;
    out.measured["difference"] = different->size();
    out.measured["absent"] = absent->size();
    out.detail = fmt::format("a device description of {} objects", file.objects.size());
    if (!different->empty()) out.detail += "; other than it should be: " + some_of(*different);
    if (!absent->empty()) out.detail += "; not in the device: " + some_of(*absent);
    return out;
  }

  /// A DCF that is given says what somebody configures, not what the device is.
  static bool of_a_configuration(const eds::Difference& each) {
    constexpr std::array<std::string_view, 5> keys = {"ParameterValue", "Denotation", "ParamRefd",
                                                      "UploadFile", "DownloadFile"};
    return each.where.starts_with("[DeviceCom") || std::ranges::find(keys, each.key) != keys.end();
  }

  /// VendorNumber, ProductNumber and RevisionNumber against 1018h:01 to 03.
  static Result<std::vector<std::string>> other_identity(Session& session, const eds::EdsFile& file) {
    const std::array<std::pair<const char*, const eds::Field*>, 3> parts = {
        {{"VendorNumber", &file.device_info.vendor_number},
         {"ProductNumber", &file.device_info.product_number},
         {"RevisionNumber", &file.device_info.revision_number}}};
    std::vector<std::string> out;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto said = eds::number_of(*parts[i].second);
      if (!said) continue;
      const Multiplexer entry{Index(0x1018), SubIndex(static_cast<std::uint8_t>(i + 1))};
      const auto present = session.is_present(entry, false);
      if (!present) return std::unexpected(present.error());
      if (!*present) continue;
      const auto held = session.read(entry);
      if (!held) return std::unexpected(held.error());
      if (held->number && *held->number != *said)
        out.push_back(fmt::format("{} {} where {} is {}", parts[i].first, hex(*said, 8), to_string(entry),
                                  hex(*held->number, 8)));
    }
    return out;
  }

  /// Of the objects that it describes; of many a sample, spread over all of them.
  static Result<std::vector<std::string>> not_in_the_device(Session& session, const eds::EdsFile& file) {
    constexpr std::size_t sample = 256;
    const std::size_t count = file.objects.size();
    const std::size_t stride = session.tries_all_objects() ? 1 : (count + sample - 1) / sample;
    std::vector<std::string> out;
    for (std::size_t i = 0; i < count; i += std::max<std::size_t>(stride, 1)) {
      // The last one is always among them.
      const auto& object = file.objects[count - 1 - i];
      if (eds::refuses_read(object.entry)) continue;
      const auto present = session.is_present({object.index, SubIndex(0)}, true);
      if (!present) return std::unexpected(present.error());
      if (!*present) out.push_back(to_string(object.index));
    }
    return out;
  }

  ObjectReference object_;
  std::optional<Expression> content_;
};

constexpr Verb table[] = {
    {"objects", "Count the objects there are in a range of indices.",
     "first, last: indices; looked for are the first 32, those that the description has, and with --all-objects all\n"
     "save: name that the number gets\nmeasured: count",
     "- objects: {first: 1400h, last: 15FFh, save: count}\n- require: $count is $profile.rpdos",
     &Objects::parse},
    {"stored_description",
     "Read the device description (EDS) that an entry holds, and hold it against the device and the given one.",
     "(entry): 1021h:00; or object: the entry, content: what was read of it before\nmeasured: malformed (1: it is no device description), difference (from the given one and from "
     "1018h), absent (objects it describes that the device does not have)",
     "- stored_description: 1021h:00\n  checks: EDS-VSD-11\n  expect: {malformed: 0, difference: 0, absent: 0}",
     &StoredDescription::parse},
};

}  // namespace

std::span<const Verb> description_verbs() { return table; }

}  // namespace conform::steps
