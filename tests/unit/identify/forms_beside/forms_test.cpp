// SPDX-License-Identifier: MIT
// Forms that are proposed beside a library, and the search among them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bases/monomials.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "identify/forms_beside/form_problem.hpp"
#include "identify/forms_beside/function_forms.hpp"
#include "identify/forms_beside/missing_forms.hpp"
#include "identify/forms_beside/product_forms.hpp"
#include "identify/forms_beside/rational_forms.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/noisy_records.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

// Forms that are proposed beside a library.
constexpr double kFrequency = 0.37, kPhase = 0.6;

/// dx/dt = -x + (x or 1) cos-like forcing, by its exact solution: the integral of a tone for
/// dx/dt = sin(2 pi f t + p), and exp of it for dx/dt = x sin(2 pi f t + p).
Dataset record_of(bool modulated) {
  const double w = 2.0 * M_PI * kFrequency;
  Trajectory record;
  record.time = Vector::LinSpaced(1201, 5.0, 35.0);
  const Vector tone = -((w * record.time.array() + kPhase).cos() / w).matrix();
  record.states = modulated ? Vector(tone.array().exp()) : tone;
  return support::one_record({{"x", ""}}, {}, record);
}

OdeModel model_of() { return OdeModel({{"x", ""}}, {}, {{}}); }

std::vector<Candidate> tones_of(const Dataset& data) {
  const FormProblem problem(data, Vector::Zero(1));
  const Scope scope = make_scope(model_of(), data, Vector::Zero(1));
  return forcing_forms(scope, problem.all_rows(), {0, problem.linear_terms(), {}}, 2, {});
}

/// What the best start of the candidates with a form leaves of the target.
double least_left(const Dataset& data, bool modulated) {
  const FormProblem problem(data, Vector::Zero(1));
  double least = 1.0;
  for (const Candidate& candidate : tones_of(data)) {
    if (candidate.form.variables().contains("x") != modulated) continue;
    EquationForms equation{0, {}, {{candidate, candidate.starts[0]}}};
    const double left = problem.polish(equation, 0);
    least = std::min(least, left / problem.all_rows().target(0).squaredNorm());
  }
  return least;
}

TEST(ForcingForms, AToneIsFoundWithFrequencyAndPhase) {
  const std::vector<Candidate> tones = tones_of(record_of(false));
  ASSERT_FALSE(tones.empty());
  EXPECT_NEAR(tones[0].starts[0][0], kFrequency, 0.25 / 30.0);
  // The nearest frequency of the search is a little off: in phase halfway, at t = 20.
  const Vector& start = tones[0].starts[0];
  const double apart = 2.0 * M_PI * (kFrequency - start[0]) * 20.0 + kPhase - start[1];
  EXPECT_GT(std::cos(apart), 0.99);
  EXPECT_TRUE(tones[0].repeats);
  EXPECT_EQ(tones[0].argument, Expression::variable("t"));
  EXPECT_LT(least_left(record_of(false), false), 1e-8);
}

TEST(ForcingForms, ACoefficientThatSwingsIsATonesProductWithTheState) {
  EXPECT_LT(least_left(record_of(true), true), 1e-8);
  EXPECT_GT(least_left(record_of(true), false), 1e-4);
}

std::set<std::string> forms_of(const std::vector<Candidate>& candidates) {
  std::set<std::string> forms;
  for (const Candidate& candidate : candidates) forms.insert(candidate.form.to_string());
  return forms;
}

Scope scope_of(double offset) {
  Dataset data = noisy_record("van-der-pol", 400, 0.01, 1);
  for (Trajectory& record : data.trajectories) record.states.array() += offset;
  return make_scope(test_system("van-der-pol").model, data, Eigen::Vector2d(0.02, 0.02));
}

TEST(FunctionForms, OfAmountsAloneTheSizeIsTheValueItself) {
  const auto effects = default_registry().make_all<Effect>();
  const auto has_drag = [&](double offset, const std::string& form) {
    const auto candidates = function_forms(scope_of(offset), effects, 1);
    return std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& one) {
      return one.form.to_string() == form &&
             std::count(one.families.begin(), one.families.end(), "quadratic-drag") > 0;
    });
  };
  EXPECT_TRUE(has_drag(0.0, "v*abs(v)"));
  EXPECT_FALSE(has_drag(10.0, "v*abs(v)"));
  for (const std::string& form : forms_of(function_forms(scope_of(10.0), effects, 1)))
    for (const char* size : {"abs(q)", "abs(v)"})
      EXPECT_EQ(form.find(size), std::string::npos) << form;
}

