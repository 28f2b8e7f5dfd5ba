// SPDX-License-Identifier: Apache-2.0
#include "eds/xdd_grammar.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "base/text.hpp"

namespace conform::eds {
namespace {

/// An element on one line: its children in their order (? at most one, * any, + at least one, | one of), and
/// its attributes (! required, : the form of the value). "..." are children that are not looked at.
struct Row {
  std::string_view name;
  bool global;
  std::string_view children;
  std::string_view attributes;
};

constexpr std::string_view file_attributes =
    "formatName formatVersion fileName! fileCreator! fileCreationDate!:date fileCreationTime:time "
    "fileModifiedBy fileModificationDate:date fileModificationTime:time fileVersion! supportedLanguages deviceClass";
constexpr std::string_view value_attributes = "value! offset multiplier";
constexpr std::string_view entry_attributes =
    "name! objectType!:byte dataType:hex lowLimit highLimit accessType:access defaultValue actualValue denotation "
    "PDOmapping objFlags:hex uniqueIDRef rangeSelector ";
constexpr std::string_view parameter_children =
    "label|description|labelRef|descriptionRef+ "
    "BOOL|BITSTRING|BYTE|CHAR|WORD|DWORD|LWORD|SINT|INT|DINT|LINT|USINT|UINT|UDINT|ULINT|REAL|LREAL|STRING|WSTRING|"
    "dataTypeIDRef|variableRef+ conditionalSupport* denotation? actualValue? defaultValue? substituteValue? "
    "allowedValues? unit? property*";
constexpr std::string_view parameter_attributes =
    "uniqueID! access accessList support persistent:boolean offset multiplier templateIDRef";

constexpr Row rows[] = {
    {"ISO15745ProfileContainer", true, "ISO15745Profile+", ""},
    {"ISO15745Profile", true, "ProfileHeader ProfileBody", ""},
    {"ProfileHeader", false,
     "ProfileIdentification ProfileRevision ProfileName ProfileSource ProfileClassID ProfileDate? "
     "AdditionalInformation? ISO15745Reference IASInterfaceType*",
     ""},
    {"ISO15745Reference", false, "ISO15745Part ISO15745Edition ProfileTechnology", ""},
    {"ProfileBody", false,
     "DeviceIdentity? DeviceManager? DeviceFunction+ ApplicationProcess* ExternalProfileHandle*",
     file_attributes},
    {"ProfileBody/network", false, "ApplicationLayers TransportLayers NetworkManagement?", file_attributes},
    {"DeviceIdentity", true,
     "vendorName vendorID? vendorText? deviceFamily? productFamily? productName productID? productText? "
     "orderNumber* version* buildDate? specificationRevision? instanceName?",
     ""},
    {"DeviceManager", true, "indicatorList? moduleManagement?", ""},
    {"DeviceFunction", true, "capabilities picturesList? dictionaryList?", ""},
    {"capabilities", true, "characteristicsList+ standardComplianceList?", ""},
    {"ApplicationProcess", true,
     "dataTypeList? functionTypeList? functionInstanceList? templateList? parameterList parameterGroupList?",
     ""},
    {"parameterList", true, "parameter+", ""},
    {"parameter", true, parameter_children, parameter_attributes},
    {"actualValue", true, "...", value_attributes},
    {"defaultValue", true, "...", value_attributes},
    {"allowedValues", true, "value* range*", "templateIDRef"},
    {"range", true, "minValue maxValue step?", ""},
    {"minValue", false, "...", value_attributes},
    {"maxValue", false, "...", value_attributes},
    {"ApplicationLayers", false, "identity? CANopenObjectList dummyUsage? dynamicChannels? moduleManagement?",
     "conformanceClass communicationEntityType"},
    {"CANopenObjectList", true, "CANopenObject+",
     "mandatoryObjects:number optionalObjects:number manufacturerObjects:number"},
    {"CANopenObject", false, "CANopenSubObject*", "index! subNumber:byte "},
    {"CANopenSubObject", false, "", "subIndex! "},
    {"dummyUsage", false, "dummy+", ""},
    {"dummy", false, "", "entry!:dummy"},
    {"TransportLayers", false, "PhysicalLayer", ""},
    {"PhysicalLayer", false, "baudRate", ""},
    {"baudRate", false, "supportedBaudRate+", "defaultValue:bit_rate"},
    {"supportedBaudRate", false, "", "value!:bit_rate"},
    {"NetworkManagement", false, "CANopenGeneralFeatures CANopenMasterFeatures? deviceCommissioning?", ""},
    {"CANopenGeneralFeatures", false, "",
     "groupMessaging:boolean dynamicChannels:byte selfStartingDevice:boolean SDORequestingDevice:boolean "
     "granularity!:byte nrOfRxPDO:word nrOfTxPDO:word bootUpSlave:boolean layerSettingServiceSlave:boolean"},
    {"CANopenMasterFeatures", false, "",
     "bootUpMaster:boolean flyingMaster:boolean SDOManager:boolean configurationManager:boolean "
     "layerSettingServiceMaster:boolean"},
    {"deviceCommissioning", false, "",
     "nodeID!:byte nodeName! actualBaudRate! networkNumber!:number networkName! CANopenManager!:boolean"},
};

struct FormName {
  std::string_view name;
  XddForm form;
  std::string_view words;
};
constexpr FormName forms[] = {
    {"text", XddForm::text, "text"},
    {"boolean", XddForm::boolean, "true or false"},
    {"byte", XddForm::byte, "a decimal number up to 255"},
    {"word", XddForm::word, "a decimal number up to 65535"},
    {"number", XddForm::number, "a decimal number"},
    {"hex", XddForm::hex, "an even number of hexadecimal digits without 0x"},
    {"date", XddForm::date, "a date yyyy-mm-dd"},
    {"time", XddForm::time, "a time hh:mm:ss"},
    {"bit_rate", XddForm::bit_rate, "a bit rate of CiA 311, such as '250 Kbps'"},
    {"dummy", XddForm::dummy, "Dummy0001 to Dummy0007, =0 or =1"},
    {"access", XddForm::access, "ro, wo, rw or const; a direction is said by PDOmapping, or by a parameter"},
};

XddChild child_of(std::string_view word) {
  XddChild out;
  if (word.ends_with('?') || word.ends_with('*')) out.required = false;
  if (word.ends_with('*') || word.ends_with('+')) out.repeated = true;
  if (!out.required || out.repeated) word.remove_suffix(1);
  out.names = split(word, '|');
  return out;
}

XddAttribute attribute_of(std::string_view word) {
  XddAttribute out;
  const auto colon = word.find(':');
  if (colon != std::string_view::npos) {
    out.form = std::ranges::find(forms, word.substr(colon + 1), &FormName::name)->form;
    word = word.substr(0, colon);
  }
  out.required = word.ends_with('!');
  if (out.required) word.remove_suffix(1);
  out.name = word;
  return out;
}

void add_attributes(XddElement& element, std::string_view words) {
  for (const auto word : split(words, ' ')) {
    if (!word.empty()) element.attributes.push_back(attribute_of(word));
  }
}

std::map<std::string_view, XddElement> read_rows() {
  std::map<std::string_view, XddElement> out;
  for (const auto& row : rows) {
    XddElement element{row.name, row.global, row.children != "...", {}, {}};
    for (const auto word : split(row.children, ' ')) {
      if (!word.empty() && element.closed) element.children.push_back(child_of(word));
    }
    add_attributes(element, row.attributes);
    if (row.name == "CANopenObject" || row.name == "CANopenSubObject")
      add_attributes(element, entry_attributes);
    out.emplace(row.name, std::move(element));
  }
  return out;
}

}  // namespace

std::string_view to_string(XddForm form) { return std::ranges::find(forms, form, &FormName::form)->words; }

const XddElement* find_xdd_element(std::string_view name) {
  static const auto elements = read_rows();
  const auto found = elements.find(name);
  return found == elements.end() ? nullptr : &found->second;
}

}  // namespace conform::eds
