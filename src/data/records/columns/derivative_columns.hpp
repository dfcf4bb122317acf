// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// A column that has a usual name for the derivative of another one.
struct NamedDerivative {
  Index column = 0, of = 0;
  int order = 1;  ///< 1 or 2

  bool operator==(const NamedDerivative&) const = default;
};

/// Columns with such names, whatever their underscores: dx, d_x, dx_dt (of the header "dx/dt"),
/// dxdt, x_dot, dot_x, xdot are first derivatives of x; ddx, d2x, d2x_dt2, d2xdt2, x_ddot,
/// ddot_x second ones. In the order of the columns, then of those they are named after.
std::vector<NamedDerivative> named_derivatives(const std::vector<Quantity>& columns);

/// A state that is the derivative of another one.
struct DerivativeColumn {
  Index column = 0, of = 0;

  bool operator==(const DerivativeColumn&) const = default;
};

/// States that are the derivatives of others by their names and by their values
/// (is_derivative()), and no states of their own, in their order. The velocity of a mechanical
/// system is one: the derivative of x is left out only where
/// - a state without such a name is the derivative of x, too (x, v, dx), or
/// - x is the derivative of another state (x, v, dv: the acceleration), or
/// - the records do not show that the states without such names leave it open
///   (is_many_valued()).
/// @throws ArgumentError when records have not the columns of the dataset.
std::vector<DerivativeColumn> derivative_columns(const Dataset& data);

/// The dataset without them, with a note that says so and how to keep them.
/// @param data as read: without derivatives that are known, identities, states that were made.
/// @throws ArgumentError as derivative_columns().
Dataset without_derivative_columns(Dataset data);

}  // namespace lacuna
