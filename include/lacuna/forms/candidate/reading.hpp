// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/forms/candidate/candidate.hpp"
#include "lacuna/forms/candidate/scope.hpp"

namespace lacuna {

/// What decides between the names of one form.
struct NamingOptions {
  double equal_slopes = 0.2;  ///< see describe()
  double standard_errors = 3.0;
  double standstill = 0.1;
  double rim = 0.6;

  void describe(OptionVisitor& v) {
    v.field({"equal_slopes", "",
             "Slopes that differ by no more than this fraction of the larger one are equal: "
             "the rest of a slope inside a dead zone or beyond a limit.",
             0.0, 1.0},
            equal_slopes);
    v.field(
        {"standard_errors", "",
         "Slopes that differ by no more than so many standard errors are equal.", 0.0, 10.0},
        standard_errors);
    v.field({"standstill", "",
             "A bend below this fraction of the largest speed is as good as a jump.", 0.0, 1.0},
            standstill);
    v.field({"rim", "",
             "Quantile of a variable from which on (and from 1 less it down) what acts on one "
             "side of an edge is a stop; between the two it is a bend.",
             0.5, 1.0},
            rim);
  }
};

/// A candidate with what the data show of it, and where it stands.
struct FittedForm {
  const Candidate& candidate;
  const Vector& shapes;      ///< one value per shape parameter
  double coefficient = 0.0;  ///< of the form
  double deviation = 0.0;    ///< its standard error
  const OdeModel& nominal;   ///< with its coefficients fitted together with the candidate
  const Scope& scope;
  const NamingOptions& options;
};

/// How a name comes to a form; the first goes before the others.
enum class Precedence {
  Contextual,  ///< the place says it: the cube of a position in the equation of its velocity
  Plain,       ///< the default word for the form
  Special,     ///< the same numbers in a reading as good as the plain one
};

/// What a row of the name table makes of a fitted form to which it applies.
struct Reading {
  std::string sentence;  ///< for people: "dry friction opposing w"
  Precedence precedence = Precedence::Plain;
  /// What the effect calls the shape parameters, in order; as the candidate does when empty.
  std::vector<std::string> parameters = {};
};

}  // namespace lacuna
