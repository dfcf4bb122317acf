// SPDX-License-Identifier: MIT
// Accuracy of coefficients on noise-free Rossler data with exact derivatives, where libraries
// of high degree are ill conditioned.
#include <gtest/gtest.h>

#include <algorithm>

#include "lacuna/regression/linear/least_squares_system.hpp"
#include "lacuna/regression/linear/subproblem.hpp"
#include "support/monomials.hpp"
#include "support/rossler_data.hpp"

namespace lacuna {
namespace {

using testing::make_monomials;
using testing::make_rossler_data;
using testing::Monomials;
using testing::RosslerData;

double true_coefficient(Index equation, const std::string& name) {
  static const std::vector<std::vector<std::pair<std::string, double>>> kEquations{
      {{"010", -1.0}, {"001", -1.0}},
      {{"100", 1.0}, {"010", 0.2}},
      {{"000", 0.2}, {"001", -5.7}, {"101", 1.0}}};
  for (const auto& [term, value] : kEquations[static_cast<std::size_t>(equation)]) {
    if (term == name) return value;
  }
  return 0.0;
}

// Largest error of a coefficient of the whole library, relative to the largest coefficient,
// after one refinement; states are multiplied by `scale`.
double coefficient_error(Index n, int degree, double scale = 1.0) {
  const RosslerData data = make_rossler_data(n, 0.1);
  const Monomials terms = make_monomials(scale * data.states, degree);
  const LeastSquaresSystem system(make_row_source(terms.values, data.derivatives), terms.names,
                                  {"x", "y", "z"});
  double error = 0.0;
  for (Index k = 0; k < 3; ++k) {
    const Subproblem problem = system.subproblem(k, system.all_terms());
    const Vector h = system.refined(problem, problem.solve());
    for (Index j = 0; j < h.size(); ++j) {
      const std::string& name = terms.names[static_cast<std::size_t>(j)];
      const int power = (name[0] - '0') + (name[1] - '0') + (name[2] - '0');
      error =
          std::max(error, std::abs(h[j] * std::pow(scale, power) - true_coefficient(k, name)));
    }
  }
  return error / 5.7;
}

TEST(RosslerAccuracy, Degree3) { EXPECT_LT(coefficient_error(10'000, 3), 1e-13); }

TEST(RosslerAccuracy, Degree5) { EXPECT_LT(coefficient_error(10'000, 5), 1e-11); }

TEST(RosslerAccuracy, Degree5OfManyRows) { EXPECT_LT(coefficient_error(100'000, 5), 1e-11); }

TEST(RosslerAccuracy, Degree5OfScaledStates) {
  EXPECT_LT(coefficient_error(10'000, 5, 1e-3), 1e-11);
  EXPECT_LT(coefficient_error(10'000, 5, 1e4), 1e-11);
}

TEST(RosslerAccuracy, RefinementMakesUpForAGram) {
  const RosslerData data = make_rossler_data(10'000, 0.1);
  const Monomials terms = make_monomials(data.states, 5);
  const LeastSquaresSystem system(make_row_source(terms.values, data.derivatives), terms.names,
                                  {"x", "y", "z"}, {}, Folding::Gram);
  const Subproblem problem = system.subproblem(2, system.all_terms());
  const Vector h = system.refined(problem, problem.solve());
  ASSERT_GT(h.size(), 0);
  for (Index j = 0; j < h.size(); ++j) {
    EXPECT_NEAR(h[j], true_coefficient(2, terms.names[static_cast<std::size_t>(j)]), 5e-9);
  }
}

TEST(RosslerAccuracy, EliminationOfADegree7LibraryEqualsRefitting) {
  const RosslerData data = make_rossler_data(5'000, 0.1);
  const Monomials terms = make_monomials(data.states, 7);
  const LeastSquaresSystem system(make_row_source(terms.values, data.derivatives), terms.names,
                                  {"x", "y", "z"});
  Subproblem problem = system.subproblem(2, system.all_terms());
  while (problem.size() > 10) problem.remove(problem.size() - 1 - problem.size() % 3);
  const Vector refit = system.subproblem(2, problem.active()).solve();
  EXPECT_LT((problem.solve() - refit).norm(), 1e-11 * refit.norm());
}

}  // namespace
}  // namespace lacuna
