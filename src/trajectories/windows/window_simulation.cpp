// SPDX-License-Identifier: MIT
#include "window_simulation.hpp"

#include <algorithm>
#include <numeric>

namespace lacuna {
namespace {

/// Fewer windows than this are cheaper to simulate one by one than as a block.
constexpr Index kFewLanes = 4;

}  // namespace

void make_room(const StageSignals& signals, Index dimension, Index samples, Orbits& orbits) {
  orbits.samples.resize(samples, dimension);
  orbits.stages.resize(signals.stages.size());
  for (Matrix& stage : orbits.stages) stage.resize(signals.lengths.size(), dimension);
}

std::vector<Index> diverged_windows(const WindowPlan& plan, const Orbits& orbits) {
  std::vector<Index> diverged;
  for (std::size_t w = 0; w < plan.size(); ++w)
    if (!orbits.samples.middleRows(plan[w].first, plan[w].samples).allFinite())
      diverged.push_back(static_cast<Index>(w));
  return diverged;
}

WindowSimulator::WindowSimulator(const StageSignals& signals, Index dimension)
    : signals_(signals), dimension_(dimension) {}

void WindowSimulator::prepare(const Rates& rates, Index windows) {
  const std::size_t stages = signals_.stages.size();
  slopes_.assign(stages, Matrix(windows, dimension_));
  point_.resize(windows, rates.slots());
  gathered_.resize(windows, rates.signals());
  lengths_.resize(windows);
  steps_.resize(static_cast<std::size_t>(windows));
  slot_.resize(static_cast<std::size_t>(rates.slots()));
  slope_.resize(stages * static_cast<std::size_t>(dimension_));
}

void WindowSimulator::run(Rates& rates, const WindowPlan& plan, const WindowRange& range,
                          const Matrix& starts, Orbits& orbits) {
  prepare(rates, range.count);
  order_.resize(static_cast<std::size_t>(range.count));
  std::iota(order_.begin(), order_.end(), range.first);
  plan_ = &plan;
  std::stable_sort(order_.begin(), order_.end(), [&](Index a, Index b) {
    return plan[static_cast<std::size_t>(a)].intervals >
           plan[static_cast<std::size_t>(b)].intervals;
  });
  states_ = starts(order_, Eigen::all);
  Index active = range.count, step = 0;
  for (; active > 0; ++step) {
    for (Index lane = 0; lane < active; ++lane)
      note_sample(lane_window(lane), lane, step, orbits);
    while (active > 0 && lane_window(active - 1).intervals * substeps() <= step) --active;
    if (active < kFewLanes) break;
    step_block(rates, active, step, orbits);
  }
  for (Index lane = 0; lane < active; ++lane)
    finish(rates, lane_window(lane), lane, step, orbits);
}

void WindowSimulator::note_sample(const Window& window, Index lane, Index step,
                                  Orbits& orbits) const {
  const Index sample = step / substeps();
  if (step % substeps() != 0 || sample >= window.samples) return;
  for (Index k = 0; k < dimension_; ++k)
    orbits.samples(window.first + sample, k) = states_(lane, k);
}

void WindowSimulator::step_block(Rates& rates, Index active, Index step, Orbits& orbits) {
  find_steps(active, step);
  for (std::size_t a = 0; a < slopes_.size(); ++a) {
    move(static_cast<Index>(a), active);
    gather(signals_.stages[a], active);
    rates.fill_signals(gathered_.topRows(active), point_.topRows(active));
    rates.rate(point_.topRows(active), slopes_[a].topRows(active));
    slopes_[a].topRows(active).array().colwise() *= lengths_.head(active).array();
    scatter(orbits.stages[a], active);
  }
  const std::vector<double>& weights = signals_.scheme.tableau->weights;
  for (std::size_t a = 0; a < slopes_.size(); ++a)
    if (weights[a] != 0.0) states_.topRows(active) += weights[a] * slopes_[a].topRows(active);
}

/// Numbers and lengths of the steps that the lanes make next.
void WindowSimulator::find_steps(Index active, Index step) {
  for (Index lane = 0; lane < active; ++lane) {
    const Index row = lane_window(lane).first * substeps() + step;
    steps_[static_cast<std::size_t>(lane)] = row;
    lengths_[lane] = signals_.lengths[row];
  }
}

void WindowSimulator::gather(const Matrix& signals, Index active) {
  for (Index column = 0; column < signals.cols(); ++column) {
    const double* from = signals.col(column).data();
    double* to = gathered_.col(column).data();
    for (Index lane = 0; lane < active; ++lane)
      to[lane] = from[steps_[static_cast<std::size_t>(lane)]];
  }
}

void WindowSimulator::scatter(Matrix& states, Index active) const {
  for (Index k = 0; k < dimension_; ++k) {
    const double* from = point_.col(k).data();
    double* to = states.col(k).data();
    for (Index lane = 0; lane < active; ++lane)
      to[steps_[static_cast<std::size_t>(lane)]] = from[lane];
  }
}

/// The states at which stage a evaluates f.
void WindowSimulator::move(Index stage, Index active) {
  auto point = point_.topLeftCorner(active, dimension_);
  point = states_.topRows(active);
  const auto& row = signals_.scheme.tableau->a[static_cast<std::size_t>(stage)];
  for (std::size_t d = 0; d < row.size(); ++d)
    if (row[d] != 0.0) point += row[d] * slopes_[d].topRows(active);
}

/// One window alone, from a step to its end.
void WindowSimulator::finish(Rates& rates, const Window& window, Index lane, Index step,
                             Orbits& orbits) {
  const ButcherTableau& tableau = *signals_.scheme.tableau;
  const auto m = static_cast<std::size_t>(dimension_);
  const Index end = window.intervals * substeps(), steps = signals_.lengths.size();
  Vector x = states_.row(lane);
  while (step < end) {
    const Index row = window.first * substeps() + step;
    const double h = signals_.lengths[row];
    for (std::size_t a = 0; a < slopes_.size(); ++a) {
      for (std::size_t k = 0; k < m; ++k) {
        double sum = 0.0;
        for (std::size_t d = 0; d < a; ++d) sum += tableau.a[a][d] * slope_[d * m + k];
        slot_[k] = x[static_cast<Index>(k)] + h * sum;
        orbits.stages[a](row, static_cast<Index>(k)) = slot_[k];
      }
      rates.fill_signals(signals_.stages[a].data() + row, steps, slot_.data());
      rates.rate(slot_.data(), slope_.data() + a * m);
    }
    for (std::size_t a = 0; a < slopes_.size(); ++a)
      for (std::size_t k = 0; k < m; ++k)
        x[static_cast<Index>(k)] += h * tableau.weights[a] * slope_[a * m + k];
    ++step;
    states_.row(lane) = x;
    note_sample(window, lane, step, orbits);
  }
}

}  // namespace lacuna
