// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/parametrised_model.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

const std::vector<Quantity> kStates = {{"q", "m"}, {"v", "m/s"}};

/// dq/dt = v, dv/dt = -2 q - 5 max(0,q-b) + u, with b a shape parameter.
OdeModel stop_model() {
  const Variables variables{{"q", "v"}, {"u", "b"}};
  return {kStates,
          {{"u", "N"}, {"b", "m"}},
          {{{Term::parse("v", variables), 1.0}},
           {{Term::parse("q", variables), -2.0},
            {Term::parse("max(0,q-b)", variables), -5.0},
            {Term::parse("u", variables), 1.0}}}};
}

ParametrisedModel stop() {
  return with_free_coefficients(stop_model(), {true, false}, {{"b", 0.3}});
}

TEST(ParametrisedModel, CoefficientsComeBeforeShapes) {
  EXPECT_EQ(stop().size(), 4);
  EXPECT_EQ(stop().values(), (Vector(4) << -2.0, -5.0, 1.0, 0.3).finished());
  EXPECT_EQ(stop().names(), (std::vector<std::string>{"v: q", "v: max(0,q-b)", "v: u", "b"}));
  EXPECT_EQ(stop().record_inputs(), 1);
}

TEST(ParametrisedModel, PlainModelHasNumbersForShapes) {
  const Vector values = (Vector(4) << -3.0, -6.0, 2.0, 0.5).finished();
  const OdeModel plain = stop().with_values(values).model();
  EXPECT_EQ(plain.inputs().size(), 1u);
  EXPECT_EQ(plain.coefficient(0, "v"), 1.0);
  EXPECT_EQ(plain.coefficient(1, "q"), -3.0);
  EXPECT_EQ(plain.coefficient(1, "max(0,q-0.5)"), -6.0);
}

TEST(ParametrisedModel, AdmissibleValuesStayInBounds) {
  const ParametrisedModel model(stop_model(), {{1, 0}},
                                {{.name = "b", .value = 0.3, .lower = 0.1, .upper = 0.4}});
  EXPECT_EQ(model.admissible((Vector(2) << -9.0, 0.7).finished())[1], 0.4);
  EXPECT_EQ(model.admissible((Vector(2) << -9.0, 0.0).finished())[1], 0.1);
  EXPECT_EQ(model.admissible((Vector(2) << -9.0, 0.2).finished())[0], -9.0);
}

TEST(ParametrisedModel, PriorsFollowTheParameters) {
  const ParametrisedModel model(stop_model(), {{1, 0, Prior{-2.0, 0.1}}, {1, 2}},
                                {{.name = "b", .value = 0.3, .prior = Prior{0.3, 0.05}}});
  ASSERT_EQ(model.priors().size(), 3u);
  EXPECT_EQ(model.priors()[0]->tolerance, 0.1);
  EXPECT_FALSE(model.priors()[1].has_value());
  EXPECT_EQ(model.priors()[2]->tolerance, 0.05);
}

TEST(ParametrisedModel, RejectsWhatDoesNotFit) {
  EXPECT_THROW(ParametrisedModel(stop_model(), {{1, 3}}, {{"b", 0.3}}), ArgumentError);
  EXPECT_THROW(ParametrisedModel(stop_model(), {{1, 0}, {1, 0}}, {{"b", 0.3}}), ArgumentError);
  EXPECT_THROW(ParametrisedModel(stop_model(), {}, {{"c", 0.3}}), ModelError);
  EXPECT_THROW(ParametrisedModel(stop_model(), {{1, 0, Prior{1.0, 0.0}}}, {{"b", 0.3}}),
               ArgumentError);
  EXPECT_THROW(stop().with_values(Vector::Zero(2)), ArgumentError);
}

}  // namespace
}  // namespace lacuna
