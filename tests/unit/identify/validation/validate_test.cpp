// SPDX-License-Identifier: MIT
// Models beside records that did not choose them.
#include "identify/validation/validate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/derivatives/finite_differences.hpp"
#include "identify/validation/advice.hpp"
#include "identify/validation/held_blocks.hpp"
#include "identify/validation/refit.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/identify/options.hpp"
#include "lacuna/records/binding/embedding.hpp"
#include "regression/pruners/keep_all.hpp"
#include "solvers/stlsq.hpp"
#include "trajectories/refiners/no_refiner.hpp"
#include "unit/identify/validation/systems.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::lorenz_record;
using testing::measured;
using testing::record_of_text;
using testing::validated;
using testing::with_terms;

const std::vector<std::string> kLorenzTerms = {"x", "y", "z", "x*y", "x*z"};

TEST(Validate, TheRightLibraryFitsAtAnyNoise) {
  for (const double noise : {0.0, 0.01, 0.1}) {
    const Validation validation = validated(lorenz_record(noise), with_terms(kLorenzTerms));
    EXPECT_EQ(validation.verdict, ValidationVerdict::FitsToNoise)
        << noise << ' ' << validation.sentence;
    EXPECT_TRUE(validation.refitted);
    EXPECT_NEAR(static_cast<double>(validation.samples), 1000.0, 200.0);
    EXPECT_EQ(validation.one_step.states.size(), 3U);
  }
}

TEST(Validate, ALibraryWithoutAProductIsWrong) {
  for (const double noise : {0.0, 0.01}) {
    const Validation validation =
        validated(lorenz_record(noise, 1500), with_terms({"1", "x", "y", "z", "x*y"}));
    EXPECT_EQ(validation.verdict, ValidationVerdict::WrongLibrary) << validation.sentence;
  }
}

TEST(Validate, PolynomialsApproximateARateThatSaturates) {
  // Pulses of food that is eaten at a rate which saturates.
  const Dataset data = record_of_text("dx/dt = 0.5 + 0.45*sin(0.7*t) - x/(0.4 + x)\n",
                                      Vector::Constant(1, 1.0), 0.05, 3000);
  const std::vector<std::string> terms = {"1", "sin(0.7*t)", "x", "x^2", "x^3", "x^4"};
  const Validation clean = validated(data, with_terms(terms));
  EXPECT_EQ(clean.verdict, ValidationVerdict::Approximation) << clean.sentence;
  const Validation right = validated(data, with_terms({"1", "sin(0.7*t)", "x/(0.4+x)"}));
  EXPECT_EQ(right.verdict, ValidationVerdict::FitsToNoise) << right.sentence;
}

TEST(Validate, NumbersAreThoseOfTheDefinition) {
  const Validation validation =
      validated(lorenz_record(0.01), with_terms({"1", "x", "y", "z", "x*y"}));
  double largest = 0.0;
  for (const PredictionError& state : validation.windows.states) {
    EXPECT_GT(state.motion, state.noise);
    EXPECT_GT(state.freedom, 500.0);
    largest = std::max(largest, state.fraction());
  }
  EXPECT_GT(largest, 0.1);
  EXPECT_GT(validation.windows.horizon, 0.3);
  EXPECT_NEAR(validation.one_step.horizon, 0.01, 1e-9);
}

/// What comes to rest: all but the first blocks of a record hold no motion.
struct Settling {
  std::string equations;
  Vector start;
  std::vector<std::string> terms;  ///< of the right library
  std::vector<std::string> wrong;  ///< of one that lacks a term
};

std::vector<Settling> settling() {
  return {{"dS/dt = -0.5*S*I\ndI/dt = 0.5*S*I - 0.1*I\ndR/dt = 0.1*I\n",
           Vector{{0.99, 0.01, 0.0}},
           {"1", "S", "I", "R", "S*I"},
           {"1", "S", "I", "R", "S*R"}},
          {"dx/dt = -0.3*x\n", Vector{{2.0}}, {"1", "x", "x^2"}, {"1", "x^2", "x^3"}},
          {"dq/dt = v\ndv/dt = -4*q - 0.4*v\n",
           Vector{{1.0, 0.0}},
           {"1", "q", "v", "q*v"},
           {"1", "v", "q^2", "v^2"}},
          {"dn/dt = 0.6*n - 0.2*n^2\n", Vector{{0.05}}, {"1", "n", "n^2"}, {"1", "n"}}};
}

/// The record in so many digits behind the point, as files have it.
Dataset printed(Dataset data, int digits) {
  const double step = std::pow(10.0, -digits);
  for (Trajectory& record : data.trajectories)
    record.states = (record.states / step).array().round() * step;
  return data;
}

