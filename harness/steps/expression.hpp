// SPDX-License-Identifier: Apache-2.0
// Values a scenario computes with, and the small arithmetic on them: + - | & ^ ~ on saved values, the node-ID
// and what an entry holds. Deliberately nothing more: what does not fit becomes a verb with a name.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/strong.hpp"
#include "base/time.hpp"

namespace conform::steps {

/// What a name stands for. Exactly one of the members is the value's own form; the others are views of it.
struct Value {
  std::optional<Bytes> bytes;           ///< data as it was on the bus, or written as bytes or text
  std::optional<std::uint64_t> number;  ///< numbers, and data of up to eight bytes read little endian
  std::optional<Multiplexer> object;    ///< an entry of the dictionary (loops over entries)
  std::optional<Duration> duration;
  std::optional<std::string> word;  ///< a requirement id or another word in a row of for_each

  static Value of_number(std::uint64_t number);
  static Value of_bytes(Bytes bytes);
  static Value of_object(Multiplexer object);
  static Value of_duration(Duration duration);
  static Value of_word(std::string word);

  /// In our notation: "1003h:00", "E8 03", "1Fh", "100 ms".
  [[nodiscard]] std::string text() const;
  /// Whether two values are the same data: bytes where both have them, numbers otherwise.
  [[nodiscard]] bool same_as(const Value& other) const;
};

/// What a description says about an entry beside its type and access.
enum class Declared : std::uint8_t { low_limit, high_limit, default_value, wired_input };

/// What expressions are evaluated against.
class Scope {
 public:
  virtual ~Scope() = default;
  [[nodiscard]] virtual const Value* find(std::string_view name) const = 0;
  [[nodiscard]] virtual NodeId node() const = 0;
  /// `current`: what the entry the step is about holds now. Error when the step has no entry or it cannot be
  /// read.
  [[nodiscard]] virtual Result<Value> current() = 0;
  /// `value of 1003h:00`: an upload that judges nothing.
  [[nodiscard]] virtual Result<Value> read(Multiplexer object) = 0;
  /// `low limit of $object`, `default of $object`, `input of $object` (the entry that it is wired to): what
  /// is known of the entry. Error when the description leaves it open.
  [[nodiscard]] virtual Result<Value> declared(Multiplexer object, Declared what);
};

/// An entry as a scenario writes it: 1003h:00, $object, 1003h:$count, 1018h:($max + 1), $pdo:01.
class ObjectReference;

/// A parsed expression. Copies share their (immutable) tree.
class Expression {
 public:
  Expression() = default;
  /// Reads the whole text or explains what is wrong with it.
  static Result<Expression> parse(std::string_view text);
  [[nodiscard]] Result<Value> evaluate(Scope& scope) const;
  /// evaluate(), as a number.
  [[nodiscard]] Result<std::uint64_t> number(Scope& scope) const;
  /// Names used, without the $: for "unknown name" diagnostics.
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] bool empty() const { return tree_ == nullptr; }
  /// "default of ...", and nothing else: what a description says.
  [[nodiscard]] bool is_declared() const;

  struct Tree;
  [[nodiscard]] const std::shared_ptr<const Tree>& tree() const { return tree_; }
  Expression(std::string text, std::shared_ptr<const Tree> tree)
      : text_(std::move(text)), tree_(std::move(tree)) {}

 private:
  std::string text_;
  std::shared_ptr<const Tree> tree_;
};

class ObjectReference {
 public:
  ObjectReference() = default;
  static Result<ObjectReference> parse(std::string_view text);
  [[nodiscard]] Result<Multiplexer> resolve(Scope& scope) const;
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] bool empty() const { return text_.empty(); }
  /// The entry, when it is written out and needs no scope.
  [[nodiscard]] std::optional<Multiplexer> literal() const;

 private:
  std::string text_;
  std::optional<std::uint16_t> index_;
  std::string index_name_;
  Expression sub_;  ///< empty: the variable's own sub-index, or 00h
  bool sub_given_ = false;
};

/// "1..240", "1..", "..FFh": an inclusive range of numbers, either end may be open. Of signed numbers the
/// value and the bounds are sign-extended two's complement, as declared limits are.
struct Range {
  Expression low, high;
  static Result<Range> parse(std::string_view text);
  [[nodiscard]] Result<bool> holds_signed(std::uint64_t value, Scope& scope) const;
  [[nodiscard]] Result<bool> holds(std::uint64_t value, Scope& scope) const;
  [[nodiscard]] std::string text() const;
};

}  // namespace conform::steps
