// SPDX-License-Identifier: MIT
// What does a model lack? Names that lacuna knows, and one of one's own.
#include <iostream>
#include <lacuna/lacuna.hpp>

using namespace lacuna;

// A motor pulls its carriage into the slots between its magnets: a force along the way.
std::vector<Candidate> slots(const Scope& scope, Index equation) {
  const auto position = scope.integral_of(equation);  // x, where the equation is dv/dt
  if (!position) return {};
  const VariableRange& range = scope.state(*position);
  const Expression x = Expression::variable(range.name);
  const double way = range.high - range.low;
  std::vector<Candidate> result;
  for (const char* pattern : {"sin(2*pi*x/pitch)", "cos(2*pi*x/pitch)"})
    result.push_back(shaped_candidate(formula(scope, pattern, {{"x", x}}), x,
                                      {"pitch", range.unit, 0.01 * way, way, true},
                                      geometric_starts(0.02 * way, way, 60)));
  return result;
}

// What this effect proposes is always it: no function that reads a fitted form is needed.
const EffectFamily kCogging{{"cogging", "A force that repeats along the way", ""},
                            "the slots of a motor, the teeth of a gear",
                            slots};

int main() {
  const auto x = Expression::variable("x"), v = Expression::variable("v");
  const OdeModel nominal = written_model({{"x", "m"}, {"v", "m/s"}}, {v, -9.0 * x - 0.2 * v});
  const auto measured = [&](const char* term, double coefficient) {
    const OdeModel bench =
        nominal.with_term(1, {Term::parse(term, nominal.variables()), coefficient});
    return add_relative_noise(record_of(bench, rk4(), Vector{{1.0, 0.0}}, 0.01, 2000), 0.01, 1);
  };
  std::cout << format_text(diagnose(nominal, measured("sign(v)", -0.1))) << '\n';

  DiagnosisOptions options;
  options.effects = {FamilyEffect<kCogging>{}};
  std::cout << format_text(diagnose(nominal, measured("sin(2*pi*x/0.25)", 0.5), {}, options));
}
