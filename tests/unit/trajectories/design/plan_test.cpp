// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/design/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/expect_error.hpp"
#include "trajectories/design/evidence.hpp"
#include "trajectories/design/refit.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using testing::expect_error;

PlanModel model_of(const std::string& name, const std::string& text) {
  return {name, parse_ode_system(text, name)};
}

PlanOptions thorough() {
  PlanOptions options;
  options.candidates = 64;
  options.searches = 3;
  options.evaluations = 1200;
  return options;
}

/// One input that is stepped between two levels, measured at all samples.
PlanProblem static_problem(const std::string& name, const std::string& text, double high,
                           int pieces) {
  PlanProblem problem;
  problem.models = {model_of(name, text)};
  problem.inputs = {{"u", 0.0, high, {}, 1.0, {InputFamily::Steps}, pieces}};
  problem.channels = {{"y", 0.01}};
  problem.duration = pieces - 0.5;
  problem.step = 0.5;
  return problem;
}

TEST(PlanExperiment, MichaelisMentenIsMeasuredAtTheEndAndBelowKm) {
  // The D-optimal support is c and c K / (2 K + c) (Duggleby, J. Theor. Biol. 81:671-684, 1979):
  // of V c / (K + c) with K = 0.7 and c <= 3 it is 3 and 0.4772727.
  const Plan plan = plan_experiment(
      static_problem("mm",
                     "input u hold zero\nparam V = 2 in 0..9\nparam K = 0.7 in 0..9\n"
                     "dx/dt = -x\ny = V*u/(K + u)\ninitial x = 0 fixed\n",
                     3.0, 2),
      thorough());
  ASSERT_EQ(plan.runs.size(), 1u);
  const Vector u = plan.runs[0].experiment.inputs.col(0);
  EXPECT_NEAR(u.maxCoeff(), 3.0, 1e-6);
  EXPECT_NEAR(u.minCoeff(), 3.0 * 0.7 / (2.0 * 0.7 + 3.0), 1e-4);
}

TEST(PlanExperiment, DecayIsMeasuredAtItsTimeConstant) {
  // y = exp(-k t) with k = 0.4: t exp(-k t) is largest at 1 / k.
  PlanProblem problem;
  problem.models = {model_of("decay", "param k = 0.4 in 0..9\ndx/dt = -k*x\ny = x\n"
                                      "initial x = 1 fixed\n")};
  problem.channels = {{"y", 0.01}};
  problem.duration = 10.0;
  problem.step = 0.25;
  problem.measurements = 1;
  const Plan plan = plan_experiment(problem, thorough());
  const Experiment& found = plan.runs.at(0).experiment;
  ASSERT_EQ(found.measured.sum(), 1.0);
  EXPECT_NEAR((found.measured.col(0).transpose() * found.time)(0), 2.5, 1e-4);
}

TEST(PlanExperiment, ConsecutiveReactionsAreMeasuredWhereBoxAndLucasDo) {
  // A -> B -> C with the rates 0.7 and 0.2, B measured twice: 1.23 and 6.86 (Box and Lucas,
  // Biometrika 46:77-90, 1959). Their digits are those of a
  // pattern search over the determinant of the derivatives of the formula of b.
  PlanProblem problem;
  problem.models = {model_of("abc", "param k = 0.7 in 0..9\nparam l = 0.2 in 0..9\n"
                                    "da/dt = -k*a\ndb/dt = k*a - l*b\ny = b\n"
                                    "initial a = 1 fixed\ninitial b = 0 fixed\n")};
  problem.channels = {{"y", 0.01}};
  problem.duration = 10.0;
  problem.step = 0.1;
  problem.measurements = 2;
  const Plan plan = plan_experiment(problem, thorough());
  const Experiment& found = plan.runs.at(0).experiment;
  std::vector<double> times;
  for (Index n = 0; n < found.time.size(); ++n)
    if (found.measured(n, 0) > 0.0) times.push_back(found.time[n]);
  ASSERT_EQ(times.size(), 2u);
  EXPECT_NEAR(times[0], 1.22947, 1e-3);
  EXPECT_NEAR(times[1], 6.85769, 1e-3);
}

