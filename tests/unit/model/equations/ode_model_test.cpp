// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/ode_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/equations/system_model.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

const Variables kPositionAndSpeed{{"x", "v"}, {"u"}};

WeightedTerm summand(const std::string& text, double coefficient) {
  return {Term::parse(text, kPositionAndSpeed), coefficient};
}

OdeModel oscillator() {
  return OdeModel(
      {{"x", "m"}, {"v", "m/s"}}, {{"u", "N"}},
      {{summand("v", 1.0)}, {summand("x", -4.0), summand("x^3", -0.5), summand("u", 2.0)}},
      "ms");
}

std::string message(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(OdeModel, TermsGetCanonicalNamesInItsOwnVariables) {
  const Variables other{{"v", "x"}, {}};
  const OdeModel model({{"x", ""}, {"v", ""}}, {}, {{{Term::parse("v*x", other), 1.0}}, {}});
  EXPECT_EQ(model.equations()[0][0].term.name(), "x*v");
}

TEST(OdeModel, AnUnknownStateOrEquationIsNamed) {
  EXPECT_THAT(message([] { oscillator().state_index("w"); }),
              HasSubstr("there is no state 'w'; the states are x, v"));
  EXPECT_THROW(oscillator().coefficient(2, "x"), ArgumentError);
  EXPECT_THROW(oscillator().coefficient(-1, "x"), ArgumentError);
  EXPECT_THROW(oscillator().with_term(2, summand("x", 1.0)), ArgumentError);
}

TEST(OdeModel, WithTermAppendsOrAddsUp) {
  const OdeModel more = oscillator().with_term(1, summand("v", -0.1));
  EXPECT_EQ(more.equations()[1].size(), 4u);
  EXPECT_EQ(more.coefficient(1, "v"), -0.1);
  WeightedTerm change = summand("x*x*x", 0.2);
  change.standard_error = 0.01;
  const OdeModel changed = oscillator().with_term(1, change);
  EXPECT_EQ(changed.equations()[1].size(), 3u);
  EXPECT_EQ(changed.coefficient(1, "x^3"), -0.3);
  EXPECT_FALSE(changed.equations()[1][1].standard_error);
  EXPECT_EQ(changed.time_unit(), "ms");
}

TEST(IdentityOf, IsAnotherStateAloneWithCoefficientOne) {
  const Variables variables{{"x", "v"}, {"u"}};
  const auto identity = [&](const std::string& term, double coefficient) {
    const WeightedTerm only{Term::parse(term, variables), coefficient};
    return identity_of(OdeModel({{"x", ""}, {"v", ""}}, {{"u", ""}}, {{only}, {}}), 0);
  };
  EXPECT_EQ(identity("v", 1.0), std::optional<Index>(1));
  EXPECT_EQ(identity("v", 1.000001), std::nullopt);
  EXPECT_EQ(identity("v^2", 1.0), std::nullopt);
  EXPECT_EQ(identity("u", 1.0), std::nullopt) << "an input is no state";
  EXPECT_EQ(identity("x", 1.0), std::nullopt) << "dx/dt = x is growth";
  EXPECT_EQ(identity_of(oscillator(), 1), std::nullopt);
  EXPECT_THROW(identity_of(oscillator(), 2), ArgumentError);
}

TEST(OdeModel, RejectsEquationsThatDoNotFit) {
  const std::vector<Quantity> x{{"x", ""}};
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message([&] { OdeModel({}, {}, {}); }), HasSubstr("there are no states"));
  EXPECT_THAT(message([&] {
                OdeModel(x, {}, {{}, {}});
              }),
              HasSubstr("2 equations for 1 states"));
  EXPECT_THAT(message([&] { OdeModel(x, {}, {{summand("x", kNan)}}); }),
              HasSubstr("equation of x: the coefficient of 'x' is nan"));
  EXPECT_THAT(message([&] { OdeModel(x, {}, {{summand("v", 1.0)}}); }),
              HasSubstr("unknown name 'v'"));
  EXPECT_THAT(message([&] {
                OdeModel(x, {}, {{summand("x*x", 1.0), summand("x^2", 1.0)}});
              }),
              HasSubstr("equation of x: the term 'x^2' stands twice"));
}

