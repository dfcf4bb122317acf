// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/record_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
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

// Transitions and responses of steps against a fine integration and against each other.
/// A(t) = [0 1; -4 - t, -0.3] at begin, middle and end of one step.
Matrix slopes_of(double from, double h) {
  Matrix slopes(4, 3);
  for (Index node = 0; node < 3; ++node)
    slopes.col(node) << 0.0, -4.0 - (from + 0.5 * h * static_cast<double>(node)), 1.0, -0.3;
  return slopes;
}

/// d' = A d + fraction of e, in many small steps of the midpoint rule.
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

/// x' = 1.5 + sign(x) through 0 at t = 1.504, within one of 300 steps.
TEST(PartsFor, OnlyStepsInWhichARateJumpsAreDoneInMore) {
  constexpr Index kSteps = 300;
  const Variables variables{{"x"}, {}};
  Rates rates(OdeModel(
      {{"x", ""}}, {},
      {{{Term::parse("1", variables), 1.5}, {Term::parse("sign(x)", variables), 1.0}}}));
  const Vector time = Vector::LinSpaced(kSteps + 1, 0.0, 3.0), past = time.array() - 1.504;
  const Matrix path = (past.array() < 0.0).select(0.5 * past, 2.5 * past);
  const Matrix begin_rates =
      (path.topRows(kSteps).array() < 0.0)
          .select(Matrix::Constant(kSteps, 1, 0.5), Matrix::Constant(kSteps, 1, 2.5));
  const StepSlots grid(node_slots(time, path, 2), 1, {});
  const Vector accuracy{{1e-3}};
  const FoundParts found = parts_for(rates, grid, {accuracy});
  EXPECT_EQ(found.parts.front(), 1);
  EXPECT_TRUE(found.some_need_more);
  std::vector<Index> steps;
  for (Index i = 0; i < kSteps; ++i) steps.push_back(i);
  const Matrix plain = ends_of_steps(rates, grid, steps, begin_rates, 1);
  EXPECT_GT((plain - path.bottomRows(kSteps)).cwiseAbs().maxCoeff(), 1e-3);
  const auto ends = refined_ends(rates, grid, plain, begin_rates, 1, accuracy);
  ASSERT_TRUE(ends.has_value());
  EXPECT_LT((*ends - path.bottomRows(kSteps)).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_EQ(ends->topRows(150), plain.topRows(150)) << "as they were";
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

/// Slopes of a record of six steps of different lengths, from `from` on.
struct Swings {
  Vector length{{0.05, 0.02, 0.06, 0.05, 0.01, 0.04}};
  Matrix slopes{4, 13};

  explicit Swings(double from) {
    for (Index i = 0; i < 6; ++i) {
      slopes.middleCols(2 * i, 3) = slopes_of(from, length[i]);
      from += length[i];
    }
  }
};

/// Systems that know nothing of each other respond like each alone, however many they are:
/// sizes that are known to the compiler and others, elements that are 0, packs that are not
/// full.
TEST(StepResponses, SystemsSideBySideAreEachAlone) {
  for (const Index systems : {2, 3, 5})
    for (const int parts : {1, 2}) {
      const Index m = 2 * systems;
      Matrix slopes = Matrix::Zero(m * m, 13);
      for (Index s = 0; s < systems; ++s) {
        const Swings one(static_cast<double>(s));
        for (Index e = 0; e < 4; ++e)
          slopes.row((2 * s + e % 2) + m * (2 * s + e / 2)) = one.slopes.row(e);
      }
      const StepResponses all = step_responses(slopes, {}, Swings(0.0).length, {m, parts});
      for (Index s = 0; s < systems; ++s) {
        const Swings one(static_cast<double>(s));
        const StepResponses own = step_responses(one.slopes, {}, one.length, {2, parts});
        for (Index i = 0; i < 6; ++i)
          for (Index j = 0; j < 2; ++j) {
            const Index column = 2 * s + j;
            const Vector moved = all.transition.col(i).segment(m * column, m);
            EXPECT_LT(
                (moved.segment(2 * s, 2) - own.transition.col(i).segment(2 * j, 2)).norm(),
                1e-15);
            EXPECT_LT(moved.norm() - moved.segment(2 * s, 2).norm(), 1e-15);
            for (Index q = 0; q < 3; ++q)
              EXPECT_LT((all.response.col(i).segment(3 * m * column + m * q + 2 * s, 2) -
                         own.response.col(i).segment(6 * j + 2 * q, 2))
                            .norm(),
                        1e-15);
          }
      }
    }
}

}  // namespace
}  // namespace lacuna
