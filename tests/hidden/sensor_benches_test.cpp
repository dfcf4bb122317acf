// SPDX-License-Identifier: MIT
// Sensors that show the states of other times: no effect of the device is named in their place.
#include "hidden/support/sensor_benches.hpp"

#include <gtest/gtest.h>

#include <set>

namespace lacuna::hidden {
namespace {

const Trajectory& found_of(const BenchCase& bench) {
  return bench.records.find.trajectories.front();
}

/// By how many samples a channel is later than in another record, least squares to first order.
double lateness(const Vector& shown, const Vector& true_values) {
  const Index n = true_values.size() - 2;
  const Vector slope = 0.5 * (true_values.tail(n) - true_values.head(n));
  const Vector apart = true_values.segment(1, n) - shown.segment(1, n);
  return slope.dot(apart) / slope.squaredNorm();
}

SensorBench bench_named(const std::string& name) {
  for (const SensorBench& bench : all_sensor_benches())
    if (bench.name == name) return bench;
  throw std::invalid_argument(name);
}

/// The records of the device with nothing but noise.
Trajectory undisturbed(const BenchCase& bench, const SensorBench& of) {
  return clean_record(bench.hidden, 2 * of.seed).trajectories.front();
}

TEST(SensorBenches, ChannelsAreLateByWhatTheSensorsDo) {
  const auto late_by = [](const std::string& name, Index channel) {
    const SensorBench bench = bench_named(name);
    const BenchCase made = made_bench(bench);
    return lateness(found_of(made).states.col(channel),
                    undisturbed(made, bench).states.col(channel));
  };
  EXPECT_NEAR(late_by("slide-speed-filter-null", 1), 5.0, 0.5);
  EXPECT_NEAR(late_by("slide-position-second-order-null", 0), 6.0, 0.5);
  EXPECT_NEAR(late_by("thrust-means-null", 0), 4.5, 0.5) << "half of ten samples";
  EXPECT_NEAR(late_by("slide-differences-null", 1), 3.0, 0.5) << "half of six samples";
  EXPECT_NEAR(late_by("slide-differences-null", 0), 0.0, 0.1);
}

TEST(SensorBenches, InputsActLate) {
  const SensorBench bench = bench_named("slide-late");
  const BenchCase made = made_bench(bench);
  const Vector u = found_of(made).inputs.col(0);
  const Vector acts = undisturbed(made, bench).inputs.col(0);
  EXPECT_LT((u.head(1900) - acts.segment(6, 1900)).norm(), 1e-9);
  const SensorBench lag = bench_named("thrust-actuator");
  const BenchCase behind = made_bench(lag);
  EXPECT_NEAR(lateness(undisturbed(behind, lag).inputs.col(0), found_of(behind).inputs.col(0)),
              8.0, 0.8);
}

TEST(SensorBenches, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const SensorBench& bench : all_sensor_benches()) names.insert(bench.name);
  EXPECT_EQ(names.size(), all_sensor_benches().size());
  EXPECT_GE(names.size(), 20U);
}

}  // namespace
}  // namespace lacuna::hidden
