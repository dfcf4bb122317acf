// SPDX-License-Identifier: MIT
// What an effect is called does not depend on units, scales or the order of the states.
#include <algorithm>
#include <map>
#include <numeric>

#include "contract/contract.hpp"
#include "contract/effect_systems.hpp"

namespace lacuna::contract {
namespace {

/// A system with its states in the opposite order.
Scope reversed(const EffectSystem& system) {
  const OdeModel& model = system.model;
  std::vector<Quantity> states(model.states().rbegin(), model.states().rend());
  std::vector<Equation> equations(model.equations().rbegin(), model.equations().rend());
  Variables names = model.variables();
  std::reverse(names.states.begin(), names.states.end());
  for (Equation& equation : equations)
    for (WeightedTerm& summand : equation)
      summand.term = Term(summand.term.expression(), names);
  const OdeModel turned(states, model.inputs(), equations, model.time_unit());
  Scope scope = system.scope();
  const Index m = model.dimension();
  std::reverse(scope.variables.begin(), scope.variables.begin() + m);
  scope.samples.leftCols(m) = scope.samples.leftCols(m).rowwise().reverse().eval();
  for (SpectralLine& line : scope.lines) line.equation = m - 1 - line.equation;
  for (ModulationLine& one : scope.modulations) one.line.equation = m - 1 - one.line.equation;
  for (Ripple& ripple : scope.ripples)
    ripple = {m - 1 - ripple.equation, m - 1 - ripple.position, ripple.period};
  scope.model = turned;
  return scope;
}

/// f(x/scale) for a term f(x).
Term rescaled(const Term& term, const Variables& names, double scale) {
  std::map<std::string, Expression> parts;
  for (const std::string& name : term.expression().variables())
    parts.emplace(name, Expression::variable(name) / Expression::number(scale));
  return Term(substitute(term.expression(), parts), names);
}

/// A system in which every variable x is measured as scale * x and time as pace * t.
Scope scaled(const EffectSystem& system, double scale, double pace) {
  Scope scope = system.scope();
  for (VariableRange& range : scope.variables) {
    for (double* value : {&range.low, &range.high, &range.mean, &range.deviation, &range.noise})
      *value *= scale;
    range.quantiles *= scale;
    range.timescale *= pace;
    range.period *= pace;
  }
  const Index last = scope.samples.cols() - 1;
  scope.samples.leftCols(last) *= scale;
  scope.samples.col(last) *= pace;
  for (double* value : {&scope.step, &scope.start, &scope.duration}) *value *= pace;
  for (SpectralLine& line : scope.lines) line.frequency /= pace;
  for (ModulationLine& one : scope.modulations) one.line.frequency /= pace;
  for (Ripple& ripple : scope.ripples) ripple.period *= scale;
  std::vector<Equation> equations = scope.model.equations();
  for (Equation& equation : equations)
    for (WeightedTerm& summand : equation) {
      const auto powers = summand.term.exponents();
      if (!powers) summand.term = rescaled(summand.term, scope.model.variables(), scale);
      const int degree = powers ? std::accumulate(powers->begin(), powers->end(), 0) : 0;
      summand.coefficient *= std::pow(scale, 1 - degree) / pace;
    }
  scope.model = {scope.model.states(), scope.model.inputs(), equations,
                 scope.model.time_unit()};
  return scope;
}

/// The forms of an equation, sorted.
std::vector<std::string> forms(const Effect& effect, const Scope& scope,
                               const std::string& state) {
  std::vector<std::string> result;
  for (const Candidate& candidate : effect.candidates(scope, scope.model.state_index(state)))
    result.push_back(candidate.form.to_string());
  std::sort(result.begin(), result.end());
  return result;
}

class EveryEffectEverywhere : public testing::TestWithParam<StageVariant> {
 protected:
  Stage<Effect> effect() const { return stage_of<Effect>(GetParam()); }

  /// Whether the effect proposes as much in another view of a system, and reads it alike when
  /// the coefficient is that of the same motion.
  void expect_alike(const Scope& one, const Scope& other, double rates) const {
    for (Index k = 0; k < one.model.dimension(); ++k) {
      const auto first = effect()->candidates(one, k), second = effect()->candidates(other, k);
      ASSERT_EQ(first.size(), second.size());
      for (std::size_t i = 0; i < first.size(); ++i)
        for (const double sign : {-1.0, 1.0})
          expect_alike(one, first[i], other, second[i], sign, rates);
    }
  }

 private:
  static double rms(const Scope& scope, const Candidate& candidate, const Vector& shapes) {
    const bool plain = candidate.memory.empty() && !contains(candidate.form, Operation::Delay);
    const Expression formula =
        plain ? bind_form(candidate, {shapes.data(), static_cast<std::size_t>(shapes.size())})
              : candidate.within.value_or(candidate.argument);
    Matrix values(scope.samples.rows(), 1);
    Program::Workspace workspace;
    Program({&formula, 1}, scope.model.variables()).evaluate(scope.samples, values, workspace);
    return values.norm();
  }

  void expect_alike(const Scope& one, const Candidate& first, const Scope& other,
                    const Candidate& second, double sign, double rates) const {
    const double size = sign * size_of(one, first);
    ASSERT_EQ(first.starts.size(), second.starts.size());
    for (std::size_t s = 0; s < first.starts.size(); ++s) {
      const double same = size * rates * rms(one, first, first.starts[s]) /
                          rms(other, second, second.starts[s]);
      EXPECT_EQ(reading_at(*effect(), one, first, first.starts[s], size).has_value(),
                reading_at(*effect(), other, second, second.starts[s], same).has_value())
          << first.form.to_string() << " with " << size;
    }
  }
};

TEST_P(EveryEffectEverywhere, TheOrderOfStatesPlaysNoRole) {
  for (const EffectSystem& system : effect_systems())
    for (const Quantity& state : system.model.states()) {
      std::vector<std::string> one = forms(*effect(), system.scope(), state.name);
      std::vector<std::string> other = forms(*effect(), reversed(system), state.name);
      // Products are written in the order of the variables.
      EXPECT_EQ(one.size(), other.size()) << state.name;
    }
}

TEST_P(EveryEffectEverywhere, UnitsPlayNoRole) {
  for (const EffectSystem& system : effect_systems()) {
    Scope bare = system.scope();
    for (VariableRange& range : bare.variables) range.unit.clear();
    for (const Quantity& state : system.model.states())
      EXPECT_EQ(forms(*effect(), system.scope(), state.name),
                forms(*effect(), bare, state.name));
    expect_alike(system.scope(), bare, 1.0);
  }
}

TEST_P(EveryEffectEverywhere, ScalesOfVariablesPlayNoRole) {
  for (const EffectSystem& system : effect_systems())
    expect_alike(system.scope(), scaled(system, 1000.0, 1.0), 1000.0);
}

TEST_P(EveryEffectEverywhere, TheUnitOfTimePlaysNoRole) {
  // Of the systems whose identities (coefficient 1) do not tie the unit of time to others.
  const EffectSystem system = effect_systems().back();
  expect_alike(system.scope(), scaled(system, 1.0, 60.0), 1.0 / 60.0);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryEffectEverywhere,
                         testing::ValuesIn(available(Effect::kKind)), test_name);

}  // namespace
}  // namespace lacuna::contract
