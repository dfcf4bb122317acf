// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna {
namespace {

using testing::expect_error;

constexpr const char* kTanks = R"(# two tanks
time min
input u [V] hold zero

state x2 [V]      # named first
param k1 = 0.05 [1/s] in 0..1
param k4 = k1*2/4 fixed
param T = 0.5
dx1/dt = -k1*sqrt(x1) + k4*u
dx2/dt = k1*sqrt(x1) - 0.05*sqrt(x2) + delay(u,2*T)
)";

TEST(OdeText, StatementsMakeAModel) {
  const OdeModel model = parse_ode(kTanks, "tanks.ode");
  EXPECT_EQ(model.time_unit(), "min");
  ASSERT_EQ(model.dimension(), 2);
  EXPECT_EQ(model.states()[0].name, "x2");
  EXPECT_EQ(model.states()[0].unit, "V");
  EXPECT_EQ(model.states()[1].name, "x1");
  ASSERT_EQ(model.inputs().size(), 1u);
  EXPECT_EQ(model.inputs()[0].unit, "V");
  EXPECT_EQ(model.inputs()[0].hold, Hold::Zero);
  EXPECT_EQ(model.coefficient(1, "sqrt(x1)"), -0.05);
  EXPECT_EQ(model.coefficient(1, "u"), 0.025);
  EXPECT_EQ(model.coefficient(0, "delay(u,1)"), 1.0);
}

TEST(OdeText, OutputsAndStartsAreParts) {
  const OdeModel model = parse_ode(
      "state x [m]\ny = abs(x)*2 [V]\nz = x\ninitial x = 2*3 [m] deviation 1/4\n"
      "dx/dt = -x",
      "m.ode");
  ASSERT_EQ(model.outputs().size(), 2u);
  EXPECT_EQ(model.outputs()[0].name, "y");
  EXPECT_EQ(model.outputs()[0].unit, "V");
  EXPECT_EQ(model.outputs()[0].formula.to_string(), "abs(x)*2");
  EXPECT_FALSE(state_of(model, model.outputs()[0]).has_value());
  EXPECT_EQ(state_of(model, model.outputs()[1]), 0);
  EXPECT_EQ(model.initial()[0]->value, 6.0);
  EXPECT_EQ(model.initial()[0]->deviation, 0.25);
  EXPECT_FALSE(model.initial()[0]->fixed);
  EXPECT_FALSE(model.equations()[0][0].fixed) << "there are no parameters";
}

TEST(OdeText, WindowsLineEndsAreReadToo) {
  EXPECT_EQ(parse_ode("state x [m]\r\ndx/dt = -x\r\n", "a.ode").coefficient(0, "x"), -1.0);
}

TEST(OdeText, LatinLettersInUnitsBecomeUtf8) {
  EXPECT_EQ(parse_ode("state x [\xb5m]\ndx/dt = 1\n", "a.ode").states()[0].unit, "\xc2\xb5m");
}

TEST(OdeText, FilesThatEndInOdeAreText) {
  const testing::TemporaryFolder place;
  const std::string path = place.write("tanks.ode", kTanks);
  const OdeModel model = read_model(path);
  write_model(place.file("again.ode"), model);
  write_model(place.file("again.json"), model);
  EXPECT_EQ(format_ode(read_model(place.file("again.ode"))), format_ode(model));
  EXPECT_EQ(format_model(read_model(place.file("again.json"))), format_model(model));
}

struct Wrong {
  const char* text;
  const char* place;
  const char* problem;
};

class OdeTextErrors : public ::testing::TestWithParam<Wrong> {};

