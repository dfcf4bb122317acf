// SPDX-License-Identifier: MIT
#include "lacuna/data/records/dataset.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

#include "core/base/check.hpp"
#include "core/base/finite.hpp"
#include "core/base/names.hpp"
#include "core/base/text.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna {
namespace {

[[noreturn]] void fail(const std::string& where, const std::string& problem,
                       const std::string& remedy) {
  throw DataError(where, problem, remedy);
}

std::string shape(const Matrix& values) {
  return std::to_string(values.rows()) + " x " + std::to_string(values.cols());
}

std::string shape(Index rows, Index columns) {
  return std::to_string(rows) + " x " + std::to_string(columns);
}

void check_names(const Dataset& data) {
  std::set<std::string> seen;
  std::vector<Quantity> all = data.states;
  all.insert(all.end(), data.inputs.begin(), data.inputs.end());
  for (const Quantity& quantity : all) {
    const std::string& name = quantity.name;
    if (const auto fault = name_fault(name)) fail("dataset", fault->problem, fault->remedy);
    if (const auto fault = unit_fault(quantity.unit))
      fail("dataset, unit of " + name, fault->problem, fault->remedy);
    if (!seen.insert(name).second)
      fail("dataset", "the name '" + name + "' is used twice",
           "give every state and input a name of its own");
  }
  if (const auto fault = unit_fault(data.time_unit))
    fail("dataset, unit of time", fault->problem, fault->remedy);
  if (data.states.empty()) fail("dataset", "there is no state", "give at least one state");
}

void check_rates(const Dataset& data) {
  if (data.rate_of.empty()) return;
  if (data.rate_of.size() != data.states.size())
    fail("dataset",
         "rate_of has " + std::to_string(data.rate_of.size()) + " entries for " +
             std::to_string(data.states.size()) + " states",
         "give one for each state or none at all");
  for (const auto& rate : data.rate_of)
    if (rate && (*rate < 0 || *rate >= data.state_count()))
      fail("dataset", "rate_of names state " + std::to_string(*rate) + ", which does not exist",
           "give numbers from 0 to " + std::to_string(data.state_count() - 1));
}

void check_shape(const std::string& where, const std::string& what, const Matrix& values,
                 Index rows, Index columns) {
  if (values.rows() == rows && values.cols() == columns) return;
  fail(where, what + " are " + shape(values) + ", expected " + shape(rows, columns),
       "give one row for each sample and one column for each name");
}

void check_values(const std::string& where, const std::string& what, const Matrix& values,
                  const std::vector<Quantity>& names, int threads) {
  if (all_finite(values, threads)) return;
  for (Index column = 0; column < values.cols(); ++column) {
    for (Index row = 0; row < values.rows(); ++row) {
      if (std::isfinite(values(row, column))) continue;
      fail(where + ", row " + std::to_string(row + 1),
           what + " '" + names[static_cast<std::size_t>(column)].name + "' is " +
               format_number(values(row, column)),
           "split the record there or remove the row");
    }
  }
}

void check_time(const std::string& where, const Vector& time) {
  if (time.size() < 2)
    fail(where, "the record has " + std::to_string(time.size()) + " of the 2 samples it needs",
         "give longer records");
  // Counting does not end early, so the compiler compares several at a time.
  Index rising = 1;
  for (Index row = 1; row < time.size(); ++row) rising += time[row] > time[row - 1];
  const bool ends = std::isfinite(time[0]) && std::isfinite(time[time.size() - 1]);
  if (ends && rising == time.size()) return;
  for (Index row = 0; row < time.size(); ++row) {
    const bool rises = row == 0 || time[row] > time[row - 1];
    if (std::isfinite(time[row]) && rises) continue;
    fail(where + ", row " + std::to_string(row + 1),
         "the time " + format_number(time[row]) + " is not later than the one before",
         "sort the samples by time and remove repeated ones");
  }
}

std::string place_of(const Trajectory& trajectory, std::size_t number) {
  return trajectory.source.empty() ? "record " + std::to_string(number + 1) : trajectory.source;
}

void check_trajectory_form(const Dataset& data, const Trajectory& trajectory,
                           const std::string& where) {
  check_time(where, trajectory.time);
  const Index rows = trajectory.samples();
  check_shape(where, "the states", trajectory.states, rows, data.state_count());
  if (data.input_count() > 0 || trajectory.inputs.size() > 0)
    check_shape(where, "the inputs", trajectory.inputs, rows, data.input_count());
  if (trajectory.marks.size() > 0)
    check_shape(where, "the marks", trajectory.marks, rows, data.state_count());
  if (trajectory.has_derivatives())
    check_shape(where, "the derivatives", trajectory.derivatives, rows, data.state_count());
}

}  // namespace

