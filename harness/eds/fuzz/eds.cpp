// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: no bytes may crash, hang or exhaust the reader of device descriptions, the expansion, the
// lint or the conversion. The input is a file; a first byte of 0 or 1 is cut off, and 1 makes the name that
// of a DCF. Seeds: the fixtures of the tests.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/check.hpp"
#include "base/excerpt.hpp"
#include "eds/compare.hpp"
#include "eds/convert/to_ini.hpp"
#include "eds/convert/to_xdd.hpp"
#include "eds/convert/write_ini.hpp"
#include "eds/convert/write_xdd.hpp"
#include "eds/expand.hpp"
#include "eds/ini_file.hpp"
#include "eds/lint.hpp"
#include "eds/read.hpp"

namespace {

/// In the other of the two languages, and compared with the source.
void written_can_be_read(const conform::eds::EdsFile& file) {
  using namespace conform;
  std::string text;
  if (file.is_xml()) {
    text = eds::write_ini(eds::to_ini(file, eds::Format::dcf, "fuzz.dcf").file);
  } else {
    const auto converted = eds::to_xdd(file, eds::Format::xdc, "fuzz.xdc");
    if (!converted) return;
    text = eds::write_xdd(converted->file);
  }
  if (text.size() > eds::IniFile::most_bytes) return;  // a long value that a short form repeats
  const auto again = eds::read(text, "again");
  CONFORM_CHECK(again && again->is_xml() != file.is_xml());
  CONFORM_CHECK(eds::compare_in_full(file, *again).has_value() || !eds::expand(file));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace conform;
  std::string_view text(reinterpret_cast<const char*>(data), size);
  const bool dcf = !text.empty() && text.front() == 1;
  if (!text.empty() && static_cast<unsigned char>(text.front()) <= 1) text.remove_prefix(1);
  const auto file = eds::read(text, dcf ? "fuzz.dcf" : "fuzz.eds");
  if (!file) {
    CONFORM_CHECK(file.error().where.starts_with("fuzz."));
    return 0;
  }
  for (std::size_t i = 1; i < file->objects.size(); ++i)
    CONFORM_CHECK(file->objects[i - 1].index < file->objects[i].index);
  if (const auto objects = eds::expand(*file)) {
    for (const auto& object : *objects) {
      for (std::size_t i = 1; i < object.subs.size(); ++i)
        CONFORM_CHECK(object.subs[i - 1].sub < object.subs[i].sub);
      CONFORM_CHECK(eds::find_object(*objects, object.index) == &object);
    }
  }
  const auto report = eds::lint(*file);
  std::size_t shown = 0;
  for (const auto& finding : report.findings) {
    CONFORM_CHECK(finding.at.known());
    // As if the file were one line.
    if (++shown <= 20) {
      const auto excerpt = conform::excerpt(text, finding.at.column - 1, 1);
      CONFORM_CHECK(excerpt.underline.find('^') != std::string::npos && excerpt.text.size() < 1000);
    }
    CONFORM_CHECK(!finding.message.empty() && finding.message.size() < 1000);
    CONFORM_CHECK(eds::find_rule(finding.rule->code) == finding.rule);
  }
  written_can_be_read(*file);
  // A word alone, without the sections around it.
  (void)eds::parse_number(text);
  (void)eds::parse_real(text);
  return 0;
}
