// SPDX-License-Identifier: Apache-2.0
// What the terminal can do, and errors on it.
#pragma once

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"

namespace conform::cli {

/// --color=auto: a terminal that is not dumb, unless NO_COLOR is set (no-color.org).
inline bool use_colour(const std::string& wish, int descriptor) {
  if (wish == "always") return true;
  if (wish == "never" || std::getenv("NO_COLOR") != nullptr) return false;
  const char* terminal = std::getenv("TERM");
  return ::isatty(descriptor) != 0 && terminal != nullptr && std::string(terminal) != "dumb";
}

inline std::size_t terminal_width() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col >= 60)
    return std::min<std::size_t>(size.ws_col, 120);
  return 100;
}

/// Neither of the two, or both.
inline Error no_device_named() {
  return {"say where the device is", {}, "--interface can0 for a device, --simulate for the reference node"};
}

inline int report_error(const Error& error, int code) {
  std::string text = error.where.empty() ? "" : printable(error.where) + ": ";
  text += printable(error.what, true);
  if (!error.hint.empty()) text += "\n  hint: " + printable(error.hint);
  std::fprintf(stderr, "canopen-conform: %s\n", text.c_str());
  return code;
}

inline void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

}  // namespace conform::cli
