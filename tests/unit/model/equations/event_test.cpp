// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/event.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
