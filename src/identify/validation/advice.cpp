// SPDX-License-Identifier: MIT
#include "identify/validation/advice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bases/expressions.hpp"
#include "core/base/text.hpp"
#include "identify/forms_beside/function_forms.hpp"
#include "identify/forms_beside/missing_forms.hpp"
#include "lacuna/model/equations/rounding.hpp"

namespace lacuna {
namespace {

/// The form with its numbers to a few digits, as a user would write it.
std::string written(const MissingForm& form, const Variables& variables) {
  // For people.
  constexpr int kDigits = 3;
  return Term(with_rounded_numbers(form.expression(), kDigits), variables).name();
}

/// An equation with the forms that its residual asks for, and the fraction that they leave.
struct Asked {
  EquationForms equation;
  double left = 1.0;
};

/// Where forms are looked for. Everything outlives it.
struct FormTask {
  const OdeModel& model;
  const Scope& scope;
  const std::vector<Stage<Effect>>& effects;
  const FormSearch& search;
  const AdviceOptions& options;
};

/// Nothing where no form stands out.
std::optional<Asked> asked_by(const FormTask& task, Index k) {
  const FormSearch& search = task.search;
  EquationForms equation{k, {}, {}};
  for (const WeightedTerm& summand : task.model.equations()[static_cast<std::size_t>(k)])
    equation.terms.push_back(summand.term);
  const auto most_forms = static_cast<std::size_t>(task.options.most_forms);
  if (search.rows() <= 2 * static_cast<Index>(equation.parameters() + most_forms))
    return std::nullopt;
  const double before = search.left(equation);
  if (!(std::sqrt(before / search.left({k, {}, {}})) > task.options.worth_asking))
    return std::nullopt;
  const double fraction = task.options.most_residual * task.options.most_residual;
  if (search.would_fit_noise(equation, fraction)) return std::nullopt;
  const std::vector<Candidate> candidates = function_forms(task.scope, task.effects, k);
  double left = before;
  for (std::size_t forms = 1; forms <= most_forms; ++forms) {
    EquationForms more = search.with_missing_forms(equation, candidates, forms,
                                                   task.options.most_residual);
    const double with = search.left(more);
    if (more.forms.size() < forms || !(std::sqrt(with / left) < task.options.most_residual))
      break;
    equation = std::move(more);
    left = with;
  }
  if (equation.forms.empty()) return std::nullopt;
  return Asked{std::move(equation), std::sqrt(left / before)};
}

/// The pipeline with terms beside its library and what it has found.
Pipeline offering(const AdviceTask& asked_for, const std::string& state,
                  const std::vector<std::string>& terms) {
  Pipeline pipeline = asked_for.pipeline;
  const OdeModel& model = asked_for.result.model;
  std::vector<std::string> names = pipeline.basis->library(model.variables()).names();
  const auto add = [](std::vector<std::string>& all, const std::string& name) {
    if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
  };
  for (const Equation& equation : model.equations())
    for (const WeightedTerm& summand : equation) add(names, summand.term.name());
  for (const std::string& term : terms) add(names, term);
  pipeline.basis = Expressions{{.terms = std::move(names)}};
  for (EquationTerms& own : pipeline.equations)
    if (own.state == state)
      for (const std::string& term : terms) add(own.terms, term);
  return pipeline;
}

/// What is asked for, without the forms that the pipeline does not keep where it is offered all
/// of them: what its pruner or its refiner takes out again is no advice. Nothing where too
/// little is left of it.
std::optional<Asked> kept_by_pipeline(const AdviceTask& asked_for, const FormTask& task,
                                      Asked asked, const RunContext& context) {
  EquationForms& equation = asked.equation;
  const Index k = equation.equation;
  const Variables variables = task.model.variables();
  std::vector<std::string> terms;
  for (const MissingForm& form : equation.forms) terms.push_back(written(form, variables));
  const std::string& state = task.model.states()[static_cast<std::size_t>(k)].name;
  const OdeModel found =
      identify(asked_for.data, offering(asked_for, state, terms), context.beside_others())
          .model;
  context.check_stop();
  std::erase_if(equation.forms, [&](const MissingForm& form) {
    return found.coefficient(k, written(form, variables)) == 0.0;
  });
  if (equation.forms.empty()) return std::nullopt;
  EquationForms bare = equation;
  bare.forms.clear();
  asked.left = std::sqrt(task.search.left(equation) / task.search.left(bare));
  if (!(asked.left < task.options.most_residual)) return std::nullopt;
  return asked;
}

std::string sentence_of(const Asked& asked, const OdeModel& model) {
  std::vector<std::string> forms;
  for (const MissingForm& form : asked.equation.forms)
    forms.push_back(written(form, model.variables()));
  const std::string& state =
      model.states()[static_cast<std::size_t>(asked.equation.equation)].name;
  return "d" + state + "/dt: " + join(forms, " and ") + " beside its terms would leave " +
         format_number(100.0 * asked.left, 2) + " % of its residual; try --add \"" +
         join(forms, ",") + "\"";
}

}  // namespace

std::vector<std::string> advice_for(const AdviceTask& asked_for, const AdviceOptions& options,
                                    const RunContext& context) {
  const auto& [result, data, pipeline, effects, white_noise] = asked_for;
  const Scope scope = make_scope(result.model, data, result.noise);
  const FormSearch search(data, result.noise, options.search, context, {}, white_noise);
  const FormTask task{result.model, scope, effects, search, options};
  std::vector<std::string> advice;
  for (Index k = 0; k < data.state_count(); ++k) {
    context.report("asking what the residuals ask for",
                   static_cast<double>(k) / static_cast<double>(data.state_count()));
    if (data.rate_state(k)) continue;
    std::optional<Asked> asked = asked_by(task, k);
    if (asked) asked = kept_by_pipeline(asked_for, task, *std::move(asked), context);
    if (asked) advice.push_back(sentence_of(*asked, result.model));
  }
  if (advice.empty())
    advice.push_back(
        "no function of states and inputs that these stages keep explains the residual: save "
        "the model (--model-out) and give it to `lacuna diagnose`, which looks for delays, "
        "memory, inputs that nobody measured and faults of sensors");
  return advice;
}

}  // namespace lacuna
