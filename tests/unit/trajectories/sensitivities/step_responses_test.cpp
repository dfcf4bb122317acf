// SPDX-License-Identifier: MIT
// Transitions and responses of steps against a fine integration and against each other.
#include <gtest/gtest.h>

#include <functional>

#include "trajectories/sensitivities/record_steps.hpp"

namespace lacuna {
namespace {

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
