// SPDX-License-Identifier: MIT
// The nominal model brought onto records under given assumptions.
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/parallel.hpp"
#include "data/records/known_noise.hpp"
#include "diagnose/candidates/search_memory.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/diagnose/hypotheses/problem.hpp"
#include "model/equations/formula_channel.hpp"
#include "trajectories/smoother/assimilation_steps.hpp"
#include "trajectories/smoother/hidden_states.hpp"
#include "trajectories/smoother/outlier_check.hpp"
#include "trajectories/smoother/spectral_lines.hpp"
#include "trajectories/smoother/unseen_changes.hpp"
#include "trajectories/smoother/value_periods.hpp"

namespace lacuna {
namespace {

/// Passes of a fit that starts from the baseline's, beside which little moves.
constexpr int kPassesFromBaseline = 8;

JointFitTask joint_fit(const Problem& problem, const Baseline& base) {
  return {base.records->data, problem.nominal, base.fit_options, problem.context,
          base.fitted.deviance};
}

/// Where a fit with hidden states may start, beside where the one before it has come: a hidden
/// state whose equation may be disturbed takes the place of what is missing, and the
/// coefficients go where they say nothing. From the nominal ones, with the disturbances that
/// they need and with less.
std::vector<Assimilation> other_starts(const Baseline& base) {
  constexpr double kFractionOfDisturbance = 0.1;  // a fact of the search: a start, no bound
  Assimilation exact = base.given;
  exact.noise.disturbance *= kFractionOfDisturbance;
  return {base.given, std::move(exact)};
}

/// Where the residual of a velocity comes again with the place. What is strongest at the
/// longest period of all has its peak beyond it: a curve.
std::vector<Ripple> ripples_of(const Scope& scope, const Assimilation& fit) {
  std::vector<Ripple> ripples;
  for (Index k = 0; k < scope.model.dimension(); ++k) {
    const auto position = scope.integral_of(k);
    const auto found = position ? best_period(fit, k, *position) : std::nullopt;
    if (!found) continue;
    const VariableRange& place = scope.state(*position);
    if (kFewestPeriods * found->longest < place.high - place.low)
      ripples.push_back({k, *position, found->longest});
  }
  return ripples;
}

/// The scope of effects: channels that are measured as formulas say nothing that the states do
/// not, and no effect is a function of them.
Scope scope_of(const OdeModel& nominal, const BoundRecords& records, const Assimilation& fit) {
  const Dataset& data = records.data;
  Index states = 0;
  for (const Quantity& state : nominal.states()) states += is_formula_channel(state) ? 0 : 1;
  std::vector<SpectralLine> lines = spectral_lines(fit, kSpectralLines);
  const Vector noise = white_noise(noise_of(records));
  const auto with_modulations = [&](Scope scope) {
    scope.modulations = modulation_lines(fit, kSpectralLines);
    scope.ripples = ripples_of(scope, fit);
    return scope;
  };
  if (states == nominal.dimension())
    return with_modulations(make_scope(nominal, data, noise, std::move(lines)));
  const auto count = static_cast<std::ptrdiff_t>(states);
  const OdeModel own(
      {nominal.states().begin(), nominal.states().begin() + count}, nominal.inputs(),
      {nominal.equations().begin(), nominal.equations().begin() + count}, nominal.time_unit());
  Dataset narrow = data;
  narrow.states.resize(static_cast<std::size_t>(states));
  narrow.reconstructed.resize(static_cast<std::size_t>(states));
  for (Trajectory& record : narrow.trajectories) {
    record.states = Matrix(record.states.leftCols(states));
    if (record.marks.size() > 0) record.marks = Matrix(record.marks.leftCols(states));
  }
  return with_modulations(make_scope(own, narrow, noise.head(states), std::move(lines)));
}

/// The nominal coefficients fitted. Where states are hidden a large disturbance explains
/// everything and determines no coefficients; beside a small one they go where they belong.
/// @param other another start with other coefficients, if there is one.
Assimilation likeliest_fit(const Problem& problem, const Dataset& data,
                           const Assimilation& given, const std::optional<Assimilation>& other,
                           const AssimilationOptions& options) {
  const RunContext quiet = problem.context.beside_others();
  const auto fit_from = [&](const OdeModel& model, const Assimilation& start) {
    return settled(assimilate_from(model, data, start, options, quiet), data, options, quiet);
  };
  if (options.hidden.empty()) {
    Assimilation from_given = fit_from(problem.nominal, given);
    if (!other) return from_given;
    Assimilation from_other = fit_from(other->model, *other);
    return from_other.deviance < from_given.deviance - kUnnoticedDeviance ||
                   !std::isfinite(from_given.deviance)
               ? from_other
               : from_given;
  }
  constexpr std::array<double, 4> kFractions{1.0, 0.1, 0.01, 1e-3};
  const std::size_t count = other ? 2 * kFractions.size() : kFractions.size();
  std::vector<std::optional<Assimilation>> fits(count);
  parallel_for(count, problem.context.threads, [&](std::size_t i) {
    const bool from_given = i < kFractions.size();
    Assimilation start = from_given ? given : *other;
    start.noise.disturbance *= kFractions[i % kFractions.size()];
    fits[i] = fit_from(from_given ? problem.nominal : other->model, start);
  });
  std::size_t best = 0;
  for (std::size_t i = 1; i < fits.size(); ++i)
    if (fits[i]->deviance < fits[best]->deviance - kUnnoticedDeviance ||
        !std::isfinite(fits[best]->deviance))
      best = i;
  return std::move(*fits[best]);
}

/// The model with the coefficients of a trajectory fit, where there are some, on records.
std::optional<Assimilation> from_fitted_start(const Problem& problem,
                                              const BoundRecords& records) {
  const std::optional<OdeModel>& start = problem.memory->start;
  if (!start || start->states().size() != problem.nominal.states().size()) return std::nullopt;
  std::vector<std::optional<Hold>> holds;
  for (const Quantity& input : problem.nominal.inputs()) holds.push_back(input.hold);
  const OdeModel model = start->with_holds(holds);
  AssimilationOptions as_fitted;
  as_fitted.hidden = hidden_states(problem.nominal, records.data);
  Assimilation fit = assimilate_from_starts(model, records, as_fitted, problem.context);
  return std::isfinite(fit.deviance) ? std::optional(std::move(fit)) : std::nullopt;
}

}  // namespace

std::shared_ptr<SearchMemory> new_search_memory() { return std::make_shared<SearchMemory>(); }

Baseline plain_baseline(const Problem& problem) {
  const auto& [nominal, records, options, context, memory, fewer] = problem;
  context.report("bringing the model onto the records", 0.0);
  AssimilationOptions as_given;
  as_given.hidden = hidden_states(nominal, records.data);
  Assimilation given = assimilate_from_starts(nominal, records, as_given, context);
  OutlierCheck outliers = check_outliers(nominal.states(), given, options.decision.outlying);
  given.omitted = std::move(outliers.outliers);
  if (outliers.any_false)
    given = assimilate_from(nominal, records.data, given, as_given, context);
  const bool has_solution = std::isfinite(given.deviance);
  if (!has_solution)
    if (auto fitted = from_fitted_start(problem, records)) given = *std::move(fitted);
  if (!std::isfinite(given.deviance))
    throw DataError(records.data.trajectories.front().source,
                    "the model has no finite solution from one sample to the next",
                    "check that model and record have the same units, above all of time");
  Baseline base = fitted_baseline(problem, std::move(given), free_coefficients(nominal));
  base.notes.insert(base.notes.begin(), outliers.notes.begin(), outliers.notes.end());
  if (!has_solution)
    base.notes.insert(base.notes.begin(),
                      "with the coefficients as they were given the model has no finite "
                      "solution on the records; those of a fit take their place");
  return base;
}

Baseline fitted_baseline(const Problem& problem, Assimilation given,
                         std::vector<CoefficientPlace> free) {
  const auto& [nominal, records, options, context, memory, fewer] = problem;
  const Dataset& data = records.data;
  context.report("fitting the nominal coefficients", 0.0);
  AssimilationOptions fit_options;
  fit_options.free = std::move(free);
  fit_options.priors = options.tolerances;
  fit_options.hidden = hidden_states(nominal, data);
  if (!fit_options.hidden.empty()) {
    fit_options.held_among = fit_options.free.size();
    UnseenChanges unseen =
        unseen_changes(nominal, with_paths_of(data, fit_options.hidden, paths_of(given)),
                       fit_options.hidden, {fit_options.free, fit_options.priors, {}});
    fit_options.unseen = std::move(unseen.coefficients);
    fit_options.units = std::move(unseen.units);
  }
  const std::optional<Assimilation> other = from_fitted_start(problem, records);
  Assimilation fitted = likeliest_fit(problem, data, given, other, fit_options);
  fit_options.passes = kPassesFromBaseline;
  std::vector<std::string> notes;
  if (!std::isfinite(fitted.deviance)) {
    notes.push_back(
        "these records do not determine the nominal coefficients, which are kept as they are");
    fit_options.free.clear();
    fitted = given;
  }
  BoundRecords known = with_paths_of(records, fit_options.hidden, paths_of(fitted));
  Scope scope = scope_of(nominal, known, fitted);
  return {std::make_shared<const BoundRecords>(std::move(known)),
          std::move(given),
          std::move(fitted),
          std::move(fit_options),
          std::move(scope),
          0.0,
          std::move(notes)};
}

Problem alone(const Problem& problem, const RunContext& quiet) {
  return {problem.nominal, problem.records, problem.options,
          quiet,           problem.memory,  problem.most_parameters};
}

double criterion_of(const Problem& problem, const Baseline& base,
                    const Explanation& explanation) {
  return problem.options.criterion->value({explanation.fit.deviance,
                                           static_cast<double>(base.fit_options.free.size()) +
                                               base.parameters +
                                               static_cast<double>(explanation.parameters()),
                                           static_cast<double>(explanation.fit.used), 0.0});
}

namespace {

/// The likeliest of the fits from a start and, where states are hidden, from others.
template <class Fit>
Explanation likeliest(const Baseline& base, const Assimilation& start, Fit fit) {
  Explanation best = fit(start);
  if (base.fit_options.hidden.empty()) return best;
  for (const Assimilation& other : other_starts(base)) {
    Explanation next = fit(other);
    if (next.fit.deviance < best.fit.deviance - kUnnoticedDeviance ||
        !std::isfinite(best.fit.deviance))
      best = std::move(next);
  }
  return best;
}

/// A fit that other searches may have done already.
Explanation remembered(const Problem& problem, const Baseline& base, const Assimilation& start,
                       const std::vector<FittedEffect>& effects, bool roughly) {
  const JointFitTask task = joint_fit(problem, base);
  return problem.memory->fits.explanation(
      fit_key(roughly ? "rough" : "exact", task, start, effects), [&] {
        return roughly ? explain_roughly(task, start, effects) : explain(task, start, effects);
      });
}

}  // namespace

Explanation explain_on(const Problem& problem, const Baseline& base, const Assimilation& start,
                       const std::vector<FittedEffect>& effects) {
  return likeliest(base, start, [&](const Assimilation& from) {
    return remembered(problem, base, from, effects, false);
  });
}

Explanation explain_further_on(const Problem& problem, const Baseline& base,
                               const Explanation& start) {
  return remembered(problem, base, start.fit, start.effects, false);
}

Explanation explain_roughly_on(const Problem& problem, const Baseline& base,
                               const Assimilation& start,
                               const std::vector<FittedEffect>& effects) {
  return likeliest(base, start, [&](const Assimilation& from) {
    return remembered(problem, base, from, effects, true);
  });
}

Explanation with_joint_errors(const Problem& problem, const Baseline& base,
                              Explanation explanation) {
  return with_joint_errors(joint_fit(problem, base), std::move(explanation));
}

}  // namespace lacuna
