// SPDX-License-Identifier: MIT
#include "trajectories/smoother/hidden_states.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/data/records/marks.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

/// x measured as sin(t), everything else hidden.
Dataset sine(const OdeModel& model) {
  Dataset data;
  data.states = model.states();
  Trajectory record;
  record.time = Vector::LinSpaced(401, 0.0, 20.0);
  record.states = Matrix::Zero(401, model.dimension());
  record.states.col(0) = record.time.array().sin();
  record.inputs.resize(401, 0);
  data.trajectories = {record};
  data.reconstructed.assign(model.states().size(), true);
  data.reconstructed[0] = false;
  return data;
}

TEST(HiddenStates, ADerivativeOfAMeasuredStateIsNone) {
  const OdeModel model = parse_ode("dx/dt = v\ndv/dt = -x - w\ndw/dt = v - w\n", "test");
  const std::vector<bool> expected{false, false, true};
  EXPECT_EQ(hidden_states(model, sine(model)), expected);
  const OdeModel known = parse_ode("dx/dt = v\ndv/dt = -x\n", "test");
  EXPECT_TRUE(hidden_states(known, sine(known)).empty());
}

TEST(HiddenStates, PathFollowsTheMeasuredStates) {
  const OdeModel model = parse_ode("dx/dt = cos(t)\ndz/dt = x - 0.5*z\n", "test");
  const Dataset data = with_hidden_paths(model, sine(model), {false, true}, Vector{{0.0, 2.0}});
  const Trajectory& record = data.trajectories.front();
  // dz/dt = sin t - z/2, z(0) = 2: the exact solution.
  for (const Index i : {0, 100, 400}) {
    const double t = record.time[i];
    const double exact = 2.8 * std::exp(-0.5 * t) + 0.4 * std::sin(t) - 0.8 * std::cos(t);
    EXPECT_NEAR(record.states(i, 1), exact, 2e-3) << t;
  }
  EXPECT_EQ(record.states(100, 0), std::sin(record.time[100])) << "measured values stay";
}

TEST(HiddenStates, SeveralAlsoBeginARangeApartTogether) {
  const OdeModel model = parse_ode("dx/dt = -x\ndz/dt = 1\ndw/dt = 2\n", "test");
  const std::vector<bool> hidden{false, true, true};
  const Dataset data = with_hidden_paths(model, sine(model), hidden, Vector::Zero(3));
  const auto begins = hidden_begins(data, hidden, Vector::Zero(3));
  ASSERT_EQ(begins.size(), 7u);
  EXPECT_TRUE(begins[5].isApprox(Vector{{0.0, 20.0, 40.0}}, 1e-9));
  EXPECT_TRUE(begins[6].isApprox(Vector{{0.0, -20.0, -40.0}}, 1e-9));
}

TEST(HiddenStates, LevelsOfWhichTheModelTakesRootsAreFound) {
  // Three tanks in a row, only the last level measured; no rate has a slope at an empty tank.
  const OdeModel truth = parse_ode(
      "dx/dt = 0.5*sqrt(w) - 0.4*sqrt(x)\n"
      "dz/dt = 0.4 + 0.2*sin(0.7*t) - 0.5*sqrt(z)\ndw/dt = 0.5*sqrt(z) - 0.5*sqrt(w)\n",
      "test");
  Dataset data = sine(truth);
  Matrix exact(401, 3);
  double x = 1.2, z = 0.8, w = 0.6;
  for (Index i = 0; i < 401; ++i) {
    exact.row(i) << x, z, w;
    data.trajectories.front().states(i, 0) =
        x + 1e-4 * std::sin(917.0 * std::pow(static_cast<double>(i), 2));
    const double h = 0.05 / 500;
    for (int s = 0; s < 500; ++s) {
      const double t = 0.05 * static_cast<double>(i) + h * (s + 0.5);
      const double from_z = 0.5 * std::sqrt(z), from_w = 0.5 * std::sqrt(w);
      x += h * (from_w - 0.4 * std::sqrt(x));
      z += h * (0.4 + 0.2 * std::sin(0.7 * t) - from_z);
      w += h * (from_z - from_w);
    }
  }
  AssimilationOptions options;
  options.hidden = {false, true, true};
  const Assimilation fit =
      assimilate_from_starts(truth, as_measured(data), options, RunContext{});
  ASSERT_TRUE(std::isfinite(fit.deviance));
  EXPECT_LT((fit.records.front().path - exact).cwiseAbs().maxCoeff(), 0.05);
}

TEST(HiddenStates, AMissingColumnIsNoMarkAnyMore) {
  const OdeModel model = parse_ode("dx/dt = -x\ndz/dt = x - z\n", "test");
  Dataset data = sine(model);
  data.trajectories.front().marks = Matrix::Zero(401, 2);
  data.trajectories.front().marks.col(1).setConstant(number_of(Mark::Missing));
  data = with_hidden_paths(model, std::move(data), {false, true}, Vector::Zero(2));
  EXPECT_TRUE(data.trajectories.front().marks.isZero(0.0));
}

TEST(HiddenStates, TheirPathAndCoefficientsAreFound) {
  // x' = -x + z, z' = 0.3 x - 0.5 z + cos(1.3 t), x measured.
  const OdeModel truth = parse_ode(
      "fixed dx/dt: z\nfixed dz/dt: x\nfixed dz/dt: cos(1.3*t)\ndx/dt = -x + z\n"
      "dz/dt = 0.3*x - 0.5*z + cos(1.3*t)\n",
      "test");
  Dataset data = sine(truth);
  Vector state{{0.2, 1.0}};
  Matrix exact(401, 2);
  for (Index i = 0; i < 401; ++i) {
    exact.row(i) = state.transpose();
    const double h = 0.05 / 50;
    for (int s = 0; s < 50; ++s) {
      const double t = 0.05 * static_cast<double>(i) + h * (s + 0.5);
      const Vector rate{
          {-state[0] + state[1], 0.3 * state[0] - 0.5 * state[1] + std::cos(1.3 * t)}};
      const Vector half = state + 0.5 * h * rate;
      state +=
          h * Vector{{-half[0] + half[1], 0.3 * half[0] - 0.5 * half[1] + std::cos(1.3 * t)}};
    }
    data.trajectories.front().states(i, 0) =
        exact(i, 0) + 1e-3 * std::sin(917.0 * std::pow(static_cast<double>(i), 2));
  }
  AssimilationOptions options;
  options.hidden = {false, true};
  options.free = free_coefficients(truth);
  options.held_among = options.free.size();
  const OdeModel off = parse_ode(
      "fixed dx/dt: z\nfixed dz/dt: x\nfixed dz/dt: cos(1.3*t)\ndx/dt = -1.2*x + z\n"
      "dz/dt = 0.3*x - 0.6*z + cos(1.3*t)\n",
      "test");
  const Assimilation fit =
      assimilate_from_starts(off, as_measured(data), options, RunContext{});
  EXPECT_NEAR(fit.model.coefficient(0, "x"), -1.0, 0.02);
  EXPECT_NEAR(fit.model.coefficient(1, "z"), -0.5, 0.03);
  EXPECT_LT((fit.records.front().path.col(1) - exact.col(1)).cwiseAbs().maxCoeff(), 0.03);
}

}  // namespace
}  // namespace lacuna