TEST(PlanExperiment, ALineAndAParabolaDifferAtEndsAndMiddle) {
  // T-optimal for y = u^2 against a + b u on [-1,1], four samples: -1, 0, 0, 1 (the Chebyshev
  // polynomial 2 u^2 - 1 has its extrema there; Atkinson and Fedorov, Biometrika 62:57-70,
  // 1975).
  PlanProblem problem = static_problem(
      "parabola", "input u hold zero\ndx/dt = -x\ny = u^2\ninitial x = 0 fixed\n", 1.0, 4);
  problem.models.push_back(
      model_of("line", "input u hold zero\nparam a = 0.5 in -9..9\nparam b = 0 in -9..9\n"
                       "dx/dt = -x\ny = a + b*u\ninitial x = 0 fixed\n"));
  problem.models[1].weight = 1e-12;  // the parabola is right
  problem.inputs[0].low = -1.0;
  problem.step = 1.0;
  problem.duration = 3.0;
  problem.inputs[0].hold = 0.75;
  PlanOptions options = thorough();
  options.rivals = RivalCriterion::HunterReiner;
  options.spread = 100.0;  // the line is fitted freely
  const Plan plan = plan_experiment(problem, options);
  const Vector u = plan.runs.at(0).experiment.inputs.col(0);
  ASSERT_EQ(u.size(), 4);
  std::vector<double> levels(u.begin(), u.end());
  std::sort(levels.begin(), levels.end());
  EXPECT_NEAR(levels[0], -1.0, 1e-4);
  EXPECT_NEAR(levels[1], 0.0, 1e-3);
  EXPECT_NEAR(levels[2], 0.0, 1e-3);
  EXPECT_NEAR(levels[3], 1.0, 1e-4);
  // Values 1, 0, 0, 1: 0.5 away from their mean each.
  ASSERT_EQ(plan.pairs.size(), 2u);
  EXPECT_EQ(plan.pairs[0].truth, "parabola");
  EXPECT_NEAR(plan.pairs[0].sigma, 1.0 / 0.01, 0.01);
}

/// Dry and viscous friction of a cart that is pushed; both brake alike while it moves one way
/// at one speed.
PlanProblem cart() {
  PlanProblem problem;
  const std::string head = "input u [N] hold zero\nstate v [m/s]\n";
  problem.models = {
      model_of("viscous", head + "param d = 0.5 in 0..9\ndv/dt = -d*v + u\ny = v [m/s]\n"
                                 "initial v = 0 fixed\n"),
      model_of("dry", head + "param c = 0.4 in 0..9\ndv/dt = -c*tanh(20*v) + u\ny = v [m/s]\n"
                             "initial v = 0 fixed\n")};
  problem.inputs = {{"u", -1.0, 1.0, {}, 0.1, {InputFamily::Steps, InputFamily::Chirp}, 6}};
  problem.channels = {{"y", 0.02}};
  problem.duration = 5.0;
  problem.step = 0.05;
  return problem;
}

PlanOptions quick() {
  PlanOptions options;
  options.candidates = 8;
  options.searches = 2;
  options.evaluations = 30;
  return options;
}

