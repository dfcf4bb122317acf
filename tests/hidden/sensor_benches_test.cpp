// SPDX-License-Identifier: MIT
// Sensors that show the states of other times: no effect of the device is named in their place.
#include "hidden/support/sensor_benches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "hidden/support/score.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/diagnose/journey/diagnose.hpp"

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
  // What is behind a lag tau is tau times its slope away from what is before it.
  EXPECT_NEAR(
      -lateness(found_of(behind).inputs.col(0), undisturbed(behind, lag).inputs.col(0)), 8.0, 0.8);
}

TEST(SensorBenches, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const SensorBench& bench : all_sensor_benches()) names.insert(bench.name);
  EXPECT_EQ(names.size(), all_sensor_benches().size());
  EXPECT_GE(names.size(), 20U);
}

class ASensorBench : public ::testing::TestWithParam<SensorBench> {};

TEST_P(ASensorBench, IsExplainedByNothingThatIsNotThere) {
  const SensorBench bench = GetParam();
  const BenchCase made = made_bench(bench);
  DiagnosisOptions options;
  options.effects = default_registry().make_all<Effect>();
  const Diagnosis found = diagnose(made.hidden.nominal, made.records.find, made.records.check,
                                   options, RunContext{});
  const std::vector<std::string>& sensors = names_of_sensors();
  const auto is_right = [&](const NamedEffect& effect) {
    if (std::find(sensors.begin(), sensors.end(), effect.name) != sensors.end()) return true;
    const auto& hidden = made.hidden.effects;
    return std::any_of(hidden.begin(), hidden.end(), [&](const HiddenEffect& one) {
      return std::find(one.names.begin(), one.names.end(), effect.name) != one.names.end();
    });
  };
  const bool all_right = std::all_of(found.effects.begin(), found.effects.end(), is_right);
  EXPECT_TRUE(all_right || found.verdict != Verdict::Explained) << in_one_line(found);
  if (!bench.acts_late) return;
  EXPECT_TRUE(std::any_of(found.effects.begin(), found.effects.end(),
                          [&](const NamedEffect& effect) {
                            return std::find(sensors.begin(), sensors.end(), effect.name) ==
                                       sensors.end() &&
                                   is_right(effect);
                          }))
      << in_one_line(found);
}

/// Inputs that act late, and those that were explained by something that is not there before
/// late sensors were tried (results/sensors.md of the study has all).
std::vector<SensorBench> decisive_benches() {
  const std::set<std::string> misled{
      "slide-right-speed-second-order-null", "store-filter-null", "store-right-filter-null",
      "thrust-differences-null", "slide-differences-of-means-null"};
  std::vector<SensorBench> benches = all_sensor_benches();
  std::erase_if(benches, [&](const SensorBench& bench) {
    return !bench.acts_late && !misled.contains(bench.name);
  });
  return benches;
}

INSTANTIATE_TEST_SUITE_P(All, ASensorBench, ::testing::ValuesIn(decisive_benches()),
                         [](const auto& one) {
                           std::string name = one.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace lacuna::hidden
