// SPDX-License-Identifier: MIT
#include "lacuna/identify/bench/bench.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "bases/monomials.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "regression/filters/none.hpp"
#include "regression/formulations/strong_form.hpp"
#include "regression/pruners/keep_all.hpp"
#include "solvers/ols.hpp"
#include "solvers/stlsq.hpp"
#include "trajectories/refiners/no_refiner.hpp"

namespace lacuna {
namespace {

Dataset lorenz_record() {
  const TestSystem& system = test_system("lorenz");
  const Vector times = sample_times(0.0, 0.01, 1500);
  const Solution orbit = simulate(system.model, Dopri87{}, system.start, times);
  Dataset data;
  data.states = system.model.states();
  data.trajectories.push_back({"lorenz", times, orbit.states, Matrix(1500, 0), Matrix()});
  return data;
}

Pipeline pipeline_with(Stage<Regressor> regressor) {
  return {.basis = Monomials{{.max_degree = 2}},
          .formulation = StrongForm{{.differentiator = FiniteDifferences{}}},
          .filter = NoFilter{},
          .regressor = std::move(regressor),
          .pruner = KeepAll{},
          .refiner = NoRefiner{}};
}

BenchTask two_regressors() {
  return {.data = lorenz_record(),
          .truth = test_system("lorenz").model,
          .kinds = {"regressor"},
          .compositions = {{{"ols"}, pipeline_with(Ols{})}, {{"stlsq"}, pipeline_with(Stlsq{})}},
          .noise = {0.0, 0.001},
          .draws = 3};
}

TEST(Bench, CountsExactStructuresOfEveryComposition) {
  const BenchResult result = bench(two_regressors());
  ASSERT_EQ(result.cells.size(), 4u);
  EXPECT_EQ(result.cell(0, 0).scores.size(), 1u);  // without noise all draws are the same
  EXPECT_EQ(result.cell(1, 1).scores.size(), 3u);
  const BenchSummary all = summary_of(result.cell(0, 0)), few = summary_of(result.cell(1, 0));
  EXPECT_EQ(all.exact_rate, 0.0);
  EXPECT_EQ(all.terms, 30.0);  // OLS keeps the ten monomials of each equation
  EXPECT_EQ(few.exact_rate, 1.0);
  EXPECT_EQ(few.terms, 7.0);
  EXPECT_LT(*few.coefficient_error, 1e-3);
  EXPECT_LT(*few.sync, 1e-3);
}

TEST(Bench, DrawsAreTheSameForAllCompositionsAndEveryRun) {
  const BenchResult a = bench(two_regressors()), b = bench(two_regressors());
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(summary_of(a.cells[i]).coefficient_error, summary_of(b.cells[i]).coefficient_error);
  const Dataset record = lorenz_record();
  const Dataset noisy = add_relative_noise(record, 0.1, 5, NoisyRates::Kept);
  const Matrix difference = noisy.trajectories[0].states - record.trajectories[0].states;
  for (Index k = 0; k < 3; ++k) {
    const Vector column = record.trajectories[0].states.col(k);
    const double spread = std::sqrt((column.array() - column.mean()).square().mean());
    EXPECT_NEAR(difference.col(k).norm() / std::sqrt(1500.0) / spread, 0.1, 0.01);
  }
}

TEST(Bench, GoesOnWhereACompositionFails) {
  BenchTask task = two_regressors();
  task.compositions[0].pipeline.formulation =
      StrongForm{{.differentiator = FiniteDifferences{{.order = 2}}}};
  task.compositions[0].pipeline.equations = {{"no_such_state", {"x"}}};
  const BenchResult result = bench(task);
  ASSERT_EQ(result.cell(0, 0).failures.size(), 1u);
  EXPECT_NE(result.cell(0, 0).failures.front().find("no_such_state"), std::string::npos);
  EXPECT_FALSE(summary_of(result.cell(0, 0)).terms);
  EXPECT_EQ(summary_of(result.cell(1, 0)).exact_rate, 1.0);
}

TEST(Bench, ProgressCountsCellsAndAStopEndsIt) {
  std::vector<double> seen;
  RunContext context;
  std::stop_source stop;
  context.stop = stop.get_token();
  context.progress = [&](const Progress& progress) {
    seen.push_back(progress.fraction);
    if (seen.size() == 3) stop.request_stop();
  };
  EXPECT_THROW(bench(two_regressors(), context), Cancelled);
  EXPECT_EQ(seen, (std::vector<double>{0.0, 0.25, 0.5}));
}

TEST(Bench, SummariesAreMediansAndDivergedDrawsRankLast) {
  BenchCell cell{0, 0.1, {}, {"no model"}};
  for (const double error : {0.3, 0.1, 0.2}) {
    BenchScore score{.exact_structure = error < 0.25, .coefficient_error = error};
    score.terms = 7;
    if (error < 0.15) score.sync = 0.5;
    cell.scores.push_back(score);
  }
  const BenchSummary summary = summary_of(cell);
  EXPECT_EQ(summary.exact_rate, 0.5);  // two of four, the failed draw among them
  EXPECT_EQ(summary.coefficient_error, 0.2);
  EXPECT_EQ(summary.sync, std::numeric_limits<double>::infinity());
}

TEST(Bench, RefusesTasksThatDoNotFit) {
  BenchTask task = two_regressors();
  task.noise = {-0.1};
  EXPECT_THROW(bench(task), ArgumentError);
  task = two_regressors();
  task.compositions[0].parts = {};
  EXPECT_THROW(bench(task), ArgumentError);
  task = two_regressors();
  task.draws = 0;
  EXPECT_THROW(bench(task), ArgumentError);
  EXPECT_THROW(add_relative_noise(lorenz_record(), -1.0, 1), ArgumentError);
}

TEST(Bench, PastTheDeadlineCellsAreLeftOut) {
  RunContext context;
  int cells = 0;
  context.progress = [&](const Progress&) {
    if (++cells == 3) context.deadline = std::chrono::steady_clock::now();
  };
  const BenchResult cut = bench(two_regressors(), context);
  ASSERT_EQ(cut.cells.size(), 4u);
  EXPECT_FALSE(cut.complete());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(cut.cells[i].done, i < 2) << i;
    EXPECT_EQ(cut.cells[i].scores.empty(), i >= 2) << i;
    EXPECT_TRUE(cut.cells[i].failures.empty()) << i;
  }
  EXPECT_TRUE(bench(two_regressors()).complete());
  EXPECT_THROW(bench(two_regressors(), context), OutOfTime);
}

}  // namespace
}  // namespace lacuna
