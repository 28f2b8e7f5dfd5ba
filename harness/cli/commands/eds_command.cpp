// SPDX-License-Identifier: Apache-2.0
// `eds show`: a device description without a device.
#include <fmt/format.h>

#include <string_view>

#include "base/files.hpp"
#include "base/text.hpp"
#include "cli/commands/commands.hpp"
#include "cli/descriptions/eds_page.hpp"
#include "cli/descriptions/eds_table.hpp"
#include "cli/run/terminal.hpp"
#include "eds/expand.hpp"
#include "eds/lint.hpp"
#include "eds/read.hpp"

namespace conform::cli {

int eds_show_command(const EdsShowCommand& options) {
  const auto file = eds::read_file(options.file);
  if (!file) return report_error(file.error(), exit_usage);
  const auto objects = eds::expand(*file);
  if (!objects) return report_error(objects.error(), exit_usage);
  if (!options.html.empty()) {
    const auto written = write_file_atomically(options.html, eds_page(*file, *objects, eds::lint(*file)));
    return written ? 0 : report_error(written.error(), exit_usage);
  }
  print(options.format == "json" ? eds_json(*file, *objects) : eds_table(*file, *objects));
  return 0;
}

}  // namespace conform::cli
