// SPDX-License-Identifier: MIT
#include "linear_windows.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

namespace lacuna {
namespace {

bool consecutive(const std::vector<Index>& places) {
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i] != places[i - 1] + 1) return false;
  return true;
}

/// Terms with a coefficient in some equation.
std::vector<Index> present_terms(const Matrix& coefficients) {
  std::vector<Index> terms;
  for (Index l = 0; l < coefficients.cols(); ++l)
    if (!coefficients.col(l).isZero(0.0)) terms.push_back(l);
  return terms;
}

}  // namespace

LinearWindows::LinearWindows(const TermLibrary& library,
                             std::vector<std::optional<Index>> exact,
                             std::vector<PathRecord> records)
    : library_(library),
      program_(library.compile()),
      exact_(std::move(exact)),
      records_(std::move(records)) {}

void LinearWindows::set_windows(Index samples) {
  // More samples than this do not change which terms are found; windows evenly spread stand for
  // longer records.
  constexpr Index kMostSamples = 40000;
  Index all = 0;
  for (const PathRecord& record : records_) all += record.samples.samples();
  const Index every = (all + kMostSamples - 1) / kMostSamples;
  windows_.clear();
  for (std::size_t r = 0; r < records_.size(); ++r) {
    const Index n = records_[r].samples.samples();
    const Index count = std::max<Index>(1, n / samples);
    for (Index w = 0; w < count; w += every)
      windows_.push_back({r, w * n / count, (w + 1) * n / count - w * n / count, {}});
  }
}

void LinearWindows::set_substeps(Index substeps) {
  for (PathRecord& record : records_) lacuna::set_substeps(record, substeps, program_);
}

void LinearWindows::rescale(const Vector& factors) {
  for (PathRecord& record : records_)
    record.weights.array().rowwise() /= factors.transpose().array();
}

/// Makes these terms, and derivatives of those of h0, the ones that are evaluated.
void LinearWindows::choose_values(const std::vector<Index>& terms) {
  LibraryRates::Choice choice{terms, present_terms(linearised_at_)};
  if (!values_ || !(values_->choice() == choice))
    values_.emplace(library_, std::move(choice), !program_.delays().empty());
}

void LinearWindows::make_blocks() {
  std::vector<Index> terms;
  for (const Coefficient& column : columns_) terms.push_back(column.term);
  std::sort(terms.begin(), terms.end());
  terms.erase(std::unique(terms.begin(), terms.end()), terms.end());
  choose_values(terms);
  blocks_.clear();
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (c == 0 || columns_[c].equation != columns_[c - 1].equation)
      blocks_.push_back({columns_[c].equation, dimension() + static_cast<Index>(c), {}, false});
    blocks_.back().terms.push_back(
        std::lower_bound(terms.begin(), terms.end(), columns_[c].term) - terms.begin());
  }
  for (Block& block : blocks_) block.contiguous = consecutive(block.terms);
}

/// Evaluates terms and Jacobians at the nodes of a window.
void LinearWindows::load(const Window& window) {
  const PathRecord& record = records_[window.record];
  const Index m = dimension(), nodes = (window.samples - 1) * record.stride() + 1;
  const auto slots = record.slots.middleRows(window.first * record.stride(), nodes);
  values_->evaluate(slots);
  values_->jacobians(linearised_at_, jacobians_);
  path_ = slots.leftCols(m).transpose();
  for (Index k = 0; k < m; ++k) {
    const auto rate = exact_[static_cast<std::size_t>(k)];
    for (Index j = 0; j < m && rate; ++j)
      jacobians_.row(k + m * j).setConstant(j == *rate ? 1.0 : 0.0);
  }
  offsets_.setZero(m, nodes);
  for (Index j = 0; j < m; ++j)
    for (Index k = 0; k < m; ++k)
      if (!exact_[static_cast<std::size_t>(k)])
        offsets_.row(k).array() -= jacobians_.row(k + m * j).array() * path_.row(j).array();
}

/// Adds a step's maps times Theta at its three nodes to the columns of one equation.
void LinearWindows::add_forcing(const Block& block, Index local) {
  const Index e = block.equation, count = static_cast<Index>(block.terms.size());
  const Matrix& theta = values_->theta();
  for (Index k = 0; k < dimension(); ++k) {
    const double a = step_.first(k, e), b = step_.middle(k, e), c = k == e ? step_.last : 0.0;
    auto target = columns_next_.col(k).segment(block.first, count);
    if (block.contiguous) {
      const Index row = block.terms.front();
      target += a * theta.col(local).segment(row, count) +
                b * theta.col(local + 1).segment(row, count) +
                c * theta.col(local + 2).segment(row, count);
      continue;
    }
    for (Index i = 0; i < count; ++i) {
      const Index row = block.terms[static_cast<std::size_t>(i)];
      target[i] +=
          a * theta(row, local) + b * theta(row, local + 1) + c * theta(row, local + 2);
    }
  }
}

