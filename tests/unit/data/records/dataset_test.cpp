// SPDX-License-Identifier: MIT
#include "lacuna/data/records/dataset.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "data/records/state_statistics.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

Dataset sample() {
  Trajectory record;
  record.source = "a.csv";
  record.time = Vector::LinSpaced(4, 0.0, 3.0);
  record.states = Matrix::Random(4, 2);
  record.inputs = Matrix::Random(4, 1);
  Dataset data;
  data.states = {{"x", "V"}, {"y", "V"}};
  data.inputs = {{"u", "V"}};
  data.trajectories = {record, record};
  return data;
}

void expect_refused(const Dataset& data, const std::string& where, const std::string& problem,
                    const std::string& remedy) {
  testing::expect_error<DataError>([&] { check_dataset(data); }, where, problem, remedy);
}

TEST(Dataset, CountsSamplesAndKnowsItsDerivatives) {
  Dataset data = sample();
  EXPECT_NO_THROW(check_dataset(data));
  EXPECT_EQ(data.samples(), 8);
  EXPECT_FALSE(data.has_derivatives());
  data.trajectories[0].derivatives = Matrix::Zero(4, 2);
  EXPECT_FALSE(data.has_derivatives());
  data.trajectories[1].derivatives = Matrix::Zero(4, 2);
  EXPECT_TRUE(data.has_derivatives());
  EXPECT_NO_THROW(check_dataset(data));
  EXPECT_FALSE(Dataset{}.has_derivatives());
}

TEST(CheckDataset, RefusesBadNames) {
  Dataset data = sample();
  data.states[1].name = "x";
  expect_refused(data, "dataset", "the name 'x' is used twice", "name of its own");
  data.states[1].name = "u";
  expect_refused(data, "dataset", "the name 'u' is used twice", "name of its own");
  data.states[1].name = "Ch 1";
  expect_refused(data, "dataset", "the name 'Ch 1' is not an identifier", "letters, digits");
  data.states[1].name = "t";
  expect_refused(data, "dataset", "'t' is a word of the formula", "choose another");
}

TEST(CheckDataset, RefusesWhatIsEmpty) {
  Dataset data = sample();
  data.trajectories.clear();
  expect_refused(data, "dataset", "there is no record", "at least one");
  data.states.clear();
  expect_refused(data, "dataset", "there is no state", "at least one");
}

TEST(CheckDataset, RefusesShapesThatDoNotFit) {
  Dataset data = sample();
  data.trajectories[1].source.clear();
  data.trajectories[1].states = Matrix::Zero(3, 2);
  expect_refused(data, "record 2", "the states are 3 x 2, expected 4 x 2", "each sample");
  data = sample();
  data.trajectories[0].inputs = Matrix::Zero(4, 0);
  expect_refused(data, "a.csv", "the inputs are 4 x 0, expected 4 x 1", "each name");
  data = sample();
  data.trajectories[0].derivatives = Matrix::Zero(4, 1);
  expect_refused(data, "a.csv", "the derivatives are 4 x 1, expected 4 x 2", "each name");
}

TEST(CheckDataset, RefusesValuesThatAreNotFinite) {
  Dataset data = sample();
  data.trajectories[0].states(2, 1) = std::numeric_limits<double>::quiet_NaN();
  expect_refused(data, "a.csv, row 3", "state 'y' is nan", "remove the row");
  data = sample();
  data.trajectories[0].inputs(0, 0) = std::numeric_limits<double>::infinity();
  expect_refused(data, "a.csv, row 1", "input 'u' is inf", "remove the row");
}

TEST(CheckDataset, RefusesTimesThatDoNotRise) {
  Dataset data = sample();
  data.trajectories[0].time[2] = 1.0;
  expect_refused(data, "a.csv, row 3", "the time 1 is not later", "sort the samples");
  data.trajectories[0].time.resize(1);
  expect_refused(data, "a.csv", "has 1 of the 2 samples", "longer");
}

TEST(CheckDataset, FormAndValuesAreItsParts) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Dataset values = sample();
  values.trajectories[1].derivatives = Matrix::Constant(4, 2, nan);
  EXPECT_NO_THROW(check_form(values));
  testing::expect_error<DataError>([&] { check_finite(values); }, "a.csv, row 1",
                                   "derivative of 'x' is nan", "remove the row");
  Dataset form = sample();
  form.trajectories[0].time[3] = nan;
  EXPECT_NO_THROW(check_finite(form));
  testing::expect_error<DataError>([&] { check_form(form); }, "a.csv, row 4", "the time nan",
                                   "sort the samples");
}

TEST(CheckDataset, RefusesRatesOfStatesThatDoNotExist) {
  Dataset data = sample();
  data.rate_of = {Index{2}, std::nullopt};
  expect_refused(data, "dataset", "names state 2", "from 0 to 1");
  data.rate_of = {std::nullopt};
  expect_refused(data, "dataset", "1 entries for 2 states", "each state");
}

TEST(MedianStep, IsThatOfAllRecords) {
  Dataset data;
  data.trajectories.resize(2);
  data.trajectories[0].time = Vector{{0.0, 5.0}};
  data.trajectories[1].time = Vector{{0.0, 1.0, 2.0, 4.0, 6.0}};
  EXPECT_DOUBLE_EQ(median_step(data), 2.0);
}

