// SPDX-License-Identifier: Apache-2.0
// Objects and sub-objects, each looked at alone: name, object type, data type, access.
#include <fmt/format.h>

#include "base/text.hpp"
#include "eds/lint_rules.hpp"
#include "eds/same_value.hpp"
#include "eds/type_table.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view descriptions = "CiA 306, object descriptions";

constexpr Rule no_name{"EDS200", Severity::warning, "ParameterName is missing", descriptions};
constexpr Rule bad_object_type{"EDS201", Severity::error, "ObjectType is none of the object codes",
                               "CiA 301, 7.4.3"};
constexpr Rule no_data_type{"EDS202", Severity::error, "A variable has no DataType", descriptions};
constexpr Rule bad_data_type{"EDS203", Severity::error, "DataType is a reserved one", "CiA 301, 7.4.7"};
constexpr Rule no_access{"EDS204", Severity::error, "A variable has no AccessType", descriptions};
constexpr Rule bad_access{"EDS205", Severity::error, "AccessType is none of ro, wo, rw, rwr, rww and const",
                          descriptions};
constexpr Rule not_for_variable{"EDS206", Severity::error, "A variable has SubNumber or CompactSubObj",
                                descriptions};
constexpr Rule no_object_type{"EDS207", Severity::error,
                              "An object with sub-objects has no ObjectType, so it is a variable",
                              descriptions};
constexpr Rule variable_with_subs{"EDS208", Severity::error, "A variable has sub-objects", descriptions};
constexpr Rule unmappable{"EDS209", Severity::error, "A DOMAIN can be mapped into PDOs", "CiA 301, 7.4.3"};
constexpr Rule no_direction{"EDS210", Severity::note,
                            "An rw object can be mapped, but into which PDOs is open", descriptions};
constexpr Rule unknown_flags{"EDS211", Severity::warning, "ObjFlags has unknown bits", descriptions};
constexpr Rule configured_constant{"EDS212", Severity::note, "A constant is configured with another value",
                                   "CiA 306, DCF; CiA 301, 7.4.5"};
constexpr Rule record_type{"EDS213", Severity::error, "A variable has the data type of a record",
                           "CiA 301, 7.4.7"};
constexpr Rule typed_domain{"EDS214", Severity::warning, "A DOMAIN has another data type or limits",
                            "CiA 301, 7.4.3"};

constexpr Rule not_for_structure{"EDS215", Severity::warning,
                                 "An array or record has an entry that only its sub-objects have",
                                 "CiA 306, object descriptions, table of entries"};
constexpr Rule open_length{"EDS216", Severity::warning,
                           "An object can be mapped, but its type has no fixed length or more than 64 bits",
                           "CiA 301, 7.4.7"};
constexpr Rule constant_mapped{"EDS217", Severity::note, "A constant can be mapped into PDOs", descriptions};

constexpr const Rule* all[] = {
    &no_name,           &bad_object_type,  &no_data_type,        &bad_data_type,      &no_access,
    &bad_access,        &not_for_variable, &no_object_type,      &variable_with_subs, &unmappable,
    &no_direction,      &unknown_flags,    &configured_constant, &record_type,        &typed_domain,
    &not_for_structure, &open_length,      &constant_mapped};

class Check {
 public:
  Check(const Spot& spot, const Subject& subject, Findings& findings)
      : spot_(spot), xml_(subject.file.is_xml()), node_(subject.node), findings_(findings) {}

