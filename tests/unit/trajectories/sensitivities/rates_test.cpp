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

TEST(Rates, AreTheSumsOfTheModel) {
  Rates rates(swing());
  rates.set(kParameters);
  const Matrix slots = points();
  Matrix f(3, 2);
  rates.rate(slots, f);
  for (Index i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(f(i, 0), slots(i, 1));
    EXPECT_NEAR(f(i, 1), rate_at(slots, i, kParameters), 1e-14);
    const Vector point = slots.row(i);
    Vector one(2);
    rates.rate(point.data(), one.data());
    EXPECT_DOUBLE_EQ(one[1], f(i, 1)) << "one point as in a block";
  }
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

TEST(Rates, WeightsAfterTheFirstDerivativesAreNew) {
  Rates rates(swing());
  Matrix jacobian(3, 3), columns(3, 3), later(3, 3);
  rates.derivatives(points(), jacobian, columns);
  rates.set(kParameters);
  rates.derivatives(points(), later, columns);
  EXPECT_NEAR(later(0, 2), -0.2, 1e-15) << "dy'/dy is the damping";
  EXPECT_NEAR(jacobian(0, 2), -0.3, 1e-15);
}

TEST(Rates, ShapesStandBetweenInputsAndTime) {
  Rates rates(swing());
  rates.set(kParameters);
  ASSERT_EQ(rates.signals(), 2);
  Matrix slots = Matrix::Zero(1, 5), signals(1, 2);
  signals << 4.0, 0.25;
  rates.fill_signals(signals, slots);
  EXPECT_EQ(slots, (Matrix(1, 5) << 0.0, 0.0, 4.0, 0.9, 0.25).finished());
  Vector point = Vector::Zero(5);
  rates.fill_signals(signals.data(), 1, point.data());
  EXPECT_EQ(point, slots.row(0).transpose());
}

TEST(Rates, APlainModelHasNoColumns) {
  Rates rates(swing().model());
  EXPECT_EQ(rates.columns(), 0);
  EXPECT_EQ(rates.slots(), 4);
}

}  // namespace
}  // namespace lacuna
