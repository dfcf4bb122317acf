// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/forms/candidate/scope.hpp"

// What effects look at in the nominal model: terms, differences, speeds, factors.
namespace lacuna {

/// Whether an equation has a term, in whatever way it is written.
bool has_term(const Scope& scope, Index equation, const Expression& term);

/// Coefficient of an argument in an equation: of a variable, of a term as it is, or of a
/// difference a-b (that of a); 0 when it is not there.
double slope(const OdeModel& model, Index equation, const Expression& argument);

/// Whether an expression is a variable alone.
bool is_variable(const Expression& expression);

/// Whether an expression is the difference a-b of two variables.
bool is_difference(const Expression& expression);

/// The state of an equation as an expression.
Expression own_state(const Scope& scope, Index equation);

/// Whether an expression is the state whose rate of change the equation's state is by an
/// identity: the position in the equation of its velocity.
bool is_position(const Scope& scope, Index equation, const Expression& expression);

/// Whether the equation is that of a velocity: dq/dt = v holds exactly for some q.
bool is_velocity(const Scope& scope, Index equation);

/// Whether an expression is an input.
bool is_input(const Scope& scope, const Expression& expression);

/// Whether a state belongs to a part that the nominal model keeps apart from the equation's own
/// state: no path of terms leads from one to the other, in either direction.
bool in_other_part(const Scope& scope, Index equation, const Expression& state);

/// A mean period of the fastest state, in time units; at most the length of the records.
double shortest_period(const Scope& scope);

/// Whether records are long enough to distinguish what changes with time from what moves in
/// them: kFewestPeriods of the fastest state.
bool determines_time(const Scope& scope);

/// States, then inputs.
std::vector<Expression> all_variables(const Scope& scope);

/// Differences a-b of variables that the equation has as a term, or linearly with coefficients
/// of opposite sign: a spring, a resistor between two places. Its own state comes first.
std::vector<Expression> differences(const Scope& scope, Index equation);

/// Speeds whose friction or drag an equation may feel: that of its own state, of the slip v-w
/// of its state against another and, where bodies move together (the state is a velocity), the
/// velocities of the others.
std::vector<Expression> felt_speeds(const Scope& scope, Index equation);

/// Whether an expression is among felt_speeds().
bool is_felt_speed(const Scope& scope, Index equation, const Expression& speed);

/// Whether a speed is that of the equation's own state or of its slip v-w.
bool is_own_speed(const Scope& scope, Index equation, const Expression& speed);

/// What acts linearly in an equation: variables, then differences().
std::vector<Expression> linear_arguments(const Scope& scope, Index equation);

/// Whether an argument is a distance between two places: a difference a-b, or a state whose
/// rate is such a difference and nothing else (the twist of a shaft).
bool is_transmission(const Scope& scope, const Expression& argument);

/// Terms of an equation that are not a number and not a variable alone.
std::vector<Expression> nonlinear_terms(const Scope& scope, Index equation);

/// A factor of a product that varies, and the rest of the product without it.
struct TermFactor {
  Expression factor, rest;
};

/// The factors of a term: of x*z x and z, of x^3 x beside x^2; none where it is no product of
/// several that vary.
std::vector<TermFactor> factors_of(const Expression& term);

/// What all terms of an equation are multiplied with beside powers of variables: 1/h of
/// dT/dt = (q*Te - q*T)/h, a volume or an inertia that changes. Nothing in equations of one term.
std::optional<Expression> common_factor(const Scope& scope, Index equation);

/// All terms of an equation with their nominal coefficients as one formula.
Expression right_hand_side(const Scope& scope, Index equation);

/// The quantiles of an expression's absolute value.
double magnitude_quantile(const Scope& scope, const Expression& argument, double level);

/// Least edge of two bends about 0, as a fraction of the largest value: what is narrower is a
/// jump in any record, and searched as one.
inline constexpr double kNarrowestBend = 2e-3;

}  // namespace lacuna
