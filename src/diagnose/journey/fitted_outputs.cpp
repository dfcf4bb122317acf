// SPDX-License-Identifier: MIT
#include "diagnose/journey/fitted_outputs.hpp"

#include <algorithm>
#include <set>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {
namespace {

/// Names of free parameters that stand in outputs alone.
std::set<std::string> own_of_outputs(const SystemModel& model) {
  std::set<std::string> in_outputs, in_equations;
  for (const Output& output : model.symbolic().outputs())
    in_outputs.merge(output.formula.variables());
  for (const Equation& equation : model.symbolic().equations())
    for (const WeightedTerm& summand : equation)
      in_equations.merge(summand.term.expression().variables());
  std::set<std::string> own;
  for (const Parameter& parameter : model.parameters())
    if (parameter.free && in_outputs.contains(parameter.name) &&
        !in_equations.contains(parameter.name))
      own.insert(parameter.name);
  return own;
}

std::string note_on(const FittedParameter& fitted) {
  std::string text = fitted.name + " = " + format_number(fitted.value, 5);
  if (fitted.standard_error) text += " +- " + format_number(*fitted.standard_error, 2);
  return text + ", not " + format_number(fitted.start, 5);
}

}  // namespace

FittedOutputs with_fitted_outputs(const SystemModel& model, const Dataset& records,
                                  const RunContext& context) {
  constexpr int kRestarts = 3;  // a fact of cost: a start for the diagnosis, not an answer
  const std::set<std::string> own = own_of_outputs(model);
  if (own.empty()) return {model};
  context.report("fitting the parameters of outputs", 0.0);
  const RunContext quiet{context.stop, {}, context.threads, context.seed};
  try {
    const FitOptions options{.restarts = kRestarts, .starts = 0};
    const Fit found = fit(model, records, {}, options, quiet);
    std::vector<Parameter> parameters = model.parameters();
    std::vector<std::string> changed;
    for (const FittedParameter& fitted : found.numbers)
      for (Parameter& parameter : parameters)
        if (parameter.name == fitted.name && own.contains(fitted.name) && fitted.ci95) {
          parameter.value = fitted.value;
          changed.push_back(note_on(fitted));
        }
    if (changed.empty()) return {model};
    return {SystemModel(model.symbolic(), std::move(parameters)),
            {"parameters of outputs are those of a fit: " + join(changed, "; ")}};
  } catch (const Error&) {
    return {model};  // what cannot be fitted is diagnosed as it was given
  }
}

}  // namespace lacuna
