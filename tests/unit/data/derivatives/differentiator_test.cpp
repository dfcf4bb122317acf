// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/differentiator.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "core/base/random.hpp"
#include "data/derivatives/automatic_differentiator.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "data/derivatives/local_polynomial.hpp"
#include "data/derivatives/savitzky_golay.hpp"
#include "data/derivatives/smoothing_spline.hpp"
#include "data/derivatives/spectral.hpp"
#include "grids.hpp"
#include "lacuna/core/base/options.hpp"

namespace lacuna {
namespace {

struct MarkerOptions {
  static constexpr StageInfo kInfo{"marker", "", ""};
  void describe(OptionVisitor&) {}
};

/// Gives the order back, to see that the checked call reaches the hook.
class Marker final : public Configured<Differentiator, MarkerOptions> {
 public:
  using Configured::Configured;

 private:
  Matrix do_differentiate(const Vector&, const Eigen::Ref<const Matrix>& values,
                          int order) const override {
    return Matrix::Constant(values.rows(), values.cols(), order);
  }
};

const Vector kTime = Vector::LinSpaced(5, 0.0, 1.0);
const Matrix kValues = Matrix::Ones(5, 2);

std::string data_error(const Vector& time, const Matrix& values) {
  try {
    Marker{}.differentiate(time, values);
  } catch (const DataError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Differentiator, UsableArgumentsReachTheMethod) {
  EXPECT_EQ(Marker{}.differentiate(kTime, kValues, 3), Matrix::Constant(5, 2, 3.0));
}

TEST(Differentiator, TimeMustIncrease) {
  Vector time = kTime;
  time[3] = time[2];
  EXPECT_NE(data_error(time, kValues).find("sample 4"), std::string::npos);
}

TEST(Differentiator, ValuesMustBeFinite) {
  Matrix values = kValues;
  values(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(data_error(kTime, values).find("column 2 is not finite at sample 2"),
            std::string::npos);
}

Dataset record_with_noise(double noise) {
  Random random(5);
  const Vector time = uniform_grid(400, 12.0);
  Vector y = time.array().sin();
  for (Index i = 0; i < y.size(); ++i) y[i] += noise * random.normal();
  Dataset data;
  data.states = {{"x", ""}};
  data.trajectories.push_back({"", time, y, Matrix(400, 0), Matrix()});
  return data;
}

double error_of(const Stage<Differentiator>& method, const Dataset& data) {
  const Trajectory& record = data.trajectories[0];
  const auto fitted = fitted_to(method, data);
  const Vector rate = fitted->differentiate(record.time, record.states);
  return (rate.array() - record.time.array().cos()).matrix().norm();
}

TEST(AutomaticDifferentiator, IsNearTheBestOfThoseItChoosesFrom) {
  const Dataset data = record_with_noise(0.1);
  double best = error_of(FiniteDifferences{}, data);
  best = std::min(best, error_of(SavitzkyGolay{}, data));
  best = std::min(best, error_of(SmoothingSpline{}, data));
  best = std::min(best, error_of(LocalPolynomial{}, data));
  EXPECT_LT(error_of(AutomaticDifferentiator{}, data), 1.2 * best);
  EXPECT_GT(error_of(FiniteDifferences{}, data), 3.0 * best);
}

// A spline and a path of Kalman's leave noise in a sine that a spectrum does not have: on
// records that are made of them alone each of the two is best.
TEST(AutomaticDifferentiator, JudgesByThePilotsThatSuitTheRecord) {
  const auto fitted =
      fitted_to(Stage<Differentiator>(AutomaticDifferentiator{}), record_with_noise(0.001));
  EXPECT_EQ(fitted->info().name, "spectral");
}

TEST(AutomaticDifferentiator, IsExactWithoutNoise) {
  EXPECT_LT(error_of(AutomaticDifferentiator{}, record_with_noise(0.0)), 1e-4);
}

TEST(AutomaticDifferentiator, TakesDifferencesWhereNothingMoves) {
  Dataset data = record_with_noise(0.0);
  data.trajectories[0].states.setConstant(3.0);
  const auto fitted = fitted_to(Stage<Differentiator>(AutomaticDifferentiator{}), data);
  EXPECT_EQ(fitted->info().name, "finite-differences");
}

TEST(AutomaticDifferentiator, IsTheSameEveryTime) {
  const Dataset data = record_with_noise(0.05);
  EXPECT_EQ(error_of(AutomaticDifferentiator{}, data),
            error_of(AutomaticDifferentiator{}, data));
}

Vector disturbed(Vector y, double noise, std::uint64_t seed) {
  Random random(seed);
  for (Index i = 0; i < y.size(); ++i) y[i] += noise * random.normal();
  return y;
}

TEST(Spectral, IsExactForItsOwnSeriesOnAnyGrid) {
  for (const Vector& grid : {uniform_grid(120, 3.0), jittered_grid(120, 3.0)}) {
    const Vector time = grid.array() - grid[0];
    const double w = 4.0 * std::numbers::pi / time[119];
    const Vector y = (w * time.array()).cos() + time.array().cube();
    const Vector rate = 3.0 * time.array().square() - w * (w * time.array()).sin();
    const Spectral method{{.cutoff = 3.0}};
    EXPECT_LT(relative_error(method.differentiate(time, y), rate), 1e-9);
  }
}

TEST(Spectral, RemovesWhatIsAboveTheCutoff) {
  const Vector time = uniform_grid(800, 10.0);
  const Vector slow = (2.0 * time.array()).sin();
  const Vector fast = (60.0 * time.array()).sin();
  const Vector kept = Spectral{{.cutoff = 2.0}}.differentiate(time, slow + fast, 0);
  EXPECT_LT((kept - slow).norm() / fast.norm(), 0.06);
}

TEST(Spectral, ChoosesACutoffForNoiseAndItsErrorIsThatOfManyDraws) {
  const Vector time = uniform_grid(600, 12.0);
  double error = 0.0, claimed = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Vector y = disturbed((2.0 * time.array()).sin(), 0.1, seed);
    const Vector rate = Spectral{}.differentiate(time, y);
    error += (rate.array() - 2.0 * (2.0 * time.array()).cos()).square().mean();
    claimed += Spectral{}.standard_error(time, y)->array().square().mean();
  }
  EXPECT_LT(std::sqrt(error / 8.0), 0.25);
  EXPECT_NEAR(std::log(claimed / error), 0.0, std::log(4.0));
}

TEST(Spectral, LongRecordsGoByPieces) {
  const Vector time = uniform_grid(5000, 100.0);
  const Vector rate = Spectral{}.differentiate(time, disturbed(time.array().sin(), 0.01, 2));
  EXPECT_LT((rate.array() - time.array().cos()).matrix().norm() / std::sqrt(5000.0), 0.02);
}

}  // namespace
}  // namespace lacuna
