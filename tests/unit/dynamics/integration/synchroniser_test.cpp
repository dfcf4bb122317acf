// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/integration/synchroniser.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "dynamics/integration/automatic.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

Matrix couple_first(Index m) {
  Matrix coupling = Matrix::Zero(m, m);
  coupling(0, 0) = 1.0;
  return coupling;
}

// A record on the attractor: the start is where the system is after 100 time units.
Dataset record_on_attractor(const std::string& name, const Integrator& integrator, double h,
                            Index n) {
  const TestSystem& system = test_system(name);
  const Solution before =
      simulate(system.model, Dopri8{}, system.start, sample_times(0.0, 0.05, 2001));
  return record_of(system.model, integrator, before.end_state, h, n);
}

void expect_within_quarter(double value, double reference, const char* what) {
  EXPECT_NEAR(value, reference, 0.25 * reference) << what;
}

SyncResult as_in_the_article(const std::string& name, const Dataset& record) {
  return synchronise(test_system(name).model, record, Rk4{}, {.coupling = couple_first(3)});
}

TEST(Synchroniser, TrueRosslerEquationsStayNearTheirOrbit) {
  const Dataset record = record_on_attractor("rossler", Dopri8({.substeps = 4}), 0.1, 10000);
  const SyncResult result = as_in_the_article("rossler", record);
  expect_within_quarter(result.mean, 8.6e-4, "mean");
  expect_within_quarter(result.relative, 3.6e-5, "relative");
  EXPECT_TRUE(result.settled);
}

TEST(Synchroniser, TakesNoiseThatIsKnown) {
  const Dataset record = record_on_attractor("rossler", Dopri8({.substeps = 4}), 0.1, 400);
  const OdeModel& model = test_system("rossler").model;
  const Vector noise = Vector::Constant(3, 0.125);
  EXPECT_EQ(synchronise(model, record, Rk4{}, {.noise = noise}).noise, noise);
  EXPECT_THROW(synchronise(model, record, Rk4{}, {.noise = Vector::Ones(2)}), ArgumentError);
}

TEST(Synchroniser, PiecesThatAreTooShortAreLeftOut) {
  Dataset record = record_on_attractor("rossler", Dopri8({.substeps = 4}), 0.1, 400);
  const Dataset whole = record;
  Trajectory piece = record.trajectories[0];
  piece.time = Vector(piece.time.head(3));
  piece.states = Matrix(piece.states.topRows(3));
  piece.inputs = Matrix(piece.inputs.topRows(3));
  piece.derivatives.resize(0, 0);
  record.trajectories.insert(record.trajectories.begin(), piece);
  const Dataset left = long_enough(record, Rk4{});
  ASSERT_EQ(left.trajectories.size(), 1u);
  ASSERT_FALSE(left.notes.empty());
  EXPECT_EQ(left.notes.back(), "1 pieces of less than 4 samples were left out");
  EXPECT_EQ(as_in_the_article("rossler", left).median,
            as_in_the_article("rossler", whole).median);
  // Where nothing would be left, synchronise() says what is wrong.
  record.trajectories.pop_back();
  EXPECT_THROW(as_in_the_article("rossler", long_enough(record, Rk4{})), DataError);
}

TEST(Synchroniser, TwoRungeKuttaModelsDifferByTheInterpolationOnly) {
  const Dataset coarse = record_on_attractor("rossler", Rk4{}, 0.1, 10000);
  const SyncResult at_tenth = as_in_the_article("rossler", coarse);
  expect_within_quarter(at_tenth.median, 7.8e-5, "median at h = 0.1");
  expect_within_quarter(at_tenth.relative, 9.8e-6, "relative at h = 0.1");
  const Dataset fine = record_on_attractor("rossler", Rk4{}, 0.01, 10000);
  const SyncResult at_hundredth = as_in_the_article("rossler", fine);
  expect_within_quarter(at_hundredth.median, 8.3e-9, "median at h = 0.01");
}

