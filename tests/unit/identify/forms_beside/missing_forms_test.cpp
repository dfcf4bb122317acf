// SPDX-License-Identifier: MIT
#include "identify/forms_beside/missing_forms.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "identify/forms_beside/function_forms.hpp"
#include "identify/forms_beside/product_forms.hpp"
#include "lacuna/bases/monomials.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"

namespace lacuna {
namespace {

/// A record of dx/dt = y, dy/dt = f.
struct Oscillator {
  explicit Oscillator(const std::string& force, double noise = 0.0) {
    const Variables variables{{"x", "y"}, {}};
    model.emplace(std::vector<Quantity>{{"x", ""}, {"y", ""}}, std::vector<Quantity>{},
                  std::vector<Equation>{{{Term::parse("y", variables), 1.0}},
                                        {{Term::parse(force, variables), -1.0}}});
    data = record_of(*model, Dopri87{}, Eigen::Vector2d(2.0, 0.0), 0.02, 1500);
    data = add_noise(data, Vector::Constant(2, noise), 1);
    sigma = Vector::Constant(2, noise);
    scope = make_scope(*model, data, sigma);
    library = Monomials{}.library(variables);
  }

  EquationForms bare() const { return {1, library.terms, {}}; }
  std::vector<Candidate> candidates() const { return function_forms(*scope, {}, 1); }

