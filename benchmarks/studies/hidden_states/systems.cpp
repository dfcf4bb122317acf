// SPDX-License-Identifier: MIT
#include "systems.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/random.hpp"
#include "lacuna/core/numerics/sampled_signal.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::hidden_states {
namespace {

OdeModel model_of(std::string text, const std::string& name) {
  std::replace(text.begin(), text.end(), ';', '\n');
  return parse_ode(text, name);
}

/// A sum of six sines about the middle of the range.
Matrix driving(const System& system, Index inputs, Index samples, Random& random) {
  Matrix u(samples, inputs);
  for (Index j = 0; j < inputs; ++j) {
    Vector sum = Vector::Zero(samples);
    for (const double fraction : {1.0, 0.61, 0.37, 2.3, 0.23, 0.5}) {
      const double phase = 2.0 * std::numbers::pi * random.uniform();
      const double amplitude = 0.5 + random.uniform();
      for (Index i = 0; i < samples; ++i)
        sum[i] += amplitude * std::sin(2.0 * std::numbers::pi * static_cast<double>(i) *
                                           system.step / (fraction * system.period) +
                                       phase);
    }
    const double middle = 0.5 * (system.low + system.high);
    u.col(j) =
        middle + 0.5 * (system.high - system.low) / sum.cwiseAbs().maxCoeff() * sum.array();
  }
  return u;
}

/// The states (n x m) of the true system along an input that is straight between samples.
Matrix simulated(const OdeModel& truth, const System& system, const Matrix& u,
                 const Vector& start) {
  const Vector time = sample_times(0.0, system.step, u.rows());
  const auto input = [&](double t, double* value) {
    const Index i = std::clamp<Index>(static_cast<Index>(t / system.step), 0, u.rows() - 2);
    const double s = t / system.step - static_cast<double>(i);
    for (Index j = 0; j < u.cols(); ++j) value[j] = (1.0 - s) * u(i, j) + s * u(i + 1, j);
  };
  Rk4Options fine;
  fine.substeps = 20;
  const Solution solution = simulate(DrivenModel{truth, input}, rk4(fine), start, time);
  return solution.states;
}

Dataset record_with(const System& system, double noise, Index samples, std::uint64_t seed,
                    double from) {
  const OdeModel truth = model_of(system.truth, system.name);
  Random random(seed);
  const Matrix u = driving(system, static_cast<Index>(truth.inputs().size()), samples, random);
  Vector start =
      Eigen::Map<const Vector>(system.start.data(), static_cast<Index>(system.start.size()));
  start *= from;
  const Matrix states = simulated(truth, system, u, start);
  Dataset data;
  data.time_unit = truth.time_unit();
  data.inputs = truth.inputs();
  Matrix seen(samples, static_cast<Index>(system.measured.size()));
  for (Index c = 0; c < seen.cols(); ++c) {
    const std::string& name = system.measured[static_cast<std::size_t>(c)];
    data.states.push_back({name, ""});
    seen.col(c) = states.col(truth.state_index(name));
    const double deviation =
        std::sqrt((seen.col(c).array() - seen.col(c).mean()).square().mean());
    for (Index i = 0; i < samples; ++i) seen(i, c) += noise * deviation * random.normal();
  }
  Trajectory record;
  record.source = system.name;
  record.time = sample_times(0.0, system.step, samples);
  record.states = seen;
  record.inputs = u;
  data.trajectories.push_back(std::move(record));
  return data;
}

}  // namespace

OdeModel nominal_of(const System& system) {
  const OdeModel model = model_of(system.nominal, system.name);
  Random random(7);
  std::vector<Equation> equations = model.equations();
  for (Index k = 0; k < model.dimension(); ++k) {
    if (identity_of(model, k)) continue;
    for (WeightedTerm& summand : equations[static_cast<std::size_t>(k)])
      if (!summand.fixed) summand.coefficient *= 1.0 + 0.15 * (2.0 * random.uniform() - 1.0);
  }
  return model.with_equations(std::move(equations));
}

Records make_records(const System& system, double noise, std::uint64_t seed) {
  return {record_with(system, noise, system.samples, 2 * seed, 1.0),
          record_with(system, noise, system.samples / 2, 2 * seed + 1, 0.8)};
}

}  // namespace lacuna::hidden_states
