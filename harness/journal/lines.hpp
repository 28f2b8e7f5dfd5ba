// SPDX-License-Identifier: Apache-2.0
// The key that tells what a line of a journal is about.
#pragma once

namespace conform::journal::lines {

inline constexpr const char* version = "journal";        ///< the first line
inline constexpr const char* elsewhere = "journal_at";   ///< instead of it: the journal has another place
inline constexpr const char* planned = "planned";        ///< the run with all its cases
inline constexpr const char* begun = "begun";            ///< index of a case
inline constexpr const char* ended = "ended";            ///< index of a case, "case": its result
inline constexpr const char* changing = "changing";      ///< an entry, "before": what it held
inline constexpr const char* commanding = "commanding";  ///< an entry that is a command
inline constexpr const char* put_back = "put_back";      ///< an entry, "value": what it holds again
inline constexpr const char* recovered = "recovered";    ///< true: what a killed run left has been dealt with
inline constexpr const char* finished = "finished";      ///< the run without its cases
inline constexpr const char* reported = "reported";      ///< every report is made
inline constexpr const char* died = "died";              ///< number of the signal, "why" in words

}  // namespace conform::journal::lines
