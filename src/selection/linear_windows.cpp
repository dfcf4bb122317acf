// SPDX-License-Identifier: MIT
#include "linear_windows.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lacuna/linear/tile_kernels.hpp"

namespace lacuna {
namespace {

constexpr Index kFoldRows = 256;

Index padded(Index rows) {
  return (rows + Scratch::kRowPadding - 1) / Scratch::kRowPadding * Scratch::kRowPadding;
}

/// Rows that are left when the initial state is eliminated.
Index usable_rows(const Matrix& rows, Index dimension) {
  return std::max<Index>(0, rows.rows() - dimension);
}

}  // namespace

RowFold::RowFold(Index columns)
    : capacity_(padded(std::max(kFoldRows, columns))),
      scratch_(capacity_, columns),
      triangle_(Matrix::Zero(columns, columns)) {}

void RowFold::add(const Eigen::Ref<const Matrix>& rows) {
  for (Index done = 0; done < rows.rows();) {
    if (rows_ == capacity_) fold();
    const Index count = std::min(capacity_ - rows_, rows.rows() - done);
    scratch_.block(rows_ + count, 0, scratch_.columns()).bottomRows(count) =
        rows.middleRows(done, count);
    rows_ += count;
    done += count;
  }
}

void RowFold::fold() {
  if (rows_ == 0) return;
  const Index all = padded(rows_);
  scratch_.block(all, 0, scratch_.columns()).bottomRows(all - rows_).setZero();
  fold_triangle(scratch_, rows_, triangle_);
  rows_ = 0;
}

const Matrix& RowFold::triangle() {
  fold();
  return triangle_;
}

LinearWindows::LinearWindows(const TermLibrary& library,
                             std::vector<std::optional<Index>> exact,
                             std::vector<PathRecord> records)
    : values_(library), exact_(std::move(exact)), records_(std::move(records)) {}

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
  for (PathRecord& record : records_) lacuna::set_substeps(record, substeps, values_.program());
}

void LinearWindows::rescale(const Vector& factors) {
  for (PathRecord& record : records_)
    record.weights.array().rowwise() /= factors.transpose().array();
}

/// Evaluates terms and Jacobians at the nodes of a window.
void LinearWindows::load(const Window& window, const Matrix& coefficients) {
  const PathRecord& record = records_[window.record];
  const Index nodes = (window.samples - 1) * record.stride() + 1;
  const auto slots = record.slots.middleRows(window.first * record.stride(), nodes);
  values_.evaluate(slots);
  path_ = slots.leftCols(dimension()).transpose();
  jacobians_.resize(static_cast<std::size_t>(nodes));
  offsets_.resize(dimension(), nodes);
  for (Index node = 0; node < nodes; ++node) {
    Matrix& jacobian = jacobians_[static_cast<std::size_t>(node)];
    values_.jacobian(node, coefficients, jacobian);
    for (Index k = 0; k < dimension(); ++k)
      if (const auto rate = exact_[static_cast<std::size_t>(k)]) {
        jacobian.row(k).setZero();
        jacobian(k, *rate) = 1.0;
      }
    offsets_.col(node) = -jacobian * path_.col(node);
    for (Index k = 0; k < dimension(); ++k)
      if (exact_[static_cast<std::size_t>(k)]) offsets_(k, node) = 0.0;
  }
}

/// Adds a map times [0 theta | offset] at a node.
void LinearWindows::add_block(Index local, const Matrix& map, Matrix& columns) const {
  const auto theta = values_.theta(local);
  const Index m = dimension();
  for (std::size_t c = 0; c < columns_.size(); ++c)
    columns.col(m + static_cast<Index>(c)) +=
        theta[columns_[c].term] * map.col(columns_[c].equation);
  columns.col(columns.cols() - 1) += map * offsets_.col(local);
}

/// Takes [S G c] over one step from a node to the next but one.
void LinearWindows::step(const PathRecord& record, Index node, Index local, Matrix& columns) {
  const Index m = dimension();
  const double h = record.time[node + 2] - record.time[node];
  const auto place = static_cast<std::size_t>(local);
  const Matrix &j0 = jacobians_[place], &jm = jacobians_[place + 1],
               &j1 = jacobians_[place + 2];
  const Matrix one = Matrix::Identity(m, m);
  const Matrix fourth = h / 6.0 * one;
  const Matrix third = h / 3.0 * one + h * fourth * j1;
  const Matrix second = h / 3.0 * one + 0.5 * h * third * jm;
  const Matrix first = h / 6.0 * one + 0.5 * h * second * jm;
  const Matrix middle = second + third;
  columns = ((one + first * j0 + middle * jm + fourth * j1) * columns).eval();
  add_block(local, first, columns);
  add_block(local + 1, middle, columns);
  add_block(local + 2, fourth, columns);
}

