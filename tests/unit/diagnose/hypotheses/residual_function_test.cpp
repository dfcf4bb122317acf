// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/residual_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "diagnose/hypotheses/input_noise.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

Proposals proposed(const support::Asked& asked, const CompositeModel& best) {
  return ResidualFunction().propose(asked.problem(), best);
}

TEST(ResidualFunction, SaysOfWhichVariableTheStructureIsAFunction) {
  const support::Asked asked = support::asked(support::ripple);
  const Proposals made = proposed(asked, asked.bare());
  ASSERT_EQ(made.composites.size(), 1u);
  const CompositeModel& composite = made.composites[0].composite;
  ASSERT_TRUE(composite.unnamed);
  EXPECT_EQ(composite.unnamed->variables, std::vector<std::string>{"q"});
  EXPECT_EQ(composite.unnamed->equation, 1);
  EXPECT_FALSE(composite.unnamed->memory || composite.unnamed->periodic);
  EXPECT_GT(composite.unnamed->explained, 0.9);
  EXPECT_FALSE(composite.unnamed->filled);
  EXPECT_TRUE(composite.explanation.effects.empty()) << "it only describes";
  EXPECT_EQ(std::get<ByRule>(made.composites[0].judged).why,
            "describes the residual; explains nothing");
}

TEST(ResidualFunction, ALineOfTheSpectrumIsPeriodic) {
  const support::Asked asked =
      support::asked([](double t, double, double) { return 0.5 * std::sin(5.0 * t); });
  const Proposals made = proposed(asked, asked.bare());
  ASSERT_EQ(made.composites.size(), 1u);
  EXPECT_TRUE(made.composites[0].composite.unnamed->periodic);
  EXPECT_FALSE(made.composites[0].composite.unnamed->memory);
}

TEST(ResidualFunction, WhatHappensOnceIsNotPeriodic) {
  const support::Asked asked = support::asked([](double t, double, double) {
    return 6.0 * std::exp(-std::pow((t - 9.0) / 1.5, 2)) * std::sin(5.0 * t);
  });
  const Proposals made = proposed(asked, asked.bare());
  ASSERT_EQ(made.composites.size(), 1u);
  ASSERT_TRUE(made.composites[0].composite.unnamed);
  EXPECT_FALSE(made.composites[0].composite.unnamed->periodic);
}

/// The oscillator with a hidden function of q, and what is said of it.
CompositeModel described(const support::Hidden& hidden) {
  const support::Asked asked = support::asked(hidden, 0.002);
  const Proposals made = ResidualFunction().propose(asked.problem(), asked.bare());
  EXPECT_EQ(made.composites.size(), 1u);
  CompositeModel composite = made.composites.at(0).composite;
  EXPECT_TRUE(composite.unnamed);
  EXPECT_EQ(composite.unnamed->variables, std::vector<std::string>{"q"});
  return composite;
}

/// Expects a formula with a function in it that is the hidden one along the record.
void expect_formula(const std::string& function, const support::Hidden& hidden) {
  const CompositeModel composite = described(hidden);
  const std::string& formula = composite.unnamed->formula;
  ASSERT_NE(formula.find(function), std::string::npos) << formula;
  const LinearisedRecord& record = composite.base->fitted.records[0];
  const Vector found =
      evaluate_on(record, composite.base->fitted.model.variables(), parse_expression(formula));
  const Vector q =
      evaluate_on(record, composite.base->fitted.model.variables(), parse_expression("q"));
  const Vector truth = q.unaryExpr([&](double x) { return hidden(0.0, x, 0.0); });
  EXPECT_LT((found - truth).squaredNorm(), 0.003 * truth.squaredNorm()) << formula;
}

TEST(CurveFormula, IsAPower) {
  expect_formula("abs(q)^", [](double, double q, double) {
    return -4.0 * std::copysign(std::pow(std::abs(q), 2.3), q);
  });
}

