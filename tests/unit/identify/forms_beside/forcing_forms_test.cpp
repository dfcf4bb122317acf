// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "identify/forms_beside/form_problem.hpp"
#include "identify/forms_beside/product_forms.hpp"

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

}  // namespace
}  // namespace lacuna
