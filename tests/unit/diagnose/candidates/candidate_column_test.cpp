// SPDX-License-Identifier: MIT
// Candidates along records, their screening and what is kept of fits.
#include "diagnose/candidates/candidate_column.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "core/base/parallel.hpp"
#include "diagnose/candidates/fit_memory.hpp"
#include "diagnose/candidates/name_table.hpp"
#include "diagnose/candidates/screening.hpp"
#include "effects/families.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/effect_forms.hpp"

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

// Candidates that are screened, and the names of what is fitted.
TEST(Screening, WhatIsKnownIsNotScreenedAgain) {
  const Assimilation fit =
      support::assimilated(support::hidden_record(support::dry_friction, 0.01));
  const Screening screening(fit);
  const std::vector<Candidate> few{support::plain_candidate("q^3"),
                                   support::stop_candidate(0.0)};
  std::vector<Candidate> more = few;
  more.push_back(support::plain_candidate("sign(v)"));
  const auto expect_same = [](const ScreenedCandidate& a, const ScreenedCandidate& b) {
    EXPECT_EQ(a.candidate.form, b.candidate.form);
    EXPECT_NEAR(a.gain, b.gain, 1e-9 * b.gain);
    EXPECT_NEAR(a.coefficient, b.coefficient, 1e-9 * std::abs(b.coefficient));
    EXPECT_EQ(a.tried, b.tried);
    EXPECT_EQ(a.shapes.size(), b.shapes.size());
  };
  ScreeningMemory memory;
  screen(few, screening, {}, RunContext{}, &memory);
  const auto expected = screen(more, screening, {}, RunContext{});
  const auto found = screen(more, screening, {}, RunContext{}, &memory);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) expect_same(found[i], expected[i]);
  const Assimilation other =
      support::assimilated(support::hidden_record(support::nothing, 0.01));
  EXPECT_NE(screening.key(), Screening(other).key());
  const auto apart = screen(few, Screening(other), {}, RunContext{}, &memory);
  const auto alone = screen(few, Screening(other), {}, RunContext{});
  for (std::size_t i = 0; i < apart.size(); ++i) expect_same(apart[i], alone[i]);
}

TEST(Screening, ScoresOfACompleteModelAreChiSquared) {
  const Assimilation fit = support::assimilated(support::hidden_record(support::nothing, 0.01));
  const Screening screening(fit);
  for (const std::string form : {"q^3", "sign(v)", "q*v", "1", "t*q", "F^2"})
    EXPECT_LT(screening.score(support::plain_candidate(form), {}).gain, 12.0) << form;
}

/// Two bends between an arm and its drive, of which the nominal model has the slope 60.
struct Bends {
  Scope scope = support::scope_of(support::model_of_lines(
      {{"q", {{"v", 1.0}}}, {"v", {{"q", -60.0}, {"u", 60.0}}}}, {"u"}));
  NamingOptions options;

  std::vector<std::string> names(double coefficient,
                                 const std::vector<Stage<Effect>>& effects) const {
    const FittedEffect fitted{
        support::candidate_of<kPiecewiseLinear>(scope, 1, "clip(q-u,-edge,edge)"),
        Vector::Constant(1, 0.3), coefficient, 0.1};
    std::vector<std::string> result;
    for (const Name& name : NameTable{effects, scope, options}.names_of(fitted, scope.model))
      result.push_back(name.name);
    return result;
  }
};

TEST(NameTable, NamesFollowFromTheFittedNumbers) {
  const Bends bends;
  const std::vector<Stage<Effect>> effects{FamilyEffect<kDeadZone>(),
                                           FamilyEffect<kPiecewiseLinear>()};
  EXPECT_EQ(bends.names(30.0, effects), std::vector<std::string>{"piecewise-linear"});
  EXPECT_EQ(bends.names(60.0, effects), std::vector<std::string>{"dead-zone"});
}

/// What decides a fit of an oscillator with a stop.
struct Asked {
  Dataset data = support::hidden_record(support::nothing, 0.01);
  Assimilation start = support::assimilated(data);
  OdeModel nominal = start.model;
  AssimilationOptions options = support::oscillator_fit_options();
  std::vector<FittedEffect> effects = {
      {support::stop_candidate(0.0), Vector::Constant(1, -0.1), -2.0}};
  std::string kind = "exact";

