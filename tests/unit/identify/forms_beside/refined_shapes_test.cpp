// SPDX-License-Identifier: MIT
#include "identify/forms_beside/refined_shapes.hpp"

#include <gtest/gtest.h>

#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

MissingForm form_with(double shape) {
  Candidate candidate;
  candidate.form = parse_expression("x/(a+x)");
  candidate.argument = Expression::variable("x");
  candidate.shapes = {{"a", "", 0.01, 10.0, true}};
  candidate.starts = {Vector::Constant(1, shape)};
  return {candidate, Vector::Constant(1, shape)};
}

TEST(RefinedShapes, AreThoseOfTheTrajectories) {
  const OdeModel truth = parse_ode("dx/dt = 0.6 - 1.5*x/(0.3+x)", "truth");
  const OdeModel model = parse_ode("dx/dt = 0.6 - 1.5*x/(0.36+x)", "model");
  const Dataset data = record_of(truth, Dopri87{}, Vector::Constant(1, 2.0), 0.02, 300);
  const std::vector<Term> constant{Term::parse("1", truth.variables())};
  const auto refined =
      refined_shapes(model, {{0, constant, {form_with(0.36)}}}, data, RunContext{});
  ASSERT_EQ(refined.size(), 1u);
  EXPECT_NEAR(refined[0].forms[0].shapes[0], 0.3, 1e-5);
}

TEST(RefinedShapes, AFormThatTheModelDoesNotHaveStaysAsItIs) {
  const OdeModel model = parse_ode("dx/dt = 0.6 - x", "model");
  const Dataset data = record_of(model, Dopri87{}, Vector::Constant(1, 2.0), 0.02, 300);
  const auto refined = refined_shapes(model, {{0, {}, {form_with(0.36)}}}, data, RunContext{});
  EXPECT_EQ(refined[0].forms[0].shapes[0], 0.36);
}

}  // namespace
}  // namespace lacuna
