// SPDX-License-Identifier: MIT
#include "data/derivatives/finite_differences.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "data/derivatives/stencil.hpp"
#include "grids.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

Vector derivative_of_sine(const Vector& time, int k) {
  return (time.array() + 0.5 * M_PI * k).sin();
}

/// Largest error of the k-th derivative of sin over the rows [first, first + count).
double sine_error(int order, int k, const Vector& time, Index first, Index count) {
  const Matrix values = time.array().sin();
  const Vector found = FiniteDifferences{{.order = order}}.differentiate(time, values, k);
  return (found - derivative_of_sine(time, k)).segment(first, count).cwiseAbs().maxCoeff();
}

constexpr Index kSamples = 64;

/// Starts where the error term behind the leading one of the first row vanishes.
Vector grid_of_step(double step, int k) {
  return uniform_grid(kSamples, step * (kSamples - 1)).array() +
         (k % 2 == 1 ? 0.0 : 0.5 * M_PI);
}

/// Order of accuracy as measured with two steps, of the inner rows or of the first one.
double measured_order(int order, int k, bool boundary, double step) {
  const auto error = [&](double h) {
    return boundary ? sine_error(order, k, grid_of_step(h, k), 0, 1)
                    : sine_error(order, k, grid_of_step(h, k), order, kSamples - 2 * order);
  };
  return std::log2(error(step) / error(0.5 * step));
}

class FiniteDifferencesOrder : public testing::TestWithParam<int> {};

// Steps are chosen so that errors lie above rounding for every order.
TEST_P(FiniteDifferencesOrder, ConvergesInside) {
  const double step = 0.05 * GetParam();
  EXPECT_NEAR(measured_order(GetParam(), 1, false, step), GetParam(), 0.35);
  EXPECT_NEAR(measured_order(GetParam(), 2, false, step), GetParam(), 0.35);
  EXPECT_NEAR(measured_order(GetParam(), 3, false, step), GetParam(), 0.35);
}

TEST_P(FiniteDifferencesOrder, ConvergesAtTheBoundary) {
  const double step = 0.02 * GetParam();
  EXPECT_NEAR(measured_order(GetParam(), 1, true, step), GetParam(), 0.6);
  EXPECT_NEAR(measured_order(GetParam(), 2, true, step), GetParam(), 0.9);
}

TEST_P(FiniteDifferencesOrder, IsExactForPolynomials) {
  const FiniteDifferences method{{.order = GetParam()}};
  for (const Vector& time : {uniform_grid(40, 1.5), jittered_grid(40, 1.5)}) {
    for (int k = 1; k <= 3; ++k) {
      const int degree = GetParam() + k - 1;
      const Matrix found = method.differentiate(time, polynomial(time, degree), k);
      const double rounding = 1e-13 * std::pow(30.0, k) * GetParam() * GetParam();
      EXPECT_LT(relative_error(found, polynomial(time, degree, k)), rounding) << k;
    }
  }
}

TEST_P(FiniteDifferencesOrder, ConvergesOnAJitteredGrid) {
  const int order = GetParam();
  const auto error = [&](double end) {
    return sine_error(order, 1, jittered_grid(kSamples, end), 0, kSamples);
  };
  const double end = 1.5 * order;
  EXPECT_GT(std::log2(error(end) / error(0.5 * end)), order - 1.0);
}

INSTANTIATE_TEST_SUITE_P(Even, FiniteDifferencesOrder, testing::Values(2, 4, 6, 8, 10));