TEST_P(OdeTextErrors, HaveLineAndColumn) {
  try {
    parse_ode(GetParam().text, "m.ode");
    FAIL() << "read without an error";
  } catch (const ModelError& error) {
    EXPECT_EQ(error.where(), GetParam().place);
    EXPECT_THAT(error.problem(), ::testing::HasSubstr(GetParam().problem));
    EXPECT_FALSE(error.remedy().empty());
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, OdeTextErrors,
    ::testing::Values(Wrong{"", "m.ode", "no equations"},
                      Wrong{"dx/dt = -x +", "m.ode:1:13", "ends too early"},
                      Wrong{"\ndx/dt = -x\ndy/dt = 2*q*x", "m.ode:3:11", "unknown name 'q'"},
                      Wrong{"param k = q\ndx/dt = k", "m.ode:1:11", "unknown name 'q'"},
                      Wrong{"param k = t\ndx/dt = k", "m.ode:1:11", "no finite number"},
                      Wrong{"dx/dt = 1\ndx/dt = 2", "m.ode:2:9", "twice, first in line 1"},
                      Wrong{"input x\ndx/dt = 1", "m.ode:2:6", "given twice"},
                      Wrong{"state x\ndy/dt = 1", "m.ode", "'x' has no equation"},
                      Wrong{"input u hold firmly\ndx/dt = u", "m.ode:1:20", "'firmly'"},
                      Wrong{"input u [V\ndx/dt = u", "m.ode:1:9", "the unit has no end"},
                      Wrong{"input u [V\x1b[0m]\ndx/dt = u", "m.ode:1:11", "U+001B"},
                      Wrong{"input u V\ndx/dt = u", "m.ode:1:9", "nothing more belongs"},
                      Wrong{"dx/dt -x", "m.ode:1:7", "'=' is missing"},
                      Wrong{"y = 2*q\ndx/dt = 1", "m.ode:1:7", "unknown name 'q'"},
                      Wrong{"y = x\ny = 2*x\ndx/dt = 1", "m.ode:2:5", "given twice"},
                      Wrong{"x = 2*x\ndx/dt = 1", "m.ode:1:5", "a state has the same name"},
                      Wrong{"input y\ny = x\ndx/dt = y", "m.ode:2:5", "given twice"},
                      Wrong{"y = delay(x,1)\ndx/dt = 1", "m.ode:1:5", "cannot be delayed"},
                      Wrong{"initial z = 0\ndx/dt = 1", "m.ode:1:8", "no state 'z'"},
                      Wrong{"initial x = q\ndx/dt = 1", "m.ode:1:13", "unknown name 'q'"},
                      Wrong{"initial x = 0 deviation 0\ndx/dt = 1", "m.ode:1:8", "above 0"},
                      Wrong{"initial x = 0\ninitial x = 1\ndx/dt = 1", "m.ode:2:8",
                            "given twice"},
                      Wrong{"param k = 2 in 3..4\ndx/dt = k", "m.ode:1:10", "not in its range"},
                      Wrong{"param k = 2 in 4..3\ndx/dt = k", "m.ode:1:10", "upside down"},
                      Wrong{"fixed dx/dt: u\ndx/dt = 1", "m.ode:1:14", "unknown name 'u'"},
                      Wrong{"fixed dx/dt: x\ndx/dt = 1", "m.ode:1:14", "no term 'x'"},
                      Wrong{"fixed x: 1\ndx/dt = 1", "m.ode:1:8", "is no dNAME/dt"},
                      Wrong{"hello\ndx/dt = 1", "m.ode:1:6", "begins no statement"},
                      Wrong{"state sin\ndx/dt = 1", "m.ode:1:7", "word of the formula"},
                      Wrong{"param k = 1 in 3\ndx/dt = k", "m.ode:1:17", "no '..'"},
                      Wrong{"dx/dt = x/0", "m.ode:1:9", "not finite"}));

INSTANTIATE_TEST_SUITE_P(
    GivenTwice, OdeTextErrors,
    ::testing::Values(
        Wrong{"time s\ndx/dt = 1\ntime ms", "m.ode:3:5",
              "time unit is given twice, first in line 1"},
        Wrong{"time s\ntime s\ndx/dt = 1", "m.ode:2:5", "first in line 1"},
        Wrong{"state x [m]\nstate x [V]\ndx/dt = 1", "m.ode:2:8", "first in line 1"},
        Wrong{"dx/dt = 1\nstate x\nstate x", "m.ode:3:8", "first in line 2"},
        Wrong{"param k = 1\n\nparam k = 2\ndx/dt = k", "m.ode:3:8", "first in line 1"},
        Wrong{"input u\ninput u\ndx/dt = u", "m.ode:2:8", "first in line 1"},
        Wrong{"dx/dt = x\nfixed dx/dt: x\nfree dx/dt: x", "m.ode:3:13", "first in line 2"},
        Wrong{"dx/dt = x\nfree dx/dt: x\nfree dx/dt: x", "m.ode:3:13", "first in line 2"}));

INSTANTIATE_TEST_SUITE_P(
    Characters, OdeTextErrors,
    ::testing::Values(Wrong{"time s\rint evil = 42; //\ndx/dt = 1", "m.ode:1:7", "U+000D"},
                      Wrong{"dx/dt = 1 # a\rdx/dt = 2", "m.ode:1:14", "U+000D"},
                      Wrong{"# \xE2\x80\xAE turned\ndx/dt = 1", "m.ode:1:3", "U+202E"},
                      Wrong{"dx/dt = 1 #\xE2\x80\xA8 dy/dt = 1", "m.ode:1:12", "U+2028"},
                      Wrong{"state x [V\xE2\x81\xA6]\ndx/dt = 1", "m.ode:1:11", "U+2066"},
                      Wrong{"state x [\xE2\x84\xA6]\ndx/dt = 1", "m.ode:1:10", "U+2126"},
                      Wrong{"time \xE2\x84\xAA\ndx/dt = 1", "m.ode:1:6", "U+212A"},
                      Wrong{"state x [a[b]\ndx/dt = 1", "m.ode:1:11", "U+005B"},
                      Wrong{"time s]\ndx/dt = 1", "m.ode:1:7", "U+005D"},
                      Wrong{"dx/dt = 1\n\xEF\xBB\xBFstate x", "m.ode:2:1", "U+FEFF"}));

TEST(OdeText, AByteOrderMarkIsReadOver) {
  EXPECT_EQ(parse_ode("\xEF\xBB\xBF"
                      "time ms\ndx/dt = 1\n",
                      "m.ode")
                .time_unit(),
            "ms");
}

TEST(OdeText, UnitsOfCountsMayHaveAHash) {
  const OdeModel model =
      parse_ode("time [#]  # of the sample\nstate x [#/cm3] # of [all]\ndx/dt = 1", "m.ode");
  EXPECT_EQ(model.time_unit(), "#");
  EXPECT_EQ(model.states()[0].unit, "#/cm3");
  EXPECT_EQ(format_ode(parse_ode(format_ode(model), "again")), format_ode(model));
}

TEST(OdeText, WordsOfStatementsAreNamesToo) {
  const OdeModel model = parse_ode(
      "dinput/dt = in\ndin/dt = -fixed\ndfixed/dt = 0\ntime = 2*in [V]\nparam = in + fixed\n"
      "state = input\ninitial = 2*deviation\nddeviation/dt = 1\n",
      "m.ode");
  EXPECT_EQ(model.coefficient(0, "in"), 1.0);
  ASSERT_EQ(model.outputs().size(), 4u);
  EXPECT_EQ(model.outputs()[0].name, "time");
  EXPECT_EQ(model.outputs()[0].formula.to_string(), "2*in");
  EXPECT_EQ(model.time_unit(), "s");
  EXPECT_EQ(format_ode(parse_ode(format_ode(model), "again")), format_ode(model));
}

TEST(OdeText, TermsThatAreOneWithNumbersForParametersAreAdded) {
  const SystemModel system = parse_ode_system(
      "input u\nparam R1 = 10 fixed\nparam R2 = 10 fixed\nparam C = 2\n"
      "dv/dt = u/(R1*C) - v/(R1*C) - v/(R2*C) + u/(R2*C)\n",
      "m.ode");
  EXPECT_EQ(system.symbolic().equations()[0].size(), 4u) << "as they are written";
  const ParametrisedModel model = system.parametrised();
  ASSERT_EQ(model.symbolic().equations()[0].size(), 2u);
  EXPECT_EQ(model.symbolic().coefficient(0, "v*10^-1*C^-1"), -2.0);
  EXPECT_EQ(model.symbolic().coefficient(0, "u*10^-1*C^-1"), 2.0);
  EXPECT_EQ(system.places_in_parametrised()[0], (std::vector<Index>{0, 1, 1, 0}));
  // In brackets they are when numbers stand for all parameters.
  const OdeModel plain = parse_ode_system(
                             "input u\nparam R = 10\nparam C = 2\n"
                             "dv/dt = (u - v)/(R*C) - (v - u)/(10*C)\n",
                             "m.ode")
                             .model();
  EXPECT_DOUBLE_EQ(plain.coefficient(0, "u"), 0.1);
  EXPECT_DOUBLE_EQ(plain.coefficient(0, "v"), -0.1);
}

TEST(OdeText, ASumHasAnyNumberOfSummands) {
  std::string text = "dx/dt = 0";
  for (int i = 1; i <= 2000; ++i) text += " - sin(" + std::to_string(i) + "*x)";
  const OdeModel model = parse_ode(text + "\n", "m.ode");
  EXPECT_EQ(model.equations()[0].size(), 2000u);
  EXPECT_EQ(model.coefficient(0, "sin(7*x)"), -1.0);
  EXPECT_EQ(format_model(parse_ode(format_ode(model), "again")), format_model(model));
}

TEST(OdeText, WhatIsKnownBeforehand) {
  const SystemModel system = parse_ode_system(
      "param a = 1.1 +- 0.3 [1/h] in 0.1..10\nparam b = 2+-0.5 per_record\n"
      "dx/dt = -a*x\ndy/dt = a*x - b*y\ninitial x = 100 at -0.25 fixed\n"
      "initial y = 1 [mg] at -1/4 +- 0.5\n",
      "m.ode");
  const Parameter &a = system.parameters()[0], &b = system.parameters()[1];
  EXPECT_EQ(a.value, 1.1);
  EXPECT_EQ(a.deviation, 0.3);
  EXPECT_EQ(a.unit, "1/h");
  EXPECT_EQ(a.max, 10.0);
  EXPECT_EQ(b.value, 2.0);
  EXPECT_EQ(b.deviation, 0.5);
  EXPECT_TRUE(b.per_record);
  const auto priors = system.parametrised().priors();
  ASSERT_EQ(priors.size(), 2u);
  ASSERT_TRUE(priors[0]);
  EXPECT_EQ(priors[0]->tolerance, 0.3);
  EXPECT_EQ(system.symbolic().initial_time(), -0.25);
  EXPECT_TRUE(system.symbolic().initial()[0]->fixed);
  EXPECT_EQ(system.symbolic().initial()[1]->deviation, 0.5);
  EXPECT_EQ(format_model(parse_ode_system(format_ode(system), "again")), format_model(system));
  EXPECT_EQ(format_ode(parse_system(format_model(system), "again")), format_ode(system));
}

TEST(OdeText, WhatIsKnownBeforehandIsChecked) {
  const auto parse = [](const char* text) { parse_ode(text, "m.ode"); };
  expect_error<ModelError>([&] { parse("param a = 1 +- 0\ndx/dt = -a*x\n"); }, "m.ode:1:10",
                           "deviation is not above 0", "deviation");
  expect_error<ModelError>([&] { parse("param a = 1 +- 2 fixed\ndx/dt = -a*x\n"); },
                           "m.ode:1:10", "what is fixed has no deviation", "deviation");
  expect_error<ModelError>(
      [&] {
        parse("dx/dt = -x\ndy/dt = x\ninitial x = 1 at 0\ninitial y = 1 at 1\n");
      },
      "initial values", "two times, 0 and 1", "same time");
}

constexpr const char* kMap = R"(time s
state x
state y
param a = 1.4
x[n+1] = 1 + y - a*x^2
y[n+1] = 0.3*x
fixed x[n+1]: x^2*a
)";