/// Takes [S G c] over one step from a node to the next but one.
void LinearWindows::take_step(Index local, double length) {
  const Index m = dimension();
  step_.compute(jacobians_.middleCols(local, 3), m, length);
  for (Index k = 0; k < m; ++k) {
    columns_next_.col(k) = step_.whole(k, 0) * columns_now_.col(0);
    for (Index j = 1; j < m; ++j)
      columns_next_.col(k) += step_.whole(k, j) * columns_now_.col(j);
  }
  for (const Block& block : blocks_) add_forcing(block, local);
  columns_next_.bottomRows(1) +=
      (step_.first * offsets_.col(local) + step_.middle * offsets_.col(local + 1) +
       step_.last * offsets_.col(local + 2))
          .transpose();
  columns_now_.swap(columns_next_);
}

/// Weighted rows [S G | y - c] of a sample.
void LinearWindows::add_rows(const PathRecord& record, Index sample) {
  for (Index k = 0; k < dimension(); ++k) {
    const double weight = record.weights(sample, k);
    if (!(weight > 0.0)) continue;
    auto row = window_rows_.col(used_++);
    row = weight * columns_now_.col(k);
    row[row.size() - 1] = weight * record.samples.states(sample, k) - row[row.size() - 1];
  }
}

/// All rows of the loaded window.
void LinearWindows::window_rows(const Window& window) {
  const PathRecord& record = records_[window.record];
  const Index m = dimension(), width = m + static_cast<Index>(columns_.size()) + 1;
  columns_next_.resize(width, m);
  columns_now_.setZero(width, m);
  columns_now_.topRows(m).setIdentity();
  window_rows_.resize(width, window.samples * m);
  used_ = 0;
  for (Index i = 0; i < window.samples; ++i) {
    const Index sample = window.first + i;
    add_rows(record, sample);
    if (i + 1 == window.samples) break;
    for (Index s = 0; s < record.stride(); s += 2) {
      const Index node = sample * record.stride() + s;
      take_step(i * record.stride() + s, record.time[node + 2] - record.time[node]);
    }
  }
}

/// Turns rows so that only the first m know of the initial state; folds the others.
void LinearWindows::eliminate(Window& window, RowFold& fold) {
  const Index m = dimension(), rest = used_ - m;
  auto rows = window_rows_.leftCols(used_);
  window.head = Matrix();
  if (rest <= 0 || !rows.allFinite()) return;
  const Eigen::HouseholderQR<Matrix> factor(rows.topRows(m).transpose());
  rows.applyOnTheRight(factor.householderQ());
  window.head = rows.leftCols(m).transpose();
  fold.add(rows.bottomRightCorner(rows.rows() - m, rest));
  rows_ += rest;
}

std::optional<Matrix> LinearWindows::fold_windows(Folding folding) {
  rows_ = 0;
  RowFold fold(static_cast<Index>(columns_.size()) + 1, folding);
  for (Window& window : windows_) {
    load(window);
    window_rows(window);
    eliminate(window, fold);
  }
  return fold.finish();
}

Matrix LinearWindows::linearise(const Matrix& h0, const std::vector<Coefficient>& columns) {
  // So few columns are folded orthogonally in no time.
  constexpr std::size_t kFewColumns = 32;
  columns_ = columns;
  linearised_at_ = h0;
  make_blocks();
  if (resolved_by_gram_ && columns.size() > kFewColumns) {
    if (const std::optional<Matrix> triangle = fold_windows(Folding::Gram)) return *triangle;
    resolved_by_gram_ = false;
  }
  return *fold_windows(Folding::Orthogonal);
}

Vector LinearWindows::start_of(const Window& window, const Vector& values) const {
  constexpr double kSingular = 1e-10;
  const Index m = dimension();
  const Matrix& head = window.head;
  const Vector target = head.col(head.cols() - 1) - head.middleCols(m, values.size()) * values;
  const auto triangle = head.leftCols(m).triangularView<Eigen::Upper>();
  const Vector pivots = head.leftCols(m).diagonal().cwiseAbs();
  if (pivots.minCoeff() > kSingular * pivots.maxCoeff()) return triangle.solve(target);
  return Matrix(triangle).completeOrthogonalDecomposition().solve(target);
}