// A method of order p and the polynomial through p samples: the error falls as h^p.
TEST(Synchroniser, ErrorFallsWithTheOrderOfTheMethod) {
  const double length = 60.0;
  const auto error = [&](int order, double h) {
    const Dataset record = record_on_attractor("rossler", Dopri8({.substeps = 4}), h,
                                               static_cast<Index>(length / h) + 1);
    return synchronise(test_system("rossler").model, record, RungeKutta({.order = order})).mean;
  };
  for (int order = 2; order <= 8; ++order)
    EXPECT_NEAR(std::log2(error(order, 0.06) / error(order, 0.03)), order, 0.5) << order;
}

TEST(Synchroniser, StatisticsAreThoseOfTheErrors) {
  const Dataset record = record_on_attractor("lorenz", Dopri8{}, 0.01, 501);
  const SyncResult result = synchronise(test_system("lorenz").model, record, Rk4{});
  ASSERT_EQ(result.errors.size(), 1u);
  Vector errors = result.errors[0];
  ASSERT_EQ(result.states.size(), 1u);
  const Matrix off = result.states[0] - record.trajectories[0].states;
  EXPECT_LT((off.rowwise().norm() - errors).cwiseAbs().maxCoeff(), 1e-14);
  ASSERT_EQ(errors.size(), 501);
  EXPECT_EQ(errors[0], 0.0);
  std::sort(errors.begin(), errors.end());
  EXPECT_DOUBLE_EQ(result.median, errors[250]);
  EXPECT_NEAR(result.mean, errors.mean(), 1e-15);
  const double largest = record.trajectories[0].states.rowwise().norm().maxCoeff();
  EXPECT_DOUBLE_EQ(result.relative, result.mean / largest);
}

TEST(Synchroniser, WrongStartIsForgotten) {
  const Dataset record = record_on_attractor("lorenz", Dopri8{}, 0.01, 2000);
  const Vector start = record.trajectories[0].states.row(0).transpose().array() + 5.0;
  const SyncResult result =
      synchronise(test_system("lorenz").model, record, Rk4{}, {.coupling = {}, .start = start});
  EXPECT_NEAR(result.errors[0][0], 5.0 * std::sqrt(3.0), 1e-9);
  EXPECT_LT(result.errors[0][1999], 1e-3);
  EXPECT_TRUE(result.settled);
}

TEST(Synchroniser, UncoupledChaosDoesNotSettle) {
  const Dataset record = record_on_attractor("lorenz", Dopri8{}, 0.01, 8000);
  const Matrix none = Matrix::Zero(3, 3);
  const SyncResult result =
      synchronise(test_system("lorenz").model, record, Rk4{}, {.coupling = none});
  EXPECT_FALSE(result.settled);
  EXPECT_EQ(result.status, IntegrationStatus::Completed);
}

TEST(Synchroniser, FullMatrixMixesStates) {
  // In y the slave is driven by the error of x only: K has its entry at (y, x).
  const Dataset record = record_on_attractor("lorenz", Dopri8{}, 0.01, 3000);
  Matrix coupling = Matrix::Zero(3, 3);
  coupling(1, 0) = 30.0;
  const Vector start = record.trajectories[0].states.row(0).transpose().array() + 1.0;
  const OdeModel& model = test_system("lorenz").model;
  const SyncResult mixed = synchronise(model, record, Rk4{}, {coupling, start});
  EXPECT_TRUE(mixed.settled);
  EXPECT_LT(mixed.median, 1e-3);
  EXPECT_FALSE(synchronise(model, record, Rk4{}, {coupling.transpose(), start}).settled);
}