TEST(OdeText, NextValuesMakeAMap) {
  const SystemModel system = parse_ode_system(kMap, "m.ode");
  const OdeModel model = system.model();
  EXPECT_TRUE(model.is_map());
  EXPECT_EQ(model.coefficient(0, "x^2"), -1.4);
  EXPECT_THAT(format_ode(system), ::testing::HasSubstr("\nx[n+1] = 1 + y - "));
  const SystemModel again = parse_ode_system(format_ode(system), "again");
  EXPECT_EQ(format_ode(again), format_ode(system));
  EXPECT_EQ(format_model(parse_system(format_model(system), "again")), format_model(system));
  EXPECT_TRUE(parse_system(format_model(system), "again").model().is_map());
}

TEST(OdeText, AModelIsAFlowOrAMap) {
  const auto parse = [](const char* text) { parse_ode(text, "m.ode"); };
  expect_error<ModelError>([&] { parse("x[n+1] = y\ndy/dt = x\n"); }, "m.ode:2:6",
                           "either a flow", "alike");
  expect_error<ModelError>([&] { parse("x[n+1] = delay(x,1)\n"); }, "model", "delay(x,1)",
                           "a state");
  expect_error<ModelError>([&] { parse("fixed x[n+1]: x^3\nx[n+1] = x\n"); }, "m.ode:1:15",
                           "x[n+1] has no term 'x^3'", "lacuna model");
}

}  // namespace
}  // namespace lacuna
