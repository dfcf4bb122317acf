// SPDX-License-Identifier: MIT
#include "trajectories/smoother/timing_jitter.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lacuna/data/records/marks.hpp"

namespace lacuna {
namespace {

/// Residuals of the channels in deviations of their noise and rates in these per time unit, for
/// samples at which all channels have values.
struct Residuals {
  std::vector<Index> channels;  ///< states
  Matrix off, rate;             ///< channels x samples
};

bool all_values(const Assimilation& fit, std::size_t r, Index i,
                const std::vector<Index>& channels) {
  return fit.omitted.empty() || std::all_of(channels.begin(), channels.end(), [&](Index k) {
           return mark_of(fit.omitted[r], i, k) == Mark::Value;
         });
}

/// Samples that have a neighbour on either side.
std::vector<std::pair<std::size_t, Index>> inner_samples(const Assimilation& fit,
                                                         const std::vector<Index>& channels) {
  std::vector<std::pair<std::size_t, Index>> places;
  for (std::size_t r = 0; r < fit.records.size(); ++r)
    for (Index i = 1; i + 1 < fit.records[r].samples(); ++i)
      if (all_values(fit, r, i, channels)) places.emplace_back(r, i);
  return places;
}

Residuals residuals_of(const Assimilation& fit) {
  Residuals result;
  for (std::size_t k = 0; k < fit.noise.measurement.size(); ++k)
    if (fit.noise.measurement[k]) result.channels.push_back(static_cast<Index>(k));
  const auto places = inner_samples(fit, result.channels);
  const auto count = static_cast<Index>(result.channels.size());
  result.off.resize(count, static_cast<Index>(places.size()));
  result.rate = result.off;
  for (Index c = 0; c < count; ++c) {
    const Index k = result.channels[static_cast<std::size_t>(c)];
    const double deviation = *fit.noise.measurement[static_cast<std::size_t>(k)];
    for (std::size_t p = 0; p < places.size(); ++p) {
      const auto& [r, i] = places[p];
      const LinearisedRecord& record = fit.records[r];
      const auto column = static_cast<Index>(p);
      result.off(c, column) = (fit.measured[r](i, k) - record.path(i, k)) / deviation;
      result.rate(c, column) = (record.path(i + 1, k) - record.path(i - 1, k)) /
                               (record.time[i + 1] - record.time[i - 1]) / deviation;
    }
  }
  return result;
}

}  // namespace

TimingJitter timing_jitter(const Assimilation& fit) {
  const Residuals residuals = residuals_of(fit);
  if (residuals.off.cols() < 2) return {};
  double inner = 0.0, information = 0.0;
  for (Index j = 0; j < residuals.off.rows(); ++j)
    for (Index k = 0; k <= j; ++k) {
      const Vector y = residuals.off.row(j).cwiseProduct(residuals.off.row(k)).transpose();
      const Vector x = residuals.rate.row(j).cwiseProduct(residuals.rate.row(k)).transpose();
      const Vector varied = x.array() - x.mean();
      const double variance = j == k ? 2.0 : 1.0;
      inner += varied.dot(y) / variance;
      information += varied.squaredNorm() / variance;
    }
  if (!(inner > 0.0) || !(information > 0.0)) return {};
  TimingJitter jitter;
  const double square = inner / information;
  jitter.deviation = std::sqrt(square);
  jitter.sigma = inner / std::sqrt(information);
  jitter.fraction = std::min(1.0, square * residuals.rate.rowwise().squaredNorm().maxCoeff() /
                                      static_cast<double>(residuals.rate.cols()));
  return jitter;
}

}  // namespace lacuna
