// SPDX-License-Identifier: MIT
#include "diagnose/candidates/candidate_column.hpp"

#include <gtest/gtest.h>

#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

Candidate lag(double tau) {
  Candidate candidate = support::plain_candidate("lagged-F");
  candidate.memory = {{"lagged", parse_expression("(F-lagged)/tau"), parse_expression("F")}};
  candidate.shapes = {{"tau", "s", 1e-4, 10.0, true}};
  candidate.starts = {Vector::Constant(1, tau)};
  return candidate;
}

LinearisedRecord step_record() {
  Dataset data = support::hidden_record(support::nothing, 0.0);
  Trajectory& record = data.trajectories.front();
  record.inputs.setOnes();
  record.inputs(0, 0) = 0.0;
  return grid_of(data.inputs, record, record.states);
}

TEST(CandidateColumn, MemoryFollowsItsEquation) {
  const std::vector<double> tau{0.5};
  const LinearisedRecord record = step_record();
  const Matrix memory = memory_along(lag(0.5), tau, support::oscillator().variables(), record);
  ASSERT_EQ(memory.rows(), 3001);
  // From 1 s to 1.5 s a first-order lag goes the fraction 1 - 1/e of what is left.
  EXPECT_NEAR((1.0 - memory(150, 0)) / (1.0 - memory(100, 0)), std::exp(-1.0), 1e-3);
}

/// Two lags one behind the other; with `bend` not 0 they are not linear to look at.
Candidate two_lags(const std::string& bend) {
  Candidate candidate = support::plain_candidate("second-F");
  candidate.memory = {
      {"first", parse_expression("(F-first)/tau*(1+" + bend + "*first)"),
       parse_expression("F")},
      {"second", parse_expression("(first-second)/tau"), parse_expression("F")}};
  candidate.shapes = lag(0.5).shapes;
  return candidate;
}

TEST(CandidateColumn, LinearMemoryIsWhatItIsStepByStep) {
  const std::vector<double> tau{0.5};
  const LinearisedRecord record = step_record();
  const Variables variables = support::oscillator().variables();
  const Matrix linear = memory_along(two_lags("0"), tau, variables, record);
  const Matrix stepwise = memory_along(two_lags("1e-200"), tau, variables, record);
  EXPECT_GT(linear.col(1).maxCoeff(), 0.9);
  EXPECT_LT((linear - stepwise).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(CandidateColumn, FormsThatAreNotFiniteAreNoCandidates) {
  const Dataset data = support::hidden_record(support::nothing, 0.01);
  const Assimilation fit = support::assimilated(data);
  const InnovationSystem system(fit);
  EXPECT_FALSE(candidate_column(support::plain_candidate("log(q)"), {}, fit, system));
  EXPECT_TRUE(candidate_column(support::plain_candidate("q^3"), {}, fit, system));
}

TEST(CandidateColumn, ADelayIsKnownOnceItLiesInTheRecord) {
  const LinearisedRecord record = step_record();
  Candidate late = support::plain_candidate("delay(q,T)-q");
  late.shapes = {{"T", "s", 0.1, 5.0, false}};
  const std::vector<double> delay{1.5};
  const auto known = known_from(late, delay, support::oscillator().variables(), record);
  EXPECT_DOUBLE_EQ(known.value(), record.time[0] + 1.5);
}

TEST(CandidateColumn, ALagForgetsInThreeOfItsTimes) {
  const std::vector<double> tau{0.5};
  const auto known =
      known_from(lag(0.5), tau, support::oscillator().variables(), step_record());
  EXPECT_NEAR(known.value(), 0.5 * std::log(20.0), 0.02);
}

TEST(CandidateColumn, APlayThatNeverMovesIsNeverKnown) {
  Candidate play = support::plain_candidate("follower-q");
  play.memory = {{"follower", parse_expression("25*((q-follower)-clip(q-follower,-gap,gap))"),
                  parse_expression("q")}};
  play.shapes = {{"gap", "m", 0.01, 100.0, true}};
  const std::vector<double> wide{50.0}, narrow{0.05};
  const Variables variables = support::oscillator().variables();
  EXPECT_FALSE(known_from(play, wide, variables, step_record()));
  EXPECT_LT(known_from(play, narrow, variables, step_record()).value(), 10.0);
}

TEST(CandidateColumn, MemoryOfWhatIsDelayedFollowsLater) {
  const std::vector<double> tau{0.5};
  const LinearisedRecord record = step_record();
  const Variables variables = support::oscillator().variables();
  const Matrix now = memory_along(lag(0.5), tau, variables, record);
  for (const std::string bend : {"", "*(1+0*lagged^2)"}) {
    Candidate late = lag(0.5);
    late.form = parse_expression("lagged-delay(F,1)");
    late.memory[0].rate = parse_expression("(delay(F,1)-lagged)/tau" + bend);
    late.memory[0].start = parse_expression("delay(F,1)");
    const Vector values = form_along(late, tau, variables, record);
    for (const Index row : {150, 300, 600})
      EXPECT_NEAR(values[row], now(row - 100, 0) - 1.0, 1e-2) << row << bend;
  }
}

}  // namespace
}  // namespace lacuna
