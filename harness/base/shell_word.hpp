// SPDX-License-Identifier: Apache-2.0
// Words of a command line that somebody copies out of a report.
#pragma once

#include <string>
#include <string_view>

namespace conform {

/// One argument as a POSIX shell takes it: as it is where nothing in it means anything to a shell, otherwise
/// quoted; control characters and bytes that are no UTF-8 as $'\x1b', which bash, zsh and ksh know.
[[nodiscard]] std::string shell_word(std::string_view argument);

}  // namespace conform
