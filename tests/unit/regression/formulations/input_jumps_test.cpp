// SPDX-License-Identifier: MIT
#include "regression/formulations/input_jumps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/model/equations/term.hpp"
#include "regression/formulations/variable_slots.hpp"
#include "support/oscillation.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// x and v swing, u goes 1, 1, 3, 3, 3, -2, ...
Trajectory stepped() {
  Trajectory record = oscillation(8, 0.0);
  record.inputs.resize(8, 1);
  record.inputs << 1.0, 1.0, 3.0, 3.0, 3.0, -2.0, -2.0, 0.0;
  return record;
}

Matrix slots_of(const Trajectory& record, Index first) {
  Matrix slots(record.samples() - first, 4);
  fill_variables(record, first, slots);
  return slots;
}

TEST(InputJumps, HaveTheValuesOfTheSampleBefore) {
  const Trajectory record = stepped();
  const Matrix slots = slots_of(record, 0);
  const InputJumps jumps = input_jumps(record, 0, slots, {0});
  EXPECT_THAT(jumps.rows, ElementsAre(2, 5, 7));
  EXPECT_EQ(jumps.before.col(2), Vector({{1.0, 3.0, -2.0}}));
  EXPECT_EQ(jumps.before.row(1).head(2), record.states.row(5));  // states are there what they are
  EXPECT_THAT(input_jumps(record, 0, slots, {}).rows, IsEmpty());
}

/// Rows that begin behind the first sample see the one before them.
TEST(InputJumps, CountFromTheFirstRow) {
  const Trajectory record = stepped();
  EXPECT_THAT(input_jumps(record, 2, slots_of(record, 2), {0}).rows, ElementsAre(0, 3, 5));
  EXPECT_THAT(input_jumps(record, 3, slots_of(record, 3), {0}).rows, ElementsAre(2, 4));
}

/// Terms that are not linear in the input are no terms of its mean.
TEST(InputJumps, TermsAreTheMeanOfBothLimits) {
  const Trajectory record = stepped();
  TermLibrary library{{{"x", "v"}, {"u"}}, {}};
  for (const char* text : {"u^2", "x*u", "x"})
    library.terms.push_back(Term::parse(text, library.variables));
  const Program program = library.compile();
  const Matrix slots = slots_of(record, 0);
  const InputJumps jumps = input_jumps(record, 0, slots, {0});
  Program::Workspace workspace;
  Matrix theta(3, 3);  // rows 4, 5, 6
  program.evaluate(slots.middleRows(4, 3), theta, workspace);
  average_at(jumps, program, 4, theta, workspace);
  EXPECT_EQ(theta.col(0), Vector({{9.0, 6.5, 4.0}}));
  EXPECT_DOUBLE_EQ(theta(1, 1), 0.5 * record.states(5, 0));
  EXPECT_EQ(theta.col(2), record.states.col(0).segment(4, 3));
}

}  // namespace
}  // namespace lacuna
