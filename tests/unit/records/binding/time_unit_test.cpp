// SPDX-License-Identifier: MIT
#include "records/binding/time_unit.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

OdeModel model_in(const std::string& unit) { return OdeModel({{"x", ""}}, {}, {{}}, unit); }

Dataset record_in(const std::string& unit) {
  Dataset data;
  data.time_unit = unit;
  data.states = {{"x", ""}};
  data.trajectories = {{"run.csv, record 2", Vector{{0.0, 30.0}}, Matrix::Zero(2, 1),
                        Matrix(2, 0), Matrix::Ones(2, 1)}};
  return data;
}

TEST(TimeUnit, IsThatOfTheModel) {
  const Dataset data = in_time_unit_of(model_in("s"), record_in("min"));
  EXPECT_EQ(data.time_unit, "s");
  EXPECT_DOUBLE_EQ(data.trajectories[0].time[1], 1800.0);
  EXPECT_FALSE(data.trajectories[0].has_derivatives()) << "they were per minute";
  ASSERT_EQ(data.notes.size(), 1u);
  EXPECT_EQ(data.notes[0], "run.csv: time is taken from min to s");
}

/// Words are the units that they mean, in models as in files.
TEST(TimeUnit, MayBeAWord) {
  for (const char* word : {"min", "minute", "minutes", "mins"}) {
    EXPECT_EQ(model_in(word).time_unit(), "min");
    const Dataset data = in_time_unit_of(model_in(word), record_in("min"));
    EXPECT_EQ(data.trajectories[0].time[1], 30.0) << word;
    EXPECT_TRUE(data.notes.empty()) << word;
  }
  EXPECT_EQ(model_in("day").time_unit(), "d");
  EXPECT_EQ(model_in("hours").time_unit(), "h");
  EXPECT_EQ(model_in("sec").time_unit(), "s");
  EXPECT_EQ(model_in("generation").time_unit(), "generation");
  EXPECT_DOUBLE_EQ(in_time_unit_of(model_in("days"), record_in("hours")).trajectories[0].time[1],
                   30.0 / 24.0);
}

TEST(TimeUnit, StaysWhereThereIsNothingToConvert) {
  for (const char* unit : {"min", "", "1"}) {
    const Dataset data = in_time_unit_of(model_in(unit), record_in("min"));
    EXPECT_EQ(data.trajectories[0].time[1], 30.0) << unit;
    EXPECT_TRUE(data.trajectories[0].has_derivatives()) << unit;
    EXPECT_TRUE(data.notes.empty()) << unit;
  }
}

TEST(TimeUnit, ThatIsNoMultipleOfASecondIsRefused) {
  testing::expect_error<DataError>([] { in_time_unit_of(model_in("s"), record_in("rev")); },
                                   "run.csv", "time is in rev, that of the model in s",
                                   "same unit");
}

TEST(TimeUnit, HasANameWhereItIsATimeOfSeconds) {
  EXPECT_EQ(scaled_time_unit("s", 1e-3), "ms");
  EXPECT_EQ(scaled_time_unit("ms", 1e-3), "us");
  EXPECT_EQ(scaled_time_unit("min", 60.0), "h");
  EXPECT_FALSE(scaled_time_unit("s", 0.1));
  EXPECT_FALSE(scaled_time_unit("tau", 1e-3));
}

}  // namespace
}  // namespace lacuna
