// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// A function lacuna_rate() of C99: time, states and inputs in, rates out.
std::string export_c(const OdeModel& model);

/// The same of C++ with arrays.
std::string export_cpp(const OdeModel& model);

/// A function rate(t, state, inputs) with NumPy.
std::string export_python(const OdeModel& model);

/// A function file lacuna_rate.m.
std::string export_matlab(const OdeModel& model);

/// `model LacunaModel`.
std::string export_modelica(const OdeModel& model);

/// A sub-circuit lacuna_model of ngspice.
std::string export_spice(const OdeModel& model);

}  // namespace lacuna
