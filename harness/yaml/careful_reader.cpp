// SPDX-License-Identifier: Apache-2.0
#include "yaml/careful_reader.hpp"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include "yaml/syntax_error.hpp"
#include "yaml/tree_builder.hpp"

namespace conform::yaml {
namespace {

/// Hands the events of yaml-cpp on.
class Handler final : public YAML::EventHandler {
 public:
  Handler(const Source& source, Builder& builder) : text_(source.text()), builder_(builder) {}

  void OnDocumentStart(const YAML::Mark& mark) override { builder_.on_document(offset_of(mark)); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    builder_.on_null(event(mark, "", anchor));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    builder_.on_alias(event(mark, "", 0));
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    builder_.on_scalar(event(mark, tag, anchor), tag == "!", value);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override {
    builder_.on_sequence(event(mark, tag, anchor), style == YAML::EmitterStyle::Flow);
  }
  void OnSequenceEnd() override { builder_.on_sequence_end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override {
    builder_.on_mapping(event(mark, tag, anchor), style == YAML::EmitterStyle::Flow);
  }
  void OnMapEnd() override { builder_.on_mapping_end(); }

 private:
  [[nodiscard]] std::size_t offset_of(const YAML::Mark& mark) const {
    return mark.pos < 0 ? text_.size() : static_cast<std::size_t>(mark.pos);
  }

  /// "?" and "!" are what the parser gives a value without a tag.
  [[nodiscard]] Event event(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) const {
    const auto offset = offset_of(mark);
    const bool written = text_.substr(std::min(offset, text_.size())).starts_with('!');
    return {.offset = offset,
            .anchored = anchor != 0,
            .tagged = written || (tag != "?" && tag != "!" && !tag.empty())};
  }

  std::string_view text_;
  Builder& builder_;
};

}  // namespace

std::optional<Node> read_carefully(const Source& source, Diagnostics& diagnostics) {
  Builder builder(source, diagnostics);
  try {
    std::istringstream stream{std::string(source.text())};
    YAML::Parser parser(stream);
    Handler handler(source, builder);
    while (parser.HandleNextDocument(handler)) {
    }
  } catch (const Stop&) {
    return std::nullopt;
  } catch (const YAML::Exception& exception) {
    report_syntax_error({.message = exception.msg,
                         .offset = exception.mark.pos < 0 ? source.text().size()
                                                          : static_cast<std::size_t>(exception.mark.pos),
                         .last_offset = builder.last_offset(),
                         .long_quote_line = builder.long_quote_line()},
                        source, diagnostics);
    return std::nullopt;
  }
  auto root = builder.take_root();
  if (!root || root->is_null()) {
    if (!root || !root->faulty()) diagnostics.error({}, 1, "the file holds nothing");
    return std::nullopt;
  }
  return root;
}

}  // namespace conform::yaml
