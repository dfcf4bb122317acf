// SPDX-License-Identifier: MIT
// What effects are written with: terms of a model, forms, patterns, families.
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/forms/candidate/effect.hpp"

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
/// dT/dt = (q*Te - q*T)/h, a volume or an inertia that changes. Nothing in equations of one
/// term.
std::optional<Expression> common_factor(const Scope& scope, Index equation);

/// All terms of an equation with their nominal coefficients as one formula.
Expression right_hand_side(const Scope& scope, Index equation);

/// The quantiles of an expression's absolute value.
double magnitude_quantile(const Scope& scope, const Expression& argument, double level);

/// Least edge of two bends about 0, as a fraction of the largest value: what is narrower is a
/// jump in any record, and searched as one.
inline constexpr double kNarrowestBend = 2e-3;

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

/// An effect without options, written down as a value in one source file:
/// @code
///   const EffectFamily kQuadraticDrag{
///       {"quadratic-drag", "Drag of the square of the speed", ""}, "fluids", forms, reading};
///   registry.add<FamilyEffect<kQuadraticDrag>>();
/// @endcode
struct EffectFamily {
  StageInfo info;
  std::string_view typical_cause;  ///< Effect::typical_cause()
  /// Effect::candidates(): the forms that it wants searched.
  std::vector<Candidate> (*forms)(const Scope& scope, Index equation);
  /// Effect::reading(): its row of the name table; null where what it proposes is always it.
  std::optional<Reading> (*reading)(const FittedForm& fitted) = nullptr;
  Place place = Place::Rate;  ///< only what stands there is this effect
};

/// Options of a family: none.
template <const EffectFamily& Family>
struct FamilyOptions {
  static constexpr const StageInfo& kInfo = Family.info;
  void describe(OptionVisitor&) {}
};

/// The effect of a family.
template <const EffectFamily& Family>
class FamilyEffect final : public Configured<Effect, FamilyOptions<Family>> {
 public:
  using Configured<Effect, FamilyOptions<Family>>::Configured;

 private:
  std::string_view do_typical_cause() const override { return Family.typical_cause; }

  std::vector<Candidate> do_candidates(const Scope& scope, Index equation) const override {
    return Family.forms(scope, equation);
  }

  std::optional<Reading> do_reading(const FittedForm& fitted) const override {
    if (fitted.candidate.place != Family.place) return std::nullopt;
    return Family.reading != nullptr ? Family.reading(fitted) : Effect::do_reading(fitted);
  }
};

/// The named effects of lacuna, in the order in which they are listed and tried.
std::vector<Stage<Effect>> standard_effects();

}  // namespace lacuna
