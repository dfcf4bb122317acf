// SPDX-License-Identifier: MIT
#include "trajectories/fit/population/population_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/report/reports.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "support/expect_error.hpp"
#include "support/populations.hpp"
#include "trajectories/fit/population/population_problem.hpp"
#include "trajectories/fit/population/population_search.hpp"

namespace lacuna {
namespace {

using testing::expect_error;
using ::testing::HasSubstr;

TEST(VaryingParameter, DerivativesAreThoseOfItsValue) {
  constexpr double kStep = 1e-6;
  for (const bool by_factor : {false, true}) {
    const VaryingParameter one{0, by_factor, 0.3};
    const auto value = [&](double typical, double z) { return one.value(typical, 0.3, z); };
    EXPECT_NEAR(one.by_deviation(2.0, 0.3, 0.7),
                (value(2.0, 0.7 + kStep) - value(2.0, 0.7 - kStep)) / (2.0 * kStep), 1e-8);
    EXPECT_NEAR(one.by_typical(0.3, 0.7),
                (value(2.0 + kStep, 0.7) - value(2.0 - kStep, 0.7)) / (2.0 * kStep), 1e-8);
    EXPECT_NEAR(value(2.0, one.deviation_at(1.5, 2.0, 0.3)), 1.5, 1e-12) << by_factor;
  }
}

/// Levels y = m + b_i + noise, m = 1.7 and the spread of b given.
SystemModel level_model() {
  return parse_ode_system(
      "param m = 1 varies +- 0.5\ndx/dt = 0*x\ny = m + x\ninitial x = 0 fixed\n", "level.ode");
}

Dataset levels(const SystemModel& system, double spread, std::uint64_t seed) {
  return support::individuals(system, 9, sample_times(0.0, 1.0, 6), seed, [=](Random& random) {
    const double own = 1.7 + spread * random.normal();
    return [=](double, Random& each) { return own + 0.3 * each.normal(); };
  });
}

/// Everything that a search takes.
struct Search {
  explicit Search(const SystemModel& system, const Dataset& data)
      : model(system.parametrised()),
        engine(fit_engine(model, fit_records(model, data))),
        problem(population_problem(system, engine, fit_unknowns(model, {}))) {}
  PopulationMinimum run() {
    const FitPoint start{model.values().transpose().replicate(engine.records.records(), 1),
                         engine.records.starts};
    return search_population(engine, problem, start, false, {});
  }
  ParametrisedModel model;
  FitEngine engine;
  PopulationProblem problem;
};

/// Analysis of variance of balanced levels (Searle, Casella and McCulloch, Variance Components
/// (1992), Sect. 3.7): the estimates of the largest likelihood in closed form.
struct Levels {
  explicit Levels(const FitEngine& engine) {
    const Index records = engine.records.records(), n = engine.records.end(0);
    mean = engine.records.values.mean();
    for (Index r = 0; r < records; ++r) {
      const Vector own = engine.records.values.col(0).segment(engine.records.first(r), n);
      between += static_cast<double>(n) * std::pow(own.mean() - mean, 2);
      within += (own.array() - own.mean()).square().sum();
    }
    noise = within / static_cast<double>(records * (n - 1));
    spread = (between / static_cast<double>(records) - noise) / static_cast<double>(n);
    error =
        std::sqrt((noise + static_cast<double>(n) * spread) / static_cast<double>(n * records));
  }
  double mean = 0.0, between = 0.0, within = 0.0;
  double noise, spread, error;  ///< variances, and the standard error of the mean
};

TEST(PopulationSearch, OfBalancedLevelsIsTheAnalysisOfVariance) {
  const SystemModel system = level_model();
  Search search(system, levels(system, 0.6, 1));
  const PopulationMinimum found = search.run();
  const Levels expected(search.engine);
  ASSERT_GT(expected.spread, 0.0);
  EXPECT_TRUE(found.converged);
  EXPECT_EQ(found.agreeing, 2);
  EXPECT_NEAR(found.values.parameters[0], expected.mean, 1e-5);
  EXPECT_NEAR(found.values.spreads[0], std::sqrt(expected.spread), 1e-5);
  EXPECT_NEAR(found.values.sizes[0], std::sqrt(expected.noise), 1e-5);
  const PopulationErrors errors =
      errors_of_population(search.engine, search.problem, found, {});
  EXPECT_NEAR(std::sqrt(errors.covariance(0, 0)), expected.error, 1e-3 * expected.error);
  // Variances of the estimates: noise 2 v^2 / (R (n-1)), n spread + noise 2 (.)^2 / R.
  const double total = expected.noise + 6.0 * expected.spread;
  const double variance =
      (2.0 * total * total / 9.0 + 2.0 * expected.noise * expected.noise / 45.0) / 36.0;
  EXPECT_NEAR(errors.covariance(1, 1), variance / (4.0 * expected.spread),
              0.05 * errors.covariance(1, 1));
  EXPECT_FALSE(errors.may_be_zero[0]);
}

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
