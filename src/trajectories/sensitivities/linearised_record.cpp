// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/sensitivities/linearised_record.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/check.hpp"
#include "lacuna/records/channels/node_grid.hpp"
#include "model/equations/formula_channel.hpp"
#include "trajectories/sensitivities/rates.hpp"
#include "trajectories/sensitivities/record_steps.hpp"
#include "trajectories/sensitivities/secant_slopes.hpp"
#include "trajectories/sensitivities/stiff_steps.hpp"

namespace lacuna {
namespace {

void check(const OdeModel& model, const Trajectory& record, const Matrix& path) {
  if (path.rows() != record.samples() || path.cols() != model.dimension() ||
      record.inputs.cols() != static_cast<Index>(model.inputs().size()))
    throw ArgumentError("linearise", "path and record do not fit the model",
                        "give one column for each state and input");
  if (record.samples() < 4)
    throw ArgumentError("linearise", "the record has fewer than four samples",
                        "give a longer record");
  check_times(record.time, 1, "linearise");
  check_argument(record.inputs.rows() == record.samples(), "linearise",
                 "the inputs have not as many rows as times");
}

/// Length of the part of a step around each node.
Vector part_lengths(const Vector& length, const StepGrid& grid, int parts) {
  Vector result(grid.rows(length.size() + 1));
  for (Index i = 0; i < length.size(); ++i)
    result.segment(grid.begin(i), grid.stride).setConstant(length[i]);
  result[result.size() - 1] = length[length.size() - 1];
  return result / parts;
}

Vector range_of(const Matrix& path) {
  return path.colwise().maxCoeff() - path.colwise().minCoeff();
}

/// What is accurate enough for transitions and responses, which multiply small deviations only:
/// a thousandth of the range of each state.
Vector accuracy_of_variations(const Vector& range, const Vector& accuracy) {
  constexpr double kThousandth = 1e-3;
  return accuracy.cwiseMax(kThousandth * range);
}

/// Channels that are formulas of the states: what is measured there follows the states without
/// a memory. With the derivatives H of the formula at the end of a step, a deviation d of the
/// states makes H d; the step's response and defect are those of the states seen through H.
/// @param slopes m^2 x grid.rows(n): derivatives of all equations.
void see_through(const std::vector<Quantity>& states, Rates& rates, const StepSlots& slots,
                 const Matrix& slopes, LinearisedRecord& record) {
  const Index m = record.states();
  std::vector<Index> formulas;
  for (Index k = 0; k < m; ++k)
    if (is_formula_channel(states[static_cast<std::size_t>(k)])) formulas.push_back(k);
  if (formulas.empty()) return;
  const auto samples = Eigen::seq(0, slots.nodes.rows() - 1, slots.grid.stride);
  const Matrix points = slots.nodes(samples, Eigen::all);
  Matrix values(points.rows(), m);
  rates.rate(points, values);
  for (Index i = 0; i < record.steps(); ++i) {
    const Eigen::Map<const Matrix> slope(slopes.col(slots.grid.begin(i + 1)).data(), m, m);
    Eigen::Map<Matrix> transition(record.transition.col(i).data(), m, m);
    Eigen::Map<Matrix> response(record.response.col(i).data(), m, 3 * m);
    for (const Index k : formulas) {
      transition.col(k).setZero();
      response.middleCols(3 * k, 3).setZero();
      for (auto* rows : {&transition, &response}) rows->row(k).setZero();
      record.defect(k, i) = 0.0;
    }
    for (const Index k : formulas) {
      const Vector h = slope.row(k).transpose();
      const Vector moved = transition.transpose() * h, pushed = response.transpose() * h;
      transition.row(k) = moved.transpose();
      response.row(k) = pushed.transpose();
      record.defect(k, i) =
          values(i + 1, k) + h.dot(record.defect.col(i)) - record.path(i + 1, k);
      if (record.bridge.size() > 0) record.bridge(k, i) = 0.0;
    }
  }
}

/// What inputs that jump at unknown instants of a step may do to the states: a jump that is
/// equally likely at any instant moves them by length x change of the rate / sqrt(12).
/// @return spectral densities, m x (n-1); empty when there is no such input.
Matrix switching_density(const std::vector<Quantity>& inputs, const StepSlots& slots,
                         Rates& rates) {
  Matrix density;
  const auto samples = Eigen::seq(0, slots.nodes.rows() - 1, slots.grid.stride);
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    if (inputs[j].hold != Hold::Switching) continue;
    const Index column = slots.states + static_cast<Index>(j);
    Matrix points = slots.nodes(samples, Eigen::all);
    Matrix before(points.rows(), slots.states), after(before);
    rates.rate(points, before);
    points.col(column).head(slots.steps()) = points.col(column).tail(slots.steps()).eval();
    rates.rate(points, after);
    if (density.size() == 0) density = Matrix::Zero(slots.states, slots.steps());
    for (Index i = 0; i < slots.steps(); ++i)
      density.col(i) +=
          slots.length(i) / 12.0 * (after.row(i) - before.row(i)).cwiseAbs2().transpose();
  }
  return density;
}

/// Ends of all steps; those that were tried before are known.
Matrix ends_of_all(const Rates& rates, const StepSlots& slots, const FoundParts& found,
                   const Matrix& node_rates) {
  Matrix ends(slots.steps(), slots.states);
  std::vector<Index> others, begins;
  std::size_t next = 0;
  for (Index i = 0; i < slots.steps(); ++i)
    if (next < found.tried.size() && found.tried[next] == i) {
      ends.row(i) = found.ends.row(static_cast<Index>(next++));
    } else {
      others.push_back(i);
      begins.push_back(slots.grid.begin(i));
    }
  ends(others, Eigen::all) = ends_of_steps(rates, slots, others, node_rates(begins, Eigen::all),
                                           found.parts.front());
  return ends;
}

/// Ends of all steps where a few of them need more parts; nothing where none does, and where
/// more parts do not help: then all have the most, as those of a stiff model.
std::optional<Matrix> ends_where_some_need_more(const Rates& rates, const StepSlots& slots,
                                                FoundParts& found, const Matrix& node_rates,
                                                const Vector& accuracy) {
  if (!found.some_need_more) return std::nullopt;
  std::vector<Index> begins(static_cast<std::size_t>(slots.steps()));
  for (std::size_t i = 0; i < begins.size(); ++i)
    begins[i] = slots.grid.begin(static_cast<Index>(i));
  std::optional<Matrix> ends =
      refined_ends(rates, slots, ends_of_all(rates, slots, found, node_rates),
                   node_rates(begins, Eigen::all), found.parts.front(), accuracy);
  if (!ends) found = {std::vector<int>(found.parts.size(), kMostParts), {}, {}};
  return ends;
}

/// The steps of a stiff model: slopes are those at the path, because what is fast decays within
/// a step and does not take the state far from there.
struct StiffSteps {
  Matrix ends, slopes;
  StepResponses responses;
};

std::optional<StiffSteps> stiff_steps(Rates& rates, const StepSlots& slots,
                                      const Vector& length, const Vector& accuracy,
                                      const std::vector<int>& parts) {
  if (*std::max_element(parts.begin(), parts.end()) < kMostParts) return std::nullopt;
  StiffSteps found;
  const Vector none = Vector::Zero(slots.nodes.rows());
  found.slopes = secant_slopes(rates, slots.nodes, none, accuracy).slopes;
  if (!has_stiff_steps(found.slopes, slots.grid, length)) return std::nullopt;
  std::optional<Matrix> ends = implicit_ends(rates, slots, accuracy);
  if (!ends) return std::nullopt;
  found.ends = std::move(*ends);
  found.responses = implicit_responses(found.slopes, slots.grid, length, slots.states);
  return found;
}

}  // namespace

