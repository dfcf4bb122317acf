// SPDX-License-Identifier: MIT
#include "model/equations/output_values.hpp"

#include <vector>

#include "lacuna/core/base/error.hpp"

namespace lacuna {

Matrix output_values(const OdeModel& model, const Vector& time, const Matrix& states,
                     const Matrix& inputs) {
  const Index n = time.size(), m = model.dimension();
  const auto p = static_cast<Index>(model.inputs().size());
  if (states.rows() != n || states.cols() != m || inputs.rows() != n || inputs.cols() != p)
    throw ArgumentError("output_values", "times, states and inputs do not fit the model",
                        "give one row per time and one column per state and input");
  std::vector<Expression> formulas;
  for (const Output& output : model.outputs()) formulas.push_back(output.formula);
  const Program program(formulas, model.variables());
  Matrix slots(n, program.slots()), values(n, program.outputs());
  slots << states, inputs, time;
  Program::Workspace workspace;
  program.evaluate(slots, values, workspace);
  return values;
}

}  // namespace lacuna
