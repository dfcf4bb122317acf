// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/equations/adequacy.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/model/expressions/expression.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna {
namespace {

const Expression kWrittenX = Expression::variable("x"), kWrittenY = Expression::variable("y"),
                 kWrittenZ = Expression::variable("z"), kWrittenU = Expression::variable("u"),
                 kTime = Expression::variable("t");
const std::vector<Quantity> kLorenzStates{{"x", ""}, {"y", ""}, {"z", ""}};

TEST(WrittenModel, IsThatOfTheSameText) {
  const double sigma = 10.0, rho = 28.0, beta = 8.0 / 3.0;
  const OdeModel written =
      written_model(kLorenzStates,
                    {sigma * (kWrittenY - kWrittenX), kWrittenX * (rho - kWrittenZ) - kWrittenY,
                     kWrittenX * kWrittenY - beta * kWrittenZ});
  const OdeModel read = parse_ode(
      "time s\ndx/dt = 10*(y-x)\ndy/dt = x*(28-z) - y\ndz/dt = x*y - 8/3*z\n", "lorenz");
  EXPECT_EQ(to_text(written), to_text(read));
  EXPECT_EQ(written.coefficient(0, "y"), 10.0);
  EXPECT_EQ(written.coefficient(1, "x*z"), -1.0);
}

TEST(WrittenModel, HasInputsTimeAndUnits) {
  const OdeModel model = written_model(
      {{"x", "V"}}, {-2 * kWrittenX + pow(kWrittenU, 2) + sin(3 * kTime)}, {{"u", "A"}}, "ms");
  EXPECT_EQ(to_text(model), "dx/dt = -2*x + u^2 + sin(3*t)");
  EXPECT_EQ(model.time_unit(), "ms");
  EXPECT_EQ(model.inputs()[0].unit, "A");
}

TEST(WrittenModel, SaysWhatIsWrongWhere) {
  EXPECT_THROW(written_model(kLorenzStates, {kWrittenX}), ModelError);
  try {
    written_model(kLorenzStates, {kWrittenX, kWrittenY + kWrittenU, kWrittenZ});
    FAIL() << "u is no variable";
  } catch (const ModelError& error) {
    EXPECT_NE(error.where().find("dy/dt"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("'u'"), std::string::npos) << error.what();
  }
}

const Expression kX = Expression::variable("x");

std::vector<double> times_of(const std::vector<Event>& events, double begin, double end) {
  std::vector<double> times;
  for (const Occurrence& one : occurrences(events, begin, end)) times.push_back(one.time);
  return times;
}

TEST(Event, HappensOnceOrAtEqualDistances) {
  const std::vector<Event> events{{.time = 4.0, .resets = {{"x", kX}}},
                                  {.time = 1.0, .period = 2.0, .last = 6.0, .resets = {}}};
  EXPECT_EQ(times_of(events, 0.0, 10.0), (std::vector<double>{1.0, 3.0, 4.0, 5.0}));
  EXPECT_EQ(times_of(events, 3.0, 4.5), (std::vector<double>{3.0, 4.0}));
  EXPECT_EQ(times_of(events, 5.5, 10.0), std::vector<double>{});
}

TEST(Event, NumberOfWhatHappensIsThatOfTheList) {
  const std::vector<Event> events{{.time = 2.0}, {.time = 1.0}, {.time = 2.0}};
  const std::vector<Occurrence> all = occurrences(events, 0.0, 3.0);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].event, 1u);
  EXPECT_EQ(all[1].event, 0u);
  EXPECT_EQ(all[2].event, 2u);
}

TEST(Event, TooManyAreAnError) {
  EXPECT_THROW(times_of({{.time = 0.0, .period = 1e-9}}, 0.0, 1.0), ModelError);
}

TEST(Event, OneThatBeganTooLongAgoIsAnError) {
  for (const double first : {-1e17, -1e300})
    EXPECT_THROW(times_of({{.time = first, .period = 1.0}}, 0.0, 10.0), ModelError);
  EXPECT_EQ(times_of({{.time = -1e15, .period = 1.0}}, 0.0, 2.0),
            (std::vector<double>{0.0, 1.0, 2.0}));
  EXPECT_EQ(times_of({{.time = -1e300, .period = 1e300}}, 0.0, 10.0), std::vector<double>{0.0});
}

OdeModel model_with(Event event) {
  return parse_ode("dx/dt = -x\ndy/dt = x", "m.ode").with_events({std::move(event)});
}

