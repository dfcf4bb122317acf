// SPDX-License-Identifier: MIT
#include "extended_pipeline.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "bases/expressions.hpp"
#include "data/records/known_noise.hpp"
#include "refined_shapes.hpp"
#include "trajectories/refiners/trajectory_selection.hpp"

namespace lacuna {
namespace {

/// Coefficients of the terms, then of the forms, of each equation; 0 where the model has none.
std::vector<Vector> coefficients_of(const OdeModel& model,
                                    const std::vector<EquationForms>& equations) {
  std::vector<Vector> all;
  for (const EquationForms& equation : equations) {
    std::vector<double> numbers;
    for (const Term& term : equation.terms)
      numbers.push_back(model.coefficient(equation.equation, term.name()));
    for (const MissingForm& form : equation.forms)
      numbers.push_back(model.coefficient(equation.equation,
                                          Term(form.expression(), model.variables()).name()));
    all.push_back(Eigen::Map<const Vector>(numbers.data(), static_cast<Index>(numbers.size())));
  }
  return all;
}

/// Names of a library's terms and of the forms beside them, each once.
std::vector<std::string> with_forms(const TermLibrary& library,
                                    const std::vector<MissingForm>& forms) {
  std::vector<std::string> names = library.names();
  for (const MissingForm& form : forms) {
    const std::string name = Term(form.expression(), library.variables).name();
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

/// A pipeline whose refiner does not fit the coefficients of what does not fit again.
Pipeline without_refit(Pipeline pipeline) {
  if (const auto* selection =
          dynamic_cast<const TrajectorySelection*>(pipeline.refiner.shared().get())) {
    TrajectorySelectionOptions options = selection->options();
    options.refit = false;
    pipeline.refiner = TrajectorySelection{options};
  }
  return pipeline;
}

}  // namespace

bool Extension::has_forms() const {
  return std::any_of(equations.begin(), equations.end(),
                     [](const EquationForms& equation) { return !equation.forms.empty(); });
}

std::size_t Extension::numbers() const {
  std::size_t count = 0;
  for (const EquationForms& equation : equations) count += equation.parameters();
  return count;
}

std::vector<EquationForms> kept_in(const IdentificationResult& found,
                                   const std::vector<EquationForms>& equations) {
  std::map<std::string, MissingForm> forms;
  for (const EquationForms& equation : equations)
    for (const MissingForm& form : equation.forms)
      forms.emplace(Term(form.expression(), found.model.variables()).name(), form);
  std::vector<EquationForms> kept;
  for (std::size_t k = 0; k < equations.size(); ++k) {
    kept.push_back({static_cast<Index>(k), {}, {}});
    for (const WeightedTerm& summand : found.model.equations()[k]) {
      const auto form = forms.find(summand.term.name());
      if (form == forms.end())
        kept[k].terms.push_back(summand.term);
      else
        kept[k].forms.push_back(form->second);
    }
  }
  return kept;
}

ExtendedPipeline::ExtendedPipeline(const RecordStream& records, const Pipeline& pipeline,
                                   const FormOptions& options,
                                   const IdentificationResult& alone, const RunContext& context)
    : records_(records),
      pipeline_(pipeline),
      options_(options),
      context_(context),
      alone_(alone),
      library_(pipeline.basis->library(alone.model.variables())),
      models_(records.excerpt(), records.noise(context.threads)),
      search_(records.excerpt(), alone.noise, options, context, library_.terms,
              white_noise(records.noise(context.threads))) {}

IdentificationResult ExtendedPipeline::identified(
    const std::vector<EquationForms>& equations) const {
  Pipeline extended = pipeline_;
  extended.basis =
      Expressions{{.terms = with_forms(library_, search_.shared_forms(equations))}};
  return refined_in_time(extended);
}

IdentificationResult ExtendedPipeline::refined_in_time(const Pipeline& pipeline) const {
  IdentificationResult result = identify(records_, pipeline, context_);
  context_.check_stop();  // what was not refined is no model to compare with one that was
  return result;
}

Extension ExtendedPipeline::settled(
    std::vector<EquationForms> equations,
    const std::vector<std::vector<Candidate>>& candidates) const {
  // A refit changes no misfit, and shapes are fitted by one.
  IdentificationResult alone = identified_as(equations, true);
  if (is_worse(alone)) return {std::move(alone), std::move(equations)};
  const std::vector<Vector> coefficients = coefficients_of(alone.model, equations);
  equations = refined_shapes(alone.model, std::move(equations), records_, context_);
  for (std::size_t k = 0; k < equations.size(); ++k)
    equations[k] =
        search_.plainly_written(std::move(equations[k]), coefficients[k], candidates[k]);
  alone = identified_as(equations);
  if (is_known_to_fit(alone)) {
    equations = kept_in(alone, equations);
    return {std::move(alone), std::move(equations)};
  }
  IdentificationResult beside = identified(equations);
  const bool better = models_.is_ahead(beside, alone, options_.same) ||
                      models_.excess(beside, alone) < -options_.same;
  if (better) alone = std::move(beside);
  equations = kept_in(alone, equations);
  Extension found{std::move(alone), std::move(equations)};
  return better && found.has_forms() ? reshaped(std::move(found)) : found;
}

IdentificationResult ExtendedPipeline::identified_as(
    const std::vector<EquationForms>& equations, bool roughly) const {
  Pipeline extended = roughly ? without_refit(pipeline_) : pipeline_;
  for (const EquationForms& equation : equations) {
    if (equation.forms.empty()) continue;
    const auto state = static_cast<std::size_t>(equation.equation);
    EquationTerms terms{records_.excerpt().states[state].name, {}};
    for (const Term& term : equation.terms) terms.terms.push_back(term.name());
    for (const MissingForm& form : equation.forms)
      terms.terms.push_back(form.expression().to_string());
    extended.equations.push_back(std::move(terms));
  }
  return refined_in_time(extended);
}

bool ExtendedPipeline::is_worse(const IdentificationResult& model) const {
  return reaches_the_noise(alone_) && models_.excess(model, alone_) > options_.same;
}

Extension ExtendedPipeline::reshaped(Extension found) const {
  std::vector<EquationForms> equations =
      refined_shapes(found.result.model, found.equations, records_, context_);
  IdentificationResult result = identified_as(equations);
  equations = kept_in(result, equations);
  const bool leaves_less = models_.excess(result, found.result) < 0.0;
  Extension other{std::move(result), std::move(equations)};
  return leaves_less && other.numbers() <= found.numbers() ? std::move(other)
                                                           : std::move(found);
}

}  // namespace lacuna
