// SPDX-License-Identifier: MIT
// Free functions as columns: what a disturbance may depend on when no effect has a name for it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/diagnose/candidates/explanation.hpp"
#include "lacuna/diagnose/criterion/criterion.hpp"
#include "lacuna/forms/candidate/effect.hpp"
#include "trajectories/smoother/innovation_system.hpp"

namespace lacuna {

/// Terms that together are a free function.
struct FunctionBasis {
  enum class Kind {
    Curve,    ///< cubic spline of one variable, or what comes again with its value
    Surface,  ///< product of cubic splines of two variables
    Memory,   ///< earlier values of a variable
    Varying,  ///< a variable with a coefficient that changes from one stretch of time to the
              ///< next
    Lines,    ///< sines and cosines of a few frequencies
  };
  Kind kind = Kind::Curve;
  std::vector<std::string> variables;
  std::vector<Candidate> members;
  double tried = 1.0;  ///< number of such bases of which this one is the best
};

/// Curves of one variable, with few and with many pieces.
std::vector<FunctionBasis> curves_of(const VariableRange& x, Index equation);

/// Curves, surfaces and varying coefficients of all variables in an equation: functions of what
/// is known at a time.
/// @param fit of the bare model: what its disturbance repeats with is found in it.
std::vector<FunctionBasis> present_functions(const Assimilation& fit, const Scope& scope,
                                             Index equation);

/// Earlier values of all variables, and the lines of the spectrum.
std::vector<FunctionBasis> other_functions(const Scope& scope, Index equation);

/// What a basis explains of the whitened innovations, everything that is fitted refitted.
struct FunctionScore {
  double gain = 0.0;
  std::vector<std::size_t> members;  ///< that are independent of what is fitted and each other
};

/// A basis with what it explains less the penalty for its members.
struct ScoredFunction {
  FunctionBasis basis;
  FunctionScore score;
  double net = 0.0;

  /// The members that were scored, to be fitted.
  std::vector<FittedEffect> members() const;
};

/// Scores bases against a model that was brought onto records.
class FunctionScreening {
 public:
  /// The assimilation must outlive the screening.
  explicit FunctionScreening(const Assimilation& assimilation);

  FunctionScore score(const FunctionBasis& basis) const;

  /// Of the gain of a basis the fraction that comes from that half of the samples from which
  /// less does: about 1/2 of what recurs, 0 or less of what happens once.
  double smaller_half(const FunctionBasis& basis) const;

  /// Of the bases the one that explains most beyond what its members cost by the criterion.
  std::optional<ScoredFunction> best_of(std::vector<FunctionBasis> bases,
                                        const Criterion& criterion) const;

 private:
  /// Members as columns without what is fitted, and their places in the basis.
  struct Columns {
    Matrix values;
    std::vector<std::size_t> places;
  };
  Columns columns_of(const FunctionBasis& basis) const;

  const Assimilation& assimilation_;
  InnovationSystem system_;
  Matrix fitted_;  ///< orthonormal columns of what is fitted
  Vector left_;    ///< innovations without them
};

}  // namespace lacuna
