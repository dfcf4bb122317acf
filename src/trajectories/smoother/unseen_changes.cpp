// SPDX-License-Identifier: MIT
#include "trajectories/smoother/unseen_changes.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/qr.hpp"
#include "core/numerics/singular_values.hpp"
#include "lacuna/model/expressions/program.hpp"
#include "trajectories/smoother/hidden_states.hpp"

namespace lacuna {
namespace {

constexpr Index kPoints = 200;  // many more than unknowns
/// Singular values below this fraction of the largest are rounding.
constexpr double kRankTolerance = 1e-7;
/// Part of a null vector that is more than rounding.
constexpr double kRoundingFraction = 1e-5;

/// Points of the records: states, inputs and t in rows.
Matrix points_of(const Dataset& data, Index states) {
  const Index stride = std::max<Index>(1, data.samples() / kPoints);
  std::vector<Vector> rows;
  for (const Trajectory& record : data.trajectories)
    for (Index i = 0; i < record.samples(); i += stride) {
      rows.emplace_back(states + record.inputs.cols() + 1);
      rows.back() << record.states.row(i).head(states).transpose(),
          record.inputs.row(i).transpose(), record.time[i];
    }
  Matrix points(static_cast<Index>(rows.size()), rows.front().size());
  for (Index i = 0; i < points.rows(); ++i) points.row(i) = rows[static_cast<std::size_t>(i)];
  return points;
}

/// The linear system: columns of changes of numbers, then of (hidden state, function).
struct System {
  Matrix columns;  ///< (points m) x (p + hidden (1 + m))
  Index numbers = 0;
};

/// What changes of the numbers do to the rates at points: one block of rows for each point.
/// @return (points m) x numbers.
Matrix changed_rates(const OdeModel& model, const std::vector<NumberChange>& numbers,
                     const Matrix& points) {
  const Index n = points.rows(), m = model.dimension();
  Matrix result = Matrix::Zero(n * m, static_cast<Index>(numbers.size()));
  std::vector<Expression> rates;
  for (const NumberChange& number : numbers)
    for (const RateChange& change : number) rates.push_back(change.rate);
  if (rates.empty()) return result;
  Matrix values(n, static_cast<Index>(rates.size()));
  const Program program(rates, model.variables());
  Program::Workspace workspace;
  program.evaluate(points, values, workspace);
  Index next = 0;
  for (std::size_t j = 0; j < numbers.size(); ++j)
    for (const RateChange& change : numbers[j])
      result.col(static_cast<Index>(j))(Eigen::seqN(change.equation, n, m)) +=
          values.col(next++);
  return result;
}

System system_of(const OdeModel& model, const std::vector<Index>& hidden,
                 const std::vector<NumberChange>& numbers, const Matrix& points) {
  const Index m = model.dimension(), p = static_cast<Index>(numbers.size());
  const Index n = points.rows(), functions = 1 + m;
  CompiledModel compiled = model.compile();
  System system{Matrix::Zero(n * m, p + functions * static_cast<Index>(hidden.size())), p};
  system.columns.leftCols(p) = changed_rates(model, numbers, points);
  Vector rate(m), u(points.cols() - m - 1);
  Matrix slope(m, m);
  for (Index i = 0; i < n; ++i) {
    const Vector x = points.row(i).head(m);
    u = points.row(i).segment(m, u.size());
    const double t = points(i, points.cols() - 1);
    compiled.evaluate(t, x.data(), u.data(), nullptr, rate.data());
    compiled.jacobian(t, x.data(), u.data(), nullptr, slope);
    Index column = p;
    for (const Index k : hidden)
      for (Index g = 0; g < functions; ++g, ++column) {
        system.columns.col(column).segment(i * m, m) = (g == 0 ? 1.0 : x[g - 1]) * slope.col(k);
        if (g > 0) system.columns(i * m + k, column) -= rate[g - 1];
      }
  }
  return system;
}

/// Each equation in the unit of what it has, each unknown in its own.
/// @return scales of the unknowns.
Vector balance(System& system, Index equations) {
  for (Index k = 0; k < equations; ++k) {
    const auto own = Eigen::seq(k, system.columns.rows() - 1, equations);
    const double size = system.columns(own, Eigen::all).norm();
    if (size > 0.0) system.columns(own, Eigen::all) /= size;
  }
  const Vector scale =
      system.columns.colwise().norm().cwiseMax(1e-300).cwiseInverse().transpose();
  system.columns = system.columns * scale.asDiagonal();
  return scale;
}

/// Coefficients of which nothing is known beforehand.
std::vector<std::size_t> unknown_among(const std::vector<CoefficientPlace>& free,
                                       const std::vector<CoefficientPrior>& known) {
  std::vector<std::size_t> unknown;
  for (std::size_t j = 0; j < free.size(); ++j)
    if (std::none_of(known.begin(), known.end(),
                     [&](const CoefficientPrior& prior) { return prior.place == free[j]; }))
      unknown.push_back(j);
  return unknown;
}

/// Hidden states that stand in no equation of a state that is seen, or of one that does.
std::vector<bool> unseen_states(const OdeModel& model, const std::vector<bool>& hidden) {
  std::vector<bool> unseen = hidden;
  unseen.resize(static_cast<std::size_t>(model.dimension()), false);
  for (bool more = true; more;) {
    more = false;
    for (std::size_t k = 0; k < unseen.size(); ++k) {
      if (unseen[k]) continue;
      for (const WeightedTerm& summand : model.equations()[k])
        for (const std::string& name : summand.term.expression().variables())
          for (std::size_t j = 0; j < unseen.size(); ++j)
            if (unseen[j] && model.states()[j].name == name) {
              unseen[j] = false;
              more = true;
            }
    }
  }
  return unseen;
}

bool has_hidden(const Expression& term, const OdeModel& model,
                const std::vector<bool>& hidden) {
  const auto names = term.variables();
  for (std::size_t k = 0; k < hidden.size(); ++k)
    if (hidden[k] && names.contains(model.states()[k].name)) return true;
  return false;
}

/// Rows of `directions`, one for each column, by which all of them are determined: those of
/// coefficients by which a hidden state acts on one that is seen before others, then the
/// largest.
std::vector<Index> units_of(Matrix directions, const OdeModel& model,
                            const std::vector<bool>& hidden,
                            const std::vector<CoefficientPlace>& free) {
  // Of the largest: far from 0, so that elimination by it is exact. Any choice gives the same
  // model in other units.
  constexpr double kFractionOfLargest = 0.3;
  std::vector<Index> units;
  while (static_cast<Index>(units.size()) < directions.cols()) {
    const Vector size = directions.rowwise().norm();
    Index best = 0;
    const double largest = size.maxCoeff(&best);
    double most = 0.0;
    for (Index j = 0; j < size.size(); ++j) {
      const auto& [k, term] = free[static_cast<std::size_t>(j)];
      const auto equation = static_cast<std::size_t>(k);
      const bool acts =
          !(equation < hidden.size() && hidden[equation]) &&
          has_hidden(
              model.equations()[equation][static_cast<std::size_t>(term)].term.expression(),
              model, hidden);
      if (!acts || size[j] < kFractionOfLargest * largest || size[j] <= most) continue;
      best = j;
      most = size[j];
    }
    units.push_back(best);
    const Vector determined = directions.row(best).normalized().transpose();
    directions -= (directions * determined * determined.transpose()).eval();
  }
  return units;
}

/// The part of a null space that is about the free coefficients: orthonormal relative changes.
Matrix changes_in(const Matrix& null, const Vector& scale,
                  const std::vector<std::size_t>& unknown, Index free) {
  const auto p = static_cast<Index>(unknown.size());
  const SingularValues own = singular_values(null.topRows(p));
  const Index seen = (own.values.array() > kRoundingFraction).count();
  Matrix result = Matrix::Zero(free, seen);
  if (seen == 0) return result;
  const Matrix relative = scale.head(p).asDiagonal() * own.left.leftCols(seen);
  const Matrix basis = Qr(relative).basis();
  for (Index j = 0; j < p; ++j)
    result.row(static_cast<Index>(unknown[static_cast<std::size_t>(j)])) = basis.row(j);
  return result;
}

}  // namespace

std::vector<NumberChange> changes_of(const OdeModel& model,
                                     const std::vector<CoefficientPlace>& places) {
  std::vector<NumberChange> changes;
  for (const CoefficientPlace& place : places) {
    const WeightedTerm& summand = model.equations()[static_cast<std::size_t>(place.equation)]
                                                   [static_cast<std::size_t>(place.term)];
    changes.push_back({{place.equation,
                        Expression::number(summand.coefficient) * summand.term.expression()}});
  }
  return changes;
}

UnseenChanges unseen_changes(const OdeModel& model, const Dataset& data,
                             const std::vector<bool>& hidden, const EstimatedNumbers& numbers) {
  const auto& [free, known, others] = numbers;
  const auto count = static_cast<Index>(free.size());
  UnseenChanges result{Matrix(count, 0), {}, unseen_states(model, hidden)};
  const std::vector<Index> states = places_of(hidden);
  if (states.empty() || !model.compile().delays().empty()) return result;
  const std::vector<std::size_t> unknown = unknown_among(free, known);
  std::vector<CoefficientPlace> places;
  for (const std::size_t j : unknown) places.push_back(free[j]);
  std::vector<NumberChange> changes = changes_of(model, places);
  changes.insert(changes.end(), others.begin(), others.end());
  System system = system_of(model, states, changes, points_of(data, model.dimension()));
  if (!system.columns.allFinite()) return result;
  const Vector scale = balance(system, model.dimension());
  const Matrix null = singular_values(system.columns).null_space(kRankTolerance);
  if (null.cols() == 0) return result;
  result.coefficients = changes_in(null, scale, unknown, count);
  result.units = units_of(result.coefficients, model, hidden, free);
  return result;
}

}  // namespace lacuna
