// SPDX-License-Identifier: MIT
#include "trajectories/fit/fit_numbers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/grey_box.hpp"
#include "trajectories/fit/fit_search.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

/// A model at its minimum on a record of another one, with what is known of its numbers.
struct Known {
  Known(const std::string& text, const Dataset& data, bool curves = false)
      : system(parse_ode_system(text, "m.ode")),
        model(system.parametrised()),
        engine(fit_engine(model, fit_records(model, data))),
        unknowns(fit_unknowns(model, {})) {
    set_substeps(engine, 4);
    const FitMinimum minimum =
        minimise(engine, unknowns, {model.values().transpose(), engine.records.starts}, {}, 50,
                 {});
    engine.sigma = residual_rms(engine, unknowns, minimum.path);
    known = known_numbers(engine, unknowns, minimum,
                          curves ? ProfileUse::Curves : ProfileUse::Cheap, {});
    numbers = numbers_of(engine, unknowns, known);
  }
  SystemModel system;
  ParametrisedModel model;
  FitEngine engine;
  FitUnknowns unknowns;
  KnownNumbers known;
  std::vector<FittedParameter> numbers;
};

Dataset decay(Index samples = 40) {
  return support::grey_box(parse_ode("dx/dt = -0.5*x\ny = x\n", "d.ode"),
                           {.start = Vector::Constant(1, 2.0),
                            .step = 0.2,
                            .samples = samples,
                            .noise = 0.03});
}

TEST(NumbersOf, IntervalsAreThoseOfTheProfile) {
  const Known at("param k = 0.6 in 0.01..20\ndx/dt = -k*x\ny = x\n", decay(), true);
  ASSERT_TRUE(at.known.profiles[0]);
  ASSERT_TRUE(at.numbers[0].ci95);
  EXPECT_EQ((*at.numbers[0].ci95)[0], *at.known.profiles[0]->low);
  EXPECT_EQ((*at.numbers[0].ci95)[1], *at.known.profiles[0]->high);
  // About as wide as the standard error says: the likelihood is nearly a parabola.
  EXPECT_NEAR(((*at.numbers[0].ci95)[1] - (*at.numbers[0].ci95)[0]) / 2.0,
              at.known.reach[0] * *at.numbers[0].standard_error,
              0.1 * at.known.reach[0] * *at.numbers[0].standard_error);
  const std::vector<FitProfile> curves = curves_of(at.engine, at.unknowns, at.known);
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves[0].name, "k");
  EXPECT_TRUE(std::is_sorted(curves[0].values.begin(), curves[0].values.end()));
}

TEST(NumbersOf, ANumberThatReachesItsRangeIsNotKnown) {
  const Known at("param k = 0.5 in 0.01..0.505\ndx/dt = -k*x\ny = x\n", decay());
  EXPECT_FALSE(at.numbers[0].ci95);
  EXPECT_FALSE(at.numbers[0].standard_error);
  EXPECT_FALSE(at.numbers[0].at_most);
  ASSERT_TRUE(at.numbers[0].at_least);
  EXPECT_GT(*at.numbers[0].at_least, 0.4);
}

TEST(NumbersOf, ARateNearZeroHasAnUpperLimitOnly) {
  // A second way out that is not there.
  const Known at("param k = 0.5 in 0.01..20\nparam l = 0.01 in 0..20\ndx/dt = -k*x - l*x^2\n"
                 "y = x\n",
                 decay());
  EXPECT_FALSE(at.numbers[1].ci95);
  ASSERT_TRUE(at.numbers[1].at_most);
  EXPECT_FALSE(at.numbers[1].at_least);
  EXPECT_LT(*at.numbers[1].at_most, 0.2);
}

TEST(NumbersOf, OthersAreNoBetterKnownBecauseANumberStandsAtItsBound) {
  // With l held at 0 the error of k is that of k alone; the profile lets l go.
  const Known alone("param k = 0.5 in 0.01..20\ndx/dt = -k*x\ny = x\n", decay());
  const Known both("param k = 0.5 in 0.01..20\nparam l = 0 in 0..20\ndx/dt = -k*x - l*x^2\n"
                   "y = x\n",
                   decay());
  ASSERT_TRUE(alone.numbers[0].ci95 && both.numbers[0].ci95);
  const double lower = (*alone.numbers[0].ci95)[0];
  EXPECT_LT((*both.numbers[0].ci95)[0], lower - 0.2 * (alone.numbers[0].value - lower));
}

TEST(AddLimits, SaysWhatIsKnownOfNumbersWithoutAnInterval) {
  std::vector<FittedParameter> numbers(5);
  numbers[0].name = "a";
  numbers[0].at_least = 2.0;
  numbers[1].name = "b";
  numbers[1].at_most = 3.0;
  numbers[2].name = "c";
  numbers[3].name = "d";
  numbers[3].ci95 = {{1.0, 2.0}};
  numbers[4].name = "e";
  std::vector<FitCombination> combinations{{{"e", "f"}, "e and f only as e*f"}};
  add_limits(numbers, combinations);
  ASSERT_EQ(combinations.size(), 4u);
  EXPECT_EQ(combinations[1].message, "a at least 2, with no upper limit");
  EXPECT_EQ(combinations[2].message, "b at most 3, with no lower limit");
  EXPECT_THAT(combinations[3].message, HasSubstr("c: the records do not determine it"));
}

}  // namespace
}  // namespace lacuna
