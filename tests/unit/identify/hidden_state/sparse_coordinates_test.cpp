// SPDX-License-Identifier: MIT
#include "identify/hidden_state/sparse_coordinates.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

void add(Polynomial& p, Polynomial::Exponents exponents, double value, double error = 0.0) {
  p.add(exponents, {value, error * error});
}

/// Lorenz' system in x, z and w = dx/dt, as it follows by hand from y = x + w / 10:
/// w' = 270 x - 11 w - 10 x z, z' = x^2 + x w / 10 - 8/3 z.
HiddenStateModel lorenz(double error) {
  HiddenStateModel model{std::vector<Polynomial>(3), 3, 2};  // x, z, w
  add(model.rates[0], {0, 0, 1}, 1.0);
  add(model.rates[1], {2, 0, 0}, 1.0 + error, error);
  add(model.rates[1], {1, 0, 1}, 0.1);
  add(model.rates[1], {0, 1, 0}, -8.0 / 3.0);
  add(model.rates[2], {1, 0, 0}, 270.0);
  add(model.rates[2], {0, 0, 1}, -11.0);
  add(model.rates[2], {1, 1, 0}, -10.0);
  return model;
}

TEST(SparseCoordinates, FindWhatWasTakenTogether) {
  for (const double error : {0.0, 0.002}) {
    const HiddenStateModel found = in_sparse_coordinates(lorenz(error));
    // h = 10 y: x' = h - 10 x, z' = x h / 10 - 8/3 z, h' = 280 x - h - 10 x z.
    const auto tolerance = [&](double value) { return 1e-9 + 3.0 * error * std::abs(value); };
    ASSERT_EQ(found.rates[0].terms().size(), 2U);
    EXPECT_NEAR(found.rates[0].terms().at({1, 0, 0}).value, -10.0, tolerance(10.0));
    ASSERT_EQ(found.rates[1].terms().size(), 2U);
    EXPECT_NEAR(found.rates[1].terms().at({1, 0, 1}).value, 0.1, 1e-12);
    ASSERT_EQ(found.rates[2].terms().size(), 3U);
    EXPECT_NEAR(found.rates[2].terms().at({1, 0, 0}).value, 280.0, tolerance(280.0));
    EXPECT_NEAR(found.rates[2].terms().at({0, 0, 1}).value, -1.0, tolerance(20.0));
    EXPECT_EQ(complexity(found), 16);
  }
}

TEST(SparseCoordinates, TakesCubesOfMeasuredStates) {
  // x' = h - x^3, y' = h, h' = -x: with w = x', y' = w + x^3 and w' = -x - 3 x^2 w.
  HiddenStateModel model{std::vector<Polynomial>(3), 3, 2};  // x, y, w
  add(model.rates[0], {0, 0, 1}, 1.0);
  add(model.rates[1], {0, 0, 1}, 1.0);
  add(model.rates[1], {3, 0, 0}, 1.0);
  add(model.rates[2], {1, 0, 0}, -1.0);
  add(model.rates[2], {2, 0, 1}, -3.0);
  const HiddenStateModel found = in_sparse_coordinates(model);
  ASSERT_EQ(found.rates[2].terms().size(), 1U);
  EXPECT_NEAR(found.rates[2].terms().at({1, 0, 0}).value, -1.0, 1e-9);
  EXPECT_NEAR(found.rates[0].terms().at({3, 0, 0}).value, -1.0, 1e-9);
  EXPECT_EQ(found.rates[1].terms().size(), 1U);
}

TEST(SparseCoordinates, LeavesWhatIsSimpleAlone) {
  HiddenStateModel model{std::vector<Polynomial>(2), 2, 1};  // a pendulum for small angles
  add(model.rates[0], {0, 1}, 1.0);
  add(model.rates[1], {1, 0}, -4.0);
  EXPECT_EQ(complexity(in_sparse_coordinates(model)), complexity(model));
}

TEST(SparseCoordinates, TermsThatAreNotKnownFromNothingGo) {
  HiddenStateModel model{std::vector<Polynomial>(1), 1, 0};
  add(model.rates[0], {1}, 0.5, 0.2);
  add(model.rates[0], {0}, 0.5, 0.1);
  const HiddenStateModel left = without_vanishing(model);
  ASSERT_EQ(left.rates[0].terms().size(), 1U);
  EXPECT_EQ(left.rates[0].terms().count({0}), 1U);
}

}  // namespace
}  // namespace lacuna
