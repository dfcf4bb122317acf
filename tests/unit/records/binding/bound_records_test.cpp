// SPDX-License-Identifier: MIT
#include "lacuna/records/binding/bound_records.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "records/binding/other_records.hpp"
#include "records/binding/seams.hpp"
#include "records/binding/time_unit.hpp"
#include "support/expect_error.hpp"
#include "support/harmonic_model.hpp"
#include "support/oscillation.hpp"

namespace lacuna {
namespace {

using Firsts = std::vector<Index>;
using testing::expect_error;

/// x with white noise of deviation 0.01, the input u, and no v.
Dataset without_rate() {
  Dataset data = oscillation_data();
  data.states = {{"x", "m"}};
  Trajectory& record = data.trajectories[0];
  record.states = Matrix(record.states.leftCols(1));
  Random random(9);
  for (double& x : record.states.reshaped()) x += 0.01 * random.normal();
  return data;
}

TEST(Bind, SaysHowEachStateWasMeasured) {
  Dataset data = without_rate();
  data.trajectories[0].states(50, 0) += 1.0;
  const BoundRecords records =
      observed(model_view(support::harmonic_model(), data, FiniteDifferences{}));
  EXPECT_EQ(records.data.states, support::harmonic_model().states());
  ASSERT_EQ(records.channels.size(), 2u);
  EXPECT_TRUE(records.channels[0].measured);
  EXPECT_FALSE(records.channels[1].measured);
  EXPECT_EQ(records.channels[0].noise.kind, NoiseKind::White);
  EXPECT_NEAR(records.channels[0].noise.sigma, 0.01, 0.002);
  ASSERT_EQ(records.outliers.size(), 1u);
  EXPECT_EQ(records.outliers[0](50, 0), 1.0);
  EXPECT_EQ(records.outliers[0].sum(), 1.0);
}

TEST(BoundRecords, CarryTheNoiseOfTheirSamples) {
  Dataset data = without_rate();
  const BoundRecords records = as_measured(data);
  EXPECT_EQ(visible_noise(records), estimate_noise(data));
  BoundRecords doubled = records;
  doubled.data.trajectories[0].states *= 2.0;
  EXPECT_EQ(visible_noise(doubled), visible_noise(records)) << "nobody looked again";
  EXPECT_EQ(visible_noise(with_noise_anew(doubled)), 2.0 * visible_noise(records));
  data.trajectories[0].time[7] = 0.0;
  EXPECT_THROW(as_measured(data), DataError);
}

TEST(BoundRecords, OnALatticeShowTheNoiseOfRounding) {
  Dataset data = without_rate();
  for (double& x : data.trajectories[0].states.reshaped()) x = std::round(4.0 * x) / 4.0;
  const BoundRecords coarse = as_measured(data);
  ASSERT_EQ(coarse.channels[0].noise.kind, NoiseKind::Quantised);
  EXPECT_EQ(visible_noise(coarse)[0], coarse.channels[0].noise.sigma);
}

TEST(ObservedAlike, HasTheNoiseWithoutTheOutliersThatItMarks) {
  Dataset data = without_rate();
  const BoundRecords first = observed(data);
  EXPECT_EQ(visible_noise(observed_alike(data, first)), visible_noise(first));
  data.trajectories[0].states(50, 0) += 1.0;
  const BoundRecords other = observed_alike(data, first);
  EXPECT_EQ(mark_of(other.data.trajectories[0].marks, 50, 0), Mark::Outlier);
  EXPECT_EQ(visible_noise(other), estimate_noise(other.data));
}

TEST(ObservedAlike, AnEndThatOtherRecordsGoBeyondIsNoneThere) {
  Dataset data = without_rate();
  auto x = data.trajectories[0].states.col(0).array();
  const double end = 0.5 * x.maxCoeff();
  Dataset clipped = data;
  clipped.trajectories[0].states.col(0) = x.min(end).matrix();
  const BoundRecords first = observed(clipped);
  ASSERT_EQ(first.channels[0].limits.high, end);
  EXPECT_GT(observed_alike(clipped, first).channels[0].at_top, 0.0);
  EXPECT_EQ(observed_alike(data, first).channels[0].at_top, 0.0);
  EXPECT_EQ(observed_alike(data, first).data.trajectories[0].states, data.trajectories[0].states);
  Dataset touching = data;  // where its largest samples are, which alone show no end
  touching.trajectories[0].states.col(0) = (0.5 * x).matrix();
  EXPECT_EQ(observed(touching).channels[0].at_top, 0.0);
  EXPECT_GT(observed_alike(touching, first).channels[0].at_top, 0.0);
}

TEST(Observed, CountsRepeatedSamples) {
  Dataset data = without_rate();
  EXPECT_EQ(observed(data).channels[0].repeats, 0.0);
  EXPECT_FALSE(mostly_repeats(observed(data)));
  for (double& x : data.trajectories[0].states.reshaped()) x = std::round(4.0 * x) / 4.0;
  const BoundRecords coarse = observed(data);
  EXPECT_GT(coarse.channels[0].repeats, 0.5);
  EXPECT_TRUE(mostly_repeats(coarse));
  data.reconstructed = {true};
  EXPECT_FALSE(mostly_repeats(observed(data))) << "what was made from others was not rounded";
}

Dataset record(const std::string& source, double phase) {
  const Vector time = Vector::LinSpaced(100, 0.0, 9.9);
  Dataset data{"s", {{"x", ""}}, {}, {}, {}};
  data.trajectories.push_back(
      {source, time, (time.array() + phase).cos().matrix(), Matrix(100, 0), {}});
  return data;
}

void expect_refused(const Dataset& used, const Dataset& held_out) {
  expect_error<DataError>([&] { check_are_others(used, held_out); },
                          held_out.trajectories[0].source, "the samples of a.csv", "not used");
}

TEST(OtherRecords, TheSameSamplesAreRefusedByBothNames) {
  const Dataset used = record("a.csv", 0.0);
  expect_refused(used, record("b.csv", 0.0));
  Dataset part = record("b.csv", 0.0);
  part.trajectories[0] = rows_of(part.trajectories[0], 40, 30);
  expect_refused(used, part);
  Dataset later = record("b.csv", 0.0);
  later.trajectories[0].time.array() += 100.0;
  expect_refused(used, later);
}

TEST(OtherRecords, OneOtherValueMakesAnotherRecord) {
  const Dataset used = record("a.csv", 0.0);
  Dataset other = used;
  other.trajectories[0].states(50, 0) += 1e-9;
  EXPECT_NO_THROW(check_are_others(used, other));
  other = used;
  other.trajectories[0].states(50, 0) = std::nan("");
  EXPECT_NO_THROW(check_are_others(used, other));
  expect_refused(other, other);
}

/// Records of the given states (a column each) and one input; times 0.05 apart.
Firsts seams_of(const Matrix& states, const Vector& input) {
  Dataset data;
  for (Index k = 0; k < states.cols(); ++k)
    data.states.push_back({"x" + std::to_string(k), ""});
  data.inputs = {{"u", ""}};
  Trajectory record;
  const double end = 0.05 * static_cast<double>(states.rows() - 1);
  record.time = Vector::LinSpaced(states.rows(), 0.0, end);
  record.states = states;
  record.inputs = input;
  data.trajectories = {record};
  return seams(data, data.trajectories.front());
}

Firsts seams_of(const Matrix& states) { return seams_of(states, Vector::Zero(states.rows())); }

/// cos and its rate from a phase on.
Matrix swing(Index samples, double phase) {
  Matrix states(samples, 2);
  for (Index i = 0; i < samples; ++i) {
    const double t = phase + 0.05 * static_cast<double>(i);
    states.row(i) << std::cos(t), -std::sin(t);
  }
  return states;
}

TEST(SeamsOfARecord, ADeviceThatStandsStillHasNone) {
  for (const Index at : {60, 83, 100, 131}) {
    Matrix states = swing(200, 0.3);
    states.bottomRows(200 - at).rowwise() = states.row(at - 1).eval();
    EXPECT_EQ(seams_of(states), Firsts{}) << at;
  }
}

TEST(SeamsOfARecord, AnImpactChangesNoPosition) {
  Matrix states(200, 2);  // a ball that bounces each second
  for (Index i = 0; i < states.rows(); ++i) {
    const double t = std::fmod(0.05 * static_cast<double>(i) + 0.013, 1.0);
    states.row(i) << 5.0 * t * (1.0 - t), 5.0 - 10.0 * t;
  }
  EXPECT_EQ(seams_of(states), Firsts{});
}

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
  EXPECT_DOUBLE_EQ(
      in_time_unit_of(model_in("days"), record_in("hours")).trajectories[0].time[1],
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

TEST(TimeUnit, HasANameWhereItIsATimeOfSeconds) {
  EXPECT_EQ(scaled_time_unit("s", 1e-3), "ms");
  EXPECT_EQ(scaled_time_unit("ms", 1e-3), "us");
  EXPECT_EQ(scaled_time_unit("min", 60.0), "h");
  EXPECT_FALSE(scaled_time_unit("s", 0.1));
  EXPECT_FALSE(scaled_time_unit("tau", 1e-3));
}

}  // namespace
}  // namespace lacuna
