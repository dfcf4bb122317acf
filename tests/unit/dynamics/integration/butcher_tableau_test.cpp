// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/integration/butcher_tableau.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

class Tableau : public testing::TestWithParam<const ButcherTableau*> {};

// sum_i b_i c_i^(q-1) = 1/q for q = 1 .. p: the quadrature conditions.
double quadrature(const std::vector<double>& weights, const std::vector<double>& nodes, int q) {
  double sum = 0.0;
  for (std::size_t i = 0; i < nodes.size(); ++i) sum += weights[i] * std::pow(nodes[i], q - 1);
  return sum;
}

// sum_ij b_i a_ij c_j^(q-2) = 1 / (q (q-1)).
double nested(const ButcherTableau& tableau, const std::vector<double>& weights, int q) {
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      sum += weights[i] * tableau.a[i][j] * std::pow(tableau.nodes[j], q - 2);
  return sum;
}

TEST_P(Tableau, RowsSumToTheNodes) {
  const ButcherTableau& tableau = *GetParam();
  for (std::size_t i = 0; i < tableau.nodes.size(); ++i) {
    ASSERT_EQ(tableau.a[i].size(), i);
    const double sum = std::accumulate(tableau.a[i].begin(), tableau.a[i].end(), 0.0);
    EXPECT_NEAR(sum, tableau.nodes[i], 1e-13) << "row " << i;
  }
}

TEST_P(Tableau, WeightsFulfilTheConditionsOfTheirOrder) {
  const ButcherTableau& tableau = *GetParam();
  for (int q = 1; q <= tableau.order; ++q)
    EXPECT_NEAR(quadrature(tableau.weights, tableau.nodes, q), 1.0 / q, 1e-14) << q;
  for (int q = 2; q <= tableau.order; ++q)
    EXPECT_NEAR(nested(tableau, tableau.weights, q), 1.0 / (q * (q - 1)), 1e-13) << q;
}

TEST_P(Tableau, EmbeddedWeightsFulfilTheConditionsOfTheirOrder) {
  const ButcherTableau& tableau = *GetParam();
  for (int q = 1; q <= tableau.embedded_order; ++q)
    EXPECT_NEAR(quadrature(tableau.embedded, tableau.nodes, q), 1.0 / q, 1e-14) << q;
  for (int q = 2; q <= tableau.embedded_order; ++q)
    EXPECT_NEAR(nested(tableau, tableau.embedded, q), 1.0 / (q * (q - 1)), 1e-13) << q;
}

TEST_P(Tableau, EmbeddedSolutionIsOfNoHigherOrder) {
  const ButcherTableau& tableau = *GetParam();
  if (tableau.embedded.empty()) return;
  const int q = tableau.embedded_order + 1;
  EXPECT_GT(std::abs(quadrature(tableau.embedded, tableau.nodes, q) - 1.0 / q), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, Tableau,
                         testing::Values(&midpoint_2(), &kutta_3(), &runge_kutta_4(),
                                         &dormand_prince_54(), &butcher_6(),
                                         &prince_dormand_7(), &prince_dormand_87()));

TEST(MethodOfOrder, HasTheOrderAskedFor) {
  for (int order = 2; order <= 8; ++order) EXPECT_EQ(method_of_order(order).order, order);
  EXPECT_THROW(method_of_order(1), ArgumentError);
  EXPECT_THROW(method_of_order(9), ArgumentError);
}

}  // namespace
}  // namespace lacuna
