// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// The outputs y = h(t, x, u) of a model along an orbit.
/// @param time n; @param states n x m; @param inputs n x p.
/// @return n x outputs. @throws ArgumentError when shapes do not fit.
Matrix output_values(const OdeModel& model, const Vector& time, const Matrix& states,
                     const Matrix& inputs);

}  // namespace lacuna
