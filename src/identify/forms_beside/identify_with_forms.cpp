// SPDX-License-Identifier: MIT
#include "identify/forms_beside/identify_with_forms.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "core/statistics/information.hpp"
#include "extended_pipeline.hpp"
#include "identify/forms_beside/function_forms.hpp"
#include "identify/forms_beside/missing_forms.hpp"
#include "identify/pipeline/given_rates.hpp"
#include "product_forms.hpp"

namespace lacuna {
namespace {

/// Whether what the library leaves of the rates is not worth a form: errors of solvers.
bool leaves_nothing(const IdentificationResult& result, double worth_asking) {
  return std::all_of(result.fit.begin(), result.fit.end(), [&](const EquationFit& fit) {
    return fit.identity || fit.residual_rms <= worth_asking * fit.target_rms;
  });
}

/// What is known of what an equation leaves.
Remainder left_by(const EquationFit& fit) {
  return fit.fits_to_noise.value_or(false) ? Remainder::Noise : Remainder::Unknown;
}

std::size_t terms_of(const IdentificationResult& result) {
  std::size_t count = 0;
  for (const Equation& equation : result.model.equations()) count += equation.size();
  return count;
}

/// A model and how many numbers it has.
struct Counted {
  const IdentificationResult& result;
  std::size_t numbers;
};

/// Candidates of each equation; none where it is known what it is, or where the library fits with
/// so few parameters that no form has fewer.
std::vector<std::vector<Candidate>> candidates_for(const ExtendedPipeline& pipeline,
                                                   const Dataset& data,
                                                   const std::vector<Stage<Effect>>& effects,
                                                   const IdentificationResult& alone,
                                                   const FormOptions& options) {
  const bool fits = reaches_the_noise(alone);
  const auto fewest = static_cast<std::size_t>(options.fewest_parameters);
  const Scope scope = make_scope(alone.model, data, alone.noise);
  std::vector<std::vector<Candidate>> candidates;
  for (Index k = 0; k < data.state_count(); ++k) {
    std::vector<Candidate>& all = candidates.emplace_back();
    const std::size_t terms = alone.model.equations()[static_cast<std::size_t>(k)].size();
    if (data.rate_state(k) || (fits && terms < fewest)) continue;
    all = function_forms(scope, effects, k);
    for (Candidate& fraction : pipeline.search().fractions(scope, k, pipeline.library().terms))
      all.push_back(std::move(fraction));
  }
  return candidates;
}

/// What a search for basis functions beside the library works with. Everything outlives it.
struct FormsTask {
  const ExtendedPipeline& pipeline;
  const std::vector<std::vector<Candidate>>& candidates;  ///< of each equation
  const Dataset& data;                                    ///< the excerpt
  const FormOptions& options;
  const RunContext& context;

  /// A fraction of a rate that is no form: errors of solvers, of measured rates rounding.
  double negligible() const {
    return data.has_derivatives() ? kRoundingOfRates : options.worth_asking;
  }

