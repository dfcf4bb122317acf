// SPDX-License-Identifier: MIT
#include "lacuna/identify/validation/sync_verdict.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/text.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

OdeModel damped_oscillator(double stiffness) {
  const Variables variables{{"x", "v"}, {}};
  return {{{"x", "m"}, {"v", "m/s"}},
          {},
          {{{Term::parse("v", variables), 1.0}}, {{Term::parse("x", variables), -stiffness}}}};
}

/// dv/dt = -x, from the middle on -(1 + change) x; with noise of that deviation.
Dataset record(double noise, double change) {
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  const Index n = 4000;
  const double h = 0.02;
  Vector t(n);
  Matrix states(n, 2);
  double x = 1.0, v = 0.0;
  for (Index i = 0; i < n; ++i) {
    t[i] = h * static_cast<double>(i);
    states(i, 0) = x + noise * normal(engine);
    states(i, 1) = v + noise * normal(engine);
    const double w = std::sqrt(i >= n / 2 ? 1.0 + change : 1.0), c = std::cos(w * h);
    const double s = std::sin(w * h), next = c * x + s / w * v;
    v = c * v - w * s * x;
    x = next;
  }
  return {
      "s", {{"x", "m"}, {"v", "m/s"}}, {}, {{"run", t, states, Matrix(n, 0), Matrix()}}, {}};
}

SyncVerdict verdict(double stiffness, const Dataset& data) {
  const OdeModel model = damped_oscillator(stiffness);
  return judge(model, data, synchronise(model, data, Rk4{}));
}

TEST(SyncVerdict, TheRightModelHolds) {
  const SyncVerdict found = verdict(1.0, record(0.01, 0.0));
  EXPECT_TRUE(found.holds);
  EXPECT_THAT(found.sentence, HasSubstr("Holds: the error is"));
}

TEST(SyncVerdict, AWrongOneDoesNotAndItsEquationIsNamed) {
  const SyncVerdict found = verdict(1.5, record(0.01, 0.0));
  EXPECT_FALSE(found.holds);
  EXPECT_EQ(found.equation, "v");
  EXPECT_FALSE(found.until);
  EXPECT_THAT(found.sentence, HasSubstr("Does not hold: equation v"));
}

TEST(SyncVerdict, WhatChangesHoldsUpToThen) {
  const SyncVerdict found = verdict(1.0, record(0.01, 0.5));
  EXPECT_FALSE(found.holds);
  ASSERT_TRUE(found.until);
  EXPECT_NEAR(*found.until, 40.0, 4.0);  // the middle of 80 s, to two pieces
  EXPECT_THAT(found.sentence, HasSubstr("Holds up to"));
}

/// A slave of the right model, with something added to its states.
SyncVerdict verdict_with(Index first, Index count, double added, bool settled = true) {
  const Dataset data = record(0.01, 0.0);
  const OdeModel model = damped_oscillator(1.0);
  SyncResult sync = synchronise(model, data, Rk4{});
  sync.states[0].middleRows(first, count).array() += added;
  sync.settled = settled;
  return judge(model, data, sync);
}

TEST(SyncVerdict, ASlaveComesToTheRecordInTheFirstQuarter) {
  EXPECT_TRUE(verdict_with(0, 900, 5.0).holds);
  EXPECT_FALSE(verdict_with(0, 1100, 5.0).holds);
}

TEST(SyncVerdict, OnePieceThatIsOffIsNoEndOfHolding) {
  const SyncVerdict found = verdict_with(2000, 150, 5.0);
  EXPECT_FALSE(found.holds);
  EXPECT_FALSE(found.until);
  EXPECT_TRUE(verdict_with(2000, 2000, 5.0).until);
}

TEST(SyncVerdict, ASlaveThatDoesNotSettleDoesNotHold) {
  EXPECT_TRUE(verdict_with(0, 1, 0.0).holds);
  EXPECT_FALSE(verdict_with(0, 1, 0.0, false).holds);
}

