// SPDX-License-Identifier: Apache-2.0
#include "steps/expression.hpp"

#include "base/text.hpp"
#include "steps/expression_tree.hpp"
#include "steps/tokens.hpp"

namespace conform::steps {

Value Value::of_number(std::uint64_t number) {
  Value value;
  value.number = number;
  return value;
}
Value Value::of_bytes(Bytes bytes) {
  Value value;
  if (bytes.size() <= 8 && !bytes.empty()) value.number = load_le(bytes);
  value.bytes = std::move(bytes);
  return value;
}
Value Value::of_object(Multiplexer object) {
  Value value;
  value.object = object;
  return value;
}
Value Value::of_duration(Duration duration) {
  Value value;
  value.duration = duration;
  return value;
}
Value Value::of_word(std::string word) {
  Value value;
  value.word = std::move(word);
  return value;
}

std::string Value::text() const {
  if (object) return to_string(*object);
  if (duration) return to_string(*duration);
  if (word) return *word;
  if (bytes && bytes->size() > 64)
    return hex_bytes(ByteView(*bytes).first(32)) + " ... (" + std::to_string(bytes->size()) + " bytes)";
  if (bytes) return number ? hex(*number, static_cast<int>(bytes->size()) * 2) : hex_bytes(*bytes);
  if (number) return hex(*number, *number > 0xFFFF ? 8 : (*number > 0xFF ? 4 : 2));
  return "nothing";
}

bool Value::same_as(const Value& other) const {
  if (bytes && other.bytes) return *bytes == *other.bytes;
  if (number && other.number) return *number == *other.number;
  if (object && other.object) return *object == *other.object;
  return word && other.word && *word == *other.word;
}

Result<Value> Scope::declared(Multiplexer object, Declared) {
  return fail("nothing is known of " + to_string(object));
}

namespace {

using Node = Expression::Tree;
using NodePtr = std::shared_ptr<const Node>;

Result<NodePtr> parse_term(TokenReader& in);

Result<NodePtr> parse_sum(TokenReader& in) {
  auto left = parse_term(in);
  if (!left) return left;
  std::string used;
  while (true) {
    const auto op = in.peek();
    if (op != "+" && op != "-" && op != "|" && op != "&" && op != "^") return left;
    if (!used.empty() && used != op) {
      return fail("'" + used + "' and '" + std::string(op) + "' are mixed", {},
                  "use parentheses: there is no precedence");
    }
    used = op;
    in.take();
    auto right = parse_term(in);
    if (!right) return right;
    auto node = std::make_shared<Node>();
    node->kind = used == "+"   ? Node::Kind::add
                 : used == "-" ? Node::Kind::subtract
                 : used == "|" ? Node::Kind::bit_or
                 : used == "&" ? Node::Kind::bit_and
                               : Node::Kind::bit_xor;
    node->left = *left;
    node->right = *right;
    left = node;
  }
}

Result<NodePtr> parse_term(TokenReader& in) {
  if (in.done()) return fail("a value is missing");
  auto node = std::make_shared<Node>();
  if (in.accept("~")) {
    auto inner = parse_term(in);
    if (!inner) return inner;
    node->kind = Node::Kind::complement;
    node->left = *inner;
    return node;
  }
  if (in.accept("(")) {
    auto inner = parse_sum(in);
    if (!inner) return inner;
    if (!in.accept(")")) return fail("')' is missing");
    return inner;
  }
  if (in.peek() == "value" && in.peek(1) == "of") {
    in.take();
    in.take();
    auto object = ObjectReference::parse(in.take());
    if (!object) return std::unexpected(object.error());
    node->kind = Node::Kind::value_of;
    node->object = *object;
    return node;
  }
  if (in.peek() == "bit" && in.peek(2) == "of") {
    in.take();
    const auto bit = parse_number(in.take());
    if (!bit || *bit > 63) return fail("'bit' needs a number from 0 to 63");
    in.take();
    auto object = ObjectReference::parse(in.take());
    if (!object) return std::unexpected(object.error());
    node->kind = Node::Kind::bit_of;
    node->number = *bit;
    node->object = *object;
    return node;
  }
  if (const bool of_default = (in.peek() == "default" || in.peek() == "input") && in.peek(1) == "of";
      of_default ||
      ((in.peek() == "low" || in.peek() == "high") && in.peek(1) == "limit" && in.peek(2) == "of")) {
    node->kind = Node::Kind::declared;
    node->declared = in.peek() == "input" ? Declared::wired_input
                     : of_default         ? Declared::default_value
                     : in.peek() == "low" ? Declared::low_limit
                                          : Declared::high_limit;
    for (int i = of_default ? 2 : 3; i > 0; --i) in.take();
    auto object = ObjectReference::parse(in.take());
    if (!object) return std::unexpected(object.error());
    node->object = *object;
    return node;
  }
  const auto word = in.take();
  if (word == "N") {
    node->kind = Node::Kind::node_id;
  } else if (word == "current") {
    node->kind = Node::Kind::current;
  } else if (word.starts_with('$')) {
    node->kind = Node::Kind::name;
    node->name = word.substr(1);
    if (node->name.empty()) return fail("a name is missing after '$'");
  } else if (const auto number = parse_number(word)) {
    node->kind = Node::Kind::number;
    node->number = *number;
  } else {
    return fail("'" + std::string(word) + "' is not a number, a $name, N or current", {},
                "write 17, 1Fh, 0x1F or 0609 0030h");
  }
  return node;
}

void collect_names(const NodePtr& node, std::vector<std::string>& out) {
  if (!node) return;
  if (node->kind == Node::Kind::name) out.push_back(node->name);
  if (node->kind == Node::Kind::value_of || node->kind == Node::Kind::bit_of ||
      node->kind == Node::Kind::declared) {
    for (auto& name : node->object.names()) out.push_back(name);
  }
  collect_names(node->left, out);
  collect_names(node->right, out);
}

Result<std::uint64_t> evaluate_number(const NodePtr& node, Scope& scope);

Result<Value> evaluate_node(const NodePtr& node, Scope& scope) {
  using Kind = Node::Kind;
  switch (node->kind) {
    case Kind::number: return Value::of_number(node->number);
    case Kind::node_id: return Value::of_number(scope.node().value());
    case Kind::current: return scope.current();
    case Kind::name: {
      const auto* value = scope.find(node->name);
      if (value == nullptr) return fail("$" + node->name + " has no value, as no step has brought one");
      // A late-bound instance: for_each may list `current`, which is read when it is used.
      if (value->word == "current") return scope.current();
      return *value;
    }
    case Kind::value_of: {
      auto object = node->object.resolve(scope);
      if (!object) return std::unexpected(object.error());
      return scope.read(*object);
    }
    case Kind::declared: {
      auto object = node->object.resolve(scope);
      if (!object) return std::unexpected(object.error());
      return scope.declared(*object, node->declared);
    }
    case Kind::bit_of: {
      auto object = node->object.resolve(scope);
      if (!object) return std::unexpected(object.error());
      auto value = scope.read(*object);
      if (!value) return value;
      if (!value->number) return fail(to_string(*object) + " is not a number");
      return Value::of_number((*value->number >> node->number) & 1U);
    }
    default: break;
  }
  const auto left = evaluate_number(node->left, scope);
  if (!left) return std::unexpected(left.error());
  if (node->kind == Kind::complement) return Value::of_number(~*left);
  const auto right = evaluate_number(node->right, scope);
  if (!right) return std::unexpected(right.error());
  switch (node->kind) {
    case Kind::add: return Value::of_number(*left + *right);
    case Kind::subtract: return Value::of_number(*left - *right);
    case Kind::bit_or: return Value::of_number(*left | *right);
    case Kind::bit_and: return Value::of_number(*left & *right);
    default: return Value::of_number(*left ^ *right);
  }
}

Result<std::uint64_t> evaluate_number(const NodePtr& node, Scope& scope) {
  auto value = evaluate_node(node, scope);
  if (!value) return std::unexpected(value.error());
  if (!value->number) return fail("'" + value->text() + "' is not a number of up to 64 bits");
  return *value->number;
}

}  // namespace

Result<Expression> parse_expression_prefix(TokenReader& in, std::string text) {
  auto tree = parse_sum(in);
  if (!tree) return std::unexpected(tree.error());
  return Expression(std::move(text), *tree);
}

Result<Expression> Expression::parse(std::string_view text) {
  auto tokens = tokenize(text);
  if (!tokens) return std::unexpected(tokens.error());
  TokenReader in(std::move(*tokens));
  auto expression = parse_expression_prefix(in, std::string(trim(text)));
  if (!expression) return expression;
  if (!in.done()) return fail("'" + std::string(in.peek()) + "' is not expected here");
  return expression;
}

bool Expression::is_declared() const { return tree_ && tree_->kind == Tree::Kind::declared; }

Result<Value> Expression::evaluate(Scope& scope) const {
  if (!tree_) return fail("an empty expression");
  return evaluate_node(tree_, scope);
}

Result<std::uint64_t> Expression::number(Scope& scope) const {
  if (!tree_) return fail("an empty expression");
  return evaluate_number(tree_, scope);
}

std::vector<std::string> Expression::names() const {
  std::vector<std::string> out;
  collect_names(tree_, out);
  return out;
}

Result<ObjectReference> ObjectReference::parse(std::string_view text) {
  ObjectReference out;
  text = trim(text);
  out.text_ = text;
  const auto colon = text.find(':');
  const auto index_text = trim(text.substr(0, colon));
  if (index_text.starts_with('$')) {
    out.index_name_ = index_text.substr(1);
    if (out.index_name_.empty()) return fail("a name is missing after '$'");
  } else {
    const auto mux = parse_multiplexer(index_text);
    if (!mux) {
      return fail("'" + std::string(text) + "' is not an object", {},
                  "write 1003h:00, $object or 1003h:$count");
    }
    out.index_ = mux->index.value();
  }
  if (colon == std::string_view::npos) return out;
  out.sub_given_ = true;
  const auto sub_text = trim(text.substr(colon + 1));
  if (sub_text.starts_with('$') || sub_text.starts_with('(')) {
    auto sub = Expression::parse(sub_text);
    if (!sub) return std::unexpected(sub.error());
    out.sub_ = *sub;
    return out;
  }
  // Sub-indices are hexadecimal with or without h, as the standard prints them: 1003h:10 is sub-index 16.
  const auto mux = parse_multiplexer("0000h:" + std::string(sub_text));
  if (!mux)
    return fail("'" + std::string(sub_text) + "' is not a sub-index", {},
                "write two hexadecimal digits: 1003h:0A");
  out.sub_ = Expression::parse(std::to_string(mux->sub.value())).value();
  return out;
}

Result<Multiplexer> ObjectReference::resolve(Scope& scope) const {
  Multiplexer mux;
  if (index_) {
    mux.index = Index(*index_);
  } else {
    const auto* value = scope.find(index_name_);
    if (value == nullptr) return fail("$" + index_name_ + " has no value, as no step has brought one");
    if (value->object) {
      mux = *value->object;
    } else if (value->number && *value->number <= 0xFFFF) {
      mux.index = Index(static_cast<std::uint16_t>(*value->number));
    } else {
      return fail("$" + index_name_ + " is " + value->text() + ", not an object");
    }
  }
  if (sub_given_) {
    const auto sub = sub_.number(scope);
    if (!sub) return std::unexpected(sub.error());
    if (*sub > 0xFF) return fail("sub-index " + std::to_string(*sub) + " is above FFh");
    mux.sub = SubIndex(static_cast<std::uint8_t>(*sub));
  }
  return mux;
}

std::vector<std::string> ObjectReference::names() const {
  auto out = sub_.names();
  if (!index_name_.empty()) out.push_back(index_name_);
  return out;
}

std::optional<Multiplexer> ObjectReference::literal() const {
  if (!index_ || !names().empty()) return std::nullopt;
  struct Nothing final : Scope {
    const Value* find(std::string_view) const override { return nullptr; }
    NodeId node() const override { return NodeId(1); }
    Result<Value> current() override { return fail("no entry"); }
    Result<Value> read(Multiplexer) override { return fail("no device"); }
  } nothing;
  auto mux = resolve(nothing);
  if (!mux) return std::nullopt;
  return *mux;
}

Result<Range> Range::parse(std::string_view text) {
  const auto dots = text.find("..");
  if (dots == std::string_view::npos)
    return fail("'" + std::string(text) + "' is not a range", {}, "write 1..240, 1.. or ..FFh");
  Range out;
  const auto read = [](std::string_view part) -> Result<Expression> {
    part = trim(part);
    if (part.empty()) return Expression();
    return Expression::parse(part);
  };
  auto low = read(text.substr(0, dots));
  if (!low) return std::unexpected(low.error());
  auto high = read(text.substr(dots + 2));
  if (!high) return std::unexpected(high.error());
  if (low->empty() && high->empty()) return fail("a range needs at least one end");
  out.low = *low;
  out.high = *high;
  return out;
}

Result<bool> Range::holds(std::uint64_t value, Scope& scope) const {
  if (!low.empty()) {
    const auto bound = low.number(scope);
    if (!bound) return std::unexpected(bound.error());
    if (value < *bound) return false;
  }
  if (!high.empty()) {
    const auto bound = high.number(scope);
    if (!bound) return std::unexpected(bound.error());
    if (value > *bound) return false;
  }
  return true;
}

Result<bool> Range::holds_signed(std::uint64_t value, Scope& scope) const {
  const auto as_signed = [](std::uint64_t number) { return static_cast<std::int64_t>(number); };
  if (!low.empty()) {
    const auto bound = low.number(scope);
    if (!bound) return std::unexpected(bound.error());
    if (as_signed(value) < as_signed(*bound)) return false;
  }
  if (!high.empty()) {
    const auto bound = high.number(scope);
    if (!bound) return std::unexpected(bound.error());
    if (as_signed(value) > as_signed(*bound)) return false;
  }
  return true;
}

std::string Range::text() const { return low.text() + ".." + high.text(); }

}  // namespace conform::steps