LinearisedRecord linearise(const OdeModel& model, const Trajectory& record, const Matrix& path,
                           const Vector& accuracy) {
  check(model, record, path);
  check_argument(accuracy.size() == path.cols(), "linearise",
                 "there is not one accuracy for each state");
  const Index m = path.cols();
  LinearisedRecord result = grid_of(model.inputs(), record, path);
  Rates rates(model);
  const StepSlots slots(with_delays(result, rates.delays()), m, rates.delays(), result.grid);
  FoundParts found =
      parts_for(rates, slots, {accuracy, accuracy_of_variations(result.range, accuracy)});
  const int parts = found.parts[1];  // for variations
  const Vector length =
      record.time.tail(result.samples() - 1) - record.time.head(result.samples() - 1);
  SecantSlopes secants =
      secant_slopes(rates, slots.nodes, part_lengths(length, result.grid, parts), accuracy);
  std::optional<Matrix> ends =
      ends_where_some_need_more(rates, slots, found, secants.rates, accuracy);
  StepResponses responses;
  if (std::optional<StiffSteps> stiff = stiff_steps(rates, slots, length, accuracy, found.parts)) {
    result.defect = (stiff->ends - path.bottomRows(path.rows() - 1)).transpose();
    secants.slopes = std::move(stiff->slopes);
    responses = std::move(stiff->responses);
  } else {
    if (!ends) ends = ends_of_all(rates, slots, found, secants.rates);
    result.defect = (*ends - path.bottomRows(path.rows() - 1)).transpose();
    responses = step_responses(secants.slopes, result.grid, length, {m, parts});
  }
  result.transition = std::move(responses.transition);
  result.response = std::move(responses.response);
  result.bridge = switching_density(model.inputs(), slots, rates);
  see_through(model.states(), rates, slots, secants.slopes, result);
  return result;
}

