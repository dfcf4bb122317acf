// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/model/equations/system_model.hpp"

namespace lacuna {

/// "c", "cpp", "latex", "matlab", "modelica", "python", "spice".
std::vector<std::string> export_formats();

/// A model as source text of another program: a function of time, states and inputs that gives
/// the rates, with another one for outputs and the start where they are known (c, cpp, python,
/// matlab; c has the Jacobian and a step of Runge and Kutta's method too), a Modelica model, a
/// SPICE sub-circuit of capacitors of 1 F whose voltages are the states (ngspice), or equations
/// in LaTeX. Parameters keep their names (but for spice). Numbers have all their digits. ASCII
/// whatever the model's texts are: units stand in comments with what is not plain numbered
/// (<U+00B0>), names are changed where they mean something else over there, which the head says.
/// @throws ConfigError with the nearest name for an unknown format; ModelError for a delay in a
///   format that has none (all but modelica and latex) or without a number for its time, for a
///   map, for a state that is a measured formula, for parentheses nested deeper than 150.
std::string export_model(const SystemModel& model, const std::string& format);

}  // namespace lacuna
