// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// The step h of a uniform grid: no time stamp is further than h/1000 from t_0 + i h. Stamps
/// are often rounded to a few digits, which must not count, while a drifting clock must.
/// @return nothing for other grids, those that do not rise, are not finite or have fewer than
/// two
///   samples among them.
std::optional<double> common_step(const Vector& time);

/// Weights w of the rule x^(k)(at) ~ sum_j w_j x(nodes_j), which is exact for polynomials of
/// degree below the number of nodes; B. Fornberg, Math. Comp. 51 (1988) 699-706.
/// @param order k >= 0; @param nodes distinct, at least k + 1 of them.
/// @return one weight per node, in units of 1 / time^k.
/// @throws ArgumentError for other nodes or orders, and where weights would not be finite.
Vector interpolation_weights(const Vector& nodes, double at, int order);

/// Weights of the k-th derivative at `at` of the polynomial of the given degree that fits the
/// samples best in the sense of least squares; A. Savitzky, M. J. E. Golay, Anal. Chem. 36
/// (1964) 1627-1639, for any nodes.
/// @param nodes strictly increasing, more than `degree` of them.
/// @return one weight per node, in units of 1 / time^k; all 0 when k exceeds the degree.
/// @throws ArgumentError for other nodes, a negative degree or order, and where weights would
/// not
///   be finite.
Vector fit_weights(const Vector& nodes, double at, int degree, int order);

/// k-th derivatives of 1, s, s^2, ..., s^degree at s.
Vector power_derivatives(double s, int degree, int order);

/// A linear rule for a derivative from the samples near a point.
struct StencilRule {
  std::string name;  ///< of the method, for messages
  int order = 1;     ///< of the derivative, k
  Index radius = 1;  ///< samples to either side that it uses inside a uniform grid
  Index width = 3;   ///< samples it uses near an end and on a non-uniform grid, > 2 radius

  /// Weights of the samples at the nodes for the derivative at a time.
  std::function<Vector(const Vector& nodes, double at)> weights;
};

/// Applies the rule to every column at every sample.
///
/// On a uniform grid (common_step) the weights of the inner rows are computed once; near the
/// ends and on other grids each row has weights of its own, from the `width` samples nearest in
/// number. Derivatives are sums of differences of samples, so that a constant gives exactly 0.
/// @param margin samples at either end that have no row in the result.
/// @throws DataError when there are fewer than `width` samples; ArgumentError when shapes do
/// not
///   fit, the margin leaves nothing, or the rule is none.
Matrix apply_stencil(const StencilRule& rule, const Vector& time,
                     const Eigen::Ref<const Matrix>& values, Index margin = 0);

}  // namespace lacuna
