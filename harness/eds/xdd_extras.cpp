// SPDX-License-Identifier: Apache-2.0
#include "eds/xdd_extras.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "base/text.hpp"

namespace conform::eds {
namespace {

/// Elements that are something of their own as soon as they have an element or an attribute in them.
constexpr std::array structures = std::to_array<std::string_view>({
    "indicatorList",
    "moduleManagement",
    "picturesList",
    "dictionaryList",
    "standardComplianceList",
    "functionTypeList",
    "functionInstanceList",
    "parameterGroupList",
    "dynamicChannels",
    "enum",
    "struct",
    "unit",
    "property",
    "substituteValue",
    "conditionalSupport",
    "variableRef",
    "ExternalProfileHandle",
    "characteristicsList",
});
/// Elements that are a text, or labels.
constexpr std::array texts = std::to_array<std::string_view>({
    "vendorText",
    "deviceFamily",
    "productFamily",
    "version",
    "buildDate",
    "specificationRevision",
    "instanceName",
});

struct AttributeRow {
  std::string_view element;
  const char* attribute;
  std::string_view nothing;  ///< the default of the schema, which says nothing
};
constexpr AttributeRow attributes[] = {
    {"CANopenGeneralFeatures", "selfStartingDevice", "false"},
    {"CANopenGeneralFeatures", "SDORequestingDevice", "false"},
    {"CANopenMasterFeatures", "flyingMaster", "false"},
    {"CANopenMasterFeatures", "SDOManager", "false"},
    {"CANopenMasterFeatures", "configurationManager", "false"},
    {"CANopenMasterFeatures", "layerSettingServiceMaster", "false"},
    {"ApplicationLayers", "conformanceClass", ""},
    {"ApplicationLayers", "communicationEntityType", "slave"},
    {"ProfileBody", "deviceClass", ""},
    {"baudRate", "defaultValue", ""},
    {"parameter", "persistent", "false"},
    {"parameter", "offset", "0"},
    {"parameter", "multiplier", "1"},
};

bool says_something(const pugi::xml_node& node) {
  if (!trim(node.child_value()).empty()) return true;
  return std::ranges::any_of(node.children(),
                             [](const pugi::xml_node& each) { return says_something(each); });
}

std::string_view label_of(const pugi::xml_node& node) { return child(node, "label").child_value(); }

bool is_filler(const pugi::xml_node& list) {
  const auto only = child(list, "characteristic");
  const auto elements = std::ranges::count_if(
      list.children(), [](const pugi::xml_node& each) { return each.type() == pugi::node_element; });
  return elements == 1 && label_of(child(only, "characteristicName")) == filler_name &&
         label_of(child(only, "characteristicContent")) == filler_content;
}

}  // namespace

void XddExtras::look(const pugi::xml_node& node) {
  const auto name = local_name(node);
  const auto is = [name](const auto& list) { return std::ranges::find(list, name) != list.end(); };
  if (is(structures) && (node.first_child() || node.first_attribute())) {
    if (name != "characteristicsList" || !is_filler(node)) note(name, node);
  }
  if (is(texts) && says_something(node)) note(name, node);
  // The model has room for one.
  if (name == "orderNumber" && !(child(node.parent(), name) == node)) note(name, node);
  const auto parent = local_name(node.parent());
  if (name == "description" && parent == "parameter" && says_something(node)) note("description", node);
  if (name == "value" && parent == "allowedValues") note("allowedValues/value", node);
  if (name == "supportedBaudRate" && node.attribute("value").as_string() == std::string_view("auto-baudRate"))
    note("supportedBaudRate auto-baudRate", node);
  for (const auto& row : attributes) {
    if (row.element != name) continue;
    const auto attribute = node.attribute(row.attribute);
    const std::string_view value = attribute.value();
    if (attribute && !value.empty() && value != row.nothing && !(row.nothing == "false" && value == "0"))
      note(std::string(name) + "/@" + row.attribute, node);
  }
}

void XddExtras::note(std::string_view what, const pugi::xml_node& node) {
  const auto at = text_.position(node);
  const auto [found, fresh] = found_.try_emplace(std::string(what), Unmodelled{std::string(what), at, 1});
  if (fresh) return;
  ++found->second.count;
  found->second.at = std::min(found->second.at, at);
}

std::vector<Unmodelled> XddExtras::take() {
  std::vector<Unmodelled> out;
  for (auto& [what, extra] : found_) out.push_back(std::move(extra));
  std::ranges::sort(out, {}, &Unmodelled::at);
  return out;
}

}  // namespace conform::eds
