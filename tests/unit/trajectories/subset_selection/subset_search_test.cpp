// SPDX-License-Identifier: MIT
// Subsets of columns: which may matter, and the best of them.
#include "trajectories/subset_selection/subset_search.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bases/monomials.hpp"
#include "core/base/random.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "support/correlated_rows.hpp"
#include "support/lorenz96.hpp"
#include "support/noisy_records.hpp"
#include "support/oscillation.hpp"
#include "trajectories/subset_selection/candidate_screening.hpp"
#include "trajectories/subset_selection/negligible_columns.hpp"
#include "trajectories/subset_selection/plain_candidates.hpp"
#include "trajectories/subset_selection/subset_exchanges.hpp"
#include "trajectories/subset_selection/subset_problem.hpp"

namespace lacuna {
namespace {

TEST(SubsetProblem, LossIsTheGainOfTakingItBack) {
  const SubsetProblem problem = subset_problem(triangle_of(correlated_rows(1.0)));
  const Vector losses = losses_of(fit_subset(problem, {1, 4, 9}));
  EXPECT_NEAR(losses[1], gains_of(problem, {1, 9})[4], 1e-6 * losses[1]);
  EXPECT_NEAR(losses[1],
              fit_subset(problem, {1, 9}).residual - fit_subset(problem, {1, 4, 9}).residual,
              1e-6 * losses[1]);
}

TEST(SubsetProblem, VarianceIsThatOfLeastSquares) {
  const Matrix rows = correlated_rows(1.0);
  Matrix chosen(400, 2);
  chosen << rows.col(1), rows.col(4);
  const Matrix expected = (chosen.transpose() * chosen).inverse();
  const Vector variances = variances_of(subset_problem(triangle_of(rows)), {1, 4});
  EXPECT_NEAR(variances[0], expected(0, 0), 1e-9 * expected(0, 0));
}

TEST(SubsetProblem, CoefficientsAreThoseOfTheRows) {
  const Matrix rows = correlated_rows(1.0);
  Matrix chosen(400, 2);
  chosen << rows.col(9), rows.col(4);
  const Vector expected = chosen.colPivHouseholderQr().solve(rows.col(12));
  const SubsetProblem problem = subset_problem(triangle_of(rows));
  EXPECT_TRUE(solution_of(problem, {9, 4}).isApprox(expected, 1e-9));
  const double left = (rows.col(12) - chosen * expected).squaredNorm();
  EXPECT_NEAR(fit_subset(problem, {9, 4}).residual, left, 1e-9 * left);
}

/// Sum of squares of a subset with one column more.
double with(const SubsetProblem& problem, std::vector<Index> subset, Index column) {
  subset.push_back(column);
  std::sort(subset.begin(), subset.end());
  return fit_subset(problem, subset).residual;
}

/// A problem in which columns depend on those before them, so that little of some is new.
SubsetProblem dependent_columns(std::uint64_t seed) {
  Random random(seed);
  Matrix rows(60, 9);
  for (double& entry : rows.reshaped()) entry = random.normal();
  for (Index j = 1; j < 8; ++j) rows.col(j) += random.uniform(0.0, 4.0) * rows.col(j - 1);
  rows.col(8) += rows.col(0) - 0.7 * rows.col(3) + 0.4 * rows.col(6);
  return subset_problem(triangle_of(rows));
}

std::vector<Index> without(const std::vector<Index>& subset, std::size_t i, std::size_t j) {
  std::vector<Index> rest;
  for (std::size_t k = 0; k < subset.size(); ++k)
    if (k != i && k != j) rest.push_back(subset[k]);
  return rest;
}

TEST(SubsetExchanges, TheReplacementIsTheColumnThatLeavesLeast) {
  const std::vector<Index> subset{1, 4, 6};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SubsetProblem problem = dependent_columns(seed);
    const SubsetExchanges exchanges = exchanges_of(problem, subset);
    ASSERT_FALSE(subset.empty());
    for (std::size_t i = 0; i < subset.size(); ++i)
      for (std::size_t j = i; j < subset.size(); ++j) {
        const std::vector<Index> rest = without(subset, i, j);
        double least = 1e300;
        Index best = -1;
        for (Index c = 0; c < problem.columns(); ++c) {
          if (std::find(subset.begin(), subset.end(), c) != subset.end()) continue;
          const double left = with(problem, rest, c);
          if (left < least) best = c;
          least = std::min(least, left);
        }
        const auto a = static_cast<Index>(i), b = static_cast<Index>(j);
        EXPECT_EQ(replacement(exchanges, a, b, 1.001 * least), best) << seed << " " << i << j;
        EXPECT_EQ(replacement(exchanges, a, b, 0.999 * least), std::nullopt);
      }
  }
}

TEST(SubsetSearch, DependentAndEmptyColumnsAreNotAdded) {
  Matrix rows = correlated_rows(0.1);
  rows.col(2) = rows.col(1) - 2.0 * rows.col(4);
  rows.col(3).setZero();
  const SubsetProblem problem = subset_problem(triangle_of(rows));
  const Subset found = best_subset(problem, 12.0, {}, Exchange::Pairs);
  EXPECT_LE(found.columns.size(), 3U);
  EXPECT_TRUE(solution_of(problem, found.columns).allFinite());
  EXPECT_EQ(gains_of(problem, {1, 4})[3], 0.0);
}

/// Score of the best of all subsets of so few columns.
double best_of_all(const SubsetProblem& problem, double penalty) {
  double best = fit_subset(problem, {}).residual;
  for (unsigned mask = 1; mask < (1U << problem.columns()); ++mask) {
    std::vector<Index> subset;
    for (Index j = 0; j < problem.columns(); ++j)
      if (mask >> j & 1U) subset.push_back(j);
    best = std::min(best, fit_subset(problem, subset).residual +
                              penalty * static_cast<double>(subset.size()));
  }
  return best;
}

TEST(SubsetSearch, IsTheBestOfAllSubsets) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    Matrix rows(60, 9);
    for (double& entry : rows.reshaped()) entry = random.normal();
    rows.col(1) += 3.0 * rows.col(0);
    rows.col(2) += 3.0 * rows.col(1);
    rows.col(8) += rows.col(2) + 0.7 * rows.col(3) - 0.4 * rows.col(5);
    const SubsetProblem problem = subset_problem(triangle_of(rows));
    EXPECT_NEAR(best_subset(problem, 6.0, {}, Exchange::Pairs).score, best_of_all(problem, 6.0),
                1e-6)
        << trial;
  }
}