  void run() {
    const auto& entry = spot_.entry;
    if (entry.parameter_name.empty()) add(no_name, entry.parameter_name, "ParameterName is missing");
    const auto code = object_code(entry);
    if (!code && number_of(entry.object_type))
      add(bad_object_type, entry.object_type,
          fmt::format("ObjectType {} is no object code", shortened(entry.object_type.text)));
    if (!spot_.sub) structure(code);
    const bool compact = number_of(spot_.object.compact_sub_obj).value_or(0) > 0;
    if (spot_.sub ||
        (!is_structured(spot_.object) && (code == ObjectCode::var || code == ObjectCode::domain)) || compact)
      variable(code);
    else if (!spot_.sub && is_structured(spot_.object) && !xml_)
      head();
    if (number_of(entry.obj_flags).value_or(0) > 3 && *number_of(entry.obj_flags) <= 0xFFFF'FFFF)
      add(unknown_flags, entry.obj_flags,
          fmt::format("ObjFlags {} has bits besides 0 and 1", shortened(entry.obj_flags.text)));
  }

 private:
  void add(const Rule& rule, const Field& field, const std::string& message, std::string hint = {}) {
    findings_.add(rule, place_of(field, spot_.entry.at), spot_.name() + ": " + message, std::move(hint));
  }

  void structure(std::optional<ObjectCode> code) {
    const auto& object = spot_.object;
    if (code != ObjectCode::var) return;
    const bool no_type = object.entry.object_type.empty();
    const std::string fix = "write ObjectType=0x8 for an array, 0x9 for a record";
    if (!object.subs.empty()) {
      if (no_type)
        add(no_object_type, object.entry.object_type, "ObjectType is missing, but there are sub-objects",
            fix);
      else
        add(variable_with_subs, object.entry.object_type,
            "ObjectType says variable, but there are sub-objects", fix);
      return;
    }
    for (const auto& row : object_fields) {
      const auto& field = object.*row.field;
      if (number_of(field).value_or(0) > 0)
        add(not_for_variable, field, fmt::format("{} {} for a variable", row.key, shortened(field.text)),
            fix);
    }
  }

  /// By the table of CiA 306 a structure without CompactSubObj has no values of its own.
  void head() {
    struct Row {
      std::string_view key;
      Field Entry::* field;
    };
    static constexpr Row rows[] = {
        {"DataType", &Entry::data_type},         {"AccessType", &Entry::access_type},
        {"DefaultValue", &Entry::default_value}, {"LowLimit", &Entry::low_limit},
        {"HighLimit", &Entry::high_limit},       {"PDOMapping", &Entry::pdo_mapping}};
    // Without ObjectType it is a variable by mistake, which is said already.
    if (object_code(spot_.entry) == ObjectCode::var) return;
    std::string keys;
    const Field* first = nullptr;
    for (const auto& row : rows) {
      const auto& field = spot_.entry.*row.field;
      // That a structure cannot be mapped is no harm to say.
      if (field.empty() || (row.key == "PDOMapping" && number_of(field) == 0U)) continue;
      keys += (first == nullptr ? "" : ", ") + std::string(row.key);
      if (first == nullptr) first = &field;
    }
    if (first != nullptr)
      add(not_for_structure, *first,
          fmt::format("what the sub-objects have is given for the whole: {}", keys));
  }

  void mapping(const Field& field, std::optional<Access> allowed, const TypeInfo* info) {
    if (info != nullptr && info->kind != TypeKind::domain && (info->bits == 0 || info->bits > 64))
      add(open_length, field,
          fmt::format(
              "{} {}", info->name,
              info->bits == 0 ? "has no fixed length, as what is mapped must have" : "is longer than a PDO"));
    if (allowed == Access::constant) add(constant_mapped, field, "a constant can be mapped");
  }

  void variable(std::optional<ObjectCode> code) {
    const auto& entry = spot_.entry;
    const auto type = data_type(entry);
    const auto* info = type ? find_type(*type) : nullptr;
    const bool domain = code == ObjectCode::domain || (info != nullptr && info->kind == TypeKind::domain);
    // CompactSubObj: the main section says what all its sub-objects are.
    const bool typed = code == ObjectCode::var || (!spot_.sub && is_structured(spot_.object));
    if (entry.data_type.empty() && typed) {
      add(no_data_type, entry.data_type, "DataType is missing");
    } else if (type && is_reserved_type(*type)) {
      add(bad_data_type, entry.data_type,
          fmt::format("DataType {} is reserved", shortened(entry.data_type.text)));
    } else if (info != nullptr && info->kind == TypeKind::record) {
      add(record_type, entry.data_type, fmt::format("{} is no type of a variable", info->name));
    }
    if (code == ObjectCode::domain) {
      if (info != nullptr && info->kind != TypeKind::domain)
        add(typed_domain, entry.data_type, fmt::format("the data type of a DOMAIN is not {}", info->name));
      for (const auto* limit : {&entry.low_limit, &entry.high_limit}) {
        if (!limit->empty()) add(typed_domain, *limit, "a DOMAIN has no limits");
      }
    }
    const auto& word = entry.access_type;
    const auto allowed = access(entry);
    if (word.empty() && !domain && typed) {
      add(no_access, word, "AccessType is missing");
    } else if (!word.empty() && (!allowed || without_comment(word.text).size() != word.text.size())) {
      // noAccess is how a parameter of CiA 311 says that it is not in the dictionary's reach.
      if (!xml_ || word.text != "noAccess")
        add(bad_access, word,
            fmt::format("AccessType '{}' is none of ro, wo, rw, rwr, rww and const", shortened(word.text)));
    }
    const bool mappable = pdo_mapping(entry) != PdoMapping::no;
    if (domain && mappable) add(unmappable, entry.pdo_mapping, "a DOMAIN cannot be mapped");
    if (mappable && allowed == Access::rw && pdo_mapping(entry) == PdoMapping::yes && !xml_)
      add(no_direction, word, "rw and mappable: into RPDOs, TPDOs or both is open",
          "rwr for TPDOs, rww for RPDOs say it");
    if (mappable) mapping(entry.pdo_mapping, allowed, info);
    // What is only read may well have another value in one device than the description says for all of them.
    if (!entry.parameter_value.empty() && allowed == Access::constant && !entry.default_value.empty() &&
        !may_be_same_value(entry.parameter_value, entry.default_value, type, node_))
      add(configured_constant, entry.parameter_value,
          fmt::format("ParameterValue {} is not the DefaultValue {} of a constant",
                      shortened(entry.parameter_value.text), shortened(entry.default_value.text)));
  }

  const Spot& spot_;
  bool xml_;
  std::optional<std::uint8_t> node_;
  Findings& findings_;
};

void check(const Subject& subject, Findings& findings) {
  each_described(subject, [&](const Spot& spot) { Check(spot, subject, findings).run(); });
}

}  // namespace

constinit const Group object_rules{{"Objects and sub-objects", all}, check};

}  // namespace conform::eds