Dataset driven_record(double h, Index n) {
  const Vector time = sample_times(0.0, h, n);
  Dataset record;
  record.states = {{"spare", ""}, {"x", "V"}};
  record.inputs = {{"other", ""}, {"u", "V"}};
  Matrix states(n, 2), inputs(n, 2);
  states << Vector::Zero(n), time.array().sin().matrix();
  inputs << Vector::Ones(n), time.array().cos().matrix();
  record.trajectories = {{"a.csv", time, states, inputs, Matrix()}};
  return record;
}

OdeModel integrator_model(const std::string& term) {
  const Variables variables{{"x"}, {"u"}};
  return OdeModel({{"x", "V"}}, {{"u", "V"}}, {{{Term::parse(term, variables), 1.0, {}, {}}}});
}

TEST(Synchroniser, FindsItsColumnsByNameAndInterpolatesInputs) {
  const SyncResult result = synchronise(integrator_model("u"), driven_record(0.05, 400), Rk4{});
  EXPECT_LT(result.errors[0].maxCoeff(), 1e-6);
  EXPECT_GT(result.errors[0].maxCoeff(), 0.0);
}

TEST(Synchroniser, UnevenSamplingIsNoObstacle) {
  Dataset record = driven_record(0.05, 400);
  Trajectory& run = record.trajectories[0];
  for (Index i = 0; i < 400; ++i) {
    run.time[i] += 0.02 * std::sin(static_cast<double>(i));
    run.states(i, 1) = std::sin(run.time[i]);
    run.inputs(i, 1) = std::cos(run.time[i]);
  }
  const SyncResult result = synchronise(integrator_model("u"), record, Rk4{});
  EXPECT_LT(result.errors[0].maxCoeff(), 3e-6);
}

TEST(Synchroniser, DelayedVariablesAreThoseOfTheRecord) {
  const OdeModel model = integrator_model("delay(u,0.3)");
  Dataset record = driven_record(0.05, 400);
  Trajectory& run = record.trajectories[0];
  run.states.col(1) = (run.time.array() - 0.3).sin();
  const SyncResult result = synchronise(model, record, Rk4{});
  EXPECT_LT(result.errors[0].tail(300).maxCoeff(), 1e-4);
}

/// x measured, z as a view has it that nobody measured; noise is as it comes in a record.
Dataset half_measured(const OdeModel& model) {
  Trajectory run;
  run.time = Vector::LinSpaced(2001, 0.0, 20.0);
  run.states = Matrix::Zero(2001, 2);
  run.states.col(0) = run.time.array().sin();
  run.marks = Matrix::Zero(2001, 2);
  run.marks.col(1).setConstant(number_of(Mark::Missing));
  Dataset data = support::one_record(model.states(), {}, run);
  data.reconstructed = {false, true};
  return data;
}

TEST(Synchroniser, HiddenStatesGoAloneFromWhereTheModelSays) {
  // dz/dt = sin t - z/2 from z(0) = 2 is 2.8 exp(-t/2) + 0.4 sin t - 0.8 cos t.
  const OdeModel model = parse_ode("dx/dt = cos(t)\ndz/dt = x - 0.5*z\ninitial z = 2\n", "t");
  const SyncResult result = synchronise(model, half_measured(model), Rk4{});
  EXPECT_EQ(result.coupling(1, 1), 0.0);
  EXPECT_GT(result.coupling(0, 0), 0.0);
  const double t = 7.0;
  EXPECT_NEAR(result.states[0](700, 1),
              2.8 * std::exp(-0.5 * t) + 0.4 * std::sin(t) - 0.8 * std::cos(t), 1e-6);
  EXPECT_LT(result.errors[0].maxCoeff(), 1e-6) << "the hidden state is no error";
  ASSERT_TRUE(result.conditional_exponent);
  EXPECT_NEAR(*result.conditional_exponent, -0.5, 1e-5);
}

