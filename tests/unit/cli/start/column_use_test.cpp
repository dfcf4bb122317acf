// SPDX-License-Identifier: MIT
#include "cli/start/column_use.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "lacuna/core/base/error.hpp"

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

}  // namespace
}  // namespace lacuna::cli
