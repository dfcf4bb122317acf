// SPDX-License-Identifier: MIT
#include "lacuna/estimation/unseen_changes.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "lacuna/model/program.hpp"

namespace lacuna {
namespace {

constexpr Index kPoints = 200;  // many more than unknowns
/// Singular values below this share of the largest are rounding.
constexpr double kNothing = 1e-7;
/// Part of a null vector that is more than rounding.
constexpr double kOwn = 1e-5;

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

/// The linear system: columns of changes of coefficients, then of (hidden state, function).
struct System {
  Matrix columns;  ///< (points m) x (p + hidden (1 + m))
  Index coefficients = 0;
};

std::vector<Index> numbers_of(const std::vector<bool>& hidden) {
  std::vector<Index> numbers;
  for (std::size_t k = 0; k < hidden.size(); ++k)
    if (hidden[k]) numbers.push_back(static_cast<Index>(k));
  return numbers;
}

/// Terms of the free coefficients at points, times the coefficients.
Matrix weighted_terms(const OdeModel& model, const std::vector<CoefficientPlace>& free,
                      const Matrix& points) {
  std::vector<Expression> terms;
  Vector weight(static_cast<Index>(free.size()));
  for (std::size_t j = 0; j < free.size(); ++j) {
    const WeightedTerm& summand = model.equations()[static_cast<std::size_t>(free[j].equation)]
                                                   [static_cast<std::size_t>(free[j].term)];
    terms.push_back(summand.term.expression());
    weight[static_cast<Index>(j)] = summand.coefficient;
  }
  Matrix values(points.rows(), weight.size());
  if (terms.empty()) return values;
  const Program program(terms, model.variables());
  Program::Workspace workspace;
  program.evaluate(points, values, workspace);
  return values * weight.asDiagonal();
}

System system_of(const OdeModel& model, const std::vector<Index>& hidden,
                 const std::vector<CoefficientPlace>& free, const Matrix& points) {
  const Index m = model.dimension(), p = static_cast<Index>(free.size());
  const Index n = points.rows(), functions = 1 + m;
  const Matrix terms = weighted_terms(model, free, points);
  CompiledModel compiled = model.compile();
  System system{Matrix::Zero(n * m, p + functions * static_cast<Index>(hidden.size())), p};
  Vector rate(m), u(points.cols() - m - 1);
  Matrix slope(m, m);
  for (Index i = 0; i < n; ++i) {
    const Vector x = points.row(i).head(m);
    u = points.row(i).segment(m, u.size());
    const double t = points(i, points.cols() - 1);
    compiled.evaluate(t, x.data(), u.data(), nullptr, rate.data());
    compiled.jacobian(t, x.data(), u.data(), nullptr, slope);
    for (Index j = 0; j < p; ++j)
      system.columns(i * m + free[static_cast<std::size_t>(j)].equation, j) = terms(i, j);
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

/// Orthonormal columns of the null space.
Matrix null_space(const Matrix& columns) {
  const Eigen::BDCSVD<Matrix> found(columns, Eigen::ComputeThinV);
  const Vector& values = found.singularValues();
  Index rank = 0;
  while (rank < values.size() && values[rank] > kNothing * values[0]) ++rank;
  return found.matrixV().rightCols(values.size() - rank);
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

}  // namespace

UnseenChanges unseen_changes(const OdeModel& model, const Dataset& data,
                             const std::vector<bool>& hidden,
                             const std::vector<CoefficientPlace>& free,
                             const std::vector<CoefficientPrior>& known) {
  const Index m = model.dimension();
  UnseenChanges result{Matrix(static_cast<Index>(free.size()), 0),
                       unseen_states(model, hidden)};
  const std::vector<Index> numbers = numbers_of(hidden);
  if (numbers.empty() || !model.compile().delays().empty()) return result;
  const std::vector<std::size_t> unknown = unknown_among(free, known);
  std::vector<CoefficientPlace> places;
  for (const std::size_t j : unknown) places.push_back(free[j]);
  System system = system_of(model, numbers, places, points_of(data, m));
  if (!system.columns.allFinite()) return result;
  const Vector scale = balance(system, m);
  const Matrix null = null_space(system.columns);
  if (null.cols() == 0) return result;
  const Index p = system.coefficients;
  const Eigen::JacobiSVD<Matrix> own(null.topRows(p),
                                     Eigen::ComputeThinU | Eigen::ComputeFullV);
  Index seen = 0;
  while (seen < own.singularValues().size() && own.singularValues()[seen] > kOwn) ++seen;
  if (seen > 0) {
    const Matrix relative = scale.head(p).asDiagonal() * own.matrixU().leftCols(seen);
    const Eigen::HouseholderQR<Matrix> factor(relative);
    const Matrix basis = factor.householderQ() * Matrix::Identity(p, seen);
    result.coefficients = Matrix::Zero(static_cast<Index>(free.size()), seen);
    for (Index j = 0; j < p; ++j)
      result.coefficients.row(static_cast<Index>(unknown[static_cast<std::size_t>(j)])) =
          basis.row(j);
  }
  return result;
}

}  // namespace lacuna
