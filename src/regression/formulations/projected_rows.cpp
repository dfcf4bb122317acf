// SPDX-License-Identifier: MIT
#include "lacuna/regression/formulations/projected_rows.hpp"

#include <algorithm>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// Functionals that are whitened together; the correlation of those at the border of two blocks
/// is left out.
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

 private:
  const Matrix& whole(const Block& block) {
    if (&block == current_) return rows_;
    const Index terms = source_.terms(), targets = source_.targets();
    Matrix theta(block.samples, terms), states(block.samples, targets);
    samples_->read(block.first_sample, theta, states);
    rows_.resize(block.values.rows(), terms + targets);
    rows_ << block.values * theta, block.rates * states;
    if (block.factor.size() > 0)
      block.factor.triangularView<Eigen::Lower>().solveInPlace(rows_);
    current_ = &block;
    return rows_;
  }

  const ProjectedRows& source_;
  std::unique_ptr<RowReader> samples_;
  const Block* current_ = nullptr;
  Matrix rows_;
};

ProjectedRows::ProjectedRows(const TermLibrary& library, const std::vector<Trajectory>& records,
                             const std::vector<Projection>& projections)
    : samples_(std::make_shared<const LibraryRows>(library, with_states_as_targets(records))) {
  for (const RecordRows& part : samples_->record_rows())
    add_blocks(projections[part.record], part, !records[part.record].has_derivatives());
  if (rows_ == 0)
    throw DataError("data", "no record is as long as the support of a test function",
                    "give longer records or a smaller radius");
}

void ProjectedRows::add_blocks(const Projection& projection, const RecordRows& part,
                               bool whiten) {
  Index first = 0;
  while (first < projection.rows() && first_entry(projection.values, first) < part.first_sample)
    ++first;
  while (first < projection.rows()) {
    const Index count = std::min(kBlock, projection.rows() - first);
    Block block = make_block(projection, part, first, count, whiten);
    block.first_row = rows_;
    rows_ += count;
    blocks_.push_back(std::move(block));
    first += count;
  }
}

ProjectedRows::Block ProjectedRows::make_block(const Projection& projection,
                                               const RecordRows& part, Index first, Index count,
                                               bool whiten) const {
  const Index begin = first_entry(projection.values, first);
  const Index samples = last_entry(projection.values, first + count - 1) + 1 - begin;
  Block block;
  block.first_sample = part.first_row + begin - part.first_sample;
  block.samples = samples;
  const auto cut = [&](const SparseRows& all) {
    const SparseRows rows = all.middleRows(first, count);
    const Eigen::SparseMatrix<double, Eigen::ColMajor, Index> columns(rows);
    return SparseRows(columns.middleCols(begin, samples));
  };
  block.values = cut(projection.values);
  block.rates = whiten ? cut(projection.rates) : block.values;
  if (whiten) block.factor = projection.target_factor(first, count);
  return block;
}

std::unique_ptr<RowReader> ProjectedRows::open() const {
  return std::make_unique<Reader>(*this);
}

}  // namespace lacuna
