// SPDX-License-Identifier: MIT
#include "lacuna/identify/journey/identify_records.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna {
namespace {

/// dth/dt = w, dw/dt = -4 sin th - 0.2 w, with noise of so much of the spread.
Dataset pendulum(double noise, double start = 2.0, Index samples = 1500) {
  const auto rates = [](double, const double* x, double* dxdt) {
    dxdt[0] = x[1];
    dxdt[1] = -4.0 * std::sin(x[0]) - 0.2 * x[1];
  };
  const Solution swing =
      Dopri5().integrate(rates, Vector{{start, 0.0}}, sample_times(0.0, 0.02, samples));
  Dataset data;
  data.states = {{"th", "rad"}, {"w", "rad/s"}};
  data.trajectories.resize(1);
  data.trajectories[0].time = swing.time;
  data.trajectories[0].states = swing.states;
  return noise > 0.0 ? add_relative_noise(data, noise, 3) : data;
}

bool has_term(const OdeModel& model, Index equation, const std::string& text) {
  const auto& terms = model.equations()[static_cast<std::size_t>(equation)];
  return std::any_of(terms.begin(), terms.end(),
                     [&](const auto& entry) { return entry.term.name() == text; });
}

// The whole answer of the command: a basis function beside the polynomials, synchronisation,
// a verdict on samples held out.
TEST(IdentifyRecords, FindsVerifiesAndJudges) {
  const Identification found = identify_records(pendulum(0.001));
  EXPECT_TRUE(has_term(found.result.model, 1, "sin(th)")) << to_text(found.result.model, 5);
  ASSERT_TRUE(found.verification);
  EXPECT_TRUE(found.verification->verdict.holds) << found.verification->verdict.sentence;
  EXPECT_EQ(found.verification->integrator, "auto");
  ASSERT_TRUE(found.result.validation);
  EXPECT_EQ(found.result.validation->verdict, ValidationVerdict::FitsToNoise);
  EXPECT_EQ(left_out_line(found.result.stages), "");
  EXPECT_EQ(answer_from(found.result.stages), kSynchronisationStage);
}

TEST(IdentifyRecords, KeepsToALibraryThatIsTheUsersOwn) {
  const Identification found =
      identify_records(pendulum(0.001), {.library = LibraryScope::AsGiven});
  EXPECT_FALSE(has_term(found.result.model, 1, "sin(th)"));
  EXPECT_FALSE(found.result.library_alone);
}

TEST(IdentifyRecords, JudgesByRecordsThatItIsGiven) {
  OdeModel asked_with = OdeModel({{"x", ""}}, {}, {{}});
  IdentificationTask task;
  task.held_out = [&](const OdeModel& model) {
    asked_with = model;
    return pendulum(0.001, 1.0, 700);
  };
  const Identification found = identify_records(pendulum(0.001), task);
  EXPECT_EQ(asked_with.states().size(), 2u);
  ASSERT_TRUE(found.result.validation);
  EXPECT_TRUE(found.result.validation->given);
}

const StageDone* stage_of(const IdentificationResult& result, const std::string& name) {
  const auto found = std::find_if(result.stages.begin(), result.stages.end(),
                                  [&](const StageDone& stage) { return stage.name == name; });
  return found == result.stages.end() ? nullptr : &*found;
}

TEST(IdentifyRecords, PastTheDeadlineTheModelIsThatOfTheRegression) {
  RunContext context;
  context.deadline = std::chrono::steady_clock::now();
  const Identification found = identify_records(pendulum(0.001), {}, context);
  EXPECT_TRUE(has_term(found.result.model, 0, "w")) << to_text(found.result.model, 5);
  EXPECT_EQ(answer_from(found.result.stages), kEquationsStage);
  for (const char* name : {kTrajectoriesStage, kFormsStage, kValidationStage, kRelationsStage,
                           kSynchronisationStage}) {
    ASSERT_TRUE(stage_of(found.result, name)) << name;
    EXPECT_EQ(stage_of(found.result, name)->why, kTimeIsUp) << name;
  }
  EXPECT_FALSE(found.verification);
  EXPECT_FALSE(found.result.validation);
}

TEST(IdentifyRecords, AQuickRunLeavesOutFormsAndRelations) {
  IdentificationTask task;
  task.options.effort = Thoroughness::Quick;
  const Identification found = identify_records(pendulum(0.001), task);
  EXPECT_FALSE(has_term(found.result.model, 1, "sin(th)"));
  EXPECT_EQ(stage_of(found.result, kFormsStage)->why, kIsQuick);
  EXPECT_EQ(stage_of(found.result, kRelationsStage)->why, kIsQuick);
  EXPECT_TRUE(stage_of(found.result, kValidationStage)->done);
  EXPECT_TRUE(found.verification);
}

/// Polynomials explain little of these forces: without derivatives trajectories show that.
TEST(IdentifyRecords, ExactDerivativesAreNoHindranceToFormsBeside) {
  const OdeModel truth =
      parse_ode("dx/dt = v\ndv/dt = 0.4*sin(1.2*t) - 0.4*v^3 - 4*x*exp(0.6*x)", "truth");
  const Dataset data = record_of(truth, Dopri87{}, Vector{{0.5, 0.2}}, 0.005, 4000);
  ASSERT_TRUE(data.has_derivatives());
  const Identification found = identify_records(data);
  EXPECT_TRUE(has_term(found.result.model, 1, "v^3")) << to_text(found.result.model, 5);
  EXPECT_EQ(found.result.model.equations()[1].size(), 3u) << to_text(found.result.model, 5);
  ASSERT_TRUE(found.result.validation);
  EXPECT_EQ(found.result.validation->verdict, ValidationVerdict::FitsToNoise)
      << found.result.validation->sentence;
}

}  // namespace
}  // namespace lacuna
