// SPDX-License-Identifier: MIT
#include "coefficient_changes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/statistics/significance.hpp"
#include "identifiability.hpp"
#include "lacuna/core/statistics/interval.hpp"
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

/// The best combination of two free coefficients; `sigma` is not yet that among all pairs.
std::optional<CombinedChange> combination_of(const OdeModel& nominal, const Assimilation& fit,
                                             std::size_t i, std::size_t j) {
  constexpr double kCollinear = 1e-10;  // a fact of arithmetic: beyond it the inverse is rounding
  const auto row = static_cast<Index>(i), column = static_cast<Index>(j);
  const double ii = fit.covariance(row, row), jj = fit.covariance(column, column),
               ij = fit.covariance(row, column), determinant = ii * jj - ij * ij;
  if (!(determinant > kCollinear * ii * jj)) return std::nullopt;
  const WeightedTerm &a = term_at(nominal, fit.free[i]), &b = term_at(nominal, fit.free[j]);
  const double of_a = term_at(fit.model, fit.free[i]).coefficient,
               of_b = term_at(fit.model, fit.free[j]).coefficient;
  const double da = of_a - a.coefficient, db = of_b - b.coefficient;
  const double wa = (jj * da - ij * db) / determinant, wb = (ii * db - ij * da) / determinant;
  if (wa == 0.0) return std::nullopt;
  const double weight = wb / wa;
  return CombinedChange{fit.free[i].equation,
                        a.term.name(),
                        b.term.name(),
                        weight,
                        a.coefficient + weight * b.coefficient,
                        of_a + weight * of_b,
                        std::sqrt(ii + 2.0 * weight * ij + weight * weight * jj),
                        std::sqrt(std::max(0.0, wa * da + wb * db))};
}

}  // namespace

std::optional<CombinedChange> combined_change(const OdeModel& nominal, const Assimilation& fit,
                                              std::size_t count, double significance) {
  for (const CoefficientChange& change : coefficient_changes(nominal, fit, count))
    if (change.sigma >= significance) return std::nullopt;
  std::optional<CombinedChange> best;
  double pairs = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      if (fit.free[i].equation != fit.free[j].equation || is_held(fit, static_cast<Index>(i)) ||
          is_held(fit, static_cast<Index>(j)))
        continue;
      ++pairs;
      auto next = combination_of(nominal, fit, i, j);
      if (next && (!best || next->sigma > best->sigma)) best = std::move(next);
    }
  if (!best) return std::nullopt;
  best->sigma = sigma_of_gain(best->sigma * best->sigma, 2.0, pairs);
  return best->sigma >= significance ? best : std::nullopt;
}

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
    summand.ci95 = interval95(summand.coefficient, deviation);
  }
  return fit.model.with_equations(std::move(equations));
}

}  // namespace lacuna
