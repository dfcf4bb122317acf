// SPDX-License-Identifier: MIT
#include "trajectories/fit/starts/other_starts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "lacuna/trajectories/fit/fit.hpp"
#include "support/grey_box.hpp"

namespace lacuna {
namespace {

/// Three numbers: a wide range, one through 0, and none.
struct Problem {
  Problem()
      : system(parse_ode_system("param k = 1 in 1e-4..1e4\nparam b = 0 in -2..2\nparam c = 3\n"
                                "dx/dt = b + c - k*x\ny = x\ninitial x = 1 fixed\n",
                                "m.ode")),
        model(system.parametrised()),
        engine(fit_engine(model, fit_records(model, record()))),
        unknowns(fit_unknowns(model, {})),
        start{model.values().transpose(), engine.records.starts} {}

  static Dataset record() {
    return support::grey_box(parse_ode("dx/dt = 3 - x\ny = x\n", "t.ode"),
                             {.start = Vector::Constant(1, 1.0), .step = 0.1, .samples = 20});
  }

  SystemModel system;
  ParametrisedModel model;
  FitEngine engine;
  FitUnknowns unknowns;
  FitPoint start;
};

Index place_of(const Problem& problem, double lower) {
  for (Index p = 0; p < problem.unknowns.lower.size(); ++p)
    if (problem.unknowns.lower[p] == lower) return p;
  return -1;
}

TEST(StartsOverRanges, EveryPartOfARangeHasOne) {
  Problem problem;
  Random random(1);
  const std::vector<FitPoint> starts =
      starts_over_ranges(problem.engine, problem.unknowns, problem.start, 16, 3.0, random);
  ASSERT_EQ(starts.size(), 16u);
  const Index wide = place_of(problem, 1e-4), signed_one = place_of(problem, -2.0);
  ASSERT_GE(wide, 0);
  ASSERT_GE(signed_one, 0);
  std::set<int> decades, quarters;
  for (const FitPoint& one : starts) {
    decades.insert(static_cast<int>(std::floor(2.0 * std::log10(one.parameters(0, wide)))));
    quarters.insert(static_cast<int>(std::floor(4.0 * one.parameters(0, signed_one))));
  }
  EXPECT_EQ(decades.size(), 16u) << "half decades of 1e-4..1e4";
  EXPECT_EQ(quarters.size(), 16u) << "quarters of -2..2";
}

TEST(StartsOverRanges, WhatHasNoRangeStaysWithinAFactor) {
  Problem problem;
  Random random(2);
  const Index free = place_of(problem, -std::numeric_limits<double>::infinity());
  ASSERT_GE(free, 0);
  const std::vector<FitPoint> starts =
      starts_over_ranges(problem.engine, problem.unknowns, problem.start, 8, 3.0, random);
  ASSERT_FALSE(starts.empty());
  for (const FitPoint& one : starts) {
    const double ratio = one.parameters(0, free) / problem.start.parameters(0, free);
    EXPECT_GE(ratio, 1.0 / 3.0);
    EXPECT_LE(ratio, 3.0);
  }
}

TEST(StartsOverRanges, AWideRangeIsPositiveAndSpansDecades) {
  Problem problem;
  EXPECT_TRUE(has_wide_range(problem.unknowns, 3.0));
  EXPECT_TRUE(is_wide(1e-5, 1e5, 3.0));
  EXPECT_FALSE(is_wide(0.0, 1e5, 3.0));
  EXPECT_FALSE(is_wide(1.0, 10.0, 3.0));
  EXPECT_FALSE(is_wide(1.0, std::numeric_limits<double>::infinity(), 3.0));
}

}  // namespace
}  // namespace lacuna
