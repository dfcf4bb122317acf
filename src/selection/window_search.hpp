// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lacuna/core/run_context.hpp"
#include "lacuna/data/noise.hpp"
#include "lacuna/selection/subset_search.hpp"
#include "linear_windows.hpp"

namespace lacuna {

/// What a search starts from.
struct SearchTask {
  const Dataset& data;
  const TermLibrary& library;
  Matrix coefficients;          ///< m x L to begin with
  std::optional<double> price;  ///< of a term
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

/// The search for structure and coefficients in windows of growing length.
class WindowSearch {
 public:
  WindowSearch(const SearchTask& task, const RunContext& context);

  /// Nothing when the records are too short for windows.
  std::optional<WindowFit> run();

  /// The noise of the record, as estimated before any fit.
  const std::vector<StateNoise>& noise() const noexcept { return noise_; }

 private:
  bool round(WindowFit& fit);
  double settle(WindowFit& fit, double tolerance, int iterations);
  void converge(WindowFit& fit);
  void summarise(WindowFit& fit) const;
  void polish(WindowFit& fit);
  bool learn_noise(WindowFit& fit);
  bool refine_steps(WindowFit& fit);
  WindowFit stage(const Matrix& coefficients, Index samples);
  bool acceptable(const WindowFit& before, const WindowFit& after) const;
  Index first_window() const;
  std::vector<Index> present(const Matrix& coefficients) const;

  SearchTask task_;
  const RunContext& context_;
  Dataset data_;
  std::vector<StateNoise> noise_;
  Vector sigma_, floor_;
  std::vector<Coefficient> candidates_;
  std::unique_ptr<LinearWindows> windows_;
};

}  // namespace lacuna
