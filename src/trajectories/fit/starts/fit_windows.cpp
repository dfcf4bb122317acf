// SPDX-License-Identifier: MIT
#include "fit_windows.hpp"

#include <algorithm>
#include <utility>

#include "data/records/piece_name.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "trajectories/shooting/refine.hpp"

namespace lacuna {
namespace {

/// Whether every state has a value at every sample.
bool is_complete(const Dataset& view, Index states) {
  for (Index k = 0; k < states; ++k) {
    if (is_hidden(view, k) || !view.is_measured(k)) return false;
    for (const Trajectory& record : view.trajectories)
      for (Index n = 0; n < record.samples(); ++n)
        if (mark_of(record.marks, n, k) != Mark::Value) return false;
  }
  return true;
}

/// The noise of each column of the view as the channels of the fit have it; 0 where none is
/// its.
Vector noise_of(const FitRecords& records, const Dataset& view) {
  Vector noise = Vector::Zero(static_cast<Index>(view.states.size()));
  for (const FitChannel& channel : records.channels)
    for (std::size_t column = 0; column < view.states.size(); ++column)
      if (view.states[column].name == channel.name)
        noise[static_cast<Index>(column)] = channel.noise;
  return noise;
}

}  // namespace

std::optional<FitInWindows> fitted_in_windows(const FitEngine& engine,
                                              const FitUnknowns& unknowns, const Dataset& view,
                                              const RunContext& context) {
  const auto& given = unknowns.initial;
  const bool begins_anywhere =
      std::all_of(given.begin(), given.end(), [](const auto& initial) { return !initial; });
  if (!begins_anywhere || !unknowns.local.empty() || engine.events ||
      !engine.rates.delays().empty() || !is_complete(view, engine.states()))
    return std::nullopt;
  const Refinement found =
      refine(engine.model, view, {.noise = noise_of(engine.records, view), .may_be_cut = true},
             context);
  if (found.status == RefineStatus::Diverged || found.states.rows() != view.samples())
    return std::nullopt;
  const Vector values = found.model.values(),
               inside = values.cwiseMax(unknowns.lower).cwiseMin(unknowns.upper);
  FitInWindows all{{inside.transpose().replicate(engine.records.records(), 1),
                    Matrix(engine.records.records(), engine.states())},
                   {},
                   found.fits_to_noise && inside == values};
  for (Index r = 0; r < engine.records.records(); ++r)
    all.point.starts.row(r) = found.states.row(engine.records.first(r));
  for (const Window& window : found.windows) all.begins.push_back(window.first);
  return all;
}

Dataset cut_at(const Dataset& records, const std::vector<Index>& begins) {
  Dataset cut = records;
  cut.trajectories.clear();
  Index first = 0;
  for (const Trajectory& record : records.trajectories) {
    const Index end = first + record.samples();
    auto begin = std::lower_bound(begins.begin(), begins.end(), first);
    const auto last = std::lower_bound(begin, begins.end(), end);
    for (std::size_t number = 1; begin != last; ++begin, ++number) {
      const Index next = begin + 1 == last ? end : *(begin + 1);
      cut.trajectories.push_back(rows_of(record, *begin - first, next - *begin));
      cut.trajectories.back().source = piece_name(record.source, number);
    }
    first = end;
  }
  return cut;
}

}  // namespace lacuna
