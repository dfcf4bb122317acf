// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lacuna/core/run_context.hpp"
#include "lacuna/data/noise.hpp"
#include "lacuna/selection/subset_search.hpp"
#include "linear_windows.hpp"

namespace lacuna {

/// What is searched in.
struct SearchTask {
  Dataset data;  ///< as join_across_gaps() has it
  const TermLibrary& library;
  std::vector<StateNoise> noise;  ///< of each state, as estimated from the record
  std::optional<double> price;    ///< of a term
};

/// A structure with its coefficients at one length of windows.
struct WindowFit {
  Matrix coefficients;               ///< m x L
  std::vector<Coefficient> columns;  ///< all candidates
  std::vector<Index> subset;         ///< those in the model
  Matrix triangle;                   ///< of all candidates and the target
  double scale = 1.0;  ///< variance of the rows: 1 where the noise is known and the model right
  double price = 0.0;
  double misfit = 0.0;  ///< sum of squared weighted residuals per degree of freedom
  Index rows = 0;
  bool settled = false;  ///< whether structure and path no longer change
  Vector sigma;          ///< per state
  Vector rms;            ///< of the residuals of each state
  Vector counts;         ///< residuals of each state
  Index samples = 0;     ///< of a window
};

/// The search for structure and coefficients in windows of growing length. A value: copies
/// search on their own.
class WindowSearch {
 public:
  WindowSearch(SearchTask task, const RunContext& context);

  /// Finds a model in the shortest windows. @param coefficients m x L to begin with.
  /// @return false when the records are too short for windows.
  bool begin(const Matrix& coefficients);

  /// Tries windows of twice the length. @return false when they are too long, or fit worse:
  /// the fit is then as it was.
  bool grow();

  /// Whether longer windows were tried and the model fits them worse.
  bool limited() const noexcept { return longest_; }

  /// For a model that is an approximation, which any term improves a little: terms leave as
  /// long as the rms of the residuals stays within 1 + slack of what it is. A price that was
  /// given stands, and all terms with it.
  void simplify(double slack);

  /// The last iterations, after which coefficients no longer change.
  void finish();

  const WindowFit& fit() const noexcept { return fit_; }

 private:
  bool round(WindowFit& fit);
  Vector solve(WindowFit& fit, const SubsetSearch& search) const;
  std::vector<Index> simplest(const SubsetSearch& search, double limit) const;
  double settle(WindowFit& fit, double tolerance, int iterations);
  void converge(WindowFit& fit);
  void summarise(WindowFit& fit) const;
  bool learn_noise(WindowFit& fit);
  bool refine_steps(WindowFit& fit);
  void raise_floor(double factor);
  WindowFit stage(const Matrix& coefficients, Index samples);
  bool acceptable(const WindowFit& before, const WindowFit& after) const;
  Index first_window() const;
  std::vector<Index> present(const Matrix& coefficients) const;

  SearchTask task_;
  const RunContext& context_;
  Vector sigma_, floor_;
  std::vector<Coefficient> candidates_;
  LinearWindows windows_;
  WindowFit fit_;
  bool longest_ = false;  ///< longer windows were tried and do not fit
};

}  // namespace lacuna
