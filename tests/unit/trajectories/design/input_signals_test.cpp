// SPDX-License-Identifier: MIT
// What an experiment is planned from: signals and the precision they give.
#include "trajectories/design/input_signals.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <set>

#include "core/base/random.hpp"
#include "trajectories/design/precision.hpp"

namespace lacuna {
namespace {

Vector grid(Index count) { return Vector::LinSpaced(count, 0.0, 0.1 * double(count - 1)); }

PlanInput input() {
  return {"u", -2.0, 6.0, {}, {}, {}, 4};
}

TEST(InputSignal, PrbsHasTwoLevelsAndBitsOfOneLength) {
  Vector design(4);
  design << 0.25, 0.75, 0.0, 0.3;
  const Vector u = input_signal(input(), InputFamily::Prbs, design, grid(2050), 0.1);
  const std::set<double> levels(u.begin(), u.end());
  EXPECT_EQ(levels, (std::set<double>{0.0, 4.0}));
  // Of the 2047 bits of a period of this register 1024 are 1, 1023 are 0.
  EXPECT_EQ((u.head(2047).array() == 4.0).count(), 1024);
  design[2] = 1.0;  // bits of a quarter of the time
  const Vector slow = input_signal(input(), InputFamily::Prbs, design, grid(81), 0.1);
  for (Index i = 1; i < 80; ++i) {
    const Index begin = i - i % 20;
    EXPECT_EQ(slow[i], slow[begin]) << i;
  }
}

TEST(InputSignal, AChirpGoesFromOneFrequencyToTheOther) {
  Vector design(5);
  design << 0.5, 1.0, 0.0, 0.0, 0.0;  // one period in all of the time
  const Vector u = input_signal(input(), InputFamily::Chirp, design, grid(81), 0.1);
  for (Index i = 0; i < 80; ++i)
    EXPECT_NEAR(u[i], 2.0 + 4.0 * std::sin(2.0 * M_PI * double(i) / 80.0), 1e-9);
}

TEST(InputSignal, AllFamiliesKeepRangeRateAndHold) {
  PlanInput limited = input();
  limited.rate = 3.0;
  limited.hold = 0.5;
  Random random(3);
  ASSERT_FALSE(all_input_families().empty());
  for (const InputFamily family : all_input_families())
    for (int draw = 0; draw < 20; ++draw) {
      Vector design(design_size(limited, family));
      for (double& value : design) value = random.uniform();
      const Vector u = input_signal(limited, family, design, grid(101), 0.1);
      ASSERT_GE(u.minCoeff(), -2.0) << to_string(family);
      ASSERT_LE(u.maxCoeff(), 6.0) << to_string(family);
      for (Index i = 1; i < u.size(); ++i)
        ASSERT_LE(std::abs(u[i] - u[i - 1]), i % 5 == 0 ? 1.5 + 1e-12 : 0.0)
            << to_string(family) << " " << i;
    }
}

TEST(ExperimentOf, SamplesAreTakenAtTheDesignedTimes) {
  PlanProblem problem;
  problem.channels = {{"y", 1.0}};
  problem.starts = {{"x", 1.0, 3.0}};
  problem.duration = 1.0;
  problem.step = 0.25;
  problem.measurements = 2;
  const DesignSpace space = design_spaces(problem).at(0);
  ASSERT_EQ(design_size(problem, space), 3);
  Vector design(3);
  design << 0.5, 0.9, 0.3;
  const Experiment experiment = experiment_of(problem, space, design);
  Vector expected(7);
  expected << 0.0, 0.25, 0.3, 0.5, 0.75, 0.9, 1.0;
  EXPECT_TRUE(experiment.time.isApprox(expected));
  EXPECT_EQ(experiment.measured.sum(), 2.0);
  EXPECT_EQ(experiment.measured(2, 0) + experiment.measured(5, 0), 2.0);
  ASSERT_EQ(experiment.starts.size(), 1u);
  EXPECT_EQ(experiment.starts[0].low, 2.0);
  EXPECT_EQ(experiment.starts[0].high, 2.0);
}

const Matrix kNothing = Matrix::Zero(2, 2);

/// [[4, 1], [1, 3]]: determinant 11, inverse [[3, -1], [-1, 4]] / 11, eigenvalues (7 -+ sqrt
/// 5)/2.
Matrix information() {
  Matrix m(2, 2);
  m << 4.0, 1.0, 1.0, 3.0;
  return m;
}

TEST(PrecisionOf, IsTheFormulaOfEachCriterion) {
  const Vector one = Vector::Ones(2);
  const double low = 0.5 * (7.0 - std::sqrt(5.0)), high = 0.5 * (7.0 + std::sqrt(5.0));
  const auto of = [&](PrecisionCriterion criterion) {
    return precision_of({information(), kNothing}, one, criterion, {1});
  };
  EXPECT_NEAR(of(PrecisionCriterion::D), std::log(11.0), 1e-12);
  EXPECT_NEAR(of(PrecisionCriterion::A), -std::log(7.0 / 11.0), 1e-12);
  EXPECT_NEAR(of(PrecisionCriterion::E), std::log(low), 1e-12);
  EXPECT_NEAR(of(PrecisionCriterion::ModifiedE), std::log(low / high), 1e-12);
  EXPECT_NEAR(of(PrecisionCriterion::Chosen), -std::log(4.0 / 11.0), 1e-12);
}

TEST(PrecisionOf, UnitsDoNotMatter) {
  // The second number in thousandths: its information is a millionth, its size thousandfold.
  Vector size(2), unit(2);
  size << 2.0, 5.0;
  unit << 1.0, 1e-3;
  const Vector other = size.cwiseQuotient(unit);
  const Matrix same = unit.asDiagonal() * information() * unit.asDiagonal();
  for (const auto criterion : {PrecisionCriterion::D, PrecisionCriterion::A,
                               PrecisionCriterion::E, PrecisionCriterion::ModifiedE})
    EXPECT_NEAR(precision_of({kNothing, same}, other, criterion),
                precision_of({information(), kNothing}, size, criterion), 1e-9);
}

TEST(StandardErrors, AreRootsOfTheInverse) {
  const Vector errors = standard_errors(information(), Vector::Constant(2, 3.0));
  EXPECT_NEAR(errors[0], std::sqrt(3.0 / 11.0), 1e-12);
  EXPECT_NEAR(errors[1], std::sqrt(4.0 / 11.0), 1e-12);
}

TEST(StandardErrors, OfAnOpenDirectionThereAreNone) {
  // a + b is known, c is known, a - b is not.
  Matrix m = Matrix::Zero(3, 3);
  m.topLeftCorner(2, 2).setOnes();
  m(2, 2) = 4.0;
  const Vector errors = standard_errors(m, Vector::Ones(3));
  EXPECT_TRUE(std::isnan(errors[0]));
  EXPECT_TRUE(std::isnan(errors[1]));
  EXPECT_NEAR(errors[2], 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(standard_errors(Matrix::Zero(1, 1), Vector::Ones(1))[0]));
}

TEST(StandardErrors, WhatIsKnownStaysBesideAChaoticPath) {
  // A direction of which a path adds 1e24, far beyond rounding of what is known: across it the
  // errors are those of before, and no error is less than a millionth.
  Matrix known = Matrix::Zero(3, 3);
  known.diagonal() << 4.0, 100.0, 25.0;
  const Vector steep = Vector{{1.0, 2.0, -1.0}}.normalized();
  const Matrix added = 1e24 * steep * steep.transpose();
  const Vector errors = errors_after({known, added}, Vector::Ones(3));
  Matrix across(3, 2);
  across.col(0) = Vector{{2.0, -1.0, 0.0}}.normalized();
  across.col(1) = Vector{{1.0, 2.0, 5.0}}.normalized();
  const Matrix inverse =
      across * (across.transpose() * known * across).inverse() * across.transpose();
  for (Index p = 0; p < 3; ++p) EXPECT_NEAR(errors[p], std::sqrt(inverse(p, p)), 1e-5);
  const Matrix nothing = Matrix::Zero(1, 1), much = Matrix::Constant(1, 1, 1e24);
  EXPECT_NEAR(errors_after({nothing, much}, Vector::Constant(1, 3.0))[0], 3e-6, 1e-9);
}

}  // namespace
}  // namespace lacuna
