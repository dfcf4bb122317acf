// SPDX-License-Identifier: MIT
#include "diagnose/criterion/effect_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnose/candidates/candidate_column.hpp"
#include "lacuna/model/equations/rounding.hpp"
#include "lacuna/trajectories/smoother/disturbance_test.hpp"

namespace lacuna {
namespace {

/// Parts along one record, as columns.
Matrix parts_along(const Explanation& explanation, const OdeModel& nominal, Index equation,
                   const LinearisedRecord& record) {
  const Assimilation& fit = explanation.fit;
  const auto k = static_cast<std::size_t>(equation);
  std::vector<Vector> columns;
  for (const FittedEffect& effect : explanation.effects)
    if (effect.candidate.equation == equation && effect.candidate.place == Place::Rate)
      columns.push_back(effect_along(effect, fit, record));
  for (std::size_t j = 0; j < nominal.equations()[k].size(); ++j) {
    const WeightedTerm& given = nominal.equations()[k][j];
    const double more = fit.model.equations()[k][j].coefficient - given.coefficient;
    columns.push_back(more *
                      evaluate_on(record, fit.model.variables(), given.term.expression()));
  }
  Matrix parts(record.slots.rows(), static_cast<Index>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j)
    parts.col(static_cast<Index>(j)) = columns[j];
  return parts;
}

std::vector<std::string> terms_in(const Explanation& explanation, const OdeModel& nominal,
                                  Index equation) {
  std::vector<std::string> terms;
  for (const FittedEffect& effect : explanation.effects)
    if (effect.candidate.equation == equation && effect.candidate.place == Place::Rate)
      terms.push_back(readable_term(effect));
  for (const WeightedTerm& given : nominal.equations()[static_cast<std::size_t>(equation)])
    terms.push_back("the change of " + given.term.name());
  return terms;
}

}  // namespace

std::string readable_term(const FittedEffect& effect) {
  constexpr int kDigits = 4;  // more than shapes are known to
  const Expression form = bind_form(effect.candidate, as_span(effect.shapes));
  return with_rounded_numbers(form, kDigits).to_string();
}

Vector effect_along(const FittedEffect& effect, const Assimilation& fit,
                    const LinearisedRecord& record) {
  const Candidate candidate = without_clash(effect.candidate, fit.model.variables().names());
  return effect.coefficient *
         form_along(candidate, as_span(effect.shapes), fit.model.variables(), record);
}

AddedParts added_parts(const Explanation& explanation, const OdeModel& nominal,
                       Index equation) {
  AddedParts added{terms_in(explanation, nominal, equation)};
  added.effects = static_cast<Index>(
      added.terms.size() - nominal.equations()[static_cast<std::size_t>(equation)].size());
  const auto count = static_cast<Index>(added.terms.size());
  added.gram = Matrix::Zero(count, count);
  double samples = 0.0;
  for (const LinearisedRecord& record : explanation.fit.records) {
    const Matrix parts = parts_along(explanation, nominal, equation, record);
    added.gram += parts.transpose() * parts;
    samples += static_cast<double>(parts.rows());
  }
  added.gram /= samples;
  return added;
}

Cancellation largest_cancellation(const AddedParts& parts) {
  // A fact of cost: 2^12 sums. A model of more terms is looked at as far as its first ones.
  constexpr Index kMostParts = 12;
  const Index count = std::min(kMostParts, parts.gram.rows());
  Cancellation found;
  for (unsigned subset = 1; subset < (1u << count); ++subset) {
    Vector chosen = Vector::Zero(parts.gram.rows());
    for (Index j = 0; j < count; ++j) chosen[j] = (subset >> j) & 1u;
    const double largest = chosen.cwiseProduct(parts.gram.diagonal()).maxCoeff();
    const bool has_effect = chosen.head(std::min(count, parts.effects)).sum() > 0.0;
    if (chosen.sum() < 2.0 || !has_effect || !(largest > 0.0)) continue;
    const double sum = std::max(0.0, chosen.dot(parts.gram * chosen));
    const double left = std::sqrt(sum / largest);
    if (!(left < found.left)) continue;
    found = {left};
    for (Index j = 0; j < count; ++j)
      if (chosen[j] > 0.0) found.terms.push_back(parts.terms[static_cast<std::size_t>(j)]);
  }
  return found;
}

std::vector<MovedCoefficient> moved_coefficients(const Assimilation& fit,
                                                 const OdeModel& nominal, std::size_t free,
                                                 const DecisionOptions& decision) {
  std::vector<MovedCoefficient> moved;
  for (std::size_t j = 0; j < free; ++j) {
    const auto k = static_cast<std::size_t>(fit.free[j].equation);
    const auto term = static_cast<std::size_t>(fit.free[j].term);
    const auto row = static_cast<Index>(j);
    const WeightedTerm& before = nominal.equations()[k][term];
    const MovedCoefficient one{fit.free[j].equation, before.term.name(), before.coefficient,
                               fit.model.equations()[k][term].coefficient};
    const double given = std::abs(one.given), now = std::abs(one.fitted);
    const double error = std::sqrt(std::max(0.0, fit.covariance(row, row)));
    const bool out = (one.changes_sign() && now > decision.minor * given) ||
                     now > decision.out_of_scale * given;
    if (given > 0.0 && out && now >= decision.significance * error) moved.push_back(one);
  }
  return moved;
}

double apart(const Explanation& one, const Explanation& other, const OdeModel& nominal,
             Index equation) {
  for (const Explanation* each : {&one, &other})
    for (const FittedEffect& effect : each->effects)
      if (!effect.candidate.memory.empty()) return std::numeric_limits<double>::infinity();
  double sum = 0.0, samples = 0.0;
  for (const LinearisedRecord& record : other.fit.records) {
    const Vector difference = parts_along(one, nominal, equation, record).rowwise().sum() -
                              parts_along(other, nominal, equation, record).rowwise().sum();
    sum += difference.squaredNorm();
    samples += static_cast<double>(difference.size());
  }
  return std::sqrt(sum / samples) / rate_rms(other.fit)[equation];
}

double acting_fraction(const FittedEffect& effect, const Assimilation& fit, double of_largest) {
  std::vector<Vector> all;
  double largest = 0.0, acting = 0.0, samples = 0.0;
  for (const LinearisedRecord& record : fit.records) {
    all.push_back(effect_along(effect, fit, record).cwiseAbs());
    largest = std::max(largest, all.back().maxCoeff());
  }
  for (const Vector& values : all) {
    acting += static_cast<double>((values.array() > of_largest * largest).count());
    samples += static_cast<double>(values.size());
  }
  return acting / samples;
}

}  // namespace lacuna
