// SPDX-License-Identifier: MIT
#include "bases/piecewise_linear.hpp"

#include "bases/axis.hpp"

namespace lacuna {

std::vector<Term> PiecewiseLinear::do_terms(const Variables& variables) const {
  const Options& o = options();
  check_range_of_axis("piecewise-linear", o.low, o.high);
  const std::vector<std::string> names = axis_names(variables, o.with_inputs);
  std::vector<Term> terms = linear_terms(names, variables);
  for (const std::string& name : names)
    for (const double bend : places_between(o.low, o.high, o.count))
      terms.push_back(Term::parse("max(" + shifted_axis(name, bend) + ",0)", variables));
  return terms;
}

Stage<Basis> piecewise_linear(const PiecewiseLinearOptions& options) {
  return PiecewiseLinear(options);
}

}  // namespace lacuna
