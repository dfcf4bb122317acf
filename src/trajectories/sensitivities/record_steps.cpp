// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/record_steps.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "lacuna/core/numerics/sampled_signal.hpp"
#include "parabolas.hpp"

namespace lacuna {
namespace {

/// A block of steps on its way from their begins to their ends.
class StepBlock {
 public:
  /// @param begin_rates of the model where the steps begin.
  StepBlock(const Rates& rates, const StepSlots& slots, std::span<const Index> steps,
            const Eigen::Ref<const Matrix>& begin_rates)
      : rates_(rates),
        slots_(slots),
        steps_(steps),
        point_(static_cast<Index>(steps.size()), slots.nodes.cols()),
        length_(point_.rows()),
        slope_(point_.rows(), slots.states),
        block_(rates.block(point_.rows())) {
    for (Index row = 0; row < point_.rows(); ++row) {
      const Index i = step_at(row);
      point_.row(row) = slots.nodes.row(slots.grid.begin(i));
      length_[row] = slots.length(i);
      slope_.row(row) = begin_rates.row(row);
    }
    for (Index k = 0; k < slots.states; ++k) all_states_ |= Program::slot_set(k);
    state_ = point_.leftCols(slots.states);
  }

  Matrix run(int parts) {
    for (int part = 0; part < parts; ++part) runge_kutta(part, parts);
    return state_;
  }

 private:
  Index step_at(Index row) const { return steps_[static_cast<std::size_t>(row)]; }

  void runge_kutta(int part, int parts) {
    constexpr std::array<double, 4> kNode{0.0, 0.5, 0.5, 1.0}, kWeight{1.0, 2.0, 2.0, 1.0};
    Matrix sum = Matrix::Zero(state_.rows(), state_.cols());
    for (std::size_t stage = 0; stage < 4; ++stage) {
      point_.leftCols(slots_.states) = state_;
      if (stage > 0)
        point_.leftCols(slots_.states) +=
            (kNode[stage] / parts * length_).asDiagonal() * slope_;
      find_slope(part, parts, stage, kNode[stage]);
      sum += kWeight[stage] * slope_;
    }
    state_ += (length_ / (6.0 * parts)).asDiagonal() * sum;
  }

  /// The rates of a stage. Those at the begin are there already; the second stage in the middle
  /// and the first one of a later part are where the stage before was, with other states.
  void find_slope(int part, int parts, std::size_t stage, double node) {
    const bool is_there = part == 0 && stage == 0;
    const bool only_states = stage == 2 || (stage == 0 && !is_there);
    if (is_there) return;
    if (only_states) {
      rates_.rate_changed(point_, all_states_, block_, slope_);
      return;
    }
    set_driven((part + node) / parts);
    rates_.rate(point_, block_, slope_);
  }

  /// Inputs, t and delayed variables at the fraction `s` of the steps.
  void set_driven(double s) {
    const std::array<double, 3> weight = parabolas(s);
    const double cubic = s * (s - 0.5) * (s - 1.0);
    for (Index column = slots_.states; column < slots_.nodes.cols(); ++column)
      for (Index row = 0; row < point_.rows(); ++row)
        point_(row, column) = slots_.driven(step_at(row), column, weight, cubic);
  }

