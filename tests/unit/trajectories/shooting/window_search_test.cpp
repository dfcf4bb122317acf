// SPDX-License-Identifier: MIT
#include "trajectories/shooting/window_search.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "trajectories/shooting/confidence.hpp"
#include "trajectories/shooting/state_guess.hpp"
#include "unit/trajectories/shooting/records.hpp"

namespace lacuna {
namespace {

/// A pendulum without the term w^3 that its record has.
struct InexactCase {
  InexactCase() : problem(lacking(), record(), std::nullopt) {
    problem.set_sigma(0.001 * Vector::Ones(2));
    growth.dimension = 2;
    fit = fit_of(equal_windows(problem.record().begins, 25));
    growth.transitions = fit.linear.transitions;
  }

  static const TestSystem& system() { return test_system("pendulum"); }

  static ParametrisedModel lacking() {
    return with_free_coefficients(system().model, {true, false});
  }

  static Dataset record() {
    const OdeModel truth =
        system().model.with_term(1, {Term::parse("w^3", system().model.variables()), -0.01});
    return add_relative_noise(testing::clean_record(truth, system(), 800), 0.001, 1);
  }

  ShootingFit fit_of(const WindowPlan& plan) {
    ShootingFit made;
    made.plan = plan;
    made.point.parameters = problem.model().values();
    made.point.starts = starts_of(plan, problem.record().values);
    minimise(problem, made, 1e-3, 50, {});
    return made;
  }

  InexactWindows search() const { return {growth, 1e6, 4, 1e-3, 50}; }

  ShootingProblem problem;
  ErrorGrowth growth;
  ShootingFit fit;
};

Index longest_of(const WindowPlan& plan) {
  Index longest = 0;
  for (const Window& window : plan) longest = std::max(longest, window.samples);
  return longest;
}

/// Mean log standard error by the gradients of blocks.
double score_of(const ShootingFit& fit) {
  const Index p = fit.point.parameters.size();
  const Matrix r = fit.linear.reduced.topLeftCorner(p, p);
  const auto covariance = block_covariance(fit.linear.windows, (r.transpose() * r).inverse());
  return covariance ? 0.5 * covariance->diagonal().array().log().mean() : 1e300;
}

TEST(WindowSearch, TwiceAsLongWindowsKnowTheParametersLessWell) {
  InexactCase c;
  const double margin =
      1.0 / std::sqrt(2.0 * 30.0 * static_cast<double>(c.problem.model().size()));
  for (Index length = 26; length <= 46; length += 2) {
    const ShootingFit start = c.fit_of(equal_windows(c.problem.record().begins, length));
    const ShootingFit found = search_windows(c.problem, start, c.search(), {});
    Index limit = longest_of(start.plan);  // twofold steps from there are what was tried
    while (limit / 2 >= longest_of(found.plan)) limit /= 2;
    while (limit < longest_of(found.plan)) limit *= 2;
    const WindowPlan twice = plan_windows(c.problem.record().begins, c.growth,
                                          {c.search().largest_growth, 1e300, 4, 2 * limit});
    EXPECT_GT(score_of(c.fit_of(twice)), score_of(found) + margin - 0.005)
        << 2 * limit << " samples for " << longest_of(found.plan) << ", from " << length;
  }
}

/// dq/dt = 2 v + q, dv/dt = -q with q = sin t: v = (cos t - sin t) / 2.
ParametrisedModel chain(const std::string& first, const std::string& second) {
  const Variables names{{"q", "v"}, {}};
  return with_free_coefficients(
      OdeModel({{"q", ""}, {"v", ""}}, {},
               {{{Term::parse(first, names), 2.0}, {Term::parse("q", names), 1.0}},
                {{Term::parse(second, names), -1.0}}}));
}

Trajectory sine(Index n, double begin, double noise, std::uint64_t seed) {
  Trajectory run{.source = "run" + std::to_string(seed) + ".csv",
                 .time = Vector::LinSpaced(n, begin, begin + 0.02 * static_cast<double>(n - 1)),
                 .states = {},
                 .inputs = Matrix(n, 0),
                 .derivatives = {}};
  Random random(seed);
  run.states.resize(n, 1);
  for (Index i = 0; i < n; ++i)
    run.states(i, 0) = std::sin(run.time[i]) + noise * random.normal();
  return run;
}

Dataset sines(double noise) {
  Dataset data;
  data.states = {{"q", ""}};
  data.trajectories = {sine(200, 0.0, noise, 1), sine(100, 40.0, noise, 2)};
  return data;
}

Matrix guessed(const ParametrisedModel& model, const Dataset& data, double sigma) {
  const ShootingRecord record = shooting_record(model, data);
  Rates rates(model);
  const StageSignals signals = stage_signals(record, rates, {&runge_kutta_4(), 1});
  return guess_states(model, record, rates, signals, Vector::Constant(1, sigma));
}

TEST(StateGuess, AnotherStateSolvesTheEquationItStandsIn) {
  const Matrix states = guessed(chain("v", "q"), sines(0.0), 0.0);
  for (Index i = 0; i < 300; ++i) {
    const double t =
        i < 200 ? 0.02 * static_cast<double>(i) : 40.0 + 0.02 * static_cast<double>(i - 200);
    EXPECT_NEAR(states(i, 1), 0.5 * (std::cos(t) - std::sin(t)), 5e-4) << i;
  }
}

TEST(StateGuess, SmallDivisorsKeepTheQuotientBefore) {
  // dq/dt = 2 q v + q: v = (cos t - sin t) / (2 sin t), nothing is known of it at t = 0.
  const Matrix states = guessed(chain("q*v", "q"), sines(0.0), 0.0);
  EXPECT_EQ(states(0, 1), 0.0);
  EXPECT_TRUE(states.allFinite());
  EXPECT_NEAR(states(79, 1), 0.5 * (1.0 / std::tan(1.58) - 1.0), 1e-3);
}

TEST(SmoothDerivative, IsExactForParabolasWithinEachRecord) {
  Dataset data = sines(0.0);
  const auto parabola = [](double t) { return 1.0 - 2.0 * t + 3.0 * t * t; };
  for (Trajectory& run : data.trajectories)
    for (Index i = 0; i < run.samples(); ++i) run.states(i, 0) = parabola(run.time[i]);
  const ShootingRecord record = shooting_record(chain("v", "q"), data);
  const Vector slopes = smooth_derivative(record, record.values.col(0), 1e-9);
  for (Index i = 0; i < 300; ++i)
    EXPECT_NEAR(slopes[i], -2.0 + 6.0 * record.time[i], 1e-6) << i;
}

TEST(SmoothDerivative, SmoothsAsMuchAsTheNoiseAllows) {
  const ShootingRecord record = shooting_record(chain("v", "q"), sines(0.01));
  const Vector slopes = smooth_derivative(record, record.values.col(0), 0.01);
  const double error = (slopes - record.time.array().cos().matrix()).norm() / std::sqrt(300.0);
  EXPECT_LT(error, 0.1) << "differences of neighbours have errors of 0.35";
}

}  // namespace
}  // namespace lacuna
