// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lacuna/bases/monomials.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "support/lorenz96.hpp"
#include "trajectories/subset_selection/candidate_screening.hpp"
#include "trajectories/subset_selection/negligible_columns.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