  /// @param part of the search, from 0 to 1, that begins with an equation.
  void report(double part) const { context.report("searching forms", part); }
  double fraction(std::size_t equation) const {
    return static_cast<double>(equation) / static_cast<double>(candidates.size());
  }
};

/// Whether fewer parameters do the same by Schwarz' criterion: 2 n ln(residual) of each state
/// and ln(n m) for each number.
bool is_equivalent(const FormsTask& task, const Counted& fewer, const Counted& more) {
  const auto n = static_cast<double>(task.data.samples());
  const double penalty = parameter_penalty(n * static_cast<double>(task.data.state_count()));
  return fewer.numbers < more.numbers &&
         2.0 * n * task.pipeline.models().excess(fewer.result, more.result) <
             penalty * static_cast<double>(more.numbers - fewer.numbers);
}

/// The library in every equation, and no form.
std::vector<EquationForms> bare_equations(const FormsTask& task) {
  std::vector<EquationForms> equations;
  for (std::size_t k = 0; k < task.candidates.size(); ++k)
    equations.push_back({static_cast<Index>(k), task.pipeline.library().terms, {}});
  return equations;
}

std::vector<EquationForms> with_missing_forms(const FormsTask& task,
                                              std::vector<EquationForms> equations) {
  const auto most_forms = static_cast<std::size_t>(task.options.most_forms);
  for (std::size_t k = 0; k < equations.size(); ++k) {
    task.report(0.5 * task.fraction(k));
    if (!task.candidates[k].empty())
      equations[k] = task.pipeline.search().with_missing_forms(std::move(equations[k]),
                                                               task.candidates[k], most_forms);
  }
  return equations;
}

/// The equations with plainer forms; nothing where none is plainer.
std::optional<std::vector<EquationForms>> plainer(const FormsTask& task,
                                                  std::vector<EquationForms> equations,
                                                  Plainness kind) {
  bool changed = false;
  for (std::size_t k = 0; k < equations.size(); ++k)
    if (auto other = task.pipeline.search().plainer(equations[k], task.candidates[k], kind)) {
      equations[k] = std::move(*other);
      changed = true;
    }
  return changed ? std::optional(std::move(equations)) : std::nullopt;
}

/// A model without shapes of its forms that are worth nothing by Schwarz' criterion.
Extension with_fewer_shapes(const FormsTask& task, Extension found) {
  std::vector<EquationForms> fewer = found.equations;
  bool changed = false;
  for (std::size_t k = 0; k < fewer.size(); ++k)
    if (auto equation =
            task.pipeline.search().with_fewer_shapes(fewer[k], task.candidates[k])) {
      fewer[k] = std::move(*equation);
      changed = true;
    }
  if (!changed) return found;
  Extension other = task.pipeline.settled(std::move(fewer), task.candidates);
  const bool same =
      reaches_the_noise(other.result) >= reaches_the_noise(found.result) &&
      is_equivalent(task, {other.result, other.numbers()}, {found.result, found.numbers()});
  return same ? std::move(other) : std::move(found);
}

/// The model with these forms, or with plainer ones where they do the same.
Extension plain_model(const FormsTask& task, std::vector<EquationForms> equations) {
  // What a solver makes of a jump is worse than what it makes of a steep slope: residuals do
  // not decide here.
  if (auto jumps = plainer(task, equations, Plainness::Jump)) equations = std::move(*jumps);
  Extension found =
      with_fewer_shapes(task, task.pipeline.settled(std::move(equations), task.candidates));
  auto others = plainer(task, found.equations, Plainness::Any);
  if (!others) return found;
  Extension other = task.pipeline.settled(std::move(*others), task.candidates);
  const ModelComparison& models = task.pipeline.models();
  const bool same = models.excess(other.result, found.result) <= task.options.same ||
                    (reaches_the_noise(other.result) && reaches_the_noise(found.result));
  return same && other.numbers() <= found.numbers() ? std::move(other) : std::move(found);
}

/// The equations with forms in the place of terms; nothing where no form takes any.
std::optional<std::vector<EquationForms>> thinned(const FormsTask& task,
                                                  const IdentificationResult& found,
                                                  std::vector<EquationForms> equations) {
  const FormSearch& search = task.pipeline.search();
  const std::vector<EquationForms> kept = kept_in(found, equations);
  bool changed = false;
  for (std::size_t k = 0; k < equations.size(); ++k) {
    equations[k] = kept[k];
    if (task.candidates[k].empty()) continue;
    task.report(0.5 + 0.5 * task.fraction(k));
    equations[k] = search.refitted(search.with_fewer_terms(
        kept[k], task.candidates[k], task.pipeline.library().terms, left_by(found.fit[k]),
        task.negligible()));
    changed = changed || !equations[k].forms.empty();
  }
  return changed ? std::optional(std::move(equations)) : std::nullopt;
}

/// Forms that equations lack, and the model that the pipeline makes with them.
Extension with_forms_beside(const FormsTask& task, const IdentificationResult& alone) {
  std::vector<EquationForms> equations = bare_equations(task);
  const bool fits = reaches_the_noise(alone);
  if (!fits) equations = with_missing_forms(task, std::move(equations));
  const IdentificationResult found = fits ? alone : task.pipeline.identified(equations);
  const std::vector<EquationForms> kept = kept_in(found, equations);
  auto fewer = thinned(task, found, std::move(equations));
  if (!fewer) return {found, kept};
  Extension plain = plain_model(task, std::move(*fewer));
  const bool is_lost = task.pipeline.models().is_ahead(found, plain.result, task.options.same);
  return is_lost ? Extension{found, kept} : std::move(plain);
}

/// Whether forms have made the model better. Where the library fits already they have to be
/// the same by fewer parameters; else it fits now, or leaves less with no more terms.
bool is_better(const FormsTask& task, const Extension& with,
               const IdentificationResult& without) {
  if (reaches_the_noise(without))
    return reaches_the_noise(with.result) &&
           is_equivalent(task, {with.result, with.numbers()}, {without, terms_of(without)});
  if (is_known_to_fit(with.result)) return true;
  return task.pipeline.models().excess(with.result, without) < -task.options.same &&
         terms_of(with.result) <= terms_of(without);
}

/// Whether an equation leaves something: more than the noise, or where no noise is seen more
/// than errors of solvers.
bool leaves_something(const FormsTask& task, const IdentificationResult& result,
                      std::size_t equation) {
  const EquationFit& fit = result.fit[equation];
  if (task.candidates[equation].empty() || fit.identity) return false;
  if (task.pipeline.models().sees_noise_of(equation)) return !fit.fits_to_noise.value_or(true);
  return fit.residual_rms > task.negligible() * fit.target_rms;
}

std::size_t forms_of(const Extension& model) {
  std::size_t count = 0;
  for (const EquationForms& equation : model.equations) count += equation.forms.size();
  return count;
}

/// Whether compositions have made a model better: by Schwarz' criterion with ln(candidates) for
/// each form, the penalty of its choice; and it fits now, or residuals are halved, and halved
/// again by each parameter more.
bool is_worth_composing(const FormsTask& task, const Extension& with, const Extension& without,
                        std::size_t candidates) {
  const double gain = -task.pipeline.models().excess(with.result, without.result);
  const auto n = static_cast<double>(task.data.samples());
  const auto over = [](std::size_t a, std::size_t b) {
    return a > b ? static_cast<double>(a - b) : 0.0;
  };
  const double more = over(with.numbers(), without.numbers());
  const double choices =
      over(forms_of(with), forms_of(without)) * std::log(static_cast<double>(candidates));
  const double penalty =
      parameter_penalty(n * static_cast<double>(task.data.state_count())) * more;
  if (!(2.0 * n * gain > penalty + 2.0 * choices)) return false;
  if (is_known_to_fit(with.result) && !is_known_to_fit(without.result)) return true;
  return gain > std::log(2.0) * (1.0 + more);
}

void append(std::vector<Candidate> more, std::vector<Candidate>& all) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

/// A model with compositions and forcing in the equations that leave something without.
Extension with_compositions(const FormsTask& simple, Extension found) {
  std::vector<std::vector<Candidate>> candidates = simple.candidates;
  const Scope scope = make_scope(found.result.model, simple.data, found.result.noise);
  const std::vector<Term>& library = simple.pipeline.library().terms;
  const FormSearch& search = simple.pipeline.search();
  std::vector<EquationForms> equations = found.equations;
  std::size_t tried = 0;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (!leaves_something(simple, found.result, k)) continue;
    simple.report(0.5 + 0.5 * simple.fraction(k));
    const auto state = static_cast<Index>(k);
    append(composed_forms(scope, state), candidates[k]);
    append(search.tones(scope, state, library), candidates[k]);
    tried = std::max(tried, candidates[k].size());
    equations[k] = search.recomposed(equations[k], candidates[k], library,
                                     simple.negligible());
  }
  if (tried == 0) return found;
  const FormsTask task{simple.pipeline, candidates, simple.data, simple.options,
                       simple.context};
  Extension other = plain_model(task, std::move(equations));
  return is_worth_composing(task, other, found, tried) ? std::move(other) : std::move(found);
}

/// A model with other functions in the place of terms, where those leave less and are no more.
Extension with_exchanges(const FormsTask& simple, Extension found) {
  if (!found.has_forms()) return found;
  std::vector<std::vector<Candidate>> candidates = simple.candidates;
  const Scope scope = make_scope(found.result.model, simple.data, found.result.noise);
  std::vector<EquationForms> equations = found.equations;
  bool changed = false;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (equations[k].forms.empty() || candidates[k].empty()) continue;
    append(composed_forms(scope, static_cast<Index>(k)), candidates[k]);
    const FormSearch& search = simple.pipeline.search();
    EquationForms other = search.exchanged(equations[k], candidates[k]);
    changed = changed || other.parameters() < equations[k].parameters() ||
              search.left(other) < search.left(equations[k]);
    equations[k] = std::move(other);
  }
  if (!changed) return found;
  Extension other = simple.pipeline.settled(std::move(equations), candidates);
  const bool is_ahead = other.numbers() <= found.numbers() &&
                        reaches_the_noise(other.result) >= reaches_the_noise(found.result) &&
                        simple.pipeline.models().excess(other.result, found.result) < 0.0;
  return is_ahead ? std::move(other) : std::move(found);
}

