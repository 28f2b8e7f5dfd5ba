// SPDX-License-Identifier: Apache-2.0
// The parts of the page in their order. Each is markup for one <section>, or empty where the run has nothing
// to say there.
#pragma once

#include <string>

#include "reports/html/book.hpp"

namespace conform::reports::html {

/// Verdict, what was tested, causes as a list: the first screen.
[[nodiscard]] std::string summary_section(const Book& book);
/// Requirements by area, what was waived, what is not applicable, and what one could give to have more
/// judged.
[[nodiscard]] std::string coverage_section(const Book& book);
[[nodiscard]] std::string cause_section(const Book& book);
/// What the cases say for those of CiA's tool.
[[nodiscard]] std::string compared_section(const Book& book);
/// Times that were measured, load of the bus, where the time of the run went.
[[nodiscard]] std::string measurement_section(const Book& book);
/// The entries of the object dictionary: what is said of them, what the device showed, what differs.
[[nodiscard]] std::string dictionary_section(const Book& book);
[[nodiscard]] std::string change_section(const Book& book);
[[nodiscard]] std::string requirement_section(const Book& book);
/// How the entry of a requirement in it begins: with its name on the page, and its verdict.
[[nodiscard]] std::string requirement_tag(const Book& book, const RequirementVerdict& one);
[[nodiscard]] std::string case_section(const Book& book);

}  // namespace conform::reports::html
