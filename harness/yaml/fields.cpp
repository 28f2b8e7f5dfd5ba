// SPDX-License-Identifier: Apache-2.0
#include "yaml/fields.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"

namespace conform::yaml {
namespace {

/// "a, b or c"
std::string alternatives(const std::vector<std::string_view>& words) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) out += i + 1 == words.size() ? " or " : ", ";
    out += words[i];
  }
  return out;
}

/// A key as messages name it. Every read makes one, and few are ever told.
std::string in_quotes(std::string_view key) {
  std::string out;
  out.reserve(key.size() + 2);
  out += '\'';
  out += key;
  out += '\'';
  return out;
}

/// Most mappings are asked for at most so many.
constexpr std::size_t usual_keys = 16;

/// In the order of their first place.
std::vector<std::string_view> each_once(const std::vector<std::string>& words) {
  std::vector<std::string_view> out;
  for (const std::string_view word : words) {
    if (std::ranges::find(out, word) == out.end()) out.push_back(word);
  }
  return out;
}

/// "key:value" as one word: YAML wants a space behind the colon.
bool lacks_space(const Node& node) {
  const auto colon = node.text().find(':');
  return node.plain() && colon != std::string::npos && colon > 0 && colon + 1 < node.text().size() &&
         node.text().find(' ') == std::string::npos;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
  const bool negative = text.starts_with('-');
  const auto magnitude = parse_number(negative ? text.substr(1) : text);
  constexpr auto max = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (!magnitude || *magnitude > max + (negative ? 1U : 0U)) return std::nullopt;
  // Two's complement: the modular conversion is the negation also for the smallest value.
  return static_cast<std::int64_t>(negative ? 0U - *magnitude : *magnitude);
}

}  // namespace

void Field::error(std::string message, std::string hint) const {
  if (node_ != nullptr) diagnostics_->error(*node_, std::move(message), std::move(hint));
}

void Field::warning(std::string message, std::string hint) const {
  if (node_ != nullptr) diagnostics_->warning(*node_, std::move(message), std::move(hint));
}

void Field::expected(std::string_view what, std::string hint) const {
  if (node_ == nullptr || node_->faulty()) return;
  error(fmt::format("expected {} for {}, found {}", what, name_, describe(*node_)), std::move(hint));
}

std::optional<std::string> Field::text() const {
  if (node_ == nullptr || node_->faulty()) return std::nullopt;
  if (!node_->is_scalar()) {
    expected("text");
    return std::nullopt;
  }
  if (node_->plain() && (node_->text() == "true" || node_->text() == "false")) {
    expected("text", fmt::format("quote it if it is not meant as a boolean: \"{}\"", node_->text()));
    return std::nullopt;
  }
  if (trim(node_->text()).empty()) {
    error(fmt::format("the text of {} is empty", name_));
    return std::nullopt;
  }
  return node_->text();
}

std::optional<std::uint64_t> Field::number(std::uint64_t min, std::uint64_t max) const {
  if (node_ == nullptr) return std::nullopt;
  const auto value = node_->is_scalar() ? parse_number(node_->text()) : std::nullopt;
  if (!value || node_->faulty()) {
    expected("a number", "write 17, 11h or 0x11");
    return std::nullopt;
  }
  if (*value < min || *value > max) {
    const bool bounded = max != std::numeric_limits<std::uint64_t>::max();
    error(fmt::format("{} is {}", name_, node_->text()),
          min == max ? fmt::format("only {} is known here", min)
          : bounded  ? fmt::format("allowed is {} to {}", min, max)
                     : fmt::format("the least is {}", min));
    return std::nullopt;
  }
  return value;
}

std::optional<std::int64_t> Field::integer(std::int64_t min, std::int64_t max) const {
  if (node_ == nullptr) return std::nullopt;
  const auto value = node_->is_scalar() ? parse_integer(node_->text()) : std::nullopt;
  if (!value || node_->faulty()) {
    expected("an integer", "write 17, -17, 11h or 0x11");
    return std::nullopt;
  }
  if (*value < min || *value > max) {
    error(fmt::format("{} is {}", name_, node_->text()), fmt::format("allowed is {} to {}", min, max));
    return std::nullopt;
  }
  return value;
}

std::optional<Duration> Field::duration() const {
  if (node_ == nullptr) return std::nullopt;
  auto value = node_->is_scalar() && !node_->faulty() ? parse_duration(node_->text()) : std::nullopt;
  if (!value) expected("a duration", "write a number and a unit: 100 ms, 1.5 s, 250 us, 2 min");
  return value;
}

std::optional<Multiplexer> Field::multiplexer() const {
  if (node_ == nullptr) return std::nullopt;
  auto value = node_->is_scalar() && !node_->faulty() ? parse_multiplexer(node_->text()) : std::nullopt;
  if (!value) expected("an object", "write index and sub-index as 1003h:00");
  return value;
}

std::optional<Bytes> Field::bytes() const {
  if (node_ == nullptr) return std::nullopt;
  auto value = node_->is_scalar() && !node_->faulty() ? parse_bytes(node_->text()) : std::nullopt;
  if (!value) expected("bytes", "write two hex digits for each: 2F 03 10 00");
  return value;
}

std::optional<bool> Field::boolean() const {
  if (node_ == nullptr) return std::nullopt;
  if (node_->plain() && node_->text() == "true") return true;
  if (node_->plain() && node_->text() == "false") return false;
  expected("true or false");
  return std::nullopt;
}