TEST(SubsetSearch, ColumnsOnTheVergeOfDependenceComeToAnEnd) {
  Matrix rows = correlated_rows(1.0);
  Random random(4);
  for (Index j = 0; j < 6; ++j)
    for (Index i = 0; i < rows.rows(); ++i)
      rows(i, 2 * j + 1) = rows(i, 2 * j) + 1e-8 * random.normal();
  rows.col(12) *= 1e6;
  const SubsetProblem problem = subset_problem(triangle_of(rows));
  const Subset found =
      best_subset(problem, 12.0, {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}}, Exchange::Pairs);
  EXPECT_LE(found.score, fit_subset(problem, {}).residual);
}

TEST(SubsetSearch, WithoutColumnsNoneIsChosen) {
  const SubsetProblem problem = subset_problem(Matrix::Constant(1, 1, 3.0));
  for (const Exchange exchange : {Exchange::Single, Exchange::Pairs}) {
    const Subset found = best_subset(problem, 12.0, {{}}, exchange);
    EXPECT_TRUE(found.columns.empty());
    EXPECT_DOUBLE_EQ(found.score, 9.0) << "all of the target";
  }
}

// Columns that may matter.
/// A search among quadratic monomials, not begun.
struct ScreeningCase {
  explicit ScreeningCase(Index states, double noise = 1e-3)
      : model(lorenz96(states)),
        library(Monomials{{.max_degree = 2}}.library(model.variables())),
        task(search_task(lorenz96_record(states, 1500, noise, 1), {library},
                         analyse_noise(lorenz96_record(states, 1500, noise, 1)), {})),
        search(prepared_search(task)) {
    search.shortest = 20;
    search.path.windows = windows_of(search.path.records, 60);
    search.fit.coefficients = Matrix::Zero(states, library.size());
  }

  /// The columns of the true model.
  std::vector<Coefficient> truth() const {
    std::vector<Coefficient> columns;
    const std::vector<std::string> names = library.names();
    for (const auto& [equation, term] : structure_of(model))
      columns.push_back({static_cast<Index>(equation),
                         std::find(names.begin(), names.end(), term) - names.begin()});
    std::sort(columns.begin(), columns.end());
    return columns;
  }