  const Rates& rates_;
  const StepSlots& slots_;
  std::span<const Index> steps_;
  Matrix point_;
  Vector length_;
  Matrix slope_, state_;
  Program::Block block_;
  Program::SlotSet all_states_ = 0;
};

/// Rows in which two ends of a step differ by more than a tenth of what is accurate enough.
std::vector<Index> steps_off(const Matrix& coarse, const Matrix& fine, const Vector& accuracy) {
  std::vector<Index> rows;
  for (Index i = 0; i < coarse.rows(); ++i)
    if (!((coarse.row(i) - fine.row(i)).array().abs() <= 0.1 * accuracy.array().transpose())
             .all())
      rows.push_back(i);
  return rows;
}

}  // namespace

StepSlots::StepSlots(Matrix slots, Index state_count,
                     const std::vector<DelayedVariable>& delays, StepGrid step_grid)
    : states(state_count),
      time(slots.cols() - 1 - static_cast<Index>(delays.size())),
      grid(std::move(step_grid)),
      nodes(std::move(slots)),
      third(Matrix::Zero(steps(), nodes.cols() - states)) {
  const auto samples = Eigen::seq(0, nodes.rows() - 1, grid.stride);
  for (Index column = states; column < nodes.cols(); ++column) {
    if (column == time) continue;
    const Index variable =
        column < time ? column : delays[static_cast<std::size_t>(column - time - 1)].slot;
    if (!is_smooth(grid.signal(variable))) continue;
    const Vector values = nodes.col(column)(samples);
    const SampledSignal signal(nodes.col(time)(samples), values);
    for (Index i = 0; i < steps(); ++i)
      third(i, column - states) =
          signal.third_difference(i) * length(i) * length(i) * length(i);
  }
}

Matrix rates_at_begins(Rates& rates, const StepSlots& slots, const std::vector<Index>& steps) {
  Matrix points(static_cast<Index>(steps.size()), slots.nodes.cols());
  for (Index row = 0; row < points.rows(); ++row)
    points.row(row) = slots.nodes.row(slots.grid.begin(steps[static_cast<std::size_t>(row)]));
  Matrix f(points.rows(), slots.states);
  rates.rate(points, f);
  return f;
}

Matrix ends_of_steps(const Rates& rates, const StepSlots& slots,
                     const std::vector<Index>& steps, const Matrix& begin_rates, int parts) {
  constexpr auto kBlock = static_cast<std::size_t>(Program::kBlockRows);
  Matrix ends(static_cast<Index>(steps.size()), slots.states);
  const std::span<const Index> all(steps);
  for (std::size_t begin = 0; begin < steps.size(); begin += kBlock) {
    const auto block = all.subspan(begin, std::min(kBlock, steps.size() - begin));
    const auto first = static_cast<Index>(begin), count = static_cast<Index>(block.size());
    ends.middleRows(first, count) =
        StepBlock(rates, slots, block, begin_rates.middleRows(first, count)).run(parts);
  }
  return ends;
}

Matrix ends_of_steps(Rates& rates, const StepSlots& slots, const std::vector<Index>& steps,
                     int parts) {
  return ends_of_steps(rates, slots, steps, rates_at_begins(rates, slots, steps), parts);
}

FoundParts parts_for(Rates& rates, const StepSlots& slots,
                     const std::vector<Vector>& accuracies) {
  constexpr Index kTried = 400;
  const Index count = slots.steps();
  FoundParts found{std::vector<int>(accuracies.size(), kMostParts), {}, {}};
  for (Index i = 0; i < count; i += std::max<Index>(1, count / kTried))
    found.tried.push_back(i);
  const Matrix begin_rates = rates_at_begins(rates, slots, found.tried);
  const auto few = static_cast<Index>(found.tried.size() / 10);
  std::size_t open = found.parts.size();
  Matrix coarse = ends_of_steps(rates, slots, found.tried, begin_rates, 1);
  for (int parts = 1; parts < kMostParts && open > 0; parts *= 2) {
    Matrix fine = ends_of_steps(rates, slots, found.tried, begin_rates, 2 * parts);
    for (std::size_t a = 0; a < accuracies.size(); ++a) {
      const Index off = static_cast<Index>(steps_off(coarse, fine, accuracies[a]).size());
      if (found.parts[a] < kMostParts || off > (a == 0 ? few : 0)) continue;
      found.parts[a] = parts;
      if (a == 0) found.some_need_more = off > 0;
      --open;
    }
    if (found.parts.front() == parts) found.ends = coarse;
    coarse = std::move(fine);
  }
  if (found.parts.front() == kMostParts) found.ends = std::move(coarse);
  return found;
}

std::optional<Matrix> refined_ends(const Rates& rates, const StepSlots& slots, Matrix ends,
                                   const Matrix& begin_rates, int parts,
                                   const Vector& accuracy) {
  std::vector<Index> open(static_cast<std::size_t>(slots.steps()));
  std::iota(open.begin(), open.end(), Index{0});
  for (; parts < kMostPartsOfOne && !open.empty(); parts *= 2) {
    const Matrix fine =
        ends_of_steps(rates, slots, open, begin_rates(open, Eigen::all), 2 * parts);
    std::vector<Index> still;
    for (const Index row : steps_off(ends(open, Eigen::all), fine, accuracy)) {
      still.push_back(open[static_cast<std::size_t>(row)]);
      ends.row(still.back()) = fine.row(row);
    }
    open = std::move(still);
  }
  if (!ends(open, Eigen::all).allFinite()) return std::nullopt;
  return ends;
}

}  // namespace lacuna
