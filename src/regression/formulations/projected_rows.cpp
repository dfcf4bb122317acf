// SPDX-License-Identifier: MIT
#include "regression/formulations/projected_rows.hpp"

#include <algorithm>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// Functionals that are made together, where no more overlap; a fact of caches.
constexpr Index kBlock = 128;

/// Records whose "derivatives" are the states, so that rows at samples hold terms and states.
std::vector<Trajectory> with_states_as_targets(const std::vector<Trajectory>& records) {
  std::vector<Trajectory> result = records;
  for (Trajectory& record : result)
    if (!record.has_derivatives()) record.derivatives = record.states;
  return result;
}

Index first_entry(const SparseRows& matrix, Index row) {
  const SparseRows::InnerIterator entry(matrix, row);
  return entry ? entry.col() : 0;
}

Index last_entry(const SparseRows& matrix, Index row) {
  Index last = 0;
  for (SparseRows::InnerIterator entry(matrix, row); entry; ++entry) last = entry.col();
  return last;
}

/// Columns below the diagonal that the rows of a lower triangular matrix reach back.
Index bandwidth(const SparseRows& lower) {
  Index most = 0;
  for (Index row = 0; row < lower.rows(); ++row)
    most = std::max(most, row - first_entry(lower, row));
  return most;
}

/// A part of a sparse matrix.
SparseRows cut(const SparseRows& all, Index row, Index rows, Index column, Index columns) {
  const Eigen::SparseMatrix<double, Eigen::ColMajor, Index> part(all.middleRows(row, rows));
  return SparseRows(part.middleCols(column, columns));
}

}  // namespace

class ProjectedRows::Reader final : public RowReader {
 public:
  explicit Reader(const ProjectedRows& source)
      : source_(source), samples_(source.samples_->open()) {}

  void read(Index first, Eigen::Ref<Matrix> theta, Eigen::Ref<Matrix> targets) override {
    auto block = std::upper_bound(
        source_.blocks_.begin(), source_.blocks_.end(), first,
        [](Index row, const Block& candidate) { return row < candidate.first_row; });
    --block;
    for (Index done = 0; done < theta.rows(); ++block) {
      const Matrix& rows = whole(*block);
      const Index skip = first + done - block->first_row;
      const Index count = std::min(theta.rows() - done, rows.rows() - skip);
      theta.middleRows(done, count) = rows.block(skip, 0, count, theta.cols());
      targets.middleRows(done, count) = rows.block(skip, theta.cols(), count, targets.cols());
      done += count;
    }
  }

  /// All rows of a block.
  const Matrix& whole(const Block& block) {
    if (&block == current_) return rows_;
    const Index terms = source_.terms(), targets = source_.targets();
    Matrix theta(block.samples, terms), states(block.samples, targets);
    samples_->read(block.first_sample, theta, states);
    rows_.resize(block.values.rows(), terms + targets);
    rows_ << block.values * theta, block.rates * states;
    if (block.before.cols() > 0) rows_ -= block.before * block.carried;
    if (block.factor.size() > 0)
      block.factor.triangularView<Eigen::Lower>().solveInPlace(rows_);
    current_ = &block;
    return rows_;
  }

 private:
  const ProjectedRows& source_;
  std::unique_ptr<RowReader> samples_;
  const Block* current_ = nullptr;
  Matrix rows_;
};

ProjectedRows::ProjectedRows(const TermLibrary& library, const std::vector<Trajectory>& records,
                             const std::vector<Projection>& projections,
                             std::vector<Index> held)
    : samples_(std::make_shared<const LibraryRows>(library, with_states_as_targets(records), 0,
                                                   std::move(held))) {
  for (const RecordRows& part : samples_->record_rows())
    add_blocks(projections[part.record], part, !records[part.record].has_derivatives());
  if (rows_ == 0)
    throw DataError("data", "no record is as long as the support of a test function",
                    "give longer records or a smaller radius");
  carry_over();
}

void ProjectedRows::add_blocks(const Projection& projection, const RecordRows& part,
                               bool whiten) {
  Index begin = 0;
  while (begin < projection.rows() && first_entry(projection.values, begin) < part.first_sample)
    ++begin;
  const Index rows = projection.rows() - begin;
  if (rows == 0) return;
  const SparseRows lower = whiten ? projection.target_factor(begin, rows) : SparseRows();
  const Index overlap = bandwidth(lower), size = std::max(kBlock, overlap);
  for (Index first = 0; first < rows; first += size) {
    const Index count = std::min(size, rows - first), reach = std::min(first, overlap);
    Block block = make_block(projection, part, begin + first, count);
    if (whiten) {
      block.factor = cut(lower, first, count, first, count);
      block.before = cut(lower, first, count, first - reach, reach);
    } else {
      block.rates = block.values;
    }
    block.first_row = rows_;
    rows_ += count;
    blocks_.push_back(std::move(block));
  }
}

ProjectedRows::Block ProjectedRows::make_block(const Projection& projection,
                                               const RecordRows& part, Index first,
                                               Index count) const {
  const Index begin = first_entry(projection.values, first);
  Block block;
  block.first_sample = part.first_row + begin - part.first_sample;
  block.samples = last_entry(projection.values, first + count - 1) + 1 - begin;
  block.values = cut(projection.values, first, count, begin, block.samples);
  block.rates = cut(projection.rates, first, count, begin, block.samples);
  return block;
}

/// Gives each block the white rows before it: one pass over all rows.
void ProjectedRows::carry_over() {
  Reader reader(*this);
  for (std::size_t b = 1; b < blocks_.size(); ++b)
    if (const Index reach = blocks_[b].before.cols(); reach > 0)
      blocks_[b].carried = reader.whole(blocks_[b - 1]).bottomRows(reach);
}

std::unique_ptr<RowReader> ProjectedRows::open() const {
  return std::make_unique<Reader>(*this);
}

}  // namespace lacuna
