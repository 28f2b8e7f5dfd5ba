// SPDX-License-Identifier: Apache-2.0
#include "yaml/quick_reader.hpp"

#include <yaml.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "yaml/tree_builder.hpp"

namespace conform::yaml {
namespace {

/// libyaml counts code points.
class ByteOffsets {
 public:
  explicit ByteOffsets(std::string_view text) : size_(text.size()) {
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
    const auto first = std::ranges::find_if(text, [](char c) { return static_cast<signed char>(c) < 0; });
    ascii_ = static_cast<std::size_t>(first - text.begin());
    for (std::size_t i = ascii_; i < text.size(); ++i) {
      if (!continues(text[i])) behind_.push_back(static_cast<std::uint32_t>(i));
    }
  }

  [[nodiscard]] std::size_t of(std::size_t code_point) const {
    if (code_point < ascii_) return code_point;
    const auto i = code_point - ascii_;
    return i < behind_.size() ? behind_[i] : size_;
  }

 private:
  std::size_t size_;
  std::size_t ascii_ = 0;              // so many bytes, from the first, are code points
  std::vector<std::uint32_t> behind_;  // where each later one begins
};

class Parser {
 public:
  explicit Parser(std::string_view text) {
    if (yaml_parser_initialize(&parser_) != 1) throw std::bad_alloc();
    yaml_parser_set_encoding(&parser_, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  }
  ~Parser() {
    yaml_event_delete(&event_);
    yaml_parser_delete(&parser_);
  }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  /// Null pointer when the text is no YAML; what it returned before is gone.
  [[nodiscard]] const yaml_event_t* next() {
    yaml_event_delete(&event_);
    return yaml_parser_parse(&parser_, &event_) == 1 ? &event_ : nullptr;
  }

 private:
  yaml_parser_t parser_{};
  yaml_event_t event_{};
};

constexpr bool is_null_word(std::string_view plain) {
  return plain.empty() || plain == "~" || plain == "null" || plain == "Null" || plain == "NULL";
}

/// False when the event is one that has no place in a file of ours.
bool feed(Builder& builder, const yaml_event_t& event, std::size_t offset) {
  const Event at{.offset = offset};
  switch (event.type) {
    case YAML_SCALAR_EVENT: {
      const auto& scalar = event.data.scalar;
      if (scalar.anchor != nullptr || scalar.tag != nullptr) return false;
      std::string text(reinterpret_cast<const char*>(scalar.value), scalar.length);
      const bool styled = scalar.style != YAML_PLAIN_SCALAR_STYLE;
      if (!styled && is_null_word(text)) {
        builder.on_null(at);
      } else {
        builder.on_scalar(at, styled, std::move(text));
      }
      return true;
    }
    case YAML_SEQUENCE_START_EVENT: {
      const auto& sequence = event.data.sequence_start;
      builder.on_sequence(at, sequence.style == YAML_FLOW_SEQUENCE_STYLE);
      return sequence.anchor == nullptr && sequence.tag == nullptr;
    }
    case YAML_MAPPING_START_EVENT: {
      const auto& mapping = event.data.mapping_start;
      builder.on_mapping(at, mapping.style == YAML_FLOW_MAPPING_STYLE);
      return mapping.anchor == nullptr && mapping.tag == nullptr;
    }
    case YAML_SEQUENCE_END_EVENT: builder.on_sequence_end(); return true;
    case YAML_MAPPING_END_EVENT: builder.on_mapping_end(); return true;
    case YAML_DOCUMENT_START_EVENT: builder.on_document(offset); return true;
    case YAML_ALIAS_EVENT: return false;
    default: return true;
  }
}

}  // namespace

std::optional<Node> read_quickly(const Source& source, Diagnostics& scratch) {
  const auto text = source.text();
  if (text.contains("\xEF\xBB\xBF")) return std::nullopt;  // where there may be a mark, the parsers disagree
  const ByteOffsets bytes(text);
  Builder builder(source, scratch);
  Parser parser(text);
  try {
    for (;;) {
      const auto* event = parser.next();
      if (event == nullptr || !feed(builder, *event, bytes.of(event->start_mark.index)) || !scratch.empty())
        return std::nullopt;
      if (event->type == YAML_STREAM_END_EVENT) break;
    }
  } catch (const Stop&) {
    return std::nullopt;
  }
  auto root = builder.take_root();
  return root && !root->is_null() ? std::move(root) : std::nullopt;
}

}  // namespace conform::yaml