/// Rosenzweig and MacArthur's prey and predator: errors grow for much of each turn.
OdeModel prey_and_predator(double growth) {
  return parse_ode("dx/dt = " + format_number(growth) +
                       "*x - 0.2*x^2 - x*y/(1+x)\ndy/dt = 0.9*x*y/(1+x) - 0.3*y",
                   "test");
}

SyncVerdict verdict_on_an_unstable_orbit(double growth) {
  const Dataset data = add_relative_noise(
      record_of(prey_and_predator(1.0), Dopri87{}, Eigen::Vector2d(1.0, 1.0), 0.1, 3000), 0.001,
      3);
  const OdeModel model = prey_and_predator(growth);
  const SyncResult sync = synchronise(model, data, Rk4{});
  EXPECT_GT(*sync.error_over_noise, 5.0);
  EXPECT_GT(sync.response[0], 5.0 * sync.noise[0]);
  return judge(model, data, sync);
}

TEST(SyncVerdict, NoiseThatAnUnstableOrbitAmplifiesIsNoFaultOfTheModel) {
  const SyncVerdict found = verdict_on_an_unstable_orbit(1.0);
  EXPECT_TRUE(found.holds) << found.sentence;
  EXPECT_THAT(found.sentence, HasSubstr("which this orbit amplifies to"));
}

TEST(SyncVerdict, AWrongModelOnAnUnstableOrbitDoesNotHold) {
  EXPECT_FALSE(verdict_on_an_unstable_orbit(1.01).holds);
  EXPECT_FALSE(verdict_on_an_unstable_orbit(0.99).holds);
}

/// The oscillator's record with v not measured.
Dataset position_only() {
  Dataset data = record(0.01, 0.0);
  Trajectory& run = data.trajectories.front();
  run.states.col(1).setZero();
  run.marks = Matrix::Zero(run.samples(), 2);
  run.marks.col(1).setConstant(number_of(Mark::Missing));
  data.reconstructed = {false, true};
  return data;
}

TEST(SyncVerdict, AHiddenStateThatTheRecordTellsIsNoHindrance) {
  const SyncVerdict right = verdict(1.0, position_only());
  EXPECT_TRUE(right.holds) << right.sentence;
  const SyncVerdict wrong = verdict(1.5, position_only());
  EXPECT_FALSE(wrong.holds);
  EXPECT_FALSE(wrong.equation) << "the coupling helps x with what v lacks";
}

TEST(SyncVerdict, AHiddenStateThatTheRecordDoesNotTellLeavesNoVerdict) {
  const OdeModel model = parse_ode("dx/dt = -x\ndv/dt = x\n", "test");
  const Dataset data = position_only();
  const SyncVerdict found = judge(model, data, synchronise(model, data, Rk4{}));
  EXPECT_FALSE(found.holds);
  EXPECT_FALSE(found.decided);
  EXPECT_THAT(found.sentence, HasSubstr("Undecided"));
}

/// A slave that noise drives anywhere says nothing for the model.
TEST(SyncVerdict, ALostSlaveDoesNotHold) {
  const Dataset data = record(0.01, 0.0);
  const OdeModel model = damped_oscillator(1.5);
  SyncResult sync = synchronise(model, data, Rk4{});
  ASSERT_FALSE(judge(model, data, sync).holds);
  sync.response.setConstant(10.0);
  EXPECT_FALSE(judge(model, data, sync).holds);
}

TEST(SyncVerdict, WithoutNoiseTheRecordItselfIsTheMeasure) {
  EXPECT_TRUE(verdict(1.0, record(0.0, 0.0)).holds);
  const SyncVerdict wrong = verdict(1.1, record(0.0, 0.0));
  EXPECT_FALSE(wrong.holds);
  EXPECT_THAT(wrong.sentence, HasSubstr("Does not hold"));
}

TEST(SyncVerdict, ItsAdequacyIsThatOfTheSlave) {
  EXPECT_EQ(verdict(1.0, record(0.01, 0.0)).adequacy.fits, Adequate::Yes);
  const SyncVerdict wrong = verdict(1.5, record(0.01, 0.0));
  EXPECT_EQ(wrong.adequacy.fits, Adequate::No);
  ASSERT_EQ(wrong.adequacy.parts.size(), 2u);
  EXPECT_TRUE(wrong.adequacy.parts[0].noise_known);
}

