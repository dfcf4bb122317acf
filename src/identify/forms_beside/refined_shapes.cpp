// SPDX-License-Identifier: MIT
#include "refined_shapes.hpp"

#include <algorithm>
#include <map>

#include "lacuna/core/base/error.hpp"
#include "trajectories/shooting/refine.hpp"

namespace lacuna {
namespace {

/// A shape of a form, by its place.
struct ShapePlace {
  std::size_t equation = 0, form = 0;
  Index shape = 0;
};

/// The model with names in the place of shapes.
struct Symbolic {
  std::vector<Equation> equations;
  std::vector<Quantity> inputs;
  std::vector<FreeShape> shapes;
  std::vector<ShapePlace> places;
};

/// A name that no variable of the model has.
std::string free_name(const OdeModel& model, std::size_t number) {
  std::string name = "shape_" + std::to_string(number);
  const std::vector<std::string> taken = model.variables().names();
  while (std::find(taken.begin(), taken.end(), name) != taken.end()) name += "_";
  return name;
}

/// Puts names in the place of the shapes of one form in the equation that has it.
void name_shapes(const OdeModel& model, const MissingForm& form, const ShapePlace& at,
                 Symbolic& symbolic) {
  const Term numbers(form.expression(), model.variables());
  Equation& equation = symbolic.equations[at.equation];
  const auto summand = std::find_if(equation.begin(), equation.end(),
                                    [&](const auto& each) { return each.term == numbers; });
  if (summand == equation.end()) return;
  std::map<std::string, Expression> names;
  for (Index i = 0; i < form.shapes.size(); ++i) {
    const ShapeParameter& shape = form.candidate.shapes[static_cast<std::size_t>(i)];
    const std::string name = free_name(model, symbolic.shapes.size());
    names.emplace(shape.name, Expression::variable(name));
    symbolic.inputs.push_back({name, shape.unit});
    symbolic.shapes.push_back({name, form.shapes[i], {}, shape.low, shape.high});
    symbolic.places.push_back({at.equation, at.form, i});
  }
  Variables variables = model.variables();
  for (const FreeShape& shape : symbolic.shapes) variables.inputs.push_back(shape.name);
  summand->term = Term(substitute(form.candidate.form, names), variables);
}

Symbolic symbolic_of(const OdeModel& model, const std::vector<EquationForms>& equations) {
  Symbolic symbolic{model.equations(), model.inputs(), {}, {}};
  for (std::size_t k = 0; k < equations.size(); ++k)
    for (std::size_t f = 0; f < equations[k].forms.size(); ++f)
      name_shapes(model, equations[k].forms[f], {k, f, 0}, symbolic);
  return symbolic;
}

}  // namespace

std::vector<EquationForms> refined_shapes(const OdeModel& model,
                                          std::vector<EquationForms> equations,
                                          const Dataset& data, const RunContext& context) {
  Symbolic symbolic = symbolic_of(model, equations);
  if (symbolic.shapes.empty()) return equations;
  std::vector<bool> exact;
  for (Index k = 0; k < model.dimension(); ++k) exact.push_back(data.rate_state(k).has_value());
  try {
    const ParametrisedModel start =
        with_free_coefficients(OdeModel(model.states(), std::move(symbolic.inputs),
                                        std::move(symbolic.equations), model.time_unit()),
                               exact, std::move(symbolic.shapes));
    const Refinement fit = refine(start, data, {}, context);
    if (fit.status == RefineStatus::Diverged) return equations;
    for (std::size_t i = 0; i < symbolic.places.size(); ++i) {
      const ShapePlace& at = symbolic.places[i];
      equations[at.equation].forms[at.form].shapes[at.shape] = fit.model.shapes()[i].value;
    }
  } catch (const DataError&) {
    return equations;  // a record that has no windows for it
  }
  return equations;
}

}  // namespace lacuna
