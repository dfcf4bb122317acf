// SPDX-License-Identifier: MIT
#include "identify/pipeline/constrained_equations.hpp"

#include <cmath>

#include "lacuna/bases/monomials.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "unit/identify/pipeline/records.hpp"

namespace lacuna {
namespace {

Dataset lorenz_record(double noise) {
  const TestSystem& lorenz = test_system("lorenz");
  const Dataset clean = testing::without_derivatives(
      record_of(lorenz.model, Dopri87{}, lorenz.start, 0.01, 2000));
  return noise > 0.0 ? add_relative_noise(clean, noise, 5) : clean;
}

Pipeline quadratic(const std::string& name) {
  Pipeline pipeline = preset(name);
  pipeline.basis = Monomials{{.max_degree = 2}};
  return pipeline;
}

TEST(ConstrainedEquations, KeepTheEnergyOfTheQuadraticPart) {
  for (const char* name : {"algorithm1", "robust", "sindy"}) {
    Pipeline pipeline = quadratic(name);
    pipeline.energy_preserving = true;
    const OdeModel model =
        identify(lorenz_record(name == std::string("sindy") ? 0.0 : 0.01), pipeline).model;
    EXPECT_NEAR(model.coefficient(1, "x*z"), -1.0, 0.02) << name;
    EXPECT_NEAR(
        model.coefficient(0, "y*z") + model.coefficient(1, "x*z") + model.coefficient(2, "x*y"),
        0.0, 1e-12)
        << name;
    EXPECT_NEAR(model.coefficient(0, "x^2"), 0.0, 1e-12) << name;
  }
}

TEST(ConstrainedEquations, ASharedParameterIsOneNumberWithOneInterval) {
  Pipeline pipeline = quadratic("algorithm1");
  pipeline.constraints = {{{{"x", "y", 1.0}, {"x", "x", 1.0}}, 0.0}};  // sigma (y - x)
  const OdeModel model = identify(lorenz_record(0.01), pipeline).model;
  const Equation& first = model.equations()[0];
  ASSERT_EQ(first.size(), 2U);
  EXPECT_NEAR(first[0].coefficient + first[1].coefficient, 0.0, 1e-11);
  EXPECT_NEAR(std::abs(first[0].coefficient), 10.0, 0.1);
  ASSERT_TRUE(first[0].standard_error && first[1].standard_error);
  EXPECT_NEAR(*first[0].standard_error, *first[1].standard_error, 1e-9);
}

TEST(ConstrainedEquations, AFixedCoefficientStays) {
  for (const char* name : {"algorithm1", "robust", "sindy"}) {
    Pipeline pipeline = quadratic(name);
    pipeline.constraints = {{{{"dy", "y"}}, -1.0}, {{{"dz/dt", "x*y"}}, 1.0}};
    const OdeModel model =
        identify(lorenz_record(name == std::string("sindy") ? 0.0 : 0.01), pipeline).model;
    EXPECT_NEAR(model.coefficient(1, "y"), -1.0, 1e-12) << name;
    EXPECT_NEAR(model.coefficient(2, "x*y"), 1.0, 1e-12) << name;
    EXPECT_NEAR(model.coefficient(1, "x"), 28.0, 0.2) << name;
    for (const WeightedTerm& summand : model.equations()[1])
      EXPECT_TRUE(summand.term.name() != "y" || !summand.ci95) << name;
  }
}

TEST(ConstrainedEquations, ABoundThatHoldsChangesNothing) {
  Pipeline pipeline = quadratic("algorithm1");
  const OdeModel free = identify(lorenz_record(0.01), pipeline).model;
  pipeline.constraints = {{{{"x", "x"}}, 0.0, ConstraintRelation::AtMost},
                          {{{"y", "x"}}, 20.0, ConstraintRelation::AtLeast}};
  const OdeModel bounded = identify(lorenz_record(0.01), pipeline).model;
  for (const char* term : {"x", "y", "x*z"})
    EXPECT_NEAR(bounded.coefficient(1, term), free.coefficient(1, term), 1e-4) << term;
}

TEST(ConstrainedEquations, ACoefficientStopsAtItsBound) {
  for (const char* name : {"algorithm1", "sindy"}) {
    Pipeline pipeline = quadratic(name);
    pipeline.constraints = {{{{"x", "y"}}, 9.0, ConstraintRelation::AtMost},
                            {{{"z", "z"}, {"y", "y"}}, -3.0, ConstraintRelation::AtLeast}};
    const OdeModel model = identify(lorenz_record(0.0), pipeline).model;
    EXPECT_NEAR(model.coefficient(0, "y"), 9.0, 1e-9) << name;  // 10 without
    EXPECT_NEAR(model.coefficient(2, "z") + model.coefficient(1, "y"), -3.0, 1e-9) << name;
  }
}

TEST(ConstrainedEquations, ATermOfTheWrongSignLeaves) {
  Pipeline pipeline = quadratic("algorithm1");
  pipeline.constraints = {{{{"x", "x"}}, 0.0, ConstraintRelation::AtLeast}};  // it is -10
  const IdentificationResult found = identify(lorenz_record(0.01), pipeline);
  EXPECT_EQ(found.model.coefficient(0, "x"), 0.0);
  EXPECT_FALSE(found.model.equations()[0].empty());
  for (const TrailEntry& entry : found.trail)
    EXPECT_FALSE(entry.kept && entry.equation == "x" && entry.term == "x");
}

TEST(ConstrainedEquations, WhatCannotBeIsOneError) {
  Pipeline pipeline = quadratic("algorithm1");
  pipeline.constraints = {{{{"x", "y"}}, 1.0}, {{{"x", "y"}}, 2.0}};
  EXPECT_THROW(identify(lorenz_record(0.0), pipeline), ConfigError);
  pipeline.constraints = {{{{"x", "y"}}, 1.0, ConstraintRelation::AtMost},
                          {{{"x", "y"}}, 2.0, ConstraintRelation::AtLeast}};
  EXPECT_THROW(identify(lorenz_record(0.0), pipeline), ConfigError);
  pipeline.constraints = {{{{"q", "y"}}, 1.0}};
  EXPECT_THROW(identify(lorenz_record(0.0), pipeline), ConfigError);
}

}  // namespace
}  // namespace lacuna
