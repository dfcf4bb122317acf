// SPDX-License-Identifier: MIT
#include "identify/validation/prediction_windows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

OdeModel oscillator() {
  const Variables variables{{"x", "v"}, {}};
  return OdeModel(
      {{"x", ""}, {"v", ""}}, {},
      {{{Term::parse("v", variables), 1.0}}, {{Term::parse("x", variables), -1.0}}});
}

/// cos t, -sin t with noise.
PredictedRecord turning(Index n, double h, double sigma, std::uint64_t seed) {
  Random random(seed);
  PredictedRecord record;
  record.samples.time = Vector::LinSpaced(n, 0.0, h * static_cast<double>(n - 1));
  record.samples.inputs = Matrix(n, 0);
  record.path.resize(n, 2);
  for (Index i = 0; i < n; ++i)
    record.path.row(i) << std::cos(record.samples.time[i]), -std::sin(record.samples.time[i]);
  record.samples.states = record.path;
  for (double& value : record.samples.states.reshaped()) value += sigma * random.normal();
  record.deviations = Matrix::Constant(n, 2, sigma);
  return record;
}

TEST(PredictionWindows, OfTwoSamplesAreOneStepErrorsOverTheNoiseOfBoth) {
  constexpr double kStep = 0.3, kSigma = 0.02;
  const PredictedRecord record = turning(201, kStep, kSigma, 3);
  const WindowResiduals found = predict(oscillator(), record, 2, 1);
  // A rotation: y1 - R y0 has the covariance 2 sigma^2 and is shared out evenly.
  Matrix rotation(2, 2);
  rotation << std::cos(kStep), std::sin(kStep), -std::sin(kStep), std::cos(kStep);
  double expected = 0.0;
  for (Index i = 0; i + 1 < 201; i += 2) {
    const Vector error = record.samples.states.row(i + 1).transpose() -
                         rotation * record.samples.states.row(i).transpose();
    expected += error.squaredNorm() / 2.0;
  }
  EXPECT_EQ(found.windows, 100);
  EXPECT_NEAR(found.squares.sum(), expected, 1e-4 * expected);
  EXPECT_NEAR(found.freedom.sum(), 200.0, 1e-9);
  EXPECT_NEAR(found.expected.sum(), 200.0 * kSigma * kSigma, 1e-9);
}

TEST(PredictionWindows, StatesThatWereNotMeasuredTakeTheirFreedom) {
  PredictedRecord record = turning(300, 0.1, 1e-3, 1);
  record.deviations.col(1).setZero();
  record.samples.states.col(1).setConstant(99.0);
  const WindowResiduals found = predict(oscillator(), record, 3, 1);
  EXPECT_NEAR(found.freedom[0], 100.0, 1e-6);  // three samples less two initial states
  EXPECT_EQ(found.freedom[1], 0.0);
  EXPECT_NEAR(found.squares[0] / found.expected[0], 1.0, 4.0 * std::sqrt(2.0 / 100.0));
}

TEST(PredictionWindows, InWhichTheModelRunsThoughNotAlongThePathAreNotLost) {
  const OdeModel model = parse_ode("dx/dt = x - x^3", "test");
  const Dataset run = record_of(model, Dopri87{}, Vector{{0.05}}, 0.1, 60);
  PredictedRecord record{run.trajectories[0], Matrix::Constant(60, 1, 1e-3), {}};
  record.path = record.samples.states;
  for (const Index i : {5, 25, 45}) record.path(i, 0) = 1e160;  // its cube is no number
  const WindowResiduals once = predict(model, record, 20, 1);
  EXPECT_EQ(once.windows, 3);
  EXPECT_EQ(once.lost, 0);
  EXPECT_EQ(once.unstarted, 3);
  EXPECT_EQ(once.freedom[0], 0.0);
  // The next pass begins at the run.
  const WindowResiduals again = predict(model, record, 20, 2);
  EXPECT_EQ(again.lost + again.unstarted, 0);
  EXPECT_LT(std::sqrt(again.squares[0] / again.freedom[0]), 1e-5);
}

}  // namespace
}  // namespace lacuna
