// SPDX-License-Identifier: Apache-2.0
// Why a condition holds or does not, in words that need no look into the scenario.
#include <algorithm>

#include "base/text.hpp"
#include "steps/condition_tree.hpp"
#include "steps/expression_tree.hpp"

namespace conform::steps {
namespace {

using Tree = Condition::Tree;
using Kind = Tree::Kind;
using Parts = std::vector<std::shared_ptr<const Tree>>;
using result::Want;

Why explain(const Tree& node, Facts& facts, bool held);

/// Small numbers as people write them, others as the value's own notation has it.
std::string value_words(const Value& value) {
  const bool counts = value.number && *value.number < 10 && !value.duration && !value.word &&
                      (!value.bytes || value.bytes->size() == 1);
  return counts ? std::to_string(*value.number) : value.text();
}

std::string object_words(const ObjectReference& object, bool whole, Facts& facts) {
  const auto resolved = object.resolve(facts);
  if (!resolved) return object.text();
  return whole ? to_string(resolved->index) : to_string(*resolved);
}

/// An expression with the values of its names; a name that stands alone is told by its value behind it.
std::string expression_words(const std::shared_ptr<const Expression::Tree>& node, Facts& facts, bool alone) {
  using Node = Expression::Tree::Kind;
  if (!node) return {};
  switch (node->kind) {
    case Node::number: return value_words(Value::of_number(node->number));
    case Node::node_id: return alone ? "the node-ID" : "N";
    case Node::current: return "the current value";
    case Node::name: {
      const auto* value = facts.find(node->name);
      return alone || value == nullptr ? node->name : value_words(*value);
    }
    case Node::value_of: return "the value of " + object_words(node->object, false, facts);
    case Node::bit_of:
      return "bit " + std::to_string(node->number) + " of " + object_words(node->object, false, facts);
    case Node::declared: {
      const char* what = node->declared == Declared::low_limit     ? "the low limit of "
                         : node->declared == Declared::high_limit  ? "the high limit of "
                         : node->declared == Declared::wired_input ? "the input of "
                                                                   : "the default of ";
      return what + object_words(node->object, false, facts);
    }
    case Node::complement: return "~" + expression_words(node->left, facts, false);
    default: break;
  }
  const char* sign = node->kind == Node::add        ? " + "
                     : node->kind == Node::subtract ? " - "
                     : node->kind == Node::bit_or   ? " | "
                     : node->kind == Node::bit_and  ? " & "
                                                    : " ^ ";
  return expression_words(node->left, facts, false) + sign + expression_words(node->right, facts, false);
}

/// The whole value behind a bit.
std::string whole_value(const Expression& expression, Facts& facts) {
  const auto& node = expression.tree();
  if (!node || node->kind != Expression::Tree::Kind::bit_of) return {};
  const auto object = node->object.resolve(facts);
  if (!object) return {};
  const auto value = facts.read(*object);
  if (!value || !value->bytes || !value->number) return {};
  auto digits = hex(*value->number, static_cast<int>(value->bytes->size()) * 2);
  if (digits.size() == 9) digits.insert(4, " ");
  return " (" + digits + ")";
}

Why comparison(const Tree& node, Facts& facts, bool held) {
  Why out;
  out.text = expression_words(node.left.tree(), facts, true);
  const auto left = node.left.evaluate(facts);
  const auto right = node.right.evaluate(facts);
  out.text += " is " + (left ? value_words(*left) : "not known") + whole_value(node.left, facts);
  const auto limit = right ? value_words(*right) : node.right.text();
  const bool negated = !held;
  switch (node.kind) {
    case Kind::equal:
      if (negated) out.text += ", not " + limit;
      break;
    case Kind::at_least: out.text += negated ? ", not " + limit + " or more" : ", at least " + limit; break;
    case Kind::at_most: out.text += negated ? ", not " + limit + " or less" : ", at most " + limit; break;
    case Kind::above: out.text += negated ? ", not above " + limit : ", above " + limit; break;
    default: out.text += negated ? ", not below " + limit : ", below " + limit; break;
  }
  return out;
}

/// "1014h:00 is not writable: const, pump.eds:120"
Why about_entry(const Tree& node, Facts& facts, bool held) {
  Why out;
  const auto object = node.object.resolve(facts);
  out.text = object_words(node.object, node.whole_object, facts);
  const auto says = [&](std::string_view yes, std::string_view no) {
    out.text += " ";
    out.text += held ? yes : no;
  };
  const auto with_grounds = [&](Asked asked) {
    if (!object || held) return;
    if (const auto grounds = facts.grounds(asked, *object); !grounds.empty()) out.text += ": " + grounds;
  };
  switch (node.kind) {
    case Kind::present:
      says("is present", "is absent");
      with_grounds(Asked::presence);
      break;
    case Kind::claimed: says("is claimed", "is claimed neither by the profile nor by the description"); break;
    case Kind::readable:
      says("is readable", "is not readable");
      with_grounds(Asked::reading);
      break;
    case Kind::writable:
      says("is writable", "is not writable");
      with_grounds(Asked::writing);
      break;
    case Kind::access: {
      const auto access = object ? facts.access_of(*object) : std::string();
      out.text += " is " + (access.empty() ? "of unknown access" : access);
      if (!held) out.text += ", not " + node.word;
      break;
    }
    case Kind::integer: says("is an integer", "is no integer"); break;
    case Kind::described_by: {
      const auto what = node.declared.size() > 1                        ? "limits"
                        : node.declared.front() == Declared::low_limit  ? "low limit"
                        : node.declared.front() == Declared::high_limit ? "high limit"
                                                                        : "default";
      const char* one = node.declared.size() > 1 ? "has " : "has a ";
      says(std::string(one) + what, std::string("has no ") + what + " in the description");
      break;
    }
    case Kind::placeholder:
      says("is an allowed placeholder", "is no placeholder by the word of profile or description");
      break;
    case Kind::no_placeholder:
      says("is a forbidden placeholder", "is not forbidden as placeholder by profile or description");
      break;
    case Kind::remaps:
      says("has a variable mapping", "has no mapping that can be changed");
      with_grounds(Asked::mapping);
      if (!held && object && !facts.claims("variable mapping"))
        out.wants = {{"claim", "the claim 'variable mapping', if the device has it"}};
      break;
    default: says("may change by itself", "does not change by itself"); break;
  }
  return out;
}

/// What the device itself, the profile or the bench say.
Why about_bench(const Tree& node, Facts& facts, bool held) {
  const auto told = [held](std::string yes, std::string no, std::vector<Want> wants = {}) {
    return held ? Why{std::move(yes), {}} : Why{std::move(no), std::move(wants)};
  };
  const auto behind = [&facts](Asked asked) {
    const auto grounds = facts.grounds(asked, Multiplexer{});
    return grounds.empty() ? std::string() : ": " + grounds;
  };
  switch (node.kind) {
    case Kind::feature:
      return told("the device claims '" + node.word + "'", "the device does not claim '" + node.word + "'",
                  {{"claim", "the claim '" + node.word +
                                 (node.word == "only node on the bus" ? "', if it is so"
                                                                      : "', if the device has it")}});
    case Kind::triggers: {
      // They were just counted for the condition itself.
      const auto usable = facts.error_triggers();
      const auto known = usable ? usable->size() : 0;
      const auto words = [](std::size_t count) {
        return count == 0   ? std::string("no error trigger is known")
               : count == 1 ? std::string("only one error trigger is known")
                            : std::to_string(count) + " error triggers are known";
      };
      return told(known == 1 ? "an error trigger is known" : words(known),
                  words(known) + (node.count > 1 ? ", not " + std::to_string(node.count) : ""),
                  {{"profile", node.count > 1 ? "errors: " + std::to_string(node.count) +
                                                    " ways to raise an error, in the profile"
                                              : "errors: a way to raise an error, in the profile"}});
    }
    case Kind::remote:
      return told("the interface can send RTR", "the interface cannot send RTR",
                  {{"bench", "an interface that can send remote frames"}});
    case Kind::factory: {
      // Where the run itself is the reason nothing can be given.
      if (const auto grounds = facts.grounds(Asked::values_put_back, {}); !grounds.empty())
        return told("factory defaults are active", grounds);
      const auto grounds = facts.grounds(Asked::factory_defaults, {});
      return told("factory defaults are active",
                  "nobody says that factory defaults are active" + (grounds.empty() ? "" : ": " + grounds),
                  {{"profile", "factory_defaults: true in the profile, if nothing is stored in the device"}});
    }
    case Kind::described:
      return told("a device description is given", "no device description is given",
                  {{"description", "the EDS of the device (--eds)"}});
    case Kind::refused: return told("the write was refused", "the write was not refused");
    case Kind::store_fault:
      return told("a store fault is known", "no way to make storing fail is known",
                  {{"profile", "store_fault: in the profile, if the device can simulate one"}});
    case Kind::power_switch:
      return told("the power of the device can be switched",
                  "no way to switch the power of the device is known",
                  {{"profile", "power_cycle: a command that switches the power of the device off and on, in "
                               "the profile"}});
    case Kind::told: {
      const auto missing = node.word == "lss"         ? std::string("whether there is LSS")
                           : node.word == "bit rates" ? std::string("which bit rates there are")
                           : node.word == "rpdos"     ? std::string("how many RPDOs there are")
                                                      : std::string("how many TPDOs there are");
      return told("the description tells " + missing, "no description tells " + missing,
                  {{"description", "the EDS of the device (--eds), or device_info: in the profile"}});
    }
    case Kind::bus_rate:
      return told("the bit rate of the bus is known", "the interface does not tell its bit rate");
    case Kind::bus_rate_told:
      return told("the description has the bit rate of the bus",
                  "the description does not have the bit rate of the bus");
    case Kind::block_upload:
      return told("block upload is offered", "block upload is not offered" + behind(Asked::block_upload));
    case Kind::block_download:
      return told("block download is offered",
                  "block download is not offered" + behind(Asked::block_download));
    case Kind::alone: {
      const auto heard = facts.others_heard();
      return told("nobody else is heard on the bus",
                  "somebody else is on the bus: " + (heard ? *heard : heard.error().what));
    }
    default: return told("all objects are tried", "not all objects are tried", {{"option", "--all-objects"}});
  }
}

/// Whether the answer costs nothing and can be asked at any time.
bool is_free(const Tree& node) {
  if (node.kind == Kind::all || node.kind == Kind::any || node.kind == Kind::negation)
    return std::ranges::all_of(node.parts, [](const auto& part) { return is_free(*part); });
  return node.kind == Kind::feature || node.kind == Kind::triggers || node.kind == Kind::remote ||
         node.kind == Kind::factory || node.kind == Kind::described || node.kind == Kind::store_fault ||
         node.kind == Kind::power_switch || node.kind == Kind::told || node.kind == Kind::bus_rate ||
         node.kind == Kind::bus_rate_told || node.kind == Kind::sweep;
}

/// The parts that decided: of 'A and B and C' the first false one, and those behind it that are false as well
/// and need no asking; of 'A or B' the first true one.
Why explain_deciders(const Tree& node, Facts& facts, bool held) {
  std::vector<Why> whys;
  for (const auto& part : node.parts) {
    if (!whys.empty() && (held || !is_free(*part))) continue;
    const auto value = evaluate_tree(*part, facts);
    if (value && *value == held) whys.push_back(explain(*part, facts, held));
  }
  Why out;
  std::vector<std::string> texts;
  bool helpless = false;
  for (auto& why : whys) {
    texts.push_back(why.text);
    helpless = helpless || why.wants.empty();
    out.wants.insert(out.wants.end(), why.wants.begin(), why.wants.end());
  }
  // What can be given helps only where nothing else is in the way.
  if (helpless) out.wants.clear();
  out.text = join(texts, ", and ");
  return out;
}

Why explain_all(const Tree& node, Facts& facts, bool held) {
  Why out;
  std::vector<std::string> texts;
  for (const auto& part : node.parts) {
    auto why = explain(*part, facts, held);
    if (std::ranges::find(texts, why.text) == texts.end()) texts.push_back(std::move(why.text));
    for (auto& want : why.wants) {
      if (std::ranges::find(out.wants, want) == out.wants.end()) out.wants.push_back(std::move(want));
    }
  }
  out.text = join(texts, ", and ");
  return out;
}

Why explain(const Tree& node, Facts& facts, bool held) {
  switch (node.kind) {
    case Kind::all: return held ? explain_all(node, facts, held) : explain_deciders(node, facts, held);
    case Kind::any: return held ? explain_deciders(node, facts, held) : explain_all(node, facts, held);
    case Kind::negation: return explain(*node.parts.front(), facts, !held);
    case Kind::present:
    case Kind::claimed:
    case Kind::readable:
    case Kind::writable:
    case Kind::access:
    case Kind::changes:
    case Kind::integer:
    case Kind::described_by:
    case Kind::placeholder:
    case Kind::no_placeholder:
    case Kind::remaps: return about_entry(node, facts, held);
    case Kind::equal:
    case Kind::at_least:
    case Kind::at_most:
    case Kind::above:
    case Kind::below: return comparison(node, facts, held);
    default: return about_bench(node, facts, held);
  }
}

}  // namespace

Why Condition::why(Facts& facts, bool held) const {
  if (!tree_) return {};
  auto out = explain(*tree_, facts, held);
  if (out.text.empty()) out.text = held ? text_ : "not so: " + text_;
  return out;
}

}  // namespace conform::steps
