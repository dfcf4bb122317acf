// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <set>
#include <string>

#include "data/derivatives/finite_differences.hpp"
#include "hidden/support/case_builder.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/records.hpp"
#include "hidden/support/score.hpp"
#include "hidden/support/sensor_benches.hpp"
#include "hidden/whole_vocabulary.hpp"
#include "lacuna/records/binding/model_view.hpp"

namespace lacuna::hidden {
namespace {

// Records of sensors with a fault: it is told, and no effect of the dynamics in its place.
/// What a sensor makes of a record: a new column.
using Shows = std::function<Vector(const OdeModel& model, const Trajectory& record)>;

struct FaultySensor {
  std::string name;   ///< of the case
  std::string state;  ///< whose sensor it is
  std::string fault;  ///< as it is called
  Shows shows;
};

Vector column(const OdeModel& model, const Trajectory& record, const std::string& name) {
  const auto& inputs = model.inputs();
  for (std::size_t j = 0; j < inputs.size(); ++j)
    if (inputs[j].name == name) return record.inputs.col(static_cast<Index>(j));
  return record.states.col(model.state_index(name));
}

double spread(const Vector& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

/// x + fraction of its size of another quantity.
FaultySensor picks_up(std::string name, std::string state, std::string other, double fraction) {
  return {name, state, "sensor-offset", [=](const OdeModel& model, const Trajectory& record) {
            const Vector x = column(model, record, state), y = column(model, record, other);
            return Vector(x + fraction * spread(x) / spread(y) * y);
          }};
}

/// x + fraction of its size of x^2.
FaultySensor bends(std::string name, std::string state, double fraction) {
  return {name, state, "sensor-gain", [=](const OdeModel& model, const Trajectory& record) {
            const Vector x = column(model, record, state);
            return Vector(x + fraction / spread(x) * x.cwiseAbs2());
          }};
}

/// x + fraction of its size of a tone with some samples in a period.
FaultySensor hums(std::string name, std::string state, double fraction, double samples) {
  return {name, state, "sensor-offset", [=](const OdeModel& model, const Trajectory& record) {
            const Vector x = column(model, record, state);
            const Vector index = Vector::LinSpaced(x.size(), 0.0, double(x.size() - 1));
            return Vector(x.array() +
                          fraction * spread(x) * (6.2831853 / samples * index.array()).sin());
          }};
}

std::vector<FaultySensor> faulty_sensors() {
  return {
      picks_up("pendulum-null", "w", "th", 0.1),
      picks_up("motor-null", "i", "w", 0.1),
      bends("motor-null", "i", 0.05),
      hums("pendulum-null", "w", 0.05, 30.0),
      bends("pendulum-dry-friction", "w", 0.05),
  };
}

Diagnosis diagnosed(const FaultySensor& sensor, std::uint64_t seed) {
  const HiddenCase hidden = case_named(sensor.name);
  auto [find, check] = make_records(hidden, 0.01, seed);
  for (Dataset* data : {&find, &check})
    for (Trajectory& record : data->trajectories)
      record.states.col(hidden.nominal.state_index(sensor.state)) =
          sensor.shows(hidden.nominal, record);
  return diagnosis_of(hidden.nominal, find, check);
}

TEST(Sensors, FaultsAreToldAndNoEffectInTheirPlace) {
  int told = 0, number = 0;
  for (const FaultySensor& sensor : faulty_sensors()) {
    const Diagnosis diagnosis = diagnosed(sensor, static_cast<std::uint64_t>(++number));
    const Index state = diagnosis.nominal.state_index(sensor.state);
    bool right = false;
    for (const NamedEffect& effect : diagnosis.effects) {
      const std::string said = sensor.name + ", " + sensor.state + ": " + effect.description;
      if (effect.place == Place::Channel)
        right = right || (effect.name == sensor.fault && effect.equation == state);
      else
        EXPECT_TRUE(
            diagnosis.verdict != Verdict::Explained ||
            (sensor.name == "pendulum-dry-friction" && effect.name == "coulomb-friction"))
            << said;
      if (!right) std::cout << said << "\n";
    }
    told += right ? 1 : 0;
  }
  EXPECT_EQ(told, 5);
}

// Sensors that show the states of other times: no effect of the device is named in their place.
class ASensorBench : public ::testing::TestWithParam<SensorBench> {};

TEST_P(ASensorBench, IsExplainedByNothingThatIsNotThere) {
  const SensorBench bench = GetParam();
  const BenchCase made = made_bench(bench);
  const Diagnosis found =
      diagnosis_of(made.hidden.nominal, made.records.find, made.records.check);
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
  const std::set<std::string> misled{"slide-right-speed-second-order-null", "store-filter-null",
                                     "store-right-filter-null", "thrust-differences-null",
                                     "slide-differences-of-means-null"};
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

// A motor whose angle an encoder counts: there is no noise but the counts, so that all of a law
// of friction is seen, and one name says it.
Plant motor_with_encoder() {
  return {model_of("s", {{"th", "rad"}, {"w", "rad/s"}}, {{"u", "V"}},
                   {{{"w", 1.0}}, {{"w", -2.0}, {"u", 12.0}}}),
          Vector{{0.0, 0.0}},
          Vector{{0.1, 0.5}},
          0.01,
          2000,
          2.0,
          {{.shape = SignalSpec::Shape::Steps, .size = 3.0, .low = 0.5, .high = 3.0}}};
}

struct Friction {
  std::string label, name, law;
};

/// For gtest.
void PrintTo(const Friction& one, std::ostream* out) { *out << one.label; }

/// The angle alone, in steps of a turn over 4096.
Dataset counted(const OdeModel& nominal, Dataset data) {
  const double step = 2.0 * std::acos(-1.0) / 4096.0;
  data.states.resize(1);
  for (Trajectory& record : data.trajectories)
    record.states = Matrix(step * (record.states.leftCols(1) / step).array().round());
  return model_view(nominal, data, FiniteDifferences{});
}

class Encoder : public ::testing::TestWithParam<Friction> {};

TEST_P(Encoder, ShowsTheWholeLaw) {
  const HiddenCase motor =
      CaseBuilder("motor-encoder", "A motor with friction behind an encoder",
                  motor_with_encoder())
          .hide({"w", {GetParam().name}, {}, GetParam().law, -1.0}, GetParam().law)
          .build();
  const Records clean = make_records(motor, 0.0, 9401);
  const Diagnosis found = diagnosis_of(motor.nominal, counted(motor.nominal, clean.find),
                                       counted(motor.nominal, clean.check));
  ASSERT_EQ(found.effects.size(), 1u) << in_one_line(found);
  EXPECT_EQ(found.effects[0].name, GetParam().name) << in_one_line(found);
}

INSTANTIATE_TEST_SUITE_P(
    All, Encoder,
    ::testing::Values(Friction{"dry", "coulomb-friction", "8*tanh(w/0.02)"},
                      Friction{"wide", "coulomb-friction", "6*tanh(w/0.3)"},
                      Friction{"stribeck_steep", "stribeck-friction",
                               "(5+6*exp(-(w/0.8)^2))*tanh(w/0.01)"},
                      Friction{"drag", "quadratic-drag", "0.15*w*abs(w)"}),
    [](const auto& one) { return one.param.label; });

}  // namespace
}  // namespace lacuna::hidden
