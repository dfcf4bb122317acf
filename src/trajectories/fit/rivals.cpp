// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {
namespace {

/// Log-likelihood of each record: that of the population where there is one.
Vector by_records(const Fit& fit) {
  Vector all = Vector::Zero(static_cast<Index>(fit.runs.size()));
  for (std::size_t r = 0; r < fit.runs.size(); ++r) {
    double& sum = all[static_cast<Index>(r)];
    if (fit.population) sum = fit.population->log_likelihood[r];
    else
      for (const double value : fit.runs[r].log_likelihood.reshaped())
        if (std::isfinite(value)) sum += value;
  }
  return all;
}

/// Log-likelihood of each value, channel by channel, records one behind the other.
Vector by_values(const Fit& fit) {
  std::vector<double> all;
  for (Index c = 0; c < static_cast<Index>(fit.quality.size()); ++c)
    for (const FitRun& run : fit.runs)
      for (const double likelihood : run.log_likelihood.col(c))
        if (std::isfinite(likelihood)) all.push_back(likelihood);
  return Eigen::Map<const Vector>(all.data(), static_cast<Index>(all.size()));
}

/// Neighbours with which values may be correlated: the cube root of n; records are independent.
Index lags_of(const Vector& values, bool are_records) {
  return are_records ? 0 : static_cast<Index>(std::cbrt(static_cast<double>(values.size())));
}

/// Deviation of a sum of values that are correlated with neighbours: Newey and West.
double deviation_of_sum(const Vector& values, Index lags) {
  const Vector centred = values.array() - values.mean();
  double variance = centred.squaredNorm();
  for (Index lag = 1; lag <= lags; ++lag) {
    const double weight = 1.0 - static_cast<double>(lag) / static_cast<double>(lags + 1);
    variance += 2.0 * weight *
                centred.tail(values.size() - lag).dot(centred.head(values.size() - lag));
  }
  return std::sqrt(std::max(variance, 0.0));
}

FitRival rival_of(const NamedFit& named, const Vector& each, double n) {
  const Fit& fit = named.fit;
  FitRival rival{.name = named.name};
  rival.unknowns = n - fit.degrees_of_freedom;
  for (const FitQuality& quality : fit.quality)
    rival.unknowns += static_cast<double>(quality.sizes);
  const double k = rival.unknowns;
  rival.log_likelihood = each.sum();
  rival.aicc = -2.0 * rival.log_likelihood + 2.0 * k +
               2.0 * k * (k + 1.0) / std::max(1.0, n - k - 1.0);
  rival.bic = -2.0 * rival.log_likelihood + k * std::log(n);
  if (fit.gap) rival.held_out = fit.gap->after;
  rival.fits = fit.adequacy.fits;
  rival.converged = fit.converged;
  return rival;
}

void check_alike(const NamedFit& first, const NamedFit& other) {
  bool alike = first.fit.quality.size() == other.fit.quality.size();
  for (std::size_t c = 0; alike && c < first.fit.quality.size(); ++c)
    alike = first.fit.quality[c].channel == other.fit.quality[c].channel &&
            first.fit.quality[c].samples == other.fit.quality[c].samples;
  if (alike) return;
  throw DataError(other.name, "it is not compared with the same columns as " + first.name,
                  "give models with outputs of the same names");
}

/// Sets how far a rival is behind the best.
void set_behind(const FitRival& best, const Vector& of_best, const Vector& own, Index lags,
                FitRival& rival) {
  constexpr double kSupported = 2.0;  // a difference in AICc that leaves a model well supported
  const Vector difference = of_best - own;
  const double deviation = deviation_of_sum(difference, lags);
  rival.behind = deviation > 0.0 ? difference.sum() / deviation : 0.0;
  rival.is_tied =
      rival.aicc - best.aicc <= kSupported || rival.behind < kNormalQuantile975;
}

/// The notes that all fits have.
std::vector<std::string> common_notes(const std::vector<NamedFit>& fits) {
  std::vector<std::string> common;
  for (const std::string& note : fits.front().fit.notes)
    if (std::all_of(fits.begin(), fits.end(), [&](const NamedFit& one) {
          const std::vector<std::string>& notes = one.fit.notes;
          return std::find(notes.begin(), notes.end(), note) != notes.end();
        }))
      common.push_back(note);
  return common;
}

}  // namespace

RivalComparison compare_fits(const std::vector<NamedFit>& fits) {
  check_argument(!fits.empty(), "compare_fits", "there is no fit");
  const bool are_records = std::any_of(fits.begin(), fits.end(), [](const NamedFit& one) {
    return one.fit.population.has_value();
  });
  const auto values = static_cast<double>(by_values(fits.front().fit).size());
  std::vector<Vector> each;
  std::vector<FitRival> rivals;
  for (const NamedFit& named : fits) {
    check_alike(fits.front(), named);
    each.push_back(are_records ? by_records(named.fit) : by_values(named.fit));
    rivals.push_back(rival_of(named, each.back(), values));
  }
  const Index lags = lags_of(each.front(), are_records);
  const auto best = static_cast<std::size_t>(
      std::min_element(rivals.begin(), rivals.end(),
                       [](const FitRival& a, const FitRival& b) { return a.aicc < b.aicc; }) -
      rivals.begin());
  for (std::size_t i = 0; i < rivals.size(); ++i)
    if (i != best) set_behind(rivals[best], each[best], each[i], lags, rivals[i]);
  std::stable_sort(rivals.begin(), rivals.end(),
                   [](const FitRival& a, const FitRival& b) { return a.aicc < b.aicc; });
  return {std::move(rivals), values, common_notes(fits)};
}

}  // namespace lacuna
