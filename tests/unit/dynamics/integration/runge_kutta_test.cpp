// SPDX-License-Identifier: MIT
// Integrators with fixed and with their own steps, and stiff ones.
#include "dynamics/integration/runge_kutta.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "dynamics/integration/automatic.hpp"
#include "dynamics/integration/butcher_tableau.hpp"
#include "dynamics/integration/cvode.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "support/stiff_models.hpp"

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

// A nonlinear, time-dependent problem with the solution x = (exp(sin t), cos t).
constexpr auto problem = [](double t, const double* x, double* dxdt) {
  dxdt[0] = x[0] * x[1] + 0.5 * (x[1] - std::cos(t)) * x[0];
  dxdt[1] = -std::sin(t);
};

Vector exact(double t) { return Vector{{std::exp(std::sin(t)), std::cos(t)}}; }

double error_at_end(Stepper& stepper, double length) {
  Vector x = exact(0.0);
  double t = 0.0;
  EXPECT_EQ(stepper.advance(problem, t, length, x.data()), IntegrationStatus::Completed);
  EXPECT_EQ(t, length);
  return (x - exact(length)).norm();
}

double measured_order(const ButcherTableau& tableau, int steps, double length) {
  const double coarse = error_at_end(*fixed_stepper(tableau, 2, steps), length);
  const double fine = error_at_end(*fixed_stepper(tableau, 2, 2 * steps), length);
  return std::log2(coarse / fine);
}

// Steps that are small enough for the leading error and far enough from rounding.
TEST(RungeKutta, ErrorFallsWithTheOrder) {
  const std::array<int, 7> steps{20, 80, 40, 40, 20, 10, 10};
  for (int order = 2; order <= 8; ++order)
    EXPECT_NEAR(
        measured_order(method_of_order(order), steps[static_cast<std::size_t>(order - 2)], 2.0),
        order, 0.05 * order);
}

TEST(RungeKutta, IntegratorsAreTheMethodsTheyAreNamedAfter) {
  EXPECT_EQ(error_at_end(*Rk4({.substeps = 20}).make_stepper(2), 2.0),
            error_at_end(*fixed_stepper(runge_kutta_4(), 2, 20), 2.0));
  EXPECT_EQ(error_at_end(*Dopri8({.substeps = 7}).make_stepper(2), 2.0),
            error_at_end(*fixed_stepper(prince_dormand_87(), 2, 7), 2.0));
  EXPECT_EQ(error_at_end(*RungeKutta({.order = 3, .substeps = 9}).make_stepper(2), 2.0),
            error_at_end(*fixed_stepper(kutta_3(), 2, 9), 2.0));
  EXPECT_EQ(RungeKutta({.order = 7}).order(), 7);
  EXPECT_EQ(Rk4().order(), runge_kutta_4().order);
  EXPECT_EQ(Dopri5().order(), dormand_prince_54().order);
  EXPECT_EQ(Dopri8().order(), prince_dormand_87().order);
  EXPECT_EQ(Dopri87().order(), prince_dormand_87().order);
}

TEST(RungeKutta, AdaptiveErrorFollowsTheTolerance) {
  double previous = 1.0;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const StepControl control{.relative_tolerance = tolerance, .absolute_tolerance = tolerance};
    const double error5 = error_at_end(*Dopri5({control}).make_stepper(2), 20.0);
    const double error8 = error_at_end(*Dopri87({control}).make_stepper(2), 20.0);
    EXPECT_LT(error5, 50.0 * tolerance);
    EXPECT_LT(error8, 50.0 * tolerance);
    EXPECT_LT(error5, 0.1 * previous);
    previous = error5;
  }
}

int evaluations(const Integrator& integrator, double length) {
  int count = 0;
  const auto rhs = [&count](double t, const double* x, double* dxdt) {
    ++count;
    problem(t, x, dxdt);
  };
  Vector x = exact(0.0);
  double t = 0.0;
  integrator.make_stepper(2)->advance(rhs, t, length, x.data());
  return count;
}

TEST(RungeKutta, LongestStepIsKept) {
  const StepControl control{
      .relative_tolerance = 1e-3, .absolute_tolerance = 1e-3, .max_step = 0.01};
  EXPECT_GE(evaluations(Dopri5({control}), 1.0), 7 * 100);
}

