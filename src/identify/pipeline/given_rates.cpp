// SPDX-License-Identifier: MIT
#include "given_rates.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "fit_doubts.hpp"
#include "lacuna/data/records/noise.hpp"

namespace lacuna {
namespace {

/// The derivatives in the place of the states.
Dataset rates_of(const Dataset& data) {
  Dataset rates;
  rates.time_unit = data.time_unit;
  rates.states = data.states;
  for (const Trajectory& record : data.trajectories)
    rates.trajectories.push_back({record.source, record.time, record.derivatives,
                                  Matrix(record.samples(), 0), Matrix()});
  return rates;
}

/// Root mean squares.
Vector sizes_of_rates(const Dataset& data) {
  Vector squares = Vector::Zero(data.state_count());
  for (const Trajectory& record : data.trajectories)
    squares += record.derivatives.colwise().squaredNorm().transpose();
  return (squares / static_cast<double>(data.samples())).cwiseSqrt();
}

/// Mean square of sum_j df_k/dx_j sigma_j over the samples; delays hold the present.
Vector squares_through_rates(const OdeModel& model, const Dataset& data,
                             const Vector& state_noise) {
  const Index m = model.dimension();
  Vector squares = Vector::Zero(m);
  CompiledModel compiled = model.compile();
  if (!compiled.delays().empty() || !(state_noise.maxCoeff() > 0.0)) return squares;
  Matrix slopes(m, m);
  for (const Trajectory& record : data.trajectories)
    for (Index n = 0; n < record.samples(); ++n) {
      const Vector x = record.states.row(n), u = record.inputs.row(n);
      compiled.jacobian(record.time[n], x.data(), u.data(), nullptr, slopes);
      squares += (slopes * state_noise.asDiagonal()).rowwise().squaredNorm();
    }
  return squares / static_cast<double>(data.samples());
}

}  // namespace

bool has_given_rates(const Dataset& data) {
  return data.has_derivatives() && data.rate_of.empty();
}

Vector noise_of_given_rates(const OdeModel& model, const Dataset& data,
                            const Vector& state_noise) {
  const Vector own =
      estimate_noise(rates_of(data)).cwiseMax(kRoundingOfRates * sizes_of_rates(data));
  return (own.array().square() + squares_through_rates(model, data, state_noise).array())
      .sqrt();
}

void note_floors_of_given_rates(const OdeModel& model, const Dataset& data,
                                const Vector& state_noise, std::vector<EquationFit>& fits) {
  const Vector noise = noise_of_given_rates(model, data, state_noise);
  const Vector rounding = kRoundingOfRates * sizes_of_rates(data);
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const auto state = static_cast<Index>(k);
    if (fits[k].residual_rms > kFitsBelow * noise[state])
      fits[k].noise_floor = noise[state];
    else if (fits[k].residual_rms <= kFitsBelow * rounding[state])
      fits[k].noise_floor = rounding[state];
  }
}

}  // namespace lacuna
