// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/term.hpp"
#include "regression/formulations/projection.hpp"

namespace lacuna {

/// A sum of squares of noise.
struct NoiseSquares {
  double mean = 0.0, deviation = 0.0;
};

/// The weak form of a dataset with its rows at hand, K x columns, so that one form more costs
/// one column. Rows are whitened: white noise sigma of a state is white noise sigma of its
/// target (see WeakForm). Where rates are measured, the target is their mean with the weights of
/// the terms, without an error of quadrature. Test functions are as wide as the noise asks for,
/// and not so wide that few rows are left.
class FormRows {
 public:
  /// Rows that are whitened together: a fact of caches.
  static constexpr Index kBlock = 128;

  /// @param noise of each state: forms are evaluated at smoothed samples, because noise in an
  ///   argument makes bends out of jumps.
  /// @param library terms whose columns are made once.
  /// @param seen as of FormSearch.
  FormRows(const Dataset& data, const Vector& noise, const std::vector<Term>& library = {},
           int threads = 1, const std::optional<Vector>& seen = {});

  const Variables& variables() const { return variables_; }
  Index rows() const { return rows_; }  ///< K

  /// K x forms; not finite where a form has no value at a sample.
  Matrix columns(const std::vector<Expression>& forms) const;

  /// The same of terms.
  Matrix columns_of(const std::vector<Term>& terms) const;

  Vector target(Index state) const { return targets_.col(state); }  ///< K

  /// Samples that rows depend on: of long records those within a test function.
  Index samples() const { return slots_.rows(); }

  /// Samples x forms: the values themselves.
  Matrix values(const std::vector<Expression>& forms) const;

  /// K x columns: the rows of what is given at the samples.
  Matrix projected(const Matrix& samples) const;

  /// What white noise of the samples leaves of an equation's target, to first order: its
  /// residual is L^-1 sum_j A_j e_j, A_j = [j = state] rates - values diag(g_j), so that its
  /// squares have the mean tr S and the variance 2 tr S^2, S = L^-1 sum_j sigma_j^2 A_j A_j' L^-T.
  /// Of S the blocks are counted in which rows were whitened. 0 where rates are measured.
  /// @param sensitivity samples x m: g_j = df/dx_j. @param noise sigma of each state.
  NoiseSquares noise_squares(const Matrix& sensitivity, const Vector& noise,
                             Index state) const;

  /// The smoothed rate of a state at the samples.
  Vector rate(Index state) const { return rates_.col(state); }

 private:
  /// Rows of one record.
  struct Part {
    Index first = 0;    ///< of its samples
    SparseRows values;  ///< K x samples, of forms
    SparseRows rates;   ///< K x samples, of states; without rows where rates are measured
    SparseRows factor;  ///< L of the whitening, banded

    /// L^-1 times the rows of what is given at the samples.
    Matrix whitened(const SparseRows& rows, const Matrix& samples) const;
  };

  /// Samples and rows of all records.
  void take_in(const Dataset& data, const Vector& noise, int threads,
               const std::optional<Vector>& seen);

  /// Columns of terms.
  void take_in(const std::vector<Term>& library, int threads);

  /// A state of a record, smoothed, at its place among the samples.
  void smooth(const Trajectory& record, Index state, double noise, Index first);

  /// Leaves out the samples that no row depends on.
  void keep_samples_of_rows();

  Variables variables_;
  Matrix slots_;    ///< samples x variables, where forms are evaluated
  Matrix rates_;    ///< samples x m, as measured, or smoothed
  Matrix targets_;  ///< K x m
  std::vector<Part> parts_;
  Index rows_ = 0;
  std::map<std::string, Vector> known_;  ///< columns of the library, by names of terms
};

/// Columns of forms, each made once: every equation and every round of a search begins with the
/// same forms at the same starting points. A column is a function of its form alone, so that what
/// comes out does not depend on what is kept. As many are kept as there is room for, the first
/// ones. Several threads may ask at a time.
class ColumnMemory {
 public:
  /// A fact of the machines: 64 MB.
  static constexpr Index kMostNumbers = Index{1} << 23;

  using Maker = FunctionRef<Matrix(const std::vector<Expression>&)>;

  /// @param most numbers that are kept.
  explicit ColumnMemory(Index most = kMostNumbers) : most_(most) {}

  /// K x forms: what is kept, the rest from `make`.
  Matrix columns(const std::vector<Expression>& forms, Index rows, Maker make) const;

  /// Columns that were made so far.
  Index made() const;

 private:
  const Index most_;
  mutable std::mutex guard_;
  mutable std::map<std::string, Vector> kept_;  ///< by the text of a form
  mutable Index numbers_ = 0, made_ = 0;
};

/// |y - A h|^2 of the least squares solution; infinite where a column is not finite.
double residual_squares(const Matrix& columns, const Vector& target);

}  // namespace lacuna
