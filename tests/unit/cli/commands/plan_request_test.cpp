// SPDX-License-Identifier: MIT
#include "cli/commands/plan_request.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cli/commands/assignments.hpp"
#include "cli/commands/limit_options.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "support/expect_error.hpp"
#include "unit/cli/commands/records.hpp"

namespace lacuna::cli {
namespace {

using lacuna::testing::expect_refused;
using testing::expect_error;

TEST(PlanInputText, HasARangeAndLimits) {
  const PlanInput input =
      plan_input("u = -5..5, rate 100, hold 0.01, family steps|prbs, pieces 12");
  EXPECT_EQ(input.name, "u");
  EXPECT_EQ(input.low, -5.0);
  EXPECT_EQ(input.high, 5.0);
  EXPECT_EQ(input.rate, 100.0);
  EXPECT_EQ(input.hold, 0.01);
  EXPECT_EQ(input.families, (std::vector<InputFamily>{InputFamily::Steps, InputFamily::Prbs}));
  EXPECT_EQ(input.pieces, 12);
  const PlanInput plain = plan_input("q=0..1e-3");
  EXPECT_EQ(plain.high, 1e-3);
  EXPECT_FALSE(plain.rate || plain.hold);
  EXPECT_TRUE(plain.families.empty());
}

TEST(PlanInputText, FaultsAreSaid) {
  expect_error<ConfigError>([] { plan_input("u"); }, "--input u", "NAME=", "u=-5..5");
  expect_error<ConfigError>([] { plan_input("u=5"); }, "--input u=5", "range", "u=-5..5");
  expect_error<ConfigError>([] { plan_input("u=0..x"); }, "--input u=0..x", "'x'", "-5..5");
  expect_error<ConfigError>([] { plan_input("u=0..1, rat 5"); }, "--input u=0..1, rat 5",
                            "'rat' is not known", "rate");
  expect_error<ConfigError>([] { plan_input("u=0..1, family step"); },
                            "--input u=0..1, family step", "no family 'step'", "steps");
  expect_error<ConfigError>([] { plan_input("u=0..1, pieces 0"); }, "--input u=0..1, pieces 0",
                            "1 to 200", "pieces");
  EXPECT_THROW(plan_input("u=0..inf"), ConfigError);
  EXPECT_THROW(plan_input("u=0..1, rate"), ConfigError);
}

TEST(PlanStartText, IsAValueARangeOrADeviation) {
  const PlanStart value = plan_start("x=0.5"), range = plan_start("x=-1..2"),
                  off = plan_start("x = 1 +- 0.2");
  EXPECT_EQ(value.low, 0.5);
  EXPECT_EQ(value.high, 0.5);
  EXPECT_EQ(value.deviation, 0.0);
  EXPECT_EQ(range.low, -1.0);
  EXPECT_EQ(range.high, 2.0);
  EXPECT_EQ(off.low, 1.0);
  EXPECT_EQ(off.deviation, 0.2);
  EXPECT_THROW(plan_start("x=a"), ConfigError);
}

TEST(SafeRangeText, MayBeOpen) {
  EXPECT_EQ(safe_range("x=-1..2").low, -1.0);
  EXPECT_TRUE(std::isinf(safe_range("x=..2").low));
  EXPECT_EQ(safe_range("x=..2").high, 2.0);
  EXPECT_THROW(safe_range("x=2"), ConfigError);
}

TEST(PlanChannelText, IsANameAndItsNoise) {
  EXPECT_EQ(plan_channel("y=0.02").noise, 0.02);
  EXPECT_EQ(plan_channel("y=0.02").name, "y");
  EXPECT_THROW(plan_channel("y"), ConfigError);
}

TEST(ModelsOfAnswer, AreThoseThatItLeavesPossible) {
  const std::string model =
      R"json({"format":"lacuna.model/1","states":[{"name":"w"}],"inputs":[{"name":"u"}],
          "equations":[{"state":"w","terms":[{"term":"u","coefficient":1},
          {"term":"sign(w)","coefficient":-0.4}]}]})json";
  const PlanModels diagnosed = models_of_answer(
      R"json({"format":"lacuna.diagnosis/1","augmented_model":)json" + model +
          R"json(,"effects":[{"equation":"w","name":"coulomb-friction","term":"sign(w)",
             "alternatives":[{"name":"quadratic-drag","term":"w*abs(w)",
             "probability":0.02}]}]})json",
      "d.json");
  ASSERT_EQ(diagnosed.models.size(), 2u);
  EXPECT_EQ(diagnosed.models[0].name, "coulomb-friction");
  EXPECT_EQ(diagnosed.models[1].name, "quadratic-drag");
  EXPECT_EQ(diagnosed.models[1].weight, 0.02);
  EXPECT_TRUE(diagnosed.has_unfitted);
  EXPECT_EQ(diagnosed.models[1].system.symbolic().coefficient(0, "w*abs(w)"), -0.4);
  EXPECT_EQ(diagnosed.models[1].system.symbolic().coefficient(0, "sign(w)"), 0.0);
  const PlanModels fitted = models_of_answer(
      R"json({"format":"lacuna.fit/1","model":)json" + model +
          R"json(,"fit":[{"channel":"w","rmse":0.25},{"channel":"y","rmse":null}]})json",
      "f.json");
  ASSERT_EQ(fitted.models.size(), 1u);
  ASSERT_EQ(fitted.channels.size(), 1u);
  EXPECT_EQ(fitted.channels[0].noise, 0.25);
  const PlanModels identified = models_of_answer(
      R"json({"format":"lacuna.identification/1","library_alone":null,
              "noise":{"w":0.1},"model":)json" +
          model + "}",
      "i.json");
  ASSERT_EQ(identified.models.size(), 1u);
  ASSERT_EQ(identified.channels.size(), 1u);
}

