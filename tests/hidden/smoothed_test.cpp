// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/derivatives/finite_differences.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/null_benches.hpp"
#include "hidden/support/records.hpp"
#include "hidden/support/score.hpp"
#include "hidden/support/spikes.hpp"
#include "hidden/support/twins.hpp"
#include "hidden/whole_vocabulary.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"

namespace lacuna::hidden {
namespace {

// Records that somebody smoothed: no effect is named for what a filter bent, and one that is
// there is named as in the samples that were measured.
/// Rows that are weighted sums of rows from `before` ahead of each on; fewer by so many
/// weights.
Matrix weighted(const Matrix& rows, const std::vector<double>& weights) {
  const auto count = static_cast<Index>(weights.size());
  Matrix sums = Matrix::Zero(rows.rows() - count + 1, rows.cols());
  for (Index j = 0; j < count; ++j)
    sums += weights[static_cast<std::size_t>(j)] * rows.middleRows(j, sums.rows());
  return sums;
}

/// A record with its states smoothed, and its other rows from `first` on.
Trajectory smoothed_states(Trajectory record, const std::vector<double>& weights, Index first) {
  record.states = weighted(record.states, weights);
  const Index n = record.states.rows();
  record.time = Vector(record.time.segment(first, n));
  record.inputs = Matrix(record.inputs.middleRows(first, n));
  return record;
}

/// The record as if only its first states had been measured.
Dataset first_states(const OdeModel& model, Dataset data, Index count) {
  data.states.resize(static_cast<std::size_t>(count));
  for (Trajectory& record : data.trajectories)
    record.states = Matrix(record.states.leftCols(count));
  return model_view(model, data, FiniteDifferences{});
}

Diagnosis of_smoothed(const std::string& name, const std::vector<double>& weights, Index first,
                      std::optional<Index> measured = {}) {
  const HiddenCase hidden = case_named(name);
  auto [find, check] = make_records(hidden, 0.01, 3);
  for (Dataset* data : {&find, &check}) {
    for (Trajectory& record : data->trajectories)
      record = smoothed_states(std::move(record), weights, first);
    if (measured) *data = first_states(hidden.nominal, std::move(*data), *measured);
  }
  return diagnosis_of(hidden.nominal, find, check);
}

bool says(const Diagnosis& diagnosis, const std::string& what) {
  for (const std::string& note : diagnosis.notes)
    if (note.find(what) != std::string::npos) return true;
  return false;
}

/// Weights of the least-squares parabola through seven samples (Savitzky and Golay 1964).
const std::vector<double> kParabola{-2.0 / 21.0, 3.0 / 21.0, 6.0 / 21.0, 7.0 / 21.0,
                                    6.0 / 21.0,  3.0 / 21.0, -2.0 / 21.0};

TEST(Smoothed, NothingIsMissingForWhatAMeanHasBent) {
  for (const std::string name : {"lorenz-null", "prey-null", "motor-null"}) {
    const Diagnosis mean = of_smoothed(name, std::vector<double>(9, 1.0 / 9.0), 4);
    EXPECT_EQ(mean.verdict, Verdict::NoDiscrepancy) << name << ": " << in_one_line(mean);
    EXPECT_TRUE(says(mean, "means over 9 samples")) << name;
  }
}

TEST(Smoothed, MeansOfWhatWasAreNoDelay) {
  const Diagnosis past = of_smoothed("motor-null", std::vector<double>(10, 0.1), 9);
  EXPECT_EQ(past.verdict, Verdict::NoDiscrepancy) << in_one_line(past);
  EXPECT_TRUE(says(past, "means over the last 10 samples"));
}

TEST(Smoothed, AnEffectIsNamedAsBefore) {
  const Diagnosis friction = of_smoothed("pendulum-dry-friction", kParabola, 3);
  ASSERT_EQ(friction.effects.size(), 1u);
  EXPECT_EQ(friction.effects[0].name, "coulomb-friction");
  EXPECT_TRUE(says(friction, "parabolas through 7 samples"));
}

TEST(Smoothed, StatesThatNobodyMeasuredDoNotMatter) {
  const std::vector<double> mean(9, 1.0 / 9.0);
  const Diagnosis drag = of_smoothed("pendulum-drag", mean, 4, 1);
  ASSERT_EQ(drag.effects.size(), 1u);
  EXPECT_EQ(drag.effects[0].name, "quadratic-drag");
  EXPECT_TRUE(says(drag, "means over 9 samples"));
  EXPECT_EQ(of_smoothed("pendulum-null", mean, 4, 1).verdict, Verdict::NoDiscrepancy);
}

// A few samples that are off have no name: no effect is named for them, and they take none
// away.
class Spikes : public ::testing::TestWithParam<SpikeCase> {};

TEST_P(Spikes, HaveNoName) {
  const SpikeCase one = GetParam();
  const Diagnosis found = diagnosis_of(spike_model(one.model), spike_record(one, 11), {});
  EXPECT_NE(found.verdict, Verdict::Explained);
  for (const NamedEffect& effect : found.effects)
    ADD_FAILURE() << to_string(found.verdict) << ": " << effect.name << " in "
                  << effect.equation << ", " << effect.sigma << " sigma";
}

INSTANTIATE_TEST_SUITE_P(All, Spikes, ::testing::ValuesIn(spike_cases()), [](const auto& one) {
  std::string name = one.param.name;
  for (char& c : name)
    if (c == ' ' || c == ',') c = '_';
  return name;
});

// Devices that lack nothing, on benches with faults: none gets a name.
class NullBench : public ::testing::TestWithParam<BenchFault> {};

TEST_P(NullBench, GetsNoName) {
  const BenchCase bench = null_bench(GetParam(), 8004);
  const Diagnosis found =
      diagnosis_of(bench.hidden.nominal, bench.records.find, bench.records.check);
  EXPECT_NE(found.verdict, Verdict::Explained) << in_one_line(found);
  const bool sensor = GetParam() == BenchFault::MovingAverage;
  for (const NamedEffect& effect : found.effects)
    EXPECT_TRUE(sensor && (effect.name == "sensor-lag" || effect.name == "channel-skew"))
        << in_one_line(found);
}

INSTANTIATE_TEST_SUITE_P(All, NullBench, ::testing::ValuesIn(all_bench_faults()),
                         [](const auto& one) {
                           std::string name = to_string(one.param);
                           for (char& c : name)
                             if (c == '-') c = '_';
                           return name;
                         });

}  // namespace
}  // namespace lacuna::hidden