TEST(SyncVerdict, WhereNothingMovesThereIsNone) {
  Dataset still = record(0.0, 0.0);
  still.trajectories[0].states.setConstant(0.1);
  SyncResult slave;
  slave.states = {still.trajectories[0].states};
  slave.errors = {Vector::Zero(still.samples())};
  slave.coupling = Matrix::Identity(2, 2);
  slave.noise = slave.response = Vector::Zero(2);
  slave.settled = true;
  const SyncVerdict found = judge(damped_oscillator(1.0), still, slave);
  EXPECT_FALSE(found.decided);
  EXPECT_FALSE(found.holds);
  EXPECT_THAT(found.sentence, HasSubstr("nothing that is measured moves"));
}

TEST(SyncVerdict, BesidePredictionsThatSayOtherwiseItIsOpen) {
  const SyncVerdict holds{.holds = true, .sentence = "Holds: x."};
  const SyncVerdict off{.equation = "v", .sentence = "Does not hold; x."};
  const SyncVerdict later{.until = 3.0, .sentence = "Holds up to 3; x."};
  const Adequacy yes{Adequate::Yes, {}}, no{Adequate::No, {}}, open{};
  EXPECT_TRUE(beside(yes, holds).holds);
  EXPECT_TRUE(beside(open, holds).holds);
  EXPECT_FALSE(beside(no, holds).holds);
  EXPECT_FALSE(beside(no, holds).decided);
  EXPECT_THAT(beside(no, holds).sentence, HasSubstr("Undecided"));
  EXPECT_FALSE(beside(yes, off).decided);
  EXPECT_FALSE(beside(yes, off).equation);
  EXPECT_EQ(beside(no, off).sentence, off.sentence);
  EXPECT_EQ(beside(yes, later).sentence, later.sentence);
}

TEST(SyncVerdict, TheStrongerCouplingIsAnOptionAsItIsRead) {
  Matrix coupling = Matrix::Zero(2, 2);
  EXPECT_THAT(stronger_coupling({{"x", ""}, {"v", ""}}, coupling), HasSubstr("NAME=K"));
  coupling(0, 0) = 1.5;
  EXPECT_THAT(stronger_coupling({{"x", ""}, {"v", ""}}, coupling),
              HasSubstr("--coupling x=3,"));
  coupling(1, 1) = 0.25;
  EXPECT_THAT(stronger_coupling({{"x", ""}, {"v", ""}}, coupling),
              HasSubstr("--coupling x=3,v=0.5,"));
  coupling(0, 0) = -1.5;
  EXPECT_THAT(stronger_coupling({{"x", ""}, {"v", ""}}, coupling),
              ::testing::AllOf(HasSubstr("--coupling x=3,v=0.5 "), HasSubstr("below 0"),
                               ::testing::Not(HasSubstr("stronger"))));
}

/// Rossler's equations with another damping of z, on an orbit sampled at the article's step.
SyncVerdict verdict_on_rossler(double damping, const Integrator& integrator) {
  const auto text = [](double c) {
    return "dx/dt = -y - z\ndy/dt = x + 0.2*y\ndz/dt = 0.2 - " + format_number(c) + "*z + x*z";
  };
  const OdeModel truth = parse_ode(text(5.7), "truth");
  const Dataset data =
      record_of(truth, Dopri8({.substeps = 4}), Vector{{0.1, 0.1, 0.1}}, 0.1, 6000);
  const OdeModel model = parse_ode(text(damping), "model");
  return judge(model, data, synchronise(model, data, integrator));
}

TEST(SyncVerdict, WhatStepsAddIsNamedAndTakenOff) {
  const SyncVerdict right = verdict_on_rossler(5.7, Rk4{});
  EXPECT_TRUE(right.holds) << right.sentence;
  EXPECT_THAT(right.sentence, HasSubstr("that the integrator's steps add"));
  const SyncVerdict wrong = verdict_on_rossler(5.8, Rk4{});
  EXPECT_FALSE(wrong.holds) << wrong.sentence;
  EXPECT_TRUE(wrong.decided) << wrong.sentence;
  const SyncVerdict adapted = verdict_on_rossler(5.7, Dopri5{});
  EXPECT_TRUE(adapted.holds) << adapted.sentence;
  EXPECT_THAT(adapted.sentence, ::testing::Not(HasSubstr("steps add")));
}