  std::optional<OdeModel> model;
  Dataset data;
  Vector sigma;
  std::optional<Scope> scope;
  TermLibrary library;
};

TEST(FormSearch, OneFormDoesTheWorkOfManyTerms) {
  const Oscillator c("sin(x)", 0.002);
  const FormSearch search(c.data, c.sigma);
  const EquationForms few = search.with_fewer_terms(c.bare(), c.candidates(), c.library.terms);
  EXPECT_TRUE(few.terms.empty());
  ASSERT_EQ(few.forms.size(), 1u);
  EXPECT_EQ(few.forms[0].expression().to_string(), "sin(x)");
  EXPECT_EQ(few.parameters(), 1u);
}

TEST(FormSearch, WhatIsNegligibleNeedsNoParameters) {
  const Oscillator c("sin(x)+0.0005*x*y");
  const FormSearch search(c.data, c.sigma);
  const auto few = [&](double negligible) {
    return search.with_fewer_terms(c.bare(), c.candidates(), c.library.terms,
                                   Remainder::Unknown, negligible);
  };
  EXPECT_GT(few(0.0).parameters(), 1u);
  const EquationForms plain = few(0.01);
  ASSERT_EQ(plain.forms.size(), 1u);
  EXPECT_TRUE(plain.terms.empty());
  EXPECT_EQ(plain.forms[0].expression().to_string(), "sin(x)");
}

TEST(FormSearch, ATermThatLeavesOnlyNoiseIsNotExchanged) {
  for (const double noise : {0.0, 0.01}) {
    const Oscillator c("x", noise);
    const FormSearch search(c.data, c.sigma);
    std::vector<Candidate> candidates = c.candidates();
    for (Candidate& candidate : composed_forms(*c.scope, 1))
      candidates.push_back(std::move(candidate));
    const EquationForms found = search.exchanged({1, {c.library.terms[1]}, {}}, candidates);
    EXPECT_EQ(found.terms, (std::vector<Term>{c.library.terms[1]}));
    EXPECT_TRUE(found.forms.empty());
  }
}

TEST(FormSearch, AJumpTakesThePlaceOfASlopeThatHardlyASampleSees) {
  const Oscillator c("sin(x)");
  const FormSearch search(c.data, c.sigma);
  const auto candidates = c.candidates();
  const auto form = [&](const std::string& pattern, double shape) {
    for (const Candidate& candidate : candidates)
      if (candidate.form.to_string() == pattern)
        return MissingForm{candidate, Vector::Constant(1, shape)};
    throw std::runtime_error(pattern);
  };
  const auto steep =
      search.plainer({1, {}, {form("tanh(y/a)", 0.01)}}, candidates, Plainness::Jump);
  ASSERT_TRUE(steep);
  EXPECT_EQ(steep->forms[0].expression().to_string(), "sign(y)");
  EXPECT_FALSE(search.plainer({1, {}, {form("tanh(y/a)", 1.0)}}, candidates, Plainness::Jump));
  EXPECT_FALSE(search.plainer({1, {}, {form("sin(x/a)", 1.01)}}, candidates, Plainness::Jump));
  const auto plain =
      search.plainer({1, {}, {form("sin(x/a)", 1.01)}}, candidates, Plainness::Any);
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->forms[0].expression().to_string(), "sin(x)");
}

TEST(FormSearch, WhatEquationsShareIsOneForm) {
  const Oscillator c("x/(1+x^2/0.49)");
  const FormSearch search(c.data, c.sigma);
  const std::vector<Candidate> candidates = c.candidates();
  const auto form = [&](const std::string& name, double shape) {
    const auto found =
        std::find_if(candidates.begin(), candidates.end(),
                     [&](const Candidate& one) { return one.form.to_string() == name; });
    return MissingForm{*found, Vector::Constant(1, shape)};
  };
  const std::string saturating = "x/(1+x^2/a^2)", sine = "sin(x/a)";
  MissingForm elsewhere = form(saturating, 0.7001);
  elsewhere.candidate.equation = 0;
  const std::vector<MissingForm> shared = search.shared_forms(
      {{0, {}, {elsewhere}},
       {1, {}, {form(saturating, 0.7), form(saturating, 3.0), form(sine, 1.0)}}});
  ASSERT_EQ(shared.size(), 3u);
  EXPECT_EQ(shared[0].shapes[0], 0.7001) << "the first stands for both";
  EXPECT_EQ(shared[1].shapes[0], 3.0) << "another function of x";
  EXPECT_EQ(shared[2].candidate.form.to_string(), sine);
}

/// 0.6 - 1.5 x/(0.3+x) is -0.9 + 1.5/(1+x/0.3): less of the constant stays in the first.
TEST(FormSearch, OfTwoWritingsThePlainerOne) {
  const Variables variables{{"x"}, {}};
  const OdeModel decay({{"x", ""}}, {}, {{{Term::parse("x", variables), -1.0}}});
  const Dataset data = record_of(decay, Dopri87{}, Vector::Constant(1, 2.0), 0.01, 400);
  const std::vector<Candidate> candidates =
      function_forms(make_scope(decay, data, Vector::Zero(1)), {}, 0);
  const auto form = [&](const std::string& pattern) {
    for (const Candidate& candidate : candidates)
      if (candidate.form.to_string() == pattern)
        return MissingForm{candidate, Vector::Constant(1, 0.3)};
    throw std::runtime_error(pattern);
  };
  const FormSearch search(data, Vector::Zero(1));
  const auto written = [&](const std::string& pattern, double of_term, double of_form) {
    const EquationForms equation{0, {Term::parse("1", variables)}, {form(pattern)}};
    return search.plainly_written(equation, Eigen::Vector2d(of_term, of_form), candidates)
        .forms[0]
        .expression()
        .to_string();
  };
  EXPECT_EQ(written("1/(1+x/a)", -0.9, 1.5), "x/(0.3+x)");
  EXPECT_EQ(written("x/(a+x)", 0.6, -1.5), "x/(0.3+x)");
  EXPECT_EQ(written("1/(1+x/a)", 0.1, 2.0), "1/(1+x/0.3)");
  EXPECT_EQ(written("x/(a+x)", 2.1, -2.0), "1/(1+x/0.3)");
  // x - x^2/(a+x) = a x/(a+x).
  MissingForm high = form("x/(a+x)");
  high.candidate.form = parse_expression("x^2/(a+x)");
  const EquationForms square{0, {Term::parse("x", variables)}, {high}};
  EXPECT_EQ(search.plainly_written(square, Eigen::Vector2d(1.0, -0.99), candidates)
                .forms[0]
                .expression()
                .to_string(),
            "x/(0.3+x)");
}

/// A denominator with a number that says nothing.
TEST(FormSearch, AShapeLessIsTheFormThatLeavesLeast) {
  const Oscillator c("x/(1+x^2/0.49)");
  const FormSearch search(c.data, c.sigma);
  Candidate fraction;
  fraction.form = parse_expression("x/(1+b*x^2+d*y^2)");
  fraction.shapes = {{"b", "", 0.01, 100.0, true}, {"d", "", 1e-6, 1.0, true}};
  fraction.equation = 1;
  const EquationForms two{1, {}, {{fraction, Eigen::Vector2d(2.0, 1e-5)}}};
  const auto one = search.with_fewer_shapes(two, c.candidates());
  ASSERT_TRUE(one);
  ASSERT_EQ(one->forms.size(), 1u);
  EXPECT_EQ(one->forms[0].candidate.form.to_string(), "x/(1+x^2/a^2)");
  EXPECT_NEAR(one->forms[0].shapes[0], 0.7, 1e-4);
  EXPECT_FALSE(search.with_fewer_shapes(*one, c.candidates()));
}

}  // namespace
}  // namespace lacuna
