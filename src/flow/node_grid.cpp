// SPDX-License-Identifier: MIT
#include "lacuna/flow/node_grid.hpp"

namespace lacuna {

Vector node_times(const Vector& time, Index parts) {
  const Index n = time.size();
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
                     const std::vector<DelayedVariable>& delays, Interpolation interpolation) {
  const Index last = slots.cols() - 1;
  const auto samples = Eigen::seq(0, slots.rows() - 1, parts);
  Matrix result(slots.rows(), static_cast<Index>(delays.size()));
  for (std::size_t d = 0; d < delays.size(); ++d) {
    const Vector values = slots.col(delays[d].slot)(samples);
    SampledSignal signal(slots.col(last)(samples), values, interpolation);
    for (Index node = 0; node < slots.rows(); ++node)
      result(node, static_cast<Index>(d)) = signal(slots(node, last) - delays[d].delay);
  }
  return result;
}

}  // namespace lacuna