TEST(FiniteDifferences, DifferentiatesEachColumn) {
  const Vector time = uniform_grid(30, 2.0);
  Matrix values(30, 2);
  values << time, time.cwiseAbs2();
  const Matrix found = FiniteDifferences{}.differentiate(time, values);
  EXPECT_LT((found.col(0).array() - 1.0).abs().maxCoeff(), 1e-12);
  EXPECT_LT((found.col(1) - 2.0 * time).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FiniteDifferences, DerivativeScalesWithTheUnitOfTime) {
  const Vector time = uniform_grid(64, 6.0);
  const Matrix values = time.array().sin();
  const FiniteDifferences method{{.order = 4}};
  const Matrix slow = method.differentiate(time, values, 2);
  const Matrix fast = method.differentiate(1e-4 * time, values, 2);
  EXPECT_LT((1e-8 * fast - slow).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(FiniteDifferences, NeedsOrderPlusDerivativeSamples) {
  const FiniteDifferences method{{.order = 6}};
  const Vector seven = uniform_grid(7, 1.0);
  EXPECT_NO_THROW(method.differentiate(seven, Matrix(seven), 1));
  try {
    method.differentiate(seven, Matrix(seven), 2);
    FAIL();
  } catch (const DataError& error) {
    EXPECT_NE(error.problem().find("at least 8 samples"), std::string::npos) << error.what();
  }
}

int chosen_order(const Dataset& data) {
  const Stage<Differentiator> fitted = fitted_to(FiniteDifferences{}, data);
  return *dynamic_cast<const FiniteDifferences&>(*fitted).options().order;
}

Dataset sine_record(double h, Index n, double noise) {
  Random random(7);
  Trajectory run{"sine", uniform_grid(n, h * static_cast<double>(n - 1)), {}, Matrix(n, 0), {}};
  run.states = run.time.array().sin().matrix();
  for (Index i = 0; i < n; ++i) run.states(i, 0) += noise * random.normal();
  Dataset data;
  data.states = {{"x", ""}};
  data.trajectories = {run};
  return data;
}

TEST(FiniteDifferences, CleanCoarseRecordAsksForAHighOrder) {
  EXPECT_GE(chosen_order(sine_record(0.5, 2000, 0.0)), 16);
}

TEST(FiniteDifferences, NoiseAsksForTheOrderWhoseTruncationItHides) {
  const int quiet = chosen_order(sine_record(0.3, 4000, 1e-5));
  const int noisy = chosen_order(sine_record(0.3, 4000, 1e-2));
  EXPECT_LE(noisy, 6);
  EXPECT_GT(quiet, noisy);
  EXPECT_LT(quiet, 16);
}

TEST(FiniteDifferences, TruncationErrorIsThatOfTheDerivative) {
  for (const int order : {2, 4, 8}) {
    const Dataset data = sine_record(0.4, 3000, 0.0);
    const Trajectory& run = data.trajectories[0];
    const FiniteDifferences method{{.order = order}};
    const Matrix rate = method.differentiate(run.time, run.states);
    const Vector off =
        (rate.col(0).array() - run.time.array().cos()).matrix().segment(10, 2980);
    const double actual = off.norm() / std::sqrt(2980.0);
    EXPECT_NEAR((*method.truncation_error(data))[0], actual, 0.1 * actual) << order;
  }
}

TEST(FiniteDifferences, SeriesOfDifferencesAgreesWithStencils) {
  const Dataset uniform = sine_record(0.4, 3000, 0.0);
  Dataset shifted = uniform;
  Trajectory& run = shifted.trajectories[0];
  run.time[1500] += 0.002 * 0.4;  // more than a uniform grid may have
  run.states(1500, 0) = std::sin(run.time[1500]);
  EXPECT_EQ(chosen_order(shifted), chosen_order(uniform));
  for (const int order : {2, 6, 12}) {
    const FiniteDifferences method{{.order = order}};
    const double series = (*method.truncation_error(uniform))[0];
    EXPECT_NEAR((*method.truncation_error(shifted))[0], series, 0.01 * series) << order;
  }
}

TEST(FiniteDifferences, NoiseThatIsKnownIsNotEstimatedAgain) {
  const Dataset record = sine_record(0.3, 4000, 1e-5);
  const auto order_at = [&](double noise) {
    const auto fitted = fitted_to(FiniteDifferences{}, record, Vector::Constant(1, noise));
    return *dynamic_cast<const FiniteDifferences&>(*fitted).options().order;
  };
  EXPECT_EQ(order_at(1e-5), chosen_order(record));
  EXPECT_LT(order_at(1e-2), chosen_order(record));
}

TEST(FiniteDifferences, NoiseIsNoTruncationError) {
  const FiniteDifferences method{{.order = 8}};
  EXPECT_EQ((*method.truncation_error(sine_record(0.1, 3000, 1e-2)))[0], 0.0);
  EXPECT_FALSE(method.truncation_error(sine_record(0.1, 12, 0.0)));
}

TEST(FiniteDifferences, OrderThatIsGivenStays) {
  const Stage<Differentiator> given = FiniteDifferences{{.order = 6}};
  EXPECT_EQ(fitted_to(given, sine_record(0.5, 200, 0.0)).shared(), given.shared());
}

TEST(FiniteDifferences, ShortRecordsGetAnOrderTheyCanHave) {
  for (const Index n : {3, 4, 6, 9, 20}) {
    const Vector time = uniform_grid(n, 1.0);
    const Matrix rate = FiniteDifferences{}.differentiate(time, time);
    EXPECT_LT((rate.array() - 1.0).abs().maxCoeff(), 1e-12) << n;
  }
}

TEST(FiniteDifferences, MarginIsHalfTheOrder) {
  EXPECT_EQ(FiniteDifferences({.order = 8}).margin(), 4);
}

TEST(FiniteDifferences, OddOrderIsRefused) {
  EXPECT_THROW(FiniteDifferences({.order = 3}), ConfigError);
  EXPECT_THROW(FiniteDifferences({.order = 0}), ConfigError);
}

Vector nodes(std::initializer_list<double> values) {
  return Eigen::Map<const Vector>(values.begin(), static_cast<Index>(values.size()));
}

TEST(FitWeights, AreTheTableOfSavitzkyAndGolay) {
  const Vector smooth = fit_weights(nodes({-2, -1, 0, 1, 2}), 0.0, 2, 0);
  EXPECT_LT((35.0 * smooth - nodes({-3, 12, 17, 12, -3})).norm(), 1e-13);
  const Vector rate = fit_weights(nodes({-2, -1, 0, 1, 2}), 0.0, 2, 1);
  EXPECT_LT((10.0 * rate - nodes({-2, -1, 0, 1, 2})).norm(), 1e-13);
}

StencilRule second_order_rule() {
  return {"test", 1, 1, 3,
          [](const Vector& x, double at) { return interpolation_weights(x, at, 1); }};
}

TEST(ApplyStencil, ConstantsGiveExactlyZero) {
  const Vector time = uniform_grid(50, 3.0);
  const Matrix constant = Matrix::Constant(50, 2, 1.0 / 3.0);
  EXPECT_TRUE(apply_stencil(second_order_rule(), time, constant).isZero(0.0));
  EXPECT_TRUE(apply_stencil(second_order_rule(), jittered_grid(50, 3.0), constant).isZero(0.0));
}

TEST(ApplyStencil, RoundedTimeStampsAreUniform) {
  const Index n = 2001;
  const Vector exact = uniform_grid(n, 2.0);
  const Vector rounded = (exact.array() * 1e3 / 1.0000001 * 1e3).round() * 1e-6;
  const Matrix line = exact;
  const Matrix rate = apply_stencil(second_order_rule(), rounded, line);
  // Own weights would show the rounding of single stamps; common ones see the mean step.
  EXPECT_LT((rate.array() - rate.mean()).abs().maxCoeff(), 2e-3);
  EXPECT_LT((rate.middleRows(1, n - 2).array() - rate(1, 0)).abs().maxCoeff(), 1e-10);
}

TEST(ApplyStencil, DriftingClockIsNotUniform) {
  const Index n = 4001;
  const Vector uniform = uniform_grid(n, 4.0);
  const Vector drifting = uniform.array() + 1e-4 * uniform.array().square();
  const Matrix line = drifting;
  const Matrix rate = apply_stencil(second_order_rule(), drifting, line);
  EXPECT_LT((rate.array() - 1.0).abs().maxCoeff(), 1e-9);
}

TEST(ApplyStencil, LeavesOutTheMarginOnAnyGrid) {
  for (const Vector& time : {uniform_grid(40, 0.1), jittered_grid(40, 3.0)}) {
    const Matrix values = time.array().sin().matrix();
    const Matrix all = apply_stencil(second_order_rule(), time, values);
    EXPECT_EQ(apply_stencil(second_order_rule(), time, values, 5), all.middleRows(5, 30));
  }
}

}  // namespace
}  // namespace lacuna