TEST(RungeKutta, AdaptiveStepperGoesOnWithItsStep) {
  const auto stepper = Dopri5({{.relative_tolerance = 1e-8}}).make_stepper(2);
  Vector x = exact(0.0);
  double t = 0.0;
  for (int i = 1; i <= 400; ++i) stepper->advance(problem, t, 0.01 * i, x.data());
  EXPECT_LT((x - exact(4.0)).norm(), 1e-7);
}

TEST(RungeKutta, StiffProblemEndsByTheNumberOfSteps) {
  const auto stiff = [](double t, const double* x, double* dxdt) {
    dxdt[0] = -1e9 * (x[0] - std::cos(t));
  };
  const auto stepper = Dopri5({{.max_steps = 2000}}).make_stepper(1);
  double t = 0.0, x = 0.0;
  EXPECT_EQ(stepper->advance(stiff, t, 10.0, &x), IntegrationStatus::StepTooSmall);
  EXPECT_GT(t, 0.0);
  EXPECT_LT(t, 10.0);
  EXPECT_TRUE(std::isfinite(x));
}

/// Whatever the step, the state goes to and fro by about the jump times 1e-3 of an interval.
TEST(RungeKutta, AdaptiveStepsGoAlongAJumpThatHoldsTheState) {
  const auto falling = [](double, const double* x, double* dxdt) {
    dxdt[0] = 0.3 - (x[0] > 0.0 ? 1.0 : -1.0);
  };
  for (const ButcherTableau* tableau : {&dormand_prince_54(), &prince_dormand_87()}) {
    const auto stepper = adaptive_stepper(*tableau, 1, {});
    double t = 0.0, x = 0.35;
    for (int i = 1; i <= 40; ++i) {
      ASSERT_EQ(stepper->advance(falling, t, 0.05 * i, &x), IntegrationStatus::Completed) << t;
      EXPECT_NEAR(x, std::max(0.35 - 0.7 * t, 0.0), 1e-4) << t;
    }
  }
}

TEST(RungeKutta, StepsAlongAJumpAreAsLongAsAsked) {
  const auto held = [](double, const double* x, double* dxdt) {
    dxdt[0] = x[0] > 0.0 ? -0.7 : 1.0;
  };
  const auto farthest = [&](double along_jump) {
    const auto stepper = adaptive_stepper(dormand_prince_54(), 1, {.along_jump = along_jump});
    double t = 0.0, x = 0.0, most = 0.0;
    for (int i = 1; i <= 20; ++i) {
      EXPECT_EQ(stepper->advance(held, t, i, &x), IntegrationStatus::Completed);
      most = std::max(most, std::abs(x));
    }
    return most;
  };
  EXPECT_LT(farthest(1e-3), 1e-3);
  EXPECT_LT(farthest(3e-2), 3e-2);
  EXPECT_GT(farthest(3e-2), 1e-3);
}

TEST(RungeKutta, AMassThatDryFrictionHoldsRestsUntilTheForceIsLargeEnough) {
  // Held while |0.8 sin(t)| < 0.5 after it has come to rest; 2e-6 is 1e-3 of an interval's
  // motion.
  const auto mass = [](double t, const double* x, double* dxdt) {
    const double sign = x[1] > 0.0 ? 1.0 : x[1] < 0.0 ? -1.0 : 0.0;
    dxdt[0] = x[1];
    dxdt[1] = 0.8 * std::sin(t) - 0.5 * sign;
  };
  const auto stepper = Dopri5().make_stepper(2);
  Vector x{{0.0, 0.02}};
  double t = 0.0, rest = 0.0;
  const double slips = std::asin(0.5 / 0.8);
  for (int i = 1; i <= 100; ++i) {
    ASSERT_EQ(stepper->advance(mass, t, 0.02 * i, x.data()), IntegrationStatus::Completed) << t;
    if (t < 0.1) continue;
    if (rest == 0.0) rest = x[0];
    if (t > slips) continue;
    EXPECT_NEAR(x[0], rest, 1e-5) << t;
  }
  EXPECT_GT(x[0], rest + 0.05);
  const auto speed = [&](double end) {
    return 0.8 * (std::cos(slips) - std::cos(end)) - 0.5 * (end - slips);
  };
  EXPECT_NEAR(x[1], speed(2.0), 1e-3);
}

