// SPDX-License-Identifier: MIT
// Plug point that refines a model on its records.
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/model/equations/term.hpp"

namespace lacuna {

/// One summand of a constraint: factor times the coefficient of a term in an equation.
struct ConstrainedCoefficient {
  Index equation = 0;
  Index term = 0;  ///< number in the library
  double factor = 1.0;
};

/// What coefficients of a model have to satisfy: sum_i factor_i h_i = value. Coefficients of
/// terms that are not in the model are 0.
struct CoefficientConstraint {
  std::vector<ConstrainedCoefficient> summands;
  double value = 0.0;
};

/// Places of coefficients, (equation, term).
using CoefficientPlaces = std::vector<std::pair<Index, Index>>;

/// The constraints on some coefficients, the others being 0: A h = b.
struct ConstraintMatrix {
  Matrix a;  ///< constraints x coefficients
  Vector b;
};

/// One row for each constraint that names one of the places, one column for each place.
ConstraintMatrix constraint_matrix(const std::vector<CoefficientConstraint>& constraints,
                                   const CoefficientPlaces& places);

/// Every coefficient that a constraint names, each once, in order.
CoefficientPlaces constrained_coefficients(
    const std::vector<CoefficientConstraint>& constraints);

/// Places with those that constraints ask for: all of a constraint of which one is there alone
/// (which would have to be 0), or none though the value is not 0; in order.
CoefficientPlaces closure(const std::vector<CoefficientConstraint>& constraints,
                          CoefficientPlaces places);

/// One step on the path of models of an equation, all other equations being as found.
struct PathStep {
  Index equation = 0;
  std::string term;       ///< the term that leaves or enters
  Index terms = 0;        ///< terms of the equation with it
  bool in_model = false;  ///< whether the model found has it
  double gain = 0.0;      ///< by how much it lowers chi squared (sum of (residual / noise)^2)
  double penalty = 0.0;   ///< the gain from which on a term is worth having
};

/// A term that was worth too little to be kept, however significant.
struct NegligibleTerm {
  Index equation = 0;
  std::string term;
  double effect = 0.0;     ///< fraction of the equation's rate that it was worth
  double threshold = 0.0;  ///< what it was compared with
};

/// What a refiner is given.
struct RefinerTask {
  const Dataset& data;
  const TermLibrary& library;  ///< candidate terms of every equation
  const OdeModel& start;       ///< the model that the stages before found
  /// Fraction of its derivatives that `start` leaves unexplained, rms, in the worst equation.
  double unexplained = 1.0;
  /// Terms that each equation may have, by their numbers; empty: all of them.
  std::vector<TermSet> allowed = {};
  std::vector<CoefficientConstraint> constraints = {};  ///< which `start` satisfies
  KnownNoise noise = {};
};

/// What a refiner makes of a model.
struct RefinedModel {
  OdeModel model;      ///< with standard errors and intervals where they are known
  bool usable = true;  ///< false: `model` is the start, `message` says why
  std::string message = {};
  Vector noise = {};  ///< of each state, as the residuals have it; 0: not measured
  std::vector<double> misfit = {};  ///< rms of the residuals of each state over its noise
  std::vector<std::optional<bool>> fits_to_noise = {};  ///< per equation
  std::vector<PathStep> path = {};
  std::vector<NegligibleTerm> negligible = {};  ///< in the order in which they left
  std::vector<std::string> notes = {};          ///< what a user should know: terms in dispute
};

/// Plug point: fits a model to the trajectories themselves, and tests its structure again.
class Refiner : public StageInterface {
 public:
  static constexpr std::string_view kKind = "refiner";

  /// @throws ArgumentError when the start is not a model of the states of the dataset, or the
  ///   known noise not one per state.
  RefinedModel refine(const RefinerTask& task, const RunContext& context = {}) const;

 private:
  virtual RefinedModel do_refine(const RefinerTask& task, const RunContext& context) const = 0;
};

}  // namespace lacuna
