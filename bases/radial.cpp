// SPDX-License-Identifier: MIT
#include "bases/radial.hpp"

#include "bases/axis.hpp"
#include "core/base/text.hpp"

namespace lacuna {

std::vector<Term> RadialFunctions::do_terms(const Variables& variables) const {
  const Options& o = options();
  check_range_of_axis("radial", o.low, o.high);
  const std::vector<std::string> names = axis_names(variables, o.with_inputs);
  std::vector<Term> terms = linear_terms(names, variables);
  const double width = o.count > 1 ? (o.high - o.low) / (o.count - 1) : 0.5 * (o.high - o.low);
  const std::string factor = format_number(0.5 / (width * width));
  for (const std::string& name : names)
    for (const double centre : places_between(o.low, o.high, o.count))
      terms.push_back(
          Term::parse("exp(-" + factor + "*" + shifted_axis(name, centre) + "^2)", variables));
  return terms;
}

Stage<Basis> radial_functions(const RadialFunctionsOptions& options) {
  return RadialFunctions(options);
}

}  // namespace lacuna
