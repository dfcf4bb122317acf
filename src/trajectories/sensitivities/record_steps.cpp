// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/record_steps.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "lacuna/core/numerics/sampled_signal.hpp"
#include "parabolas.hpp"

namespace lacuna {
namespace {

/// Steps that are done together and stay in cache.
constexpr std::size_t kBlock = 256;

/// A block of steps on its way from their begins to their ends.
class StepBlock {
 public:
  StepBlock(Rates& rates, const StepSlots& slots, std::span<const Index> steps)
      : rates_(rates),
        slots_(slots),
        steps_(steps),
        point_(static_cast<Index>(steps.size()), slots.nodes.cols()),
        length_(point_.rows()),
        slope_(point_.rows(), slots.states) {
    for (Index row = 0; row < point_.rows(); ++row) {
      const Index i = step_at(row);
      point_.row(row) = slots.nodes.row(slots.grid.begin(i));
      length_[row] = slots.length(i);
    }
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
      if (stage != 2) set_driven((part + kNode[stage]) / parts);
      rates_.rate(point_, slope_);
      sum += kWeight[stage] * slope_;
    }
    state_ += (length_ / (6.0 * parts)).asDiagonal() * sum;
  }

  /// Inputs, t and delayed variables at the fraction `s` of the steps.
  void set_driven(double s) {
    const std::array<double, 3> weight = parabolas(s);
    const double cubic = s * (s - 0.5) * (s - 1.0);
    for (Index column = slots_.states; column < slots_.nodes.cols(); ++column)
      for (Index row = 0; row < point_.rows(); ++row)
        point_(row, column) = slots_.driven(step_at(row), column, weight, cubic);
  }

  Rates& rates_;
  const StepSlots& slots_;
  std::span<const Index> steps_;
  Matrix point_;
  Vector length_;
  Matrix slope_, state_;
};

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
    if (grid.signal(variable) != Interpolation::Cubic) continue;
    const Vector values = nodes.col(column)(samples);
    const SampledSignal signal(nodes.col(time)(samples), values);
    for (Index i = 0; i < steps(); ++i)
      third(i, column - states) =
          signal.third_difference(i) * length(i) * length(i) * length(i);
  }
}

Matrix ends_of_steps(Rates& rates, const StepSlots& slots, const std::vector<Index>& steps,
                     int parts) {
  Matrix ends(static_cast<Index>(steps.size()), slots.states);
  const std::span<const Index> all(steps);
  for (std::size_t first = 0; first < steps.size(); first += kBlock) {
    const auto block = all.subspan(first, std::min(kBlock, steps.size() - first));
    ends.middleRows(static_cast<Index>(first), static_cast<Index>(block.size())) =
        StepBlock(rates, slots, block).run(parts);
  }
  return ends;
}

std::vector<int> parts_for(Rates& rates, const StepSlots& slots,
                           const std::vector<Vector>& accuracies) {
  constexpr Index kTried = 400;
  const Index count = slots.steps();
  std::vector<Index> steps;
  for (Index i = 0; i < count; i += std::max<Index>(1, count / kTried)) steps.push_back(i);
  std::vector<int> found(accuracies.size(), kMostParts);
  std::size_t open = found.size();
  Matrix coarse = ends_of_steps(rates, slots, steps, 1);
  for (int parts = 1; parts < kMostParts && open > 0; parts *= 2) {
    Matrix fine = ends_of_steps(rates, slots, steps, 2 * parts);
    const Vector error = (coarse - fine).cwiseAbs().colwise().maxCoeff();
    for (std::size_t a = 0; a < found.size(); ++a) {
      if (found[a] < kMostParts || !(error.array() <= 0.1 * accuracies[a].array()).all())
        continue;
      found[a] = parts;
      --open;
    }
    coarse = std::move(fine);
  }
  return found;
}

}  // namespace lacuna
