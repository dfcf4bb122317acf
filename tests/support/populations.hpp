// SPDX-License-Identifier: MIT
// Records of individuals of which one column is measured.
#pragma once

#include <cmath>
#include <string>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"

namespace lacuna::support {

/// Individuals whose column `y` is a function of time, in the variables of a model.
/// @param value of (individual, time, random numbers).
template <class Value>
Dataset individuals(const SystemModel& system, Index count, const Vector& time,
                    std::uint64_t seed, const Value& value) {
  Random random(seed);
  Dataset data{"s", {{"y", ""}}, {}, {}, {}};
  for (Index i = 0; i < count; ++i) {
    Trajectory record{"i" + std::to_string(i), time, Matrix(time.size(), 1),
                      Matrix(time.size(), 0), Matrix()};
    const auto own = value(random);
    for (Index n = 0; n < time.size(); ++n) record.states(n, 0) = own(time[n], random);
    data.trajectories.push_back(std::move(record));
  }
  return model_view(system.model(), data, FiniteDifferences{});
}

/// y = b + a t with b = 2 + spread_b z, a = 1 + spread_a z and noise.
inline Dataset lines(const SystemModel& system, Index count, double spread_b, double spread_a,
                     double noise, std::uint64_t seed) {
  return individuals(system, count, sample_times(0.0, 0.5, 8), seed, [=](Random& random) {
    const double b = 2.0 + spread_b * random.normal(), a = 1.0 + spread_a * random.normal();
    return [=](double t, Random& each) { return b + a * t + noise * each.normal(); };
  });
}

/// The model of such lines.
inline SystemModel line_model(const std::string& b = "varies +- 0.4",
                              const std::string& a = "varies +- 0.2") {
  return parse_ode_system("param b = 1.7 " + b + "\nparam a = 1.2 " + a +
                              "\ndx/dt = a\ny = b + x\ninitial x = 0 fixed\n",
                          "lines.ode");
}

}  // namespace lacuna::support
