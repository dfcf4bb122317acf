// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

#include "lacuna/forms/candidate/reading.hpp"

// How rows of the name table recognise fitted forms, whoever proposed them.
namespace lacuna {

/// Whether a candidate's form has a pattern, in which `x` is its argument, `a`, `b`, `c` are
/// its shape parameters in order and `m` is its memory state: "clip(x,-a,a)", "m-x". The
/// candidate has no more shape parameters and memory states than the pattern names.
/// @throws ModelError when the pattern cannot be read.
bool has_form(const Candidate& candidate, std::string_view pattern);

/// Whether a fit has taken a shape parameter to the upper end of its range, where it stops.
bool is_at_upper_end(const ShapeParameter& shape, double value);

/// The range of the candidate's argument.
VariableRange range_of_argument(const FittedForm& fitted);

/// Slope of the argument in the nominal equation as it is fitted with the form; 0 where it is
/// not there.
double nominal_slope(const FittedForm& fitted);

/// A characteristic that changes its slope at +-edge, nominal term and form together.
struct Bend {
  double inside = 0.0;     ///< slope about 0
  double outside = 0.0;    ///< slope beyond the edges
  double edge = 0.0;       ///< > 0, unit of the argument
  double deviation = 0.0;  ///< standard error of the change of slope
  bool sharp = true;       ///< at the edge itself, not gradually
};

/// The characteristic with two bends of a form clip(x,-a,a) or x-clip(x,-a,a), tanh(x/a) or
/// x-a*tanh(x/a); nothing for other forms.
std::optional<Bend> bend_of(const FittedForm& fitted);

/// Whether nothing is left of the slope inside: the rest is less than its uncertainty
/// (NamingOptions::equal_slopes, standard_errors).
bool is_flat_inside(const Bend& bend, const NamingOptions& options);

/// Whether nothing is left of the slope outside, as is_flat_inside().
bool is_flat_outside(const Bend& bend, const NamingOptions& options);

/// Whether the coefficient is a part of that of the argument as it is fitted, or the whole.
bool is_part_of_term(const FittedForm& fitted);

/// The same for a term of the equation.
bool is_part_of(const FittedForm& fitted, const Expression& term);

/// Whether the coefficient is that of the argument as it is fitted.
bool is_whole_term(const FittedForm& fitted);

/// Whether the effect takes away from the state in whose equation it stands, for effects of a
/// speed that only ever oppose. What the speed of another body does may have either sign.
bool opposes(const FittedForm& fitted);

}  // namespace lacuna
