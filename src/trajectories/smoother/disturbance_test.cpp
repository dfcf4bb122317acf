// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/smoother/disturbance_test.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/parallel.hpp"
#include "core/statistics/significance.hpp"
#include "trajectories/smoother/variance_fit.hpp"

namespace lacuna {
namespace {

const Matrix kNothingOmitted;

const Matrix& omitted_of(const Assimilation& fit, std::size_t record) {
  return fit.omitted.empty() ? kNothingOmitted : fit.omitted[record];
}

/// Deviance with the variances that fit best; without the disturbance of an equation, if one is
/// given.
double least_deviance(const Assimilation& fit, std::optional<Index> without) {
  // A fact of the search: what further ones move no test would notice.
  constexpr int kIterations = 30;
  NoiseModel noise = fit.noise;
  if (without) noise.disturbance[*without] = 0.0;
  return VarianceFit(fit.least_noise)
      .run({fit.records, fit.measured, fit.omitted}, noise, kIterations)
      .deviance;
}

/// log of half the tail of chi-squared with one degree of freedom.
double boundary_sigma(double drop) {
  return drop > 0.0 ? sigma_of_log_probability(log_chi_squared_tail(drop, 1.0) - std::log(2.0))
                    : 0.0;
}

/// Where an effect is not known yet the disturbance is its stand-in and nothing that is left.
Vector disturbance_rms(const Assimilation& fit) {
  const Index m = fit.model.dimension();
  Vector squares = Vector::Zero(m), count = Vector::Zero(m);
  for (std::size_t r = 0; r < fit.records.size(); ++r) {
    const Matrix disturbance = disturbance_along(fit, r);
    for (Index k = 0; k < m; ++k)
      for (Index i = 0; i < disturbance.rows(); ++i) {
        if (fit.records[r].is_bridged(i, k)) continue;
        squares[k] += disturbance(i, k) * disturbance(i, k);
        count[k] += 1.0;
      }
  }
  return squares.cwiseQuotient(count.cwiseMax(1.0)).cwiseSqrt();
}

}  // namespace

Matrix disturbance_along(const Assimilation& fit, std::size_t record) {
  return smooth(fit.records[record], fit.measured[record], omitted_of(fit, record), fit.noise)
      .disturbance;
}

Vector rate_rms(const Assimilation& fit) {
  const Index m = fit.model.dimension();
  Vector sum = Vector::Zero(m);
  Index count = 0;
  for (const LinearisedRecord& record : fit.records) {
    // The path's own change, so that delayed terms need no special care.
    const Matrix change =
        record.path.bottomRows(record.steps()) - record.path.topRows(record.steps());
    const Vector length = record.time.tail(record.steps()) - record.time.head(record.steps());
    sum += (length.cwiseInverse().asDiagonal() * change).colwise().squaredNorm().transpose();
    count += record.steps();
  }
  return (sum / static_cast<double>(count)).cwiseSqrt();
}

double total_disturbance(const Assimilation& fit, const Vector& rates) {
  double sum = 0.0;
  for (Index k = 0; k < rates.size(); ++k)
    if (rates[k] > 0.0) sum += std::pow(fit.noise.disturbance[k] / rates[k], 2);
  return sum;
}

double fraction_closed(const Assimilation& before, const Assimilation& after) {
  const Vector rates = rate_rms(before);
  const double had = total_disturbance(before, rates);
  return had > 0.0 ? std::clamp(1.0 - total_disturbance(after, rates) / had, 0.0, 1.0) : 1.0;
}

std::vector<EquationStructure> test_disturbances(const Assimilation& fit,
                                                 const RunContext& context) {
  std::vector<Index> disturbed;
  for (Index k = 0; k < fit.model.dimension(); ++k)
    if (fit.noise.disturbance[k] != 0.0) disturbed.push_back(k);
  double now = 0.0;
  std::vector<double> without(disturbed.size());
  parallel_for(disturbed.size() + 1, context.threads, [&](std::size_t i) {
    context.check_stop();
    if (i == disturbed.size())
      now = least_deviance(fit, {});
    else
      without[i] = least_deviance(fit, disturbed[i]);
  });
  const Vector rates = rate_rms(fit), rms = disturbance_rms(fit);
  std::vector<EquationStructure> result;
  for (std::size_t i = 0; i < disturbed.size(); ++i) {
    const Index k = disturbed[i];
    EquationStructure structure{k, 0.0, 0.0, rms[k], 0.0};
    structure.drop = std::max(0.0, without[i] - now);
    structure.sigma = boundary_sigma(structure.drop);
    structure.relative = rates[k] > 0.0 ? structure.rms / rates[k] : 0.0;
    result.push_back(structure);
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const auto& a, const auto& b) { return a.drop > b.drop; });
  return result;
}

}  // namespace lacuna
