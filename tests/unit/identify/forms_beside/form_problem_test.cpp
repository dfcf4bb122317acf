// SPDX-License-Identifier: MIT
#include "identify/forms_beside/form_problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

/// x with dx/dt = -x, exactly.
Dataset decay() {
  Dataset data;
  data.states = {{"x", ""}};
  Trajectory record;
  record.time = Vector::LinSpaced(801, 0.0, 4.0);
  record.states = (-record.time.array()).exp().matrix();
  record.inputs.resize(801, 0);
  data.trajectories = {record};
  return data;
}

Candidate form_of_x(const std::string& form) {
  const Expression x = Expression::variable("x");
  Candidate candidate;
  candidate.form = parse_expression(form);
  candidate.argument = x;
  candidate.starts = {Vector()};
  return candidate;
}

TEST(FormProblem, WhatIsTheSameIsATenthWhereItIsNoNoise) {
  const FormProblem clean(decay(), Vector::Zero(1), {});
  EXPECT_NEAR(clean.same_as(1.0, clean.residual_noise(0)), 1.21, 1e-12);
  const FormProblem noisy(decay(), Vector::Constant(1, 0.1), {});
  const double noise = noisy.residual_noise(0);
  const auto rows = static_cast<double>(noisy.rows());
  EXPECT_NEAR(noise, 0.01 * rows, 1e-6 * noise);
  EXPECT_NEAR(noisy.same_as(noise, noise), noise * (1.0 + 2.0 * std::log(rows) / rows), 1e-9);
}

TEST(FormProblem, WhatTrajectoriesCallNoiseIsNoise) {
  const FormProblem problem(decay(), Vector::Zero(1), {});
  const EquationForms constant{0, {problem.linear_terms()[0]}, {}};
  const double left = problem.left(constant);
  const auto rows = static_cast<double>(problem.rows());
  const Limit unknown = problem.limit_of(constant);
  EXPECT_NEAR(unknown.left, 1.21 * left, 1e-9 * left);
  EXPECT_EQ(unknown.penalty, 0.0);
  const Limit noise = problem.limit_of(constant, Remainder::Noise);
  EXPECT_NEAR(noise.left, left * (1.0 + 2.0 * std::log(rows) / rows), 1e-9 * left);
  EXPECT_NEAR(noise.penalty, std::log(rows) / rows * left, 1e-9 * left);
}

TEST(FormProblem, RatesFormsByWhatTheyTakeInThePlaceOfMembers) {
  const FormProblem problem(decay(), Vector::Zero(1), {});
  const std::vector<Term> terms = problem.linear_terms();
  ASSERT_EQ(terms.size(), 2u);
  const EquationForms linear{0, terms, {}};
  const std::vector<Start> starts{{{form_of_x("exp(x)"), Vector()}, 0, 0.0}};
  const auto rating = [&](const Beside& beside) { return problem.rated({beside}, starts)(0, 0); };
  EquationForms alone{0, {}, {starts[0].form}};
  // Two parameters: one of the members goes; one parameter: both.
  double one = problem.left({0, {terms[0]}, alone.forms});
  one = std::min(one, problem.left({0, {terms[1]}, alone.forms}));
  EXPECT_NEAR(rating({linear, 2, 0, 1e-9, 0.0}), one, 1e-9 * one);
  const double left = problem.left(alone), bare = problem.left(EquationForms{0, {}, {}});
  ASSERT_LT(left, bare);
  EXPECT_NEAR(rating({linear, 1, 0, 1e-9, 0.0}), left, 1e-9 * left);
  // What it takes of all that is left, or of what is beyond a limit.
  const double taken = (bare - left) / bare, limit = 0.5 * bare;
  EXPECT_TRUE(std::isfinite(rating({linear, 1, 0, 0.999 * taken, 0.0})));
  EXPECT_TRUE(std::isinf(rating({linear, 1, 0, 1.001 * taken, 0.0})));
  EXPECT_TRUE(std::isfinite(rating({linear, 1, 0, std::min(1.0, 1.9 * taken), limit})));
  EXPECT_TRUE(std::isinf(rating({linear, 1, 1}))) << "no place for a member";
  EXPECT_TRUE(std::isfinite(rating({linear, 2, 1})));
}

/// What is left without the member that costs least, the last one apart: each is tried.
double least_without_one(const FormProblem& problem, const EquationForms& all) {
  EquationForms fewer = all;
  fewer.terms.clear();
  double least = problem.left(fewer);
  for (std::size_t i = 0; i + 1 < all.forms.size(); ++i) {
    fewer = all;
    fewer.forms.erase(fewer.forms.begin() + static_cast<std::ptrdiff_t>(i));
    least = std::min(least, problem.left(fewer));
  }
  return least;
}