TEST(PlanExperiment, RivalsAreDistinguishedAndTheLimitsOfTheInputKept) {
  PlanProblem problem = cart();
  problem.inputs[0].rate = 2.0;
  const Plan plan = plan_experiment(problem, quick());
  EXPECT_TRUE(plan.is_feasible);
  ASSERT_EQ(plan.pairs.size(), 2u);
  for (const PairPromise& pair : plan.pairs) {
    EXPECT_GT(pair.log_bayes_factor, 10.0) << pair.truth;
    EXPECT_GT(pair.power, 0.9);
    EXPECT_TRUE(std::isnan(pair.repeated)) << "nothing was made before";
  }
  const Vector u = plan.runs.at(0).experiment.inputs.col(0);
  EXPECT_LE(u.maxCoeff(), 1.0);
  EXPECT_GE(u.minCoeff(), -1.0);
  const Vector change = u.tail(u.size() - 1) - u.head(u.size() - 1);
  EXPECT_GT(change.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_LE(change.cwiseAbs().maxCoeff(), 0.2 + 1e-12) << "2 / s for a hold of 0.1 s";
}

TEST(PlanExperiment, ThreadsChangeNothing) {
  RunContext one, three;
  three.threads = 3;
  const Plan a = plan_experiment(cart(), quick(), one);
  const Plan b = plan_experiment(cart(), quick(), three);
  EXPECT_EQ(a.runs.at(0).experiment.inputs, b.runs.at(0).experiment.inputs);
  ASSERT_EQ(a.pairs.size(), b.pairs.size());
  EXPECT_EQ(a.pairs.at(0).log_bayes_factor, b.pairs.at(0).log_bayes_factor);
  EXPECT_EQ(a.evaluations, b.evaluations);
  RunContext other;
  other.seed = 2;
  EXPECT_NE(plan_experiment(cart(), quick(), other).runs.at(0).experiment.inputs,
            a.runs.at(0).experiment.inputs);
}

TEST(PlanExperiment, ThePromisedLogBayesFactorIsObtained) {
  const PlanProblem problem = cart();
  const Plan plan = plan_experiment(problem, quick());
  const std::vector<Experiment> experiments{plan.runs.at(0).experiment};
  std::vector<ModelRun> runs;
  std::vector<Knowledge> known;
  for (const PlanModel& model : problem.models) {
    runs.push_back(model_run(model, problem));
    choose_steps(runs.back(), experiments);
    known.push_back(knowledge_of(model, PlanOptions{}.spread));
  }
  ASSERT_EQ(plan.pairs.size(), 2u);
  for (std::size_t right = 0; right < 2; ++right) {
    constexpr int kDraws = 40;
    Random random(right + 5);
    double mean = 0.0;
    for (const PathNumbers& draw : draws_of(runs[right], known[right], kDraws, 99)) {
      load(runs[right], experiments[0]);
      Vector values = predict(runs[right], experiments[0],
                              in_experiment(runs[right], experiments[0], draw))
                          .values;
      for (double& value : values) value += random.normal();
      mean += (log_evidence(runs[right], known[right], experiments, {values}) -
               log_evidence(runs[1 - right], known[1 - right], experiments, {values})) /
              kDraws;
    }
    EXPECT_GT(mean / plan.pairs[right].log_bayes_factor, 1.0 / 1.5) << right;
    EXPECT_LT(mean / plan.pairs[right].log_bayes_factor, 1.5) << right;
  }
}

TEST(PlanExperiment, SafeRangesAreKeptWithTheirProbability) {
  PlanProblem problem = cart();
  problem.safe = {{"v", -0.6, 0.6}};
  PlanOptions options = quick();
  options.safety_draws = 1000;
  options.safe_probability = 0.95;
  const Plan plan = plan_experiment(problem, options);
  EXPECT_TRUE(plan.is_feasible);
  EXPECT_LE(plan.runs.at(0).leaves, 0.05);
  // Other draws of the truth, by paths of their own.
  for (const PlanModel& model : problem.models) {
    ModelRun run = model_run(model, problem);
    const Experiment& experiment = plan.runs[0].experiment;
    choose_steps(run, {experiment});
    load(run, experiment);
    int left = 0;
    for (const PathNumbers& draw :
         draws_of(run, knowledge_of(model, PlanOptions{}.spread), 1000, 4242)) {
      const Prediction path =
          predict(run, experiment, in_experiment(run, experiment, draw));
      left += path.safe.cwiseAbs().maxCoeff() > 0.6 ? 1 : 0;
    }
    // 50 are allowed; two standard deviations of a binomial count are 14.
    EXPECT_LE(left, 64) << model.name;
  }
}

TEST(PlanExperiment, WhatCannotBeDistinguishedIsSaid) {
  PlanProblem problem = cart();
  problem.models[1] = model_of("same", "input u hold zero\nparam e = 0.5 in 0..9\n"
                                       "dv/dt = u - e*v\ny = v\ninitial v = 0 fixed\n");
  const Plan plan = plan_experiment(problem, quick());
  EXPECT_FALSE(plan.is_feasible);
  ASSERT_FALSE(plan.reasons.empty());
  EXPECT_THAT(plan.reasons.back(), HasSubstr("nothing can be distinguished"));
  for (const PairPromise& pair : plan.pairs) EXPECT_LT(pair.log_bayes_factor, 1.0);
}

TEST(PlanExperiment, ANumberThatNothingShowsStaysUndetermined) {
  PlanProblem problem = cart();
  problem.models = {model_of("product", "input u hold zero\nparam a = 2 in 0..9\n"
                                        "param b = 0.5 in 0..9\ndv/dt = -0.3*v + a*b*u\n"
                                        "fixed dv/dt: v\n"
                                        "y = v\ninitial v = 0 fixed\n")};
  const Plan plan = plan_experiment(problem, quick());
  EXPECT_FALSE(plan.is_feasible);
  ASSERT_EQ(plan.parameters.size(), 2u);
  EXPECT_FALSE(plan.parameters[0].after);
  EXPECT_FALSE(plan.parameters[1].after);
  EXPECT_THAT(plan.reasons.front(), HasSubstr("a of product stays undetermined"));
}

TEST(PlanExperiment, ASecondRunAddsInformation) {
  PlanProblem problem = cart();
  problem.models.pop_back();
  PlanOptions options = quick();
  const Plan one = plan_experiment(problem, options);
  options.runs = 2;
  const Plan two = plan_experiment(problem, options);
  ASSERT_EQ(two.runs.size(), 2u);
  ASSERT_TRUE(one.parameters.at(0).after && two.parameters.at(0).after);
  EXPECT_LT(*two.parameters[0].after, 0.8 * *one.parameters[0].after);
}

TEST(PlanExperiment, PastTheDeadlineTheRunsSoFarAreThePlan) {
  PlanOptions options;
  options.candidates = options.evaluations = 2;
  options.searches = 1;
  const Plan one = plan_experiment(cart(), options);
  options.runs = 3;
  RunContext context;
  int searches = 0;
  context.progress = [&](const Progress& progress) {
    if (progress.activity == "improving designs" && ++searches == 1)
      context.deadline = std::chrono::steady_clock::now();  // the search has a copy of its own
  };
  const Plan cut = plan_experiment(cart(), options, context);
  ASSERT_EQ(cut.runs.size(), 1u);
  EXPECT_EQ(cut.runs[0].experiment.inputs, one.runs[0].experiment.inputs);
  EXPECT_EQ(cut.pairs.size(), one.pairs.size());
  EXPECT_EQ(left_out_line(one.stages), "");
  EXPECT_THAT(left_out_line(cut.stages), HasSubstr("designs of run 2, designs of run 3"));
  EXPECT_THROW(plan_experiment(cart(), options, context), OutOfTime);
}

TEST(PlanExperiment, BadProblemsAreErrors) {
  PlanProblem problem = cart();
  problem.inputs.clear();
  expect_error<ArgumentError>([&] { plan_experiment(problem); }, "input u",
                              "viscous has it", "range");
  problem = cart();
  problem.channels[0].name = "z";
  expect_error<ArgumentError>([&] { plan_experiment(problem); }, "channel z",
                              "no such output or state", "y");
  problem = cart();
  problem.inputs[0].high = -2.0;
  expect_error<ArgumentError>([&] { plan_experiment(problem); }, "input u", "range", "lower");
  problem = cart();
  problem.starts = {{"q", 0.0, 1.0}};
  expect_error<ArgumentError>([&] { plan_experiment(problem); }, "start of q", "no model", "v");
  problem = cart();
  PlanOptions options;
  options.parameters = {"dd"};
  expect_error<ArgumentError>([&] { plan_experiment(problem, options); }, "parameter dd",
                              "no model has", "d");
  problem.models[0].information = Matrix::Identity(3, 3);
  EXPECT_THROW(plan_experiment(problem), ArgumentError);
}

}  // namespace
}  // namespace lacuna
