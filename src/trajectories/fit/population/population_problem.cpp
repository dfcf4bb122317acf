// SPDX-License-Identifier: MIT
#include "population_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace lacuna {
namespace {

/// The parameters that vary, in the order of the parametrised model.
std::vector<VaryingParameter> varying_of(const SystemModel& system, const FitEngine& engine) {
  std::vector<VaryingParameter> varying;
  auto place = static_cast<Index>(engine.model.coefficients().size());
  for (const Parameter& parameter : system.parameters()) {
    if (!parameter.free) continue;
    if (const auto& spread = parameter.varies)
      varying.push_back({place, spread->by_factor,
                         spread->by_factor ? std::log(spread->size) : spread->size});
    ++place;
  }
  return varying;
}

/// The sizes of noise that are neither given by a law nor by columns of the records.
std::vector<NoiseSize> sizes_of(const FitEngine& engine) {
  std::vector<NoiseSize> sizes;
  for (Index c = 0; c < engine.count(); ++c) {
    const auto& law = engine.laws[static_cast<std::size_t>(c)];
    const Matrix& known = engine.records.deviations;
    if (law) {
      const NoiseLaw& given = law->law();
      if (has_constant(given.form) && !given.constant)
        sizes.push_back({c, NoiseSize::Kind::Constant});
      if (has_fraction(given.form) && !given.fraction)
        sizes.push_back({c, NoiseSize::Kind::Fraction});
    } else if (known.size() == 0 || !(known.col(c).maxCoeff() > 0.0)) {
      sizes.push_back({c, NoiseSize::Kind::Sigma});
    }
  }
  return sizes;
}

}  // namespace

double VaryingParameter::value(double typical, double spread, double deviation) const {
  return by_factor ? typical * std::exp(spread * deviation) : typical + spread * deviation;
}

double VaryingParameter::by_deviation(double typical, double spread, double deviation) const {
  return by_factor ? spread * value(typical, spread, deviation) : spread;
}

double VaryingParameter::by_typical(double spread, double deviation) const {
  return by_factor ? std::exp(spread * deviation) : 1.0;
}

double VaryingParameter::deviation_at(double bound, double typical, double spread) const {
  const double way = by_factor ? std::log(std::max(bound, 0.0) / typical) : bound - typical;
  return spread > 0.0 ? way / spread
                      : std::copysign(std::numeric_limits<double>::infinity(), way);
}

Index PopulationProblem::first_deviation() const {
  return static_cast<Index>(free_starts.size() + unknowns.local.size());
}

Index PopulationProblem::own() const {
  return first_deviation() + static_cast<Index>(varying.size());
}

PopulationProblem population_problem(const SystemModel& system, const FitEngine& engine,
                                     FitUnknowns unknowns) {
  PopulationProblem problem{std::move(unknowns), varying_of(system, engine), sizes_of(engine),
                            {}};
  for (std::size_t k = 0; k < problem.unknowns.initial.size(); ++k) {
    const auto& initial = problem.unknowns.initial[k];
    if (!(initial && initial->fixed)) problem.free_starts.push_back(static_cast<Index>(k));
  }
  return problem;
}

Vector noise_sizes(const FitEngine& engine, const std::vector<NoiseSize>& sizes) {
  Vector values(static_cast<Index>(sizes.size()));
  for (Index i = 0; i < values.size(); ++i) {
    const NoiseSize& size = sizes[static_cast<std::size_t>(i)];
    const auto& law = engine.laws[static_cast<std::size_t>(size.channel)];
    values[i] = size.kind == NoiseSize::Kind::Sigma      ? engine.sigma[size.channel]
                : size.kind == NoiseSize::Kind::Constant ? *law->sized().constant
                                                         : *law->sized().fraction;
  }
  return values;
}

void set_noise_sizes(const std::vector<NoiseSize>& sizes, const Vector& values,
                     FitEngine& engine) {
  for (Index i = 0; i < values.size(); ++i) {
    const NoiseSize& size = sizes[static_cast<std::size_t>(i)];
    if (size.kind == NoiseSize::Kind::Sigma) {
      engine.sigma[size.channel] = values[i];
      continue;
    }
    ChannelNoise& law = *engine.laws[static_cast<std::size_t>(size.channel)];
    const NoiseLaw now = law.sized();
    const bool constant = size.kind == NoiseSize::Kind::Constant;
    law.set_sizes(constant ? values[i] : now.constant.value_or(1.0),
                  constant ? now.fraction.value_or(1.0) : values[i]);
  }
}

double record_log_likelihood(const FitEngine& engine, const FitPath& path, Index record) {
  double sum = 0.0;
  for (Index n = engine.records.first(record); n < engine.records.end(record); ++n) {
    if (!path.states.row(n).allFinite()) return -std::numeric_limits<double>::infinity();
    for (Index c = 0; c < engine.count(); ++c) {
      if (engine.records.valid(n, c) == 0.0) continue;
      const double value = engine.records.values(n, c), residual = path.residuals(n, c);
      const auto& law = engine.laws[static_cast<std::size_t>(c)];
      const double sigma = deviation_of(engine, n, c);
      sum += law ? law->log_likelihood(value, value - residual)
                 : -0.5 * std::log(2.0 * std::numbers::pi) - std::log(sigma) -
                       0.5 * std::pow(residual / sigma, 2);
    }
  }
  return sum;
}

}  // namespace lacuna