std::multiset<std::string> forms_of(const Scope& scope) {
  std::multiset<std::string> forms;
  for (const Candidate& candidate : product_forms(scope))
    forms.insert(candidate.form.to_string());
  return forms;
}

TEST(ProductForms, HaveNoPoleWhereAVariableChangesSign) {
  const auto forms = forms_of(scope_of(0.0));
  EXPECT_EQ(forms.count("v/(1+q^2/a^2)"), 1u);
  EXPECT_EQ(forms.count("q*v/(a+q)"), 0u);
  EXPECT_EQ(forms.count("v/(1+q^3/a^3)"), 0u);
}

/// Fractions for the first equation of a model, seen on one clean orbit.
std::vector<Candidate> fractions_of(const std::string& text, const Vector& start) {
  const OdeModel model = parse_ode(text, "model");
  const Dataset data = record_of(model, Dopri87{}, start, 0.05, 600);
  const Vector noise = Vector::Zero(model.dimension());
  const FormRows rows(data, noise);
  return rational_forms(make_scope(model, data, noise), rows,
                        {0, Monomials{}.library(model.variables()).terms, {}},
                        static_cast<std::size_t>(FormOptions{}.denominators), {});
}

const Candidate* form_in(const std::vector<Candidate>& all, const std::string& form) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Candidate& candidate) {
    return candidate.form.to_string() == form;
  });
  return found == all.end() ? nullptr : &*found;
}

TEST(RationalForms, TheImplicitFormGivesTheNumbersOfADenominator) {
  const auto all = fractions_of(
      "dx/dt = 1.1*x - 0.4*x^2 - 2.6*x*y/(1+1.7*x+0.6*y)\n"
      "dy/dt = 1.9*x*y/(1+1.7*x+0.6*y) - 0.5*y",
      Eigen::Vector2d(0.5, 1.0));
  const Candidate* form = form_in(all, "x*y/(1+a*x+b*y)");
  ASSERT_NE(form, nullptr);
  EXPECT_EQ(form->equation, 0);
  EXPECT_TRUE(std::any_of(form->starts.begin(), form->starts.end(), [](const Vector& start) {
    return std::abs(start[0] - 1.7) < 0.02 && std::abs(start[1] - 0.6) < 0.02;
  }));
}

TEST(RationalForms, ADenominatorHasFourMonomialsWhereItNeedsThem) {
  const auto all = fractions_of(
      "dx/dt = 0.9 - 0.1*x - 2.1*x*y/(1+1.2*x+0.7*y+0.9*x*y)\n"
      "dy/dt = 1.5*x*y/(1+1.2*x+0.7*y+0.9*x*y) - 0.5*y",
      Eigen::Vector2d(2.5, 0.3));
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const Candidate& candidate) {
    return candidate.shapes.size() == 3 &&
           candidate.argument.to_string().find("x*y") != std::string::npos;
  }));
  const auto few = fractions_of(
      "dx/dt = 1.1*x - 0.4*x^2 - 2.6*x*y/(1+1.7*x+0.6*y)\n"
      "dy/dt = 1.9*x*y/(1+1.7*x+0.6*y) - 0.5*y",
      Eigen::Vector2d(0.5, 1.0));
  EXPECT_TRUE(std::none_of(few.begin(), few.end(), [](const Candidate& candidate) {
    return candidate.shapes.size() == 3;
  }));
}

TEST(RationalForms, AreNotReducibleAndHaveNoPole) {
  const auto all = fractions_of("dx/dt = y\ndy/dt = -x", Eigen::Vector2d(1.0, 0.0));
  ASSERT_FALSE(all.empty());
  for (const Candidate& candidate : all) {
    const std::string form = candidate.form.to_string();
    EXPECT_EQ(form.find("a*x+"), std::string::npos) << form;
    EXPECT_NE(form, "x/(x+a*x*y)");
    for (const Vector& start : candidate.starts) EXPECT_TRUE((start.array() > 0.0).all());
  }
}

TEST(RationalForms, HaveNoDenominatorThatVanishesWithAFactor) {
  const auto all = fractions_of("dx/dt = -x\ndy/dt = 0.3 - 0.1*y", Eigen::Vector2d(1.0, 1.0));
  ASSERT_FALSE(all.empty());
  for (const Candidate& candidate : all) {
    const std::string divisor = candidate.argument.to_string();
    EXPECT_THAT(divisor,
                ::testing::AnyOf(::testing::StartsWith("1"), ::testing::StartsWith("y"),
                                 ::testing::HasSubstr("+a*y")))
        << "x falls to 0";
  }
}

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
