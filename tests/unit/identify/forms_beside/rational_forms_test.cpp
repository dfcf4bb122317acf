// SPDX-License-Identifier: MIT
#include "identify/forms_beside/rational_forms.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "lacuna/bases/monomials.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

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
