// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/implicit/radau.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <unsupported/Eigen/KroneckerProduct>
#include <unsupported/Eigen/MatrixFunctions>

#include "lacuna/model/files/model_file.hpp"
#include "support/random_matrix.hpp"
#include "support/stiff_models.hpp"
#include "trajectories/sensitivities/implicit/radau_system.hpp"
#include "unit/trajectories/sensitivities/swing.hpp"

namespace lacuna {
namespace {

using testing::random_matrix;
using testing::swing;

// A_ij integrates the polynomials through the nodes: A c^k = c^(k+1) / (k+1) for k < 3.
TEST(RadauSystem, TheMethodIntegratesParabolasExactly) {
  const Eigen::Map<const Eigen::Vector3d> nodes(Radau::nodes().data());
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d powers = nodes.array().pow(k);
    for (Index i = 0; i < 3; ++i) {
      const Eigen::Map<const Eigen::Vector3d> row(
          Radau::a()[static_cast<std::size_t>(i)].data());
      EXPECT_NEAR(row.dot(powers), std::pow(nodes[i], k + 1) / (k + 1), 1e-15);
    }
  }
}

TEST(RadauSystem, SolvesWhatTheWholeSystemOfStagesDoes) {
  constexpr double kStep = 0.3;
  for (const Index m : {1, 2, 5}) {
    const Matrix jacobian = random_matrix(m, m, 1), right = random_matrix(m, 6, 2);
    RadauSystem system;
    system.factorise(kStep, jacobian);
    Matrix stages = right;
    system.solve(stages);
    const Matrix whole =
        Eigen::kroneckerProduct(Matrix(Radau::inverse()) / kStep, Matrix::Identity(m, m)) -
        Eigen::kroneckerProduct(Matrix::Identity(3, 3), jacobian);
    for (Index column = 0; column < 2; ++column) {
      Vector all(3 * m), solved(3 * m);
      for (Index j = 0; j < 3; ++j) {
        all.segment(j * m, m) = right.col(2 * j + column);
        solved.segment(j * m, m) = stages.col(2 * j + column);
      }
      EXPECT_LT((whole * solved - all).norm(), 1e-11) << m;
    }
    const Vector known = right.col(0);
    const Vector real = system.solve_real(known);
    const double shift = ((known + jacobian * real).dot(real)) / real.squaredNorm() * kStep;
    EXPECT_NEAR(shift, 3.6378342527444957, 1e-9) << "Hairer and Wanner's value";
  }
}

TEST(RadauSystem, StagesGoThroughTheInverseOfTheMethod) {
  const Matrix stages = random_matrix(2, 6, 3);
  Matrix through;
  through_inverse(stages, through);
  for (Index i = 0; i < 3; ++i) {
    Matrix back = Matrix::Zero(2, 2);
    for (Index j = 0; j < 3; ++j)
      back += Radau::a()[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] *
              through.middleCols(2 * j, 2);
    EXPECT_LT((back - stages.middleCols(2 * i, 2)).norm(), 1e-13);
  }
}

TEST(RadauSystem, DeviationsOfAStepAreThoseOfTheExponential) {
  constexpr double kStep = 0.05;
  const Matrix jacobian = random_matrix(3, 3, 4), begin = random_matrix(3, 2, 5);
  const Matrix zero = Matrix::Zero(3, 2);
  const Matrix end =
      radau_variation(kStep, {{jacobian, jacobian, jacobian}, {zero, zero, zero}}, begin);
  const Matrix exact = Matrix(kStep * jacobian).exp() * begin;
  EXPECT_LT((end - exact).norm(), 1e-7);
  EXPECT_GT((end - begin).norm(), 1e-2);
}

/// Slots of swing(): input, shape, t.
struct Drive {
  Rates& rates;
  void operator()(double t, double* slots) const {
    const double signals[] = {std::cos(t), t};
    rates.fill_signals(signals, 1, slots);
  }
};

Vector end_of_swing(const Vector& parameters, const Vector& start, Matrix* derivatives) {
  Rates rates(swing());
  rates.set(parameters);
  Vector x = start;
  RadauFlow flow;
  EXPECT_TRUE(flow.advance(rates, Drive{rates}, 0.2, 1.7, x, derivatives));
  return x;
}

TEST(Radau, ItsDerivativesAreThoseOfTheFlow) {
  const Vector p = swing().values(), start{{0.4, -0.2}};
  Matrix s = Matrix::Zero(2, 5);
  s.leftCols(2).setIdentity();
  end_of_swing(p, start, &s);
  constexpr double kMove = 1e-3;
  for (Index j = 0; j < 5; ++j) {
    Vector x_above = start, x_below = start, p_above = p, p_below = p;
    (j < 2 ? x_above[j] : p_above[j - 2]) += kMove;
    (j < 2 ? x_below[j] : p_below[j - 2]) -= kMove;
    const Vector difference =
        (end_of_swing(p_above, x_above, nullptr) - end_of_swing(p_below, x_below, nullptr)) /
        (2.0 * kMove);
    EXPECT_LT((s.col(j) - difference).norm(), 1e-5) << j;
  }
}

// The slow manifold, where y is in balance with what makes it, and the sum that is conserved.
TEST(Radau, FollowsRobertsonsReactionsTo1e5SecondsInFewSteps) {
  const OdeModel model = support::robertson();
  Rates rates(model);
  long steps = 0;
  const auto drive = [&](double t, double* slots) {
    ++steps;
    slots[0] = t;
  };
  Vector x{{1.0, 0.0, 0.0}};
  Matrix s = Matrix::Identity(3, 3);
  RadauFlow flow;
  ASSERT_TRUE(flow.advance(rates, drive, 0.0, 40.0, x, &s));
  EXPECT_NEAR(x[0], 0.7158270688, 1e-6) << "Hairer and Wanner's value";
  ASSERT_TRUE(flow.advance(rates, drive, 40.0, 1e5, x, &s));
  EXPECT_NEAR(x.sum(), 1.0, 1e-9);
  EXPECT_NEAR(0.04 * x[0] / (1e4 * x[1] * x[2] + 3e7 * x[1] * x[1]), 1.0, 1e-4);
  EXPECT_LT((s.colwise().sum().array() - 1.0).abs().maxCoeff(), 1e-6)
      << "deviations keep their sum, too";
  EXPECT_LT(steps, 4 * 1000) << "four times a step";
}

TEST(Radau, MakesAsManyStepsAsItMay) {
  Rates rates(swing());
  rates.set(swing().values());
  RadauFlow flow;
  Vector x{{0.4, -0.2}};
  flow.allow(1000);
  ASSERT_TRUE(flow.advance(rates, Drive{rates}, 0.2, 1.7, x));
  const long needed = 1000 - flow.allowed();
  ASSERT_GT(needed, 1);
  for (const long less : {0L, 1L}) {
    RadauFlow other;
    x << 0.4, -0.2;
    other.allow(needed - less);
    EXPECT_EQ(other.advance(rates, Drive{rates}, 0.2, 1.7, x), less == 0);
  }
}

// A chain that starts with its first state alone: x_i = t^i exp(-t)/i!.
TEST(Radau, StatesMayRiseFromZeroByAHighPowerOfTheTime) {
  constexpr Index kLength = 12;
  std::string text = "dx0/dt = -x0\n";
  for (Index i = 1; i < kLength; ++i)
    text += "dx" + std::to_string(i) + "/dt = x" + std::to_string(i - 1) + " - x" +
            std::to_string(i) + "\n";
  const OdeModel model = parse_ode(text, "chain");
  Rates rates(model);
  Vector x = Vector::Unit(kLength, 0);
  RadauFlow flow;
  ASSERT_TRUE(flow.advance(
      rates, [](double t, double* slots) { slots[0] = t; }, 0.0, 2.0, x));
  double exact = std::exp(-2.0);
  for (Index i = 0; i < kLength; ++i) {
    EXPECT_NEAR(x[i], exact, 1e-6 * exact) << i;
    exact *= 2.0 / static_cast<double>(i + 1);
  }
}

TEST(Radau, ARunawayIsNoPath) {
  const OdeModel model = parse_ode("dx/dt = x^2\n", "runaway");
  Rates rates(model);
  Vector x{{1.0}};
  RadauFlow flow;
  EXPECT_FALSE(flow.advance(
      rates, [](double t, double* slots) { slots[0] = t; }, 0.0, 2.0, x));
}

TEST(Radau, ExplicitStepsAreHeldAgainstTheirBoundOfStability) {
  const Matrix decay{{-1000.0, 5.0}, {0.0, -1.0}};
  EXPECT_TRUE(is_beyond_explicit_steps(decay, 2.8e-3));
  EXPECT_FALSE(is_beyond_explicit_steps(decay, 2.7e-3));
  EXPECT_FALSE(is_beyond_explicit_steps(-decay, 2.8e-3)) << "what grows is not stiff";
}

// x' = u - 1/2 sqrt(x) from 0, u = 0 up to t = 40 and 1 from then on, where time is so far from
// 0 that steps of a small fraction of the first values could not be made.
TEST(RadauFlow, AStateThatLeavesZeroLater) {
  const OdeModel model = parse_ode("input u hold zero\ndx/dt = u - 0.5*sqrt(x)\n", "m.ode");
  Rates rates(ParametrisedModel(model, {}), Outside::AsAtTheEdge);
  RadauFlow flow;
  Vector x = Vector::Zero(1);
  double u = 0.0;
  const auto drive = [&](double t, double* slots) {
    slots[1] = u;
    slots[2] = t;
  };
  ASSERT_TRUE(flow.advance(rates, drive, 0.0, 40.0, x));
  EXPECT_EQ(x[0], 0.0);
  u = 1.0;
  ASSERT_TRUE(flow.advance(rates, drive, 40.0, 41.0, x));
  // With s = sqrt(x): t = -4 s - 8 log(1 - s/2) after the jump.
  const double s = std::sqrt(x[0]);
  EXPECT_NEAR(-4.0 * s - 8.0 * std::log1p(-0.5 * s), 1.0, 1e-6);
}

}  // namespace
}  // namespace lacuna