std::vector<std::string> names_of(const std::vector<Quantity>& quantities) {
  std::vector<std::string> names;
  names.reserve(quantities.size());
  for (const Quantity& quantity : quantities) names.push_back(quantity.name);
  return names;
}

Index Dataset::samples() const noexcept {
  Index sum = 0;
  for (const Trajectory& trajectory : trajectories) sum += trajectory.samples();
  return sum;
}

bool Dataset::has_derivatives() const noexcept {
  return !trajectories.empty() &&
         std::all_of(trajectories.begin(), trajectories.end(),
                     [](const Trajectory& trajectory) { return trajectory.has_derivatives(); });
}

std::optional<Index> Dataset::rate_state(Index state) const {
  const auto index = static_cast<std::size_t>(state);
  return index < rate_of.size() ? rate_of[index] : std::nullopt;
}

const Trajectory& longest_record(const Dataset& data) {
  check_argument(!data.trajectories.empty(), "longest_record", "there is no record");
  return *std::max_element(
      data.trajectories.begin(), data.trajectories.end(),
      [](const Trajectory& a, const Trajectory& b) { return a.samples() < b.samples(); });
}

double median_step(const Dataset& data) {
  std::vector<double> steps;
  for (const Trajectory& record : data.trajectories)
    for (Index i = 1; i < record.samples(); ++i)
      steps.push_back(record.time[i] - record.time[i - 1]);
  check_argument(!steps.empty(), "median_step", "no record has two samples");
  check_argument(
      std::all_of(steps.begin(), steps.end(), [](double step) { return std::isfinite(step); }),
      "median_step", "the times are not finite");
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

bool lacks_input_columns(const Dataset& data) {
  return data.inputs.empty() && std::any_of(data.trajectories.begin(), data.trajectories.end(),
                                            [](const Trajectory& record) {
                                              return record.inputs.size() == 0 &&
                                                     record.inputs.rows() != record.samples();
                                            });
}

Dataset with_input_columns(Dataset data) {
  if (lacks_input_columns(data))
    for (Trajectory& record : data.trajectories) record.inputs.resize(record.samples(), 0);
  return data;
}

void check_form(const Dataset& data) {
  check_names(data);
  check_rates(data);
  if (data.trajectories.empty())
    fail("dataset", "there is no record", "give at least one trajectory");
  for (std::size_t i = 0; i < data.trajectories.size(); ++i)
    check_trajectory_form(data, data.trajectories[i], place_of(data.trajectories[i], i));
}

void check_finite(const Dataset& data, int threads) {
  for (std::size_t i = 0; i < data.trajectories.size(); ++i) {
    const Trajectory& trajectory = data.trajectories[i];
    const std::string where = place_of(trajectory, i);
    check_values(where, "state", trajectory.states, data.states, threads);
    check_values(where, "input", trajectory.inputs, data.inputs, threads);
    check_values(where, "derivative of", trajectory.derivatives, data.states, threads);
  }
}

void check_dataset(const Dataset& data, int threads) {
  check_form(data);
  check_finite(data, threads);
}

}  // namespace lacuna
