// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "support/monomials.hpp"
#include "support/rossler_data.hpp"

namespace lacuna::testing {

/// Monomials up to a degree against given derivatives.
inline LeastSquaresSystem monomial_system(const Matrix& states, const Matrix& derivatives,
                                          int degree) {
  Monomials monomials = make_monomials(states, degree);
  return {make_row_source(std::move(monomials.values), derivatives),
          monomials.names,
          {"x", "y", "z"}};
}

/// Rossler's system with exact derivatives, made once.
inline const RosslerData& rossler_10000() {
  static const RosslerData data = make_rossler_data(10000, 0.1);
  return data;
}

/// The true terms of the three equations by their names in make_monomials.
inline const std::vector<std::vector<std::string>>& rossler_terms() {
  static const std::vector<std::vector<std::string>> terms{
      {"010", "001"}, {"100", "010"}, {"000", "001", "101"}};
  return terms;
}

/// Names of a set of terms.
inline std::vector<std::string> names_of(const LeastSquaresSystem& system,
                                         const TermSet& terms) {
  std::vector<std::string> names;
  for (const Index term : terms)
    names.push_back(system.term_names()[static_cast<std::size_t>(term)]);
  return names;
}

/// y with independent normal errors of standard deviation `share` times each column's rms.
inline Matrix with_noise(const Matrix& values, double fraction, std::uint64_t seed) {
  Random random(seed);
  Matrix result = values;
  for (Index j = 0; j < values.cols(); ++j) {
    const double rms = values.col(j).norm() / std::sqrt(static_cast<double>(values.rows()));
    for (Index i = 0; i < values.rows(); ++i) result(i, j) += fraction * rms * random.normal();
  }
  return result;
}

}  // namespace lacuna::testing
