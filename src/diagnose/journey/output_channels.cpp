// SPDX-License-Identifier: MIT
#include "output_channels.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "data/derivatives/finite_differences.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/model/expressions/program.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "model/equations/formula_channel.hpp"

namespace lacuna {
namespace {

/// A formula without variables.
double number_of_formula(const Expression& formula) {
  const Program program({&formula, 1}, Variables{});
  Program::Workspace workspace;
  const double time = 0.0;  // the slot that every program has
  double value = 0.0;
  program.evaluate(&time, &value, workspace);
  return value;
}

/// The output as an image; nothing where it is no affine function of one state with numbers.
std::optional<StateImage> image_in(const OdeModel& model, const Output& output) {
  const std::set<std::string> names = output.formula.variables();
  if (names.size() != 1 || contains(output.formula, Operation::Delay)) return std::nullopt;
  const std::string& state = *names.begin();
  const std::vector<std::string> states = names_of(model.states());
  const Expression slope = differentiate(output.formula, state);
  if (std::find(states.begin(), states.end(), state) == states.end() ||
      !slope.variables().empty() || contains(output.formula, Operation::Step))
    return std::nullopt;
  const Expression at_zero = substitute(output.formula, {{state, Expression()}});
  const StateImage image{output.name, state, number_of_formula(slope),
                         number_of_formula(at_zero)};
  const bool is_one =
      std::isfinite(image.factor) && std::isfinite(image.offset) && image.factor != 0.0;
  return is_one ? std::optional(image) : std::nullopt;
}

/// The marks of an image as those of its state: where the factor is negative its top is the
/// bottom of the state.
Vector marks_of_state(const StateImage& image, Vector marks) {
  if (image.factor > 0.0) return marks;
  for (double& mark : marks) {
    const bool top = mark == number_of(Mark::AtTop), bottom = mark == number_of(Mark::AtBottom);
    if (top || bottom) mark = number_of(top ? Mark::AtBottom : Mark::AtTop);
  }
  return marks;
}

}  // namespace

std::vector<StateImage> images_of_states(const OdeModel& model, const Dataset& view) {
  std::vector<StateImage> images;
  if (view.has_derivatives()) return images;
  for (const MeasuredOutput& measured : measured_outputs(model, view)) {
    const auto image = image_in(model, measured.output);
    if (!image || view.is_measured(model.state_index(image->state))) continue;
    const bool known = std::any_of(images.begin(), images.end(), [&](const StateImage& other) {
      return other.state == image->state;
    });
    if (!known) images.push_back(*image);
  }
  return images;
}

OdeModel without_images(const OdeModel& model, const std::vector<StateImage>& images) {
  std::vector<Output> outputs = model.outputs();
  std::erase_if(outputs, [&](const Output& output) {
    return std::any_of(images.begin(), images.end(),
                       [&](const StateImage& image) { return image.output == output.name; });
  });
  return model.with_outputs(std::move(outputs));
}

Dataset with_states_of(const std::vector<StateImage>& images, const OdeModel& model,
                       const Dataset& view) {
  if (images.empty()) return view;
  Dataset record = view;
  record.states.clear();
  record.rate_of.clear();
  record.reconstructed.clear();
  std::vector<Index> columns;
  std::vector<StateImage> own;  // of each column; that of a state itself is x
  for (Index k = 0; k < view.state_count(); ++k) {
    if (!view.is_measured(k)) continue;
    Quantity quantity = view.states[static_cast<std::size_t>(k)];
    StateImage image{quantity.name, quantity.name};
    for (const StateImage& one : images)
      if (one.output == quantity.name) {
        image = one;
        quantity = model.states()[static_cast<std::size_t>(model.state_index(one.state))];
      }
    columns.push_back(k);
    own.push_back(image);
    record.states.push_back(quantity);
  }
  for (std::size_t r = 0; r < view.trajectories.size(); ++r) {
    const Trajectory& from = view.trajectories[r];
    Trajectory& to = record.trajectories[r];
    to.states.resize(from.samples(), static_cast<Index>(columns.size()));
    to.marks = Matrix::Zero(from.marks.size() > 0 ? from.samples() : 0, to.states.cols());
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto column = static_cast<Index>(c);
      to.states.col(column) =
          (from.states.col(columns[c]).array() - own[c].offset) / own[c].factor;
      if (to.marks.rows() > 0 && columns[c] < from.marks.cols())
        to.marks.col(column) = marks_of_state(own[c], from.marks.col(columns[c]));
    }
    if (to.marks.rows() == 0) to.marks = Matrix();
  }
  return model_view(model, record, FiniteDifferences{});
}

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
