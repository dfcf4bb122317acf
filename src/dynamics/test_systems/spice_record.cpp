// SPDX-License-Identifier: MIT
#include "dynamics/test_systems/spice_record.hpp"

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "core/numerics/lagrange.hpp"

namespace lacuna {
namespace {

/// "x" from "v(x)".
std::string node_of(const std::string& variable) {
  const bool voltage = variable.size() > 3 && variable.rfind("v(", 0) == 0;
  return voltage ? variable.substr(2, variable.size() - 3) : variable;
}

/// Reads the head up to "Values:"; names of the variables, time first.
std::vector<std::string> read_head(std::istream& file, const std::string& source) {
  std::vector<std::string> names;
  bool listing = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("Values:", 0) == 0 && names.size() > 1) return names;
    if (line.rfind("Variables:", 0) == 0) {
      listing = true;
    } else if (listing) {
      std::istringstream fields(line);
      std::string number, name;
      fields >> number >> name;
      names.push_back(node_of(name));
    }
  }
  throw DataError(source, "it is not a text file of ngspice",
                  "let ngspice write it with .options filetype=ascii");
}

/// The numbers of all points, without the points' own numbers.
std::vector<double> read_values(std::istream& file, std::size_t variables) {
  std::vector<double> values;
  std::vector<double> point(variables);
  for (std::size_t number = 0; file >> number;) {
    for (double& value : point) file >> value;
    if (file) values.insert(values.end(), point.begin(), point.end());
  }
  return values;
}

}  // namespace

Dataset read_spice_output(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw FileError(path.string(), "cannot be read", "look at the log of ngspice");
  const std::vector<std::string> names = read_head(file, path.string());
  const std::vector<double> values = read_values(file, names.size());
  const Index columns = static_cast<Index>(names.size());
  const Index rows = static_cast<Index>(values.size()) / columns;
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> all(values.data(), rows, columns);
  Dataset record;
  for (std::size_t k = 1; k < names.size(); ++k) record.states.push_back({names[k], "V"});
  Trajectory run;
  run.source = path.string();
  run.time = all.col(0);
  run.states = all.rightCols(columns - 1);
  run.inputs.resize(rows, 0);
  record.trajectories = {run};
  check_dataset(record);
  return record;
}

Dataset resampled(const Dataset& record, double begin, double unit, double h, Index n) {
  constexpr Index kMost = Index{1} << 32;  // a fact of memory: more have no room
  check_dataset(record);
  check_argument(n >= 1 && n <= kMost && h > 0.0 && unit > 0.0 && std::isfinite(begin),
                 "resampled", "there are no such samples", "give a step and a unit above 0");
  const Trajectory& run = record.trajectories[0];
  const double end = begin + h * unit * static_cast<double>(n - 1);
  if (!(run.time[run.time.size() - 1] >= end))
    throw DataError(run.source, "the simulation ends before " + std::to_string(end) + " s",
                    "look at its log");
  Dataset result = record;
  result.time_unit = "tau";
  Trajectory& grid = result.trajectories[0];
  grid.time = Vector::LinSpaced(n, 0.0, h * static_cast<double>(n - 1));
  grid.inputs.resize(n, 0);
  grid.states.resize(n, run.states.cols());
  LagrangeInterpolant signal(run.time, run.states, LagrangeWindow::centred(6));
  Vector point(run.states.cols());
  for (Index i = 0; i < n; ++i) {
    const double t = begin + unit * grid.time[i];
    signal.select(signal.interval_of(t));
    signal.evaluate(t, point.data());
    grid.states.row(i) = point.transpose();
  }
  return result;
}

}  // namespace lacuna
