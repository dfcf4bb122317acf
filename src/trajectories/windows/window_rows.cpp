// SPDX-License-Identifier: MIT
#include "window_rows.hpp"

#include <algorithm>

namespace lacuna {
namespace {

/// B := A B with A square and small.
void left_multiply(const Matrix& a, Matrix& b, Vector& column) {
  const Index m = a.rows();
  for (Index c = 0; c < b.cols(); ++c) {
    double* target = b.col(c).data();
    column.setZero();
    for (Index j = 0; j < m; ++j)
      for (Index i = 0; i < m; ++i) column[i] += a(i, j) * target[j];
    std::copy_n(column.data(), m, target);
  }
}

}  // namespace

WindowRows::WindowRows(Rates& rates, const StepScheme& scheme)
    : rates_(rates),
      substeps_(scheme.substeps),
      dimension_(rates.dimension()),
      columns_(rates.columns()),
      maps_(rates, scheme),
      sensitivity_(dimension_, dimension_ + columns_),
      transition_(dimension_, dimension_),
      interval_(dimension_, dimension_),
      column_(dimension_),
      fold_(dimension_ + columns_ + 1) {}

void WindowRows::run(const WindowRowsInput& input, const WindowRange& range,
                     FunctionRef<void(Index, const Matrix&)> visit, Matrix& transitions) {
  const ShootingRecord& record = input.record;
  const auto add_rows = [&](Index, Index sample, const Matrix& s) {
    for (std::size_t q = 0; q < record.measured.size(); ++q) {
      const Index k = record.measured[q], column = static_cast<Index>(q);
      const double weight = input.weights(sample, column);
      double* row = fold_.next_row();
      for (Index j = 0; j < s.cols(); ++j, row += fold_.stride()) *row = weight * s(k, j);
      *row = weight * (record.values(sample, column) - input.orbits.samples(sample, k));
    }
  };
  for (Index w = range.first; w < range.first + range.count; ++w) {
    follow(input, w, add_rows, &transitions);
    visit(w, *fold_.finish());
  }
}

void WindowRows::sensitivities(const WindowRowsInput& input,
                               FunctionRef<void(Index, Index, const Matrix&)> visit) {
  for (std::size_t w = 0; w < input.plan.size(); ++w)
    follow(input, static_cast<Index>(w), visit, nullptr);
}

void WindowRows::follow(const WindowRowsInput& input, Index number,
                        FunctionRef<void(Index, Index, const Matrix&)> visit,
                        Matrix* transitions) {
  const Window& window = input.plan[static_cast<std::size_t>(number)];
  const Index begin = window.first * substeps_;
  const Index steps = window.intervals * substeps_;
  sensitivity_.setZero();
  sensitivity_.leftCols(dimension_).setIdentity();
  interval_.setIdentity();
  visit(number, window.first, sensitivity_);
  for (Index step = 0; step < steps; ++step) {
    if (step % StepMaps::kBlock == 0)
      maps_.evaluate(rates_, input.signals, input.orbits.stages, begin + step,
                     std::min(StepMaps::kBlock, steps - step));
    if (step % substeps_ == 0) interval_.setIdentity();
    pass_step(step % StepMaps::kBlock);
    if ((step + 1) % substeps_ != 0) continue;
    const Index sample = (step + 1) / substeps_;
    if (transitions) note_transition(window.first + sample - 1, *transitions);
    if (sample < window.samples) visit(number, window.first + sample, sensitivity_);
  }
}

/// S := Phi S + [0 Gamma], and the same for Phi of the interval.
void WindowRows::pass_step(Index row) {
  const Index m = dimension_;
  for (Index i = 0; i < m * m; ++i) transition_.data()[i] = maps_.transitions()(row, i);
  left_multiply(transition_, interval_, column_);
  left_multiply(transition_, sensitivity_, column_);
  for (Index c = 0; c < columns_; ++c)
    for (Index k = 0; k < m; ++k) sensitivity_(k, m + c) += maps_.responses()(row, c * m + k);
}

void WindowRows::note_transition(Index interval, Matrix& transitions) const {
  transitions.row(interval) = Eigen::Map<const Vector>(interval_.data(), interval_.size());
}

}  // namespace lacuna
