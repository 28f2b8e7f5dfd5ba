// SPDX-License-Identifier: Apache-2.0
// The tables of lint_examples.hpp, each ascending by code.
#pragma once

#include <span>

#include "eds/lint_examples.hpp"

namespace conform::eds {

extern const std::span<const LintExample> forms_examples, objects_examples, pdos_examples, values_examples,
    parameters_examples, mapping_examples, modules_examples, services_examples, files_examples, xml_examples;

}  // namespace conform::eds