TEST(Synchroniser, AHiddenStateIsNotCoupled) {
  const OdeModel model = parse_ode("dx/dt = cos(t)\ndz/dt = x - 0.5*z\n", "t");
  const Dataset record = half_measured(model);
  EXPECT_THROW(synchronise(model, record, Rk4{}, {.coupling = Matrix::Identity(2, 2)}),
               ArgumentError);
  const Matrix first = Vector::Unit(2, 0).asDiagonal();
  EXPECT_EQ(synchronise(model, record, Rk4{}, {.coupling = first}).coupling, first);
}

TEST(Synchroniser, AHiddenIntegralIsNotTold) {
  const OdeModel model = parse_ode("dx/dt = cos(t)\ndz/dt = x\n", "t");
  const SyncResult result = synchronise(model, half_measured(model), Rk4{});
  EXPECT_NEAR(result.conditional_exponent.value(), 0.0, 1e-9);
}

TEST(Synchroniser, ThePastOfAHiddenStateIsRefused) {
  const OdeModel model = parse_ode("dx/dt = cos(t)\ndz/dt = x - delay(z,0.5)\n", "t");
  EXPECT_THROW(synchronise(model, half_measured(model), Rk4{}), ModelError);
}

TEST(Synchroniser, DivergenceIsReportedWithPlace) {
  const OdeModel model = integrator_model("exp(x^2)*1000");
  const SyncResult result = synchronise(model, driven_record(0.05, 400), Rk4{});
  EXPECT_EQ(result.status, IntegrationStatus::Diverged);
  EXPECT_FALSE(result.settled);
  EXPECT_LT(result.errors[0].size(), 400);
  EXPECT_THAT(result.message,
              testing::MatchesRegex("a.csv: the slave diverged at t = .* s with "
                                    "x = .*"));
}

TEST(Synchroniser, MissingColumnsAndWrongShapesAreErrors) {
  const OdeModel model = integrator_model("u");
  Dataset record = driven_record(0.05, 400);
  EXPECT_THROW(synchronise(model, record, Rk4{}, {.coupling = couple_first(2)}), ArgumentError);
  EXPECT_THROW(synchronise(model, record, Rk4{}, {.coupling = {}, .start = Vector::Zero(2)}),
               ArgumentError);
  EXPECT_THROW(synchronise(model, driven_record(0.05, 3), Rk4{}), DataError);
  record.inputs[1].name = "v";
  EXPECT_THROW(synchronise(model, record, Rk4{}), DataError);
  record.states[1].name = "y";
  EXPECT_THROW(synchronise(model, record, Rk4{}), DataError);
}

/// dx/dt = -2 x + u, u held: the record is exact, so that the slave stays on it.
TEST(Synchroniser, AHeldInputJumpsAtItsSamples) {
  const Variables variables{{"x"}, {"u"}};
  const OdeModel model({{"x", ""}}, {{"u", "", Hold::Zero}},
                       {{{Term::parse("x", variables), -2.0, {}, {}},
                         {Term::parse("u", variables), 1.0, {}, {}}}});
  constexpr Index kSamples = 60;
  Dataset record{
      .states = model.states(), .inputs = model.inputs(), .trajectories = {}, .rate_of = {}};
  Trajectory run{"made", Vector::LinSpaced(kSamples, 0.0, 5.9), Matrix(kSamples, 1),
                 Matrix(kSamples, 1), Matrix()};
  double x = 0.4;
  for (Index i = 0; i < kSamples; ++i) {
    const double u = (i / 7) % 2 == 0 ? 1.0 : -0.5;
    run.states(i, 0) = x;
    run.inputs(i, 0) = u;
    x = 0.5 * u + (x - 0.5 * u) * std::exp(-0.2);
  }
  record.trajectories.push_back(run);
  // The coupling to the interpolated record would add its own error.
  const SyncOptions alone{.coupling = Matrix::Zero(1, 1)};
  const Dopri8 exact({.substeps = 4});
  EXPECT_LT(synchronise(model, record, exact, alone).mean, 1e-10);
  EXPECT_GT(synchronise(model.with_holds({Hold::Smooth}), record, exact, alone).mean, 1e-3);
}

