// SPDX-License-Identifier: MIT
#pragma once

#include "model/export/foreign_names.hpp"

namespace lacuna {

/// Names that mean something else in a language: its keywords, what the exported text and the
/// run of it use, what a header or the run defines beside it.
const NameRules& c_names();  ///< C and C++ in one, as C is often included from C++
const NameRules& python_names();
const NameRules& matlab_names();  ///< MATLAB and Octave
const NameRules& modelica_names();
const NameRules& spice_names();  ///< ngspice
const NameRules& latex_names();  ///< no words: names are letters in \mathit

}  // namespace lacuna
