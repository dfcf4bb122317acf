// SPDX-License-Identifier: MIT
#include "trajectories/smoother/hidden_states.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/parallel.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/trajectories/sensitivities/linearised_record.hpp"
#include "trajectories/sensitivities/record_steps.hpp"

namespace lacuna {
namespace {

/// Parts of a step: good enough for a first path.
constexpr int kParts = 4;

/// The record with its hidden states integrated from `begin`. A step that leads nowhere (the
/// root of a negative level) leaves them where they are.
Matrix integrated(Rates& rates, const OdeModel& model, const Trajectory& record,
                  const std::vector<Index>& hidden, const Vector& begin) {
  const Index m = model.dimension();
  Matrix path = record.states;
  for (const Index k : hidden) path.col(k).setConstant(begin[k]);
  const LinearisedRecord grid = grid_of(model.inputs(), record, path);
  StepSlots slots(with_delays(grid, rates.delays()), m, rates.delays(), grid.grid);
  for (Index i = 0; i + 1 < path.rows(); ++i) {
    for (const Index k : hidden) slots.nodes(slots.grid.begin(i), k) = path(i, k);
    const Matrix end = ends_of_steps(rates, slots, {i}, kParts);
    for (const Index k : hidden)
      path(i + 1, k) = std::isfinite(end(0, k)) ? end(0, k) : path(i, k);
  }
  return path;
}

}  // namespace

std::vector<Index> places_of(const std::vector<bool>& marks) {
  std::vector<Index> places;
  for (std::size_t k = 0; k < marks.size(); ++k)
    if (marks[k]) places.push_back(static_cast<Index>(k));
  return places;
}

std::vector<bool> hidden_states(const OdeModel& model, const Dataset& data) {
  const Index m = model.dimension();
  std::vector<bool> known;
  for (Index k = 0; k < m; ++k) known.push_back(data.is_measured(k));
  for (bool more = true; more;) {
    more = false;
    for (Index k = 0; k < m; ++k) {
      const auto rate = identity_of(model, k);
      if (!known[static_cast<std::size_t>(k)] || !rate ||
          known[static_cast<std::size_t>(*rate)])
        continue;
      known[static_cast<std::size_t>(*rate)] = true;
      more = true;
    }
  }
  if (std::all_of(known.begin(), known.end(), [](bool one) { return one; })) return {};
  known.flip();
  return known;
}

Dataset with_hidden_paths(const OdeModel& model, Dataset data, const std::vector<bool>& hidden,
                          const Vector& begin) {
  const std::vector<Index> numbers = places_of(hidden);
  if (numbers.empty()) return data;
  Rates rates(model);
  for (Trajectory& record : data.trajectories) {
    record.states = integrated(rates, model, record, numbers, begin);
    if (record.marks.size() > 0)
      for (const Index k : numbers) record.marks.col(k).setConstant(number_of(Mark::Value));
  }
  return data;
}

Dataset with_paths_of(Dataset data, const std::vector<bool>& hidden,
                      const std::vector<Matrix>& paths) {
  for (std::size_t r = 0; r < data.trajectories.size(); ++r)
    for (const Index k : places_of(hidden))
      data.trajectories[r].states.col(k) = paths[r].col(k);
  return data;
}

BoundRecords with_paths_of(BoundRecords records, const std::vector<bool>& hidden,
                           const std::vector<Matrix>& paths) {
  records.data = with_paths_of(std::move(records.data), hidden, paths);
  for (const Index k : places_of(hidden))
    records.channels[static_cast<std::size_t>(k)].noise = analyse_noise_of(records.data, k);
  return records;
}

std::vector<Vector> hidden_begins(const Dataset& data, const std::vector<bool>& hidden,
                                  const Vector& first) {
  std::vector<Vector> begins{first};
  Vector reach = Vector::Zero(first.size());
  for (const Index k : places_of(hidden)) {
    double low = first[k], high = first[k];
    for (const Trajectory& record : data.trajectories) {
      low = std::min(low, record.states.col(k).minCoeff());
      high = std::max(high, record.states.col(k).maxCoeff());
    }
    reach[k] = high > low ? high - low : 1.0;
    for (const double sign : {1.0, -1.0}) {
      begins.push_back(first);
      begins.back()[k] += sign * reach[k];
    }
  }
  if (places_of(hidden).size() > 1)
    for (const double sign : {1.0, -1.0}) begins.emplace_back(first + sign * reach);
  return begins;
}

Assimilation assimilate_from_starts(const OdeModel& model, const BoundRecords& records,
                                    const AssimilationOptions& options,
                                    const RunContext& context) {
  if (options.hidden.empty()) return assimilate(model, records, options, context);
  const Vector given = given_begin(model);
  const Dataset first = with_hidden_paths(model, records.data, options.hidden, given);
  const std::vector<Vector> begins = hidden_begins(first, options.hidden, given);
  const RunContext quiet = context.beside_others();
  std::vector<std::optional<Assimilation>> fits(begins.size());
  parallel_for(begins.size(), context.threads, [&](std::size_t i) {
    BoundRecords begun = records;  // the noise of what is measured is the same
    begun.data = with_hidden_paths(model, first, options.hidden, begins[i]);
    fits[i] = assimilate(model, begun, options, quiet);
  });
  std::size_t best = 0;
  for (std::size_t i = 1; i < fits.size(); ++i)
    if (!std::isfinite(fits[best]->deviance) ||
        fits[i]->deviance < fits[best]->deviance - kUnnoticedDeviance)
      best = i;
  return std::move(*fits[best]);
}

}  // namespace lacuna
