// SPDX-License-Identifier: MIT
#include "window_paths.hpp"

#include <limits>

#include "lacuna/trajectories/smoother/innovation_filter.hpp"

namespace lacuna {

Matrix window_paths(const LinearisedRecord& record, const MarkedSamples& measured,
                    const NoiseModel& noise, const WindowGrid& grid) {
  NoiseModel exact = noise;
  exact.disturbance.setZero();
  Matrix paths = Matrix::Constant(record.samples(), record.states(),
                                  std::numeric_limits<double>::quiet_NaN());
  for (Index first = grid.begin; first + grid.length <= record.samples();
       first += grid.length) {
    const LinearisedRecord window = part_of(record, first, grid.length);
    const Matrix marks = measured.marks.size() > 0
                             ? Matrix(measured.marks.middleRows(first, grid.length))
                             : Matrix();
    const SmoothedRecord smoothed =
        smooth(window, measured.values.middleRows(first, grid.length), marks, exact);
    paths.middleRows(first, grid.length) = window.path + smoothed.deviation;
  }
  return paths;
}

}  // namespace lacuna