std::vector<Field> Field::items() const {
  if (node_ != nullptr && !node_->is_sequence()) expected("a list");
  if (node_ == nullptr || !node_->is_sequence()) return {};
  return items_or_one();
}

std::vector<Field> Field::items_or_one() const {
  std::vector<Field> out;
  if (node_ == nullptr) return out;
  if (!node_->is_sequence()) {
    out.push_back(*this);
    return out;
  }
  const std::string name = "an item of " + name_;
  for (const Node& item : node_->items()) out.emplace_back(&item, *diagnostics_, name);
  return out;
}

std::optional<std::ptrdiff_t> Field::word_index(const std::vector<std::string_view>& words) const {
  if (node_ == nullptr || node_->faulty()) return std::nullopt;
  if (!node_->is_scalar()) {
    expected(alternatives(words));
    return std::nullopt;
  }
  const auto found = std::ranges::find(words, node_->text());
  if (found != words.end()) return found - words.begin();
  expected(alternatives(words), suggestion(node_->text(), words));
  return std::nullopt;
}

std::optional<std::string> Field::one_of(const std::vector<std::string_view>& words) const {
  const auto index = word_index(words);
  if (!index) return std::nullopt;
  return std::string(words[static_cast<std::size_t>(*index)]);
}

Fields Field::fields(std::string what) const {
  if (node_ == nullptr) return Fields(*diagnostics_, std::move(what));
  return Fields(*node_, *diagnostics_, std::move(what));
}

Fields::Fields(const Node& node, Diagnostics& diagnostics, std::string what)
    : diagnostics_(&diagnostics), what_(std::move(what)) {
  if (node.is_mapping()) {
    node_ = &node;
    asked_.reserve(usual_keys);
  } else if (!node.faulty()) {
    diagnostics.error(node, fmt::format("expected a mapping for the {}, found {}", what_, describe(node)),
                      lacks_space(node) ? "a space is needed behind the colon" : "");
  }
}

Fields::Fields(Diagnostics& diagnostics, std::string what)
    : diagnostics_(&diagnostics), what_(std::move(what)) {}

Fields::~Fields() { finish(); }

const Node* Fields::look_up(std::string_view key) {
  if (node_ == nullptr) return nullptr;
  asked_.emplace_back(key);
  return node_->find(key);
}

Field Fields::required(std::string_view key) {
  const Node* node = look_up(key);
  if (node == nullptr && node_ != nullptr) {
    missing_.push_back(
        {.message = fmt::format("the {} needs a key '{}'", what_, key), .keys = {std::string(key)}});
  }
  return {node, *diagnostics_, in_quotes(key)};
}

Field Fields::optional(std::string_view key) { return {look_up(key), *diagnostics_, in_quotes(key)}; }

bool Fields::has(std::string_view key) { return look_up(key) != nullptr; }

Field Fields::exactly_one_of(std::initializer_list<std::string_view> keys) {
  std::string_view first;
  for (const auto key : keys) {
    if (look_up(key) == nullptr) continue;
    if (first.empty()) {
      first = key;
      continue;
    }
    const auto entry = std::ranges::find(node_->entries(), key,
                                         [](const Entry& e) { return std::string_view(e.key.text()); });
    diagnostics_->error(entry->key, fmt::format("'{}' does not go with '{}' in one {}", key, first, what_),
                        "give one of them");
  }
  if (!first.empty()) return optional(first);
  if (node_ != nullptr) {
    missing_.push_back(
        {.message = fmt::format("the {} needs one of {}", what_, alternatives(std::vector(keys))),
         .keys = std::vector<std::string>(keys.begin(), keys.end())});
  }
  return {nullptr, *diagnostics_, {}};
}

void Fields::known(std::initializer_list<std::string_view> keys) {
  for (const auto key : keys) static_cast<void>(look_up(key));
}

void Fields::error(std::string message, std::string hint) const {
  if (node_ != nullptr) diagnostics_->error(*node_, std::move(message), std::move(hint));
}

void Fields::finish() {
  if (finished_) return;
  finished_ = true;
  if (node_ == nullptr) return;
  for (const auto& entry : node_->entries()) {
    const auto& key = entry.key;
    if (others_allowed_ || key.faulty() || std::ranges::find(asked_, key.text()) != asked_.end()) continue;
    const auto known = each_once(asked_);
    std::string hint;
    if (const auto near = did_you_mean(key.text(), known); !near.empty()) {
      hint = fmt::format("did you mean '{}'?", near);
      // The misspelt key explains why it is missing.
      std::erase_if(missing_, [&](const Missing& missing) {
        return std::ranges::find(missing.keys, near) != missing.keys.end();
      });
    } else if (node_->flow() && entry.value.is_null()) {
      hint = "a comma ends an entry of { }: write several values as [a, b], or quote the text";
    } else if (lacks_space(key)) {
      hint = "a space is needed behind the colon";
    } else if (!known.empty() && known.size() <= 12) {
      hint = fmt::format("known here: {}", fmt::join(known, ", "));
    }
    diagnostics_->error(key, fmt::format("unknown key {} in the {}", describe(key), what_), std::move(hint));
  }
  for (auto& missing : missing_) diagnostics_->error(*node_, std::move(missing.message));
}

}  // namespace conform::yaml
