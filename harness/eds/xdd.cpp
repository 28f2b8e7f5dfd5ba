// SPDX-License-Identifier: Apache-2.0
#include "eds/xdd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/text.hpp"
#include "eds/convert/xdd_types.hpp"
#include "eds/ini_file.hpp"
#include "eds/xdd_extras.hpp"
#include "eds/xdd_structure.hpp"
#include "eds/xml_text.hpp"

namespace conform::eds {
namespace {

constexpr std::ptrdiff_t most_tags = 1'000'000;  // pugixml takes some 100 bytes for each
constexpr unsigned deepest = 64;                 // the schema needs about ten

struct AccessName {
  std::string_view attribute;
  std::string_view access;
};
/// The access of a parameter. A process input is read from the bus (rwr), a process output written (rww).
constexpr AccessName access_names[] = {
    {"read", "ro"},           {"write", "wo"},           {"readWrite", "rw"},
    {"const", "const"},       {"readWriteInput", "rwr"}, {"readWriteOutput", "rww"},
    {"noAccess", "noAccess"},
};

std::optional<std::uint32_t> bare_hex(std::string_view text) {
  text = trim(text);
  if (text.starts_with("0x") || text.starts_with("0X")) text.remove_prefix(2);
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// CiA 311 writes these attributes as hexadecimal digits alone; with 0x they are numbers as everywhere else.
Field with_hex_prefix(Field field) {
  if (!field.text.empty() && !field.text.starts_with("0x") && !field.text.starts_with("0X"))
    field.text.insert(0, "0x");
  return field;
}

class XddReader {
 public:
  XddReader(std::string_view bytes, std::string name) : bytes_(bytes), text_(bytes), extras_(text_) {
    out_.name = std::move(name);
  }

  Result<EdsFile> read() {
    if (std::ranges::count(bytes_, '<') > most_tags)
      return fail(fmt::format("more than {} tags", most_tags), place({1, 1}));
    pugi::xml_document document;
    const auto parsed =
        document.load_buffer(bytes_.data(), bytes_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!parsed) {
      const auto offset =
          std::clamp<std::ptrdiff_t>(parsed.offset, 0, static_cast<std::ptrdiff_t>(bytes_.size()));
      return fail(fmt::format("not well-formed XML: {}", lower(parsed.description())),
                  place(text_.position(static_cast<std::size_t>(offset))));
    }
    const auto root = document.document_element();
    if (local_name(root) != "ISO15745ProfileContainer") {
      return fail(fmt::format("the root element is <{}>", shortened(root.name())),
                  place(text_.position(root)), "an XDD or XDC begins with <ISO15745ProfileContainer>");
    }
    if (!visit(root, 0)) return std::unexpected(*refused_);
    for (const auto& list : object_lists_) read_objects(list);
    if (object_lists_.empty()) out_.remarks.add(Deviation::xml_no_object_list, text_.position(root));
    for (const auto& [id, node] : by_id_) {
      if (local_name(node) == "parameter" && !referred_.contains(id)) extras_.note("parameter", node);
    }
    out_.unmodelled = extras_.take();
    check_xdd_structure(root, text_, out_.remarks);
    out_.format = is_xdc() ? Format::xdc : Format::xdd;
    return std::move(out_);
  }

 private:
  std::string place(Position position) const {
    return fmt::format("{}:{}:{}", out_.name, position.line, position.column);
  }

  /// Walks down to the parts that the model knows, wherever the version of the schema puts them.
  bool visit(const pugi::xml_node& node, unsigned depth) {
    if (depth > deepest) {
      refused_ =
          Error{fmt::format("elements nested deeper than {}", deepest), place(text_.position(node)), {}};
      return false;
    }
    const auto name = local_name(node);
    if (name == "ProfileBody") file_info(node);
    if (name == "DeviceIdentity") identity(node);
    if (name == "CANopenObjectList") {
      object_lists_.push_back(node);
      return true;
    }
    static constexpr std::string_view referred_to[] = {
        "parameter", "parameterTemplate", "allowedValuesTemplate", "array", "enum", "derived"};
    if (std::ranges::find(referred_to, name) != std::end(referred_to)) {
      if (const auto id = node.attribute("uniqueID")) by_id_.try_emplace(id.value(), node);
    }
    if (name == "dummy") dummy(node);
    if (name == "supportedBaudRate") baud_rate(node);
    if (name == "CANopenGeneralFeatures") general_features(node);
    if (name == "CANopenMasterFeatures")
      keep(out_.device_info.simple_boot_up_master, text_.attribute(node, "bootUpMaster"));
    if (name == "deviceCommissioning") commissioning(node);
    extras_.look(node);
    return std::ranges::all_of(node.children(),
                               [&](const pugi::xml_node& each) { return visit(each, depth + 1); });
  }

  /// A part of the file begins, or goes on, here: its place is the first one.
  template <typename Part>
  void found(Part& part, const pugi::xml_node& node) const {
    if (!part.present) part.at = text_.position(node);
    part.present = true;
  }

  static void keep(Field& into, Field from) {
    if (!into.present) into = std::move(from);
  }

  void file_info(const pugi::xml_node& node) {
    auto& info = out_.file_info;
    found(info, node);
    keep(info.file_name, text_.attribute(node, "fileName"));
    keep(info.file_version, text_.attribute(node, "fileVersion"));
    keep(info.created_by, text_.attribute(node, "fileCreator"));
    keep(info.creation_date, text_.attribute(node, "fileCreationDate"));
    keep(info.creation_time, text_.attribute(node, "fileCreationTime"));
    keep(info.modified_by, text_.attribute(node, "fileModifiedBy"));
    keep(info.modification_date, text_.attribute(node, "fileModificationDate"));
    keep(info.modification_time, text_.attribute(node, "fileModificationTime"));
  }

  void identity(const pugi::xml_node& node) {
    auto& info = out_.device_info;
    found(info, node);
    keep(info.vendor_name, text_.content(child(node, "vendorName")));
    keep(info.vendor_number, text_.content(child(node, "vendorID")));
    keep(info.product_name, text_.content(child(node, "productName")));
    keep(info.product_number, text_.content(child(node, "productID")));
    keep(info.order_code, text_.content(child(node, "orderNumber")));
    // No elements of CiA 311, but of CANopenEditor.
    keep(info.revision_number, text_.content(child(node, "revisionNumber")));
    keep(info.order_code, text_.content(child(node, "orderCode")));
    keep(out_.file_info.description, text_.content(child(child(node, "productText"), "description")));
  }

  void general_features(const pugi::xml_node& node) {
    auto& info = out_.device_info;
    found(info, node);
    keep(info.granularity, text_.attribute(node, "granularity"));
    keep(info.nr_of_rx_pdo, text_.attribute(node, "nrOfRxPDO"));
    keep(info.nr_of_tx_pdo, text_.attribute(node, "nrOfTxPDO"));
    keep(info.simple_boot_up_slave, text_.attribute(node, "bootUpSlave"));
    keep(info.lss_supported, text_.attribute(node, "layerSettingServiceSlave"));
    keep(info.group_messaging, text_.attribute(node, "groupMessaging"));
    keep(info.dynamic_channels, text_.attribute(node, "dynamicChannels"));
  }

  void commissioning(const pugi::xml_node& node) {
    auto& info = out_.commissioning;
    found(info, node);
    keep(info.node_id, text_.attribute(node, "nodeID"));
    keep(info.node_name, text_.attribute(node, "nodeName"));
    keep(info.baudrate, kbit_per_s(text_.attribute(node, "actualBaudRate")));
    keep(info.net_number, text_.attribute(node, "networkNumber"));
    keep(info.network_name, text_.attribute(node, "networkName"));
    keep(info.canopen_manager, text_.attribute(node, "CANopenManager"));
  }

  /// "500 Kbps" as the number that it is in a DCF; what has no unit stays.
  static Field kbit_per_s(Field field) {
    const auto blank = field.text.find(' ');
    if (blank != std::string::npos && same_word(trim(std::string_view(field.text).substr(blank)), "Kbps"))
      field.text.resize(blank);
    return field;
  }

  /// entry="Dummy0005=1"
  void dummy(const pugi::xml_node& node) {
    auto field = text_.attribute(node, "entry");
    out_.dummy_usage.present = true;
    if (!out_.dummy_usage.at.known()) out_.dummy_usage.at = text_.position(node);
    const std::string_view text = field.text;
    const auto equals = text.find('=');
    if (equals == std::string_view::npos || equals < 5 || !same_word(text.substr(0, 5), "Dummy")) return;
    const auto type = bare_hex(text.substr(5, equals - 5));
    if (!type) return;
    field.text = std::string(trim(text.substr(equals + 1)));
    out_.dummy_usage.entries.push_back({*type, std::move(field)});
  }

  /// value="250 Kbps"
  void baud_rate(const pugi::xml_node& node) {
    auto field = text_.attribute(node, "value");
    std::uint64_t rate = 0;
    const auto* begin = field.text.data();
    const auto [end, error] = std::from_chars(begin, begin + field.text.size(), rate, 10);
    if (error != std::errc()) return;
    field.text = "1";
    out_.device_info.baud_rates.push_back({rate, std::move(field)});
  }

  void read_objects(const pugi::xml_node& list) {
    std::map<Index, Object> objects;
    for (auto& known : std::exchange(out_.objects, {})) objects.emplace(known.index, std::move(known));
    for (const auto& node : list.children()) {
      if (local_name(node) != "CANopenObject") continue;
      const auto index = bare_hex(node.attribute("index").value());
      if (!index || *index > 0xFFFF) {
        out_.remarks.add(Deviation::xml_bad_index, text_.position(node), node.attribute("index").value());
        continue;
      }
      Object object;
      object.index = Index(static_cast<std::uint16_t>(*index));
      object.entry = entry(node);
      object.sub_number = text_.attribute(node, "subNumber");
      read_subs(node, object);
      const auto [known, is_new] = objects.try_emplace(object.index, object);
      if (!is_new)
        out_.remarks.add(Deviation::xml_duplicate_object, object.entry.at, to_string(object.index),
                         known->second.entry.at);
    }
    for (auto& [index, object] : objects) out_.objects.push_back(std::move(object));
  }

  void read_subs(const pugi::xml_node& node, Object& object) {
    std::map<SubIndex, Entry> subs;
    for (const auto& each : node.children()) {
      if (local_name(each) != "CANopenSubObject") continue;
      const auto sub = bare_hex(each.attribute("subIndex").value());
      if (!sub || *sub > 0xFF) {
        out_.remarks.add(Deviation::xml_bad_index, text_.position(each), each.attribute("subIndex").value());
        continue;
      }
      const auto [known, is_new] = subs.try_emplace(SubIndex(static_cast<std::uint8_t>(*sub)), entry(each));
      if (!is_new)
        out_.remarks.add(Deviation::xml_duplicate_object, text_.position(each),
                         to_string(Multiplexer{object.index, known->first}), known->second.at);
    }
    for (auto& [sub, found] : subs) object.subs.push_back({sub, std::move(found)});
  }

  Entry entry(const pugi::xml_node& node) {
    Entry out;
    out.at = text_.position(node);
    out.parameter_name = text_.attribute(node, "name");
    out.object_type = text_.attribute(node, "objectType");
    out.data_type = with_hex_prefix(text_.attribute(node, "dataType"));
    out.access_type = text_.attribute(node, "accessType");
    out.default_value = text_.attribute(node, "defaultValue");
    out.low_limit = text_.attribute(node, "lowLimit");
    out.high_limit = text_.attribute(node, "highLimit");
    out.pdo_mapping = text_.attribute(node, "PDOmapping");
    out.obj_flags = with_hex_prefix(text_.attribute(node, "objFlags"));
    out.parameter_value = text_.attribute(node, "actualValue");
    out.denotation = text_.attribute(node, "denotation");
    static constexpr std::string_view mappings[] = {"", "no", "default", "optional", "TPDO", "RPDO"};
    if (std::ranges::find(mappings, out.pdo_mapping.text) == std::end(mappings))
      out_.remarks.add(Deviation::xml_unknown_mapping, out.pdo_mapping.at, out.pdo_mapping.text);
    resolve(node, out);
    return out;
  }

  /// Fills what the object leaves to the parameter it refers to.
  void resolve(const pugi::xml_node& node, Entry& into) {
    const auto parameter = referred(node, "uniqueIDRef", "parameter");
    if (!parameter) return;
    take(parameter, into);
    // CiA 311: what the parameter leaves out is in its template. An element of its own replaces that of the
    // template, also where it says less: a list of values has no limits.
    const auto other = referred(parameter, "templateIDRef", "parameterTemplate");
    if (other) take(other, into, !child(parameter, "allowedValues"));
    const auto at = text_.position(parameter);
    // The default of the schema.
    if (into.access_type.empty() && object_code(into) == ObjectCode::var)
      into.access_type = {"ro", at, at, true};
  }

  /// The element of this kind that the attribute names; a null node when there is no attribute, or no such
  /// element.
  pugi::xml_node referred(const pugi::xml_node& node, const char* attribute, std::string_view kind) {
    const auto reference = node.attribute(attribute);
    if (!reference) return {};
    const auto found = by_id_.find(reference.value());
    if (found != by_id_.end() && local_name(found->second) == kind) {
      referred_.insert(found->first);
      return found->second;
    }
    out_.remarks.add(Deviation::xml_unknown_reference, text_.attribute(node, attribute).at,
                     reference.value());
    return {};
  }

  /// What a parameter or its template says of an entry that says nothing itself.
  void take(const pugi::xml_node& parameter, Entry& into, bool limits = true) {
    const auto at = text_.position(parameter);
    const auto type = type_of(parameter);
    const auto fill = [](Field& field, Field from) {
      if (field.empty() && from.present) field = std::move(from);
    };
    if (into.data_type.empty() && type && object_code(into) == ObjectCode::var)
      into.data_type = {fmt::format("0x{:04X}", *type), at, at, true};
    if (into.access_type.empty() && parameter.attribute("access") && object_code(into) == ObjectCode::var) {
      // A word that nobody knows stays as it is, for the lint to find.
      into.access_type = text_.attribute(parameter, "access");
      const std::string_view word = into.access_type.text;
      const auto* known = std::ranges::find(access_names, word, &AccessName::attribute);
      if (known != std::end(access_names)) into.access_type.text = known->access;
    }
    fill(into.default_value, text_.attribute(child(parameter, "defaultValue"), "value"));
    fill(into.parameter_value, text_.attribute(child(parameter, "actualValue"), "value"));
    fill(into.denotation, text_.content(child(child(parameter, "denotation"), "label")));
    if (!limits) return;
    const auto allowed = child(parameter, "allowedValues");
    auto range = child(allowed, "range");
    if (!range) range = child(referred(allowed, "templateIDRef", "allowedValuesTemplate"), "range");
    fill(into.low_limit, text_.attribute(child(range, "minValue"), "value"));
    fill(into.high_limit, text_.attribute(child(range, "maxValue"), "value"));
  }

  /// The elementary type among the children, or of the type that is referred to.
  std::optional<std::uint16_t> type_of(const pugi::xml_node& node) const {
    if (const auto own = elementary_type(node)) return own;
    const auto reference = by_id_.find(child(node, "dataTypeIDRef").attribute("uniqueIDRef").value());
    return reference == by_id_.end() ? std::nullopt : elementary_type(reference->second);
  }

  static std::optional<std::uint16_t> elementary_type(const pugi::xml_node& node) {
    for (const auto& each : node.children()) {
      const auto found = std::ranges::find(xdd_types(), local_name(each), &XddType::element);
      if (found != xdd_types().end()) return found->data_type;
    }
    return std::nullopt;
  }

  /// A configuration says what the values of one device are; a description says only what they could be.
  [[nodiscard]] bool is_xdc() const {
    const auto configured = [](const Entry& entry) {
      return !entry.parameter_value.empty() || !entry.denotation.empty();
    };
    return number_of(out_.commissioning.node_id).value_or(0) > 0 ||
           std::ranges::any_of(out_.objects, [&](const Object& object) {
             return configured(object.entry) ||
                    std::ranges::any_of(object.subs, [&](const auto& sub) { return configured(sub.entry); });
           });
  }

  std::string_view bytes_;
  XmlText text_;
  EdsFile out_;
  std::optional<Error> refused_;
  std::vector<pugi::xml_node> object_lists_;
  std::unordered_map<std::string, pugi::xml_node> by_id_;
  std::unordered_set<std::string> referred_;  ///< of the ids
  XddExtras extras_;
};

}  // namespace

Result<EdsFile> read_xdd(std::string_view bytes, std::string file_name) {
  return XddReader(bytes, std::move(file_name)).read();
}

}  // namespace conform::eds
