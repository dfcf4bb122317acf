// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// A model from formulas that are written in C++, one right-hand side for each state:
/// @code
///   const auto th = Expression::variable("th"), w = Expression::variable("w");
///   const OdeModel pendulum =
///       written_model({{"th", "rad"}, {"w", "rad/s"}}, {w, -19.62 * sin(th) - 0.15 * w});
/// @endcode
/// Formulas become sums of coefficients times terms as those of a text (parse_ode()): products
/// are multiplied out over sums, so that 10 * (y - x) is 10 y - 10 x.
/// @param states m, with their units.
/// @param rates m formulas in states, inputs and t, in state units per time unit.
/// @param inputs p.
/// @throws ModelError naming the state: another number of formulas than of states, an unknown
///   name, a coefficient that is not finite; and as the constructor of OdeModel.
OdeModel written_model(const std::vector<Quantity>& states,
                       const std::vector<Expression>& rates,
                       const std::vector<Quantity>& inputs = {},
                       const std::string& time_unit = "s");

}  // namespace lacuna
