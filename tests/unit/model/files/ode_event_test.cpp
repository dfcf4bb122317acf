// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "model/files/event_text.hpp"

namespace lacuna {
namespace {

constexpr const char* kEvents = R"(time h
input u
state gut
state x
param ka = 1.1 */ 1.5
param k = 0.2 +- 0.05
param V = 5 +- 1 varies */ 1.5 [L] in 0..
param s = 0.5 varies +- 0.1
param D = 100 fixed
dgut/dt = -gut*ka
dx/dt = gut*ka - x*k + u
y = x/10 [mg/L] noise both 0.1 0.05 below 0.2
z = x noise student 5
w = x+gut noise lognormal above 50
v = x noise constant truncated below 1 above 9
initial gut = 0 at 0 fixed
at 2: gut += D
every 12 from 6 until 96: gut += D*u, x *= 0.5
when x > 2*k: gut = min(gut,x), x -= 1
)";

TEST(OdeEvent, GivesBackWhatWasWritten) {
  EXPECT_EQ(format_ode(parse_ode_system(kEvents, "m.ode")), kEvents);
}

TEST(OdeEvent, JsonAndBackIsTheSameModel) {
  const SystemModel system = parse_ode_system(kEvents, "m.ode");
  const SystemModel again = parse_system(format_model(system), "m.json");
  EXPECT_EQ(format_ode(again), kEvents);
  EXPECT_EQ(again.symbolic().events(), system.symbolic().events());
}

TEST(OdeEvent, NumbersOfParametersGoIntoEvents) {
  const OdeModel model = parse_ode(kEvents, "m.ode");
  ASSERT_EQ(model.events().size(), 3u);
  EXPECT_EQ(to_text(model.events()[0].resets[0]), "gut += 100");
  EXPECT_EQ(occasion_text(model.events()[2]), "when x > 2*0.2");
}

TEST(OdeEvent, ConditionIsTheSameFromBothSides) {
  const auto events = [](const std::string& line) {
    return parse_ode("dx/dt = -x\ndy/dt = x\n" + line, "m.ode").events();
  };
  EXPECT_EQ(events("when x < y: x = 1"), events("when y > x: x = 1"));
  EXPECT_EQ(events("when x >= y: x = 1"), events("when x > y: x = 1"));
  EXPECT_EQ(events("every 3: x += 1"), events("every 3 from 0: x += 1"));
  EXPECT_EQ(events("at 2*3: x += 1"), events("at 6: x = x+1"));
}

/// Any list of events that a text may have is read, printed and read again to the same.
TEST(OdeEvent, RoundTripOfRandomEvents) {
  std::mt19937 random(7);
  const auto pick = [&](std::initializer_list<const char*> words) {
    return std::string(words.begin()[random() % words.size()]);
  };
  for (int i = 0; i < 200; ++i) {
    std::string text = "param c = 2\ndx/dt = -c*x\ndy/dt = x - y\n";
    for (int k = 0; k < 3; ++k) {
      const std::string occasion =
          pick({"at 3", "at -1.5e-3", "every 0.1", "every 7 from -2 until 1e3", "when x > c",
                "when sin(x)*y < max(c,t)-1", "when t >= 4"});
      const std::string right = pick({"1", "-y", "c*x", "clip(x,0,c)", "x+y-(c-t)", "x^2/(1+y)"});
      text += occasion + ": x " + pick({"=", "+=", "-=", "*="}) + " " + right +
              pick({"", ", y = x", ", y += min(x,y)"}) + "\n";
    }
    const SystemModel system = parse_ode_system(text, "m.ode");
    const std::string printed = format_ode(system);
    const SystemModel again = parse_ode_system(printed, "m.ode");
    EXPECT_EQ(format_ode(again), printed) << text;
    EXPECT_EQ(again.symbolic().events(), system.symbolic().events()) << text;
    EXPECT_EQ(parse_system(format_model(system), "m.json").symbolic().events(),
              system.symbolic().events())
        << text;
  }
}

void expect_error(const std::string& line, const std::string& place,
                  const std::string& problem) {
  try {
    parse_ode_system("param c = 2\ndx/dt = -c*x\n" + line, "m.ode");
    FAIL() << line;
  } catch (const ModelError& error) {
    EXPECT_NE(error.where().find(place), std::string::npos) << error.where() << " " << line;
    EXPECT_NE(error.problem().find(problem), std::string::npos) << error.problem();
  }
}

TEST(OdeEvent, ErrorsHavePlaces) {
  expect_error("at 3 x = 1", "m.ode:3", "':' is missing");
  expect_error("at 3: 1", "m.ode:3:7", "no reset");
  expect_error("at 3: q = 1", "m.ode:3", "no state");
  expect_error("at 3: x = q", "m.ode:3:11", "unknown name 'q'");
  expect_error("at c: x = 1", "m.ode:3:4", "cannot be estimated");
  expect_error("every 0: x = 1", "m.ode:3", "not above 0");
  expect_error("when x: x = 1", "m.ode:3:6", "no condition");
  expect_error("when 1 < x < 2: x = 1", "m.ode:3:6", "no condition");
  expect_error("y = x noise loud", "m.ode:3", "");
  expect_error("y = x noise constant truncated", "m.ode:3", "no limit");
  expect_error("y = x noise both 1", "m.ode:3", "both sizes");
  expect_error("param k = 1 */ 0.5", "m.ode:3", "not above 1");
  expect_error("param k = -1 */ 2", "m.ode:3", "not above 0");
  expect_error("param k = 1 varies 2", "m.ode:3:20", "no spread behind 'varies'");
  expect_error("param k = 1 varies */ 1", "m.ode:3", "factor by which it varies is not above 1");
  expect_error("param k = 1 varies +- 0", "m.ode:3", "by which it varies is not above 0");
  expect_error("param k = -1 varies */ 2", "m.ode:3", "not above 0, but it varies by a factor");
  expect_error("param k = 1 varies */ 2 fixed", "m.ode:3", "what is fixed does not vary");
  expect_error("param k = 1 varies */ 2 per_record", "m.ode:3", "varies and is per_record");
}

TEST(OdeEvent, ASpreadMayStandBehindTheUnit) {
  const SystemModel system =
      parse_ode_system("param k = 2 [1/h] varies */ 1.5 in 0..\ndx/dt = -k*x", "m.ode");
  ASSERT_TRUE(system.parameters()[0].varies);
  EXPECT_TRUE(system.parameters()[0].varies->by_factor);
  EXPECT_EQ(system.parameters()[0].varies->size, 1.5);
  EXPECT_EQ(format_ode(system),
            "time s\nstate x\nparam k = 2 varies */ 1.5 [1/h] in 0..\ndx/dt = -x*k\n");
}

TEST(OdeEvent, ASpreadInJsonIsADeviationOrAFactor) {
  for (const std::string spread : {"{}", "{\"factor\": 2, \"deviation\": 1}"})
    try {
      parse_system("{\"format\": \"lacuna.model/1\", \"states\": [{\"name\": \"x\"}], "
                   "\"equations\": [{\"state\": \"x\", \"terms\": []}], \"parameters\": "
                   "[{\"name\": \"k\", \"value\": 1, \"varies\": " + spread + "}]}",
                   "m.json");
      ADD_FAILURE() << spread;
    } catch (const Error& error) {
      EXPECT_NE(error.problem().find("neither a deviation nor a factor"), std::string::npos)
          << error.problem();
    }
}

TEST(OdeEvent, WordsMayBeNames) {
  const OdeModel model = parse_ode("dx/dt = -x\nat = x\nevery = 2*x\nwhen = 3*x\nnoise = x+1",
                                   "m.ode");
  EXPECT_EQ(model.outputs().size(), 4u);
  EXPECT_TRUE(model.events().empty());
}

}  // namespace
}  // namespace lacuna