TEST(RungeKutta, OptionsOutOfRangeAreRefused) {
  EXPECT_THROW(Rk4({.substeps = 0}), ConfigError);
  EXPECT_THROW(RungeKutta({.order = 9}), ConfigError);
  EXPECT_THROW(Dopri8({.substeps = -1}), ConfigError);
  EXPECT_THROW(Dopri5({{.relative_tolerance = 0.0}}), ConfigError);
  EXPECT_THROW(Dopri87({{.max_step = -1.0}}), ConfigError);
}

// Integrators of stiff models.
/// Robertson's reactions (1966), the standard stiff problem: rates 0.04, 1e4 and 3e7.
constexpr auto robertson = [](double, const double* x, double* dxdt) {
  dxdt[0] = -0.04 * x[0] + 1e4 * x[1] * x[2];
  dxdt[2] = 3e7 * x[1] * x[1];
  dxdt[1] = -dxdt[0] - dxdt[2];
};

bool is_absent() {
  if (Cvode::unavailable().empty()) return false;
  EXPECT_THROW(Cvode().make_stepper(1), ConfigError);
  return true;
}

// Hairer and Wanner, Solving Ordinary Differential Equations II, give x at t = 40; at 1e5 the
// slow manifold, where x2 is in balance, is what is left: 0.04 x1 = 1e4 x2 x3 + 3e7 x2^2.
TEST(Cvode, SolvesRobertsonsReactionsTo1e5Seconds) {
  if (is_absent()) return;
  const Vector times{{0.0, 40.0, 1e5}};
  const Solution orbit = Cvode().integrate(robertson, Vector{{1.0, 0.0, 0.0}}, times);
  ASSERT_EQ(orbit.status, IntegrationStatus::Completed) << orbit.message;
  EXPECT_NEAR(orbit.states(1, 0), 0.7158270688, 1e-7);
  EXPECT_NEAR(orbit.states(1, 1), 0.9185534764e-5, 1e-11);
  EXPECT_NEAR(orbit.states(2, 0) + orbit.states(2, 1) + orbit.states(2, 2), 1.0, 1e-9);
  const double x1 = orbit.states(2, 0), x2 = orbit.states(2, 1), x3 = orbit.states(2, 2);
  EXPECT_NEAR(0.04 * x1 / (1e4 * x2 * x3 + 3e7 * x2 * x2), 1.0, 1e-4);
}

// What it is for: an explicit method needs steps of the fastest time everywhere.
TEST(Cvode, TakesFarFewerRatesThanAnExplicitMethod) {
  if (is_absent()) return;
  long rates = 0;
  const auto counted = [&](double t, const double* x, double* dxdt) {
    ++rates;
    robertson(t, x, dxdt);
  };
  const Vector start{{1.0, 0.0, 0.0}}, times{{0.0, 40.0}};
  const Solution implicit_orbit = Cvode().integrate(counted, start, times);
  const long taken = std::exchange(rates, 0);
  const Solution explicit_orbit = Dopri5().integrate(counted, start, times);
  EXPECT_EQ(explicit_orbit.status, IntegrationStatus::Completed);
  EXPECT_LT((implicit_orbit.end_state - explicit_orbit.end_state).norm(), 1e-7);
  EXPECT_LT(50 * taken, rates);
}

TEST(Cvode, GoesOnWhereACallerMovedTheState) {
  if (is_absent()) return;
  const auto decay = [](double, const double* x, double* dxdt) { dxdt[0] = -x[0]; };
  const auto stepper = Cvode().make_stepper(1);
  double t = 0.0, x = 1.0;
  ASSERT_EQ(stepper->advance(decay, t, 1.0, &x), IntegrationStatus::Completed);
  EXPECT_NEAR(x, std::exp(-1.0), 1e-7);
  x = 5.0;
  ASSERT_EQ(stepper->advance(decay, t, 3.0, &x), IntegrationStatus::Completed);
  EXPECT_NEAR(x, 5.0 * std::exp(-2.0), 1e-6);
  EXPECT_EQ(t, 3.0);
}

// Without CVODE explicit steps go on, and give up.
TEST(Automatic, GoesOnByImplicitStepsWhereTheModelIsStiff) {
  const Vector times{{0.0, 40.0, 1e5}}, start{{1.0, 0.0, 0.0}};
  const OdeModel model = support::robertson();
  const Solution orbit = simulate(model, Automatic(), start, times);
  if (!Cvode::unavailable().empty()) {
    EXPECT_EQ(orbit.status, IntegrationStatus::StepTooSmall);
    return;
  }
  ASSERT_EQ(orbit.status, IntegrationStatus::Completed) << orbit.message;
  EXPECT_NEAR(orbit.states(1, 0), 0.7158270688, 1e-7) << "Hairer and Wanner's value";
  EXPECT_NEAR(orbit.states.row(2).sum(), 1.0, 1e-8);
  EXPECT_EQ(simulate(model, Dopri5(), start, times).status, IntegrationStatus::StepTooSmall)
      << "explicit steps alone are too many";
}

