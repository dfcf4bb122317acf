// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <fstream>
#include <string>

#include "core/base/random.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "support/one_record.hpp"

namespace lacuna::testing {

/// x = sin(w t), v = dx/dt, with white noise, in the states of one record.
/// @param per_period samples of a period.
inline Dataset long_oscillation(Index samples, double per_period, double noise = 0.0) {
  constexpr double kTurn = 6.283185307179586;
  Random random(3);
  Trajectory record;
  record.source = "swing";
  record.time = Vector::LinSpaced(samples, 0.0, 0.01 * static_cast<double>(samples - 1));
  record.states.resize(samples, 2);
  const double w = kTurn / (0.01 * per_period);
  for (Index i = 0; i < samples; ++i) {
    record.states(i, 0) = std::sin(w * record.time[i]) + noise * random.normal();
    record.states(i, 1) = w * std::cos(w * record.time[i]) + w * noise * random.normal();
  }
  return support::one_record({{"x", "m"}, {"v", "m/s"}}, {}, std::move(record));
}

/// Time and states as a file has them.
inline Matrix table_of(const Dataset& data) {
  const Trajectory& record = data.trajectories[0];
  Matrix values(record.samples(), 1 + record.states.cols());
  values << record.time, record.states;
  return values;
}

/// Writes a file as NumPy does, in C order. @return its path.
inline std::string write_rows(const std::string& path, const Matrix& values) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                       std::to_string(values.rows()) + ", " + std::to_string(values.cols()) +
                       "), }";
  header.append(118 - header.size() - 1, ' ');
  header += '\n';
  std::ofstream file(path, std::ios::binary);
  file << std::string("\x93NUMPY\x01\x00", 8) << static_cast<char>(header.size()) << '\0'
       << header;
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = values;
  file.write(reinterpret_cast<const char*>(rows.data()),
             static_cast<std::streamsize>(rows.size() * 8));
  return path;
}

}  // namespace lacuna::testing
