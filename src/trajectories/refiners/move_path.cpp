// SPDX-License-Identifier: MIT
#include "move_path.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.hpp"
#include "core/numerics/least_squares.hpp"

namespace lacuna {
namespace {

/// The initial state of a window. Each state is counted in its own unit, whatever those of the
/// others are: where it is not determined it moves by the least number of these.
Vector start_of(const Matrix& head, const Vector& values) {
  // A fact of rounding.
  constexpr double kSingular = 1e-10;
  const Index m = head.rows();
  const Vector target = head.col(head.cols() - 1) - head.middleCols(m, values.size()) * values;
  Matrix triangle = head.leftCols(m).triangularView<Eigen::Upper>();
  const Vector unit = triangle.colwise().norm().cwiseMax(1e-300).cwiseInverse().transpose();
  triangle = triangle * unit.asDiagonal();
  if (triangle.diagonal().cwiseAbs().minCoeff() > kSingular)
    return unit.cwiseProduct(Vector(triangle.triangularView<Eigen::Upper>().solve(target)));
  return unit.cwiseProduct(Vector(smallest_least_squares(triangle, target)));
}

/// The solution of x' = J x + b at the nodes of a window, middles by Hermite's cubic.
/// @param times of the nodes; @param jacobians m m x nodes; @param forcing b, m x nodes.
/// @return m x nodes.
Matrix solve_window(const Eigen::Ref<const Vector>& times, const Matrix& jacobians,
                    const Matrix& forcing, const Vector& start) {
  const Index m = forcing.rows(), nodes = forcing.cols();
  const auto rate = [&](Index node, const auto& state) {
    const Eigen::Map<const Matrix> jacobian(jacobians.col(node).data(), m, m);
    return (jacobian.lazyProduct(state) + forcing.col(node)).eval();
  };
  LinearStep step;
  Matrix solution(m, nodes);
  solution.col(0) = start;
  Vector before = rate(0, start);
  for (Index node = 0; node + 2 < nodes; node += 2) {
    const double h = times[node + 2] - times[node];
    step.compute(jacobians.middleCols(node, 3), m, h);
    solution.col(node + 2) =
        step.whole.lazyProduct(solution.col(node)) + step.first.lazyProduct(forcing.col(node)) +
        step.middle.lazyProduct(forcing.col(node + 1)) + step.last * forcing.col(node + 2);
    const Vector after = rate(node + 2, solution.col(node + 2));
    solution.col(node + 1) =
        0.5 * (solution.col(node) + solution.col(node + 2)) + h / 8.0 * (before - after);
    before = after;
  }
  return solution;
}

/// Makes a solution the path of a window. @return the largest move at a sample.
double replace_path(PathRecord& record, const SampleWindow& window, const Matrix& solution) {
  const Index m = solution.rows();
  auto path = record.slots.middleRows(window.first * record.stride(), solution.cols());
  double largest = 0.0;
  for (Index i = 0; i < window.samples; ++i)
    for (Index k = 0; k < m; ++k)
      largest = std::max(largest, record.weights(window.first + i, k) *
                                      std::abs(solution(k, i * record.stride()) -
                                               path(i * record.stride(), k)));
  path.leftCols(m) = solution.transpose();
  return largest;
}

/// How far some windows have moved, and whether all of them have.
struct Move {
  double largest = 0.0;
  bool finite = true;
};

/// Coefficients as values of the columns and as a matrix of the terms that are present.
struct Solution {
  const Vector& values;
  const Matrix& active;
};

Move move_windows(WindowRates rates, const Linearisation& linearisation,
                  const Solution& solution, const WindowChunk& chunk, WindowedPath& path,
                  const RunContext& context) {
  Move move;
  for (std::size_t w = chunk.first; w < chunk.last; ++w) {
    context.check_stop();
    const Matrix& head = linearisation.heads[w];
    if (head.size() == 0) continue;
    const SampleWindow& window = path.windows[w];
    PathRecord& record = path.records[window.record];
    rates.evaluate(record, window);
    const Matrix forcing = solution.active * rates.theta() + rates.offsets();
    const Index first = window.first * record.stride();
    const Matrix states =
        solve_window(record.time.segment(first, forcing.cols()), rates.jacobians(), forcing,
                     start_of(head, solution.values));
    if (states.allFinite())
      move.largest = std::max(move.largest, replace_path(record, window, states));
    else
      move.finite = false;
  }
  return move;
}

}  // namespace

std::optional<double> move_path(WindowRates& rates, const Linearisation& linearisation,
                                const Vector& values, WindowedPath& path,
                                const RunContext& context) {
  Matrix coefficients = Matrix::Zero(linearisation.h0.rows(), linearisation.h0.cols());
  for (std::size_t c = 0; c < linearisation.columns.size(); ++c)
    coefficients(linearisation.columns[c].equation, linearisation.columns[c].term) =
        values[static_cast<Index>(c)];
  const std::vector<Index> terms = present_terms(coefficients);
  const Matrix active = coefficients(Eigen::all, terms);
  rates.choose(terms, linearisation.h0);
  const std::vector<WindowChunk> chunks = window_chunks(path.windows.size());
  std::vector<Move> moves(chunks.size());
  parallel_for(chunks.size(), context.threads, [&](std::size_t c) {
    moves[c] = move_windows(rates, linearisation, {values, active}, chunks[c], path, context);
  });
  Move all;
  for (const Move& move : moves)
    all = {std::max(all.largest, move.largest), all.finite && move.finite};
  if (!all.finite) return std::nullopt;
  return all.largest;
}

}  // namespace lacuna
