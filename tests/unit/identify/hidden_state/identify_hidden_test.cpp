// SPDX-License-Identifier: MIT
// States that no column shows.
#include "identify/hidden_state/identify_hidden.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <string>

#include "bases/monomials.hpp"
#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "identify/hidden_state/polynomial.hpp"
#include "identify/hidden_state/sparse_coordinates.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/base/stages_done.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"

namespace lacuna {
namespace {

using Names = std::set<std::string>;

/// Two of three states of a flow, with noise in units of their deviations.
Dataset measured(const OdeModel& model, const Vector& start, double step,
                 const std::vector<Index>& kept, std::uint64_t seed, double noise = 0.01) {
  constexpr Index kSamples = 501;
  Random random(seed);
  const Solution orbit =
      simulate(model, Dopri8{}, start, Vector::LinSpaced(kSamples, 0.0, step * (kSamples - 1)));
  Dataset data;
  Trajectory& record = data.trajectories.emplace_back();
  record.time = orbit.time;
  record.states = orbit.states(Eigen::all, kept);
  record.inputs.resize(kSamples, 0);
  for (Index k = 0; k < record.states.cols(); ++k) {
    data.states.push_back(model.states()[static_cast<std::size_t>(kept[std::size_t(k)])]);
    const Vector x = record.states.col(k);
    const double deviation = std::sqrt((x.array() - x.mean()).square().mean());
    for (Index i = 0; i < kSamples; ++i)
      record.states(i, k) += noise * deviation * random.normal();
  }
  return data;
}

std::set<std::string> terms(const OdeModel& model, std::size_t equation) {
  std::set<std::string> names;
  for (const WeightedTerm& summand : model.equations()[equation])
    names.insert(summand.term.name());
  return names;
}

HiddenIdentification identified(const Dataset& data, const RunContext& context = {},
                                int degree = 2) {
  Pipeline pipeline = algorithm1();
  pipeline.basis = Monomials{{.max_degree = degree}};
  return identify_hidden(data, pipeline, FiniteDifferences{}, "h", context);
}

TEST(IdentifyHidden, FindsLorenzFromTwoChannels) {
  const OdeModel lorenz = test_system("lorenz").model;
  const Vector start = Vector{{-8.0, -7.0, 27.0}};
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto [result, data, rate] = identified(measured(lorenz, start, 0.02, {0, 2}, seed));
    EXPECT_EQ(rate, "x");
    EXPECT_EQ(terms(result.model, 0), (Names{"h", "x"}));
    EXPECT_EQ(terms(result.model, 1), (Names{"z", "x*h"}));
    EXPECT_EQ(terms(result.model, 2), (Names{"h", "x", "x*z"}));
    EXPECT_EQ(result.model.coefficient(0, "h"), 1.0);  // by which the scale of h is fixed
    EXPECT_NEAR(result.model.coefficient(2, "x"), 280.0, 3.0);
    EXPECT_TRUE(result.fit[0].fits_to_noise.value_or(false));
    EXPECT_EQ(data.states.back().name, "h");
    EXPECT_FALSE(data.is_measured(2));
  }
}

TEST(IdentifyHidden, WhatFollowsTheNoiseForAFewSamplesOnlyExplainsNothing) {
  // dz/dt = h beside few other terms fits to 5 % noise in windows of a few samples.
  const TestSystem& lorenz = test_system("lorenz");
  const Vector later =
      simulate(lorenz.model, Dopri8{}, lorenz.start, Vector::LinSpaced(2001, 0.0, 20.0))
          .states.bottomRows(1)
          .transpose();
  const Dataset data = measured(lorenz.model, later, 0.02, {0, 2}, 20, 0.05);
  const auto [result, along, rate] = identified(data, {}, 3);
  EXPECT_EQ(rate, "x");
  EXPECT_EQ(terms(result.model, 2), (Names{"h", "x", "x*z"}));
}

TEST(IdentifyHidden, FindsRosslerFromTwoChannels) {
  const OdeModel rossler = test_system("rossler").model;
  const Vector start = Vector{{-3.0, -4.0, 0.05}};
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto result = identified(measured(rossler, start, 0.1, {0, 1}, seed)).result;
    EXPECT_EQ(terms(result.model, 0), (Names{"h", "y"}));
    EXPECT_EQ(terms(result.model, 1), (Names{"x", "y"}));
    EXPECT_EQ(terms(result.model, 2), (Names{"1", "h", "x*h"}));
  }
}

