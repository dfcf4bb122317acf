// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/effects/effects.hpp"
#include "support/diagnosis_scope.hpp"
#include "support/effect_forms.hpp"

namespace lacuna {
namespace {

using support::model_of_lines;
using support::scope_of;

Expression as(const std::string& text) { return parse_expression(text); }

std::vector<std::string> texts(const std::vector<Expression>& expressions) {
  std::vector<std::string> result;
  for (const Expression& expression : expressions) result.push_back(expression.to_string());
  return result;
}

/// A drive: two speeds, a twist between them; another part that has nothing to do with it.
Scope drive() {
  return scope_of(model_of_lines({{"w1", {{"d", -200.0}, {"u", 1.0}, {"w1*abs(w1)", -0.1}}},
                                  {"d", {{"w1", 1.0}, {"w2", -1.0}}},
                                  {"w2", {{"d", 150.0}, {"w2", -2.0}}},
                                  {"y", {{"y", -1.0}}}},
                                 {"u"}));
}

TEST(EffectTerms, FindsTermsInWhateverWriting) {
  EXPECT_TRUE(has_term(drive(), 1, as("w2")));
  EXPECT_TRUE(has_term(drive(), 0, as("w1*abs(w1)")));
  EXPECT_FALSE(has_term(drive(), 0, as("w2")));
}

TEST(EffectTerms, SlopesAreThoseOfTermsAndDifferences) {
  const OdeModel model = drive().model;
  EXPECT_EQ(slope(model, 0, as("d")), -200.0);
  EXPECT_EQ(slope(model, 1, as("w1-w2")), 1.0);
  EXPECT_EQ(slope(model, 3, as("d")), 0.0);
}

TEST(EffectTerms, DifferencesHaveOppositeCoefficients) {
  EXPECT_EQ(texts(differences(drive(), 1)), std::vector<std::string>{"w1-w2"});
  EXPECT_TRUE(differences(drive(), 2).empty());
  EXPECT_EQ(texts(linear_arguments(drive(), 1)),
            (std::vector<std::string>{"w1", "w2", "w1-w2"}));
}

TEST(EffectTerms, DifferencesMayBeWrittenAsTerms) {
  const Scope gear = support::scope_of(
      support::model_of_lines({{"a", {{"a-b", -150.0}}}, {"b", {{"a-b", 75.0}}}}, {}));
  EXPECT_EQ(texts(differences(gear, 0)), std::vector<std::string>{"a-b"});
  EXPECT_EQ(texts(differences(gear, 1)), std::vector<std::string>{"b-a"})
      << "its own comes first";
  EXPECT_EQ(slope(gear.model, 0, as("a-b")), -150.0);
  EXPECT_EQ(slope(gear.model, 1, as("b-a")), -75.0);
}

TEST(EffectTerms, WhatIsHeldByAnotherBodyAndByTheGroundHasADifferenceToo) {
  Scope pair = scope_of(model_of_lines(
      {{"a", {{"a", -10.0}, {"b", 6.0}}}, {"b", {{"a", 1.0}, {"b", -7.0}}}}, {}));
  pair.variables[1].unit = "mm";
  EXPECT_EQ(texts(differences(pair, 0)), std::vector<std::string>{"a-b"}) << "these convert";
  EXPECT_EQ(slope(pair.model, 0, as("a-b")), -6.0) << "the rest holds a to the ground";
  EXPECT_EQ(texts(differences(pair, 1)), std::vector<std::string>{"b-a"});
  EXPECT_EQ(slope(pair.model, 1, as("b-a")), -1.0);
}

TEST(EffectTerms, APositionAndAVelocityHaveNoDifference) {
  const Scope swing =
      scope_of(model_of_lines({{"q", {{"v", 1.0}}}, {"v", {{"q", -4.0}, {"v", 3.0}}}}, {}));
  EXPECT_TRUE(differences(swing, 1).empty());
}

TEST(EffectTerms, AStateAndAnInputHaveADifferenceWhereTheirCoefficientsAreOpposite) {
  const auto of = [](double input) {
    return scope_of(model_of_lines({{"a", {{"a", -5.0}, {"u", input}}}}, {"u"}));
  };
  EXPECT_EQ(texts(differences(of(5.0), 0)), std::vector<std::string>{"a-u"});
  EXPECT_TRUE(differences(of(1.0), 0).empty()) << "a force is no speed";
}

TEST(EffectTerms, FeltSpeedsAreThoseOfBodiesThatMoveTogether) {
  const Scope cart = support::scope_of(support::model_of_lines(
      {{"x", {{"v", 1.0}}}, {"v", {{"v-u", -2.0}}}, {"q", {{"w", 1.0}}}, {"w", {{"q", -9.0}}}},
      {"u"}));
  EXPECT_EQ(texts(felt_speeds(cart, 1)), (std::vector<std::string>{"v", "v-u", "w"}));
  EXPECT_EQ(texts(felt_speeds(cart, 0)), std::vector<std::string>{"x"});
  EXPECT_TRUE(is_own_speed(cart, 1, as("v-u")));
  EXPECT_FALSE(is_own_speed(cart, 1, as("w")));
}

TEST(EffectTerms, PartsAreWhatNoTermConnects) {
  EXPECT_TRUE(in_other_part(drive(), 0, as("y")));
  EXPECT_TRUE(in_other_part(drive(), 3, as("w2")));
  EXPECT_FALSE(in_other_part(drive(), 0, as("w2")));
  EXPECT_FALSE(in_other_part(drive(), 0, as("u")));
}

TEST(EffectTerms, TransmissionsLieBetweenTwoPlaces) {
  EXPECT_TRUE(is_transmission(drive(), as("w1-w2")));
  EXPECT_TRUE(is_transmission(drive(), as("d")));
  EXPECT_FALSE(is_transmission(drive(), as("w1")));
  const Scope shaft = scope_of(
      model_of_lines({{"a", {{"d", -9.0}}}, {"d", {{"a-b", 1.0}}}, {"b", {{"d", 5.0}}}}, {}));
  EXPECT_TRUE(is_transmission(shaft, as("d"))) << "written as a difference";
}

TEST(EffectTerms, NonlinearTermsAndTheWholeEquation) {
  EXPECT_EQ(texts(nonlinear_terms(drive(), 0)), std::vector<std::string>{"w1*abs(w1)"});
  EXPECT_EQ(right_hand_side(drive(), 1), as("1*w1+(-1)*w2"));
}

TEST(EffectTerms, FactorsOfProductsAndPowers) {
  const auto factors = [](const std::string& term) {
    std::vector<std::string> result;
    for (const TermFactor& factor : factors_of(as(term)))
      result.push_back(factor.factor.to_string() + " of " + factor.rest.to_string());
    return result;
  };
  EXPECT_EQ(factors("w1*w2"), (std::vector<std::string>{"w1 of w2", "w2 of w1"}));
  EXPECT_EQ(factors("w1^3"), std::vector<std::string>{"w1 of w1^2"});
  EXPECT_EQ(factors("w1*abs(w1)"),
            (std::vector<std::string>{"w1 of abs(w1)", "abs(w1) of w1"}));
  EXPECT_EQ(factors("sin(w1)"), std::vector<std::string>{});
  EXPECT_EQ(factors("2*w1"), std::vector<std::string>{});
}

TEST(EffectTerms, WhatAllTermsAreDividedBy) {
  const auto common = [](const std::vector<std::string>& terms) {
    std::vector<std::pair<std::string, double>> lines;
    for (const std::string& term : terms) lines.emplace_back(term, 1.0);
    const Scope scope = scope_of(model_of_lines({{"T", lines}, {"h", {}}}, {"q"}));
    const auto factor = common_factor(scope, 0);
    return factor ? factor->to_string() : "";
  };
  EXPECT_EQ(common({"q*h^-1", "h^-1*q*T"}), "h^-1") << "q is a factor that others may lack";
  EXPECT_EQ(common({"q*h^-1*cos(T)", "cos(T)*h^-1"}), "h^-1*cos(T)");
  EXPECT_EQ(common({"q/(1+h)", "T/(1+h)", "T"}), "");
  EXPECT_EQ(common({"h*q", "h*T"}), "") << "products of variables are terms of their own";
  EXPECT_EQ(common({"q/h"}), "") << "one term has everything in common with itself";
}

TEST(EffectTerms, VelocitiesAreRatesByIdentity) {
  EXPECT_TRUE(is_velocity(support::oscillator_scope(), 1));
  EXPECT_FALSE(is_velocity(drive(), 0));
}

TEST(EffectTerms, MagnitudesIgnoreTheSign) {
  EXPECT_NEAR(magnitude_quantile(drive(), as("w1"), 1.0), 1.0, 1e-3);
  EXPECT_NEAR(magnitude_quantile(drive(), as("w1"), 0.5), std::sqrt(0.5), 0.03);
  EXPECT_EQ(drive().range_of(as("w1")).noise, 0.01) << "as the scope has it";
  EXPECT_NEAR(drive().range_of(as("w1-w2")).magnitude(), 2.0, 0.05);
}

TEST(EffectTerms, WhatHasAnotherUnitIsNoPartOfADifference) {
  const auto arguments = [](const std::string& of_i) {
    OdeModel model = model_of_lines(
        {{"w", {{"w", -3.0}, {"i", 2.0}}}, {"i", {{"i", -20.0}, {"w", -5.0}}}}, {});
    const OdeModel units({{"w", "rad/s"}, {"i", of_i}}, {}, model.equations());
    return texts(differences(scope_of(units), 0));
  };
  EXPECT_EQ(arguments("deg/s"), std::vector<std::string>{"w-i"});
  EXPECT_TRUE(arguments("A").empty());
}

TEST(EffectPatterns, AreRecognisedWhateverTheirParametersAreCalled) {
  const Scope scope = support::oscillator_scope();
  const Expression x = parse_expression("q-F");
  const Candidate bend = shaped_candidate(formula(scope, "clip(x,-gap,gap)", {{"x", x}}), x,
                                          {"gap", "m", 0.1, 1.0, false}, starts_at({0.5}));
  EXPECT_TRUE(has_form(bend, "clip(x,-a,a)"));
  EXPECT_FALSE(has_form(bend, "clip(x,-a,b)")) << "there is no second parameter";
  EXPECT_FALSE(has_form(bend, "x-clip(x,-a,a)"));
  EXPECT_TRUE(has_form(play_of(scope, 1, Expression::variable("F")), "clip(m-x,-a,a)"));
}

TEST(EffectPatterns, ARestIsAPartOfATermOrTheWhole) {
  const Scope scope = support::oscillator_scope();
  const NamingOptions options;
  Candidate play = play_of(scope, 1, Expression::variable("q"));
  play.equation = 1;
  const auto fitted = [&](double coefficient) {
    return FittedForm{play,   play.starts.front(), coefficient, 0.01, scope.model, scope,
                      options};
  };
  EXPECT_TRUE(is_part_of_term(fitted(-2.0)));
  EXPECT_FALSE(is_whole_term(fitted(-2.0)));
  EXPECT_TRUE(is_whole_term(fitted(-4.1)));
  EXPECT_FALSE(is_part_of_term(fitted(2.0)));
  EXPECT_EQ(play.least, -8.0);
}

}  // namespace
}  // namespace lacuna
