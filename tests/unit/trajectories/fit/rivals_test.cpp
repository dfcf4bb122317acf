// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/fit/rivals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/expect_error.hpp"
#include "support/grey_box.hpp"

namespace lacuna {
namespace {

using testing::expect_error;

Fit fitted(const std::string& text, const Dataset& columns) {
  const SystemModel system = parse_ode_system(text, "m.ode");
  return fit(system, model_view(system.model(), columns, FiniteDifferences{}), {});
}

constexpr const char* kFirst = "param k = 0.5 in 0.01..50\ndx/dt = -k*x\ny = x\n";
constexpr const char* kSecond = "param k = 0.5 in 0.01..50\ndx/dt = -k*x^2\ny = x\n";
constexpr const char* kBoth =
    "param k = 0.5 in 0.01..50\nparam l = 0.01 in 0..50\ndx/dt = -k*x - l*x^2\n"
    "y = x\n";

Dataset record_of(const std::string& truth, std::uint64_t seed = 1) {
  return support::grey_box_columns(
      parse_ode(truth, "t.ode"),
      {.start = Vector::Constant(1, 3.0),
       .step = 0.1,
       .samples = 60,
       .noise = 0.03,
       .seed = seed});
}

TEST(CompareFits, CriteriaAreThoseOfTheFormulas) {
  const Dataset data = record_of("dx/dt = -0.5*x\ny = x\n");
  const RivalComparison found = compare_fits({{"one", fitted(kFirst, data)}});
  ASSERT_EQ(found.rivals.size(), 1u);
  const FitRival& one = found.rivals[0];
  EXPECT_EQ(found.values, 60.0);
  EXPECT_EQ(one.unknowns, 3.0) << "k, the start, the deviation of the noise";
  const double rmse = fitted(kFirst, data).quality[0].rmse;
  const double log_likelihood =
      -30.0 * (std::log(2.0 * std::numbers::pi * rmse * rmse) + 1.0);
  EXPECT_NEAR(one.log_likelihood, log_likelihood, 1e-6);
  EXPECT_NEAR(one.aicc, -2.0 * log_likelihood + 6.0 + 24.0 / 56.0, 1e-6);
  EXPECT_NEAR(one.bic, -2.0 * log_likelihood + 3.0 * std::log(60.0), 1e-6);
  EXPECT_TRUE(one.is_tied);
}

TEST(CompareFits, TheRightStructureIsAhead) {
  const Dataset data = record_of("dx/dt = -0.4*x^2\ny = x\n");
  const RivalComparison found =
      compare_fits({{"first", fitted(kFirst, data)}, {"second", fitted(kSecond, data)}});
  EXPECT_EQ(found.rivals[0].name, "second");
  EXPECT_FALSE(found.rivals[1].is_tied);
  EXPECT_GT(found.rivals[1].behind, 1.96);
}

TEST(CompareFits, ATermThatIsNotThereIsTied) {
  int ahead = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Dataset data = record_of("dx/dt = -0.5*x\ny = x\n", seed);
    const RivalComparison found =
        compare_fits({{"both", fitted(kBoth, data)}, {"first", fitted(kFirst, data)}});
    ahead += found.rivals[1].is_tied ? 0 : 1;
  }
  EXPECT_LE(ahead, 1);
}

TEST(CompareFits, WhatIsNotedAtEveryFitIsSaidOnce) {
  const Dataset data = record_of("dx/dt = -0.5*x\ny = x\n");
  Fit first = fitted(kFirst, data), both = fitted(kBoth, data);
  first.notes = {"of the first", "no gap on records held out"};
  both.notes = {"no gap on records held out", "of both"};
  EXPECT_EQ(compare_fits({{"first", first}, {"both", both}}).notes,
            std::vector<std::string>{"no gap on records held out"});
}

TEST(CompareFits, OtherColumnsAreAnError) {
  const Dataset data = record_of("dx/dt = -0.5*x\ny = x\n");
  Fit other = fitted(kFirst, data);
  other.quality[0].channel = "z";
  expect_error<DataError>([&] { compare_fits({{"a", fitted(kFirst, data)}, {"b", other}}); },
                          "b", "not compared with the same columns as a", "outputs");
  EXPECT_THROW(compare_fits({}), ArgumentError);
}

}  // namespace
}  // namespace lacuna
