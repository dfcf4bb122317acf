// SPDX-License-Identifier: MIT
#include "bases/expressions.hpp"

#include "bases/term_list.hpp"

namespace lacuna {

std::vector<Term> Expressions::do_terms(const Variables& variables) const {
  return parse_term_list("expressions.terms", options().terms, variables);
}

Stage<Basis> expressions(const ExpressionsOptions& options) { return Expressions(options); }

}  // namespace lacuna
