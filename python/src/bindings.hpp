// SPDX-License-Identifier: MIT
// The parts that the extension module is made of, one source each.
#pragma once

#include <nanobind/nanobind.h>

#include "lacuna/cli/configuration/registry.hpp"

namespace lacuna::python {

namespace nb = nanobind;

/// Every part that lacuna has; made once.
const Registry& registry();

void bind_errors(nb::module_& module);   ///< exceptions of the library as those of Python
void bind_tables(nb::module_& module);   ///< records that are in memory
void bind_model(nb::module_& module);    ///< SystemModel and its compiled evaluation
void bind_stages(nb::module_& module);   ///< registered parts, and parts written in Python
void bind_answers(nb::module_& module);  ///< what the commands answer
void bind_designs(nb::module_& module);  ///< of them, plans of experiments and benches

}  // namespace lacuna::python