/// Without the constant, which seeds each burst of h, a model follows windows shorter than a
/// turn.
TEST(IdentifyHidden, AConstantThatSeedsGrowthIsTakenOnTrajectories) {
  const TestSystem& rossler = test_system("rossler");
  const Vector later = simulate(rossler.model, Dopri8{}, Vector{{-3.0, -4.0, 0.05}},
                                Vector::LinSpaced(1001, 0.0, 100.0))
                           .states.bottomRows(1)
                           .transpose();
  int right = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto result =
        identified(measured(rossler.model, later, 0.1, {0, 1}, seed, 0.05)).result;
    if (terms(result.model, 2) != (Names{"1", "h", "x*h"})) continue;
    ++right;
    EXPECT_NEAR(result.model.coefficient(2, "1"), -0.2, 0.05) << seed;
    EXPECT_TRUE(result.fit[0].fits_to_noise.value_or(false)) << seed;
  }
  EXPECT_GE(right, 2) << "rows of derivatives show the constant in none of the four";
}

TEST(IdentifyHidden, TheStateAlongTheRecordsIsTheOneThatWasLeftOut) {
  const OdeModel lorenz = test_system("lorenz").model;
  const Vector start = Vector{{-8.0, -7.0, 27.0}};
  // dx/dt = 10 y - 10 x: h is 10 y.
  const Vector expected =
      10.0 * measured(lorenz, start, 0.02, {0, 1, 2}, 1).trajectories[0].states.col(1);
  const Dataset found = identified(measured(lorenz, start, 0.02, {0, 2}, 1)).data;
  const Vector h = found.trajectories[0].states.col(2);
  EXPECT_LT((h - expected).norm(), 0.1 * expected.norm());
}

TEST(IdentifyHidden, AMisfitIsThatOfTheTrajectoriesInUnitsOfTheNoise) {
  // No linear model does what the Lorenz system does.
  const Dataset data =
      measured(test_system("lorenz").model, Vector{{-8.0, -7.0, 27.0}}, 0.02, {0, 2}, 1);
  Pipeline pipeline = algorithm1();
  pipeline.basis = Monomials{{.max_degree = 1}};
  const auto result = identify_hidden(data, pipeline, FiniteDifferences{}, "h").result;
  ASSERT_TRUE(result.fit[0].misfit.has_value());
  EXPECT_FALSE(result.fit[0].fits_to_noise.value_or(true));
  // The noise that measured() adds is a hundredth of the deviation of x.
  const Vector x = data.trajectories[0].states.col(0);
  const double noise = 0.01 * std::sqrt((x.array() - x.mean()).square().mean());
  EXPECT_NEAR(*result.fit[0].misfit, result.noise[0] / noise, 0.3 * *result.fit[0].misfit);
  EXPECT_GT(*result.fit[0].misfit, 3.0);
}

Dataset lorenz_from_two_channels() {
  return measured(test_system("lorenz").model, Vector{{-8.0, -7.0, 27.0}}, 0.02, {0, 2}, 1);
}

bool has_left_out(const IdentificationResult& result, const std::string& stage) {
  return std::any_of(result.stages.begin(), result.stages.end(),
                     [&](const StageDone& s) { return s.name == stage && !s.done; });
}

TEST(IdentifyHidden, PastTheDeadlineTheFirstStateGivesAWholeModel) {
  RunContext late;
  late.deadline = std::chrono::steady_clock::now();
  const auto [result, data, rate] = identified(lorenz_from_two_channels(), late);
  EXPECT_EQ(rate, "x");
  EXPECT_EQ(terms(result.model, 0), (Names{"h"}));  // coordinates are not looked for
  EXPECT_FALSE(terms(result.model, 1).empty());
  EXPECT_FALSE(terms(result.model, 2).empty());
  EXPECT_GT(result.noise.head(2).minCoeff(), 0.0);
  EXPECT_TRUE(has_left_out(result, kTrajectoriesStage));
}

