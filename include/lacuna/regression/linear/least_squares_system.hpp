// SPDX-License-Identifier: MIT
// The linear system of all equations, and the problem of one.
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// How rows are folded into statistics.
enum class Folding {
  Automatic,   ///< Gram; tall-skinny QR where the Gram cannot resolve the problem
  Gram,        ///< normal equations and Cholesky: fastest
  Orthogonal,  ///< tall-skinny QR: as accurate as QR of the whole matrix
  Deflated,    ///< Gram of the terms and of what a fit to some rows leaves of the targets
};

/// Of more terms what is sought term by term is sought in the Gram matrix: a fact of cost.
inline constexpr Index kWideTerms = 256;

/// All that is kept of the rows: the triangular factor of [Theta Y] with columns of Theta
/// scaled to unit norm.
///
///   [Theta D^-1, Y] = Q R,  D = diag(column_norms),  R = [R_tt R_ty; 0 R_yy]
///
/// R is (L + m) x (L + m), upper triangular. Any least-squares problem in a subset of the
/// columns has the same solution in R as in the rows, at a cost that does not depend on n.
struct Factor {
  Matrix triangle;      ///< R, (L + m) x (L + m)
  Vector column_norms;  ///< |theta_j|, L; a column of zeros has norm 0 and stays zero
  Vector target_norms;  ///< |y_k|, m
  Index rows = 0;       ///< n
  Folding folding = Folding::Gram;  ///< how it was made
  Matrix gram = {};  ///< [Theta Y]'[Theta Y] of more than kWideTerms terms, where it made R

  Index terms() const noexcept { return column_norms.size(); }  ///< L
};

/// So many rows that another pass over them is worth avoiding. A fact of the machines: below, a
/// pass takes milliseconds.
inline constexpr Index kManyRows = Index{1} << 18;

/// Reads rows for one thread; holds that thread's scratch memory.
class RowReader {
 public:
  virtual ~RowReader() = default;

  /// Writes theta.rows() rows from row `first` on.
  /// @param theta rows x L, term values; @param targets rows x m.
  virtual void read(Index first, Eigen::Ref<Matrix> theta, Eigen::Ref<Matrix> targets) = 0;
};

/// The rows of Theta h_k ~ y_k, k = 1..m, made on demand so that the n x L matrix never has to
/// exist: samples, test functions or intervals, in memory, in a file or in a shard per process.
class RowSource {
 public:
  virtual ~RowSource() = default;
  virtual Index rows() const = 0;     ///< n
  virtual Index terms() const = 0;    ///< L
  virtual Index targets() const = 0;  ///< m

  /// A reader for one thread; several may be open at a time.
  virtual std::unique_ptr<RowReader> open() const = 0;
};

/// Rows that lie in memory, for small problems and tests.
/// @throws ArgumentError when the numbers of rows differ.
std::shared_ptr<const RowSource> make_row_source(Matrix theta, Matrix targets);

/// The same rows in memory if they take at most `most_bytes`, otherwise `source` itself: for
/// rows that are costlier to make than to keep and are passed over many times.
/// @throws ArgumentError when there is no source.
std::shared_ptr<const RowSource> kept_in_memory(std::shared_ptr<const RowSource> source,
                                                Index most_bytes = Index{1} << 26);

struct TriangularProblem;

/// The least-squares problem of one target in a set A of active terms, as a triangular system:
///
///   min_h |y - Theta_A h|^2 = min_h |c - R D h|^2 + rho^2
///
/// with R (|A| x |A|) upper triangular, D the norms of the columns, rho the residual that no h
/// removes. Terms leave it by Givens rotations. A value of its own: it does not refer to the
/// rows. Coefficients h are in the units of the data everywhere; scaling is inside.
class Subproblem {
 public:
  /// Restricts a factor of all terms to one target and the active terms: O(L |A|^2), O(|A|^2)
  /// when these are the first |A| terms.
  /// @throws ArgumentError when a number is out of range or the set is not increasing.
  Subproblem(const Factor& factor, Index target, TermSet active);

  Index target() const noexcept { return target_; }           ///< k
  const TermSet& active() const noexcept { return active_; }  ///< A, increasing, each term once
  Index size() const noexcept { return static_cast<Index>(active_.size()); }  ///< |A|
  Index rows() const noexcept { return rows_; }                               ///< n
  double target_norm() const noexcept { return target_norm_; }                ///< |y|

  /// Norms |theta_j| of the active columns (for a weighted problem: of the weighted columns).
  const Vector& column_norms() const noexcept { return column_norms_; }

  /// R: upper triangular, columns scaled to unit norm.
  const Matrix& triangle() const noexcept { return triangle_; }

  /// c, |A| entries: the target in the coordinates of R.
  const Vector& projected_target() const noexcept { return projected_target_; }

  /// Least-squares coefficients, (7) of Karimov et al. 2023. Directions that the data do not
  /// determine (|R_ii| below rounding) get coefficient 0: of terms that depend on each other
  /// the last does.
  Vector solve() const;

  /// Solves R'R dh = g for a gradient g = Theta_A' r (refinement). Coefficients that solve()
  /// sets to 0 do not change.
  /// @throws ArgumentError unless there is one entry per active term.
  Vector solve_normal(const Vector& gradient) const;

