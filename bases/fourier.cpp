// SPDX-License-Identifier: MIT
#include "bases/fourier.hpp"

namespace lacuna {
namespace {

/// k w v; a factor of 1 is not written.
Expression angle(double wave_number, const std::string& variable) {
  const Expression v = Expression::variable(variable);
  return wave_number == 1.0 ? v : Expression::number(wave_number) * v;
}

}  // namespace

std::vector<Term> Fourier::do_terms(const Variables& variables) const {
  const Options& o = options();
  if (o.wave_number == 0.0)
    throw ConfigError("fourier.wave_number", "it is 0",
                      "give the wave number of the first sine");
  std::vector<std::string> names = variables.states;
  if (o.with_inputs)
    names.insert(names.end(), variables.inputs.begin(), variables.inputs.end());
  std::vector<Term> terms;
  if (o.with_linear) {
    terms.emplace_back(Expression::number(1.0), variables);
    for (const std::string& name : names)
      terms.emplace_back(Expression::variable(name), variables);
  }
  for (const std::string& name : names)
    for (int k = 1; k <= o.harmonics; ++k)
      for (const Operation wave : {Operation::Sin, Operation::Cos})
        terms.emplace_back(Expression::make(wave, {angle(k * o.wave_number, name)}), variables);
  return terms;
}

Stage<Basis> fourier(const FourierOptions& options) { return Fourier(options); }

}  // namespace lacuna
