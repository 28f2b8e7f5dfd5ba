// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/html/document.hpp"
#include "reports/html/markup.hpp"
#include "reports/html/sections.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {
namespace {

using result::Change;

std::string row(const Book& book, const Change& change) {
  constexpr std::size_t shown = 16;
  const ByteView bytes = change.before;
  std::string value = fmt::format("<code>{}</code>", hex_bytes(bytes.first(std::min(bytes.size(), shown))));
  if (bytes.empty()) value = "(no data)";
  if (bytes.size() > shown) value += fmt::format(" ... {}", counted(bytes.size(), "byte"));
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                     to_string(change.object), value,
                     change.put_back ? badge("pass", "put back") : badge("fail", "not put back"),
                     book.case_link(change.during));
}

std::string table(const std::string& rows) {
  return fmt::format(
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Entries that were changed\"><table><thead><tr>"
      "<th scope=\"col\">entry</th><th scope=\"col\">value before, in transmission order</th><th scope=\"col\">after the run</th>"
      "<th scope=\"col\">first changed by</th></tr></thead><tbody>\n{}</tbody></table></div>\n",
      rows);
}

}  // namespace

std::string change_section(const Book& book) {
  const auto& changes = book.run().changes;
  if (changes.empty()) return {};
  std::string left, restored;
  std::size_t restored_count = 0;
  for (const auto& change : changes) {
    (change.put_back ? restored : left) += row(book, change);
    if (change.put_back) ++restored_count;
  }
  // What the device was not given back is what one has to know before it goes back into its machine.
  std::string out;
  if (!left.empty()) out += table(left);
  if (!restored.empty()) {
    const auto title =
        fmt::format("{} changed and put back",
                    restored_count == 1 ? "1 entry" : fmt::format("{} entries", restored_count));
    out += folded(title, table(restored));
  }
  return section("changes", "What the run changed in the device", out);
}

}  // namespace conform::reports::html
