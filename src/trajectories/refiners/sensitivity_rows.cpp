// SPDX-License-Identifier: MIT
#include "sensitivity_rows.hpp"

#include <algorithm>

namespace lacuna {
namespace {

/// Up to so many a loop is faster than a matrix product.
constexpr Index kFewStates = 6;

bool consecutive(const std::vector<Index>& places) {
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i] != places[i - 1] + 1) return false;
  return true;
}

/// Adds a step's maps times Theta at its three nodes to the columns of one equation.
void add_forcing(const Matrix& theta, const ColumnBlock& block, Index node,
                 SensitivityRows& rows) {
  const Index e = block.equation, count = static_cast<Index>(block.terms.size());
  const LinearStep& step = rows.step;
  for (Index k = 0; k < rows.next.cols(); ++k) {
    const double a = step.first(k, e), b = step.middle(k, e), c = k == e ? step.last : 0.0;
    auto target = rows.next.col(k).segment(block.first, count);
    if (block.contiguous) {
      const Index row = block.terms.front();
      target += a * theta.col(node).segment(row, count) +
                b * theta.col(node + 1).segment(row, count) +
                c * theta.col(node + 2).segment(row, count);
      continue;
    }
    for (Index i = 0; i < count; ++i) {
      const Index row = block.terms[static_cast<std::size_t>(i)];
      target[i] += a * theta(row, node) + b * theta(row, node + 1) + c * theta(row, node + 2);
    }
  }
}

/// Takes [S G c] over one step from a node to the next but one.
void take_step(const WindowRates& rates, const std::vector<ColumnBlock>& blocks, Index node,
               double length, SensitivityRows& rows) {
  const Index m = rows.now.cols();
  const Matrix& offsets = rates.offsets();
  rows.step.compute(rates.jacobians().middleCols(node, 3), m, length);
  const auto& [whole, first, middle, last] = rows.step;
  if (m > kFewStates)
    rows.next.noalias() = rows.now * whole.transpose();
  else
    for (Index k = 0; k < m; ++k) {
      rows.next.col(k) = whole(k, 0) * rows.now.col(0);
      for (Index j = 1; j < m; ++j) rows.next.col(k) += whole(k, j) * rows.now.col(j);
    }
  for (const ColumnBlock& block : blocks) add_forcing(rates.theta(), block, node, rows);
  if (m > kFewStates)
    rows.next.bottomRows(1) += (first * offsets.col(node) + middle * offsets.col(node + 1) +
                                last * offsets.col(node + 2))
                                   .transpose();
  else  // the same sums, without memory for each product
    rows.next.bottomRows(1) +=
        (first.lazyProduct(offsets.col(node)) + middle.lazyProduct(offsets.col(node + 1)) +
         last * offsets.col(node + 2))
            .transpose();
  rows.now.swap(rows.next);
}

/// Weighted rows [S G | y - c] of a sample.
void add_rows(const PathRecord& record, Index sample, SensitivityRows& rows) {
  for (Index k = 0; k < rows.now.cols(); ++k) {
    const double weight = record.weights(sample, k);
    if (!(weight > 0.0)) continue;
    auto row = rows.rows.col(rows.used++);
    row = weight * rows.now.col(k);
    row[row.size() - 1] = weight * record.samples.states(sample, k) - row[row.size() - 1];
  }
}

}  // namespace

std::vector<ColumnBlock> column_blocks(const std::vector<Coefficient>& columns,
                                       const std::vector<Index>& terms, Index dimension) {
  std::vector<ColumnBlock> blocks;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (c == 0 || columns[c].equation != columns[c - 1].equation)
      blocks.push_back({columns[c].equation, dimension + static_cast<Index>(c), {}, false});
    blocks.back().terms.push_back(
        std::lower_bound(terms.begin(), terms.end(), columns[c].term) - terms.begin());
  }
  for (ColumnBlock& block : blocks) block.contiguous = consecutive(block.terms);
  return blocks;
}

void integrate_rows(const WindowRates& rates, const std::vector<ColumnBlock>& blocks,
                    const PathRecord& record, const SampleWindow& window,
                    SensitivityRows& result) {
  const Index m = rates.path().rows();
  Index width = m + 1;
  for (const ColumnBlock& block : blocks) width += static_cast<Index>(block.terms.size());
  result.next.resize(width, m);
  result.now.resize(width, m);
  result.now.setZero();
  result.now.topRows(m).setIdentity();
  result.rows.resize(width, window.samples * m);
  result.used = 0;
  for (Index i = 0; i < window.samples; ++i) {
    const Index sample = window.first + i;
    add_rows(record, sample, result);
    if (i + 1 == window.samples) break;
    for (Index s = 0; s < record.stride(); s += 2) {
      const Index node = sample * record.stride() + s;
      take_step(rates, blocks, i * record.stride() + s,
                record.time[node + 2] - record.time[node], result);
    }
  }
}

}  // namespace lacuna