  OdeModel model;
  TermLibrary library;
  SearchTask task;
  WindowSearch search;
};

bool contains(const std::vector<Coefficient>& all, const std::vector<Coefficient>& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

TEST(CandidateScreening, TrueTermsAreAmongThePlausibleOnes) {
  ScreeningCase c(8);
  const ScreenedCandidates found = screen_candidates(c.task, c.search, {});
  EXPECT_TRUE(contains(found.plausible, c.truth()));
  EXPECT_TRUE(contains(found.plausible, found.worth));
  EXPECT_TRUE(std::is_sorted(found.plausible.begin(), found.plausible.end()));
}

/// What chance keeps out of the first few may be needed; a problem of 250 columns is cheap.
TEST(CandidateScreening, KeepsAsManyAsThereIsRoomForOrSeveralTimesWhatIsWorthIt) {
  for (const Index states : {8, 24}) {
    ScreeningCase c(states);
    const ScreenedCandidates found = screen_candidates(c.task, c.search, {});
    const auto most = static_cast<std::size_t>(states);
    EXPECT_GE(found.plausible.size(), 250 / most * most);
    EXPECT_LE(found.plausible.size(),
              std::max<std::size_t>(250, 2 * found.worth.size() + 4 * most));
    EXPECT_LT(found.plausible.size(), c.task.candidates.size());
  }
}

TEST(CandidateScreening, ColumnsOfTheModelStay) {
  ScreeningCase c(8);
  const Coefficient odd{3, c.library.size() - 1};  // x7^2, which explains nothing
  c.search.fit.coefficients(odd.equation, odd.term) = 0.1;
  const ScreenedCandidates found = screen_candidates(c.task, c.search, {});
  EXPECT_TRUE(contains(found.plausible, {odd}));
  EXPECT_FALSE(contains(found.worth, {odd}));
}

const RunContext kContext;

/// A search in a record of Lorenz' equations as fixed steps of order 4 give it.
struct Searched {
  explicit Searched(std::optional<double> penalty = {})
      : data(record_of(test_system("lorenz").model, Rk4{}, test_system("lorenz").start, 0.01,
                       1200)),
        library(Monomials{{.max_degree = 2}}.library(data_variables())) {
    for (Trajectory& record : data.trajectories) record.derivatives = Matrix();
    task.emplace(search_task(data, {library}, analyse_noise(data), {.penalty = penalty}));
    search.emplace(
        begun(*task, prepared_search(*task), Matrix::Zero(3, library.size()), kContext));
    while (grow(*task, *search, kContext)) {
    }
    finish(*search, kContext);
  }

  Variables data_variables() const { return test_system("lorenz").model.variables(); }

  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const Index c : search->fit.subset) {
      const Coefficient column = search->fit.columns[static_cast<std::size_t>(c)];
      names.insert(std::to_string(column.equation) + " " +
                   library.terms[static_cast<std::size_t>(column.term)].name());
    }
    return names;
  }

  Dataset data;
  TermLibrary library;
  std::optional<SearchTask> task;
  std::optional<WindowSearch> search;
};

TEST(NegligibleColumns, WhatASolversErrorLooksLikeLeaves) {
  Searched c;
  const std::set<std::string> truth = {"0 x", "0 y", "1 x", "1 y", "1 x*z", "2 z", "2 x*y"};
  ASSERT_GT(c.search->fit.subset.size(), truth.size());
  const Vector before = c.search->fit.rms;
  const auto left = leave_out_negligible(*c.task, *c.search, {}, kContext);
  EXPECT_EQ(c.names(), truth);
  for (const LeftOut& out : left) {
    EXPECT_LT(out.effect, 1e-4);
    EXPECT_EQ(c.search->fit.coefficients(out.column.equation, out.column.term), 0.0);
  }
  // What was left out on purpose does not count against the model.
  const WindowFit& fit = c.search->fit;
  for (Index k = 0; k < 3; ++k)
    EXPECT_LE(fit.rms[k] / fit.sigma[k], before[k] / c.search->sigma[k] * 1.0001);
  EXPECT_NEAR(fit.coefficients(1, 1), 28.0, 1e-3);
}

