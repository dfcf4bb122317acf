// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/effects/effect_family.hpp"

// What the sources of effects share: looking at the nominal model, putting candidates together.
namespace lacuna {

/// Whether an equation has a term, in whatever way it is written.
bool has_term(const Scope& scope, Index equation, const std::string& term);

/// Coefficient of an argument in an equation: of a variable, of a term as it is, or of a
/// difference "a-b" (that of a); 0 when it is not there.
double slope(const OdeModel& model, Index equation, const std::string& argument);

/// Whether the equation is that of a velocity: dq/dt = v holds exactly for some q.
bool is_velocity(const Scope& scope, Index equation);

/// Whether a state belongs to a part that the nominal model keeps apart from the equation's own
/// state: no path of terms leads from one to the other, in either direction.
bool in_other_part(const Scope& scope, Index equation, const std::string& state);

/// Names of states, then of inputs.
std::vector<std::string> variable_names(const Scope& scope);

/// Differences "a-b" of variables that the equation has as a term, or linearly with opposite
/// coefficients (to 1 %; to a factor of 3 where both have the same unit): a spring, a resistor
/// between two places. Its own state comes first.
std::vector<std::string> differences(const Scope& scope, Index equation);

/// Speeds whose friction or drag an equation may feel: that of its own state, of the slip "v-w"
/// of its state against another and, where bodies move together (the state is a velocity), the
/// velocities of the others.
std::vector<std::string> felt_speeds(const Scope& scope, Index equation);

/// Whether a speed is that of the equation's own state or of its slip "v-w".
bool is_own_speed(const Scope& scope, Index equation, const std::string& speed);

/// What acts linearly in an equation: variables, then differences().
std::vector<std::string> linear_arguments(const Scope& scope, Index equation);

/// Whether an argument is a distance between two places: a difference "a-b", or a state whose
/// rate is such a difference and nothing else (the twist of a shaft).
bool is_transmission(const Scope& scope, const std::string& argument);

/// Terms of an equation that are not a number and not a variable alone.
std::vector<std::string> nonlinear_terms(const Scope& scope, Index equation);

/// A factor of a product that varies, and what is left of the product without it.
struct Factor {
  std::string factor, rest;
};

/// The factors of a term: of x*z x and z, of x^3 x beside x^2; none where it is no product of
/// several that vary.
std::vector<Factor> factors_of(const Scope& scope, const std::string& term);

/// The range of a variable or of a formula.
VariableRange range_of(const Scope& scope, const std::string& argument);

/// All terms of an equation with their nominal coefficients as one formula.
std::string right_hand_side(const Scope& scope, Index equation);

/// Values low, ..., high in equal ratios, as starting points of one shape parameter.
std::vector<Vector> geometric_starts(double low, double high, int count);

/// The given values as starting points of one shape parameter.
std::vector<Vector> starts_at(const std::vector<double>& values);

/// The quantiles of a variable's absolute value.
double magnitude_quantile(const Scope& scope, const std::string& argument, double level);

/// A candidate without shape parameters.
Candidate plain_candidate(const std::string& form, const std::string& argument,
                          const std::string& description);

/// A candidate with one shape parameter.
Candidate shaped_candidate(const std::string& form, const std::string& argument,
                           const std::string& description, const ShapeParameter& shape,
                           std::vector<Vector> starts);

/// What a place moves through play of half width `$gap`: it stands still while it is within the
/// gap and is taken along at its edge, within an eighth of a sample. Memory state `$follower`.
MemoryState follower(const Scope& scope, const std::string& place);

/// How far the follower is ahead of the place: within the play, whose edge takes it along at
/// once.
std::string follower_ahead_of(const std::string& place);

/// Bounds the coefficient of a candidate that takes over a part of a term, or the whole of it.
/// The nominal coefficient may be half the true one.
void bound_to_term(const Scope& scope, Index equation, const std::string& term,
                   Candidate& candidate);

/// Whether the coefficient is a part of that of the argument as it is fitted, or the whole.
bool is_part_of_term(const Candidate& candidate, const FittedCandidate& fitted);

/// Whether two slopes are equal but for their uncertainty: to a fifth of the larger one or
/// three standard errors. What is left of a dead zone's slope by that is no dead zone.
bool slopes_agree(double a, double b, double deviation);

/// Whether a bend at +-edge of one of felt_speeds() lies so near to standstill that it is as
/// good as a jump: dry friction, by whatever formula.
bool bends_at_standstill(const Scope& scope, const Candidate& candidate, double edge);

/// Whether the effect takes away from the state in whose equation it stands; for effects that
/// only ever oppose (friction, leakage), as EffectFamily::plausible. What the speed of another
/// body does may have either sign.
bool opposes(const Scope& scope, const Candidate& candidate, const FittedCandidate& fitted);

}  // namespace lacuna
