// SPDX-License-Identifier: MIT
#include "identify/pipeline/equation_problem.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "core/base/random.hpp"
#include "lacuna/bases/monomials.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "unit/identify/pipeline/records.hpp"

namespace lacuna {
namespace {

using testing::past_the_deadline;

/// Random samples with random derivatives of so many states.
Dataset random_record(Index samples, Index states) {
  Random random(4);
  Dataset data;
  Trajectory record;
  record.source = "random";
  record.time = Vector::LinSpaced(samples, 0.0, 1.0);
  record.states.resize(samples, states);
  record.derivatives.resize(samples, states);
  record.inputs.resize(samples, 0);
  for (Index k = 0; k < states; ++k) {
    data.states.push_back({"x" + std::to_string(k), ""});
    for (Index i = 0; i < samples; ++i) record.states(i, k) = random.normal();
    for (Index i = 0; i < samples; ++i) record.derivatives(i, k) = random.normal();
  }
  data.trajectories.push_back(std::move(record));
  return data;
}

EquationProblem problem_of(const Dataset& data, const Pipeline& pipeline,
                           const RunContext& context) {
  return equation_problem(
      data, pipeline,
      equation_libraries(pipeline.basis->library(variables_of(data)), data, pipeline), context);
}

TEST(EquationProblem, PastTheDeadlineALargeLibraryLosesItsHighestDegrees) {
  // 1.01e9 products of 286 candidates and 10 targets; those up to degree 2 are 66.
  const Dataset data = random_record(11500, 10);
  const EquationProblem problem = problem_of(data, algorithm1(), past_the_deadline());
  EXPECT_EQ(problem.system.terms(), 66);
  EXPECT_EQ(problem.libraries.library.size(), 66);
  EXPECT_EQ(problem.left_out, 220);
  EXPECT_FALSE(problem.is_filtered);
  EXPECT_EQ(problem.filtered.kept.size(), 66U);
}

TEST(EquationProblem, WhatCannotBeReadInTimeIsNotBegun) {
  RunContext context;  // ends long before 1e12 products, and long after 1e9
  context.deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  Pipeline pipeline = algorithm1();
  pipeline.basis = Monomials{{.max_degree = 4}};
  const EquationProblem problem = problem_of(random_record(40000, 15), pipeline, context);
  EXPECT_EQ(problem.system.terms(), 136);
  EXPECT_EQ(problem.left_out, 3876 - 136);
  EXPECT_TRUE(problem.is_filtered);
}

TEST(EquationProblem, PastTheDeadlineTooFewSamplesAreAnError) {
  EXPECT_THROW(problem_of(random_record(19, 3), algorithm1(), past_the_deadline()), DataError);
  EXPECT_THROW(problem_of(random_record(11500, 40), algorithm1(), past_the_deadline()), DataError);
}

}  // namespace
}  // namespace lacuna
