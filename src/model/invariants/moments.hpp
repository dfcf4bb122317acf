// SPDX-License-Identifier: MIT
// Means and covariances of monomials over the samples of a record.
#pragma once

#include <vector>

#include "lacuna/data/records/noise.hpp"
#include "lacuna/model/equations/term.hpp"

namespace lacuna {

/// Monomials over samples, with what noise makes of them.
struct MonomialMoments {
  std::vector<Term> terms;  ///< K, in degree-lexicographic order, without the constant
  std::vector<std::vector<int>> exponents;  ///< of each, one for each measured state
  Vector mean;                              ///< K, without what the noise adds to squares
  Matrix covariance;                        ///< K x K over the samples
  Matrix white;        ///< K x K: mean(J S J') of noise that is independent between samples
  Matrix second;       ///< K x K: tr(H_i S H_j S) of it, Hessians at the mean sample
  Matrix lasting;      ///< the same of errors that are not: colour, solvers, digits
  Matrix block_means;  ///< blocks x K, less the mean of all
  Index samples = 0;
  Index block = 0;  ///< samples of a block
};

/// Moments of all monomials of degree 1 to `degree` in the measured states.
/// @param resolution errors that every state has, as a fraction of what it varies by.
/// @param noise of the states, where it is known already.
MonomialMoments monomial_moments(const Dataset& data, int degree, double resolution,
                                 int threads = 1, const KnownNoise& noise = {});

}  // namespace lacuna