OdeModel with_everything() {
  const OdeModel model({{"x", "m"}, {"v", ""}}, {{"u", "N"}}, {{}, {}}, "ms");
  return model.with_outputs({{"y", "V", parse_expression("abs(v)+u")}})
      .with_initial({InitialValue{1.0, true}, std::nullopt});
}

TEST(OdeModel, OutputsAndStartStayWithTheModel) {
  const Variables variables{{"x", "v"}, {"u"}};
  for (const OdeModel& model :
       {with_everything().with_term(1, {Term::parse("u", variables), 2.0}),
        with_everything().with_equations({{}, {{Term::parse("u", variables), 2.0}}}),
        with_everything().with_holds({Hold::Zero})}) {
    ASSERT_EQ(model.outputs().size(), 1u);
    EXPECT_EQ(model.outputs()[0].formula.to_string(), "abs(v)+u");
    ASSERT_EQ(model.initial().size(), 2u);
    EXPECT_TRUE(model.initial()[0]->fixed);
    EXPECT_EQ(model.time_unit(), "ms");
  }
  EXPECT_EQ(OdeModel({{"x", ""}}, {}, {{}}).initial().size(), 1u);
}

TEST(OdeModel, OutputsAndStartsThatDoNotFit) {
  const OdeModel model({{"x", "m"}, {"v", ""}}, {{"u", "N"}}, {{}, {}});
  const auto with = [&](const char* name, const char* formula) {
    return model.with_outputs({{name, "", parse_expression(formula)}});
  };
  EXPECT_NO_THROW(with("x", "x")) << "called as the state that it is";
  EXPECT_EQ(state_of(model, with("y", "v").outputs()[0]), 1);
  EXPECT_FALSE(state_of(model, with("y", "u").outputs()[0]).has_value());
  EXPECT_THROW(with("x", "v"), ModelError);
  EXPECT_THROW(with("u", "v"), ModelError);
  EXPECT_THROW(with("sin", "v"), ModelError);
  EXPECT_THROW(with("y", "q"), ModelError);
  EXPECT_THROW(with("y", "delay(v,1)"), ModelError);
  EXPECT_THROW(model.with_initial({std::nullopt}), ArgumentError);
  EXPECT_THROW(model.with_initial({std::nullopt, InitialValue{std::nan("")}}), ModelError);
  EXPECT_THROW(model.with_initial({std::nullopt, InitialValue{0.0, false, 0.0}}), ModelError);
}

TEST(OdeModel, AMapStaysAMap) {
  const OdeModel flow({{"x", ""}, {"y", ""}}, {},
                      {{{Term::parse("y", {{"x", "y"}, {}}), 1.0}}, {}});
  EXPECT_EQ(flow.evolution(), Evolution::Flow);
  EXPECT_EQ(identity_of(flow, 0), 1);
  EXPECT_NO_THROW(check_flow(flow, "this"));
  const OdeModel map = flow.with_evolution(Evolution::Map);
  EXPECT_TRUE(map.is_map());
  EXPECT_FALSE(identity_of(map, 0)) << "the next x is y, which is no derivative of it";
  EXPECT_TRUE(map.with_equations({{}, {}}).is_map());
  EXPECT_TRUE(map.with_term(1, {Term::parse("x", map.variables()), 0.3}).is_map());
  EXPECT_TRUE(map.with_holds({}).is_map());
  EXPECT_EQ(to_text(map), "x[n+1] = y\ny[n+1] = 0");
  EXPECT_THROW(check_flow(map, "this"), ModelError);
  EXPECT_FALSE(map.with_evolution(Evolution::Flow).is_map());
}

const std::vector<Quantity> kStopStates = {{"q", "m"}, {"v", "m/s"}};

/// dq/dt = v, dv/dt = -2 q - 5 max(0,q-b) + u, with b a shape parameter.
OdeModel stop_model() {
  const Variables variables{{"q", "v"}, {"u", "b"}};
  return {kStopStates,
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