/// A tank that drains and is filled by a sine; the model lacks a tenth of the drain.
TEST(Synchroniser, AnErrorThatIsNotNoiseIsTold) {
  const Variables variables{{"h"}, {}};
  const auto tank = [&](double drain) {
    return OdeModel({{"h", "m"}}, {},
                    {{{Term::parse("h^2", variables), -drain, {}, {}},
                      {Term::parse("1", variables), 1.0, {}, {}},
                      {Term::parse("sin(0.7*t)", variables), 0.8, {}, {}}}});
  };
  Dataset record{.states = {{"h", "m"}}, .inputs = {}, .trajectories = {}, .rate_of = {}};
  const Vector time = sample_times(0.0, 0.05, 800);
  const Solution motion = simulate(tank(1.0), Dopri8{}, Vector{{1.0}}, time);
  record.trajectories.push_back({"made", time, motion.states, Matrix(800, 0), Matrix()});
  Random random(3);
  for (double& value : record.trajectories[0].states.reshaped())
    value += 0.002 * random.normal();
  const SyncResult right = synchronise(tank(1.0), record, Rk4{});
  const SyncResult wrong = synchronise(tank(0.9), record, Rk4{});
  EXPECT_NEAR(right.noise[0], 0.002, 0.0004);
  EXPECT_LT(*right.error_over_noise, 1.3);
  EXPECT_TRUE(wrong.settled);
  EXPECT_GT(*wrong.error_over_noise, 10.0);
}

/// dx/dt = -x + k (x_m - x) filters white noise: the variance is that of the filter.
TEST(Synchroniser, TheResponseToNoiseIsThatOfTheSlaveAlone) {
  const Variables variables{{"x"}, {}};
  const OdeModel model({{"x", ""}}, {}, {{{Term::parse("x", variables), -1.0}}});
  const Dataset clean = record_of(model, Dopri87{}, Vector::Constant(1, 1.0), 0.01, 20000);
  Dataset noisy = clean;
  Random random(3);
  for (double& x : noisy.trajectories.front().states.reshaped()) x += 0.1 * random.normal();
  const SyncOptions coupling{.coupling = Matrix::Constant(1, 1, 9.0)};
  const SyncResult result = synchronise(model, noisy, Rk4{}, coupling);
  // k sigma sqrt(h / (2 (1 + k))) in the limit of small steps.
  EXPECT_NEAR(result.response[0], 9.0 * 0.1 * std::sqrt(0.01 / 20.0), 0.002);
  EXPECT_LT(synchronise(model, clean, Rk4{}, coupling).response[0], 1e-12);
}

TEST(Synchroniser, TheNoiseOfTheResponseIsDrawnBySeed) {
  const Variables variables{{"x"}, {}};
  const OdeModel model({{"x", ""}}, {}, {{{Term::parse("x", variables), -1.0}}});
  Dataset noisy = record_of(model, Rk4{}, Vector::Constant(1, 1.0), 0.01, 5000);
  Random random(3);
  for (double& x : noisy.trajectories.front().states.reshaped()) x += 0.1 * random.normal();
  const auto response = [&](std::uint64_t seed) {
    RunContext context;
    context.seed = seed;
    const SyncOptions coupling{.coupling = Matrix::Constant(1, 1, 9.0)};
    return synchronise(model, noisy, Rk4{}, coupling, context).response[0];
  };
  EXPECT_EQ(response(1), response(1));
  EXPECT_NE(response(1), response(2));
  EXPECT_NEAR(response(2), response(1), 0.2 * response(1));
}

/// A stage whose fast pole lies at 3 / h of records with the step h.
OdeModel fast_stage(double pole) {
  return parse_ode("input u hold zero\ndy/dt = " + std::to_string(pole) + "*(u - y)\n", "fast");
}

