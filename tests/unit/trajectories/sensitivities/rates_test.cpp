// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/rates.hpp"

#include <gtest/gtest.h>

#include "unit/trajectories/sensitivities/swing.hpp"

namespace lacuna {
namespace {

using testing::swing;
using testing::swing_rate;

const Vector kParameters{{-1.5, -0.2, 0.9}};

/// x, y, u, w, t.
Matrix points() {
  Matrix slots(3, 5);
  slots << 0.3, -0.2, 1.0, 0.9, 0.0, 1.4, 0.5, -2.0, 0.9, 0.1, -0.8, 0.0, 0.5, 0.9, 0.2;
  return slots;
}

double rate_at(const Matrix& slots, Index row, const Vector& p) {
  return swing_rate(slots(row, 0), slots(row, 1), slots(row, 2), p);
}

TEST(Rates, OfABlockAreThoseOfItsPoints) {
  Rates rates(swing());
  rates.set(kParameters);
  Matrix slots = points();
  Matrix f(3, 2), expected(3, 2);
  Program::Block block = rates.block(3);
  rates.rate(slots, block, f);
  rates.rate(slots, expected);
  EXPECT_EQ(f, expected);
  slots.col(0).array() += 0.25;
  slots.col(2).array() -= 0.5;
  rates.rate_changed(slots, Program::slot_set(0) | Program::slot_set(2), block, f);
  rates.rate(slots, expected);
  EXPECT_EQ(f, expected);
}

TEST(Rates, DerivativesAreThoseOfDifferences) {
  Rates rates(swing());
  rates.set(kParameters);
  const Matrix slots = points();
  Matrix jacobian(3, static_cast<Index>(rates.jacobian_places().size()));
  Matrix columns(3, static_cast<Index>(rates.column_places().size()));
  rates.derivatives(slots, jacobian, columns);
  constexpr double kStep = 1e-5;
  ASSERT_EQ(rates.jacobian_places().size(), 3u) << "dx'/dx is always zero";
  for (std::size_t place = 0; place < 3; ++place) {
    const auto [row, column] = rates.jacobian_places()[place];
    Matrix above = slots, below = slots;
    above.col(column).array() += kStep;
    below.col(column).array() -= kStep;
    Matrix f(3, 2), g(3, 2);
    rates.rate(above, f);
    rates.rate(below, g);
    EXPECT_LT((jacobian.col(static_cast<Index>(place)) - (f - g).col(row) / (2.0 * kStep))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-8);
  }
  ASSERT_EQ(rates.column_places().size(), 3u);
  for (Index p = 0; p < 3; ++p)
    for (Index i = 0; i < 3; ++i) {
      Vector above = kParameters, below = kParameters;
      above[p] += kStep;
      below[p] -= kStep;
      EXPECT_NEAR(columns(i, p),
                  (rate_at(slots, i, above) - rate_at(slots, i, below)) / (2.0 * kStep), 1e-8);
      EXPECT_EQ(rates.column_places()[static_cast<std::size_t>(p)].row, 1);
    }
}

}  // namespace
}  // namespace lacuna
