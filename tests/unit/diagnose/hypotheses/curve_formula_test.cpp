// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "diagnose/hypotheses/residual_function.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

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
  const Vector found = evaluate_on(record, composite.base->fitted.model.variables(),
                                   parse_expression(formula));
  const Vector q = evaluate_on(record, composite.base->fitted.model.variables(),
                               parse_expression("q"));
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
  const std::string formula =
      described([](double, double q, double) { return -3.0 * std::sin(4.0 * q); })
          .unnamed->formula;
  ASSERT_NE(formula.find("sin("), std::string::npos) << formula;
  EXPECT_EQ(formula.find('+'), std::string::npos) << formula;
}

TEST(CurveFormula, IsNoneWhereAllFallShortOfTheCurve) {
  const Unnamed said = *described([](double, double q, double) {
                          return 2.0 * std::sin(4.0 * q + 0.7) +
                                 8.0 * std::exp(-50.0 * (q - 0.1) * (q - 0.1));
                        }).unnamed;
  EXPECT_GT(said.explained, 0.9);
  EXPECT_EQ(said.formula, "");
}

}  // namespace
}  // namespace lacuna