TEST(Validate, RecordsThatComeToRestAreJudgedWhereTheyMove) {
  const std::vector<Settling> all = settling();
  ASSERT_FALSE(all.empty());
  for (const Settling& one : all)
    for (const int digits : {10, 6}) {
      const Dataset data =
          printed(record_of_text(one.equations, one.start, 0.1, 2000), digits);
      const Validation right = validated(data, with_terms(one.terms));
      EXPECT_EQ(right.verdict, ValidationVerdict::FitsToNoise)
          << one.equations << digits << ' ' << right.sentence;
      const Validation wrong = validated(data, with_terms(one.wrong));
      EXPECT_THAT(wrong.verdict, ::testing::AnyOf(ValidationVerdict::WrongLibrary,
                                                ValidationVerdict::Approximation))
          << one.equations << digits << ' ' << wrong.sentence;
    }
}

TEST(Validate, OtherRecordsAreJudgedByTheModelAsItIs) {
  const Dataset data = lorenz_record(0.01);
  const Pipeline pipeline = with_terms(kLorenzTerms);
  const IdentificationResult found = identify(data, pipeline);
  const Validation same = validate({found, data, pipeline, lorenz_record(0.01, 1500, 9)});
  EXPECT_EQ(same.verdict, ValidationVerdict::FitsToNoise) << same.sentence;
  EXPECT_TRUE(same.given);
  EXPECT_FALSE(same.refitted);
  EXPECT_EQ(same.samples, 1500);

  // A record of another Lorenz system: the model does not hold there.
  const Dataset other = measured(
      record_of(parse_ode("dx/dt = -10*x + 10*y\ndy/dt = 20*x - y - x*z\ndz/dt = x*y - 1.5*z\n",
                          "test"),
                Dopri87{}, Eigen::Vector3d(1.0, 1.0, 20.0), 0.01, 1500),
      0.01);
  const Validation wrong = validate({found, data, pipeline, other});
  EXPECT_NE(wrong.verdict, ValidationVerdict::FitsToNoise) << wrong.sentence;
  EXPECT_NE(wrong.verdict, ValidationVerdict::Undecided) << wrong.sentence;
  EXPECT_THROW(validate({found, data, pipeline, data}), DataError) << "none that was not used";
}

TEST(Validate, AShortRecordTellsNothing) {
  const Dataset data = lorenz_record(0.01);
  const Pipeline pipeline = with_terms(kLorenzTerms);
  const IdentificationResult found = identify(data, pipeline);
  Dataset few = lorenz_record(0.01, 1500, 9);
  few.trajectories[0] = rows_of(few.trajectories[0], 100, 5);
  const Validation validation = validate({found, data, pipeline, few});
  EXPECT_EQ(validation.verdict, ValidationVerdict::Undecided) << validation.sentence;
}

TEST(Validate, AnEmbeddedRecordIsJudgedByWhatWasMeasured) {
  const Dataset pendulum =
      record_of_text("dth/dt = w\ndw/dt = -9*sin(th)\n", Eigen::Vector2d(2.5, 0.0), 0.01, 3000);
  Dataset seen = pendulum;
  seen.states = {{"q", "rad"}};
  seen.trajectories[0].states = pendulum.trajectories[0].states.leftCols(1).eval();
  for (const double noise : {0.0, 0.002}) {
    const Dataset data = embed(measured(seen, noise), {{"q", 2}}, FiniteDifferences{});
    const Validation right = validated(data, with_terms({"sin(q)", "q_d1"}));
    EXPECT_EQ(right.verdict, ValidationVerdict::FitsToNoise) << noise << right.sentence;
    const Validation wrong = validated(data, with_terms({"1", "q_d1", "q^2"}));
    EXPECT_EQ(wrong.verdict, ValidationVerdict::WrongLibrary) << noise << wrong.sentence;
    ASSERT_EQ(wrong.windows.states.size(), 1U);
    EXPECT_EQ(wrong.windows.states[0].state, "q");
  }
}

TEST(Validate, RecordsOfOneSystemAreHeldOutInTurn) {
  const TestSystem& lorenz = test_system("lorenz");
  Dataset data = lorenz_record(0.0, 300);
  for (int r = 2; r <= 12; ++r)
    data.trajectories.push_back(
        record_of(lorenz.model, Dopri87{}, lorenz.start + Vector::Constant(3, r), 0.01, 300)
            .trajectories[0]);
  data = measured(std::move(data), 0.01);
  const Validation validation = validated(data, with_terms(kLorenzTerms));
  EXPECT_EQ(validation.verdict, ValidationVerdict::FitsToNoise) << validation.sentence;
}

