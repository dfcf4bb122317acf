// SPDX-License-Identifier: MIT
#include "studies/scaling/records.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/base/random.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"

namespace lacuna::benchmarks {
namespace {

/// Goes along the orbit piece by piece.
class Orbit {
 public:
  explicit Orbit(const RecordProblem& problem)
      : problem_(problem), state_(Vector::LinSpaced(problem.model.dimension(), 1.0, 2.0)) {
    constexpr Index kTransient = 2000, kForScale = 20000;
    next_states(kTransient);
    const Vector here = state_;
    const Matrix begin = next_states(kForScale);
    state_ = here;
    scale_ =
        ((begin.rowwise() - begin.colwise().mean()).array().square().colwise().mean().sqrt())
            .matrix()
            .transpose();
  }

  /// The next samples; time goes on.
  Trajectory next(Index rows) {
    Trajectory record;
    record.source = problem_.name;
    record.time = sample_times(problem_.step * double(done_), problem_.step, rows);
    done_ += rows;
    record.states = next_states(rows);
    record.inputs.resize(rows, 0);
    if (problem_.derivatives) add_derivatives(record);
    for (Index k = 0; k < scale_.size(); ++k)
      for (double& value : record.states.col(k))
        value += problem_.noise * scale_[k] * random_.normal();
    return record;
  }

 private:
  Matrix next_states(Index rows) {
    const Solution orbit =
        simulate(problem_.model, dopri8(), state_, sample_times(0.0, problem_.step, rows + 1));
    state_ = orbit.states.row(rows).transpose();
    return orbit.states.topRows(rows);
  }

  void add_derivatives(Trajectory& record) const {
    CompiledModel compiled = problem_.model.compile();
    record.derivatives.resize(record.samples(), record.states.cols());
    Vector rates(record.states.cols());
    for (Index i = 0; i < record.samples(); ++i) {
      const Vector state = record.states.row(i).transpose();
      compiled.evaluate(record.time[i], state.data(), nullptr, nullptr, rates.data());
      record.derivatives.row(i) = rates.transpose();
    }
  }

  const RecordProblem& problem_;
  Vector state_, scale_;
  Random random_{1};
  Index done_ = 0;
};

std::vector<std::string> column_names(const RecordProblem& problem) {
  std::vector<std::string> names{"t"};
  for (const Quantity& state : problem.model.states()) names.push_back(state.name);
  if (problem.derivatives)
    for (const Quantity& state : problem.model.states()) names.push_back("d" + state.name);
  return names;
}

std::string header_of(Index rows, std::size_t columns) {
  std::string text = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                     std::to_string(rows) + ", " + std::to_string(columns) + "), }";
  text.append(117 - text.size(), ' ');
  return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + text + '\n';
}

}  // namespace

Dataset record_of(const RecordProblem& problem) {
  Dataset data;
  data.states = problem.model.states();
  data.trajectories.push_back(Orbit(problem).next(problem.rows));
  return data;
}

void write_record(const RecordProblem& problem, const std::filesystem::path& path) {
  constexpr Index kTogether = 100000;
  std::ofstream file(path, std::ios::binary);
  file << header_of(problem.rows, column_names(problem).size());
  Orbit orbit(problem);
  for (Index done = 0; done < problem.rows; done += kTogether) {
    const Trajectory part = orbit.next(std::min(kTogether, problem.rows - done));
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(
        part.samples(), 1 + part.states.cols() + part.derivatives.cols());
    values << part.time, part.states, part.derivatives;
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * Index{sizeof(double)}));
  }
}

ColumnRoles file_roles(const RecordProblem& problem) {
  ColumnRoles roles;
  const std::vector<std::string> names = column_names(problem);
  for (std::size_t i = 0; i < names.size(); ++i)
    roles.names.emplace_back(names[i], std::to_string(i + 1));
  const auto states = static_cast<std::ptrdiff_t>(problem.model.states().size());
  roles.states.assign(names.begin() + 1, names.begin() + 1 + states);
  roles.derivatives.assign(names.begin() + 1 + states, names.end());
  return roles;
}

}  // namespace lacuna::benchmarks
