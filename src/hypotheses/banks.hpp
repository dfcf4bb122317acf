// SPDX-License-Identifier: MIT
// Free functions as columns: what a disturbance may depend on when no effect has a name for it.
#pragma once

#include <string>
#include <vector>

#include "lacuna/candidates/candidate.hpp"
#include "lacuna/candidates/scope.hpp"
#include "lacuna/estimation/innovation_system.hpp"

namespace lacuna {

/// Terms that together are a free function.
struct Bank {
  enum class Kind {
    Curve,    ///< cubic spline of one variable
    Surface,  ///< product of cubic splines of two variables
    Memory,   ///< earlier values of a variable
    Varying,  ///< a variable with a coefficient that changes from one stretch of time to the
              ///< next
    Lines,    ///< sines and cosines of a few frequencies
  };
  Kind kind = Kind::Curve;
  std::vector<std::string> variables;
  std::vector<Candidate> members;
};

/// Curves, surfaces and varying coefficients of all variables in an equation: functions of what
/// is known at a time.
std::vector<Bank> present_banks(const Scope& scope, Index equation);

/// Earlier values of all variables, and the lines of the spectrum.
std::vector<Bank> other_banks(const Scope& scope, Index equation);

/// What a bank explains of the whitened innovations, everything that is fitted refitted.
struct BankScore {
  double gain = 0.0;
  std::vector<std::size_t> members;  ///< that are independent of what is fitted and each other
};

/// Scores banks against a model that was brought onto records.
class BankScreening {
 public:
  /// The assimilation must outlive the screening.
  explicit BankScreening(const Assimilation& assimilation);

  BankScore score(const Bank& bank) const;
  double log_samples() const;

 private:
  const Assimilation& assimilation_;
  InnovationSystem system_;
  Matrix fitted_;  ///< orthonormal columns of what is fitted
  Vector left_;    ///< innovations without them
};

}  // namespace lacuna
