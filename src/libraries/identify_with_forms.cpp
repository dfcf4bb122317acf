// SPDX-License-Identifier: MIT
#include "lacuna/libraries/identify_with_forms.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lacuna/bases/expressions.hpp"
#include "lacuna/libraries/function_forms.hpp"
#include "lacuna/libraries/missing_forms.hpp"

namespace lacuna {
namespace {

bool reaches_the_noise(const IdentificationResult& result) {
  return std::all_of(result.fit.begin(), result.fit.end(),
                     [](const EquationFit& fit) { return fit.fits_to_noise.value_or(true); });
}

/// Mean logarithm of the misfits; that of the residuals where there are none.
double misfit_of(const IdentificationResult& result) {
  double sum = 0.0;
  for (const EquationFit& fit : result.fit)
    if (!fit.identity) sum += std::log(std::max(fit.misfit.value_or(fit.residual_rms), 1e-300));
  return sum;
}

std::size_t terms_of(const IdentificationResult& result) {
  std::size_t count = 0;
  for (const Equation& equation : result.model.equations()) count += equation.size();
  return count;
}

/// Whether forms have made the model better: it fits now, or leaves less by more than a tenth
/// with no more terms.
bool is_better(const IdentificationResult& with, const IdentificationResult& without) {
  constexpr double kSlack = 0.1;
  if (reaches_the_noise(with)) return true;
  return misfit_of(with) < misfit_of(without) - kSlack && terms_of(with) <= terms_of(without);
}

/// The library with forms beside its terms, and what came of it.
struct Extended {
  std::vector<std::vector<MissingForm>> forms;  ///< of each equation
  std::optional<IdentificationResult> result;
};

Pipeline with_forms(const Pipeline& pipeline, const TermLibrary& library,
                    const std::vector<std::vector<MissingForm>>& forms) {
  ExpressionsOptions options;
  options.terms = library.names();
  for (const auto& equation : forms)
    for (const MissingForm& form : equation) {
      const std::string name = Term(form.expression(), library.variables).name();
      if (std::find(options.terms.begin(), options.terms.end(), name) == options.terms.end())
        options.terms.push_back(name);
    }
  Pipeline extended = pipeline;
  extended.basis = Expressions{std::move(options)};
  return extended;
}

/// The forms that a model has, and the other terms of their equation.
struct Kept {
  std::vector<Term> others;
  std::vector<MissingForm> forms;
};

Kept kept_in(const IdentificationResult& found, std::size_t equation,
             const std::vector<MissingForm>& forms) {
  const Variables variables = found.model.variables();
  Kept kept;
  for (const WeightedTerm& summand : found.model.equations()[equation]) {
    const auto form = std::find_if(forms.begin(), forms.end(), [&](const MissingForm& each) {
      return Term(each.expression(), variables) == summand.term;
    });
    if (form == forms.end())
      kept.others.push_back(summand.term);
    else
      kept.forms.push_back(*form);
  }
  return kept;
}

/// Looks for forms that replace several terms of a model, and fits the shapes again beside
/// those terms only that it has. @return whether forms have changed.
bool settle_forms(const Dataset& data, const IdentificationResult& found, const Scope& scope,
                  const std::vector<Stage<Effect>>& effects,
                  std::vector<std::vector<MissingForm>>& forms, const RunContext& context) {
  bool changed = false;
  for (std::size_t k = 0; k < forms.size(); ++k) {
    const auto equation = static_cast<Index>(k);
    if (data.rate_state(equation)) continue;
    Kept kept = kept_in(found, k, forms[k]);
    if (replace_terms(data, kept.others, function_forms(scope, effects, equation), kept.forms,
                      context))
      changed = true;
    else
      refit_shapes(data, kept.others, kept.forms, context);
    changed = changed || std::any_of(kept.forms.begin(), kept.forms.end(),
                                     [](const auto& form) { return form.shapes.size() > 0; });
    forms[k] = std::move(kept.forms);
  }
  return changed;
}

/// Forms that each equation lacks beside the library.
std::vector<std::vector<MissingForm>> forms_for(const Dataset& data, const TermLibrary& library,
                                                const Scope& scope,
                                                const std::vector<Stage<Effect>>& effects,
                                                const RunContext& context) {
  Vector noise(data.state_count());
  for (Index k = 0; k < noise.size(); ++k) noise[k] = scope.state(k).noise;
  std::vector<std::vector<MissingForm>> forms(data.states.size());
  for (Index k = 0; k < data.state_count(); ++k) {
    context.report("searching forms",
                   static_cast<double>(k) / static_cast<double>(data.state_count()));
    if (data.rate_state(k)) continue;
    forms[static_cast<std::size_t>(k)] =
        missing_forms({data, library, noise}, function_forms(scope, effects, k), context);
  }
  return forms;
}

}  // namespace

IdentificationResult identify_with_forms(const Dataset& data, const Pipeline& pipeline,
                                         const std::vector<Stage<Effect>>& effects,
                                         const RunContext& context) {
  IdentificationResult alone = identify(data, pipeline, context);
  if (reaches_the_noise(alone)) return alone;
  const TermLibrary library = pipeline.basis->library(alone.model.variables());
  const Scope scope = make_scope(alone.model, data, alone.noise);
  auto forms = forms_for(data, library, scope, effects, context);
  IdentificationResult extended = identify(data, with_forms(pipeline, library, forms), context);
  if (settle_forms(data, extended, scope, effects, forms, context))
    extended = identify(data, with_forms(pipeline, library, forms), context);
  if (!is_better(extended, alone)) return alone;
  extended.library_alone = std::move(alone.model);
  return extended;
}

}  // namespace lacuna
