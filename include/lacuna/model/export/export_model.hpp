// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// "c", "cpp", "latex", "matlab", "modelica", "python", "spice".
std::vector<std::string> export_formats();

/// A model as source text of another program: a function of time, states and inputs that gives
/// the rates (c, cpp, python, matlab), a Modelica model, a SPICE sub-circuit of capacitors of
/// 1 F whose voltages are the states (ngspice), or equations in LaTeX. Coefficients have all
/// their digits.
/// @throws ConfigError with the nearest name for an unknown format; ModelError for a delay in a
///   format that has none (all but modelica and latex).
std::string export_model(const OdeModel& model, const std::string& format);

}  // namespace lacuna
