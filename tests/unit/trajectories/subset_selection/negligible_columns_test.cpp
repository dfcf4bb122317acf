// SPDX-License-Identifier: MIT
#include "trajectories/subset_selection/negligible_columns.hpp"

#include <gtest/gtest.h>

#include <set>

#include "lacuna/bases/monomials.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna {
namespace {

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
