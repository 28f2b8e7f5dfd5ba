// SPDX-License-Identifier: Apache-2.0
#include "steps/condition.hpp"

#include <algorithm>
#include <functional>
#include <iterator>

#include "base/text.hpp"
#include "device/profile.hpp"
#include "steps/condition_tree.hpp"
#include "steps/expression_tree.hpp"
#include "steps/tokens.hpp"

namespace conform::steps {

namespace {

using Tree = Condition::Tree;
using TreePtr = std::shared_ptr<const Tree>;
using Kind = Tree::Kind;

Result<TreePtr> parse_any(TokenReader& in);

TreePtr negate(TreePtr inner) {
  auto node = std::make_shared<Tree>();
  node->kind = Kind::negation;
  node->parts.push_back(std::move(inner));
  return node;
}

/// "is present", "is not writable", "is rw", "has limits", "may change by itself" behind an object; null when
/// it is no such phrase.
Result<TreePtr> parse_object_phrase(TokenReader& in, ObjectReference object, bool whole) {
  auto node = std::make_shared<Tree>();
  node->object = std::move(object);
  node->whole_object = whole;
  if (in.peek() == "may" && in.peek(1) == "change") {
    in.take();
    in.take();
    if (in.accept("by") && !in.accept("itself")) return fail("'itself' is missing after 'may change by'");
    node->kind = Kind::changes;
    return node;
  }
  struct Said {
    std::vector<std::string_view> words;
    std::vector<Declared> what;
  };
  static const std::vector<Said> of_description = {
      {{"has", "a", "default"}, {Declared::default_value}},
      {{"has", "a", "low", "limit"}, {Declared::low_limit}},
      {{"has", "a", "high", "limit"}, {Declared::high_limit}},
      {{"has", "limits"}, {Declared::low_limit, Declared::high_limit}},
  };
  for (const auto& said : of_description) {
    std::size_t same = 0;
    while (same < said.words.size() && in.peek(same) == said.words[same]) ++same;
    if (same != said.words.size()) continue;
    for (; same > 0; --same) in.take();
    node->kind = Kind::described_by;
    node->declared = said.what;
    return node;
  }
  if (in.peek() == "has" && in.peek(1) == "a" && in.peek(2) == "variable" && in.peek(3) == "mapping") {
    for (int i = 0; i < 4; ++i) in.take();
    node->kind = Kind::remaps;
    return node;
  }
  if (in.peek() != "is" && in.peek() != "are") return TreePtr();
  const auto at = in.position();
  in.take();
  const bool negative = in.accept("not");
  const std::string word(in.peek());
  if (word == "present" || word == "absent" || word == "claimed" || word == "readable" ||
      word == "writable") {
    in.take();
    node->kind = word == "claimed"    ? Kind::claimed
                 : word == "readable" ? Kind::readable
                 : word == "writable" ? Kind::writable
                                      : Kind::present;
    TreePtr out = node;
    return negative != (word == "absent") ? negate(out) : out;
  }
  // "is an allowed placeholder", "is a forbidden placeholder"
  if ((word == "a" || word == "an") && in.peek(2) == "placeholder" &&
      (in.peek(1) == "allowed" || in.peek(1) == "forbidden")) {
    in.take();
    node->kind = in.take() == "allowed" ? Kind::placeholder : Kind::no_placeholder;
    in.take();
    TreePtr out = node;
    return negative ? negate(out) : out;
  }
  if (word == "an" && in.peek(1) == "integer") {
    in.take();
    in.take();
    node->kind = Kind::integer;
    TreePtr out = node;
    return negative ? negate(out) : out;
  }
  if (word == "ro" || word == "rw" || word == "wo" || word == "const" || word == "rwr" || word == "rww") {
    in.take();
    node->kind = Kind::access;
    node->word = word;
    TreePtr out = node;
    return negative ? negate(out) : out;
  }
  in.rewind(at);
  return TreePtr();
}

Result<TreePtr> parse_comparison(TokenReader& in) {
  auto left = parse_expression_prefix(in, "");
  if (!left) return std::unexpected(left.error());
  auto node = std::make_shared<Tree>();
  node->left = *left;
  bool negative = false;
  if (in.accept("is")) {
    negative = in.accept("not");
    if (in.accept("at")) {
      if (in.accept("least")) {
        node->kind = Kind::at_least;
      } else if (in.accept("most")) {
        node->kind = Kind::at_most;
      } else {
        return fail("'at' must be followed by 'least' or 'most'");
      }
    } else if (in.accept("above")) {
      node->kind = Kind::above;
    } else if (in.accept("below")) {
      node->kind = Kind::below;
    } else {
      node->kind = Kind::equal;
    }
  } else if (in.accept("=")) {
    node->kind = Kind::equal;
  } else if (in.accept(">=")) {
    node->kind = Kind::at_least;
  } else if (in.accept("<=")) {
    node->kind = Kind::at_most;
  } else if (in.accept(">")) {
    node->kind = Kind::above;
  } else if (in.accept("<")) {
    node->kind = Kind::below;
  } else {
    return fail(
        "a comparison is missing: 'is', 'is not', 'is at least', 'is at most', 'is above' or 'is below'");
  }
  auto right = parse_expression_prefix(in, "");
  if (!right) return std::unexpected(right.error());
  node->right = *right;
  TreePtr out = node;
  return negative ? negate(out) : out;
}

Result<TreePtr> parse_atom(TokenReader& in) {
  if (in.accept("not")) {
    auto inner = parse_atom(in);
    if (!inner) return inner;
    return negate(*inner);
  }
  auto node = std::make_shared<Tree>();
  if (in.peek() == "device" && in.peek(1) == "claims") {
    in.take();
    in.take();
    std::string feature;
    while (!in.done() && in.peek() != "and" && in.peek() != "or" && in.peek() != ")") {
      if (!feature.empty()) feature += ' ';
      feature += in.take();
    }
    if (device::is_feature(feature)) {
      node->kind = Kind::feature;
      node->word = feature;
      return node;
    }
    std::vector<std::string_view> known;
    for (const auto& item : device::features()) known.push_back(item.word);
    const auto near = did_you_mean(feature, known);
    return fail("unknown feature '" + feature + "'", {},
                near.empty() ? "" : "did you mean '" + std::string(near) + "'?");
  }
  if (in.peek() == "description" && in.peek(1) == "tells") {
    in.take();
    in.take();
    node->kind = Kind::told;
    for (const std::string_view what : {"rpdos", "tpdos", "lss", "bit rates"}) {
      const bool two_words = what == "bit rates";
      if (two_words ? in.peek() != "bit" || in.peek(1) != "rates" : in.peek() != what) continue;
      in.take();
      if (two_words) in.take();
      node->word = what;
      return node;
    }
    return fail("'description tells' must be followed by rpdos, tpdos, lss or bit rates");
  }
  if (in.peek() == "interface" && in.peek(1) == "can") {
    in.take();
    in.take();
    if (!in.accept("send") || !in.accept("RTR")) return fail("only 'interface can send RTR' is known");
    node->kind = Kind::remote;
    return node;
  }
  if (in.peek() == "factory" && in.peek(1) == "defaults") {
    in.take();
    in.take();
    if (!in.accept("are") || !in.accept("active")) return fail("'are active' is missing");
    node->kind = Kind::factory;
    return node;
  }
  constexpr std::size_t longest = 7;
  struct Phrase {
    std::string_view words[longest];
    Kind kind;
  };
  static constexpr Phrase phrases[] = {{{"device", "description", "is", "given"}, Kind::described},
                                       {{"the", "write", "was", "refused"}, Kind::refused},
                                       {{"store", "fault", "is", "known"}, Kind::store_fault},
                                       {{"power", "switch", "is", "known"}, Kind::power_switch},
                                       {{"bus", "bit", "rate", "is", "known"}, Kind::bus_rate},
                                       {{"bus", "bit", "rate", "is", "described"}, Kind::bus_rate_told},
                                       {{"block", "upload", "is", "offered"}, Kind::block_upload},
                                       {{"block", "download", "is", "offered"}, Kind::block_download},
                                       {{"all", "objects", "are", "tried"}, Kind::sweep},
                                       {{"nobody", "else", "is", "heard", "on", "the", "bus"}, Kind::alone}};
  for (const auto& phrase : phrases) {
    const auto words = static_cast<std::size_t>(std::ranges::find(phrase.words, std::string_view()) -
                                                std::begin(phrase.words));
    std::size_t same = 0;
    while (same < words && in.peek(same) == phrase.words[same]) ++same;
    if (same != words) continue;
    for (std::size_t i = 0; i < words; ++i) in.take();
    node->kind = phrase.kind;
    return node;
  }
  // "error trigger is known", "2 error triggers are known", "$number error triggers are known"
  {
    const auto at = in.position();
    std::uint64_t count = 1;
    if (const auto number = parse_number(in.peek()); number && in.peek(1) == "error") {
      count = *number;
      in.take();
    } else if (in.peek().starts_with('$') && in.peek(1) == "error") {
      auto given = parse_expression_prefix(in, "");
      if (!given) return std::unexpected(given.error());
      node->left = *given;
    } else if (in.peek() == "an") {
      in.take();
    }
    if (in.accept("error") && (in.accept("trigger") || in.accept("triggers"))) {
      if (!in.accept("is") && !in.accept("are")) return fail("'is known' or 'are known' is missing");
      if (!in.accept("known")) return fail("'known' is missing");
      node->kind = Kind::triggers;
      node->count = count;
      return node;
    }
    in.rewind(at);
  }
  if (in.accept("(")) {
    const auto at = in.position();
    auto inner = parse_any(in);
    if (inner && in.accept(")")) return inner;
    // "(1003h:00 & 1) is 0": the parenthesis belongs to an expression.
    in.rewind(at - 1);
    auto comparison = parse_comparison(in);
    if (comparison) return comparison;
    return inner ? fail("')' is missing") : inner;
  }
  const auto at = in.position();
  const bool said_object = in.accept("object");
  if (in.peek() != "value" && in.peek() != "bit" && !in.done()) {
    const std::string word(in.take());
    if (auto object = ObjectReference::parse(word)) {
      const bool whole = word.find(':') == std::string::npos && !word.starts_with('$');
      auto phrase = parse_object_phrase(in, *object, whole);
      if (!phrase) return phrase;
      if (*phrase) return phrase;
    }
    in.rewind(at);
    if (said_object) {
      for (int i = 0; i < 2; ++i) in.take();
      if (in.accept("is") || in.accept("are")) (void)in.accept("not");
      static constexpr std::string_view properties[] = {"present",  "absent",   "claimed",
                                                        "readable", "writable", "const"};
      const std::string property(in.peek());
      if (const auto near = did_you_mean(property, properties); !near.empty()) {
        return fail("unknown property '" + property + "'", {}, "did you mean '" + std::string(near) + "'?");
      }
    }
    if (said_object)
      return fail("'object' must be followed by an object and 'is present', 'is writable', ...");
  }
  return parse_comparison(in);
}

Result<TreePtr> parse_chain(TokenReader& in, std::string_view word, Kind kind,
                            const std::function<Result<TreePtr>(TokenReader&)>& part) {
  auto first = part(in);
  if (!first) return first;
  if (in.peek() != word) return first;
  auto node = std::make_shared<Tree>();
  node->kind = kind;
  node->parts.push_back(*first);
  while (in.accept(word)) {
    auto next = part(in);
    if (!next) return next;
    node->parts.push_back(*next);
  }
  return node;
}

Result<TreePtr> parse_any(TokenReader& in) {
  return parse_chain(in, "or", Kind::any,
                     [](TokenReader& inner) { return parse_chain(inner, "and", Kind::all, parse_atom); });
}

Result<bool> evaluate_comparison(const Tree& node, Facts& facts) {
  auto left = node.left.evaluate(facts);
  if (!left) return std::unexpected(left.error());
  auto right = node.right.evaluate(facts);
  if (!right) return std::unexpected(right.error());
  if (node.kind == Kind::equal) return left->same_as(*right);
  if (!left->number || !right->number) {
    return fail("'" + left->text() + "' and '" + right->text() + "' cannot be compared as numbers");
  }
  switch (node.kind) {
    case Kind::at_least: return *left->number >= *right->number;
    case Kind::at_most: return *left->number <= *right->number;
    case Kind::above: return *left->number > *right->number;
    default: return *left->number < *right->number;
  }
}

}  // namespace

Result<bool> evaluate_tree(const Condition::Tree& node, Facts& facts) {
  if (node.kind == Kind::all || node.kind == Kind::any) {
    for (const auto& part : node.parts) {
      auto value = evaluate_tree(*part, facts);
      if (!value || *value == (node.kind == Kind::any)) return value;
    }
    return node.kind == Kind::all;
  }
  if (node.kind == Kind::negation) {
    auto value = evaluate_tree(*node.parts.front(), facts);
    if (value) *value = !*value;
    return value;
  }
  if (node.kind == Kind::feature) return facts.claims(node.word);
  if (node.kind == Kind::triggers) {
    const auto known = facts.error_triggers();
    if (!known) return std::unexpected(known.error());
    if (node.left.empty()) return known->size() >= node.count;
    const auto wanted = node.left.number(facts);
    return wanted ? Result<bool>(known->size() >= *wanted) : std::unexpected(wanted.error());
  }
  if (node.kind == Kind::remote) return facts.can_send_remote_frames();
  if (node.kind == Kind::described) return facts.is_described();
  if (node.kind == Kind::refused) return facts.write_was_refused();
  if (node.kind == Kind::store_fault) return facts.store_fault_known();
  if (node.kind == Kind::power_switch) return facts.power_switch_known();
  if (node.kind == Kind::told) return facts.is_told(node.word);
  if (node.kind == Kind::bus_rate) return facts.bus_bit_rate().has_value();
  if (node.kind == Kind::bus_rate_told) return facts.bus_bit_rate_is_told();
  if (node.kind == Kind::block_upload) return facts.offers_block_transfer(true);
  if (node.kind == Kind::block_download) return facts.offers_block_transfer(false);
  if (node.kind == Kind::sweep) return facts.tries_all_objects();
  if (node.kind == Kind::alone) {
    const auto heard = facts.others_heard();
    if (!heard) return std::unexpected(heard.error());
    return heard->empty();
  }
  if (node.kind == Kind::factory) return facts.factory_defaults();
  if (node.kind >= Kind::equal) return evaluate_comparison(node, facts);
  const auto object = node.object.resolve(facts);
  if (!object) return std::unexpected(object.error());
  switch (node.kind) {
    case Kind::present: return facts.is_present(*object, node.whole_object);
    case Kind::claimed: return facts.is_claimed(*object, node.whole_object);
    case Kind::readable: return facts.is_readable(*object);
    case Kind::writable: return facts.is_writable(*object);
    case Kind::described_by:
      return std::ranges::all_of(node.declared,
                                 [&](Declared what) { return facts.declared(*object, what).has_value(); });
    case Kind::integer: return facts.is_integer(*object);
    case Kind::access: return facts.access_of(*object) == node.word;
    case Kind::placeholder: return facts.is_placeholder(object->index) == std::optional(true);
    case Kind::no_placeholder: return facts.is_placeholder(object->index) == std::optional(false);
    case Kind::remaps: return facts.has_variable_mapping(*object);
    default: return facts.may_change(*object);
  }
}

namespace {

void collect_objects(const Tree& node, std::vector<ObjectReference>& out) {
  if (node.object.empty()) {
    for (const auto& part : node.parts) collect_objects(*part, out);
  } else {
    out.push_back(node.object);
  }
}

void collect_names(const Tree& node, std::vector<std::string>& out) {
  for (const auto& names : {node.object.names(), node.left.names(), node.right.names()}) {
    out.insert(out.end(), names.begin(), names.end());
  }
  for (const auto& part : node.parts) collect_names(*part, out);
}

bool tree_may_write(const Tree& node) {
  if (node.kind == Kind::writable || node.kind == Kind::block_download || node.kind == Kind::remaps)
    return true;
  for (const auto& part : node.parts) {
    if (tree_may_write(*part)) return true;
  }
  return false;
}

}  // namespace

Result<Condition> Condition::parse(std::string_view text) {
  auto tokens = tokenize(text);
  if (!tokens) return std::unexpected(tokens.error());
  TokenReader in(std::move(*tokens));
  auto tree = parse_any(in);
  if (!tree) return std::unexpected(tree.error());
  if (!in.done())
    return fail("'" + std::string(in.peek()) + "' is not expected here", {},
                "join conditions with 'and' or 'or'");
  Condition out;
  out.text_ = trim(text);
  out.tree_ = *tree;
  return out;
}

Result<bool> Condition::evaluate(Facts& facts) const {
  if (!tree_) return true;
  return evaluate_tree(*tree_, facts);
}

std::vector<std::string> Condition::names() const {
  std::vector<std::string> out;
  if (tree_) collect_names(*tree_, out);
  return out;
}

std::vector<ObjectReference> Condition::objects() const {
  std::vector<ObjectReference> out;
  if (tree_) collect_objects(*tree_, out);
  return out;
}

bool Condition::may_write() const { return tree_ && tree_may_write(*tree_); }

std::vector<std::string_view> condition_forms() {
  return {"1003h is present",
          "1010h:01 is absent",
          "1014h is claimed",
          "1014h:00 is writable",
          "1017h:00 is readable",
          "1017h:00 is const",
          "$object may change by itself",
          "$type is an allowed placeholder",
          "$type is a forbidden placeholder",
          "1017h:00 is an integer",
          "1018h:03 has a default",
          "$object has a low limit",
          "$object has a high limit",
          "$object has limits",
          "1A00h:00 has a variable mapping",
          "value of 1003h:00 is not 0",
          "value of 1018h:00 is at least 2",
          "bit 30 of 1005h:00 is 1",
          "$count is above 3",
          "device claims sync producer",
          "error trigger is known",
          "2 error triggers are known",
          "store fault is known",
          "power switch is known",
          "description tells rpdos",
          "description tells bit rates",
          "bus bit rate is known",
          "bus bit rate is described",
          "factory defaults are active",
          "interface can send RTR",
          "device description is given",
          "the write was refused",
          "block upload is offered",
          "block download is offered",
          "nobody else is heard on the bus",
          "all objects are tried",
          "A and B, A or B, not A, (A)"};
}

}  // namespace conform::steps
