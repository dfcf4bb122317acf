// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "regression/formulations/library_rows.hpp"
#include "regression/formulations/projection.hpp"

namespace lacuna {

/// Rows L^-1 [values Theta, rates x] of the projections of several records, whitened: L L' is
/// the covariance of the targets for noise of unit variance, so that white noise sigma_k of the
/// samples of state k is white noise sigma_k of its target. L is as banded as the supports of
/// the functionals overlap, so that rows are made on demand, a block of them at a time, from
/// the samples and the last rows of the block before.
///
/// Where records bring derivatives, targets are values dx/dt and rows are not whitened.
class ProjectedRows final : public RowSource {
 public:
  /// @param projections one per record; functionals that reach into samples which a delayed
  /// term
  ///   leaves out are dropped.
  /// @param held inputs that hold their samples, as for LibraryRows.
  /// @throws DataError when no functional is left.
  ProjectedRows(const TermLibrary& library, const std::vector<Trajectory>& records,
                const std::vector<Projection>& projections, std::vector<Index> held = {});

  Index rows() const override { return rows_; }
  Index terms() const override { return samples_->terms(); }
  Index targets() const override { return samples_->targets(); }
  std::unique_ptr<RowReader> open() const override;

  /// The values at the samples that the rows are made of.
  const LibraryRows& samples() const noexcept { return *samples_; }

 private:
  class Reader;

  /// Functionals of one record that are made together.
  struct Block {
    Index first_row = 0;
    Index first_sample = 0;  ///< row of `samples_`
    Index samples = 0;
    SparseRows values, rates;  ///< rows x samples
    SparseRows factor;         ///< rows of L at the block's own columns; 0 x 0: no whitening
    SparseRows before;    ///< rows of L at the columns of the last rows of the block before
    Matrix carried = {};  ///< those rows, white
  };

  void add_blocks(const Projection& projection, const RecordRows& part, bool whiten);
  Block make_block(const Projection& projection, const RecordRows& part, Index first,
                   Index count) const;
  void carry_over();

  std::shared_ptr<const LibraryRows> samples_;
  std::vector<Block> blocks_;
  Index rows_ = 0;
};

}  // namespace lacuna