TEST(InputColumns, AreMadeWhereThereIsNoInput) {
  Dataset data = sample();
  EXPECT_FALSE(lacks_input_columns(data));
  data.inputs.clear();
  for (Trajectory& record : data.trajectories) record.inputs.resize(0, 0);
  EXPECT_TRUE(lacks_input_columns(data));
  const Dataset complete = with_input_columns(data);
  EXPECT_FALSE(lacks_input_columns(complete));
  for (const Trajectory& record : complete.trajectories) {
    EXPECT_EQ(record.inputs.rows(), record.samples());
    EXPECT_EQ(record.inputs.cols(), 0);
  }
}

TEST(InputColumns, AreNotMadeUpForAnInputThatIsMissing) {
  Dataset data = sample();
  for (Trajectory& record : data.trajectories) record.inputs.resize(0, 0);
  EXPECT_FALSE(lacks_input_columns(data));
  EXPECT_THROW(check_dataset(with_input_columns(data)), DataError);
}

TEST(LongestRecord, IsTheFirstOfThoseWithMostSamples) {
  Dataset data;
  for (const Index samples : {3, 5, 5, 2}) {
    Trajectory record;
    record.time = Vector::LinSpaced(samples, 0.0, 1.0);
    data.trajectories.push_back(record);
  }
  EXPECT_EQ(&longest_record(data), &data.trajectories[1]);
}

Trajectory record_at(const std::vector<double>& times) {
  Trajectory trajectory;
  trajectory.time = Eigen::Map<const Vector>(times.data(), static_cast<Index>(times.size()));
  return trajectory;
}

TEST(UniformStep, IsTheMeanStep) {
  EXPECT_DOUBLE_EQ(*uniform_step(record_at({1.0, 1.5, 2.0, 2.5})), 0.5);
  EXPECT_DOUBLE_EQ(*uniform_step(record_at({0.0, 1.0005, 2.0})), 1.0);
}

TEST(UniformStep, IsNothingWhenStepsDiffer) {
  EXPECT_FALSE(uniform_step(record_at({0.0, 1.0, 2.1})));
  EXPECT_TRUE(uniform_step(record_at({0.0, 1.0, 2.1}), 0.1));
}

TEST(UniformStep, IsNothingForFewerThanTwoSamples) {
  EXPECT_FALSE(uniform_step(record_at({})));
  EXPECT_FALSE(uniform_step(record_at({1.0})));
}

TEST(RowsOf, AreTheSamplesOfAllThatThereIs) {
  Trajectory record = record_at({0.0, 1.0, 2.0, 6.0});
  record.source = "a.csv";
  record.states = Matrix::Random(4, 2);
  record.derivatives = Matrix::Random(4, 2);
  const Trajectory part = rows_of(record, 1, 2);
  EXPECT_EQ(part.source, "a.csv");
  EXPECT_EQ(part.time, (Vector{{1.0, 2.0}}));
  EXPECT_EQ(part.states, Matrix(record.states.middleRows(1, 2)));
  EXPECT_EQ(part.derivatives, Matrix(record.derivatives.middleRows(1, 2)));
  EXPECT_EQ(part.inputs.size(), 0) << "0 x 0 stays what it is";
  record.derivatives.resize(0, 0);
  EXPECT_FALSE(rows_of(record, 1, 2).has_derivatives());
}

TEST(GoesOn, AfterAShortGapInTheSameFile) {
  Trajectory before = record_at({0.0, 1.0}), after = record_at({3.0, 4.0});
  before.source = "run.csv, piece 1";
  after.source = "run.csv, piece 2";
  EXPECT_EQ(file_of(after), "run.csv");
  EXPECT_TRUE(goes_on(before, after, 2.0));
  EXPECT_FALSE(goes_on(before, after, 1.9));
  EXPECT_FALSE(goes_on(after, before, 9.0));
  before.source = "run.csv, record 1";
  after.source = "run.csv, record 2";
  EXPECT_FALSE(goes_on(before, after, 2.0)) << "a record begins there";
  before.source = "run.csv, record 2, piece 1";
  after.source = "run.csv, record 2, piece 2";
  EXPECT_EQ(file_of(after), "run.csv");
  EXPECT_TRUE(goes_on(before, after, 2.0));
  after.source = "other.csv, record 2, piece 2";
  EXPECT_FALSE(goes_on(before, after, 2.0));
}

TEST(Hold, ShowsWhereMostSamplesRepeat) {
  EXPECT_TRUE(shows_hold(Vector{{1.0, 1.0, 1.0, 2.0, 2.0, 2.0}}));
  EXPECT_FALSE(shows_hold(Vector{{1.0, 1.0, 2.0, 3.0, 3.0, 4.0}}));
  EXPECT_TRUE(shows_hold(Vector{{1.0, 1.0, 2.0, 3.0, 3.0, 4.0}}, 0.3));
  EXPECT_FALSE(shows_hold(Vector::Constant(6, 1.0))) << "it never changes";
  EXPECT_FALSE(shows_hold(Vector::Constant(1, 1.0)));
}

TEST(StateStatistics, AreThoseOfAllRecordsTogetherAndASpanIsNever0) {
  Dataset data{.states = {{"x", ""}}, .inputs = {}, .trajectories = {}, .rate_of = {}};
  for (const double first : {0.0, 4.0})
    data.trajectories.push_back(
        {"made", Vector{{0.0, 1.0}}, Matrix{{first}, {first + 2.0}}, Matrix(2, 0), Matrix()});
  EXPECT_DOUBLE_EQ(state_variance(data, 0), 5.0);
  EXPECT_DOUBLE_EQ(state_spans(data)[0], 6.0);
  for (Trajectory& record : data.trajectories) record.states.setOnes();
  EXPECT_GT(state_spans(data)[0], 0.0);
}

}  // namespace
}  // namespace lacuna