/// A form with a bend at e, which stays at a half.
MissingForm bend(const std::string& form) {
  Candidate candidate = form_of_x(form);
  candidate.shapes = {{"e", "", 0.5, 0.5, false}};
  candidate.starts = {Vector::Constant(1, 0.5)};
  return {candidate, Vector::Constant(1, 0.5)};
}

TEST(FormProblem, OfMembersThatStandForOneAnotherThoseOfMostParametersGo) {
  const FormProblem problem(decay(), Vector::Zero(1), {});
  const EquationForms all{  // the forms are x together
      0, {problem.linear_terms()[1]}, {bend("max(x-e,0)"), bend("min(x,e)")}};
  const double limit = 1e6 * problem.residual_noise(0);
  const Trial thin = problem.thinned(all, {form_of_x("sin(x)"), Vector()}, {limit, 0.0, 9});
  ASSERT_EQ(thin.equation.terms.size(), 1u);
  EXPECT_EQ(thin.equation.terms[0].name(), "x");
  EXPECT_EQ(thin.equation.forms.size(), 1u);
}

TEST(FormProblem, ThinnedDropsWhatCostsLeast) {
  const FormProblem problem(decay(), Vector::Zero(1), {});
  const std::vector<std::string> pool{"x^2",     "x^3",      "exp(x)",
                                      "sqrt(x)", "sin(3*x)", "cos(2*x)"};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t last = 0; last < 6; ++last) {
        if (last == i || last == j) continue;
        const MissingForm form{form_of_x(pool[last]), Vector()};
        EquationForms few{0,
                          {problem.linear_terms()[0]},
                          {{form_of_x(pool[i]), Vector()}, {form_of_x(pool[j]), Vector()}}};
        EquationForms all = few;
        all.forms.push_back(form);
        const double limit = least_without_one(problem, all) * (1.0 + 1e-6);
        const Trial thin = problem.thinned(few, form, {limit, 0.0, 2});
        EXPECT_LT(thin.equation.terms.size() + thin.equation.forms.size(), 4u)
            << pool[i] << ", " << pool[j] << ", " << pool[last];
      }
}

TEST(Limit, ANumberLessMayCostItsPenalty) {
  const Limit limit{10.0, 2.0, 5};
  EquationForms equation;
  equation.forms.push_back({form_of_x("sin(x)"), Vector::Ones(2)});
  EXPECT_DOUBLE_EQ(limit(equation), 14.0);
  EXPECT_TRUE(Limit::prefers({{}, 9.0}, {equation, 1.0}));
  EXPECT_FALSE(Limit::prefers({equation, 2.0}, {equation, 1.0}));
}

TEST(FormProblem, TriesOnlyWhatMayComeToWhatIsWanted) {
  const FormProblem problem(decay(), Vector::Zero(1), {});
  const EquationForms constant{0, {problem.linear_terms()[0]}, {}};
  const std::vector<Candidate> candidates{form_of_x("exp(x)"), form_of_x("sin(x)")};
  const std::vector<Trial> all = problem.with_each(constant, candidates);
  ASSERT_EQ(all.size(), 2u);
  // A fraction that one of them takes, and the other does not.
  const double bare = problem.left(constant);
  const double between = 1.0 - 0.5 * (all[0].left + all[1].left) / bare;
  const FormProblem choosy(decay(), Vector::Zero(1), {.takes = between});
  const std::vector<Trial> some = choosy.with_each(constant, candidates, 1e-12 * bare);
  ASSERT_EQ(some.size(), 1u);
  EXPECT_EQ(some[0].equation.forms[0].expression().to_string(), "sin(x)");
}

TEST(FormProblem, AShapeThatGoesToAnEndOfItsRangeStaysThere) {
  const FormProblem problem(decay(), Vector::Zero(1), {});
  Candidate saturating = form_of_x("x/(a+x)");
  saturating.shapes = {{"a", "", 0.1, 2.0, true}};
  saturating.starts = {Vector::Constant(1, 0.5)};
  // The rate is linear in x: the longer the form is linear the better.
  EquationForms equation{0, {}, {{saturating, saturating.starts[0]}}};
  const double left = problem.polish(equation, 0);
  EXPECT_DOUBLE_EQ(equation.forms[0].shapes[0], 2.0);
  EXPECT_NEAR(left, problem.left(equation), 1e-9 * left);
}

}  // namespace
}  // namespace lacuna