TEST(ModelEvents, WhatIsNoEventIsAnError) {
  const std::vector<Reset> sets{{"x", Expression(0.0)}};
  EXPECT_NO_THROW(model_with({.time = 1.0, .resets = sets}));
  EXPECT_THROW(model_with({.time = 1.0}), ModelError);
  EXPECT_THROW(model_with({.resets = sets}), ModelError);
  EXPECT_THROW(model_with({.time = 1.0, .guard = kX, .resets = sets}), ModelError);
  EXPECT_THROW(model_with({.time = 1.0, .period = 0.0, .resets = sets}), ModelError);
  EXPECT_THROW(model_with({.time = 1.0, .resets = {{"q", kX}}}), ModelError);
  EXPECT_THROW(model_with({.time = 1.0, .resets = {{"x", Expression::variable("q")}}}),
               ModelError);
  EXPECT_THROW(model_with({.time = 1.0, .resets = {{"x", kX}, {"x", kX}}}), ModelError);
}

TEST(ModelEvents, StayWithTheModelAndAreRefusedWhereNothingIsMadeOfThem) {
  const OdeModel model = model_with({.time = 1.0, .resets = {{"y", kX}, {"x", kX}}});
  EXPECT_EQ(model.events()[0].resets[0].state, "x");
  EXPECT_EQ(model.with_equations(model.equations()).events(), model.events());
  EXPECT_EQ(model.with_initial(model.initial()).events(), model.events());
  EXPECT_THROW(check_no_events(model, "diagnose"), ModelError);
  EXPECT_NO_THROW(check_no_events(model.with_events({}), "diagnose"));
}

TEST(ModelEvents, MapsAndDelaysHaveNone) {
  EXPECT_THROW(parse_ode("x[n+1] = 0.5*x\nat 1: x = 0", "m.ode"), ModelError);
  EXPECT_THROW(parse_ode("dx/dt = -delay(x,1)\nat 1: x = 0", "m.ode"), ModelError);
  EXPECT_THROW(parse_ode("dx/dt = -x\nat 1: x = delay(x,1)", "m.ode"), ModelError);
}

TEST(NoiseLaw, WhatCannotBeIsSaid) {
  EXPECT_EQ(law_problem({}), "");
  EXPECT_NE(law_problem({.constant = 0.0}), "");
  EXPECT_NE(law_problem({.constant = std::numeric_limits<double>::infinity()}), "");
  EXPECT_NE(law_problem({.fraction = 0.1}), "");
  EXPECT_NE(law_problem({.form = NoiseForm::Both, .constant = 0.1}), "");
  EXPECT_NE(law_problem({.form = NoiseForm::Student, .freedom = 2.0}), "");
  EXPECT_NE(law_problem({.form = NoiseForm::Student, .below = 0.1}), "");
  EXPECT_NE(law_problem({.form = NoiseForm::LogNormal, .below = 0.0}), "");
  EXPECT_NE(law_problem({.form = NoiseForm::LogNormal, .above = 0.0}), "");
  EXPECT_NE(law_problem({.below = 2.0, .above = 1.0}), "");
  EXPECT_NE(law_problem({.truncated = true}), "");
  EXPECT_EQ(law_problem({.below = 1.0, .truncated = true}), "");
}

AdequacyPart part(Adequate fits) { return {"x", fits, 100, true}; }

TEST(Adequacy, AWholeFitsWhereAPartDoesAndNoneDoesNot) {
  using enum Adequate;
  EXPECT_EQ(adequacy_of({part(Yes), part(Undetermined)}).fits, Yes);
  EXPECT_EQ(adequacy_of({part(Yes), part(No), part(Undetermined)}).fits, No);
  EXPECT_EQ(adequacy_of({part(Undetermined)}).fits, Undetermined);
  EXPECT_EQ(adequacy_of({}).fits, Undetermined);
}

OdeModel of_two(const std::string& x, const std::string& y) {
  return parse_ode("dx/dt = " + x + "\ndy/dt = " + y + "\n", "test");
}

TEST(CompareModels, ErrorsAreRelativeToTheLargestCoefficientAndToTheNorm) {
  const ModelAccuracy off = compare_models(of_two("3.3*y", "-4*x"), of_two("3*y", "-4*x"));
  EXPECT_TRUE(off.exact_structure);
  EXPECT_NEAR(off.largest_error, 0.3 / 4.0, 1e-12);
  EXPECT_NEAR(off.relative_error, 0.3 / 4.0, 1e-12);  // norms of diagonal matrices
}

TEST(CompareModels, ATermTooManyOrTooFewIsAnotherStructure) {
  const OdeModel truth = of_two("3*y", "-4*x");
  const ModelAccuracy more = compare_models(of_two("3*y+0.4*x*y", "-4*x"), truth);
  EXPECT_FALSE(more.exact_structure);
  EXPECT_NEAR(more.largest_error, 0.1, 1e-12);
  const ModelAccuracy less = compare_models(of_two("0", "-4*x"), truth);
  EXPECT_FALSE(less.exact_structure);
  EXPECT_NEAR(less.largest_error, 0.75, 1e-12);
  EXPECT_FALSE(compare_models(of_two("3*x", "-4*x"), truth).exact_structure);
}

}  // namespace
}  // namespace lacuna
