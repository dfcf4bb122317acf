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
/// their digits. ASCII whatever the model's texts are: units stand in comments with what is not
/// plain numbered (<U+00B0>), names are changed where they mean something else over there,
/// which the head says.
/// @throws ConfigError with the nearest name for an unknown format; ModelError for a delay in a
///   format that has none (all but modelica and latex) or without a number for its time, for a
///   map, for a state that is a measured formula, for parentheses nested deeper than 150.
std::string export_model(const OdeModel& model, const std::string& format);

}  // namespace lacuna