TEST(Validate, CoefficientsThatAreShownHaveToPredictToo) {
  // The right terms, which a part of the record fits well, with other coefficients.
  const Dataset data = lorenz_record(0.01, 1500);
  const Pipeline pipeline = with_terms(kLorenzTerms);
  IdentificationResult found = identify(data, pipeline);
  std::vector<Equation> equations = found.model.equations();
  for (Equation& equation : equations)
    for (WeightedTerm& summand : equation) summand.coefficient *= 1.5;
  found.model = found.model.with_equations(std::move(equations));
  const Validation validation = validate({found, data, pipeline});
  EXPECT_EQ(validation.verdict, ValidationVerdict::WrongLibrary) << validation.sentence;
  EXPECT_FALSE(validation.refitted);
}

/// th'' = -24 sin th - 0.1 th', its angle on the steps of an encoder, 1024 a turn.
Dataset encoded_swing() {
  constexpr double kStep = 2.0 * 3.141592653589793 / 1024.0;
  Dataset data = record_of_text("dth/dt = w\ndw/dt = -24*sin(th) - 0.1*w", Vector{{1.8, 0.0}},
                                0.01, 1800);
  Trajectory& run = data.trajectories.front();
  run.states = (run.states.leftCols(1) / kStep).array().round() * kStep;
  data.states.resize(1);
  const Pipeline pipeline = algorithm1();
  return embed(data, {{"th", 2}}, *differentiator_of(*pipeline.formulation));
}

TEST(Validate, ARefitBeginsWhereTheModelIsAndNotAtRatesThatRoundingTears) {
  const Dataset data = encoded_swing();
  const OdeModel model =
      parse_ode("dth/dt = th_d1\ndth_d1/dt = -24*sin(th) - 0.1*th_d1", "test");
  const Pipeline pipeline = algorithm1();
  const auto found =
      refitted_on(thinned(without_blocks(data, held_blocks(data, 150), 20), 18000), model,
                  pipeline, {});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->coefficient(1, "sin(th)"), -24.0, 0.1);
  EXPECT_NEAR(found->coefficient(1, "th_d1"), -0.1, 0.02);
}

std::vector<std::string> advice_on(const Dataset& data, const Pipeline& pipeline) {
  const IdentificationResult found = identify(data, pipeline);
  const std::vector<Stage<Effect>> effects = default_registry().make_all<Effect>();
  return advice_for({found, data, pipeline, effects});
}

TEST(Advice, NamesTheFormThatTheResidualAsksFor) {
  const Dataset pendulum = testing::record_of_text("dth/dt = w\ndw/dt = -9*sin(th) - 0.1*w\n",
                                                   Eigen::Vector2d(2.9, 0.0), 0.01, 3000);
  const std::vector<std::string> advice =
      advice_on(pendulum, testing::with_terms({"1", "th", "w"}));
  EXPECT_THAT(advice, ElementsAre(::testing::AllOf(HasSubstr("dw/dt"), HasSubstr("sin(th"),
                                                   HasSubstr("--add"))));
}

/// Coefficients below 0.1 are thresholded away: to add such a term is no advice.
TEST(Advice, WhatThePipelineWouldTakeOutAgainIsNotAdvised) {
  Pipeline pipeline = testing::with_terms({"1", "x", "v"});
  pipeline.regressor = Stlsq{{.threshold = 0.1}};
  pipeline.pruner = KeepAll{};
  pipeline.refiner = NoRefiner{};
  const auto advice_with = [&](const std::string& size) {
    return advice_on(testing::record_of_text("dx/dt = v\ndv/dt = -x + " + size + "*sin(4*x)\n",
                                             Eigen::Vector2d(2.0, 0.0), 0.01, 3000),
                     pipeline);
  };
  EXPECT_THAT(advice_with("0.5"), ElementsAre(HasSubstr("--add \"sin(x/0.25)\"")));
  EXPECT_THAT(advice_with("0.05"), ElementsAre(HasSubstr("lacuna diagnose")));
}

TEST(Advice, PointsToADiagnosisWhereNoFunctionHelps) {
  // A force that is not in the record.
  const Dataset driven =
      testing::record_of_text("dx/dt = v\ndv/dt = -x - 0.2*v + 3*sin(2.3*t)*cos(0.31*t)\n",
                              Eigen::Vector2d(1.0, 0.0), 0.05, 2000);
  const std::vector<std::string> advice =
      advice_on(driven, testing::with_terms({"1", "x", "v"}));
  ASSERT_FALSE(advice.empty());
  EXPECT_THAT(advice.back(), HasSubstr("lacuna diagnose"));
}

