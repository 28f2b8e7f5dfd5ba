// SPDX-License-Identifier: Apache-2.0
#include "eds/convert/write_xdd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>

#include "base/text.hpp"
#include "eds/convert/xdd_types.hpp"
#include "eds/same_value.hpp"
#include "eds/xdd_extras.hpp"

namespace conform::eds {
namespace {

constexpr const char* name_space = "http://www.canopen.org/xml/1.1";

/// The schema qualifies the elements that it declares globally and no others; `c:` stands for its namespace
/// where the default is none.
class Writer {
 public:
  explicit Writer(const EdsFile& file) : file_(file) {}

  std::string text() {
    auto declaration = document_.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    declaration.append_attribute("encoding") = "utf-8";
    for (const auto& line : file_.comments.entries)
      document_.append_child(pugi::node_comment).set_value((" " + line.field.text + " ").c_str());
    auto root = document_.append_child("ISO15745ProfileContainer");
    root.append_attribute("xmlns") = name_space;
    root.append_attribute("xmlns:c") = name_space;
    root.append_attribute("xmlns:xsi") = "http://www.w3.org/2001/XMLSchema-instance";
    device(profile(root, "CANopen device profile", "Device", "c:ProfileBody_Device_CANopen"));
    network(profile(root, "CANopen communication network profile", "CommunicationNetwork",
                    "c:ProfileBody_CommunicationNetwork_CANopen"));
    std::ostringstream out;
    document_.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
    return out.str();
  }

 private:
  static pugi::xml_node element(pugi::xml_node parent, const char* name, const std::string& text) {
    auto out = parent.append_child(name);
    if (!text.empty()) out.append_child(pugi::node_pcdata).set_value(text.c_str());
    return out;
  }
  static void attribute(pugi::xml_node node, const char* name, const std::string& text) {
    node.append_attribute(name) = text.c_str();
  }
  static void optional(pugi::xml_node node, const char* name, const Field& field) {
    if (!field.empty()) attribute(node, name, field.text);
  }
  static void flag(pugi::xml_node node, const char* name, const Field& field) {
    attribute(node, name, same_flag(field.text, "1") ? "true" : "false");
  }
  static void label(pugi::xml_node parent, const char* name, const std::string& text) {
    element(parent, name, text).append_attribute("lang") = "en";
  }

  /// Returns the body.
  pugi::xml_node profile(pugi::xml_node root, const char* identification, const char* kind,
                         const char* type) {
    auto out = root.append_child("ISO15745Profile");
    auto header = out.append_child("ProfileHeader");
    header.append_attribute("xmlns") = "";
    element(header, "ProfileIdentification", identification);
    element(header, "ProfileRevision", "1.1");
    element(header, "ProfileName", file_.device_info.product_name.text);
    element(header, "ProfileSource", file_.device_info.vendor_name.text);
    element(header, "ProfileClassID", kind);
    auto reference = header.append_child("ISO15745Reference");
    element(reference, "ISO15745Part", "1");
    element(reference, "ISO15745Edition", "1");
    element(reference, "ProfileTechnology", "CANopen");
    auto body = out.append_child("ProfileBody");
    body.append_attribute("xmlns") = "";
    body.append_attribute("xsi:type") = type;
    body.append_attribute("formatName") = "CANopen";
    body.append_attribute("formatVersion") = "1.0";
    const auto& info = file_.file_info;
    attribute(body, "fileName", info.file_name.text);
    attribute(body, "fileCreator", info.created_by.text);
    attribute(body, "fileCreationDate", info.creation_date.text);
    optional(body, "fileCreationTime", info.creation_time);
    optional(body, "fileModifiedBy", info.modified_by);
    optional(body, "fileModificationDate", info.modification_date);
    optional(body, "fileModificationTime", info.modification_time);
    attribute(body, "fileVersion", info.file_version.text);
    body.append_attribute("supportedLanguages") = "en";
    return body;
  }

  void device(pugi::xml_node body) {
    const auto& info = file_.device_info;
    auto identity = body.append_child("c:DeviceIdentity");
    element(identity, "c:vendorName", info.vendor_name.text);
    if (!info.vendor_number.empty()) element(identity, "c:vendorID", info.vendor_number.text);
    element(identity, "c:productName", info.product_name.text);
    if (!info.product_number.empty()) element(identity, "c:productID", info.product_number.text);
    if (!file_.file_info.description.empty())
      label(identity.append_child("c:productText"), "description", file_.file_info.description.text);
    if (!info.order_code.empty()) element(identity, "c:orderNumber", info.order_code.text);
    // The schema wants at least one characteristic.
    auto characteristic = body.append_child("c:DeviceFunction")
                              .append_child("c:capabilities")
                              .append_child("c:characteristicsList")
                              .append_child("c:characteristic");
    label(characteristic.append_child("c:characteristicName"), "label", filler_name);
    label(characteristic.append_child("c:characteristicContent"), "label", filler_content);
    parameters(body);
  }

  static bool is_parameter(const Entry& entry) {
    return entry.access_type.text == "rwr" || entry.access_type.text == "rww";
  }
  static std::string parameter_id(Index index, const SubIndex* sub) {
    return sub == nullptr ? fmt::format("UID_OBJ_{:04X}", index.value())
                          : fmt::format("UID_SUB_{:04X}{:02X}", index.value(), sub->value());
  }

  void parameters(pugi::xml_node body) {
    pugi::xml_node list;
    const auto add = [&](const Entry& entry, const std::string& id) {
      if (!is_parameter(entry)) return;
      if (!list) list = body.append_child("c:ApplicationProcess").append_child("c:parameterList");
      parameter(list, entry, id);
    };
    for (const auto& object : file_.objects) {
      add(object.entry, parameter_id(object.index, nullptr));
      for (const auto& sub : object.subs) add(sub.entry, parameter_id(object.index, &sub.sub));
    }
  }

