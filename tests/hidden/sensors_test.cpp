// SPDX-License-Identifier: MIT
// Records of sensors with a fault: it is told, and no effect of the dynamics in its place.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>

#include "hidden/support/cases.hpp"
#include "hidden/support/records.hpp"
#include "hidden/whole_vocabulary.hpp"

namespace lacuna::hidden {
namespace {

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

}  // namespace
}  // namespace lacuna::hidden