LinearisedRecord part_of(const LinearisedRecord& record, Index first, Index count) {
  check_part(first, count, record.samples(), "part_of");
  check_argument(count >= 1, "part_of", "there is no sample");
  LinearisedRecord part{
      record.time.segment(first, count),
      record.path.middleRows(first, count),
      record.slots.middleRows(record.grid.begin(first), record.grid.rows(count)),
      record.transition.middleCols(first, count - 1),
      record.response.middleCols(first, count - 1),
      record.defect.middleCols(first, count - 1),
      {},
      record.grid,
      record.range};
  if (record.bridge.size() > 0) part.bridge = record.bridge.middleCols(first, count - 1);
  return part;
}

LinearisedRecord grid_of(const std::vector<Quantity>& inputs, const Trajectory& record,
                         const Matrix& path) {
  std::vector<Interpolation> signals(static_cast<std::size_t>(path.cols()),
                                     Interpolation::Cubic);
  for (const Quantity& input : inputs) signals.push_back(interpolation_of(input.hold));
  StepGrid grid = step_grid(std::move(signals));
  Matrix values(record.samples(), path.cols() + record.inputs.cols());
  values << path, record.inputs;
  Matrix slots = step_slots(record.time, values, grid);
  return {record.time, path, std::move(slots), {}, {}, {}, {}, std::move(grid), range_of(path)};
}

Matrix with_delays(const LinearisedRecord& record, const std::vector<DelayedVariable>& delays) {
  for (const DelayedVariable& delay : delays)
    check_number(delay.slot, record.slots.cols(), "with_delays", "variable");
  const Index width = record.slots.cols(), count = static_cast<Index>(delays.size());
  Matrix result(record.slots.rows(), width + count);
  result.leftCols(width) = record.slots;
  result.rightCols(count) = delayed_step_slots(record.slots, record.grid, delays);
  return result;
}

Matrix evaluate_on(const LinearisedRecord& record, const Variables& variables,
                   std::span<const Expression> formulas) {
  const Program program(formulas, variables);
  Program::Workspace workspace;
  Matrix out(record.slots.rows(), program.outputs());
  if (program.delays().empty())
    program.evaluate(record.slots, out, workspace);
  else
    program.evaluate(with_delays(record, program.delays()), out, workspace);
  return out;
}

Vector evaluate_on(const LinearisedRecord& record, const Variables& variables,
                   const Expression& formula) {
  return evaluate_on(record, variables, std::span<const Expression>(&formula, 1));
}

}  // namespace lacuna
