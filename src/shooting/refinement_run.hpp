// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/shooting/refine.hpp"
#include "residual_analysis.hpp"

namespace lacuna {

/// One refinement: windows from short to long, the search for windows where the model is not
/// exact, the last polish.
class RefinementRun {
 public:
  /// @throws DataError, ArgumentError as refine().
  RefinementRun(const ParametrisedModel& model, const Dataset& data,
                const RefineOptions& options, const RunContext& context);

  /// Fits. @return whether windows were found in which the model can be simulated.
  bool run();

  ShootingProblem& problem() noexcept { return problem_; }
  const ShootingFit& fit() const noexcept { return fit_; }
  const FitInfluence& influence() const noexcept { return influence_; }
  const Matrix& guess() const noexcept { return guess_; }  ///< states to start from, N x m
  const Vector& noise() const noexcept { return noise_; }  ///< of the record or as given
  int iterations() const noexcept { return iterations_; }

 private:
  Index dimension() { return problem_.rates().dimension(); }
  void prepare();
  bool begin();
  void choose_scheme(const WindowPlan& plan);
  bool make_finite();
  ErrorGrowth scaled_growth(Matrix transitions);
  void minimise_from(ShootingFit& fit, const Matrix& states, double tolerance);
  void update_sigma(const Vector& taken = {});
  double growth_limit();
  bool lengthen();
  bool acceptable(const ShootingFit& longer) const;
  double cost_per_freedom(const ShootingFit& fit) const;
  double gain_of(const ShootingFit& longer) const;
  bool has_structure();
  double residual_count() const;
  void search();
  void finish();

  const RefineOptions& options_;
  const RunContext& context_;
  ShootingProblem problem_;
  Vector noise_;
  Matrix guess_;
  Vector spread_;  // of each state
  Vector floor_;   // rounding of each measured state
  ErrorGrowth growth_;
  WindowLimits limits_;
  ShootingFit fit_;
  FitInfluence influence_;
  int iterations_ = 0;
};

}  // namespace lacuna
