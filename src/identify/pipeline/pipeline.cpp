// SPDX-License-Identifier: MIT
#include "lacuna/identify/pipeline/pipeline.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "constrained_equations.hpp"
#include "core/base/parallel.hpp"
#include "core/base/text.hpp"
#include "data/records/known_noise.hpp"
#include "data/records/number_range.hpp"
#include "equation_problem.hpp"
#include "fit_doubts.hpp"
#include "given_rates.hpp"
#include "hurried_terms.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "refined_result.hpp"
#include "trail_writer.hpp"

namespace lacuna {
namespace {

/// What all equations of a run share.
struct Run {
  const Dataset& data;
  const Pipeline& pipeline;
  RunContext context;          ///< of what every answer needs
  RunContext choosing;         ///< with the deadline, of the choice of terms
  RunContext grace;            ///< with a later one, of what an equation is without it
  const RunContext& refining;  ///< with the deadline
  const EquationProblem& problem;
  const Vector& noise;         ///< of the states by the record itself; none of a map
  const KnownNoise& analysed;  ///< the same in full

  const TermLibrary& library = problem.libraries.library;
  const LeastSquaresSystem& system = problem.system;
  const EquationLibraries& libraries = problem.libraries;
};

/// What is found out about one equation.
struct EquationOutcome {
  Equation equation;
  EquationFit fit;
  std::vector<TrailEntry> trail;
  std::vector<std::string> warnings;
  bool hurried = false;  ///< whether its terms come from fewer candidates, or by a cheaper rule
};

std::string stage_name(const StageInterface& stage, std::string_view kind) {
  return std::string(kind) + " " + std::string(stage.info().name);
}

/// dx_k/dt = x_j, which needs no fit.
EquationOutcome identity(const Run& run, Index state, Index rate) {
  const std::string name = run.data.states[static_cast<std::size_t>(state)].name;
  const std::string other = run.data.states[static_cast<std::size_t>(rate)].name;
  EquationOutcome outcome;
  outcome.equation.push_back({Term::parse(other, run.library.variables), 1.0});
  outcome.fit.equation = name;
  outcome.fit.identity = true;
  outcome.trail.push_back({.equation = name,
                           .term = other,
                           .kept = true,
                           .quantity = "known identity",
                           .value = 1.0});
  return outcome;
}

EquationFit summarise(const Run& run, Index state, const Regression& regression) {
  const double root_rows = std::sqrt(static_cast<double>(run.system.rows()));
  EquationFit fit;
  fit.equation = run.data.states[static_cast<std::size_t>(state)].name;
  fit.rows = run.system.rows();
  fit.residual_rms = regression.residual_norm / root_rows;
  fit.target_rms = run.system.factor().target_norms[state] / root_rows;
  fit.converged = regression.converged;
  fit.iterations = regression.iterations;
  return fit;
}

/// The terms that are tried in an equation: those that it was given, or what the filter leaves.
TermSet candidates_of(const Run& run, Index state, TrailWriter& trail) {
  const auto k = static_cast<std::size_t>(state);
  const EquationLibraries& libraries = run.libraries;
  const FilterResult& filtered = run.problem.filtered;
  const bool own = !libraries.own.empty() && libraries.own[k];
  if (!own)
    trail.removed(filtered.removed, stage_name(*run.pipeline.filter, TermFilter::kKind));
  if (libraries.allowed.empty()) return filtered.kept;
  for (Index l = 0; l < run.library.size(); ++l)
    if (!std::binary_search(libraries.allowed[k].begin(), libraries.allowed[k].end(), l))
      trail.removed({{.term = l, .quantity = "not in the equation's library"}}, "library");
  return own ? libraries.allowed[k] : common_terms(filtered.kept, libraries.allowed[k]);
}

/// Variance of each coefficient; empty where there are no rows left to estimate it from.
Vector coefficient_variances(const Run& run, Index state, const Regression& regression) {
  const Index freedom = run.system.rows() - static_cast<Index>(regression.active.size());
  if (freedom <= 0) return {};
  const double variance =
      regression.residual_norm * regression.residual_norm / static_cast<double>(freedom);
  return variance *
         run.system.subproblem(state, regression.active).inverse_gram_diagonal().array();
}

WeightedTerm weighted_term(const Run& run, const Regression& regression,
                           const Vector& variances, Index position) {
  const auto place = static_cast<std::size_t>(position);
  const auto term = static_cast<std::size_t>(regression.active[place]);
  WeightedTerm summand{run.library.terms[term], regression.coefficients[position]};
  // Residuals of exactly 0 say nothing of errors: the coefficient is known to all its digits.
  if (variances.size() == 0 || !std::isfinite(variances[position]) ||
      variances[position] == 0.0)
    return summand;
  const double error = std::sqrt(variances[position]);
  const Index freedom = run.system.rows() - static_cast<Index>(regression.active.size());
  summand.standard_error = error;
  summand.ci95 = interval95(summand.coefficient, error,
                            student_quantile_975(static_cast<double>(freedom)));
  return summand;
}

void write_equation(const Run& run, Index state, const Regression& regression,
                    EquationOutcome& outcome, TrailWriter& trail) {
  const Vector variances = coefficient_variances(run, state, regression);
  const std::string left =
      left_hand_side(outcome.fit.equation, run.pipeline.formulation->evolution());
  for (Index i = 0; i < static_cast<Index>(regression.active.size()); ++i) {
    outcome.equation.push_back(weighted_term(run, regression, variances, i));
    const WeightedTerm& summand = outcome.equation.back();
    trail.kept(regression.active[static_cast<std::size_t>(i)], summand.coefficient);
    if (variances.size() > 0 && !std::isfinite(variances[i]))
      outcome.warnings.push_back(left + ": the data do not determine the coefficient of " +
                                 summand.term.name());
  }
  if (!regression.converged)
    outcome.warnings.push_back(left + ": the regression did not converge in " +
                               std::to_string(regression.iterations) + " iterations");
}

/// How the terms of an equation are chosen and fitted.
struct EquationRule {
  const TermPruner& pruner;
  const Regressor& regressor;
  Effort effort = Effort::Final;
};

/// @throws OutOfTime past the deadline of the context.
EquationOutcome chosen_from(const Run& run, Index state, const TermSet& candidates,
                            const EquationRule& rule, TrailWriter trail,
                            const RunContext& context) {
  const PruneResult pruned =
      rule.pruner.prune(run.system, state, candidates, rule.regressor, context);
  trail.removed(pruned.removed, stage_name(rule.pruner, TermPruner::kKind));

  const Regression regression = rule.regressor.fit(
      run.system, run.system.subproblem(state, pruned.kept), rule.effort, context);
  trail.removed(regression.removed, stage_name(rule.regressor, Regressor::kKind));

  EquationOutcome outcome;
  outcome.fit = summarise(run, state, regression);
  write_equation(run, state, regression, outcome, trail);
  outcome.trail = trail.take();
  return outcome;
}

/// What an equation is where there was no time for all of its candidates: by its own rule from
/// the leading ones, or by one without passes over the rows where that takes too long.
EquationOutcome hurried_equation(const Run& run, Index state, const TermSet& candidates,
                                 const EquationRule& rule, TrailWriter trail) {
  const TermSet leading = leading_candidates(run.system, state, candidates, run.context);
  for (const Index term : terms_beside(candidates, leading))
    trail.removed({{.term = term, .quantity = "not among the terms that explain most"}},
                  kTimeIsUp);
  try {
    EquationOutcome outcome = chosen_from(run, state, leading, rule, trail, run.grace);
    outcome.hurried = leading.size() < candidates.size();
    return outcome;
  } catch (const OutOfTime&) {
    const Pipeline cheap = algorithm1();
    EquationOutcome outcome =
        chosen_from(run, state, leading, {*cheap.pruner, *cheap.regressor, Effort::Selection},
                    std::move(trail), run.context);
    outcome.hurried = true;
    return outcome;
  }
}

EquationOutcome fit_equation(const Run& run, Index state) {
  TrailWriter trail(run.library, run.data.states[static_cast<std::size_t>(state)].name);
  const TermSet candidates = candidates_of(run, state, trail);
  const EquationRule rule{*run.pipeline.pruner, *run.pipeline.regressor};
  try {
    return chosen_from(run, state, candidates, rule, trail, run.choosing);
  } catch (const OutOfTime&) {
    return hurried_equation(run, state, candidates, rule, std::move(trail));
  }
}

EquationOutcome outcome_of(const Run& run, Index state) {
  const std::optional<Index> rate = run.data.rate_state(state);
  return rate ? identity(run, state, *rate) : fit_equation(run, state);
}

void note_noise_floors(const Run& run, IdentificationResult& result) {
  if (result.model.is_map()) return;
  if (has_given_rates(run.data))
    return note_floors_of_given_rates(result.model, run.data, result.noise, result.fit);
  const std::optional<Vector> floor =
      run.pipeline.formulation->target_noise(run.data, result.noise);
  for (std::size_t k = 0; k < result.fit.size() && floor; ++k)
    if (!result.fit[k].identity) result.fit[k].noise_floor = (*floor)[static_cast<Index>(k)];
}

/// Residuals of the equations as a refiner has left them.
void measure_residuals(const Run& run, IdentificationResult& result) {
  const double root_rows = std::sqrt(static_cast<double>(run.system.rows()));
  for (std::size_t k = 0; k < result.fit.size(); ++k) {
    if (result.fit[k].identity) continue;
    TermSet active;
    std::vector<double> values;
    for (Index l = 0; l < run.library.size(); ++l) {
      const std::string& term = run.library.terms[static_cast<std::size_t>(l)].name();
      const double value = result.model.coefficient(static_cast<Index>(k), term);
      if (value == 0.0) continue;
      active.push_back(l);
      values.push_back(value);
    }
    const Subproblem problem = run.system.subproblem(static_cast<Index>(k), active);
    const auto count = static_cast<Index>(values.size());
    result.fit[k].residual_rms =
        problem.residual_norm(Eigen::Map<const Vector>(values.data(), count)) / root_rows;
  }
}

template <class T>
void append(std::vector<T>& target, std::vector<T> more) {
  target.insert(target.end(), std::make_move_iterator(more.begin()),
                std::make_move_iterator(more.end()));
}

/// Equations are fitted beside each other, each by one thread.
std::vector<EquationOutcome> fit_equations(const Run& run) {
  const auto states = static_cast<std::size_t>(run.data.state_count());
  std::vector<EquationOutcome> outcomes(states);
  // A team divides the passes of one equation after the other.
  if (states == 1 || run.context.threads == 1 || run.context.team != nullptr) {
    for (std::size_t k = 0; k < states; ++k) {
      run.context.report("fitting equations",
                         static_cast<double>(k) / static_cast<double>(states));
      outcomes[k] = outcome_of(run, static_cast<Index>(k));
    }
    return outcomes;
  }
  Run each = run;
  for (RunContext* context : {&each.context, &each.choosing, &each.grace})
    *context = context->beside_others();
  std::mutex reporting;
  std::size_t done = 0;
  parallel_for(states, run.context.threads, [&](std::size_t k) {
    each.context.check_stop();
    outcomes[k] = outcome_of(each, static_cast<Index>(k));
    const std::lock_guard lock(reporting);
    run.context.report("fitting equations", double(++done) / double(states));
  });
  return outcomes;
}

/// How much farther the derivatives of a state are from a model than from 0, at worst.
double farthest(const IdentificationResult& result) {
  double worst = 0.0;
  for (const EquationFit& fit : result.fit) {
    if (fit.identity || fit.residual_rms <= 0.0) continue;
    const double far = fit.residual_rms / fit.target_rms;
    worst = std::isnan(far) ? far : std::max(worst, far);
    if (std::isnan(worst)) break;
  }
  return worst;
}

/// Fits a result to the trajectories, where that leads to a model that explains more than none.
void refine_result(const Run& run, const EquationLibraries& libraries,
                   IdentificationResult& result) {
  IdentificationResult refined = result;
  if (run.pipeline.start) refined.model = *run.pipeline.start;
  if (apply_refiner(*run.pipeline.refiner, {run.data, run.analysed}, libraries, refined,
                    run.refining.alone())) {
    measure_residuals(run, refined);
    // Beyond 1 no model says more. Twice that, for a model has noise in its terms too.
    constexpr double kWorseThanNone = 2.0;
    const double far = farthest(refined);
    if (far <= kWorseThanNone) {
      result = std::move(refined);
      return;
    }
    result.warnings.push_back(
        "not refined on the trajectories: rates of what that leads to are " +
        format_number(far, 2) + " times as far from the derivatives as 0 is");
  } else {
    result.warnings = std::move(refined.warnings);
  }
  judge_fits(result);
}

/// Refines a result as long as there is time, under equalities in the place of bounds that hold
/// as such; again with one more where trajectories violate it. @return whether there was time.
bool refine_in_time(const Run& run, std::vector<std::size_t> active,
                    IdentificationResult& result) {
  for (;;) {
    const EquationLibraries libraries = with_active(run.libraries, active);
    IdentificationResult refined = result;
    const bool in_time = run_stage(refined.stages, kTrajectoriesStage,
                                   [&] { refine_result(run, libraries, refined); });
    const auto violated = most_violated(run.libraries, refined.model);
    const bool is_new =
        violated && std::find(active.begin(), active.end(), *violated) == active.end();
    if (!in_time || !is_new) {
      result = std::move(refined);
      return in_time;
    }
    active.push_back(*violated);
    satisfy_constraints(run.system, with_active(run.libraries, active), result);
    measure_residuals(run, result);
  }
}

/// What the stages before the refiner have to warn of that is so in the model.
std::vector<std::string> warnings_of(std::vector<EquationOutcome> outcomes,
                                     const OdeModel& model) {
  std::vector<std::string> warnings;
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    if (outcomes[k].equation.empty() && model.equations()[k].empty())
      warnings.push_back(left_hand_side(model.states()[k].name, model.evolution()) +
                         ": no term was found");
    append(warnings, std::move(outcomes[k].warnings));
  }
  return warnings;
}

/// What of the choice of terms there was no time for.
void enter_hurry(const Run& run, const std::vector<EquationOutcome>& outcomes,
                 IdentificationResult& result) {
  const auto left_out = [&](auto stage) { result.stages.push_back({stage, false, kTimeIsUp}); };
  if (run.problem.left_out > 0) {
    left_out(kLibraryStage);
    result.warnings.push_back(std::to_string(run.problem.left_out) + " of " +
                              std::to_string(run.library.size() + run.problem.left_out) +
                              " candidates, those of the highest degrees, were not looked at: " +
                              kTimeIsUp);
  }
  if (!run.problem.is_filtered) left_out(kFilterStage);
  std::vector<std::string> hurried;
  for (std::size_t k = 0; k < outcomes.size(); ++k)
    if (outcomes[k].hurried)
      hurried.push_back(left_hand_side(result.fit[k].equation, result.model.evolution()));
  if (hurried.empty()) return;
  left_out(kEliminationStage);
  const bool all = hurried.size() == outcomes.size();
  result.warnings.push_back((all ? "every equation" : join(hurried, ", ")) +
                            ": terms chosen from those that explain most: " + kTimeIsUp);
}

IdentificationResult run_equations(const Run& run, const FirstAnswer& first) {
  std::vector<EquationOutcome> outcomes = fit_equations(run);
  std::vector<Equation> equations;
  for (const EquationOutcome& outcome : outcomes) equations.push_back(outcome.equation);
  IdentificationResult result{
      OdeModel(run.data.states, run.data.inputs, std::move(equations), run.data.time_unit)
          .with_evolution(run.pipeline.formulation->evolution()),
      run.noise,
      {},
      {},
      {},
      {}};
  for (EquationOutcome& outcome : outcomes) {
    result.fit.push_back(std::move(outcome.fit));
    append(result.trail, std::move(outcome.trail));
  }
  std::vector<std::size_t> active = satisfy_constraints(run.system, run.libraries, result);
  if (run.libraries.is_constrained()) measure_residuals(run, result);
  note_noise_floors(run, result);
  result.stages.push_back({kEquationsStage});
  enter_hurry(run, outcomes, result);
  if (first && run.context.leads()) first(result);
  if (run.context.leads() && !refine_in_time(run, std::move(active), result)) judge_fits(result);
  std::vector<std::string> warnings = warnings_of(std::move(outcomes), result.model);
  append(warnings, std::move(result.warnings));
  result.warnings = std::move(warnings);
  if (!run.context.leads()) return result;
  result.adequacy = adequacy_of_equations(result.fit);
  return result;
}

/// For what is done past the deadline where it does not take long.
RunContext with_grace(RunContext context) {
  // A decision on what is worth more than the limit (docs/decisions/bounds.md).
  constexpr std::chrono::milliseconds kGrace{100};
  if (context.deadline)
    context.deadline = std::max(*context.deadline, std::chrono::steady_clock::now()) + kGrace;
  return context;
}

std::string excerpt_note(const RecordStream& records) {
  return "the terms come from all " + std::to_string(records.samples()) +
         " samples; noise, refinement and verification from " +
         std::to_string(records.excerpt().samples()) + " of them, spread over the records";
}

}  // namespace