  std::string key() const {
    return fit_key(kind, {data, nominal, options, RunContext{}}, start, effects);
  }
};

TEST(FitKey, TellsWhateverDecides) {
  const std::vector<std::function<void(Asked&)>> changes{
      [](Asked&) {},
      [](Asked& a) { a.kind = "rough"; },
      [](Asked& a) { a.data.trajectories[0].states(5, 1) += 1e-15; },
      [](Asked& a) { a.data.trajectories[0].inputs(5, 0) += 1e-15; },
      [](Asked& a) { a.data.trajectories[0].time[5] += 1e-9; },
      [](Asked& a) { a.data.inputs[0].hold = Hold::Zero; },
      [](Asked& a) {
        a.data.reconstructed = {false, true};
      },
      [](Asked& a) {
        a.data.rate_of = {Index{1}, std::nullopt};
      },
      [](Asked& a) { a.start.records[0].grid.stride = 3; },
      [](Asked& a) { a.nominal = support::oscillator(); },
      [](Asked& a) { a.options.passes += 1; },
      [](Asked& a) { a.options.free.pop_back(); },
      [](Asked& a) {
        a.options.priors.push_back({a.options.free[0], 1.0, 0.1});
      },
      [](Asked& a) { a.start.deviance += 1.0; },
      [](Asked& a) { a.start.records[0].path(7, 0) += 1e-12; },
      [](Asked& a) { a.start.noise.disturbance[1] *= 1.0 + 1e-15; },
      [](Asked& a) { a.start.noise.measurement[0] = 0.02; },
      [](Asked& a) { a.effects[0].coefficient = -2.1; },
      [](Asked& a) { a.effects[0].shapes[0] = -0.11; },
      [](Asked& a) { a.effects[0].candidate.equation = 0; },
      [](Asked& a) { a.effects[0].candidate.place = Place::Channel; },
      [](Asked& a) { a.effects[0].candidate.form = parse_expression("q^2"); },
      [](Asked& a) { a.effects[0].candidate.shapes[0].high += 1.0; },
      [](Asked& a) { a.effects[0].candidate.least = 0.0; },
      [](Asked& a) { a.effects.push_back(a.effects[0]); },
      [](Asked& a) { a.effects.clear(); }};
  std::set<std::string> keys;
  for (const auto& change : changes) {
    Asked asked;
    change(asked);
    keys.insert(asked.key());
  }
  EXPECT_EQ(keys.size(), changes.size());
}

/// An explanation that takes 10 numbers.
Explanation explanation_of(double deviance) {
  Explanation explanation{{}, {support::oscillator()}};
  explanation.fit.measured = {Matrix::Zero(5, 2)};
  explanation.fit.deviance = deviance;
  return explanation;
}

/// Asks for an explanation. @return its deviance, and whether it was fitted now.
std::pair<double, bool> asked_for(FitMemory& memory, const std::string& key, double deviance) {
  bool fitted = false;
  const Explanation found = memory.explanation(key, [&] {
    fitted = true;
    return explanation_of(deviance);
  });
  return {found.fit.deviance, fitted};
}

TEST(FitMemory, KeepsWhatThereIsRoomFor) {
  FitMemory memory(10 * FitMemory::kFewest + 5);
  for (Index i = 0; i <= FitMemory::kFewest; ++i) asked_for(memory, std::to_string(i), 1.0);
  for (Index i = 0; i < FitMemory::kFewest; ++i)
    EXPECT_FALSE(asked_for(memory, std::to_string(i), 2.0).second) << i;
  EXPECT_EQ(asked_for(memory, std::to_string(FitMemory::kFewest), 2.0), std::pair(2.0, true));
}

TEST(FitMemory, AFitThatFailsIsNotKept) {
  FitMemory memory;
  EXPECT_THROW(memory.explanation("a", []() -> Explanation { throw Cancelled(); }), Cancelled);
  EXPECT_TRUE(asked_for(memory, "a", 1.0).second);
}

}  // namespace
}  // namespace lacuna
