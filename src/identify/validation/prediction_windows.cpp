// SPDX-License-Identifier: MIT
#include "prediction_windows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/numerics/qr.hpp"
#include "dynamics/integration/automatic.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/trajectories/sensitivities/linearised_record.hpp"

namespace lacuna {
namespace {

/// One window of a linearised record.
struct Window {
  Index first = 0;
  Index length = 0;
};

/// The solution in a window: deviations of the states from the path, and what it leaves.
struct WindowSolution {
  Matrix deviation;  ///< length x m
  Matrix residual;   ///< length x m, 0 where a sample does not count
  Matrix freedom;    ///< length x m
};

/// Transitions from the first sample of a window, and the deviations of a solution that starts
/// on the path.
struct WindowFlow {
  std::vector<Matrix> transitions;
  Matrix shifts;  ///< m x length
};

WindowFlow flow_of(const LinearisedRecord& record, const Window& window) {
  const Index m = record.states();
  WindowFlow flow{{Matrix::Identity(m, m)}, Matrix::Zero(m, window.length)};
  for (Index i = 1; i < window.length; ++i) {
    const Index step = window.first + i - 1;
    const Vector column = record.transition.col(step);
    const Matrix phi = Eigen::Map<const Matrix>(column.data(), m, m);
    flow.transitions.push_back(phi * flow.transitions.back());
    flow.shifts.col(i) = phi * flow.shifts.col(i - 1) + record.defect.col(step);
  }
  return flow;
}

bool is_finite(const WindowFlow& flow) {
  return flow.shifts.allFinite() &&
         std::all_of(flow.transitions.begin(), flow.transitions.end(),
                     [](const Matrix& phi) { return phi.allFinite(); });
}

/// The least-squares problem of the initial state, a row for each sample that counts.
struct StartProblem {
  Matrix columns;
  Vector target;
  std::vector<std::pair<Index, Index>> places;  ///< sample in the window, state
};

StartProblem start_problem(const PredictedRecord& record, const LinearisedRecord& linear,
                           const Window& window, const WindowFlow& flow) {
  StartProblem problem;
  for (Index i = 0; i < window.length; ++i)
    for (Index k = 0; k < linear.states(); ++k)
      if (record.deviations(window.first + i, k) > 0.0) problem.places.emplace_back(i, k);
  const auto rows = static_cast<Index>(problem.places.size());
  problem.columns.resize(rows, linear.states());
  problem.target.resize(rows);
  for (Index row = 0; row < rows; ++row) {
    const auto [i, k] = problem.places[static_cast<std::size_t>(row)];
    const Index n = window.first + i;
    const double weight = 1.0 / record.deviations(n, k);
    problem.columns.row(row) = weight * flow.transitions[static_cast<std::size_t>(i)].row(k);
    problem.target[row] =
        weight * (record.samples.states(n, k) - linear.path(n, k) - flow.shifts(k, i));
  }
  return problem;
}

/// Nothing where the model has no finite solution in the window.
std::optional<WindowSolution> solve(const PredictedRecord& record,
                                    const LinearisedRecord& linear, const Window& window) {
  // A fact of rounding.
  constexpr double kRank = 1e-10;
  const WindowFlow flow = flow_of(linear, window);
  if (!is_finite(flow)) return std::nullopt;
  const StartProblem problem = start_problem(record, linear, window, flow);
  const Index m = linear.states(), rows = problem.target.size();
  WindowSolution solution{Matrix::Zero(window.length, m), Matrix::Zero(window.length, m),
                          Matrix::Zero(window.length, m)};
  if (rows == 0) return solution;
  const Vector norms = problem.columns.colwise().norm().cwiseMax(1e-300);
  const PivotedQr factor(problem.columns * norms.cwiseInverse().asDiagonal(), kRank);
  const Vector start = factor.solve(problem.target).cwiseQuotient(norms);
  const Matrix basis = factor.basis();
  for (Index i = 0; i < window.length; ++i)
    solution.deviation.row(i) =
        (flow.transitions[static_cast<std::size_t>(i)] * start + flow.shifts.col(i))
            .transpose();
  for (Index row = 0; row < rows; ++row) {
    const auto [i, k] = problem.places[static_cast<std::size_t>(row)];
    const Index n = window.first + i;
    solution.residual(i, k) =
        record.samples.states(n, k) - linear.path(n, k) - solution.deviation(i, k);
    solution.freedom(i, k) = std::max(0.0, 1.0 - basis.row(row).squaredNorm());
  }
  if (!solution.deviation.allFinite()) return std::nullopt;
  return solution;
}

/// How exact steps have to be: small against what samples deviate by, and against what a state
/// moves that is not measured.
Vector accuracy_for(const PredictedRecord& record, const Matrix& path) {
  // Facts: what steps need not be more exact than is no error beside noise and motion.
  constexpr double kFractionOfDeviation = 0.02, kFractionOfMotion = 1e-4, kRounding = 1e-13;
  const Index steps = path.rows() - 1;
  const Matrix moves = path.bottomRows(steps) - path.topRows(steps);
  Vector accuracy(path.cols());
  for (Index k = 0; k < accuracy.size(); ++k) {
    const double most = record.deviations.col(k).maxCoeff();
    const double wanted = most > 0.0 ? kFractionOfDeviation * most
                                     : kFractionOfMotion * moves.col(k).norm() /
                                           std::sqrt(static_cast<double>(steps));
    accuracy[k] = std::max({wanted, kRounding * path.col(k).cwiseAbs().maxCoeff(),
                            std::numeric_limits<double>::min()});
  }
  return accuracy;
}

/// Whether a window has a step that nobody can know (LinearisedRecord::bridge).
bool is_bridged(const LinearisedRecord& record, const Window& window) {
  return record.bridge.size() > 0 &&
         (record.bridge.middleCols(window.first, window.length - 1).array() > 0.0).any();
}

/// The model from the path's first state in a window on, without a fit.
Solution run_in(const OdeModel& model, const PredictedRecord& record, const Window& window) {
  const Vector start = record.path.row(window.first).transpose();
  RecordInput inputs(record.samples, model.inputs());
  return simulate({model, inputs, inputs.breaks()}, Automatic(), start,
                  record.samples.time.segment(window.first, window.length));
}

}  // namespace

void WindowResiduals::add(const WindowResiduals& other) {
  squares += other.squares;
  freedom += other.freedom;
  expected += other.expected;
  neighbours += other.neighbours;
  windows += other.windows;
  lost += other.lost;
  unstarted += other.unstarted;
}

WindowResiduals predict(const OdeModel& model, const PredictedRecord& record, Index length,
                        int passes) {
  Matrix path = record.path;
  WindowResiduals sums(path.cols());
  for (int pass = 0; pass < passes; ++pass) {
    sums = WindowResiduals(path.cols());
    const LinearisedRecord linear =
        linearise(model, record.samples, path, accuracy_for(record, path));
    Matrix next = record.path;
    for (Index first = 0; first + length <= linear.samples(); first += length) {
      const Window window{first, length};
      if (is_bridged(linear, window)) continue;
      ++sums.windows;
      const std::optional<WindowSolution> solution = solve(record, linear, window);
      if (!solution) {
        const Solution own = run_in(model, record, window);
        const bool is_lost = own.status != IntegrationStatus::Completed;
        ++(is_lost ? sums.lost : sums.unstarted);
        if (!is_lost) next.middleRows(first, length) = own.states;
        continue;
      }
      next.middleRows(first, length) = path.middleRows(first, length) + solution->deviation;
      sums.squares += solution->residual.colwise().squaredNorm().transpose();
      sums.neighbours += solution->residual.topRows(length - 1)
                             .cwiseProduct(solution->residual.bottomRows(length - 1))
                             .colwise()
                             .sum()
                             .transpose();
      sums.freedom += solution->freedom.colwise().sum().transpose();
      const auto variances = record.deviations.middleRows(first, length).array().square() *
                             solution->freedom.array();
      sums.expected += variances.matrix().colwise().sum().transpose();
    }
    path = std::move(next);
  }
  return sums;
}

}  // namespace lacuna