  /// |y - Theta_A h| of the least-squares solution; O(|A|^3) where terms depend on each other.
  double residual_norm() const;

  /// |y - Theta_A h| of any h.
  /// @throws ArgumentError unless there is one entry per active term.
  double residual_norm(const Vector& h) const;

  /// Takes the term at a position of active() out: O(|A|^2).
  /// @throws ArgumentError when there is no such position.
  void remove(Index position);

  /// Estimate of the condition number of the scaled columns (1-norm).
  double condition() const;

  /// Diagonal of (Theta_A' Theta_A)^-1: times the residual variance, the variance of each
  /// coefficient. Infinite where the data do not determine one.
  Vector inverse_gram_diagonal() const;

  /// The same problem under other numbers of its target and its terms, for a problem whose rows
  /// were made from some columns of another.
  /// @param active as many numbers as size().
  Subproblem renumbered(Index target, TermSet active) const;

 private:
  void set_problem(TriangularProblem problem);
  bool is_rank_deficient() const;
  std::pair<TriangularProblem, TermSet> determined_part() const;

  TermSet active_;
  Index target_ = 0;
  Index rows_ = 0;
  double target_norm_ = 0.0;
  double remainder_ = 0.0;  // rho
  Vector column_norms_;
  Matrix triangle_;
  Vector projected_target_;
};

class Subproblem;

/// Row weights from residuals, one tile at a time: weights(residuals) entry by entry.
using WeightFunction =
    std::function<void(const Eigen::Ref<const Vector>& residuals, Eigen::Ref<Vector> weights)>;

/// The linear problem Theta h_k ~ y_k for k = 1..m that every filter, regressor and pruner
/// works on. Owns a row source and the statistics of its rows, never the n x L matrix.
///
/// Rows are read in tiles and folded in a fixed order, so the result does not depend on the
/// number of threads. Folding is by the Gram matrix (scaled, Cholesky); where its scaled
/// condition exceeds about 1e7, where Cholesky breaks down, or where the residual lies below
/// what a Gram can resolve, it is repeated by tall-skinny QR (see factorise()). A value: copies
/// share rows and statistics.
class LeastSquaresSystem {
 public:
  /// Reads all rows once (or twice, see above).
  /// @throws ArgumentError when names do not fit the columns; DataError when a row is not
  /// finite.
  LeastSquaresSystem(std::shared_ptr<const RowSource> rows, std::vector<std::string> term_names,
                     std::vector<std::string> target_names, const RunContext& context = {},
                     Folding folding = Folding::Automatic);

  Index rows() const noexcept { return factor_->rows; }                                 ///< n
  Index terms() const noexcept { return factor_->terms(); }                             ///< L
  Index targets() const noexcept { return factor_->target_norms.size(); }               ///< m
  const std::vector<std::string>& term_names() const noexcept { return *term_names_; }  ///< L
  /// Names of the m targets.
  const std::vector<std::string>& target_names() const noexcept { return *target_names_; }

  /// rms of what each target has of systematic error (of the truncation of differences, say)
  /// over all rows, in its units; nothing when that is not known.
  const std::optional<Vector>& target_error() const noexcept { return target_error_; }

  /// The system with the systematic error of its targets.
  /// @throws ArgumentError unless there is one finite number >= 0 per target.
  LeastSquaresSystem with_target_error(Vector error) const;

  /// Statistics of all rows.
  const Factor& factor() const noexcept { return *factor_; }

  /// All term numbers 0..L-1.
  TermSet all_terms() const;

  /// The problem of target k in a subset A of the terms, increasing numbers below L.
  /// @throws ArgumentError when a number is out of range or the set is not increasing.
  Subproblem subproblem(Index target, TermSet active) const;

  /// The same problem with rows weighted by their residuals at h: minimises
  /// sum_i w_i (y_i - theta_i h)^2. One pass over the rows, folded as the system is.
  /// @param h one entry per active term, unscaled.
  /// @throws ArgumentError when h does not fit, or a weight is negative or not finite.
  Subproblem reweighted(const Subproblem& problem, const Vector& h,
                        const WeightFunction& weights, const RunContext& context = {}) const;

  /// Coefficients after one pass of iterative refinement: r = y - Theta h, R'R dh = Theta' r.
  /// Of very many rows that were folded orthogonally or deflated: as they are.
  /// @param problem not a weighted one.
  /// @throws ArgumentError when h does not fit.
  Vector refined(const Subproblem& problem, const Vector& h,
                 const RunContext& context = {}) const;

  /// Residuals y - Theta_A h of one target, all n of them. One pass.
  /// @throws ArgumentError when numbers are out of range or h does not fit.
  Vector residuals(Index target, const TermSet& active, const Vector& h,
                   const RunContext& context = {}) const;

 private:
  std::shared_ptr<const RowSource> source_;
  std::shared_ptr<const std::vector<std::string>> term_names_;
  std::shared_ptr<const std::vector<std::string>> target_names_;
  std::shared_ptr<const Factor> factor_;
  std::optional<Vector> target_error_ = {};
  Folding folding_;  // as asked for
};

}  // namespace lacuna
