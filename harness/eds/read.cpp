// SPDX-License-Identifier: Apache-2.0
#include "eds/read.hpp"

#include <utility>

#include "base/files.hpp"
#include "eds/ini_file.hpp"
#include "eds/ini_reader.hpp"
#include "eds/xdd.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";

bool is_wide_text(std::string_view bytes) {
  return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
}

bool looks_like_xml(std::string_view bytes) {
  if (bytes.starts_with(utf8_mark)) bytes.remove_prefix(utf8_mark.size());
  const auto first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes[first] == '<';
}

}  // namespace

Result<EdsFile> read(std::string_view bytes, std::string file_name) {
  const std::string start = file_name + ":1:1";
  if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) return fail("the file is empty", start);
  if (bytes.size() > IniFile::most_bytes)
    return fail("the file has " + std::to_string(bytes.size()) + " bytes", start,
                "at most " + std::to_string(IniFile::most_bytes) + " are read");
  if (is_wide_text(bytes))
    return fail("the file is UTF-16 text", start,
                "save it again as plain text: an EDS or DCF as ASCII, an XDD or XDC as UTF-8");
  if (looks_like_xml(bytes)) return read_xdd(bytes, std::move(file_name));
  auto ini = IniFile::parse(bytes, file_name);
  if (!ini) return std::unexpected(ini.error());
  if (ini->sections().empty())
    return fail("neither sections ([DeviceInfo]) nor XML: this is no device description", start);
  return read_ini(*ini, std::move(file_name));
}

Result<EdsFile> read_file(const std::string& path) {
  const auto bytes = conform::read_file(path, IniFile::most_bytes);
  if (!bytes) return std::unexpected(bytes.error());
  return read(*bytes, path);
}

}  // namespace conform::eds