TEST(IdentifyHidden, ADeadlineBeforeTheSecondStateKeepsWhatTheFirstGave) {
  RunContext context;
  context.progress = [&context](const Progress& progress) {
    if (progress.activity == "derivative of z")
      context.deadline = std::chrono::steady_clock::now();
  };
  const auto [result, data, rate] = identified(lorenz_from_two_channels(), context);
  EXPECT_EQ(terms(result.model, 0), (Names{"h", "x"}));
  EXPECT_FALSE(has_left_out(result, kTrajectoriesStage));
  EXPECT_NE(std::find(result.warnings.begin(), result.warnings.end(),
                      "the rates of some measured states were not tried: the time limit came "
                      "first"),
            result.warnings.end());
}

TEST(IdentifyHidden, AStateWhoseModelCannotWinIsNotFitted) {
  int refinements = 0;
  RunContext context;
  bool is_second = false;
  context.progress = [&](const Progress& progress) {
    is_second = is_second || progress.activity == "derivative of z";
    if (is_second && progress.activity == "refining") ++refinements;
  };
  identified(lorenz_from_two_channels(), context);
  EXPECT_TRUE(is_second);
  EXPECT_EQ(refinements, 0);
}

TEST(IdentifyHidden, ANameThatIsTakenIsAnError) {
  Dataset data =
      measured(test_system("lorenz").model, Vector{{-8.0, -7.0, 27.0}}, 0.02, {0, 2}, 1);
  data.states[1].name = "h";
  EXPECT_THROW(identified(data), ConfigError);
}

/// 3 x^2 y - 2 y + 1 with standard errors 0.1, 0.2, 0.
Polynomial example() {
  Polynomial p;
  p.add({2, 1}, {3.0, 0.01});
  p.add({0, 1}, {-2.0, 0.04});
  p.add({0, 0}, {1.0, 0.0});
  return p;
}

double value(const Polynomial& p, double x, double y) {
  double sum = 0.0;
  for (const auto& [exponents, coefficient] : p.terms())
    sum += coefficient.value * std::pow(x, exponents[0]) * std::pow(y, exponents[1]);
  return sum;
}

TEST(Polynomial, OperationsAreThoseOfItsValues) {
  const Polynomial p = example();
  Polynomial q;
  q.add({1, 0}, {1.0, 0.0});
  q.add({0, 2}, {0.5, 0.0});
  const double x = 0.7, y = -1.3, at_q = x + 0.5 * y * y;
  const double at_p = 3.0 * x * x * y - 2.0 * y + 1.0;
  EXPECT_NEAR(value(p, x, y), at_p, 1e-14);
  EXPECT_NEAR(value(sum(p, q), x, y), at_p + at_q, 1e-14);
  EXPECT_NEAR(value(scaled(p, -2.5), x, y), -2.5 * at_p, 1e-14);
  EXPECT_NEAR(value(product(p, q), x, y), at_p * at_q, 1e-14);
  EXPECT_NEAR(value(derivative(p, 0), x, y), 6.0 * x * y, 1e-14);
  EXPECT_NEAR(value(derivative(p, 1), x, y), 3.0 * x * x - 2.0, 1e-14);
  EXPECT_NEAR(value(substituted(p, 0, q), x, y), 3.0 * at_q * at_q * y - 2.0 * y + 1.0, 1e-13);
  EXPECT_NEAR(value(evaluated(p, 1, 4.0), x, 99.0), 12.0 * x * x - 7.0, 1e-13);
}

TEST(Polynomial, VariancesGrowWithTheSquareOfFactors) {
  EXPECT_DOUBLE_EQ(scaled(example(), 3.0).terms().at({2, 1}).variance, 0.09);
  EXPECT_DOUBLE_EQ(evaluated(example(), 1, 2.0).terms().at({2, 0}).variance, 0.04);
  EXPECT_DOUBLE_EQ(evaluated(example(), 1, 2.0).terms().at({0, 0}).variance, 0.16);
  EXPECT_DOUBLE_EQ(derivative(example(), 0).terms().at({1, 1}).variance, 0.04);
  EXPECT_DOUBLE_EQ(sum(example(), example()).terms().at({0, 1}).variance, 0.08);
}

