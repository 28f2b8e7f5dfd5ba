// SPDX-License-Identifier: Apache-2.0
#include "eds/xdd_structure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "eds/dialect.hpp"
#include "eds/file_date.hpp"
#include "eds/xdd_grammar.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view name_space_1_1 = "http://www.canopen.org/xml/1.1";
constexpr std::string_view name_space_1_0 = "http://www.canopen.org/xml/1.0";

bool is_decimal(std::string_view text, std::uint64_t most) {
  std::uint64_t value = 0;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value <= most;
}

bool is_bit_rate(std::string_view text) {
  if (text == "auto-baudRate") return true;
  constexpr std::string_view unit = " Kbps";
  if (!text.ends_with(unit)) return false;
  text.remove_suffix(unit.size());
  std::uint64_t rate = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), rate);
  return error == std::errc() && end == text.data() + text.size() && is_xml_bit_rate(rate);
}

bool is_dummy(std::string_view text) {
  return text.size() == 11 && text.starts_with("Dummy000") && text[8] >= '1' && text[8] <= '7' &&
         text[9] == '=' && (text[10] == '0' || text[10] == '1');
}

bool has_form(std::string_view text, XddForm form) {
  switch (form) {
    case XddForm::text: return true;
    case XddForm::boolean: return text == "true" || text == "false" || text == "1" || text == "0";
    case XddForm::byte: return is_decimal(text, 0xFF);
    case XddForm::word: return is_decimal(text, 0xFFFF);
    case XddForm::number: return is_decimal(text, UINT64_MAX);
    case XddForm::hex:
      return text.size() % 2 == 0 &&
             text.find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos;
    case XddForm::date: return text.size() >= 10 && text[4] == '-' && file_date(text).has_value();
    case XddForm::time: return text.size() >= 8 && text[5] == ':' && file_time(text).has_value();
    case XddForm::bit_rate: return is_bit_rate(text);
    case XddForm::dummy: return is_dummy(text);
    case XddForm::access: return text != "rwr" && text != "rww";
  }
  return true;
}

/// The namespace that the declarations around an element give it; empty: none.
std::string_view name_space(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const auto colon = name.find(':');
  const auto declaration =
      colon == std::string_view::npos ? std::string("xmlns") : "xmlns:" + std::string(name.substr(0, colon));
  for (auto each = node; each; each = each.parent()) {
    if (const auto found = each.attribute(declaration.c_str())) return found.value();
  }
  return {};
}

/// Declarations and what XML Schema itself reads are no attributes of the element.
bool is_of_xml(std::string_view attribute) {
  return attribute.starts_with("xmlns") || attribute.starts_with("xsi:") || attribute.starts_with("xml:");
}

class Checker {
 public:
  Checker(const XmlText& text, Remarks& remarks, bool known_version)
      : text_(text), remarks_(remarks), known_version_(known_version) {}

  void check(const pugi::xml_node& node, const XddElement& element) {
    attributes(node, element);
    if (known_version_) {
      qualified(node, element);
      if (element.closed) children(node, element);
    }
    for (const auto& each : node.children()) {
      if (const auto* inner = each.type() == pugi::node_element ? element_of(each) : nullptr)
        check(each, *inner);
    }
  }

 private:
  static const XddElement* element_of(const pugi::xml_node& node) {
    const auto name = local_name(node);
    const bool network =
        name == "ProfileBody" && (child(node, "ApplicationLayers") || child(node, "TransportLayers"));
    // A body may be data of another format elsewhere: then there is nothing of ours in it.
    const bool elsewhere =
        name == "ProfileBody" && !child(node, "DeviceFunction") && child(node, "ExternalProfileHandle");
    return elsewhere ? nullptr : find_xdd_element(network ? "ProfileBody/network" : name);
  }

  void attributes(const pugi::xml_node& node, const XddElement& element) {
    const auto name = local_name(node);
    // The place of an attribute is looked for when there is something to tell of it: a dictionary has
    // thousands.
    for (const auto& row : element.attributes) {
      const std::string attribute(row.name);
      const auto given = node.attribute(attribute.c_str());
      if (!given) {
        if (row.required && known_version_)
          remarks_.add(Deviation::xml_missing_attribute, text_.position(node),
                       fmt::format("{} of <{}>", row.name, name));
      } else if (const auto value = trim(given.value()); !has_form(value, row.form)) {
        remarks_.add(Deviation::xml_bad_value, text_.attribute(node, attribute.c_str()).at,
                     fmt::format("{}=\"{}\" is not {}", row.name, shortened(value, 20), to_string(row.form)),
                     {}, 200);
      }
    }
    if (!known_version_) return;
    for (const auto& attribute : node.attributes()) {
      const std::string_view given = attribute.name();
      if (is_of_xml(given) || given == "readOnly" || given == "lang") continue;
      if (std::ranges::find(element.attributes, given, &XddAttribute::name) == element.attributes.end())
        remarks_.add(Deviation::xml_unknown_attribute, text_.attribute(node, attribute.name()).key_at,
                     fmt::format("{} of <{}>", shortened(given, 30), name));
    }
  }

  void children(const pugi::xml_node& node, const XddElement& element) {
    const auto name = local_name(node);
    std::vector<std::size_t> counts(element.children.size());
    std::size_t place = 0;
    for (const auto& each : node.children()) {
      if (each.type() != pugi::node_element) continue;
      const auto given = local_name(each);
      const auto found = std::ranges::find_if(element.children, [given](const XddChild& child) {
        return std::ranges::find(child.names, given) != child.names.end();
      });
      if (found == element.children.end()) {
        remarks_.add(Deviation::xml_unknown_element, text_.position(each),
                     fmt::format("<{}> in <{}>", shortened(given, 30), name));
        continue;
      }
      const auto at = static_cast<std::size_t>(found - element.children.begin());
      if (at < place || (counts[at] > 0 && !found->repeated))
        remarks_.add(Deviation::xml_order, text_.position(each), fmt::format("<{}> in <{}>", given, name));
      place = std::max(place, at);
      ++counts[at];
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const auto& child = element.children[i];
      if (child.required && counts[i] == 0)
        remarks_.add(Deviation::xml_missing_element, text_.position(node),
                     fmt::format("<{}> in <{}>", child.names.front(), name));
    }
  }

  /// Of each kind of element the first is looked at, and told is one: where it is wrong, it is wrong
  /// everywhere.
  void qualified(const pugi::xml_node& node, const XddElement& element) {
    if (told_ || !seen_.insert(&element).second) return;
    const auto wanted = element.global ? name_space_1_1 : std::string_view();
    if (name_space(node) == wanted) return;
    told_ = true;
    remarks_.add(Deviation::xml_qualified, text_.position(node),
                 fmt::format("<{}> {}", local_name(node),
                             element.global ? "is not in the namespace of CiA 311"
                                            : "is in a namespace; only global elements are"),
                 {}, 200);
  }

  const XmlText& text_;
  Remarks& remarks_;
  bool known_version_;
  bool told_ = false;
  std::set<const XddElement*> seen_;
};

}  // namespace

void check_xdd_structure(const pugi::xml_node& root, const XmlText& text, Remarks& remarks) {
  const auto own = name_space(root);
  if (own != name_space_1_1 && own != name_space_1_0)
    remarks.add(Deviation::xml_namespace, text.position(root), own.empty() ? "none" : own);
  if (const auto* container = find_xdd_element("ISO15745ProfileContainer"))
    Checker(text, remarks, own == name_space_1_1).check(root, *container);
}

}  // namespace conform::eds
