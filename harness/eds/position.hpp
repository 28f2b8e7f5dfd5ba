// SPDX-License-Identifier: Apache-2.0
// Where something stands in a device description, and what was not as it should be when it was read.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace conform::eds {

/// Line and column count from 1; the column counts bytes, because the text is never decoded. Line 0: not in
/// the file (an absent entry).
struct Position {
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  [[nodiscard]] bool known() const { return line != 0; }
  friend constexpr auto operator<=>(const Position&, const Position&) = default;
};

/// "12:5", or empty when not known.
[[nodiscard]] std::string to_string(Position position);

/// What the reader passed over or put right. The lint turns each into a finding.
enum class Deviation : std::uint8_t {
  // the text
  byte_order_mark,
  mixed_line_ends,
  carriage_return_only,
  long_line,
  non_ascii,
  control_character,
  junk_line,
  hash_comment,
  indented_comment,
  blank_around_key,
  no_key,
  entry_outside_section,
  // sections
  unclosed_section,
  indented_section,
  text_after_section,
  empty_section_name,
  blank_in_section_name,
  section_name_form,
  duplicate_section,
  duplicate_entry,
  unknown_section,
  unknown_entry,
  sub_without_object,
  two_commissionings,
  commissioning_spelling,
  reserved_entry,
  // XDD
  xml_bad_index,
  xml_no_object_list,
  xml_unknown_reference,
  xml_duplicate_object,
  xml_unknown_mapping,
  xml_unknown_element,
  xml_order,
  xml_missing_element,
  xml_unknown_attribute,
  xml_missing_attribute,
  xml_bad_value,
  xml_namespace,
  xml_qualified,
};

/// One deviation. `detail` is the text in question (raw bytes of the file, shortened).
struct Remark {
  Deviation what = Deviation::junk_line;
  Position at;
  std::string detail;
  Position first = {};  ///< of a duplicate: the one that counts
};

/// The remarks on one file, in the order of reading. Of each kind the first `most_of_a_kind` are kept and the
/// others counted, so that a hostile file cannot fill the memory.
class Remarks {
 public:
  static constexpr std::size_t most_of_a_kind = 1000;

  /// At most `most` bytes of the detail are kept.
  void add(Deviation what, Position at, std::string_view detail = {}, Position first = {},
           std::size_t most = 60);
  [[nodiscard]] const std::vector<Remark>& all() const { return all_; }
  [[nodiscard]] std::size_t left_out() const { return left_out_; }

 private:
  std::vector<Remark> all_;
  std::vector<std::size_t> counts_;
  std::size_t left_out_ = 0;
};

/// At most `most` bytes of `text`, with "..." where it was cut: for messages.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t most = 60);

}  // namespace conform::eds