const Dataset kData{"s", {{"x", ""}, {"y", ""}}, {}, {}, {}};

/// Residuals say of x that it fits, and of y that it does not.
IdentificationResult sample_result() {
  const Variables variables{{"x", "y"}, {}};
  IdentificationResult result{
      OdeModel({{"x", ""}, {"y", ""}}, {},
               {{{Term::parse("y", variables), 1.0}}, {{Term::parse("x", variables), -1.0}}}),
      Vector::Zero(2),
      {},
      {},
      {},
      {"first", "y is off", "last"}};
  result.fit = {{.equation = "x", .rows = 50, .fits_to_noise = true},
                {.equation = "y", .rows = 50, .fits_to_noise = false, .doubt = "y is off"}};
  return result;
}

Validation said(ValidationVerdict verdict, Adequate whole, Adequate of_x, Adequate of_y) {
  Validation validation{.verdict = verdict};
  validation.adequacy = {whole, {{"x", of_x, 100, true}, {"y", of_y, 100, true}}};
  return validation;
}

TEST(TakeIn, WhatPredictionsSayStandsForWhatResidualsSaid) {
  IdentificationResult result = sample_result();
  take_in(said(ValidationVerdict::FitsToNoise, Adequate::Yes, Adequate::Yes, Adequate::Yes),
          kData, result);
  EXPECT_EQ(result.fit[1].fits_to_noise, true);
  EXPECT_THAT(result.warnings, ElementsAre("first", "last")) << "the doubt is withdrawn";
  EXPECT_EQ(result.adequacy.fits, Adequate::Yes);
  ASSERT_TRUE(result.validation);

  result = sample_result();
  take_in(said(ValidationVerdict::Approximation, Adequate::No, Adequate::No, Adequate::Yes),
          kData, result);
  EXPECT_EQ(result.fit[0].fits_to_noise, false);
  EXPECT_EQ(result.fit[1].fits_to_noise, true);
  EXPECT_EQ(result.adequacy.fits, Adequate::No);
}

TEST(TakeIn, WhatPredictionsDoNotTellIsNoClaimBesideTheirVerdict) {
  IdentificationResult result = sample_result();
  take_in(said(ValidationVerdict::FitsToNoise, Adequate::Yes, Adequate::Yes,
               Adequate::Undetermined),
          kData, result);
  EXPECT_EQ(result.fit[1].fits_to_noise, std::nullopt);
  EXPECT_THAT(result.warnings, ElementsAre("first", "last"));

  result = sample_result();
  take_in(said(ValidationVerdict::Undecided, Adequate::Undetermined, Adequate::Undetermined,
               Adequate::Undetermined),
          kData, result);
  EXPECT_EQ(result.fit[0].fits_to_noise, true) << "the residuals' word, beside a known noise";
  EXPECT_EQ(result.fit[1].fits_to_noise, false);
  EXPECT_EQ(result.adequacy.fits, Adequate::Undetermined);
}

TEST(ValidationOptions, StayInTheirRanges) {
  EXPECT_NO_THROW(checked(ValidationOptions{}));
  EXPECT_THROW(checked(ValidationOptions{.resolution = -1.0}), ConfigError);
  EXPECT_THROW(checked(ValidationOptions{.held_every = 1}), ConfigError);
}

TEST(ValidationOptions, ReachTheVerdict) {
  const Dataset data = testing::lorenz_record(0.01, 1500);
  const Pipeline pipeline = algorithm1();
  const IdentificationResult found = identify(data, pipeline);
  const auto verdict = [&](const ValidationOptions& options) {
    return validate({found, data, pipeline}, options).verdict;
  };
  EXPECT_EQ(verdict({}), ValidationVerdict::FitsToNoise);
  EXPECT_EQ(verdict({.least_freedom = 100000}), ValidationVerdict::Undecided);
}

TEST(ValidationOptions, NoMoreSamplesAreUsedThanATestNeeds) {
  const Dataset data = testing::lorenz_record(0.01, 6000);
  const Pipeline pipeline = algorithm1();
  const IdentificationResult found = identify(data, pipeline);
  const Validation whole = validate({found, data, pipeline}, {.most_samples = 100000});
  const Validation few = validate({found, data, pipeline}, {.most_samples = 600});
  EXPECT_NEAR(double(whole.samples), 1500.0, 100.0);
  EXPECT_NEAR(double(few.samples), 600.0, 30.0);
  EXPECT_EQ(few.verdict, whole.verdict) << few.sentence;
  const Validation long_windows =
      validate({found, data, pipeline}, {.most_samples = 100, .least_windows = 20});
  EXPECT_GE(long_windows.windows.windows, 15);
}

}  // namespace
}  // namespace lacuna