TEST(Synchroniser, ASlaveThatIsFasterThanTheSamplesIsIntegratedInShorterSteps) {
  constexpr double kStep = 1e-3;
  Dataset data{"s", {{"y", ""}}, {{"u", ""}}, {}, {}};
  Trajectory record{"fast", Vector::LinSpaced(200, 0.0, 199 * kStep), Matrix(200, 1),
                    Matrix(200, 1), Matrix()};
  const double pole = 8.0 / kStep, decay = std::exp(-8.0);
  double y = 0.0;
  for (Index i = 0; i < 200; ++i) {
    record.states(i, 0) = y;
    record.inputs(i, 0) = i / 20 % 2 == 0 ? 1.0 : -1.0;
    y = record.inputs(i, 0) + (y - record.inputs(i, 0)) * decay;
  }
  data.trajectories = {record};
  const SyncResult result = synchronise(fast_stage(pole), data, Rk4{});
  EXPECT_EQ(result.status, IntegrationStatus::Completed) << result.message;
  EXPECT_TRUE(result.stiff);
  EXPECT_TRUE(result.settled);
  EXPECT_LT(result.relative, 0.01);
  EXPECT_FALSE(synchronise(fast_stage(0.1 / kStep), data, Rk4{}).stiff);
  EXPECT_TRUE(synchronise(fast_stage(pole), data, Automatic{}).stiff);
  EXPECT_FALSE(synchronise(fast_stage(0.1 / kStep), data, Automatic{}).stiff);
  const SyncResult away = synchronise(fast_stage(-1e5), data, Rk4{});
  EXPECT_EQ(away.status, IntegrationStatus::Diverged) << "unstable, not stiff";
  EXPECT_FALSE(away.stiff);
}

TEST(Synchroniser, HalvingStepsShowsWhatTheyAdd) {
  const Dataset record = record_on_attractor("rossler", Dopri8({.substeps = 4}), 0.1, 4000);
  const SyncResult coarse = as_in_the_article("rossler", record);
  const SyncResult fine = synchronise(test_system("rossler").model, record,
                                      Dopri8({.substeps = 4}), {.coupling = couple_first(3)});
  ASSERT_EQ(coarse.step_errors.size(), 1u);
  const Matrix added = coarse.states[0] - fine.states[0];
  EXPECT_LT((coarse.step_errors[0] - added).norm(), 0.1 * added.norm());
  EXPECT_LT(fine.step_errors[0].norm(), 0.01 * added.norm());
  EXPECT_TRUE(synchronise(test_system("rossler").model, record, Dopri5{}).step_errors.empty());
}

// 160 periods in a sample are more than adaptive steps may be that follow each of them.
TEST(Synchroniser, FixedStepsGoOnWhereAdaptiveOnesGetTooSmall) {
  const OdeModel model = parse_ode("time s\nstate x\ndx/dt = 1 - x + 1000*cos(10000*t)\n", "fast");
  const Vector time = sample_times(0.0, 0.1, 40);
  const Matrix states = Matrix::Ones(40, 1) - Matrix((-time.array()).exp());
  const Dataset record{
      "r", {{"x", ""}}, {}, {{"run", time, states, Matrix(40, 0), Matrix()}}, {}};
  const StepControl few{.max_steps = 500};
  const SyncResult found = synchronise(model, record, Automatic({few}));
  ASSERT_EQ(found.status, IntegrationStatus::Completed) << found.message;
  EXPECT_TRUE(found.by_fixed_steps);
  EXPECT_EQ(found.step_errors.size(), 1u);
  EXPECT_EQ(found.states, synchronise(model, record, Rk4()).states);
  EXPECT_EQ(synchronise(model, record, Dopri5({few})).status, IntegrationStatus::StepTooSmall)
      << "who asks for adaptive steps gets these or none";
}

}  // namespace
}  // namespace lacuna