void add(Polynomial& p, Polynomial::Exponents exponents, double value, double error = 0.0) {
  p.add(exponents, {value, error * error});
}

/// Lorenz' system in x, z and w = dx/dt, as it follows by hand from y = x + w / 10:
/// w' = 270 x - 11 w - 10 x z, z' = x^2 + x w / 10 - 8/3 z.
HiddenStateModel lorenz(double error) {
  HiddenStateModel model{std::vector<Polynomial>(3), 3, 2};  // x, z, w
  add(model.rates[0], {0, 0, 1}, 1.0);
  add(model.rates[1], {2, 0, 0}, 1.0 + error, error);
  add(model.rates[1], {1, 0, 1}, 0.1);
  add(model.rates[1], {0, 1, 0}, -8.0 / 3.0);
  add(model.rates[2], {1, 0, 0}, 270.0);
  add(model.rates[2], {0, 0, 1}, -11.0);
  add(model.rates[2], {1, 1, 0}, -10.0);
  return model;
}

TEST(SparseCoordinates, FindWhatWasTakenTogether) {
  for (const double error : {0.0, 0.002}) {
    const HiddenStateModel found = in_sparse_coordinates(lorenz(error));
    // h = 10 y: x' = h - 10 x, z' = x h / 10 - 8/3 z, h' = 280 x - h - 10 x z.
    const auto tolerance = [&](double value) { return 1e-9 + 3.0 * error * std::abs(value); };
    ASSERT_EQ(found.rates[0].terms().size(), 2U);
    EXPECT_NEAR(found.rates[0].terms().at({1, 0, 0}).value, -10.0, tolerance(10.0));
    ASSERT_EQ(found.rates[1].terms().size(), 2U);
    EXPECT_NEAR(found.rates[1].terms().at({1, 0, 1}).value, 0.1, 1e-12);
    ASSERT_EQ(found.rates[2].terms().size(), 3U);
    EXPECT_NEAR(found.rates[2].terms().at({1, 0, 0}).value, 280.0, tolerance(280.0));
    EXPECT_NEAR(found.rates[2].terms().at({0, 0, 1}).value, -1.0, tolerance(20.0));
    EXPECT_EQ(complexity(found), 16);
  }
}

TEST(SparseCoordinates, TakesCubesOfMeasuredStates) {
  // x' = h - x^3, y' = h, h' = -x: with w = x', y' = w + x^3 and w' = -x - 3 x^2 w.
  HiddenStateModel model{std::vector<Polynomial>(3), 3, 2};  // x, y, w
  add(model.rates[0], {0, 0, 1}, 1.0);
  add(model.rates[1], {0, 0, 1}, 1.0);
  add(model.rates[1], {3, 0, 0}, 1.0);
  add(model.rates[2], {1, 0, 0}, -1.0);
  add(model.rates[2], {2, 0, 1}, -3.0);
  const HiddenStateModel found = in_sparse_coordinates(model);
  ASSERT_EQ(found.rates[2].terms().size(), 1U);
  EXPECT_NEAR(found.rates[2].terms().at({1, 0, 0}).value, -1.0, 1e-9);
  EXPECT_NEAR(found.rates[0].terms().at({3, 0, 0}).value, -1.0, 1e-9);
  EXPECT_EQ(found.rates[1].terms().size(), 1U);
}

TEST(SparseCoordinates, LeavesWhatIsSimpleAlone) {
  HiddenStateModel model{std::vector<Polynomial>(2), 2, 1};  // a pendulum for small angles
  add(model.rates[0], {0, 1}, 1.0);
  add(model.rates[1], {1, 0}, -4.0);
  EXPECT_EQ(complexity(in_sparse_coordinates(model)), complexity(model));
}

TEST(SparseCoordinates, TermsThatAreNotKnownFromNothingGo) {
  HiddenStateModel model{std::vector<Polynomial>(1), 1, 0};
  add(model.rates[0], {1}, 0.5, 0.2);
  add(model.rates[0], {0}, 0.5, 0.1);
  const HiddenStateModel left = without_vanishing(model);
  ASSERT_EQ(left.rates[0].terms().size(), 1U);
  EXPECT_EQ(left.rates[0].terms().count({0}), 1U);
}

}  // namespace
}  // namespace lacuna