TEST(SyncVerdict, ErrorsBelowThoseOfTheStepsLeaveItOpen) {
  const Dataset data = record(0.0, 0.0);
  const OdeModel model = damped_oscillator(1.001);
  SyncResult sync = synchronise(model, data, Rk4{});
  ASSERT_FALSE(judge(model, data, sync).holds);
  ASSERT_TRUE(judge(model, data, sync).decided);
  // Steps whose error is seen only roughly: all but what is left of it is taken off.
  const Matrix left = sync.states[0] - data.trajectories[0].states;
  sync.step_errors = {3.0 * left};
  sync.states[0] += 3.0 * left;
  const SyncVerdict found = judge(model, data, sync);
  EXPECT_FALSE(found.decided) << found.sentence;
  EXPECT_THAT(found.sentence, HasSubstr("--integrator auto"));
}

TEST(SyncVerdict, AnIntegratorThatCannotGoOnShowsNothing) {
  const Dataset data = record(0.01, 0.0);
  const OdeModel model = damped_oscillator(1.0);
  SyncResult result = synchronise(model, data, Rk4{});
  result.message = "run: the slave cannot go on";
  result.status = IntegrationStatus::StepTooSmall;
  const SyncVerdict open = judge(model, data, result);
  EXPECT_FALSE(open.decided);
  EXPECT_THAT(open.sentence, HasSubstr("Undecided: run: the slave cannot go on"));
  EXPECT_THAT(open.sentence, HasSubstr("--integrator rk4"));
  result.status = IntegrationStatus::Diverged;
  EXPECT_TRUE(judge(model, data, result).decided);
}

/// dx/dt = x (1 - x), of which the first of n samples is off.
Dataset growth(Index n, double off) {
  std::mt19937 engine(8);
  std::normal_distribution<double> normal;
  const Vector t = Vector::LinSpaced(n, 0.0, 9.0);
  Matrix states(n, 1);
  for (Index i = 0; i < n; ++i)
    states(i, 0) = 1.0 / (1.0 + 30.0 * std::exp(-t[i])) + 0.01 * normal(engine);
  states(0, 0) = 1.0 / 31.0 + off;
  return {"g", {{"x", ""}}, {}, {{"run", t, states, Matrix(n, 0), Matrix()}}, {}};
}

SyncVerdict verdict_on_growth(const Dataset& data, const std::string& rates) {
  const OdeModel model = parse_ode("time s\nstate x\ndx/dt = " + rates + "\n", "growth");
  return judge(model, data, synchronise(model, data, Rk4{}));
}

TEST(SyncVerdict, ABeginThatTheSlaveDoesNotForgetLeavesItOpen) {
  const SyncVerdict open = verdict_on_growth(growth(200, -0.02), "x*(1-x)");
  EXPECT_FALSE(open.holds);
  EXPECT_FALSE(open.decided) << open.sentence;
  EXPECT_THAT(open.sentence, HasSubstr("first sample"));
  EXPECT_TRUE(verdict_on_growth(growth(200, 0.0), "x*(1-x)").holds);
  EXPECT_TRUE(verdict_on_growth(growth(200, 0.0), "0.5*x*(1-x)").decided);
}

TEST(SyncVerdict, FewSamplesDoNotSpeakAgainstAModel) {
  const SyncVerdict open = verdict_on_growth(growth(14, -0.02), "x*(1-x)");
  EXPECT_FALSE(open.holds);
  EXPECT_FALSE(open.decided) << open.sentence;
  EXPECT_THAT(open.sentence, HasSubstr("lacuna fit ONE.ode TWO.ode DATA"))
      << "diagnose refuses such a record";
  EXPECT_THAT(verdict(1.5, record(0.01, 0.0)).sentence, HasSubstr("see `lacuna diagnose`"));
}

}  // namespace
}  // namespace lacuna