TEST(Automatic, FindsStiffnessWithoutASampleWhereItBegins) {
  if (!Cvode::unavailable().empty()) return;
  const Vector times{{0.0, 2e4, 1e5}}, start{{1.0, 0.0, 0.0}};
  const Solution orbit = simulate(support::robertson(), Automatic(), start, times);
  ASSERT_EQ(orbit.status, IntegrationStatus::Completed) << orbit.message;
  EXPECT_NEAR(orbit.states.row(2).sum(), 1.0, 1e-8);
}

TEST(Automatic, IsDopri5ToTheBitWhereTheModelIsNotStiff) {
  long rates = 0;
  const auto lorenz = [&rates](double, const double* x, double* dxdt) {
    ++rates;
    dxdt[0] = 10.0 * (x[1] - x[0]);
    dxdt[1] = x[0] * (28.0 - x[2]) - x[1];
    dxdt[2] = x[0] * x[1] - 8.0 / 3.0 * x[2];
  };
  const Vector start{{1.0, 1.0, 20.0}}, times = sample_times(0.0, 0.1, 300);
  const Solution automatic = Automatic().integrate(lorenz, start, times);
  const long taken = std::exchange(rates, 0);
  EXPECT_EQ(automatic.states, Dopri5().integrate(lorenz, start, times).states);
  EXPECT_EQ(taken, rates);
  EXPECT_GT(taken, 20000) << "enough steps to be tested for stiffness many times";
}

TEST(Automatic, FollowsAGateWithNanosecondsAndMilliseconds) {
  if (!Cvode::unavailable().empty()) return;
  const support::StiffRecord gate = support::gate();
  // The output is the input's inverse within nanoseconds; the slow state is a low-pass of it.
  const Matrix& x = gate.data.trajectories.front().states;
  EXPECT_NEAR(x(5, 0), 1.0, 1e-6);
  EXPECT_NEAR(x(5, 1), 1.0 - std::exp(-5.0 * 1e-5 / 1e-3), 1e-4);
}

// Held while |1.2 cos(0.7 t)| < 0.5 at rest; else the sign of the velocity is that of the
// force.
TEST(Automatic, RestsOnDryFrictionAndSlipsAgain) {
  const auto swinging = [](double t, const double* x, double* dxdt) {
    const double sign = x[1] > 0.0 ? 1.0 : x[1] < 0.0 ? -1.0 : 0.0;
    dxdt[0] = x[1];
    dxdt[1] = -25.0 * std::sin(x[0]) - 0.2 * x[1] + 1.2 * std::cos(0.7 * t) - 0.5 * sign;
  };
  const Vector start{{0.4, 0.0}}, times = sample_times(0.0, 0.01, 2001);
  const Solution orbit = Automatic().integrate(swinging, start, times);
  ASSERT_EQ(orbit.status, IntegrationStatus::Completed) << orbit.message;
  const Solution fixed = Rk4({.substeps = 100}).integrate(swinging, start, times);
  EXPECT_LT((orbit.states - fixed.states).cwiseAbs().maxCoeff(), 5e-4);
}

// Steps along the jump from the second interval of a rest on, a hundred of seven stages each;
// implicit ones, which do not get on there, are tried ever less often.
TEST(Automatic, ARestOnDryFrictionCostsFewSteps) {
  int evaluations = 0;
  const auto held = [&](double, const double* x, double* dxdt) {
    ++evaluations;
    dxdt[0] = 0.3 - (x[0] > 0.0 ? 1.0 : -1.0);
  };
  const Vector start{{0.35}}, times = sample_times(0.0, 0.01, 501);
  const Automatic integrator({.control = {.along_jump = 1e-2}});
  const Solution orbit = integrator.integrate(held, start, times);
  ASSERT_EQ(orbit.status, IntegrationStatus::Completed) << orbit.message;
  EXPECT_LT(orbit.states.bottomRows(440).cwiseAbs().maxCoeff(), 2e-4);
  EXPECT_LT(evaluations, 500 * 1000);
}

}  // namespace
}  // namespace lacuna
