// SPDX-License-Identifier: Apache-2.0
// `eds convert`: a description in another format, and the list of what that format cannot say.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "base/files.hpp"
#include "base/text.hpp"
#include "cli/commands/commands.hpp"
#include "cli/commands/eds_options.hpp"
#include "cli/descriptions/eds_target.hpp"
#include "cli/run/terminal.hpp"
#include "eds/compare.hpp"
#include "eds/convert/to_ini.hpp"
#include "eds/convert/to_xdd.hpp"
#include "eds/convert/write_ini.hpp"
#include "eds/convert/write_xdd.hpp"
#include "eds/read.hpp"

namespace conform::cli {
namespace {

using Json = nlohmann::ordered_json;
using eds::Format;

/// What was written is read again: whatever says something else than the source is told, too.
Result<void> verify(const eds::EdsFile& source, const std::string& text, std::vector<eds::Unsaid>& unsaid) {
  const auto again = eds::read(text, "OUT");
  if (!again) return std::unexpected(again.error());
  const auto differences = eds::compare(source, *again);
  if (!differences) return std::unexpected(differences.error());
  for (const auto& each : *differences) {
    const bool told = std::ranges::any_of(unsaid, [&](const eds::Unsaid& other) {
      return other.where == each.where && (other.key.empty() || other.key == each.key);
    });
    if (!told)
      unsaid.push_back({each.where, each.key, eds::shortened(each.before),
                        each.after.empty() ? "it is not there any more"
                                           : "it reads " + eds::shortened(each.after) + " there",
                        each.at_before});
  }
  return {};
}

std::string report_text(const EdsConvertCommand& options, const std::vector<eds::Unsaid>& unsaid) {
  std::string out;
  for (const auto& each : unsaid) {
    out += printable(options.in) + ":";
    if (each.at.known()) out += to_string(each.at) + ":";
    out += " " + printable(each.where);
    if (!each.key.empty()) out += " " + printable(each.key);
    if (!each.value.empty()) out += " = " + printable(each.value);
    out += ": " + printable(each.why) + "\n";
  }
  return out + fmt::format("{}: {} not said as in {}\n", printable(options.out),
                           unsaid.empty() ? "nothing" : std::to_string(unsaid.size()), printable(options.in));
}

std::string report_json(const EdsConvertCommand& options, Format from, Format to,
                        const std::vector<eds::Unsaid>& unsaid) {
  Json out;
  out["schema"] = "canopen-conform/eds-convert/1";
  out["in"] = printable(options.in);
  out["out"] = printable(options.out);
  out["from"] = std::string(to_string(from));
  out["to"] = std::string(to_string(to));
  out["unsaid"] = Json::array();
  for (const auto& each : unsaid) {
    out["unsaid"].push_back({{"where", printable(each.where)},
                             {"key", printable(each.key)},
                             {"value", printable(each.value)},
                             {"why", printable(each.why)},
                             {"line", each.at.line}});
  }
  return out.dump(2) + "\n";
}

}  // namespace

int eds_convert_command(const EdsConvertCommand& options) {
  const auto target = target_format(options.to, options.out);
  if (!target)
    return report_error({fmt::format("the extension of '{}' is no format", printable(options.out)),
                         {},
                         "OUT ends in .eds, .dcf, .xdd or .xdc, or --to names the format"},
                        exit_usage);
  const auto source = eds::read_file(options.in);
  if (!source) return report_error(source.error(), exit_usage);
  if (source->is_xml() == (*target == Format::xdd || *target == Format::xdc))
    return report_error(
        {fmt::format("{} is of the same kind as {} already", printable(options.in), to_string(*target)),
         {},
         "EDS and DCF are converted to XDD and XDC, and those to EDS and DCF"},
        exit_usage);
  const bool to_terminal = options.out == "-";
  const auto name = file_name_for(options.out, options.in, *target);
  const auto converted = source->is_xml() ? Result<eds::Converted>(to_ini(*source, *target, name))
                                          : to_xdd(*source, *target, name);
  if (!converted) return report_error(converted.error(), exit_usage);
  const auto text = source->is_xml() ? write_ini(converted->file) : write_xdd(converted->file);
  auto unsaid = converted->unsaid;
  if (auto verified = verify(*source, text, unsaid); !verified)
    return report_error(verified.error(), exit_usage);
  if (to_terminal)
    print(text);
  else if (auto written = write_file_atomically(options.out, text); !written)
    return report_error(written.error(), exit_usage);
  const auto report = options.format == "json" ? report_json(options, source->format, *target, unsaid)
                                               : report_text(options, unsaid);
  std::fwrite(report.data(), 1, report.size(), to_terminal ? stderr : stdout);
  return options.strict && !unsaid.empty() ? 1 : 0;
}

}  // namespace conform::cli
