// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lacuna/diagnosis/gauge.hpp"
#include "lacuna/diagnosis/locate.hpp"

namespace lacuna {

/// The answer in one word.
enum class Verdict {
  NoDiscrepancy,     ///< the nominal model fits to the noise
  CoefficientsOnly,  ///< no structure is missing, coefficients are off
  Explained,         ///< effects named, nothing significant left
  PartlyExplained,   ///< effects named, significant structure left
  UnnamedStructure,  ///< significant structure that no candidate explains
};

/// "no-discrepancy", "coefficients-only", "explained", "partly-explained", "unnamed-structure".
std::string to_string(Verdict verdict);

/// Another effect that might be it.
struct Alternative {
  std::string name;
  std::string term;
  double probability = 0.0;
};

/// A shape parameter with its value.
struct NamedParameter {
  std::string name;
  std::string unit;
  double value = 0.0;
  std::optional<double> deviation = {};  ///< its standard error, where there is one
};

/// An effect that the nominal model lacks.
struct NamedEffect {
  Index equation = 0;
  std::string name;
  std::string description;
  std::string cause;  ///< what usually causes it
  std::string term;
  double coefficient = 0.0;  ///< state unit per time unit and unit of the term
  double deviation = 0.0;    ///< standard error of the coefficient
  std::vector<NamedParameter> parameters;
  double sigma = 0.0;
  double gap_closed = 0.0;    ///< share of the disturbance's variance that goes with it
  double contribution = 0.0;  ///< rms of its rate over that of the state's rate
  double probability = 0.0;
  std::vector<Alternative> alternatives;

  std::array<double, 2> ci95() const {
    return {coefficient - 1.96 * deviation, coefficient + 1.96 * deviation};
  }
};

/// A nominal coefficient and what the records say of it.
struct CoefficientChange {
  Index equation = 0;
  std::string term;
  double nominal = 0.0;
  double estimated = 0.0;
  double deviation = 0.0;
  double sigma = 0.0;

  std::array<double, 2> ci95() const {
    return {estimated - 1.96 * deviation, estimated + 1.96 * deviation};
  }
};

/// What is left over in the end.
struct Remaining {
  bool structure = false;
  double sigma = 0.0;
  std::vector<Index> equations;            ///< with significant structure
  std::vector<EquationStructure> details;  ///< one for each of them
};

/// One round of the search: what was tried and what came of it.
struct Round {
  Index tried = 0;
  std::string best;  ///< "coulomb-friction: sign(w) in dw/dt"; empty when nothing was found
  double sigma = 0.0;
  bool accepted = false;
};

/// What can be said of structure that no effect explains.
struct Unnamed {
  Index equation = 0;
  std::vector<std::string> variables;  ///< of which it is a function, as far as one is found
  double explained = 0.0;  ///< share of the disturbance's variance that goes with the curve
  bool memory = false;     ///< earlier values of the variables tell more than present ones
  bool periodic = false;   ///< a few lines of the spectrum make up most of it
  bool filled = false;     ///< a spline stands in the augmented model as a stop-gap
};

/// What a nominal model lacks.
struct Diagnosis {
  Verdict verdict = Verdict::NoDiscrepancy;
  OdeModel nominal;
  std::vector<Disagreement> disagreement;
  std::vector<NamedEffect> effects;
  std::vector<CoefficientChange> coefficient_changes;
  std::optional<Gap> gap;
  Remaining remaining;
  OdeModel augmented;  ///< nominal model with fitted coefficients and effects
  NoiseModel noise;
  std::vector<Round> rounds;
  std::vector<std::string> notes;
  std::optional<Unnamed> unnamed = {};  ///< with the verdict UnnamedStructure
};

}  // namespace lacuna
