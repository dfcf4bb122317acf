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
  constexpr Index kBlock = FormRows::kBlock;
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

/// A matrix with its columns at other places; those that have none go.
SparseRows with_columns_at(const SparseRows& matrix, const std::vector<Index>& places,
                           Index columns) {
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (Index row = 0; row < matrix.outerSize(); ++row)
    for (SparseRows::InnerIterator entry(matrix, row); entry; ++entry)
      if (const Index place = places[static_cast<std::size_t>(entry.col())]; place >= 0)
        entries.emplace_back(row, place, entry.value());
  SparseRows result(matrix.rows(), columns);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
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

constexpr Index kLanes = 8;  // a fact of the machines: columns whose sums are made side by side

using Lanes = Eigen::Array<double, kLanes, 1>;
using LaneRows = Eigen::Array<double, kLanes, Eigen::Dynamic>;

/// L^-1 rows X of so many columns, each in the order of sums that it has alone.
LaneRows whitened_lanes(const SparseRows& factor, const SparseRows& rows, const LaneRows& x) {
  LaneRows sums(kLanes, rows.rows());
  for (Index row = 0; row < rows.rows(); ++row) {
    Lanes sum = Lanes::Zero();
    for (SparseRows::InnerIterator entry(rows, row); entry; ++entry)
      sum += entry.value() * x.col(entry.col());
    double diagonal = 1.0;
    for (SparseRows::InnerIterator entry(factor, row); entry && entry.col() <= row; ++entry)
      if (entry.col() < row)
        sum -= entry.value() * sums.col(entry.col());
      else
        diagonal = entry.value();
    sums.col(row) = sum / diagonal;
  }
  return sums;
}

}  // namespace

Matrix FormRows::Part::whitened(const SparseRows& rows, const Matrix& samples) const {
  // Each as if it were alone, so that columns that are equal have equal sums: ties are broken by
  // their order.
  const Index together = samples.cols() / kLanes * kLanes, others = samples.cols() - together;
  Matrix result(rows.rows(), samples.cols());
  for (Index begin = 0; begin < together; begin += kLanes)
    result.middleCols(begin, kLanes) =
        whitened_lanes(factor, rows, samples.middleCols(begin, kLanes).transpose())
            .matrix()
            .transpose();
  const Matrix sums = rows * samples.rightCols(others);
  result.rightCols(others) = factor.triangularView<Eigen::Lower>().solve(sums);
  return result;
}

FormRows::FormRows(const Dataset& data, const Vector& noise, const std::vector<Term>& library,
                   int threads, const std::optional<Vector>& seen) {
  variables_ = {names_of(data.states), names_of(data.inputs)};
  rates_.resize(data.samples(), data.state_count());
  slots_.resize(data.samples(), variables_.count());
  take_in(data, noise, threads, seen);
  keep_samples_of_rows();
  take_in(library, threads);
}

void FormRows::take_in(const Dataset& data, const Vector& noise, int threads,
                       const std::optional<Vector>& seen) {
  const TestFunction function = narrow_function(data, seen);
  const double spacing =
      std::max(test_function_spacing(function), total_duration(data) / kMostRows);
  std::vector<Part> parts(data.trajectories.size());
  std::vector<Matrix> targets(parts.size());
  Index first = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].first = first;
    first += data.trajectories[i].samples();
  }
  parallel_for(parts.size(), threads, [&](std::size_t i) {
    const Trajectory& record = data.trajectories[i];
    slots_.middleRows(parts[i].first, record.samples()) << record.states, record.inputs,
        record.time;
    const Projection projection = weak_projection(record, function, spacing);
    if (projection.rows() == 0) return;
    parts[i].values = projection.values;
    if (!data.has_derivatives()) parts[i].rates = projection.rates;
    parts[i].factor = whitening(projection);
    targets[i] = data.has_derivatives()
                     ? parts[i].whitened(projection.values, record.derivatives)
                     : parts[i].whitened(projection.rates, record.states);
  });
  const auto states = static_cast<std::size_t>(noise.size());
  parallel_for(parts.size() * states, threads, [&](std::size_t i) {
    const auto k = static_cast<Index>(i % states);
    smooth(data.trajectories[i / states], k, noise[k], parts[i / states].first);
  });
  if (data.has_derivatives())
    for (std::size_t i = 0; i < parts.size(); ++i)
      rates_.middleRows(parts[i].first, data.trajectories[i].samples()) =
          data.trajectories[i].derivatives;
  for (const Matrix& target : targets) rows_ += target.rows();
  targets_.resize(rows_, data.state_count());
  Index row = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (targets[i].rows() == 0) continue;
    targets_.middleRows(row, targets[i].rows()) = targets[i];
    row += targets[i].rows();
    parts_.push_back(std::move(parts[i]));
  }
}

void FormRows::keep_samples_of_rows() {
  std::vector<Index> kept;
  for (Part& part : parts_) {
    std::vector<Index> places(static_cast<std::size_t>(part.values.cols()), -1);
    for (Index row = 0; row < part.values.outerSize(); ++row)
      for (SparseRows::InnerIterator entry(part.values, row); entry; ++entry)
        places[static_cast<std::size_t>(entry.col())] = 0;
    const auto first = static_cast<Index>(kept.size());
    for (std::size_t i = 0; i < places.size(); ++i)
      if (places[i] == 0) {
        places[i] = static_cast<Index>(kept.size()) - first;
        kept.push_back(part.first + static_cast<Index>(i));
      }
    part.first = first;
    const Index count = static_cast<Index>(kept.size()) - first;
    part.values = with_columns_at(part.values, places, count);
    if (part.rates.rows() > 0) part.rates = with_columns_at(part.rates, places, count);
  }
  slots_ = slots_(kept, Eigen::all).eval();
  rates_ = rates_(kept, Eigen::all).eval();
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
  Matrix result(rows_, samples.cols());
  Index row = 0;
  for (const Part& part : parts_) {
    const Index count = part.values.rows();
    result.middleRows(row, count) =
        part.whitened(part.values, samples.middleRows(part.first, part.values.cols()));
    row += count;
  }
  return result;
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
