// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna::testing {

/// Monomials x^i y^j z^k of total degree 0..degree in three variables, for tests that want a
/// library without the library's own bases. Ordered by degree, then by falling power of x, y.
struct Monomials {
  Matrix values;                   ///< n x L
  std::vector<std::string> names;  ///< L, "x^i y^j z^k" with plain digits: "210" is x^2 y
};

/// Evaluates all monomials up to a degree on states (n x 3).
inline Monomials make_monomials(const Matrix& states, int degree) {
  const Index count = Index{degree + 1} * (degree + 2) * (degree + 3) / 6;
  Monomials result{Matrix(states.rows(), count), {}};
  const auto power = [&](Index state, int exponent) -> Eigen::ArrayXd {
    Eigen::ArrayXd value = Eigen::ArrayXd::Ones(states.rows());
    for (int i = 0; i < exponent; ++i) value *= states.col(state).array();
    return value;
  };
  for (int total = 0; total <= degree; ++total) {
    for (int i = total; i >= 0; --i) {
      for (int j = total - i; j >= 0; --j) {
        const int k = total - i - j;
        const auto column = static_cast<Index>(result.names.size());
        result.values.col(column) = (power(0, i) * power(1, j) * power(2, k)).matrix();
        result.names.push_back(std::to_string(i) + std::to_string(j) + std::to_string(k));
      }
    }
  }
  return result;
}

}  // namespace lacuna::testing