TEST(NegligibleColumns, StayWhereTheSizeIsZeroOrAPenaltyWasGiven) {
  Searched free;
  const std::set<std::string> names = free.names();
  EXPECT_TRUE(
      leave_out_negligible(*free.task, *free.search, {.effect_size = 0.0}, kContext).empty());
  EXPECT_EQ(free.names(), names);
  Searched priced(12.0);
  EXPECT_TRUE(leave_out_negligible(*priced.task, *priced.search, {}, kContext).empty());
}

/// n samples of one orbit, 97 to a turn, with white noise of a fraction of its spread.
Dataset noisy_orbit(Index n, double fraction, std::uint64_t seed) {
  Dataset data;
  data.states = {{"x", "m"}, {"v", "m/s"}};
  data.trajectories = {oscillation(n, 0.0, 0.0324)};
  Matrix& states = data.trajectories[0].states;
  data.trajectories[0].inputs.resize(n, 0);
  const Vector sigma = fraction * spread(states);
  Random random(seed);
  for (Index k = 0; k < 2; ++k)
    for (Index i = 0; i < n; ++i) states(i, k) += sigma[k] * random.normal();
  return data;
}

struct OrbitCase {
  explicit OrbitCase(Dataset record)
      : library(Monomials{{.max_degree = 3}}.library(
            OdeModel(record.states, record.inputs, std::vector<Equation>(2)).variables())),
        task(search_task(record, {library}, analyse_noise(record), {})) {}

  /// The terms that are left in the first equation.
  std::vector<std::string> plain_terms(double strength = 3.0) const {
    std::vector<std::string> names;
    if (const std::optional<SearchTask> plain = plain_task(task, strength))
      for (const Coefficient& column : plain->candidates)
        if (column.equation == 0)
          names.push_back(library.terms[static_cast<std::size_t>(column.term)].name());
    return names;
  }

  Matrix coefficients(const std::string& term) const {
    Matrix values = Matrix::Zero(task.data.state_count(), library.size());
    for (std::size_t l = 0; l < library.terms.size(); ++l)
      if (library.terms[l].name() == term) values(0, static_cast<Index>(l)) = 1.0;
    return values;
  }

  TermLibrary library;
  SearchTask task;
};

TEST(PlainCandidates, AreNoMultiplesOfWhatIsConstantOnAnOrbit) {
  const OrbitCase c(noisy_orbit(2000, 0.01, 1));
  EXPECT_EQ(c.plain_terms(), (std::vector<std::string>{"1", "x", "v", "x*v"}));
}

TEST(PlainCandidates, AreAllWhereARelationIsTooWeakOrTermsAreConstrained) {
  OrbitCase c(noisy_orbit(2000, 0.05, 1));
  EXPECT_FALSE(c.plain_terms().empty());
  EXPECT_FALSE(plain_task(c.task, 10.0));
  c.task.constraints.push_back({{{0, 1, 1.0}}, 0.0});
  EXPECT_FALSE(plain_task(c.task, 3.0));
}

/// A sum that is constant says that one state is the others: none of them is the plainer one.
TEST(PlainCandidates, KeepStatesThatAddUp) {
  Dataset data = noisy_record("van-der-pol", 2000, 0.01, 1);
  Matrix& states = data.trajectories[0].states;
  states.col(1) = (3.0 - states.col(0).array()).matrix() + 1e-3 * states.col(1);
  EXPECT_FALSE(plain_task(OrbitCase(data).task, 3.0));
}

/// On one orbit many windows fit as well by x^3 and x v^2, which trade an initial state for a
/// frequency in each of them, as by x.
TEST(TrajectorySelection, FindsTwoTermsOnOneOrbitHoweverLong) {
  for (const std::uint64_t seed : {1, 2}) {
    const Dataset data = noisy_orbit(20000, 0.01, seed);
    const OdeModel none(data.states, data.inputs, std::vector<Equation>(2));
    const TermLibrary library = Monomials{{.max_degree = 3}}.library(none.variables());
    const OdeModel found = TrajectorySelection{}.refine({data, library, none}).model;
    EXPECT_EQ(structure_of(found), (Structure{{0, "v"}, {1, "x"}})) << to_text(found, 4);
  }
}

}  // namespace
}  // namespace lacuna