TEST(CurveFormula, IsAnExponential) {
  expect_formula("exp(", [](double, double q, double) { return -0.3 * std::exp(2.5 * q); });
}

TEST(CurveFormula, OfAPhaseThatIsNoneIsWithoutIt) {
  const std::string formula = described([](double, double q, double) {
                                return -3.0 * std::sin(4.0 * q);
                              }).unnamed->formula;
  ASSERT_NE(formula.find("sin("), std::string::npos) << formula;
  EXPECT_EQ(formula.find('+'), std::string::npos) << formula;
}

TEST(CurveFormula, IsNoneWhereAllFallShortOfTheCurve) {
  const Unnamed said =
      *described([](double, double q, double) {
         return 2.0 * std::sin(4.0 * q + 0.7) + 8.0 * std::exp(-50.0 * (q - 0.1) * (q - 0.1));
       }).unnamed;
  EXPECT_GT(said.explained, 0.9);
  EXPECT_EQ(said.formula, "");
}

FittedEffect plain_effect(const std::string& form) {
  return {support::plain_candidate(form), Vector(0), 0.0, 0.0};
}

constexpr Index kTried = 100;  // candidates of which an effect was the best

/// The oscillator with effects that are called as their forms are.
CompositeModel named(const support::Asked& asked, const std::vector<FittedEffect>& effects) {
  const Problem problem = asked.problem();
  CompositeModel composite = asked.bare();
  composite.explanation = explain_on(problem, *composite.base, composite.base->fitted, effects);
  for (const FittedEffect& effect : effects)
    composite.named.push_back(
        {.equation = 1, .name = effect.candidate.form.to_string(), .tried = kTried});
  composite.left = structure_left(problem, composite.explanation.fit);
  return composite;
}

/// A function of q of which no formula leaves nothing.
double bumps(double, double q, double) { return -4.0 * q * q * q + 0.4 * std::sin(9.0 * q); }

TEST(WrongShapes, AreThoseThatACurveOfTheirArgumentShowsToBeOthers) {
  const support::Asked asked = support::asked(bumps, 0.002);
  const CompositeModel composite =
      named(asked, {plain_effect("v*abs(v)"), plain_effect("q^3"), plain_effect("q^5")});
  ASSERT_TRUE(leaves_structure(composite, asked.options.decision));
  const auto wrong = wrong_shapes(asked.problem(), composite);
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->effects, (std::vector<std::size_t>{0, 1, 2}))
      << "the curve needs no drag beside it";
  EXPECT_EQ(wrong->better.composite, "a free curve of q in dv/dt");
  EXPECT_TRUE(wrong->better.taken);
  EXPECT_LT(wrong->better.value, wrong->better.threshold - asked.options.decision.undecided);
}

TEST(WrongShapes, IsAPlainTermWhereALawLeavesNothing) {
  const support::Asked asked =
      support::asked([](double, double q, double) { return -3.0 * std::sin(2.0 * q); }, 0.002);
  const CompositeModel composite = named(asked, {plain_effect("q^3")});
  ASSERT_TRUE(has_residual_structure(composite.left, asked.options.decision));
  const auto wrong = wrong_shapes(asked.problem(), composite);
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->effects, std::vector<std::size_t>{0});
  EXPECT_EQ(wrong->better.composite, "one formula of q in dv/dt");
}

TEST(WrongShapes, AreNoneWhereTheCurveLeavesAsMuch) {
  const auto hum = [](double t, double q, double) {
    return -4.0 * q * q * q + 0.5 * std::sin(9.0 * t);
  };
  const support::Asked asked = support::asked(hum, 0.002);
  const CompositeModel composite = named(asked, {plain_effect("q^3"), plain_effect("q^5")});
  ASSERT_TRUE(leaves_structure(composite, asked.options.decision));
  EXPECT_FALSE(wrong_shapes(asked.problem(), composite)) << "what is left is no function of q";
}

}  // namespace
}  // namespace lacuna
