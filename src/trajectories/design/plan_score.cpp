// SPDX-License-Identifier: MIT
#include "plan_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "precision.hpp"

namespace lacuna {
namespace {

double rivals_score(const ScoreTerms& terms, const Rivals& rivals, const DesignEvidence& evidence) {
  double least = std::numeric_limits<double>::infinity(), sum = 0.0;
  for (std::size_t i = 0; i < rivals.runs.size(); ++i)
    for (std::size_t j = 0; j < rivals.runs.size(); ++j) {
      if (i == j) continue;
      const Distinction found = distinction_of(rivals, evidence, i, j, terms.decisive);
      least = std::min(least, found.log_bayes_factor);
      sum += rivals.weights[i] * (terms.rivals == RivalCriterion::BoxHill
                                      ? rivals.weights[j] * found.log_bayes_factor
                                      : found.distance);
    }
  return terms.rivals == RivalCriterion::BayesFactor ? least : sum;
}

double parameters_score(const ScoreTerms& terms, const Rivals& rivals,
                        const DesignEvidence& evidence) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rivals.runs.size(); ++i) {
    if (terms.precision == PrecisionCriterion::Chosen && terms.chosen[i].empty()) continue;
    sum += rivals.weights[i] *
           precision_of({rivals.knowledge[i].information, evidence.models[i].information},
                        sizes_of(rivals.runs[i].values), terms.precision, terms.chosen[i]);
  }
  return sum;
}

}  // namespace

ScoreTerms score_terms(const PlanProblem& problem, const PlanOptions& options,
                       const Rivals& rivals) {
  ScoreTerms terms{rivals.runs.size() > 1 ? options.aim : PlanAim::Parameters, options.rivals,
                   options.precision, options.decisive};
  std::vector<std::string> all;
  terms.chosen.resize(rivals.runs.size());
  std::vector<bool> found(options.parameters.size(), false);
  for (std::size_t i = 0; i < rivals.runs.size(); ++i) {
    const std::vector<std::string> names = rivals.runs[i].engine.model.names();
    all.insert(all.end(), names.begin(), names.end());
    for (std::size_t k = 0; k < options.parameters.size(); ++k) {
      const auto own = std::find(names.begin(), names.end(), options.parameters[k]);
      if (own == names.end()) continue;
      found[k] = true;
      terms.chosen[i].push_back(own - names.begin());
    }
  }
  for (std::size_t k = 0; k < found.size(); ++k)
    if (!found[k])
      throw ArgumentError("parameter " + options.parameters[k],
                          problem.models.size() == 1 ? "the model has no such free number"
                                                     : "no model has such a free number",
                          suggestion(options.parameters[k], all));
  if (!options.parameters.empty()) terms.precision = PrecisionCriterion::Chosen;
  return terms;
}

double score_of(const ScoreTerms& terms, const Rivals& rivals, const DesignEvidence& evidence) {
  if (!evidence.is_finite) return -std::numeric_limits<double>::infinity();
  if (terms.aim == PlanAim::Parameters) return parameters_score(terms, rivals, evidence);
  const double distinguished = rivals_score(terms, rivals, evidence);
  if (terms.aim == PlanAim::Rivals) return distinguished;
  // Twice what decides leaves room for what linearisation misses; beyond it numbers count, half
  // of the log determinant being their information.
  const double enough = 2.0 * terms.decisive;
  return std::min(distinguished, enough) + 0.5 * parameters_score(terms, rivals, evidence);
}

}  // namespace lacuna
