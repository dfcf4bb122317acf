// SPDX-License-Identifier: MIT
#include "form_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.hpp"
#include "core/numerics/qr.hpp"
#include "data/derivatives/moving_polynomial.hpp"
#include "data/records/known_noise.hpp"
#include "regression/formulations/test_functions.hpp"

namespace lacuna {
namespace {

/// More rows than this distinguish forms no better.
constexpr double kMostRows = 1000.0;

double total_duration(const Dataset& data) {
  double duration = 0.0;
  for (const Trajectory& record : data.trajectories) duration += record.duration();
  return duration;
}

/// L of the covariance of the rows, which is banded; in blocks, so that it is made in no time.
SparseRows whitening(const Projection& projection) {
  // A fact of caches.
  constexpr Index kBlock = 128;
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (Index first = 0; first < projection.rows(); first += kBlock) {
    const Matrix factor =
        projection.target_factor(first, std::min(kBlock, projection.rows() - first));
    for (Index i = 0; i < factor.rows(); ++i)
      for (Index j = 0; j <= i; ++j)
        if (factor(i, j) != 0.0) entries.emplace_back(first + i, first + j, factor(i, j));
  }
  SparseRows whole(projection.rows(), projection.rows());
  whole.setFromTriplets(entries.begin(), entries.end());
  return whole;
}

/// The test function for a dataset, narrower where that leaves too few rows.
TestFunction narrow_function(const Dataset& data, const std::optional<Vector>& seen) {
  // Facts of the statistic: fewer rows rank forms by chance; a row needs samples to be white.
  constexpr double kRows = 400.0, kSamplesOfARow = 4.0;
  const Vector noise = known_or_estimated(seen, data);
  const TestFunction function = choose_test_function(data, {}, 1, noise);
  const double samples = static_cast<double>(data.samples());

  const double wanted = std::min(kRows, samples / kSamplesOfARow);
  const double narrow =
      total_duration(data) / wanted * std::sqrt(static_cast<double>(function.order));
  if (function.radius <= narrow) return function;
  return choose_test_function(data, {.radius = narrow, .order = {}}, 1, noise);
}

}  // namespace

FormRows::FormRows(const Dataset& data, const Vector& noise, const std::vector<Term>& library,
                   int threads, const std::optional<Vector>& seen) {
  variables_ = {names_of(data.states), names_of(data.inputs)};
  states_.resize(data.samples(), data.state_count());
  rates_.resize(data.samples(), data.state_count());
  slots_.resize(data.samples(), variables_.count());
  take_in(data, noise, threads, seen);
  take_in(library, threads);
}

void FormRows::take_in(const Dataset& data, const Vector& noise, int threads,
                       const std::optional<Vector>& seen) {
  const TestFunction function = narrow_function(data, seen);
  const double spacing =
      std::max(test_function_spacing(function), total_duration(data) / kMostRows);
  std::vector<Part> parts;
  Index first = 0;
  for (const Trajectory& record : data.trajectories) {
    parts.push_back({first, record.samples(), {}, {}});
    first += record.samples();
  }
  parallel_for(parts.size(), threads, [&](std::size_t i) {
    const Trajectory& record = data.trajectories[i];
    parts[i].projection = weak_projection(record, function, spacing);
    states_.middleRows(parts[i].first, parts[i].samples) = record.states;
    slots_.middleRows(parts[i].first, parts[i].samples) << record.states, record.inputs,
        record.time;
    if (parts[i].projection.rows() > 0) parts[i].factor = whitening(parts[i].projection);
  });
  const auto states = static_cast<std::size_t>(noise.size());
  parallel_for(parts.size() * states, threads, [&](std::size_t i) {
    const auto k = static_cast<Index>(i % states);
    smooth(data.trajectories[i / states], k, noise[k], parts[i / states].first);
  });
  if (data.has_derivatives()) {
    for (std::size_t i = 0; i < parts.size(); ++i)
      rates_.middleRows(parts[i].first, parts[i].samples) = data.trajectories[i].derivatives;
    states_.resize(0, 0);
  }
  for (Part& part : parts) {
    if (part.projection.rows() == 0) continue;
    rows_ += part.projection.rows();
    parts_.push_back(std::move(part));
  }
}

void FormRows::take_in(const std::vector<Term>& library, int threads) {
  std::vector<Vector> known(library.size());
  parallel_for(library.size(), threads,
               [&](std::size_t i) { known[i] = columns({library[i].expression()}).col(0); });
  for (std::size_t i = 0; i < library.size(); ++i)
    known_.emplace(library[i].name(), std::move(known[i]));
}

void FormRows::smooth(const Trajectory& record, Index state, double noise, Index first) {
  const Matrix smooth = smooth_by_polynomials(record.time, record.states.col(state), noise);
  rates_.col(state).segment(first, record.samples()) = smooth.col(1);
  if (noise > 0.0) slots_.col(state).segment(first, record.samples()) = smooth.col(0);
}

template <class Functional>
Matrix FormRows::projected_by(const Matrix& samples, Functional functional) const {
  Matrix result(rows_, samples.cols());
  Index row = 0;
  for (const Part& part : parts_) {
    const Index count = part.projection.rows();
    auto block = result.middleRows(row, count);
    block = functional(part.projection) * samples.middleRows(part.first, part.samples);
    block = part.factor.triangularView<Eigen::Lower>().solve(block.eval());
    row += count;
  }
  return result;
}

Matrix FormRows::values(const std::vector<Expression>& forms) const {
  const Program program(forms, variables_);
  Program::Workspace workspace;
  Matrix values(slots_.rows(), static_cast<Index>(forms.size()));
  program.evaluate(slots_, values, workspace);
  return values;
}

Matrix FormRows::columns(const std::vector<Expression>& forms) const {
  return projected(values(forms));
}

Matrix FormRows::columns_of(const std::vector<Term>& terms) const {
  Matrix result(rows_, static_cast<Index>(terms.size()));
  for (Index i = 0; i < result.cols(); ++i) {
    const Term& term = terms[static_cast<std::size_t>(i)];
    const auto known = known_.find(term.name());
    if (known != known_.end())
      result.col(i) = known->second;
    else
      result.col(i) = columns({term.expression()}).col(0);
  }
  return result;
}

Matrix FormRows::projected(const Matrix& samples) const {
  return projected_by(samples,
                      [](const Projection& p) -> const SparseRows& { return p.values; });
}

Vector FormRows::target(Index state) const {
  if (states_.size() == 0) return projected(rates_.col(state));
  const Matrix values = states_.col(state);
  return projected_by(values, [](const Projection& p) -> const SparseRows& { return p.rates; });
}

double residual_squares(const Matrix& columns, const Vector& target) {
  if (!columns.allFinite()) return std::numeric_limits<double>::infinity();
  Matrix scaled = columns;
  for (Index j = 0; j < scaled.cols(); ++j)
    scaled.col(j) /= std::max(scaled.col(j).norm(), 1e-300);
  if (scaled.cols() == 0) return target.squaredNorm();
  const PivotedQr factor(scaled, 1e-11);
  const Vector rotated = factor.transposed_times(target);
  return rotated.tail(rotated.size() - factor.rank()).squaredNorm();
}

}  // namespace lacuna
