// SPDX-License-Identifier: MIT
#include "coefficient_changes.hpp"

#include <algorithm>
#include <cmath>

#include "identifiability.hpp"
#include "lacuna/trajectories/smoother/disturbance_test.hpp"
#include "trajectories/smoother/innovation_system.hpp"

namespace lacuna {
namespace {

const WeightedTerm& term_at(const OdeModel& model, const CoefficientPlace& place) {
  return model.equations()[static_cast<std::size_t>(place.equation)]
                          [static_cast<std::size_t>(place.term)];
}

/// Standard error of free coefficient j.
double deviation_of(const Assimilation& fit, std::size_t j) {
  const auto row = static_cast<Index>(j);
  return std::sqrt(std::max(0.0, fit.covariance(row, row)));
}

}  // namespace

std::vector<CoefficientChange> coefficient_changes(const OdeModel& nominal,
                                                   const Assimilation& fit, std::size_t count) {
  std::vector<CoefficientChange> changes;
  for (std::size_t j = 0; j < count; ++j) {
    const CoefficientPlace& place = fit.free[j];
    const WeightedTerm& before = term_at(nominal, place);
    const double now = term_at(fit.model, place).coefficient;
    const double deviation = deviation_of(fit, j);
    const bool determined = !is_held(fit, static_cast<Index>(j));
    const double sigma =
        determined && deviation > 0.0 ? std::abs(now - before.coefficient) / deviation : 0.0;
    changes.push_back({place.equation, before.term.name(), before.coefficient, now,
                       determined ? deviation : 0.0, sigma, determined});
  }
  std::stable_sort(changes.begin(), changes.end(),
                   [](const auto& a, const auto& b) { return a.sigma > b.sigma; });
  return changes;
}

double largest_rate_change(const OdeModel& nominal, const Assimilation& fit) {
  const Vector rates = rate_rms(fit);
  double largest = 0.0;
  for (Index k = 0; k < nominal.dimension(); ++k) {
    double sum = 0.0, count = 0.0;
    const Equation& before = nominal.equations()[static_cast<std::size_t>(k)];
    const Equation& after = fit.model.equations()[static_cast<std::size_t>(k)];
    for (const LinearisedRecord& record : fit.records) {
      Vector change = Vector::Zero(record.slots.rows());
      for (std::size_t j = 0; j < before.size(); ++j)
        change += (after[j].coefficient - before[j].coefficient) *
                  evaluate_on(record, nominal.variables(), before[j].term.expression());
      sum += change.squaredNorm();
      count += static_cast<double>(change.size());
    }
    if (rates[k] > 0.0) largest = std::max(largest, std::sqrt(sum / count) / rates[k]);
  }
  return largest;
}

OdeModel with_intervals(const Assimilation& fit) {
  std::vector<Equation> equations = fit.model.equations();
  for (std::size_t j = 0; j < fit.free.size(); ++j) {
    WeightedTerm& summand = equations[static_cast<std::size_t>(fit.free[j].equation)]
                                     [static_cast<std::size_t>(fit.free[j].term)];
    const double deviation = deviation_of(fit, j);
    if (is_held(fit, static_cast<Index>(j)) || !(deviation > 0.0)) continue;
    summand.standard_error = deviation;
    summand.ci95 = {
        {summand.coefficient - 1.96 * deviation, summand.coefficient + 1.96 * deviation}};
  }
  return {fit.model.states(), fit.model.inputs(), std::move(equations), fit.model.time_unit()};
}

}  // namespace lacuna
