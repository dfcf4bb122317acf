// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/attractor/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"

namespace lacuna {
namespace {

/// An orbit of Lorenz's system with another start and another rho.
Dataset lorenz(double start, double rho) {
  const Variables variables{{"x", "y", "z"}, {}};
  const auto term = [&](const char* text) { return Term::parse(text, variables); };
  const OdeModel model({{"x", ""}, {"y", ""}, {"z", ""}}, {},
                       {{{term("x"), -10.0}, {term("y"), 10.0}},
                        {{term("x"), rho}, {term("y"), -1.0}, {term("x*z"), -1.0}},
                        {{term("z"), -8.0 / 3.0}, {term("x*y"), 1.0}}});
  Solution orbit =
      simulate(model, Rk4{}, Eigen::Vector3d(start, 2.0, 20.0), sample_times(0.0, 0.01, 30000));
  return {"s",
          model.states(),
          {},
          {{"orbit", orbit.time, orbit.states, Matrix(30000, 0), Matrix()}},
          {}};
}

std::vector<std::string> failures(const std::vector<AttractorMeasure>& measures) {
  std::vector<std::string> names;
  for (const AttractorMeasure& measure : measures)
    if (measure.agree == false) names.push_back(measure.name);
  return names;
}

TEST(Comparison, OrbitsOfOneAttractorAgree) {
  const auto measures = compare_attractors(lorenz(1.0, 28.0), lorenz(-3.0, 28.0));
  ASSERT_EQ(measures.size(), 6u);
  EXPECT_THAT(failures(measures), ::testing::IsEmpty());
  // Lyapunov exponent of Lorenz's system: 0.906 (Sprott 2003).
  EXPECT_NEAR(measures[5].first, 0.906, 0.15);
  EXPECT_GT(measures[5].first_half, 0.0);
}

TEST(Comparison, OrbitsOfAnotherOneDoNot) {
  const auto names = failures(compare_attractors(lorenz(1.0, 28.0), lorenz(1.0, 35.0)));
  EXPECT_THAT(names, ::testing::Contains("extent of z"));
  EXPECT_THAT(names, ::testing::Contains("density"));
}

/// A sine whose size in five stretches is given.
Dataset swings(const std::vector<double>& sizes) {
  constexpr Index kEach = 600;
  const Index n = kEach * static_cast<Index>(sizes.size());
  Trajectory run{"swings", Vector::LinSpaced(n, 0.0, 0.05 * static_cast<double>(n - 1)),
                 Matrix(n, 1), Matrix(n, 0), Matrix()};
  for (Index i = 0; i < n; ++i)
    run.states(i, 0) = sizes[static_cast<std::size_t>(i / kEach)] * std::sin(run.time[i]);
  return {"s", {{"x", ""}}, {}, {run}, {}};
}

TEST(Comparison, IntervalsOfBothRecordsCount) {
  // Extents of 2 +- 0 and of 1.8 +- 0.39, Student's t of 1, 1.2, 1.4, 1.6, 1.8.
  const auto measures =
      compare_attractors(swings({1, 1, 1, 1, 1}), swings({0.5, 0.6, 0.7, 0.8, 0.9}));
  EXPECT_LT(measures[0].first_half, 0.01);
  EXPECT_NEAR(measures[0].second_half, 2.776 * std::sqrt(0.1) / std::sqrt(5.0), 0.01);
  EXPECT_EQ(measures[0].agree, true);
}

TEST(Comparison, WhatCannotBeToldIsNotJudged) {
  Dataset a = lorenz(1.0, 28.0), b = a;
  a.trajectories[0] = rows_of(a.trajectories[0], 0, 200);
  b.trajectories[0] = rows_of(b.trajectories[0], 200, 200);
  const auto measures = compare_attractors(a, b);
  EXPECT_FALSE(measures[5].agree);
  EXPECT_NE(measures[5].note, "");
}

TEST(Comparison, WhatIsBeyondTheRangeOfNumbersDoesNotAgree) {
  Dataset huge = lorenz(1.0, 28.0);
  huge.trajectories[0].states *= 1e300;
  EXPECT_THROW(compare_attractors(huge, huge), DataError);
}

TEST(Comparison, PastTheDeadlineMeasuresAreLeftOut) {
  const Dataset orbit = lorenz(1.0, 28.0);
  RunContext context;
  context.progress = [&](const Progress&) {
    context.deadline = std::chrono::steady_clock::now();
  };
  const auto measures = compare_attractors(orbit, orbit, context);
  ASSERT_EQ(measures.size(), 6u);
  for (std::size_t i = 0; i < measures.size(); ++i) {
    EXPECT_EQ(measures[i].left_out, i >= 3) << measures[i].name;  // extents take no time
    EXPECT_EQ(measures[i].agree.has_value(), i < 3) << measures[i].name;
  }
  EXPECT_THROW(compare_attractors(orbit, orbit, context), OutOfTime);
}

}  // namespace
}  // namespace lacuna
