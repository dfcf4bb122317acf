// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// An ellipsoid that every path of a model enters and never leaves:
/// sum_k w_k (x_k - c_k)^2 <= radius^2.
struct TrappingRegion {
  Vector centre;        ///< c, in the units of the states
  Vector weights;       ///< w > 0, of mean 1; in units that make the summands alike
  double radius = 0.0;  ///< in the root of that unit
  double decay = 0.0;   ///< outside, energy about c falls at least so fast for itself; 1/time
};

/// Whether paths of a model stay bounded.
enum class Boundedness {
  Trapped,          ///< there is a trapping region
  NotQuadratic,     ///< nothing is known: not a flow of polynomials of degree <= 2, or driven
  ProducesEnergy,   ///< nothing is known: no weights make the quadratic terms keep energy
  NoCentre,         ///< no such energy falls far out, about any centre
};

/// The answer with its certificate.
struct TrappingAnswer {
  Boundedness verdict = Boundedness::NotQuadratic;
  std::optional<TrappingRegion> region = {};
};

/// Seeks a certificate that all paths of x' = c + L x + Q(x) stay bounded (Schlegel and Noack,
/// J. Fluid Mech. 765 (2015) 325, theorem 1). Where quadratic terms keep the energy,
/// sum_k w_k x_k Q_k(x) = 0, that about a centre m changes by y'S(m) y + d(m)'y, with
/// y = W^1/2 (x - m), S(m) the symmetric part of W^1/2 (L + dQ/dx(m)) W^-1/2 and
/// d(m) = W^1/2 (c + L m + Q(m)). S is linear in m, so its largest eigenvalue is convex: it is
/// minimised by Newton's method on mu log tr exp(S / mu), mu falling. Where it is negative, the
/// ball of the radius |d| / |lambda| is a trapping region. Weights are those nearest to 1.
/// @param model n states without inputs; coefficients as they are: those of records keep energy
///   only where constraints or few quadratic terms make them.
TrappingAnswer trapping_region(const OdeModel& model);

}  // namespace lacuna
