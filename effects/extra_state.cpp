// SPDX-License-Identifier: MIT
#include "effects/families.hpp"
#include "lacuna/effects/effects.hpp"

namespace lacuna {
namespace {

// From a third of a step, where a store is full at once, to a quarter of the record, in which
// it hardly fills.
constexpr double kLeastSteps = 1.0 / 3.0, kMostOfRecord = 0.25;

// A decision: the least fraction of what fills a store that the state or the other variable has
// where both have a part.
constexpr double kLeastFraction = 0.05;

ShapeParameter time_constant(const Scope& scope) {
  return {"tau", scope.model.time_unit(), kLeastSteps * scope.step,
          kMostOfRecord * scope.duration, true};
}

// d(store)/dt = (source - store)/tau, full where the record begins.
MemoryState store_of(const Scope& scope, const Expression& source) {
  return {"store", formula(scope, "(source-store)/tau", {{"source", source}}), source};
}

std::vector<double> time_constants(const ShapeParameter& tau) {
  constexpr double kRatio = 4.0;  // a fact of the search: it goes on from there
  std::vector<double> values;
  for (double value = tau.low; value < tau.high; value *= kRatio) values.push_back(value);
  return values;
}

// A store that exchanges with the state alone: c*(store-x).
Candidate store_beside(const Scope& scope, const Expression& x) {
  const ShapeParameter tau = time_constant(scope);
  Candidate candidate = shaped_candidate(formula(scope, "store-x", {{"x", x}}), x, tau,
                                         starts_at(time_constants(tau)));
  candidate.memory = {store_of(scope, x)};
  candidate.least = 0.0;
  return candidate;
}

// A store between the state and another variable that acts on it: a wall.
Candidate store_between(const Scope& scope, const Expression& x, const Expression& y) {
  const ShapeParameter tau = time_constant(scope);
  Candidate candidate = plain_candidate(formula(scope, "store-x", {{"x", x}}), x);
  candidate.shapes = {tau, {"fraction", "", kLeastFraction, 1.0 - kLeastFraction, false}};
  for (const double value : time_constants(tau))
    candidate.starts.push_back(Vector{{value, 0.3}});
  candidate.memory = {
      store_of(scope, formula(scope, "fraction*y+(1-fraction)*x", {{"x", x}, {"y", y}}))};
  candidate.least = 0.0;
  return candidate;
}

// Whether a variable has levels between its ends, more than a tenth of the time: the curve
// through two levels is a straight line.
bool has_levels_between(const Scope& scope, const Expression& u) {
  constexpr double kTenth = 0.1;
  const VariableRange range = scope.range_of(u);
  const double margin = kTenth * (range.high - range.low);
  const auto between = (range.quantiles.array() > range.low + margin) &&
                       (range.quantiles.array() < range.high - margin);
  return static_cast<double>(between.count()) >
         kTenth * static_cast<double>(range.quantiles.size());
}

// What an input does through one more pole, where it does not act by its value: the thrust of a
// propeller, the heat of a resistor.
Candidate curve_behind(const Scope& scope, const Expression& u) {
  const ShapeParameter tau = time_constant(scope);
  const bool signs = scope.range_of(u).changes_sign();
  const Expression curve = formula(scope, signs ? "u*abs(u)" : "u^2", {{"u", u}});
  Candidate candidate =
      shaped_candidate(formula(scope, "store", {}), curve, tau, starts_at(time_constants(tau)));
  candidate.memory = {store_of(scope, curve)};
  return candidate;
}

// From two periods in the record to five samples a period, in steps that a slightly damped mode
// is found from.
std::vector<double> frequencies(const ShapeParameter& frequency) {
  constexpr double kRatio = 1.5;  // a fact of the search: it goes on from there
  std::vector<double> values;
  for (double value = frequency.low; value < frequency.high; value *= kRatio)
    values.push_back(value);
  return values;
}

// A mass that hangs on the place x, whose velocity v the state is, by a spring and a damper: x is
// pulled with c*pull, pull = store-x + 2 damping/w (swing-v), and the mass with as much the other
// way: d(store)/dt = swing, d(swing)/dt = -w^2 pull.
Candidate mass_on(const Scope& scope, const Expression& x, const Expression& v) {
  // Decisions: in less than two periods a mode is a trend; with fewer samples a period its path
  // between them is guessed.
  constexpr double kPeriodsInRecord = 2.0, kSamplesInPeriod = 5.0;
  // Facts: below this a mode is hardly damped within a record of some hundred periods; above 1 it
  // is two stores.
  constexpr double kLeastDamping = 1e-3, kMostDamping = 1.0;
  const std::string per_time =
      scope.model.time_unit().empty() ? "" : "1/" + scope.model.time_unit();
  const Expression pull =
      formula(scope, "store-x+damping/(pi*frequency)*(swing-v)", {{"x", x}, {"v", v}});
  Candidate candidate = plain_candidate(pull, x);
  candidate.shapes = {
      {"frequency", per_time, kPeriodsInRecord / scope.duration,
       1.0 / (kSamplesInPeriod * scope.step), true},
      {"damping", "", kLeastDamping, kMostDamping, true}};
  for (const double value : frequencies(candidate.shapes[0]))
    candidate.starts.push_back(Vector{{value, 0.1}});
  candidate.memory = {
      {"store", formula(scope, "swing"), x},
      {"swing", formula(scope, "-(2*pi*frequency)^2*pull", {{"pull", pull}}), v}};
  candidate.least = 0.0;
  return candidate;
}

bool is_mass(const Candidate& candidate) {
  return candidate.place == Place::Rate && candidate.memory.size() == 2 &&
         candidate.shapes.size() == 2 && contains(candidate.memory[1].rate, Operation::Power);
}

std::vector<Candidate> extra_state_forms(const Scope& scope, Index equation) {
  std::vector<Candidate> result;
  if (scope.is_identity(equation)) return result;
  const Expression x = own_state(scope, equation);
  result.push_back(store_beside(scope, x));
  if (const auto place = scope.integral_of(equation))
    result.push_back(mass_on(scope, own_state(scope, *place), x));
  for (const Expression& y : all_variables(scope)) {
    if (y == x || !has_term(scope, equation, y)) continue;
    result.push_back(store_between(scope, x, y));
    if (is_input(scope, y) && has_levels_between(scope, y))
      result.push_back(curve_behind(scope, y));
  }
  return result;
}

// What a store gives back it has taken before: with the other sign it would not be passive.
std::optional<Reading> extra_state_reading(const FittedForm& fitted) {
  const Candidate& candidate = fitted.candidate;
  const Expression x = own_state(fitted.scope, candidate.equation);
  if (is_mass(candidate) && fitted.coefficient > 0.0)
    return Reading{"mass on a spring behind " + candidate.argument.to_string() +
                   " that is not measured"};
  if (has_form(candidate, "m") && candidate.shapes.size() == 1 && !candidate.is_driven())
    return Reading{candidate.argument.to_string() +
                   " acts through a state that is not measured"};
  if (!has_form(candidate, "m-x") || !(candidate.argument == x) || !(fitted.coefficient > 0.0))
    return std::nullopt;
  const bool between = candidate.shapes.size() == 2;
  return Reading{"second store beside " + x.to_string() +
                 (between ? ", filled from its surroundings too" : "")};
}

}  // namespace

const EffectFamily kExtraState{
    {"extra-state",
     "A state that nobody measured: a second store, a mass on a spring, a lag behind a curve",
     ""},
    "a second thermal mass, a wall, a second RC pair, a flexible part, an absorber, a rotor that "
    "has to speed up",
    extra_state_forms,
    extra_state_reading};

}  // namespace lacuna