/// Whether there are rows enough to distinguish forms from the library.
bool has_rows_for_forms(const ExtendedPipeline& pipeline) {
  return pipeline.search().rows() > 2 * pipeline.library().size();
}

}  // namespace

IdentificationResult identify_with_forms(const RecordStream& records, const Pipeline& pipeline,
                                         const std::vector<Stage<Effect>>& effects,
                                         const FormOptions& options,
                                         const RunContext& context) {
  IdentificationResult alone = identify(records, pipeline, context);
  if (!context.leads()) return alone;
  return with_forms_beside(records, pipeline, effects, std::move(alone), options,
                           context.alone());
}

IdentificationResult with_forms_beside(const RecordStream& records, const Pipeline& pipeline,
                                       const std::vector<Stage<Effect>>& effects,
                                       IdentificationResult alone, const FormOptions& options,
                                       const RunContext& context) {
  context.check_stop();
  if (leaves_nothing(alone, options.worth_asking) || !pipeline.equations.empty()) return alone;
  const ExtendedPipeline extended(records, pipeline, options, alone, context);
  if (!has_rows_for_forms(extended)) return alone;
  const Dataset& data = records.excerpt();
  const auto candidates = candidates_for(extended, data, effects, alone, options);
  const FormsTask task{extended, candidates, data, options, context};
  Extension with = with_forms_beside(task, alone);
  if (!is_better(task, with, alone)) with = {alone, kept_in(alone, bare_equations(task))};
  with = with_exchanges(task, with_compositions(task, std::move(with)));
  if (with.has_forms()) with.result.library_alone = std::move(alone.model);
  return std::move(with.result);
}

}  // namespace lacuna
