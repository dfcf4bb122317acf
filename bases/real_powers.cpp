// SPDX-License-Identifier: MIT
#include "bases/real_powers.hpp"

#include <cmath>

#include "bases/axis.hpp"
#include "core/base/text.hpp"

namespace lacuna {
namespace {

double exponent_of(const std::string& text) {
  const std::optional<double> value = parse_number(text);
  if (value && std::isfinite(*value) && *value != 0.0 && *value != 1.0) return *value;
  throw ConfigError("real-powers.exponents", "'" + text + "' is no exponent",
                    "give numbers other than 0 and 1");
}

std::string power_text(const std::string& name, double exponent, bool with_sign) {
  const std::string number = format_number(exponent);
  const std::string power = exponent < 0.0 ? "^(" + number + ")" : "^" + number;
  return with_sign ? "sign(" + name + ")*abs(" + name + ")" + power : name + power;
}

}  // namespace

std::vector<Term> RealPowers::do_terms(const Variables& variables) const {
  const Options& o = options();
  const std::vector<std::string> names = axis_names(variables, o.with_inputs);
  std::vector<Term> terms = linear_terms(names, variables);
  for (const std::string& name : names)
    for (const std::string& exponent : o.exponents)
      terms.push_back(
          Term::parse(power_text(name, exponent_of(exponent), o.signed_powers), variables));
  return terms;
}

Stage<Basis> real_powers(const RealPowersOptions& options) { return RealPowers(options); }

}  // namespace lacuna