TEST(ModelsOfAnswer, OthersAreErrors) {
  expect_error<ConfigError>(
      [] { models_of_answer("{\"format\":\"lacuna.sync/1\"}", "s.json"); }, "--after s.json",
      "lacuna.sync/1", "diagnose");
  expect_error<ConfigError>([] { models_of_answer("t,x\n1,2\n", "r.csv"); },
                            "--after r.csv:1:2", "no answer as JSON", "--json");
}

constexpr AssignmentForm kForm{"--map", "NAME=COLUMN", "--map th=Winkel"};

TEST(Assignments, NameBothWhereOneIsGivenTwice) {
  testing::expect_error<ConfigError>(
      [] {
        read_assignments(kForm, {"a=1,b=2", "a=3"});
      },
      "--map a=3", "'a' is given twice, first in 'a=1'", "keep");
  testing::expect_error<ConfigError>([] { read_assignments(kForm, {"a=1,a=1"}); }, "--map a=1",
                                     "twice", "keep one");
}

Dataset two_channels() {
  Dataset data;
  data.states = {{"q", "V"}, {"v", ""}};
  Trajectory record;
  record.time = Vector{{0.0, 1.0, 2.0}};
  record.states = Matrix{{-6.0, 9.0}, {0.0, 9.0}, {5.0, 9.0}};
  data.trajectories = {std::move(record)};
  return data;
}

TEST(WithGivenLimits, MarksWhatLiesThereOrBeyond) {
  const Dataset data = with_given_limits(two_channels(), {"q=-5:5"});
  const Trajectory& record = data.trajectories[0];
  EXPECT_EQ(mark_of(record.marks, 0, 0), Mark::AtBottom);
  EXPECT_EQ(record.states(0, 0), -5.0);
  EXPECT_EQ(mark_of(record.marks, 2, 0), Mark::AtTop);
  EXPECT_EQ(mark_of(record.marks, 2, 1), Mark::Value) << "no limits were given";
}

TEST(WithGivenLimits, AnEndMayBeMissing) {
  const Dataset data = with_given_limits(two_channels(), {"q=:5", "v=8:"});
  EXPECT_EQ(mark_of(data.trajectories[0].marks, 0, 0), Mark::Value);
  EXPECT_EQ(mark_of(data.trajectories[0].marks, 2, 0), Mark::AtTop);
  EXPECT_EQ(with_given_limits(two_channels(), {}).trajectories[0].marks.size(), 0);
}

TEST(WithGivenLimits, SaysWhatIsNotARange) {
  for (const char* text : {"q", "q=5", "q=a:5", "q=5:-5", "z=1:2"})
    EXPECT_THROW(with_given_limits(two_channels(), {text}), ConfigError) << text;
}

// What a command line is refused with.
TEST(Faults, NoWordIsOfTheParser) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> faults = {
      {{"identify", "r", "--effort", "QUICK"},
       "--effort: 'QUICK' is none of full, normal, quick"},
      {{"identify", "r", "--degree", "abc"}, "--degree: 'abc' is no number"},
      {{"identify", "r", "--degree", "1.5"}, "--degree: '1.5' is no whole number"},
      {{"identify", "r", "--threads", "0"}, "--threads: '0' is no number from 1 to 1024"},
      {{"identify", "r", "--discrete=maybe"}, "--discrete takes no value"},
      {{"identify", "r", "--json"}, "--json: the value is missing"},
      {{"identify", "r", "--json", "a", "--json", "b"}, "--json: 2 values are given; keep one"},
      {{"identify", "r", "--terms", "x", "--degree", "2"}, "exclude each other"},
      {{"identify"}, "DATA is missing"},
      {{}, "no command is given"},
      {{"identfy"}, "did you mean 'identify'"},
      {{"report"}, "'report' is an option, as in `lacuna "},
      {{"simulate", "lorenz", "--t-end", "nan", "--dt", "1"}, "'nan' is no finite number"},
      {{"identify", "r", "--degre", "2"}, "'--degre' is not known; did you mean '--degree'?"}};
  for (const auto& [words, sentence] : faults)
    expect_refused(words, {"command line: ", sentence, "--help`"});
}

}  // namespace
}  // namespace lacuna::cli
