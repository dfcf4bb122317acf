// SPDX-License-Identifier: MIT
#include "trajectories/shooting/refine.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "unit/trajectories/shooting/records.hpp"

namespace lacuna {
namespace {

using testing::clean_record;
using testing::noisy_record;
using testing::perturbed;
using testing::without_states;

/// Largest |estimate - truth| in standard errors.
double worst_score(const Refinement& result, const Vector& truth) {
  return (result.model.values() - truth)
      .cwiseQuotient(result.standard_errors)
      .cwiseAbs()
      .maxCoeff();
}

TEST(Refine, FindsLorenzInNoise) {
  const ParametrisedModel truth = with_free_coefficients(test_system("lorenz").model);
  const Refinement result = refine(perturbed(truth, 0.05), noisy_record("lorenz", 1000, 0.02));
  EXPECT_EQ(result.status, RefineStatus::Converged) << result.message;
  EXPECT_LT(worst_score(result, truth.values()), 4.0);
  EXPECT_LT(result.standard_errors.maxCoeff(), 0.1);
  EXPECT_TRUE(result.fits_to_noise);
  EXPECT_NEAR(result.chi_squared / static_cast<double>(result.degrees_of_freedom), 1.0, 0.02);
}

TEST(Refine, PastTheDeadlineItIsTheFitInTheFirstWindows) {
  const ParametrisedModel truth = with_free_coefficients(test_system("lorenz").model);
  const Dataset record = noisy_record("lorenz", 1000, 0.02);
  RunContext late;
  late.deadline = std::chrono::steady_clock::now();
  EXPECT_THROW(refine(truth, record, {}, late), OutOfTime);
  const Refinement cut = refine(perturbed(truth, 0.05), record, {.may_be_cut = true}, late);
  const Refinement whole = refine(perturbed(truth, 0.05), record, {.may_be_cut = true});
  EXPECT_FALSE(cut.in_time);
  EXPECT_TRUE(whole.in_time);
  EXPECT_GT(cut.windows.size(), whole.windows.size());
  EXPECT_LT(worst_score(cut, truth.values()), 4.0);
  EXPECT_GT(cut.standard_errors.norm(), whole.standard_errors.norm());
}

TEST(Refine, CleanRecordGivesTheModelToRounding) {
  const ParametrisedModel truth = with_free_coefficients(test_system("rossler").model);
  const TestSystem& system = test_system("rossler");
  const Refinement result =
      refine(perturbed(truth, 0.01), clean_record(system.model, system, 500));
  EXPECT_LT((result.model.values() - truth.values()).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Refine, MissingTermIsSeenInTheResiduals) {
  const TestSystem& system = test_system("lorenz");
  const OdeModel truth =
      system.model.with_term(1, {Term::parse("y*z", system.model.variables()), 0.01});
  const Dataset record = add_relative_noise(clean_record(truth, system, 2000), 0.005, 1);
  EXPECT_FALSE(refine(with_free_coefficients(system.model), record).fits_to_noise);
  EXPECT_TRUE(refine(with_free_coefficients(truth), record).fits_to_noise);
}

TEST(Refine, ErrorsOfAModelThatIsNotExactComeFromBlocks) {
  const TestSystem& system = test_system("pendulum");
  const OdeModel truth =
      system.model.with_term(1, {Term::parse("w^3", system.model.variables()), -0.01});
  const Dataset record = add_relative_noise(clean_record(truth, system, 2000), 0.001, 1);
  const ParametrisedModel lacking = with_free_coefficients(system.model, {true, false});
  const Refinement inexact = refine(lacking, record);
  EXPECT_FALSE(inexact.white);
  EXPECT_GT(inexact.standard_errors[1], 1.5 * inexact.bound[1]);
  const Refinement exact = refine(with_free_coefficients(truth, {true, false}), record);
  EXPECT_TRUE(exact.white);
  EXPECT_EQ(exact.standard_errors, exact.bound);
}

/// The record with a fifth of its samples left out at random, as the reader gives it.
Dataset with_missing_samples(const Dataset& record, std::uint64_t seed) {
  const Trajectory& run = record.trajectories[0];
  Random random(seed);
  Dataset result = record;
  result.trajectories.clear();
  Index first = 0;
  for (Index i = 0; i <= run.samples(); ++i) {
    if (i < run.samples() && random.uniform() > 0.2) continue;
    if (i - first >= 2)
      result.trajectories.push_back({.source = "run.csv, piece " + std::to_string(i),
                                     .time = run.time.segment(first, i - first),
                                     .states = run.states.middleRows(first, i - first),
                                     .inputs = Matrix(i - first, 0),
                                     .derivatives = {}});
    first = i + 1;
  }
  return result;
}

TEST(Refine, GoesOnAcrossMissingSamples) {
  const ParametrisedModel truth = with_free_coefficients(test_system("lorenz").model);
  const Dataset whole = noisy_record("lorenz", 1000, 0.01);
  const Dataset record = with_missing_samples(whole, 2);
  ASSERT_GT(record.trajectories.size(), 100u);
  const Refinement result = refine(perturbed(truth, 0.05), record);
  EXPECT_LT(result.windows.size(), 20u);
  EXPECT_LT(worst_score(result, truth.values()), 4.0);
  EXPECT_LT(result.standard_errors.norm(), 2.0 * refine(truth, whole).standard_errors.norm());
}

TEST(Refine, UnitsDoNotMatter) {
  const ParametrisedModel model = with_free_coefficients(test_system("van-der-pol").model);
  const Dataset record = noisy_record("van-der-pol", 500, 0.02);
  Dataset small = record;
  small.trajectories[0].states.col(0) *=
      1e-6;  // dq/dt = 1e-6 v, dv/dt = -1e6 q + v - 1e12 q^2 v
  const Vector scale = (Vector(4) << 1e-6, 1e6, 1.0, 1e12).finished();
  const Refinement reference = refine(model, record);
  const Refinement scaled =
      refine(model.with_values(model.values().cwiseProduct(scale)), small);
  EXPECT_LT((scaled.model.values().cwiseQuotient(scale) - reference.model.values())
                .cwiseQuotient(reference.standard_errors)
                .cwiseAbs()
                .maxCoeff(),
            1e-2);
}

/// Errors of a limit cycle do not grow: windows of a few periods know all that there is.
TEST(Refine, WindowsOfAnOrderlyModelGrowUnlessTheyAreGiven) {
  const ParametrisedModel model = with_free_coefficients(test_system("van-der-pol").model);
  const Dataset record = noisy_record("van-der-pol", 600, 0.03);
  EXPECT_LE(refine(model, record).windows.size(), 4u);
  EXPECT_EQ(refine(model, record, {.window_samples = 30}).windows.size(), 20u);
  EXPECT_THROW(refine(model, record, {.window_samples = 1}), ArgumentError);
}

/// Its windows are simulated in groups.
TEST(Refine, ALongRecordIsFittedAlikeOnAnyNumberOfThreads) {
  const ParametrisedModel truth = with_free_coefficients(test_system("van-der-pol").model);
  const auto found = [&](int threads) {
    RunContext context;
    context.threads = threads;
    return refine(perturbed(truth, 0.01), noisy_record("van-der-pol", 9000, 0.01),
                  {.window_samples = 45}, context);
  };
  const Refinement one = found(1);
  EXPECT_EQ(one.windows.size(), 200u);
  EXPECT_LT(worst_score(one, truth.values()), 4.0);
  for (const int threads : {2, 3}) {
    const Refinement several = found(threads);
    EXPECT_EQ(several.model.values(), one.model.values());
    EXPECT_EQ(several.standard_errors, one.standard_errors);
  }
}

TEST(Refine, StatesWithoutAColumnAreReconstructed) {
  const ParametrisedModel truth =
      with_free_coefficients(test_system("pendulum").model, {true, false});
  const Dataset record = without_states(noisy_record("pendulum", 1500, 0.01), 1, 1);
  const Refinement result = refine(perturbed(truth, 0.1), record);
  EXPECT_EQ(result.measured, (std::vector<Index>{0}));
  EXPECT_LT(worst_score(result, truth.values()), 4.0);
}

TEST(Refine, NamesAStateThatNothingDefines) {
  const Dataset record = without_states(noisy_record("lorenz", 200, 0.01), 0, 1);
  try {
    refine(
        with_free_coefficients(OdeModel({{"x", ""}, {"y", ""}, {"z", ""}}, {}, {{}, {}, {}})),
        record);
    ADD_FAILURE() << "nothing thrown";
  } catch (const DataError& error) {
    EXPECT_NE(error.problem().find("'x'"), std::string::npos) << error.what();
  }
}

/// A driven, damped oscillator with a stop at b, unequal steps, two records.
struct Driven {
  Variables variables{{"q", "v"}, {"u", "b"}};
  OdeModel symbolic{{{"q", "m"}, {"v", "m/s"}},
                    {{"u", "N"}, {"b", "m"}},
                    {{{Term::parse("v", variables), 1.0}},
                     {{Term::parse("q", variables), -4.0},
                      {Term::parse("v", variables), -0.4},
                      {Term::parse("max(0,q-b)", variables), -20.0},
                      {Term::parse("u", variables), 1.0}}}};
  ParametrisedModel truth = with_free_coefficients(symbolic, {true, false}, {{"b", 0.3}});

  Dataset record(double noise) const {
    Dataset data;
    data.states = symbolic.states();
    data.inputs = {{"u", "N"}};
    for (int r = 0; r < 2; ++r) data.trajectories.push_back(run(r));
    return add_relative_noise(data, noise, 5);
  }

  Trajectory run(int number) const {
    const Index n = 800;
    Random random(static_cast<std::uint64_t>(number));
    Vector time(n);
    for (Index i = 0; i < n; ++i)
      time[i] = i == 0 ? 0.0 : time[i - 1] + 0.02 * random.uniform(0.5, 1.5);
    const auto drive = [&](double t, double* u) {
      u[0] = std::sin(1.3 * t + number) + 0.7 * std::sin(2.9 * t);
    };
    const OdeModel model = truth.model();
    const Solution orbit =
        simulate(DrivenModel{model, drive}, Dopri8{Dopri8Options{.substeps = 8}},
                 (Vector(2) << 0.1 * number, 0.0).finished(), time);
    Matrix inputs(n, 1);
    for (Index i = 0; i < n; ++i) drive(time[i], &inputs(i, 0));
    return {"run", time, orbit.states, inputs, Matrix()};
  }
};

TEST(Refine, ShapeParametersInputsUnequalStepsAndSeveralRecords) {
  const Driven driven;
  const Refinement result =
      refine(perturbed(driven.truth, 0.1), without_states(driven.record(0.01), 1, 1));
  EXPECT_EQ(result.status, RefineStatus::Converged);
  EXPECT_LT(worst_score(result, driven.truth.values()), 4.0);
  EXPECT_LT(result.standard_errors[4], 0.01);
  EXPECT_TRUE(result.fits_to_noise);
}

TEST(Refine, APriorHoldsAParameterThatTheRecordDoesNotKnow) {
  const OdeModel& model = test_system("pendulum").model;
  const Vector truth = with_free_coefficients(model, {true, false}).values();
  const ParametrisedModel prior(model, {{1, 0, Prior{truth[0], 1e-6}}, {1, 1}});
  const Refinement result = refine(prior, noisy_record("pendulum", 400, 0.05));
  EXPECT_NEAR(result.model.values()[0], truth[0], 5e-6);
  EXPECT_NEAR(result.standard_errors[0], 1e-6, 1e-7);
  EXPECT_GT(result.standard_errors[1], 1e-4);
}

TEST(Refine, RobustLossBearsOutliers) {
  Dataset record = noisy_record("lorenz", 1000, 0.01);
  Random random(3);
  Matrix& states = record.trajectories[0].states;
  for (int i = 0; i < 10; ++i)
    states(static_cast<Index>(random.below(1000)), 0) += random.uniform(-20.0, 20.0);
  const ParametrisedModel truth = with_free_coefficients(test_system("lorenz").model);
  const Refinement robust = refine(perturbed(truth, 0.02), record, {.huber = 1.345});
  const Refinement plain = refine(perturbed(truth, 0.02), record);
  EXPECT_LT(worst_score(robust, truth.values()), 4.0);
  EXPECT_LT(robust.standard_errors[0], 0.7 * plain.standard_errors[0]);
}

TEST(Refine, DivergenceIsAResult) {
  const Variables variables{{"x"}, {}};
  const OdeModel explosive({{"x", ""}}, {}, {{{Term::parse("exp(x^2)", variables), 1e6}}});
  Dataset record;
  record.states = {{"x", ""}};
  record.trajectories.push_back(
      {"run", Vector::LinSpaced(50, 0.0, 5.0), Matrix::Random(50, 1) * 3.0, Matrix(50, 0), {}});
  const Refinement result = refine(with_free_coefficients(explosive), record);
  EXPECT_EQ(result.status, RefineStatus::Diverged);
  EXPECT_FALSE(result.message.empty());
  EXPECT_TRUE(result.model.values().allFinite());
  EXPECT_FALSE(result.fits_to_noise);
}

}  // namespace
}  // namespace lacuna
