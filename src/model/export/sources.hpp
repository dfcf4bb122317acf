// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/model/equations/system_model.hpp"

namespace lacuna {

/// Where the functions of a C source find the values of parameters.
enum class ParameterPlace {
  File,      ///< an array of the file, lacuna_parameters
  Argument,  ///< a last argument of that name, so that several sets of values can be in use
};

/// Functions of C99 and what they need, without a head: lacuna_rate(), lacuna_jacobian() and
/// lacuna_advance(), lacuna_output() where there are outputs, lacuna_initial() where a start is
/// known.
std::string c_functions(const SystemModel& model, ParameterPlace place);

/// The same with a head.
std::string export_c(const SystemModel& model);

/// Rates, outputs and start of C++ with arrays.
std::string export_cpp(const SystemModel& model);

/// Functions rate(t, state, inputs) and output() with NumPy.
std::string export_python(const SystemModel& model);

/// A function file lacuna_rate.m.
std::string export_matlab(const SystemModel& model);

/// `model LacunaModel`.
std::string export_modelica(const SystemModel& model);

/// A sub-circuit lacuna_model of ngspice.
std::string export_spice(const SystemModel& model);

}  // namespace lacuna
