// SPDX-License-Identifier: MIT
// The nominal model brought onto records under given assumptions.
#include <cmath>
#include <utility>

#include "lacuna/core/error.hpp"
#include "lacuna/data/noise.hpp"
#include "lacuna/estimation/outlier_check.hpp"
#include "lacuna/hypotheses/problem.hpp"

namespace lacuna {
namespace {

/// Passes of a fit that starts from the baseline's, beside which little moves.
constexpr int kPassesFromBaseline = 8;

JointFitTask joint_fit(const Problem& problem, const Baseline& base) {
  return {base.records->data, problem.nominal, base.fit_options, problem.context};
}

}  // namespace

Baseline plain_baseline(const Problem& problem) {
  const auto& [nominal, records, options, context] = problem;
  context.report("bringing the model onto the records", 0.0);
  Assimilation given = assimilate(nominal, records.data, records.outliers, {}, context);
  OutlierCheck outliers = check_outliers(nominal.states(), given, options.decision.outlying);
  given.omitted = std::move(outliers.outliers);
  if (outliers.any_false) given = assimilate_from(nominal, records.data, given, {}, context);
  if (!std::isfinite(given.deviance))
    throw DataError(records.data.trajectories.front().source,
                    "the model has no finite solution from one sample to the next",
                    "check that model and record have the same units, above all of time");
  Baseline base = fitted_baseline(problem, std::move(given), free_coefficients(nominal));
  base.notes.insert(base.notes.begin(), outliers.notes.begin(), outliers.notes.end());
  return base;
}

Baseline fitted_baseline(const Problem& problem, Assimilation given,
                         std::vector<CoefficientPlace> free) {
  const auto& [nominal, records, options, context] = problem;
  const Dataset& data = records.data;
  context.report("fitting the nominal coefficients", 0.0);
  AssimilationOptions fit_options;
  fit_options.free = std::move(free);
  fit_options.priors = options.tolerances;
  Assimilation fitted = settled(assimilate_from(nominal, data, given, fit_options, context),
                                data, fit_options, context);
  fit_options.passes = kPassesFromBaseline;
  std::vector<std::string> notes;
  if (!std::isfinite(fitted.deviance)) {
    notes.push_back(
        "these records do not tell the nominal coefficients, which are kept as they are");
    fit_options.free.clear();
    fitted = given;
  }
  Scope scope =
      make_scope(nominal, data, estimate_noise(data), spectral_lines(fitted, kSpectralLines));
  return {std::make_shared<const BoundRecords>(records),
          std::move(given),
          std::move(fitted),
          std::move(fit_options),
          std::move(scope),
          0.0,
          std::move(notes)};
}

double criterion_of(const Problem& problem, const Baseline& base,
                    const Explanation& explanation) {
  return problem.options.criterion->value({explanation.fit.deviance,
                                           static_cast<double>(base.fit_options.free.size()) +
                                               base.parameters +
                                               static_cast<double>(explanation.parameters()),
                                           static_cast<double>(explanation.fit.used), 0.0});
}

Explanation explain_on(const Problem& problem, const Baseline& base, const Assimilation& start,
                       const std::vector<FittedEffect>& effects) {
  return explain(joint_fit(problem, base), start, effects);
}

Explanation explain_roughly_on(const Problem& problem, const Baseline& base,
                               const Assimilation& start,
                               const std::vector<FittedEffect>& effects) {
  return explain_roughly(joint_fit(problem, base), start, effects);
}

}  // namespace lacuna
