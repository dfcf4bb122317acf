// SPDX-License-Identifier: MIT
#include "lacuna/records/channels/node_grid.hpp"

#include <algorithm>
#include <utility>

#include "core/base/check.hpp"

namespace lacuna {

Vector node_times(const Vector& time, Index parts) {
  constexpr Index kMost = Index{1} << 32;  // a fact of memory: more nodes have no room
  const Index n = time.size();
  check_argument(n >= 1 && parts >= 1 && parts <= kMost / n, "node_times",
                 "there are no samples or no parts", "give one at least");
  Vector nodes((n - 1) * parts + 1);
  for (Index i = 0; i + 1 < n; ++i)
    for (Index s = 0; s < parts; ++s)
      nodes[i * parts + s] = time[i] + (time[i + 1] - time[i]) * static_cast<double>(s) /
                                           static_cast<double>(parts);
  nodes[nodes.size() - 1] = time[n - 1];
  return nodes;
}

Matrix node_slots(const Vector& time, const Matrix& values, Index parts,
                  Interpolation interpolation) {
  const Index width = values.cols();
  const Vector nodes = node_times(time, parts);
  Matrix slots(nodes.size(), width + 1);
  for (Index column = 0; column < width; ++column) {
    const SampledSignal signal(time, values.col(column), interpolation);
    double* out = slots.col(column).data();
    for (Index node = 0; node < nodes.size(); ++node)
      out[node] = node % parts == 0 ? values(node / parts, column)
                                    : signal.in_interval(node / parts, nodes[node]);
  }
  slots.col(width) = nodes;
  return slots;
}

Matrix delayed_slots(const Eigen::Ref<const Matrix>& slots, Index parts,
                     const std::vector<DelayedVariable>& delays) {
  const Index last = slots.cols() - 1;
  const auto samples = Eigen::seq(0, slots.rows() - 1, parts);
  Matrix result(slots.rows(), static_cast<Index>(delays.size()));
  for (std::size_t d = 0; d < delays.size(); ++d) {
    const Vector values = slots.col(delays[d].slot)(samples);
    SampledSignal signal(slots.col(last)(samples), values);
    for (Index node = 0; node < slots.rows(); ++node)
      result(node, static_cast<Index>(d)) = signal(slots(node, last) - delays[d].delay);
  }
  return result;
}

StepGrid step_grid(std::vector<Interpolation> signals) {
  StepGrid grid{2, std::move(signals)};
  const bool jumps = std::find(grid.signals.begin(), grid.signals.end(), Interpolation::Held) !=
                     grid.signals.end();
  if (jumps) grid.stride = 3;
  return grid;
}

Matrix step_slots(const Vector& time, const Matrix& values, const StepGrid& grid) {
  check_times(time, 1, "step_slots");
  check_argument(values.rows() == time.size(), "step_slots",
                 "times and values differ in number");
  check_argument(grid.stride == 2 || grid.stride == 3, "step_slots", "there is no such grid");
  check_argument(
      grid.signals.empty() || static_cast<Index>(grid.signals.size()) >= values.cols(),
      "step_slots", "the grid has not a signal for each column");
  const Index width = values.cols(), steps = time.size() - 1;
  const Vector nodes = node_times(time, 2);
  Matrix slots(grid.rows(time.size()), width + 1);
  for (Index i = 0; i < steps; ++i) {
    slots.row(grid.begin(i)) << values.row(i), time[i];
    slots.row(grid.end(i)) << values.row(i + 1), time[i + 1];
    slots(grid.middle(i), width) = nodes[2 * i + 1];
  }
  slots.bottomRows<1>() << values.bottomRows<1>(), time[steps];
  for (Index column = 0; column < width; ++column) {
    const SampledSignal signal(time, values.col(column), grid.signal(column));
    for (Index i = 0; i < steps; ++i) {
      slots(grid.middle(i), column) = signal.in_interval(i, nodes[2 * i + 1]);
      if (grid.is_held(column)) slots(grid.end(i), column) = values(i, column);
    }
  }
  return slots;
}

namespace {

void write_delayed_held(const Eigen::Ref<const Matrix>& slots, const StepGrid& grid,
                        const DelayedVariable& delay, Eigen::Ref<Vector> out) {
  const auto samples = Eigen::seq(0, slots.rows() - 1, grid.stride);
  const Vector time = slots.col(slots.cols() - 1)(samples);
  SampledSignal signal(time, slots.col(delay.slot)(samples), Interpolation::Held);
  for (Index i = 0; i + 1 < time.size(); ++i) {
    const double from = time[i] - delay.delay, to = time[i + 1] - delay.delay;
    const SpanCurve curve =
        delay.affine ? signal.held_moments(from, to) : signal.held_line(from, to);
    out.segment<3>(grid.begin(i)) << curve.at(0.0), curve.at(0.5), curve.at(1.0);
  }
  out[out.size() - 1] = out[out.size() - 2];
}

}  // namespace

Matrix delayed_step_slots(const Eigen::Ref<const Matrix>& slots, const StepGrid& grid,
                          const std::vector<DelayedVariable>& delays) {
  Matrix result = delayed_slots(slots, grid.stride, delays);
  for (std::size_t d = 0; d < delays.size(); ++d)
    if (grid.is_held(delays[d].slot))
      write_delayed_held(slots, grid, delays[d], result.col(static_cast<Index>(d)));
  return result;
}

}  // namespace lacuna