  static void parameter(pugi::xml_node list, const Entry& entry, const std::string& id) {
    auto out = list.append_child("c:parameter");
    attribute(out, "uniqueID", id);
    out.append_attribute("access") = entry.access_type.text == "rwr" ? "readWriteInput" : "readWriteOutput";
    label(out, "label", entry.parameter_name.text);
    out.append_child(std::string(xdd_type_of(data_type(entry).value_or(0))).c_str());
    if (!entry.denotation.empty()) label(out.append_child("c:denotation"), "label", entry.denotation.text);
    const auto value = [](pugi::xml_node parent, const char* name, const Field& field) {
      if (!field.empty()) attribute(parent.append_child(name), "value", field.text);
    };
    value(out, "c:actualValue", entry.parameter_value);
    value(out, "c:defaultValue", entry.default_value);
    if (entry.low_limit.empty()) return;
    auto range = out.append_child("c:allowedValues").append_child("c:range");
    value(range, "minValue", entry.low_limit);
    value(range, "maxValue", entry.high_limit);
  }

  void network(pugi::xml_node body) {
    auto layers = body.append_child("ApplicationLayers");
    objects(layers.append_child("c:CANopenObjectList"));
    if (!file_.dummy_usage.entries.empty()) dummies(layers.append_child("dummyUsage"));
    auto rates = body.append_child("TransportLayers").append_child("PhysicalLayer").append_child("baudRate");
    for (const auto& rate : file_.device_info.baud_rates)
      attribute(rates.append_child("supportedBaudRate"), "value", fmt::format("{} Kbps", rate.number));
    management(body.append_child("NetworkManagement"));
  }

  void objects(pugi::xml_node list) {
    const auto count = [&](ObjectList wanted) {
      return std::to_string(std::ranges::count_if(
          file_.objects, [wanted](const Object& object) { return list_of(object.index) == wanted; }));
    };
    attribute(list, "mandatoryObjects", count(ObjectList::mandatory));
    attribute(list, "optionalObjects", count(ObjectList::optional));
    attribute(list, "manufacturerObjects", count(ObjectList::manufacturer));
    for (const auto& object : file_.objects) {
      auto node = list.append_child("CANopenObject");
      attribute(node, "index", fmt::format("{:04X}", object.index.value()));
      entry(node, object.entry, parameter_id(object.index, nullptr));
      optional(node, "subNumber", object.sub_number);
      for (const auto& sub : object.subs) {
        auto child = node.append_child("CANopenSubObject");
        attribute(child, "subIndex", fmt::format("{:02X}", sub.sub.value()));
        entry(child, sub.entry, parameter_id(object.index, &sub.sub));
      }
    }
  }

  static void entry(pugi::xml_node node, const Entry& entry, const std::string& id) {
    attribute(node, "name", entry.parameter_name.text);
    attribute(node, "objectType", entry.object_type.text);
    if (!is_parameter(entry)) {
      // Two digits, as CiA 311 says, while they are enough.
      if (const auto type = data_type(entry))
        attribute(node, "dataType", fmt::format("{:0{}X}", *type, *type > 0xFF ? 4 : 2));
      optional(node, "lowLimit", entry.low_limit);
      optional(node, "highLimit", entry.high_limit);
      optional(node, "accessType", entry.access_type);
      optional(node, "defaultValue", entry.default_value);
      optional(node, "actualValue", entry.parameter_value);
      optional(node, "denotation", entry.denotation);
    }
    optional(node, "PDOmapping", entry.pdo_mapping);
    if (const auto flags = number_of(entry.obj_flags); flags.value_or(0) != 0)
      attribute(node, "objFlags", fmt::format("{:04X}", *flags));
    if (is_parameter(entry)) attribute(node, "uniqueIDRef", id);
  }

  void dummies(pugi::xml_node list) {
    for (const auto& dummy : file_.dummy_usage.entries)
      attribute(list.append_child("dummy"), "entry",
                fmt::format("Dummy{:04X}={}", dummy.number, same_flag(dummy.field.text, "1") ? 1 : 0));
  }

  void management(pugi::xml_node node) {
    const auto& info = file_.device_info;
    const auto number = [](pugi::xml_node into, const char* name, const Field& field) {
      attribute(into, name, field.empty() ? "0" : field.text);
    };
    auto general = node.append_child("CANopenGeneralFeatures");
    flag(general, "groupMessaging", info.group_messaging);
    number(general, "dynamicChannels", info.dynamic_channels);
    number(general, "granularity", info.granularity);
    number(general, "nrOfRxPDO", info.nr_of_rx_pdo);
    number(general, "nrOfTxPDO", info.nr_of_tx_pdo);
    flag(general, "bootUpSlave", info.simple_boot_up_slave);
    flag(general, "layerSettingServiceSlave", info.lss_supported);
    flag(node.append_child("CANopenMasterFeatures"), "bootUpMaster", info.simple_boot_up_master);
    const auto& from = file_.commissioning;
    if (!from.present) return;
    auto commissioning = node.append_child("deviceCommissioning");
    number(commissioning, "nodeID", from.node_id);
    attribute(commissioning, "nodeName", from.node_name.text);
    attribute(commissioning, "actualBaudRate", from.baudrate.empty() ? "" : from.baudrate.text + " Kbps");
    number(commissioning, "networkNumber", from.net_number);
    attribute(commissioning, "networkName", from.network_name.text);
    flag(commissioning, "CANopenManager", from.canopen_manager);
  }

  const EdsFile& file_;
  pugi::xml_document document_;
};

}  // namespace

std::string write_xdd(const EdsFile& file) { return Writer(file).text(); }

}  // namespace conform::eds
