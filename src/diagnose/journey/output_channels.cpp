// SPDX-License-Identifier: MIT
#include "output_channels.hpp"

#include <utility>

#include "lacuna/records/binding/model_view.hpp"
#include "model/equations/formula_channel.hpp"

namespace lacuna {

OdeModel with_output_channels(const OdeModel& model, const Dataset& view) {
  const std::vector<MeasuredOutput> outputs = measured_outputs(model, view);
  if (outputs.empty()) return model;
  std::vector<Quantity> states = model.states();
  std::vector<Equation> equations = model.equations();
  Variables variables = model.variables();
  for (const MeasuredOutput& measured : outputs) {
    states.push_back(formula_channel(measured.output.name, measured.output.unit));
    variables.states.push_back(measured.output.name);
  }
  for (const MeasuredOutput& measured : outputs)
    equations.push_back({{Term(measured.output.formula, variables), 1.0}});
  std::vector<std::optional<InitialValue>> initial = model.initial();
  initial.resize(states.size());
  return OdeModel(std::move(states), model.inputs(), std::move(equations), model.time_unit())
      .with_initial(std::move(initial));
}

OdeModel without_output_channels(const OdeModel& model, const OdeModel& nominal) {
  std::vector<Quantity> states;
  std::vector<Equation> equations;
  for (std::size_t k = 0; k < model.states().size(); ++k) {
    if (is_formula_channel(model.states()[k])) continue;
    states.push_back(model.states()[k]);
    equations.push_back(model.equations()[k]);
  }
  std::vector<std::optional<InitialValue>> initial = nominal.initial();
  initial.resize(states.size());
  return OdeModel(std::move(states), model.inputs(), std::move(equations), model.time_unit())
      .with_initial(std::move(initial))
      .with_outputs(nominal.outputs());
}

}  // namespace lacuna
