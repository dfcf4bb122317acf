// SPDX-License-Identifier: MIT
#include "lacuna/identify/validation/advice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/text.hpp"
#include "identify/forms_beside/function_forms.hpp"
#include "identify/forms_beside/missing_forms.hpp"
#include "lacuna/bases/expressions.hpp"
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

/// Whether the pipeline keeps the terms in an equation where it is offered them: what its pruner
/// or its refiner takes out again is no advice.
bool keeps(const AdviceTask& asked_for, Index k, const std::vector<std::string>& terms,
           const RunContext& context) {
  const std::string& state =
      asked_for.result.model.states()[static_cast<std::size_t>(k)].name;
  const OdeModel found =
      identify(asked_for.data, offering(asked_for, state, terms), context.beside_others()).model;
  context.check_stop();
  return std::all_of(terms.begin(), terms.end(), [&](const std::string& term) {
    return found.coefficient(k, term) != 0.0;
  });
}

std::vector<std::string> written(const Asked& asked, const Variables& variables) {
  std::vector<std::string> forms;
  for (const MissingForm& form : asked.equation.forms)
    forms.push_back(written(form, variables));
  return forms;
}

std::string sentence_of(const Asked& asked, const OdeModel& model) {
  const std::vector<std::string> forms = written(asked, model.variables());
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
    const std::optional<Asked> asked = asked_by(task, k);
    if (asked && keeps(asked_for, k, written(*asked, result.model.variables()), context))
      advice.push_back(sentence_of(*asked, result.model));
  }
  if (advice.empty())
    advice.push_back(
        "no function of states and inputs that these stages keep explains the residual: save "
        "the model (--model-out) and give it to `lacuna diagnose`, which looks for delays, "
        "memory, inputs that nobody measured and faults of sensors");
  return advice;
}

}  // namespace lacuna
