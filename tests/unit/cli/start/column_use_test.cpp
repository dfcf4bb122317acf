// SPDX-License-Identifier: MIT
#include "cli/start/column_use.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "cli/start/skeleton.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A state x, a step s, what a controller puts out every fourth sample, and twice x + 1.
Dataset record() {
  constexpr Index kRows = 240;
  Dataset data;
  for (const char* name : {"x", "s", "pwm", "scaled"}) data.states.push_back({name, ""});
  Trajectory run;
  run.time = Vector::LinSpaced(kRows, 0.0, 2.39);
  run.states.resize(kRows, 4);
  run.inputs.resize(kRows, 0);
  for (Index i = 0; i < kRows; ++i) {
    const double x = std::sin(0.37 * static_cast<double>(i));
    run.states.row(i) << x, i < 100 ? 0.0 : 1.0,
        std::cos(2.1 * static_cast<double>(i / 4)), 2.0 * x + 1.0;
  }
  data.trajectories.push_back(run);
  return data;
}

TEST(ColumnUse, SamplesProposeIt) {
  const RecordUse use = proposed_use(record());
  EXPECT_THAT(columns_with(use, ColumnUse::State), ElementsAre("x"));
  EXPECT_THAT(columns_with(use, ColumnUse::Input), ElementsAre("s", "pwm"));
  EXPECT_THAT(columns_with(use, ColumnUse::LeftOut), ElementsAre("scaled"));
  EXPECT_THAT(use.columns[3].reason, HasSubstr("scaled follows from x"));
}

TEST(ColumnUse, OneStateIsLeft) {
  Dataset data = record();
  data.states.resize(1);
  data.trajectories[0].states = data.trajectories[0].states.col(1).eval();
  EXPECT_THAT(columns_with(proposed_use(data), ColumnUse::State), ElementsAre("x"));
}

TEST(ColumnUse, ColumnsThatAreInputsAlreadyStaySo) {
  Dataset data = record();
  data.inputs.push_back({"u", "V"});
  data.trajectories[0].inputs = Matrix::Ones(data.trajectories[0].samples(), 1);
  const RecordUse use = proposed_use(data);
  EXPECT_EQ(use.columns.back().quantity.unit, "V");
  EXPECT_EQ(use.columns.back().use, ColumnUse::Input);
}

TEST(ColumnUse, AnswersCount) {
  std::ostringstream out;
  // unit of time, wrong once; x with a unit that is none first; s left out; pwm a state; scaled
  std::istringstream in("parsecs\nms\n\na]b\nm/s\nleave out\nstate\nV\ninput\n\n");
  Questions questions(out, &in);
  const RecordUse use = asked_use(proposed_use(record()), questions);
  EXPECT_EQ(use.time_unit, "ms");
  EXPECT_THAT(columns_with(use, ColumnUse::State), ElementsAre("x", "pwm"));
  EXPECT_THAT(columns_with(use, ColumnUse::Input), ElementsAre("scaled"));
  EXPECT_THAT(columns_with(use, ColumnUse::LeftOut), ElementsAre("s"));
  EXPECT_EQ(use.columns[0].quantity.unit, "m/s");
  EXPECT_EQ(use.columns[2].quantity.unit, "V");
  EXPECT_EQ(use.columns[3].quantity.unit, "");
  EXPECT_THAT(out.str(), HasSubstr("parsecs"));
}

TEST(ColumnUse, AStateIsNeeded) {
  std::ostringstream out;
  std::istringstream in("\ninput\n\ninput\n\ninput\n\ninput\n\n");
  Questions questions(out, &in);
  EXPECT_THROW(asked_use(proposed_use(record()), questions), ConfigError);
}

RecordUse use() {
  return {"ms",
          {{{"x", "m"}, ColumnUse::State},
           {{"u", "V"}, ColumnUse::Input},
           {{"sum", ""}, ColumnUse::LeftOut},
           {{"v", ""}, ColumnUse::State}}};
}

TEST(Skeleton, IsAModelWithTheColumnsAndNothingElse) {
  const OdeModel model = parse_ode(skeleton_of(use(), "folder/run.csv"), "skeleton");
  ASSERT_EQ(model.dimension(), 2);
  EXPECT_EQ(model.states()[0], (Quantity{"x", "m"}));
  EXPECT_EQ(model.states()[1], (Quantity{"v", ""}));
  ASSERT_EQ(model.inputs().size(), 1u);
  EXPECT_EQ(model.inputs()[0], (Quantity{"u", "V"}));
  EXPECT_EQ(model.time_unit(), "ms");
  for (const Equation& equation : model.equations()) EXPECT_THAT(equation, IsEmpty());
}

TEST(Skeleton, ItsExamplesCanBeUncommented) {
  std::string text = skeleton_of(use(), "run.csv");
  EXPECT_THAT(text, HasSubstr("# Skeleton of a model for run.csv\n"));
  const std::string zero = "dx/dt = 0\n";
  ASSERT_THAT(text, HasSubstr(zero));
  text.erase(text.find(zero), zero.size());
  for (std::size_t at = text.find("#   "); at != std::string::npos; at = text.find("#   "))
    text.erase(at, 4);
  const SystemModel system = parse_ode_system(text, "uncommented");
  ASSERT_EQ(system.parameters().size(), 1u);
  EXPECT_EQ(system.model().coefficient(0, "u"), 1.0);
}

/// A file's name is somebody else's text.
TEST(Skeleton, NoNameOfAFileBecomesAStatement) {
  const OdeModel model = parse_ode(skeleton_of(use(), "a\ndx/dt = 1\r\u202e.csv"), "skeleton");
  EXPECT_THAT(model.equations()[0], IsEmpty());
}

TEST(Skeleton, FlagsSayWhatACommandDoesNotTakeByItself) {
  EXPECT_THAT(column_flags(use()), ElementsAre("--states", "x,v", "--inputs", "u"));
  const RecordUse plain{"s", {{{"x", ""}, ColumnUse::State}}};
  EXPECT_THAT(column_flags(plain), IsEmpty());
  EXPECT_THAT(column_flags(plain, false), ElementsAre("--states", "x"));
}

}  // namespace
}  // namespace lacuna::cli
