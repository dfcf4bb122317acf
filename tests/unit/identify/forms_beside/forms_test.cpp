// SPDX-License-Identifier: MIT
// Forms that are proposed beside a library.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "identify/forms_beside/form_problem.hpp"
#include "identify/forms_beside/function_forms.hpp"
#include "identify/forms_beside/product_forms.hpp"
#include "identify/forms_beside/rational_forms.hpp"
#include "lacuna/bases/monomials.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "support/noisy_records.hpp"

namespace lacuna {
namespace {

constexpr double kFrequency = 0.37, kPhase = 0.6;

/// dx/dt = -x + (x or 1) cos-like forcing, by its exact solution: the integral of a tone for
/// dx/dt = sin(2 pi f t + p), and exp of it for dx/dt = x sin(2 pi f t + p).
Dataset record_of(bool modulated) {
  const double w = 2.0 * M_PI * kFrequency;
  Dataset data;
  data.states = {{"x", ""}};
  Trajectory record;
  record.time = Vector::LinSpaced(1201, 5.0, 35.0);
  record.inputs.resize(1201, 0);
  const Vector tone = -((w * record.time.array() + kPhase).cos() / w).matrix();
  record.states = modulated ? Vector(tone.array().exp()) : tone;
  data.trajectories = {record};
  return data;
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
    return candidate.shapes.size() == 3 && candidate.argument.to_string().find("x*y") !=
                                               std::string::npos;
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

}  // namespace
}  // namespace lacuna