/// Weighted rows [S G | y - c] of the loaded window.
Matrix LinearWindows::window_rows(const Window& window) {
  const PathRecord& record = records_[window.record];
  const Index m = dimension(), width = m + static_cast<Index>(columns_.size()) + 1;
  Matrix columns = Matrix::Zero(m, width);
  columns.leftCols(m).setIdentity();
  Matrix rows(window.samples * m, width);
  Index used = 0;
  for (Index i = 0; i < window.samples; ++i) {
    const Index sample = window.first + i;
    for (Index k = 0; k < m; ++k) {
      const double weight = record.weights(sample, k);
      if (!(weight > 0.0)) continue;
      rows.row(used) = weight * columns.row(k);
      rows(used, width - 1) =
          weight * (record.samples.states(sample, k) - columns(k, width - 1));
      ++used;
    }
    if (i + 1 == window.samples) break;
    for (Index s = 0; s < record.stride(); s += 2)
      step(record, sample * record.stride() + s, i * record.stride() + s, columns);
  }
  return rows.topRows(used);
}

/// Turns rows so that only the first m know of the initial state; folds the others.
void LinearWindows::eliminate(Window& window, Matrix rows, RowFold& fold) {
  const Index m = dimension(), rest = usable_rows(rows, m);
  window.head = Matrix();
  if (rest == 0 || !rows.allFinite()) return;
  const Eigen::HouseholderQR<Matrix> factor(rows.leftCols(m));
  rows.applyOnTheLeft(factor.householderQ().transpose());
  window.head = rows.topRows(m);
  fold.add(rows.bottomRows(rest).rightCols(rows.cols() - m));
  rows_ += rest;
}

Matrix LinearWindows::linearise(const Matrix& h0, const std::vector<Coefficient>& columns) {
  columns_ = columns;
  linearised_at_ = h0;
  rows_ = 0;
  RowFold fold(static_cast<Index>(columns.size()) + 1);
  for (Window& window : windows_) {
    load(window, h0);
    eliminate(window, window_rows(window), fold);
  }
  return fold.triangle();
}

Vector LinearWindows::start_of(const Window& window, const Vector& values) const {
  const Index m = dimension();
  const Matrix& head = window.head;
  const Vector target = head.col(head.cols() - 1) - head.middleCols(m, values.size()) * values;
  const Matrix square = head.leftCols(m).triangularView<Eigen::Upper>();
  return square.completeOrthogonalDecomposition().solve(target);
}

std::optional<double> LinearWindows::move(const Vector& values) {
  Matrix coefficients = Matrix::Zero(dimension(), values_.terms());
  for (std::size_t c = 0; c < columns_.size(); ++c)
    coefficients(columns_[c].equation, columns_[c].term) = values[static_cast<Index>(c)];
  double largest = 0.0;
  bool finite = true;
  for (const Window& window : windows_) {
    const std::optional<double> moved =
        window.head.size() > 0 ? move_window(window, values, coefficients) : std::nullopt;
    finite = finite && (moved || window.head.size() == 0);
    largest = std::max(largest, moved.value_or(0.0));
  }
  if (!finite) return std::nullopt;
  return largest;
}

/// J (x - path) + Theta(path) h at a node of the loaded window.
Vector LinearWindows::rate(Index local, const Vector& state, const Matrix& coefficients) const {
  const Matrix& jacobian = jacobians_[static_cast<std::size_t>(local)];
  Vector result = jacobian * (state - path_.col(local)) + coefficients * values_.theta(local);
  for (Index k = 0; k < dimension(); ++k)
    if (const auto exact = exact_[static_cast<std::size_t>(k)]) result[k] = state[*exact];
  return result;
}

/// The solution at the nodes of the loaded window, middles by Hermite's cubic: m x nodes.
Matrix LinearWindows::solve_window(const Window& window, Vector state,
                                   const Matrix& coefficients) const {
  const PathRecord& record = records_[window.record];
  const Index begin = window.first * record.stride(), nodes = path_.cols();
  Matrix solution(dimension(), nodes);
  solution.col(0) = state;
  Vector before = rate(0, state, coefficients);
  for (Index node = 0; node + 2 < nodes; node += 2) {
    const double h = record.time[begin + node + 2] - record.time[begin + node];
    const Vector k2 = rate(node + 1, state + 0.5 * h * before, coefficients);
    const Vector k3 = rate(node + 1, state + 0.5 * h * k2, coefficients);
    const Vector k4 = rate(node + 2, state + h * k3, coefficients);
    const Vector next = state + h / 6.0 * (before + 2.0 * k2 + 2.0 * k3 + k4);
    const Vector after = rate(node + 2, next, coefficients);
    solution.col(node + 1) = 0.5 * (state + next) + h / 8.0 * (before - after);
    solution.col(node + 2) = next;
    state = next;
    before = after;
  }
  return solution;
}

std::optional<double> LinearWindows::move_window(const Window& window, const Vector& values,
                                                 const Matrix& coefficients) {
  load(window, linearised_at_);
  const Matrix solution = solve_window(window, start_of(window, values), coefficients);
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
