// SPDX-License-Identifier: MIT
#include "lacuna/flow/record_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "lacuna/flow/node_grid.hpp"

namespace lacuna {
namespace {

/// x' = t^2 - x + u: with u = 2 t the solution is t^2 + (x0) exp(-t).
Rates leaking() {
  const Variables variables{{"x"}, {"u"}};
  return Rates(OdeModel({{"x", ""}}, {{"u", ""}},
                        {{{Term::parse("t^2", variables), 1.0},
                          {Term::parse("x", variables), -1.0},
                          {Term::parse("u", variables), 1.0}}}));
}

/// Begins on the solution, irregular steps.
StepSlots slots() {
  const Vector time{{0.0, 0.2, 0.3, 0.6, 0.8, 1.0}};
  Matrix values(6, 2);
  values << time.array().square() + 3.0 * (-time.array()).exp(), 2.0 * time;
  return {node_slots(time, values, 2), 1, {}};
}

std::vector<Index> all_steps() { return {0, 1, 2, 3, 4}; }

double worst(int parts) {
  Rates rates = leaking();
  const StepSlots grid = slots();
  const Matrix ends = ends_of_steps(rates, grid, all_steps(), parts);
  double largest = 0.0;
  for (Index i = 0; i < 5; ++i)
    largest = std::max(largest, std::abs(ends(i, 0) - grid.nodes(2 * i + 2, 0)));
  return largest;
}

TEST(EndsOfSteps, FollowTheSolutionWithOrderFour) {
  EXPECT_LT(worst(1), 1e-3);
  EXPECT_NEAR(std::log2(worst(2) / worst(4)), 4.0, 0.3);
}

TEST(EndsOfSteps, InputsAreCubicsBetweenNodes) {
  const Vector time{{0.0, 0.2, 0.5, 0.6, 0.9}};
  const Variables variables{{"x"}, {"u"}};
  Rates rates(OdeModel({{"x", ""}}, {{"u", ""}}, {{{Term::parse("u", variables), 1.0}}}));
  Matrix values(5, 2);
  values << Vector::Zero(5), time.array().cube();
  const StepSlots grid(node_slots(time, values, 2), 1, {});
  const Matrix ends = ends_of_steps(rates, grid, {0, 1, 2, 3}, 4);
  for (Index i = 0; i < 4; ++i)
    EXPECT_NEAR(ends(i, 0), 0.25 * (std::pow(time[i + 1], 4) - std::pow(time[i], 4)), 1e-15);
}

TEST(PartsFor, AreAsManyAsTheAccuracyNeeds) {
  Rates rates = leaking();
  EXPECT_EQ(parts_for(rates, slots(), Vector::Constant(1, 1.0)), 1);
  const int parts = parts_for(rates, slots(), Vector::Constant(1, 1e-7));
  EXPECT_GT(parts, 1);
  EXPECT_LT(worst(parts), 1e-7);
}

/// A(t) = [0 1; -4 - t, -0.3] at begin, middle and end of one step.
Matrix slopes_of(double from, double h) {
  Matrix slopes(4, 3);
  for (Index node = 0; node < 3; ++node)
    slopes.col(node) << 0.0, -4.0 - (from + 0.5 * h * static_cast<double>(node)), 1.0, -0.3;
  return slopes;
}

/// d' = A d + share of e, in many small steps of the midpoint rule.
Vector integrated(Vector d, double from, double h, const std::function<Vector(double)>& rate) {
  constexpr int kParts = 20000;
  Matrix a(2, 2);
  const double step = h / kParts;
  const auto f = [&](double s, const Vector& x) -> Vector {
    a << 0.0, 1.0, -4.0 - (from + s), -0.3;
    return a * x + rate(s / h);
  };
  for (int i = 0; i < kParts; ++i) {
    const Vector half = d + 0.5 * step * f(i * step, d);
    d += step * f((i + 0.5) * step, half);
  }
  return d;
}

// One parabola alone is a rate with a large third derivative: Simpson's rule is less accurate
// for it than for the smooth rates that the three make up.
TEST(StepResponses, AreThoseOfAFineIntegration) {
  const double h = 0.05;
  for (const int parts : {1, 4}) {
    const StepResponses found =
        step_responses(slopes_of(1.0, h), {}, Vector::Constant(1, h), {2, parts});
    const double tolerance = parts == 1 ? 2e-5 : 1e-7;
    for (Index j = 0; j < 2; ++j) {
      const Vector column = integrated(Vector::Unit(2, j), 1.0, h,
                                       [](double) -> Vector { return Vector::Zero(2); });
      EXPECT_LT((found.transition.col(0).segment(2 * j, 2) - column).norm(), 0.1 * tolerance);
      const std::function<double(double)> parabolas[] = {
          [](double s) { return (1.0 - s) * (1.0 - 2.0 * s); },
          [](double s) { return 4.0 * s * (1.0 - s); },
          [](double s) { return s * (2.0 * s - 1.0); }};
      for (Index q = 0; q < 3; ++q) {
        const Vector w = integrated(Vector::Zero(2), 1.0, h, [&](double s) -> Vector {
          return parabolas[q](s) * Vector::Unit(2, j);
        });
        EXPECT_LT((found.response.col(0).segment(6 * j + 2 * q, 2) - w).norm(), tolerance);
      }
    }
  }
}

}  // namespace
}  // namespace lacuna
