// SPDX-License-Identifier: MIT
#include "trajectories/refiners/trajectory_selection.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/data/records/noise.hpp"
#include "support/lorenz96.hpp"
#include "support/noisy_records.hpp"

namespace lacuna {
namespace {

OdeModel empty_model(const Dataset& data) {
  return OdeModel(data.states, data.inputs, std::vector<Equation>(data.states.size()));
}

RefinedModel search(const Dataset& data, const OdeModel& truth) {
  return TrajectorySelection{}.refine({data, quadratic_library(truth), empty_model(data)});
}

void expect_structure(const std::string& name, const Dataset& data) {
  const OdeModel& truth = test_system(name).model;
  const RefinedModel found = search(data, truth);
  EXPECT_TRUE(found.usable) << found.message;
  EXPECT_EQ(structure_of(found.model), structure_of(truth)) << name << "\n"
                                                            << to_text(found.model, 4);
}

TEST(TrajectorySelection, FindsTheStructureInOnePercentNoise) {
  for (const char* name : {"lorenz", "rossler"})
    expect_structure(name, noisy_record(name, 2000, 0.01, 1));
}

RefinedModel search_lorenz96(int threads) {
  const Dataset data = lorenz96_record(10, 3000, 0.01, 1);
  RunContext context;
  context.threads = threads;
  return TrajectorySelection{}.refine(
      {data, quadratic_library(lorenz96(10)), empty_model(data)}, context);
}

TEST(TrajectorySelection, FindsTheStructureAmongHundredsOfCandidates) {
  const RefinedModel found = search_lorenz96(1);
  EXPECT_EQ(structure_of(found.model), structure_of(lorenz96(10))) << to_text(found.model, 4);
  EXPECT_EQ(to_text(found.model, 17), to_text(search_lorenz96(3).model, 17));
}

TEST(TrajectorySelection, IntervalsContainTheTruthAndTheModelFitsToTheNoise) {
  const OdeModel& truth = test_system("lorenz").model;
  const RefinedModel found = search(noisy_record("lorenz", 2000, 0.02, 3), truth);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(found.misfit[k], 1.0, 0.1);
    EXPECT_TRUE(found.fits_to_noise[k].value_or(false));
    ASSERT_FALSE(found.model.equations()[k].empty());
    for (const WeightedTerm& summand : found.model.equations()[k]) {
      const double expected = truth.coefficient(static_cast<Index>(k), summand.term.name());
      ASSERT_TRUE(summand.standard_error);
      EXPECT_LT(std::abs(summand.coefficient - expected), 4.0 * *summand.standard_error);
      EXPECT_LT(*summand.standard_error, 0.02 * std::abs(expected) + 0.05);
    }
  }
}

TEST(TrajectorySelection, SaysThatATermIsMissing) {
  const Dataset data = noisy_record("lorenz", 2000, 0.01, 5);
  const TermLibrary linear =
      Monomials{{.max_degree = 1}}.library(test_system("lorenz").model.variables());
  const RefinedModel found = TrajectorySelection{}.refine({data, linear, empty_model(data)});
  EXPECT_FALSE(found.fits_to_noise[1].value_or(true));
  EXPECT_NEAR(found.noise[1], estimate_noise(data)[1], 1e-12) << "that of the record";
}

TEST(TrajectorySelection, PathHoldsTheTermsAndWhatWouldBeNext) {
  const RefinedModel found =
      search(noisy_record("lorenz", 2000, 0.01, 6), test_system("lorenz").model);
  Index members = 0;
  for (const PathStep& step : found.path) {
    EXPECT_EQ(step.in_model, step.gain > step.penalty) << step.term;
    members += step.in_model;
  }
  EXPECT_EQ(members, 7);
  EXPECT_GT(found.path.size(), 12U);
}

TEST(TrajectorySelection, UnitsAndOffsetsOfTimeDoNotMatter) {
  Dataset data = noisy_record("lorenz", 2000, 0.01, 7);
  data.trajectories[0].states *= 1e-3;
  data.trajectories[0].time = 1e3 * data.trajectories[0].time.array() + 50.0;
  expect_structure("lorenz", data);
}

TEST(TrajectorySelection, QuantisedRecords) {
  Dataset data = noisy_record("rossler", 2000, 0.01, 8);
  const double step = 40.0 / 65536.0;
  for (double& x : data.trajectories[0].states.reshaped()) x = step * std::round(x / step);
  expect_structure("rossler", data);
}

TEST(TrajectorySelection, OutliersAreLeftOut) {
  Dataset data = noisy_record("lorenz", 2000, 0.01, 9);
  Random random(5);
  for (int i = 0; i < 60; ++i)
    data.trajectories[0].states(static_cast<Index>(random.uniform(1.0, 1998.0)), i % 3) +=
        random.uniform(10.0, 30.0);
  expect_structure("lorenz", data);
}

TEST(TrajectorySelection, MissingSamplesAreBridged) {
  const Dataset data = noisy_record("lorenz", 2500, 0.01, 10);
  Random random(6);
  std::vector<bool> missing(2500);
  for (std::size_t i = 0; i < missing.size(); ++i) missing[i] = random.uniform(0.0, 1.0) < 0.2;
  expect_structure("lorenz", cut_at_gaps(data, missing));
}

TEST(TrajectorySelection, RecordsWithMeasuredDerivativesAreLeftAlone) {
  Dataset data = noisy_record("lorenz", 200, 0.0, 1);
  data.trajectories[0].derivatives = data.trajectories[0].states;
  EXPECT_FALSE(search(data, test_system("lorenz").model).usable);
}

TrajectorySelection from_model() {
  return TrajectorySelection{
      {.start = TrajectorySelectionOptions::Start::Model, .second_opinion = true}};
}

TEST(TrajectorySelection, StartsFromAModel) {
  const Dataset data = noisy_record("lorenz", 2000, 0.01, 12);
  const OdeModel& truth = test_system("lorenz").model;
  const RefinedModel found = from_model().refine({data, quadratic_library(truth), truth});
  EXPECT_EQ(structure_of(found.model), structure_of(truth));
  EXPECT_TRUE(found.notes.empty());
}

TEST(TrajectorySelection, BeginsFromNothingWhereThereIsNoModel) {
  const Dataset data = noisy_record("lorenz", 2000, 0.01, 13);
  const OdeModel& truth = test_system("lorenz").model;
  const RefinedModel found =
      from_model().refine({data, quadratic_library(truth), empty_model(data)});
  EXPECT_EQ(structure_of(found.model), structure_of(truth));
  ASSERT_EQ(found.notes.size(), 1U);
  EXPECT_NE(found.notes[0].find("from nothing"), std::string::npos);
}

TEST(TrajectorySelection, ModelsOfRecordsWithoutNoiseStand) {
  const Dataset data = noisy_record("lorenz", 2000, 0.0, 12);
  const OdeModel& truth = test_system("lorenz").model;
  const RefinedModel found = from_model().refine({data, quadratic_library(truth), truth, 1e-6});
  EXPECT_FALSE(found.usable);
  EXPECT_TRUE(found.message.empty());
}

/// Terms of all equations.
std::size_t terms_of(const RefinedModel& found) {
  std::size_t terms = 0;
  for (const Equation& equation : found.model.equations()) terms += equation.size();
  return terms;
}

TEST(TrajectorySelection, ApproximationsKeepOnlyTermsThatTakeMuchAway) {
  const Dataset data = noisy_record("chua", 1500, 0.001, 21);
  const OdeModel start = empty_model(data);
  const TermLibrary cubic = Monomials{{.max_degree = 3}}.library(start.variables());
  const RefinedModel few = TrajectorySelection{}.refine({data, cubic, start});
  const RefinedModel many = TrajectorySelection{{.penalty = 12.0}}.refine({data, cubic, start});
  EXPECT_FALSE(few.fits_to_noise[0].value_or(true));
  EXPECT_LT(terms_of(few), terms_of(many)) << to_text(few.model, 4) << to_text(many.model, 4);
  for (const PathStep& step : few.path) {
    const double least = step.in_model ? step.penalty : 0.0;
    EXPECT_GE(step.gain, least) << step.term;
  }
}

}  // namespace
}  // namespace lacuna
