// SPDX-License-Identifier: MIT
#include "trajectories/fit/population/population_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/report/pages/fit_report.hpp"
#include "lacuna/trajectories/fit/rivals.hpp"
#include "support/expect_error.hpp"
#include "support/populations.hpp"

namespace lacuna {
namespace {

using testing::expect_error;
using ::testing::HasSubstr;

/// Decays y = s exp(-k t) of individuals, s and k lognormal.
const SystemModel kDecay = parse_ode_system(
    "param k = 0.4 varies */ 1.5\nparam s = 2 varies */ 1.5\ndx/dt = -k*x\ny = s*x\n"
    "initial x = 1 fixed\n",
    "decay.ode");

Dataset decays(Index count, std::uint64_t seed) {
  return support::individuals(
      kDecay, count, sample_times(0.0, 0.4, 12), seed, [](Random& random) {
        const double k = 0.5 * std::exp(0.3 * random.normal());
        const double s = 3.0 * std::exp(0.2 * random.normal());
        return [=](double t, Random& each) {
          return s * std::exp(-k * t) + 0.05 * each.normal();
        };
      });
}

TEST(PopulationFit, FindsWhatIndividualsWereDrawnFrom) {
  const Fit found = fit(kDecay, decays(30, 1), {});
  ASSERT_EQ(found.numbers.size(), 2u);
  const std::vector<double> typical{0.5, 3.0}, spreads{0.3, 0.2};
  for (std::size_t i = 0; i < 2; ++i) {
    const FittedParameter& number = found.numbers[i];
    ASSERT_TRUE(number.ci95 && number.spread && number.spread->ci95) << number.name;
    EXPECT_LT(std::abs(number.value - typical[i]), 4.0 * *number.standard_error);
    EXPECT_LT(*number.standard_error, 0.1 * typical[i]);
    EXPECT_LT(std::abs(number.spread->value - spreads[i]),
              4.0 * *number.spread->standard_error);
    EXPECT_EQ(number.per_record.size(), 30u);
    EXPECT_LT(number.spread->shrinkage, 0.2);
    ASSERT_TRUE(found.model.parameters()[i].varies);
    EXPECT_NEAR(found.model.parameters()[i].varies->size, std::exp(number.spread->value), 1e-12);
  }
  ASSERT_TRUE(found.population);
  EXPECT_NEAR(found.population->deviations[0], 0.05, 0.01);
  EXPECT_DOUBLE_EQ(found.population->unknowns, 5.0);
  EXPECT_TRUE(standing_of(found).is_sound()) << sentence_of(standing_of(found));
}

// With little noise and many samples each individual is known: the typical value is then the mean
// of logarithms, and its interval that of Student for so many of them.
TEST(PopulationFit, OfIndividualsThatAreKnownIsAMeanWithStudentsInterval) {
  const Fit found = fit(kDecay, decays(6, 5), {});
  const FittedParameter& s = found.numbers.at(1);
  Vector logs(6);
  for (Index r = 0; r < 6; ++r) logs[r] = std::log(s.per_record[static_cast<std::size_t>(r)]);
  EXPECT_NEAR(std::log(s.value), logs.mean(), 0.01);
  const double deviation = std::sqrt((logs.array() - logs.mean()).square().sum() / 5.0);
  const double half = student_quantile_975(5.0) * deviation / std::sqrt(6.0);
  ASSERT_TRUE(s.ci95);
  EXPECT_NEAR(std::log((*s.ci95)[1] / s.value), half, 0.05 * half);
}

TEST(PopulationFit, LongPastTheDeadlineTheAnswerIsIncompleteAndWhole) {
  RunContext late;
  late.deadline = std::chrono::steady_clock::now() - std::chrono::seconds(5);
  const Fit found = fit(kDecay, decays(8, 3), {}, {}, late);
  EXPECT_FALSE(found.stages[0].done);
  EXPECT_EQ(found.stages.back().name, "intervals");
  EXPECT_FALSE(found.stages.back().done);
  EXPECT_EQ(standing_of(found).admission.standing, Standing::Incomplete);
  EXPECT_FALSE(found.numbers[0].ci95) << "nothing was found out about it";
  EXPECT_TRUE(std::isfinite(found.log_likelihood));
  EXPECT_NE(format_json(found).find("\"incomplete\""), std::string::npos);
}

TEST(PopulationFit, AnIndividualThatSaysLittleIsDrawnToTheTypicalOne) {
  Dataset data = decays(12, 2);
  for (Index n = 1; n < 12; ++n)  // one sample is left: how fast it decays is not seen
    data.trajectories[3].states(n, 0) = std::nan("");
  data.trajectories[3].marks = Matrix::Zero(12, data.trajectories[3].states.cols());
  data.trajectories[3].marks.bottomRows(11).setConstant(number_of(Mark::Missing));
  data.trajectories[3].states = data.trajectories[3].states.array().isNaN().select(
      0.0, data.trajectories[3].states);
  const Fit found = fit(kDecay, data, {});
  const FittedParameter& k = found.numbers.at(0);
  EXPECT_NEAR(k.per_record.at(3), k.value, 0.05 * k.value);
  EXPECT_NEAR(k.per_record_errors.at(3), k.value * k.spread->value, 0.1 * k.value);
}

TEST(PopulationFit, HeldOutIndividualsAreFollowed) {
  const Fit found = fit(kDecay, decays(12, 3), decays(4, 9), {.window = 6});
  ASSERT_TRUE(found.gap);
  EXPECT_LT(found.gap->after, 0.2);
}

TEST(PopulationFit, ASpreadThatIsNotThereIsSaid) {
  const SystemModel both = parse_ode_system(
      "param b = 1.7 varies +- 0.4\nparam a = 1.2 varies +- 0.2\ndx/dt = a\ny = b + x\n"
      "initial x = 0 fixed\n",
      "lines.ode");
  int without = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Fit found = fit(both, support::lines(both, 10, 0.5, 0.0, 0.2, seed), {});
    const FittedParameter& a = found.numbers.at(1);
    ASSERT_TRUE(a.spread);
    if (a.spread->value > 0.0) continue;
    ++without;
    EXPECT_FALSE(found.model.parameters()[1].varies);
    EXPECT_THAT(found.notes, ::testing::Contains(HasSubstr("do not show that a varies")));
    EXPECT_THAT(format_text(found), HasSubstr("does not vary (at most +- "));
  }
  EXPECT_GE(without, 1);
}

// A structure in which individuals differ meets them better than one in which they do not, by
// their likelihoods; the same structure in other words ties.
TEST(PopulationFit, IsComparedByTheLikelihoodOfThePopulation) {
  const Dataset data = decays(10, 4);
  const SystemModel alike = parse_ode_system(
      "param k = 0.4\nparam s = 2\ndx/dt = -k*x\ny = s*x\ninitial x = 1 fixed\n", "alike.ode");
  const std::vector<NamedFit> fits{{"alike", fit(alike, data, {})},
                                   {"varying", fit(kDecay, data, {})}};
  const RivalComparison comparison = compare_fits(fits);
  EXPECT_EQ(comparison.rivals.front().name, "varying");
  EXPECT_DOUBLE_EQ(comparison.values, 120.0);
  EXPECT_NEAR(comparison.rivals.front().log_likelihood, fits[1].fit.log_likelihood, 1e-9);
  EXPECT_NEAR(comparison.rivals.front().aicc, fits[1].fit.population->aicc, 1e-6);
  EXPECT_FALSE(comparison.rivals.back().is_tied);
}

TEST(PopulationFit, OneRecordIsNoPopulation) {
  expect_error<DataError>([] { fit(kDecay, decays(1, 1), {}); }, "records",
                          "how a parameter varies", "--trajectory");
}

TEST(PopulationFit, TheAnswerHasSpreadsAndIndividuals) {
  const Fit found = fit(kDecay, decays(5, 7), {}, {.effort = Thoroughness::Quick});
  const std::string text = format_text(found), json = format_json(found);
  EXPECT_THAT(text, HasSubstr("varies */ "));
  EXPECT_THAT(text, HasSubstr("Individual values\n  i0: k "));
  EXPECT_THAT(text, HasSubstr("of the population, AICc "));
  EXPECT_THAT(json, HasSubstr("\"law\": \"lognormal\""));
  EXPECT_THAT(json, HasSubstr("\"population\": {"));
}

}  // namespace
}  // namespace lacuna
