// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lacuna/core/run_context.hpp"
#include "lacuna/flow/library_rates.hpp"
#include "lacuna/flow/linear_step.hpp"
#include "lacuna/linear/row_fold.hpp"
#include "reference_path.hpp"

namespace lacuna {

/// A coefficient: of which term in which equation.
struct Coefficient {
  Index equation = 0;
  Index term = 0;
  auto operator<=>(const Coefficient&) const = default;
};

/// The trajectory fit as a linear problem: equations are linearised about a path in phase space
/// instead of about a solution (quasilinearisation; Bellman & Kalaba 1965). In a window of
/// samples
///
///   x' = J (x - path) + Theta(path) h,  J = sum_l h0_l d theta_l / dx,  x(t_0) = s,
///
/// is linear in the initial state s and in the coefficients h of all candidate terms:
/// x = S s + G h + c. Rows are (y - c - S s - G h) / sigma at the samples. Samples enter as
/// they were measured, so that residuals are white where the model is right, and noise in terms
/// does not bias h. Initial states are eliminated window by window. With the x found as the
/// next path, h0 = h, the iteration is Newton's for the nonlinear problem; as it begins with
/// the smoothed samples, it needs no model that can be simulated: h0 = 0 will do.
///
/// S, G, c are integrated by the Runge-Kutta method of order 4, whose maps over a step are the
/// same for all columns (LinearStep, b = Theta h - J path).
class LinearWindows {
 public:
  /// @param exact the state that is the rate of each state, where that is known.
  LinearWindows(const TermLibrary& library, std::vector<std::optional<Index>> exact,
                std::vector<PathRecord> records);

  /// Divides every record into windows of so many samples; a rest joins the last one.
  void set_windows(Index samples);
  void set_substeps(Index substeps);
  Index substeps() const { return records_.front().substeps; }

  /// R of the rows [G | y - c], q + 1 columns, initial states eliminated, at coefficients h0
  /// (m x L). Keeps what move() needs.
  Matrix linearise(const Matrix& h0, const std::vector<Coefficient>& columns);
  Index rows() const noexcept { return rows_; }  ///< white rows of the last linearise()

  /// Solves all windows for these values of the columns and makes their solution the path.
  /// @return the largest move of a path at a sample in units of sigma; nothing when a window
  /// had
  ///   no finite solution (its path stays).
  std::optional<double> move(const Vector& values);

  /// Sums of squared weighted residuals of the path, and how many there are, per state.
  Vector misfits() const;
  Vector counts() const;

  /// Gives every state another sigma.
  void rescale(const Vector& factors);

  /// Leaves out samples that are more than `limit` sigma off the path.
  void mask_beyond(double limit);

  const std::vector<PathRecord>& records() const noexcept { return records_; }

 private:
  struct Window {
    std::size_t record = 0;
    Index first = 0, samples = 0;
    Matrix head;  ///< m x (m + q + 1): what determines s
  };

  /// Columns of one equation.
  struct Block {
    Index equation = 0, first = 0;
    std::vector<Index> terms;  ///< rows of theta
    bool contiguous = false;
  };

  /// Weighted deviation of a sample from the path.
  double deviation(const PathRecord& record, Index sample, Index state) const;
  Index dimension() const noexcept { return static_cast<Index>(exact_.size()); }
  void choose_values(const std::vector<Index>& terms);
  void make_blocks();
  void load(const Window& window);
  void take_step(Index local, double length);
  void add_forcing(const Block& block, Index local);
  std::optional<Matrix> fold_windows(Folding folding);
  void window_rows(const Window& window);
  void add_rows(const PathRecord& record, Index sample);
  void eliminate(Window& window, RowFold& fold);
  Vector start_of(const Window& window, const Vector& values) const;
  std::optional<double> move_window(const Window& window, const Vector& values,
                                    const Matrix& coefficients);
  Matrix solve_window(const Window& window, const Vector& start, const Matrix& forcing);

  TermLibrary library_;
  Program program_;  // of the whole library
  std::vector<std::optional<Index>> exact_;
  std::vector<PathRecord> records_;
  std::vector<Window> windows_;
  std::vector<Coefficient> columns_;
  std::vector<Block> blocks_;
  Matrix linearised_at_;          // h0
  bool resolved_by_gram_ = true;  // as long as no Gram has failed
  Index rows_ = 0;

  // Of the loaded window.
  std::optional<LibraryRates> values_;
  Matrix jacobians_;  // m m x nodes
  Matrix path_;       // m x nodes
  Matrix offsets_;    // m x nodes: -J path, 0 for exact equations
  LinearStep step_;
  Matrix columns_now_, columns_next_;  // (m + q + 1) x m: [S G c]'
  Matrix window_rows_;                 // (m + q + 1) x rows
  Index used_ = 0;                     // rows of the window
};

}  // namespace lacuna
