// SPDX-License-Identifier: Apache-2.0
// `eds new`: a description to begin with.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <limits>

#include "base/files.hpp"
#include "base/text.hpp"
#include "cli/commands/commands.hpp"
#include "cli/commands/eds_options.hpp"
#include "cli/descriptions/eds_target.hpp"
#include "cli/descriptions/new_description.hpp"
#include "cli/run/terminal.hpp"
#include "eds/convert/to_xdd.hpp"
#include "eds/convert/write_ini.hpp"
#include "eds/convert/write_xdd.hpp"
#include "eds/file_date.hpp"

namespace conform::cli {
namespace {

/// 0 where nothing is given.
Result<std::uint32_t> number(const std::string& text, const char* option) {
  if (text.empty()) return 0;
  const auto value = parse_number(text);
  if (!value || *value > std::numeric_limits<std::uint32_t>::max())
    return fail(fmt::format("{} '{}' is no number of 32 bits", option, printable(text)), {},
                "write it as 0x1F, 1Fh or 31");
  return static_cast<std::uint32_t>(*value);
}

/// One line of a description: what CiA 306 can hold.
Result<std::string> line(const std::string& text, const char* option) {
  if (printable(text) != text) return fail(fmt::format("{} holds more than one line of text", option), {});
  return std::string(trim(text));
}

Result<NewDescription> wanted(const EdsNewCommand& options, eds::Format format) {
  NewDescription out;
  out.profile = options.profile;
  out.rpdos = options.rpdos;
  out.tpdos = options.tpdos;
  // By CiA 401 a device has inputs or outputs, by CiA 402 a controlword and a statusword.
  if (out.profile != 301 && out.rpdos == 0 && out.tpdos == 0) out.rpdos = out.tpdos = 1;
  out.file_name = file_name_for(options.out, "new.eds", format);
  const auto vendor_name = line(options.vendor_name, "--vendor-name");
  const auto product_name = line(options.product_name, "--product-name");
  const auto vendor = number(options.vendor, "--vendor");
  const auto product = number(options.product, "--product");
  const auto revision = number(options.revision, "--revision");
  for (const auto* each : {&vendor_name, &product_name})
    if (!*each) return std::unexpected(each->error());
  for (const auto* each : {&vendor, &product, &revision})
    if (!*each) return std::unexpected(each->error());
  out.vendor_name = *vendor_name;
  out.product_name = *product_name;
  out.vendor = *vendor;
  out.product = *product;
  out.revision = *revision;
  const auto today = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
  const auto date = eds::file_date(options.date.empty() ? today : options.date);
  if (!date)
    return fail(fmt::format("--date '{}' is no date", printable(options.date)), {}, "write it as 2030-12-31");
  out.date = eds::ini_date(*date);
  return out;
}

}  // namespace

int eds_new_command(const EdsNewCommand& options) {
  const bool to_terminal = options.out == "-";
  const auto format =
      to_terminal && options.to.empty() ? eds::Format::eds : target_format(options.to, options.out);
  if (!format || *format == eds::Format::dcf || *format == eds::Format::xdc)
    return report_error({fmt::format("a new description is an EDS or XDD, not '{}'", printable(options.out)),
                         {},
                         "OUT ends in .eds or .xdd, or --to names the format"},
                        exit_usage);
  const auto description = wanted(options, *format);
  if (!description) return report_error(description.error(), exit_usage);
  const auto file = new_description(*description);
  std::string text;
  if (*format == eds::Format::xdd) {
    auto converted = to_xdd(file, *format, description->file_name);
    if (!converted) return report_error(converted.error(), exit_usage);
    converted->file.comments = file.comments;
    text = write_xdd(converted->file);
  } else {
    text = write_ini(file);
  }
  if (to_terminal) {
    print(text);
  } else if (auto written = write_file_atomically(options.out, text); !written) {
    return report_error(written.error(), exit_usage);
  }
  return 0;
}

}  // namespace conform::cli