IdentificationResult identify(const RecordStream& records, const Pipeline& pipeline,
                              const RunContext& context, const FirstAnswer& first) {
  const RunContext unhurried = context.unhurried();
  const bool is_map = pipeline.formulation->evolution() == Evolution::Map;
  const Dataset& data =
      is_map && records.in_memory() ? *records.in_memory() : records.excerpt();
  check_dataset(data, context.threads);
  check_number_range(data);
  EquationLibraries libraries =
      equation_libraries(pipeline.basis->library(variables_of(data)), data, pipeline);
  unhurried.report("reading rows", 0.0);
  Pipeline fitted = pipeline;
  if (is_map && pipeline.energy_preserving)
    throw ConfigError("constraint energy-preserving",
                      "it is one of rates, which a map has none of",
                      "leave it out, or identify a flow");
  const KnownNoise analysed =
      is_map ? std::nullopt : KnownNoise(records.noise(context.threads));
  const Vector noise = is_map ? Vector() : white_noise(*analysed);
  fitted.formulation = fitted_to(pipeline.formulation, data, noise);
  const EquationProblem problem =
      equation_problem(records, fitted, std::move(libraries), context);
  const bool alone = context.team == nullptr;
  IdentificationResult result = run_equations(
      {data, fitted, unhurried, alone ? context : unhurried,
       alone ? with_grace(context) : unhurried, context, problem, noise, analysed},
      first);
  if (records.is_long() && !is_map) result.warnings.push_back(excerpt_note(records));
  unhurried.report("fitting equations", 1.0);
  return result;
}

}  // namespace lacuna
