// SPDX-License-Identifier: MIT
// Devices that lack nothing, of which position and speed are measured, with sensors of which the
// two show not the same motion. That dx/dt = v is what speed means: no effect acts there, and
// none of the device's either makes up for a sensor. Of the list that was written before anything
// that it tests was changed, these are met; docs/diagnosis/limits.md has the others.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "hidden/support/cases.hpp"
#include "hidden/support/null_benches.hpp"
#include "hidden/support/score.hpp"
#include "hidden/support/sensor_benches.hpp"
#include "hidden/support/twins.hpp"
#include "hidden/whole_vocabulary.hpp"

namespace lacuna::hidden {
namespace {

constexpr Index kPosition = 0, kSpeed = 1;

/// Each value so many samples later, halves between two.
Vector late(const Vector& x, double samples) {
  Vector result = x;
  for (Index i = 0; i < x.size(); ++i) {
    const double at = std::max(static_cast<double>(i) - samples, 0.0);
    const auto before = static_cast<Index>(at);
    const Index after = std::min(before + 1, x.size() - 1);
    result[i] = x[before] + (at - static_cast<double>(before)) * (x[after] - x[before]);
  }
  return result;
}

/// Each value until the next of a slower sensor.
Vector held(const Vector& x, Index samples) {
  Vector result = x;
  for (Index i = 0; i < x.size(); ++i) result[i] = x[i - i % samples];
  return result;
}

struct SensorCase {
  std::string name;
  void (*disturb)(Trajectory& record);
};

/// For gtest.
void PrintTo(const SensorCase& one, std::ostream* out) { *out << one.name; }

template <Index channel>
void replace(Trajectory& record, const Vector& values) {
  record.states.col(channel) = values;
}

const std::vector<SensorCase>& sensor_cases() {
  static const std::vector<SensorCase> all{
      {"position_averaged_over_12",
       [](Trajectory& r) { replace<kPosition>(r, mean_of_last(r.states.col(kPosition), 12)); }},
      {"position_averaged_over_5",
       [](Trajectory& r) { replace<kPosition>(r, mean_of_last(r.states.col(kPosition), 5)); }},
      {"speed_averaged_over_8",
       [](Trajectory& r) { replace<kSpeed>(r, mean_of_last(r.states.col(kSpeed), 8)); }},
      {"position_late",
       [](Trajectory& r) { replace<kPosition>(r, late(r.states.col(kPosition), 2.5)); }},
      {"position_of_a_slower_sensor",
       [](Trajectory& r) { replace<kPosition>(r, held(r.states.col(kPosition), 4)); }}};
  return all;
}

class IdentitySensor : public ::testing::TestWithParam<SensorCase> {};

TEST_P(IdentitySensor, SaysNothingOfTheDevice) {
  for (const auto& [kind, seed] : {std::pair{Twin::LaggedThrust, 9101U},
                                   std::pair{Twin::LatticeFriction, 9102U}}) {
    HiddenCase device = complete_twin(kind, seed);
    device.noise = NoiseKind::White;
    Records records = make_records(device, kBenchNoise, seed);
    for (Dataset* data : {&records.find, &records.check})
      for (Trajectory& record : data->trajectories) GetParam().disturb(record);
    const Diagnosis found = diagnosis_of(device.nominal, records.find, records.check);
    // What the sensor does may be named; the rest is no name.
    const std::set<std::string> of_sensors{"sensor-lag", "sensor-gain", "sensor-offset",
                                           "sensor-drift", "channel-skew"};
    for (const NamedEffect& effect : found.effects)
      EXPECT_TRUE(of_sensors.contains(effect.name))
          << device.name << ": " << in_one_line(found);
  }
}

TEST(IdentitySensors, ThatDriftAreNoisyAndContradictNothing) {
  HiddenCase pendulum = case_named("pendulum-null");
  pendulum.noise = NoiseKind::Drifting;
  const Records records = make_records(pendulum, 0.001, 1040);
  const Diagnosis found = diagnosis_of(pendulum.nominal, records.find, records.check);
  EXPECT_EQ(found.verdict, Verdict::NoDiscrepancy) << in_one_line(found);
}

INSTANTIATE_TEST_SUITE_P(All, IdentitySensor, ::testing::ValuesIn(sensor_cases()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace lacuna::hidden