std::optional<double> LinearWindows::move(const Vector& values) {
  Matrix coefficients = Matrix::Zero(dimension(), library_.size());
  for (std::size_t c = 0; c < columns_.size(); ++c)
    coefficients(columns_[c].equation, columns_[c].term) = values[static_cast<Index>(c)];
  const std::vector<Index> terms = present_terms(coefficients);
  choose_values(terms);
  const Matrix active = coefficients(Eigen::all, terms);
  double largest = 0.0;
  bool finite = true;
  for (const Window& window : windows_) {
    const std::optional<double> moved =
        window.head.size() > 0 ? move_window(window, values, active) : std::nullopt;
    finite = finite && (moved || window.head.size() == 0);
    largest = std::max(largest, moved.value_or(0.0));
  }
  if (!finite) return std::nullopt;
  return largest;
}

/// The solution of x' = J x + b at the nodes of the loaded window, middles by Hermite's cubic.
/// @param forcing b, m x nodes. @return m x nodes.
Matrix LinearWindows::solve_window(const Window& window, const Vector& start,
                                   const Matrix& forcing) {
  const PathRecord& record = records_[window.record];
  const Index m = dimension(), begin = window.first * record.stride(), nodes = path_.cols();
  const auto rate = [&](Index node, const auto& state) {
    const Eigen::Map<const Matrix> jacobian(jacobians_.col(node).data(), m, m);
    return (jacobian.lazyProduct(state) + forcing.col(node)).eval();
  };
  Matrix solution(m, nodes);
  solution.col(0) = start;
  Vector before = rate(0, start);
  for (Index node = 0; node + 2 < nodes; node += 2) {
    const double h = record.time[begin + node + 2] - record.time[begin + node];
    step_.compute(jacobians_.middleCols(node, 3), m, h);
    solution.col(node + 2) = step_.whole.lazyProduct(solution.col(node)) +
                             step_.first.lazyProduct(forcing.col(node)) +
                             step_.middle.lazyProduct(forcing.col(node + 1)) +
                             step_.last * forcing.col(node + 2);
    const Vector after = rate(node + 2, solution.col(node + 2));
    solution.col(node + 1) =
        0.5 * (solution.col(node) + solution.col(node + 2)) + h / 8.0 * (before - after);
    before = after;
  }
  return solution;
}

/// @param coefficients of the terms that are evaluated, m x terms.
std::optional<double> LinearWindows::move_window(const Window& window, const Vector& values,
                                                 const Matrix& coefficients) {
  load(window);
  const Matrix forcing = coefficients * values_->theta() + offsets_;
  const Matrix solution = solve_window(window, start_of(window, values), forcing);
  if (!solution.allFinite()) return std::nullopt;
  PathRecord& record = records_[window.record];
  double largest = 0.0;
  for (Index i = 0; i < window.samples; ++i)
    for (Index k = 0; k < dimension(); ++k)
      largest = std::max(largest, record.weights(window.first + i, k) *
                                      std::abs(solution(k, i * record.stride()) -
                                               path_(k, i * record.stride())));
  record.slots.middleRows(window.first * record.stride(), solution.cols())
      .leftCols(dimension()) = solution.transpose();
  return largest;
}

double LinearWindows::deviation(const PathRecord& record, Index sample, Index state) const {
  return record.weights(sample, state) *
         (record.samples.states(sample, state) - record.slots(sample * record.stride(), state));
}

Vector LinearWindows::misfits() const {
  Vector sums = Vector::Zero(dimension());
  for (const Window& window : windows_)
    for (Index i = window.first; i < window.first + window.samples; ++i)
      for (Index k = 0; k < dimension(); ++k)
        sums[k] += std::pow(deviation(records_[window.record], i, k), 2);
  return sums;
}

Vector LinearWindows::counts() const {
  Vector counts = Vector::Zero(dimension());
  for (const Window& window : windows_)
    for (Index i = window.first; i < window.first + window.samples; ++i)
      for (Index k = 0; k < dimension(); ++k)
        counts[k] += records_[window.record].weights(i, k) > 0.0 ? 1.0 : 0.0;
  return counts;
}

void LinearWindows::mask_beyond(double limit) {
  for (const Window& window : windows_)
    for (Index i = window.first; i < window.first + window.samples; ++i)
      for (Index k = 0; k < dimension(); ++k)
        if (std::abs(deviation(records_[window.record], i, k)) > limit)
          records_[window.record].weights(i, k) = 0.0;
}

}  // namespace lacuna
