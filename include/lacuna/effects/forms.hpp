// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/forms/candidate/candidate.hpp"
#include "lacuna/forms/candidate/scope.hpp"

// How effects put candidates together.
namespace lacuna {

/// A form from its pattern: expressions in place of the names that `parts` lists; every other
/// name is a shape parameter or a memory state and becomes Scope::free_name() of itself.
/// @code
///   formula(scope, "clip(x,-edge,edge)", {{"x", argument}})
/// @endcode
/// @throws ModelError when the pattern cannot be read.
Expression formula(const Scope& scope, std::string_view pattern,
                   const std::map<std::string, Expression>& parts = {});

/// A candidate without shape parameters.
Candidate plain_candidate(const Expression& form, const Expression& argument);

/// A candidate with one shape parameter.
/// @param starts each of one entry; those outside its range move to the end of it.
Candidate shaped_candidate(const Expression& form, const Expression& argument,
                           const ShapeParameter& shape, std::vector<Vector> starts);

/// Values low, ..., high in equal ratios, as starting points (one entry each) of one shape
/// parameter.
std::vector<Vector> geometric_starts(double low, double high, int count);

/// The given values as starting points (one entry each) of one shape parameter.
std::vector<Vector> starts_at(const std::vector<double>& values);

/// How friction rises towards standstill, exp(-abs(v/speed)^exponent): "speed" (0.5 to 50 % of
/// the largest) and "exponent" (0.5 to 4) as shape parameters, in this order.
std::vector<ShapeParameter> rise_shapes(const Scope& scope, const Expression& v);

/// What takes over the action of a place x through play of half width gap: clip(follower-x,
/// -gap,gap) with a memory state that stands still while it is within the gap and is taken
/// along at its edge, within an eighth of a sample. The coefficient is bounded to the term's.
Candidate play_of(const Scope& scope, Index equation, const Expression& x);

/// Bounds the coefficient of a candidate that takes over a part of a term, or the whole of it.
/// The nominal coefficient may be half the true one.
void bound_to_term(const Scope& scope, Index equation, const Expression& term,
                   Candidate& candidate);

}  // namespace lacuna
