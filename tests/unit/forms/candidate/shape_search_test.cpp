// SPDX-License-Identifier: MIT
// Searches for the shapes of forms.
#include "forms/candidate/shape_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "forms/candidate/gauss_newton.hpp"
#include "forms/candidate/nelder_mead.hpp"

namespace lacuna {
namespace {

const SimplexSettings kSearch{.reach = 0.05, .unnoticed = 1e-9, .evaluations = 1000};

TEST(ShapeSearch, FindsTheLeastValueOfKnownFunctions) {
  const auto bend = [](const Vector& x) { return std::abs(x[0] - 0.25); };
  EXPECT_NEAR(least_in_cube(bend, Vector::Constant(1, 0.9), kSearch)[0], 0.25, 1e-6);
  const auto valley = [](const Vector& x) {
    return std::pow(0.6 - x[0], 2) + 100.0 * std::pow(x[1] - x[0] * x[0], 2);
  };
  EXPECT_LT((least_in_cube(valley, Vector{{0.3, 0.6}}, kSearch) - Vector{{0.6, 0.36}}).norm(),
            1e-3);
}

TEST(ShapeSearch, StaysInTheCubeAndFindsWhatLiesOnItsFaces) {
  double least = 1.0, most = 0.0;
  const auto slope = [&](const Vector& x) {
    least = std::min(least, x.minCoeff());
    most = std::max(most, x.maxCoeff());
    return x[0] + std::pow(x[1] - 0.5, 2) - 2.0 * x[2];
  };
  // Rounding may leave a start beside the cube.
  const Vector start{{0.4, 0.99, 1.0 + 1e-15}};
  const Vector found = least_in_cube(slope, start, kSearch);
  EXPECT_LT((found - Vector{{0.0, 0.5, 1.0}}).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_GE(least, 0.0);
  EXPECT_LE(most, 1.0);
}

TEST(ShapeSearch, LeavesAFaceThatItHasCollapsedOnto) {
  const auto hook = [](const Vector& x) {
    const double away = std::abs(x[1] - 0.8);
    return away > 0.02 ? 10.0 + away - 0.1 * x[0] : std::abs(x[0] - 0.2);
  };
  const Vector found = least_in_cube(hook, Vector{{0.98, 0.1}}, kSearch);
  EXPECT_NEAR(found[0], 0.2, 1e-4);
  EXPECT_LT(std::abs(found[1] - 0.8), 0.021);
}

TEST(ShapeSearch, IsNeverWorseThanItsStart) {
  const auto ragged = [](const Vector& x) { return std::sin(40.0 * x[0]) + x[0]; };
  for (double start = 0.0; start <= 1.0; start += 0.125)
    EXPECT_LE(ragged(least_in_cube(ragged, Vector::Constant(1, start), kSearch)),
              ragged(Vector::Constant(1, start)));
  const auto nowhere = [](const Vector&) { return std::numeric_limits<double>::quiet_NaN(); };
  EXPECT_EQ(least_in_cube(nowhere, Vector::Constant(1, 0.5), kSearch)[0], 0.5);
}

TEST(ShapeSearch, EndsWithTheEvaluationsThatItMayMakeAndWithExceptions) {
  int count = 0;
  const auto counted = [&](const Vector& x) {
    ++count;
    return std::sin(9.0 * x[0]) * std::cos(7.0 * x[1]);
  };
  least_in_cube(counted, Vector{{0.4, 0.6}}, {.reach = 0.05, .evaluations = 30});
  EXPECT_GE(count, 20);
  EXPECT_LE(count, 34);
  const auto stopped = [](const Vector&) -> double { throw std::domain_error("stop"); };
  EXPECT_THROW(least_in_cube(stopped, Vector::Constant(2, 0.5), kSearch), std::domain_error);
}

TEST(ShapeSearch, OfManyNumbersIsBySbplxWhereThatIsAskedFor) {
  const SimplexSettings by_sbplx{.reach = 0.15, .evaluations = 600, .method = CubeMethod::Sbplx};
  const SimplexSettings by_size{.reach = 0.15, .evaluations = 600};
  const auto least_of = [](const SimplexSettings& settings, int& calls) {
    const auto bowl = [&](const Vector& at) {
      ++calls;
      double sum = std::pow(at[0] + 0.2, 2);
      for (Index i = 1; i < at.size(); ++i)
        sum += static_cast<double>(i * i) * std::pow(at[i] - 0.1 * static_cast<double>(i), 2);
      return sum;
    };
    return bowl(least_in_cube(bowl, Vector::Constant(8, 0.9), settings));
  };
  int calls = 0, others = 0;
  const double least = least_of(by_sbplx, calls), other = least_of(by_size, others);
  EXPECT_LE(calls, 605);
  EXPECT_NEAR(least, 0.04, 1e-3);
  if (searches_by_nlopt()) {
    EXPECT_LT(least, other);
  }
}

/// Profiles of one parameter, smooth and with bends; what is missed of the least value at most,
/// and the evaluations of all searches.
struct Effort {
  double missed = 0.0;
  int evaluations = 0;
};

template <class Search>
Effort effort_of(Search search) {
  Effort effort;
  const SimplexSettings settings{.reach = 0.05, .unnoticed = 0.01, .evaluations = 40};
  for (double centre = 0.05; centre < 1.0; centre += 0.1)
    for (double start = 0.1; start < 1.0; start += 0.2)
      for (const double power : {1.0, 2.0}) {
        const auto profile = [&](const Vector& x) {
          ++effort.evaluations;
          return 1e3 * std::pow(std::abs(x[0] - centre), power);
        };
        const Vector found = search(profile, Vector::Constant(1, start), settings);
        effort.missed =
            std::max(effort.missed, 1e3 * std::pow(std::abs(found[0] - centre), power));
      }
  return effort;
}

TEST(ShapeSearch, ByNloptOfOneParameterIsNearerThanTheOwnMethod) {
  const Effort own = effort_of(nelder_mead), by_nlopt = effort_of(least_in_cube);
  if (!searches_by_nlopt()) {
    EXPECT_EQ(by_nlopt.evaluations, own.evaluations);
    return;
  }
  EXPECT_LT(by_nlopt.missed, 0.5 * own.missed);
  EXPECT_LT(by_nlopt.evaluations, 1.5 * own.evaluations);
}

/// Rosenbrock's valley with its least value 0 at (0.6, 0.36).
constexpr auto kValley = [](const Vector& x) {
  return std::pow(0.6 - x[0], 2) + 100.0 * std::pow(x[1] - x[0] * x[0], 2);
};

TEST(NelderMead, StepsGrowOnALongWayDown) {
  // 0.85 away by steps of 0.01 that double: 7 of them, of two evaluations each.
  const auto far = [](const Vector& x) { return std::abs(x[0] - 0.9); };
  const Vector found = nelder_mead(far, Vector::Constant(1, 0.05),
                                   {.reach = 0.01, .unnoticed = 0.0, .evaluations = 24});
  EXPECT_NEAR(found[0], 0.9, 0.1);
}

TEST(NelderMead, EndsAfterAboutSoManyEvaluationsOrWhenNothingChanges) {
  int count = 0;
  const auto counted = [&](const Vector& x) {
    ++count;
    return kValley(x);
  };
  nelder_mead(counted, Vector{{0.05, 0.1}}, {.reach = 0.05, .evaluations = 30});
  EXPECT_GE(count, 30);
  EXPECT_LE(count, 34) << "the last step takes four at most: reflected, contracted, shrunk";
  count = 0;
  nelder_mead(counted, Vector{{0.05, 0.1}}, {.reach = 0.05, .unnoticed = 1e3});
  EXPECT_EQ(count, 3) << "the first simplex";
}

TEST(GaussNewton, FindsTheShapeOfACurveToTheLastDigitsInFewEvaluations) {
  const Vector t = Vector::LinSpaced(50, 0.0, 1.0);
  int evaluations = 0;
  const auto left = [&](const Vector& p) -> Vector {
    ++evaluations;
    return (p[1] * (-5.0 * p[0] * t.array()).exp() - 0.7 * (-5.0 * 0.3 * t.array()).exp())
        .matrix();
  };
  const CubeMinimum found = gauss_newton(left, Vector{{0.5, 0.5}});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.point[0], 0.3, 1e-9);
  EXPECT_NEAR(found.point[1], 0.7, 1e-9);
  EXPECT_LT(evaluations, 40);
}

TEST(GaussNewton, FindsTheLeastOfWhatLeavesResiduals) {
  // (p - 1/4)^2 + 1/4 (p - 1)^2 is least where 5 p = 2.
  const auto left = [](const Vector& p) { return Vector{{p[0] - 0.25, 0.5 * (p[0] - 1.0)}}; };
  const CubeMinimum found = gauss_newton(left, Vector::Constant(1, 0.9));
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.point[0], 0.4, 1e-5);
  EXPECT_NEAR(found.squares, 0.15 * 0.15 + 0.3 * 0.3, 1e-9);
}

TEST(GaussNewton, StaysInTheCubeAndEndsOnItsFaces) {
  double least = 1.0, most = 0.0;
  const auto left = [&](const Vector& p) {
    least = std::min(least, p.minCoeff());
    most = std::max(most, p.maxCoeff());
    return Vector{{p[0] + 0.5, p[1] - 0.5, 2.0 * (p[2] - 1.5)}};
  };
  const CubeMinimum found = gauss_newton(left, Vector{{0.4, 0.99, 1.0 + 1e-15}});
  EXPECT_TRUE(found.converged);
  EXPECT_LT((found.point - Vector{{0.0, 0.5, 1.0}}).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GE(least, 0.0);
  EXPECT_LE(most, 1.0);
}

TEST(GaussNewton, NoStepIsLongerThanItsReach) {
  Vector before = Vector::Constant(1, 0.05);
  double longest = 0.0;
  const auto left = [&](const Vector& p) {
    longest = std::max(longest, (p - before).cwiseAbs().maxCoeff());
    before = p;
    return Vector{{p[0] - 0.95}};
  };
  EXPECT_NEAR(gauss_newton(left, before, {.reach = 0.1}).point[0], 0.95, 1e-9);
  EXPECT_LT(longest, 0.1 + 1e-5);
}

TEST(GaussNewton, SaysWhereItDoesNotConverge) {
  const auto jump = [](const Vector& p) { return Vector{{p[0] < 0.3 ? 2.0 : 1.0}}; };
  const CubeMinimum flat = gauss_newton(jump, Vector::Constant(1, 0.1));
  EXPECT_FALSE(flat.converged);
  EXPECT_EQ(flat.point[0], 0.1);
  const auto one = [](const Vector& p) { return Vector{{p[0] + p[1] - 0.3, 1.0}}; };
  EXPECT_FALSE(gauss_newton(one, Vector{{0.2, 0.4}}).converged);  // the sum alone counts
  const auto nowhere = [](const Vector& p) {
    return Vector::Constant(p.size(), std::numeric_limits<double>::quiet_NaN()).eval();
  };
  const CubeMinimum none = gauss_newton(nowhere, Vector::Constant(1, 0.5));
  EXPECT_FALSE(none.converged);
  EXPECT_EQ(none.point[0], 0.5);
}

TEST(GaussNewton, EndsWhereWhatIsWantedIsFarAndStepsGainLittle) {
  int evaluations = 0;
  // |r|^2 is least at p = 1/2, where 4 is left; each step there gains less than half.
  const auto left = [&](const Vector& p) {
    ++evaluations;
    return Vector{{p[0] - 0.5, 2.0}};
  };
  const Vector start = Vector::Constant(1, 0.1);
  const CubeMinimum far = gauss_newton(left, start, {.wanted = 0.9});
  EXPECT_FALSE(far.converged);
  EXPECT_EQ(far.point[0], 0.1);
  EXPECT_EQ(evaluations, 2);
  const CubeMinimum near = gauss_newton(left, start, {.wanted = 1.1});
  EXPECT_TRUE(near.converged);
  EXPECT_NEAR(near.point[0], 0.5, 1e-6);
  // A step that halves what is there is taken, however far that is.
  const auto steep = [](const Vector& p) { return Vector{{9.0 * (p[0] - 0.5), 2.0}}; };
  EXPECT_NEAR(gauss_newton(steep, start, {.reach = 1.0, .wanted = 0.1}).point[0], 0.5, 1e-6);
}

TEST(GaussNewton, IsNeverWorseThanItsStart) {
  const auto ragged = [](const Vector& p) {
    return Vector{{std::sin(40.0 * p[0]), p[0] - 0.5}};
  };
  for (double start = 0.0; start <= 1.0; start += 0.125) {
    const Vector at = Vector::Constant(1, start);
    EXPECT_LE(gauss_newton(ragged, at).squares, ragged(at).squaredNorm());
  }
}

}  // namespace
}  // namespace lacuna
