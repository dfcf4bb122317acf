// SPDX-License-Identifier: MIT
#include "data/derivatives/trend_choice.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/check.hpp"
#include "data/derivatives/l1_trend.hpp"
#include "data/derivatives/sample_differences.hpp"

namespace lacuna {
namespace {

struct Trial {
  double weight = 0.0, score = 0.0, knots = 0.0;
};

Trial tried(const SparseRows& differences, const Matrix& values, const Vector& noise,
            double weight) {
  Trial trial{weight, 0.0, 0.0};
  for (Index k = 0; k < noise.size(); ++k) {
    if (!(noise[k] > 0.0)) continue;
    const L1Trend trend = l1_trend(differences, values.col(k), weight * noise[k]);
    const auto knots = static_cast<double>(trend.knots);
    trial.knots += knots;
    trial.score += (values.col(k) - trend.values).squaredNorm() / (noise[k] * noise[k]) +
                   2.0 * (knots + static_cast<double>(values.rows() - differences.rows()));
  }
  return trial;
}

/// The weight that joins so many samples (see joined_samples()).
double weight_for(double samples, int order) { return 2.0 * std::pow(samples, order - 0.5); }

}  // namespace

ScaledDifferences scaled_differences(const Vector& time, int order) {
  check_argument(time.size() > 1, "scaled_differences", "there are fewer than two times");
  const double step = (time[time.size() - 1] - time[0]) / static_cast<double>(time.size() - 1);
  return {step, divided_differences((time.array() - time[0]).matrix() / step, order)};
}

TrendChoice choose_trend(const SparseRows& differences, const Matrix& values,
                         const Vector& noise) {
  check_argument(differences.cols() == values.rows() && noise.size() == values.cols(),
                 "choose_trend", "the differences or the noise do not fit the samples");
  // Decisions: a tenth of the noise changes nothing; C_p hardly changes from one to the next.
  constexpr double kLeast = 0.2, kRatio = 2.5;
  const auto order = static_cast<int>(values.rows() - differences.rows());
  std::vector<Trial> trials;
  const double most = weight_for(static_cast<double>(values.rows()), order);
  for (double weight = kLeast; weight <= most; weight *= kRatio)
    trials.push_back(tried(differences, values, noise, weight));
  const Trial best = *std::min_element(
      trials.begin(), trials.end(),
      [](const Trial& a, const Trial& b) { return a.score < b.score; });
  TrendChoice chosen{best.weight, best.score};
  for (const Trial& trial : trials) {
    const double chance = std::sqrt(2.0 * std::max(best.knots - trial.knots, 0.0));
    if (trial.score <= best.score + chance) chosen.weight = std::max(chosen.weight, trial.weight);
  }
  return chosen;
}

double joined_samples(double weight, int order) {
  return std::pow(0.5 * weight, 1.0 / (order - 0.5));
}

}  // namespace lacuna
