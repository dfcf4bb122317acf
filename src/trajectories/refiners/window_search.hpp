// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/regression/stages/refiner.hpp"
#include "linearisation.hpp"
#include "noise_growth.hpp"
#include "trajectories/refiners/trajectory_selection.hpp"

namespace lacuna {

/// What is searched in.
struct SearchTask {
  Dataset data;  ///< as join_across_gaps() has it
  CandidateEquations equations;
  std::vector<Coefficient> candidates;  ///< in all equations that are not exact
  std::vector<StateNoise> noise;        ///< of each state, as estimated from the record
  std::vector<StateNoise> seen;         ///< the same, whether it grows with the signal or not
  SampleNoise sample_noise;             ///< where it grows with the signal
  std::optional<double> penalty;        ///< of a term
  std::vector<CoefficientConstraint> constraints = {};
};

/// Whether two models, m x L each, have the same terms.
bool have_same_terms(const Matrix& coefficients, const Matrix& others);

/// Samples of the first windows: half the support of a test function, which is the time in
/// which a signal does what can be distinguished from its noise; at least so many that initial
/// states leave half of the samples.
Index first_window(const Dataset& data, int threads, const std::optional<Vector>& noise = {});

/// What equations may have and have to satisfy.
struct StructureTask {
  const TermLibrary& library;
  std::vector<TermSet> allowed = {};  ///< terms of each equation; empty: all
  std::vector<CoefficientConstraint> constraints = {};
};

SearchTask search_task(Dataset data, const StructureTask& structure,
                       std::vector<StateNoise> noise, const TrajectorySelectionOptions& options,
                       int threads = 1);

/// A structure with its coefficients at one length of windows.
struct WindowFit {
  Matrix coefficients;               ///< m x L
  std::vector<Coefficient> columns;  ///< all candidates
  std::vector<Index> subset;         ///< those in the model
  Matrix triangle;                   ///< of all candidates and the target
  double scale = 1.0;  ///< variance of the rows: 1 where the noise is known and the model right
  double penalty = 0.0;
  double misfit = 0.0;   ///< sum of squared weighted residuals per degree of freedom
  Index rows = 0;        ///< 0: the records are too short for windows
  bool settled = false;  ///< whether structure and path no longer change
  Vector sigma;          ///< per state
  Vector rms;            ///< of the residuals of each state
  Vector counts;         ///< residuals of each state
  Index samples = 0;     ///< of a window
  GrownRounding rounding;   ///< in the windows
  bool kept_terms = false;  ///< those that the fit began with
};

/// A test whether steps of integration are short enough.
struct StepTest {
  double moved = std::numeric_limits<double>::infinity();  ///< the path, by half the steps; sigma
  Index samples = 0;                                       ///< of the windows; 0: no test
};

/// What rounding becomes in windows of some length.
struct RoundingInWindows {
  Index samples = 0;  ///< 0: not known
  double log_mean = 0.0;
};

/// The search for structure and coefficients in windows of growing length, as far as it has
/// come. Its task must outlive it.
struct WindowSearch {
  WindowRates rates;  ///< of the task's equations
  WindowedPath path;
  Vector sigma;  ///< of the noise of each state, as far as it is known
  Vector floor;  ///< least sigma where the noise cannot be distinguished from the signal
  Folding folding = Folding::Gram;  ///< as long as no Gram has failed
  Index most = kMostSamples;        ///< samples of the windows that are fitted, in all
  Index shortest = 0;               ///< samples of the first windows
  WindowFit fit = {};
  bool limited = false;  ///< longer windows were tried and the model fits them worse
  StepTest steps = {};   ///< the last one
  RoundingInWindows shorter = {};  ///< in the windows before
  bool leaps = true;     ///< windows four times as long have done wherever they were tried
  std::vector<CoefficientConstraint> constraints = {};  ///< those of the task
};

/// A search that has not begun: with the smoothed samples as path.
WindowSearch prepared_search(const SearchTask& task, const RunContext& context = {});

/// Finds a model in the shortest windows; none (fit.rows = 0) when the records are too short.
/// @param coefficients m x L to begin with.
WindowSearch begun(const SearchTask& task, WindowSearch prepared, const Matrix& coefficients,
                   const RunContext& context);

/// Tries windows of four times the length where the terms have stayed so far, else of twice the
/// length. @return false when they are too long, or fit worse: the fit is then as it was.
bool grow(const SearchTask& task, WindowSearch& search, const RunContext& context);

/// Fits in as many windows as there are what was chosen in as many as the candidates ask for:
/// weak terms show in these. The fit stays as it was where that is worse.
void take_all_windows(const SearchTask& task, WindowSearch& search, const RunContext& context);

/// Makes the steps finer where windows that have grown since the last test ask for it.
void check_steps(const SearchTask& task, WindowSearch& search, const RunContext& context);

/// The last iterations, after which coefficients no longer change.
void finish(WindowSearch& search, const RunContext& context);

/// For a model that is an approximation, which any term improves a little: terms leave as long
/// as the rms of the residuals stays within 1 + slack of what it is. A penalty that was given
/// stands, and all terms with it.
void simplify(const SearchTask& task, WindowSearch& search, double slack,
              const RunContext& context);

}  // namespace lacuna
