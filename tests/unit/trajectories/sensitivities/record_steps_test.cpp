// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/record_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lacuna/records/channels/node_grid.hpp"

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

TEST(EndsOfSteps, AreTheSameInBlocksAndWithKnownBegins) {
  constexpr Index kSteps = 300;
  const Variables variables{{"x"}, {"u"}};
  Rates rates(OdeModel({{"x", ""}}, {{"u", ""}},
                       {{{Term::parse("sin(3*t)*x", variables), 1.0},
                         {Term::parse("x^2", variables), -1.0},
                         {Term::parse("cos(u)", variables), 1.0}}}));
  const Vector time = Vector::LinSpaced(kSteps + 1, 0.0, 30.0);
  Matrix values(kSteps + 1, 2);
  values << time.array().sin(), time.array().cos();
  const StepSlots grid(node_slots(time, values, 2), 1, {});
  std::vector<Index> steps;
  Matrix begin_rates(kSteps, 1);
  for (Index i = 0; i < kSteps; ++i) {
    steps.push_back(i);
    begin_rates.row(i) << std::sin(3.0 * time[i]) * values(i, 0) - std::pow(values(i, 0), 2) +
                              std::cos(values(i, 1));
  }
  for (const int parts : {1, 2, 4}) {
    const Matrix all = ends_of_steps(rates, grid, steps, parts);
    EXPECT_LT((all - ends_of_steps(rates, grid, steps, begin_rates, parts)).cwiseAbs().maxCoeff(),
              1e-14);
    for (const Index i : {0, 127, 128, 299})
      EXPECT_EQ(all(i, 0), ends_of_steps(rates, grid, {i}, parts)(0, 0)) << i;
  }
}

TEST(PartsFor, AreAsManyAsTheAccuracyNeeds) {
  Rates rates = leaking();
  const std::vector<int> parts =
      parts_for(rates, slots(), {Vector::Constant(1, 1e-7), Vector::Constant(1, 1.0)}).parts;
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_GT(parts[0], 1);
  EXPECT_LT(worst(parts[0]), 1e-7);
  EXPECT_EQ(parts[1], 1);
  EXPECT_EQ(parts_for(rates, slots(), {Vector::Zero(1)}).parts.front(), 32) << "no more than that";
}

}  // namespace
}  // namespace lacuna
