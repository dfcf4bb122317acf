// SPDX-License-Identifier: MIT
#include "lacuna/bases/expressions.hpp"

#include "bases/term_list.hpp"

namespace lacuna {

std::vector<Term> Expressions::do_terms(const Variables& variables) const {
  return parse_term_list("expressions.terms", options().terms, variables);
}

}  // namespace lacuna
